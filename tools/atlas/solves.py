"""Solves of the film atlas: `python tools/atlas/solves.py [missing] [A<25] heavy 300 oil 110 ...`, parts and counts.

Every contact is solved on 257 and 513 points, and on 1025 where their extrapolated films differ. One line of
JSON a contact in `build/atlas_solves.jsonl`; those that it has are left out, so that a run that was stopped goes on.
The parts come in the order they are named; with a bound on A, those of their contacts that are lighter;
after the word `missing`, those only whose labels the repository lacks.
"""

from __future__ import annotations

import csv
import gzip
import json
import sys
import time
from math import inf
from pathlib import Path

import numpy as np
from contacts import places

from oilfilm.ehl import SolverOptions
from oilfilm.ehl.solver import solve_attempts
from oilfilm.ehl.traction.rolling_moment import rolling_moment

SOLVES = Path(__file__).parents[2] / "build" / "atlas_solves.jsonl"
LABELS, SKEWED = (Path(__file__).with_name(name) for name in ("labels.csv.gz", "skewed.csv.gz"))
POINTS = (257, 513, 1025)
# by which the extrapolated films of 257 and 513 points differ where 1025 are taken, also at an angle
FURTHER, FURTHER_SKEWED = (0.002, 0.006), (0.005, 0.02)
# layers of oil up to which the rolling moment is counted, over (a^2/Rx) (1 + H_c)
LAYERS = (8.0, 25.0, 400.0)


def dip(before, middle, after):
    """Smallest value of the parabola through three equidistant values."""
    curvature = before - 2.0 * middle + after
    return middle - ((after - before) ** 2 / (8.0 * curvature) if curvature > 0.0 else 0.0)


def minima(solution):
    """Smallest film on the line y = 0, and on the sides, where it has a minimum of its own there."""
    H = solution.H[:, solution.Y >= 0.0]
    at = np.clip(H.argmin(axis=0), 1, H.shape[0] - 2)
    columns = np.arange(H.shape[1])
    lines = np.array([dip(H[i - 1, j], H[i, j], H[i + 1, j]) for i, j in zip(at, columns, strict=True)])
    low = [j for j in range(1, len(lines) - 1) if lines[j] <= lines[j - 1] and lines[j] < lines[j + 1]]
    if not low:
        return float(lines[0]), None
    j = min(low, key=lambda k: lines[k])
    return float(lines[0]), float(dip(lines[j - 1], lines[j], lines[j + 1]))


def record(solution, layers):
    """What is kept of a solution, films in a^2/Rx, moments over p_h a^3; none where the entrainment is at an angle."""
    films = (solution.film_central_dimensionless, solution.film_minimum_dimensionless)
    return {
        "points": solution.X.size,
        "films": [[f.value, f.uncertainty, f.finest] for f in films],
        "approach": solution.approach_dimensionless.value,
        "pressure": float(solution.P.max()),
        "converged": solution.converged,
        "resolved": solution.resolved,
        "residual": solution.record.residual[-1],
        "attempt": solution.record.attempt,
        "box": solution.domain,
        **({} if layers is None else straight(solution, layers)),
    }


def straight(solution, layers):
    """What else is kept of an entrainment along x."""
    scale = solution.hertz_pressure * solution.semi_axis_x**3
    centre, side = minima(solution)
    return {
        "line": centre,
        "side": side,
        "moments": [rolling_moment(solution, layer * solution.film_scale).value / scale for layer in layers],
    }


def solved(place, points=POINTS):
    """Everything about one contact."""
    start = time.process_time()
    conditions = place.conditions()
    solutions = []
    for count in points:
        solution, _ = solve_attempts(conditions, SolverOptions(points=count))
        solutions.append(solution)
        if count == POINTS[1] and not _further(*solutions, FURTHER if place.angle is None else FURTHER_SKEWED):
            break
    layers = [k * (1.0 + solution.film_central_dimensionless.value) for k in LAYERS]
    coarse, fine = ((), layers) if place.angle is None else (None, None)
    kept = [coarse] * (len(solutions) - 2) + [fine] * 2
    meshes = [record(solution, own) for solution, own in zip(solutions, kept, strict=True)]
    oil = place.oil
    return {
        "kind": place.kind,
        "number": place.number,
        "A": place.A,
        "L": place.L,
        "D": place.D,
        "angle": place.angle,
        "M": solution.moes_load,
        "alpha": oil.pressure_viscosity,
        "z": oil.roelands_z,
        "p_h": solution.hertz_pressure,
        "layers": layers,
        "meshes": meshes,
        "seconds": time.process_time() - start,
    }


def _further(coarse, fine, limits):
    """Whether the finest mesh is wanted."""
    if not (fine.converged and fine.resolved):
        return True
    names = ("film_central_dimensionless", "film_minimum_dimensionless")
    pairs = [(getattr(fine, name).value, getattr(coarse, name).value) for name in names]
    return any(abs(a / b - 1.0) > limit for (a, b), limit in zip(pairs, limits, strict=True))


def rounded(entry):
    """The same with eight digits."""
    if isinstance(entry, dict):
        return {key: rounded(value) for key, value in entry.items()}
    if isinstance(entry, list | tuple):
        return [rounded(value) for value in entry]
    return float(f"{entry:.8g}") if isinstance(entry, float) else entry


def wanted_counts(words):
    """Parts with their counts from the words of the command line."""
    names, counts = [], []
    for word in words:
        if word.isdigit():
            counts.append((" ".join(names), int(word)))
            names = []
        else:
            names.append(word)
    return counts


def labelled():
    """Kinds and numbers of the contacts whose labels the repository has."""
    found = set()
    for path in filter(Path.exists, (LABELS, SKEWED)):
        with gzip.open(path, "rt") as file:
            found |= {(row["kind"], int(row["number"])) for row in csv.DictReader(file)}
    return found


def main():
    """Solve what the file lacks."""
    words = sys.argv[1:]
    known = words[:1] == ["missing"]
    words = words[known:]
    lightest = [float(word[2:]) for word in words if word.startswith("A<")]
    most = min(lightest, default=inf)
    SOLVES.parent.mkdir(exist_ok=True)
    lines = SOLVES.read_text().splitlines() if SOLVES.exists() else []
    done = {(entry["kind"], entry["number"]) for entry in map(json.loads, lines)} | (labelled() if known else set())
    for kind, count in wanted_counts(words[len(lightest) :]):
        for place in places(kind, count):
            if (place.kind, place.number) in done or place.A >= most:
                continue
            entry = solved(place)
            with SOLVES.open("a") as file:
                file.write(json.dumps(rounded(entry), separators=(",", ":")) + "\n")
            done.add((place.kind, place.number))
            text = f"{kind} {place.number} A {place.A:.3g} L {place.L:.3g} D {place.D:.3g} {entry['seconds']:.1f} s"
            print(text, len(entry["meshes"]), flush=True)


if __name__ == "__main__":
    main()
