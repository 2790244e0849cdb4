"""Solve one lubricated contact: its mesh, its fields, its film values with error bars."""

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import log2, sqrt

import numpy as np

from .arrays import Array
from .closed_form.film import MAX_FILM_OVER_RADIUS
from .conditions import ContactConditions, MoesConditions
from .grid import Grid, unfolded
from .multigrid.film_values import (
    approach_value,
    film_error_by_box,
    film_over_radius,
    film_value,
    resolution_message,
    tolerance_reached,
    unconfirmed_by_finer_mesh,
    with_status,
    with_tolerance_status,
)
from .multigrid.full_multigrid import (
    ACCEPTED_ERROR,
    ATTEMPTS,
    CAUTIOUS,
    Attempt,
    AttemptResult,
    Progress,
    add_level,
    choose_domain,
    solve_with_fallbacks,
)
from .multigrid.history import CENTRAL, MINIMUM
from .multigrid.levels import Damping, FlowModel, Multigrid
from .multigrid.newton import certify
from .multigrid.supply.oil_supply import (
    inlet_ratio,
    oil_supply,
    reverse_flow_message,
    starved_film_guess,
)
from .multigrid.supply.starvation_law import between_layers, with_inlet_film_by_law
from .options import SolverOptions
from .scaling import ScaledContact, scale_contact
from .solution import ContactSolution, ConvergenceRecord

FLOODED_ONLY = "inlet_layer: films with shear or heat are solved flooded only"
CAUTIOUS_LEVEL = "finer mesh with damping halved, less Gauss-Seidel"
# Hc/(S hx^2) of the first mesh times the tolerance, Hc of the film formula: of a contact that is
# even in Y, and of others, which have twice the nodes. Of 20 drawn at an angle or rotating 13
# reach 1 % on half the points that the former would begin with
FIRST_FINENESS = (6.0, 1.5)
FEWEST_POINTS = 65  # of the first mesh
# Bars up to so many times the tolerance are accepted where the next mesh has more nodes than that,
# some 5 s: at M 180, L 10 and 41 degrees it took 22 to 49 s, and moved films by 0.03 % where
# 1.03 % stood for 1 %
NEAR_TOLERANCE = 1.3
LARGE_MESH = 5e5
TRACK_LINES = 101  # over the Hertz ellipse, on which a layer is looked for its ends
# M above and L below which hardly more than half of the contacts have a solution, after 25 s and
# more: one attempt is made
SOFT = (7e3, 0.15)


def solve_contact(
    conditions: ContactConditions | MoesConditions,
    options: SolverOptions | None = None,
    flow_model: FlowModel | None = None,
) -> ContactSolution:
    """Pressure and film of a steady, flooded elliptical contact by full multigrid.

    Venner and Lubrecht (2000) with the changes described in `multigrid/cycle.py` and
    `multigrid/far_field.py`; without a flow model the oil is Newtonian and of uniform
    temperature. Behind a layer at the inlet the flooded film is solved first, see `solve_starved`.

    Parameters
    ----------
    conditions : ContactConditions | MoesConditions
        the contact, in SI or by Moes' groups
    options : SolverOptions | None, optional
        mesh, tolerance and effort; None: the defaults
    flow_model : FlowModel | None, optional
        flow of an oil with shear thinning or heat; None: Newtonian and isothermal

    Returns
    -------
    ContactSolution
        Failure to converge is a result, not an exception: see `converged` and `message`.

    Raises
    ------
    ValueError
        if the conditions leave the problem undetermined; the message names the field

    Examples
    --------
    >>> from oilfilm import ContactConditions, Lubricant, SolverOptions, solve_contact
    >>> oil = Lubricant(viscosity=0.04, pressure_viscosity=22e-9)
    >>> contact = ContactConditions(load=50.0, radius_x=6e-3, radius_y=60e-3,
    ...     reduced_modulus=2.3e11, entrainment_speed=5.0, lubricant=oil)
    >>> solution = solve_contact(contact, SolverOptions(points=65))
    >>> solution.converged, f"{solution.film_central * 1e6:.1f} um"
    (True, '0.8 um')
    """
    options = options or SolverOptions()
    if conditions.inlet_layer is not None:
        solve = solve_by_law if options.tabulated else solve_starved
        return solve(conditions, options, flow_model)
    return solve_attempts(conditions, options, flow_model)[0]


