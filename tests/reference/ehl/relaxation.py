"""The hybrid line relaxation in NumPy and SciPy: the reference for
`oilfilm.ehl.multigrid._reynolds_kernels.relax_lines`.

Along a line in x all changes follow together from the linearised Reynolds operator, the
deflection truncated to a band. Each node is one of three kinds (Venner and Lubrecht, 2000, section
5.5):

fixed         cavitated, and its residual asks for a lower pressure still
Gauss-Seidel  Poiseuille flow dominates: the change goes into P at once
Jacobi        deflection dominates: the change d is spread over the neighbours, +d at the node,
              -wx d to either side and -wy d to the next lines, so that its deflection is local;
              all lines are changed at the end of the sweep

Venner and Lubrecht's recipe is for square cells. On the stretched cells of wide ellipses it is
changed in three places, by local mode analysis and measurement: the weights (see
`neighbour_weights`), the switch, which rises with the 3/2 power of hy/hx because Gauss-Seidel
lines amplify deflections that are smooth across the lines, and the damping, which acts on the
changes of pressure and not on d.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve

from oilfilm.ehl.grid import Grid
from oilfilm.ehl.solid.deformation import DeflectionKernel

from .reynolds import reynolds_operator

Array = NDArray[np.float64]
Kinds = NDArray[np.int8]

FIXED = 0
GAUSS_SEIDEL = 1
JACOBI = 2
# sub- and super-diagonals kept
LOWER = 4
UPPER = 3


@dataclass(frozen=True, slots=True, kw_only=True)
class Line:
    """One line of a sweep: coefficients of its nodes, each of shape (nx,) [-]."""

    eps: Array
    eps_north: Array
    eps_south: Array
    flow: Array  # density times velocity along the line
    slope: Array  # its derivative by P
    H: Array
    lateral: "LateralFlow | None" = None
    storage: Array | None = None  # shape (2, nx)


@dataclass(frozen=True, slots=True, kw_only=True)
class LateralFlow:
    """Density times velocity across the lines, [on this line, the next, the second next] upstream
    of it [-].

    Shapes (nx, 3) and (nx,); zero where the stencil leaves the grid. `up` points upstream: -1, or
    +1 where the flow is negative.
    """

    flow: Array
    slope: Array
    up: Array


@dataclass(frozen=True, slots=True, kw_only=True)
class Flow:
    """Coefficients of a grid, each of shape (ny, nx) [-]; None for those of Y: no flow across the
    lines.
    """

    eps: Array
    flow_x: Array  # density times velocity along X
    slope_x: Array  # its derivative by P
    flow_y: Array | None = None
    slope_y: Array | None = None
    # density and its derivative by P over a time step, shape (2, ny, nx); None: nothing is stored
    storage: Array | None = None


def neighbour_weights(hx: float, hy: float) -> tuple[float, float]:
    """Weights wx, wy of a distributive change, 2 wx + 2 wy = 1 [-].

    On stretched cells the weights of a discrete Laplacian, in the ratio hy^2 : hx^2, leave the
    change of a whole line nearly undistributed across the lines, and the sweep diverges on wide
    ellipses (measured from hy = 6 hx on, at large L). The ratio sqrt(hy) : sqrt(hx) does not.
    """
    wx = 0.5 * np.sqrt(hy) / (np.sqrt(hx) + np.sqrt(hy))
    return wx, 0.5 - wx


def line_kinds(P: Array, residual: Array, line: Line, grid: Grid, threshold: float) -> Kinds:
    """Kind of every node of a line, shape (nx,); `threshold` in the units of eps/h^2 [-]."""
    kinds = np.full(P.size, FIXED, dtype=np.int8)
    e = line.eps
    along = 0.5 * (e[2:] + e[:-2] + 2.0 * e[1:-1]) / grid.hx**2
    across = 0.5 * (line.eps_north + line.eps_south + 2.0 * e)[1:-1] / grid.hy**2
    free = (P[1:-1] > 0.0) | (residual[1:-1] < 0.0)
    kinds[1:-1] = np.where(free, np.where(np.maximum(along, across) > threshold, GAUSS_SEIDEL, JACOBI), FIXED)
    return kinds


def line_matrix(line: Line, kinds: Kinds, grid: Grid, kernel: DeflectionKernel) -> Array:
    """Derivative of the operator at the nodes of a line with respect to their changes, shape (nx,
    nx) [-].

    Column k is the effect of a change at node k, `pressure` of it on the line itself and `film` of
    its deflection in this line and the two next; a fixed node keeps a unit row and column.
    """
    n, (wx, wy) = kinds.size, neighbour_weights(grid.hx, grid.hy)
    matrix = np.eye(n)
    index = np.arange(n)
    for k in range(1, n - 1):
        if kinds[k] == FIXED:
            continue
        distance = np.abs(index - k)
        near = distance <= LOWER + 2
        pressure = np.zeros(n)
        film = np.zeros((3, n))
        film[:, near] = kernel.near[:3, distance[near]]
        pressure[k] = 1.0
        across = 1.0
        if kinds[k] == JACOBI:
            for r in range(3):
                sides = kernel.near[r, np.abs(index - k - 1)[near]] + kernel.near[r, np.abs(index - k + 1)[near]]
                lines = kernel.near[abs(r - 1), distance[near]] + kernel.near[r + 1, distance[near]]
                film[r, near] -= wx * sides + wy * lines
            pressure[[k - 1, k + 1]] = -wx
            across = 1.0 + wy
        column = _column(pressure, film, across, line, grid, k)
        rows = slice(max(1, k - UPPER), min(n - 2, k + LOWER) + 1)
        matrix[:, k] = 0.0
        matrix[rows, k] = column[rows]
    matrix[kinds == FIXED] = np.eye(n)[kinds == FIXED]
    return matrix


def _column(pressure: Array, film: Array, across: float, line: Line, grid: Grid, k: int) -> Array:
    """Change of the operator along the line: Poiseuille along and across, wedge of the film and of
    the density.
    """
    e = line.eps
    column = np.zeros(pressure.size)
    flux = 0.5 * (e[1:] + e[:-1]) * np.diff(pressure) / grid.hx
    column[1:-1] = np.diff(flux) / grid.hx
    sideways = 0.5 * (line.eps_north + line.eps_south + 2.0 * e) / grid.hy**2
    column -= sideways * np.where(np.arange(pressure.size) == k, across, pressure)
    unit = np.zeros(pressure.size)
    unit[k] = 1.0
    column -= _upstream(line.flow, line.flow * film[0], np.where(unit, 0.0, line.flow * film[0])) / grid.hx
    compressed = line.slope * line.H * unit
    column -= _upstream(line.flow, compressed, np.zeros_like(unit)) / grid.hx
    if line.storage is not None:
        column -= line.storage[0] * film[0] + line.storage[1] * line.H * pressure
    if line.lateral is not None:
        column -= line.lateral.up * -(line.lateral.flow * film.T).sum(axis=1) / grid.hy
        column -= line.lateral.up * -1.5 * line.lateral.slope * line.H * unit / grid.hy
    return column


def _upstream(flow: Array, q: Array, edge: Array) -> Array:
    """Change of the wedge along the line where q = flow H changes; `edge` counts where the stencil
    is central.
    """
    change = np.zeros(q.size)
    for i in range(1, q.size - 1):
        up = -1 if flow[i] >= 0.0 else 1
        if 0 <= i + 2 * up < q.size:
            change[i] = -up * (1.5 * q[i] - 2.0 * q[i + up] + 0.5 * q[i + 2 * up])
        else:
            change[i] = up * 0.5 * edge[i + up]  # the film downstream is left out
    return change


def _lateral(flow: Flow, j: int) -> LateralFlow | None:
    """Flow across line j, from the lines upstream of it."""
    if flow.flow_y is None or flow.slope_y is None:
        return None
    v = flow.flow_y
    n = flow.flow_y.shape[1]
    up = np.where(v[j] >= 0.0, -1, 1)
    inside = (j + 2 * up >= 0) & (j + 2 * up < v.shape[0])
    lines = np.clip(j + np.outer(up, np.arange(3)), 0, v.shape[0] - 1)
    weights = np.array([1.5, -2.0, 0.5])
    return LateralFlow(
        flow=v[lines, np.arange(n)[:, None]] * weights * inside[:, None],
        slope=np.where(inside, flow.slope_y[j], 0.0),
        up=up.astype(np.float64),
    )


def relax_lines(
    P: Array, H: Array, flow: Flow, f: Array, grid: Grid, kernel: DeflectionKernel, damping: tuple[float, float, float]
) -> Array:
    """One hybrid line sweep at fixed film, even lines before odd ones; the new pressure, shape
    (ny, nx) [-].

    Parameters
    ----------
    P, H, f : ndarray, shape (ny, nx)
        Pressure, film and right-hand side of Reynolds' equation [-].
    flow : Flow
    grid : Grid
    kernel : DeflectionKernel
    damping : tuple of float
        Jacobi damping, factor on the Gauss-Seidel damping, switch between them [-].
    """
    P = P.copy()
    eps = flow.eps
    jacobi, relief, switch = damping
    wx, wy = neighbour_weights(grid.hx, grid.hy)
    threshold = 2.0 * switch * kernel.near[0, 0] / grid.hx
    first = 0 if grid.symmetric else 1
    kinds = np.zeros(P.shape, dtype=np.int8)
    spread = np.zeros_like(P)
    for j in (*range(first, grid.ny - 1, 2), *range(first + 1, grid.ny - 1, 2)):
        line = _line(flow, H, j)
        couette = (flow.flow_x, flow.flow_y)
        residual = (f - reynolds_operator(P, H, eps, couette, (grid.hx, grid.hy), grid.symmetric))[j]
        if line.storage is not None:
            residual += line.storage[0] * line.H
        kinds[j] = line_kinds(P[j], residual, line, grid, threshold)
        delta = solve(line_matrix(line, kinds[j], grid, kernel), np.where(kinds[j] == FIXED, 0.0, residual))
        spread[j] = np.where(kinds[j] == JACOBI, delta, 0.0)
        gauss_seidel = relief * (0.4 + 0.6 * eps[j] / (eps[j] + 1.0)) * (delta - wx * _sides(spread[j]))
        P[j] = np.where(kinds[j] == GAUSS_SEIDEL, np.maximum(P[j] + gauss_seidel, 0.0), P[j])
    above = np.vstack((spread[1:], 0.0 * spread[:1]))
    below = np.vstack((spread[1:2] if grid.symmetric else 0.0 * spread[:1], spread[:-1]))
    change = -wy * (above + below) + np.where(kinds == GAUSS_SEIDEL, 0.0, spread - wx * _sides(spread))
    change = np.where(kinds == FIXED, 0.0, change)
    rows = slice(first, -1)
    P[rows, 1:-1] = np.maximum(P + jacobi * change, 0.0)[rows, 1:-1]
    return P


def _sides(values: Array) -> Array:
    """Sum of the two neighbours along the line, zero beyond its ends."""
    padded = np.pad(values, [(0, 0)] * (values.ndim - 1) + [(1, 1)])
    return padded[..., :-2] + padded[..., 2:]


def _line(flow: Flow, H: Array, j: int) -> Line:
    return Line(
        eps=flow.eps[j],
        eps_north=flow.eps[j + 1],
        eps_south=flow.eps[abs(j - 1)],
        flow=flow.flow_x[j],
        slope=flow.slope_x[j],
        H=H[j],
        lateral=_lateral(flow, j),
        storage=None if flow.storage is None else flow.storage[:, j],
    )
