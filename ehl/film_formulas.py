"""Film thickness formulas from curve fits: starting guesses and comparisons, never oracles."""

from __future__ import annotations

from math import exp, log


def moes_film_nijenbanning(load_parameter: float, lubricant_parameter: float, radius_ratio: float) -> float:
    """Central film of an elliptical contact in Moes' groups, Nijenbanning, Venner and Moes (1994).

    Parameters
    ----------
    load_parameter, lubricant_parameter : float
        M and L [-], with 2U in both.
    radius_ratio : float
        Rx/Ry, entrainment along x [-]; fitted for Rx/Ry <= 1.

    Returns
    -------
    float
        (h/Rx) (2U)^(-1/2) [-].
    """
    m, l, d = load_parameter, max(lubricant_parameter, 1e-12), radius_ratio  # noqa: E741
    q = 1.0 + 0.006 * log(d) + 0.63 * d ** (4 / 7)
    rigid_isoviscous = 145.0 * (1.0 + 0.796 * d ** (14 / 15)) ** (-15 / 7) / d / m**2
    elastic_isoviscous = 3.18 * q ** (-14 / 25) * d ** (-1 / 15) * m ** (-2 / 15)
    rigid_piezoviscous = 1.29 * (1.0 + 0.691 * d) ** (-2 / 3) * l ** (2 / 3)
    elastic_piezoviscous = 1.48 * q ** (-7 / 20) * d ** (-1 / 24) * m ** (-1 / 12) * l**0.75
    edge = 1.8 / d
    s = 1.5 * (1.0 + exp(-1.2 * elastic_isoviscous / elastic_piezoviscous))
    isoviscous = rigid_isoviscous**1.5 + (elastic_isoviscous**-4 + edge**-4) ** (-3 / 8)
    piezoviscous = (rigid_piezoviscous**-8 + elastic_piezoviscous**-8) ** (-s / 8)
    return float((isoviscous ** (2 * s / 3) + piezoviscous) ** (1 / s))
