"""Run the time simulation of a case: model from the case file, history streamed to disk, restart
if interrupted.
"""

import json
from collections.abc import Callable
from copy import deepcopy
from dataclasses import replace
from functools import partial
from pathlib import Path
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from oilfilm.bearing.dynamics.inputs import DynamicsModel
from oilfilm.bearing.dynamics.record import picked_rows
from oilfilm.bearing.dynamics.reduction import MIRRORED
from oilfilm.bearing.dynamics.simulation import Simulation, load_restart, simulation
from oilfilm.bearing.dynamics.statistics import (
    SimulationStatistics,
    other_start,
    running_statistics,
    simulated_statistics,
)
from oilfilm.bearing.vibration.simulation import (
    VibrationRun,
    before_settling,
    begin_record,
    end_record,
    keep_record,
    vibration_run,
    with_form,
)
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.version import version
from oilfilm.postprocess.dynamics.history import HistoryWriter
from oilfilm.postprocess.dynamics.results import DynamicsResults

from ..format.case import Case
from ..format.dynamics import DynamicsTable, sample_interval
from ..format.rules import CaseError
from .films import Progress
from .interrupt import finish_first, interruptible
from .motion_model import build_model
from .vibration import FormedCase, case_with_form, vibration_results

DIMENSIONS = (
    "ball_diameter pitch_diameter inner_groove_radius outer_groove_radius diametral_clearance "
    "first_ball_azimuth bore outside_diameter width"
).split()
OTHER_STARTS = 2  # in all, where states may differ
MILLISECONDS = 1000.0  # the progress counts in these


class Interrupted(KeyboardInterrupt):
    """A simulation stopped on the way, with what it has so far."""

    def __init__(self, results: DynamicsResults, simulation: Simulation) -> None:
        super().__init__()
        self.results = results
        self.simulation = simulation


def run_dynamics(
    case: Case,
    name: str,
    history: Path,
    restart: Path | None = None,
    tables: Path | None = None,
    progress: Progress | None = None,
) -> DynamicsResults:
    """Simulate a case; the history is streamed to a file.

    Parameters
    ----------
    case : Case
        The bearing.
    name : str
        Name of the case in messages.
    history : Path
        File of the history.
    restart : Path | None, optional
        File of an interrupted simulation of the same case to continue from.
    tables : Path | None, optional
        Traction tables from `oilfilm table`, instead of new ones.
    progress : Progress | None, optional
        Called with milliseconds done, milliseconds in all, and the time left.

    Returns
    -------
    DynamicsResults
        The simulation and its statistics.

    Raises
    ------
    CaseError
        If the case has no [dynamics], or cannot be simulated.
    NotSolvedError
        If a film that the vibration needs is not solved.
    Interrupted
        With what there is so far, on Ctrl-C.
    """
    notify = progress or (lambda done, total, state: None)
    table = _table(case, name)
    file = case.file
    if tables is not None and table.friction != "table":
        raise CaseError(
            f'{name}: traction tables are for dynamics.friction = "table", found '
            f'"{table.friction}"'
        )
    try:
        model = build_model(case, tables, notify)
        vibrating = None
        if any(given is not None for given in (file.form, file.support, file.vibration)):
            notify(0, 1000, "equilibrium and films")
            formed = case_with_form(case, name)
            run, vibrating = _with_form(case, model, formed)
        else:
            run = simulation(case.bearing, case.operation, model)
        if restart is not None:
            load_restart(run, restart, case_key(case))
            vibrating = None  # of a part of the time
            run.messages.append(
                f"dynamics: continued at t = {run.state.time:.6g} s; loads of the summary "
                "from there"
            )
    except ValueError as problem:
        raise CaseError(f"{name}: {problem}") from problem
    results = _stream(case, run, history, notify, vibrating)
    if vibrating is not None and run.converged:
        end_record(vibrating)
        results = replace(results, vibration=vibration_results(case, formed, vibrating))
    return _with_other_starts(case, results)


def _with_form(
    case: Case, model: DynamicsModel, formed: FormedCase
) -> tuple[Simulation, VibrationRun | None]:
    """The simulation with form and supports, and the record of its vibration; none of a run whose
    end is not known.
    """
    end = model.options.end_time
    vibration = replace(formed.model, options=replace(formed.model.options, duration=end))
    if model.options.until_steady:
        whole = with_form(model, formed.state, vibration, formed.equations)
        bearing = before_settling(case.bearing, whole, formed.state.cage_speed)
        return simulation(bearing, case.operation, whole), None
    vibrating = vibration_run(formed.state, vibration, formed.equations, model)
    begin_record(vibrating)
    return vibrating.simulation, vibrating


