"""Compiled linear systems of the line relaxation, LANES lines at once.

The lines stand side by side, a number of each in one register: what belongs to a node is a row of
COLUMNS fields of LANES numbers each. Rows and fields lie at distances that the compiler knows, and
no number is asked for its neighbour in another line, so that loops over the lanes become single
instructions. A window is the part of that array with the rows of a node and of four to either
side.
"""

import numpy as np

from ...compiled import compiled

LANES = 8  # lines solved at once, as many as fit a register of 512 bits
LOWER = 4  # sub-diagonals of the line system
UPPER = 3  # super-diagonals of the line system
WIDTH = LOWER + UPPER + 1
REACH = LOWER + 3  # kernel entries needed
# where the fields of a node begin in its row, after the WIDTH diagonals
RIGHT = WIDTH * LANES  # right-hand side, in the end the solution
EPS = (WIDTH + 1) * LANES
SIDES = (WIDTH + 2) * LANES  # sum of eps in the two next lines
FLOW = (WIDTH + 3) * LANES
DENSITY = (WIDTH + 4) * LANES  # H times the derivative of the flow by P
GAUSS = (WIDTH + 5) * LANES  # one where the node is Gauss-Seidel, else zero
SPREAD = (WIDTH + 6) * LANES  # one where it is Jacobi, else zero
# minus the derivative of d_Y(flow H) by the film of this line and the two upstream, and by P
LATERAL = (WIDTH + 7) * LANES
# behind a node that its oil does not fill: one, and the share of that oil that leaves along the
# line
FRONT = (WIDTH + 11) * LANES
SHARE = (WIDTH + 12) * LANES
# of what a node stores over time: its derivative by the film, and by the pressure at that film
STORED = (WIDTH + 13) * LANES
STORED_BY_PRESSURE = (WIDTH + 14) * LANES
COLUMNS = WIDTH + 15
ROW = COLUMNS * LANES
# the row of the node in a window, and the numbers of a window
HERE = LOWER * ROW
WINDOW = (LOWER + 1 + LOWER) * ROW


@compiled
def line_influences(near, weights):
    """Deflections at distances 0 to 6 in the line of a change and in the next two, from a change
    of each kind: [line][Gauss-Seidel, Jacobi][distance].
    """
    wx, wy = weights
    influence = np.empty((3, 2, REACH))
    for r in range(3):
        for m in range(REACH):
            influence[r, 0, m] = near[r, m]
            influence[r, 1, m] = (
                near[r, m]
                - wx * (near[r, abs(m - 1)] + near[r, m + 1])
                - wy * (near[abs(r - 1), m] + near[r + 1, m])
            )
    return (
        (_distances(influence[0, 0]), _distances(influence[0, 1])),
        (_distances(influence[1, 0]), _distances(influence[1, 1])),
        (_distances(influence[2, 0]), _distances(influence[2, 1])),
    )


@compiled
def _distances(m):
    """The entries of an array of REACH numbers."""
    return m[0], m[1], m[2], m[3], m[4], m[5], m[6]


@compiled
def _upstream(flow, scale, behind, ahead, centred, values):
    """Weights in -d_X(values of the two nodes before, this one, the two after), upstream by the
    sign of `flow`; where the stencil leaves the line, as `behind` and `ahead` say by a zero,
    centred or none; scale: 1/hx, or zero for none at all.
    """
    forward = scale if flow >= 0.0 else 0.0
    back = forward * behind
    front = (scale - forward) * ahead
    west = 2.0 * back + 0.5 * centred * (forward - back)
    east = 2.0 * front + 0.5 * centred * (scale - forward - front)
    return (
        -0.5 * back * values[0],
        west * values[1],
        1.5 * (front - back) * values[2],
        -east * values[3],
        0.5 * front * values[4],
    )


@compiled
def _around(w, field, lane):
    """A field of a node, the two before it and the two after it."""
    at = HERE + field + lane
    return w[at - 2 * ROW], w[at - ROW], w[at], w[at + ROW], w[at + 2 * ROW]


