"""Linear systems of elasticity and conduction: conjugate gradients preconditioned by smoothed
aggregation (Vanek, Mandel and Brezina, 1996), else a sparse factorisation.

With rigid-body modes as near-null space and block Gauss-Seidel as smoother, quadratic elements
take 22 to 60 iterations where no cell is long, slender rings up to 150. Small systems, and those
that do not reach the tolerance, go to the factorisation.
"""

import warnings
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.linalg import qr
from scipy.sparse import linalg

from ...arrays import Array

try:
    import pyamg
except ImportError:  # no wheels for Linux on 64-bit ARM
    pyamg = None

STRENGTH = 0.05  # of connection, symmetric; 0.25 multiplies the hierarchy by nine [-]
MAX_COARSE = 300
# a free ring of 1.25 mm under the groove takes 134, one on a rigid shaft 25
MAX_ITERATIONS = 400
# unknowns below which factors are cheaper: rings of 23 000 take 2.5 s by them, 4 to 13 s otherwise
DIRECT_BELOW = 30_000
# relative residual that counts as solved by factors, where the matrix is ill-conditioned [-]
FACTOR_TOLERANCE = 1e-7
FLOATING = 1e-9  # force of a rigid motion over the largest entry that is round-off [-]


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
