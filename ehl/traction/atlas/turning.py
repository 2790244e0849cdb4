"""Effect of a rotation of the entrainment on films."""

from math import exp, inf
from typing import NamedTuple

from .table import LIGHT

# speed at the end of the ellipse by a rotation of the entrainment, over u_m, up to which the table
# counts
ROTATION = 0.02
ROTATION_WIDE = 0.65  # what the minimum film's bar grows by over it, Rx/Ry above `SLIM`
SLIM = 0.1  # Rx/Ry up to which ellipses are as those of ball bearings
# There it lowers the minimum film by 1 - exp(-k t^2), and moves the central one by some t^2: 80
# contacts solved with and without, k 0.5 to 2.4, seven light ones, k 0.03 to 1.3
# (`docs/theory/film_atlas.md`)


class Turning(NamedTuple):
    """Effect of a rotation on films in slim ellipses [-]."""

    load: float  # A up to which it counts
    ratio: float  # Rx/Ry up to which it counts
    largest: float  # t up to which contacts were solved
    minimum: float  # k
    minimum_error: float  # of k
    central_error: float  # over t^2


TURNING = (
    Turning(LIGHT, SLIM, 0.15, 0.65, 0.65, 0.12),
    Turning(inf, 0.06, 0.42, 1.0, 0.65, 0.03),
    Turning(inf, SLIM, 0.42, 1.65, 0.85, 0.03),
)


def rotation_law(load: float, ratio: float) -> Turning | None:
    """Give the effect of a rotation at a load and an ellipse.

    Parameters
    ----------
    load : float
        A of the contact [-]
    ratio : float
        Rx/Ry [-]

    Returns
    -------
    Turning | None
        coefficients; None in wide ellipses
    """
    return next((law for law in TURNING if load < law.load and ratio <= law.ratio), None)


def rotation_effect(load: float, ratio: float, turning: float) -> tuple[float, float, float]:
    """Evaluate the effect of a rotation of the entrainment on both films.

    Parameters
    ----------
    load : float
        A of the contact [-]
    ratio : float
        Rx/Ry [-]
    turning : float
        speed at the end of the ellipse by the rotation, over u_m [-]

    Returns
    -------
    minimum
        factor on the minimum film [-]
    minimum_error
        its error [-]
    central_error
        relative error of the central film [-]
    """
    law = rotation_law(load, ratio)
    if law is None:
        return 1.0, ROTATION_WIDE * turning, TURNING[0].central_error * turning**2
    square = turning**2
    lowered = exp(-law.minimum * square)
    return lowered, law.minimum_error * square, law.central_error * square
