"""Run of a single contact."""

from collections.abc import Callable
from dataclasses import replace
from time import perf_counter

from oilfilm.bearing.supply.track import SolvedPass, solved_passes
from oilfilm.ehl import (
    ContactConditions,
    ContactSolution,
    MoesConditions,
    SolverOptions,
    solve_contact,
)
from oilfilm.ehl.conditions import contact_kinematics
from oilfilm.ehl.finite_element.solver import solve_contact_finite_element
from oilfilm.ehl.traction import NormalResponse, normal_response
from oilfilm.ehl.traction.rolling_moment import rolling_moment
from oilfilm.ehl.traction.shear import TractionResult, integrate_traction
from oilfilm.postprocess.contact.summary import ContactResults

from ..format.case import ContactCase
from ..format.contact import FilmModel
from .films import shared_options

FINITE_ELEMENT_NOTE = (
    "finite elements: points are those of the graded mesh, cycles are Newton steps, FFTs are on "
    "the lattice of its lines"
)
START_NOTE = (
    "started from the pressure of the multigrid on {points} points; mesh, equations and "
    "deflection are the elements' own"
)
NO_START_NOTE = "the multigrid gave no start: reached through lighter loads"
START_POINTS = 257  # of the multigrid at most
NO_CERTIFICATE = "ehl.certify: not used by finite elements, which are solved by Newton's method"
NO_ELEMENTS = "the film was solved by finite elements"
MOST_RESPONSE_POINTS = 257  # more are left to `normal_response`
NO_LAYER = "ehl.starvation: not used by finite elements, the film is flooded"
NO_PASSES = "ehl.track_passes: not used by finite elements, the film is flooded"
NO_TOLERANCE = "ehl.tolerance: not used by finite elements, the film is solved on ehl.points"


def run_contact(
    case: ContactCase, *, finite_element: bool = False, workers: int = 1
) -> ContactResults:
    """Solve a single contact, by multigrid or by finite elements.

    Parameters
    ----------
    case : ContactCase
        The contact.
    finite_element : bool, default False
        True: finite elements.
    workers : int, default 1
        Threads that share a large contact [-].

    Returns
    -------
    ContactResults
        Film, traction and response; times in [s].

    Examples
    --------
    >>> import oilfilm
    >>> results = oilfilm.run_contact(oilfilm.load_case("moes_20_10"))
    >>> results.solution.converged
    True
    """
    messages = (*case.warnings, *case.films.messages)
    start = perf_counter()
    options = shared_options(case.solver, workers)
    solve: Callable[..., ContactSolution] = case.films.solve
    if finite_element:
        flooded = replace(case.conditions, inlet_layer=None)
        solution, notes = _by_elements(flooded, options)
        if case.conditions.inlet_layer is not None:
            notes = (*notes, NO_LAYER)
        unused = () if case.solver.tolerance is None else (NO_TOLERANCE,)
        unused = (*unused, NO_CERTIFICATE) if case.solver.certify else unused
        messages = (*messages, *notes, *unused)
    else:
        solution = solve(case.conditions, options)
    passes: tuple[SolvedPass, ...] = ()
    if case.passes is not None and finite_element:
        messages = (*messages, NO_PASSES)
    elif case.passes is not None and solution.converged:
        passes = solved_passes(case.conditions, options, case.passes, solve, solution)
    traction = _contact_traction(case, solution)
    no_response = NO_ELEMENTS if finite_element else _no_response(case, solution)
    response = None if no_response else _response(case)
    return ContactResults(
        case=case.document,
        solution=solution,
        messages=messages,
        timing={"total": perf_counter() - start},
        traction=traction,
        response=response,
        no_response=no_response,
        passes=passes,
    )


def _no_response(case: ContactCase, solution: ContactSolution) -> str:
    """Reason why stiffness and damping are not computed; empty if they are."""
    if not isinstance(case.conditions, ContactConditions):
        return "the case gives no lengths"
    if case.films.model is not FilmModel.NEWTONIAN:
        return "the film was solved with shear or heat"
    return "" if solution.converged else "the film did not converge"


def _response(case: ContactCase) -> NormalResponse:
    """Stiffness and damping on the points of the case, 257 of them at most."""
    assert isinstance(case.conditions, ContactConditions)
    points = case.solver.points
    few = None if points is None or points > MOST_RESPONSE_POINTS else points
    options = replace(case.solver, points=few, threads=1)
    return normal_response(case.conditions, options, case.frequencies)


def _by_elements(
    conditions: ContactConditions | MoesConditions, options: SolverOptions
) -> tuple[ContactSolution, tuple[str, ...]]:
    """Solution by finite elements from the multigrid's, and notes on it."""
    points = min(options.max_points, START_POINTS)
    grid = solve_contact(conditions, replace(options, points=points, tolerance=None))
    start = grid if grid.converged else None
    note = START_NOTE.format(points=points) if start else NO_START_NOTE
    solution = solve_contact_finite_element(conditions, options, start)
    return solution, (FINITE_ELEMENT_NOTE, note)


def _contact_traction(case: ContactCase, solution: ContactSolution) -> TractionResult | None:
    """Shear of a single contact with lengths, None where the film did not converge."""
    conditions = case.conditions
    if not isinstance(conditions, ContactConditions):
        return None
    if case.rheology is None or not solution.converged:
        return None
    motion = contact_kinematics(conditions, grid_angle=solution.frame_angle)
    return integrate_traction(
        solution,
        motion,
        case.rheology,
        temperature=case.temperature,
        rolling_resistance=rolling_moment(solution).value,
    )
