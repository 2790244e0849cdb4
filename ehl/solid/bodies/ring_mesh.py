"""Mesh of a grooved ring, alone or with its shaft or housing.

Nodes are images of (theta, s, t): angle around the axis from the load, arc length across the track
from the bottom of the groove, and depth, 0 on the surface of the track, 1 on the seat, 2 on the
far side of shaft or housing. Lines of depth start along the normal of the groove, so that the
depth below the contact is that in millimetres, and end radially on the seat. Coordinates are (x,
y, z), x along the axis, y towards the load.
"""

from dataclasses import dataclass
from math import acos, pi

import numpy as np

from ...arrays import Array
from .hexahedra import HexMesh, Nodes, hexahedra

DEPTH_GROWTH = 1.3  # of cells with the depth
ANGLE_GROWTH = 1.3  # and away from the load


@dataclass(frozen=True, slots=True, kw_only=True)
class RingProfile:
    """Section of a ring with a circular groove, alike on both sides [m].

    Raises
    ------
    ValueError
        If the groove does not fit in the ring; the message names the field.
    """

    groove_radius: float  # r [m]
    track_radius: float  # of the groove's bottom, from the axis [m]
    shoulder_radius: float  # of the lands, from the axis [m]
    seat_radius: float  # of bore or outside, from the axis [m]
    width: float  # [m]
    # inner radius of the shaft or outer radius of the housing; None: the ring alone [m]
    body_radius: float | None = None

    def __post_init__(self) -> None:
        wall = self.side * (self.track_radius - self.seat_radius)
        if not (wall > 0.0 and self.seat_radius > 0.0):
            raise ValueError("seat_radius must leave a wall under the groove")
        height = self.side * (self.shoulder_radius - self.track_radius)
        if not 0.0 < height < self.groove_radius:
            raise ValueError(
                f"shoulder_radius must lie between the bottom of the groove and its centre, is "
                f"{height:.6g} m above the bottom"
            )
        if not 2.0 * self.groove_radius * np.sin(self.edge_angle) < self.width:
            raise ValueError("width must exceed the groove's between its shoulders")
        beyond = self.body_radius
        if beyond is not None and not 0.0 < self.side * (self.seat_radius - beyond) < np.inf:
            raise ValueError("body_radius must lie beyond the seat")

    @property
    def side(self) -> float:
        """1 for an inner ring, whose track is its outside, -1 for an outer one [-]."""
        return 1.0 if self.seat_radius < self.track_radius else -1.0

    @property
    def wall(self) -> float:
        """Thickness under the groove [m]."""
        return abs(self.track_radius - self.seat_radius)

    @property
    def centre_radius(self) -> float:
        """Of the groove's centre of curvature from the axis [m]."""
        return self.track_radius + self.side * self.groove_radius

    @property
    def edge_angle(self) -> float:
        """Contact angle at the shoulder [rad]."""
        height = self.side * (self.shoulder_radius - self.track_radius)
        return acos(1.0 - height / self.groove_radius)

    @property
    def edge(self) -> float:
        """Arc length from the bottom of the groove to its edge [m]."""
        return self.groove_radius * self.edge_angle

    @property
    def arc(self) -> float:
        """Arc length from the bottom of the groove to the side face [m]."""
        land = 0.5 * self.width - self.groove_radius * float(np.sin(self.edge_angle))
        return self.edge + land


@dataclass(frozen=True, slots=True, kw_only=True)
class RingCells:
    """Sizes of the quadratic cells of a ring."""

    groove: int = 8  # across the groove, between its edges; even [-]
    land: int = 1  # on each land [-]
    aspect: float = 1.0  # length of the cells at the load along the track over that across [-]
    largest_angle: float = pi / 24.0  # of the cells away from the load [rad]


@dataclass(frozen=True, slots=True, kw_only=True)
class RingMesh:
    """Half a ring, or a sector of it, from the load at theta = 0."""

    profile: RingProfile
    body: HexMesh  # parameters theta [rad], s [m], depth [-]
    angle: float  # of the sector [rad]

    @property
    def track(self) -> Nodes:
        """Nodes on groove and lands, shape (n,)."""
        return self.body.on(2, 0.0)

    @property
    def seat(self) -> Nodes:
        """Nodes on the seat of the ring, shape (n,)."""
        return self.body.on(2, 1.0)

    @property
    def far_side(self) -> Nodes:
        """Nodes on the far side of shaft or housing, of the ring where it is alone, shape (n,)."""
        return self.body.on(2, float(self.body.parameters[2].max()))

    @property
    def symmetric(self) -> Nodes:
        """Nodes on the planes of symmetry at both ends, shape (n,)."""
        return self.body.on(0, 0.0) | self.body.on(0, self.angle)

    @property
    def is_ring(self) -> Nodes:
        """Cells of the ring, not of its shaft or housing, shape (cells,)."""
        return np.asarray(self.body.cell_parameters[2] < 1.0)


