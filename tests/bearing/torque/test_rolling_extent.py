"""Rolling torque by where the oil is: the boxes of the films, beyond them, and up to one distance."""

from __future__ import annotations

from dataclasses import replace

import pytest

from bearing import Operation, contact_conditions, solve_quasistatic
from bearing.contacts.traction import contact_traction
from bearing.torque.integrated import integrated_torque
from bearing.torque.rolling_extent import rolling_extent, rolling_moments
from ehl import Lubricant, SolverOptions, solve_contact
from ehl.oil.rheology import Rheology

OIL = Lubricant(viscosity=0.0261, pressure_viscosity=18e-9, density=870.0)


@pytest.fixture(scope="module")
def rolling(bearings):
    """Two balls of the ceramic 6208, the heaviest and one that presses on the outer race alone."""
    operation = Operation(inner_speed=10000.0 * bearings.rpm, force=(0.0, 900.0, 0.0))
    state = solve_quasistatic(bearings.b6208, operation)
    contacts = [c for c in contact_conditions(state, OIL) if c.ball in (1, 4)]
    films = [c.conditions and solve_contact(c.conditions, SolverOptions(points=65)) for c in contacts]
    assert sum(film is None for film in films) == 1
    pairs = zip(contacts, films, strict=True)
    return state, [film and contact_traction(state, c, film, Rheology()) for c, film in pairs], films


def test_boxes_are_those_of_the_integrated_torque(rolling):
    state, tractions, films = rolling
    found = rolling_extent(state, tractions, films)
    torque = integrated_torque(state, [traction for traction in tractions if traction is not None])
    assert found.box == pytest.approx(torque.rolling, rel=1e-9)
    assert found.within_extent == pytest.approx(found.box - found.beyond_extent + found.beyond_box, rel=1e-12)
    assert found.beyond_box > 0.05 * found.box  # the heavy contacts' boxes are small
    assert found.beyond_extent > 0.05 * found.box  # those of the light one reach past the ball


def test_oil_to_twice_the_distance_adds_what_is_told(rolling, monkeypatch):
    state, tractions, films = rolling
    found = rolling_extent(state, tractions, films)
    monkeypatch.setattr("ehl.traction.rolling_moment.SHARE_OF_RADIUS", 1.0)
    farther = rolling_extent(state, tractions, films)
    assert farther.within_extent - found.within_extent == pytest.approx(found.doubling, rel=0.05)


def test_a_box_that_was_fixed_has_nothing_beyond(rolling):
    state, tractions, films = rolling
    fixed = [film and replace(film, options=SolverOptions(points=65, domain=film.domain)) for film in films]
    found = rolling_extent(state, tractions, fixed)
    assert found.beyond_box is None and found.within_extent is None
    assert "[ehl] domain" in found.note
    assert found.box == rolling_extent(state, tractions, films).box


def test_equal_films_are_looked_at_once(rolling):
    _, _, films = rolling
    moments = rolling_moments([*films, films[0], None])
    assert moments[-1] is None and moments[-2] is moments[0]


def test_no_torque_at_rest(rolling, bearings):
    _, tractions, films = rolling
    together = Operation(inner_speed=100.0, outer_speed=100.0, force=(0.0, 900.0, 0.0))
    assert rolling_extent(solve_quasistatic(bearings.b6208, together), tractions, films) is None
