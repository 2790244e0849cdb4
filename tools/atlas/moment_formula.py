"""The rolling moment by formulas beside the atlas: `python tools/atlas/moment_formula.py SEED NUMBER`.

Draws contacts, M 1 to 3000, L 5 to 29, R_x/R_y 0.02 to 1, layers of 50, 100 and 400 um. Prints the constants of
`bearing.contacts.formula_moment` fitted to the atlas at half of them, and the errors of the program's at the others.
"""

from __future__ import annotations

import sys
from math import log
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares

from oilfilm.bearing.films.heavy_moment import heavy_moment, moment_unit
from oilfilm.bearing.films.moment import SLOPE, START, WIDTH, flooded_moment
from oilfilm.ehl import Lubricant, atlas_films
from oilfilm.ehl.atlas.films import NotInAtlasError
from oilfilm.ehl.scaling import scale_contact
from oilfilm.ehl.traction.rolling_moment import kapitza_moment

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))  # holds `verification`

from verification.contacts import from_groups, moes

LAYERS = (50e-6, 100e-6, 400e-6)  # [m]
ROBUST = 0.02  # error beyond which one counts less [-]
LOADS = ((1.0, 3000.0), (1.0, 30.0), (30.0, 300.0), (300.0, 3000.0))  # M


def drawn(rng):
    """A contact of steel."""
    m, l = np.exp(rng.uniform(0.0, log(3000.0))), rng.uniform(5.0, 29.0)
    ratio, radius = np.exp(rng.uniform(log(0.02), 0.0)), rng.uniform(3e-3, 12e-3)
    alpha = rng.uniform(14e-9, 26e-9)
    oil = Lubricant(viscosity=0.05, pressure_viscosity=alpha, flooded_layer=rng.choice(LAYERS))
    return m, from_groups(moes(m, l, ratio, oil=oil), radius=radius)


def moments(seed, number):
    """M, R_x/R_y and the moments of the atlas, by Kapitza, by Biboulet and Houpert and by the program, shape (n, 6)."""
    rng, rows = np.random.default_rng(seed), []
    while len(rows) < number:
        m, c = drawn(rng)
        try:
            films = atlas_films(c)
        except NotInAtlasError:
            continue
        if films.rolling_moment is None:
            continue
        scaled = scale_contact(c)
        axes, film = (scaled.semi_axis_x * scaled.semi_axis_ratio, scaled.semi_axis_x), films.central.value
        unit = moment_unit(c)
        own = (
            films.rolling_moment.value,
            kapitza_moment(c, film),
            heavy_moment(c, *axes),
            flooded_moment(c, *axes, film),
        )
        rows.append((m, c.radius_x / c.radius_y, *(moment / unit for moment in own)))
    return np.array(rows)


def errors(constants, rows):
    """Of the formula with s and t over R_x/R_y, linear; w stays, as more of it leaves a moment to no contact."""
    s, s_ratio, t, t_ratio = constants
    _, ratio, atlas, kapitza, heavy, _ = rows.T
    z = (s + s_ratio * ratio) * heavy - (t + t_ratio * ratio)
    return (kapitza + 0.5 * (z + np.hypot(z, WIDTH))) / atlas - 1.0


def main(seed, number):
    """Fit to half, judge by the others."""
    rows = moments(int(seed), int(number))
    start = (*SLOPE, *START)
    found = least_squares(errors, start, args=(rows[::2],), loss="soft_l1", f_scale=ROBUST).x
    print("fitted: s, t over R_x/R_y:", np.round(found, 3))
    others = rows[1::2]
    off = others[:, 5] / others[:, 2] - 1.0
    for low, high in LOADS:
        own = np.abs(off[(others[:, 0] >= low) & (others[:, 0] < high)])
        print(
            f"M {low:g} to {high:g}: {len(own)} contacts, 50, 90 %, largest [%]:",
            np.round(100 * np.quantile(own, (0.5, 0.9, 1)), 1),
        )


if __name__ == "__main__":
    main(*sys.argv[1:])
