"""Heat of the film: columns and bodies against closed forms, kernels against their NumPy twins.

Couette flow heated by shear with equal walls and eta = eta_0 exp(-beta (T - T_w)): Nahme's solution as in Bird,
Armstrong and Hassager (1987), re-derived: with N = beta eta_0 U^2/k the rise is [ln(1 + N/8) - 2 ln cosh((2 z/h - 1)
asinh(sqrt(N/8)))]/beta and the stress eta_0 U/h asinh(sqrt(N/8))/sqrt(N/8 (1 + N/8)).
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from oilfilm.ehl import ContactConditions, Lubricant, SolverOptions, ViscosityLaw, solve_contact
from oilfilm.ehl.closed_form.film import film_reduction_gupta, thermal_loading
from oilfilm.ehl.generalized import _heat_kernels, flow, solver
from oilfilm.ehl.generalized import _heat_kernels as _kernels
from oilfilm.ehl.generalized.film_heat import SMALLEST_PENDING_CHANGE, FilmHeat, film_section, wall_slopes
from oilfilm.ehl.generalized.solver import solve_generalized
from oilfilm.ehl.oil.assumed_heat import heat_of
from oilfilm.ehl.oil.lubricant import DensityLaw, ThermalProperties, oil_numbers
from oilfilm.ehl.oil.rheology import Rheology, kernel_rheology
from oilfilm.ehl.solid.heat import SolidThermal, history_weights, response_factor

from ...reference.ehl.heat_columns import HeatColumn, column_temperature

SECTION = film_section()
DIFFERENCES = wall_slopes(SECTION)
HEAT = ThermalProperties(conductivity=0.14, specific_heat=2000.0, viscosity_temperature=0.04, expansion=7e-4)
OIL = Lubricant(
    viscosity=0.05,
    pressure_viscosity=2e-8,
    viscosity_law=ViscosityLaw.ISOVISCOUS,
    density_law=DensityLaw.INCOMPRESSIBLE,
    temperature=313.15,
    thermal=replace(HEAT, expansion=0.0),
)
STEEL = SolidThermal(conductivity=46.0, density=7850.0, specific_heat=460.0)
COLD = SolidThermal(conductivity=1e9, density=1e4, specific_heat=1e3)  # takes up any heat without warming
INSULATOR = SolidThermal(conductivity=1e-9, density=1.0, specific_heat=1e-3)
T_0 = 313.15


def still_column(**changes):
    """A column without convection or coupling of its source."""
    n = SECTION.nodes.size
    zero = np.zeros(n)
    plain = HeatColumn(
        film=3e-7,
        conductivity=0.14,
        inflow=zero,
        carried=zero,
        crossing=zero,
        source=zero,
        slope=np.zeros((n, n)),
        compression=zero,
        last=np.full(n, T_0),
        history=(T_0, T_0),
        response=(0.0, 0.0),
    )
    return replace(plain, **changes)


def test_uniform_heat_gives_a_parabola():
    """T - T_w = Q h^2/(2 k) z (1 - z); three-point differences are exact for it."""
    heat = 1e15
    t = column_temperature(still_column(source=np.full(SECTION.nodes.size, heat)), SECTION)
    z = SECTION.nodes
    assert_allclose(t - T_0, heat * 9e-14 / 0.28 * z * (1.0 - z), atol=1e-9 * t.max())


def test_heat_leaves_through_the_walls():
    """Equal walls with a response: each takes half of Q h and warms by R Q h/2."""
    heat, response = 1e15, 1e-7
    t = column_temperature(
        still_column(source=np.full(SECTION.nodes.size, heat), response=(response, response)), SECTION
    )
    assert_allclose(t[[0, -1]] - T_0, response * heat * 3e-7 / 2.0, rtol=1e-9)


def crossed_film(pe, count, *, second_order):
    """Temperatures between walls of 0 and 1 K with a flow of Peclet number pe across the film."""
    zero = np.zeros(count)
    column = still_column(
        film=1.0,
        conductivity=1.0,
        inflow=zero,
        carried=zero,
        crossing=np.full(count, pe),
        source=zero,
        slope=np.zeros((count, count)),
        compression=zero,
        last=zero,
        history=(0.0, 1.0),
    )
    return column_temperature(column, film_section(count), second_order=second_order)


@pytest.mark.parametrize("pe", [-4.0, 1.0, 8.0])
def test_conduction_taken_off_makes_the_flow_across_second_order(pe):
    """T = (e^(Pe z) - 1)/(e^Pe - 1): upwind differences lose half of their error on twice the nodes, these more than
    two thirds, and have less than half of it on twelve.
    """
    errors = {}
    for second_order in (False, True):
        for count in (12, 24):
            exact = np.expm1(pe * film_section(count).nodes) / np.expm1(pe)
            errors[second_order, count] = np.abs(crossed_film(pe, count, second_order=second_order) - exact).max()
    assert errors[False, 24] > 0.4 * errors[False, 12]
    assert errors[True, 24] < 0.3 * errors[True, 12]
    assert errors[True, 12] < 0.5 * errors[False, 12]


@pytest.mark.parametrize("pe", [-1e6, -300.0, 300.0, 1e6])
def test_strong_flow_across_keeps_temperatures_between_the_walls(pe):
    found = crossed_film(pe, SECTION.nodes.size, second_order=True)
    assert found.min() > -1e-9
    assert found.max() < 1.0 + 1e-9
    assert np.diff(found).min() > -1e-9


@pytest.mark.parametrize("second_order", [False, True])
def test_column_kernel_agrees(second_order):
    random, n = np.random.default_rng(60217), SECTION.nodes.size
    along, pull, diagonal = 1e9 * random.standard_normal(n), random.random(n), 1e8 * random.standard_normal(n)
    column = still_column(
        inflow=1e9 * random.random(n),
        carried=3e11 * random.random(n),
        crossing=1e9 * random.standard_normal(n),
        source=1e13 * random.random(n),
        slope=np.diag(diagonal) - np.outer(along, pull),
        compression=1e7 * random.standard_normal(n),
        response=(1e-7, 3e-7),
        history=(320.0, 330.0),
    )
    out, flow = np.empty(n), np.zeros((_kernels.FLOW_ROWS, n))
    rows = {
        _kernels.INFLOW: column.inflow,
        _kernels.ADVECTED: column.carried,
        _kernels.CROSSING: column.crossing,
        _kernels.SOURCE: column.source,
        _kernels.COMPRESSION: column.compression,
        _kernels.DIAGONAL: diagonal,
        _kernels.ALONG: along,
        _kernels.PULL: pull,
        _kernels.LAST: column.last,
    }
    for row, values in rows.items():
        flow[row] = values
    walls = (column.history, column.response)
    _kernels.column_temperature(
        column.film, column.conductivity, second_order, *walls, SECTION.nodes, DIFFERENCES, flow, out
    )
    assert_allclose(out, column_temperature(column, SECTION, second_order=second_order), rtol=1e-9)


def test_tridiagonal_solver():
    """Of two right sides."""
    random, n = np.random.default_rng(91822), 9
    flow, right = np.zeros((_kernels.FLOW_ROWS, n)), random.standard_normal((n, 2))
    flow[_kernels.LOWER, 1:], flow[_kernels.UPPER, :-1] = random.random(n - 1), random.random(n - 1)
    flow[_kernels.MIDDLE] = 2.0 + random.random(n)
    lower, middle, upper = (flow[row].copy() for row in (_kernels.LOWER, _kernels.MIDDLE, _kernels.UPPER))
    wanted = np.linalg.solve(np.diag(middle) + np.diag(lower[1:], -1) + np.diag(upper[:-1], 1), right)
    first, flow[_kernels.COUPLED] = right.T.copy()
    _kernels.solve_tridiagonal(flow, first)
    assert_allclose(first, wanted[:, 0], rtol=1e-12)
    assert_allclose(flow[_kernels.COUPLED], wanted[:, 1], rtol=1e-12)


def test_uniform_flux_into_a_moving_body():
    """T - T_b = 2 q sqrt(x)/(sqrt(pi u) e) behind the edge of a uniform flux, Carslaw and Jaeger (1959).

    The weights take q as linear between nodes, so that the edge is a ramp one mesh long: error mesh/(4 x).
    """
    mesh, count, flux, speed = 1e-6, 200, 1e8, 5.0
    weights = history_weights(count, mesh)
    rise = np.cumsum(weights) * flux * response_factor(np.array(speed), STEEL, 1.0)
    x = mesh * (np.arange(count) + 0.5)  # from the middle of the ramp
    exact = 2.0 * flux * np.sqrt(x) / (np.sqrt(np.pi * speed) * STEEL.effusivity)
    assert_allclose(rise[5:], exact[5:], rtol=5e-3)
    assert_allclose(rise[100:], exact[100:], rtol=2e-5)


def test_linear_flux_into_a_moving_body_is_exact():
    """q = q' x gives int q/sqrt = (4/3) q' x^1.5, to round-off."""
    weights, q = history_weights(50, 2e-6), np.arange(50) * 2e-6
    ours = [np.dot(weights[: i + 1][::-1], q[: i + 1]) for i in range(50)]
    assert_allclose(ours, 4.0 / 3.0 * q**1.5, rtol=1e-12)
    both = np.stack((q, 2.0 * q)).reshape(2, 1, 50)
    past = [_heat_kernels.body_history(1, 0, i, both, 3.0 * both, 1.0, weights) for i in range(50)]
    assert_allclose(np.array(past) / (2.0, 6.0), (ours - weights[0] * q)[:, None] * (1.0, 1.0), rtol=1e-12)
    both = both[..., ::-1].copy()
    past = [_heat_kernels.body_history(1, 0, 49 - i, both, 3.0 * both, -1.0, weights) for i in range(50)]
    assert_allclose(np.array(past) / (2.0, 6.0), (ours - weights[0] * q)[:, None] * (1.0, 1.0), rtol=1e-12)


def test_body_at_rest():
    """A circle of radius a under uniform flux reaches q a/k in the middle of a body at rest: 2 q sqrt(2 a) R."""
    radius = 2e-4
    factor = response_factor(np.array(0.0), STEEL, radius)
    assert_allclose(2.0 * np.sqrt(2.0 * radius) * factor, radius / STEEL.conductivity, rtol=1e-12)


class Line:
    """One line of a film of uniform thickness and its heat."""

    def __init__(self, oil, solids, speeds, *, nx=60, film=3e-7, p=None, mesh=2e-6):
        shape, n = (1, nx), SECTION.nodes.size
        p = np.zeros(shape) if p is None else p
        gradient = np.stack((np.gradient(p, mesh, axis=1), np.zeros(shape)))
        speed = [np.stack((np.full(shape, u), np.zeros(shape))) for u in speeds]
        self.response = np.stack([response_factor(s[0], body, 1.0) for s, body in zip(speed, solids, strict=True)])
        self.film = (p, np.full(shape, film), gradient, *speed)
        self.oil, self.mesh, self.weights = oil, mesh, history_weights(nx, mesh)
        self.temperature, self.upwind = np.full((*shape, n), T_0), np.full((*shape, n), T_0)
        self.flux, self.upwind_flux = np.zeros((2, *shape)), np.zeros((2, *shape))
        self.middle, self.mass, self.dissipation = np.full((2, *shape), np.nan), np.zeros((*shape, n)), np.zeros(shape)
        self.recirculates, self.pending_change = np.zeros(shape, dtype=np.bool_), np.full(shape, np.inf)

    def march(self, inlet=T_0):
        """Sweep once along the line; the number of columns that missed."""
        heat = (self.oil.thermal.conductivity, self.oil.density * self.oil.thermal.specific_heat)
        return _heat_kernels.heat_sweep(
            *(*self.film, (self.mesh, 1.0), True, True, oil_numbers(self.oil), heat, SECTION.integration, DIFFERENCES),
            *(kernel_rheology(Rheology()), inlet, (T_0, T_0), self.response, self.weights),
            *(self.upwind, self.upwind_flux, self.temperature, self.flux, self.middle, self.mass, self.dissipation),
            *(
                self.recirculates,
                self.pending_change,
                SMALLEST_PENDING_CHANGE,
                _heat_kernels.column_rooms(SECTION.nodes.size),
            ),
        )


def sweep(*film, turns=3, inlet=T_0, **more):
    """March one line of a film of uniform thickness; returns temperature, fluxes, dissipation and misses."""
    line = Line(*film, **more)
    for _ in range(turns):
        line.pending_change[:] = np.inf
        missed = line.march(inlet)
    return line.temperature[0], line.flux[:, 0], line.dissipation[0], missed, line.middle[:, 0]


def test_columns_are_solved_again_where_they_have_something_to_follow():
    """A line at rest stays as it is, whatever flows in, until its first column is asked; then all that the new inflow
    changes by more than what columns may leave follows, as in a line that is solved as a whole.
    """
    film = (OIL, (STEEL, STEEL), (6.0, 4.0))
    line = Line(*film, nx=200)
    assert line.march() == 0
    assert line.pending_change.max() == 0.0
    rest = line.temperature.copy()
    assert line.march(T_0 + 20.0) == 0
    assert_array_equal(line.temperature, rest)
    line.pending_change[0, 0] = np.inf
    assert line.march(T_0 + 20.0) == 0
    whole = sweep(*film, nx=200, inlet=T_0 + 20.0, turns=1)[0]
    assert np.abs(whole - rest).max() > 5.0
    assert_allclose(line.temperature[0], whole, atol=2.0 * SMALLEST_PENDING_CHANGE)
    assert_array_equal(line.temperature[0, -1], rest[0, -1])  # there the walls have long taken the difference
    assert line.pending_change.max() < SMALLEST_PENDING_CHANGE


@pytest.mark.parametrize("slip", [1.0, 6.0, 20.0])
def test_couette_flow_heated_by_shear(slip):
    """Nahme's profile far downstream between walls that keep their temperature, N up to 5.7 [2nd order in 1/n]."""
    temperature, _, _, missed, middle = sweep(OIL, (COLD, COLD), (0.1 + slip, 0.1), nx=120)
    number = 0.04 * 0.05 * slip**2 / 0.14
    assert missed == 0
    ratio = number / 8.0
    highest = np.log1p(ratio) / 0.04
    falls = 2.0 * np.log(np.cosh(np.arcsinh(np.sqrt(ratio)) * (2.0 * SECTION.nodes - 1.0))) / 0.04
    assert_allclose(temperature[-1] - T_0, highest - falls, atol=0.01 * highest)
    stress = 0.05 * slip / 3e-7 * np.arcsinh(np.sqrt(ratio)) / np.sqrt(ratio * (1.0 + ratio))
    assert_allclose(abs(middle[0, -1]), stress, rtol=0.01)


