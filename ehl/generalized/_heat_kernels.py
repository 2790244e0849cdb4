"""Temperature of a column of film, compiled.

Heat equation across the film at zeta = z/h, convection by upwind differences along x and y:

    rho c (u T_x + v T_y) + rho c W/h T_zeta
        = k/h^2 T_zeta_zeta + tau . rate + eps T (u p_x + v p_y),

eps the thermal expansion of the oil's density law, W the velocity through the lines of constant
zeta, which continuity gives. At the nodes inside by three-point differences for conduction and
upwind ones for W, which keep the temperature between those it comes from where nothing heats; at
the walls the temperatures of the bodies follow the flux that they take up (three-point, too), T =
T_hist + R q with q = +-k/h T_zeta, see `solid/heat.py`. Conduction along the film is neglected: it
is thin. rheology, section, work: as in `_kernels`; differences: slopes at both walls of
`film_heat.wall_slopes`.

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

from ..compiled import compiled, inlined, summing
from ..oil._kernels import column_softening, copy, thermal_expansion
from ..oil._laws import capacity_ratio, conductivity_ratio
from ._kernels import FLUIDITY, LOG_ETA, RHO, ROWS, T_XX, T_XY, T_YY, solve_column

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
# rows of the linear system: three diagonals, the solution of `along`
LOWER, MIDDLE, UPPER, COUPLED = range(13, 17)
LAST, FLOW_ROWS = range(17, 19)  # the temperatures that the flow is of [K]

# share of the step towards temperatures of second order, where oil recirculates: 0, 1 and 2 of 32
# fast contacts on 129 points needed the continuation with 0.5, 0.7 and 1
FOLLOWED = 0.5


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
    """Conduction, k/h^2 = spread, left beside that of upwind differences over a distance."""
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
    """Heat of shear of a column [W/m^2], linearised about the temperatures that its flow is of."""
    drawn = 0.0
    for k in range(temperature.size):
        drawn += flow[PULL, k] * (temperature[k] - flow[LAST, k])
    total = 0.0
    for k in range(temperature.size):
        source = flow[SOURCE, k] + flow[DIAGONAL, k] * (temperature[k] - flow[LAST, k])
        total += height * weights[k] * (source - flow[ALONG, k] * drawn)
    return total


def column_rooms(n):
    """Arrays for a column of n nodes: work, flow, and three more."""
    return np.zeros((ROWS, n)), np.zeros((FLOW_ROWS, n)), *np.zeros((3, n))


@compiled
def wall_flux(conductance, differences, temperature, flux):
    """Flux from a column into body 1 and body 2 [W/m^2]; conductance: k/h [W/(m^2 K)]."""
    gain_1 = gain_2 = 0.0
    for k in range(temperature.size):
        gain_1 += differences[0][k] * temperature[k]
        gain_2 -= differences[1][k] * temperature[k]
    flux[0], flux[1] = conductance * gain_1, conductance * gain_2


@compiled
def take_up_heat(j, i, p, height, heat, section, oil, differences, temperature, flux):
    """Set the flux from a column into both bodies [W/m^2]."""
    conductivity = film_conductivity(p[j, i], temperature[j, i], heat, section, oil)
    wall_flux(conductivity / height, differences, temperature[j, i], flux[:, j, i])


@inlined
def solve_or_restart(
    j, i, before, p, height, rise, rate, speed, mesh, symmetric, renewed, oil, heat, section,
    differences, rheology, temperature, inlet, history, response, middle, mass, work, flow, out
):  # fmt: skip
    """`solve_heat_column`, tried again from the temperatures of the column `before` it."""
    for attempt in range(2):
        if attempt == 1 and 0 <= before < p.size:
            copy(temperature[j, before], temperature[j, i])
            middle[:, j, i] = np.nan
        converged = solve_heat_column(
            j, i, p[i], height, rise, rate, speed, mesh, symmetric, renewed, oil, heat, section,
            differences, rheology, temperature, inlet, history, response, middle, mass, work, flow,
            out,
        )  # fmt: skip
        if converged:
            break
    return converged


@compiled
def bridge(j, i, walls, nodes, temperature, flux):
    """A column without film: temperatures from wall to wall, no flux."""
    for k in range(nodes.size):
        temperature[j, i, k] = walls[0] + nodes[k] * (walls[1] - walls[0])
    flux[0, j, i] = flux[1, j, i] = 0.0


@inlined
def upwind_column(
    j, i, p, height, gradient, speed_1, speed_2, mesh, symmetric, forward, renewed, oil, heat,
    section, differences, rheology, upwind, upwind_flux, inlet, walls, wall_response, middle, mass,
    recirculates, work, flow, out
):  # fmt: skip
    """Temperature of first order of one column, with the response of the walls to its own flux;
    whether it converged.
    """
    rise = (height * gradient[0, j, i], height * gradient[1, j, i])
    along = (speed_2[0, j, i] - speed_1[0, j, i]) / height
    across = (speed_2[1, j, i] - speed_1[1, j, i]) / height
    converged = solve_or_restart(
        j, i, i - 1 if forward else i + 1, p[j], height, rise, (along, across), speed_1[:, j, i],
        mesh, symmetric, renewed, oil, heat, section, differences, rheology, upwind, inlet,
        walls, wall_response, middle, mass, work, flow, out,
    )  # fmt: skip
    slowest = fastest = flow[U, 0]
    for k in range(flow.shape[1]):
        slowest = min(slowest, flow[U, k])
        fastest = max(fastest, flow[U, k])
    if slowest < 0.0 < fastest:
        recirculates[j, i] = True
    take_up_heat(j, i, p, height, heat, section, oil, differences, upwind, upwind_flux)
    return converged


@inlined
def sharper_column(
    j, i, p, height, mesh, symmetric, oil, heat, section, differences, temperature, flux, inlet,
    walls, wall_response, recirculates, converged, upwind, upwind_last, flow, out
):  # fmt: skip
    """Temperature of second order of one column: it moves by the change of that of first order,
    then by itself; what is left to follow [K].
    """
    left = np.inf
    for k in range(upwind_last.size):
        temperature[j, i, k] += upwind[j, i, k] - upwind_last[k]
    if converged:
        share = FOLLOWED if recirculates[j, i] else 1.0
        left = sharpen_heat_column(
            j, i, p[j, i], height, mesh, symmetric, oil, heat, section, differences, temperature,
            inlet, walls, wall_response, share, flow, out,
        )  # fmt: skip
    take_up_heat(j, i, p, height, heat, section, oil, differences, temperature, flux)
    return left


@compiled
def heat_sweep(
    p, h, gradient, speed_1, speed_2, mesh, symmetric, forward, oil, heat, section, differences,
    rheology, inlet, bulk, response, weights, upwind, upwind_flux, temperature, flux, middle, mass,
    dissipation, recirculates, unseen, least, rooms
):  # fmt: skip
    """Columns of all lines with something unseen, one after the other along x, or against it; the
    number of unsolved ones. Against the entrainment only those in which oil flows back: others
    take nothing from there.

    p, h: (ny, nx); gradient, speed_1, speed_2, response, flux: (2, ny, nx); bulk: temperatures of
    both bodies [K]; response: 1/(sqrt(pi u) e) of both [K m^1.5/W]; weights: of their histories
    [m^0.5]; in and out: temperature (ny, nx, n) [K] and flux into both bodies [W/m^2] of second
    order, beside those of first order, upwind; middle (2, ny, nx) [Pa], mass (ny, nx, n) [m^2/s],
    dissipation [W/m^2]; recirculates, (ny, nx): whether oil of a column ever flowed against the
    entrainment; unseen, (ny, nx): see above [K]. least: unseen from which on a column is solved
    [K]. rooms: of `column_rooms`.
    """
    ny, nx = p.shape
    unsolved = 0
    work, flow, out, last, upwind_last = rooms
    for j in range(ny):
        for i in range(nx) if forward else range(nx - 1, -1, -1):
            height = h[j, i]
            along = (speed_1[0, j, i], speed_2[0, j, i])
            onward = along[0] + along[1] >= 0.0
            renewed = forward == onward
            if unseen[j, i] < least or not (renewed or recirculates[j, i]):
                continue
            walls_1, walls_2 = walls_at(j, i, upwind_flux, flux, along, response, weights, bulk)
            if height <= 0.0:
                bridge(j, i, walls_1, section[0], upwind, upwind_flux)
                bridge(j, i, walls_2, section[0], temperature, flux)
                dissipation[j, i] = unseen[j, i] = 0.0
                continue
            copy(upwind[j, i], upwind_last)
            copy(temperature[j, i], last)
            wall_response = (response[0, j, i] * weights[0], response[1, j, i] * weights[0])
            converged = upwind_column(
                j, i, p, height, gradient, speed_1, speed_2, mesh, symmetric, forward, renewed,
                oil, heat, section, differences, rheology, upwind, upwind_flux, inlet,
                walls_1, wall_response, middle, mass, recirculates, work, flow, out,
            )  # fmt: skip
            unsolved += 0 if converged else 1
            left = sharper_column(
                j, i, p, height, mesh, symmetric, oil, heat, section, differences, temperature,
                flux, inlet, walls_2, wall_response, recirculates, converged, upwind, upwind_last,
                flow, out,
            )  # fmt: skip
            dissipation[j, i] = heat_of_shear(height, section[1], temperature[j, i], flow)
            # change that the columns beside it have not seen now
            if renewed:
                unseen[j, i] = left
            moved = largest_shift(upwind[j, i], upwind_last)
            moved = max(moved, largest_shift(temperature[j, i], last))
            show_neighbours(j, i, onward, moved, flow, mesh, recirculates, unseen)
    return unsolved


@compiled
def largest_shift(temperature, last):
    """Largest change of a column's temperatures [K]."""
    shift = 0.0
    for k in range(temperature.size):
        shift = max(shift, abs(temperature[k] - last[k]))
    return shift


