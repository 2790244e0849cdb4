"""Full multigrid of one contact, Venner and Lubrecht (2000): the open box of its film and load,
the levels, and a list of attempts with other settings where one fails.

On a level cycles run until the film is at rest; a cycle that diverges is undone and repeated with
more damping. Cycles that converge slowly or oscillate are accelerated: the cycle is a fixed-point
map x -> g(x) of x = (P, H0). Anderson (1965) takes the combination of the last cycles whose
residual g(x) - x would be the smallest if the map were linear (Walker and Ni, 2011): GMRES on the
linearised equations with the cycle as preconditioner, without derivatives.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from math import ceil, inf, sqrt

import numpy as np
import scipy

from ..arrays import Array
from ..closed_form.hertz import hertz_deflection
from ..grid import grid_hierarchy, interpolate_cubic, interpolate_linear
from ..options import SolverOptions
from ..scaling import ScaledContact
from ..solution import Certificate, FilmValue
from .cycle import (
    cycle,
    inlet_film_at_centre,
    refresh_factors,
    relative_residual,
    start_level,
    update_film,
)
from .far_field import FarField, deflection_outside, far_field, load_outside
from .history import CONVERGED, FILMS, RESOLVED, LevelHistory, central_film, start_history
from .levels import Damping, FlowModel, Multigrid, make_multigrid
from .newton import certify
from .threads import Threads

DEPTH = 6  # cycles in the combination
CONDITION = 1e-8  # relative singular value below which a direction is dropped

MORE_CYCLES = 3  # times those allowed, on a finest level that is nearing its solution then
LEVEL_CYCLES = 3  # cycles on levels that the mesh does not resolve
# pressure P above which the iteration has diverged: the spike of a Barus oil at L 20 passes 5
PRESSURE_LIMIT = 40.0
# growth of the residual in one cycle above which it has, too, if the equations no longer hold
GROWTH_LIMIT = 10.0
# on a level, before the cycles are accelerated; those that swing are from the second on
PLAIN_CYCLES = 5
DIVERGED = (inf, inf)  # in place of residual and mass imbalance after a cycle
# between two evaluations of a flow model, which costs several: 12 contacts with heat took 18 s of
# processor with one, 14 with two. The continuation has one: with two an Eyring film of 17 m/s on
# 257 points, which rolls, stayed at a residual of 5e-4
FLOW_CYCLES = 2
HALVINGS = 3  # of the damping on one level before it counts as diverged

Snapshot = tuple[Array, float, float, float]

# along x on the coarsest grid, which may be far too coarse for the film: it only balances the load
COARSEST_CELLS = 16
# full multigrid starts where hx is below 0.2 semi-axes or 0.55 sqrt(Hc), careful attempts where
# Hc/(S hx^2) is above the last
STARTING_MESH = (0.2, 0.55)
CAREFUL_FINENESS = 15.0
# M above which every attempt is careful, and above which with less Gauss-Seidel, too
HEAVY_LOAD = (1e4, 2e4)
# L, and ratio of the axes along and across the grid's X, above which the mesh across is twice as
# wide with half the Gauss-Seidel: the spike is a node wide, and on a mesh finer across than along
# cycles blow it up; the usual mesh has a quarter then. Of 11 contacts (D 1.9 to 5, L above 19) no
# one came to rest without an undone cycle on the usual mesh and damping, 9 on this
SPIKE = (15.0, 1.3)
COARSE_LEVEL_CYCLES = 12  # most cycles on the other levels below the finest
# Hmin/(S hx^2) from which a flow model acts on the level below the finest; it does on the finest
MIN_FINENESS = 1.0
FLOW_STRICTNESS = 2.5  # on what cycles leave with a flow model on levels below the finest
ACCEPTED_ERROR = 5e-3  # of the film, left by the cycles; above, further attempts are made
# deflections after which no further attempt is made, of the finest mesh or of the second, which
# takes a minute for them, if that is finer; and those that an attempt is counted for in advance
MAX_WORK = 300
WORK_MESH = 1025**2  # [nodes]
ATTEMPT_WORK = 60
NEWTON_NODES = 70_000  # at most, of Newton's method on every level: twice as many take minutes
# the origin is a node of the level with this many cells along x, and of all finer ones
ORIGIN_CELLS = 32

TOO_MUCH_WORK = "not tried, too much work"
DAMPED = Damping(jacobi=0.175)
CAUTIOUS = replace(Damping().halved(), switch=1.5)

Box = tuple[float, float, float]

# Open box in Hertz half-extents: root of the sum of a square and a factor on film/curvature, the
# square of a length of the gap; `python benchmarks/open_box.py` halves and doubles each
INLET = (2.5, 169.0)
OUTLET = (1.35, 2.0)
SIDE = (1.6, 40.0, 120.0)  # the last times v^2, as an oblique side is an inlet, too
EXTERIOR_FRACTION = 0.1  # of the load; a box is widened until less than this lies outside
LARGEST_WIDENING = 4.0
# interval of the widening around 1, in which a box changes from one of its film to one of its load
# without a bend, which splines over the load of tables would not follow
TRANSITION = 0.15
# over the share of the load outside, by boxes of twice the size around 90 random contacts:
# relative error of the films, that of H0 over 1 + Hc, and what the square of the rotation's speed
# over u_m at b (1 + 2 Hc/(T b^2)) adds to both, T the gap's curvature across; a film without end
# that is turned has no limit
BOX_ERROR = 0.02
BOX_ERROR_ROTATION = 5.0


@dataclass(slots=True, kw_only=True)
class Acceleration:
    """Iterates of the last cycles [-]."""

    starts: list[Array] = field(default_factory=list)  # x
    ends: list[Array] = field(default_factory=list)  # g(x)
    weight: float = 1.0  # of the approach, which moves the film of every node

    def next(self, before: tuple[Array, float], after: tuple[Array, float]) -> tuple[Array, float]:
        """Combine the last cycles to the iterate that starts the next one, Walker and Ni (2011).

        Parameters
        ----------
        before : tuple[Array, float]
            pressure, shape (ny, nx), and approach H0 before the last cycle [-]
        after : tuple[Array, float]
            pressure, shape (ny, nx), and approach H0 after it [-]

        Returns
        -------
        tuple[Array, float]
            pressure, shape (ny, nx), and approach H0 to start the next cycle from [-]
        """
        if not self.ends:
            self.weight = float(np.sqrt(np.count_nonzero(after[0]) + 1.0))
        weight = self.weight
        # 1. iterates and residuals of the last cycles
        self.starts = [*self.starts, _vector(before, weight)][-DEPTH:]
        self.ends = [*self.ends, _vector(after, weight)][-DEPTH:]
        residuals = [g - x for x, g in zip(self.starts, self.ends, strict=True)]
        if len(residuals) < 2:
            return after
        # 2. combination with the smallest residual, Walker and Ni (2011), unconstrained form
        steps = np.stack([r - residuals[-1] for r in residuals[:-1]], axis=1)
        factors = np.linalg.lstsq(steps, -residuals[-1], rcond=CONDITION)[0]
        # 3. the same combination of the ends
        differences = np.stack([g - self.ends[-1] for g in self.ends[:-1]], axis=1)
        result = self.ends[-1] + differences @ factors
        return np.maximum(result[:-1].reshape(after[0].shape), 0.0), float(result[-1] / weight)


def _vector(state: tuple[Array, float], weight: float) -> Array:
    return np.append(state[0].ravel(), weight * state[1])


@dataclass(slots=True, kw_only=True)
class Progress:
    """Work and fallbacks of a contact so far, over all attempts and the pilot solve [-]."""

    fallbacks: list[str] = field(default_factory=list)  # in the order in which they were taken
    deflected_nodes: int = 0  # nodes times deflection FFTs


def iterate_level(
    state: Multigrid,
    index: int,
    most: int,
    progress: Progress,
    below: LevelHistory | None,
    strictness: float = 1.0,
) -> LevelHistory | None:
    """Cycle on a level until its film is at rest.

    At most `LEVEL_CYCLES` cycles where the mesh is too coarse for the film. On the finest level of
    a Newtonian isothermal film the cycles end when the residual stalls, and go on up to
    `MORE_CYCLES` times as often while it falls.

    Parameters
    ----------
    state : Multigrid
        levels of the contact, changed in place
    index : int
        number of the level, 0 the coarsest [-]
    most : int
        largest number of cycles [-]
    progress : Progress
        work and fallbacks so far, changed in place
    below : LevelHistory | None
        history of the next coarser level; None: there is none
    strictness : float, default 1.0
        factor on the limits that end the cycles, see `SolverOptions` [-]

    Returns
    -------
    LevelHistory | None
        history of the cycles; None if they diverged
    """
    level = state.levels[index]
    history = start_history(state, index, strictness)
    acceleration = Acceleration()
    before = (level.P.copy(), state.approach)
    finest = index == len(state.levels) - 1
    longest = MORE_CYCLES * most if finest and state.flow_model is None else most
    accelerated = state.flow_model is None or state.flow_model.accelerated
    for equations in guarded_cycles(state, index, longest, progress):
        if equations == DIVERGED:
            return None
        history.record(state, index, equations)
        cycles = len(history.residual)
        if history.finished(below) or (
            cycles >= LEVEL_CYCLES and not finest and not history.resolved
        ):
            break
        if finest and state.flow_model is None and history.stalled:
            break
        if cycles >= most and not history.approaching_solution:
            break
        state.oscillates |= history.oscillates
        swings = history.hovers and history.residual_grew
        pays = state.oscillates or (cycles > PLAIN_CYCLES and not swings)
        if accelerated and pays and cycles != most:
            if history.residual_grew and not state.oscillates:
                acceleration = Acceleration()  # a combination that does harm is forgotten
            mixed, state.approach = acceleration.next(before, (level.P, state.approach))
            level.P = mixed if level.film_content is None else np.where(level.P > 0.0, mixed, 0.0)
            update_film(state, index)
        before = (level.P.copy(), state.approach)
    return history


def guarded_cycles(
    state: Multigrid, index: int, count: int, progress: Progress
) -> Iterator[tuple[float, float]]:
    """Run cycles on a level; one that diverges is undone and repeated with half the damping.

    If three halvings do not help, the last item is `DIVERGED`.

    Parameters
    ----------
    state : Multigrid
        levels of the contact, changed in place
    index : int
        number of the level, 0 the coarsest [-]
    count : int
        number of cycles [-]
    progress : Progress
        work and fallbacks so far, changed in place

    Yields
    ------
    Iterator[tuple[float, float]]
        residual and imbalance of `relative_residual` after each cycle [-]
    """
    last = inf
    halvings = 0
    cycles = 0
    while cycles < count:
        before = snapshot(state, index)
        equations = guarded_cycle(state, index, last, FLOW_CYCLES)
        if equations == DIVERGED:
            restore(state, index, before)
            if halvings == HALVINGS:
                yield DIVERGED
                return
            halvings += 1
            state.damping = state.damping.halved()
            progress.fallbacks.append("cycle undone, damping halved")
            continue
        last = equations[0]
        cycles += 1
        yield equations


def snapshot(state: Multigrid, index: int) -> Snapshot:
    """Copy the fields of a level that a cycle changes, for `restore`.

    Parameters
    ----------
    state : Multigrid
        levels of the contact
    index : int
        number of the level, 0 the coarsest [-]

    Returns
    -------
    Snapshot
        pressure, shape (ny, nx), approach, exterior load and load of the level [-]
    """
    level = state.levels[index]
    return level.P.copy(), state.approach, state.exterior, level.load


def restore(state: Multigrid, index: int, before: Snapshot) -> None:
    """Undo the cycles on a level since a snapshot, which may be used once.

    Parameters
    ----------
    state : Multigrid
        levels of the contact, changed in place
    index : int
        number of the level, 0 the coarsest [-]
    before : Snapshot
        pressure, shape (ny, nx), approach, exterior load and load of the level [-]
    """
    level = state.levels[index]
    level.P, state.approach, state.exterior, level.load = before
    update_film(state, index)


def guarded_cycle(
    state: Multigrid, index: int, last: float = inf, flow_cycles: int = 1
) -> tuple[float, float]:
    """Run one cycle on a level, several with a flow model, and judge it by the residual.

    Parameters
    ----------
    state : Multigrid
        levels of the contact, changed in place
    index : int
        number of the level, 0 the coarsest [-]
    last : float, default inf
        residual before the cycle [-]
    flow_cycles : int, default 1
        cycles between two evaluations of a flow model [-]

    Returns
    -------
    tuple[float, float]
        residual and imbalance of `relative_residual`, or `DIVERGED` [-]
    """
    with np.errstate(all="ignore"):  # a cycle that diverges may overflow
        refresh_factors(state, index)
        for _ in range(1 if state.flow_model is None else flow_cycles):
            cycle(state, index)
        equations = relative_residual(state, index)
    limit = max(GROWTH_LIMIT * last, CONVERGED[0])
    diverged = not np.isfinite(equations[0]) or equations[0] > limit
    if diverged or not 0.0 < state.levels[index].P.max() <= PRESSURE_LIMIT:
        return DIVERGED
    return equations


@dataclass(frozen=True, slots=True, kw_only=True)
class Attempt:
    """Settings of one attempt to solve a contact."""

    name: str  # in the record and among the fallbacks
    # damped, from the first level on that resolves the film, as heavy contacts are in any case
    damped: bool = True
    # another mesh across the entrainment: twice as wide in ellipses whose longer axis lies along
    # the grid's X, the usual one where it is that already, half in others with less Gauss-Seidel
    other_mesh: bool = False
    # turn the grid to the entrainment; only where that is not a principal direction
    along_entrainment: bool = False
    # Newton's method in place of cycles, without a flow model or a layer at the inlet
    newton: bool = False
    first_damping: Damping | None = None  # to begin with; None: by the contact

    def applies(self, contact: ScaledContact, entrainment_aligned: ScaledContact) -> bool:
        """Tell whether the attempt differs for a contact from those before it.

        Parameters
        ----------
        contact : ScaledContact
            contact on a grid along a principal direction
        entrainment_aligned : ScaledContact
            the same contact on a grid along the entrainment

        Returns
        -------
        bool
            True if the attempt is to be made
        """
        turned = contact.frame_angle != entrainment_aligned.frame_angle
        return turned or not self.along_entrainment

    def careful(self, contact: ScaledContact) -> bool:
        """Tell whether a contact starts damped, on the first level that resolves its film.

        Parameters
        ----------
        contact : ScaledContact
            scaled contact

        Returns
        -------
        bool
            True in heavy contacts, and in attempts that are damped
        """
        return self.damped or contact.moes_load > HEAVY_LOAD[0]

    def damping(self, contact: ScaledContact) -> Damping:
        """Choose the damping to begin with.

        Parameters
        ----------
        contact : ScaledContact
            scaled contact

        Returns
        -------
        Damping
            under-relaxation of the solve
        """
        if self.first_damping is not None:
            return self.first_damping
        mesh = self.mesh_y(contact)
        if mesh < 1.0 or contact.moes_load > HEAVY_LOAD[1]:
            return CAUTIOUS
        if _has_long_spike(contact):
            return replace(DAMPED, gauss_seidel=0.25 * mesh)
        return DAMPED if self.careful(contact) else Damping()

    def mesh_y(self, contact: ScaledContact) -> float:
        """Choose the mesh size across the entrainment over the usual one.

        Parameters
        ----------
        contact : ScaledContact
            scaled contact

        Returns
        -------
        float
            ratio [-]
        """
        if self.other_mesh == _has_long_spike(contact):
            return 1.0
        return 2.0 if contact.half_extent_x > contact.half_extent_y else 0.5


def _has_long_spike(contact: ScaledContact) -> bool:
    """Tell whether the pressure has a spike in an ellipse whose longer axis lies along X, in
    entrainment that does not turn: a thick film that turns (M 9) came to rest on the usual mesh.
    """
    long = contact.half_extent_x > SPIKE[1] * contact.half_extent_y
    return long and contact.moes_lubricant > SPIKE[0] and contact.turning == 0.0


@dataclass(slots=True, kw_only=True)
class AttemptResult:
    """Levels of one attempt and what their cycles did."""

    state: Multigrid  # levels, coarsest first
    attempt: Attempt  # settings of the levels
    # histories from the first level on, coarsest first; empty if the iteration diverged
    levels: list[LevelHistory] = field(default_factory=list)
    certificate: Certificate | None = None  # of the finest level, where one was asked for

    @property
    def converged(self) -> bool:
        """True if the films of the finest level are at rest and the equations hold."""
        return bool(self.levels) and self.levels[-1].converged()

    @property
    def error(self) -> float:
        """Relative film error that the cycles left, of the worse film [-]; infinite if the
        iteration diverged.
        """
        if not self.levels:
            return inf
        return max(self.levels[-1].noise(kind) for kind in FILMS)

    @property
    def rank(self) -> tuple[bool, float]:
        """Smaller for the better of two attempts."""
        return not self.converged, self.error


ATTEMPTS = (
    Attempt(name="plain", damped=False),
    Attempt(name="other mesh across the entrainment", other_mesh=True),
    Attempt(name="grid turned to the entrainment", along_entrainment=True),
    Attempt(name="Newton's method on every level", newton=True),
)


def solve_with_fallbacks(
    contacts: tuple[ScaledContact, ScaledContact],
    domain: tuple[float, float, float],
    options: SolverOptions,
    progress: Progress,
    flow_model: FlowModel | None = None,
    attempts: tuple[Attempt, ...] = ATTEMPTS,
) -> AttemptResult:
    """Solve a contact by the first attempt that converges to `ACCEPTED_ERROR`.

    Else the attempt with the smallest error counts, one that converged before others. Attempts for
    which too little of `MAX_WORK` remains are not made, and the fallbacks name them.

    Parameters
    ----------
    contacts : tuple[ScaledContact, ScaledContact]
        the contact on a grid along a principal direction, and on one along the entrainment
    domain : tuple[float, float, float]
        x_in, x_out and y_half in Hertz half-extents [-]
    options : SolverOptions
        options of the solver
    progress : Progress
        work and fallbacks so far, changed in place
    flow_model : FlowModel | None, optional
        model of the oil's flow; None: Newtonian and isothermal
    attempts : tuple[Attempt, ...], default ATTEMPTS
        settings to try, in their order

    Returns
    -------
    AttemptResult
        levels and histories of the best attempt
    """
    best = None
    for attempt in attempts:
        contact = contacts[attempt.along_entrainment]
        plain = flow_model is None and contact.inlet_layer is None
        if not attempt.applies(*contacts) or (attempt.newton and not plain):
            continue
        state = contact_multigrid(contact, domain, options, attempt, flow_model)
        done = best is not None and best.converged  # which Newton's method is too dear for
        if attempt.newton and (done or state.levels[-1].P.size > NEWTON_NODES):
            continue
        if best is not None:
            remaining_work = MAX_WORK * max(best.state.levels[-1].P.size, WORK_MESH)
            remaining_work -= progress.deflected_nodes
            if ATTEMPT_WORK * state.levels[-1].P.size > remaining_work:
                progress.fallbacks.append(f"{attempt.name}: {TOO_MUCH_WORK}")
                continue
        progress.fallbacks += [] if attempt is ATTEMPTS[0] else [attempt.name]
        result = AttemptResult(state=state, attempt=attempt)
        if attempt.newton:
            newton_multigrid(result)
        else:
            full_multigrid(result, options, progress)
        progress.deflected_nodes += result.state.deflected_nodes()
        if best is None or result.rank < best.rank:
            best = result
        if best.converged and best.error < ACCEPTED_ERROR:
            break
    assert best is not None
    return best


def contact_multigrid(
    contact: ScaledContact,
    domain: tuple[float, float, float],
    options: SolverOptions,
    attempt: Attempt,
    flow_model: FlowModel | None = None,
    *,
    full_domain: bool = False,
) -> Multigrid:
    """Allocate the levels of a contact for a box; in an open box the origin is a node.

    Parameters
    ----------
    contact : ScaledContact
        scaled contact
    domain : tuple[float, float, float]
        x_in, x_out and y_half in Hertz half-extents [-]
    options : SolverOptions
        options of the solver
    attempt : Attempt
        settings of the attempt
    flow_model : FlowModel | None, optional
        model of the oil's flow; None: Newtonian and isothermal
    full_domain : bool, default False
        whether the grid has both sides of y = 0 also where a contact is symmetric

    Returns
    -------
    Multigrid
        levels, coarsest first
    """
    is_open = options.domain is None
    x_in = domain[0] * contact.half_extent_x
    x_out = domain[1] * contact.half_extent_x
    y_half = domain[2]
    if is_open:
        outlet = ceil(x_out / (x_out - x_in) * ORIGIN_CELLS - 1e-9)
        x_out = outlet * -x_in / (ORIGIN_CELLS - outlet)
    levels = ((options.max_points - 1) // COARSEST_CELLS).bit_length()
    aspect = attempt.mesh_y(contact) * contact.half_extent_y / contact.half_extent_x
    symmetric = (
        contact.symmetric and (flow_model is None or flow_model.symmetric) and not full_domain
    )
    grids = grid_hierarchy(
        options.max_points,
        (x_in, x_out, y_half * contact.half_extent_y),
        aspect,
        levels,
        symmetric,
    )
    state = make_multigrid(
        contact, grids, far_field(contact) if is_open else None, attempt.damping(contact)
    )
    state.flow_model = flow_model
    state.threads = Threads(options.threads)
    return state


def full_multigrid(result: AttemptResult, options: SolverOptions, progress: Progress) -> None:
    """Solve level after level, Venner and Lubrecht (2000), sec. 3.5.

    If the iteration diverges, `result.levels` is empty. A flow model acts, and films count, from
    the first level on that resolves the Newtonian film, the last but one already where it hardly
    does: a film below the mesh has no meaningful heat.

    Parameters
    ----------
    result : AttemptResult
        attempt, changed in place
    options : SolverOptions
        options of the solver
    progress : Progress
        work and fallbacks so far, changed in place
    """
    state = result.state
    damping = state.damping
    model, state.flow_model = state.flow_model, None
    finest = len(state.levels) - 1
    first = _starting_level(result)
    start_from_hertz(state, first)
    levels: list[LevelHistory] = []
    below: LevelHistory | None = None
    for index in range(first, finest + 1):
        # 1. start from the level below, Venner and Lubrecht (2000), sec. 3.5; what a level too
        # coarse for the film needed in damping does not slow the finer ones
        if index > first:
            _start_from_below(state, index)
            state.damping = damping
        # 2. cycles of the Newtonian film until its mesh is fine enough for the flow model
        if state.flow_model is not model:
            below = iterate_level(
                state, index, COARSE_LEVEL_CYCLES, progress, below, options.strictness
            )
            if below is None:
                return
            if not _fine_enough(below, finest - index):
                continue
            state.flow_model = model
            state.damping = damping
        # 3. cycles until film, load and equations are at rest
        coarse = index < finest and not result.attempt.careful(state.contact)
        most = COARSE_LEVEL_CYCLES if coarse else options.max_cycles
        looser = FLOW_STRICTNESS if index < finest and model is not None else 1.0
        strictness = looser * options.strictness
        below = iterate_level(state, index, most, progress, below, strictness)
        if below is None:
            return
        levels.append(below)
    result.levels = levels


def _fine_enough(plain: LevelHistory, above: int) -> bool:
    """Tell whether a flow model acts on the level of a Newtonian film, with levels `above` it."""
    return above == 0 or plain.fineness >= (MIN_FINENESS if above == 1 else RESOLVED)


def add_level(
    coarse: AttemptResult,
    domain: tuple[float, float, float],
    options: SolverOptions,
    progress: Progress,
    damping: Damping | None = None,
) -> AttemptResult:
    """Solve one more level above a solution.

    The levels of the result are empty if the iteration diverges.

    Parameters
    ----------
    coarse : AttemptResult
        solved attempt
    domain : tuple[float, float, float]
        x_in, x_out and y_half in Hertz half-extents [-]
    options : SolverOptions
        options with the points of the new level
    progress : Progress
        work and fallbacks so far, changed in place
    damping : Damping | None, optional
        under-relaxation of the new level; None: that of the attempt

    Returns
    -------
    AttemptResult
        attempt with one more level
    """
    before = coarse.state
    state = contact_multigrid(before.contact, domain, options, coarse.attempt, before.flow_model)
    state.approach = before.approach
    state.exterior = before.exterior
    state.damping = damping or state.damping
    finest = len(state.levels) - 1
    state.levels[finest - 1].P = before.levels[-1].P
    _start_from_below(state, finest)
    result = AttemptResult(state=state, attempt=coarse.attempt)
    history = iterate_level(
        state, finest, options.max_cycles, progress, coarse.levels[-1], options.strictness
    )
    if history is not None:
        result.levels = [*coarse.levels, history]
    progress.deflected_nodes += state.deflected_nodes()
    return result


def _start_from_below(state: Multigrid, index: int) -> None:
    """Start a level from the pressure of the one below it; behind a layer without what cubics add
    where there is none, which would make oil.
    """
    below = state.levels[index - 1]
    pressure = interpolate_cubic(below.P, below.grid.symmetric)
    if below.film_content is not None:
        pressure[interpolate_linear(below.P) <= 0.0] = 0.0
    start_level(state, index, pressure)


def newton_multigrid(result: AttemptResult) -> None:
    """Solve level after level by Newton's method, the first from a Hertz pressure.

    A level on which it fails hands on its initial guess. If it fails on the finest level,
    `result.levels` is empty.

    Parameters
    ----------
    result : AttemptResult
        attempt, changed in place
    """
    state = result.state
    first = _starting_level(result)
    start_from_hertz(state, first)
    for index in range(first, len(state.levels)):
        if index > first:
            _start_from_below(state, index)
            update_film(state, index)
        history = start_history(state, index)
        result.certificate = certify(state, index)
        if result.certificate.certified:
            history.certify(state, index)
            result.levels.append(history)
        else:
            result.levels = []


def _starting_level(result: AttemptResult) -> int:
    contact = result.state.contact
    levels = result.state.levels
    gap = sqrt(contact.film_guess / contact.curvature_x)
    if result.attempt.careful(contact):
        mesh = gap / sqrt(CAREFUL_FINENESS)
    else:
        mesh = max(STARTING_MESH[0] * contact.half_extent_x, STARTING_MESH[1] * gap)
    return next((n for n, level in enumerate(levels) if level.grid.hx <= mesh), len(levels) - 1)


def start_from_hertz(state: Multigrid, index: int) -> None:
    """Set the Hertz pressure and the approach that gives the expected central film.

    Parameters
    ----------
    state : Multigrid
        levels of the contact, changed in place
    index : int
        number of the level, 0 the coarsest [-]
    """
    contact = state.contact
    grid = state.levels[index].grid
    state.approach = 0.0
    start_level(state, index, contact.dry_pressure(grid.X[None, :], grid.Y[:, None]))
    state.approach = contact.film_guess - central_film(grid, state.levels[index].H)
    update_film(state, index)


def choose_domain(contact: ScaledContact) -> Box:
    """Choose the open box of a contact.

    Inlet sqrt(2.5^2 + 169 G), outlet sqrt(1.35^2 + 2 G) with G = Hc/(S A^2), Hc of the film
    formula, S the gap's curvature and A the half-extent along x; side sqrt(1.6^2 + (40 + 120 v^2)
    Hc/(T B^2)). Inlet and side are widened together until Kapitza's pressure carries less than
    `EXTERIOR_FRACTION` of the load outside; where that needs a factor w of 1 - t to 1 + t, by
    1 + (w - 1 + t)^2/(4 t), t = `TRANSITION`, in place of max(1, w).

    Parameters
    ----------
    contact : ScaledContact
        scaled contact

    Returns
    -------
    Box
        x_in, x_out and y_half in Hertz half-extents [-]
    """
    field = far_field(contact)

    def excess(widening: float) -> float:
        box = _box(contact, widening)
        return _load_outside(contact, field, box) / contact.load - EXTERIOR_FRACTION

    if excess(1.0 - TRANSITION) <= 0.0:
        return _box(contact, 1.0)
    if excess(LARGEST_WIDENING) >= 0.0:
        return _box(contact, LARGEST_WIDENING)
    needed = float(scipy.optimize.brentq(excess, 1.0 - TRANSITION, LARGEST_WIDENING, xtol=1e-3))
    turned = 1.0 + (needed - 1.0 + TRANSITION) ** 2 / (4.0 * TRANSITION)
    return _box(contact, needed if needed > 1.0 + TRANSITION else turned)


def box_uncertainty(state: Multigrid, central: float) -> float:
    """Estimate the relative error of the films by the load outside an open box.

    A fixed box has none, as it belongs to the problem.

    Parameters
    ----------
    state : Multigrid
        levels of the contact
    central : float
        central film [-]

    Returns
    -------
    float
        relative error [-]
    """
    return _outside(state) * (BOX_ERROR + _by_rotation(state, central))


def approach_outside_box(state: Multigrid, central: float) -> FilmValue:
    """Evaluate the deflection by the pressure outside an open box, and the error of H0 by the load
    there.

    Parameters
    ----------
    state : Multigrid
        levels of the contact
    central : float
        central film [-]

    Returns
    -------
    FilmValue
        deflection as value, error as uncertainty [-]
    """
    deflection = 0.0
    if state.far_field is not None:
        level = state.levels[-1]
        pressed = deflection_outside(
            state.far_field, level.grid, level.H, inlet_film_at_centre(state)
        )
        deflection = state.contact.deformation * pressed
    error = (1.0 + central) * box_uncertainty(state, central)
    return FilmValue(value=deflection, uncertainty=error, finest=0.0)


def _outside(state: Multigrid) -> float:
    """Share of the load outside the box [-]; none for a fixed one."""
    return 0.0 if state.far_field is None else abs(state.exterior) / state.contact.load


def _by_rotation(state: Multigrid, central: float) -> float:
    """Error by a rotation of the entrainment over the load outside [-]."""
    contact = state.contact
    thick = central / (contact.curvature_y * contact.half_extent_y**2)
    return BOX_ERROR_ROTATION * (contact.turning * (1.0 + 2.0 * thick)) ** 2


def _box(contact: ScaledContact, widening: float) -> Box:
    film = contact.film_guess
    along = film / (contact.curvature_x * contact.half_extent_x**2)
    across = film / (contact.curvature_y * contact.half_extent_y**2)
    lateral = contact.velocity_y**2 + contact.turning**2
    return (
        -widening * sqrt(INLET[0] ** 2 + INLET[1] * along),
        sqrt(OUTLET[0] ** 2 + OUTLET[1] * along),
        widening * sqrt(SIDE[0] ** 2 + (SIDE[1] + SIDE[2] * lateral) * across),
    )


def _load_outside(contact: ScaledContact, field: FarField, box: Box) -> float:
    """Load of the far field outside a box, the gap that of Hertz and the film by formula [-]."""
    x_in, x_out, y_half = (
        end * extent
        for end, extent in zip(
            box, (contact.half_extent_x, contact.half_extent_x, contact.half_extent_y), strict=True
        )
    )
    # the inlet's edge in principal directions
    place = contact.principal(x_in, 0.0)
    deflection = contact.deformation * contact.load
    edge = hertz_deflection(*place, contact.semi_axis_ratio)
    centre = hertz_deflection(0.0, 0.0, contact.semi_axis_ratio)
    level = contact.film_guess + deflection * (edge - centre)
    return load_outside(field, (x_in, x_out, y_half), level)
