"""Bearings of the catalogue whose internal geometry is estimated: entries by rule, from boundary
dimensions (ISO 15), load ratings where a maker prints them, and clearance classes (ISO 5753-1).

The numbers come from three tables in `data`: boundary_dimensions.csv, clearance_classes.csv and
catalogue_ratings.csv. Ball and number of balls in the latter are those that explain the ratings
(`bearing.rating.geometry_estimate`, written by tools/catalogue_geometry.py). A bearing without
ratings takes the balls of one of its size with another contact angle, or else typical ones: sizes
of balls and conformities of grooves that bearings have in common, with their ranges between
makers.
"""

import csv
from dataclasses import dataclass
from functools import cache, lru_cache
from importlib import resources
from math import asin, degrees, floor, pi, radians
from typing import Any

from .designation import ANGLES, SERIES, SMALL, Designation, read_designation

INCH = 25.4e-3  # [m]
# between ball sizes below and above FINE_LARGEST [m]
FINE_STEP = INCH / 64.0
COARSE_STEP = INCH / 32.0
FINE_LARGEST = 18.0 * FINE_STEP  # 9/32 inch [m]
METRIC = (3.5e-3,)  # of thin bearings: 6804 to 6807 [m]
FEWEST_BALLS = 5
INNER_CONFORMITY = 0.515  # groove radius over ball diameter, assumed [-]
OUTER_CONFORMITY = 0.525
# grooves of angular contact bearings of machine spindles, up to this nominal angle: the rigidity
# that FAG prints of pairs of B7012C and B7015C, 64.5 and 76.8 N/um, is missed by 3 and 7 % [-]
SPINDLE_CONFORMITY = 0.53
SPINDLE_ANGLE = 26.0  # [deg]
# range of the bearings with published ones [-]
INNER_CONFORMITY_RANGE = (0.51, 0.525)
OUTER_CONFORMITY_RANGE = (0.515, 0.53)
SPINDLE_CONFORMITY_RANGE = (0.515, 0.54)
ANGLE_RANGE = 3.0  # around a nominal contact angle, unverified [deg]
# D over D_o - d, mean of the catalogue's, and the same of the pitch circle that balls fill over
# the contact angle [deg]: docs/user/libraries.md [-]
TYPICAL_BALL = 0.30
# largest D over the width that is guessed: 261 of the catalogue's 262 bearings with ratings lie
# below, the 6322 has 0.83 [-]
WIDEST_BALL = 0.80
TYPICAL_FILL = ((0.0, 0.60), (15.0, 0.78), (40.0, 0.86))
# ranges of such an estimate, over the estimate: docs/user/libraries.md [-]
TYPICAL_BALL_RANGE = (0.80, 1.15)
TYPICAL_BALLS_RANGE = 0.2
TYPICAL_PITCH_RANGE = 0.02

MM = 1e-3  # [m]
# series with the balls of another in wider rings, as makers' equal ratings have it
NARROW = {"622": "62", "623": "63", "630": "60"}
WIDTHS = (*NARROW, "160")  # series that differ from another in width alone
STAINLESS = "x105crmo17"  # of bearings of stainless steel, assumed
BALL_RANGE = 0.07  # relative, of estimates from ratings: docs/user/libraries.md [-]
PITCH_RANGE = 0.015
BALLS_RANGE = 0.1
MAKER = "C and C_0: NSK, Rolling Bearings, B8 to B17 and B50 to B61"
Ends = tuple[float, float]  # of a range
SIZE_SOURCES = {  # of miniature and inch bearings, by the column of their table
    "Koyo": "Koyo, Ball & Roller Bearings, CAT. NO. 203E-1, B14",
    "lists": "public lists of parts",
    "unverified": "from memory (unverified)",
}
CLEARANCE_CLASSES = ("C2", "CN", "CM", "C3", "C4", "C5")
# factors of ISO 15 by the series of deep groove bearings [-], from memory, unverified
DIAMETER_SERIES = {"618": 0.45, "619": 0.62, "60": 0.84, "62": 1.48, "63": 1.92, "64": 2.56}


