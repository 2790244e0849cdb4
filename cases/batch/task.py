"""One point of a batch, computed in a worker: plain data in, plain data out."""

from __future__ import annotations

import json
import tempfile
from dataclasses import dataclass, field
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any

from ..version import version
from .store import CONTACTS, read_point, write_point

if TYPE_CHECKING:
    from postprocess.results import BearingResults, ContactResults

DONE, FAILED, LOST = "done", "failed", "lost"


@dataclass(frozen=True, slots=True, kw_only=True)
class Task:
    """What a worker is asked; `folder` is None where it cannot reach the folder of the batch."""

    key: str
    document: dict[str, Any]
    compute: str
    fields: bool
    share: bool  # whether contacts may be equal in several points
    folder: str | None
    program: str = field(default_factory=version)


@dataclass(frozen=True, slots=True, kw_only=True)
class Receipt:
    """What a worker answers: how the point ended, its wall time [s], and its files where it did not write them."""

    key: str
    status: str
    message: str = ""
    wall: float = 0.0
    files: dict[str, bytes] = field(default_factory=dict)


def compute_point(task: Task) -> Receipt:
    """Compute a point and, if the folder can be reached, write it before anything else is begun.

    What a point fails with is recorded; an error of the folder itself (disk full) is raised.
    """
    folder = None if task.folder is None else Path(task.folder)
    if task.program != version():
        raise RuntimeError(f"a worker has oilfilm {version()}, the batch was started with {task.program}")
    known = None if folder is None else read_point(folder, task.key)
    if known is not None and known["status"] == DONE:
        return Receipt(key=task.key, status=DONE)
    start = perf_counter()
    record, files = _record(task, folder)
    files[".json"] = json.dumps(record, ensure_ascii=False, allow_nan=False).encode()
    wall = perf_counter() - start
    if folder is None:
        return Receipt(key=task.key, status=record["status"], message=record["message"], wall=wall, files=files)
    write_point(folder, task.key, files)
    return Receipt(key=task.key, status=record["status"], message=record["message"], wall=wall)


def failure(key: str, status: str, message: str) -> dict[str, bytes]:
    """Files of a point that has no result."""
    return {".json": json.dumps({"key": key, "status": status, "message": message, "summary": None}).encode()}


def _record(task: Task, folder: Path | None) -> tuple[dict[str, Any], dict[str, bytes]]:
    record: dict[str, Any] = {"key": task.key, "status": DONE, "message": "", "summary": None}
    try:
        summary, files = _computed(task, folder)
    except Exception as error:  # one point must not stop the others
        text = " ".join(str(error).split()) or type(error).__name__
        return record | {"status": FAILED, "message": f"{type(error).__name__}: {text}"[:500]}, {}
    return record | {"summary": summary}, files


def _computed(task: Task, folder: Path | None) -> tuple[dict[str, Any], dict[str, bytes]]:
    from ..case import ContactCase, case_of_file, check_document
    from ..problems import CaseError
    from ..run import run_case, run_contact
    from .contact_cache import cached_solver

    file, problems = check_document(task.document)
    if file is None or problems:
        raise CaseError(problem.text("case", {}) for problem in problems)
    case = case_of_file(file, "case")
    if task.compute == "slip":
        from postprocess.slip_results import slip_summary

        from ..slip import run_slip

        assert not isinstance(case, ContactCase)  # checked with the sweep
        return slip_summary(run_slip(case, "case", 1)), {}
    if isinstance(case, ContactCase):
        return _with_fields(run_contact(case), task)
    shared = cached_solver(folder / CONTACTS) if task.share and folder is not None else None
    return _with_fields(run_case(case, 1, None, shared), task)


def _with_fields(results: BearingResults | ContactResults, task: Task) -> tuple[dict[str, Any], dict[str, bytes]]:
    """The summary, and the netCDF file of the film maps if it is wanted."""
    from postprocess import summary

    document = summary(results)
    if not task.fields:
        return document, {}
    from postprocess.results_io import write_netcdf

    with tempfile.TemporaryDirectory(prefix="oilfilm-") as temporary:
        path = Path(temporary) / "results.nc"
        write_netcdf(results, path, document)
        return document, {".nc": path.read_bytes()}
