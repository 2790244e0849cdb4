"""Compiled kernels of the contact solver: arrays and scalars in, results in place.

Reynolds' equation L(P) = f with

    L(P) = d_X(eps d_X P) + d_Y(eps d_Y P) - d_X(rho u H) - d_Y(rho v H),

Poiseuille terms by the conservative five-point stencil with eps averaged between nodes, O(hx^2 +
hy^2), Couette terms by second-order differences upstream, (3, -4, 1)/2, central where these leave
the grid. Arrays are stored with lines along x contiguous, shape (ny, nx). On a symmetric grid row
0 is the line y = 0 and the row below it is the mirror image of row 1.
"""

import numpy as np

from ..compiled import compiled
from ..oil._elementary_kernels import exponential, logarithm

LOWER = 4  # sub-diagonals of the line system
UPPER = 3  # super-diagonals of the line system
WIDTH = LOWER + UPPER + 1
REACH = LOWER + 3  # kernel entries needed to either side
EXPONENT_LIMIT = 600.0  # largest ln(eta/eta_0), keeps exp() finite
# kinds of nodes: how the relaxation changes them
FIXED = 0
GAUSS_SEIDEL = 1
JACOBI = 2


@compiled
def flow_properties(
    P, H, slope, pressure, exponent, dense_1, dense_2, speed, eps, rho, rho_slope, first, stop
):
    """eps = rho H^3/(eta lambda), ln(eta) = s [(1 + q P)^z - 1], rho = 1 + d1 P/(1 + d2 P) and
    d(rho)/dP at every node of the lines from `first` to before `stop`.
    """
    rise = np.empty(P.shape[1])
    scratch = np.empty(P.shape[1])
    for j in range(first, stop):
        # 1. ln of (1 + q P)^z
        for i in range(rise.size):
            rise[i] = 1.0 + pressure * max(P[j, i], 0.0)
        logarithm(rise, scratch)
        for i in range(rise.size):
            rise[i] = min(exponent * rise[i], EXPONENT_LIMIT)
        # 2. ln of eta_0/eta
        exponential(rise, scratch)
        for i in range(rise.size):
            rise[i] = max(slope * (1.0 - rise[i]), -EXPONENT_LIMIT)
        # 3. density and flow coefficient
        exponential(rise, scratch)
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
def _across(j, i, flow, H, hy):
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
def _operator(i, P, north, south, eps, eps_north, eps_south, flow, H, cx, cy, hx):
    """d_X(eps d_X P) + d_Y(eps d_Y P) - d_X(flow H) at node i of a line."""
    e = eps[i]
    poiseuille = cx * (
        (eps[i + 1] + e) * (P[i + 1] - P[i]) - (e + eps[i - 1]) * (P[i] - P[i - 1])
    ) + cy * ((eps_north[i] + e) * (north[i] - P[i]) - (e + eps_south[i]) * (P[i] - south[i]))
    return poiseuille - _along(i, flow, H, hx)


@compiled
def reynolds_operator(P, H, eps, flow_x, flow_y, lateral, hx, hy, symmetric, out):
    """d_X(eps d_X P) + d_Y(eps d_Y P) - d_X(flow_x H) - d_Y(flow_y H) at interior nodes, zero on
    the edge.

    flow_y is used if `lateral`.
    """
    ny, nx = P.shape
    out[:, :] = 0.0
    cx, cy = 0.5 / (hx * hx), 0.5 / (hy * hy)
    for j in range(0 if symmetric else 1, ny - 1):
        s = j - 1 if j > 0 else 1
        for i in range(1, nx - 1):
            out[j, i] = _operator(
                i, P[j], P[j + 1], P[s], eps[j], eps[j + 1], eps[s], flow_x[j], H[j], cx, cy, hx
            )
            if lateral:
                out[j, i] -= _across(j, i, flow_y, H, hy)


@compiled
def residual_sums(P, H, residual, flow_x, flow_y, lateral, hx, hy):
    """Sums over the fluid nodes inside the box: |residual|, residual, |d_X(flow_x H) + d_Y(flow_y
    H)|.
    """
    size = 0.0
    balance = 0.0
    divergence = 0.0
    for j in range(P.shape[0] - 1):
        for i in range(1, P.shape[1] - 1):
            if P[j, i] > 0.0:
                couette = _along(i, flow_x[j], H[j], hx)
                if lateral and j > 0:
                    couette += _across(j, i, flow_y, H, hy)
                size += abs(residual[j, i])
                balance += residual[j, i]
                divergence += abs(couette)
    return size, balance, divergence


