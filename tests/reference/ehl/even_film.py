r"""Conductance of a contact with an even film, in closed form.

Each strip of the surfaces meets the other body for the time t = w(y)/u, w its
length along rolling and u the rolling speed, through a film of the conductance H = k_f/h per area.
Two half-spaces of effusivities e_1, e_2 that are brought together at t = 0 through H exchange, per
area and kelvin,

.. math:: E(t) = \frac{H}{\beta^2} \left[ e^{\beta^2 t} \mathrm{erfc}(\beta \sqrt t) - 1
          + 2 \beta \sqrt{t/\pi} \right], \qquad \beta = H (1/e_1 + 1/e_2)

(one-dimensional conduction, Carslaw and Jaeger, 1959, section 2.9 for one body), so that a contact
of semi-axes b along rolling and a across it conducts

.. math:: G = u \int_{-a}^{a} E(w(y)/u)\, dy, \qquad w = 2 b \sqrt{1 - y^2/a^2}
"""

from math import pi

import numpy as np
from scipy.special import erfcx

from oilfilm.ehl.solid.film_conductance import BETA, moving_speed

SERIES_BELOW = 1.0e-2  # of beta sqrt(t), where the closed form cancels [-]
LINES = 32  # of Gauss and Legendre across the ellipse [-]; 64 change G by 1e-9


def exchanged_heat(time, film, first, second):
    """Heat E(t) that two half-spaces exchange through a film, per area and kelvin."""
    joint = first * second / (first + second)
    root = np.sqrt(np.asarray(time, dtype=np.float64))
    z = film / joint * root
    small = np.minimum(z, SERIES_BELOW)
    # z^2 - 4 z^3/(3 sqrt(pi)) + z^4/2 - 8 z^5/(15 sqrt(pi)) of the bracket
    cubic = 4.0 / (3.0 * np.sqrt(pi)) - 0.5 * small + 8.0 / (15.0 * np.sqrt(pi)) * small**2
    series = small**2 * (1.0 - small * cubic)
    closed = erfcx(z) - 1.0 + 2.0 * z / np.sqrt(pi)
    return np.asarray(joint**2 / film * np.where(z < SERIES_BELOW, series, closed))


def film_conductance(speed, semi_axes, film, first, second):
    """Conductance G of a contact with an even film."""
    along, across = semi_axes
    u = moving_speed(speed, semi_axes, first, second)
    nodes, weights = np.polynomial.legendre.leggauss(LINES)
    angle = 0.5 * pi * nodes  # y = a sin(angle)
    length = 2.0 * along * np.cos(angle)
    exchanged = exchanged_heat(length / u, film, first.effusivity, second.effusivity)
    dy = across * np.cos(angle) * 0.5 * pi * weights
    return float(u * (exchanged @ dy))


def bare_conductance(speed, semi_axes, first, second):
    """Conductance G without a film, 2 e sqrt(2 b u/pi) a B(1/2, 5/4) with e = e_1 e_2/(e_1 + e_2)."""
    along, across = semi_axes
    joint = first.effusivity * second.effusivity / (first.effusivity + second.effusivity)
    return float(2.0 * joint * np.sqrt(2.0 * along * abs(speed) / pi) * across * BETA)
