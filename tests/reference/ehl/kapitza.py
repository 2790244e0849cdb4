"""Moment of Kapitza's (1955) pressure ahead of two bodies in NumPy.

Twin of the kernels of `oilfilm.ehl.traction.rolling_moment`.
"""

from functools import cache
from math import acos, pi, sqrt

import numpy as np

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.conditions import ContactConditions
from oilfilm.ehl.traction.rolling_moment import Sections

RAYS = 48  # of a quarter, by Gauss and Legendre [-]
NODES = 48  # of each, in the logarithm of the distance [-]
NEWTON_STEPS = 60  # most of them for the meniscus: 5 to 9 are taken
LAST_STEP = 1e-6  # of the square of its distance, after which a step of second order is exact
INLET_GAP, PARABOLA_SHARE, LOSS = 0.04, 0.2, 1.1  # as in `oilfilm.ehl.traction.rolling_moment` and its kernels
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


def circles_loss_twin(conditions: ContactConditions, axes: tuple[float, float], film: float, layer: float) -> float:
    """What elastic bodies lose as circles, by even steps in place of Gauss and halvings."""
    c, (a, b) = conditions, axes
    reciprocal = (1.0 / c.radius_x, 1.0 / c.radius_y)
    ball = 1.0 / c.ball_radius
    least = min(INLET_GAP * a**2 * reciprocal[0], layer - film)

    def excess(race: float, r: float) -> float:
        if max(ball, abs(race)) * r <= PARABOLA_SHARE:
            return 0.0
        return sum((1.0 - sqrt(max(1.0 - (k * r) ** 2, 0.0))) / k - 0.5 * k * r * r for k in (ball, race))

    lost = 0.0
    for angle, weight in zip(*(_nodes(RAYS)), strict=True):
        cosine, sine = np.cos(0.25 * pi * (angle + 1.0)), np.sin(0.25 * pi * (angle + 1.0))
        edge = 1.0 / np.hypot(cosine / a, sine / b)
        curvature = cosine**2 * reciprocal[0] + sine**2 * reciprocal[1]

        def gap(r: float, circles: bool, ray: tuple[float, ...] = (cosine, sine, edge, curvature)) -> float:
            along, across, rim, bend = ray
            q = max(r / rim, 1.0)
            own = bend * rim**2 * ((q * q - 2.0) * acos(1.0 / q) + sqrt(q * q - 1.0)) / pi
            if not circles:
                return own
            y = min(r * across, b)
            x = min(r * along, a * sqrt(1.0 - (y / b) ** 2))
            near = (x * x * reciprocal[0] + y * y * reciprocal[1]) / (x * x + y * y)
            return own + excess(bend - ball, r) - excess(near - ball, np.hypot(x, y))

        far = edge + np.sqrt(2.0 * layer / curvature)
        start = edge * (1.0 + (3.0 * pi / (8.0 * sqrt(2.0)) * least / (curvature * edge**2)) ** (2.0 / 3.0))
        for circles, sign in ((False, 1.0), (True, -1.0)):
            end = min(far, (1.0 - 1e-9) / max(ball, abs(curvature - ball))) if circles else far
            wide = np.linspace(start, end, 1501)
            open_ = [r for r in wide if gap(r, circles) < layer - film]
            r = np.geomspace(start, open_[-1], 250)
            values = np.array([(x * x / (film + gap(x, circles))) ** 2 for x in r])
            lost += sign * 0.25 * pi * weight * cosine**2 * np.trapezoid(values, np.log(r))
    strength = 12.0 * c.lubricant.viscosity * c.entrainment_speed / (3.0 + 2.0 * c.radius_x / c.radius_y)
    return float(2.0 * LOSS * strength * lost)


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
