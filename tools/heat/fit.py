"""Law of the thermal reduction factors from solved contacts: `python tools/heat/fit.py`, `solves.jsonl.gz` into
ehl/closed_form, with the errors of the contacts left out one by one.
"""

from __future__ import annotations

import numpy as np
from scipy.linalg import cho_factor, cho_solve
from scipy.optimize import minimize
from solves import SOLVES, label, lines

from oilfilm.ehl.arrays import radial
from oilfilm.ehl.closed_form.thermal_reduction import FILE

LOSSES = np.log(np.array([1.0, 3.0, 8.0, 18.0, 32.0, 50.0]) / 100.0)  # ln(1 - s) at which errors are given
WINDOW = 0.6  # of ln(1 - s) about them
LOADS = np.log([10.0, 40.0, 100.0, 300.0, 1000.0, 5000.0])  # ln M at which the share of the errors is given
LOAD_WINDOW = 0.7
QUANTILE = 0.95
STIFF = 0.02  # weight that keeps the scales about twice the spread of the contacts


def trend(x):
    """1 and x_j."""
    return np.column_stack([np.ones(len(x)), x])


def covariance(x, noise, parameters):
    """Of the values: Matern's of 5/2 and noise; parameters ln(scales/spread), ln(amplitude), ln(own noise)."""
    scales = x.std(axis=0) * np.exp(parameters[:-2])
    own = np.diag(noise**2 + np.exp(2.0 * parameters[-1]))
    return scales, np.exp(2.0 * parameters[-2]) * radial(x, x, scales) + own


def misfit(parameters, x, y, noise):
    """Minus the logarithm of the restricted likelihood, and the prior of the scales."""
    _, k = covariance(x, noise, parameters)
    factor = cho_factor(k, lower=True)
    terms = trend(x)
    inverse = cho_solve(factor, terms)
    square = terms.T @ inverse
    rest = y - terms @ np.linalg.solve(square, inverse.T @ y)
    fit = 0.5 * rest @ cho_solve(factor, rest)
    size = np.log(np.diag(factor[0])).sum() + 0.5 * np.linalg.slogdet(square)[1]
    return fit + size + STIFF * np.square(parameters[:-2] - np.log(2.0)).sum()


def fitted(x, y, noise):
    """Scales, trend, weights, and values of the contacts left out one by one."""
    first = np.r_[np.full(x.shape[1], np.log(4.0)), 0.0, np.log(0.04)]
    bounds = [(-1.0, 4.0)] * x.shape[1] + [(-5.0, 1.0), (-6.0, -1.0)]
    found = minimize(misfit, first, (x, y, noise), method="L-BFGS-B", bounds=bounds, options={"maxiter": 80})
    scales, k = covariance(x, noise, found.x)
    terms = trend(x)
    inverse = np.linalg.inv(k)
    projected = inverse @ terms
    square = np.linalg.inv(terms.T @ projected)
    coefficients = square @ projected.T @ y
    weights = inverse @ (y - terms @ coefficients)
    whole = inverse - projected @ square @ projected.T
    left_out = y - (whole @ y) / np.diag(whole)
    print("scales over spread", np.round(np.exp(found.x[:-2]), 1), "own noise", round(float(np.exp(found.x[-1])), 3))
    return scales, coefficients, np.exp(2.0 * found.x[-2]) * weights, left_out


def errors(x, scales, y, left_out):
    """Share of the errors over LOADS, errors of y over LOSSES, and the median distance to the nearest contact."""
    distance = np.sqrt((np.square((x[:, None] - x) / scales)).sum(axis=-1))
    np.fill_diagonal(distance, np.inf)
    nearest = distance.min(axis=1)
    spacing = float(np.median(nearest))
    relative = np.abs(left_out - y) / np.maximum(nearest / spacing, 1.0)
    near = np.abs(x[:, 3, None] - LOADS) < LOAD_WINDOW
    shares = np.array([np.sqrt(np.mean(np.square(relative[one]))) for one in near.T])
    shares /= np.sqrt(np.mean(np.square(relative)))
    relative /= np.interp(x[:, 3], LOADS, shares)
    found = []
    lost = -np.log1p(np.exp(-left_out))
    for loss in LOSSES:
        near = np.abs(lost - loss) < WINDOW
        found.append(np.quantile(relative[near], QUANTILE))
    return shares, np.array(found), spacing


def table(name, s, other, loading):
    """One line: error of the film, of contacts below L_T 3 and of all."""
    error = 100.0 * np.abs(other / s - 1.0)
    parts = [f"| {name} |"]
    for some in (loading < 3.0, loading < np.inf):
        e = error[some]
        two = 100.0 * np.mean(e < 2.0)
        parts.append(
            f" {len(e)} | {np.sqrt(np.mean(e**2)):.2f} | {np.quantile(e, 0.95):.2f} | {e.max():.2f} | {two:.0f} |"
        )
    print("".join(parts))


def main():
    """Fit and write."""
    labels = [found for one in lines(SOLVES) if (found := label(one)) is not None]
    x = np.array([one.groups for one in labels])
    data = {name: [] for name in ("scales", "trends", "weights", "shares", "errors", "spacings")}
    print(len(labels), "contacts; film: number, rms, 95 %, largest error in %, share within 2 %; L_T below 3, then all")
    for film, name in enumerate(("central", "minimum", "moment")):
        s = np.array([one.reductions[film] for one in labels])
        noise = np.array([one.noise[film] for one in labels]) / (1.0 - s)
        y = np.log((1.0 - s) / s)
        scales, coefficients, weights, left_out = fitted(x, y, noise)
        share, error, spacing = errors(x, scales, y, left_out)
        for key, value in zip(data, (scales, coefficients, weights, share, error, spacing), strict=True):
            data[key].append(value)
        table(name, s, 1.0 / (1.0 + np.exp(left_out)), np.exp(x[:, 0]))
        print("errors of y", np.round(error, 3), "by load", np.round(share, 2), "spacing", round(spacing, 3))
    small = {key: np.array(value) for key, value in data.items()}
    small["centres"] = x.astype(np.float32)
    np.savez_compressed(FILE, **small, lower=x.min(axis=0), upper=x.max(axis=0), losses=LOSSES, loads=LOADS)
    print(FILE.stat().st_size, "bytes")


if __name__ == "__main__":
    main()
