"""Newton's method on the equations of the multigrid: it certifies a solved contact, and is a last
resort where cycles fail.

Unknowns are the pressure at all nodes and H0; the discrete equations are those of the cycles, with
upstream wedge, pressure on an open edge and exterior load. Cavitation is the semi-smooth equation
min(P, -L/d) = 0, d > 0 the diagonal: a step sets P = 0 where P + L/d <= 0 and L = 0 at the other
nodes (Hintermueller, Ito and Kunisch, 2002). Its linear system is solved by GMRES, the deflection
by FFT, with sparse factors of the near field as preconditioner, which are kept while they serve.
"""

from dataclasses import dataclass, field
from math import inf

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from ..arrays import Array
from ..solution import Certificate
from .bordered import (
    Border,
    LinearSolverError,
    Preconditioner,
    factor_bordered,
    nested_dissection,
    solve_bordered,
)
from .cycle import refresh_factors, relative_residual, update_exterior, update_film
from .history import film_values
from .jacobian import Linearisation, deflected, linearise, load_row, near_field, product
from .levels import Multigrid

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
    rows = sparse.diags(np.where(dry, 0.0, 1.0 / diagonal.ravel()))
    columns = sparse.diags(np.where(dry, 0.0, 1.0))
    identity = sparse.diags(np.where(dry, 1.0, 0.0))
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
