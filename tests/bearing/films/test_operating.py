"""Operating films: the fractions that supply, heat of the inlet and asperities leave, and the parts of the error."""

from __future__ import annotations

from math import hypot

import numpy as np
import pytest

from oilfilm.bearing import Operation, contact_conditions, solve_quasistatic
from oilfilm.bearing.films.asperities import Asperities
from oilfilm.bearing.films.film import ContactFilm, FilmOrigin, FilmThickness, first_same
from oilfilm.bearing.films.operating_film import film_heats, operating_films, solved_films, with_formulas
from oilfilm.bearing.supply.inlet_oil import OilAtInlets, PrescribedInlet
from oilfilm.bearing.supply.supply import shares_behind
from oilfilm.ehl import Lubricant, SolverOptions, solve_contact

OIL = Lubricant(viscosity=0.0261, pressure_viscosity=18e-9)
ROUGH = Asperities(inner_roughness=0.1e-6, outer_roughness=0.2e-6, boundary=0.12)


@pytest.fixture(scope="module")
def contacts(bearings):
    operation = Operation(inner_speed=5000 * bearings.rpm, force=(0.0, 900.0, 0.0))
    return contact_conditions(solve_quasistatic(bearings.b6208, operation), OIL)


@pytest.fixture(scope="module")
def computed(contacts):
    """Films of atlas and formulas."""
    return with_formulas(contacts, [None] * len(contacts))


def test_only_lubricated_contacts_have_a_film(contacts, computed):
    assert [film is not None for film in computed] == [contact.conditions is not None for contact in contacts]
    assert {film.origin for film in computed if film is not None} <= {FilmOrigin.ATLAS, FilmOrigin.FORMULA}


def test_heat_thins_film_gap_and_error_bar(contacts, computed):
    operating = operating_films(contacts, computed)
    heats = film_heats(contacts, computed)
    for heat, before, film in zip(heats, computed, operating, strict=True):
        if film is None:
            continue
        # equal contacts have theirs once, of fewer contacts at a time: to rounding
        assert film.heat.central == pytest.approx(heat.central, rel=1e-11)
        assert film.heat.minimum[1:] == pytest.approx(heat.minimum[1:], rel=1e-11)
        assert film.minimum.value == pytest.approx(film.heat.minimum.value * before.minimum.value, rel=1e-12)
        for name in ("central", "minimum"):
            cold, hot, reduction = (getattr(one, name) for one in (before, film, heat))
            smaller = min(reduction.value * cold.value, film.central.value)
            assert hot.value == pytest.approx(smaller, rel=1e-11)
            assert hot.heat == pytest.approx(reduction.law * cold.value, rel=1e-11)
            assert hot.oil == pytest.approx(reduction.oil * cold.value, rel=1e-11) and hot.oil > 0.0
            assert hot.error == pytest.approx(hypot(hot.computed, hot.heat, hot.oil))
        assert film.gap_fraction == pytest.approx(heat.central.value, rel=1e-12)
        assert (film.isothermal_central, film.isothermal_minimum) == (before.central.value, before.minimum.value)
        assert film.rolling_moment == pytest.approx(heat.moment.value * before.rolling_moment, rel=1e-12)
        assert heat.central.value < heat.moment.value < 1.0


def test_supply_asperities_and_factors_each_have_their_part(contacts, computed):
    oil = OilAtInlets(oil=PrescribedInlet(layer=0.3e-6), balls=9)
    operating = operating_films(contacts, computed, supply=oil, asperities=ROUGH)
    for contact, before, film in zip(contacts, computed, operating, strict=True):
        if film is None:
            continue
        shares, _ = shares_behind([contact], [before.flooded_central], np.array([[oil.oil.layer]]))
        central, _, moment = shares[0, 0]
        assert film.supply.central == central < 1.0
        assert film.gap_fraction == pytest.approx(film.heat.central.value * central, rel=1e-12)
        assert film.rolling_moment == pytest.approx(film.heat.moment.value * moment * before.flooded_moment, rel=1e-12)
        assert film.asperity_load == ROUGH.load_fraction(contact, film.central.value)
        assert film.flooded_asperity_load == ROUGH.load_fraction(contact, before.flooded_central) < film.asperity_load
        assert film.lambda_ratio == film.minimum.value / ROUGH.roughness(contact.race)
        flooded = film.flooded()
        assert (flooded.values, flooded.rolling_moment) == (before.values, before.flooded_moment)
        assert film.isothermal_central == pytest.approx(film.central.value / film.heat.central.value, rel=1e-12)
        assert flooded.asperity_load == film.flooded_asperity_load


def test_equal_contacts_share_what_is_solved(contacts):
    """The rolling moment of a shared solution is the same number; the film that did not converge is none."""
    first = next(n for n, contact in enumerate(contacts) if contact.conditions is not None)
    solution = solve_contact(contacts[first].conditions, SolverOptions(points=65))
    solutions = [None] * len(contacts)
    solutions[first] = solutions[first + 1] = solution
    films = solved_films(contacts, solutions)
    assert films[first].origin is FilmOrigin.SOLVED
    assert films[first].flooded_moment == films[first + 1].flooded_moment > 0.0
    assert films[first].field is films[first + 1].field


@pytest.mark.parametrize("layer", [None, 0.15e-6])
def test_the_operating_field_has_the_operating_films(contacts, layer):
    """Centre and thinnest node are the films to round-off; between and around them the gap follows the computed one."""
    first = next(n for n, contact in enumerate(contacts) if contact.conditions is not None)
    solution = solve_contact(contacts[first].conditions, SolverOptions(points=65))
    computed = solved_films(contacts[first : first + 1], [solution])
    oil = None if layer is None else OilAtInlets(oil=PrescribedInlet(layer=layer), balls=9)
    (film,) = operating_films(contacts[first : first + 1], computed, supply=oil)
    field = film.operating_field
    assert film.central.value < computed[0].central.value
    centre = field.film[abs(field.X).argmin(), abs(field.Y).argmin()]
    assert [centre, field.film.min()] == pytest.approx(film.values, rel=1e-12)
    assert [field.film_central, field.film_minimum] == pytest.approx(film.values, rel=1e-12)
    assert field.film_central_uncertainty == pytest.approx(film.central.error, rel=1e-12)
    order = np.argsort(solution.H, axis=None)
    assert (np.diff(field.H.ravel()[order]) >= 0.0).all()  # contours keep their shape
    far = solution.H > 3.0 * solution.film_central_dimensionless.value
    closed = solution.H - field.H
    assert np.ptp(closed[far]) < 1e-9  # bodies around the contact approach as one
    assert np.array_equal(field.P, solution.P)


def test_same_objects_are_told_by_what_they_are():
    one, other = [1.0], [1.0]
    assert first_same([one, None, other, one, None]) == [0, 1, 2, 0, 1]


@pytest.mark.parametrize("value", [0.0, 1e-7])
def test_the_relative_error_of_no_film_is_zero(value):
    film = FilmThickness(value, 0.1 * value)
    assert film.relative_error == (pytest.approx(0.1) if value else 0.0)
    assert FilmThickness(1e-7, np.inf).relative_error == np.inf
    assert ContactFilm.__dataclass_params__.frozen
