"""Points of a batch, computed in a worker: plain data in, plain data out."""

import atexit
import shutil
import tempfile
from collections.abc import Sequence
from functools import cache, lru_cache
from pathlib import Path

from postprocess.batch.store import FAILED, Record, record_of

from ..format.case import case_of_document
from ..runs.equilibrium import Equilibria
from .compute import Computed, compute
from .keys import digest, value_in
from .limits import limited
from .points import PointResult, Task
from .program import program_digest
from .quick_json import json_of
from .shared.contact_cache import ContactCache
from .store import CONTACTS, write_file, write_files


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
    return compute(case_of_document(task.document), task, tables, shared, _equilibria())


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
