"""Internal geometry that follows from boundary dimensions alone, and what bearings have in common:
sizes of balls, conformities of grooves, and how far these differ between makers.
"""

from math import asin, degrees, floor, pi

INCH = 25.4e-3  # [m]
# between ball sizes below and above FINE_LARGEST [m]
FINE_STEP = INCH / 64.0
COARSE_STEP = INCH / 32.0
FINE_LARGEST = 18.0 * FINE_STEP  # 9/32 inch [m]
METRIC = (3.5e-3,)  # of thin bearings: 6804 to 6807 [m]
FEWEST_BALLS = 5
INNER_CONFORMITY = 0.515  # groove radius over ball diameter, assumed [-]
OUTER_CONFORMITY = 0.525
# range of the bearings with published ones [-]
INNER_CONFORMITY_RANGE = (0.51, 0.525)
OUTER_CONFORMITY_RANGE = (0.515, 0.53)
ANGLE_RANGE = 3.0  # around a nominal contact angle, unverified [deg]
# D over D_o - d, mean of the catalogue's, and the same of the pitch circle that balls fill over
# the contact angle [deg]: docs/user/libraries.md [-]
TYPICAL_BALL = 0.30
# largest D over the width that is guessed: 261 of the catalogue's 262 bearings with ratings lie
# below, the 6322 has 0.83 [-]
WIDEST_BALL = 0.80
TYPICAL_FILL = ((0.0, 0.60), (15.0, 0.78), (40.0, 0.86))
# ranges of such an estimate, over the estimate: docs/user/libraries.md [-]
TYPICAL_BALL_RANGE = (0.80, 1.15)
TYPICAL_BALLS_RANGE = 0.2
TYPICAL_PITCH_RANGE = 0.02


def ball_sizes(smallest: float, largest: float) -> tuple[float, ...]:
    """Standard ball diameters in an interval.

    Steps of 1/64 inch up to 9/32 inch, of 1/32 inch beyond, and 3.5 mm.

    Parameters
    ----------
    smallest, largest : float
        ends of the interval [m]

    Returns
    -------
    tuple[float, ...]
        diameters, rising [m]
    """
    fine = [i * FINE_STEP for i in range(1, round(FINE_LARGEST / FINE_STEP) + 1)]
    first = round(FINE_LARGEST / COARSE_STEP) + 1
    coarse = [i * COARSE_STEP for i in range(first, floor(largest / COARSE_STEP) + 2)]
    return tuple(size for size in sorted((*fine, *METRIC, *coarse)) if smallest <= size <= largest)


def full_complement(ball_diameter: float, pitch_diameter: float) -> int:
    """Number of balls that fit on the pitch circle without a cage.

    Parameters
    ----------
    ball_diameter : float
        D [m]
    pitch_diameter : float
        d_m [m]

    Returns
    -------
    int
        number of balls [-]
    """
    return floor(pi / asin(ball_diameter / pitch_diameter) + 1e-9)


def typical_geometry(
    bore: float, outside_diameter: float, contact_angle: float, width: float | None = None
) -> tuple[float, float, int]:
    """Ball diameter, pitch diameter and number of balls from the boundary dimensions: a rough
    guess.

    D = 0.30 (D_o - d), or 0.80 of a smaller width, the nearest standard size;
    Z = fill pi/asin(D/d_m), with the part of the pitch circle that the balls of the catalogue's
    bearings fill, linear in the contact angle between deep groove, 15 and 40 degrees.

    Parameters
    ----------
    bore, outside_diameter : float
        boundary dimensions [m]
    contact_angle : float
        nominal contact angle [rad]
    width : float | None, optional
        width [m]; None: the section alone decides

    Returns
    -------
    ball_diameter
        D [m]
    pitch_diameter
        d_m [m]
    balls
        Z [-]
    """
    target = TYPICAL_BALL * (outside_diameter - bore)
    if width is not None:
        target = min(target, WIDEST_BALL * width)
    pitch = 0.5 * (bore + outside_diameter)
    sizes = ball_sizes(0.5 * target, 1.5 * target) or (target,)
    ball = min(sizes, key=lambda size: abs(size - target))
    return ball, pitch, typical_number(ball, pitch, contact_angle)


def typical_number(ball_diameter: float, pitch_diameter: float, contact_angle: float) -> int:
    """Number of balls that is typical of their diameter on a pitch circle.

    Parameters
    ----------
    ball_diameter : float
        D [m]
    pitch_diameter : float
        d_m [m]
    contact_angle : float
        nominal contact angle [rad]

    Returns
    -------
    int
        number of balls [-]
    """
    fill = _fill(degrees(contact_angle))
    balls = round(fill * pi / asin(ball_diameter / pitch_diameter))
    return max(FEWEST_BALLS, min(balls, full_complement(ball_diameter, pitch_diameter)))


def _fill(angle: float) -> float:
    """Share of the pitch circle that balls fill, over the contact angle [deg]."""
    (a0, f0), (a1, f1), (a2, f2) = TYPICAL_FILL
    if angle <= a1:
        return f0 + (f1 - f0) * (angle - a0) / (a1 - a0)
    return f1 + (f2 - f1) * (min(angle, a2) - a1) / (a2 - a1)
