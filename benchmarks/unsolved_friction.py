"""Friction of contacts without a solve beside that of solved ones.

python benchmarks/unsolved_friction.py [seed] [bearing contacts] [others]

Contacts of balls on races of random bearings, and random ones of the whole range (`verification.draws`), are solved on
129 points. Their friction is that of the nodes that balls are balanced on, pressure and film of the film atlas with the
solved central film, against sums over the solved film, at sliding of 0.001, 0.01 and 0.1 of the entrainment along and
across, and by spin alone. Printed in % of that friction, by class: median, and what 90 % are within.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

from oilfilm.bearing.films.unsolved_films import hertz_size, plain_film
from oilfilm.bearing.friction._kernels import film_frictions
from oilfilm.bearing.friction.film_friction import MIN_SLIDING
from oilfilm.bearing.friction.film_nodes import FilmOnSurface, joined_nodes, unsolved_nodes
from oilfilm.ehl import ContactConditions, Lubricant, SolverOptions, solve_contact
from oilfilm.ehl.atlas.films import atlas_load
from oilfilm.ehl.closed_form.hertz import MEAN_PRESSURE_RATIO, hertz_coefficients
from oilfilm.ehl.oil.rheology import Rheology, ShearLaw, contact_rheology
from oilfilm.ehl.scaling import scale_contact
from oilfilm.ehl.traction.film_quadrature import film_quadrature, sliding_forces

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tools"))  # holds `verification`

from verification.draws import draws

SHEAR = Rheology(law=ShearLaw.REE_EYRING, eyring_coefficient=0.047, limiting_coefficient=0.047, limiting_minimum=5e6)
RATIOS = (1e-3, 1e-2, 0.1)
DIRECTIONS = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
PART = (0, 1, 2)  # of the friction, that is looked at in each
TURNING = 0.02


def of_bearings(count, seed):
    """Contacts of balls of 3 to 40 mm on races, 0.5 to 2.8 GPa, 0.3 to 30 m/s, L up to 30."""
    random, found = np.random.default_rng(seed), []
    while len(found) < count:
        ball, groove = 10.0 ** random.uniform(-2.5, -1.4), random.uniform(0.51, 0.56)
        side = random.choice([-1.0, 1.0]) * random.uniform(0.1, 0.35)
        along, across = 0.5 * ball * (1.0 + side), 1.0 / (2.0 / ball - 1.0 / (groove * ball))
        modulus, pressure = random.choice([2.26e11, 3.0e11]), 10.0 ** random.uniform(8.7, 9.45)
        g = hertz_coefficients(along / across)[1]
        oil = Lubricant(
            viscosity=10.0 ** random.uniform(-2.3, -0.7),
            pressure_viscosity=random.uniform(1e-8, 2.6e-8),
            roelands_z=random.uniform(0.45, 0.75),
        )
        own = ContactConditions(
            load=(pressure / (g * modulus)) ** 3 * modulus * along**2,
            radius_x=along,
            radius_y=across,
            reduced_modulus=modulus,
            entrainment_speed=10.0 ** random.uniform(-0.5, 1.5),
            lubricant=oil,
        )
        scaled = scale_contact(own)
        if scaled.moes_load > 3.0 and scaled.moes_lubricant < 30.0:
            found.append(own)
    return found


def kind(conditions):
    """What is printed together."""
    scaled = scale_contact(conditions)
    load, law = atlas_load(scaled), conditions.lubricant.viscosity_law.value
    if law != "roelands":
        return law
    if scaled.radius_ratio > 1.0:
        return "R_x/R_y above 1"
    for below, text in ((2.8, "A below 2.8"), (5.0, "A 2.8 to 5"), (10.0, "A 5 to 10"), (15.0, "A 10 to 15")):
        if load < below:
            return text
    if load > 160.0:
        return "A above 160"
    turning = ", turning" if scaled.turning > TURNING else ""
    return ("A 15 to 160" if 1.0 <= scaled.moes_lubricant else "L below 1") + turning


def errors(conditions):
    """Of the friction at all motions, over it, shape (ratios, directions); None where the film is not resolved."""
    solution = solve_contact(conditions, SolverOptions(points=129))
    if not (solution.converged and solution.resolved):
        return None
    size = hertz_size(conditions)
    u, longer = conditions.entrainment_speed, max(size[:2])
    motions = np.array([[r * u * x, r * u * y, r * u * n / longer, 0.0] for r in RATIOS for x, y, n in DIRECTIONS])
    law = contact_rheology(SHEAR, conditions.lubricant, MEAN_PRESSURE_RATIO * size[2])
    slides = tuple(np.ascontiguousarray(part) for part in motions.T[:3])
    solved = -sliding_forces(film_quadrature(solution, law), slides, np.zeros(len(motions)), 0.0)
    film = plain_film(conditions, solution.film_central)
    own, block = unsolved_nodes([FilmOnSurface(film, 0.0, size[1])] * len(motions), SHEAR, None)
    *films, own = joined_nodes([block], own)
    friction, slope = np.empty((len(motions), 4)), np.empty((len(motions), 4, 4))
    film_frictions(*films, motions, own, MIN_SLIDING, friction, slope)
    k = np.tile(PART, len(RATIOS))
    found, known = friction[np.arange(len(k)), k], solved[np.arange(len(k)), k]
    return (found / known - 1.0).reshape(len(RATIOS), len(DIRECTIONS))


def main(seed=20261127, bearings=60, others=80):
    """Solve and print."""
    contacts = of_bearings(bearings, seed)
    contacts += [
        draw.conditions
        for draw in draws(others, seed)
        if draw.kind != "at an angle" and draw.conditions.lubricant.piezoviscous
    ]
    found = {}
    for conditions in contacts:
        own = errors(replace(conditions, slide_roll_ratio=0.0))
        if own is not None:
            found.setdefault(kind(conditions), []).append(own)
    print("errors [%], median / 90 %, of sliding along, across and of spin; slide-roll ratios", *RATIOS)
    for name, rows in sorted(found.items()):
        middle = 100.0 * np.median(rows, axis=0)
        most = 100.0 * np.quantile(np.abs(rows), 0.9, axis=0)
        pairs = zip(middle.ravel(), most.ravel(), strict=True)
        print(f"{name:24} {len(rows):3}  " + "  ".join(f"{m:5.1f}/{q:4.1f}" for m, q in pairs))


if __name__ == "__main__":
    main(*(int(argument) for argument in sys.argv[1:]))
