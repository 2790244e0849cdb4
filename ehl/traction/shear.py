r"""Shear stress on both surfaces of a contact, and its integrals: forces, moments, heat; of a
solved film, or by a coefficient of friction over the Hertz ellipse.

Across the film the stress is linear, :math:`\tau(z) = -\tau_c + (z - h/2)\,\nabla p` with z from
body 1 to body 2, so that the oil pulls

.. math:: \tau_1 = -\tau_c - \tfrac{h}{2}\nabla p \quad\text{and}\quad \tau_2 = +\tau_c -
    \tfrac{h}{2}\nabla p

at the bodies. The Couette part has the direction of the local sliding and the magnitude that the
rheology gives at the rate s/h, the local viscosity and pressure; that the pressure gradient bends
the profile of a non-Newtonian oil is left out (the stress in the middle of the film counts). Three
identities close the balances:

- tractions of both bodies sum to :math:`-\iint h\nabla p = \iint p\nabla h - \oint p h\,n`, and as
  a half space pulls no net force out of its own deflection, :math:`\iint p\,h_x =
  \frac{1}{R_x}\iint x p`: pressure ahead of the centre is the hydrodynamic rolling moment, and
  half of the sum acts on each body;
- power lost by the bodies' rigid motion is that turned to heat by the sliding stress;
- pumping the oil against the pressure takes the hydrodynamic moment times the rolling speed,
  :math:`\iint h\,\bar u\,p_x` and what crosses the edge of the box.

The pressure of a flooded inlet falls so slowly that the rolling moment of a point contact grows
with the logarithm of the box where it lies beyond the ellipse's width: the moment is that of the
solved box where the caller does not give that of the oil up to its meniscus (`rolling_moment`).

For the rolling part: Biboulet and Houpert (2010), hydrodynamic force and moment in pure rolling
lubricated contacts.

Over an ellipse with Hertz' pressure three quadratures are in use, each by what it serves. Errors,
root of the mean square and largest: of the force along the rolling direction over mu Q on an
ellipse of 1 to 11, at 150 random motions with slides and spin up to the curvature slip
(tests/ehl/traction/test_quadrature.py), and of the friction power of balls in balance under
Coulomb's law in 25 random bearings:

============== ===== =============== ================ ================
rule           nodes Coulomb         four constants   power in balance
============== ===== =============== ================ ================
rings 16 x 32    512 0.0020   0.013  0.0010   0.0039  0.0005    0.0012
lines 48 x 8     384 0.0028   0.0092 0.0008   0.0033  0.0017    0.0032
rings 4 x 12      48 0.011    0.052  0.0095   0.035   0.0025    0.0046
lines 12 x 4      48 0.028    0.089  0.030    0.096
============== ===== =============== ================ ================

Forces at one motion take the rings. The balance of balls, some fifty evaluations of all contacts,
takes the lines, in four fifths of the time: a line meets the step where the sliding along it
changes sign as a whole. A simulation evaluates all contacts at every step and takes the rings of
a tenth of the nodes and of the time; lines of as many are three times worse.
"""

from dataclasses import dataclass, replace
from enum import Enum
from functools import cache
from math import inf

import numpy as np

from ..arrays import Array
from ..conditions import ContactConditions, ContactKinematics
from ..oil.lubricant import Lubricant, viscosity
from ..oil.rheology import FilmState, Rheology, ShearLaw, contact_rheology
from ..oil.shear_stress import shear_stress_vector
from ..solution import ContactSolution
from . import _kernels
from .friction_coefficients import Coefficient
from .law import TractionForces

# [Pa s] keeps products finite; every law with a bound on its stress has reached it long before
LARGEST_VISCOSITY = 1e30
OUTLET_NODES = 24  # lines downstream of the box
OUTLET_GROWTH = 1.25  # of their distance, to 1.25^24 = 200 times the first

# on either side of a line of pure rolling, where balls do not spin (`straight_friction`)
STRAIGHT_NODES = 6


