"""A case that warms itself: the temperature at which friction and cooling agree."""

import warnings
from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import Any, NamedTuple

from bearing.contacts.contact import BearingContact
from bearing.heating.self_heating import (
    SelfHeatingProblem,
    SelfHeatingSolution,
    TorqueModel,
    solve_self_heating,
)
from bearing.quasistatic.solution import QuasistaticSolution
from bearing.rows import SINGLE
from bearing.torque.breakdown import INTEGRATED, model_torque
from bearing.torque.films_torque import balanced_torque
from bearing.torque.inlet import inlet_factors
from ehl import Lubricant
from ehl.units import from_si

from ..format.case import Case, case_of_file
from ..format.contact import FilmModel
from ..format.fields import rounded
from ..format.fits import HeatingInput, part_temperatures
from ..format.operation import SELF_HEATED
from .equilibrium import without_traction_equilibrium

Contacts = Sequence[BearingContact]


class Printed(NamedTuple):
    """The total of a run [N m] with its part of contact seals, and the equilibrium it is of."""

    state: QuasistaticSolution
    contacts: Contacts
    total: float
    seal: float


def at_its_temperature(case: Case, heating: SelfHeatingSolution | None = None) -> Case:
    """The case at the temperature that its bearing warms itself to, where it asks for that: oil
    and films, and with fits or temperatures the parts and the clearance as well.

    `heating`: the balance, where it is known. Without one the case stays at
    `operation.temperature_C`, with a warning.
    """
    if case.file.operation.temperature != SELF_HEATED:
        return case
    heating = heating or self_heated(case)
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


def self_heated(case: Case, printed: Printed | None = None) -> SelfHeatingSolution | None:
    """Temperature that the case's bearing warms itself to [K]; None where it is not asked for.

    Balls in traction equilibrium are taken as half and half: loads hardly depend on it. The
    integrated torque is that of films of formulas at each temperature, in the proportion to the
    printed total that it has where that was computed.
    """
    given = case.heating
    if given is None or case.operation.inner_speed == case.operation.outer_speed:
        return None
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the search looks beyond the range of the oil's data
        try:
            torque = _torque_model(case, given, printed)
        except ValueError as error:
            return SelfHeatingSolution(
                model=given.model, balance=None, cooling=given.cooling, note=str(error)
            )
        problem = SelfHeatingProblem(
            bearing=given.delivered,
            operation=case.operation,
            model=without_traction_equilibrium(case.model),
            oil=given.oil,
            torque=torque,
            fit=given.fit,
            reference=given.reference,
            inner_excess=given.inner_excess,
            rows=case.rows or SINGLE,
        )
        solution = solve_self_heating(problem, given.cooling, given.model)
    if solution.balance is None or not solution.converged:
        return solution
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        given.oil(solution.balance.temperature)
    return replace(solution, note="; ".join(str(warning.message) for warning in caught))


def at_its_balance(heating: SelfHeatingSolution, case: Case, total: float) -> SelfHeatingSolution:
    """The balance found, with the torque printed at the temperature of the case [N m]."""
    assert heating.balance is not None
    temperature = case.operation.temperature
    power = total * case.operation.shaft_speed
    left = power - heating.cooling.heat(temperature)
    balance = replace(
        heating.balance,
        temperature=temperature,
        torque=total,
        power=power,
        residual=left / power if power > 0.0 else 0.0,
    )
    return replace(
        heating,
        balance=balance,
        viscosity=case.lubricant.viscosity,
        clearance=case.bearing.diametral_clearance,
    )


def _torque_model(case: Case, given: HeatingInput, printed: Printed | None) -> TorqueModel:
    """Friction torque [N m] of an equilibrium by the model that heats."""
    if given.model != INTEGRATED:
        return partial(_torque, case, given.model)
    by_formulas = partial(_formula_torque, case, given)
    if printed is None:
        return partial(_scaled_torque, by_formulas, 1.0, 0.0)
    state, contacts, total, seal = printed
    factor = (total - seal) / by_formulas(state, contacts, case.lubricant)
    return partial(_scaled_torque, by_formulas, factor, seal)


def _formula_torque(
    case: Case, given: HeatingInput, state: QuasistaticSolution, contacts: Contacts, oil: Lubricant
) -> float:
    """Integrated torque of films of formulas [N m], without seals."""
    assert case.friction is not None  # of every bearing case
    inlet = inlet_factors(
        state.bearing,
        state.operation.shaft_speed,
        oil.viscosity / oil.density,
        case.friction.lubrication,
        heated=case.films.model is FilmModel.THERMAL,
        layered=case.friction.scarce is not None or case.inlet_layer is not None,
    )
    rheology = given.rheology(oil)
    return balanced_torque(state, contacts, case.friction, inlet, rheology, oil)


def _scaled_torque(
    torque: TorqueModel,
    factor: float,
    seal: float,
    state: QuasistaticSolution,
    contacts: Contacts,
    oil: Lubricant,
) -> float:
    """Torque in proportion to another one, and that of seals [N m]."""
    return factor * torque(state, contacts, oil) + seal


def _torque(
    case: Case, name: str, state: QuasistaticSolution, contacts: Contacts, oil: Lubricant
) -> float:
    """Friction torque by one model [N m]; `ValueError` if it does not apply."""
    assert case.friction is not None  # of every bearing case
    torque = model_torque(state, contacts, oil, case.friction, name)
    if torque.total is None:
        raise ValueError(f"the torque model {name} {torque.note}")
    return torque.total
