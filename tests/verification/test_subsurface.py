"""Stress below a contact: closed forms of Hertz contacts, and superposition against them, second order.

Circle and line after Johnson, Contact Mechanics (1985), Eqs. (3.45) and (4.45), chapters 3 and 4.
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.ehl.closed_form.hertz_stress import hertz_axis_stress, hertz_maximum_shear, hertz_orthogonal_shear
from oilfilm.ehl.solid.subsurface import rectangle_stress, subsurface_stress

NU = 0.3


def ellipse_field(semi_axes, points, depth, nu=NU, reach=1.6):
    """Superposition below p_h = 1 on an ellipse, from `points` cells over `reach` semi-axes either way."""
    a, b = semi_axes
    x, y = ((np.arange(points) - 0.5 * (points - 1)) * 2.0 * reach * s / points for s in (a, b))
    pressure = np.sqrt(np.maximum(0.0, 1.0 - (x[:, None] / a) ** 2 - (y[None, :] / b) ** 2))
    return subsurface_stress(pressure, x, y, np.asarray(depth), nu)


def test_axis_of_a_circle():
    """sigma_r = -(1 + nu)[1 - z/a atan(a/z)] + 1/[2 (1 + z^2/a^2)], sigma_z = -1/(1 + z^2/a^2)."""
    z = np.linspace(0.01, 4.0, 30)
    x_stress, y_stress, z_stress = hertz_axis_stress((2.0, 2.0), 1.0, z, NU)
    inverse = 1.0 / (1.0 + (z / 2.0) ** 2)
    assert_allclose(x_stress, -(1.0 + NU) * (1.0 - z / 2.0 * np.arctan(2.0 / z)) + 0.5 * inverse, atol=1e-13)
    assert_allclose(y_stress, x_stress, atol=1e-13)
    assert_allclose(z_stress, -inverse, atol=1e-13)


def test_axis_of_a_long_ellipse_is_that_of_a_line():
    """sigma_x = -[(1 + 2 z^2) (1 + z^2)^-1/2 - 2 z], sigma_z = -(1 + z^2)^-1/2, sigma_y = nu (sigma_x + sigma_z)."""
    z = np.linspace(0.05, 3.0, 20)
    x_stress, y_stress, z_stress = hertz_axis_stress((1.0, 2.0e5), 1.0, z, NU)
    assert_allclose(x_stress, 2.0 * z - (1.0 + 2.0 * z**2) / np.sqrt(1.0 + z**2), atol=2e-5)
    assert_allclose(z_stress, -1.0 / np.sqrt(1.0 + z**2), atol=2e-6)
    assert_allclose(y_stress, NU * (x_stress + z_stress), atol=2e-5)


def test_surface_of_an_ellipse():
    """sigma_x + sigma_y = -(1 + 2 nu) p_h at the centre, sigma_x = -2 nu - (1 - 2 nu) b/(a + b) (Johnson, 4.2)."""
    a, b = 1.0, 3.0
    x_stress, y_stress, _ = hertz_axis_stress((a, b), 1.0, np.array(1e-9), NU)
    assert x_stress == pytest.approx(-2.0 * NU - (1.0 - 2.0 * NU) * b / (a + b), abs=1e-7)
    assert y_stress == pytest.approx(-2.0 * NU - (1.0 - 2.0 * NU) * a / (a + b), abs=1e-7)


@pytest.mark.parametrize(
    ("semi_axes", "shear", "depth"),
    [((1.0, 1.0), 0.310, 0.481), ((1.0, 1e4), 0.300, 0.786), ((500.0, 0.1), 0.300, 0.0786)],
)
def test_largest_shear(semi_axes, shear, depth):
    """Circle 0.31 p_h at 0.48 a, line 0.30 p_h at 0.786 a (nu = 0.3)."""
    found = hertz_maximum_shear(semi_axes, 2.0e9, NU)
    assert found[0] == pytest.approx(shear * 2.0e9, rel=2e-3)
    assert found[1] == pytest.approx(depth, rel=2e-3)


@pytest.mark.parametrize("nu", [0.1, 0.17, 0.22, 0.25, 0.45])
def test_largest_shear_is_the_largest_on_the_axis(nu):
    """Of ellipses of all ratios at once, against the stresses at many depths; with a small Poisson's ratio the
    stress along the longer axis counts, and there may be two maxima.
    """
    ratios = np.geomspace(0.01, 100.0, 61)
    shear, depth = hertz_maximum_shear((np.ones(61), ratios), 1.0, nu)
    for ratio, own, at in zip(ratios, shear, depth, strict=True):
        depths = min(ratio, 1.0) * np.linspace(1e-4, 1.5, 3000)
        stress = hertz_axis_stress((1.0, ratio), 1.0, depths, nu)
        along = 0.5 * (stress.max(axis=0) - stress.min(axis=0))
        assert own == pytest.approx(along.max(), rel=1e-3)
        assert at == pytest.approx(depths[along.argmax()], abs=2e-2 * min(ratio, 1.0))


def test_orthogonal_shear():
    """Circle 0.214 p_h at 0.351 a, line 0.250 p_h at 0.500 a."""
    assert tuple(map(float, hertz_orthogonal_shear(1.0, 1.0, 1.0))) == pytest.approx((0.2139, 0.3509), rel=1e-3)
    assert tuple(map(float, hertz_orthogonal_shear(1.0, 1e5, 1.0))) == pytest.approx((0.25, 0.5), rel=1e-4)


@pytest.mark.parametrize("semi_axes", [(1.0, 1.0), (1.0, 4.0), (2.0, 0.5)])
def test_superposition_on_the_axis_is_second_order(semi_axes):
    depth = np.array([0.2, 0.5, 1.0]) * min(semi_axes)
    exact = hertz_axis_stress(semi_axes, 1.0, depth, NU)
    errors = []
    for points in (21, 41, 81):
        middle = points // 2
        field = ellipse_field(semi_axes, points, depth)
        errors.append(np.abs(field.stress[:3, middle, middle] - exact).max())
    assert errors[-1] < 3e-3
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert orders.mean() > 1.5  # the root at the rim of the pressure takes some of the second order


@pytest.mark.parametrize("semi_axes", [(1.0, 1.0), (1.0, 5.0), (3.0, 1.0)])
def test_superposition_finds_the_orthogonal_shear(semi_axes):
    """The largest tau_xz of the whole field, and where: 1 % on this grid."""
    amplitude, at = hertz_orthogonal_shear(*semi_axes, 1.0)
    field = ellipse_field(semi_axes, 101, at * np.linspace(0.6, 1.4, 17), reach=1.3)
    shear = np.abs(field.stress[5])
    assert shear.max() == pytest.approx(amplitude, rel=1e-2)
    assert field.depth[np.unravel_index(int(shear.argmax()), shear.shape)[2]] == pytest.approx(at, rel=0.06)


def test_equilibrium_of_the_field():
    """div sigma = 0 inside, by central differences: as small as their truncation."""
    x = np.linspace(-1.0, 1.0, 41)
    pressure = np.exp(-6.0 * (x[:, None] ** 2 + 2.0 * x[None, :] ** 2)) * (1.0 + 0.5 * x[:, None])
    h = x[1] - x[0]
    xx, yy, zz, xy, yz, xz = subsurface_stress(pressure, x, x, 0.5 + h * np.arange(-2, 3), NU).stress
    inside = (slice(5, -5), slice(5, -5), 2)

    def divergence(*components):
        return sum(np.gradient(c, h, axis=k)[inside] for k, c in enumerate(components))

    steepest = np.abs(np.gradient(zz, h, axis=2)).max()
    for row in ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz)):
        assert np.abs(divergence(*row)).max() < 1e-2 * steepest


def test_load_passes_every_depth():
    """The sum of -sigma_z over a wide plane is the load, the rest lies outside: under 2 % at this depth."""
    x = np.linspace(-10.0, 10.0, 101)
    pressure = np.where((np.abs(x[:, None]) < 0.5) & (np.abs(x[None, :]) < 0.5), 1.0, 0.0)
    field = subsurface_stress(pressure, x, x, np.array([0.8]), NU)
    assert -field.stress[2].sum() == pytest.approx(pressure.sum(), rel=0.02)
    assert -field.stress[2].sum() < pressure.sum()


def test_surface_below_a_cell_carries_its_pressure():
    sigma_z = rectangle_stress((4, 3), (0.1, 0.2), 0.0, NU)[2]
    assert sigma_z[3, 2] == pytest.approx(-1.0)
    assert np.abs(np.delete(sigma_z.ravel(), 3 * 5 + 2)).max() < 1e-12


def test_shear_measures_of_uniaxial_stress():
    """Under a wide pressure sigma_x = sigma_y: von Mises is twice the largest shear there."""
    field = ellipse_field((1.0, 1.0), 41, [0.5])
    middle = (20, 20, 0)
    assert field.von_mises[middle] == pytest.approx(2.0 * field.maximum_shear[middle], rel=1e-9)
    assert field.maximum_shear[middle] == pytest.approx(0.31, rel=1e-2)


def test_bad_input_is_refused():
    x = np.linspace(-1.0, 1.0, 5)
    with pytest.raises(ValueError, match="y must be evenly spaced"):
        subsurface_stress(np.zeros((5, 5)), x, x**3, np.array([0.1]), NU)
    with pytest.raises(ValueError, match="depth"):
        subsurface_stress(np.zeros((5, 5)), x, x, np.array([-0.1]), NU)
    with pytest.raises(ValueError, match="shape"):
        subsurface_stress(np.zeros((5, 4)), x, x, np.array([0.1]), NU)
