"""Temperature of a column of film, compiled.

Heat equation across the film at zeta = z/h, convection by upwind differences along x and y:

    rho c (u T_x + v T_y) + rho c W/h T_zeta
        = k/h^2 T_zeta_zeta + tau . rate + eps T (u p_x + v p_y),

eps the thermal expansion of the oil's density law, W the velocity through the lines of constant
zeta, which continuity gives. At the nodes inside by three-point differences for conduction and
upwind ones for W, which keep the temperature between those it comes from where nothing heats; at
the walls the temperatures of the bodies follow the flux that they take up (three-point, too), T =
T_hist + R q with q = +-k/h T_zeta, see `solid/heat.py`. Conduction along the film is neglected: it
is thin. rheology, section, work: as in `_stress_kernels`; differences: slopes at both
walls of `section.wall_slopes`.

Upwind differences conduct D = rho c |W|/h s/2 on their own, s the distance in zeta to the node
that W comes from: they are of first order. Their temperatures give the velocities and the heat of
shear, to which they respond in Newton's method. With both held, the heat equation is solved again,
D taken off the oil's conduction C = k/h^2 as far as temperatures stay between those that they come
from:

    C' = C^2/(D + sqrt(C^2 + D^2))

of second order, C - D where D is small, never negative. Temperatures of second order that drive
the velocities themselves swing for ever, by up to 14 K, where oil recirculates ahead of a fast
contact.
"""

import numpy as np

from ..compiled import compiled, summing
from ..oil._elementary_kernels import copy
from ..oil._kernels import capacity_ratio, column_softening, conductivity_ratio, thermal_expansion
from ._kernels import solve_column
from ._stress_kernels import FLUIDITY, LOG_ETA, RHO, T_XX, T_XY, T_YY

# Measured on 65 points at 2.3 GPa and slide-roll ratios up to 1.8: half and double of each of the
# first four leave films to 0.4 % and temperatures to 3 K; cycles, 5 to 19, change by up to 9.
COLUMN_STEPS = 40  # Newton steps of one column
HALVED_AFTER = 12  # steps, from which on only half of each is taken, then a quarter
COLUMN_TOLERANCE = 0.3
LARGEST_STEP = 40.0  # [K] of one Newton step
# bounds of iterates [K]; films of these contacts have 295 to 712 K
MIN_TEMPERATURE = 150.0
MAX_TEMPERATURE = 2000.0
# rows of the flow's workspace
U, V, RATE_X, RATE_Y, CROSSING, INFLOW, ADVECTED, SOURCE, CAPACITY, COMPRESSION = range(10)
# the derivative of the heat of shear by the temperatures: a diagonal less the product of a column
# (along) and a row (pull)
DIAGONAL, ALONG, PULL = range(10, 13)
# of the linear system: three diagonals, the solution of `along`
LOWER, MIDDLE, UPPER, COUPLED = range(13, 17)
LAST, FLOW_ROWS = range(17, 19)  # the temperatures that the flow is of [K]


@compiled
def solve_tridiagonal(flow, right):
    """The solutions of a system of three diagonals replace `right` and the row COUPLED (Thomas);
    both at once take the time of one.
    """
    n = right.size
    inverse = flow[MIDDLE, 0] = 1.0 / flow[MIDDLE, 0]
    for k in range(1, n):
        share = flow[LOWER, k] * inverse
        right[k] -= share * right[k - 1]
        flow[COUPLED, k] -= share * flow[COUPLED, k - 1]
        inverse = 1.0 / (flow[MIDDLE, k] - share * flow[UPPER, k - 1])
        flow[MIDDLE, k] = inverse
    right[n - 1] *= inverse
    flow[COUPLED, n - 1] *= inverse
    for k in range(n - 2, -1, -1):
        right[k] = (right[k] - flow[UPPER, k] * right[k + 1]) * flow[MIDDLE, k]
        coupled = flow[COUPLED, k] - flow[UPPER, k] * flow[COUPLED, k + 1]
        flow[COUPLED, k] = coupled * flow[MIDDLE, k]


@compiled
def conduction_left(spread, crossing, distance):
    """Of conduction, k/h^2 = spread, beside that of upwind differences over a distance."""
    own = 0.5 * abs(crossing) * distance
    return spread * spread / (own + np.sqrt(spread * spread + own * own))


