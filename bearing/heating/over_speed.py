r"""Balances of heat over the speed, the speed above which there is none, and the least cooling
that keeps a bearing below a temperature.

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
from enum import Enum
from math import exp, log

import numpy as np

from oilfilm.ehl.arrays import Array

from .heat_state import HeatState, SelfHeatingProblem, broyden, heat_state
from .network import AMBIENT, OIL_SUPPLY, HeatPath
from .paths import oil_path

STEP = 8.0  # of the film temperature along the branch [K]
SMALLEST_STEP = 0.5  # of the continuation, below which it ends [K]
TEMPERATURE_TOLERANCE = 0.01  # [K]
CLEARANCE_TOLERANCE = 1.0e-9  # [m]
ITERATIONS = 8
DIFFERENCES = (0.01, 0.5e-6)  # of ln n [-] and of the clearance [m]
LARGEST_RATIO = 2.0  # of speeds in one iteration
LARGEST_SHIFT = 0.1  # of ln n, of the first balance from the speed of the case [-]
FIRST_SHIFTS = (0.0, 1.0, -1.0, 3.0, -3.0)  # of its temperature [K]
SLOWEST = 0.1  # of the speed it starts from: where the branch begins
TURN_TOLERANCE = 0.5  # of the film temperature at the turn, about which the speed is flat [K]
TURN_STEPS = 3  # of the parabola through the fastest balances
LARGEST_FACTOR = 30.0  # of the speed it starts from: where the branch is no longer followed

LARGEST_CONDUCTANCE = 1.0e5  # end of the search [W/K]
SMALLEST_FLOW = 1.0e-3  # its beginning for oil that passes through [W/K]
TOLERANCE = 1.0e-3  # of a conductance [-]


class SpeedLimit(Enum):
    """End of a branch of balances.

    RUNAWAY: its highest speed; TEMPERATURE: the highest temperature of the films; NO_STATE: no
    equilibrium or friction beyond; NOT_REACHED: the end of the search.
    """

    RUNAWAY = "runaway"
    TEMPERATURE = "temperature"
    NO_STATE = "no state"
    NOT_REACHED = "not reached"


@dataclass(frozen=True, slots=True, kw_only=True)
class SpeedBalance:
    """Friction and cooling in balance at one speed."""

    factor: float  # on the speeds of the problem [-]
    speed: float  # of the shaft [rad/s]
    state: HeatState


@dataclass(frozen=True, slots=True, kw_only=True)
class SpeedBranch:
    """Balances by rising film temperature, and the end of their branch."""

    balances: tuple[SpeedBalance, ...]
    limited_by: SpeedLimit
    message: str = ""  # of NO_STATE

    @property
    def fastest(self) -> SpeedBalance:
        """Balance of the highest speed."""
        return max(self.balances, key=lambda balance: balance.speed)

    @property
    def limit(self) -> float | None:
        """Speed of the shaft that bounds the balances [rad/s]; None if no bound was reached."""
        bounded = self.limited_by in (SpeedLimit.RUNAWAY, SpeedLimit.TEMPERATURE)
        return self.fastest.speed if bounded else None


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
        """ln n and clearance of the balance from a guess; None if the iterations fail."""
        at = guess.copy()
        state = self.state(film_temperature, at)
        residual = self.residual(state, at)
        if self.matrix is None:
            self.matrix = self._differences(film_temperature, at, residual)
        for _ in range(ITERATIONS):
            if _converged(residual):
                return at, state
            step = np.asarray(-np.linalg.solve(self.matrix, residual), dtype=np.float64)
            step *= min(1.0, log(LARGEST_RATIO) / max(abs(step[0]), 1e-30))
            at = at + step
            state = self.state(film_temperature, at)
            changed = self.residual(state, at)
            self.matrix = broyden(self.matrix, step, changed - residual, DIFFERENCES)
            residual = changed
        return (at, state) if _converged(residual) else None

    def _differences(self, film_temperature: float, at: Array, residual: Array) -> Array:
        columns = []
        for k, step in enumerate(DIFFERENCES):
            if k == 1 and self.problem.reference is None:
                columns.append(np.array([0.0, -1.0]))
                continue
            shifted = at + step * np.eye(2)[k]
            beyond = self.residual(self.state(film_temperature, shifted), shifted)
            columns.append((beyond - residual) / step)
        return np.stack(columns, axis=1)


def at_speed(problem: SelfHeatingProblem, factor: float) -> SelfHeatingProblem:
    """The problem with both rings faster by a factor.

    Parameters
    ----------
    problem : SelfHeatingProblem
        bearing, friction and surroundings
    factor : float
        factor on the speeds [-]

    Returns
    -------
    SelfHeatingProblem
        changed problem
    """
    old = problem.operation
    inner, outer = factor * old.inner_speed, factor * old.outer_speed
    return replace(problem, operation=replace(old, inner_speed=inner, outer_speed=outer))


def balances_over_speed(
    problem: SelfHeatingProblem,
    start: HeatState,
    notify: Callable[[float], None] = lambda temperature: None,
) -> SpeedBranch:
    """The branch through a balance of the problem, from slow balances to the end of the branch.

    Parameters
    ----------
    problem : SelfHeatingProblem
        bearing, friction and surroundings
    start : HeatState
        a balance of friction and cooling
    notify : Callable[[float], None], default lambda temperature: None
        called with each film temperature reached [K]

    Returns
    -------
    SpeedBranch
        balances by rising film temperature

    Raises
    ------
    ValueError
        if the start is no balance
    """
    newton = _Newton(problem)
    first = _first_point(newton, start)
    below, _, _ = _follow(newton, first, -1.0, notify)
    above, reason, message = _follow(newton, first, 1.0, notify)
    points = [*reversed(below), first, *above]
    if reason is SpeedLimit.RUNAWAY:
        points = _with_turning_point(newton, points)
    speed = problem.operation.shaft_speed
    return SpeedBranch(
        balances=tuple(
            SpeedBalance(factor=exp(p.at[0]), speed=exp(p.at[0]) * speed, state=p.state)
            for p in points
        ),
        limited_by=reason,
        message=message,
    )


@dataclass(frozen=True, slots=True)
class _BranchPoint:
    """A balance on the branch."""

    temperature: float  # of the films [K]
    at: Array  # ln of the factor on the speed [-], clearance [m]
    state: HeatState


def _first_point(newton: _Newton, start: HeatState) -> _BranchPoint:
    """The balance at the start, or, where the films leave a little of it, one at a temperature
    and a speed beside it.
    """
    at = np.array([0.0, start.clearance])
    if abs(start.resulting_temperature - start.film_temperature) <= TEMPERATURE_TOLERANCE:
        return _BranchPoint(start.film_temperature, at, start)
    for beside in FIRST_SHIFTS:
        temperature = start.film_temperature + beside
        try:
            found = newton.solve(temperature, at)
        except ValueError:  # no equilibrium of the ring on the way
            found = None
        if found is not None and abs(found[0][0]) <= LARGEST_SHIFT:
            return _BranchPoint(temperature, *found)
        newton.matrix = None
    raise ValueError("no steady temperature near the speed of the case")


def _follow(
    newton: _Newton, first: _BranchPoint, sign: float, notify: Callable[[float], None]
) -> tuple[list[_BranchPoint], SpeedLimit, str]:
    """Balances from the first on, upwards or downwards, the end of the branch, and a message."""
    problem = newton.problem
    coldest = min(problem.around.ambient, problem.around.oil_supply)
    points = [first]
    step = STEP
    message = ""
    while step >= SMALLEST_STEP:
        last = points[-1]
        target = last.temperature + sign * step
        if sign < 0.0:
            target = max(target, 0.5 * (coldest + last.temperature))
        target = min(target, problem.hottest)
        try:
            result = newton.solve(target, _extrapolated(points, target))
        except ValueError as error:
            result = None
            message = str(error)
        if result is None:
            step *= 0.5
            newton.matrix = None
            continue
        notify(target)
        points.append(_BranchPoint(target, *result))
        step = min(2.0 * step, STEP)
        factor = result[0][0]
        if sign > 0.0 and factor < last.at[0]:
            return points[1:], SpeedLimit.RUNAWAY, ""
        if sign > 0.0 and target >= problem.hottest:
            return points[1:], SpeedLimit.TEMPERATURE, ""
        if factor > log(LARGEST_FACTOR):
            return points[1:], SpeedLimit.NOT_REACHED, ""
        if sign < 0.0 and factor < log(SLOWEST):
            break
    return points[1:], SpeedLimit.NO_STATE, message


def _extrapolated(points: list[_BranchPoint], temperature: float) -> Array:
    """ln n and clearance at a film temperature by the last balances."""
    last = points[-1]
    if len(points) < 2:
        return last.at
    before = points[-2]
    fraction = (temperature - last.temperature) / (last.temperature - before.temperature)
    return np.asarray(last.at + fraction * (last.at - before.at))


def _with_turning_point(newton: _Newton, points: list[_BranchPoint]) -> list[_BranchPoint]:
    """The balances with those about the turn of the speed, by parabolas."""
    for _ in range(TURN_STEPS):
        top = max(range(len(points)), key=lambda k: points[k].at[0])
        if not 0 < top < len(points) - 1:
            break
        neighbours = points[top - 1 : top + 2]
        temperatures = [point.temperature for point in neighbours]
        target = _vertex(temperatures, [point.at[0] for point in neighbours])
        if min(abs(target - temperature) for temperature in temperatures) < TURN_TOLERANCE:
            break
        guess = [
            np.interp(target, temperatures, [point.at[k] for point in neighbours])
            for k in range(2)
        ]
        result = newton.solve(target, np.array(guess))
        if result is None:
            break
        points = sorted(
            [*points, _BranchPoint(target, *result)], key=lambda point: point.temperature
        )
    return points


def _vertex(x: list[float], y: list[float]) -> float:
    """Vertex of the parabola through three points, the middle one the highest."""
    before = (y[1] - y[0]) / (x[1] - x[0])
    after = (y[2] - y[1]) / (x[2] - x[1])
    curvature = (after - before) / (x[2] - x[0])
    return 0.5 * (x[0] + x[1] - before / curvature)


def _converged(residual: Array) -> bool:
    return bool(
        abs(residual[0]) <= TEMPERATURE_TOLERANCE and abs(residual[1]) <= CLEARANCE_TOLERANCE
    )


def required_heat_transfer(state: HeatState) -> float | None:
    """Conductance of shaft and housing together to the surroundings that the friction needs.

    The film temperature is then that of the state.

    Parameters
    ----------
    state : HeatState
        Friction and network at the highest permissible film temperature.

    Returns
    -------
    float | None
        Conductance [W/K]; None if no conductance is enough, because the heat does not get so far.
    """
    total = sum(path.conductance.value for path in state.network.paths if _is_surface(path))
    if total <= 0.0:
        return None

    def with_total(conductance: float) -> tuple[HeatPath, ...]:
        factor = conductance / total
        return tuple(
            replace(path, conductance=path.conductance.times(factor))
            if _is_surface(path)
            else path
            for path in state.network.paths
        )

    return _required(state, with_total, total)


def required_oil_flow(state: HeatState) -> float | None:
    """Heat capacity flow rho c V of oil through the bearing that the friction needs.

    Parameters
    ----------
    state : HeatState
        Friction and network at the highest permissible film temperature.

    Returns
    -------
    float | None
        rho c V [W/K]; None if no flow is enough.
    """
    others = tuple(path for path in state.network.paths if path.second != OIL_SUPPLY)

    def with_flow(conductance: float) -> tuple[HeatPath, ...]:
        return (*others, oil_path(conductance))

    return _required(state, with_flow, SMALLEST_FLOW)


def _is_surface(path: HeatPath) -> bool:
    """True for a path from shaft or housing to the surroundings."""
    return path.second == AMBIENT and path.first != "oil"


def _required(
    state: HeatState, paths: Callable[[float], tuple[HeatPath, ...]], low: float
) -> float | None:
    """Conductance by bisection of its logarithm, from `low` on [W/K]."""

    def too_hot(conductance: float) -> bool:
        network = replace(state.network, paths=paths(conductance))
        temperature = state.weights @ network.temperatures(state.sources)
        return bool(temperature > state.film_temperature)

    high = LARGEST_CONDUCTANCE
    if too_hot(high):
        return None
    while high > (1.0 + TOLERANCE) * low:
        middle = (low * high) ** 0.5
        low, high = (middle, high) if too_hot(middle) else (low, middle)
    return high
