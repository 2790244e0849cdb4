r"""Balls between the races: loads, motion, forces and equilibrium at a position of the inner ring.

In the axial plane of a ball (x axial, r radial) let u point from the outer groove's centre of
curvature to the ball's centre and w from there to the inner groove's centre, u + w = V. Then the
approaches are :math:`\delta_o = |u| - (r_o - D/2)` and :math:`\delta_i = |w| - (r_i - D/2)`, the
contact angles are the directions of u and w from the radial one, and a ball is in equilibrium when
(Harris and Kotzalas, in the signs of docs/theory/bearing.md)::

    Qi sin ai - Qo sin ao + (Mg/D) (li cos ai - lo cos ao)      = 0
    Qi cos ai - Qo cos ao - (Mg/D) (li sin ai - lo sin ao) + Fc = 0

With constant Hertz stiffness and without gyroscopic couple the equilibrium is the minimum of an
energy convex in the ball's position, so Newton's method with backtracking finds the one solution;
the rest is a mild perturbation. Every ball is iterated by itself, compiled, and all derivatives
come from complex steps, for which the functions of a state take complex arguments.

Between elastic rings V yields under the forces F of the balls by e (`rings.compliance`):

.. math:: V - V_{rigid} - e(F(V)) = 0

Newton's method has the tangent I - (de/dF)(dF/dV); contacts that stiffen and a compliance that
costs energy keep its eigenvalues above one, whatever the load.
"""

from dataclasses import dataclass, replace
from math import cos
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from oilfilm.ehl.arrays import Array

from ..geometry import Bearing, Race
from ..operation import BallKinematics, QuasistaticModel
from ..rings.compliance import RingCompliance
from ._kernels import INNER_CONTROL, MEAN_ANGLE, OUTER_CONTROL, balanced_balls
from .kinematics import (
    EDGE_COSINE,
    FRICTION_LIMIT,
    INNER_PART,
    ROUND_OFF,
    Direction,
    Motion,
    Numbers,
    PrescribedBalls,
    attitude,
    ball_mass,
    blend,
    centrifugal_force,
    gyroscopic_moment,
    rolling_motion,
    stiffness_at,
    stiffness_series,
)

# a ball that carries less than this part of the largest forces is measured against these [-]
LIGHT_LOAD_RATIO = 1.0e-4
CODES = {
    BallKinematics.OUTER_RACE_CONTROL: OUTER_CONTROL,
    BallKinematics.INNER_RACE_CONTROL: INNER_CONTROL,
}
# code of a hypothesis for the kernel, and what of the couple the inner race holds [-]
HYPOTHESES = {
    kind: (CODES.get(kind, MEAN_ANGLE), INNER_PART.get(kind, 0.0)) for kind in BallKinematics
}

MAX_STEPS = 40
MAX_HALVINGS = 20
SUFFICIENT_DECREASE = 1.0e-4  # Armijo's constant (Nocedal and Wright, 2006, sec. 3.1) [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class BallProblem:
    """Numbers that all balls of a row have in common: lengths [m], mass [kg], speeds [rad/s],
    Hertz stiffness, hypothesis.
    """

    inner_length: float  # r_i - D/2 [m]
    outer_length: float  # r_o - D/2 [m]
    ball_diameter: float  # [m]
    pitch_diameter: float  # [m]
    inner_groove_radius: float  # [m]
    mass: float  # [kg]
    inner_speed: float  # [rad/s]
    outer_speed: float  # [rad/s]
    kinematics: BallKinematics
    inner_series: Array
    outer_series: Array
    nominal_force: float  # centrifugal force at the free contact angle [N]
    nominal_couple: float  # largest gyroscopic couple, J w_m w_R, at the free contact angle [N m]
    # motion and friction that are known; None: those of the hypothesis
    prescribed: PrescribedBalls | None = None

    @property
    def gamma(self) -> float:
        """D/d_m [-]."""
        return self.ball_diameter / self.pitch_diameter


