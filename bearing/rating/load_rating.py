"""Load ratings from the geometry, ISO 281 and ISO 16281 (`life` says what was read), and the
thermal reference speed, ISO 15312:2018 (read in a public program's transcription).

Reference speed: under a radial load of 5 % of C_0r, with an oil of 12 mm^2/s at 70 C in a bath and
20 C around, friction is what the seats take:

    (pi n/30000) [1e-7 f_0r (nu n)^(2/3) d_m^3 + f_1r P_1r d_m] = q_r A_r,   A_r = pi B (D + d)

in N, mm, W, r/min, with q_r = 0.016 W/mm^2 up to A_r = 50 000 mm^2 and 0.016 (A_r/50 000)^-0.34
above.
"""

from dataclasses import replace
from math import cos, degrees, pi

import numpy as np
import scipy

from oilfilm.ehl.closed_form.hertz import hertz_contact
from oilfilm.ehl.units import MILLIMETRE, RPM

from ..geometry import Bearing, Race, contact_modulus, reduced_radii
from ..operation import RatingInput

RATING_FACTOR = 1.3  # b_m of deep groove and angular contact ball bearings, ISO 281 [-]
# scale of Lundberg and Palmgren's form that passes five points of ISO 281's table within their
# rounding (tests), N and mm
F_C_SCALE = 38.2
# to which the form is used [-]
SMALLEST_GAMMA = 0.01
LARGEST_GAMMA = 0.40
F_C_CONFORMITY = 0.52  # of both grooves, with which it passes them [-]
# conformities of inner and outer groove that f_c is for; wider ones carry less [-]
LARGEST_CONFORMITIES = (0.52, 0.53)
STATIC_PRESSURE = 4.2e9  # Hertz pressure at the static rating of ball bearings, ISO 76 [Pa]
# heaviest ball load over the mean one, F/(Z cos alpha), of a radially loaded bearing [-]
STRIBECK = 5.0
STATIC_FACTORS_RADIAL = (0.6, 0.5)  # X_0, Y_0 at a nominal contact angle of zero [-]
STATIC_ANGLES = (15.0, 25.0, 40.0)  # [deg]
STATIC_FACTORS_AXIAL = (0.46, 0.38, 0.26)  # Y_0 there, with X_0 = 0.5 [-]
LARGE_BALL = 25.4e-3  # balls above this diameter follow another power [m]
FATIGUE_PRESSURE = 1.5e9  # Hertz pressure at the fatigue limit of bearing steel [Pa]
ROUNDING = 5e-5  # of a conformity computed from rounded lengths [-]

VISCOSITY = 12.0  # [mm^2/s]
LOAD_SHARE = 0.05  # P_1r over C_0r [-]
HEAT_FLOW = 0.016  # [W/mm^2]
LARGE_SEAT = 5.0e4  # [mm^2]
# f_0r and f_1r by the series of SKF's friction model, Annex A as in makers' catalogues (from
# memory, unverified)
FACTORS = {
    "618": (1.7, 1.0e-4),
    "628": (1.7, 1.0e-4),
    "60": (1.7, 1.5e-4),
    "619": (1.7, 1.5e-4),
    "160": (1.7, 1.5e-4),
    "62": (2.0, 2.0e-4),
    "63": (2.3, 2.0e-4),
    "64": (2.3, 2.0e-4),
    "72": (2.0, 2.5e-4),
    "73": (3.0, 3.5e-4),
}
FASTEST = 1.0e7  # where the search ends [r/min]


def _gamma(bearing: Bearing, contact_angle: float) -> float:
    """D cos(alpha)/d_m [-]."""
    return bearing.ball_diameter * cos(contact_angle) / bearing.pitch_diameter


