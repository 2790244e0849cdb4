"""Hertz contact against closed forms, a direct quadrature of the half-space, and Harris' table.

Sources: Johnson, Contact Mechanics (1985), 3.5 and 4.2; Harris and Kotzalas, Rolling Bearing Analysis, 5th ed.,
Table 6.1.
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.special import elliprd

from oilfilm.ehl.closed_form.hertz import (
    contact_stiffness,
    ellipse_ratio,
    hertz_coefficients,
    hertz_contact,
    hertz_deflection,
)

# F(rho): a*, b*, delta*
HARRIS = {
    0.1075: (1.0760, 0.9318, 0.9974),
    0.5916: (1.6440, 0.6687, 0.9077),
    0.7948: (2.265, 0.5480, 0.7961),
    0.90999: (3.233, 0.4499, 0.6636),
    0.95738: (4.395, 0.3830, 0.5551),
    0.990902: (8.062, 0.2814, 0.3745),
    0.9994785: (23.55, 0.16442, 0.17167),
}


def test_circular_contact_is_the_closed_form():
    contact = hertz_contact(20.0, 12.7e-3, 12.7e-3, 226e9)
    a = (3.0 * 20.0 * 12.7e-3 / (2.0 * 226e9)) ** (1.0 / 3.0)
    found = [contact.semi_axis_x, contact.semi_axis_y, contact.pressure, contact.approach]
    assert_allclose(found, [a, a, 1.5 * 20.0 / (np.pi * a**2), a**2 / 12.7e-3], rtol=1e-14)  # round-off


@pytest.mark.parametrize("curvature_difference", HARRIS)
def test_harris_table(curvature_difference):
    """a* = a [(Sum rho) E'/(3 F)]^(1/3), delta* likewise; met to the 1e-3 that the table's interpolation allows."""
    ratio = (1.0 - curvature_difference) / (1.0 + curvature_difference)
    f, _, d = hertz_coefficients(ratio)  # x is the rolling direction, Rx < Ry
    scale = ((1.0 + ratio) / 3.0) ** (1.0 / 3.0)
    minor, approach = f * scale, 2.0 * d * scale**2 / (1.0 + ratio)
    assert_allclose([minor * ellipse_ratio(ratio), minor, approach], HARRIS[curvature_difference], rtol=1.2e-3)


@pytest.mark.parametrize("ratio", [0.05, 0.6, 1.0, 3.0, 15.0])
def test_pressure_flattens_the_gap(ratio):
    """Boussinesq's integral of the pressure, by rays (Johnson 3.5), equals approach - x^2/2Rx - y^2/2Ry."""
    contact = hertz_contact(350.0, 5e-3, 5e-3 / ratio, 300e9)
    a, b = contact.semi_axis_x, contact.semi_axis_y
    theta = (np.arange(20000) + 0.5) * np.pi / 20000  # the midpoint rule of a periodic integrand: exponential accuracy
    for x, y in [(0.0, 0.0), (0.7 * a, 0.0), (0.0, 0.8 * b), (0.5 * a, -0.4 * b)]:
        alpha = 1.0 - (x / a) ** 2 - (y / b) ** 2
        beta = x * np.cos(theta) / a**2 + y * np.sin(theta) / b**2
        gamma = np.cos(theta) ** 2 / a**2 + np.sin(theta) ** 2 / b**2
        chord = 0.5 * np.pi * (alpha * gamma + beta**2) / gamma**1.5
        displacement = contact.pressure * chord.mean() * 2.0 / contact.reduced_modulus
        expected = contact.approach - x**2 / (2.0 * contact.radius_x) - y**2 / (2.0 * contact.radius_y)
        assert_allclose(displacement, expected, rtol=1e-11)


def test_load_is_the_integral_of_the_pressure():
    for ratio in np.geomspace(1e-3, 1e3, 13):
        contact = hertz_contact(1000.0, 6e-3, 6e-3 / ratio, 330e9)
        load = 2.0 * np.pi / 3.0 * contact.pressure * contact.semi_axis_x * contact.semi_axis_y
        assert_allclose(load, 1000.0, rtol=1e-13)


def radius_ratio_of_ellipse(k):
    """Rx/Ry of the contact whose ellipse has b/a = k, R_D(0, 1, k^2)/R_D(0, k^2, 1)."""
    return float(elliprd(0.0, 1.0, k**2) / elliprd(0.0, k**2, 1.0))


def test_ratio_equation_is_inverted_to_round_off():
    """From circle to ellipticity 60 and beyond, both orientations; the condition number of ln k is below 1."""
    for ratio in np.geomspace(1e-5, 1e5, 201):
        k = ellipse_ratio(ratio)
        assert_allclose(radius_ratio_of_ellipse(k), ratio, rtol=2e-14)
        assert_allclose(k * ellipse_ratio(1.0 / ratio), 1.0, rtol=2e-14)
    assert ellipse_ratio(radius_ratio_of_ellipse(60.0)) == pytest.approx(60.0, rel=1e-13)


def test_continuous_through_the_circle():
    """A step of 1e-9 in Rx/Ry moves every coefficient by its slope times 1e-9 and nothing else."""
    assert ellipse_ratio(1.0) == 1.0
    f0, g0, d0 = hertz_coefficients(1.0)
    assert_allclose([f0**3, g0, d0], [1.5, 1.5 / (np.pi * f0**2), f0**2], rtol=1e-14)
    for step in (-1e-6, -1e-9, -1e-13, 1e-13, 1e-9, 1e-6):
        assert_allclose(ellipse_ratio(1.0 + step), 1.0 - 2.0 / 3.0 * step, rtol=1e-15 + step**2)
        assert_allclose(hertz_coefficients(1.0 + step), (f0, g0, d0), rtol=1e-15 + abs(step))


def test_exchanging_the_axes_exchanges_the_ellipse():
    one, two = hertz_contact(77.0, 4e-3, 9e-2, 250e9), hertz_contact(77.0, 9e-2, 4e-3, 250e9)
    assert_allclose([one.semi_axis_x, one.semi_axis_y], [two.semi_axis_y, two.semi_axis_x], rtol=1e-13)
    assert_allclose([one.pressure, one.approach], [two.pressure, two.approach], rtol=1e-13)


def test_silicon_nitride_6208_inner_contact():
    """Independent computation: D 12, inner groove 6.17, dm 60 mm, E 310 GPa, nu 0.26, 1000 N; seven printed figures."""
    radius_x, radius_y, modulus = 6e-3 * (1.0 - 0.2), 1.0 / (1.0 / 6e-3 - 1.0 / 6.17e-3), 310e9 / (1.0 - 0.26**2)
    assert hertz_contact(1000.0, radius_x, radius_y, modulus).approach == pytest.approx(7.204383e-6, rel=1e-7)
    stiffness = contact_stiffness(radius_x, radius_y, modulus)
    assert stiffness * 1e-3**1.5 == pytest.approx(1.635328e6, rel=5e-7)
    assert stiffness * 7.204383e-6**1.5 == pytest.approx(1000.0, rel=2e-7)


@pytest.mark.parametrize("bad", [0.0, -1.0, float("nan"), float("inf")])
def test_bad_input_names_the_field(bad):
    with pytest.raises(ValueError, match="radius_ratio"):
        ellipse_ratio(bad)
    for field in ("load", "radius_x", "radius_y", "reduced_modulus"):
        values = {"load": 1.0, "radius_x": 1e-2, "radius_y": 1e-2, "reduced_modulus": 2e11, field: bad}
        with pytest.raises(ValueError, match=field):
            hertz_contact(**values)


@pytest.mark.parametrize("r", [0.0, 0.6, 1.0, 1.3, 4.0])
def test_deflection_of_a_circle(r):
    """3 pi/8 (2 - r^2) inside, 3/4 [(2 - r^2) asin(1/r) + sqrt(r^2 - 1)] outside (Johnson, 1985, section 3.4)."""
    outside = 0.75 * ((2.0 - r * r) * np.arcsin(1.0 / max(r, 1.0)) + np.sqrt(max(r * r - 1.0, 0.0)))
    assert hertz_deflection(0.6 * r, 0.8 * r, 1.0) == pytest.approx(outside, rel=1e-12)


@pytest.mark.parametrize("place", [(1.4, 0.5), (0.6, 3.2), (-2.0, 5.0)])
def test_deflection_outside_an_ellipse(place):
    """Sum of p/r over the ellipse of semi-axes 1 and 3 under unit load, p = 3/(2 pi 3) cos(t) at s = sin(t)."""
    nodes, weights = np.polynomial.legendre.leggauss(40)
    t, around = np.meshgrid(0.25 * np.pi * (nodes + 1.0), 2.0 * np.pi / 400 * np.arange(400))
    distance = np.hypot(place[0] - np.sin(t) * np.cos(around), place[1] - 3.0 * np.sin(t) * np.sin(around))
    sums = (np.cos(t) ** 2 * np.sin(t) / distance).sum(axis=0) * 2.0 * np.pi / 400
    expected = 1.5 / np.pi * float((0.25 * np.pi * weights * sums).sum())
    assert hertz_deflection(*place, 3.0) == pytest.approx(expected, rel=1e-6)