def test_heat_is_conserved_along_a_line():
    """Shear heat = heat into the bodies + enthalpy carried out, in a parallel film between moving steel bodies.

    Upwind differences carry exactly what they take where the velocities are uniform along x; the sum over the nodes
    across is a quadrature of a three-point solution, right to a per cent.
    """
    oil = replace(OIL, thermal=replace(OIL.thermal, viscosity_temperature=0.0))
    temperature, flux, dissipation, missed, _ = sweep(oil, (STEEL, STEEL), (6.0, 4.0))
    assert missed == 0
    mesh, z = 2e-6, SECTION.nodes
    carried = 870.0 * 2000.0 * 3e-7 * SECTION.weights @ ((6.0 - 2.0 * z) * (temperature[-1] - T_0))
    assert_allclose(dissipation, 0.05 * 4.0 / 3e-7, rtol=1e-10)
    assert_allclose((dissipation - flux.sum(axis=0)).sum() * mesh, carried, rtol=0.01)
    assert flux.min() > 0.0


def test_column_balance():
    """Of one column: what shear heats, less convection, is what the walls take [1 %, three-point walls]."""
    oil = replace(OIL, thermal=replace(OIL.thermal, viscosity_temperature=0.0))
    temperature, flux, dissipation, _, _ = sweep(oil, (STEEL, STEEL), (6.0, 4.0))
    z, mesh = SECTION.nodes, 2e-6
    u = 6.0 - 2.0 * z
    convected = 870.0 * 2000.0 * 3e-7 / mesh * ((u * np.diff(temperature, axis=0)) @ SECTION.weights)
    assert_allclose(dissipation[1:] - convected, flux[:, 1:].sum(axis=0), rtol=0.01)


