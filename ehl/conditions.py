r"""Operating conditions of one lubricated contact, and the velocities of its surfaces: rolling,
sliding, spin, curvature slip.

Body 1 lies below the film, body 2 above; n points from 1 into 2, x along the entrainment and y
across, x cross y = n. Both bodies turn as rigid ones about the contact's centre, where they have
the velocities u_1, u_2. The loaded surface is curved across the rolling direction, :math:`z =
-y^2/(2R)`, so that points off the centre line run on another radius (Heathcote, 1921; Harris and
Kotzalas, Advanced Concepts of Bearing Technology, re-derived). With the angular velocity of body 1
relative to body 2, omega (about y) and Omega (about n), body 1 slides over body 2 at

.. math::
    s_x = S_x - \Omega y - \omega y^2/(2R), \qquad s_y = S_y + \Omega x .

Off the ellipse the surfaces separate and the radius is that of neither; a flooded gap sheared by
y^2 there would drag in proportion to the area of the box. So y^2 does not grow beyond the
ellipse's width (`curvature_width`).

The velocity of rolling along n closes and opens the gap and is no sliding.
"""

from dataclasses import dataclass, fields
from math import atan2, cos, hypot, inf, isfinite, sin
from typing import NamedTuple

import numpy as np

from .arrays import Array
from .oil.lubricant import InletLayer, Lubricant
from .options import require_finite, require_not_negative, require_positive

# share of the faster surface's speed: a mean velocity below it entrains no oil that a film could
# be solved for
SMALLEST_ENTRAINMENT = 1e-6

MAY_BE_INFINITE = ("curvature_radius", "curvature_width")


@dataclass(frozen=True, slots=True, kw_only=True)
class Coating:
    """Coating of one body; the contact's E' is that of the coating against the other body."""

    thickness: float  # t [m]
    youngs_modulus: float  # [Pa]
    poisson_ratio: float  # [-]
    substrate_youngs_modulus: float  # [Pa]; a thousand times the coating's is a rigid substrate
    substrate_poisson_ratio: float  # [-]

    def __post_init__(self) -> None:
        for field in ("thickness", "youngs_modulus", "substrate_youngs_modulus"):
            require_positive({f"coating {field}": getattr(self, field)})
        for field in ("poisson_ratio", "substrate_poisson_ratio"):
            value = getattr(self, field)
            if not 0.0 <= value < 0.49:
                raise ValueError(f"coating {field} must lie in [0, 0.49), got {value!r}")


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactConditions:
    """One lubricated elliptical point contact, SI; x, y principal directions, body 1 the ball.

    Examples
    --------
    >>> from oilfilm import ContactConditions, Lubricant
    >>> oil = Lubricant(viscosity=0.04, pressure_viscosity=22e-9)
    >>> contact = ContactConditions(load=50.0, radius_x=6e-3, radius_y=60e-3,
    ...     reduced_modulus=2.3e11, entrainment_speed=5.0, slide_roll_ratio=0.02, lubricant=oil)
    >>> round(contact.speed_1, 3), round(contact.speed_2, 3)
    (5.05, 4.95)
    """

    load: float  # w, normal [N]
    radius_x: float  # reduced radius of curvature in x [m]
    radius_y: float  # and in y [m]
    reduced_modulus: float  # E' [Pa], 2/E' = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2
    entrainment_speed: float  # mean surface speed u_m = (u_1 + u_2)/2 [m/s]
    lubricant: Lubricant
    entrainment_angle: float = 0.0  # direction of the entrainment, from x towards y [rad]
    slide_roll_ratio: float = 0.0  # (u_1 - u_2)/u_m along the entrainment [-]
    # (v_1 - v_2)/u_m, v the surface speeds at right angles to the entrainment, from x towards y;
    # their mean is zero by the definition of the entrainment's direction [-]
    lateral_slide_ratio: float = 0.0
    # angular velocity of body 1 relative to body 2 about the normal into body 2, x cross y [rad/s]
    spin: float = 0.0
    # (omega_1 + omega_2)/2 about the same normal, the rotation of the entrainment over the contact
    # [rad/s]; None: body 2 does not turn, and it is half the spin
    mean_spin: float | None = None
    # coating of one of the bodies; E' and all groups and scales are then those of the uncoated
    # half spaces, one of them of the coating's material
    coating: Coating | None = None
    # radius of body 1, a ball, for the gap far from the contact [m]; None: body 2 counts as a
    # plane
    ball_radius: float | None = None
    inlet_layer: InletLayer | None = None  # lengths in [m]; None: flooded

    def __post_init__(self) -> None:
        if self.ball_radius is not None:
            require_positive(self, "ball_radius")
        lengths = ("load", "radius_x", "radius_y", "reduced_modulus", "entrainment_speed")
        require_positive(self, *lengths)
        ratios = ("slide_roll_ratio", "lateral_slide_ratio")
        require_finite(self, "entrainment_angle", *ratios, "spin", "rotation")

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


