"""The compiled equations of motion against their NumPy twin at random states."""

from __future__ import annotations

from math import radians

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing import Race
from oilfilm.bearing.dynamics import _motion_kernels
from oilfilm.bearing.dynamics._integration_kernels import duration, jacobian
from oilfilm.bearing.dynamics._state_kernels import ring_angle
from oilfilm.bearing.dynamics.arrays import NORMAL_COLUMNS
from oilfilm.bearing.dynamics.choices import Guidance, LoadType
from oilfilm.bearing.dynamics.friction import race_friction
from oilfilm.bearing.dynamics.inputs import Schedule
from oilfilm.bearing.dynamics.reduction import derivative, solved_motion
from oilfilm.bearing.dynamics.simulation import simulation
from oilfilm.bearing.friction.friction_sources import CoefficientTraction, LawTraction
from oilfilm.ehl.traction._kernels import hertz_friction
from oilfilm.ehl.traction.friction_coefficients import FourConstants, RampedCoulomb
from oilfilm.ehl.traction.shear import ellipse_rings

from ...reference.dynamics import accelerations

LAND = {"land_diameter": 50e-3, "land_width": 4e-3, "land_clearance": 0.1e-3, "land_friction": 0.08}
# a cage out of balance, dragged by the oil, with pockets of their own
UNEVEN = {"unbalance": 3e-6, "drag": 2e-8, "pocket_clearances": tuple(1e-4 * (2.0 + 0.1 * k) for k in range(7))}


def shaken(sim, random):
    """The starting state with every coordinate moved by the size of its play, every speed by some of it."""
    layout, y = sim.layout, sim.state.y.copy()
    y[layout.ring] += random.normal(0.0, 1.0, 5) * [4e-6, 4e-6, 4e-6, 2e-4, 2e-4]
    y[layout.cage] += random.normal(0.0, 1.0, 6) * [5e-5, 8e-5, 8e-5, 3e-3, 1e-3, 1e-3]
    y[layout.ball] += random.normal(0.0, 3e-6, 3 * layout.balls)
    y[layout.ring_speed] += random.normal(0.0, 0.1, 5)
    y[layout.cage_speed] += random.normal(0.0, 1.0, 6) * [0.1, 0.1, 0.1, 5.0, 3.0, 3.0]
    y[layout.ball_speed] += random.normal(0.0, 0.2, 3 * layout.balls)
    y[layout.ball_turn] += random.normal(0.0, 30.0, 3 * layout.balls)
    return y


@pytest.mark.parametrize("guidance", [None, Guidance.BALLS, Guidance.INNER_RING, Guidance.OUTER_RING])
@pytest.mark.parametrize("law", ["none", "coulomb", "four constants"])
def test_kernel_agrees_with_its_twin(setup, guidance, law):
    bearing = setup.bearing_7008(7)
    angles = (radians(16.0), radians(14.0))
    friction = {
        "none": None,
        "coulomb": race_friction(
            CoefficientTraction(RampedCoulomb(friction=0.08, slide_none=0.001, slide_full=0.02)), bearing, angles
        ),
        "four constants": race_friction(CoefficientTraction(FourConstants(-0.03, 3.6, 46.0, 0.03)), bearing, angles),
    }[law]
    model = setup.model(
        bearing,
        friction,
        cage=guidance is not None,
        cage_options=({} if guidance in (None, Guidance.BALLS) else LAND | {"guidance": guidance}) | UNEVEN,
        ring_options={"damping": 30.0},
        equations=LoadType.GENERAL,
        gravity=(0.5, -9.81, 1.0),
        drag=0.01,
        film_viscosity=0.03,
    )
    operation = setup.operation(5000.0, 100.0, 60.0, outer_speed=-80.0, moment=(0.01, -0.02), tilt=(None, None))
    sim = simulation(bearing, operation, model)
    random, p = np.random.default_rng(271828), sim.data
    layout, dy = sim.layout, np.zeros(sim.layout.size)
    for _ in range(20):
        y = shaken(sim, random)
        p.impact_speeds[:] = random.uniform(0.05, 0.5, p.impact_speeds.size)
        derivative(0.0, y, p, dy)
        twin = accelerations(p, y, np.array([operation.inner_speed, -80.0, 100.0, 60.0, 0.0, 0.01, -0.02]))
        got = dy[layout.positions : layout.mechanical]
        assert_allclose(got, twin, rtol=1e-9, atol=1e-9 * np.abs(twin).max())
        assert_allclose(dy[: layout.positions], y[layout.positions : 2 * layout.positions])