def geometry_not_rated(bearing: Bearing, contact_angle: float) -> str:
    """Reason why `dynamic_rating` does not hold for a geometry, or empty.

    Parameters
    ----------
    bearing : Bearing
        geometry of the row
    contact_angle : float
        nominal contact angle [rad]

    Returns
    -------
    str
        reason, for a message
    """
    gamma = _gamma(bearing, contact_angle)
    if not SMALLEST_GAMMA <= gamma <= LARGEST_GAMMA:
        text = f"D cos(alpha)/d_m = {gamma:.3g} lies outside the range of the factors f_c"
        return f"{text}: give basic_dynamic_rating_kN"
    return ""


def wide_grooves(bearing: Bearing) -> bool:
    """Check whether a groove is wider than those f_c is for, which lowers the rating.

    Parameters
    ----------
    bearing : Bearing
        geometry of the row

    Returns
    -------
    bool
        true if inner or outer groove is wider
    """
    inner, outer = (conformity + ROUNDING for conformity in LARGEST_CONFORMITIES)
    return bearing.inner_conformity > inner or bearing.outer_conformity > outer


def factor_f_c(gamma: float) -> float:
    """f_c of the dynamic rating of radial ball bearings (N, mm), Lundberg and Palmgren (1947), ISO
    281.

    Their form with both grooves 0.52 D wide and one scale passes the five points of the standard's
    table at hand within their rounding.

    Parameters
    ----------
    gamma : float
        D cos(alpha)/d_m, 0.01 to 0.40 [-]

    Returns
    -------
    float
        f_c [-]
    """
    return F_C_SCALE * lundberg_palmgren(gamma, F_C_CONFORMITY, F_C_CONFORMITY)


def lundberg_palmgren(gamma: float, inner: float, outer: float) -> float:
    """Shape of the capacity over geometry, Lundberg and Palmgren (1947).

    [1 + T^(10/3)]^-0.3 g^0.3 (1 - g)^1.39/(1 + g)^(1/3) [2 f_i/(2 f_i - 1)]^0.41 with
    T = 1.04 [(1 - g)/(1 + g)]^1.72 [f_i (2 f_e - 1)/(f_e (2 f_i - 1))]^0.41.

    Parameters
    ----------
    gamma : float
        g = D cos(alpha)/d_m [-]
    inner, outer : float
        conformities of the grooves, radius over ball diameter [-]

    Returns
    -------
    float
        capacity over that of a scale [-]
    """
    grooves = inner * (2.0 * outer - 1.0) / (outer * (2.0 * inner - 1.0))
    ratio = 1.04 * ((1.0 - gamma) / (1.0 + gamma)) ** 1.72 * grooves**0.41
    shape = gamma**0.3 * (1.0 - gamma) ** 1.39 / (1.0 + gamma) ** (1.0 / 3.0)
    return float(
        (1.0 + ratio ** (10.0 / 3.0)) ** -0.3 * shape * (2.0 * inner / (2.0 * inner - 1.0)) ** 0.41
    )


def groove_factor(bearing: Bearing, contact_angle: float) -> float:
    """Capacity with the bearing's grooves over that with the widest f_c is for; 1 unless wider.

    Parameters
    ----------
    bearing : Bearing
        geometry of the row
    contact_angle : float
        nominal contact angle [rad]

    Returns
    -------
    float
        factor on f_c [-]
    """
    gamma = _gamma(bearing, contact_angle)
    inner, outer = LARGEST_CONFORMITIES
    wider = (max(bearing.inner_conformity, inner), max(bearing.outer_conformity, outer))
    return lundberg_palmgren(gamma, *wider) / lundberg_palmgren(gamma, inner, outer)


