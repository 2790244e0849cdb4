"""Traction equilibrium: every balance checked by vectors of its own, limits, power, random bearings."""

from __future__ import annotations

from dataclasses import replace
from math import pi

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing import (
    BallKinematics,
    Operation,
    QuasistaticModel,
    Race,
    Row,
    contact_conditions,
    solve_quasistatic,
    solve_traction_equilibrium,
)
from oilfilm.bearing.contacts.motion import bearing_kinematics, motion_map
from oilfilm.bearing.contacts.shape import contact_shape
from oilfilm.bearing.friction.balance import balance_driven_balls, curvature_slip
from oilfilm.bearing.friction.cage import ball_velocities
from oilfilm.bearing.friction.contact_friction import BallTraction
from oilfilm.bearing.friction.friction_sources import CoefficientTraction, CoulombTraction, LawTraction
from oilfilm.bearing.friction.resistance import Cage, Mixture, Resistance, resistance_of
from oilfilm.ehl import Lubricant
from oilfilm.ehl.traction.friction_coefficients import FourConstants, RampedCoulomb
from oilfilm.ehl.traction.shear import EllipseLaw

from ..quasistatic.test_random_bearings import random_bearing, random_operation

OIL = Lubricant(viscosity=0.02, pressure_viscosity=18e-9)  # makes contact conditions; the friction is a law's
FOUR = CoefficientTraction(FourConstants.of_curve(0.05, 0.03, 0.03))
COULOMB = CoulombTraction(friction=0.06)
E_X = np.array([1.0, 0.0, 0.0])


def solved(bearing, operation, source, resistance=None, **options):
    traction = BallTraction(source=source, lubricant=OIL, resistance=resistance or Resistance())
    return solve_traction_equilibrium(bearing, operation, None, traction, **options)


def friction(state, source):
    """Contacts of a solved bearing, their motions (n, 4) and forces and moments (n, 4) on the balls."""
    contacts = contact_conditions(state, OIL)
    kinematics = [bearing_kinematics(state, contact) for contact in contacts]
    motion = np.array([[k.sliding_x, k.sliding_y, k.spin, k.rolling] for k in kinematics])
    law = source.at(state, contacts)
    return contacts, motion, -law.evaluate(motion, np.arange(len(contacts))).gradient


def left_over(state, source):
    """Force and moment left on every ball and force on the ring, by vectors in the bearing's frame."""
    contacts, _, forces = friction(state, source)
    radius, count = 0.5 * state.bearing.ball_diameter, state.azimuth.size
    force, moment, ring = np.zeros((count, 3)), np.zeros((count, 3)), np.zeros(3)
    for contact, (along, across, spin, rolling) in zip(contacts, forces, strict=True):
        pull = -contact.load * contact.normal + along * contact.axis_x + across * contact.axis_y
        force[contact.ball - 1] += pull
        moment[contact.ball - 1] += np.cross(radius * contact.normal, pull)
        moment[contact.ball - 1] += spin * contact.normal + rolling * contact.axis_y
        ring -= pull if contact.race is Race.INNER else 0.0
    c, s, zero = np.cos(state.azimuth), np.sin(state.azimuth), np.zeros(count)
    radial, tangential = np.stack([zero, c, s], axis=1), np.stack([zero, -s, c], axis=1)
    axis = np.sin(state.attitude)[:, None] * radial - np.cos(state.attitude)[:, None] * E_X
    turn = state.spin_speed[:, None] * axis + state.pivot_speed[:, None] * tangential
    mass = state.bearing.ball_material.density * pi / 6.0 * state.bearing.ball_diameter**3
    force += (0.5 * mass * state.bearing.pitch_diameter * state.orbit_speed**2)[:, None] * radial
    inertia = 0.1 * mass * state.bearing.ball_diameter**2
    moment -= inertia * np.cross(state.orbit_speed[:, None] * E_X, turn)
    return force, moment, ring


CASES = (
    ("b218", {"inner_speed": 1000.0, "force": (22250.0, 0.0, 0.0)}, FOUR),
    ("b218", {"inner_speed": -700.0, "force": (-20000.0, 9000.0, 0.0)}, COULOMB),
    ("b7008", {"inner_speed": 500.0, "outer_speed": -200.0, "force": (300.0, 100.0, 50.0)}, FOUR),
    ("b6208", {"inner_speed": 800.0, "force": (600.0, 1000.0, 300.0)}, COULOMB),
)


