"""Film atlas from its solves: `python tools/atlas/fit.py`, from `build/atlas_solves.jsonl` into ehl/traction/atlas.

What that file holds replaces its labels in `labels.csv.gz`, from which all else is.
"""

from __future__ import annotations

import gzip
import json

import numpy as np
from solves import LABELS, SOLVES

from oilfilm.ehl.arrays import radial, trend_terms
from oilfilm.ehl.atlas.films import BEARING_L, RANGE
from oilfilm.ehl.atlas.table import (
    FILE,
    Patch,
    Table,
    functions,
    oil_features,
    patch_base,
    slanted,
    slanted_radial,
    with_linear_terms,
)
from oilfilm.ehl.atlas.table import STEP as STEP_REACH
from oilfilm.ehl.closed_form.hertz import hertz_coefficients

COLUMNS = "kind number A L D alpha z central minimum approach t8 t25 t400 scale8 scale25 scale400".split()
FITTED = (
    "heavy",
    "start",
    "along",
    "light",
    "step",
    "step along",
    "light along",
    "rigid",
    "far",
    "thick",
    "light thick",
)
OILS = (
    *("oil", "light oil", "rigid oil", "wide oil", "light wide oil", "rigid wide oil"),
    *("far oil", "thick oil", "along oil", "light along oil"),
)
LOADS = {"light": (0.3, 12.0), "heavy": (6.2, 720.0)}  # A that each patch is fitted to
# of the slanted x, of radial functions and, of light contacts, of those around the step: by the marginal likelihood
# of the labels, the step's width by what held-out contacts and second differences along A say as well
SCALES = {"light": (1.42, 7.4, 7.3), "heavy": (2.5, 4.0, 6.0)}
SLANT = {"light": (0.216, 0.046, 0.128, -0.0034), "heavy": (0.0, 0.0, 0.0, 0.0)}
STEP = {"light": (1.756, 0.15, 0.1, 0.2, 4.0, 3.4), "heavy": (0.0, 1.0, 0.0, 1.0, 1.0, 1.0)}
OIL_SCALES = {"light": (1.2, 3.0, 4.0), "heavy": (2.5, 4.0, 6.0)}  # likewise
OIL_DEVIATION, OIL_NOISE = 0.025, {"light": 3e-3, "heavy": 2e-3}
# that judge, by patch: the base oil with Rx/Ry up to 1 and above, other oils
JUDGES = (
    (
        *(("held light", "held rigid"), ("held light along", "held rigid")),
        *(("held light oil", "held rigid oil"), ("held light along oil", "held rigid oil")),
    ),
    (("held",), ("held along",), ("held oil",), ("held along oil",)),
)
# beyond L 30, light and heavy, beyond A 160 and beyond 400
BEYOND_JUDGES = ("held light thick", "held thick", "held far", "held farthest")
# beyond A 650, where none is solved: what a fit without A above the first is off by up to the largest solved, twice it
EXTRAPOLATED = 350.0
# at the step, with Rx/Ry up to 1 and above: the base oil, others
STEP_JUDGES = (("held step", "held step oil"), ("held step along", "held step along oil"))
DEVIATION, TREND = 0.3, 5.0  # prior deviations of the functions
NOISE = {"light": 2e-4, "heavy": 1e-3}  # and of the labels
MEDIAN = 0.67  # of the size of a normal deviate
LABELLED, SOFT = 175.0, 2.0  # beyond this A and below this L contacts do not settle on 1025 points: no label
STEEP = 0.25  # step from mesh to mesh beyond which none is extrapolated
OIL_RIDGE = 1e-4


def limit(coarse, fine, order):
    """Of two meshes of which one is twice as fine."""
    if abs(fine / coarse - 1.0) > STEEP:
        return fine
    return fine + (fine - coarse) / (2.0**order - 1.0)


def label(entry):
    """One line of the labels: place, oil, ln(Hc A), ln(Hm A), H0, T/C - ln s, T/C; None where not resolved."""
    a, b = entry["meshes"][-2:]
    soft = entry["A"] > LABELLED and entry["L"] < SOFT
    if soft or not (b["converged"] and b["resolved"]) or b["films"][1][0] <= 0.0:
        return None
    A, D = entry["A"], entry["D"]
    f, g, _ = hertz_coefficients(D)
    scale = np.pi * 6.0 / (f**3 * g) * entry["M"] ** (-4.0 / 3.0) / ((3.0 + 2.0 * D) * np.sqrt(D))
    films = [np.log(limit(a["films"][k][2], b["films"][k][2], 2.0) * A) for k in (0, 1)]
    pairs = zip(a["moments"], b["moments"], strict=True)
    same = a["attempt"] == b["attempt"]  # or the mesh across may be another
    whole = [(limit(x, y, 2.0) if same else y) / scale for x, y in pairs]
    rest = [t - np.log(s) for t, s in zip(whole, entry["layers"], strict=True)]
    oil = (entry["alpha"] * 1e9, entry["z"])
    return [entry["kind"], entry["number"], A, entry["L"], D, *oil, *films, b["approach"], *rest, *whole]


