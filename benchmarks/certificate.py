"""Newton steps from solved contacts, from unsolved ones and from a Hertz pressure:
`python benchmarks/certificate.py [points ...]`.

Per contact and start: what the cycles took and left, what Newton's method took, and what it changed. One deflection
is one FFT forward and back on the finest grid.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

from oilfilm.ehl import SolverOptions
from oilfilm.ehl.multigrid.cycle import relative_residual
from oilfilm.ehl.multigrid.full_multigrid import ATTEMPTS, start_from_hertz
from oilfilm.ehl.multigrid.history import film_values
from oilfilm.ehl.multigrid.newton import certify
from oilfilm.ehl.solver import solve_attempts

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tools"))  # holds `verification`

from verification.contacts import OIL, SKEWED, TURNING, moes

CONTACTS = {
    "M 20, L 10": moes(20.0, 10.0, oil=OIL),
    "M 200, L 10": moes(200.0, 10.0, oil=OIL),
    "M 1000, L 10": moes(1000.0, 10.0, oil=OIL),
    "M 50, L 0": moes(50.0, 0.0, oil=OIL),
    "M 50, L 0.5": moes(50.0, 0.5, oil=OIL),
    "M 500, L 15, Rx/Ry 0.1": moes(500.0, 15.0, 0.1, oil=OIL),
    "turning": TURNING,
    "skewed 72 degrees": SKEWED,
}
STARTS = {"solved": 20, "one cycle": 1, "Hertz": 1}  # cycles on the finest level


def line(name, points, start):
    """One contact from one start."""
    began = time.process_time()
    options = SolverOptions(points=points, max_cycles=STARTS[start])
    solution, state = solve_attempts(CONTACTS[name], options, attempts=ATTEMPTS[:1])
    multigrid = time.process_time() - began
    index = len(state.levels) - 1
    if start == "Hertz":
        state.exterior = 0.0
        start_from_hertz(state, index)
    left = relative_residual(state, index)[0]
    began = time.process_time()
    c = certify(state)
    newton = time.process_time() - began
    films = film_values(state.levels[index].grid, state.levels[index].H)
    outcome = "certified" if c.certified else f"NOT: {c.message}"
    print(
        f"{name:23} {points:4} {start:9} {solution.record.fft_equivalents:5.1f} {left:8.1e} | "
        f"{len(c.residual) - 1:3} {c.deflections:4} {c.factorisations:3} {c.residual[-1]:8.1e} {c.film_change:8.1e} "
        f"{newton / multigrid:6.1f} | {films[0]:.5f} {films[1]:.5f} {outcome}",
        flush=True,
    )


def main(points):
    """Print the table."""
    solve_attempts(CONTACTS["turning"], SolverOptions(points=33))  # compile
    solve_attempts(CONTACTS["M 20, L 10"], SolverOptions(points=33))
    print(
        f"{'':39} multigrid      | Newton: steps, deflections, factors, residual, film change, time/multigrid | films"
    )
    for number in points:
        for name in CONTACTS:
            for start in STARTS:
                line(name, number, start)


if __name__ == "__main__":
    main([int(argument) for argument in sys.argv[1:]] or [129])
