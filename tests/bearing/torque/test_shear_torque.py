"""Balance of power of solved films at high speed, where unloaded balls that the cage takes along push much of it."""

from __future__ import annotations

from dataclasses import replace
from itertools import count

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing import Operation, contact_conditions, solve_quasistatic
from oilfilm.bearing.films.asperities import Asperities
from oilfilm.bearing.films.operating_film import operating_films, solved_films, with_formulas
from oilfilm.bearing.friction import balance as balancing
from oilfilm.bearing.friction import cage
from oilfilm.bearing.friction.film_friction import film_balance, film_law
from oilfilm.bearing.friction.resistance import NO_RESISTANCE, Cage, Mixture, resistance_of
from oilfilm.bearing.torque.integrated import POWER_TOLERANCE, SolvedShear, flooded_films, solved_shear
from oilfilm.ehl import Lubricant, SolverOptions, solve_contact
from oilfilm.ehl.oil.rheology import Rheology, ShearLaw

OIL = Lubricant(viscosity=0.0261, pressure_viscosity=18e-9, density=870.0)
EYRING = Rheology(law=ShearLaw.REE_EYRING, eyring_stress=5.2e6, limiting_coefficient=0.047)
ROUGH = Asperities(inner_roughness=0.1e-6, outer_roughness=0.1e-6, boundary=0.12)


def films_of(contacts):
    """Films of all contacts, one solve for balls that are mirror images."""
    known, options = {}, SolverOptions(points=65)
    for contact in contacts:
        place = contact.race, float(f"{contact.load:.6g}")
        if place not in known:
            known[place] = None if contact.conditions is None else solve_contact(contact.conditions, options)
    return [known[contact.race, float(f"{contact.load:.6g}")] for contact in contacts]


@pytest.fixture(scope="module")
def light(bearings):
    """The ceramic 6208 at 10000 r/min under 400 N radial: six balls press on the outer race alone."""
    state = solve_quasistatic(bearings.b6208, Operation(inner_speed=10000.0 * bearings.rpm, force=(0.0, 400.0, 0.0)))
    contacts = contact_conditions(state, OIL)
    assert (state.inner_load == 0.0).sum() == 6
    return state, contacts, operating_films(contacts, solved_films(contacts, films_of(contacts))), EYRING


def test_power_balances_where_the_cage_takes_balls_along(light):
    """The push of the cage is that at the motion found: power to 1e-8 in place of 6e-4, with and without its land."""
    state, contacts, films, rheology = light
    land = resistance_of(
        Cage(pocket_friction=0.1, land_diameter=0.068, land_width=6e-3, land_clearance=2e-4),
        OIL.viscosity, Mixture(oil_share=0.05, density=OIL.density, viscosity=OIL.viscosity, ball_radius=0.006),
    )  # fmt: skip
    for resistance, asperities in ((NO_RESISTANCE, ROUGH), (land, None)):
        solved = solved_films(contacts, [film and film.field for film in films])
        running = operating_films(contacts, solved, asperities=asperities)
        running = [film and replace(film, rolling_fraction=0.6) for film in running]
        shear = solved_shear(state, contacts, running, rheology, resistance, whole=flooded_films(running))
        assert shear.closed and not shear.note
        assert shear.torque.imbalance == pytest.approx(0.0, abs=1e-8)
        assert shear.torque.relative_error == pytest.approx(0.0, abs=1e-8)
        assert shear.flooded is not None
        assert shear.flooded.relative_error == pytest.approx(0.0, abs=1e-8)
        assert shear.torque.rolling == pytest.approx(0.6 * shear.flooded.rolling, rel=0.03)
    assert shear.torque.resisted > 0.1 * shear.torque.heat


def test_inlet_heating_counts_once_in_each_contact(light, monkeypatch):
    """Films not solved with heat lose rolling moment by the law of solved contacts, those that were do not."""
    _, contacts, films, _ = light
    solved = solved_films(contacts, [film and film.field for film in films])
    cold = [film for film in operating_films(contacts, solved) if film is not None]
    assert all(film.rolling_fraction == film.heat.moment.value < 1.0 for film in cold)
    monkeypatch.setattr("oilfilm.bearing.films.film.solved_with_heat", lambda film: True)
    hot = operating_films(contacts, with_formulas(contacts, [solved[0], *[None] * (len(solved) - 1)]))
    first, *others = [film for film in hot if film is not None]
    assert first.rolling_fraction == first.heated_moment == 1.0
    assert all(film.rolling_fraction == film.heated_moment < 1.0 for film in others)


def test_push_is_that_of_the_motion_found_from_a_law_nearby_too(light):
    """Started from the balance under a little less friction, or from none, the push and the motion are the same."""
    state, contacts, films, rheology = light
    less = np.full(len(contacts), 0.99)
    exact, first = (film_law(state, contacts, films, rheology, scale=scale) for scale in (None, less))
    near = balancing.balance_driven_balls(state, contacts, first)
    begun = balancing.balance_balls(state, contacts, exact, driven=near.driven, initial_guess=near)
    fresh = balancing.balance_balls(state, contacts, exact, driven=near.driven)
    assert begun.motions[0].orbit_speed != near.motions[0].orbit_speed
    for found in (near, begun, fresh):
        assert found.converged
        assert found.cage_change <= cage.CAGE_TARGET
        assert found.energy_error == pytest.approx(0.0, abs=1e-8)
    assert_allclose(begun.cage, fresh.cage, rtol=1e-7)
    orbits = np.array([[motion.orbit_speed for motion in found.motions] for found in (begun, fresh)])
    assert_allclose(orbits[0], orbits[1], rtol=1e-9)
    assert np.ptp(orbits[0][~begun.driven]) < 1e-12 * orbits[0].max()  # all with the cage


def test_a_push_that_is_not_found_is_no_balance(light, monkeypatch):
    """A push asked for that jumps with every round: what is left is told, and the balls do not count as balanced."""
    monkeypatch.setattr(cage, "CAGE_STEPS", 4)
    asked, rounds = cage._cage_force, count(1)
    monkeypatch.setattr(cage, "_cage_force", lambda *given: (1.0 + next(rounds) % 2) * asked(*given))
    found = film_balance(*light)
    assert found.residual < balancing.BALANCE_TOLERANCE
    assert found.cage_change > 0.1
    assert not found.converged
    shear = solved_shear(*light)
    assert shear.balanced is None and not shear.closed
    assert "push of the cage" in shear.note


def test_balls_are_balanced_only_where_the_power_is(light):
    balanced = solved_shear(*light).torque
    off = replace(balanced, shaft_power=balanced.shaft_power * (1.0 + 3.0 * POWER_TOLERANCE))
    assert SolvedShear(hypothesis=balanced, balanced=balanced).closed
    assert not SolvedShear(hypothesis=balanced, balanced=off).closed
    assert not SolvedShear(hypothesis=balanced).closed
