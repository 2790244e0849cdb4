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

from oilfilm.bearing.files import PARTIAL, write_bytes
from oilfilm.ehl.foreign_files import parse_json, read_file
from oilfilm.postprocess.batch.store import (
    DONE,
    PATTERN,
    PointStore,
    Record,
    StoredPoints,
    holds_rows,
    store_files,
    summary_of,
    whole_records,
)

from ..format.rules import CaseError
from ..runs.interrupt import print_message
from ..runs.output_directory import DIGESTS, check_output
from .keys import DATA, FOLDERS, PARQUET, POINTS, SUMMARY, SWEEP_FILE, TABLE, digest


def open_folder(directory: Path, *, resume: bool, single_writer: bool = True) -> None:
    """Make the folder of a batch, or open that of an earlier one.

    Parameters
    ----------
    directory : Path
        The folder.
    resume : bool
        True: finished points in it are taken over.
    single_writer : bool, default True
        True: no other program writes into it; unfinished files are left of killed ones.

    Raises
    ------
    CaseError
        If the folder contains something else, or finished points, or cannot be written.
    """
    check_output(directory)
    if directory.exists() and any(directory.iterdir()) and not (directory / SWEEP_FILE).exists():
        raise CaseError(
            f"{directory}: holds other files; allowed with -o: a new directory, or that of a batch"
        )
    if not resume and has_points(directory):
        allowed = "allowed: --resume to go on, or another -o"
        raise CaseError(f"{directory}: holds finished points of an earlier batch; {allowed}")
    for file in (*_own_files(directory), *(directory / name for name in FOLDERS)):
        kind = "link" if file.is_symlink() else "folder"
        if kind == "link" or (file.is_dir() and file.name not in FOLDERS):
            wanted = f"is a {kind} in the place of a file of the batch; allowed: without it"
            raise CaseError(f"{file}: {wanted}, or another -o")
    (directory / POINTS).mkdir(parents=True, exist_ok=True)
    if single_writer:
        remove_unfinished(directory)


def has_points(directory: Path) -> bool:
    """Tell whether a folder contains points of a batch.

    Parameters
    ----------
    directory : Path
        The folder.

    Returns
    -------
    bool
        True if it does.
    """
    return any(map(holds_rows, store_files(directory)))


def remove_unfinished(directory: Path) -> None:
    """Remove files that killed processes were writing.

    Parameters
    ----------
    directory : Path
        Folder of the batch.
    """
    for folder in FOLDERS:
        for left in (directory / folder).glob(f".*{PARTIAL}*"):
            left.unlink(missing_ok=True)


def _own_files(directory: Path) -> Iterator[Path]:
    """Files and folders in the place of files of the batch."""
    names = (SWEEP_FILE, SUMMARY, TABLE, DATA, PARQUET, DIGESTS)
    yield from (directory / name for name in names)
    yield from directory.glob(PATTERN)
    for folder in FOLDERS:
        yield from (directory / folder).glob("*.*")


def write_file(path: Path, data: bytes) -> None:
    """Write a file so that it exists as a whole or not at all, also after a power cut.

    Parameters
    ----------
    path : Path
        The file.
    data : bytes
        Its content.
    """
    write_bytes(path, data, durable=True)


def write_files(directory: Path, key: str, files: dict[str, bytes]) -> None:
    """Write the files of a point beside its record.

    Parameters
    ----------
    directory : Path
        Folder of the batch.
    key : str
        Name of the point.
    files : dict[str, bytes]
        Contents by suffix.
    """
    for suffix, content in files.items():
        write_file(directory / POINTS / f"{key}{suffix}", content)


def write_summary(directory: Path, record: Record) -> None:
    """Write the summary of a point as JSON.

    Parameters
    ----------
    directory : Path
        Folder of the batch.
    record : Record
        Record of the point.
    """
    content = {"key": record.key, "status": record.status, "message": record.message}
    document = content | {"summary": summary_of(record)}
    text = json.dumps(document, ensure_ascii=False, allow_nan=False)
    write_file(directory / POINTS / f"{record.key}.json", text.encode())


def open_store(path: Path, *, broken: bool = False) -> PointStore:
    """Open the file of a writer.

    Parameters
    ----------
    path : Path
        The file.
    broken : bool, default False
        True: the file is replaced by its undamaged records.

    Returns
    -------
    PointStore
        The open file.
    """
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
    """Sort points into computed ones and failed ones.

    A point with a damaged record or file counts among neither; a message says so.

    Parameters
    ----------
    directory : Path
        Folder of the batch.
    keys : Iterable[str]
        Names of the points.
    stored : StoredPoints
        Records of the folder.

    Returns
    -------
    finished
        Names of the points that are computed.
    failed
        Names of those that failed or were lost.
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
        for suffix, expected in parse_json(record.files if record else "{}", key).items():
            file = directory / POINTS / Path(f"{key}{suffix}").name
            if not file.is_file() or digest(read_file(file)) != expected:
                print_message(f"oilfilm: {file}: damaged; the point is computed anew")
                damaged.add(key)
    return damaged
