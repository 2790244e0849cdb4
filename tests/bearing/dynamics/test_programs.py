"""Displacement of the inner ring and viscosity of the oil over time."""

from __future__ import annotations

from dataclasses import replace
from math import radians

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.interpolate import PchipInterpolator

from oilfilm.bearing import Operation
from oilfilm.bearing.dynamics import _motion_kernels
from oilfilm.bearing.dynamics.arrays import OIL_VISCOSITY, PRESCRIBED_DISPLACEMENT, PRESCRIBED_RATE
from oilfilm.bearing.dynamics.bodies import load_type, symmetric_until
from oilfilm.bearing.dynamics.choices import Guidance, LoadType, Start
from oilfilm.bearing.dynamics.friction import race_friction
from oilfilm.bearing.dynamics.inputs import Schedule, prescribed_values
from oilfilm.bearing.dynamics.reduction import derivative
from oilfilm.bearing.dynamics.simulation import simulation
from oilfilm.bearing.friction.friction_sources import CoefficientTraction
from oilfilm.bearing.quasistatic.solver import solve_quasistatic
from oilfilm.ehl.traction.friction_coefficients import FourConstants

RPM = np.pi / 30.0
FREE = (None, None, None)
LAND = {
    "guidance": Guidance.OUTER_RING,
    "land_diameter": 60e-3,
    "land_width": 4e-3,
    "land_clearance": 0.2e-3,
    "land_friction": 0.05,
}


def friction(bearing):
    return race_friction(CoefficientTraction(FourConstants(-0.03, 3.6, 46.0, 0.03)), bearing, (radians(15.0),) * 2)


def held(axes="x", at=(0.0,) * 5, load=0.0, rpm=5000.0):
    """Ring held along or about some of x, y, z, a, b (tilts), a load [N] along the others of x, y."""
    names = "xyzab"
    places = tuple(value if name in axes else None for name, value in zip(names, at, strict=True))
    forces = tuple(None if name in axes else (load if name in "xy" else 0.0) for name in names)
    return Operation(
        inner_speed=rpm * RPM, force=forces[:3], moment=forces[3:], displacement=places[:3], tilt=places[3:]
    )


def moved(operation, times, places, viscosity=None):
    tables = {PRESCRIBED_DISPLACEMENT: [(t, *row) for t, row in zip(times, places, strict=True)]}
    if viscosity is not None:
        tables[OIL_VISCOSITY] = list(zip(times, viscosity, strict=True))
    return Schedule.from_tables(operation, tables)


def wanted_places(time, rows, at):
    """Two rows: 3 s^2 - 2 s^3; more: SciPy's, by a row more before and behind."""
    t = np.array([-1.0, *time, time[-1] + 1.0])
    return PchipInterpolator(t, np.array([rows[0], *rows, rows[-1]]), axis=0)(at)


def test_the_ring_goes_where_it_is_held(setup):
    """Places and speeds of the history are those given, to round-off; the balls follow the equilibrium there."""
    bearing = setup.bearing_7008(6)
    operation = held("xab", (215e-6, 0.0, 0.0, 0.0, 0.0))
    rows = ((215e-6, 0.0, 0.0, 0.0, 0.0), (240e-6, 0.0, 0.0, 0.0, 0.0))
    schedule = moved(operation, (0.0, 0.01), rows)
    model = setup.model(bearing, friction(bearing), schedule=schedule, end_time=0.02, sample_interval=2e-4, drag=0.0)
    made = simulation(bearing, operation, model)
    assert made.state.kind is LoadType.AXIAL  # along the axis alone
    record = setup.run(made)
    assert made.converged
    ring = record.state[:, made.layout.ring]
    s = np.minimum(record.time / 0.01, 1.0)
    assert_allclose(ring[:, 0], 215e-6 + 25e-6 * (3.0 * s**2 - 2.0 * s**3), rtol=1e-12)
    speed = record.state[:, made.layout.ring_speed][:, 0]
    assert_allclose(speed, 2.5e-3 * 6.0 * s * (1.0 - s), rtol=1e-9, atol=1e-15)
    assert setup.balance(made, record) < 1e-3
    there = replace(operation, displacement=(240e-6, None, None))
    wanted = solve_quasistatic(bearing, there)
    found = record.loads[-10:, 0].mean()
    assert found == pytest.approx(-wanted.ring_force[0], rel=2e-3)  # pushed back


