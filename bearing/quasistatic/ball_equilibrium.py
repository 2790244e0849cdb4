"""Equilibrium of every ball at a given position of the inner ring, and its derivatives.

With constant Hertz stiffness and without gyroscopic couple the equilibrium is the minimum of an
energy convex in the ball's position, so Newton's method with backtracking finds the one solution;
the rest is a mild perturbation. All balls are iterated together, and all derivatives come from one
complex-step evaluation.
"""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..geometry import Array
from ..operation import BallKinematics
from ._ball_kernels import INNER_CONTROL, MEAN_ANGLE, OUTER_CONTROL, balances
from .balls import BallProblem, ball_state
from .contact_stiffness import stiffness_at
from .kinematics import INNER_PART
from .limits import EDGE_COSINE

COMPLEX_STEP = 1.0e-30  # [m]
# a ball that carries less than this part of the largest forces is measured against these [-]
LIGHT_LOAD_RATIO = 1.0e-4
ROUND_OFF = 8.0 * float(np.finfo(np.float64).eps)  # [-]
BALL_TARGET = 1.0e-13  # residual of a ball over its forces at which iterating stops [-]
# residual of a ball over its forces that is accepted when it falls no further [-]
BALL_TOLERANCE = 1.0e-11
MAX_HALVINGS = 12
MAX_BALL_STEPS = 30
CODES = {
    BallKinematics.OUTER_RACE_CONTROL: OUTER_CONTROL,
    BallKinematics.INNER_RACE_CONTROL: INNER_CONTROL,
}
# code of a hypothesis for the kernel, and what of the couple the inner race holds [-]
HYPOTHESES = {
    kind: (CODES.get(kind, MEAN_ANGLE), INNER_PART.get(kind, 0.0)) for kind in BallKinematics
}


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
    """Equilibrium of all balls at a given position of the inner ring; its `residual` says how well
    each ball is in balance.

    `V` (2, Z): axial and radial distance from the outer to the inner groove's centre of
    curvature at each ball [m]; `u_start` (2, Z): guess of the ball positions [m].
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
    values: Array  # (6, Z)
    size: Array  # (Z,) sum of the forces [N]
    jacobian: Array  # (6, 4, Z), with respect to u_x, u_r, w_x, w_r


def _evaluate(u: Array, V: Array, problem: BallProblem) -> _Evaluation:
    """Balance and its derivatives by a complex step in each of u_x, u_r, w_x, w_r."""
    count = u.shape[1]
    values = np.empty((6, count))
    size = np.empty(count)
    jacobian = np.empty((6, 4, count))
    balances(u, V, _given(problem, count), COMPLEX_STEP, values, size, jacobian)
    return _Evaluation(u, values, size, jacobian)


def _given(problem: BallProblem, balls: int) -> tuple[Any, ...]:
    """What the kernel takes of a problem."""
    prescribed = problem.prescribed
    known = np.empty((0, balls))
    if prescribed is not None:
        motion = prescribed.motion
        frictions = (prescribed.inner_friction, prescribed.outer_friction)
        known = np.stack([motion.orbit_speed, motion.spin_speed, *motion.attitude, *frictions])
    return (
        (problem.inner_length, problem.outer_length, problem.inner_groove_radius),
        (problem.ball_diameter, problem.pitch_diameter, problem.mass, problem.nominal_couple),
        (problem.inner_speed, problem.outer_speed),
        HYPOTHESES[problem.kinematics],
        known,
        problem.inner_series,
        problem.outer_series,
    )


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
    noise = float((_round_off(current, problem) / scale).max())
    return BallsEquilibrium(u, values, du_dV, ring_dV, norm / scale, noise)


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


def _solve_2x2(matrix: Array, right: Array) -> Array:
    """Solve 2 x 2 systems, matrix (2, 2, Z), right (2, Z); balls free of all force (matrix zero)
    do not move.
    """
    (a, b), (c, d) = matrix
    determinant = a * d - b * c
    scale = a * a + b * b + c * c + d * d
    safe = np.abs(determinant) > 1e-14 * scale
    inverse = np.where(safe, 1.0, 0.0) / np.where(safe, determinant, 1.0)
    adjugate = [d * right[0] - b * right[1], a * right[1] - c * right[0]]
    solved = np.stack(adjugate) * inverse
    # the matrix is negative: step along the force
    gradient = -right / np.sqrt(np.where(scale > 0.0, scale, 1.0))
    return np.where(safe, solved, np.where(scale > 0.0, gradient, 0.0))


def _limit(step: Array, longest: float) -> Array:
    length = np.hypot(step[0], step[1])
    return step * np.minimum(1.0, longest / np.maximum(length, 1e-300))
