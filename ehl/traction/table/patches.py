"""Patches of a film, whose sliding is taken at few places, for sums at thousands of motions.

Where a motion slides much more than its sliding s(x, y) changes over a group of nodes, s is a
smooth function there, and so is the traction tau_n(|s|) s/|s| of each node n: interpolated between
few places j by polynomials l_j, the sum over the group is

    sum_n A_n tau_n(s(x_n)) s(x_n)/|s(x_n)| = sum_j P_j(s(x_j)) s(x_j),
    P_j(s) = sum_n l_j(x_n) A_n tau_n(s)/s,

exact where s is the same all over the group, whatever the oil of its nodes. Where a motion slides
little beside that change, at the pole of spin or where curvature slip turns, all nodes count. The
places are Gauss' along the strips and across groups of them.

Nodes of low pressure shear an oil that is nearly Newtonian, whose traction is a polynomial of the
place wherever it slides: they have patches on either side of the ellipse and beside it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from ...arrays import Array, lagrange_weights
from .._kernels import AREA, SPREAD_X, SPREAD_Y, X, Y

Float32Array = NDArray[np.float32]
Integers = NDArray[np.int64]
# numbers of 96 strips in groups, from edge to edge: few towards the edges, where strips are wide
# and the oil's viscosity changes most
GROUPS = (4, 4, 8, 8, 12, 12, 12, 12, 8, 8, 4, 4)
ALONG = 3  # places along the strips of a group
ACROSS = 3  # across them
STRIP_POINTS = 6  # along a strip alone
# sliding in the middle over its change from there to the end of a group and of a strip, from which
# on patches count; by trial, so that no force changes by more than 0.06 % of the largest
MIN_SLIDING_RATIO = (5.0, 1.0)
# pull of a node at the largest change of sliding over the film, over that at rest, from which on
# its oil is nearly Newtonian
NEARLY_NEWTONIAN = 0.8
LOW_ALONG = 4  # places along x of patches of low pressure, which reach far behind the contact
LOW_ACROSS = (3, 5, 3)  # across, of those beyond the ellipse on one side, beside it, on the other


@dataclass(frozen=True, slots=True, kw_only=True)
class NodeClusters:
    """Nodes of patches and of strips, and their pulls, as `_many_kernels.patch_sums` takes them.

    Its rows of nodes: the patches of each group, nodes of low pressure, strips in few patches,
    strips with all nodes.
    """

    nodes: Array  # shape (5, n), rows as `_many_kernels` names them
    shear_per_sliding: Float32Array  # shape (n, slides) [N s/m]
    rows: Integers  # first and last node, shape (rows, 2)
    groups: Integers  # columns as `_many_kernels` names them, shape (groups, 4)
    boxes: Array  # of the groups: middle and half size along x, across, shape (groups, 4) [m]
    strips: Array  # of the strips, shape (K, 4) [m]
    starts: tuple[int, int]  # rows of the first strip, in patches and with all nodes
    shares: Array  # of the strips in each of the first rows, shape (rows of groups, K) [-]


class _Rows:
    """Rows of nodes as they are collected."""

    def __init__(self) -> None:
        self.nodes: list[Array] = []
        self.shear_per_sliding: list[Float32Array] = []
        self.ends = [0]

    @property
    def count(self) -> int:
        """Number of the rows."""
        return len(self.ends) - 1

    def add(self, columns: Sequence[Array | float], shear_per_sliding: Float32Array) -> None:
        """Rows of as many nodes each, pulls of shape (rows, nodes, slides), columns of shapes that
        fit the first two.
        """
        rows, each = shear_per_sliding.shape[:2]
        nodes = np.empty((5, rows, each))
        for k, column in enumerate(columns):
            nodes[k] = column
        self.nodes.append(nodes.reshape(5, -1))
        self.shear_per_sliding.append(
            shear_per_sliding.reshape(rows * each, shear_per_sliding.shape[2])
        )
        self.ends += [self.ends[-1] + each * (k + 1) for k in range(rows)]


def node_clusters(
    strips: tuple[Array, Float32Array],
    low: tuple[Array, Float32Array],
    half_width: float,
    changed: int,
) -> NodeClusters:
    """Cluster the nodes of a film, whose sliding is evaluated at few points.

    Parameters
    ----------
    strips : tuple[Array, Float32Array]
        nodes as `FilmQuadrature.nodes`, shape (8, K, N), each strip from one edge to the other,
        and their shear per sliding, shape (K, N, slides) [N s/m]
    low : tuple[Array, Float32Array]
        nodes of low pressure, shape (8, n), and their shear per sliding, shape (n, slides) [N s/m]
    half_width : float
        transverse semi-axis of the ellipse [m]
    changed : int
        index of the largest change of sliding [-]

    Returns
    -------
    NodeClusters
        clusters and strips for the kernel
    """
    rows = _Rows()
    count = strips[0].shape[1]
    groups, boxes, shares = _add_groups(rows, *strips) if count else ([], [], [])
    first = rows.count
    _add_low(rows, *low, half_width, changed)
    groups.append((first, rows.count, 0, 0))
    boxes.append((0.0, 0.0, 0.0, 0.0))
    starts = _add_strips(rows, *strips)
    return NodeClusters(
        nodes=np.concatenate(rows.nodes, axis=1),
        shear_per_sliding=np.concatenate(rows.shear_per_sliding),
        rows=np.stack([rows.ends[:-1], rows.ends[1:]], axis=1),
        groups=np.array(groups),
        boxes=np.array(boxes),
        strips=_strip_boxes(strips[0]),
        starts=starts,
        shares=np.concatenate(shares) if count else np.empty((0, 0)),
    )


@cache
def _gauss_nodes(count: int) -> Array:
    """Places of Gauss' rule between -1 and 1 [-]."""
    return np.asarray(np.polynomial.legendre.leggauss(count)[0])


