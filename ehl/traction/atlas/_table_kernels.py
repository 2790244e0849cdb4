"""Compiled radial functions of `table`."""

import numpy as np

from ...compiled import compiled
from ...oil._elementary_kernels import exponential_of

FARTHEST = 600.0  # up to which e^-t is no zero and `exponential_of` holds [-]


@compiled
def _radial(x, places, shares, out):
    """(1 + t + t^2/3) e^-t, t = sqrt(5) |(x - place) shares|, of places (3, n)."""
    for j in range(out.size):
        first = (x[0] - places[0, j]) * shares[0]
        second = (x[1] - places[1, j]) * shares[1]
        third = (x[2] - places[2, j]) * shares[2]
        t = np.sqrt(5.0 * (first * first + second * second + third * third))
        out[j] = (1.0 + t + t * t / 3.0) * exponential_of(-min(t, FARTHEST))


@compiled
def near_functions(x, places, scales, step, found):
    """The functions of `table.near` with places (n, 3) at x (m, 3), found of shape (m, n)."""
    centre, width, variance = step[:3]
    shares = 1.0 / scales
    narrow = 1.0 / step[3:]
    turned = np.empty((3, places.shape[0]))
    for j in range(places.shape[0]):
        for k in range(3):
            turned[k, j] = places[j, k]
    other = np.empty(places.shape[0])
    for i in range(x.shape[0]):
        _radial(x[i], turned, shares, found[i])
        here = variance * np.exp(-0.5 * ((x[i, 0] - centre) / width) ** 2)
        if here > 0.0:
            _radial(x[i], turned, narrow, other)
            for j in range(other.size):
                away = (turned[0, j] - centre) / width
                there = exponential_of(-min(0.5 * away * away, FARTHEST))
                found[i, j] += here * there * other[j]
