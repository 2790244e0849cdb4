"""Rolling moment in the box, beyond it by Kapitza's (1955) field, and within a distance from the centre.

The open box is chosen by the solver; here its pilot is replaced, so that one contact is solved in several boxes of
the same mesh.
"""

from __future__ import annotations

from dataclasses import replace
from math import log, pi

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.linalg import solve_banded
from scipy.optimize import brentq

import ehl
from ehl.kinematics import contact_kinematics
from ehl.scaling import scale_contact
from ehl.traction.rolling_moment import SHARE_OF_RADIUS, moment_of_doubling, rolling_moment, scaled_as_solved
from ehl.traction.shear import integrate_traction

HEAVY = ((4.0, 129), (8.0, 257), (16.0, 513))  # inlet in semi-axes and points, the mesh along x kept


def in_box(monkeypatch, conditions, box, points):
    """Solve in an open box of our choice, in Hertz semi-axes."""
    film = scale_contact(conditions).film_guess
    monkeypatch.setattr("ehl.solver._pilot", lambda contact, progress: (box, film))
    found = ehl.solve_contact(conditions, ehl.SolverOptions(points=points))
    assert found.converged
    return found


def paraboloid(solution, approach=0.0):
    """A box of 4 by 3 semi-axes in an undeformed gap, without pressure."""
    contact = scale_contact(solution.conditions)
    X, Y = np.linspace(-4.0, 1.5, 45), np.linspace(-3.0, 3.0, 49)
    H = approach + 0.5 * contact.curvature_x * X[:, None] ** 2 + 0.5 * contact.curvature_y * Y**2
    return replace(solution, X=X, Y=Y, H=H, P=np.zeros_like(H), approach_dimensionless=approach, semi_axis_ratio=1.0)


def test_moment_of_the_box_is_that_of_the_traction(solution, conditions):
    found = integrate_traction(solution, contact_kinematics(conditions), ehl.oil.rheology.Rheology())
    moment = rolling_moment(solution)
    assert_allclose(moment.box, -found.hydrodynamic_moment, rtol=1e-9)
    assert_allclose(moment.extent, SHARE_OF_RADIUS * conditions.radius_x)
    assert_allclose(moment.within_extent, moment.box - moment.beyond_extent + moment.beyond_box)


@pytest.mark.parametrize("radius_ratio", [1.0 / 45.0, 0.4, 1.0])
def test_ring_of_the_far_field_in_closed_form(solution, conditions, radius_ratio):
    given = replace(conditions, radius_y=conditions.radius_x / radius_ratio)
    contact = scale_contact(given)
    made = replace(
        paraboloid(replace(solution, conditions=given)),
        semi_axis_x=contact.semi_axis_x,
        hertz_pressure=contact.hertz_pressure,
    )
    near, far = (rolling_moment(made, factor * made.semi_axis_x).beyond_box for factor in (10.0, 35.0))
    assert_allclose(far - near, moment_of_doubling(made) * log(3.5) / log(2.0), rtol=1e-3)
    flow = given.lubricant.viscosity * given.entrainment_speed * given.radius_x**2
    expected = 24.0 * pi * flow / ((3.0 + 2.0 * radius_ratio) * np.sqrt(radius_ratio)) * log(2.0)
    assert_allclose(moment_of_doubling(made), expected, rtol=1e-9)
    assert near > 0.0


def test_approach_of_the_bodies_is_in_the_gap_beyond_the_box(solution):
    """Over one ray by hand: the moment falls with the square of the film."""
    wide = replace(solution.conditions, radius_y=solution.conditions.radius_x)
    contact = scale_contact(wide)
    made = replace(
        paraboloid(replace(solution, conditions=wide), 0.7),
        semi_axis_x=contact.semi_axis_x,
        hertz_pressure=contact.hertz_pressure,
    )
    near, far = (rolling_moment(made, factor * made.semi_axis_x).beyond_box for factor in (6.0, 9.0))
    r = np.linspace(6.0, 9.0, 4001)
    scale = contact.speed / 5.0 * made.hertz_pressure * made.semi_axis_x**3
    assert_allclose(far - near, scale * 0.5 * pi * np.trapezoid(r**3 / (0.7 + 0.5 * r**2) ** 2, r), rtol=1e-3)


