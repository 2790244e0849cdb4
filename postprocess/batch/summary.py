"""Summary of a batch, and every number of its points as columns."""

from collections.abc import Iterator
from typing import Any

from ..main_results import main_results
from .results import BatchPoint, BatchResults
from .sensitivity import bands, sensitivities

NOT_NUMBERS = frozenset(
    "case oilfilm messages balls contacts stiffness points domain nodes surface "
    # times depend on the machine
    "timing_s wall_s critical_curves minimum_preload".split()
)
# of a point: name in the summary and in the table, attribute
STATE = {"point": "number", "block": "block", "status": "status", "converged": "converged"}
MOST_COMPONENTS = 3  # of a vector, each a column
MOST_NAMED = 10  # points listed in a message
OUTSIDE = "outside loads or speeds of the tables"  # of a point's messages


def batch_summary(results: BatchResults) -> dict[str, Any]:
    """The document of a batch: each point with its keys and main results, or its message."""
    points = [
        {name: getattr(point, attribute) for name, attribute in STATE.items()}
        | {
            "keys": point.values,
            "resumed": point.resumed,
            "message": point.message or None,
            **main_results(point.summary),
            "file": f"points/{point.key}.json",
        }
        for point in results.points
    ]
    return {
        "oilfilm": results.version,
        "kind": "batch",
        "title": results.title,
        "case": results.case,
        "sweep": results.sweep,
        "assumed": list(results.assumed),
        "converged": results.converged,
        "messages": [*results.messages, *_messages(results)],
        "keys": list(results.keys),
        "points": points,
        "sensitivity": sensitivities(results),
        "bands": bands(results),
        "resumed": sum(point.resumed for point in results.points),
        "failed": sum(point.summary is None for point in results.points),
        "timing_s": results.timing,
    }


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
    """Whether contacts of a point lie outside its traction tables."""
    return any(OUTSIDE in message for message in (point.summary or {}).get("messages", ()))


def scalar_numbers(summary: dict[str, Any], path: str = "") -> dict[str, float]:
    """Every single number of a summary by its dotted path; parts of vectors as .x, .y, .z."""
    numbers: dict[str, float] = {}
    for key, value in summary.items():
        name = f"{path}.{key}" if path else key
        if key in NOT_NUMBERS:
            continue
        if isinstance(value, dict):
            numbers |= scalar_numbers(value, name)
        elif isinstance(value, bool | int | float):
            numbers[name] = value
        elif isinstance(value, list) and 0 < len(value) <= MOST_COMPONENTS:
            parts = zip(components(key, len(value)), value, strict=True)
            numbers |= {f"{name}.{axis}": v for axis, v in parts if isinstance(v, int | float)}
    return numbers


def point_numbers(point: BatchPoint) -> dict[str, Any]:
    """Every single number of a point by the name that it has in the table of the batch."""
    return scalar_numbers(point.summary or {}) | main_results(point.summary)


def components(key: str, count: int) -> tuple[str, ...]:
    """Names of the components of a short list: of a vector, a tilt, or the ends of a range."""
    if count == MOST_COMPONENTS:
        return ("x", "y", "z")
    return (("y", "z") if key.startswith(("tilt", "ring_moment")) else ("first", "last"))[:count]


def results_as_columns(results: BatchResults) -> dict[str, list[Any]]:
    """A list of all points for each column of the batch; None where a point has no value."""
    main = [main_results(point.summary) for point in results.points]
    every = [scalar_numbers(point.summary or {}) for point in results.points]
    columns: dict[str, list[Any]] = {
        name: [getattr(point, attribute) for point in results.points]
        for name, attribute in STATE.items()
    }
    columns |= {key: [point.values.get(key) for point in results.points] for key in results.keys}
    for table in (main, every):
        names = dict.fromkeys(name for row in table for name in row)
        columns |= {
            name: [row.get(name) for row in table] for name in names if name not in columns
        }
    return columns
