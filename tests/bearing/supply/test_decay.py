"""Film after the supply stops: limits of both closed forms, their join, loss between balls; oil balance on paper."""

from __future__ import annotations

from dataclasses import replace
from math import pi

import numpy as np
import pytest

from oilfilm.bearing import Operation, contact_conditions, solve_quasistatic
from oilfilm.bearing.films.asperities import Asperities
from oilfilm.bearing.films.decay import film_decay
from oilfilm.bearing.films.operating_film import supplied_films
from oilfilm.bearing.supply.inlet_oil import AMPLE, OilAtInlets, PrescribedInlet, Supply, groove_width
from oilfilm.bearing.supply.supply import side_flow_integral
from oilfilm.ehl import Lubricant

OIL = Lubricant(viscosity=0.0261, pressure_viscosity=18e-9)
ML_MIN = 1e-6 / 60.0  # [m^3/s]
HOURS = 3600.0  # [s]


def starved_films(contacts, supply):
    """Films of formulas at a supply."""
    rough = Asperities(inner_roughness=0.2e-6, outer_roughness=0.2e-6, boundary=0.12)
    return supplied_films(contacts, [None] * len(contacts), OilAtInlets(oil=supply, balls=9), rough)


def loaded(bearings, force, speed=5000.0):
    state = solve_quasistatic(bearings.b6208, Operation(inner_speed=speed * bearings.rpm, force=force))
    contacts = contact_conditions(state, OIL)
    return state, contacts, starved_films(contacts, AMPLE)


@pytest.fixture(scope="module")
def axial(bearings):
    """All balls alike."""
    return loaded(bearings, (900.0, 0.0, 0.0))


def test_thin_films_decay_as_van_zoelen_whatever_the_speed(bearings):
    """d(H^-2)/dt = F/6, F = sum (2/l_t) p_h a/(b^2 eta) I; double the speed and it is the same."""
    rates = []
    for speed in (2500.0, 5000.0):
        state, contacts, films = loaded(bearings, (900.0, 0.0, 0.0), speed)
        decay = film_decay(state, contacts, films, 10.0 * HOURS, PrescribedInlet(layer=0.05e-6))
        length = pi * (2.0 * 60e-3 + 9 * 12e-3)
        rate = sum(
            2.0 / length * h.pressure * h.semi_axis_x * side_flow_integral(h.pressure, OIL)
            / (h.semi_axis_y**2 * OIL.viscosity)
            for h in (contact.hertz for contact in contacts)
        )  # fmt: skip
        expected = (decay.layer[0] ** -2.0 + rate * decay.time / 6.0) ** -0.5
        assert decay.layer == pytest.approx(expected, rel=2e-3)
        assert decay.layer[0] == pytest.approx(0.05e-6, rel=1e-9)
        rates.append(rate)
    assert rates[1] == pytest.approx(rates[0], rel=0.05)  # contact angles differ by centrifugal force


def test_film_falls_and_the_joined_forms_agree(axial):
    """Where no oil is lost between balls, the joined closed forms are within 8 % of all losses."""
    state, contacts, films = axial
    decay = film_decay(state, contacts, films, 10.0 * HOURS)
    assert np.all(np.diff(decay.film) < 0.0)
    assert decay.film_fraction[0] == pytest.approx(1.0, abs=1e-2)
    assert decay.film == pytest.approx(decay.joined, rel=0.08)
    assert decay.half_time < decay.contact_time or decay.film[0] < 0.4e-6
    assert decay.film[np.searchsorted(decay.time, decay.half_time)] < 0.5 * decay.film[0]
    assert decay.final_share == decay.film_fraction[-1] < 0.02


def test_loss_between_balls_empties_the_tracks(axial):
    """A loss of l with every pass is an exponential decay, faster than anything the contacts do."""
    state, contacts, films = axial
    supply = Supply(flow=0.6 * ML_MIN, track_share=0.5, groove_width=0.01, residence_time=20.0, loss=0.05)
    decay = film_decay(state, contacts, films, 1.0, supply)
    thin = (decay.layer > 2e-9) & (decay.layer < 2e-8)
    slope = np.polyfit(decay.time[thin], np.log(decay.layer[thin]), 1)[0]
    assert slope == pytest.approx(-0.05 * decay.passes, rel=0.02)
    assert decay.film[-1] == 0.0
    kept = film_decay(state, contacts, films, 1.0, replace(supply, loss=0.0))
    assert kept.final_share > 0.1


def test_start_is_what_the_supply_gives(axial):
    """The decay of a flow begins at its steady film, that of an inlet film at its own."""
    state, contacts, films = axial
    for supply in (
        Supply(flow=0.6 * ML_MIN, track_share=0.5, groove_width=0.01, residence_time=20.0, loss=0.05),
        PrescribedInlet(layer=0.1e-6),
    ):
        decay = film_decay(state, contacts, films, 1.0, supply)
        steady = starved_films(contacts, supply)
        own = next(film for film, c in zip(steady, contacts, strict=True) if c is decay.contact)
        # a layer given counts without the side flow inside the contact, films without heat
        assert decay.film[0] == pytest.approx(own.supply.central * own.flooded_central, rel=2e-4)


def test_nothing_to_follow(axial):
    state, contacts, films = axial
    dry = Supply(flow=0.0, track_share=0.5, groove_width=0.01, residence_time=20.0)
    assert film_decay(state, contacts, films, 1.0, dry) is None
    assert film_decay(state, contacts, [None] * len(films), 1.0) is None


def test_balls_that_centrifugal_force_alone_loads_wear_the_layer_too(bearings):
    """Under radial load the unloaded balls press out more oil than the loaded ones: pressure keeps a starved film."""
    state, contacts, films = loaded(bearings, (0.0, 3000.0, 0.0))
    all_of_them = film_decay(state, contacts, films, HOURS)
    driven = [f if state.inner_load[c.ball - 1] > 0.0 else None for f, c in zip(films, contacts, strict=True)]
    of_driven = film_decay(state, contacts, driven, HOURS)
    assert all_of_them.contact.ball == of_driven.contact.ball == 1
    assert all_of_them.final_film < 0.7 * of_driven.final_film


def test_arc_of_the_grooves(bearings):
    """From shoulder to shoulder, by the chord and the height of each."""
    bearing = replace(bearings.b6208, inner_shoulder_diameter=53e-3)
    arcs = [2.0 * r * np.arcsin(np.sqrt(h * (2.0 * r - h)) / r) for r, h in ((6.17e-3, 2.5e-3), (6.29e-3, 2e-3))]
    assert groove_width(bearing) == pytest.approx(sum(arcs) / 2.0, rel=1e-12)