def ball_sizes(smallest: float, largest: float) -> tuple[float, ...]:
    """Standard ball diameters in an interval.

    Steps of 1/64 inch up to 9/32 inch, of 1/32 inch beyond, and 3.5 mm.

    Parameters
    ----------
    smallest, largest : float
        ends of the interval [m]

    Returns
    -------
    tuple[float, ...]
        diameters, rising [m]
    """
    fine = [i * FINE_STEP for i in range(1, round(FINE_LARGEST / FINE_STEP) + 1)]
    first = round(FINE_LARGEST / COARSE_STEP) + 1
    coarse = [i * COARSE_STEP for i in range(first, floor(largest / COARSE_STEP) + 2)]
    return tuple(size for size in sorted((*fine, *METRIC, *coarse)) if smallest <= size <= largest)


def full_complement(ball_diameter: float, pitch_diameter: float) -> int:
    """Number of balls that fit on the pitch circle without a cage.

    Parameters
    ----------
    ball_diameter : float
        D [m]
    pitch_diameter : float
        d_m [m]

    Returns
    -------
    int
        number of balls [-]
    """
    return floor(pi / asin(ball_diameter / pitch_diameter) + 1e-9)


def typical_geometry(
    bore: float, outside_diameter: float, contact_angle: float, width: float | None = None
) -> tuple[float, float, int]:
    """Ball diameter, pitch diameter and number of balls from the boundary dimensions: a rough
    guess.

    D = 0.30 (D_o - d), or 0.80 of a smaller width, the nearest standard size; Z = fill
    pi/asin(D/d_m), with the part of the pitch circle that the balls of the catalogue's bearings
    fill, linear in the contact angle between deep groove, 15 and 40 degrees.

    Parameters
    ----------
    bore, outside_diameter : float
        boundary dimensions [m]
    contact_angle : float
        nominal contact angle [rad]
    width : float | None, optional
        width [m]; None: the section alone decides

    Returns
    -------
    ball_diameter
        D [m]
    pitch_diameter
        d_m [m]
    balls
        Z [-]
    """
    target = TYPICAL_BALL * (outside_diameter - bore)
    if width is not None:
        target = min(target, WIDEST_BALL * width)
    pitch = 0.5 * (bore + outside_diameter)
    sizes = ball_sizes(0.5 * target, 1.5 * target) or (target,)
    ball = min(sizes, key=lambda size: abs(size - target))
    return ball, pitch, typical_number(ball, pitch, contact_angle)


def typical_number(ball_diameter: float, pitch_diameter: float, contact_angle: float) -> int:
    """Number of balls that is typical of their diameter on a pitch circle.

    Parameters
    ----------
    ball_diameter : float
        D [m]
    pitch_diameter : float
        d_m [m]
    contact_angle : float
        nominal contact angle [rad]

    Returns
    -------
    int
        number of balls [-]
    """
    fill = typical_fill(degrees(contact_angle))
    balls = round(fill * pi / asin(ball_diameter / pitch_diameter))
    return max(FEWEST_BALLS, min(balls, full_complement(ball_diameter, pitch_diameter)))


def typical_fill(angle: float) -> float:
    """Share of the pitch circle that balls fill, over the contact angle.

    Parameters
    ----------
    angle : float
        nominal contact angle [deg]

    Returns
    -------
    float
        share [-]
    """
    (a0, f0), (a1, f1), (a2, f2) = TYPICAL_FILL
    if angle <= a1:
        return f0 + (f1 - f0) * (angle - a0) / (a1 - a0)
    return f1 + (f2 - f1) * (min(angle, a2) - a1) / (a2 - a1)


@dataclass(frozen=True, slots=True, kw_only=True)
class Geometry:
    """Estimated internal geometry and how it was found."""

    ball_diameter: float  # [m]
    pitch_diameter: float  # [m]
    balls: int
    basis: str  # what it was estimated from, as in the source of an entry
    ball_range: tuple[float, float]  # [m]
    pitch_range: tuple[float, float]  # [m]
    balls_range: tuple[int, int]


