"""The steady motion under an axial load against the traction equilibrium of the quasi-static model.

Two programs for one state: here the equations of motion with the friction law run until nothing changes; there ring
and balls are put in equilibrium with the friction of the races, and that friction is balanced on every ball.
"""

from __future__ import annotations

from math import pi, radians

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing import (
    Bearing,
    Material,
    Operation,
    Race,
    contact_angle_to_clearance,
    contact_conditions,
    solve_quasistatic,
    solve_traction_equilibrium,
)
from oilfilm.bearing.dynamics.bodies import ring_body
from oilfilm.bearing.dynamics.friction import RaceFriction, race_friction
from oilfilm.bearing.dynamics.inputs import DynamicsModel, DynamicsOptions
from oilfilm.bearing.dynamics.record import join
from oilfilm.bearing.dynamics.simulation import simulation
from oilfilm.bearing.dynamics.statistics import INPUTS
from oilfilm.bearing.friction.balance import balance_driven_balls
from oilfilm.bearing.friction.contact_friction import BallTraction
from oilfilm.bearing.friction.friction_sources import CoefficientTraction, LawTraction
from oilfilm.bearing.friction.tables import build_race_tables
from oilfilm.cases import load_case
from oilfilm.ehl import Lubricant
from oilfilm.ehl.traction.friction_coefficients import FourConstants
from oilfilm.ehl.traction_table.build import TableOptions

STEEL = Material(name="test steel", youngs_modulus=206e9, poisson_ratio=0.3, density=7800.0)
OIL = Lubricant(viscosity=0.02, pressure_viscosity=18e-9)  # makes contact conditions; the friction is a law's
BEARING = Bearing(
    name="7008 with three balls",
    ball_diameter=7e-3,
    pitch_diameter=54e-3,
    balls=3,
    inner_groove_radius=3.99e-3,
    outer_groove_radius=3.78e-3,
    diametral_clearance=contact_angle_to_clearance(radians(15.0), 3.99e-3, 3.78e-3, 7e-3),
    ball_material=STEEL,
    inner_ring_material=STEEL,
    outer_ring_material=STEEL,
    bore=40e-3,
    width=15e-3,
)


def settled(operation, friction, end_time=0.04, **options):
    """Last row of a simulation without cage and drag, its layout, and the friction power of its second half [W]."""
    options = DynamicsOptions(end_time=end_time, sample_interval=1e-3, **options)
    model = DynamicsModel(options=options, ring=ring_body(BEARING), friction=friction)
    made, record = simulation(BEARING, operation, model), None
    for piece in made.pieces():
        record = piece if record is None else join(record, piece)
    assert made.converged
    lost = record.state[:, made.layout.energy][:, INPUTS:].sum(axis=1)
    half = record.time.size // 2
    return record, made.layout, (lost[-1] - lost[half]) / (record.time[-1] - record.time[half])


def motion(state, layout):
    """Orbit speed, then rotation along x, radius and orbit in the frame that goes round with ball 1 [rad/s]."""
    place, speed, turn = (state[part][:3] for part in (layout.ball, layout.ball_speed, layout.ball_turn))
    radius = np.hypot(place[1], place[2])
    out = place[1:] / radius
    orbit = (place[1] * speed[2] - place[2] * speed[1]) / radius**2
    return np.array([orbit, turn[0] - orbit, turn[1:] @ out, turn[2] * out[0] - turn[1] * out[1]])


def balanced(operation, laws):
    """Ring, balls and their friction in balance together, and the friction of every contact."""
    traction = BallTraction(source=LawTraction(laws=laws), lubricant=OIL)
    state = solve_traction_equilibrium(BEARING, operation, None, traction)
    assert state.converged
    contacts = contact_conditions(state, OIL)
    friction = balance_driven_balls(state, contacts, traction.source.at(state, contacts))
    assert friction.converged
    return state, friction


@pytest.mark.parametrize("axial", [pytest.param(30.0, marks=pytest.mark.slow), 150.0])
def test_steady_motion_is_the_traction_equilibrium(axial):
    """Loads, angles, sliding, spin, friction and power."""
    operation = Operation(inner_speed=5000.0 * pi / 30.0, force=(axial, 0.0, 0.0))
    still = simulation(BEARING, operation, DynamicsModel(
        options=DynamicsOptions(end_time=1.0, sample_interval=1.0), ring=ring_body(BEARING), friction=RaceFriction()
    ))  # fmt: skip
    friction = race_friction(CoefficientTraction(FourConstants.of_curve(0.05, 0.03, 0.03)), BEARING, still.point.angles)
    # at 1e-5 friction on its own clock leaves the turning across, 2e-4 of the ball's, off by 2 % of itself
    compare(settled(operation, friction, tolerance=1e-6, longest_step=2e-6), operation, friction)


@pytest.mark.slow
def test_steady_motion_with_traction_tables_is_the_traction_equilibrium():
    """The same with the tables of solved films; coarse ones, which both programs share."""
    operation = Operation(inner_speed=5000.0 * pi / 30.0, force=(150.0, 0.0, 0.0))
    options = TableOptions(points=65, tolerance=0.5, check_films=2, check_motions=20, rounds=1)
    oil = load_case("7008_axial")
    tables = build_race_tables(solve_quasistatic(BEARING, operation), oil.lubricant, oil.rheology, options)
    assert all(table.converged for table in tables.values())
    friction = RaceFriction(inner=tables[Race.INNER], outer=tables[Race.OUTER])
    # the turning across is 4e-5 of the ball's: at 1e-6 friction on its own clock leaves its force 5 % off
    compare(settled(operation, friction, 0.06, tolerance=1e-7), operation, friction)


def compare(found, operation, friction):
    """The end of a simulation with the quasi-static equilibrium under the same friction laws: forces to 1 %."""
    record, layout, power = found
    state, balance = balanced(operation, {Race.INNER: friction.inner, Race.OUTER: friction.outer})
    expected = balance.motions[0]
    found = motion(record.state[-1], layout)
    races = record.races[-1, :, 0]  # columns as `oilfilm.bearing.dynamics.arrays.ContactColumns`
    assert_allclose(found, [expected.orbit_speed, *expected.rotation], rtol=1e-3)
    assert_allclose(found[0], expected.orbit_speed, rtol=2e-5)
    assert_allclose(races[:, 0], [state.inner_load[0], state.outer_load[0]], rtol=1e-4)
    assert_allclose(races[:, 3], [state.inner_contact_angle[0], state.outer_contact_angle[0]], rtol=1e-5)
    assert_allclose(races[:, 5:8], balance.kinematics[0, :, :3], rtol=3e-3)  # small differences of large speeds
    assert_allclose(races[:, 8:10], balance.forces[0, :, :2], rtol=0.01)
    assert_allclose(power, balance.power.sum(), rtol=5e-3)
