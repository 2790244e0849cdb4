"""The contact solver against what must hold, and against a reference study.

Reference values, grid-converged, box named (project's method notes): circular contact M 20, L 10, Roelands z 0.68,
alpha 22 1/GPa, Dowson-Higginson, box [-4.5, 1.5] x [-3, 3] a: Hc 0.430856 +- 2e-6, Hmin 0.29259 +- 1e-5 a^2/R,
H0 -0.54900. Inner race of a 6208, all silicon nitride, 500 N, box [-16.5, 1.5] a x [-2.25, 2.25] b: h_c 0.91407,
h_min 0.8255 +- 0.0012 um.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing.library.lubricants import load_lubricant
from oilfilm.ehl import (
    ContactConditions,
    DensityLaw,
    Lubricant,
    MoesConditions,
    SolverOptions,
    ViscosityLaw,
    solve_contact,
    solver,
)
from oilfilm.ehl.conditions import moes_groups
from oilfilm.ehl.multigrid import full_multigrid
from oilfilm.ehl.multigrid.cycle import cycle, refresh_factors, start_level, update_film
from oilfilm.ehl.multigrid.film_values import extrapolate
from oilfilm.ehl.multigrid.full_multigrid import (
    ATTEMPTS,
    Progress,
    choose_domain,
    contact_multigrid,
    solve_with_fallbacks,
    start_from_hertz,
)
from oilfilm.ehl.multigrid.history import FINISHED, central_film
from oilfilm.ehl.multigrid.levels import Damping
from oilfilm.ehl.scaling import scale_contact
from oilfilm.ehl.solver import solve_attempts

from ..reference.ehl.uniform_flow import UniformFlow

OIL = Lubricant(viscosity=0.05, pressure_viscosity=22e-9, roelands_z=0.68)
CIRCULAR = MoesConditions(load_parameter=20.0, lubricant_parameter=10.0, lubricant=OIL)
BOX = (-4.5, 1.5, 3.0)
INNER_500N = ContactConditions(
    load=500.0,
    radius_x=4.8e-3,
    radius_y=1.0 / (1.0 / 6e-3 - 1.0 / 6.17e-3),
    reduced_modulus=310e9 / (1.0 - 0.26**2),
    entrainment_speed=15.0796,
    lubricant=Lubricant(viscosity=0.0261, pressure_viscosity=18e-9),
)


@cache
def circular(points):
    return solve_contact(CIRCULAR, SolverOptions(points=points, domain=BOX))


def test_circular_reference():
    """257 points, extrapolated: the mesh error left is below the stated uncertainty and 0.05 %."""
    solution = circular(257)
    assert solution.converged
    assert solution.resolved
    assert_allclose(solution.film_central_dimensionless.value, 0.430856, rtol=5e-4)
    assert_allclose(solution.film_minimum_dimensionless.value, 0.29259, rtol=5e-4)
    assert_allclose(solution.approach_dimensionless.finest, -0.54900, rtol=2e-3)  # of the finest grid, not extrapolated
    assert abs(solution.film_central_dimensionless.value - 0.430856) < solution.film_central_dimensionless.uncertainty


def test_6208_inner_race_reference():
    solution = solve_contact(INNER_500N, SolverOptions(points=513, domain=(-16.5, 1.5, 2.25)))
    assert solution.converged
    assert_allclose(solution.film_central * 1e6, 0.91407, rtol=5e-3)
    assert_allclose(solution.film_minimum * 1e6, 0.8255, atol=0.0012 + 0.005 * 0.8255)


def test_central_film_is_second_order():
    """Errors against the reference on 65, 129 and 257 points fall by four; 0.15 for the change of the outlet."""
    errors = [0.430856 - circular(points).film_central_dimensionless.finest for points in (65, 129, 257)]
    assert_allclose(np.log2(np.divide(errors[:-1], errors[1:])), 2.0, atol=0.15)


def test_cycles_do_not_grow_with_the_grid():
    assert circular(257).record.cycles <= circular(65).record.cycles + 1


def test_convergence_record_is_what_it_says():
    record = circular(129).record
    assert record.cycles == len(record.residual) == len(record.force_error) == len(record.film_change)
    assert abs(record.force_error[-1]) < FINISHED[1]
    assert record.residual[-1] < 0.2 * record.residual[0]
    assert record.fallbacks == ()


def test_load_is_carried():
    """Integral of the pressure returned = 2 pi/3, to the tolerance of the load balance."""
    s = circular(129)
    hx, hy = s.X[1] - s.X[0], s.Y[1] - s.Y[0]
    assert_allclose(s.P.sum() * hx * hy, 2.0 * np.pi / 3.0, rtol=FINISHED[1])


def test_pressure_is_never_negative_and_film_never_zero():
    s = circular(129)
    assert s.P.min() >= 0.0
    assert s.H.min() > 0.0


def test_cavitated_region_lies_downstream_and_obeys_complementarity():
    """Where P = 0 inside the box the film flow must not converge: d(rho H)/dX >= 0, to the stencil's error."""
    s = circular(257)
    assert np.all(s.P[1:-1, s.Y.size // 2][s.X[1:-1] < 0.9] > 0.0)
    cavitated = (s.P == 0.0) & (s.X[:, None] > 1.0)
    cavitated[-1], cavitated[:, [0, -1]] = False, False
    growth = np.zeros_like(s.H)
    growth[2:] = 1.5 * s.H[2:] - 2.0 * s.H[1:-1] + 0.5 * s.H[:-2]
    assert growth[cavitated].min() > -1e-3 * s.H.min()


def test_solution_is_symmetric_about_the_entrainment():
    """The half-domain solution mirrored, and the full-domain solve that knows of no symmetry, agree."""
    half = circular(65)
    assert np.array_equal(half.P, half.P[:, ::-1])
    contact = replace(scale_contact(CIRCULAR), curvature_xy=1e-9)  # not recognised as aligned
    options = SolverOptions(points=65, domain=BOX)
    state = contact_multigrid(contact, BOX, options, ATTEMPTS[0])
    level = state.levels[-1]
    assert not level.grid.symmetric
    start_level(state, len(state.levels) - 1, half.P.T)
    state.approach = half.approach_dimensionless.finest
    update_film(state, len(state.levels) - 1)
    for _ in range(12):
        cycle(state, len(state.levels) - 1)
    full = level.P
    assert np.abs(full - full[::-1]).max() < 1e-4  # lines are relaxed in one direction: equal once converged
    assert_allclose(central_film(level.grid, level.H), half.film_central_dimensionless.finest, rtol=3e-4)


def test_si_and_moes_input_agree_to_round_off():
    m, l = moes_groups(INNER_500N)
    moes = MoesConditions(
        load_parameter=m,
        lubricant_parameter=l,
        radius_ratio=INNER_500N.radius_x / INNER_500N.radius_y,
        lubricant=INNER_500N.lubricant,
    )
    options = SolverOptions(points=65, domain=(-8.0, 1.5, 2.25))
    one, other = solve_contact(INNER_500N, options), solve_contact(moes, options)
    assert_allclose(one.P, other.P, atol=1e-9)  # round-off of the groups, carried through the cycles
    assert_allclose(one.film_central_dimensionless.value, other.film_central_dimensionless.value, rtol=1e-9)
    assert other.film_central is None
    assert_allclose(one.film_central, one.film_central_dimensionless.value * one.film_scale, rtol=1e-14)


def test_open_box_does_not_feel_its_size():
    """M 5, L 0.5 in two open boxes, one twice the other: the film moves by less than 0.6 %. Closed boxes: over 3 %."""
    thick = MoesConditions(load_parameter=5.0, lubricant_parameter=0.5, lubricant=replace(OIL, roelands_z=None))
    contact = scale_contact(thick)

    def film(box, points, is_open):
        options = SolverOptions(points=points, domain=None if is_open else box)
        state = contact_multigrid(contact, box, options, ATTEMPTS[0])
        index = len(state.levels) - 1
        X, Y = state.levels[index].grid.X[None, :], state.levels[index].grid.Y[:, None]
        state.approach = 0.3
        start_level(state, index, 0.8 * np.sqrt(np.maximum(1.0 - X**2 - Y**2, 0.0)))
        for _ in range(14):
            cycle(state, index)
        return central_film(state.levels[index].grid, state.levels[index].H)

    small, large = (-8.0, 2.0, 5.0), (-17.0, 3.0, 10.0)
    assert_allclose(film(small, 65, True), film(large, 129, True), rtol=6e-3)
    assert abs(film(small, 65, False) / film(large, 129, False) - 1.0) > 0.03


def test_box_is_open_by_default_and_covers_a_thick_film():
    box = choose_domain(scale_contact(MoesConditions(load_parameter=10.0, lubricant_parameter=25.0, lubricant=OIL)))
    assert box[0] < -10.0
    thin = choose_domain(scale_contact(replace(CIRCULAR, load_parameter=500.0)))
    assert -5.0 < thin[0] < -2.5


def test_box_turns_without_a_bend_from_one_of_its_film_to_one_of_its_load():
    """Slopes over the load change by the square of a small step, not by the step."""
    step = 0.01
    loads = 8.0 * np.exp(step * np.arange(-150, 150))
    inlets = [-choose_domain(scale_contact(replace(CIRCULAR, load_parameter=load)))[0] for load in loads]
    bends = np.diff(np.log(inlets), 2) / step**2
    assert np.abs(bends).max() < 10.0  # 69 where they turned at once


def test_thin_film_pressure_goes_to_hertz():
    """Rising load at fixed L: the pressure leaves the inlet and approaches Hertz' half-ellipsoid."""
    distance = []
    for load in (20.0, 100.0, 500.0):
        s = solve_contact(replace(CIRCULAR, load_parameter=load), SolverOptions(points=129, domain=BOX))
        hertz = np.sqrt(np.maximum(1.0 - s.X[:, None] ** 2 - s.Y[None, :] ** 2, 0.0))
        distance.append(np.sqrt(np.mean((s.P - hertz) ** 2)))
    assert distance[0] > 2.0 * distance[1] > 3.0 * distance[2]


def test_rigid_isoviscous_limit():
    """M 0.5: undeformed, isoviscous. Half of Kapitza's (1955) pressure, P > 0 upstream only, carries the load

    integral over X < 0 of lambda |X|/((3 + 2 D) H^2) = lambda pi sqrt(2)/(5 sqrt(Hc)) ... for D = 1; the true outlet
    is not at X = 0 but a little behind, which raises the load: by how much follows from the direct solution.
    """
    oil = replace(OIL, viscosity_law=ViscosityLaw.ISOVISCOUS, density_law=DensityLaw.INCOMPRESSIBLE)
    conditions = MoesConditions(load_parameter=0.5, lubricant_parameter=0.0, lubricant=oil)
    solution = solve_contact(conditions, SolverOptions(points=129))
    contact = scale_contact(conditions)
    # with H = Hc + r^2/2: integral over the half plane of |X|/H^2 = 2 * integral r^2/(Hc + r^2/2)^2 dr = pi sqrt(2/Hc)
    half_kapitza = (contact.speed * np.pi * np.sqrt(2.0) / (5.0 * contact.load)) ** 2
    assert solution.converged
    film = solution.film_central_dimensionless
    # the direct solution with Reynolds' condition of `tools/verification/run.py --section rigid`
    assert abs(film.value / half_kapitza / 1.2501 - 1.0) < film.relative_uncertainty + 0.003
    assert film.relative_uncertainty < 0.05


@pytest.mark.parametrize(
    ("load", "lubricant_parameter", "ratio", "angle"),
    [
        (12.0, 25.0, 0.055, 0.0),  # a ball that carries centrifugal force only
        (200.0, 10.0, 1.0, 0.0),
        (700.0, 12.0, 0.03, 0.0),  # a loaded ball of a deep groove bearing
        (2000.0, 20.0, 0.02, 0.0),
        (100.0, 8.0, 0.3, 0.5),  # entrainment at an angle
        (300.0, 15.0, 2.0, 0.0),  # entrainment along the major axis
        (5.0, 0.0, 1.0, 0.0),
    ],
)
def test_uncertainty_covers_the_next_finer_grid(load, lubricant_parameter, ratio, angle):
    """The value extrapolated from 257 points lies within the error bar of the one from 129, and the bars shrink."""
    oil = Lubricant(viscosity=0.05, pressure_viscosity=18e-9)
    conditions = MoesConditions(
        load_parameter=load,
        lubricant_parameter=lubricant_parameter,
        radius_ratio=ratio,
        lubricant=oil,
        entrainment_angle=angle,
    )
    domain = choose_domain(scale_contact(conditions))
    coarse = solve_contact(conditions, SolverOptions(points=129))
    fine = solve_contact(conditions, SolverOptions(points=257))
    assert fine.converged
    assert fine.record.fallbacks == ()
    assert domain == pytest.approx(choose_domain(scale_contact(conditions)))
    for name in ("film_central_dimensionless", "film_minimum_dimensionless"):
        bar = getattr(coarse, name).uncertainty + getattr(fine, name).uncertainty
        assert abs(getattr(coarse, name).value - getattr(fine, name).value) < bar
        assert getattr(fine, name).uncertainty < getattr(coarse, name).uncertainty


def test_tolerance_refines_until_the_bars_are_small_enough():
    loose = solve_contact(CIRCULAR, SolverOptions(points=513, domain=BOX, tolerance=0.01))
    tight = solve_contact(CIRCULAR, SolverOptions(points=513, domain=BOX, tolerance=0.002))
    assert loose.X.size < tight.X.size <= 513
    for solution, tolerance in ((loose, 0.01), (tight, 0.002)):
        assert solution.resolved
        for film in (solution.film_central_dimensionless, solution.film_minimum_dimensionless):
            assert film.uncertainty <= tolerance * film.value
    assert_allclose(tight.film_central_dimensionless.value, 0.430856, rtol=0.002)


def test_a_mesh_too_coarse_for_the_tolerance_is_refined_from_its_solution(monkeypatch):
    """Little more work than on the last mesh alone, the same films."""
    monkeypatch.setattr(solver, "FIRST_FINENESS", (0.1, 0.1))
    refined = solve_contact(CIRCULAR, SolverOptions(points=513, domain=BOX, tolerance=0.01))
    alone = solve_contact(CIRCULAR, SolverOptions(points=refined.X.size, domain=BOX))
    assert refined.message == "converged"
    assert refined.record.fft_equivalents < 1.1 * alone.record.fft_equivalents
    for film in ("film_central_dimensionless", "film_minimum_dimensionless"):
        assert_allclose(getattr(refined, film).value, getattr(alone, film).value, rtol=3e-4)


def test_films_stand_unresolved_where_a_finer_mesh_does_not_converge(monkeypatch):
    """Nothing bears out their bars, which are told; of 300 random contacts one was off by three times its bar."""

    def unsettled(*arguments):
        assert arguments[3] == ()  # nothing is tried anew where coarser films stand
        finer, result = solver._solve(*arguments[:2], ATTEMPTS, arguments[4])
        return replace(finer, converged=False, message="not converged"), result

    monkeypatch.setattr(solver, "FIRST_FINENESS", (0.4, 0.4))
    monkeypatch.setattr(solver, "_solve_finer", unsettled)
    s = solve_contact(CIRCULAR, SolverOptions(points=513, domain=BOX, tolerance=0.01))
    coarse = solve_contact(CIRCULAR, SolverOptions(points=s.X.size, domain=BOX))
    assert s.converged and not s.resolved and s.widest_bar == coarse.widest_bar
    assert "unresolved" in s.message and "finer mesh did not converge" in s.message


def test_a_tight_tolerance_stops_the_cycles_later():
    """What the cycles leave counts in the bars: 1e-3 of the film at the residual they stop at by default."""
    s = solve_contact(CIRCULAR, SolverOptions(points=1025, domain=BOX, tolerance=0.001))
    assert s.message == "converged" and s.widest_bar <= 0.001
    assert s.X.size <= 513


def test_tolerance_beyond_the_budget_is_said():
    s = solve_contact(CIRCULAR, SolverOptions(points=129, domain=BOX, tolerance=1e-4))
    assert s.converged and s.resolved
    assert "not reached at 129 points" in s.message


def test_films_are_within_one_percent_by_default():
    """Light and heavy, wide, oblique and turning contacts: the mesh is chosen so that both bars are within 1 %."""
    for conditions in (CIRCULAR, replace(CIRCULAR, load_parameter=300.0), replace(OBLIQUE, load_parameter=30.0)):
        s = solve_contact(conditions)
        assert s.message == "converged"
        assert s.film_central_dimensionless.relative_uncertainty <= 0.01
        assert s.film_minimum_dimensionless.relative_uncertainty <= 0.01


@pytest.mark.parametrize("tolerance", [0.0, -1.0, 1.0, float("nan")])
def test_bad_tolerance(tolerance):
    with pytest.raises(ValueError, match="tolerance"):
        SolverOptions(tolerance=tolerance)


def test_turned_contact_is_the_same_contact():
    """Entrainment at 90 degrees = principal directions exchanged: same film in metres, same verdict on the mesh."""
    oil = Lubricant(viscosity=0.04, pressure_viscosity=20e-9)
    turned = ContactConditions(
        load=15.0,
        radius_x=0.0125,
        radius_y=0.05,
        reduced_modulus=110e9,
        entrainment_speed=0.09,
        lubricant=oil,
        entrainment_angle=np.pi / 2,
    )
    exchanged = replace(turned, radius_x=0.05, radius_y=0.0125, entrainment_angle=0.0)
    box = (-4.0, 1.5, 3.0)
    one, other = (solve_contact(c, SolverOptions(points=129, domain=box)) for c in (turned, exchanged))
    assert one.resolved == other.resolved
    for film in ("film_central_dimensionless", "film_minimum_dimensionless"):
        finest = [getattr(s, film).finest * s.film_scale for s in (one, other)]
        assert_allclose(*finest, rtol=1e-3)  # two iterations on one grid, from different starts


def test_unresolved_is_said():
    s = solve_contact(replace(CIRCULAR, load_parameter=1000.0), SolverOptions(points=65))
    assert not s.resolved
    assert "unresolved" in s.message or not s.converged


def test_film_thicker_than_the_paraboloid_allows_is_none():
    s = solve_contact(replace(INNER_500N, load=0.1), SolverOptions(points=65))
    assert not s.resolved and not s.converged
    assert s.film_central is None
    assert "no paraboloid" in s.message


def test_not_converged_is_a_result():
    """One cycle is too few; Newton's method, the last attempt, is left out."""
    s, _ = solve_attempts(CIRCULAR, SolverOptions(points=65, domain=BOX, max_cycles=1), attempts=ATTEMPTS[:-1])
    assert not s.converged
    assert s.film_central is None
    assert "not converged" in s.message
    assert s.record.fallbacks  # everything was tried, and is on record


def test_a_thinned_solution_keeps_edges_and_origin():
    solution = circular(129)
    thin = solution.thinned(50)
    assert (thin.X.size, thin.X[0], thin.X[-1]) == (33, solution.X[0], solution.X[-1])
    assert thin.P.shape == thin.H.shape == (thin.X.size, thin.Y.size)
    assert_allclose(thin.Y, solution.Y[::4])
    assert np.array_equal(thin.H, solution.H[::4, ::4])
    assert solution.thinned(129) is solution


def test_damping_halves_the_changes():
    damping = Damping()
    assert damping.halved().jacobi == 0.5 * damping.jacobi
    assert damping.halved().switch == damping.switch


@pytest.mark.slow
@pytest.mark.parametrize("points", [513, 1025])
def test_circular_reference_on_fine_grids(points):
    solution = circular(points)
    assert_allclose(solution.film_central_dimensionless.value, 0.430856, rtol=1e-4)
    assert_allclose(solution.film_minimum_dimensionless.value, 0.29259, rtol=2e-4)
    assert solution.record.cycles <= circular(65).record.cycles + 1


OBLIQUE = MoesConditions(
    load_parameter=100.0,
    lubricant_parameter=8.0,
    radius_ratio=0.05,
    lubricant=Lubricant(viscosity=0.05, pressure_viscosity=18e-9),
    entrainment_angle=0.5,
)


def test_oblique_entrainment_on_two_grids():
    """A grid along the ellipse and one along the entrainment share neither stencil nor gap: films within their bars.

    The minimum's is 2.7 % on the grid along the entrainment, where the steps of its levels fall too fast.
    """
    straight, options = solve_contact(OBLIQUE, SolverOptions(points=257)), SolverOptions(points=257)
    turned = scale_contact(OBLIQUE, along_entrainment=True)
    assert turned.frame_angle == 0.5
    assert scale_contact(OBLIQUE).frame_angle == 0.0
    outcome = solve_with_fallbacks((turned, turned), choose_domain(turned), options, Progress())
    assert outcome.converged
    for kind, film in enumerate((straight.film_central_dimensionless, straight.film_minimum_dimensionless)):
        other = extrapolate(outcome.levels, kind)
        assert abs(film.value - other.value) < film.uncertainty + other.uncertainty < (0.02, 0.035)[kind] * film.value
        assert abs(film.value - other.value) < 0.01 * film.value


def test_mirrored_entrainment_is_the_same_contact():
    """Angle and minus the angle: the films of one are those of the other, mirrored."""
    one, other = (solve_contact(replace(OBLIQUE, entrainment_angle=a), SolverOptions(points=129)) for a in (0.5, -0.5))
    assert_allclose(one.H, other.H[:, ::-1], rtol=2e-3)  # lines are relaxed in one direction: equal once converged


def test_spin_turns_the_film():
    """Mean spin: mirrored by its sign, first order in the difference of the sides, second in the central film."""
    still = replace(
        INNER_500N, load=200.0, radius_x=4e-3, radius_y=6e-2, entrainment_speed=10.0, slide_roll_ratio=0.0, spin=0.0
    )
    plain = solve_contact(still, SolverOptions(points=129))
    rim = plain.semi_axis_x * plain.semi_axis_ratio / still.entrainment_speed
    spins = [solve_contact(replace(still, mean_spin=0.1 * s / rim), SolverOptions(points=129)) for s in (1, -1, 2)]
    assert all(s.converged for s in spins)
    assert_allclose(spins[0].H, spins[1].H[:, ::-1], rtol=2e-3)
    origin, side = np.abs(plain.X).argmin(), np.abs(plain.Y - 0.8 * plain.semi_axis_ratio).argmin()
    differences = [s.H[origin, side] - s.H[origin, -1 - side] for s in spins]
    assert differences[0] < 0.0  # u = u_m - omega y is slower where y > 0
    assert_allclose(differences[2] / differences[0], 2.0, atol=0.1)
    assert abs(spins[2].film_central / plain.film_central - 1.0) < 0.005
    assert spins[2].film_minimum < 0.95 * plain.film_minimum


def test_a_small_rotation_is_left_out():
    c = replace(INNER_500N, mean_spin=1.0)
    assert scale_contact(c).symmetric
    assert not scale_contact(replace(c, mean_spin=1e4)).symmetric


def test_flow_factors_of_one_change_nothing():
    """Cycle by cycle; the film comes to rest on another way, as the model acts on fine meshes only."""
    model, options = UniformFlow(), SolverOptions(points=65)
    plain, scaled = (
        contact_multigrid(scale_contact(CIRCULAR), BOX, replace(options, domain=BOX), ATTEMPTS[0], flow)
        for flow in (None, model)
    )
    finest = len(plain.levels) - 1
    for state in (plain, scaled):
        start_from_hertz(state, finest)
        for _ in range(3):
            refresh_factors(state, finest)
            cycle(state, finest)
    assert model.calls == 3
    assert_allclose(scaled.levels[-1].H, plain.levels[-1].H, rtol=1e-12)
    film, alone = (solve_contact(CIRCULAR, options, flow).film_central_dimensionless for flow in (model, None))
    assert_allclose(film.finest, alone.finest, rtol=1e-3)


def test_flow_factors_act_as_speed_and_viscosity():
    """Half the Couette flow at half the Poiseuille flow is the same equation; on the full grid, too."""
    options = SolverOptions(points=129, domain=BOX)
    plain = solve_contact(CIRCULAR, options).film_central_dimensionless.value
    for symmetric in (True, False):
        halved = solve_contact(CIRCULAR, options, UniformFlow(0.5, 0.5, symmetric))
        assert halved.converged
        assert_allclose(halved.film_central_dimensionless.value, plain, rtol=1e-3)  # two iterations, each to 3e-4


def test_flow_factor_on_the_viscosity():
    """Twice the Poiseuille flow everywhere is half the speed, in the same box."""
    options = SolverOptions(points=129, domain=(-6.0, 1.5, 2.25))
    thin = solve_contact(INNER_500N, options, UniformFlow(2.0, 1.0))
    slow = solve_contact(replace(INNER_500N, entrainment_speed=0.5 * INNER_500N.entrainment_speed), options)
    assert_allclose(thin.film_central, slow.film_central, rtol=2e-3)


@pytest.mark.slow
def test_a_film_that_rests_where_the_equations_do_not_hold_is_refused():
    """M 1000, L 2 in a box of 4 semi-axes on 129 points: whatever comes to rest there is no film to give."""
    solution = solve_contact(
        replace(CIRCULAR, load_parameter=1000.0, lubricant_parameter=2.0),
        SolverOptions(points=129, domain=(-4.0, 1.5, 2.5)),
    )
    assert not solution.resolved
    assert solution.message != "converged"


def test_long_ellipse_starts_on_a_mesh_for_its_spike():
    """Entrainment along the longer axis at M 200, L 24: comes to rest at the first attempt."""
    oil = Lubricant(viscosity=0.0734, pressure_viscosity=26.5e-9, density_law=DensityLaw.INCOMPRESSIBLE)
    conditions = MoesConditions(load_parameter=200.0, lubricant_parameter=24.0, radius_ratio=2.45, lubricant=oil)
    solution = solve_contact(conditions, SolverOptions(points=129))
    assert solution.converged
    assert solution.record.fallbacks == ()


def test_every_attempt_is_on_record():
    s = solve_contact(CIRCULAR, SolverOptions(points=65, domain=BOX, max_cycles=1))
    circle = scale_contact(CIRCULAR)
    assert [name for name in s.record.fallbacks if not name.startswith("cycle")] == [
        attempt.name for attempt in ATTEMPTS[1:] if attempt.applies(circle, circle)
    ]


def test_free_volume_laws_in_the_contact():
    """Squalane by Tait and Doolittle: the film of the Roelands oil of equal viscosity and slope, within a tenth."""
    laws = {"viscosity_law": ViscosityLaw.TAIT_DOOLITTLE, "density_law": DensityLaw.TAIT}
    oils = load_lubricant("squalane", 298.15, **laws), load_lubricant("squalane", 298.15)
    films = []
    for oil in oils:
        contact = replace(
            INNER_500N, load=20.0, radius_x=12.7e-3, radius_y=12.7e-3, entrainment_speed=1.0, lubricant=oil
        )
        solution = solve_contact(contact, SolverOptions(points=129))
        assert solution.converged
        assert solution.record.fallbacks == ()
        films.append(solution.film_central)
    assert films[0] != pytest.approx(films[1], rel=0.005)
    assert films[0] == pytest.approx(films[1], rel=0.1)


def test_equations_of_a_solution_hold_and_its_oil_is_conserved():
    record = solve_contact(CIRCULAR, SolverOptions(points=129)).record
    assert 0.0 < record.residual[-1] < FINISHED[0]
    assert abs(record.mass_imbalance) <= record.residual[-1]


def test_a_film_at_rest_without_the_equations_is_not_converged(monkeypatch):
    """Whatever film and load say: above the limit of the residual there is no film value."""
    monkeypatch.setattr("oilfilm.ehl.multigrid.history.CONVERGED", (1e-12, 1e-3))
    solution = solve_contact(INNER_500N, SolverOptions(points=65, max_cycles=6))
    assert not solution.converged
    assert solution.film_central is None and solution.film_minimum_uncertainty is None


def test_wide_bars_are_unresolved(monkeypatch):
    """A mesh that is fine enough for the film, and bars beyond the limit: said with the bar."""
    solution = solve_contact(replace(CIRCULAR, load_parameter=700.0), SolverOptions(points=129))
    bar = solution.film_minimum_dimensionless.relative_uncertainty
    monkeypatch.setattr("oilfilm.ehl.multigrid.film_values.LARGEST_BAR", 0.5 * bar)
    monkeypatch.setattr("oilfilm.ehl.multigrid.history.RESOLVED", 0.1)
    solution = solve_contact(replace(CIRCULAR, load_parameter=700.0), SolverOptions(points=129))
    assert solution.converged and not solution.resolved
    assert "error bar" in solution.message


def test_minimum_is_never_above_the_centre():
    """Extrapolated apart, the two can cross on coarse meshes; the bar then reaches the centre."""
    for load in (300.0, 1500.0):
        for ratio in (0.02, 1.0):
            s = solve_contact(replace(CIRCULAR, load_parameter=load, radius_ratio=ratio), SolverOptions(points=65))
            central, minimum = s.film_central_dimensionless, s.film_minimum_dimensionless
            assert not s.converged or minimum.value <= central.value


def test_attempts_end_with_the_work_they_may_take(monkeypatch):
    """The first attempt is always made; the others are named as left out."""
    monkeypatch.setattr(full_multigrid, "MAX_WORK", 0)
    s = solve_contact(CIRCULAR, SolverOptions(points=65, max_cycles=1))
    assert not s.converged
    taken = [name for name in s.record.fallbacks if not name.startswith("cycle")]
    assert taken and all(name.endswith(full_multigrid.TOO_MUCH_WORK) for name in taken)
