r"""Balls between the races: forces at given ring position, equilibrium of every ball, and its
derivatives.

In the axial plane of a ball (x axial, r radial) let u point from the outer groove's centre of
curvature to the ball's centre and w from there to the inner groove's centre, u + w = V. Then the
approaches are
:math:`\delta_o = |u| - (r_o - D/2)` and :math:`\delta_i = |w| - (r_i - D/2)`, the contact angles
are the directions of
u and w from the radial one, and a ball is in equilibrium when
(Harris and Kotzalas, in the signs of docs/theory/bearing.md)::

    Qi sin ai - Qo sin ao + (Mg/D) (li cos ai - lo cos ao)      = 0
    Qi cos ai - Qo cos ao - (Mg/D) (li sin ai - lo sin ao) + Fc = 0

With constant Hertz stiffness and without gyroscopic couple this is the minimum of an energy convex
in u, so Newton's method with backtracking finds the one solution; the rest is a mild perturbation.
All balls are iterated together, and all derivatives come from one complex-step evaluation.
"""

from dataclasses import dataclass
from math import cos
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..geometry import Array, Bearing, Race
from ..operation import BallKinematics, Model
from .contact_stiffness import stiffness_at, stiffness_series
from .kinematics import (
    INNER_PART,
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
)

COMPLEX_STEP = 1.0e-30  # [m]
# friction over load beyond which a hypothesis asks more than a contact gives: above SKF's
# coefficient of boundary lubrication, 0.12 running and 0.15 at the start (`torque.skf`) [-]
FRICTION_LIMIT = 0.2
# cosine of 80 degrees: beyond, the load fades to none at 90, where no groove reaches [-]
EDGE_COSINE = 0.17
# a ball that carries less than this part of the largest forces is measured against these [-]
LIGHT_LOAD_RATIO = 1.0e-4
ROUND_OFF = 8.0 * float(np.finfo(np.float64).eps)  # [-]
BALL_TARGET = 1.0e-13  # residual of a ball over its forces at which iterating stops [-]
# residual of a ball over its forces that is accepted when it falls no further [-]
BALL_TOLERANCE = 1.0e-11
MAX_HALVINGS = 12
MAX_BALL_STEPS = 30


@dataclass(frozen=True, slots=True, kw_only=True)
class BallProblem:
    """What all balls of a row share: lengths [m], mass [kg], speeds [rad/s], Hertz stiffness,
    hypothesis.
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


class BallsEquilibrium(NamedTuple):
    """Equilibrium of all balls at one ring position.

    u (2, Z) [m]; values (5, Z): residual (x, r) and force on the inner ring (x, r) [N], couple on
    it about e_t [N m]; du_dV (2, 2, Z) [-] and ring_dV (3, 2, Z) [N/m], [N]: condensed
    derivatives; residual [-] of each ball over its forces, or over LIGHT_LOAD_RATIO times those of
    the heaviest loaded ball, and what round-off leaves of it.
    """

    u: Array
    values: Array
    du_dV: Array
    ring_dV: Array
    residual: Array
    noise: float


def ball_problem(
    bearing: Bearing, inner_speed: float, outer_speed: float, model: Model
) -> BallProblem:
    """Collect what the balls share at given ring speeds [rad/s]."""
    d, dm = bearing.ball_diameter, bearing.pitch_diameter
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
    """Loads, angles, motion and body forces of balls at given positions.

    Parameters
    ----------
    u, w : ndarray, shape (2, ...)
        Axial and radial distance from the outer groove's centre to the ball and from there to the
        inner groove's [m].
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
    outer_load = stiffness_at(problem.outer_series, outer.cos) * _power(
        outer_distance - problem.outer_length
    )
    outer_load = outer_load * _smooth_step(outer.cos, EDGE_COSINE)
    inner_load = stiffness_at(problem.inner_series, inner.cos) * _power(
        np.where(in_reach, inner_distance, 0.0) - problem.inner_length
    )
    inner_load = inner_load * _smooth_step(inner.cos, EDGE_COSINE)
    prescribed = problem.prescribed
    if prescribed is None:
        share, motion = _shared_motion(outer, inner, (inner_load, outer_load), problem)
    else:
        motion = prescribed.motion
    force = centrifugal_force(problem.mass, problem.pitch_diameter, motion.orbit_speed)
    moment = gyroscopic_moment(problem.mass, problem.ball_diameter, motion)
    if prescribed is None:
        inner_part = INNER_PART[problem.kinematics] * share
        friction = (
            inner_part * moment / problem.ball_diameter,
            (2.0 - inner_part) * moment / problem.ball_diameter,
        )
    else:
        friction = (
            prescribed.inner_friction + 0.0 * inner_load,
            prescribed.outer_friction + 0.0 * inner_load,
        )
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
    alone = attitude(outer, inner, problem.gamma, BallKinematics.OUTER_RACE_CONTROL)
    parallel = Direction(0.0 * alone.sin, 0.0 * alone.sin + 1.0)
    beta = blend(parallel, alone, _transmissible_share(outer_load, 2.0, alone, problem))
    if problem.kinematics is BallKinematics.OUTER_RACE_CONTROL:
        return np.ones_like(inner_load), rolling_motion(outer, inner, beta, problem.gamma, *speeds)
    chosen = attitude(outer, inner, problem.gamma, problem.kinematics)
    share = _transmissible_share(inner_load, INNER_PART[problem.kinematics], chosen, problem)
    return share, rolling_motion(outer, inner, blend(beta, chosen, share), problem.gamma, *speeds)


