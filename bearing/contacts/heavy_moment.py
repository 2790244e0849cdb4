"""Moment that resists rolling in a heavily loaded contact, by a formula that needs no kernels."""

from math import pi

import scipy

from ehl.conditions import ContactConditions


def rolling_moment(conditions: ContactConditions, semi_axis_y: float, semi_axis_x: float) -> float:
    """Moment that resists rolling in a lubricated contact [N m], Biboulet and Houpert (2010),
    elastohydrodynamic limit; its power is the moment times the rolling speed u_m/Rx.

    Twice t = 1.8 beta^(-1/4) (2 a_y/Rx) (2 U)^(3/4) E' Rx^3, beta = (4/pi) E(m)/(1 + Rx/Ry), m = 1
    - (a_x/a_y)^2, with the Hertz semi-axes across and along rolling [m]. t is Rx times the force
    that the pressure flow pulls one body with; both are pulled (checked against solved contacts).
    """
    c = conditions
    speed = c.lubricant.viscosity * c.entrainment_speed / (c.reduced_modulus * c.radius_x)
    shape = min(semi_axis_x, semi_axis_y) / max(semi_axis_x, semi_axis_y)
    beta = 4.0 / pi * float(scipy.special.ellipe(1.0 - shape**2)) / (1.0 + c.radius_x / c.radius_y)
    width = 2.0 * semi_axis_y / c.radius_x
    return 3.6 * beta**-0.25 * width * (2.0 * speed) ** 0.75 * c.reduced_modulus * c.radius_x**3
