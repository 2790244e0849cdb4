"""Shapes of the pictures: patches, balls, cage, rings, hexahedra; NumPy, SI, bearing's frame."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import pi
from typing import Any

import numpy as np
from numpy.typing import NDArray

from oilfilm.bearing.contacts.contact import BearingContact
from oilfilm.bearing.geometry import Bearing
from oilfilm.ehl.arrays import Array

from ..contact.shown_part import within

LENGTHS = (
    "ball_diameter pitch_diameter inner_groove_radius outer_groove_radius diametral_clearance "
    "bore outside_diameter width"
).split()
WRAP_LIMIT = 1.35  # a patch reaches this far around its ball at most [rad]
SHOULDER_HEIGHT = 0.22  # of the ball diameter, for the pictures only
RING_WIDTH = 1.5  # of the ball diameter
RING_HEIGHT = 0.83  # of the ball diameter, where the catalogue gives none: for the pictures only
# over the ball diameter [-]: balls and raceways stand back by this, so that patches are seen
SET_BACK = 0.004
# for the pictures only
RIM_WIDTH = 0.18  # of a cage's rims over the ball diameter [-]
BAR_SHARE = 0.5  # of a cage's bars in the gap between two pockets [-]
POCKET = 1.04  # diameter of a pocket over that of a ball [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactFrame:
    """Position and axes of a contact in the bearing's frame; the axes are right-handed."""

    origin: Array  # contact point, shape (3,) [m]
    axis_x: Array  # rolling direction [-]
    axis_y: Array  # transverse direction [-]
    normal: Array  # from the ball into the race [-]
    ball_radius: float  # [m]

    @property
    def ball_centre(self) -> Array:
        """Centre of the ball, shape (3,) [m]."""
        return self.origin - self.ball_radius * self.normal


def contact_frame(contact: BearingContact | Mapping[str, Any], ball_radius: float) -> ContactFrame:
    """Frame of a contact on its ball.

    Parameters
    ----------
    contact : BearingContact | Mapping[str, Any]
        Contact, or its attributes in a file.
    ball_radius : float
        Radius of the ball [m].

    Returns
    -------
    ContactFrame
        The frame.
    """
    names = ("origin", "axis_x", "axis_y", "normal")
    if isinstance(contact, BearingContact):
        contact = {name: getattr(contact, name) for name in names}
    vectors = {name: np.asarray(contact[name], dtype=np.float64) for name in names}
    return ContactFrame(ball_radius=ball_radius, **vectors)


@dataclass(frozen=True, slots=True, kw_only=True)
class Surface:
    """A surface of quadrilaterals: points, shape (n, 3) [m], and corner numbers, shape (m, 4)."""

    points: Array
    quads: NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True)
class RingShape:
    """Lengths from which one ring is drawn."""

    inner: bool
    ball_diameter: float  # [m]
    groove_radius: float  # [m]
    centre_radius: float  # of the circle of the groove's centres of curvature [m]
    base_radius: float  # of the bore, or of the outside of the outer ring [m]
    width: float  # [m]


@dataclass(frozen=True, slots=True, kw_only=True)
class Placement:
    """How patches are drawn: true shape is magnification (1, 1) and exaggeration 0."""

    rolling: float = 1.0  # magnification of the patch along the rolling direction [-]
    transverse: float = 1.0  # and across it [-]
    film: float = 0.0  # film thickness is drawn as height over the ball this many times [-]


