"""Films, rolling moment and stiffness of a flooded contact by the atlas, without a solve.

Newtonian and isothermal, flooded, entrainment along x; the oil after Roelands with the density of
Dowson and Higginson. Each value has the error within which nineteen of twenty contacts lay that
were solved to judge the table. What the table does not cover is refused.
"""

from dataclasses import dataclass
from math import exp, log, pi, sin, sqrt

import numpy as np

from ...closed_form.hertz import hertz_coefficients
from ...conditions import ContactConditions, MoesConditions
from ...oil.lubricant import DensityLaw, ViscosityLaw
from ...scaling import ScaledContact, scale_contact
from .table import BASE_ALPHA, BASE_Z, functions, table

# of A, L, D, Roelands' z [-] and alpha [1/Pa] between which the table was judged
RANGE = {
    "A = a^2/(Rx^2 sqrt(2U))": (7.0, 160.0),
    "L": (0.0, 30.0),
    "Rx/Ry": (0.01, 5.0),
    "roelands_z": (0.4, 0.8),
    "pressure_viscosity": (10e-9, 30e-9),
}
ALIGNED = 1e-9  # sine of the angle between entrainment and principal direction that counts as none
# speed at the end of the ellipse by a rotation of the entrainment, over u_m, up to which the table
# counts, and how much of the minimum film it moves, over it, the bar grows by that: the largest of
# 26 contacts solved with and without (`docs/theory/film_atlas.md`) were 0.113 and 0.64
ROTATION = 0.02
SLIM = 0.06  # Rx/Ry of races
ROTATION_SLIM = 0.12  # up to it
ROTATION_WIDE = 0.65  # above
LAYERS = (8.0, 25.0, 400.0)  # of the tabulated moments, over 1 + H_c [-]
THINNEST_LAYER = 3.0  # over 1 + H_c, beyond which the moment is extrapolated no further
MOES_LAYER = 25.0  # of Moes conditions, over a^2/Rx
STEP = 0.02  # of ln A, over which H0 is differentiated
# relative error of the stiffness, assumed: direct solves at 0.98 and 1.02 of the load of 45
# contacts were within 0.3 % of an earlier table
STIFFNESS_ERROR = 0.01
# share of a nat of the moment that the gap of circles takes, over layer/Rx, to first order [-]
CIRCLES = 0.75


class NotInAtlasError(ValueError):
    """A contact that the atlas does not cover; `reason` says why, the message also what to use."""

    def __init__(self, reason: str) -> None:
        self.reason = reason
        super().__init__(f"{reason}; use ehl.solve_contact")


@dataclass(frozen=True, slots=True)
class AtlasValue:
    """A value of the atlas with its error bar, SI or in the units of `AtlasFilms` [-]."""

    value: float
    uncertainty: float  # in the unit of the value


@dataclass(frozen=True, slots=True, kw_only=True)
class AtlasFilms:
    """What the atlas knows of a contact: SI of dimensional conditions; of Moes' groups films and
    approach in a^2/Rx, the moment in p_h a^3 and the stiffness in the load over a^2/Rx [-].
    """

    central: AtlasValue
    minimum: AtlasValue
    approach: AtlasValue  # h_0, the constant of the film equation
    # up to where the gap is as wide as the layer; None: a layer below 3 (1 + H_c) a^2/Rx ends
    # too near the contact for the table, see `ehl.traction.rolling_moment`
    rolling_moment: AtlasValue | None
    stiffness: AtlasValue  # -dF/dh_0
    inside: bool  # whether the contact lies in the range that was judged; others are refused