@compiled
def _free(w, lane):
    """One where a node is not fixed, else zero."""
    return w[HERE + GAUSS + lane] + w[HERE + SPREAD + lane]


@compiled
def _change(w, d, lane, weights, gauss, jacobi):
    """Set the derivative by the change at a neighbour, `d` diagonals from the first, through the
    film of a node and the two before it; gauss, jacobi: deflections of these by either kind.
    """
    by_gauss = weights[0] * gauss[0] + weights[1] * gauss[1] + weights[2] * gauss[2]
    by_jacobi = weights[0] * jacobi[0] + weights[1] * jacobi[1] + weights[2] * jacobi[2]
    at = d * ROW + lane
    w[HERE + d * LANES + lane] = w[at + GAUSS] * by_gauss + w[at + SPREAD] * by_jacobi


@compiled
def _set_wedge(w, gauss, jacobi, scale, behind, ahead):
    """Derivative of -d_X(flow H) at a node by the changes at its WIDTH neighbours through the
    film there and in the two nodes before; gauss, jacobi: deflection at distances 0 to 6 from a
    change of that kind.
    """
    g0, g1, g2, g3, g4, g5 = gauss[:6]
    j0, j1, j2, j3, j4, j5 = jacobi[:6]
    for lane in range(LANES):
        flow = _around(w, FLOW, lane)
        f = _upstream(flow[2], scale * _free(w, lane), behind, ahead, 1.0, flow)
        _change(w, 0, lane, f, (g2, g3, g4), (j2, j3, j4))
        _change(w, 1, lane, f, (g1, g2, g3), (j1, j2, j3))
        _change(w, 2, lane, f, (g0, g1, g2), (j0, j1, j2))
        _change(w, 3, lane, f, (g1, g0, g1), (j1, j0, j1))
        _change(w, 4, lane, f, (g2, g1, g0), (j2, j1, j0))
        _change(w, 5, lane, f, (g3, g2, g1), (j3, j2, j1))
        _change(w, 6, lane, f, (g4, g3, g2), (j4, j3, j2))
        _change(w, 7, lane, f, (g5, g4, g3), (j5, j4, j3))


@compiled
def _add_backward(w, gauss, jacobi, scale, behind, ahead):
    """Add what `_set_wedge` leaves out where the flow runs towards smaller x: the derivative
    through the film in the two nodes after.
    """
    for lane in range(LANES):
        flow = _around(w, FLOW, lane)
        f = _upstream(flow[2], scale * _free(w, lane), behind, ahead, 1.0, flow)
        for d in range(WIDTH):
            near = abs(LOWER - d + 1)
            far = abs(LOWER - d + 2)
            by_gauss = f[3] * gauss[near] + f[4] * gauss[far]
            by_jacobi = f[3] * jacobi[near] + f[4] * jacobi[far]
            at = d * ROW + lane
            w[HERE + d * LANES + lane] += w[at + GAUSS] * by_gauss + w[at + SPREAD] * by_jacobi


@compiled
def _add_lateral(w, lines):
    """Add the derivative of -d_Y(flow H) by the film of this line and the two upstream; lines:
    deflections at distances 0 to 6 in these, from changes of either kind.
    """
    for d in range(WIDTH):
        g0 = lines[0][0][abs(LOWER - d)]
        g1 = lines[1][0][abs(LOWER - d)]
        g2 = lines[2][0][abs(LOWER - d)]
        j0 = lines[0][1][abs(LOWER - d)]
        j1 = lines[1][1][abs(LOWER - d)]
        j2 = lines[2][1][abs(LOWER - d)]
        for lane in range(LANES):
            own = w[HERE + LATERAL + lane]
            second = w[HERE + LATERAL + LANES + lane]
            third = w[HERE + LATERAL + 2 * LANES + lane]
            gauss = w[d * ROW + GAUSS + lane]
            spread = w[d * ROW + SPREAD + lane]
            w[HERE + d * LANES + lane] += gauss * (
                own * g0 + second * g1 + third * g2
            ) + spread * (own * j0 + second * j1 + third * j2)
    for lane in range(LANES):
        w[HERE + LOWER * LANES + lane] += w[HERE + LATERAL + 3 * LANES + lane]


