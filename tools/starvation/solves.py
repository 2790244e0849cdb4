"""Solves of the starvation law: `python tools/starvation/solves.py 260 52`, contacts to fit and to judge by.

Every contact is solved flooded and behind layers of several thicknesses, on a mesh and on one of half its points.
One line of JSON a contact in `solves.jsonl`; those that it has are left out, so that a run that was stopped goes on.
The contacts that the law is judged by are other ones, of any oil; they come in turn with those that it is fitted to.
"""

from __future__ import annotations

import json
import sys
from dataclasses import replace
from math import exp, log, sqrt
from pathlib import Path

import numpy as np
from scipy.stats import qmc

from oilfilm.ehl import DensityLaw, InletLayer, Lubricant, SolverOptions, ViscosityLaw
from oilfilm.ehl.multigrid.full_multigrid import choose_domain
from oilfilm.ehl.multigrid.supply.oil_supply import inlet_ratio, oil_supply, pressure_moment, starved_film_guess
from oilfilm.ehl.scaling import scale_contact
from oilfilm.ehl.solver import solve_attempts
from oilfilm.ehl.traction.rolling_moment import scaled_as_solved

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))  # holds `verification`

from verification.contacts import from_groups, moes

SOLVES = Path(__file__).with_name("solves.jsonl")
OIL = Lubricant(viscosity=0.04, pressure_viscosity=18e-9, roelands_z=0.6)
LOAD = 3.0  # least M; the largest for Rx/Ry above and below WIDE
LARGEST_LOAD = (3000.0, 12000.0)
WIDE = 0.3
LUBRICANT = (0.05, 33.0)  # L
# Rx/Ry of bearings, which get BEARINGS of the contacts, and of all
RATIO = (0.012, 0.15, 4.0)
BEARINGS = 0.65
LARGEST_EXPONENT = 60.0  # alpha p_h
# layers over the oil of the flooded film; the last for light contacts
STRATA = ((0.06, 0.3), (0.3, 0.65), (0.65, 1.1), (1.1, 2.2), (2.2, 25.0), (25.0, 150.0))
LIGHT = 60.0  # M
FINENESS = 120.0  # Hc/(S hx^2) of the finest mesh
POINTS = (257, 513)
THICK = 0.3  # Hc from which the fewer points do
# Hc beyond which contacts are solved among the first FEW only: thin films take a minute each; where films are thick,
# oil far from the contact carries much of the load
THINNEST, LIGHTEST = 0.025, 0.9
FEW = {"fit": 66, "held": 14}
# E' so large that contacts are small beside their radii, and circles parabolas
MODULUS = 226e11


def contacts(kind, count):
    """(number, groups, layers) of `count` contacts."""
    seed = {"fit": 1, "held": 2}[kind]
    places = qmc.Halton(4, seed=seed).random(8 * count)
    random = np.random.default_rng(seed)
    found = []
    for place in places:
        share, low, high = (place[0] / BEARINGS, *RATIO[:2])
        if share > 1.0:
            share, low, high = ((place[0] - BEARINGS) / (1.0 - BEARINGS), *RATIO[1:])
        ratio = exp(log(low) + share * log(high / low))
        load = exp(log(LOAD) + place[1] * log(LARGEST_LOAD[ratio < WIDE] / LOAD))
        oil = OIL if kind == "fit" else any_oil(random)
        groups = moes(load, LUBRICANT[0] + place[2] * (LUBRICANT[1] - LUBRICANT[0]), ratio, oil=oil)
        strata = STRATA if load < LIGHT else STRATA[:-1]
        layers = [exp(random.uniform(log(a), log(b))) for a, b in strata]
        if scale_contact(groups).hertz_pressure * oil.pressure_viscosity <= LARGEST_EXPONENT:
            found.append((len(found), groups, layers))
        if len(found) == count:
            break
    return found


def any_oil(random):
    """Roelands or Barus, Dowson and Higginson's density or none."""
    oil = replace(OIL, pressure_viscosity=random.uniform(10e-9, 28e-9), roelands_z=random.uniform(0.45, 0.75))
    if random.random() < 0.2:
        oil = replace(oil, viscosity_law=ViscosityLaw.BARUS)
    if random.random() < 0.15:
        oil = replace(oil, density_law=DensityLaw.INCOMPRESSIBLE)
    return oil


