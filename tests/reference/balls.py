"""Balance of balls in NumPy, its derivatives by a complex step, and the balls in equilibrium: twins of kernels."""

from typing import NamedTuple

import numpy as np

from oilfilm.bearing.quasistatic._kernels import BALL_TARGET, BALL_TOLERANCE, MAX_BALL_STEPS, MAX_HALVINGS
from oilfilm.bearing.quasistatic.balls import (
    LIGHT_LOAD_RATIO,
    BallProblem,
    BallsEquilibrium,
    BallState,
    _start,
    ball_state,
)
from oilfilm.bearing.quasistatic.kinematics import ROUND_OFF

STEP = 1.0e-30  # [m]


def ball_balance(state: BallState, problem: BallProblem) -> np.ndarray:
    """Residual of the ball equilibrium and what the ball does to the rings, shape (6, ...): force
    on the ball (x, r) [N], force on the inner ring (x, r) [N], couple on it about e_t [N m], for
    the friction acts r_i away from the groove's centre, where the normal force passes, and the
    centrifugal force that the outer ring takes beyond that of the inner [N].
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
            state.centrifugal_force + 0.0 * from_inner_r,
        ]
    )


def balances_twin(u: np.ndarray, V: np.ndarray, problem: BallProblem) -> tuple[np.ndarray, ...]:
    """Values (6, Z), sums of forces (Z,) and derivatives (6, 4, Z) by u_x, u_r, w_x, w_r at balls (2, Z) [m]."""
    z = np.broadcast_to(np.concatenate([u, V - u])[:, None, :], (4, 4, u.shape[1])).astype(np.complex128)
    z[range(4), range(4)] += 1j * STEP
    state = ball_state(z[:2], z[2:], problem)
    result = ball_balance(state, problem)
    size = (state.inner_load + state.outer_load + state.centrifugal_force).real[0]
    return result.real[:, 0], size, result.imag / STEP


class _Evaluation(NamedTuple):
    u: np.ndarray
    values: np.ndarray  # (6, Z)
    size: np.ndarray  # (Z,) sum of the forces [N]
    jacobian: np.ndarray  # (6, 4, Z), with respect to u_x, u_r, w_x, w_r


def evaluated(u, V, problem):
    """Balance and its derivatives."""
    return _Evaluation(u, *balances_twin(u, V, problem))


def solve_balls_twin(V: np.ndarray, u_start: np.ndarray | None, problem: BallProblem) -> BallsEquilibrium:
    """Equilibrium of all balls at a given position of the inner ring; its `residual` says how well
    each ball is in balance.

    `V` (2, Z): axial and radial distance from the outer to the inner groove's centre of
    curvature at each ball [m]; `u_start` (2, Z): guess of the ball positions [m].
    """
    u = _start(V, u_start, problem)
    current = evaluated(u, V, problem)
    for _ in range(MAX_BALL_STEPS):
        # 1. balls not yet in balance
        _, values, size, jacobian = current
        active = np.hypot(values[0], values[1]) > np.maximum(BALL_TARGET * size, _round_off(current, problem))
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


def _round_off(current: _Evaluation, problem: BallProblem) -> np.ndarray:
    """Force [N] that rounding the positions is worth: the approach is a small difference of
    lengths.
    """
    stiffness: np.ndarray = np.abs(current.jacobian[:2]).max(axis=(0, 1))
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
    u: np.ndarray, step: np.ndarray, V: np.ndarray, current: _Evaluation, problem: BallProblem
) -> tuple[_Evaluation, np.ndarray]:
    """Shorten the step of each ball until its residual falls or the force no longer opposes it;
    else it stays.
    """
    norm = np.hypot(current.values[0], current.values[1])
    factor = np.where((step != 0.0).any(axis=0), 1.0, 0.0)
    for _ in range(MAX_HALVINGS):
        trial = evaluated(u + factor * step, V, problem)
        smaller = np.hypot(trial.values[0], trial.values[1]) < (1.0 - 1e-4 * factor) * norm
        along = (trial.values[:2] * step).sum(axis=0) > 0.0
        failed = (factor > 0.0) & ~(smaller | (along & (norm > BALL_TOLERANCE * current.size)))
        if not failed.any():
            break
        stuck = failed & (norm <= BALL_TOLERANCE * current.size)
        factor = np.where(stuck, 0.0, np.where(failed, 0.4 * factor, factor))
    return trial, factor > 0.0


def _elastic_step(u: np.ndarray, V: np.ndarray, values: np.ndarray, problem: BallProblem) -> np.ndarray:
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
        matrix += stiff * along + side / distance * (identity - along) + 0.1 * weight / length * identity
    return _solve_2x2(matrix, values[:2])


def _solve_2x2(matrix: np.ndarray, right: np.ndarray) -> np.ndarray:
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


def _limit(step: np.ndarray, longest: float) -> np.ndarray:
    length = np.hypot(step[0], step[1])
    return step * np.minimum(1.0, longest / np.maximum(length, 1e-300))