def _table(case: Case, name: str) -> DynamicsTable:
    if case.file.dynamics is None:
        raise CaseError(
            f"{name}: has no table [dynamics]; it needs end_time_s, or end_time = 'steady', see "
            "docs/reference/cases.md"
        )
    if case.rows is not None and len(case.rows) > 1:
        raise CaseError(f"{name}: [[rows]]: a simulation takes one row of balls")
    return case.file.dynamics


def case_key(case: Case) -> str:
    """The case as run in one line, by which a restart file identifies it.

    Parameters
    ----------
    case : Case
        The bearing.

    Returns
    -------
    str
        JSON of its document.
    """
    return json.dumps(case.document, sort_keys=True)


def _teller(run: Simulation, notify: Progress) -> Callable[[], None]:
    """A function that reports the progress of a simulation and the time left."""
    began = perf_counter()
    end = run.model.options.end_time
    first = run.state.time

    def tell() -> None:
        time = run.state.time
        if time > first:
            left = (perf_counter() - began) * (end - time) / (time - first)
            state = f"simulated ms, {left:.3g} s left"
            notify(round(time * MILLISECONDS), round(end * MILLISECONDS), state)

    return tell


def _stream(
    case: Case,
    run: Simulation,
    history: Path,
    notify: Progress,
    vibrating: VibrationRun | None = None,
) -> DynamicsResults:
    """Step, write, count; on Ctrl-C what there is so far goes up with `Interrupted`. A vibration
    has finer samples, of which the history takes one in `stride`.
    """
    began = perf_counter()
    table = case.file.dynamics
    assert table is not None  # checked before
    fine = run.model.options.sample_interval
    stride = max(1, round(sample_interval(table, case.operation.shaft_speed) / fine))
    running = running_statistics(run, stride)
    before = run.state
    attributes = _attributes(case)

    def kept(times: Array) -> NDArray[np.bool_]:
        rows: NDArray[np.bool_] = np.rint(times / fine) % stride == 0
        return rows

    def results() -> DynamicsResults:
        return DynamicsResults(
            case=case.document,
            simulation=run,
            running=running,
            history=history,
            messages=(*case.warnings, *_assumed(run.model), *run.messages),
            timing={"simulation": run.wall, "total": perf_counter() - began},
        )

    tell = _teller(run, notify)
    length = int(kept(run.sample_times()).sum())
    with HistoryWriter(history, case.bearing.balls, length, attributes) as writer:
        try:
            pieces = run.pieces()
            while True:
                before = deepcopy(run.state)
                record = interruptible(partial(next, pieces, None), tell)
                if record is None:
                    break
                # state, history and statistics stay in step
                with finish_first("the samples under way"):
                    before = run.state
                    if vibrating is not None:
                        keep_record(vibrating, record)
                    if stride > 1:
                        record = picked_rows(record, kept(record.time))
                    if record.time.size:
                        writer.add(record)
                        running.add(record, run.start_energy)
                tell()
                if run.model.options.until_steady and running.settled():
                    break
        except KeyboardInterrupt:
            # the thread that was given up still moves the state it has
            run = replace(run, state=before)
            raise Interrupted(results(), run) from None
    return results()


def _with_other_starts(case: Case, results: DynamicsResults) -> DynamicsResults:
    """The results with the ends of the other starts that the case asks for."""
    assert case.file.dynamics is not None  # checked before
    run = results.simulation
    count = (case.file.dynamics.starts or usual_starts(run)) if run.converged else 1
    others: list[SimulationStatistics | None] = []
    try:
        for k in range(1, count):
            others.append(
                interruptible(partial(simulated_statistics, other_start(run, k / count)))
            )
    except KeyboardInterrupt:
        raise Interrupted(replace(results, others=tuple(others)), run) from None
    return replace(results, others=tuple(others))


def usual_starts(run: Simulation) -> int:
    """Starts where the case names none: two where pockets decide, a load across the axis leaving
    each ball a place of its own; one under an axial load.

    Parameters
    ----------
    run : Simulation
        Simulation at its end.

    Returns
    -------
    int
        Number of starts [-].
    """
    across = run.point.kind in MIRRORED and run.model.cage is not None
    return OTHER_STARTS if across else 1


def _attributes(case: Case) -> dict[str, str | float]:
    """Attributes of the history: its case, and the dimensions a picture of it needs [m], [rad]."""
    given = {"oilfilm": version(), "case": case_key(case), "title": case.title}
    dimensions = {name: getattr(case.bearing, name) for name in DIMENSIONS}
    return given | {name: float(v) for name, v in dimensions.items() if v is not None}


def _assumed(model: DynamicsModel) -> tuple[str, ...]:
    names = [*model.ring.assumed, *(() if model.cage is None else model.cage.assumed)]
    notes = [f"dynamics: {text}" for text in model.notes.values()]
    return (
        (*notes, f"dynamics: estimated, not given: {', '.join(names)}") if names else tuple(notes)
    )
