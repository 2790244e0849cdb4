"""One point of a batch, computed in a worker: plain data in, plain data out."""

import atexit
import json
import shutil
import tempfile
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import Any

from ..format.case import case_of_document
from ..version import version
from .compute import Computed, compute
from .contact_cache import cached_solver
from .keys import digest
from .points import Receipt, Task
from .store import (
    CONTACTS,
    DONE,
    FAILED,
    damaged_file,
    read_point,
    record_digest,
    write_file,
    write_point,
)

EMPTY: Mapping[str, bytes] = MappingProxyType({})


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
    done = known is not None and known["status"] == DONE
    if done and folder is not None and not damaged_file(folder, task.key):
        return Receipt(DONE)
    try:
        summary, files = _computed(task, folder, tables)
        receipt = Receipt(DONE, {**files, **record(task.key, DONE, "", summary, files)})
    except Exception as error:  # one point must not stop the others
        text = " ".join(str(error).split()) or type(error).__name__
        receipt = failure(task.key, FAILED, f"{type(error).__name__}: {text}"[:500])
    if folder is None:
        return receipt
    write_point(folder, task.key, receipt.files)
    return Receipt(receipt.status)


def record(
    key: str,
    status: str,
    message: str = "",
    summary: dict[str, Any] | None = None,
    files: Mapping[str, bytes] = EMPTY,
) -> dict[str, bytes]:
    """The file that says what became of a point, by its suffix, with digests of the others."""
    content: dict[str, Any] = {"key": key, "status": status, "message": message}
    content |= {"summary": summary, "files": {name: digest(data) for name, data in files.items()}}
    plain = json.loads(json.dumps(content, allow_nan=False))
    plain["digest"] = record_digest(plain)
    return {".json": json.dumps(plain, ensure_ascii=False).encode()}


def failure(key: str, status: str, message: str) -> Receipt:
    """Of a point that has no result."""
    return Receipt(status, record(key, status, message))


def _computed(task: Task, folder: Path | None, content: bytes | None) -> Computed:
    """Summary and files of a point; tables that did not come as a file become one."""
    shared = cached_solver(folder / CONTACTS) if task.share and folder is not None else None
    tables = None if task.tables is None else Path(task.tables)
    if tables is not None and content is not None:
        tables = _temporary_folder() / tables.name
        if not tables.exists():
            write_file(tables, content)
    return compute(case_of_document(task.document), task, tables, shared)


@cache
def _temporary_folder() -> Path:
    """Of this process, for tables sent to a worker of a cluster."""
    folder = Path(tempfile.mkdtemp(prefix="oilfilm-tables-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder
