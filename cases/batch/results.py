"""The finished points of a batch, gathered, and the files made of them."""

import pickle
import tempfile
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from functools import lru_cache
from io import BytesIO
from itertools import islice
from pathlib import Path
from types import MappingProxyType
from typing import IO, Any, TypeVar

from oilfilm.ehl.foreign_files import parse_json
from oilfilm.postprocess.batch.packed_columns import CHUNK, Columns, InMemory, Row, columns_of
from oilfilm.postprocess.batch.results import BatchPoint, BatchResults, Counts
from oilfilm.postprocess.batch.store import (
    DONE,
    FAILED,
    LOST,
    Record,
    StoredPoints,
    layout_names,
    store_files,
    summary_of,
)
from oilfilm.postprocess.batch.summary import batch_summary
from oilfilm.postprocess.batch.write import write_batch_csv, write_batch_netcdf
from oilfilm.postprocess.files import write_json

from ..runs.output_directory import write_digests
from .compute import document_of
from .engine import Batch
from .keys import DATA, POINTS, SUMMARY, TABLE, value_in
from .points import Point
from .sweep import Shard

LARGE = 10_000  # points from which on a batch is not held in memory: 1 GB of summaries
MOST_LINES = 100_000  # of batch.csv where it is not asked for
T = TypeVar("T")
MISSING = "missing"  # status of a point that no record tells of
NO_RECORD = "not computed yet, or its record is damaged; --resume computes it"

Writer = Callable[[Columns, Path], None]


class Stored:
    """The points of a batch, read from its folder; rows once, and then from `file`."""

    def __init__(self, batch: Batch, file: IO[bytes] | None = None) -> None:
        self.batch = batch
        self.keys = batch.sweep.keys
        self.points = StoredPoints(store_files(batch.directory))
        self.file = file
        self._written = False

    def __len__(self) -> int:
        return len(self.batch.sweep.points)

    def pairs(self, only: Sequence[int] | None = None) -> Iterator[list[tuple[Point, Record]]]:
        """Points with their records, `CHUNK` at a time.

        Parameters
        ----------
        only : Sequence[int] | None, optional
            Indices of the points to read, from 0; None: all.

        Yields
        ------
        Iterator[list[tuple[Point, Record]]]
            Lists of pairs.
        """
        points = self.batch.sweep.points
        wanted = iter(points) if only is None else (points[index] for index in only)
        for chunk in batched(wanted, CHUNK):
            records = self.points.records([point.key for point in chunk])
            yield [
                (point, record or Record(key=point.key, status=MISSING, message=NO_RECORD))
                for point, record in zip(chunk, records, strict=True)
            ]

    def chunks(self) -> Iterator[Sequence[Row]]:
        """Rows of all points."""
        if self.file is not None and self._written:
            self.file.seek(0)
            for _ in range(0, len(self), CHUNK):
                yield pickle.load(self.file)
            return
        for pairs in self.pairs():
            rows = self._rows(pairs)
            if self.file is not None:
                pickle.dump(rows, self.file, pickle.HIGHEST_PROTOCOL)
            yield rows
        self._written = True

    def _rows(self, pairs: list[tuple[Point, Record]]) -> list[Row]:
        return [
            Row(
                number=point.number,
                block=point.block,
                status=record.status,
                message=record.message,
                converged=_converged(record),
                values=_values(point, record),
                layout=record.layout,
                numbers=record.numbers,
            )
            for point, record in pairs
        ]


def _converged(record: Record) -> bool:
    """Tell whether a point was computed and everything in it converged."""
    if record.status != DONE:
        return False
    count = len(record.numbers) // 9
    index = count + 8 * _converged_index(record.layout)
    return record.numbers[index : index + 8] != bytes(8)


@lru_cache(maxsize=1024)
def _converged_index(layout: str) -> int:
    """Index of `converged` among the numbers of a point."""
    main, others = layout_names(layout)
    return [*main, *others].index("converged")


def _values(point: Point, record: Record) -> dict[str, Any]:
    """Values of the varied keys: as run where that is known, else as given."""
    run = parse_json(record.values, f"record of {record.key}")
    if all(key in run for key in point.keys):
        return {key: run[key] for key in point.keys}
    summary = summary_of(record, document_of)
    document = point.document if summary is None else summary["case"]
    return {key: value_in(document, key) for key in point.keys}


def load_results(batch: Batch, only: Sequence[int] | None = None) -> BatchResults:
    """Read the points of a batch with their summaries, in the order of the sweep file.

    Parameters
    ----------
    batch : Batch
        The finished batch.
    only : Sequence[int] | None, optional
        Indices of the points to read, from 0; None: all.

    Returns
    -------
    BatchResults
        Results with these points.
    """
    points = [
        _in_memory(batch, point, record)
        for pairs in Stored(batch).pairs(only)
        for point, record in pairs
    ]
    sweep = batch.sweep
    same = ("title", "case", "keys", "messages", "assumed", "plot", "designs")
    return BatchResults(
        sweep=sweep.text,
        points=tuple(points),
        timing={"total": batch.wall},
        with_json=any((batch.directory / POINTS).glob("*.json")),
        **{name: getattr(sweep, name) for name in same},
    )


