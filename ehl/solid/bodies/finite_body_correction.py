r"""Surfaces of a grooved ring, by finite elements, and of a ball, in closed form, under a contact,
less that of a half-space.

On the ring the pressure of the ellipse acts on the nodes of the track, w_a at each along its own
normal as w_a n_a/(n_a n_0), n_0 the normal in the middle of the contact; displacements are
measured the same way, u_a n_a/(n_a n_0), so that a rigid motion is a constant and the operator
symmetric. A flat block with the grid lines of the ring in arc lengths carries the w_a themselves,
its far faces move as Boussinesq's half-space: the errors of the mesh under the load cancel in the
difference, and the mesh need not resolve the pressure.

The ring stands bonded on a rigid seat, a sector on either side of the load; or loose, the whole
ring, the load spread over the seat with the cosine from its direction.

The ball carries two opposite equal loads. Normal pressures p_n P_n(cos gamma) on a sphere of
radius R move it by w_n P_n along the radius, with the two regular solutions of degree n (Love,
Mathematical Theory of Elasticity, 1927, article 172; phi = r^n P_n)

.. math:: u = a \nabla\phi + b\,(r^2 \nabla\phi + \alpha_n x \phi), \qquad
          \alpha_n = -2\,\frac{n\lambda + (3n+1)\mu}{(n+3)\lambda + (n+5)\mu}

and no shear on the surface. Unit loads at both poles have p_n = (2 n + 1)/(2 pi R^2) at even n,
and over (1 - nu^2)/(pi E R) their displacements tend to 2 + 2 c/n, c = (1 - 2 nu)^2/[2 (1 - nu)].
These two terms are summed in closed form, with

.. math:: \sum P_n = \frac{1}{2 \sin(\gamma/2)}, \qquad
          \sum_{n \ge 1} \frac{P_n}{n} = -\ln[\sin(\gamma/2) (1 + \sin(\gamma/2))]

and the rest falls like n^-2. The first is the half-space up to O(gamma); the second, singular as a
logarithm, is what the curvature of the surface adds.
"""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.polynomial.legendre import legval
from numpy.typing import NDArray
from scipy.sparse import csr_matrix

from ...arrays import Array
from ..compliance import corner_integrals
from .compliance import boussinesq, far_faces, flat_block
from .elasticity import HexMesh, LinearSolution, elastic_body, quadratic_line, solve_elasticity
from .ring import StressDifference, grid_stress, stress_difference
from .ring_mesh import RingMesh, ring_mesh
from .ring_profile import RingCells, RingProfile, track_angle
from .surface_difference import ContactPatch, SurfaceDifference, fitted

# cells in semi-axes; ACROSS 0.7 changes the curvature across of a 6208 from 2.18 to 2.01 % of
# 1/R_y, ALONG 1.0 to 2.22 %, and that along from 0.19 to 0.38 and 0.21 % of 1/R_x
ACROSS = 0.5  # of b
ALONG = 2.0  # of a
MOST_ACROSS = 40  # cells between the edges of the groove: a short ellipse has coarser ones
SECTOR = 3.0  # of wall and semi-axis b together, half a sector; 5 changes nothing in four digits

DEGREES = 400  # of the rest; twice as many change the difference by less than 1e-5 of it
SMALLEST = 1e-6  # half angle between two cells, where the smooth part is even [rad]


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


def ball_difference(
    radius: float, youngs_modulus: float, poisson_ratio: float, patch: ContactPatch
) -> SurfaceDifference:
    """Surface of a ball under Hertz pressures on two opposite ellipses, less that of a half-space.

    Pressures and positions are in arc lengths; forces stand along the ball's normals, and
    displacements are those along them over the cosine to the contact's normal, so that a rigid
    motion is a constant.

    Parameters
    ----------
    radius : float
        of the ball [m]
    youngs_modulus : float
        E [Pa]
    poisson_ratio : float
        nu [-]
    patch : ContactPatch
        ellipse of the contact

    Returns
    -------
    SurfaceDifference
        displacement over the ellipse, less that of the half-space
    """
    x, y, loads, cell = patch.cells()
    kernel = ball_kernel(radius, youngs_modulus, poisson_ratio, (x, y), cell)
    return fitted(patch, (x, y), loads, kernel @ loads)


