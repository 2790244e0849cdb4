r"""Heat of sliding in a film that is sheared: its equations, the table of self-heated Couette
flow, and compiled sums over the film.

The film that rolls without sliding is solved with its heat; its temperature T_0 across the film is
known. Sliding at s under the stress :math:`\tau` adds :math:`q = \tau s` to each column. Along
every line of nodes, downstream, convection moves the rise :math:`\theta` of the film's mean
temperature along, and conduction takes heat out of it,

.. math:: \rho c\,h\,u\,\theta_x = q - q_1 - q_2, \qquad q_1 + q_2 = \frac{12 k}{h}
    \Bigl(\theta - \frac{\theta_1 + \theta_2}{2}\Bigr), \qquad q_1 - q_2 = \frac{2 k}{h}(\theta_2 -
    \theta_1),

the conduction of a parabola between walls, whose own rise is that of moving half-spaces
(`oilfilm.ehl.solid.heat`):

.. math:: \theta_i(x) = \frac{1}{\sqrt{\pi u_i}\,e_i} \int \frac{q_i\,dx'}{\sqrt{x - x'}} .

How much thinner the oil gets is the solution of Couette flow heated by itself (Nahme, 1940;
Gruntfest, 1963) with the flux that leaves the film: the mean fluidity grows by :math:`e^{b
\theta_w} g`,

.. math:: g = \frac{\sinh m \cosh m}{m}, \qquad m \tanh m = X = \frac{(q_1 + q_2)\,b\,h}{8 k},
    \qquad \theta_{mid} - \theta_w = \frac{2}{b} \ln \cosh m .

As the softening falls with temperature, :math:`\ln\eta = \ln\eta_0 - \beta\theta/(1 + c\theta)`,
which is exact for oils after Vogel, b is the secant between wall and middle, :math:`b = \beta/[(1
+ c\theta_w)(1 + c\theta_{mid})]`. The base laws have rates f(stress)/viscosity, so that one mean
fluidity determines the stress, :math:`\tau = f^{-1}(s/(h\,\overline{1/\eta}))`. Left out: that
sliding changes pressure and film, and that the two walls may differ in temperature where g is
evaluated.

As heat acts along a line alone, the friction of a line with it over that without is a smooth
function of two numbers, the line's sliding speed and the slide-roll ratio, which sets how fast
both bodies move under the heat: it is marched at some of each, and multiplied onto sums without
heat of sliding.
"""

import numpy as np

from ..arrays import Array
from ..compiled import compiled
from ..oil._kernels import shear_stress
from ..oil._laws import limiting_stress
from ._kernels import AREA as COLD_AREA
from ._kernels import BLOCK, F_X, F_Y, M_N, M_Y, ROOM, SQUARES, TINY, block_sums, load_block

NEWTON_STEPS = 5  # from m = sqrt(X^2 + X) to round-off
LARGEST_ROOT = 8.0  # of X in the table: ln(g) reaches 120 there
ROOTS = 2048  # linear between them, ln(g) is off by 1.1e-5 at most

# columns of a node
X, Y, AREA, FILM, VISCOSITY, PRESSURE = range(6)
TEMPERATURE, SOFTENING, FALL, SPREAD_X, SPREAD_Y, CAPACITY, CONDUCTIVITY = range(6, 13)
STRESS_TOLERANCE = 2e-4  # of the stress of a node, relative
HEAT_STEPS = 20  # of Newton's method for the heat of a node at most
NO_HEAT = 1e-4  # of the friction of a line, from which on it falls with the square of the speed
SMALL_LOADING = 1e-3  # X up to which ln(g) is 2 X/3, to 2e-4 of it
NEAREST = 4  # neighbouring slide-roll ratios whose factors count at a motion


