"""Moment of Kapitza's (1955) pressure ahead of rigid bodies in NumPy, twin of the kernel of `ehl.traction.kapitza`."""

from functools import cache
from math import pi

import numpy as np

from ehl.arrays import Array
from ehl.conditions import ContactConditions
from ehl.traction.oil_extent import Sections

RAYS = 48  # of a quarter, by Gauss and Legendre [-]
NODES = 48  # of each, in the logarithm of the distance [-]
NEWTON_STEPS = 60  # most of them for the meniscus: 5 to 9 are taken
LAST_STEP = 1e-6  # of the square of its distance, after which a step of second order is exact
NEAREST = 0.03  # of the distance at which the gap is twice the film: what is within is left out


def kapitza_moment_twin(
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
    end = np.minimum(np.sqrt(2.0 * (layer - film) / curvature), bodies.end[:, 0])
    if circles:
        end = _meniscus(film, layer, bodies)[:, 0]
    # 2. int K cos^2 r^3/h^2 dr over the rays, in even steps of ln(r)
    start = np.minimum(NEAREST * np.sqrt(2.0 * film / curvature), end)
    steps, shares = _nodes(NODES)
    span = np.log(end / start)[:, None]
    r = start[:, None] * np.exp(0.5 * span * (steps + 1.0))
    gap = film + (bodies.gap(r) if circles else 0.5 * curvature[:, None] * r**2)
    radial = np.sum(0.5 * span * shares * r**4 / gap**2, axis=1)
    strength = 12.0 * c.lubricant.viscosity * c.entrainment_speed
    strength = strength / (3.0 + 2.0 * c.radius_x / c.radius_y)
    return float(2.0 * strength * np.sum(0.25 * pi * weights * cosine**2 * radial))


@cache
def _nodes(count: int) -> tuple[Array, Array]:
    """Gauss and Legendre's places and weights on [-1, 1], shape (count,) each [-]."""
    places, weights = np.polynomial.legendre.leggauss(count)
    return places, weights


def _meniscus(film: float, layer: float, bodies: Sections) -> Array:
    """Distance along rays [m] at which the gap of two circles is as wide as a layer, or the
    smaller circle ends: Newton's method in the square of the distance, by which the gap is convex,
    kept inside a bracket.
    """
    low = np.zeros_like(bodies.end)
    high = bodies.end**2
    opens = film + bodies.gap(bodies.end) > layer
    square = np.minimum(2.0 * (layer - film) / (bodies.ball + bodies.race), 0.5 * high)
    for _ in range(NEWTON_STEPS):
        r = np.sqrt(square)
        excess = film + bodies.gap(r) - layer
        low = np.where(excess < 0.0, square, low)
        high = np.where(excess < 0.0, high, square)
        step = -excess / _rise(bodies, r)
        inside = (square + step >= low) & (square + step <= high)
        square = np.where(inside, square + step, 0.5 * (low + high))
        if np.all((np.abs(step) <= LAST_STEP * square) | ~opens):
            break
    return np.where(opens, np.sqrt(square), bodies.end)


def _rise(bodies: Sections, r: Array) -> Array:
    """Derivative of the gap by the square of the distance [-]."""
    ball, race = (c / np.sqrt(1.0 - (c * r) ** 2) for c in bodies)
    return np.asarray(0.5 * (ball + race))
