"""Newton's method for the balance of friction on balls: all balls at once, each by itself."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from oilfilm.ehl.arrays import Array

from ._kernels import accept_steps, damped_steps, left_on_balls, motions
from .contact_friction import TINY, ContactFriction

# Measured on Coulomb friction of 25 random bearings: each halved and doubled leaves all balls
# balanced and the friction power equal to 2e-11, in 1421 to 1664 evaluations (1444 as they are).
MAX_STEPS = 200
FIRST_DAMPING = 1.0e-6  # over the mean curvature of the power [-]
MAX_DAMPING = 1.0e12  # at which a ball counts as stuck [-]
RUNAWAY = 1.0e4  # speeds over those of curvature slip at which a ball counts as not balanced [-]
BALANCE_TOLERANCE = 1.0e-6  # residual force over mu Q that is accepted [-]
COUPLE_STEPS = (0.0, 0.1, 0.2, 0.35, 0.5, 0.75, 1.0)  # of the gyroscopic couple [-]
BALANCE_TARGET = 1.0e-10  # residual at which iterating stops [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class MotionProblem:
    """Motions of contacts k = start + slopes z, with the change z of a ball's motion scaled to
    speeds [m/s].
    """

    law: ContactFriction
    start: Array  # (balls, 2, 4) [m/s], [rad/s]
    slopes: Array  # (balls, 2, 4, 4) of the motions by z [-], [1/m]
    gyroscopic_couple: Array  # (balls, 4) at the start [N]
    gyroscopic_matrix: Array  # (balls, 4, 4) its change with z [N s/m]
    cage_force: Array  # (balls,) push of the cage against the orbit of balls that drive it [N]
    # (balls, 4) of the oil against the orbit, along e_t, and against the rotation [N]
    drag: Array
    # (balls,) friction of the pocket, mu times the push of the cage, against the ball's rotation
    # [N]
    pocket: Array
    # (balls, 2) of a ball's surface in its pocket along e_x and e_r at the start [m/s]
    rubbing: Array
    free: NDArray[np.bool_]  # (balls, 4)
    reference_slip: Array  # (balls,) largest curvature slip of a ball's contacts [m/s]
    reference_force: Array  # (balls,) friction that the residual is measured against [N]
    driven: NDArray[np.bool_]  # (balls,) by the inner race
    ring_motion: Array  # (balls, 2, 4) change of the motion by the rings' speeds [m/s], [rad/s]
    # first one of equal balls, (n,), and the place there of each ball, (balls,)
    first: NDArray[np.int64]
    like: NDArray[np.int64]


def _of_balls(problem: MotionProblem, balls: NDArray[np.int64]) -> tuple[Array, ...]:
    """Arguments of the kernels for the balls with these indices."""
    resisting = problem.cage_force[balls, None] * np.eye(4)[0] + problem.drag[balls]
    return (
        problem.start[balls],
        problem.slopes[balls],
        problem.gyroscopic_couple[balls] + resisting,
        problem.gyroscopic_matrix[balls],
        problem.pocket[balls],
        problem.rubbing[balls],
        problem.free[balls].astype(np.float64),
    )


def _evaluate(
    problem: MotionProblem,
    prepared: tuple[Array, ...],
    balls: NDArray[np.int64],
    at: NDArray[np.int64],
    z: Array,
) -> tuple[Array, Array, Array]:
    """Power (n,), force left (n, 4) and its slope (n, 4, 4) by the scaled unknowns z (n, 4) of the
    balls at these places of `balls`.
    """
    k = np.empty((at.size, 2, 4))
    motions(prepared, at, z, k)
    friction = problem.law.evaluate(k.reshape(-1, 4), contacts_of(balls[at]))
    left = (np.empty(at.size), np.empty((at.size, 4)), np.empty((at.size, 4, 4)))
    left_on_balls(prepared, at, z, tuple(map(np.ascontiguousarray, friction)), left)
    return left


def pocket_power(z: Array, problem: MotionProblem) -> Array:
    """Coulomb's friction of balls in their pockets.

    The pocket touches the ball ahead or behind on its orbit, where its surface moves by its
    rotation in the frame of the orbit; that turns with the cage.

    Parameters
    ----------
    z : Array
        change of the motion of the balls, scaled to speeds, shape (balls, 4) [m/s]
    problem : MotionProblem
        the balance of the balls

    Returns
    -------
    Array
        shape (balls,) [W]
    """
    slide = problem.rubbing + z[:, 1:3]
    return np.asarray(problem.pocket * np.hypot(slide[:, 0], slide[:, 1]))


def contacts_of(balls: NDArray[np.int64]) -> NDArray[np.int64]:
    """Numbers of the contacts of balls, inner then outer.

    Parameters
    ----------
    balls : NDArray[np.int64]
        numbers of balls, shape (n,) [-]

    Returns
    -------
    NDArray[np.int64]
        numbers of their contacts, inner then outer, shape (2 n,) [-]
    """
    return (2 * balls[:, None] + np.arange(2)).ravel()


def solve_with_couple_steps(problem: MotionProblem, start: Array) -> tuple[Array, Array]:
    """Minimise; balls for which that fails are solved again with the gyroscopic couple
    growing in steps (natural continuation, Allgower and Georg, 2003, chapter 2).

    Parameters
    ----------
    problem : MotionProblem
        the balance of the balls
    start : Array
        initial guess, shape (balls, 4) [m/s]

    Returns
    -------
    z
        change of the motion, scaled to speeds, shape (balls, 4) [m/s]
    residual
        force left on each ball over its friction, shape (balls,) [-]
    """
    # 1. the whole couple at once
    z, residual = minimise(problem, start)
    failed = problem.driven & ~(residual <= BALANCE_TOLERANCE)
    coupled = problem.gyroscopic_couple.any() or problem.gyroscopic_matrix.any()
    if not (failed.any() and coupled):
        return z, residual
    # 2. from friction alone, each share of the couple beginning where the last one ended
    trial = np.zeros_like(z)
    for share in COUPLE_STEPS:
        partial = replace(
            problem,
            gyroscopic_couple=share * problem.gyroscopic_couple,
            gyroscopic_matrix=share * problem.gyroscopic_matrix,
        )
        trial, trial_residual = minimise(partial, trial)
    # 3. only balls that failed and got better take it
    better = failed & (trial_residual < residual)
    return np.where(better[:, None], trial, z), np.where(better, trial_residual, residual)


def minimise(problem: MotionProblem, start: Array) -> tuple[Array, Array]:
    """Newton's method with Levenberg's damping (Levenberg, 1944; Nocedal and Wright, 2006, sec.
    10.3), every ball by itself, those that are the same once.

    Parameters
    ----------
    problem : MotionProblem
        the balance of the balls
    start : Array
        initial guess, shape (balls, 4) [m/s]

    Returns
    -------
    z
        change of the motion, scaled to speeds, shape (balls, 4) [m/s]
    residual
        force left on each ball over its friction, shape (balls,) [-]
    """
    balls = problem.first
    z = start[balls]
    residual = np.zeros(balls.size)
    free = np.flatnonzero(problem.free[balls].any(axis=1))
    if free.size:
        z[free], residual[free] = _minimise(problem, balls[free], z[free])
    return z[problem.like], residual[problem.like]


def _minimise(
    problem: MotionProblem, balls: NDArray[np.int64], start: Array
) -> tuple[Array, Array]:
    """Minimise for the balls with these indices."""
    friction = problem.reference_force[balls] + TINY
    slip = problem.reference_slip[balls]
    given = _of_balls(problem, balls)
    every = np.arange(balls.size)
    z = start.copy()
    damping = np.full(balls.size, FIRST_DAMPING)
    state = (z, *_evaluate(problem, given, balls, every, z), damping)
    # a skew gyroscopic matrix has no potential: the residual has to fall instead of the power
    descent = problem.law.is_potential and not problem.gyroscopic_matrix.any()
    limits = (BALANCE_TARGET, RUNAWAY, MAX_DAMPING)
    at = np.empty(balls.size, dtype=np.int64)
    trial = np.empty((balls.size, 4))
    for _ in range(MAX_STEPS):
        # 1. damped steps of balls that are neither balanced, nor run away, nor stuck
        count = damped_steps(state, friction, slip, limits, at, trial)
        if count == 0:
            break
        # 2. accepted where the power or the force left falls
        new = _evaluate(problem, given, balls, at[:count], trial[:count])
        accept_steps(state, at[:count], trial[:count], new, descent, MAX_DAMPING)
    return z, np.abs(state[2]).max(axis=1) / friction
