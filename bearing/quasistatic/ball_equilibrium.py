"""Equilibrium of every ball at a given position of the inner ring, and its derivatives.

With constant Hertz stiffness and without gyroscopic couple the equilibrium is the minimum of an
energy convex in the ball's position, so Newton's method with backtracking finds the one solution;
the rest is a mild perturbation. Every ball is iterated by itself, compiled, and all derivatives
come from complex steps.
"""

from typing import Any, NamedTuple

import numpy as np

from ehl.arrays import Array

from ..operation import BallKinematics
from ._ball_kernels import INNER_CONTROL, MEAN_ANGLE, OUTER_CONTROL
from ._equilibrium_kernels import balanced_balls
from .balls import BallProblem
from .contact_stiffness import stiffness_at
from .kinematics import INNER_PART
from .limits import EDGE_COSINE

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
