"""Exponential and logarithm of whole lines of nodes, for compiled kernels.

The machine's own functions take one number after the other. These are sums and products alone, in
loops that the compiler lays out for as many numbers at a time as a register holds, correct to a
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
def exponential(x, power):
    """Exp(x) in place of x, |x| < 700, both of shape (n,): with k = round(x/ln 2) and r = x - k ln
    2, 2^k times Taylor's polynomial of r, whose next term is below 5e-18. `power` is overwritten.
    """
    bits = power.view(np.int64)
    for i in range(x.size):
        power[i] = x[i] * LOG2_E + ROUNDING
        k = power[i] - ROUNDING
        x[i] = (x[i] - k * LN2_HIGH) - k * LN2_LOW
    for i in range(x.size):
        bits[i] = (bits[i] + BIAS) << DIGITS
    for i in range(x.size):
        r = x[i]
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
        x[i] = total * power[i]


@compiled
def logarithm(x, power):
    """Ln(x) in place of normal positive numbers x, both of shape (n,): x = 2^k m, m from sqrt(1/2)
    to sqrt(2), ln m = 2 artanh s, s = (m - 1)/(m + 1), by its series, whose next term is below
    1e-17 of it. `power` is overwritten.
    """
    bits = x.view(np.int64)
    power_bits = power.view(np.int64)
    for i in range(x.size):
        above = bits[i] - ROOT_HALF_BITS
        power_bits[i] = ((above >> DIGITS) + OFFSET) | WHOLE_BITS
        bits[i] = (above & FRACTION) + ROOT_HALF_BITS
    for i in range(x.size):
        s = (x[i] - 1.0) / (x[i] + 1.0)
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
        k = power[i] - (WHOLE + OFFSET)
        x[i] = k * LN2_HIGH + (2.0 * s + (2.0 * s * (q * total) + k * LN2_LOW))
