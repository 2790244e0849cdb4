r"""Moment that resists rolling in a flooded, isothermal contact, by formulas.

A light contact hardly changes the gap of the bodies, h_0 + x^2/(2 Rx) + y^2/(2 Ry): there
Kapitza's (1955) pressure -K x/h^2, K = 12 eta_0 u/(3 + 2 Rx/Ry), is the solution. Its moment up to
the meniscus, where the gap is as wide as the layer that floods the contact, goes to zero as the
film goes to that layer. Under heavy loads Biboulet and Houpert's (2010) formula holds, which knows
no layer and does not vanish with the contact. Both together, with M_0 = 24 pi eta_0 u Rx^2/((3 + 2
Rx/Ry) sqrt(Rx/Ry)),

    M = M_Kapitza + M_0 f(M_Biboulet/M_0),   f(e) = (z + sqrt(z^2 + w^2))/2,   z = s e - t,

f fitted to the film atlas (`SLOPE`, `START`, `WIDTH`).
"""

from math import pi, sqrt

import scipy

from ehl.conditions import ContactConditions
from ehl.traction.rolling_moment import kapitza_moment

# s and t over Rx/Ry, linear [-]: fitted to the film atlas at 400 contacts, M 1 to 3000, L 5 to 29,
# Rx/Ry 0.02 to 1, layers of 50, 100 and 400 um (`tools/atlas/moment_formula.py`); w to solved
# contacts before
SLOPE = (0.843, -0.250)
START = (0.884, -0.330)
WIDTH = 0.06


def flooded_moment(
    conditions: ContactConditions, semi_axis_y: float, semi_axis_x: float, film: float
) -> float:
    """Moment that resists rolling, of a central film.

    Parameters
    ----------
    conditions : ContactConditions
        Of the contact.
    semi_axis_y, semi_axis_x : float
        Hertz' semi-axes across and along rolling [m].
    film : float
        Central film [m].

    Returns
    -------
    float
        Moment [N m].
    """
    kapitza = kapitza_moment(conditions, film)
    unit = moment_unit(conditions)
    heavy = heavy_moment(conditions, semi_axis_y, semi_axis_x) / unit
    return kapitza + unit * _beyond(heavy, conditions.radius_x / conditions.radius_y)


def _beyond(heavy: float, ratio: float) -> float:
    """f of M_Biboulet/M_0, Rx/Ry `ratio` [-]."""
    z = (SLOPE[0] + SLOPE[1] * ratio) * heavy - (START[0] + START[1] * ratio)
    return 0.5 * (z + sqrt(z**2 + WIDTH**2))


def moment_unit(conditions: ContactConditions) -> float:
    """M_0 of a contact.

    Parameters
    ----------
    conditions : ContactConditions
        Of the contact.

    Returns
    -------
    float
        Moment [N m].
    """
    c = conditions
    ratio = c.radius_x / c.radius_y
    shape = (3.0 + 2.0 * ratio) * sqrt(ratio)
    return 24.0 * pi * c.lubricant.viscosity * c.entrainment_speed * c.radius_x**2 / shape


def heavy_moment(conditions: ContactConditions, semi_axis_y: float, semi_axis_x: float) -> float:
    """Moment that resists rolling in a heavily loaded contact, Biboulet and Houpert (2010),
    elastohydrodynamic limit; its power is the moment times the rolling speed u_m/Rx.

    Twice t = 1.8 beta^(-1/4) (2 a_y/Rx) (2 U)^(3/4) E' Rx^3, beta = (4/pi) E(m)/(1 + Rx/Ry), m = 1
    - (a_x/a_y)^2. t is Rx times the force that the pressure flow pulls one body with; both are
    pulled (checked against solved contacts).

    Parameters
    ----------
    conditions : ContactConditions
        Of the contact.
    semi_axis_y, semi_axis_x : float
        Hertz' semi-axes across and along rolling [m].

    Returns
    -------
    float
        Moment [N m].
    """
    c = conditions
    speed = c.lubricant.viscosity * c.entrainment_speed / (c.reduced_modulus * c.radius_x)
    shape = min(semi_axis_x, semi_axis_y) / max(semi_axis_x, semi_axis_y)
    beta = 4.0 / pi * float(scipy.special.ellipe(1.0 - shape**2)) / (1.0 + c.radius_x / c.radius_y)
    width = 2.0 * semi_axis_y / c.radius_x
    return 3.6 * beta**-0.25 * width * (2.0 * speed) ** 0.75 * c.reduced_modulus * c.radius_x**3
