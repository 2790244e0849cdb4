"""A case that warms itself: the temperature at which friction and cooling agree."""

import warnings
from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from oilfilm.bearing.contacts.contact import BearingContact
from oilfilm.bearing.films.film import Films
from oilfilm.bearing.friction.balance import BalancedFriction
from oilfilm.bearing.geometry import SINGLE
from oilfilm.bearing.heating.friction_heat import FrictionHeat, heat_of_torque
from oilfilm.bearing.heating.heat_state import (
    FilmsHeat,
    FrictionModel,
    OperatingState,
    SelfHeatingProblem,
    film_conductances,
    formula_conductances,
    heat_state,
)
from oilfilm.bearing.heating.network import NODES
from oilfilm.bearing.heating.self_heating import SelfHeatingSolution, solve_self_heating
from oilfilm.bearing.quasistatic.solution import QuasistaticSolution
from oilfilm.bearing.torque.breakdown import INTEGRATED, model_torque
from oilfilm.bearing.torque.skf import InletFactors, inlet_factors
from oilfilm.ehl import Lubricant
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.units import ZERO_CELSIUS, from_si

from ..format.case import Case, case_of_file
from ..format.fields import rounded
from ..format.fits import HeatingInput, part_temperatures
from ..format.operation import SELF_HEATED
from .equilibrium import Equilibria, case_equilibrium, without_traction_equilibrium

Contacts = Sequence[BearingContact]
WARM_TOLERANCE = 0.1  # of the temperature that the torque of a run asks for [K]


class ReportedTorque(NamedTuple):
    """The total of a run [N m] with its part of contact seals, and the equilibrium it is of."""

    state: QuasistaticSolution
    contacts: Contacts
    total: float
    seal: float
    films: Films | None = None  # operating films of the contacts
    balance: BalancedFriction | None = None  # of the balls on these films
    conductance: Array | None = None  # through these films, `case_conductances` [W/K]


def with_temperature(
    case: Case, heating: SelfHeatingSolution | None = None, equilibria: Equilibria | None = None
) -> Case:
    """The case at the temperature that its bearing warms itself to, where it asks for that: oil
    and films, and with fits or temperatures the parts and the clearance as well.

    Parameters
    ----------
    case : Case
        A bearing case.
    heating : SelfHeatingSolution, optional
        The balance of heat; computed with films without a solve if left out. Where there is none,
        the case stays at `operation.temperature_C`, with a warning.
    equilibria : Equilibria, optional
        Those that are solved already.

    Returns
    -------
    Case
        The same object where its temperature is given.
    """
    if case.file.operation.temperature != SELF_HEATED:
        return case
    heating = heating or self_heated(case, judged=False, equilibria=equilibria)
    if heating is None or heating.balance is None or not heating.converged:
        why = "nothing turns" if heating is None else heating.note
        note = f"operation.temperature: not self-heated, {why}; temperature_C is taken"
        given = case.file.operation.model_copy(update={"temperature": "given"})
        file = case.file.model_copy(update={"operation": given})
        return replace(case, file=file, warnings=(note, *case.warnings))
    assert heating.state is not None
    balanced = from_si("temperature_C", heating.balance.temperature)
    file = case.file
    operation = {"temperature_C": rounded(balanced), "temperature": "given"}
    changed: dict[str, Any] = {"operation": file.operation.model_copy(update=operation)}
    if case.heating is not None and case.heating.reference is not None:
        nodes = (heating.state.temperatures - ZERO_CELSIUS).tolist()
        parts = dict(zip(NODES, nodes, strict=True))
        changed["temperatures"] = part_temperatures(file.temperatures, parts)
    found = case_of_file(file.model_copy(update=changed), case.title or "case")
    assert isinstance(found, Case)  # a bearing
    assert case.friction is not None and found.friction is not None  # of every bearing case
    found = replace(
        found,
        document=_warmed_document(found.document),
        load_cases=case.load_cases,  # each warms itself
        given=case.given,
        friction=replace(found.friction, bounds=case.friction.bounds),
    )
    note = (
        f"operation.temperature: computed at {balanced:.1f} C, where friction ({heating.model}) "
        "and cooling agree"
    )
    return replace(found, warnings=(note, *found.warnings))


def without_heat_balance(
    case: Case, heating: SelfHeatingSolution | None, warmed: Case
) -> Case | None:
    """The case at `operation.temperature_C`, with a warning, where films without a solve had a
    balance and the torque reported, with seals say, has none.

    Parameters
    ----------
    case : Case
        a bearing case
    heating : SelfHeatingSolution | None
        balance of the torque reported
    warmed : Case
        the case at the balance of films without a solve

    Returns
    -------
    Case | None
        None where the torque reported has a balance
    """
    if heating is None:
        return None
    cold = with_temperature(case, heating)
    return None if cold.operation.temperature == warmed.operation.temperature else cold


