"""Grids, transfers between them, and the extrapolation over them."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.ehl.grid import Grid, full_weighting, grid_hierarchy, inject, interpolate_cubic, interpolate_linear
from oilfilm.ehl.multigrid.film_values import extrapolate, extrapolate_approach, second_order
from oilfilm.ehl.multigrid.history import STALLED_CYCLES, LevelHistory, central_film, film_values

HIERARCHY = grid_hierarchy(65, (-4.0, 2.0, 3.0), 1.5, 3, True)


def test_hierarchy_nests_and_fills_the_box():
    for coarse, fine in zip(HIERARCHY[:-1], HIERARCHY[1:], strict=True):
        assert_allclose(fine.X[::2], coarse.X, atol=1e-14)
        assert_allclose(fine.Y[::2], coarse.Y, atol=1e-14)
    finest = HIERARCHY[-1]
    assert_allclose([finest.X[0], finest.X[-1], finest.Y[-1]], [-4.0, 2.0, 3.0], rtol=1e-14)
    assert finest.hy <= 1.5 * finest.hx


def test_origin_is_exact_where_it_is_a_node():
    grid = Grid(x_in=-3.3, hx=0.1, hy=0.1, nx=65, ny=9, symmetric=False)
    assert 0.0 in grid.X
    assert 0.0 in grid.Y


@pytest.mark.parametrize("symmetric", [True, False])
def test_integral_of_a_bilinear_function(symmetric):
    grid = Grid(x_in=-1.0, hx=0.25, hy=0.5, nx=9, ny=5, symmetric=symmetric)
    values = 2.0 + grid.X[None, :] + 0.0 * grid.Y[:, None]
    width = 4.0 if symmetric else 2.0
    assert_allclose(grid.integral(values), 2.0 * 2.0 * width, rtol=1e-14)


def test_full_weighting_is_the_transpose_of_linear_interpolation():
    random = np.random.default_rng(4410)
    coarse, fine = np.zeros((5, 9)), np.zeros((9, 17))
    coarse[1:-1, 1:-1] = random.random((3, 7))
    fine[1:-1, 1:-1] = random.random((7, 15))
    left = np.sum(interpolate_linear(coarse) * fine)
    assert_allclose(left, 4.0 * np.sum(coarse * full_weighting(fine, False)), rtol=1e-13)


def test_full_weighting_on_half_and_full_grid():
    half = np.random.default_rng(88).random((9, 17))
    half[-1] = half[:, 0] = half[:, -1] = 0.0
    full = np.concatenate((half[:0:-1], half))
    assert_allclose(full_weighting(half, True), full_weighting(full, False)[4:], rtol=1e-14)


def test_cubic_interpolation_is_exact_for_cubics_inside():
    coarse, fine = HIERARCHY[-2], HIERARCHY[-1]

    def cubic(grid):
        return (1.0 + grid.X[None, :] ** 3) * (2.0 - grid.Y[:, None] ** 2)

    error = np.abs(interpolate_cubic(cubic(coarse), True) - cubic(fine))
    assert error[:-2, 2:-2].max() < 1e-12
    assert error.max() > 1e-3  # linear beside the edge


def test_injection_takes_shared_nodes():
    fine = np.arange(45.0).reshape(5, 9)
    assert np.array_equal(inject(fine), fine[::2, ::2])


def test_film_values_between_the_nodes():
    """Centre by cubic interpolation where it is no node, minimum by a parabola: exact for a quadratic film."""
    grid = Grid(x_in=-1.05, hx=0.1, hy=0.1, nx=22, ny=11, symmetric=True)
    H = 0.3 + (grid.X[None, :] - 0.33) ** 2 + (grid.Y[:, None] - 0.42) ** 2
    centre, minimum = film_values(grid, H)
    assert_allclose(centre, 0.3 + 0.33**2 + 0.42**2, rtol=1e-12)
    assert_allclose(minimum, 0.3, rtol=1e-12)
    assert_allclose(central_film(grid, H), centre)


def levels(films, fineness=100.0, noise=0.0):
    """Histories of levels with these central films, each mesh half of the one before; the finest `fineness`."""
    count = len(films)
    return [
        LevelHistory(
            film=[(value * (1.0 + x), value) for x in (4.0 * noise, 2.0 * noise, 0.0)],
            approach=[value - 1.0 + x for x in (4.0 * noise, 2.0 * noise, 0.0)],
            load=[0.0, 0.0],
            mesh=value / fineness * 4.0 ** (count - 1 - number),
            residual=[0.0, 0.0],
        )
        for number, value in enumerate(films)
    ]


def test_extrapolation_finds_the_limit_of_a_second_order_sequence():
    values = [1.0 - 0.1 * 4.0**-level for level in range(4)]
    film = extrapolate(levels(values), 0)
    assert_allclose(film.value, 1.0, rtol=1e-12)
    assert film.finest == values[-1]
    assert 0.0 < film.uncertainty < film.value - film.finest


def test_approach_is_extrapolated_through_zero_with_a_bar_of_its_own():
    """Limit 0 of a sequence of second order; the bar is no share of it, and holds the load's error."""
    exact = levels([1.0 - 0.1 * 4.0**-level for level in range(4)])
    found = extrapolate_approach(exact)
    assert_allclose(found.value, 0.0, atol=1e-12)
    assert found.finest == exact[-1].approach[-1]
    assert 0.0 < found.uncertainty < found.value - found.finest
    exact[-1].load = [0.0, 3e-3]
    assert extrapolate_approach(exact).uncertainty == pytest.approx(found.uncertainty + 4e-3)
    assert np.isnan(extrapolate_approach([]).value)


