"""Pressure of a flooded contact far from its centre: what an open box sees on its edge.

Cutting the box and setting P = 0 on its edge starves the contact, and the film error falls only
with the reciprocal of the box. Far out the deflection varies slowly, the oil is isoviscous, and
the gap is a paraboloid, for which Reynolds' equation without cavitation has Kapitza's (1955) exact
solution P = -(k_x X + k_y Y)/H^2, to which an entrainment that turns about the normal adds -k_xy X
Y/H^2. It is set on the edge where it is positive, and the load it carries outside the box is taken
from the load balance; the part of the rotation, odd in both directions, is left out of that.
"""

from dataclasses import dataclass
from math import cos, inf, isfinite, sin
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..grid import Grid
from ..scaling import ALIGNMENT_TOLERANCE, ScaledContact

Array = NDArray[np.float64]
DIRECTIONS = 720  # of the quadrature of the exterior load


@dataclass(frozen=True, slots=True, kw_only=True)
class FarField:
    """Coefficients of the far field [-]."""

    pressure_x: float  # k_x
    pressure_y: float  # k_y
    pressure_xy: float  # k_xy
    curvature_x: float  # S, T, C of the gap
    curvature_y: float
    curvature_xy: float

    def strength(self, X: Array, Y: Array) -> Array:
        """P H^2 = max(-(k_x X + k_y Y + k_xy X Y), 0) [-]."""
        along_y = (self.pressure_y + self.pressure_xy * X) * Y
        return np.maximum(-(self.pressure_x * X + along_y), 0.0)


def far_field(contact: ScaledContact) -> FarField:
    """Kapitza's (1955) solution for a contact's gap and entrainment.

    div(H^3 grad P) = lambda dH/dX' holds for P = -lambda X'/((3 + 2 D) H^2) with principal
    curvatures 1 and D; the entrainment along y has 1 and D exchanged, and both superpose. In the
    principal directions the rotation u = -Omega Y, v = Omega X has div(H^3 grad P) = lambda Omega
    (T - S) X Y, and P = -k_xy X Y/H^2 with k_xy = lambda Omega (T - S)/(3 (S + T)); in others that
    part is left out. All quantities [-].
    """
    c = cos(contact.frame_angle)
    s = sin(contact.frame_angle)
    d = contact.radius_ratio
    # entrainment along the principal directions
    u = c * contact.velocity_x - s * contact.velocity_y
    v = s * contact.velocity_x + c * contact.velocity_y
    along = u / (3.0 + 2.0 * d)
    across = v * d / (3.0 * d + 2.0)
    S, T = contact.curvature_x, contact.curvature_y
    rotation = contact.rotation if abs(contact.curvature_xy) < ALIGNMENT_TOLERANCE else 0.0
    return FarField(
        pressure_x=contact.speed * (c * along + s * across),
        pressure_y=contact.speed * (c * across - s * along),
        pressure_xy=contact.speed * rotation * (T - S) / (3.0 * (S + T)),
        curvature_x=contact.curvature_x,
        curvature_y=contact.curvature_y,
        curvature_xy=contact.curvature_xy,
    )


def edge_pressure(
    field: FarField, grid: Grid, H: Array, P: Array, layer: Array | None = None
) -> None:
    """Set P = max(-(k_x X + k_y Y + k_xy X Y)/H^2, 0) on the edge of the box, in place; zero where
    the gap is wider than a layer, shape (ny,).
    """
    X, Y = grid.X, grid.Y
    for row in (-1,) if grid.symmetric else (0, -1):
        P[row] = field.strength(X, Y[row]) / H[row] ** 2
        if layer is not None:
            P[row, H[row] > layer[row]] = 0.0
    for column in (0, -1):
        P[:, column] = field.strength(X[column], Y) / H[:, column] ** 2
        if layer is not None:
            P[H[:, column] > layer, column] = 0.0


def exterior_load(field: FarField, grid: Grid, H: Array, layer: float = inf) -> float:
    """Integral of the far field outside the box of a grid, from the film on its inlet edge, up to
    where the gap is as wide as a layer [-].
    """
    return load_outside(field, *_box_and_level(field, grid, H), layer)


