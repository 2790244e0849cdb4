"""Solve one lubricated contact: its box, its fields, its film values with error bars."""

import time
from dataclasses import replace
from math import nan, sqrt

import numpy as np
from numpy.typing import NDArray

from .conditions import ContactConditions, MoesConditions
from .grid import Grid, unfolded
from .multigrid.cycle import Multigrid
from .multigrid.extrapolation import extrapolate
from .multigrid.flow_model import FlowModel
from .multigrid.full_multigrid import (
    ATTEMPTS,
    Attempt,
    AttemptResult,
    Progress,
    contact_multigrid,
    full_multigrid,
    solve_with_fallbacks,
)
from .multigrid.thin_film import at_load, thin_film
from .options import SolverOptions
from .scaling import ScaledContact, scale_contact
from .solution import ContactSolution, ConvergenceRecord, FilmValue

Array = NDArray[np.float64]

# Hmin/(S hx^2) below this is reported as unresolved, S the gap's curvature along the entrainment
RESOLVED = 5.0
# a thicker film lies in a gap that is no paraboloid: reported as unresolved, too
MAX_FILM_OVER_RADIUS = 0.02
LARGEST_BAR = 0.15  # relative error bar above which a film is reported as unresolved
FILM_RATIO = 0.2  # minimum over central film, where only the latter is guessed
LOAD_STEPS = (1.0 / 16.0, 0.25)  # shares of the load through which a fallback reaches it
PILOT_POINTS = 65
TOLERANCE_START = 129  # points of the first solve when a tolerance is asked for
EXTERIOR_SHARE = 0.06  # of the load; an open box is widened until less than this lies outside
# Open box in Hertz half-extents, or in lengths sqrt(film/curvature) of the gap where these are
# longer. Measured on eleven contacts (M 1 to 300, L 0.5 to 10, Rx/Ry 0.03 to 3, entrainment up to
# 1.2 rad; 257 points at the side, 513 along x, the change of mesh size included) by the change of
# the central film, of films that reach past the Hertz ellipse (M 1 to 5) and of the others:
INLET = (4.0, 10.0)  # 1.5 times: of M 1 to 5 -0.4 to -1.3 %, else up to -1.0 %, the mesh
OUTLET = (1.5, 1.2)  # 1.2 times 0.7 or 2: of M 1 to 5 -1 to -2.9 % or +0.2 to +1.2 %, else none
SIDE = 2.5  # times 0.7 or 1.5: below 0.03 %
# squared, the second times v^2, as an oblique side is an inlet, too. First times 0.25 or 4: M 1 to
# 5 up to -1.2 % or +0.3 %, else below 0.03 %; second times 0 or 4: below 0.15 %
SIDE_GAP = (40.0, 60.0)


def solve_contact(
    conditions: ContactConditions | MoesConditions,
    options: SolverOptions | None = None,
    flow_model: FlowModel | None = None,
) -> ContactSolution:
    """Pressure and film of a steady, flooded elliptical contact by full multigrid.

    Venner and Lubrecht (2000) with the changes described in `multigrid/cycle.py` and
    `multigrid/far_field.py`; without a flow model the oil is Newtonian and of uniform temperature.

    Returns
    -------
    ContactSolution
        Failure to converge is a result, not an exception: see `converged` and `message`. Films too
        thin for the mesh are extrapolated over the load (`multigrid/thin_film.py`), as the message
        says, and stay unresolved.

    Raises
    ------
    ValueError
        If the conditions leave the problem undetermined; the message names the field.
    """
    return solve_attempts(conditions, options or SolverOptions(), flow_model)[0]


def solve_attempts(
    conditions: ContactConditions | MoesConditions,
    options: SolverOptions,
    flow_model: FlowModel | None = None,
    attempts: tuple[Attempt, ...] = ATTEMPTS,
) -> tuple[ContactSolution, Multigrid]:
    """As `solve_contact`, with attempts of choice; the levels of the solution, too."""
    if options.tolerance is not None:
        return _solve_to_tolerance(conditions, options, flow_model, attempts)
    result, solution = _solve(conditions, options, flow_model, attempts)
    if _too_thin(result) and options.domain is None and flow_model is None:
        contact = result.state.contact
        grid = result.state.levels[-1].grid
        # without a film to measure, from the formula's
        guess = FILM_RATIO * contact.film_guess / (contact.curvature_x * grid.hx**2)
        fineness = max(_fineness(result), guess) / RESOLVED
        solution = thin_film(
            solution, fineness, lambda lighter: _solve(lighter, options, None, attempts)[1]
        )
    return with_bars_judged(solution), result.state