def points_for(contact):
    """Points that make the mesh fine enough, by the film formula."""
    if contact.film_guess > THICK:
        return POINTS[0]
    box = choose_domain(contact)
    mesh = sqrt(contact.film_guess / contact.curvature_x / FINENESS)
    cells = (box[1] - box[0]) * contact.half_extent_x / mesh
    return int(min(max(2 ** np.ceil(np.log2(cells)) + 1, POINTS[0]), POINTS[1]))


def films(solution):
    """Value, bar, finest of central and minimum film."""
    pairs = (solution.film_central_dimensionless, solution.film_minimum_dimensionless)
    return [[f.value, f.uncertainty, f.finest] for f in pairs]


def record(solution):
    """What is kept of a solution; moments over p_h a^3, by the pressure's lever and by the heat of its flow."""
    moment, change = pressure_moment(solution, scaled_as_solved(solution))
    return {
        "films": films(solution),
        "moment": moment,
        "moment by heat": moment + change,
        "converged": solution.converged,
        "resolved": solution.resolved,
        "pressure": float(solution.P.max()),
    }


def solved(groups, layers, points):
    """Flooded solution and those behind layers, on one mesh."""
    conditions = from_groups(groups, modulus=MODULUS)
    options = SolverOptions(points=points)
    flooded, _ = solve_attempts(conditions, options)
    if not flooded.converged:
        return {"flooded": record(flooded), "starved": []}
    contact = scale_contact(conditions)
    unit = 1.0 / inlet_ratio(1.0, flooded, contact)  # layer of r = 1, in a^2/Rx
    starved = []
    for ratio in layers:
        layer = InletLayer(thickness=(ratio * unit * flooded.film_scale,))
        guess = starved_film_guess(flooded.film_central_dimensionless.value, ratio)
        behind = replace(conditions, inlet_layer=layer)
        solution, levels = solve_attempts(behind, options, film_guess=guess)
        supply = oil_supply(flooded, solution, levels, ratio)
        starved.append({**record(solution), "meniscus": supply.meniscus})
    return {"flooded": record(flooded), "starved": starved}


def rounded(entry):
    """The same with seven digits."""
    if isinstance(entry, dict):
        return {key: rounded(value) for key, value in entry.items()}
    if isinstance(entry, list):
        return [rounded(value) for value in entry]
    return float(f"{entry:.7g}") if isinstance(entry, float) else entry


def line(kind, number, groups, layers):
    """Everything about one contact."""
    points = points_for(scale_contact(groups))
    oil = groups.lubricant
    return {
        "kind": kind,
        "number": number,
        "M": groups.load_parameter,
        "L": groups.lubricant_parameter,
        "ratio": groups.radius_ratio,
        "oil": [oil.viscosity_law.value, oil.density_law.value, oil.pressure_viscosity, oil.roelands_z],
        "layers": layers,
        "points": points,
        "fine": solved(groups, layers, points),
        "coarse": solved(groups, layers, points // 2 + 1),
    }


def main():
    """Solve what the file lacks."""
    counts = dict(zip(("fit", "held"), map(int, sys.argv[1:3]), strict=True))
    lines = SOLVES.read_text().splitlines() if SOLVES.exists() else []
    done = {(entry["kind"], entry["number"]) for entry in map(json.loads, lines)}
    wanted = [(one[0] / count, kind, *one) for kind, count in counts.items() for one in contacts(kind, count)]
    for _, kind, number, groups, layers in sorted(wanted, key=lambda one: one[0]):
        usual = THINNEST < scale_contact(groups).film_guess < LIGHTEST
        if (kind, number) in done or not (usual or number < FEW[kind]):
            continue
        entry = line(kind, number, groups, layers)
        with SOLVES.open("a") as file:
            file.write(json.dumps(rounded(entry), separators=(",", ":")) + "\n")
        text = f"{kind} {number} M {entry['M']:.0f} L {entry['L']:.1f} {entry['ratio']:.3f} points {entry['points']}"
        print(text, flush=True)


if __name__ == "__main__":
    main()
