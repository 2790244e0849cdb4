"""Compiled search for the largest sliding in ellipses."""

import numpy as np

from oilfilm.ehl.compiled import compiled
from oilfilm.ehl.oil._kernels import copy


@compiled
def largest_sliding_speeds(shapes, along, across, share, found):
    """Largest |v| [m/s] and largest v times pressure over Hertz' [m/s] in ellipses, found of shape
    (n, 2); v_x = y (c y - w), v_y = w x.

    shapes (n, 4): semi-axes along and across [m], w [rad/s], c [rad/(m s)]; along, across (m, k):
    places over the semi-axes; share (k,): pressure over Hertz'.
    """
    for n in range(shapes.shape[0]):
        a, b, turn, curved = shapes[n]
        speed = 0.0
        power = 0.0
        for i in range(along.shape[0]):
            for k in range(along.shape[1]):
                y = b * across[i, k]
                rolling = y * (curved * y - turn)
                other = a * turn * along[i, k]
                square = rolling * rolling + other * other
                speed = max(speed, square)
                power = max(power, square * share[k] * share[k])
        copy((np.sqrt(speed), np.sqrt(power)), found[n])
