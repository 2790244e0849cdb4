"""Stress, sliding and truncation of contacts against closed forms and simple limits."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from bearing import Operation, Race, contact_conditions, contact_stress, solve_quasistatic
from bearing.contacts.stress import largest_sliding, shoulder_angle, truncation
from ehl import Lubricant
from ehl.closed_form.hertz import hertz_contact

OIL = Lubricant(viscosity=0.03, pressure_viscosity=18e-9)


def solved(bearing, **operation):
    solution = solve_quasistatic(bearing, Operation(**operation))
    return solution, contact_conditions(solution, OIL)


def ellipse(load=1000.0):
    return hertz_contact(load, 5e-3, 80e-3, 226e9)


def test_shear_of_a_solved_contact(bearings):
    """Between circle and line: 0.30 to 0.325 p_h at 0.48 to 0.79 of the short semi-axis; mean: load over area."""
    solution, contacts = solved(bearings.b6208, inner_speed=1000.0, force=(0.0, 3000.0, 0.0))
    hertz, stress = contacts[0].hertz, contact_stress(solution, contacts[0])
    short = min(hertz.semi_axis_x, hertz.semi_axis_y)
    assert 0.30 < stress.shear_maximum / hertz.pressure < 0.325
    assert 0.48 < stress.shear_depth / short < 0.79
    assert 0.21 < stress.orthogonal_shear / hertz.pressure < 0.25
    assert stress.mean_pressure == pytest.approx(hertz.load / (np.pi * hertz.semi_axis_x * hertz.semi_axis_y))


def test_unloaded_contacts_have_no_stress(bearings):
    solution, contacts = solved(bearings.b6208, inner_speed=1000.0, force=(0.0, 3000.0, 0.0))
    unloaded = [c for c in contacts if c.load == 0.0]
    assert unloaded
    assert all(contact_stress(solution, c) is None for c in unloaded)


def test_sliding_by_spin_alone():
    """w_s times the longer semi-axis; of p v along it the largest is half of p_h times that."""
    hertz = ellipse()
    speed, product = largest_sliding(hertz, -500.0, 0.0, 1.0)
    assert speed == pytest.approx(500.0 * hertz.semi_axis_y)
    assert product == pytest.approx(0.5 * hertz.pressure * speed, rel=1e-3)


def test_sliding_by_curvature_alone():
    """w_r b^2/(2 R); p v = p_h sqrt(1 - s^2) s^2 has its largest 2/(3 sqrt 3) at s^2 = 2/3."""
    hertz = ellipse()
    speed, product = largest_sliding(hertz, 0.0, 3000.0, 6e-3)
    assert speed == pytest.approx(0.5 * 3000.0 * hertz.semi_axis_y**2 / 6e-3)
    assert product == pytest.approx(2.0 / (3.0 * np.sqrt(3.0)) * hertz.pressure * speed, rel=2e-3)


def test_sliding_of_a_deep_groove_bearing_is_that_of_curvature(bearings):
    """Pure radial load, no spin: ball and inner race roll at w_R + (w - w_m) on the radius 2 r D/(2 r + D)."""
    solution, contacts = solved(bearings.b6208, inner_speed=1000.0, force=(0.0, 3000.0, 0.0))
    rolling = solution.spin_speed[0] + 1000.0 - solution.orbit_speed[0]
    common = 2.0 * 6.17e-3 * 12e-3 / (2.0 * 6.17e-3 + 12e-3)
    expected = 0.5 * rolling * contacts[0].hertz.semi_axis_y ** 2 / common
    assert contact_stress(solution, contacts[0]).sliding_speed == pytest.approx(expected, rel=1e-9)


def test_shoulder_angle(bearings):
    """Edge of the groove at 45 degrees by construction, at both rings."""
    plain = bearings.b6208
    inner = 2.0 * (plain.inner_centre_radius - plain.inner_groove_radius * np.sqrt(0.5))
    outer = 2.0 * (plain.outer_centre_radius + plain.outer_groove_radius * np.sqrt(0.5))
    bearing = replace(plain, inner_shoulder_diameter=inner, outer_shoulder_diameter=outer)
    assert [shoulder_angle(bearing, race) for race in Race] == pytest.approx([np.pi / 4.0] * 2)
    assert shoulder_angle(plain, Race.INNER) is None
    assert truncation(plain, Race.INNER, 0.0, ellipse()) is None


def test_truncation_grows_from_none_to_all(bearings):
    """Edge in the middle of the ellipse: half of length and load beyond it, the whole pressure at it."""
    plain = bearings.b6208
    inner = 2.0 * (plain.inner_centre_radius - plain.inner_groove_radius * np.cos(0.5))
    bearing, hertz = replace(plain, inner_shoulder_diameter=inner), ellipse()
    half = truncation(bearing, Race.INNER, -0.5, hertz)
    assert (half.length_share, half.load_share) == pytest.approx((0.5, 0.5))
    assert half.edge_pressure == pytest.approx(hertz.pressure)
    none = truncation(bearing, Race.INNER, 0.0, hertz)
    assert (none.length_share, none.load_share, none.edge_pressure) == (0.0, 0.0, 0.0)
    assert none.margin == pytest.approx(plain.inner_groove_radius * np.sin(0.5) - hertz.semi_axis_y)
    beyond = truncation(bearing, Race.INNER, 1.2, hertz)
    assert (beyond.length_share, beyond.load_share) == (1.0, 1.0)


def test_load_beyond_the_edge_against_the_sum_of_pressures(bearings):
    """(1 - s)^2 (2 + s)/4 is what the semi-ellipsoid holds beyond s."""
    plain = bearings.b6208
    inner = 2.0 * (plain.inner_centre_radius - plain.inner_groove_radius * np.cos(0.3))
    hertz = ellipse()
    angle = 0.3 - np.arcsin(0.4 * hertz.semi_axis_y / plain.inner_groove_radius)
    cut = truncation(replace(plain, inner_shoulder_diameter=inner), Race.INNER, angle, hertz)
    x, y = np.meshgrid(np.linspace(-1, 1, 1001), np.linspace(-1, 1, 1001), indexing="ij")
    pressure = np.sqrt(np.maximum(0.0, 1.0 - x**2 - y**2))
    assert cut.load_share == pytest.approx(pressure[y > 0.4].sum() / pressure.sum(), rel=5e-3)
    assert cut.length_share == pytest.approx(0.3)


@pytest.mark.parametrize("field", ["inner_shoulder_diameter", "outer_shoulder_diameter"])
def test_impossible_shoulders_are_refused(bearings, field):
    for value in (0.03, 0.09):
        with pytest.raises(ValueError, match=field):
            replace(bearings.b6208, **{field: value})
