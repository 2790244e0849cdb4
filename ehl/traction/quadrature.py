"""Quadratures over an ellipse with Hertz' pressure: places x/a, y/b and shares of the load.

Three rules are in use, each by what it serves. Errors, root of the mean square and largest: of
the force along the rolling direction over mu Q on an ellipse of 1 to 11, at 150 random motions
with slides and spin up to the curvature slip (tests/ehl/traction/test_quadrature.py), and of the
friction power of balls in balance under Coulomb's law in 25 random bearings:

============== ===== =============== ================ ================
rule           nodes Coulomb         four constants   power in balance
============== ===== =============== ================ ================
rings 16 x 32    512 0.0020   0.013  0.0010   0.0039  0.0005    0.0012
lines 48 x 8     384 0.0028   0.0092 0.0008   0.0033  0.0017    0.0032
rings 4 x 12      48 0.011    0.052  0.0095   0.035   0.0025    0.0046
lines 12 x 4      48 0.028    0.089  0.030    0.096
============== ===== =============== ================ ================

Forces at one motion take the rings. The balance of balls, some fifty evaluations of all contacts,
takes the lines, in four fifths of the time: a line meets the step where the sliding along it
changes sign as a whole. A simulation evaluates all contacts at every step and takes the rings of
a tenth of the nodes and of the time; lines of as many are three times worse.
"""

from enum import Enum
from functools import cache

import numpy as np

from ..arrays import Array

# on either side of a line of pure rolling, where balls do not spin (`straight_friction`)
STRAIGHT_NODES = 6


class EllipseRule(Enum):
    """Quadratures by what they serve; why each has its nodes stands above."""

    FORCES = "rings 16 x 32"  # of one contact at a given motion
    BALANCE = "lines 48 x 8"  # of Coulomb friction on balls
    TIME_STEPS = "rings 4 x 12, staggered"  # of a simulation


@cache
def ellipse_nodes(rule: EllipseRule) -> Array:
    """Give the nodes of a rule over the ellipse of Hertz.

    Parameters
    ----------
    rule : EllipseRule
        purpose of the quadrature

    Returns
    -------
    Array
        x/a, y/b and fraction of the load of each node, shape (3, n) [-]
    """
    if rule is EllipseRule.FORCES:
        return ellipse_rings(16, 32)
    if rule is EllipseRule.BALANCE:
        return ellipse_lines(48, 8)
    return ellipse_rings(4, 12, staggered=True)


def ellipse_rings(rings: int, rays: int, *, staggered: bool = False) -> Array:
    """Place nodes on rings over the ellipse of Hertz.

    Gauss-Legendre in the fraction of the load outside a radius, t = (1 - r^2)^(3/2), evenly
    spaced around.

    Parameters
    ----------
    rings : int
        number of rings [-]
    rays : int
        nodes on each ring [-]
    staggered : bool, default False
        whether each ring is rotated by half a step against the next

    Returns
    -------
    Array
        x/a, y/b and fraction of the load of each node, shape (3, rings * rays) [-]
    """
    nodes, weights = np.polynomial.legendre.leggauss(rings)
    radius = np.sqrt(1.0 - (0.5 * (nodes + 1.0)) ** (2.0 / 3.0))[:, None]
    turn = 0.5 * (np.arange(rings) % 2)[:, None] + 0.25 if staggered else np.full((rings, 1), 0.5)
    angle = 2.0 * np.pi * (np.arange(rays) + turn) / rays
    fraction = np.repeat(0.5 * weights / rays, rays)
    return np.stack([(radius * np.cos(angle)).ravel(), (radius * np.sin(angle)).ravel(), fraction])


def ellipse_lines(lines: int, nodes: int) -> Array:
    """Place nodes on lines along x over the ellipse of Hertz.

    Gauss-Legendre across; along each line Gauss-Chebyshev of the second kind, whose weight is
    Hertz' pressure.

    Parameters
    ----------
    lines : int
        number of lines [-]
    nodes : int
        nodes on each line [-]

    Returns
    -------
    Array
        x/a, y/b and fraction of the load of each node, shape (3, lines * nodes) [-]
    """
    y, across = np.polynomial.legendre.leggauss(lines)
    angle = np.pi * (np.arange(nodes) + 1.0) / (nodes + 1.0)
    along = 2.0 / (nodes + 1.0) * np.sin(angle) ** 2
    x = np.sqrt(1.0 - y**2)[:, None] * np.cos(angle)
    fraction = 0.75 * ((1.0 - y**2) * across)[:, None] * along
    return np.stack([x.ravel(), np.repeat(y, nodes), fraction.ravel()])


def unit_gauss(nodes: int) -> Array:
    """Give nodes and weights of Gauss and Legendre on [0, 1].

    Parameters
    ----------
    nodes : int
        number of nodes [-]

    Returns
    -------
    Array
        nodes and weights, shape (2, nodes) [-]
    """
    positions, weights = np.polynomial.legendre.leggauss(nodes)
    return np.stack([0.5 * (positions + 1.0), 0.5 * weights])
