"""One point of a batch, computed in a worker: plain data in, plain data out."""

import atexit
import json
import shutil
import tempfile
from functools import cache
from pathlib import Path
from time import perf_counter
from typing import Any

from ..format.case import case_of_file
from ..format.document import check_document
from ..format.problems import CaseError
from ..version import version
from .compute import Computed, compute
from .contact_cache import cached_solver
from .points import Receipt, Task
from .store import CONTACTS, read_point, write_file, write_point

DONE = "done"
FAILED = "failed"
LOST = "lost"


def compute_point(task: Task, tables: bytes | None = None) -> Receipt:
    """Compute a point and, if the folder can be reached, write it before anything else is begun.

    `tables` is the content of the file of traction tables where that cannot be reached. What a
    point fails with is recorded; an error of the folder itself (disk full) is raised.
    """
    folder = None if task.folder is None else Path(task.folder)
    if task.program != version():
        raise RuntimeError(
            f"a worker has oilfilm {version()}, the batch was started with {task.program}"
        )
    known = None if folder is None else read_point(folder, task.key)
    if known is not None and known["status"] == DONE:
        return Receipt(key=task.key, status=DONE)
    start = perf_counter()
    record, files = _record(task, folder, tables)
    files[".json"] = json.dumps(record, ensure_ascii=False, allow_nan=False).encode()
    wall = perf_counter() - start
    if folder is None:
        return Receipt(
            key=task.key,
            status=record["status"],
            message=record["message"],
            wall=wall,
            files=files,
        )
    write_point(folder, task.key, files)
    return Receipt(key=task.key, status=record["status"], message=record["message"], wall=wall)


def failure(key: str, status: str, message: str) -> dict[str, bytes]:
    """Files of a point that has no result."""
    return {
        ".json": json.dumps(
            {"key": key, "status": status, "message": message, "summary": None}
        ).encode()
    }


def _record(task: Task, folder: Path | None, tables: bytes | None) -> Computed:
    record: dict[str, Any] = {"key": task.key, "status": DONE, "message": "", "summary": None}
    try:
        summary, files = _computed(task, folder, tables)
    except Exception as error:  # one point must not stop the others
        text = " ".join(str(error).split()) or type(error).__name__
        return record | {"status": FAILED, "message": f"{type(error).__name__}: {text}"[:500]}, {}
    return record | {"summary": summary}, files


def _computed(task: Task, folder: Path | None, content: bytes | None) -> Computed:
    """Summary and files of a point; tables that did not come as a file become one."""
    file, problems = check_document(task.document)
    if file is None or problems:
        raise CaseError(problem.text("case", {}) for problem in problems)
    shared = cached_solver(folder / CONTACTS) if task.share and folder is not None else None
    case = case_of_file(file, "case")
    if task.tables is None or content is None:
        return compute(case, task, None if task.tables is None else Path(task.tables), shared)
    return compute(case, task, _local_tables(Path(task.tables).name, content), shared)


def _local_tables(name: str, content: bytes) -> Path:
    """Tables sent to a worker of a cluster, in a folder of this process."""
    path = _temporary_folder() / name
    if not path.exists():
        write_file(path, content)
    return path


@cache
def _temporary_folder() -> Path:
    folder = Path(tempfile.mkdtemp(prefix="oilfilm-tables-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder
