"""Bilinear functions on a rectangle mesh graded by halving; nodes have the numbers i ny + j."""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from ..arrays import Array

QUADRATURE = 3  # Gauss points along x and y, exact for polynomials of order 5
HALVINGS = 5  # at most, from the largest cell to the smallest
ROOTS = range(1, 33)  # numbers of largest cells that are tried
SHARES = (1.0, 1.2, 1.45, 1.7)  # of the size wanted, over the smallest cell
COARSE_SHARES = (2.0, 2.4, 2.9, 3.4)  # with a single largest cell: the coarsest meshes


@dataclass(frozen=True, slots=True)
class FilmSpace:
    """Bilinear functions on a rectangle mesh: cells, corners, shapes at the quadrature points."""

    shape: tuple[int, int]  # nodes along x and y
    corners: NDArray[np.int_]  # of each cell: its four nodes, shape (cells, 4)
    # sides of each cell and coordinates of its quadrature points, shape (cells, 1) and (cells, 9)
    length: tuple[Array, Array]
    position: tuple[Array, Array]
    weight: Array  # of the points of a unit cell, shape (9,)
    value: Array  # of the four functions at the points of a unit cell, shape (9, 4)
    slope: tuple[Array, Array]  # their derivatives along x and y, shape (9, 4)


def film_space(x: Array, y: Array) -> FilmSpace:
    """Space on the mesh with lines `x` and `y`, shapes (nx,), (ny,) [-]."""
    nx, ny = len(x), len(y)
    number = np.arange(nx * ny).reshape(nx, ny)
    blocks = (number[:-1, :-1], number[:-1, 1:], number[1:, :-1], number[1:, 1:])
    corners = np.stack([block.ravel() for block in blocks], axis=1)
    points, weights = np.polynomial.legendre.leggauss(QUADRATURE)
    line = 0.5 * (points + 1.0)
    hats = np.stack((1.0 - line, line), axis=1)
    slopes = np.tile([-1.0, 1.0], (QUADRATURE, 1))
    hx, hy = (side.reshape(-1, 1) for side in np.meshgrid(np.diff(x), np.diff(y), indexing="ij"))
    west, south = (side.reshape(-1, 1) for side in np.meshgrid(x[:-1], y[:-1], indexing="ij"))
    return FilmSpace(
        shape=(nx, ny),
        corners=corners,
        length=(hx, hy),
        position=(west + hx * np.repeat(line, QUADRATURE), south + hy * np.tile(line, QUADRATURE)),
        weight=np.asarray(0.25 * np.kron(weights, weights), dtype=np.float64),
        value=np.asarray(np.kron(hats, hats), dtype=np.float64),
        slope=(np.kron(slopes, hats), np.kron(hats, slopes)),
    )


def interpolate(space: FilmSpace, values: Array) -> tuple[Array, tuple[Array, Array]]:
    """Values and gradient at the quadrature points, shape (cells, 9), of nodal values [same
    unit].
    """
    local = values[space.corners]
    hx, hy = space.length
    dx, dy = space.slope
    return local @ space.value.T, (local @ dx.T / hx, local @ dy.T / hy)


def integral_weights(space: FilmSpace) -> Array:
    """Integral of each hat function, shape (nodes,) [-]."""
    hx, hy = space.length
    return scatter(space, hx * hy * (space.weight @ space.value))


def scatter(space: FilmSpace, local: Array) -> Array:
    """Sum over the cells of what each adds to its four nodes, shape (nodes,)."""
    size = space.shape[0] * space.shape[1]
    total = np.bincount(space.corners.ravel(), local.ravel(), minlength=size)
    return np.asarray(total, dtype=np.float64)


def graded_lines(
    ends: tuple[float, float], cells: int, size: Callable[[Array], Array]
) -> NDArray[np.int_]:
    """Numbers of the lines of some `cells` between the two `ends` on an equidistant lattice, the
    first zero, shape (lines,).

    Cells are halved until they are no longer than a multiple of `size`, a function of the place,
    the same for all; multiple and number of the largest cells are those that come nearest to the
    wanted number of cells, which differs by a few.
    """
    first, last = ends
    smallest = float(size(np.linspace(first, last, 1025)).min())
    candidates = []
    for roots, share in (*product(ROOTS, SHARES), *product(ROOTS[:1], COARSE_SHARES)):
        unit = (last - first) / (roots * 2**HALVINGS)
        factor = share * unit / smallest
        candidates.append(_halved((first, unit), roots, size, factor))
    best = min(candidates, key=lambda lines: abs(len(lines) - 1 - cells))
    step = int(np.gcd.reduce(best))
    return best // step


def _halved(
    place: tuple[float, float], roots: int, size: Callable[[Array], Array], factor: float
) -> NDArray[np.int_]:
    """Cells of 2^HALVINGS units, halved where they are longer than `factor` times the size wanted
    there; `place` is the first line and the unit.
    """
    first, unit = place
    lines = 2**HALVINGS * np.arange(roots + 1)
    for _ in range(HALVINGS):
        places = lines[:-1, None] + np.diff(lines)[:, None] * np.linspace(0.0, 1.0, 9)
        wanted = factor * size(first + unit * places).min(axis=1)
        long = np.diff(lines) * unit > 1.0001 * wanted
        lines = np.sort(np.concatenate((lines, (lines[:-1] + np.diff(lines) // 2)[long])))
    return lines


def refined(lines: NDArray[np.int_]) -> NDArray[np.int_]:
    """Lines on a lattice twice as fine, one more in the middle of each cell."""
    finer = np.empty(2 * len(lines) - 1, dtype=lines.dtype)
    finer[::2] = 2 * lines
    finer[1::2] = lines[:-1] + lines[1:]
    return finer
