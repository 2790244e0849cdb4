"""Contacts handed to the film solver: patches, speeds, frames, ratios."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing import (
    BallKinematics,
    Operation,
    QuasistaticModel,
    Race,
    bearing_frequencies,
    contact_conditions,
    kinematic_frequencies,
    solve_quasistatic,
)
from oilfilm.ehl import Lubricant

from ...reference.rolling import rolling_and_spin

OIL = Lubricant(viscosity=0.0261, pressure_viscosity=18e-9)


@pytest.fixture(scope="module")
def solved(bearings):
    return solve_quasistatic(bearings.b6208, Operation(inner_speed=1e4 * bearings.rpm, force=(0.0, 3000.0, 0.0)))


def test_6208_heaviest_contacts(solved):
    """Independent computation, psi = 0: semi-axes (axial, rolling) in mm, GPa, m/s; four figures."""
    inner, outer = contact_conditions(solved, OIL)[:2]
    for contact, expected in ((inner, (1.7819, 0.15645, 2.734)), (outer, (1.4035, 0.2156, 2.543))):
        h = contact.hertz
        found = (1e3 * h.semi_axis_y, 1e3 * h.semi_axis_x, 1e-9 * h.pressure)
        assert_allclose(found, expected, rtol=2e-4)
        assert contact.conditions.entrainment_speed == pytest.approx(15.08, rel=1e-4)
        assert contact.conditions.slide_roll_ratio == 0.0
        assert contact.conditions.spin == pytest.approx(0.0, abs=1e-9)


def test_order_and_unloaded_contacts(solved):
    contacts = contact_conditions(solved, OIL)
    assert [c.ball for c in contacts] == [1 + k // 2 for k in range(18)]
    assert [c.race for c in contacts[:2]] == [Race.INNER, Race.OUTER]
    unloaded = [c for c in contacts if not c.loaded]
    assert len(unloaded) == 6
    assert all(c.race is Race.INNER and c.load == 0.0 and c.note == "unloaded" for c in unloaded)
    assert all(c.hertz is None for c in unloaded)


def test_mirrored_balls_have_equal_conditions(solved):
    """So that the film of equal contacts is solved once."""
    contacts = contact_conditions(solved, OIL)
    for k in range(1, 5):
        one, two = contacts[2 * k + 1].conditions, contacts[2 * (9 - k) + 1].conditions
        for field in ("load", "radius_x", "radius_y", "entrainment_speed"):
            assert getattr(one, field) == pytest.approx(getattr(two, field), rel=1e-12)


@pytest.mark.parametrize("speed", [1000.0, -1000.0])
def test_frames_are_right_handed_and_follow_the_oil(bearings, speed):
    operation = Operation(inner_speed=speed, force=(2000.0, 500.0, 100.0))
    solution = solve_quasistatic(bearings.b7008, operation)
    contacts = contact_conditions(solution, OIL)
    for contact in contacts:
        frame = np.stack([contact.axis_x, contact.axis_y, contact.normal])
        assert_allclose(frame @ frame.T, np.eye(3), atol=1e-14)
        assert_allclose(np.cross(contact.axis_x, contact.axis_y), contact.normal, atol=1e-14)
        c, s = np.cos(contact.azimuth), np.sin(contact.azimuth)
        tangential = np.array([0.0, -s, c])
        sign = (1.0 if contact.race is Race.INNER else -1.0) * np.sign(speed)
        assert contact.axis_x @ tangential == pytest.approx(sign, rel=1e-12)
        outward = contact.normal @ np.array([0.0, c, s])
        assert outward > 0.0 if contact.race is Race.OUTER else outward < 0.0


def test_a_negligible_load_on_a_film_outside_the_model_is_left_out(bearings):
    """Balls that only their centrifugal force presses outward: left out in thick oil, kept in thin oil; a contact that
    carries the load stays, however thick its film.
    """
    operation = Operation(inner_speed=300.0, force=(0.0, 500.0, 0.0))
    solution = solve_quasistatic(bearings.b209, operation)
    carrying = {1, 2, 9}
    for viscosity, kept in ((0.3, carrying), (0.005, set(range(1, 10)))):
        contacts = contact_conditions(solution, replace(OIL, viscosity=viscosity))
        outer = [c for c in contacts if c.race is Race.OUTER]
        assert {c.ball for c in outer if c.loaded} >= kept
        for contact in outer:
            assert contact.load > 0.0
            assert contact.loaded or (contact.load < 0.02 * solution.outer_load.max() and "thicker" in contact.note)
    thick = contact_conditions(solution, replace(OIL, viscosity=300.0))
    assert [c.ball for c in thick if c.race is Race.OUTER and c.loaded] == sorted(carrying)


def test_contact_points_lie_on_ball_and_race(bearings):
    """At rest, distance to the ball's centre D/2; to the groove's centre the groove radius plus the approach."""
    solution = solve_quasistatic(bearings.b7008, Operation(inner_speed=0.0, force=(2000.0, 0.0, 0.0)))
    b = bearings.b7008
    for contact in contact_conditions(solution, OIL):
        assert contact.note.startswith("no entrainment")
        k = contact.ball - 1
        radial = np.array([0.0, np.cos(contact.azimuth), np.sin(contact.azimuth)])
        centre = solution.ball_axial[k] * np.array([1.0, 0.0, 0.0]) + solution.ball_radial[k] * radial
        assert np.linalg.norm(contact.origin - centre) == pytest.approx(0.5 * b.ball_diameter, rel=1e-12)
        if contact.race is Race.OUTER:
            groove = b.outer_centre_radius * radial
            distance = np.linalg.norm(contact.origin - groove)
            assert distance == pytest.approx(b.outer_groove_radius + contact.hertz.approach, rel=1e-12)


def test_race_control_leaves_spin_to_the_other_race(bearings):
    operation = Operation(inner_speed=1047.0, force=(22250.0, 0.0, 0.0))
    for kinematics, free in (
        (BallKinematics.OUTER_RACE_CONTROL, Race.OUTER),
        (BallKinematics.INNER_RACE_CONTROL, Race.INNER),
    ):
        solution = solve_quasistatic(bearings.b218, operation, QuasistaticModel(ball_kinematics=kinematics))
        for contact in contact_conditions(solution, OIL)[:2]:
            if contact.race is free:
                assert contact.spin_roll_ratio < 1e-12
            else:
                assert contact.spin_roll_ratio > 0.1


def test_spin_roll_ratio_of_harris(bearings):
    """Outer race control: spin over roll at the inner race (1 - g cos ai) tan(ai - beta) + g sin ai, Harris."""
    model = QuasistaticModel(ball_kinematics=BallKinematics.OUTER_RACE_CONTROL)
    solution = solve_quasistatic(bearings.b218, Operation(inner_speed=1047.0, force=(22250.0, 0.0, 0.0)), model)
    inner = contact_conditions(solution, OIL)[0]
    gamma = 22.23 / 125.26
    ai, ao = solution.inner_contact_angle[0], solution.outer_contact_angle[0]
    beta = np.arctan2(np.sin(ao), np.cos(ao) + gamma)
    expected = (1.0 - gamma * np.cos(ai)) * np.tan(ai - beta) + gamma * np.sin(ai)
    assert inner.spin_roll_ratio == pytest.approx(expected, rel=1e-9)
    _, rolling, spin = rolling_and_spin(solution, 0, Race.INNER)
    assert abs(spin) == pytest.approx(expected * rolling, rel=1e-9)
    assert inner.hirano_ratio == pytest.approx(1850.8 * np.sin(np.radians(48.71)) / 621.7, rel=1e-3)


def test_frequencies_of_rolling(solved, bearings):
    """Contact angle 0, g = 0.2, 166.67 Hz: cage 0.4, outer 9 x 0.4, inner 9 x 0.6, spin 0.5 (1 - g^2)/g times it."""
    f = bearing_frequencies(solved)
    turn = 1e4 / 60.0
    found = [f.cage, f.ball_pass_outer, f.ball_pass_inner, f.ball_spin]
    assert_allclose(found, turn * np.array([0.4, 3.6, 5.4, 2.4]), rtol=1e-12)


def test_kinematic_frequencies_of_a_published_bearing(bearings):
    """Case Western's 6205, 9 balls of 0.3126 in on 1.537 in: 3.5848, 5.4152, 4.7135/2, 0.39828 a turn."""
    known = replace(bearings.b6208, ball_diameter=0.3126 * 25.4e-3, pitch_diameter=1.537 * 25.4e-3)
    found = kinematic_frequencies(known, Operation(inner_speed=2.0 * np.pi, force=(0.0, 100.0, 0.0)), 0.0)
    numbers = [found.ball_pass_outer, found.ball_pass_inner, found.ball_spin, found.cage]
    assert_allclose(numbers, [3.5848, 5.4152, 0.5 * 4.7135, 0.39828], rtol=1e-3)
    both = kinematic_frequencies(known, Operation(inner_speed=30.0, outer_speed=30.0, force=(0.0, 1.0, 0.0)), 0.3)
    assert_allclose([both.cage, both.ball_pass_outer], [30.0 / (2.0 * np.pi), 0.0], atol=1e-12)


