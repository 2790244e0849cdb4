"""Run the vibration of a bearing case: equilibrium, films, form, time; and what form and supports
add to a time simulation.
"""

import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from time import perf_counter

from oilfilm.bearing.contacts.contact import BearingContact
from oilfilm.bearing.contacts.contacts import contact_conditions
from oilfilm.bearing.quasistatic.solution import QuasistaticSolution
from oilfilm.bearing.vibration.assembly import (
    Assembled,
    FilmsNotSolvedError,
    assembled,
    film_load_fractions,
)
from oilfilm.bearing.vibration.inputs import Direction, VibrationModel
from oilfilm.bearing.vibration.simulation import VibrationRun, pieces, vibration_run
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.multigrid.newton import LinearSolverError
from oilfilm.postprocess import vibration as seen

from ..format.case import Case
from ..format.document import read_text
from ..format.rules import CaseError, CaseProblem, InvalidKeyError, faults_error
from ..format.shipped import find_case
from ..format.vibration import VibrationTable, frequency_response, vibration
from .equilibrium import case_equilibrium
from .films import Progress, inlet_layers, oil_at_inlets
from .interrupt import interruptible
from .motion_model import build_model

# keys of [dynamics] that are of several runs, or of an end that is not known
NOT_TAKEN = ("end_time", "starts")


