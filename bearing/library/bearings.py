"""Bearings by name, as the keys of a case file's [bearing] table."""

import warnings
from collections.abc import Collection, Mapping
from functools import cache
from math import isclose
from typing import Any

from .catalogue import (
    catalogue_entry,
    estimated_bearings,
    known_designation,
    with_clearance,
    with_designation,
)
from .designation import SERIES, Designation, why_unknown
from .names import library_data, matching_name, plain_name

PUBLISHED = "bearings.toml"


@cache
def list_bearings() -> tuple[str, ...]:
    """Names of the catalogue: published geometries first, then estimated ones by series.

    Returns
    -------
    tuple[str, ...]
        names for `load_catalogue_entry`

    Examples
    --------
    >>> from bearing import list_bearings
    >>> "6208" in list_bearings()
    True
    """
    published = published_bearings()
    plain = {plain_name(name) for name in published}
    others = (name for name in estimated_bearings() if plain_name(name) not in plain)
    return (*published, *others)


def published_bearings() -> tuple[str, ...]:
    """Bearings whose ball, number of balls and pitch diameter are published.

    Returns
    -------
    tuple[str, ...]
        their names, in the order of the data file
    """
    return tuple(library_data(PUBLISHED))


def catalogue_name(name: str) -> str | None:
    """Name under which a case shows a bearing of the catalogue.

    Case, spaces and hyphens do not matter; '6205-2RS C3' and '7014 CD/P4A' are understood.

    Parameters
    ----------
    name : str
        name or designation of a bearing

    Returns
    -------
    str | None
        name of `list_bearings()`, or a designation with suffixes as it was written; None if there
        is no such bearing
    """
    key = matching_name(name, list_bearings())
    if key is not None:
        return key
    return " ".join(name.split()) if known_designation(name) else None


def named_designation(name: str) -> Designation | None:
    """Designation of a bearing of the catalogue.

    Parameters
    ----------
    name : str
        name or designation of a bearing

    Returns
    -------
    Designation | None
        its parts; None if the name is no designation
    """
    return known_designation(name)


def load_catalogue_entry(name: str) -> dict[str, Any]:
    """Keys of a case file's [bearing] table for a bearing of the catalogue.

    Parameters
    ----------
    name : str
        a name that `catalogue_name` knows

    Returns
    -------
    dict[str, Any]
        keys and values, with `source` (text), `estimated` (keys whose values are estimates) and
        `range` (an interval for each of these)

    Raises
    ------
    ValueError
        if no bearing has this name

    Examples
    --------
    >>> from bearing import load_catalogue_entry
    >>> entry = load_catalogue_entry("6208")
    >>> entry["ball_diameter_mm"], entry["balls"]
    (12.0, 9)
    >>> entry["estimated"]
    ['diametral_clearance_um']
    """
    shown = catalogue_name(name)
    if shown is None:
        why = why_unknown(name)
        raise ValueError(
            f"bearing {name!r} is unknown{why and ': ' + why}; known: "
            f"{', '.join(published_bearings())}, and "
            f"designations of the series {', '.join(SERIES)} with bores of 10 to 120 mm, those of "
            "angular contact with C, AC or B for the contact angle"
        )
    return {"name": shown, **_entry(shown)}


def _entry(name: str) -> dict[str, Any]:
    """Entry of a published bearing, or by its designation, with what the suffixes say."""
    published = library_data(PUBLISHED)
    if name in published:
        return published[name]
    designation = known_designation(name)
    assert designation is not None  # of a name that is known
    key = matching_name(designation.basic, published)
    entry = published[key] if key is not None else catalogue_entry(designation)
    assert entry is not None
    return with_designation(entry, designation)


def warn_of_estimates(name: str, values: Mapping[str, Any], assumed: Collection[str] = ()) -> None:
    """Warn once of all values of a case that are the catalogue's estimates, with their ranges.

    And once of those that the case itself says are assumed.

    Parameters
    ----------
    name : str
        name of the bearing, in the catalogue or not
    values : Mapping[str, Any]
        the case's [bearing] table, filled in from the catalogue
    assumed : Collection[str], default ()
        keys that the case itself says are assumed
    """
    key = catalogue_name(name)
    if key is not None and (estimates := _estimates(key, name, values, assumed)):
        text = f"bearing {key!r}: internal geometry is estimated: {', '.join(estimates)}"
        warnings.warn(text, stacklevel=2)
    present = {field: value for field, value in values.items() if value is not None}
    texts = [_with_words(field, value) for field, value in present.items() if field in assumed]
    if texts:
        text = f"bearing {name!r}: assumed, as the case says: {', '.join(texts)}"
        warnings.warn(text, stacklevel=2)


def _estimates(
    key: str, name: str, values: Mapping[str, Any], assumed: Collection[str]
) -> list[str]:
    """Values of a case that are the catalogue's estimates, in words with their ranges."""
    ranges = _entry_with_class(key, values).get("range", {})  # none of published bearings
    estimates = []
    for field in estimated_fields(name, values):
        if field not in assumed:
            low, high = ranges[field]
            estimates.append(f"{_with_words(field, values[field])} ({low:g} to {high:g})")
    return estimates


def estimated_fields(name: str, values: Mapping[str, Any]) -> tuple[str, ...]:
    """Keys of a case's [bearing] table whose values are the catalogue's estimates.

    Parameters
    ----------
    name : str
        name of the bearing
    values : Mapping[str, Any]
        the case's [bearing] table

    Returns
    -------
    tuple[str, ...]
        keys, none for a bearing that is not of the catalogue
    """
    if catalogue_name(name) is None:
        return ()
    entry = _entry_with_class(name, values)
    present = (field for field in entry["estimated"] if values.get(field) is not None)
    return tuple(field for field in present if isclose(values[field], entry[field]))


def _entry_with_class(name: str, values: Mapping[str, Any]) -> dict[str, Any]:
    """The catalogue's entry with the clearance class that a case's [bearing] table names."""
    return with_clearance(load_catalogue_entry(name), values.get("clearance_class"))


def _with_words(field: str, value: Any) -> str:
    """A key as words, its value and unit: 'ball_diameter_mm' 8.0 is 'ball diameter 8 mm'."""
    words, _, last = field.rpartition("_")
    shown = f"{value:g}" if isinstance(value, int | float) else str(value)
    if last in ("mm", "um", "deg"):
        return f"{words.replace('_', ' ')} {shown} {last}"
    return f"{field.replace('_', ' ')} {shown}"
