"""Newton's method on one mesh: pressures, H0 and the load together.

Cavitation is the semi-smooth equation min(P, -R/d) = 0, d the diagonal (Hintermueller, Ito and
Kunisch, 2002).
"""

from dataclasses import dataclass, field
from math import inf

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from ..arrays import Array
from ..grid import Grid
from ..multigrid.far_field import FarField, exterior_load
from ..multigrid.newton import Border, LinearSolverError, factor_bordered, solve_bordered
from ..scaling import ScaledContact
from ..solid.compliance import Compliance
from .reynolds import (
    Coefficients,
    Flow,
    coefficients,
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
