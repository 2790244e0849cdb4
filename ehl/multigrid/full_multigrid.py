"""Full multigrid of one contact, Venner and Lubrecht (2000): levels for a box, and a list of
attempts with other settings where one fails.
"""

from dataclasses import dataclass, field, replace
from math import ceil, inf, sqrt

from ..grid import grid_hierarchy
from ..options import SolverOptions
from ..scaling import ScaledContact
from ..solution import Certificate
from .cycle import start_level, update_film
from .far_field import far_field
from .flow_model import FlowModel
from .history import FILMS, RESOLVED, LevelHistory, central_film, start_history
from .levels import Damping, Multigrid, make_multigrid
from .newton import MAX_NODES, certify
from .settling import Progress, iterate_level
from .threads import Threads
from .transfer import interpolate_cubic, interpolate_linear

# along x on the coarsest grid, which may be far too coarse for the film: it only balances the load
COARSEST_CELLS = 16
# full multigrid starts where hx is below 0.2 semi-axes or 0.55 sqrt(Hc)
STARTING_MESH = (0.2, 0.55)
COARSE_LEVEL_CYCLES = 12  # most cycles on the other levels below the finest
# Hmin/(S hx^2) from which a flow model acts on the level below the finest; it does on the finest
MIN_FINENESS = 1.0
FLOW_STRICTNESS = 2.5  # on what cycles leave with a flow model on levels below the finest
# load reached in steps: cycles under each lighter load, on the first level with Hc/(S hx^2) above
# the last; 15 to 36 there and in the six hardest of 1000 random contacts
STEP_CYCLES = 5
STEP_FINENESS = 15.0
ACCEPTED_ERROR = 5e-3  # of the film, left by the cycles; above, further attempts are made
# deflections after which no further attempt is made, of the finest mesh or of the second, which
# takes a minute for them, if that is finer; and those that an attempt is counted for in advance
MAX_WORK = 300
WORK_MESH = 1025**2  # [nodes]
ATTEMPT_WORK = 60
# the origin is a node of the level with this many cells along x, and of all finer ones
ORIGIN_CELLS = 32


@dataclass(frozen=True, slots=True, kw_only=True)
class Attempt:
    """Settings of one attempt to solve a contact."""

    name: str  # in the record and among the fallbacks
    damping: Damping  # to begin with
    finer_start: int = 0  # levels above the usual one to start from
    mesh_y: float = 1.0  # mesh size across the entrainment over the usual one [-]
    # turn the grid to the entrainment; only where that is not a principal direction
    along_entrainment: bool = False
    long_only: bool = False  # only for ellipses whose longer axis lies along the grid's X
    cycles_factor: int = 1  # on the largest number of cycles
    # reach the load in steps on a level that nearly resolves the film
    from_lighter: bool = False
    # Newton's method in place of cycles, without a flow model or a layer at the inlet
    newton: bool = False

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
        if self.along_entrainment and contact.frame_angle == entrainment_aligned.frame_angle:
            return False
        return not self.long_only or contact.half_extent_x > contact.half_extent_y


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


TOO_MUCH_WORK = "not tried, too much work"
CAUTIOUS = replace(Damping().halved(), switch=1.5)
ATTEMPTS = (
    Attempt(name="plain", damping=Damping()),
    Attempt(
        name="mesh doubled across the entrainment", damping=Damping(), mesh_y=2.0, long_only=True
    ),
    Attempt(name="grid turned to the entrainment", damping=Damping(), along_entrainment=True),
    Attempt(name="load reached in steps", damping=Damping(), from_lighter=True),
    Attempt(
        name="mesh doubled across the entrainment, load reached in steps",
        damping=Damping().halved(),
        mesh_y=2.0,
        long_only=True,
        from_lighter=True,
    ),
    Attempt(name="damping halved, less Gauss-Seidel", damping=CAUTIOUS),
    Attempt(name="mesh halved across the entrainment", damping=CAUTIOUS, mesh_y=0.5),
    Attempt(name="started one level finer", damping=CAUTIOUS.halved(), finer_start=1, mesh_y=0.5),
    Attempt(name="three times the cycles", damping=CAUTIOUS, cycles_factor=3),
    Attempt(name="Newton's method on every level", damping=Damping(), newton=True),
)


def solve_with_fallbacks(
    contacts: tuple[ScaledContact, ScaledContact],
    domain: tuple[float, float, float],
    options: SolverOptions,
    progress: Progress,
    flow_model: FlowModel | None = None,
    lighter: tuple[ScaledContact, ...] = (),
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
    lighter : tuple[ScaledContact, ...], default ()
        the first of the contacts under rising loads below its own
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
        if attempt.newton and state.levels[-1].P.size > MAX_NODES:
            continue
        if best is not None:
            remaining_work = MAX_WORK * max(best.state.levels[-1].P.size, WORK_MESH)
            remaining_work -= progress.deflected_nodes
            if attempt.cycles_factor * ATTEMPT_WORK * state.levels[-1].P.size > remaining_work:
                progress.fallbacks.append(f"{attempt.name}: {TOO_MUCH_WORK}")
                continue
        progress.fallbacks += [] if attempt is ATTEMPTS[0] else [attempt.name]
        result = AttemptResult(state=state, attempt=attempt)
        limit = replace(options, max_cycles=attempt.cycles_factor * options.max_cycles)
        steps = lighter if attempt.from_lighter else ()
        if attempt.newton:
            newton_multigrid(result)
        else:
            full_multigrid(result, limit, progress, attempt.finer_start, steps)
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
    aspect = attempt.mesh_y * contact.half_extent_y / contact.half_extent_x
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
        contact, grids, far_field(contact) if is_open else None, attempt.damping
    )
    state.flow_model = flow_model
    state.threads = Threads(options.threads)
    return state


