"""A new case file for a bearing by its designation or its boundary dimensions.

The speed factor n d_m chooses speed, loads, oil and cooling: up to `BATH_SPEED_FACTOR` an oil bath
to the middle of the lowest ball, or the grease of a bearing with seals or shields on both sides;
up to `AIR_SPEED_FACTOR` oil and air, which leave no oil for the balls to plough through; beyond it
oil that circulates through a jet and takes the heat along. The oil is the grade whose viscosity at
the temperature where the seats take Palmgren's torque comes nearest to kappa = 2 of ISO 281.
"""

import json
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from math import floor, hypot, isfinite, log, log10, pi, radians
from typing import Any

from oilfilm.bearing.library.bearings import load_catalogue_entry, named_designation
from oilfilm.bearing.library.catalogue import SPINDLE_ANGLE, size_of, with_designation
from oilfilm.bearing.library.designation import Designation, series_and_bore
from oilfilm.bearing.library.lubricants import load_lubricant
from oilfilm.bearing.library.plugins import library_data
from oilfilm.bearing.rating.geometry_estimate import (
    CatalogueData,
    MeasuredStiffness,
    estimate_bearing,
)
from oilfilm.bearing.rating.life import viscosity_ratio
from oilfilm.bearing.torque.skf import palmgren_torque, viscous_factor
from oilfilm.ehl.oil.assumed_heat import heat_of
from oilfilm.ehl.oil.lubricant import Lubricant
from oilfilm.ehl.units import MILLIMETRE, RPM, from_si, to_si

from .format.document import validate_text
from .format.rules import CaseError

TYPICAL = "typical.toml"
FIRST_SPEED_FACTOR = 1.5e5  # n d_m of a new case [mm/min]
SPINDLE_SPEED_FACTOR = (
    6.0e5  # of bearings of machine spindles, series 70 and 719 with 15 or 25 deg
)
# up to which a bath or a seal is usual [mm/min]: makers' limits lie at 3e5 to 6e5 (from memory)
BATH_SPEED_FACTOR = 5.0e5
# up to which oil and air are usual [mm/min] (from memory); above it only a jet takes the heat
AIR_SPEED_FACTOR = 2.0e6
RADIAL_SHARE = 0.05  # loads of a new case over C [-]
RADIAL_SHARE_ANGULAR = 0.02
AXIAL_SHARE = 0.04
AIM_KAPPA = 2.0  # between 1 and 4, where ISO 281 counts films as separating [-]
OIL_TEMPERATURE = to_si("oil_C", 70.0)
AMBIENT = to_si("oil_C", 25.0)
LOAD_TORQUE = 0.0015  # friction coefficient of deep groove bearings by makers (from memory) [-]
HALVINGS = 12  # of the interval of temperatures
GRADES = tuple(f"iso vg {grade}" for grade in (10, 15, 22, 32, 46, 68, 100, 150, 220))
OIL_RISE = 20.0  # of the circulating oil, which sets its flow [K]; assumed
SUPPLY_TEMPERATURE = 40.0  # of circulating oil [C]; assumed

SETS_TEXT = (
    "balls that come into question, of which --bpfo-per-turn or --stiffness of oilfilm init "
    "chooses"
)
RATINGS = ("basic_dynamic_rating_kN", "basic_static_rating_kN")
# keys of the balls and what follows from them
INTERIOR = ("ball_diameter_mm", "balls", "inner_groove_radius_mm", "outer_groove_radius_mm")
SPINDLE_SERIES = ("70", "719")
RIGHT_ANGLE = 90.0  # [deg]
EXAMPLE_SIZE = (25.0, 47.0, 8.0)  # bore, outside diameter and width of an example [mm]
PRECISE = ("P5", "P4", "P2")
PRELOADS = {"DB": ("+x", "-x"), "DF": ("-x", "+x"), "DT": ("+x", "+x")}
# keys of an entry that a case file shows, in this order
SHOWN = tuple(
    (
        "type bore_mm outside_diameter_mm width_mm ball_diameter_mm balls pitch_diameter_mm "
        "inner_groove_radius_mm outer_groove_radius_mm clearance_class diametral_clearance_um "
        "free_contact_angle_deg inner_shoulder_diameter_mm outer_shoulder_diameter_mm "
        "tolerance_class ring_material ball_material basic_dynamic_rating_kN "
        "basic_static_rating_kN skf_series"
    ).split()
)
# choices of the user, not a property that a source could give
KNOWN_CHOICES = tuple(
    (
        "operation.inner_speed_rpm operation.radial_load_N operation.axial_load_N "
        "operation.temperature lubricant.name lubricant.grease friction.lubrication"
    ).split()
)


