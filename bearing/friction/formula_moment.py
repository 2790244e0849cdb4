r"""Moment that resists rolling in a flooded, isothermal contact, by formulas.

A light contact hardly changes the gap of the bodies, h_0 + x^2/(2 Rx) + y^2/(2 Ry): there
Kapitza's (1955) pressure -K x/h^2, K = 12 eta_0 u/(3 + 2 Rx/Ry), is the solution. Its moment up to
the meniscus, where the gap is as wide as the layer that floods the contact, goes to zero as the
film goes to that layer. Under heavy loads Biboulet and Houpert's (2010) formula holds, which knows
no layer and does not vanish with the contact. Both together, with M_0 = 24 pi eta_0 u Rx^2/((3 + 2
Rx/Ry) sqrt(Rx/Ry)),

    M = M_Kapitza + M_0 f(M_Biboulet/M_0),   f(e) = (z + sqrt(z^2 + w^2))/2,   z = s e - t,

f fitted to solved contacts (`SLOPE`, `START`, `WIDTH`).
"""

from math import pi, sqrt

import numpy as np

from ehl.conditions import ContactConditions
from ehl.traction.oil_extent import Sections

from ..geometry import Array
from .resistance import rolling_moment

RAYS = 48  # of a quarter, by Gauss and Legendre [-]
NODES = 48  # of each, in the logarithm of the distance [-]
HALVINGS = 50  # of the interval that holds the meniscus
# Fitted to 275 solved contacts, M 1 to 3000, L 5 to 29, Rx/Ry 0.02 to 1, layers of 50, 100 and 400
# um: s and t over Rx/Ry, linear, and w [-]
SLOPE = (0.903, -0.230)
START = (0.984, -0.280)
WIDTH = 0.06
NEAREST = 0.03  # of the distance at which the gap is twice the film: what is within is left out


def flooded_moment(
    conditions: ContactConditions, semi_axis_y: float, semi_axis_x: float, film: float
) -> float:
    """Moment that resists rolling [N m] of a central film, with the Hertz semi-axes across and
    along rolling [m].
    """
    kapitza = kapitza_moment(conditions, film)
    unit = _unit(conditions)
    heavy = rolling_moment(conditions, semi_axis_y, semi_axis_x) / unit
    return kapitza + unit * _beyond(heavy, conditions.radius_x / conditions.radius_y)


def kapitza_moment(conditions: ContactConditions, film: float) -> float:
    """Of Kapitza's pressure ahead of the centre of rigid bodies at a film [m], up to the meniscus
    of the flooded layer in the gap of two circles [N m]; zero where the film is thicker.
    """
    c = conditions
    layer = c.lubricant.flooded_layer
    if film >= layer:
        return 0.0
    # 1. rays of a quarter from the centre, their gap and the distance of the meniscus
    places, weights = np.polynomial.legendre.leggauss(RAYS)
    angle = 0.25 * pi * (places + 1.0)
    cosine = np.cos(angle)
    curvature = cosine**2 / c.radius_x + np.sin(angle) ** 2 / c.radius_y
    ball = curvature if c.ball_radius is None else np.full_like(curvature, 1.0 / c.ball_radius)
    bodies = Sections(ball=ball[:, None], race=(curvature - ball)[:, None])
    quadratic = curvature[:, None]
    end = _meniscus(film, layer, quadratic, bodies)
    # 2. int K cos^2 r^3/h^2 dr over the rays, in even steps of ln(r)
    start = np.minimum(NEAREST * np.sqrt(2.0 * film / curvature), end)
    steps, shares = np.polynomial.legendre.leggauss(NODES)
    span = np.log(end / start)[:, None]
    r = start[:, None] * np.exp(0.5 * span * (steps + 1.0))
    radial = np.sum(0.5 * span * shares * r**4 / _gap(film, r, quadratic, bodies) ** 2, axis=1)
    strength = 12.0 * c.lubricant.viscosity * c.entrainment_speed
    strength = strength / (3.0 + 2.0 * c.radius_x / c.radius_y)
    return float(2.0 * strength * np.sum(0.25 * pi * weights * cosine**2 * radial))


def _meniscus(film: float, layer: float, curvature: Array, bodies: Sections) -> Array:
    """Distance along rays [m] at which the gap is as wide as a layer, or the smaller circle
    ends.
    """
    low = np.zeros_like(curvature)
    high = bodies.end
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        narrow = _gap(film, middle, curvature, bodies) < layer
        low, high = np.where(narrow, middle, low), np.where(narrow, high, middle)
    return np.asarray(high[:, 0])


def _gap(film: float, r: Array, curvature: Array, bodies: Sections) -> Array:
    """Of two circles at distances (rays, nodes) from the centre [m]."""
    return np.asarray(film + 0.5 * curvature * r**2 + bodies.excess(r, 1.0))


def _beyond(heavy: float, ratio: float) -> float:
    """f of M_Biboulet/M_0, Rx/Ry `ratio` [-]."""
    z = (SLOPE[0] + SLOPE[1] * ratio) * heavy - (START[0] + START[1] * ratio)
    return 0.5 * (z + sqrt(z**2 + WIDTH**2))


def _unit(conditions: ContactConditions) -> float:
    """M_0 [N m]."""
    c = conditions
    ratio = c.radius_x / c.radius_y
    shape = (3.0 + 2.0 * ratio) * sqrt(ratio)
    return 24.0 * pi * c.lubricant.viscosity * c.entrainment_speed * c.radius_x**2 / shape
