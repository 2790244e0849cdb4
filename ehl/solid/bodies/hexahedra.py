"""Meshes of quadratic hexahedra as images of boxes of parameters, and integrals of their shape
functions.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from skfem import Basis, ElementHex2, LinearForm, MeshHex, MeshHex2, asm
from skfem.quadrature import get_quadrature
from skfem.refdom import RefQuad

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

    @property
    def numbers(self) -> NDArray[np.int64]:
        """Numbers of the nodes of each cell, shape (cells, 27)."""
        return np.asarray(self.mesh.dofs.element_dofs.T, dtype=np.int64)

    def on(self, axis: int, value: float) -> Nodes:
        """Nodes at which a parameter has a value.

        Parameters
        ----------
        axis : int
            number of the parameter
        value : float
            its value [unit of the parameter]

        Returns
        -------
        Nodes
            shape (n,)
        """
        line = self.parameters[axis]
        return np.abs(line - value) <= SAME * max(float(np.ptp(line)), abs(value))


def hexahedra(lines: Sequence[Array], mapping: Callable[[Array], Array]) -> HexMesh:
    """Mesh of the box between lines of the three parameters.

    Parameters
    ----------
    lines : Sequence[Array]
        positions of the lines of each parameter
    mapping : Callable[[Array], Array]
        function of the parameters of nodes, shape (3, n); it returns their coordinates [m]

    Returns
    -------
    HexMesh
        the mesh

    Raises
    ------
    ValueError
        if cells are turned inside out
    """
    box = MeshHex2.from_mesh(MeshHex.init_tensor(*lines))
    parameters = np.array(box.doflocs)
    mesh = MeshHex2(np.ascontiguousarray(mapping(parameters)), box.t)
    body = HexMesh(mesh, parameters)
    determinant = np.linalg.det(_stretch(body, _shapes(np.full((3, 1), 0.5))[1]))
    if not (np.abs(determinant) > 0.0).all() or np.ptp(np.sign(determinant)) > 0.0:
        raise ValueError("cells of the mesh are turned inside out: profile too flat or thin")
    return body


def _shapes(points: Array) -> tuple[Array, Array]:
    """Shape functions and their gradients at points of the cube [0, 1]^3, shape (3, q): (27, q),
    (27, 3, q) [-].
    """
    element = ElementHex2()
    values, gradients = zip(*(element.lbasis(points, node) for node in range(27)), strict=True)
    return np.stack(values), np.stack(gradients)


def _stretch(body: HexMesh, gradients: Array) -> Array:
    """Derivatives of the coordinates of each cell by those of the cube, from the gradients of its
    shape functions (27, 3, q): shape (cells, q, 3, 3) [m].
    """
    points = body.points.T[body.numbers].transpose(0, 2, 1)
    count = gradients.shape[-1]
    stretched = points @ gradients.reshape(27, -1)
    return np.asarray(stretched.reshape(len(points), 3, 3, count).transpose(0, 3, 1, 2))


def volume_weights(body: HexMesh, cells: Nodes) -> Array:
    """Integrals of the shape functions over chosen cells.

    Parameters
    ----------
    body : HexMesh
        the mesh
    cells : Nodes
        the cells, shape (cells,)

    Returns
    -------
    Array
        shape (n,) [m^3]
    """
    chosen = Basis(body.mesh, ElementHex2(), intorder=2, elements=np.flatnonzero(cells))
    return np.asarray(asm(_one, chosen))


def surface_weights(body: HexMesh, nodes: Nodes) -> Array:
    """Integrals of the shape functions over the boundary facets all of whose corners are chosen.

    Parameters
    ----------
    body : HexMesh
        the mesh
    nodes : Nodes
        the corners, shape (n,)

    Returns
    -------
    Array
        shape (n,) [m^2]
    """
    mesh = body.mesh
    chosen = nodes[mesh.facets].all(axis=0) & _is_boundary(mesh)
    numbers = body.numbers
    weights = np.zeros(body.points.shape[1])
    for facet, corners in enumerate(ElementHex2.refdom.facets):
        cells = np.flatnonzero(chosen[mesh.t2f[facet]])
        # 1. where the facet lies in the cube, and Gauss points on it
        axis = int(np.ptp(ElementHex2.doflocs[corners], axis=0).argmin())
        end = ElementHex2.doflocs[corners[0], axis]
        across, gauss = get_quadrature(RefQuad, INTEGRATION_ORDER)
        values, gradients = _shapes(np.insert(across, axis, end, axis=0))
        # 2. its area, by the cross product of the two directions along it
        points = body.points.T[numbers[cells]].transpose(0, 2, 1)
        first, second = (points @ gradients[:, k] for k in range(3) if k != axis)
        area = np.linalg.norm(np.cross(first, second, axis=1), axis=1)
        np.add.at(weights, numbers[cells], (area * gauss) @ values.T)
    return weights


def _is_boundary(mesh: MeshHex2) -> Nodes:
    boundary = np.zeros(mesh.facets.shape[1], dtype=np.bool_)
    boundary[mesh.boundary_facets()] = True
    return boundary


@LinearForm
def _one(v, w):  # type: ignore[no-untyped-def]
    return v


def block_matrix(body: HexMesh, blocks: Array) -> sparse.bsr_matrix:
    """Sum of the cells' blocks as a matrix of k x k blocks.

    Parameters
    ----------
    body : HexMesh
        the mesh
    blocks : Array
        of each cell, shape (cells, 27, 27, k, k) [any unit]

    Returns
    -------
    sparse.bsr_matrix
        matrix, shape (k n, k n) [unit of `blocks`]
    """
    numbers = body.numbers
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
    """Integrals of d_i phi_a d_j phi_b over each cell.

    Parameters
    ----------
    body : HexMesh
        the mesh

    Returns
    -------
    Array
        shape (cells, 27, 3, 27, 3) [m]
    """
    points, gauss = get_quadrature(ElementHex2.refdom, INTEGRATION_ORDER)
    reference = _shapes(points)[1]
    stretch = _stretch(body, reference)
    # d_i phi = d_k phi in the cube times dX_k/dx_i
    gradients = np.linalg.inv(stretch).transpose(0, 1, 3, 2) @ reference.transpose(2, 1, 0)
    columns = gradients.transpose(0, 3, 2, 1).reshape(len(stretch), 81, -1)
    volume = np.abs(np.linalg.det(stretch)) * gauss
    products = (columns * volume[:, None, :]) @ columns.transpose(0, 2, 1)
    return np.asarray(products.reshape(len(stretch), 27, 3, 27, 3))


def quadratic_line(nodes: Array, x: Array) -> tuple[NDArray[np.int64], Array]:
    """Quadratic shape functions of a line of nodes, ends and middles of cells in turn.

    Parameters
    ----------
    nodes : Array
        positions of the nodes, shape (2 cells + 1,) [any unit]
    x : Array
        positions to interpolate at, any shape [unit of `nodes`]

    Returns
    -------
    numbers
        nodes of the cell, shape (..., 3)
    values
        shape functions, shape (..., 3) [-]
    """
    cell = 2 * np.clip(np.searchsorted(nodes[2::2], x), 0, (nodes.size - 3) // 2)
    a, b, c = (nodes[cell + corner] for corner in range(3))
    values = [
        (x - b) * (x - c) / ((a - b) * (a - c)),
        (x - a) * (x - c) / ((b - a) * (b - c)),
        (x - a) * (x - b) / ((c - a) * (c - b)),
    ]
    return cell[..., None] + np.arange(3), np.stack(values, axis=-1)