def nahme(loading: Array) -> tuple[Array, Array]:
    """Solve Couette flow heated by itself at X = m tanh m, Nahme (1940), Gruntfest (1963).

    Parameters
    ----------
    loading : Array
        X, any shape [-]

    Returns
    -------
    log_g
        ln g with g = sinh m cosh m/m, shape of `loading` [-]
    log_cosh
        2 ln(cosh m), of this shape [-]
    """
    x = np.maximum(np.asarray(loading, dtype=np.float64), 0.0)
    m = np.sqrt(x * x + x)
    for _ in range(NEWTON_STEPS):
        slope = np.tanh(m) + m / np.cosh(np.minimum(m, 300.0)) ** 2
        m = m - (m * np.tanh(m) - x) / np.where(slope > 0.0, slope, 1.0)
    m = np.maximum(m, 1e-12)
    log_cosh = np.logaddexp(m, -m) - np.log(2.0)
    return m + np.log(-np.expm1(-2.0 * m)) - np.log(2.0) + log_cosh - np.log(m), 2.0 * log_cosh


# ln g and 2 ln(cosh m), shape (ROOTS, 2), at sqrt(X) evenly from 0 to LARGEST_ROOT
PROFILE = np.ascontiguousarray(np.stack(nahme(np.linspace(0.0, LARGEST_ROOT, ROOTS) ** 2), axis=1))


@compiled
def heated_profile(x):
    """ln g, 2 ln(cosh m) and slope for X = m tanh m, linear in a table over sqrt(X)."""
    root = np.sqrt(max(x, 0.0))
    place = root * ((ROOTS - 1) / LARGEST_ROOT)
    k = min(int(place), ROOTS - 2)
    t = min(place - k, 1.0)
    rise = PROFILE[k + 1, 1] - PROFILE[k, 1]
    slope = rise * (0.5 * (ROOTS - 1) / LARGEST_ROOT) / max(root, LARGEST_ROOT / ROOTS)
    log_g = PROFILE[k, 0] + t * (PROFILE[k + 1, 0] - PROFILE[k, 0])
    return log_g, PROFILE[k, 1] + t * rise, slope


@compiled
def thinning_by_heat(wall, flux, gap, softening, fall, conductivity):
    """ln of the ratio by which a rise of the walls and a flux out of the film reduce viscosity."""
    ratio = 1.0 / (1.0 + fall * wall)
    thinned = softening * wall * ratio
    at_wall = softening * ratio * ratio  # b without a rise from wall to middle
    loading = max(flux, 0.0) * gap / (8.0 * conductivity)  # X/b [K]
    if loading * at_wall < SMALL_LOADING:
        return thinned + 2.0 / 3.0 * loading * at_wall
    steepness = fall * ratio
    b = at_wall / (1.0 + steepness * loading)
    # one Newton step for b = b_wall - steepness 2 ln(cosh m), which is nearly linear
    _, swell, slope = heated_profile(loading * b)
    b = max(b - (b - at_wall + steepness * swell) / (1.0 + steepness * loading * slope), 0.0)
    return thinned + heated_profile(loading * b)[0]


@compiled
def heated_stress(slide, node, start, conductance, walls, base, limits, guess):
    """Stress [Pa], rise of the film's mean temperature [K], flux out of it and heat of sliding
    [W/m^2] at one node.

    Newton's method for q = tau(q) s in q, the heat of sliding, with the slope of ln(tau s) taken
    as the secant of the last two steps. start: what convection and bodies supply without heat of
    the node, [W/m^2]; conductance: heat per kelvin of rise in all, and the part of it that leaves
    the film; walls: their rise without flux and by it; guess: of the heat.
    """
    gap = node[FILM]
    soft = node[SOFTENING]
    fall = node[FALL]
    conductivity = node[CONDUCTIVITY]
    total, out = conductance
    heat = guess
    last_heat = -1.0
    last_generated = 0.0
    steepness = soft * (gap / (12.0 * conductivity) + walls[1]) * out / total
    tau = generated = 0.0
    for _ in range(HEAT_STEPS):
        # 1. rise of film and walls with this heat
        rise = (start + heat) / total
        flux = out * (rise - walls[0])
        wall = walls[0] + walls[1] * flux
        # 2. viscosity, limiting stress and stress there
        thinned = thinning_by_heat(wall, flux, gap, soft, fall, conductivity)
        eta = node[VISCOSITY] * np.exp(-thinned)
        limit = limiting_stress(node[PRESSURE], node[TEMPERATURE] + rise, *limits)
        tau = shear_stress(slide / gap, eta, limit, *base)
        generated = tau * slide
        # 3. -d ln(tau s)/dq, and whether the stress is known well enough
        if last_heat >= 0.0 and heat != last_heat and generated > 0.0:
            steepness = max(np.log(last_generated / generated) / (heat - last_heat), 0.0)
        if steepness * abs(generated - heat) <= STRESS_TOLERANCE * (1.0 + steepness * generated):
            break
        # 4. Newton step
        last_heat = heat
        last_generated = generated
        heat = max(heat + (generated - heat) / (1.0 + steepness * generated), 0.0)
    rise = (start + generated) / total
    return tau, rise, out * (rise - walls[0]), generated