def _warmed_document(document: dict[str, Any]) -> dict[str, Any]:
    """The document of a case at its balance: its temperature is computed, not given or assumed."""
    operation = {**document["operation"], "temperature": SELF_HEATED}
    assumed = [key for key in document.get("assumed", ()) if key != "operation.temperature_C"]
    return {**document, "assumed": assumed, "operation": operation}


def self_heated(
    case: Case,
    reported: ReportedTorque | None = None,
    *,
    judged: bool = True,
    equilibria: Equilibria | None = None,
) -> SelfHeatingSolution | None:
    """Temperatures that the parts of the case's bearing warm themselves to.

    Balls in traction equilibrium are taken as half and half: loads hardly depend on it. The
    integrated torque is that of films of formulas at each temperature, in the proportion to the
    reported total that it has where that was computed; likewise the conductances of the contacts.

    Parameters
    ----------
    case : Case
        A bearing case.
    reported : ReportedTorque, optional
        The torque of a run.
    judged : bool
        Whether it is wanted how stable they are.
    equilibria : Equilibria, optional
        Those that are solved already.

    Returns
    -------
    SelfHeatingSolution or None
        None where it is not asked for.
    """
    given = case.heating
    if given is None or case.operation.inner_speed == case.operation.outer_speed:
        return None
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the search looks beyond the range of the oil's data
        try:
            problem = heating_problem(case, given, reported, ends=judged, equilibria=equilibria)
        except ValueError as error:
            return SelfHeatingSolution(
                model=given.model, around=given.around, balance=None, note=str(error)
            )
        solution = solve_self_heating(problem, given.model, judged=judged)
    if solution.balance is None or not solution.converged:
        return solution
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        given.oil(solution.balance.temperature)
    return replace(solution, note="; ".join(str(warning.message) for warning in caught))


def heating_problem(
    case: Case,
    given: HeatingInput,
    reported: ReportedTorque | None,
    *,
    ends: bool = True,
    equilibria: Equilibria | None = None,
) -> SelfHeatingProblem:
    """The case as the search for temperatures takes it.

    Parameters
    ----------
    case : Case
        A bearing case.
    given : HeatingInput
        What heats and cools the bearing.
    reported : ReportedTorque or None
        The torque of a run.
    ends : bool
        Whether the ranges of the temperatures are wanted, for which the ends of conductances are
        needed.
    equilibria : Equilibria, optional
        Those that are solved already.

    Returns
    -------
    SelfHeatingProblem
        Input of the search.
    """
    assert case.friction is not None  # of every bearing case
    return SelfHeatingProblem(
        bearing=given.delivered,
        operation=case.operation,
        model=without_traction_equilibrium(case.model),
        oil=given.oil,
        friction=_friction_model(case, given, reported, ends),
        around=given.around,
        fit=given.fit,
        reference=given.reference,
        rows=case.rows or SINGLE,
        oil_share=case.friction.oil_share(case.bearing),
        hottest=given.hottest,
        expected=given.expected,
        **_start_of_search(case, given, reported, equilibria),
    )


def _start_of_search(
    case: Case, given: HeatingInput, reported: ReportedTorque | None, equilibria: Equilibria | None
) -> dict[str, Any]:
    """Start of the search: the equilibrium of the case where temperature leaves that unchanged, so
    that a process solves it once; that of a run, whose contacts count where they are not those of
    finite bodies. A run at the temperature of its balance only asks whether that is one.
    """
    if reported is None:
        same = given.reference is None and without_traction_equilibrium(case.model) is case.model
        return {"start": case_equilibrium(case, equilibria)} if same else {}
    own = not case.file.ehl.finite_bodies
    warmed = case.document["operation"].get("temperature") == SELF_HEATED
    return {
        "start": reported.state,
        "contacts": reported.contacts if own else (),
        "enough": WARM_TOLERANCE if warmed and given.model == INTEGRATED else 0.0,
    }


def with_heat_balance(
    heating: SelfHeatingSolution, case: Case, reported: ReportedTorque
) -> SelfHeatingSolution:
    """The balance with the torque reported at the temperature of the case and the temperatures
    that follow from its heat.

    Parameters
    ----------
    heating : SelfHeatingSolution
        balance of the case
    case : Case
        a bearing case
    reported : ReportedTorque
        torque of its run

    Returns
    -------
    SelfHeatingSolution
        temperatures [K]
    """
    assert heating.balance is not None and case.heating is not None
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        problem = heating_problem(case, case.heating, reported)
        temperature = case.operation.temperature
        clearance = case.bearing.diametral_clearance
        at = (temperature, clearance, (reported.state, problem.contacts))
        state = heat_state(problem, problem.fixed_paths(), *at)
    power = reported.total * case.operation.shaft_speed
    left = power - state.network.removed(state.temperatures)
    balance = replace(
        heating.balance,
        temperature=temperature,
        torque=reported.total,
        power=power,
        residual=left / power if power > 0.0 else 0.0,
    )
    return replace(heating, balance=balance, state=state)


