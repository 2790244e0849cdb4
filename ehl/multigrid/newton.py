"""Newton's method on the equations of the multigrid: it certifies a solved contact, and is a last
resort where cycles fail.

Unknowns are the pressure at all nodes and H0; the discrete equations are those of the cycles, with
upstream wedge, pressure on an open edge and exterior load. Cavitation is the semi-smooth equation
min(P, -L/d) = 0, d > 0 the diagonal: a step sets P = 0 where P + L/d <= 0 and L = 0 at the other
nodes (Hintermueller, Ito and Kunisch, 2002).

In the bordered linear systems [A b; w^T c] [p; h] = [f; g] of a pressure p and the approach h, A
holds the deflection of all nodes by all others and is known by its action only. GMRES (Saad and
Schultz, 1986) solves the system; the preconditioner is the same system with A replaced by its near
field, a sparse matrix, factored directly (SuperLU), kept while it serves, and bordered by block
elimination.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from math import inf
from typing import Any

import numpy as np
import scipy
from numpy.typing import NDArray

from ..arrays import Array
from ..solution import Certificate
from .cycle import refresh_factors, relative_residual, update_exterior, update_film
from .history import film_values
from .jacobian import Linearisation, deflected, linearise, load_row, near_field, product
from .levels import Multigrid

# GMRES: Krylov vectors before a restart, and restarts
RESTART = 80
RESTARTS = 3
PIVOT = 0.01  # of an ordering that is given: smallest diagonal taken as a pivot, over its column
LEAF = 60  # nodes that are not dissected further

# Beside each number what it changes, in sums over six contacts at 129 and 257 points, one of them
# from a Hertz pressure, the others after one to four cycles: deflections, then factorisations.
# of the residual, of the load and of the edge pressure [-]; round-off leaves 1e-13 to 1e-11
TOLERANCE = 1e-8
MAX_NODES = 300_000  # factors of more take gigabytes: 513 points with both halves have fewer
STEPS = 30  # 26 were needed at most by contacts that came to the tolerance
LINEAR_TOLERANCE = 1e-2  # of each step: a third 2 % less, 5 % more; three times 1 % less, 5 % less
PRESSURE_STEP = 0.5  # largest change of pressure in a step [-]: half 4 % more, double no change
LARGEST_FILM_LOSS = 0.7  # of the film in a step: half 1 % less, 0.9 no change
# the factors serve again if no pressure changed by more [-]: 0.02 7 % less, 25 % more; 0.1 1 %
# more, 6 % less
REUSE_STEP = 0.05
# and if GMRES took no more products: half 3 % less, 55 % more; double 21 % more, 10 % less
REUSE_PRODUCTS = 15

# residual at which a contact that is to be differentiated counts as solved [-]: at the solver's
# own stop stiffness and damping are 0.02 and 0.2 % off, at 1e-6 by less than 1e-5
POLISHED = 1e-6
POLISHING_STEPS = 4  # 2 were needed at most by solved contacts

Films = tuple[float, float]  # central and minimum film [-]


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
    near: "scipy.sparse.csr_matrix", border: Border, order: NDArray[np.intp] | None = None
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
            factors = scipy.sparse.linalg.splu(near.tocsc())
        else:
            factors = scipy.sparse.linalg.splu(
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
    solution, failed = scipy.sparse.linalg.gmres(
        scipy.sparse.linalg.LinearOperator((size, size), matvec=product, dtype=kind),
        np.append(*right).astype(kind),
        M=scipy.sparse.linalg.LinearOperator(
            (size, size), matvec=preconditioner.solve, dtype=kind
        ),
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


@dataclass(slots=True)
class _History:
    """History of the steps [-]."""

    residual: list[float] = field(default_factory=list)
    load: list[float] = field(default_factory=list)
    factors: int = 0

    def add(self, state: Multigrid, index: int, lin: Linearisation) -> bool:
        """Append the residuals of a linearised state; whether they are within the tolerance."""
        self.residual.append(relative_residual(state, index)[0])
        self.load.append(lin.load_error / state.contact.load)
        edge = float(np.abs(lin.residual[lin.edge]).max())
        # half of it: the edge takes its pressure from the film once more afterwards
        return max(self.residual[-1], abs(self.load[-1]), edge) < 0.5 * TOLERANCE


@dataclass(frozen=True, slots=True)
class Factored:
    """Preconditioner of some state, and the diagonal that scales the rows, shape (ny, nx) [-]."""

    preconditioner: Preconditioner  # of the linear systems
    diagonal: Array  # that scales the rows, shape (ny, nx) [-]


def certify(state: Multigrid, index: int | None = None) -> Certificate:
    """Polish a level by Newton's method until its discrete equations hold to 1e-8.

    Edge and load are among the equations. The state is changed to the solution; where none is
    reached it is restored. A flow model's factors are refreshed before each step, as before each
    cycle, so that their convergence is that of the cycles.

    Parameters
    ----------
    state : Multigrid
        levels of the contact, changed in place
    index : int | None, optional
        number of the level; None: the finest [-]

    Returns
    -------
    Certificate
        whether the equations hold, why not, and what changed
    """
    index = len(state.levels) - 1 if index is None else index
    level = state.levels[index]
    start = (level.P.copy(), state.approach)
    films = film_values(level.grid, level.H)
    before = state.deflections.get(index, 0)
    history = _History()
    with np.errstate(all="ignore"):  # a step that diverges may overflow
        if level.P.size > MAX_NODES:
            message = f"{level.P.size} nodes are more than the {MAX_NODES} that are factored"
        else:
            message = _newton(state, index, history)
    after = film_values(level.grid, level.H)
    if not message and not after[1] > 0.0:
        message = f"the equations hold, but with a minimum film of {after[1]:.1e}: mesh too coarse"
    if message:
        level.P, state.approach = start
        after = films
    _update_level(state, index)
    return Certificate(
        certified=not message,
        message=message or "the discrete equations hold",
        residual=tuple(history.residual),
        force_error=tuple(history.load),
        film_change=_relative_change(films, after),
        deflections=state.deflections[index] - before,
        factorisations=history.factors,
    )


def newton_polished(state: Multigrid, index: int) -> tuple[Linearisation, Factored]:
    """Solve a level by Newton steps to a residual of 1e-6, and factor its near field.

    Parameters
    ----------
    state : Multigrid
        levels of the contact, changed in place
    index : int
        number of the level, 0 the coarsest [-]

    Returns
    -------
    linearised
        linearised equations
    factored
        factors of the near field that serve for them

    Raises
    ------
    LinearSolverError
        if the steps do not lead there
    """
    history = _History()
    factored = None
    for _ in range(POLISHING_STEPS):
        refresh_factors(state, index)
        lin = linearise(state, index)
        if history.add(state, index, lin) or history.residual[-1] <= POLISHED:
            return lin, factored or factor(state, index, lin)
        factored = _step(state, index, lin, factored, history)
    raise LinearSolverError(f"Newton steps left a residual of {history.residual[-1]:.1e}")


def _relative_change(films: Films, after: Films) -> float:
    changes = [abs(new - old) for new, old in zip(after, films, strict=True)]
    return max(
        change / abs(new) if new else inf for change, new in zip(changes, after, strict=True)
    )


def _newton(state: Multigrid, index: int, history: _History) -> str:
    """Newton steps on a level, in place; why they failed, empty if they did not."""
    factored = None
    for step in range(STEPS + 1):
        refresh_factors(state, index)
        lin = linearise(state, index)
        if history.add(state, index, lin):
            return ""
        if not np.isfinite(history.residual[-1]):
            return "Newton's method diverged"
        if step < STEPS:
            try:
                factored = _step(state, index, lin, factored, history)
            except LinearSolverError as error:
                return f"a Newton step was not solved: {error}"
    return f"the residual is {history.residual[-1]:.1e} after {STEPS} Newton steps"


def _step(
    state: Multigrid, index: int, lin: Linearisation, reusable: Factored | None, history: _History
) -> Factored | None:
    """One step, in place; the factors it took, if they serve for the next."""
    before = state.deflections[index]
    # 1. linear system
    factored = reusable
    if factored is None:
        factored = factor(state, index, lin)
        history.factors += 1
    change, rise = _solved(state, index, lin, factored)
    products = state.deflections[index] - before
    # 2. share of its solution
    step_length = _step_length(lin, change, deflected(state, index, change) + rise)
    # 3. pressure, not negative inside, and approach
    level = state.levels[index]
    P = lin.P + step_length * change
    level.P = np.where(lin.edge, P, np.maximum(P, 0.0))
    state.approach += step_length * rise
    small = step_length == 1.0 and float(np.abs(change).max()) <= REUSE_STEP
    return factored if small and products <= REUSE_PRODUCTS else None


def dry_nodes(lin: Linearisation, diagonal: Array) -> NDArray[np.bool_]:
    """Mark the nodes inside that the next step sets to P = 0; behind an inlet film those not full.

    Parameters
    ----------
    lin : Linearisation
        linearised equations
    diagonal : Array
        diagonal of the derivative, shape (ny, nx) [-]

    Returns
    -------
    NDArray[np.bool_]
        True where the pressure vanishes, shape (ny, nx)
    """
    if lin.starved is not None:
        return ~lin.edge & lin.starved.empty
    return ~lin.edge & (lin.P - lin.residual / diagonal <= 0.0)


def factor(state: Multigrid, index: int, lin: Linearisation) -> Factored:
    """Factor the near field, rows over the diagonal, dry nodes left out.

    Parameters
    ----------
    state : Multigrid
        levels of the contact
    index : int
        number of the level, 0 the coarsest [-]
    lin : Linearisation
        linearised equations

    Returns
    -------
    Factored
        factors, and the diagonal that scales the rows
    """
    matrix = near_field(lin)
    diagonal = np.where(lin.edge, 1.0, -np.abs(matrix.diagonal()).reshape(lin.P.shape))
    dry = dry_nodes(lin, diagonal).ravel()
    rows = scipy.sparse.diags(np.where(dry, 0.0, 1.0 / diagonal.ravel()))
    columns = scipy.sparse.diags(np.where(dry, 0.0, 1.0))
    identity = scipy.sparse.diags(np.where(dry, 1.0, 0.0))
    # the wedge reaches two nodes upstream, the near field one node more
    reach = 2 if lin.couette[1] is None else 3
    order = nested_dissection(lin.P.shape, (reach, 3))
    row = load_row(state, index, lin.load_by_film).ravel()
    border = load_border(lin, diagonal, row)
    scaled = (rows @ matrix @ columns + identity).tocsr()
    return Factored(factor_bordered(scaled, border, order), diagonal)


def load_border(lin: Linearisation, diagonal: Array, row: Array) -> Border:
    """Assemble the derivative of the equations by H0, rows over the diagonal, and that of the
    load.

    Parameters
    ----------
    lin : Linearisation
        linearised equations
    diagonal : Array
        diagonal of the derivative, shape (ny, nx) [-]
    row : Array
        derivative of the load by the pressure, shape (ny nx,) [-]

    Returns
    -------
    Border
        border of the linear system [-]
    """
    by_approach = product(lin, np.zeros_like(lin.P), np.ones_like(lin.P)) / diagonal
    column = np.where(dry_nodes(lin, diagonal), 0.0, by_approach)
    return Border(column=column.ravel(), row=row, corner=lin.load_by_film)


def _solved(
    state: Multigrid, index: int, lin: Linearisation, factored: Factored
) -> tuple[Array, float]:
    """Newton change of the pressure, shape (ny, nx), and of H0 [-]."""
    diagonal = factored.diagonal
    dry = dry_nodes(lin, diagonal)

    def operator(p: Array) -> Array:
        change = p.reshape(lin.P.shape)
        scaled = product(lin, change, deflected(state, index, change)) / diagonal
        return np.where(dry, change, scaled).ravel()

    border = load_border(lin, diagonal, factored.preconditioner.border.row)
    right = np.where(dry, -lin.P, np.where(lin.edge, 1.0, -1.0) * lin.residual / diagonal)
    p, h = solve_bordered(
        operator,
        border,
        factored.preconditioner,
        (right.ravel(), lin.load_error),
        LINEAR_TOLERANCE,
    )
    # exactly zero where the step drops a node
    return np.where(dry, -lin.P, p.reshape(lin.P.shape)), h


def _step_length(lin: Linearisation, change: Array, growth: Array) -> float:
    """Share of a step that keeps the change of pressure and the loss of film small [-]."""
    thinner = (growth < 0.0) & (lin.H > 0.0)
    losses = LARGEST_FILM_LOSS * lin.H[thinner] / -growth[thinner]
    size = max(float(np.abs(change).max()), 1e-30)
    return min(1.0, PRESSURE_STEP / size, float(losses.min(initial=1.0)))


def _update_level(state: Multigrid, index: int) -> None:
    """Film, edge and exterior load that belong to the pressure of a level."""
    update_film(state, index)
    update_exterior(state, index)
