"""The cage in its pockets: no whirl by mistake, drag, unbalance, uneven play, none at all."""

from __future__ import annotations

from dataclasses import replace
from math import radians
from types import SimpleNamespace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing.dynamics.bodies import require_web
from oilfilm.bearing.dynamics.choices import LoadType, Start
from oilfilm.bearing.dynamics.friction import race_friction
from oilfilm.bearing.dynamics.simulation import from_state, simulation
from oilfilm.bearing.dynamics.statistics import RunningStatistics, _cage_orbit, simulation_statistics
from oilfilm.bearing.friction.friction_sources import CoefficientTraction
from oilfilm.ehl.traction.friction_coefficients import FourConstants

CONSTANTS = (-0.03, 3.644876513237464, 45.9363161820606, 0.03)


def settled(setup, balls=6, axial=60.0, cage=True, **options):
    """Statistics and simulation of a 7008 under an axial load, all coordinates free."""
    bearing = setup.bearing_7008(balls)
    friction = race_friction(CoefficientTraction(FourConstants(*CONSTANTS)), bearing, (radians(15.0),) * 2)
    given = {"end_time": 6e-3, "sample_interval": 5e-5, "film_viscosity": 0.02} | options
    model = setup.model(bearing, friction, cage=cage, **({"equations": LoadType.GENERAL} | given))
    sim, running, records = simulation(bearing, setup.operation(5000.0, axial), model), RunningStatistics(balls), []
    for record in sim.pieces():
        running.add(record, sim.start_energy)
        records.append(record)
    return simulation_statistics(sim, running), sim, records


def test_a_cage_under_an_axial_load_does_not_whirl_by_itself(setup):
    """Shear of one side of each pocket alone drove it at 62 000 r/min, with 33 N in the pockets."""
    found, _, records = settled(setup, drag=0.005)
    assert found.cage_whirls is False
    assert found.largest_pocket_load.max() < 0.5
    centre = np.concatenate([record.state[:, 6:8] for record in records])
    assert np.abs(centre).max() < 1e-9
    assert found.energy_error < 1e-3


def test_a_cage_pushed_aside_goes_round_gently(setup):
    """From a fifth of its play: nothing but films guides it, and their shear across its displacement has no spring
    against it, as in a journal bearing without load. It goes round in its play, forwards, at some newtons' tenths.
    """
    bearing = setup.bearing_7008(6)
    friction = race_friction(CoefficientTraction(FourConstants(*CONSTANTS)), bearing, (radians(15.0),) * 2)
    model = setup.model(
        bearing, friction, equations=LoadType.GENERAL, film_viscosity=0.02, end_time=0.02, sample_interval=1e-4
    )
    sim = simulation(bearing, setup.operation(5000.0, 60.0), model)
    y = sim.state.y.copy()
    y[sim.layout.cage][1] = 2e-5
    sim = from_state(sim.bearing, sim.operation, model, (sim.point, sim.data, y))
    record, running = setup.run(sim), RunningStatistics(6)
    running.add(record, sim.start_energy)
    found = simulation_statistics(sim, running)
    assert found.cage_whirls
    assert 0.0 < found.cage_whirl < 6.0 * found.cage_speed
    assert 0.0 < found.largest_pocket_load.max() < 1.0
    assert found.energy_error < 1e-3


def test_the_oil_drags_the_cage(setup):
    """A torque of 1 N mm at the speed of the cage: it falls back in its pockets, which pull it on."""
    runs = [settled(setup, cage_options={"drag": drag}) for drag in (0.0, 1e-3 / 228.0**2)]
    free, dragged = (found for found, _, _ in runs)
    turned = [records[-1].state[-1, sim.layout.cage][3] for _, sim, records in runs]
    assert dragged.work["churning"] > 0.8 * 1e-3 * 228.0 * 6e-3 > free.work["churning"]
    assert turned[1] < turned[0] - 1e-4
    assert dragged.energy_error < 1e-3


