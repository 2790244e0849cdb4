"""Coated bodies: the finite-element compliance against closed forms, and its limits in a lubricated contact."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import quad
from scipy.special import j0

from oilfilm.ehl import ContactConditions, Lubricant, SolverOptions, solve_contact
from oilfilm.ehl.conditions import Coating
from oilfilm.ehl.finite_element.solver import solve_contact_finite_element
from oilfilm.ehl.scaling import scale_contact
from oilfilm.ehl.solid.layered import correction, patch_compliance, point_compliance

STEEL = 210e9
BARE = ContactConditions(
    load=20.0,
    radius_x=12.5e-3,
    radius_y=12.5e-3,
    reduced_modulus=STEEL / (1.0 - 0.3**2),
    entrainment_speed=1.0,
    lubricant=Lubricant(viscosity=0.05, pressure_viscosity=20e-9),
)
COATING = Coating(
    thickness=20e-6, youngs_modulus=STEEL, poisson_ratio=0.3, substrate_youngs_modulus=70e9, substrate_poisson_ratio=0.3
)


def layer_on_rigid(s, nu):
    """Bonded layer: integral of (L - 1) J0(a s), L = (2 k sinh 2a - 4a)/(2 k cosh 2a + 4 a^2 + 1 + k^2), k = 3 - 4 nu.

    Aleksandrov (1968), Johnson, Contact Mechanics (1985), section 5.8.
    """
    k = 3.0 - 4.0 * nu

    def integrand(a):
        answer = (2 * k * np.sinh(2 * a) - 4 * a) / (2 * k * np.cosh(2 * a) + 4 * a * a + 1 + k * k)
        return (answer - 1.0) * j0(a * s)

    return quad(integrand, 0.0, 30.0, limit=400)[0]


@pytest.mark.parametrize("nu", [0.2, 0.4])
def test_layer_on_a_rigid_base(nu):
    r, c = correction(1e6, (nu, 0.3))
    for s in (0.0, 0.5, 1.0, 3.0, 8.0):
        i = np.abs(r - s).argmin()
        assert_allclose(c[i], layer_on_rigid(r[i], nu), rtol=2e-3, atol=2e-4)


def test_equal_materials_change_nothing():
    _, c = correction(1.0, (0.3, 0.3))
    assert np.abs(c).max() < 1e-10


def test_far_away_only_the_substrate_counts():
    r, c = correction(2.0, (0.3, 0.25))
    i = np.abs(r - 40.0).argmin()
    assert_allclose(c[i] * r[i], (1.0 - 0.25**2) / (1.0 - 0.3**2) / 2.0 - 1.0, rtol=0.01)


def test_patches_of_a_thin_coating_are_averaged():
    """The sum of the fine patches within a coarse one is the coarse one, under the load and beside it."""
    coating = scale_contact(replace(BARE, coating=replace(COATING, thickness=2e-6))).coating
    lines = np.arange(8) * 0.1
    coarse = patch_compliance(coating, lines, lines, 0.1, 0.1)
    offsets = (np.arange(60) + 0.5) / 60 * 0.1 - 0.05
    for j, i in ((0, 0), (0, 2), (3, 1)):
        fine = point_compliance(coating, np.hypot(lines[i] + offsets[None, :], lines[j] + offsets[:, None]))
        assert_allclose(coarse[j, i], 0.1 * 0.1 * fine.mean(), rtol=2e-3)


def test_thick_and_thin_coatings_are_uncoated_bodies():
    """A coating of 40 semi-axes is a half space of it; one of 1/400 of a semi-axis that of the substrate."""
    options = SolverOptions(points=129)
    thick = solve_contact(replace(BARE, coating=replace(COATING, thickness=5e-3)), options)
    assert_allclose(thick.film_minimum, solve_contact(BARE, options).film_minimum, rtol=5e-3)
    bare = (1.0 - 0.3**2) * (1.0 / STEEL + 1.0 / 70e9)
    substrate = solve_contact(replace(BARE, reduced_modulus=2.0 / bare), options)
    thin = solve_contact(replace(BARE, coating=replace(COATING, thickness=0.3e-6)), options)
    assert_allclose(thin.film_central, substrate.film_central, rtol=5e-3)
    assert_allclose(thin.pressure.max(), substrate.pressure.max(), rtol=0.02)


@pytest.mark.slow
def test_coated_contact_by_multigrid_and_by_finite_elements():
    coated = replace(BARE, coating=COATING)
    ours = solve_contact(coated, SolverOptions(points=257))
    other = solve_contact_finite_element(coated, SolverOptions(points=129))
    assert ours.converged
    assert other.converged
    assert_allclose(ours.film_central, other.film_central, rtol=0.01)
    assert_allclose(ours.film_minimum, other.film_minimum, rtol=0.02)
    assert abs(ours.film_central / solve_contact(BARE, SolverOptions(points=129)).film_central - 1.0) > 0.03


@pytest.mark.parametrize(("field", "value"), [("thickness", 0.0), ("poisson_ratio", 0.5)])
def test_bad_coatings_name_the_field(field, value):
    with pytest.raises(ValueError, match=field):
        replace(COATING, **{field: value})


def test_a_modulus_stiffer_than_the_coating_allows():
    with pytest.raises(ValueError, match="reduced_modulus"):
        scale_contact(replace(BARE, reduced_modulus=3.0 * STEEL, coating=COATING))
