"""A new case file for a bearing by its designation or its boundary dimensions."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from math import isfinite, radians
from typing import Any

from bearing.library.bearings import load_catalogue_entry, named_designation
from bearing.library.catalogue import boundary_dimensions, with_designation
from bearing.library.designation import Designation, series_and_bore
from bearing.rating.geometry_estimate import CatalogueData, estimate_bearing

from ...format.document import validate_text
from ...format.problems import CaseError
from .first_operation import BearingKind, FirstOperation, first_tables, typical

SPINDLE_SERIES = ("70", "719")
SPINDLE_ANGLE = 26.0  # of bearings known by their size that count likewise [deg]
RIGHT_ANGLE = 90.0  # [deg]
EXAMPLE_SIZE = (25.0, (47.0, 8.0))  # bore, outside diameter and width of an example [mm]
PRECISE = ("P5", "P4", "P2")
PRELOADS = {"DB": ("+x", "-x"), "DF": ("-x", "+x"), "DT": ("+x", "+x")}
# keys of an entry that a case file shows, in this order
SHOWN = (
    "type",
    "bore_mm",
    "outside_diameter_mm",
    "width_mm",
    "ball_diameter_mm",
    "balls",
    "pitch_diameter_mm",
    "inner_groove_radius_mm",
    "outer_groove_radius_mm",
    "clearance_class",
    "diametral_clearance_um",
    "free_contact_angle_deg",
    "inner_shoulder_diameter_mm",
    "outer_shoulder_diameter_mm",
    "tolerance_class",
    "ring_material",
    "ball_material",
    "basic_dynamic_rating_kN",
    "basic_static_rating_kN",
    "skf_series",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class BoundaryDimensions:
    """A bearing known from outside: lengths [mm], ratings [kN], nominal contact angle [deg]."""

    bore: float
    outside_diameter: float
    width: float
    dynamic_rating: float | None = None
    static_rating: float | None = None
    contact_angle: float = 0.0


def case_of_designation(name: str, given: FirstOperation) -> str:
    """Text of a case file for a bearing of the catalogue.

    Parameters
    ----------
    name : str
        Designation of the bearing.
    given : FirstOperation
        Speed and loads that the user prescribes.

    Returns
    -------
    str
        The text.

    Raises
    ------
    ValueError
        If the name is unknown.
    """
    try:
        entry = load_catalogue_entry(name)
    except ValueError as error:
        raise ValueError(f"{error}; {_by_size(name)}") from None
    designation = named_designation(entry["name"])
    if designation is not None:
        outside, width = boundary_dimensions()[designation.dimension_series, designation.bore]
        size = {"bore_mm": designation.bore, "outside_diameter_mm": outside, "width_mm": width}
        entry = _with_normal_clearance({**size, **entry}, designation)
    if "width_mm" not in entry:
        raise ValueError(f"bearing {entry['name']!r}: its source gives no width; {_by_size(name)}")
    return _text(entry["name"], entry, designation, given)


def _by_size(name: str) -> str:
    """How to make the case by size, with the dimensions of this bearing where they are known."""
    begins = series_and_bore(name)
    size = begins and boundary_dimensions().get((begins.dimension_series, begins.bore))
    bore, (outside, width) = (begins.bore, size) if begins and size else EXAMPLE_SIZE
    return (
        f"a bearing by its size: oilfilm init NAME --bore {bore:g} --outside {outside:g} "
        f"--width {width:g} [mm], with --angle 30 if of angular contact [deg], --C and --C0 if "
        "known [kN]"
    )


def case_of_dimensions(size: BoundaryDimensions, given: FirstOperation) -> str:
    """Text of a case file for a bearing whose internal geometry is estimated.

    Parameters
    ----------
    size : BoundaryDimensions
        Boundary dimensions [mm], ratings [kN] and contact angle [deg].
    given : FirstOperation
        Speed and loads that the user prescribes.

    Returns
    -------
    str
        The text.

    Raises
    ------
    ValueError
        If a value is impossible; the message names it.
    """
    _check_size(size)
    ratings = (size.dynamic_rating, size.static_rating)
    dynamic, static = (None if rating is None else 1e3 * rating for rating in ratings)
    entry = estimate_bearing(
        CatalogueData(
            bore=1e-3 * size.bore,
            outside_diameter=1e-3 * size.outside_diameter,
            width=1e-3 * size.width,
            contact_angle=radians(size.contact_angle),
            dynamic_rating=dynamic,
            static_rating=static,
        )
    )
    name = f"{size.bore:g} x {size.outside_diameter:g} x {size.width:g}"
    return _text(name, entry, None, given)


def _check_size(size: BoundaryDimensions) -> None:
    """ValueError that names the option whose value makes no bearing, in its unit."""
    lengths = {"bore": size.bore, "outside": size.outside_diameter, "width": size.width}
    for key, value in (lengths | {"C": size.dynamic_rating, "C0": size.static_rating}).items():
        if value is not None and not (isfinite(value) and value > 0.0):
            raise ValueError(f"--{key}: found {value:g}; allowed: above 0")
    if size.outside_diameter <= size.bore:
        found = f"--outside: found {size.outside_diameter:g} mm"
        raise ValueError(f"{found}; allowed: above --bore, {size.bore:g} mm")
    if not 0.0 <= size.contact_angle < RIGHT_ANGLE:
        raise ValueError(f"--angle: found {size.contact_angle:g} deg; allowed: from 0, below 90")


def checked(text: str) -> str:
    """Check the text of a new case.

    Parameters
    ----------
    text : str
        The text.

    Returns
    -------
    str
        The same text.

    Raises
    ------
    ValueError
        If a number given for it is out of range.
    """
    try:
        validate_text(text, "")
    except CaseError as error:
        faults = (re.sub(r"^:\d+: ", "", message) for message in error.messages)
        raise ValueError("; ".join(faults)) from error
    return text


def _with_normal_clearance(entry: dict[str, Any], designation: Designation) -> dict[str, Any]:
    """A new case takes the class CN where a published table has no play, which is of its study."""
    if entry.get("diametral_clearance_um") != 0.0 or designation.clearance_class:
        return entry
    return with_designation(entry, replace(designation, clearance_class="CN"))


def _text(
    name: str, entry: Mapping[str, Any], designation: Designation | None, given: FirstOperation
) -> str:
    tables = _tables(entry, designation, given)
    estimated = entry["estimated"] if designation is None else ()
    assumed = [f"bearing.{key}" for key in estimated]
    keys = [*assumed, *(f"{table}.{key}" for table, rows in tables.items() for key in rows)]
    lines = [
        "schema_version = 1",
        f'title = "{name}"',
        f'source = "bearing: {_escaped(entry["source"])}"',
        "assumed = [",
        *(f'    "{key}",' for key in keys if key not in KNOWN_CHOICES),
        "]",
        "",
        "[bearing]",
        f'name = "{_escaped(name)}"',
        *_bearing_lines(entry),
    ]
    for table, rows in tables.items():
        lines += ["", f"[{table}]", *(f"{key} = {value}" for key, value in rows.items())]
    lines += ["", *_rows(entry, designation), "[ehl]", 'film_maps = "all"']
    return "\n".join(lines) + "\n"


# what the user is to choose, not a property that a source could give
KNOWN_CHOICES = (
    "operation.inner_speed_rpm",
    "operation.radial_load_N",
    "operation.axial_load_N",
    "operation.temperature",
    "lubricant.name",
    "lubricant.grease",
    "friction.lubrication",
)


def _bearing_lines(entry: Mapping[str, Any]) -> Iterator[str]:
    """Keys of [bearing], an estimate with its interval beside it."""
    ranges = entry.get("range", {})
    for key in SHOWN:
        if key not in entry:
            if key.startswith("basic_") and "silicon" not in str(entry["ball_material"]):
                yield f"# {key}: none read, computed from the geometry"
            continue
        value = entry[key]
        text = f'"{value}"' if isinstance(value, str) else f"{value:.10g}"
        if key.endswith(("_mm", "_um", "_deg", "_kN")) and "." not in text:
            text += ".0"
        low, high = ranges.get(key, (None, None))
        yield f"{key} = {text}" + ("" if low is None else f"  # estimated, {low:g} to {high:g}")


def _tables(
    entry: Mapping[str, Any], designation: Designation | None, given: FirstOperation
) -> dict[str, dict[str, str]]:
    """The other tables: a speed and loads to start from, and what is typical, with its range."""
    race = "race_roughness_um"
    if entry.get("tolerance_class") in PRECISE:
        race = "precision_race_roughness_um"
    steel = entry["ball_material"] == "bearing steel"
    surface = {
        "inner_ring_roughness_um": typical(race),
        "outer_ring_roughness_um": typical(race),
        "ball_roughness_um": typical(
            "ball_roughness_um" if steel else "ceramic_ball_roughness_um"
        ),
    }
    tables = first_tables(entry, _kind(entry, designation), given)
    friction = tables.pop("friction")
    return {**tables, "surface": surface, "friction": friction}


def _kind(entry: Mapping[str, Any], designation: Designation | None) -> BearingKind:
    angular = entry["type"] == "angular contact"
    if designation is None:
        spindle = angular and entry["free_contact_angle_deg"] <= SPINDLE_ANGLE
        return BearingKind(angular=angular, spindle=spindle, pair=False, rows=1, greased=False)
    return BearingKind(
        angular=angular,
        spindle=designation.series in SPINDLE_SERIES,
        pair=designation.arrangement in ("DB", "DF"),
        rows=2 if _is_set(designation) else 1,
        greased=designation.greased,
    )


def _is_set(designation: Designation | None) -> bool:
    """Tell whether it names two bearings side by side."""
    return designation is not None and designation.arrangement in PRELOADS


def _rows(entry: Mapping[str, Any], designation: Designation | None) -> list[str]:
    """[[rows]] of a set of two."""
    if designation is None or not _is_set(designation):
        return []
    lines = []
    half = 0.5 * float(entry["width_mm"])
    preload = [f'preload_class = "{designation.preload_class or "light"}"']
    senses = PRELOADS[designation.arrangement]
    tandem = len(set(senses)) == 1  # does not press against itself
    for position, sense in zip((-half, half), senses, strict=True):
        lines += ["[[rows]]", f"axial_position_mm = {position:g}", f'loaded_by = "{sense}"']
        lines += [*([] if tandem else preload), ""]
    return lines


def _escaped(text: str) -> str:
    return text.replace("\\", "\\\\").replace('"', '\\"')
