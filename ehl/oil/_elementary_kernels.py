"""Exponential and logarithm, of one number and of whole lines of nodes, and copies of arrays, for
compiled kernels.

The machine's own functions take one number after the other. These are sums and products alone: a
loop over them is laid out for as many numbers at a time as a register holds. They are correct to a
few units of the last of 53 binary digits. Powers of two are written into the exponent of a number:
IEEE 754 (2019), binary64.
"""

import numpy as np

from ..compiled import compiled

LOG2_E = 1.4426950408889634  # 1/ln 2
# ln 2 in two parts: a whole number of up to 20 digits times the first is exact
LN2_HIGH = float.fromhex("0x1.62e42fee00000p-1")
LN2_LOW = float.fromhex("0x1.a39ef35793c76p-33")
DIGITS = 52  # binary, of the fraction
FRACTION = 2**DIGITS - 1
BIAS = 1023  # of the exponent
# added to a number below 2^51, rounds it and leaves the whole number in its last digits
ROUNDING = 1.5 * 2.0**DIGITS
# the same for whole numbers above -2048, written into the digits of 2^52
WHOLE = 2.0**DIGITS
WHOLE_BITS = (BIAS + DIGITS) << DIGITS
OFFSET = 2048
ROOT_HALF_BITS = 0x3FE6A09E667F3BCD  # of sqrt(1/2)


@compiled
def copy(source, target):
    """Numbers of an array (n,), or of a tuple, into an array. Assigned to a slice they would be
    compared in number first, and the text of numba's error takes as long to compile as a hundred
    lines.
    """
    for i in range(target.size):
        target[i] = source[i]


@compiled
def copy_rows(source, target):
    """Numbers of one array (m, n) into another."""
    for j in range(target.shape[0]):
        copy(source[j], target[j])


@compiled
def exponential_of(x):
    """Exp(x), |x| < 700: with k = round(x/ln 2) and r = x - k ln 2, 2^k times Taylor's polynomial
    of r, whose next term is below 5e-18.
    """
    power = x * LOG2_E + ROUNDING
    k = power - ROUNDING
    r = (x - k * LN2_HIGH) - k * LN2_LOW
    total = 1.0 / 6227020800.0
    total = total * r + 1.0 / 479001600.0
    total = total * r + 1.0 / 39916800.0
    total = total * r + 1.0 / 3628800.0
    total = total * r + 1.0 / 362880.0
    total = total * r + 1.0 / 40320.0
    total = total * r + 1.0 / 5040.0
    total = total * r + 1.0 / 720.0
    total = total * r + 1.0 / 120.0
    total = total * r + 1.0 / 24.0
    total = total * r + 1.0 / 6.0
    total = total * r + 0.5
    total = total * r + 1.0
    total = total * r + 1.0
    bits = np.float64(power).view(np.int64)
    return total * np.int64((bits + BIAS) << DIGITS).view(np.float64)


@compiled
def logarithm_of(x):
    """Ln(x) of a normal positive number: x = 2^k m, m from sqrt(1/2) to sqrt(2), ln m = 2 artanh
    s, s = (m - 1)/(m + 1), by its series, whose next term is below 1e-17 of it; what is not a
    finite number gives none.
    """
    above = np.float64(x).view(np.int64) - ROOT_HALF_BITS
    m = np.int64((above & FRACTION) + ROOT_HALF_BITS).view(np.float64)
    k = np.int64(((above >> DIGITS) + OFFSET) | WHOLE_BITS).view(np.float64) - (WHOLE + OFFSET)
    s = (m - 1.0) / (m + 1.0)
    q = s * s
    total = 1.0 / 21.0
    total = total * q + 1.0 / 19.0
    total = total * q + 1.0 / 17.0
    total = total * q + 1.0 / 15.0
    total = total * q + 1.0 / 13.0
    total = total * q + 1.0 / 11.0
    total = total * q + 1.0 / 9.0
    total = total * q + 1.0 / 7.0
    total = total * q + 1.0 / 5.0
    total = total * q + 1.0 / 3.0
    return k * LN2_HIGH + (2.0 * s + (2.0 * s * (q * total) + k * LN2_LOW)) + (x - x)


@compiled
def exponential(x):
    """`exponential_of` in place of numbers x (n,)."""
    for i in range(x.size):
        x[i] = exponential_of(x[i])


@compiled
def logarithm(x):
    """`logarithm_of` in place of numbers x (n,)."""
    for i in range(x.size):
        x[i] = logarithm_of(x[i])
