"""[bearing] and [surface]: geometry and materials of the bearing."""

import warnings
from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import acos, asin, cos, degrees, floor, hypot, pi, radians
from typing import Annotated

from oilfilm.bearing.films.asperities import LoadSharing, Spectrum
from oilfilm.bearing.geometry import (
    ANGULAR_CONTACT,
    Bearing,
    BearingType,
    contact_angle_to_clearance,
)
from oilfilm.bearing.library.bearings import TOLERANCE_CLASSES
from oilfilm.bearing.library.catalogue import CLEARANCE_CLASSES, clearance_class
from oilfilm.bearing.library.plugins import library_data
from oilfilm.bearing.material import Material, MaterialKind
from oilfilm.bearing.operation import RatingInput
from oilfilm.bearing.torque.skf import Series, series_of, skf_series
from oilfilm.ehl.units import MICROMETRE, from_si, to_si

from .fields import Name, OneOf, Table, above, between, described, length, within
from .rules import Below, CaseProblem, CaseValues, Needs, Where, bounded, shown, together

TYPICAL = "typical.toml"
RACES = ("race_roughness_um", "precision_race_roughness_um")
BALLS = ("ball_roughness_um", "ceramic_ball_roughness_um")
# keys of the roughness, with the typical values that they may have
ROUGHNESS = {
    "inner_ring_roughness_um": RACES,
    "outer_ring_roughness_um": RACES,
    "ball_roughness_um": BALLS,
}


class BearingTable(Table):
    """Geometry and materials of the bearing."""

    name: Name | None = described(
        "entry of the catalogue or designation, as 6205-2RS C3; the keys below override it"
    )
    type: Annotated[str, OneOf(BearingType)] | None = described(
        "else by name or skf_series; without these angular contact above 14.25 deg unloaded"
    )
    ball_diameter_mm: float | None = length("diameter of the balls")
    pitch_diameter_mm: float | None = length("diameter of the circle of the ball centres")
    balls: int | None = between(3, 1000, "number of balls")
    inner_groove_radius_mm: float | None = length("radius of the inner raceway in section")
    outer_groove_radius_mm: float | None = length("radius of the outer raceway in section")
    diametral_clearance_um: float | None = between(
        -1e3, 1e4, "radial internal clearance on the diameter; or free_contact_angle_deg"
    )
    free_contact_angle_deg: float | None = between(0, 80, "unloaded; or diametral_clearance_um")
    clearance_class: Annotated[str, OneOf(*CLEARANCE_CLASSES)] | None = described(
        "of a deep groove bearing, ISO 5753-1: the clearance is its middle; needs bore_mm"
    )
    ring_material: Name | None = described("material of both rings")
    inner_ring_material: Name | None = described("material of the inner ring where it differs")
    outer_ring_material: Name | None = described("material of the outer ring where it differs")
    ball_material: Name | None = described("material of the balls")
    cage_material: Name | None = described("for the simulation and the cage's thermal growth")
    tolerance_class: Annotated[str, OneOf(*TOLERANCE_CLASSES)] | None = described(
        "of bore and outside diameter, ISO 492; for the fits of [fit]"
    )
    first_ball_azimuth_deg: float = within(360, "azimuth of ball 1 from the load line", 0.0)
    bore_mm: float | None = length("bore diameter")
    outside_diameter_mm: float | None = length("outside diameter")
    width_mm: float | None = length("width of the rings")
    inner_shoulder_diameter_mm: float | None = length("inner lands, for the cut of ellipses")
    outer_shoulder_diameter_mm: float | None = length("outer lands, for the cut of ellipses")
    nominal_contact_angle_deg: float | None = between(
        0, 80, "of the rating life; default: free_contact_angle_deg, else the catalogue's, or 0"
    )
    basic_dynamic_rating_kN: float | None = above(0, 1e6, "catalogue C_r; else from the geometry")
    basic_static_rating_kN: float | None = above(0, 1e6, "catalogue C_0; else from the geometry")
    reliability_percent: float = between(
        90, 99.9, "of the modified rating life, a_1 of ISO 281", 90.0
    )
    skf_series: Name | None = described("of SKF's friction constants; else by designation in name")