def _transmissible_share(
    load: Numbers, part: float, beta: Direction, problem: BallProblem
) -> Numbers:
    """1 where the load [N] transmits the friction `part` Mg/D of an attitude, else less."""
    couple = problem.nominal_couple * beta.sin * np.sign(beta.sin.real)
    return _smooth_step(FRICTION_LIMIT * load, part * couple / problem.ball_diameter)


def ball_balance(state: BallState, problem: BallProblem) -> Numbers:
    """Residual of the ball equilibrium and what the ball does to the inner ring.

    Returns
    -------
    ndarray, shape (5, ...)
        Force on the ball (x, r) [N], force on the inner ring (x, r) [N], couple on the inner ring
        about e_t [N m]: the friction acts at the contact, r_i away from the groove's centre where
        the normal force passes.
    """
    inner_friction, outer_friction = state.inner_friction, state.outer_friction
    from_inner_x = state.inner_load * state.inner.sin + inner_friction * state.inner.cos
    from_inner_r = state.inner_load * state.inner.cos - inner_friction * state.inner.sin
    from_outer_x = -state.outer_load * state.outer.sin - outer_friction * state.outer.cos
    from_outer_r = -state.outer_load * state.outer.cos + outer_friction * state.outer.sin
    return np.stack(
        [
            from_inner_x + from_outer_x,
            from_inner_r + from_outer_r + state.centrifugal_force,
            -from_inner_x,
            -from_inner_r,
            -inner_friction * problem.inner_groove_radius,
        ]
    )


def solve_balls(V: Array, u_start: Array | None, problem: BallProblem) -> BallsEquilibrium:
    """Equilibrium of all balls at a given position of the inner ring; its `residual` says how well
    each ball is in balance.

    Parameters
    ----------
    V : ndarray, shape (2, Z)
        Axial and radial distance from the outer to the inner groove's centre of curvature at each
        ball [m].
    u_start : ndarray, shape (2, Z), or None
        Guess of the ball positions [m].
    """
    u = _start(V, u_start, problem)
    current = _evaluate(u, V, problem)
    for _ in range(MAX_BALL_STEPS):
        # 1. balls not yet in balance
        _, values, size, jacobian = current
        active = np.hypot(values[0], values[1]) > np.maximum(
            BALL_TARGET * size, _round_off(current, problem)
        )
        if not active.any():
            break
        # 2. Newton step; where it leads uphill in energy, that of springs in the two contacts
        step = _solve_2x2(jacobian[:2, :2] - jacobian[:2, 2:], -values[:2])
        uphill = ~((step * values[:2]).sum(axis=0) > 0.0)
        if (uphill & active).any():
            step = np.where(uphill, _elastic_step(u, V, values, problem), step)
        step = _limit(step, 0.25 * problem.outer_length)
        # 3. halved until the force left on the ball falls
        trial, improved = _backtrack(u, np.where(active, step, 0.0), V, current, problem)
        if not improved.any():
            break
        u = trial[0]
        current = trial
    return _condensed(current, problem)


class _Evaluation(NamedTuple):
    u: Array
    values: Array  # (5, Z)
    size: Array  # (Z,) sum of the forces [N]
    jacobian: Array  # (5, 4, Z), with respect to u_x, u_r, w_x, w_r


def _evaluate(u: Array, V: Array, problem: BallProblem) -> _Evaluation:
    """Balance and its derivatives by a complex step in each of u_x, u_r, w_x, w_r."""
    z = np.broadcast_to(np.concatenate([u, V - u])[:, None, :], (4, 4, u.shape[1])).astype(
        np.complex128
    )
    z[range(4), range(4)] += 1j * COMPLEX_STEP
    state = ball_state(z[:2], z[2:], problem)
    result = ball_balance(state, problem)
    size = (state.inner_load + state.outer_load + state.centrifugal_force).real[0]
    return _Evaluation(u, result.real[:, 0], size, result.imag / COMPLEX_STEP)


def _round_off(current: _Evaluation, problem: BallProblem) -> Array:
    """Force [N] that rounding the positions is worth: the approach is a small difference of
    lengths.
    """
    stiffness: Array = np.abs(current.jacobian[:2]).max(axis=(0, 1))
    return ROUND_OFF * (problem.inner_length + problem.outer_length) * stiffness


