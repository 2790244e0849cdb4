"""One lubricated contact by finite elements and Newton's method: a check of the multigrid.

Unknowns are the nodal pressures on a graded rectangle mesh and the constant H0; equations are the
weak Reynolds equation with the cavitation condition (`reynolds.py`), the film H = H0 + gap +
compliance P (`solid/compliance.py`) and the load balance. The solution does not
depend on the start: Hertz, or pressure and film of another solution, such as the multigrid's.

Meshes have lines graded by halving, each mesh twice as many as the one before.

Newton's method on one mesh: pressures, H0 and the load together.

Cavitation is the semi-smooth equation min(P, -R/d) = 0, d the diagonal (Hintermueller, Ito and
Kunisch, 2002).
"""

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from math import cos, inf, nan, sin

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.interpolate import RegularGridInterpolator

from ..arrays import Array
from ..conditions import ContactConditions, MoesConditions
from ..grid import Grid, unfolded
from ..multigrid.far_field import FarField, exterior_load, far_field
from ..multigrid.film_values import second_order, with_status
from ..multigrid.full_multigrid import choose_domain
from ..multigrid.history import RESOLVED
from ..multigrid.newton import (
    Border,
    LinearSolverError,
    factor_bordered,
    nested_dissection,
    solve_bordered,
)
from ..options import SolverOptions
from ..scaling import ScaledContact, scale_contact
from ..solid.compliance import Compliance, Lattice, compliance, near_field
from ..solution import ContactSolution, ConvergenceRecord
from ..solver import at_load
from .reynolds import (
    Coefficients,
    Flow,
    coefficients,
    dual_lengths,
    flow_on,
    poiseuille_by_film,
    poiseuille_by_pressure,
    reynolds_residual,
)

ADVICE = "try more points"
STEPS = 100  # of Newton on each mesh
# change of pressure at a node [-] above which a step is refused and computed again over a shorter
# time. Of 28 contacts on 257 points none takes more than 23 steps on a mesh that converges so,
# M 1000, L 25, R_x/R_y 0.05 67 at 0.5, M 2000, L 28 52 where the time grows after 0.7 of it
PRESSURE_STEP = 0.3
LARGEST_FILM_LOSS = 0.7  # of the film at a node in a step
TOLERANCE = 1e-5  # of the last change of pressure [-]
# likewise where a node at the edge of the cavity alternates, so that changes fall no more, at M 5,
# L 10 from 2.7e-5 on; what the film changes by then belongs to its error bar
ALTERNATING = 5e-4
LINEAR_TOLERANCE = 1e-3  # of each Newton step
# Time steps, in units of a/u_m, of the transient through which the steady film is reached where a
# step of Newton would change the pressure by more than `PRESSURE_STEP`
TIME_STEP = 0.1  # the first
SMALLEST_TIME_STEP = 1e-4  # of one that is tried again
SHORTER = 3.0  # of the time step before over the next, where that one was too long
LONGER = 2.0  # of the next over the time step before, after half of `PRESSURE_STEP` at most
STEADY_STEP = 0.03  # change of pressure [-] below which the steady equations are solved
OTHER_DEFLECTIONS = (
    3  # of a step, in addition to those of GMRES: film, prescribed pressures, change
)
# fraction of a change that the next one reverses, above which only half of that is applied: at
# M 31, L 31, R_x/R_y 0.05 all of it was reversed, without end
REVERSED = 0.9
STALLED = 4  # steps at rest with a film that does not follow the pressure


@dataclass(slots=True)
class Level:
    """One mesh and the state on it; nodes numbered i ny + j, lengths in units of a [-]."""

    contact: ScaledContact
    X: Array
    Y: Array
    flow: Flow
    compliance: Compliance
    near_compliance: sparse.csr_matrix  # of neighbouring nodes, for the preconditioner
    elimination: NDArray[np.intp]  # order of the nodes in it
    gap: Array
    weights: Array  # integral of P = weights @ P, both halves
    areas: Array
    edge: NDArray[np.bool_]
    far: FarField | None  # edge pressure of an open box
    P: Array
    H: Array
    approach: float = 0.0

    @property
    def film(self) -> Array:
        """H0 + gap + deflection, shape (nodes,) [-]."""
        return self.approach + self.gap + self.compliance @ self.P

    @property
    def shape(self) -> tuple[int, int]:
        """Nodes along x and y."""
        return len(self.X), len(self.Y)

    @property
    def origin(self) -> int:
        """Number of the node next to (0, 0)."""
        return int(abs(self.X).argmin()) * len(self.Y) + int(abs(self.Y).argmin())


