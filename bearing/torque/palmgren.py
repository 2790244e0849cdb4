"""Palmgren's friction torque of ball bearings, M = M_0 + M_1 (Palmgren, 1957; Harris and Kotzalas,
chapter 10).
"""

from ehl.units import MILLIMETRE, NEWTON_MILLIMETRE, RPM, from_si

from ..library.names import library_data

DATA = "palmgren.toml"
BRANCH = 2000.0  # nu n [mm^2/s r/min] from which the viscous moment rises with the speed


def viscous_factor(kind: str, lubrication: str) -> float:
    """Palmgren's f_0.

    Parameters
    ----------
    kind : str
        "deep groove" or "angular contact"
    lubrication : str
        "grease", "oil bath", "low oil bath" (as a bath), "oil jet" (twice the bath) or "oil air"
        (half of it)

    Returns
    -------
    float
        f_0 [-]
    """
    factors = library_data(DATA)["viscous"]
    base = factors[kind]["grease" if lubrication == "grease" else "oil bath"]
    return float(factors.get(lubrication, 1.0) * base)


def load_factor(kind: str, equivalent_static_load: float, static_rating: float) -> float:
    """Palmgren's f_1 = z (P_0/C_0)^y, in the middle of the range for z (unverified).

    Parameters
    ----------
    kind : str
        "deep groove" or "angular contact"
    equivalent_static_load : float
        P_0 [N]
    static_rating : float
        C_0 [N]

    Returns
    -------
    float
        f_1 [-]
    """
    low, high, power = library_data(DATA)["load"][kind]
    return float(0.5 * (low + high) * (equivalent_static_load / static_rating) ** power)


def directed_load(kind: str, radial: float, axial: float) -> float:
    """P_1: 3.3 F_a - 0.1 F_r (deep groove), F_a - 0.1 F_r (angular contact), not less than F_r.

    Parameters
    ----------
    kind : str
        "deep groove" or "angular contact"
    radial : float
        F_r [N]
    axial : float
        F_a [N]

    Returns
    -------
    float
        P_1 [N]
    """
    slope = 3.3 if kind == "deep groove" else 1.0
    return max(slope * abs(axial) - 0.1 * abs(radial), abs(radial))


def palmgren_torque(
    mean_diameter: float, speed: float, viscosity: float, viscous: float, load: tuple[float, float]
) -> tuple[float, float]:
    """M_0 and M_1: f_0 1e-7 (nu n)^(2/3) d_m^3 above nu n = 2000, f_0 160e-7 d_m^3 below; f_1 P_1
    d_m.

    Parameters
    ----------
    mean_diameter : float
        d_m [m]
    speed : float
        of the rotating ring [rad/s]
    viscosity : float
        kinematic [m^2/s]
    viscous : float
        f_0 [-]
    load : tuple[float, float]
        f_1 [-] and P_1 [N]

    Returns
    -------
    viscous
        M_0 [N m]
    load
        M_1 [N m]
    """
    product = from_si("viscosity_mm2_s", viscosity) * abs(speed) / RPM
    growth = 1e-7 * product ** (2 / 3) if product >= BRANCH else 160e-7
    viscous_moment = viscous * growth * (mean_diameter / MILLIMETRE) ** 3 * NEWTON_MILLIMETRE
    return viscous_moment, load[0] * load[1] * mean_diameter