@compiled
def sideways_share(flow, mesh):
    """Share of what a column takes in from beside the line [-]."""
    along = across = 0.0
    for k in range(flow.shape[1]):
        along += abs(flow[U, k]) * mesh[1]
        across += abs(flow[V, k]) * mesh[0]
    return across / (along + across) if across > 0.0 else 0.0


@compiled
def show_neighbours(j, i, onward, moved, flow, mesh, recirculates, unseen):
    """Add a column's change of temperature to what the columns beside it have not seen [K]; the
    one upstream takes something from it only where oil flows back. onward: whether the surfaces
    move along x.
    """
    ny, nx = unseen.shape
    after, before = (i + 1, i - 1) if onward else (i - 1, i + 1)
    if 0 <= after < nx:
        unseen[j, after] += moved
    if 0 <= before < nx and recirculates[j, before]:
        unseen[j, before] += moved
    sideways = moved * sideways_share(flow, mesh)
    for beside in (j - 1, j + 1):
        if 0 <= beside < ny:
            unseen[beside, i] += sideways


@compiled
def walls_at(j, i, upwind_flux, flux, speeds, response, weights, bulk):
    """Temperatures of both walls at node i of a line by the heat taken up before: by the flux of
    first and by that of second order [K].
    """
    upwind_1, heat_1 = body_history(0, j, i, upwind_flux, flux, speeds[0], weights)
    upwind_2, heat_2 = body_history(1, j, i, upwind_flux, flux, speeds[1], weights)
    first = response[0, j, i]
    second = response[1, j, i]
    upwind = (bulk[0] + first * upwind_1, bulk[1] + second * upwind_2)
    return upwind, (bulk[0] + first * heat_1, bulk[1] + second * heat_2)


@summing
def body_history(body, j, i, upwind_flux, flux, speed, weights):
    """Weighted sums of both fluxes that a surface took up before node i [W/m^1.5]."""
    upwind = total = 0.0
    if speed >= 0.0:
        for m in range(i):
            upwind += weights[i - m] * upwind_flux[body, j, m]
            total += weights[i - m] * flux[body, j, m]
    else:
        for m in range(i + 1, flux.shape[2]):
            upwind += weights[m - i] * upwind_flux[body, j, m]
            total += weights[m - i] * flux[body, j, m]
    return upwind, total
