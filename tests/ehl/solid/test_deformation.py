"""Elastic deflection: patch integral, convolution, Hertz."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.ehl.closed_form.hertz import ellipse_ratio, hertz_coefficients
from oilfilm.ehl.grid import Grid
from oilfilm.ehl.solid.deformation import deflect, deflection_kernel, patch_corner, transform_length


def make_grid(symmetric, cells=16):
    ny = cells + 1 if symmetric else 2 * cells + 1
    return Grid(x_in=-2.0, hx=4.0 / (2 * cells), hy=2.0 / cells, nx=2 * cells + 1, ny=ny, symmetric=symmetric)


def patch_integral(x, y, hx, hy):
    """Integral of 1/r over the patch [-hx/2, hx/2] x [-hy/2, hy/2] seen from (x, y), Love (1929)."""
    west, east, south, north = x - 0.5 * hx, x + 0.5 * hx, y - 0.5 * hy, y + 0.5 * hy
    near, far = (
        patch_corner(east, south) - patch_corner(west, south),
        patch_corner(east, north) - patch_corner(west, north),
    )
    return far - near


def test_patch_integral_far_away_is_the_area_over_the_distance():
    value = patch_integral(np.array(30.0), np.array(40.0), 1.0, 2.0)
    assert_allclose(value, 2.0 / 50.0, rtol=2e-4)  # next term: second moments of the patch over r^2


def test_patch_integral_at_the_centre_of_a_square():
    """4 h asinh(1) for a square of side h, Love (1929)."""
    assert_allclose(patch_integral(np.array(0.0), np.array(0.0), 0.3, 0.3), 4.0 * 0.3 * np.arcsinh(1.0), rtol=1e-14)


@pytest.mark.parametrize("cells", [7, 8, 9])  # transforms along y longer than needed, of radix 4, and of radix 3
@pytest.mark.parametrize("symmetric", [True, False], ids=["half", "full"])
def test_convolution_is_the_direct_sum(symmetric, cells):
    grid = make_grid(symmetric, cells)
    random = np.random.default_rng(9027)
    P = random.random((grid.ny, grid.nx))  # the edge included
    kernel = deflection_kernel(grid, 0.7)
    X, Y = grid.X, grid.Y
    rows, values = (Y, P) if not symmetric else (np.concatenate((-Y[:0:-1], Y)), np.concatenate((P[:0:-1], P)))
    direct = np.zeros_like(P)
    for j, y in enumerate(Y):
        for i, x in enumerate(X):
            influence = patch_integral(x - X[None, :], y - rows[:, None], grid.hx, grid.hy)
            direct[j, i] = 0.7 * np.sum(influence * values)
    assert_allclose(deflect(kernel, P), direct, rtol=1e-12)


def test_threads_change_nothing():
    """Columns are transformed on their own."""
    grid = make_grid(True, cells=24)
    P = np.random.default_rng(60931).random((grid.ny, grid.nx))
    kernel = deflection_kernel(grid, 1.0)
    assert np.array_equal(deflect(kernel, P), deflect(kernel, P, threads=3))


def test_transform_lengths():
    """The next even length with at most three factors of three and otherwise factors of two."""
    lengths = sorted(3**b * 2**a for b in range(4) for a in range(1, 12))
    for least in range(1, 2049):
        assert transform_length(least) == next(length for length in lengths if length >= least)


def test_deflect_leaves_its_argument_alone():
    grid = make_grid(True)
    P = np.random.default_rng(331).random((grid.ny, grid.nx))
    before = P.copy()
    deflect(deflection_kernel(grid, 1.0), P)
    assert np.array_equal(P, before)


@pytest.mark.parametrize("radius_ratio", [1.0, 0.1, 0.02, 4.0])
def test_hertz_pressure_flattens_the_gap(radius_ratio):
    """Deflection under Hertz' pressure + X^2/2 + (Rx/Ry) Y^2/2 is the same everywhere inside the ellipse: the approach.

    The pressure ends as a square root, so the largest error falls with h^1.5 and less smoothly than a clean order;
    halving the mesh twice must bring a factor of 5.
    """
    ratio = ellipse_ratio(radius_ratio)
    f, g, d = hertz_coefficients(radius_ratio)
    errors = []
    for cells in (32, 128):
        grid = Grid(x_in=-2.0, hx=2.0 / cells, hy=2.0 * ratio / cells, nx=2 * cells + 1, ny=cells + 1, symmetric=True)
        X, Y = grid.X[None, :], grid.Y[:, None]
        P = np.sqrt(np.maximum(1.0 - X**2 - (Y / ratio) ** 2, 0.0))
        gap = deflect(deflection_kernel(grid, 2.0 * g / (np.pi * f)), P) + 0.5 * X**2 + 0.5 * radius_ratio * Y**2
        inside = X**2 + (Y / ratio) ** 2 < 1.0
        errors.append(np.abs(gap[inside] - d / f**2).max())
    assert errors[0] < 1e-2
    assert errors[1] < errors[0] / 5.0


@pytest.mark.parametrize("symmetric", [True, False])
@pytest.mark.parametrize("shape", [(5, 9), (17, 33), (10, 24)])
def test_matrices_of_small_grids_are_the_transforms(shape, symmetric):
    ny, nx = shape
    grid = Grid(x_in=-3.0, hx=0.21, hy=0.17, nx=nx, ny=ny, symmetric=symmetric)
    kernel = deflection_kernel(grid, 0.7)
    assert kernel.matrices is not None
    P = np.random.default_rng(70529).random(shape)
    assert_allclose(deflect(kernel, P), deflect(replace(kernel, matrices=None), P), rtol=1e-13)
