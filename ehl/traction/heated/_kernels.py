"""Compiled sums over a film that sliding warms; the equations and the NumPy twin stand in
`heating.py`.
"""

import numpy as np

from ...compiled import compiled
from ...oil._rheology_kernels import limiting_stress, shear_stress
from .._kernels import mean_sliding
from .heating import nahme

AREA = 2
FILM = 3
VISCOSITY = 4
PRESSURE = 5
TEMPERATURE = 6
SOFTENING = 7
FALL = 8
ALONG = 9
ACROSS = 10
CAPACITY = 11
STRESS_TOLERANCE = 2e-4  # of the stress of a node, relative
HEAT_STEPS = 20  # of the Newton's method for its heat at most
SMALL_LOADING = 1e-3  # X up to which ln(g) is 2 X/3
# of X in the table of the profile: ln(g) reaches 120 there
LARGEST_ROOT = 8.0
ROOTS = 2048


PROFILE = np.ascontiguousarray(np.stack(nahme(np.linspace(0.0, LARGEST_ROOT, ROOTS) ** 2), axis=1))


@compiled
def heated_profile(x):
    """ln g, 2 ln(cosh m) and its slope for X = m tanh m, linear in a table over sqrt(X); held
    where that ends.
    """
    root = np.sqrt(max(x, 0.0))
    place = root * ((ROOTS - 1) / LARGEST_ROOT)
    k = min(int(place), ROOTS - 2)
    t = min(place - k, 1.0)
    steep = PROFILE[k + 1, 1] - PROFILE[k, 1]
    slope = steep * (0.5 * (ROOTS - 1) / LARGEST_ROOT) / max(root, LARGEST_ROOT / ROOTS)
    return (
        PROFILE[k, 0] + t * (PROFILE[k + 1, 0] - PROFILE[k, 0]),
        PROFILE[k, 1] + t * steep,
        slope,
    )


@compiled
def thinning_by_heat(wall, flux, gap, softening, fall, conductivity):
    """ln of the viscosity that a rise of the walls and a flux out of the film take from it."""
    cold = 1.0 / (1.0 + fall * wall)
    thinned, first = softening * wall * cold, softening * cold * cold
    loading = max(flux, 0.0) * gap / (8.0 * conductivity)  # X over the softening [K]
    if loading * first < SMALL_LOADING:
        return thinned + 2.0 / 3.0 * loading * first
    share = fall * cold
    local = first / (1.0 + share * loading)
    # a Newton step for b = first - share 2 ln(cosh m), nearly linear
    _, swell, slope = heated_profile(loading * local)
    local = max(local - (local - first + share * swell) / (1.0 + share * loading * slope), 0.0)
    return thinned + heated_profile(loading * local)[0]


@compiled
def heated_stress(slide, node, start, share, bodies, conductivity, base, limits, guess):
    """Stress [Pa], rise of the film's mean temperature [K], flux out of it and heat made in it
    [W/m^2] at one node.

    start: what convection and bodies leave without heat of its own, [W/m^2]; share: what a kelvin
    of rise takes in all, and the part of it that leaves; bodies: rise of the walls without flux
    and by it; guess: of the heat.
    """
    gap, soft, fall = node[FILM], node[SOFTENING], node[FALL]
    total, out = share
    heat = guess
    before = -1.0
    found = 0.0
    steep = soft * (gap / (12.0 * conductivity) + bodies[1]) * out / total
    tau = made = 0.0
    for _ in range(HEAT_STEPS):
        rise = (start + heat) / total
        flux = out * (rise - bodies[0])
        wall = bodies[0] + bodies[1] * flux
        eta = node[VISCOSITY] * np.exp(
            -thinning_by_heat(wall, flux, gap, soft, fall, conductivity)
        )
        limit = limiting_stress(node[PRESSURE], node[TEMPERATURE] + rise, *limits)
        tau = shear_stress(slide / gap, eta, limit, *base)
        made = tau * slide
        if before >= 0.0 and heat != before and made > 0.0:
            steep = max(np.log(found / made) / (heat - before), 0.0)
        if steep * abs(made - heat) <= STRESS_TOLERANCE * (1.0 + steep * made):
            break
        before, found = heat, made
        heat = max(heat + (made - heat) / (1.0 + steep * made), 0.0)
    rise = (start + made) / total
    return tau, rise, out * (rise - bodies[0]), made


