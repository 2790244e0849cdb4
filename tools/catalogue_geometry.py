"""Write the columns `ball_mm` and `balls` of bearing/library/data/catalogue_ratings.csv.

Run it with `python tools/catalogue_geometry.py` after a change of the table: each row is a bearing of a maker's
catalogue, `bearing.rating.geometry_estimate` determines the ball and the number of balls that explain its ratings.
"""

from __future__ import annotations

import csv
import io
from math import radians
from pathlib import Path

from oilfilm.bearing.library.catalogue import boundary_dimensions
from oilfilm.bearing.library.designation import read_designation
from oilfilm.bearing.rating.geometry_estimate import CatalogueData, RatedPair, estimate_geometry

RATINGS = Path(__file__).parents[1] / "bearing" / "library" / "data" / "catalogue_ratings.csv"
MM, KN = 1e-3, 1e3  # in SI


def rows() -> dict[str, dict[str, str]]:
    """Rows of the table of ratings by designation; lengths [mm], ratings [kN]."""
    with RATINGS.open(encoding="utf-8", newline="") as file:
        return {row["designation"]: row for row in csv.DictReader(file)}


def data(row: dict[str, str]) -> CatalogueData:
    """A row in SI, with the boundary dimensions of its designation."""
    designation = read_designation(row["designation"])
    assert designation is not None
    outside, width = boundary_dimensions()[designation.dimension_series, designation.bore]
    shoulders = [float(row[key]) for key in ("inner_shoulder_mm", "outer_shoulder_mm") if row[key]]
    return CatalogueData(
        bore=designation.bore * MM,
        outside_diameter=outside * MM,
        width=width * MM,
        contact_angle=radians(designation.contact_angle),
        dynamic_rating=float(row["dynamic_rating_kN"]) * KN,
        static_rating=float(row["static_rating_kN"]) * KN,
        pitch_diameter=0.5 * sum(shoulders) * MM if shoulders else None,
    )


def estimate(row: dict[str, str]) -> RatedPair:
    """Ball and number of balls of a row."""
    return estimate_geometry(data(row))


def text() -> str:
    """The table with its columns renewed."""
    table = rows()
    file = io.StringIO()
    writer = csv.DictWriter(file, fieldnames=list(next(iter(table.values()))), lineterminator="\n")
    writer.writeheader()
    for row in table.values():
        pair = estimate(row)
        writer.writerow({**row, "ball_mm": f"{pair.ball_diameter / MM:.10g}", "balls": str(pair.balls)})
    return file.getvalue()


if __name__ == "__main__":
    RATINGS.write_text(text(), encoding="utf-8")
