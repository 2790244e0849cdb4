"""A case that warms itself: the temperature at which friction and cooling agree."""

import warnings
from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from bearing.contacts.contact import BearingContact
from bearing.heating.self_heating import (
    SelfHeatingProblem,
    SelfHeatingSolution,
    solve_self_heating,
)
from bearing.quasistatic.solution import QuasistaticSolution
from bearing.rows import SINGLE
from bearing.torque.breakdown import model_torque
from ehl import Lubricant
from ehl.units import from_si

from ..format.case import Case, case_of_file
from ..format.fields import rounded
from ..format.fits import part_temperatures
from ..format.operation import SELF_HEATED
from .equilibrium import without_traction_equilibrium

Contacts = Sequence[BearingContact]


def at_its_temperature(case: Case) -> Case:
    """The case at the temperature that its bearing warms itself to, where it asks for that: oil
    and films, and with fits or temperatures the parts and the clearance as well.

    Without a balance the case stays at `operation.temperature_C`, with a warning.
    """
    if case.file.operation.temperature != SELF_HEATED:
        return case
    heating = self_heated(case)
    if heating is None or heating.balance is None or not heating.converged:
        why = "nothing turns" if heating is None else heating.note
        note = f"operation.temperature: not self-heated, {why}; temperature_C is taken"
        given = case.file.operation.model_copy(update={"temperature": "given"})
        file = case.file.model_copy(update={"operation": given})
        return replace(case, file=file, warnings=(note, *case.warnings))
    balanced = from_si("temperature_C", heating.balance.temperature)
    file = case.file
    operation = {"temperature_C": rounded(balanced), "temperature": "given"}
    changed: dict[str, Any] = {"operation": file.operation.model_copy(update=operation)}
    if case.heating is not None and case.heating.reference is not None:
        parts = part_temperatures(file.temperatures, balanced, case.heating.inner_excess)
        changed["temperatures"] = parts
    found = case_of_file(file.model_copy(update=changed), case.title or "case")
    assert isinstance(found, Case)  # a bearing
    found = replace(found, load_cases=case.load_cases)  # each warms itself
    note = (
        f"operation.temperature: computed at {balanced:.1f} C, where friction ({heating.model}) "
        "and cooling agree"
    )
    return replace(found, warnings=(note, *found.warnings))


def self_heated(case: Case) -> SelfHeatingSolution | None:
    """Temperature that the case's bearing warms itself to [K]; None where it is not asked for.

    Balls in traction equilibrium are taken as half and half: loads hardly depend on it.
    """
    given = case.heating
    if given is None or case.operation.inner_speed == case.operation.outer_speed:
        return None

    problem = SelfHeatingProblem(
        bearing=given.delivered,
        operation=case.operation,
        model=without_traction_equilibrium(case.model),
        oil=given.oil,
        torque=partial(_torque, case, given.model),
        fit=given.fit,
        reference=given.reference,
        inner_excess=given.inner_excess,
        rows=case.rows or SINGLE,
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the search looks beyond the range of the oil's data
        solution = solve_self_heating(problem, given.cooling, given.model)
    if solution.balance is None or not solution.converged:
        return solution
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        given.oil(solution.balance.temperature)
    return replace(solution, note="; ".join(str(warning.message) for warning in caught))


def _torque(
    case: Case, name: str, state: QuasistaticSolution, contacts: Contacts, oil: Lubricant
) -> float:
    """Friction torque by one model [N m]; `ValueError` if it does not apply."""
    assert case.friction is not None  # of every bearing case
    torque = model_torque(state, contacts, oil, case.friction, name)
    if torque.total is None:
        raise ValueError(f"the torque model {name} {torque.note}")
    return torque.total
