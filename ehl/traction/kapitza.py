"""Moment of Kapitza's (1955) pressure ahead of rigid bodies, up to the meniscus of the oil."""

from collections.abc import Callable
from functools import cache
from math import pi

import numpy as np

from ..arrays import Array
from ..conditions import ContactConditions
from .oil_extent import Sections

RAYS = 48  # of a quarter, by Gauss and Legendre [-]
NODES = 48  # of each, in the logarithm of the distance [-]
HALVINGS = 32  # of the interval that holds the meniscus: to 2e-10 of it
NEAREST = 0.03  # of the distance at which the gap is twice the film: what is within is left out


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
    # 1. rays of a quarter from the centre, their gap and the distance of the meniscus
    places, weights = _nodes(RAYS)
    angle = 0.25 * pi * (places + 1.0)
    cosine = np.cos(angle)
    curvature = cosine**2 / c.radius_x + np.sin(angle) ** 2 / c.radius_y
    ball = curvature if c.ball_radius is None else np.full_like(curvature, 1.0 / c.ball_radius)
    bodies = Sections(ball=ball[:, None], race=(curvature - ball)[:, None])
    excess = bodies.excess if circles else _no_excess
    quadratic = curvature[:, None]
    end = _meniscus(film, layer, quadratic, bodies, excess)
    # 2. int K cos^2 r^3/h^2 dr over the rays, in even steps of ln(r)
    start = np.minimum(NEAREST * np.sqrt(2.0 * film / curvature), end)
    steps, shares = _nodes(NODES)
    span = np.log(end / start)[:, None]
    r = start[:, None] * np.exp(0.5 * span * (steps + 1.0))
    radial = np.sum(0.5 * span * shares * r**4 / _gap(film, r, quadratic, excess) ** 2, axis=1)
    strength = 12.0 * c.lubricant.viscosity * c.entrainment_speed
    strength = strength / (3.0 + 2.0 * c.radius_x / c.radius_y)
    return float(2.0 * strength * np.sum(0.25 * pi * weights * cosine**2 * radial))


@cache
def _nodes(count: int) -> tuple[Array, Array]:
    """Gauss and Legendre's places and weights on [-1, 1], shape (count,) each [-]."""
    places, weights = np.polynomial.legendre.leggauss(count)
    return places, weights


Excess = Callable[[Array, float], Array]  # of a gap over the paraboloids' [m]


def _no_excess(r: Array, extent: float) -> Array:
    """Of paraboloids [m]."""
    return np.zeros_like(r)


def _meniscus(
    film: float, layer: float, curvature: Array, bodies: Sections, excess: Excess
) -> Array:
    """Distance along rays [m] at which the gap is as wide as a layer, or the smaller circle
    ends.
    """
    low = np.zeros_like(curvature)
    high = bodies.end
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        narrow = _gap(film, middle, curvature, excess) < layer
        low, high = np.where(narrow, middle, low), np.where(narrow, high, middle)
    return np.asarray(high[:, 0])


def _gap(film: float, r: Array, curvature: Array, excess: Excess) -> Array:
    """Of two bodies at distances (rays, nodes) from the centre [m]."""
    return np.asarray(film + 0.5 * curvature * r**2 + excess(r, 1.0))
