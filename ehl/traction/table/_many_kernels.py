"""Compiled kernels of a film's sliding forces at thousands of motions.

The pull of a node, its area times stress over the sliding, is tabulated over the square of the
sliding at the numbers whose mantissa has its first four bits only: sixteen in each factor of two.
They are read off the bits of a number, and between them the pull is a straight line: 0.05 % too
large at most where the stress is limited, and exact where it goes with the sliding, also below the
smallest square. In single precision, of which the processor takes most at once; loops over a block
have neither jumps nor calls, and but one row of the room that they write to.
"""

import numpy as np

from ...compiled import compiled
from .._block_kernels import BLOCK as LAW_BLOCK
from .._block_kernels import PULL as LAW_PULL
from .._block_kernels import ROOM as LAW_ROOM
from .._block_kernels import SLIDE, bits_of, pull_block
from .._kernels import AREA, FILM, LIMIT, SPREAD_X, SPREAD_Y, TINY, VISCOSITY, X, Y
from ..heated._kernels import NEAREST, cubic_weights, first_weighted

BLOCK = 256  # motions of a block; of 64 and 128 the sums take 1.4 and 1.1 times as long
# rows of a block's room: motions, sliding at a node, its square and then its pull, sums of forces,
# moments, and area times squares
ROWS = [np.uint64(BLOCK * row) for row in range(12)]
SLIDE_X, SLIDE_Y, SPIN, ROLLING, AT_X, AT_Y, PULL, F_X, F_Y, M_N, M_Y, SQUARES = ROWS
ROOM = 12 * BLOCK
# further ones of films with heat: sums over all strips
ALL_X, ALL_Y, ALL_N, ALL_R = (np.uint64(BLOCK * row) for row in range(12, 16))
HEATED_ROOM = 16 * BLOCK
SHIFT = 19  # bits of a mantissa of 23 that are not the first four
STEP = 1 << SHIFT
PART = np.int32(STEP - 1)
BY_STEP = np.float32(1.0 / STEP)
INSIDE = np.float32(1.0 - 1e-6)  # of the last square, so that one stands behind it
NONE, HALF, TWO, THREE, FOUR = (np.float32(k) for k in (0.0, 0.5, 2.0, 3.0, 4.0))
NINE, FIFTEEN = np.float32(9.0), np.float32(15.0)


@compiled
def node_pulls(nodes, law, slides, out):
    """Area times stress over sliding of nodes [N s/m] at slides [m/s], into out of shape (nodes,
    slides); nodes and law as `block_sums`.
    """
    room = np.empty(LAW_ROOM)
    for first in range(0, slides.size, LAW_BLOCK):
        count = min(LAW_BLOCK, slides.size - first)
        for k in range(LAW_BLOCK):
            room[SLIDE + k] = slides[first + min(k, count - 1)]
        for n in range(out.shape[0]):
            oil = (nodes[AREA, n], nodes[FILM, n], nodes[VISCOSITY, n], nodes[LIMIT, n])
            pull_block(room, oil, law)
            for k in range(count):
                out[n, first + k] = room[LAW_PULL + k]


@compiled
def _slide_block(room, node, surface, ends):
    """Sliding of a block's motions at a node, as `_block_kernels` has it, and the square of its
    mean between ends; node: x, y, a twelfth of its squared size along x and a quarter of that
    along y.
    """
    x, y, spread_x, quarter = node
    height, steep = surface
    lowest, highest = ends
    for n in range(BLOCK):
        k = np.uint64(n)
        spin = room[k + SPIN]
        rolling = room[k + ROLLING]
        s_x = room[k + SLIDE_X] - spin * y - rolling * height
        s_y = room[k + SLIDE_Y] + spin * x
        slope = spin + rolling * steep
        along = s_x * s_x
        change = slope * slope * quarter
        both = along + s_y * s_y + change + spin * spin * spread_x
        square = HALF * (both + np.sqrt(abs(both * both - FOUR * along * change)))
        square = min(max(square, lowest), highest)
        room[k + AT_X] = s_x
        most = FIFTEEN * square
        room[k + AT_Y] = s_y * (most - FOUR * change) / (most - NINE * change)
        room[k + PULL] = square


@compiled
def _tabulated_pulls(room, pulls, first):
    """Pull of a node on the motions of a block by its table, whose first square has these bits."""
    for n in range(BLOCK):
        k = np.uint64(n)
        code = bits_of(room[k + PULL])
        place = np.uint64((code >> SHIFT) - first)
        own = pulls[place]
        share = np.float32(code & PART) * BY_STEP
        room[k + PULL] = own + share * (pulls[place + np.uint64(1)] - own)


@compiled
def _add_pulls(room, x, y, height):
    """Add a node's shares of F_x, F_y, M_n, M_y on body 1."""
    for n in range(BLOCK):
        k = np.uint64(n)
        t_x = room[k + PULL] * room[k + AT_X]
        t_y = room[k + PULL] * room[k + AT_Y]
        room[k + F_X] -= t_x
        room[k + F_Y] -= t_y
        room[k + M_N] += y * t_x - x * t_y
        room[k + M_Y] += height * t_x


