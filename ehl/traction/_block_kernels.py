"""Sums of the shear over a film's nodes for many motions: blocks of motions node by node, so that
the processor takes several at once.

A block's numbers lie in one flat array of `ROOM` rows of `BLOCK`. Loops over a block have neither
jumps nor calls of the mathematical library, the logarithm included.
"""

import numpy as np
from numba import types
from numba.extending import intrinsic, overload

from ..compiled import compiled
from ..oil._rheology_kernels import LIMIT_POWER, LIMIT_ROOTS, REE_EYRING, SMALL_SINE, shear_stress
from ._kernels import AREA, FILM, LIMIT, SPREAD_X, SPREAD_Y, TINY, VISCOSITY, X, Y

BLOCK = 32  # motions of a block; 16 and 64 take as long
# rows of a block's room: motions, sliding at a node and its pull (area stress/sliding), sums
SLIDE_X, SLIDE_Y, SPIN, ROLLING, AT_X, AT_Y, SLIDE, PULL = (BLOCK * row for row in range(8))
F_X, F_Y, M_N, M_Y, SQUARES = (BLOCK * row for row in range(8, 13))
ROOM = 13 * BLOCK
HALF_ROOT = 0x3FE6A09E667F3BCD  # bits of the root of 1/2
FRACTION_BITS = 52  # of a number's binary form
ROUNDED = 0x4338000000000000  # bits of ROUND_NUMBER
ROUND_NUMBER = 6755399441055744.0  # 1.5 2^52: whole numbers added to its bits add to its value
LOG_2 = float(np.log(2.0))


@intrinsic
def bits_of(typing, number):
    """The binary form of a number of single or double precision, a whole number of its size."""
    del typing
    whole = types.int32 if number == types.float32 else types.int64

    def build(context, builder, signature, arguments):
        del signature
        return builder.bitcast(arguments[0], context.get_value_type(whole))

    return whole(number), build


@intrinsic
def _number(typing, bits):
    """The number of a binary form."""
    del typing, bits

    def build(context, builder, signature, arguments):
        del signature
        return builder.bitcast(arguments[0], context.get_value_type(types.float64))

    return types.float64(types.int64), build


def logarithm(x):
    """ln(x) of a positive number, to 1e-15 absolutely."""
    return np.log(x)


@overload(logarithm)
def _compiled_logarithm(x):
    """`logarithm` where it is compiled: 2 artanh((m - 1)/(m + 1)) of x = m 2^e, m within a factor
    of sqrt(2) of one, by its series.
    """
    del x

    def of(x):
        bits = bits_of(x)
        power = (bits - HALF_ROOT) >> FRACTION_BITS
        m = _number(bits - (power << FRACTION_BITS))
        z = (m - 1.0) / (m + 1.0)
        q = z * z
        series = 1.0 / 11.0 + q * (1.0 / 13.0 + q * (1.0 / 15.0 + q * (1.0 / 17.0 + q / 19.0)))
        series = 1.0 / 5.0 + q * (1.0 / 7.0 + q * (1.0 / 9.0 + q * series))
        series = 1.0 + q * (1.0 / 3.0 + q * series)
        return 2.0 * z * series + LOG_2 * (_number(power + ROUNDED) - ROUND_NUMBER)

    return of


@compiled
def _slide_block(room, node, surface):
    """Sliding of a block's motions at a node, s_y times g, and its mean size over the node's strip
    as `film_quadrature` has both; area times the square of that added up.

    node: x, y, area and spread_x, spread_y, a twelfth of its squared size; surface: 1/(2R) over
    +-width across; y^2/(2R) does not grow beyond.
    """
    x, y, area, spread_x, spread_y = node
    curvature, width = surface
    height = curvature * min(y * y, width * width)
    steep = 2.0 * curvature * y if abs(y) < width else 0.0
    quarter = 3.0 * spread_y  # of the squared size
    for n in range(BLOCK):
        k = np.uint64(n)
        spin = room[k + np.uint64(SPIN)]
        rolling = room[k + np.uint64(ROLLING)]
        s_x = room[k + np.uint64(SLIDE_X)] - spin * y - rolling * height
        s_y = room[k + np.uint64(SLIDE_Y)] + spin * x
        slope = spin + rolling * steep
        along = s_x * s_x
        change = slope * slope * quarter
        both = along + s_y * s_y + change + spin * spin * spread_x
        square = max(0.5 * (both + np.sqrt(abs(both * both - 4.0 * along * change))), TINY)
        room[k + np.uint64(AT_X)] = s_x
        room[k + np.uint64(AT_Y)] = (
            s_y * (15.0 * square - 4.0 * change) / (15.0 * square - 9.0 * change)
        )
        room[k + np.uint64(SLIDE)] = np.sqrt(square)
        room[k + np.uint64(SQUARES)] += area * square


