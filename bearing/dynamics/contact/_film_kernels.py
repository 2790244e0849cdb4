"""A ball on a race over the film of a traction table, compiled.

Film and elastic bodies lie in series: as if rigid, the bodies approach by delta = w(Q) - h_c(Q,
u), where w is the elastic approach under the load Q and h_c the table's central film at that load
and the entrainment speed u.
"""

import numpy as np

from ehl.compiled import compiled
from ehl.traction._kernels import CENTRAL_FILM as TABLE_CENTRAL_FILM
from ehl.traction._kernels import LOAD_POWER

from ..arrays import EXPONENT, STIFFNESS

# of the axes of a table: rows, and columns
LOAD, SPEED = range(2)
FIRST, DENSITY, NODES = range(3)
NEWTON_STEPS = 40
# last step of Newton's iteration over the approach; the error left is its square [-]
STEP_TOLERANCE = 1.0e-9


@compiled
def smallest_load(axes):
    """Smallest load of a table."""
    return (-axes[LOAD, FIRST]) ** (1.0 / LOAD_POWER)


@compiled
def weights(place, axis):
    """Index, weights and slopes of a uniform cubic B-spline at a place clamped to its axis."""
    t = min(max(place - axis[FIRST], 0.0) * axis[DENSITY], axis[NODES] - 1.0)
    i = min(max(int(t), 0), int(axis[NODES]) - 2)
    t -= i
    r = 1.0 - t
    second = (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0
    third = (4.0 - 6.0 * r * r + 3.0 * r * r * r) / 6.0
    slopes = (-0.5 * r * r, 1.5 * t * t - 2.0 * t, 2.0 * r - 1.5 * r * r, 0.5 * t * t)
    return i, (r * r * r / 6.0, second, third, t * t * t / 6.0), slopes


@compiled
def film_and_slope(axes, scalars, load, at_speed, share):
    """A share of the central film at a load and the weights of a speed, and its slope over the
    load.

    Above the table's largest load the film is that of the largest.
    """
    place = -(load**LOAD_POWER)
    axis = axes[LOAD]
    i, w, d = weights(place, axis)
    j, v, _ = at_speed
    logarithm = 0.0
    steep = 0.0
    for a in range(4):
        c = scalars[i + a, j : j + 4, TABLE_CENTRAL_FILM]
        mean = v[0] * c[0] + v[1] * c[1] + v[2] * c[2] + v[3] * c[3]
        logarithm += w[a] * mean
        steep += d[a] * mean
    film = share * np.exp(logarithm)
    beyond = (place - axis[FIRST]) * axis[DENSITY] >= axis[NODES] - 1.0
    return film, 0.0 if beyond else film * steep * axis[DENSITY] * LOAD_POWER * place / load


@compiled
def elastic_approach(axes, scalars, law, distance, speed):
    """Root w of w = distance + h_c(K w^n, speed): the elastic approach, negative where the film is
    not touched.

    Below the table's smallest load the film goes on linearly in w: nothing jumps, neither load nor
    stiffness. Below its smallest speed the film falls in proportion to the speed. Newton's steps
    start left of the root; w - h_c is concave where the film falls ever less steeply, so they rise
    to it.
    """
    at_speed = weights(np.log(max(speed, 1e-300)), axes[SPEED])
    share = min(1.0, speed / np.exp(axes[SPEED, FIRST]))
    lightest = smallest_load(axes)
    least = (lightest / law[STIFFNESS]) ** (1.0 / law[EXPONENT])
    w = distance
    if distance < least:
        film, slope = film_and_slope(axes, scalars, lightest, at_speed, share)
        w = least + (distance - least + film) / (1.0 - slope * law[EXPONENT] * lightest / least)
        if w <= least:
            return w
    for _ in range(NEWTON_STEPS):
        load = law[STIFFNESS] * w ** law[EXPONENT]
        film, slope = film_and_slope(axes, scalars, load, at_speed, share)
        step = (distance + film - w) / (1.0 - slope * law[EXPONENT] * load / w)
        w = max(w + step, least)
        if abs(step) <= STEP_TOLERANCE * w:
            return w
    return np.nan  # no root: the step in time is rejected
