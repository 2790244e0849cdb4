"""Every compiled kernel against its reference in NumPy."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.ehl import Lubricant, MoesConditions, ViscosityLaw
from oilfilm.ehl.grid import Grid
from oilfilm.ehl.multigrid import _reynolds_kernels
from oilfilm.ehl.multigrid import _reynolds_kernels as _relaxation_kernels
from oilfilm.ehl.multigrid.cycle import log_viscosity, relax, start_level, update_film
from oilfilm.ehl.multigrid.levels import Damping, FlowFactors, make_multigrid
from oilfilm.ehl.oil import _kernels as properties
from oilfilm.ehl.oil.lubricant import oil_numbers
from oilfilm.ehl.scaling import CLOSED_FORM_LAWS, scale_contact
from oilfilm.ehl.solid.deformation import deflection_kernel

from ...reference.ehl import relaxation, reynolds

PLAIN = FlowFactors()  # of a Newtonian oil
ROUND_OFF = 1e-12  # relative; sums of a few terms in another order


def contact(law=ViscosityLaw.ROELANDS, ratio=0.3):
    oil = Lubricant(viscosity=0.05, pressure_viscosity=18e-9, viscosity_law=law)
    conditions = MoesConditions(load_parameter=60.0, lubricant_parameter=6.0, radius_ratio=ratio, lubricant=oil)
    return scale_contact(conditions)


def make_grid(symmetric):
    return Grid(x_in=-3.0, hx=0.15, hy=0.4, nx=33, ny=11 if symmetric else 21, symmetric=symmetric)


@pytest.fixture(params=[True, False], ids=["half", "full"])
def fields(request):
    """A pressure with cavitation and a film that is neither smooth nor positive everywhere."""
    random, g = np.random.default_rng(71203), make_grid(request.param)
    X, Y = g.X[None, :], g.Y[:, None]
    P = np.sqrt(np.maximum(1.0 - X**2 - (Y / 2.2) ** 2, 0.0)) * (1.0 + 0.1 * random.random((g.ny, g.nx)))
    P[:, [0, -1]] = P[-1] = 0.0
    if not g.symmetric:
        P[0] = 0.0
    H = 0.2 + 0.5 * np.maximum(X**2 + 0.3 * Y**2 - 1.0, 0.0) + 0.02 * random.standard_normal((g.ny, g.nx))
    H[3, 5] = -0.1
    return g, P, H


def compiled_flow(c, P, H, factors=PLAIN):
    eps, rho, slope = np.empty_like(P), np.empty_like(P), np.empty_like(P)
    viscosity = (c.viscosity_slope, c.viscosity_pressure, c.viscosity_exponent)
    density = (c.density_numerator, c.density_denominator)
    _reynolds_kernels.flow_properties(P, H, *viscosity, *density, *factors.follows, c.speed, eps, rho, slope, 0, len(P))
    return eps, rho, slope


def mesh(g):
    return g.hx, g.hy, g.symmetric


def couette_flows(g, P, H):
    """An entrainment along X; on the full grid also one at an angle, with a rotation strong enough to reverse it."""
    eps, rho, slope = reynolds.flow_properties(P, H, contact())
    yield relaxation.Flow(eps=eps, flow_x=rho, slope_x=slope)
    if not g.symmetric:
        u, v = 0.8 - 0.3 * g.Y[:, None] + 0.0 * P, 0.1 + 0.3 * g.X[None, :] + 0.0 * P
        assert u.min() < 0.0 < u.max()
        assert v.min() < 0.0 < v.max()
        yield relaxation.Flow(eps=eps, flow_x=rho * u, slope_x=slope * u, flow_y=rho * v, slope_y=slope * v)


def compiled_lateral(flow):
    if flow.flow_y is None:
        return None, None
    return flow.flow_y, flow.slope_y


@pytest.mark.parametrize("law", CLOSED_FORM_LAWS)
def test_flow_properties(fields, law):
    _, P, H = fields
    c = contact(law)
    for ours, twin in zip(compiled_flow(c, P, H), reynolds.flow_properties(P, H, c), strict=True):
        assert_allclose(ours, twin, rtol=1e-11, atol=1e-300)  # exp of a power: a few more digits lost


def test_reynolds_operator(fields):
    g, P, H = fields
    for flow in couette_flows(g, P, H):
        ours = np.empty_like(P)
        _reynolds_kernels.reynolds_operator(P, H, flow.eps, flow.flow_x, compiled_lateral(flow)[0], *mesh(g), ours)
        twin = reynolds.reynolds_operator(P, H, flow.eps, (flow.flow_x, flow.flow_y), (g.hx, g.hy), g.symmetric)
        assert_allclose(ours, twin, rtol=ROUND_OFF, atol=ROUND_OFF * np.abs(twin).max())


@pytest.mark.parametrize("stored", [False, True], ids=["steady", "over time"])
def test_relax_lines(fields, stored):
    g, P, H = fields
    kernel = deflection_kernel(g, contact().deformation)
    f = 0.01 * np.random.default_rng(5519).standard_normal(P.shape)
    for flow in couette_flows(g, P, H):
        storage = None
        if stored:  # 1.5 rho/hx and its slope
            storage = 1.5 / g.hx * np.stack(reynolds.flow_properties(P, H, contact())[1:])
            flow = dataclasses.replace(flow, storage=storage)
        ours, spread, kinds = P.copy(), np.zeros_like(P), np.zeros(P.shape, dtype=np.int8)
        reversing = True if flow.flow_y is not None else None
        couette = (flow.flow_x, flow.slope_x, *compiled_lateral(flow), reversing)
        first = 0 if g.symmetric else 1
        for colour in (first, first + 1):
            ends = (colour, g.ny - 1)
            flooded = (None, None, None)
            sweep = (*couette, f, storage, kernel.near, *mesh(g), *flooded, 0.8, 0.7, kinds, spread, *ends)
            _relaxation_kernels.relax_lines(ours, H, flow.eps, *sweep)
        _relaxation_kernels.spread_changes(ours, kinds, spread, g.hx, g.hy, 0.3, first, g.ny - 1)
        twin = relaxation.relax_lines(P, H, flow, f, g, kernel, (0.3, 0.8, 0.7))
        assert np.abs(twin - P).max() > 1e-3  # the sweep did something
        assert_allclose(ours, twin, rtol=0.0, atol=1e-9)  # elimination without and with pivoting


def test_all_kinds_of_nodes_are_exercised(fields):
    g, P, H = fields
    c = contact()
    kernel = deflection_kernel(g, c.deformation)
    eps, rho, slope = reynolds.flow_properties(P, H, c)
    residual = -reynolds.reynolds_operator(P, H, eps, (rho, None), (g.hx, g.hy), g.symmetric)
    threshold = 2.0 * 0.7 * kernel.near[0, 0] / g.hx
    kinds = set()
    for j in range(1, g.ny - 1):
        line = relaxation.Line(
            eps=eps[j], eps_north=eps[j + 1], eps_south=eps[j - 1], flow=rho[j], slope=slope[j], H=H[j]
        )
        kinds |= set(relaxation.line_kinds(P[j], residual[j], line, g, threshold).tolist())
    assert kinds == {relaxation.FIXED, relaxation.GAUSS_SEIDEL, relaxation.JACOBI}


def test_half_and_full_domain_sweeps_agree():
    """A sweep over the half domain is the upper half of one over the full domain, up to the order of the lines."""
    c, pressures = contact(), []
    for symmetric in (True, False):
        state = make_multigrid(c, (make_grid(symmetric),), None, Damping(switch=1e9))  # Jacobi only: no order
        level = state.levels[0]
        X, Y = level.grid.X[None, :], level.grid.Y[:, None]
        state.approach = -0.8
        start_level(state, 0, np.sqrt(np.maximum(1.0 - X**2 - (Y / c.semi_axis_ratio) ** 2, 0.0)))
        update_film(state, 0)
        relax(state, 0)
        pressures.append(level.P)
    assert_allclose(pressures[1][10:], pressures[0], rtol=0.0, atol=1e-12)


@pytest.mark.parametrize("law", list(CLOSED_FORM_LAWS))
def test_factors_that_follow_the_pressure(fields, law):
    """Each kernel multiplies eps by [eta(P)/eta(P_0)]^k."""
    _, P, H = fields
    c, random = contact(law), np.random.default_rng(60217)
    k, at = random.random(P.shape), log_viscosity(c, P * random.uniform(0.9, 1.1, P.shape))
    factors = FlowFactors(thinning=k, log_viscosity=at)
    wanted = compiled_flow(c, P, H)[0] * np.exp(k * (log_viscosity(c, P) - at))
    assert_allclose(compiled_flow(c, P, H, factors)[0], wanted, rtol=1e-11, atol=1e-300)
    oil = Lubricant(viscosity=0.05, pressure_viscosity=18e-9, viscosity_law=law)
    found = np.empty_like(P), np.empty_like(P), np.empty_like(P)
    numbers = oil_numbers(oil)
    properties.flow_properties(P, H, c.hertz_pressure, numbers, *factors.follows, c.speed, *found, 0, len(P))
    assert_allclose(found[0], wanted, rtol=1e-11, atol=1e-300)


@pytest.mark.parametrize("law", list(CLOSED_FORM_LAWS))
def test_any_law_by_the_general_kernel(fields, law):
    """The kernel for laws of any kind, and the one for closed forms, on laws that both know."""
    _, P, H = fields
    c = contact(law)
    oil = Lubricant(viscosity=0.05, pressure_viscosity=18e-9, viscosity_law=law)
    found = np.empty_like(P), np.empty_like(P), np.empty_like(P)
    properties.flow_properties(P, H, c.hertz_pressure, oil_numbers(oil), *PLAIN.follows, c.speed, *found, 0, len(P))
    for ours, twin in zip(found, compiled_flow(c, P, H), strict=True):
        assert_allclose(ours, twin, rtol=1e-11, atol=1e-300)
