"""Rolling moments of formulas against closed forms and solved contacts."""

from dataclasses import replace
from math import log, pi, sqrt

import numpy as np
import pytest

from oilfilm.bearing.contacts.contact import hertz_contacts
from oilfilm.bearing.films.moment import flooded_moment
from oilfilm.bearing.films.unsolved_films import formula_central
from oilfilm.bearing.library.lubricants import load_lubricant
from oilfilm.ehl import SolverOptions, ViscosityLaw, solve_contact
from oilfilm.ehl.conditions import ContactConditions
from oilfilm.ehl.traction.rolling_moment import kapitza_moment, rolling_moment


def contact(load, speed=3.0, ratio=0.06, layer=1e-4):
    oil = replace(load_lubricant("iso vg 32", 313.15), flooded_layer=layer)
    return ContactConditions(
        load=load, radius_x=7e-3, radius_y=7e-3 / ratio, reduced_modulus=2.26e11, entrainment_speed=speed, lubricant=oil
    )


@pytest.mark.parametrize("film", [1e-6, 2e-5, 9e-5])
def test_kapitzas_moment_in_a_paraboloid(film):
    """M_0 (ln(H/h) - 1 + h/H)/2 where the layer H is thin beside the radii."""
    c = contact(1.0, ratio=0.5, layer=1e-4)
    c = replace(c, radius_x=1.0, radius_y=2.0)  # [m]: no circle within the oil
    unit = 24.0 * pi * c.lubricant.viscosity * c.entrainment_speed / (4.0 * sqrt(0.5))
    expected = 0.5 * unit * (log(1e-4 / film) - 1.0 + film / 1e-4)
    assert kapitza_moment(c, film) == pytest.approx(expected, rel=1e-3)


def test_no_moment_where_the_film_is_the_layer():
    assert kapitza_moment(contact(0.1), 1e-4) == 0.0
    assert kapitza_moment(contact(0.1), 0.99e-4) < 1e-4 * kapitza_moment(contact(0.1), 1e-6)


@pytest.mark.parametrize(("load", "speed"), [(0.13, 0.9), (0.6, 2.0), (4.0, 3.0), (40.0, 3.0), (300.0, 3.0)])
def test_against_solved_contacts(load, speed):
    """From M 0.8 to 500: Biboulet and Houpert's formula alone is off by factors of 1000 to 1.1."""
    c = contact(load, speed)
    hertz = hertz_contacts(
        np.array([load]), np.array([c.radius_x]), np.array([c.radius_y]), np.array([c.reduced_modulus])
    )[0]
    film = solve_contact(c, SolverOptions(points=65))
    solved = rolling_moment(film)
    formula = flooded_moment(c, hertz.semi_axis_y, hertz.semi_axis_x, formula_central(c))
    whole = kapitza_moment(c, 1e-6)
    assert formula == pytest.approx(solved.value, rel=0.13, abs=0.02 * whole)


def test_formula_film_of_an_isoviscous_oil_knows_no_coefficient():
    """The torque of a 6208 was 10 % off that of the same oil without the key."""
    c = contact(100.0)
    given = replace(c, lubricant=replace(c.lubricant, viscosity_law=ViscosityLaw.ISOVISCOUS))
    none = replace(given, lubricant=replace(given.lubricant, pressure_viscosity=0.0))
    assert formula_central(given) == formula_central(none) < 0.7 * formula_central(c)
