"""Equilibrium of a bearing whose loads leave balls alike: one for each kind of place is solved.

Under a thrust all balls are alike, and one carries its part of the load. Under a load across the
axis balls on either side of the load line are mirror images: those on one side are solved, as
long as no motion tells the sides apart. The static stage has the ring's unknowns alone, since a
ball that stands still lies on the line between two grooves' centres; the quasi-static stage begins
there. The balls that were left out are then put in, and ring and balls checked once all together.
"""

from typing import NamedTuple

import numpy as np
import scipy
from numpy.typing import NDArray

from oilfilm.ehl.arrays import Array

from ..geometry import SINGLE, Bearing
from ..operation import Operation, QuasistaticModel
from .balls import BallProblem, ball_problem
from .kinematics import stiffness_at
from .ring import RESIDUAL_TOLERANCE, Ring, RingStart, _guess, _point, ring_of, solve_ring
from .solution import QuasistaticSolution
from .solver import _solution

SAME_PLACE = 1.0e-9  # of azimuths [rad]


class BallClasses(NamedTuple):
    """Balls that are solved, and which of them each ball is like."""

    solved: NDArray[np.int64]  # their numbers, shape (n,)
    class_of: NDArray[np.int64]  # place in `solved`, shape (Z,)


def ball_classes(bearing: Bearing, load: Array) -> BallClasses:
    """Balls that differ under a load of the inner ring.

    All are equal without a load across the axis; else mirror images about the load line.

    Parameters
    ----------
    bearing : Bearing
        geometry of the row
    load : Array
        load of the inner ring, shape (5,) [N], [N m]

    Returns
    -------
    AlikeBalls
        balls to solve, and the one that each ball equals
    """
    count = bearing.balls
    if not np.any(load[1:]):
        return BallClasses(np.zeros(1, dtype=np.int64), np.zeros(count, dtype=np.int64))
    if np.any(load[3:]):
        return BallClasses(np.arange(count), np.arange(count))
    from_line = bearing.azimuths - np.arctan2(load[2], load[1])
    away = np.abs((from_line + np.pi) % (2.0 * np.pi) - np.pi)
    kinds = np.round(away / SAME_PLACE).astype(np.int64)
    _, solved, class_of = np.unique(kinds, return_index=True, return_inverse=True)
    return BallClasses(solved, class_of)


def solve_symmetric(bearing: Bearing, operation: Operation) -> QuasistaticSolution | None:
    """Equilibrium under speeds and loads by the balls that differ.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    operation : Operation
        speeds and loads

    Returns
    -------
    QuasistaticSolution | None
        equilibrium; None if that of the different balls is none for all balls
    """
    model = QuasistaticModel()
    ring = ring_of(bearing, operation)
    problem = ball_problem(bearing, operation.inner_speed, operation.outer_speed, model)
    balls = ball_classes(bearing, ring.load)
    reduced = _reduced_ring(ring, balls)
    start = RingStart(_static_position(reduced, problem), None)
    point, iterations = solve_ring(reduced, problem, start)
    everywhere = RingStart(point.q, point.balls.u[:, balls.class_of])
    full = _point(point.q, everywhere, ring, problem)
    if full.residual > max(RESIDUAL_TOLERANCE, full.noise):
        return None
    return _solution((bearing, operation, model, SINGLE), ring, problem, full, iterations)


def unknowns(bearing: Bearing, operation: Operation) -> tuple[int, int]:
    """Unknowns of `solve_symmetric`.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    operation : Operation
        speeds and loads

    Returns
    -------
    static
        in the static stage [-]
    quasi_static
        in the quasi-static stage [-]
    """
    ring = ring_of(bearing, operation)
    balls = ball_classes(bearing, ring.load)
    free = int(_reduced_ring(ring, balls).free.sum())
    return free, free + 2 * balls.solved.size


def _reduced_ring(ring: Ring, balls: BallClasses) -> Ring:
    """The ring on the balls that are solved, each of which counts for those like it."""
    times = np.bincount(balls.class_of)
    load = ring.load
    free = ring.free.copy()
    if balls.solved.size == 1:  # its part of the thrust, for a first guess of the right size
        times = np.ones(1, dtype=np.int64)
        load = ring.load / balls.class_of.size
        free[1:] = False
    elif balls.solved.size < balls.class_of.size and load[2] == 0.0:
        free[2] = False
    return ring._replace(
        free=free,
        load=load,
        offset=ring.offset[balls.solved],
        movement=ring.movement[:, :, balls.solved],
        gather=ring.gather[:, :, balls.solved] * times,
    )


def _static_position(ring: Ring, problem: BallProblem) -> Array:
    """Ring position at which balls that stand still carry its load [m]; a guess by formula where
    no such is found.
    """
    guess = _guess(ring, problem)
    free = np.flatnonzero(ring.free)
    largest = float(np.abs(ring.load).max())
    if free.size == 0 or largest == 0.0:
        return guess

    def unbalance(x: Array) -> Array:
        q = guess.copy()
        q[free] = x * ring.distance
        V = ring.position(q)
        length = np.hypot(*V)
        give = sum(
            stiffness_at(series, V[1] / length) ** (-2.0 / 3.0)
            for series in (problem.inner_series, problem.outer_series)
        )
        load = (np.maximum(length - ring.distance, 0.0) / give) ** 1.5
        forces = np.stack([-load * V[0] / length, -load * V[1] / length, 0.0 * load])
        total = np.einsum("qfz,fz->q", ring.gather, forces) + ring.load
        return np.asarray(total[free] / largest)

    result = scipy.optimize.root(unbalance, guess[free] / ring.distance)
    position = guess.copy()
    if result.success:
        position[free] = result.x * ring.distance
    return position