def test_a_reduced_model_moves_what_it_has(setup):
    """Under a radial load all that stays in the middle plane: the ring along y and z, since friction pushes it
    aside, the cage with its rotation, y, z and one rotation of each ball.
    """
    bearing = setup.bearing_7008(5)
    friction = race_friction(CoefficientTraction(FourConstants(-0.03, 3.6, 46.0, 0.03)), bearing, (0.0, 0.0))
    sim = simulation(bearing, setup.operation(5000.0, 0.0, 80.0), setup.model(bearing, friction))
    dy, layout = np.zeros(sim.layout.size), sim.layout
    y = shaken(sim, np.random.default_rng(9001))
    y[layout.cage][3] = 6e-3  # the pockets push
    derivative(0.0, y, sim.data, dy)
    moving = dy[layout.positions : layout.mechanical] != 0.0
    assert sim.equations["dynamic"] == 2 + 3 + 3 * 5
    assert moving[:5].tolist() == [False, True, True, False, False]
    assert moving[5:11].tolist() == [False, True, True, True, False, False]
    assert sim.data.mechanical == 2 * (2 + 3) + (2 + 3) * 5
    assert solved_motion(sim.state.kind, sim.data).begin(sim.state)[0].size == sim.data.solved.size < layout.size


def test_a_law_that_is_not_compiled_is_refused(setup):
    """Torque and traction equilibrium take any law with `forces`, the equations of motion compiled ones alone."""
    bearing, angles = setup.bearing_7008(), (0.0, 0.0)
    with pytest.raises(ValueError, match="neither a coefficient nor a traction table"):
        race_friction(LawTraction(laws=dict.fromkeys(Race, object())), bearing, angles)


def test_schedule_is_linear_between_its_rows():
    times = np.array([0.0, 0.1, 0.3])
    rows = np.array([[0, 0, 0, 0, 0, 0, 0], [100, 10, 1, 2, 3, 4, 5], [50, 10, 1, 2, 3, 4, 5.0]])
    out = np.zeros(7)
    assert _motion_kernels.schedule_at(times, rows, 0.05, out) == pytest.approx(1000.0)
    assert_allclose(out, [50.0, 5.0, 0.5, 1.0, 1.5, 2.0, 2.5])
    assert _motion_kernels.schedule_at(times, rows, 0.2, out) == pytest.approx(-250.0)
    assert_allclose(out[0], 75.0)
    assert _motion_kernels.schedule_at(times, rows, 1.0, out) == 0.0
    assert_allclose(out[0], 50.0)


def test_the_row_before_a_time_is_found_among_many():
    """Bisection against NumPy's interpolation, at rows and between them."""
    random = np.random.default_rng(90210)
    times = np.concatenate([[0.0], np.cumsum(random.uniform(1e-4, 1e-2, 40))])
    rows = random.normal(size=(times.size, 3))
    out = np.zeros(3)
    for t in [*times, *random.uniform(0.0, 1.1 * times[-1], 200)]:
        _motion_kernels.schedule_at(times, rows, float(t), out)
        assert_allclose(out, [np.interp(t, times, column) for column in rows.T], rtol=1e-12, atol=1e-14)


def test_the_light_quadrature_holds_the_full_one(setup):
    """48 points over the ellipse against 512: force within 1 % of mu Q, spin moment within 2 % of mu Q b."""
    bearing = setup.bearing_7008()
    data = (
        race_friction(CoefficientTraction(FourConstants(-0.03, 3.6, 46.0, 0.03)), bearing, (radians(15.0),) * 2)
        .data(Race.INNER)
        .coefficient
    )
    for slide_x, slide_y, spin in ((0.1, 0.0, 0.0), (0.02, 0.05, 400.0), (0.0, 0.0, 800.0), (2.0, 0.1, 200.0)):
        found = np.zeros((2, 8))
        for row, disc in enumerate((ellipse_rings(4, 12, staggered=True), ellipse_rings(16, 32))):
            hertz_friction(disc, data.law, data.shape, 20.0, 6.0, slide_x, slide_y, spin, found[row])
        assert_allclose(found[0, :2], found[1, :2], atol=0.01 * 0.05 * 20.0)
        assert_allclose(found[0, 2], found[1, 2], atol=0.02 * 0.05 * 20.0 * data.shape[1] * 20.0 ** (1 / 3))


