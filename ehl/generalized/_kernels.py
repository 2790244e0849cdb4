"""Columns of film, compiled: their stress, and the integrals of the generalized Reynolds equation,
Yang and Wen (1990).

With 1/eta_e = (1/h) int dz/eta*, 1/eta'_e = (1/h^2) int z dz/eta*, rho_e = (1/h) int rho dz,
rho'_e = (1/h^2) int rho int_0^z dz'/eta* dz, rho''_e = (1/h^3) int rho int_0^z z' dz'/eta* dz, the
mass flux is -(rho/eta)_e h^3/12 grad p + h [rho'_e eta_e (u_b - u_a) + rho_e u_a],

    (rho/eta)_e = 12 (eta_e rho'_e/eta'_e - rho''_e).

rheology, section, work: as in `_stress_kernels`.
"""

import numpy as np

from ..compiled import compiled, summing
from ..oil._kernels import (
    LIMIT_POWER,
    column_density,
    column_log_viscosity,
    exponential,
    exponential_of,
    shear_rate,
    shear_stress,
    unlimited,
)
from ..oil._laws import (
    CARREAU_YASUDA,
    LARGEST_ARGUMENT,
    NEWTONIAN,
    REE_EYRING,
    density_ratio,
    limiting_stress,
    viscosity,
)

LIMIT_EXCESS = 1e-3  # of the stress of plain sliding over the limiting stress
NEWTON_STEPS = 100
TOLERANCE = 1e-12  # of the mean shear rate over the mean of its magnitude across the film
# largest residual of a solved column: near a limiting stress round-off may exceed the tolerance
ACCEPTED = 1e-8
OVERSHOOT = 0.5  # share of the slope along a step that may remain beyond its minimum
HALVINGS = 60
# share of the residual after a step from which on the next is as long as for an exponential law
SLOW_REDUCTION = 0.2
# rows of the workspace: viscosity, density, 1/eta*, the tangent fluidity (xx, xy, yy),
# ln(eta/eta_0), mass weights, the change of 1/eta* with a steeper pressure
ETA, RHO, FLUIDITY, T_XX, T_XY, T_YY, LOG_ETA, MASS, CHANGE = range(9)
# stress and its ratios, and the weights over the viscosity
TAU_X, TAU_Y, SECANT, BEND, SHARE, ROWS = range(9, 15)


@compiled
def newtonian_stress(tau, limit, margin, rheology):
    """eta times the rate and its derivative by tau; a tangent from the margin on."""
    law, stress, exponent, breadth = rheology[:4]
    slope = 1.0
    excess = 0.0
    if np.isfinite(limit):
        share = min(tau / limit, 1.0 - margin)
        excess = tau - share * limit
        tau, slope = unlimited(share, limit, law)
        if law == CARREAU_YASUDA:  # a power law of the base stress stays tame beyond the margin
            tau += slope * excess
            excess = 0.0
    newtonian = shear_rate(tau, 1.0, np.inf, law, stress, exponent, breadth)
    if law == REE_EYRING:
        slope *= np.hypot(1.0, newtonian / stress)
    elif law == CARREAU_YASUDA and tau > 0.0:
        power = (newtonian / stress) ** breadth
        slope *= newtonian / tau / (1.0 + (exponent - 1.0) * power / (1.0 + power))
    return newtonian + slope * excess, slope


@compiled
def column_limit(p, temperature, eta, rate, rheology):
    """Limiting stress of a column [Pa], and the margin below it where the tangent begins [-]."""
    limit = limiting_stress(p, temperature, *rheology[4:])
    thickest = 0.0
    for k in range(eta.size):
        thickest = max(thickest, eta[k])
    base = shear_stress(rate, thickest, np.inf, *rheology[:4])
    margin = LIMIT_EXCESS / max(base / limit, 1.0)
    return limit, margin if int(rheology[0]) == NEWTONIAN else margin / LIMIT_POWER


@compiled
def eyring_ratios(stress, work):
    """`column_ratios` of Ree and Eyring's law without a limit, without jumps, so that several
    nodes are taken at a time: with x = |tau|/tau_E, sinh(x)/x and [cosh(x) - sinh(x)/x]/x^2, below
    x = 1 by their series, whose next terms are below 2e-17.
    """
    by_stress = 1.0 / stress
    for k in range(work.shape[1]):
        x, y = work[TAU_X, k] * by_stress, work[TAU_Y, k] * by_stress
        square = x * x + y * y
        size = np.sqrt(square)
        growing = exponential_of(min(size, LARGEST_ARGUMENT))
        falling = 1.0 / growing
        by_size = 1.0 / max(size, 1.0)
        secant = 0.5 * (growing - falling) * by_size
        bend = (0.5 * (growing + falling) - secant) * by_size * by_size
        q = min(square, 1.0)
        near = 1.0 / 355687428096000.0
        near = near * q + 1.0 / 1307674368000.0
        near = near * q + 1.0 / 6227020800.0
        near = near * q + 1.0 / 39916800.0
        near = near * q + 1.0 / 362880.0
        near = near * q + 1.0 / 5040.0
        near = near * q + 1.0 / 120.0
        near = near * q + 1.0 / 6.0
        near = near * q + 1.0
        bent = 16.0 / 355687428096000.0
        bent = bent * q + 14.0 / 1307674368000.0
        bent = bent * q + 12.0 / 6227020800.0
        bent = bent * q + 10.0 / 39916800.0
        bent = bent * q + 8.0 / 362880.0
        bent = bent * q + 6.0 / 5040.0
        bent = bent * q + 4.0 / 120.0
        bent = bent * q + 2.0 / 6.0
        if size < 1.0:
            secant = near
            bend = bent
        work[SECANT, k] = secant
        work[BEND, k] = bend * by_stress * by_stress