def full_multigrid(
    result: AttemptResult,
    options: SolverOptions,
    progress: Progress,
    finer: int = 0,
    lighter: tuple[ScaledContact, ...] = (),
) -> None:
    """Solve level after level, Venner and Lubrecht (2000), sec. 3.5.

    The load on the first level is reached through those of `lighter`. If the iteration diverges,
    `result.levels` is empty. A flow model acts, and films count, from the first level on that
    resolves the Newtonian film, the last but one already where it hardly does: a film below the
    mesh has no meaningful heat.

    Parameters
    ----------
    result : AttemptResult
        attempt, changed in place
    options : SolverOptions
        options of the solver
    progress : Progress
        work and fallbacks so far, changed in place
    finer : int, default 0
        levels above the usual one to start from [-]
    lighter : tuple[ScaledContact, ...], default ()
        contacts under rising loads below its own; none: the load at once
    """
    state = result.state
    model, state.flow_model = state.flow_model, None
    finest = len(state.levels) - 1
    first = _starting_level(state, finer)
    if lighter:
        first = max(first, _stepping_level(state))
        if not _start_in_steps(state, first, lighter, progress):
            return
    else:
        start_from_hertz(state, first)
    levels: list[LevelHistory] = []
    below: LevelHistory | None = None
    for index in range(first, finest + 1):
        # 1. start from the level below, Venner and Lubrecht (2000), sec. 3.5; what a level too
        # coarse for the film needed in damping does not slow the finer ones
        if index > first:
            _start_from_below(state, index)
            state.damping = result.attempt.damping
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
            state.damping = result.attempt.damping
        # 3. cycles until film, load and equations are at rest
        most = options.max_cycles if index == finest else COARSE_LEVEL_CYCLES
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
    damping: Damping,
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
    damping : Damping
        under-relaxation of the new level

    Returns
    -------
    AttemptResult
        attempt with one more level
    """
    before = coarse.state
    state = contact_multigrid(before.contact, domain, options, coarse.attempt, before.flow_model)
    state.approach = before.approach
    state.exterior = before.exterior
    state.damping = damping
    finest = len(state.levels) - 1
    state.levels[finest - 1].P = before.levels[-1].P
    _start_from_below(state, finest)
    result = AttemptResult(state=state, attempt=coarse.attempt)
    most = coarse.attempt.cycles_factor * options.max_cycles
    history = iterate_level(state, finest, most, progress, coarse.levels[-1], options.strictness)
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
    first = _starting_level(state, 0)
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


def _starting_level(state: Multigrid, finer: int) -> int:
    contact = state.contact
    finest = len(state.levels) - 1
    gap = sqrt(contact.film_guess / contact.curvature_x)
    mesh = max(STARTING_MESH[0] * contact.half_extent_x, STARTING_MESH[1] * gap)
    first = next(
        (index for index, level in enumerate(state.levels) if level.grid.hx <= mesh), finest
    )
    return min(first + finer, finest)


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


def _stepping_level(state: Multigrid) -> int:
    """First level that nearly resolves the film of the formula."""
    contact = state.contact
    mesh = sqrt(contact.film_guess / contact.curvature_x / STEP_FINENESS)
    levels = enumerate(state.levels)
    return next((index for index, level in levels if level.grid.hx <= mesh), len(state.levels) - 1)


def _start_in_steps(
    state: Multigrid, index: int, lighter: tuple[ScaledContact, ...], progress: Progress
) -> bool:
    """Start a level from the solution under the last of the lighter loads, the first of them by
    full multigrid up to that level; False if one of them diverged.

    In the scales of each load's own Hertz contact grid and kernel are the same.
    """
    # 1. the lightest
    step = replace(state, contact=lighter[0])
    first = min(_starting_level(step, 0), index)
    start_from_hertz(step, first)
    for at in range(first, index + 1):
        if at > first:
            _start_from_below(step, at)
        if iterate_level(step, at, COARSE_LEVEL_CYCLES, progress, None) is None:
            return False
    # 2. heavier and heavier ones
    for contact in lighter[1:]:
        step = _heavier(step, index, contact)
        if iterate_level(step, index, STEP_CYCLES, progress, None) is None:
            return False
    start = _heavier(step, index, state.contact)
    state.approach = start.approach
    state.exterior = start.exterior
    return True


def _heavier(before: Multigrid, index: int, contact: ScaledContact) -> Multigrid:
    """Start a level under a heavier load from the solution under a lighter one. Solution and dry
    contact, whose film is zero, are combined to the film of the formula.

    Pressure and film of the dry contact are not negative, so that the film is positive wherever
    that of the lighter load is.
    """
    state = replace(before, contact=contact)
    level = state.levels[index]
    lighter = level.P
    fraction = min(contact.film_guess / before.contact.film_guess, 1.0)
    dry = contact.dry_pressure(level.grid.X[None, :], level.grid.Y[:, None])
    state.approach = 0.0
    start_level(state, index, dry)
    state.approach = fraction * before.approach - (1.0 - fraction) * float(level.H.min())
    start_level(state, index, fraction * lighter + (1.0 - fraction) * dry)
    return state
