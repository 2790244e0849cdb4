"""What the simulation settles to: kinematic speeds, static loads, the onset of gross skid, tolerances."""

from __future__ import annotations

from math import radians

import numpy as np
import pytest
from numpy.testing import assert_allclose
from printed import printed

from oilfilm.bearing import BallKinematics, Operation, QuasistaticModel, solve_quasistatic
from oilfilm.bearing.dynamics.bodies import equation_counts, load_type
from oilfilm.bearing.dynamics.choices import LoadType
from oilfilm.bearing.dynamics.friction import race_friction
from oilfilm.bearing.dynamics.inputs import NormalContact, Schedule
from oilfilm.bearing.dynamics.simulation import simulation
from oilfilm.bearing.dynamics.statistics import RunningStatistics, simulation_statistics
from oilfilm.bearing.friction.friction_sources import CoefficientTraction
from oilfilm.bearing.quasistatic.solution import kinematic_cage_speed
from oilfilm.ehl.traction.friction_coefficients import FourConstants, RampedCoulomb

CONSTANTS = (-0.03, 3.644876513237464, 45.9363161820606, 0.03)  # kappa_max 0.05 at s 0.03, 0.03 at large s


def test_kinematic_cage_speeds(setup):
    """7008 at 5000 r/min: 2186.97 at 15 degrees, 2175.93 at 0; 6304 at 8000 r/min: 2941.4."""
    speed = 5000.0 * setup.RPM
    found = [kinematic_cage_speed(setup.bearing_7008(), speed, 0.0, radians(a)) / setup.RPM for a in (15.0, 0.0)]
    assert_allclose(found, [2186.97, 2175.93], rtol=1e-5)
    speed = 8000.0 * setup.RPM
    assert_allclose(kinematic_cage_speed(setup.bearing_6304(), speed, 0.0, 0.0) / setup.RPM, 2941.4, rtol=5e-4)


def test_equation_counts_are_of_what_is_solved(setup):
    """N = 18. Fewer than Table 1 of Ma et al. (2023) under an axial load (one ball of 18), a few more under others:
    a ring and a cage that friction pushes aside must be free to go.
    """
    operation = setup.operation(5000.0)
    counts = {kind: equation_counts(kind, 18, operation) for kind in LoadType}
    kinds = (LoadType.RADIAL, LoadType.AXIAL, LoadType.COMBINED)
    assert [counts[kind]["dynamic"] for kind in kinds] == [2 + 3 + 54, 1 + 2 + 6, 3 + 6 + 108]
    free = setup.operation(5000.0, moment=(0.0, 0.0), tilt=(None, None))
    assert equation_counts(LoadType.GENERAL, 18, free)["dynamic"] == 5 + 6 + 108


def test_the_load_picks_the_equations(setup):
    bearing = setup.bearing_7008()
    plain = setup.model(bearing)
    for loads, kind in (((0.0, 50.0), LoadType.RADIAL), ((50.0, 0.0), LoadType.AXIAL), ((5.0, 5.0), LoadType.COMBINED)):
        assert load_type(setup.operation(5000.0, *loads), plain) is kind
    heavy = setup.model(bearing, gravity=(0.0, 9.81, 0.0))
    assert load_type(setup.operation(5000.0, 50.0), heavy) is LoadType.GENERAL
    rows = ((500.0, 0.0, 10.0, 0.0, 0.0, 0.0, 0.0), (500.0, 0.0, 10.0, 5.0, 0.0, 0.0, 0.0))
    later = setup.model(bearing, schedule=Schedule(time=(0.0, 1.0), values=rows))
    assert load_type(setup.operation(5000.0), later) is LoadType.COMBINED


@pytest.mark.parametrize(("axial", "load"), [(20.0, 3.69), (100.0, 19.80), (200.0, 39.58)])
def test_loads_of_the_7008_at_5000_rpm(setup, axial, load):
    """The checked loads hold with the gyroscopic couple at the outer race; friction settles between the races."""
    bearing = setup.bearing_7008()
    held = Operation(inner_speed=5000.0 * setup.RPM, force=(axial, None, None), displacement=(None, 0.0, 0.0))
    by_control = [
        solve_quasistatic(bearing, held, QuasistaticModel(ball_kinematics=kinematics)).inner_load[0]
        for kinematics in (BallKinematics.OUTER_RACE_CONTROL, BallKinematics.INNER_RACE_CONTROL)
    ]
    assert_allclose(by_control[0], load, rtol=2e-3)
    friction = race_friction(CoefficientTraction(FourConstants(*CONSTANTS)), bearing, (radians(15.0),) * 2)
    sim = simulation(bearing, setup.operation(5000.0, axial), setup.model(bearing, friction, end_time=2e-3, cage=False))
    inner = setup.run(sim).races[-10:, 0, :, 0].mean()
    assert by_control[1] < inner < by_control[0]


