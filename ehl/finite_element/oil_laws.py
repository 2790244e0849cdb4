"""Density, viscosity and reduced pressure of the oil over pressure."""

from collections.abc import Callable
from functools import lru_cache

import numpy as np
from scipy.interpolate import make_interp_spline

from ..arrays import Array
from ..oil import _kernels
from ..oil.lubricant import Lubricant, density, log_viscosity_ratio
from ..scaling import ScaledContact

# of the laws without closed form: pressures over p_h up to which they are tabulated, beyond which
# they stay; 200 or 800 samples change the films by less than 1e-6
LARGEST_PRESSURE = 4.0
SAMPLES = 401
# of the reduced pressure, which bends within 1/alpha: a tenth of that at alpha p_h = 200
REDUCED_SAMPLES = 8001

# rho/rho_0, its derivative by P, and ln(eta/eta_0) [-]
Laws = tuple[Array, Array, Array]
OilLaws = Callable[[Array], Laws]  # of P


def oil_laws(contact: ScaledContact) -> OilLaws:
    """Density and viscosity as functions of the pressure P = p/p_h >= 0.

    Parameters
    ----------
    contact : ScaledContact
        the dimensionless contact

    Returns
    -------
    OilLaws
        function of P; it returns rho/rho_0, its derivative by P and ln(eta/eta_0) [-]
    """
    if contact.oil is None:
        return lambda P: _closed_forms(contact, P)
    return tabulated_laws(contact.oil, contact.hertz_pressure)


def _closed_forms(contact: ScaledContact, P: Array) -> Laws:
    """1 + d1 P/(1 + d2 P), Dowson and Higginson (1966); s [(1 + q P)^z - 1], Roelands (1966),
    Barus z = 1, isoviscous s = 0.
    """
    constants = contact.density_numerator, contact.density_denominator
    rho = _kernels.dowson_higginson(P, *constants)
    rho_P = _kernels.dowson_higginson_slope(P, *constants)
    rise = _kernels.roelands_rise(contact.viscosity_pressure * P, contact.viscosity_exponent)
    return rho, rho_P, contact.viscosity_slope * (rise - 1.0)


@lru_cache(maxsize=16)
def tabulated_laws(oil: Lubricant, hertz_pressure: float) -> OilLaws:
    """The laws of any oil, interpolated by splines of order 5 with continuous curvature.

    Parameters
    ----------
    oil : Lubricant
        the lubricant
    hertz_pressure : float
        p_h [Pa]

    Returns
    -------
    OilLaws
        function of P; it returns rho/rho_0, its derivative by P and ln(eta/eta_0) [-]
    """
    P = np.linspace(0.0, LARGEST_PRESSURE, SAMPLES)
    pressure = hertz_pressure * P
    rho = make_interp_spline(P, density(pressure, oil) / density(0.0, oil), k=5)
    rho_P = rho.derivative()
    log_eta = make_interp_spline(P, log_viscosity_ratio(pressure, oil), k=5)

    def laws(P: Array) -> Laws:
        at = np.minimum(P, LARGEST_PRESSURE)
        return rho(at), rho_P(at), log_eta(at)

    return laws


@lru_cache(maxsize=16)
def reduced_pressure(contact: ScaledContact) -> Callable[[Array], Array]:
    """Integral of rho/eta over the pressure P >= 0, both over ambient values: spline of order 5.

    Parameters
    ----------
    contact : ScaledContact
        the dimensionless contact

    Returns
    -------
    Callable[[Array], Array]
        function of P, Q of P [-]
    """
    P = np.linspace(0.0, LARGEST_PRESSURE, REDUCED_SAMPLES)
    rho, _, log_eta = oil_laws(contact)(P)
    spline = make_interp_spline(P, rho * np.exp(-log_eta), k=5)
    integral = spline.antiderivative()
    last = float(spline(LARGEST_PRESSURE))

    def reduced(P: Array) -> Array:
        inside = np.minimum(P, LARGEST_PRESSURE)
        return np.asarray(integral(inside) + last * (P - inside))

    return reduced
