r"""Velocities of two surfaces over their contact: rolling, sliding, spin, curvature slip.

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
from math import cos, inf, isfinite, sin

import numpy as np

from .arrays import Array
from .conditions import ContactConditions

MAY_BE_INFINITE = ("curvature_radius", "curvature_width")


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
