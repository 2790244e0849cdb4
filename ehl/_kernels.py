"""Compiled kernels of the contact solver: arrays and scalars in, results in place.

Arrays are stored with lines along x contiguous, shape (ny, nx). On a symmetric grid row 0 is the line y = 0 and the
row below it is the mirror image of row 1. The readable NumPy twins stand in `reynolds.py` and `relaxation.py`.
"""

from __future__ import annotations

import numpy as np
from numba import njit

LOWER = 4  # sub-diagonals kept in the line system
UPPER = 3  # super-diagonals kept in the line system
WIDTH = LOWER + UPPER + 1
REACH = LOWER + 3  # kernel entries needed to either side
EXPONENT_LIMIT = 600.0  # largest ln(eta/eta_0), keeps exp() finite
FIXED, GAUSS_SEIDEL, JACOBI = 0, 1, 2  # what the relaxation does at a node

OPTIONS = {"cache": True, "nogil": True, "fastmath": False, "error_model": "numpy"}


@njit(**OPTIONS)
def flow_properties(P, H, slope, pressure, exponent, dense_1, dense_2, speed, eps, rho, rho_slope):
    """eps = rho H^3/(eta lambda), rho and d(rho)/dP at every node."""
    ny, nx = P.shape
    for j in range(ny):
        for i in range(nx):
            p = P[j, i]
            h = max(H[j, i], 0.0)
            cube = h * h * h / speed
            if p <= 0.0:
                rho[j, i] = 1.0
                rho_slope[j, i] = dense_1
                eps[j, i] = cube
                continue
            log_eta = slope * (np.exp(exponent * np.log1p(pressure * p)) - 1.0)
            denominator = 1.0 / (1.0 + dense_2 * p)
            density = 1.0 + dense_1 * p * denominator
            rho[j, i] = density
            rho_slope[j, i] = dense_1 * denominator * denominator
            eps[j, i] = density * cube * np.exp(-min(log_eta, EXPONENT_LIMIT))


@njit(**OPTIONS)
def _operator(i, P, north, south, eps, eps_north, eps_south, rho, H, cx, cy, hx):
    """d_X(eps d_X P) + d_Y(eps d_Y P) - d_X(rho H) at node i of a line; upstream second order wedge."""
    e = eps[i]
    poiseuille = cx * ((eps[i + 1] + e) * (P[i + 1] - P[i]) - (e + eps[i - 1]) * (P[i] - P[i - 1])) + cy * (
        (eps_north[i] + e) * (north[i] - P[i]) - (e + eps_south[i]) * (P[i] - south[i])
    )
    if i > 1:
        wedge = 1.5 * rho[i] * H[i] - 2.0 * rho[i - 1] * H[i - 1] + 0.5 * rho[i - 2] * H[i - 2]
    else:
        wedge = 0.5 * (rho[i + 1] * H[i + 1] - rho[i - 1] * H[i - 1])
    return poiseuille - wedge / hx


@njit(**OPTIONS)
def reynolds_operator(P, H, eps, rho, hx, hy, symmetric, out):
    """d_X(eps d_X P) + d_Y(eps d_Y P) - d_X(rho H) at interior nodes, zero on the edge."""
    ny, nx = P.shape
    out[:, :] = 0.0
    cx, cy = 0.5 / (hx * hx), 0.5 / (hy * hy)
    for j in range(0 if symmetric else 1, ny - 1):
        s = j - 1 if j > 0 else 1
        for i in range(1, nx - 1):
            out[j, i] = _operator(i, P[j], P[j + 1], P[s], eps[j], eps[j + 1], eps[s], rho[j], H[j], cx, cy, hx)


@njit(**OPTIONS)
def _line_kinds(P, residual, eps, eps_north, eps_south, cx, cy, threshold, kind):
    """Fixed: cavitated and content; Gauss-Seidel where Poiseuille flow rules; distributive Jacobi elsewhere."""
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