@compiled
def _line_kinds(P, residual, eps, eps_north, eps_south, cx, cy, threshold, kind):
    """Fixed where cavitated with a residual that asks for a lower pressure still; Gauss-Seidel
    where Poiseuille flow dominates; distributive Jacobi elsewhere (Venner and Lubrecht, 2000, sec.
    5.5).
    """
    for i in range(1, P.size - 1):
        e = eps[i]
        along = cx * (eps[i + 1] + eps[i - 1] + 2.0 * e)
        across = cy * (eps_north[i] + eps_south[i] + 2.0 * e)
        if P[i] <= 0.0 and residual[i] >= 0.0:
            kind[i] = FIXED
        elif max(along, across) > threshold:
            kind[i] = GAUSS_SEIDEL
        else:
            kind[i] = JACOBI


@compiled
def _add_poiseuille(i, eps, eps_north, eps_south, kinds, cx, cy, wx, wy, band):
    """Add the derivative of d_X(eps d_X P) + d_Y(eps d_Y P) at node i to a line's system."""
    e = eps[i]
    east = cx * (eps[i + 1] + e)
    west = cx * (e + eps[i - 1])
    across = cy * (eps_north[i] + eps_south[i] + 2.0 * e)
    centre = east + west + across
    spread = 1.0 if kinds[i + LOWER] == JACOBI else 0.0
    band[i, LOWER] -= centre + spread * (wx * (east + west) + wy * across)
    for side in (-1, 1):
        beside = west if side < 0 else east
        first = kinds[i + LOWER + side]
        second = kinds[i + LOWER + 2 * side]
        if first == GAUSS_SEIDEL:
            band[i, LOWER + side] += beside
        elif first == JACOBI:
            band[i, LOWER + side] += beside + wx * centre
        if second == JACOBI:
            band[i, LOWER + 2 * side] -= wx * beside


@compiled
def _line_system(
    eps, eps_north, eps_south, flow, slope, H, kinds, influence, cx, cy, hx, wx, wy, band
):
    """Derivative of the line's operator with respect to the changes at its own nodes, LOWER +
    UPPER diagonals.

    kinds[k + LOWER] is the kind of node k, FIXED beyond the line; influence[0, kind, m + REACH]
    the deflection at distance m from a change of that kind, zero for FIXED.
    """
    n = eps.size
    for i in range(1, n - 1):
        if kinds[i + LOWER] == FIXED:
            for d in range(WIDTH):
                band[i, d] = 1.0 if d == LOWER else 0.0
            continue
        up = -1 if flow[i] >= 0.0 else 1  # towards upstream
        inside = i > 1 if up < 0 else i < n - 2
        if inside:
            r0 = up * 1.5 * flow[i] / hx
            r1 = -up * 2.0 * flow[i + up] / hx
            r2 = up * 0.5 * flow[i + 2 * up] / hx
        else:
            r0 = 0.0
            r1 = -up * 0.5 * flow[i + up] / hx
            r2 = 0.0
        for d in range(WIDTH):
            kind = kinds[i + d]
            m = LOWER - d + REACH
            band[i, d] = (
                r0 * influence[0, kind, m]
                + r1 * influence[0, kind, m + up]
                + r2 * influence[0, kind, m + 2 * up]
            )
        _add_poiseuille(i, eps, eps_north, eps_south, kinds, cx, cy, wx, wy, band)
        if inside:
            band[i, LOWER] += up * 1.5 * slope[i] * H[i] / hx
            if kinds[i + LOWER + up] != FIXED:
                band[i, LOWER + up] -= up * 2.0 * slope[i + up] * H[i + up] / hx
            if kinds[i + LOWER + 2 * up] != FIXED:
                band[i, LOWER + 2 * up] += up * 0.5 * slope[i + 2 * up] * H[i + 2 * up] / hx


@compiled
def _add_lateral(j, flow, slope, H, kinds, influence, hy, band):
    """Add the derivative of -d_Y(flow H) by the film of this line and the two upstream."""
    ny, n = H.shape
    for i in range(1, n - 1):
        if kinds[i + LOWER] == FIXED:
            continue
        up = -1 if flow[j, i] >= 0.0 else 1
        if not (j > 1 if up < 0 else j < ny - 2):
            continue
        r0 = up * 1.5 * flow[j, i] / hy
        r1 = -up * 2.0 * flow[j + up, i] / hy
        r2 = up * 0.5 * flow[j + 2 * up, i] / hy
        for d in range(WIDTH):
            kind = kinds[i + d]
            m = LOWER - d + REACH
            band[i, d] += (
                r0 * influence[0, kind, m]
                + r1 * influence[1, kind, m]
                + r2 * influence[2, kind, m]
            )
        band[i, LOWER] += up * 1.5 * slope[j, i] * H[j, i] / hy


@compiled
def _influences(near, wx, wy, influence):
    """Deflection of a change in its line and the next two, [line, kind, distance + REACH]."""
    for m in range(-REACH, REACH + 1):
        k = abs(m)
        before = abs(m - 1)
        after = abs(m + 1)
        for r in range(3):
            influence[r, GAUSS_SEIDEL, m + REACH] = near[r, k]
            influence[r, JACOBI, m + REACH] = (
                near[r, k]
                - wx * (near[r, before] + near[r, after])
                - wy * (near[abs(r - 1), k] + near[r + 1, k])
            )


