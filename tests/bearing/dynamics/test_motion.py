"""Free flight, impacts, momentum, energy, order of convergence, equality of reduced and general equations."""

from __future__ import annotations

from dataclasses import replace
from math import radians

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing.dynamics._integration_kernels import TOO_SMALL
from oilfilm.bearing.dynamics.assembly import damping_factor
from oilfilm.bearing.dynamics.choices import Guidance, LoadType, NormalLaw, Start
from oilfilm.bearing.dynamics.friction import race_friction
from oilfilm.bearing.dynamics.inputs import NormalContact, Schedule
from oilfilm.bearing.dynamics.record import empty_record
from oilfilm.bearing.dynamics.simulation import advance_implicit, from_state, simulation
from oilfilm.bearing.dynamics.statistics import INPUTS
from oilfilm.bearing.friction.friction_sources import CoefficientTraction
from oilfilm.ehl.traction.friction_coefficients import FourConstants, RampedCoulomb

from ...reference.impact import restitution_returned

CONSTANTS = (-0.03, 3.644876513237464, 45.9363161820606, 0.03)  # of 0.05, 0.03, 0.03


def flight(setup, law=NormalLaw.LANKARANI_NIKRAVESH, y_change=None, **options):
    """A bearing at rest whose balls a test sets going."""
    bearing = setup.bearing_7008(3)
    normal = NormalContact(law=law, impact_floor=1e-3)
    model = setup.model(bearing, normal=normal, cage=options.pop("cage", False), start=Start.REST, **options)
    sim = simulation(bearing, setup.operation(0.0, 0.0, 0.0), replace(model, options=replace(model.options)))
    y_change(sim.state.y, sim.layout)
    return from_state(sim.bearing, sim.operation, model, (sim.point, sim.data, sim.state.y))


def by_lsoda(sim):
    """Record of a simulation that LSODA alone moves to its end."""
    return advance_implicit(sim.state, sim.motion, sim.sample_times(), sim.control, sim.scale)[1]


def test_a_free_ball_goes_straight_and_keeps_its_spin(setup):
    """No centrifugal force in an inertial frame: a straight line, to round-off, and a constant angular velocity."""
    start, velocity, turn = np.array([0.0, 27e-3, 0.0]), np.array([0.01, 0.1, 0.5]), np.array([900.0, 0.0, 0.0])

    def change(y, layout):
        y[layout.ball] = np.array([start, [0, -13.5e-3, 23e-3], [0, -13.5e-3, -23e-3]]).ravel()
        y[layout.ball_speed][:3] = velocity
        y[layout.ball_turn][:3] = turn

    sim = flight(setup, y_change=change, equations=LoadType.GENERAL, end_time=4e-5, sample_interval=1e-5)
    record = setup.run(sim)
    line = start + record.time[:, None] * velocity
    assert record.races[:, :, 0, 1].max() < 0.0  # touches neither race
    assert_allclose(record.state[:, sim.layout.ball][:, :3], line, rtol=0.0, atol=1e-16)
    assert_allclose(record.state[:, sim.layout.ball_turn][:, :3], np.tile(turn, (4, 1)), rtol=0.0, atol=0.0)
    turned = 2.0 * np.arctan2(record.attitude[:, 0, 1], record.attitude[:, 0, 0])
    assert_allclose(turned, 900.0 * record.time, rtol=1e-12)


@pytest.mark.parametrize("law", [NormalLaw.LANKARANI_NIKRAVESH, NormalLaw.HUNT_CROSSLEY, NormalLaw.FLORES])
def test_a_single_impact_returns_what_the_law_says(setup, law):
    """e = 0.9 against the outer race: 0.913 with Lankarani and Nikravesh; the closed form of each law to 1e-3."""

    def change(y, layout):
        y[layout.ball][1] -= 5e-6
        y[layout.ball_speed][1] = 0.5

    sim = flight(setup, law, change, equations=LoadType.GENERAL, end_time=2e-4, sample_interval=1e-6)
    record = setup.run(sim)
    speed = record.state[:, sim.layout.ball_speed][:, 1]
    flying = record.races[:, 1, 0, 1] < 0.0
    after = speed[flying & (speed < 0.0)]
    assert_allclose(-after[0] / 0.5, restitution_returned(damping_factor(law, 0.9)), rtol=1e-3)
    if law is NormalLaw.LANKARANI_NIKRAVESH:
        assert_allclose(-after[0] / 0.5, 0.913, atol=1e-3)
    assert record.contact_state[:, 1, 0].max() == 2  # seen as an impact
    assert setup.balance(sim, record) < 1e-3


