"""The one bridge between SI and the solver's dimensionless form.

X = x/a, Y = y/a, P = p/p_h, H = h Rx/a^2; a is the Hertz semi-axis along the principal direction
x, p_h the Hertz pressure. With M, L and the ratio Rx/Ry the whole problem follows but for the
scale of pressure (Moes, 1992), so both kinds of conditions are scaled in one way: SI -> (M, L,
Rx/Ry, p_h) -> `ScaledContact`.
"""

from dataclasses import dataclass, replace
from math import atan2, cos, inf, pi, sin, sqrt
from typing import Any

import numpy as np

from .arrays import Array
from .closed_form.film import moes_film_nijenbanning
from .closed_form.hertz import ellipse_ratio, hertz_coefficients
from .closed_form.starvation import inlet_ratio_of_moment, starvation_factors
from .closed_form.starvation_factors import StarvationFactors
from .conditions import (
    Coating,
    ContactConditions,
    MoesConditions,
    moes_groups,
    speed_load_material,
)
from .oil.lubricant import (
    DOWSON_HIGGINSON_DENOMINATOR,
    DOWSON_HIGGINSON_NUMERATOR,
    DensityLaw,
    InletLayer,
    Lubricant,
    ViscosityLaw,
)

# s [(1 + q P)^z - 1]
CLOSED_FORM_LAWS = (ViscosityLaw.ROELANDS, ViscosityLaw.BARUS, ViscosityLaw.ISOVISCOUS)
ALIGNMENT_TOLERANCE = 1e-12  # |C| below this is an entrainment along a principal direction
# speed at the end of the ellipse, over u_m, below which a rotation of the entrainment is neglected
SMALLEST_ROTATION = 1e-3
# Beyond these the law of starvation, which is of entrainment along a principal direction, counts
# as outside its range: |C|, the mixed curvature, and the speed of rotation at the end of the
# ellipse over u_m
OBLIQUE = 0.05
TURNING = 0.1


@dataclass(frozen=True, slots=True, kw_only=True)
class _Frame:
    """Direction of the grid [rad], entrainment over u_m in it, and its rotation [-]."""

    angle: float
    velocity: tuple[float, float]
    rotation: float

    @property
    def direction(self) -> float:
        """Direction of the entrainment, from the principal direction x towards y [rad]."""
        return self.angle + atan2(self.velocity[1], self.velocity[0])


@dataclass(frozen=True, slots=True, kw_only=True)
class ScaledCoating:
    """Compliance 1/r + f c(r/t)/t of both bodies together, lengths in units of a [-]."""

    thickness: float  # t/a
    fraction: float  # f, of the coated body in the compliance of the contact
    ratio: float  # E of the substrate over that of the coating
    poisson: tuple[float, float]  # of coating and substrate


