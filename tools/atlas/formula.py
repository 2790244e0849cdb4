"""Film formula of fifty coefficients for each film, from the film atlas: `python tools/atlas/formula.py`.

Terms are chosen for both films together, one after the other and by exchange, each the one that leaves the least
error over the range; written with five decimals into ehl/closed_form.
"""

from __future__ import annotations

import numpy as np
from scipy.stats import qmc

from oilfilm.ehl.atlas.film_formula import FILE, RANGE, TERMS, monomials
from oilfilm.ehl.atlas.table import BASE_ALPHA, BASE_Z, functions

POINTS = 12  # power of two of the places the atlas is asked at
DEGREE = 7  # of the terms in x, y and w together
BASE, OIL = 45, 5  # terms without and with the oil's z and alpha
WEIGHTS = (1.0, 0.4)  # of the errors of central and minimum film
GAIN = 1e-3  # of the squared error, below which no term is exchanged
DEPENDENT = 1e-9  # squared length over that of the column, below which it says nothing new


def powers(oil):
    """Exponents of x, y, w, z and a that a term may have."""
    if oil:
        firsts = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
        return [(*first, z, a) for z, a in ((1, 0), (0, 1), (1, 1), (0, 2), (2, 0)) for first in firsts]
    degrees = range(DEGREE + 1)
    return [(i, j, k, 0, 0) for i in degrees for j in degrees for k in degrees if i + j + k <= DEGREE]


def gains(columns, values, chosen):
    """Squared error of each film that every further column would take away, weighed, and what is left."""
    basis, _ = np.linalg.qr(columns[:, chosen])
    rest = values - basis @ (basis.T @ values)
    free = columns - basis @ (basis.T @ columns)
    length = (free**2).sum(0)
    length[length < DEPENDENT * (columns**2).sum(0)] = np.inf
    return (((free.T @ rest) ** 2 / length[:, None]) * np.square(WEIGHTS)).sum(1), (rest**2 @ np.square(WEIGHTS)).sum()


def selected(columns, values, count):
    """Columns that leave the least error of the films together."""
    chosen: list[int] = []
    while len(chosen) < count:
        chosen.append(int(gains(columns, values, chosen)[0].argmax()))
    exchanged = True
    while exchanged:
        exchanged = False
        for place in range(count):
            rest = [*chosen[:place], *chosen[place + 1 :]]
            gain, left = gains(columns, values, rest)
            best = int(gain.argmax())
            if left - gain[best] < (1.0 - GAIN) * (left - gain[chosen[place]]):
                chosen, exchanged = [*rest, best], True
    return sorted(chosen)


def main():
    """Choose, fit, write."""
    share = qmc.Sobol(5, seed=0).random_base2(POINTS)
    low, high = (np.array(ends) for ends in zip(*RANGE.values(), strict=True))
    load = low[0] * (high[0] / low[0]) ** share[:, 0]
    root = np.sqrt(high[1]) * share[:, 1]
    ratio = low[2] * (high[2] / low[2]) ** share[:, 2]
    alpha, z = (low[k] + (high[k] - low[k]) * share[:, k] for k in (3, 4))
    x = np.column_stack([np.log(load), root, np.log(ratio)])
    of_base = functions(x, np.full(len(x), BASE_ALPHA), np.full(len(x), BASE_Z))[:, :2]
    of_oil = functions(x, alpha, z)[:, :2] - of_base
    rows = []
    for count, oil, values in ((BASE, False, of_base), (OIL, True, of_oil)):
        known = np.array(powers(oil))
        columns = monomials((load, root**2, ratio, alpha, z), known)
        chosen = selected(columns, values, count)
        found, *_ = np.linalg.lstsq(columns[:, chosen], values, rcond=None)
        for exponents, pair in zip(known[chosen], found, strict=True):
            rows.append(",".join([*map(str, exponents), *(f"{c:.5f}" for c in pair)]))
        error = 100.0 * np.abs(columns[:, chosen] @ found - values)
        print(
            f"{count} terms, largest / 95 % / rms [%]: ",
            *(f"{e.max():.2f} / {np.quantile(e, 0.95):.2f} / {np.sqrt((e**2).mean()):.2f}" for e in error.T),
        )
    FILE.write_text("\n".join([",".join((*TERMS, "central", "minimum")), *rows]) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
