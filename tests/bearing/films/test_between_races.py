"""Balls that the elastic contacts leave free ride between two films that fill their gap."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime

import numpy as np
import pytest

from oilfilm.bearing import Operation, load_bearing, load_lubricant, solve_quasistatic
from oilfilm.bearing.contacts.contacts import contact_conditions
from oilfilm.bearing.films.between_races import UNFILLED, equilibrium_with_films
from oilfilm.bearing.films.operating_film import operating_films, with_formulas
from oilfilm.bearing.geometry import Race
from oilfilm.bearing.invariants import forces_left
from oilfilm.bearing.supply.inlet_oil import OilAtInlets, PrescribedInlet

RPM = np.pi / 30.0
FITS = 1e-3  # of the film: what the rounds leave, at most 1e-4 in 150 draws
NAMES = ("6205", "6304", "6006", "61808", "7208B", "7012AC", "6310", "6202")
# 6205, VG 100, 3800 r/min, 700 N: loads of the inner race at 0, 40, 80, 120 and 160 degrees [N] by temperature [C],
# from an independent calculation with isothermal films; all balls yield to their films
LOADS = {
    25.0: (370.0, 225.0, 15.1, 7.9, 6.5),
    40.0: (378.0, 213.0, 5.9, 2.8, 2.2),
    55.0: (383.0, 208.0, 2.7, 1.2, 0.9),
    70.0: (386.0, 206.0, 1.4, 0.6, 0.5),
}


def state(name, rpm, force, celsius, grade):
    """Equilibrium, its contacts, and the oil."""
    operation = Operation(inner_speed=rpm * RPM, force=force, temperature=celsius + 273.15)
    solution = solve_quasistatic(load_bearing(name), operation)
    oil = load_lubricant(f"iso vg {grade}", operation.temperature)
    return solution, contact_conditions(solution, oil), oil


def misfits(contacts, supply=None):
    """Film less the gap with the elastic approach, over the film, of each light contact."""
    films = operating_films(contacts, with_formulas(contacts, [None] * len(contacts)), supply=supply)
    pairs = [(contact, film) for contact, film in zip(contacts, films, strict=True) if contact.gap is not None]
    return np.array([1.0 - (c.gap + c.hertz.approach) / film.central.value for c, film in pairs])


def left(solution, contacts):
    """Force that the loads of contacts leave on ring and balls, over the largest."""
    return max(forces_left(solution, contacts).values())


@pytest.mark.parametrize("celsius", LOADS)
def test_loads_of_free_balls(celsius):
    """Within 10 % and a digit, heavy ones 2 %: films have the heat of the inlet here."""
    solution, contacts, oil = state("6205", 3800.0, (0.0, 700.0, 0.0), celsius, 100)
    _, found = equilibrium_with_films(solution, contacts, oil)
    loads = [found[2 * ball].load for ball in range(5)]
    assert loads[:2] == pytest.approx(LOADS[celsius][:2], rel=0.02)
    assert loads[2:] == pytest.approx(LOADS[celsius][2:], rel=0.1, abs=0.05)
    for ball in range(5):  # the outer race holds the centrifugal force, too
        more = found[2 * ball + 1].load - found[2 * ball].load
        assert more == pytest.approx(solution.centrifugal_force[ball], rel=1e-6)
    # the outer race carries the load of the ring, the centrifugal forces of all balls cancel
    radial = sum(c.load * c.normal for c in found if c.race is Race.OUTER)
    assert radial[1] == pytest.approx(700.0, rel=1e-8)
    assert left(solution, found) < 1e-8
    assert np.abs(misfits(found)).max() < FITS
    assert equilibrium_with_films(solution, found, oil)[1] is found


@pytest.mark.filterwarnings("ignore:lubricant")
def test_films_of_random_bearings_fit_their_gaps():
    """Drawn by the date, radial and combined loads, cold oil, too; forces of ring and balls are in balance."""
    seed = int(datetime.now(tz=UTC).strftime("%Y%m%d"))
    generator = np.random.default_rng(seed)
    checked = 0
    for _ in range(12):
        name = str(generator.choice(NAMES))
        bearing = load_bearing(name)
        size = bearing.ball_diameter**2 * bearing.balls * 2e7
        force = size * np.exp(generator.uniform(np.log(3e-3), np.log(0.1)))
        thrust = force * float(generator.choice([0.0, 0.1, 0.5]))
        rpm = np.exp(generator.uniform(np.log(200.0), np.log(200.0 / bearing.pitch_diameter)))
        celsius, grade = generator.uniform(-10.0, 100.0), int(generator.choice([32, 68, 100]))
        solution, contacts, oil = state(name, rpm, (thrust, force, 0.0), celsius, grade)
        if not solution.converged:
            continue
        _, found = equilibrium_with_films(solution, contacts, oil)
        assert left(solution, found) < 1e-8, (seed, name, rpm, force, thrust, celsius, grade)
        miss = misfits(found)
        checked += miss.size
        assert np.abs(miss).max(initial=0.0) < FITS, (seed, name, rpm, force, thrust, celsius, grade)
    assert checked > 20


def test_position_and_stiffness_of_the_ring_have_the_films():
    """Films lift the ring, and its stiffness is the difference of its own equilibria."""

    def held(force):
        solution, contacts, oil = state("6205", 3800.0, (0.0, force, 0.0), 40.0, 100)
        return solution, *equilibrium_with_films(solution, contacts, oil)

    dry, wet, contacts = held(700.0)
    assert 1.5e-6 < dry.displacement[1] - wet.displacement[1] < 2.5e-6  # 18.3 less 16.3 um by hand
    assert wet.inner_load == pytest.approx([c.load for c in contacts[::2]], rel=1e-12)
    assert wet.ring_force == pytest.approx(dry.ring_force)
    assert wet.row_load.sum(axis=0)[1] == pytest.approx(700.0, rel=1e-8)
    steps = held(701.0)[1].displacement - held(699.0)[1].displacement
    assert wet.stiffness[:3, :3] @ steps == pytest.approx([0.0, 2.0, 0.0], abs=1e-4)
    assert np.allclose(wet.stiffness, wet.stiffness.T, rtol=1e-9, atol=1e-6 * wet.stiffness.max())


def test_layers_that_do_not_fill_the_gap_carry_nothing():
    """Two micrometres of oil on each race do not bridge the gaps of 15 and 23 um."""
    solution, contacts, oil = state("6205", 3800.0, (0.0, 700.0, 0.0), 40.0, 100)
    scarce = OilAtInlets(oil=PrescribedInlet(layer=2e-6), balls=9)
    _, found = equilibrium_with_films(solution, contacts, oil, scarce)
    for ball in (3, 4, 5, 6):
        assert found[2 * ball].load == 0.0
        assert found[2 * ball].note == UNFILLED
        assert found[2 * ball + 1].load == pytest.approx(solution.centrifugal_force[ball])
    assert np.abs(misfits(found, scarce)).max(initial=0.0) < FITS


def test_heavy_balls_yield_to_their_films_where_no_gap_is_filled():
    """As where the layers just fill one: loads do not jump as the last light ball leaves its inner film."""
    solution, contacts, oil = state("6205", 3800.0, (0.0, 700.0, 0.0), 40.0, 100)
    scarce = OilAtInlets(oil=PrescribedInlet(layer=3e-7), balls=9)
    _, found = equilibrium_with_films(solution, contacts, oil, scarce)
    assert all(contact.gap is None for contact in found)
    assert left(solution, found) < 1e-8
    assert 1e-3 < 1.0 - found[0].load / contacts[0].load < 0.05  # the balls beside it carry more
    assert found[2].load > 1.001 * contacts[2].load


def test_nothing_changes_without_light_balls_or_rotation():
    solution, contacts, oil = state("7012AC", 3000.0, (1000.0, 0.0, 0.0), 40.0, 68)
    assert equilibrium_with_films(solution, contacts, oil)[1] is contacts
    solution, contacts, oil = state("6205", 0.0, (0.0, 700.0, 0.0), 40.0, 68)
    assert equilibrium_with_films(solution, contacts, oil)[1] is contacts
    assert all(contact.race in Race and replace(contact).gap is None for contact in contacts)


@pytest.mark.parametrize("celsius", [20.0, 40.0, 80.0])
def test_a_gap_as_wide_as_an_arm_is_not_filled(celsius):
    """A ring pressed 20 um into the balls of an MR117: the others ride with ring and loads in balance."""
    solution, contacts, oil = state("MR117", 3701.0, (0.0, 819.8, 0.0), celsius, 100)
    held, found = equilibrium_with_films(solution, contacts, oil)
    assert held is not solution
    assert left(held, found) < 1e-8
    assert UNFILLED in {contact.note for contact in found}