@dataclass(frozen=True, slots=True, kw_only=True)
class FirstOperation:
    """Speed and loads that the user prescribes for a new case; None: chosen."""

    speed: float | None = None  # of the inner ring [r/min]
    radial_load: float | None = None  # [N]
    axial_load: float | None = None  # [N]
    oil: Mapping[str, str | float] = field(default_factory=dict)  # keys of its data sheet


@dataclass(frozen=True, slots=True, kw_only=True)
class BearingKind:
    """Properties of the bearing on which the choice depends besides its catalogue entry."""

    angular: bool
    spindle: bool  # of a series of machine spindles
    pair: bool  # two bearings that carry axial load both ways
    rows: int  # bearings side by side
    greased: bool  # for life, by its maker


def first_tables(
    entry: Mapping[str, Any], kind: BearingKind, given: FirstOperation
) -> dict[str, dict[str, str]]:
    """Tables [lubricant], [operation] and [friction] of a new case.

    Parameters
    ----------
    entry : Mapping[str, Any]
        The bearing as an entry of the catalogue.
    kind : BearingKind
        Properties of the bearing on which the choice depends.
    given : FirstOperation
        Speed and loads that the user prescribes.

    Returns
    -------
    dict[str, dict[str, str]]
        Values as TOML with a comment, by table and key.
    """
    speed = given.speed
    if speed is None:
        factor = SPINDLE_SPEED_FACTOR if kind.spindle else FIRST_SPEED_FACTOR
        speed = two_digits(factor / entry["pitch_diameter_mm"])
    grade = _grade(entry, kind, speed, given)
    return {
        "lubricant": _lubricant(grade, given.oil, greased=kind.greased),
        "operation": _operation(entry, kind, given, speed),
        "friction": {**_lubrication(entry, kind, speed, grade), **_surroundings(entry, kind)},
    }


def _lubricant(grade: str, sheet: Mapping[str, str | float], *, greased: bool) -> dict[str, str]:
    """The oil of a data sheet, that of a grease, or one of the library."""
    kind = {"grease": '"lithium mineral 100"'} if greased else {}
    if sheet:
        kind |= {key: json.dumps(value) for key, value in sheet.items()}
    elif not greased:
        kind = {"name": f'"{grade}"'}
    return {**kind, "contamination_factor": typical("contamination_factor")}


def _operation(
    entry: Mapping[str, Any], kind: BearingKind, given: FirstOperation, speed: float
) -> dict[str, str]:
    """Speed and loads; an axial load keeps the balls of one bearing of angular contact rolling."""
    capacity = _capacity(entry)
    alone = kind.angular and not kind.pair
    radial = 0.0 if given.axial_load else RADIAL_SHARE_ANGULAR if kind.angular else RADIAL_SHARE
    axial = AXIAL_SHARE if alone else 0.0
    return {
        "inner_speed_rpm": f"{float(speed)!r}" + "  # chosen" * (given.speed is None),
        "radial_load_N": _load(given.radial_load, radial, capacity),
        "axial_load_N": _load(given.axial_load, axial, capacity),
        "temperature_C": "70.0  # where no heat balance is found",
        "temperature": '"self-heated"',
    }


def _load(given: float | None, share: float, capacity: float) -> str:
    """A load [N], or the chosen share of the dynamic rating [N] with a comment."""
    if given is not None:
        return f"{float(given)!r}"
    chosen = f"  # chosen: {share:.0%} of C" if share else ""
    return f"{float(two_digits(share * capacity) if share else 0.0)!r}{chosen}"


def _lubrication(
    entry: Mapping[str, Any], kind: BearingKind, speed: float, grade: str
) -> dict[str, str]:
    """The way the oil comes to the bearing at a speed [r/min]; nothing of a greased bearing."""
    factor = speed * entry["pitch_diameter_mm"]
    if kind.greased:
        return {}
    if factor > AIR_SPEED_FACTOR:
        return _circulation(entry, kind, speed, grade)
    if factor > BATH_SPEED_FACTOR:
        return {"lubrication": '"oil air"'}
    return _bath(entry)


def _bath(entry: Mapping[str, Any]) -> dict[str, str]:
    """Oil to the middle of the lowest ball, as makers advise."""
    level = 0.5 * entry["ball_diameter_mm"]
    return {
        "lubrication": '"oil bath"',
        "oil_level_mm": f"{level:.3g}  # assumed: to the middle of the lowest ball",
    }


