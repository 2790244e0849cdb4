"""Compiled parts of the balance of balls against their NumPy twins."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose

from oilfilm.bearing.friction._kernels import damped_steps
from oilfilm.bearing.friction.contact_friction import ContactFriction, Dissipation
from oilfilm.bearing.friction.newton import MotionProblem, _evaluate, _of_balls, pocket_power

from ...reference.newton import damped_step_twin, left_on_balls_twin, pocket_friction_twin

BALLS = 5


def problem():
    """Balls with every kind of force, under a law that is a smooth function of the motion."""
    rng = np.random.default_rng(3319)

    def evaluate(motion, indices):
        part = np.sin(motion + indices[:, None])
        return Dissipation(part.sum(axis=1), part, part[:, :, None] * np.cos(motion)[:, None, :])

    return MotionProblem(
        law=ContactFriction(evaluate=evaluate, reference_force=np.ones(2 * BALLS)),
        start=rng.normal(size=(BALLS, 2, 4)),
        slopes=rng.normal(size=(BALLS, 2, 4, 4)),
        gyroscopic_couple=rng.normal(size=(BALLS, 4)),
        gyroscopic_matrix=rng.normal(size=(BALLS, 4, 4)),
        cage_force=rng.random(BALLS),
        drag=rng.random((BALLS, 4)),
        pocket=rng.random(BALLS),
        rubbing=rng.normal(size=(BALLS, 2)),
        free=rng.random((BALLS, 4)) < 0.8,
        reference_slip=np.ones(BALLS),
        reference_force=np.ones(BALLS),
        driven=np.ones(BALLS, dtype=bool),
        ring_motion=rng.normal(size=(BALLS, 2, 4)),
        first=np.arange(BALLS),
        like=np.arange(BALLS),
    )


def test_forces_left_on_balls_agree_with_their_twin():
    given = problem()
    balls, at = np.array([0, 2, 3, 4]), np.array([0, 1, 3])
    z = np.random.default_rng(9157).normal(size=(3, 4))
    found = _evaluate(given, _of_balls(given, balls), balls, at, z)
    for own, twin in zip(found, left_on_balls_twin(z, given, balls[at]), strict=True):
        assert_allclose(own, twin, rtol=1e-12, atol=1e-13)
    every = np.random.default_rng(2203).normal(size=(BALLS, 4))
    assert_allclose(pocket_power(every, given), pocket_friction_twin(every, given, np.arange(BALLS)).power, rtol=1e-13)


def test_damped_steps_agree_with_their_twin():
    rng = np.random.default_rng(7703)
    z, gradient = rng.normal(size=(2, BALLS, 4))
    hessian = rng.normal(size=(BALLS, 4, 4)) + 3.0 * np.eye(4)
    damping = 10.0 ** rng.uniform(-6.0, 1.0, BALLS)
    damping[1] = 1e13  # stuck
    gradient[3] = 0.0  # balanced
    at, trial = np.empty(BALLS, dtype=np.int64), np.empty((BALLS, 4))
    ones = np.ones(BALLS)
    count = damped_steps((z, ones, gradient, hessian, damping), ones, ones, (1e-10, 1e4, 1e12), at, trial)
    moving = [0, 2, 4]
    assert at[:count].tolist() == moving
    size = np.maximum(np.trace(hessian, axis1=1, axis2=2), 1.0)
    expected = damped_step_twin(z, gradient, hessian, damping, size)
    assert_allclose(trial[:count], expected[moving], rtol=1e-12)
