"""Pressure and film at few places: what they carry, beside the fields of tables, and where the range ends."""

from __future__ import annotations

from dataclasses import replace
from math import pi

import numpy as np
import pytest

from oilfilm import ehl
from oilfilm.bearing.films.film import FilmThickness
from oilfilm.bearing.films.unsolved_films import formula_values_of, hertz_size, plain_film
from oilfilm.bearing.friction._kernels import film_frictions
from oilfilm.bearing.friction.film_friction import MIN_SLIDING
from oilfilm.bearing.friction.film_nodes import FilmOnSurface, joined_nodes, unsolved_nodes
from oilfilm.ehl.atlas.fields import contact_fields, film_shapes, shape_coordinates
from oilfilm.ehl.atlas.films import atlas_films
from oilfilm.ehl.closed_form.hertz import MEAN_PRESSURE_RATIO
from oilfilm.ehl.oil.rheology import Rheology, ShearLaw, contact_rheology
from oilfilm.ehl.traction.film_quadrature import film_quadrature, sliding_forces, zone_quadrature

SHEAR = Rheology(law=ShearLaw.REE_EYRING, eyring_coefficient=0.047, limiting_coefficient=0.047, limiting_minimum=5e6)
OIL = ehl.Lubricant(viscosity=0.012, pressure_viscosity=19e-9, roelands_z=0.6)
CURVATURE = 100.0  # 1/(2 R) of the race [1/m]


def contact(load, speed=8.0, **changed):
    known = {"radius_x": 3.9e-3, "radius_y": 0.11, "reduced_modulus": 2.26e11, "lubricant": OIL}
    return ehl.ContactConditions(load=load, entrainment_speed=speed, **{**known, **changed})


def motions(conditions):
    """Sliding along, across, spin and rolling, alone and together."""
    u, r = conditions.entrainment_speed, conditions.radius_x
    parts = [(0.003, 0.0, 0.0, 0.0), (0.05, 0.01, 0.0, 0.9), (0.0, 0.004, 0.1, 0.9), (0.02, 0.0, 0.3, 0.0)]
    return np.array([(x * u, y * u, n * u / r, m * u / r) for x, y, n, m in parts])


def frictions(contacts, films, moved):
    """By the nodes that balls are balanced on, of contacts with central films [m] at a motion each."""
    sizes = [hertz_size(own) for own in contacts]
    places = [
        FilmOnSurface(plain_film(own, film), CURVATURE, size[1])
        for own, film, size in zip(contacts, films, sizes, strict=True)
    ]
    own, block = unsolved_nodes(places, SHEAR, None)
    *films_of, own = joined_nodes([block], own)
    found, slope = np.empty((len(moved), 4)), np.empty((len(moved), 4, 4))
    film_frictions(*films_of, moved, own, MIN_SLIDING, found, slope)
    return -found


def friction(conditions, central, moved):
    """Of one contact at several motions."""
    return frictions([conditions] * len(moved), [central] * len(moved), moved)


def summed(quadrature, moved):
    """By the sums of traction tables."""
    slides = tuple(np.ascontiguousarray(part) for part in moved.T[:3])
    return sliding_forces(quadrature, slides, np.ascontiguousarray(moved[:, 3]), CURVATURE)


def law(conditions):
    return contact_rheology(SHEAR, conditions.lubricant, MEAN_PRESSURE_RATIO * hertz_size(conditions)[2])


@pytest.mark.parametrize("load", [60.0, 220.0, 800.0])
def test_few_places_have_the_friction_of_all(load):
    """Within 1 % of the friction at the largest sliding; fields of A 15 to 68."""
    conditions = contact(load)
    fields, u = contact_fields(conditions), conditions.entrainment_speed
    parts = (fields.zone, fields.cells)
    size = hertz_size(conditions)
    whole = zone_quadrature(size[1], parts, OIL, law(conditions), None)
    known = summed(whole, motions(conditions))
    found = friction(conditions, atlas_films(conditions).central.value, motions(conditions))
    largest = np.abs(summed(whole, np.array([[0.1 * u, 0.0, 0.0, 0.0]]))[0, 0])
    arms = largest * np.array([1.0, 1.0, size[1], CURVATURE * size[1] ** 2])
    assert np.abs((found - known) / arms).max() < 0.012


def errors(load):
    """Of the friction beside a film solved on 257 points, as those of the table are, over its largest part."""
    conditions = contact(load)
    solution = ehl.solve_contact(conditions, ehl.SolverOptions(points=257))
    u, size = conditions.entrainment_speed, hertz_size(conditions)
    quadrature = film_quadrature(solution, law(conditions))
    known = summed(quadrature, motions(conditions))
    found = friction(conditions, solution.film_central, motions(conditions))
    largest = np.abs(summed(quadrature, np.array([[0.1 * u, 0.0, 0.0, 0.0]]))[0, 0])
    arms = largest * np.array([1.0, 1.0, size[1], CURVATURE * size[1] ** 2])
    return np.abs((found - known) / np.maximum(arms, np.abs(known).max(axis=0)))


