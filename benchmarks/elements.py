"""Work of the finite elements and of the multigrid at equal error: `python benchmarks/elements.py [POINTS ...]`.

Each contact is solved by elements on POINTS (65, 129, 257), started from the multigrid on 129, and by the multigrid on
33 to 513. Errors are those of the worse of the central and the minimum film beside the multigrid on 1025 points; what
its bar leaves open counts as error, so that no film is called closer than is known. The ratio is the processor time of
the elements, without their start, over that of the multigrid's coarsest mesh that is as close; above (>) where none is,
the time of 513 points.
"""

from __future__ import annotations

import statistics
import sys
import time
from pathlib import Path

from oilfilm.ehl import SolverOptions, solve_contact
from oilfilm.ehl.finite_element.solver import solve_contact_finite_element

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tools"))  # holds `verification`

from verification.contacts import OIL, Named, moes
from verification.elements import CONTACTS, RACES

POINTS = (65, 129, 257)
GRIDS = (33, 65, 129, 257, 513)
START, REFERENCE = 129, 1025
GROUPS = (
    (10.0, 5.0, 0.03),
    (1000.0, 10.0, 1.0),
    (1000.0, 10.0, 0.1),
    (2000.0, 28.0, 1.0),
    (1000.0, 25.0, 0.05),
    (200.0, 28.0, 1.0),
    (200.0, 20.0, 0.3),
    (50.0, 28.0, 1.0),
    (100.0, 0.0, 1.0),
)
OTHERS = tuple(Named(f"M {m:g}, L {l:g}, R_x/R_y {ratio:g}", moes(m, l, ratio, oil=OIL)) for m, l, ratio in GROUPS)


def films(solution):
    """Central and minimum film."""
    return solution.film_central_dimensionless, solution.film_minimum_dimensionless


def timed(solve, *arguments):
    """What it returns, and its processor time [s]: the better of two runs."""
    times = []
    for _ in range(2):
        began = time.process_time()
        found = solve(*arguments)
        times.append(time.process_time() - began)
    return found, min(times)


def error(solution, reference):
    """Of the worse film, what the reference leaves open counted in [-]; infinite without a film."""
    if not solution.converged:
        return float("inf")
    pairs = zip(films(solution), films(reference), strict=True)
    return max((abs(ours.value - fine.value) + fine.uncertainty) / fine.value for ours, fine in pairs)


def main():
    """One line per contact and mesh of elements."""
    points = [int(p) for p in sys.argv[1:]] or POINTS
    ratios = {n: [] for n in points}
    for named in (*CONTACTS, *RACES, *OTHERS):
        reference = solve_contact(named.conditions, SolverOptions(points=REFERENCE))
        start = solve_contact(named.conditions, SolverOptions(points=START))
        grids = [(n, *timed(solve_contact, named.conditions, SolverOptions(points=n))) for n in GRIDS]
        for n in points:
            options = SolverOptions(points=n)
            mesh, seconds = timed(solve_contact_finite_element, named.conditions, options, start)
            if not mesh.converged:
                print(f"{named.name:48s} {n:4d}: {mesh.message}", flush=True)
                continue
            reached = error(mesh, reference)
            close = [(g, t) for g, solution, t in grids if error(solution, reference) <= reached]
            grid, work = close[0] if close else (GRIDS[-1], grids[-1][2])
            ratios[n].append(seconds / work)
            text = f"{named.name:48s} {n:4d}: {100 * reached:7.3f} %, {seconds:6.2f} s, multigrid on {grid:3d}"
            print(f"{text}{' ' if close else '>'} {work:6.3f} s, ratio {ratios[n][-1]:5.1f}", flush=True)
    for n in points:
        found = sorted(ratios[n])
        text = f"median {statistics.median(found):.1f}, largest {found[-1]:.1f}"
        print(f"points {n}: {len(found)} contacts, ratio {text}, above 10: {sum(r > 10 for r in found)}")


if __name__ == "__main__":
    main()
