"""Full multigrid solve of one lubricated contact: box, levels, cycles, fallbacks, error bars."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import ceil, sqrt

import numpy as np
from numpy.typing import NDArray

from .conditions import ContactConditions, MoesConditions
from .extrapolation import extrapolate
from .far_field import far_field
from .grid import Grid, grid_hierarchy
from .multigrid import (
    Damping,
    Multigrid,
    cycle,
    load_error,
    make_multigrid,
    reynolds_residual,
    start_level,
    update_film,
)
from .options import SolverOptions
from .scaling import ScaledContact, scale_contact
from .solution import ContactSolution, ConvergenceRecord, FilmValue
from .transfer import interpolate_cubic

Array = NDArray[np.float64]

COARSEST_CELLS = 16  # along x on the coarsest grid; its mesh may be far too coarse for the film, it only carries H0
STARTING_MESH = (0.2, 0.55)  # full multigrid starts where hx is below 0.2 semi-axes or 0.55 sqrt(Hc)
LEVEL_CYCLES = 3  # cycles on each level of the full multigrid below the finest
FILM_TOLERANCE = 3e-4  # relative change of central and minimum film over each of the last two cycles
LOAD_TOLERANCE = 1e-4  # relative error of the load balance
RESOLVED = 5.0  # Hmin/hx^2 below this is reported as unresolved
PRESSURE_LIMIT = 5.0  # a pressure above this is a runaway iteration
GROWTH_LIMIT = 10.0  # so is a residual that grows by this factor in one cycle
ORIGIN_CELLS = 32  # the origin is a node of the level with this many cells along x, and of all finer ones
PILOT_POINTS = 65
EXTERIOR_SHARE = 0.06  # of the load; an open box is widened until less than this lies outside


class DivergedError(Exception):
    """The iteration ran away in spite of its guards."""


@dataclass(slots=True, kw_only=True)
class Progress:
    """What happened on the finest level so far; filled while solving."""

    residual: list[float]
    load: list[float]
    film: list[tuple[float, float]]  # central and minimum film after each cycle
    changes: list[float]
    fallbacks: list[str]

    def restart(self, reason: str) -> None:
        """Forget the last attempt's history, not its fallbacks."""
        for history in (self.residual, self.load, self.film, self.changes):
            history.clear()
        self.fallbacks.append(reason)


def new_progress() -> Progress:
    """An empty record."""
    return Progress(residual=[], load=[], film=[], changes=[], fallbacks=[])


def solve_contact(
    conditions: ContactConditions | MoesConditions, options: SolverOptions | None = None
) -> ContactSolution:
    """Pressure and film of a steady, isothermal, flooded elliptical contact by full multigrid.

    Venner and Lubrecht (2000) with the changes described in `multigrid.py` and `far_field.py`.

    Parameters
    ----------
    conditions : ContactConditions or MoesConditions
        The contact, SI or dimensionless.
    options : SolverOptions, optional
        Mesh, box and number of cycles.

    Returns
    -------
    ContactSolution
        Fields, film values with uncertainties [-] and, for SI conditions, [m]; `converged` and `message` tell whether
        to trust them. Failure to converge is a result, not an exception.

    Raises
    ------
    ValueError
        If the conditions leave the problem undetermined; the message names the field.
    """
    options = options or SolverOptions()
    contact = scale_contact(conditions)
    began = time.perf_counter()
    progress = new_progress()
    domain = options.domain or choose_domain(contact, progress)
    state, levels = _solve_with_fallbacks(contact, domain, options, progress)
    return _solution(conditions, options, state, levels, progress, time.perf_counter() - began)


