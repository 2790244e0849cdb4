"""States of a duty cycle: equilibrium, life and friction torque of each."""

from dataclasses import replace

from bearing.contacts.contact import BearingContact
from bearing.contacts.contacts import contact_conditions
from bearing.operation import BallKinematics
from bearing.quasistatic.solution import QuasistaticSolution
from bearing.rating.duty_cycle import DutyCycle, LoadCase, duty_cycle
from bearing.rating.life import bearing_life
from bearing.torque.breakdown import torque_breakdown
from bearing.torque.integrated import films_torque

from ..format.case import Case, LoadCaseInput, new_notes
from .equilibrium import Equilibria, case_equilibrium, without_traction_equilibrium
from .films import Progress
from .heating import with_temperature

HALF_AND_HALF = (
    "its balls are taken as half and half in place of traction equilibrium, which loads hardly "
    "depend on"
)


def solve_load_cases(
    case: Case, notify: Progress, equilibria: Equilibria | None = None
) -> DutyCycle | None:
    """Life, torque and energy over the duty cycle of a case.

    Every state has its own equilibrium, clearance and oil; its torque is that of films of
    formulas.

    Parameters
    ----------
    case : Case
        The bearing.
    notify : Progress
        Called with states done, states in all, and a text.
    equilibria : Equilibria | None, optional
        Equilibria solved before.

    Returns
    -------
    DutyCycle | None
        The duty cycle; None where the case has none.
    """
    if not case.load_cases:
        return None
    equilibria = equilibria or Equilibria()
    solved = []
    for number, state in enumerate(case.load_cases):
        notify(number, len(case.load_cases), "load cases")
        solved.append(_load_case(state, case.warnings, equilibria))
    return duty_cycle(case.bearing, solved)


def _load_case(state: LoadCaseInput, known: tuple[str, ...], equilibria: Equilibria) -> LoadCase:
    """One state, with the messages that are not `known`, those of [operation]."""
    case = with_temperature(state.case, equilibria=equilibria)
    messages = new_notes(case.warnings, known)
    if case.model.ball_kinematics is BallKinematics.TRACTION_EQUILIBRIUM:
        case = replace(case, model=without_traction_equilibrium(case.model))
        messages.append(HALF_AND_HALF)
    solution = case_equilibrium(case, equilibria)
    if not solution.converged:
        messages.append(f"equilibrium not converged: {solution.message}")
    contacts = contact_conditions(solution, case.lubricant)
    torque, model = _torque(case, solution, contacts)
    assert case.rating is not None  # of every bearing case
    pressures = [contact.hertz.pressure for contact in contacts if contact.hertz is not None]
    return LoadCase(
        time_share=state.time_share,
        operation=case.operation,
        viscosity=case.lubricant.viscosity / case.lubricant.density,
        largest_load=max(contact.load for contact in contacts),
        largest_pressure=max(pressures, default=0.0),
        life=bearing_life(solution, case.lubricant, case.rating),
        converged=solution.converged,
        torque=torque,
        torque_model=model,
        messages=tuple(messages),
    )


def _torque(
    case: Case, solution: QuasistaticSolution, contacts: tuple[BearingContact, ...]
) -> tuple[float | None, str | None]:
    """Friction torque with films of formulas [N m], and its model."""
    if case.friction is None or not solution.converged:
        return None, None
    if not solution.operation.shaft_speed:
        return 0.0, None
    shear = None
    if case.rheology is not None:
        arguments = (case.friction, case.inlet, case.rheology, case.lubricant)
        shear = films_torque(solution, contacts, (None,) * len(contacts), *arguments)
    found = torque_breakdown(solution, contacts, case.lubricant, case.friction, shear=shear)
    return found.total, found.chosen
