"""Compiled convolution along the columns of a grid: fast Fourier transforms of LANES complex
columns at once, a number of each in one register.

A column stands in a row of `z` for each of its numbers: real parts of all lanes, then imaginary
ones. All stages of a transform read at the same distances and write side by side (Pease, 1968),
radix 4, 3 and 2; its frequencies come out with the digits of their numbers reversed.
"""

import numpy as np

from ..compiled import allocating, compiled

LANES = 16  # two registers of 512 bits: 1.25 times as fast as with one (513 points)
# unsigned as places in an array are, of which none counts from its end
SIDE = np.uint64(LANES)  # from real to imaginary parts
PAIR = np.uint64(2 * LANES)  # numbers of a row
TWICE, THRICE, FOUR_TIMES = np.uint64(2), np.uint64(3), np.uint64(4)
ROOT_3_OVER_2 = 0.8660254037844386  # sine of 60 degrees


@compiled
def _radix_4(z, out, places, apart, turns, lanes):
    """Rows between two places, each with three others `apart`, transformed, and these turned back
    by the angles of `turns`.
    """
    cos_1, sin_1, cos_2, sin_2, cos_3, sin_3 = turns
    for at in range(places[0], places[1], PAIR):
        for lane in range(lanes):
            k = at + lane
            even = z[k] + z[k + TWICE * apart]
            odd = z[k + apart] + z[k + THRICE * apart]
            difference = z[k] - z[k + TWICE * apart]
            other = z[k + apart] - z[k + THRICE * apart]
            i = k + SIDE
            even_i = z[i] + z[i + TWICE * apart]
            odd_i = z[i + apart] + z[i + THRICE * apart]
            difference_i = z[i] - z[i + TWICE * apart]
            other_i = z[i + apart] - z[i + THRICE * apart]
            to = FOUR_TIMES * at + lane
            out[to] = even + odd
            out[to + SIDE] = even_i + odd_i
            _turn(difference + other_i, difference_i - other, cos_1, sin_1, out, to + PAIR)
            _turn(even - odd, even_i - odd_i, cos_2, sin_2, out, to + TWICE * PAIR)
            to_last = to + THRICE * PAIR
            _turn(difference - other_i, difference_i + other, cos_3, sin_3, out, to_last)


@compiled
def _turn(real, imaginary, cos, sin, out, k):
    """A complex number turned back by an angle, into place k."""
    out[k] = real * cos + imaginary * sin
    out[k + SIDE] = imaginary * cos - real * sin


@compiled
def _radix_3(z, out, places, apart, turns, lanes):
    """As `_radix_4`, of three rows."""
    cos_1, sin_1, cos_2, sin_2, _, _ = turns
    for at in range(places[0], places[1], PAIR):
        for lane in range(lanes):
            k = at + lane
            total = z[k + apart] + z[k + TWICE * apart]
            side = ROOT_3_OVER_2 * (z[k + apart] - z[k + TWICE * apart])
            half = z[k] - 0.5 * total
            i = k + SIDE
            total_i = z[i + apart] + z[i + TWICE * apart]
            side_i = ROOT_3_OVER_2 * (z[i + apart] - z[i + TWICE * apart])
            half_i = z[i] - 0.5 * total_i
            to = THRICE * at + lane
            out[to] = z[k] + total
            out[to + SIDE] = z[i] + total_i
            _turn(half + side_i, half_i - side, cos_1, sin_1, out, to + PAIR)
            _turn(half - side_i, half_i + side, cos_2, sin_2, out, to + TWICE * PAIR)


@compiled
def _radix_2(z, out, places, apart, turns, lanes):
    """As `_radix_4`, of two rows."""
    cos, sin = turns[:2]
    for at in range(places[0], places[1], PAIR):
        for lane in range(lanes):
            k = at + lane
            i = k + SIDE
            to = TWICE * at + lane
            out[to] = z[k] + z[k + apart]
            out[to + SIDE] = z[i] + z[i + apart]
            _turn(z[k] - z[k + apart], z[i] - z[i + apart], cos, sin, out, to + PAIR)


