"""Effect of a layer of oil at the inlet on a flooded film, from two solutions in one box."""

import numpy as np
from numpy.typing import NDArray

from ...arrays import Array
from ...grid import unfolded
from ...oil._laws import dowson_higginson
from ...oil.lubricant import density
from ...scaling import ScaledContact, contact_starvation_factors, scale_contact
from ...solution import ContactSolution, OilSupply
from ..cycle import log_viscosity
from ..levels import Multigrid


def starved_film_guess(flooded: float, ratio: float) -> float:
    """Guess the central film behind an inlet film, H r/(1 + r^3)^(1/3).

    It lies between all of the inlet film and the flooded film; a guess too thick diverges, one
    too thin costs nothing.

    Parameters
    ----------
    flooded : float
        central film of the flooded contact [-]
    ratio : float
        inlet film over the oil that the flooded film takes along [-]

    Returns
    -------
    float
        initial guess of the central film [-]
    """
    return flooded * ratio / (1.0 + ratio**3) ** (1.0 / 3.0)


def inlet_ratio(
    inlet_film_thickness: float, flooded: ContactSolution, contact: ScaledContact
) -> float:
    """Relate the inlet film to the oil that the flooded film takes along, rho(P(0, 0)) H_c.

    Parameters
    ----------
    inlet_film_thickness : float
        thickness of the inlet film in a^2/Rx [-]
    flooded : ContactSolution
        flooded solution
    contact : ScaledContact
        scaled contact

    Returns
    -------
    float
        ratio r [-]
    """
    P = flooded.P[int(np.abs(flooded.X).argmin()), int(np.abs(flooded.Y).argmin())]
    return inlet_film_thickness / (
        _density(float(P), contact) * flooded.film_central_dimensionless.value
    )


def _density(P: float, contact: ScaledContact) -> float:
    """Over that at ambient pressure [-]."""
    if contact.oil is not None:
        at = density(np.array([0.0, P * contact.hertz_pressure]), contact.oil)
        return float(at[1] / at[0])
    ratio = dowson_higginson(P, contact.density_numerator, contact.density_denominator)
    return float(ratio)


def reverse_flow_message(levels: Multigrid) -> str:
    """Explain why a contact is not solved behind an inlet film: oil runs against the entrainment.

    Parameters
    ----------
    levels : Multigrid
        levels of the contact

    Returns
    -------
    str
        message; empty where all oil runs one way
    """
    along = levels.levels[-1].factors.couette_x
    if along is None or float(along.min()) > 0.0:
        return ""
    return (
        "not converged: the spin turns the entrainment round inside the box of the contact; films "
        "behind a layer are solved where all oil runs one way"
    )


