"""A contact posed by two surface velocities: mean and difference, opposite ones included."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.cases import CaseError
from oilfilm.cases.format.case import case_from_text
from oilfilm.ehl.conditions import surface_motion

CASE = """\
schema_version = 1
title = "two velocities"
source = "a test"
[contact]
load_N = 15.0
radius_x_mm = 12.5
radius_y_mm = 20.0
reduced_modulus_GPa = 110.0
{motion}
[lubricant]
viscosity_mPa_s = 50.0
pressure_viscosity_1_GPa = 20.0
"""


def conditions(motion):
    return case_from_text(CASE.format(motion=motion), "case.toml").conditions


@pytest.mark.parametrize(
    ("first", "second", "expected"),
    [
        ((2.0, 0.0), (1.0, 0.0), (1.5, 0.0, 2.0 / 3.0, 0.0)),
        ((0.0, 3.0), (0.0, 1.0), (2.0, 0.5 * pi, 1.0, 0.0)),
        ((1.0, 1.0), (1.0, -1.0), (1.0, 0.0, 0.0, 2.0)),
        ((3.0, 0.0), (-1.0, 0.0), (1.0, 0.0, 4.0, 0.0)),  # opposite
        ((-1.0, 0.0), (-3.0, 0.0), (2.0, pi, -1.0, 0.0)),  # slides against the entrainment's direction
    ],
)
def test_motion_of_two_velocities(first, second, expected):
    motion = surface_motion(first, second)
    assert_allclose(motion[0], expected[0])
    assert_allclose(np.exp(1j * motion[1]), np.exp(1j * expected[1]))
    assert_allclose(motion[2], expected[2], atol=1e-12)
    assert_allclose(motion[3], expected[3], atol=1e-12)


def test_velocities_come_back_from_mean_and_difference():
    random = np.random.default_rng(40127)
    for first, second in random.normal(size=(50, 2, 2)):
        speed, angle, slide, lateral = surface_motion(tuple(first), tuple(second))
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        mean, half = turn @ [speed, 0.0], 0.5 * speed * turn @ [slide, lateral]
        assert_allclose(mean + half, first, rtol=1e-9)
        assert_allclose(mean - half, second, rtol=1e-9)


def test_case_by_velocities_is_the_case_by_mean_and_slides():
    one = conditions("velocity_1_m_s = [3.0, 0.0]\nvelocity_2_m_s = [-1.0, 0.0]")
    other = conditions("entrainment_speed_m_s = 1.0\nslide_roll_ratio = 4.0")
    assert one == other


@pytest.mark.parametrize(
    ("motion", "expected"),
    [
        ("velocity_1_m_s = [1.0, 0.0]\nvelocity_2_m_s = [-1.0, 0.0]", "no oil is entrained"),
        ("velocity_1_m_s = [1.0, 0.0]", "velocity_2_m_s"),
        ("velocity_1_m_s = [1.0, 0.0]\nvelocity_2_m_s = [1.0, 0.0]\nslide_roll_ratio = 0.1", "slide_roll_ratio"),
        ("velocity_1_m_s = [1.0]\nvelocity_2_m_s = [1.0, 0.0]", "list of 2 numbers"),
        ("", "velocity_1_m_s and velocity_2_m_s"),
    ],
)
def test_what_does_not_go_together(motion, expected):
    with pytest.raises(CaseError, match=expected):
        conditions(motion)
