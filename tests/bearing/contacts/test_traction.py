"""Motion of ball over race, against the scalar formulas of the bearing's own contacts."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm import ehl
from oilfilm.bearing import Operation, solve_quasistatic
from oilfilm.bearing.contacts.contacts import contact_conditions
from oilfilm.bearing.contacts.motion import BallMotion, ball_speeds, bearing_kinematics, contact_frames, motion_map
from oilfilm.bearing.contacts.shape import groove_curvature_radius
from oilfilm.bearing.geometry import Race

from ...reference.rolling import rolling_and_spin

OIL = ehl.Lubricant(viscosity=0.0261, pressure_viscosity=18e-9)


@pytest.fixture(scope="module", params=[(1.0, 0.0), (-1.0, 0.0), (0.3, 1.0)], ids=["inner", "backwards", "both rings"])
def solved(request, bearings):
    inner, outer = (10000.0 * bearings.rpm * part for part in request.param)
    return solve_quasistatic(
        bearings.b218, Operation(inner_speed=inner, outer_speed=outer, force=(22250.0, 4000.0, 0.0))
    )


def first_ball(solved):
    orbit, rotation = ball_speeds(solved)
    return BallMotion(orbit_speed=orbit[0], rotation=rotation[0])


def test_motion_agrees_with_rolling_and_spin(solved):
    """Without sliding at the centre: entrainment, rolling, spin as `rolling_and_spin`, rolling u_m/R_x."""
    for contact in contact_conditions(solved, OIL):
        motion = bearing_kinematics(solved, contact)
        speed, rolling, spin = rolling_and_spin(solved, contact.ball - 1, contact.race)
        scale = abs(speed)
        assert_allclose(motion.entrainment_speed, abs(speed), rtol=1e-12)
        assert_allclose([motion.sliding_x, motion.sliding_y, motion.entrainment_lateral], 0.0, atol=1e-11 * scale)
        assert_allclose(motion.rolling, rolling, rtol=1e-12)
        assert_allclose(motion.spin, spin, rtol=1e-12)
        assert motion.rolling > 0.0
        assert_allclose(motion.rolling, motion.entrainment_speed / contact.hertz.radius_x, rtol=1e-12)


def test_lagging_ball_slides_backwards(solved):
    """A ball that turns 1 % slower about its own axis has 1 % less surface speed at both contacts."""
    contacts = contact_conditions(solved, OIL)
    for contact in contacts[:2]:
        motion = first_ball(solved)
        slower = BallMotion(orbit_speed=motion.orbit_speed, rotation=0.99 * motion.rotation)
        found = bearing_kinematics(solved, contact, slower)
        assert_allclose(found.sliding_x, -0.01 * contact.conditions.entrainment_speed, rtol=1e-9)


def test_turning_about_the_track_slides_across(solved):
    """w_t e_t moves the ball's surface by w_t D/2 across, in opposite directions at the two contacts."""
    inner, outer = contact_conditions(solved, OIL)[:2]
    motion = first_ball(solved)
    turning = BallMotion(orbit_speed=motion.orbit_speed, rotation=motion.rotation + np.array([0.0, 0.0, 5.0]))
    for contact in (inner, outer):
        found = bearing_kinematics(solved, contact, turning)
        expected = 0.5 * solved.bearing.ball_diameter * np.cross([0.0, 0.0, 5.0], contact_frames([contact])[0][2])
        assert_allclose(found.sliding_y, contact_frames([contact])[0][1] @ expected, rtol=1e-9)
        assert abs(found.sliding_x) < 1e-9


def test_all_contacts_at_once_move_as_each_of_them(solved):
    """`motion_map` against `bearing_kinematics`, at other speeds of the balls than those of the equilibrium."""
    rng, contacts = np.random.default_rng(48127), contact_conditions(solved, OIL)
    orbit, rotation = ball_speeds(solved)
    orbit, rotation = orbit * rng.uniform(0.9, 1.1, orbit.shape), rotation + rng.normal(scale=50.0, size=rotation.shape)
    move = motion_map(solved, contacts)
    for contact, found in zip(contacts, move.motion(orbit, rotation), strict=True):
        k = contact.ball - 1
        one = bearing_kinematics(solved, contact, BallMotion(orbit_speed=orbit[k], rotation=rotation[k]))
        assert_allclose(found[:2], [one.sliding_x, one.sliding_y], atol=1e-12 * abs(one.entrainment_speed))
        assert_allclose(found[2:], [one.spin, one.rolling], rtol=1e-12)


def test_axes_in_the_frame_of_the_ball_are_right_handed(solved):
    for contact in contact_conditions(solved, OIL):
        axes = contact_frames([contact])[0]
        assert_allclose(axes @ axes.T, np.eye(3), atol=1e-12)
        assert_allclose(np.cross(axes[0], axes[1]), axes[2], atol=1e-12)
        assert abs(axes[0, 0]) < 1e-12  # entrainment along e_t


def test_loaded_surface_is_flatter_than_the_ball(bearings):
    """R between the ball's and the groove's radius: 6.084 mm for balls of 12 mm in grooves of 6.17 mm."""
    assert_allclose(groove_curvature_radius(bearings.b6208, Race.INNER), 2 * 6.17 * 12.0 / 24.34 * 1e-3)
