"""Self-heating: heat to temperatures of the parts, to viscosity and clearance, to loads, films and
friction, to heat.

Friction depends on the temperatures by two numbers, that of the films T_f = w T and the clearance
P_d(T): at both of them the equilibrium is solved, its friction is spread over the nodes, and the
network gives the temperatures T', and with them T_f' and P_d'. Wanted is T_f' = T_f, P_d' = P_d.

There may be several such balances. The excess e(T_f) = T_f' - T_f is looked at from the coldest
surroundings to the hottest film, and between two states as well where it turns towards zero; each
change of its sign is a balance, a stable one where e falls. A bearing that warms up from ambient
goes up where e > 0, down where e < 0, and stays at the next balance: that one is refined, by
parabolas on T_f, then by Newton's method on both numbers with differences as its matrix, which
gives the stability as well; without that, and the clearance, parabolas go on.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from oilfilm.ehl.arrays import Array, lagrange_weights
from oilfilm.ehl.units import ZERO_CELSIUS

from .heat_state import HeatState, SelfHeatingProblem, broyden, heat_state
from .limits import HeatBalance
from .network import NODES
from .over_time import Slopes, Stability, heat_capacities, stability
from .paths import Surroundings, oil_path

# film temperature about the balance where Newton's method takes over [K]: ranges and margins are
# of the slopes there, and 1 K moved them by 0.2 K in a 6208
NEAR = 0.02
TOLERANCE = 1.0e-4  # of the film temperature [K]
CLEARANCE_TOLERANCE = 1.0e-10  # [m]
MOST_STEPS = 30  # of the film temperature alone between two states of a balance
SCAN_STEP = 8.0  # of the film temperature in search of all balances, at least [K]
WIDEST = 32.0  # such a step at most [K]
# bend of the excess between two states that is looked for over that through the states beside [-]
BEND = 4.0
TURN_STEPS = 4  # of a parabola to where the excess turns between two states
BALANCE_TOLERANCE = 0.02  # of balances that a warm-up does not reach [K]
LAST_STATES = 3  # that a step goes by: a parabola
# fraction of the tolerance that line and parabola may differ by where the last is unchecked:
# measured on 48 states of a 7012AC the parabola was better than that difference [-]; at most so
# far away, as without a limit bearings in the cold were taken for settled 20 K from their balance
# [K]
EXTRAPOLATION_ERROR = 0.1
EXTRAPOLATION_REACH = 0.02
NEWTON_STEPS = 8
LARGEST_STEP = 25.0  # [K]
STEP = 0.5  # of the film temperature for differences [K]
CLEARANCE_STEP = 0.5e-6  # likewise [m]


@dataclass(frozen=True, slots=True, kw_only=True)
class FoundBalance:
    """One of the balances of friction and cooling."""

    temperature: float  # of the films [K]
    torque: float  # [N m]
    stable: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class SelfHeatingSolution:
    """Temperatures of a bearing heated by its own friction, or why there are none."""

    model: str  # of the friction torque
    around: Surroundings
    balance: HeatBalance | None  # None where the torque could not be computed
    state: HeatState | None = None  # the last one
    stability: Stability | None = None  # at the balance
    note: str = ""  # why there is no balance
    # all balances up to the hottest films, by their temperature; the one above is that of a
    # warm-up from ambient
    balances: tuple[FoundBalance, ...] = ()

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
        return oil_path(self.around.oil_flow).conductance.value * (oil - self.around.oil_supply)

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
        start, temperature, others = _nearby(search, TOLERANCE if alone else NEAR)
        if temperature is None and start.film_temperature >= problem.hottest:
            return SelfHeatingSolution(
                model=model,
                around=around,
                balance=_balance(start, search, converged=False),
                state=start,
                note=_no_balance(problem.hottest),
                balances=others,
            )
        if alone:
            return _of_temperature(model, search, start, temperature, others)
        state, slopes, converged = _newton(search, start)
        stable = _stability(problem, state, slopes) if judged else None
    except ValueError as error:
        return SelfHeatingSolution(model=model, around=around, balance=None, note=str(error))
    balance = _balance(state, search, converged=converged)
    return SelfHeatingSolution(
        model=model,
        around=around,
        balance=balance,
        state=state,
        stability=stable,
        note="" if converged else NOT_CONVERGED,
        balances=with_refined(others, balance),
    )


def with_refined(
    balances: tuple[FoundBalance, ...], refined: HeatBalance
) -> tuple[FoundBalance, ...]:
    """Balances with temperature and torque of the one that was refined, the nearest of them.

    Parameters
    ----------
    balances : tuple of FoundBalance
        As found.
    refined : HeatBalance
        The one that a warm-up reaches.

    Returns
    -------
    tuple of FoundBalance
        As many; as they were where the refined one did not converge.
    """
    if not balances or not refined.converged:
        return balances
    near = min(balances, key=lambda one: abs(one.temperature - refined.temperature))
    better = replace(near, temperature=refined.temperature, torque=refined.torque)
    return tuple(better if one is near else one for one in balances)


def _of_temperature(
    model: str,
    search: _Search,
    state: HeatState,
    temperature: float | None,
    balances: tuple[FoundBalance, ...],
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
        balances=with_refined(balances, balance),
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


def _excess(state: HeatState) -> float:
    """Film temperature that follows less that of the state [K]: zero in a balance."""
    return state.resulting_temperature - state.film_temperature


def _nearby(
    search: _Search, tolerance: float
) -> tuple[HeatState, float | None, tuple[FoundBalance, ...]]:
    """A state at or near the balance that a warm-up from ambient reaches, the film temperature
    that is right to `tolerance` [K], and all balances. The temperature is None where it was not
    found; the state is then the hottest one where there is no balance.
    """
    problem = search.problem
    if problem.enough:  # begun at the balance of a search before
        state = _state(search, problem.operation.temperature, None)
        if abs(_excess(state)) <= tolerance:
            return state, state.film_temperature, ()
    states = _about(search) or _scan(search)
    brackets = [
        (low, high)
        for low, high in zip(states, states[1:], strict=False)
        if (_excess(low) > 0.0) != (_excess(high) > 0.0)
    ]
    reached = _reached(problem.around.ambient, states, brackets)
    others = tuple(
        _found(search, bracket, BALANCE_TOLERANCE)
        for bracket in brackets
        if bracket is not reached
    )
    if reached is None:
        return states[-1 if _excess(states[-1]) > 0.0 else 0], None, others
    state, temperature = _between(search, reached, tolerance)
    known = (*others, _listed(reached, state, temperature))
    return state, temperature, tuple(sorted(known, key=lambda one: one.temperature))


_Bracket = tuple[HeatState, HeatState]  # on both sides of a balance, the colder first


def _reached(
    ambient: float, states: Sequence[HeatState], brackets: Sequence[_Bracket]
) -> _Bracket | None:
    """The balance at which a warm-up from ambient [K] ends; None where it finds none."""
    first = min(states, key=lambda state: abs(state.film_temperature - ambient))
    if _excess(first) > 0.0:
        above = (pair for pair in brackets if pair[0].film_temperature >= first.film_temperature)
        return next(above, None)
    below = [pair for pair in brackets if pair[1].film_temperature <= first.film_temperature]
    return below[-1] if below else None


def _found(search: _Search, bracket: _Bracket, tolerance: float) -> FoundBalance:
    """The balance between two states."""
    return _listed(bracket, *_between(search, bracket, tolerance))


def _listed(bracket: _Bracket, state: HeatState, temperature: float | None) -> FoundBalance:
    """A balance, stable where the excess falls from the one side of it to the other."""
    at = state.film_temperature if temperature is None else temperature
    stable = _excess(bracket[0]) > 0.0
    return FoundBalance(temperature=at, torque=state.friction.torque, stable=stable)


def _scan(search: _Search) -> list[HeatState]:
    """States from the coldest surroundings to the hottest films by rising temperature, closer to
    each other where the excess passes zero or may do so between them; without those whose balls
    are not driven, or that have no equilibrium.
    """
    around = search.problem.around
    hottest = search.problem.hottest
    coldest = min(around.ambient, around.oil_supply, hottest)
    count = int(np.ceil((hottest - coldest) / WIDEST)) + 1
    places = {*np.linspace(coldest, hottest, count).tolist(), min(around.ambient, hottest)}
    states: list[HeatState] = []
    lack: ValueError | None = None
    tried: set[float] = set()
    while places:
        for at in sorted(places):
            near = min(states, key=lambda one: abs(one.film_temperature - at), default=None)
            try:
                states.append(_state(search, at, near))
            except ValueError as error:
                lack = error
        tried |= places
        states.sort(key=lambda one: one.film_temperature)
        places = _between_which_zero_may_lie(states) - tried
    if not states:
        raise lack or ValueError(_no_balance(hottest))
    for n in range(len(states) - 2, 0, -1):
        states[n : n + 1] = _turn(search, *states[n - 1 : n + 2])
    return states


def _between_which_zero_may_lie(states: Sequence[HeatState]) -> set[float]:
    """Film temperatures in the middle between states where the excess passes zero, or comes so
    near it that a bend may hide two balances [K].
    """
    at = np.array([one.film_temperature for one in states])
    excess = np.array([_excess(one) for one in states])
    if at.size < 2:
        return set()
    step = np.diff(at)
    # parabolas through three states beside each other
    bend = np.abs(np.diff(np.diff(excess) / step)) / (at[2:] - at[:-2])
    bend = np.concatenate([[0.0], bend, [0.0]])
    hidden = BEND * np.maximum(bend[1:], bend[:-1]) * step**2 / 4.0
    nearest = np.minimum(np.abs(excess[1:]), np.abs(excess[:-1]))
    passes = excess[1:] * excess[:-1] <= 0.0
    wanted = (step > SCAN_STEP) & (passes | (nearest <= hidden))
    return {float(middle) for middle in (0.5 * (at[1:] + at[:-1]))[wanted]}


def _about(search: _Search) -> list[HeatState]:
    """States on both sides of the stable balance about the temperature expected, by rising
    temperature; none where it is not expected, or not found.
    """
    expected = search.problem.expected
    if expected is None:
        return []
    around = search.problem.around
    coldest = min(around.ambient, around.oil_supply)
    hottest = search.problem.hottest
    step = 2.0 * STEP
    try:
        states = [_state(search, expected, None)]
        sign = 1.0 if _excess(states[0]) > 0.0 else -1.0
        while sign * _excess(states[-1]) > 0.0:
            at = states[-1].film_temperature + sign * step
            if not coldest <= at <= hottest:
                return []
            states.append(_state(search, at, states[-1]))
            step *= 2.0
    except ValueError:  # balls that are not driven, or no equilibrium
        return []
    return sorted(states[-2:], key=lambda state: state.film_temperature)


def _turn(
    search: _Search, before: HeatState, state: HeatState, after: HeatState
) -> list[HeatState]:
    """A state between two others, with those at which the excess, which turns near it towards
    zero, passes zero or comes nearest.
    """
    sign = 1.0 if _excess(state) > 0.0 else -1.0
    triple = [before, state, after]
    for _ in range(TURN_STEPS):
        at = [one.film_temperature for one in triple]
        excess = [sign * _excess(one) for one in triple]
        if not excess[0] >= excess[1] <= excess[2]:
            break
        vertex = _vertex(at, excess)
        if min(abs(vertex - one) for one in at) < STEP:
            break
        try:
            new = _state(search, vertex, state)
        except ValueError:
            break
        if sign * _excess(new) <= 0.0:
            return sorted([state, new], key=lambda one: one.film_temperature)
        ordered = sorted([*triple, new], key=lambda one: one.film_temperature)
        least = min(range(1, 3), key=lambda n: sign * _excess(ordered[n]))
        triple = ordered[least - 1 : least + 2]
    return [state]


def _vertex(x: Sequence[float], y: Sequence[float]) -> float:
    """Vertex of the parabola through three points of which the middle one is the lowest, inside
    them.
    """
    before = (y[1] - y[0]) / (x[1] - x[0])
    after = (y[2] - y[1]) / (x[2] - x[1])
    curvature = (after - before) / (x[2] - x[0])
    vertex = 0.5 * (x[0] + x[1]) - 0.5 * before / curvature if curvature > 0.0 else x[1]
    return min(max(vertex, x[0]), x[2])


def _state(search: _Search, at: float, near: HeatState | None) -> HeatState:
    """The state at a film temperature [K]; its clearance is that of the temperatures of a state
    nearby, moved together, or of one temperature.
    """
    still = 0.0 if near is None else near.temperatures - near.resulting_temperature
    return search.at(at, search.problem.clearance(still + np.full(len(NODES), at)))


def _between(
    search: _Search, bracket: _Bracket, tolerance: float
) -> tuple[HeatState, float | None]:
    """A state at or near the balance between two others, found by the film temperature alone: the
    clearance is that of the last state's temperatures, moved together; and the film temperature
    that is right to `tolerance` [K], None where it was not found.
    """
    low, high = (state.film_temperature for state in bracket)
    known = [(state.film_temperature, _excess(state)) for state in bracket]
    state = min(bracket, key=lambda one: abs(_excess(one)))
    rising = known[1][1] > 0.0
    for _ in range(MOST_STEPS):
        if abs(_excess(state)) <= tolerance:
            return state, state.film_temperature
        ahead = _extrapolated_root(known, tolerance)
        if ahead is not None and low <= ahead <= high:
            return state, ahead
        wanted = _root(known)
        if wanted is None or not low < wanted < high:
            wanted = 0.5 * (low + high)
        state = _state(search, wanted, state)
        excess = _excess(state)
        low, high = (low, wanted) if (excess > 0.0) == rising else (wanted, high)
        known = [*known[1 - LAST_STATES :], (wanted, excess)]
    return state, None


def _root(states: list[tuple[float, float]]) -> float | None:
    """Temperature [K] at which the excess is zero, by the polynomial of temperatures over that of
    the last ones; None where it neither rises nor falls all along.
    """
    whole = _crossing(states)
    return _crossing(states[-2:]) if whole is None else whole


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
    slope = np.diff(excess) if at.size > 1 else np.zeros(1)
    if ((slope < 0.0).all() or (slope > 0.0).all()) and (np.diff(at) > 0.0).all():
        return float(lagrange_weights(excess, 0.0) @ at)
    return None


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
