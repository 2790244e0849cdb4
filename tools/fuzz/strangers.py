"""Draw bearings, speeds, loads, oils and temperatures at random; count results that break a law.

    python tools/fuzz/strangers.py --seed 20261129 --count 1000 [--workers 2] [-o FOLDER]

Each draw is a case as `oilfilm init` writes it for a bearing of the catalogue, or by its size, with other conditions:
speeds of n d_m from 3000 to 1 200 000 mm/min, loads from 0.2 to 40 per cent of the dynamic rating, films from -30 to
120 C or by a heat balance, every lubrication. Films are those of the film atlas and of formulas, so that a draw takes
about a second. A draw is

* refused: the case file is not accepted, in words;
* flagged: computed, not converged, and a message says why;
* silent: a result that breaks a law of `LAWS` or of `oilfilm.bearing.invariants` without being flagged, a number that
  is not finite, or an exception. There must be none.

Draws that are neither, but whose torque lies far from those of SKF and Palmgren, are listed as remarkable; they are
no faults by themselves. Exit code 1 if any draw is silent. With `-o` the case files of silent and remarkable draws are
kept.
"""

from __future__ import annotations

import argparse
import json
import random
import sys
import traceback
import warnings
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

import oilfilm
from oilfilm.bearing.quasistatic.solution import QuasistaticSolution
from oilfilm.cases.format.case import case_from_text
from oilfilm.cases.new_case import BoundaryDimensions, FirstOperation, case_of_designation, case_of_dimensions

GRADES = (10, 15, 22, 32, 46, 68, 100, 150, 220)
OTHER_OILS = ("pao 4", "pao 10", "pao 40", "mil-l-23699", "mil-l-7808", "fva 3")
LUBRICATIONS = ("oil bath", "low oil bath", "oil jet", "grease", "oil air")
FAR = 6.0  # torque over the larger, or the smaller over torque, of SKF and Palmgren: remarkable
ROUNDING = 1.0e-9
REASONS = (
    "not converged",
    "no equilibrium",
    "floats",
    "check failed",
    "no balance",
    "not self-heated",
    "is not",
    "cannot",
)
STEPS = (1.0e-8, 1.0e-8, 1.0e-8, 1.0e-7, 1.0e-7)  # of the ring, for differences [m], [rad]
SHARES = (1.0, 0.1, 0.01)  # of them, the first within the tolerance counts [-]
STIFFNESS_TOLERANCE = 1.0e-3  # of differences, whose steps may lift a ball off [-]


@dataclass
class Draw:
    """A case and what came of it."""

    number: int
    text: str
    outcome: str = "right"
    faults: list[str] = field(default_factory=list)
    remark: str = ""


def drawn(number: int, seed: int) -> Draw:
    """Case of one draw; numbers of one seed are independent of each other."""
    rng = random.Random(seed * 1_000_003 + number)
    text = _bearing(rng)
    entry = {key: _number(text, key) for key in ("pitch_diameter_mm", "basic_dynamic_rating_kN")}
    pitch = entry["pitch_diameter_mm"] or 50.0
    rating = (entry["basic_dynamic_rating_kN"] or 10.0) * 1.0e3
    speed = 10 ** rng.uniform(3.5, 6.08) / pitch
    angular = 'type = "angular contact"' in text
    radial = rating * 10 ** rng.uniform(-2.7, -0.4)
    axial = rating * 10 ** rng.uniform(-2.7, -0.6) if angular or rng.random() < 0.4 else 0.0
    if angular and axial < radial:
        radial *= rng.choice((0.0, 0.3, 1.0))
    values = {
        "inner_speed_rpm": f"{speed:.4g}",
        "radial_load_N": f"{radial:.4g}",
        "axial_load_N": f"{axial:.4g}",
        "temperature_C": f"{rng.uniform(-30.0, 120.0):.1f}",
        "ambient_C": f"{rng.uniform(-30.0, 40.0):.1f}",
    }
    text = _with(text, values)
    if rng.random() < 0.6:
        text = "\n".join(t for t in text.splitlines() if not t.startswith("temperature = "))
    if rng.random() < 0.5:
        oil = rng.choice(OTHER_OILS) if rng.random() < 0.3 else f"iso vg {rng.choice(GRADES)}"
        text = _with(text, {}, {"lubricant": {"name": f'"{oil}"'}})
    if rng.random() < 0.4:
        text = _lubricated(text, rng.choice(LUBRICATIONS))
    if rng.random() < 0.3:
        text = _with(text, {"ball_material": '"silicon nitride"'})
    return Draw(number, text.replace('film_maps = "all"', 'film_maps = "none"'))