@compiled
def inner_rows(film, conductivity, second_order, nodes, flow, out):
    """Rows of the nodes inside: conduction, convection, the heat of shear at the last
    temperature.
    """
    last = flow[LAST]
    spread = conductivity / (film * film)
    pulled = 0.0
    for k in range(last.size):
        pulled += flow[PULL, k] * last[k]
    for k in range(1, last.size - 1):
        crossing = flow[CROSSING, k]
        below = nodes[k] - nodes[k - 1]
        above = nodes[k + 1] - nodes[k]
        left = spread
        if second_order:
            left = conduction_left(spread, crossing, below if crossing >= 0.0 else above)
        both = 2.0 * left / (below + above)
        down = (both + max(crossing, 0.0)) / below
        up = (both - min(crossing, 0.0)) / above
        flow[LOWER, k], flow[UPPER, k] = -down, -up
        flow[MIDDLE, k] = flow[INFLOW, k] - flow[COMPRESSION, k] - flow[DIAGONAL, k] + down + up
        out[k] = flow[ADVECTED, k] + flow[SOURCE, k] - flow[DIAGONAL, k] * last[k]
        out[k] += flow[ALONG, k] * pulled


@compiled
def wall_rows(flux, history, response, differences, flow, out):
    """Rows of both walls, their third entry eliminated by the row beside; flux: k/h."""
    below, above = differences
    n = out.size
    for wall, beside, sign in ((0, 1, -1.0), (n - 1, n - 2, 1.0)):
        slopes = below if wall == 0 else above
        strength = sign * response[0 if wall == 0 else 1] * flux
        to, back = (UPPER, LOWER) if wall == 0 else (LOWER, UPPER)
        third = strength * slopes[2 * beside - wall]
        share = third / flow[to, beside]
        flow[MIDDLE, wall] = 1.0 + strength * slopes[wall] - share * flow[back, beside]
        flow[to, wall] = strength * slopes[beside] - share * flow[MIDDLE, beside]
        out[wall] = history[0 if wall == 0 else 1] - share * out[beside]
        flow[COUPLED, wall] = -share * flow[COUPLED, beside]


@compiled
def column_temperature(
    film, conductivity, second_order, history, response, nodes, differences, flow, out
):
    """Temperature at the nodes of a column, its source linearised at the last one [K].

    The system is three diagonals and the product of `along` and `pull`: Sherman and Morrison's
    formula (1950).
    """
    n = out.size
    for k in range(n):
        flow[COUPLED, k] = flow[ALONG, k] if 0 < k < n - 1 else 0.0
    inner_rows(film, conductivity, second_order, nodes, flow, out)
    wall_rows(conductivity / film, history, response, differences, flow, out)
    solve_tridiagonal(flow, out)
    drawn = own = 0.0
    for k in range(n):
        drawn += flow[PULL, k] * out[k]
        own += flow[PULL, k] * flow[COUPLED, k]
    for k in range(n):
        out[k] -= flow[COUPLED, k] * drawn / (1.0 + own)


@summing
def integrals_to(k, cumulative, flow):
    """Integrals of both rates from the wall to node k of a column of height 1 [1/s]."""
    along = across = 0.0
    for m in range(cumulative.shape[1]):
        along += cumulative[k, m] * flow[RATE_X, m]
        across += cumulative[k, m] * flow[RATE_Y, m]
    return along, across


@summing
def carried_to(k, cumulative, flow, work):
    """Integral of the mass flux from the wall to node k of a column of height 1 [m/s]."""
    total = 0.0
    for m in range(cumulative.shape[1]):
        total += cumulative[k, m] * work[RHO, m] * flow[U, m]
    return total


@compiled
def column_motion(middle, rise, speed, height, section, work, flow):
    """Rates of shear [1/s] and velocities [m/s] at the nodes, and the heat of shear [W/m^3]."""
    nodes, _, cumulative = section
    n = nodes.size
    for k in range(n):
        t_x, t_y = middle[0] + (nodes[k] - 0.5) * rise[0], middle[1] + (nodes[k] - 0.5) * rise[1]
        flow[RATE_X, k], flow[RATE_Y, k] = work[FLUIDITY, k] * t_x, work[FLUIDITY, k] * t_y
        flow[SOURCE, k] = flow[RATE_X, k] * t_x + flow[RATE_Y, k] * t_y
    for k in range(n):
        along, across = integrals_to(k, cumulative, flow)
        flow[U, k], flow[V, k] = speed[0] + height * along, speed[1] + height * across