@pytest.mark.parametrize("order", [1.2, 1.6, 3.0])
def test_bars_cover_the_limit_of_another_order(order):
    """The departure from second order is in the bar: the limit lies within."""
    values = [1.0 - 0.1 * 2.0 ** (-order * level) for level in range(4)]
    film = extrapolate(levels(values), 0)
    assert abs(film.value - 1.0) < (1.0 + 1e-9) * film.uncertainty


def test_bars_widen_where_the_order_is_not_seen_and_where_levels_miss():
    turned = extrapolate(levels([1.0, 0.9, 0.95]), 0)
    assert turned.uncertainty > abs(0.95 - 0.9) / 3.0
    straight = [1.0 - 0.1 * 4.0**-level for level in range(3)]
    bars = [extrapolate(levels(straight[first:]), 0).uncertainty for first in range(3)]
    assert bars[0] < bars[1] < bars[2]
    assert extrapolate(levels([1.0], fineness=5.0), 0).uncertainty == pytest.approx(0.8)
    assert np.isnan(extrapolate([], 0).value)


@pytest.mark.parametrize(
    ("films", "right"),
    [
        ([0.6600, 0.7134, 0.74876, 0.74534], 0.7363),  # M 2563, L 1.55, R_x/R_y 0.0595, 69.5 deg: turns
        ([0.2000, 0.26827, 0.3098, 0.31343], 0.3091),  # M 3629, L 0.79, R_x/R_y 0.0968, 69.7 deg: falls too fast
    ],
)
def test_bars_of_minimum_films_hold_a_late_turn(films, right):
    """Levels of 129 to 1025 points, and the film of 2049."""
    known = levels(films, fineness=400.0)
    film = extrapolate(known, 1)
    assert abs(film.value - right) < film.uncertainty
    assert abs(film.value - right) > extrapolate(known, 0).uncertainty  # no bar of a steady sequence


def test_bars_are_twice_as_wide_where_no_third_resolved_level_bears_out_the_order():
    """The minimum's is the whole step, half of it the central one's."""
    known = levels([0.9, 0.93, 0.96], fineness=40.0)
    assert not known[0].resolved
    for sequence in (known, levels([0.93, 0.96])):
        for kind, share in ((0, 0.5), (1, 1.0)):
            film = extrapolate(sequence, kind)
            assert film.uncertainty == pytest.approx(share * 0.03 / 3.0)


