"""Moment of Kapitza's (1955) pressure ahead of rigid bodies, up to the meniscus of the oil."""

from functools import cache
from math import nan

import numpy as np

from ..arrays import Array
from ..conditions import ContactConditions
from ._kapitza_kernels import kapitza_integral

RAYS = 48  # of a quarter, by Gauss and Legendre [-]
NODES = 48  # of each, in the logarithm of the distance [-]


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


@cache
def _nodes(count: int) -> Array:
    """Gauss and Legendre's places and weights on [-1, 1], shape (2, count) [-]."""
    return np.stack(np.polynomial.legendre.leggauss(count))
