"""Compiled films of many contacts from the atlas on a lattice; see `arrays` for what it holds."""

import numpy as np

from ..compiled import compiled
from ..oil._kernels import exponential_of

FARTHEST = 600.0  # up to which e^-t is no zero and `exponential_of` holds [-]


@compiled
def _cubic(at, count, weights, slopes):
    """First of four nodes around a place on a lattice of so many, their Lagrange weights and the
    derivatives of these.
    """
    first = min(max(int(at) - 1, 0), count - 4)
    s = at - first - 1.0
    weights[0] = -s * (s - 1.0) * (s - 2.0) / 6.0
    weights[1] = (s + 1.0) * (s - 1.0) * (s - 2.0) / 2.0
    weights[2] = -(s + 1.0) * s * (s - 2.0) / 2.0
    weights[3] = (s + 1.0) * s * (s - 1.0) / 6.0
    slopes[0] = -(3.0 * s * s - 6.0 * s + 2.0) / 6.0
    slopes[1] = (3.0 * s * s - 4.0 * s - 1.0) / 2.0
    slopes[2] = -(3.0 * s * s - 2.0 * s - 2.0) / 2.0
    slopes[3] = (3.0 * s * s - 1.0) / 6.0
    return first


@compiled
def axis_ratios(log_ratio, low, step, sizes):
    """f of Rx/Ry, shape (n,), by its logarithm, through even nodes of ln f."""
    weights = np.empty(4)
    slopes = np.empty(4)
    found = np.empty(log_ratio.shape[0])
    for n in range(log_ratio.shape[0]):
        at = (log_ratio[n] - low) / step
        if not (at > -1.0 and at < sizes.shape[0] + 1.0):
            found[n] = np.nan
            continue
        first = _cubic(at, sizes.shape[0], weights, slopes)
        total = 0.0
        for i in range(4):
            total += weights[i] * sizes[first + i]
        found[n] = np.exp(total)
    return found


@compiled
def _add_oil(at, step, oils, features, out):
    """Add what an oil's features are multiplied by, and its derivatives by the first axis, between
    the eight nodes around a place on the lattice.
    """
    first = np.empty(3, dtype=np.int64)
    share = np.empty(3)
    for k in range(3):
        first[k] = min(max(int(at[k]), 0), oils.shape[k] - 2)
        share[k] = at[k] - first[k]
    for corner in range(8):
        i = corner & 1
        j = corner >> 1 & 1
        k = corner >> 2
        across = (share[1] if j else 1.0 - share[1]) * (share[2] if k else 1.0 - share[2])
        weight = across * (share[0] if i else 1.0 - share[0])
        steep = (across if i else -across) / step
        node = oils[first[0] + i, first[1] + j, first[2] + k]
        for m in range(5):
            strength = features[m] * weight
            out[0] += strength * node[m, 0]
            out[1] += strength * node[m, 1]
            out[2] += strength * node[m, 2]
            out[3] += features[m] * steep * node[m, 0]
            out[4] += features[m] * steep * node[m, 2]


@compiled
def look_up(x, features, shares, low, step, lattice, oils, out):
    """Add to `out` of shape (n, 5) ln(Hc A), ln(Hmin A), Hc - H0 and the derivatives by ln A of
    first and last, of a patch with `shares` and their derivatives by ln A, shape (2, n), at x of
    shape (n, 3) with oils of `oil_features`, shape (n, 5): a cubic through the lattice of the oil
    of the solves, and between the nodes of that of others, shape (..., 5, 3).
    """
    weights = np.empty((3, 4))
    slopes = np.empty((3, 4))
    first = np.empty(3, dtype=np.int64)
    at = np.empty(3)
    own = np.empty(5)
    for n in range(x.shape[0]):
        if not shares[0, n] > 0.0:
            continue
        for k in range(3):
            at[k] = (x[n, k] - low[k]) / step[k]
            first[k] = _cubic(at[k], lattice.shape[k], weights[k], slopes[k])
        own[:] = 0.0
        for i in range(4):
            for j in range(4):
                both = weights[0, i] * weights[1, j]
                steep = slopes[0, i] * weights[1, j]
                for k in range(4):
                    node = lattice[first[0] + i, first[1] + j, first[2] + k]
                    weight = both * weights[2, k]
                    own[0] += weight * node[0]
                    own[1] += weight * node[1]
                    own[2] += weight * node[2]
                    own[3] += steep * weights[2, k] * node[0]
                    own[4] += steep * weights[2, k] * node[2]
        own[3:] /= step[0]
        if features[n, 0] != 0.0 or features[n, 1] != 0.0:
            _add_oil(at, step[0], oils, features[n], own)
        for f in range(5):
            out[n, f] += shares[0, n] * own[f]
        out[n, 3] += shares[1, n] * own[0]
        out[n, 4] += shares[1, n] * own[2]


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
    """Radial functions `table.slanted_radial` of places (n, 3) at x (m, 3), into found (m, n)."""
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
