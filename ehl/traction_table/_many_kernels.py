"""Compiled kernels of a film's sliding forces at thousands of motions.

The pull of a node, its area times stress over the sliding, is tabulated over the square of the
sliding at the numbers whose mantissa has its first four bits only: sixteen in each factor of two.
They are read off the bits of a number, and between them the pull is a straight line: 0.05 % too
large at most where the stress is limited, and exact where it goes with the sliding, also below the
smallest square. In single precision, of which the processor takes most at once; loops over a block
have neither jumps nor calls, and but one row of the room that they write to.

What is summed are rows of nodes: the few patches of a group of strips where all motions of a block
slide much more than their sliding changes over it, else the strips one by one, in patches along x
or with all their nodes (`film`).
"""

import numpy as np

from ..compiled import compiled, inlined
from ..traction._heated_kernels import NEAREST, cubic_weights, first_weighted
from ..traction._kernels import AREA, FILM, LIMIT, SLIDE, VISCOSITY, bits_of, pull_block
from ..traction._kernels import BLOCK as LAW_BLOCK
from ..traction._kernels import PULL as LAW_PULL
from ..traction._kernels import ROOM as LAW_ROOM

BLOCK = 32  # motions of a block: of more, more of a group's strips are needed
BLOCKS = 64  # blocks at a time
# rows of a block's room: motions, sliding at a node, its square and then its pull, sums of forces,
# moments, and area times squares; further ones of films with heat: sums over all rows of nodes
ROWS = [np.uint64(BLOCK * row) for row in range(16)]
SLIDE_X, SLIDE_Y, SPIN, ROLLING, AT_X, AT_Y, PULL, F_X, F_Y, M_N, M_Y, SQUARES = ROWS[:12]
ALL_X, ALL_Y, ALL_N, ALL_R = ROWS[12:]
ROOM = 16 * BLOCK
COLD_SUMS = 7  # first row of the sums without heat
HOT_SUMS = 12  # with it
# rows of a patch's node: place [m], area [m^2], a twelfth of the squared size along x and a
# quarter of that along y [m^2]
NODE_X, NODE_Y, NODE_AREA, NODE_SPREAD, NODE_QUARTER = range(5)
# columns of a group: its rows of patches, its strips
FIRST_ROW, END_ROW, FIRST_STRIP, END_STRIP = range(4)
NO_FACTOR = -1  # of rows that no sliding heats
SHIFT = 19  # bits of a mantissa of 23 that are not the first four
STEP = 1 << SHIFT
PART = np.int32(STEP - 1)
BY_STEP = np.float32(1.0 / STEP)
INSIDE = np.float32(1.0 - 1e-6)  # of the last square, so that one stands behind it
NONE, HALF, TWO, FOUR = (np.float32(k) for k in (0.0, 0.5, 2.0, 4.0))
NINE, FIFTEEN = np.float32(9.0), np.float32(15.0)
COARSE = 4  # squares between which one of those is evaluated that the others are interpolated from
FINE = 16  # squares in a factor of two


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
def refined_pulls(coarse, weights, out):
    """Pulls at all squares, shape (nodes, squares), from a power of two on, by cubics through
    those at each fourth, of which one stands before the first of all and two behind the last;
    weights, shape (4, FINE).
    """
    for n in range(out.shape[0]):
        row = coarse[n]
        for c in range(out.shape[1] // COARSE):
            start = COARSE * (c % (FINE // COARSE))
            for k in range(COARSE):
                own = row[c] * weights[0, start + k] + row[c + 1] * weights[1, start + k]
                own += row[c + 2] * weights[2, start + k] + row[c + 3] * weights[3, start + k]
                out[n, COARSE * c + k] = own


@inlined
def _slide_block(room, node, surface, ends):
    """Sliding of a block's motions at a node, as `sliding_sums_many` has it, and the square of its
    mean between ends; area times that square added up. node: x, y, area, a twelfth of its squared
    size along x and a quarter of that along y.
    """
    x, y, area, spread_x, quarter = node
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
        room[k + SQUARES] += area * square
        room[k + AT_X] = s_x
        most = FIFTEEN * square
        room[k + AT_Y] = s_y * (most - FOUR * change) / (most - NINE * change)
        room[k + PULL] = square


@inlined
def _tabulated_pulls(room, pulls, first):
    """Pull of a node on the motions of a block by its table, whose first square has these bits."""
    for n in range(BLOCK):
        k = np.uint64(n)
        code = bits_of(room[k + PULL])
        place = np.uint64((code >> SHIFT) - first)
        own = pulls[place]
        share = np.float32(code & PART) * BY_STEP
        room[k + PULL] = own + share * (pulls[place + np.uint64(1)] - own)


@inlined
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
def _add_row(room, film, row, surface, ends, first):
    """Add the sums of a block's motions over a row of nodes."""
    nodes, pulls, rows = film
    curvature, width = surface
    for n in range(rows[row, 0], rows[row, 1]):
        x, y = nodes[NODE_X, n], nodes[NODE_Y, n]
        height = curvature * min(y * y, width * width)
        steep = TWO * curvature * y if abs(y) < width else NONE
        node = (x, y, nodes[NODE_AREA, n], nodes[NODE_SPREAD, n], nodes[NODE_QUARTER, n])
        _slide_block(room, node, (height, steep), ends)
        _tabulated_pulls(room, pulls[n], first)
        _add_pulls(room, x, y, height)


@compiled
def _far(room, box, least, surface):
    """True where all motions of a block slide, in the middle of a box, by more than what their
    sliding changes over half of it, squared and times `least`.
    """
    x, half_x, y, half_y = box
    curvature, width = surface
    height = curvature * min(y * y, width * width)
    steep = TWO * curvature * y
    bent = curvature * half_y * half_y
    signs = np.int32(0)
    for n in range(BLOCK):
        k = np.uint64(n)
        spin = room[k + SPIN]
        rolling = room[k + ROLLING]
        s_x = room[k + SLIDE_X] - spin * y - rolling * height
        s_y = room[k + SLIDE_Y] + spin * x
        change_x = abs(spin + rolling * steep) * half_y + abs(rolling) * bent
        change_y = spin * half_x
        change = change_x * change_x + change_y * change_y
        signs |= bits_of(s_x * s_x + s_y * s_y - least * change)
    return signs >= 0


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
    """Add the sums of a row, times its factors by its mean sliding."""
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
def _add_cold(room):
    """Add the sums of a row that no sliding heats."""
    for n in range(BLOCK):
        k = np.uint64(n)
        room[k + ALL_X] += room[k + F_X]
        room[k + ALL_Y] += room[k + F_Y]
        room[k + ALL_N] += room[k + M_N]
        room[k + ALL_R] += room[k + M_Y]


@compiled
def _finish_row(room, heat, row, ends, first, near, own):
    """Multiply the sums of a row by its factors, add them, and begin the next."""
    factors, of_row, by_area = heat
    if of_row[row] == NO_FACTOR:
        _add_cold(room)
    else:
        _add_heated(room, factors[of_row[row]], by_area[row], ends, first, near, own)
    room[F_X:ALL_X] = NONE


@compiled
def _add_group(room, film, tree, group, heat, surface, ends, first, near, own):
    """Add the sums of a block's motions over a group of strips."""
    groups, boxes, strips, least, starts = tree
    hot = heat[0].shape[0] > 0
    low, high = groups[group, FIRST_STRIP], groups[group, END_STRIP]
    whole = low == high or _far(room, boxes[group], least[0], surface)
    if whole:
        low, high = groups[group, FIRST_ROW], groups[group, END_ROW]
    for k in range(low, high):
        row = k
        if not whole:
            row += starts[0] if _far(room, strips[k], least[1], surface) else starts[1]
        _add_row(room, film, row, surface, ends, first)
        if hot:
            _finish_row(room, heat, row, ends, first, near, own)


@compiled
def patch_sums(film, tree, heat, squares, motions, weights, surface, out):
    """Forces and moments on body 1 by sliding for n motions, added to out, shape (n, 4), by pulls
    of `node_pulls`; the numbers of all arrays but out in single precision.

    film: nodes, shape (5, nodes), their pulls, first and last node of each row. tree: groups,
    boxes of groups and of strips, shape (g, 4), the least squares of `_far` of either, the rows
    of the first strip in patches and with all its nodes. heat: factors, shape (K, R, squares), the
    one of each row, one over its area; without heat none. motions: slide_x, slide_y, spin,
    rolling. weights, shape (n, R): of the responses. surface: 1/(2R) and the half width over which
    it counts. Blocks take a group one after the other, as long as its pulls are at hand.
    """
    first = np.int32(bits_of(squares[0]) >> SHIFT)
    ends = (squares[0], squares[squares.size - 1] * INSIDE)
    rooms = np.empty((BLOCKS, ROOM), np.float32)
    near = np.empty((BLOCKS, BLOCK), dtype=np.int64)
    own = np.empty((BLOCKS, NEAREST, BLOCK), np.float32)
    hot = heat[0].shape[0] > 0
    sums = HOT_SUMS if hot else COLD_SUMS
    for start in range(0, motions.shape[1], BLOCKS * BLOCK):
        count = min(BLOCKS * BLOCK, motions.shape[1] - start)
        blocks = (count + BLOCK - 1) // BLOCK
        for b in range(blocks):
            some = _load_block(rooms[b], motions, start + b * BLOCK)
            rooms[b, F_X:] = NONE
            if hot:
                _load_weights(weights, start + b * BLOCK, some, near[b], own[b])
        for g in range(tree[0].shape[0]):
            for b in range(blocks):
                _add_group(rooms[b], film, tree, g, heat, surface, ends, first, near[b], own[b])
        for n in range(count):
            for row in range(4):
                out[start + n, row] += rooms[n // BLOCK, (sums + row) * BLOCK + n % BLOCK]