def test_adiabatic_compression():
    """A plug between insulators: T = T_0 exp[eps dp/(rho c)]; upwind, first order in the mesh."""
    oil = replace(OIL, thermal=replace(HEAT, viscosity_temperature=0.0), density_law=DensityLaw.INCOMPRESSIBLE)
    p = np.linspace(0.0, 5e7, 200)[None]
    temperature = sweep(oil, (INSULATOR, INSULATOR), (5.0, 5.0), nx=200, p=p, film=5e-8, turns=1)[0]
    exact = T_0 * np.exp(7e-4 * p[0] / (870.0 * 2000.0))
    middle = SECTION.nodes.size // 2
    assert_allclose(temperature[-1, middle] - T_0, exact[-1] - T_0, rtol=0.02)


BALL = {"radius_x": 5.24e-3, "radius_y": 0.204, "reduced_modulus": 2.26e11}


def ball_contact(**motion):
    """Of a spindle's ball and its outer race in thin oil."""
    oil = replace(OIL, viscosity=0.0126, viscosity_law=ViscosityLaw.ROELANDS, pressure_viscosity=2e-8, thermal=HEAT)
    return ContactConditions(load=47.3, lubricant=oil, **BALL, **motion)


def test_heat_of_a_weak_film_at_rest_is_that_of_all_its_columns(monkeypatch):
    """Columns with little left to follow stay as they are, in proportion to the largest rise [0.2 %]."""
    contact = ball_contact(entrainment_speed=2.0, slide_roll_ratio=0.01)
    solve = partial(solve_generalized, contact, Rheology(), solids=(STEEL, STEEL), options=SolverOptions(points=33))
    film = solve()
    monkeypatch.setattr(flow, "CONVERGED_HEAT_FRACTION", 0.0)
    whole = solve()
    assert whole.temperature.max() - T_0 < 1.0
    assert_allclose(film.heat_flux.sum(axis=(1, 2)), whole.heat_flux.sum(axis=(1, 2)), rtol=2e-3)
    assert_allclose(film.dissipation.sum(), whole.dissipation.sum(), rtol=2e-3)


