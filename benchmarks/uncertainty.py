"""Do the error bars cover? `python benchmarks/uncertainty.py`: sixteen contacts, coarser grids against 1025 points.

The truth is the value extrapolated from 1025 points along x; the same levels, cut off after 129, 257 and 513 points,
give the values and bars that are judged. The bars' one constant (`ORDER_DOUBT`) was chosen on these contacts.
"""

from __future__ import annotations

import numpy as np

from ehl import Lubricant, MoesConditions, SolverOptions
from ehl.multigrid.extrapolation import extrapolate
from ehl.multigrid.full_multigrid import Progress, solve_with_fallbacks
from ehl.scaling import scale_contact
from ehl.solver import choose_domain

OIL = Lubricant(viscosity=0.05, pressure_viscosity=18e-9)
CONTACTS = (  # M, L, Rx/Ry, angle of the entrainment
    (20, 10, 1, 0),
    (200, 10, 1, 0),
    (1000, 10, 1, 0),
    (12, 25, 0.055, 0),
    (100, 8, 0.3, 0.5),
    (2000, 20, 0.02, 0),
    (1000, 2, 0.1, 0),
    (300, 15, 2, 0),
    (100, 8, 5, 0),
    (700, 12, 0.03, 0),
    (5, 0.5, 1, 0),
    (50, 20, 0.5, 0.8),
    (400, 5, 0.5, 0),
    (620, 28, 0.022, 0),
    (30, 3, 0.1, 0.2),
    (150, 0, 1, 0),
)


def level_films(m, l, ratio, angle):
    """Central and minimum film of every level up to 1025 points, and finest hx."""
    conditions = MoesConditions(
        load_parameter=m, lubricant_parameter=l, radius_ratio=ratio, entrainment_angle=angle, lubricant=OIL
    )
    contact = scale_contact(conditions)
    outcome = solve_with_fallbacks((contact, contact), choose_domain(contact), SolverOptions(points=1025), Progress())
    return outcome.films, outcome.state.levels[-1].grid.hx


def main():
    """Print coverage and size of the bars, resolved values only."""
    found = {129: [], 257: [], 513: []}
    for contact in CONTACTS:
        films, hx = level_films(*contact)
        for kind in (0, 1):
            values = [film[kind] for film in films]
            truth = extrapolate(values, 0.0)
            for cut, points in ((3, 129), (2, 257), (1, 513)):
                if len(values) - cut < 2 or films[-1 - cut][1] < 5.0 * (hx * 2**cut) ** 2:
                    continue
                bar = extrapolate(values[:-cut], 3e-4)
                found[points].append((abs(bar.value - truth.value), bar.uncertainty, truth.uncertainty, truth.value))
    print("points  values  covered   bar: median    largest   error/bar: median   largest")
    for points, rows in found.items():
        error, bar, doubt, value = np.array(rows).T
        covered = int(np.sum(error <= bar + doubt))
        ratio, relative = error / bar, bar / value
        print(
            f"{points:6} {len(rows):7} {covered:8} {np.median(relative):14.2%} {relative.max():10.1%}"
            f"{np.median(ratio):20.2f} {ratio.max():9.2f}"
        )


if __name__ == "__main__":
    main()
