"""Cost and accuracy of the contact solve: `python benchmarks/contact.py [points ...]`.

Prints, for a few contacts and grids, film values, uncertainties and work; times are also given as multiples
of one deflection FFT (forward and inverse, padded) of the same grid, measured in the same run. One thread, compiled
before the clock starts.
"""

from __future__ import annotations

import sys
from pathlib import Path

from oilfilm.ehl import SolverOptions, solve_contact

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tools"))  # holds `verification`

from verification.contacts import CIRCULAR_20_10, CIRCULAR_200_10, Named, race_6208
from verification.costs import deflection_time

CONTACTS = (
    CIRCULAR_20_10,
    CIRCULAR_200_10,
    Named(name="6208 outer, 1612 N", conditions=race_6208(1611.8, outer=True)),
    Named(name="6208 outer, 15 N", conditions=race_6208(15.48, outer=True)),
)


def main(points):
    """Print one line per contact and grid."""
    solve_contact(CIRCULAR_20_10.conditions, SolverOptions(points=65))  # compile
    head = "contact                grid        Hc +- u           Hmin +- u         cycles  FFTs   time s  /FFT"
    print(head)
    for contact in CONTACTS:
        for n in points:
            runs = [solve_contact(contact.conditions, SolverOptions(points=n, domain=contact.box)) for _ in range(3)]
            s = min(runs, key=lambda run: run.record.wall_time)
            c, m, r = s.film_central_dimensionless, s.film_minimum_dimensionless, s.record
            print(
                f"{contact.name:21} {s.X.size:5}x{s.Y.size:<5} {c.value:8.5f} +- {c.uncertainty:.5f} {m.value:8.5f} +- "
                f"{m.uncertainty:.5f} {r.cycles:4} {r.fft_equivalents:7.1f} {r.wall_time:8.3f} "
                f"{r.wall_time / deflection_time(s):6.0f}{'' if s.converged else '  NOT CONVERGED'}"
            )


if __name__ == "__main__":
    main([int(argument) for argument in sys.argv[1:]] or [129, 257, 513])