class BallState(NamedTuple):
    """Everything about the balls at given positions; loads and friction [N], moment [N m], speeds
    [rad/s].
    """

    inner_load: Numbers
    outer_load: Numbers
    inner: Direction
    outer: Direction
    motion: Motion
    centrifugal_force: Numbers
    gyroscopic_moment: Numbers
    inner_friction: Numbers
    outer_friction: Numbers


def ball_problem(
    bearing: Bearing, inner_speed: float, outer_speed: float, model: QuasistaticModel
) -> BallProblem:
    """Collect the numbers that the balls have in common.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    inner_speed, outer_speed : float
        speeds of the rings [rad/s]
    model : QuasistaticModel
        hypothesis on the kinematics and curvature

    Returns
    -------
    BallProblem
        numbers of a ball, SI
    """
    d = bearing.ball_diameter
    dm = bearing.pitch_diameter
    mass = ball_mass(d, bearing.ball_material.density)
    gamma = d / dm * cos(bearing.free_contact_angle)
    nominal_orbit = 0.5 * (inner_speed * (1.0 - gamma) + outer_speed * (1.0 + gamma))
    nominal_spin = 0.5 * (inner_speed - outer_speed) * (1.0 - gamma**2) * dm / d
    return BallProblem(
        inner_length=bearing.inner_groove_radius - 0.5 * d,
        outer_length=bearing.outer_groove_radius - 0.5 * d,
        ball_diameter=d,
        pitch_diameter=dm,
        inner_groove_radius=bearing.inner_groove_radius,
        mass=mass,
        inner_speed=inner_speed,
        outer_speed=outer_speed,
        kinematics=model.ball_kinematics,
        inner_series=stiffness_series(bearing, Race.INNER, model.curvature),
        outer_series=stiffness_series(bearing, Race.OUTER, model.curvature),
        nominal_force=0.5 * mass * dm * nominal_orbit**2,
        nominal_couple=0.1 * mass * d**2 * abs(nominal_orbit * nominal_spin),
    )


def ball_state(u: Numbers, w: Numbers, problem: BallProblem) -> BallState:
    """Loads, angles, motion and body forces of balls.

    Parameters
    ----------
    u : Numbers
        axial and radial distance from the outer groove's centre to the ball, shape (2, ...) [m]
    w : Numbers
        likewise from the ball to the inner groove's centre, shape (2, ...) [m]
    problem : BallProblem
        numbers that all balls have in common

    Returns
    -------
    BallState
        state of the balls
    """
    outer_distance = np.sqrt(u[0] * u[0] + u[1] * u[1])
    inner_distance = np.sqrt(w[0] * w[0] + w[1] * w[1])
    outer = Direction(u[0] / outer_distance, u[1] / outer_distance)
    # far from the race there is no angle
    in_reach = (inner_distance.real > 0.5 * problem.inner_length) & (w[1].real > 0.0)
    safe = np.where(in_reach, inner_distance, problem.inner_length)
    inner = Direction(
        np.where(in_reach, w[0] / safe, outer.sin), np.where(in_reach, w[1] / safe, outer.cos)
    )
    stiffness = stiffness_at(problem.outer_series, outer.cos)
    outer_load = stiffness * _power(outer_distance - problem.outer_length)
    outer_load = outer_load * _smooth_step(outer.cos, EDGE_COSINE)
    stiffness = stiffness_at(problem.inner_series, inner.cos)
    reach = np.where(in_reach, inner_distance, 0.0)
    inner_load = stiffness * _power(reach - problem.inner_length)
    inner_load = inner_load * _smooth_step(inner.cos, EDGE_COSINE)
    prescribed = problem.prescribed
    if prescribed is None:
        fraction, motion = _shared_motion(outer, inner, (inner_load, outer_load), problem)
    else:
        motion = prescribed.motion
    force = centrifugal_force(problem.mass, problem.pitch_diameter, motion.orbit_speed)
    moment = gyroscopic_moment(problem.mass, problem.ball_diameter, motion)
    if prescribed is None:
        coefficient = INNER_PART[problem.kinematics] * fraction
        friction = [p * moment / problem.ball_diameter for p in (coefficient, 2.0 - coefficient)]
    else:
        none = 0.0 * inner_load
        friction = [prescribed.inner_friction + none, prescribed.outer_friction + none]
    return BallState(inner_load, outer_load, inner, outer, motion, force, moment, *friction)


