"""What symmetry leaves to be solved, and runs that lose it: each ends as the general equations do."""

from __future__ import annotations

from dataclasses import replace
from math import pi, radians

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing import Operation, solve_quasistatic
from oilfilm.bearing.dynamics.arrays import Constants, changed_data
from oilfilm.bearing.dynamics.bodies import load_type
from oilfilm.bearing.dynamics.choices import LoadType
from oilfilm.bearing.dynamics.friction import race_friction
from oilfilm.bearing.dynamics.inputs import RotatingLoad, Schedule
from oilfilm.bearing.dynamics.reduction import derivative
from oilfilm.bearing.dynamics.simulation import simulation
from oilfilm.bearing.friction.friction_sources import CoefficientTraction
from oilfilm.bearing.quasistatic.symmetric import solve_symmetric, unknowns
from oilfilm.ehl.traction._kernels import hertz_friction, straight_friction
from oilfilm.ehl.traction.friction_coefficients import FourConstants, RampedCoulomb
from oilfilm.ehl.traction.shear import STRAIGHT_NODES, ellipse_lines, unit_gauss

CONSTANTS = (-0.03, 3.644876513237464, 45.9363161820606, 0.03)
END = 4e-3  # [s]


def made(setup, loads, kind=None, times=(0.0, 1e-3, 2e-3), **options):
    """A 7008 with six balls under axial and radial loads at times [s], its equations by load or named."""
    bearing = setup.bearing_7008(6)
    law = CoefficientTraction(FourConstants(*CONSTANTS))
    at_centre = options.pop("at_centre", False)
    friction = race_friction(law, bearing, (radians(15.0),) * 2, at_centre=at_centre)
    speed = 5000.0 * setup.RPM
    rows = tuple((speed, 0.0, axial, radial, 0.0, 0.0, 0.0) for axial, radial in loads)
    given = {"end_time": END, "sample_interval": 1e-4, "drag": 0.005, "film_viscosity": 0.02} | options
    model = setup.model(bearing, friction, schedule=Schedule(time=times, values=rows), equations=kind, **given)
    return simulation(bearing, setup.operation(5000.0, *loads[0]), model)


def ends(setup, *arguments, **options):
    """Record and simulation of the equations by load, and of the general ones."""
    runs = [made(setup, *arguments, kind=kind, **options) for kind in (None, LoadType.GENERAL)]
    return [(setup.run(sim), sim) for sim in runs]


def cage_speed(record, sim):
    """Over the last quarter [rad/s]."""
    turned = record.state[:, sim.layout.cage][:, 3]
    return (turned[-1] - turned[-11]) / (record.time[-1] - record.time[-11])


def test_one_ball_says_what_six_do(setup):
    """Axial load: all of the record, attitudes and energies too; and nine equations instead of 45."""
    (one, solved), (all_balls, general) = ends(setup, [(60.0, 0.0)] * 3)
    assert solved.state.kind is LoadType.AXIAL
    assert solved.equations == {"static": 1, "quasi_static": 3, "ring": 1, "cage": 2, "balls": 6, "dynamic": 9}
    assert solved.data.constants.balls == 6
    layout = solved.layout
    for part, size in ((layout.ball, 1e-9), (layout.ball_speed, 1e-5), (layout.ball_turn, 1e-2)):
        assert_allclose(one.state[:, part], all_balls.state[:, part], atol=size)
    assert_allclose(one.races[..., 0], all_balls.races[..., 0], atol=1e-3)
    assert_allclose(one.attitude, all_balls.attitude, atol=1e-5)
    assert_allclose(one.energy, all_balls.energy, rtol=1e-7, atol=1e-9)
    assert_allclose(one.state[:, layout.energy], all_balls.state[:, layout.energy], rtol=1e-5, atol=1e-7)
    assert_allclose(one.loads[:, [0, 3, 6, 9]], all_balls.loads[:, [0, 3, 6, 9]], atol=1e-3)
    assert setup.balance(solved, one) < 1e-3
    assert_allclose(cage_speed(one, solved), cage_speed(all_balls, general), rtol=1e-5)


@pytest.mark.parametrize("at_centre", [False, True])
def test_the_middle_plane_is_a_mirror_under_a_radial_load(setup, at_centre):
    """Friction over the ellipse, or at its centre alone."""
    (half, solved), (whole, general) = ends(setup, [(0.0, 90.0)] * 3, at_centre=at_centre)
    assert solved.state.kind is LoadType.RADIAL
    assert solved.equations["dynamic"] == 2 + 3 + 3 * 6
    assert_allclose(half.state[-1, solved.layout.ball], whole.state[-1, solved.layout.ball], atol=1e-6)
    assert_allclose(cage_speed(half, solved), cage_speed(whole, general), rtol=1e-3)
    losses = [record.state[-1, solved.layout.energy][3:5] for record in (half, whole)]
    assert_allclose(losses[0], losses[1], rtol=0.02)
    assert setup.balance(solved, half) < 1e-3