@compiled
def _add_storage(w, gauss, jacobi, weight):
    """Add the derivative of what a node stores, with a minus: through its film by the changes at
    its WIDTH neighbours, and through the density by its own change and by what those beside it
    spread to it.
    """
    for d in range(WIDTH):
        by_gauss = gauss[abs(LOWER - d)]
        by_jacobi = jacobi[abs(LOWER - d)]
        for lane in range(LANES):
            at = d * ROW + lane
            change = w[at + GAUSS] * by_gauss + w[at + SPREAD] * by_jacobi
            w[HERE + d * LANES + lane] -= w[HERE + STORED + lane] * change
    for lane in range(LANES):
        own = w[HERE + STORED_BY_PRESSURE + lane]
        spread = _around(w, SPREAD, lane)
        row = HERE + lane
        w[row + 3 * LANES] += weight * own * spread[1]
        w[row + 4 * LANES] -= own
        w[row + 5 * LANES] += weight * own * spread[3]


@compiled
def _add_pressure(w, mesh, weights, behind, ahead):
    """Add the derivative of d_X(eps d_X P) + d_Y(eps d_Y P), and that of -d_X(flow H) through the
    density, by the changes at a node and the two to either side; a fixed node's is one by itself
    alone. mesh: 0.5/hx^2, 0.5/hy^2, 1/hx.
    """
    cx, cy, scale = mesh
    wx, wy = weights
    for lane in range(LANES):
        free = _free(w, lane)
        eps = _around(w, EPS, lane)
        east = free * cx * (eps[3] + eps[2])
        west = free * cx * (eps[2] + eps[1])
        across = free * cy * (w[HERE + SIDES + lane] + 2.0 * eps[2])
        centre = east + west + across
        density = _around(w, DENSITY, lane)
        d = _upstream(w[HERE + FLOW + lane], scale * free, behind, ahead, 0.0, density)
        gauss = _around(w, GAUSS, lane)
        spread = _around(w, SPREAD, lane)
        row = HERE + lane
        w[row + 2 * LANES] += d[0] * (gauss[0] + spread[0]) - wx * west * spread[0]
        w[row + 3 * LANES] += (d[1] + west) * (gauss[1] + spread[1]) + wx * centre * spread[1]
        w[row + 4 * LANES] += d[2] - centre - spread[2] * (wx * (east + west) + wy * across)
        w[row + 4 * LANES] += 1.0 - free
        w[row + 5 * LANES] += (d[3] + east) * (gauss[3] + spread[3]) + wx * centre * spread[3]
        w[row + 6 * LANES] += d[4] * (gauss[4] + spread[4]) - wx * east * spread[4]


@compiled
def _add_front(w, gauss, jacobi, mesh, weights):
    """Take back what does not hold behind a node that its oil does not fill: what flows back over
    the front comes again with the flux, and the flux that enters does not change with the film.
    """
    cx, _, scale = mesh
    wx, _ = weights
    for lane in range(LANES):
        free = _free(w, lane)
        front = free * w[HERE + FRONT + lane]
        flow = _around(w, FLOW, lane)
        second = 0.5 * front * scale * flow[0]
        first = -1.5 * front * scale * flow[1]
        for d in range(WIDTH):
            near = abs(LOWER - d - 1)
            far = abs(LOWER - d - 2)
            by_gauss = first * gauss[near] + second * gauss[far]
            by_jacobi = first * jacobi[near] + second * jacobi[far]
            at = d * ROW + lane
            w[HERE + d * LANES + lane] += w[at + GAUSS] * by_gauss + w[at + SPREAD] * by_jacobi
        eps = _around(w, EPS, lane)
        west = free * w[HERE + SHARE + lane] * cx * (eps[2] + eps[1])
        back = _around(w, GAUSS, lane)
        spread = _around(w, SPREAD, lane)
        density = _around(w, DENSITY, lane)
        row = HERE + lane
        w[row + 2 * LANES] += wx * west * spread[0]
        w[row + 2 * LANES] += 0.5 * front * scale * density[0] * (back[0] + spread[0])
        w[row + 3 * LANES] -= west * (back[1] + spread[1]) + wx * west * spread[1]
        w[row + 4 * LANES] += west + spread[2] * wx * west
        w[row + 5 * LANES] -= wx * west * spread[3]


