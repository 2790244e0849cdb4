"""Time of the quasi-static bearing: `python benchmarks/quasistatic.py`.

One solve of an 18-ball bearing (7008, combined load, 12000 r/min) cold and from a neighbour's solution, of a pair of
rows, and a map of 50 x 50 slip factors (7000C, 100 N radial) on one and on two processes. Budgets: 20 ms and 20 s.
"""

from __future__ import annotations

from dataclasses import replace
from statistics import median
from time import perf_counter, process_time

from oilfilm.bearing import Arrangement, duplex, solve_quasistatic
from oilfilm.cases import load_case
from oilfilm.cases.runs.stiffness_and_slip import run_slip

REPEATS = 50


def timed(name, solve):
    """Print median and least time of a call, after one that fills the caches, and its processor time."""
    solve()
    walls, processor = [], process_time()
    for _ in range(REPEATS):
        start = perf_counter()
        solve()
        walls.append(1e3 * (perf_counter() - start))
    processor = 1e3 * (process_time() - processor) / REPEATS
    print(f"{name:28} median {median(walls):5.1f} ms, least {min(walls):5.1f} ms, processor {processor:5.1f} ms")


def solves():
    """One line a kind of solve."""
    case = load_case("7008_back_to_back")
    bearing, operation = case.bearing, replace(case.operation, force=(400.0, 300.0, 0.0))
    near = solve_quasistatic(bearing, operation)
    beside = replace(operation, inner_speed=1.01 * operation.inner_speed)
    free = replace(operation, moment=(0.0, 0.0), tilt=(None, None))
    rows = duplex(bearing, Arrangement.BACK_TO_BACK, 15e-3, preload_force=250.0)
    timed("18 balls", lambda: solve_quasistatic(bearing, operation))
    timed("18 balls, free to tilt", lambda: solve_quasistatic(bearing, free))
    timed("18 balls, from a neighbour", lambda: solve_quasistatic(bearing, beside, None, near))
    timed("2 x 18 balls, back to back", lambda: solve_quasistatic(bearing, operation, rows=rows))


def surfaces():
    """Maps of slip factors, start of the processes included."""
    case = load_case("hirano_7000C")
    table = case.file.slip.model_copy(update={"points": 50, "critical_speeds_rpm": ()})
    file = case.file.model_copy(update={"slip": table})
    case = replace(case, file=file, operation=replace(case.operation, force=(100.0, 100.0, 0.0)))
    for workers in (1, 2):
        results = run_slip(case, "hirano_7000C", workers)
        print(f"50 x 50 slip factors, {workers} processes: {results.timing['surface']:6.1f} s")


if __name__ == "__main__":
    solves()
    surfaces()