def from_ratings(ball: float, pitch: float, balls: int, basis: str) -> Geometry:
    """Geometry that explains load ratings, with its intervals.

    Parameters
    ----------
    ball : float
        ball diameter [m]
    pitch : float
        pitch diameter [m]
    balls : int
        number of balls [-]
    basis : str
        source of the estimate, for the entry's `source`

    Returns
    -------
    Geometry
        geometry with ranges [m]
    """
    more = max(1, round(BALLS_RANGE * balls))
    return Geometry(
        ball_diameter=ball,
        pitch_diameter=pitch,
        balls=balls,
        basis=basis,
        ball_range=(ball * (1.0 - BALL_RANGE), ball * (1.0 + BALL_RANGE)),
        pitch_range=(pitch * (1.0 - PITCH_RANGE), pitch * (1.0 + PITCH_RANGE)),
        balls_range=(balls - more, balls + more),
    )


def from_dimensions(
    bore: float, outside_diameter: float, contact_angle: float, width: float | None = None
) -> Geometry:
    """Typical geometry of boundary dimensions and a nominal contact angle.

    Parameters
    ----------
    bore, outside_diameter : float
        boundary dimensions [m]
    contact_angle : float
        nominal contact angle [rad]
    width : float | None, optional
        width [m]; None: the section alone decides

    Returns
    -------
    Geometry
        geometry with ranges [m]
    """
    ball, pitch, balls = typical_geometry(bore, outside_diameter, contact_angle, width)
    low, high = TYPICAL_BALL_RANGE
    more = max(2, round(TYPICAL_BALLS_RANGE * balls))
    width = TYPICAL_PITCH_RANGE
    return Geometry(
        ball_diameter=ball,
        pitch_diameter=pitch,
        balls=balls,
        basis="ball, balls, pitch diameter: estimated, typical of the boundary dimensions",
        ball_range=(low * ball, high * ball),
        pitch_range=(pitch * (1.0 - width), pitch * (1.0 + width)),
        balls_range=(max(3, balls - more), balls + more),
    )


@cache
def table(file: str) -> tuple[dict[str, str], ...]:
    """Rows of a table of the library.

    Parameters
    ----------
    file : str
        name of the file in `data`

    Returns
    -------
    tuple[dict[str, str], ...]
        a dictionary by column for each row
    """
    text = resources.files(__package__).joinpath("data", file).read_text(encoding="utf-8")
    return tuple(csv.DictReader(text.splitlines()))


@cache
def ratings() -> dict[str, dict[str, str]]:
    """Rows of the table of ratings by designation."""
    return {row["designation"]: row for row in table("catalogue_ratings.csv")}


@cache
def boundary_dimensions() -> dict[tuple[str, float], tuple[float, float]]:
    """Outside diameter and width [mm] by dimension series and bore [mm], ISO 15."""
    return {
        (row["dimension_series"], float(row["bore_mm"])): (
            float(row["outside_diameter_mm"]),
            float(row["width_mm"]),
        )
        for row in table("boundary_dimensions.csv")
    }


@cache
def small_bearings() -> dict[str, dict[str, str]]:
    """Rows of the miniature and inch bearings by designation and its synonym."""
    rows = table("small_bearings.csv")
    return {name: row for row in rows for name in (row["designation"], row["synonym"]) if name}


def size_of(designation: Designation) -> tuple[float, float, float] | None:
    """Bore, outside diameter and width of a designation.

    Parameters
    ----------
    designation : Designation
        series and bore

    Returns
    -------
    tuple[float, float, float] | None
        lengths [mm]; None if there is no such size
    """
    if designation.series == SMALL:
        row = small_bearings().get(designation.code)
        if row is None:
            return None
        return float(row["bore_mm"]), float(row["outside_diameter_mm"]), float(row["width_mm"])
    rest = boundary_dimensions().get((designation.dimension_series, designation.bore))
    return rest and (designation.bore, *rest)


def size_source(designation: Designation) -> str:
    """Source of the size of a miniature or inch bearing, that of the open one.

    Parameters
    ----------
    designation : Designation
        series and bore

    Returns
    -------
    str
        text for the entry's `source`; empty for the series of ISO 15
    """
    if designation.series != SMALL:
        return ""
    row = small_bearings()[designation.code]
    if designation.code.startswith("EE"):
        return f"size: that of the {row['designation']} (unverified)"
    return f"size: {SIZE_SOURCES[row['size']]}"