@compiled
def _eliminate(w):
    """Gaussian elimination of a node's row by the LOWER rows before it, without pivoting; the
    reciprocal of the pivot stays on the diagonal.
    """
    for lane in range(LANES):
        row = HERE + lane
        up = 4 * LANES + lane  # diagonal of the row four before
        factor = w[row] * w[up]
        second = w[row + LANES] - factor * w[up + LANES]
        third = w[row + 2 * LANES] - factor * w[up + 2 * LANES]
        fourth = w[row + 3 * LANES] - factor * w[up + 3 * LANES]
        right = w[row + RIGHT] - factor * w[up + 4 * LANES]
        up += ROW
        factor = second * w[up]
        third -= factor * w[up + LANES]
        fourth -= factor * w[up + 2 * LANES]
        pivot = w[row + 4 * LANES] - factor * w[up + 3 * LANES]
        right -= factor * w[up + 4 * LANES]
        up += ROW
        factor = third * w[up]
        fourth -= factor * w[up + LANES]
        pivot -= factor * w[up + 2 * LANES]
        east = w[row + 5 * LANES] - factor * w[up + 3 * LANES]
        right -= factor * w[up + 4 * LANES]
        up += ROW
        factor = fourth * w[up]
        pivot -= factor * w[up + LANES]
        w[row + 4 * LANES] = 1.0 / pivot
        w[row + 5 * LANES] = east - factor * w[up + 2 * LANES]
        w[row + 6 * LANES] -= factor * w[up + 3 * LANES]
        w[row + RIGHT] = right - factor * w[up + 4 * LANES]


@compiled
def _substitute(w, lanes):
    """Back-substitution of the row that begins the window; `lanes` is LANES."""
    for lane in range(lanes):
        pivot = 4 * LANES + lane
        right = RIGHT + lane
        total = w[right] - w[pivot + LANES] * w[right + ROW]
        total -= w[pivot + 2 * LANES] * w[right + 2 * ROW]
        total -= w[pivot + 3 * LANES] * w[right + 3 * ROW]
        w[right] = total * w[pivot]


@compiled
def solve_lines(work, lanes, lines, mesh, weights, reversing, backward, flow_y, empty, storage):
    """Changes of LANES lines from their fields: their linear systems, elimination from the first
    node to the last, and the way back. `lanes` is LANES, in a form that the compiler cannot see
    through: it would write out the short loop of the way back number by number. reversing,
    flow_y, empty, storage: as in `relax_lines`, None of a term that is not there; backward: true
    where the flow of some line runs towards smaller x.
    """
    last = work.size // ROW - 2 * LOWER - 2
    for i in range(1, last + 1):
        window = work[i * ROW : i * ROW + WINDOW]
        behind = 1.0 if i > 1 else 0.0
        ahead = 1.0 if i < last else 0.0
        _set_wedge(window, lines[0][0], lines[0][1], mesh[2], behind, ahead)
        if reversing is not None and backward:
            _add_backward(window, lines[0][0], lines[0][1], mesh[2], behind, ahead)
        _add_pressure(window, mesh, weights, behind, ahead)
        if flow_y is not None:
            _add_lateral(window, lines)
        if empty is not None and i > 1:
            _add_front(window, lines[0][0], lines[0][1], mesh, weights)
        if storage is not None:
            _add_storage(window, lines[0][0], lines[0][1], weights[0])
        _eliminate(window)
    for i in range(last, 0, -1):
        _substitute(work[(LOWER + i) * ROW : (LOWER + i) * ROW + WINDOW], lanes)