def solve_attempts(
    conditions: ContactConditions | MoesConditions,
    options: SolverOptions,
    flow_model: FlowModel | None = None,
    attempts: tuple[Attempt, ...] = ATTEMPTS,
    film_guess: float | None = None,
) -> tuple[ContactSolution, Multigrid]:
    """A contact by chosen attempts as by `solve_levels`, with the grids and fields of its
    solution.

    Parameters
    ----------
    conditions : ContactConditions | MoesConditions
        the contact, in SI or by Moes' groups
    options : SolverOptions
        mesh, tolerance and effort
    flow_model : FlowModel | None, optional
        flow of an oil with shear thinning or heat; None: Newtonian and isothermal
    attempts : tuple[Attempt, ...], default ATTEMPTS
        settings of the multigrid, tried one after the other until one converges
    film_guess : float | None, optional
        central film to start from, in units of a^2/Rx [-]; None: that of the film formula

    Returns
    -------
    solution
        the solution of the attempt that came closest
    levels
        its grids and fields
    """
    solution, result = solve_levels(conditions, options, flow_model, attempts, film_guess)
    return solution, result.state


def solve_levels(
    conditions: ContactConditions | MoesConditions,
    options: SolverOptions,
    flow_model: FlowModel | None = None,
    attempts: tuple[Attempt, ...] = ATTEMPTS,
    film_guess: float | None = None,
    fewest: int = FEWEST_POINTS,
) -> tuple[ContactSolution, AttemptResult]:
    """A contact by chosen attempts, with the histories of the levels of its solution.

    Parameters
    ----------
    conditions : ContactConditions | MoesConditions
        the contact, in SI or by Moes' groups
    options : SolverOptions
        mesh, tolerance and effort
    flow_model : FlowModel | None, optional
        flow of an oil with shear thinning or heat; None: Newtonian and isothermal
    attempts : tuple[Attempt, ...], default ATTEMPTS
        settings of the multigrid, tried one after the other until one converges
    film_guess : float | None, optional
        central film to start from, in units of a^2/Rx [-]; None: that of the film formula
    fewest : int, default FEWEST_POINTS
        points of the first mesh at least, to a tolerance [-]

    Returns
    -------
    solution
        the solution of the attempt that came closest
    result
        its levels and their histories
    """
    tolerance = options.wanted_tolerance
    progress = Progress()
    start = time.perf_counter()
    contact = scale_contact(conditions)
    domain = options.domain or choose_domain(contact)
    problem = _Problem(conditions, domain, flow_model, film_guess)
    points = options.max_points
    if tolerance is not None:
        points = _first_points(problem.scaled()[0], domain, tolerance, points, fewest)
    mesh = replace(options, points=points)
    soft = contact.moes_load > SOFT[0] and contact.moes_lubricant < SOFT[1]
    attempts = attempts[:1] if soft else attempts
    solution, result = _solve(problem, mesh, attempts, progress)
    while tolerance is not None and points < options.max_points:
        if (
            tolerance_reached(solution, tolerance)
            or film_over_radius(solution) > MAX_FILM_OVER_RADIUS
        ):
            break
        if _bounded_by_box(solution, result, tolerance):
            break
        if _finer_nodes(result) > LARGE_MESH and tolerance_reached(
            solution, NEAR_TOLERANCE * tolerance
        ):
            break
        mesh = replace(mesh, points=2 * points - 1)
        sound = solution.converged and solution.resolved
        further = () if sound else attempts
        finer, finer_result = _solve_finer(problem, mesh, result, further, progress)
        if sound and not finer.converged:
            solution = unconfirmed_by_finer_mesh(solution)
            break
        points = 2 * points - 1
        solution, result = finer, finer_result
    if options.certify and result.converged:
        _certify(result, progress)
        solution = _assembled(conditions, solution.options, result, progress)
    if tolerance is not None:
        at = f"{points} points"
        if _bounded_by_box(solution, result, tolerance):
            at += " (by the load outside the box, of which no mesh takes anything away)"
        else:
            at += f" (a finer mesh of {_finer_nodes(result):.1e} nodes costs four times as much)"
        solution = with_tolerance_status(solution, tolerance, at)
    if soft and not solution.converged:
        outside = f"M above {SOFT[0]:g} with L below {SOFT[1]:g} is outside of what is solved"
        solution = replace(solution, message=f"{solution.message}; {outside}")
    record = replace(solution.record, wall_time=time.perf_counter() - start)
    return replace(solution, options=options, record=record), result


