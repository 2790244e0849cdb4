"""Loads of the balls of a bearing at rest, one row between rigid rings without tilt.

It is the balance of ISO 16281 with operating contact angles, and what `solver.solve_quasistatic`
finds at zero speed, without its kernels: a quick answer does not wait for them.
"""

from collections.abc import Callable

import numpy as np

from oilfilm.ehl.arrays import Array

from ..geometry import Bearing, Race
from ..operation import Curvature
from .kinematics import stiffness_at, stiffness_series

CLOSE = 1e-13  # width of an interval over its end [-]
MOST_STEPS = 100
FIRST_STEP = 1e-6  # of the search for an interval [m]


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


def _root(surplus: Callable[[float], float]) -> float:
    """Where a function that does not fall passes zero, from zero on: false position with halved
    values at an end that stays (Illinois).
    """
    low, high = 0.0, FIRST_STEP
    below, above = surplus(low), surplus(high)
    while above < 0.0:
        low, below, high = high, above, 2.0 * high
        above = surplus(high)
    kept = 0
    middle = high
    for _ in range(MOST_STEPS):
        if below == above or high - low <= CLOSE * high:
            break
        middle = (low * above - high * below) / (above - below)
        value = surplus(middle)
        if value < 0.0:
            low, below = middle, value
            above *= 0.5 if kept < 0 else 1.0
        else:
            high, above = middle, value
            below *= 0.5 if kept > 0 else 1.0
        if value == 0.0:
            break
        kept = -1 if value < 0.0 else 1
    return middle
