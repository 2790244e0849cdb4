"""Starvation factors of films, rolling moment and damping: value behind an inlet layer over the
flooded one.

`starvation_factors` is the law of this program, tabulated from its solutions. The formulas of
others are for comparison.
"""

from dataclasses import dataclass, replace
from math import exp, inf, log

import numpy as np

from ..ranges import require_not_negative, require_positive
from .starvation_table import Curves, curves, table

EXPONENTS = (3.0, 15.0)  # gamma of a circle and of an ellipse of this ratio and more
WIDE_ELLIPSE = 8.0  # that ratio, Damiens et al. (2004) [-]
# factor on the uncertainties of a contact outside the solved ones, which takes the values of the
# nearest point inside; assumed
OUTSIDE = 4.0


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
