"""Lubricated contacts: load, stiffness and work of films that part balls and races, from made-up traction tables."""

from __future__ import annotations

from math import radians

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing import Race
from oilfilm.bearing.dynamics import _race_kernels as film_kernels
from oilfilm.bearing.dynamics.arrays import NORMAL_COLUMNS
from oilfilm.bearing.dynamics.choices import LoadType, NormalLaw
from oilfilm.bearing.dynamics.friction import RaceFriction, check_film
from oilfilm.bearing.dynamics.inputs import NormalContact, Schedule
from oilfilm.bearing.dynamics.reduction import derivative
from oilfilm.bearing.dynamics.simulation import advance_implicit, simulation
from oilfilm.bearing.dynamics.statistics import INPUTS, RunningStatistics, simulation_statistics
from oilfilm.bearing.geometry import contact_modulus, reduced_radii
from oilfilm.ehl import Lubricant, SolverOptions, solve_contact
from oilfilm.ehl.closed_form.hertz import contact_stiffness
from oilfilm.ehl.conditions import ContactConditions
from oilfilm.ehl.oil.rheology import Rheology
from oilfilm.ehl.traction import normal_response
from oilfilm.ehl.traction._kernels import LOAD_POWER
from oilfilm.ehl.traction_table.splines import spline_coefficients
from oilfilm.ehl.traction_table.table import TableContact, TableError, TableRange, TractionTable

from ...reference.dynamics import accelerations, elastic_approach, film

OIL = Lubricant(viscosity=0.02, pressure_viscosity=18e-9)
LOADS, SPEEDS = (2.0, 800.0), (0.5, 20.0)
NODES = (20, 5, 9, 5, 9)
LUBRICATED = NormalContact(law=NormalLaw.LUBRICATED)
NO_ERROR = TableError(
    largest=0.0, quantile=0.0, rms=0.0, largest_spin=0.0, largest_rolling=0.0, films=0, motions=0, tolerance=0.0
)


def film_law(load, speed):
    """A film like a solved one: light contacts rigid, h ~ 1/Q, heavy ones elastic, h ~ Q^-0.07 [m]."""
    return 0.3e-6 * speed**0.67 / 5.0**0.67 * (load**-0.07 + 8.0 / load)


def made_up_table(bearing, race, grip=0.05, damping=80.0, thickness=film_law):
    """A table whose film follows a law and whose forces are linear in the scaled motions."""
    radii, modulus = reduced_radii(bearing, race, radians(15.0)), contact_modulus(bearing, race)
    contact = TableContact(
        radius_x=radii[0], radius_y=radii[1], reduced_modulus=modulus, lubricant=OIL, rheology=Rheology(),
        temperature=313.15,
    )  # fmt: skip
    starts = (-(LOADS[0] ** LOAD_POWER), np.log(SPEEDS[0]), -1.0, 0.0, -1.0)
    ends = (-(LOADS[1] ** LOAD_POWER), np.log(SPEEDS[1]), 1.0, 1.0, 1.0)
    axes = np.array([[start, (n - 1) / (end - start), n] for start, end, n in zip(starts, ends, NODES, strict=True)])
    load, speed = np.meshgrid(
        (-np.linspace(starts[0], ends[0], NODES[0])) ** (1.0 / LOAD_POWER),
        np.exp(np.linspace(starts[1], ends[1], NODES[1])),
        indexing="ij",
    )
    ones = np.ones_like(load)
    logarithms = (0.01 * ones, 0.02 * ones, 0.3 * ones, thickness(load, speed), 1e-9 * load, 5e7 * ones,
                  damping * ones, grip * load, 1e-5 * load, 1e-7 * load)  # fmt: skip
    scalars = spline_coefficients(np.log(np.stack(logarithms, axis=-1)), (0, 1))
    motions = np.meshgrid(*(np.linspace(a, b, n) for a, b, n in zip(starts[2:], ends[2:], NODES[2:], strict=True)),
                          indexing="ij")  # fmt: skip
    sums = np.stack([*(-part for part in motions), 0.0 * motions[0]], axis=-1)
    values = np.broadcast_to(sums, (*NODES[:2], *sums.shape))
    return TractionTable(
        contact=contact, range=TableRange(load=LOADS, speed=SPEEDS), points=65, axes=axes, scalars=scalars,
        values=spline_coefficients(values, (0, 1, 2, 3, 4)), kappa_max=grip, error=NO_ERROR, films=0, converged=True,
        message="made up",
    )  # fmt: skip


