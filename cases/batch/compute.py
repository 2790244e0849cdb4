"""Points of a batch, computed in a worker: plain data in, plain data out.

The summary of a point travels as JSON by the compiled writer of pydantic, in a third of the time
of Python's own and with the same values. A worker limits the time and the memory of each point.
"""

import atexit
import json
import os
import shutil
import signal
import sys
import tempfile
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from functools import cache, lru_cache
from pathlib import Path
from types import FrameType
from typing import Any

from pydantic_core import from_json, to_json

from oilfilm.bearing.friction.friction_sources import LawTraction
from oilfilm.bearing.friction.tables import Tables, save_race_tables
from oilfilm.postprocess import summary
from oilfilm.postprocess.batch.store import FAILED, Record, record_of
from oilfilm.postprocess.bearing.results import BearingResults
from oilfilm.postprocess.bearing.write import write_bearing_netcdf
from oilfilm.postprocess.contact.summary import ContactResults
from oilfilm.postprocess.contact.write import write_contact_netcdf
from oilfilm.postprocess.dynamics.results import dynamics_summary
from oilfilm.postprocess.shaft.results import shaft_summary
from oilfilm.postprocess.slip.results import slip_summary
from oilfilm.postprocess.traction.results import traction_summary
from oilfilm.postprocess.vibration.summary import vibration_summary
from oilfilm.postprocess.vibration.write import write_record

from ..format.case import Case, ContactCase
from ..format.shaft_case import ShaftCase, any_case_of_document
from ..format.traction import require_fitting_tables, resisted_traction
from ..runs.bearing import of_main_numbers, run_case
from ..runs.contact import run_contact
from ..runs.dynamics import run_dynamics
from ..runs.equilibrium import Equilibria
from ..runs.films import Solve
from ..runs.output_directory import scratch_folder
from ..runs.shaft import run_shaft
from ..runs.stiffness_and_slip import run_slip
from ..runs.traction_table import run_table
from ..runs.vibration import run_vibration
from .keys import CONTACTS, digest, program_digest, value_in
from .plan import asked_parts
from .points import Limits, PointResult, Task
from .shared_tables import ContactCache, tables_once
from .store import write_file, write_files

Computed = tuple[dict[str, Any], dict[str, bytes]]  # summary, files by suffix

GRACE = 30.0  # after which a point that does not answer its time limit ends with its worker [s]
GIGABYTE = 1e9  # [bytes]
SUSPECT = (b"NaN", b"Infinity")  # what stands in JSON for numbers that are none, or in a text


def compute(
    case: Case | ContactCase | ShaftCase,
    task: Task,
    tables: Path | None,
    solve: Solve | None,
    equilibria: Equilibria | None = None,
) -> Computed:
    """Compute one point: its summary, and its files by suffix.

    Parameters
    ----------
    case : Case | ContactCase | ShaftCase
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
    if isinstance(case, ShaftCase):
        return shaft_summary(run_shaft(case)), {}
    if task.compute == "slip":
        return slip_summary(run_slip(case, "case", 1)), {}
    if task.compute == "vibration" or (task.compute == "dynamics" and case.only_vibrates):
        return _vibration(case, task)
    if task.compute == "dynamics":
        return _dynamics(case, task, tables)
    if task.compute == "table":
        return _table(case, task)
    if task.outputs:
        case = of_main_numbers(case, **asked_parts(task.outputs))
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


def _vibration(case: Case, task: Task) -> Computed:
    """Vibration over time; its record is a file if one is written."""
    results = run_vibration(case, "case")
    document = vibration_summary(results)
    if not task.fields:
        return document, {}
    with scratch_folder() as temporary:
        path = temporary / "results.nc"
        write_record(results, path, document)
        return document, {".nc": path.read_bytes()}


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
    tables = tables_once(str(path))(case.lubricant)
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
        Note on the accuracy of the tables.

    Raises
    ------
    ValueError
        If the tables belong to other bodies or another oil.
    """
    assert case.rheology is not None and case.friction is not None  # of every bearing case
    oil = (case.lubricant, case.rheology)
    require_fitting_tables(tables, "the traction table", case.bearing, *oil, case.films.solids)
    source = LawTraction(laws=dict(tables))
    traction = resisted_traction(
        source, case.friction, case.bearing, case.lubricant, case.operation.shaft_speed, case.inlet
    )
    case = replace(case, film_maps="none", traction=traction)
    results = run_case(case, 1, equilibria=equilibria)
    worst = max(table.error.quantile for table in tables.values())
    note = (
        "torque: integrated by traction tables; 95 % of their forces within "
        f"{100.0 * worst:.1f} % of the largest"
    )
    return results, () if results.torque is None else (note,)


@contextmanager
def limited(limits: Limits) -> Iterator[None]:
    """Limit time and memory of the work inside.

    Compiled code is not interrupted: a worker that has not returned from it `GRACE` seconds after
    its time ends as a whole, and its point is recorded as lost.

    Parameters
    ----------
    limits : Limits
        Time [s] and memory [GB] of one point; None: without limit.

    Raises
    ------
    TimeoutError
        If the work takes more time.
    MemoryError
        If the work takes more memory.
    """
    with _time_limit(limits.seconds), _memory_limit(limits.memory):
        yield


