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

from dataclasses import dataclass, replace
from functools import cache, lru_cache
from math import exp, inf, log, log1p
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..arrays import Array, trend_terms
from ..data_files import read_arrays
from ..options import require_not_negative, require_positive
from .film import moes_film_nijenbanning
from .hertz import hertz_coefficients

FILE = Path(__file__).parent / "starvation_law.npz"
DAMPING_FILE = Path(__file__).parent / "starvation_damping.npz"
STRETCH = 3.0  # of L, ln(1 + L/3): films leave the isoviscous ones about there
NODES = 61  # of ln r, between which the functions of one contact are linear
LEAST_RISE = 1e-6  # of ln R, ln R_min and s from node to node
HALVINGS = 50
LARGEST_LOG_EXPONENT = 5.0  # ln g

EXPONENTS = (3.0, 15.0)  # gamma of a circle and of an ellipse of this ratio and more
WIDE_ELLIPSE = 8.0  # that ratio, Damiens et al. (2004) [-]
# factor on the uncertainties of a contact outside the solved ones, which takes the values of the
# nearest point inside; assumed
OUTSIDE = 4.0


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
    along: tuple[Array, ...]  # (m, n) squared steps of these from the centres, over the scale
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
    file, damping = read_arrays(FILE), read_arrays(DAMPING_FILE)
    centres = file["places"].astype(float)
    functions = [
        Function(centres, file["scales"][k], file["trends"][k], file["weights"][k])
        for k in range(3)
    ]
    of_damping = [damping[name] for name in ("scales", "trend", "weights")]
    functions.append(Function(damping["places"].astype(float), *of_damping))
    log_ratios = np.linspace(file["lower"][3], file["upper"][3], NODES)
    steps = [(log_ratios[:, None] - f.centres[:, 3]) / f.scales[3] for f in functions]
    return Table(
        functions=tuple(functions),
        log_ratios=log_ratios,
        along=tuple(step**2 for step in steps),
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
    log_ratios = tabulated.log_ratios
    x = np.empty((NODES, 4))
    x[:, :3] = np.clip(contact_point, tabulated.lower[:3], tabulated.upper[:3])
    x[:, 3] = log_ratios
    terms = trend_terms(x)
    exponent, gain, moment, damping = (
        terms @ f.trend + _radial(f, x[0, :3], along) @ f.weights
        for f, along in zip(tabulated.functions, tabulated.along, strict=True)
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


def _radial(function: Function, contact_point: Array, along: Array) -> Array:
    """k(d) of one contact at the nodes of ln r, (m, n) [-]: the steps of the contact's coordinates
    from the centres are the same at all of them.
    """
    steps = (contact_point - function.centres[:, :3]) / function.scales[:3]
    t = np.sqrt(5.0 * (along + (steps**2).sum(axis=1)))
    return np.asarray((1.0 + t * (1.0 + t / 3.0)) * np.exp(-t))


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


@dataclass(frozen=True, slots=True)
class ReductionFactor:
    """Starvation factor: value behind a layer over the flooded value, 0 to 1, of damping also
    beyond.
    """

    value: float  # [-]
    # encloses the distance to the solution in nineteen of twenty, of flooded [-]
    uncertainty: float

    def widened(self) -> "ReductionFactor":
        """The factor of a contact outside the solved ones, with wider uncertainty."""
        return ReductionFactor(self.value, OUTSIDE * self.uncertainty)

    def raised(self, by: float) -> "ReductionFactor":
        """The factor increased, to 1 at most.

        Parameters
        ----------
        by : float
            increase [-]

        Returns
        -------
        ReductionFactor
            the larger factor
        """
        return ReductionFactor(min(self.value + by, max(self.value, 1.0)), self.uncertainty)


@dataclass(frozen=True, slots=True, kw_only=True)
class StarvationFactors:
    """Starvation factors of a contact: its values behind a layer over the flooded ones."""

    central: ReductionFactor  # film at the centre
    minimum: ReductionFactor  # smallest film
    rolling_moment: ReductionFactor  # of the pressure in the solver's box
    # along the normal, of an oscillation with 0.3 u_m/a rad/s over the flooded one at the same;
    # of slower ones, which the meniscus follows, it may be negative
    damping: ReductionFactor
    inside: bool  # whether the contact lies among those that were solved for the law

    def outside(self) -> "StarvationFactors":
        """The same of a contact outside the solved ones, with wider uncertainties."""
        if not self.inside:
            return self
        return StarvationFactors(
            central=self.central.widened(),
            minimum=self.minimum.widened(),
            rolling_moment=self.rolling_moment.widened(),
            damping=self.damping.widened(),
            inside=False,
        )

    def minimum_film(self, central: float, minimum: float) -> float:
        """Smallest film of a starved contact, never above the central one.

        Parameters
        ----------
        central : float
            flooded central film [m]
        minimum : float
            flooded minimum film [m]

        Returns
        -------
        float
            starved minimum film [m]
        """
        return min(self.minimum.value * minimum, self.central.value * central)


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
    functions = curves(load_parameter, lubricant_parameter, radius_ratio)
    factors = _factors(functions, inlet_ratio)
    if flooded_ratio == inf:
        return factors
    ample = _factors(functions, flooded_ratio)
    fraction = (inlet_ratio / flooded_ratio) ** 2
    return replace(
        factors,
        central=factors.central.raised(fraction * (1.0 - ample.central.value)),
        minimum=factors.minimum.raised(fraction * (1.0 - ample.minimum.value)),
        rolling_moment=factors.rolling_moment.raised(
            fraction * (1.0 - ample.rolling_moment.value)
        ),
        damping=factors.damping.raised(fraction * (1.0 - ample.damping.value)),
    )


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
    functions = curves(load_parameter, lubricant_parameter, radius_ratio)
    nodes = functions.log_ratios
    end = log(flooded_ratio)
    # the table's nodes as far as they go, and beyond them to the flooded inlet
    farther = np.linspace(nodes[-1], end, NODES)[1:] if end > nodes[-1] else np.array([end])
    at = np.append(nodes[nodes < end], farther)
    moment = 1.0 / (1.0 + np.exp(-np.interp(at, nodes, functions.moment)))
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


def _factors(functions: Curves, inlet_ratio: float) -> StarvationFactors:
    """Starvation factors of a contact at a ratio above zero [-]."""
    at = log(inlet_ratio)
    exponent, gain, moment, damping = (
        float(np.interp(at, functions.log_ratios, values))
        for values in (functions.exponent, functions.gain, functions.moment, functions.damping)
    )
    film = starved_film_factor(inlet_ratio, exp(exponent))
    minimum = min(film * exp((1.0 - film) * gain), 1.0)
    errors = [float(np.interp(at, table().error_ratios, row)) for row in functions.errors]
    beyond = at - float(np.clip(at, functions.log_ratios[0], functions.log_ratios[-1]))
    factors = StarvationFactors(
        central=ReductionFactor(film, errors[0] * film),
        minimum=ReductionFactor(minimum, errors[1] * minimum),
        rolling_moment=ReductionFactor(_beyond(1.0 / (1.0 + exp(-moment)), beyond), errors[2]),
        damping=ReductionFactor(_beyond(damping, beyond), errors[3]),
        inside=True,
    )
    return factors if functions.inside else factors.outside()


def _beyond(factor: float, beyond: float) -> float:
    """A factor extrapolated in ln r past the ends of the table [-]: below, it falls with r; above,
    its distance from 1 does.
    """
    if beyond > 0.0:
        return 1.0 - (1.0 - factor) * exp(-beyond)
    return factor * exp(beyond)


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
    if inlet_ratio > 1.0:  # the same, so that ample oil leaves exactly 1
        return float((1.0 + inlet_ratio**-exponent) ** (-1.0 / exponent))
    return inlet_ratio / (1.0 + inlet_ratio**exponent) ** (1.0 / exponent)


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
