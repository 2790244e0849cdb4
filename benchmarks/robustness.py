"""Random contacts, untuned: `python benchmarks/robustness.py [draws] [seed]`.

Draws M 5-3000 (to 10 000 for Rx/Ry < 0.3), L 0-30, Rx/Ry 0.005-5, pressure-viscosity 8-30 1/GPa, three viscosity
and two density laws, a third of them with the entrainment at an angle; leaves out p_h > 4 GPa and alpha p_h > 80.
Each is solved with 257 points and, if that does not end converged and resolved, with 513 and 1025. Resolvable means
H_min/hx^2 >= 10 at 1025 points.
"""

from __future__ import annotations

import sys
from collections import Counter

import numpy as np

from ehl import DensityLaw, Lubricant, MoesConditions, SolverOptions, solve_contact
from ehl.scaling import CLOSED_FORM_LAWS, scale_contact

POINTS = (257, 513, 1025)


def draw(random):
    """One contact within the ranges, or None where pressure leaves them."""
    ratio = np.exp(random.uniform(np.log(0.005), np.log(5.0)))
    largest = 10_000.0 if ratio < 0.3 else 3000.0
    oil = Lubricant(
        viscosity=random.uniform(0.005, 0.1),
        pressure_viscosity=random.uniform(8e-9, 30e-9),
        viscosity_law=random.choice(list(CLOSED_FORM_LAWS), p=[0.7, 0.2, 0.1]),
        density_law=random.choice([DensityLaw.DOWSON_HIGGINSON, DensityLaw.INCOMPRESSIBLE], p=[0.8, 0.2]),
    )
    conditions = MoesConditions(
        load_parameter=np.exp(random.uniform(np.log(5.0), np.log(largest))),
        lubricant_parameter=random.uniform(0.0, 30.0),
        radius_ratio=ratio,
        lubricant=oil,
        entrainment_angle=random.uniform(0.0, np.pi / 2) if random.random() < 1 / 3 else 0.0,
    )
    pressure = scale_contact(conditions).hertz_pressure
    return conditions if pressure <= 4e9 and pressure * oil.pressure_viscosity <= 80.0 else None


def describe(conditions):
    """The contact in a line."""
    c = conditions
    return (
        f"M {c.load_parameter:.0f}, L {c.lubricant_parameter:.1f}, Rx/Ry {c.radius_ratio:.4f}, "
        f"{np.degrees(c.entrainment_angle):.0f} deg, {c.lubricant.viscosity_law.value}"
    )


def main(draws, seed):
    """Print what was not plain, and the table."""
    random, ends, measures = np.random.default_rng(seed), Counter(), Counter()
    while sum(ends.values()) < draws:
        conditions = draw(random)
        if conditions is None:
            continue
        for points in POINTS:
            solution = solve_contact(conditions, SolverOptions(points=points))
            if solution.converged and solution.resolved:
                break
        taken = [name for name in solution.record.fallbacks if not name.startswith("cycle")]
        fineness = solution.film_minimum_dimensionless.finest / (solution.X[1] - solution.X[0]) ** 2
        measures[taken[-1] if taken else "damping halved in passing" if solution.record.fallbacks else "none"] += 1
        if solution.converged and solution.resolved:
            ends[f"converged and resolved at {points} points"] += 1
            continue
        resolvable = "resolvable" if fineness >= 10.0 else "too thin to resolve"
        ends[f"{'unresolved' if solution.converged else 'not converged'} at {points} points, {resolvable}"] += 1
        print(f"{describe(conditions)}: H_min/hx^2 {fineness:.1f}, {solution.message}", flush=True)
    for title, counts in (("end", ends), ("strongest measure taken in the last solve", measures)):
        print(f"\n{title}")
        for name, count in counts.most_common():
            print(f"{count:6}  {name}")


if __name__ == "__main__":
    arguments = [int(argument) for argument in sys.argv[1:]]
    main(*(arguments + [100, 20261][len(arguments) :]))