class Cavitation(Enum):
    """Model of the sheared width where the pressure is zero.

    FULL_WIDTH: a film as wide and thick as the gap. STRIATED: strips of oil as thick as the gap
    with the flow of the last full film upstream, so that a share h_rupture/h of the width is
    sheared. NONE: nothing.
    """

    FULL_WIDTH = "full width"
    STRIATED = "striated"
    NONE = "none"


@dataclass(frozen=True, slots=True, kw_only=True)
class ShearFields:
    """Sliding, shear and heat over a contact, shape (nx, ny) on the grid of its solution."""

    sliding_x: Array  # velocity of body 1 relative to body 2 [m/s]
    sliding_y: Array  # [m/s]
    couette_x: Array  # stress in the middle of the film, along the sliding [Pa]
    couette_y: Array  # over the sheared width [Pa]
    body_1_x: Array  # traction of the oil on body 1 [Pa]
    body_1_y: Array  # [Pa]
    body_2_x: Array  # and on body 2 [Pa]
    body_2_y: Array  # [Pa]
    heat: Array  # of sliding per area, tau_c . s [W/m^2]
    width: Array  # share that is sheared: 1 in the full film [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class TractionResult:
    """Forces and moments of a contact on its bodies, SI; body 1 is the ball, moments about the
    contact's centre.

    Force and moment on body 2 are opposite to those on body 1. The shear at each surface alone
    pulls body 1 by (sliding_force_x + pumping_force_x), body 2 by (-sliding_force_x +
    pumping_force_x).
    """

    # tangential, on body 1, of shear and of the horizontal part of the pressure
    force_x: float  # [N]
    force_y: float  # [N]
    sliding_force_x: float  # its part from sliding, minus the integral of tau_c [N]
    sliding_force_y: float  # [N]
    pumping_force_x: float  # integral of -h/2 grad p, the same on both bodies [N]
    pumping_force_y: float  # [N]
    spin_moment: float  # on body 1 about n [N m]
    rolling_moment_1: float  # on body 1 about y; negative where it resists rolling along x [N m]
    rolling_moment_2: float  # on body 2 [N m]
    hydrodynamic_moment: float  # part on body 1 of the pressure ahead of the centre [N m]
    curvature_moment: float  # part on body 1 of sliding on the curved surface [N m]
    tilting_moment: float  # of the pressure on body 1 about x; zero in symmetric films [N m]
    power_loss: float  # mechanical power turned into heat [W]
    sliding_loss: float  # its part from the sliding stress [W]
    pumping_loss: float  # and from the pressure flow [W]
    coefficient: float  # magnitude of the tangential force over the load [-]
    cavitated_force: float  # of the sliding force, from where there is no pressure [N]
    eyring_stress: float | None  # that sheared it; None: the oil follows another law [Pa]
    force_balance_error: float  # of the forces on the film along x, over the load [-]
    power_balance_error: float  # of forces and moments less the heat, over the larger [-]


def shear_fields(
    solution: ContactSolution,
    kinematics: ContactKinematics,
    rheology: Rheology,
    *,
    temperature: float | None = None,
    cavitation: Cavitation = Cavitation.STRIATED,
) -> ShearFields:
    """Evaluate the shear over a solved contact of dimensional conditions.

    Parameters
    ----------
    solution : ContactSolution
        solved contact
    kinematics : ContactKinematics
        motion of the bodies in the frame of its grid
    rheology : Rheology
        shear law of the oil
    temperature : float | None, optional
        temperature of the film, for the limiting stress; a solution with heat has its own [K]
    cavitation : Cavitation, default Cavitation.STRIATED
        model of the sheared width behind the contact

    Returns
    -------
    ShearFields
        shear stress, heat and slip over the grid

    Raises
    ------
    ValueError
        if the conditions have no dimensions
    """
    x, y, h = dimensional_grid(solution)
    p = solution.pressure
    s_x, s_y = kinematics.sliding(x[:, None], y[None, :])
    eta = film_viscosity(solution)
    width = sheared_width(h, p, cavitation)
    gap = np.maximum(h, np.finfo(np.float64).tiny)
    temperatures = film_temperature(solution, temperature)
    law = solution_rheology(solution, rheology)
    stresses = shear_stress_vector((s_x / gap, s_y / gap), eta, p, law, temperatures)
    t_x, t_y = (width * stress for stress in stresses)
    pump_x = -0.5 * h * np.gradient(p, x, axis=0)
    pump_y = -0.5 * h * np.gradient(p, y, axis=1)
    return ShearFields(
        sliding_x=s_x,
        sliding_y=s_y,
        couette_x=t_x,
        couette_y=t_y,
        body_1_x=pump_x - t_x,
        body_1_y=pump_y - t_y,
        body_2_x=pump_x + t_x,
        body_2_y=pump_y + t_y,
        heat=t_x * s_x + t_y * s_y,
        width=width,
    )


