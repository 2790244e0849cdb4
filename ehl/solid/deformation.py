"""Elastic deflection of the half space: Love's kernel by zero-padded FFT, on small grids by the
same transforms as matrices.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy

from .. import solid
from ..arrays import Array
from ..grid import Grid
from ..scaling import ScaledCoating

# part of the kernel that the line relaxation uses
NEAR_LINES = 4
NEAR_COLUMNS = 12
# nodes up to which the transforms are products with matrices, in a fifth to a half of the time:
# FFTs are as fast on 33 x 65 nodes, and on 65 x 129 of a symmetric grid. From 33 x 33 complex
# ones on OpenBLAS shares a product among threads, whose waiting takes 20 to 300 times as long
MATRIX_NODES = 1050
MATRIX_NODES_SYMMETRIC = 2200


@dataclass(frozen=True, slots=True, kw_only=True)
class DeflectionKernel:
    """Deflection of a grid's nodes from unit pressures, ready for the convolution."""

    symmetric: bool
    shape: tuple[int, int]  # (ny, nx) of the pressure
    length_x: int  # padded length: twice the number of cells
    # real, as the kernel is even: of a symmetric grid over the terms of a cosine series along y
    # and over real and imaginary parts along x, shape (n, 2 nx), else (n, nx)
    spectrum: Array
    far: Array  # of the last line's mirror image, which the cosine series leaves out, shape (nx,)
    # deflection at distance m hx in the same line and in the next ones, shape (NEAR_LINES,
    # NEAR_COLUMNS)
    near: Array
    # transforms of small grids: along x, along y, back along y, back along x
    matrices: tuple[Array, Array, Array, Array] | None


def patch_corner(u: Array, v: Array) -> Array:
    """u asinh(v/|u|) + v asinh(u/|v|) for corners off the axes.

    Differenced over the corners of a rectangle, this is the integral of 1/r over it seen from the
    origin, Love (1929).

    Parameters
    ----------
    u : Array
        corner along x, any shape [-]
    v : Array
        corner along y, a shape that broadcasts with `u` [-]

    Returns
    -------
    Array
        the common shape [-]
    """
    return u * np.arcsinh(v / np.abs(u)) + v * np.arcsinh(u / np.abs(v))


