"""Normal contact laws in NumPy: damping factors, force, what an impact returns, and the planar
stiffness of a race.
"""

from math import sqrt

import numpy as np
from scipy.optimize import brentq

from ..geometry import Race
from .inputs import NormalLaw
from .problem import Array


def damping_factor(law: NormalLaw, restitution: float) -> float:
    """chi [-] of K d^n (1 + chi v/v_0) from the restitution e [-], see `NormalLaw`."""
    e = restitution
    factors = {
        NormalLaw.LANKARANI_NIKRAVESH: 0.75 * (1.0 - e * e),
        NormalLaw.HUNT_CROSSLEY: 1.5 * (1.0 - e),
        NormalLaw.FLORES: 1.6 * (1.0 - e) / e,
    }
    return factors.get(law, 0.0)


def normal_force(law: Array, approach: Array, speed: Array, impact_speed: Array) -> Array:
    """K d^n (1 + chi v/v_0), never adhesive; twin of the kernel.

    Parameters
    ----------
    law : ndarray, shape (3,)
        K [N/m^n], n [-], chi [-].
    approach, speed, impact_speed : ndarray
        d [m], v and v_0 [m/s].

    Returns
    -------
    ndarray
        [N].
    """
    elastic = law[0] * np.maximum(approach, 0.0) ** law[1]
    return np.maximum(0.0, elastic * (1.0 + law[2] * speed / impact_speed))


def restitution_returned(damping: float) -> float:
    """Speed after over speed before a free impact [-] under K d^n (1 + chi v/v_0).

    With w = v/v_0, m w dw/(1 + chi w) = -K d^n dd integrates to G(w) = w/chi - ln(1 + chi
    w)/chi^2, and the rebound follows from G(-e) = G(1), whatever n and K are.

    Parameters
    ----------
    damping : float
        chi [-].

    Returns
    -------
    float
        [-]; 0.913 for the law of Lankarani and Nikravesh at e = 0.9.
    """
    if damping == 0.0:
        return 1.0

    def potential(w: float) -> float:
        return w / damping - np.log1p(damping * w) / damping**2

    lowest = max(-1.0, -(1.0 - 1e-14) / damping)
    return -float(brentq(lambda w: potential(w) - potential(1.0), lowest, -1e-9, xtol=1e-14))


def planar_stiffness(ball_radius: float, race_radius: float, modulus: float, race: Race) -> float:
    """K of a sphere on a sphere or in a spherical hollow [N/m^1.5], Lankarani and Nikravesh
    (1990).

    K = 4/(3 pi (h_1 + h_2)) sqrt(r R/(R + r)), h = (1 - nu^2)/(pi E), and R - r at the outer race,
    whose surface is hollow; Shan et al. (2023) Eq. (12) prints the plus sign for both. With E' (2
    E*): K = (2/3) E' sqrt(...).

    Parameters
    ----------
    ball_radius, race_radius : float
        r and R [m].
    modulus : float
        E' of the pair [Pa].
    race : Race

    Returns
    -------
    float
        [N/m^1.5].
    """
    sign = 1.0 if race is Race.INNER else -1.0
    return (
        2.0 / 3.0 * modulus * sqrt(ball_radius * race_radius / (race_radius + sign * ball_radius))
    )


def planar_stiffness_as_printed(ball_radius: float, race_radius: float, modulus: float) -> float:
    """`planar_stiffness` with the plus sign at both races, as Shan et al. (2023) Eq. (12) prints
    it [N/m^1.5].
    """
    return planar_stiffness(ball_radius, race_radius, modulus, Race.INNER)


def impact_duration(stiffness: float, mass: float, speed: float) -> float:
    """Duration of an elastic Hertz impact [s], 2.943 d_max/v, d_max = (5 m v^2/(4 K))^(2/5).

    Parameters
    ----------
    stiffness, mass, speed : float
        K [N/m^1.5], [kg], [m/s].

    Returns
    -------
    float
        [s].
    """
    return 2.943 * (1.25 * mass * speed**2 / stiffness) ** 0.4 / speed


def vibration_frequency(stiffness: float, load: float, mass: float) -> float:
    """Angular frequency of a ball between two loaded races [rad/s], sqrt(2 k/m) with k = 1.5
    K^(2/3) Q^(1/3).

    Parameters
    ----------
    stiffness, load, mass : float
        K [N/m^1.5], Q [N], [kg].

    Returns
    -------
    float
        [rad/s].
    """
    return sqrt(3.0 * stiffness ** (2.0 / 3.0) * load ** (1.0 / 3.0) / mass)
