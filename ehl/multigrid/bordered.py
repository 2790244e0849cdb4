"""Bordered linear systems [A b; w^T c] [p; h] = [f; g]: a pressure p and the approach h.

A holds the deflection of all nodes by all others and is known by its action only. GMRES (Saad and
Schultz, 1986) solves the system; the preconditioner is the same system with A replaced by its near
field, a sparse matrix, factored directly (SuperLU) and bordered by block elimination.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse import linalg

from ..arrays import Array

# GMRES: Krylov vectors before a restart, and restarts
RESTART = 80
RESTARTS = 3
PIVOT = 0.01  # of an ordering that is given: smallest diagonal taken as a pivot, over its column
LEAF = 60  # nodes that are not dissected further


class LinearSolverError(Exception):
    """The preconditioner could not be factored, or the iteration did not end."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Border:
    """Column b and row w, shape (n,), and corner c of a bordered system [-]."""

    column: Array  # b, shape (n,) [-]
    row: Array  # w, shape (n,) [-]
    corner: float = 0.0  # c [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class Preconditioner:
    """Factors of the near field, and its response to the border's column [-]."""

    factors: Any  # sparse factors of SuperLU
    order: NDArray[np.intp] | None  # in which the unknowns were eliminated; None: SuperLU's own
    border: Border  # column, row and corner of the system
    response: Array  # of the near field to the column, shape (n,) [-]
    schur: float  # complement of the load [-]

    def solve(self, right: Array) -> Array:
        """Solve the bordered system with the near field in place of A.

        Parameters
        ----------
        right : Array
            f and g in one array, shape (n + 1,) [-]

        Returns
        -------
        Array
            pressure p and approach h in one array, shape (n + 1,) [-]
        """
        p = _solve(self.factors, self.order, right[:-1])
        h = (self.border.row @ p - right[-1]) / self.schur
        return np.append(p - h * self.response, h)


def factor_bordered(
    near: sparse.csr_matrix, border: Border, order: NDArray[np.intp] | None = None
) -> Preconditioner:
    """Factor the near field of a bordered system.

    Factors are in single precision where the order of elimination is given (three quarters of
    the time, half the memory and as many iterations), else in double precision.

    Parameters
    ----------
    near : sparse.csr_matrix
        near field of A, sparse, shape (n, n) [-]
    border : Border
        column, row and corner of the system [-]
    order : NDArray[np.intp] | None, optional
        order in which the unknowns are eliminated, shape (n,); None: that of SuperLU [-]

    Returns
    -------
    Preconditioner
        factors, and their response to the column of the border [-]

    Raises
    ------
    LinearSolverError
        if the near field is singular, or no node carries pressure
    """
    try:
        if order is None:
            factors = linalg.splu(near.tocsc())
        else:
            factors = linalg.splu(
                near[order][:, order].tocsc().astype(np.float32),
                permc_spec="NATURAL",
                diag_pivot_thresh=PIVOT,
                options={"SymmetricMode": True},
            )
    except RuntimeError as error:
        raise LinearSolverError(f"near field: {error}") from error
    response = _solve(factors, order, border.column)
    schur = float(border.row @ response) - border.corner
    if not np.isfinite(schur) or schur == 0.0:
        raise LinearSolverError("the load does not depend on the film: no node carries pressure")
    return Preconditioner(
        factors=factors, order=order, border=border, response=response, schur=schur
    )


def _solve(factors: Any, order: NDArray[np.intp] | None, right: Array) -> Array:
    if np.iscomplexobj(right):
        parts = (_solve(factors, order, part) for part in (right.real, right.imag))
        return np.asarray(next(parts) + 1j * next(parts))
    if order is None:
        return np.asarray(factors.solve(right))
    solution = np.empty_like(right)
    solution[order] = factors.solve(right[order].astype(np.float32))
    return solution


def solve_bordered(
    operator: Callable[[Array], Array],
    border: Border,
    preconditioner: Preconditioner,
    right: tuple[Array, float],
    tolerance: float,
) -> tuple[Array, float]:
    """Solve [A b; w^T c] [p; h] = [f; g] by GMRES (Saad and Schultz, 1986), A by its action.

    Both unknowns are complex where b is.

    Parameters
    ----------
    operator : Callable[[Array], Array]
        action of A on a pressure, from shape (n,) to shape (n,) [-]
    border : Border
        column b, row w and corner c [-]
    preconditioner : Preconditioner
        factors of the near field [-]
    right : tuple[Array, float]
        f, shape (n,), and g [-]
    tolerance : float
        relative residual of the preconditioned system [-]

    Returns
    -------
    p
        pressure, shape (n,) [-]
    h
        approach [-]

    Raises
    ------
    LinearSolverError
        if the iteration does not reach the tolerance
    """
    size = len(border.column) + 1
    kind = border.column.dtype

    def product(v: Array) -> Array:
        balance = border.row @ v[:-1] + border.corner * v[-1]
        return np.append(operator(v[:-1]) + border.column * v[-1], balance)

    residuals: list[float] = []
    solution, failed = linalg.gmres(
        linalg.LinearOperator((size, size), matvec=product, dtype=kind),
        np.append(*right).astype(kind),
        M=linalg.LinearOperator((size, size), matvec=preconditioner.solve, dtype=kind),
        rtol=tolerance,
        restart=RESTART,
        maxiter=RESTARTS,
        callback=residuals.append,
        callback_type="pr_norm",
    )
    if failed or not np.isfinite(solution).all():
        count = len(residuals)
        raise LinearSolverError(f"GMRES did not reach {tolerance:g} in {count} iterations")
    return solution[:-1], solution[-1].item()


def nested_dissection(shape: tuple[int, int], separator: tuple[int, int]) -> NDArray[np.intp]:
    """Order the nodes j nx + i of a rectangle for elimination, George (1973).

    Halves come first, the lines that separate them last.

    Parameters
    ----------
    shape : tuple[int, int]
        ny and nx, nodes of the rectangle [-]
    separator : tuple[int, int]
        lines and columns of a separator, as many as the stencil reaches to one side [-]

    Returns
    -------
    NDArray[np.intp]
        numbers of the nodes in the order of elimination, shape (ny nx,) [-]
    """
    number = np.arange(shape[0] * shape[1]).reshape(shape)
    parts: list[NDArray[np.intp]] = []
    _dissect(number, separator, parts)
    return np.concatenate(parts)


def _dissect(
    nodes: NDArray[np.intp], separator: tuple[int, int], parts: list[NDArray[np.intp]]
) -> None:
    sizes = [length - width for length, width in zip(nodes.shape, separator, strict=True)]
    axis = int(sizes[1] * separator[0] >= sizes[0] * separator[1])
    if nodes.size <= LEAF or sizes[axis] < 2:
        parts.append(nodes.ravel())
        return
    nodes = np.moveaxis(nodes, axis, 0)
    first = sizes[axis] // 2
    stop = first + separator[axis]
    for half in (nodes[:first], nodes[stop:]):
        _dissect(np.moveaxis(half, 0, axis), separator, parts)
    parts.append(nodes[first:stop].ravel())
