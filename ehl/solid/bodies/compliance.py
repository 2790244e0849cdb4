r"""Structural compliance of a ring at its balls, without that of a half-space.

A ball presses on a patch of the groove at the contact angle alpha, along the normal n_0 there:
half an ellipse of pressure over |s| <= b across the track, on one line of nodes, each nodal force
f_a = w_a n_a/(n_a n_0) along its normal with weights w_a of sum 1. The displacement at another
azimuth is measured with the same weights, d = sum w_a u_a n_a/(n_a n_0), so that a rigid motion is
itself. At the load itself the displacement of a flat block under the same forces is subtracted,
which Hertz' theory has already.

A groove moves along the axis and the radius, and it opens, both flanks equally, by g(beta) =
sin^2(beta)/sin^2(alpha) along its normal at beta. A force at beta is (sin(beta), cos(beta),
g(beta)) in these three, and d between two forces the sum over the entries of a matrix G, in which
the axial one stands alone, as rings are symmetric. A load at the bottom of the groove
and one at alpha, measured at both and at -alpha, yield it::

    G_xx = [d(alpha, alpha) - d(alpha, -alpha)] / (2 sin^2(alpha))
    G_rr = d(0, 0)
    G_ro = d(0, alpha) - cos(alpha) G_rr
    G_oo = [d(alpha, alpha) + d(alpha, -alpha)] / 2 - cos^2(alpha) G_rr - 2 cos(alpha) G_ro

Without the opening G_xx would have to hold it, and be wrong where it is small, such as in a loose
outer ring, and G_rr could not tell one flank from the bottom.

The flat block, a part of a half-space that a finite body is compared with, has the grid lines of
the body around its load and the same nodal forces; its far faces move as those of a half-space, by
the sum of Boussinesq's (1885) point loads. Body less block is then smooth, and the error of the
mesh under the load cancels.

A seat may touch the ring at some azimuths only. A seat contact presses radially on the seat,
evenly across the ring and as a parabola over the angle :math:`\pm w` around it, :math:`p \propto 1
- (\theta/w)^2`; it measures the radial displacement of the seat with the same weights, which make
its resultant one. The rigid part of all displacements is that of a loose ring under a cosine
pressure, which cancels where the seat contacts balance the balls.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...arrays import Array
from .elasticity import (
    HexMesh,
    elastic_body,
    hexahedra,
    quadratic_line,
    solve_elasticity,
    surface_weights,
    volume_weights,
)
from .ring_mesh import RingMesh, ring_mesh
from .ring_profile import Elasticity, RingCells, RingProfile, Seat, track_angle

GAUSS_POINTS = 32  # of the parabola

# half width of the patch in groove radii, that of a contact at 1.5 to 2 GPa; half and double of it
# change the -0.50 um/kN of a 6208 inner ring on a rigid shaft to -0.54 and -0.40, with Hertz'
# approach 9.3 um at 1 kN [-]
PATCH = 0.25
# half length of the flat block in patches, in addition to half the wall [-]
BLOCK_PATCHES = 2.0

Patch = tuple[Array, Array, float]  # lines across the track [m], weights [-], angle [rad]


def boussinesq(points: Array, young: float, poisson: float) -> Array:
    """Displacement of a half-space under a unit load at the origin along the depth, Boussinesq
    (1885).

    Parameters
    ----------
    points : Array
        x, y, depth, shape (3, n) [m]
    young : float
        Young's modulus [Pa]
    poisson : float
        Poisson's ratio [-]

    Returns
    -------
    Array
        along x, y, depth, shape (3, n) [m/N]
    """
    x, y, z = points
    distance = np.sqrt(x * x + y * y + z * z)
    scale = (1.0 + poisson) / (2.0 * np.pi * young)
    radial = z / distance**3 - (1.0 - 2.0 * poisson) / (distance * (distance + z))
    axial = z * z / distance**3 + 2.0 * (1.0 - poisson) / distance
    return np.asarray(scale * np.stack([x * radial, y * radial, axial]))


def flat_block(along: Array, across: Array, depth: Array) -> HexMesh:
    """Half a block from its plane of symmetry at along = 0.

    Parameters
    ----------
    along : Array
        lines along x, the first zero [m]
    across : Array
        lines along y [m]
    depth : Array
        lines into the depth, the first zero [m]

    Returns
    -------
    HexMesh
        the mesh
    """
    return hexahedra((along, across, depth), lambda parameters: parameters)


def indentation(
    block: HexMesh,
    load: tuple[Array, Array],
    positions: Sequence[tuple[Array, Array]],
    young: float,
    poisson: float,
) -> Array:
    """Mean depths of the surface under a unit force.

    Parameters
    ----------
    block : HexMesh
        mesh of the block
    load : tuple[Array, Array]
        nodes on the line along = 0, shape (k,) [m], and the fractions of the force there, shape
        (k,) [-]
    positions : Sequence[tuple[Array, Array]]
        likewise nodes and weights of each mean
    young : float
        Young's modulus [Pa]
    poisson : float
        Poisson's ratio [-]

    Returns
    -------
    Array
        depths, shape (positions,) [m/N]
    """
    across, weights = load
    points = block.points
    far = far_faces(block)
    prescribed = np.zeros((points.shape[1], 3, 1))
    for position, weight in zip(across, weights, strict=True):
        shifted = points[:, far] - np.array([[0.0], [position], [0.0]])
        prescribed[far, :, 0] += weight * boussinesq(shifted, young, poisson).T
    fixed = np.zeros((points.shape[1], 3), dtype=np.bool_)
    fixed[block.on(0, 0.0), 0] = True
    fixed[far] = True
    forces = np.zeros_like(prescribed)
    # half of the force stands beyond the plane of symmetry
    forces[_line_nodes(block, across), 2, 0] = 0.5 * weights
    elastic = elastic_body(block, young, poisson)
    depth = solve_elasticity(elastic, forces, fixed, prescribed).values[:, 2, 0]
    return np.array([mean @ depth[_line_nodes(block, nodes)] for nodes, mean in positions])


def far_faces(block: HexMesh) -> Array:
    """Nodes of all faces but the surface and the plane of symmetry.

    Parameters
    ----------
    block : HexMesh
        mesh of the block

    Returns
    -------
    Array
        shape (n,)
    """
    along, across, depth = block.parameters
    ends = block.on(1, float(across.min())) | block.on(1, float(across.max()))
    return np.asarray(ends | block.on(0, float(along.max())) | block.on(2, float(depth.max())))


def _line_nodes(block: HexMesh, across: Array) -> Array:
    """Numbers of the nodes of the surface on the plane of symmetry at positions [m]."""
    line = np.flatnonzero(block.on(0, 0.0) & block.on(2, 0.0))
    positions = block.parameters[1, line]
    return np.asarray(line[[int(np.abs(positions - position).argmin()) for position in across]])


@dataclass(frozen=True, slots=True, kw_only=True)
class SeatResponse:
    """Radial displacement of the seat under unit forces at theta = 0, by its contacts' weights."""

    theta: Array  # nodes around half the ring, shape (n,) [rad]
    # under a load at the bottom of the groove, at the contact angle, and a radial force on the
    # seat, shape (3, n) [m/N]
    moved: Array
    angle: float  # contact angle of the second [rad]
    half_width: float  # w [rad]

    def at(self, theta: Array) -> Array:
        """Displacement of the seat at an angle from the load.

        Parameters
        ----------
        theta : Array
            the angle, any shape [rad]

        Returns
        -------
        Array
            per radial force on the groove, per component of it that opens the groove, and per
            force on the seat, shape (3, ...) [m/N]
        """
        offsets, weights = _parabola(self.half_width)
        distance = np.asarray(theta)[..., None] + offsets
        distance = np.abs((distance + np.pi) % (2.0 * np.pi) - np.pi)
        numbers, shapes = quadratic_line(self.theta, distance)
        bottom, across, seat = (
            (row[numbers] * shapes).sum(axis=-1) @ weights for row in self.moved
        )
        return np.stack([bottom, across - np.cos(self.angle) * bottom, seat])