class SurfaceTable(Table):
    """Root-mean-square roughness; without the table typical values, which the results name."""

    inner_ring_roughness_um: float | None = between(
        0, 100, "rms roughness of the inner raceway; default typical"
    )
    outer_ring_roughness_um: float | None = between(
        0, 100, "rms roughness of the outer raceway; default typical"
    )
    ball_roughness_um: float | None = between(
        0, 100, "rms roughness of the balls; default typical"
    )
    load_sharing: Annotated[str, OneOf(LoadSharing)] = described(
        "of asperities and film, by the central film over the roughness", "zhou-hoeprich"
    )
    shortest_wavelength_um: float | None = above(
        0, 1e4, "of the roughness; with the longest, the film flattens long waves"
    )
    longest_wavelength_um: float | None = above(0, 1e4, "of the roughness; its cut-off")
    hurst_exponent: float = between(0, 1, "of the roughness between them; assumed", 0.8)
    kappa_exponent: float = above(0, 5, "kappa = lambda to this power; 1.3 is unverified", 1.3)


GEOMETRY = (
    *("ball_diameter_mm", "pitch_diameter_mm", "balls"),
    *("inner_groove_radius_mm", "outer_groove_radius_mm"),
)
DIMENSIONS = tuple(  # that may be left out
    (
        "first_ball_azimuth_deg bore_mm outside_diameter_mm width_mm inner_shoulder_diameter_mm "
        "outer_shoulder_diameter_mm"
    ).split()
)
RING_MATERIALS = ("inner_ring_material", "outer_ring_material")
CLEARANCE = ("diametral_clearance_um", "free_contact_angle_deg")
# a case gives one of a row
ALTERNATIVES = ((*CLEARANCE, "clearance_class"), ("ring_material", *RING_MATERIALS))
CLEARANCE_AGREEMENT_UM = 0.5  # clearance and contact angle agree within this, or within 1 %
RELATIONS = (
    *(
        Needs(f"bearing.{name}", Where("bearing"), "needed unless the catalogue entry has it")
        for name in (*GEOMETRY, "ball_material")
    ),
    Needs("bearing.cage_material", Where("temperatures.cage_C")),
    *together("surface.longest_wavelength_um", "surface.shortest_wavelength_um"),
    Below("surface.shortest_wavelength_um", "surface.longest_wavelength_um"),
    *(
        Needs(
            "bearing.ring_material", Where("bearing"), "needed: a material", (f"bearing.{ring}",)
        )
        for ring in RING_MATERIALS
    ),
    Needs(
        f"bearing.{CLEARANCE[0]}",
        Where("bearing"),
        f"needed: {' or '.join(CLEARANCE)}",
        (f"bearing.{CLEARANCE[1]}", "bearing.clearance_class"),
    ),
    Needs("bearing.bore_mm", Where("bearing.clearance_class")),
)


def faults(values: CaseValues) -> Iterator[CaseProblem]:
    """Conflicts of [bearing] beyond its relations: parts that do not fit together, a wrong series.

    Parameters
    ----------
    values : CaseValues
        The valid values of the file.

    Yields
    ------
    Iterator[CaseProblem]
        The problems.
    """
    yield from _clearance_faults(values)
    yield from _class_faults(values)
    yield from _dimension_faults(values)
    yield from _series_faults(values)


def _dimension_faults(values: CaseValues) -> Iterator[CaseProblem]:
    """Grooves, balls, bore, outside diameter and shoulders that fit together."""
    diameter = values.get("bearing", "ball_diameter_mm")
    pitch = values.get("bearing", "pitch_diameter_mm")
    if diameter is None:
        return
    radius = 0.5 * diameter
    allowed = f"above the ball radius, {radius:g} mm, up to the ball diameter, {diameter:g} mm"
    for ring in ("inner", "outer"):
        key = f"bearing.{ring}_groove_radius_mm"
        yield from bounded(values, key, lambda x: radius < x <= diameter, allowed)
    if pitch is None:
        return
    allowed = f"more than the ball diameter, {diameter:g} mm"
    yield from bounded(values, "bearing.pitch_diameter_mm", lambda x: x > diameter, allowed)
    # diameters of the raceways
    inner = pitch - diameter
    outer = pitch + diameter
    if inner > 0.0:
        most = floor(pi / asin(diameter / pitch) + 1e-9)
        allowed = f"at most {most} balls of {diameter:g} mm on a pitch circle of {pitch:g} mm"
        yield from bounded(values, "bearing.balls", lambda x: x <= most, allowed)
        allowed = f"less than the inner raceway's diameter, {inner:g} mm"
        yield from bounded(values, "bearing.bore_mm", lambda x: x < inner, allowed)
        for ring, low, high in (("inner", inner, pitch), ("outer", pitch, outer)):
            allowed = f"between {low:g} and {high:g} mm, raceway and pitch circle"
            key = f"bearing.{ring}_shoulder_diameter_mm"
            yield from bounded(values, key, lambda x: low < x < high, allowed)  # noqa: B023
    allowed = f"more than the outer raceway's diameter, {outer:g} mm"
    yield from bounded(values, "bearing.outside_diameter_mm", lambda x: x > outer, allowed)