def test_part_of_the_box_beyond_the_extent(solution):
    X = np.linspace(-2.0, 2.0, 401)
    P = np.maximum(-X, 0.0)[:, None] * np.ones(401)
    made = replace(paraboloid(solution, 1.0), X=X, Y=X, P=P, H=np.ones_like(P), semi_axis_ratio=1.0)
    found, scale = rolling_moment(made, 1.5 * made.semi_axis_x), made.hertz_pressure * made.semi_axis_x**3
    assert_allclose(found.box, scale * 32.0 / 3.0, rtol=1e-4)
    assert_allclose(found.beyond_extent, scale * (32.0 / 3.0 - pi * 1.5**4 / 8.0), rtol=1e-3)
    assert found.beyond_box == 0.0


def test_box_and_tail_are_the_larger_box(monkeypatch, conditions):
    """Heavy contact: the box decides 15 %, what is within the extent 1 to 2 %."""
    heavy = replace(conditions, load=1596.3)
    found = [rolling_moment(in_box(monkeypatch, heavy, (-inlet, 1.57 * inlet / 4.0, 2.88), n)) for inlet, n in HEAVY]
    assert found[2].box > 1.14 * found[0].box
    within = [moment.within_extent for moment in found]
    assert_allclose(within, within[2], rtol=0.015)
    assert found[2].beyond_box == 0.0
    assert found[0].beyond_box > 3.0 * found[1].beyond_box > 0.0


def test_light_contact_has_one_moment_within_the_extent(monkeypatch, conditions):
    """Centrifugal force only: doubling the box adds the doubling's moment to the box, and nothing within the extent."""
    light = replace(conditions, load=15.5)
    boxes = [((-33.0 * f, 2.2 * f, 14.0 * f), n) for f, n in ((1.0, 129), (2.0, 257), (4.0, 513))]
    films = [in_box(monkeypatch, light, box, n) for box, n in boxes]
    found = [rolling_moment(film) for film in films]
    assert_allclose(np.diff([moment.box for moment in found]), moment_of_doubling(films[0]), rtol=0.05)
    assert_allclose([moment.within_extent for moment in found], found[2].within_extent, rtol=0.02)


def test_sphere_solved_in_a_small_box_has_the_moment_far_out(monkeypatch, conditions):
    sphere = replace(conditions, load=20.0, radius_x=0.01, radius_y=0.01, entrainment_speed=1.0)
    small, large = (in_box(monkeypatch, sphere, (-f * 4.0, f * 2.0, f * 2.5), n) for f, n in ((1.0, 65), (4.0, 257)))
    edge = 4.0 * large.semi_axis_x  # within the smaller of both boxes along x, outside it across
    one, other = rolling_moment(small), rolling_moment(large)
    assert other.box > 1.3 * one.box
    assert_allclose(one.within_extent, other.within_extent, rtol=0.01)
    assert_allclose(rolling_moment(small, edge).within_extent, rolling_moment(large, edge).within_extent, rtol=0.01)


@pytest.mark.parametrize("change", [{"entrainment_angle": 0.5}, {"entrainment_angle": 0.5 * pi}, {"mean_spin": 60.0}])
def test_moment_within_the_extent_at_an_angle_and_with_rotation(monkeypatch, conditions, change):
    given = replace(conditions, load=100.0, radius_x=5e-3, radius_y=16e-3, entrainment_speed=3.0, **change)
    films = [in_box(monkeypatch, given, (-f * 4.0, f * 1.6, f * 2.9), n) for f, n in ((1.0, 65), (4.0, 257))]
    small, large = (rolling_moment(film) for film in films)
    assert large.box > 1.2 * small.box
    assert_allclose(small.within_extent, large.within_extent, rtol=0.01)
    farther = rolling_moment(films[1], 8.0 * large.extent).within_extent
    near = rolling_moment(films[1], 4.0 * large.extent).within_extent
    if "mean_spin" not in change:
        assert_allclose(farther - near, moment_of_doubling(films[1]), rtol=0.03)


