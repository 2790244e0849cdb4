r"""Hydrodynamic rolling moment of the oil that a contact has, up to its meniscus.

Far from a flooded contact the pressure is :math:`s(\theta) r/H^2`, near Kapitza's (1955)
:math:`-k_x x/H^2` ahead of the contact and zero where oil breaks behind it
(`ehl.multigrid.far_field`), so that the moment :math:`-\iint x p` of the oil between two distances
from the centre of a paraboloid gap is, by Kapitza's,

.. math:: \frac{24 \pi\,\eta_0 u R_x^2}{(3 + 2 R_x/R_y)\sqrt{R_x/R_y}}\,\ln\frac{r_2}{r_1},

whatever the load: it grows with the logarithm of the oil's extent, half of that of the layer's.
The extent is the oil's, not the solver's box. On each ray from the centre oil counts up to the
meniscus, where the gap is as wide as the layer that the bodies carry in
(`Lubricant.flooded_layer`): in the box the solved pressure, beyond its edge that of the far field,
which the solver has set on that edge (1.4 % more than Kapitza's moment for a sphere, 3.5 % for
:math:`R_x/R_y = 1/45`). In the box the moment is that by which the surfaces turn as much power
into heat as the flow does (`pressure_moment`). The lever of the pressure alone stays above it on
every mesh on which the pressure behind the spike falls within two cells, by 5.1 % on 257 points
and 2.7 % on 1025 (M 300, L 15, :math:`R_x/R_y = 2`); films solved with shear or heat have that
one. Farther out than 0.2 of the smaller radius of a ray's section the gap is that of two circles
(`oil_extent`); the pressure goes with its square there.

What that leaves out. The film is solved without a meniscus: at one, where the pressure vanishes,
mass conservation asks for a layer of 0.3675 of the gap under a sphere, and the moment is that of
Kapitza's pressure up to a gap of 1.446 layers: 0.18 of the moment above per unit of logarithm more
(`tests/ehl/traction/test_meniscus.py`), more yet in wide ellipses. And the pressure over the
square of the gap of circles is, up to 0.3 of the radius, 1.2 % above that of Reynolds' equation.
"""

from dataclasses import dataclass
from math import hypot, inf, nan

import numpy as np

from ..conditions import ContactConditions
from ..multigrid.supply.oil_supply import pressure_moment
from ..scaling import ScaledContact, scale_contact
from ..solution import ContactSolution
from .oil_around import MeniscusRegion, along_entrainment
from .shear import trapezoidal_weights

SAME_ANGLE = 1e-9  # [rad]
# Error by the mesh over the sum of what the balance of power changes and the share of the step of
# the central film from the finest grid to its limit [-]: 95 % of 71 random contacts are within
# 0.16, 0.24, 0.32, 0.39 of it on 65, 129, 257, 513 points (`benchmarks/rolling_moment.py`)
MESH_ERROR = 0.4
# films solved with shear or heat, whose balance has more terms: error of the lever arm of the load
# over the contact's half length, times (mesh/half length)^-1.5 [-]: 0.02 to 0.34 in the sixteen
# contacts of `benchmarks/rolling_moment.py`, without either, on 65 to 513 points
LEVER_ERROR = 0.4
# Relative error of the moment over the residual [-]: below 1 in most, some 10 at most in 30
# contacts on 129 points and six on 257 and 513, cycled on until the residual had vanished
RESIDUAL_ERROR = 10.0
# Relative error of the moment beyond the box [-]: solved in a box five times as long it changes by
# at most 0.19 of it (five contacts, boxes from 3 semi-axes on)
FAR_FIELD_ERROR = 0.2
# Hamrock and Dowson (1977, part IV): distance of the meniscus over the half length, below which
# the film starves, 1 + 3.06 [(R/b)^2 h/R]^0.58
FLOODED_DISTANCE = (3.06, 0.58)


@dataclass(frozen=True, slots=True, kw_only=True)
class RollingMoment:
    """Moment of the pressure ahead of the centre, positive where it resists rolling along the
    entrainment.
    """

    value: float  # of the oil up to its meniscus [N m]
    # error by the mesh, the residual of the equations and the far field; not of the layer [N m]
    uncertainty: float
    box: float  # of the solved box alone [N m]
    layer: float  # of oil at the inlet, as wide as the gap at the meniscus [m]
    # distance of the meniscus ahead of the centre [m]; None where the oil ends on the edge of a
    # fixed box
    extent: float | None
    note: str = ""  # why the layer does not end the oil, or does not flood the contact