def _clearance_faults(values: CaseValues) -> Iterator[CaseProblem]:
    """cos(alpha_0) = 1 - P_d/(2 A), A = r_i + r_o - D; both are given only if they agree."""
    distance = _groove_distance(values)
    clearance, angle = (values.get("bearing", name) for name in CLEARANCE)
    if distance is None or distance <= 0.0 or clearance is None:
        return
    if not -distance < clearance < 2.0 * distance:
        allowed = (
            f"allowed: from {-distance:.6g} to {2 * distance:.6g} um with these grooves, "
            "ends excluded"
        )
        finding = f"found {shown(clearance)}"
        yield CaseProblem(("bearing", CLEARANCE[0]), finding, allowed)
    elif angle is not None:
        expected = 2.0 * distance * (1.0 - cos(radians(angle)))
        if abs(clearance - expected) > max(CLEARANCE_AGREEMENT_UM, 0.01 * abs(expected)):
            derived = degrees(acos(min(1.0, 1.0 - 0.5 * clearance / distance)))
            finding = f"found {shown(angle)} together with {CLEARANCE[0]} = {shown(clearance)}"
            allowed = (
                f"allowed: one of them, or {derived:.4g} deg with this clearance, "
                f"{expected:.5g} um with this angle"
            )
            yield CaseProblem(("bearing", CLEARANCE[1]), finding, allowed)


def _groove_distance(values: CaseValues) -> float | None:
    """Distance of the grooves' centres of curvature, r_i + r_o - D [um]; None where not known."""
    keys = ("ball_diameter_mm", "inner_groove_radius_mm", "outer_groove_radius_mm")
    ball, inner, outer = (to_si(key, values.get("bearing", key)) for key in keys)
    if None in (ball, inner, outer):
        return None
    return float(from_si(CLEARANCE[0], inner + outer - ball))


def _class_faults(values: CaseValues) -> Iterator[CaseProblem]:
    """A clearance class is one of deep groove bearings, and a clearance beside it lies in it."""
    name, bore = (values.get("bearing", key) for key in ("clearance_class", "bore_mm"))
    if name is None or bore is None:
        return
    path = ("bearing", "clearance_class")
    if values.get("bearing", "type") == BearingType.ANGULAR_CONTACT.value:
        finding = f"found {shown(name)} for an angular contact bearing"
        yield CaseProblem(path, finding, "allowed: free_contact_angle_deg")
        return
    try:
        low, high = clearance_class(bore, name)
    except ValueError:
        finding = f"found {shown(name)} with bore_mm = {shown(bore)}"
        yield CaseProblem(path, finding, "allowed: with bores above 2.5 mm, up to 120 mm")
        return
    clearance = values.get("bearing", CLEARANCE[0])
    if clearance is not None and not low <= clearance <= high:
        finding = f"found {shown(name)} together with {CLEARANCE[0]} = {shown(clearance)}"
        yield CaseProblem(path, finding, f"allowed: one of them, or {low:g} to {high:g} um")


def _series_faults(values: CaseValues) -> Iterator[CaseProblem]:
    """A series of SKF's friction model, of the type of the bearing where that is known."""
    given = values.get("bearing", "skf_series")
    if given is None:
        return
    finding = f"found {shown(given)}"
    allowed = [name for kind in Series for name in skf_series(kind)]
    kind, how = _known_type(values)
    if kind is not None:
        allowed = list(skf_series(Series(kind.replace(" ", "_"))))
        finding += f" for {'an' if kind.startswith('a') else 'a'} {kind} bearing{how}"
    if given not in allowed:
        listed = f"allowed: {', '.join(allowed)}"
        yield CaseProblem(("bearing", "skf_series"), finding, listed)


