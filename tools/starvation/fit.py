"""Starvation law from its solves: `python tools/starvation/fit.py films` or `damping`, from `solves.jsonl` or
`damping.jsonl` into ehl/closed_form.
"""

from __future__ import annotations

import json
import sys

import numpy as np
from damping import DAMPING
from numpy.linalg import LinAlgError
from scipy.linalg import cho_factor, cho_solve
from scipy.optimize import minimize
from solves import LARGEST_EXPONENT, SOLVES

from oilfilm.ehl.arrays import radial, trend_terms
from oilfilm.ehl.closed_form.starvation import DAMPING_FILE, FILE, contact_coordinates

MOMENT = 0.44  # of the step of T/T_0 by its lever from the coarser mesh that is added: order 1.7
LIGHT = 1.0  # Hc from which solves that want more points count, too
EXCESS = 0.003  # of R above 1 from which a solve is left out: its box is not that of the flooded film
ALONE = 0.02  # step where the coarser mesh did not converge
FLOORS = (4e-4, 1.5e-3, 6e-3)  # noise of ln R, ln R_min, T/T_0
BAR_SHARE, LARGEST_BAR = 0.2, 0.05  # of the error bars of the films that counts as noise, and the most
STEP_SHARE = 0.25  # of the step between the meshes that counts as noise
# of damping: noise, and the share of the step from the coarser mesh that counts as such and that is added
DAMPING_FLOOR, DAMPING_STEP_SHARE, DAMPING_STEP = 4e-3, 0.3, 1.0 / 3.0
THICK_DAMPING = 4.0  # Hc from which damping is not fitted: it grows as films thin, by several times


def rows(path):
    """Kind, contact, x, (ln R, ln R_min, T/T_0), noise of each."""
    found = []
    for text in path.read_text().splitlines():
        e = json.loads(text)
        fine, coarse = e["fine"], e["coarse"]
        if not (fine["starved"] and coarse["starved"]):
            print("flooded did not converge:", e["kind"], e["number"], e["M"], e["L"], e["ratio"])
            continue
        for r, one, other in zip(e["layers"], fine["starved"], coarse["starved"], strict=True):
            if one["films"][0][0] > (1.0 + EXCESS) * fine["flooded"]["films"][0][0]:
                continue
            light = fine["flooded"]["films"][0][0] > LIGHT  # all of them want more points
            if not (one["converged"] and (light or (one["resolved"] and fine["flooded"]["resolved"]))):
                continue
            a = shares(one, fine["flooded"])
            b = shares(other, coarse["flooded"]) if other["converged"] else [(1.0 + ALONE) * own for own in a]
            step = np.array([np.log(a[0] / b[0]), np.log(abs(a[1] / b[1])), a[2] - b[2]])
            lever = 0.0 if "moment by heat" in one else MOMENT
            y = np.array([np.log(a[0]), np.log(a[1]), a[2] + lever * step[2] * other["converged"]])
            bars = [f[1] / f[0] for f in (*one["films"], *fine["flooded"]["films"])]
            bars = BAR_SHARE * np.array([np.hypot(bars[0], bars[2]), np.hypot(bars[1], bars[3]), 0.0])
            noise = np.sqrt(np.square(FLOORS) + np.square(STEP_SHARE * step) + np.minimum(bars, LARGEST_BAR) ** 2)
            x = np.array([*contact_coordinates(e["M"], e["L"], e["ratio"]), np.log(r)])
            found.append((e["kind"], e["number"], x, y, noise))
    kinds, numbers, x, y, noise = zip(*found, strict=True)
    return np.array(kinds), np.array(numbers), np.array(x), np.array(y), np.array(noise)


