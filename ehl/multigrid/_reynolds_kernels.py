"""Compiled Reynolds equation: its residual, and the linear systems of the line relaxation, LANES
lines at once.

The lines stand side by side, a number of each in one register: what belongs to a node is a row of
COLUMNS fields of LANES numbers each. Rows and fields lie at distances that the compiler knows, and
no number is asked for its neighbour in another line, so that loops over the lanes become single
instructions. A window is the part of that array with the rows of a node and of four to either
side.
"""

import numpy as np

from ..compiled import compiled
from ..oil._kernels import copy, exponential, logarithm

EXPONENT_LIMIT = 600.0  # largest ln(eta/eta_0), keeps exp() finite

LANES = 8  # lines solved at once, as many as fit a register of 512 bits
LOWER = 4  # sub-diagonals of the line system
UPPER = 3  # super-diagonals of the line system
WIDTH = LOWER + UPPER + 1
REACH = LOWER + 3  # kernel entries needed
# places at which the fields of a node begin in its row, after the WIDTH diagonals
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
# oil that a node stores over time: derivative by the film, and by the pressure at that film
STORED = (WIDTH + 13) * LANES
STORED_BY_PRESSURE = (WIDTH + 14) * LANES
COLUMNS = WIDTH + 15
ROW = COLUMNS * LANES
# the row of the node in a window, and the numbers of a window
HERE = LOWER * ROW
WINDOW = (LOWER + 1 + LOWER) * ROW

# kinds of nodes: how the relaxation changes them
FIXED = 0
GAUSS_SEIDEL = 1
JACOBI = 2


@compiled
def flow_properties(
    P, H, slope, pressure, exponent, dense_1, dense_2, thinning, at, speed, eps, rho, rho_slope,
    first, stop
):  # fmt: skip
    """eps = rho H^3/(eta lambda), ln(eta) = s [(1 + q P)^z - 1], rho = 1 + d1 P/(1 + d2 P) and
    d(rho)/dP at every node of the lines from `first` to before `stop`. thinning: share of the
    change of ln(eta), from what it is `at` the pressure of the factors, that these take back;
    empty without any.
    """
    rise = np.empty(P.shape[1])
    for j in range(first, stop):
        # 1. ln of (1 + q P)^z
        for i in range(rise.size):
            rise[i] = 1.0 + pressure * max(P[j, i], 0.0)
        logarithm(rise)
        for i in range(rise.size):
            rise[i] = min(exponent * rise[i], EXPONENT_LIMIT)
        # 2. ln of eta_0/eta
        exponential(rise)
        for i in range(rise.size):
            rise[i] = slope * (1.0 - rise[i])
        if thinning.size > 0:
            for i in range(rise.size):
                rise[i] -= thinning[j, i] * (rise[i] + at[j, i])
        for i in range(rise.size):
            rise[i] = max(rise[i], -EXPONENT_LIMIT)
        # 3. density and flow coefficient
        exponential(rise)
        _flow_of_line(P[j], H[j], rise, dense_1, dense_2, speed, eps[j], rho[j], rho_slope[j])


@compiled
def _flow_of_line(P, H, fluidity, dense_1, dense_2, speed, eps, rho, rho_slope):
    """Density and flow coefficient of one line from eta_0/eta."""
    for i in range(P.size):
        p = max(P[i], 0.0)
        h = max(H[i], 0.0)
        denominator = 1.0 / (1.0 + dense_2 * p)
        density = 1.0 + dense_1 * p * denominator
        rho[i] = density
        rho_slope[i] = dense_1 * denominator * denominator
        eps[i] = density * (h * h * h / speed) * fluidity[i]


@compiled
def _along(i, flow, H, hx):
    """d_X(flow H) at node i: second order upstream, central in the first and last column."""
    if flow[i] >= 0.0:
        if i > 1:
            return (
                1.5 * flow[i] * H[i] - 2.0 * flow[i - 1] * H[i - 1] + 0.5 * flow[i - 2] * H[i - 2]
            ) / hx
    elif i < H.size - 2:
        return (
            -(1.5 * flow[i] * H[i] - 2.0 * flow[i + 1] * H[i + 1] + 0.5 * flow[i + 2] * H[i + 2])
            / hx
        )
    return 0.5 * (flow[i + 1] * H[i + 1] - flow[i - 1] * H[i - 1]) / hx


