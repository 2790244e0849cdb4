"""Damping behind layers of oil: `python tools/starvation/damping.py`, of the contacts and layers of `solves.jsonl`.

One line of JSON a contact in `damping.jsonl`: in slow movement and at an angular frequency of 0.3 u_m/a, flooded and
behind every layer, on a mesh and on one of half its points, over p_h a R_x/u_m; null where a contact does not converge.
Those that the file has are left out, so that a run that was stopped goes on.
"""

from __future__ import annotations

import json
import sys
from dataclasses import replace
from pathlib import Path

from solves import MODULUS, SOLVES, rounded

from oilfilm.ehl import DensityLaw, InletLayer, Lubricant, SolverOptions, ViscosityLaw
from oilfilm.ehl.multigrid.newton import LinearSolverError
from oilfilm.ehl.multigrid.supply.oil_supply import inlet_ratio, starved_film_guess
from oilfilm.ehl.scaling import scale_contact
from oilfilm.ehl.solver import solve_attempts
from oilfilm.ehl.traction.linear_response import linear_contact

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))  # holds `verification`

from verification.contacts import from_groups, moes

DAMPING = Path(__file__).with_name("damping.jsonl")
FAST = 0.3  # omega a/u_m


def dampings(solution, levels):
    """Slow and fast, with half of what the squeeze beyond the box adds; None where there are none."""
    if not solution.converged:
        return None
    try:
        contact = linear_contact(levels)
        slow, fast = contact.slow(), contact.at(FAST)[1]
    except LinearSolverError as error:
        print(error)
        return None
    half = 0.5 * slow.damping_outside
    return [slow.damping - half, fast - half]


def answers(conditions, layers, points):
    """Of the flooded contact and of those behind layers."""
    options = SolverOptions(points=points)
    flooded, levels = solve_attempts(conditions, options)
    found = {"flooded": dampings(flooded, levels), "starved": []}
    if found["flooded"] is None:
        return found
    unit = 1.0 / inlet_ratio(1.0, flooded, scale_contact(conditions))
    for ratio in layers:
        layer = InletLayer(thickness=(ratio * unit * flooded.film_scale,))
        guess = starved_film_guess(flooded.film_central_dimensionless.value, ratio)
        behind = replace(conditions, inlet_layer=layer)
        found["starved"].append(dampings(*solve_attempts(behind, options, film_guess=guess)))
    return found


def oil_of(entry):
    """The oil of a line of `solves.jsonl`."""
    law, density, alpha, z = entry["oil"]
    return Lubricant(
        viscosity=0.04, pressure_viscosity=alpha, roelands_z=z, viscosity_law=ViscosityLaw(law),
        density_law=DensityLaw(density),
    )  # fmt: skip


def main():
    """Solve what the file lacks, contacts on few points first."""
    entries = [json.loads(line) for line in SOLVES.read_text().splitlines()]
    lines = DAMPING.read_text().splitlines() if DAMPING.exists() else []
    done = {(one["kind"], one["number"]) for one in map(json.loads, lines)}
    for entry in sorted(entries, key=lambda one: one["points"]):
        if (entry["kind"], entry["number"]) in done:
            continue
        groups = moes(entry["M"], entry["L"], entry["ratio"], oil=oil_of(entry))
        conditions = from_groups(groups, modulus=MODULUS)
        one = {name: entry[name] for name in ("kind", "number", "M", "L", "ratio", "layers", "points")}
        one["fine"] = answers(conditions, entry["layers"], entry["points"])
        one["coarse"] = answers(conditions, entry["layers"], entry["points"] // 2 + 1)
        with DAMPING.open("a") as file:
            file.write(json.dumps(rounded(one), separators=(",", ":")) + "\n")
        print(one["kind"], one["number"], one["points"], flush=True)


if __name__ == "__main__":
    main()