@contextmanager
def _time_limit(seconds: float | None) -> Iterator[None]:
    if seconds is None:
        yield
        return
    last = threading.Timer(seconds + GRACE, os._exit, (1,))
    last.daemon = True
    last.start()

    def stop(_number: int, _frame: FrameType | None) -> None:
        raise TimeoutError(f"the point takes longer than its {seconds:g} s")

    alarm = sys.platform != "win32" and threading.current_thread() is threading.main_thread()
    try:
        if sys.platform != "win32" and alarm:
            previous = signal.signal(signal.SIGALRM, stop)
            signal.setitimer(signal.ITIMER_REAL, seconds)
        yield
    finally:
        if sys.platform != "win32" and alarm:
            signal.setitimer(signal.ITIMER_REAL, 0.0)
            signal.signal(signal.SIGALRM, previous)
        last.cancel()


@contextmanager
def _memory_limit(gigabytes: float | None) -> Iterator[None]:
    """Limit the address space beyond its size at the start of the point; on Linux."""
    if gigabytes is None or not sys.platform.startswith("linux"):
        yield
        return
    import resource

    with open("/proc/self/statm", encoding="ascii") as file:
        taken = int(file.read().split()[0]) * resource.getpagesize()
    before = resource.getrlimit(resource.RLIMIT_AS)
    wanted = taken + int(gigabytes * GIGABYTE)
    most = wanted if before[1] == resource.RLIM_INFINITY else min(wanted, before[1])
    resource.setrlimit(resource.RLIMIT_AS, (most, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, before)


def json_of(document: dict[str, Any]) -> bytes:
    """Write a document as JSON.

    Parameters
    ----------
    document : dict[str, Any]
        Values of plain types.

    Returns
    -------
    bytes
        JSON in UTF-8.

    Raises
    ------
    ValueError
        If a number is not finite.
    """
    text: bytes = to_json(document)
    if any(word in text for word in SUSPECT):
        return json.dumps(document, ensure_ascii=False, allow_nan=False).encode()
    return text


def document_of(text: bytes) -> dict[str, Any]:
    """Read a document that `json_of` has written.

    Parameters
    ----------
    text : bytes
        JSON in UTF-8.

    Returns
    -------
    dict[str, Any]
        The document.
    """
    document: dict[str, Any] = from_json(text)
    return document


def compute_block(tasks: Sequence[Task], tables: bytes | None = None) -> tuple[PointResult, ...]:
    """Compute points one after the other, see `compute_point`.

    Parameters
    ----------
    tasks : Sequence[Task]
        The points.
    tables : bytes | None, optional
        Content of the file of traction tables where the worker cannot read it.

    Returns
    -------
    tuple[PointResult, ...]
        A result for each point.
    """
    return tuple(compute_point(task, tables) for task in tasks)


def compute_point(task: Task, tables: bytes | None = None) -> PointResult:
    """Compute a point; its own files are written if the folder can be reached.

    The error of a point is recorded; an error of the folder itself (disk full) is raised.

    Parameters
    ----------
    task : Task
        The point.
    tables : bytes | None, optional
        Content of the file of traction tables where the worker cannot read it.

    Returns
    -------
    PointResult
        Record of the point, with its files where it did not write them.

    Raises
    ------
    RuntimeError
        If the worker has another version of the program.
    OSError
        If a file cannot be written.
    """
    folder = None if task.folder is None else Path(task.folder)
    if task.program != program_digest():
        raise RuntimeError(
            f"a worker has oilfilm of code {program_digest()}, the batch was started with code "
            f"{task.program}; install the same on both"
        )
    try:
        with limited(task.limits):
            summary, files = _computed(task, folder, tables)
        values = {key: value_in(summary["case"], key) for key in task.keys}
        named = {name: digest(data) for name, data in files.items()}
        record = record_of(task.key, summary, values, named, json_of(summary))
    except MemoryError:
        return failure(task.key, FAILED, _beyond_memory(task))
    except Exception as error:  # one point must not stop the others
        text = " ".join(str(error).split()) or type(error).__name__
        return failure(task.key, FAILED, f"{type(error).__name__}: {text}"[:500])
    if folder is None:
        return PointResult(record, files)
    write_files(folder, task.key, files)
    return PointResult(record)


def _beyond_memory(task: Task) -> str:
    """Message of a point that needs more memory than there is."""
    if task.limits.memory is None:
        return "MemoryError: the machine has no more memory for this point"
    return f"MemoryError: the point needs more than its {task.limits.memory:g} GB of memory"


def failure(key: str, status: str, message: str) -> PointResult:
    """Record of a point without results.

    Parameters
    ----------
    key : str
        Name of the point.
    status : str
        Failed or lost.
    message : str
        The reason.

    Returns
    -------
    PointResult
        Result that holds the record.
    """
    return PointResult(Record(key=key, status=status, message=message))


def _computed(task: Task, folder: Path | None, content: bytes | None) -> Computed:
    """Summary and files of a point; tables that did not come as a file become one."""
    shared = None
    if task.share_contacts and folder is not None:
        shared = _contacts(folder / CONTACTS).solve
    tables = None if task.tables is None else Path(task.tables)
    if tables is not None and content is not None:
        tables = _temporary_folder() / tables.name
        if not tables.exists():
            write_file(tables, content)
    return compute(any_case_of_document(task.document), task, tables, shared, _equilibria())


@lru_cache(maxsize=4)
def _contacts(folder: Path) -> ContactCache:
    """The contacts of a batch, which all its points have in common."""
    return ContactCache(folder)


@cache
def _equilibria() -> Equilibria:
    """Equilibria of this process, which points that differ in oil or surfaces have in common."""
    return Equilibria()


@cache
def _temporary_folder() -> Path:
    """Folder of this process for tables sent to a worker of a cluster."""
    folder = Path(tempfile.mkdtemp(prefix="oilfilm-tables-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder
