"""Balance of balls in NumPy and its derivatives by a complex step, twin of the kernel `balances`."""

import numpy as np

from bearing.quasistatic.balls import BallProblem, BallState, ball_state

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