def ring_mesh(
    profile: RingProfile, cells: RingCells | None = None, angle: float = pi, uniform: int = 0
) -> RingMesh:
    """Mesh of a ring from theta = 0 to `angle` [rad]; cells grow away from the load at theta = 0,
    or there are `uniform` equal ones.
    """
    cells = cells or RingCells()
    across = _across(profile, cells)
    size = 2.0 * profile.edge / cells.groove
    along = (
        np.linspace(0.0, angle, uniform + 1)
        if uniform
        else _graded(
            angle, cells.aspect * size / profile.track_radius, ANGLE_GROWTH, cells.largest_angle
        )
    )
    depth = _graded(1.0, min(size / profile.wall, 1.0 / 3.0), DEPTH_GROWTH, 1.0)
    if profile.body_radius is not None:
        thickness = abs(profile.seat_radius - profile.body_radius)
        first = profile.wall * (depth[-1] - depth[-2]) / thickness
        beyond = _graded(1.0, first, DEPTH_GROWTH, 1.0)
        depth = np.concatenate((depth, 1.0 + beyond[1:]))

    def place(parameters: Array) -> Array:
        theta, s, t = parameters
        x, r = section_points(profile, s, t)
        return np.stack([x, r * np.cos(theta), r * np.sin(theta)])

    return RingMesh(profile=profile, body=hexahedra((along, across, depth), place), angle=angle)


def section_points(profile: RingProfile, s: Array, depth: Array) -> Array:
    """Axial and radial position of points of the section, shape (2, n) [m]: a cubic Bezier line
    from the track along its normal to the seat, then straight; depth [-], 1 at the seat.
    """
    surface = track_points(profile, s)
    angle = track_angle(profile, s)
    seat = np.stack([0.5 * profile.width * s / profile.arc, np.full_like(s, profile.seat_radius)])
    handle = profile.wall / 3.0
    start = surface + handle * np.stack([np.sin(angle), -profile.side * np.cos(angle)])
    end = seat + np.array([[0.0], [profile.side * handle]])
    t = np.minimum(depth, 1.0)
    ring = (1 - t) ** 3 * surface + 3 * t * (1 - t) ** 2 * start + 3 * t**2 * (1 - t) * end
    points = ring + t**3 * seat
    if profile.body_radius is not None:
        points[1] += np.maximum(depth - 1.0, 0.0) * (profile.body_radius - profile.seat_radius)
    return np.asarray(points)


def track_points(profile: RingProfile, s: Array) -> Array:
    """Axial and radial position of track and lands at arc lengths [m], shape (2, n) [m]."""
    angle = np.clip(s, -profile.edge, profile.edge) / profile.groove_radius
    x = profile.groove_radius * np.sin(angle) + s - angle * profile.groove_radius
    height = profile.side * profile.groove_radius * np.cos(angle)
    return np.stack([x, profile.centre_radius - height])


def track_angle(profile: RingProfile, s: Array) -> Array:
    """Angle of the normal from the radial direction [rad]: the contact angle in the groove; on the
    lands what turns the lines of depth back to the radial direction at the side faces.
    """
    land = profile.arc - profile.edge
    beyond = np.maximum(np.abs(s) - profile.edge, 0.0) / land
    angle = np.minimum(np.abs(s), profile.edge) / profile.groove_radius
    return np.asarray(np.sign(s) * angle * (1.0 - beyond) ** 2)


def _across(profile: RingProfile, cells: RingCells) -> Array:
    """Lines across the track: even in the groove, a line on each edge."""
    groove = np.linspace(-profile.edge, profile.edge, 2 * (cells.groove // 2) + 1)
    land = np.linspace(profile.edge, profile.arc, cells.land + 1)[1:]
    return np.concatenate((-land[::-1], groove, land))


def _graded(length: float, first: float, growth: float, largest: float) -> Array:
    """Lines from 0 to `length`, cells growing from `first` to at most `largest`."""
    sizes = [min(first, largest)]
    while sum(sizes) < length:
        sizes.append(min(sizes[-1] * growth, largest))
    lines = np.concatenate(([0.0], np.cumsum(sizes)))
    return np.asarray(lines * (length / lines[-1]))
