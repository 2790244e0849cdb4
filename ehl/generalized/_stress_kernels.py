"""Stress in the middle of a column of film, compiled: d(tau)/dz = grad p, so that

    tau(z) = tau_m + (z - h/2) grad p,      d(u, v)/dz = tau/eta*(|tau|),

tau_m the stress in the middle, which the difference of the surface velocities determines:

    integral of tau/eta* dz = (u_b - u_a, v_b - v_a).

The rate is the gradient of a convex potential of tau_m, so that Newton's method with steps
shortened where they overshoot finds the only solution; far out on an exponential law, where a step
gains one power of e only, the next is lengthened to as many as are needed. A limiting stress is
never reached: from a share 1 - e of it on, the law continues along its tangent, with e = 0.001
tau_L/tau_base of the column, 0.001 at most, and a 32nd part of that on other bases than Newton's,
so that the stress of plain sliding exceeds the limit by a thousandth at most; the tangent is that
of the Newtonian stress, with Carreau and Yasuda's base that of the base's. Where half
of h grad p exceeds the limit, no tau_m balances it, no oil of that law flows steadily, and the
tangent replaces the law.

rheology: a `KernelRheology`; section: nodes, weights and cumulative matrix of a `Section`; work:
rows of a column's nodes.
"""

import numpy as np

from ..compiled import compiled, summing
from ..oil._elementary_kernels import exponential_of
from ..oil._rheology_kernels import (
    CARREAU_YASUDA,
    LARGEST_ARGUMENT,
    LIMIT_POWER,
    NEWTONIAN,
    REE_EYRING,
    limiting_stress,
    shear_rate,
    shear_stress,
    unlimited,
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