@pytest.mark.parametrize(("radius_ratio", "expected"), [(1.0, 1.0138), (1.0 / 45.0, 1.0346)])
def test_rupture_adds_little_to_kapitzas_moment(radius_ratio, expected):
    """r^-3 f with pressure and slope zero where the film ends, against the positive half of Kapitza's pressure."""
    phi = np.linspace(0.0, pi, 1501)
    half = _rupturing(phi, radius_ratio)
    gap = np.cos(phi) ** 2 + radius_ratio * np.sin(phi) ** 2
    kapitza = np.maximum(4.0 * np.cos(phi) / ((3.0 + 2.0 * radius_ratio) * gap**2), 0.0)
    ratio = np.trapezoid(half * np.cos(phi), phi) / np.trapezoid(kapitza * np.cos(phi), phi)
    assert_allclose(ratio, expected, rtol=2e-4)
    if radius_ratio == 1.0:  # f = 0.8 cos + A cosh(3 phi), orthogonal to cos
        end = brentq(lambda angle: np.sin(angle) + 3.0 * np.cos(angle) * np.tanh(3.0 * angle), 1.7, 2.0)
        assert_allclose(ratio, (end + np.sin(end) * np.cos(end)) / (0.5 * pi), rtol=1e-4)


def _rupturing(phi, radius_ratio):
    """f(phi) of (q^3 f')' - 9 q^3 f = -8 cos(phi), f >= 0, phi from the inlet's direction; lambda S = 1."""
    step = phi[1]
    cube = (np.cos(phi) ** 2 + radius_ratio * np.sin(phi) ** 2) ** 3
    middle = phi[:-1] + 0.5 * step
    faces = (np.cos(middle) ** 2 + radius_ratio * np.sin(middle) ** 2) ** 3 / step**2
    below, above = np.append(0.0, faces), np.append(faces, 0.0)
    below[-1], above[0] = 2.0 * below[-1], 2.0 * above[0]
    diagonal, wanted = below + above + 9.0 * cube, 8.0 * np.cos(phi)
    full = np.ones(phi.size, dtype=bool)
    for _ in range(phi.size):
        bands = np.zeros((3, phi.size))
        bands[1] = np.where(full, diagonal, 1.0)
        bands[0, 1:], bands[2, :-1] = np.where(full, -above, 0.0)[:-1], np.where(full, -below, 0.0)[1:]
        f = solve_banded((1, 1), bands, np.where(full, wanted, 0.0))
        rest = diagonal * f - wanted
        rest[:-1] -= above[:-1] * f[1:]
        rest[1:] -= below[1:] * f[:-1]
        now = np.where(full, f > 0.0, rest < 0.0)
        if np.array_equal(now, full):
            return f
        full = now
    raise AssertionError("the active set did not settle")


def test_what_has_no_moment_beyond_its_box_says_why(solution, conditions):
    fixed = ehl.solve_contact(conditions, ehl.SolverOptions(points=65, domain=(-4.5, 1.5, 2.25)))
    found = rolling_moment(fixed)
    assert found.box > 0.0
    assert found.beyond_box is None and found.within_extent is None
    assert "domain" in found.note
    assert "ellipse" in rolling_moment(solution, 0.5e-3).note


def test_bad_input_is_named(solution):
    with pytest.raises(ValueError, match="extent"):
        rolling_moment(solution, -1e-3)
    groups = ehl.MoesConditions(load_parameter=20.0, lubricant_parameter=10.0, lubricant=solution.conditions.lubricant)
    with pytest.raises(ValueError, match="Moes"):
        rolling_moment(replace(solution, conditions=groups))
    with pytest.raises(ValueError, match="frame"):
        scaled_as_solved(replace(solution, frame_angle=0.3))
