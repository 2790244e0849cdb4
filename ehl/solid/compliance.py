"""Half-space compliance of bilinear pressures on a graded rectangular mesh, integrated exactly.

Node (i, j) of the mesh has the number i ny + j. A symmetric mesh holds y >= 0; the pressures of
the mirrored half are added in.
"""

from collections.abc import Callable
from itertools import product

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from ..arrays import Array
from .coating import ScaledCoating
from .layered import point_compliance

SAMPLES = 4001  # of the density of nodes


def graded_nodes(
    ends: tuple[float, float], cells: int, density: Callable[[Array], Array]
) -> Array:
    """Nodes from the first to the last of `ends`, shape (cells + 1,) [-], spaced by the reciprocal
    of `density`, nodes per length up to a factor; twice the cells keep every node.
    """
    s = np.linspace(*ends, SAMPLES)
    d = density(s)
    count = np.concatenate(([0.0], np.cumsum(0.5 * (d[1:] + d[:-1]) * np.diff(s))))
    nodes = np.interp(np.linspace(0.0, count[-1], cells + 1), count, s)
    nodes[0], nodes[-1] = ends
    return nodes


def corner_integrals(x: Array, y: Array) -> tuple[Array, Array, Array, Array]:
    """Integrals of (1, x, y, x y)/r over the rectangle from the origin to (x, y), r^2 = x^2 + y^2
    [-].

    x asinh(y/|x|) + y asinh(x/|y|) (Love, 1929), (y r + x^2 asinh(y/|x|))/2, the same with x and y
    exchanged, r^3/3; each up to functions of x or of y alone, which cancel in differences over the
    corners of a rectangle.
    """
    r = np.hypot(x, y)
    x, y = (np.broadcast_to(side, r.shape) for side in (x, y))
    along = np.arcsinh(np.divide(y, np.abs(x), out=np.zeros_like(r), where=x != 0.0))
    across = np.arcsinh(np.divide(x, np.abs(y), out=np.zeros_like(r), where=y != 0.0))
    firsts = (0.5 * (y * r + x * x * along), 0.5 * (x * r + y * y * across))
    return x * along + y * across, *firsts, r**3 / 3.0


def compliance_matrix(x: Array, y: Array, symmetric: bool) -> Array:
    """Double integral of P/r at every node for a unit pressure at each node, bilinear in every
    cell, shape (nx ny, nx ny): row of the deflection, column of the pressure [-].

    `x` and `y` are the lines of nodes; a symmetric mesh starts at y = 0, and the pressures of y <
    0 are added.
    """
    nx, ny = len(x), len(y)
    sources = np.concatenate((-y[:0:-1], y)) if symmetric else y
    matrix = np.empty((nx, ny, nx, ny))
    for line in range(ny):
        columns = _line_compliance(x, sources, y[line])
        if symmetric:
            matrix[:, line] = columns[:, :, ny - 1 :]
            matrix[:, line, :, 1:] += columns[:, :, ny - 2 :: -1]
        else:
            matrix[:, line] = columns
    return matrix.reshape(nx * ny, nx * ny)


def _line_compliance(x: Array, sources: Array, y: float) -> Array:
    """Compliance within lines, shape (nx, nx, source lines): field node, source node."""
    nx, ny = len(x), len(sources)
    dx = x[None, :, None] - x[:, None, None]
    dy = (sources - y)[None, None, :]
    area = np.diff(x)[None, :, None] * np.diff(sources)[None, None, :]
    one, first_x, first_y, mixed = (
        np.diff(np.diff(f, axis=1), axis=2) for f in corner_integrals(dx, dy)
    )
    out = np.zeros((nx, nx, ny))
    for east in (0, 1):
        for north in (0, 1):
            # the hat of this corner is +-(x - x0)(y - y0)/area with (x0, y0) the opposite corner
            x0 = dx[:, :-1] if east else dx[:, 1:]
            y0 = dy[:, :, :-1] if north else dy[:, :, 1:]
            sign = 1.0 if east == north else -1.0
            hat = sign / area * (mixed - y0 * first_x - x0 * first_y + x0 * y0 * one)
            out[:, east : nx - 1 + east, north : ny - 1 + north] += hat
    return out


def add_coating(
    matrix: Array,
    coating: ScaledCoating,
    lines: tuple[Array, Array],
    weights: Array,
    symmetric: bool,
) -> None:
    """Add the contribution of a coating to a compliance matrix, in place: it is smooth, and a
    nodal quadrature suffices. `lines` are x and y, `weights` the integrals of the nodes'
    functions, shape (nx ny,) [-].
    """
    x, y = (values.ravel() for values in np.meshgrid(*lines, indexing="ij"))
    for row in range(len(x)):
        across = [y - y[row], y + y[row]] if symmetric else [y - y[row]]
        for dy in across:
            matrix[row] += weights * point_compliance(coating, np.hypot(x - x[row], dy))


def near_field(matrix: Array, shape: tuple[int, int], reach: int) -> sparse.csr_matrix:
    """Entries of a compliance matrix between nodes at most `reach` lines apart [same unit]."""
    number = np.arange(shape[0] * shape[1]).reshape(shape)
    shifts = list(product(range(-reach, reach + 1), repeat=2))
    row = np.concatenate([_shifted(number, -i, -j).ravel() for i, j in shifts])
    column = np.concatenate([_shifted(number, i, j).ravel() for i, j in shifts])
    return sparse.csr_matrix((matrix[row, column], (row, column)), shape=matrix.shape)


def _shifted(values: NDArray[np.int_], i: int, j: int) -> NDArray[np.int_]:
    nx, ny = values.shape
    return values[max(0, i) : nx + min(0, i), max(0, j) : ny + min(0, j)]
