"""A finished batch, read back from its folder."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from ..files import read_summary
from .records import Record, summary_of
from .results import BatchPoint, BatchResults
from .store import StoredPoints, store_files, whole_records


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
    keys = [entry.get("key") or Path(entry["file"]).stem for entry in document["points"]]
    records = stored.records(keys)
    points = [
        _point(folder, *both) for both in zip(document["points"], keys, records, strict=True)
    ]
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


def _point(folder: Path, entry: dict[str, Any], key: str, record: Record | None) -> BatchPoint:
    """A point from its entry in the summary of the batch, and its record; batches of version 0.1
    before the records have a file for each point.
    """
    own = None if record is None else summary_of(record)
    return BatchPoint(
        number=entry["point"],
        block=entry["block"],
        values=entry["keys"],
        case={},
        key=key,
        resumed=entry["resumed"],
        status=entry["status"],
        message=entry["message"] or "",
        summary=_own_summary(folder / entry["file"]) if own is None and entry["file"] else own,
    )


def _own_summary(file: Path) -> dict[str, Any] | None:
    try:
        record = json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        return None
    return record.get("summary") if isinstance(record, dict) else None
