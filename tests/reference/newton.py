"""Forces left on balls, and Newton's damped step, in NumPy: twins of the kernels of `bearing.friction.newton`."""

import numpy as np

from oilfilm.bearing.friction.contact_friction import TINY, Dissipation
from oilfilm.bearing.friction.newton import MotionProblem, contacts_of
from oilfilm.ehl.arrays import Array


def left_on_balls_twin(z: Array, problem: MotionProblem, balls: Array) -> tuple[Array, Array, Array]:
    """Power (n,), force left (n, 4) and its slope (n, 4, 4) by the scaled unknowns of the balls
    with these indices.
    """
    slopes = problem.slopes[balls]
    free = problem.free[balls]
    k = problem.start[balls] + np.einsum("bckj,bj->bck", slopes, z)
    friction = problem.law.evaluate(k.reshape(-1, 4), contacts_of(balls))
    shape = k.shape[:2]
    along_orbit = problem.cage_force[balls, None] * np.eye(4)[0] + problem.drag[balls]
    fixed = problem.gyroscopic_couple[balls] + along_orbit
    pocket = pocket_friction_twin(z, problem, balls)
    power = friction.power.reshape(shape).sum(axis=1) + np.einsum("bj,bj->b", fixed, z)
    power += pocket.power
    gradient = np.einsum("bckj,bck->bj", slopes, friction.gradient.reshape(*shape, 4)) + fixed
    gradient[:, 1:3] += pocket.gradient
    gradient += np.einsum("bij,bj->bi", problem.gyroscopic_matrix[balls], z)
    curvature = friction.curvature.reshape(*shape, 4, 4)
    hessian = (slopes.swapaxes(2, 3) @ curvature @ slopes).sum(axis=1)
    hessian = hessian + problem.gyroscopic_matrix[balls]
    hessian[:, 1:3, 1:3] += pocket.curvature
    return (power, np.where(free, gradient, 0.0), np.where(free[:, :, None] & free[:, None, :], hessian, 0.0))


def pocket_friction_twin(z: Array, problem: MotionProblem, balls: Array) -> Dissipation:
    """Coulomb's friction of balls in their pockets, power (n,) [W], gradient (n, 2) [N] and
    curvature (n, 2, 2) [N s/m] by the scaled rotations along e_x and e_r.

    The pocket touches the ball ahead or behind on its orbit, where its surface moves by its
    rotation in the frame of the orbit; that turns with the cage.
    """
    slide = problem.rubbing[balls] + z[:, 1:3]
    speed = np.hypot(slide[:, 0], slide[:, 1]) + TINY
    along = slide / speed[:, None]
    force = problem.pocket[balls]
    across = np.eye(2) - along[:, :, None] * along[:, None, :]
    return Dissipation(force * speed, force[:, None] * along, (force / speed)[:, None, None] * across)


def damped_step_twin(z: Array, gradient: Array, hessian: Array, damping: Array, size: Array) -> Array:
    """Unknowns after a step with so much of the mean curvature added, (n, 4)."""
    damped = hessian + (damping * size)[:, None, None] * np.eye(4)
    return z - np.linalg.solve(damped, gradient[..., None])[..., 0]