@pytest.mark.parametrize(("name", "operation", "source"), CASES)
def test_forces_and_moments_of_balls_and_ring_balance(bearings, name, operation, source):
    """All six balances of each ball and the ring's, to 1e-8 of the loads; rings' power is heat to 1e-6."""
    state = solved(getattr(bearings, name), Operation(**operation), source)
    assert state.converged, state.message
    assert (state.inner_load > 0.0).all()
    force, moment, ring = left_over(state, source)
    assert_allclose(force, 0.0, atol=1e-8 * state.inner_load.max())
    assert_allclose(moment, 0.0, atol=1e-8 * state.inner_load.max() * state.bearing.ball_diameter)
    assert_allclose(ring, -np.array(state.operation.force), atol=1e-8 * state.inner_load.max())
    assert_allclose(state.ring_force, state.operation.force, atol=1e-8 * state.inner_load.max())
    both = (state.inner_friction + state.outer_friction) * 0.5 * state.bearing.ball_diameter
    assert_allclose(both, state.gyroscopic_moment, rtol=1e-6)
    contacts, motion, forces = friction(state, source)
    heat = -float((forces * motion).sum())
    shaft = -(np.array(forces) * motion_map(state, contacts).ring).sum()
    assert shaft == pytest.approx(heat, rel=1e-6)


def test_power_that_drag_and_cage_take_is_the_rest(bearings):
    """The rings' power is heat and what the balls give to the oil around them and to the cage's land."""
    cage = Cage(pocket_friction=0.0, land_diameter=0.066, land_width=4e-3, land_clearance=3e-4)
    radius = 0.5 * bearings.b6208.ball_diameter
    mixture = Mixture(oil_share=0.05, density=870.0, viscosity=0.02, ball_radius=radius)
    resistance = resistance_of(cage, 0.02, mixture)
    operation = Operation(inner_speed=800.0, force=(600.0, 1000.0, 0.0))
    state = solved(bearings.b6208, operation, COULOMB, resistance)
    free = solved(bearings.b6208, operation, COULOMB)
    contacts, motion, forces = friction(state, COULOMB)
    heat = -float((forces * motion).sum())
    shaft = -(np.array(forces) * motion_map(state, contacts).ring).sum()
    mean = np.average(state.orbit_speed, weights=state.inner_load)
    velocities = ball_velocities(state)
    given = float((resistance.drag(velocities) * velocities).sum()) + resistance.cage_power(state, mean)
    assert given > 0.05 * heat
    assert shaft == pytest.approx(heat + given, rel=1e-6)
    assert state.cage_speed < free.cage_speed


def test_balls_under_radial_load_have_no_attitude_and_roll_at_the_kinematic_speed(bearings):
    """Symmetric grooves, no thrust: no spin, no couple, orbit within the little slide that drives the ball."""
    operation = Operation(inner_speed=800.0, force=(0.0, 3000.0, 0.0))
    state = solved(bearings.b6208, operation, FOUR)
    assumed = solve_quasistatic(bearings.b6208, operation)
    assert state.converged
    assert_allclose(state.attitude, 0.0, atol=1e-12)
    assert_allclose(state.pivot_speed, 0.0, atol=1e-9 * 800.0)
    assert_allclose(state.inner_load, assumed.inner_load, atol=2e-3 * assumed.inner_load.max())
    loaded = state.inner_load > 0.0
    assert_allclose(state.orbit_speed[loaded], assumed.orbit_speed[loaded], rtol=0.01)
    assert_allclose(state.orbit_speed[~loaded], state.orbit_speed[loaded].mean(), rtol=0.01)


def test_at_little_speed_the_motion_does_not_know_how_strong_the_friction_is(bearings):
    """Without inertia to hold, Coulomb's mu cancels; every contact has a line of pure rolling, loads are those at rest.

    Friction is rounded off alike for all mu, hence the tolerance is that of the gyroscopic couple left.
    """
    operation = Operation(inner_speed=1.0, force=(5000.0, 1500.0, 0.0))
    weak, strong = (solved(bearings.b7008, operation, CoulombTraction(friction=mu)) for mu in (0.05, 0.5))
    assert weak.converged and strong.converged
    assert_allclose(strong.attitude, weak.attitude, rtol=1e-4)
    assert_allclose(strong.orbit_speed, weak.orbit_speed, rtol=1e-4)
    contacts = contact_conditions(strong, OIL)
    slides = [abs(bearing_kinematics(strong, contact).sliding_x) for contact in contacts]
    assert (slides < curvature_slip(strong, contacts)).all()
    still = solve_quasistatic(bearings.b7008, replace(operation, inner_speed=0.0))
    assert_allclose(weak.inner_load, still.inner_load, rtol=1e-2)


