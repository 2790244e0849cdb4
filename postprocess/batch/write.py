"""Files of a batch: every number of every point, as one table and one data set."""

import json
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import numpy as np

from ehl.units import unit_of

from ..files import write_csv
from ..netcdf.groups import Variables, write_dataset
from .results import BatchResults
from .summary import results_as_columns

RACES = ("inner", "outer")


def write_batch_csv(results: BatchResults, path: Path) -> None:
    """Write one line for every point, units in the header, nothing for null."""
    table = results_as_columns(results)
    units = {name: _unit(name, values) for name, values in table.items()}
    header = [f"{name} [{unit}]" if unit else name for name, unit in units.items()]
    write_csv(path, header, zip(*table.values(), strict=True))


def _unit(name: str, values: Iterable[Any]) -> str:
    """Unit of a column; words and truth values have none."""
    known = [value for value in values if value is not None]
    return "" if known and all(isinstance(value, bool | str) for value in known) else unit_of(name)


def write_batch_netcdf(results: BatchResults, path: Path) -> None:
    """Write the table's columns over `point`, numbers of balls and contacts over ball and race.

    Units are attributes, the input of every point is the variable `case`; NaN for no value.
    """
    variables: Variables = {}
    # netCDF lists them with spaces between
    coordinates = [key for key in results.keys if " " not in key]
    for name, values in results_as_columns(results).items():
        unit = _unit(name, values)
        variables[name] = (("point",), _array(values), {"units": unit} if unit else {})
    messages = [point.message for point in results.points]
    cases = [json.dumps(point.case, ensure_ascii=False) for point in results.points]
    variables["message"] = (("point",), _array(messages), {})
    variables["case"] = (("point",), _array(cases), {"long_name": "input as run, JSON"})
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
    write_dataset(variables, attributes, path, coordinates)


def _array(values: list[Any]) -> np.ndarray[Any, Any]:
    """Numbers as floats with NaN for None, truth values as bytes, everything else as text."""
    known = [value for value in values if value is not None]
    if known and all(isinstance(value, bool) for value in values):
        return np.array(values, dtype=np.int8)
    if known and all(isinstance(value, int) and not isinstance(value, bool) for value in values):
        return np.array(values, dtype=np.int64)
    if all(isinstance(value, int | float) for value in known):
        return np.array([np.nan if value is None else float(value) for value in values])
    return np.array([_text(value) for value in values], dtype=object)


def _text(value: Any) -> str:
    if value is None:
        return ""
    return json.dumps(value) if isinstance(value, list | dict) else str(value)


def _per_ball(results: BatchResults) -> Variables:
    """Numbers of the balls over point and ball."""
    rows = [(point.summary or {}).get("balls") or [] for point in results.points]
    count = max(map(len, rows), default=0)
    values = _filled(rows, (len(rows), count), {"ball"}, lambda ball: (ball["ball"] - 1,))
    balls: Variables = {"ball": (("ball",), np.arange(1, count + 1), {})} if values else {}
    return balls | _named("ball", ("point", "ball"), values)


def _per_contact(results: BatchResults) -> Variables:
    """Numbers of the contacts over point, ball and race."""
    rows = [(point.summary or {}).get("contacts") or [] for point in results.points]
    count = max((contact["ball"] for row in rows for contact in row), default=0)
    values = _filled(
        rows,
        (len(rows), count, 2),
        {"ball", "azimuth_deg"},
        lambda contact: (contact["ball"] - 1, RACES.index(contact["race"])),
    )
    races: Variables = {"race": (("race",), np.array(RACES, dtype=object), {})} if values else {}
    return races | _named("contact", ("point", "ball", "race"), values)


def _filled(
    rows: list[list[dict[str, Any]]],
    shape: tuple[int, ...],
    left_out: set[str],
    place: Callable[[dict[str, Any]], tuple[int, ...]],
) -> dict[str, Any]:
    """An array for each key of numbers, NaN where a point has no value."""
    names = _number_names(entry for row in rows for entry in row)
    values = {name: np.full(shape, np.nan) for name in names if name not in left_out}
    for i, row in enumerate(rows):
        for entry in row:
            for name, array in values.items():
                array[(i, *place(entry))] = _number(entry.get(name))
    return values


def _named(part: str, over: tuple[str, ...], values: dict[str, Any]) -> Variables:
    """Variables of a part of the bearing, with their units."""
    units = {name: {"units": unit_of(name)} if unit_of(name) else {} for name in values}
    return {f"{part}.{name}": (over, value, units[name]) for name, value in values.items()}


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
