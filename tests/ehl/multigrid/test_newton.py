"""Newton's method on the equations of the multigrid: its derivative, its certificate, its reach."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy import sparse
from verification.contacts import DEGREE, OIL, SKEWED, TURNING
from verification.contacts import moes as groups

from oilfilm.ehl import SolverOptions, solve_contact
from oilfilm.ehl.multigrid.cycle import load_error, relative_residual
from oilfilm.ehl.multigrid.full_multigrid import ATTEMPTS
from oilfilm.ehl.multigrid.history import film_values
from oilfilm.ehl.multigrid.jacobian import TAPER, deflected, linearise, load_row, near_field, product
from oilfilm.ehl.multigrid.newton import TOLERANCE, Border, certify, factor_bordered, nested_dissection, solve_bordered
from oilfilm.ehl.solver import solve_attempts

from ..oil.test_lubricant import SQUALANE

moes = partial(groups, oil=OIL)
ROUND_OFF = 1e-11  # of sums whose terms cancel, relative to the largest


CONTACTS = {
    "circular": moes(20.0, 10.0),
    "soft": moes(50.0, 0.5),
    "isoviscous": moes(50.0, 0.0),
    "wide": moes(100.0, 10.0, 0.1),
    "oblique": moes(100.0, 5.0, 0.3, 40.0 * DEGREE),
    "turning": TURNING,
    "free volume": moes(20.0, 5.0, oil=SQUALANE),
}


def solved(conditions, points=65, **options):
    """Solution and levels of the first attempt."""
    return solve_attempts(conditions, SolverOptions(points=points, **options), attempts=ATTEMPTS[:1])


@pytest.fixture(params=CONTACTS.values(), ids=CONTACTS.keys())
def state(request):
    return solved(request.param)[1]


def change(lin):
    """A change of the pressure of the fluid nodes and of the edge."""
    random = np.random.default_rng(91734)
    return 0.01 * lin.P * random.standard_normal(lin.P.shape)


def test_derivative_is_that_of_the_equations(state):
    """Against central differences, whose error is 1e-10 at this step."""
    index, step, rise = len(state.levels) - 1, 1e-3, 1e-3
    level, lin, approach = state.levels[-1], linearise(state, index), state.approach
    d = change(lin)
    sides = []
    for share in (step, -step):
        level.P, state.approach = lin.P + share * d, approach + share * rise
        sides.append(linearise(state, index))
    slope = (sides[0].residual - sides[1].residual) / (2.0 * step)
    ours = product(lin, d, deflected(state, index, d) + rise)
    inside = ~lin.edge
    assert np.abs(slope - ours)[inside].sum() < 1e-8 * np.abs(ours)[inside].sum()
    assert_allclose(-slope[lin.edge], ours[lin.edge], atol=1e-8 * np.abs(d).max())
    load = float((load_row(state, index, lin.load_by_film) * d).sum()) + lin.load_by_film * rise
    assert_allclose(load, (sides[1].load_error - sides[0].load_error) / (2.0 * step), rtol=1e-7)


def near_deflection(lin, d):
    """Tapered deflection by a node and its eight neighbours, term by term."""
    mirrored = np.concatenate((d[1:2] if lin.grid.symmetric else 0.0 * d[:1], d, 0.0 * d[:1]))
    padded = np.pad(mirrored, ((0, 0), (1, 1)))
    ny, nx = d.shape
    total = np.zeros_like(d)
    for j in range(3):
        for i in range(3):
            weight = TAPER[abs(j - 1)] * TAPER[abs(i - 1)] * lin.near[abs(j - 1), abs(i - 1)]
            total += weight * padded[j : j + ny, i : i + nx]
    return total


def test_near_field_is_the_derivative_with_a_near_deflection(state):
    lin = linearise(state, len(state.levels) - 1)
    d = change(lin)
    expected = product(lin, d, near_deflection(lin, d))
    ours = (near_field(lin) @ d.ravel()).reshape(d.shape)
    assert_allclose(ours, expected, rtol=0.0, atol=ROUND_OFF * np.abs(expected).max())


def test_bordered_system_in_a_given_order():
    """Against the dense solution; the near field is half the matrix."""
    random, shape = np.random.default_rng(20817), (9, 14)
    size = shape[0] * shape[1]
    order = nested_dissection(shape, (2, 3))
    assert sorted(order) == list(range(size))
    near = sparse.random(size, size, 0.05, rng=random, format="csr") + 4.0 * sparse.identity(size)
    matrix = near.toarray() + 0.01 * random.standard_normal((size, size))
    border = Border(column=random.random(size), row=random.random(size), corner=-0.3)
    right = random.random(size), 0.7
    for given in (order, None):
        factors = factor_bordered(near.tocsr(), border, given)
        p, h = solve_bordered(lambda v: matrix @ v, border, factors, right, 1e-12)
        whole = np.block([[matrix, border.column[:, None]], [border.row[None, :], np.array([[border.corner]])]])
        assert_allclose(np.append(p, h), np.linalg.solve(whole, np.append(*right)), rtol=1e-9)


@pytest.mark.parametrize("conditions", CONTACTS.values(), ids=CONTACTS.keys())
def test_certificate_of_a_solved_contact(conditions):
    """The equations hold to 1e-8 after a few steps, and the film stays within its bars."""
    solution, state = solved(conditions)
    certificate = certify(state)
    assert certificate.certified, certificate.message
    assert certificate.residual[-1] < TOLERANCE
    # with film and edge as the cycles leave them
    assert relative_residual(state, len(state.levels) - 1)[0] < 2.0 * TOLERANCE
    assert abs(load_error(state, len(state.levels) - 1)) < TOLERANCE
    assert len(certificate.residual) <= 6
    films = film_values(state.levels[-1].grid, state.levels[-1].H)
    for film, bar in zip(
        films, (solution.film_central_dimensionless, solution.film_minimum_dimensionless), strict=True
    ):
        assert abs(film - bar.finest) < bar.uncertainty
        assert abs(film - bar.finest) <= 1.001 * certificate.film_change * film


@pytest.mark.parametrize("name", ["circular", "wide", "oblique"])
def test_a_state_stopped_after_one_cycle_leads_to_the_same_film(name):
    """The Newton steps alone take it from a residual of some 1e-2 to the solution."""
    films = []
    for cycles in (1, 10):
        state = solved(CONTACTS[name], max_cycles=cycles)[1]
        certificate = certify(state)
        assert certificate.certified, certificate.message
        films.append(film_values(state.levels[-1].grid, state.levels[-1].H))
    assert_allclose(films[0], films[1], rtol=1e-6)


def test_last_resort_where_cycles_do_not_come_to_rest():
    """A skewed ellipse of a thin film, whose film three cycles leave far off."""
    certificate = certify(solved(SKEWED, points=129, max_cycles=3)[1])
    assert certificate.certified, certificate.message
    assert certificate.residual[0] > 1e-4
    assert certificate.film_change > 0.01


def test_a_negative_film_is_no_solution_and_the_state_stays():
    """A mesh far too coarse: the equations hold with bodies that overlap."""
    _, state = solved(moes(1000.0, 5.0))
    before = state.levels[-1].P.copy()
    certificate = certify(state)
    assert not certificate.certified
    assert "mesh too coarse" in certificate.message
    assert certificate.film_change == 0.0
    assert_allclose(state.levels[-1].P, before, rtol=1e-6)


def test_a_closed_box_has_no_exterior_load():
    state = solved(moes(20.0, 10.0), domain=(-4.5, 1.5, 3.0))[1]
    lin = linearise(state, len(state.levels) - 1)
    assert lin.load_by_film == 0.0
    assert certify(replace(state)).certified


def test_certificate_on_request():
    """It is in the record, and the film stays within its bars."""
    plain = solve_contact(CONTACTS["circular"], SolverOptions(points=65))
    solution = solve_contact(CONTACTS["circular"], SolverOptions(points=65, certify=True))
    assert plain.record.certificate is None
    assert solution.record.certificate is not None
    assert solution.record.certificate.certified
    assert solution.record.residual[-1] < TOLERANCE
    assert solution.record.fft_equivalents > plain.record.fft_equivalents
    film, bar = solution.film_central_dimensionless, plain.film_central_dimensionless
    assert abs(film.value - bar.value) < bar.uncertainty
    assert film.uncertainty < bar.uncertainty


@pytest.mark.slow
def test_last_attempt_where_cycles_fail():
    """Nested iteration by Newton's method, after one attempt with cycles."""
    attempts = (ATTEMPTS[0], ATTEMPTS[-1])
    solution = solve_attempts(SKEWED, SolverOptions(points=129, max_cycles=2), attempts=attempts)[0]
    assert solution.record.fallbacks[-1] == ATTEMPTS[-1].name
    assert solution.converged
    assert solution.record.residual[-1] < TOLERANCE


def test_nested_iteration_ends_where_cycles_do():
    options = SolverOptions(points=65)
    films = [
        solve_attempts(CONTACTS["oblique"], options, attempts=(attempt,))[0].film_central_dimensionless
        for attempt in (ATTEMPTS[0], ATTEMPTS[-1])
    ]
    assert abs(films[0].finest - films[1].finest) < 1e-3 * films[1].finest