def dynamic_rating(bearing: Bearing, contact_angle: float) -> float:
    """Basic dynamic radial load rating of one row, ISO 281.

    C_r = 1.3 f_c (cos alpha)^0.7 Z^(2/3) D^1.8, and 3.647 D^1.4 for D^1.8 above 25.4 mm (in mm).
    For grooves wider than f_c is for it is lowered as the theory behind f_c says
    (`groove_factor`).

    Parameters
    ----------
    bearing : Bearing
        geometry of the row
    contact_angle : float
        nominal contact angle alpha [rad]

    Returns
    -------
    float
        C_r [N]
    """
    diameter = bearing.ball_diameter / MILLIMETRE
    power = diameter**1.8 if bearing.ball_diameter <= LARGE_BALL else 3.647 * diameter**1.4
    f_c = factor_f_c(_gamma(bearing, contact_angle)) * groove_factor(bearing, contact_angle)
    return RATING_FACTOR * f_c * cos(contact_angle) ** 0.7 * bearing.balls ** (2.0 / 3.0) * power


def capacity(bearing: Bearing, rating: RatingInput) -> float:
    """C_r of one row as prescribed, or from the geometry.

    Parameters
    ----------
    bearing : Bearing
        geometry of the row
    rating : RatingInput
        ratings of the catalogue

    Returns
    -------
    float
        C_r [N]
    """
    return rating.dynamic_rating or dynamic_rating(bearing, rating.nominal_contact_angle)


def ball_ratings(bearing: Bearing, capacity: float, contact_angle: float) -> tuple[float, float]:
    """Dynamic ratings of the balls on inner and outer ring Q_ci, Q_ce, ISO 16281.

    Q_ci = C_r/(0.407 Z cos alpha) (1 + T^(10/3))^0.3, Q_ce = C_r/(0.389 Z cos alpha) (1 +
    T^(-10/3))^0.3, T = 1.044 ((1 - g)/(1 + g))^1.72 [r_i (2 r_e - D)/(r_e (2 r_i - D))]^0.41, g =
    D cos alpha/d_m. One transcription has (cos alpha)^0.7; the theory of Lundberg and Palmgren
    supports the first power.

    Parameters
    ----------
    bearing : Bearing
        geometry of the row
    capacity : float
        C_r of the row [N]
    contact_angle : float
        nominal contact angle alpha [rad]

    Returns
    -------
    inner
        Q_ci [N]
    outer
        Q_ce [N]
    """
    diameter = bearing.ball_diameter
    inner = bearing.inner_groove_radius
    outer = bearing.outer_groove_radius
    gamma = _gamma(bearing, contact_angle)
    grooves = inner * (2.0 * outer - diameter) / (outer * (2.0 * inner - diameter))
    ratio = 1.044 * ((1.0 - gamma) / (1.0 + gamma)) ** 1.72 * grooves**0.41
    per_ball = capacity / (bearing.balls * cos(contact_angle))
    inner_rating = per_ball / 0.407 * (1.0 + ratio ** (10.0 / 3.0)) ** 0.3
    return inner_rating, per_ball / 0.389 * (1.0 + ratio ** (-10.0 / 3.0)) ** 0.3


def fatigue_load_limit(bearing: Bearing, contact_angle: float) -> float:
    """C_u, ISO 281: 0.2288 Z min(Q_ui, Q_ue) cos alpha, times (100/d_m)^0.5 above d_m = 100 mm.

    Q_u: ball load at a Hertz pressure of 1500 MPa, with the moduli of the bearing's own materials.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    contact_angle : float
        nominal contact angle alpha [rad]

    Returns
    -------
    float
        C_u [N]
    """
    limits = load_at_pressure(bearing, contact_angle, FATIGUE_PRESSURE)
    size = min(1.0, (0.1 / bearing.pitch_diameter) ** 0.5)
    return 0.2288 * bearing.balls * min(limits) * cos(contact_angle) * size