def _bearing(rng: random.Random) -> str:
    """Case file of a bearing of the catalogue, or by its size."""
    given = FirstOperation()
    while True:
        try:
            if rng.random() < 0.85:
                return case_of_designation(rng.choice(oilfilm.list_bearings()), given)
            bore = rng.choice((10, 15, 17, 20, 25, 30, 40, 50, 60, 80, 100, 120))
            outside = round(bore * rng.uniform(1.45, 2.6))
            size = BoundaryDimensions(
                bore=bore,
                outside_diameter=outside,
                width=round(rng.uniform(0.35, 0.55) * (outside - bore)),
                contact_angle=rng.choice((0.0, 0.0, 15.0, 25.0, 40.0)),
            )
            return case_of_dimensions(size, given)
        except ValueError:
            continue


def _number(text: str, key: str) -> float | None:
    for line in text.splitlines():
        if line.startswith(f"{key} = "):
            return float(line.split("=")[1].split("#")[0])
    return None


def _with(text: str, values: dict[str, str], tables: dict[str, dict[str, str]] | None = None) -> str:
    """A text with other values of keys that it has; by table where a key is in several."""
    table = ""
    lines = []
    for line in text.splitlines():
        if line.startswith("["):
            table = line.strip("[] ")
        key = line.split("=")[0].strip()
        found = (tables or {}).get(table, {}).get(key) or values.get(key)
        lines.append(f"{key} = {found}" if found and "=" in line else line)
    return "\n".join(lines)


def _lubricated(text: str, way: str) -> str:
    """A text with another lubrication, without the keys that belong to the one before."""
    kept = [t for t in text.splitlines() if not t.startswith(("lubrication = ", "oil_level_mm = ", "oil_flow", "oil_"))]
    at = kept.index("[friction]") + 1
    kept.insert(at, f'lubrication = "{way}"')
    if "bath" in way:
        kept.insert(at, "oil_level_mm = 3.0")
    assumed = [t for t in kept if not t.strip().startswith('"friction.oil_')]
    return "\n".join(assumed)