def place_patch(
    x: Array, y: Array, frame: ContactFrame, placement: Placement, height: Array | None = None
) -> Array:
    """Points of a contact plane laid on its ball, in the bearing's frame.

    Distances and directions from the contact point are kept (exponential map).

    Parameters
    ----------
    x : Array
        Principal coordinate along, shape (nx, ny) [m].
    y : Array
        Principal coordinate across, shape (nx, ny) [m].
    frame : ContactFrame
        Frame of the contact.
    placement : Placement
        Magnification of patches and films.
    height : Array | None, optional
        Height over the ball, exaggerated already, shape (nx, ny) [m].

    Returns
    -------
    Array
        Points, shape (nx, ny, 3) [m].
    """
    u = (placement.rolling * x)[..., None]
    v = (placement.transverse * y)[..., None]
    turn = np.hypot(u, v) / frame.ball_radius
    shrink = np.sinc(turn / pi) / frame.ball_radius  # sin(turn)/distance
    radius = frame.ball_radius if height is None else frame.ball_radius + height[..., None]
    direction = np.cos(turn) * frame.normal + shrink * (u * frame.axis_x + v * frame.axis_y)
    return np.asarray(frame.ball_centre + radius * direction)


def crop_to_ball(
    x: Array, y: Array, ball_radius: float, placement: Placement
) -> tuple[slice, slice]:
    """Index ranges of the nodes of a patch that does not wrap around its ball.

    Parameters
    ----------
    x : Array
        Nodes along, shape (nx,) [m].
    y : Array
        Nodes across, shape (ny,) [m].
    ball_radius : float
        Radius of the ball [m].
    placement : Placement
        Magnification of patches and films.

    Returns
    -------
    tuple[slice, slice]
        Range along, and across.
    """
    reach = WRAP_LIMIT * ball_radius / np.sqrt(2.0)
    along = reach / placement.rolling
    across = reach / placement.transverse
    return within(x, -along, along), within(y, -across, across)


def grid_quads(n: int, m: int, closed: bool = False) -> NDArray[np.int64]:
    """Corners of the cells of a grid.

    Parameters
    ----------
    n : int
        Nodes along the first axis [-].
    m : int
        Nodes along the second axis [-].
    closed : bool, default False
        Join the last row to the first.

    Returns
    -------
    NDArray[np.int64]
        Corners, shape (cells, 4).
    """
    index = np.arange(n * m).reshape(n, m)
    if closed:
        index = np.vstack([index, index[:1]])
    corners = (index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:])
    return np.stack([c.ravel() for c in corners], axis=1)


def merge(surfaces: Sequence[Surface]) -> Surface:
    """One surface of several; points in [m] stay as they are.

    Parameters
    ----------
    surfaces : Sequence[Surface]
        Surfaces [m].

    Returns
    -------
    Surface
        The surface.
    """
    offsets = np.cumsum([0] + [len(s.points) for s in surfaces[:-1]])
    quads = [s.quads + offset for s, offset in zip(surfaces, offsets, strict=True)]
    return Surface(
        points=np.concatenate([s.points for s in surfaces]), quads=np.concatenate(quads)
    )


def ball_surface(centre: Array, radius: float, rings: int = 24) -> Surface:
    """Sphere with its poles on the bearing's axis.

    Parameters
    ----------
    centre : Array
        Centre, shape (3,) [m].
    radius : float
        Radius [m].
    rings : int, default 24
        Cells from pole to pole [-].

    Returns
    -------
    Surface
        The surface.
    """
    polar = np.linspace(0.0, pi, rings + 1)
    azimuth = np.linspace(0.0, 2.0 * pi, 2 * rings, endpoint=False)
    t, f = np.meshgrid(azimuth, polar, indexing="ij")
    points = np.stack([np.cos(f), np.sin(f) * np.cos(t), np.sin(f) * np.sin(t)], axis=-1)
    return Surface(
        points=centre + radius * points.reshape(-1, 3), quads=grid_quads(*t.shape, closed=True)
    )


