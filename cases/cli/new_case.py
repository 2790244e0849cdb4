"""A new case file for a bearing by its designation or its boundary dimensions."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import floor, log10, pi, radians
from typing import Any

from bearing.library.bearings import load_catalogue_entry, named_designation
from bearing.library.designation import Designation
from bearing.library.names import library_data
from bearing.rating.geometry_estimate import CatalogueData, estimate_bearing

TYPICAL = "typical.toml"
SPEED_FACTOR = 1.5e5  # n d_m of a new case [mm/min]
RADIAL_SHARE = 0.05  # loads of a new case over C [-]
RADIAL_SHARE_ANGULAR = 0.02
AXIAL_SHARE = 0.04
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


def case_of_designation(name: str) -> str:
    """Text of a case file for a bearing of the catalogue; ValueError for an unknown name."""
    entry = load_catalogue_entry(name)
    return _text(entry["name"], entry, named_designation(entry["name"]), assumed=())


def case_of_dimensions(size: BoundaryDimensions) -> str:
    """Text of a case file for a bearing whose internal geometry is estimated [mm, kN, deg];
    ValueError names what is impossible.
    """
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
    return _text(name, entry, None, assumed=[f"bearing.{key}" for key in entry["estimated"]])


def _text(
    name: str,
    entry: Mapping[str, Any],
    designation: Designation | None,
    assumed: list[str] | tuple[()],
) -> str:
    tables = _tables(entry, designation)
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
    entry: Mapping[str, Any], designation: Designation | None
) -> dict[str, dict[str, str]]:
    """The other tables: a speed and loads to start from, and what is typical, with its range."""
    capacity = _capacity(entry)
    pitch = entry["pitch_diameter_mm"]
    angular = entry["type"] == "angular contact"
    pair = designation is not None and designation.arrangement in ("DB", "DF")
    radial = RADIAL_SHARE_ANGULAR if angular and not pair else RADIAL_SHARE
    operation = {
        "inner_speed_rpm": f"{_rounded(SPEED_FACTOR / pitch):.1f}",
        "radial_load_N": f"{_rounded(radial * capacity):.1f}",
        "axial_load_N": f"{_rounded(AXIAL_SHARE * capacity if angular and not pair else 0.0):.1f}",
        "temperature_C": "70.0  # where no heat balance is found",
        "temperature": '"self-heated"',
    }
    sealed = designation is not None and designation.sealed
    lubricant = {"grease": '"lithium mineral 100"'} if sealed else {"name": '"iso vg 68"'}
    lubricant["contamination_factor"] = _typical("contamination_factor")
    width = entry["width_mm"] * (2.0 if _is_set(designation) else 1.0)
    area = pi * width * (entry["bore_mm"] + entry["outside_diameter_mm"]) * 1e-6
    friction = {} if sealed else {"lubrication": '"oil bath"'}
    friction |= {"heat_transfer_W_K": _typical("heat_flow_W_m2_K", area), "ambient_C": "25.0"}
    race = "race_roughness_um"
    if entry.get("tolerance_class") in PRECISE:
        race = "precision_race_roughness_um"
    steel = entry["ball_material"] == "bearing steel"
    surface = {
        "inner_ring_roughness_um": _typical(race),
        "outer_ring_roughness_um": _typical(race),
        "ball_roughness_um": _typical(
            "ball_roughness_um" if steel else "ceramic_ball_roughness_um"
        ),
    }
    return {
        "lubricant": lubricant,
        "operation": operation,
        "surface": surface,
        "friction": friction,
    }


def _is_set(designation: Designation | None) -> bool:
    """Whether it names two bearings side by side."""
    return designation is not None and designation.arrangement in PRELOADS


def _rows(entry: Mapping[str, Any], designation: Designation | None) -> list[str]:
    """[[rows]] of a set of two."""
    if designation is None or not _is_set(designation):
        return []
    lines = []
    half = 0.5 * float(entry["width_mm"])
    preload = designation.preload_class or "light"
    for position, sense in zip((-half, half), PRELOADS[designation.arrangement], strict=True):
        lines += ["[[rows]]", f"axial_position_mm = {position:g}", f'loaded_by = "{sense}"']
        lines += [f'preload_class = "{preload}"', ""]
    return lines


def _capacity(entry: Mapping[str, Any]) -> float:
    """C [N] as rated, or a rough value, Z^(2/3) D^1.8 times 50 (N, mm), to choose loads by."""
    if "basic_dynamic_rating_kN" in entry:
        return 1e3 * float(entry["basic_dynamic_rating_kN"])
    return float(50.0 * entry["balls"] ** (2.0 / 3.0) * entry["ball_diameter_mm"] ** 1.8)


def _typical(key: str, factor: float = 1.0) -> str:
    """A typical value and its range, as a value of TOML with a comment."""
    data = library_data(TYPICAL)[key]
    low, high = data["range"]
    value = float(f"{factor * data['value']:.3g}")
    return f"{value!r}  # typical, {factor * low:.3g} to {factor * high:.3g}"


def _rounded(value: float) -> float:
    """To two digits."""
    if value <= 0.0:
        return 0.0
    step = 10.0 ** (floor(log10(value)) - 1)
    return round(value / step) * step


def _escaped(text: str) -> str:
    return text.replace("\\", "\\\\").replace('"', '\\"')
