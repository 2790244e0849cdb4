"""Mixed lubrication: what part of a contact's load, and of its friction, asperities carry.

The share of the load follows from lambda, the central film over the rms roughness of race and ball
together, by one of three laws: N_a/N = exp(-B lambda^C) of Zhou and Hoeprich with the constants of
bearing raceways (Wingertszahn et al., 2023, tables 4 and A2, ground, 0.16 um), 1 - erf(lambda),
fitted to the electrical contact resistance of gears (Arana et al., 2019, after Clarke, Evans and
Snidle, 2016), or Greenwood and Tripp's (1970) pressure of two rough planes over the ellipse, with
the exact integral F_5/2. They rub with a boundary coefficient, the oil carries and shears the
rest: mu = xi mu_b + (1 - xi) mu_film.

Of a wave of the roughness the film leaves A_d/A_i = 1/(1 + 0.15 x + 0.015 x^2), x = (l/a)
sqrt(M/L), l its length and a the contact's semi-axis along the rolling direction (Venner and
Lubrecht, 2000, second hand, pure rolling, waves as long as wide): long waves are flattened and
count less. Where the lengths of the roughness are given, its spectrum is weighed so.
"""

from dataclasses import dataclass
from enum import Enum
from math import erf, exp, gamma, inf, pi, sqrt

import numpy as np
import scipy

from oilfilm.ehl.conditions import moes_groups

from ..contacts.contact import BearingContact
from ..geometry import Race

RACEWAY = (2.32, 0.97)  # B and C of Zhou and Hoeprich's law [-]
FLATTENING = (0.15, 0.015)  # Venner and Lubrecht (2000)
WAVES = 64  # of a spectrum [-]
SHORTEST = 1.0e-12  # of Moes' L that a wave is weighed with [-]


class LoadSharing(Enum):
    """Laws of the share of the load on asperities."""

    ZHOU_HOEPRICH = "zhou-hoeprich"
    ARANA = "arana"
    GREENWOOD_TRIPP = "greenwood-tripp"


@dataclass(frozen=True, slots=True, kw_only=True)
class Spectrum:
    """Lengths of the waves of a rough surface, self-affine between them."""

    shortest: float  # [m]
    longest: float  # [m]
    hurst: float = 0.8  # exponent, that of many ground and lapped surfaces; assumed [-]

    def left(self, contact: BearingContact) -> float:
        """Fraction of the rms roughness that the film of a contact leaves.

        Parameters
        ----------
        contact : BearingContact
            contact of a bearing

        Returns
        -------
        float
            fraction [-]
        """
        if contact.conditions is None or contact.hertz is None:
            return 1.0
        load, lubricant = moes_groups(contact.conditions)
        lengths = np.geomspace(self.shortest, self.longest, WAVES)
        x = lengths / contact.hertz.semi_axis_x * sqrt(load / max(lubricant, SHORTEST))
        first, second = FLATTENING
        kept = 1.0 / (1.0 + first * x + second * x**2)
        # spectrum of a profile q^-(1 + 2 H), over the logarithm of the length
        weight = lengths ** (2.0 * self.hurst)
        return float(np.sqrt(np.sum(weight * kept**2) / np.sum(weight)))


@dataclass(frozen=True, slots=True, kw_only=True)
class Asperities:
    """Input of asperities that touch: rms roughness of ball and race together [m], their friction
    mu_b [-], and how they share the load.
    """

    inner_roughness: float
    outer_roughness: float
    boundary: float
    sharing: LoadSharing = LoadSharing.ZHOU_HOEPRICH
    spectrum: Spectrum | None = None  # None: no wave is flattened
    # Greenwood and Tripp: density times radius times roughness, and roughness over radius, of
    # asperities; assumed, within what is given for ground steel [-]
    density: float = 0.05
    slope: float = 0.01

    def roughness(self, race: Race) -> float:
        """Root mean square roughness of a race and the balls together.

        Parameters
        ----------
        race : Race
            inner or outer race

        Returns
        -------
        float
            roughness [m]
        """
        return self.inner_roughness if race is Race.INNER else self.outer_roughness

    def load_fraction(self, contact: BearingContact, film: float) -> float:
        """Fraction of a contact's load that asperities carry.

        Parameters
        ----------
        contact : BearingContact
            contact of a bearing
        film : float
            its central film [m]

        Returns
        -------
        float
            fraction of the load [-]
        """
        roughness = self.roughness(contact.race)
        if self.spectrum is not None:
            roughness *= self.spectrum.left(contact)
        if roughness <= 0.0:
            return 0.0
        ratio = max(film, 0.0) / roughness
        if self.sharing is LoadSharing.ZHOU_HOEPRICH:
            return zhou_hoeprich_share(ratio)
        if self.sharing is LoadSharing.ARANA:
            return asperity_share(ratio)
        return self._greenwood_tripp(contact, ratio)

    def _greenwood_tripp(self, contact: BearingContact, ratio: float) -> float:
        """Pressure of asperities (16 sqrt 2/15) pi (eta beta sigma)^2 sqrt(sigma/beta) E* F_5/2
        over the ellipse, over the load [-]; all of it where it is more.
        """
        hertz = contact.hertz
        if hertz is None or contact.load <= 0.0:
            return 0.0
        modulus = 0.5 * hertz.reduced_modulus  # E* of the two bodies
        factor = 16.0 * sqrt(2.0) / 15.0 * pi * self.density**2 * sqrt(self.slope)
        area = pi * hertz.semi_axis_x * hertz.semi_axis_y
        return min(1.0, factor * modulus * five_halves_integral(ratio) * area / contact.load)


def asperity_share(lambda_ratio: float) -> float:
    """Fraction of the load on asperities, xi = 1 - erf(lambda), Arana et al. (2019).

    Parameters
    ----------
    lambda_ratio : float
        film over the rms roughness [-]

    Returns
    -------
    float
        fraction of the load [-]

    Raises
    ------
    ValueError
        if the ratio is negative
    """
    if lambda_ratio < 0.0:
        raise ValueError(f"lambda_ratio must not be negative, got {lambda_ratio!r}")
    return 1.0 - erf(lambda_ratio)


def zhou_hoeprich_share(lambda_ratio: float) -> float:
    """Fraction of the load on asperities of raceways, exp(-B lambda^C), Zhou and Hoeprich.

    Parameters
    ----------
    lambda_ratio : float
        central film over the rms roughness [-]

    Returns
    -------
    float
        fraction of the load [-]

    Raises
    ------
    ValueError
        if the ratio is negative
    """
    if lambda_ratio < 0.0:
        raise ValueError(f"lambda_ratio must not be negative, got {lambda_ratio!r}")
    factor, power = RACEWAY
    return 0.0 if lambda_ratio == inf else exp(-factor * lambda_ratio**power)


def five_halves_integral(height: float) -> float:
    """F_5/2(h), the integral of (s - h)^(5/2) under the standard normal density from h on, by the
    parabolic cylinder function: Gamma(7/2)/sqrt(2 pi) exp(-h^2/4) D_-7/2(h).

    Parameters
    ----------
    height : float
        h, distance of the planes over the roughness [-]

    Returns
    -------
    float
        value of the integral [-]
    """
    value, _ = scipy.special.pbdv(-3.5, height)
    return float(gamma(3.5) / sqrt(2.0 * pi) * exp(-0.25 * height**2) * value)
