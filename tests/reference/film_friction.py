"""Friction of a sheared film node by node in NumPy, twin of the kernel `film_frictions`."""

import numpy as np

from oilfilm.ehl.oil.rheology import Rheology
from oilfilm.ehl.oil.shear_stress import shear_stress

STEP = 1e-5  # relative change of the rate for a difference quotient [-]


def film_friction_twin(nodes: np.ndarray, rheology: Rheology, motion: np.ndarray, least: float):
    """Gradient (4,) and slope (4, 4) of one film as the kernel, limiting stresses by the nodes' pressure."""
    area, opening, eta, pressure, x, y, height = nodes
    gap = 1.0 / opening
    along = np.stack([np.ones_like(x), np.zeros_like(x), -y, height])
    across = np.stack([np.zeros_like(x), np.ones_like(x), x, np.zeros_like(x)])
    s_x, s_y = motion @ along, motion @ across
    speed = np.sqrt(s_x**2 + s_y**2 + least**2)
    slower, stress, faster = (shear_stress(f * speed / gap, eta, pressure, rheology) for f in (1 - STEP, 1.0, 1 + STEP))
    secant = area * stress / speed
    tangent = area * (faster - slower) / (2.0 * STEP * speed)
    pull = s_x * along + s_y * across
    slope = (along * secant) @ along.T + (across * secant) @ across.T
    slope += (pull * ((tangent - secant) / speed**2)) @ pull.T
    return pull @ secant, slope
