"""Cells of the upper half of a box: their deflection, and operators between cells and faces."""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray
from scipy.fft import irfft2, next_fast_len, rfft2

Array = NDArray[np.float64]
Box = tuple[float, float, float]

NEAR = 2  # cells to each side whose deflection a preconditioner has
# of the two cells upstream of a face and the one downstream: a parabola, Leonard (1979)
PARABOLA = (-0.125, 0.75, 0.375)


@dataclass(frozen=True, slots=True, kw_only=True)
class Cells:
    """Centres and sizes of cells [-]."""

    X: Array  # (nx,)
    Y: Array  # (ny,)
    hx: float
    hy: float

    @property
    def shape(self) -> tuple[int, int]:
        """(ny, nx) [-]."""
        return self.Y.size, self.X.size


def cells_of(box: Box, nx: int, ny: int) -> Cells:
    """Cells of the upper half of a box (x_in, x_out, y_half) [-]."""
    x_in, x_out, y_half = box
    hx = (x_out - x_in) / nx
    hy = y_half / ny
    X: Array = x_in + hx * (np.arange(nx) + 0.5).astype(np.float64)
    Y: Array = hy * (np.arange(ny) + 0.5).astype(np.float64)
    return Cells(X=X, Y=Y, hx=hx, hy=hy)


class Deflection:
    """c_def times the integral of P/r: rectangles of constant pressure, Love (1929)."""

    def __init__(self, cells: Cells, deformation: float) -> None:
        ny, nx = cells.shape
        self.shape = (ny, nx)
        x = cells.hx * (np.arange(nx + 1) - 0.5)[None, :]
        y = cells.hy * (np.arange(2 * ny + 1) - 0.5)[:, None]
        corner = x * np.arcsinh(y / np.abs(x)) + y * np.arcsinh(x / np.abs(y))
        self.quarter: Array = deformation * np.diff(np.diff(corner, axis=0), axis=1)
        self.padded = (next_fast_len(4 * ny, real=True), next_fast_len(2 * nx, real=True))
        kernel = np.zeros(self.padded)
        rows = np.arange(1 - 2 * ny, 2 * ny)
        columns = np.arange(1 - nx, nx)
        kernel[np.ix_(rows, columns)] = self.quarter[np.ix_(np.abs(rows), np.abs(columns))]
        self.spectrum = rfft2(kernel)

    def __call__(self, P: Array) -> Array:
        """At the cells, of pressures of shape (ny, nx) and their mirror image [-]."""
        ny, nx = self.shape
        both = np.concatenate([P[::-1], P])
        spread = irfft2(self.spectrum * rfft2(both, self.padded), self.padded)
        return np.asarray(spread[ny : 2 * ny, :nx])

    def near(self) -> sp.csr_matrix:
        """Of the nearest cells alone, (cells, cells) [-]."""
        ny, nx = self.shape
        total = sp.csr_matrix((ny * nx, ny * nx))
        offsets = list(range(-NEAR, NEAR + 1))
        for k in range(NEAR + 1):
            values = [self.quarter[k, abs(m)] * np.ones(nx - abs(m)) for m in offsets]
            along = sp.diags(values, offsets, shape=(nx, nx))
            across = sp.eye(ny, k=k) + (sp.eye(ny, k=-k) if k else 0.0 * sp.eye(ny))
            # cells j and k - 1 - j lie k apart, one of them across the line of symmetry
            image = np.zeros((ny, ny))
            for j in range(k):
                image[j, k - 1 - j] = 1.0
            total = total + sp.kron(across + sp.csr_matrix(image), along)
        return sp.csr_matrix(total)


class Faces:
    """Sparse operators between cells and faces; `axis` 0 is along X. Faces lie between cells and
    on the edges, where the pressure is zero; nothing flows through the line of symmetry.
    """

    def __init__(self, cells: Cells) -> None:
        ny, nx = cells.shape
        one_x = sp.identity(nx)
        one_y = sp.identity(ny)
        along = _line(nx, cells.hx, closed=False)
        across = _line(ny, cells.hy, closed=True)
        pairs = [(sp.kron(one_y, a), sp.kron(b, one_x)) for a, b in zip(along, across, strict=True)]
        # gradient and mean of the faces, and what leaves the cells, each (along X, along Y)
        self.grade, self.mean, self.leave = (tuple(m.tocsr() for m in pair) for pair in pairs)
        self.carry = sp.kron(one_y, _carried(nx)).tocsr()
        self.upstream = sp.kron(one_y, sp.eye(nx + 1, nx, k=-1)).tocsr()


def _line(n: int, h: float, *, closed: bool) -> tuple[sp.spmatrix, sp.spmatrix, sp.spmatrix]:
    """Gradient and mean of faces (n + 1, n), and what leaves cells (n, n + 1); closed: nothing
    flows through the first face.
    """
    grade = ((sp.eye(n + 1, n) - sp.eye(n + 1, n, k=-1)) / h).tolil()
    grade[0, 0] = 0.0 if closed else 2.0 / h
    grade[n, n - 1] = -2.0 / h
    mean = (0.5 * (sp.eye(n + 1, n) + sp.eye(n + 1, n, k=-1))).tolil()
    mean[0, 0] = 1.0
    mean[n, n - 1] = 1.0
    return grade, mean, (sp.eye(n, n + 1, k=1) - sp.eye(n, n + 1)) / h


def _carried(n: int) -> sp.spmatrix:
    """What the outgoing faces of the cells of a line carry of theirs, (n + 1, n); none of the
    first face.
    """
    carried = np.zeros((n + 1, n))
    for face in range(2, n):
        carried[face, face - 2 : face + 1] = PARABOLA
    carried[1, 0:2] = (0.5, 0.5)
    carried[n, n - 2 : n] = (-0.5, 1.5)
    return sp.csr_matrix(carried)
