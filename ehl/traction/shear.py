r"""Shear stress on both surfaces of a solved contact, and its integrals: forces, moments, heat.

Across the film the stress is linear, :math:`\tau(z) = -\tau_c + (z - h/2)\,\nabla p` with z from
body 1 to body 2, so that the oil pulls

.. math:: \tau_1 = -\tau_c - \tfrac{h}{2}\nabla p \quad\text{and}\quad \tau_2 = +\tau_c -
    \tfrac{h}{2}\nabla p

at the bodies. The Couette part has the direction of the local sliding and the magnitude that the
rheology gives at the rate s/h, the local viscosity and pressure; that the pressure gradient bends
the profile of a non-Newtonian oil is left out (the stress in the middle of the film counts). Three
identities close the balances:

- tractions of both bodies sum to :math:`-\iint h\nabla p = \iint p\nabla h - \oint p h\,n`, and as
  a half space pulls
  no net force out of its own deflection, :math:`\iint p\,h_x = \frac{1}{R_x}\iint x p`: pressure
  ahead of the centre is the hydrodynamic rolling moment, and half of the sum acts on each body;
- power lost by the bodies' rigid motion is that turned to heat by the sliding stress;
- pumping the oil against the pressure takes the hydrodynamic moment times the rolling speed,
  :math:`\iint h\,\bar u\,p_x` and what crosses the edge of the box.

The pressure of a flooded inlet falls so slowly that the rolling moment of a point contact grows
with the logarithm of the box where it lies beyond the ellipse's width: the moment is that of the
solved box. `rolling_moment.py` has that of the oil up to a stated distance.

For the rolling part: Biboulet and Houpert (2010), hydrodynamic force and moment in pure rolling
lubricated contacts.
"""

from dataclasses import dataclass, replace
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from ..conditions import ContactConditions
from ..kinematics import ContactKinematics
from ..oil.film_state import FilmState
from ..oil.lubricant import Lubricant, viscosity
from ..oil.rheology import Rheology, shear_stress_vector
from ..solution import ContactSolution

Array = NDArray[np.float64]

LARGEST_VISCOSITY = (
    # [Pa s] keeps products finite; every law with a bound on its stress has reached it long before
    1e30
)
OUTLET_NODES = 24  # lines downstream of the box
OUTLET_GROWTH = 1.25  # up to some thirty times the last distance


class Cavitation(Enum):
    """What shears where the pressure is zero.

    FULL_WIDTH: a film as wide and thick as the gap. STRIATED: strips of oil as thick as the gap
    that carry the flow of the last full film upstream, so that a share h_rupture/h of the width is
    sheared. NONE: nothing.
    """

    FULL_WIDTH = "full width"
    STRIATED = "striated"
    NONE = "none"


@dataclass(frozen=True, slots=True, kw_only=True)
class ShearFields:
    """Sliding, shear and heat over a contact; arrays of shape (nx, ny) on the grid of its
    solution.

    Attributes
    ----------
    sliding_x, sliding_y : ndarray
        Velocity of body 1 relative to body 2 [m/s].
    couette_x, couette_y : ndarray
        Stress tau_c in the middle of the film, in the direction of the sliding [Pa]; over the
        sheared width.
    body_1_x, body_1_y, body_2_x, body_2_y : ndarray
        Traction of the oil on each body [Pa].
    heat : ndarray
        Heat of sliding per area, tau_c . s [W/m^2].
    width : ndarray
        Share of the width that is sheared [-]: 1 in the full film.
    """

    sliding_x: Array
    sliding_y: Array
    couette_x: Array
    couette_y: Array
    body_1_x: Array
    body_1_y: Array
    body_2_x: Array
    body_2_y: Array
    heat: Array
    width: Array


