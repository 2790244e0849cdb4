"""Write docs/validation/validation_002.md: contact stresses of the 6208, Yao et al. (2022).

Run it with `python tools/docs/validation_002.py`.
"""

from __future__ import annotations

from pathlib import Path

from printed import printed

from oilfilm.bearing import Bearing, Race, contact_conditions, reduced_modulus, reduced_radii, solve_quasistatic
from oilfilm.cases import load_case
from oilfilm.ehl.closed_form.hertz import hertz_contact

DOCS = Path(__file__).parents[2] / "docs"
PAGE = DOCS / "validation" / "validation_002.md"
TEMPLATE = PAGE.with_suffix(".md.in")
STEMS = {400.0: "6208_full_ceramic_400N", 900.0: "6208_full_ceramic_900N", 1750.0: "6208_full_ceramic_1750N"}
STEMS[3000.0] = "6208_full_ceramic"


def table_4() -> list[tuple[float, float, float]]:
    """Radial load [N], inner and outer stress [GPa] as printed."""
    keys = ("radial_load_N", "inner_hertz_pressure_GPa", "outer_hertz_pressure_GPa")
    rows = printed("yao_2022_table_4")
    return [(float(row[keys[0]]), float(row[keys[1]]), float(row[keys[2]])) for row in rows]


def computed(load: float) -> tuple[tuple[float, float], tuple[float, float], float]:
    """Largest Hertz pressure [GPa] and load [N] of inner and outer race, centrifugal force [N]."""
    case = load_case(STEMS[load])
    state = solve_quasistatic(case.bearing, case.operation, case.model)
    largest = {}
    for race in Race:
        contacts = [c for c in contact_conditions(state, case.lubricant) if c.race is race and c.hertz is not None]
        largest[race] = max((c.hertz.pressure * 1e-9, c.load) for c in contacts)
    (inner, inner_load), (outer, outer_load) = largest[Race.INNER], largest[Race.OUTER]
    return (inner, outer), (inner_load, outer_load), float(state.centrifugal_force[0])


def dry(bearing: Bearing, load: float) -> tuple[float, float]:
    """Hertz pressure of inner and outer race under the same `load` [N], in [GPa]."""
    modulus = reduced_modulus(bearing.ball_material, bearing.inner_ring_material)
    inner, outer = (hertz_contact(load, *reduced_radii(bearing, race, 0.0), modulus).pressure for race in Race)
    return inner * 1e-9, outer * 1e-9


def row(load: float, inner: float, outer: float) -> str:
    """One line of the table."""
    ours, loads, _ = computed(load)
    bearing = load_case(STEMS[load]).bearing
    five, eight = (dry(bearing, factor * load / bearing.balls) for factor in (5.0, 8.0))
    ratios = f"{ours[0] / inner:.3f} / {ours[1] / outer:.3f}"
    pairs = [f"{a:.3f} / {b:.3f}" for a, b in (ours, five, eight)]
    ball_1 = f"{loads[0]:.1f} / {loads[1]:.1f}"
    stresses = f"{inner:.2f} / {outer:.2f} | {pairs[0]} | {ratios}"
    return f"| {load:.0f} | {stresses} | {ball_1} | {pairs[1]} | {pairs[2]} |"


def page() -> str:
    """The page, computed anew."""
    table = table_4()
    hertz = dry(load_case(STEMS[3000.0]).bearing, 1000.0)
    return TEMPLATE.read_text(encoding="utf-8").format(
        stems=", ".join(f"`{stem}`" for stem in STEMS.values()),
        rows="\n".join(row(*line) for line in table),
        printed_growth=table[-1][1] / table[0][1],
        cube_root=(table[-1][0] / table[0][0]) ** (1.0 / 3.0),
        least_ratio=min(inner / outer for _, inner, outer in table),
        most_ratio=max(inner / outer for _, inner, outer in table),
        hertz_ratio=hertz[0] / hertz[1],
        centrifugal=computed(3000.0)[2],
    )


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