def test_a_load_that_reverses_ends_as_the_general_equations_do(setup):
    """The balls cross over to the other shoulders and the cage goes with them: no thrust stays in the pockets."""
    (one, solved), (all_balls, general) = ends(setup, [(60.0, 0.0), (-60.0, 0.0), (-60.0, 0.0)], end_time=8e-3)
    assert solved.state.kind is LoadType.AXIAL
    assert_allclose(cage_speed(one, solved), cage_speed(all_balls, general), rtol=1e-3)
    for record in (one, all_balls):
        assert record.races[-10:, :, :, 3].mean() < -radians(12.0)
        assert record.pockets[-10:, :, 0].max() < 0.5


def test_a_load_step_goes_on_with_the_general_equations(setup):
    (mixed, solved), (all_balls, general) = ends(setup, [(60.0, 0.0), (60.0, 0.0), (60.0, 50.0)])
    assert solved.state.kind is LoadType.GENERAL
    assert any("axial equations at t = 0.001 s; the general ones" in message for message in solved.messages)
    assert_allclose(cage_speed(mixed, solved), cage_speed(all_balls, general), rtol=1e-3)
    assert_allclose(mixed.races[-1, :, :, 0], all_balls.races[-1, :, :, 0], atol=0.2)
    assert setup.balance(solved, mixed) < 1e-3


@pytest.mark.parametrize(
    ("change", "loads", "kind"),
    [
        ({"gravity": (0.0, 9.81, 0.0)}, (60.0, 0.0), LoadType.GENERAL),
        ({"gravity": (0.0, 9.81, 0.0)}, (0.0, 90.0), LoadType.RADIAL),
        ({"gravity": (9.81, 0.0, 0.0)}, (60.0, 0.0), LoadType.AXIAL),
        ({"ring_options": {"unbalance": (2e-6, 0.3)}}, (60.0, 0.0), LoadType.GENERAL),
        ({"ring_options": {"unbalance": (2e-6, 0.3)}}, (0.0, 90.0), LoadType.RADIAL),
    ],
)
def test_weight_and_unbalance_keep_what_symmetry_they_leave(setup, change, loads, kind):
    (record, solved), (all_balls, general) = ends(setup, [loads] * 3, end_time=3e-3, **change)
    assert solved.state.kind is kind
    assert_allclose(cage_speed(record, solved), cage_speed(all_balls, general), rtol=1e-3)


@pytest.mark.parametrize("named", [LoadType.AXIAL, LoadType.RADIAL])
def test_named_equations_that_the_loads_do_not_keep_are_left(setup, named):
    """Both loads from the start; an unbalance that only the test of the accelerations finds."""
    sim = made(setup, [(60.0, 50.0)] * 3, kind=named, end_time=1e-4, sample_interval=5e-5)
    setup.run(sim)
    assert sim.state.kind is LoadType.GENERAL
    assert any(f"symmetry of the {named.value} equations at t = 0 s" in message for message in sim.messages)


def test_a_push_against_the_symmetry_is_found_in_the_accelerations(setup):
    sim = made(setup, [(60.0, 0.0)] * 3, end_time=3e-4, sample_interval=1e-5)
    assert sim._symmetric(sim.control, sim.scale)
    sim.state.y[sim.layout.ball_speed][4] += 1e-3
    assert not sim._symmetric(sim.control, sim.scale)
    setup.run(sim)
    assert sim.state.kind is LoadType.GENERAL


