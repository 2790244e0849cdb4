"""What the open box leaves open: `python benchmarks/box_error.py [NUMBER [SEED]]`, random contacts in twice their box.

Each contact is solved on 257 points, and in a box of twice the size on 513; changes of the central film and of H0 of
these, over the share of the load outside and (H0) 1 + Hc, beside what the error bars hold. Contacts whose cycles and
residuals leave more open than a hundredth of the share are left out.
"""

from __future__ import annotations

import sys
from pathlib import Path
from unittest.mock import patch

import numpy as np

from oilfilm.ehl import SolverOptions, solver
from oilfilm.ehl.multigrid.full_multigrid import BOX_ERROR, BOX_ERROR_ROTATION, choose_domain
from oilfilm.ehl.scaling import scale_contact

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tools"))  # holds `verification`

from verification.draws import draws

NUMBER, SEED = 90, 778
POINTS = 257
KNOWN = 0.01  # error of cycles and equations over the share of the load outside, up to which a change counts


def solved(conditions, factor):
    """Film and approach without their bars, the share outside and the error by cycles, all [-]; None: no film."""

    def widened(contact):
        return tuple(factor * end for end in choose_domain(contact))

    with patch.object(solver, "choose_domain", widened):
        points = (POINTS - 1) * factor + 1
        solution, levels = solver.solve_attempts(conditions, SolverOptions(points=points))
    if not solution.converged:
        return None
    record = solution.record
    noise = 2.5 * record.residual[-1] + abs(record.force_error[-1]) + record.film_change[-1]
    outside = abs(levels.exterior) / levels.contact.load
    film, approach = solution.film_central_dimensionless, solution.approach_dimensionless
    return film.finest, approach.value, outside, noise


def main(number, seed):
    """Print a line for each contact, then the largest changes of each kind."""
    largest = {}
    for draw in draws(number, seed):
        own, twice = (solved(draw.conditions, factor) for factor in (1, 2))
        if own is None or twice is None or own[3] + twice[3] > KNOWN * own[2]:
            continue
        contact = scale_contact(draw.conditions)
        film, share = own[0], own[2]
        thick = film / (contact.curvature_y * contact.half_extent_y**2)
        held = BOX_ERROR + BOX_ERROR_ROTATION * (contact.turning * (1.0 + 2.0 * thick)) ** 2
        change = abs(twice[0] / film - 1.0) / share
        moved = abs(twice[1] - own[1]) / share / (1.0 + film)
        print(f"{draw.number:4} {draw.kind:12} {draw.text:60} outside {share:6.2%}", end="  ")
        print(f"film {change:.4f}, H0 {moved:.4f}; held {held:.4f}", flush=True)
        largest.setdefault(draw.kind, []).append((change, moved, max(change, moved) / held))
    for kind, found in largest.items():
        films, approaches, shares = np.array(found).T
        print(f"{kind}: {len(found)} contacts, median and largest change", end=" ")
        print(f"of the film {np.median(films):.4f} {films.max():.4f}", end=", ")
        print(f"of H0 {np.median(approaches):.4f} {approaches.max():.4f}", end="; ")
        print(f"both within what the bars hold: {np.sum(shares <= 1.0)}")


if __name__ == "__main__":
    given = [int(word) for word in sys.argv[1:]]
    main(*given, *(NUMBER, SEED)[len(given) :])