def solve_nested(
    conditions: ContactConditions | MoesConditions, meshes: Sequence[SolverOptions]
) -> Iterator[tuple[ContactSolution, Multigrid]]:
    """A flooded contact on a series of meshes without tolerance, each started from the one before.

    Parameters
    ----------
    conditions : ContactConditions | MoesConditions
        the contact, in SI or by Moes' groups
    meshes : Sequence[SolverOptions]
        options with `points`, each with half the mesh size of the one before

    Yields
    ------
    Iterator[tuple[ContactSolution, Multigrid]]
        solution and levels of each mesh
    """
    domain = meshes[0].domain or choose_domain(scale_contact(conditions))
    problem = _Problem(conditions, domain, None, None)
    result = None
    for options in meshes:
        progress = Progress()
        if result is None:
            solution, result = _solve(problem, options, ATTEMPTS, progress)
        else:
            solution, result = _solve_finer(problem, options, result, ATTEMPTS, progress)
        yield solution, result.state


def solve_starved(
    conditions: ContactConditions | MoesConditions,
    options: SolverOptions,
    flow_model: FlowModel | None = None,
) -> ContactSolution:
    """A contact behind a layer of oil: the flooded film, then the film with mass conserved.

    See `multigrid/starved.py`. Not converged where the oil runs against the entrainment somewhere
    in the box, for example near a pole of spin.

    Parameters
    ----------
    conditions : ContactConditions | MoesConditions
        the contact, with its `inlet_layer`
    options : SolverOptions
        mesh, tolerance and effort
    flow_model : FlowModel | None, optional
        None; there is no other one behind a layer

    Returns
    -------
    ContactSolution
        the starved film; its `supply` compares it with the flooded one

    Raises
    ------
    ValueError
        if a flow model or a certificate is requested: neither exists behind a layer
    """
    if flow_model is not None:
        raise ValueError(FLOODED_ONLY)
    if options.certify:
        raise ValueError("certify: Newton's method has no equations of a layer at the inlet")
    return solve_with_inlet_film(conditions, options)[0]


def solve_with_inlet_film(
    conditions: ContactConditions | MoesConditions, options: SolverOptions
) -> tuple[ContactSolution, Multigrid]:
    """A contact behind a layer of oil as by `solve_starved`, with the levels of its solution.

    Parameters
    ----------
    conditions : ContactConditions | MoesConditions
        the contact, with its `inlet_layer`
    options : SolverOptions
        mesh, tolerance and effort

    Returns
    -------
    solution
        the starved film, or the flooded one with a message if there is none
    levels
        grids and fields of that film
    """
    layer = scale_contact(conditions).inlet_layer
    assert layer is not None
    flooded, levels = solve_attempts(replace(conditions, inlet_layer=None), options)
    if not flooded.converged:
        message = f"flooded film: {flooded.message}"
        return replace(flooded, conditions=conditions, message=message), levels
    if turned := reverse_flow_message(levels):
        unsolved = replace(flooded, conditions=conditions, message=turned)
        return replace(unsolved, converged=False, resolved=False), levels
    ratio = inlet_ratio(layer.central, flooded, levels.contact)
    guess = starved_film_guess(flooded.film_central_dimensionless.value, ratio)
    starved, levels = solve_attempts(conditions, options, film_guess=guess)
    time_of_both = starved.record.wall_time + flooded.record.wall_time
    supply = oil_supply(flooded, starved, levels, ratio)
    work_of_both = starved.record.fft_equivalents + supply.flooded_fft_equivalents
    record = replace(starved.record, wall_time=time_of_both, fft_equivalents=work_of_both)
    return replace(starved, record=record, supply=supply), levels