@pytest.mark.parametrize("axes", ["xab", "yab", "xa", "xyzab", "a"])
def test_energies_close_while_the_ring_is_moved(setup, axes):
    """What holds the ring does the work that the contacts take, tilts and gyroscopic moments with it."""
    bearing = setup.bearing_7008(7)
    start = np.array([220e-6, 8e-6, -5e-6, 2e-4, -3e-4])
    mask = np.array([name in axes for name in "xyzab"])
    operation = held(axes, tuple(start), load=60.0)
    # nothing follows from speeds alone: forth and back, all coordinates that are held
    steps = np.array([[1.0] * 5, [1.05, 1.8, 0.2, 1.5, 0.4], [0.98, 0.5, 1.4, 0.3, 1.6]])
    places = tuple(tuple(row) for row in (start * steps * mask).tolist())
    model = setup.model(
        bearing,
        friction(bearing),
        schedule=moved(operation, (0.0, 2e-3, 5e-3), places, (1.0, 3.0, 0.5)),
        end_time=8e-3,
        sample_interval=5e-5,
        drag=0.01,
        film_viscosity=0.02,
        ring_options={"unbalance": (1e-6, 0.4), "damping": 50.0},
        gravity=(0.3, -9.81, 0.0),
        tolerance=1e-5,
    )
    made = simulation(bearing, operation, model)
    record = setup.run(made)
    assert made.converged
    for i, name in enumerate("xyzab"):
        if name in axes:
            wanted = wanted_places((0.0, 2e-3, 5e-3), places, record.time)[:, i]
            assert_allclose(record.state[:, made.layout.ring][:, i], wanted, rtol=1e-12, atol=1e-18)
    assert setup.balance(made, record) < 1e-3


def test_symmetry_ends_where_the_displacements_end_it(setup):
    bearing = setup.bearing_7008(6)
    operation = held("xab", load=0.0)
    times = (0.0, 1e-3, 2e-3, 3e-3)

    def model(places):
        return setup.model(bearing, friction(bearing), schedule=moved(operation, times, places), end_time=4e-3)

    along = model(((220e-6, 0, 0, 0, 0), (230e-6, 0, 0, 0, 0), (220e-6, 0, 0, 0, 0), (220e-6, 0, 0, 0, 0)))
    assert load_type(operation, along) is LoadType.AXIAL
    assert symmetric_until(LoadType.AXIAL, operation, along) == np.inf
    tilted = model(((220e-6, 0, 0, 0, 0), (230e-6, 0, 0, 0, 0), (220e-6, 0, 0, 1e-3, 0), (220e-6, 0, 0, 0, 0)))
    assert symmetric_until(LoadType.AXIAL, operation, tilted) == 1e-3
    assert symmetric_until(LoadType.RADIAL, operation, tilted) == 0.0
    made = simulation(bearing, operation, tilted)
    assert made.state.kind is LoadType.AXIAL
    setup.run(made)
    assert made.state.kind is LoadType.GENERAL
    assert any("lost the symmetry of the axial equations" in message for message in made.messages)


def test_a_ring_that_moves_by_load_or_by_general_equations(setup):
    """The same history, until a tilt ends the symmetry and after it."""
    bearing = setup.bearing_7008(6)
    operation = held("xab", load=0.0)
    places = ((220e-6, 0, 0, 0, 0), (230e-6, 0, 0, 0, 0), (220e-6, 0, 0, 5e-4, 0))
    schedule = moved(operation, (0.0, 2e-3, 4e-3), places)
    ends = []
    for kind in (None, LoadType.GENERAL):
        model = setup.model(
            bearing, friction(bearing), schedule=schedule, equations=kind, end_time=6e-3, film_viscosity=0.02
        )
        ends.append(setup.run(simulation(bearing, operation, model)))
    layout = simulation(bearing, operation, model).layout
    speeds = [record.state[:, layout.cage_speed][:, 3] for record in ends]
    assert_allclose(speeds[0], speeds[1], rtol=1e-4)
    assert_allclose(ends[0].loads[:20, 0], ends[1].loads[:20, 0], rtol=1e-3)


