"""The discrete equations: rigid bodies in closed form, steady films kept, oil conserved."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from verification.contacts import from_groups, moes

from oilfilm.ehl import Lubricant, MoesConditions, ViscosityLaw
from oilfilm.ehl.grid import grid_hierarchy
from oilfilm.ehl.multigrid.cycle import cycle, flow, reynolds_operator, update_film
from oilfilm.ehl.multigrid.far_field import far_field
from oilfilm.ehl.multigrid.levels import Damping, TimeStep, make_multigrid
from oilfilm.ehl.oil.lubricant import DensityLaw
from oilfilm.ehl.scaling import scale_contact
from oilfilm.ehl.transient.content import advected, weights
from oilfilm.ehl.transient.inputs import TransientConditions, TransientOptions
from oilfilm.ehl.transient.run import SWITCH, transient_run

OIL = Lubricant(
    viscosity=0.05,
    pressure_viscosity=20e-9,
    viscosity_law=ViscosityLaw.ISOVISCOUS,
    density_law=DensityLaw.INCOMPRESSIBLE,
)
SMALL = (-2.5, 1.5, 2.0)
RATE = -0.4  # dH0/dT of rigid bodies that close in
GAP = 1.3  # H0 of rigid bodies
SPEEDS = (0.8, 0.0, -0.6)


def rigid(ratio, angle, points, speed):
    """A multigrid of rigid bodies in a step of equal length to the last, P of the closed form, and that form."""
    conditions = MoesConditions(
        load_parameter=20.0, lubricant_parameter=0.0, radius_ratio=ratio, entrainment_angle=angle, lubricant=OIL
    )
    c = replace(scale_contact(conditions, along_entrainment=True), deformation=0.0)
    box = (-2.5 * c.half_extent_x, 2.5 * c.half_extent_x, 2.5 * c.half_extent_y)
    grids = grid_hierarchy(points, box, c.half_extent_y / c.half_extent_x, 3, c.symmetric)
    state = make_multigrid(c, grids, None, Damping(switch=SWITCH, approach=0.0))
    level = state.levels[-1]
    X, Y = level.grid.X[None, :], level.grid.Y[:, None]
    field = far_field(c)
    kappa = c.speed / (2.0 * (c.curvature_x + c.curvature_y))

    def film(back):
        return c.gap(X, Y) + GAP - RATE * back

    level.H = film(0.0)
    exact = (-kappa * RATE - speed * (field.pressure_x * X + field.pressure_y * Y)) / level.H**2
    # the time of a step is hx: nodes move by `speed`
    step = level.grid.hx
    c0, c1, c2 = weights(1.0)
    state.time_step = TimeStep(rate=c0 / step, couette=0.0, load=c.load)
    source = c1 * advected(film(step), speed) - c2 * advected(film(2.0 * step), 2.0 * speed)
    level.f = -source / step
    level.s = level.gap
    state.approach = GAP
    return state, exact


def defect(ratio, angle, points, speed):
    state, exact = rigid(ratio, angle, points, speed)
    level = state.levels[-1]
    level.P = exact
    flow(state, level)
    residual = level.f - reynolds_operator(level)
    inner = residual[0 if level.grid.symmetric else 1 : -1, 1:-1]
    return float(np.abs(inner).max()) / abs(RATE)


@pytest.mark.parametrize("speed", SPEEDS)
@pytest.mark.parametrize(("ratio", "angle"), [(1.0, 0.0), (0.2, 0.0), (4.0, 0.0), (0.3, 0.7)])
def test_rigid_squeeze_with_rolling_in_closed_form(ratio, angle, speed):
    """P = -[lambda dH0/dT/(2 (S + T)) + k X]/H^2 solves the discrete equations to second order, in every ellipse and
    at every angle: squeeze and wedge of a paraboloid themselves are exact, what is left is the Poiseuille flow's."""
    coarse, fine = (defect(ratio, angle, points, speed) for points in (33, 65))
    assert fine < 0.03
    assert_allclose(coarse / fine, 4.0, rtol=0.2)  # at the worst node; smooth fields


def test_cycles_find_the_closed_form():
    """Pressure between edges that have that of the closed form, at two meshes; below zero there is a cavity."""
    errors = []
    for points in (33, 65):
        state, exact = rigid(0.3, 0.0, points, 0.1)
        level = state.levels[-1]
        assert exact.min() > 0.0
        level.P = exact.copy()
        level.P[:-1, 1:-1] *= 0.9
        update_film(state, len(state.levels) - 1)
        for _ in range(25):
            cycle(state, len(state.levels) - 1)
        errors.append(float(np.abs(level.P - exact).max() / exact.max()))
    assert errors[1] < 2e-3
    assert_allclose(errors[0] / errors[1], 4.0, rtol=0.3)


def running(groups, points=65, ratio=1.0, **more):
    """A run of constant load and speed."""
    c = from_groups(moes(*groups, ratio))
    return transient_run(
        TransientConditions(contact=c, end_time=1e-2, **more), TransientOptions(points=points, domain=SMALL)
    )


@pytest.mark.parametrize("groups", [(100.0, 2.5), (100.0, 10.0), (1000.0, 10.0)], ids=str)
def test_a_steady_film_stays_and_a_kick_dies_out(groups):
    """A random change of the pressure by 1e-6, 20 steps: with the switch of steady contacts single nodes grow at
    (100, 2.5), and the film falls by some per cent."""
    run = running(groups, 129 if groups[1] < 5.0 else 65)
    level = run.stepper.level
    film = level.H.copy()
    kick = 1e-6 * np.random.default_rng(60317).standard_normal(level.P.shape) * (level.P > 0.0)
    run.past = replace_pressure(run.past, level.P + kick)
    level.P = level.P + kick
    for _ in range(20):
        run.accept(run.advance())
    assert np.abs(run.stepper.level.H - film).max() < 1e-7  # a tenth of the kick


def replace_pressure(past, pressure):
    past.pressure = (pressure, past.pressure[1])
    return past


def test_oil_is_kept_between_the_steps():
    """What all nodes inside hold, with what comes from and goes to the edge, changes by what Poiseuille flow brings,
    to rounding, though the cycles leave a residual: also where the gap is not full."""
    run = running((100.0, 10.0))
    level = run.stepper.level
    hx = level.grid.hx
    for _ in range(4):
        before = run.past
        run.accept(run.advance())
    now = run.past
    held = 1.5 * now.content[0] - 2.0 * advected(before.content[0], 1.0) + 0.5 * advected(before.content[1], 2.0)
    film = level.H
    level.H = np.zeros_like(film)  # without film the operator is the Poiseuille flow
    gained = reynolds_operator(level).copy()
    level.H = film
    inner = (slice(0, -1), slice(1, -1))
    assert_allclose(held[inner] / hx, gained[inner], atol=1e-9)
    assert (now.content[0] < 0.9 * run.stepper.density_and_film()[1]).any()  # there is a cavity
