"""Moment that resists rolling, by formulas."""

from math import sqrt

from oilfilm.ehl.conditions import ContactConditions
from oilfilm.ehl.traction.rolling_moment import kapitza_moment

from .heavy_moment import heavy_moment, moment_unit

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
