"""Mesh of a grooved ring, alone or with its shaft or housing.

Nodes are images of (theta, s, t): angle around the axis from the load, arc length across the track
from the bottom of the groove, and depth, 0 on the surface of the track, 1 on the seat, 2 on the
far side of shaft or housing. Lines of depth start along the normal of the groove, so that the
depth below the contact is that in millimetres, and end radially on the seat. Coordinates are (x,
y, z), x along the axis, y towards the load.
"""

from dataclasses import dataclass
from math import pi

import numpy as np

from ...arrays import Array
from .elasticity import HexMesh, Nodes, hexahedra
from .ring_profile import RingCells, RingProfile, section_points

DEPTH_GROWTH = 1.3  # of cells with the depth
ANGLE_GROWTH = 1.3  # and away from the load
BODY_GROWTH = 1.8  # and into shaft or housing


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
    """Mesh of a ring from theta = 0; cells grow away from the load there.

    Parameters
    ----------
    profile : RingProfile
        section of the ring
    cells : RingCells | None, optional
        sizes of the cells; None: the defaults
    angle : float, default pi
        end of the mesh [rad]
    uniform : int, default 0
        number of equal cells around; 0: growing cells

    Returns
    -------
    RingMesh
        the mesh
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
        beyond = _graded(1.0, first, BODY_GROWTH, 1.0)
        depth = np.concatenate((depth, 1.0 + beyond[1:]))

    def mapping(parameters: Array) -> Array:
        theta, s, t = parameters
        x, r = section_points(profile, s, t)
        return np.stack([x, r * np.cos(theta), r * np.sin(theta)])

    return RingMesh(profile=profile, body=hexahedra((along, across, depth), mapping), angle=angle)


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