def damping_rows(path):
    """Kind, contact, x, share of damping at the higher frequency, noise of each; and of contacts too thick to fit."""
    found, thick = [], []
    for text in path.read_text().splitlines():
        e = json.loads(text)
        fine, coarse = e["fine"], e["coarse"]
        if fine["flooded"] is None or coarse["flooded"] is None:
            continue
        place = contact_coordinates(e["M"], e["L"], e["ratio"])
        for r, one, other in zip(e["layers"], fine["starved"], coarse["starved"], strict=True):
            if one is None or other is None:
                continue
            share, before = one[1] / fine["flooded"][1], other[1] / coarse["flooded"][1]
            noise = np.hypot(DAMPING_FLOOR, DAMPING_STEP_SHARE * (share - before))
            row = (
                e["kind"],
                e["number"],
                np.array([*place, np.log(r)]),
                share + DAMPING_STEP * (share - before),
                noise,
            )
            (thick if place[0] > np.log(THICK_DAMPING) else found).append(row)
    return [[np.array(column) for column in zip(*rows, strict=True)] for rows in (found, thick)]


def shares(one, flooded):
    """R, R_min, T/T_0."""
    films = [s[0] / f[0] for s, f in zip(one["films"], flooded["films"], strict=True)]
    name = "moment by heat" if "moment by heat" in one else "moment"
    return [*films, one[name] / flooded[name]]


def log_share(f, log_r):
    """ln R of f = ln g and its derivative."""
    g = np.exp(f)
    low = np.minimum(log_r, 0.0)
    t = g * np.abs(log_r)
    deficit = np.log1p(np.exp(-t)) / g
    slope = deficit + np.abs(log_r) / (1.0 + np.exp(t))
    return low - deficit, slope


def models(k, x, y):
    """Function of f giving the observed quantity and its derivative."""
    log_r = x[:, 3]
    if k == 0:
        return lambda f: log_share(f, log_r)
    if k == 1:
        missing = -np.expm1(y[:, 0])
        return lambda f: (y[:, 0] + missing * f, missing)
    if k == 3:
        return lambda f: (f, np.ones_like(f))

    def sigmoid(f):
        s = 1.0 / (1.0 + np.exp(-f))
        return s, s * (1.0 - s)

    return sigmoid


class Fit:
    """Laplace approximation of a Gaussian process with trend, by linearised observations."""

    def __init__(self, x, observed, noise, model, start):
        self.x, self.observed, self.noise, self.model = x, observed, noise, model
        self.f = np.full(len(x), start)
        self.basis = trend_terms(x)
        self.doubt = np.ones(len(x))  # factor on the variance of outliers

    def linearised(self):
        """Targets and variances of f."""
        value, slope = self.model(self.f)
        slope = np.where(np.abs(slope) < 1e-7, 1e-7, slope)
        step = np.clip((self.observed - value) / slope, -1.0, 1.0)
        return self.f + step, self.doubt * (self.noise / slope) ** 2

    def matrix(self, p, variance):
        """Covariance of the targets; p: ln scales, ln amplitude, ln factor of noise."""
        K = np.exp(2.0 * p[4]) * radial(self.x, self.x, np.exp(p[:4]))
        K += TREND**2 * self.basis @ self.basis.T
        return K, K + np.diag(np.exp(2.0 * p[5]) * variance)

    def settle(self, p, count=12):
        """f at rest for given parameters."""
        for _ in range(count):
            z, variance = self.linearised()
            K, C = self.matrix(p, variance)
            new = K @ cho_solve(cho_factor(C), z)
            change = np.abs(new - self.f).max()
            self.f = new
            if change < 1e-3:
                break

    def cost(self, p, z, variance):
        """Negative logarithm of the evidence, with a weak prior on the parameters."""
        try:
            factor = cho_factor(self.matrix(p, variance)[1], lower=True)
        except LinAlgError:
            return 1e10
        logdet = 2.0 * np.log(np.diag(factor[0])).sum()
        return 0.5 * (z @ cho_solve(factor, z) + logdet) + 0.5 * np.sum(((p - PRIOR) / WIDTH) ** 2)

    def optimise(self, p, numbers, rounds, steps):
        """Parameters and f in turn."""
        for _ in range(rounds):
            self.settle(p)
            self.weigh(p, numbers)
            z, variance = self.linearised()
            p = minimize(self.cost, p, (z, variance), "L-BFGS-B", options={"maxiter": steps}).x
        self.settle(p)
        return p

    def weigh(self, p, numbers):
        """Doubt of each observation by Student's distribution about what the other contacts say."""
        error = self.model(self.left_out(p, numbers))[0] - self.observed
        scale = 1.5 * np.median(np.abs(error) / self.noise)
        self.doubt = (FREEDOM + (error / (scale * self.noise)) ** 2) / (FREEDOM + 1.0)

    def weights(self, p):
        """Trend and radial weights."""
        z, variance = self.linearised()
        alpha = cho_solve(cho_factor(self.matrix(p, variance)[1]), z)
        return TREND**2 * self.basis.T @ alpha, np.exp(2.0 * p[4]) * alpha

    def left_out(self, p, numbers):
        """f of each contact predicted from the others."""
        z, variance = self.linearised()
        inverse = np.linalg.inv(self.matrix(p, variance)[1])
        alpha = inverse @ z
        out = np.empty_like(z)
        for number in np.unique(numbers):
            at = np.flatnonzero(numbers == number)
            out[at] = z[at] - np.linalg.solve(inverse[np.ix_(at, at)], alpha[at])
        return out


