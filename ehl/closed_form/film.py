r"""Closed forms for a film: its thickness by curve fits, its thermal loading, the amplitude of a
waviness.

The film formulas are starting guesses and comparisons, never oracles. All take the entrainment
along the principal direction x, smooth surfaces, a Newtonian oil and a flooded inlet; isothermal.
Distance from solved films: `docs/validation/verification.md`.

A small waviness r = Re r_a exp(i omega_x (x - u_b t) + i omega_y y) on a body of speed u_b, in a
flat film h of uniform high pressure. Hooke (2006); as printed in Morales-Espejel and Brizmer,
Tribology Transactions 54 (2011) 625:

.. math::
    \frac{p_a}{r_a} = \frac{\kappa E'}{4} \frac{i Q}{1 - i Q - i C Q}, \qquad
    v_a = \frac{4 p_a}{E' \kappa}, \qquad h_a = r_a + v_a, \\
    C = \frac{h E' \kappa}{4 B}, \qquad
    Q = \frac{48 (u_b - \bar u) \omega_x}{E' h^3 \kappa}
        \Big/ \Big( \frac{\omega_x^2}{\eta_x} + \frac{\omega_y^2}{\eta_y} \Big),

kappa the wave number, B the bulk modulus of the oil. It moves with the body; the wave that the
inlet makes, of the same frequency, is carried with the mean speed. In pure rolling Q = 0, and all
that is left is that wave, for which Venner and Lubrecht fitted A_d/A_i to their solutions.
"""

from dataclasses import dataclass
from math import exp, log, sqrt

from ..conditions import ContactConditions, moes_groups, speed_load_material
from ..oil.assumed_heat import heat_of

# a film thicker than this fraction of R_x lies in a gap that is no paraboloid: outside the model
MAX_FILM_OVER_RADIUS = 0.02

# constants of A_d/A_i = 1/(1 + c1 x + c2 x^2), Venner and Lubrecht (2000), as quoted by
# Morales-Espejel and Brizmer (2011): circular contacts, pure rolling
AMPLITUDE_FIT = (0.15, 0.015)


def film_hamrock_dowson_minimum(conditions: ContactConditions) -> float:
    """Minimum film 3.63 U^0.68 G^0.49 W^-0.073 (1 - e^(-0.68 k)), Hamrock and Dowson (1977).

    k = 1.03 (Ry/Rx)^0.64 is the ellipticity.

    Parameters
    ----------
    conditions : ContactConditions
        the contact, entrainment along x

    Returns
    -------
    float
        minimum film [m]
    """
    u, w, g = speed_load_material(conditions)
    k = 1.03 * (conditions.radius_y / conditions.radius_x) ** 0.64
    return conditions.radius_x * 3.63 * u**0.68 * g**0.49 * w**-0.073 * (1.0 - exp(-0.68 * k))


def film_hamrock_dowson_central(conditions: ContactConditions) -> float:
    """Central film 2.69 U^0.67 G^0.53 W^-0.067 (1 - 0.61 e^(-0.73 k)), Hamrock and Dowson (1977).

    Parameters
    ----------
    conditions : ContactConditions
        the contact, entrainment along x

    Returns
    -------
    float
        central film [m]
    """
    u, w, g = speed_load_material(conditions)
    k = 1.03 * (conditions.radius_y / conditions.radius_x) ** 0.64
    side_flow = 1.0 - 0.61 * exp(-0.73 * k)
    return conditions.radius_x * 2.69 * u**0.67 * g**0.53 * w**-0.067 * side_flow


def film_chittenden_central(conditions: ContactConditions) -> float:
    """Central film 4.30 U^0.68 G^0.49 W^-0.073 (1 - e^(-1.23 (Ry/Rx)^(2/3))), Chittenden et al.
    (1985).

    Reprints of the paper give 4.30 or 4.31 and 1.23, 1.28 or 1.30 in the exponent; with Ry > 3 Rx
    all agree within 2 %.

    Parameters
    ----------
    conditions : ContactConditions
        the contact, entrainment along x

    Returns
    -------
    float
        central film [m]
    """
    u, w, g = speed_load_material(conditions)
    side_flow = 1.0 - exp(-1.23 * (conditions.radius_y / conditions.radius_x) ** (2 / 3))
    return conditions.radius_x * 4.30 * u**0.68 * g**0.49 * w**-0.073 * side_flow


def film_nijenbanning_central(conditions: ContactConditions) -> float:
    """Central film after Nijenbanning, Venner and Moes (1994), see `moes_film_nijenbanning`.

    Parameters
    ----------
    conditions : ContactConditions
        the contact, entrainment along x

    Returns
    -------
    float
        central film [m]
    """
    u, _, _ = speed_load_material(conditions)
    m, l = moes_groups(conditions)
    ratio = conditions.radius_x / conditions.radius_y
    return conditions.radius_x * sqrt(2.0 * u) * moes_film_nijenbanning(m, l, ratio)