def test_error_bar_holds_what_the_nodes_across_the_film_do(monkeypatch):
    """Of a fast contact in thicker oil: thrice the nodes take 2.8 % off; on six times as many it is 0.4 % less."""
    oil = ball_contact(entrainment_speed=1.0).lubricant
    contact = replace(ball_contact(entrainment_speed=38.0, spin=2570.0), lubricant=replace(oil, viscosity=0.03))
    solve = partial(solve_generalized, contact, Rheology(), solids=(STEEL, STEEL), options=SolverOptions(points=65))
    monkeypatch.setattr(solver, "SECTION_ERROR", 0.0)
    without = solve().contact.film_central_dimensionless
    monkeypatch.undo()
    film = solve().contact.film_central_dimensionless
    monkeypatch.setattr(film_section, "__defaults__", (36,))
    finer = solve().contact.film_central_dimensionless
    assert film.finest == without.finest
    error = 1.2 * (film.finest - finer.finest)
    assert 0.03 * film.finest < error < film.uncertainty - without.uncertainty


def test_temperatures_that_still_change_are_in_the_error_bar():
    plain = solve_contact(ball_contact(entrainment_speed=20.0), SolverOptions(points=65))
    still, restless = (solver._with_heat_error(plain, 1e9, change, None) for change in (0.0, 10.0))
    wider = restless.film_central_dimensionless.uncertainty - still.film_central_dimensionless.uncertainty
    assert_allclose(wider, 10.0 * solver.UNCONVERGED_HEAT_ERROR * plain.film_central_dimensionless.finest, rtol=1e-9)


