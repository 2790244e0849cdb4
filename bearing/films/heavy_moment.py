"""Moments that resist the rolling of heavily loaded contacts, of oil and of elastic hysteresis, by
formulas.
"""

from math import pi, sqrt

import scipy

from oilfilm.ehl.conditions import ContactConditions

from ..contacts.contact import BearingContact


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


def elastic_moment(contact: BearingContact, loss: float) -> float:
    """Moment of elastic hysteresis that resists rolling, beta_a 3/16 Q b.

    The energy stored in front of a rolling contact, of which the fraction beta_a is lost
    (Greenwood, Minshall and Tabor, 1961): 3/16 Q b is the moment of the pressure ahead of the
    centre. Its power is the moment times the rolling speed u_m/Rx.

    Parameters
    ----------
    contact : BearingContact
        contact of a bearing
    loss : float
        beta_a [-]

    Returns
    -------
    float
        moment [N m]; zero without load
    """
    if contact.hertz is None:
        return 0.0
    return loss * 3.0 / 16.0 * contact.load * contact.hertz.semi_axis_x
