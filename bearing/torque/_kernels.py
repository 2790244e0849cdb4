"""Compiled friction of many contacts by laws of `ehl.traction`, with its slope by difference quotients; SI.

Everything is arrays and floats. The twins stand in `tabulated.law_gradient`, contact by contact.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from ehl.traction._kernels import hertz_friction, table_lookup

OPTIONS = {"cache": True, "nogil": True, "fastmath": False, "error_model": "numpy"}


@njit(**OPTIONS)
def table_gradients(axes, constants, scalars, values, places, motion, step, gradient, slope):
    """Minus forces and moments (n, 4) of one table, and their slope (n, 4, 4) by sliding and spin.

    places, shape (n, 3): load, entrainment speed, rolling radius; motion (n, 4); step: of slides over the speed and of
    spin over the speed over the radius.
    """
    out, moved = np.empty(8), np.empty(3)
    for k in range(motion.shape[0]):
        load, speed, radius = places[k]
        table_lookup(axes, constants, scalars, values, load, speed, motion[k, 0], motion[k, 1], motion[k, 2], out)
        gradient[k] = -out[:4]
        slope[k] = 0.0
        for j in range(3):
            size = step * speed if j < 2 else step * speed / radius
            moved[:] = motion[k, :3]
            moved[j] += size
            table_lookup(axes, constants, scalars, values, load, speed, moved[0], moved[1], moved[2], out)
            slope[k, :, j] = -(out[:4] + gradient[k]) / size


@njit(**OPTIONS)
def hertz_gradients(disc, laws, shapes, places, motion, step, gradient, slope):
    """As `table_gradients` for coefficients over the Hertz ellipse; laws (n, m) and shapes (n, 5) a contact each."""
    out, moved = np.empty(8), np.empty(3)
    for k in range(motion.shape[0]):
        load, speed, radius = places[k]
        law, shape = laws[k], shapes[k]
        hertz_friction(disc, law, shape, load, speed, motion[k, 0], motion[k, 1], motion[k, 2], out)
        gradient[k] = -out[:4]
        slope[k] = 0.0
        for j in range(3):
            size = step * speed if j < 2 else step * speed / radius
            moved[:] = motion[k, :3]
            moved[j] += size
            hertz_friction(disc, law, shape, load, speed, moved[0], moved[1], moved[2], out)
            slope[k, :, j] = -(out[:4] + gradient[k]) / size
