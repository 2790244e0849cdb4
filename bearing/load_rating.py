"""Load ratings of a ball bearing from its geometry, after ISO 281 and ISO 16281; `life` says what was read of them."""

from __future__ import annotations

from math import cos

import numpy as np

from ehl.hertz import hertz_contact

from .geometry import Bearing, Race, contact_modulus, reduced_radii

RATING_FACTOR = 1.3  # b_m of deep groove and angular contact ball bearings, ISO 281 [-]
GAMMA_POINTS = (0.05, 0.10, 0.16, 0.19, 0.25)  # D cos(alpha)/d_m [-]
F_C_POINTS = (46.7, 55.5, 59.6, 60.0, 58.6)  # f_c there, N and mm, of grooves not wider than the next line
LARGEST_CONFORMITIES = (0.52, 0.53)  # of inner and outer groove; wider ones carry less than f_c says [-]
LARGE_BALL = 25.4e-3  # balls above this diameter follow another power [m]
FATIGUE_PRESSURE = 1.5e9  # Hertz pressure at the fatigue limit of bearing steel [Pa]
ROUNDED = 5e-5  # of a conformity computed from rounded lengths [-]
MM = 1e-3  # in SI


def geometry_not_rated(bearing: Bearing, contact_angle: float) -> str:
    """Why `dynamic_rating` does not hold for a geometry, empty if it does; the nominal contact angle in [rad]."""
    gamma = bearing.ball_diameter * cos(contact_angle) / bearing.pitch_diameter
    if not GAMMA_POINTS[0] <= gamma <= GAMMA_POINTS[-1]:
        return f"D cos(alpha)/d_m = {gamma:.3g} lies outside the factors f_c at hand: give basic_dynamic_rating_kN"
    conformities = (bearing.inner_conformity, bearing.outer_conformity)
    if any(found > most + ROUNDED for found, most in zip(conformities, LARGEST_CONFORMITIES, strict=True)):
        return (
            f"the grooves ({conformities[0]:.4g} and {conformities[1]:.4g} ball diameters) are wider than those that "
            "f_c is for (0.52 and 0.53): give basic_dynamic_rating_kN"
        )
    return ""


def factor_f_c(gamma: float) -> float:
    """f_c of the dynamic rating of radial ball bearings (N, mm), ISO 281: the quartic through five points of its table.

    Parameters
    ----------
    gamma : float
        D cos(alpha)/d_m, 0.05 to 0.25 [-].

    Returns
    -------
    float
        f_c, for newtons and millimetres.
    """
    total = 0.0
    for i, (point, value) in enumerate(zip(GAMMA_POINTS, F_C_POINTS, strict=True)):
        others = [other for j, other in enumerate(GAMMA_POINTS) if j != i]
        total += value * float(np.prod([(gamma - other) / (point - other) for other in others]))
    return total


def dynamic_rating(bearing: Bearing, contact_angle: float) -> float:
    """Basic dynamic radial load rating [N], ISO 281: C_r = 1.3 f_c (cos alpha)^0.7 Z^(2/3) D^1.8, one row.

    Parameters
    ----------
    bearing : Bearing
        Lengths in [m]; above a ball diameter of 25.4 mm, 3.647 D^1.4 instead of D^1.8 (in mm).
    contact_angle : float
        Nominal contact angle [rad].

    Returns
    -------
    float
        C_r [N].
    """
    diameter = bearing.ball_diameter / MM
    power = diameter**1.8 if bearing.ball_diameter <= LARGE_BALL else 3.647 * diameter**1.4
    f_c = factor_f_c(bearing.ball_diameter * cos(contact_angle) / bearing.pitch_diameter)
    return RATING_FACTOR * f_c * cos(contact_angle) ** 0.7 * bearing.balls ** (2.0 / 3.0) * power


def ball_ratings(bearing: Bearing, capacity: float, contact_angle: float) -> tuple[float, float]:
    """Dynamic ratings of the balls on the inner and the outer ring, ISO 16281.

    Q_ci = C_r/(0.407 Z cos alpha) (1 + T^(10/3))^0.3, Q_ce = C_r/(0.389 Z cos alpha) (1 + T^(-10/3))^0.3,
    T = 1.044 ((1 - g)/(1 + g))^1.72 [r_i (2 r_e - D)/(r_e (2 r_i - D))]^0.41, g = D cos alpha/d_m. One transcription
    has (cos alpha)^0.7; the theory of Lundberg and Palmgren supports the first power.

    Parameters
    ----------
    bearing : Bearing
    capacity : float
        C_r [N].
    contact_angle : float
        Nominal contact angle [rad].

    Returns
    -------
    tuple of float
        Q_ci and Q_ce [N].
    """
    diameter, inner, outer = bearing.ball_diameter, bearing.inner_groove_radius, bearing.outer_groove_radius
    gamma = diameter * cos(contact_angle) / bearing.pitch_diameter
    grooves = inner * (2.0 * outer - diameter) / (outer * (2.0 * inner - diameter))
    ratio = 1.044 * ((1.0 - gamma) / (1.0 + gamma)) ** 1.72 * grooves**0.41
    share = capacity / (bearing.balls * cos(contact_angle))
    inner_rating = share / 0.407 * (1.0 + ratio ** (10.0 / 3.0)) ** 0.3
    return inner_rating, share / 0.389 * (1.0 + ratio ** (-10.0 / 3.0)) ** 0.3


def fatigue_load_limit(bearing: Bearing, contact_angle: float) -> float:
    """C_u [N], ISO 281: 0.2288 Z min(Q_ui, Q_ue) cos alpha, times (100/d_m)^0.5 above d_m = 100 mm.

    Q_u is the ball load at a Hertz pressure of 1500 MPa, with the moduli of the bearing's own materials.

    Parameters
    ----------
    bearing : Bearing
    contact_angle : float
        Nominal contact angle [rad].

    Returns
    -------
    float
        C_u [N].
    """
    limits = []
    for race in Race:
        unit = hertz_contact(1.0, *reduced_radii(bearing, race, contact_angle), contact_modulus(bearing, race))
        limits.append((FATIGUE_PRESSURE / unit.pressure) ** 3)
    size = min(1.0, (0.1 / bearing.pitch_diameter) ** 0.5)
    return 0.2288 * bearing.balls * min(limits) * cos(contact_angle) * size