def integrate_traction(
    solution: ContactSolution,
    kinematics: ContactKinematics,
    rheology: Rheology,
    *,
    temperature: float | None = None,
    cavitation: Cavitation = Cavitation.STRIATED,
    rolling_resistance: float | None = None,
) -> TractionResult:
    """Integrate forces, moments and power loss of a solved contact on its bodies.

    Parameters
    ----------
    solution : ContactSolution
        solved contact
    kinematics : ContactKinematics
        motion of the bodies in the frame of its grid
    rheology : Rheology
        shear law of the oil
    temperature : float | None, optional
        temperature of the film, for the limiting stress; a solution with heat has its own [K]
    cavitation : Cavitation, default Cavitation.STRIATED
        model of the sheared width behind the contact
    rolling_resistance : float | None, optional
        minus the hydrodynamic moment on body 1, of all oil; None: of that in the box [N m]

    Returns
    -------
    TractionResult
        forces [N], moments [N m] and power [W]

    Raises
    ------
    ValueError
        if the conditions have no dimensions

    Examples
    --------
    >>> from oilfilm.ehl import ContactConditions, Lubricant, SolverOptions, solve_contact
    >>> oil = Lubricant(viscosity=0.04, pressure_viscosity=18e-9)
    >>> contact = ContactConditions(
    ...     load=60.0,
    ...     radius_x=0.01,
    ...     radius_y=0.01,
    ...     reduced_modulus=226e9,
    ...     entrainment_speed=1.5,
    ...     lubricant=oil,
    ... )
    >>> solution = solve_contact(contact, SolverOptions(points=65))
    >>> from oilfilm.ehl.conditions import ContactKinematics
    >>> from oilfilm.ehl.oil.rheology import Rheology, ShearLaw
    >>> motion = ContactKinematics(entrainment_speed=1.5, sliding_x=0.05, rolling=150.0)
    >>> rheology = Rheology(law=ShearLaw.REE_EYRING, eyring_stress=5e6)
    >>> traction = integrate_traction(solution, motion, rheology)
    >>> f"{traction.force_x:.2f} N, {traction.power_loss:.3f} W"
    '-1.31 N, 0.135 W'
    """
    solution = with_outlet(solution) if cavitation is Cavitation.STRIATED else solution
    k = kinematics
    law = solution_rheology(solution, rheology)
    fields = shear_fields(solution, k, law, temperature=temperature, cavitation=cavitation)
    load = dimensional_conditions(solution).load
    parts = _integrals(solution, k, fields)
    sliding_x, sliding_y = parts["sliding_force_x"], parts["sliding_force_y"]
    if rolling_resistance is not None:
        parts["hydrodynamic_moment"] = -rolling_resistance
    hydrodynamic, curved = parts["hydrodynamic_moment"], parts["curvature_moment"]
    heat = parts["sliding_loss"]
    # the horizontal part of the pressure is shared by the curvatures of the bodies
    force_x = sliding_x + 0.5 * k.curvature_difference * hydrodynamic
    pumping = -hydrodynamic * (k.rolling + 0.5 * k.curvature_difference * k.sliding_x)
    # power of the rigid motion, against the heat of sliding
    along = sliding_x * k.sliding_x + sliding_y * k.sliding_y
    mechanical = -(along + parts["spin_moment"] * k.spin + curved * k.rolling)
    largest = max(abs(mechanical), abs(heat), np.finfo(np.float64).tiny)
    return TractionResult(
        **parts,
        force_x=force_x,
        force_y=sliding_y,
        rolling_moment_1=hydrodynamic + curved,
        rolling_moment_2=-hydrodynamic - curved,
        power_loss=heat + pumping,
        pumping_loss=pumping,
        coefficient=float(np.hypot(force_x, sliding_y)) / load,
        eyring_stress=law.eyring_stress if law.law is ShearLaw.REE_EYRING else None,
        force_balance_error=_film_balance(solution, 2.0 * parts["pumping_force_x"]) / load,
        power_balance_error=abs(mechanical - heat) / largest,
    )