def oil_supply(
    flooded: ContactSolution, starved: ContactSolution, levels: Multigrid, ratio: float
) -> OilSupply:
    """Summarise the effect of an inlet film, from the finest level of the starved solution.

    Parameters
    ----------
    flooded : ContactSolution
        flooded solution in the same box
    starved : ContactSolution
        solution behind the inlet film
    levels : Multigrid
        levels of the starved solution
    ratio : float
        inlet film over the oil that the flooded film takes along [-]

    Returns
    -------
    OilSupply
        supply, meniscus and filled fraction of the contact
    """
    level = levels.levels[-1]
    film_content = level.film_content
    assert film_content is not None
    grid = level.grid
    # 1. share of the gap that is filled, at the outgoing faces; the edges as beside them
    transport = level.flow_x * level.H
    full = 1.5 * transport
    full[:, 1:] -= 0.5 * transport[:, :-1]
    filled = np.ones_like(transport)
    np.divide(film_content.along, full, out=filled, where=(film_content.empty > 0) & (full > 0.0))
    filled = np.clip(filled, 0.0, 1.0)
    filled[:, [0, -1]] = filled[:, [1, -2]]
    # 2. layer that leaves the box
    factor = level.factors.couette_x
    outlet = film_content.along[:, -2] / (1.0 if factor is None else factor[:, -2])
    for values in (filled, outlet):
        values[-1] = values[-2]
        if not grid.symmetric:
            values[0] = values[1]
    if grid.symmetric:
        outlet, filled = unfolded(outlet), unfolded(filled)
    along = scale_contact(starved.conditions, along_entrainment=True)
    return OilSupply(
        flooded=flooded,
        inlet_ratio=ratio,
        meniscus=_meniscus(starved, film_content.empty[0 if grid.symmetric else grid.ny // 2]),
        rolling_moment_ratio=_moment(starved, levels) / _moment(flooded, levels),
        damping=contact_starvation_factors(along, ratio).damping,
        flooded_fft_equivalents=flooded.record.fft_equivalents * flooded.P.size / starved.P.size,
        outlet_layer=outlet,
        filled=filled.T,
    )


def _meniscus(solution: ContactSolution, empty: NDArray[np.int8]) -> float | None:
    """Locate the meniscus ahead of the centre on the line Y = 0, half a mesh before the first full
    node behind the last empty one [-]; None where the box begins full.
    """
    ahead = np.flatnonzero((empty > 0) & (solution.X < 0.0))
    if not ahead.size:
        return None
    return float(solution.X[ahead[-1]] + 0.5 * (solution.X[1] - solution.X[0]))


def _moment(solution: ContactSolution, levels: Multigrid) -> float:
    """Sum the moment of the pressure in the box about the centre [-]."""
    return sum(pressure_moment(solution, levels.contact))


def pressure_moment(solution: ContactSolution, contact: ScaledContact) -> tuple[float, float]:
    """Evaluate the moment of the pressure in the box that resists rolling along the entrainment,
    and its correction by the balance of power.

    The corrected moment is that by which the surfaces turn as much power into heat as the flow
    does that the pressure drives. Reynolds' equation times the integral of dP/rho, summed over the
    box, is the balance of power

        -II P (u H_X + v H_Y) = II eps/rho |grad P|^2 - I P eps/rho dP/dn,

    at a meniscus as at a rupture without terms of the edge, as P = 0 there. A half space pulls
    neither force nor torque out of its own deflection, so that H is the rigid gap on the left: the
    moments about both axes. The right side is a sum of squares that the scheme keeps with the
    squared mesh; the left one is a small difference of the load's two halves, which the mesh
    shifts along the entrainment: on 257 points off by up to a third where little oil flows.

    Parameters
    ----------
    solution : ContactSolution
        solved contact
    contact : ScaledContact
        scaled contact

    Returns
    -------
    moment
        moment of the pressure [-]
    correction
        what closes the balance of power [-]
    """
    X = solution.X[:, None]
    Y = solution.Y[None, :]
    P = solution.P
    c = contact
    u, v = c.velocity_x, c.velocity_y
    moment = -_over_box(solution, (u * X + v * Y) * P)
    # 1. power that the surfaces give by their motion over the rigid gap
    along = (u - c.rotation * Y) * (c.curvature_x * X + c.curvature_xy * Y)
    across = (v + c.rotation * X) * (c.curvature_y * Y + c.curvature_xy * X)
    power = -_over_box(solution, P * (along + across))
    # 2. heat of the flow that the pressure drives, with what that flow takes over the edges
    eps = solution.H**3 * np.exp(-log_viscosity(c, P)) / c.speed
    heat = 0.0
    for P_of, eps_of, X_of, Y_of in (
        (P, eps, solution.X, solution.Y),
        (P.T, eps.T, solution.Y, solution.X),
    ):
        lines = _flow_heat(P_of, eps_of, float(X_of[1] - X_of[0]))
        heat += float(np.trapezoid(lines, Y_of))
    # 3. the shift along (u, v), a unit vector, that closes the balance
    rise = u * u * c.curvature_x + 2.0 * u * v * c.curvature_xy + v * v * c.curvature_y
    return moment, (heat - power) / rise


def _over_box(solution: ContactSolution, values: Array) -> float:
    """Integral of values at the nodes over the box, with the trapezoidal rule."""
    return float(np.trapezoid(np.trapezoid(values, solution.X, axis=0), solution.Y))


def _flow_heat(P: Array, eps: Array, h: float) -> Array:
    """Sum the heat of the flow along the first axis, less that which leaves over both ends, by
    lines [-].
    """
    faces = 0.5 * (eps[1:] + eps[:-1]) * (P[1:] - P[:-1]) ** 2 / h
    first = (3.0 * P[0] - 4.0 * P[1] + P[2]) / (2.0 * h)
    last = (3.0 * P[-1] - 4.0 * P[-2] + P[-3]) / (2.0 * h)
    return np.asarray(faces.sum(axis=0) - P[0] * eps[0] * first - P[-1] * eps[-1] * last)
