"""Tolerances of seats by name: deviations of shafts and housings (ISO 286: k5, H7), of the
bearings on them (ISO 492), and the interference that follows.

A housing of letters K to N with a grade up to 8, P up to 7, has the deviation of the shaft of that
letter with opposite sign, raised by the difference of its grade from the next finer one; F, G and
H mirror the shafts; JS and js lie half and half (ISO 286). Only sizes above 6, up to 315 mm.
"""

import re
from typing import Any

from .names import library_data

DATA = "fits.toml"
SMALLEST_SIZE = 6.0  # above which the tables begin [mm]
TOLERANCE_CLASSES = ("normal", "P6", "P5", "P4", "P2")
SHAFT_LETTERS = ("f", "g", "h", "js", "j", "k", "m", "n", "p")
HOUSING_LETTERS = ("F", "G", "H", "JS", "J", "K", "M", "N", "P")
GRADES = (4, 5, 6, 7, 8)  # IT, of seats
PUSHED_UP = ("K", "M", "N", "P")  # letters of housings whose deviation the grade raises

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
