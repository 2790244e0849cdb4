"""Self-heating: torque to temperature, to viscosity and clearance, to loads, to torque."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from ehl.oil.lubricant import Lubricant

from ..contacts.contact import BearingContact
from ..contacts.contacts import contact_conditions
from ..fits.clearance import Fit, TemperatureRise, clearance_budget
from ..geometry import Bearing
from ..operation import Operation, QuasistaticModel
from ..quasistatic.solution import QuasistaticSolution
from ..quasistatic.solver import solve_quasistatic
from ..rows import SINGLE, Row
from .heat_balance import Cooling, HeatBalance, heat_balance

TorqueModel = Callable[[QuasistaticSolution, Sequence[BearingContact], Lubricant], float]  # [N m]


@dataclass(frozen=True, slots=True, kw_only=True)
class SelfHeatingProblem:
    """A bearing whose temperature follows from its friction."""

    bearing: Bearing  # with its clearance at the reference temperature, before mounting
    operation: Operation  # its temperature is replaced
    model: QuasistaticModel
    oil: Callable[[float], Lubricant]  # lubricant at a temperature [K]
    torque: TorqueModel  # friction torque [N m] of an equilibrium, its contacts and its oil
    fit: Fit | None = None
    # temperature at which clearance and fits were measured; None: the clearance is the operating
    # one, and stays
    reference: float | None = 293.15  # [K]
    # inner ring and shaft above the one temperature of the node, outer ring and housing as much
    # below it
    inner_excess: float = 0.0  # [K]
    rows: tuple[Row, ...] = SINGLE  # of balls on the one inner ring

    def clearance(self, temperature: float) -> float:
        """Diametral clearance [m] at a temperature [K]."""
        if self.reference is None:
            return self.bearing.diametral_clearance
        ball = temperature - self.reference
        inner = ball + self.inner_excess
        outer = ball - self.inner_excess
        rise = TemperatureRise(
            inner_ring=inner, shaft=inner, outer_ring=outer, housing=outer, ball=ball
        )
        return clearance_budget(self.bearing, self.operation, self.fit, rise).operating

    def torque_at(self, temperature: float) -> float:
        """Friction torque [N m] at a temperature [K]: of the equilibrium with the clearance and
        the oil there.

        Raises
        ------
        ValueError
            If there is no equilibrium at that temperature [K].
        """
        # 1. clearance, 2. equilibrium, 3. viscosity, 4. torque
        operation = replace(self.operation, temperature=temperature)
        bearing = replace(self.bearing, diametral_clearance=self.clearance(temperature))
        solution = solve_quasistatic(bearing, operation, self.model, rows=self.rows)
        if not solution.converged:
            raise ValueError(f"no equilibrium at {temperature:.1f} K: {solution.message}")
        oil = self.oil(temperature)
        return self.torque(solution, contact_conditions(solution, oil), oil)


@dataclass(frozen=True, slots=True, kw_only=True)
class SelfHeatingSolution:
    """Temperature of a bearing heated by its own friction, or why there is none."""

    model: str  # of the friction torque
    balance: HeatBalance | None  # None where the torque could not be computed
    cooling: Cooling
    viscosity: float | None = None  # of the oil at that temperature [Pa s]
    clearance: float | None = None  # on the diameter at that temperature [m]
    note: str = ""  # why there is no balance

    @property
    def converged(self) -> bool:
        """Whether friction and cooling agree."""
        return self.balance is not None and self.balance.converged

    @property
    def oil_heat(self) -> float | None:
        """Heat that the oil removes [W]."""
        if self.balance is None:
            return None
        return self.cooling.oil_flow * (self.balance.temperature - self.cooling.oil_supply)


def self_heating(problem: SelfHeatingProblem, cooling: Cooling) -> HeatBalance:
    """Temperature [K] at which friction equals what surroundings and oil remove."""
    speed = problem.operation.shaft_speed
    return heat_balance(problem.torque_at, speed, cooling)


def solve_self_heating(
    problem: SelfHeatingProblem, cooling: Cooling, model: str
) -> SelfHeatingSolution:
    """`self_heating` with oil and clearance at the temperature [K], or why there is none."""
    try:
        balance = self_heating(problem, cooling)
        if not balance.converged:
            return SelfHeatingSolution(
                model=model, balance=balance, cooling=cooling, note=balance.message
            )
        oil = problem.oil(balance.temperature)
        clearance = problem.clearance(balance.temperature)
    except ValueError as error:
        return SelfHeatingSolution(model=model, balance=None, cooling=cooling, note=str(error))
    return SelfHeatingSolution(
        model=model, balance=balance, cooling=cooling, viscosity=oil.viscosity, clearance=clearance
    )
