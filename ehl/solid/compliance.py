"""Half-space compliance of bilinear pressures on a graded rectangular mesh, by FFT.

The lines of nodes lie on an equidistant lattice. A pressure that is bilinear in the cells of the
mesh is bilinear in those of the lattice, too, so that the deflection at the nodes is a convolution
over the lattice, with no error but round-off; the kernel is the deflection of one hat function,
integrated in closed form. Beyond the edge of the mesh the pressure falls to zero within one
spacing of the lattice. A symmetric mesh holds y >= 0; the mirrored pressures are added in.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray
from scipy import fft, sparse

from ..arrays import Array
from ..scaling import ScaledCoating
from .layered import point_compliance

# distance in the longer lattice spacing from which a hat function is a point load with its second
# moments to 1e-6 of the compliance; the closed form loses (r/spacing)^4 of round-off
FAR = 32


@dataclass(frozen=True, slots=True)
class Lattice:
    """Lines of a mesh, and their numbers on the lattice, the first line zero."""

    x: Array  # shape (nx,) [-]
    y: Array  # shape (ny,) [-]
    i: NDArray[np.int_]  # shape (nx,)
    j: NDArray[np.int_]  # shape (ny,)
    symmetric: bool  # y >= 0 only

    @property
    def spacing(self) -> tuple[float, float]:
        """Spacing of the lattice along x and y [-]."""
        along = float(self.x[-1] - self.x[0]) / int(self.i[-1])
        return along, float(self.y[-1] - self.y[0]) / int(self.j[-1])


@dataclass(frozen=True, slots=True)
class Compliance:
    """Deflection at the nodes of a mesh by the pressure at its nodes."""

    lattice: Lattice
    spectrum: NDArray[np.complex128]  # of the kernel
    single: NDArray[np.complex64]  # the same
    size: tuple[int, int]  # of the transform
    to_x: sparse.csr_matrix  # from the lines of the mesh to those of the lattice
    to_y: sparse.csr_matrix
    diagonal: Array  # deflection of each node by its pressure, shape (nodes,) [-]

    def __matmul__(self, P: Array) -> Array:
        """Deflection [-], shape (nodes,), of nodal pressures [-], shape (nodes,)."""
        return self._deflected(P, self.spectrum)

    def in_single_precision(self, P: Array) -> Array:
        """Deflection to some 1e-6, in half the time: for the iterations of a linear system.

        Parameters
        ----------
        P : Array
            nodal pressures, shape (nodes,) [-]

        Returns
        -------
        Array
            deflection, shape (nodes,) [-]
        """
        return self._deflected(P, self.single)

    def _deflected(self, P: Array, spectrum: NDArray[np.complexfloating]) -> Array:
        lattice = self.lattice
        lines = self.to_y @ P.reshape(len(lattice.x), len(lattice.y)).T
        padded = np.zeros((self.to_x.shape[0], self.size[1]), dtype=spectrum.real.dtype)
        padded[:, : len(lines)] = self.to_x @ lines.T
        if lattice.symmetric:
            padded[:, self.size[1] - len(lines) + 1 :] = padded[:, len(lines) - 1 : 0 : -1]
        transformed = fft.fft(fft.rfft(padded, axis=1), n=self.size[0], axis=0)
        transformed *= spectrum
        deflection = fft.ifft(transformed, axis=0, overwrite_x=True)[lattice.i]
        return np.asarray(fft.irfft(deflection, n=self.size[1], axis=1)[:, lattice.j].ravel())


def corner_integrals(x: Array, y: Array) -> tuple[Array, Array, Array, Array]:
    """Integrals of (1, x, y, x y)/r over the rectangle from the origin to (x, y), r^2 = x^2 + y^2.

    x asinh(y/|x|) + y asinh(x/|y|) (Love, 1929), (y r + x^2 asinh(y/|x|))/2, the same with x and y
    exchanged, r^3/3; each up to functions of x or of y alone, which cancel in differences over the
    corners of a rectangle.

    Parameters
    ----------
    x : Array
        corner along x, any shape [-]
    y : Array
        corner along y, a shape that broadcasts with `x` [-]

    Returns
    -------
    one
        of 1/r, the common shape [-]
    first_x
        of x/r [-]
    first_y
        of y/r [-]
    mixed
        of x y/r [-]
    """
    r = np.hypot(x, y)
    x, y = (np.broadcast_to(side, r.shape) for side in (x, y))
    along = np.arcsinh(np.divide(y, np.abs(x), out=np.zeros_like(r), where=x != 0.0))
    across = np.arcsinh(np.divide(x, np.abs(y), out=np.zeros_like(r), where=y != 0.0))
    firsts = (0.5 * (y * r + x * x * along), 0.5 * (x * r + y * y * across))
    return x * along + y * across, *firsts, r**3 / 3.0


def hat_compliances(x: Sequence[Array], y: Sequence[Array]) -> Iterator[Array]:
    """Double integrals of P/r at the origin, P the bilinear hat function of each node (x[a],
    y[b]).

    The hat is zero on the lines x[a - 1], x[a + 1], y[b - 1], y[b + 1].

    Parameters
    ----------
    x : Sequence[Array]
        lines along x as seen from the origin, arrays of any shape [-]
    y : Sequence[Array]
        lines along y, arrays that broadcast with those of `x` [-]

    Yields
    ------
    Iterator[Array]
        integral for each a and b but the first and the last, b running faster, the common shape
        [-]
    """
    corners = [[corner_integrals(column, row) for row in y] for column in x[:2]]
    for a in range(1, len(x) - 1):
        corners.append([corner_integrals(x[a + 1], row) for row in y])
        for b in range(1, len(y) - 1):
            cells = product((0, 1), (0, 1))
            yield np.sum([_quarter(x, y, corners, (a, b), cell) for cell in cells], axis=0)
        del corners[0]


def _quarter(
    x: Sequence[Array],
    y: Sequence[Array],
    corners: Sequence[Sequence[tuple[Array, Array, Array, Array]]],
    node: tuple[int, int],
    cell: tuple[int, int],
) -> Array:
    """Integral of a hat function in one of the four cells around its node."""
    a, b = node
    i, j = cell
    west, east = corners[i : i + 2]  # `corners` begins with the column a - 1
    ends = (east[b + j], west[b + j], east[b - 1 + j], west[b - 1 + j])
    one, first_x, first_y, mixed = (p - q - r + s for p, q, r, s in zip(*ends, strict=True))
    # the hat is (x - x0)(y - y0)/area, (x0, y0) the opposite corner of the cell
    x0, y0 = x[a - 1 + 2 * i], y[b - 1 + 2 * j]
    area = (x[a] - x0) * (y[b] - y0)
    return np.asarray((mixed - y0 * first_x - x0 * first_y + x0 * y0 * one) / area)


def compliance(lattice: Lattice, factor: float, coating: ScaledCoating | None) -> Compliance:
    """Deflection operator: a factor times the double integral of P/r, and that of a coating.

    Parameters
    ----------
    lattice : Lattice
        lines of the mesh
    factor : float
        c_def [-]
    coating : ScaledCoating | None
        of one body; None: uncoated

    Returns
    -------
    Compliance
        the operator
    """
    hx, hy = lattice.spacing
    nx = int(lattice.i[-1]) + 1
    ny = int(lattice.j[-1]) + 1
    farthest = 2 * (ny - 1) if lattice.symmetric else ny - 1
    size = (fft.next_fast_len(2 * nx - 1), fft.next_fast_len(farthest + ny, real=True))
    rows = _distances(size[0], nx - 1)
    columns = _distances(size[1], farthest)
    x = hx * np.arange(rows.max() + 1, dtype=np.float64)
    y = hy * np.arange(columns.max() + 1, dtype=np.float64)
    kernel = factor * _kernel(x, y, hx, hy, coating)
    spectrum = fft.rfft2(kernel[np.ix_(rows, columns)])
    to_lines = (_prolongation(lattice.i), _prolongation(lattice.j))
    diagonal = near_field(lattice, (0, 0), factor, coating).diagonal()
    return Compliance(lattice, spectrum, spectrum.astype(np.complex64), size, *to_lines, diagonal)


def _distances(size: int, farthest: int) -> NDArray[np.int_]:
    """Distance in spacings for each entry of a periodic kernel: up to `farthest` on one side."""
    number = np.arange(size)
    return np.where(number <= farthest, number, size - number)


def _kernel(x: Array, y: Array, hx: float, hy: float, coating: ScaledCoating | None) -> Array:
    """Deflection at the distances `x`, `y` from the hat function of a lattice node [-]."""
    X = x[:, None]
    Y = y[None, :]
    square = np.maximum(X**2 + Y**2, hx * hx)
    second = (hx**2 * (3.0 * X**2 / square - 1.0) + hy**2 * (3.0 * Y**2 / square - 1.0)) / 12.0
    kernel = hx * hy * (1.0 + second / square) / np.sqrt(square)
    reach = FAR * max(hx, hy)
    X = X[x < reach]
    Y = Y[:, y < reach]
    values = next(hat_compliances((X - hx, X, X + hx), (Y - hy, Y, Y + hy)))
    kernel[np.ix_(x < reach, y < reach)] = values
    if coating is not None:
        kernel += hx * hy * hat_mean(coating, x[:, None], y[None, :], hx, hy)
    return kernel


def hat_mean(
    coating: ScaledCoating, x: Array, y: Array, hx: float | Array, hy: float | Array
) -> Array:
    """Mean of a coating's contribution over the hat function of (x, y).

    Two points in each direction, a standard deviation hx/sqrt(6), hy/sqrt(6) from the node.

    Parameters
    ----------
    coating : ScaledCoating
        of one body
    x : Array
        distance of the node along x, any shape [-]
    y : Array
        distance of the node along y, a shape that broadcasts with `x` [-]
    hx : float | Array
        half the width of the hat along x [-]
    hy : float | Array
        half the width of the hat along y [-]

    Returns
    -------
    Array
        mean compliance, the common shape [-]
    """
    ends = [(x + a * hx / 6**0.5, y + b * hy / 6**0.5) for a in (-1, 1) for b in (-1, 1)]
    return np.asarray(sum(point_compliance(coating, np.hypot(*end)) for end in ends) / 4.0)


def _prolongation(lines: NDArray[np.int_]) -> sparse.csr_matrix:
    """Linear interpolation from lines of the mesh to all of the lattice."""
    fine = np.arange(lines[-1] + 1)
    cell = np.minimum(np.searchsorted(lines, fine, side="right") - 1, len(lines) - 2)
    fraction = (fine - lines[cell]) / np.diff(lines)[cell]
    rows = np.concatenate((fine, fine))
    entries = (
        np.concatenate((1.0 - fraction, fraction)),
        (rows, np.concatenate((cell, cell + 1))),
    )
    return sparse.csr_matrix(entries, shape=(len(fine), len(lines)))


def near_field(
    lattice: Lattice, reach: tuple[int, int], factor: float, coating: ScaledCoating | None
) -> sparse.csr_matrix:
    """Compliance between nodes at most `reach` lines apart, less its smallest value for each node.

    The mirrored nodes are included: P/r less a constant, which the constant of the film takes up.

    Parameters
    ----------
    lattice : Lattice
        lines of the mesh
    reach : tuple[int, int]
        number of lines along x and along y
    factor : float
        c_def [-]
    coating : ScaledCoating | None
        of one body; None: uncoated

    Returns
    -------
    sparse.csr_matrix
        matrix, shape (nodes, nodes) [-]
    """
    nx, ny = len(lattice.x), len(lattice.y)
    rx, ry = reach
    x = _continued(lattice.x, rx, False)
    y = _continued(lattice.y, ry, lattice.symmetric)
    i = np.arange(nx)[:, None]
    j = np.arange(ny)[None, :]
    # distances of the lines around each node, the node itself in the middle
    along = [x[i + k] - x[i + rx + 1] for k in range(2 * rx + 3)]
    across = [y[j + k] - y[j + ry + 1] for k in range(2 * ry + 3)]
    blocks = []
    neighbours = product(range(-rx, rx + 1), range(-ry, ry + 1))
    for (a, b), values in zip(neighbours, hat_compliances(along, across), strict=True):
        if coating is not None:
            west, X, east = along[a + rx : a + rx + 3]
            south, Y, north = across[b + ry : b + ry + 3]
            sides = (0.5 * (east - west), 0.5 * (north - south))
            values += sides[0] * sides[1] * hat_mean(coating, X, Y, *sides)
        column = j + b
        if lattice.symmetric:
            column = np.abs(column)
        inside = (i + a >= 0) & (i + a < nx) & (column >= 0) & (column < ny)
        row = (i * ny + j)[inside]
        blocks.append((factor * values[inside], row, ((i + a) * ny + column)[inside]))
    values, row, column = (np.concatenate(arrays) for arrays in zip(*blocks, strict=True))
    if reach == (0, 0):
        return sparse.csr_matrix((values, (row, column)), shape=(nx * ny, nx * ny))
    rim = np.full(nx * ny, np.inf)
    areas = _areas(lattice)[column]
    np.minimum.at(rim, row, values / areas)
    values = values - rim[row] * areas
    return sparse.csr_matrix((values, (row, column)), shape=(nx * ny, nx * ny))


def _areas(lattice: Lattice) -> Array:
    """Integral of the hat function of each node, shape (nodes,) [-]."""
    along, across = (np.convolve(np.diff(lines), (0.5, 0.5)) for lines in (lattice.x, lattice.y))
    return np.outer(along, across).ravel()


def _continued(lines: Array, reach: int, mirrored: bool) -> Array:
    """Lines and reach + 1 more at either end: equidistant, or mirrored at the first."""
    more = np.arange(1, reach + 2)
    before = -lines[reach + 1 : 0 : -1] if mirrored else lines[0] - more[::-1] * np.diff(lines)[0]
    return np.concatenate((before, lines, lines[-1] + more * np.diff(lines)[-1]))