@pytest.mark.parametrize(("share", "said"), [(1.001, True), (0.5, False)])
def test_tolerance_that_the_nodes_across_the_film_exceed_is_told_once(share, said):
    """Only where the mesh has reached it; where it has not, the message tells that already."""
    plain = solve_contact(ball_contact(entrainment_speed=20.0), SolverOptions(points=65))
    found = solver._with_heat_error(plain, 1e9, 0.0, share * plain.widest_bar)
    assert found.widest_bar > 1.001 * plain.widest_bar
    assert ("nodes across the film" in found.message) == said


@pytest.mark.parametrize(("ratio", "rise"), [(-0.2, 1.1), (0.05, 1.5), (0.5, -1.0)])
def test_a_mesh_without_a_heated_film_has_the_whole_change_as_its_bar(ratio, rise):
    """As 65 points in a spindle bearing at 9 kN, where the heated minimum film is below zero."""
    assert solver._alone(ratio, 1, rise) == (ratio, 1.0 - ratio)
    value, bar = solver._alone(0.8, 1, 1.1)
    assert 0.8 < value < 1.0
    assert bar < 0.03


def test_less_effusive_bodies_are_hotter():
    """Zirconia against silicon nitride against steel: wall temperatures by effusivity."""
    nitride = SolidThermal(conductivity=30.0, density=3290.0, specific_heat=740.0)
    zirconia = SolidThermal(conductivity=2.0, density=6040.0, specific_heat=450.0)
    walls = [sweep(OIL, (body, body), (6.0, 4.0))[0][-1, 0] for body in (STEEL, nitride, zirconia)]
    assert walls[0] < walls[1] < walls[2]


