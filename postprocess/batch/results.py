"""Results of a batch: every number of every point, as one table and one data set."""

import csv
import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np

from ehl.units import unit_of

from ..files import Variables, atomic_path, write_dataset
from ..main_results import main_results
from .points import BatchPoint, BatchResults
from .sensitivity import bands, sensitivities

BATCH_TABLE = "batch.csv"
NOT_NUMBERS = (
    *(
        "case",
        "oilfilm",
        "messages",
        "balls",
        "contacts",
        "stiffness",
        "points",
        "domain",
        "nodes",
        "surface",
    ),
    *("timing_s", "wall_s", "critical_curves", "minimum_preload"),  # times depend on the machine
)
MOST_COMPONENTS = 3
MOST_NAMED = 10  # points listed in a message
OUTSIDE = "outside loads or speeds of the tables"  # of a point's messages
STATES = ("done", "failed", "lost")


def batch_summary(results: BatchResults) -> dict[str, Any]:
    """The document of a batch: each point with its keys and main results; what failed has its
    message.
    """
    points = [
        {
            "point": point.number,
            "block": point.block,
            "keys": point.values,
            "status": point.status,
            "converged": point.converged,
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


def _messages(results: BatchResults) -> Iterable[str]:
    """Points without a result, and points of which something did not converge."""
    for point in results.points:
        if point.summary is None:
            yield f"point {point.number} ({point.label}): {point.status}: {point.message}"
        elif not point.converged:
            told = [
                m
                for m in point.summary.get("messages", ())
                if "not converged" in m or m.startswith("equilibrium")
            ]
            yield f"point {point.number} ({point.label}): not converged" + (
                f": {told[0]}" if told else ""
            )
    outside = [point.number for point in results.points if _is_outside(point)]
    if outside:
        named = ", ".join(map(str, outside[:MOST_NAMED])) + (
            " ..." if len(outside) > MOST_NAMED else ""
        )
        yield f"{len(outside)} points with contacts {OUTSIDE}, where the nearest place counts: {named}"


def _is_outside(point: BatchPoint) -> bool:
    """Whether contacts of a point lie outside its traction tables."""
    return any(OUTSIDE in message for message in (point.summary or {}).get("messages", ()))


def scalar_numbers(summary: dict[str, Any], path: str = "") -> dict[str, float]:
    """Every single number of a summary by its dotted path; components of short vectors as .x, .y,
    .z.
    """
    found: dict[str, float] = {}
    for key, value in summary.items():
        name = f"{path}.{key}" if path else key
        if key in NOT_NUMBERS:
            continue
        if isinstance(value, dict):
            found |= scalar_numbers(value, name)
        elif isinstance(value, bool | int | float):
            found[name] = value
        elif isinstance(value, list) and 0 < len(value) <= MOST_COMPONENTS:
            numbers = zip(_components(key, len(value)), value, strict=True)
            found |= {f"{name}.{axis}": v for axis, v in numbers if isinstance(v, int | float)}
    return found


def _components(key: str, count: int) -> tuple[str, ...]:
    """Names of the components of a short list: of a vector, a tilt, or the ends of a range."""
    if count == MOST_COMPONENTS:
        return ("x", "y", "z")
    return (("y", "z") if key.startswith(("tilt", "ring_moment")) else ("first", "last"))[:count]


def columns(results: BatchResults) -> dict[str, list[Any]]:
    """The batch as a table: one list of all points for each column; None where a point has no
    value.
    """
    main = [main_results(point.summary) for point in results.points]
    every = [scalar_numbers(point.summary or {}) for point in results.points]
    found: dict[str, list[Any]] = {
        "point": [point.number for point in results.points],
        "block": [point.block for point in results.points],
        "status": [point.status for point in results.points],
        "converged": [point.converged for point in results.points],
    }
    found |= {key: [point.values.get(key) for point in results.points] for key in results.keys}
    for table in (main, every):
        names = dict.fromkeys(name for row in table for name in row)
        found |= {name: [row.get(name) for row in table] for name in names if name not in found}
    return found


def write_batch_csv(results: BatchResults, path: Path) -> None:
    """Write one line for every point, units in the header, nothing for null."""
    table = columns(results)
    with atomic_path(path) as temporary, temporary.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        units = {name: _unit(name, values) for name, values in table.items()}
        writer.writerow([f"{name} [{unit}]" if unit else name for name, unit in units.items()])
        for row in zip(*table.values(), strict=True):
            writer.writerow(["" if value is None else _cell(value) for value in row])


def _unit(name: str, values: Iterable[Any]) -> str:
    """Unit of a column; words and truth values have none."""
    known = [value for value in values if value is not None]
    return "" if known and all(isinstance(value, bool | str) for value in known) else unit_of(name)


def _cell(value: Any) -> Any:
    return json.dumps(value) if isinstance(value, list | dict) else value


def write_batch_netcdf(results: BatchResults, path: Path) -> None:
    """Write the data set: what the table has over `point`, and the numbers of balls and contacts
    over ball and race.

    Units are attributes, the input of every point is the variable `case`; NaN where a point has no
    value.
    """
    variables: Variables = {}
    # netCDF lists them with spaces between
    coordinates = {"point", *(key for key in results.keys if " " not in key)}
    for name, values in columns(results).items():
        unit = _unit(name, values)
        variables[name] = (("point",), _array(values), {"units": unit} if unit else {})
    variables["message"] = (("point",), _array([point.message for point in results.points]), {})
    variables["case"] = (
        ("point",),
        _array([json.dumps(point.case, ensure_ascii=False) for point in results.points]),
        {"long_name": "input as run, JSON"},
    )
    variables |= _per_ball(results) | _per_contact(results)
    attributes = {
        "title": results.title,
        "oilfilm": results.version,
        "kind": "batch",
        "case": results.case,
        "sweep": results.sweep,
        "keys": json.dumps(results.keys),
        "converged": int(results.converged),
    }
    write_dataset(variables, coordinates | {"ball", "race"}, attributes, path)


def _attributes(name: str) -> dict[str, str]:
    unit = unit_of(name)
    return {"units": unit} if unit else {}


def _array(values: list[Any]) -> np.ndarray[Any, Any]:
    """Numbers as floats with NaN for None, truth values as bytes, everything else as text."""
    known = [value for value in values if value is not None]
    if known and all(isinstance(value, bool) for value in values):
        return np.array(values, dtype=np.int8)
    if known and all(isinstance(value, int) and not isinstance(value, bool) for value in values):
        return np.array(values, dtype=np.int64)
    if all(isinstance(value, int | float) for value in known):
        return np.array([np.nan if value is None else float(value) for value in values])
    return np.array(["" if value is None else str(_cell(value)) for value in values], dtype=object)


def _per_ball(results: BatchResults) -> Variables:
    """Numbers of the balls over point and ball."""
    rows = [(point.summary or {}).get("balls") or [] for point in results.points]
    names = [n for n in _number_names(ball for row in rows for ball in row) if n != "ball"]
    count = max(map(len, rows), default=0)
    if not names:
        return {}
    values = {name: np.full((len(rows), count), np.nan) for name in names}
    for i, row in enumerate(rows):
        for k, ball in enumerate(row):
            for name in names:
                values[name][i, k] = _number(ball.get(name))
    found: Variables = {"ball": (("ball",), np.arange(1, count + 1), {})}
    return found | {f"ball.{n}": (("point", "ball"), v, _attributes(n)) for n, v in values.items()}


def _per_contact(results: BatchResults) -> Variables:
    """Numbers of the contacts over point, ball and race."""
    rows = [(point.summary or {}).get("contacts") or [] for point in results.points]
    names = [
        n
        for n in _number_names(contact for row in rows for contact in row)
        if n not in ("ball", "azimuth_deg")
    ]
    count = max((contact["ball"] for row in rows for contact in row), default=0)
    if not names:
        return {}
    races = ("inner", "outer")
    values = {name: np.full((len(rows), count, 2), np.nan) for name in names}
    for i, row in enumerate(rows):
        for contact in row:
            place = i, contact["ball"] - 1, races.index(contact["race"])
            for name in names:
                values[name][place] = _number(contact.get(name))
    found: Variables = {"race": (("race",), np.array(races, dtype=object), {})}
    return found | {
        f"contact.{n}": (("point", "ball", "race"), v, _attributes(n)) for n, v in values.items()
    }


def _number_names(rows: Iterable[dict[str, Any]]) -> list[str]:
    """Keys that hold a number or null in every row, in their order."""
    names: dict[str, bool] = {}
    for row in rows:
        for key, value in row.items():
            names[key] = names.get(key, True) and (
                value is None or isinstance(value, bool | int | float)
            )
    return [name for name, numeric in names.items() if numeric and name != "note"]


def _number(value: Any) -> float:
    return float(value) if isinstance(value, bool | int | float) else np.nan
