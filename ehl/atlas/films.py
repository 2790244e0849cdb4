"""Films, rolling moment and stiffness of a flooded contact by the atlas, without a solve.

Newtonian and isothermal, flooded; entrainment along x, or at an angle; the oil after
Roelands with the density of Dowson and Higginson, or one of another law, for which a Roelands oil
stands (`oils`). Each value has the error within which nineteen of twenty contacts lay that were
solved to judge the table. Contacts beyond the table are refused; `nearest_covered` gives the
nearest one within it, `atlas_disagreements` compares a solved film with that of the atlas.

Entrainment at an angle: in its frame the gap is S X^2/2 + T Y^2/2 + C X Y. Without C the contact
is one of R_x/S and the ratio T/S, whose load and oil are M S^(5/4) and L S^(1/4). The functions of
the table at that place, x, are exact at C = 0, along both principal directions and in circles;
else

    F(x, m) = F(x) + m sum_i w_i m_i k(|((x, m) - (x_i, m_i))/l|),   m = C^2/(S T)

with the radial functions of `table`, fitted to solutions at an angle by `tools/atlas/skewed.py`,
and terms of the oil. Films are counted in a^2/R_x of the straight contact, and the deflection less
the difference of both Hertz approaches. A rotation of the entrainment changes them by a fitted law
(`rotation_law`).
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from math import cos, exp, inf, isfinite, log, pi, sin, sqrt
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..arrays import Array, radial
from ..closed_form.film import MAX_FILM_OVER_RADIUS
from ..closed_form.hertz import hertz_coefficients
from ..conditions import ContactConditions, MoesConditions
from ..data_files import read_arrays
from ..oil.lubricant import Lubricant
from ..scaling import ScaledContact, scale_contact
from ..solution import ContactSolution, FilmValue
from ..traction.rolling_moment import circles_moment_loss
from .oils import LIGHT_DENSITY, density_correction, density_excess, law_error, with_inlet_oil
from .table import BASE_ALPHA, BASE_Z, LIGHT, error_bars, functions

FILE = Path(__file__).parent / "skewed.npz"
# ranges of the contact along its principal direction of smaller radius, validated for entrainment
# at an angle
SKEW_RANGE = {
    "entrainment_angle_deg: A along the smaller radius": (10.0, 80.0),
    "entrainment_angle_deg: ratio of the smaller radius to the larger": (0.05, 1.0),
}
ACROSS_CLASSES = (1.0, 2.0)  # T/S, below, between and above which errors were judged
STRAIGHT = 1e-12  # m below which the entrainment counts as along a principal direction
MIXED = 3  # functions that the mixed curvature adds to, ln(Hc A), ln(Hmin A), Hc - H0

# speed at the end of the ellipse by a rotation of the entrainment, over u_m, up to which the table
# counts
ROTATION = 0.02
ROTATION_WIDE = 0.65  # what the minimum film's bar grows by over it, Rx/Ry above `SLIM`
SLIM = 0.1  # Rx/Ry up to which ellipses are as those of ball bearings

# ranges of A, L, D, Roelands' z [-] and alpha [1/Pa] between which the table was validated
RANGE = {
    "A = a^2/(Rx^2 sqrt(2U))": (0.35, 160.0),
    "L": (0.0, 30.0),
    "Rx/Ry": (0.01, 5.0),
    "roelands_z": (0.3, 1.1),
    "pressure_viscosity": (8e-9, 32e-9),
}
# L, and A up to so much, in the slim ellipses of ball bearings, where A is at most
# (`LARGEST_PRESSURE`/L)^2, too: alpha p_h is some quarter of L sqrt(A) there
BEARING_LOAD = 1300.0  # twice the largest A that was solved
BEARING_L = (3.0, 42.0)  # softer contacts beyond A 160 were up to 8 % off
BEARING_RATIO = (0.01, 0.1)
BEARING_ALPHA = (7.5e-9, 32e-9)  # [1/Pa]
LARGEST_PRESSURE = 400.0
CASE_KEYS = {"pressure_viscosity": ("pressure_viscosity_1_GPa", 1e-9)}  # and the key's unit
ALIGNED = 1e-9  # sine of the angle between entrainment and x that counts as none
LAYERS = (8.0, 25.0, 400.0)  # of the tabulated moments, over 1 + H_c [-]
THINNEST_LAYER = 3.0  # over 1 + H_c, beyond which the moment is extrapolated no further
MOES_LAYER = 25.0  # of Moes conditions, over a^2/Rx
STEP = 0.02  # of ln A, over which H0 is differentiated
# relative error of the stiffness below and above A = `LIGHT`: 70 contacts solved at 0.985 and
# 1.015 of the load were within 6.9 % (A 2.2 to 6.5, others below 0.6 %) and 0.6 % [-]
STIFFNESS_ERROR = (0.07, 0.01)
# error of the moment that the gap of circles takes from that of paraboloids: 95 % of the drawn by
# `python tools/atlas/circles.py 20261127 30` are within 0.17 [-]
CIRCLES = 0.2

EDGE = 1e-9  # within a range [-]


class Along(NamedTuple):
    """The straight contact of an entrainment at an angle [-]."""

    load: float  # A
    lubricant: float  # L
    ratio: float  # T/S
    curvature: float  # S
    mixed: float  # m
    unit: float  # its a^2/Rx over that of the contact
    approach: float  # Hertz approach of the contact less that of the straight one, in this unit
    slimmer: tuple[float, float]  # A and D along the principal direction of the smaller radius

    @property
    def place(self) -> Array:
        """(ln A, sqrt L, ln D, m), shape (4,) [-]."""
        return np.array([log(self.load), sqrt(self.lubricant), log(self.ratio), self.mixed])


class Skew(NamedTuple):
    """Contents of the file [-]."""

    places: Array  # (n, 4)
    scales: Array  # (4,)
    weights: Array  # (n, 3)
    oils: Array  # (8, 3)
    # (2, 3, 3) relative errors, of Hc - H0 absolute ones, within which nineteen of twenty fresh
    # contacts lie: of the base oil and of others, by classes of T/S
    bars: Array


def along_entrainment(load: float, lubricant: float, ratio: float, angle: float) -> Along:
    """Transform a contact with entrainment at an angle to the straight one.

    Parameters
    ----------
    load : float
        A of the contact along x [-]
    lubricant : float
        L [-]
    ratio : float
        Rx/Ry [-]
    angle : float
        angle of the entrainment from x towards y [rad]

    Returns
    -------
    Along
        straight contact, with its mixed curvature
    """
    c, s = cos(angle), sin(angle)
    first, across = c * c + ratio * s * s, s * s + ratio * c * c
    f, _, d = hertz_coefficients(ratio)
    straight_ratio = across / first
    straight_f, _, straight_d = hertz_coefficients(straight_ratio)
    unit = (straight_f / f) ** 2 * first ** (1.0 / 3.0)
    mixed = (s * c * (ratio - 1.0)) ** 2 / (first * across)
    slimmer = (load, ratio)
    if ratio > 1.0:  # A goes with f^2 S^(5/6)
        turned = hertz_coefficients(1.0 / ratio)[0] / f
        slimmer = (load * turned**2 * ratio ** (5.0 / 6.0), 1.0 / ratio)
    return Along(
        load=load * unit * sqrt(first),
        lubricant=lubricant * first**0.25,
        ratio=straight_ratio,
        curvature=first,
        mixed=mixed if mixed > STRAIGHT else 0.0,
        unit=unit,
        approach=d / f**2 / unit - straight_d / straight_f**2,
        slimmer=slimmer,
    )


@cache
def skew() -> Skew:
    """The table, read once [-]."""
    file = read_arrays(FILE)
    return Skew(**{name: file[name] for name in Skew._fields})


def mixed_oil_terms(places: Array, alpha: Array, z: Array) -> Array:
    """Evaluate m sqrt(L) {z - z_0, ln(alpha/alpha_0)} {1, ln A, ln D, m}.

    Parameters
    ----------
    places : Array
        (ln A, sqrt L, ln D, m) of contacts, shape (n, 4) [-]
    alpha : Array
        pressure-viscosity coefficient, shape (n,) [1/Pa]
    z : Array
        Roelands' z, shape (n,) [-]

    Returns
    -------
    Array
        terms, shape (n, 8) [-]
    """
    terms = np.stack([np.asarray(z) - BASE_Z, np.log(np.asarray(alpha) / BASE_ALPHA)], axis=1)
    terms = terms * (places[:, 3] * places[:, 1])[:, None]
    factors = np.column_stack([np.ones(len(places)), places[:, 0], places[:, 2], places[:, 3]])
    return np.asarray((terms[:, :, None] * factors[:, None, :]).reshape(len(places), -1))


def mixed_radial(x: Array, tabulated: Skew) -> Array:
    """Evaluate the radial functions times m m_i.

    Parameters
    ----------
    x : Array
        (ln A, sqrt L, ln D, m) of contacts, shape (m, 4) [-]
    tabulated : Skew
        table of the mixed curvature

    Returns
    -------
    Array
        products, shape (m, n) [-]
    """
    fractions = x[:, 3:] * tabulated.places[None, :, 3]
    return np.asarray(fractions * radial(x, tabulated.places, tabulated.scales))


def mixed_functions(x: Array, alpha: Array, z: Array, tabulated: Skew | None = None) -> Array:
    """Evaluate the change of the first three functions by the mixed curvature.

    Parameters
    ----------
    x : Array
        (ln A, sqrt L, ln D, m) of contacts, shape (m, 4) [-]
    alpha : Array
        pressure-viscosity coefficient, shape (m,) [1/Pa]
    z : Array
        Roelands' z, shape (m,) [-]
    tabulated : Skew | None, optional
        table of the mixed curvature; None: that of the package

    Returns
    -------
    Array
        changes, shape (m, 3) [-]
    """
    tabulated = tabulated or skew()
    return np.asarray(
        mixed_radial(x, tabulated) @ tabulated.weights
        + mixed_oil_terms(x, alpha, z) @ tabulated.oils
    )


def skew_bars(ratio: float, base: bool) -> Array:
    """Give the errors of the first three functions with entrainment at an angle.

    Parameters
    ----------
    ratio : float
        T/S of the straight contact [-]
    base : bool
        whether the oil is that of the solves

    Returns
    -------
    Array
        errors, shape (3,) [-]
    """
    return np.asarray(skew().bars[0 if base else 1, np.searchsorted(ACROSS_CLASSES, ratio)])


# There it lowers the minimum film by 1 - exp(-k t^2), and moves the central one by some t^2: 80
# contacts solved with and without, k 0.5 to 2.4, seven light ones, k 0.03 to 1.3
# (`docs/theory/film_atlas.md`)


class Turning(NamedTuple):
    """Effect of a rotation on films in slim ellipses [-]."""

    load: float  # A up to which it counts
    ratio: float  # Rx/Ry up to which it counts
    largest: float  # t up to which contacts were solved
    minimum: float  # k
    minimum_error: float  # of k
    central_error: float  # over t^2


TURNING = (
    Turning(LIGHT, SLIM, 0.15, 0.65, 0.65, 0.12),
    Turning(inf, 0.06, 0.42, 1.0, 0.65, 0.03),
    Turning(inf, SLIM, 0.42, 1.65, 0.85, 0.03),
)


def rotation_law(load: float, ratio: float) -> Turning | None:
    """Give the effect of a rotation at a load and an ellipse.

    Parameters
    ----------
    load : float
        A of the contact [-]
    ratio : float
        Rx/Ry [-]

    Returns
    -------
    Turning | None
        coefficients; None in wide ellipses
    """
    return next((law for law in TURNING if load < law.load and ratio <= law.ratio), None)


def rotation_effect(load: float, ratio: float, turning: float) -> tuple[float, float, float]:
    """Evaluate the effect of a rotation of the entrainment on both films.

    Parameters
    ----------
    load : float
        A of the contact [-]
    ratio : float
        Rx/Ry [-]
    turning : float
        speed at the end of the ellipse by the rotation, over u_m [-]

    Returns
    -------
    minimum
        factor on the minimum film [-]
    minimum_error
        its error [-]
    central_error
        relative error of the central film [-]
    """
    law = rotation_law(load, ratio)
    if law is None:
        return 1.0, ROTATION_WIDE * turning, TURNING[0].central_error * turning**2
    square = turning**2
    lowered = exp(-law.minimum * square)
    return lowered, law.minimum_error * square, law.central_error * square


class NotInAtlasError(ValueError):
    """A contact that the atlas does not cover; `reason` says why, the message also what to use."""

    def __init__(self, reason: str) -> None:
        self.reason = reason
        super().__init__(f"{reason}; use oilfilm.ehl.solve_contact")


@dataclass(frozen=True, slots=True)
class AtlasValue:
    """A value of the atlas and its error bar, both SI or in the units of `AtlasFilms` [-]."""

    value: float  # in the unit of the quantity
    uncertainty: float  # error bar in this unit


@dataclass(frozen=True, slots=True, kw_only=True)
class AtlasFilms:
    """Films of a contact by the atlas. SI of dimensional conditions; of Moes' groups films and
    approach in a^2/Rx, the moment in p_h a^3 and the stiffness in the load over a^2/Rx [-].
    """

    central: AtlasValue  # film [m] or [a^2/Rx]
    minimum: AtlasValue  # film [m] or [a^2/Rx]
    approach: AtlasValue  # h_0, the constant of the film equation
    # up to where the gap is as wide as the layer; None: a layer below 3 (1 + H_c) a^2/Rx ends
    # too near the contact for the table, see `ehl.traction.rolling_moment`, or the entrainment is
    # at an angle to x
    rolling_moment: AtlasValue | None
    stiffness: AtlasValue  # -dF/dh_0
    inside: bool  # whether the contact lies in the range that was judged; others are refused


def atlas_films(
    conditions: ContactConditions | MoesConditions, inlet_film_thickness: float | None = None
) -> AtlasFilms:
    """Evaluate the films of a flooded contact from the atlas.

    Parameters
    ----------
    conditions : ContactConditions | MoesConditions
        flooded contact
    inlet_film_thickness : float | None, optional
        inlet film thickness up to which the rolling moment counts oil, [m] or in a^2/Rx; None:
        that of the lubricant, of Moes' conditions 25 a^2/Rx

    Returns
    -------
    AtlasFilms
        films and rolling moment with their error bars

    Raises
    ------
    NotInAtlasError
        if the atlas does not cover the contact; the message names the solver

    Examples
    --------
    >>> from oilfilm.ehl import ContactConditions, Lubricant
    >>> contact = ContactConditions(
    ...     load=60.0,
    ...     radius_x=0.01,
    ...     radius_y=0.02,
    ...     reduced_modulus=226e9,
    ...     entrainment_speed=1.5,
    ...     lubricant=Lubricant(viscosity=0.04, pressure_viscosity=18e-9),
    ... )
    >>> films = atlas_films(contact)
    >>> f"{films.central.value * 1e9:.0f} nm, {films.minimum.value * 1e9:.0f} nm"
    '318 nm, 215 nm'
    """
    (result,) = atlas_films_of_contacts([conditions], inlet_film_thickness)
    if isinstance(result, NotInAtlasError):
        raise result
    return result


def atlas_films_of_contacts(
    contacts: Sequence[ContactConditions | MoesConditions],
    inlet_film_thickness: float | None = None,
) -> list[AtlasFilms | NotInAtlasError]:
    """Evaluate the films of many flooded contacts, in a fraction of the time that each takes
    alone.

    Parameters
    ----------
    contacts : Sequence[ContactConditions | MoesConditions]
        flooded contacts
    inlet_film_thickness : float | None, optional
        inlet film thickness up to which the rolling moment counts oil, [m] or in a^2/Rx; None:
        that of the lubricants

    Returns
    -------
    list[AtlasFilms | NotInAtlasError]
        films of each; for one that is not covered the error with its reason

    Raises
    ------
    ValueError
        if `inlet_film_thickness` is not positive
    """
    if inlet_film_thickness is not None and not (
        isfinite(inlet_film_thickness) and inlet_film_thickness > 0.0
    ):
        raise ValueError(f"layer must be positive and finite, got {inlet_film_thickness!r}")
    result: list[AtlasFilms | NotInAtlasError | None] = [None] * len(contacts)
    positions: dict[int, _Position] = {}
    for n, conditions in enumerate(contacts):
        try:
            positions[n] = _position(conditions)
        except NotInAtlasError as refusal:
            result[n] = refusal
    covered = list(positions.values())
    for n, place, values, bars in zip(
        positions, covered, _functions(covered), _bars(covered), strict=True
    ):
        try:
            result[n] = _films(place, values, bars, inlet_film_thickness)
        except NotInAtlasError as refusal:
            result[n] = refusal
    return [one for one in result if one is not None]


class _Position(NamedTuple):
    """A contact that the atlas covers, with the oil that stands for its own."""

    conditions: ContactConditions | MoesConditions
    actual_oil: Lubricant  # of the contact
    scaled: ScaledContact
    along: Along
    oil: tuple[float, float]  # alpha [1/Pa] and z of the one that stands for it


def _position(conditions_of_case: ContactConditions | MoesConditions) -> _Position:
    """Locate a contact in the atlas; NotInAtlasError where it is not covered, its film aside."""
    conditions = with_inlet_oil(conditions_of_case)
    contact = scale_contact(conditions)
    load = atlas_load(contact)
    require_covered(conditions, contact, load)
    angle = conditions.entrainment_angle if skewed(conditions.entrainment_angle) else 0.0
    along = along_entrainment(load, contact.moes_lubricant, contact.radius_ratio, angle)
    alpha, z = oil_numbers(conditions.lubricant)
    place = (along.load, along.lubricant, along.ratio, z, alpha)
    require_range(place, RANGE if along.mixed else range_of(*place[1:3]))
    if along.mixed:
        require_range(along.slimmer, SKEW_RANGE)
    _require_density(conditions_of_case.lubricant, contact.hertz_pressure, along.load)
    return _Position(conditions, conditions_of_case.lubricant, contact, along, (alpha, z))


def _films(
    place: _Position, values: Array, bars: Array, inlet_film_thickness: float | None
) -> AtlasFilms:
    """By the six functions at A, and at A a little smaller and larger, shape (3, 6), and their
    errors, shape (6,) [-].
    """
    conditions, _, contact, along, _ = place
    load = along.load
    central, minimum = (exp(values[0, k]) / load for k in (0, 1))
    lowered, lobes, moved = rotation_effect(load, along.ratio, contact.turning)
    minimum = min(minimum, central) * lowered
    middle = float(bars[0]) + moved
    # 1. k = -3/2 F/(a^2/Rx)/(H0 + dH0/dlnA), as a^2 goes with F^(2/3) where U is constant
    first = log(load)
    approach, smaller, larger = (
        exp(row[0] - x) - row[2]
        for row, x in zip(values.tolist(), (first, first - STEP, first + STEP), strict=True)
    )
    stiffness = -1.5 / (approach + (larger - smaller) / (2.0 * STEP))
    approach_error = float(bars[2]) + middle * central
    # 2. scales of the conditions
    unit = along.unit * (contact.film_scale or 1.0)
    force = 1.0
    if isinstance(conditions, ContactConditions):
        _require_thin(central * unit * along.curvature / conditions.radius_x)
        force = conditions.load
    stiffness *= force / unit
    return AtlasFilms(
        central=AtlasValue(central * unit, middle * central * unit),
        minimum=AtlasValue(minimum * unit, (float(bars[1]) + lobes) * minimum * unit),
        approach=AtlasValue(approach * unit, approach_error * unit),
        rolling_moment=_rolling_moment(
            conditions, contact, values[0], float(bars[3:].max()), inlet_film_thickness
        ),
        stiffness=AtlasValue(stiffness, STIFFNESS_ERROR[int(load >= LIGHT)] * stiffness),
        inside=True,
    )


def _rolling_moment(
    conditions: ContactConditions | MoesConditions,
    contact: ScaledContact,
    values: Array,
    relative_error: float,
    inlet_film_thickness: float | None,
) -> AtlasValue | None:
    """Moment up to a layer as `atlas_films` takes it, by the six functions, shape (6,), and their
    relative error; None also for entrainment at an angle.
    """
    if skewed(conditions.entrainment_angle):
        return None
    load = atlas_load(contact)
    central = exp(values[0]) / load
    unit = contact.film_scale or 1.0
    moment_unit = 1.0
    if isinstance(conditions, ContactConditions) and contact.semi_axis_x is not None:
        moment_unit = contact.hertz_pressure * contact.semi_axis_x**3
    if inlet_film_thickness is None:
        dimensionless = contact.semi_axis_x is None
        inlet_film_thickness = MOES_LAYER if dimensionless else conditions.lubricant.flooded_layer
    ratio = contact.radius_ratio
    scale = moment_unit * pi * contact.speed / ((3.0 + 2.0 * ratio) * sqrt(ratio))
    rolling = _moment(values[3:], inlet_film_thickness / unit, central, relative_error, scale)
    if rolling is not None and isinstance(conditions, ContactConditions):
        rolling = _of_circles(rolling, conditions, contact, (central * unit, inlet_film_thickness))
    return rolling


def _functions(contacts: Sequence[_Position]) -> Array:
    """The six functions of contacts at A, and at A a little smaller and larger, shape (n, 3, 6)
    [-].
    """
    if not contacts:
        return np.empty((0, 3, 6))
    x = np.repeat([contact.along.place for contact in contacts], 3, axis=0)
    x[1::3, 0] -= STEP
    x[2::3, 0] += STEP
    alpha, z = np.repeat([contact.oil for contact in contacts], 3, axis=0).T
    result = functions(x[:, :3], alpha, z)
    mixed = x[:, 3] > 0.0
    if mixed.any():
        result[mixed, :MIXED] += mixed_functions(x[mixed], alpha[mixed], z[mixed])
        turned = np.repeat([contact.along.approach for contact in contacts], 3)
        result[mixed, MIXED - 1] += turned[mixed]
    result = result.reshape(-1, 3, 6)
    for n, contact in enumerate(contacts):
        added = density_correction(
            contact.actual_oil, contact.scaled.hertz_pressure, contact.along.load
        )
        if added.any():
            result[n] = _with_density(result[n], x[3 * n : 3 * n + 3], added)
    return result


def _with_density(values: Array, x: Array, added: Array) -> Array:
    """The six functions at x, shape (m, 6), with what density adds, to moments a fraction [-]."""
    layers = 1.0 + np.exp(values[:, :1] - x[:, :1])
    moments = values[:, 3:] + np.log(np.array(LAYERS) * layers)  # T/C
    return values + np.concatenate([np.tile(added[:3], (len(x), 1)), added[3:] * moments], axis=1)


def oil_numbers(oil: Lubricant) -> tuple[float, float]:
    """Give alpha and z of a Roelands oil; of an isoviscous one, where they do not count, those of
    the base oil.

    Parameters
    ----------
    oil : Lubricant
        lubricant

    Returns
    -------
    alpha
        pressure-viscosity coefficient [1/Pa]
    z
        Roelands' z [-]
    """
    if not oil.piezoviscous:
        return BASE_ALPHA, BASE_Z
    return oil.pressure_viscosity, oil.exponent


def _bars(contacts: Sequence[_Position]) -> Array:
    """Errors of the six functions of contacts, shape (n, 6) [-]."""
    if not contacts:
        return np.empty((0, 6))
    base = np.array(
        [oil_numbers(contact.actual_oil) == (BASE_ALPHA, BASE_Z) for contact in contacts]
    )
    bars = error_bars(np.array([contact.along.place for contact in contacts])[:, :3], base)
    for n, (_, oil, _, along, _) in enumerate(contacts):
        if along.mixed:
            bars[n, :MIXED] = np.maximum(bars[n, :MIXED], skew_bars(along.ratio, bool(base[n])))
        bars[n] = np.maximum(bars[n], law_error(oil, along.load >= LIGHT))
    return bars


def _moment(
    rest: np.ndarray,
    inlet_film_thickness: float,
    central: float,
    relative_error: float,
    scale: float,
) -> AtlasValue | None:
    """Moment up to a layer in a^2/Rx, by a parabola in its inverse through those tabulated, and
    what that leaves open of a thinner one; relative_error: of the moment; scale: C.
    """
    height = inlet_film_thickness / (1.0 + central)
    if height < THINNEST_LAYER:
        return None
    a, b, c = (1.0 / known for known in LAYERS)
    x = 1.0 / height
    first, second, third = rest.tolist()
    slope = (second - first) / (b - a)
    line = first + slope * (x - a)
    bend = ((third - second) / (c - b) - slope) / (c - a)
    parabola = line + bend * (x - a) * (x - b)
    value = log(inlet_film_thickness) + parabola
    error = relative_error * abs(value)
    if x > a:
        error += abs(parabola - line)
    return AtlasValue(value * scale, error * scale)


def _of_circles(
    moment: AtlasValue,
    conditions: ContactConditions,
    contact: ScaledContact,
    films: tuple[float, float],
) -> AtlasValue:
    """The moment [N m] of paraboloids less what the gap of circles takes from Kapitza's pressure,
    by film and layer [m].
    """
    assert contact.semi_axis_x is not None
    axes = (contact.semi_axis_x, contact.semi_axis_x * contact.semi_axis_ratio)
    lost = circles_moment_loss(conditions, axes, *films)
    return AtlasValue(moment.value - lost, moment.uncertainty + CIRCLES * abs(lost))


def atlas_load(contact: ScaledContact) -> float:
    """Evaluate A = a^2/(R_x^2 sqrt(2 U)).

    Parameters
    ----------
    contact : ScaledContact
        scaled contact

    Returns
    -------
    float
        A [-]
    """
    axis = hertz_coefficients(contact.radius_ratio)[0]
    return float(axis**2 * contact.moes_load ** (2.0 / 3.0))


def skewed(angle: float) -> bool:
    """Tell whether entrainment at an angle to x counts as oblique.

    Parameters
    ----------
    angle : float
        angle of the entrainment from x [rad]

    Returns
    -------
    bool
        True if it does
    """
    return abs(sin(angle)) > ALIGNED


def require_covered(
    conditions: ContactConditions | MoesConditions, contact: ScaledContact, load: float
) -> None:
    """Check that the equations of a contact are those of the atlas.

    Parameters
    ----------
    conditions : ContactConditions | MoesConditions
        flooded contact
    contact : ScaledContact
        scaled contact
    load : float
        A of the contact [-]

    Raises
    ------
    NotInAtlasError
        if they are not
    """
    slim = rotation_law(load, contact.radius_ratio)
    turning = ROTATION if slim is None else slim.largest
    turns = skewed(conditions.entrainment_angle) and contact.turning > 0.0
    layered = contact.coating is not None or contact.inlet_layer is not None
    if not (turns or contact.turning > turning or layered):  # as nearly all
        return
    turns_more = contact.turning > turning
    coated = contact.coating is not None
    faults = {
        "mean_spin_rad_s: the film atlas covers entrainment at an angle without spin": turns,
        "mean_spin_rad_s: the film atlas covers spin that changes the entrainment at the end of "
        f"the ellipse by less than {turning:g} of it, not by {contact.turning:.2g}": turns_more,
        "coating_thickness_um: the film atlas covers bodies without a coating": coated,
        "inlet_film_um: the film atlas covers flooded contacts": contact.inlet_layer is not None,
    }
    for fault, applies in faults.items():
        if applies:
            raise NotInAtlasError(fault)


def _require_density(oil: Lubricant, hertz_pressure: float, load: float) -> None:
    """NotInAtlasError for an oil of another density in a light contact, A [-], p_h [Pa]."""
    if load >= LIGHT or not oil.piezoviscous:
        return
    excess = density_excess(oil, hertz_pressure)
    if abs(excess) > LIGHT_DENSITY:
        raise NotInAtlasError(
            f"density_law: in light contacts, A below {LIGHT:g}, the film atlas covers densities "
            f"within {LIGHT_DENSITY:.0%} of that of Dowson and Higginson at Hertz' pressure, not "
            f"{abs(excess):.0%} off"
        )


def _require_thin(film_over_radius: float) -> None:
    """NotInAtlasError unless the film over R_x leaves the gap a paraboloid [-]."""
    if film_over_radius > MAX_FILM_OVER_RADIUS:
        raise NotInAtlasError(
            f"a central film of {film_over_radius:.2g} of R_x is outside the model: the gap "
            f"there is no paraboloid, {MAX_FILM_OVER_RADIUS:g} is the most"
        )


def range_of(lubricant: float, ratio: float) -> Mapping[str, tuple[float, float]]:
    """Give the range of contacts of an oil and an ellipse, as `RANGE`.

    Parameters
    ----------
    lubricant : float
        L [-]
    ratio : float
        Rx/Ry [-]

    Returns
    -------
    Mapping[str, tuple[float, float]]
        lowest and highest value by name
    """
    low, high = BEARING_RATIO
    lowest, highest = BEARING_L
    if not low <= ratio <= high or lubricant < lowest:
        return RANGE
    lightest = RANGE["A = a^2/(Rx^2 sqrt(2U))"][0]
    heaviest = min(BEARING_LOAD, (LARGEST_PRESSURE / min(lubricant, highest)) ** 2)
    return {
        **RANGE,
        "A = a^2/(Rx^2 sqrt(2U))": (lightest, heaviest),
        "L": BEARING_L,
        "pressure_viscosity": BEARING_ALPHA,
    }


def require_range(
    values: tuple[float, ...], ranges: Mapping[str, tuple[float, float]] = RANGE
) -> None:
    """Check that numbers lie in their ranges.

    Parameters
    ----------
    values : tuple[float, ...]
        A, L, D, z [-] and alpha [1/Pa], in the order of `RANGE`
    ranges : Mapping[str, tuple[float, float]], default RANGE
        lowest and highest value by name

    Raises
    ------
    NotInAtlasError
        if one does not
    """
    for (name, (low, high)), value in zip(ranges.items(), values, strict=True):
        if not low <= value <= high:
            key, unit = CASE_KEYS.get(name, (name, 1.0))
            within = f"must lie in {low / unit:g} to {high / unit:g} for the film atlas"
            raise NotInAtlasError(f"{key} {within}, got {value / unit:.4g}")


Pair = tuple[str, FilmValue, AtlasValue]


def atlas_disagreements(solution: ContactSolution) -> Iterator[Pair]:
    """List films of a contact that differ from those of the atlas by more than both error bars.

    None is listed where the film is not resolved, was solved with shear or heat or in a prescribed
    box, or the atlas does not cover the contact.

    Parameters
    ----------
    solution : ContactSolution
        solved contact; behind an inlet film its flooded solution counts

    Yields
    ------
    Iterator[Pair]
        name, solved value [a^2/Rx] and that of the atlas ([m], or [a^2/Rx] of Moes' groups)
    """
    film = solution if solution.supply is None else solution.supply.flooded
    trusted = film.converged and film.resolved
    if not trusted or film.state is not None or film.options.domain is not None:
        return
    try:
        films = atlas_films(replace(film.conditions, inlet_layer=None))
    except NotInAtlasError:
        return
    unit = film.film_scale or 1.0
    for name, solved, tabulated in (
        ("central", film.film_central_dimensionless, films.central),
        ("minimum", film.film_minimum_dimensionless, films.minimum),
    ):
        if (
            abs(unit * solved.value - tabulated.value)
            > unit * solved.uncertainty + tabulated.uncertainty
        ):
            yield name, solved, tabulated


def nearest_covered(conditions: ContactConditions) -> tuple[ContactConditions | None, float]:
    """Search the nearest contact that the atlas covers: another load, pressure-viscosity and z.

    Parameters
    ----------
    conditions : ContactConditions
        flooded contact

    Returns
    -------
    contact
        nearest contact; None if these do not bring it into the range
    distance
        |ln(A/A')| + |ln(L/L')| + |z - z'| [-]
    """
    standing = with_inlet_oil(conditions)
    assert isinstance(standing, ContactConditions)
    contact = scale_contact(standing)
    if skewed(conditions.entrainment_angle):
        return None, 0.0
    load = atlas_load(contact)
    ranges = range_of(contact.moes_lubricant, contact.radius_ratio)
    thick = _nearest("L", contact.moes_lubricant, ranges)
    wanted = _nearest("A = a^2/(Rx^2 sqrt(2U))", load, ranges)
    slim = rotation_law(wanted, contact.radius_ratio)
    if slim is not None and contact.turning > slim.largest:
        wanted = max(wanted, LIGHT)
    # 1. the oil; that of an isoviscous one does not count
    alpha, z = oil_numbers(standing.lubricant)
    rise = _nearest("roelands_z", z, ranges)
    way = abs(log(load / wanted)) + abs(z - rise)
    oil = standing.lubricant
    if rise != z:
        oil = replace(oil, roelands_z=rise)
    if thick != contact.moes_lubricant:
        alpha *= thick / contact.moes_lubricant
        oil = replace(oil, pressure_viscosity=alpha, roelands_z=rise)
        way += abs(log(contact.moes_lubricant / thick))
    # 2. check that the change brings it into the range
    nearest = replace(standing, load=conditions.load * (wanted / load) ** 1.5, lubricant=oil)
    try:
        require_covered(nearest, contact, wanted)
        require_range((wanted, thick, contact.radius_ratio, rise, alpha), ranges)
    except NotInAtlasError:
        return None, 0.0
    return (nearest, way) if way else (conditions, 0.0)


def _nearest(name: str, value: float, ranges: Mapping[str, tuple[float, float]]) -> float:
    """Clip a value to a range, a little within it, so that rounding does not leave it."""
    low, high = ranges[name]
    if low <= value <= high:
        return value
    return low * (1.0 + EDGE) if value < low else high * (1.0 - EDGE)
