"""Summary of a batch, and every number of its points as columns."""

from collections.abc import Iterator
from typing import Any

from .columns import Columns, InMemory, columns_of
from .indices import design_documents
from .main_results import main_results
from .numbers import scalar_numbers
from .records import FAILED, LOST
from .results import BatchPoint, BatchResults, Counts
from .sensitivity import bands, sensitivities

# state of a point: name in the summary and in the table, attribute
STATE = {"point": "number", "block": "block", "status": "status", "converged": "converged"}
COUNTS = ("points", "done", "failed", "lost", "missing", "converged")
MOST_NAMED = 10  # points listed in a message
OUTSIDE = "outside loads or speeds of the tables"  # of a point's messages


def batch_summary(results: BatchResults, columns: Columns | None = None) -> dict[str, Any]:
    """The document of a batch: each point with its keys and main results, or its message.

    Of a batch too large to list, `points` is null.

    Parameters
    ----------
    results : BatchResults
        Results of the batch.
    columns : Columns | None, optional
        Numbers of all points; computed from `results` if None.

    Returns
    -------
    dict[str, Any]
        The document.
    """
    columns = columns or columns_of(InMemory(results))
    counts = results.counts or counts_of(results)
    whole = results.counts is None
    points = [_entry(results, point) for point in results.points] if whole else None
    return {
        "oilfilm": results.version,
        "kind": "batch",
        "title": results.title,
        "case": results.case,
        "sweep": results.sweep,
        "assumed": list(results.assumed),
        "converged": results.converged,
        "messages": [*results.messages, *(_messages(results) if whole else _counted(counts))],
        "keys": list(results.keys),
        "points": points,
        "counts": {name: getattr(counts, name) for name in COUNTS},
        "sensitivity": sensitivities(results),
        "bands": bands(columns),
        **design_documents(columns, results.designs),
        "resumed": counts.resumed,
        "failed": counts.failed + counts.lost + counts.missing,
        "timing_s": results.timing,
    }


def _entry(results: BatchResults, point: BatchPoint) -> dict[str, Any]:
    """A point in the list of the summary."""
    return {name: getattr(point, attribute) for name, attribute in STATE.items()} | {
        "keys": point.values,
        "resumed": point.resumed,
        "message": point.message or None,
        **main_results(point.summary),
        "key": point.key,
        "file": f"points/{point.key}.json" if results.with_json else None,
    }


def counts_of(results: BatchResults) -> Counts:
    """How the points of results in memory ended.

    Parameters
    ----------
    results : BatchResults
        Results of the batch.

    Returns
    -------
    Counts
        Numbers of points by their end.
    """
    points = results.points
    done = sum(point.summary is not None for point in points)
    failed, lost = (sum(point.status == own for point in points) for own in (FAILED, LOST))
    return Counts(
        points=len(points),
        done=done,
        failed=failed,
        lost=lost,
        missing=len(points) - done - failed - lost,
        converged=sum(point.converged for point in points),
        resumed=sum(point.resumed for point in points),
    )


def _counted(counts: Counts) -> Iterator[str]:
    """Messages of a batch whose points are too many to be listed."""
    yield f"points: null, {counts.points} points are listed in the other files only"
    off = counts.done - counts.converged
    if off:
        yield f"{off} of {counts.points} points not converged; column converged of the table"
    for message, number in counts.reasons[:MOST_NAMED]:
        yield f"{number} points without a result, as: {message}"


def _messages(results: BatchResults) -> Iterator[str]:
    """Points without a result, and points of which something did not converge."""
    for point in results.points:
        if point.summary is None:
            yield f"point {point.number} ({point.label}): {point.status}: {point.message}"
        elif not point.converged:
            reasons = [
                f": {message}"
                for message in point.summary.get("messages", ())
                if "not converged" in message or message.startswith("equilibrium")
            ]
            yield f"point {point.number} ({point.label}): not converged{''.join(reasons[:1])}"
    outside = [str(point.number) for point in results.points if _is_outside(point)]
    if outside:
        named = ", ".join(outside[:MOST_NAMED]) + (" ..." if len(outside) > MOST_NAMED else "")
        where = "where the nearest place counts"
        yield f"{len(outside)} points with contacts {OUTSIDE}, {where}: {named}"


def _is_outside(point: BatchPoint) -> bool:
    """True if contacts of a point lie outside its traction tables."""
    return any(OUTSIDE in message for message in (point.summary or {}).get("messages", ()))


def point_numbers(point: BatchPoint) -> dict[str, Any]:
    """Every single number of a point by the name that it has in the table of the batch.

    Parameters
    ----------
    point : BatchPoint
        Point of a batch.

    Returns
    -------
    dict[str, Any]
        Numbers by name.
    """
    return scalar_numbers(point.summary or {}) | main_results(point.summary)
