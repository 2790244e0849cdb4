"""Lines of a rectangle mesh graded by halving."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ..arrays import Array

HALVINGS = 5  # at most, from the largest cell to the smallest
ROOTS = range(1, 33)  # numbers of largest cells that are tried
SIZE_FACTORS = (1.0, 1.2, 1.45, 1.7)  # of the size wanted, over the smallest cell
COARSE_SIZE_FACTORS = (2.0, 2.4, 2.9, 3.4)  # with a single largest cell: the coarsest meshes


def graded_lines(
    ends: tuple[float, float], cells: int, size: Callable[[Array], Array]
) -> NDArray[np.int_]:
    """Lines of a graded mesh on an equidistant lattice.

    Cells are halved until they are no longer than a multiple of `size`, the same for all; multiple
    and number of the largest cells are those whose number of cells comes closest to the desired
    one, which differs by a few.

    Parameters
    ----------
    ends : tuple[float, float]
        first and last position [-]
    cells : int
        desired number of cells
    size : Callable[[Array], Array]
        cell size up to a factor as a function of the position [-]

    Returns
    -------
    NDArray[np.int_]
        numbers of the lines on the lattice, the first zero, shape (lines,)
    """
    first, last = ends
    smallest = float(size(np.linspace(first, last, 1025)).min())
    candidates = []
    for roots in ROOTS:
        unit = (last - first) / (roots * 2**HALVINGS)
        factors = SIZE_FACTORS if roots > 1 else (*SIZE_FACTORS, *COARSE_SIZE_FACTORS)
        meshes = [_halved((first, unit), roots, size, s * unit / smallest) for s in factors]
        candidates += meshes
        if min(map(len, meshes)) > 2 * cells:  # still more with more of the largest cells
            break
    best = min(candidates, key=lambda lines: abs(len(lines) - 1 - cells))
    step = int(np.gcd.reduce(best))
    return best // step


def _halved(
    origin: tuple[float, float], roots: int, size: Callable[[Array], Array], factor: float
) -> NDArray[np.int_]:
    """Cells of 2^HALVINGS units, halved where they are longer than `factor` times the size wanted
    there; `origin` is the first line and the unit.
    """
    first, unit = origin
    lines = 2**HALVINGS * np.arange(roots + 1)
    for _ in range(HALVINGS):
        positions = lines[:-1, None] + np.diff(lines)[:, None] * np.linspace(0.0, 1.0, 9)
        wanted = factor * size(first + unit * positions).min(axis=1)
        long = np.diff(lines) * unit > 1.0001 * wanted
        lines = np.sort(np.concatenate((lines, (lines[:-1] + np.diff(lines) // 2)[long])))
    return lines


def refined(lines: NDArray[np.int_]) -> NDArray[np.int_]:
    """Lines on a lattice twice as fine, one more in the middle of each cell.

    Parameters
    ----------
    lines : NDArray[np.int_]
        numbers on the lattice, shape (n,)

    Returns
    -------
    NDArray[np.int_]
        numbers on the finer one, shape (2 n - 1,)
    """
    finer = np.empty(2 * len(lines) - 1, dtype=lines.dtype)
    finer[::2] = 2 * lines
    finer[1::2] = lines[:-1] + lines[1:]
    return finer