def scaled_coating(coating: Coating, reduced_modulus: float, semi_axis: float) -> ScaledCoating:
    """Dimensionless form of a coating.

    Parameters
    ----------
    coating : Coating
        thickness and elastic constants
    reduced_modulus : float
        E' of the coating against the other body [Pa]
    semi_axis : float
        a [m]

    Returns
    -------
    ScaledCoating
        the coating in units of a

    Raises
    ------
    ValueError
        if E' is larger than the coating alone allows
    """
    fraction = 0.5 * reduced_modulus * (1.0 - coating.poisson_ratio**2) / coating.youngs_modulus
    if fraction > 1.0 + 1e-9:
        raise ValueError("reduced_modulus exceeds that of the coating against a rigid body")
    return ScaledCoating(
        thickness=coating.thickness / semi_axis,
        fraction=fraction,
        ratio=coating.substrate_youngs_modulus / coating.youngs_modulus,
        poisson=(coating.poisson_ratio, coating.substrate_poisson_ratio),
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class ScaledContact:
    """Coefficients of the dimensionless equations; all [-] but the pressure and length scales."""

    curvature_x: float  # S: H contains S X^2/2 + T Y^2/2 + C X Y in the frame of the grid
    curvature_y: float  # T
    curvature_xy: float  # C
    deformation: float  # c_def = 2 p_h Rx/(pi E' a): H contains c_def * double integral of P/r
    speed: float  # lambda = 12 eta_0 u_m Rx^2/(a^3 p_h)
    load: float  # (2 pi/3) b/a, the integral of P
    semi_axis_ratio: float  # b/a
    radius_ratio: float  # Rx/Ry
    frame_angle: float  # of the grid's X, from the principal direction x towards y [rad]
    velocity_x: float  # of the entrainment over u_m along the grid's X, at the origin
    velocity_y: float
    # rotation of the entrainment about the normal, Omega a/u_m: u = velocity_x - rotation Y, and
    # so on
    rotation: float
    half_extent_x: float  # of the Hertz ellipse along the grid's X, in units of a
    half_extent_y: float
    viscosity_slope: float  # s: ln(eta/eta_0) = s [(1 + q P)^z - 1]
    viscosity_pressure: float  # q
    viscosity_exponent: float  # z
    density_numerator: float  # rho = 1 + d1 P/(1 + d2 P)
    density_denominator: float
    moes_load: float  # M
    moes_lubricant: float  # L
    film_guess: float  # central film after Nijenbanning, Venner and Moes, in units of a^2/Rx
    hertz_pressure: float  # p_h [Pa]
    semi_axis_x: float | None  # a [m]
    film_scale: float | None  # a^2/Rx [m]
    coating: ScaledCoating | None = None
    # oil of a law that is none of the closed forms above, which are then not used
    oil: Lubricant | None = None
    # thickness in units of a^2/Rx over positions along the grid's Y in units of a; None: flooded
    inlet_layer: InletLayer | None = None

    @property
    def of_solution(self) -> dict[str, Any]:
        """Numbers that a `ContactSolution` keeps, by its fields."""
        names = (
            *("moes_load", "moes_lubricant", "semi_axis_ratio", "frame_angle"),
            *("semi_axis_x", "hertz_pressure", "film_scale"),
        )
        return {name: getattr(self, name) for name in names}

    def gap(self, X: Array, Y: Array) -> Array:
        """Gap of the undeformed bodies, S X^2/2 + T Y^2/2 + C X Y.

        Parameters
        ----------
        X : Array
            positions along the grid's X, any shape [-]
        Y : Array
            positions along the grid's Y, a shape that broadcasts with `X` [-]

        Returns
        -------
        Array
            gap in units of a^2/Rx, the common shape [-]
        """
        along = 0.5 * self.curvature_x * X**2
        return along + 0.5 * self.curvature_y * Y**2 + self.curvature_xy * X * Y

    def dry_pressure(self, X: Array, Y: Array) -> Array:
        """Hertz pressure in the grid's frame, sqrt(1 - X^2 - (a/b)^2 Y^2).

        Parameters
        ----------
        X : Array
            positions along the grid's X, any shape [-]
        Y : Array
            positions along the grid's Y, a shape that broadcasts with `X` [-]

        Returns
        -------
        Array
            P, the common shape, zero outside the ellipse [-]
        """
        c, s = np.cos(self.frame_angle), np.sin(self.frame_angle)
        along = X * c - Y * s
        across = (X * s + Y * c) / self.semi_axis_ratio
        return np.asarray(np.sqrt(np.maximum(1.0 - along**2 - across**2, 0.0)))

    def principal(self, X: float, Y: float) -> tuple[float, float]:
        """Position in the principal directions of a position in the grid's frame.

        Parameters
        ----------
        X : float
            position along the grid's X [-]
        Y : float
            position along the grid's Y [-]

        Returns
        -------
        x
            along the principal direction x, in units of a [-]
        y
            along the principal direction y, in units of a [-]
        """
        c, s = cos(self.frame_angle), sin(self.frame_angle)
        return X * c - Y * s, X * s + Y * c

    @property
    def turning(self) -> float:
        """Speed at the end of the ellipse by the rotation of the entrainment, over u_m [-]."""
        return abs(self.rotation) * max(1.0, self.semi_axis_ratio)

    @property
    def symmetric(self) -> bool:
        """The solution is even in Y."""
        return abs(self.curvature_xy) < ALIGNMENT_TOLERANCE and not self.lateral

    @property
    def lateral(self) -> bool:
        """The entrainment has a component along Y somewhere."""
        return self.velocity_y != 0.0 or self.rotation != 0.0


def scale_contact(
    conditions: ContactConditions | MoesConditions, *, along_entrainment: bool = False
) -> ScaledContact:
    """Dimensionless problem of one contact.

    The grid's X is the principal direction in which the entrainment passes the ellipse sooner;
    with `along_entrainment`, and where no direction is principal, X is the entrainment's. A
    rotation of the entrainment below `SMALLEST_ROTATION` at the end of the ellipse is neglected.

    Parameters
    ----------
    conditions : ContactConditions | MoesConditions
        the contact, in SI or by Moes' groups
    along_entrainment : bool, default False
        the grid follows the entrainment

    Returns
    -------
    ScaledContact
        coefficients of the dimensionless equations

    Raises
    ------
    ValueError
        if Moes conditions leave the scale of pressure open: L > 0 needs a pressure-viscosity
        coefficient
    """
    if isinstance(conditions, MoesConditions):
        d = conditions.radius_ratio
        groups = (conditions.load_parameter, conditions.lubricant_parameter, d)
        pressure = _pressure_scale(conditions, hertz_coefficients(d)[1])
        frame = _frame(d, conditions.entrainment_angle, 0.0, along_entrainment)
        scaled = _scaled(groups, pressure, conditions.lubricant, frame, None)
        return with_inlet_layer(scaled, conditions.inlet_layer)
    d = conditions.radius_x / conditions.radius_y
    f, g, _ = hertz_coefficients(d)
    _, load, _ = speed_load_material(conditions)
    pressure = g * load ** (1 / 3) * conditions.reduced_modulus
    length = (f * load ** (1 / 3) * conditions.radius_x, conditions.radius_x)
    rotation = conditions.rotation * length[0] / conditions.entrainment_speed
    frame = _frame(d, conditions.entrainment_angle, rotation, along_entrainment)
    groups = (*moes_groups(conditions), d)
    scaled = _scaled(groups, pressure, conditions.lubricant, frame, length)
    if conditions.inlet_layer is not None:
        layer = conditions.inlet_layer.scaled(length[0], length[0] ** 2 / length[1])
        scaled = with_inlet_layer(scaled, layer)
    if conditions.coating is None:
        return scaled
    return replace(
        scaled, coating=scaled_coating(conditions.coating, conditions.reduced_modulus, length[0])
    )


def with_inlet_layer(contact: ScaledContact, layer: InletLayer | None) -> ScaledContact:
    """A contact with a layer of oil at its inlet.

    Parameters
    ----------
    contact : ScaledContact
        the dimensionless contact
    layer : InletLayer | None
        thickness in units of a^2/Rx over positions across the track in units of a [-]; None:
        flooded

    Returns
    -------
    ScaledContact
        the contact with the layer

    Raises
    ------
    ValueError
        if the layer is not uniform and the entrainment is at an angle to the ellipse, so that
        positions across the track are not positions along the grid's Y
    """
    if layer is None:
        return contact
    if not (layer.uniform or contact.symmetric):
        raise ValueError(
            "inlet_layer: a profile needs entrainment along a principal direction, without spin"
        )
    return replace(contact, inlet_layer=layer)


def _frame(d: float, angle: float, rotation: float, along_entrainment: bool) -> _Frame:
    """The grid's direction for an entrainment at `angle` [rad]."""
    if abs(rotation) * max(1.0, ellipse_ratio(d)) < SMALLEST_ROTATION:
        rotation = 0.0
    # direction in which both semi-axes count as one
    crossing = atan2(sin(angle) / ellipse_ratio(d), cos(angle))
    straight = 0.5 * pi * round(crossing / (0.5 * pi))
    frame = (
        angle
        if along_entrainment or abs(sin(angle) * cos(angle) * (d - 1.0)) < ALIGNMENT_TOLERANCE
        else straight
    )
    return _Frame(
        angle=frame, velocity=(cos(angle - frame), sin(angle - frame)), rotation=rotation
    )


def _pressure_scale(conditions: MoesConditions, g: float) -> float:
    """p_h [Pa] from alpha p_h = g L M^(1/3); zero at L = 0, isoviscous and incompressible."""
    alpha = conditions.lubricant.pressure_viscosity
    product = g * conditions.lubricant_parameter * conditions.load_parameter ** (1 / 3)
    if product > 0.0 and not alpha > 0.0:
        raise ValueError(
            "lubricant_parameter > 0 needs a pressure_viscosity > 0 to set the scale of pressure"
        )
    return product / alpha if product > 0.0 else 0.0


def _scaled(
    groups: tuple[float, float, float],
    pressure: float,
    lubricant: Lubricant,
    frame: _Frame,
    length: tuple[float, float] | None,
) -> ScaledContact:
    m, l, d = groups
    f, g, _ = hertz_coefficients(d)
    ratio = ellipse_ratio(d)
    c, s = cos(frame.angle), sin(frame.angle)
    slope, relative_pressure, exponent = _viscosity_coefficients(
        g * l * m ** (1 / 3), pressure, lubricant
    )
    closed = (
        lubricant.viscosity_law in CLOSED_FORM_LAWS
        and lubricant.density_law is not DensityLaw.TAIT
    )
    compressible = lubricant.density_law is DensityLaw.DOWSON_HIGGINSON
    return ScaledContact(
        curvature_x=c * c + d * s * s,
        curvature_y=s * s + d * c * c,
        curvature_xy=s * c * (d - 1.0),
        deformation=2.0 * g / (pi * f),
        speed=6.0 / (f**3 * g) * m ** (-4 / 3),
        load=2.0 * pi / 3.0 * ratio,
        semi_axis_ratio=ratio,
        radius_ratio=d,
        frame_angle=frame.angle,
        velocity_x=frame.velocity[0],
        velocity_y=frame.velocity[1],
        rotation=frame.rotation,
        half_extent_x=sqrt(c * c + (ratio * s) ** 2),
        half_extent_y=sqrt(s * s + (ratio * c) ** 2),
        viscosity_slope=slope,
        viscosity_pressure=relative_pressure,
        viscosity_exponent=exponent,
        density_numerator=DOWSON_HIGGINSON_NUMERATOR * pressure if compressible else 0.0,
        density_denominator=DOWSON_HIGGINSON_DENOMINATOR * pressure if compressible else 0.0,
        moes_load=m,
        moes_lubricant=l,
        film_guess=_film_guess(groups, lubricant, frame.direction) / (f**2 * m ** (2 / 3)),
        hertz_pressure=pressure,
        semi_axis_x=None if length is None else length[0],
        film_scale=None if length is None else length[0] ** 2 / length[1],
        oil=None if closed else lubricant,
    )


def _film_guess(groups: tuple[float, float, float], lubricant: Lubricant, angle: float) -> float:
    """Central film by formula, in Moes' units [-]; an isoviscous oil has L = 0.

    An entrainment at an angle has the films of its two components, each along a principal
    direction with its curvature S: M S^(5/4)/v^(3/4) and L (S v)^(1/4) at the fraction v of the
    speed. Their cubes add up: 0.77 to 1.59 times the film of 93 random contacts at an angle
    (fitted; 0.75 to 1.38 where there is none).
    """
    m, l, d = groups
    if lubricant.viscosity_law is ViscosityLaw.ISOVISCOUS:
        l = 0.0
    cubes = 0.0
    for speed, curvature, across in ((abs(cos(angle)), 1.0, d), (abs(sin(angle)), d, 1.0)):
        if speed > ALIGNMENT_TOLERANCE:
            load = m * curvature**1.25 / speed**0.75
            oil = l * (curvature * speed) ** 0.25
            film = sqrt(speed / curvature) * moes_film_nijenbanning(load, oil, across / curvature)
            cubes += film**3
    return float(cubes ** (1 / 3))


def _viscosity_coefficients(
    product: float, pressure: float, lubricant: Lubricant
) -> tuple[float, float, float]:
    """(s, q, z) of ln(eta/eta_0) = s [(1 + q P)^z - 1]; Barus z = 1, isoviscous s = 0."""
    isoviscous = (
        lubricant.viscosity_law not in CLOSED_FORM_LAWS
        or lubricant.viscosity_law is ViscosityLaw.ISOVISCOUS
    )
    if isoviscous or product == 0.0:
        return 0.0, 1.0, 1.0
    if lubricant.viscosity_law is ViscosityLaw.BARUS:
        return product, 1.0, 1.0
    relative_pressure = pressure / lubricant.roelands_pressure
    exponent = lubricant.exponent
    return product / (exponent * relative_pressure), relative_pressure, exponent


def groups_along(contact: ScaledContact) -> tuple[float, float, float]:
    """M, L and Rx/Ry by the curvatures of the gap along and across the grid's x.

    They are those of the conditions where the entrainment has a principal direction. With the
    radius R/S in place of R, W S^2 and U S give M S^(5/4) and L S^(1/4).

    Parameters
    ----------
    contact : ScaledContact
        the dimensionless contact

    Returns
    -------
    load_parameter
        M [-]
    lubricant_parameter
        L [-]
    radius_ratio
        Rx/Ry [-]
    """
    s = contact.curvature_x
    return (contact.moes_load * s**1.25, contact.moes_lubricant * s**0.25, contact.curvature_y / s)


def contact_inlet_ratio(
    contact: ScaledContact, rolling_moment: float, flooded_ratio: float
) -> float:
    """Inlet layer of a contact that leaves a share of its flooded rolling moment.

    Parameters
    ----------
    contact : ScaledContact
        the dimensionless contact, in the frame of its entrainment
    rolling_moment : float
        share of the flooded moment, above zero [-]
    flooded_ratio : float
        ratio from which on a layer counts as flooded [-]

    Returns
    -------
    float
        layer over the oil of the flooded film [-]
    """
    return inlet_ratio_of_moment(*groups_along(contact), rolling_moment, flooded_ratio)


def contact_starvation_factors(
    contact: ScaledContact, ratio: float, flooded_ratio: float = inf
) -> StarvationFactors:
    """Starvation factors of a contact, in the frame of its entrainment.

    Parameters
    ----------
    contact : ScaledContact
        the dimensionless contact
    ratio : float
        inlet layer over the oil of the flooded film [-]
    flooded_ratio : float, default inf
        ratio from which on a layer counts as flooded [-]

    Returns
    -------
    StarvationFactors
        factors on films, rolling moment and damping; with wider uncertainties outside the range of
        the law
    """
    factors = starvation_factors(*groups_along(contact), ratio, flooded_ratio)
    return factors if nearly_principal(contact) else factors.outside()


def nearly_principal(contact: ScaledContact) -> bool:
    """Check whether the entrainment of a contact is that of those that the law of starvation was
    solved for.

    Parameters
    ----------
    contact : ScaledContact
        the dimensionless contact, in the frame of its entrainment

    Returns
    -------
    bool
        True where it hardly departs from a principal direction, and hardly turns
    """
    return abs(contact.curvature_xy) <= OBLIQUE and contact.turning <= TURNING
