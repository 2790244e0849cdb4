"""Random contacts behind a layer of oil: how many converge, are flagged or refused.

`python tools/starvation/draws.py SEED NUMBER FILE` solves on 129 points, a line of FILE each, goes on where it was
interrupted, and prints the outcomes. The contacts are those of `verification.draws`, a third with entrainment at an
angle, a third with one that turns; the layer is 0.1 to 5 times the oil of the flooded film by the formula of
Nijenbanning, Venner and Moes, log-uniform.
"""

from __future__ import annotations

import json
import sys
from collections import Counter
from dataclasses import replace
from math import log
from multiprocessing import Pool
from pathlib import Path

import numpy as np

from oilfilm.ehl import InletLayer, SolverOptions, solve_contact
from oilfilm.ehl.closed_form.film import film_nijenbanning_central
from oilfilm.ehl.multigrid.threads import cores
from oilfilm.ehl.oil.lubricant import density
from oilfilm.ehl.scaling import scale_contact

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))  # holds `verification`

from verification.draws import Draw, draws

POINTS = 129
RATIO = (0.1, 5.0)  # r, layer over the oil of the flooded film
MASS = 1e-5  # oil gained over what enters that counts as none


def outcome(job: tuple[Draw, float]) -> dict[str, object]:
    """One contact behind its layer."""
    draw, ratio = job
    contact = draw.conditions
    oil = contact.lubricant
    packed = float(density(scale_contact(contact).hertz_pressure, oil)) / oil.density
    layer = ratio * packed * film_nijenbanning_central(contact)
    found: dict[str, object] = {"number": draw.number, "kind": draw.kind, "text": draw.text, "r": ratio}
    try:
        film = solve_contact(replace(contact, inlet_layer=InletLayer(thickness=(layer,))), SolverOptions(points=POINTS))
    except ValueError as refusal:
        return found | {"outcome": "refused", "message": str(refusal)}
    if not film.converged:
        return found | {"outcome": "flagged", "message": film.message, "seconds": film.record.wall_time}
    supply = film.supply
    share = None if supply is None else film.film_central_dimensionless.value / supply.flooded_central.value
    return found | {
        "outcome": "converged",
        "resolved": film.resolved,
        "share": share,
        "inlet_ratio": None if supply is None else supply.inlet_ratio,
        "mass": film.record.mass_imbalance,
        "seconds": film.record.wall_time,
    }


def main(seed: int, number: int, file: Path) -> None:
    """Solve what is missing, then count."""
    ratios = np.exp(np.random.default_rng([seed, 1]).uniform(log(RATIO[0]), log(RATIO[1]), number))
    known = [json.loads(line) for line in file.read_text().splitlines()] if file.exists() else []
    done = {one["number"] for one in known}
    jobs = [(draw, float(ratios[draw.number])) for draw in draws(number, seed) if draw.number not in done]
    with Pool(cores()) as pool, file.open("a") as out:
        for one in pool.imap_unordered(outcome, jobs):
            out.write(json.dumps(one) + "\n")
            out.flush()
            known.append(one)
    for kind in ("straight", "at an angle", "rotating"):
        counts = Counter(str(one["outcome"]) for one in known if one["kind"] == kind)
        print(kind, dict(counts))
    solved = [one for one in known if one["outcome"] == "converged"]
    resolved = [one for one in solved if one["resolved"]]
    balanced = sum(abs(one["mass"]) <= MASS for one in solved)
    print(f"{len(solved)} converged, {len(resolved)} of them resolved; oil balanced to {MASS:g} in {balanced}")
    over = [one["share"] / one["inlet_ratio"] for one in resolved if one["share"] is not None]
    print(f"resolved, share over solved r: largest {max(over):.3f}")
    seconds = [one["seconds"] for one in known if "seconds" in one]
    print(f"seconds: median {np.median(seconds):.2f}, largest {max(seconds):.1f}")


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]), Path(sys.argv[3]))
