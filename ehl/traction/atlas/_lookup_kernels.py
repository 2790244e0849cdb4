"""Compiled films of many contacts from the atlas on a lattice; see `arrays` for what it holds."""

import numpy as np

from ...compiled import compiled


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
def _oil_powers(dz, a, own):
    """z', a, z' a, a^2 and z'^2 of an oil, `own`."""
    own[0] = dz
    own[1] = a
    own[2] = dz * a
    own[3] = a * a
    own[4] = dz * dz


@compiled
def look_up(x, dz, a, low, step, lattice, oils, out):
    """ln(Hc A), ln(Hmin A), Hc - H0 and the derivatives by ln A of first and last, `out` of shape
    (n, 5), at x of shape (n, 3): a cubic through the lattice, and the terms of another oil, dz of
    Roelands' z and a = ln(alpha/alpha_0), shape (n,).
    """
    weights = np.empty((3, 4))
    slopes = np.empty((3, 4))
    first = np.empty(3, dtype=np.int64)
    own = np.empty(5)
    for n in range(x.shape[0]):
        for k in range(3):
            at = (x[n, k] - low[k]) / step[k]
            first[k] = _cubic(at, lattice.shape[k], weights[k], slopes[k])
        out[n] = 0.0
        for i in range(4):
            for j in range(4):
                both = weights[0, i] * weights[1, j]
                steep = slopes[0, i] * weights[1, j]
                for k in range(4):
                    node = lattice[first[0] + i, first[1] + j, first[2] + k]
                    weight = both * weights[2, k]
                    out[n, 0] += weight * node[0]
                    out[n, 1] += weight * node[1]
                    out[n, 2] += weight * node[2]
                    out[n, 3] += steep * weights[2, k] * node[0]
                    out[n, 4] += steep * weights[2, k] * node[2]
        out[n, 3:] /= step[0]
        _oil_powers(dz[n], a[n], own)
        for m in range(5):
            if own[m] != 0.0:
                strength = own[m] * x[n, 1]
                row = 4 * m
                for k in range(4):
                    share = strength if k == 0 else strength * x[n, k - 1]
                    out[n, 0] += share * oils[row + k, 0]
                    out[n, 1] += share * oils[row + k, 1]
                    out[n, 2] += share * oils[row + k, 2]
                out[n, 3] += strength * oils[row + 1, 0]
                out[n, 4] += strength * oils[row + 1, 2]