def lubricated(setup, bearing, tables=None, **options):
    """A model with lubricated races and its tables."""
    tables = tables or [made_up_table(bearing, race) for race in Race]
    friction = RaceFriction(inner=tables[0], outer=tables[1])
    return setup.model(bearing, friction, normal=LUBRICATED, **options), tables


@pytest.fixture(scope="module")
def dry(setup):
    """Friction data of the inner race of a 7008 and its law of contact."""
    bearing = setup.bearing_7008(3)
    data = RaceFriction(inner=made_up_table(bearing, Race.INNER), outer=made_up_table(bearing, Race.OUTER))
    radii = reduced_radii(bearing, Race.INNER, radians(15.0))
    law = np.zeros(NORMAL_COLUMNS)
    law[:2] = contact_stiffness(*radii, contact_modulus(bearing, Race.INNER)), 1.5
    return data.data(Race.INNER).table, law


def kernel(dry, distance, speed):
    data, law = dry
    return film_kernels.elastic_approach(data.axes, data.scalars, law, distance, speed)


def load_of(dry, distance, speed):
    return dry[1][0] * max(kernel(dry, distance, speed), 0.0) ** 1.5


def test_the_film_of_the_table_is_its_law(dry):
    for load, speed in ((3.0, 0.6), (40.0, 4.0), (700.0, 19.0)):
        assert_allclose(film(dry[0], load, speed), film_law(load, speed), rtol=2e-3)


def test_approach_agrees_with_its_twin(dry):
    """Newton's steps against bracketing, within the table and beyond all its ends."""
    random = np.random.default_rng(660213)
    distances, speeds = random.uniform(-3e-6, 2e-5, 300), np.exp(random.uniform(np.log(0.05), np.log(50.0), 300))
    found = [kernel(dry, d, u) for d, u in zip(distances, speeds, strict=True)]
    twin = [elastic_approach(*dry, d, u) for d, u in zip(distances, speeds, strict=True)]
    assert_allclose(found, twin, rtol=1e-7, atol=1e-12)  # the slope at the smallest load is a difference there
    assert min(found) < 0.0 < max(found)


@pytest.mark.parametrize("speed", [0.7, 5.0, 18.0])
def test_distance_is_the_elastic_approach_less_the_film(dry, speed):
    for load in (2.5, 30.0, 400.0):
        w = (load / dry[1][0]) ** (2.0 / 3.0)
        assert_allclose(kernel(dry, w - film(dry[0], load, speed), speed), w, rtol=1e-9)


def test_without_speed_the_contact_is_dry(dry):
    assert kernel(dry, 3e-6, 0.0) == pytest.approx(3e-6, rel=1e-12)
    assert kernel(dry, -1e-8, 0.0) <= 0.0


@pytest.mark.parametrize("speed", [0.1, 5.0, 40.0])
def test_load_and_stiffness_are_continuous(dry, speed):
    """From the first touch of the film, through both ends of the table; the film carries before the bodies meet."""
    distances = np.linspace(-1.5e-5, 3e-5, 40001)
    loads = np.array([load_of(dry, d, speed) for d in distances])
    slopes = np.diff(loads) / np.diff(distances)
    assert loads[0] == 0.0
    assert loads[np.searchsorted(distances, 0.0) - 1] > 0.0
    assert loads[-1] > 2.0 * LOADS[1]
    assert np.all(slopes >= 0.0)
    assert np.abs(np.diff(slopes)).max() < 0.02 * slopes.max()  # the film's own slope ends at the largest load


def test_stiffness_is_that_of_film_and_bodies_in_series(dry):
    for load, speed in ((3.0, 5.0), (60.0, 10.0), (500.0, 1.0)):
        step = 1e-4 * load
        (low, high) = ((q / dry[1][0]) ** (2.0 / 3.0) - film(dry[0], q, speed) for q in (load - step, load + step))
        change = load_of(dry, high, speed) - load_of(dry, low, speed)
        assert_allclose(change, 2.0 * step, rtol=1e-4)


