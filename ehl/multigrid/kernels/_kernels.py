"""Compiled kernels of the contact solver: arrays and scalars in, results in place.

Reynolds' equation L(P) = f with

    L(P) = d_X(eps d_X P) + d_Y(eps d_Y P) - d_X(rho u H) - d_Y(rho v H),

Poiseuille terms by the conservative five-point stencil with eps averaged between nodes, O(hx^2 +
hy^2), Couette terms by second-order differences upstream, (3, -4, 1)/2, central where these leave
the grid. Arrays are stored with lines along x contiguous, shape (ny, nx). On a symmetric grid row
0 is the line y = 0 and the row below it is the mirror image of row 1.

A term that a film does not have is None in place of its array. Kernels are compiled for the types
of their arguments, so that nothing is compiled for it.
"""

import numpy as np

from ...compiled import compiled
from ...oil._elementary_kernels import exponential, logarithm

EXPONENT_LIMIT = 600.0  # largest ln(eta/eta_0), keeps exp() finite


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
    # as `_along`, both sides of a node at hand
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