def test_momentum_and_angular_momentum_of_ball_and_cage(setup):
    """A ball thrown into its pocket, with friction: what it loses the cage gains, no race near."""

    def change(y, layout):
        y[layout.ball] *= 0.9985  # in the gap between the races
        y[layout.ball_speed][:3] = [0.4, 0.0, 1.1]
        y[layout.ball_turn][:3] = [500.0, -300.0, 200.0]

    options = {"equations": LoadType.GENERAL, "end_time": 4e-4, "sample_interval": 1e-5, "cage": True}
    sim = flight(setup, y_change=change, **options)
    c, layout = sim.data.constants, sim.layout
    sim.data.normal[:2, 0] = 1e-30  # no races

    def momenta(y):
        x, v, w = (y[part].reshape(-1, 3) for part in (layout.ball, layout.ball_speed, layout.ball_turn))
        linear = c.ball_mass * v.sum(axis=0) + c.cage_mass * y[layout.cage_speed][:3]
        about_x = (c.ball_mass * np.cross(x, v) + c.ball_inertia * w)[:, 0].sum()
        cage = c.cage_mass * np.cross(y[layout.cage][:3], y[layout.cage_speed][:3])[0]
        return np.array([*linear, about_x + cage + c.cage_polar * y[layout.cage_speed][3]])

    before = momenta(sim.state.y)
    record = setup.run(sim)
    after = momenta(record.state[-1])
    assert record.pockets[:, 0, 0].max() > 1.0  # there was an impact
    assert_allclose(after[:3], before[:3], atol=1e-9 * np.abs(before[:3]).max())
    assert_allclose(after[3], before[3], rtol=1e-4)  # the cage's tilt counts to first order


@pytest.mark.parametrize(
    ("kind", "axial", "radial"),
    [(LoadType.RADIAL, 0.0, 80.0), (LoadType.COMBINED, 60.0, 80.0), (LoadType.GENERAL, 60.0, 80.0)],
)
@pytest.mark.parametrize("guidance", [Guidance.BALLS, Guidance.INNER_RING, Guidance.OUTER_RING])
def test_the_energies_close(setup, kind, axial, radial, guidance):
    """What is put in is stored or lost by a named mechanism, to 0.1 % of the work."""
    bearing = setup.bearing_7008(7)
    friction = race_friction(
        CoefficientTraction(RampedCoulomb(friction=0.06, slide_none=0.0, slide_full=0.05)),
        bearing,
        (radians(15.0),) * 2,
    )
    land = {"land_diameter": 50e-3, "land_width": 4e-3, "land_clearance": 0.1e-3, "land_friction": 0.08}
    model = setup.model(
        bearing,
        friction,
        cage_options={"guidance": guidance} | ({} if guidance is Guidance.BALLS else land),
        ring_options={"damping": 20.0, "unbalance": (1e-6, 0.3)},
        equations=kind,
        gravity=(0.0, 9.81, 0.0),
        drag=0.01,
        film_viscosity=0.02,
        end_time=4e-3,
        sample_interval=2e-4,
    )
    sim = simulation(bearing, setup.operation(5000.0, axial, radial), model)
    record = setup.run(sim)
    assert sim.converged
    assert setup.balance(sim, record) < 1e-3
    lost = record.state[-1, sim.layout.energy][INPUTS:]
    assert np.all(lost >= -1e-3 * lost.max())


def test_order_of_convergence(setup):
    """Steps of fixed length in a lasting contact: the error falls with the fifth power at least."""
    bearing = setup.bearing_7008(3)
    ends = []
    for step in (2e-6, 1e-6, 5e-7, 6.25e-8):
        model = setup.model(
            bearing, normal=NormalContact(law=NormalLaw.HERTZ), tolerance=1e3, longest_step=step, cage=False,
            end_time=1e-4, sample_interval=1e-4,
        )  # fmt: skip
        sim = simulation(bearing, setup.operation(5000.0, 60.0, 0.0), model)
        sim.state.y[sim.layout.ring_speed][0] = 0.02
        sim.state.step = step
        ends.append(setup.run(sim).state[-1, sim.layout.ball])
    errors = [np.abs(end - ends[-1]).max() for end in ends[:-1]]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert np.all(orders > 4.7), (errors, orders)


