"""Write docs/validation/measured_bearings.md: frequencies of bearings of public data sets, two events of a defect.

Run it with `OMP_NUM_THREADS=1 python tools/docs/measured_bearings.py`; it takes five minutes.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from oilfilm.bearing.geometry import Race
from oilfilm.bearing.vibration.assembly import mean_angle, track_radius
from oilfilm.cases.format.case import case_of_document, load_case
from oilfilm.cases.runs.equilibrium import case_equilibrium
from oilfilm.cases.runs.vibration import run_vibration

DOCS = Path(__file__).parents[2] / "docs"
PAGE = DOCS / "validation" / "measured_bearings.md"
TEMPLATE = PAGE.with_suffix(".md.in")
SEED = 4409
DRAWS = 6
CLEARANCE_UM = (3.0, 20.0)  # normal clearance (CN) of ISO 5753-1 for bores of 10 to 30 mm, its widest ends
AXIAL_SHARE = (0.0, 0.2)  # of the radial load; no set gives it
WIDTHS_MM = (0.18, 0.36, 0.53, 0.71)


class Measured(NamedTuple):
    """A bearing of a data set."""

    name: str
    designation: str  # whose other dimensions are taken
    balls: int
    ball_mm: float
    pitch_mm: float
    speed_rpm: float
    radial_N: tuple[float, float]


BEARINGS = (
    Measured("CWRU, drive end, 6205", "6205", 9, 7.94, 39.04, 1772.0, (50.0, 300.0)),
    Measured("XJTU-SY, LDK UER204", "6204", 8, 7.92, 34.55, 2100.0, (12000.0, 12000.0)),
    Measured("Paderborn, 6203", "6203", 8, 6.75, 28.55, 1500.0, (1000.0, 1000.0)),
)


def document(one: Measured, random: np.random.Generator) -> dict[str, Any]:
    """A case with what a set leaves open drawn at random."""
    base = load_case("6205_outer_defect").document
    radial = random.uniform(*one.radial_N)
    own = {
        "bearing": {
            "name": one.designation,
            "balls": one.balls,
            "ball_diameter_mm": one.ball_mm,
            "pitch_diameter_mm": one.pitch_mm,
            "diametral_clearance_um": random.uniform(*CLEARANCE_UM),
        },
        "operation": {
            "inner_speed_rpm": one.speed_rpm,
            "radial_load_N": radial,
            "axial_load_N": radial * random.uniform(*AXIAL_SHARE),
            "temperature_C": random.uniform(25.0, 60.0),
        },
        "model": {"ball_kinematics": "traction equilibrium"},
    }
    kept = {key: base[key] for key in ("schema_version", "ehl")}
    return {**kept, "title": one.name, "source": "public data set", "lubricant": {"name": "iso vg 100"}, **own}


def orders(one: Measured) -> list[float]:
    """Cage speeds over that of the shaft [-], of the draws that have an equilibrium."""
    random = np.random.default_rng(SEED)
    found = []
    for _ in range(DRAWS):
        case = case_of_document(document(one, random))
        state = case_equilibrium(case)
        if state.converged:
            found.append(state.cage_speed / case.operation.inner_speed)
        else:
            print(one.name, state.message)
    print(one.name, found, flush=True)
    return found


def frequency_rows() -> str:
    """Lines of the table of frequencies."""
    lines = []
    for one in BEARINGS:
        gamma = one.ball_mm / one.pitch_mm
        rolling = 0.5 * (1.0 - gamma)
        found = orders(one)
        low, high = min(found), max(found)
        z = one.balls
        cells = [
            f"{rolling:.4f} | {low:.4f} to {high:.4f}",
            f"{z * rolling:.4f} | {z * low:.4f} to {z * high:.4f}",
            f"{z * (1.0 - rolling):.4f} | {z * (1.0 - high):.4f} to {z * (1.0 - low):.4f}",
            f"{100.0 * (low / rolling - 1.0):+.2f} to {100.0 * (high / rolling - 1.0):+.2f}",
            f"{len(found)} of {DRAWS}",
        ]
        lines.append(f"| {one.name}, {one.speed_rpm:.0f} r/min | {' | '.join(cells)} |")
    return "\n".join(lines)


def event_rows() -> str:
    """Lines of the table of the two events of a spall on the outer race."""
    lines = []
    base = load_case("6205_outer_defect").document
    for width in WIDTHS_MM:
        defect = {**base["form"]["defects"][0], "width_mm": width}
        time = {**base["vibration"], "duration_s": 0.05, "settling_time_s": 0.05}
        run = run_vibration(case_of_document({**base, "form": {"defects": [defect]}, "vibration": time}), "events").run
        balls = run.solution.bearing.balls
        # the ball that passes the defect at the load line in the middle of the record
        sampled = np.arange(len(run.loads)) * run.model.options.duration / len(run.loads)
        middle = 0.5 * run.model.options.duration
        turns = (run.solution.azimuth + run.assembled.cage_speed * middle) / (2.0 * np.pi)
        j = int(np.argmin(abs(turns - np.round(turns))))
        passage = middle - (turns[j] - round(float(turns[j]))) * 2.0 * np.pi / run.assembled.cage_speed
        radius = track_radius(run.solution.bearing, Race.OUTER, mean_angle(run.solution, Race.OUTER))
        speed = radius * run.assembled.cage_speed
        entry = passage - 0.5e-3 * width / speed
        near = abs(sampled - passage) < 4e-3 * width / speed
        load = run.loads[near, balls + j]
        at = sampled[near]
        least = float(load.min())
        # second event: the fastest rise of the force between the middle and twice the width behind it
        behind = (at > passage) & (at < passage + 2e-3 * width / speed)
        hit = at[behind][np.gradient(load, at)[behind].argmax()]
        formula = 0.5e-3 * width / speed
        before = float(load[at < entry - 0.5e-3 * width / speed].mean())
        loose = float((load == 0.0).mean() * (at[-1] - at[0]))
        cells = [before, least, 1e3 * loose, float(load[behind].max()), 1e3 * (hit - entry), 1e3 * formula]
        lines.append(f"| {width:g} | " + " | ".join(f"{cell:.3g}" for cell in cells) + " |")
        print(lines[-1], flush=True)
    return "\n".join(lines)


if __name__ == "__main__":
    text = TEMPLATE.read_text(encoding="utf-8").format(frequencies=frequency_rows(), events=event_rows())
    PAGE.write_text(text, encoding="utf-8")
