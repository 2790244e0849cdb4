"""The folder of a batch.

sweep.toml          the sweep as run last
points*.sqlite      finished points: case and summary, or the message they failed with
points/KEY.json     the summary of a point, where it is asked for
points/KEY.nc       its film maps, where the batch writes them
points/KEY.zip      its traction tables, where the batch computes tables
contacts/KEY.contact solved contacts that several points share
tables/KEY.zip      traction tables that several points share
"""

import json
import os
from collections.abc import Iterable, Iterator
from pathlib import Path

from bearing.files import PARTIAL, write_bytes
from postprocess.batch.records import DONE, Record, summary_of
from postprocess.batch.store import (
    PATTERN,
    PointStore,
    StoredPoints,
    holds_rows,
    store_files,
    whole_records,
)

from ..format.problems import CaseError
from ..runs.integrity import DIGESTS
from ..runs.interrupt import print_message
from ..runs.output_directory import check_output
from .keys import digest

POINTS = "points"
CONTACTS = "contacts"
TABLES = "tables"
SWEEP_FILE = "sweep.toml"
SUMMARY = "summary.json"
TABLE = "batch.csv"
DATA = "results.nc"
PARQUET = "batch.parquet"


def open_folder(directory: Path, *, resume: bool, single_writer: bool = True) -> None:
    """Make the folder of a batch, or open that of an earlier one.

    `CaseError` if it holds something else, or finished points and `resume` is not wanted, or
    cannot be written. `alone`: no other program writes into it, so that what is unfinished there
    is left of killed ones.
    """
    check_output(directory)
    if directory.exists() and any(directory.iterdir()) and not (directory / SWEEP_FILE).exists():
        raise CaseError(
            f"{directory}: holds other files; allowed with -o: a new directory, or that of a batch"
        )
    if not resume and has_points(directory):
        allowed = "allowed: --resume to go on, or another -o"
        raise CaseError(f"{directory}: holds finished points of an earlier batch; {allowed}")
    for file in _own_files(directory):
        if file.is_dir():
            wanted = "is a folder in the place of a file of the batch; allowed: without it"
            raise CaseError(f"{file}: {wanted}, or another -o")
    (directory / POINTS).mkdir(parents=True, exist_ok=True)
    if single_writer:
        remove_unfinished(directory)


def has_points(directory: Path) -> bool:
    """Whether a folder holds points of a batch; those of old versions are files of their own."""
    return any(map(holds_rows, store_files(directory))) or any((directory / POINTS).glob("*.json"))


def remove_unfinished(directory: Path) -> None:
    """Remove what processes that were killed were writing."""
    for folder in (POINTS, CONTACTS, TABLES):
        for left in (directory / folder).glob(f".*{PARTIAL}*"):
            left.unlink(missing_ok=True)


def _own_files(directory: Path) -> Iterator[Path]:
    """What stands where files of a batch belong."""
    names = (SWEEP_FILE, SUMMARY, TABLE, DATA, PARQUET, DIGESTS)
    yield from (directory / name for name in names)
    yield from directory.glob(PATTERN)
    for folder in (POINTS, CONTACTS, TABLES):
        yield from (directory / folder).glob("*.*")


def write_file(path: Path, data: bytes) -> None:
    """Write a file so that it is there as a whole or not at all, also after a power cut."""
    write_bytes(path, data, durable=True)


def write_files(directory: Path, key: str, files: dict[str, bytes]) -> None:
    """Write the files of a point beside its record, by suffix."""
    for suffix, content in files.items():
        write_file(directory / POINTS / f"{key}{suffix}", content)


def write_summary(directory: Path, record: Record) -> None:
    """Write the summary of a point as JSON."""
    content = {"key": record.key, "status": record.status, "message": record.message}
    document = content | {"summary": summary_of(record)}
    text = json.dumps(document, ensure_ascii=False, allow_nan=False)
    write_file(directory / POINTS / f"{record.key}.json", text.encode())


def open_store(path: Path, *, broken: bool = False) -> PointStore:
    """The file of a writer; a broken one is replaced by what is whole of it."""
    if not broken:
        return PointStore(path)
    whole = [record for _, record in whole_records(path) if record is not None]
    for name in (path.name, f"{path.name}-wal"):
        if path.with_name(name).exists():
            os.replace(path.with_name(name), path.with_name(f"{name}.damaged"))
    print_message(
        f"oilfilm: {path}: damaged; {len(whole)} points of it are kept, see {path.name}.damaged"
    )
    store = PointStore(path)
    for record in whole:
        store.put(record)
    store.flush(at_once=True)
    return store


def finished_points(
    directory: Path, keys: Iterable[str], stored: StoredPoints
) -> tuple[set[str], set[str]]:
    """Those of `keys` that have been computed, and those that failed or were lost.

    Points with a damaged record or file count among neither, and it is said.
    """
    for path, count in stored.damaged.items():
        print_message(f"oilfilm: {path}: {count} points are damaged; they are computed anew")
    done = set()
    failed = set()
    for key in keys:
        status = stored.status.get(key)
        if status == DONE:
            done.add(key)
        elif status is not None:
            failed.add(key)
    return done - _with_damaged_files(directory, stored, done), failed


def _with_damaged_files(directory: Path, stored: StoredPoints, keys: set[str]) -> set[str]:
    """Points of which a file beside the record is not as it was written, which is said."""
    damaged = set()
    for key in sorted(keys & stored.with_files):
        (record,) = stored.records([key])
        for suffix, expected in json.loads(record.files if record else "{}").items():
            file = directory / POINTS / f"{key}{suffix}"
            if not file.is_file() or digest(file.read_bytes()) != expected:
                print_message(f"oilfilm: {file}: damaged; the point is computed anew")
                damaged.add(key)
    return damaged
