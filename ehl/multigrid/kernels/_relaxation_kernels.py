"""Compiled hybrid line relaxation of the contact solver; see `_kernels` for the equation and the
layout of arrays, `_line_kernels` for the systems of the lines.
"""

import numpy as np

from ...compiled import compiled
from ...oil._elementary_kernels import copy
from ._kernels import lateral_at, operator_of_line
from ._line_kernels import (
    DENSITY,
    EPS,
    FLOW,
    FRONT,
    GAUSS,
    LANES,
    LATERAL,
    LOWER,
    RIGHT,
    ROW,
    SHARE,
    SIDES,
    SPREAD,
    STORED,
    STORED_BY_PRESSURE,
    line_influences,
    solve_lines,
)

# kinds of nodes: how the relaxation changes them
FIXED = 0
GAUSS_SEIDEL = 1
JACOBI = 2


@compiled
def _line_residual(j, P, H, eps, flow_x, flow_y, f, storage, hx, hy, residual):
    """f - L(P) at the nodes of line j, with what they store over time."""
    s = abs(j - 1)
    operator_of_line(
        P[j], P[j + 1], P[s], eps[j], eps[j + 1], eps[s], flow_x[j], H[j], hx, hy, residual
    )
    for i in range(1, residual.size - 1):
        residual[i] = f[j, i] - residual[i]
    if flow_y is not None:
        for i in range(1, residual.size - 1):
            residual[i] += lateral_at(j, i, flow_y, H, hy)
    if storage is not None:
        for i in range(1, residual.size - 1):
            residual[i] += storage[0, j, i] * H[j, i]


@compiled
def _line_kinds(j, P, residual, eps, mesh, threshold, kinds):
    """Fixed where cavitated with a residual that asks for a lower pressure still; Gauss-Seidel
    where Poiseuille flow dominates; distributive Jacobi elsewhere (Venner and Lubrecht, 2000, sec.
    5.5).
    """
    cx, cy, _ = mesh
    s = abs(j - 1)
    for i in range(1, residual.size - 1):
        e = eps[j, i]
        along = cx * (eps[j, i + 1] + eps[j, i - 1] + 2.0 * e)
        across = cy * (eps[j + 1, i] + eps[s, i] + 2.0 * e)
        if P[j, i] <= 0.0 and residual[i] >= 0.0:
            kinds[j, i] = FIXED
        elif max(along, across) > threshold:
            kinds[j, i] = GAUSS_SEIDEL
        else:
            kinds[j, i] = JACOBI


@compiled
def _interleave(eps, flow, slope, H, residual, kinds, start, stop, work):
    """Fields of every second line from `start` to before `stop`, side by side; true if somewhere
    the flow runs towards smaller x.
    """
    backward = False
    n = eps.shape[1]
    for begin in range(0, n, LANES):  # what one line of the cache holds of each
        for j in range(start, stop, 2):
            lane = (j - start) // 2
            s = abs(j - 1)
            for i in range(begin, min(begin + LANES, n)):
                at = (LOWER + i) * ROW + lane
                kind = kinds[j, i]
                work[at + RIGHT] = residual[lane, i] if kind != FIXED else 0.0
                work[at + EPS] = eps[j, i]
                work[at + SIDES] = eps[j + 1, i] + eps[s, i]
                work[at + FLOW] = flow[j, i]
                work[at + DENSITY] = slope[j, i] * H[j, i]
                work[at + GAUSS] = 1.0 if kind == GAUSS_SEIDEL else 0.0
                work[at + SPREAD] = 1.0 if kind == JACOBI else 0.0
                backward |= flow[j, i] < 0.0
    return backward


@compiled
def _interleave_fill(empty, share, start, stop, work):
    """As `_interleave`, of the nodes whose oil does not fill the gap, at the nodes behind them."""
    for j in range(start, stop, 2):
        lane = (j - start) // 2
        for i in range(1, empty.shape[1]):
            at = (LOWER + i) * ROW + lane
            front = 1.0 if empty[j, i - 1] else 0.0
            work[at + FRONT] = front
            work[at + SHARE] = front * share[j, i - 1] if share.size > 0 else front


@compiled
def _interleave_lateral(flow, slope, H, hy, kinds, empty, start, stop, work):
    """As `_interleave`, of the flow across the lines: zero where the stencil leaves the grid, and
    at fixed nodes; without what enters from a node whose oil does not fill the gap.
    """
    for i in range(1, H.shape[1] - 1):
        row = work[(LOWER + i) * ROW + LATERAL : (LOWER + i + 1) * ROW]
        for j in range(start, stop, 2):
            lane = (j - start) // 2
            up = -1 if flow[j, i] >= 0.0 else 1
            inside = j > 1 if up < 0 else j < H.shape[0] - 2
            if inside and kinds[j, i] != FIXED:
                row[lane] = up * 1.5 * flow[j, i] / hy
                row[LANES + lane] = -up * 2.0 * flow[j + up, i] / hy
                row[2 * LANES + lane] = up * 0.5 * flow[j + 2 * up, i] / hy
                row[3 * LANES + lane] = up * 1.5 * slope[j, i] * H[j, i] / hy
                if empty is not None and empty[j + up, i]:
                    row[LANES + lane] = -up * 0.5 * flow[j + up, i] / hy
                    row[2 * LANES + lane] = 0.0
            else:
                row[lane : 4 * LANES : LANES] = 0.0