@pytest.mark.parametrize(
    ("reduced", "full", "axial", "radial"),
    [(LoadType.AXIAL, LoadType.GENERAL, 60.0, 0.0), (LoadType.RADIAL, LoadType.COMBINED, 0.0, 90.0)],
)
def test_reduced_equations_equal_the_general_ones(setup, reduced, full, axial, radial):
    """Where symmetry keeps the other coordinates at rest, they make no difference, to the tolerance of the steps; the
    two quadratures of friction under a radial load differ by 0.96 nm of 13 mm."""
    bearing = setup.bearing_7008(6)
    angle = radians(15.0) if axial else 0.0
    friction = race_friction(CoefficientTraction(FourConstants(*CONSTANTS)), bearing, (angle, angle))
    ends = []
    for kind in (reduced, full):
        model = setup.model(bearing, friction, equations=kind, end_time=1e-3, drag=0.005, tolerance=1e-6)
        sim = simulation(bearing, setup.operation(5000.0, axial, radial), model)
        record = setup.run(sim)
        ends.append(record)
    layout = sim.layout
    assert_allclose(ends[0].state[-1, layout.ball], ends[1].state[-1, layout.ball], atol=1e-9)
    assert_allclose(ends[0].races[-1, :, :, 0], ends[1].races[-1, :, :, 0], rtol=2e-3, atol=2e-3)
    speed = layout.cage_speed.start + 3
    assert_allclose(ends[0].state[-1, speed], ends[1].state[-1, speed], rtol=1e-6)


def test_a_stiff_problem_goes_to_lsoda(setup):
    """Friction that turns within 0.3 mm/s: the explicit steps are given up, LSODA reaches the end, and says so."""
    bearing = setup.bearing_7008(3)
    friction = race_friction(
        CoefficientTraction(RampedCoulomb(friction=0.1, slide_none=0.0, slide_full=3e-4)),
        bearing,
        (radians(15.0),) * 2,
        at_centre=True,
    )
    model = setup.model(bearing, friction, cage=False, end_time=1e-4, sample_interval=5e-5)
    sim = simulation(bearing, setup.operation(5000.0, 100.0), model)
    record = setup.run(sim)
    assert sim.state.stiff
    assert any("LSODA" in message for message in sim.messages)
    assert record.time.size == 2
    assert setup.balance(sim, record) < 5e-3


def test_explicit_steps_return_when_a_stiff_start_is_over(setup, monkeypatch):
    """From rest the four-constant law turns within no sliding speed at all; at speed it does not: as with LSODA on."""
    monkeypatch.setattr("oilfilm.bearing.dynamics.simulation.PIECE", 128)
    monkeypatch.setattr("oilfilm.bearing.dynamics.simulation.STRETCH", 128)
    bearing, axial = setup.bearing_7008(3), 60.0
    friction = race_friction(
        CoefficientTraction(FourConstants(*CONSTANTS)), bearing, (radians(15.0),) * 2, at_centre=True
    )
    rows = tuple((rpm * setup.RPM, 0.0, axial, 0.0, 0.0, 0.0, 0.0) for rpm in (0.0, 5000.0))
    schedule, ends = Schedule(time=(0.0, 1e-3), values=rows), []
    for stay in (False, True):
        model = setup.model(
            bearing, friction, cage=False, start=Start.REST, schedule=schedule, end_time=1.6e-3, sample_interval=1e-5
        )
        sim = simulation(bearing, setup.operation(5000.0, axial), model)
        pieces = sim.pieces()
        next(pieces)
        record = by_lsoda(sim) if stay else next(pieces)
        assert record.time[-1] == pytest.approx(1.6e-3)
        assert setup.balance(sim, record) < 1e-3
        assert any("LSODA took over" in message for message in sim.messages)
        assert any("explicit steps again from t = 0.00128 s" in message for message in sim.messages) != stay
        ends.append(record.state[-1])
    for part in (sim.layout.ball_speed, sim.layout.ball_turn):
        assert_allclose(ends[0][part], ends[1][part], atol=1e-3 * np.abs(ends[1][part]).max())