@dataclass(frozen=True, slots=True, kw_only=True)
class TractionResult:
    """Forces and moments of a contact on its bodies, SI; body 1 is the ball, moments about the
    contact's centre.

    Force and moment on body 2 are opposite to those on body 1. Where only the shear at each
    surface is wanted: it pulls body 1 by (sliding_force_x + pumping_force_x), body 2 by
    (-sliding_force_x + pumping_force_x).

    Attributes
    ----------
    force_x, force_y : float
        Tangential force on body 1, of shear and of the horizontal part of the pressure [N].
    sliding_force_x, sliding_force_y : float
        Its part from sliding, minus the integral of tau_c [N].
    pumping_force_x, pumping_force_y : float
        Integral of -h/2 grad p, the same on both bodies [N].
    spin_moment : float
        Moment on body 1 about n [N m].
    rolling_moment_1, rolling_moment_2 : float
        Moment on body 1 and on body 2 about y [N m]: of the pressure ahead of the centre, and of
        sliding on the curved surface; negative on body 1 resists rolling along x.
    hydrodynamic_moment, curvature_moment : float
        Both parts of it on body 1 [N m].
    tilting_moment : float
        Moment of the pressure on body 1 about x [N m]; zero if the film is symmetric.
    power_loss : float
        Mechanical power turned into heat [W].
    sliding_loss, pumping_loss : float
        Both parts of it: of the sliding stress, and of the pressure flow [W].
    coefficient : float
        Magnitude of the tangential force over the load [-].
    cavitated_force : float
        Part of the sliding force's magnitude from where there is no pressure, under the chosen
        assumption [N].
    force_balance_error : float
        What is left of the balance of forces on the film along x, over the load [-].
    power_balance_error : float
        Power of forces and moments less the heat of sliding, over the larger [-].
    """

    force_x: float
    force_y: float
    sliding_force_x: float
    sliding_force_y: float
    pumping_force_x: float
    pumping_force_y: float
    spin_moment: float
    rolling_moment_1: float
    rolling_moment_2: float
    hydrodynamic_moment: float
    curvature_moment: float
    tilting_moment: float
    power_loss: float
    sliding_loss: float
    pumping_loss: float
    coefficient: float
    cavitated_force: float
    force_balance_error: float
    power_balance_error: float


