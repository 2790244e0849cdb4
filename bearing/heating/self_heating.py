"""Self-heating: heat to temperatures of the parts, to viscosity and clearance, to loads, films and
friction, to heat.

Friction depends on the temperatures by two numbers, that of the films T_f = w T and the clearance
P_d(T): at both of them the equilibrium is solved, its friction is spread over the nodes, and the
network gives the temperatures T', and with them T_f' and P_d'. Wanted is T_f' = T_f, P_d' = P_d:
a parabola through the last states on T_f alone, then Newton's method on both with differences as
its matrix, which gives the stability as well; without that, and the clearance, parabolas go on.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
import scipy

from oilfilm.ehl.arrays import Array, lagrange_weights
from oilfilm.ehl.units import ZERO_CELSIUS

from .friction_heat import UndrivenBallsError
from .heat_state import HeatState, SelfHeatingProblem, broyden, heat_state
from .limits import HeatBalance
from .network import NODES
from .over_time import Slopes, Stability, heat_capacities, stability
from .paths import Surroundings

NEAR = 1.0  # film temperature from which Newton's method takes over [K]
TOLERANCE = 1.0e-4  # of the film temperature [K]
CLEARANCE_TOLERANCE = 1.0e-10  # [m]
MOST_STEPS = 30  # of the film temperature alone: friction over it may fall and rise
LAST_STATES = 3  # that a step goes by: a parabola
# fraction of the tolerance that line and parabola may differ by where the last is unchecked:
# measured on 48 states of a 7012AC the parabola was better than that difference [-]; at most so
# far away, as without a limit bearings in the cold were taken for settled 20 K from their balance
# [K]
EXTRAPOLATION_ERROR = 0.1
EXTRAPOLATION_REACH = 0.02
NEWTON_STEPS = 8
# power of the viscosity that the friction goes with, for the first step: 0.37 to 0.46 in 24 of a
# 7012AC with films of the atlas [-]
POWER = 0.4
LARGEST_STEP = 25.0  # [K]
HOTTER = 10.0  # than a temperature at which the balls are not driven, where the search begins [K]
HALVINGS = 4  # of a step to where they are not driven
STEP = 0.5  # of the film temperature for differences [K]
CLEARANCE_STEP = 0.5e-6  # likewise [m]


@dataclass(frozen=True, slots=True, kw_only=True)
class SelfHeatingSolution:
    """Temperatures of a bearing heated by its own friction, or why there are none."""

    model: str  # of the friction torque
    around: Surroundings
    balance: HeatBalance | None  # None where the torque could not be computed
    state: HeatState | None = None  # the last one
    stability: Stability | None = None  # at the balance
    note: str = ""  # why there is no balance

    @property
    def converged(self) -> bool:
        """Friction and cooling agree."""
        return self.balance is not None and self.balance.converged

    @property
    def viscosity(self) -> float | None:
        """Viscosity of the oil in the films [Pa s]."""
        return None if self.state is None else self.state.viscosity

    @property
    def clearance(self) -> float | None:
        """On the diameter [m]."""
        return None if self.state is None else self.state.clearance

    @property
    def oil_heat(self) -> float | None:
        """Heat that the oil removes [W]."""
        if self.state is None:
            return None
        oil = float(self.state.temperatures[NODES.index("oil")])
        return self.around.oil_flow * (oil - self.around.oil_supply)

    @property
    def energy_error(self) -> float | None:
        """Heat left over on a node or in all, over the heat [-]."""
        if self.state is None:
            return None
        return self.state.network.imbalance(self.state.temperatures, self.state.sources)


class _Search:
    """States of one problem, counted."""

    def __init__(self, problem: SelfHeatingProblem) -> None:
        self.problem = problem
        self.fixed = problem.fixed_paths()
        self.count = 0
        self.floating = problem.reference is not None
        self.initial_guess = problem.start
        self.contacts = problem.contacts

    def at(self, film_temperature: float, clearance: float) -> HeatState:
        self.count += 1
        guess = None if self.initial_guess is None else (self.initial_guess, self.contacts)
        state = heat_state(self.problem, self.fixed, film_temperature, clearance, guess)
        self.initial_guess = state.solution
        self.contacts = state.contacts
        return state

    def slopes(self, state: HeatState) -> Slopes:
        """Differences of the state by film temperature and clearance."""
        warmer = self.at(state.film_temperature + STEP, state.clearance)
        wider = None
        if self.floating:
            wider = self.at(state.film_temperature, state.clearance + CLEARANCE_STEP)
        return Slopes(state=state, warmer=warmer, wider=wider)


def solve_self_heating(
    problem: SelfHeatingProblem, model: str, *, judged: bool = True
) -> SelfHeatingSolution:
    """Temperatures at which friction equals what surroundings and oil remove, or the reason why
    there are none.

    Parameters
    ----------
    problem : SelfHeatingProblem
        the bearing that warms itself
    model : str
        of the friction torque, for the result
    judged : bool, default True
        whether it is wanted how stable they are, which takes a state more. Without, and with a
        clearance that stays, the temperature of the balance may be that to which the last states
        lead; its torque is then that of the last one

    Returns
    -------
    SelfHeatingSolution
        temperatures [K]
    """
    around = problem.around
    try:
        search = _Search(problem)
        alone = not (judged or search.floating)
        start, temperature = _nearby(search, TOLERANCE if alone else NEAR)
        if temperature is None and start.film_temperature >= problem.hottest:
            return SelfHeatingSolution(
                model=model,
                around=around,
                balance=_balance(start, search, converged=False),
                state=start,
                note=_no_balance(problem.hottest),
            )
        if alone:
            return _of_temperature(model, search, start, temperature)
        state, slopes, converged = _converged_state(search, start)
        stable = _stability(problem, state, slopes) if judged else None
    except ValueError as error:
        return SelfHeatingSolution(model=model, around=around, balance=None, note=str(error))
    return SelfHeatingSolution(
        model=model,
        around=around,
        balance=_balance(state, search, converged=converged),
        state=state,
        stability=stable,
        note="" if converged else NOT_CONVERGED,
    )


def _of_temperature(
    model: str, search: _Search, state: HeatState, temperature: float | None
) -> SelfHeatingSolution:
    """The last state with the film temperature of the balance [K]; None where it is not known."""
    balance = _balance(state, search, converged=temperature is not None)
    if temperature is not None:
        balance = replace(balance, temperature=temperature)
    return SelfHeatingSolution(
        model=model,
        around=search.problem.around,
        balance=balance,
        state=state,
        note=NOT_CONVERGED if temperature is None else "",
    )


def _stability(problem: SelfHeatingProblem, state: HeatState, slopes: Slopes) -> Stability:
    """How a balance answers what disturbs it."""
    oil = problem.oil(state.film_temperature)
    known = (problem.bearing, problem.around, oil, problem.oil_share, len(problem.rows))
    return stability(slopes, problem, heat_capacities(*known), state.temperatures)


NOT_CONVERGED = "film temperature and clearance do not come to rest together"


def _no_balance(hottest: float) -> str:
    """Message that there is no balance up to a film temperature [K]."""
    return (
        "no balance: friction exceeds the cooling up to "
        f"{hottest - ZERO_CELSIUS:.0f} C, beyond the range of lubricants"
    )


def _balance(state: HeatState, search: _Search, *, converged: bool) -> HeatBalance:
    power = state.friction.power
    removed = state.network.removed(state.temperatures)
    return HeatBalance(
        temperature=float(state.film_temperature),
        torque=state.friction.torque,
        power=power,
        evaluations=search.count,
        residual=(power - removed) / power if power > 0.0 else 0.0,
        converged=converged,
        message="converged" if converged else _no_balance(search.problem.hottest),
    )


def _is_converged(residual: Array) -> bool:
    return bool(abs(residual[0]) <= TOLERANCE and abs(residual[1]) <= CLEARANCE_TOLERANCE)


def _nearby(search: _Search, tolerance: float) -> tuple[HeatState, float | None]:
    """A state at or near the balance, found by the film temperature alone: the clearance is that
    of the last state's temperatures, moved together; and the film temperature that is right to
    `tolerance` [K], None where it was not found. At the hottest one there is none.
    """
    problem = search.problem
    around = problem.around
    coldest = min(around.ambient, around.oil_supply)
    at = min(max(problem.operation.temperature, coldest), problem.hottest)
    state = _initial_state(search, at)
    at = state.film_temperature
    low: float | None = None
    high: float | None = None
    known: list[tuple[float, float]] = []  # temperatures and what is found above each [K]
    for _ in range(MOST_STEPS):
        excess = state.resulting_temperature - state.film_temperature
        if abs(excess) <= tolerance:
            return state, at
        low, high = (at, high) if excess > 0.0 else (low, at)
        if at >= problem.hottest and excess > 0.0:
            break
        known = [*known[1 - LAST_STATES :], (at, excess)]
        ahead = _extrapolated_root(known, tolerance)
        if ahead is not None and coldest <= ahead <= problem.hottest:
            return state, ahead
        wanted = _root(known)
        if wanted is None and len(known) > 1:
            wanted = at + _step(known)
        elif wanted is None:
            wanted = _by_viscosity(problem, state, coldest)
        at = _bounded_step(wanted, at, (low, high), (coldest, problem.hottest))
        state = _moved(search, state, at)
        at = state.film_temperature
    return state, None


def _initial_state(search: _Search, at: float) -> HeatState:
    """A state at a temperature, or at the next higher one at which thinner oil lets the races
    drive the balls [K].
    """
    places = [at, *np.arange(at + HOTTER, search.problem.hottest, HOTTER).tolist()]
    return _driven(search, places, lambda there: np.full(len(NODES), there))


def _moved(search: _Search, state: HeatState, at: float) -> HeatState:
    """A state at another temperature; where the balls are not driven there, at the next higher one
    at which they are, or, on the way down, before that [K]. Its clearance is that of the last
    state's temperatures, moved together.
    """
    before = state.film_temperature
    hottest = search.problem.hottest
    if at > before:
        places = [*np.arange(at, hottest, HOTTER).tolist(), hottest]
    else:
        places = [before + (at - before) * 0.5**k for k in range(HALVINGS + 1)]
    still = state.temperatures - state.resulting_temperature
    return _driven(search, places, lambda there: still + there)


def _driven(
    search: _Search, places: Sequence[float], temperatures: Callable[[float], Array]
) -> HeatState:
    """The state at the first of some film temperatures at which the balls are driven, its
    clearance by the temperatures of the nodes [K].
    """
    *others, last = places
    for at in others:
        try:
            return search.at(at, search.problem.clearance(temperatures(at)))
        except UndrivenBallsError:
            continue
    return search.at(last, search.problem.clearance(temperatures(last)))


def _by_viscosity(problem: SelfHeatingProblem, state: HeatState, coldest: float) -> float:
    """Temperature of the balance, at most a step away, if the heat of a state went with a power
    of the viscosity alone [K].
    """
    rise = max(state.resulting_temperature - coldest, 0.0)

    def surplus(at: float) -> float:
        thinner = problem.oil(at).viscosity / state.viscosity
        return coldest + rise * thinner**POWER - at

    low = max(state.film_temperature - LARGEST_STEP, coldest)
    high = min(state.film_temperature + LARGEST_STEP, problem.hottest)
    if surplus(low) <= 0.0:
        return low
    if surplus(high) >= 0.0:
        return high
    return float(scipy.optimize.brentq(surplus, low, high, xtol=0.1 * NEAR))


def _root(states: list[tuple[float, float]]) -> float | None:
    """Temperature [K] at which nothing is found above it, by the polynomial of temperatures over
    what was found at the last ones; None where that does not fall from one to the next.
    """
    whole = _crossing(states)
    return _crossing(states[-2:]) if whole is None else whole


def _step(states: list[tuple[float, float]]) -> float:
    """Twice the last step, or what is found above the last temperature if that is more, toward the
    balance: it lies beyond where what is found above does not fall [K].
    """
    (before, _), (at, excess) = states[-2:]
    return float(np.copysign(max(2.0 * abs(at - before), abs(excess)), excess))


def _extrapolated_root(states: list[tuple[float, float]], tolerance: float) -> float | None:
    """The root by a parabola where that by a line through its last two states, which is less
    exact, is not more than a part of `tolerance` from it; None elsewhere [K].
    """
    if len(states) < LAST_STATES:
        return None
    parabola = _crossing(states)
    line = _crossing(states[-2:])
    if parabola is None or line is None or abs(parabola - line) > EXTRAPOLATION_ERROR * tolerance:
        return None
    return parabola if abs(parabola - states[-1][0]) <= EXTRAPOLATION_REACH else None


def _crossing(states: list[tuple[float, float]]) -> float | None:
    """The root of `_root`, by the polynomial through all these states."""
    at, excess = np.array(sorted(states)).T
    if at.size > 1 and (np.diff(excess) < 0.0).all() and (np.diff(at) > 0.0).all():
        return float(lagrange_weights(excess, 0.0) @ at)
    return None


def _bounded_step(
    wanted: float, at: float, bracket: tuple[float | None, float | None], ends: tuple[float, float]
) -> float:
    """A step of at most `LARGEST_STEP` within what is known of the balance [K]."""
    low, high = bracket
    wanted = min(max(wanted, at - LARGEST_STEP), at + LARGEST_STEP)
    wanted = min(max(wanted, ends[0]), ends[1])
    if low is not None and high is not None and not low < wanted < high:
        wanted = 0.5 * (low + high)
    return wanted


def _converged_state(search: _Search, start: HeatState) -> tuple[HeatState, Slopes, bool]:
    """Newton's method from a state near the balance; where that does not lead to it, as where the
    friction rises and falls on the way, from one that is right in its film temperature.
    """
    state, slopes, converged = _newton(search, start)
    if converged:
        return state, slopes, converged
    return _newton(search, _nearby(search, TOLERANCE)[0])


def _newton(search: _Search, state: HeatState) -> tuple[HeatState, Slopes, bool]:
    """Both numbers together, the slopes near them, and whether they are at rest: so is the film
    temperature alone where its step is not more than `SelfHeatingProblem.enough`.
    """
    slopes = search.slopes(state)
    matrix = _matrix(search.problem.disagreement, slopes)
    residual = search.problem.disagreement(state)
    for _ in range(NEWTON_STEPS):
        if _is_converged(residual):
            break
        step = np.asarray(-np.linalg.solve(matrix, residual), dtype=np.float64)
        if not search.floating and abs(step[0]) <= search.problem.enough:
            return state, slopes, True
        step *= min(1.0, LARGEST_STEP / max(abs(step[0]), 1e-30))
        state = search.at(
            min(state.film_temperature + step[0], search.problem.hottest),
            state.clearance + step[1],
        )
        after = search.problem.disagreement(state)
        scales = (STEP, CLEARANCE_STEP)
        matrix = broyden(matrix, step, after - residual, scales)
        residual = after
    return state, slopes, _is_converged(residual)


def _matrix(residual: Callable[[HeatState], Array], slopes: Slopes) -> Array:
    """Derivatives of the residual by film temperature and clearance (2, 2)."""
    here = residual(slopes.state)
    warmer = (residual(slopes.warmer) - here) / STEP
    if slopes.wider is None:
        return np.array([[warmer[0], 0.0], [warmer[1], -1.0]])
    wider = (residual(slopes.wider) - here) / CLEARANCE_STEP
    return np.stack([warmer, wider], axis=1)
