"""Rolling torque by where the oil ends: up to the layer of the lubricant, twice it, the boxes of the films alone."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing import Operation, contact_conditions, solve_quasistatic
from oilfilm.bearing.contacts.motion import ball_speeds, contact_traction, motion_map
from oilfilm.bearing.films.film import NO_HEAT
from oilfilm.bearing.films.operating_film import operating_films, solved_films
from oilfilm.bearing.friction.film_friction import film_law, sheared_films
from oilfilm.bearing.torque.integrated import integrated_torque, rolling_extent, rolling_moments
from oilfilm.ehl import Lubricant, SolverOptions, solve_contact
from oilfilm.ehl.multigrid.supply.oil_supply import pressure_moment
from oilfilm.ehl.oil.lubricant import FLOODED_LAYER
from oilfilm.ehl.oil.rheology import Rheology
from oilfilm.ehl.traction.rolling_moment import scaled_as_solved
from oilfilm.ehl.traction.shear import Cavitation, integrate_traction

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


def with_layer(films, layer):
    """The same films of an oil with another layer at the inlets [m]."""
    oil = replace(OIL, flooded_layer=layer)
    return [film and replace(film, conditions=replace(film.conditions, lubricant=oil)) for film in films]


def rolling_part(state, contacts, running):
    """Of the torque at the motion of the equilibrium [N m]."""
    kinematics = motion_map(state, contacts)
    sheared = sheared_films(state, contacts, running, Rheology())
    motion = kinematics.motion(*ball_speeds(state))
    forces = -sheared.evaluate(motion, np.arange(len(contacts))).gradient
    return integrated_torque(state, kinematics, sheared, motion, forces).rolling


def by_balance(film):
    """What the balance of power changes of the moment of the pressure in the box [N m]."""
    return pressure_moment(film, scaled_as_solved(film))[1] * film.hertz_pressure * film.semi_axis_x**3


@pytest.fixture
def no_inlet_heat(monkeypatch):
    """Films of the friction as they were solved."""
    name = "oilfilm.bearing.films.operating_film.film_heats"
    monkeypatch.setattr(name, lambda contacts, films: [NO_HEAT] * len(films))


@pytest.mark.usefixtures("no_inlet_heat")
def test_integrated_torque_has_the_oil_up_to_its_meniscus(rolling):
    state, tractions, films = rolling
    found = rolling_extent(state, tractions, films)
    contacts = [c for c in contact_conditions(state, OIL) if c.ball in (1, 4)]
    running = operating_films(contacts, solved_films(contacts, films))
    assert found.within_extent == pytest.approx(rolling_part(state, contacts, running), rel=1e-9)
    # strips prolong the box beyond its outlet, whose corners carry 1e-5 of the moment
    own = Cavitation.FULL_WIDTH
    boxes = [
        film
        and replace(
            run,
            flooded_moment=by_balance(film)
            - integrate_traction(film, t.kinematics, Rheology(), cavitation=own).hydrodynamic_moment,
        )
        for run, t, film in zip(running, tractions, films, strict=True)
    ]
    assert found.box == pytest.approx(rolling_part(state, contacts, boxes), rel=1e-9)
    assert abs(found.box - found.within_extent) > 0.03 * found.box
    assert found.layer == FLOODED_LAYER
    assert 0.0 < found.uncertainty < 0.3 * found.within_extent  # 65 points
    assert found.notes == ()


def test_twice_the_layer_adds_what_is_said(rolling):
    state, tractions, films = rolling
    found = rolling_extent(state, tractions, films)
    farther = rolling_extent(state, tractions, with_layer(films, 2.0 * FLOODED_LAYER))
    assert farther.layer == 2.0 * FLOODED_LAYER
    assert farther.within_extent - found.within_extent == pytest.approx(found.doubling, rel=1e-9)
    assert 0.0 < found.doubling < 0.15 * found.within_extent


@pytest.mark.usefixtures("no_inlet_heat")
def test_balls_balance_with_the_moment_of_the_torque(rolling, bearings):
    """A film law pulls with the same rolling moment as the traction of its contact."""
    state, _, films = rolling
    contacts = [c for c in contact_conditions(state, OIL) if c.ball in (1, 4)]
    running = operating_films(contacts, solved_films(contacts, films))
    law = film_law(state, contacts, running, Rheology())
    for n, (contact, film) in enumerate(zip(contacts, running, strict=True)):
        if film is not None:
            traction = contact_traction(state, contact, film.operating_field, Rheology(), None, film.rolling_moment)
            k = traction.kinematics
            motion = np.array([[k.sliding_x, k.sliding_y, k.spin, k.rolling]])
            gradient = law.evaluate(motion, np.array([n])).gradient[0]
            assert -gradient[3] == pytest.approx(traction.result.rolling_moment_1, rel=1e-6)


def test_a_thin_layer_is_reported(rolling):
    state, tractions, films = rolling
    found = rolling_extent(state, tractions, with_layer(films, 1e-5))
    assert any("Hamrock and Dowson" in note and note.startswith("ball ") for note in found.notes)


def test_a_box_that_was_fixed_ends_the_oil(rolling):
    state, tractions, films = rolling
    fixed = [film and replace(film, options=SolverOptions(points=65, domain=film.domain)) for film in films]
    found = rolling_extent(state, tractions, fixed)
    assert found.within_extent == found.box
    assert found.doubling == 0.0
    assert all("[ehl] domain" in note for note in found.notes)


def test_equal_films_are_looked_at_once(rolling):
    _, _, films = rolling
    moments = rolling_moments([*films, films[0], None])
    assert moments[-1] is None and moments[-2] is moments[0]


def test_no_torque_at_rest(rolling, bearings):
    _, tractions, films = rolling
    together = Operation(inner_speed=100.0, outer_speed=100.0, force=(0.0, 900.0, 0.0))
    assert rolling_extent(solve_quasistatic(bearings.b6208, together), tractions, films) is None


@pytest.mark.usefixtures("no_inlet_heat")
def test_balance_and_torque_sum_the_same_nodes(rolling, monkeypatch):
    """On films finer than what is summed: else the power of balls in balance does not close."""
    for module in ("oilfilm.bearing.contacts.motion", "oilfilm.bearing.friction.film_nodes"):
        monkeypatch.setattr(f"{module}.TRACTION_POINTS", 33)
    state, _, films = rolling
    contacts = [c for c in contact_conditions(state, OIL) if c.ball in (1, 4)]
    running = operating_films(contacts, solved_films(contacts, films))
    law = film_law(state, contacts, running, Rheology())
    for number, (contact, film) in enumerate(zip(contacts, running, strict=True)):
        if film is None:
            continue
        field = film.operating_field
        traction = contact_traction(state, contact, field, Rheology(), None, film.rolling_moment)
        k, r = traction.kinematics, traction.result
        motion = np.array([[k.sliding_x, k.sliding_y, k.spin, k.rolling]])
        found = -law.evaluate(motion, np.array([number])).gradient[0]
        assert field.X.size > 33
        assert_allclose(found[[0, 3]], [r.force_x, r.rolling_moment_1], rtol=1e-9)
        assert_allclose(found[[1, 2]], [r.force_y, r.spin_moment], atol=1e-9 * abs(r.force_x))