def _circulation(
    entry: Mapping[str, Any], kind: BearingKind, speed: float, grade: str
) -> dict[str, str]:
    """A jet whose oil warms by `OIL_RISE` with the heat of Palmgren's viscous torque.

    Share of oil in the cavity X = 1e5 W^0.37/(n d_m^1.7), W in cm^3/min, n in r/min, d_m in mm
    (Parker, NASA TP-2275, 1984, for 0.8 to 8 L/min; read second hand).
    """
    oil = load_lubricant(grade, OIL_TEMPERATURE)
    pitch = entry["pitch_diameter_mm"]
    name = "angular contact" if kind.angular else "deep groove"
    torque, _ = palmgren_torque(
        pitch * MILLIMETRE,
        speed * RPM,
        oil.viscosity / oil.density,
        viscous_factor(name, "oil jet"),
        (0.0, 0.0),
    )
    flow = kind.rows * torque * speed * RPM / (_heat_capacity(oil) * OIL_RISE)
    litres = two_digits(from_si("flow_mL_min", flow))
    share = 1e5 * (litres / kind.rows) ** 0.37 / (speed * pitch**1.7)
    return {
        "lubrication": '"oil jet"',
        "oil_fraction": f"{share:.2g}  # assumed: of the cavity, after Parker (1984)",
        "cooling_oil_mL_min": f"{litres!r}  # assumed: {OIL_RISE:g} K with Palmgren's torque",
        "cooling_oil_C": f"{SUPPLY_TEMPERATURE!r}  # assumed",
    }


def _surroundings(entry: Mapping[str, Any], kind: BearingKind) -> dict[str, str]:
    """Heat that the seats take [W/K], by the surface of ISO 15312, and their temperature."""
    width = entry["width_mm"] * kind.rows
    area = pi * width * (entry["bore_mm"] + entry["outside_diameter_mm"]) * 1e-6
    return {"heat_transfer_W_K": typical("heat_flow_W_m2_K", area), "ambient_C": "25.0"}


def _grade(
    entry: Mapping[str, Any], kind: BearingKind, speed: float, given: FirstOperation
) -> str:
    """Oil of the library nearest to `AIM_KAPPA` at the temperature that it runs at [r/min]."""
    pitch = entry["pitch_diameter_mm"]

    def distance(grade: str) -> float:
        oil = load_lubricant(grade, _running_temperature(grade, entry, kind, speed, given))
        viscosity = oil.viscosity / oil.density
        kappa = viscosity_ratio(viscosity, abs(speed) * RPM, pitch * MILLIMETRE)
        return abs(log(kappa / AIM_KAPPA))

    return min(GRADES, key=distance)


def _running_temperature(
    grade: str, entry: Mapping[str, Any], kind: BearingKind, speed: float, given: FirstOperation
) -> float:
    """Temperature [K] at which the seats take the heat of Palmgren's torque; that of circulating
    oil is `OIL_TEMPERATURE`, and the highest one.
    """
    pitch = entry["pitch_diameter_mm"]
    if speed * pitch > AIR_SPEED_FACTOR:
        return OIL_TEMPERATURE
    name = "angular contact" if kind.angular else "deep groove"
    supply = "oil air" if speed * pitch > BATH_SPEED_FACTOR else "oil bath"
    load = hypot(given.radial_load or 0.0, given.axial_load or 0.0)
    load = load or RADIAL_SHARE * _capacity(entry)
    area = pi * entry["width_mm"] * (entry["bore_mm"] + entry["outside_diameter_mm"]) * 1e-6
    cooling = library_data(TYPICAL)["heat_flow_W_m2_K"]["value"] * area

    def rise(kelvin: float) -> float:
        oil = load_lubricant(grade, kelvin)
        factor = viscous_factor(name, supply)
        viscosity = oil.viscosity / oil.density
        viscous, _ = palmgren_torque(
            pitch * MILLIMETRE, speed * RPM, viscosity, factor, (0.0, 0.0)
        )
        torque = viscous + LOAD_TORQUE * load * 0.5 * pitch * MILLIMETRE
        return torque * speed * RPM / cooling

    low, high = AMBIENT, OIL_TEMPERATURE
    if AMBIENT + rise(high) >= high:
        return high
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if AMBIENT + rise(middle) > middle else (low, middle)
    return high


def _heat_capacity(oil: Lubricant) -> float:
    """rho c [J/(m^3 K)]."""
    return oil.density * heat_of(oil).specific_heat