def _solve(
    conditions: ContactConditions | MoesConditions,
    options: SolverOptions,
    flow_model: FlowModel | None,
    attempts: tuple[Attempt, ...],
) -> tuple[AttemptResult, ContactSolution]:
    """One contact on the number of points of the options."""
    contact = scale_contact(conditions)
    turned = scale_contact(conditions, along_entrainment=True)
    start = time.perf_counter()
    progress = Progress()
    if options.domain is None:
        domain, film = _pilot(contact, progress)
        contact, turned = replace(contact, film_guess=film), replace(turned, film_guess=film)
    else:
        domain = options.domain
    lighter = tuple(scale_contact(at_load(conditions, share)) for share in LOAD_STEPS)
    result = solve_with_fallbacks(
        (contact, turned), domain, options, progress, flow_model, lighter, attempts
    )
    record = ConvergenceRecord(
        residual=tuple(result.residual),
        force_error=tuple(result.load),
        film_change=tuple(result.changes),
        cycles=len(result.changes),
        fft_equivalents=progress.deflected_nodes / result.state.levels[-1].P.size,
        fallbacks=tuple(progress.fallbacks),
        wall_time=time.perf_counter() - start,
        equation_error=result.equations[0],
        mass_imbalance=result.equations[1],
    )
    return result, _solution(conditions, options, result, record)


def _solve_to_tolerance(
    conditions: ContactConditions | MoesConditions,
    options: SolverOptions,
    flow_model: FlowModel | None,
    attempts: tuple[Attempt, ...],
) -> tuple[ContactSolution, Multigrid]:
    """Double the points until both error bars are within the tolerance; the message says so if the
    points of the options do not suffice.
    """
    tolerance = options.tolerance
    assert tolerance is not None
    points = min(TOLERANCE_START, options.points)
    wall_time = 0.0
    while True:
        coarser = replace(options, points=points, tolerance=None)
        solution, levels = solve_attempts(conditions, coarser, flow_model, attempts)
        wall_time += solution.record.wall_time
        films = (solution.film_central_dimensionless, solution.film_minimum_dimensionless)
        bars = [film.uncertainty / abs(film.value) for film in films]
        reached = solution.converged and solution.resolved and max(bars) <= tolerance
        if reached or points >= options.points:
            break
        points = 2 * points - 1
    message = solution.message
    if solution.converged and not reached:
        message = (
            f"tolerance {tolerance:g} not reached at {points} points: error bars {bars[0]:.1e} "
            f"central, {bars[1]:.1e} minimum film; try more points"
        )
    solution = replace(
        solution,
        options=options,
        record=replace(solution.record, wall_time=wall_time),
        message=message,
        resolved=solution.resolved and bool(reached),
    )
    return solution, levels


def choose_domain(contact: ScaledContact) -> tuple[float, float, float]:
    """Open box (x_in, x_out, y_half) in Hertz half-extents that the solver takes for a contact
    [-].

    Inlet 10 sqrt(Hc) and at least 4 semi-axes, side by the same gap, Hc from a pilot solve on a
    coarse mesh; both are widened until less than `EXTERIOR_SHARE` of the load lies outside.
    """
    return _pilot(contact, Progress())[0]


def _pilot(contact: ScaledContact, progress: Progress) -> tuple[tuple[float, float, float], float]:
    """Box and central film of a coarse solve."""
    options = SolverOptions(points=PILOT_POINTS, max_cycles=3)
    film = contact.film_guess
    scale = 1.0
    for _ in range(2):
        pilot = replace(contact, film_guess=film)
        result = AttemptResult(
            state=contact_multigrid(pilot, _box(contact, film, scale), options, ATTEMPTS[0])
        )
        full_multigrid(result, options, Progress())
        if not result.films:
            progress.fallbacks.append("pilot solve diverged: box from the film formula")
            return _box(contact, contact.film_guess, 1.5), contact.film_guess
        progress.deflected_nodes += result.state.deflected_nodes()
        film = max(result.films[-1][0], 0.1 * contact.film_guess)
        scale *= max(1.0, min(3.0, result.state.exterior / contact.load / EXTERIOR_SHARE))
    return _box(contact, film, scale), film


def _box(contact: ScaledContact, film: float, scale: float) -> tuple[float, float, float]:
    """Box for a central film, its inlet and side scaled [-]."""
    gap = sqrt(film / contact.curvature_x) / contact.half_extent_x
    inlet = scale * max(INLET[0], INLET[1] * gap)
    squared = (SIDE_GAP[0] + SIDE_GAP[1] * contact.velocity_y**2) * film / contact.curvature_y
    side = scale * sqrt(SIDE**2 + squared / contact.half_extent_y**2)
    return -inlet, max(OUTLET[0], OUTLET[1] * gap), side


