"""Moment of Kapitza's (1955) pressure ahead of two bodies, up to the meniscus of the oil."""

from functools import cache
from math import nan

import numpy as np

from ..arrays import Array
from ..conditions import ContactConditions
from ._kapitza_kernels import circles_loss, kapitza_integral

RAYS = 48  # of a quarter, by Gauss and Legendre [-]
NODES = 48  # of each, in the logarithm of the distance [-]
# rays and nodes of what circles lose; 48 and 96 change it by up to 8 %, of the moment by 0.5 %
LOSS_NODES = 24
# solved over this loss: fitted to 24 contacts, `python tools/atlas/circles.py 20261126 24`, as the
# gap along a ray is not that of a circular contact [-]
LOSS = 1.1


def kapitza_moment(
    conditions: ContactConditions, film: float, layer: float | None = None, *, circles: bool = True
) -> float:
    """Of the pressure -K x/h^2, K = 12 eta_0 u/(3 + 2 Rx/Ry), ahead of the centre at a film [m],
    up to the meniscus of the flooded layer, or another one [m], in the gap of two circles, or of
    paraboloids [N m]; zero where the film is thicker.
    """
    c = conditions
    layer = c.lubricant.flooded_layer if layer is None else layer
    if film >= layer:
        return 0.0
    ball = nan if c.ball_radius is None else 1.0 / c.ball_radius
    radii = (c.radius_x, c.radius_y)
    rays, steps = _nodes(RAYS), _nodes(NODES)
    integral = kapitza_integral(film, layer, radii, ball, circles, rays, steps)
    strength = 12.0 * c.lubricant.viscosity * c.entrainment_speed
    return float(2.0 * strength / (3.0 + 2.0 * c.radius_x / c.radius_y) * integral)


def moment_lost_by_circles(
    conditions: ContactConditions, axes: tuple[float, float], film: float, layer: float
) -> float:
    """What the moment up to a layer loses as the bodies part faster than paraboloids do [N m].

    The pressure is Kapitza's, -K x/h^2, outside Hertz' ellipse with semi-axes `axes` [m], the gap
    there that of elastic bodies over the film [m]: rigid ones lose half as much where the load is
    high, as their gap opens from the centre on.
    """
    c = conditions
    if film >= layer:
        return 0.0
    ball = nan if c.ball_radius is None else 1.0 / c.ball_radius
    nodes = _nodes(LOSS_NODES)
    reciprocal = (1.0 / c.radius_x, 1.0 / c.radius_y)
    lost = circles_loss(film, layer, reciprocal, ball, axes, nodes, nodes)
    strength = 12.0 * c.lubricant.viscosity * c.entrainment_speed
    return float(2.0 * LOSS * strength / (3.0 + 2.0 * c.radius_x / c.radius_y) * lost)


@cache
def _nodes(count: int) -> Array:
    """Gauss and Legendre's places and weights on [-1, 1], shape (2, count) [-]."""
    return np.stack(np.polynomial.legendre.leggauss(count))