def seat_contact_forces(mesh: RingMesh, half_width: float) -> Array:
    """Nodal forces of half a unit seat contact at theta = 0, outwards.

    The other half stands beyond the plane of symmetry.

    Parameters
    ----------
    mesh : RingMesh
        mesh of the ring
    half_width : float
        w, half the angle of the contact [rad]

    Returns
    -------
    Array
        shape (nodes, 3) [-]
    """
    lines = _lines(mesh)
    angles, weights = _parabola(half_width)
    numbers, shapes = quadratic_line(lines, np.abs(angles))
    around = np.zeros(lines.size)
    np.add.at(around, numbers, 0.5 * weights[:, None] * shapes)
    theta = mesh.body.parameters[0]
    weight = around[np.abs(theta[:, None] - lines).argmin(axis=1)] * _across(mesh)
    return np.asarray(
        weight[:, None] * np.stack([0 * theta, np.cos(theta), np.sin(theta)], axis=1)
    )


def seat_response(mesh: RingMesh, field: Array, angle: float, half_width: float) -> SeatResponse:
    """Radial displacement of the seat under the three unit loads.

    Parameters
    ----------
    mesh : RingMesh
        mesh of the ring
    field : Array
        displacement of all nodes, shape (nodes, 3, 3) [m/N]
    angle : float
        contact angle of the second load [rad]
    half_width : float
        w, half the angle of the seat contacts [rad]

    Returns
    -------
    SeatResponse
        displacement as a seat contact measures it
    """
    theta = mesh.body.parameters[0]
    lines = _lines(mesh)
    line = np.abs(theta[:, None] - lines).argmin(axis=1)
    radial = field[:, 1] * np.cos(theta)[:, None] + field[:, 2] * np.sin(theta)[:, None]
    moved = np.zeros((lines.size, 3))
    np.add.at(moved, line, _across(mesh)[:, None] * radial)
    return SeatResponse(theta=lines, moved=moved.T, angle=angle, half_width=half_width)