def moes_film_nijenbanning(
    load_parameter: float, lubricant_parameter: float, radius_ratio: float
) -> float:
    """Central film (h/Rx) (2U)^(-1/2) of an elliptical contact, Nijenbanning, Venner and Moes
    (1994).

    Fitted for entrainment along x and Rx/Ry <= 1.

    Parameters
    ----------
    load_parameter : float
        Moes' M, with 2U [-]
    lubricant_parameter : float
        Moes' L, with 2U [-]
    radius_ratio : float
        Rx/Ry [-]

    Returns
    -------
    float
        central film over Rx sqrt(2U) [-]
    """
    m = load_parameter
    l = max(lubricant_parameter, 1e-12)
    d = radius_ratio
    q = 1.0 + 0.006 * log(d) + 0.63 * d ** (4 / 7)
    rigid_isoviscous = 145.0 * (1.0 + 0.796 * d ** (14 / 15)) ** (-15 / 7) / d / m**2
    elastic_isoviscous = 3.18 * q ** (-14 / 25) * d ** (-1 / 15) * m ** (-2 / 15)
    rigid_piezoviscous = 1.29 * (1.0 + 0.691 * d) ** (-2 / 3) * l ** (2 / 3)
    elastic_piezoviscous = 1.48 * q ** (-7 / 20) * d ** (-1 / 24) * m ** (-1 / 12) * l**0.75
    edge = 1.8 / d
    s = 1.5 * (1.0 + exp(-1.2 * elastic_isoviscous / elastic_piezoviscous))
    isoviscous = rigid_isoviscous**1.5 + (elastic_isoviscous**-4 + edge**-4) ** (-3 / 8)
    piezoviscous = (rigid_piezoviscous**-8 + elastic_piezoviscous**-8) ** (-s / 8)
    return float((isoviscous ** (2 * s / 3) + piezoviscous) ** (1 / s))


def film_error_nijenbanning(conditions: ContactConditions) -> float:
    """Relative error of the film by the ends of an estimated pressure-viscosity coefficient.

    The larger change of the central film of `moes_film_nijenbanning`, whose lubricant parameter L
    goes with the coefficient; a film that a layer limits at the inlet changes by less.

    Parameters
    ----------
    conditions : ContactConditions
        the contact, entrainment along x

    Returns
    -------
    float
        error over the film [-]; zero of a coefficient that is known
    """
    low, high = conditions.lubricant.pressure_viscosity_ends
    if low == high or not conditions.lubricant.piezoviscous:
        return 0.0
    m, l = moes_groups(conditions)
    ratio = min(conditions.radius_x / conditions.radius_y, 1.0)
    film, least, most = (
        moes_film_nijenbanning(m, factor * l, ratio) for factor in (1.0, low, high)
    )
    return max(film - least, most - film) / film


def thermal_loading(conditions: ContactConditions) -> float:
    """Thermal loading parameter L_T = eta_0 beta u_m^2/k, k the oil's conductivity.

    Parameters
    ----------
    conditions : ContactConditions
        the contact; heat properties that its oil lacks are assumed

    Returns
    -------
    float
        L_T [-]
    """
    oil = conditions.lubricant
    heat = heat_of(oil)
    slope = heat.viscosity_temperature / heat.conductivity
    return oil.viscosity * slope * conditions.entrainment_speed**2


def film_reduction_gupta(pressure_ratio: float, loading: float, slide_roll_ratio: float) -> float:
    """Thermal reduction factor of a film, Gupta, Cheng, Zhu, Forster and Schrand (1992).

    [1 - 13.2 (p_h/E') L_T^0.42]/[1 + 0.213 (1 + 2.23 S^0.83) L_T^0.64], the film heated by the
    shear in its inlet over the isothermal one, fitted to line contacts.

    Parameters
    ----------
    pressure_ratio : float
        Hertz pressure over reduced modulus, p_h/E' [-]
    loading : float
        L_T [-]
    slide_roll_ratio : float
        S; its sign does not matter [-]

    Returns
    -------
    float
        factor on the isothermal film [-]
    """
    sliding = 1.0 + 2.23 * abs(slide_roll_ratio) ** 0.83
    return (1.0 - 13.2 * pressure_ratio * loading**0.42) / (1.0 + 0.213 * sliding * loading**0.64)


@dataclass(frozen=True, slots=True, kw_only=True)
class FlatFilm:
    """A film of uniform pressure, and the oil in it."""

    thickness: float  # h [m]
    viscosity_x: float  # eta along the sliding [Pa s]
    viscosity_y: float  # and across [Pa s]
    bulk_modulus: float  # B = rho dp/d(rho) [Pa]
    reduced_modulus: float  # E' of the bodies [Pa]


def waviness_amplitude_ratio(
    wavelengths: tuple[float, float], load: float, lubricant: float
) -> float:
    """Amplitude ratio A_d/A_i of a waviness in pure rolling, Venner's fit for circular contacts.

    Solutions of this program lie within 20 % of it at L of 10 and more, and x of 0.8 to 7; below L
    10 one variable x does not hold.

    Parameters
    ----------
    wavelengths : tuple[float, float]
        along and across the entrainment over the Hertz radius; infinite without waves [-]
    load : float
        Moes' M [-]
    lubricant : float
        Moes' L [-]

    Returns
    -------
    float
        amplitude in the film over that of the undeformed waviness [-]
    """
    along, across = wavelengths
    ratio = along / across
    lengthened = exp(1.0 - 1.0 / ratio) if ratio > 1.0 else 1.0
    x = lengthened * min(wavelengths) * sqrt(load / lubricant)
    return 1.0 / (1.0 + AMPLITUDE_FIT[0] * x + AMPLITUDE_FIT[1] * x**2)