class SurfaceMotion(NamedTuple):
    """Two surface velocities as mean and difference, by the names of `ContactConditions`."""

    entrainment_speed: float  # [m/s]
    entrainment_angle: float  # from x towards y [rad]
    slide_roll_ratio: float  # along the entrainment [-]
    lateral_slide_ratio: float  # at right angles to it [-]


def surface_motion(
    velocity_1: tuple[float, float], velocity_2: tuple[float, float]
) -> SurfaceMotion:
    """Entrainment and sliding of two surface velocities.

    Parameters
    ----------
    velocity_1 : tuple[float, float]
        of body 1 in x and y [m/s]
    velocity_2 : tuple[float, float]
        of body 2 in x and y [m/s]

    Returns
    -------
    SurfaceMotion
        mean and difference by the names of `ContactConditions`

    Raises
    ------
    ValueError
        if the velocities are opposite and equal: their mean entrains nothing
    """
    (u_1, v_1), (u_2, v_2) = velocity_1, velocity_2
    mean = (0.5 * (u_1 + u_2), 0.5 * (v_1 + v_2))
    speed = hypot(*mean)
    if not speed > SMALLEST_ENTRAINMENT * max(hypot(u_1, v_1), hypot(u_2, v_2)):
        raise ValueError("velocities are opposite and equal: no oil is entrained")
    angle = atan2(mean[1], mean[0])
    slide = (u_1 - u_2, v_1 - v_2)
    return SurfaceMotion(
        entrainment_speed=speed,
        entrainment_angle=angle,
        slide_roll_ratio=(slide[0] * cos(angle) + slide[1] * sin(angle)) / speed,
        lateral_slide_ratio=(slide[1] * cos(angle) - slide[0] * sin(angle)) / speed,
    )


def speed_load_material(conditions: ContactConditions) -> tuple[float, float, float]:
    """U = eta_0 u_m/(E' Rx), W = F/(E' Rx^2) and G = alpha E', Hamrock and Dowson (1977).

    Parameters
    ----------
    conditions : ContactConditions
        the contact, in SI

    Returns
    -------
    speed
        U [-]
    load
        W [-]
    material
        G, zero for an isoviscous oil, whatever its coefficient [-]
    """
    c = conditions
    oil = conditions.lubricant
    speed = oil.viscosity * c.entrainment_speed / (c.reduced_modulus * c.radius_x)
    return (
        speed,
        c.load / (c.reduced_modulus * c.radius_x**2),
        oil.pressure_viscosity * c.reduced_modulus if oil.piezoviscous else 0.0,
    )


def moes_groups(conditions: ContactConditions) -> tuple[float, float]:
    """M = W (2U)^(-3/4) and L = G (2U)^(1/4), Moes (1992).

    Parameters
    ----------
    conditions : ContactConditions
        the contact, in SI

    Returns
    -------
    load_parameter
        M [-]
    lubricant_parameter
        L [-]
    """
    speed, load, material = speed_load_material(conditions)
    return load * (2.0 * speed) ** -0.75, material * (2.0 * speed) ** 0.25


@dataclass(frozen=True, slots=True, kw_only=True)
class MoesConditions:
    """One contact by its dimensionless groups, Moes (1992).

    Examples
    --------
    >>> from oilfilm import Lubricant, MoesConditions
    >>> oil = Lubricant(viscosity=0.04, pressure_viscosity=22e-9)
    >>> contact = MoesConditions(load_parameter=200.0, lubricant_parameter=10.0, lubricant=oil)
    >>> contact.radius_ratio
    1.0
    """

    load_parameter: float  # M = W (2U)^(-3/4), W = F/(E' Rx^2), U = eta_0 u_m/(E' Rx) [-]
    lubricant_parameter: float  # L = G (2U)^(1/4), G = alpha E' [-]
    # laws, pressure-viscosity coefficient and exponent set the scale of pressure; the viscosity is
    # not used unless the exponent follows from Roelands' identity
    lubricant: Lubricant
    radius_ratio: float = 1.0  # Rx/Ry [-]
    entrainment_angle: float = 0.0  # direction of the entrainment, from x towards y [rad]
    # thickness in units of a^2/Rx, positions of a, the Hertz semi-axis along x [-]; None: flooded
    inlet_layer: InletLayer | None = None

    def __post_init__(self) -> None:
        require_positive(self, "load_parameter", "radius_ratio")
        require_not_negative(self, "lubricant_parameter")
        require_finite(self, "entrainment_angle")