def _condensed(current: _Evaluation, problem: BallProblem) -> BallsEquilibrium:
    """Condense: du/dV from the ball equilibrium, then the change of the forces on the ring
    with V.
    """
    u, values, size, jacobian = current
    by_w = jacobian[:, 2:]
    by_u = jacobian[:, :2] - by_w
    du_dV = np.stack([_solve_2x2(by_u[:2], -by_w[:2, k]) for k in range(2)], axis=1)
    ring_dV = by_w[2:] + np.einsum("fuz,uvz->fvz", by_u[2:], du_dV)
    norm = np.hypot(values[0], values[1])
    scale = np.maximum(size, LIGHT_LOAD_RATIO * size.max())
    scale = np.where(scale > 0.0, scale, 1.0)
    return BallsEquilibrium(
        u,
        values,
        du_dV,
        ring_dV,
        norm / scale,
        float((_round_off(current, problem) / scale).max()),
    )


def _backtrack(
    u: Array, step: Array, V: Array, current: _Evaluation, problem: BallProblem
) -> tuple[_Evaluation, NDArray[np.bool_]]:
    """Shorten the step of each ball until its residual falls or the force no longer opposes it;
    else it stays.
    """
    norm = np.hypot(current.values[0], current.values[1])
    factor = np.where((step != 0.0).any(axis=0), 1.0, 0.0)
    for _ in range(MAX_HALVINGS):
        trial = _evaluate(u + factor * step, V, problem)
        smaller = np.hypot(trial.values[0], trial.values[1]) < (1.0 - 1e-4 * factor) * norm
        along = (trial.values[:2] * step).sum(axis=0) > 0.0
        failed = (factor > 0.0) & ~(smaller | (along & (norm > BALL_TOLERANCE * current.size)))
        if not failed.any():
            break
        stuck = failed & (norm <= BALL_TOLERANCE * current.size)
        factor = np.where(stuck, 0.0, np.where(failed, 0.4 * factor, factor))
    return trial, factor > 0.0


def _elastic_step(u: Array, V: Array, values: Array, problem: BallProblem) -> Array:
    """Step with the Hertz stiffness alone, which always leads along the force.

    Each contact gives K (1.5 delta^0.5 n n + delta^1.5/l (1 - n n)), l the distance from its
    groove's centre; what changes body forces and friction with the angles is left out, and a trace
    of stiffness is added in their place.
    """
    state = ball_state(u, V - u, problem)
    matrix = np.zeros((2, 2, u.shape[1]))
    weight = state.outer_load + state.inner_load + problem.nominal_force
    for pull, side, length in (
        (u, state.outer_load, problem.outer_length),
        (V - u, state.inner_load, problem.inner_length),
    ):
        distance = np.maximum(np.hypot(pull[0], pull[1]), 1e-6 * length)
        normal = pull / distance
        along = np.einsum("az,bz->abz", normal, normal)
        approach = distance - length
        stiff = np.where(side > 0.0, 1.5 * side / np.maximum(approach, 1e-12 * length), 0.0)
        identity = np.eye(2)[:, :, None]
        matrix += (
            stiff * along + side / distance * (identity - along) + 0.1 * weight / length * identity
        )
    return _solve_2x2(matrix, values[:2])


def _start(V: Array, u_start: Array | None, problem: BallProblem) -> Array:
    """Guess: balls off the inner race lie on the outer one or float, others stay or split the
    approach statically.
    """
    inner, outer = problem.inner_length, problem.outer_length
    distance = np.hypot(V[0], V[1])
    unit = np.where(
        distance > 0.0, V / np.where(distance > 0.0, distance, 1.0), np.array([[0.0], [1.0]])
    )
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


def _solve_2x2(matrix: Array, right: Array) -> Array:
    """Solve 2 x 2 systems, matrix (2, 2, Z), right (2, Z); balls free of all force (matrix zero)
    do not move.
    """
    a = matrix[0, 0]
    b = matrix[0, 1]
    c = matrix[1, 0]
    d = matrix[1, 1]
    determinant = a * d - b * c
    scale = a * a + b * b + c * c + d * d
    safe = np.abs(determinant) > 1e-14 * scale
    inverse = np.where(safe, 1.0, 0.0) / np.where(safe, determinant, 1.0)
    solved = np.stack(
        [(d * right[0] - b * right[1]) * inverse, (a * right[1] - c * right[0]) * inverse]
    )
    # the matrix is negative: step along the force
    gradient = -right / np.sqrt(np.where(scale > 0.0, scale, 1.0))
    return np.where(safe, solved, np.where(scale > 0.0, gradient, 0.0))


def _limit(step: Array, longest: float) -> Array:
    length = np.hypot(step[0], step[1])
    return step * np.minimum(1.0, longest / np.maximum(length, 1e-300))


def _power(approach: Numbers) -> Numbers:
    """max(approach, 0)^1.5 [m^1.5]."""
    pressed = np.where(approach.real > 0.0, approach, 0.0)
    return pressed * np.sqrt(pressed)


def _smooth_step(value: Numbers, full: Numbers | float) -> Numbers:
    """3 t^2 - 2 t^3 of t = value/full, 1 where the value exceeds the full one [-]."""
    full = np.asarray(full)
    below = value.real < full.real
    t = np.where(below, np.where(value.real > 0.0, value, 0.0) / np.where(below, full, 1.0), 1.0)
    return t * t * (3.0 - 2.0 * t)