def test_a_level_below_that_is_not_solved_is_left_out():
    """Its film is open by more than itself: the finest stands alone, with the bar of a single level."""
    below, finest = levels([0.5, 0.99])
    below.residual = [1.0, 1.0]
    assert extrapolate([below, finest], 0) == extrapolate([finest], 0)
    first, *rest = levels([0.5, 0.97, 0.99])
    first.residual = [1.0, 1.0]
    assert extrapolate([first, *rest], 0) == extrapolate(rest, 0)


def test_bars_hold_what_the_cycles_left():
    quiet, noisy = (extrapolate(levels([0.9, 0.975, 0.99], noise=x), 0) for x in (0.0, 0.01))
    assert noisy.value == quiet.value
    assert noisy.uncertainty > quiet.uncertainty


def test_the_minimum_film_has_twice_the_bar_of_the_central_one():
    central, minimum = (extrapolate(levels([0.8, 0.95, 0.9875]), kind) for kind in (0, 1))
    assert minimum.uncertainty == pytest.approx(2.0 * central.uncertainty)


def test_a_small_step_after_a_large_one_keeps_the_bar():
    """Steps that change their sign nearly vanish in between: the film is no better known for it."""
    regular, turning = (extrapolate(levels([0.8, film, 0.9901]), 1) for film in (0.95, 0.99))
    assert turning.uncertainty > 0.25 * 0.19 / 3.0 * 0.3
    assert turning.uncertainty > regular.uncertainty


def test_no_film_is_extrapolated_far_down():
    """Beyond a quarter of the film the finest value stands, and the step is the bar."""
    film = extrapolate(levels([0.9, 0.6, 0.2]), 0)
    assert film.value == 0.2
    assert film.uncertainty >= 0.4 / 3.0
    rising = extrapolate(levels([0.1, 0.2, 0.5]), 0)
    assert rising.value == pytest.approx(0.6)


def test_second_order_of_two_meshes():
    film = second_order([0.9, 0.975], 0.01)
    assert_allclose(film.value, 1.0)
    assert_allclose(film.uncertainty, 0.075 + 0.00975)
    assert second_order([1.0], 0.0).uncertainty == 1.0


@pytest.mark.parametrize(
    ("residual", "stalled"),
    [
        ([0.04, 0.02, *[0.03] * STALLED_CYCLES], True),
        ([0.04, 0.02, *[0.03] * (STALLED_CYCLES - 1)], False),
        ([0.04, 0.02, *[0.03] * (STALLED_CYCLES - 1), 0.01], False),  # nearer again
        ([0.04, 0.004, *[0.03] * STALLED_CYCLES], False),  # the equations held once
        ([0.04], False),
    ],
)
def test_cycles_that_come_no_nearer_have_stalled(residual, stalled):
    assert LevelHistory(film=[(1.0, 1.0)], approach=[0.0], mesh=0.01, residual=residual).stalled is stalled


@pytest.mark.parametrize(
    ("residual", "film", "approaching_solution"),
    [
        ([4e-3] * 6, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0], True),  # the equations hold, the films move
        ([4e-3] * 5, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0], False),  # too few to tell
        ([1e-4] * 6, [1.0] * 7, False),  # solved
        ([0.9, 0.8, 0.6, 0.5, 0.4, 0.3], [1.0] * 7, True),
        ([0.9, 0.8, 0.7, 0.6, 0.6, 0.5], [1.0] * 7, False),  # by less than half
        ([], [1.0], False),
    ],
)
def test_cycles_that_near_the_solution_go_on(residual, film, approaching_solution):
    history = LevelHistory(
        film=[(value, value) for value in film],
        approach=[0.0] * len(film),
        mesh=0.01,
        residual=residual,
        load=[0.0] * len(residual),
    )
    assert history.approaching_solution is approaching_solution
