"""Contacts that no attempt of `verification/run.py --robustness` led to a solution, and what solves them now."""

from __future__ import annotations

from dataclasses import replace
from math import inf

import pytest
from verification.contacts import from_groups, moes
from verification.draws import draws

from oilfilm.ehl import DensityLaw, Lubricant, MoesConditions, SolverOptions, ViscosityLaw, solve_contact, solver
from oilfilm.ehl.closed_form.film import moes_film_nijenbanning
from oilfilm.ehl.closed_form.hertz import hertz_coefficients
from oilfilm.ehl.multigrid import full_multigrid
from oilfilm.ehl.multigrid.full_multigrid import ATTEMPTS, DIVERGED, guarded_cycle
from oilfilm.ehl.multigrid.history import MINIMUM
from oilfilm.ehl.scaling import scale_contact
from oilfilm.ehl.solver import solve_attempts, solve_levels

SEED = 20261124  # of an earlier sweep of 1000
OIL = Lubricant(viscosity=0.05, pressure_viscosity=20e-9)


def draw(number):
    return draws(number + 1, SEED)[number].conditions


def test_film_guess_of_an_isoviscous_oil_knows_no_pressure_viscosity():
    """Its pressure-viscosity coefficient only scales the pressure: five times the film at M 889, L 11."""
    conditions = MoesConditions(
        load_parameter=889.0,
        lubricant_parameter=11.0,
        radius_ratio=2.5,
        lubricant=replace(OIL, viscosity_law=ViscosityLaw.ISOVISCOUS),
    )
    f = hertz_coefficients(2.5)[0]
    formula = moes_film_nijenbanning(889.0, 0.0, 2.5) / (f**2 * 889.0 ** (2 / 3))
    assert scale_contact(conditions).film_guess == pytest.approx(formula, rel=1e-12)
    thickened = scale_contact(replace(conditions, lubricant=OIL)).film_guess
    assert thickened / formula == pytest.approx(5.0, rel=0.2)


# draw 479 is isoviscous with M 889 at R_x/R_y 2.5, 661 has M 2324 at R_x/R_y 3.4 and 39 degrees
@pytest.mark.parametrize(("number", "points"), [(479, 513), pytest.param(661, 513, marks=pytest.mark.slow)])
def test_another_mesh_on_levels_that_resolve_the_film(number, points):
    """From Hertz, on levels with a negative film, both ran away."""
    solution, _ = solve_levels(draw(number), SolverOptions(points=points), attempts=ATTEMPTS[1:2])
    assert solution.converged
    assert solution.record.residual[-1] < 1e-3


# M 17443 and 23 500 as in bearings under 3.1 and 3.5 GPa; the first took 13 undone cycles and three attempts
@pytest.mark.parametrize(("load", "lubricant", "ratio"), [(17443.0, 17.5, 0.018), (23500.0, 9.9, 0.031)])
def test_heavy_slow_contacts_of_bearings_need_no_undone_cycle(load, lubricant, ratio):
    """They start damped, on a level that resolves the film: no film on the way is negative."""
    solution, result = solve_levels(moes(load, lubricant, ratio), SolverOptions(points=513))
    assert solution.converged and solution.resolved
    assert solution.record.fallbacks == ()
    assert all(level.film[-1][MINIMUM] > 0.0 for level in result.levels)


def test_the_edge_of_a_cavity_comes_to_rest_where_oil_runs_across_the_lines():
    """Traces of pressure on cavitated nodes kept the sweeps at a residual of 1e-3 to 3e-3, in 21 cycles."""
    conditions = MoesConditions(
        load_parameter=148.4, lubricant_parameter=0.1094, radius_ratio=0.0302, lubricant=OIL, entrainment_angle=1.0
    )
    solution, _ = solve_attempts(conditions, SolverOptions(points=129), attempts=ATTEMPTS[:1])
    assert solution.converged
    assert len(solution.record.residual) <= 10
    assert solution.record.residual[-1] < 2e-4


def test_cycles_of_a_thick_film_that_swing_come_to_rest():
    """Its edge pressure overshot the load by 1.25 to 1.5 a cycle; three halvings of the damping did not help."""
    thin = replace(OIL, viscosity=0.0362, pressure_viscosity=24.9e-9, density_law=DensityLaw.INCOMPRESSIBLE)
    conditions = MoesConditions(load_parameter=9.37, lubricant_parameter=21.0, radius_ratio=0.3078, lubricant=thin)
    solution, _ = solve_attempts(conditions, SolverOptions(points=513), attempts=ATTEMPTS[:1])
    assert solution.converged
    assert not solution.record.fallbacks
    assert len(solution.record.residual) <= 12


def test_a_cycle_after_which_the_equations_hold_is_not_undone():
    """Ten times a residual of 1e-9 is no divergence; of draw 661 it halved the damping till nothing was left."""
    conditions = MoesConditions(load_parameter=50.0, lubricant_parameter=5.0, radius_ratio=1.0, lubricant=OIL)
    _, state = solve_attempts(conditions, SolverOptions(points=65))
    equations = guarded_cycle(state, len(state.levels) - 1, last=1e-9)
    assert equations != DIVERGED
    assert 1e-8 < equations[0] < inf


def test_a_thick_film_whose_entrainment_turns_is_not_resolved_by_its_box():
    """Two thirds of the bar and more are of the load outside, which no mesh narrows: told, and not refined for."""
    conditions = from_groups(moes(6.0, 20.0, 0.27), rotation=0.39)
    solution = solve_contact(conditions, SolverOptions())
    assert solution.converged
    assert not solution.resolved
    assert "by the load outside the box" in solution.message
    assert "more points" not in solution.message
    assert solution.P.shape[0] < 1025


def test_a_bar_just_above_the_tolerance_costs_no_large_mesh(monkeypatch):
    """The films of 129 points stay, and the message says what the next mesh costs."""
    conditions = moes(20.0, 5.0)
    coarse = solve_contact(conditions, SolverOptions(points=129))
    monkeypatch.setattr(solver, "_first_points", lambda *_: 129)
    near = SolverOptions(tolerance=coarse.widest_bar / 1.2)
    assert solve_contact(conditions, near).X.size > 129
    monkeypatch.setattr(solver, "LARGE_MESH", 1.0)
    stopped = solve_contact(conditions, near)
    assert stopped.X.size == 129
    assert "costs four times" in stopped.message
    assert solve_contact(conditions, SolverOptions(tolerance=coarse.widest_bar / 1.5)).X.size > 129


def test_soft_contacts_without_a_solution_are_told_after_one_attempt(monkeypatch):
    """Only one attempt is made, and the message names the bounds."""
    made = []
    monkeypatch.setattr(full_multigrid, "full_multigrid", lambda *arguments: made.append(arguments))
    solution = solve_contact(moes(9e3, 0.1), SolverOptions(points=65))
    assert len(made) == 1
    assert "outside of what is solved" in solution.message