def labels():
    """Kinds, and the numbers of the other columns."""
    lines = gzip.decompress(LABELS.read_bytes()).decode().splitlines()[1:]
    known = {tuple(line.split(",")[:2]): line for line in lines}
    if SOLVES.exists():
        for entry in map(json.loads, SOLVES.read_text().splitlines()):
            if entry.get("angle") is not None:  # `skewed.py` has these
                continue
            row = label(entry)
            known.pop(place := (entry["kind"], str(entry["number"])), None)
            if row is not None:
                known[place] = ",".join(c if isinstance(c, str) else f"{c:.7g}" for c in row)
        text = "\n".join([",".join(COLUMNS), *(known[place] for place in sorted(known, key=in_order))])
        LABELS.write_bytes(gzip.compress(text.encode(), mtime=0))
    cells = [known[place].split(",") for place in sorted(known, key=in_order)]
    return np.array([c[0] for c in cells]), np.array([[float(v) for v in c[2:]] for c in cells])


def in_order(place):
    """Of a part, by number."""
    return place[0], int(place[1])


def targets(rows):
    """The six functions of the table, of the labels."""
    found = rows[:, 5:11].copy()
    found[:, 2] = np.exp(rows[:, 5]) / rows[:, 0] - rows[:, 7]
    return found


def places(rows):
    """ln A, sqrt L, ln D."""
    return np.column_stack([np.log(rows[:, 0]), np.sqrt(rows[:, 1]), np.log(rows[:, 2])])


def robust_fit(y, prior, noise, basis):
    """Weights of the columns of a prior covariance and of a trend, basis (n, k), outliers weighed down by what the
    other contacts say of them: those that are off by more than three deviations of what these leave open.

    The trend, of the prior deviation `TREND`, is taken out first (generalised least squares): in one covariance with
    the radial functions its eigenvalues, 1e15 of the smallest, would leave films with three digits.
    """
    doubt = np.ones(len(y))
    for _ in range(3):
        inverse = np.linalg.inv(prior + np.diag(noise**2 * doubt))
        carried = inverse @ basis
        normal = np.linalg.solve(np.eye(basis.shape[1]) / TREND**2 + basis.T @ carried, carried.T)
        trend = normal @ y
        weights = inverse @ (y - basis @ trend)
        left = np.abs(weights) / np.sqrt(np.diag(inverse) - np.einsum("ij,ji->i", carried, normal))
        doubt = np.maximum(1.0, (left / (3.0 * max(1.0, np.median(left) / MEDIAN))) ** 2)
    return weights, trend


def robust_weights(y, prior, noise):
    """As `robust_fit` without a trend."""
    return robust_fit(y, prior, noise, np.empty((len(y), 0)))[0]


def fitted(x, y, shape, noise):
    """Weights of trend and radial functions at slanted places x; `shape`: the latter's covariance over their
    variance, noise: deviation of the labels."""
    weights, trend = robust_fit(y, DEVIATION**2 * shape, noise, trend_terms(x))
    return trend, DEVIATION**2 * weights


def relative(error, rows):
    """Errors over the values: logarithms of films and Hc - H0 as they are, of moments over T/C."""
    found = error.copy()
    found[:, 3:] /= rows[:, 11:14]
    return found


def table(text, error):
    """Print largest, 95 % and root mean square error [%]."""
    share = 100.0 * np.abs(error)
    triples = zip(share.max(0), np.quantile(share, 0.95, axis=0), np.sqrt((share**2).mean(0)), strict=True)
    print(f"{text:11s} {len(error):4d}", *(f"{a:.2f}/{b:.2f}/{c:.2f}" for a, b, c in triples))


