"""Write docs/validation/heat_of_bearings.md: heat of a bearing of NASA, of three materials, over the oil supply.

Run it with `python tools/docs/heat_of_bearings.py`.
"""

from __future__ import annotations

import tomllib
import warnings
from collections.abc import Callable
from copy import deepcopy
from functools import cache
from math import pi
from pathlib import Path
from typing import Any

from oilfilm.bearing.friction.resistance import SHIELDING, SHIELDING_RANGE
from oilfilm.cases import run_case
from oilfilm.cases.format.case import case_of_document
from oilfilm.cases.format.document import read_text
from oilfilm.cases.format.shipped import find_case
from oilfilm.postprocess import summary

DOCS = Path(__file__).parents[2] / "docs"
PAGE = DOCS / "validation" / "heat_of_bearings.md"
TEMPLATE = PAGE.with_suffix(".md.in")
NASA = "nasa_35mm_bearing"
SPEEDS = (28000.0, 36000.0, 48000.0, 60000.0, 72000.0)  # r/min
PARKER = 1e5 * 760.0**0.37 / 48.5**1.7  # X n [r/min]
TRANSFER = (0.5, 2.0, 8.0)  # of shaft and housing [W/K]
DRAG_SHARES = tuple(end / SHIELDING for end in SHIELDING_RANGE)
# heat [W], inner and outer ring [K], as quoted from the reports, by speed [r/min]
MEASURED = {28000.0: (350, 422, 413), 48000.0: (700, 443, 425), 72000.0: (1400, 468, 443)}
PARTS = ("inner_ring", "outer_ring_loaded", "balls", "oil")
MATERIALS = {
    "steel, steel": ("bearing steel", "bearing steel"),
    "steel, silicon nitride": ("bearing steel", "silicon nitride"),
    "silicon nitride, silicon nitride": ("silicon nitride", "silicon nitride"),
}
SUPPLIED = "6208_self_heating"  # of Yao et al. (2022): 5000 r/min, 900 N, 1.2 mL/min
BEST, MOST = 1.2, 2.0  # mL/min
FLOW_SHARES = (1.0, 10.0, 30.0, 100.0, 300.0)  # oil that cools over the supply


@cache
def text(stem: str) -> str:
    """A shipped case."""
    return read_text(find_case(stem))


def ran(stem: str, **changes: Any) -> dict[str, Any]:
    """Summary of a shipped case with keys changed, `table__key`."""
    document = deepcopy(tomllib.loads(text(stem)))
    for key, value in changes.items():
        table, _, name = key.partition("__")
        if name:
            document.setdefault(table, {})[name] = value
        else:
            document[table] = value
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the oil's data end at 150 C, said on the page
        found: dict[str, Any] = summary(run_case(case_of_document(document), workers=1))
    return found


@cache
def nasa(speed: float, share: float = 1.0, transfer: float = 2.0) -> dict[str, Any]:
    """The bearing of NASA at a speed [r/min], with a share of Parker's oil and cooling by shaft and housing [W/K]."""
    found = ran(
        NASA,
        operation__inner_speed_rpm=speed,
        friction__oil_fraction=round(share * PARKER / speed, 5),
        friction__heat_transfer_W_K=transfer,
    )
    assert found["self_heating"]["converged"] and found["temperatures_C"]
    return found


def power(found: dict[str, Any], speed: float) -> float:
    """Friction at a speed [r/min], in [W]."""
    return float(found["torque_N_mm"]["total"] * 1e-3 * speed * pi / 30.0)


def band(speed: float, value: Callable[[dict[str, Any], str], float]) -> str:
    """A number of the case as it stands, and its least and largest over oil and cooling; `value` takes a summary and
    the end of the ranges of the paths: "low", "" or "high".
    """
    corners = [(share, transfer) for share in DRAG_SHARES for transfer in TRANSFER[::2]]
    others = [value(nasa(speed, *corner), end) for corner in corners for end in ("low", "high")]
    own = value(nasa(speed), "")
    return f"{own:.0f} ({min(own, *others):.0f} to {max(own, *others):.0f})"


