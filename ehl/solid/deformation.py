"""Elastic deflection of the half space: Love's kernel by zero-padded FFT."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from ..arrays import Array
from ..grid import Grid
from .coating import ScaledCoating
from .layered import patch_compliance

# part of the kernel that the line relaxation uses
NEAR_LINES = 4
NEAR_COLUMNS = 12


@dataclass(frozen=True, slots=True, kw_only=True)
class DeflectionKernel:
    """Deflection of a grid's nodes from unit pressures, ready for the convolution."""

    symmetric: bool
    shape: tuple[int, int]  # (ny, nx) of the pressure
    length_x: int  # padded lengths: twice the number of cells
    length_y: int
    # real, as the kernel is even; of a symmetric grid: rows [even, odd frequencies], columns twice
    spectrum: Array
    # deflection at distance m hx in the same line and in the next ones, shape (NEAR_LINES,
    # NEAR_COLUMNS)
    near: Array


def patch_corner(u: Array, v: Array) -> Array:
    """u asinh(v/|u|) + v asinh(u/|v|) for corners off the axes [-]: differenced over the corners
    of a rectangle, the integral of 1/r over it seen from the origin, Love (1929).
    """
    return u * np.arcsinh(v / np.abs(u)) + v * np.arcsinh(u / np.abs(v))


def deflection_kernel(
    grid: Grid, deformation: float, coating: ScaledCoating | None = None
) -> DeflectionKernel:
    """Kernel and its spectrum for one grid; `deformation` is c_def [-]."""
    cells_x = grid.nx - 1
    cells_y = (2 if grid.symmetric else 1) * (grid.ny - 1)
    x = grid.hx * (np.arange(cells_x + 2, dtype=np.float64) - 0.5)
    y = grid.hy * (np.arange(cells_y + 2, dtype=np.float64) - 0.5)
    quarter = deformation * np.diff(np.diff(patch_corner(x[None, :], y[:, None]), axis=0), axis=1)
    if coating is not None:
        centres = (x[1:] - 0.5 * grid.hx, y[1:] - 0.5 * grid.hy)
        quarter += deformation * patch_compliance(coating, *centres, grid.hx, grid.hy)
    # even in x and y: the cosine transform of the quarter is the real spectrum on the doubled,
    # periodic grid
    spectrum = fft.dct(fft.dct(quarter, type=1, axis=1), type=1, axis=0)
    if grid.symmetric:
        spectrum = np.repeat(np.concatenate((spectrum[0::2], spectrum[1::2])), 2, axis=1)
    return DeflectionKernel(
        symmetric=grid.symmetric,
        shape=(grid.ny, grid.nx),
        length_x=2 * cells_x,
        length_y=2 * cells_y,
        spectrum=np.ascontiguousarray(spectrum),
        near=quarter[:NEAR_LINES, :NEAR_COLUMNS].copy(),
    )


def deflect(kernel: DeflectionKernel, pressure: Array, threads: int = 1) -> Array:
    """Deflection sum_kl K(i-k, j-l) P_kl, shapes (ny, nx) [-], by FFT."""
    if threads > 1:
        with fft.set_workers(threads):
            return deflect(kernel, pressure)
    rows = fft.rfft(pressure, n=kernel.length_x, axis=1)
    if kernel.symmetric:
        lines = _convolve_even(rows, kernel.spectrum)
    else:
        columns = fft.fft(rows, n=kernel.length_y, axis=0, overwrite_x=True)
        half = kernel.spectrum.shape[0]
        columns[:half] *= kernel.spectrum
        columns[half:] *= kernel.spectrum[half - 2 : 0 : -1]
        lines = fft.ifft(columns, axis=0, overwrite_x=True)[: kernel.shape[0]]
    deflection = fft.irfft(lines, n=kernel.length_x, axis=1, overwrite_x=True)
    return np.ascontiguousarray(deflection[:, : kernel.shape[1]])


def _convolve_even(rows: NDArray[np.complex128], spectrum: Array) -> NDArray[np.complex128]:
    """Convolution along y of data even in y, given by its rows y >= 0.

    The even data extended to four times the cells have the cosine series X_k = x_0 + 2 sum x_n
    cos(pi n k/(2m)). Its even frequencies are a cosine transform of type 1 over the m + 1 rows,
    its odd ones one of type 3 over m rows: the zero padding is never stored nor transformed. The
    way back uses types 1 and 2.
    """
    m = rows.shape[0] - 1
    columns = rows.shape[1]
    data = rows.view(np.float64).reshape(m + 1, 2 * columns)
    odd = fft.dct(data[:m], type=3, axis=0)
    data[m] *= 2.0  # the last row and its mirror image are two rows of the extension
    even = fft.dct(data, type=1, axis=0, overwrite_x=True)
    # real and imaginary parts side by side: each column of the spectrum stands twice
    even *= spectrum[: m + 1]
    odd *= spectrum[m + 1 :]
    result = fft.dct(even, type=1, axis=0, overwrite_x=True)
    result[:m] += fft.dct(odd, type=2, axis=0, overwrite_x=True)
    result *= 1.0 / (4 * m)
    return result.view(np.complex128).reshape(m + 1, columns)
