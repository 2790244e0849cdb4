"""Sweeps of heat over a film, compiled: columns one after the other along the flow, those alone
that have something to follow.

By how much the temperatures beside a column have changed since it was solved, and by how much film
and pressure would change its own, is added up in kelvin: unseen. Infinite, it asks for a solution
in any case. Most columns stand in the wide gap ahead of the contact, where a cycle soon changes
nothing.
"""

import numpy as np

from ..compiled import compiled, inlined, summing
from ..oil._elementary_kernels import copy
from ._heat_kernels import (
    FLOW_ROWS,
    U,
    V,
    film_conductivity,
    heat_of_shear,
    sharpen_heat_column,
    solve_heat_column,
)
from ._stress_kernels import ROWS

# of the step towards temperatures of second order, where oil recirculates: 0, 1 and 2 of 32 fast
# contacts on 129 points needed the continuation with 0.5, 0.7 and 1
FOLLOWED = 0.5


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
            # what the columns beside it have not seen now
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
