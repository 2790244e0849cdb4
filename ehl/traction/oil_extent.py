"""How far the oil of a flooded contact reaches: the gap of two circles, and the meniscus in it.

The oil stands between the bodies up to where their gap is as wide as the layer that they carry
in. Near the contact that gap is a paraboloid with its deflection; farther out it is that of two
circles: in the plane of the normal and a ray body 1, a ball, is cut in a circle, and body 2 is
taken as the circle of its curvature there (Euler), which is exact in both principal planes.
"""

from typing import NamedTuple

import numpy as np

from ..arrays import Array
from ..multigrid.far_field import FarField
from ..scaling import ScaledContact

# share of a circle's radius from which on it is no parabola: its height is there 1.01 of it
PARABOLA_SHARE = 0.2
# fraction of the radius up to which a ray is followed: the circle ends, the slope of the gap is
# infinite
CIRCLE_END = 1.0 - 1e-9
HALVINGS = 40  # of the interval in which the meniscus of a ray lies: to 1e-12 of it


class Sections(NamedTuple):
    """Curvatures of both bodies in the plane of the normal and a ray, over 1/a [-]."""

    ball: Array  # of body 1
    race: Array  # of body 2, negative where it is concave

    def excess(self, r: Array, height_scale: float) -> Array:
        """Evaluate the gap of the two circles less that of their parabolas.

        Parameters
        ----------
        r : Array
            distance from the centre over a, at most `end`, any shape [-]
        height_scale : float
            Rx/a [-]

        Returns
        -------
        Array
            difference of the gaps in a^2/Rx [-]
        """
        return height_scale * (_excess(self.ball, r) + _excess(self.race, r))

    def gap(self, r: Array) -> Array:
        """Evaluate the gap of the two circles.

        Parameters
        ----------
        r : Array
            distance from the centre over a, at most `end`, any shape [-]

        Returns
        -------
        Array
            gap over a [-]
        """
        return _height(self.ball, r) + _height(self.race, r)

    @property
    def end(self) -> Array:
        """Distance over a at which the smaller circle ends [-]."""
        return np.asarray(CIRCLE_END / self.largest)

    @property
    def largest(self) -> Array:
        """Curvature of the smaller circle [-]."""
        return np.maximum(np.abs(self.ball), np.abs(self.race))


def _height(curvature: Array, r: Array) -> Array:
    """Height of a circle, signed as its curvature, over a [-]."""
    squared = np.minimum((curvature * r) ** 2, 1.0)
    return np.asarray(curvature * r**2 / (1.0 + np.sqrt(1.0 - squared)))


def _excess(curvature: Array, r: Array) -> Array:
    """Height of a circle less that of its parabola, signed as its curvature, over a [-]."""
    squared = np.minimum((curvature * r) ** 2, 1.0)
    root = np.sqrt(1.0 - squared)
    # c r^2/(1 + root) - c r^2/2, without the cancellation
    return np.asarray(0.5 * curvature * r**2 * squared / (1.0 + root) ** 2)


def sections(contact: ScaledContact, ball_radius: float | None, x: Array, y: Array) -> Sections:
    """Cut both bodies in planes of the normal and a ray.

    Parameters
    ----------
    contact : ScaledContact
        scaled contact of conditions with dimensions
    ball_radius : float | None
        radius of body 1; None: body 2 is a plane [m]
    x : Array
        component of the ray's unit vector along the grid, shape (n,) [-]
    y : Array
        component across it, shape (n,) [-]

    Returns
    -------
    Sections
        curvatures of both circles
    """
    a, scale = contact.semi_axis_x, contact.film_scale
    assert a is not None and scale is not None  # of conditions with dimensions
    both = ray_curvature(contact, x, y) * scale / a
    ball = both if ball_radius is None else np.full_like(both, a / ball_radius)
    return Sections(ball=ball, race=both - ball)


def ray_curvature(contact: ScaledContact | FarField, x: Array, y: Array) -> Array:
    """Evaluate the curvature of the gap along rays.

    Parameters
    ----------
    contact : ScaledContact | FarField
        scaled contact, or far field
    x : Array
        component of the ray's unit vector along the grid, any shape [-]
    y : Array
        component across it, of the same shape [-]

    Returns
    -------
    Array
        curvature in 1/Rx [-]
    """
    along = contact.curvature_x * x**2 + contact.curvature_y * y**2
    return np.asarray(along + 2.0 * contact.curvature_xy * x * y)
