"""A flat block of a half-space under nodal forces: what a finite body is compared with.

The block has the grid lines of the body around its load and the same nodal forces; its far faces
move as those of a half-space, by the sum of Boussinesq's (1885) point loads. Body less block is
then smooth, and the error of the mesh under the load cancels.
"""

from collections.abc import Sequence

import numpy as np

from ...arrays import Array
from .elasticity import elastic_body, solve_elasticity
from .hexahedra import HexMesh, hexahedra


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