def static_rating(bearing: Bearing, contact_angle: float) -> float:
    """Basic static radial load rating after the definition of ISO 76: 4200 MPa at the heaviest
    contact.

    C_0r = Z cos(alpha) min(Q_i, Q_e)/5, Q the ball load at 4200 MPa on grooves of 0.52 D (inner)
    and 0.53 D (outer) or wider, 5 the heaviest over the mean ball load after Stribeck. The
    standard's table of f_0 was not read.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    contact_angle : float
        nominal contact angle alpha [rad]

    Returns
    -------
    float
        C_0r [N]
    """
    inner, outer = (conformity * bearing.ball_diameter for conformity in LARGEST_CONFORMITIES)
    rated = replace(
        bearing,
        inner_groove_radius=max(bearing.inner_groove_radius, inner),
        outer_groove_radius=max(bearing.outer_groove_radius, outer),
    )
    load = min(load_at_pressure(rated, contact_angle, STATIC_PRESSURE))
    return bearing.balls * cos(contact_angle) * load / STRIBECK


def load_at_pressure(
    bearing: Bearing, contact_angle: float, pressure: float
) -> tuple[float, float]:
    """Ball loads on inner and outer race at a Hertz pressure.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    contact_angle : float
        contact angle [rad]
    pressure : float
        Hertz pressure [Pa]

    Returns
    -------
    inner
        load on the inner race [N]
    outer
        load on the outer race [N]
    """
    inner, outer = (
        hertz_contact(1.0, *reduced_radii(bearing, r, contact_angle), contact_modulus(bearing, r))
        for r in Race
    )
    return (pressure / inner.pressure) ** 3, (pressure / outer.pressure) ** 3


def static_equivalent_load(radial: float, axial: float, contact_angle: float) -> float | None:
    """P_0 = max(X_0 F_r + Y_0 F_a, F_r) of one row, ISO 76.

    X_0, Y_0 are 0.6, 0.5 at zero contact angle (SKF, deep groove ball bearings); X_0 = 0.5 and Y_0
    = 0.46, 0.38, 0.26 at 15, 25, 40 degrees (LYC, angular contact ball bearings), linear between.

    Parameters
    ----------
    radial, axial : float
        magnitudes of the loads [N]
    contact_angle : float
        nominal contact angle [rad]

    Returns
    -------
    float | None
        P_0 [N]; None at angles without factors
    """
    angle = degrees(contact_angle)
    x, y = STATIC_FACTORS_RADIAL
    if angle > 0.0:
        if not STATIC_ANGLES[0] - 1e-6 <= angle <= STATIC_ANGLES[-1] + 1e-6:
            return None
        x = 0.5
        y = float(np.interp(angle, STATIC_ANGLES, STATIC_FACTORS_AXIAL))
    return max(x * radial + y * axial, radial)


def reference_speed(bearing: Bearing, static_rating: float, series: str | None) -> float | None:
    """Speed at which the seats of one row take the friction of the reference conditions.

    Parameters
    ----------
    bearing : Bearing
        geometry with bore, outside diameter and width
    static_rating : float
        C_0r [N]
    series : str | None
        series of SKF's friction model, which selects f_0r and f_1r

    Returns
    -------
    float | None
        speed [rad/s]; None if a dimension or the factors of the series are missing
    """
    factors = [FACTORS[name] for name in FACTORS if (series or "").startswith(name)]
    sizes = (bearing.bore, bearing.outside_diameter, bearing.width)
    if not factors or None in sizes:
        return None
    f_0, f_1 = factors[0]
    bore, outside, width = (float(size or 0.0) / MILLIMETRE for size in sizes)
    area = pi * width * (outside + bore)
    heat = HEAT_FLOW * area * min(1.0, (area / LARGE_SEAT) ** -0.34)
    mean = 0.5 * (bore + outside)

    def surplus(speed: float) -> float:
        viscous = 1e-7 * f_0 * (VISCOSITY * speed) ** (2.0 / 3.0) * mean**3
        load = f_1 * LOAD_SHARE * static_rating * mean
        return pi * speed / 3.0e4 * (viscous + load) - heat

    return float(scipy.optimize.brentq(surplus, 0.0, FASTEST, xtol=1e-6)) * RPM