@pytest.mark.slow
def test_stiff_friction_over_the_ellipse_needs_no_lsoda(setup):
    """From rest, friction implicit in the motion of each ball: explicit steps alone end as LSODA does."""
    bearing, axial = setup.bearing_7008(3), 60.0
    friction = race_friction(CoefficientTraction(FourConstants(*CONSTANTS)), bearing, (radians(15.0),) * 2)
    rows = tuple((rpm * setup.RPM, 0.0, axial, 0.0, 0.0, 0.0, 0.0) for rpm in (0.0, 5000.0))
    schedule, ends = Schedule(time=(0.0, 1e-3), values=rows), []
    for implicit in (False, True):
        model = setup.model(
            bearing, friction, cage=False, start=Start.REST, schedule=schedule, end_time=1.2e-3, sample_interval=1e-5
        )
        sim = simulation(bearing, setup.operation(5000.0, axial), model)
        record = by_lsoda(sim) if implicit else setup.run(sim)
        assert not sim.state.stiff
        assert setup.balance(sim, record) < 1e-3
        ends.append((record.state[-1], int(sim.state.counters[0])))
    for part in (sim.layout.ball_speed, sim.layout.ball_turn):
        assert_allclose(ends[0][0][part], ends[1][0][part], atol=1e-3 * np.abs(ends[1][0][part]).max())
    assert ends[0][1] < 0.5 * ends[1][1]  # LSODA takes 1643 with the Jacobian


@pytest.mark.parametrize("failure", [1, 3])
def test_lsoda_goes_on_where_a_trial_of_explicit_steps_fails(setup, monkeypatch, failure):
    """The state is put back, and LSODA does the piece as if there had been no trial; without LSODA the run ends."""

    def fail(state, motion, times, control, scale):
        state.y[:] = np.nan
        state.time = times[1]
        return failure, empty_record(times[:1], 3)

    bearing, ends = setup.bearing_7008(3), []
    friction = race_friction(CoefficientTraction(FourConstants(*CONSTANTS)), bearing, (radians(15.0),) * 2)
    model = setup.model(bearing, friction, cage=False, end_time=1e-4, sample_interval=2e-5)
    monkeypatch.setattr("oilfilm.bearing.dynamics.simulation.advance_explicit", fail)
    for trial in (True, False):
        sim = simulation(bearing, setup.operation(5000.0, 60.0), model)
        sim.state.stiff = True
        record = setup.run(sim) if trial else by_lsoda(sim)
        assert sim.converged
        assert_allclose(record.time, np.arange(1, 6) * 2e-5)
        ends.append(record.state[-1])
    np.testing.assert_array_equal(*ends)
    sim = simulation(bearing, setup.operation(5000.0, 60.0), model)
    assert next(sim.pieces()).time.size == 1
    assert not sim.converged


@pytest.mark.parametrize(("guidance", "named"), [(Guidance.BALLS, False), (Guidance.INNER_RING, True)])
def test_the_film_of_a_land_is_named_where_steps_do_not_lead_on(setup, monkeypatch, guidance, named):
    def fail(state, motion, times, control, scale):
        return TOO_SMALL, empty_record(times[:0], 3)

    monkeypatch.setattr("oilfilm.bearing.dynamics.simulation.advance_explicit", fail)
    land = {"land_diameter": 50e-3, "land_width": 4e-3, "land_clearance": 0.1e-3} if named else {}
    model = setup.model(setup.bearing_7008(3), film_viscosity=0.3, cage_options={"guidance": guidance} | land)
    sim = simulation(setup.bearing_7008(3), setup.operation(5000.0, 60.0), model)
    assert list(sim.pieces()) == []
    assert not sim.converged
    assert ("cage's land" in sim.messages[-1]) is named


def test_lsoda_agrees_with_the_explicit_method(setup):
    bearing = setup.bearing_7008(3)
    friction = race_friction(CoefficientTraction(FourConstants(*CONSTANTS)), bearing, (radians(15.0),) * 2)
    ends = []
    for stiff in (False, True):
        model = setup.model(bearing, friction, end_time=3e-4, sample_interval=1e-4, tolerance=1e-6)
        sim = simulation(bearing, setup.operation(5000.0, 60.0), model)
        ends.append(by_lsoda(sim) if stiff else setup.run(sim))
    assert_allclose(ends[1].state[-1, sim.layout.ball], ends[0].state[-1, sim.layout.ball], atol=2e-10)
    assert_allclose(ends[1].races[-1, :, :, 0], ends[0].races[-1, :, :, 0], rtol=1e-3)
