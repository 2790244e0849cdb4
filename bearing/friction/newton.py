"""Newton's method for the balance of friction on balls: all balls at once, each by itself."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..geometry import Array
from .ellipse import TINY, Dissipation

MAX_STEPS = 200
RUNAWAY = 1.0e4  # speeds over those of curvature slip at which a ball counts as not held [-]
BALANCE_TOLERANCE = 1.0e-6  # residual force over mu Q that is accepted [-]
COUPLE_STEPS = (0.0, 0.1, 0.2, 0.35, 0.5, 0.75, 1.0)  # of the gyroscopic couple [-]
BALANCE_TARGET = 1.0e-10  # residual at which iterating stops [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactLaw:
    """Friction of the contacts of a bearing, numbered inner race then outer, ball by ball.

    Attributes
    ----------
    dissipation : callable
        Takes the motions (N, 4) of contacts [m/s], [rad/s] and their numbers (N,), gives a
        `Dissipation`.
    strength : ndarray, shape (contacts,)
        Friction of each contact that residual forces are measured against [N].
    plane : bool
        It knows no sliding across the rolling direction: balls then do not turn about the orbit's
        tangent, and no gyroscopic couple is held.
    pumps : bool
        The oil's rolling resistance is in it.
    potential : bool
        Whether the power is the potential of the forces; if not, only these are looked at.
    """

    dissipation: Callable[[Array, NDArray[np.int64]], Dissipation]
    strength: Array
    plane: bool = False
    pumps: bool = True
    potential: bool = True


@dataclass(frozen=True, slots=True, kw_only=True)
class MotionProblem:
    """k = start + map z for all contacts, z scaled to speeds [m/s]."""

    law: ContactLaw
    start: Array  # (balls, 2, 4)
    map: Array  # (balls, 2, 4, 4)
    couple: Array  # (balls, 4) gyroscopic one at the start [N]
    turning: Array  # (balls, 4, 4) its change with z [N s/m]
    cage: Array  # (balls,) push of the cage against the orbit of balls that drive it [N]
    drag: Array  # (balls,) force of the oil against the orbit, along e_t [N]
    free: NDArray[np.bool_]  # (balls, 4)
    reach: Array  # (balls,) largest sliding that the curvature of a ball's contacts makes [m/s]
    strength: Array  # (balls,) friction that the residual is measured against [N]
    driven: NDArray[np.bool_]  # (balls,) by the inner race
    ring: Array  # (balls, 2, 4) change of the motion by the rings' speeds [m/s], [rad/s]


def evaluate(
    z: Array, problem: MotionProblem, balls: NDArray[np.int64]
) -> tuple[Array, Array, Array]:
    """Power (n,), force left (n, 4) and its slope (n, 4, 4) by the scaled unknowns of the balls
    with these numbers.
    """
    move, free = problem.map[balls], problem.free[balls]
    k = problem.start[balls] + np.einsum("bckj,bj->bck", move, z)
    found = problem.law.dissipation(k.reshape(-1, 4), contacts_of(balls))
    shape = k.shape[:2]
    fixed = problem.couple[balls] + (problem.cage + problem.drag)[balls, None] * np.eye(4)[0]
    power = found.power.reshape(shape).sum(axis=1) + np.einsum("bj,bj->b", fixed, z)
    gradient = np.einsum("bckj,bck->bj", move, found.gradient.reshape(*shape, 4)) + fixed
    gradient += np.einsum("bij,bj->bi", problem.turning[balls], z)
    curvature = found.curvature.reshape(*shape, 4, 4)
    slope = (move.swapaxes(2, 3) @ curvature @ move).sum(axis=1) + problem.turning[balls]
    return (
        power,
        np.where(free, gradient, 0.0),
        np.where(free[:, :, None] & free[:, None, :], slope, 0.0),
    )


def contacts_of(balls: NDArray[np.int64]) -> NDArray[np.int64]:
    """Numbers of the contacts of balls, inner then outer [-]."""
    return (2 * balls[:, None] + np.arange(2)).ravel()


def settle(problem: MotionProblem, start: Array) -> tuple[Array, Array]:
    """As `minimise`, and where that fails from friction alone, the gyroscopic couple growing in
    steps.
    """
    z, residual = minimise(problem, start)
    stuck = problem.driven & ~(residual <= BALANCE_TOLERANCE)
    if not (stuck.any() and (problem.couple.any() or problem.turning.any())):
        return z, residual
    trial = np.zeros_like(z)
    for part in COUPLE_STEPS:
        eased = replace(problem, couple=part * problem.couple, turning=part * problem.turning)
        trial, left = minimise(eased, trial)
    better = stuck & (left < residual)
    return np.where(better[:, None], trial, z), np.where(better, left, residual)


def minimise(problem: MotionProblem, start: Array) -> tuple[Array, Array]:
    """Newton with Levenberg's damping, every ball by itself; returns z and the residual of each
    ball [-].
    """
    balls = np.arange(problem.start.shape[0])
    friction = problem.strength + TINY
    z = start.copy()
    damping = np.full(balls.size, 1e-6)
    power, gradient, hessian = evaluate(z, problem, balls)
    # there is a potential to go down in
    descent = problem.law.potential and not problem.turning.any()
    for _ in range(MAX_STEPS):
        residual = np.abs(gradient).max(axis=1) / friction
        going = (
            (residual > BALANCE_TARGET)
            & (np.abs(z).max(axis=1) < RUNAWAY * problem.reach)
            & (damping < 1e12)
        )
        at = np.flatnonzero(going)
        if at.size == 0:
            break
        size = np.maximum(
            np.trace(hessian[at], axis1=1, axis2=2), friction[at] / problem.reach[at]
        )
        damped = hessian[at] + (damping[at] * size)[:, None, None] * np.eye(4)
        trial = z[at] - np.linalg.solve(damped, gradient[at][..., None])[..., 0]
        new = evaluate(trial, problem, at)
        noise = 1e-13 * np.abs(power[at])
        flatter = np.abs(new[1]).max(axis=1) < residual[at] * friction[at]
        lower = (new[0] < power[at] - noise) | ((new[0] <= power[at] + noise) & flatter)
        better = lower if descent else flatter
        kept = at[better]
        z[kept], power[kept], gradient[kept], hessian[kept] = (
            trial[better],
            *(part[better] for part in new),
        )
        damping[at] = np.clip(np.where(better, 0.2, 6.0) * damping[at], 1e-14, 1e13)
    return z, np.abs(gradient).max(axis=1) / friction
