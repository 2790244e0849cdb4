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
    conditions: ContactConditions,
    film: float,
    inlet_film_thickness: float | None = None,
    *,
    circles: bool = True,
) -> float:
    """Integrate the moment of Kapitza's pressure of rigid bodies ahead of the centre.

    The pressure is -K x/h^2 with K = 12 eta_0 u/(3 + 2 Rx/Ry), up to the meniscus.

    Parameters
    ----------
    conditions : ContactConditions
        contact with its lubricant
    film : float
        central film [m]
    inlet_film_thickness : float | None, optional
        inlet film thickness that bounds the oil; None: that of the lubricant [m]
    circles : bool, default True
        whether the gap is that of two circles; else of paraboloids

    Returns
    -------
    float
        moment; zero where the film is thicker than the inlet film [N m]
    """
    c = conditions
    inlet_film_thickness = (
        c.lubricant.flooded_layer if inlet_film_thickness is None else inlet_film_thickness
    )
    if film >= inlet_film_thickness:
        return 0.0
    ball = nan if c.ball_radius is None else 1.0 / c.ball_radius
    radii = (c.radius_x, c.radius_y)
    rays, steps = _nodes(RAYS), _nodes(NODES)
    integral = kapitza_integral(film, inlet_film_thickness, radii, ball, circles, rays, steps)
    strength = 12.0 * c.lubricant.viscosity * c.entrainment_speed
    return float(2.0 * strength / (3.0 + 2.0 * c.radius_x / c.radius_y) * integral)


def circles_moment_loss(
    conditions: ContactConditions,
    axes: tuple[float, float],
    film: float,
    inlet_film_thickness: float,
) -> float:
    """Integrate the moment that is lost as the bodies part faster than paraboloids do.

    The pressure is Kapitza's, -K x/h^2, outside Hertz' ellipse, the gap there that of elastic
    bodies over the film: rigid ones lose half as much where the load is high, as their gap opens
    from the centre on.

    Parameters
    ----------
    conditions : ContactConditions
        contact with its lubricant
    axes : tuple[float, float]
        semi-axes of Hertz' ellipse along and across the entrainment [m]
    film : float
        central film [m]
    inlet_film_thickness : float
        inlet film thickness that bounds the oil [m]

    Returns
    -------
    float
        moment [N m]
    """
    c = conditions
    if film >= inlet_film_thickness:
        return 0.0
    ball = nan if c.ball_radius is None else 1.0 / c.ball_radius
    nodes = _nodes(LOSS_NODES)
    reciprocal = (1.0 / c.radius_x, 1.0 / c.radius_y)
    lost = circles_loss(film, inlet_film_thickness, reciprocal, ball, axes, nodes, nodes)
    strength = 12.0 * c.lubricant.viscosity * c.entrainment_speed
    return float(2.0 * LOSS * strength / (3.0 + 2.0 * c.radius_x / c.radius_y) * lost)


@cache
def _nodes(count: int) -> Array:
    """Gauss and Legendre's places and weights on [-1, 1], shape (2, count) [-]."""
    return np.stack(np.polynomial.legendre.leggauss(count))