@compiled
def line_walls(j, history, flux, wall_response, between):
    """Mean rise of both walls without flux at node j, and by it; share of body 1 in that flux, and
    flux from wall to wall.

    wall_response: rise of each wall by its flux over the unit of `history`; between: conductivity
    over film.
    """
    past_1 = past_2 = 0.0
    for m in range(j):
        past_1 += history[j, m] * flux[0, m]
        past_2 += history[j, m] * flux[1, m]
    past_1 *= wall_response[0]
    past_2 *= wall_response[1]
    own_1, own_2 = wall_response[0] * history[j, j], wall_response[1] * history[j, j]
    both = 1.0 + between * (own_1 + own_2)
    across = between * (past_2 - past_1) / both
    rise = 0.5 * (past_1 + past_2 + (own_1 - own_2) * across)
    by_flux = 0.5 * (0.5 * (own_1 + own_2) + 2.0 * between * own_1 * own_2) / both
    return (rise, by_flux), (0.5 + between * own_2) / both, across


@compiled
def heated_line(line, span, history, law, response, slide, flux):
    """Friction of a line that slides at one speed [m/s] everywhere, with the heat of that [N].

    line: nodes one behind the other along it, shape (N, 13), columns as named above; span: its
    length [m]; history, shape (N, N), weights of the fluxes over a line of unit length. law:
    constants of base law and limiting stress. response: 1/(sqrt(pi u) e) of both bodies. flux,
    shape (2, N): workspace.
    """
    base, limits = law
    root = np.sqrt(span)
    response = (response[0] * root, response[1] * root)
    rise = generated = hot = 0.0
    for j in range(line.shape[0]):
        node = line[j]
        between = node[CONDUCTIVITY] / node[FILM]
        walls, split, across = line_walls(j, history, flux, response, between)
        outward = 12.0 * between / (1.0 + 12.0 * between * walls[1])
        start = node[CAPACITY] * rise + outward * walls[0]
        total = node[CAPACITY] + outward
        tau, rise, leaving, generated = heated_stress(
            slide, node, start, (total, outward), walls, base, limits, generated
        )
        flux[0, j] = leaving * split + across
        flux[1, j] = leaving - flux[0, j]
        hot += node[AREA] * tau
    return hot


@compiled
def cold_line(line, law, slide):
    """Friction of a line that slides at one speed [m/s] everywhere, without its heat [N]."""
    base, limits = law
    cold = 0.0
    for j in range(line.shape[0]):
        node = line[j]
        limit = limiting_stress(node[PRESSURE], node[TEMPERATURE], *limits)
        cold += node[AREA] * shear_stress(slide / node[FILM], node[VISCOSITY], limit, *base)
    return max(cold, TINY)