def _integrals(
    solution: ContactSolution, kinematics: ContactKinematics, fields: ShearFields
) -> dict[str, float]:
    """Integrate the fields of a `TractionResult` that are integrals over the contact, by name."""
    x, y, _ = dimensional_grid(solution)
    p = solution.pressure
    X = x[:, None]
    Y = y[None, :]
    weights = trapezoidal_weights(x, y)
    t_x, t_y = fields.couette_x, fields.couette_y
    dry = p <= 0.0

    def integral(values: Array) -> float:
        return float(np.sum(weights * values))

    return {
        "sliding_force_x": -integral(t_x),
        "sliding_force_y": -integral(t_y),
        "pumping_force_x": 0.5 * integral(fields.body_1_x + fields.body_2_x),
        "pumping_force_y": 0.5 * integral(fields.body_1_y + fields.body_2_y),
        "hydrodynamic_moment": integral(X * p),
        "tilting_moment": -integral(Y * p),
        "curvature_moment": -integral(kinematics.curvature_height(Y) * t_x),
        "spin_moment": integral(Y * t_x - X * t_y),
        "sliding_loss": integral(fields.heat),
        "cavitated_force": float(np.hypot(integral(dry * t_x), integral(dry * t_y))),
    }


def solution_rheology(solution: ContactSolution, rheology: Rheology) -> Rheology:
    """Set the stresses of a rheology that depend on the contact's mean pressure.

    Parameters
    ----------
    solution : ContactSolution
        solved contact of dimensional conditions
    rheology : Rheology
        shear law of the oil

    Returns
    -------
    Rheology
        rheology with its stresses [Pa]
    """
    oil = dimensional_conditions(solution).lubricant
    return contact_rheology(rheology, oil, solution.mean_pressure)


def film_viscosity(solution: ContactSolution) -> Array:
    """Evaluate the viscosity at the pressure of each node.

    Of a film solved with heat or shear it is that at its temperature, thinned by the pressure's
    flow.

    Parameters
    ----------
    solution : ContactSolution
        solved contact of dimensional conditions

    Returns
    -------
    Array
        viscosity, shape (nx, ny) [Pa s]
    """
    oil = dimensional_conditions(solution).lubricant
    state = solution.state
    if state is None:
        return bounded_viscosity(solution.pressure, oil)
    return bounded_viscosity(solution.pressure, oil, state.temperature) * np.exp(
        -state.log_fluidity
    )


def film_temperature(solution: ContactSolution, inlet: float | None) -> Array | float | None:
    """Give the temperature of the sheared oil.

    Parameters
    ----------
    solution : ContactSolution
        solved contact
    inlet : float | None
        temperature of the oil at the inlet [K]

    Returns
    -------
    Array | float | None
        field of shape (nx, ny) with heat, else that of the inlet [K]
    """
    state = solution.state
    return inlet if state is None or state.temperature is None else state.temperature


def bounded_viscosity(pressure: Array, oil: Lubricant, temperature: Array | None = None) -> Array:
    """Evaluate the viscosity, at most `LARGEST_VISCOSITY`.

    Parameters
    ----------
    pressure : Array
        pressure, any shape [Pa]
    oil : Lubricant
        lubricant
    temperature : Array | None, optional
        temperature, of the same shape; None: that of the lubricant [K]

    Returns
    -------
    Array
        viscosity, shape of `pressure` [Pa s]
    """
    with np.errstate(over="ignore"):
        return np.minimum(viscosity(pressure, oil, temperature), LARGEST_VISCOSITY)


