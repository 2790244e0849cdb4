"""The compiled motion of balls on races against the map that torque and traction equilibrium take."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing import Race, solve_quasistatic
from oilfilm.bearing.contacts.contacts import contact_conditions
from oilfilm.bearing.contacts.motion import ball_speeds, motion_map
from oilfilm.bearing.dynamics._race_kernels import race_motion, straight_motion
from oilfilm.bearing.dynamics.arrays import Body
from oilfilm.bearing.dynamics.assembly import constants
from oilfilm.ehl import Lubricant

OIL = Lubricant(viscosity=0.0261, pressure_viscosity=18e-9)
DRAWS = 5


def compiled_motion(bearing, c, contact, ring_speed, orbit, rotation):
    """`race_motion`: the ball on the pitch circle, the ring moved along its axis to give the angle."""
    radius = 0.5 * bearing.pitch_diameter
    inner = contact.race is Race.INNER
    centre, groove = (c.inner_centre, c.inner_groove) if inner else (c.outer_centre, c.outer_groove)
    outward = np.array([0.0, np.cos(contact.azimuth), np.sin(contact.azimuth)])
    axle = np.array([1.0, 0.0, 0.0])
    tangent = np.cross(axle, outward)
    turn = rotation[0] * axle + rotation[1] * outward + rotation[2] * tangent + orbit * axle
    still = (0.0, 0.0, 0.0)
    place = ((centre - radius) * np.tan(contact.contact_angle), 0.0, 0.0)
    body = Body(centre=place, axis=(1.0, 0.0, 0.0), velocity=still, turn=(ring_speed, 0.0, 0.0))
    vectors = (tuple(vector) for vector in (radius * outward, orbit * radius * tangent, turn))
    return race_motion(c, body, centre, groove, *vectors)


@pytest.mark.parametrize("name", ["7008", "6208"])
def test_compiled_motion_is_that_of_the_map(setup, bearings, name):
    """Slides and entrainment to 1e-10 of the entrainment speed, spin and rolling to 1e-10 of the ball's speed.

    At random loads, speeds of both rings and motions of the balls. The map has the balls on the pitch circle.
    """
    bearing = setup.bearing_7008() if name == "7008" else replace(bearings.b6208, bore=40e-3, width=18e-3)
    c, random = constants(bearing, setup.model(bearing)), np.random.default_rng(7008)
    for _ in range(DRAWS):
        axial, radial = random.uniform(50.0, 500.0, 2)
        outer_speed = random.uniform(-100.0, 100.0)
        solved = solve_quasistatic(
            bearing, setup.operation(random.uniform(2e3, 2e4), axial, radial, outer_speed=outer_speed)
        )
        contacts = contact_conditions(solved, OIL)
        orbit, rotation = ball_speeds(solved)
        orbit = orbit * random.uniform(0.9, 1.1, orbit.shape)
        rotation = rotation + random.normal(0.0, 0.05 * np.abs(rotation).max(), rotation.shape)
        move = motion_map(solved, contacts)
        ball, race = move.bodies(orbit, rotation)
        for n, contact in enumerate(contacts):
            k = move.ball[n]
            row = compiled_motion(bearing, c, contact, move.ring_speed[n], orbit[k], rotation[k])
            speed = 0.5 * (ball + race)[n, 0]
            size = np.array([speed, speed, *[np.linalg.norm(rotation[k])] * 2])
            expected = (ball - race)[n] / size
            assert_allclose(row.angle, contact.contact_angle, rtol=1e-10)
            assert_allclose(row.entrainment, speed, rtol=1e-10)
            motion = (row.slide_x, row.slide_y, row.spin, row.roll)
            assert_allclose(motion / size, expected, rtol=0.0, atol=1e-10)


@pytest.mark.parametrize("race", list(Race))
def test_motion_in_the_middle_plane_is_that_in_space(setup, race):
    """Every number of the motion, at random motions in the plane, to round-off."""
    bearing = setup.bearing_7008()
    c, random = constants(bearing, setup.model(bearing)), np.random.default_rng(60013)
    inner = race is Race.INNER
    groove = (c.inner_centre, c.inner_groove) if inner else (c.outer_centre, c.outer_groove)
    for _ in range(DRAWS):
        angle = random.uniform(-np.pi, np.pi)
        place = 27e-3 * np.array([0.0, np.cos(angle), np.sin(angle)]) + [0.0, *random.normal(0.0, 1e-6, 2)]
        centre, drift, velocity = ([0.0, *random.normal(0.0, size, 2)] for size in (1e-6, 0.1, 5.0))
        turn, ring = [random.normal(0.0, 2e3), 0.0, 0.0], random.normal(0.0, 500.0)
        body = Body(tuple(centre), (1.0, 0.0, 0.0), tuple(drift), (ring, 0.0, 0.0))
        vectors = (tuple(place), tuple(velocity), tuple(turn))
        plane, space = (kernel(c, body, *groove, *vectors) for kernel in (straight_motion, race_motion))
        for part, wanted in zip(plane, space, strict=True):
            assert_allclose(part, wanted, rtol=1e-9, atol=1e-9)
