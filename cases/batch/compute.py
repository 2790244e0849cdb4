"""Results of a point: its summary as plain JSON, and its files."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from bearing.contacts.contact import BearingContact
from bearing.friction.laws import LawTraction
from bearing.friction.tables import Tables, save_race_tables
from postprocess import summary
from postprocess.batch.summary import OUTSIDE
from postprocess.bearing.results import BearingResults
from postprocess.bearing.write import write_bearing_netcdf
from postprocess.contact.summary import ContactResults
from postprocess.contact.write import write_contact_netcdf
from postprocess.dynamics.results import dynamics_summary
from postprocess.slip.results import slip_summary
from postprocess.traction.results import traction_summary

from ..format.case import Case, ContactCase
from ..format.traction import require_fitting_tables, resisted_traction
from ..runs.bearing import run_case
from ..runs.contact import run_contact
from ..runs.dynamics import run_dynamics
from ..runs.equilibrium import Equilibria
from ..runs.films import Solve
from ..runs.output_lock import scratch_folder
from ..runs.slip import run_slip
from ..runs.traction_table import run_table
from .points import Task
from .shared.tables import tables_once

Computed = tuple[dict[str, Any], dict[str, bytes]]  # summary, files by suffix


def compute(
    case: Case | ContactCase,
    task: Task,
    tables: Path | None,
    solve: Solve | None,
    equilibria: Equilibria | None = None,
) -> Computed:
    """Compute one point: its summary, and its files by suffix.

    Parameters
    ----------
    case : Case | ContactCase
        The checked case of the point.
    task : Task
        Quantity to compute and options.
    tables : Path | None
        File of traction tables where the point needs them; None otherwise.
    solve : Solve | None
        Solver of one film in place of the film model's own.
    equilibria : Equilibria, optional
        Equilibria of the points before.

    Returns
    -------
    Computed
        Summary as plain JSON, and contents of files by suffix.
    """
    if isinstance(case, ContactCase):
        return _with_fields(run_contact(case), task)
    if task.compute == "slip":
        return slip_summary(run_slip(case, "case", 1)), {}
    if task.compute == "dynamics":
        return _dynamics(case, task, tables)
    if task.compute == "table":
        return _table(case, task)
    if task.compute == "torque":
        return _torque(case, tables, equilibria)
    return _with_fields(run_case(case, 1, None, solve, equilibria=equilibria), task)


def _with_fields(results: BearingResults | ContactResults, task: Task) -> Computed:
    """The summary, and the netCDF file of the film maps if one is written."""
    document = summary(results)
    if not task.fields:
        return document, {}
    with scratch_folder() as temporary:
        path = temporary / "results.nc"
        if isinstance(results, ContactResults):
            write_contact_netcdf(results, path, document)
        else:
            write_bearing_netcdf(results, path, document)
        return document, {".nc": path.read_bytes()}


def _dynamics(case: Case, task: Task, tables: Path | None) -> Computed:
    """Time simulation; its history is a file if one is written."""
    with scratch_folder() as temporary:
        history = temporary / "history.nc"
        document = dynamics_summary(run_dynamics(case, "case", history, tables=tables))
        return document, {".nc": history.read_bytes()} if task.fields else {}


def _table(case: Case, task: Task) -> Computed:
    """Traction tables of the point's own loads and speeds, as a file."""
    results = run_table(case, task.table_points, 1)
    with scratch_folder() as temporary:
        path = temporary / "table.zip"
        save_race_tables(results.tables, path)
        return traction_summary(results), {".zip": path.read_bytes()}


def _torque(case: Case, path: Path | None, equilibria: Equilibria | None) -> Computed:
    """Equilibrium, life and torque by every model; integrated by tables or the law of the case."""
    if path is None:
        case = replace(case, film_maps="none")
        return summary(run_case(case, 1, equilibria=equilibria)), {}
    assert case.rheology is not None  # of every bearing case
    tables = tables_once(str(path))(case.lubricant, case.rheology)
    results, notes = torque_by_tables(case, tables, equilibria)
    document = summary(results)
    warnings = [
        f"not converged: traction table, {race.value} race: {table.message}"
        for race, table in tables.items()
        if not table.converged
    ]
    document["messages"] = [*document["messages"], *notes, *warnings]
    document["converged"] = document["converged"] and not warnings
    return document, {}


def torque_by_tables(
    case: Case, tables: Tables, equilibria: Equilibria | None = None
) -> tuple[BearingResults, tuple[str, ...]]:
    """Run a bearing without films, the friction of balls on races from traction tables.

    The result is that of `run_case` with `[friction] traction = "table"`.

    Parameters
    ----------
    case : Case
        The bearing.
    tables : Tables
        Traction tables of both races.
    equilibria : Equilibria, optional
        Equilibria of the points before.

    Returns
    -------
    results
        Results without films.
    notes
        Notes on the accuracy and the range of the tables.

    Raises
    ------
    ValueError
        If the tables belong to other bodies or another oil.
    """
    assert case.rheology is not None and case.friction is not None  # of every bearing case
    oil = (case.lubricant, case.rheology)
    require_fitting_tables(tables, "the traction table", case.bearing, *oil, case.films.solids)
    source = LawTraction(laws=dict(tables))
    traction = resisted_traction(source, case.friction, case.bearing, case.lubricant, case.inlet)
    case = replace(case, film_maps="none", traction=traction)
    results = run_case(case, 1, equilibria=equilibria)
    return results, () if results.torque is None else _notes(results.contacts, tables)


def _notes(contacts: Sequence[BearingContact], tables: Tables) -> tuple[str, ...]:
    """Accuracy of the tables, and how many contacts lie outside them."""
    outside = 0
    for contact in contacts:
        if contact.conditions is not None:
            limits = tables[contact.race].range
            speed = contact.conditions.entrainment_speed
            inside = (
                limits.load[0] <= contact.load <= limits.load[1]
                and limits.speed[0] <= speed <= limits.speed[1]
            )
            outside += not inside
    worst = max(table.error.quantile for table in tables.values())
    notes = [
        "torque: integrated by traction tables; 95 % of their forces within "
        f"{100.0 * worst:.1f} % of the largest"
    ]
    if outside:
        notes.append(f"torque: {outside} contacts {OUTSIDE}; the nearest place counts")
    return tuple(notes)