def _capacity(entry: Mapping[str, Any]) -> float:
    """C [N] as rated, or a rough value, Z^(2/3) D^1.8 times 50 (N, mm), to choose loads by."""
    if "basic_dynamic_rating_kN" in entry:
        return 1e3 * float(entry["basic_dynamic_rating_kN"])
    return float(50.0 * entry["balls"] ** (2.0 / 3.0) * entry["ball_diameter_mm"] ** 1.8)


def typical(key: str, factor: float = 1.0) -> str:
    """A typical value and its range, as a value of TOML with a comment.

    Parameters
    ----------
    key : str
        Name of the value in the library.
    factor : float, default 1.0
        Factor on value and range.

    Returns
    -------
    str
        The text.
    """
    data = library_data(TYPICAL)[key]
    low, high = data["range"]
    value = float(f"{factor * data['value']:.3g}")
    return f"{value!r}  # typical, {factor * low:.3g} to {factor * high:.3g}"


def two_digits(value: float) -> float:
    """Round a positive value to two digits.

    Parameters
    ----------
    value : float
        The value.

    Returns
    -------
    float
        The rounded value; zero if it is not positive.
    """
    if value <= 0.0:
        return 0.0
    step = 10.0 ** (floor(log10(value)) - 1)
    return float(f"{round(value / step) * step:.6g}")


@dataclass(frozen=True, slots=True, kw_only=True)
class BoundaryDimensions:
    """A bearing known from outside: lengths [mm], ratings [kN], nominal contact angle [deg]."""

    bore: float
    outside_diameter: float
    width: float
    dynamic_rating: float | None = None
    static_rating: float | None = None
    contact_angle: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class MakersNumbers:
    """Numbers that a maker prints of a bearing, or that were measured; None: not known."""

    dynamic_rating: float | None = None  # [kN]
    static_rating: float | None = None  # [kN]
    # ball passages of the outer ring in a turn of the inner one [-]
    outer_passages: float | None = None
    stiffness: float | None = None  # along the load of the new case [N/um]

    def stiffness_of(
        self, given: FirstOperation, *, angular: bool = False
    ) -> MeasuredStiffness | None:
        """The stiffness at the loads of a new case.

        Parameters
        ----------
        given : FirstOperation
            Loads that the user prescribes, one of them above zero.
        angular : bool, default False
            Of angular contact, which a radial load alone would not seat.

        Returns
        -------
        MeasuredStiffness | None
            None where none was measured.

        Raises
        ------
        ValueError
            If it is unknown along which load.
        """
        if self.stiffness is None:
            return None
        radial, axial = (given.radial_load or 0.0, given.axial_load or 0.0)
        if (radial > 0.0) == (axial > 0.0) or (angular and axial <= 0.0):
            which = "--axial" if angular else "--radial or --axial"
            raise ValueError(f"--stiffness: needs the load along which it was measured, {which}")
        return MeasuredStiffness(
            stiffness=to_si("stiffness_N_um", self.stiffness), radial_load=radial, axial_load=axial
        )