def rolling_moment(
    solution: ContactSolution, inlet_film_thickness: float | None = None
) -> RollingMoment:
    """Integrate the hydrodynamic rolling moment of the oil up to its meniscus, Kapitza (1955).

    His field holds far outside the ellipse, where the oil is isoviscous and the deflection small.
    In a box that was prescribed the oil ends on the edge, without pressure there.

    Parameters
    ----------
    solution : ContactSolution
        solved contact
    inlet_film_thickness : float | None, optional
        inlet film thickness, both surfaces together; None: that of the lubricant [m]

    Returns
    -------
    RollingMoment
        moment with its error bar; not a number where the film did not converge

    Raises
    ------
    ValueError
        if the conditions have no dimensions
    """
    conditions, a = _dimensions(solution)
    inlet_film_thickness = (
        conditions.lubricant.flooded_layer
        if inlet_film_thickness is None
        else inlet_film_thickness
    )
    if not inlet_film_thickness > 0.0:
        raise ValueError(f"layer must be positive, got {inlet_film_thickness!r}")
    scale = solution.hertz_pressure * a**3
    if not solution.converged:
        return _unknown(inlet_film_thickness, "the film did not converge")
    contact = scaled_as_solved(solution)
    moments = -trapezoidal_weights(solution.X, solution.Y) * solution.P * scale
    moments *= along_entrainment(contact, solution.X[:, None], solution.Y[None, :])
    box = float(moments.sum())
    if solution.supply is not None:
        return _with_inlet_film(solution, conditions, contact, box)
    change = 0.0 if solution.state else scale * pressure_moment(solution, contact)[1]
    box += change
    if solution.options.domain is not None:
        return RollingMoment(
            value=box,
            uncertainty=_solution_error(solution, contact, (box, change)),
            box=box,
            layer=inlet_film_thickness,
            extent=None,
            note="the box is fixed by [ehl] domain, the oil ends on its edge",
        )
    oil = MeniscusRegion(solution, contact, conditions.ball_radius, inlet_film_thickness)
    beyond = scale * oil.moment_beyond_box()
    value = box - float(np.sum(moments * oil.dry_moment_fraction())) + beyond
    left = _solution_error(solution, contact, (value, change))
    extent = oil.meniscus_ahead()
    return RollingMoment(
        value=value,
        uncertainty=left + FAR_FIELD_ERROR * abs(beyond),
        box=box,
        layer=inlet_film_thickness,
        extent=a * extent,
        note=_starved_note(solution, contact, extent),
    )


def _unknown(inlet_film_thickness: float, note: str) -> RollingMoment:
    return RollingMoment(
        value=nan, uncertainty=inf, box=nan, layer=inlet_film_thickness, extent=None, note=note
    )


def _with_inlet_film(
    solution: ContactSolution, conditions: ContactConditions, contact: ScaledContact, box: float
) -> RollingMoment:
    """Integrate the moment of a film that was solved behind a layer. Its pressure ends at its own
    meniscus, and beyond an open box that the layer floods where the gap is as wide as it.

    box: by the integral of the pressure [N m]. The value is that by the heat of its flow; the
    difference of both is in the error bar whole, with the share of the film's step that a flooded
    one has: the value was off by up to 1.2 of that difference, mostly by less than a half (five
    contacts, r of 0.2 to 2, on 129 and 257 points against 513), and by more where it changes its
    sign.
    """
    assert solution.supply is not None and conditions.inlet_layer is not None
    a = solution.semi_axis_x
    assert a is not None
    inlet_film_thickness = conditions.inlet_layer.central
    scale = solution.hertz_pressure * a**3
    if solution.supply.law is not None:
        return _by_law(solution, inlet_film_thickness, scale)
    change = scale * pressure_moment(solution, contact)[1]
    extent = solution.supply.meniscus
    beyond = 0.0
    note = ""
    if extent is None and solution.options.domain is None:
        oil = MeniscusRegion(solution, contact, conditions.ball_radius, inlet_film_thickness)
        beyond = scale * oil.moment_beyond_box()
        extent = -oil.meniscus_ahead()
    elif extent is None:
        note = "the layer at the inlet floods the box of the film, and the oil ends on its edge"
    value = box + change + beyond
    return RollingMoment(
        value=value,
        uncertainty=abs(change)
        + MESH_ERROR * _film_step(solution) * abs(value)
        + _cycle_error(solution, value)
        + FAR_FIELD_ERROR * abs(beyond),
        box=box + change,
        layer=inlet_film_thickness,
        extent=None if extent is None else -a * extent,
        note=note,
    )


