"""Compiled law of starvation of many contacts; see `starvation` for its functions."""

import numpy as np

from ..compiled import compiled, fused, inlined
from ..oil._kernels import exponential_of

THIRD = 1.0 / 3.0
LEAST_RISE = 1e-6  # of ln R, ln R_min and s from node to node
HALVINGS = 50
LARGEST_LOG_EXPONENT = 5.0  # ln g
# rows of the functions at the nodes of ln r: ln g before it rises, ln R, ln R_min, s, damping
EXPONENT, FILM, MINIMUM, MOMENT, DAMPING = range(5)
ROWS = 5

_exponential = inlined(getattr(exponential_of, "py_func", exponential_of))


@fused
def radial_sums(contact, centres, scales, along, weights, out):
    """Add sum_i w_i k(d_i) of one contact (3,) at nodes of ln r (m,), five times whose squared
    steps from the centres (n, 3) are along (n, m).
    """
    for i in range(centres.shape[0]):
        away = 0.0
        for k in range(3):
            step = (contact[k] - centres[i, k]) / scales[k]
            away += step * step
        away *= 5.0
        weight = weights[i]
        for j in range(out.size):
            t = np.sqrt(along[i, j] + away)
            out[j] += weight * (1.0 + t * (1.0 + t * THIRD)) * _exponential(-t)


@compiled
def log_film_factor(exponent, log_ratio):
    """Ln R of the starvation factor R = r/(1 + r^g)^(1/g), of ln g and ln r."""
    g = np.exp(exponent)
    return min(log_ratio, 0.0) - np.log1p(np.exp(-g * abs(log_ratio))) / g


@compiled
def _raise(values, count):
    """Largest value so far, plus a small slope: a rising function."""
    most = values[0]
    for j in range(1, count):
        most = max(most, values[j] - LEAST_RISE * j)
        values[j] = most + LEAST_RISE * j


@compiled
def rising(log_ratios, count, out):
    """Functions (ROWS, m) of one contact at the first nodes of ln r: from the fitted ln g, c, s to
    ln R, ln R_min and s that rise over r; c lies in the row of ln R_min.
    """
    film = out[FILM]
    for j in range(count):
        film[j] = log_film_factor(out[EXPONENT, j], log_ratios[j])
    _raise(film, count)
    for j in range(count):
        out[MINIMUM, j] = min(film[j] - np.expm1(film[j]) * out[MINIMUM, j], 0.0)
    _raise(out[MINIMUM], count)
    _raise(out[MOMENT], count)


@compiled
def _exponent(log_factor, log_ratio, before):
    """Ln g that gives ln R at ln r; that before where it does so."""
    if not log_factor > log_film_factor(before, log_ratio) + 0.5 * LEAST_RISE:
        return before
    low = before
    high = LARGEST_LOG_EXPONENT
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if log_film_factor(middle, log_ratio) < log_factor:
            low = middle
        else:
            high = middle
    return low


@compiled
def _beyond(factor, beyond):
    """A factor extrapolated in ln r past the ends of the table [-]: below, it falls with r; above,
    its distance from 1 does.
    """
    if beyond > 0.0:
        return 1.0 - (1.0 - factor) * np.exp(-beyond)
    return factor * np.exp(beyond)


@compiled
def film_factor(ratio, exponent):
    """R = r/(1 + r^g)^(1/g), Chevalier et al. (1998)."""
    if ratio > 1.0:  # the same, so that ample oil leaves exactly 1
        return (1.0 + ratio**-exponent) ** (-1.0 / exponent)
    return ratio / (1.0 + ratio**exponent) ** (1.0 / exponent)


@compiled
def factors(functions, log_ratios, count, ratios, out):
    """R, R_min, T/T_0 and damping (n, k, 4) of contacts by `rising` functions (n, ROWS, m) at
    ratios (n, k), linear in ln g, c, s between even nodes.
    """
    step = log_ratios[1] - log_ratios[0]
    for n in range(ratios.shape[0]):
        own = functions[n]
        for k in range(ratios.shape[1]):
            at = np.log(ratios[n, k])
            inside = min(max(at, log_ratios[0]), log_ratios[count - 1])
            first = min(int((inside - log_ratios[0]) / step), count - 2)
            share = (inside - log_ratios[first]) / (log_ratios[first + 1] - log_ratios[first])
            exponent = gain = moment = damping = 0.0
            for j in range(2):
                node = first + j
                weight = share if j == 1 else 1.0 - share
                film = own[FILM, node]
                exponent += weight * _exponent(film, log_ratios[node], own[EXPONENT, node])
                gain += weight * (own[MINIMUM, node] - film) / -np.expm1(film)
                moment += weight * own[MOMENT, node]
                damping += weight * own[DAMPING, node]
            film = film_factor(ratios[n, k], np.exp(exponent))
            beyond = at - inside
            out[n, k, 0] = film
            out[n, k, 1] = min(film * np.exp((1.0 - film) * gain), 1.0)
            out[n, k, 2] = _beyond(1.0 / (1.0 + np.exp(-moment)), beyond)
            out[n, k, 3] = _beyond(damping, beyond)
