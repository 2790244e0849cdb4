"""Pressure of a flooded contact far from its centre: what an open box sees on its edge.

Cutting the box and setting P = 0 on its edge starves the contact, and the film error falls only
with the reciprocal of the box. Far out the deflection varies slowly, the oil is isoviscous, and
the gap is a paraboloid, H = q(theta) r^2/2. There Reynolds' equation with his condition, P = 0 and
dP/dn = 0 where the oil breaks, has a solution P = s(theta) r/H^2 that is similar at all distances:
with g = (q/2)^3 and f = s/(q/2)^2

    (g f')' - 9 g f = lambda (u . grad H)/r,  f = f' = 0 where the oil breaks.

Without cavitation it is Kapitza's (1955), s = -(k_x cos + k_y sin), exact at any level of the gap;
with it s is little larger and reaches further back, by 18 degrees in a circle, and the load
outside grows by 5 % there, by 17 and 21 % for Rx/Ry 0.1 and 0.01. An entrainment that turns about
the normal adds Kapitza's -k_xy X Y/H^2. The sum is set on the edge where it is positive, and the
load it carries outside the box is taken from the load balance; the part of the rotation, odd in
both directions, is left out of that.
"""

from dataclasses import dataclass, replace
from functools import cache, lru_cache
from math import cos, inf, isfinite, sin
from typing import NamedTuple

import numpy as np
import scipy
from numpy.typing import NDArray

from ..arrays import Array
from ..grid import Grid
from ..scaling import ALIGNMENT_TOLERANCE, ScaledContact

# directions of the profile s and of the quadrature of the exterior load, and of the first search
# for the position at which the oil breaks begins
DIRECTIONS = 720
FIRST_DIRECTIONS = 45
MAX_PASSES = 100  # of that search on one set of directions
CACHED_PROFILES = 64  # profiles of the last contacts


@dataclass(frozen=True, slots=True, kw_only=True)
class FarField:
    """Coefficients of the far field [-]."""

    profile: Array  # s at `DIRECTIONS` angles, the first half a step from the x axis, shape (n,)
    pressure_x: float  # k_x, of Kapitza's solution
    pressure_y: float  # k_y
    pressure_xy: float  # k_xy
    curvature_x: float  # S, T, C of the gap
    curvature_y: float  # T [-]
    curvature_xy: float  # C, mixed [-]
    squeeze: float = 0.0  # P H^2 by bodies that close in, see `transient_far_field`

    def strength(self, X: Array, Y: Array) -> Array:
        """Evaluate P H^2 of the far field.

        s r without rotation; with it, or with bodies that approach with k_V, max(K - k_xy X Y +
        k_V, 0) + s r - max(K, 0), K that of Kapitza's solution.

        Parameters
        ----------
        X : Array
            position along the grid, any shape [-]
        Y : Array
            position across, of a shape that fits [-]

        Returns
        -------
        Array
            P H^2, of the common shape [-]
        """
        X, Y = np.broadcast_arrays(X, Y)
        straight = np.interp(
            np.arctan2(Y, X), _angles(DIRECTIONS), self.profile, period=2.0 * np.pi
        )
        straight = straight * np.hypot(X, Y)
        if self.pressure_xy == 0.0 and self.squeeze == 0.0:
            return np.asarray(straight)
        kapitza = -(self.pressure_x * X + self.pressure_y * Y)
        turning = np.maximum(kapitza - self.pressure_xy * X * Y + self.squeeze, 0.0)
        return np.asarray(turning + np.maximum(straight - np.maximum(kapitza, 0.0), 0.0))


