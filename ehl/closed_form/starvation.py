"""Starvation factors of films, rolling moment and damping: value behind an inlet layer over the
flooded one.

`starvation_factors` is the law of this program, tabulated from its solutions; the formulas of
others are for comparison. It is four functions of x = (ln H_c, ln(1 + L/3), ln(Rx/Ry), ln r). H_c
is the flooded film by the formula of Nijenbanning, Venner and Moes (1994) over a^2/Rx, which says
how far the inlet's gap is that of the undeformed bodies. Each function is a trend of second degree
and a sum of radial functions around the solved contacts, fitted to solutions by
`tools/starvation/fit.py`:

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

from collections.abc import Sequence
from functools import cache, lru_cache
from math import exp, inf, log, log1p
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..arrays import Array, trend_terms
from ..data_files import read_arrays
from ..options import require_not_negative, require_positive
from . import _starvation_kernels as _kernels
from .film import moes_film_nijenbanning
from .hertz import hertz_coefficients
from .starvation_factors import ReductionFactor, StarvationFactors

FILE = Path(__file__).parent / "starvation_law.npz"
DAMPING_FILE = Path(__file__).parent / "starvation_damping.npz"
STRETCH = 3.0  # of L, ln(1 + L/3): films leave the isoviscous ones about there
NODES = 61  # of ln r, between which the functions of one contact are linear

EXPONENTS = (3.0, 15.0)  # gamma of a circle and of an ellipse of this ratio and more
WIDE_ELLIPSE = 8.0  # that ratio, Damiens et al. (2004) [-]


class Function(NamedTuple):
    """One of the four functions: trend and radial terms."""

    centres: Array  # (n, 4) x_i
    scales: Array  # (4,) l
    trend: Array  # (15,) of 1, x_j, x_j x_k
    weights: Array  # (n,) w


class Table(NamedTuple):
    """Contents of the files of the law [-]."""

    functions: tuple[Function, ...]
    log_ratios: Array  # (m,) nodes of ln r
    along: tuple[Array, ...]  # (n, m) five squared steps of these from the centres, over the scale
    lower: Array  # (4,) of x
    upper: Array
    # (3,) M, Rx/Ry and alpha p_h between which contacts were solved
    least: Array
    largest: Array
    error_films: Array  # (k,) ln H_c
    error_ratios: Array  # (m,) ln r
    errors: Array  # (4, k, m) of R and R_min over themselves, of T/T_0 and the damping's factor


class Curves(NamedTuple):
    """The functions of contacts at the nodes of ln r [-]."""

    functions: Array  # (n, rows, m), rows of `_starvation_kernels`
    log_films: Array  # (n,) ln H_c, inside the table
    inside: NDArray[np.bool_]  # (n,) whether the contact lies among the solved ones

    def shares(self, ratios: Array) -> Array:
        """R, R_min, T/T_0 and the damping's factor behind layers.

        Parameters
        ----------
        ratios : Array
            r, shape (n, k) [-]

        Returns
        -------
        Array
            shares of the flooded values, shape (n, k, 4) [-]
        """
        found = np.empty((*ratios.shape, 4))
        _kernels.factors(self.functions, table().log_ratios, NODES, ratios, found)
        return found


@cache
def table() -> Table:
    """The table, read once [-]."""
    file, damping = read_arrays(FILE), read_arrays(DAMPING_FILE)
    centres = file["places"].astype(float)
    functions = [
        Function(centres, file["scales"][k], file["trends"][k], file["weights"][k])
        for k in range(3)
    ]
    of_damping = [damping[name] for name in ("scales", "trend", "weights")]
    functions.append(Function(damping["places"].astype(float), *of_damping))
    log_ratios = np.linspace(file["lower"][3], file["upper"][3], NODES)
    steps = [(log_ratios - f.centres[:, 3:]) / f.scales[3] for f in functions]
    return Table(
        functions=tuple(functions),
        log_ratios=log_ratios,
        along=tuple(5.0 * step**2 for step in steps),
        **{name: file[name] for name in Table._fields[3:-1]},
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


FITTED = (_kernels.EXPONENT, _kernels.MINIMUM, _kernels.MOMENT, _kernels.DAMPING)


def curves(contacts: Array, wanted: Sequence[int] = FITTED) -> Curves:
    """The functions of contacts at the nodes of ln r.

    Parameters
    ----------
    contacts : Array
        Moes' M, L and Rx/Ry, shape (n, 3) [-]
    wanted : sequence of int
        rows of the fitted ones that are wanted; the others are zero

    Returns
    -------
    Curves
        functions, and which contacts lie among the solved ones
    """
    tabulated = table()
    places = np.array([contact_coordinates(*map(float, contact)) for contact in contacts])
    places = np.clip(places, tabulated.lower[:3], tabulated.upper[:3])
    x = np.empty((len(places), NODES, 4))
    x[..., :3] = places[:, None]
    x[..., 3] = tabulated.log_ratios
    terms = trend_terms(x.reshape(-1, 4))
    functions = np.zeros((len(places), _kernels.ROWS, NODES))
    for row, f, along in zip(FITTED, tabulated.functions, tabulated.along, strict=True):
        if row not in wanted:
            continue
        functions[:, row] = (terms @ f.trend).reshape(-1, NODES)
        for place, values in zip(places, functions[:, row], strict=True):
            _kernels.radial_sums(place, f.centres, f.scales, along, f.weights, values)
    for own in functions:
        _kernels.rising(tabulated.log_ratios, NODES, own)
    pressures = [hertz_coefficients(d)[1] * l * m ** (1.0 / 3.0) for m, l, d in contacts]
    groups = np.column_stack([contacts[:, 0], contacts[:, 2], pressures])
    inside = ((tabulated.least <= groups) & (groups <= tabulated.largest)).all(axis=1)
    return Curves(functions, places[:, 0], np.asarray(inside))


@lru_cache(maxsize=1024)
def _curves_of_one(*contact: float) -> Curves:
    """The functions of one contact by its M, L and Rx/Ry."""
    return curves(np.array([contact]))


def starvation_shares(
    contacts: Array, ratios: Array, flooded_ratios: Array
) -> tuple[Array, NDArray[np.bool_]]:
    """Films and rolling moment of contacts behind layers over the flooded ones, as
    `starvation_factors`.

    Parameters
    ----------
    contacts : Array
        Moes' M, L and Rx/Ry, shape (n, 3) [-]
    ratios : Array
        r of each contact, shape (n, k) [-]
    flooded_ratios : Array
        r of inlets that count as flooded, shape (n,) [-]

    Returns
    -------
    shares
        R, R_min and T/T_0, shape (n, k, 3) [-]
    inside
        True of contacts among those that the law was solved for, shape (n,)
    """
    law = curves(contacts, FITTED[:3])
    ends = flooded_ratios[:, None]
    plain = law.shares(np.concatenate([ratios, ends], axis=1))[..., :3]
    lack = 1.0 - plain[:, -1:]
    shares = _raised(plain[:, :-1], ((ratios / ends) ** 2)[..., None] * lack)
    return np.where((ratios >= ends)[..., None], 1.0, shares), law.inside


def _raised(shares: Array, by: Array) -> Array:
    """Shares increased, to 1 at most [-]."""
    return np.asarray(np.minimum(shares + by, np.maximum(shares, 1.0)))


def _errors(log_film: float, log_ratio: float) -> list[float]:
    """Uncertainties of a contact by its ln H_c and ln r, shape (4,) [-]."""
    tabulated = table()
    at_ratio = [
        [np.interp(log_ratio, tabulated.error_ratios, row) for row in rows]
        for rows in tabulated.errors
    ]
    return [float(np.interp(log_film, tabulated.error_films, row)) for row in at_ratio]


def _uniform(value: float) -> StarvationFactors:
    """One exact factor for all values [-]."""
    exact = ReductionFactor(value, 0.0)
    return StarvationFactors(
        central=exact, minimum=exact, rolling_moment=exact, damping=exact, inside=True
    )


FLOODED = _uniform(1.0)
DRY = _uniform(0.0)


def starvation_factors(
    load_parameter: float,
    lubricant_parameter: float,
    radius_ratio: float,
    inlet_ratio: float,
    flooded_ratio: float = inf,
) -> StarvationFactors:
    """Starvation factors: films, rolling moment and damping behind a layer over the flooded ones.

    The difference of the law from the flooded contact at `flooded_ratio` is added in proportion
    to r^2, so that no step remains.

    Parameters
    ----------
    load_parameter : float
        Moes' M [-]
    lubricant_parameter : float
        Moes' L [-]
    radius_ratio : float
        Rx/Ry, x the direction of the entrainment [-]
    inlet_ratio : float
        r, layer on both surfaces together at ambient density over the oil of the flooded film,
        rho(p(0, 0))/rho_0 h_c [-]
    flooded_ratio : float, default inf
        r of an inlet that counts as flooded [-]

    Returns
    -------
    StarvationFactors
        factors with their uncertainties [-]

    Raises
    ------
    ValueError
        if a number is negative, or M, Rx/Ry or the flooded ratio zero
    """
    positive = {"load_parameter": load_parameter, "radius_ratio": radius_ratio}
    require_positive(positive, *positive)
    require_not_negative({"lubricant_parameter": lubricant_parameter}, "lubricant_parameter")
    if not (inlet_ratio >= 0.0 and flooded_ratio > 0.0):
        raise ValueError(f"inlet_ratio must be zero or positive, got {inlet_ratio!r}")
    if inlet_ratio >= flooded_ratio:
        return FLOODED
    if inlet_ratio == 0.0:
        return DRY
    law = _curves_of_one(load_parameter, lubricant_parameter, radius_ratio)
    plain, ample = law.shares(np.array([[inlet_ratio, flooded_ratio]]))[0]
    values = _raised(plain, (inlet_ratio / flooded_ratio) ** 2 * (1.0 - ample))
    errors = _errors(float(law.log_films[0]), log(inlet_ratio))
    errors[0] *= float(plain[0])
    errors[1] *= float(plain[1])
    central, minimum, moment, damping = map(ReductionFactor, values.tolist(), errors)
    factors = StarvationFactors(central, minimum, moment, damping, inside=True)
    return factors if law.inside[0] else factors.outside()


def inlet_ratio_of_moment(
    load_parameter: float,
    lubricant_parameter: float,
    radius_ratio: float,
    rolling_moment: float,
    flooded_ratio: float,
) -> float:
    """Layer behind which a share of the flooded rolling moment is left: the inverse of the moment
    of `starvation_factors`.

    Parameters
    ----------
    load_parameter : float
        Moes' M [-]
    lubricant_parameter : float
        Moes' L [-]
    radius_ratio : float
        Rx/Ry, x the direction of the entrainment [-]
    rolling_moment : float
        share of the flooded moment, above zero [-]
    flooded_ratio : float
        r of an inlet that counts as flooded [-]

    Returns
    -------
    float
        r, layer over the oil of the flooded film [-]; the flooded one of a share of 1 and more
    """
    if rolling_moment >= 1.0:
        return flooded_ratio
    contact = np.array([[load_parameter, lubricant_parameter, radius_ratio]])
    law = curves(contact, (_kernels.MOMENT,))
    nodes = table().log_ratios
    end = log(flooded_ratio)
    # the table's nodes as far as they go, and beyond them to the flooded inlet
    farther = np.linspace(nodes[-1], end, NODES)[1:] if end > nodes[-1] else np.array([end])
    at = np.append(nodes[nodes < end], farther)
    moment = 1.0 / (1.0 + np.exp(-np.interp(at, nodes, law.functions[0, _kernels.MOMENT])))
    moment = 1.0 - (1.0 - moment) * np.exp(-np.maximum(at - nodes[-1], 0.0))
    shares = moment + np.exp(2.0 * (at - end)) * (1.0 - moment[-1])
    wanted = log(rolling_moment)
    below = min(wanted - log(shares[0]), 0.0)
    return exp(below + float(np.interp(wanted, np.log(shares), at)))


def rolling_moment_inlet_biboulet_houpert(rolling_moment: float) -> float:
    """S of `rolling_moment_factor_biboulet_houpert` of a moment over the flooded one.

    Parameters
    ----------
    rolling_moment : float
        share of the flooded moment, between 0 and 1 [-]

    Returns
    -------
    float
        S, layer over the flooded film [-]
    """
    left = 1.0 - rolling_moment
    linear = 162.8 - 193.1 * rolling_moment
    constant = 1257.0 * rolling_moment
    if left <= 0.0:
        return inf
    return 2.0 * constant / (linear + (linear**2 + 4.0 * left * constant) ** 0.5)


def starvation_exponent(semi_axis_ratio: float) -> float:
    """Exponent gamma of the law of Chevalier et al.: 3 (circular) to 15 (wide ellipse).

    In between in proportion to the logarithm of the ratio of semi-axes. The ends are Damiens et
    al.'s (2004), second hand; the interpolation is ours.

    Parameters
    ----------
    semi_axis_ratio : float
        semi-axis across the entrainment over that along it [-]

    Returns
    -------
    float
        gamma [-]
    """
    fraction = min(max(log(max(semi_axis_ratio, 1.0)) / log(WIDE_ELLIPSE), 0.0), 1.0)
    return EXPONENTS[0] * exp(fraction * log(EXPONENTS[1] / EXPONENTS[0]))


def starved_film_factor(inlet_ratio: float, exponent: float) -> float:
    """Central film of a starved contact over the flooded one, r/(1 + r^g)^(1/g), Chevalier et al.
    (1998).

    Parameters
    ----------
    inlet_ratio : float
        r, oil layer at the inlet over the compressed flooded film [-]
    exponent : float
        g [-]

    Returns
    -------
    float
        starvation factor of the central film [-]
    """
    return float(_kernels.film_factor(float(inlet_ratio), float(exponent)))


def rolling_moment_factor_biboulet_houpert(inlet_ratio: float) -> float:
    """Rolling moment of a starved line contact over the flooded one, Biboulet and Houpert (2010,
    part 1).

    (S^2 + 162.8 S)/(S^2 + 193.1 S + 1257), for S >= 2.

    Parameters
    ----------
    inlet_ratio : float
        S, layer at the inlet over the flooded film [-]

    Returns
    -------
    float
        starvation factor of the rolling moment [-]
    """
    s = inlet_ratio
    if s > 1.0:
        return (1.0 + 162.8 / s) / (1.0 + 193.1 / s + 1257.0 / s**2)
    return (s**2 + 162.8 * s) / (s**2 + 193.1 * s + 1257.0)
