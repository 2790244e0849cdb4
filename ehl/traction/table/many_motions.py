"""Sliding forces of a film, without heat or with it, at thousands of motions, by the pull of its
nodes as a table.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ...arrays import Array
from ...oil.rheology import kernel_rheology
from .. import _kernels
from ..film_quadrature import FilmQuadrature
from ..heated.film import HeatedFilm, slide_axis
from . import _many_kernels
from ._many_kernels import SHIFT

Singles = NDArray[np.float32]
# smallest over largest sliding in the table of pulls, below which the drag goes with the sliding
SMALLEST = 1e-8


def many_sliding_forces(
    film: FilmQuadrature, slide: tuple[Array, Array, Array], rolling: Array, curvature: float
) -> Array:
    """As `film_quadrature.sliding_forces`, four times faster for thousands of motions,
    within 0.03 % of the largest force.
    """
    out = np.zeros((slide[0].size, _kernels.COLUMNS))
    squares, pulls = _pulls(film, _largest_sliding(film, slide, rolling, curvature))
    if squares.size:
        surface, motions = _single(film, slide, rolling, curvature)
        nodes = film.nodes.astype(np.float32)
        _many_kernels.tabulated_sums(nodes, pulls, squares, motions, surface, out)
    return out


def many_heated_forces(
    film: HeatedFilm, slide: tuple[Array, Array, Array], rolling: Array, curvature: float
) -> Array:
    """As `heated.film.heated_forces` for thousands of motions, within 0.03 % of the largest
    force.
    """
    lines = film.lines
    low = film.low_pressure
    out = many_sliding_forces(low, slide, rolling, curvature)
    by_row = np.ascontiguousarray(np.moveaxis(lines.nodes, 1, 0))
    every = replace(low, nodes=by_row.reshape(by_row.shape[0], -1), rheology=lines.rheology)
    squares, pulls = _pulls(every, _largest_sliding(every, slide, rolling, curvature))
    if squares.size:
        surface, motions = _single(every, slide, rolling, curvature)
        factors = np.empty((*lines.strip_factors.shape[:2], squares.size), np.float32)
        slides = np.sqrt(squares.astype(np.float64))
        _many_kernels.factor_table(lines.strip_factors, slide_axis(lines.speed), slides, factors)
        _many_kernels.tabulated_lines(
            (lines.nodes.astype(np.float32), factors),
            pulls.reshape(*by_row.shape[1:], squares.size),
            squares,
            motions,
            lines.ratio_weights(slide[0]).astype(np.float32),
            surface,
            out,
        )
    return out


def _pulls(film: FilmQuadrature, largest: float) -> tuple[Singles, Singles]:
    """Squares of the sliding [m^2/s^2] up to the largest [m/s], none at rest, and the pulls of the
    nodes at them, shape (nodes, squares) [N s/m].
    """
    if largest == 0.0:
        return np.empty(0, np.float32), np.empty((0, 0), np.float32)
    squares = _squares(largest)
    law = kernel_rheology(film.rheology)[:4]
    pulls = np.empty((film.nodes.shape[1], squares.size), np.float32)
    _many_kernels.node_pulls(film.nodes, law, np.sqrt(squares.astype(np.float64)), pulls)
    return squares, pulls


def _single(
    film: FilmQuadrature, slide: tuple[Array, Array, Array], rolling: Array, curvature: float
) -> tuple[tuple[np.float32, np.float32], Singles]:
    """Surface and motions, shape (4, n), in single precision."""
    surface = (np.float32(curvature), np.float32(film.half_width))
    return surface, np.stack([*slide, rolling]).astype(np.float32)


def _largest_sliding(
    film: FilmQuadrature, slide: tuple[Array, Array, Array], rolling: Array, curvature: float
) -> float:
    """More than any node slides at any of the motions [m/s]."""
    slide_x, slide_y, spin = (float(np.abs(part).max()) for part in slide)
    x, y = (float(np.abs(film.nodes[k]).max()) for k in (_kernels.X, _kernels.Y))
    bent = float(np.abs(rolling).max()) * curvature * y * y
    return slide_x + slide_y + 2.0 * spin * (x + y) + 3.0 * bent


def _squares(largest: float) -> Singles:
    """Squares of the sliding at which pulls are tabulated, from small ones to beyond that of the
    largest [m^2/s^2].
    """
    ends = np.array([(SMALLEST * largest) ** 2, largest**2], np.float32).view(np.int32) >> SHIFT
    codes = np.arange(ends[0], ends[1] + 2, dtype=np.int32) << SHIFT
    return np.asarray(codes.view(np.float32))