@pytest.mark.parametrize("law", [RampedCoulomb(friction=0.05, slide_full=1e-3), FourConstants(*CONSTANTS)])
def test_straight_sliding_is_that_of_the_whole_ellipse(law):
    """Against 96 by 16 nodes over the ellipse, slides up to and beyond those by curvature: 2 % of mu Q, 0.1 % with
    four constants.
    """
    shape = np.array([3e-5, 1.8e-4, 3.5e-3, 125.0, 0.0])
    random = np.random.default_rng(51733)
    found, wanted = np.zeros(8), np.zeros(8)
    largest = 0.0
    for slide in random.uniform(-0.3, 0.6, 60):
        straight_friction(unit_gauss(STRAIGHT_NODES), law.kernel_law, shape, 30.0, 6.0, slide, found)
        hertz_friction(ellipse_lines(96, 16), law.kernel_law, shape, 30.0, 6.0, slide, 0.0, 0.0, wanted)
        largest = max(largest, abs(found[0] - wanted[0]) / (0.05 * 30.0))
        assert abs(found[3] - wanted[3]) < 0.02 * 0.05 * 30.0 * shape[3] * (shape[1] * 30.0 ** (1 / 3)) ** 2
        assert found[4] == pytest.approx(wanted[4], rel=0.05, abs=2e-3)
    assert largest < (0.02 if isinstance(law, RampedCoulomb) else 2e-3)


@pytest.mark.parametrize(
    ("force", "solved"), [((100.0, None, None), (1, 3)), ((None, 200.0, 0.0), (1, 21)), ((100.0, 200.0, 0.0), (2, 22))]
)
def test_the_start_is_solved_by_the_balls_that_differ(setup, force, solved):
    """Axial: one ball; radial: ten of 18, one side of the load line; the general solver finds the same."""
    bearing = setup.bearing_7008()
    held = tuple(None if load is not None else 0.0 for load in force)
    operation = Operation(inner_speed=5000.0 * setup.RPM, force=force, displacement=held)
    assert unknowns(bearing, operation) == solved
    few, every = solve_symmetric(bearing, operation), solve_quasistatic(bearing, operation)
    assert few.converged
    assert_allclose(few.inner_load, every.inner_load, atol=1e-9)
    assert_allclose(few.displacement, every.displacement, atol=1e-15)
    assert_allclose(few.orbit_speed, every.orbit_speed, rtol=1e-12)
    turned = replace(bearing, first_ball_azimuth=0.1)  # no two balls are mirror images
    assert unknowns(turned, operation)[1] - unknowns(turned, operation)[0] == (2 if force[1] is None else 36)
    assert_allclose(solve_symmetric(turned, operation).ring_force, every.ring_force, atol=1e-7)


def test_a_load_that_goes_round_is_an_unbalance_at_a_steady_speed(setup):
    """F = m e w^2 at the speed and phase of the ring: the same motion; general equations beside thrust."""
    bearing = setup.bearing_7008(6)
    speed, unbalance = 5000.0 * setup.RPM, 1e-4
    base = setup.model(bearing, end_time=END, sample_interval=1e-4)
    ring = replace(base.ring, unbalance=unbalance, unbalance_phase=0.7)
    load = RotatingLoad(force=unbalance * speed**2, speed=speed, phase=0.7)
    runs = [replace(base, ring=ring), replace(base, rotating=load)]
    thrust = setup.operation(5000.0, 60.0, 0.0)
    made_runs = [simulation(bearing, thrust, model) for model in runs]
    assert [run.state.kind for run in made_runs] == [LoadType.GENERAL] * 2
    # 1. accelerations, with the stiffnesses of one start
    uneven, going_round = (run.data.constants for run in made_runs)
    numbers = {name: getattr(going_round, name) for name in Constants._fields if name.startswith("rotating")}
    data = made_runs[0].data
    both = [data, changed_data(data, constants=uneven._replace(unbalance=0.0, **numbers))]
    layout = made_runs[0].layout
    y = made_runs[0].state.y
    y[layout.mechanical] = speed * 0.003  # angle of the ring
    rates = [np.zeros(layout.size) for _ in both]
    for problem, row in zip(both, rates, strict=True):
        derivative(0.003, y, problem, row)
    assert_allclose(rates[1], rates[0], rtol=1e-9, atol=1e-9)
    # 2. the equations that it leaves
    pushed = load_type(setup.operation(5000.0, 0.0, 60.0), runs[1])
    assert pushed is LoadType.RADIAL  # it stays in the middle plane
    with pytest.raises(ValueError, match="force"):
        RotatingLoad(force=-1.0, speed=speed)


def test_a_run_begins_in_the_equilibrium_of_the_load_that_goes_round(setup):
    """Ring pushed towards its phase."""
    bearing = setup.bearing_7008(6)
    base = setup.model(bearing, end_time=END, sample_interval=1e-4)
    model = replace(base, rotating=RotatingLoad(force=50.0, speed=100.0, phase=pi / 2))
    made_run = simulation(bearing, setup.operation(5000.0, 60.0, 0.0), model)
    _, across, along = made_run.state.y[:3]
    assert along > 1e-6
    assert abs(across) < 0.2 * along