@compiled
def _stage(z, out, radix, before, roots, lanes):
    """One stage of sum z_n exp(-2 pi i n k/N), `before` the product of the radices before it."""
    rows = len(roots)
    apart = np.uint64(rows // radix) * PAIR
    for block in range(rows // (radix * before)):
        first = roots[before * block]
        second = roots[2 * before * block % rows]
        third = roots[3 * before * block % rows]
        turns = (first[0], first[1], second[0], second[1], third[0], third[1])
        places = np.uint64(block * before) * PAIR, np.uint64((block + 1) * before) * PAIR
        if radix == 4:
            _radix_4(z, out, places, apart, turns, lanes)
        elif radix == 3:
            _radix_3(z, out, places, apart, turns, lanes)
        else:
            _radix_2(z, out, places, apart, turns, lanes)


@allocating
def _transform(z, other, radices, roots, lanes):
    """Sum z_n exp(-2 pi i n k/N), digits of k reversed; the result and the other array."""
    before = 1
    for radix in radices:
        _stage(z, other, radix, before, roots, lanes)
        z, other = other, z
        before *= radix
    return z, other


@compiled
def _multiply(z, order, spectrum, out, lanes):
    """Frequencies in their order, times a real spectrum, real and imaginary parts exchanged: the
    next transform runs backwards.
    """
    for row in range(order.size):
        source = np.uint64(order[row]) * PAIR
        target = np.uint64(row) * PAIR
        factor = spectrum[row]
        for k in range(lanes):
            out[target + k] = z[source + SIDE + k] * factor[k]
            out[target + SIDE + k] = z[source + k] * factor[k]


@compiled
def _load_even(columns, turns, z, rows, width):
    """V_n of columns even about their first number and odd about N, parts exchanged: V_n = exp(i
    pi n/2N) x_n, V_(N-n) = exp(-i pi n/2N) x_n, whose transform holds the cosine series of type 3
    (Makhoul, 1980).
    """
    z[:] = 0.0
    for n in range(len(columns)):
        cos, sin = turns[n]
        ahead = np.uint64(n) * PAIR
        mirror = np.uint64((rows - n) % rows) * PAIR
        own = columns[n]
        for k in range(width):
            real = own[k].real
            imaginary = own[k].imag
            z[ahead + SIDE + k] = real * cos - imaginary * sin
            z[ahead + k] = real * sin + imaginary * cos
            if n > 0:
                z[mirror + SIDE + k] += real * cos + imaginary * sin
                z[mirror + k] += imaginary * cos - real * sin


@allocating
def _store_even(z, order, turns, far, columns, width):
    """Y_n = exp(-i pi n/2N) U_n + exp(i pi n/2N) U_(N-n), the way back of `_load_even`; the last
    number gets what its mirror image, at distance N, adds.
    """
    rows = order.size
    last = columns[len(columns) - 1]
    beyond = last.copy()
    for n in range(len(columns)):
        cos, sin = turns[n]
        ahead = np.uint64(order[n]) * PAIR
        mirror = np.uint64(order[(rows - n) % rows]) * PAIR
        own = columns[n]
        for k in range(width):
            real = z[ahead + k]
            imaginary = z[ahead + SIDE + k]
            other = z[mirror + k]
            other_i = z[mirror + SIDE + k]
            own[k] = complex(
                (real + other) * cos + (imaginary - other_i) * sin,
                (imaginary + other_i) * cos + (other - real) * sin,
            )
    for k in range(width):
        last[k] += far[k] * beyond[k]


@compiled
def _load(columns, z, width):
    """Columns and zeros after them."""
    z[:] = 0.0
    for n in range(len(columns)):
        own = columns[n]
        at = np.uint64(n) * PAIR
        for k in range(width):
            z[at + k] = own[k].real
            z[at + SIDE + k] = own[k].imag


@compiled
def _store(z, order, columns, width):
    """The way back of `_load`, parts exchanged."""
    for n in range(len(columns)):
        own = columns[n]
        at = np.uint64(order[n]) * PAIR
        for k in range(width):
            own[k] = complex(z[at + SIDE + k], z[at + k])


@allocating
def convolve_columns(columns, even, spectrum, far, tables, first, stop):
    """Convolution of complex columns, shape (ny, nx), with real even ones, in place; these are
    given by their spectrum, shape (blocks of LANES columns, N, LANES). Blocks from `first` to
    before `stop`.

    even: columns are even about their first number, and N is at least twice their number of
    intervals; else N is, of the spectrum's period. far: coefficient of the last number's mirror
    image, shape (blocks, LANES). tables: radices of N, positions of the frequencies, cosines and
    sines of 2 pi n/N and of pi n/2N.
    """
    radices, order, roots, turns = tables
    # LANES, unknown to the compiler: it would write out loops of so few rounds one by one
    lanes = np.uint64(spectrum.shape[2])
    one = np.zeros(order.size * 2 * LANES)
    two = np.zeros(order.size * 2 * LANES)
    for block in range(first, stop):
        own = columns[:, block * LANES : (block + 1) * LANES]
        width = np.uint64(own.shape[1])
        if even:
            _load_even(own, turns, one, order.size, width)
        else:
            _load(own, one, width)
        one, two = _transform(one, two, radices, roots, lanes)
        _multiply(one, order, spectrum[block], two, lanes)
        one, two = _transform(two, one, radices, roots, lanes)
        if even:
            _store_even(one, order, turns, far[block], own, width)
        else:
            _store(one, order, own, width)