def far_field(contact: ScaledContact) -> FarField:
    """Solve the far field of a contact's gap and entrainment, Kapitza (1955).

    div(H^3 grad P) = lambda dH/dX' holds for P = -lambda X'/((3 + 2 D) H^2) with principal
    curvatures 1 and D; the entrainment along y has 1 and D exchanged, and both superpose. In the
    principal directions the rotation u = -Omega Y, v = Omega X has div(H^3 grad P) = lambda Omega
    (T - S) X Y, and P = -k_xy X Y/H^2 with k_xy = lambda Omega (T - S)/(3 (S + T)); in other
    directions that term is left out.

    Parameters
    ----------
    contact : ScaledContact
        scaled contact

    Returns
    -------
    FarField
        far field of its gap [-]
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
    lengths = (contact.curvature_x, contact.curvature_y, contact.curvature_xy)
    return FarField(
        profile=_profile(_Wedge(*lengths, contact.velocity_x, contact.velocity_y, contact.speed)),
        pressure_x=contact.speed * (c * along + s * across),
        pressure_y=contact.speed * (c * across - s * along),
        pressure_xy=contact.speed * rotation * (T - S) / (3.0 * (S + T)),
        curvature_x=contact.curvature_x,
        curvature_y=contact.curvature_y,
        curvature_xy=contact.curvature_xy,
    )


def transient_far_field(
    field: FarField, contact: ScaledContact, speed: float, approach_rate: float
) -> FarField:
    """Scale a far field to an entrainment speed, and add the squeeze of bodies that part.

    div(H^3 grad P) = lambda dH0/dT holds for P = -lambda dH0/dT/(2 (S + T) H^2) in the gap of a
    paraboloid, in any directions; it is added to Kapitza's solution.

    Parameters
    ----------
    field : FarField
        far field at the speed u_m
    contact : ScaledContact
        scaled contact
    speed : float
        entrainment speed over u_m [-]
    approach_rate : float
        dH0/dT [-]

    Returns
    -------
    FarField
        far field at the time [-]
    """
    kappa = contact.speed / (2.0 * (contact.curvature_x + contact.curvature_y))
    return replace(
        field,
        profile=speed * field.profile,
        pressure_x=speed * field.pressure_x,
        pressure_y=speed * field.pressure_y,
        pressure_xy=speed * field.pressure_xy,
        squeeze=-kappa * approach_rate,
    )


@cache
def _angles(count: int) -> Array:
    """Middles of so many equal angles [rad], not to be written to."""
    angles = (np.arange(count) + 0.5) * 2.0 * np.pi / count
    angles.setflags(write=False)
    return np.asarray(angles)


@cache
def _directions(count: int) -> tuple[Array, Array]:
    """Cosine and sine of so many `_angles` [-], not to be written to."""
    directions = np.cos(_angles(count)), np.sin(_angles(count))
    for part in directions:
        part.setflags(write=False)
    return directions


class _Wedge(NamedTuple):
    """Numbers that the profile depends on, as in `ScaledContact`, all [-]."""

    curvature_x: float
    curvature_y: float
    curvature_xy: float
    velocity_x: float
    velocity_y: float
    speed: float


@lru_cache(CACHED_PROFILES)
def _profile(contact: _Wedge) -> Array:
    """s = f (q/2)^2 by Reynolds' condition, shape (DIRECTIONS,) [-], not to be written to: finite
    volumes over the angle, wet directions from half as many at a time. Kept, for a contact is
    solved on several boxes and meshes.
    """
    count = FIRST_DIRECTIONS
    wet = _source(contact, count) < 0.0
    while True:
        f, wet = _reynolds_condition(contact, wet)
        if count == DIRECTIONS:
            profile = f * (0.5 * _curvature(contact, _angles(count))) ** 2
            profile.setflags(write=False)
            return np.asarray(profile)
        count *= 2
        wet = np.repeat(wet, 2)


def _reynolds_condition(
    contact: _Wedge, wet: NDArray[np.bool_]
) -> tuple[Array, NDArray[np.bool_]]:
    """f over the angle, zero outside the wet directions and not negative in them, and those
    directions; to start from.
    """
    count = len(wet)
    step = 2.0 * np.pi / count
    source = _source(contact, count)
    # 1. downstream first, where the oil has broken: no neighbours across the ends
    first = int(np.argmax(source))
    angle = np.roll(_angles(count), -first)
    source = np.roll(source, -first)
    wet = np.roll(wet, -first)
    # 2. (g f')' - 9 g f
    g = (0.5 * _curvature(contact, angle)) ** 3
    after = (0.5 * _curvature(contact, angle + 0.5 * step)) ** 3 / step**2
    before = np.roll(after, 1)
    middle = -(before + after) - 9.0 * g
    f = np.zeros(count)
    for _ in range(MAX_PASSES):
        # 3. the equation in wet directions, f = 0 in others
        bands = np.ones((3, count))
        bands[0, 1:] = np.where(wet, after, 0.0)[:-1]
        bands[1] = np.where(wet, middle, 1.0)
        bands[2, :-1] = np.where(wet, before, 0.0)[1:]
        f = scipy.linalg.solve_banded((1, 1), bands, np.where(wet, source, 0.0))
        # 4. dry where f is negative, wet where oil flows into a direction without pressure
        flow = after * np.roll(f, -1) + before * np.roll(f, 1) - source
        turned = np.where(wet, f > 0.0, flow > 0.0)
        if (turned == wet).all():
            break
        wet = turned
    return np.roll(np.maximum(f, 0.0), first), np.roll(wet, first)


def _curvature(contact: _Wedge, angle: Array) -> Array:
    """q of the gap q r^2/2 [-]."""
    c, s = np.cos(angle), np.sin(angle)
    mixed = 2.0 * contact.curvature_xy * c * s
    return np.asarray(contact.curvature_x * c * c + contact.curvature_y * s * s + mixed)


def _source(contact: _Wedge, count: int) -> Array:
    """lambda (u . grad H)/r over so many angles [-]."""
    c, s = _directions(count)
    along = contact.velocity_x * (contact.curvature_x * c + contact.curvature_xy * s)
    across = contact.velocity_y * (contact.curvature_xy * c + contact.curvature_y * s)
    return np.asarray(contact.speed * (along + across))


@dataclass(frozen=True, slots=True, kw_only=True)
class EdgeField:
    """A far field on the edge of a grid's box, whatever the film: P H^2 [-]."""

    field: FarField  # far field that was evaluated
    rows: dict[int, Array]  # by the number of the row, shape (nx,)
    columns: dict[int, Array]  # by the number of the column, shape (ny,)


