"""Rectangular grids of the contact solver and their hierarchy."""

from dataclasses import dataclass
from math import ceil

import numpy as np

from .arrays import Array


def unfolded(values: Array, axis: int = 0, sign: float = 1.0) -> Array:
    """Values at y >= 0 along an axis, preceded by their mirror image.

    Parameters
    ----------
    values : Array
        nodal values, the first of the axis at y = 0 [any unit]
    axis : int, default 0
        axis along y
    sign : float, default 1.0
        1 for an even, -1 for an odd quantity [-]

    Returns
    -------
    Array
        values over the whole axis, 2 n - 1 in place of n [unit of `values`]
    """
    half = np.moveaxis(values, axis, 0)
    return np.moveaxis(np.concatenate((sign * half[:0:-1], half)), 0, axis)


@dataclass(frozen=True, slots=True, kw_only=True)
class Grid:
    """Equidistant nodes in units of a [-]; a symmetric grid covers y >= 0, row 0 at y = 0."""

    x_in: float
    hx: float
    hy: float
    nx: int
    ny: int
    symmetric: bool

    @property
    def X(self) -> Array:
        """Nodes along x, shape (nx,) [-]; the node at the origin is exactly zero."""
        origin = round(-self.x_in / self.hx)
        if abs(origin * self.hx + self.x_in) < 1e-9 * self.hx:
            return self.hx * np.arange(-origin, self.nx - origin, dtype=np.float64)
        return self.x_in + self.hx * np.arange(self.nx, dtype=np.float64)

    @property
    def Y(self) -> Array:
        """Nodes along y, shape (ny,) [-]; of a symmetric grid y >= 0."""
        first = 0 if self.symmetric else -(self.ny // 2)
        return self.hy * np.arange(first, first + self.ny, dtype=np.float64)

    @property
    def cell(self) -> float:
        """Area of a cell [-]."""
        return self.hx * self.hy

    def integral(self, values: Array) -> float:
        """Integral over the whole box by the trapezoidal rule.

        Parameters
        ----------
        values : Array
            nodal values, shape (ny, nx) [-]

        Returns
        -------
        float
            integral over X and Y, both halves of a symmetric grid [-]
        """
        lines = values.sum(axis=1) - 0.5 * (values[:, 0] + values[:, -1])
        total = float(lines.sum()) - 0.5 * float(lines[0] + lines[-1])
        return (2.0 if self.symmetric else 1.0) * total * self.cell

    def coarsened(self) -> "Grid":
        """Every second node in both directions."""
        ny = (self.ny - 1) // 2 + 1
        return Grid(
            x_in=self.x_in,
            hx=2.0 * self.hx,
            hy=2.0 * self.hy,
            nx=(self.nx - 1) // 2 + 1,
            ny=ny,
            symmetric=self.symmetric,
        )


def grid_hierarchy(
    points: int, domain: tuple[float, float, float], aspect: float, levels: int, symmetric: bool
) -> tuple[Grid, ...]:
    """Grids from coarsest to finest over a box.

    Parameters
    ----------
    points : int
        nodes along x on the finest grid, 2^k + 1
    domain : tuple[float, float, float]
        x_in, x_out, y_half in units of a [-]
    aspect : float
        largest hy/hx; the next smaller one that fits the box is taken [-]
    levels : int
        number of grids
    symmetric : bool
        grids of y >= 0 only

    Returns
    -------
    tuple[Grid, ...]
        the grids, the finest last
    """
    x_in, x_out, y_half = domain
    hx = (x_out - x_in) / (points - 1)
    coarse = 2 ** (levels - 1)
    half_cells = coarse * max(2, ceil(y_half / (hx * aspect * coarse) - 1e-9))
    finest = Grid(
        x_in=x_in,
        hx=hx,
        hy=y_half / half_cells,
        nx=points,
        ny=half_cells + 1 if symmetric else 2 * half_cells + 1,
        symmetric=symmetric,
    )
    grids = [finest]
    while len(grids) < levels:
        grids.append(grids[-1].coarsened())
    return tuple(reversed(grids))


def inject(fine: Array) -> Array:
    """Restrict a field by injection at the shared nodes.

    Parameters
    ----------
    fine : Array
        field of the finer grid, shape (2 ny - 1, 2 nx - 1) [-]

    Returns
    -------
    Array
        field of the coarser grid, shape (ny, nx) [-]
    """
    return fine[::2, ::2].copy()


def full_weighting(fine: Array, symmetric: bool) -> Array:
    """Restrict a field by the adjoint of bilinear interpolation over four, [1 2 1]/4 both ways.

    Parameters
    ----------
    fine : Array
        field of the finer grid, shape (2 ny - 1, 2 nx - 1) [-]
    symmetric : bool
        whether the first line is one of symmetry

    Returns
    -------
    Array
        field of the coarser grid, shape (ny, nx), zero on the edge [-]
    """
    lines = np.zeros((fine.shape[0], (fine.shape[1] + 1) // 2))
    lines[:, 1:-1] = 0.25 * (fine[:, 1:-2:2] + 2.0 * fine[:, 2:-1:2] + fine[:, 3::2])
    coarse = np.zeros(((fine.shape[0] + 1) // 2, lines.shape[1]))
    coarse[1:-1] = 0.25 * (lines[1:-2:2] + 2.0 * lines[2:-1:2] + lines[3::2])
    if symmetric:
        coarse[0] = 0.5 * (lines[0] + lines[1])
    return coarse


def interpolate_linear(coarse: Array) -> Array:
    """Interpolate a field bilinearly, exact for bilinear functions.

    Parameters
    ----------
    coarse : Array
        field of the coarser grid, shape (ny, nx, ...) [-]

    Returns
    -------
    Array
        field of the finer grid, shape (2 ny - 1, 2 nx - 1, ...) [-]
    """
    lines = np.empty((coarse.shape[0], 2 * coarse.shape[1] - 1, *coarse.shape[2:]))
    lines[:, ::2] = coarse
    lines[:, 1::2] = 0.5 * (coarse[:, 1:] + coarse[:, :-1])
    fine = np.empty((2 * coarse.shape[0] - 1, *lines.shape[1:]))
    fine[::2] = lines
    fine[1::2] = 0.5 * (lines[1:] + lines[:-1])
    return fine


def interpolate_cubic(coarse: Array, symmetric: bool) -> Array:
    """Interpolate a field bicubically, to start the next finer grid; lower order beside the edge.

    The mid-point formula (-1, 9, 9, -1)/16 is exact for cubics.

    Parameters
    ----------
    coarse : Array
        field of the coarser grid, shape (ny, nx) [-]
    symmetric : bool
        whether the first line is one of symmetry

    Returns
    -------
    Array
        field of the finer grid, shape (2 ny - 1, 2 nx - 1) [-]
    """
    lines = np.empty((coarse.shape[0], 2 * coarse.shape[1] - 1))
    lines[:, ::2] = coarse
    lines[:, 1::2] = _mid_points(coarse.T, False).T
    fine = np.empty((2 * coarse.shape[0] - 1, lines.shape[1]))
    fine[::2] = lines
    fine[1::2] = _mid_points(lines, symmetric)
    return fine


def _mid_points(values: Array, symmetric: bool) -> Array:
    """Values half way between the rows."""
    middle = 0.5 * (values[1:] + values[:-1])
    middle[1:-1] = (9.0 * (values[1:-2] + values[2:-1]) - values[:-3] - values[3:]) / 16.0
    if symmetric:
        middle[0] = (9.0 * (values[0] + values[1]) - values[1] - values[2]) / 16.0
    return middle
