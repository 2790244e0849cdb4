"""Entrainment at an angle in the film atlas: `python tools/atlas/skewed.py`, from `build/atlas_solves.jsonl`.

After `fit.py`, whose table gives the films of the straight contacts. What the file of solves holds replaces its labels
in `skewed.csv.gz`, from which all else is; prints the errors, over the ratio of curvatures T/S.
"""

from __future__ import annotations

import gzip
import json
from itertools import pairwise

import numpy as np
from fit import SOLVES, bar, in_order, limit, robust_weights, table
from solves import SKEWED

from oilfilm.ehl.arrays import radial
from oilfilm.ehl.atlas.films import (
    ACROSS_CLASSES,
    FILE,
    MIXED,
    Skew,
    along_entrainment,
    mixed_functions,
    mixed_oil_terms,
)
from oilfilm.ehl.atlas.table import functions

COLUMNS = "kind number A L D angle alpha z central minimum approach".split()
SCALES = (8.0, 6.0, 8.0, 1.0)  # of ln A, sqrt L, ln T/S, m: by the errors of contacts left out of the fit
DEVIATION = (1.0, 1.0, 0.1)  # prior deviations of what the mixed curvature adds, over m
NOISE = (2e-3, 4e-3, 5e-4)  # and of the labels
RIDGE = 1e-3
CLASSES = (0.0, *ACROSS_CLASSES, 10.0)  # of T/S
FITTED = ("skew", "skew across")
JUDGES = ("held skew", "held skew oil")


def label(entry):
    """One line of the labels: place, oil, ln(Hc A), ln(Hm A), H0; None where not resolved."""
    a, b = entry["meshes"][-2:]
    if not (b["converged"] and b["resolved"]) or b["films"][1][0] <= 0.0:
        return None
    films = [np.log(limit(a["films"][k][2], b["films"][k][2], 2.0) * entry["A"]) for k in (0, 1)]
    place = (entry["A"], entry["L"], entry["D"], entry["angle"])
    return [entry["kind"], entry["number"], *place, entry["alpha"] * 1e9, entry["z"], *films, b["approach"]]


def labels():
    """Kinds, and the numbers of the other columns."""
    lines = gzip.decompress(SKEWED.read_bytes()).decode().splitlines()[1:] if SKEWED.exists() else []
    known = {tuple(line.split(",")[:2]): line for line in lines}
    if SOLVES.exists():
        for entry in map(json.loads, SOLVES.read_text().splitlines()):
            if entry.get("angle") is None:
                continue
            row = label(entry)
            known.pop(place := (entry["kind"], str(entry["number"])), None)
            if row is not None:
                known[place] = ",".join(c if isinstance(c, str) else f"{c:.7g}" for c in row)
        text = "\n".join([",".join(COLUMNS), *(known[place] for place in sorted(known, key=in_order))])
        SKEWED.write_bytes(gzip.compress(text.encode(), mtime=0))
    cells = [known[place].split(",") for place in sorted(known, key=in_order)]
    return np.array([c[0] for c in cells]), np.array([[float(v) for v in c[2:]] for c in cells])


def placed(rows):
    """Places (ln A, sqrt L, ln T/S, m) of the straight contacts, and what is added to their functions."""
    contacts = [along_entrainment(*row[:4]) for row in rows]
    x = np.array([contact.place for contact in contacts])
    straight = functions(x[:, :3], rows[:, 4] * 1e-9, rows[:, 5])[:, :MIXED]
    unit, approach = np.array([(contact.unit, contact.approach) for contact in contacts]).T
    # films in a^2/Rx of the straight contact, times its A
    films = rows[:, 6:8] + x[:, :1] - np.log(rows[:, :1] * unit[:, None])
    deflection = (np.exp(rows[:, 6]) / rows[:, 0] - rows[:, 8]) / unit - approach
    return x, np.column_stack([films, deflection]) - straight


def skew_table(x, y, own, oil, oils):
    """What is added, of the base oil's contacts `own` and those of other oils."""
    places = x[own].astype(np.float32).astype(float)
    mixed = places[:, 3:] * places[None, :, 3]
    shape = mixed * radial(places, places, np.array(SCALES))
    weights = np.empty((len(places), MIXED))
    for k in range(MIXED):
        variance = DEVIATION[k] ** 2
        weights[:, k] = variance * robust_weights(y[own, k], variance * shape, NOISE[k])
    base = Skew(places, np.array(SCALES), weights, np.zeros((8, MIXED)), np.zeros((2, MIXED, MIXED)))
    terms = mixed_oil_terms(x[oil], *oils)
    left = y[oil] - mixed_functions(x[oil], *oils, base)
    return base._replace(oils=np.linalg.solve(terms.T @ terms + RIDGE * np.eye(terms.shape[1]), terms.T @ left))


def main():
    """Fit, judge, write."""
    kinds, rows = labels()
    x, y = placed(rows)
    alpha, z = rows[:, 4] * 1e-9, rows[:, 5]
    oil = kinds == "skew oil"
    known = skew_table(x, y, np.isin(kinds, FITTED), oil, (alpha[oil], z[oil]))
    error = mixed_functions(x, alpha, z, known) - y
    print("max/95 %/rms [%]: central, minimum, deflection (of a^2/Rx of the straight contact)")
    ratio, bars = np.exp(x[:, 2]), {}
    for kind in sorted(set(kinds)):
        table(kind, error[kinds == kind])
        bars[kind] = []
        for low, high in pairwise(CLASSES):
            own = error[(kinds == kind) & (ratio >= low) & (ratio < high)]
            if len(own):
                table(f"  T/S<{high:g}", own)
                bars[kind].append(bar(own))
    base, others = (np.array(bars[kind]) for kind in JUDGES)
    # other oils have few contacts in each class
    np.savez_compressed(FILE, **known._replace(bars=np.stack([base, np.maximum(base, others)]))._asdict())


if __name__ == "__main__":
    main()