@compiled
def column_ratios(middle, rise, nodes, limit, margin, rheology, work):
    """Stress at the nodes [Pa], the secant ratio eta/eta* and the bend, what the ratio along the
    stress, eta d(rate)/d(tau), has more over |tau|^2 [1/Pa^2], to the workspace.
    """
    for k in range(nodes.size):
        work[TAU_X, k] = middle[0] + (nodes[k] - 0.5) * rise[0]
        work[TAU_Y, k] = middle[1] + (nodes[k] - 0.5) * rise[1]
    if int(rheology[0]) == REE_EYRING and not np.isfinite(limit):
        eyring_ratios(rheology[1], work)
        return
    for k in range(nodes.size):
        magnitude = np.hypot(work[TAU_X, k], work[TAU_Y, k])
        newtonian, slope = newtonian_stress(magnitude, limit, margin, rheology)
        secant = newtonian / magnitude if magnitude > 0.0 else 1.0
        work[SECANT, k] = secant
        work[BEND, k] = (slope - secant) / magnitude**2 if magnitude > 0.0 else 0.0


@summing
def stress_balance(rate, work):
    """Mean rate less the given one, its derivative by tau_m (xx, xy, yy), mean magnitude."""
    f_x = f_y = j_xx = j_xy = j_yy = total = 0.0
    for k in range(work.shape[1]):
        t_x, t_y = work[TAU_X, k], work[TAU_Y, k]
        fluid = work[SHARE, k] * work[SECANT, k]
        bent = work[SHARE, k] * work[BEND, k]
        f_x += fluid * t_x
        f_y += fluid * t_y
        total += fluid * np.sqrt(t_x * t_x + t_y * t_y)
        j_xx += fluid + bent * t_x * t_x
        j_xy += bent * t_x * t_y
        j_yy += fluid + bent * t_y * t_y
    scale = np.sqrt(rate[0] * rate[0] + rate[1] * rate[1]) + total
    return f_x - rate[0], f_y - rate[1], j_xx, j_xy, j_yy, scale


@compiled
def column_stress(start, rise, rate, section, limit, margin, rheology, work):
    """Stress in the middle of one column, from a first guess (tau_x, tau_y) [Pa], and whether it
    converged; the ratios there to the workspace, which has the viscosity at the nodes.

    rise: h grad p [Pa]; rate: difference of the surface velocities over h [1/s].
    """
    nodes, weights, _ = section
    law = (limit, margin, rheology, work)
    for k in range(nodes.size):
        work[SHARE, k] = weights[k] / work[ETA, k]
    tau_x, tau_y = start
    column_ratios(start, rise, nodes, *law)
    f_x, f_y, j_xx, j_xy, j_yy, scale = stress_balance(rate, work)
    size = np.sqrt(f_x * f_x + f_y * f_y)
    slow = False
    target = np.hypot(rate[0], rate[1])
    for _ in range(NEWTON_STEPS):
        if size <= TOLERANCE * scale:
            break
        determinant = j_xx * j_yy - j_xy * j_xy
        d_x = -(j_yy * f_x - j_xy * f_y) / determinant
        d_y = -(j_xx * f_y - j_xy * f_x) / determinant
        before = f_x * d_x + f_y * d_y
        share = 1.0
        if slow:
            share = np.log(min(max(size / max(target, scale * TOLERANCE), np.e), 1e12))
        t_x, t_y = tau_x, tau_y
        for _ in range(HALVINGS):
            t_x, t_y = tau_x + share * d_x, tau_y + share * d_y
            column_ratios((t_x, t_y), rise, nodes, *law)
            f_x, f_y, j_xx, j_xy, j_yy, scale = stress_balance(rate, work)
            if f_x * d_x + f_y * d_y <= -OVERSHOOT * before:
                break
            share *= 0.5
        tau_x, tau_y = t_x, t_y
        last = size
        size = np.sqrt(f_x * f_x + f_y * f_y)
        slow = size > SLOW_REDUCTION * last
    return tau_x, tau_y, size <= ACCEPTED * scale


@compiled
def first_guess(eta, rate, section, limit, rheology):
    """Stress of the mean rate at the mean fluidity [Pa]."""
    size = np.hypot(rate[0], rate[1])
    if size == 0.0:
        return 0.0, 0.0
    fluidity = 0.0
    for k in range(eta.size):
        fluidity += section[1][k] / eta[k]
    tau = shear_stress(size, 1.0 / fluidity, limit, *rheology[:4])
    return tau * rate[0] / size, tau * rate[1] / size


@compiled
def column_fluidity(work):
    """1/eta*, and the tensor d(rate)/d(tau), at the nodes of a column [1/(Pa s)], by the ratios
    there.
    """
    for k in range(work.shape[1]):
        t_x, t_y = work[TAU_X, k], work[TAU_Y, k]
        fluid = work[SECANT, k] / work[ETA, k]
        bent = work[BEND, k] / work[ETA, k]
        work[FLUIDITY, k] = fluid
        work[T_XX, k] = fluid + bent * t_x * t_x
        work[T_XY, k] = bent * t_x * t_y
        work[T_YY, k] = fluid + bent * t_y * t_y


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
    """True for an oil that neither thins nor has a limiting stress."""
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
