"""Choices of a simulation: laws, guidance, start, loads."""

from enum import Enum


class NormalLaw(Enum):
    """Normal force of a contact, K d^n (1 + chi v/v_0), by the restitution e that fixes chi; never
    adhesive.

    HERTZ: elastic; LANKARANI_NIKRAVESH (1990): 3 (1 - e^2)/4; HUNT_CROSSLEY (1975): 3 (1 - e)/2;
    FLORES (2011): 8 (1 - e)/(5 e); LUBRICATED: film and elastic bodies in series, the film and its
    squeeze damping from the traction table (`contact._film_kernels`).
    """

    HERTZ = "hertz"
    LANKARANI_NIKRAVESH = "lankarani-nikravesh"
    HUNT_CROSSLEY = "hunt-crossley"
    FLORES = "flores"
    LUBRICATED = "lubricated"


class Guidance(Enum):
    """Guidance of the cage."""

    BALLS = "balls"
    INNER_RING = "inner ring"
    OUTER_RING = "outer ring"


class Start(Enum):
    """Start of the simulation: equilibrium, rolling on the outer race, or at rest on it."""

    QUASI_STATIC = "quasi-static"
    ROLLING = "rolling"
    REST = "rest"


class Integration(Enum):
    """Steps in time: explicit ones that resolve the vibration of balls between races, or implicit
    ones that leave it out.
    """

    EXPLICIT = "explicit"
    IMPLICIT = "implicit"


class RaceStiffness(Enum):
    """Stiffness of a ball on a race: Hertz' of the grooved race, or that of spheres of Shan et al.
    (2023), whose Eq. (12) prints the outer race with the sign of the inner one.
    """

    HERTZ = "hertz"
    PLANAR = "planar"
    PLANAR_AS_PRINTED = "planar as printed"


class LoadType(Enum):
    """Equations of motion after Ma et al. (2023), by the load.

    PLANAR: everything that moves across the axis, as Shan et al. (2023); GENERAL: every degree of
    freedom.
    """

    RADIAL = "radial"
    AXIAL = "axial"
    COMBINED = "combined"
    PLANAR = "planar"
    GENERAL = "general"
