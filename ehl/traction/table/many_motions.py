"""Sliding forces of a film at thousands of motions, by the pull of its nodes as a table."""

import numpy as np
from numpy.typing import NDArray

from ...arrays import Array
from ...oil.rheology import kernel_rheology
from .. import _kernels
from ..film_quadrature import FilmQuadrature
from . import _many_kernels
from ._many_kernels import SHIFT

# smallest over largest sliding in the table of pulls, below which the drag goes with the sliding
SMALLEST = 1e-8


def many_sliding_forces(
    film: FilmQuadrature, slide: tuple[Array, Array, Array], rolling: Array, curvature: float
) -> Array:
    """As `film_quadrature.sliding_forces`, four times faster for thousands of motions,
    within 0.03 % of the largest force.
    """
    out = np.zeros((slide[0].size, _kernels.COLUMNS))
    largest = _largest_sliding(film, slide, rolling, curvature)
    if largest == 0.0:
        return out
    squares = _squares(largest)
    law = kernel_rheology(film.rheology)[:4]
    pulls = np.empty((film.nodes.shape[1], squares.size), np.float32)
    _many_kernels.node_pulls(film.nodes, law, np.sqrt(squares.astype(np.float64)), pulls)
    surface = (np.float32(curvature), np.float32(film.half_width))
    motions = np.stack([*slide, rolling]).astype(np.float32)
    nodes = film.nodes.astype(np.float32)
    _many_kernels.tabulated_sums(nodes, pulls, squares, motions, surface, out)
    return out


def _largest_sliding(
    film: FilmQuadrature, slide: tuple[Array, Array, Array], rolling: Array, curvature: float
) -> float:
    """More than any node slides at any of the motions [m/s]."""
    slide_x, slide_y, spin = (float(np.abs(part).max()) for part in slide)
    x, y = (float(np.abs(film.nodes[k]).max()) for k in (_kernels.X, _kernels.Y))
    bent = float(np.abs(rolling).max()) * curvature * y * y
    return slide_x + slide_y + 2.0 * spin * (x + y) + 3.0 * bent


def _squares(largest: float) -> NDArray[np.float32]:
    """Squares of the sliding at which pulls are tabulated, from small ones to beyond that of the
    largest [m^2/s^2].
    """
    ends = np.array([(SMALLEST * largest) ** 2, largest**2], np.float32).view(np.int32) >> SHIFT
    codes = np.arange(ends[0], ends[1] + 2, dtype=np.int32) << SHIFT
    return np.asarray(codes.view(np.float32))
