"""Interval of relubrication of a grease-lubricated ball bearing.

t_f = 10 [14e6/(n sqrt(d)) - 4 d] hours, n in r/min, d the bore in mm: the closed form of makers'
diagrams for radial ball bearings that maintenance handbooks pass on (two agreeing transcriptions;
the maker's own diagram was not read). It holds for lithium grease, a horizontal shaft, clean
surroundings and 70 degrees Celsius at the outer ring; every 15 K more halve it (SKF catalogue),
less is not made use of.
"""

from math import sqrt

from ehl.units import HOUR, MILLIMETRE, RPM, ZERO_CELSIUS

BALL_BEARINGS = 10.0  # factor of radial ball bearings [-]
GRADE_TEMPERATURE = 70.0 + ZERO_CELSIUS  # up to which the interval holds [K]
HALVING = 15.0  # rise of temperature that halves it [K]
LONGEST = 30000.0  # h, beyond which a grease is taken for life; maintenance standards cap at 32000


def relubrication_interval(bore: float, speed: float, temperature: float) -> float | None:
    """Time after which grease is to be renewed.

    Parameters
    ----------
    bore : float
        bore diameter [m]
    speed : float
        speed of one ring against the other [rad/s]
    temperature : float
        temperature of the bearing [K]

    Returns
    -------
    float | None
        interval [s]; None if the formula gives none, at rest or too fast for it
    """
    if not speed:
        return None
    diameter = bore / MILLIMETRE
    hours = BALL_BEARINGS * (14e6 / (abs(speed) / RPM * sqrt(diameter)) - 4.0 * diameter)
    if hours <= 0.0:
        return None
    warm = max(0.0, temperature - GRADE_TEMPERATURE)
    return HOUR * min(LONGEST, hours) * 0.5 ** (warm / HALVING)
