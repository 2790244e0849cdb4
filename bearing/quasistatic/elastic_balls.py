r"""Balls between elastic rings: Newton's method for the distances of the grooves' centres.

.. math:: V - V_{rigid} - e(F(V)) = 0

with the forces F of the balls and what the rings yield under them, e (`rings.compliance`). The
tangent is I - (de/dF)(dF/dV); contacts that stiffen and a compliance that costs energy keep its
eigenvalues above one, whatever the load.
"""

from typing import NamedTuple

import numpy as np

from ehl.arrays import Array

from ..rings.compliance import RingCompliance
from .ball_equilibrium import BallsEquilibrium, solve_balls
from .balls import BallProblem
from .limits import ROUND_OFF

MAX_STEPS = 40
MAX_HALVINGS = 20
SUFFICIENT_DECREASE = 1.0e-4  # Armijo's constant (Nocedal and Wright, 2006, sec. 3.1) [-]


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
