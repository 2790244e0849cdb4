"""The law of starvation as tabulated: four functions of four numbers.

These are x = (ln H_c, ln(1 + L/3), ln(Rx/Ry), ln r). H_c is the flooded film by the formula of
Nijenbanning, Venner and Moes (1994) over a^2/Rx, which says how far the inlet's gap is that of the
undeformed bodies. Each function is a trend of second degree and a sum of radial functions around
the solved contacts, fitted to solutions by `tools/starvation/fit.py`:

    f(x) = trend(x) + sum_i w_i k(|(x - x_i)/l|),   k(d) = (1 + t + t^2/3) e^-t,  t = sqrt(5) d

(a Gaussian process with Matern's kernel of 5/2). From f_1 = ln(g), f_2 = c, f_3 = s, f_4 follow

    central film       R     = r/(1 + r^g)^(1/g)
    minimum film       R_min = R exp[(1 - R) c]
    rolling moment     T/T_0 = 1/(1 + exp(-s))
    damping            f_4, at an angular frequency of 0.3 u_m/a

Chevalier's form (1998) with an exponent that depends on all four keeps R below r and 1, and leaves
the limits of little and of much oil exact. A fitted curve that falls over r, which is an error in
light contacts alone, is replaced by its largest value so far.
"""

from functools import cache, lru_cache
from math import log, log1p
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..arrays import Array
from .film import moes_film_nijenbanning
from .hertz import hertz_coefficients

FILE = Path(__file__).parent / "starvation_law.npz"
DAMPING_FILE = Path(__file__).parent / "starvation_damping.npz"
STRETCH = 3.0  # of L, ln(1 + L/3): films leave the isoviscous ones about there
NODES = 121  # of ln r, between which the functions of one contact are linear
LEAST_RISE = 1e-6  # of ln R, ln R_min and s from node to node
HALVINGS = 50
LARGEST_LOG_EXPONENT = 5.0  # ln g
PAIRS = np.triu_indices(4)


class Function(NamedTuple):
    """One of the four functions: trend and radial terms."""

    centres: Array  # (n, 4) x_i
    scales: Array  # (4,) l
    trend: Array  # (15,) of 1, x_j, x_j x_k
    weights: Array  # (n,) w


class Table(NamedTuple):
    """Contents of the files of the law [-]."""

    functions: tuple[Function, ...]
    lower: Array  # (4,) of x
    upper: Array
    # (3,) M, Rx/Ry and alpha p_h between which contacts were solved
    least: Array
    largest: Array
    error_films: Array  # (k,) ln H_c
    error_ratios: Array  # (m,) ln r
    errors: Array  # (4, k, m) of R and R_min over themselves, of T/T_0 and the damping's factor


class Curves(NamedTuple):
    """The functions of one contact over ln r, shape (n,) each [-]."""

    log_ratios: Array
    exponent: Array  # ln g
    gain: Array  # c
    moment: Array  # s
    damping: Array  # factor of the damping
    errors: Array  # (4, m) over `Table.error_ratios`
    inside: bool


@cache
def table() -> Table:
    """The table, read once [-]."""
    with np.load(FILE) as file, np.load(DAMPING_FILE) as damping:
        centres = file["places"].astype(float)
        functions = [
            Function(centres, file["scales"][k], file["trends"][k], file["weights"][k])
            for k in range(3)
        ]
        of_damping = [damping[name] for name in ("scales", "trend", "weights")]
        functions.append(Function(damping["places"].astype(float), *of_damping))
        return Table(
            functions=tuple(functions),
            lower=file["lower"],
            upper=file["upper"],
            least=file["least"],
            largest=file["largest"],
            error_films=file["error_films"],
            error_ratios=file["error_ratios"],
            errors=np.concatenate([file["errors"], damping["errors"][None]]),
        )


def contact_coordinates(load: float, lubricant: float, radius_ratio: float) -> Array:
    """Coordinates of a contact in the table: ln H_c, ln(1 + L/3) and ln(Rx/Ry).

    Parameters
    ----------
    load : float
        Moes' M [-]
    lubricant : float
        Moes' L [-]
    radius_ratio : float
        Rx/Ry [-]

    Returns
    -------
    Array
        coordinates, shape (3,) [-]
    """
    f = hertz_coefficients(radius_ratio)[0]
    film = moes_film_nijenbanning(load, lubricant, radius_ratio) / (f**2 * load ** (2.0 / 3.0))
    return np.array([log(film), log1p(lubricant / STRETCH), log(radius_ratio)])