def shear_fields(
    solution: ContactSolution,
    kinematics: ContactKinematics,
    rheology: Rheology,
    *,
    temperature: float | None = None,
    cavitation: Cavitation = Cavitation.STRIATED,
) -> ShearFields:
    """Shear over a solved contact.

    Parameters
    ----------
    solution : ContactSolution
        Of dimensional conditions.
    kinematics : ContactKinematics
        In the frame of the solution's grid.
    rheology : Rheology
    temperature : float, optional
        Of the film, for the limiting stress [K]; that of the solution where it was solved with
        heat.
    cavitation : Cavitation

    Returns
    -------
    ShearFields
        Stresses in [Pa].
    """
    x, y, h = dimensional_grid(solution)
    p = solution.pressure
    s_x, s_y = kinematics.sliding(x[:, None], y[None, :])
    eta = film_viscosity(solution)
    width = sheared_width(h, p, cavitation)
    gap = np.maximum(h, np.finfo(np.float64).tiny)
    warm = film_temperature(solution, temperature)
    t_x, t_y = shear_stress_vector((s_x / gap, s_y / gap), eta, p, rheology, warm)
    t_x, t_y = width * t_x, width * t_y
    pump_x, pump_y = -0.5 * h * np.gradient(p, x, axis=0), -0.5 * h * np.gradient(p, y, axis=1)
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
) -> TractionResult:
    """Forces and moments of a solved contact on its bodies, and the heat they make.

    Parameters
    ----------
    solution, kinematics, rheology, temperature, cavitation
        As in `shear_fields`; temperature in [K].

    Returns
    -------
    TractionResult
        Forces in [N], moments in [N m], power in [W].
    """
    solution = with_outlet(solution) if cavitation is Cavitation.STRIATED else solution
    fields = shear_fields(
        solution, kinematics, rheology, temperature=temperature, cavitation=cavitation
    )
    x, y, _ = dimensional_grid(solution)
    p = solution.pressure
    load = dimensional_conditions(solution).load
    X = x[:, None]
    Y = y[None, :]
    integral = _Integral(x, y)
    sliding = -integral(fields.couette_x), -integral(fields.couette_y)
    pump = (
        0.5 * integral(fields.body_1_x + fields.body_2_x),
        0.5 * integral(fields.body_1_y + fields.body_2_y),
    )
    hydrodynamic = integral(X * p)
    curved = -integral(kinematics.bow(Y) * fields.couette_x)
    spin = integral(Y * fields.couette_x - X * fields.couette_y)
    heat = integral(fields.heat)
    k = kinematics
    force_x = sliding[0] + 0.5 * k.curvature_difference * hydrodynamic
    pumping = -hydrodynamic * (k.rolling + 0.5 * k.curvature_difference * k.sliding_x)
    mechanical = -(
        sliding[0] * k.sliding_x + sliding[1] * k.sliding_y + spin * k.spin + curved * k.rolling
    )
    dry = p <= 0.0
    return TractionResult(
        force_x=force_x,
        force_y=sliding[1],
        sliding_force_x=sliding[0],
        sliding_force_y=sliding[1],
        pumping_force_x=pump[0],
        pumping_force_y=pump[1],
        spin_moment=spin,
        rolling_moment_1=hydrodynamic + curved,
        rolling_moment_2=-hydrodynamic - curved,
        hydrodynamic_moment=hydrodynamic,
        curvature_moment=curved,
        tilting_moment=-integral(Y * p),
        power_loss=heat + pumping,
        sliding_loss=heat,
        pumping_loss=pumping,
        coefficient=float(np.hypot(force_x, sliding[1])) / load,
        cavitated_force=float(
            np.hypot(integral(dry * fields.couette_x), integral(dry * fields.couette_y))
        ),
        force_balance_error=_film_balance(solution, 2.0 * pump[0]) / load,
        power_balance_error=abs(mechanical - heat)
        / max(abs(mechanical), abs(heat), np.finfo(np.float64).tiny),
    )


def film_viscosity(solution: ContactSolution) -> Array:
    """Viscosity at the pressure of each node, shape (nx, ny) [Pa s].

    Of a film that was solved with heat or shear that at its temperature, and with what the
    pressure's flow thins it.
    """
    state = solution.state
    if state is None:
        return pressure_viscosity(solution.pressure, solution)
    oil = dimensional_conditions(solution).lubricant
    warm: Array = bounded_viscosity(solution.pressure, oil, state.temperature) * np.exp(
        -state.log_fluidity
    )
    return warm


def film_temperature(solution: ContactSolution, inlet: float | None) -> Array | float | None:
    """Of the oil where it is sheared, shape (nx, ny) where the film was solved with heat, else as
    at the inlet [K].
    """
    return (
        inlet
        if solution.state is None or solution.state.temperature is None
        else solution.state.temperature
    )


def pressure_viscosity(pressure: Array, solution: ContactSolution) -> Array:
    """Viscosity [Pa s] of a solution's oil at pressures [Pa], at most `LARGEST_VISCOSITY`."""
    return bounded_viscosity(pressure, dimensional_conditions(solution).lubricant)


def bounded_viscosity(pressure: Array, oil: Lubricant, temperature: Array | None = None) -> Array:
    """Viscosity [Pa s] at pressures [Pa] and temperatures [K], at most `LARGEST_VISCOSITY`."""
    with np.errstate(over="ignore"):
        return np.minimum(viscosity(pressure, oil, temperature), LARGEST_VISCOSITY)