@compiled
def lateral_at(j, i, flow, H, hy):
    """d_Y(flow H): as `_along`, across the lines."""
    if flow[j, i] >= 0.0:
        if j > 1:
            return (
                1.5 * flow[j, i] * H[j, i]
                - 2.0 * flow[j - 1, i] * H[j - 1, i]
                + 0.5 * flow[j - 2, i] * H[j - 2, i]
            ) / hy
    elif j < H.shape[0] - 2:
        return (
            -(
                1.5 * flow[j, i] * H[j, i]
                - 2.0 * flow[j + 1, i] * H[j + 1, i]
                + 0.5 * flow[j + 2, i] * H[j + 2, i]
            )
            / hy
        )
    return 0.5 * (flow[j + 1, i] * H[j + 1, i] - flow[j - 1, i] * H[j - 1, i]) / hy


@compiled
def operator_of_line(P, north, south, eps, eps_north, eps_south, flow, H, hx, hy, out):
    """d_X(eps d_X P) + d_Y(eps d_Y P) - d_X(flow H) at the nodes of a line but its ends."""
    cx, cy = 0.5 / (hx * hx), 0.5 / (hy * hy)
    for i in range(1, P.size - 1):
        e = eps[i]
        along = (eps[i + 1] + e) * (P[i + 1] - P[i]) - (e + eps[i - 1]) * (P[i] - P[i - 1])
        across = (eps_north[i] + e) * (north[i] - P[i]) - (e + eps_south[i]) * (P[i] - south[i])
        out[i] = cx * along + cy * across
    # sums of `_along`, both sides of a node at hand
    for k in range(P.size - 4):
        own = 1.5 * flow[k + 2] * H[k + 2]
        before = own - 2.0 * flow[k + 1] * H[k + 1] + 0.5 * flow[k] * H[k]
        after = own - 2.0 * flow[k + 3] * H[k + 3] + 0.5 * flow[k + 4] * H[k + 4]
        forward = 1.0 if flow[k + 2] >= 0.0 else 0.0
        out[k + 2] -= (forward * before - (1.0 - forward) * after) / hx
    for i in (1, P.size - 2):
        out[i] -= _along(i, flow, H, hx)


@compiled
def reynolds_operator(P, H, eps, flow_x, flow_y, hx, hy, symmetric, out):
    """d_X(eps d_X P) + d_Y(eps d_Y P) - d_X(flow_x H) - d_Y(flow_y H) at interior nodes, zero on
    the edge; flow_y: None where nothing flows across the lines.
    """
    ny, nx = P.shape
    out[:, :] = 0.0
    for j in range(0 if symmetric else 1, ny - 1):
        s = abs(j - 1)
        operator_of_line(
            P[j], P[j + 1], P[s], eps[j], eps[j + 1], eps[s], flow_x[j], H[j], hx, hy, out[j]
        )
        if flow_y is not None:
            for i in range(1, nx - 1):
                out[j, i] -= lateral_at(j, i, flow_y, H, hy)


@compiled
def residual_sums(P, H, residual, flow_x, flow_y, hx, hy):
    """Sums over the nodes inside the box: |residual|; over those with pressure: residual,
    |d_X(flow_x H) + d_Y(flow_y H)|.
    """
    size = 0.0
    balance = 0.0
    divergence = 0.0
    for j in range(P.shape[0] - 1):
        for i in range(1, P.shape[1] - 1):
            size += abs(residual[j, i])  # a cavity that asks for pressure counts, too
            if P[j, i] > 0.0:
                couette = _along(i, flow_x[j], H[j], hx)
                if flow_y is not None and j > 0:
                    couette += lateral_at(j, i, flow_y, H, hy)
                balance += residual[j, i]
                divergence += abs(couette)
    return size, balance, divergence


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
    """Interleave the nodes whose oil does not fill the gap, at the nodes behind them."""
    for j in range(start, stop, 2):
        lane = (j - start) // 2
        for i in range(1, empty.shape[1]):
            at = (LOWER + i) * ROW + lane
            front = 1.0 if empty[j, i - 1] else 0.0
            work[at + FRONT] = front
            work[at + SHARE] = front * share[j, i - 1] if share.size > 0 else front


@compiled
def _interleave_lateral(flow, slope, H, hy, kinds, empty, start, stop, work):
    """Interleave the flow across the lines: zero where the stencil leaves the grid, and at fixed
    nodes; without what enters from a node whose oil does not fill the gap.
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
    """Interleave the oil that nodes store over time; nothing at fixed nodes."""
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
