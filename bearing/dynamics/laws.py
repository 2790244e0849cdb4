"""Numbers of the normal contact laws: damping factors, planar stiffness of a race, frequency."""

from math import sqrt

from ..geometry import Race
from .inputs import NormalLaw


def damping_factor(law: NormalLaw, restitution: float) -> float:
    """chi [-] of K d^n (1 + chi v/v_0) from the restitution e [-], see `NormalLaw`."""
    e = restitution
    factors = {
        NormalLaw.LANKARANI_NIKRAVESH: 0.75 * (1.0 - e * e),
        NormalLaw.HUNT_CROSSLEY: 1.5 * (1.0 - e),
        NormalLaw.FLORES: 1.6 * (1.0 - e) / e,
    }
    return factors.get(law, 0.0)


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