@dataclass(slots=True)
class Progress:
    """History of the Newton steps [-]."""

    residual: list[float] = field(default_factory=list)
    load: list[float] = field(default_factory=list)
    change: list[float] = field(default_factory=list)
    iterations: list[int] = field(default_factory=list)  # of GMRES
    deflected_nodes: int = 0  # by FFT, of all meshes together


@dataclass(frozen=True, slots=True)
class _Change:
    """One step of Newton's method [-]."""

    pressure: Array
    approach: float
    size: float  # of the largest change of pressure at a node
    time: float  # step of a transient; infinite: to the steady state


def newton(level: Level, progress: Progress) -> tuple[bool, str]:
    """Newton's method on one mesh, in place.

    Film and pressure are both unknowns, so that a film may stay positive where the start is not a
    solution of the film equation, which holds after one full step.

    Parameters
    ----------
    level : Level
        mesh and state; P, H and H0 are changed
    progress : Progress
        history of the steps, extended

    Returns
    -------
    converged
        the last change of pressure is below the tolerance
    message
        outcome in words
    """
    time_step = inf
    at_rest = 0
    size = inf
    before = np.zeros_like(level.P)
    first = len(progress.residual)
    while len(progress.residual) < first + STEPS:
        miss = level.film - level.H
        try:
            step = _short_enough(level, miss, progress, time_step)
        except LinearSolverError as error:
            return False, f"the linear system was not solved: {error}; {ADVICE} or a smaller load"
        last, size = size, step.size
        fraction = step_fraction(before, step.pressure)
        _advance(level, fraction * step.pressure, fraction * step.approach, miss, progress)
        before = step.pressure
        time_step = next_time_step(step.time, size)
        tolerance = ALTERNATING if size > 0.5 * last else TOLERANCE
        if size < tolerance and step.time == inf:
            overlap = float(np.abs(miss).max())
            at_rest += 1
            if overlap < TOLERANCE * level.contact.film_guess:
                return True, "converged"
            if at_rest > STALLED:
                return False, f"not converged: the bodies overlap between nodes; {ADVICE}"
    steps = f"in the last of {STEPS} Newton steps"
    return False, f"not converged: pressure changed by {size:.1e} {steps}; {ADVICE}"


def _short_enough(level: Level, miss: Array, progress: Progress, time_step: float) -> _Change:
    """Newton step that changes no pressure by more than `PRESSURE_STEP`.

    A larger step is computed again as one of a transient (backward Euler), so short that it is
    not; the transient grows into the steady state. If a shorter time makes the change larger, as
    with films that the bodies do not allow, the longer step is applied in part. Such a damping
    from the beginning fails: at M 50, L 28 the spike of a coarser mesh, a cell from its position,
    grew to 8 p_h in 100 steps; the transient needs 23.
    """
    step = _step(level, miss, progress, time_step)
    while step.size > PRESSURE_STEP and step.time > SMALLEST_TIME_STEP:
        shorter = _step(level, miss, progress, min(step.time / SHORTER, TIME_STEP))
        if shorter.size > step.size:
            break
        step = shorter
    return step


def step_fraction(before: Array, change: Array) -> float:
    """Fraction of a Newton step to apply: half where it reverses the one before, else all of it.

    Between two sets of wet nodes that lead to each other, the solution lies on neither.

    Parameters
    ----------
    before : Array
        change of pressure in the step before, shape (nodes,) [-]
    change : Array
        change of pressure, shape (nodes,) [-]

    Returns
    -------
    float
        0.5 or 1 [-]
    """
    back = -float(before @ change)
    return 0.5 if back > REVERSED * float(before @ before) else 1.0


def next_time_step(time_step: float, size: float) -> float:
    """Time step of the transient after a step: longer after a small change of pressure.

    Parameters
    ----------
    time_step : float
        of the step, in units of a/u_m [-]
    size : float
        largest change of pressure at a node [-]

    Returns
    -------
    float
        next time step, infinite for changes below `STEADY_STEP` [-]
    """
    if size < STEADY_STEP:
        return inf
    return LONGER * time_step if size < 0.5 * PRESSURE_STEP else time_step


