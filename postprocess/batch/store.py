"""Finished points of a batch on disk: one SQLite file for each writer.

points.sqlite            of `oilfilm batch`
points-3-of-8.sqlite     of its shard 3/8

A row is one record with the digest of its content: compressed summary, numbers as columns. Rows
are only added, the last of a key counts.
"""

import errno
import json
import sqlite3
import zlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import closing, contextmanager, suppress
from dataclasses import dataclass
from functools import lru_cache
from hashlib import blake2b
from pathlib import Path
from time import monotonic
from types import MappingProxyType
from typing import Any

import numpy as np

from oilfilm.ehl.foreign_files import DAMAGE, DamagedFileError, inflated, parse_json

from ..files import read_summary
from .results import BatchPoint, BatchResults, main_results, scalar_numbers

DONE = "done"
FAILED = "failed"
LOST = "lost"
LEVEL = 3  # of compression: 64 kB of JSON to 8 kB in 0.9 ms, level 6 takes 1.6 ms for 7 % less
NUMBER = 8  # of float64 [bytes]
BOOL, INTEGER, FLOAT, NOTHING = b"bif-"  # kinds of a number; nothing: null
NO_FILES: Mapping[str, str] = MappingProxyType({})
NO_VALUES: Mapping[str, Any] = MappingProxyType({})
PATTERN = "points*.sqlite"
FORMAT = 1  # of the tables below
PAGE = 4096  # of a file [bytes]: records of 10 kB waste little of them
MOST_PENDING = 50  # records, and
PATIENCE = 2.0  # time [s], after which records are put on disk
WAIT = 10.0  # for another program that reads the file [s]
COLUMNS = ("key", "status", "message", "vals", "numbers", "summary", "files")
SELECT = (
    f"SELECT points.id, digest, text, {', '.join(COLUMNS)} "
    "FROM points LEFT JOIN layouts ON layouts.id = layout"
)
TABLES = (
    "CREATE TABLE layouts (id INTEGER PRIMARY KEY, text TEXT NOT NULL)",
    """CREATE TABLE points (
    id INTEGER PRIMARY KEY, key TEXT, status TEXT, digest BLOB, layout INTEGER,
    message TEXT, vals TEXT, files TEXT, numbers BLOB, summary BLOB
)""",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Record:
    """A point as bytes and text, so that a digest covers all of it."""

    key: str
    status: str
    message: str = ""
    values: str = "{}"  # of the keys that the sweep varies, as run, JSON
    layout: str = "[]"  # names of the numbers, JSON: main results, then the others
    numbers: bytes = b""  # kinds, a byte each, then values as float64
    summary: bytes = b""  # compressed JSON
    files: str = "{}"  # digests of other files of the point by suffix, JSON

    @property
    def digest(self) -> bytes:
        """Hash of the whole content."""
        texts = (self.key, self.status, self.message, self.values, self.files)
        return content_digest(texts, self.layout, self.numbers, self.summary)


def content_digest(
    texts: tuple[str, str, str, str, str], layout: str, numbers: bytes, summary: bytes
) -> bytes:
    """Hash of the content of a record.

    Parameters
    ----------
    texts : tuple[str, str, str, str, str]
        Key, status, message, values, files.
    layout : str
        Names of the numbers, JSON.
    numbers : bytes
        Kinds and values.
    summary : bytes
        Compressed JSON.

    Returns
    -------
    bytes
        16 bytes.
    """
    digest = blake2b("\0".join(texts).encode(), digest_size=16, key=_layout_key(layout))
    digest.update(numbers)
    digest.update(b"%d %d" % (len(summary), zlib.crc32(summary)))
    return digest.digest()


@lru_cache(maxsize=256)
def _layout_key(layout: str) -> bytes:
    """Hash of the names of numbers, which many points have in common."""
    return blake2b(layout.encode(), digest_size=16).digest()


def record_of(
    key: str,
    summary: dict[str, Any],
    values: Mapping[str, Any] = NO_VALUES,
    files: Mapping[str, str] = NO_FILES,
    text: bytes = b"",
) -> Record:
    """Record of a computed point.

    Parameters
    ----------
    key : str
        Name of the point.
    summary : dict[str, Any]
        Summary of the point, plain JSON.
    values : Mapping[str, Any], default NO_VALUES
        Varied keys as run.
    files : Mapping[str, str], default NO_FILES
        Digests of other files of the point, by suffix.
    text : bytes, default b''
        The summary as JSON where it exists already.

    Returns
    -------
    Record
        The record.

    Raises
    ------
    ValueError
        If the summary is no JSON.
    """
    text = text or json.dumps(summary, ensure_ascii=False, allow_nan=False).encode()
    layout, numbers = packed_numbers(summary)
    return Record(
        key=key,
        status=DONE,
        values=json.dumps(dict(values), ensure_ascii=False),
        layout=layout,
        numbers=numbers,
        summary=zlib.compress(text, LEVEL),
        files=json.dumps(dict(files)),
    )


def summary_of(
    record: Record, read: Callable[[bytes], dict[str, Any]] = json.loads
) -> dict[str, Any] | None:
    """Summary of a stored point.

    Parameters
    ----------
    record : Record
        Record of a point.
    read : Callable[[bytes], dict[str, Any]], default json.loads
        Reads JSON.

    Returns
    -------
    dict[str, Any] | None
        The summary; None of a point without a result.
    """
    try:
        return read(inflated(record.summary)) if record.summary else None
    except DAMAGE as problem:
        raise DamagedFileError(f"summary of {record.key}: damaged: {problem}") from problem


def packed_numbers(summary: dict[str, Any]) -> tuple[str, bytes]:
    """Names of the numbers of a point as JSON, main results first, and their kinds and values.

    Parameters
    ----------
    summary : dict[str, Any]
        Summary of the results in named units.

    Returns
    -------
    value
        Names of the numbers, JSON: main results, then the others.
    value
        Kinds, a byte each, then values as float64.
    """
    main = main_results(summary)
    others = scalar_numbers(summary)
    others = {name: value for name, value in others.items() if name not in main}
    numbers = [*main.values(), *others.values()]
    values = np.array([np.nan if value is None else float(value) for value in numbers])
    layout = json.dumps([list(main), list(others)], ensure_ascii=False)
    return layout, bytes(map(_kind, numbers)) + values.astype("<f8").tobytes()


def _kind(value: Any) -> int:
    if value is None:
        return NOTHING
    if isinstance(value, bool):
        return BOOL
    return INTEGER if isinstance(value, int) else FLOAT


def unpacked_numbers(
    numbers: bytes, count: int
) -> tuple[np.ndarray[Any, np.dtype[np.uint8]], np.ndarray[Any, np.dtype[np.float64]]]:
    """Kinds and values of packed numbers.

    Parameters
    ----------
    numbers : bytes
        Packed numbers.
    count : int
        Numbers [-].

    Returns
    -------
    value
        Kinds, shape (count,).
    value
        Values, shape (count,), NaN for null.
    """
    kinds = np.frombuffer(numbers, dtype=np.uint8, count=count)
    return kinds, np.frombuffer(numbers, dtype="<f8", offset=count, count=count)


class PointStore:
    """The file of one writer, which nobody else writes; OSError where the disk takes no more."""

    def __init__(self, path: Path) -> None:
        self.path = path
        with _disk_failures(path):
            self._file = _connected(path, WAIT)
            self._layouts = {
                text: number for number, text in self._file.execute("SELECT id, text FROM layouts")
            }
        self._pending = 0
        self._since = monotonic()

    def put(self, record: Record) -> None:
        """Store a record; on disk after `PATIENCE` or with some others.

        Parameters
        ----------
        record : Record
            Record of a finished point.

        Raises
        ------
        OSError
            If the disk takes no more.
        """
        row = tuple(_column(record, name) for name in COLUMNS)
        places = ", ".join("?" * (len(COLUMNS) + 2))
        with _disk_failures(self.path):
            layout = self._layout(record.layout)
            self._file.execute(
                f"INSERT INTO points (digest, layout, {', '.join(COLUMNS)}) VALUES ({places})",
                (record.digest, layout, *row),
            )
        self._pending += 1
        self.flush(at_once=self._pending >= MOST_PENDING)

    def _layout(self, text: str) -> int:
        if text not in self._layouts:
            cursor = self._file.execute("INSERT INTO layouts (text) VALUES (?)", (text,))
            assert cursor.lastrowid is not None  # of a table with numbered rows
            self._layouts[text] = cursor.lastrowid
        return self._layouts[text]

    def flush(self, *, at_once: bool = False) -> None:
        """Put on disk what is due.

        Parameters
        ----------
        at_once : bool, default False
            Also what is not due.

        Raises
        ------
        OSError
            If the disk takes no more.
        """
        if self._pending and (at_once or monotonic() - self._since > PATIENCE):
            with _disk_failures(self.path):
                self._file.commit()
            self._pending = 0
            self._since = monotonic()

    def close(self, *, keep: bool = True) -> None:
        """Close the file such that it can be read where nothing can be written.

        Where a full disk does not let it, what was on disk before is there still.

        Parameters
        ----------
        keep : bool, default True
            Raise an error of the disk.

        Raises
        ------
        OSError
            If the disk takes no more, unless `keep` is false.
        """
        with closing(self._file), _disk_failures(self.path) if keep else suppress(sqlite3.Error):
            self._file.commit()
            self._file.execute("PRAGMA journal_mode = DELETE")


def _column(record: Record, name: str) -> Any:
    return record.values if name == "vals" else getattr(record, name)


@contextmanager
def _disk_failures(path: Path) -> Iterator[None]:
    """Errors of SQLite as those of the disk; of a locked file as that of an access."""
    try:
        yield
    except sqlite3.DatabaseError as error:
        name = getattr(error, "sqlite_errorname", "")
        numbers = {"SQLITE_FULL": errno.ENOSPC, "SQLITE_BUSY": errno.EACCES}
        raise OSError(numbers.get(name, errno.EIO), str(error), str(path)) from error


def _connected(path: Path, wait: float) -> sqlite3.Connection:
    """A file opened for this program alone after at most `wait` [s]; sqlite3.DatabaseError if it
    is damaged.
    """
    file = sqlite3.connect(path, timeout=wait)
    try:
        file.execute(f"PRAGMA page_size = {PAGE}")
        file.execute("PRAGMA locking_mode = EXCLUSIVE")  # needs no memory shared with others
        file.execute("PRAGMA journal_mode = WAL")
        file.execute("PRAGMA synchronous = FULL")
        (version,) = file.execute("PRAGMA user_version").fetchone()
        if version == 0:
            file.executescript(";\n".join((*TABLES, f"PRAGMA user_version = {FORMAT};")))
        _require_own_tables(file)
    except BaseException:
        file.close()
        raise
    return file


def store_files(directory: Path) -> list[Path]:
    """The files of points of a batch, sorted.

    Parameters
    ----------
    directory : Path
        Folder of the batch.

    Returns
    -------
    list[Path]
        The files, sorted.
    """
    return sorted(directory.glob(PATTERN))


def whole_records(path: Path) -> Iterator[tuple[int, Record | None]]:
    """Records of all rows of a file.

    Parameters
    ----------
    path : Path
        File of points.

    Yields
    ------
    Iterator[tuple[int, Record | None]]
        Number of the row and its record, None of a damaged row.
    """
    for number, row in _rows(path):
        yield number, None if row is None else _record(row)


def _rows(path: Path) -> Iterator[tuple[int, tuple[Any, ...] | None]]:
    """Number of each row of a file, and its columns, None where the row cannot be read."""
    try:
        with closing(_for_reading(path)) as file:
            last = 0
            while True:
                try:
                    for row in file.execute(f"{SELECT} WHERE points.id > ? ORDER BY 1", (last,)):
                        last = row[0]
                        yield last, row
                    return
                except sqlite3.DatabaseError:
                    (most,) = file.execute("SELECT max(id) FROM points").fetchone()
                    if most is None or last >= most:
                        return
                    last += 1
                    yield last, None
    except sqlite3.DatabaseError:  # nothing of the file can be
        return


def _for_reading(path: Path) -> sqlite3.Connection:
    """A file to read; what a killed writer had not merged into it is merged first."""
    if path.with_name(f"{path.name}-wal").exists():
        with suppress(sqlite3.OperationalError):  # nothing can be written, or somebody writes
            return _connected(path, 0.0)
    file = sqlite3.connect(f"{path.absolute().as_uri()}?immutable=1", uri=True)
    try:
        _require_own_tables(file)
    except BaseException:
        file.close()
        raise
    return file


def _require_own_tables(file: sqlite3.Connection) -> None:
    """DatabaseError where a file has views, triggers or other tables: those are programs."""
    file.execute("PRAGMA trusted_schema = OFF")
    tables = file.execute("SELECT sql FROM sqlite_master ORDER BY rowid")
    if tuple(sql for (sql,) in tables) != TABLES:
        raise sqlite3.DatabaseError("not the tables of oilfilm")


def _is_whole(row: tuple[Any, ...]) -> bool:
    """True if a row is as it was written."""
    _, digest, layout, key, status, message, values, numbers, summary, files = row
    try:
        content = ((key, status, message, values, files), layout or "[]", numbers, summary)
        main, others = layout_names(layout or "[]")
        return content_digest(*content) == digest and len(numbers) == (1 + NUMBER) * (
            len(main) + len(others)
        )
    except DAMAGE:
        return False


@lru_cache(maxsize=256)
def layout_names(layout: str) -> tuple[list[str], list[str]]:
    """Names of packed numbers.

    Parameters
    ----------
    layout : str
        Names as JSON.

    Returns
    -------
    value
        Names of main results.
    value
        Names of the others.

    Raises
    ------
    DamagedFileError
        If it is no such text.
    """
    parts: Any = parse_json(layout, "names of numbers") or ([], [])
    if len(parts) != 2 or not all(isinstance(name, str) for part in parts for name in part):
        raise DamagedFileError("names of numbers are damaged")
    return parts[0], parts[1]


def _record(row: tuple[Any, ...]) -> Record | None:
    """The record of a row; None of a damaged one."""
    if not _is_whole(row):
        return None
    fields = dict(zip(COLUMNS, row[3:], strict=True))
    fields["values"] = fields.pop("vals")
    return Record(layout=row[2] or "[]", **fields)


def is_sound(path: Path) -> bool:
    """True if SQLite can open a file and its tables.

    Parameters
    ----------
    path : Path
        File of points.

    Returns
    -------
    bool
        True if the tables can be read.
    """
    try:
        with closing(_for_reading(path)) as file:
            file.execute("SELECT max(id) FROM points").fetchone()
            file.execute("SELECT max(id) FROM layouts").fetchone()
    except sqlite3.DatabaseError:
        return False
    return True


def holds_rows(path: Path) -> bool:
    """True if a file has points, or cannot be read and may have some.

    Parameters
    ----------
    path : Path
        File of points.

    Returns
    -------
    bool
        True if there are, or may be, points.
    """
    try:
        with closing(_for_reading(path)) as file:
            return file.execute("SELECT 1 FROM points LIMIT 1").fetchone() is not None
    except sqlite3.DatabaseError:
        return True


class StoredPoints:
    """Finished points of several files: where each is, and what became of it."""

    def __init__(self, paths: Sequence[Path]) -> None:
        self.paths = tuple(paths)
        self.status: dict[str, str] = {}
        self.damaged: dict[Path, int] = {}  # rows by their file
        self.with_files: set[str] = set()
        self._places: dict[str, tuple[int, int]] = {}
        for number, path in enumerate(self.paths):
            for place, row in _rows(path):
                if row is None or not _is_whole(row):
                    self.damaged[path] = self.damaged.get(path, 0) + 1
                    continue
                key = row[3]
                if self.status.get(key) != DONE:
                    self.status[key] = row[4]
                    self._places[key] = (number, place)
                    if row[-1] != "{}":
                        self.with_files.add(key)

    def records(self, keys: Sequence[str]) -> list[Record | None]:
        """The records of points; None where there is none.

        Parameters
        ----------
        keys : Sequence[str]
            Names of the points.

        Returns
        -------
        list[Record | None]
            Records in the order of the keys; None where there is none.
        """
        result: dict[str, Record | None] = {}
        for number, path in enumerate(self.paths):
            rows = {
                self._places[key][1]
                for key in keys
                if key in self._places and self._places[key][0] == number
            }
            if rows:
                result |= _chosen(path, sorted(rows))
        return [result.get(key) for key in keys]


def _chosen(path: Path, rows: list[int]) -> dict[str, Record | None]:
    """Records of some rows of a file, by their keys."""
    result: dict[str, Record | None] = {}
    with closing(_for_reading(path)) as file:
        for row in rows:
            with suppress(sqlite3.DatabaseError):
                line = file.execute(f"{SELECT} WHERE points.id = ?", (row,)).fetchone()
                if line is not None and (record := _record(line)) is not None:
                    result[record.key] = record
    return result


def read_batch(directory: str | Path) -> BatchResults:
    """Read the points of a finished batch with their summaries.

    Parameters
    ----------
    directory : str | Path
        Folder of the batch.

    Returns
    -------
    BatchResults
        The batch; a point whose file is missing or damaged has no summary.

    Raises
    ------
    ValueError
        If the folder holds no batch, or one whose points are too many to be listed.
    """
    folder = Path(directory)
    document = read_summary(folder)
    if document.get("kind") != "batch":
        allowed = "allowed: a directory of results of 'oilfilm batch'"
        raise ValueError(f"{folder} holds no results of a batch; {allowed}")
    if document["points"] is None:
        raise ValueError(
            f"{folder} holds {document['counts']['points']} points, which are read from its "
            "results.nc or points.sqlite"
        )
    stored = StoredPoints(store_files(folder))
    keys = [entry["key"] for entry in document["points"]]
    records = stored.records(keys)
    points = [_point(*both) for both in zip(document["points"], records, strict=True)]
    names = ("title", "case", "sweep")
    return BatchResults(
        version=document["oilfilm"],
        keys=tuple(document["keys"]),
        points=tuple(points),
        **{name: document[name] for name in names},
    )


def stored_summaries(directory: str | Path) -> Iterator[tuple[str, dict[str, Any]]]:
    """Name and summary of every finished point in the folder of a batch, one after the other.

    Parameters
    ----------
    directory : str | Path
        Folder of the batch.

    Yields
    ------
    Iterator[tuple[str, dict[str, Any]]]
        Name and summary of a point.
    """
    for path in store_files(Path(directory)):
        for _, record in whole_records(path):
            summary = None if record is None else summary_of(record)
            if record is not None and summary is not None:
                yield record.key, summary


def _point(entry: dict[str, Any], record: Record | None) -> BatchPoint:
    """A point from its entry in the summary of the batch, and its record."""
    return BatchPoint(
        number=entry["point"],
        block=entry["block"],
        values=entry["keys"],
        case={},
        key=entry["key"],
        resumed=entry["resumed"],
        status=entry["status"],
        message=entry["message"] or "",
        summary=None if record is None else summary_of(record),
    )