@njit(**OPTIONS)
def _line_system(eps, eps_north, eps_south, rho, rho_slope, H, kind, single, spread, cx, cy, hx, wx, wy, band):
    """Derivative of the line's operator with respect to the changes at its own nodes, LOWER + UPPER diagonals."""
    n = kind.size
    for i in range(1, n - 1):
        for d in range(WIDTH):
            band[i, d] = 0.0
        if kind[i] == FIXED:
            band[i, LOWER] = 1.0
            continue
        e = eps[i]
        east, west = cx * (eps[i + 1] + e), cx * (e + eps[i - 1])
        across = cy * (eps_north[i] + eps_south[i] + 2.0 * e)
        centre = east + west + across
        if i > 1:
            r0, r1, r2 = 1.5 * rho[i] / hx, -2.0 * rho[i - 1] / hx, 0.5 * rho[i - 2] / hx
        else:
            r0, r1, r2 = 0.0, -0.5 * rho[i - 1] / hx, 0.0
        for k in range(max(1, i - LOWER), min(n - 2, i + UPPER) + 1):
            m = i - k + REACH
            if kind[k] == GAUSS_SEIDEL:
                band[i, k - i + LOWER] = -(r0 * single[m] + r1 * single[m - 1] + r2 * single[m - 2])
            elif kind[k] == JACOBI:
                band[i, k - i + LOWER] = -(r0 * spread[m] + r1 * spread[m - 1] + r2 * spread[m - 2])
        if kind[i] == JACOBI:
            band[i, LOWER] -= centre + wx * (east + west) + wy * across
        else:
            band[i, LOWER] -= centre
        for side in (-1, 1):
            k = i + side
            near = west if side < 0 else east
            if 0 < k < n - 1 and kind[k] != FIXED:
                band[i, k - i + LOWER] += near + (wx * centre if kind[k] == JACOBI else 0.0)
            k = i + 2 * side
            if 0 < k < n - 1 and kind[k] == JACOBI:
                band[i, k - i + LOWER] -= wx * near
        if i > 1:
            band[i, LOWER] -= 1.5 * rho_slope[i] * H[i] / hx
            if kind[i - 1] != FIXED:
                band[i, LOWER - 1] += 2.0 * rho_slope[i - 1] * H[i - 1] / hx
            if i > 2 and kind[i - 2] != FIXED:
                band[i, LOWER - 2] -= 0.5 * rho_slope[i - 2] * H[i - 2] / hx


@njit(**OPTIONS)
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


@njit(**OPTIONS)
def _apply_line(j, P, eps, kind, delta, wx, wy, damping, relief, symmetric, change):
    """Changes of a line from its solution: at Gauss-Seidel nodes into P at once, elsewhere into `change`.

    The solution is turned into changes of pressure before it is damped: beside a zone of the other kind it may be far
    larger than the changes, and unequal damping of its parts would not cancel.
    """
    n = kind.size
    for i in range(1, n - 1):
        step = delta[i]
        if kind[i - 1] == JACOBI:
            step -= wx * delta[i - 1]
        if kind[i + 1] == JACOBI:
            step -= wx * delta[i + 1]
        if kind[i] == GAUSS_SEIDEL:
            e = eps[j, i]
            P[j, i] = max(P[j, i] + relief * (0.4 + 0.6 * e / (e + 1.0)) * step, 0.0)
        else:
            change[j, i] += damping * step
        if kind[i] == JACOBI:
            share = wy * damping * delta[i]
            change[j + 1, i] -= share
            if j > 0:
                change[j - 1, i] -= share
                if symmetric and j == 1:
                    change[0, i] -= share


@njit(**OPTIONS)
def relax_lines(P, H, eps, rho, rho_slope, f, near, near_next, hx, hy, symmetric, damping, relief, switch, change):
    """One hybrid line sweep over P; the film stays as it is.

    near[m], near_next[m]: deflection at distance m hx in the same and in the next line from a unit pressure.
    """
    ny, nx = P.shape
    cx, cy = 0.5 / (hx * hx), 0.5 / (hy * hy)
    wx = 0.5 * np.sqrt(hy) / (np.sqrt(hx) + np.sqrt(hy))
    wy = 0.5 - wx
    single, spread = np.empty(2 * REACH + 1), np.empty(2 * REACH + 1)
    for m in range(-REACH, REACH + 1):
        k = abs(m)
        single[m + REACH] = near[k]
        spread[m + REACH] = near[k] - wx * (near[abs(m - 1)] + near[abs(m + 1)]) - 2.0 * wy * near_next[k]
    threshold = 2.0 * switch * near[0] / hx
    band, delta, kind = np.zeros((nx, WIDTH)), np.zeros(nx), np.zeros(nx, dtype=np.int8)
    change[:, :] = 0.0
    for j in range(0 if symmetric else 1, ny - 1):
        s = j - 1 if j > 0 else 1
        for i in range(1, nx - 1):
            delta[i] = f[j, i] - _operator(
                i, P[j], P[j + 1], P[s], eps[j], eps[j + 1], eps[s], rho[j], H[j], cx, cy, hx
            )
        _line_kinds(P[j], delta, eps[j], eps[j + 1], eps[s], cx, cy, threshold, kind)
        for i in range(1, nx - 1):
            if kind[i] == FIXED:
                delta[i] = 0.0
        _line_system(
            eps[j], eps[j + 1], eps[s], rho[j], rho_slope[j], H[j], kind, single, spread, cx, cy, hx, wx, wy, band
        )
        _solve_band(band, delta)
        _apply_line(j, P, eps, kind, delta, wx, wy, damping, relief, symmetric, change)
    for j in range(0 if symmetric else 1, ny - 1):
        for i in range(1, nx - 1):
            P[j, i] = max(P[j, i] + change[j, i], 0.0)
