"""Bearings that several tests use, as the fixture `bearings`."""

from __future__ import annotations

from math import pi, radians
from types import SimpleNamespace

import pytest

from oilfilm.bearing import Bearing, Material, contact_angle_to_clearance

RPM = pi / 30.0  # [rad/s]


def make(diameters, balls, grooves, elastic, clearance=None, angle=None, **fields):
    """Bearing from lengths in mm (clearance in um, angle in degrees) and (E in GPa, nu, density)."""
    ball, pitch = (1e-3 * value for value in diameters)
    inner, outer = (1e-3 * value for value in grooves)
    steel = Material(name="test", youngs_modulus=elastic[0] * 1e9, poisson_ratio=elastic[1], density=elastic[2])
    play = 1e-6 * clearance if angle is None else contact_angle_to_clearance(radians(angle), inner, outer, ball)
    return Bearing(
        name="test",
        ball_diameter=ball,
        pitch_diameter=pitch,
        balls=balls,
        inner_groove_radius=inner,
        outer_groove_radius=outer,
        diametral_clearance=play,
        ball_material=steel,
        inner_ring_material=steel,
        outer_ring_material=steel,
        **fields,
    )


@pytest.fixture(scope="session")
def bearings():
    """The bearings of the literature checks, the function that makes them, and 1 rpm in rad/s."""
    return SimpleNamespace(
        make=make,
        rpm=RPM,
        b218=make((22.23, 125.26), 16, (11.63, 11.63), (206.8, 0.3, 7800.0), angle=40.0),
        b209=make((12.7, 65.0), 9, (6.604, 6.604), (206.0, 0.3, 7850.0), clearance=15.0),
        b6208=make((12.0, 60.0), 9, (6.17, 6.29), (310.0, 0.26, 3250.0), clearance=13.0),
        b7000c=make((4.485, 18.0), 10, (0.52 * 4.485, 0.5235 * 4.485), (206.0, 0.3, 7850.0), angle=15.0),
        b7008=make((7.0, 54.0), 18, (3.99, 3.78), (206.0, 0.3, 7850.0), angle=15.0),
    )
