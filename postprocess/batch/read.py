"""A finished batch, read back from its folder."""

import json
from pathlib import Path
from typing import Any

from ..files import read_summary
from .results import BatchPoint, BatchResults


def read_batch(directory: str | Path) -> BatchResults:
    """The points of a finished batch with their summaries; ValueError if the folder holds none.

    A point whose file is missing or damaged has no summary.
    """
    folder = Path(directory)
    document = read_summary(folder)
    if document.get("kind") != "batch":
        allowed = "allowed: a directory of results of 'oilfilm batch'"
        raise ValueError(f"{folder} holds no results of a batch; {allowed}")
    points = [_point(folder, entry) for entry in document["points"]]
    names = ("title", "case", "sweep")
    return BatchResults(
        version=document["oilfilm"],
        keys=tuple(document["keys"]),
        points=tuple(points),
        **{name: document[name] for name in names},
    )


def _point(folder: Path, entry: dict[str, Any]) -> BatchPoint:
    """A point from its entry in the summary of the batch, and its own file."""
    file = folder / entry["file"]
    return BatchPoint(
        number=entry["point"],
        block=entry["block"],
        values=entry["keys"],
        case={},
        key=file.stem,
        resumed=entry["resumed"],
        status=entry["status"],
        message=entry["message"] or "",
        summary=_own_summary(file),
    )


def _own_summary(file: Path) -> dict[str, Any] | None:
    try:
        record = json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        return None
    return record.get("summary") if isinstance(record, dict) else None
