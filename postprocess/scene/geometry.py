"""Shapes of the pictures: patches placed on their balls, balls and grooved rings; NumPy only, SI,
bearing's frame.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import NDArray

from bearing.geometry import Bearing
from ehl.solution import Array

from ..contact.frame import within

WRAP_LIMIT = 1.35  # a patch reaches this far around its ball at most [rad]
SHOULDER_HEIGHT = 0.22  # of the ball diameter, for the pictures only
RING_WIDTH = 1.5  # of the ball diameter
RING_HEIGHT = 0.83  # where the catalogue gives none: for the pictures only
# of the ball diameter: balls and raceways stand back by this, so that the patches are seen
SET_BACK = 0.004


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactFrame:
    """Where a contact sits in the bearing's frame.

    Attributes
    ----------
    origin : ndarray, shape (3,)
        Contact point [m].
    axis_x, axis_y, normal : ndarray, shape (3,)
        Rolling direction, transverse direction, normal from the ball into the race [-];
        right-handed.
    ball_radius : float
        [m].
    """

    origin: Array
    axis_x: Array
    axis_y: Array
    normal: Array
    ball_radius: float

    @property
    def ball_centre(self) -> Array:
        """Centre of the ball, shape (3,) [m]."""
        return self.origin - self.ball_radius * self.normal


@dataclass(frozen=True, slots=True, kw_only=True)
class Surface:
    """A surface of quadrilaterals: points, shape (n, 3) [m], and corner numbers, shape (m, 4)."""

    points: Array
    quads: NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Placement:
    """How patches are drawn: true shape is magnification (1, 1) and exaggeration 0.

    Attributes
    ----------
    rolling, transverse : float
        Magnification of the patch along and across the rolling direction [-].
    film : float
        Film thickness is drawn as height over the ball this many times [-].
    """

    rolling: float = 1.0
    transverse: float = 1.0
    film: float = 0.0


def place_patch(
    x: Array, y: Array, frame: ContactFrame, placement: Placement, height: Array | None = None
) -> Array:
    """Lay a contact plane on the ball: distances and directions from the contact point are kept
    (exponential map).

    Parameters
    ----------
    x, y : ndarray, shape (nx, ny)
        Coordinates along the principal directions [m].
    frame : ContactFrame
    placement : Placement
        Magnification; the film's share of it is in `height` already.
    height : ndarray, shape (nx, ny), optional
        Height over the ball [m].

    Returns
    -------
    ndarray, shape (nx, ny, 3)
        Points in the bearing's frame [m].
    """
    u, v = placement.rolling * x, placement.transverse * y
    distance = np.hypot(u, v)
    turn = distance / frame.ball_radius
    shrink = np.sinc(turn / pi)  # sin(turn)/turn
    radius = frame.ball_radius if height is None else frame.ball_radius + height[..., None]
    direction = np.cos(turn)[..., None] * frame.normal + (shrink / frame.ball_radius)[
        ..., None
    ] * (u[..., None] * frame.axis_x + v[..., None] * frame.axis_y)
    return np.asarray(frame.ball_centre + radius * direction)


def crop_to_ball(
    x: Array, y: Array, ball_radius: float, placement: Placement
) -> tuple[slice, slice]:
    """Index ranges of the nodes that a patch may have without wrapping around its ball; x, y,
    ball_radius in [m].
    """
    reach = WRAP_LIMIT * ball_radius / np.sqrt(2.0)
    along, across = reach / placement.rolling, reach / placement.transverse
    return within(x, -along, along), within(y, -across, across)


def grid_quads(n: int, m: int, closed: bool = False) -> NDArray[np.int64]:
    """Corner numbers of the cells of an (n, m) grid of points, shape (cells, 4) [-]; closed joins
    the last row.
    """
    index = np.arange(n * m).reshape(n, m)
    if closed:
        index = np.vstack([index, index[:1]])
    corners = (index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:])
    return np.stack([c.ravel() for c in corners], axis=1)


def merge(surfaces: Sequence[Surface]) -> Surface:
    """One surface of several; points in [m] stay as they are."""
    offsets = np.cumsum([0] + [len(s.points) for s in surfaces[:-1]])
    quads = [s.quads + offset for s, offset in zip(surfaces, offsets, strict=True)]
    return Surface(
        points=np.concatenate([s.points for s in surfaces]), quads=np.concatenate(quads)
    )


def ball_surface(centre: Array, radius: float, rings: int = 24) -> Surface:
    """Sphere about `centre` [m], shape (3,), of `radius` [m], with its poles on the bearing's
    axis.
    """
    polar = np.linspace(0.0, pi, rings + 1)
    azimuth = np.linspace(0.0, 2.0 * pi, 2 * rings, endpoint=False)
    t, f = np.meshgrid(azimuth, polar, indexing="ij")
    points = np.stack([np.cos(f), np.sin(f) * np.cos(t), np.sin(f) * np.sin(t)], axis=-1)
    return Surface(
        points=centre + radius * points.reshape(-1, 3), quads=grid_quads(*t.shape, closed=True)
    )


def ring_surface(
    bearing: Bearing, inner: bool, axial: float, opening: tuple[float, float]
) -> Surface:
    """One ring as a solid of revolution with its groove, cut open over a sector.

    Parameters
    ----------
    bearing : Bearing
        Bore, outside diameter and width are used where given, otherwise guessed for the picture.
    inner : bool
        Inner or outer ring.
    axial : float
        Position of the groove's centre along the bearing's axis [m].
    opening : tuple of float
        Azimuth at the middle of the cut-away sector and its width [rad]; width 0 leaves the ring
        whole.

    Returns
    -------
    Surface
    """
    profile = groove_profile(bearing, inner)
    base = _base_radius(bearing, inner)
    middle, width = opening
    turn = np.linspace(0.5 * width, 2.0 * pi - 0.5 * width, 181) + middle
    x = profile[:, 0] + axial
    r = profile[:, 1]
    axis = np.eye(3)[0]
    radial = _radial(turn[0])
    tangential = _tangential(turn[0])
    up = np.sign(r[0] - base)
    parts = [
        _facing(_revolve(x, r, turn), up * radial),
        _facing(_revolve(x, np.full_like(r, base), turn), -up * radial),
        _facing(_revolve(x[[0, 0]], np.array([base, r[0]]), turn), -axis),
        _facing(_revolve(x[[-1, -1]], np.array([base, r[-1]]), turn), axis),
    ]
    if width > 0.0:
        parts.append(_facing(_cap(x, r, base, turn[0]), -tangential))
        parts.append(_facing(_cap(x, r, base, turn[-1]), _tangential(turn[-1])))
    return merge(parts)


def _radial(angle: float) -> Array:
    return np.array([0.0, np.cos(angle), np.sin(angle)])


def _tangential(angle: float) -> Array:
    return np.array([0.0, -np.sin(angle), np.cos(angle)])


def _facing(surface: Surface, outward: Array) -> Surface:
    """Turn the cells, all alike, so that the first one's normal points to the side of `outward`."""
    a, b, c, _ = surface.points[surface.quads[0]]
    if np.dot(np.cross(b - a, c - a), outward) >= 0.0:
        return surface
    return Surface(points=surface.points, quads=surface.quads[:, ::-1])


