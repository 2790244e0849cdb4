"""Starvation law from its solves: `python tools/starvation/fit.py`, from `solves.jsonl` into ehl/closed_form."""

from __future__ import annotations

import json

import numpy as np
from numpy.linalg import LinAlgError
from scipy.linalg import cho_factor, cho_solve
from scipy.optimize import minimize
from solves import LARGEST_EXPONENT, SOLVES

from ehl.closed_form.starvation_table import FILE, place_of_contact, radial, trend_terms

MOMENT = 0.44  # of the step of T/T_0 by its lever from the coarser mesh that is added: order 1.7
LIGHT = 1.0  # Hc from which solves that want more points count, too
EXCESS = 0.003  # of R above 1 from which a solve is left out: its box is not that of the flooded film
ALONE = 0.02  # step where the coarser mesh did not converge
FLOORS = (4e-4, 1.5e-3, 6e-3)  # noise of ln R, ln R_min, T/T_0
BAR_SHARE, LARGEST_BAR = 0.2, 0.05  # of the error bars of the films that counts as noise, and the most
STEP_SHARE = 0.25  # of the step between the meshes that counts as noise


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
            x = np.array([*place_of_contact(e["M"], e["L"], e["ratio"]), np.log(r)])
            found.append((e["kind"], e["number"], x, y, noise))
    kinds, numbers, x, y, noise = zip(*found, strict=True)
    return np.array(kinds), np.array(numbers), np.array(x), np.array(y), np.array(noise)


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


def main():
    """Fit, judge, write."""
    kinds, numbers, x, y, noise = rows(SOLVES)
    fit, held = kinds == "fit", kinds == "held"
    counts = [(len(np.unique(numbers[part])), part.sum()) for part in (fit, held)]
    print("contacts and layers to fit, to judge:", *counts)
    functions, errors = [], []
    for k in range(3):
        model = models(k, x[fit], y[fit])
        one = Fit(x[fit], y[fit, k], noise[fit, k], model, STARTS[k])
        p = one.optimise(PRIOR.copy(), numbers[fit], ROUNDS, STEPS)
        print("scales, amplitude, noise", np.exp(p).round(3))
        trend, weight = one.weights(p)
        scales = np.exp(p[:4])
        left = model(one.left_out(p, numbers[fit]))[0] - y[fit, k]
        quantiles(f"left out {k}", left, x[fit])
        of_held = predicted(scales, trend, weight, x[held], x[fit])
        judged = models(k, x[held], y[held])(of_held)[0] - y[held, k]
        quantiles(f"held {k}", judged, x[held])
        worst = np.argsort(-np.abs(judged))[:4]
        print("   worst", [(np.exp(x[held][i]).round(3).tolist(), round(float(judged[i]), 4)) for i in worst])
        worst = np.argsort(-np.abs(left))[:4]
        print("   worst", [(np.exp(x[fit][i]).round(3).tolist(), round(float(left[i]), 4)) for i in worst])
        functions.append((scales, trend, weight))
        error = np.concatenate([left, judged])
        errors.append(quantile_map(error, np.concatenate([x[fit], x[held]])))
        print(np.round(errors[-1], 4))
    write(SOLVES, x[fit], functions, errors)


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
