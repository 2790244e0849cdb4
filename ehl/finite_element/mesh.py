"""Lines of a rectangle mesh graded by halving."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ..arrays import Array

HALVINGS = 5  # at most, from the largest cell to the smallest
ROOTS = range(1, 33)  # numbers of largest cells that are tried
SHARES = (1.0, 1.2, 1.45, 1.7)  # of the size wanted, over the smallest cell
COARSE_SHARES = (2.0, 2.4, 2.9, 3.4)  # with a single largest cell: the coarsest meshes


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
    for roots in ROOTS:
        unit = (last - first) / (roots * 2**HALVINGS)
        shares = SHARES if roots > 1 else (*SHARES, *COARSE_SHARES)
        found = [_halved((first, unit), roots, size, s * unit / smallest) for s in shares]
        candidates += found
        if min(map(len, found)) > 2 * cells:  # still more with more of the largest cells
            break
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