def case_of_designation(
    name: str, given: FirstOperation, known: MakersNumbers = MakersNumbers()
) -> str:
    """Text of a case file for a bearing of the catalogue.

    Parameters
    ----------
    name : str
        Designation of the bearing.
    given : FirstOperation
        Speed and loads that the user prescribes.
    known : MakersNumbers, default MakersNumbers()
        Ratings and ball passages, in place of the catalogue's.

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
        keys = ("bore_mm", "outside_diameter_mm", "width_mm")
        size = dict(zip(keys, size_of(designation) or (), strict=True))
        entry = _with_normal_clearance({**size, **entry}, designation)
    if "width_mm" not in entry:
        raise ValueError(f"bearing {entry['name']!r}: its source gives no width; {_by_size(name)}")
    entry = _with_makers_numbers(entry, known, given)
    return _text(entry["name"], entry, designation, given)


def _with_makers_numbers(
    entry: dict[str, Any], known: MakersNumbers, given: FirstOperation
) -> dict[str, Any]:
    """The entry with ratings of the user's own, and the balls that explain them where the
    catalogue's are an estimate.
    """
    ratings = (known.dynamic_rating, known.static_rating)
    measured = {"bpfo-per-turn": known.outer_passages, "stiffness": known.stiffness}
    _check_positive({"C": ratings[0], "C0": ratings[1], **measured})
    if not any((*ratings, *measured.values())):
        return entry
    own = dict(zip(RATINGS, ratings, strict=True))
    rated = {key: value for key, value in own.items() if value is not None}
    if "balls" in entry["estimated"]:
        data = CatalogueData(
            bore=1e-3 * entry["bore_mm"],
            outside_diameter=1e-3 * entry["outside_diameter_mm"],
            width=1e-3 * entry["width_mm"],
            contact_angle=radians(entry.get("free_contact_angle_deg") or 0.0),
            pitch_diameter=1e-3 * entry["pitch_diameter_mm"],
            dynamic_rating=_newtons(ratings[0] or entry.get(RATINGS[0])),
            static_rating=_newtons(ratings[1] or entry.get(RATINGS[1])),
        )
        stiffness = known.stiffness_of(given, angular=data.contact_angle > 0.0)
        found = estimate_bearing(data, known.outer_passages, stiffness)
        entry = {**entry, **{key: found[key] for key in (*INTERIOR, "ball_sets")}, "own": True}
        ranges = {key: found["range"][key] for key in INTERIOR}
        entry = {**entry, "range": {**entry["range"], **ranges}}
    elif any(measured.values()):
        name = next(key for key, value in measured.items() if value)
        raise ValueError(f"--{name}: the balls of {entry['name']} are not estimated")
    told = "; C, C_0 as given to oilfilm init" * bool(rated)
    told += "; balls by what was measured" * any(measured.values())
    return {**entry, **rated, "source": f"{entry['source']}{told}"}


def _newtons(rating: float | None) -> float | None:
    """A rating [kN] in newtons."""
    return None if rating is None else 1e3 * rating


def _by_size(name: str) -> str:
    """How to make the case by size, with the dimensions of this bearing where they are known."""
    begins = series_and_bore(name)
    bore, outside, width = (begins and size_of(begins)) or EXAMPLE_SIZE
    return (
        f"a bearing by its size: oilfilm init NAME --bore {bore:g} --outside {outside:g} "
        f"--width {width:g} [mm], with --angle 30 if of angular contact [deg], --C and --C0 if "
        "known [kN]"
    )


def case_of_dimensions(
    size: BoundaryDimensions, given: FirstOperation, known: MakersNumbers = MakersNumbers()
) -> str:
    """Text of a case file for a bearing whose internal geometry is estimated.

    Parameters
    ----------
    size : BoundaryDimensions
        Boundary dimensions [mm], ratings [kN] and contact angle [deg].
    given : FirstOperation
        Speed and loads that the user prescribes.
    known : MakersNumbers, default MakersNumbers()
        Ball passages and stiffness that were measured.

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
    _check_positive({"bpfo-per-turn": known.outer_passages, "stiffness": known.stiffness})
    entry = estimate_bearing(
        CatalogueData(
            bore=1e-3 * size.bore,
            outside_diameter=1e-3 * size.outside_diameter,
            width=1e-3 * size.width,
            contact_angle=radians(size.contact_angle),
            dynamic_rating=_newtons(size.dynamic_rating),
            static_rating=_newtons(size.static_rating),
        ),
        known.outer_passages,
        known.stiffness_of(given, angular=size.contact_angle > 0.0),
    )
    name = f"{size.bore:g} x {size.outside_diameter:g} x {size.width:g}"
    return _text(name, entry, None, given)


def _check_size(size: BoundaryDimensions) -> None:
    """ValueError that names the option whose value makes no bearing, in its unit."""
    lengths = {"bore": size.bore, "outside": size.outside_diameter, "width": size.width}
    _check_positive(lengths | {"C": size.dynamic_rating, "C0": size.static_rating})
    if size.outside_diameter <= size.bore:
        found = f"--outside: found {size.outside_diameter:g} mm"
        raise ValueError(f"{found}; allowed: above --bore, {size.bore:g} mm")
    if not 0.0 <= size.contact_angle < RIGHT_ANGLE:
        raise ValueError(f"--angle: found {size.contact_angle:g} deg; allowed: from 0, below 90")


def _check_positive(options: Mapping[str, float | None]) -> None:
    for key, value in options.items():
        if value is not None and not (isfinite(value) and value > 0.0):
            raise ValueError(f"--{key}: found {value:g}; allowed: above 0")


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
    estimated = entry["estimated"] if designation is None or "own" in entry else ()
    assumed = [f"bearing.{key}" for key in estimated]
    keys = [*assumed, *(f"{table}.{key}" for table, rows in tables.items() for key in rows)]
    known = (*KNOWN_CHOICES, *(f"lubricant.{key}" for key in given.oil))
    lines = [
        "schema_version = 1",
        f'title = "{name}"',
        f'source = "bearing: {_escaped(entry["source"])}"',
        "assumed = [",
        *(f'    "{key}",' for key in keys if key not in known),
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
        if key == "balls" and len(entry.get("ball_sets", ())) > 1:
            yield f"# {SETS_TEXT}: {', '.join(entry['ball_sets'])}"


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
