"""Operating conditions of one lubricated contact."""

from dataclasses import dataclass
from math import isfinite

from .oil.lubricant import Lubricant
from .solid.coating import Coating


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactConditions:
    """One lubricated elliptical point contact, SI; x and y are the principal directions of the
    gap.

    Attributes
    ----------
    load : float
        Normal load w [N].
    radius_x, radius_y : float
        Reduced radii of curvature in x and y [m].
    reduced_modulus : float
        E' [Pa], 2/E' = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2.
    entrainment_speed : float
        Mean surface speed u_m = (u_1 + u_2)/2 [m/s].
    lubricant : Lubricant
    entrainment_angle : float
        Direction of the entrainment, from x towards y [rad].
    slide_roll_ratio : float
        (u_1 - u_2)/u_m along the entrainment [-], body 1 the ball.
    lateral_slide_ratio : float
        (v_1 - v_2)/u_m [-], v the surface speeds at right angles to the entrainment, from x
        towards y; their mean is zero by the definition of the entrainment's direction.
    spin : float
        Angular speed of body 1 relative to body 2 about the normal into body 2, x cross y [rad/s].
    mean_spin : float or None
        Angular speed (omega_1 + omega_2)/2 about the same normal, with which the entrainment turns
        from place to place [rad/s]; None: body 2 does not turn, and it is half the spin.
    coating : Coating or None
        Of one of the bodies; E' and all groups and scales made with it are then those of the
        uncoated half spaces, one of them of the coating's material.

    Raises
    ------
    ValueError
        If a value is not finite, or not positive where it must be; the message names the field.
    """

    load: float
    radius_x: float
    radius_y: float
    reduced_modulus: float
    entrainment_speed: float
    lubricant: Lubricant
    entrainment_angle: float = 0.0
    slide_roll_ratio: float = 0.0
    lateral_slide_ratio: float = 0.0
    spin: float = 0.0
    mean_spin: float | None = None
    coating: Coating | None = None

    def __post_init__(self) -> None:
        for field in ("load", "radius_x", "radius_y", "reduced_modulus", "entrainment_speed"):
            value = getattr(self, field)
            if not (isfinite(value) and value > 0.0):
                raise ValueError(f"{field} must be positive and finite, got {value!r}")
        for field in (
            "entrainment_angle",
            "slide_roll_ratio",
            "lateral_slide_ratio",
            "spin",
            "rotation",
        ):
            if not isfinite(getattr(self, field)):
                raise ValueError(f"{field} must be finite, got {getattr(self, field)!r}")

    @property
    def rotation(self) -> float:
        """Angular speed of the entrainment's field about the normal [rad/s]."""
        return 0.5 * self.spin if self.mean_spin is None else self.mean_spin

    @property
    def speed_1(self) -> float:
        """Surface speed of body 1 along the entrainment, u_1 [m/s]."""
        return self.entrainment_speed * (1.0 + 0.5 * self.slide_roll_ratio)

    @property
    def speed_2(self) -> float:
        """Surface speed of body 2 along the entrainment, u_2 [m/s]."""
        return self.entrainment_speed * (1.0 - 0.5 * self.slide_roll_ratio)


def speed_load_material(conditions: ContactConditions) -> tuple[float, float, float]:
    """U = eta_0 u_m/(E' Rx), W = F/(E' Rx^2), G = alpha E' [-], Hamrock and Dowson (1977)."""
    c = conditions
    oil = conditions.lubricant
    speed = oil.viscosity * c.entrainment_speed / (c.reduced_modulus * c.radius_x)
    return (
        speed,
        c.load / (c.reduced_modulus * c.radius_x**2),
        oil.pressure_viscosity * c.reduced_modulus,
    )


def moes_groups(conditions: ContactConditions) -> tuple[float, float]:
    """M = W (2U)^(-3/4) and L = G (2U)^(1/4) [-], Moes (1992)."""
    speed, load, material = speed_load_material(conditions)
    return load * (2.0 * speed) ** -0.75, material * (2.0 * speed) ** 0.25


@dataclass(frozen=True, slots=True, kw_only=True)
class MoesConditions:
    """One contact by its dimensionless groups, Moes (1992).

    Attributes
    ----------
    load_parameter : float
        M = W (2U)^(-3/4) [-], W = F/(E' Rx^2), U = eta_0 u_m/(E' Rx).
    lubricant_parameter : float
        L = G (2U)^(1/4) [-], G = alpha E'.
    radius_ratio : float
        Rx/Ry [-].
    lubricant : Lubricant
        Its laws, pressure-viscosity coefficient and exponent set the scale of pressure; its
        viscosity is not used unless the exponent follows from Roelands' identity.
    entrainment_angle : float
        Direction of the entrainment, from x towards y [rad].
    """

    load_parameter: float
    lubricant_parameter: float
    lubricant: Lubricant
    radius_ratio: float = 1.0
    entrainment_angle: float = 0.0

    def __post_init__(self) -> None:
        for field in ("load_parameter", "radius_ratio"):
            value = getattr(self, field)
            if not (isfinite(value) and value > 0.0):
                raise ValueError(f"{field} must be positive and finite, got {value!r}")
        if not (isfinite(self.lubricant_parameter) and self.lubricant_parameter >= 0.0):
            raise ValueError(
                f"lubricant_parameter must be zero or positive, got {self.lubricant_parameter!r}"
            )
        if not isfinite(self.entrainment_angle):
            raise ValueError(f"entrainment_angle must be finite, got {self.entrainment_angle!r}")