@pytest.mark.parametrize("load", [5.0, 20.0])
def test_light_contacts_have_the_friction_of_solved_films(load):
    """A 3.2 and 8.0, where 513 points change the largest force by 2 %."""
    assert errors(load).max() < 0.035


@pytest.mark.parametrize("load", [0.5, 2.0])
def test_nearly_rigid_contacts_are_alike(load):
    """A 0.7 and 1.7, lighter than those of the table: sliding along; spin goes with the size of the solved box."""
    assert errors(load)[:2, 0].max() < 0.03


def test_a_thinner_film_of_a_light_contact_spreads_less():
    """Oil spreads as the root of the film: a hundredth of the flooded one resists spin by some hundredth, not more."""
    conditions = contact(0.1)
    size = hertz_size(conditions)
    flooded = plain_film(conditions, formula_values_of([(conditions, size[1::-1])])[0].central)
    assert flooded.flooded_central > 20.0 * size[0] ** 2 / conditions.radius_x
    thin = replace(flooded, central=FilmThickness(0.01 * flooded.flooded_central))
    places = [FilmOnSurface(film, CURVATURE, size[1]) for film in (flooded, thin)]
    own, block = unsolved_nodes(places, SHEAR, None)
    reach = np.abs(block.nodes[4:6, own]).max(axis=2)
    assert reach[:, 1] == pytest.approx(0.1 * reach[:, 0], rel=1e-6)
    *films, own = joined_nodes([block], own)
    moved = np.tile([0.0, 0.0, 0.2 * conditions.entrainment_speed / conditions.radius_x, 0.0], (2, 1))
    found, slope = np.empty((2, 4)), np.empty((2, 4, 4))
    film_frictions(*films, moved, own, MIN_SLIDING, found, slope)
    full, thinner = np.abs(found[:, 2])
    assert thinner < 0.03 * full


def places_of(contacts):
    axes = np.array([hertz_size(own)[0] for own in contacts])
    return shape_coordinates(contacts, axes)


def test_pressure_carries_the_load():
    """That of the zone all of it under heavy loads, in light contacts the oil around the rest."""
    contacts = [contact(load) for load in (0.5, 3.0, 30.0, 55.0, 400.0, 20000.0)]
    shapes = film_shapes(places_of(contacts), np.array([0.1 / own.load for own in contacts]))
    zone = (shapes.zone[2] * shapes.zone[3]).sum(axis=1) / (2.0 * pi / 3.0)
    assert (np.diff(zone) > -1e-3).all() and 0.7 < zone[0] < 0.76 and zone[-1] == pytest.approx(1.0, abs=0.01)
    assert all(np.isfinite(part).all() and (part[4] > 0.0).all() and (part[2] >= 0.0).all() for part in shapes)
    # one side mirrors the other
    for part in shapes:
        first, other = np.split(part, 2, axis=2)
        assert first[1] == pytest.approx(-other[1]) and first[[0, 2, 3, 4]] == pytest.approx(other[[0, 2, 3, 4]])


@pytest.mark.parametrize(
    ("changed", "step"), [({}, 0.01), ({"speed": 0.05}, 0.01), ({"radius_y": 1.0}, 0.01), ({"radius_y": 2e-3}, 0.05)]
)
def test_friction_has_no_step_where_tables_end_or_meet(changed, step):
    """Over six decades of load: what friction over the load changes from one load to the next changes little.

    At R_x/R_y 1.95, beyond the tables, the film of their lightest contacts is 3 % off.
    """
    loads = np.geomspace(0.05, 5e4, 3000)
    contacts = [contact(load, **changed) for load in loads]
    moved = np.array([[0.05 * own.entrainment_speed, 0.0, 0.0, 0.0] for own in contacts])
    films = formula_values_of([(own, hertz_size(own)[1::-1]) for own in contacts])
    share = -frictions(contacts, [own.central for own in films], moved)[:, 0] / loads
    steps = np.diff(np.log(share))
    assert np.abs(steps).max() < 0.05 and np.abs(np.diff(steps)).max() < step


def test_oils_without_pressure_viscosity_have_the_thinnest_of_the_table():
    thin = replace(OIL, viscosity_law=ehl.ViscosityLaw.ISOVISCOUS)
    place = places_of([contact(50.0, lubricant=thin)])[0]
    assert place[1] == 1.0 and np.isfinite(film_shapes(place[None], np.ones(1)).zone).all()
