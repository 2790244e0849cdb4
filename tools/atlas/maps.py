"""Maps of the film atlas beside solved films: `python tools/atlas/maps.py SEED COUNT`.

Contacts drawn over the range of the atlas (A 0.4 to 150, L 0.5 to 29, R_x/R_y 0.012 to 0.9, alpha 8 to 32 1/GPa, z 0.4
to 0.8), each solved on 257 points. Differences of pressure over Hertz' pressure, those of the gap over the gap of the
solution as its central and smallest film are those of the atlas: as a run draws them. Medians and 95 % of contacts.
"""

from __future__ import annotations

import sys
from math import exp, log, sqrt

import numpy as np
import scipy

from oilfilm.bearing.films.film import FilmThickness, with_films
from oilfilm.ehl import ContactConditions, Lubricant, SolverOptions, solve_contact
from oilfilm.ehl.atlas.field_maps import field_maps
from oilfilm.ehl.closed_form.hertz import hertz_coefficients
from oilfilm.ehl.traction.instruments import film_instruments

RADIUS, MODULUS, VISCOSITY, PERMITTIVITY = 5e-3, 2.3e11, 0.05, 2.2
CLASSES = (("A 15 to 150", 15.0, 150.0), ("A 2.8 to 15", 2.8, 15.0), ("A 0.4 to 2.8", 0.4, 2.8))
NAMES = ("pressure, rms in the contact", "gap in the contact, median", "gap in the contact, 95 %", "capacitance")


def drawn(rng, low, high):
    """Contact of an A in this range."""
    heavy, thick, ratio = exp(rng.uniform(log(low), log(high))), rng.uniform(0.5, 29.0), exp(rng.uniform(-4.4, -0.1))
    alpha, z = rng.uniform(8e-9, 32e-9), rng.uniform(0.4, 0.8)
    twice = (thick / (alpha * MODULUS)) ** 4
    axis = sqrt(heavy * sqrt(twice))
    return ContactConditions(
        load=MODULUS * RADIUS**2 * (axis / hertz_coefficients(ratio)[0]) ** 3,
        radius_x=RADIUS,
        radius_y=RADIUS / ratio,
        reduced_modulus=MODULUS,
        entrainment_speed=twice * MODULUS * RADIUS / (2.0 * VISCOSITY),
        lubricant=Lubricant(viscosity=VISCOSITY, pressure_viscosity=alpha, roelands_z=z),
    )


def errors(conditions):
    """Numbers of `NAMES`; None of a contact without a map or a solution."""
    (found,) = field_maps([conditions])
    solved = solve_contact(conditions, SolverOptions(points=257))
    if found is None or not (solved.converged and solved.resolved):
        return None
    films = [
        FilmThickness(film.value * found.film_scale)
        for film in (found.film_central_dimensionless, found.film_minimum_dimensionless)
    ]
    found, solved = with_films(found, *films), with_films(solved, *films)
    splines = (scipy.interpolate.RectBivariateSpline(found.X, found.Y, values) for values in (found.P, found.H))
    pressure, gap = (spline(solved.X, solved.Y) for spline in splines)
    contact = solved.P > 0.02 * solved.P.max()
    thin = abs(gap / solved.H - 1.0)[contact]
    pressed = (pressure - solved.P)[contact] / max(1.0, solved.P.max())
    stored = [film_instruments(one, PERMITTIVITY).capacitance for one in (found, solved)]
    return (
        float(np.sqrt((pressed**2).mean())),
        np.median(thin),
        np.quantile(thin, 0.95),
        abs(stored[0] / stored[1] - 1.0),
    )


def main():
    """A line for each range of A."""
    rng = np.random.default_rng(int(sys.argv[1]))
    for name, low, high in CLASSES:
        rows = [row for _ in range(int(sys.argv[2])) if (row := errors(drawn(rng, low, high))) is not None]
        table = 100.0 * np.array(rows)
        shown = (f"{np.median(v):.2g} / {np.quantile(v, 0.95):.2g}" for v in table.T)
        print(
            f"{name} ({len(rows)}): " + ", ".join(f"{n} {v} %" for n, v in zip(NAMES, shown, strict=True)), flush=True
        )


if __name__ == "__main__":
    main()
