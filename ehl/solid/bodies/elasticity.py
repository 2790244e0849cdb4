r"""Linear elasticity on meshes of quadratic hexahedra, and its linear systems.

.. math:: \int \lambda\, \mathrm{div} u\, \mathrm{div} v + 2 \mu\, \varepsilon(u) : \varepsilon(v)

is put together from the products of gradients of the scalar shape functions, S_{ai,bj} = int d_i
phi_a d_j phi_b, cell by cell: K_{ai,bj} = lambda S_{ai,bj} + mu S_{aj,bi} + mu delta_ij S_{ak,bk}.
Linear hexahedra lock in the bending of rings; quadratic ones do not.

Meshes are images of boxes of parameters. The systems of elasticity and conduction are solved by
conjugate gradients preconditioned by smoothed aggregation (Vanek, Mandel and Brezina, 1996), else
by a sparse factorisation. With rigid-body modes as near-null space and block Gauss-Seidel as
smoother, quadratic elements take 22 to 60 iterations where no cell is long, slender rings up to
150. Small systems, and those that do not reach the tolerance, go to the factorisation.
"""

import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.linalg import qr
from scipy.sparse import linalg
from skfem import Basis, ElementHex2, LinearForm, MeshHex, MeshHex2, asm
from skfem.quadrature import get_quadrature
from skfem.refdom import RefQuad

from ...arrays import Array

Nodes = NDArray[np.bool_]

INTEGRATION_ORDER = 4  # three Gauss points a direction: exact for products of gradients in a box
SAME = 1e-9  # parameters closer than this count as one, relative to their range [-]

STRENGTH = 0.05  # of connection, symmetric; 0.25 multiplies the hierarchy by nine [-]
MAX_COARSE = 300
# a free ring of 1.25 mm under the groove takes 134, one on a rigid shaft 25
MAX_ITERATIONS = 400
# unknowns below which factors are cheaper: rings of 23 000 take 2.5 s by them, 4 to 13 s otherwise
DIRECT_BELOW = 30_000
# relative residual that counts as solved by factors, where the matrix is ill-conditioned [-]
FACTOR_TOLERANCE = 1e-7
FLOATING = 1e-9  # force of a rigid motion over the largest entry that is round-off [-]

TOLERANCE = 1e-8  # relative residual of the displacements [-]


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


try:
    import pyamg
except ImportError:  # no wheels for Linux on 64-bit ARM
    pyamg = None


class LinearSolution(NamedTuple):
    """Solutions of a system, their residual and the method."""

    values: Array  # shape (n, cases), or as the caller arranges it
    residual: float  # largest relative residual of the cases [-]
    iterations: int  # largest of the cases; 0 by factors
    method: str


class LinearSystemError(Exception):
    """Neither multigrid nor factors reached the tolerance."""


def solve_symmetric(
    matrix: Any, near_null: Array, right: Array, tolerance: float, *, multigrid: bool | None = None
) -> LinearSolution:
    """Solve a symmetric positive (semi-)definite system for several right-hand sides.

    Parameters
    ----------
    matrix : Any
        sparse, shape (n, n)
    near_null : Array
        modes of little energy, shape (n, modes), zero in fixed rows
    right : Array
        right-hand sides, shape (n, cases)
    tolerance : float
        largest relative residual [-]
    multigrid : bool | None, optional
        use multigrid; None: by the size of the system

    Returns
    -------
    LinearSolution
        solutions, shape (n, cases), and the work

    Raises
    ------
    LinearSystemError
        if the residual stays larger than the tolerance
    """
    if multigrid is None:
        multigrid = matrix.shape[0] >= DIRECT_BELOW
    if multigrid and pyamg is not None:
        solution = _by_multigrid(matrix, near_null, right, tolerance)
        if solution.residual <= 2.0 * tolerance:
            return solution
    solution = _by_factors(matrix, near_null, right)
    if not solution.residual <= max(tolerance, FACTOR_TOLERANCE):
        raise LinearSystemError(f"residual {solution.residual:.1e} of a sparse factorisation")
    return solution


def _residual(matrix: Any, values: Array, right: Array) -> float:
    scale = np.linalg.norm(right, axis=0)
    residual = np.linalg.norm(right - matrix @ values, axis=0)
    return float((residual / np.where(scale > 0.0, scale, 1.0)).max())


def _by_multigrid(matrix: Any, near_null: Array, right: Array, tolerance: float) -> LinearSolution:
    """One hierarchy, the right-hand sides one after the other."""
    name = "block_gauss_seidel" if isinstance(matrix, sparse.bsr_matrix) else "gauss_seidel"
    smoother = (name, {"sweep": "symmetric", "iterations": 1})
    hierarchy = pyamg.smoothed_aggregation_solver(
        matrix,
        B=near_null,
        symmetry="symmetric",
        strength=("symmetric", {"theta": STRENGTH}),
        smooth=("jacobi", {"omega": 4.0 / 3.0}),
        presmoother=smoother,
        postsmoother=smoother,
        improve_candidates=None,
        max_coarse=MAX_COARSE,
    )
    values = np.zeros_like(right)
    iterations = 0
    for case in range(right.shape[1]):
        history: list[float] = []
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of pyamg at round-off; the residual is checked
            values[:, case] = hierarchy.solve(
                right[:, case],
                tol=tolerance,
                maxiter=MAX_ITERATIONS,
                accel="cg",
                residuals=history,
            )
        iterations = max(iterations, len(history) - 1)
    return LinearSolution(
        values, _residual(matrix, values, right), iterations, "smoothed aggregation"
    )


def _by_factors(matrix: Any, near_null: Array, right: Array) -> LinearSolution:
    """Sparse factors; a little of the diagonal holds a body that nothing else holds."""
    csc = sparse.csc_matrix(matrix)
    free = _is_floating(csc, near_null)
    pinned = csc
    if free.any():
        scale = np.zeros(csc.shape[0])
        scale[_pins(near_null[:, free])] = csc.diagonal().max()
        pinned = csc + sparse.diags(scale, format="csc")
    factors = linalg.splu(
        pinned, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True}
    )
    values = factors.solve(right)
    values += factors.solve(right - pinned @ values)
    return LinearSolution(values, _residual(csc, values, right), 0, "factors")


def _is_floating(matrix: sparse.csc_matrix, modes: Array) -> NDArray[np.bool_]:
    """Modes that cost no force."""
    force = np.abs(matrix @ modes).max(axis=0)
    size = np.maximum(np.abs(modes).max(axis=0), 1e-300)
    return np.asarray(force <= FLOATING * np.abs(matrix.data).max() * size)


def _pins(modes: Array) -> NDArray[np.int32]:
    """Rows that determine the floating modes: pivots of a QR factorisation of the modes."""
    _, _, order = qr(modes.T, mode="economic", pivoting=True)
    return np.asarray(order[: modes.shape[1]])


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
