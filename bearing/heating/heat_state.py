"""One state of a bearing that warms itself: heat at a film temperature and a clearance, and the
temperatures of all parts that follow from it.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ehl.arrays import Array
from ehl.oil.lubricant import Lubricant

from ..contacts.contact import BearingContact
from ..contacts.contacts import contact_conditions, with_oil
from ..fits.clearance import Fit, TemperatureRise, clearance_budget
from ..geometry import Bearing
from ..operation import Operation, QuasistaticModel
from ..quasistatic.solution import QuasistaticSolution
from ..quasistatic.solver import solve_quasistatic
from ..rows import SINGLE, Row
from .friction_heat import FrictionHeat, effusivity_shares
from .heat_balance import HIGHEST_TEMPERATURE
from .network import AMBIENT, NODES, OIL_SUPPLY, HeatNetwork, HeatPath
from .paths import Surroundings, solid_paths, state_paths

FrictionModel = Callable[[QuasistaticSolution, Sequence[BearingContact], Lubricant], FrictionHeat]
OUTER = ("outer_ring_loaded", "outer_ring_unloaded")


@dataclass(frozen=True, slots=True, kw_only=True)
class SelfHeatingProblem:
    """A bearing whose temperatures follow from its friction."""

    bearing: Bearing  # with its clearance at the reference temperature, before mounting
    operation: Operation  # its temperature is where the search begins
    model: QuasistaticModel
    oil: Callable[[float], Lubricant]  # lubricant at a temperature [K]
    friction: FrictionModel  # heat of an equilibrium, its contacts and its oil
    around: Surroundings
    fit: Fit | None = None
    # temperature at which clearance and fits were measured; None: the clearance is the operating
    # one, and stays
    reference: float | None = 293.15  # [K]
    rows: tuple[Row, ...] = SINGLE  # of balls on the one inner ring
    oil_share: float | None = None  # of the cavity [-]
    start: QuasistaticSolution | None = None  # an equilibrium nearby, where that is known
    contacts: tuple[BearingContact, ...] = ()  # of `start`, where they are known
    hottest: float = HIGHEST_TEMPERATURE  # of the films, beyond which no balance counts [K]
    # step of the film temperature that is not taken any more, of who asks whether the one where
    # the search begins is that of a balance [K]
    enough: float = 0.0

    def clearance(self, temperatures: Array) -> float:
        """Diametral clearance at temperatures of the nodes; that of the outer ring is the mean of
        its halves.

        Parameters
        ----------
        temperatures : Array
            of the nodes, shape (nodes,) [K]

        Returns
        -------
        float
            clearance [m]
        """
        if self.reference is None:
            return self.bearing.diametral_clearance
        rise = dict(zip(NODES, (temperatures - self.reference).tolist(), strict=True))
        rises = TemperatureRise(
            inner_ring=rise["inner_ring"],
            shaft=rise["shaft"],
            outer_ring=0.5 * (rise[OUTER[0]] + rise[OUTER[1]]),
            housing=rise["housing"],
            ball=rise["balls"],
        )
        return clearance_budget(self.bearing, self.operation, self.fit, rises).operating

    def disagreement(self, state: "HeatState") -> Array:
        """T_f' - T_f and P_d' - P_d of a state: zero in a balance.

        Parameters
        ----------
        state : HeatState
            heat and temperatures at one film temperature and clearance

        Returns
        -------
        Array
            shape (2,) [K], [m]
        """
        return np.array(
            [
                state.resulting_temperature - state.film_temperature,
                self.clearance(state.temperatures) - state.clearance,
            ]
        )

    def fixed_paths(self) -> tuple[HeatPath, ...]:
        """Paths that friction leaves as they are."""
        speed = self.operation.shaft_speed
        return solid_paths(self.bearing, self.around, speed, len(self.rows))


@dataclass(frozen=True, slots=True, kw_only=True)
class HeatState:
    """Heat at one film temperature and clearance, and the temperatures that follow."""

    film_temperature: float  # of oil and films [K]
    clearance: float  # on the diameter [m]
    viscosity: float  # of the oil there [Pa s]
    friction: FrictionHeat
    sources: Array  # heat into the nodes [W]
    network: HeatNetwork
    temperatures: Array  # of the nodes under these sources [K]
    solution: QuasistaticSolution
    contacts: tuple[BearingContact, ...]  # of the solution

    @property
    def weights(self) -> Array:
        """Of the nodes in the film temperature [-]: half the balls, a quarter each ring, the outer
        one by the loads in its halves.
        """
        halves = self.friction.loaded @ self.friction.contact[:, 1]
        total = float(self.friction.contact[:, 1].sum())
        loaded = float(halves) / total if total > 0.0 else 0.5
        values = {"balls": 0.5, "inner_ring": 0.25}
        values |= {OUTER[0]: 0.25 * loaded, OUTER[1]: 0.25 * (1.0 - loaded)}
        return np.array([values.get(name, 0.0) for name in NODES])

    @property
    def resulting_temperature(self) -> float:
        """Film temperature that follows [K]."""
        return float(self.weights @ self.temperatures)

    def surplus(self, temperatures: Array) -> Array:
        """Heat into each node less what leaves it.

        Parameters
        ----------
        temperatures : Array
            of the nodes, shape (nodes,) [K]

        Returns
        -------
        Array
            shape (nodes,) [W]
        """
        leaving, given = self.network.matrix()
        return np.asarray(self.sources + given - leaving @ temperatures)


def broyden(matrix: Array, step: Array, change: Array, scales: tuple[float, ...]) -> Array:
    """Matrix of derivatives after a step that changed the residual, lengths in the scales of the
    unknowns, Broyden (1965).

    Parameters
    ----------
    matrix : Array
        before the step, shape (n, n)
    step : Array
        of the unknowns, shape (n,)
    change : Array
        of the residual, shape (n,)
    scales : tuple[float, ...]
        of the unknowns, in their units

    Returns
    -------
    Array
        shape (n, n)
    """
    weighted = step * np.array(scales) ** -2.0
    return np.asarray(matrix + np.outer(change - matrix @ step, weighted) / (step @ weighted))


def heat_state(
    problem: SelfHeatingProblem,
    fixed: Sequence[HeatPath],
    film_temperature: float,
    clearance: float,
    initial_guess: tuple[QuasistaticSolution, tuple[BearingContact, ...]] | None = None,
) -> HeatState:
    """Equilibrium, friction and temperatures at a film temperature and a clearance.

    Parameters
    ----------
    problem : SelfHeatingProblem
        the bearing that warms itself
    fixed : Sequence[HeatPath]
        paths of heat that friction leaves as they are
    film_temperature : float
        of oil and films [K]
    clearance : float
        on the diameter [m]
    initial_guess : tuple[QuasistaticSolution, tuple[BearingContact, ...]] | None, optional
        an equilibrium nearby, and its contacts, empty where they are not computed

    Returns
    -------
    HeatState
        heat [W] and temperatures [K]

    Raises
    ------
    ValueError
        if there is no equilibrium or no friction there, or heat cannot leave
    """
    # 1. clearance, 2. equilibrium, 3. viscosity, 4. friction
    operation = replace(problem.operation, temperature=film_temperature)
    bearing = replace(problem.bearing, diametral_clearance=clearance)
    known, contacts = (None, ()) if initial_guess is None else initial_guess
    solution = _equilibrium(problem, bearing, operation, known)
    if not solution.converged:
        raise ValueError(f"no equilibrium at {film_temperature:.1f} K: {solution.message}")
    oil = problem.oil(film_temperature)
    if known is not None and contacts and known.inner_load is solution.inner_load:
        contacts = with_oil(solution, contacts, oil)
    else:
        contacts = contact_conditions(solution, oil)
    friction = problem.friction(solution, contacts, oil)
    # 5. heat into the nodes, and their temperatures
    around = problem.around
    sources = friction.sources(effusivity_shares(bearing), around.pumped_to_oil)
    paths = state_paths(bearing, around, oil, friction, solution.cage_speed, len(problem.rows))
    boundaries = {AMBIENT: around.ambient, OIL_SUPPLY: around.oil_supply}
    network = HeatNetwork(paths=(*fixed, *paths), boundaries=boundaries)
    return HeatState(
        film_temperature=film_temperature,
        clearance=clearance,
        viscosity=oil.viscosity,
        friction=friction,
        sources=sources,
        network=network,
        temperatures=network.temperatures(sources),
        solution=solution,
        contacts=contacts,
    )


def _equilibrium(
    problem: SelfHeatingProblem,
    bearing: Bearing,
    operation: Operation,
    initial_guess: QuasistaticSolution | None,
) -> QuasistaticSolution:
    """That of the bearing, SI: its loads do not depend on the oil, so that one at another
    temperature is the same.
    """
    if initial_guess is None or not initial_guess.converged:
        return solve_quasistatic(bearing, operation, problem.model, rows=problem.rows)
    known = (initial_guess.bearing, initial_guess.model, tuple(initial_guess.rows))
    at_once = replace(initial_guess.operation, temperature=operation.temperature) == operation
    if at_once and known == (bearing, problem.model, tuple(problem.rows)):
        return replace(initial_guess, operation=operation)
    guess = initial_guess if initial_guess.model == problem.model else None
    return solve_quasistatic(bearing, operation, problem.model, guess, problem.rows)
