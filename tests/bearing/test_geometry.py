"""Geometry of the row: clearance and contact angle, reduced radii, refusals that name the field."""

from __future__ import annotations

from dataclasses import replace
from math import asin, cos, inf, nan, pi, radians

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing import (
    Operation,
    Race,
    clearance_to_contact_angle,
    contact_angle_to_clearance,
    load_bearing,
    reduced_radii,
    solve_quasistatic,
)
from oilfilm.bearing.geometry import contact_modulus
from oilfilm.bearing.operation import Curvature
from oilfilm.bearing.quasistatic.kinematics import stiffness_at, stiffness_series
from oilfilm.ehl.closed_form.hertz import contact_stiffness


def test_clearance_and_contact_angle_are_inverse():
    for angle in np.linspace(0.01, 1.4, 8):
        clearance = contact_angle_to_clearance(angle, 0.0062, 0.0063, 0.012)
        assert clearance_to_contact_angle(clearance, 0.0062, 0.0063, 0.012) == pytest.approx(angle, rel=1e-12)


def test_7008_clearance_and_end_play(bearings):
    """Independent computation: 52.47 um and 0.39858 mm, four and five figures."""
    assert 1e6 * bearings.b7008.diametral_clearance == pytest.approx(52.47, abs=0.005)
    assert 1e3 * 2.0 * bearings.b7008.free_axial_position == pytest.approx(0.39858, abs=5e-6)


def test_balls_touch_both_races_from_the_free_tilt_on(bearings):
    bearing = replace(load_bearing("6208"), diametral_clearance=13e-6)
    angle = bearing.free_tilt
    states = [
        solve_quasistatic(bearing, Operation(inner_speed=0.0, force=(0.0, 0.0, 0.0), tilt=(0.0, share * angle)))
        for share in (0.95, 1.1)
    ]
    assert "floats" in states[0].message
    assert states[1].inner_load.max() > 1.0


def test_groove_centres_are_a_apart_at_the_free_angle(bearings):
    """A ball of radius D/2 on the pitch circle touches both grooves at the free contact angle."""
    b = bearings.b218
    radial = b.inner_centre_radius - b.outer_centre_radius
    assert radial == pytest.approx(b.curvature_centre_distance * cos(b.free_contact_angle), rel=1e-12)
    assert np.hypot(radial, b.free_axial_position) == pytest.approx(b.curvature_centre_distance, rel=1e-12)
    assert b.free_contact_angle == pytest.approx(radians(40.0), rel=1e-12)


def test_reduced_radii_of_the_6208(bearings):
    """1/Rx = 1/r + 1/R_race, 1/Ry = 1/r - 1/r_groove at contact angle 0: 4.8, 7.2 mm; 217.76, 130.14 mm."""
    for race, expected in ((Race.INNER, (4.8e-3, 0.217764706)), (Race.OUTER, (7.2e-3, 0.130137931))):
        assert_allclose(reduced_radii(bearings.b6208, race, 0.0), expected, rtol=1e-9)


def test_moduli_belong_to_their_rings(bearings):
    """E' of a ball on its own ring: 2/E' = 2 (1 - nu^2)/E of equal materials, 206 and 310 GPa."""
    nitride = bearings.b6208.ball_material
    mixed = replace(bearings.b6208, outer_ring_material=bearings.b218.ball_material)
    assert contact_modulus(mixed, Race.INNER) == pytest.approx(310e9 / (1.0 - 0.26**2), rel=1e-12)
    parts = 2.0 / ((1.0 - nitride.poisson_ratio**2) / 310e9 + (1.0 - 0.3**2) / 206.8e9)
    assert contact_modulus(mixed, Race.OUTER) == pytest.approx(parts, rel=1e-12)


def test_conformities_and_the_kind_by_the_free_angle(bearings):
    """Groove over ball of the 6208: 6.17/12 and 6.29/12; deep groove bearings reach 13.5 degrees, spindles have 15."""
    b = bearings.b6208
    assert (b.inner_conformity, b.outer_conformity) == pytest.approx((6.17 / 12.0, 6.29 / 12.0), rel=1e-12)
    for degrees, angular in ((13.5, False), (15.0, True)):
        play = contact_angle_to_clearance(radians(degrees), 6.17e-3, 6.29e-3, 12e-3)
        assert replace(b, diametral_clearance=play).angular_contact is angular


@pytest.mark.parametrize("race", Race)
def test_stiffness_series_is_exact(bearings, race):
    """Against the elliptic integrals between the nodes: round-off."""
    series = stiffness_series(bearings.b218, race, Curvature.OPERATING)
    angles = np.linspace(0.0, 1.5, 37)
    exact = [
        contact_stiffness(*reduced_radii(bearings.b218, race, a), contact_modulus(bearings.b218, race)) for a in angles
    ]
    assert_allclose(stiffness_at(series, np.cos(angles)), exact, rtol=2e-13)
    stepped = stiffness_at(series, np.cos(angles) + 1e-30j).imag / 1e-30
    difference = (
        stiffness_at(series, np.cos(angles[1:]) + 1e-5) - stiffness_at(series, np.cos(angles[1:]) - 1e-5)
    ) / 2e-5
    assert_allclose(stepped[1:], difference, rtol=1e-7)  # error of the central difference


def test_azimuths_pair_to_the_last_bit(bearings):
    c, s = bearings.b6208.azimuth_directions
    assert (c[1:] == c[:0:-1]).all()
    assert (s[1:] == -s[:0:-1]).all()
    assert_allclose(np.degrees(bearings.b6208.azimuths), 40.0 * np.arange(9))


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("ball_diameter", -1.0),
        ("ball_diameter", nan),
        ("pitch_diameter", 0.011),
        ("inner_groove_radius", 0.006),
        ("outer_groove_radius", inf),
        ("balls", 1),
        ("balls", 1 + int(pi / asin(0.2))),
        ("diametral_clearance", 1e-3),
        ("first_ball_azimuth", nan),
        ("bore", -0.04),
    ],
)
def test_impossible_geometry_names_the_field(bearings, field, value):
    with pytest.raises(ValueError, match=field):
        replace(bearings.b6208, **{field: value})


@pytest.mark.parametrize(
    ("fields", "match"),
    [
        ({"force": (None, 0.0, 0.0)}, "degree of freedom x needs exactly one, has neither"),
        ({"displacement": (1e-6, None, None)}, "degree of freedom x needs exactly one, has both"),
        ({"moment": (0.0, None)}, "degree of freedom tilt y"),
        ({"force": (0.0, nan, 0.0)}, "force must be finite"),
        ({"inner_speed": inf}, "inner_speed"),
        ({"temperature": 0.0}, "temperature"),
    ],
)
def test_impossible_operation_names_the_field(fields, match):
    with pytest.raises(ValueError, match=match):
        Operation(**{"inner_speed": 1.0, **fields})
