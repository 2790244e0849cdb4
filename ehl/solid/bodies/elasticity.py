r"""Linear elasticity on meshes of quadratic hexahedra.

.. math:: \int \lambda\, \mathrm{div} u\, \mathrm{div} v + 2 \mu\, \varepsilon(u) : \varepsilon(v)

is put together from the products of gradients of the scalar shape functions, S_{ai,bj} = int d_i
phi_a d_j phi_b, cell by cell: K_{ai,bj} = lambda S_{ai,bj} + mu S_{aj,bi} + mu delta_ij S_{ak,bk}.
Linear hexahedra lock in the bending of rings; quadratic ones do not.
"""

from dataclasses import dataclass

import numpy as np
from scipy import sparse

from ...arrays import Array
from .hexahedra import HexMesh, Nodes, block_matrix, gradient_products
from .smoothed_aggregation import LinearSolution, solve_symmetric

TOLERANCE = 1e-8  # relative residual of the displacements [-]


@dataclass(frozen=True, slots=True)
class ElasticBody:
    """A mesh with its stiffness; forces and displacements have the shape (n, 3, cases)."""

    body: HexMesh
    stiffness: sparse.bsr_matrix  # blocks of 3 x 3, node by node [N/m]

    @property
    def unknowns(self) -> int:
        """Components of displacement [-]."""
        return int(self.stiffness.shape[0])


def elastic_body(
    body: HexMesh, youngs_modulus: Array | float, poisson_ratio: Array | float
) -> ElasticBody:
    """Stiffness of a mesh.

    Parameters
    ----------
    body : HexMesh
        the mesh
    youngs_modulus : Array | float
        of each cell, shape (cells,), or one number for all [Pa]
    poisson_ratio : Array | float
        likewise [-]

    Returns
    -------
    ElasticBody
        mesh and stiffness
    """
    count = body.mesh.nelements
    young, nu = (
        np.broadcast_to(x, count)[:, None, None, None, None]
        for x in (youngs_modulus, poisson_ratio)
    )
    shear = young / (2.0 * (1.0 + nu))
    lame = young * nu / ((1.0 + nu) * (1.0 - 2.0 * nu))
    products = gradient_products(body)
    trace = np.einsum("caibi->cab", products)
    cells = lame * products + shear * products.transpose(0, 1, 4, 3, 2)
    for i in range(3):
        cells[:, :, i, :, i] += shear[..., 0, 0] * trace
    return ElasticBody(body, block_matrix(body, cells.transpose(0, 1, 3, 2, 4)))


def rigid_body_modes(points: Array) -> Array:
    """Translations and rotations about the centre.

    Parameters
    ----------
    points : Array
        coordinates of the nodes, shape (3, n) [m]

    Returns
    -------
    Array
        modes, rotations over the size of the body, shape (3 n, 6) [-]
    """
    offset = points - points.mean(axis=1, keepdims=True)
    x, y, z = offset / np.abs(offset).max()
    none = np.zeros_like(x)
    modes = np.zeros((points.shape[1], 3, 6))
    modes[:, range(3), range(3)] = 1.0
    modes[:, :, 3] = np.stack([none, -z, y], axis=1)
    modes[:, :, 4] = np.stack([z, none, -x], axis=1)
    modes[:, :, 5] = np.stack([-y, x, none], axis=1)
    return modes.reshape(-1, 6)


def solve_elasticity(
    elastic: ElasticBody,
    forces: Array,
    fixed: Nodes,
    prescribed: Array | None = None,
    tolerance: float = TOLERANCE,
) -> LinearSolution:
    """Displacements under nodal forces.

    A body without fixed components takes forces in balance; its rigid motion is then arbitrary.

    Parameters
    ----------
    elastic : ElasticBody
        mesh and stiffness
    forces : Array
        nodal forces, shape (n, 3, cases) [N]
    fixed : Nodes
        components that are prescribed, shape (n, 3)
    prescribed : Array | None, optional
        their displacements, shape (n, 3, cases) [m]; None: zero
    tolerance : float, default TOLERANCE
        largest relative residual [-]

    Returns
    -------
    LinearSolution
        displacements, shape (n, 3, cases) [m], and the work of the solution
    """
    shape = forces.shape
    right = forces.reshape(-1, shape[-1]).astype(np.float64)
    is_fixed = fixed.reshape(-1)
    values = np.zeros_like(right)
    if prescribed is not None:
        values = np.where(is_fixed[:, None], prescribed.reshape(right.shape), 0.0)
        right = right - elastic.stiffness @ values
    right = np.where(is_fixed[:, None], 0.0, right)
    modes = rigid_body_modes(elastic.body.points)
    modes[is_fixed] = 0.0
    solution = solve_symmetric(_constrained(elastic.stiffness, is_fixed), modes, right, tolerance)
    return solution._replace(values=(solution.values + values).reshape(shape))


def _constrained(matrix: sparse.bsr_matrix, fixed: Nodes) -> sparse.bsr_matrix:
    """The matrix without rows and columns of fixed components, their diagonal excepted."""
    free = np.where(fixed, 0.0, 1.0).reshape(-1, 3)
    rows = np.repeat(np.arange(len(free)), np.diff(matrix.indptr))
    columns = matrix.indices
    data = matrix.data * free[rows][:, :, None] * free[columns][:, None, :]
    diagonal = np.flatnonzero(rows == columns)
    nodes = rows[diagonal]
    for i in range(3):
        kept = (1.0 - free[nodes, i]) * matrix.data[diagonal, i, i]
        data[diagonal, i, i] += kept
    return sparse.bsr_matrix((data, columns, matrix.indptr), shape=matrix.shape)