def part(name: str) -> Callable[[dict[str, Any], str], float]:
    """Temperature of a node [C]."""
    keys = {"low": "temperatures_low_C", "": "temperatures_C", "high": "temperatures_high_C"}
    return lambda found, end: found[keys[end]][name]


def nasa_rows() -> str:
    """A line for each speed."""
    lines = []
    for speed in SPEEDS:
        found = nasa(speed)
        inner, outer = found["contacts"][:2]
        parts = found["torque_N_mm"]["parts"]
        watts = band(speed, lambda found, _, speed=speed: power(found, speed))
        heat, *rings = MEASURED.get(speed, (0, 0, 0))
        cells = [
            f"{speed:.0f}",
            f"{heat}; {', '.join(f'{ring - 273.15:.0f}' for ring in rings)}" if heat else "",
            watts,
            f"{100.0 * parts['drag'] / found['torque_N_mm']['total']:.0f}",
            *(band(speed, part(name)) for name in PARTS),
            f"{inner['film_minimum_um']:.3f}, {outer['film_minimum_um']:.3f}",
            f"{inner['isothermal_film_minimum_um']:.3f}, {outer['isothermal_film_minimum_um']:.3f}",
            f"{found['runaway_margin']:.2f}",
        ]
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)


def material_rows() -> str:
    """The 6208 of three materials that warms itself: 3000 N, 10000 r/min, flooded, one oil."""
    lines = []
    for name, (rings, balls) in MATERIALS.items():
        document = tomllib.loads(text(SUPPLIED))
        friction = {key: value for key, value in document["friction"].items() if not key.startswith("supply_")}
        friction |= {
            "lubrication": "oil jet",
            "oil_fraction": 0.02,
            "cooling_oil_mL_min": 1000.0,
            "cooling_oil_C": 40.0,
        }
        friction |= {"heating_torque": "integrated"}
        found = ran(
            SUPPLIED,
            bearing__ring_material=rings,
            bearing__ball_material=balls,
            materials={},
            friction=friction,
            operation__inner_speed_rpm=10000.0,
            operation__radial_load_N=3000.0,
            operation__temperature="self-heated",
        )
        assert found["converged"]
        heaviest = max(
            (contact for contact in found["contacts"] if contact["race"] == "inner"),
            key=lambda contact: contact["load_N"],
        )
        warm, low, high = (found[f"temperatures{end}_C"] for end in ("", "_low", "_high"))
        cells = [
            name,
            f"{heaviest['hertz_pressure_GPa']:.3f}",
            f"{heaviest['film_minimum_um']:.3f} ± {heaviest['film_minimum_uncertainty_um']:.3f}",
            f"{heaviest['inlet_heat_share']:.2f}",
            f"{found['torque_N_mm']['total']:.0f}",
            f"{power(found, 10000.0):.0f}",
            *(
                f"{warm[node]:.1f} ({low[node]:.1f} to {high[node]:.1f})"
                for node in ("inner_ring", "balls", "outer_ring_loaded")
            ),
            f"{heaviest['contact_conductance_W_K']:.2f}",
        ]
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)


def cooled(flow: float, share: float) -> float:
    """Film temperature at a supply [mL/min] of which so many times as much oil passes through, in [C]."""
    found = ran(SUPPLIED, friction__supply_mL_min=flow, friction__cooling_oil_mL_min=round(share * flow, 6))
    assert found["converged"]
    return float(found["temperatures_C"]["film"])


def flow_rows() -> str:
    """Film temperature at the best and the largest supply over the oil that passes through."""
    lines = []
    for share in FLOW_SHARES:
        best, most = cooled(BEST, share), cooled(MOST, share)
        verdict = "falls" if most < best else "rises"
        lines.append(f"| {share:.0f} | {0.0277 * MOST * share:.2f} | {best:.1f} | {most:.1f} | {verdict} |")
    return "\n".join(lines)


def page() -> str:
    """The page, computed anew."""
    return TEMPLATE.read_text(encoding="utf-8").format(nasa=nasa_rows(), materials=material_rows(), flows=flow_rows())


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