def _friction_model(
    case: Case, given: HeatingInput, reported: ReportedTorque | None, ends: bool
) -> FrictionModel:
    """Heat of an equilibrium by the model that heats."""
    if given.model != INTEGRATED:
        return partial(_model_heat, case, given.model)
    assert case.friction is not None  # of every bearing case
    if reported is None:
        films = FilmsHeat(friction=case.friction, ends=ends)
        return partial(_formula_heat, case, given, films)
    by_formulas = partial(_formula_heat, case, given, _reported_heat(case, given, reported))
    found = by_formulas(reported.state, reported.contacts, case.lubricant)
    factor = (reported.total - reported.seal) / found.torque
    ratio = np.ones(2)
    if reported.films is not None:
        solved = reported.conductance
        if solved is None:
            solved = film_conductances(reported.state, reported.contacts, reported.films)
        sums = solved[0].sum(axis=0), found.conductance[0].sum(axis=0)
        ratio = np.where(sums[1] > 0.0, sums[0] / np.maximum(sums[1], 1e-300), 1.0)
    return partial(_scaled_heat, by_formulas, factor, reported.seal, ratio)


def _reported_heat(case: Case, given: HeatingInput, reported: ReportedTorque) -> FilmsHeat:
    """Heat of films of formulas, begun at what is reported; films that are these, and the balls
    on them, are not found again.
    """
    assert case.friction is not None  # of every bearing case
    begun = FilmsHeat(friction=case.friction)
    oil = case.lubricant
    inlet = _inlet(case, reported.state, oil)
    films = reported.films
    if any(film is not None and film.sheared_field is not None for film in films or ()):
        films = None
    films = films if inlet == case.inlet else None
    rheology = given.rheology(oil)
    same = films is not None and rheology == case.rheology
    computed = OperatingState(
        films=films,
        balance=reported.balance if same else None,
        conductances=None if films is None else reported.conductance,
    )
    begun.heat(reported.state, reported.contacts, oil, rheology, inlet, computed)
    return begun


def _inlet(case: Case, state: QuasistaticSolution, oil: Lubricant) -> InletFactors:
    """Factors of inlet heating and replenishment on the rolling moment with an oil [-]."""
    assert case.friction is not None  # of every bearing case
    return inlet_factors(
        state.bearing,
        state.operation.shaft_speed,
        oil.viscosity / oil.density,
        case.friction.lubrication,
        layered=case.friction.layered or case.inlet_layer is not None,
    )


def _formula_heat(
    case: Case,
    given: HeatingInput,
    films: FilmsHeat,
    state: QuasistaticSolution,
    contacts: Contacts,
    oil: Lubricant,
) -> FrictionHeat:
    """Heat of films of formulas [W], without seals."""
    inlet = _inlet(case, state, oil)
    return films.heat(state, contacts, oil, given.rheology(oil), inlet)


def _scaled_heat(
    heat: FrictionModel,
    factor: float,
    seal: float,
    conductance: Array,
    state: QuasistaticSolution,
    contacts: Contacts,
    oil: Lubricant,
) -> FrictionHeat:
    """Heat in proportion to another one [W], and that of seals."""
    return heat(state, contacts, oil).scaled(factor, seal, conductance)


def _model_heat(
    case: Case, name: str, state: QuasistaticSolution, contacts: Contacts, oil: Lubricant
) -> FrictionHeat:
    """Heat of one torque model [W]; `ValueError` if it does not apply."""
    assert case.friction is not None  # of every bearing case
    torque = model_torque(state, contacts, oil, case.friction, name)
    if torque.total is None:
        raise ValueError(f"the torque model {name} {torque.note}")
    return heat_of_torque(torque.components, state, formula_conductances(state, contacts))


def conducts(case: Case) -> bool:
    """Tell whether the heat properties of the bodies are known.

    Parameters
    ----------
    case : Case
        The bearing.

    Returns
    -------
    bool
        True if they are.
    """
    bodies = case.bearing
    materials = (bodies.ball_material, bodies.inner_ring_material, bodies.outer_ring_material)
    return all(m.thermal_conductivity and m.specific_heat for m in materials)


def case_conductances(
    case: Case,
    state: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    operating: Films | None,
) -> Array | None:
    """Heat conductances through the films of all contacts.

    Parameters
    ----------
    case : Case
        The bearing.
    state : QuasistaticSolution
        Its equilibrium.
    contacts : Sequence[BearingContact]
        Its contacts.
    operating : Films | None
        Films in operation.

    Returns
    -------
    Array | None
        Conductances [W/K]; None where heat properties of oil or bodies are not known.
    """
    if operating is None or not conducts(case):
        return None
    return film_conductances(state, contacts, operating)