@compiled
def line_factors(film, law, responses, slides, out):
    """`heated_line` over `cold_line` of all lines for pairs of responses, shape (R, 2), and rising
    sliding speeds; out, shape (L, R, S) [-].

    Where the heat of a speed takes less than `NO_HEAT`, that of slower ones goes with the square
    of the speed.
    """
    lines, span, history = film
    flux = np.zeros((2, lines.shape[1]))
    cold = np.empty(slides.size)
    for k in range(lines.shape[0]):
        for m in range(slides.size):
            cold[m] = cold_line(lines[k], law, slides[m])
        for r in range(responses.shape[0]):
            response = (responses[r, 0], responses[r, 1])
            least = slides.size
            while least > 0 and (least == slides.size or 1.0 - out[k, r, least] > NO_HEAT):
                least -= 1
                slide = slides[least]
                hot = heated_line(lines[k], span[k], history, law, response, slide, flux)
                out[k, r, least] = hot / cold[least]
            for m in range(least):
                square = (slides[m] / slides[least]) ** 2
                out[k, r, m] = 1.0 - (1.0 - out[k, r, least]) * square


@compiled
def first_weighted(weights):
    """First of `NEAREST` neighbours that hold all weights which are not zero."""
    first = 0
    while first < weights.size - NEAREST and weights[first] == 0.0:
        first += 1
    return first


@compiled
def cubic_weights(count, place):
    """First of the four nodes nearest to a place counted in them, and the weights of the cubic
    through these.
    """
    place = min(max(place, 0.0), count - 1.0)
    i = min(max(int(place) - 1, 0), count - 4)
    t = place - i
    w_0 = -(t - 1.0) * (t - 2.0) * (t - 3.0) / 6.0
    w_1 = t * (t - 2.0) * (t - 3.0) / 2.0
    w_2 = -t * (t - 1.0) * (t - 3.0) / 2.0
    w_3 = t * (t - 1.0) * (t - 2.0) / 6.0
    return i, w_0, w_1, w_2, w_3


@compiled
def factor_at(factors, weights, near, place):
    """A line's factor at a place of the sliding speed counted in nodes: cubics, of the weighted
    sum over the responses.

    factors, shape (R, S); weights, shape (R,), near: `first_weighted` of them.
    """
    i, w_0, w_1, w_2, w_3 = cubic_weights(factors.shape[1], place)
    total = 0.0
    for r in range(near, near + NEAREST):
        row = factors[r]
        here = w_0 * row[i] + w_1 * row[i + 1] + w_2 * row[i + 2] + w_3 * row[i + 3]
        total += weights[r] * here
    return total


@compiled
def factored_sums(lines, law, axis, motions, weights, surface, out):
    """Forces and moments on body 1 by sliding over the lines of a film for n motions, added to
    out, shape (n, 4): those without heat of sliding, times the factor of each line.

    lines: nodes, shape (L, 8, N), rows of a film's nodes, and factors, shape (L, R, S). law: base
    law and its constants. axis: ln of the first sliding speed and nodes per unit. motions:
    slide_x, slide_y, spin, rolling. weights, shape (n, R): of the responses. surface: 1/(2R) and
    the half width over which it counts.
    """
    nodes, factors = lines
    room = np.empty(ROOM)
    near = np.empty(BLOCK, dtype=np.int64)
    for first in range(0, motions[0].size, BLOCK):
        count = load_block(motions, first, room)
        for n in range(count):
            near[n] = first_weighted(weights[first + n])
        for k in range(nodes.shape[0]):
            block_sums(nodes[k], law, surface, room)
            area = max(nodes[k, COLD_AREA].sum(), TINY)
            for n in range(count):
                # root mean square of the sliding over the area of the line's nodes, on strips
                # beside a line of no length maybe negative
                slide = np.sqrt(max(room[SQUARES + n], 0.0) / area)
                place = (np.log(max(slide, TINY)) - axis[0]) * axis[1]
                factor = factor_at(factors[k], weights[first + n], near[n], place)
                out[first + n, 0] += factor * room[F_X + n]
                out[first + n, 1] += factor * room[F_Y + n]
                out[first + n, 2] += factor * room[M_N + n]
                out[first + n, 3] += factor * room[M_Y + n]
