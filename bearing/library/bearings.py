"""Bearings by name, as the keys of a case file's [bearing] table, and tolerances of their seats by
name: deviations of shafts and housings (ISO 286: k5, H7), of the bearings on them (ISO 492), and
the interference that follows.

A housing of letters K to N with a grade up to 8, P up to 7, has the deviation of the shaft of that
letter with opposite sign, raised by the difference of its grade from the next finer one; F, G and
H mirror the shafts; JS and js lie half and half (ISO 286). Only sizes above 6, up to 315 mm.
"""

import re
import warnings
from collections.abc import Collection, Mapping
from functools import cache
from math import isclose
from typing import Any

from .catalogue import (
    catalogue_entry,
    estimated_bearings,
    known_designation,
    size_source,
    with_clearance,
    with_designation,
)
from .designation import SERIES, Designation, why_unknown
from .plugins import library_data, matching_name, plain_name

PUBLISHED = "bearings.toml"

DATA = "fits.toml"
SMALLEST_SIZE = 6.0  # above which the tables begin [mm]
TOLERANCE_CLASSES = ("normal", "P6", "P5", "P4", "P2")
SHAFT_LETTERS = ("f", "g", "h", "js", "j", "k", "m", "n", "p")
HOUSING_LETTERS = ("F", "G", "H", "JS", "J", "K", "M", "N", "P")
GRADES = (4, 5, 6, 7, 8)  # IT, of seats
PUSHED_UP = ("K", "M", "N", "P")  # letters of housings whose deviation the grade raises


