"""What a layer of oil at the inlet leaves of a flooded contact: films, rolling moment, damping.

`starvation_shares` is the law of this program, tabulated from its own solutions. The formulas of
others stand beside it for comparison.
"""

from dataclasses import dataclass, replace
from math import exp, inf, log

import numpy as np

from ..ranges import require_not_negative, require_positive
from .starvation_table import Curves, curves, table

EXPONENTS = (3.0, 15.0)  # gamma of a circle and of an ellipse of this ratio and more
WIDE_ELLIPSE = 8.0  # that ratio, Damiens et al. (2004) [-]
# on the uncertainties of a contact outside the solved ones, which takes the shares of the nearest
# place inside; assumed
OUTSIDE = 4.0


@dataclass(frozen=True, slots=True)
class Share:
    """A share of the flooded value, 0 to 1, of damping also beyond [-]."""

    value: float
    uncertainty: float  # encloses the distance to the solution in nineteen of twenty, of flooded

    def widened(self) -> "Share":
        """The share of a contact outside the solved ones."""
        return Share(self.value, OUTSIDE * self.uncertainty)

    def raised(self, by: float) -> "Share":
        """The share and so much more, 1 at most [-]."""
        return Share(min(self.value + by, max(self.value, 1.0)), self.uncertainty)


@dataclass(frozen=True, slots=True, kw_only=True)
class StarvationShares:
    """What a layer leaves of a flooded contact [-]."""

    central: Share  # film at the centre
    minimum: Share  # smallest film
    rolling_moment: Share  # of the pressure in the solver's own box
    # along the normal, of an oscillation with 0.3 u_m/a rad/s over the flooded one at the same;
    # of slower ones, which the meniscus follows, it may be negative
    damping: Share
    inside: bool  # whether the contact lies among those that were solved for the law

    def outside(self) -> "StarvationShares":
        """The same of a contact outside the solved ones, with wider uncertainties."""
        if not self.inside:
            return self
        return StarvationShares(
            central=self.central.widened(),
            minimum=self.minimum.widened(),
            rolling_moment=self.rolling_moment.widened(),
            damping=self.damping.widened(),
            inside=False,
        )

    def minimum_film(self, central: float, minimum: float) -> float:
        """Smallest film left of flooded films [m]: never above the central one."""
        return min(self.minimum.value * minimum, self.central.value * central)


def _same(share: float) -> StarvationShares:
    """One share of all, known exactly [-]."""
    exact = Share(share, 0.0)
    return StarvationShares(
        central=exact, minimum=exact, rolling_moment=exact, damping=exact, inside=True
    )


FLOODED = _same(1.0)
DRY = _same(0.0)


def starvation_shares(
    load_parameter: float,
    lubricant_parameter: float,
    radius_ratio: float,
    inlet_ratio: float,
    flooded_ratio: float = inf,
) -> StarvationShares:
    """Shares of the flooded films, rolling moment and damping that a layer at the inlet leaves
    [-].

    `load_parameter`, `lubricant_parameter`: Moes' M and L; `radius_ratio`: Rx/Ry, x the direction
    of the entrainment; `inlet_ratio`: r, layer on both surfaces together at ambient density over
    the oil of the flooded film, rho(p(0, 0))/rho_0 h_c; `flooded_ratio`: r of an inlet that counts
    as flooded. What the law leaves to be missing there is made up in proportion to r^2, so that no
    step is left.

    Raises
    ------
    ValueError
        If a number is negative, or M, Rx/Ry or the flooded ratio zero.
    """
    given = {"load_parameter": load_parameter, "radius_ratio": radius_ratio}
    require_positive(given, *given)
    require_not_negative({"lubricant_parameter": lubricant_parameter}, "lubricant_parameter")
    if not (inlet_ratio >= 0.0 and flooded_ratio > 0.0):
        raise ValueError(f"inlet_ratio must be zero or positive, got {inlet_ratio!r}")
    if inlet_ratio >= flooded_ratio:
        return FLOODED
    if inlet_ratio == 0.0:
        return DRY
    known = curves(load_parameter, lubricant_parameter, radius_ratio)
    shares = _shares(known, inlet_ratio)
    if flooded_ratio == inf:
        return shares
    ample = _shares(known, flooded_ratio)
    part = (inlet_ratio / flooded_ratio) ** 2
    return replace(
        shares,
        central=shares.central.raised(part * (1.0 - ample.central.value)),
        minimum=shares.minimum.raised(part * (1.0 - ample.minimum.value)),
        rolling_moment=shares.rolling_moment.raised(part * (1.0 - ample.rolling_moment.value)),
        damping=shares.damping.raised(part * (1.0 - ample.damping.value)),
    )


def _shares(known: Curves, inlet_ratio: float) -> StarvationShares:
    """Shares of a contact at a ratio above zero [-]."""
    at = log(inlet_ratio)
    exponent, gain, moment, damping = (
        float(np.interp(at, known.log_ratios, values))
        for values in (known.exponent, known.gain, known.moment, known.damping)
    )
    film = starved_share(inlet_ratio, exp(exponent))
    minimum = min(film * exp((1.0 - film) * gain), 1.0)
    errors = [float(np.interp(at, table().error_ratios, row)) for row in known.errors]
    beyond = at - float(np.clip(at, known.log_ratios[0], known.log_ratios[-1]))
    shares = StarvationShares(
        central=Share(film, errors[0] * film),
        minimum=Share(minimum, errors[1] * minimum),
        rolling_moment=Share(_beyond(1.0 / (1.0 + exp(-moment)), beyond), errors[2]),
        damping=Share(_beyond(damping, beyond), errors[3]),
        inside=True,
    )
    return shares if known.inside else shares.outside()


def _beyond(share: float, beyond: float) -> float:
    """A share so far in ln r past the end of the table, below which it falls and above which what
    is missing falls with r [-].
    """
    if beyond > 0.0:
        return 1.0 - (1.0 - share) * exp(-beyond)
    return share * exp(beyond)


def starvation_exponent(semi_axis_ratio: float) -> float:
    """gamma of a starved film [-]: 3 (circular) to 15 (wide), in proportion between to the
    logarithm of the semi-axis across the entrainment over that along it [-].

    The ends are Damiens et al.'s (2004), second hand; the interpolation is ours.
    """
    share = min(max(log(max(semi_axis_ratio, 1.0)) / log(WIDE_ELLIPSE), 0.0), 1.0)
    return EXPONENTS[0] * exp(share * log(EXPONENTS[1] / EXPONENTS[0]))


def starved_share(inlet_ratio: float, exponent: float) -> float:
    """Central film of a starved contact over the flooded one, r/(1 + r^g)^(1/g), Chevalier et al.
    (1998) [-]; r: oil layer at the inlet over the compressed flooded film [-].
    """
    if inlet_ratio > 1.0:  # the same, so that ample oil leaves exactly 1
        return float((1.0 + inlet_ratio**-exponent) ** (-1.0 / exponent))
    return inlet_ratio / (1.0 + inlet_ratio**exponent) ** (1.0 / exponent)


def rolling_share_biboulet_houpert(inlet_ratio: float) -> float:
    """Rolling moment of a starved line contact over the flooded one, (S^2 + 162.8 S)/(S^2 + 193.1
    S + 1257), Biboulet and Houpert (2010, part 1), for S >= 2 [-]; S: layer at the inlet over the
    flooded film [-].
    """
    s = inlet_ratio
    if s > 1.0:
        return (1.0 + 162.8 / s) / (1.0 + 193.1 / s + 1257.0 / s**2)
    return (s**2 + 162.8 * s) / (s**2 + 193.1 * s + 1257.0)
