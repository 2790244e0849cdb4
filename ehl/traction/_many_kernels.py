"""Compiled kernels of a film's sliding forces at thousands of motions.

The drag of a node, its area times stress, is tabulated over the square of the sliding at the
numbers whose mantissa has its first three bits only: eight in each factor of two. They are read
off the bits of a number, and between them the drag is a straight line: exact where it is limited,
0.05 % below where it goes with the sliding.
"""

import numpy as np

from ..compiled import compiled
from ..oil._rheology_kernels import shear_stress
from ._block_kernels import (
    BLOCK,
    F_X,
    PULL,
    ROOM,
    SLIDE,
    add_block,
    add_pulls,
    load_block,
    slide_block,
)
from ._kernels import AREA, FILM, LIMIT, SPREAD_X, SPREAD_Y, VISCOSITY, X, Y

SHIFT = 49  # bits of a mantissa of 52 that are not the first three
STEP = 1 << SHIFT
INSIDE = 1.0 - 1e-9  # of the last square, so that one stands behind it


@compiled
def node_drags(nodes, law, squares, out):
    """Area times stress of nodes [N] at squares of the sliding [m^2/s^2], into out of shape
    (nodes, squares); nodes and law as `block_sums`.
    """
    for n in range(out.shape[0]):
        area, film = nodes[AREA, n], nodes[FILM, n]
        for k in range(squares.size):
            rate = np.sqrt(squares[k]) / film
            out[n, k] = area * shear_stress(rate, nodes[VISCOSITY, n], nodes[LIMIT, n], *law)


@compiled
def _tabulated_pulls(room, drag, first, ends):
    """Pull of a node on the motions of a block by its tabulated drag, the sliding between ends."""
    lowest, highest = ends
    for n in range(BLOCK):
        k = np.uint64(n)
        slide = min(max(room[k + np.uint64(SLIDE)], lowest), highest)
        room[k + np.uint64(SLIDE)] = slide
        room[k + np.uint64(PULL)] = slide * slide
    codes = room[PULL : PULL + BLOCK].view(np.int64)
    for n in range(BLOCK):
        k = np.uint64(n)
        code = codes[k]
        place = np.uint64((code >> SHIFT) - first)
        share = np.float64(code & (STEP - 1)) * (1.0 / STEP)
        own = drag[place] + share * (drag[place + np.uint64(1)] - drag[place])
        room[k + np.uint64(PULL)] = own / room[k + np.uint64(SLIDE)]


@compiled
def tabulated_block(nodes, drags, squares, surface, room):
    """`block_sums` by drags of `node_drags` at these squares."""
    room[F_X:ROOM] = 0.0
    curvature, width = surface
    first = np.float64(squares[0]).view(np.int64) >> SHIFT
    ends = (np.sqrt(squares[0] / INSIDE), np.sqrt(squares[squares.size - 1] * INSIDE))
    for n in range(nodes.shape[1]):
        x, y = nodes[X, n], nodes[Y, n]
        spreads = (nodes[SPREAD_X, n], nodes[SPREAD_Y, n])
        slide_block(room, (x, y, nodes[AREA, n], *spreads), surface)
        _tabulated_pulls(room, drags[n], first, ends)
        add_pulls(room, x, y, curvature * min(y * y, width * width))


@compiled
def tabulated_sums(nodes, drags, squares, motions, surface, out):
    """`sliding_sums_many` by drags of `node_drags`."""
    room = np.empty(ROOM)
    for start in range(0, motions[0].size, BLOCK):
        count = load_block(motions, start, room)
        tabulated_block(nodes, drags, squares, surface, room)
        add_block(room, start, count, out)