class NotSolvedError(RuntimeError):
    """No equilibrium, or a film that is not solved: there is nothing to vibrate."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FormedCase:
    """Contributions of form and supports of a case to its equations of motion."""

    state: QuasistaticSolution
    model: VibrationModel
    equations: Assembled
    response: Array | None  # of the path to the sensor

    def notes(self, case: Case) -> Iterator[str]:
        """Notes on the hypothesis of the equilibrium, and on effects of the oil that are left out.

        Parameters
        ----------
        case : Case
            The bearing.

        Yields
        ------
        Iterator[str]
            Notes.
        """
        if ";" in self.state.message:
            yield f"equilibrium of ring and balls: {self.state.message}"
        if case.inlet_layer is not None:
            yield "vibration: waves enter as through flooded films; behind layers it is not known"
        elif case.friction is not None and case.friction.scarce is not None:
            yield (
                "vibration: the films are flooded but for the load that asperities carry; [ehl] "
                'starvation = "solved" takes the supply of oil'
            )


def vibration_results(
    case: Case, formed: FormedCase, run: VibrationRun
) -> "seen.VibrationResults":
    """Results of a vibration at its end.

    Parameters
    ----------
    case : Case
        The bearing.
    formed : FormedCase
        Contributions of form and supports.
    run : VibrationRun
        The run at its end.

    Returns
    -------
    VibrationResults
        Motion over time.
    """
    table = case.file.vibration or VibrationTable()
    return seen.VibrationResults(
        case=case.document,
        messages=(*case.warnings, *formed.notes(case)),
        run=run,
        direction=Direction(table.direction),
        reference=table.reference_m_s2,
        envelope_band=_band(table),
        response=formed.response,
    )


def _band(table: VibrationTable) -> tuple[float, float] | None:
    """Band of the envelope [Hz]; CaseError beyond half the sample rate."""
    if table.envelope_band_Hz is None:
        return None
    low, high = table.envelope_band_Hz
    if high > 0.5 * table.sample_rate_Hz:
        limit = 0.5 * table.sample_rate_Hz
        raise CaseError(f"vibration.envelope_band_Hz: up to {limit:g}, half of the sample rate")
    return low, high


def check_keys(case: Case, name: str, refused: Sequence[str]) -> None:
    """Refuse keys of [dynamics] that a vibration does not take.

    Parameters
    ----------
    case : Case
        The bearing.
    name : str
        Name of the case in messages.
    refused : sequence of str
        Keys.

    Raises
    ------
    CaseError
        With file, line and key of each.
    """
    given = set() if case.file.dynamics is None else case.file.dynamics.model_fields_set
    found = "found for a vibration, which is one run of a given length"
    problems = [
        CaseProblem(("dynamics", key), found, "allowed: with 'oilfilm dynamics'")
        for key in refused
        if key in given
    ]
    if problems:
        raise faults_error(problems, name, _text_of(name))


def _text_of(name: str) -> str:
    """Content of a case file, for lines in messages; none of a case without a file."""
    try:
        return read_text(find_case(name))
    except CaseError:
        return ""


def case_with_form(case: Case, name: str) -> FormedCase:
    """Equilibrium, films and contributions of a case.

    Parameters
    ----------
    case : Case
        The bearing.
    name : str
        Name of the case in messages.

    Returns
    -------
    FormedCase
        Contributions to the equations of motion.

    Raises
    ------
    CaseError
        If the case cannot be computed.
    NotSolvedError
        If there is no equilibrium, or a film is not solved.
    """
    file = case.file
    end_time = None if file.dynamics is None else file.dynamics.end_time_s
    try:
        speed = case.operation.inner_speed
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of the profiles, which the case has told
            model = vibration(
                file.form, file.support, file.vibration, case.bearing.balls, speed, end_time
            )
        response = frequency_response(file.support)
        state = interruptible(partial(case_equilibrium, case))
        if not state.converged:
            raise NotSolvedError(state.message)
        contacts = _contacts(case, state)
        if case.friction is not None and case.friction.asperities is not None:
            oil = oil_at_inlets(case)
            shares = film_load_fractions(contacts, case.friction.asperities, oil)
            model = replace(model, film_load_fractions=shares)
        equations = interruptible(partial(assembled, state, contacts, model))
    except InvalidKeyError as error:
        raise CaseError(f"{name}: {error.fault.text(name, {})}") from error
    except ValueError as error:
        raise CaseError(f"{name}: {error}") from error
    except (FilmsNotSolvedError, LinearSolverError) as error:
        raise NotSolvedError(f'{error}; contact_law and wave_filter = "dry" take none') from error
    return FormedCase(state=state, model=model, equations=equations, response=response)


def _contacts(case: Case, state: QuasistaticSolution) -> list[BearingContact]:
    """Contacts of an equilibrium, behind their layers of oil where the case starves them."""
    contacts = list(contact_conditions(state, case.lubricant))
    if case.inlet_layer is None:
        return contacts
    layers = inlet_layers(case.inlet_layer, state, contacts)
    return [
        replace(own, conditions=own.conditions and replace(own.conditions, inlet_layer=layer))
        for own, layer in zip(contacts, layers, strict=True)
    ]


def run_vibration(
    case: Case, name: str, progress: Progress | None = None
) -> "seen.VibrationResults":
    """Compute the vibration of a case.

    Parameters
    ----------
    case : Case
        The bearing.
    name : str
        Name of the case in messages.
    progress : Progress | None, optional
        Called with per mille done, 1000, and a text.

    Returns
    -------
    VibrationResults
        Motion over time.

    Raises
    ------
    CaseError
        If the case cannot be computed.
    NotSolvedError
        If there is no equilibrium, or a film is not solved.
    """
    notify = progress or (lambda done, total, state: None)
    began = perf_counter()
    check_keys(case, name, NOT_TAKEN)
    notify(0, 1000, "equilibrium and films")
    formed = case_with_form(case, name)
    base = build_model(case, None, notify) if case.simulates_friction else None
    try:
        run = vibration_run(formed.state, formed.model, formed.equations, base)
    except ValueError as error:
        raise CaseError(f"{name}: {error}") from error
    films = perf_counter() - began
    _step(run, notify)
    results = vibration_results(case, formed, run)
    wall = perf_counter() - began
    return replace(results, timing={"films": films, "vibration": wall - films, "total": wall})


def _step(run: VibrationRun, notify: Progress) -> None:
    """Compute the run to its end."""
    steps = pieces(run)
    while True:
        done = interruptible(partial(next, steps, None))
        if done is None:
            return
        notify(round(1000.0 * done), 1000, "vibration over time")