def _parabola(half_width: float) -> tuple[Array, Array]:
    """Angles [rad] and weights of a seat contact, whose resultant is one [-], shape (points,)."""
    nodes, gauss = np.polynomial.legendre.leggauss(GAUSS_POINTS)
    weights = gauss * (1.0 - nodes**2)
    return half_width * nodes, weights / (weights @ np.cos(half_width * nodes))


def _lines(mesh: RingMesh) -> Array:
    return np.unique(mesh.body.parameters[0].round(12))


def _across(mesh: RingMesh) -> Array:
    """Weights of the nodes for the mean across the seat, sum 1 on every line around, zero off the
    seat, shape (nodes,) [-].
    """
    s = mesh.body.parameters[1]
    nodes = np.unique(s.round(12))
    weights = np.zeros(nodes.size)
    sizes = nodes[2::2] - nodes[:-2:2]
    for corner, simpson in enumerate((1.0, 4.0, 1.0)):  # Simpson's rule, that of quadratic cells
        weights[corner : nodes.size - 2 + corner : 2] += simpson / 6.0 * sizes
    line_weights = weights[np.abs(s[:, None] - nodes).argmin(axis=1)] / (nodes[-1] - nodes[0])
    return np.where(mesh.seat, line_weights, 0.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class RingResponse:
    """Displacement of a ring under unit forces at theta = 0."""

    mesh: RingMesh
    seat: Seat
    angles: Array  # contact angles of the two loads, 0 and alpha, shape (2,) [rad]
    theta: Array  # nodes around half the ring, shape (n,) [rad]
    # along the normal, per force, of the whole body: d(0, 0), d(0, alpha), d(alpha, alpha),
    # d(alpha, -alpha), shape (4, n) [m/N]
    displacement: Array
    half_space: Array  # displacement of a half-space at theta = 0, shape (4,) [m/N]
    # displacements of all nodes (x, y, z), shape (nodes, 3, 2); (nodes, 3, 3) with a seat contact
    # [m/N]
    field: Array
    seat_contacts: SeatResponse | None  # of a ring whose seat touches at some azimuths only
    unknowns: int
    iterations: int
    residual: float  # relative [-]
    method: str

    def at(self, theta: Array) -> Array:
        """Structural compliance between two azimuths.

        Parameters
        ----------
        theta : Array
            angle between them, shape (n,) [rad]

        Returns
        -------
        Array
            G_xx, G_rr, G_ro, G_oo, shape (4, n) [m/N]
        """
        distance = np.abs((np.asarray(theta) + np.pi) % (2.0 * np.pi) - np.pi)
        numbers, shapes = quadratic_line(self.theta, distance)
        values = (self.displacement[:, numbers] * shapes).sum(axis=-1)
        values = values - np.where(distance < 1e-9, self.half_space[:, None], 0.0)
        bottom, across, here, image = values
        alpha = self.angles[1]
        opened = across - np.cos(alpha) * bottom
        even = 0.5 * (here + image) - np.cos(alpha) ** 2 * bottom
        axial = 0.5 * (here - image) / np.sin(alpha) ** 2
        return np.stack([axial, bottom, opened, even - 2.0 * np.cos(alpha) * opened])


def ring_response(
    profile: RingProfile,
    elasticity: Elasticity,
    seat: Seat,
    contact_angle: float,
    cells: RingCells | None = None,
    patch: float = PATCH,
    seat_contact: float | None = None,
) -> RingResponse:
    """Displacement of a ring under unit loads at the bottom of the groove and at a contact angle.

    Half a ring between planes of symmetry.

    Parameters
    ----------
    profile : RingProfile
        section of the ring
    elasticity : Elasticity
        elastic constants of ring and shaft or housing
    seat : Seat
        support of the ring
    contact_angle : float
        of the second load [rad]
    cells : RingCells | None, optional
        sizes of the cells; None: the defaults
    patch : float, default PATCH
        half width of the loaded patch over the groove radius [-]
    seat_contact : float | None, optional
        half the angle of the contacts of a seat that touches at some azimuths [rad]; None: it
        touches all around

    Returns
    -------
    RingResponse
        displacements for a unit force
    """
    mesh = ring_mesh(profile, cells)
    angles = np.array([0.0, contact_angle])
    half_width = patch * profile.groove_radius
    patches = [_patch(mesh, angle, half_width) for angle in angles]
    loads = [_forces(mesh, *one) for one in patches]
    forces = np.stack(
        [*loads, *([] if seat_contact is None else [seat_contact_forces(mesh, seat_contact)])],
        axis=-1,
    )
    young = np.where(mesh.is_ring, elasticity.young, elasticity.body_young)
    poisson = np.where(mesh.is_ring, elasticity.poisson, elasticity.body_poisson)
    body = elastic_body(mesh.body, young, poisson)
    fixed = np.zeros((mesh.body.points.shape[1], 3), dtype=np.bool_)
    fixed[mesh.symmetric, 2] = True
    support = _support(mesh, seat)
    if support is None:
        fixed[mesh.far_side] = True
        solution = solve_elasticity(body, forces, fixed)
        field = solution.values
    else:
        solution = solve_elasticity(body, _balanced(mesh, forces, support), fixed)
        field = _in_place(mesh, solution.values, support)
    bottom, here = patches
    image = (-here[0], here[1], -here[2])
    pairs = ((bottom, (bottom, here)), (here, (here, image)))
    flat = [_half_space(mesh, load, points, elasticity) for load, points in pairs]
    theta = np.unique(mesh.body.parameters[0].round(12))
    measured = ((0, bottom), (0, here), (1, here), (1, image))
    moved = np.stack([_moved(mesh, field[..., load], *point) for load, point in measured])
    return RingResponse(
        mesh=mesh,
        seat=seat,
        angles=angles,
        theta=theta,
        displacement=moved,
        half_space=np.concatenate(flat),
        field=field,
        seat_contacts=None
        if seat_contact is None
        else seat_response(mesh, field, contact_angle, seat_contact),
        unknowns=body.unknowns,
        iterations=solution.iterations,
        residual=solution.residual,
        method=solution.method,
    )


def _patch(mesh: RingMesh, angle: float, half_width: float) -> Patch:
    """Lines across the track that carry the load [m], their weights [-], and its angle [rad].

    Half an ellipse over |s - r angle| <= half width, integrated with the quadratic shape
    functions of the line.
    """
    lines = np.unique(mesh.body.parameters[1][mesh.track].round(12))
    centre = mesh.profile.groove_radius * angle
    weights = np.zeros(lines.size)
    nodes, gauss = np.polynomial.legendre.leggauss(200)
    t = np.sin(0.5 * np.pi * nodes)  # takes the root at the ends
    pressure = gauss * np.cos(0.5 * np.pi * nodes) ** 2
    for position, load in zip(centre + half_width * t, pressure / pressure.sum(), strict=True):
        cell = 2 * min(int(np.searchsorted(lines[2::2], position)), (lines.size - 3) // 2)
        weights[cell : cell + 3] += load * _shape(lines[cell : cell + 3], position)
    loaded = np.flatnonzero(weights != 0.0)
    return lines[loaded], weights[loaded], angle


def _shape(nodes: Array, x: float) -> Array:
    """Quadratic Lagrange polynomials of three nodes at x [-]."""
    a, b, c = nodes
    return np.array(
        [
            (x - b) * (x - c) / ((a - b) * (a - c)),
            (x - a) * (x - c) / ((b - a) * (b - c)),
            (x - a) * (x - b) / ((c - a) * (c - b)),
        ]
    )


def _directions(mesh: RingMesh, lines: Array, angle: float) -> Array:
    """(x, r) of n/(n n_0) at lines across the track, along the force, shape (2, k) [-]."""
    normal_angle = track_angle(mesh.profile, lines)
    normal = np.stack([np.sin(normal_angle), -mesh.profile.side * np.cos(normal_angle)])
    return normal / np.cos(normal_angle - angle)


def _forces(mesh: RingMesh, lines: Array, weights: Array, angle: float) -> Array:
    """Nodal forces of half a unit load, whose other half stands beyond the plane of symmetry."""
    forces = np.zeros((mesh.body.points.shape[1], 3))
    directions = _directions(mesh, lines, angle)
    line = np.flatnonzero(mesh.track & mesh.body.on(0, 0.0))
    positions = mesh.body.parameters[1, line]
    for s, weight, direction in zip(lines, weights, directions.T, strict=True):
        forces[line[np.abs(positions - s).argmin()], :2] = 0.5 * weight * direction
    return forces


def _moved(mesh: RingMesh, field: Array, lines: Array, weights: Array, angle: float) -> Array:
    """Displacement along the normal at every line around the ring [m/N], shape (n,)."""
    theta, s, _ = mesh.body.parameters
    directions = _directions(mesh, lines, angle)
    radial = field[:, 1] * np.cos(theta) + field[:, 2] * np.sin(theta)
    moved = 0.0
    for line, weight, (x, r) in zip(lines, weights, directions.T, strict=True):
        nodes = np.flatnonzero(mesh.track & (np.abs(s - line) < 1e-9 * mesh.profile.arc))
        nodes = nodes[np.argsort(theta[nodes])]
        moved = moved + weight * (x * field[nodes, 0] + r * radial[nodes])
    return np.asarray(moved)


def _half_space(
    mesh: RingMesh, load: Patch, points: Sequence[Patch], elasticity: Elasticity
) -> Array:
    """Displacement of a flat block with the grid lines around the load, shape (points,) [m/N]."""
    profile = mesh.profile
    local = profile.centre_radius - profile.side * profile.groove_radius * np.cos(load[2])
    corners = mesh.body.parameters[:, np.unique(mesh.body.mesh.t[:8])]
    theta, s, t = (np.unique(row.round(12)) for row in corners)
    along = local * theta
    reach = 0.5 * profile.wall + BLOCK_PATCHES * float(np.ptp(load[0]))
    along = along[: 1 + max(4, int(np.searchsorted(along, reach)))]
    block = flat_block(along, s, profile.wall * t[t <= 1.0])
    young, poisson = elasticity.young, elasticity.poisson
    return indentation(block, load[:2], [point[:2] for point in points], young, poisson)


def _support(mesh: RingMesh, seat: Seat) -> Array | None:
    """Nodal forces that hold the rigid motions of half a ring, shape (3 n, 3); None where the far
    side is fixed.
    """
    profile = mesh.profile
    if seat is Seat.RIGID or (seat is Seat.ELASTIC and profile.side < 0.0):
        return None
    modes = _rigid_motions(mesh).reshape(-1, 3, 3)
    if seat is Seat.ELASTIC:
        return (volume_weights(mesh.body, ~mesh.is_ring)[:, None, None] * modes).reshape(-1, 3)
    theta = mesh.body.parameters[0]
    radial = np.stack([np.zeros_like(theta), np.cos(theta), np.sin(theta)], axis=1)
    pressed = np.einsum("ni,nj,njk->nik", radial, radial, modes)
    pressed[:, 0] += modes[:, 0]
    weights = surface_weights(mesh.body, mesh.seat)
    return (weights[:, None, None] * pressed).reshape(-1, 3)


def _rigid_motions(mesh: RingMesh) -> Array:
    """Motions along x and y and about z, which the planes of symmetry let free, shape (3 n, 3)."""
    x, y, _ = mesh.body.points / mesh.profile.seat_radius
    modes = np.zeros((x.size, 3, 3))
    modes[:, 0, 0] = 1.0
    modes[:, 1, 1] = 1.0
    modes[:, 0, 2] = -y
    modes[:, 1, 2] = x
    return modes.reshape(-1, 3)


def _balanced(mesh: RingMesh, forces: Array, support: Array) -> Array:
    """Forces with those of the support that balance them."""
    modes = _rigid_motions(mesh)
    flat = forces.reshape(-1, forces.shape[-1])
    reaction = support @ np.linalg.solve(modes.T @ support, modes.T @ flat)
    return np.asarray((flat - reaction).reshape(forces.shape))


def _in_place(mesh: RingMesh, field: Array, support: Array) -> Array:
    """Displacement less its rigid component as measured by the support."""
    modes = _rigid_motions(mesh)
    flat = field.reshape(-1, field.shape[-1])
    rigid = modes @ np.linalg.solve(support.T @ modes, support.T @ flat)
    return np.asarray((flat - rigid).reshape(field.shape))