def test_a_start_without_an_equilibrium_is_held_too(setup):
    """Balls rolling on the outer race, the ring at its place at once; the angle is that of thrust."""
    bearing = setup.bearing_7008(6)
    operation = held("xab", (220e-6, 0.0, 0.0, 0.0, 0.0))
    model = setup.model(bearing, friction(bearing), start=Start.ROLLING)
    made = simulation(bearing, operation, model)
    assert made.state.y[0] == 220e-6
    assert made.point.angles[0] == pytest.approx(bearing.free_contact_angle)


@pytest.mark.parametrize("guidance", [{}, LAND, LAND | {"guidance": Guidance.INNER_RING, "land_diameter": 48e-3}])
def test_oil_that_thins_is_a_thinner_oil(setup, guidance):
    """All accelerations and powers at a viscosity over time are those with that viscosity throughout."""
    bearing = setup.bearing_7008(5)
    operation = setup.operation(5000.0, 80.0, 30.0)
    given = {"equations": LoadType.GENERAL, "cage_options": guidance}
    schedule = Schedule(time=(0.0, 0.01), values=(prescribed_values(operation),) * 2, viscosity=(2.0, 0.5))
    thinning = simulation(bearing, operation, setup.model(bearing, schedule=schedule, film_viscosity=0.04, **given))
    thin = simulation(bearing, operation, setup.model(bearing, film_viscosity=0.05, **given))
    y = thin.state.y + np.random.default_rng(7321).normal(0.0, 1e-6, thin.state.y.size)
    rates = np.zeros((2, y.size))
    for made, row in zip((thinning, thin), rates, strict=True):
        derivative(0.005, y, made.data, row)  # 1.25 times 0.04
    assert_allclose(rates[0], rates[1], rtol=1e-12, atol=1e-12 * np.abs(rates).max())


def test_tables_at_other_times_leave_the_path_of_the_ring(setup):
    """Rows of a load between those of the displacements: the same path and speeds, by the compiled schedule."""
    operation = held("xab")
    times, places = (
        (0.0, 2e-3, 5e-3, 9e-3),
        [(0.0, 0, 0, 0, 0), (3e-5, 0, 0, 1e-3, 0), (2e-5,) + (0.0,) * 4, (4e-5,) + (0.0,) * 4],
    )
    tables = {PRESCRIBED_DISPLACEMENT: [(t, *row) for t, row in zip(times, places, strict=True)]}
    tables[3] = [(0.0, 0.0), (1e-3, 5.0), (7e-3, 9.0), (0.02, 1.0)]
    schedule = Schedule.from_tables(operation, tables)
    bearing = setup.bearing_7008(5)
    data = simulation(bearing, operation, setup.model(bearing, schedule=schedule)).data
    step = 1e-7
    for t in np.random.default_rng(515).uniform(0.0, 0.012, 50):
        _motion_kernels.schedule_at(data.times, data.schedule, t, data.prescribed)
        assert_allclose(
            data.prescribed[PRESCRIBED_DISPLACEMENT:PRESCRIBED_RATE],
            wanted_places(times, places, min(t, 9e-3)),
            atol=1e-18,
        )
        before, after = (wanted_places(times, places, min(t + s, 9e-3)) for s in (-step, step))
        assert_allclose(
            data.prescribed[PRESCRIBED_RATE:OIL_VISCOSITY], (after - before) / (2.0 * step), rtol=1e-3, atol=1e-6
        )


def test_a_schedule_checks_what_it_is_given():
    row = (0.0,) * 7
    with pytest.raises(ValueError, match="five places"):
        Schedule(time=(0.0,), values=(row,), places=((0.0,) * 4,))
    with pytest.raises(ValueError, match="positive viscosity"):
        Schedule(time=(0.0,), values=(row,), viscosity=(0.0,))
    with pytest.raises(ValueError, match="positive viscosity"):
        Schedule(time=(0.0, 1.0), values=(row, row), viscosity=(1.0,))