def sheared_width(film: Array, pressure: Array, cavitation: Cavitation) -> Array:
    """Share of the width that is sheared, shape (nx, ny) [-].

    Parameters
    ----------
    film, pressure : ndarray, shape (nx, ny)
        h [m] and p [Pa].
    cavitation : Cavitation
        Its strips start from the last node of each line along x that has pressure; a line without
        any has none.
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
    strips = np.where(
        downstream, np.minimum(rupture[None, :] / np.maximum(film, np.finfo(float).tiny), 1.0), 0.0
    )
    return np.where(full, 1.0, strips)


def with_outlet(solution: ContactSolution) -> ContactSolution:
    """A solution with `OUTLET_NODES` more lines downstream of its box, ever wider apart, where the
    gap opens further.

    Strips of oil shear behind the contact far beyond the box, whose end would show in the friction
    of thick films. The deflection at the end of the box is kept beyond it.

    Parameters
    ----------
    solution : ContactSolution
        Of dimensional conditions [m].
    """
    x, y, h = dimensional_grid(solution)
    assert solution.semi_axis_x is not None and solution.film_scale is not None
    start = max(x[-1] - x[-2], 1e-3 * solution.semi_axis_x)
    further = x[-1] + start * np.cumsum(OUTLET_GROWTH ** np.arange(OUTLET_NODES))
    along, mixed = _curvatures(solution)
    opened = (
        0.5 * along * (further**2 - x[-1] ** 2)[:, None] + mixed * (further - x[-1])[:, None] * y
    )
    height = np.maximum(h[-1] + opened, h[-1]) / solution.film_scale
    return replace(
        solution,
        X=np.concatenate([solution.X, further / solution.semi_axis_x]),
        P=np.concatenate([solution.P, np.zeros_like(height)]),
        H=np.concatenate([solution.H, height]),
        state=_state_with_outlet(solution.state),
    )


def _state_with_outlet(state: FilmState | None) -> FilmState | None:
    """That of the last line for all lines further downstream."""
    if state is None:
        return None
    more = ((0, OUTLET_NODES), (0, 0))
    warm = None if state.temperature is None else np.pad(state.temperature, more, mode="edge")
    return FilmState(temperature=warm, log_fluidity=np.pad(state.log_fluidity, more, mode="edge"))


def _curvatures(solution: ContactSolution) -> tuple[float, float]:
    """Of the gap along the grid's x, and mixed [1/m]."""
    c = dimensional_conditions(solution)
    cosine, sine = np.cos(solution.frame_angle), np.sin(solution.frame_angle)
    return cosine**2 / c.radius_x + sine**2 / c.radius_y, sine * cosine * (
        1.0 / c.radius_y - 1.0 / c.radius_x
    )


def _film_balance(solution: ContactSolution, traction: float) -> float:
    """Sum of the tractions on both bodies along x and of the pressure on the film's sides [N];
    zero if balanced.
    """
    x, y, h = dimensional_grid(solution)
    p = solution.pressure
    along, mixed = _curvatures(solution)
    horizontal = _Integral(x, y)(p * (along * x[:, None] + mixed * y[None, :]))
    edges = np.trapezoid(p[-1] * h[-1], y) - np.trapezoid(p[0] * h[0], y)
    return float(traction - horizontal + edges)


class _Integral:
    """Trapezoidal rule over a grid."""

    def __init__(self, x: Array, y: Array) -> None:
        self.weight = np.gradient(x)[:, None] * np.gradient(y)[None, :]
        for edge in (np.s_[0, :], np.s_[-1, :], np.s_[:, 0], np.s_[:, -1]):
            self.weight[edge] *= 0.5

    def __call__(self, values: Array) -> float:
        return float(np.sum(self.weight * values))


def dimensional_grid(solution: ContactSolution) -> tuple[Array, Array, Array]:
    """x, y and film of a solution that has them [m]."""
    if solution.x is None or solution.y is None or solution.film is None:
        raise ValueError("solution: traction needs dimensional conditions, not Moes' groups alone")
    return solution.x, solution.y, solution.film


def dimensional_conditions(solution: ContactSolution) -> ContactConditions:
    """Of a solution that has them [N], [m].

    Raises
    ------
    ValueError
        If it is known by Moes' groups alone.
    """
    if not isinstance(solution.conditions, ContactConditions):
        raise ValueError("solution: traction needs dimensional conditions, not Moes' groups alone")
    return solution.conditions
