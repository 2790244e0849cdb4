"""Write docs/validation/torque_of_bearings.md: torque of eleven bearings, SKF's and Palmgren's models.

Run it with `python tools/docs/torque_of_bearings.py`; it takes a minute.
"""

from __future__ import annotations

import math
import statistics
import tomllib
import warnings
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from oilfilm.bearing import contact_conditions, solve_quasistatic
from oilfilm.bearing.films.operating_film import with_formulas
from oilfilm.cases import run_case
from oilfilm.cases.format.case import case_of_document
from oilfilm.cases.new_case import FirstOperation, case_of_designation
from oilfilm.ehl import SolverOptions, solve_contact
from oilfilm.ehl.traction.rolling_moment import rolling_moment
from oilfilm.postprocess import summary

DOCS = Path(__file__).parents[2] / "docs"
PAGE = DOCS / "validation" / "torque_of_bearings.md"
TEMPLATE = PAGE.with_suffix(".md.in")
HEAVY = ("6310", "6320", "6208")
PARTS = ("rolling", "hysteresis", "curvature", "spin", "asperity", "cage", "drag")
POINTS = 257
NEGLIGIBLE = 1e-6  # of the total [-]


class Place(NamedTuple):
    """A bearing at an operating point."""

    name: str
    speed: float  # [r/min]
    radial: float  # [N]
    axial: float  # [N]
    temperature: float = 60.0  # [C]

    @property
    def title(self) -> str:
        """Bearing, speed, loads and temperature."""
        return f"{self.name}, {self.speed:.0f} r/min, {self.radial:.0f}/{self.axial:.0f} N, {self.temperature:.0f} °C"


PLACES = (
    Place("6205", 1500, 700, 0),
    Place("6208", 6000, 1500, 0),
    Place("6310", 3000, 6000, 0),
    Place("6006", 3000, 660, 0),
    Place("7208B", 3000, 1000, 2000),
    Place("7012AC", 6000, 500, 1500),
    Place("61808", 3000, 300, 0),
    Place("6304", 100, 2000, 0),
    Place("6320", 1500, 17000, 0),
    Place("6208", 300, 3000, 0),
    Place("6205", 1500, 700, 0, 0.0),
)


def document(place: Place) -> dict[str, Any]:
    """The case that `oilfilm init` writes, at the temperature of the place, films without a solve."""
    first = FirstOperation(speed=float(place.speed), radial_load=float(place.radial), axial_load=float(place.axial))
    found = tomllib.loads(case_of_designation(place.name, first))
    found["ehl"]["film_maps"] = "none"
    del found["operation"]["temperature"]
    found["operation"]["temperature_C"] = place.temperature
    return found


@cache
def torque(place: Place) -> dict[str, Any]:
    """Block of the torque."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = summary(run_case(case_of_document(document(place)), workers=1))
    block: dict[str, Any] = found["torque_N_mm"]
    return block


def ends(block: dict[str, Any] | None) -> str:
    """Ends of a range [N mm]."""
    return "–" if block is None else f"{block['low']:.3g} to {block['high']:.3g}"


def total_rows() -> str:
    """A line for each bearing: total with its ranges, and the two models."""
    lines = []
    for place in PLACES:
        block = torque(place)
        parts = block["total_range"]["parts"]
        skf, palmgren = (block["models"][name]["total"] for name in ("skf", "palmgren"))
        cells = [
            place.title,
            f"{block['total']:.3g} ({ends(block['total_range'])})",
            *(ends(parts.get(name)) for name in ("load sharing", "roughness")),
            f"{skf:.3g}",
            f"{palmgren:.3g}",
            f"{block['total'] / skf:.2f}",
            f"{block['total'] / palmgren:.2f}",
        ]
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)


def scatter(model: str) -> str:
    """Mean and standard deviation of the ratio to a model."""
    ratios = [torque(place)["total"] / torque(place)["models"][model]["total"] for place in PLACES]
    return f"{statistics.mean(ratios):.2f} ± {statistics.stdev(ratios):.2f}"


def part_rows() -> str:
    """Parts of the total, and SKF's."""
    lines = []
    for place in PLACES:
        block = torque(place)
        skf = block["models"]["skf"]
        least = NEGLIGIBLE * block["total"]
        parts = [f"{value:.3g}" if (value := block["parts"][name]) > least else "0" for name in PARTS]
        model = [f"{skf[name]:.3g}" for name in ("rolling", "sliding", "drag")]
        lines.append(f"| {' | '.join([place.title, *parts, *model])} |")
    return "\n".join(lines)


def moment_rows() -> str:
    """Rolling moments of the heaviest contacts, solved and without a solve."""
    lines = []
    for name in HEAVY:
        place = next(one for one in PLACES if one.name == name)
        case = case_of_document(document(place))
        state = solve_quasistatic(case.bearing, case.operation, case.model)
        contacts = contact_conditions(state, case.lubricant)[:2]
        for contact, film in zip(contacts, with_formulas(contacts, [None, None]), strict=True):
            assert contact.conditions is not None and contact.hertz is not None and film is not None
            solved = rolling_moment(solve_contact(contact.conditions, SolverOptions(points=POINTS)))
            cells = [
                f"{name}, {contact.race.value}",
                f"{contact.load:.0f}",
                f"{contact.hertz.pressure / 1e9:.2f}",
                f"{solved.value * 1e3:.3g} ± {solved.uncertainty * 1e3:.2g}",
                f"{film.flooded_moment * 1e3:.3g}",
            ]
            lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)


def exponents() -> str:
    """Growth of the rolling part with the load of the 6310, ours and SKF's, as exponents."""
    light, heavy = (torque(Place("6310", 3000, radial, 0)) for radial in (3000, 12000))
    parts = [(heavy["parts"], light["parts"]), (heavy["models"]["skf"], light["models"]["skf"])]
    own, skf = (math.log(more["rolling"] / less["rolling"]) / math.log(4.0) for more, less in parts)
    return f"{own:.2f} against SKF's {skf:.2f}"


def page() -> str:
    """The page, computed anew."""
    return TEMPLATE.read_text(encoding="utf-8").format(
        totals=total_rows(),
        skf=scatter("skf"),
        palmgren=scatter("palmgren"),
        parts=part_rows(),
        moments=moment_rows(),
        exponents=exponents(),
    )


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