def test_steady_axial_load_rolls_at_the_kinematic_speed(setup):
    """Without drag the balls keep to the kinematic speed of their contact angles within the slip by curvature."""
    bearing = setup.bearing_7008(6)
    friction = race_friction(CoefficientTraction(FourConstants(*CONSTANTS)), bearing, (radians(15.0),) * 2)
    sim = simulation(bearing, setup.operation(5000.0, 50.0), setup.model(bearing, friction, end_time=3e-3))
    record = setup.run(sim)
    orbit = np.linalg.norm(record.state[-1, sim.layout.ball_speed].reshape(-1, 3), axis=1)
    radius = np.linalg.norm(record.state[-1, sim.layout.ball].reshape(-1, 3)[:, 1:], axis=1)
    assert_allclose(orbit / radius, kinematic_cage_speed(bearing, 5000.0 * setup.RPM, 0.0, radians(15.3)), rtol=2e-3)


@pytest.mark.parametrize(("share", "skids"), [(0.85, False), (1.15, True)])
def test_gross_skid_begins_where_drag_is_twice_the_largest_traction(setup, share, skids):
    """2 kappa_max Qi within 15 %: below it the balls keep up, above it they fall back for good."""
    bearing = setup.bearing_7008(3)
    friction = race_friction(CoefficientTraction(FourConstants(*CONSTANTS)), bearing, (radians(15.0),) * 2)
    load = 3 * 5.0 * np.sin(radians(16.0))
    speed = 5000.0 * setup.RPM
    orbit = kinematic_cage_speed(bearing, speed, 0.0, radians(15.0))
    still = simulation(bearing, setup.operation(5000.0, load), setup.model(bearing, friction, cage=False))
    inner = float(still.point.equilibrium.inner_load.mean())
    drag = share * 2.0 * 0.05 * inner / (orbit * 27e-3) ** 2
    model = setup.model(bearing, friction, cage=False, drag=drag, end_time=0.08, sample_interval=1e-3)
    sim = simulation(bearing, setup.operation(5000.0, load), model)
    record = setup.run(sim)
    reached = np.linalg.norm(record.state[-1, sim.layout.ball_speed][:3]) / 27e-3 / orbit
    assert (reached < 0.9) if skids else (reached > 0.95), reached


def test_plateau_of_the_6304(setup):
    """Under 300 N the cage of the planar 6304 of Shan et al. keeps its printed speed, a light drag acting."""
    (plateau,) = printed("shan_2023_cage_speed")
    bearing = setup.bearing_6304()
    friction = race_friction(
        CoefficientTraction(RampedCoulomb(friction=0.05, slide_none=1e-3, slide_full=0.1)),
        bearing,
        (0.0, 0.0),
        at_centre=True,
    )
    normal = NormalContact(inner_stiffness=9.103e9, outer_stiffness=1.1935e10)
    model = setup.model(
        bearing, friction, normal=normal, end_time=0.05, sample_interval=5e-4, drag=1e-4,
        cage_options={"mass": 0.01, "polar_inertia": 8.2e-7, "transverse_inertia": 8.2e-7, "pocket_friction": 0.02},
    )  # fmt: skip
    sim = simulation(bearing, setup.operation(8000.0, 0.0, 300.0), model)
    record = setup.run(sim)
    turned = record.state[:, sim.layout.cage][:, 3]
    late = record.time > 0.02
    mean = np.polyfit(record.time[late], turned[late], 1)[0] / setup.RPM
    assert_allclose(mean, float(plateau["cage_speed_rpm"]), atol=float(plateau["cage_speed_tolerance_rpm"]))
    assert sim.converged


def test_finer_tolerance_changes_little(setup):
    """The axial cage speed by less than 0.1 %."""
    bearing = setup.bearing_7008(6)
    friction = race_friction(CoefficientTraction(FourConstants(*CONSTANTS)), bearing, (radians(15.0),) * 2)
    ends = []
    for tolerance in (1e-4, 1e-5):
        model = setup.model(bearing, friction, end_time=4e-3, tolerance=tolerance, drag=0.005)
        sim = simulation(bearing, setup.operation(5000.0, 50.0), model)
        ends.append(setup.run(sim).state[-1, sim.layout.cage_speed.start + 3])
    assert_allclose(ends[1], ends[0], rtol=1e-3)


def test_finer_tolerance_under_radial_load_stays_within_the_interval(setup):
    """Loose balls do not repeat: their mean speed with steps ten times finer lies within the intervals told."""
    bearing = setup.bearing_6304()
    friction = race_friction(
        CoefficientTraction(RampedCoulomb(friction=0.05, slide_none=1e-3, slide_full=0.1)),
        bearing,
        (0.0, 0.0),
        at_centre=True,
    )
    found = []
    for tolerance in (1e-4, 1e-5):
        model = setup.model(bearing, friction, end_time=0.06, sample_interval=1e-4, tolerance=tolerance, drag=1e-4)
        sim, running = simulation(bearing, setup.operation(8000.0, 0.0, 100.0), model), RunningStatistics(bearing.balls)
        for record in sim.pieces():
            running.add(record, sim.start_energy)
        found.append(simulation_statistics(sim, running))
    rough, fine = found
    width = rough.cage_interval + fine.cage_interval
    assert width < 0.01 * fine.cage_speed
    assert abs(fine.cage_speed - rough.cage_speed) < width
