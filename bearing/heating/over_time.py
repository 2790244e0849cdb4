r"""Temperatures of a bearing over time, from a start on, and the stability of their balance.

.. math:: C_n \dot T_n = Q_n(T_f, P_d) + \sum_m G_{nm} (T_m - T_n)

with the heat capacities C_n of the nodes, film temperature and clearance of the moment: friction
and films are as they would be in a steady state there, which they reach within turns, the parts
within minutes. A step solves

.. math:: \dot T = A T + N_0 + N_1 t, \qquad A = C^{-1} (Q' - G)

exactly by the exponential of a matrix, A that of its beginning with the slope of the heat over the
film temperature that the last steps show, N_1 by the step before (exponential time differencing of
second order, Cox and Matthews, 2002): one state of the bearing a step, however fast the oil in the
cavity warms. (SciPy's BDF took several hundred: its steps shrink with what the iterations of the
friction leave.)

Near a balance Q' = dQ/dT of the friction falls with the viscosity of warmer oil and rises with the
preload of a warmer inner ring. The largest eigenvalue of A is the rate at which the slowest
disturbance dies out; where it is positive the bearing runs away. The margin is that rate over the
rate with friction that does not change: 1 where it does not matter, above it where friction falls
with the temperature, 0 at the limit.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import pi

import numpy as np
import scipy

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.oil.assumed_heat import heat_of
from oilfilm.ehl.oil.lubricant import Lubricant

from ..geometry import Bearing
from ..material import Material
from ..supply.inlet_oil import cavity_volume
from .friction_heat import solid_thermal
from .heat_state import HeatState, SelfHeatingProblem, heat_state
from .network import NODES, node_values
from .paths import Surroundings, dimensions, with_dimensions

OIL_SHARE = 0.1  # of the cavity that holds oil, where none is given, assumed [-]
CAGE_SHARE = 0.1  # of the volume of the balls that a cage has, assumed, as dense as steel [-]
CAGE_CAPACITY = 3.6e6  # rho c of steel [J/(m^3 K)]

PROBE = 1.0  # of one node's temperature, for the slope of the clearance [K]

FILM_STEP = 4.0  # of the film temperature in one step [K]
CLEARANCE_STEP = 2.0e-6  # likewise [m]
ERROR = 0.2  # of the film temperature that a step may make [K]
SLOPE_STEP = 0.3  # of the film temperature from which a step shows a slope [K]
FIRST_STEP = 1.0e-4  # over the longest time constant [-]
GROWTH = 2.0  # of one step over the one before, at most

OUT_OF_RANGE = "the films pass the range of lubricants"


def heat_capacities(
    bearing: Bearing,
    around: Surroundings,
    oil: Lubricant,
    oil_share: float | None = None,
    rows: int = 1,
) -> Array:
    """Heat capacities C of the nodes, rho c V; rings and housing as cylinders.

    The shaft counts over its whole length.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    around : Surroundings
        shaft, housing and surroundings
    oil : Lubricant
        oil in the cavity
    oil_share : float | None, optional
        fraction of the cavity that holds oil; None: `OIL_SHARE` [-]
    rows : int, default 1
        number of rows of balls [-]

    Returns
    -------
    Array
        C, shape (nodes,) [J/K]
    """
    size = dimensions(bearing, around, rows)
    length = size.width + 2.0 * size.shaft_length
    outer = _capacity(bearing.outer_ring_material)
    outer *= _ring(size.outer_track, size.outside, size.width)
    balls = rows * bearing.balls * pi / 6.0 * bearing.ball_diameter**3
    sized = with_dimensions(bearing, size.bore, size.outside, size.width / rows)
    cavity = rows * cavity_volume(sized) * (OIL_SHARE if oil_share is None else oil_share)
    fluid = oil.density * heat_of(oil).specific_heat
    values = {
        "shaft": _capacity(around.shaft_material) * _ring(around.shaft_bore, size.bore, length),
        "inner_ring": _capacity(bearing.inner_ring_material)
        * _ring(size.bore, size.inner_track, size.width),
        "balls": _capacity(bearing.ball_material) * balls,
        "outer_ring_loaded": 0.5 * outer,
        "outer_ring_unloaded": 0.5 * outer,
        "cage": CAGE_CAPACITY * CAGE_SHARE * balls,
        "oil": max(fluid * cavity, 1e-3 * outer),
        "housing": _capacity(around.housing_material)
        * _ring(size.outside, size.housing, size.housing_width),
    }
    return node_values(values)


def _ring(inner: float, outer: float, width: float) -> float:
    """Volume of a cylinder with a bore [m^3]."""
    return 0.25 * pi * (outer**2 - inner**2) * width


def _capacity(material: Material) -> float:
    """Rho c [J/(m^3 K)]."""
    solid = solid_thermal(material)
    return solid.density * solid.specific_heat


@dataclass(frozen=True, slots=True, kw_only=True)
class Slopes:
    """A state and its neighbours."""

    state: HeatState
    warmer: HeatState  # of a higher film temperature
    wider: HeatState | None  # of a larger clearance; None where the clearance stays


@dataclass(frozen=True, slots=True, kw_only=True)
class Stability:
    """How a disturbance of the temperatures dies out, and ends of the temperatures."""

    rate: float  # largest eigenvalue [1/s], negative: dies out
    constant_friction_rate: float  # the same with friction that does not change [1/s]
    # lowest and highest temperature of each node of three balances: this one, all paths at the
    # low ends of their ranges, and all at the high ends [K]
    coldest: Array
    hottest: Array
    time_constants: Array  # of the modes, longest first, of a stable balance [s]

    @property
    def longest_time(self) -> float | None:
        """Time constant of the slowest mode of a stable balance [s]; None for an unstable one."""
        return float(self.time_constants[0]) if self.rate < 0.0 else None

    @property
    def margin(self) -> float:
        """Margin against runaway, zero or below without one [-]."""
        return self.rate / self.constant_friction_rate


def stability(
    slopes: Slopes, problem: SelfHeatingProblem, capacities: Array, temperatures: Array
) -> Stability:
    """Stability of a balance of heat.

    Parameters
    ----------
    slopes : Slopes
        state at the balance and its neighbours
    problem : SelfHeatingProblem
        bearing, friction and surroundings
    capacities : Array
        heat capacities of the nodes, shape (nodes,) [J/K]
    temperatures : Array
        temperatures of the nodes in the balance, shape (nodes,) [K]

    Returns
    -------
    Stability
        rates of the modes, and ends of the temperatures
    """
    state = slopes.state
    response = _response(slopes, problem)
    leaving, _ = state.network.matrix()
    rates = np.linalg.eigvals((response - leaving) / capacities[:, None]).real
    constant = np.linalg.eigvals(-leaving / capacities[:, None]).real
    ends = [temperatures, state.temperatures]
    for end in (1, -1):
        other, from_outside = state.network.matrix(end)
        fixed = state.sources - response @ state.temperatures + from_outside
        ends.append(np.asarray(np.linalg.solve(other - response, fixed), dtype=np.float64))
    return Stability(
        rate=float(rates.max()),
        constant_friction_rate=float(constant.max()),
        coldest=np.asarray(np.min(ends, axis=0), dtype=np.float64),
        hottest=np.asarray(np.max(ends, axis=0), dtype=np.float64),
        time_constants=np.sort(-1.0 / rates[rates < 0.0])[::-1],
    )


def _response(slopes: Slopes, problem: SelfHeatingProblem) -> Array:
    """Heat into each node by the temperature of each, (nodes, nodes) [W/K]: by the films' own and
    by the clearance.
    """
    state = slopes.state
    at = state.temperatures
    surplus = state.surplus(at)
    step = slopes.warmer.film_temperature - state.film_temperature
    by_film = (slopes.warmer.surplus(at) - surplus) / step
    response = np.outer(by_film, state.weights)
    if slopes.wider is None:
        return response
    step = slopes.wider.clearance - state.clearance
    by_clearance = (slopes.wider.surplus(at) - surplus) / step
    clearance = problem.clearance(at)
    slope = [
        (problem.clearance(at + PROBE * unit) - clearance) / PROBE for unit in np.eye(len(NODES))
    ]
    return np.asarray(response + np.outer(by_clearance, slope))


@dataclass(frozen=True, slots=True, kw_only=True)
class WarmUp:
    """Temperatures over time, at the steps of the integration."""

    time: Array  # (times,) [s]
    temperatures: Array  # of the nodes, (times, nodes) [K]
    film_temperature: Array  # (times,) [K]
    clearance: Array  # on the diameter [m]
    power: Array  # of the friction [W]
    message: str = ""  # reason of an early end; empty at the full duration

    @property
    def ended(self) -> bool:
        """True if it reached the full duration."""
        return not self.message


@dataclass(frozen=True, slots=True)
class _Moment:
    """Temperatures at a time, and the state of the bearing there."""

    time: float  # [s]
    temperatures: Array  # of the nodes [K]
    state: HeatState
    slope: Array  # of the heat into the nodes by the film temperature [W/K]


@dataclass(frozen=True, slots=True)
class _Course:
    """The bearing, the weights of its nodes and their heat capacities."""

    problem: SelfHeatingProblem
    weights: Array  # of the nodes in the film temperature [-]
    capacities: Array  # of the nodes [J/K]

    def film_temperature(self, temperatures: Array) -> float:
        """Film temperature by temperatures of the nodes [K]."""
        return float(self.weights @ temperatures)

    def moment(self, time: float, temperatures: Array, before: _Moment) -> _Moment:
        """Friction and network at temperatures of the nodes [K]; ValueError if there is none."""
        film = self.film_temperature(temperatures)
        clearance = self.problem.clearance(temperatures)
        state = heat_state(self.problem, self.problem.fixed_paths(), film, clearance)
        slope = before.slope
        change = film - before.state.film_temperature
        if abs(change) > SLOPE_STEP:
            at = before.temperatures
            slope = (state.surplus(at) - before.state.surplus(at)) / change
        return _Moment(time, temperatures, state, slope)

    def matrix(self, moment: _Moment) -> Array:
        """A of a moment [1/s]."""
        leaving, _prescribed = moment.state.network.matrix()
        heating = np.outer(moment.slope, self.weights)
        return np.asarray((heating - leaving) / self.capacities[:, None])

    def remainder(self, moment: _Moment, matrix: Array) -> Array:
        """N of a moment, its rates less A T [K/s]."""
        rates = moment.state.surplus(moment.temperatures) / self.capacities
        return np.asarray(rates - matrix @ moment.temperatures)

    def change(self, first: Array, second: Array) -> float:
        """Larger change of film temperature and clearance, over their steps [-]."""
        film = abs(self.film_temperature(second - first)) / FILM_STEP
        clearance = abs(self.problem.clearance(second) - self.problem.clearance(first))
        return max(film, clearance / CLEARANCE_STEP)


def warm_up(
    problem: SelfHeatingProblem,
    duration: float,
    start: Array | None = None,
    notify: Callable[[float], None] = lambda time: None,
) -> WarmUp:
    """Temperatures over time from a start on, at the operation of the problem.

    Ends early if the films pass the hottest temperature or the bearing has no equilibrium.

    Parameters
    ----------
    problem : SelfHeatingProblem
        bearing, friction and surroundings
    duration : float
        time to compute [s]
    start : Array | None, optional
        temperatures of the nodes, shape (nodes,) [K]; None: those of the surroundings
    notify : Callable[[float], None], default lambda time: None
        called with the time [s]

    Returns
    -------
    WarmUp
        temperatures at the steps of the integration

    Raises
    ------
    ValueError
        if there is no equilibrium or no friction at the start
    """
    cold = np.full(len(NODES), problem.around.ambient) if start is None else start
    mean = float(cold.mean())
    first = heat_state(problem, problem.fixed_paths(), mean, problem.clearance(cold))
    capacities = heat_capacities(
        problem.bearing, problem.around, problem.oil(mean), problem.oil_share, len(problem.rows)
    )
    course = _Course(problem, first.weights, capacities)
    moments = [_Moment(0.0, cold, first, np.zeros_like(cold))]
    longest = -1.0 / np.linalg.eigvals(course.matrix(moments[0])).real.max()
    step = FIRST_STEP * float(longest)
    message = ""
    while not message and moments[-1].time < duration:
        try:
            after, step = _advance(course, moments, min(step, duration - moments[-1].time))
        except ValueError as error:
            message = str(error)
            break
        moments.append(after)
        notify(after.time)
        if course.film_temperature(after.temperatures) >= problem.hottest:
            message = OUT_OF_RANGE
    return _result(moments, course, message)


def _advance(course: _Course, moments: list[_Moment], step: float) -> tuple[_Moment, float]:
    """The next moment, and the step to try from it [s]."""
    now = moments[-1]
    matrix = course.matrix(now)
    remainder = course.remainder(now, matrix)
    slope = np.zeros_like(remainder)
    if len(moments) > 1:
        before = moments[-2]
        slope = (remainder - course.remainder(before, matrix)) / (now.time - before.time)
    while True:
        temperatures = _linear(matrix, remainder, slope, now.temperatures, step)
        change = course.change(now.temperatures, temperatures)
        if change > 1.0:
            step *= max(0.3, 0.9 / change)
            continue
        after = course.moment(now.time + step, temperatures, now)
        missed = 0.5 * step * (course.remainder(after, matrix) - remainder - slope * step)
        error = abs(course.film_temperature(missed)) / ERROR
        if error <= 1.0:
            return after, step * min(GROWTH, 0.9 / max(error, change, 1e-3) ** 0.5)
        step *= max(0.3, 0.9 / error**0.5)


def _linear(matrix: Array, remainder: Array, slope: Array, start: Array, time: float) -> Array:
    """T after a time [s] of dT/dt = A T + N_0 + N_1 t [K]."""
    size = len(start)
    augmented = np.zeros((size + 2, size + 2))
    augmented[:size, :size] = matrix
    augmented[:size, size] = slope  # of (T, t, 1)
    augmented[:size, size + 1] = remainder
    augmented[size, size + 1] = 1.0
    grown = scipy.linalg.expm(time * augmented)
    return np.asarray(grown[:size, :size] @ start + grown[:size, size + 1])


def _result(moments: list[_Moment], course: _Course, message: str) -> WarmUp:
    temperatures = np.stack([moment.temperatures for moment in moments])
    return WarmUp(
        time=np.array([moment.time for moment in moments]),
        temperatures=temperatures,
        film_temperature=temperatures @ course.weights,
        clearance=np.array([moment.state.clearance for moment in moments]),
        power=np.array([moment.state.friction.power for moment in moments]),
        message=message,
    )