@compiled
def _load_block(room, motions, start):
    """Motions of a block from the first on, the last one again where there are no more; their
    number.
    """
    count = min(BLOCK, motions.shape[1] - start)
    for row in range(4):
        for n in range(BLOCK):
            room[row * BLOCK + n] = motions[row, start + min(n, count - 1)]
    return count


@compiled
def _add_squares(room, area):
    """Add a node's area times the mean square of its sliding."""
    for n in range(BLOCK):
        k = np.uint64(n)
        room[k + SQUARES] += area * room[k + PULL]


@compiled
def _block_sums(room, nodes, pulls, surface, ends, first):
    """Sums of a block's motions over nodes, into the room."""
    curvature, width = surface
    room[F_X:ROOM] = NONE
    for n in range(nodes.shape[1]):
        x, y = nodes[X, n], nodes[Y, n]
        height = curvature * min(y * y, width * width)
        steep = TWO * curvature * y if abs(y) < width else NONE
        node = (x, y, nodes[SPREAD_X, n], THREE * nodes[SPREAD_Y, n])
        _slide_block(room, node, (height, steep), ends)
        _add_squares(room, nodes[AREA, n])
        _tabulated_pulls(room, pulls[n], first)
        _add_pulls(room, x, y, height)


@compiled
def tabulated_sums(nodes, pulls, squares, motions, surface, out):
    """As `sliding_sums_many` by pulls of `node_pulls`, the numbers of all arrays in single
    precision.
    """
    first = np.int32(bits_of(squares[0]) >> SHIFT)
    ends = (squares[0], squares[squares.size - 1] * INSIDE)
    room = np.empty(ROOM, np.float32)
    for start in range(0, motions.shape[1], BLOCK):
        count = _load_block(room, motions, start)
        _block_sums(room, nodes, pulls, surface, ends, first)
        for n in range(count):
            for row in range(4):
                out[start + n, row] += room[(7 + row) * BLOCK + n]


@compiled
def factor_table(factors, axis, slides, out):
    """Factors of strips, shape (K, R, S), at sliding speeds [m/s] by cubics, into
    out, shape (K, R, slides); axis as `factored_sums`.
    """
    for m in range(slides.size):
        place = (np.log(slides[m]) - axis[0]) * axis[1]
        i, w_0, w_1, w_2, w_3 = cubic_weights(factors.shape[2], place)
        for k in range(factors.shape[0]):
            for r in range(factors.shape[1]):
                row = factors[k, r, i : i + 4]
                out[k, r, m] = w_0 * row[0] + w_1 * row[1] + w_2 * row[2] + w_3 * row[3]


@compiled
def _load_weights(weights, start, count, near, own):
    """Weights of a block's motions, and the first of the responses that they are of."""
    for n in range(BLOCK):
        at = start + min(n, count - 1)
        near[n] = first_weighted(weights[at])
        for r in range(NEAREST):
            own[r, n] = weights[at, near[n] + r]


@compiled
def _add_heated(room, factors, by_area, ends, first, near, own):
    """Add the sums of a strip, times its factors by its mean sliding."""
    lowest, highest = ends
    for n in range(BLOCK):
        k = np.uint64(n)
        square = min(max(by_area * room[k + SQUARES], lowest), highest)
        code = bits_of(square)
        place = np.uint64((code >> SHIFT) - first)
        share = np.float32(code & PART) * BY_STEP
        factor = NONE
        for r in range(NEAREST):
            row = factors[near[n] + r]
            low = row[place]
            factor += own[r, n] * (low + share * (row[place + np.uint64(1)] - low))
        room[k + ALL_X] += factor * room[k + F_X]
        room[k + ALL_Y] += factor * room[k + F_Y]
        room[k + ALL_N] += factor * room[k + M_N]
        room[k + ALL_R] += factor * room[k + M_Y]


@compiled
def tabulated_lines(lines, pulls, squares, motions, weights, surface, out):
    """As `heated._kernels.factored_sums` by pulls of `node_pulls`, shape (K, N, slides), and
    factors of `factor_table`; the numbers of all arrays but out in single precision.
    """
    nodes, factors = lines
    first = np.int32(bits_of(squares[0]) >> SHIFT)
    ends = (squares[0], squares[squares.size - 1] * INSIDE)
    room = np.empty(HEATED_ROOM, np.float32)
    near = np.empty(BLOCK, dtype=np.int64)
    own = np.empty((NEAREST, BLOCK), np.float32)
    for start in range(0, motions.shape[1], BLOCK):
        count = _load_block(room, motions, start)
        _load_weights(weights, start, count, near, own)
        room[ALL_X:] = NONE
        for k in range(nodes.shape[0]):
            _block_sums(room, nodes[k], pulls[k], surface, ends, first)
            by_area = np.float32(1.0 / max(np.float64(nodes[k, AREA].sum()), TINY))
            _add_heated(room, factors[k], by_area, ends, first, near, own)
        for n in range(count):
            for row in range(4):
                out[start + n, row] += room[(12 + row) * BLOCK + n]