def solve_by_law(
    conditions: ContactConditions | MoesConditions,
    options: SolverOptions,
    flow_model: FlowModel | None = None,
) -> ContactSolution:
    """A contact behind a layer of oil: the flooded film, reduced by the tabulated law of
    starvation.

    See `multigrid/supply/starvation_law.py`. Of a layer that is not uniform the law has the middle
    of the track, and the message says so.

    Parameters
    ----------
    conditions : ContactConditions | MoesConditions
        the contact, with its `inlet_layer`
    options : SolverOptions
        mesh, tolerance and effort of the flooded film
    flow_model : FlowModel | None, optional
        None; the law holds for Newtonian films without heat

    Returns
    -------
    ContactSolution
        the starved film by the law, fields of the flooded one

    Raises
    ------
    ValueError
        if a flow model is requested
    """
    contact = scale_contact(conditions)
    assert contact.inlet_layer is not None
    if flow_model is not None:
        raise ValueError(FLOODED_ONLY)
    flooded, levels = solve_attempts(replace(conditions, inlet_layer=None), options)
    if not flooded.converged:
        return replace(flooded, conditions=conditions, message=f"flooded film: {flooded.message}")
    frames = (levels.contact, scale_contact(conditions, along_entrainment=True))
    layer = contact.inlet_layer
    solution = with_inlet_film_by_law(flooded, conditions, frames, layer.central)
    if layer.uniform:
        return solution
    across = layer.at(np.linspace(-contact.half_extent_y, contact.half_extent_y, TRACK_LINES))
    ends = (float(across.min()), float(across.max()))
    thin, thick = (with_inlet_film_by_law(flooded, conditions, frames, end) for end in ends)
    return between_layers(solution, thin, thick)


def _certify(result: AttemptResult, progress: Progress) -> None:
    """Newton's method after the cycles on the finest level, with its certificate."""
    state = result.state
    before = state.deflected_nodes()
    result.certificate = certify(state)
    progress.deflected_nodes += state.deflected_nodes() - before
    if result.certificate.certified:
        result.levels[-1].certify(state, len(state.levels) - 1)


def _finer_nodes(result: AttemptResult) -> int:
    """Nodes of the next mesh."""
    return 4 * result.state.levels[-1].P.size


def _bounded_by_box(solution: ContactSolution, result: AttemptResult, tolerance: float) -> bool:
    """Tell whether the load outside the box keeps the films from their tolerance."""
    return film_error_by_box(result) > max(tolerance, 0.5 * solution.widest_bar)


def _first_points(
    contact: ScaledContact,
    domain: tuple[float, float, float],
    tolerance: float,
    most: int,
    fewest: int,
) -> int:
    """Points of the first mesh to a tolerance, by the film formula."""
    fineness = FIRST_FINENESS[not contact.symmetric] / tolerance
    mesh = sqrt(contact.film_guess / contact.curvature_x / fineness)
    cells = (domain[1] - domain[0]) * contact.half_extent_x / mesh
    points = 2 ** max(round(log2(cells)), 0) + 1
    return min(max(points, fewest), most)


@dataclass(frozen=True, slots=True)
class _Problem:
    """A contact in its box; `film_guess`: central film to start from [-], None: of the formula."""

    conditions: ContactConditions | MoesConditions
    domain: tuple[float, float, float]
    flow_model: FlowModel | None
    film_guess: float | None

    def scaled(self) -> tuple[ScaledContact, ScaledContact]:
        """On a grid along a principal direction and on one along the entrainment."""
        straight = scale_contact(self.conditions)
        turned = scale_contact(self.conditions, along_entrainment=True)
        if self.film_guess is None:
            return straight, turned
        guess = self.film_guess
        return replace(straight, film_guess=guess), replace(turned, film_guess=guess)


