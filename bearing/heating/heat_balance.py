"""One-node heat balance of a bearing: its friction power leaves by its surroundings and by the
oil.

    M(T) omega = h (T - T_ambient) + rho c V (T - T_supply)

with one temperature T for rings, balls and oil. The torque falls with the temperature through the
viscosity and, with `torque` a function that solves the bearing anew, through clearance and loads
as well.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import isfinite

from scipy.optimize import brentq

LARGEST_RISE = 300.0  # [K] above the warmer of ambient and supply that is looked at
FIRST_RISE = 10.0  # first temperature looked at above the rest; doubled until the cooling wins [K]
TOLERANCE = 1.0e-4  # of the temperature [K]


@dataclass(frozen=True, slots=True, kw_only=True)
class Cooling:
    """Where the heat goes.

    Attributes
    ----------
    conductance : float
        h, heat to the surroundings per kelvin [W/K].
    ambient : float
        [K].
    oil_flow : float
        rho c V of the oil that passes through, per kelvin [W/K].
    oil_supply : float
        Temperature of the oil supplied [K].
    """

    conductance: float
    ambient: float
    oil_flow: float = 0.0
    oil_supply: float = 293.15

    def __post_init__(self) -> None:
        for field in ("conductance", "oil_flow"):
            value = getattr(self, field)
            if not (isfinite(value) and value >= 0.0):
                raise ValueError(f"{field} must be zero or positive and finite, got {value!r} W/K")
        if self.conductance + self.oil_flow <= 0.0:
            raise ValueError(
                "conductance and oil_flow must not both be zero: nothing would cool the bearing"
            )
        for field in ("ambient", "oil_supply"):
            value = getattr(self, field)
            if not (isfinite(value) and value > 0.0):
                raise ValueError(f"{field} must be positive and finite, got {value!r} K")

    def heat(self, temperature: float) -> float:
        """Heat carried away at a temperature [K], in [W]."""
        return self.conductance * (temperature - self.ambient) + self.oil_flow * (
            temperature - self.oil_supply
        )

    @property
    def rest(self) -> float:
        """Temperature of a bearing without friction [K]."""
        weighted = self.conductance * self.ambient + self.oil_flow * self.oil_supply
        return weighted / (self.conductance + self.oil_flow)


@dataclass(frozen=True, slots=True, kw_only=True)
class HeatBalance:
    """Temperature at which friction and cooling agree.

    Attributes
    ----------
    temperature : float
        [K].
    torque : float
        [N m].
    power : float
        Friction power [W].
    evaluations : int
        Of the torque.
    residual : float
        Friction less cooling, over the friction [-].
    converged : bool
    message : str
    """

    temperature: float
    torque: float
    power: float
    evaluations: int
    residual: float
    converged: bool
    message: str


def heat_balance(torque: Callable[[float], float], speed: float, cooling: Cooling) -> HeatBalance:
    """Temperature of a bearing that warms itself.

    Parameters
    ----------
    torque : callable
        Friction torque [N m] at a temperature [K].
    speed : float
        Of the shaft [rad/s].
    cooling : Cooling

    Returns
    -------
    HeatBalance
        Not `converged` where friction exceeds the cooling up to `LARGEST_RISE`.
    """
    seen: dict[float, float] = {}

    def surplus(temperature: float) -> float:
        seen[temperature] = torque(temperature)
        return seen[temperature] * abs(speed) - cooling.heat(temperature)

    low = high = found = cooling.rest
    message = "converged"
    rise = FIRST_RISE
    warmer = surplus(low)
    if warmer <= 0.0:
        message = "converged: no friction to speak of"
    while warmer > 0.0 and high < cooling.rest + LARGEST_RISE:
        low = high
        high = min(cooling.rest + rise, cooling.rest + LARGEST_RISE)
        rise = 2.0 * rise
        warmer = surplus(high)
    if warmer > 0.0:
        found = high
        message = (
            f"no balance: friction exceeds the cooling up to {LARGEST_RISE:g} K above the rest"
        )
    elif high > low:
        found = float(brentq(surplus, low, high, xtol=TOLERANCE))
        if found not in seen:
            surplus(found)
    power = seen[found] * abs(speed)
    return HeatBalance(
        temperature=found,
        torque=seen[found],
        power=power,
        evaluations=len(seen),
        residual=(power - cooling.heat(found)) / power if power > 0.0 else 0.0,
        converged=message.startswith("converged"),
        message=message,
    )
