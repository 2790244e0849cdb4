"""What a layer of oil at the inlet leaves of a flooded contact: films and rolling moment."""

from dataclasses import dataclass
from math import exp, log

from ..ranges import require_not_negative, require_positive
from .hertz import ellipse_ratio

EXPONENTS = (3.0, 15.0)  # gamma of a circle and of an ellipse of this ratio and more
WIDE_ELLIPSE = 8.0  # that ratio, Damiens et al. (2004) [-]
LEAST_ROLLING_RATIO = 2.0  # from which Biboulet and Houpert's fit is theirs [-]
# of the film by Chevalier's formula, and of the minimum film by the same share: against solutions
# of three contacts (docs/theory/starved_contact.md) it is off by 5 and by 35 %
FORMULA_ERRORS = (0.06, 0.4)
ROLLING_ERROR = 0.5  # of Biboulet and Houpert's fit for line contacts; assumed


@dataclass(frozen=True, slots=True)
class Share:
    """A share of the flooded value, 0 to 1 [-]."""

    value: float
    uncertainty: float  # encloses the distance to the solution, as a share of flooded, too


@dataclass(frozen=True, slots=True, kw_only=True)
class StarvationShares:
    """What a layer leaves of a flooded contact [-]."""

    central: Share  # film at the centre
    minimum: Share  # smallest film
    rolling_moment: Share
    inside: bool  # whether contact and layer lie in the range that the shares are known for


def starvation_shares(
    load_parameter: float, lubricant_parameter: float, radius_ratio: float, inlet_ratio: float
) -> StarvationShares:
    """Shares of the flooded films and rolling moment that a layer at the inlet leaves [-].

    `load_parameter`, `lubricant_parameter`: Moes' M and L; `radius_ratio`: Rx/Ry, x the direction
    of the entrainment; `inlet_ratio`: r, layer on both surfaces together at ambient density over
    the oil of the flooded film, rho(p(0, 0))/rho_0 h_c.

    Raises
    ------
    ValueError
        If a number is negative, or M or Rx/Ry zero.
    """
    given = {"load_parameter": load_parameter, "radius_ratio": radius_ratio}
    require_positive(given, *given)
    given = {"lubricant_parameter": lubricant_parameter, "inlet_ratio": inlet_ratio}
    require_not_negative(given, *given)
    film = starved_share(inlet_ratio, starvation_exponent(ellipse_ratio(radius_ratio)))
    moment = rolling_share_biboulet_houpert(inlet_ratio)
    return StarvationShares(
        central=Share(film, FORMULA_ERRORS[0] * film),
        minimum=Share(film, FORMULA_ERRORS[1] * film),
        rolling_moment=Share(moment, ROLLING_ERROR * moment),
        inside=inlet_ratio >= LEAST_ROLLING_RATIO,
    )


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