ROUNDS, STEPS = 3, 20  # of parameters and functions in turn, of the search for parameters
LARGEST_RATIO = 40.0  # r beyond which g and what the moment lacks times r stay
ERROR_RATIOS = (0.06, 0.2, 0.4, 0.6, 0.8, 1.0, 1.3, 1.8, 2.5, 4.0, 10.0, 40.0)
ERROR_FILMS = (0.02, 0.08, 0.3, 1.0, 3.0, 50.0)  # Hc of the same
WINDOW = (0.6, 0.25)  # of ln Hc and ln r over which errors are gathered
FREEDOM = 4.0  # of Student's distribution of the errors
TREND = 5.0  # prior deviation of the trend's coefficients
PRIOR = np.array([1.5, 1.0, 1.0, 0.7, -1.0, 0.0])
WIDTH = np.array([1.0, 1.0, 1.0, 0.7, 1.5, 0.7])
STARTS = (1.3, 0.2, 0.0)


def predicted(scales, trend, weights, x, places):
    """f at places."""
    return trend_terms(x) @ trend + radial(x, places, scales) @ weights


def quantiles(text, error, x):
    """Print errors by r."""
    edges = np.log([0.0501, 0.3, 0.6, 1.0, 1.7, 3.0, 10.0, 200.0])
    cells = [f"{np.sqrt(np.mean(error**2)):.2e}", *(f"{np.quantile(np.abs(error), q):.1e}" for q in (0.5, 0.95, 1.0))]
    for a, b in zip(edges[:-1], edges[1:], strict=True):
        part = np.abs(error[(x[:, 3] >= a) & (x[:, 3] < b)])
        cells.append(f"{np.median(part):.1e}/{np.quantile(part, 0.95):.1e}" if len(part) else "-")
    print(f"{text:12s}", *cells)


def quantile_map(error, x):
    """95 % quantile of errors around places in ln Hc and ln r."""
    found = np.empty((len(ERROR_FILMS), len(ERROR_RATIOS)))
    order = np.argsort(np.abs(error))
    for i, film in enumerate(np.log(ERROR_FILMS)):
        for j, ratio in enumerate(np.log(ERROR_RATIOS)):
            near = ((x[:, 0] - film) / WINDOW[0]) ** 2 + ((x[:, 3] - ratio) / WINDOW[1]) ** 2
            near = np.exp(-0.5 * np.minimum(near, 60.0))
            total = np.cumsum(near[order]) / near.sum()
            found[i, j] = np.abs(error)[order][min(np.searchsorted(total, 0.95), len(order) - 1)]
    return found


