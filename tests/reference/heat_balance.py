"""One-node heat balance of a bearing: its friction power leaves by its surroundings and by the oil.

    M(T) omega = h (T - T_ambient) + rho c V (T - T_supply)

with one temperature T for rings, balls and oil; the network of `oilfilm.bearing.heating` with a single node.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import isfinite

import scipy

from oilfilm.bearing.heating.limits import HIGHEST_TEMPERATURE, HeatBalance
from oilfilm.ehl.units import ZERO_CELSIUS

FIRST_RISE = 10.0  # of the search; doubled until the cooling exceeds the friction [K]
TOLERANCE = 1.0e-4  # of the temperature [K]


@dataclass(frozen=True, slots=True, kw_only=True)
class Cooling:
    """Conductances to the surroundings and the oil."""

    conductance: float  # h, heat to the surroundings per kelvin [W/K]
    ambient: float  # [K]
    oil_flow: float = 0.0  # rho c V of the oil that passes through, per kelvin [W/K]
    oil_supply: float = 293.15  # temperature of the oil supplied [K]

    def __post_init__(self) -> None:
        for field in ("conductance", "oil_flow"):
            value = getattr(self, field)
            if not (isfinite(value) and value >= 0.0):
                raise ValueError(f"{field} must be zero or positive and finite, got {value!r} W/K")
        if self.conductance + self.oil_flow <= 0.0:
            raise ValueError("conductance and oil_flow must not both be zero: nothing would cool the bearing")
        for field in ("ambient", "oil_supply"):
            value = getattr(self, field)
            if not (isfinite(value) and value > 0.0):
                raise ValueError(f"{field} must be positive and finite, got {value!r} K")

    def heat(self, temperature: float) -> float:
        """Heat removed at a temperature.

        Parameters
        ----------
        temperature : float
            temperature of the bearing [K]

        Returns
        -------
        float
            heat [W]
        """
        to_surroundings = self.conductance * (temperature - self.ambient)
        return to_surroundings + self.oil_flow * (temperature - self.oil_supply)

    @property
    def frictionless_temperature(self) -> float:
        """Temperature of a bearing without friction [K]."""
        weighted = self.conductance * self.ambient + self.oil_flow * self.oil_supply
        return weighted / (self.conductance + self.oil_flow)


def heat_balance(torque: Callable[[float], float], speed: float, cooling: Cooling) -> HeatBalance:
    """Temperature of a bearing that is heated by its own friction.

    Not `converged` if friction exceeds the cooling up to `HIGHEST_TEMPERATURE`.

    Parameters
    ----------
    torque : Callable[[float], float]
        friction torque [N m] at a temperature [K]
    speed : float
        speed of the shaft [rad/s]
    cooling : Cooling
        conductances to surroundings and oil

    Returns
    -------
    HeatBalance
        temperature, torque and power
    """
    torques: dict[float, float] = {}

    def surplus(temperature: float) -> float:
        torques[temperature] = torque(temperature)
        return torques[temperature] * abs(speed) - cooling.heat(temperature)

    # 1. bracket: from the temperature without friction up, in doubling steps
    coldest = cooling.frictionless_temperature
    hottest = max(coldest, HIGHEST_TEMPERATURE)
    low = high = temperature = coldest
    rise = FIRST_RISE
    excess = surplus(low)
    message = "converged" if excess > 0.0 else "converged: no friction to speak of"
    while excess > 0.0 and high < hottest:
        low = high
        high = min(coldest + rise, hottest)
        rise = 2.0 * rise
        excess = surplus(high)
    # 2. root in the bracket, Brent (1973)
    if excess > 0.0:
        temperature = high
        message = (
            "no balance: friction exceeds the cooling up to "
            f"{hottest - ZERO_CELSIUS:.0f} C, beyond the range of lubricants"
        )
    elif high > low:
        temperature = float(scipy.optimize.brentq(surplus, low, high, xtol=TOLERANCE))
        if temperature not in torques:
            surplus(temperature)
    power = torques[temperature] * abs(speed)
    return HeatBalance(
        temperature=temperature,
        torque=torques[temperature],
        power=power,
        evaluations=len(torques),
        residual=(power - cooling.heat(temperature)) / power if power > 0.0 else 0.0,
        converged=message.startswith("converged"),
        message=message,
    )