def ball_kernel(
    radius: float,
    youngs_modulus: float,
    poisson_ratio: float,
    points: tuple[Array, Array],
    cell: tuple[float, float],
) -> Array:
    """Displacement at the middles of cells by the load of each, less that of a half-space.

    Parameters
    ----------
    radius : float
        of the ball [m]
    youngs_modulus : float
        E [Pa]
    poisson_ratio : float
        nu [-]
    points : tuple[Array, Array]
        x and y of the middles, shape (n,) each [m]
    cell : tuple[float, float]
        sides of a cell [m]

    Returns
    -------
    Array
        shape (n, n) [m/N]
    """
    x, y = points
    factor = (1.0 - poisson_ratio**2) / (np.pi * youngs_modulus)
    towards = np.stack([np.sin(x / radius), np.sin(y / radius)])
    height = np.sqrt(1.0 - (towards**2).sum(axis=0))
    position = np.concatenate((towards, height[None, :]))
    chord = np.linalg.norm(position[:, :, None] - position[:, None, :], axis=0)
    angle = 2.0 * np.arcsin(np.clip(0.5 * chord, SMALLEST, 1.0))
    smooth = pole_difference(angle, poisson_ratio) + _slope(poisson_ratio) * np.log(angle)
    logarithm = _cell_means(_log_corner, x, y, cell) - np.log(radius)
    flat = _cell_means(_distance_corner, x, y, cell)
    curved = flat + (smooth - _slope(poisson_ratio) * logarithm) / radius
    return np.asarray(factor * (curved / (height[:, None] * height[None, :]) - flat))


def pole_difference(angle: Array, poisson_ratio: float) -> Array:
    """Inward displacement of a ball loaded at two poles, less that of a half-space at the distance
    R gamma.

    Over (1 - nu^2)/(pi E R) of a unit load.

    Parameters
    ----------
    angle : Array
        gamma > 0 from the nearer pole, any shape [rad]
    poisson_ratio : float
        nu [-]

    Returns
    -------
    Array
        difference, shape of `angle` [-]
    """
    nu = poisson_ratio
    slope = _slope(nu)
    degree = np.arange(0, 2 * DEGREES, 2)
    series = np.zeros(2 * DEGREES)
    series[degree] = 2.0 * (_degrees(degree, nu) - 1.0)
    series[degree[1:]] -= 2.0 * slope / degree[1:]
    other = np.pi - angle
    closed = _sum(angle) - 1.0 / angle + _sum(other) + slope * (_log_sum(angle) + _log_sum(other))
    return np.asarray(closed + legval(np.cos(angle), series))


def _degrees(degree: NDArray[Any], nu: float) -> Array:
    """(2 n + 1) w_n/(4 pi) over (1 - nu)/(2 pi mu), 1 for a half-space; mu = 1, n not 1 [-]."""
    n = degree.astype(np.float64)
    lame = 2.0 * nu / (1.0 - 2.0 * nu)
    alpha = -2.0 * (n * lame + 3.0 * n + 1.0) / ((n + 3.0) * lame + n + 5.0)
    gradient = np.where(n == 0.0, 0.0, -(2.0 * n + alpha) / (2.0 * (n - 1.0)))  # a/b, no shear
    moved = gradient * n + n + alpha
    stress = 2.0 * gradient * n * (n - 1.0)
    stress += lame * (2.0 * n + alpha * (n + 3.0)) + 2.0 * (n + alpha) * (n + 1.0)
    return np.asarray((2.0 * n + 1.0) / 2.0 / (1.0 - nu) * moved / stress)


def _sum(angle: Array) -> Array:
    """Sum of P_n(cos gamma) over all n [-]."""
    return np.asarray(0.5 / np.sin(0.5 * angle))


def _log_sum(angle: Array) -> Array:
    """Sum of P_n(cos gamma)/n from n = 1 [-]."""
    s = np.sin(0.5 * angle)
    return np.asarray(-np.log(s * (1.0 + s)))


def _slope(nu: float) -> float:
    """c of the logarithm that the curvature adds [-]."""
    return (1.0 - 2.0 * nu) ** 2 / (2.0 * (1.0 - nu))


def _cell_means(
    corner: Callable[[Array, Array], Array], x: Array, y: Array, cell: tuple[float, float]
) -> Array:
    """Means of a function of the distance over the cells around one set of points as seen from the
    others, shape (n, n); `corner`: its integral over a rectangle from the origin.
    """
    u = x[:, None] - x[None, :]
    v = y[:, None] - y[None, :]
    dx, dy = 0.5 * cell[0], 0.5 * cell[1]
    total = corner(u + dx, v + dy) - corner(u + dx, v - dy)
    total = total - corner(u - dx, v + dy) + corner(u - dx, v - dy)
    return np.asarray(total / (cell[0] * cell[1]))


def _distance_corner(x: Array, y: Array) -> Array:
    """Integral of 1/r, Love (1929) [m]."""
    return corner_integrals(x, y)[0]


def _log_corner(x: Array, y: Array) -> Array:
    """Integral of ln r, up to functions of x or of y alone [m^2]."""
    angles = x * x * np.arctan(y / x) + y * y * np.arctan(x / y)
    return np.asarray(0.5 * (x * y * (np.log(x * x + y * y) - 3.0) + angles))