def test_gupta_formula_by_hand():
    """p_h/E' = 0.005, L_T = 1, S = 1: (1 - 0.066)/(1 + 0.213 * 3.23)."""
    assert_allclose(film_reduction_gupta(0.005, 1.0, 1.0), 0.934 / 1.68799, rtol=1e-6)
    assert film_reduction_gupta(0.005, 0.0, 1.0) == 1.0
    contact = ContactConditions(
        load=20.0, radius_x=0.01, radius_y=0.01, reduced_modulus=2e11, entrainment_speed=2.0, lubricant=OIL
    )
    assert_allclose(thermal_loading(contact), 0.05 * 0.04 * 4.0 / 0.14, rtol=1e-12)


def test_what_is_missing_is_named():
    cold = replace(OIL, thermal=None)
    contact = ContactConditions(
        load=20.0, radius_x=0.01, radius_y=0.01, reduced_modulus=2e11, entrainment_speed=2.0, lubricant=cold
    )
    with pytest.raises(ValueError, match="thermal"):
        FilmHeat(conditions=contact, solids=(STEEL, STEEL))
    assumed = heat_of(cold)
    assert thermal_loading(contact) == thermal_loading(replace(contact, lubricant=replace(cold, thermal=assumed)))
    with pytest.raises(ValueError, match="conductivity"):
        SolidThermal(conductivity=0.0, density=1.0, specific_heat=1.0)
    with pytest.raises(ValueError, match="specific_heat"):
        replace(HEAT, specific_heat=-1.0)
