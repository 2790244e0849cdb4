"""Density and viscosity of the oil over pressure with their first two derivatives."""

from collections.abc import Callable
from functools import lru_cache

import numpy as np
from scipy.interpolate import make_interp_spline

from ..arrays import Array
from ..oil.lubricant import Lubricant, density, log_viscosity_ratio, roelands_rise
from ..scaling import ScaledContact

# of the laws without closed form: pressures over p_h up to which they are tabulated, beyond which
# they stay; 200 or 800 samples change the films by less than 1e-6
LARGEST_PRESSURE = 4.0
SAMPLES = 401

Derivatives = tuple[Array, Array, Array]  # a function and its derivatives by P [-]
OilLaws = Callable[[Array], tuple[Derivatives, Derivatives]]  # rho/rho_0 and ln(eta/eta_0) of P


def oil_laws(contact: ScaledContact) -> OilLaws:
    """rho/rho_0 and ln(eta/eta_0) as functions of the pressure P = p/p_h >= 0 [-]."""
    if contact.oil is None:
        return lambda P: (_density(contact, P), _log_viscosity(contact, P))
    return tabulated_laws(contact.oil, contact.hertz_pressure)


def _density(contact: ScaledContact, P: Array) -> Derivatives:
    """1 + d1 P/(1 + d2 P), Dowson and Higginson (1966)."""
    n = contact.density_numerator
    base = 1.0 + contact.density_denominator * P
    return 1.0 + n * P / base, n / base**2, -2.0 * n * contact.density_denominator / base**3


def _log_viscosity(contact: ScaledContact, P: Array) -> Derivatives:
    """s [(1 + q P)^z - 1], Roelands (1966); Barus z = 1, isoviscous s = 0."""
    s, q, z = contact.viscosity_slope, contact.viscosity_pressure, contact.viscosity_exponent
    base = 1.0 + q * P
    rise = roelands_rise(q * P, z)
    first = s * z * q * rise / base
    return s * (rise - 1.0), first, (z - 1.0) * q * first / base


@lru_cache(maxsize=16)
def tabulated_laws(oil: Lubricant, hertz_pressure: float) -> OilLaws:
    """The laws of any oil, interpolated by splines of order 5 with continuous curvature; the
    pressure is p over `hertz_pressure` [Pa].
    """
    P = np.linspace(0.0, LARGEST_PRESSURE, SAMPLES)
    pressure = hertz_pressure * P
    samples = (density(pressure, oil) / density(0.0, oil), log_viscosity_ratio(pressure, oil))
    splines = [make_interp_spline(P, values, k=5) for values in samples]
    tables = [[spline.derivative(order) for order in range(3)] for spline in splines]

    def laws(P: Array) -> tuple[Derivatives, Derivatives]:
        at = np.minimum(P, LARGEST_PRESSURE)
        rho, log_eta = ((f(at), df(at), ddf(at)) for f, df, ddf in tables)
        return rho, log_eta

    return laws
