"""A bearing that warms itself: torque to temperature, to viscosity and clearance, to loads, and back to torque."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from ehl.lubricant import Lubricant

from ..clearance import Fit, Warming, clearance_budget
from ..contacts import BearingContact, contact_conditions
from ..geometry import Bearing
from ..operation import Model, Operation
from ..quasistatic import QuasistaticSolution, solve_quasistatic
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
    reference : float
        Temperature at which clearance and fits were measured [K].
    inner_excess : float
        Inner ring and shaft above the one temperature of the node, outer ring and housing as much below it [K].
    """

    bearing: Bearing
    operation: Operation
    model: Model
    oil: Callable[[float], Lubricant]
    torque: TorqueModel
    fit: Fit | None = None
    reference: float = 293.15
    inner_excess: float = 0.0

    def at(self, temperature: float) -> tuple[QuasistaticSolution, Lubricant]:
        """Equilibrium with the clearance at a temperature [K], and the oil.

        Raises
        ------
        ValueError
            If there is no equilibrium at that temperature [K].
        """
        rise, excess = temperature - self.reference, self.inner_excess
        warming = Warming(
            inner_ring=rise + excess,
            shaft=rise + excess,
            outer_ring=rise - excess,
            housing=rise - excess,
            ball=rise,
        )
        operation = replace(self.operation, temperature=temperature)
        budget = clearance_budget(self.bearing, operation, self.fit, warming)
        warm = replace(self.bearing, diametral_clearance=budget.operating)
        solution = solve_quasistatic(warm, operation, self.model)
        if not solution.converged:
            raise ValueError(f"no equilibrium at {temperature:.1f} K: {solution.message}")
        return solution, self.oil(temperature)

    def torque_at(self, temperature: float) -> float:
        """Friction torque [N m] at a temperature [K]."""
        solution, oil = self.at(temperature)
        return self.torque(solution, contact_conditions(solution, oil), oil)


def self_heating(warm: WarmBearing, cooling: Cooling) -> HeatBalance:
    """Temperature at which the friction of a bearing is what its surroundings and its oil carry away.

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