def _in_memory(batch: Batch, point: Point, record: Record) -> BatchPoint:
    summary = summary_of(record, document_of)
    return BatchPoint(
        number=point.number,
        block=point.block,
        values=_values(point, record),
        case=point.document if summary is None else summary["case"],
        key=point.key,
        resumed=point.key in batch.resumed,
        status=record.status,
        message=record.message,
        summary=summary,
    )


@contextmanager
def collect_results(batch: Batch) -> Iterator[tuple[BatchResults, Columns]]:
    """Open the results of a batch and the columns of all its points, valid inside the context.

    Of a batch of more than `LARGE` points the results have only the counts, and the points of
    [sensitivity], which are few.

    Parameters
    ----------
    batch : Batch
        The finished batch.

    Yields
    ------
    Iterator[tuple[BatchResults, Columns]]
        Results, and columns of all points.
    """
    if len(batch.sweep.points) <= LARGE:
        yield load_results(batch), columns_of(Stored(batch, BytesIO()))
        return
    with tempfile.TemporaryFile(dir=batch.directory) as file:
        tally = _Tally(Stored(batch, file))
        columns = columns_of(tally)
        results = replace(load_results(batch, tally.few), counts=tally.counts(batch))
        yield results, replace(columns, source=tally.stored)


class _Tally:
    """Points that are counted while they pass."""

    def __init__(self, stored: Stored) -> None:
        self.stored = stored
        self.keys = stored.keys
        self.status: Counter[str] = Counter()
        self.reasons: Counter[str] = Counter()
        self.converged = 0
        self.few: list[int] = []  # places of points of [sensitivity]

    def __len__(self) -> int:
        return len(self.stored)

    def chunks(self) -> Iterator[Sequence[Row]]:
        """Rows of all points, once."""
        for rows in self.stored.chunks():
            self.status.update(row.status for row in rows)
            self.reasons.update(row.message for row in rows if row.status != DONE)
            self.converged += sum(row.converged for row in rows)
            self.few += [row.number - 1 for row in rows if row.block == "sensitivity"]
            yield rows

    def counts(self, batch: Batch) -> Counts:
        """How the points ended."""
        return Counts(
            points=len(self),
            done=self.status[DONE],
            failed=self.status[FAILED],
            lost=self.status[LOST],
            missing=self.status[MISSING],
            converged=self.converged,
            resumed=min(len(batch.resumed), self.status[DONE]),
            reasons=tuple(self.reasons.most_common(10)),
        )


def shard_counts(batch: Batch, shard: Shard) -> dict[str, int]:
    """Count the points of a shard by their status.

    Parameters
    ----------
    batch : Batch
        The batch.
    shard : Shard
        The shard.

    Returns
    -------
    dict[str, int]
        Number of points by the words of a batch's summary [-].
    """
    stored = StoredPoints(store_files(batch.directory))
    counts = dict.fromkeys(("points", "done", "converged", "failed", "lost", "missing"), 0)
    keys = {point.key: None for point in batch.sweep.points if shard.has(point.key)}
    for chunk in batched(keys, CHUNK):
        for record in stored.records(chunk):
            counts["points"] += 1
            counts["missing" if record is None else record.status] += 1
            counts["converged"] += record is not None and _converged(record)
    return counts


def batched(things: Iterable[T], size: int) -> Iterator[list[T]]:
    """Split things into lists of limited size.

    Parameters
    ----------
    things : Iterable[T]
        The things, in their order.
    size : int
        Things of a list at most [-].

    Yields
    ------
    Iterator[list[T]]
        One list after the other.
    """
    left = iter(things)
    while chunk := list(islice(left, size)):
        yield chunk


def write_batch(
    results: BatchResults,
    directory: Path,
    columns: Columns | None = None,
    others: Mapping[str, Writer] = MappingProxyType({}),
    *,
    table: bool = True,
) -> dict[str, Any]:
    """Write the table, the data set and, last, the summary of a batch.

    Parameters
    ----------
    results : BatchResults
        Results of the batch.
    directory : Path
        Folder of the batch.
    columns : Columns | None, optional
        Columns of all points; made of `results` if left out.
    others : Mapping[str, Writer], default MappingProxyType({})
        Writers of further files by their names.
    table : bool, default True
        True: also the CSV file.

    Returns
    -------
    dict[str, Any]
        The summary.
    """
    columns = columns or columns_of(InMemory(results))
    writers = ({TABLE: write_batch_csv} if table else {}) | dict(others)
    if not table:
        (directory / TABLE).unlink(missing_ok=True)
    for name, write in writers.items():
        write(columns, directory / name)
    whole = results.counts is None
    write_batch_netcdf(columns, directory / DATA, results, whole=whole, points=directory / POINTS)
    document = batch_summary(results, columns)
    write_json(document, directory / SUMMARY)
    write_digests(directory, [*writers, DATA, SUMMARY])
    return document
