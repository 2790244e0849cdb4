"""Bearings by name, as the keys of a case file's [bearing] table."""

import tomllib
import warnings
from collections.abc import Collection, Mapping
from functools import cache
from importlib import resources
from typing import Any

from .names import matching_name

PUBLISHED = "bearings.toml"
ESTIMATED = "estimated_bearings.toml"
SAME = 1e-9  # relative difference of a case's value from the catalogue's that counts as none [-]


def list_bearings() -> tuple[str, ...]:
    """Names of the catalogue, in the order of the data files."""
    return (*_table(PUBLISHED), *_table(ESTIMATED))


def published_bearings() -> tuple[str, ...]:
    """Names of the bearings whose ball, number of balls and pitch diameter come from a
    publication.
    """
    return tuple(_table(PUBLISHED))


def load_catalogue_entry(name: str) -> dict[str, Any]:
    """Keys of a case file's [bearing] table for a catalogue bearing; each name ends in its unit
    ([mm], [um], [deg]).

    Parameters
    ----------
    name : str
        One of `list_bearings()`; case, spaces and hyphens do not matter.

    Returns
    -------
    dict
        Keys and values as in a case file, with `source` (text), `estimated` (keys whose values are
        estimates) and `range` (an interval for each of these).

    Raises
    ------
    ValueError
        If there is none of this name.
    """
    key = matching_name(name, list_bearings())
    if key is None:
        raise ValueError(f"bearing {name!r} is unknown; known: {', '.join(list_bearings())}")
    entry = _table(PUBLISHED).get(key) or _table(ESTIMATED)[key]
    return {"name": key, **entry}


def warn_of_estimates(name: str, values: Mapping[str, Any], assumed: Collection[str] = ()) -> None:
    """Warn of each value of a case that is the catalogue's estimate, with its range.

    Parameters
    ----------
    name : str
        Name of the bearing; nothing happens if the catalogue has none of this name.
    values : mapping
        Keys and values of the case's [bearing] table, filled in from the catalogue.
    assumed : collection of str
        Keys that the case itself says are assumed.

    Warns
    -----
    UserWarning
        One for the bearing, if any of its values is an estimate.
    """
    key = matching_name(name, list_bearings())
    if key is None:
        return
    entry = load_catalogue_entry(key)
    found = []
    for field in entry["estimated"]:
        value = values.get(field)
        if (
            value is None
            or field in assumed
            or abs(value - entry[field]) > SAME * abs(entry[field])
        ):
            continue
        (low, high), (text, unit) = entry["range"][field], _words(field)
        found.append(f"{text} {value:g}{unit} ({low:g} to {high:g})")
    if found:
        warnings.warn(
            f"bearing {key!r}: internal geometry is estimated: {', '.join(found)}", stacklevel=2
        )


def _words(field: str) -> tuple[str, str]:
    """A key as words and its unit: 'ball_diameter_mm' is 'ball diameter' and ' mm'."""
    words, _, last = field.rpartition("_")
    return (words.replace("_", " "), f" {last}") if last in ("mm", "um", "deg") else (field, "")


@cache
def _table(file: str) -> dict[str, dict[str, Any]]:
    text = resources.files(__package__).joinpath("data", file).read_text(encoding="utf-8")
    return tomllib.loads(text)