def test_series_holds_for_solved_films():
    """Hertz' approach less the central film gives the stiffness that the film itself answers with, to 1 %."""
    radii, modulus = (2.9e-3, 28.5e-3), 2.26e11
    oil = Lubricant(viscosity=0.02, pressure_viscosity=18e-9)

    def contact(load):
        return ContactConditions(load=load, radius_x=radii[0], radius_y=radii[1], reduced_modulus=modulus,
                                 entrainment_speed=7.0, lubricant=oil)  # fmt: skip

    load, share = 150.0, 0.1
    mesh = SolverOptions(points=129)
    films = [solve_contact(contact(load * (1.0 + part)), mesh).film_central for part in (-share, share)]
    stiffness = contact_stiffness(*radii, modulus)
    bodies = np.diff([(load * (1.0 + part) / stiffness) ** (2.0 / 3.0) for part in (-share, share)])[0]
    series = 2.0 * share * load / (bodies - (films[1] - films[0]))
    answer = normal_response(contact(load), mesh)
    assert answer.converged
    assert_allclose(series, answer.stiffness.value, rtol=0.01)
    assert series < 2.0 * share * load / bodies  # softer than Hertz


def test_kernel_agrees_with_its_twin(setup):
    """Accelerations under films, light and heavy contacts and open ones, all within the tables."""
    bearing = setup.bearing_7008(7)
    model, tables = lubricated(setup, bearing, equations=LoadType.GENERAL, gravity=(0.5, -9.81, 1.0), drag=0.01)
    operation = setup.operation(5000.0, 300.0, 60.0, moment=(0.01, -0.02), tilt=(None, None))
    sim = simulation(bearing, operation, model)
    random, p, layout = np.random.default_rng(271829), sim.data, sim.layout
    dy, lightest, open_ones = np.zeros(layout.size), np.inf, 0
    for _ in range(20):
        y = sim.state.y.copy()
        y[layout.ring] += random.normal(0.0, 1.0, 5) * [2e-6, 2e-6, 2e-6, 1e-4, 1e-4]
        y[layout.ball] += random.normal(0.0, 2e-6, 3 * 7)
        y[layout.ball_speed] += random.normal(0.0, 0.2, 3 * 7)
        y[layout.ball_turn] += random.normal(0.0, 30.0, 3 * 7)
        derivative(0.0, y, p, dy)
        loads = p.race_out[:, :, 0]
        twin = accelerations(p, y, np.array([operation.inner_speed, 0.0, 300.0, 60.0, 0.0, 0.01, -0.02]), tuple(tables))
        elastic = p.normal[:2, :1] * np.maximum(p.race_out[:, :, 1], 0.0) ** 1.5
        if np.any((elastic > 0.0) & ((elastic < LOADS[0]) | (elastic > LOADS[1]))):
            continue
        got = dy[layout.positions : layout.mechanical]
        assert_allclose(got, twin, rtol=1e-7, atol=1e-7 * np.abs(twin).max())
        lightest, open_ones = min(lightest, loads[loads > 0.0].min()), open_ones + np.sum(elastic == 0.0)
    assert lightest < 30.0


def test_films_lift_the_ring(setup):
    """Counter-rotating rings, balls in place: the ring stands where the films and Hertz' approaches put it."""
    bearing = setup.bearing_7008(3)
    gamma = bearing.ball_diameter / bearing.pitch_diameter * np.cos(radians(16.0))
    inner = 5000.0 * setup.RPM
    operation = setup.operation(5000.0, 60.0, outer_speed=-inner * (1.0 - gamma) / (1.0 + gamma))
    places = {}
    for law in (NormalLaw.HERTZ, NormalLaw.LUBRICATED):
        tables = [made_up_table(bearing, race, grip=1e-9, damping=300.0) for race in Race]
        friction = RaceFriction(inner=tables[0], outer=tables[1])
        model = setup.model(
            bearing, friction, cage=False, normal=NormalContact(law=law), ring_options={"damping": 3e3}, end_time=0.02,
            sample_interval=1e-3,
        )  # fmt: skip
        sim = simulation(bearing, operation, model)
        record = setup.run(sim)
        places[law] = (record.state[-1, 0], record.races[-1, :, 0], sim.data.normal[:2, 0])
    axial, races, stiffness = places[NormalLaw.LUBRICATED]
    loads, films = races[:, 0], races[:, 10]
    assert_allclose(loads * np.sin(races[:, 3]), 20.0, rtol=1e-3)  # at rest
    assert_allclose(films, [film_law(q, u) for q, u in zip(loads, races[:, 4], strict=True)], rtol=2e-3)
    reach = bearing.inner_groove_radius + bearing.outer_groove_radius - bearing.ball_diameter
    free = bearing.free_contact_angle
    stretched = reach + np.sum((loads / stiffness) ** (2.0 / 3.0) - films)
    assert_allclose(axial, np.sqrt(stretched**2 - (reach * np.cos(free)) ** 2), atol=2e-9)
    lift = places[NormalLaw.HERTZ][0] - axial
    assert_allclose(lift, films.sum() / np.sin(races[0, 3]), rtol=0.1)  # to first order


