"""Stiffness and damping over loads and speeds from responses at some of them."""

from __future__ import annotations

from itertools import product
from math import nan

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from ehl import Lubricant
from ehl.oil.rheology import Rheology
from ehl.traction.response.normal import NormalResponse, ResponseValue, dry_stiffness
from ehl.traction.table.film import FilmSample
from ehl.traction.table.responses import log_responses, wanted_responses
from ehl.traction.table.table import TableContact

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


def test_responses_of_less_than_half_of_the_films_give_those_of_all():
    wanted = wanted_responses(NODES, [False] * len(NODES))
    assert sum(wanted) <= 0.45 * len(NODES)
    expected = log_responses(CONTACT, films([True] * len(NODES)))
    found = log_responses(CONTACT, films(wanted))
    chosen = np.array(wanted).reshape(LOADS.size, -1)
    assert_allclose(found[chosen], expected[chosen], rtol=1e-12)
    assert np.all(np.abs(found - expected) < [0.025, 0.05])
    assert np.sqrt(np.mean((found - expected) ** 2)) < 0.01


def test_nodes_between_known_ones_are_not_asked_for_again():
    known = wanted_responses(NODES, [False] * len(NODES))
    assert wanted_responses(NODES, known) == known
    loads = 0.5 * (LOADS[1:] + LOADS[:-1])
    more = [(float(load), float(speed)) for load, speed in product(loads, SPEEDS)]
    again = wanted_responses(NODES + more, [*known, *[False] * len(more)])
    assert again[: len(NODES)] == known
    assert sum(again[len(NODES) :]) <= 2


def test_loads_that_are_far_apart_all_have_their_response():
    far = [(load, 2.0) for load in np.log(11.0) + 0.5 * np.arange(4)]
    assert wanted_responses(far, [False] * 4) == [True] * 4


def test_films_near_one_without_a_response_take_that_of_neighbouring_loads():
    wanted = wanted_responses(NODES, [False] * len(NODES))
    lightest = NODES[: SPEEDS.size]
    found = log_responses(CONTACT, films(wanted, [lightest[0]]))
    expected = log_responses(CONTACT, films(wanted))
    first = int(np.argmax(found[:, 0, 1] != found[0, 0, 1]))
    assert 2 <= first <= 4
    assert_array_equal(found[:first, 0], np.broadcast_to(found[0, 0], (first, 2)))
    assert_allclose(found[first:], expected[first:], rtol=0.0, atol=0.05)
    with pytest.raises(ValueError, match="no film has a stiffness and damping"):
        log_responses(CONTACT, films(wanted, NODES))


def test_few_responses_are_not_interpolated_over_both():
    """As many as the corners only: those of the loads beside."""
    corners = [place[0] in (LOADS[0], LOADS[-1]) and place[1] in (SPEEDS[0], SPEEDS[-1]) for place in NODES]
    rows = [[row[0], row[-1]] for row in films(corners)]
    found = log_responses(CONTACT, rows)
    assert np.isfinite(found).all()
    straight = np.linspace(found[0], found[-1], LOADS.size)
    assert_allclose(found[..., 1], straight[..., 1], rtol=1e-12)
