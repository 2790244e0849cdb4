"""Dimensionless groups, the two kinds of conditions, and the far field of an open box."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_bvp

from oilfilm.ehl import ContactConditions, DensityLaw, Lubricant, MoesConditions, SolverOptions, ViscosityLaw
from oilfilm.ehl.closed_form.hertz import hertz_contact
from oilfilm.ehl.conditions import moes_groups
from oilfilm.ehl.grid import Grid
from oilfilm.ehl.multigrid.far_field import (
    deflection_outside,
    edge_field,
    edge_pressure,
    exterior_load,
    far_field,
    squeeze_load,
)
from oilfilm.ehl.oil.lubricant import density, viscosity
from oilfilm.ehl.scaling import CLOSED_FORM_LAWS, scale_contact

from ...reference.ehl.reynolds import poiseuille

OIL = Lubricant(viscosity=0.0261, pressure_viscosity=18e-9)
INNER = ContactConditions(
    load=500.0, radius_x=4.8e-3, radius_y=0.2178, reduced_modulus=332.5e9, entrainment_speed=15.08, lubricant=OIL
)


def test_circular_contact_has_moes_closed_forms():
    """lambda = (128 pi^3/(3 M^4))^(1/3), alpha p_h = (L/pi)(3M/2)^(1/3), c_def = 2/pi^2; Venner and Lubrecht (2000)."""
    c = scale_contact(MoesConditions(load_parameter=200.0, lubricant_parameter=10.0, lubricant=OIL))
    assert_allclose(c.speed, (128.0 * np.pi**3 / (3.0 * 200.0**4)) ** (1 / 3), rtol=1e-12)
    assert_allclose(c.hertz_pressure * 18e-9, 10.0 / np.pi * 300.0 ** (1 / 3), rtol=1e-12)
    assert_allclose(c.deformation, 2.0 / np.pi**2, rtol=1e-12)
    assert_allclose(c.load, 2.0 * np.pi / 3.0, rtol=1e-12)


def test_si_and_moes_conditions_are_one_problem():
    si = scale_contact(INNER)
    m, l = moes_groups(INNER)
    moes = scale_contact(
        MoesConditions(
            load_parameter=m, lubricant_parameter=l, radius_ratio=INNER.radius_x / INNER.radius_y, lubricant=OIL
        )
    )
    for name in ("speed", "load", "deformation", "viscosity_slope", "viscosity_pressure", "density_numerator"):
        assert_allclose(getattr(moes, name), getattr(si, name), rtol=1e-12)


def test_scales_are_those_of_hertz():
    hertz = hertz_contact(INNER.load, INNER.radius_x, INNER.radius_y, INNER.reduced_modulus)
    c = scale_contact(INNER)
    assert_allclose([c.semi_axis_x, c.hertz_pressure], [hertz.semi_axis_x, hertz.pressure], rtol=1e-12)
    assert_allclose(c.semi_axis_ratio, hertz.semi_axis_y / hertz.semi_axis_x, rtol=1e-12)
    # lambda = 12 eta_0 u_m Rx^2/(a^3 p_h)
    assert_allclose(c.speed, 12 * 0.0261 * 15.08 * 4.8e-3**2 / (hertz.semi_axis_x**3 * hertz.pressure), rtol=1e-12)


@pytest.mark.parametrize("law", CLOSED_FORM_LAWS)
def test_dimensionless_viscosity_is_the_lubricants(law):
    oil = replace(OIL, viscosity_law=law)
    c = scale_contact(replace(INNER, lubricant=oil))
    P = np.array([0.0, 0.1, 1.0])
    ours = np.exp(c.viscosity_slope * ((1.0 + c.viscosity_pressure * P) ** c.viscosity_exponent - 1.0))
    assert_allclose(ours, viscosity(P * c.hertz_pressure, oil) / oil.viscosity, rtol=1e-12)
    rho = 1.0 + c.density_numerator * P / (1.0 + c.density_denominator * P)
    assert_allclose(rho, density(P * c.hertz_pressure, oil) / oil.density, rtol=1e-12)


def test_pressure_viscosity_is_the_slope_at_ambient_pressure():
    step = 1e3  # [Pa]; second derivative of ln eta is of order alpha/p_r
    slope = np.log(viscosity(np.array([step]), OIL) / OIL.viscosity) / step
    assert_allclose(slope, OIL.pressure_viscosity, rtol=1e-5)


@pytest.mark.parametrize(("field", "value"), [("load", 0.0), ("radius_x", -1.0), ("entrainment_speed", np.nan)])
def test_bad_conditions_name_the_field(field, value):
    with pytest.raises(ValueError, match=field):
        replace(INNER, **{field: value})


def test_moes_without_a_scale_of_pressure():
    oil = Lubricant(viscosity=0.05, pressure_viscosity=0.0, viscosity_law=ViscosityLaw.BARUS)
    with pytest.raises(ValueError, match="pressure_viscosity"):
        scale_contact(MoesConditions(load_parameter=20.0, lubricant_parameter=5.0, lubricant=oil))
    limit = scale_contact(MoesConditions(load_parameter=20.0, lubricant_parameter=0.0, lubricant=oil))
    assert limit.viscosity_slope == 0.0
    assert limit.density_numerator == 0.0


@pytest.mark.parametrize("points", [100, 17, 8193, 0])
def test_points_must_be_a_power_of_two_plus_one(points):
    with pytest.raises(ValueError, match="points"):
        SolverOptions(points=points)


def paraboloid(angle, rotation, ratio=0.3):
    oil = Lubricant(viscosity=0.05, pressure_viscosity=1e-9, density_law=DensityLaw.INCOMPRESSIBLE)
    conditions = MoesConditions(
        load_parameter=2.0, lubricant_parameter=0.0, radius_ratio=ratio, lubricant=oil, entrainment_angle=angle
    )
    c = replace(scale_contact(conditions), rotation=rotation)
    assert c.curvature_xy == pytest.approx(0.0, abs=1e-12)
    errors = []
    for cells in (32, 64, 128):
        grid = Grid(x_in=-4.0, hx=8.0 / cells, hy=8.0 / cells, nx=cells + 1, ny=cells + 1, symmetric=False)
        X, Y = grid.X[None, :], grid.Y[:, None]
        H = 1.5 + 0.5 * c.curvature_x * X**2 + 0.5 * c.curvature_y * Y**2 + c.curvature_xy * X * Y
        field = far_field(c)
        P = -(field.pressure_x * X + field.pressure_y * Y + field.pressure_xy * X * Y) / H**2
        u, v = c.velocity_x - rotation * Y, c.velocity_y + rotation * X
        couette = (u * c.curvature_x * X + v * c.curvature_y * Y)[1:-1, 1:-1]
        errors.append(np.abs(poiseuille(P, H**3 / c.speed, grid.hx, grid.hy, False) - couette).max())
    return errors


@pytest.mark.parametrize(("angle", "rotation"), [(0.0, 0.0), (0.4, 0.0), (np.pi / 2, 0.0), (0.4, -0.7), (1.5, 0.3)])
def test_far_field_solves_reynolds_on_a_paraboloid(angle, rotation):
    """Kapitza's solution, and ours for a rotation, leave only the stencil's truncation error: second order."""
    errors = paraboloid(angle, rotation)
    assert_allclose(np.log2(np.divide(errors[:-1], errors[1:])), 2.0, atol=0.15)


def where_oil_breaks(contact):
    """Angle at which it breaks, and angles up to pi with s there, by collocation with that angle as unknown."""
    ratio = contact.curvature_y / contact.curvature_x

    def rates(t, y, p):
        angle = p[0] + t * (np.pi - p[0])
        half = 0.5 * (np.cos(angle) ** 2 + ratio * np.sin(angle) ** 2)
        slope = (ratio - 1.0) * np.cos(angle) * np.sin(angle)  # of half
        second = np.cos(angle) / half**3 + 9.0 * y[0] - 3.0 * slope / half * y[1]
        return (np.pi - p[0]) * np.array([y[1], second])

    t = np.linspace(0.0, 1.0, 200)
    start = [-np.cos(t * np.pi).clip(-1.0, 0.0) / (3.0 + 2.0 * ratio), np.zeros_like(t)]
    found = solve_bvp(rates, lambda a, b, p: np.array([a[0], a[1], b[1]]), t, start, [1.3], tol=1e-6, max_nodes=20000)
    assert found.success
    angle = found.p[0] + found.x * (np.pi - found.p[0])
    half = 0.5 * (np.cos(angle) ** 2 + ratio * np.sin(angle) ** 2)
    return found.p[0], angle, contact.speed * found.y[0] * half**2


@pytest.mark.parametrize("ratio", [0.2, 0.4, 1.0, 4.0])
def test_far_field_breaks_where_pressure_and_slope_are_zero(ratio):
    """18 degrees behind the middle of a circle; s against collocation."""
    c = scale_contact(MoesConditions(load_parameter=5.0, lubricant_parameter=1.0, radius_ratio=ratio, lubricant=OIL))
    broken, angle, strength = where_oil_breaks(c)
    if ratio == 1.0:
        assert np.degrees(broken) == pytest.approx(72.0, abs=0.5)
    field = far_field(c)
    ours = field.strength(np.cos(angle), np.sin(angle))
    assert_allclose(ours, strength, atol=2e-3 * strength.max())
    assert_allclose(field.strength(np.cos(angle), -np.sin(angle)), ours, atol=1e-9 * strength.max())
    before = np.linspace(-broken + 0.01, broken - 0.01, 50)
    assert np.all(field.strength(np.cos(before), np.sin(before)) == 0.0)


def test_a_rotation_adds_its_own_far_field():
    """Where neither breaks, K - k_xy X Y and what the break adds to K."""
    c = scale_contact(MoesConditions(load_parameter=5.0, lubricant_parameter=1.0, radius_ratio=0.3, lubricant=OIL))
    still, turned = far_field(c), far_field(replace(c, rotation=0.2))
    X, Y = np.full(9, -3.0), np.linspace(-1.0, 1.0, 9)
    assert turned.pressure_xy != 0.0
    assert_allclose(turned.strength(X, Y), still.strength(X, Y) - turned.pressure_xy * X * Y, rtol=1e-12)


def light(ratio=0.5):
    """A light contact with a box and the gap of a paraboloid in it."""
    c = scale_contact(MoesConditions(load_parameter=5.0, lubricant_parameter=1.0, radius_ratio=ratio, lubricant=OIL))
    box = Grid(x_in=-5.0, hx=0.25, hy=0.25, nx=29, ny=13, symmetric=True)

    def gap(X, Y):
        return 0.8 + 0.5 * c.curvature_x * X**2 + 0.5 * c.curvature_y * Y**2

    return far_field(c), box, gap


def beyond(field, box, gap, step, size=300.0):
    """Places outside the box, over half a plane; their gap and s r, those with pressure only."""
    X, Y = np.arange(-size, size, step)[None, :] + 0.5 * step, np.arange(0.0, size, step)[:, None] + 0.5 * step
    outside = (X < box.X[0]) | (X > box.X[-1]) | (Y > box.Y[-1])
    strength = field.strength(X, Y)
    wet = outside & (strength > 0.0)
    return gap(X, Y)[wet], strength[wet], np.hypot(X, Y)[wet]


def test_deflection_outside_is_the_integral_of_the_far_field_over_the_distance():
    """Against brute-force summation over a plane 60 times the box; little lies beyond."""
    field, box, gap = light()
    film, strength, distance = beyond(field, box, gap, 0.2)
    brute = 2.0 * np.sum(strength / film**2 / distance) * 0.2**2
    ours = deflection_outside(field, box, gap(box.X[None, :], box.Y[:, None]))
    assert_allclose(ours, brute, rtol=5e-3)
    near = deflection_outside(field, box, gap(box.X[None, :], box.Y[:, None]), inlet_film_thickness=60.0)
    within = film < 60.0
    assert_allclose(near, 2.0 * np.sum((strength / film**2 / distance)[within]) * 0.2**2, rtol=5e-3)


def test_exterior_load_is_the_integral_of_the_far_field():
    """Against brute-force summation over a plane 60 times the box; the rest beyond carries 1/60 of it."""
    field, box, gap = light()
    film, strength, _ = beyond(field, box, gap, 0.1)
    brute = 2.0 * np.sum(strength / film**2) * 0.1**2
    ours = exterior_load(field, box, gap(box.X[None, :], box.Y[:, None]))
    assert 0.97 * ours < brute < 1.0 * ours


def test_squeeze_load_is_the_integral_of_one_over_the_gap_squared():
    """Against brute-force summation over the oil that carries pressure, 60 times the box; little lies beyond."""
    field, box, gap = light()
    film, _, _ = beyond(field, box, gap, 0.1)
    brute = 2.0 * np.sum(1.0 / film**2) * 0.1**2
    ours = squeeze_load(field, box, gap(box.X[None, :], box.Y[:, None]))
    assert_allclose(ours, brute, rtol=5e-3)


def test_edge_pressure_is_positive_where_the_oil_holds():
    """Upstream, and beside the contact to a little behind its middle."""
    c = scale_contact(INNER)
    grid = Grid(x_in=-4.0, hx=0.5, hy=2.0, nx=13, ny=9, symmetric=True)
    P, H = np.zeros((9, 13)), np.full((9, 13), 8.0)
    edge_pressure(edge_field(far_field(c), grid), H, P)
    assert np.all(P[:, 0] > 0.0)
    assert np.all(P[-1, grid.X <= 1.0] > 0.0)
    assert np.all(P[-1, grid.X > 1.0] == 0.0)
    assert np.all(P[:, -1] == 0.0)
    assert np.all(P[:-1, 1:-1] == 0.0)