def patch(name, kinds, rows):
    """Functions over a part of the range."""
    low, high = LOADS[name]
    there = (rows[:, 0] > low) & (rows[:, 0] < high)
    x, y, scales = places(rows), targets(rows), np.array(SCALES[name])
    own = np.isin(kinds, FITTED) & there
    slant, step = np.array(SLANT[name]), np.array(STEP[name])
    solved = slanted(x[own], slant).astype(np.float32).astype(float)
    shape = slanted_radial(solved, solved, scales, step)
    mean = y[own].mean(0)
    pairs = [fitted(solved, y[own, k] - mean[k], shape, NOISE[name]) for k in range(y.shape[1])]
    trend, weights = np.array([p[0] for p in pairs]).T, np.array([p[1] for p in pairs]).T
    oil = np.isin(kinds, OILS) & there
    none = np.zeros((0, 3)), np.zeros((0, 5)), np.ones(3), np.zeros((20, y.shape[1])), np.zeros((0, y.shape[1]))
    base = Patch(slant, solved, scales, step, mean, trend, weights, *none)
    return with_oils(base, name, x[oil], (rows[oil, 3] * 1e-9, rows[oil, 4]), y[oil])


def with_oils(base, name, x, oils, y):
    """A patch with what other oils add, of their alpha [1/Pa] and z."""
    features = oil_features(x, *oils)
    left = y - patch_base(base, x)
    terms = with_linear_terms(features, x)
    normal = terms.T @ terms + OIL_RIDGE * np.eye(terms.shape[1])
    trend = np.linalg.solve(normal, terms.T @ left)
    scales = np.array(OIL_SCALES[name])
    prior = OIL_DEVIATION**2 * (features @ features.T) * radial(x, x, scales)
    left = left - terms @ trend
    weights = [OIL_DEVIATION**2 * robust_weights(part, prior, OIL_NOISE[name]) for part in left.T]
    return base._replace(
        oil_places=x, oil_features=features, oil_scales=scales, oil_trend=trend, oil_weights=np.array(weights).T
    )


def bar(error):
    """Errors within which one more contact, drawn as these were, lies in at least nineteen of twenty draws, whatever
    their distribution: the ceil(0.95 (n + 1))-th smallest of n (split conformal prediction, Vovk et al., 2005); of
    less than nineteen the largest, which holds n/(n + 1)."""
    place = min(int(np.ceil(0.95 * (len(error) + 1))), len(error))
    return np.sort(np.abs(error), axis=0)[place - 1]


def _bar(parts):
    """The largest bars of several parts."""
    return np.max([bar(error) for error in parts], axis=0)


def main():
    """Fit, judge, write."""
    kinds, rows = labels()
    light, heavy = (patch(name, kinds, rows) for name in ("light", "heavy"))
    x, y = places(rows), targets(rows)
    known = Table(
        light,
        heavy,
        np.zeros((len(JUDGES), len(JUDGES[0]), y.shape[1])),
        np.zeros((2, 2, y.shape[1])),
        np.zeros((len(BEYOND_JUDGES) + 1, y.shape[1])),
    )
    error = relative(functions(x, rows[:, 3] * 1e-9, rows[:, 4], known) - y, rows)
    print("max/95 %/rms [%]: central, minimum, deflection (of a^2/Rx), moment within thin, thick, very thick layer")
    for kind in sorted(set(kinds)):
        table(kind, error[kinds == kind])
    # at the step of their film light contacts are judged apart, and soft ones beyond A 160 are refused
    kinds = kinds.copy()
    away = np.abs(slanted(x, light.slant)[:, 0] - light.step[0])
    kinds[(kinds == "held light along oil") & (away < STEP_REACH)] = "held step along oil"
    kinds[(rows[:, 0] > RANGE["A = a^2/(Rx^2 sqrt(2U))"][1]) & (rows[:, 1] < BEARING_L[0])] = "soft"
    bars = [[_bar([error[kinds == kind] for kind in part]) for part in patch_parts] for patch_parts in JUDGES]
    stored = {
        f"{name}_{key}": v for name, own in (("light", light), ("heavy", heavy)) for key, v in own._asdict().items()
    }
    step_bars = [[bar(error[kinds == kind]) for kind in pair] for pair in STEP_JUDGES]
    beyond_bars = [bar(error[kinds == kind]) for kind in BEYOND_JUDGES]
    near = rows[:, 0] < EXTRAPOLATED
    less = known._replace(heavy=patch("heavy", kinds[near], rows[near]))
    beyond = relative(functions(x[~near], rows[~near, 3] * 1e-9, rows[~near, 4], less) - y[~near], rows[~near])
    table("extrapolated", beyond)
    beyond_bars.append(np.maximum(bar(beyond), beyond_bars[-1]))
    judged = {"bars": bars, "step_bars": step_bars, "beyond_bars": beyond_bars}
    np.savez_compressed(FILE, **{name: np.array(own) for name, own in judged.items()}, **stored)


if __name__ == "__main__":
    main()
