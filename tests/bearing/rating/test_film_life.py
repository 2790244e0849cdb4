"""kappa of every contact inside the life sum: limits in which it is the standard's, and the weights by hand."""

from __future__ import annotations

from dataclasses import replace
from math import pi

import numpy as np
import pytest

from oilfilm.bearing import Operation, load_material, solve_quasistatic
from oilfilm.bearing.operation import RatingInput
from oilfilm.bearing.rating.film_life import ContactKappa, contact_life, film_life, ring_damage, stress_limit
from oilfilm.bearing.rating.life import bearing_life, life_factor
from oilfilm.ehl import Lubricant

OIL = Lubricant(viscosity=0.0261, pressure_viscosity=18e-9, density=870.0)
CLEAN = RatingInput(contamination_factor=0.5)


@pytest.fixture(scope="module")
def solved(bearings):
    steel = load_material("bearing steel")
    parts = dict.fromkeys(("ball_material", "inner_ring_material", "outer_ring_material"), steel)
    operation = Operation(inner_speed=600.0 * pi, force=(400.0, 3000.0, 0.0))
    return solve_quasistatic(replace(bearings.b6208, **parts), operation)


@pytest.fixture(scope="module")
def rated(solved):
    return bearing_life(solved, OIL, CLEAN)


def equal(kappa):
    return ContactKappa(inner=[kappa] * 9, outer=[kappa] * 9)


@pytest.mark.parametrize("kappa", [0.3, 1.0, 2.5])
@pytest.mark.parametrize("outer", [0.0, -200.0])
def test_equal_films_give_the_standard(bearings, solved, kappa, outer):
    """One kappa for all contacts is a_ISO L_10r, whichever ring turns."""
    state = solve_quasistatic(solved.bearing, replace(solved.operation, outer_speed=outer))
    rating = bearing_life(state, OIL, CLEAN)
    expected = life_factor(kappa, stress_limit(rating)) * rating.basic_life
    assert contact_life(state, rating, equal(kappa)) == pytest.approx(expected, rel=1e-12)


def test_a_ring_that_turns_adds_up_and_one_that_stands_survives_by_points():
    """Two contacts of damage 1 and 3: mean 2 to the power 10/9; and the mean of 1 and 3^(10/9)."""
    damage = np.array([1.0, 3.0])
    assert ring_damage(damage, turning=True) == pytest.approx(2.0 ** (10 / 9))
    assert ring_damage(damage, turning=False) == pytest.approx(0.5 * (1.0 + 3.0 ** (10 / 9)))


def test_a_thin_film_where_nothing_is_loaded_costs_nothing(solved, rated):
    """The smallest kappa for all contacts is the lower bound; where the load is decides the rest."""
    base = contact_life(solved, rated, equal(2.0))
    heavy, light = (int(f(solved.outer_load)) for f in (np.argmax, np.argmin))
    thin = [ContactKappa(inner=[2.0] * 9, outer=[0.5 if j == at else 2.0 for j in range(9)]) for at in (heavy, light)]
    at_heavy, at_light = (contact_life(solved, rated, kappa) for kappa in thin)
    worst = contact_life(solved, rated, equal(0.5))
    assert worst < at_heavy < 0.8 * base
    assert at_light == pytest.approx(base, rel=1e-3)
    found = film_life(solved, rated, thin[1], thin[1], equal(2.0))
    assert found.smallest_kappa == 0.5
    assert found.smallest_life == pytest.approx(worst)
    assert found.life == found.low == at_light
    assert found.high == pytest.approx(base)
    assert found.life_factor == pytest.approx(at_light / rated.basic_life)
    assert found.life_time == pytest.approx(at_light / 18000.0 * 60.0)


def test_a_film_below_the_range_costs_nothing_where_the_load_is_negligible(solved, rated):
    """As the low end of a film that is not known, at a ball off the inner race; a heavy contact has no factor."""
    assert solved.inner_load.max() > 50.0 * solved.inner_load.min()
    heavy, light = (int(f(solved.inner_load)) for f in (np.argmax, np.argmin))
    thin = [ContactKappa(inner=[-0.1 if j == at else 2.0 for j in range(9)], outer=[2.0] * 9) for at in (heavy, light)]
    at_heavy, at_light = (contact_life(solved, rated, kappa) for kappa in thin)
    assert at_heavy is None
    assert at_light == pytest.approx(contact_life(solved, rated, equal(2.0)), rel=1e-3)


def test_what_is_missing_is_told(solved, rated):
    unknown = ContactKappa(inner=[None] * 9, outer=[1.0] * 9)
    found = film_life(solved, rated, unknown, unknown, unknown)
    loaded = int((solved.inner_load > 0.02 * solved.outer_load.max()).sum())  # below it no film is needed
    assert found.life is None and found.smallest_life is not None
    assert found.note == f"loaded contacts without a resolved film: {loaded} at the inner race"
    dry = film_life(solved, rated, equal(0.05), equal(0.05), equal(0.05))
    assert (dry.life, dry.smallest_life) == (None, None)
    assert "below kappa 0.1" in dry.note
    dirty = bearing_life(solved, OIL, RatingInput())
    assert film_life(solved, dirty, equal(1.0), equal(1.0), equal(1.0)).note == "there is no a_ISO"
