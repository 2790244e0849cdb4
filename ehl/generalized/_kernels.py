"""Columns of film, compiled: the integrals of the generalized Reynolds equation, Yang and Wen
(1990), by the stress of `_stress_kernels`.

With 1/eta_e = (1/h) int dz/eta*, 1/eta'_e = (1/h^2) int z dz/eta*, rho_e = (1/h) int rho dz,
rho'_e = (1/h^2) int rho int_0^z dz'/eta* dz, rho''_e = (1/h^3) int rho int_0^z z' dz'/eta* dz, the
mass flux is -(rho/eta)_e h^3/12 grad p + h [rho'_e eta_e (u_b - u_a) + rho_e u_a],

    (rho/eta)_e = 12 (eta_e rho'_e/eta'_e - rho''_e).

rheology, section, work: as in `_stress_kernels`.
"""

import numpy as np

from ..compiled import compiled
from ..oil._elementary_kernels import exponential
from ..oil._kernels import column_density, column_log_viscosity, density_ratio, viscosity
from ..oil._rheology_kernels import NEWTONIAN
from ._stress_kernels import (
    BEND,
    CHANGE,
    ETA,
    FLUIDITY,
    LOG_ETA,
    MASS,
    RHO,
    T_XX,
    T_XY,
    T_YY,
    TAU_X,
    TAU_Y,
    column_fluidity,
    column_limit,
    column_stress,
    first_guess,
)


@compiled
def column_properties(p, temperature, oil, section, work):
    """Viscosity [Pa s] and density over rho_0 in a column; returns its mean temperature [K]."""
    mean = 0.0
    column_log_viscosity(p, temperature, oil, work[LOG_ETA])
    column_density(p, temperature, oil, work[RHO])
    for k in range(section[1].size):
        work[ETA, k] = work[LOG_ETA, k]
    exponential(work[ETA])
    for k in range(section[1].size):
        work[ETA, k] *= oil[2]
        mean += section[1][k] * temperature[k]
    return mean


@compiled
def newtonian_column(rise, rate, section, work):
    """`solve_column` of a Newtonian oil without a limiting stress, in closed form [Pa]."""
    nodes, weights, _ = section
    fluidity = moment = 0.0
    for k in range(nodes.size):
        fluid = 1.0 / work[ETA, k]
        work[FLUIDITY, k] = work[T_XX, k] = work[T_YY, k] = fluid
        work[T_XY, k] = 0.0
        fluidity += weights[k] * fluid
        moment += weights[k] * (nodes[k] - 0.5) * fluid
    return (rate[0] - moment * rise[0]) / fluidity, (rate[1] - moment * rise[1]) / fluidity


@compiled
def is_newtonian(rheology):
    """Whether an oil neither thins nor has a limiting stress."""
    return int(rheology[0]) == NEWTONIAN and not np.isfinite(rheology[4])


@compiled
def solve_column(p, temperature, start, rise, rate, oil, section, rheology, work):
    """Stress in the middle of a column and whether it converged; fills the workspace.

    start: first guess (tau_x, tau_y), not a number where there is none [Pa].
    """
    mean_temperature = column_properties(p, temperature, oil, section, work)
    if is_newtonian(rheology):
        t_x, t_y = newtonian_column(rise, rate, section, work)
        return t_x, t_y, True
    eta = work[ETA]
    limit, margin = column_limit(p, mean_temperature, eta, np.hypot(rate[0], rate[1]), rheology)
    if not np.isfinite(start[0] + start[1]):
        start = first_guess(eta, rate, section, limit, rheology)
    t_x, t_y, converged = column_stress(start, rise, rate, section, limit, margin, rheology, work)
    column_fluidity(work)
    return t_x, t_y, converged


@compiled
def mass_weights(section, work):
    """Weights of f in rho int f dz' over a column of height 1, to the workspace [-]."""
    _, weights, cumulative = section
    for m in range(weights.size):
        work[MASS, m] = 0.0
    for k in range(weights.size):
        dense = weights[k] * work[RHO, k]
        for m in range(weights.size):
            work[MASS, m] += dense * cumulative[k, m]


@compiled
def column_integrals(row, section, work):
    """Integrals of f, z f, rho int f dz' and rho int z' f dz' over a column of height 1, f a row
    of the workspace.
    """
    nodes, weights, _ = section
    mean = moment = first = second = 0.0
    for k in range(nodes.size):
        f = work[row, k]
        mean += weights[k] * f
        moment += weights[k] * nodes[k] * f
        first += work[MASS, k] * f
        second += work[MASS, k] * nodes[k] * f
    return mean, moment, first, second


@compiled
def column_tangent(section, work):
    """Diagonal of the tangent of the flux, in the unit of (rho/eta)_e."""
    a_xx, b_xx, c_xx, d_xx = column_integrals(T_XX, section, work)
    a_xy, b_xy, c_xy, _ = column_integrals(T_XY, section, work)
    a_yy, b_yy, c_yy, d_yy = column_integrals(T_YY, section, work)
    determinant = a_xx * a_yy - a_xy * a_xy
    m_xx = (a_yy * b_xx - a_xy * b_xy) / determinant
    m_xy = (a_yy * b_xy - a_xy * b_yy) / determinant
    m_yx = (a_xx * b_xy - a_xy * b_xx) / determinant
    m_yy = (a_xx * b_yy - a_xy * b_xy) / determinant
    return 12.0 * (c_xx * m_xx + c_xy * m_yx - d_xx), 12.0 * (c_xy * m_xy + c_yy * m_yy - d_yy)