def _solution(
    conditions: ContactConditions | MoesConditions,
    options: SolverOptions,
    result: AttemptResult,
    record: ConvergenceRecord,
) -> ContactSolution:
    state = result.state
    contact = state.contact
    grid = state.levels[-1].grid
    Y, P, H = unfold_symmetry(state)
    central, minimum = _film(result, 0), _film(result, 1)
    if minimum.value > central.value:
        excess = minimum.value - central.value
        minimum = replace(minimum, value=central.value, uncertainty=minimum.uncertainty + excess)
    resolved, message = resolution_message(result)
    return ContactSolution(
        conditions=conditions,
        options=options,
        X=grid.X,
        Y=Y,
        P=P,
        H=H,
        film_central_dimensionless=central,
        film_minimum_dimensionless=minimum,
        approach_dimensionless=state.approach,
        moes_load=contact.moes_load,
        moes_lubricant=contact.moes_lubricant,
        semi_axis_ratio=contact.semi_axis_ratio,
        frame_angle=contact.frame_angle,
        semi_axis_x=contact.semi_axis_x,
        hertz_pressure=contact.hertz_pressure,
        film_scale=contact.film_scale,
        domain=_domain(contact, grid),
        resolved=resolved,
        converged=result.converged(),
        message=message,
        record=record,
    )


def _film(result: AttemptResult, kind: int) -> FilmValue:
    """Central (0) or minimum (1) film extrapolated; not a number where the iteration diverged."""
    if not result.films:
        return FilmValue(value=nan, uncertainty=nan, finest=nan)
    return extrapolate([film[kind] for film in result.films], result.remaining_error())


def unfold_symmetry(state: Multigrid) -> tuple[Array, Array, Array]:
    """Y, P and H of the finest grid over the whole box; fields of shape (nx, ny)."""
    level = state.levels[-1]
    Y = level.grid.Y
    P = level.P
    H = level.H
    if level.grid.symmetric:
        Y = unfolded(Y, sign=-1.0)
        P, H = unfolded(P), unfolded(H)
    return Y, P.T, H.T


def _domain(contact: ScaledContact, grid: Grid) -> tuple[float, float, float]:
    """Box of a grid in Hertz half-extents."""
    x_in = float(grid.X[0]) / contact.half_extent_x
    x_out = float(grid.X[-1]) / contact.half_extent_x
    return x_in, x_out, float(grid.Y[-1]) / contact.half_extent_y


def with_bars_judged(solution: ContactSolution) -> ContactSolution:
    """The solution, unresolved where an error bar is wider than `LARGEST_BAR`."""
    films = (solution.film_central_dimensionless, solution.film_minimum_dimensionless)
    bar = max(film.relative_uncertainty for film in films)
    if not (solution.converged and solution.resolved) or bar <= LARGEST_BAR:
        return solution
    message = f"converged but unresolved: error bar {bar:.0%} of the film; try more points"
    return replace(solution, resolved=False, message=message)


def resolution_message(result: AttemptResult) -> tuple[bool, str]:
    """Whether the film of a solve is resolved, and the message on it."""
    resolved = (
        bool(result.films)
        and _fineness(result) >= RESOLVED
        and _film_over_radius(result) <= MAX_FILM_OVER_RADIUS
    )
    return resolved, _message(result, resolved)


def _fineness(result: AttemptResult) -> float:
    """Hmin/(S hx^2): minimum film over twice the gap's rise in a mesh [-]; 0 if diverged."""
    if not result.films:
        return 0.0
    curvature = result.state.contact.curvature_x
    return result.films[-1][1] / (curvature * result.state.levels[-1].grid.hx ** 2)


def _too_thin(result: AttemptResult) -> bool:
    """Whether the mesh is too coarse for the film, in a gap that is a paraboloid."""
    return not result.films or (
        _fineness(result) < RESOLVED and _film_over_radius(result) <= MAX_FILM_OVER_RADIUS
    )


def _film_over_radius(result: AttemptResult) -> float:
    """Central film over Rx [-]; zero where no lengths are given."""
    contact = result.state.contact
    if contact.film_scale is None or contact.semi_axis_x is None:
        return 0.0
    return result.films[-1][0] * (contact.film_scale / contact.semi_axis_x) ** 2


def _message(result: AttemptResult, resolved: bool) -> str:
    if not result.films:
        return "the iteration diverged in spite of stronger damping; try more points or less load"
    if result.settled() and not result.converged():
        return (
            f"not converged: film and load are at rest, but the equations miss by "
            f"{result.equations[0]:.1e} of the flow; try more points"
        )
    if not result.converged():
        return (
            f"not converged: film changed by {result.changes[-1]:.1e} in the last cycle, "
            f"load error {result.load[-1]:.1e}; try more points"
        )
    if _film_over_radius(result) > MAX_FILM_OVER_RADIUS:
        share = _film_over_radius(result)
        return (
            f"outside the model: the film is {share:.1%} of Rx, where the gap is no paraboloid; "
            "an upper bound"
        )
    if not resolved:
        ratio = _fineness(result)
        return (
            f"converged but unresolved: minimum film/(mesh size)^2 is {ratio:.2f}, "
            f"below {RESOLVED:g}; try more points"
        )
    return "converged"