def _known_type(values: CaseValues) -> tuple[str | None, str]:
    """Type as given, or deep groove by a small free contact angle; and how it is known."""
    given = values.get("bearing", "type")
    angle = _free_angle(values)
    # fits and temperatures change the clearance
    changed = any(values.given(table) for table in ("fit", "temperatures"))
    if given is None and angle is not None and radians(angle) <= ANGULAR_CONTACT and not changed:
        return BearingType.DEEP_GROOVE.value, f", its free contact angle being {angle:.4g} deg"
    return given, ""


def _free_angle(values: CaseValues) -> float | None:
    """Free contact angle [deg], as given or from the clearance; None where that is not known."""
    clearance, angle = (values.get("bearing", name) for name in CLEARANCE)
    distance = _groove_distance(values)
    if angle is not None or distance is None or clearance is None:
        return angle
    cosine = 1.0 - 0.5 * clearance / max(distance, 1e-6)
    return degrees(acos(min(1.0, cosine))) if cosine > -1.0 else None


def material_names(table: BearingTable) -> tuple[str, str, str]:
    """Names of the materials of balls, inner ring and outer ring.

    Parameters
    ----------
    table : BearingTable
        The checked table.

    Returns
    -------
    tuple[str, str, str]
        The three names.
    """
    inner = table.inner_ring_material or table.ring_material
    outer = table.outer_ring_material or table.ring_material
    assert table.ball_material and inner and outer  # checked before
    return table.ball_material, inner, outer


def bearing(table: BearingTable, materials: dict[str, Material], title: str) -> Bearing:
    """Geometry and materials of the bearing.

    Parameters
    ----------
    table : BearingTable
        The checked table.
    materials : dict[str, Material]
        Materials by name.
    title : str
        Name of the bearing where the table has none.

    Returns
    -------
    Bearing
        The bearing, SI.
    """
    ball, inner, outer = material_names(table)
    delivered = Bearing(
        name=table.name or title or "bearing",
        diametral_clearance=_clearance(table),
        ball_material=materials[ball],
        inner_ring_material=materials[inner],
        outer_ring_material=materials[outer],
        **table.si(*GEOMETRY, *DIMENSIONS),
    )
    return replace(delivered, type=_type(table, delivered))


def _type(table: BearingTable, delivered: Bearing) -> BearingType:
    """Type as given, by the series, or by the free contact angle before mounting, with a warning
    where a clearance makes that large.
    """
    if table.type is not None:
        return BearingType(table.type)
    series = table.skf_series or series_of(table.name or "")
    if series is not None:
        deep = series in skf_series(Series.DEEP_GROOVE)
        return BearingType.DEEP_GROOVE if deep else BearingType.ANGULAR_CONTACT
    if not delivered.angular_contact:
        return BearingType.DEEP_GROOVE
    if table.free_contact_angle_deg is None:
        text = (
            "bearing.type is not given: taken as angular contact, since the clearance gives a "
            f"free contact angle of {degrees(delivered.free_contact_angle):.3g} deg, above "
            f"{degrees(ANGULAR_CONTACT):g}; give 'deep groove' if it is one"
        )
        warnings.warn(text, stacklevel=2)
    return BearingType.ANGULAR_CONTACT


def _clearance(table: BearingTable) -> float:
    """The diametral clearance, the middle of its class, or that of the contact angle [m]."""
    si = table.si()
    if si["diametral_clearance"] is not None:
        return float(si["diametral_clearance"])
    if table.clearance_class is not None and table.bore_mm is not None:
        return 0.5 * sum(clearance_class(table.bore_mm, table.clearance_class)) * MICROMETRE
    lengths = ("inner_groove_radius", "outer_groove_radius", "ball_diameter")
    return contact_angle_to_clearance(si["free_contact_angle"], *(si[name] for name in lengths))


def nominal_contact_angle(table: BearingTable) -> float:
    """Nominal contact angle: as given, else the free one, else zero.

    Parameters
    ----------
    table : BearingTable
        The checked table.

    Returns
    -------
    float
        The angle [rad].
    """
    si = table.si()
    nominal = si["nominal_contact_angle"]
    return float(si["free_contact_angle"] or 0.0 if nominal is None else nominal)