@compiled
def line_walls(j, history, flux, answers, between):
    """Mean rise of both walls without flux of their own, and by it; share of body 1 in that flux,
    what crosses besides.

    answers: rise of the walls by their flux over the unit of `history`; between: conductivity over
    film.
    """
    past_1 = past_2 = 0.0
    for m in range(j):
        past_1 += history[j, m] * flux[0, m]
        past_2 += history[j, m] * flux[1, m]
    past_1, past_2 = past_1 * answers[0], past_2 * answers[1]
    own_1, own_2 = answers[0] * history[j, j], answers[1] * history[j, j]
    both = 1.0 + between * (own_1 + own_2)
    across = between * (past_2 - past_1) / both
    walls = 0.5 * (past_1 + past_2 + (own_1 - own_2) * across)
    answer = 0.5 * (0.5 * (own_1 + own_2) + 2.0 * between * own_1 * own_2) / both
    return walls, answer, (0.5 + between * own_2) / both, across


@compiled
def heated_sums(lines, span, history, heat, answers, base, limits, motion, bend, flux, out):
    """Forces and moments on body 1 by sliding over the lines of a film, added to out: F_x, F_y,
    M_n, M_y.

    lines, shape (L, N, 12): x, y, area, film, viscosity, pressure, temperature, softening, its
    fall, a twelfth of the squared size along x and y, capacity, of nodes one behind the other
    along each line. span, shape (L,): length of the lines. history, shape (N, N): weights of the
    fluxes over a line of unit length. heat: conductivity of the oil. answers: 1/(sqrt(pi u) e) of
    both bodies. motion: slide_x, slide_y, spin, rolling. bend: 1/(2R) and the half width over
    which it counts. flux, shape (2, N): workspace.
    """
    for k in range(lines.shape[0]):
        first, second = answers[0] * np.sqrt(span[k]), answers[1] * np.sqrt(span[k])
        before = made = 0.0
        for j in range(lines.shape[1]):
            node = lines[k, j]
            x = node[0]
            y = node[1]
            gap = node[FILM]
            s_x, s_y, s, bow = mean_sliding(x, y, node[ALONG], node[ACROSS], motion, bend)
            between = heat / gap
            walls, answer, split, across = line_walls(j, history, flux, (first, second), between)
            outward = 12.0 * between / (1.0 + 12.0 * between * answer)
            tau, before, leaving, made = heated_stress(
                s,
                node,
                node[CAPACITY] * before + outward * walls,
                (node[CAPACITY] + outward, outward),
                (walls, answer),
                heat,
                base,
                limits,
                made,
            )
            flux[0, j] = leaving * split + across
            flux[1, j] = leaving - flux[0, j]
            if s <= 0.0:
                continue
            pull = node[AREA] * tau / s
            t_x, t_y = pull * s_x, pull * s_y
            out[0] -= t_x
            out[1] -= t_y
            out[2] += y * t_x - x * t_y
            out[3] += bow * t_x


@compiled
def heated_sums_many(
    lines, span, history, heat, answers, base, limits, slide_x, slide_y, spin, rolling, bend, out
):
    """`heated_sums` for each of n motions given as arrays, answers of shape (n, 2), added to out
    of shape (n, 4).
    """
    flux = np.zeros((2, lines.shape[1]))
    for k in range(slide_x.size):
        motion = (slide_x[k], slide_y[k], spin[k], rolling[k])
        heated_sums(
            lines, span, history, heat, answers[k], base, limits, motion, bend, flux, out[k]
        )