def curvature_height(curvature: Array | float, width: Array | float, y: Array) -> Array:
    """Height -y^2/(2R) of a curved surface, constant beyond its width.

    Parameters
    ----------
    curvature : Array | float
        1/(2R), a number or an array [1/m]
    width : Array | float
        half the width over which the surface is curved so [m]
    y : Array
        distances from the middle, any shape [m]

    Returns
    -------
    Array
        height, the common shape of the inputs [m]
    """
    return np.asarray(-curvature * np.minimum(y * y, np.square(width)))


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactKinematics:
    """Motion of the two surfaces of a contact, SI; body 1 is the ball, n points into body 2.

    Every value is finite; curvature_radius and curvature_width may be infinite, not zero.
    """

    entrainment_speed: float  # mean surface speed along x at the centre [m/s]
    # velocity of body 1 less that of body 2 at the centre, along and across the entrainment
    sliding_x: float = 0.0  # S_x [m/s]
    sliding_y: float = 0.0  # S_y [m/s]
    spin: float = 0.0  # angular speed of body 1 relative to body 2 about n [rad/s]
    # and about y; positive where rolling moves oil along x, then u_m/R_x but for sliding [rad/s]
    rolling: float = 0.0
    # R of the loaded surface in the plane of y and n, positive if body 1 is the convex one;
    # infinite: no curvature slip [m]
    curvature_radius: float = inf
    # half the width over which it is curved like that, the transverse semi-axis; beyond it
    # curvature slip does not grow [m]
    curvature_width: float = inf
    # half the sum of the angular speeds of both bodies about n and y
    mean_spin: float = 0.0  # [rad/s]
    mean_rolling: float = 0.0  # [rad/s]
    # mean surface speed along y, where the grid does not follow the entrainment [m/s]
    entrainment_lateral: float = 0.0
    # 1/R_2x - 1/R_1x of the bodies' curvatures along x: it divides the horizontal force of the
    # pressure between them; zero: equally [1/m]
    curvature_difference: float = 0.0

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            if not isfinite(value) and not (field.name in MAY_BE_INFINITE and value == inf):
                raise ValueError(f"{field.name} must be finite, got {value!r}")
        if self.curvature_radius == 0.0:
            raise ValueError("curvature_radius must not be zero")
        if not self.curvature_width > 0.0:
            raise ValueError(f"curvature_width must be positive, got {self.curvature_width!r}")

    @property
    def curvature(self) -> float:
        """1/(2 R) of the loaded surface across the entrainment [1/m]."""
        return 0.5 / self.curvature_radius

    def curvature_height(self, y: Array) -> Array:
        """Height -y^2/(2R) of the loaded surface, constant beyond its rim.

        Parameters
        ----------
        y : Array
            distances across the entrainment, any shape [m]

        Returns
        -------
        Array
            height, shape of `y` [m]
        """
        return curvature_height(self.curvature, self.curvature_width, y)

    def sliding(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Velocity of body 1 relative to body 2.

        Parameters
        ----------
        x : Array
            positions along the grid's x, any shape [m]
        y : Array
            positions along the grid's y, a shape that broadcasts with `x` [m]

        Returns
        -------
        along
            component along x, the common shape [m/s]
        across
            component along y, the common shape [m/s]
        """
        s_x = self.sliding_x - self.spin * y + self.rolling * self.curvature_height(y) + 0.0 * x
        return s_x, self.sliding_y + self.spin * x + 0.0 * y

    def entrainment(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Mean velocity of both surfaces.

        Parameters
        ----------
        x : Array
            positions along the grid's x, any shape [m]
        y : Array
            positions along the grid's y, a shape that broadcasts with `x` [m]

        Returns
        -------
        along
            component along x, the common shape [m/s]
        across
            component along y, the common shape [m/s]
        """
        u = (
            self.entrainment_speed
            - self.mean_spin * y
            + self.mean_rolling * self.curvature_height(y)
            + 0.0 * x
        )
        return u, self.entrainment_lateral + self.mean_spin * x + 0.0 * y


def contact_kinematics(
    conditions: ContactConditions,
    *,
    curvature_radius: float = inf,
    curvature_width: float = inf,
    grid_angle: float | None = None,
) -> ContactKinematics:
    """Motion that the conditions of a contact describe, in the frame of the grid of its film.

    Rolling is u_m/R_x, with R_x in the direction of the entrainment.

    Parameters
    ----------
    conditions : ContactConditions
        the contact, in SI
    curvature_radius : float, default inf
        R of the loaded surface across the entrainment; infinite without curvature slip [m]
    curvature_width : float, default inf
        half the width over which it is curved so [m]
    grid_angle : float | None, optional
        direction of the grid's x from the principal direction x, `frame_angle` of a solution;
        None: that of the entrainment [rad]

    Returns
    -------
    ContactKinematics
        velocities at the centre and their slopes
    """
    c = conditions
    turn = 0.0 if grid_angle is None else c.entrainment_angle - grid_angle
    along = c.slide_roll_ratio * c.entrainment_speed
    across = c.lateral_slide_ratio * c.entrainment_speed
    angle = c.entrainment_angle
    curvature = cos(angle) ** 2 / c.radius_x + sin(angle) ** 2 / c.radius_y
    return ContactKinematics(
        entrainment_speed=c.entrainment_speed * cos(turn),
        entrainment_lateral=c.entrainment_speed * sin(turn),
        sliding_x=along * cos(turn) - across * sin(turn),
        sliding_y=along * sin(turn) + across * cos(turn),
        spin=c.spin,
        mean_spin=c.rotation,
        rolling=c.entrainment_speed * curvature,
        curvature_radius=curvature_radius,
        curvature_width=curvature_width,
    )
