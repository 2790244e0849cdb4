"""Contacts with rheology and heat reached from their Newtonian film: the same film, and one nothing else solves."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from verification.contacts import BALL_ON_DISC

from oilfilm.ehl import ContactConditions, Lubricant, SolverOptions, solve_contact
from oilfilm.ehl.generalized.film_heat import FilmHeat
from oilfilm.ehl.generalized.flow import Continuation, GeneralizedFlow
from oilfilm.ehl.generalized.solver import (
    CONTINUED,
    FOLLOWED_PRESSURE,
    SMALLER_STEP,
    _checked,
    solve_by_continuation,
    solve_generalized,
)
from oilfilm.ehl.multigrid.full_multigrid import ATTEMPTS, contact_multigrid
from oilfilm.ehl.oil.lubricant import ThermalProperties, log_viscosity_ratio
from oilfilm.ehl.oil.rheology import Rheology, ShearLaw, divide_stresses
from oilfilm.ehl.oil.shear_stress import shear_stress
from oilfilm.ehl.scaling import scale_contact
from oilfilm.ehl.solid.heat import SolidThermal

HEAT = ThermalProperties(conductivity=0.14, specific_heat=2000.0, viscosity_temperature=0.04, expansion=7e-4)
OIL = Lubricant(viscosity=0.04, pressure_viscosity=2e-8, temperature=333.0, thermal=HEAT)
CIRCULAR = replace(BALL_ON_DISC, lubricant=OIL, slide_roll_ratio=0.5)
STEEL = SolidThermal(conductivity=46.0, density=7850.0, specific_heat=460.0)
EYRING = Rheology(law=ShearLaw.REE_EYRING, eyring_stress=5e6)
COARSE = SolverOptions(points=65)
AT_REST = 2e-3  # both iterations stop when 4e-4 of the film is left to go by their own estimate, the minimum's slower

# Draw 15 of benchmarks/robustness_shear_heat.py, seed 40213, to four digits: 1.1 GPa, L 43, slip across. The cycles
# from a Hertz pressure do not converge, those from the Newtonian film do.
STALLED = ContactConditions(
    load=13.75,
    radius_x=3.319e-3,
    radius_y=8.055e-3,
    reduced_modulus=2.137e11,
    entrainment_speed=14.74,
    lubricant=Lubricant(viscosity=0.1359, pressure_viscosity=2.339e-8, roelands_z=0.6489),
    lateral_slide_ratio=0.02,
    spin=41.01,
)


# Draw 46: 2.5 GPa, L 61. With a frozen factor the cycles run away, from a Hertz pressure and from the Newtonian film.
SWINGING = ContactConditions(
    load=60.35,
    radius_x=1.155e-3,
    radius_y=29.52e-3,
    reduced_modulus=3.005e11,
    entrainment_speed=16.85,
    lubricant=Lubricant(viscosity=0.09961, pressure_viscosity=2.033e-8, roelands_z=0.6653),
    slide_roll_ratio=3.29e-3,
    spin=56.67,
)


FOLLOWING = Continuation(follow_pressure=True)


@pytest.mark.parametrize(
    ("heat", "follows"), [(False, False), (False, True), (True, False)], ids=["shear", "following", "heat"]
)
def test_continuation_finds_the_same_film(heat, follows):
    flow = GeneralizedFlow(
        conditions=CIRCULAR,
        rheology=EYRING,
        heat=FilmHeat(conditions=CIRCULAR, solids=(STEEL, STEEL)) if heat else None,
        continuation=Continuation(follow_pressure=follows),
    )
    there, state = solve_by_continuation(flow, COARSE)
    straight = solve_generalized(CIRCULAR, EYRING, solids=(STEEL, STEEL) if heat else None, options=COARSE).contact
    assert there.converged and straight.converged
    assert there.record.fallbacks == ((CONTINUED, FOLLOWED_PRESSURE) if follows else (CONTINUED,))
    assert straight.record.fallbacks == ()
    assert (state.heat is not None) is heat
    for film in ("film_central_dimensionless", "film_minimum_dimensionless"):
        assert_allclose(getattr(there, film).finest, getattr(straight, film).finest, rtol=AT_REST)
    assert (
        there.film_central_dimensionless.finest
        < 0.99 * solve_contact(CIRCULAR, COARSE).film_central_dimensionless.finest
    )


def test_continuation_to_a_newtonian_oil_stays_where_it_is():
    """1e15 Pa leaves (tau/tau_0)^2/6 < 1e-12; two directions and a whole grid where lateral sliding needs one."""
    conditions = replace(CIRCULAR, lateral_slide_ratio=0.02)
    flow = GeneralizedFlow(conditions=conditions, rheology=replace(EYRING, eyring_stress=1e15))
    (there, _), plain = solve_by_continuation(flow, COARSE), solve_contact(conditions, COARSE)
    assert there.converged and there.P.shape == plain.P.shape
    assert_allclose(there.film_central, plain.film_central, rtol=AT_REST)


def test_continuation_takes_the_settings_of_the_film_it_starts_from():
    """Not those of the last attempt on record: another mesh across would not fit the pressure."""
    plain = solve_contact(CIRCULAR, COARSE)
    other = next(attempt for attempt in ATTEMPTS if attempt.other_mesh)
    tried = replace(plain, record=replace(plain.record, fallbacks=(other.name,)))
    flow = GeneralizedFlow(conditions=CIRCULAR, rheology=EYRING)
    there, again = (solve_by_continuation(flow, COARSE, film)[0] for film in (plain, tried))
    assert there.converged
    assert_array_equal(there.P, again.P)


def test_divided_stresses_are_the_same_law_at_higher_stresses():
    """tau(rate; stresses/s) = tau(s rate; stresses)/s for every law, the limiting stress included."""
    carreau = Rheology(law=ShearLaw.CARREAU_YASUDA, carreau_modulus=2e6, carreau_exponent=0.5)
    rates, share = np.array([1e2, 1e5, 1e8]), 0.2
    for rheology in (EYRING, carreau, replace(EYRING, limiting_coefficient=0.05, limiting_stress=1e5)):
        assert divide_stresses(rheology, 1.0) is rheology
        wanted = shear_stress(share * rates, 3.0, 5e8, rheology) / share
        assert_allclose(shear_stress(rates, 3.0, 5e8, divide_stresses(rheology, share)), wanted, rtol=1e-12)


def test_first_cycle_on_a_grid_knows_nothing_of_others():
    """The flow model has no memory of its own: without a last state it answers as at first."""
    flow = GeneralizedFlow(conditions=CIRCULAR, rheology=EYRING)
    first, state = _asked(flow, 33)
    assert np.isinf(state.change)
    _asked(flow, 33, film=0.2, last=state)
    assert_array_equal(_asked(flow, 33)[0].poiseuille, first.poiseuille)


@pytest.mark.parametrize("heat", [False, True], ids=["shear", "heat"])
def test_a_state_serves_any_number_of_cycles(heat):
    """A cycle that is undone leaves the state it started from as it was."""
    heated = FilmHeat(conditions=CIRCULAR, solids=(STEEL, STEEL)) if heat else None
    flow = GeneralizedFlow(conditions=CIRCULAR, rheology=EYRING, heat=heated)
    state = _asked(flow, 33)[1]
    one, other = (_asked(flow, 33, film=0.2, last=state) for _ in range(2))
    assert_array_equal(one[0].poiseuille, other[0].poiseuille)
    assert one[1].change == other[1].change > 0.0


@pytest.mark.slow
def test_contact_that_stalled_from_hertz_pressure():
    """With a frozen factor the first way stalls; one that follows the pressure finds the film of the continuation."""
    options = SolverOptions(points=129)
    solution = solve_generalized(STALLED, EYRING, options=options).contact
    assert solution.converged
    assert not solution.record.fallbacks
    continued, _ = solve_by_continuation(GeneralizedFlow(conditions=STALLED, rheology=EYRING), options)
    assert continued.converged
    assert continued.record.fallbacks[0] == CONTINUED
    films = [found.film_central_dimensionless.finest for found in (solution, continued)]
    assert_allclose(films[0], films[1], rtol=3e-3)


@pytest.mark.slow
def test_contact_that_swings_at_the_outlet():
    """A factor that follows the pressure reaches the film that one frozen in a cycle does not."""
    options = SolverOptions(points=129)
    flow = GeneralizedFlow(conditions=SWINGING, rheology=EYRING)
    newtonian = solve_contact(SWINGING, options)
    still = replace(flow, continuation=Continuation(follow_pressure=False))
    frozen, _ = solve_by_continuation(still, options, newtonian)
    assert not frozen.converged
    assert SMALLER_STEP in frozen.record.fallbacks
    solution, state = solve_by_continuation(replace(flow, continuation=FOLLOWING), options, newtonian)
    assert solution.converged and state.change < 0.03
    assert solution.record.fallbacks == (CONTINUED, FOLLOWED_PRESSURE)
    assert len(solution.record.residual) < 30


@pytest.mark.parametrize("follows", [False, True], ids=["frozen", "following"])
def test_factor_that_follows_the_pressure_predicts_the_gradient_of_a_given_flux(follows):
    """A pressure raised by dp, the gradient that which keeps the flux with the frozen factor: is it found again?

    To first order with a factor that follows. Frozen it is off by the m-th power of the gradient that answers dp.
    """
    rolling = replace(CIRCULAR, slide_roll_ratio=0.0)
    flow = GeneralizedFlow(
        conditions=rolling,
        rheology=replace(EYRING, eyring_stress=2e6),
        continuation=Continuation(follow_pressure=follows),
    )
    contact, grid = scale_contact(rolling), _grid(33)
    shape, node = (grid.ny, grid.nx), (3, 20)
    film, pressure, gradient = 0.3 * np.ones(shape), 0.6, -2.0
    place = np.broadcast_to(grid.X - grid.X[node[1]], shape)
    state = None
    for _ in range(61):
        factors, state = flow.factors(contact, grid, np.maximum(pressure + gradient * place, 0.0), film, state)
    before = factors.poiseuille[node]
    p, risen = (np.array([x]) * contact.hertz_pressure for x in (pressure, 1.005 * pressure))
    thicker = float((log_viscosity_ratio(risen, OIL) - log_viscosity_ratio(p, OIL))[0])
    passed = np.exp((factors.thinning[node] - 1.0) * thicker)  # of the flux, at the old gradient
    after = np.maximum(1.005 * pressure + gradient / passed * place, 0.0)
    for _ in range(60):
        new, state = flow.factors(contact, grid, after, film, state)
    error = abs(np.log(new.poiseuille[node] / before) - factors.thinning[node] * thicker) / thicker
    assert error < 0.01 if follows else error > 0.1


def test_columns_over_the_limiting_stress_are_counted_and_reported():
    """A pressure that rises linearly over a flat film: h/2 grad p > Lambda p where p < h grad p/(2 Lambda)."""
    contact, grid = scale_contact(CIRCULAR), _grid(33)
    P = 0.5 + 0.1 * np.broadcast_to(grid.X, (grid.ny, grid.nx))
    rise = 0.3 * contact.film_scale * 0.1 / contact.semi_axis_x  # h grad p over p_h
    rheology = replace(EYRING, limiting_coefficient=0.5 * rise / 0.3, limiting_minimum=1.0)
    flow = GeneralizedFlow(conditions=CIRCULAR, rheology=rheology)
    state = flow.factors(contact, grid, P, np.full_like(P, 0.3))[1]
    assert state.over_limit_columns == np.count_nonzero(P * 1.001 < 0.3)
    assert 0 < state.over_limit_columns < P.size
    assert flow.factors(contact, grid, P, np.full_like(P, 0.01))[1].over_limit_columns == 0
    solved = solve_contact(CIRCULAR, COARSE)
    state = replace(state, change=0.0, unsolved_stresses=0, over_limit_columns=int(0.004 * solved.P.size))
    assert _checked(solved, state)[0].converged
    count = int(0.006 * solved.P.size)
    state = replace(state, over_limit_columns=count)
    checked = _checked(solved, state)[0]
    assert not checked.converged and f"limiting stress is below h/2 grad p at {count} columns" in checked.message
    assert f"at {count} columns of the last cycle" in _checked(replace(solved, converged=False), state)[0].message


def _grid(points):
    contact = scale_contact(CIRCULAR)
    flow = GeneralizedFlow(conditions=CIRCULAR, rheology=EYRING)
    options = SolverOptions(points=points, domain=(-4.0, 1.5, 2.5))
    return contact_multigrid(contact, options.domain, options, ATTEMPTS[0], flow).levels[-1].grid


def _asked(flow, points, film=0.3, last=None):
    """Factors at a Hertz pressure over a parabolic gap, and the state."""
    grid = _grid(points)
    X, Y = grid.X[None, :], grid.Y[:, None]
    P = np.sqrt(np.maximum(1.0 - X**2 - Y**2, 0.0))
    return flow.factors(scale_contact(CIRCULAR), grid, P, film + 0.1 * np.maximum(X**2 + Y**2 - 1.0, 0.0), last)


def test_a_film_that_heat_makes_too_thin_is_unresolved(monkeypatch):
    """Resolution is that of the final film, not of the Newtonian one it started from."""
    conditions = replace(CIRCULAR, load=320.0, entrainment_speed=10.0)
    plain = solve_contact(conditions, COARSE)
    heat = FilmHeat(conditions=conditions, solids=(STEEL, STEEL))
    flow = GeneralizedFlow(conditions=conditions, rheology=EYRING, heat=heat)
    heated = solve_by_continuation(flow, COARSE)[0]
    films = [solution.film_minimum_dimensionless.finest for solution in (plain, heated)]
    assert films[1] < 0.95 * films[0]
    mesh = float(plain.X[1] - plain.X[0])
    between = np.mean(films) / (scale_contact(conditions).curvature_x * mesh**2)
    monkeypatch.setattr("oilfilm.ehl.multigrid.history.RESOLVED", between)
    monkeypatch.setattr("oilfilm.ehl.multigrid.film_values.LARGEST_BAR", 1.0)
    assert solve_contact(conditions, COARSE).resolved
    heated = solve_by_continuation(flow, COARSE)[0]
    assert heated.converged and not heated.resolved
    assert "unresolved" in heated.message
