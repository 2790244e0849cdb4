"""Rolling without sliding at both contact centres, by the velocity field of the rigid bodies themselves."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing import BallKinematics
from oilfilm.bearing.operation import HYPOTHESES
from oilfilm.bearing.quasistatic.kinematics import (
    Direction,
    Motion,
    attitude,
    ball_mass,
    blend,
    centrifugal_force,
    gyroscopic_moment,
    rolling_motion,
)

GAMMA = 0.2
INNER, OUTER = 1100.0, -300.0  # [rad/s]


def motion_of(kinematics, inner=0.75, outer=0.5):
    ai, ao = (Direction(np.sin([angle]), np.cos([angle])) for angle in (inner, outer))
    beta = attitude(ao, ai, GAMMA, kinematics)
    return rolling_motion(ao, ai, beta, GAMMA, INNER, OUTER), ai, ao


@pytest.mark.parametrize("kinematics", HYPOTHESES)
def test_no_sliding_at_either_centre(kinematics):
    """Velocities of ball and races at the contacts, cross products in (x, r, t), D = 0.2 and d_m = 1."""
    motion, ai, ao = motion_of(kinematics)
    omega = motion.spin_speed[0] * np.array([-motion.attitude.cos[0], motion.attitude.sin[0], 0.0])
    for angle, side, speed in ((ai, -1.0, INNER), (ao, 1.0, OUTER)):
        arm = 0.5 * GAMMA * side * np.array([angle.sin[0], angle.cos[0], 0.0])
        ball = np.cross(omega, arm)
        race = np.cross([speed - motion.orbit_speed[0], 0.0, 0.0], np.array([0.0, 0.5, 0.0]) + arm)
        assert_allclose(ball[2], race[2], rtol=1e-12)


@pytest.mark.parametrize(
    ("kinematics", "side"), [(BallKinematics.OUTER_RACE_CONTROL, 1.0), (BallKinematics.INNER_RACE_CONTROL, -1.0)]
)
def test_control_means_no_spin(kinematics, side):
    """The relative angular velocity has no component along the normal of the controlling race."""
    motion, ai, ao = motion_of(kinematics)
    omega = motion.spin_speed[0] * np.array([-motion.attitude.cos[0], motion.attitude.sin[0]])
    angle, speed = (ao, OUTER) if side > 0.0 else (ai, INNER)
    relative = omega - np.array([speed - motion.orbit_speed[0], 0.0])
    assert abs(relative @ np.array([angle.sin[0], angle.cos[0]])) < 1e-9


def test_equal_angles_give_the_textbook_cage_speed():
    """Half and half at equal angles: w_m = [w_i (1 - g cos a) + w_o (1 + g cos a)]/2."""
    motion, _, _ = motion_of(BallKinematics.HALF_AND_HALF, 0.4, 0.4)
    cosine = GAMMA * np.cos(0.4)
    assert_allclose(motion.orbit_speed, 0.5 * (INNER * (1.0 - cosine) + OUTER * (1.0 + cosine)), rtol=1e-14)
    assert_allclose(motion.spin_speed, 0.5 * (INNER - OUTER) * (1.0 - cosine**2) / GAMMA, rtol=1e-14)


def test_least_spin_dissipation_lies_at_a_race_control():
    """Outer weight 1, inner weight w, Coulomb friction: no attitude loses less than the better race control does."""
    rng = np.random.default_rng(7319)
    for _ in range(200):
        gamma, outer, lag, weight = rng.uniform([0.05, 0.05, 0.0, 0.2], [0.3, 0.9, 0.5, 5.0])
        ao, ai = (Direction(np.sin(angle), np.cos(angle)) for angle in (outer, outer + lag))
        ends = [
            attitude(ao, ai, gamma, k) for k in (BallKinematics.OUTER_RACE_CONTROL, BallKinematics.INNER_RACE_CONTROL)
        ]
        limits = sorted(float(np.arctan2(end.sin, end.cos)) for end in ends)
        angles = np.concatenate([limits, np.linspace(limits[0] - 0.3, limits[1] + 0.3, 201)])
        motion = rolling_motion(ao, ai, Direction(np.sin(angles), np.cos(angles)), gamma, 1.0, 0.0)
        outer_spin = motion.spin_speed * np.sin(angles - outer) + motion.orbit_speed * ao.sin
        inner_spin = motion.spin_speed * np.sin(angles - outer - lag) - (1.0 - motion.orbit_speed) * ai.sin
        loss = np.abs(outer_spin) + weight * np.abs(inner_spin)
        assert loss[:2].min() <= loss.min() * (1.0 + 1e-9)


def test_blend_reaches_both_ends():
    one, two = Direction(np.array([0.6]), np.array([0.8])), Direction(np.array([0.0]), np.array([1.0]))
    assert_allclose(blend(one, two, np.array([0.0])), one, atol=1e-16)
    assert_allclose(blend(one, two, np.array([1.0])), two, atol=1e-16)


def test_body_forces_by_hand():
    """7800 kg/m^3 x pi/6 x (12 mm)^3 = 7.0573 g; m r w^2 and 2/5 m r^2 w_m w_R sin(30 deg) of 7 g, r 30 and 6 mm."""
    assert ball_mass(0.012, 7800.0) == pytest.approx(7.0573e-3, rel=1e-5)
    assert centrifugal_force(0.007, 0.06, np.array(500.0)) == pytest.approx(52.5, rel=1e-12)
    motion = Motion(np.array(500.0), np.array(2000.0), Direction(np.array(0.5), np.array(0.75**0.5)))
    assert gyroscopic_moment(0.007, 0.012, motion) == pytest.approx(0.0504, rel=1e-12)
