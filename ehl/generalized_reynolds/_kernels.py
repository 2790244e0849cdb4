"""Columns of film, compiled: stress in the middle, and the integrals of the generalized Reynolds equation.

The readable NumPy twins and the equations stand in `columns.py`. law, stress, exponent, breadth: as in
`ehl.rheology._kernels`; nodes, weights, cumulative: those of a `Section`.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from ..properties._kernels import density_ratio, viscosity
from ..rheology._kernels import CARREAU_YASUDA, REE_EYRING, limiting_stress, shear_rate, shear_stress

LIMIT_EXCESS = 1e-3  # as in `columns`
NEWTON_STEPS = 100
TOLERANCE = 1e-12
ACCEPTED = 1e-8
OVERSHOOT = 0.5
HALVINGS = 60
CREEPING = 0.2

OPTIONS = {"cache": True, "nogil": True, "fastmath": False, "error_model": "numpy"}


@njit(**OPTIONS)
def newtonian_stress(tau, limit, margin, law, stress, exponent, breadth):
    """eta times the rate, and its derivative by tau, at a stress magnitude; a tangent from the margin on."""
    slope, beyond = 1.0, 0.0
    if np.isfinite(limit):
        share = min(tau / limit, 1.0 - margin)
        beyond = tau - share * limit
        slope = 1.0 / (1.0 - share)
        tau = -limit * np.log1p(-share)
    newtonian = shear_rate(tau, 1.0, np.inf, law, stress, exponent, breadth)
    if law == REE_EYRING:
        slope *= np.hypot(1.0, newtonian / stress)
    elif law == CARREAU_YASUDA and tau > 0.0:
        power = (newtonian / stress) ** breadth
        slope *= newtonian / tau / (1.0 + (exponent - 1.0) * power / (1.0 + power))
    return newtonian + slope * beyond, slope


@njit(**OPTIONS)
def limit_margin(eta, rate, limit, law, stress, exponent, breadth):
    """Share of the limiting stress below it from which on the law follows its tangent."""
    base = shear_stress(rate, eta.max(), np.inf, law, stress, exponent, breadth)
    return LIMIT_EXCESS / max(base / limit, 1.0)


@njit(**OPTIONS)
def _balance(tau_x, tau_y, rise_x, rise_y, eta, rate_x, rate_y, nodes, weights, limit, margin, law, stress, n, a):
    """Mean rate less the wanted one (2), its derivative by tau_m (xx, xy, yy), mean of its magnitude."""
    f_x, f_y, j_xx, j_xy, j_yy, scale = -rate_x, -rate_y, 0.0, 0.0, 0.0, np.hypot(rate_x, rate_y)
    for k in range(nodes.size):
        t_x, t_y = tau_x + (nodes[k] - 0.5) * rise_x, tau_y + (nodes[k] - 0.5) * rise_y
        magnitude = np.hypot(t_x, t_y)
        newtonian, slope = newtonian_stress(magnitude, limit, margin, law, stress, n, a)
        w = weights[k] / eta[k]
        if magnitude > 0.0:
            relative, e_x, e_y = newtonian / magnitude, t_x / magnitude, t_y / magnitude
        else:
            relative, e_x, e_y = 1.0, 0.0, 0.0
        f_x += w * relative * t_x
        f_y += w * relative * t_y
        scale += w * newtonian
        j_xx += w * (relative + (slope - relative) * e_x * e_x)
        j_xy += w * (slope - relative) * e_x * e_y
        j_yy += w * (relative + (slope - relative) * e_y * e_y)
    return f_x, f_y, j_xx, j_xy, j_yy, scale


@njit(**OPTIONS)
def column_stress(tau_x, tau_y, rise_x, rise_y, eta, rate_x, rate_y, nodes, weights, limit, margin, law, stress, n, a):
    """Stress in the middle of one column, from a first guess [Pa], and whether it is found.

    rise: h grad p [Pa]; eta: viscosity at the nodes [Pa s]; rate: difference of the surface velocities over h [1/s].
    """
    f_x, f_y, j_xx, j_xy, j_yy, scale = _balance(
        tau_x, tau_y, rise_x, rise_y, eta, rate_x, rate_y, nodes, weights, limit, margin, law, stress, n, a
    )
    size, creeping = np.hypot(f_x, f_y), False
    wanted = np.hypot(rate_x, rate_y)
    for _ in range(NEWTON_STEPS):
        if size <= TOLERANCE * scale:
            break
        determinant = j_xx * j_yy - j_xy * j_xy
        d_x = -(j_yy * f_x - j_xy * f_y) / determinant
        d_y = -(j_xx * f_y - j_xy * f_x) / determinant
        before, share = f_x * d_x + f_y * d_y, 1.0
        if creeping:
            share = np.log(min(max(size / max(wanted, scale * TOLERANCE), np.e), 1e12))
        for _ in range(HALVINGS):
            t_x, t_y = tau_x + share * d_x, tau_y + share * d_y
            f_x, f_y, j_xx, j_xy, j_yy, scale = _balance(
                t_x, t_y, rise_x, rise_y, eta, rate_x, rate_y, nodes, weights, limit, margin, law, stress, n, a
            )
            if f_x * d_x + f_y * d_y <= -OVERSHOOT * before:
                break
            share *= 0.5
        tau_x, tau_y = t_x, t_y
        last, size = size, np.hypot(f_x, f_y)
        creeping = size > CREEPING * last
    return tau_x, tau_y, size <= ACCEPTED * scale


@njit(**OPTIONS)
def first_guess(eta, rate_x, rate_y, weights, limit, law, stress, n, a):
    """Stress of the mean rate at the mean fluidity [Pa]."""
    rate = np.hypot(rate_x, rate_y)
    if rate == 0.0:
        return 0.0, 0.0
    mean = 1.0 / (weights / eta).sum()
    tau = shear_stress(rate, mean, limit, law, stress, n, a)
    return tau * rate_x / rate, tau * rate_y / rate


@njit(**OPTIONS)
def column_fluidity(tau_x, tau_y, rise_x, rise_y, eta, nodes, limit, margin, law, stress, n, a, fluidity):
    """1/eta* at the nodes of a column [1/(Pa s)]."""
    for k in range(nodes.size):
        t_x, t_y = tau_x + (nodes[k] - 0.5) * rise_x, tau_y + (nodes[k] - 0.5) * rise_y
        magnitude = np.hypot(t_x, t_y)
        newtonian, _ = newtonian_stress(magnitude, limit, margin, law, stress, n, a)
        fluidity[k] = (newtonian / magnitude if magnitude > 0.0 else 1.0) / eta[k]


@njit(**OPTIONS)
def column_flow(fluidity, rho, nodes, weights, cumulative):
    """(rho/eta)_e, rho'_e eta_e and rho_e of a column."""
    mean = moment = first = second = dense = 0.0
    for k in range(nodes.size):
        mean += weights[k] * fluidity[k]
        moment += weights[k] * nodes[k] * fluidity[k]
        dense += weights[k] * rho[k]
        to_here = to_here_z = 0.0
        for m in range(nodes.size):
            to_here += cumulative[k, m] * fluidity[m]
            to_here_z += cumulative[k, m] * nodes[m] * fluidity[m]
        first += weights[k] * rho[k] * to_here
        second += weights[k] * rho[k] * to_here_z
    return 12.0 * (moment / mean * first - second), first / mean, dense