def test_the_energies_close_with_films(setup):
    """A rising speed that lifts the balls, some of which lose contact: to 0.1 % of the work, only with the films'."""
    bearing = setup.bearing_7008(7)
    rows = tuple((rpm * setup.RPM, 0.0, 40.0, 120.0, 0.0, 0.0, 0.0) for rpm in (1000.0, 15000.0))
    model, _ = lubricated(
        setup, bearing, schedule=Schedule(time=(0.0, 4e-3), values=rows), end_time=5e-3, sample_interval=2e-4, drag=0.01
    )
    sim = simulation(bearing, setup.operation(1000.0, 40.0, 120.0), model)
    record = setup.run(sim)
    assert sim.converged
    closed = setup.balance(sim, record)
    assert closed < 1e-3
    work = record.state[-1, sim.layout.energy]
    assert abs(work[-1]) > 3.0 * closed * max(work[:INPUTS].sum(), work[INPUTS:].sum())  # they count
    running = RunningStatistics(7)
    running.add(record, sim.start_energy)
    found = simulation_statistics(sim, running)
    assert found.energy_error == pytest.approx(running.residual / max(work[:INPUTS].sum(), work[INPUTS:-1].sum()))
    assert found.stored == pytest.approx(record.energy[-1].sum() - sim.start_energy, abs=1.001 * running.residual)
    assert record.races[:, 0, :, 0].min() == 0.0
    assert record.races[..., 0].min() >= 0.0
    apart, films = record.races[..., 1] <= 0.0, record.races[..., 10]
    assert apart.any()
    assert not films[apart].any()  # no film of an open contact
    assert films[~apart].min() > 0.0


@pytest.mark.slow
def test_lsoda_counts_the_work_of_films(setup):
    bearing = setup.bearing_7008(3)
    ends = []
    for stiff in (False, True):
        model, _ = lubricated(setup, bearing, end_time=3e-4, sample_interval=1e-4, tolerance=1e-6)
        sim = simulation(bearing, setup.operation(5000.0, 60.0), model)
        method = (sim.state, sim.motion, sim.sample_times(), sim.control, sim.scale)
        record = advance_implicit(*method)[1] if stiff else setup.run(sim)
        assert setup.balance(sim, record) < 1e-3
        ends.append(record)
    layout = sim.layout
    assert_allclose(ends[1].state[-1, layout.ball], ends[0].state[-1, layout.ball], atol=1e-9)
    assert_allclose(ends[1].state[-1, layout.size - 1], ends[0].state[-1, layout.size - 1], rtol=0.02)


def test_what_cannot_be_lubricated_is_refused(setup, dry):
    bearing = setup.bearing_7008(3)
    with pytest.raises(ValueError, match="needs traction tables"):
        simulation(bearing, setup.operation(5000.0, 60.0), setup.model(bearing, normal=LUBRICATED))
    steep = made_up_table(bearing, Race.INNER, thickness=lambda load, speed: 1e-7 * load * speed**0.67)
    data = RaceFriction(inner=steep, outer=steep).data(Race.INNER).table
    with pytest.raises(ValueError, match="inner race's table rises"):
        check_film(data, dry[1], "inner")
    check_film(*dry, "inner")
