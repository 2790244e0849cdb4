"""Velocities over a contact: turned into the frame of the grid, and over spin and curvature, by hand."""

from __future__ import annotations

from dataclasses import replace
from math import pi, radians

import numpy as np
import pytest

from oilfilm.ehl import ContactConditions, Lubricant
from oilfilm.ehl.conditions import ContactKinematics, contact_kinematics

CONTACT = ContactConditions(
    load=100.0,
    radius_x=0.005,
    radius_y=0.2,
    reduced_modulus=226e9,
    entrainment_speed=2.0,
    slide_roll_ratio=0.1,
    lateral_slide_ratio=0.05,
    spin=300.0,
    lubricant=Lubricant(viscosity=0.04, pressure_viscosity=20e-9),
)


def test_velocities_in_a_turned_frame():
    """Entrainment 2 m/s, sliding (0.2, 0.1) m/s; seen from a frame 30 degrees behind, all turned ahead by these."""
    found = contact_kinematics(CONTACT, grid_angle=radians(-30.0))
    assert (found.entrainment_speed, found.entrainment_lateral) == pytest.approx((3.0**0.5, 1.0))
    assert (found.sliding_x, found.sliding_y) == pytest.approx((0.1 * 3.0**0.5 - 0.05, 0.1 + 0.05 * 3.0**0.5))


@pytest.mark.parametrize(("angle", "rolling"), [(0.0, 400.0), (0.5 * pi, 10.0), (0.25 * pi, 205.0)])
def test_rolling_is_the_speed_over_the_radius_of_its_direction(angle, rolling):
    """2 m/s over 5 mm along x, over 200 mm along y; curvatures in between by Euler."""
    turned = replace(CONTACT, entrainment_angle=angle)
    assert contact_kinematics(turned).rolling == pytest.approx(rolling)


def test_spin_and_curvature_slide():
    """S_x - spin y - rolling y^2/(2 R) and S_y + spin x: at (2, 0.1) mm, R = 5 mm."""
    motion = ContactKinematics(
        entrainment_speed=2.0, sliding_x=0.2, sliding_y=0.1, spin=300.0, rolling=400.0, curvature_radius=0.005
    )
    along, across = motion.sliding(np.array(2e-3), np.array(1e-4))
    assert along == pytest.approx(0.2 - 0.03 - 400.0 * 1e-8 / 0.01, rel=1e-12)
    assert across == pytest.approx(0.1 + 0.6, rel=1e-12)