def _shared_motion(
    outer: Direction, inner: Direction, loads: tuple[Numbers, Numbers], problem: BallProblem
) -> tuple[Numbers, Motion]:
    """Motion under the hypothesis as far as the races can transmit the friction that it asks for.

    The share [-] of the inner race is 1 where lambda_i Mg/D <= FRICTION_LIMIT Qi, Mg by the
    nominal speeds and the full attitude; it falls smoothly to 0, the ball rolling on the outer
    race alone, as the inner contact unloads. Where even the outer race cannot hold that attitude,
    it falls towards the one without couple, an axis parallel to x.
    """
    inner_load, outer_load = loads
    speeds = (problem.inner_speed, problem.outer_speed)
    outer_control = attitude(outer, inner, problem.gamma, BallKinematics.OUTER_RACE_CONTROL)
    parallel = Direction(0.0 * outer_control.sin, 0.0 * outer_control.sin + 1.0)
    beta = blend(
        parallel, outer_control, _transmissible_fraction(outer_load, 2.0, outer_control, problem)
    )
    if problem.kinematics is BallKinematics.OUTER_RACE_CONTROL:
        return np.ones_like(inner_load), rolling_motion(outer, inner, beta, problem.gamma, *speeds)
    chosen = attitude(outer, inner, problem.gamma, problem.kinematics)
    fraction = _transmissible_fraction(inner_load, INNER_PART[problem.kinematics], chosen, problem)
    return fraction, rolling_motion(
        outer, inner, blend(beta, chosen, fraction), problem.gamma, *speeds
    )


def held_fraction(state: BallState, problem: BallProblem) -> Array:
    """Fraction of the hypothesis on the balls that friction at its races can hold.

    Parameters
    ----------
    state : BallState
        balls in equilibrium
    problem : BallProblem
        numbers that all balls have in common

    Returns
    -------
    Array
        1 where friction holds it, 0 where the ball rolls without it, shape (Z,) [-]
    """
    kind = problem.kinematics
    alone = kind is BallKinematics.OUTER_RACE_CONTROL
    chosen = attitude(state.outer, state.inner, problem.gamma, kind)
    load, part = (state.outer_load, 2.0) if alone else (state.inner_load, INNER_PART[kind])
    return np.asarray(_transmissible_fraction(load, part, chosen, problem), dtype=np.float64)


def _transmissible_fraction(
    load: Numbers, coefficient: float, beta: Direction, problem: BallProblem
) -> Numbers:
    """1 where the load [N] transmits the friction `coefficient` Mg/D of an attitude, else less."""
    couple = problem.nominal_couple * beta.sin * np.sign(beta.sin.real)
    return _smooth_step(FRICTION_LIMIT * load, coefficient * couple / problem.ball_diameter)


def _power(approach: Numbers) -> Numbers:
    """max(approach, 0)^1.5 [m^1.5]."""
    pressed = np.where(approach.real > 0.0, approach, 0.0)
    return pressed * np.sqrt(pressed)


def _smooth_step(value: Numbers, full: Numbers | float) -> Numbers:
    """3 t^2 - 2 t^3 of t = value/full, 0 of no value, 1 of one beyond the full one [-]."""
    full = np.asarray(full)
    below = value.real < full.real
    some = value.real > 0.0
    if some.all() and not below.any():  # as with nearly all balls
        return np.ones(below.shape)
    t = np.where(below, np.where(some, value, 0.0) / np.where(below, full, 1.0), 1.0 * some)
    return t * t * (3.0 - 2.0 * t)


