"""Run the vibration of a bearing case: equilibrium, films, form, time."""

import warnings
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from time import perf_counter

from oilfilm.bearing.contacts.contact import BearingContact
from oilfilm.bearing.contacts.contacts import contact_conditions
from oilfilm.bearing.quasistatic.solution import QuasistaticSolution
from oilfilm.bearing.vibration.assembly import FilmsNotSolvedError, assembled, film_load_fractions
from oilfilm.bearing.vibration.inputs import Direction
from oilfilm.bearing.vibration.simulation import VibrationRun, pieces, vibration_run
from oilfilm.ehl.multigrid.newton import LinearSolverError
from oilfilm.postprocess.vibration.results import VibrationResults

from ..format.case import Case
from ..format.rules import CaseError, InvalidKeyError
from ..format.vibration import VibrationTable, frequency_response, vibration
from ..version import version
from .dynamics import build_model
from .equilibrium import case_equilibrium
from .films import Progress, inlet_layers, oil_at_inlets
from .interrupt import interruptible

# keys of [dynamics] for its own history and end
NOT_TAKEN = {"end_time", "output_interval_us", "starts", "start", "equations"}


class NotSolvedError(RuntimeError):
    """No equilibrium, or a film that is not solved: there is nothing to vibrate."""


def run_vibration(case: Case, name: str, progress: Progress | None = None) -> VibrationResults:
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
    file = case.file
    given = set() if file.dynamics is None else file.dynamics.model_fields_set
    if refused := given & NOT_TAKEN:
        names = ", ".join(f"dynamics.{key}" for key in sorted(refused))
        raise CaseError(f"{name}: {names}: not taken with [form], [support] or [vibration]")
    end_time = None if file.dynamics is None else file.dynamics.end_time_s
    table = file.vibration or VibrationTable()
    try:
        speed = case.operation.inner_speed
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of the profiles, which the case has told
            model = vibration(file.form, file.support, file.vibration, speed, end_time)
        response = frequency_response(file.support)
        notify(0, 1000, "equilibrium and films")
        state = interruptible(partial(case_equilibrium, case))
        if not state.converged:
            raise NotSolvedError(state.message)
        contacts = _contacts(case, state)
        if case.friction is not None and case.friction.asperities is not None:
            oil = oil_at_inlets(case)
            shares = film_load_fractions(contacts, case.friction.asperities, oil)
            model = replace(model, film_load_fractions=shares)
        equations = interruptible(partial(assembled, state, contacts, model))
        simulated = given - {"end_time_s"}
        base = build_model(case, None, notify) if simulated else None
        run = vibration_run(state, model, equations, base)
    except InvalidKeyError as error:
        raise CaseError(f"{name}: {error.fault.text(name, {})}") from error
    except ValueError as error:
        raise CaseError(f"{name}: {error}") from error
    except (FilmsNotSolvedError, LinearSolverError) as error:
        raise NotSolvedError(f'{error}; contact_law and wave_filter = "dry" take none') from error
    films = perf_counter() - began
    _step(run, notify)
    results = VibrationResults(
        version=version(),
        case=case.document,
        messages=(*case.warnings, *_notes(case, state)),
        run=run,
        direction=Direction(table.direction),
        reference=table.reference_m_s2,
        envelope_band=_band(table),
        response=response,
    )
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


def _notes(case: Case, state: QuasistaticSolution) -> Iterator[str]:
    """Notes on the hypothesis of the equilibrium, and on effects of the oil that are left out."""
    if ";" in state.message:
        yield f"equilibrium of ring and balls: {state.message}"
    if case.inlet_layer is not None:
        yield "vibration: waves enter as through flooded films; behind layers it is not known"
    elif case.friction is not None and case.friction.scarce is not None:
        yield (
            "vibration: the films are flooded but for the load that asperities carry; [ehl] "
            'starvation = "solved" takes the supply of oil'
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