def groove_profile(bearing: Bearing, inner: bool, points: int = 48) -> Array:
    """Shoulder, groove, shoulder of one ring, shape (points + 2, 2): axial distance from the
    groove, radius [m].

    The groove is set back by `SET_BACK` ball diameters.
    """
    sign = 1.0 if inner else -1.0
    groove = bearing.inner_groove_radius if inner else bearing.outer_groove_radius
    centre = bearing.inner_centre_radius if inner else bearing.outer_centre_radius
    bottom = centre - sign * (groove + SET_BACK * bearing.ball_diameter)
    height = SHOULDER_HEIGHT * bearing.ball_diameter
    half = np.arccos(1.0 - height / groove)
    t = np.linspace(-half, half, points)
    arc = np.stack([groove * np.sin(t), bottom + sign * groove * (1.0 - np.cos(t))], axis=1)
    width = bearing.width if bearing.width is not None else RING_WIDTH * bearing.ball_diameter
    side = max(0.5 * width, arc[-1, 0] + 0.05 * bearing.ball_diameter)
    return np.vstack([[-side, arc[0, 1]], arc, [side, arc[-1, 1]]])


def _base_radius(bearing: Bearing, inner: bool) -> float:
    """Radius of the bore, or of the outside of the outer ring [m]."""
    given = bearing.bore if inner else bearing.outside_diameter
    if given is not None:
        return 0.5 * given
    sign = -1.0 if inner else 1.0
    return max(0.5 * bearing.pitch_diameter + sign * RING_HEIGHT * bearing.ball_diameter, 0.0)


def _revolve(x: Array, r: Array, turn: Array) -> Surface:
    points = np.stack(
        [
            np.broadcast_to(x, (turn.size, x.size)),
            np.outer(np.cos(turn), r),
            np.outer(np.sin(turn), r),
        ],
        axis=-1,
    )
    return Surface(points=points.reshape(-1, 3), quads=grid_quads(turn.size, x.size))


def _cap(x: Array, r: Array, base: float, angle: float) -> Surface:
    radius = np.stack([np.full_like(r, base), r])
    axial = np.broadcast_to(x, radius.shape)
    points = np.stack([axial, radius * np.cos(angle), radius * np.sin(angle)], axis=-1)
    return Surface(points=points.reshape(-1, 3), quads=grid_quads(2, x.size))
