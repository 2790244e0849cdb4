"""Quadratures over an ellipse with Hertz' pressure: places x/a, y/b and shares of the load.

The arguments set the accuracy. Error of the force of Coulomb friction along the rolling direction
over mu Q, on an ellipse of 1 to 11 with curvature slip and spin at 150 random motions, root of the
mean square and largest:

============================== ===== ====== =======
rule                           nodes rms    largest
============================== ===== ====== =======
rings 16 x 32                    512 0.0053   0.032
rings 4 x 12, staggered           48 0.022    0.085
lines 48 x 8                     384 0.015    0.072
lines 12 x 4                      48 0.080    0.27
============================== ===== ====== =======

The coefficient of four constants, which has no step at rest, is off by 2e-5 with rings of 16 x 32
or lines of 48 x 8. A line meets the step where the sliding along it changes sign as a whole, the
nodes of a ring one by one.
"""

from enum import Enum
from functools import cache

import numpy as np

from ..arrays import Array


class EllipseRule(Enum):
    """Quadratures by what they serve; why each has its nodes stands above."""

    FORCES = "rings 16 x 32"  # of one contact at a given motion
    BALANCE = "lines 48 x 8"  # of Coulomb friction on balls
    TIME_STEPS = "rings 4 x 12, staggered"  # of a simulation


@cache
def ellipse_nodes(rule: EllipseRule) -> Array:
    """x/a, y/b and share of the load of a rule's nodes, shape (3, n) [-]."""
    if rule is EllipseRule.FORCES:
        return ellipse_rings(16, 32)
    if rule is EllipseRule.BALANCE:
        return ellipse_lines(48, 8)
    return ellipse_rings(4, 12, staggered=True)


def ellipse_rings(rings: int, rays: int, *, staggered: bool = False) -> Array:
    """x/a, y/b and share of the load of nodes on rings, shape (3, rings * rays) [-].

    Gauss-Legendre in the share of the load outside a radius, t = (1 - r^2)^(3/2), evenly spaced
    around; staggered: each ring turned by half a step against the next.
    """
    nodes, weights = np.polynomial.legendre.leggauss(rings)
    radius = np.sqrt(1.0 - (0.5 * (nodes + 1.0)) ** (2.0 / 3.0))[:, None]
    turn = 0.5 * (np.arange(rings) % 2)[:, None] + 0.25 if staggered else np.full((rings, 1), 0.5)
    angle = 2.0 * np.pi * (np.arange(rays) + turn) / rays
    share = np.repeat(0.5 * weights / rays, rays)
    return np.stack([(radius * np.cos(angle)).ravel(), (radius * np.sin(angle)).ravel(), share])


def ellipse_lines(lines: int, nodes: int) -> Array:
    """x/a, y/b and share of the load of nodes on lines along x, shape (3, lines * nodes) [-].

    Gauss-Legendre across; along each line Gauss-Chebyshev of the second kind, whose weight is
    Hertz' pressure.
    """
    y, across = np.polynomial.legendre.leggauss(lines)
    angle = np.pi * (np.arange(nodes) + 1.0) / (nodes + 1.0)
    along = 2.0 / (nodes + 1.0) * np.sin(angle) ** 2
    x = np.sqrt(1.0 - y**2)[:, None] * np.cos(angle)
    share = 0.75 * ((1.0 - y**2) * across)[:, None] * along
    return np.stack([x.ravel(), np.repeat(y, nodes), share.ravel()])