def squeeze_load(field: FarField, grid: Grid, H: Array, layer: float = inf) -> float:
    """Integral of 1/H^2 outside the box of a grid where the far field carries pressure [-]: of the
    pressure that bodies parting or closing in set up in a paraboloid, integral from R of
    r/(h + q r^2/2)^2 dr = 1/(q (h + q R^2/2)) along each ray, up to where the gap is as wide as a
    layer.
    """
    box, level = _box_and_level(field, grid, H)
    rays = _rays(field, box)
    c = _distance(rays, level)
    outside = 2.0 / (rays.curvature**2 * (c + rays.radius**2))
    if isfinite(layer):  # from the layer's gap on
        outside = np.maximum(outside - 1.0 / (rays.curvature * layer), 0.0)
    return float(np.sum(outside[rays.strength > 0.0])) * 2.0 * np.pi / DIRECTIONS


def _box_and_level(
    field: FarField, grid: Grid, H: Array
) -> tuple[tuple[float, float, float], float]:
    """Box (x_in, x_out, y_half) of a grid, and the level of the gap seen on its inlet edge [-]."""
    origin = 0 if grid.symmetric else grid.ny // 2
    x_in = float(grid.X[0])
    level = float(H[origin, 0]) - 0.5 * field.curvature_x * x_in**2
    return (x_in, float(grid.X[-1]), float(grid.Y[-1])), level


def load_outside(
    field: FarField, box: tuple[float, float, float], level: float, layer: float = inf
) -> float:
    """Integral of the far field outside a box (x_in, x_out, y_half), up to where the gap is as
    wide as a layer [-].

    In polar coordinates the gap is h + q r^2/2 with the level h seen on the inlet edge (negative
    where the Hertz approach outweighs the deflection), and with c = 2h/q each ray carries integral
    from R of r^2/(h + q r^2/2)^2 dr = (4/q^2) [R/(2(R^2 + c)) + tail], tail = atan(sqrt(c)/R)/(2
    sqrt(c)).
    """
    # 1. rays from the origin to the edge of the box
    directions = _rays(field, box)
    strength, radius, q = directions
    # 2. gap h + q r^2/2 along each ray
    c = _distance(directions, level)
    # 3. integral along each ray, and over the angle
    rays = _outside(radius, c)
    if isfinite(layer):
        end = np.sqrt(np.maximum(2.0 * (layer - level) / q, 0.0))
        rays = np.where(end > radius, rays - _outside(np.maximum(end, radius), c), 0.0)
    return float(np.sum(strength * 4.0 / q**2 * rays)) * 2.0 * np.pi / DIRECTIONS


class _Rays(NamedTuple):
    """Rays from the origin over the angle, arrays of shape (n,) [-]."""

    strength: Array  # of the far field without rotation, over r
    radius: Array  # at the edge of the box
    curvature: Array  # q of the gap


def _rays(field: FarField, box: tuple[float, float, float]) -> _Rays:
    """Rays through the edge of a box (x_in, x_out, y_half)."""
    angle = (np.arange(DIRECTIONS) + 0.5) * 2.0 * np.pi / DIRECTIONS
    x, y = np.cos(angle), np.sin(angle)
    x_in, x_out, y_half = box
    with np.errstate(divide="ignore"):
        radius = np.minimum(np.where(x < 0.0, x_in / x, x_out / x), y_half / np.abs(y))
    along = field.curvature_x * x * x + field.curvature_y * y * y
    return _Rays(
        strength=np.maximum(-(field.pressure_x * x + field.pressure_y * y), 0.0),
        radius=radius,
        curvature=along + 2.0 * field.curvature_xy * x * y,
    )


def _distance(rays: _Rays, level: float) -> Array:
    """c = 2h/q of the gap h + q r^2/2 along each ray; far inside the Hertz gap the edge of the ray
    stays outside the contact [-].
    """
    return np.maximum(2.0 * level / rays.curvature, -0.9 * rays.radius**2)


def _outside(radius: Array, c: Array) -> Array:
    """Integral from a radius on of r^2/(r^2 + c)^2 dr [-]."""
    root = np.sqrt(np.maximum(np.abs(c), 1e-12))
    tail = np.where(
        c > 0.0, np.arctan(root / radius), np.arctanh(np.minimum(root / radius, 0.99))
    ) / (2.0 * root)
    return np.asarray(0.5 * radius / (radius**2 + c) + tail)