@compiled
def steeper_fluidity(rise, section, work):
    """d(1/eta*)/d(ln |grad p|) at the nodes of a column, to the workspace [1/(Pa s)].

    The stress in the middle gives way so that the mean rate stays: sum of w T d(tau) = 0 with
    d(tau) = d(tau_m) + (z/h - 1/2) h grad p, T the tangent fluidity; the secant one changes by
    the tangent less the secant one along tau, per relative change of |tau|: the bend.
    """
    nodes, weights, _ = section
    j_xx = j_xy = j_yy = b_x = b_y = 0.0
    for k in range(nodes.size):
        w = weights[k]
        t_xx, t_xy, t_yy = w * work[T_XX, k], w * work[T_XY, k], w * work[T_YY, k]
        x, y = (nodes[k] - 0.5) * rise[0], (nodes[k] - 0.5) * rise[1]
        j_xx += t_xx
        j_xy += t_xy
        j_yy += t_yy
        b_x += t_xx * x + t_xy * y
        b_y += t_xy * x + t_yy * y
    determinant = j_xx * j_yy - j_xy * j_xy
    d_x = (j_xy * b_y - j_yy * b_x) / determinant
    d_y = (j_xy * b_x - j_xx * b_y) / determinant
    for k in range(nodes.size):
        x, y = d_x + (nodes[k] - 0.5) * rise[0], d_y + (nodes[k] - 0.5) * rise[1]
        along = work[TAU_X, k] * x + work[TAU_Y, k] * y
        work[CHANGE, k] = work[BEND, k] / work[ETA, k] * along


@compiled
def gradient_power(rise, mean, moment, first, section, work):
    """Change of moment/mean*first - second, the integrals of 1/eta*, with ln |grad p|."""
    steeper_fluidity(rise, section, work)
    a, b, c, d = column_integrals(CHANGE, section, work)
    return (b * first + moment * c - moment / mean * first * a) / mean - d


@compiled
def flow_factors(
    p, h, gradient, speed_a, speed_b, temperature, oil, section, rheology, middle, poiseuille,
    couette, tangent, power, work
):  # fmt: skip
    """Factors of every column of a grid; returns the number of columns without a converged stress.

    p, h: shape (ny, nx) [Pa], [m]; gradient, speed_a, speed_b: (2, ny, nx) [Pa/m], [m/s];
    temperature: (ny, nx, n) [K]; middle: (2, ny, nx), first guess of the stress in the middle and
    its result [Pa], to be guessed here where it is not a number. Results, all over rho/eta or rho
    at the temperature of operation: poiseuille, tangent (2, ny, nx): the factor (rho/eta)_e and
    the tangent of the whole flux along x and y [-]; couette: (2, ny, nx), flux of the surfaces
    over h [m/s]; power: d(ln (rho/eta)_e)/d(ln |grad p|) [-]. Columns without a film keep 1, the
    mean velocity and 0. work: (ROWS, n), for a column.
    """
    ny, nx = p.shape
    unsolved = 0
    newtonian = is_newtonian(rheology)
    for j in range(ny):
        for i in range(nx):
            height = h[j, i]
            u, v = speed_a[0, j, i], speed_a[1, j, i]
            du, dv = speed_b[0, j, i] - u, speed_b[1, j, i] - v
            if height <= 0.0:
                poiseuille[j, i] = tangent[0, j, i] = tangent[1, j, i] = 1.0
                power[j, i] = 0.0
                couette[0, j, i], couette[1, j, i] = u + 0.5 * du, v + 0.5 * dv
                continue
            rise = (height * gradient[0, j, i], height * gradient[1, j, i])
            rate = (du / height, dv / height)
            start = (middle[0, j, i], middle[1, j, i])
            middle[0, j, i], middle[1, j, i], converged = solve_column(
                p[j, i], temperature[j, i], start, rise, rate, oil, section, rheology, work
            )
            unsolved += 0 if converged else 1
            mass_weights(section, work)
            mean, moment, first, second = column_integrals(FLUIDITY, section, work)
            reference = density_ratio(p[j, i], oil[4], oil)
            thick = viscosity(p[j, i], oil[4], oil) / reference
            factor = moment / mean * first - second
            poiseuille[j, i] = 12.0 * factor * thick
            if newtonian:
                tangent[0, j, i] = tangent[1, j, i] = poiseuille[j, i]
                power[j, i] = 0.0
            else:
                power[j, i] = gradient_power(rise, mean, moment, first, section, work) / factor
                along, across = column_tangent(section, work)
                tangent[0, j, i], tangent[1, j, i] = along * thick, across * thick
            dense = 0.0
            for k in range(section[1].size):
                dense += section[1][k] * work[RHO, k]
            couette[0, j, i] = (first / mean * du + dense * u) / reference
            couette[1, j, i] = (first / mean * dv + dense * v) / reference
    return unsolved