def sheared_width(film: Array, pressure: Array, cavitation: Cavitation) -> Array:
    """Evaluate the fraction of the width that is sheared.

    Strips start from the last node of each line along x that has pressure.

    Parameters
    ----------
    film : Array
        film thickness, shape (nx, ny) [m]
    pressure : Array
        shape (nx, ny) [Pa]
    cavitation : Cavitation
        model of the sheared width behind the contact

    Returns
    -------
    Array
        fraction, shape (nx, ny) [-]
    """
    full = pressure > 0.0
    if cavitation is Cavitation.FULL_WIDTH:
        return np.ones_like(film)
    if cavitation is Cavitation.NONE:
        return full.astype(np.float64)
    nx = film.shape[0]
    last = nx - 1 - np.argmax(full[::-1], axis=0)
    rupture = np.where(full.any(axis=0), film[last, np.arange(film.shape[1])], 0.0)
    downstream = np.arange(nx)[:, None] > last[None, :]
    strips = np.minimum(rupture[None, :] / np.maximum(film, np.finfo(float).tiny), 1.0)
    return np.where(full, 1.0, np.where(downstream, strips, 0.0))


def with_outlet(solution: ContactSolution) -> ContactSolution:
    """Extend a solution by `OUTLET_NODES` lines downstream of its box, ever wider apart.

    The gap opens there; the deflection stays that of the box's end. Strips of oil shear behind the
    contact far beyond the box, whose end would show in the friction of thick films.

    Parameters
    ----------
    solution : ContactSolution
        solved contact of dimensional conditions

    Returns
    -------
    ContactSolution
        solution with the further lines
    """
    x, y, h = dimensional_grid(solution)
    assert solution.semi_axis_x is not None and solution.film_scale is not None
    start = max(x[-1] - x[-2], 1e-3 * solution.semi_axis_x)
    further = outlet_lines(x[-1], start)
    along, mixed = _curvatures(solution)
    opened = 0.5 * along * (further**2 - x[-1] ** 2)[:, None]
    opened = opened + mixed * (further - x[-1])[:, None] * y
    height = np.maximum(h[-1] + opened, h[-1]) / solution.film_scale
    state = solution.state
    if state is not None:
        t = state.temperature
        fluidity = with_outlet_values(state.log_fluidity)
        state = FilmState(
            temperature=None if t is None else with_outlet_values(t), log_fluidity=fluidity
        )
    return replace(
        solution,
        X=np.concatenate([solution.X, further / solution.semi_axis_x]),
        P=np.concatenate([solution.P, np.zeros_like(height)]),
        H=np.concatenate([solution.H, height]),
        state=state,
    )


def outlet_lines(end: float, start: float) -> Array:
    """Place the lines beyond the end of a box.

    Parameters
    ----------
    end : float
        end of the box [m]
    start : float
        distance of the first line from it [m]

    Returns
    -------
    Array
        positions, shape (OUTLET_NODES,) [m]
    """
    return np.asarray(end + start * np.cumsum(OUTLET_GROWTH ** np.arange(OUTLET_NODES)))


def with_outlet_values(field: Array) -> Array:
    """Extend a field by the values of its last line to all lines of `with_outlet`.

    Parameters
    ----------
    field : Array
        values over the grid, shape (nx, ny) [any unit]

    Returns
    -------
    Array
        values, shape (nx + OUTLET_NODES, ny) [same unit]
    """
    return np.pad(field, ((0, OUTLET_NODES), (0, 0)), mode="edge")


def _curvatures(solution: ContactSolution) -> tuple[float, float]:
    """Evaluate the curvature of the gap along the grid's x, and the mixed one [1/m]."""
    c = dimensional_conditions(solution)
    cosine, sine = np.cos(solution.frame_angle), np.sin(solution.frame_angle)
    along = cosine**2 / c.radius_x + sine**2 / c.radius_y
    return along, sine * cosine * (1.0 / c.radius_y - 1.0 / c.radius_x)