def choose_domain(contact: ScaledContact, progress: Progress | None = None) -> tuple[float, float, float]:
    """Open box (x_in, x_out, y_half) in Hertz half-extents from a pilot solve on a coarse mesh [-].

    Inlet 10 sqrt(Hc) and at least 4 semi-axes, side by the same gap; both are widened until less than
    `EXTERIOR_SHARE` of the load lies outside.
    """
    progress = progress or new_progress()
    options = SolverOptions(points=PILOT_POINTS, max_cycles=3)
    film, scale = contact.film_guess, 1.0
    for _ in range(2):
        pilot = replace(contact, film_guess=film)
        state = _multigrid(pilot, _box(contact, film, scale), options, ATTEMPTS[0])
        try:
            levels = _full_multigrid(state, options, new_progress(), 0)
        except DivergedError:
            progress.fallbacks.append("pilot solve ran away: box from the film formula")
            return _box(contact, contact.film_guess, 1.5)
        film = max(levels[-1][0], 0.1 * contact.film_guess)
        scale *= max(1.0, min(3.0, state.exterior / contact.load / EXTERIOR_SHARE))
    return _box(contact, film, scale)


def _box(contact: ScaledContact, film: float, scale: float) -> tuple[float, float, float]:
    """Box for a central film [-]; outlet 1.5 semi-axes, or as far as a thick film cavitates."""
    inlet = scale * max(4.0, 10.0 * sqrt(film / contact.curvature_x) / contact.half_extent_x)
    side = scale * sqrt(2.5**2 + 40.0 * film / contact.curvature_y / contact.half_extent_y**2)
    return -inlet, max(1.5, 1.2 * sqrt(film / contact.curvature_x) / contact.half_extent_x), side


@dataclass(frozen=True, slots=True, kw_only=True)
class Attempt:
    """One way of solving: damping, level to start from, share of the usual mesh size across the entrainment."""

    name: str
    damping: Damping
    finer_start: int = 0
    mesh_y: float = 1.0


CAUTIOUS = replace(Damping().halved(), switch=1.5)
ATTEMPTS = (
    Attempt(name="plain", damping=Damping()),
    Attempt(name="damping halved, less Gauss-Seidel", damping=CAUTIOUS),
    Attempt(name="mesh halved across the entrainment", damping=CAUTIOUS, mesh_y=0.5),
    Attempt(name="started one level finer", damping=CAUTIOUS.halved(), finer_start=1, mesh_y=0.5),
)


def _solve_with_fallbacks(
    contact: ScaledContact, domain: tuple[float, float, float], options: SolverOptions, progress: Progress
) -> tuple[Multigrid, list[tuple[float, float]]]:
    """Go down the list of attempts until one converges; the last one is kept if none does."""
    outcome = None
    for attempt in ATTEMPTS:
        if attempt is not ATTEMPTS[0]:
            progress.restart(attempt.name)
        state = _multigrid(contact, domain, options, attempt)
        try:
            outcome = state, _full_multigrid(state, options, progress, attempt.finer_start)
        except DivergedError:
            outcome = state, []
            continue
        if is_converged(progress):
            break
    assert outcome is not None
    return outcome


