"""Compiled integral of Kapitza's pressure over rays ahead of two rigid bodies; the NumPy twin is
`kapitza_moment_twin` of tests/reference.
"""

import numpy as np

from ..compiled import compiled

NEWTON_STEPS = 60  # most of them for the meniscus: 5 to 9 are taken
LAST_STEP = 1e-6  # of the square of its distance, after which a step of second order is exact
NEAREST = 0.03  # of the distance at which the gap is twice the film: what is within is left out
CIRCLE_END = 1.0 - 1e-9  # as `oil_extent.CIRCLE_END`


@compiled
def height(curvature, square):
    """Of a circle at the square of a distance, signed as its curvature [m]."""
    return curvature * square / (1.0 + np.sqrt(1.0 - min(curvature * curvature * square, 1.0)))


@compiled
def meniscus(film, layer, ball, race, end):
    """Distance along a ray [m] at which the gap of two circles is as wide as a layer, or the
    smaller circle ends: Newton's method in the square of the distance, by which the gap is convex,
    kept inside a bracket.
    """
    if not film + height(ball, end * end) + height(race, end * end) > layer:
        return end
    low = 0.0
    high = end * end
    square = min(2.0 * (layer - film) / (ball + race), 0.5 * high)
    for _ in range(NEWTON_STEPS):
        excess = film + height(ball, square) + height(race, square) - layer
        if excess < 0.0:
            low = square
        else:
            high = square
        rise = 0.5 * ball / np.sqrt(1.0 - ball * ball * square)
        rise += 0.5 * race / np.sqrt(1.0 - race * race * square)
        step = -excess / rise
        inside = low <= square + step <= high
        done = abs(step) <= LAST_STEP * square
        square = square + step if inside else 0.5 * (low + high)
        if done:
            break
    return np.sqrt(square)


@compiled
def kapitza_integral(film, layer, radii, ball_curvature, circles, rays, steps):
    """Integral of cos^2 r^3/h^2 over a quarter from near the centre to the meniscus [m^2].

    radii: reduced, along and across [m]; ball_curvature: of body 1 [1/m], not a number: that of
    the gap; circles: whether the bodies are circles, else paraboloids; rays, steps: Gauss and
    Legendre's places and weights on [-1, 1] for angles and distances, shape (2, n).
    """
    total = 0.0
    for i in range(rays.shape[1]):
        angle = 0.25 * np.pi * (rays[0, i] + 1.0)
        cosine = np.cos(angle) ** 2
        curvature = cosine / radii[0] + np.sin(angle) ** 2 / radii[1]
        ball = curvature if np.isnan(ball_curvature) else ball_curvature
        race = curvature - ball
        circle_end = CIRCLE_END / max(abs(ball), abs(race))
        end = min(np.sqrt(2.0 * (layer - film) / curvature), circle_end)
        if circles:
            end = meniscus(film, layer, ball, race, circle_end)
        start = min(NEAREST * np.sqrt(2.0 * film / curvature), end)
        span = np.log(end / start)
        radial = 0.0
        for j in range(steps.shape[1]):
            square = (start * np.exp(0.5 * span * (steps[0, j] + 1.0))) ** 2
            gap = film
            if circles:
                gap += height(ball, square) + height(race, square)
            else:
                gap += 0.5 * curvature * square
            radial += 0.5 * span * steps[1, j] * (square / gap) ** 2
        total += 0.25 * np.pi * rays[1, i] * cosine * radial
    return total
