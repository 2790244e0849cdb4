"""The formula of fifty coefficients: by hand, beside solved contacts, beyond its range."""

from __future__ import annotations

import csv
from math import exp, isnan, log, log10, sqrt

import numpy as np
import pytest
from atlas.picture import formula_errors, held_out
from verification.contacts import from_groups, moes

from oilfilm import ehl
from oilfilm.ehl.atlas.film_formula import FILE, RANGE
from oilfilm.ehl.scaling import scale_contact


def by_hand(film, A, L, D, alpha, z):
    """As the page prints it."""
    x, y, w = 2 * log(A / 7) / log(160 / 7) - 1, 2 * sqrt(L / 30) - 1, 1 + log10(D)
    total = 0.0
    with FILE.open(encoding="utf-8") as file:
        for row in csv.DictReader(file):
            i, j, k, l, m = (int(row[key]) for key in "ijklm")
            term = float(row[film]) * x**i * y**j * w**k * (z - 0.68) ** l * log(alpha / 22e-9) ** m
            total += term * sqrt(L / 30) if l + m else term
    return exp(total)


@pytest.mark.parametrize("place", [(20.0, 12.0, 0.03, 22e-9, 0.68), (100.0, 3.0, 0.9, 13e-9, 0.55), (7.0, 0.0, 1.0)])
def test_the_printed_formula(place):
    films = ehl.film_formula(*place)
    full = (*place, 22e-9, 0.68)[:5]
    for film, name in zip(films, ("central", "minimum"), strict=True):
        assert float(film) == pytest.approx(by_hand(name, *full), rel=1e-12)


def test_fifty_terms_each_once():
    with FILE.open(encoding="utf-8") as file:
        terms = [tuple(row[key] for key in "ijklm") for row in csv.DictReader(file)]
    assert len(terms) == len(set(terms)) == 50


@pytest.mark.parametrize(
    ("kind", "name", "most", "nineteen"),
    [("held", "central", 2.0, 0.8), ("held", "minimum", 5.0, 2.5), ("held oil", "central", 2.0, 1.2)],
)
def test_solved_contacts_that_it_was_not_fitted_to(kind, name, most, nineteen):
    """In %; `docs/theory/film_formula.md` prints them."""
    error = formula_errors(held_out(kind), name)
    assert len(error) >= 80
    assert error.max() < most
    assert np.quantile(error, 0.95) < nineteen


def test_lengths_of_a_bearing_contact():
    """A, L and R_x/R_y from SI as the page says, against the atlas of the same contact."""
    c = from_groups(moes(500.0, 9.0, 0.05))
    u = c.lubricant.viscosity * c.entrainment_speed / (c.reduced_modulus * c.radius_x)
    semi_axis = scale_contact(c).semi_axis_x
    load = semi_axis**2 / (c.radius_x**2 * sqrt(2.0 * u))
    thick = c.lubricant.pressure_viscosity * c.reduced_modulus * (2.0 * u) ** 0.25
    oil = (c.lubricant.pressure_viscosity, c.lubricant.exponent)
    central, minimum = ehl.film_formula(load, thick, c.radius_x / c.radius_y, *oil)
    unit = c.radius_x * sqrt(2.0 * u)
    films = ehl.atlas_films(c)
    assert float(central) * unit == pytest.approx(films.central.value, rel=0.01)
    assert float(minimum) * unit == pytest.approx(films.minimum.value, rel=0.03)


def test_circles_have_their_load_in_closed_form():
    c = from_groups(moes(100.0, 5.0))
    w = c.load / (c.reduced_modulus * c.radius_x**2)
    semi_axis = scale_contact(c).semi_axis_x
    assert (1.5 * w) ** (2 / 3) == pytest.approx((semi_axis / c.radius_x) ** 2, rel=1e-9)


def test_arrays_take_one_shape_and_places_outside_have_no_number():
    central, minimum = ehl.film_formula(np.array([[6.9], [50.0]]), np.array([5.0, 31.0, 10.0]), 0.1)
    assert central.shape == minimum.shape == (2, 3)
    assert np.isnan(central).tolist() == [[True, True, True], [False, True, False]]
    assert np.all(minimum[1, ::2] < central[1, ::2])
    middle = [0.5 * (low + high) for low, high in RANGE.values()]
    for k, (low, high) in enumerate(RANGE.values()):
        for beyond in (low - 0.01 * (high - low), high + 0.01 * (high - low)):
            assert isnan(float(ehl.film_formula(*middle[:k], beyond, *middle[k + 1 :])[0]))
