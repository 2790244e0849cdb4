"""Run of a single contact."""

from collections.abc import Callable
from time import perf_counter

from ehl import ContactConditions, ContactSolution
from ehl.finite_element.solver import solve_contact_finite_element
from ehl.kinematics import contact_kinematics
from ehl.traction.rolling_moment import rolling_moment
from ehl.traction.shear import TractionResult, integrate_traction
from postprocess.contact.results import ContactResults

from ..format.case import ContactCase
from ..version import version
from .films import shared_options

FINITE_ELEMENT_NOTE = (
    "finite elements: points are those of the graded mesh, cycles are Newton steps, no FFT"
)
NO_TOLERANCE = "ehl.tolerance: not used by finite elements, the film is solved on ehl.points"


def run_contact(
    case: ContactCase, *, finite_element: bool = False, workers: int = 1
) -> ContactResults:
    """Solve a single contact, by multigrid or by finite elements; times in the result are in [s].

    A large contact is shared by as many threads as there are `workers` [-].
    """
    messages = (*case.warnings, *case.films.messages)
    solve: Callable[..., ContactSolution] = case.films.solve
    if finite_element:
        solve = solve_contact_finite_element
        unused = () if case.solver.tolerance is None else (NO_TOLERANCE,)
        messages = (*messages, FINITE_ELEMENT_NOTE, *unused)
    start = perf_counter()
    solution = solve(case.conditions, shared_options(case.solver, workers))
    traction = _contact_traction(case, solution)
    return ContactResults(
        version=version(),
        case=case.document,
        solution=solution,
        messages=messages,
        timing={"total": perf_counter() - start},
        traction=traction,
    )


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
