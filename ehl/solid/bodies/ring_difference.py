r"""Surface of a grooved ring under a contact, less that of a half-space: finite elements.

The pressure of the ellipse acts on the nodes of the track, w_a at each along its own normal as
w_a n_a/(n_a n_0), n_0 the normal in the middle of the contact; displacements are measured the same
way, u_a n_a/(n_a n_0), so that a rigid motion is a constant and the operator symmetric. A flat
block with the grid lines of the ring in arc lengths carries the w_a themselves, its far faces move
as Boussinesq's half-space: the errors of the mesh under the load cancel in the difference, and the
mesh need not resolve the pressure.

The ring stands bonded on a rigid seat, a sector on either side of the load; or loose, the whole
ring, the load spread over the seat with the cosine from its direction.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_matrix

from ...arrays import Array
from .elasticity import elastic_body, solve_elasticity
from .flat_block import boussinesq, far_faces, flat_block
from .hexahedra import HexMesh, quadratic_line
from .ring_mesh import RingMesh, ring_mesh
from .ring_profile import RingCells, RingProfile, track_angle
from .ring_stress import StressDifference, grid_stress, stress_difference
from .smoothed_aggregation import LinearSolution
from .surface_difference import ContactPatch, SurfaceDifference, fitted

# cells in semi-axes; ACROSS 0.7 changes the curvature across of a 6208 from 2.18 to 2.01 % of
# 1/R_y, ALONG 1.0 to 2.22 %, and that along from 0.19 to 0.38 and 0.21 % of 1/R_x
ACROSS = 0.5  # of b
ALONG = 2.0  # of a
MOST_ACROSS = 40  # cells between the edges of the groove: a short ellipse has coarser ones
SECTOR = 3.0  # of wall and semi-axis b together, half a sector; 5 changes nothing in four digits


def ring_difference(
    profile: RingProfile,
    contact_angle: float,
    youngs_modulus: float,
    poisson_ratio: float,
    patch: ContactPatch,
) -> tuple[SurfaceDifference, StressDifference]:
    """Surface and stress of a ring on a rigid seat under a contact, less those of a half-space.

    Parameters
    ----------
    profile : RingProfile
        section of the ring
    contact_angle : float
        of the contact [rad]
    youngs_modulus : float
        E [Pa]
    poisson_ratio : float
        nu [-]
    patch : ContactPatch
        ellipse of the contact

    Returns
    -------
    surface
        displacement over the ellipse, less that of the half-space
    stress
        stress below it, less that of the half-space
    """
    mesh = _mesh(profile, contact_angle, patch)
    x, y, loads, _ = patch.cells()
    local = profile.centre_radius - profile.side * profile.groove_radius * np.cos(contact_angle)
    middle = profile.groove_radius * contact_angle
    nodes, theta, s, interpolation = _track(mesh, np.abs(x) / local, middle + y)
    # half of the pattern stands beyond the plane of symmetry
    weights = interpolation.T @ (0.5 * loads)
    directions = _directions(profile, theta, s, contact_angle)
    body = elastic_body(mesh.body, youngs_modulus, poisson_ratio)
    forces = np.zeros((mesh.body.points.shape[1], 3, 1))
    forces[nodes, :, 0] = weights[:, None] * directions
    fixed = np.zeros(forces.shape[:2], dtype=np.bool_)
    fixed[mesh.body.on(0, 0.0), 2] = True
    fixed[mesh.far_side | mesh.body.on(0, mesh.angle)] = True
    solution = solve_elasticity(body, forces, fixed)
    moved = (solution.values[nodes, :, 0] * directions).sum(axis=1)
    elastic = (youngs_modulus, poisson_ratio)
    block, flat = _flat(mesh, local, nodes, weights, elastic)
    depth = flat.values[nodes, 2, 0]
    difference = fitted(patch, (x, y), loads, interpolation @ (moved - depth))
    difference = replace(
        difference,
        unknowns=body.unknowns,
        iterations=solution.iterations,
        residual=max(solution.residual, flat.residual),
    )
    fields = (solution.values[..., 0], flat.values[..., 0])
    return difference, _stress(mesh, block, fields, middle, elastic)


def _stress(
    mesh: RingMesh,
    block: HexMesh,
    fields: tuple[Array, Array],
    middle: float,
    elastic: tuple[float, float],
) -> StressDifference:
    """Stress of ring less block at their nodes, from displacements, shape (nodes, 3) each [m]."""
    lines = [np.unique(row.round(12)) for row in mesh.body.parameters]
    theta, s, t = lines
    order = np.lexsort(mesh.body.parameters[::-1].round(12))
    shape = (3, *(line.size for line in lines))
    ring, flat = (
        grid_stress(
            (theta, s, t),
            body.points[:, order].reshape(shape),
            field[order].T.reshape(shape),
            elastic,
        )
        for body, field in zip((mesh.body, block), fields, strict=True)
    )
    distance = np.unique(block.parameters[0].round(12))
    positions = (distance, s - middle, mesh.profile.wall * t)
    return stress_difference(positions, ring, flat, _frames(mesh.profile, theta, s))


def _frames(profile: RingProfile, theta: Array, s: Array) -> Array:
    """Unit vectors along, across and into the ring at lines of its track, shape (3, 3, n, m)."""
    angle = np.broadcast_to(track_angle(profile, s), (theta.size, s.size))
    turn = np.broadcast_to(theta[:, None], angle.shape)
    side = profile.side
    along = [np.zeros_like(turn), -np.sin(turn), np.cos(turn)]
    rise = side * np.sin(angle)
    fall = -side * np.cos(angle)
    across = [np.cos(angle), rise * np.cos(turn), rise * np.sin(turn)]
    down = [np.sin(angle), fall * np.cos(turn), fall * np.sin(turn)]
    return np.array([along, across, down])


def _mesh(profile: RingProfile, contact_angle: float, patch: ContactPatch) -> RingMesh:
    groove = 2.0 * profile.edge / (ACROSS * patch.semi_axis_y)
    groove = 2 * int(np.clip(np.ceil(0.5 * groove), 4, MOST_ACROSS // 2))
    size = 2.0 * profile.edge / groove
    reach = SECTOR * (profile.wall + patch.semi_axis_y) / profile.track_radius
    cells = RingCells(groove=groove, aspect=min(ALONG * patch.semi_axis_x / size, 1.0))
    return ring_mesh(profile, cells, min(reach, np.pi))


def _track(
    mesh: RingMesh, theta: Array, s: Array
) -> tuple[NDArray[np.int64], Array, Array, csr_matrix]:
    """Nodes of the track, their theta [rad] and s [m], and the matrix that interpolates from them
    to points, shape (points, nodes).
    """
    nodes = np.flatnonzero(mesh.track)
    parameters = mesh.body.parameters[:2, nodes]
    lines = [np.unique(row.round(12)) for row in parameters]
    numbers = np.empty([line.size for line in lines], dtype=np.int64)
    where = [
        np.abs(row[:, None] - line).argmin(axis=1)
        for row, line in zip(parameters, lines, strict=True)
    ]
    numbers[where[0], where[1]] = np.arange(nodes.size)
    first, along = quadratic_line(lines[0], theta)
    second, across = quadratic_line(lines[1], s)
    columns = numbers[first[:, :, None], second[:, None, :]].reshape(theta.size, 9)
    values = (along[:, :, None] * across[:, None, :]).reshape(theta.size, 9)
    rows = np.repeat(np.arange(theta.size), 9)
    matrix = csr_matrix((values.ravel(), (rows, columns.ravel())), (theta.size, nodes.size))
    return nodes, parameters[0], parameters[1], matrix


def _directions(profile: RingProfile, theta: Array, s: Array, contact_angle: float) -> Array:
    """n/(n n_0) at nodes of the track, from the ball into the ring, shape (n, 3) [-]."""

    def normal(theta: Array, angle: Array) -> Array:
        radial = -profile.side * np.cos(angle)
        return np.stack([np.sin(angle), radial * np.cos(theta), radial * np.sin(theta)], axis=1)

    normals = normal(theta, track_angle(profile, s))
    middle = normal(np.zeros(1), np.full(1, contact_angle))
    towards = normals @ middle[0]
    # far from the load normals may stand across; there is no force on them
    return np.asarray(normals / np.where(towards > 0.1, towards, np.inf)[:, None])


def _flat(
    mesh: RingMesh,
    local: float,
    nodes: NDArray[np.int64],
    weights: Array,
    elastic: tuple[float, float],
) -> tuple[HexMesh, LinearSolution]:
    """The flat block and its displacements [m]; its third component is the depth."""
    corners = mesh.body.parameters[:, np.unique(mesh.body.mesh.t[:8])]
    theta, s, t = (np.unique(row.round(12)) for row in corners)
    block = flat_block(local * theta, s, mesh.profile.wall * t)
    points = block.points
    far = far_faces(block)
    loaded = np.flatnonzero(weights)
    forces = np.zeros((points.shape[1], 3, 1))
    prescribed = np.zeros_like(forces)
    # nodes of ring and block have the same numbers, as the same lines make both
    forces[nodes, 2, 0] = weights
    for node, weight in zip(nodes[loaded], weights[loaded], strict=True):
        for side in (1.0, -1.0):  # the load and its mirror image
            image = points[:, node] * np.array([side, 1.0, 0.0])
            push = boussinesq(points[:, far] - image[:, None], *elastic)
            prescribed[far, :, 0] += weight * push.T
    fixed = np.zeros(forces.shape[:2], dtype=np.bool_)
    fixed[block.on(0, 0.0), 0] = True
    fixed[far] = True
    return block, solve_elasticity(elastic_body(block, *elastic), forces, fixed, prescribed)