def cage_surface(pitch: float, ball: float, balls: int) -> Surface:
    """A simplified cage in its own frame: two rims, and bars between balls.

    Parameters
    ----------
    pitch : float
        Pitch diameter [m].
    ball : float
        Ball diameter [m].
    balls : int
        Number of balls [-].

    Returns
    -------
    Surface
        The surface.
    """
    side = 0.5 * ball * (1.0 + RIM_WIDTH)
    half_rim = 0.5 * RIM_WIDTH * ball
    radius = np.full(2, 0.5 * pitch)
    turn = np.linspace(0.0, 2.0 * pi, 181)
    rim = np.array([-half_rim, half_rim])
    parts = [revolved(axial + rim, radius, turn) for axial in (-side, side)]
    half_bar = 0.5 * BAR_SHARE * (2.0 * pi / balls - 2.0 * np.arcsin(POCKET * ball / pitch))
    for k in range(balls):
        middle = 2.0 * pi * (k + 0.5) / balls
        bar = np.linspace(middle - half_bar, middle + half_bar, 5)
        parts.append(revolved(np.array([-side, side]), radius, bar))
    return merge(parts)


def bearing_lengths(bearing: Bearing) -> dict[str, float]:
    """The `LENGTHS` of a bearing that are known [m].

    Parameters
    ----------
    bearing : Bearing
        Bearing.

    Returns
    -------
    dict[str, float]
        Length by name [m].
    """
    lengths = {name: getattr(bearing, name) for name in LENGTHS}
    return {name: value for name, value in lengths.items() if value is not None}


def ring_shape(lengths: Mapping[str, Any], inner: bool) -> RingShape:
    """Shape of a ring from the lengths of a bearing.

    Parameters
    ----------
    lengths : Mapping[str, Any]
        `LENGTHS` of a bearing [m]; bore, outside diameter and width may be missing.
    inner : bool
        Inner ring, else the outer one.

    Returns
    -------
    RingShape
        The shape.
    """
    sign = 1.0 if inner else -1.0
    ball = float(lengths["ball_diameter"])
    pitch = float(lengths["pitch_diameter"])
    grooves = (float(lengths["inner_groove_radius"]), float(lengths["outer_groove_radius"]))
    groove = grooves[0] if inner else grooves[1]
    cosine = 1.0 - 0.5 * float(lengths["diametral_clearance"]) / (sum(grooves) - ball)
    guess = max(pitch - sign * 2.0 * RING_HEIGHT * ball, 0.0)
    return RingShape(
        inner=inner,
        ball_diameter=ball,
        groove_radius=groove,
        centre_radius=0.5 * pitch + sign * (groove - 0.5 * ball) * cosine,
        base_radius=0.5 * float(lengths.get("bore" if inner else "outside_diameter", guess)),
        width=float(lengths.get("width", RING_WIDTH * ball)),
    )


def ring_surface(
    shape: RingShape,
    axial: float,
    opening: tuple[float, float],
    resolution: tuple[int, int] = (48, 181),
) -> Surface:
    """One ring as a solid of revolution, cut open over a sector.

    Parameters
    ----------
    shape : RingShape
        Lengths of the ring.
    axial : float
        Axial position of its groove [m].
    opening : tuple[float, float]
        Azimuth at the middle of the cut-out sector, and its width [rad], 0 for a whole ring.
    resolution : tuple[int, int], default (48, 181)
        Points across the groove, and around the ring [-].

    Returns
    -------
    Surface
        The surface.
    """
    profile = groove_profile(shape, resolution[0])
    middle, width = opening
    turn = np.linspace(0.5 * width, 2.0 * pi - 0.5 * width, resolution[1]) + middle
    x = profile[:, 0] + axial
    r = profile[:, 1]
    base = np.full_like(r, shape.base_radius)
    axis = np.eye(3)[0]
    up = np.sign(r[0] - base[0]) * _radial(turn[0])
    parts = [
        _facing(revolved(x, r, turn), up),
        _facing(revolved(x, base, turn), -up),
        _facing(revolved(x[[0, 0]], np.array([base[0], r[0]]), turn), -axis),
        _facing(revolved(x[[-1, -1]], np.array([base[0], r[-1]]), turn), axis),
    ]
    if width > 0.0:
        parts.append(_facing(_cap(x, r, base, turn[0]), -_tangential(turn[0])))
        parts.append(_facing(_cap(x, r, base, turn[-1]), _tangential(turn[-1])))
    return merge(parts)