def _multigrid(
    contact: ScaledContact, domain: tuple[float, float, float], options: SolverOptions, attempt: Attempt
) -> Multigrid:
    """Levels for a box given in Hertz half-extents; in a box of our choice the origin is a node."""
    is_open = options.domain is None
    x_in, x_out, y_half = domain[0] * contact.half_extent_x, domain[1] * contact.half_extent_x, domain[2]
    if is_open:
        outlet = ceil(x_out / (x_out - x_in) * ORIGIN_CELLS - 1e-9)
        x_out = outlet * -x_in / (ORIGIN_CELLS - outlet)
    levels = ((options.points - 1) // COARSEST_CELLS).bit_length()
    aspect = attempt.mesh_y * contact.half_extent_y / contact.half_extent_x
    grids = grid_hierarchy(
        options.points, (x_in, x_out, y_half * contact.half_extent_y), aspect, levels, contact.symmetric
    )
    return make_multigrid(contact, grids, far_field(contact) if is_open else None, attempt.damping)


def _full_multigrid(
    state: Multigrid, options: SolverOptions, progress: Progress, finer: int
) -> list[tuple[float, float]]:
    """Solve level after level; returns central and minimum film of each, coarsest first."""
    finest = len(state.levels) - 1
    first = _starting_level(state, finer)
    _start(state, first)
    films = []
    for index in range(first, finest + 1):
        if index > first:
            below = state.levels[index - 1]
            start_level(state, index, interpolate_cubic(below.P, below.grid.symmetric))
        if index < finest:
            for _ in _guarded_cycles(state, index, LEVEL_CYCLES, progress):
                pass
        else:
            _finish(state, index, options, progress)
        films.append(film_values(state.levels[index].grid, state.levels[index].H))
    return films


def _starting_level(state: Multigrid, finer: int) -> int:
    contact, finest = state.contact, len(state.levels) - 1
    gap = sqrt(contact.film_guess / contact.curvature_x)
    mesh = max(STARTING_MESH[0] * contact.half_extent_x, STARTING_MESH[1] * gap)
    first = next((index for index, level in enumerate(state.levels) if level.grid.hx <= mesh), finest)
    return min(first + finer, finest)


def _start(state: Multigrid, index: int) -> None:
    """Hertz pressure and the approach that gives the expected central film."""
    contact, grid = state.contact, state.levels[index].grid
    cosine, sine = np.cos(contact.entrainment_angle), np.sin(contact.entrainment_angle)
    X, Y = grid.X[None, :], grid.Y[:, None]
    along, across = X * cosine - Y * sine, (X * sine + Y * cosine) / contact.semi_axis_ratio
    state.approach = 0.0
    start_level(state, index, np.sqrt(np.maximum(1.0 - along**2 - across**2, 0.0)))
    state.approach = contact.film_guess - central_film(grid, state.levels[index].H)
    update_film(state, index)


def _guarded_cycles(state: Multigrid, index: int, count: int, progress: Progress) -> Iterator[float]:
    """Run cycles on a level and yield the mean residual; a runaway one is undone and repeated with half the damping.

    Raises
    ------
    DivergedError
        If three halvings do not help.
    """
    level = state.levels[index]
    last, halvings, done = np.inf, 0, 0
    while done < count:
        kept = (level.P.copy(), state.approach, state.exterior, level.load)
        cycle(state, index)
        residual = float(np.abs(reynolds_residual(state, index)).mean())
        runaway = not np.isfinite(residual) or residual > GROWTH_LIMIT * last or level.P.max() > PRESSURE_LIMIT
        if runaway or level.P.max() <= 0.0:
            if halvings == 3:
                raise DivergedError
            halvings += 1
            state.damping = state.damping.halved()
            progress.fallbacks.append("cycle undone, damping halved")
            level.P, state.approach, state.exterior, level.load = kept
            update_film(state, index)
            continue
        last, done = residual, done + 1
        yield residual


def _finish(state: Multigrid, index: int, options: SolverOptions, progress: Progress) -> None:
    """Cycle on the finest level until film and load stand still."""
    level = state.levels[index]
    progress.film.append(film_values(level.grid, level.H))
    for residual in _guarded_cycles(state, index, options.max_cycles, progress):
        film, before = film_values(level.grid, level.H), progress.film[-1]
        change = max(abs(film[0] - before[0]) / abs(film[0]), abs(film[1] - before[1]) / abs(film[1]))
        progress.film.append(film)
        progress.changes.append(change)
        progress.residual.append(residual)
        progress.load.append(load_error(state, index))
        if is_converged(progress):
            return


def is_converged(progress: Progress) -> bool:
    """Film still over two cycles, load balanced, film positive."""
    return (
        len(progress.changes) >= 2
        and max(progress.changes[-2:]) < FILM_TOLERANCE
        and abs(progress.load[-1]) < LOAD_TOLERANCE
        and progress.film[-1][1] > 0.0
    )


def central_film(grid: Grid, H: Array) -> float:
    """Film at the origin; cubic interpolation along x where the origin is no node [-]."""
    line = H[0] if grid.symmetric else H[grid.ny // 2]
    X = grid.X
    i = int(np.argmin(np.abs(X)))
    if abs(X[i]) < 1e-9 * grid.hx:
        return float(line[i])
    first = min(max(int(np.searchsorted(X, 0.0)) - 2, 0), grid.nx - 4)
    nodes, values = X[first : first + 4], line[first : first + 4]
    weights = [np.prod([-other / (node - other) for other in nodes if other != node]) for node in nodes]
    return float(np.dot(weights, values))


def film_values(grid: Grid, H: Array) -> tuple[float, float]:
    """Central film, and minimum film by a parabola through the smallest node in each direction [-]."""
    j, i = np.unravel_index(int(np.argmin(H)), H.shape)
    minimum = float(H[j, i])
    if 0 < i < grid.nx - 1:
        minimum -= _dip(H[j, i - 1], H[j, i], H[j, i + 1])
    if grid.symmetric and j == 0:
        return central_film(grid, H), minimum
    if 0 < j < grid.ny - 1:
        minimum -= _dip(H[j - 1, i], H[j, i], H[j + 1, i])
    return central_film(grid, H), minimum


def _dip(before: float, middle: float, after: float) -> float:
    """How far the parabola through three equidistant values dips below the middle one."""
    curvature = before - 2.0 * middle + after
    return (after - before) ** 2 / (8.0 * curvature) if curvature > 0.0 else 0.0


def _solution(
    conditions: ContactConditions | MoesConditions,
    options: SolverOptions,
    state: Multigrid,
    films: list[tuple[float, float]],
    progress: Progress,
    wall_time: float,
) -> ContactSolution:
    contact, level = state.contact, state.levels[-1]
    grid = level.grid
    converged = bool(films) and is_converged(progress)
    noise = max(progress.changes[-1:], default=1.0)
    central = (
        extrapolate([film[0] for film in films], noise) if films else FilmValue(value=0.0, uncertainty=0.0, finest=0.0)
    )
    minimum = extrapolate([film[1] for film in films], noise) if films else central
    resolved = bool(films) and films[-1][1] >= RESOLVED * grid.hx**2
    P, H, Y = level.P, level.H, grid.Y
    if grid.symmetric:
        P, H = np.concatenate((P[:0:-1], P)), np.concatenate((H[:0:-1], H))
        Y = np.concatenate((-Y[:0:-1], Y))
    return ContactSolution(
        conditions=conditions,
        options=options,
        X=grid.X,
        Y=Y,
        P=P.T,
        H=H.T,
        film_central_dimensionless=central,
        film_minimum_dimensionless=minimum,
        approach_dimensionless=state.approach,
        moes_load=contact.moes_load,
        moes_lubricant=contact.moes_lubricant,
        semi_axis_ratio=contact.semi_axis_ratio,
        semi_axis_x=contact.semi_axis_x,
        hertz_pressure=contact.hertz_pressure,
        film_scale=contact.film_scale,
        domain=(
            grid.X[0] / contact.half_extent_x,
            grid.X[-1] / contact.half_extent_x,
            grid.Y[-1] / contact.half_extent_y,
        ),
        resolved=resolved,
        converged=converged,
        message=_message(converged, resolved, films, progress, grid),
        record=ConvergenceRecord(
            residual=tuple(progress.residual),
            force_error=tuple(progress.load),
            film_change=tuple(progress.changes),
            cycles=len(progress.changes),
            fft_equivalents=state.fft_equivalents(),
            fallbacks=tuple(progress.fallbacks),
            wall_time=wall_time,
        ),
    )


def _message(converged: bool, resolved: bool, films: list[tuple[float, float]], progress: Progress, grid: Grid) -> str:
    if not films:
        return "the iteration ran away in spite of stronger damping; try more points or a smaller load"
    if not converged:
        change, load = progress.changes[-1], progress.load[-1]
        return f"not converged: film changed by {change:.1e} in the last cycle, load error {load:.1e}; try more points"
    if not resolved:
        ratio = films[-1][1] / grid.hx**2
        return (
            f"converged but unresolved: minimum film/(mesh size)^2 is {ratio:.2f}, below {RESOLVED:g}; try more points"
        )
    return "converged"
