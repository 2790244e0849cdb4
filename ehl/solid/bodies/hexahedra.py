"""Meshes of quadratic hexahedra as images of boxes of parameters, and integrals of their shape
functions.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from skfem import Basis, ElementHex2, FacetBasis, LinearForm, MeshHex, MeshHex2, asm

from ...arrays import Array

Nodes = NDArray[np.bool_]

INTEGRATION_ORDER = 4  # three Gauss points a direction: exact for products of gradients in a box
SAME = 1e-9  # parameters closer than this count as one, relative to their range [-]


@dataclass(frozen=True, slots=True)
class HexMesh:
    """Quadratic hexahedra (27 nodes) and the parameters of their nodes.

    The parameters are the coordinates (p, q, t) of a box whose image the body is, [-] or [m].
    """

    mesh: MeshHex2
    parameters: Array  # of the nodes, shape (3, n)

    @property
    def points(self) -> Array:
        """Coordinates of the nodes, shape (3, n) [m]."""
        return np.asarray(self.mesh.doflocs)

    @property
    def cell_parameters(self) -> Array:
        """Mean parameters of the cells' corners, shape (3, cells)."""
        corners = self.mesh.t[:8]
        return np.asarray(self.parameters[:, corners].mean(axis=1))

    def basis(self) -> Basis:
        """Scalar basis of the nodes."""
        return Basis(self.mesh, ElementHex2(), intorder=INTEGRATION_ORDER)

    def on(self, axis: int, value: float) -> Nodes:
        """Nodes at which a parameter has a value, shape (n,)."""
        line = self.parameters[axis]
        return np.abs(line - value) <= SAME * max(float(np.ptp(line)), abs(value))


def hexahedra(lines: Sequence[Array], place: Callable[[Array], Array]) -> HexMesh:
    """Mesh of the box between `lines` of the three parameters; `place` takes parameters of nodes,
    shape (3, n), to their coordinates [m].

    Raises
    ------
    ValueError
        If cells are turned inside out.
    """
    box = MeshHex2.from_mesh(MeshHex.init_tensor(*lines))
    parameters = np.array(box.doflocs)
    mesh = MeshHex2(np.ascontiguousarray(place(parameters)), box.t)
    determinant = mesh.mapping().detDF(np.array([[0.5], [0.5], [0.5]]))
    if not (np.abs(determinant) > 0.0).all() or np.ptp(np.sign(determinant)) > 0.0:
        raise ValueError("cells of the mesh are turned inside out: profile too flat or thin")
    return HexMesh(mesh, parameters)


def volume_weights(body: HexMesh, cells: Nodes) -> Array:
    """Integrals of the shape functions over the chosen cells, shape (n,) [m^3]."""
    part = Basis(body.mesh, ElementHex2(), intorder=2, elements=np.flatnonzero(cells))
    return np.asarray(asm(_one, part))


def surface_weights(body: HexMesh, nodes: Nodes) -> Array:
    """Integrals of the shape functions over the facets all of whose corners are chosen, shape (n,)
    [m^2].
    """
    facets = np.flatnonzero(nodes[body.mesh.facets].all(axis=0) & _is_boundary(body.mesh))
    return np.asarray(asm(_one, FacetBasis(body.mesh, ElementHex2(), intorder=4, facets=facets)))


def _is_boundary(mesh: MeshHex2) -> Nodes:
    boundary = np.zeros(mesh.facets.shape[1], dtype=np.bool_)
    boundary[mesh.boundary_facets()] = True
    return boundary


@LinearForm
def _one(v, w):  # type: ignore[no-untyped-def]
    return v


def block_matrix(body: HexMesh, blocks: Array) -> sparse.bsr_matrix:
    """Sum of the cells' blocks, shape (cells, 27, 27, k, k), as a matrix of k x k blocks."""
    numbers = body.basis().dofs.element_dofs.T.astype(np.int64)
    count = body.points.shape[1]
    size = blocks.shape[-1]
    keys = (numbers[:, :, None] * count + numbers[:, None, :]).ravel()
    order = np.argsort(keys, kind="stable")
    keys = keys[order]
    first = np.flatnonzero(np.concatenate(([True], keys[1:] != keys[:-1])))
    data = np.add.reduceat(blocks.reshape(-1, size, size)[order], first, axis=0)
    rows, columns = np.divmod(keys[first], count)
    pointers = np.concatenate(([0], np.cumsum(np.bincount(rows, minlength=count))))
    shape = (size * count, size * count)
    return sparse.bsr_matrix((data, columns, pointers), shape=shape)


def gradient_products(body: HexMesh) -> Array:
    """Integrals of d_i phi_a d_j phi_b over each cell, shape (cells, 27, 3, 27, 3) [m]."""
    basis = body.basis()
    gradients = np.stack([functions[0].grad for functions in basis.basis])  # (27, 3, cells, q)
    columns = gradients.transpose(2, 0, 1, 3).reshape(basis.nelems, 81, -1)
    products = (columns * basis.dx[:, None, :]) @ columns.transpose(0, 2, 1)
    return np.asarray(products.reshape(basis.nelems, 27, 3, 27, 3))


def quadratic_line(nodes: Array, x: Array) -> tuple[NDArray[np.int64], Array]:
    """Numbers and values of the quadratic shape functions of a line of nodes, ends and middles of
    cells in turn, at places x, shape (..., 3) each.
    """
    cell = 2 * np.clip(np.searchsorted(nodes[2::2], x), 0, (nodes.size - 3) // 2)
    a, b, c = (nodes[cell + corner] for corner in range(3))
    values = [
        (x - b) * (x - c) / ((a - b) * (a - c)),
        (x - a) * (x - c) / ((b - a) * (b - c)),
        (x - a) * (x - b) / ((c - a) * (c - b)),
    ]
    return cell[..., None] + np.arange(3), np.stack(values, axis=-1)
