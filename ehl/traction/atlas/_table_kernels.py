"""Compiled sums of the radial functions of `table`."""

import numpy as np

from ...compiled import compiled


@compiled
def _radial(x, place, shares):
    """(1 + t + t^2/3) e^-t, t = sqrt(5) |(x - place) shares|."""
    first = (x[0] - place[0]) * shares[0]
    second = (x[1] - place[1]) * shares[1]
    third = (x[2] - place[2]) * shares[2]
    t = np.sqrt(5.0 * (first * first + second * second + third * third))
    return (1.0 + t + t * t / 3.0) * np.exp(-t)


@compiled
def add_near(x, places, scales, step, weights, out):
    """Add the functions of `table.near` at x (m, 3) times weights (n, k) to out (m, k)."""
    centre, width, variance = step[:3]
    shares = 1.0 / scales
    narrow = 1.0 / step[3:]
    for i in range(x.shape[0]):
        here = variance * np.exp(-0.5 * ((x[i, 0] - centre) / width) ** 2)
        for j in range(places.shape[0]):
            found = _radial(x[i], places[j], shares)
            if here > 0.0:
                there = np.exp(-0.5 * ((places[j, 0] - centre) / width) ** 2)
                found += here * there * _radial(x[i], places[j], narrow)
            for k in range(weights.shape[1]):
                out[i, k] += found * weights[j, k]