@pytest.mark.parametrize("cage", [{"unbalance": 2e-6}, {"pocket_clearances": (2e-4, 2e-4, 2e-4, 2e-4, 2e-4, 1.5e-4)}])
def test_a_cage_out_of_balance_or_with_uneven_pockets_takes_the_general_equations(setup, cage):
    found, sim, _ = settled(setup, equations=None, cage_options=cage, end_time=1e-3)
    assert sim.state.kind is not LoadType.AXIAL
    assert found.energy_error < 1e-3


def test_pockets_that_overlap_are_refused(setup):
    with pytest.raises(ValueError, match=r"pockets overlap at 3 mm; 18 balls leave less than 2\.377 mm"):
        setup.model(setup.bearing_7008(), cage_options={"pocket_clearance": 3e-3})
    with pytest.raises(ValueError, match="no room for a cage"):
        require_web(SimpleNamespace(pitch_diameter=54e-3, ball_diameter=7e-3, balls=25), 1e-5)
    with pytest.raises(ValueError, match="one a ball, 6, got 2"):
        settled(setup, cage_options={"pocket_clearances": (1e-4, 2e-4)})


def test_balls_without_a_cage_meet(setup):
    """One thrown at the next, no race near: momentum and energy go over, none is lost; friction turns both alike."""
    bearing = setup.bearing_7008(3)
    model = setup.model(
        bearing, cage=False, start=Start.REST, equations=LoadType.GENERAL, end_time=2e-4, sample_interval=1e-6
    )
    sim = simulation(bearing, setup.operation(0.0, 0.0, 0.0), replace(model, ball_friction=0.1))
    y, layout = sim.state.y.copy(), sim.layout
    y[layout.ball] = np.array([[0.0, 20e-3, -3.55e-3], [0.0, 20e-3, 3.55e-3], [0.0, -24e-3, 0.0]]).ravel()
    y[layout.ball_speed] = np.array([[0.1, 0.0, 1.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]).ravel()
    sim.data.normal[:2, 0] = 1e-30  # no races
    sim = from_state(sim.bearing, sim.operation, sim.model, (sim.point, sim.data, y))
    record = setup.run(sim)
    assert record.pockets[:, 0, 0].max() > 1.0
    speed = record.state[-1, layout.ball_speed].reshape(3, 3)
    assert_allclose(speed.sum(axis=0), [0.1, 0.0, 1.0], rtol=1e-9, atol=1e-9)
    assert speed[1, 2] - speed[0, 2] == pytest.approx(0.913, abs=2e-3)  # what e = 0.9 returns
    turn = record.state[-1, layout.ball_turn].reshape(3, 3)
    assert_allclose(turn[0], turn[1], rtol=1e-9)
    assert abs(turn[0, 1]) > 1.0
    assert setup.balance(sim, record) < 1e-3


def test_a_bearing_without_a_cage_runs(setup):
    found, _, _ = settled(setup, cage=False, drag=0.005)
    assert found.cage_whirls is None
    assert found.cage_speed == found.orbit_speed


@pytest.mark.parametrize(
    ("radius", "turns", "whirls"), [(0.08e-3, 9.0, True), (0.02e-3, 9.0, False), (0.08e-3, 0.0, False)]
)
def test_a_whirl_fills_the_play_and_goes_round_one_way(radius, turns, whirls):
    """Small motion at the balls' passage is none, and neither is going to and fro."""
    phase = np.linspace(0.0, 2.0 * np.pi * 9.0, 600)
    across = np.sin(phase) if turns else 0.0 * phase
    place = radius * np.stack([np.cos(phase), across], axis=1)
    c = SimpleNamespace(cage_mass=1e-3, guide=0, pocket_play=0.1e-3)
    found = _cage_orbit(SimpleNamespace(data=SimpleNamespace(constants=c)), place)
    assert (found["cage_orbit"] >= 0.5 * found["cage_play"] and found["one_way"] >= 0.8) is whirls