def fitted(k, x, y, noise, numbers, start):
    """Function k as scales, trend and weights, and its errors at contacts left out."""
    model = models(k, x, y)
    observed = y[:, k] if y.ndim > 1 else y
    one = Fit(x, observed, noise, model, start)
    p = one.optimise(PRIOR.copy(), numbers, ROUNDS, STEPS)
    print("scales, amplitude, noise", np.exp(p).round(3))
    trend, weight = one.weights(p)
    return (np.exp(p[:4]), trend, weight), model(one.left_out(p, numbers))[0] - observed


def report(k, left, judged, x_fit, x_held):
    """Print both kinds of errors; their quantiles around places."""
    for text, error, x in ((f"left out {k}", left, x_fit), (f"held {k}", judged, x_held)):
        quantiles(text, error, x)
        worst = np.argsort(-np.abs(error))[:4]
        print("   worst", [(np.exp(x[i]).round(3).tolist(), round(float(error[i]), 4)) for i in worst])
    found = quantile_map(np.concatenate([left, judged]), np.concatenate([x_fit, x_held]))
    print(np.round(found, 4))
    return found


def main():
    """Fit, judge, write."""
    {"films": films, "damping": damping}[sys.argv[1]]()


def films():
    """Films and rolling moment."""
    kinds, numbers, x, y, noise = rows(SOLVES)
    fit, held = kinds == "fit", kinds == "held"
    counts = [(len(np.unique(numbers[part])), part.sum()) for part in (fit, held)]
    print("contacts and layers to fit, to judge:", *counts)
    functions, errors = [], []
    for k in range(3):
        function, left = fitted(k, x[fit], y[fit], noise[fit, k], numbers[fit], STARTS[k])
        of_held = predicted(*function, x[held], x[fit])
        judged = models(k, x[held], y[held])(of_held)[0] - y[held, k]
        functions.append(function)
        errors.append(report(k, left, judged, x[fit], x[held]))
    write(SOLVES, x[fit], functions, errors)


def damping():
    """Damping at the higher frequency; contacts too thick to fit have bars as wide as their distance."""
    known, thick = damping_rows(DAMPING)
    kinds, numbers, x, y, noise = known
    fit, held = kinds == "fit", kinds == "held"
    counts = [(len(np.unique(numbers[part])), part.sum()) for part in (fit, held)]
    print("contacts and layers to fit, to judge:", *counts)
    function, left = fitted(3, x[fit], y[fit], noise[fit], numbers[fit], 0.5)
    judged = predicted(*function, x[held], x[fit]) - y[held]
    errors = report(3, left, judged, x[fit], x[held])
    at = thick[2].copy()
    at[:, 0] = np.log(THICK_DAMPING)
    beyond = predicted(*function, at, x[fit]) - thick[3]
    errors[-1] = quantile_map(beyond, thick[2])[-1]
    print("thick", errors[-1].round(2))
    np.savez_compressed(
        DAMPING_FILE,
        places=x[fit].astype(np.float32),
        scales=function[0],
        trend=function[1],
        weights=function[2],
        errors=errors,
    )


def write(path, x, functions, errors):
    """The table."""
    entries = [e for e in map(json.loads, path.read_text().splitlines()) if e["kind"] == "fit"]
    ends = np.array([[e["M"], e["ratio"]] for e in entries])
    upper = x.max(0)
    upper[3] = np.log(LARGEST_RATIO)
    np.savez_compressed(
        FILE,
        places=x.astype(np.float32),
        scales=np.array([f[0] for f in functions]),
        trends=np.array([f[1] for f in functions]),
        weights=np.array([f[2] for f in functions]),
        lower=x.min(0),
        upper=upper,
        least=np.array([*ends.min(0), 0.0]),
        largest=np.array([*ends.max(0), LARGEST_EXPONENT]),
        error_films=np.log(ERROR_FILMS),
        error_ratios=np.log(ERROR_RATIOS),
        errors=np.array(errors),
    )


if __name__ == "__main__":
    main()
