"""Capacitance, breakdown voltage and sound of a film, against closed forms and another sum over the same gap."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm import ehl
from oilfilm.ehl.oil.lubricant import DensityLaw
from oilfilm.ehl.traction import instruments
from oilfilm.ehl.traction.instruments import VACUUM_PERMITTIVITY, film_instruments

OIL = ehl.Lubricant(viscosity=0.04, pressure_viscosity=18e-9, density_law=DensityLaw.INCOMPRESSIBLE)
CIRCLE = ehl.ContactConditions(
    load=30.0, radius_x=10e-3, radius_y=10e-3, reduced_modulus=226e9, entrainment_speed=1.0, lubricant=OIL
)


@pytest.fixture(scope="module")
def film():
    return ehl.solve_contact(CIRCLE, ehl.SolverOptions(points=129))


def test_hertz_part_is_nearly_a_plate(film):
    """Of the flat film, eps_0 eps_r pi a^2/h_c; the constriction at the rim adds, less than its own film would."""
    found = film_instruments(film)
    a = film.semi_axis_x
    plate = VACUUM_PERMITTIVITY * 2.2 * np.pi * a**2 / film.film_central
    assert 1.0 < found.capacitance_hertz / plate < film.film_central / film.film_minimum


def test_wedge_is_that_of_the_gap_to_the_meniscus(film):
    """Ahead and beside the contact of Hertz' gap to the layer of 100 um, behind it in part oil, in part air."""
    found = film_instruments(film)
    a, h = film.semi_axis_x, film.film_central
    r = a * np.geomspace(1.0, 0.9e-3 / a * 1.7, 20001)
    x = r / a
    # gap outside a Hertz contact of a sphere, Johnson (1985), section 4.2
    gap = h + a**2 / (np.pi * 10e-3) * (np.sqrt(x**2 - 1.0) + (x**2 - 2.0) * np.arccos(1.0 / x))
    ring = np.where(gap < 100e-6, 2.0 * np.pi * r / gap, 0.0)
    full = VACUUM_PERMITTIVITY * np.trapezoid(ring, r)
    wedge = found.capacitance - found.capacitance_hertz
    assert 0.5 * (1.0 + 2.2) * full < 1.05 * wedge
    assert wedge < 2.2 * full


def test_error_bars_hold_a_finer_mesh(film):
    finer = ehl.solve_contact(CIRCLE, ehl.SolverOptions(points=257))
    one, other = film_instruments(film), film_instruments(finer)
    assert abs(one.capacitance - other.capacitance) < one.capacitance_uncertainty + other.capacitance_uncertainty
    assert other.capacitance_uncertainty < 0.5 * one.capacitance_uncertainty


def test_breakdown_follows_the_minimum_film(film):
    found = film_instruments(film)
    low, high = instruments.BREAKDOWN_FIELD
    assert found.breakdown_voltage_low == pytest.approx(low * (film.film_minimum - film.film_minimum_uncertainty))
    assert found.breakdown_voltage_high == pytest.approx(high * (film.film_minimum + film.film_minimum_uncertainty))
    assert found.breakdown_voltage_low < found.breakdown_voltage < found.breakdown_voltage_high


def test_clausius_and_mossotti():
    """Twice the density of eps 2: (eps - 1)/(eps + 2) from 1/4 to 1/2 gives 4."""
    tight = replace(OIL, density_law=DensityLaw.DOWSON_HIGGINSON)
    p = 1e9
    ratio = float(ehl.oil.lubricant.density(p, tight)) / tight.density
    share = 0.25 * ratio
    assert_allclose(instruments.permittivity_at_pressure(np.array(p), tight, 2.0), (1 + 2 * share) / (1 - share))
    assert_allclose(instruments.permittivity_at_pressure(np.array(p), OIL, 2.0), 2.0)


def test_bulk_modulus_of_dowson_and_higginson():
    """rho/(d rho/dp) at ambient pressure is 1/0.6 GPa."""
    tight = replace(OIL, density_law=DensityLaw.DOWSON_HIGGINSON)
    assert_allclose(instruments.bulk_modulus(1e6, tight), 1e9 / 0.6, rtol=0.01)
    assert instruments.bulk_modulus(1e6, OIL) == np.inf


def test_reflection_of_a_spring():
    """Everything without a film's stiffness, half where it is said, nothing through an endless one."""
    assert instruments.reflection(0.0, 1e7, 46e6) == 1.0
    half = instruments.half_reflection_frequency(2e15, 46e6)
    assert_allclose(instruments.reflection(2e15, half, 46e6), 0.5)
    assert instruments.reflection(1e25, 1e7, 46e6) < 1e-6


def test_films_that_did_not_converge_measure_nothing(film):
    assert film_instruments(film).ultrasonic_stiffness is None  # incompressible
    assert film_instruments(replace(film, converged=False)) is None
