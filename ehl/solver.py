"""Solve one lubricated contact: its box, its fields, its film values with error bars."""

import time
from dataclasses import replace
from math import nan, sqrt

import numpy as np
from numpy.typing import NDArray

from .conditions import ContactConditions, MoesConditions
from .grid import Grid
from .multigrid.cycle import Multigrid
from .multigrid.extrapolation import extrapolate
from .multigrid.flow_model import FlowModel
from .multigrid.full_multigrid import (
    ATTEMPTS,
    DivergedError,
    Outcome,
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
# a film above this share of Rx lies in a gap that is no paraboloid: reported as unresolved too
PARABOLIC = 0.02
THINNEST = 0.2  # minimum over central film, where only the latter is guessed
LOAD_STEPS = (1.0 / 16.0, 0.25)  # shares of the load through which a fallback reaches it
PILOT_POINTS = 65
TOLERANCE_START = 129  # points of the first solve when a tolerance is asked for
EXTERIOR_SHARE = 0.06  # of the load; an open box is widened until less than this lies outside


def solve_contact(
    conditions: ContactConditions | MoesConditions,
    options: SolverOptions | None = None,
    flow_model: FlowModel | None = None,
) -> ContactSolution:
    """Pressure and film of a steady, flooded elliptical contact by full multigrid.

    Venner and Lubrecht (2000) with the changes described in `multigrid.py` and `far_field.py`.

    Parameters
    ----------
    conditions : ContactConditions or MoesConditions
        The contact, SI or dimensionless.
    options : SolverOptions, optional
        Mesh, box and number of cycles.
    flow_model : FlowModel, optional
        Factors of a generalized Reynolds equation; left out, the oil is Newtonian and of uniform
        temperature.

    Returns
    -------
    ContactSolution
        Fields, film values with uncertainties [-] and, for SI conditions, [m]; `converged` and
        `message` tell whether to trust them. Failure to converge is a result, not an exception.
        Films the mesh is too coarse for are extrapolated over the load (`thin_film.py`), told in
        the message, and stay unresolved.

    Raises
    ------
    ValueError
        If the conditions leave the problem undetermined; the message names the field.
    """
    options = options or SolverOptions()
    if options.tolerance is not None:
        return _solve_to_tolerance(conditions, options, options.tolerance, flow_model)
    outcome, solution = _solve(conditions, options, flow_model)
    if not _too_thin(outcome) or options.domain is not None or flow_model is not None:
        return solution
    contact = outcome.state.contact
    grid = outcome.state.levels[-1].grid
    # where the film found is none
    guess = THINNEST * contact.film_guess / (contact.curvature_x * grid.hx**2)
    fineness = max(_fineness(outcome), guess) / RESOLVED
    return thin_film(solution, fineness, lambda lighter: _solve(lighter, options, None)[1])


def _solve(
    conditions: ContactConditions | MoesConditions,
    options: SolverOptions,
    flow_model: FlowModel | None,
) -> tuple[Outcome, ContactSolution]:
    """One contact on the number of points asked for."""
    contact = scale_contact(conditions)
    turned = scale_contact(conditions, along_entrainment=True)
    began = time.perf_counter()
    progress = Progress()
    if options.domain is None:
        domain, film = _pilot(contact, progress)
        contact, turned = replace(contact, film_guess=film), replace(turned, film_guess=film)
    else:
        domain = options.domain
    lighter = tuple(scale_contact(at_load(conditions, share)) for share in LOAD_STEPS)
    outcome = solve_with_fallbacks(
        (contact, turned), domain, options, progress, flow_model, lighter
    )
    record = ConvergenceRecord(
        residual=tuple(outcome.residual),
        force_error=tuple(outcome.load),
        film_change=tuple(outcome.changes),
        cycles=len(outcome.changes),
        fft_equivalents=progress.deflected_nodes / outcome.state.levels[-1].P.size,
        fallbacks=tuple(progress.fallbacks),
        wall_time=time.perf_counter() - began,
    )
    return outcome, _solution(conditions, options, outcome, record)


def _solve_to_tolerance(
    conditions: ContactConditions | MoesConditions,
    options: SolverOptions,
    tolerance: float,
    flow_model: FlowModel | None,
) -> ContactSolution:
    """Double the points until both error bars are small enough, or the budget is spent: then say
    so.
    """
    points = min(TOLERANCE_START, options.points)
    wall_time = 0.0
    while True:
        solution = solve_contact(
            conditions, replace(options, points=points, tolerance=None), flow_model
        )
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
            f"tolerance {tolerance:g} not reached at {points} points: error bars {bars[0]:.1e} central, "
            f"{bars[1]:.1e} minimum film; try more points"
        )
    record = replace(solution.record, wall_time=wall_time)
    return replace(
        solution,
        options=options,
        record=record,
        message=message,
        resolved=solution.resolved and bool(reached),
    )


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
        outcome = Outcome(
            state=contact_multigrid(pilot, _box(contact, film, scale), options, ATTEMPTS[0])
        )
        try:
            full_multigrid(outcome, options, Progress())
        except DivergedError:
            progress.fallbacks.append("pilot solve ran away: box from the film formula")
            return _box(contact, contact.film_guess, 1.5), contact.film_guess
        progress.deflected_nodes += outcome.state.deflected_nodes()
        film = max(outcome.films[-1][0], 0.1 * contact.film_guess)
        scale *= max(1.0, min(3.0, outcome.state.exterior / contact.load / EXTERIOR_SHARE))
    return _box(contact, film, scale), film


