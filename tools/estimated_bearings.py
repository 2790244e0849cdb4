"""Write bearing/library/data/estimated_bearings.toml from catalogue_ratings.csv.

Run it with `python tools/estimated_bearings.py`. Each row of the table is a bearing of a maker's
catalogue; `geometry_estimate` determines the ball and the number of balls that explain its
ratings. Bearings whose geometry has a source (bearing/library/data/bearings.toml) are left out.
"""

from __future__ import annotations

import csv
from math import radians
from pathlib import Path

from bearing.library.bearings import published_bearings
from bearing.library.names import plain_name
from geometry_estimate import CatalogueData, GeometryEstimate, estimate_geometry, normal_clearance

DATA = Path(__file__).parents[1] / "bearing" / "library" / "data"
RATINGS, TARGET = DATA / "catalogue_ratings.csv", DATA / "estimated_bearings.toml"
MM, UM, KN = 1e-3, 1e-6, 1e3  # in SI
ANGLE_RANGE = 3.0  # around the nominal contact angle, unverified [deg]
MAKER = "C and C_0: NSK, Rolling Bearings"
HEAD = """\
# Written by tools/estimated_bearings.py from catalogue_ratings.csv; do not edit. Bearings whose
# internal geometry no maker publishes: estimated from boundary dimensions and load ratings
# (docs/user/libraries.md). `estimated` lists the keys that are estimates, `range` an interval of
# each; the grooves' radii follow the ball diameter if that is changed.
"""


def rows() -> dict[str, dict[str, str]]:
    """Rows of the table of ratings by designation; lengths [mm], ratings [kN]."""
    with RATINGS.open(encoding="utf-8", newline="") as file:
        return {row["designation"]: row for row in csv.DictReader(file)}


def estimate(row: dict[str, str]) -> GeometryEstimate:
    """Estimate of a row that has ratings."""
    shoulders = [float(row[key]) for key in ("inner_shoulder_mm", "outer_shoulder_mm") if row[key]]
    return estimate_geometry(
        CatalogueData(
            bore=float(row["bore_mm"]) * MM,
            outside_diameter=float(row["outside_diameter_mm"]) * MM,
            contact_angle=radians(float(row["contact_angle_deg"])),
            dynamic_rating=float(row["dynamic_rating_kN"]) * KN,
            static_rating=float(row["static_rating_kN"]) * KN,
            pitch_diameter=0.5 * sum(shoulders) * MM if shoulders else None,
        )
    )


def source(row: dict[str, str]) -> str:
    """Where the numbers of an entry come from."""
    series = row["designation"][:2]
    pages = "B8 to B13" if series[0] == "6" else "B50 to B57"
    parts = [f"boundary dimensions: ISO 15, dimension series {series[1]}, as in the NSK catalogue"]
    if row["geometry_of"]:
        parts.append(f"no ratings read; ball, balls and pitch diameter: those estimated for the {row['geometry_of']}")
    else:
        parts.append(f"{MAKER}, {pages}; ball, balls: estimated from them")
    if series[0] == "6":
        parts.append("shoulders: SKF general catalogue, d1 and D1, the pitch diameter their mean")
        parts.append("clearance: middle of the group CN")
    else:
        parts.append("pitch diameter: (d + D)/2; contact angle: nominal")
    return "; ".join([*parts, "grooves: 0.515 and 0.525 of the ball, assumed"])


def entry(row: dict[str, str], estimate: GeometryEstimate) -> dict[str, object]:
    """Keys of an entry; lengths [mm], clearance [um], angle [deg], ratings [kN]."""
    lengths = ("ball_diameter", "pitch_diameter", "inner_groove_radius", "outer_groove_radius")
    values: dict[str, object] = {f"{name}_mm": round(getattr(estimate, name) / MM, 4) for name in lengths}
    values["balls"] = estimate.balls
    ranges = {f"{key}_mm": [round(v / MM, 4) for v in estimate.ranges()[key]] for key in lengths}
    ranges["balls"] = list(estimate.ranges()["balls"])
    angle = float(row["contact_angle_deg"])
    if angle:
        values["free_contact_angle_deg"] = angle
        ranges["free_contact_angle_deg"] = [angle - ANGLE_RANGE, angle + ANGLE_RANGE]
    else:
        clearance = [round(v / UM, 1) for v in normal_clearance(float(row["bore_mm"]) * MM)]
        values["diametral_clearance_um"] = round(0.5 * sum(clearance), 2)
        ranges["diametral_clearance_um"] = clearance
        values |= {"inner_shoulder_diameter_mm": float(row["inner_shoulder_mm"])}
        values |= {"outer_shoulder_diameter_mm": float(row["outer_shoulder_mm"]), "skf_series": row["designation"][:2]}
    values |= {key: float(row[key]) for key in ("bore_mm", "outside_diameter_mm", "width_mm")}
    if row["dynamic_rating_kN"]:
        values["basic_dynamic_rating_kN"] = float(row["dynamic_rating_kN"])
        values["basic_static_rating_kN"] = float(row["static_rating_kN"])
    values |= {"ring_material": "bearing steel", "ball_material": "bearing steel", "source": source(row)}
    return {**values, "estimated": list(ranges), "range": ranges}


def toml(value: object) -> str:
    """A value as TOML."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {toml(item)}" for key, item in value.items()) + " }"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(toml(item) for item in value) + "]"
    return f'"{value}"' if isinstance(value, str) else repr(value)


def text() -> str:
    """The file."""
    table, published = rows(), {plain_name(name) for name in published_bearings()}
    estimates = {name: estimate(row) for name, row in table.items() if row["dynamic_rating_kN"]}
    blocks = [HEAD]
    for name, row in table.items():
        if plain_name(name) in published:
            continue
        values = entry(row, estimates[row["geometry_of"] or name])
        blocks.append("\n".join([f'["{name}"]', *(f"{key} = {toml(value)}" for key, value in values.items())]) + "\n")
    return "\n".join(blocks)


if __name__ == "__main__":
    TARGET.write_text(text(), encoding="utf-8")