def judged(draw: Draw) -> Draw:
    """Run a draw and judge its result."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            case = case_from_text(draw.text, f"draw {draw.number}")
            results = oilfilm.run_case(case)
            document = oilfilm.summary(results)
    except oilfilm.CaseError as error:
        draw.outcome = "refused"
        draw.remark = str(error).splitlines()[0]
        return draw
    except Exception:
        draw.outcome = "silent"
        draw.faults = [traceback.format_exc(limit=-2)]
        return draw
    faults = [fault for law in LAWS for fault in law(document)]
    if results.elastic.converged:
        faults += _stiffness(results.elastic)
    broken = list(results.broken_laws)
    if broken:
        draw.faults = broken
    if faults:
        draw.outcome = "silent"
        draw.faults = faults + broken
    elif not document["converged"]:
        draw.outcome = "flagged"
        draw.remark = "; ".join(text[:200] for text in document["messages"] if any(word in text for word in REASONS))
    else:
        draw.remark = _remark(document)
        draw.outcome = "remarkable" if draw.remark else "right"
    return draw


def _stiffness(state: QuasistaticSolution) -> Iterator[str]:
    """Check the stiffness of the inner ring against differences of equilibria, over shorter steps where a ball is
    near to leaving its race or to slipping across it.
    """
    for share in SHARES:
        worst = _distance(state, share)
        if worst <= STIFFNESS_TOLERANCE:
            return
    yield f"stiffness and differences of equilibria are {worst:.1e} of the diagonal apart"


def _distance(state: QuasistaticSolution, share: float) -> float:
    """Largest distance of stiffness and differences over a share of the steps, over the diagonal."""
    scale = np.sqrt(np.abs(np.outer(np.diag(state.stiffness), np.diag(state.stiffness))))
    position = np.concatenate([state.displacement, state.tilt])
    worst = 0.0
    for column, step in enumerate(share * np.array(STEPS)):
        ends = []
        for sign in (1.0, -1.0):
            moved = position.copy()
            moved[column] += sign * step
            held = replace(
                state.operation,
                force=(None,) * 3,
                moment=(None,) * 2,
                displacement=tuple(moved[:3].tolist()),
                tilt=tuple(moved[3:].tolist()),
            )
            found = oilfilm.solve_quasistatic(state.bearing, held, state.model, rows=state.rows)
            ends.append(np.concatenate([found.ring_force, found.ring_moment]))
        column_error = np.abs((ends[0] - ends[1]) / (2.0 * step) - state.stiffness[:, column])
        stiff = scale[:, column] > 0.0
        worst = max(worst, float((column_error[stiff] / scale[stiff, column]).max(initial=0.0)))
    return worst


def _finite(document: dict[str, Any]) -> Iterator[str]:
    """Check that all numbers are finite."""
    try:
        json.dumps(document, allow_nan=False, default=str)
    except ValueError:
        yield "a number is not finite"


def _said(document: dict[str, Any]) -> Iterator[str]:
    """Check that what did not converge has a message."""
    if not document["converged"] and not document["messages"]:
        yield "not converged without a message"


def _films(document: dict[str, Any]) -> Iterator[str]:
    """Check minimum below central films with finite bars, and films of loaded contacts alone."""
    for contact in document["contacts"]:
        least, central = contact["film_minimum_um"], contact["film_central_um"]
        place = f"ball {contact['ball']}, {contact['race']}"
        if least is not None and central is not None and least > central * (1.0 + ROUNDING):
            yield f"{place}: minimum {least:g} above central film {central:g} um"
        if contact["loaded"] and not contact["load_N"] > 0.0:
            yield f"{place}: loaded by {contact['load_N']} N"


def _parts(document: dict[str, Any]) -> Iterator[str]:
    """Check that the parts of the torque add up."""
    torque = document["torque_N_mm"]
    parts = torque.get("parts") or {}
    values = [value for name, value in parts.items() if name != "total" and value is not None]
    total = torque["total"]
    if total is None or not values:
        return
    if abs(sum(values) - total) > 1.0e-6 * sum(map(abs, values)):
        yield f"parts add up to {sum(values):g}, the total is {total:g} N mm"


def _life(document: dict[str, Any]) -> Iterator[str]:
    """Check a life against its factor."""
    life = document["life"] or {}
    basic = life.get("basic_reference_rating_Mrev")
    modified = life.get("modified_reference_rating_Mrev")
    factor = life.get("a_iso")
    if None in (basic, modified, factor):
        return
    if not 0.1 * (1.0 - 1e-6) <= factor <= 50.0 * (1.0 + 1e-6):
        yield f"a_ISO is {factor:g}"


LAWS = (_finite, _said, _films, _parts, _life)


def _remark(document: dict[str, Any]) -> str:
    """The torque beside those of SKF and Palmgren, where it is far from both."""
    torque = document["torque_N_mm"]
    models = torque["models"]
    others = [(models.get(name) or {}).get("total") for name in ("skf", "palmgren")]
    known = [value for value in others if value]
    total = torque["total"]
    if not total or not known or torque["model"] != "integrated":
        return ""
    if total > FAR * max(known) or total < min(known) / FAR:
        beside = ", ".join("-" if value is None else f"{value:.4g}" for value in others)
        return f"torque {total:.4g} N mm beside {beside} of SKF and Palmgren"
    return ""


def task(job: tuple[int, int]) -> Draw:
    """Draw and judge one number of a seed."""
    number, seed = job
    try:
        return judged(drawn(number, seed))
    except Exception:
        return Draw(number, "", "silent", [traceback.format_exc(limit=-3)])


def main() -> int:
    """Judge all draws; print their outcomes."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seed", type=int, required=True)
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("-o", "--folder", type=Path)
    options = parser.parse_args()
    jobs = [(options.first + k, options.seed) for k in range(options.count)]
    outcomes: Counter[str] = Counter()
    with ProcessPoolExecutor(options.workers) as pool:
        for draw in pool.map(task, jobs, chunksize=4):
            outcomes[draw.outcome] += 1
            if draw.outcome in ("right", "refused") and not draw.faults:
                continue
            print(f"{draw.number}: {draw.outcome}: {draw.remark}", flush=True)
            for fault in draw.faults:
                print(f"    {fault}", flush=True)
            if options.folder is not None:
                options.folder.mkdir(parents=True, exist_ok=True)
                (options.folder / f"draw_{draw.number}.toml").write_text(draw.text)
    print(", ".join(f"{count} {outcome}" for outcome, count in sorted(outcomes.items())))
    return 1 if outcomes["silent"] else 0


if __name__ == "__main__":
    sys.exit(main())