def test_mirror_and_reversed_rotation(bearings):
    """Thrust the other way mirrors attitudes and angles; rotation the other way reverses speeds alone."""
    loads = (15000.0, 4000.0, 0.0)
    first = solved(bearings.b218, Operation(inner_speed=800.0, force=loads), COULOMB)
    mirrored = Operation(inner_speed=800.0, force=(-loads[0], *loads[1:]))
    mirror = solved(bearings.b218, mirrored, COULOMB)
    back = solved(bearings.b218, Operation(inner_speed=-800.0, force=loads), COULOMB)
    assert_allclose(mirror.attitude, -first.attitude, rtol=1e-6)
    assert_allclose(mirror.inner_friction, -first.inner_friction, rtol=1e-6)
    assert_allclose(mirror.orbit_speed, first.orbit_speed, rtol=1e-9)
    assert_allclose(back.orbit_speed, -np.roll(first.orbit_speed[::-1], 1), rtol=1e-9)  # azimuths turn with it
    assert_allclose(back.attitude, np.roll(first.attitude[::-1], 1), rtol=1e-6)


def test_rows_are_in_equilibrium_together(bearings):
    """Two like rows in tandem are one row under half the load."""
    operation = Operation(inner_speed=500.0, force=(600.0, 0.0, 0.0))
    pair = solved(bearings.b7008, operation, FOUR, rows=(Row(), Row()))
    one = solved(bearings.b7008, replace(operation, force=(300.0, 0.0, 0.0)), FOUR)
    assert pair.converged
    for index in range(2):
        assert_allclose(pair.row(index).inner_load, one.inner_load, rtol=1e-8)
        assert_allclose(pair.row(index).inner_friction, one.inner_friction, rtol=1e-6)


class RollingResistance:
    """Coulomb's law and a moment against rolling as oil makes it, which light contacts cannot overcome."""

    def __init__(self, shape):
        self.law = EllipseLaw(shape, RampedCoulomb(friction=0.05, slide_full=0.02))

    def forces(self, *motion):
        """As the law, less 1e-3 N m."""
        found = self.law.forces(*motion)
        return found._replace(rolling_moment=found.rolling_moment - 1e-3)


def test_the_torque_takes_the_balance_of_the_equilibrium(bearings):
    """Balls found to be carried stay so, and the motion found is that of the torque: no step is made any more."""
    shapes = {race: contact_shape(bearings.b6208, race, 0.1) for race in Race}
    source = LawTraction(laws={race: RollingResistance(shape) for race, shape in shapes.items()})
    state = solved(bearings.b6208, Operation(inner_speed=500.0, force=(400.0, 1500.0, 0.0)), source)
    assert state.converged, state.message
    assert state.cage_driven.any() and (state.inner_load[state.cage_driven] > 0.0).all()
    contacts = contact_conditions(state, OIL)
    balance = balance_driven_balls(state, contacts, source.at(state, contacts))
    assert balance.converged
    assert (balance.driven == ((state.inner_load > 0.0) & ~state.cage_driven)).all()
    speeds = np.array([motion.orbit_speed for motion in balance.motions])
    assert_allclose(speeds, state.orbit_speed, rtol=1e-9)
    assert balance.energy_error == pytest.approx(0.0, abs=1e-6)


def test_rings_that_turn_as_one_have_nothing_to_balance(bearings):
    operation = Operation(inner_speed=300.0, outer_speed=300.0, force=(300.0, 0.0, 0.0))
    state = solved(bearings.b7008, operation, FOUR)
    assert state.converged
    assert "as one" in state.message
    assert_allclose(state.spin_speed, 0.0, atol=1e-12)


def test_friction_that_cannot_hold_the_balls_is_told(bearings):
    operation = Operation(inner_speed=5000.0, force=(0.0, 0.0, 0.0))
    state = solved(bearings.b6208, operation, FOUR)
    assert not state.converged
    assert "equilibrium" in state.message


def test_the_quasistatic_solver_refuses_traction_equilibrium(bearings):
    model = QuasistaticModel(ball_kinematics=BallKinematics.TRACTION_EQUILIBRIUM)
    with pytest.raises(ValueError, match="solve_traction_equilibrium"):
        solve_quasistatic(bearings.b6208, Operation(inner_speed=500.0, force=(400.0, 0.0, 0.0)), model)


def test_random_bearings_converge_or_say_why():
    """20 draws of turning bearings at up to 1.5e6 mm r/min."""
    rng = np.random.default_rng(81507)
    failed = []
    drawn = 0
    while drawn < 20:
        bearing = random_bearing(rng)
        operation = random_operation(rng, bearing, 1.5e6)
        if operation.inner_speed == operation.outer_speed:
            continue
        drawn += 1
        source = FOUR if drawn % 2 else COULOMB
        state = solved(bearing, operation, source)
        if not state.converged:
            assert "equilibrium" in state.message
            failed.append(drawn)
            continue
        driven = state.inner_load > 0.0
        if "driven by the cage" not in state.message:
            both = (state.inner_friction + state.outer_friction) * 0.5 * bearing.ball_diameter
            largest = max(np.abs(state.gyroscopic_moment).max(), 1e-3 * state.inner_load.max() * bearing.ball_diameter)
            assert_allclose(both[driven], state.gyroscopic_moment[driven], atol=1e-6 * largest)
    assert len(failed) <= 1
