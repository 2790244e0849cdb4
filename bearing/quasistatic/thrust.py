"""Balls without centrifugal force: under a thrust in closed form, and the loads of one row at rest
between rigid rings without tilt.

The latter is the balance of ISO 16281 with operating contact angles, which
`solver.solve_quasistatic` finds at zero speed, without its kernels: a quick answer needs none.
"""

from collections.abc import Callable
from math import hypot, sqrt

import numpy as np
import scipy

from oilfilm.ehl.arrays import Array

from ..geometry import Bearing, Race
from ..operation import Curvature
from .kinematics import EDGE_COSINE, stiffness_at, stiffness_series

CLOSE = 1e-13  # width of an interval over its end [-]
SLOPE_STEP = 1e-4  # of a displacement, for the slope there [-]
FIRST_STEP = 1e-6  # of the search for an interval [m]
MOST_STEPS = 100

X_XTOL = 1e-300  # [m]: with interference a small thrust stands at an angle as small


X_STEPS = 2000  # halvings down to that


X_RTOL = 4.0 * 2.0**-52  # the least that `brentq` takes [-]


def thrust_position(
    thrust: float, distance: float, facing: float, compliance: Callable[[float], float]
) -> float | None:
    """Axial distance x of the grooves' middles at which a ball carries a thrust.

    Parameters
    ----------
    thrust : float
        thrust of each ball, above zero [N]
    distance : float
        A, distance of the grooves' centres at first touch [m]
    facing : float
        distance of the centres of facing grooves [m]
    compliance : Callable[[float], float]
        K_i^(-2/3) + K_o^(-2/3) at a cosine of the contact angle [m/N^(2/3)]

    Returns
    -------
    float | None
        distance [m]; None if the ball would climb beyond 80 degrees, or carries the thrust at no
        angle to the last digit
    """

    def surplus(x: float) -> float:
        length = hypot(x, facing)
        approach = max(length - distance, 0.0)
        return (approach / compliance(facing / length)) ** 1.5 * x / length - thrust

    touch = sqrt(max(distance**2 - facing**2, 0.0))
    edge = facing * sqrt(1.0 / EDGE_COSINE**2 - 1.0)
    if not (touch < edge and surplus(edge) > 0.0):
        return None
    if surplus(touch) >= 0.0:  # a thrust below what rounding leaves of the approach
        return touch
    root = scipy.optimize.brentq(surplus, touch, edge, xtol=X_XTOL, rtol=X_RTOL, maxiter=X_STEPS)
    return float(root) or None


def loads_at_rest(bearing: Bearing, radial: float, axial: float) -> tuple[Array, Array]:
    """Loads and contact angles of the balls under a radial and an axial load of the inner ring.

    Q = [(L - A)/(K_i^(-2/3) + K_o^(-2/3))]^1.5, L the distance of the grooves' centres at a ball,
    F_r = sum Q cos(alpha) cos(psi), F_a = sum Q sin(alpha); rings displaced along both loads.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials of the row
    radial, axial : float
        loads, not negative, not both zero [N]

    Returns
    -------
    loads
        of the balls, shape (Z,) [N]
    angles
        contact angles, shape (Z,) [rad]
    """
    balls = _balls_at_rest(bearing)
    across = bearing.azimuth_directions[0]

    def along_at(shift: float) -> float:
        def surplus(along: float) -> float:
            load, angle = balls(shift, along)
            return float(np.sum(load * np.sin(angle))) - axial

        return _root(surplus) if axial else 0.0

    def surplus(shift: float) -> float:
        load, angle = balls(shift, along_at(shift))
        return float(np.sum(load * np.cos(angle) * across)) - radial

    shift = _root(surplus) if radial else 0.0
    return balls(shift, along_at(shift))


def stiffness_at_rest(bearing: Bearing, radial: float, axial: float) -> float:
    """Stiffness of one row at rest along a radial or an axial load of the inner ring, dF/dx.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials of the row
    radial, axial : float
        loads, one above zero, the other zero [N]

    Returns
    -------
    float
        stiffness [N/m]
    """
    balls = _balls_at_rest(bearing)
    across = bearing.azimuth_directions[0]

    def force(x: float) -> float:
        load, angle = balls(0.0, x) if axial else balls(x, 0.0)
        return float(np.sum(load * (np.sin(angle) if axial else np.cos(angle) * across)))

    position = _root(lambda x: force(x) - (axial or radial))
    step = SLOPE_STEP * position
    return (force(position + step) - force(position - step)) / (2.0 * step)


def _balls_at_rest(bearing: Bearing) -> Callable[[float, float], tuple[Array, Array]]:
    """Loads and contact angles of the balls by a radial and an axial displacement [m]."""
    series = [stiffness_series(bearing, race, Curvature.OPERATING) for race in Race]
    distance = bearing.curvature_centre_distance
    facing = distance - 0.5 * bearing.diametral_clearance
    across = bearing.azimuth_directions[0]

    def balls(shift: float, along: float) -> tuple[Array, Array]:
        gap = facing + shift * across
        length = np.hypot(gap, along)
        yields = sum(stiffness_at(one, gap / length) ** (-2.0 / 3.0) for one in series)
        load = (np.maximum(length - distance, 0.0) / yields) ** 1.5
        return load, np.arctan2(along, gap)

    return balls


def _root(surplus: Callable[[float], float]) -> float:
    """Zero of a function that does not fall, from zero on, by the Illinois method.

    It is false position in which the value at an end that stays is halved.
    """
    low = 0.0
    below = surplus(low)
    high = FIRST_STEP
    above = surplus(high)
    while above < 0.0:
        low = high
        below = above
        high = 2.0 * high
        above = surplus(high)
    middle = high
    kept = 0
    for _ in range(MOST_STEPS):
        if below == above or high - low <= CLOSE * high:
            break
        middle = (low * above - high * below) / (above - below)
        value = surplus(middle)
        if value < 0.0:
            low = middle
            below = value
            above *= 0.5 if kept < 0 else 1.0
        else:
            high = middle
            above = value
            below *= 0.5 if kept > 0 else 1.0
        kept = -1 if value < 0.0 else 1
    return middle