@cache
def list_bearings() -> tuple[str, ...]:
    """Names of the catalogue: published geometries first, then estimated ones by series.

    Returns
    -------
    tuple[str, ...]
        names for `load_catalogue_entry`

    Examples
    --------
    >>> from oilfilm.bearing import list_bearings
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
    >>> from oilfilm.bearing import load_catalogue_entry
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
            f"designations of the series {', '.join(SERIES)} with bores of 10 to 180 mm, "
            "miniature and inch ones, of angular contact with C, AC or B for the contact angle"
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
        text += unverified_size(key)
        warnings.warn(text, stacklevel=2)
    present = {field: value for field, value in values.items() if value is not None}
    texts = [_with_words(field, value) for field, value in present.items() if field in assumed]
    if texts:
        text = f"bearing {name!r}: assumed, as the case says: {', '.join(texts)}"
        warnings.warn(text, stacklevel=2)


def unverified_size(name: str) -> str:
    """Words about the size of a miniature or inch bearing that was read in no source.

    Parameters
    ----------
    name : str
        name of the bearing, in the catalogue or not

    Returns
    -------
    str
        end of a message; empty for all others
    """
    designation = known_designation(name)
    source = "" if designation is None else size_source(designation)
    return f"; {source}" if "unverified" in source else ""


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


Interval = tuple[float, float]  # smallest and largest [um]


def _column(size: float) -> int:
    """Column of the tables for a nominal size [mm]."""
    ends = library_data(DATA)["sizes"]["up_to_mm"]
    for column, end in enumerate(ends):
        if SMALLEST_SIZE < size <= end:
            return column
    raise ValueError(
        f"size must lie above {SMALLEST_SIZE:g} mm, up to {ends[-1]} mm, got {size!r}"
    )


def _split(name: str, letters: tuple[str, ...]) -> tuple[str, int]:
    match = re.fullmatch(r"([A-Za-z]+)(\d)", name.strip())
    allowed = f"{letters[0]}6, {letters[4]}6, {letters[5]}5: a letter of {', '.join(letters)} and "
    allowed += f"a grade of {GRADES[0]} to {GRADES[-1]}"
    if match is None or match[1] not in letters or int(match[2]) not in GRADES:
        raise ValueError(f"tolerance {name!r} is unknown; allowed: {allowed}")
    return match[1], int(match[2])


def _grade(grade: int, column: int) -> float:
    return float(library_data(DATA)["grades"][f"IT{grade}"][column])


def shaft_deviations(name: str, size: float) -> Interval:
    """Deviations of a shaft by its tolerance, ISO 286.

    Parameters
    ----------
    name : str
        tolerance, such as k5
    size : float
        nominal diameter [mm]

    Returns
    -------
    Interval
        smallest and largest deviation [um]

    Raises
    ------
    ValueError
        if the tolerance or the size is not in the tables
    """
    letter, grade = _split(name, SHAFT_LETTERS)
    column = _column(size)
    width = _grade(grade, column)
    if letter == "js":
        return -0.5 * width, 0.5 * width
    if letter == "j" and grade not in (5, 6):
        raise ValueError(f"tolerance {name!r} is unknown; allowed of j: j5, j6, or js{grade}")
    if letter == "k" and grade > 7:
        return 0.0, width
    deviation = float(library_data(DATA)["shafts"][letter][column])
    if letter in ("f", "g", "h"):
        return deviation - width, deviation
    return deviation, deviation + width


def housing_deviations(name: str, size: float) -> Interval:
    """Deviations of a housing bore by its tolerance, ISO 286.

    Parameters
    ----------
    name : str
        tolerance, such as H7
    size : float
        nominal diameter [mm]

    Returns
    -------
    Interval
        smallest and largest deviation [um]

    Raises
    ------
    ValueError
        if the tolerance or the size is not in the tables
    """
    letter, grade = _split(name, HOUSING_LETTERS)
    column = _column(size)
    width = _grade(grade, column)
    if letter == "JS":
        return -0.5 * width, 0.5 * width
    if letter == "J":
        table: Any = library_data(DATA)["housings"]
        if f"J{grade}" not in table:
            raise ValueError(f"tolerance {name!r} is unknown; allowed of J: J6, J7, or JS{grade}")
        return float(table[f"J{grade}"][column]) - width, float(table[f"J{grade}"][column])
    mirrored = -float(library_data(DATA)["shafts"][letter.lower()][column])
    if letter not in PUSHED_UP:
        return mirrored + 0.0, mirrored + width
    if letter == "P" and grade > 7:
        return mirrored - width, mirrored
    upper = mirrored + width - _grade(grade - 1, column)
    return upper - width, upper


def bore_deviations(tolerance_class: str, bore: float) -> Interval:
    """Deviations of the mean bore of a bearing, ISO 492.

    Parameters
    ----------
    tolerance_class : str
        one of `TOLERANCE_CLASSES`
    bore : float
        bore diameter [mm]

    Returns
    -------
    Interval
        smallest and largest deviation [um]
    """
    table: Any = library_data(DATA)["bearings"]["bore"]
    return float(table[tolerance_class][_column(bore)]), 0.0


def outside_deviations(tolerance_class: str, outside_diameter: float) -> Interval:
    """Deviations of the mean outside diameter of a bearing, ISO 492.

    Parameters
    ----------
    tolerance_class : str
        one of `TOLERANCE_CLASSES`
    outside_diameter : float
        outside diameter [mm]

    Returns
    -------
    Interval
        smallest and largest deviation [um]
    """
    data: Any = library_data(DATA)["bearings"]
    column = _column(outside_diameter)
    if 150.0 < outside_diameter <= 180.0:
        return float(data["outside_150_180"][tolerance_class]), 0.0
    return float(data["outside"][tolerance_class][column]), 0.0


def inner_interference(shaft: str, tolerance_class: str, bore: float) -> Interval:
    """Interference of the inner ring on a shaft; negative is loose.

    Parameters
    ----------
    shaft : str
        tolerance of the shaft
    tolerance_class : str
        class of the bearing
    bore : float
        bore diameter [mm]

    Returns
    -------
    Interval
        smallest and largest interference [um]
    """
    low, high = shaft_deviations(shaft, bore)
    smallest, largest = bore_deviations(tolerance_class, bore)
    return low - largest, high - smallest


def outer_interference(housing: str, tolerance_class: str, outside_diameter: float) -> Interval:
    """Interference of the outer ring in a housing; negative is loose.

    Parameters
    ----------
    housing : str
        tolerance of the housing
    tolerance_class : str
        class of the bearing
    outside_diameter : float
        outside diameter [mm]

    Returns
    -------
    Interval
        smallest and largest interference [um]
    """
    low, high = housing_deviations(housing, outside_diameter)
    smallest, largest = outside_deviations(tolerance_class, outside_diameter)
    return smallest - high, largest - low