def _box(contact: ScaledContact, film: float, scale: float) -> tuple[float, float, float]:
    """Box for a central film [-]; outlet 1.5 semi-axes, or as far as a thick film cavitates."""
    inlet = scale * max(4.0, 10.0 * sqrt(film / contact.curvature_x) / contact.half_extent_x)
    # oblique: an inlet, too
    gap_side = (40.0 + 60.0 * contact.velocity_y**2) * film / contact.curvature_y
    side = scale * sqrt(2.5**2 + gap_side / contact.half_extent_y**2)
    return -inlet, max(1.5, 1.2 * sqrt(film / contact.curvature_x) / contact.half_extent_x), side


def _solution(
    conditions: ContactConditions | MoesConditions,
    options: SolverOptions,
    outcome: Outcome,
    record: ConvergenceRecord,
) -> ContactSolution:
    state = outcome.state
    contact = state.contact
    grid = state.levels[-1].grid
    Y, P, H = whole_box(state)
    resolved, message = verdict(outcome)
    return ContactSolution(
        conditions=conditions,
        options=options,
        X=grid.X,
        Y=Y,
        P=P,
        H=H,
        film_central_dimensionless=_film(outcome, 0),
        film_minimum_dimensionless=_film(outcome, 1),
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
        converged=outcome.converged(),
        message=message,
        record=record,
    )


def _film(outcome: Outcome, kind: int) -> FilmValue:
    """Central (0) or minimum (1) film extrapolated; not a number where the iteration ran away."""
    if not outcome.films:
        return FilmValue(value=nan, uncertainty=nan, finest=nan)
    return extrapolate([film[kind] for film in outcome.films], outcome.remaining_error())


def whole_box(state: Multigrid) -> tuple[Array, Array, Array]:
    """Y, P and H of the finest grid over the whole box; fields of shape (nx, ny)."""
    level = state.levels[-1]
    Y = level.grid.Y
    P = level.P
    H = level.H
    if level.grid.symmetric:
        Y = np.concatenate((-Y[:0:-1], Y))
        P, H = np.concatenate((P[:0:-1], P)), np.concatenate((H[:0:-1], H))
    return Y, P.T, H.T


def _domain(contact: ScaledContact, grid: Grid) -> tuple[float, float, float]:
    """Box of a grid in Hertz half-extents."""
    x_in = float(grid.X[0]) / contact.half_extent_x
    x_out = float(grid.X[-1]) / contact.half_extent_x
    return x_in, x_out, float(grid.Y[-1]) / contact.half_extent_y


def verdict(outcome: Outcome) -> tuple[bool, str]:
    """Whether the film of a solve is resolved, and what is to be said of it."""
    resolved = (
        bool(outcome.films)
        and _fineness(outcome) >= RESOLVED
        and _film_over_radius(outcome) <= PARABOLIC
    )
    return resolved, _message(outcome, resolved)


def _fineness(outcome: Outcome) -> float:
    """Hmin/(S hx^2): minimum film over twice what the gap rises within a mesh size [-]; zero after
    a runaway.
    """
    if not outcome.films:
        return 0.0
    curvature = outcome.state.contact.curvature_x
    return outcome.films[-1][1] / (curvature * outcome.state.levels[-1].grid.hx ** 2)


def _too_thin(outcome: Outcome) -> bool:
    """Whether the mesh is too coarse for the film, in a gap that is a paraboloid."""
    return not outcome.films or (
        _fineness(outcome) < RESOLVED and _film_over_radius(outcome) <= PARABOLIC
    )


def _film_over_radius(outcome: Outcome) -> float:
    """Central film over Rx [-]; zero where no lengths are given."""
    contact = outcome.state.contact
    if contact.film_scale is None or contact.semi_axis_x is None:
        return 0.0
    return outcome.films[-1][0] * (contact.film_scale / contact.semi_axis_x) ** 2


def _message(outcome: Outcome, resolved: bool) -> str:
    if not outcome.films:
        return "the iteration ran away in spite of stronger damping; try more points or a smaller load"
    if not outcome.converged():
        change, load = outcome.changes[-1], outcome.load[-1]
        return f"not converged: film changed by {change:.1e} in the last cycle, load error {load:.1e}; try more points"
    if _film_over_radius(outcome) > PARABOLIC:
        share = _film_over_radius(outcome)
        return f"outside the model: the film is {share:.1%} of Rx, where the gap is no paraboloid; an upper bound"
    if not resolved:
        ratio = _fineness(outcome)
        return f"converged but unresolved: minimum film/(mesh size)^2 is {ratio:.2f}, below {RESOLVED:g}; try more points"
    return "converged"