def edge_field(field: FarField, grid: Grid) -> EdgeField:
    """Evaluate a far field on the edge of a grid's box.

    Parameters
    ----------
    field : FarField
        far field
    grid : Grid
        grid of the box

    Returns
    -------
    EdgeField
        P H^2 on the edge [-]
    """
    X, Y = grid.X, grid.Y
    rows = (-1,) if grid.symmetric else (0, -1)
    return EdgeField(
        field=field,
        rows={row: field.strength(X, Y[row]) for row in rows},
        columns={column: field.strength(X[column], Y) for column in (0, -1)},
    )


def edge_pressure(
    edge: EdgeField, H: Array, P: Array, inlet_film_thickness: Array | None = None
) -> None:
    """Set the pressure of the far field on the edge of the box, in place.

    Parameters
    ----------
    edge : EdgeField
        far field on the edge
    H : Array
        film, shape (ny, nx) [-]
    P : Array
        pressure, shape (ny, nx), of which the edge is set [-]
    inlet_film_thickness : Array | None, optional
        shape (ny,); zero pressure where the gap is wider; None: flooded [-]
    """
    for row, strength in edge.rows.items():
        P[row] = strength / H[row] ** 2
        if inlet_film_thickness is not None:
            P[row, H[row] > inlet_film_thickness[row]] = 0.0
    for column, strength in edge.columns.items():
        P[:, column] = strength / H[:, column] ** 2
        if inlet_film_thickness is not None:
            P[H[:, column] > inlet_film_thickness, column] = 0.0


def exterior_load(
    field: FarField, grid: Grid, H: Array, inlet_film_thickness: float = inf
) -> float:
    """Integrate the far field outside the box of a grid, from the film on its inlet edge.

    Parameters
    ----------
    field : FarField
        far field
    grid : Grid
        grid of the box
    H : Array
        film, shape (ny, nx) [-]
    inlet_film_thickness : float, default inf
        gap up to which oil carries load; infinite: flooded [-]

    Returns
    -------
    float
        load outside the box [-]
    """
    load = load_outside(field, *_box_and_level(field, grid, H), inlet_film_thickness)
    if field.squeeze != 0.0:
        load += field.squeeze * squeeze_load(field, grid, H, inlet_film_thickness)
    return max(load, 0.0)  # bodies that part leave a cavity there


def deflection_outside(
    field: FarField, grid: Grid, H: Array, inlet_film_thickness: float = inf
) -> float:
    """Integrate P/r of the far field outside the box of a grid, for the deflection at the origin.

    Parameters
    ----------
    field : FarField
        far field
    grid : Grid
        grid of the box
    H : Array
        film, shape (ny, nx) [-]
    inlet_film_thickness : float, default inf
        gap up to which oil carries load; infinite: flooded [-]

    Returns
    -------
    float
        double integral of P/r at the origin [-]
    """
    box, level = _box_and_level(field, grid, H)
    rays = _rays(field, box)
    rings = _inverse_square(rays, level, inlet_film_thickness)
    return float(np.sum(rays.strength * rings)) * 2.0 * np.pi / DIRECTIONS


def squeeze_load(
    field: FarField, grid: Grid, H: Array, inlet_film_thickness: float = inf
) -> float:
    """Integrate 1/H^2 outside the box of a grid where the far field carries pressure.

    It is the load of the pressure that bodies parting or approaching set up in a paraboloid, all
    around without entrainment.

    Parameters
    ----------
    field : FarField
        far field
    grid : Grid
        grid of the box
    H : Array
        film, shape (ny, nx) [-]
    inlet_film_thickness : float, default inf
        gap up to which oil carries load; infinite: flooded [-]

    Returns
    -------
    float
        integral of 1/H^2 [-]
    """
    box, level = _box_and_level(field, grid, H)
    rays = _rays(field, box)
    rings = _inverse_square(rays, level, inlet_film_thickness)
    wet = rays.strength > 0.0
    if not rays.strength.any():
        wet[:] = True
    return float(np.sum(rings[wet])) * 2.0 * np.pi / DIRECTIONS


