"""Write the tables of docs/reference/library.md from the data of the libraries."""

from __future__ import annotations

import importlib
import sys
from collections import defaultdict
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from oilfilm.bearing import list_lubricants, list_materials, load_catalogue_entry, load_lubricant, typical_geometry
from oilfilm.bearing.library.bearings import published_bearings
from oilfilm.bearing.library.catalogue import CLEARANCE_CLASSES
from oilfilm.bearing.library.catalogue import table as rows_of
from oilfilm.bearing.library.designation import read_designation
from oilfilm.bearing.library.lubricants import PROPERTIES, lubricant_data
from oilfilm.bearing.material import FIELDS, material_data

DOCS = Path(__file__).parents[2] / "docs"
PAGE = DOCS / "reference" / "library.md"
MARK = "<!-- {}: written by tools/docs/libraries.py -->"
END = "<!-- end -->"
UNVERIFIED_6203 = "Case Western Reserve University: 0.2656 and 1.122 in (from memory, unverified)"
KNOWN = (  # row of the ratings, balls, ball and pitch diameter [mm], where from
    ("6203", 8, 6.746, 28.50, UNVERIFIED_6203),
    ("6205", 9, 7.940, 39.04, "Case Western Reserve University: 0.3126 and 1.537 in"),
    ("6206", 9, 9.525, 46.00, "catalogue entry 6206"),
    ("6207", 9, 11.12, 53.50, "catalogue entry 6207"),
    ("6208", 9, 12.00, 60.00, "catalogue entry 6208"),
    ("6304", 7, 9.52, 36.01, "catalogue entry 6304"),
    ("7218B", 16, 22.23, 125.26, "textbook 218, 40°"),
    ("6209", 9, 12.70, 65.00, "textbook 209: another design than the maker's 6209"),
    ("7000C", 10, 4.485, 18.00, "catalogue entry 7000C: another design than the maker's"),
    ("7008C", 18, 7.00, 54.00, "catalogue entry 7008: another design than the maker's"),
)  # fmt: skip


def tool(name: str) -> Any:
    """A module of tools/, which is not on the path of a script in tools/docs."""
    folder = str(Path(__file__).parents[1])
    if folder not in sys.path:
        sys.path.append(folder)
    return importlib.import_module(name)


def table(header: Sequence[str], rows: Iterator[Sequence[str]]) -> str:
    """A Markdown table."""
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join([*lines, *("| " + " | ".join(row) + " |" for row in rows)])


def checks() -> Iterator[Sequence[str]]:
    """Estimates beside known geometries."""
    script = tool("catalogue_geometry")
    for name, balls, ball, pitch, source in KNOWN:
        row = script.rows()[name]
        estimate = script.estimate(row)
        own, pitch_found = 1e3 * estimate.ball_diameter, 1e3 * script.data(row).pitch
        errors = f"{100 * (own / ball - 1):+.1f} %", f"{100 * (pitch_found / pitch - 1):+.1f} %"
        yield (
            name,
            f"{balls} × {ball:g} on {pitch:g}",
            f"{estimate.balls} × {own:.4g} on {pitch_found:.4g}",
            *errors,
            source,
        )


def fit() -> Iterator[Sequence[str]]:
    """How well the ratings are met, and what the guess without ratings misses."""
    script = tool("catalogue_geometry")
    groups = (("618", ""), ("619", ""), ("60 62 63", ""), ("719 70 72", "C"), ("719", "AC"), ("72 73", "B"))
    for series, suffix in groups:
        prefixes = tuple(series.split())
        rows = [row for name, row in script.rows().items() if _is_of(name, prefixes, suffix)]
        estimates = [script.estimate(row) for row in rows]
        guesses = [guess(row) for row in rows]
        dynamic, static = [e.dynamic_error for e in estimates], [e.static_error for e in estimates]
        ball = [g[0] / e.ball_diameter - 1.0 for g, e in zip(guesses, estimates, strict=True)]
        number = [g[2] - e.balls for g, e in zip(guesses, estimates, strict=True)]
        yield (
            f"{series} {suffix}".strip(),
            str(len(rows)),
            f"{100 * min(dynamic):+.1f} to {100 * max(dynamic):+.1f} %",
            f"{100 * min(static):+.1f} to {100 * max(static):+.1f} %",
            f"{100 * max(e.misfit for e in estimates):.1f} %",
            f"{100 * min(e.next_misfit for e in estimates):.1f} %",
            f"{100 * min(ball):+.0f} to {100 * max(ball):+.0f} %",
            f"{min(number):+d} to {max(number):+d}",
        )


def _is_of(name: str, prefixes: tuple[str, ...], suffix: str) -> bool:
    """Whether a designation belongs to one of these series, with this contact angle."""
    designation = read_designation(name)
    assert designation is not None
    return designation.series in prefixes and designation.angle_suffix == suffix


def guess(row: dict[str, str]) -> tuple[float, float, int]:
    """Geometry from the boundary dimensions alone [m]."""
    data = tool("catalogue_geometry").data(row)
    return typical_geometry(data.bore, data.outside_diameter, data.contact_angle)