def _film_balance(solution: ContactSolution, traction: float) -> float:
    """Tractions on both bodies along x and pressure on the film's ends [N]; zero if balanced."""
    x, y, h = dimensional_grid(solution)
    p = solution.pressure
    along, mixed = _curvatures(solution)
    slope = along * x[:, None] + mixed * y[None, :]
    horizontal = float(np.sum(trapezoidal_weights(x, y) * (p * slope)))
    edges = np.trapezoid(p[-1] * h[-1], y) - np.trapezoid(p[0] * h[0], y)
    return float(traction - horizontal + edges)


def trapezoidal_weights(x: Array, y: Array) -> Array:
    """Give the weights of the trapezoidal rule over a grid.

    Parameters
    ----------
    x : Array
        nodes along the grid, shape (nx,) [m]
    y : Array
        nodes across it, shape (ny,) [m]

    Returns
    -------
    Array
        weights, shape (nx, ny) [m^2]
    """
    weights: Array = np.gradient(x)[:, None] * np.gradient(y)[None, :]
    for edge in (np.s_[0, :], np.s_[-1, :], np.s_[:, 0], np.s_[:, -1]):
        weights[edge] *= 0.5
    return weights


def dimensional_grid(solution: ContactSolution) -> tuple[Array, Array, Array]:
    """Give nodes and film of a solution that has lengths.

    Parameters
    ----------
    solution : ContactSolution
        solved contact

    Returns
    -------
    x
        nodes along the grid, shape (nx,) [m]
    y
        nodes across it, shape (ny,) [m]
    film
        film thickness, shape (nx, ny) [m]

    Raises
    ------
    ValueError
        if the conditions are Moes' groups alone
    """
    if solution.x is None or solution.y is None or solution.film is None:
        raise ValueError("solution: traction needs dimensional conditions, not Moes' groups alone")
    return solution.x, solution.y, solution.film


def dimensional_conditions(solution: ContactSolution) -> ContactConditions:
    """Give the conditions of a solution that has lengths.

    Parameters
    ----------
    solution : ContactSolution
        solved contact

    Returns
    -------
    ContactConditions
        conditions in SI

    Raises
    ------
    ValueError
        if the conditions are Moes' groups alone
    """
    if not isinstance(solution.conditions, ContactConditions):
        raise ValueError("solution: traction needs dimensional conditions, not Moes' groups alone")
    return solution.conditions


class EllipseRule(Enum):
    """Quadratures by what they serve; why each has its nodes stands above."""

    FORCES = "rings 16 x 32"  # of one contact at a given motion
    BALANCE = "lines 48 x 8"  # of Coulomb friction on balls
    TIME_STEPS = "rings 4 x 12, staggered"  # of a simulation


@cache
def ellipse_nodes(rule: EllipseRule) -> Array:
    """Give the nodes of a rule over the ellipse of Hertz.

    Parameters
    ----------
    rule : EllipseRule
        purpose of the quadrature

    Returns
    -------
    Array
        x/a, y/b and fraction of the load of each node, shape (3, n) [-]
    """
    if rule is EllipseRule.FORCES:
        return ellipse_rings(16, 32)
    if rule is EllipseRule.BALANCE:
        return ellipse_lines(48, 8)
    return ellipse_rings(4, 12, staggered=True)


def ellipse_rings(rings: int, rays: int, *, staggered: bool = False) -> Array:
    """Place nodes on rings over the ellipse of Hertz.

    Gauss-Legendre in the fraction of the load outside a radius, t = (1 - r^2)^(3/2), evenly
    spaced around.

    Parameters
    ----------
    rings : int
        number of rings [-]
    rays : int
        nodes on each ring [-]
    staggered : bool, default False
        whether each ring is rotated by half a step against the next

    Returns
    -------
    Array
        x/a, y/b and fraction of the load of each node, shape (3, rings * rays) [-]
    """
    nodes, weights = np.polynomial.legendre.leggauss(rings)
    radius = np.sqrt(1.0 - (0.5 * (nodes + 1.0)) ** (2.0 / 3.0))[:, None]
    turn = 0.5 * (np.arange(rings) % 2)[:, None] + 0.25 if staggered else np.full((rings, 1), 0.5)
    angle = 2.0 * np.pi * (np.arange(rays) + turn) / rays
    fraction = np.repeat(0.5 * weights / rays, rays)
    return np.stack([(radius * np.cos(angle)).ravel(), (radius * np.sin(angle)).ravel(), fraction])


