"""Compiled kernels of a film's sliding forces at thousands of motions.

The drag of a node, its area times stress, is tabulated over the square of the sliding at the
numbers whose mantissa has its first three bits only: eight in each factor of two. They are read
off the bits of a number, and between them the drag is a straight line: exact where it is limited,
0.05 % below where it goes with the sliding.
"""

import numpy as np

from ...compiled import compiled
from ...oil._rheology_kernels import shear_stress
from .._kernels import AREA, FILM, LIMIT, SPREAD_X, SPREAD_Y, VISCOSITY, X, Y

SHIFT = 49  # bits of a mantissa of 52 that are not the first three
STEP = 1 << SHIFT
INSIDE = 1.0 - 1e-9  # of the last square, so that one stands behind it
CHUNK = 256  # motions at a time, whose numbers stay in the fastest memory


@compiled
def node_drags(nodes, law, squares, out):
    """Area times stress of nodes [N] at squares of the sliding [m^2/s^2], into out of shape
    (nodes, squares); nodes and law as `sliding_sums`.
    """
    for n in range(out.shape[0]):
        area, film = nodes[AREA, n], nodes[FILM, n]
        for k in range(squares.size):
            rate = np.sqrt(squares[k]) / film
            out[n, k] = area * shear_stress(rate, nodes[VISCOSITY, n], nodes[LIMIT, n], *law)


@compiled
def _slidings(node, motions, curvature, ends, s_x, s_y, squares):
    """Sliding along and across at a node of `tabulated_sums` and the square of its root mean
    square over the node, between ends.
    """
    x, y, spread_x, spread_y, height = node
    slide_x, slide_y, spin, rolling = motions
    lowest, highest = ends
    for m in range(slide_x.size):
        along = slide_x[m] - spin[m] * y - rolling[m] * height
        across = slide_y[m] + spin[m] * x
        slope = spin[m] + rolling[m] * curvature
        square = along * along + across * across
        square += slope * slope * spread_y + spin[m] * spin[m] * spread_x
        s_x[m], s_y[m] = along, across
        squares[m] = min(max(square, lowest), highest)


@compiled
def _drags_at(drag, codes, first, low, rise):
    """Tabulated drag below squares of these bits, and its rise from there."""
    for m in range(codes.size):
        k = np.uint64((codes[m] >> SHIFT) - first)
        share = np.float64(codes[m] & (STEP - 1)) * (1.0 / STEP)
        low[m] = drag[k]
        rise[m] = share * (drag[k + np.uint64(1)] - drag[k])


@compiled
def _add_pulls(node, sliding, squares, low, rise, sums):
    """Add a node's share of F_x, F_y, M_n, M_y."""
    x, y, _, _, height = node
    s_x, s_y = sliding
    f_x, f_y, m_n, m_y = sums
    for m in range(s_x.size):
        pull = (low[m] + rise[m]) / np.sqrt(squares[m])
        t_x, t_y = pull * s_x[m], pull * s_y[m]
        f_x[m] -= t_x
        f_y[m] -= t_y
        m_n[m] += y * t_x - x * t_y
        m_y[m] += height * t_x


@compiled
def tabulated_sums(nodes, drags, squares, motions, surface, out):
    """`sliding_sums` for each of n motions, four arrays, added to out of shape (4, n), by drags of
    `node_drags`. (Steps apart, so that the compiler takes several motions at once in most.)
    """
    curvature, width = surface
    first = np.float64(squares[0]).view(np.int64) >> SHIFT
    ends = (squares[0], squares[squares.size - 1] * INSIDE)
    for start in range(0, motions[0].size, CHUNK):
        stop = min(start + CHUNK, motions[0].size)
        slide_x, slide_y, spin, rolling = motions
        own = (slide_x[start:stop], slide_y[start:stop], spin[start:stop], rolling[start:stop])
        s_x, s_y = np.empty(stop - start), np.empty(stop - start)
        means = np.empty(stop - start)
        low, rise = np.empty(stop - start), np.empty(stop - start)
        f_x, f_y, m_n, m_y = out
        sums = (f_x[start:stop], f_y[start:stop], m_n[start:stop], m_y[start:stop])
        for n in range(nodes.shape[1]):
            x, y = nodes[X, n], nodes[Y, n]
            height = curvature * min(y * y, width * width)
            bend = 2.0 * curvature * y if abs(y) < width else 0.0
            node = (x, y, nodes[SPREAD_X, n], nodes[SPREAD_Y, n], height)
            _slidings(node, own, bend, ends, s_x, s_y, means)
            _drags_at(drags[n], means.view(np.int64), first, low, rise)
            _add_pulls(node, (s_x, s_y), means, low, rise, sums)
