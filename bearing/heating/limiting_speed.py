r"""Balances of heat over the speed, and the speed above which there is none.

The balances at given loads are a branch of speed n, film temperature and clearance,

.. math:: T_f'(n, T_f, P_d) = T_f, \qquad P_d'(n, T_f, P_d) = P_d .

More speed makes more heat, so that to each film temperature belongs one speed; not the other way
round: where n(T_f) turns back, a little more speed leaves no balance nearby, and there the margin
against runaway is zero. The branch is followed by film temperature, n and P_d by Newton's method
with Broyden's updates, and its turn bounds the speed. A branch that does not turn ends where the
temperature leaves the range of lubricants.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import exp, log

import numpy as np

from ..geometry import Array
from .heat_state import HeatState, SelfHeatingProblem, broyden, heat_state

STEP = 8.0  # of the film temperature along the branch [K]
SMALLEST_STEP = 0.5  # below which the branch is given up [K]
TEMPERATURE_TOLERANCE = 0.01  # [K]
CLEARANCE_TOLERANCE = 1.0e-9  # [m]
ITERATIONS = 8
DIFFERENCES = (0.01, 0.5e-6)  # of ln n [-] and of the clearance [m]
LARGEST_RATIO = 2.0  # of speeds in one iteration
SLOWEST = 0.1  # of the speed it starts from: where the branch begins
TURN_TOLERANCE = 0.5  # of the film temperature at the turn, about which the speed is flat [K]
TURN_STEPS = 3  # of the parabola through the fastest balances
MOST_FACTOR = 30.0  # of the speed it starts from: where the branch is no longer followed

TURNED = "runaway"
TOO_WARM = "temperature"
NO_STATE = "no state"
FAST_ENOUGH = "not reached"


@dataclass(frozen=True, slots=True, kw_only=True)
class SpeedBalance:
    """Friction and cooling in balance at one speed."""

    factor: float  # on the speeds of the problem [-]
    speed: float  # of the shaft [rad/s]
    state: HeatState


@dataclass(frozen=True, slots=True, kw_only=True)
class SpeedBranch:
    """Balances by rising film temperature, and what bounds their speed."""

    balances: tuple[SpeedBalance, ...]
    # `runaway`, `temperature`: the highest one; `no state`: see `message`; `not reached`
    limited_by: str
    message: str = ""

    @property
    def fastest(self) -> SpeedBalance:
        """Of the highest speed."""
        return max(self.balances, key=lambda balance: balance.speed)

    @property
    def limit(self) -> float | None:
        """Speed of the shaft that bounds the balances [rad/s]; None where none was found."""
        return self.fastest.speed if self.limited_by in (TURNED, TOO_WARM) else None


@dataclass(slots=True)
class _Newton:
    """Speed and clearance at a film temperature, with the matrix of the last one."""

    problem: SelfHeatingProblem
    matrix: Array | None = None  # of the residual by ln n [K] and P_d, (2, 2)

    def state(self, film_temperature: float, at: Array) -> HeatState:
        """At ln n, of the factor, and clearance [m]."""
        scaled = at_speed(self.problem, exp(at[0]))
        return heat_state(scaled, scaled.fixed_paths(), film_temperature, float(at[1]))

    def residual(self, state: HeatState, at: Array) -> Array:
        """T_f' - T_f [K], P_d' - P_d [m]."""
        return at_speed(self.problem, exp(at[0])).disagreement(state)

    def solve(self, film_temperature: float, guess: Array) -> tuple[Array, HeatState] | None:
        """ln n and clearance of the balance near a guess; None where none is found."""
        at = guess.copy()
        state = self.state(film_temperature, at)
        residual = self.residual(state, at)
        if self.matrix is None:
            self.matrix = self._differences(film_temperature, at, residual)
        for _ in range(ITERATIONS):
            if _settled(residual):
                return at, state
            step = np.asarray(-np.linalg.solve(self.matrix, residual), dtype=np.float64)
            step *= min(1.0, log(LARGEST_RATIO) / max(abs(step[0]), 1e-30))
            at = at + step
            state = self.state(film_temperature, at)
            after = self.residual(state, at)
            self.matrix = broyden(self.matrix, step, after - residual, DIFFERENCES)
            residual = after
        return (at, state) if _settled(residual) else None

    def _differences(self, film_temperature: float, at: Array, here: Array) -> Array:
        columns = []
        for k, step in enumerate(DIFFERENCES):
            if k == 1 and self.problem.reference is None:
                columns.append(np.array([0.0, -1.0]))
                continue
            moved = at + step * np.eye(2)[k]
            beyond = self.residual(self.state(film_temperature, moved), moved)
            columns.append((beyond - here) / step)
        return np.stack(columns, axis=1)


def at_speed(problem: SelfHeatingProblem, factor: float) -> SelfHeatingProblem:
    """The problem with both rings `factor` times as fast [-]."""
    old = problem.operation
    inner, outer = factor * old.inner_speed, factor * old.outer_speed
    return replace(problem, operation=replace(old, inner_speed=inner, outer_speed=outer))


def balances_over_speed(
    problem: SelfHeatingProblem,
    start: HeatState,
    notify: Callable[[float], None] = lambda temperature: None,
) -> SpeedBranch:
    """The branch through a balance of the problem, from slow balances to what bounds the speed.

    `notify` is called with each film temperature reached [K].

    Raises
    ------
    ValueError
        If the start is no balance.
    """
    if not abs(start.found_temperature - start.film_temperature) <= TEMPERATURE_TOLERANCE:
        raise ValueError("the branch must start from a balance of friction and cooling")
    newton = _Newton(problem)
    first = _Place(start.film_temperature, np.array([0.0, start.clearance]), start)
    below, _, _ = _follow(newton, first, -1.0, notify)
    above, reason, message = _follow(newton, first, 1.0, notify)
    places = [*reversed(below), first, *above]
    if reason == TURNED:
        places = _with_turn(newton, places)
    speed = problem.operation.shaft_speed
    return SpeedBranch(
        balances=tuple(
            SpeedBalance(factor=exp(p.at[0]), speed=exp(p.at[0]) * speed, state=p.state)
            for p in places
        ),
        limited_by=reason,
        message=message,
    )


@dataclass(frozen=True, slots=True)
class _Place:
    """A balance on the branch."""

    temperature: float  # of the films [K]
    at: Array  # ln of the factor on the speed [-], clearance [m]
    state: HeatState


def _follow(
    newton: _Newton, first: _Place, sign: float, notify: Callable[[float], None]
) -> tuple[list[_Place], str, str]:
    """Balances from the first on, upwards or downwards, why they end, and a message."""
    problem = newton.problem
    coldest = min(problem.around.ambient, problem.around.oil_supply)
    places = [first]
    step = STEP
    message = ""
    while step >= SMALLEST_STEP:
        last = places[-1]
        wanted = last.temperature + sign * step
        if sign < 0.0:
            wanted = max(wanted, 0.5 * (coldest + last.temperature))
        wanted = min(wanted, problem.hottest)
        try:
            found = newton.solve(wanted, _ahead(places, wanted))
        except ValueError as error:
            found = None
            message = str(error)
        if found is None:
            step *= 0.5
            newton.matrix = None
            continue
        notify(wanted)
        places.append(_Place(wanted, *found))
        step = min(2.0 * step, STEP)
        factor = found[0][0]
        if sign > 0.0 and factor < last.at[0]:
            return places[1:], TURNED, ""
        if sign > 0.0 and wanted >= problem.hottest:
            return places[1:], TOO_WARM, ""
        if factor > log(MOST_FACTOR):
            return places[1:], FAST_ENOUGH, ""
        if sign < 0.0 and factor < log(SLOWEST):
            break
    return places[1:], NO_STATE, message


def _ahead(places: list[_Place], temperature: float) -> Array:
    """ln n and clearance at a film temperature by the last balances."""
    last = places[-1]
    if len(places) < 2:
        return last.at
    before = places[-2]
    share = (temperature - last.temperature) / (last.temperature - before.temperature)
    return np.asarray(last.at + share * (last.at - before.at))


def _with_turn(newton: _Newton, places: list[_Place]) -> list[_Place]:
    """The balances with those about the turn of the speed, by parabolas."""
    for _ in range(TURN_STEPS):
        top = max(range(len(places)), key=lambda k: places[k].at[0])
        if not 0 < top < len(places) - 1:
            break
        near = places[top - 1 : top + 2]
        known = [place.temperature for place in near]
        wanted = _vertex(known, [place.at[0] for place in near])
        if min(abs(wanted - temperature) for temperature in known) < TURN_TOLERANCE:
            break
        guess = [np.interp(wanted, known, [place.at[k] for place in near]) for k in range(2)]
        found = newton.solve(wanted, np.array(guess))
        if found is None:
            break
        places = sorted([*places, _Place(wanted, *found)], key=lambda place: place.temperature)
    return places


def _vertex(x: list[float], y: list[float]) -> float:
    """Of the parabola through three places, the middle one the highest."""
    before = (y[1] - y[0]) / (x[1] - x[0])
    after = (y[2] - y[1]) / (x[2] - x[1])
    curvature = (after - before) / (x[2] - x[0])
    return 0.5 * (x[0] + x[1] - before / curvature)


def _settled(residual: Array) -> bool:
    return bool(
        abs(residual[0]) <= TEMPERATURE_TOLERANCE and abs(residual[1]) <= CLEARANCE_TOLERANCE
    )