def ellipse_lines(lines: int, nodes: int) -> Array:
    """Place nodes on lines along x over the ellipse of Hertz.

    Gauss-Legendre across; along each line Gauss-Chebyshev of the second kind, whose weight is
    Hertz' pressure.

    Parameters
    ----------
    lines : int
        number of lines [-]
    nodes : int
        nodes on each line [-]

    Returns
    -------
    Array
        x/a, y/b and fraction of the load of each node, shape (3, lines * nodes) [-]
    """
    y, across = np.polynomial.legendre.leggauss(lines)
    angle = np.pi * (np.arange(nodes) + 1.0) / (nodes + 1.0)
    along = 2.0 / (nodes + 1.0) * np.sin(angle) ** 2
    x = np.sqrt(1.0 - y**2)[:, None] * np.cos(angle)
    fraction = 0.75 * ((1.0 - y**2) * across)[:, None] * along
    return np.stack([x.ravel(), np.repeat(y, nodes), fraction.ravel()])


def unit_gauss(nodes: int) -> Array:
    """Give nodes and weights of Gauss and Legendre on [0, 1].

    Parameters
    ----------
    nodes : int
        number of nodes [-]

    Returns
    -------
    Array
        nodes and weights, shape (2, nodes) [-]
    """
    positions, weights = np.polynomial.legendre.leggauss(nodes)
    return np.stack([0.5 * (positions + 1.0), 0.5 * weights])


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactShape:
    """Ellipse and curvature of a contact: what turns a coefficient into forces and moments."""

    semi_axis_x: float  # along the entrainment, at 1 N; grows with the cube root of the load [m]
    semi_axis_y: float  # across, at 1 N [m]
    radius_x: float  # reduced, along the entrainment [m]
    curvature_radius: float = inf  # of the loaded surface across; infinite: no curvature slip [m]
    curvature_difference: float = 0.0  # 1/R_2x - 1/R_1x [1/m]

    @property
    def constants(self) -> Array:
        """Constants as the kernel takes them, shape (5,) [m], [1/m]."""
        axes = (self.semi_axis_x, self.semi_axis_y)
        curvatures = (0.5 / self.curvature_radius, self.curvature_difference)
        return np.array([*axes, self.radius_x, *curvatures])


@dataclass(frozen=True)
class EllipseLaw:
    """A coefficient of friction that depends on the local sliding, over the Hertz ellipse."""

    shape: ContactShape  # ellipse and curvature of the contact
    coefficient: Coefficient  # of friction by the local sliding

    def kernel_arguments(self) -> tuple[Array, Array, Array]:
        """Nodes, law and shape as `_kernels.hertz_friction` takes them, [-], [m/s] and [m]."""
        return (
            ellipse_nodes(EllipseRule.FORCES),
            self.coefficient.kernel_law,
            self.shape.constants,
        )

    def forces(
        self, load: float, speed: float, slide_x: float, slide_y: float, spin: float
    ) -> TractionForces:
        """Integrate the coefficient over the ellipse, see `TractionLaw.forces`.

        Parameters
        ----------
        load : float
            normal load [N]
        speed : float
            entrainment speed [m/s]
        slide_x, slide_y : float
            sliding of body 1 along x and y [m/s]
        spin : float
            spin of body 1 [rad/s]

        Returns
        -------
        TractionForces
            forces and moments on body 1; film, stiffness and damping are zero
        """
        out = np.empty(8)
        _kernels.hertz_friction(*self.kernel_arguments(), load, speed, slide_x, slide_y, spin, out)
        return TractionForces._make((*map(float, out), ()))
