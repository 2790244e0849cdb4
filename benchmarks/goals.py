"""Work of one film against its goals, on one thread: `python benchmarks/goals.py [--quick]`.

First the time of a solve at 257, 513 and 1025 points; then the work that reaches 1 % in both films, in pairs of padded
FFTs (forward and inverse, real, double, 513 points each way, on twice as many) timed in the same run. The film
that counts as true is that of 1025 points. `--quick`: without the solves at 1025 points of the first table.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

import numpy as np
from scipy import fft

from oilfilm.ehl import SolverOptions, solve_contact

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tools"))  # holds `verification`

from verification.contacts import moes

SECONDS = {257: 0.07, 513: 0.2, 1025: 0.6}  # goals
PAIRS = 13.0  # goal, mean of `HARD`
HARD = {
    "M 200, L 10": moes(200.0, 10.0),
    "M 1000, L 10": moes(1000.0, 10.0),
    "M 1000, L 3, ratio 0.2": moes(1000.0, 3.0, 0.2),
}
TIMED = {"M 20, L 10": moes(20.0, 10.0), **HARD}
POINTS = (65, 129, 257, 513, 1025)
ACCURACY = 0.01
REPEATS = 3


def shortest(function):
    """Least processor time of this thread over some calls [s], and the last result."""
    times = []
    for _ in range(REPEATS):
        began = time.thread_time()
        result = function()
        times.append(time.thread_time() - began)
    return min(times), result


def fft_pair():
    """Time of a padded FFT there and back [s]."""
    field = np.random.default_rng(9137).random((1026, 1026))
    return shortest(lambda: fft.irfft2(fft.rfft2(field), field.shape))[0]


def films(solution):
    """Central and minimum film [-]."""
    return np.array([solution.film_central_dimensionless.value, solution.film_minimum_dimensionless.value])


def main(quick):
    """Print both tables."""
    solve_contact(TIMED["M 20, L 10"], SolverOptions(points=65))  # compile
    print("contact                  points   time s  goal s   deflections  cycles on the finest")
    for name, conditions in TIMED.items():
        for points, goal in SECONDS.items():
            if quick and points > 513:
                continue
            seconds, found = shortest(lambda c=conditions, n=points: solve_contact(c, SolverOptions(points=n)))
            record = found.record
            print(f"{name:24} {points:6} {seconds:8.3f} {goal:7.2f} {record.fft_equivalents:13.1f} {record.cycles:10}")
    pair = fft_pair()
    print(f"\npair of FFTs {1e3 * pair:.1f} ms\ncontact                  points  error of Hc, Hmin %  pairs")
    needed = []
    for name, conditions in HARD.items():
        truth = films(solve_contact(conditions, SolverOptions(points=POINTS[-1])))
        for points in POINTS[:-1]:
            seconds, found = shortest(lambda c=conditions, n=points: solve_contact(c, SolverOptions(points=n)))
            errors = np.abs(films(found) / truth - 1.0)
            if found.converged and (errors <= ACCURACY).all():
                break
        needed.append(seconds / pair)
        print(f"{name:24} {points:6} {100 * errors[0]:12.2f} {100 * errors[1]:6.2f} {needed[-1]:8.1f}")
    print(f"mean {np.mean(needed):.1f} pairs, goal {PAIRS:.0f}")


if __name__ == "__main__":
    main("--quick" in sys.argv[1:])