def groove_profile(shape: RingShape, points: int) -> Array:
    """Profile of shoulder, groove, shoulder.

    Parameters
    ----------
    shape : RingShape
        Lengths of the ring.
    points : int
        Points of the groove [-].

    Returns
    -------
    Array
        Axial distance from the groove and radius, shape (points + 2, 2) [m].
    """
    sign = 1.0 if shape.inner else -1.0
    groove = shape.groove_radius
    ball = shape.ball_diameter
    bottom = shape.centre_radius - sign * (groove + SET_BACK * ball)
    half = np.arccos(1.0 - SHOULDER_HEIGHT * ball / groove)
    t = np.linspace(-half, half, points)
    arc = np.stack([groove * np.sin(t), bottom + sign * groove * (1.0 - np.cos(t))], axis=1)
    side = max(0.5 * shape.width, arc[-1, 0] + 0.05 * ball)
    return np.vstack([[-side, arc[0, 1]], arc, [side, arc[-1, 1]]])


def rotation(quaternion: Array) -> Array:
    """Rotation matrix of a quaternion.

    Parameters
    ----------
    quaternion : Array
        W, x, y, z, shape (4,) [-].

    Returns
    -------
    Array
        Matrix, shape (3, 3) [-].
    """
    w, x, y, z = quaternion / np.linalg.norm(quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def about_axis(angle: float) -> Array:
    """Rotation matrix about the bearing's axis.

    Parameters
    ----------
    angle : float
        Angle [rad].

    Returns
    -------
    Array
        Matrix, shape (3, 3) [-].
    """
    return np.array([np.eye(3)[0], _radial(angle), _tangential(angle)]).T


def _radial(angle: float) -> Array:
    return np.array([0.0, np.cos(angle), np.sin(angle)])


def _tangential(angle: float) -> Array:
    return np.array([0.0, -np.sin(angle), np.cos(angle)])


def _facing(surface: Surface, outward: Array) -> Surface:
    """Turn the cells, of one orientation, so that the first normal points to `outward`."""
    a, b, c, _ = surface.points[surface.quads[0]]
    if np.dot(np.cross(b - a, c - a), outward) >= 0.0:
        return surface
    return Surface(points=surface.points, quads=surface.quads[:, ::-1])


def revolved(x: Array, r: Array, turn: Array) -> Surface:
    """Surface of revolution of a line about the axis.

    Parameters
    ----------
    x, r : Array
        Points of the line along the axis and from it, shape (n,) [m].
    turn : Array
        Azimuths, shape (m,) [rad].

    Returns
    -------
    Surface
        The surface, its points azimuth by azimuth.
    """
    axial = np.broadcast_to(x, (turn.size, x.size))
    points = np.stack([axial, np.outer(np.cos(turn), r), np.outer(np.sin(turn), r)], axis=-1)
    return Surface(points=points.reshape(-1, 3), quads=grid_quads(turn.size, x.size))


def _cap(x: Array, r: Array, base: Array, angle: float) -> Surface:
    radius = np.stack([base, r])
    axial = np.broadcast_to(x, radius.shape)
    points = np.stack([axial, radius * np.cos(angle), radius * np.sin(angle)], axis=-1)
    return Surface(points=points.reshape(-1, 3), quads=grid_quads(2, x.size))


def hexahedra(number: NDArray[np.int64]) -> NDArray[np.int64]:
    """Corners of the cells between the nodes of a grid.

    Parameters
    ----------
    number : NDArray[np.int64]
        Numbers of the nodes, shape (nx, ny, nz).

    Returns
    -------
    NDArray[np.int64]
        Corners, lower face first, shape (cells, 8).
    """
    low = slice(None, -1)
    high = slice(1, None)
    around = ((low, low), (high, low), (high, high), (low, high))
    corners = [number[(*place, depth)].ravel() for depth in (low, high) for place in around]
    return np.stack(corners, axis=1)
