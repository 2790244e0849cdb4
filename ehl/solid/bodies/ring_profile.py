"""Section of a grooved ring, what it sits on, and the image of its depth lines; numbers only."""

from dataclasses import dataclass
from enum import Enum
from math import acos, pi

import numpy as np

from ...arrays import Array


class Seat(Enum):
    """Support of a ring."""

    RIGID = "rigid"  # bonded to a rigid shaft or housing
    # bonded to an elastic body as wide as the ring: a shaft, whose volume carries the load evenly,
    # or a housing that is fixed on its outside
    ELASTIC = "elastic"
    # loose: the load enters over the seat as a radial pressure, proportional to the cosine from
    # its direction, and as an even axial traction
    FREE = "free"
    # on rigid contacts at some azimuths, which press radially and open where they would pull;
    # axial forces and moments as in a loose ring
    SPLIT = "split"


@dataclass(frozen=True, slots=True, kw_only=True)
class Elasticity:
    """Elastic constants of a ring and what it sits on."""

    young: float  # E of the ring [Pa]
    poisson: float  # nu [-]
    body_young: float = 0.0  # of shaft or housing [Pa]
    body_poisson: float = 0.0  # [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class RingProfile:
    """Section of a ring with a circular groove, symmetric [m].

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
        """Radius of the groove's centre of curvature from the axis [m]."""
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


def section_points(profile: RingProfile, s: Array, depth: Array) -> Array:
    """Position of points of the section: lines of depth from the track along its normal to the
    seat.

    Each is a cubic Bezier line, straight beyond the seat.

    Parameters
    ----------
    profile : RingProfile
        section of the ring
    s : Array
        arc lengths across the track, shape (n,) [m]
    depth : Array
        0 on the track, 1 on the seat, shape (n,) [-]

    Returns
    -------
    Array
        axial and radial position, shape (2, n) [m]
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
    """Position of track and lands.

    Parameters
    ----------
    profile : RingProfile
        section of the ring
    s : Array
        arc lengths from the bottom of the groove, shape (n,) [m]

    Returns
    -------
    Array
        axial and radial position, shape (2, n) [m]
    """
    angle = np.clip(s, -profile.edge, profile.edge) / profile.groove_radius
    x = profile.groove_radius * np.sin(angle) + s - angle * profile.groove_radius
    height = profile.side * profile.groove_radius * np.cos(angle)
    return np.stack([x, profile.centre_radius - height])


def track_angle(profile: RingProfile, s: Array) -> Array:
    """Angle of the normal from the radial direction: the contact angle in the groove.

    On the lands it turns the lines of depth back to the radial direction at the side faces.

    Parameters
    ----------
    profile : RingProfile
        section of the ring
    s : Array
        arc lengths from the bottom of the groove, shape (n,) [m]

    Returns
    -------
    Array
        angle, shape (n,) [rad]
    """
    land = profile.arc - profile.edge
    beyond = np.maximum(np.abs(s) - profile.edge, 0.0) / land
    angle = np.minimum(np.abs(s), profile.edge) / profile.groove_radius
    return np.asarray(np.sign(s) * angle * (1.0 - beyond) ** 2)