def _advance(level: Level, change: Array, rise: float, miss: Array, progress: Progress) -> None:
    """One step; a pressure changes at most by `PRESSURE_STEP`, a film loses at most
    `LARGEST_FILM_LOSS` of itself.
    """
    before = level.H
    change = np.clip(change, -PRESSURE_STEP, PRESSURE_STEP)
    followed = before + rise + level.compliance @ change + miss
    level.P = level.P + change
    level.approach += rise
    level.H = np.maximum(followed, (1.0 - LARGEST_FILM_LOSS) * before)
    progress.change.append(float(np.abs(level.H / before - 1.0)[level.origin]))


def _step(level: Level, miss: Array, progress: Progress, time_step: float) -> _Change:
    """Newton change of pressure and of H0 [-]; `miss` is what the film of the pressure exceeds the
    film by.
    """
    # 1. Reynolds' equation and its derivatives
    k = coefficients(level.contact, level.P, level.H)
    residual = reynolds_residual(level.flow, k)
    squeeze = sparse.diags(level.areas / time_step)
    wedge = level.flow.wedge - squeeze
    by_pressure = poiseuille_by_pressure(level.flow, k) + wedge @ sparse.diags(k.q_P)
    by_film = poiseuille_by_film(level.flow, k) + wedge @ sparse.diags(k.q_H)
    # 2. nodes with a prescribed pressure: edge and cavitation
    by_deflection = by_film.diagonal() * level.compliance.diagonal
    scale = np.abs(by_pressure.diagonal()) + np.abs(by_deflection)
    fixed = level.edge | (level.P + residual / scale <= 0.0)
    target, exterior = edge_pressure(level)
    load = level.contact.load - exterior
    error = load - float(level.weights @ level.P)
    progress.residual.append(float(np.abs(np.where(fixed, 0.0, residual / scale)).max()))
    progress.load.append(abs(error) / load)
    change = np.where(fixed, target - level.P, 0.0)
    shifted = by_pressure @ change + by_film @ (level.compliance @ change + miss)
    # 3. solve for the free nodes, H0 and the load
    free = ~fixed

    calls = 0

    def operator(p: Array) -> Array:
        nonlocal calls
        calls += 1
        spread = np.zeros(len(free))
        spread[free] = p
        deflection = level.compliance.in_single_precision(spread)
        return (by_pressure @ spread + by_film @ deflection)[free]

    nearby = _near_matrix(level, k, by_pressure, by_film)[free][:, free]
    border = Border(column=np.asarray(by_film.sum(axis=1)).ravel()[free], row=level.weights[free])
    factors = factor_bordered(nearby, border, _elimination(level, free))
    right = (-(residual + shifted)[free], error - float(level.weights @ change))
    change[free], rise = solve_bordered(operator, border, factors, right, LINEAR_TOLERANCE)
    progress.iterations.append(calls)
    progress.deflected_nodes += (calls + OTHER_DEFLECTIONS) * len(level.P)
    return _Change(change, rise, float(np.abs(change).max()), time_step)


def _near_matrix(
    level: Level, k: Coefficients, by_pressure: sparse.csr_matrix, by_film: sparse.csr_matrix
) -> sparse.csr_matrix:
    """Newton's matrix with the near fields of deflection and wedge, for the preconditioner [-]."""
    nearer = level.flow.near_wedge - level.flow.wedge
    near_film = by_film + nearer @ sparse.diags(k.q_H)
    return by_pressure + nearer @ sparse.diags(k.q_P) + near_film @ level.near_compliance