@compiled
def source_slope(p, temperature, middle, rise, rate, oil, section, work, flow):
    """Derivative of the heat of shear by the temperatures [W/(m^3 K)], to rows of `flow`.

    At a given stress the heat grows with the softening b of the oil there; the stress in the
    middle gives way along the mean rate's direction e, so that the difference of the surface
    velocities stays: d(tau_m) = -sum(w b rate.e dT)/sum(w t), t the tangent fluidity along e.
    """
    nodes, weights, _ = section
    n = nodes.size
    size = np.hypot(rate[0], rate[1])
    soft = flow[DIAGONAL]
    column_softening(p, temperature, work[LOG_ETA], oil, soft)
    if size == 0.0:  # nothing gives way
        for k in range(n):
            flow[PULL, k] = flow[ALONG, k] = 0.0
            soft[k] *= flow[SOURCE, k]
        return
    e_x, e_y = rate[0] / size, rate[1] / size
    give = 0.0
    for k in range(n):
        give += weights[k] * (
            work[T_XX, k] * e_x * e_x + 2.0 * work[T_XY, k] * e_x * e_y + work[T_YY, k] * e_y * e_y
        )
    for k in range(n):
        t_x = middle[0] + (nodes[k] - 0.5) * rise[0]
        t_y = middle[1] + (nodes[k] - 0.5) * rise[1]
        pull = flow[RATE_X, k] * e_x + flow[RATE_Y, k] * e_y
        along = pull + t_x * (work[T_XX, k] * e_x + work[T_XY, k] * e_y)
        along += t_y * (work[T_XY, k] * e_x + work[T_YY, k] * e_y)
        flow[PULL, k] = weights[k] * soft[k] * pull / give
        flow[ALONG, k] = along
        soft[k] *= flow[SOURCE, k]


@compiled
def convection(j, i, mesh, symmetric, temperature, inlet, flow):
    """Convection into a column along x and y, the upwind parts, by the heat capacities and
    velocities in `flow`.
    """
    ny, nx, n = temperature.shape
    by_x = 1.0 / mesh[0]
    by_y = 1.0 / mesh[1]
    for k in range(n):
        dense = flow[CAPACITY, k]
        west = i - 1 if flow[U, k] >= 0.0 else i + 1
        from_x = temperature[j, west, k] if 0 <= west < nx else inlet
        south = j - 1 if flow[V, k] >= 0.0 else j + 1
        if symmetric and south < 0:
            south = 1
        from_y = temperature[south, i, k] if 0 <= south < ny else inlet
        a_x, a_y = dense * abs(flow[U, k]) * by_x, dense * abs(flow[V, k]) * by_y
        flow[INFLOW, k] = a_x + a_y
        flow[ADVECTED, k] = a_x * from_x + a_y * from_y


@compiled
def crossing_flow(j, i, mesh_x, renewed, mass, height, section, work, flow):
    """Flow of heat capacity through the lines of constant z/h, by the capacities in `flow`. mass:
    mass fluxes int_0^z rho u dz of all columns along x over rho_0 [m^2/s]; the column's own is set
    here if it is to be renewed.

    Continuity takes both from one sweep along the flow: against it, where oil recirculates, an own
    flux of now beside those of the last sweep upstream makes the core of the eddy alternate.
    """
    nx, n = mass.shape[1:]
    cumulative = section[2]
    for k in range(n if renewed else 0):
        mass[j, i, k] = height * carried_to(k, cumulative, flow, work)
    before = i - 1 if mass[j, i, n - 1] >= 0.0 else i + 1
    inside = 0 <= before < nx
    by_height = 1.0 / height
    by_step = -1.0 / mesh_x if mass[j, i, n - 1] < 0.0 else 1.0 / mesh_x
    whole = (mass[j, i, n - 1] - mass[j, before, n - 1]) * by_step if inside else 0.0
    for k in range(n):
        change = (mass[j, i, k] - mass[j, before, k]) * by_step if inside else 0.0
        # the gain or loss of the film as a whole leaves sideways or in cavities, evenly over its
        # thickness
        own = flow[CAPACITY, k] / work[RHO, k]
        flow[CROSSING, k] = -own * (change - section[0][k] * whole) * by_height


