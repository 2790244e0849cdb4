"""Palmgren's friction torque of ball bearings, M = M_0 + M_1 (Palmgren, 1957; Harris and Kotzalas,
chapter 10).
"""

import tomllib
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

from ehl.units import RPM

# in SI
MM = 1e-3
N_MM = 1e-3
MM2_S = 1e-6
BRANCH = 2000.0  # nu n [mm^2/s r/min] from which the viscous moment rises with the speed


@dataclass(frozen=True, slots=True, kw_only=True)
class PalmgrenTorque:
    """Moments [N m]."""

    viscous: float  # M_0
    load: float  # M_1

    @property
    def total(self) -> float:
        """M_0 + M_1 [N m]."""
        return self.viscous + self.load


@cache
def _data() -> dict[str, Any]:
    return tomllib.loads(
        (files("bearing.library") / "data" / "palmgren.toml").read_text(encoding="utf-8")
    )


def viscous_factor(kind: str, lubrication: str) -> float:
    """f_0 of a kind of bearing and a way of lubrication [-].

    `kind`: "deep groove" or "angular contact" [-]; `lubrication`: "grease", "oil bath", "low
    oil bath" (as a bath), "oil jet" (twice the bath) or "oil air" (half of it) [-].
    """
    factors = _data()["viscous"]
    return float(
        factors.get(lubrication, 1.0)
        * factors[kind]["grease" if lubrication == "grease" else "oil bath"]
    )


def load_factor(kind: str, equivalent_static_load: float, static_rating: float) -> float:
    """f_1 = z (P_0/C_0)^y, in the middle of the range for z (unverified) [-]; loads in [N]."""
    low, high, power = _data()["load"][kind]
    return float(0.5 * (low + high) * (equivalent_static_load / static_rating) ** power)


def directed_load(kind: str, radial: float, axial: float) -> float:
    """P_1 [N]: 3.3 F_a - 0.1 F_r (deep groove), F_a - 0.1 F_r (angular contact), not less than F_r
    [N].
    """
    slope = 3.3 if kind == "deep groove" else 1.0
    return max(slope * abs(axial) - 0.1 * abs(radial), abs(radial))


def palmgren_torque(
    mean_diameter: float, speed: float, viscosity: float, viscous: float, load: tuple[float, float]
) -> PalmgrenTorque:
    """M_0 = f_0 1e-7 (nu n)^(2/3) d_m^3 above nu n = 2000, f_0 160e-7 d_m^3 below; M_1 = f_1 P_1
    d_m.

    `mean_diameter`: d_m [m]; `speed`: of the rotating ring [rad/s]; `viscosity`: kinematic
    [m^2/s]; `viscous`: f_0 [-]; `load`: f_1 [-] and P_1 [N].
    """
    d = mean_diameter / MM
    product = viscosity / MM2_S * abs(speed) / RPM
    growth = 1e-7 * product ** (2 / 3) if product >= BRANCH else 160e-7
    return PalmgrenTorque(
        viscous=viscous * growth * d**3 * N_MM, load=load[0] * load[1] * mean_diameter
    )