@compiled
def _interleave_storage(storage, H, kinds, start, stop, work):
    """As `_interleave`, of what nodes store over time; nothing at fixed nodes."""
    for j in range(start, stop, 2):
        lane = (j - start) // 2
        for i in range(1, H.shape[1] - 1):
            at = (LOWER + i) * ROW + lane
            free = 0.0 if kinds[j, i] == FIXED else 1.0
            work[at + STORED] = free * storage[0, j, i]
            work[at + STORED_BY_PRESSURE] = free * storage[1, j, i] * H[j, i]


@compiled
def _apply_line(P, eps, kind, delta, wx, relief, spread):
    """Apply the solution of a line: Gauss-Seidel changes go into P at once, Jacobi changes into
    `spread` for the end of the sweep.

    The solution is turned into changes of pressure before it is damped: beside a zone of the other
    kind it may be far larger than the changes, and unequal damping of its parts would not cancel.
    """
    for i in range(P.size):
        spread[i] = delta[i] if kind[i] == JACOBI else 0.0
    for i in range(1, P.size - 1):
        step = delta[i] - wx * (spread[i - 1] + spread[i + 1])
        e = eps[i]
        changed = max(P[i] + relief * (0.4 + 0.6 * e / (e + 1.0)) * step, 0.0)
        P[i] = changed if kind[i] == GAUSS_SEIDEL else P[i]


@compiled
def relax_lines(
    P, H, eps, flow_x, slope_x, flow_y, slope_y, reversing, f, storage, near, hx, hy, symmetric,
    rest, empty, share, relief, switch, kinds, spread, first, stop,
):  # fmt: skip
    """First part of a hybrid line sweep, Venner and Lubrecht (2000), sec. 5.5: every second line
    from `first` to before `stop`; the film stays as it is.

    All changes of a line follow together from the linearised operator, the deflection truncated to
    a band. A Jacobi change d is +d at its node, -wx d to either side and -wy d in the next lines,
    so that its deflection is local.

    near[r, m]: deflection at distance m hx in the r-th next line from a unit pressure. flow_x,
    flow_y: density times the velocity of the Couette flow, slope_x, slope_y: their derivatives by
    P; those of y None where nothing flows across the lines. reversing: None where no flow along
    the lines runs towards smaller x. storage: density and its derivative by P over a time step,
    shape (2, ny, nx), or None. rest, empty, share: residual, nodes whose oil does not fill the
    gap, and share of it that leaves them along the line, or None where all gaps are full.
    kinds, spread: kind of each node, and the changes left to `spread_changes`. Lines of one
    colour, even or odd, are independent of each other.
    """
    nx = P.shape[1]
    mesh = (0.5 / (hx * hx), 0.5 / (hy * hy), 1.0 / hx)
    weights = _neighbour_weights(hx, hy)
    lines = line_influences(near, weights)
    threshold = 2.0 * switch * near[0, 0] / hx
    residual = np.zeros((LANES, nx))
    work = np.zeros((nx + 2 * LOWER) * ROW)
    for start in range(first, stop, 2 * LANES):
        end = min(stop, start + 2 * LANES)
        # 1. residuals and kinds of the nodes
        for j in range(start, end, 2):
            own = residual[(j - start) // 2]
            if rest is not None:
                copy(rest[j], own)
            else:
                _line_residual(j, P, H, eps, flow_x, flow_y, f, storage, hx, hy, own)
            _line_kinds(j, P, own, eps, mesh, threshold, kinds)
        # 2. linear systems of the changes
        backward = _interleave(eps, flow_x, slope_x, H, residual, kinds, start, end, work)
        if flow_y is not None:
            _interleave_lateral(flow_y, slope_y, H, hy, kinds, empty, start, end, work)
        if empty is not None:
            _interleave_fill(empty, share, start, end, work)
        if storage is not None:
            _interleave_storage(storage, H, kinds, start, end, work)
        # 3. solution and changes
        solve_lines(
            work, len(residual), lines, mesh, weights, reversing, backward, flow_y, empty, storage
        )
        for j in range(start, end, 2):
            delta = work[LOWER * ROW + RIGHT + (j - start) // 2 :: ROW]
            _apply_line(P[j], eps[j], kinds[j], delta, weights[0], relief, spread[j])


@compiled
def _neighbour_weights(hx, hy):
    """Weights wx, wy of a distributive change, 2 wx + 2 wy = 1, in the ratio sqrt(hy) : sqrt(hx).

    Those of a discrete Laplacian, hy^2 : hx^2, leave the change of a whole line nearly
    undistributed across the lines of stretched cells: the sweep diverges (measured from hy = 6 hx
    on, at large L).
    """
    wx = 0.5 * np.sqrt(hy) / (np.sqrt(hx) + np.sqrt(hy))
    return wx, 0.5 - wx


@compiled
def spread_changes(P, kinds, spread, hx, hy, damping, first, stop):
    """Second part of a sweep: P += damping (d - wx d of either side - wy d of the next lines), P
    >= 0; Gauss-Seidel nodes already have the changes of their own line.

    Fixed nodes stay without pressure: what neighbours that are driven below zero distribute would
    give them a trace that the next sweep takes away, and the edge of the cavity never came to rest
    (250 random contacts: 21 instead of 38 need a second attempt). Behind a layer the
    trace would make them full, and their lines drag the neighbours down.
    """
    wx, wy = _neighbour_weights(hx, hy)
    for j in range(first, stop):
        s = j - 1 if j > 0 else 1
        for i in range(1, P.shape[1] - 1):
            if kinds[j, i] == FIXED:
                continue
            change = -wy * (spread[s, i] + spread[j + 1, i])
            if kinds[j, i] != GAUSS_SEIDEL:
                change += spread[j, i] - wx * (spread[j, i - 1] + spread[j, i + 1])
            P[j, i] = max(P[j, i] + damping * change, 0.0)
