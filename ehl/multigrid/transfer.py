"""Transfers between a grid and the one with doubled mesh size; arrays of shape (ny, nx)."""

import numpy as np

from ..arrays import Array


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