@njit(**OPTIONS)
def column_properties(p, temperature, oil, weights, eta, rho):
    """Viscosity [Pa s] and density over rho_0 at the nodes of a column; returns its mean temperature [K]."""
    mean = 0.0
    for k in range(weights.size):
        eta[k] = viscosity(p, temperature[k], oil)
        rho[k] = density_ratio(p, temperature[k], oil)
        mean += weights[k] * temperature[k]
    return mean


@njit(**OPTIONS)
def flow_factors(
    p,
    h,
    gradient,
    speed_a,
    speed_b,
    temperature,
    oil,
    nodes,
    weights,
    cumulative,
    law,
    stress,
    exponent,
    breadth,
    limit_coefficient,
    limit_stress,
    limit_slope,
    limit_temperature,
    limit_minimum,
    middle,
    poiseuille,
    couette,
):
    """Factors of every column of a grid; returns the number of columns whose stress was not found.

    p, h: shape (ny, nx) [Pa], [m]; gradient, speed_a, speed_b: (2, ny, nx) [Pa/m], [m/s]; temperature: (ny, nx, n) [K];
    middle: (2, ny, nx), first guess of the stress in the middle and its result [Pa], to be guessed here where it is not
    a number; poiseuille: (rho/eta)_e over rho/eta at the temperature of operation; couette: (2, ny, nx), mass flux of
    the surfaces over h and over that density [m/s]. Columns without a film keep 1 and the mean velocity.
    """
    ny, nx = p.shape
    count, missed = nodes.size, 0
    eta, rho, fluidity = np.empty(count), np.empty(count), np.empty(count)
    for j in range(ny):
        for i in range(nx):
            u, v = speed_a[0, j, i], speed_a[1, j, i]
            du, dv = speed_b[0, j, i] - u, speed_b[1, j, i] - v
            if h[j, i] <= 0.0:
                poiseuille[j, i], couette[0, j, i], couette[1, j, i] = 1.0, u + 0.5 * du, v + 0.5 * dv
                continue
            mean_temperature = column_properties(p[j, i], temperature[j, i], oil, weights, eta, rho)
            limit = limiting_stress(
                p[j, i],
                mean_temperature,
                limit_coefficient,
                limit_stress,
                limit_slope,
                limit_temperature,
                limit_minimum,
            )
            r_x, r_y = du / h[j, i], dv / h[j, i]
            margin = limit_margin(eta, np.hypot(r_x, r_y), limit, law, stress, exponent, breadth)
            t_x, t_y = middle[0, j, i], middle[1, j, i]
            if not np.isfinite(t_x + t_y):
                t_x, t_y = first_guess(eta, r_x, r_y, weights, limit, law, stress, exponent, breadth)
            g_x, g_y = h[j, i] * gradient[0, j, i], h[j, i] * gradient[1, j, i]
            t_x, t_y, found = column_stress(
                t_x, t_y, g_x, g_y, eta, r_x, r_y, nodes, weights, limit, margin, law, stress, exponent, breadth
            )
            missed += 0 if found else 1
            middle[0, j, i], middle[1, j, i] = t_x, t_y
            column_fluidity(t_x, t_y, g_x, g_y, eta, nodes, limit, margin, law, stress, exponent, breadth, fluidity)
            flow, slide, dense = column_flow(fluidity, rho, nodes, weights, cumulative)
            reference = density_ratio(p[j, i], oil[4], oil)
            poiseuille[j, i] = flow / reference * viscosity(p[j, i], oil[4], oil)
            couette[0, j, i] = (slide * du + dense * u) / reference
            couette[1, j, i] = (slide * dv + dense * v) / reference
    return missed