class BallsEquilibrium(NamedTuple):
    """Equilibrium of all balls at one ring position.

    u (2, Z) [m]; values (6, Z): residual (x, r) and force on the inner ring (x, r) [N], couple on
    it about e_t [N m], centrifugal force [N]; du_dV (2, 2, Z) [-] and ring_dV (4, 2, Z) [N/m],
    [N]: condensed derivatives; residual [-] of each ball over its forces, or over LIGHT_LOAD_RATIO
    times those of the heaviest loaded ball, and what round-off leaves of it.
    """

    u: Array
    values: Array
    du_dV: Array
    ring_dV: Array
    residual: Array
    noise: float


def solve_balls(V: Array, u_start: Array | None, problem: BallProblem) -> BallsEquilibrium:
    """Equilibrium of all balls at a given position of the inner ring.

    Its `residual` says how well each ball is in balance.

    Parameters
    ----------
    V : Array
        axial and radial distance from the outer to the inner groove's centre of curvature at each
        ball, shape (2, Z) [m]
    u_start : Array | None
        initial guess of the ball positions, shape (2, Z) [m]
    problem : BallProblem
        numbers that all balls have in common

    Returns
    -------
    BallsEquilibrium
        positions, forces and their derivatives
    """
    u = np.ascontiguousarray(_start(V, u_start, problem))
    count = u.shape[1]
    shapes = ((6,), (2, 2), (4, 2), (2,))
    out = tuple(np.empty((*shape, count)) for shape in shapes)
    balanced_balls(
        u, np.ascontiguousarray(V), _prescribed(problem, count), _kernel_arguments(problem), out
    )
    values, du_dV, ring_dV, (size, rounding) = out
    scale = np.maximum(size, LIGHT_LOAD_RATIO * size.max())
    scale = np.where(scale > 0.0, scale, 1.0)
    residual = np.hypot(values[0], values[1]) / scale
    return BallsEquilibrium(u, values, du_dV, ring_dV, residual, float((rounding / scale).max()))


def free_balls_at_cage_speed(
    u: Array, V: Array, state: BallState, problem: BallProblem, balls: int
) -> tuple[Array, BallState]:
    """Balls off the inner race go round with the cage of their row, rolling on the outer race.

    The cage turns at the mean orbit speed of the loaded balls; a row without one stays as it is.
    Forces on the inner ring stay the same. The attitude is that of the hypothesis.

    Parameters
    ----------
    u, V : Array
        positions of balls and inner grooves' centres, shape (2, N) [m]
    state : BallState
        balls there
    problem : BallProblem
        numbers that all balls have in common
    balls : int
        number of balls a row [-]

    Returns
    -------
    u
        positions, shape (2, N) [m]
    state
        balls there
    """
    free, cage = _free_balls(state, balls)
    if problem.prescribed is not None or not free.any():
        return u, state
    both = (state.outer, state.motion.attitude)
    outer, axis = (Direction(one.sin[free], one.cos[free]) for one in both)
    arm = outer.cos * axis.cos + outer.sin * axis.sin
    spin = (cage[free] - problem.outer_speed) * (1.0 / problem.gamma + outer.cos) / arm
    motion = Motion(cage[free], spin, axis)
    moment = gyroscopic_moment(problem.mass, problem.ball_diameter, motion)
    none = np.zeros(spin.size)
    prescribed = PrescribedBalls(
        orbit_speed=motion.orbit_speed,
        spin_speed=spin,
        pivot_speed=none,
        attitude=np.arctan2(axis.sin, axis.cos),
        inner_friction=none,
        outer_friction=2.0 * moment / problem.ball_diameter,
        inner_drive=none,
    )
    problem = replace(problem, prescribed=prescribed)
    found = solve_balls(V[:, free], u[:, free], problem)
    changed = ball_state(found.u, V[:, free] - found.u, problem)
    if changed.inner_load.any():  # one that just leaves the race
        return u, state
    at = u.copy()
    at[:, free] = found.u
    return at, _with_balls(state, changed, free)


