"""Readable NumPy form of the compiled law of starvation: one contact, one layer."""

import numpy as np

from oilfilm.ehl.arrays import radial, trend_terms
from oilfilm.ehl.closed_form.starvation import contact_coordinates, table

LEAST_RISE = 1e-6


def rising(values):
    """Largest value so far, plus a small slope."""
    slope = LEAST_RISE * np.arange(len(values))
    return np.maximum.accumulate(values - slope) + slope


def log_film(exponent, log_ratio):
    """ln R of R = r/(1 + r^g)^(1/g)."""
    g = np.exp(exponent)
    return np.minimum(log_ratio, 0.0) - np.log1p(np.exp(-g * np.abs(log_ratio))) / g


def exponent_of(wanted, log_ratio, before):
    """ln g that gives ln R by halving, where it was raised."""
    if wanted <= log_film(before, log_ratio) + 0.5 * LEAST_RISE:
        return before
    ends = [before, 5.0]
    for _ in range(50):
        middle = 0.5 * sum(ends)
        ends[int(log_film(middle, log_ratio) >= wanted)] = middle
    return ends[0]


def shares(contact, ratio):
    """R, R_min, T/T_0 and the damping's factor at r."""
    known = table()
    nodes = known.log_ratios
    x = np.empty((len(nodes), 4))
    x[:, :3] = np.clip(contact_coordinates(*contact), known.lower[:3], known.upper[:3])
    x[:, 3] = nodes
    exponent, gain, moment, damping = (
        trend_terms(x) @ f.trend + radial(x, f.centres, f.scales) @ f.weights for f in known.functions
    )
    film = rising(log_film(exponent, nodes))
    exponent = np.array([exponent_of(*one) for one in zip(film, nodes, exponent, strict=True)])
    minimum = rising(np.minimum(film - np.expm1(film) * gain, 0.0))
    gain = (minimum - film) / -np.expm1(film)
    at = np.log(ratio)
    g, c, s, d = (np.interp(at, nodes, values) for values in (exponent, gain, rising(moment), damping))
    central = np.exp(min(np.log(ratio), 0.0) - np.log1p(np.exp(-np.exp(g) * abs(np.log(ratio)))) / np.exp(g))
    beyond = at - np.clip(at, nodes[0], nodes[-1])
    ends = [1.0 / (1.0 + np.exp(-s)), d]
    moment, damping = (1.0 - (1.0 - y) * np.exp(-beyond) if beyond > 0.0 else y * np.exp(beyond) for y in ends)
    return central, min(central * np.exp((1.0 - central) * c), 1.0), moment, damping