def _by_law(solution: ContactSolution, inlet_film_thickness: float, scale: float) -> RollingMoment:
    """Reduce the moment in the box of the flooded film by the law of starvation. The error bar
    includes the law's, and the difference of the two ways to sum that moment.

    inlet_film_thickness: at the inlet [m]; scale: of moments, p_h a^3 [N m].
    """
    supply = solution.supply
    assert supply is not None and supply.law is not None
    fraction = supply.law.rolling_moment
    flooded = scale * sum(supply.flooded_moment)
    value = fraction.value * flooded
    of_film = scale * abs(supply.flooded_moment[1]) + _cycle_error(solution, flooded)
    return RollingMoment(
        value=value,
        uncertainty=hypot(fraction.value * of_film, fraction.uncertainty * flooded),
        box=value,
        layer=inlet_film_thickness,
        extent=None,
        note="the law of starvation knows no meniscus",
    )


def _dimensions(solution: ContactSolution) -> tuple[ContactConditions, float]:
    """Conditions of a solution and the semi-axis along x [m]."""
    conditions = solution.conditions
    a = solution.semi_axis_x
    if not isinstance(conditions, ContactConditions) or a is None:
        needed = "dimensional conditions, not Moes' groups alone"
        raise ValueError(f"solution: the rolling moment needs {needed}")
    return conditions, a


def scaled_as_solved(solution: ContactSolution) -> ScaledContact:
    """Scale the conditions of a solution in the frame of its grid.

    Parameters
    ----------
    solution : ContactSolution
        solved contact

    Returns
    -------
    ScaledContact
        scaled contact

    Raises
    ------
    ValueError
        if the frame is neither of the solver's two
    """
    for along in (False, True):
        contact = scale_contact(solution.conditions, along_entrainment=along)
        if abs(contact.frame_angle - solution.frame_angle) < SAME_ANGLE:
            return contact
    frame = f"the solution's frame at {solution.frame_angle:g} rad"
    raise ValueError(f"{frame} is none of the solver's")


def _solution_error(
    solution: ContactSolution, contact: ScaledContact, moment: tuple[float, float]
) -> float:
    """Estimate the error of a solution's moment by mesh and residual, of which the second is the
    change by the balance of power [N m].
    """
    value, change = moment
    cycles = _cycle_error(solution, value)
    if solution.state is None:
        return MESH_ERROR * (abs(change) + _film_step(solution) * abs(value)) + cycles
    conditions, a = _dimensions(solution)
    half_length = contact.half_extent_x
    centre = int(np.abs(solution.X).argmin())
    mesh = float(np.gradient(solution.X)[centre]) / half_length
    return LEVER_ERROR * mesh**1.5 * half_length * a * conditions.load + cycles


def _film_step(solution: ContactSolution) -> float:
    """Share of the step of the central film from the finest grid to its limit [-]."""
    film = solution.film_central_dimensionless
    return abs(film.value - film.finest) / abs(film.value)


def _cycle_error(solution: ContactSolution, moment: float) -> float:
    """Estimate the error of a moment by the cycles of a solution, in its unit."""
    residual = solution.record.residual[-1] if solution.record.residual else 0.0
    return RESIDUAL_ERROR * residual * abs(moment)


def _starved_note(solution: ContactSolution, contact: ScaledContact, extent: float) -> str:
    """Note on a layer that does not flood the contact, by its meniscus ahead of the centre [-]."""
    half_length = contact.half_extent_x
    factor, power = FLOODED_DISTANCE
    film = solution.film_central_dimensionless.value
    needed = 1.0 + factor * (film / (contact.curvature_x * half_length**2)) ** power
    if extent >= needed * half_length:
        return ""
    return (
        f"the layer ends {extent / half_length:.1f} half lengths of the contact ahead of its "
        f"centre, and its film is flooded from {needed:.1f} on (Hamrock and Dowson, 1977)"
    )
