"""Stiffness and damping over loads and speeds from responses at some of them."""

from __future__ import annotations

from itertools import product
from math import nan

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from oilfilm.ehl import Lubricant
from oilfilm.ehl.atlas.films import atlas_load
from oilfilm.ehl.oil.rheology import Rheology
from oilfilm.ehl.scaling import scale_contact
from oilfilm.ehl.traction.linear_response import NormalResponse, ResponseValue, dry_stiffness
from oilfilm.ehl.traction_table.build import log_responses, response_nodes
from oilfilm.ehl.traction_table.film import FilmSample
from oilfilm.ehl.traction_table.table import TableContact

CONTACT = TableContact(
    radius_x=5e-3,
    radius_y=0.1,
    reduced_modulus=3.3e11,
    lubricant=Lubricant(viscosity=0.026, pressure_viscosity=18e-9),
    rheology=Rheology(),
    temperature=313.15,
    curvature_radius=0.01,
)
# even in load^(-1/5), as a table has them
LOADS = np.log(np.linspace(2400.0**-0.2, 11.0**-0.2, 19)[::-1] ** -5.0)
SPEEDS = np.log(np.geomspace(7.5, 18.8, 4))
NODES = [(float(load), float(speed)) for load, speed in product(LOADS, SPEEDS)]


def response(place, converged=True):
    """Of a film that turns from rolling in oil to a flat contact as that of the 6208: most of the stiffness and of the
    damping comes within a factor of two of the load.
    """
    load, speed = place
    turn = (load - np.log(22.0) - 0.68 * (speed - np.log(10.0))) / 0.22
    part = 1.0 / (1.0 + np.exp(-turn))
    dry = dry_stiffness(CONTACT.conditions(float(np.exp(load)), float(np.exp(speed))))
    stiffness = dry * (0.02 + 0.93 * part)
    damping = np.exp(4.5 - 0.7 * (speed - 2.3)) * (0.2 + 0.7 * part + 0.4 * np.exp(-(turn**2)))
    values = (stiffness, damping) if converged else (nan, nan)
    stiffness, damping = (ResponseValue(value=value, uncertainty=0.0) for value in values)
    return NormalResponse(stiffness=stiffness, damping=damping, converged=converged, resolved=True, message="")


def films(wanted, failed=()):
    """Films of all nodes with the responses wanted."""
    rows = [
        FilmSample(
            place=place,
            film=None,
            scales=(1.0, 1.0, 1.0),
            moment=1.0,
            response=response(place, place not in failed) if one else None,
        )
        for place, one in zip(NODES, wanted, strict=True)
    ]
    return [rows[k : k + SPEEDS.size] for k in range(0, len(rows), SPEEDS.size)]


def turns(place):
    """Whether its film turns."""
    load, speed = (float(value) for value in np.exp(place))
    return 1.4 < atlas_load(scale_contact(CONTACT.conditions(load, speed))) < 6.0


def test_responses_of_some_of_the_films_give_those_of_all():
    wanted = response_nodes(CONTACT, NODES, [False] * len(NODES))
    assert sum(wanted) <= 0.65 * len(NODES)
    expected = log_responses(CONTACT, films([True] * len(NODES)))[0]
    found, gaps = log_responses(CONTACT, films(wanted))
    assert gaps == 0
    chosen = np.array(wanted).reshape(LOADS.size, -1)
    assert_allclose(found[chosen], expected[chosen], rtol=1e-12)
    assert np.all(np.abs(found - expected) < [0.025, 0.05])
    assert np.sqrt(np.mean((found - expected) ** 2)) < 0.01


def test_nodes_between_known_ones_are_not_asked_for_again():
    known = response_nodes(CONTACT, NODES, [False] * len(NODES))
    assert response_nodes(CONTACT, NODES, known) == known
    loads = 0.5 * (LOADS[1:] + LOADS[:-1])
    more = [(float(load), float(speed)) for load, speed in product(loads, SPEEDS)]
    again = response_nodes(CONTACT, NODES + more, [*known, *[False] * len(more)])
    assert again[: len(NODES)] == known
    assert sum(own and not turns(place) for own, place in zip(again, NODES + more, strict=True)) <= 2 + sum(known)
    assert sum(again[len(NODES) :]) < len(more) / 2


def test_loads_that_are_far_apart_all_have_their_response():
    far = [(load, 2.0) for load in np.log(11.0) + 0.5 * np.arange(4)]
    assert response_nodes(CONTACT, far, [False] * 4) == [True] * 4


def test_films_near_one_without_a_response_take_that_of_neighbouring_loads():
    wanted = response_nodes(CONTACT, NODES, [False] * len(NODES))
    lightest = NODES[: SPEEDS.size]
    found, gaps = log_responses(CONTACT, films(wanted, [lightest[0]]))
    expected, _ = log_responses(CONTACT, films(wanted))
    first = int(np.argmax(found[:, 0, 1] != found[0, 0, 1]))
    assert 2 <= first <= 4
    assert 1 <= gaps <= first
    assert_array_equal(found[:first, 0], np.broadcast_to(found[0, 0], (first, 2)))
    assert_allclose(found[first:], expected[first:], rtol=0.0, atol=0.05)
    with pytest.raises(ValueError, match="no film has a stiffness and damping"):
        log_responses(CONTACT, films(wanted, NODES))


def test_few_responses_are_not_interpolated_over_both():
    """As many as the corners only: those of the loads beside."""
    corners = [place[0] in (LOADS[0], LOADS[-1]) and place[1] in (SPEEDS[0], SPEEDS[-1]) for place in NODES]
    rows = [[row[0], row[-1]] for row in films(corners)]
    found, _ = log_responses(CONTACT, rows)
    assert np.isfinite(found).all()
    straight = np.linspace(found[0], found[-1], LOADS.size)
    assert_allclose(found[..., 1], straight[..., 1], rtol=1e-12)


@pytest.mark.parametrize("loads", [(100.0, 140.0, 12), (500.0, 1000.0, 12), (100.0, 140.0, 6)])
def test_narrow_ranges_have_responses_enough(loads):
    """Where four corners are close to all nodes; of few nodes each has its own."""
    places = [(float(q), float(u)) for q, u in product(np.log(np.geomspace(*loads)), np.log(np.linspace(5.0, 6.0, 4)))]
    wanted = np.array(response_nodes(CONTACT, places, [False] * len(places)))
    assert wanted.all() if len(places) <= 24 else wanted.sum() > 6
    rows = [
        FilmSample(place=p, film=None, scales=(1.0,) * 3, moment=1.0, response=response(p) if own else None)
        for p, own in zip(places, wanted, strict=True)
    ]
    found, gaps = log_responses(CONTACT, [rows[k : k + 4] for k in range(0, len(rows), 4)])
    assert np.isfinite(found).all() and gaps == 0


def test_films_that_turn_all_have_their_response():
    """In a wide range, where those turn at twenty times its lightest load."""
    loads = np.log(np.geomspace(0.5, 150.0, 19))
    places = [(float(q), float(u)) for q, u in product(loads, np.log(np.geomspace(15.0, 50.0, 4)))]
    wanted = response_nodes(CONTACT, places, [False] * len(places))
    assert all(own or not turns(place) for own, place in zip(wanted, places, strict=True))
    assert sum(wanted) < len(places)