def _solve(
    problem: _Problem, options: SolverOptions, attempts: tuple[Attempt, ...], progress: Progress
) -> tuple[ContactSolution, AttemptResult]:
    """One contact on the number of points of the options; its record counts the work of `progress`
    before, too.
    """
    progress.fallbacks.clear()
    result = solve_with_fallbacks(
        problem.scaled(), problem.domain, options, progress, problem.flow_model, attempts
    )
    return _assembled(problem.conditions, options, result, progress), result


def _solve_finer(
    problem: _Problem,
    options: SolverOptions,
    coarse: AttemptResult,
    attempts: tuple[Attempt, ...],
    progress: Progress,
) -> tuple[ContactSolution, AttemptResult]:
    """A contact on twice the points, from its solution on the coarser mesh.

    Without one, or if it does not converge, all attempts follow, the closest one first. Without
    attempts the coarser films stay if their solution does not lead to a finer one with more
    damping either.
    """
    results: list[AttemptResult] = []
    dampings: list[Damping | None] = [] if attempts else [CAUTIOUS]
    if coarse.converged and not coarse.attempt.newton:
        dampings.insert(0, None)
    for damping in dampings:
        if results:
            progress.fallbacks.append(CAUTIOUS_LEVEL)
        results.append(add_level(coarse, problem.domain, options, progress, damping))
        if results[-1].converged and results[-1].error < ACCEPTED_ERROR:
            break
    if results and (not attempts or results[-1].error < ACCEPTED_ERROR):
        best = min(results, key=lambda result: result.rank)
        return _assembled(problem.conditions, options, best, progress), best
    attempts = (coarse.attempt, *(a for a in attempts if a is not coarse.attempt))
    return _solve(problem, options, attempts, progress)


def _assembled(
    conditions: ContactConditions | MoesConditions,
    options: SolverOptions,
    result: AttemptResult,
    progress: Progress,
) -> ContactSolution:
    """The solution of an attempt, with the work up to it."""
    record = with_history(
        ConvergenceRecord(
            residual=(),
            force_error=(),
            film_change=(),
            cycles=0,
            fft_equivalents=progress.deflected_nodes / result.state.levels[-1].P.size,
            fallbacks=tuple(progress.fallbacks),
            wall_time=0.0,
            certificate=result.certificate,
            attempt=result.attempt.name,
        ),
        result,
    )
    return with_status(_solution(conditions, options, result, record), film_error_by_box(result))


def with_history(record: ConvergenceRecord, result: AttemptResult) -> ConvergenceRecord:
    """The record with the cycles on the finest level.

    Parameters
    ----------
    record : ConvergenceRecord
        record of the attempt
    result : AttemptResult
        levels of the attempt with their histories

    Returns
    -------
    ConvergenceRecord
        the completed record
    """
    if not result.levels:
        return record
    history = result.levels[-1]
    return replace(
        record,
        residual=tuple(history.residual),
        force_error=tuple(history.load),
        film_change=tuple(history.changes),
        cycles=len(history.residual),
        mass_imbalance=history.imbalance[-1],
    )


def at_load(
    conditions: ContactConditions | MoesConditions, factor: float
) -> ContactConditions | MoesConditions:
    """The contact under a multiple of its load.

    Parameters
    ----------
    conditions : ContactConditions | MoesConditions
        the contact, in SI or by Moes' groups
    factor : float
        of the load [-]

    Returns
    -------
    ContactConditions | MoesConditions
        conditions at the other load
    """
    if isinstance(conditions, MoesConditions):
        return replace(conditions, load_parameter=factor * conditions.load_parameter)
    return replace(conditions, load=factor * conditions.load)


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
    central, minimum = film_value(result, CENTRAL), film_value(result, MINIMUM)
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
        approach_dimensionless=approach_value(result),
        **contact.of_solution,
        domain=_domain(contact, grid),
        resolved=resolved,
        converged=result.converged,
        message=message,
        record=record,
    )


def unfold_symmetry(state: Multigrid) -> tuple[Array, Array, Array]:
    """Y, P and H of the finest grid over the whole box.

    Parameters
    ----------
    state : Multigrid
        levels of the solve, the finest last

    Returns
    -------
    Y
        shape (ny,) [-]
    P
        shape (nx, ny) [-]
    H
        shape (nx, ny) [-]
    """
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