@cache
def estimated_bearings() -> tuple[str, ...]:
    """Designations of all bearings of the catalogue with an estimated geometry."""
    names = []
    for series, (dimensions, angular) in SERIES.items():
        bores = [
            bore
            for series_dimensions, bore in boundary_dimensions()
            if series_dimensions == dimensions
        ]
        suffixes = tuple(ANGLES) if angular else ("",)
        if series in ("719", "70"):
            suffixes = ("C", "AC")
        names += [f"{series}{_bore_number(b):02d}{suffix}" for suffix in suffixes for b in bores]
    return (*names, *small_bearings())


def _bore_number(bore: float) -> int:
    small = (10.0, 12.0, 15.0, 17.0)
    return small.index(bore) if bore in small else round(bore / 5.0)


def clearance_class(bore: float, name: str) -> tuple[float, float]:
    """Smallest and largest radial internal clearance of a class, ISO 5753-1.

    For deep groove ball bearings. The standard was not read: the numbers of CN are those of two
    makers' tables, which agree; those of the other classes are from memory and unverified
    (docs/user/libraries.md).

    Parameters
    ----------
    bore : float
        bore diameter [mm]
    name : str
        class, C2 to C5

    Returns
    -------
    tuple[float, float]
        smallest and largest clearance [um]

    Raises
    ------
    ValueError
        if the bore lies outside the table
    """
    for row in table("clearance_classes.csv"):
        if float(row["bore_over_mm"]) < bore <= float(row["bore_up_to_mm"]):
            if not row[f"{name}_from_um"]:
                raise ValueError(f"class {name} is known for bores up to 120 mm, got {bore!r} mm")
            return float(row[f"{name}_from_um"]), float(row[f"{name}_to_um"])
    raise ValueError(f"bore must lie between 2.5 and 180 mm, got {bore!r} mm")


@lru_cache(maxsize=256)
def catalogue_entry(designation: Designation) -> dict[str, Any] | None:
    """Keys of a case's [bearing] table for a designation.

    Parameters
    ----------
    designation : Designation
        series, bore and contact angle; suffixes play no part

    Returns
    -------
    dict[str, Any] | None
        keys with `source`, `estimated` and `range`; None if there is no such size
    """
    size = size_of(designation)
    if size is None or designation.basic not in estimated_bearings():
        return None
    row = small_bearings().get(designation.code) or ratings().get(_narrow(designation), {})
    geometry = _geometry(designation, size)
    entry = estimated_entry(size, designation.contact_angle, geometry, _values(row))
    entry["skf_series"] = friction_series(designation)
    if designation.series == SMALL:
        source = size_source(designation)
    else:
        source = f"boundary dimensions: ISO 15, dimension series {designation.dimension_series}"
    maker = MAKER if row.get("dynamic_rating_kN") else "no ratings read"
    if designation.series == SMALL and maker == MAKER:
        maker = "C and C_0: NSK's, from memory (unverified)"
    sources = [source, maker, entry["source"]]
    if row.get("inner_shoulder_mm"):
        sources.append(
            "shoulders: SKF general catalogue, d1 and D1, the pitch diameter their mean"
        )
    return {**entry, "source": "; ".join(sources)}


def friction_series(designation: Designation) -> str:
    """Series of SKF's friction constants that a designation belongs to.

    Parameters
    ----------
    designation : Designation
        series and contact angle of a bearing

    Returns
    -------
    str
        name of the series
    """
    if designation.series == SMALL:
        row = small_bearings()[designation.code]
        size = float(row["bore_mm"]), float(row["outside_diameter_mm"])
        return row["series"] or nearest_series(*size, angular=False)
    if not designation.angle_suffix:
        return NARROW.get(designation.series, designation.series)
    special = designation.series in ("72", "73") and designation.angle_suffix in ("B", "AC")
    return f"{designation.series} {designation.angle_suffix}" if special else "other single row"


def nearest_series(bore: float, outside_diameter: float, *, angular: bool) -> str:
    """Series of SKF's friction constants for a bearing without a designation.

    It is that of the diameter series of ISO 15 whose factor f = (D - d)/d^0.9 is the nearest, 0.45
    (8), 0.62 (9), 0.84 (0), 1.12 (1), 1.48 (2), 1.92 (3), 2.56 (4). Small bores have larger
    factors than these of the standard's formula, so that the dimensions of the catalogue decide
    where they have the bore.

    Parameters
    ----------
    bore, outside_diameter : float
        boundary dimensions [mm]
    angular : bool
        whether the bearing is one of angular contact

    Returns
    -------
    str
        name of the series
    """
    if angular:
        return "other single row"
    outside = {
        series: boundary_dimensions()[dimensions, bore][0]
        for series, (dimensions, is_angular) in SERIES.items()
        if not is_angular and (dimensions, bore) in boundary_dimensions() and series not in WIDTHS
    }
    if outside:
        return min(outside, key=lambda series: abs(outside[series] - outside_diameter))
    factor = (outside_diameter - bore) / bore**0.9
    return min(DIAMETER_SERIES, key=lambda series: abs(DIAMETER_SERIES[series] - factor))


