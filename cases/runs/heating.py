"""A case that warms itself: the temperature at which friction and cooling agree."""

import warnings
from collections.abc import Sequence
from dataclasses import replace
from functools import partial

from bearing.contacts.contact import BearingContact
from bearing.heating.self_heating import (
    SelfHeatingProblem,
    SelfHeatingSolution,
    solve_self_heating,
)
from bearing.quasistatic.solution import QuasistaticSolution
from bearing.torque.breakdown import model_torque
from ehl import Lubricant

from ..format.case import Case
from .equilibrium import without_traction_equilibrium

Contacts = Sequence[BearingContact]


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