@compiled
def change_temperature(temperature, target, share):
    """Step of a share towards the target temperatures, in bounds; the largest change [K]."""
    total = largest = 0.0
    for k in range(target.size):
        total += target[k]
    if not np.isfinite(total):  # some are no numbers
        return np.inf
    for k in range(target.size):
        step = min(max(share * (target[k] - temperature[k]), -LARGEST_STEP), LARGEST_STEP)
        largest = max(largest, abs(step))
        temperature[k] = min(max(temperature[k] + step, MIN_TEMPERATURE), MAX_TEMPERATURE)
    return largest


@compiled
def film_conductivity(p, temperature, heat, section, oil):
    """Conductivity of the oil at the mean temperature of a column [W/(m K)]."""
    mean = 0.0
    for k in range(temperature.size):
        mean += section[1][k] * temperature[k]
    return heat[0] * conductivity_ratio(p, mean, oil)


@compiled
def solve_heat_column(
    j, i, p, height, rise, rate, speed, mesh, symmetric, renewed, oil, heat, section,
    differences, rheology, temperature, inlet, history, response, middle, mass, work, flow, out
):  # fmt: skip
    """Temperature of first order and stress of one column by Newton's method; whether it
    converged. heat: conductivity and rho_0 c of the oil at ambient pressure and the temperature of
    operation.
    """
    n = section[0].size
    for turn in range(COLUMN_STEPS):
        # 1. stress at the last temperatures
        guess = (middle[0, j, i], middle[1, j, i])
        t_x, t_y, solved = solve_column(
            p, temperature[j, i], guess, rise, rate, oil, section, rheology, work
        )
        middle[0, j, i], middle[1, j, i] = t_x, t_y
        # 2. conductivity, velocities, heat of shear and its derivative, convection, compression
        conductivity = film_conductivity(p, temperature[j, i], heat, section, oil)
        for k in range(n):
            ratio = capacity_ratio(p, temperature[j, i, k], work[RHO, k], oil)
            flow[CAPACITY, k] = heat[1] * ratio
        column_motion((t_x, t_y), rise, speed, height, section, work, flow)
        convection(j, i, mesh, symmetric, temperature, inlet, flow)
        crossing_flow(j, i, mesh[0], renewed, mass, height, section, work, flow)
        source_slope(p, temperature[j, i], (t_x, t_y), rise, rate, oil, section, work, flow)
        for k in range(n):
            expansion = thermal_expansion(p, temperature[j, i, k], oil)
            pressing = flow[U, k] * rise[0] + flow[V, k] * rise[1]
            flow[COMPRESSION, k] = expansion * pressing / height
        # 3. temperatures of the linearised column, within bounds
        copy(temperature[j, i], flow[LAST])
        column_temperature(
            height, conductivity, False, history, response, section[0], differences, flow, out
        )
        largest = change_temperature(temperature[j, i], out, 0.5 ** (turn // HALVED_AFTER))
        if largest < COLUMN_TOLERANCE:
            return solved
    return False


@compiled
def sharpen_heat_column(
    j, i, p, height, mesh, symmetric, oil, heat, section, differences, temperature, inlet,
    history, response, share, flow, out
):  # fmt: skip
    """Follow the temperature of second order of one column by a share; what is left to follow [K].
    Its flow and its linearised heat of shear are those of the temperature of first order.
    """
    conductivity = film_conductivity(p, flow[LAST], heat, section, oil)
    convection(j, i, mesh, symmetric, temperature, inlet, flow)
    column_temperature(
        height, conductivity, True, history, response, section[0], differences, flow, out
    )
    largest = change_temperature(temperature[j, i], out, share)
    return largest if np.isinf(largest) else (1.0 / share - 1.0) * largest


@compiled
def heat_of_shear(height, weights, temperature, flow):
    """Of a column [W/m^2], linearised about the temperatures that its flow is of."""
    drawn = 0.0
    for k in range(temperature.size):
        drawn += flow[PULL, k] * (temperature[k] - flow[LAST, k])
    total = 0.0
    for k in range(temperature.size):
        source = flow[SOURCE, k] + flow[DIAGONAL, k] * (temperature[k] - flow[LAST, k])
        total += height * weights[k] * (source - flow[ALONG, k] * drawn)
    return total