def _inverse_square(rays: "_Rays", level: float, inlet_film_thickness: float) -> Array:
    """Integral from R of r/(h + q r^2/2)^2 dr = 1/(q (h + q R^2/2)) along each ray, up to where
    the gap is as wide as a layer [-].
    """
    outside = 2.0 / (rays.curvature**2 * (_distance(rays, level) + rays.radius**2))
    if isfinite(inlet_film_thickness):  # from the layer's gap on
        outside = np.maximum(outside - 1.0 / (rays.curvature * inlet_film_thickness), 0.0)
    return np.asarray(outside)


def _box_and_level(
    field: FarField, grid: Grid, H: Array
) -> tuple[tuple[float, float, float], float]:
    """Box (x_in, x_out, y_half) of a grid, and the level of the gap seen on its inlet edge [-]."""
    origin = 0 if grid.symmetric else grid.ny // 2
    x_in = float(grid.X[0])
    level = float(H[origin, 0]) - 0.5 * field.curvature_x * x_in**2
    return (x_in, float(grid.X[-1]), float(grid.Y[-1])), level


def load_outside(
    field: FarField,
    box: tuple[float, float, float],
    level: float,
    inlet_film_thickness: float = inf,
) -> float:
    """Integrate the far field outside a box.

    In polar coordinates the gap is h + q r^2/2 with the level h seen on the inlet edge (negative
    where the Hertz approach outweighs the deflection), and with c = 2h/q each ray carries integral
    from R of r^2/(h + q r^2/2)^2 dr = (4/q^2) [R/(2(R^2 + c)) + tail], tail = atan(sqrt(c)/R)/(2
    sqrt(c)).

    Parameters
    ----------
    field : FarField
        far field
    box : tuple[float, float, float]
        x_in, x_out and y_half [-]
    level : float
        gap h at the origin that the inlet edge sees [-]
    inlet_film_thickness : float, default inf
        gap up to which oil carries load; infinite: flooded [-]

    Returns
    -------
    float
        load outside the box [-]
    """
    # 1. rays from the origin to the edge of the box
    directions = _rays(field, box)
    strength, radius, q = directions
    # 2. gap h + q r^2/2 along each ray
    c = _distance(directions, level)
    # 3. integral along each ray, and over the angle
    rays = _radial_integral(radius, c)
    if isfinite(inlet_film_thickness):
        end = np.sqrt(np.maximum(2.0 * (inlet_film_thickness - level) / q, 0.0))
        rays = np.where(end > radius, rays - _radial_integral(np.maximum(end, radius), c), 0.0)
    return float(np.sum(strength * 4.0 / q**2 * rays)) * 2.0 * np.pi / DIRECTIONS


class _Rays(NamedTuple):
    """Rays from the origin over the angle, arrays of shape (n,) [-]."""

    strength: Array  # of the far field without rotation, over r
    radius: Array  # at the edge of the box
    curvature: Array  # q of the gap


def _rays(field: FarField, box: tuple[float, float, float]) -> _Rays:
    """Rays through the edge of a box (x_in, x_out, y_half)."""
    x, y = _directions(DIRECTIONS)
    x_in, x_out, y_half = box
    with np.errstate(divide="ignore"):
        radius = np.minimum(np.where(x < 0.0, x_in / x, x_out / x), y_half / np.abs(y))
    along = field.curvature_x * x * x + field.curvature_y * y * y
    return _Rays(
        strength=field.profile, radius=radius, curvature=along + 2.0 * field.curvature_xy * x * y
    )


def _distance(rays: _Rays, level: float) -> Array:
    """c = 2h/q of the gap h + q r^2/2 along each ray; far inside the Hertz gap the edge of the ray
    stays outside the contact [-].
    """
    return np.maximum(2.0 * level / rays.curvature, -0.9 * rays.radius**2)


def _radial_integral(radius: Array, c: Array) -> Array:
    """Integral from a radius on of r^2/(r^2 + c)^2 dr [-]."""
    root = np.sqrt(np.maximum(np.abs(c), 1e-12))
    tail = np.where(
        c > 0.0, np.arctan(root / radius), np.arctanh(np.minimum(root / radius, 0.99))
    ) / (2.0 * root)
    return np.asarray(0.5 * radius / (radius**2 + c) + tail)