def _free_balls(state: BallState, balls: int) -> tuple[NDArray[np.bool_], Array]:
    """Balls off the inner race in rows with loaded ones, and the cage's speed at each [rad/s]."""
    loaded = (state.inner_load > 0.0).reshape(-1, balls)
    orbit = np.reshape(state.motion.orbit_speed, loaded.shape)
    cage = (orbit * loaded).sum(axis=1) / np.maximum(loaded.sum(axis=1), 1)
    free = ~loaded & loaded.any(axis=1, keepdims=True)
    return free.ravel(), np.repeat(cage, balls)


def _with_balls(state: Any, changed: Any, at: NDArray[np.bool_]) -> Any:
    """A state whose balls `at` are those of another, which has these alone."""
    if isinstance(state, tuple):
        pairs = zip(state, changed, strict=True)
        return type(state)(*(_with_balls(own, other, at) for own, other in pairs))
    merged = np.array(state)
    merged[at] = changed
    return merged


def _prescribed(problem: BallProblem, balls: int) -> Array:
    """Motion and friction of the balls where they are prescribed, (balls, 6), else (balls, 0)."""
    prescribed = problem.prescribed
    if prescribed is None:
        return np.empty((balls, 0))
    motion = prescribed.motion
    frictions = (prescribed.inner_friction, prescribed.outer_friction)
    columns = (motion.orbit_speed, motion.spin_speed, *motion.attitude, *frictions)
    return np.stack(columns, axis=1)


def _kernel_arguments(problem: BallProblem) -> tuple[Any, ...]:
    """Numbers of a problem for the kernel."""
    return (
        (problem.inner_length, problem.outer_length, problem.inner_groove_radius),
        (problem.ball_diameter, problem.pitch_diameter, problem.mass, problem.nominal_couple),
        (problem.inner_speed, problem.outer_speed),
        HYPOTHESES[problem.kinematics],
        problem.inner_series,
        problem.outer_series,
        problem.nominal_force,
    )


def _start(V: Array, u_start: Array | None, problem: BallProblem) -> Array:
    """Guess: balls off the inner race lie on the outer one or float, others stay or split the
    approach statically.
    """
    inner, outer = problem.inner_length, problem.outer_length
    distance = np.hypot(V[0], V[1])
    up = np.array([[0.0], [1.0]])
    unit = np.where(distance > 0.0, V / np.where(distance > 0.0, distance, 1.0), up)
    stiffness_o = stiffness_at(problem.outer_series, np.ones(1))[0]
    ratio = (stiffness_o / stiffness_at(problem.inner_series, np.ones(1))[0]) ** (2.0 / 3.0)
    split = unit * (outer + np.maximum(distance - inner - outer, 0.0) / (1.0 + ratio))
    pressed = np.zeros_like(V)
    pressed[1] = outer + (problem.nominal_force / stiffness_o) ** (2.0 / 3.0)
    if problem.nominal_force > 0.0:
        free = np.hypot(*(V - pressed)) <= inner
        static = stiffness_o * (np.maximum(distance - inner - outer, 0.0) / (1.0 + ratio)) ** 1.5
        # past the inner groove's edge
        climbed = ((V - pressed)[1] < EDGE_COSINE * inner) & (distance > inner + outer)
        free &= ~climbed
        cold = np.where(free | ((static < problem.nominal_force) & ~climbed), pressed, split)
    else:
        free = distance <= inner + outer
        cold = np.where(free, unit * outer * np.minimum(1.0, distance / (inner + outer)), split)
    if u_start is None:
        return cold
    return np.where(~free & (np.hypot(u_start[0], u_start[1]) > outer), u_start, cold)


