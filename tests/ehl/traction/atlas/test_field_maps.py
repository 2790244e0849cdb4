"""Maps of pressure and gap by the film atlas beside solved ones; contacts without a map."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import scipy

from oilfilm import ehl
from oilfilm.ehl.atlas.field_maps import field_maps
from oilfilm.ehl.scaling import scale_contact

OIL = ehl.Lubricant(viscosity=0.05, pressure_viscosity=20e-9)
CONTACT = ehl.ContactConditions(
    load=300.0, radius_x=5e-3, radius_y=0.1, reduced_modulus=2.3e11, entrainment_speed=3.0, lubricant=OIL
)
LIGHT = replace(CONTACT, load=3.0)  # nearly rigid, A 1.7
# pressure over Hertz', rms in the contact, whose spike meshes have at different places; gap, median and 95 %: of 36
# contacts drawn by `python tools/atlas/maps.py`
PRESSURE, MEDIAN, MOST = 0.03, 0.02, 0.06


@pytest.fixture(scope="module", params=[CONTACT, LIGHT], ids=["heavy", "light"])
def pair(request):
    (found,) = field_maps([request.param])
    return found, ehl.solve_contact(request.param, ehl.SolverOptions(points=257))


def test_a_map_is_that_of_the_solved_contact(pair):
    found, solved = pair
    splines = (scipy.interpolate.RectBivariateSpline(found.X, found.Y, values) for values in (found.P, found.H))
    pressure, gap = (spline(solved.X, solved.Y) for spline in splines)
    contact = solved.P > 0.02 * solved.P.max()
    assert np.sqrt(((pressure - solved.P)[contact] ** 2).mean()) < PRESSURE * solved.P.max()
    middle = [one.H[one.X == 0.0, one.Y == 0.0] for one in (found, solved)]  # meshes are apart by 4 %
    apart = abs(gap / solved.H / (middle[0] / middle[1]) - 1.0)[contact]
    assert np.median(apart) < MEDIAN and np.quantile(apart, 0.95) < MOST


def test_a_map_has_the_films_of_the_atlas_and_carries_the_load(pair):
    found, _ = pair
    films = ehl.atlas_films(found.conditions)
    assert found.film_central == pytest.approx(films.central.value)
    assert found.film_minimum_uncertainty == pytest.approx(films.minimum.uncertainty)
    middle = found.film[found.X == 0.0, found.Y == 0.0]
    assert middle == pytest.approx(films.central.value, rel=1e-3)  # the spline between two lines
    load = np.trapezoid(np.trapezoid(found.P, found.Y), found.X)
    assert load == pytest.approx(scale_contact(found.conditions).load, rel=0.03)  # the rest lies outside the box
    assert np.array_equal(found.H, found.H[:, ::-1])
    assert (found.H > 0.0).all() and (found.P >= 0.0).all()


def test_maps_of_many_are_those_of_each():
    both = field_maps([CONTACT, replace(CONTACT, load=1e6), LIGHT])
    assert both[1] is None  # beyond the films of the atlas
    for one, conditions in ((both[0], CONTACT), (both[2], LIGHT)):
        np.testing.assert_allclose(one.H, field_maps([conditions])[0].H, rtol=1e-9)


def test_turned_and_starved_contacts_have_no_map():
    layer = ehl.InletLayer(thickness=(1e-6,))
    others = [replace(CONTACT, entrainment_angle=0.3), replace(CONTACT, inlet_layer=layer)]
    assert field_maps(others) == [None, None]