def _narrow(designation: Designation) -> str:
    """Designation of the bearing with the same balls in rings of the usual width."""
    series = designation.series
    return NARROW.get(series, series) + designation.basic.removeprefix(series)


def _values(row: dict[str, str]) -> dict[str, float]:
    """Ratings [kN] and shoulders [mm] of a row as keys of a case."""
    keys = {
        "basic_dynamic_rating_kN": "dynamic_rating_kN",
        "basic_static_rating_kN": "static_rating_kN",
        "inner_shoulder_diameter_mm": "inner_shoulder_mm",
        "outer_shoulder_diameter_mm": "outer_shoulder_mm",
    }
    return {key: float(row[name]) for key, name in keys.items() if row.get(name)}


def _geometry(designation: Designation, size: tuple[float, float, float]) -> Geometry:
    """By the ratings of the bearing, of one of its size with another contact angle, or typical."""
    bore, outside, width = size
    others = [designation.angle_suffix, *(ANGLES if designation.angle_suffix else ())]
    stem = _narrow(designation).removesuffix(designation.angle_suffix)
    for suffix in others:
        row = small_bearings().get(designation.code) or ratings().get(stem + suffix)
        if row is None or not row["ball_mm"]:
            continue
        shoulders = [float(row.get(f"{ring}_shoulder_mm") or 0.0) for ring in ("inner", "outer")]
        pitch = 0.5 * sum(shoulders) if all(shoulders) else 0.5 * (bore + outside)
        basis = "ball, balls: estimated from the ratings"
        if designation.series in NARROW:
            basis = f"ball, balls, ratings: estimated, those of the {stem}"
        if suffix != designation.angle_suffix:
            basis = f"ball, balls: those estimated for the {stem + suffix}"
        ball = float(row["ball_mm"]) * MM
        return from_ratings(ball, pitch * MM, int(row["balls"]), basis)
    # balls of the series 160 and of miniature bearings are limited by the width
    limit = width * MM if designation.series in (SMALL, "160") else None
    return from_dimensions(bore * MM, outside * MM, radians(designation.contact_angle), limit)


def grooves_of(contact_angle: float) -> tuple[tuple[float, float], tuple[Ends, Ends]]:
    """Assumed conformities of the grooves.

    Parameters
    ----------
    contact_angle : float
        nominal contact angle, zero for a deep groove bearing [deg]

    Returns
    -------
    conformities
        of inner and outer groove [-]
    ranges
        of each [-]
    """
    if 0.0 < contact_angle <= SPINDLE_ANGLE:
        return (SPINDLE_CONFORMITY,) * 2, (SPINDLE_CONFORMITY_RANGE,) * 2
    ranges = (INNER_CONFORMITY_RANGE, OUTER_CONFORMITY_RANGE)
    return (INNER_CONFORMITY, OUTER_CONFORMITY), ranges


