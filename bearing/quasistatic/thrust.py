"""Balls under a thrust: approach and load in closed form."""

from collections.abc import Callable
from math import hypot, sqrt

import scipy

from .kinematics import EDGE_COSINE

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