def test_an_unbalance_follows_the_changing_speed(setup):
    """m e times minus the second derivative of (cos, sin) of the angle at a rising speed, by central differences."""
    bearing, start, rise, phase = setup.bearing_7008(5), 200.0, 3e4, 0.4  # [rad/s], [rad/s2], [rad]
    rows = tuple((speed, 0.0, 60.0, 0.0, 0.0, 0.0, 0.0) for speed in (start, start + 0.01 * rise))
    given = Schedule(time=(0.0, 0.01), values=rows)
    rates = []
    for moment in (0.0, 2e-6):
        ring = {"unbalance": (moment, phase)}
        model = setup.model(bearing, cage=False, ring_options=ring, equations=LoadType.GENERAL, schedule=given)
        sim = simulation(bearing, setup.operation(2000.0, 60.0), model)
        layout, dy = sim.layout, np.zeros(sim.layout.size)
        y = sim.state.y.copy()
        y[ring_angle(bearing.balls)] = 1.1
        derivative(0.004, y, sim.data, dy)
        rates.append(dy[layout.ring_speed][:3])
    speed, step = start + 0.004 * rise, 1e-5

    def place(t):
        angle = 1.1 + phase + speed * t + 0.5 * rise * t**2
        return np.array([0.0, np.cos(angle), np.sin(angle)])

    pull = -2e-6 * (place(step) - 2.0 * place(0.0) + place(-step)) / step**2
    assert_allclose((rates[1] - rates[0]) * sim.data.constants.ring_mass, pull, rtol=1e-5, atol=1e-9)


def test_a_tilting_ring_that_spins_turns_across(setup):
    """Euler about y and z: J_t w_y' = -J_p W w_z and J_t w_z' = J_p W w_y, and no other change, far from all balls."""
    bearing = setup.bearing_7008(5)
    model = setup.model(bearing, cage=False, equations=LoadType.GENERAL)
    sim = simulation(bearing, setup.operation(9000.0, 60.0, moment=(0.0, 0.0), tilt=(None, None)), model)
    layout, c = sim.layout, sim.data.constants
    sim.data.normal[:2, 0] = 1e-30  # no races
    rates = np.zeros((2, layout.size))
    for row, (wy, wz) in zip(rates, ((0.0, 0.0), (0.7, -0.4)), strict=True):
        y = sim.state.y.copy()
        y[layout.ring_speed][3:] = wy, wz
        derivative(0.0, y, sim.data, row)
    change = (rates[1] - rates[0])[layout.ring_speed][3:] * c.ring_transverse
    assert_allclose(change, c.ring_polar * 9000.0 * setup.RPM * np.array([0.4, 0.7]), rtol=1e-9)


def test_an_elastic_impact_lasts_as_its_motion_says():
    """Twice the integral of dx/v of m v dv = -K x^1.5 dx, x = deepest (1 - s^2): 2.943 deepest/v (Hertz, 1882)."""
    mass, speed = 1.4e-3, 0.3
    law = np.zeros(NORMAL_COLUMNS)
    law[:2] = 1.2e10, 1.5
    deepest = (1.25 * mass * speed**2 / law[0]) ** 0.4
    nodes, weights = np.polynomial.legendre.leggauss(60)
    s = 0.5 * (nodes + 1.0)
    slow = np.sqrt(1.0 - (1.0 - s**2) ** 2.5)  # speed over the first one
    lasts = 2.0 * deepest / speed * (0.5 * weights * 2.0 * s / slow).sum()
    assert duration(law, mass, speed) == pytest.approx(lasts, rel=1e-4)  # of the four digits


@pytest.mark.parametrize(
    ("cage", "kind"),
    [(Guidance.INNER_RING, LoadType.GENERAL), (None, LoadType.GENERAL), (Guidance.BALLS, LoadType.AXIAL)],
)
def test_jacobian_ball_by_ball_is_that_of_all_contacts(setup, cage, kind):
    """Balls that act through ring and cage, balls that meet, one that stands for all: differences of the rates."""
    bearing = setup.bearing_7008(7)
    options = LAND | {"guidance": cage} if cage is Guidance.INNER_RING else {}
    rest = {"equations": kind, "drag": 0.01, "film_viscosity": 0.03}
    model = setup.model(bearing, cage=cage is not None, cage_options=options, **rest)
    sim = simulation(bearing, setup.operation(5000.0, 100.0), model)
    random = np.random.default_rng(141421)
    if kind is LoadType.GENERAL:
        sim.state.y[:] = shaken(sim, random)
    motion = solved_motion(kind, sim.data)
    y, _ = motion.begin(sim.state)
    scale = motion.scale(sim.scale)
    size, before = scale.size, y.copy()
    found = np.zeros((size + 1, size + 1))[:size, :size]  # a part of an array, as LSODA has it
    jacobian(0.0, y, motion.data.kernel, scale, found)
    assert_allclose(y, before, rtol=0.0)

    def rates(y):
        dy = np.zeros_like(y)
        _motion_kernels.solved_derivative(0.0, y, motion.data.kernel, dy)
        return dy[:size]

    base = rates(y)
    slopes = np.zeros_like(found)
    for column, step in enumerate(scale):
        moved = y.copy()
        moved[column] += step
        slopes[:, column] = (rates(moved) - base) / step
    size_of_row = np.abs(slopes * scale).max(axis=1, keepdims=True) + 1e-300
    assert_allclose(found * scale / size_of_row, slopes * scale / size_of_row, atol=1e-9)
