"""A bearing that warms itself: torque to temperature, to viscosity and clearance, to loads, and
back to torque.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from ehl.oil.lubricant import Lubricant

from ..contacts.contacts import BearingContact, contact_conditions
from ..fits.clearance import Fit, Warming, clearance_budget
from ..geometry import Bearing
from ..operation import Model, Operation
from ..quasistatic.solution import QuasistaticSolution
from ..quasistatic.solver import solve_quasistatic
from .heat_balance import Cooling, HeatBalance, heat_balance

TorqueModel = Callable[[QuasistaticSolution, Sequence[BearingContact], Lubricant], float]  # [N m]


@dataclass(frozen=True, slots=True, kw_only=True)
class WarmBearing:
    """A bearing at a temperature that is not known yet.

    Attributes
    ----------
    bearing : Bearing
        With its clearance at the reference temperature, before mounting.
    operation : Operation
        Its temperature is replaced.
    model : Model
    oil : callable
        Lubricant at a temperature [K].
    torque : callable
        Friction torque [N m] of an equilibrium, its contacts and its oil.
    fit : Fit or None
    reference : float or None
        Temperature at which clearance and fits were measured [K]; None: the clearance is the
        operating one, and stays.
    inner_excess : float
        Inner ring and shaft above the one temperature of the node, outer ring and housing as much
        below it [K].
    """

    bearing: Bearing
    operation: Operation
    model: Model
    oil: Callable[[float], Lubricant]
    torque: TorqueModel
    fit: Fit | None = None
    reference: float | None = 293.15
    inner_excess: float = 0.0

    def at(self, temperature: float) -> tuple[QuasistaticSolution, Lubricant]:
        """Equilibrium with the clearance at a temperature [K], and the oil.

        Raises
        ------
        ValueError
            If there is no equilibrium at that temperature [K].
        """
        operation = replace(self.operation, temperature=temperature)
        warm = replace(self.bearing, diametral_clearance=self.clearance(temperature))
        solution = solve_quasistatic(warm, operation, self.model)
        if not solution.converged:
            raise ValueError(f"no equilibrium at {temperature:.1f} K: {solution.message}")
        return solution, self.oil(temperature)

    def clearance(self, temperature: float) -> float:
        """Diametral clearance [m] at a temperature [K]."""
        if self.reference is None:
            return self.bearing.diametral_clearance
        rise = temperature - self.reference
        excess = self.inner_excess
        warming = Warming(
            inner_ring=rise + excess,
            shaft=rise + excess,
            outer_ring=rise - excess,
            housing=rise - excess,
            ball=rise,
        )
        return clearance_budget(self.bearing, self.operation, self.fit, warming).operating

    def torque_at(self, temperature: float) -> float:
        """Friction torque [N m] at a temperature [K]."""
        solution, oil = self.at(temperature)
        return self.torque(solution, contact_conditions(solution, oil), oil)


def self_heating(warm: WarmBearing, cooling: Cooling) -> HeatBalance:
    """Temperature at which the friction of a bearing is what its surroundings and its oil carry
    away.

    Parameters
    ----------
    warm : WarmBearing
    cooling : Cooling
        Conductances in [W/K].

    Returns
    -------
    HeatBalance
        Temperature [K], torque [N m], power [W].
    """
    speed = abs(warm.operation.inner_speed - warm.operation.outer_speed)
    return heat_balance(warm.torque_at, speed, cooling)


@dataclass(frozen=True, slots=True, kw_only=True)
class WarmState:
    """What a bearing comes to that warms itself.

    Attributes
    ----------
    model : str
        Of the friction torque.
    balance : HeatBalance or None
        None where the torque could not be computed.
    cooling : Cooling
    viscosity, clearance : float or None
        Of the oil [Pa s] and on the diameter [m], at the temperature found.
    note : str
        Why there is no balance, or what is to be said of it.
    """

    model: str
    balance: HeatBalance | None
    cooling: Cooling
    viscosity: float | None = None
    clearance: float | None = None
    note: str = ""

    @property
    def converged(self) -> bool:
        """Whether friction and cooling agree."""
        return self.balance is not None and self.balance.converged

    @property
    def oil_heat(self) -> float | None:
        """Heat that the oil carries away [W]."""
        if self.balance is None:
            return None
        return self.cooling.oil_flow * (self.balance.temperature - self.cooling.oil_supply)


def warm_state(warm: WarmBearing, cooling: Cooling, model: str) -> WarmState:
    """Temperature [K] that a bearing warms itself to, with its oil and clearance there, or why
    there is none.
    """
    try:
        balance = self_heating(warm, cooling)
        if not balance.converged:
            return WarmState(model=model, balance=balance, cooling=cooling, note=balance.message)
        oil, clearance = warm.oil(balance.temperature), warm.clearance(balance.temperature)
    except ValueError as problem:
        return WarmState(model=model, balance=None, cooling=cooling, note=str(problem))
    return WarmState(
        model=model, balance=balance, cooling=cooling, viscosity=oil.viscosity, clearance=clearance
    )