def deflection_kernel(
    grid: Grid, deformation: float, coating: ScaledCoating | None = None
) -> DeflectionKernel:
    """Kernel of the deflection and its spectrum for one grid.

    Parameters
    ----------
    grid : Grid
        the grid
    deformation : float
        c_def [-]
    coating : ScaledCoating | None, optional
        of one body; None: uncoated

    Returns
    -------
    DeflectionKernel
        kernel for `deflect`
    """
    quarter = deformation * unit_deflections(grid, coating)
    most = MATRIX_NODES_SYMMETRIC if grid.symmetric else MATRIX_NODES
    # even in x and y: cosine transforms of the quarter are the real spectrum
    along = scipy.fft.dct(quarter, type=1, axis=1)
    far = np.zeros(grid.nx)
    if grid.symmetric:
        length = transform_length(len(quarter) - 1)
        if length < len(quarter):
            far = along[length]
        series = scipy.fft.dct(along[:length], type=3, n=length, axis=0) / (2 * length)
        spectrum = np.repeat(series, 2, axis=1)
    else:
        length = transform_length(2 * (len(quarter) - 1))
        padded = np.pad(along, ((0, length // 2 + 1 - len(quarter)), (0, 0)))
        half = scipy.fft.dct(padded, type=1, axis=0)
        spectrum = np.concatenate((half, half[-2:0:-1]))
    return DeflectionKernel(
        symmetric=grid.symmetric,
        shape=(grid.ny, grid.nx),
        length_x=2 * (grid.nx - 1),
        spectrum=spectrum,
        far=far,
        near=quarter[:NEAR_LINES, :NEAR_COLUMNS].copy(),
        matrices=_matrices(grid, length) if grid.nx * grid.ny <= most else None,
    )


def _matrices(grid: Grid, length: int) -> tuple[Array, Array, Array, Array]:
    """The four transforms of `deflect`; rows along x hold real and imaginary parts in turn."""
    length_x = 2 * (grid.nx - 1)
    parts = np.eye(2 * grid.nx).view(np.complex128)
    lines = np.eye(grid.ny)
    across: Any
    back_across: Any
    if grid.symmetric:
        across = scipy.fft.dct(lines, type=3, n=length, axis=0)
        back_across = scipy.fft.dct(np.eye(length), type=2, axis=0)
    else:
        across = scipy.fft.fft(lines, n=length, axis=0)
        back_across = scipy.fft.ifft(np.eye(length), axis=0)
    return (
        scipy.fft.rfft(np.eye(grid.nx), n=length_x, axis=1).view(np.float64),
        across,
        back_across[: grid.ny].copy(),
        scipy.fft.irfft(parts, n=length_x, axis=1)[:, : grid.nx].copy(),
    )


def unit_deflections(grid: Grid, coating: ScaledCoating | None = None) -> Array:
    """Deflection over c_def of nodes at distances from 0 up from a unit pressure at one node.

    Parameters
    ----------
    grid : Grid
        the grid
    coating : ScaledCoating | None, optional
        of one body; None: uncoated

    Returns
    -------
    Array
        shape (distances of the whole grid along y, nx) [-]
    """
    cells_x = grid.nx - 1
    cells_y = (2 if grid.symmetric else 1) * (grid.ny - 1)
    x = grid.hx * (np.arange(cells_x + 2, dtype=np.float64) - 0.5)
    y = grid.hy * (np.arange(cells_y + 2, dtype=np.float64) - 0.5)
    quarter = np.diff(np.diff(patch_corner(x[None, :], y[:, None]), axis=0), axis=1)
    if coating is not None:
        centres = (x[1:] - 0.5 * grid.hx, y[1:] - 0.5 * grid.hy)
        quarter += solid.layered.patch_compliance(coating, *centres, grid.hx, grid.hy)
    return np.asarray(quarter)


def transform_length(least: int) -> int:
    """Smallest even number 2^k, 3 2^k, 9 2^k or 27 2^k that is not below `least`.

    Parameters
    ----------
    least : int
        smallest length of the transform

    Returns
    -------
    int
        length of the transform
    """
    return min(odd << max(1, (-(-least // odd) - 1).bit_length()) for odd in (1, 3, 9, 27))


def deflect(kernel: DeflectionKernel, pressure: Array, threads: int = 1) -> Array:
    """Deflection sum_kl K(i-k, j-l) P_kl, shapes (ny, nx) [-], by FFT.

    Columns of a symmetric grid are even about their first line: a cosine series of type 3 there,
    type 2 back (Makhoul, 1980), half as long as the padded columns of other grids.

    Parameters
    ----------
    kernel : DeflectionKernel
        of the grid
    pressure : Array
        P, shape (ny, nx) [-]
    threads : int, default 1
        number of threads

    Returns
    -------
    Array
        deflection, shape (ny, nx) [-]
    """
    if kernel.matrices is not None:
        return _deflect_by_matrices(kernel, kernel.matrices, pressure)
    rows = scipy.fft.rfft(pressure, n=kernel.length_x, axis=1, workers=threads)
    if not kernel.symmetric:
        columns = scipy.fft.fft(rows, n=len(kernel.spectrum), axis=0, workers=threads)
        columns *= kernel.spectrum
        rows = scipy.fft.ifft(columns, axis=0, overwrite_x=True, workers=threads)[: len(rows)]
    else:
        beyond = kernel.far * rows[-1]
        columns = rows.view(np.float64)
        series = scipy.fft.dct(columns, type=3, n=len(kernel.spectrum), axis=0, workers=threads)
        series *= kernel.spectrum
        series = scipy.fft.dct(series, type=2, axis=0, overwrite_x=True, workers=threads)
        rows = series[: len(rows)].view(np.complex128)
        rows[-1] += beyond
    deflection = scipy.fft.irfft(
        rows, n=kernel.length_x, axis=1, overwrite_x=True, workers=threads
    )
    return np.ascontiguousarray(deflection[:, : kernel.shape[1]])


def _deflect_by_matrices(
    kernel: DeflectionKernel, matrices: tuple[Array, Array, Array, Array], pressure: Array
) -> Array:
    along, across, back_across, back_along = matrices
    rows = pressure @ along
    if not kernel.symmetric:
        rows = rows.view(np.complex128)
    series = across @ rows
    series *= kernel.spectrum
    deflected = back_across @ series
    if kernel.symmetric:
        deflected[-1] += np.repeat(kernel.far, 2) * rows[-1]
    return np.asarray(deflected.view(np.float64) @ back_along)