@compiled
def _solve_band(band, rhs):
    """Gaussian elimination without pivoting; the solution replaces `rhs`, the factors `band`."""
    n = rhs.size
    for i in range(1, n - 1):
        for d in range(max(0, LOWER + 1 - i), LOWER):
            k = i + d - LOWER
            factor = band[i, d] / band[k, LOWER]
            if factor != 0.0:
                for s in range(1, UPPER + 1):
                    band[i, d + s] -= factor * band[k, LOWER + s]
                rhs[i] -= factor * rhs[k]
    for i in range(n - 2, 0, -1):
        total = rhs[i]
        for s in range(1, min(UPPER, n - 2 - i) + 1):
            total -= band[i, LOWER + s] * rhs[i + s]
        rhs[i] = total / band[i, LOWER]


@compiled
def _apply_line(j, P, eps, kind, delta, wx, relief, spread):
    """Apply the solution of a line: Gauss-Seidel changes go into P at once, Jacobi changes into
    `spread` for the end of the sweep.

    The solution is turned into changes of pressure before it is damped: beside a zone of the other
    kind it may be far larger than the changes, and unequal damping of its parts would not cancel.
    """
    n = kind.size
    for i in range(n):
        spread[j, i] = delta[i] if kind[i] == JACOBI else 0.0
    for i in range(1, n - 1):
        if kind[i] == GAUSS_SEIDEL:
            step = delta[i] - wx * (spread[j, i - 1] + spread[j, i + 1])
            e = eps[j, i]
            P[j, i] = max(P[j, i] + relief * (0.4 + 0.6 * e / (e + 1.0)) * step, 0.0)


@compiled
def relax_lines(
    P, H, eps, flow_x, slope_x, flow_y, slope_y, lateral, f, near, hx, hy, symmetric, relief,
    switch, kinds, spread, first, stop,
):  # fmt: skip
    """First part of a hybrid line sweep, Venner and Lubrecht (2000), sec. 5.5: every second line
    from `first` to before `stop`; the film stays as it is.

    All changes of a line follow together from the linearised operator, the deflection truncated to
    a band. A Jacobi change d is +d at its node, -wx d to either side and -wy d in the next lines,
    so that its deflection is local.

    near[r, m]: deflection at distance m hx in the r-th next line from a unit pressure. flow_x,
    flow_y: density times the velocity of the Couette flow, slope_x, slope_y: their derivatives by
    P; those of y are used if `lateral`. kinds, spread: kind of each node, and the changes left to
    `spread_changes`. Lines of one colour, even or odd, are independent of each other.
    """
    nx = P.shape[1]
    cx, cy = 0.5 / (hx * hx), 0.5 / (hy * hy)
    wx, wy = _neighbour_weights(hx, hy)
    influence = np.zeros((3, 3, 2 * REACH + 1))
    _influences(near, wx, wy, influence)
    threshold = 2.0 * switch * near[0, 0] / hx
    band = np.zeros((nx, WIDTH))
    delta = np.zeros(nx)
    padded = np.zeros(nx + 2 * LOWER, dtype=np.int8)
    kind = padded[LOWER : LOWER + nx]
    for j in range(first, stop, 2):
        s = j - 1 if j > 0 else 1
        # 1. residual of the line
        for i in range(1, nx - 1):
            delta[i] = f[j, i] - _operator(
                i, P[j], P[j + 1], P[s], eps[j], eps[j + 1], eps[s], flow_x[j], H[j], cx, cy, hx
            )
            if lateral:
                delta[i] += _across(j, i, flow_y, H, hy)
        # 2. kinds of its nodes
        _line_kinds(P[j], delta, eps[j], eps[j + 1], eps[s], cx, cy, threshold, kind)
        for i in range(1, nx - 1):
            if kind[i] == FIXED:
                delta[i] = 0.0
        # 3. linear system of its changes
        _line_system(
            eps[j], eps[j + 1], eps[s], flow_x[j], slope_x[j], H[j], padded, influence, cx, cy, hx,
            wx, wy, band,
        )  # fmt: skip
        if lateral:
            _add_lateral(j, flow_y, slope_y, H, padded, influence, hy, band)
        # 4. solution and changes
        _solve_band(band, delta)
        _apply_line(j, P, eps, kind, delta, wx, relief, spread)
        kinds[j] = kind


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
    """
    wx, wy = _neighbour_weights(hx, hy)
    for j in range(first, stop):
        s = j - 1 if j > 0 else 1
        for i in range(1, P.shape[1] - 1):
            change = -wy * (spread[s, i] + spread[j + 1, i])
            if kinds[j, i] != GAUSS_SEIDEL:
                change += spread[j, i] - wx * (spread[j, i - 1] + spread[j, i + 1])
            P[j, i] = max(P[j, i] + damping * change, 0.0)
