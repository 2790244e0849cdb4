"""Write the tables of keys of docs/reference/cases.md, from the schema of case files."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from oilfilm.cases.format.document import BearingFile, ContactFile, ShaftFile
from oilfilm.cases.format.rules import allowed_values, resolved
from oilfilm.ehl.units import unit_of

DOCS = Path(__file__).parents[2] / "docs"
PAGE = DOCS / "reference" / "cases.md"
START, END = "<!-- tables: written by tools/docs/case_reference.py -->", "<!-- end of tables -->"
SYMBOLS = {
    "um": "µm", "us": "µs", "degC": "°C", "rpm": "r/min", "mm2/s": "mm²/s", "m/s2": "m/s²", "kg/m3": "kg/m³",
    "g mm2": "g mm²", "um/(m K)": "µm/(m K)",
}  # fmt: skip
SPECIAL = {
    "force_N": "three numbers, ±1e8",
    "moment_N_mm": "±1e10",
    "displacement_um": "three numbers ±1e5, or `free`",
    "tilt_mrad": "two numbers ±100, or `free`",
    "points": "33, 65, 129, 257, 513, 1025, 2049, 4097",
    "domain": "x_in < -1, x_out > 1, y_half > 1",
    "film_maps": "`all`, `loaded`, `none`, azimuths in degrees",
    "speeds_rpm": "two numbers, 0 < first < last",
    "axial_loads_N": "two numbers, 0 < first < last",
    "critical_radial_loads_N": "two numbers, 0 <= first < last",
    "critical_speeds_rpm": "up to six numbers > 0 and <= 1e6",
    "speed_table_rpm": "rows of time in s and a number",
    "load_table_N": "rows of time in s and three numbers",
    "load_over_time_N": "rows of time in s and a number",
    "speed_over_time_m_s": "rows of time in s and a number",
    "gravity_m_s2": "three numbers",
    "inner_waviness": "tables of `order` 1 to 10000, `amplitude_um` 0 to 1000, `phase_deg` ±360",
    "outer_waviness": "likewise",
    "ball_waviness": "likewise, and `ball`, its number from 1; 0: all, in step",
    "ball_diameter_um": "a number a ball, ±1000",
    "defects": "tables of `place`, `kind`, `width_mm`, `depth_um`, `azimuth_deg`, `ball`",
    "envelope_band_Hz": "two numbers, 0 <= first < last <= 1e6",
    "assumed": "list of `table.key`",
}
ORDER = (
    "bearing",
    "contact",
    "lubricant",
    "operation",
    "model",
    "ehl",
    "surface",
    "fit",
    "rings",
    "temperatures",
    "friction",
    "cage",
    "dynamics",
    "form",
    "support",
    "vibration",
    "transient",
    "features",
    "rows",
    "load_cases",
    "slip",
    "materials",
    "lubricants",
)
OF_SHAFTS = {
    "support": "[[support]] of a shaft",
    "spring": "[[spring]]",
    "load": "[[load]]",
    "housing": "[housing]",
    "operation": "[operation] of a shaft",
}
OF_CONTACTS = ("contact", "transient", "features")
NAMED = {
    "rows": "[rows]",
    "features": "[features]",
    "load_cases": "[load_cases]",
    "materials": "materials.NAME",
    "lubricants": "lubricants.NAME",
}
LIKE = {"load_cases": "operation", "lubricants": "lubricant"}  # tables with keys of another one


def unit(key: str) -> str:
    """Unit that a key ends in."""
    unit = unit_of(key)
    return SYMBOLS.get(unit, unit)


def default(key: str, node: dict[str, Any], required: list[str]) -> str:
    """Value of a key that is left out."""
    if key in required:
        return "required"
    value = node.get("default")
    return "" if value is None or value == "" or value == [] else f"`{value}`"


def row(key: str, node: dict[str, Any], schema: dict[str, Any], required: list[str]) -> str:
    """One line of a table."""
    of_films = key != "points" or node.get("minimum") == 33  # the slip maps have points of their own
    text = (SPECIAL.get(key) if of_films else None) or allowed_values(resolved(schema, node))
    text = text.replace("a whole number ", "").replace("a number ", "").replace("whole number ", "")
    text = re.sub(r">= (\S+) and <= (\S+)", r"\1 to \2", text)
    text = re.sub(r"> (\S+) and <= (\S+)", r"> \1 to \2", text)
    text = re.sub(r'"([^"]*)"', r"`\1`", text.replace("text in quotes", "text"))
    meaning = re.sub(r'"([^"]*)"', r"`\1`", node.get("description", ""))
    if unit(key):
        text += (" " if text[-1].isdigit() else ", ") + unit(key)
    return f"| `{key}` | {default(key, node, required)} | {text} | {meaning} |"


def table(name: str, node: dict[str, Any], schema: dict[str, Any], like: str = "") -> list[str]:
    """Heading and keys of one table of the file; those that it has of another table are named by that."""
    required, keys = node.get("required", []), node["properties"]
    lines = [f"### {name}", "", " ".join(node.get("description", "").split()), ""]
    if like:
        bearing = BearingFile.model_json_schema()
        known = _content(bearing, bearing["properties"][like])["properties"]
        shared = [key for key in keys if key in known]
        keys = {key: item for key, item in keys.items() if key not in known}
        lines += [f"It takes the keys of [[{like}]](#{like}) from `{shared[0]}` to `{shared[-1]}`.", ""]
    if not keys:
        return lines
    lines += ["| key | default | range | meaning |", "|---|---|---|---|"]
    return [*lines, *(row(key, item, schema, required) for key, item in keys.items()), ""]


def tables() -> str:
    """All tables as Markdown."""
    bearing, contact = BearingFile.model_json_schema(), ContactFile.model_json_schema()
    scalars = {key: node for key, node in bearing["properties"].items() if "properties" not in _content(bearing, node)}
    top = {"description": "Before the first table.", "properties": scalars, "required": bearing["required"]}
    lines = table("Top of the file", top, bearing)
    for key in ORDER:
        schema = contact if key in OF_CONTACTS else bearing
        name = f"[{NAMED.get(key, key)}]"
        lines += table(name, _content(schema, schema["properties"][key]), schema, LIKE.get(key, ""))
        if key == "ehl":
            lines += table("[ehl] of a contact", _content(contact, contact["properties"][key]), contact, key)
    shaft = ShaftFile.model_json_schema()
    sections = _content(shaft, shaft["properties"]["shaft"])
    lines += table("[shaft]", sections, shaft)
    lines += table("[[shaft.section]]", _content(shaft, sections["properties"]["section"]), shaft)
    for key, name in OF_SHAFTS.items():
        lines += table(name, _content(shaft, shaft["properties"][key]), shaft)
    return "\n".join(lines)


def _content(schema: dict[str, Any], node: dict[str, Any]) -> dict[str, Any]:
    """The table behind a key; of tables by name or in a list, the one they all are."""
    node = resolved(schema, node)
    several = node.get("additionalProperties") or node.get("items")
    return resolved(schema, several) if isinstance(several, dict) and "$ref" in several else node


def page() -> str:
    """The page with its tables up to date."""
    before, _, rest = PAGE.read_text(encoding="utf-8").partition(START)
    _, _, after = rest.partition(END)
    return f"{before}{START}\n\n{tables()}\n{END}{after}"


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
