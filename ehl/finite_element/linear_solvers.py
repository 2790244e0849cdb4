"""Linear systems of the finite elements: sparse factors, and GMRES with a dense block."""

from collections.abc import Callable

import numpy as np
from scipy import sparse
from scipy.sparse import linalg

from ..arrays import Array

# of GMRES
RESTART = 80
RESTARTS = 3


class LinearSolverError(Exception):
    """The preconditioner could not be factored, or the iteration did not end."""


def solve_bordered(
    operator: Callable[[Array], Array],
    near: sparse.csr_matrix,
    border: tuple[Array, Array],
    right: tuple[Array, float],
    tolerance: float,
) -> tuple[Array, float]:
    """Solve [A b; w^T 0] [p; h] = [f; g] by GMRES (Saad and Schultz, 1986), A dense but known by
    its action; p, shape (n,), and h [-].

    The preconditioner is the same bordered system with A replaced by its near field, factored
    directly (SuperLU) and bordered by block elimination. border: b and w; right: f and g;
    tolerance: relative residual of the preconditioned system. LinearSolverError where the near
    field is singular or the iteration does not reach the tolerance.
    """
    column, row = border
    size = len(column) + 1
    try:
        factors = linalg.splu(near.tocsc())
    except RuntimeError as error:
        raise LinearSolverError(f"near field: {error}") from error
    response = factors.solve(column)
    schur = float(row @ response)
    if not np.isfinite(schur) or schur == 0.0:
        raise LinearSolverError("the load does not depend on the film: no node carries pressure")

    def product(v: Array) -> Array:
        return np.append(operator(v[:-1]) + column * v[-1], row @ v[:-1])

    def precondition(v: Array) -> Array:
        p = factors.solve(v[:-1])
        h = (row @ p - v[-1]) / schur
        return np.append(p - h * response, h)

    residuals: list[float] = []
    solution, failed = linalg.gmres(
        linalg.LinearOperator((size, size), matvec=product, dtype=np.float64),
        np.append(*right),
        M=linalg.LinearOperator((size, size), matvec=precondition, dtype=np.float64),
        rtol=tolerance,
        restart=RESTART,
        maxiter=RESTARTS,
        callback=residuals.append,
        callback_type="pr_norm",
    )
    if failed or not np.isfinite(solution).all():
        count = len(residuals)
        raise LinearSolverError(f"GMRES did not reach {tolerance:g} in {count} iterations")
    return solution[:-1], float(solution[-1])