def _elimination(level: Level, free: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Order of elimination of the free nodes, by their numbers among themselves."""
    order = level.elimination
    return (np.cumsum(free) - 1)[order[free[order]]]


def balance(level: Level) -> tuple[float, float]:
    """Equation error and mass imbalance of the discrete equations.

    sum |R| and sum R over the nodes that are neither cavitated nor on the edge, both over the
    sum of |integral of rho H U grad phi| there.

    Parameters
    ----------
    level : Level
        mesh and state

    Returns
    -------
    equation_error
        sum |R| over the flow [-]
    imbalance
        sum R over the flow, oil lost or gained [-]
    """
    k = coefficients(level.contact, level.P, level.film)
    fluid = ~level.edge & (level.P > 0.0)
    residual = reynolds_residual(level.flow, k)[fluid]
    flow = float(np.abs((level.flow.wedge @ k.q)[fluid]).sum())
    return float(np.abs(residual).sum()) / flow, float(residual.sum()) / flow


def edge_pressure(level: Level) -> tuple[Array, float]:
    """Pressure -(k X)/H^2 on the edge of an open box, Kapitza (1955), and its load.

    Parameters
    ----------
    level : Level
        mesh and state

    Returns
    -------
    pressure
        at the nodes, zero inside, shape (nodes,) [-]
    load
        integral of P outside the box [-]
    """
    H = level.H
    target = np.zeros_like(H)
    if level.far is None:
        return target, 0.0
    x, y = (values.ravel() for values in np.meshgrid(level.X, level.Y, indexing="ij"))
    target[level.edge] = (level.far.strength(x, y) / H**2)[level.edge]
    x_in = float(level.X[0])
    width = float(level.X[-1]) - x_in
    corners = Grid(x_in=x_in, hx=width, hy=float(level.Y[-1]), nx=2, ny=2, symmetric=True)
    inlet = np.full((2, 2), H[level.origin % len(level.Y)])
    return target, exterior_load(level.far, corners, inlet)


HALVINGS = 5  # at most, from the largest cell to the smallest
ROOTS = range(1, 33)  # numbers of largest cells that are tried
SIZE_FACTORS = (1.0, 1.2, 1.45, 1.7)  # of the size wanted, over the smallest cell
COARSE_SIZE_FACTORS = (2.0, 2.4, 2.9, 3.4)  # with a single largest cell: the coarsest meshes

Start = Callable[[Array, Array], tuple[Array, Array]]  # pressure and film at X, Y [-]

SMALLEST_FILM = 0.05  # of the film guess, where the start has none

CELLS_Y = 7 / 16  # across half the contact, per cell along it
# lines of nodes along and across whose compliance enters the preconditioner; with (3, 2) the inner
# race of a 6208 takes 80 % more time on 257 points, with (3, 1) 20 %
REACH = (3, 0)
# Cells along x in Hertz half extents, up to a factor. Twice FINEST, half INSIDE or an outlet from
# 0.35 change the films of the 6208's inner race on 65 lines by less than 0.1 %
FINEST = 0.1  # over the length of the inlet
INSIDE = 1 / 16  # largest inside the contact
OUTLET = (0.0, 1.2)  # ends of the finest region, through which the exit constriction runs
# across the half contact: over the length of the inlet, largest inside, ends of the finest region.
# The minimum film of M 2000, L 0 on 257 lines is within 4 % so, 8.7 % off with even cells of 1/40
SIDE_FINEST = 0.05
SIDE_INSIDE = 1 / 20
SIDE = (0.75, 1.0)
GROWTH = 0.12  # of the cells before and inside the contact, over the distance from the finest
OUTER_GROWTH = 0.25  # of those behind and at the side of it

Conditions = ContactConditions | MoesConditions

LEVELS = 3
POINTS = 257  # where the options leave them open
MAX_CELLS = 512  # along x
MAX_CELLS_SKEWED = 256  # of both halves
# loads through which a contact is reached without another solution to start from: M of the
# first, and the ratio of each to the one before
FIRST_LOAD = 50.0
LOAD_RATIO = 3.0
COARSEST = 32  # cells along x on which lighter loads are solved


def graded_lines(
    ends: tuple[float, float], cells: int, size: Callable[[Array], Array]
) -> NDArray[np.int_]:
    """Lines of a graded mesh on an equidistant lattice.

    Cells are halved until they are no longer than a multiple of `size`, the same for all; multiple
    and number of the largest cells are those whose number of cells comes closest to the desired
    one, which differs by a few.

    Parameters
    ----------
    ends : tuple[float, float]
        first and last position [-]
    cells : int
        desired number of cells
    size : Callable[[Array], Array]
        cell size up to a factor as a function of the position [-]

    Returns
    -------
    NDArray[np.int_]
        numbers of the lines on the lattice, the first zero, shape (lines,)
    """
    first, last = ends
    smallest = float(size(np.linspace(first, last, 1025)).min())
    candidates = []
    for roots in ROOTS:
        unit = (last - first) / (roots * 2**HALVINGS)
        factors = SIZE_FACTORS if roots > 1 else (*SIZE_FACTORS, *COARSE_SIZE_FACTORS)
        meshes = [_halved((first, unit), roots, size, s * unit / smallest) for s in factors]
        candidates += meshes
        if min(map(len, meshes)) > 2 * cells:  # still more with more of the largest cells
            break
    best = min(candidates, key=lambda lines: abs(len(lines) - 1 - cells))
    step = int(np.gcd.reduce(best))
    return best // step


def _halved(
    origin: tuple[float, float], roots: int, size: Callable[[Array], Array], factor: float
) -> NDArray[np.int_]:
    """Cells of 2^HALVINGS units, halved where they are longer than `factor` times the size wanted
    there; `origin` is the first line and the unit.
    """
    first, unit = origin
    lines = 2**HALVINGS * np.arange(roots + 1)
    for _ in range(HALVINGS):
        positions = lines[:-1, None] + np.diff(lines)[:, None] * np.linspace(0.0, 1.0, 9)
        wanted = factor * size(first + unit * positions).min(axis=1)
        long = np.diff(lines) * unit > 1.0001 * wanted
        lines = np.sort(np.concatenate((lines, (lines[:-1] + np.diff(lines) // 2)[long])))
    return lines


def refined(lines: NDArray[np.int_]) -> NDArray[np.int_]:
    """Lines on a lattice twice as fine, one more in the middle of each cell.

    Parameters
    ----------
    lines : NDArray[np.int_]
        numbers on the lattice, shape (n,)

    Returns
    -------
    NDArray[np.int_]
        numbers on the finer one, shape (2 n - 1,)
    """
    finer = np.empty(2 * len(lines) - 1, dtype=lines.dtype)
    finer[::2] = 2 * lines
    finer[1::2] = lines[:-1] + lines[1:]
    return finer


def hertz_start(contact: ScaledContact) -> Start:
    """Initial state by Hertz: his pressure, and a film of the guessed thickness in the ellipse.

    Parameters
    ----------
    contact : ScaledContact
        the dimensionless contact

    Returns
    -------
    Start
        function of X and Y; it returns P and H [-]
    """

    def start(x: Array, y: Array) -> tuple[Array, Array]:
        P = contact.dry_pressure(x, y)
        across = y / contact.half_extent_y
        outside = np.maximum(0.0, np.hypot(x / contact.half_extent_x, across) - 1.0)
        return P, contact.film_guess + contact.gap(x, y) * np.minimum(1.0, outside) ** 1.5

    return start


def start_from_level(level: Level) -> Start:
    """Initial state from the solution on another mesh in the same frame, bilinear between its
    nodes.

    Parameters
    ----------
    level : Level
        the other mesh and its state

    Returns
    -------
    Start
        function of X and Y; it returns P and H [-]
    """
    P, H = (_bilinear(level.X, level.Y, f.reshape(level.shape)) for f in (level.P, level.H))
    return lambda x, y: (P(x, y), H(x, y))


def start_from_solution(contact: ScaledContact, solution: ContactSolution) -> Start:
    """Initial state from a solution whose frame may be rotated, bilinear between its nodes.

    The pressure outside its box is zero.

    Parameters
    ----------
    contact : ScaledContact
        the dimensionless contact
    solution : ContactSolution
        another solution of the same contact

    Returns
    -------
    Start
        function of X and Y; it returns P and H [-]
    """
    turn = contact.frame_angle - solution.frame_angle
    c, s = cos(turn), sin(turn)
    P, H = (_bilinear(solution.X, solution.Y, f) for f in (solution.P, solution.H))
    least = SMALLEST_FILM * contact.film_guess
    ends = [(line[0], line[-1]) for line in (solution.X, solution.Y)]

    def start(x: Array, y: Array) -> tuple[Array, Array]:
        x, y = c * x - s * y, s * x + c * y
        outside = (x < ends[0][0]) | (x > ends[0][1]) | (y < ends[1][0]) | (y > ends[1][1])
        return np.where(outside, 0.0, np.maximum(P(x, y), 0.0)), np.maximum(H(x, y), least)

    return start


def _bilinear(X: Array, Y: Array, values: Array) -> Callable[[Array, Array], Array]:
    """Bilinear between nodes, continued outside."""
    inside = RegularGridInterpolator((X, Y), values, bounds_error=False, fill_value=None)
    return lambda x, y: np.asarray(inside(np.stack((x, y), axis=-1)))


def lattices(
    contact: ScaledContact, domain: tuple[float, float, float], cells: int, levels: int
) -> list[Lattice]:
    """Meshes from coarsest to finest, each with half the cells of the next.

    Parameters
    ----------
    contact : ScaledContact
        the dimensionless contact
    domain : tuple[float, float, float]
        x_in, x_out, y_half in Hertz half extents [-]
    cells : int
        approximate number of cells along x on the finest mesh
    levels : int
        number of meshes

    Returns
    -------
    list[Lattice]
        the meshes, the finest last
    """
    x_in, x_out, y_half = domain
    coarsest = cells // 2 ** (levels - 1)
    inlet = inlet_length(contact)
    i = graded_lines((x_in, x_out), coarsest, lambda s: cell_along(s, inlet))
    j = graded_lines(
        (0.0, y_half), max(2, round(CELLS_Y * coarsest)), lambda s: cell_across(s, inlet)
    )
    meshes = []
    for _ in range(levels):
        x = (x_in + (x_out - x_in) * i / i[-1]) * contact.half_extent_x
        y = y_half * j / j[-1] * contact.half_extent_y
        if contact.symmetric:
            meshes.append(Lattice(x, y, i, j, symmetric=True))
        else:
            both = j[-1] + np.concatenate((-j[:0:-1], j))
            meshes.append(Lattice(x, unfolded(y, sign=-1.0), i, both, symmetric=False))
        i, j = refined(i), refined(j)
    return meshes


def inlet_length(contact: ScaledContact) -> float:
    """Length over which the gap before the Hertz contact reaches the film, (Hc/(S A^2))^(2/3).

    The gap grows with the power 3/2 of the distance.

    Parameters
    ----------
    contact : ScaledContact
        the dimensionless contact

    Returns
    -------
    float
        length in half extents of the Hertz ellipse [-]
    """
    height = contact.curvature_x * contact.half_extent_x**2
    return float((contact.film_guess / height) ** (2 / 3))


def cell_along(s: Array, inlet: float) -> Array:
    """Cell along x up to a factor: finest at the end of the inlet and at the outlet.

    Parameters
    ----------
    s : Array
        positions in half extents of the Hertz ellipse, any shape [-]
    inlet : float
        length of the inlet, likewise [-]

    Returns
    -------
    Array
        cell size, shape of `s` [-]
    """
    finest = min(FINEST * inlet, INSIDE)
    before = np.maximum(0.0, -1.0 - inlet - s)
    after = np.maximum(0.0, s - OUTLET[1])
    between = np.maximum(0.0, np.minimum(s + 1.0 - inlet, OUTLET[0] - s))
    inside = np.minimum(INSIDE, finest + GROWTH * between)
    return np.asarray(inside + GROWTH * before + OUTER_GROWTH * after)


def cell_across(s: Array, inlet: float) -> Array:
    """Cell across the half contact up to a factor: finest at the side, where the film is thinnest.

    Parameters
    ----------
    s : Array
        positions in half extents of the Hertz ellipse, any shape [-]
    inlet : float
        length of the inlet, likewise [-]

    Returns
    -------
    Array
        cell size, shape of `s` [-]
    """
    finest = min(SIDE_FINEST * inlet, SIDE_INSIDE / 2.0)
    inside = np.maximum(0.0, SIDE[0] - s)
    outside = np.maximum(0.0, s - SIDE[1])
    size = np.minimum(SIDE_INSIDE, finest + GROWTH * inside)
    return np.asarray(size + OUTER_GROWTH * outside)


def level_on(contact: ScaledContact, mesh: Lattice, is_open: bool, start: Start) -> Level:
    """One mesh with everything that does not change in the iteration.

    Parameters
    ----------
    contact : ScaledContact
        the dimensionless contact
    mesh : Lattice
        lines of the mesh
    is_open : bool
        the pressure on the edge of the box is that of the flow outside
    start : Start
        initial pressure and film

    Returns
    -------
    Level
        mesh, operators and initial state
    """
    X, Y = mesh.x, mesh.y
    areas = np.outer(dual_lengths(X), dual_lengths(Y)).ravel()
    x, y = (values.ravel() for values in np.meshgrid(X, Y, indexing="ij"))
    side = y == Y[-1] if contact.symmetric else (y == Y[0]) | (y == Y[-1])
    gap = contact.gap(x, y)
    operator = compliance(mesh, contact.deformation, contact.coating)
    P, H = start(x, y)
    level = Level(
        contact=contact,
        X=X,
        Y=Y,
        flow=flow_on(X, Y, contact),
        compliance=operator,
        near_compliance=near_field(mesh, REACH, contact.deformation, contact.coating),
        elimination=nested_dissection((len(X), len(Y)), (REACH[0] + 1, REACH[1] + 1)),
        gap=gap,
        areas=areas,
        weights=(2.0 if contact.symmetric else 1.0) * areas,
        edge=(x == X[0]) | (x == X[-1]) | side,
        far=far_field(contact) if is_open else None,
        P=P,
        H=H,
    )
    level.approach = float((H - gap - operator @ P)[level.origin])
    return level


@dataclass(slots=True)
class Attempt:
    """The meshes solved so far: the last one, films of those that converged, and the outcome."""

    level: Level
    films: list[tuple[float, float, float]]  # central and minimum, and H0 [-]
    converged: bool
    message: str


def solve_contact_finite_element(
    conditions: Conditions,
    options: SolverOptions | None = None,
    start: ContactSolution | None = None,
) -> ContactSolution:
    """Pressure and film of a steady, isothermal, flooded elliptical point contact by finite
    elements.

    The nodes of the finest mesh are not equidistant; cycles are Newton steps on all meshes.
    Newton's method starts from the pressure and film of `start`, else from Hertz, through lighter
    loads where the contact is heavy; neither enters the discrete equations. `points` asks for
    about (points + 1)/2 nodes along x, at most 513 (257 over both halves): the mesh is graded.
    Without `domain` the open box is that of `choose_domain`; `tolerance` and `max_cycles`
    are not used.

    Parameters
    ----------
    conditions : Conditions
        the contact, in SI or by Moes' groups
    options : SolverOptions | None, optional
        mesh; None: the defaults
    start : ContactSolution | None, optional
        another solution of the same contact; None: from Hertz

    Returns
    -------
    ContactSolution
        pressure and film with error bars; see `converged` and `message`

    Raises
    ------
    ValueError
        if conditions contain an inlet layer: mass is not conserved behind one here

    Examples
    --------
    >>> from oilfilm import Lubricant, MoesConditions, SolverOptions
    >>> from oilfilm import solve_contact_finite_element
    >>> oil = Lubricant(viscosity=0.04, pressure_viscosity=22e-9)
    >>> contact = MoesConditions(load_parameter=20.0, lubricant_parameter=5.0, lubricant=oil)
    >>> solution = solve_contact_finite_element(contact, SolverOptions(points=65))
    >>> solution.converged, f"{solution.film_central_dimensionless.value:.2f}"
    (True, '0.31')
    """
    options = options or SolverOptions()
    if conditions.inlet_layer is not None:
        raise ValueError("inlet_layer: the finite elements solve flooded films only")
    start_time = time.perf_counter()
    contact = scale_contact(conditions, along_entrainment=True)
    domain = options.domain or choose_domain(contact)
    is_open = options.domain is None
    most = MAX_CELLS if contact.symmetric else MAX_CELLS_SKEWED
    cells = min(((options.points or POINTS) - 1) // 2, most)
    progress = Progress()
    if start is not None and np.isfinite(start.P).all():
        initial = start_from_solution(contact, start)
    else:
        initial = _through_loads(conditions, domain, is_open, progress)
    attempt = _refine(contact, domain, cells, is_open, initial, progress)
    wall_time = time.perf_counter() - start_time
    return _solution(conditions, options, attempt, domain, _record(attempt, progress, wall_time))


def _through_loads(
    conditions: Conditions, domain: tuple[float, float, float], is_open: bool, progress: Progress
) -> Start:
    """Start from the next lighter load on a coarse mesh, itself reached in steps from Hertz."""
    heavy = scale_contact(conditions, along_entrainment=True)
    fractions = []
    load = FIRST_LOAD
    while load < heavy.moes_load:
        fractions.append(load / heavy.moes_load)
        load *= LOAD_RATIO
    initial = None
    for fraction in fractions:
        lighter = scale_contact(at_load(conditions, fraction), along_entrainment=True)
        initial = initial or hertz_start(lighter)
        attempt = _refine(lighter, domain, COARSEST, is_open, initial, progress, levels=1)
        if attempt.converged:
            initial = start_from_level(attempt.level)
    return initial or hertz_start(heavy)


def _refine(
    contact: ScaledContact,
    domain: tuple[float, float, float],
    cells: int,
    is_open: bool,
    initial: Start,
    progress: Progress,
    levels: int = LEVELS,
) -> Attempt:
    """Solve on each mesh.

    After a mesh that does not converge the next one starts from the same state.
    """
    films: list[tuple[float, float, float]] = []
    for mesh in lattices(contact, domain, cells, levels):
        level = level_on(contact, mesh, is_open, initial)
        converged, message = newton(level, progress)
        if converged:
            films.append((_central(level), _minimum(level), level.approach))
            initial = start_from_level(level)
        else:
            films = []
    return Attempt(level, films, converged, message)


def _record(attempt: Attempt, progress: Progress, wall_time: float) -> ConvergenceRecord:
    equation_error, imbalance = balance(attempt.level)
    return ConvergenceRecord(
        residual=(equation_error,),
        force_error=tuple(progress.load),
        film_change=tuple(progress.change),
        cycles=len(progress.residual),
        fft_equivalents=progress.deflected_nodes / len(attempt.level.P),
        fallbacks=(),
        wall_time=wall_time,
        mass_imbalance=imbalance,
    )


def _central(level: Level) -> float:
    """Film at (0, 0), cubic between the four nearest lines [-]."""
    H = level.H.reshape(level.shape)[:, int(abs(level.Y).argmin())]
    nearest = np.argsort(abs(level.X))[:4]
    return float(np.polynomial.Polynomial.fit(level.X[nearest], H[nearest], 3)(0.0))


def _minimum(level: Level) -> float:
    """Smallest film [-]: minimum of a quadratic through the smallest node and its neighbours."""
    X, Y, H = _whole_box(level, level.H)
    i, j = np.unravel_index(H.argmin(), H.shape)
    least = float(H[i, j])
    if not (0 < i < len(X) - 1 and 0 < j < len(Y) - 1):
        return least
    rows, columns = slice(i - 1, i + 2), slice(j - 1, j + 2)
    along = (X[rows] - X[i]) / (X[i + 1] - X[i - 1])
    across = (Y[columns] - Y[j]) / (Y[j + 1] - Y[j - 1])
    u, v = (offset.ravel() for offset in np.meshgrid(along, across, indexing="ij"))
    terms = np.stack((u**2, v**2, u * v, u, v), axis=1)
    fit = np.linalg.lstsq(terms, H[rows, columns].ravel() - least, rcond=None)[0]
    hessian = np.array([[2 * fit[0], fit[2]], [fit[2], 2 * fit[1]]])
    slope = fit[3:]
    if fit[0] <= 0.0 or np.linalg.det(hessian) <= 0.0:
        return least
    offset = -np.linalg.solve(hessian, slope)
    return least + 0.5 * float(slope @ offset) if np.abs(offset).max() <= 0.5 else least


def _whole_box(level: Level, values: Array) -> tuple[Array, Array, Array]:
    """X, Y and a nodal field over the whole box, shape (nx, ny)."""
    values = values.reshape(level.shape)
    if not level.contact.symmetric:
        return level.X, level.Y, values
    return level.X, unfolded(level.Y, sign=-1.0), unfolded(values, axis=1)


def _solution(
    conditions: Conditions,
    options: SolverOptions,
    attempt: Attempt,
    domain: tuple[float, float, float],
    record: ConvergenceRecord,
) -> ContactSolution:
    level = attempt.level
    contact = level.contact
    X, Y, H = _whole_box(level, level.H)
    films = attempt.films or [(nan, nan, nan)]
    central, minimum, approach = zip(*films, strict=True)
    noise = record.film_change[-1]
    fineness = _fineness(X, H, minimum[-1], contact)
    resolved = attempt.converged and fineness >= RESOLVED
    message = attempt.message
    if attempt.converged and not resolved:
        ratio = f"minimum film/(mesh size)^2 is {fineness:.2f}, below {RESOLVED:g}"
        message = f"converged but unresolved: {ratio}"
    solution = ContactSolution(
        conditions=conditions,
        options=options,
        X=X,
        Y=Y,
        P=_whole_box(level, level.P)[2],
        H=H,
        film_central_dimensionless=second_order(central[-2:], noise),
        film_minimum_dimensionless=second_order(minimum[-2:], noise),
        approach_dimensionless=second_order(approach[-2:], noise),
        **contact.of_solution,
        domain=domain,
        resolved=resolved,
        converged=attempt.converged,
        message=message,
        record=record,
    )
    return with_status(solution)


def _fineness(X: Array, H: Array, minimum: float, contact: ScaledContact) -> float:
    """Hmin/(S hx^2) with the mesh size hx at the minimum [-]."""
    at = min(int(np.unravel_index(H.argmin(), H.shape)[0]), len(X) - 2)
    return minimum / (contact.curvature_x * float(X[at + 1] - X[at]) ** 2)