def _gauss(low: float, high: float, count: int) -> Array:
    """Places of Gauss' rule between two ends [same unit]."""
    return np.asarray(0.5 * (low + high) + 0.5 * (high - low) * _gauss_nodes(count))


def _weights(places: Array, nodes: Array) -> Array:
    """Lagrange's weights of n places at nodes, shape (nodes, n) [-]."""
    known = np.broadcast_to(places, (nodes.size, places.size))
    return lagrange_weights(known, nodes)


def _along(nodes: Array, count: int) -> tuple[Array, Array]:
    """Places on strips as shares from their first node to their last, shape (count,), and the
    weights of these at the nodes, shape (N, count) [-]; nodes stand alike on all strips.
    """
    x = nodes[X, nodes.shape[1] // 2]
    fractions = _gauss(0.0, 1.0, count)
    return fractions, _weights(fractions, (x - x[0]) / (x[-1] - x[0]))


def _add_groups(
    rows: _Rows, nodes: Array, shear_per_sliding: Float32Array
) -> tuple[list[tuple[int, ...]], list[tuple[float, ...]], list[Array]]:
    """Rows of the patches of groups; the groups, their boxes, and shares of strips in rows."""
    parts, along = _along(nodes, ALONG)
    summed = along.T.astype(np.float32) @ shear_per_sliding
    area = nodes[AREA] @ along
    y = nodes[Y, :, 0]
    first = nodes[X, :, 0]
    last = nodes[X, :, -1]
    groups: list[tuple[int, ...]] = []
    boxes: list[tuple[float, ...]] = []
    fractions: list[Array] = []
    ends = np.rint(np.cumsum(GROUPS) * (y.size / sum(GROUPS))).astype(int)
    for members in np.split(np.arange(y.size), ends[:-1]):
        few = members.size <= ACROSS + 1
        positions = y[members] if few else _gauss(y[members[0]], y[members[-1]], ACROSS)
        across = _weights(positions, y[members])
        start = rows.count
        spread = (nodes[SPREAD_X, members].mean(), 3.0 * nodes[SPREAD_Y, members].mean())
        edge, end = (np.interp(positions, y, ends_of)[:, None] for ends_of in (first, last))
        columns = (
            edge + (end - edge) * parts,
            positions[:, None],
            across.T @ area[members],
            *spread,
        )
        flat = across.T.astype(np.float32) @ summed[members].reshape(members.size, -1)
        rows.add(columns, flat.reshape(positions.size, *summed.shape[1:]))
        fraction = np.zeros((positions.size, y.size))
        fraction[:, members] = across.T
        fractions.append(fraction)
        groups.append((start, rows.count, int(members[0]), int(members[-1]) + 1))
        low = np.array([first[members].min(), y[members[0]]])
        high = np.array([last[members].max(), y[members[-1]]])
        boxes.append(tuple(np.stack([0.5 * (low + high), 0.5 * (high - low)], axis=1).ravel()))
    return groups, boxes, fractions


def _add_strips(rows: _Rows, nodes: Array, shear_per_sliding: Float32Array) -> tuple[int, int]:
    """Rows of strips in few patches and with all nodes, and the first row of either."""
    first = rows.count
    count = nodes.shape[1]
    if not count:
        return first, first
    fractions, along = _along(nodes, STRIP_POINTS)
    x = nodes[X]
    y = nodes[Y, :, :1]
    spread = (nodes[SPREAD_X].mean(axis=1)[:, None], 3.0 * nodes[SPREAD_Y, :, :1])
    columns = (x[:, :1] + (x[:, -1:] - x[:, :1]) * fractions, y, nodes[AREA] @ along, *spread)
    rows.add(columns, along.T.astype(np.float32) @ shear_per_sliding)
    rows.add(_columns(nodes), shear_per_sliding)
    return first, first + count


def _columns(nodes: Array) -> tuple[Array, ...]:
    """Give the columns of nodes as they are, shape (8, ...)."""
    return nodes[X], nodes[Y], nodes[AREA], nodes[SPREAD_X], 3.0 * nodes[SPREAD_Y]


def _strip_boxes(nodes: Array) -> Array:
    """Middle and half size along x, across, of strips, whose own sliding is a mean across."""
    first = nodes[X, :, 0]
    last = nodes[X, :, -1]
    y = nodes[Y, :, 0]
    return np.stack([0.5 * (first + last), 0.5 * (last - first), y, np.zeros_like(y)], axis=1)


def _add_low(
    rows: _Rows, nodes: Array, shear_per_sliding: Float32Array, half_width: float, changed: int
) -> None:
    """Rows of nodes of low pressure: patches of those that are nearly Newtonian, the others."""
    plain = shear_per_sliding[:, changed] >= NEARLY_NEWTONIAN * shear_per_sliding[:, 0]
    beside = np.sign(nodes[Y]) * (np.abs(nodes[Y]) >= half_width)
    alone = ~plain
    for side, across in zip((-1, 0, 1), LOW_ACROSS, strict=True):
        members = np.flatnonzero(plain & (beside == side))
        x, y = nodes[X, members], nodes[Y, members]
        if members.size <= LOW_ALONG * across or np.ptp(y) == 0.0:
            alone[members] = True
            continue
        along = _gauss(x.min(), x.max(), LOW_ALONG)
        weights_x = _weights(along, x)
        spread = (nodes[SPREAD_X, members].mean(), 3.0 * nodes[SPREAD_Y, members].mean())
        positions = _gauss(y.min(), y.max(), across)
        weights = _weights(positions, y)[:, :, None] * weights_x[:, None, :]
        flat = weights.reshape(members.size, -1).T
        area = (flat @ nodes[AREA, members]).reshape(weights.shape[1:])
        summed = flat.astype(np.float32) @ shear_per_sliding[members]
        rows.add(
            (along, positions[:, None], area, *spread), summed.reshape(*weights.shape[1:], -1)
        )
    rows.add(_columns(nodes[:, None, alone]), shear_per_sliding[None, alone])