def rating(table: BearingTable, contamination_factor: float | None) -> RatingInput:
    """Inputs of the rating life.

    Parameters
    ----------
    table : BearingTable
        The checked table.
    contamination_factor : float | None
        e_C of ISO 281 [-].

    Returns
    -------
    RatingInput
        Ratings [N] and nominal contact angle [rad].
    """
    angle = nominal_contact_angle(table)
    return table.build(
        RatingInput,
        "basic",
        reliability=table.reliability_percent,
        nominal_contact_angle=angle,
        contamination_factor=contamination_factor,
    )


def spectrum(table: SurfaceTable | None) -> Spectrum | None:
    """Wavelengths of the roughness.

    Parameters
    ----------
    table : SurfaceTable | None
        The checked table [surface], where there is one.

    Returns
    -------
    Spectrum | None
        The wavelengths [m]; None where they are not given.
    """
    if table is None or table.shortest_wavelength_um is None:
        return None
    si = table.si("shortest_wavelength_um", "longest_wavelength_um")
    return Spectrum(
        shortest=si["shortest_wavelength"],
        longest=si["longest_wavelength"],
        hurst=table.hurst_exponent,
    )


def with_typical_roughness(
    table: SurfaceTable | None, assumed: Sequence[str], ball: Material
) -> tuple[SurfaceTable, tuple[str, ...]]:
    """Typical roughness of ground races and of balls, where a case gives none; warns of it, also
    where a case has it and names it as assumed.

    Parameters
    ----------
    table : SurfaceTable | None
        The checked table [surface], where there is one.
    assumed : Sequence[str]
        Keys of the case whose values no source gives.
    ball : Material
        Material of the balls.

    Returns
    -------
    table : SurfaceTable
        Roughness of races and balls [um].
    added : tuple[str, ...]
        Keys that the case does not give.
    """
    given = table or SurfaceTable()
    steel = ball.kind is MaterialKind.BEARING_STEEL
    library = library_data(TYPICAL)
    race = library[RACES[0]]
    balls = library[BALLS[0 if steel else 1]]
    typical = dict(zip(ROUGHNESS, (race, race, balls), strict=True))
    added = tuple(key for key in ROUGHNESS if getattr(given, key) is None)
    named = {
        key
        for key, one in typical.items()
        if key in added or (f"surface.{key}" in assumed and getattr(given, key) == one["value"])
    }
    inner, outer, of_balls = (key in named for key in ROUGHNESS)
    races = "races" if inner and outer else "inner ring" if inner else "outer ring"
    texts = [
        f"{name} {one['value']:g} um ({one['range'][0]:g} to {one['range'][1]:g})"
        for name, one, wanted in ((races, race, inner or outer), ("balls", balls, of_balls))
        if wanted
    ]
    if texts:
        told = f"surface: rms roughness assumed, typical: {', '.join(texts)}"
        warnings.warn(told, stacklevel=2)
    return given.model_copy(update={key: typical[key]["value"] for key in added}), added


def roughness(table: SurfaceTable | None) -> tuple[float, float] | None:
    """Root mean square of race and balls together.

    Parameters
    ----------
    table : SurfaceTable | None
        The checked table [surface], where there is one.

    Returns
    -------
    tuple[float, float] | None
        Inner and outer race [m]; None without [surface].
    """
    if table is None:
        return None
    return _together(*(getattr(table, key) for key in ROUGHNESS))


def roughness_ends(
    table: SurfaceTable | None, assumed: Sequence[str]
) -> tuple[tuple[float, float], ...]:
    """Roughness at both ends of the typical ranges of what the case assumes.

    Parameters
    ----------
    table : SurfaceTable | None
        The checked table [surface], where there is one.
    assumed : Sequence[str]
        Keys of the case whose values no source gives.

    Returns
    -------
    tuple[tuple[float, float], ...]
        Inner and outer race at the low and the high end [m]; empty where nothing is assumed.
    """
    if table is None:
        return ()
    library = library_data(TYPICAL)
    ranges = []
    for key, kinds in ROUGHNESS.items():
        value = getattr(table, key)
        known = [library[kind]["range"] for kind in kinds if library[kind]["value"] == value]
        ranges.append(known[0] if known and f"surface.{key}" in assumed else (value, value))
    ends = [_together(*end) for end in zip(*ranges, strict=True)]
    return () if ends[0] == ends[1] else tuple(ends)


def _together(inner: float, outer: float, ball: float) -> tuple[float, float]:
    """Rms of inner race and ball, outer race and ball [m], of each [um]."""
    return hypot(inner, ball) * MICROMETRE, hypot(outer, ball) * MICROMETRE
