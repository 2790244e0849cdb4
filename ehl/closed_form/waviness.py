r"""Amplitude of a small waviness in a lubricated contact, in closed form.

A waviness r = Re r_a exp(i omega_x (x - u_b t) + i omega_y y) on a body of speed u_b, in a flat
film h of uniform high pressure. Hooke (2006); as printed in Morales-Espejel and Brizmer, Tribology
Transactions 54 (2011) 625:

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
from math import exp, hypot, sqrt

# of A_d/A_i = 1/(1 + c1 x + c2 x^2), Venner and Lubrecht (2000), as quoted by Morales-Espejel and
# Brizmer (2011): circular contacts, pure rolling
AMPLITUDE_FIT = (0.15, 0.015)


@dataclass(frozen=True, slots=True, kw_only=True)
class FlatFilm:
    """A film of uniform pressure, and the oil in it."""

    thickness: float  # h [m]
    viscosity_x: float  # eta along the sliding [Pa s]
    viscosity_y: float  # and across [Pa s]
    bulk_modulus: float  # B = rho dp/d(rho) [Pa]
    reduced_modulus: float  # E' of the bodies [Pa]


def waviness_moving_with_body(
    film: FlatFilm, wave_numbers: tuple[float, float], slide: float
) -> tuple[complex, complex]:
    """Complex amplitudes of pressure and film of the wave that moves with its body.

    Both over the amplitude of the waviness in the gap, factors of exp(i omega_x (x - u_b t));
    Hooke (2006).

    Parameters
    ----------
    film : FlatFilm
        the flat film and its oil
    wave_numbers : tuple[float, float]
        omega_x along the entrainment and omega_y [1/m]
    slide : float
        u_b - u_m [m/s]

    Returns
    -------
    pressure
        p_a/r_a [Pa/m]
    film
        h_a/r_a [-]
    """
    x, y = wave_numbers
    kappa = hypot(x, y)
    stiffness = 0.25 * kappa * film.reduced_modulus
    resistance = x**2 / film.viscosity_x + y**2 / film.viscosity_y
    q = 12.0 * slide * x / (film.thickness**3 * stiffness * resistance)
    compressed = film.thickness * stiffness / film.bulk_modulus
    pressure = stiffness * 1j * q / (1.0 - 1j * q - 1j * compressed * q)
    return pressure, 1.0 + pressure / stiffness


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