def estimated_entry(
    size: tuple[float, float, float],
    contact_angle: float,
    geometry: Geometry,
    published: dict[str, float],
) -> dict[str, Any]:
    """Keys of a case's [bearing] table for an estimated geometry.

    Parameters
    ----------
    size : tuple[float, float, float]
        bore, outside diameter and width [mm]
    contact_angle : float
        nominal contact angle, zero for a deep groove bearing [deg]
    geometry : Geometry
        estimated internal geometry
    published : dict[str, float]
        further keys, ratings and shoulders

    Returns
    -------
    dict[str, Any]
        keys with `source`, `estimated` and `range`
    """
    ball = geometry.ball_diameter
    (inner, outer), (inner_range, outer_range) = grooves_of(contact_angle)
    lengths = {
        "ball_diameter_mm": (ball, geometry.ball_range),
        "pitch_diameter_mm": (geometry.pitch_diameter, geometry.pitch_range),
        "inner_groove_radius_mm": (inner * ball, _times(inner_range, ball)),
        "outer_groove_radius_mm": (outer * ball, _times(outer_range, ball)),
    }
    values: dict[str, Any] = {key: _mm(value) for key, (value, _) in lengths.items()}
    ranges: dict[str, Any] = {key: [_mm(v) for v in ends] for key, (_, ends) in lengths.items()}
    values["balls"] = geometry.balls
    ranges["balls"] = list(geometry.balls_range)
    if contact_angle:
        kind = "angular contact"
        play = "contact angle: nominal"
        half = ANGLE_RANGE
        values["free_contact_angle_deg"] = contact_angle
        ranges["free_contact_angle_deg"] = [contact_angle - half, contact_angle + half]
    else:
        kind = "deep groove"
        play = "clearance: middle of the class CN"
        low, high = clearance_class(size[0], "CN")
        values["diametral_clearance_um"] = 0.5 * (low + high)
        ranges["diametral_clearance_um"] = [low, high]
    boundary = dict(zip(("bore_mm", "outside_diameter_mm", "width_mm"), size, strict=True))
    steel = dict.fromkeys(("ring_material", "ball_material"), "bearing steel")
    grooves = f"grooves: {inner:g} and {outer:g} of the ball, assumed"
    source = {"source": "; ".join((geometry.basis, play, grooves))}
    values = {"type": kind, **values, **boundary, **published, **steel, **source}
    return {**values, "estimated": list(ranges), "range": ranges}


def with_designation(entry: dict[str, Any], designation: Designation) -> dict[str, Any]:
    """An entry with the materials and the clearance that the suffixes name.

    Parameters
    ----------
    entry : dict[str, Any]
        keys of the basic bearing
    designation : Designation
        designation with its suffixes

    Returns
    -------
    dict[str, Any]
        changed keys
    """
    entry = {**entry, "range": dict(entry.get("range", {})), "estimated": list(entry["estimated"])}
    if designation.balls == "stainless":
        entry |= dict.fromkeys(("ring_material", "ball_material"), STAINLESS)
        entry.pop("basic_dynamic_rating_kN", None)  # of another steel
        entry.pop("basic_static_rating_kN", None)
    elif designation.balls:
        entry["ball_material"] = "silicon nitride"
        entry.pop("basic_static_rating_kN", None)  # of another permissible pressure
    if designation.balls == "full ceramic":
        entry["ring_material"] = "silicon nitride"
        entry.pop("basic_dynamic_rating_kN", None)
    if designation.tolerance_class:
        entry["tolerance_class"] = designation.tolerance_class
    return with_clearance(entry, designation.clearance_class)


def with_clearance(entry: dict[str, Any], name: str | None) -> dict[str, Any]:
    """An entry with the middle of a clearance class.

    Parameters
    ----------
    entry : dict[str, Any]
        keys of a bearing
    name : str | None
        class, C2 to C5; None or empty leaves the entry as it is

    Returns
    -------
    dict[str, Any]
        changed keys, or the entry if it has no clearance
    """
    key = "diametral_clearance_um"
    if not name or key not in entry or "bore_mm" not in entry:
        return entry
    low, high = clearance_class(entry["bore_mm"], name)
    sources = [text for text in entry["source"].split("; ") if not text.startswith("clearance: ")]
    return {
        **entry,
        "clearance_class": name,
        key: 0.5 * (low + high),
        "range": {**entry.get("range", {}), key: [low, high]},
        "estimated": list(dict.fromkeys([*entry["estimated"], key])),
        "source": "; ".join((*sources, f"clearance: middle of the class {name}")),
    }


def known_designation(text: str) -> Designation | None:
    """Read a designation of the catalogue.

    Parameters
    ----------
    text : str
        name of a bearing

    Returns
    -------
    Designation | None
        its parts; None if the text is no designation or the catalogue lacks the size
    """
    read = read_designation(text)
    return read if read is not None and read.basic in estimated_bearings() else None


def _times(ends: tuple[float, float], factor: float) -> tuple[float, float]:
    return ends[0] * factor, ends[1] * factor


def _mm(length: float) -> float:
    return round(length / MM, 4)
