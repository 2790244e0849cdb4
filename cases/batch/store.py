"""The folder of a batch: one file for each finished point, there as a whole or not at all.

sweep.toml          the sweep as run last
points/KEY.json     a finished point: case and summary, or the message it failed with
points/KEY.nc       its film maps, where the batch writes them
points/KEY.zip      its traction tables, where the batch computes tables
contacts/KEY.npz    solved contacts that several points share
tables/KEY.zip      traction tables that several points share
"""

import json
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from bearing.files import PARTIAL, write_bytes

from ..format.problems import CaseError
from ..runs.integrity import DIGESTS
from ..runs.interrupt import say
from ..runs.output_directory import check_output
from .keys import digest, document_text

POINTS = "points"
CONTACTS = "contacts"
TABLES = "tables"
SWEEP_FILE = "sweep.toml"
SUMMARY = "summary.json"
TABLE = "batch.csv"
DATA = "results.nc"
DONE = "done"
FAILED = "failed"
LOST = "lost"


def open_folder(directory: Path, *, resume: bool) -> None:
    """Make the folder of a batch, or open that of an earlier one.

    `CaseError` if it holds something else, or finished points and `resume` is not wanted, or
    cannot be written.
    """
    check_output(directory)
    if directory.exists() and any(directory.iterdir()) and not (directory / SWEEP_FILE).exists():
        raise CaseError(
            f"{directory}: holds other files; allowed with -o: a new directory, or that of a batch"
        )
    if not resume and any((directory / POINTS).glob("*.json")):
        allowed = "allowed: --resume to go on, or another -o"
        raise CaseError(f"{directory}: holds finished points of an earlier batch; {allowed}")
    for file in _own_files(directory):
        if file.is_dir():
            wanted = "is a folder in the place of a file of the batch; allowed: without it"
            raise CaseError(f"{file}: {wanted}, or another -o")
    (directory / POINTS).mkdir(parents=True, exist_ok=True)
    remove_unfinished(directory)


def remove_unfinished(directory: Path) -> None:
    """Remove what processes that were killed were writing."""
    for folder in (POINTS, CONTACTS, TABLES):
        for left in (directory / folder).glob(f".*{PARTIAL}*"):
            left.unlink(missing_ok=True)


def _own_files(directory: Path) -> Iterator[Path]:
    """What stands where files of a batch belong."""
    yield from (directory / name for name in (SWEEP_FILE, SUMMARY, TABLE, DATA, DIGESTS))
    for folder in (POINTS, CONTACTS, TABLES):
        yield from (directory / folder).glob("*.*")


def write_file(path: Path, data: bytes) -> None:
    """Write a file so that it is there as a whole or not at all, also after a power cut."""
    write_bytes(path, data, durable=True)


def write_point(directory: Path, key: str, files: dict[str, bytes]) -> None:
    """Write the files of a finished point, by suffix; the one that counts, `.json`, last."""
    for suffix in sorted(files, key=lambda suffix: suffix == ".json"):
        write_file(directory / POINTS / f"{key}{suffix}", files[suffix])


def read_point(directory: Path, key: str) -> dict[str, Any] | None:
    """A finished point; None if there is none, or its file is damaged."""
    try:
        record = json.loads((directory / POINTS / f"{key}.json").read_text(encoding="utf-8"))
        whole = record.pop("digest") == record_digest(record) and record["key"] == key
    except (OSError, ValueError, RecursionError, AttributeError, KeyError, TypeError):
        return None
    return record if whole else None


def record_digest(record: dict[str, Any]) -> str:
    """Hash of what the file of a point holds beside it."""
    return digest(document_text(record))


def damaged_file(directory: Path, key: str) -> Path | None:
    """The first file of a point that is not as it was written; None if there is none such."""
    path = directory / POINTS / f"{key}.json"
    record = read_point(directory, key)
    if record is None:
        return path if path.exists() else None
    for suffix, expected in record["files"].items():
        file = path.with_suffix(suffix)
        try:
            whole = digest(file.read_bytes()) == expected
        except OSError:
            whole = False
        if not whole:
            return file
    return None


def finished_keys(directory: Path, keys: Iterable[str]) -> set[str]:
    """Those of `keys` that have been computed; points that failed are to be tried again, and so
    are those with a damaged file, which is said.
    """
    finished = set()
    for key in keys:
        damaged = damaged_file(directory, key)
        if damaged is not None:
            say(f"oilfilm: {damaged}: damaged; the point is computed anew")
            continue
        record = read_point(directory, key)
        if record is not None and record["status"] == DONE:
            finished.add(key)
    return finished
