r"""Heat conductances of a ring between its track, its other surfaces and its seat.

.. math:: \int k\, \nabla T \cdot \nabla v\, dV = \int q\, v\, dA, \qquad T = 0 \text{ on the seat}

on the section of the ring, as a thin sector of the same mesh: for a ring that turns under
circulating balls heat enters its track evenly around. A unit of heat, spread evenly over one
surface at a time, yields the mean temperatures of all, a symmetric matrix of resistances R. Its
inverse is that of the network: minus its entries are the conductances between two surfaces, the
sums of its rows those to the seat.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import pi

import numpy as np
from scipy import sparse

from ...arrays import Array
from .elasticity import HexMesh, Nodes, block_matrix, gradient_products, solve_symmetric
from .ring_mesh import RingMesh, ring_mesh
from .ring_profile import RingCells, RingProfile, section_points, track_points

SURFACES = (
    "track",
    "land",
    "side",
)  # band of the track, rest of groove and lands, both side faces
# halved cells change the conductance of track and seat of a 6208 inner ring by 1e-3
CELLS = RingCells(groove=24, land=4)
SECTOR = 0.05  # [rad]
TOLERANCE = 1e-10  # relative residual of the temperatures [-]
STEP = 1e-6  # of the depth, for the slope of the side faces [-]


@dataclass(frozen=True, slots=True)
class RingConductances:
    """Conduction between the surfaces of a ring, in the order of `SURFACES`, and its seat."""

    resistance: Array  # mean temperature of each per heat into each, seat at zero, (3, 3) [K/W]

    @property
    def between(self) -> Array:
        """Conductance between two surfaces, shape (3, 3), zero on the diagonal [W/K].

        Entries below zero belong to a network that has the right temperatures and heats, not to
        three bodies.
        """
        network = -np.linalg.inv(self.resistance)
        return np.asarray(network - np.diag(np.diag(network)))

    @property
    def to_seat(self) -> Array:
        """Conductance of each surface to the seat, shape (3,) [W/K]."""
        return np.asarray(np.linalg.inv(self.resistance).sum(axis=1))


def ring_conductances(
    profile: RingProfile, conductivity: float, track_half_width: float, cells: RingCells = CELLS
) -> RingConductances:
    """Conductances of a whole ring between its surfaces and its seat.

    Parameters
    ----------
    profile : RingProfile
        section of the ring, without shaft or housing
    conductivity : float
        of the ring [W/(m K)]
    track_half_width : float
        arc length from the bottom of the groove to which the balls heat it [m]
    cells : RingCells, default CELLS
        sizes of the cells

    Returns
    -------
    RingConductances
        resistances of the network [K/W]

    Raises
    ------
    ValueError
        if the band is wider than the groove, or the profile has a shaft or housing
    """
    if not 0.0 < track_half_width < profile.edge:
        raise ValueError(f"track_half_width must lie between 0 and {profile.edge:.6g} m")
    if profile.body_radius is not None:
        raise ValueError("body_radius must be None: the conductances of the ring alone")
    mesh = ring_mesh(profile, cells, SECTOR, uniform=1)
    weights = np.stack(_surfaces(mesh, track_half_width), axis=1)
    weights /= weights.sum(axis=0)
    fixed = mesh.seat
    matrix = conduction_matrix(mesh.body, conductivity * 2.0 * pi / SECTOR)
    return RingConductances(_resistance(matrix, weights, fixed))


def conduction_matrix(body: HexMesh, conductivity: float) -> sparse.bsr_matrix:
    """Matrix of the heat that nodal temperatures conduct.

    Parameters
    ----------
    body : HexMesh
        the mesh
    conductivity : float
        [W/(m K)]

    Returns
    -------
    sparse.bsr_matrix
        matrix, shape (n, n) [W/K]
    """
    products = np.einsum("caibi->cab", gradient_products(body))
    return block_matrix(body, conductivity * products[..., None, None])


def _resistance(matrix: sparse.bsr_matrix, weights: Array, fixed: Nodes) -> Array:
    """Mean temperatures under unit heats, weights of both equal [K/W]."""
    free = np.flatnonzero(~fixed)
    inner = sparse.csr_matrix(matrix)[free][:, free]
    ones = np.ones((free.size, 1))
    solution = solve_symmetric(inner, ones, weights[free], TOLERANCE)
    resistance = weights[free].T @ solution.values
    return np.asarray(0.5 * (resistance + resistance.T))


def _surfaces(mesh: RingMesh, half_width: float) -> list[Array]:
    """Components of an even flux on the band of the track, the rest of it, the sides, at the
    nodes.
    """
    profile = mesh.profile
    arc = profile.arc

    def track(s: Array) -> Array:
        return np.asarray(track_points(profile, s)[1])

    def side(t: Array) -> Array:
        r, before, after = (
            section_points(profile, np.full_like(t, arc), t + step)[1]
            for step in (0.0, -STEP, STEP)
        )
        return np.asarray(r * np.abs(after - before))

    bounds = ((-half_width, half_width), (-arc, -half_width), (half_width, arc))
    band, first_rest, second_rest = (
        _integrals(mesh, mesh.track, 1, track, between) for between in bounds
    )
    ends = (mesh.body.on(1, end) for end in (-arc, arc))
    first, last = (_integrals(mesh, end, 2, side, (0.0, 1.0)) for end in ends)
    return [band, first_rest + second_rest, first + last]


def _integrals(
    mesh: RingMesh,
    nodes: Nodes,
    axis: int,
    density: Callable[[Array], Array],
    bounds: tuple[float, float],
) -> Array:
    """Integrals of the shape functions along one parameter, evenly around the axis."""
    theta = mesh.body.parameters[0]
    coordinate = mesh.body.parameters[axis]
    lines = np.unique(coordinate[nodes].round(12))
    points, weights = np.polynomial.legendre.leggauss(6)
    sums = np.zeros(lines.size)
    for first in range(0, lines.size - 2, 2):
        low, high = np.clip(lines[[first, first + 2]], *bounds)
        at = 0.5 * (low + high) + 0.5 * (high - low) * points
        flux = 0.5 * (high - low) * weights * density(at)
        for k in range(3):
            others = [lines[first + j] for j in range(3) if j != k]
            shape = np.prod([(at - x) / (lines[first + k] - x) for x in others], axis=0)
            sums[first + k] += flux @ shape
    around = np.where(np.abs(theta - 0.5 * mesh.angle) < 0.1 * mesh.angle, 4.0, 1.0)  # Simpson
    line = np.searchsorted(lines, coordinate - 1e-9 * float(np.ptp(lines)))
    return np.asarray(np.where(nodes, sums[np.minimum(line, lines.size - 1)] * around, 0.0))
