"""Compiled sums of B-splines over the five axes of a traction table, as lookups take them."""

import numpy as np

from ..compiled import compiled, inlined

# values of a table: F_x, F_y, M_n, M_y of sliding, over the film's largest force and moments
COLUMNS = 4
ROW_SUMS = 16 * COLUMNS  # numbers at 4 loads times 4 speeds
CACHE_LINE = 32  # whole numbers of a table
# no sum of some of a table's whole numbers
IMPOSSIBLE = np.iinfo(np.int64).min


@compiled
def spline_weights(place, axis):
    """First index and cubic B-spline weights at a place on an axis (start, density, nodes)."""
    t = (place - axis[0]) * axis[1]
    i = min(max(int(np.floor(t)), 0), int(axis[2]) - 2)
    t -= i
    r = 1.0 - t
    inner = (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0
    outer = (4.0 - 6.0 * r * r + 3.0 * r * r * r) / 6.0
    return i, (r * r * r / 6.0, inner, outer, t * t * t / 6.0)


@compiled
def inner_weights(place, axis):
    """Weights as `spline_weights`, of the coefficients of the nodes alone, counted from the first:
    those beyond follow, c_0 = 4 c_1 - 6 c_2 + 4 c_3 - c_4, by the splines' end conditions.
    """
    i, (w_0, w_1, w_2, w_3) = spline_weights(place, axis)
    last = int(axis[2]) - 4
    if i == 0:
        return 0, (w_1 + 4.0 * w_0, w_2 - 6.0 * w_0, w_3 + 4.0 * w_0, -w_0)
    if i > last + 1:
        return last, (-w_3, w_0 + 4.0 * w_3, w_1 - 6.0 * w_3, w_2 + 4.0 * w_3)
    return i - 1, (w_0, w_1, w_2, w_3)


@compiled
def _read(flat, start, steps, span):
    """Have all numbers around a place on their way from memory before the first is used, and the
    sum of some: in a table larger than the cache lookups wait for each motion in turn otherwise,
    three times as long. steps: between motions; span: numbers of one.
    """
    some = 0
    for c in range(4):
        for d in range(4):
            for e in range(4):
                here = start + c * steps[0] + d * steps[1] + e * steps[2]
                some += flat[np.uint64(here)] + flat[np.uint64(here + CACHE_LINE)]
                some += flat[np.uint64(here + span - 1)]
                for k in range(2 * CACHE_LINE, span - 1, CACHE_LINE):
                    some += flat[np.uint64(here + k)]
    return some


@compiled
def spline_sum(values, first, w0, w1, w2, w3, w4):
    """Sums of the 4^5 coefficients around a place, weighted along each axis.

    values, shape (nX + 2, nY + 2, nS + 2, nQ, nU, 4): those of 4 loads and 4 speeds lie close
    together, of tables with 4 speeds side by side, and are summed over the motions at once; the
    weights along load and speed come last. (Written so that the compiler keeps them in a few wide
    registers.)
    """
    i0, i1, i2, i3, i4 = first
    _, n3, n4, n0, n1, _ = values.shape
    flat = values.reshape(-1)
    sums = np.empty(ROW_SUMS)
    for k in range(ROW_SUMS):
        sums[k] = 0.0
    row = n1 * COLUMNS
    place = n0 * row  # numbers of one motion
    start = ((i2 * n3 + i3) * n4 + i4) * place + (i0 * n1 + i1) * COLUMNS
    span = 3 * row + 4 * COLUMNS
    if _read(flat, start, (n3 * n4 * place, n4 * place, place), span) == IMPOSSIBLE:
        return 0.0, 0.0, 0.0, 0.0
    for c in range(4):
        for d in range(4):
            weight = w2[c] * w3[d]
            v = (weight * w4[0], weight * w4[1], weight * w4[2], weight * w4[3])
            here = start + (c * n3 + d) * n4 * place
            if n1 == 4:
                for k in range(ROW_SUMS):
                    m = np.uint64(here + k)
                    part = v[0] * flat[m] + v[1] * flat[m + np.uint64(place)]
                    part += v[2] * flat[m + np.uint64(2 * place)]
                    sums[k] += part + v[3] * flat[m + np.uint64(3 * place)]
                continue
            for a in range(4):
                for k in range(4 * COLUMNS):
                    m = np.uint64(here + a * row + k)
                    part = v[0] * flat[m] + v[1] * flat[m + np.uint64(place)]
                    part += v[2] * flat[m + np.uint64(2 * place)]
                    sums[4 * COLUMNS * a + k] += part + v[3] * flat[m + np.uint64(3 * place)]
    return _over_films(sums, w0, w1)


@inlined
def _over_films(sums, w0, w1):
    """Sums of motions weighted along load and speed."""
    t0 = t1 = t2 = t3 = 0.0
    for a in range(4):
        for b in range(4):
            weight = w0[a] * w1[b]
            first_sum = (4 * a + b) * COLUMNS
            t0 += weight * sums[first_sum]
            t1 += weight * sums[first_sum + 1]
            t2 += weight * sums[first_sum + 2]
            t3 += weight * sums[first_sum + 3]
    return t0, t1, t2, t3