class BetweenRings(NamedTuple):
    """Balls in equilibrium between two rings, which may yield.

    V (2, N): distances of the grooves' centres [m]; movement (2, 5, N): dV/dq by the position of
    the inner ring [-]; residual: force by which V misses its equation over the largest force, and
    what round-off leaves of it [-].
    """

    balls: BallsEquilibrium
    V: Array
    movement: Array
    residual: float
    noise: float


class _Trial(NamedTuple):
    V: Array
    balls: BallsEquilibrium
    miss: Array  # V - rigid - e, (2, N) [m]


def solve_between_elastic_rings(
    rigid: Array,
    start: tuple[Array | None, Array],
    movement: Array,
    problem: BallProblem,
    compliance: RingCompliance,
) -> BetweenRings:
    """Balls and yielding rings in equilibrium at one position of the inner ring.

    Parameters
    ----------
    rigid : Array
        distances of the grooves' centres of rigid rings, shape (2, N) [m]
    start : tuple[Array | None, Array]
        ball positions, or None, and distances to begin with, shape (2, N) [m]
    movement : Array
        d(rigid)/dq, shape (2, 5, N) [-]
    problem : BallProblem
        numbers that all balls have in common
    compliance : RingCompliance
        compliance of the rings

    Returns
    -------
    BetweenRings
        balls, distances and their derivatives
    """
    target = ROUND_OFF * (problem.inner_length + problem.outer_length)
    trial = _trial(start[1], start[0], rigid, problem, compliance)
    for _ in range(MAX_STEPS):
        size = np.abs(trial.miss).max()
        if size <= target:
            break
        # 1. Newton step of all distances together
        step = np.linalg.solve(_tangent(trial, compliance), -trial.miss.ravel())
        step = step.reshape(rigid.shape)
        # 2. halved until what is missed falls
        factor = 1.0
        for _ in range(MAX_HALVINGS):
            V = trial.V + factor * step
            u = trial.balls.u + np.einsum("uvz,vz->uz", trial.balls.du_dV, factor * step)
            following = _trial(V, u, rigid, problem, compliance)
            if np.abs(following.miss).max() < (1.0 - SUFFICIENT_DECREASE * factor) * size:
                break
            factor *= 0.5
        else:
            break
        trial = following
    force = np.abs(trial.balls.values[2:4]).max()
    stiffness = np.abs(trial.balls.ring_dV[:2]).max() / max(force, 1e-300)
    tangent = _tangent(trial, compliance)
    columns = movement.transpose(0, 2, 1).reshape(-1, movement.shape[1])
    elastic = np.asarray(np.linalg.solve(tangent, columns))
    elastic = elastic.reshape(2, -1, movement.shape[1]).transpose(0, 2, 1)
    residual = float(np.abs(trial.miss).max() * stiffness) if force > 0.0 else 0.0
    noise = float(target * stiffness) if force > 0.0 else 0.0
    return BetweenRings(
        trial.balls, trial.V, np.asarray(elastic, dtype=np.float64), residual, noise
    )


def _trial(
    V: Array, u: Array | None, rigid: Array, problem: BallProblem, compliance: RingCompliance
) -> _Trial:
    balls = solve_balls(V, u, problem)
    shift = compliance.shift(balls.values[2:4], balls.values[5], V)
    return _Trial(V, balls, V - rigid - shift)


def _tangent(trial: _Trial, compliance: RingCompliance) -> Array:
    """d(miss)/dV, shape (2 N, 2 N) [-]."""
    size = trial.V.size
    balls = trial.balls
    yielding = compliance.derivative(balls.values[2:4], balls.values[5], trial.V, balls.ring_dV)
    return np.asarray(np.eye(size) - yielding.reshape(size, size))