@compiled
def _eyring_pulls(room, gap, viscosity, stress):
    """Stress of a node at the sliding of a block by the law of Ree and Eyring, into its pull."""
    by_slide = viscosity / (gap * stress)
    for n in range(BLOCK):
        k = np.uint64(n)
        x = by_slide * room[k + np.uint64(SLIDE)]
        sine = logarithm(x + np.sqrt(x * x + 1.0))
        small = x * (1.0 - x * x * (1.0 / 6.0 - 0.075 * x * x))
        room[k + np.uint64(PULL)] = stress * (small if x < SMALL_SINE else sine)


@compiled
def _limit_pulls(room, area, limit):
    """Pull of a node from its stress, under the limit as `limited` has it: times (1 +
    ratio^m)^(-1/m) by the series of artanh and exp, to 1e-9.
    """
    for n in range(BLOCK):
        k = np.uint64(n)
        tau = room[k + np.uint64(PULL)]
        below = min(tau, limit)
        power = below / max(tau, limit)
        for _ in range(LIMIT_ROOTS):
            power *= power
        z = power / (2.0 + power)
        q = z * z
        series = 1.0 / 7.0 + q * (1.0 / 9.0 + q * (1.0 / 11.0 + q / 13.0))
        series = 1.0 + q * (1.0 / 3.0 + q * (1.0 / 5.0 + q * series))
        rest = z * series * (-2.0 / LIMIT_POWER)
        root = 1.0 + rest * (1.0 + rest * (0.5 + rest * (1.0 / 6.0 + rest / 24.0)))
        room[k + np.uint64(PULL)] = area * below * root / room[k + np.uint64(SLIDE)]


@compiled
def _other_pulls(room, area, gap, viscosity, limit, law):
    """Pull of a node on the motions of a block by any law."""
    for n in range(BLOCK):
        slide = room[SLIDE + n]
        room[PULL + n] = area * shear_stress(slide / gap, viscosity, limit, *law) / slide


@compiled
def pull_block(room, oil, law):
    """Pull of a node, of area, film, viscosity and limiting stress, at the sliding of a block."""
    area, gap, viscosity, limit = oil
    if law[0] == REE_EYRING:
        _eyring_pulls(room, gap, viscosity, law[1])
        _limit_pulls(room, area, limit)
    else:
        _other_pulls(room, area, gap, viscosity, limit, law)


@compiled
def _add_pulls(room, x, y, height):
    """Add a node's shares of F_x, F_y, M_n, M_y on body 1."""
    for n in range(BLOCK):
        k = np.uint64(n)
        pull = room[k + np.uint64(PULL)]
        t_x = pull * room[k + np.uint64(AT_X)]
        t_y = pull * room[k + np.uint64(AT_Y)]
        room[k + np.uint64(F_X)] -= t_x
        room[k + np.uint64(F_Y)] -= t_y
        room[k + np.uint64(M_N)] += y * t_x - x * t_y
        room[k + np.uint64(M_Y)] += height * t_x


@compiled
def block_sums(nodes, law, surface, room):
    """Forces and moments of a block's motions by sliding over nodes, and the sum of area times
    mean square of the sliding, into the room.

    nodes, shape (8, n): rows as `_kernels` names them. law: base law and its constants. surface:
    1/(2R) over +-width across.
    """
    room[F_X:ROOM] = 0.0
    curvature, width = surface
    for k in range(nodes.shape[1]):
        x, y, area = nodes[X, k], nodes[Y, k], nodes[AREA, k]
        oil = (area, nodes[FILM, k], nodes[VISCOSITY, k], nodes[LIMIT, k])
        _slide_block(room, (x, y, area, nodes[SPREAD_X, k], nodes[SPREAD_Y, k]), surface)
        pull_block(room, oil, law)
        _add_pulls(room, x, y, curvature * min(y * y, width * width))


@compiled
def load_block(motions, first, room):
    """Motions of a block, slide_x, slide_y, spin, rolling, from the first on; their number."""
    slide_x, slide_y, spin, rolling = motions
    count = min(BLOCK, slide_x.size - first)
    for n in range(BLOCK):
        k = first + min(n, count - 1)  # the last one again where there are no more
        room[SLIDE_X + n] = slide_x[k]
        room[SLIDE_Y + n] = slide_y[k]
        room[SPIN + n] = spin[k]
        room[ROLLING + n] = rolling[k]
    return count


@compiled
def _add_block(room, first, count, out):
    """Add a block's sums to the rows of its motions of out, shape (n, 4)."""
    for n in range(count):
        out[first + n, 0] += room[F_X + n]
        out[first + n, 1] += room[F_Y + n]
        out[first + n, 2] += room[M_N + n]
        out[first + n, 3] += room[M_Y + n]


@compiled
def sliding_sums_many(nodes, law, motions, surface, out):
    """F_x, F_y, M_n, M_y on body 1 by sliding for each of n motions, added to out, shape (n, 4).

    nodes, law and surface as in `block_sums`; motions: slide_x, slide_y, spin, rolling.
    """
    room = np.empty(ROOM)
    for first in range(0, motions[0].size, BLOCK):
        count = load_block(motions, first, room)
        block_sums(nodes, law, surface, room)
        _add_block(room, first, count, out)