def trend_terms(x: Array) -> Array:
    """Terms of the trend: 1, x_j and x_j x_k.

    Parameters
    ----------
    x : Array
        coordinates, shape (..., 4) [-]

    Returns
    -------
    Array
        terms, shape (..., 15) [-]
    """
    first, second = PAIRS
    ones = np.ones((*x.shape[:-1], 1))
    return np.concatenate([ones, x, x[..., first] * x[..., second]], axis=-1)


def kernel(squared: Array) -> Array:
    """Matern's kernel of 5/2 with unit variance.

    Parameters
    ----------
    squared : Array
        squared distances, any shape [-]

    Returns
    -------
    Array
        kernel, shape of `squared` [-]
    """
    t = np.sqrt(5.0 * squared)
    return np.asarray((1.0 + t + t**2 / 3.0) * np.exp(-t))


def radial(x: Array, centres: Array, scales: Array) -> Array:
    """Radial functions around the solved contacts.

    Parameters
    ----------
    x : Array
        coordinates, shape (m, 4) [-]
    centres : Array
        coordinates of the solved contacts, shape (n, 4) [-]
    scales : Array
        length of the kernel in each coordinate, shape (4,) [-]

    Returns
    -------
    Array
        values, shape (m, n) [-]
    """
    steps = (x[:, None, :] - centres[None, :, :]) / scales
    return kernel(np.einsum("ijk,ijk->ij", steps, steps))


@lru_cache(maxsize=1024)
def curves(load: float, lubricant: float, radius_ratio: float) -> Curves:
    """The four functions of one contact over ln r.

    Parameters
    ----------
    load : float
        Moes' M [-]
    lubricant : float
        Moes' L [-]
    radius_ratio : float
        Rx/Ry [-]

    Returns
    -------
    Curves
        functions, their errors, and if the contact lies among the solved ones
    """
    tabulated = table()
    contact_point = contact_coordinates(load, lubricant, radius_ratio)
    log_ratios = np.linspace(tabulated.lower[3], tabulated.upper[3], NODES)
    x = np.empty((NODES, 4))
    x[:, :3] = np.clip(contact_point, tabulated.lower[:3], tabulated.upper[:3])
    x[:, 3] = log_ratios
    exponent, gain, moment, damping = (
        trend_terms(x) @ f.trend + radial(x, f.centres, f.scales) @ f.weights
        for f in tabulated.functions
    )
    log_factor = _rising(log_film_factor(exponent, log_ratios))
    exponent = _exponents(log_factor, log_ratios, exponent)
    missing = -np.expm1(log_factor)
    log_minimum = _rising(np.minimum(log_factor + missing * gain, 0.0))
    pressure = hertz_coefficients(radius_ratio)[1] * lubricant * load ** (1.0 / 3.0)
    contact = np.array([load, radius_ratio, pressure])
    return Curves(
        log_ratios=log_ratios,
        exponent=exponent,
        gain=(log_minimum - log_factor) / missing,
        moment=_rising(moment),
        damping=damping,
        errors=_errors(tabulated, x[0, 0]),
        inside=bool(np.all(tabulated.least <= contact) and np.all(contact <= tabulated.largest)),
    )


def log_film_factor(exponent: Array, log_ratio: Array) -> Array:
    """ln R of the starvation factor R = r/(1 + r^g)^(1/g).

    Parameters
    ----------
    exponent : Array
        ln g, any shape [-]
    log_ratio : Array
        ln r, of the same shape [-]

    Returns
    -------
    Array
        ln R [-]
    """
    g = np.exp(exponent)
    return np.minimum(log_ratio, 0.0) - np.log1p(np.exp(-g * np.abs(log_ratio))) / g


def _rising(values: Array) -> Array:
    """Largest value so far, plus a small slope: a rising function."""
    slope = LEAST_RISE * np.arange(len(values))
    return np.asarray(np.maximum.accumulate(values - slope) + slope)


def _exponents(log_factor: Array, log_ratio: Array, before: Array) -> Array:
    """ln g that give ln R at ln r; those before where they do so."""
    raised = log_factor > log_film_factor(before, log_ratio) + 0.5 * LEAST_RISE
    if not raised.any():
        return before
    low = before[raised]
    high = np.full(len(low), LARGEST_LOG_EXPONENT)
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        less = log_film_factor(middle, log_ratio[raised]) < log_factor[raised]
        low, high = np.where(less, middle, low), np.where(less, high, middle)
    exponents = before.copy()
    exponents[raised] = low
    return exponents


def _errors(tabulated: Table, log_film: float) -> Array:
    """Uncertainties of a contact by its ln H_c, shape (4, m) [-]."""
    flat = tabulated.errors.transpose(0, 2, 1)
    return np.array(
        [[np.interp(log_film, tabulated.error_films, row) for row in rows] for rows in flat]
    )