def test_7008_kinematic_cage_speed(bearings):
    """2186.97 rpm at 5000 rpm with contact angle 15 deg: a light load at low speed comes within 0.02 %."""
    solution = solve_quasistatic(bearings.b7008, Operation(inner_speed=5000.0 * bearings.rpm, force=(200.0, 0.0, 0.0)))
    assert solution.cage_speed / bearings.rpm == pytest.approx(2186.97, rel=1e-3)


@pytest.mark.parametrize("outer_speed", [0.0, -300.0])
def test_spin_and_mean_spin_are_those_of_the_bodies(bearings, outer_speed):
    """Normal components of the angular velocities of ball and race in the frame of the orbit, from vectors."""
    operation = Operation(inner_speed=800.0, outer_speed=outer_speed, force=(3000.0, 800.0, 0.0))
    solution = solve_quasistatic(bearings.b7008, operation)
    axial = np.array([1.0, 0.0, 0.0])
    for contact in contact_conditions(solution, OIL):
        k = contact.ball - 1
        radial = np.array([0.0, np.cos(contact.azimuth), np.sin(contact.azimuth)])
        attitude, speed = solution.attitude[k], solution.spin_speed[k]
        ring = operation.inner_speed if contact.race is Race.INNER else operation.outer_speed
        race = (ring - solution.orbit_speed[k]) * axial
        ball = speed * (np.sin(attitude) * radial - np.cos(attitude) * axial)
        surfaces = np.cross(race, contact.origin), np.cross(ball, contact.normal)
        assert np.dot(*surfaces) > 0.0  # the ball rolls with the race
        found = (contact.conditions.spin, contact.conditions.mean_spin)
        expected = ((ball - race) @ contact.normal, 0.5 * (ball + race) @ contact.normal)
        assert_allclose(found, expected, rtol=1e-9, atol=1e-9)


def test_rings_that_turn_as_one_leave_no_spin_to_roll_ratio(bearings):
    """0/0 in exact arithmetic: noise must not be reported."""
    together = Operation(inner_speed=420.0, outer_speed=420.0, force=(2000.0, 300.0, 0.0))
    for contact in contact_conditions(solve_quasistatic(bearings.b7008, together), OIL):
        assert contact.spin_roll_ratio is None
