"""Compiled integrals of Kapitza's pressure over rays ahead of two bodies; the NumPy twins are
`kapitza_moment_twin` and `circles_loss_twin` of tests/reference.
"""

import numpy as np

from ..compiled import compiled

NEWTON_STEPS = 60  # most of them for the meniscus: 5 to 9 are taken
LAST_STEP = 1e-6  # of the square of its distance, after which a step of second order is exact
NEAREST = 0.03  # of the distance at which the gap is twice the film: what is within is left out
# gap beyond the film of elastic bodies from which on pressure counts, in a^2/Rx: 0.015 to 0.1
# serve alike
INLET_GAP = 0.04
SECANTS = 60  # most of them for a gap: 5 to 8 are taken, more where the gap of circles jumps
LAST_SECANT = 1e-9  # of the gap, or of the square of its distance, at which they end [-]
PARABOLA_SHARE = 0.2  # as `oil_extent.PARABOLA_SHARE`
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


@compiled
def excess(ball, race, square):
    """Gap of two circles less that of their parabolas at the square of a distance [m]; none near
    by, as in `oil_extent`.
    """
    if max(ball * ball, race * race) * square <= PARABOLA_SHARE**2:
        return 0.0
    found = 0.0
    for curvature in (ball, race):
        turned = min(curvature * curvature * square, 1.0)
        found += 0.5 * curvature * square * turned / (1.0 + np.sqrt(1.0 - turned)) ** 2
    return found


@compiled
def hertz_gap(ratio):
    """Gap outside a dry circular contact over a^2/R, at a distance over a (Johnson, 1985, 4.2)."""
    if ratio <= 1.0:
        return 0.0
    return ((ratio**2 - 2.0) * np.arccos(1.0 / ratio) + np.sqrt(ratio**2 - 1.0)) / np.pi


@compiled
def elastic_gap(r, ray, ball, reciprocal, axes, circles):
    """Gap beyond the film [m] at a distance r [m] along a ray (cosine, sine, distance of the
    ellipse's edge [m]) with curvatures ball and, along and across, `reciprocal` [1/m]; outside the
    ellipse with `axes` that of a circular contact along the ray, of circles with what these part
    more than paraboloids from the edge beside on.
    """
    cosine, sine, edge = ray
    curvature = cosine**2 * reciprocal[0] + sine**2 * reciprocal[1]
    gap = curvature * edge**2 * hertz_gap(r / edge)
    if circles and r > edge:
        across = min(r * sine, axes[1])
        along = min(r * cosine, axes[0] * np.sqrt(max(1.0 - (across / axes[1]) ** 2, 0.0)))
        square = along**2 + across**2
        beside = (along**2 * reciprocal[0] + across**2 * reciprocal[1]) / square
        gap += excess(ball, curvature - ball, r**2) - excess(ball, beside - ball, square)
    return gap


@compiled
def distance_of(gap, low, high, ray, ball, reciprocal, axes, circles):
    """Distance along a ray at which the gap beyond the film is as wide as `gap`, or `high` [m]: a
    secant in the square of the distance kept inside a bracket, after Illinois.
    """
    left = elastic_gap(low, ray, ball, reciprocal, axes, circles) - gap
    right = elastic_gap(high, ray, ball, reciprocal, axes, circles) - gap
    if right <= 0.0:
        return high
    if left >= 0.0:
        return low
    near = low * low
    far = high * high
    square = near
    for _ in range(SECANTS):
        width = abs(far - near)
        square = far - right * (far - near) / (right - left)
        found = elastic_gap(np.sqrt(square), ray, ball, reciprocal, axes, circles) - gap
        if found * right > 0.0:
            left *= 0.5
        else:
            near = far
            left = right
        far = square
        right = found
        if abs(found) <= LAST_SECANT * gap or width <= LAST_SECANT * square:
            break
    return np.sqrt(square)


@compiled
def circles_loss(film, layer, reciprocal, ball_curvature, axes, rays, steps):
    """What the integral of cos^2 r^3/h^2 over a quarter loses by circles in place of paraboloids,
    elastic bodies [m^2].

    reciprocal: 1/Rx and 1/Ry [1/m]; axes: semi-axes of Hertz' ellipse [m]; others as in
    `kapitza_integral`.
    """
    lost = 0.0
    for i in range(rays.shape[1]):
        angle = 0.25 * np.pi * (rays[0, i] + 1.0)
        cosine, sine = np.cos(angle), np.sin(angle)
        edge = 1.0 / np.sqrt((cosine / axes[0]) ** 2 + (sine / axes[1]) ** 2)
        ray = (cosine, sine, edge)
        curvature = cosine**2 * reciprocal[0] + sine**2 * reciprocal[1]
        ball = curvature if np.isnan(ball_curvature) else ball_curvature
        ends = max(abs(ball), abs(curvature - ball))
        # the gap of a circular contact near its edge is 8 sqrt(2)/(3 pi) (r/edge - 1)^1.5 of its
        # a^2/R there
        least = min(INLET_GAP * axes[0] ** 2 * reciprocal[0], layer - film)
        narrow = 3.0 * np.pi / (8.0 * np.sqrt(2.0)) * least / (curvature * edge**2)
        start = edge * (1.0 + narrow ** (2.0 / 3.0))
        far = edge + np.sqrt(2.0 * layer / curvature)
        for circles in (False, True):
            reach = max(min(far, CIRCLE_END / ends) if circles else far, start)
            end = distance_of(layer - film, start, reach, ray, ball, reciprocal, axes, circles)
            span = np.log(end / start)
            radial = 0.0
            for j in range(steps.shape[1]):
                r = start * np.exp(0.5 * span * (steps[0, j] + 1.0))
                gap = film + elastic_gap(r, ray, ball, reciprocal, axes, circles)
                radial += 0.5 * span * steps[1, j] * (r**2 / gap) ** 2
            part = 0.25 * np.pi * rays[1, i] * cosine**2 * radial
            lost += -part if circles else part
    return lost