def bearings() -> Iterator[Sequence[str]]:
    """Published bearings."""
    for name in published_bearings():
        entry = load_catalogue_entry(name)
        size = [entry.get(key) for key in ("bore_mm", "outside_diameter_mm", "width_mm")]
        boundary = " × ".join("–" if value is None else f"{value:g}" for value in size)
        rating = [entry.get(f"basic_{kind}_rating_kN") for kind in ("dynamic", "static")]
        angle, clearance = entry.get("free_contact_angle_deg"), entry.get("diametral_clearance_um")
        yield (
            name,
            boundary,
            " / ".join("–" if value is None else f"{value:g}" for value in rating),
            f"{entry['balls']} × {entry['ball_diameter_mm']:g} on {entry['pitch_diameter_mm']:g}",
            f"{angle:g}°" if angle else f"{clearance:g} µm",
        )


def clearances() -> Iterator[Sequence[str]]:
    """Classes of radial internal clearance by bore."""
    for row in rows_of("clearance_classes.csv"):
        ends = [f"{row[f'{name}_from_um']}–{row[f'{name}_to_um']}" for name in CLEARANCE_CLASSES]
        yield f"{row['bore_over_mm']}–{row['bore_up_to_mm']}", *ends


def materials() -> Iterator[Sequence[str]]:
    """Every material, names of one material in a row; a dagger where no source was read."""
    names_of: dict[tuple[str, ...], list[str]] = defaultdict(list)
    for name in list_materials():
        data = material_data(name)
        cells = [str(data["kind"])]
        for key in FIELDS.values():
            number = data.get(key)
            low, high = number["range"] if number else (0.0, 0.0)
            cells.append("–" if not number else f"{number['value']:g} ({low:g}–{high:g}){_dagger(number)}")
        names_of[tuple(cells)].append(name)
    for properties, names in names_of.items():
        yield ", ".join(names), *properties


def _dagger(data: dict[str, Any]) -> str:
    return "" if data.get("verified", True) else "†"


def _dagger_of_oil(data: dict[str, Any]) -> str:
    """Also where a part of the property is unverified."""
    return "†" if "unverified" in data["source"] else ""


def oils() -> Iterator[Sequence[str]]:
    """Every oil at 40 °C; a dagger where no source was read."""
    for name in list_lubricants():
        data, oil = lubricant_data(name), load_lubricant(name, 313.15)
        low, high = data["range_C"]
        marks = {field: _dagger_of_oil(data[field]) for field in PROPERTIES}
        heat = oil.thermal
        assert heat is not None
        hot = "–"
        if high >= 100.0:
            at_100 = load_lubricant(name, 373.15)
            hot = f"{1e6 * at_100.viscosity / at_100.density:.3g}"
        yield (
            name,
            f"{low:g} to {high:g}",
            f"{1e6 * oil.viscosity / oil.density:.4g} / {hot}{marks['viscosity']}",
            f"{1e3 * heat.viscosity_temperature:.1f}",
            f"{1e9 * oil.pressure_viscosity:.3g}{marks['pressure_viscosity']}",
            f"{oil.density:.0f}{marks['density']}",
            f"{1e4 * heat.expansion:.2g}",
            f"{heat.conductivity:.3g}{marks['conductivity']}",
            f"{heat.specific_heat:.0f}{marks['specific_heat']}",
        )


def oil_sources() -> Iterator[Sequence[str]]:
    """Law and source of every property, oils and properties of one source in a row."""
    oils_of: dict[tuple[str, str], list[str]] = defaultdict(list)
    properties_of: dict[tuple[str, str], list[str]] = defaultdict(list)
    for name in list_lubricants():
        data = lubricant_data(name)
        for field in PROPERTIES:
            oils_of[f"{field.replace('_', ' ')} ({data[field]['law']})", data[field]["source"]].append(name)
    for (words, source), names in oils_of.items():
        properties_of[", ".join(names), source].append(words)
    for (names, source), words in properties_of.items():
        yield names, ", ".join(words), source


HEADS = {
    "checks": "bearing|known: balls × D on d_m, mm|estimated|D|d_m|known from",
    "fit": "series|number|C computed/printed|C_0 computed/printed|worst misfit"
    "|nearest second best|D from dimensions alone|balls from dimensions alone",
    "bearings": "name|d × D × B, mm|C / C_0, kN|balls × D on d_m, mm|angle or clearance",
    "clearances": "bore, mm|C2|CN|CM|C3|C4|C5",
    "materials": "name|kind|E, GPa|ν|ρ, kg/m³|expansion, µm/(m K)|conductivity, W/(m K)|specific heat, J/(kg K)"
    "|bending strength, MPa|Weibull modulus|fracture toughness, MPa √m",
    "oils": "name|range, °C|ν at 40 / 100 °C, mm²/s|−∂ln η/∂T, 10⁻³/K|α, 1/GPa|ρ, kg/m³"
    "|expansion, 10⁻⁴/K|conductivity, W/(m K)|specific heat, J/(kg K)",
    "sources of the oils": "oils|properties (laws)|source",
}
ROWS = {
    "checks": checks,
    "fit": fit,
    "bearings": bearings,
    "clearances": clearances,
    "materials": materials,
    "oils": oils,
    "sources of the oils": oil_sources,
}


def page() -> str:
    """The page with its tables renewed."""
    text = PAGE.read_text(encoding="utf-8")
    for name, rows in ROWS.items():
        start = MARK.format(name)
        block = f"{start}\n\n{table(HEADS[name].split('|'), rows())}\n\n{END}"
        before, marker, rest = text.partition(start)
        assert marker, name
        text = before + block + rest.partition(END)[2]
    return text


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