def atlas_films(
    conditions: ContactConditions | MoesConditions, layer: float | None = None
) -> AtlasFilms:
    """Films of a flooded contact from the atlas.

    layer: at the inlet, up to which the rolling moment counts oil, [m] or in a^2/Rx; None: that of
    the lubricant, of Moes conditions 25 a^2/Rx.

    Raises
    ------
    NotInAtlasError
        If the contact is none of those that the atlas covers; the message names the solver.
    """
    contact = scale_contact(conditions)
    _require_covered(conditions, contact)
    oil = conditions.lubricant
    load = hertz_coefficients(contact.radius_ratio)[0] ** 2 * contact.moes_load ** (2.0 / 3.0)
    values = (load, contact.moes_lubricant, contact.radius_ratio)
    _require_range((*values, oil.exponent, oil.pressure_viscosity))
    # 1. the six functions at the contact, and at A a little smaller and larger
    x = np.array([[log(load), sqrt(values[1]), log(values[2])]] * 3)
    x[1:, 0] += (-STEP, STEP)
    found = functions(x, np.full(3, oil.pressure_viscosity), np.full(3, oil.exponent))
    bars = _bars(values[2], base=oil.exponent == BASE_Z and oil.pressure_viscosity == BASE_ALPHA)
    lobes = (ROTATION_SLIM if values[2] <= SLIM else ROTATION_WIDE) * contact.turning
    central, minimum = (exp(found[0, k]) / load for k in (0, 1))
    # 2. k = -3/2 F/(a^2/Rx)/(H0 + dH0/dlnA), as a^2 goes with F^(2/3) where U is constant
    approach = float(found[0, 2])
    stiffness = -1.5 / (approach + float(found[2, 2] - found[1, 2]) / (2.0 * STEP))
    # 3. scales of the conditions
    unit = contact.film_scale or 1.0
    force = 1.0
    moment_unit = 1.0
    radius = None
    if isinstance(conditions, ContactConditions) and contact.semi_axis_x is not None:
        force = conditions.load
        moment_unit = contact.hertz_pressure * contact.semi_axis_x**3
        radius = conditions.radius_x
    if layer is None:
        layer = oil.flooded_layer if radius is not None else MOES_LAYER
    scale = moment_unit * pi * contact.speed / ((3.0 + 2.0 * values[2]) * sqrt(values[2]))
    share = float(bars[3:].max())
    circles = 0.0 if radius is None else CIRCLES * layer / radius
    rolling = _moment(found[0, 3:], layer / unit, central, (share, circles), scale)
    return AtlasFilms(
        central=AtlasValue(central * unit, float(bars[0]) * central * unit),
        minimum=AtlasValue(minimum * unit, (float(bars[1]) + lobes) * minimum * unit),
        approach=AtlasValue(approach * unit, float(bars[2]) * unit),
        rolling_moment=rolling,
        stiffness=AtlasValue(stiffness * force / unit, STIFFNESS_ERROR * stiffness * force / unit),
        inside=True,
    )


def _bars(ratio: float, *, base: bool) -> np.ndarray:
    """Errors of the six functions of a contact of Rx/Ry [-]."""
    slim, wide, oils = table().bars
    own = wide if ratio > 1.0 else slim
    return own if base else np.maximum(own, oils)


def _moment(
    rest: np.ndarray, layer: float, central: float, errors: tuple[float, float], scale: float
) -> AtlasValue | None:
    """Moment up to a layer in a^2/Rx, by a parabola in its inverse through those tabulated, and
    what that leaves open of a thinner one; errors: relative, and by circles; scale: C.
    """
    share = layer / (1.0 + central)
    if share < THINNEST_LAYER:
        return None
    at = 1.0 / np.array(LAYERS)
    x = 1.0 / share
    parabola = float(np.polyval(np.polyfit(at, rest, 2), x))
    line = float(np.polyval(np.polyfit(at[:2], rest[:2], 1), x))
    value = log(layer) + parabola
    error = errors[0] * abs(value) + errors[1]
    if x > at[0]:
        error += abs(parabola - line)
    return AtlasValue(value * scale, error * scale)


def _require_covered(
    conditions: ContactConditions | MoesConditions, contact: ScaledContact
) -> None:
    """NotInAtlasError unless the equations are those of the atlas."""
    oil = conditions.lubricant
    faults = {
        "entrainment_angle: entrainment along x": abs(sin(conditions.entrainment_angle)) > ALIGNED,
        f"mean_spin: entrainment that turns at the end of the ellipse by less than "
        f"{ROTATION:g} of it, not {contact.turning:.2g},": contact.turning > ROTATION,
        "coating: bodies without one": contact.coating is not None,
        "inlet_layer: flooded contacts": contact.inlet_layer is not None,
        "viscosity_law: Roelands' law": oil.viscosity_law is not ViscosityLaw.ROELANDS,
        "density_law: that of Dowson and Higginson": oil.density_law
        is not DensityLaw.DOWSON_HIGGINSON,
    }
    for fault, found in faults.items():
        if found:
            raise NotInAtlasError(f"{fault} is what the film atlas covers")


def _require_range(values: tuple[float, ...]) -> None:
    """NotInAtlasError unless A, L, D, z and alpha lie in the range of the atlas."""
    for (name, (low, high)), value in zip(RANGE.items(), values, strict=True):
        if not low <= value <= high:
            raise NotInAtlasError(
                f"{name} must lie in {low:g} to {high:g} for the film atlas, got {value:.4g}"
            )
