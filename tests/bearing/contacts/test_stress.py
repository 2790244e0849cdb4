"""Stress below contacts and sliding in them against closed forms and simple limits."""

from __future__ import annotations

import numpy as np
import pytest

from oilfilm.bearing import Operation, contact_conditions, contact_stress, solve_quasistatic
from oilfilm.bearing.contacts.stress import largest_sliding
from oilfilm.ehl import Lubricant
from oilfilm.ehl.closed_form.hertz import hertz_contact
from oilfilm.ehl.closed_form.hertz_stress import hertz_maximum_shear, hertz_orthogonal_shear

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
    axes = (hertz.semi_axis_x, hertz.semi_axis_y)
    steel = bearings.b6208.inner_ring_material.poisson_ratio
    shear = hertz_maximum_shear(axes, hertz.pressure, steel)
    assert (stress.shear_maximum, stress.shear_depth) == pytest.approx(tuple(map(float, shear)))
    orthogonal = tuple(map(float, hertz_orthogonal_shear(*axes, hertz.pressure)))
    assert (stress.orthogonal_shear, stress.orthogonal_depth) == pytest.approx(orthogonal)
    assert stress.mean_pressure == pytest.approx(hertz.load / (np.pi * hertz.semi_axis_x * hertz.semi_axis_y))


def test_orthogonal_shear_of_a_line_and_of_a_circle():
    """Lundberg and Palmgren: p_h/4 at half the semi-axis along the rolling direction; 0.214 p_h at 0.35 of it."""
    assert tuple(map(float, hertz_orthogonal_shear(2e-4, 2.0, 1e9))) == pytest.approx((0.25e9, 1e-4), rel=1e-6)
    assert tuple(map(float, hertz_orthogonal_shear(2e-4, 2e-4, 1e9))) == pytest.approx((0.214e9, 0.7e-4), rel=5e-3)


def test_unloaded_contacts_have_no_stress(bearings):
    solution, contacts = solved(bearings.b6208, inner_speed=1000.0, force=(0.0, 3000.0, 0.0))
    unloaded = [c for c in contacts if c.load == 0.0]
    assert unloaded
    assert all(contact_stress(solution, c) is None for c in unloaded)


def sliding(hertz, *motion):
    """Of one ellipse, by spin, rolling and radius."""
    ellipses = np.array([[hertz.semi_axis_x], [hertz.semi_axis_y], [hertz.pressure]])
    found = largest_sliding(ellipses, *(np.array([value]) for value in motion))
    return [float(value[0]) for value in found]


def test_sliding_by_spin_alone():
    """w_s times the longer semi-axis; of p v along it the largest is half of p_h times that."""
    hertz = ellipse()
    speed, product = sliding(hertz, -500.0, 0.0, 1.0)
    assert speed == pytest.approx(500.0 * hertz.semi_axis_y)
    assert product == pytest.approx(0.5 * hertz.pressure * speed, rel=1e-3)


def test_sliding_by_curvature_alone():
    """w_r b^2/(2 R); p v = p_h sqrt(1 - s^2) s^2 has its largest 2/(3 sqrt 3) at s^2 = 2/3."""
    hertz = ellipse()
    speed, product = sliding(hertz, 0.0, 3000.0, 6e-3)
    assert speed == pytest.approx(0.5 * 3000.0 * hertz.semi_axis_y**2 / 6e-3)
    assert product == pytest.approx(2.0 / (3.0 * np.sqrt(3.0)) * hertz.pressure * speed, rel=2e-3)


def test_sliding_of_a_deep_groove_bearing_is_that_of_curvature(bearings):
    """Pure radial load, no spin: ball and inner race roll at w_R + (w - w_m) on the radius 2 r D/(2 r + D)."""
    solution, contacts = solved(bearings.b6208, inner_speed=1000.0, force=(0.0, 3000.0, 0.0))
    rolling = solution.spin_speed[0] + 1000.0 - solution.orbit_speed[0]
    common = 2.0 * 6.17e-3 * 12e-3 / (2.0 * 6.17e-3 + 12e-3)
    expected = 0.5 * rolling * contacts[0].hertz.semi_axis_y ** 2 / common
    assert contact_stress(solution, contacts[0]).sliding_speed == pytest.approx(expected, rel=1e-9)
