"""Bearings by name, as the keys of a case file's [bearing] table."""

import warnings
from collections.abc import Collection, Mapping
from math import isclose
from typing import Any

from .names import library_data, matching_name

PUBLISHED = "bearings.toml"
ESTIMATED = "estimated_bearings.toml"


def list_bearings() -> tuple[str, ...]:
    """Names of the catalogue, in the order of the data files."""
    return (*library_data(PUBLISHED), *library_data(ESTIMATED))


def published_bearings() -> tuple[str, ...]:
    """Bearings whose ball, number of balls and pitch diameter are published."""
    return tuple(library_data(PUBLISHED))


def load_catalogue_entry(name: str) -> dict[str, Any]:
    """Keys of a case file's [bearing] table for one of `list_bearings()`, with `source` (text),
    `estimated` (keys whose values are estimates) and `range` (an interval for each of these).

    Case, spaces and hyphens of the name do not matter; ValueError if there is none of this name.
    """
    key = matching_name(name, list_bearings())
    if key is None:
        raise ValueError(f"bearing {name!r} is unknown; known: {', '.join(list_bearings())}")
    entry = library_data(PUBLISHED).get(key) or library_data(ESTIMATED)[key]
    return {"name": key, **entry}


def warn_of_estimates(name: str, values: Mapping[str, Any], assumed: Collection[str] = ()) -> None:
    """Warn once of all values of a case that are the catalogue's estimates, with their ranges.

    `name`: of the bearing, in the catalogue or not; `values`: of the case's [bearing] table,
    filled in from the catalogue; `assumed`: keys that the case itself says are assumed.
    """
    key = matching_name(name, list_bearings())
    if key is None:
        return
    entry = load_catalogue_entry(key)
    estimates = []
    for field in entry["estimated"]:
        value = values.get(field)
        if value is None or field in assumed or not isclose(value, entry[field]):
            continue
        low, high = entry["range"][field]
        text, unit = _words(field)
        estimates.append(f"{text} {value:g}{unit} ({low:g} to {high:g})")
    if estimates:
        text = f"bearing {key!r}: internal geometry is estimated: {', '.join(estimates)}"
        warnings.warn(text, stacklevel=2)


def _words(field: str) -> tuple[str, str]:
    """A key as words and its unit: 'ball_diameter_mm' is 'ball diameter' and ' mm'."""
    words, _, last = field.rpartition("_")
    return (words.replace("_", " "), f" {last}") if last in ("mm", "um", "deg") else (field, "")
