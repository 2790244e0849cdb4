"""Shear laws and their inverses in NumPy, the reference for `oilfilm.ehl.oil._kernels`."""

from math import inf

import numpy as np
from numpy.typing import ArrayLike, NDArray

from oilfilm.ehl.oil._kernels import LIMIT_POWER
from oilfilm.ehl.oil._laws import LARGEST_ARGUMENT
from oilfilm.ehl.oil.rheology import Rheology, ShearLaw, limiting_stress

Array = NDArray[np.float64]

NEWTON_STEPS = 30  # of the inversion of Carreau and Yasuda's law; it takes about five


def limiting(pressure: ArrayLike, rheology: Rheology, temperature: float) -> Array:
    """tau_L = tau_L0 + Lambda p/[1 + s (T - T_r)], at least `limiting_minimum` [Pa]; infinite if there is no limit."""
    p = np.asarray(pressure, dtype=np.float64)
    if rheology.limiting_coefficient is None:
        return np.full_like(p, inf)
    softening = 1.0 + rheology.limiting_temperature_slope * (temperature - rheology.reference_temperature)
    limit = rheology.limiting_stress + rheology.limiting_coefficient * p / softening
    return np.maximum(limit, rheology.limiting_minimum)


def stress(rate: ArrayLike, viscosity: ArrayLike, limit: Array, rheology: Rheology) -> Array:
    """Magnitude of the shear stress at the magnitude of a rate [1/s] and the low-shear viscosity [Pa s], under a
    limiting stress [Pa]; NumPy's own functions.
    """
    tau = np.asarray(viscosity) * np.asarray(rate)
    if rheology.law is ShearLaw.REE_EYRING:
        tau = rheology.eyring_stress * np.arcsinh(tau / rheology.eyring_stress)
    elif rheology.law is ShearLaw.CARREAU_YASUDA:
        n, a = rheology.carreau_exponent, rheology.yasuda_exponent
        tau = tau * (1.0 + (tau / rheology.carreau_modulus) ** a) ** ((n - 1.0) / a)
    if rheology.limiting_coefficient is None:
        return tau
    if rheology.law is ShearLaw.NEWTONIAN:
        return -limit * np.expm1(-tau / limit)
    ratio = np.minimum(tau, limit) / np.maximum(tau, limit)
    return np.minimum(tau, limit) / (1.0 + ratio**LIMIT_POWER) ** (1.0 / LIMIT_POWER)


def shear_rate(
    stress: ArrayLike,
    viscosity: ArrayLike,
    pressure: ArrayLike,
    rheology: Rheology,
    temperature: ArrayLike | None = None,
) -> Array:
    """Shear rate at a shear stress [1/s], the inverse of `shear_stress`; infinite at and beyond
    the limiting stress.

    Parameters
    ----------
    stress : array_like
        Shear stress [Pa].
    viscosity, pressure, rheology, temperature
        As in `shear_stress`.

    Returns
    -------
    ndarray, shape of the arguments together
        Shear rate [1/s].
    """
    tau = np.abs(np.asarray(stress, dtype=np.float64))
    eta = np.asarray(viscosity, dtype=np.float64)
    if rheology.limiting_coefficient is not None:
        limit = limiting_stress(pressure, rheology, temperature)
        with np.errstate(divide="ignore", invalid="ignore"):
            tau = np.where(tau < limit, unlimited(np.minimum(tau / limit, 1.0), limit, rheology)[0], inf)
    if rheology.law is ShearLaw.REE_EYRING:
        tau_0 = rheology.eyring_stress
        newtonian = np.where(np.isinf(tau), inf, tau_0 * np.sinh(np.minimum(tau / tau_0, LARGEST_ARGUMENT)))
    elif rheology.law is ShearLaw.CARREAU_YASUDA:
        newtonian = rheology.carreau_modulus * _carreau_inverse(tau / rheology.carreau_modulus, rheology)
    else:
        newtonian = tau
    return np.copysign(newtonian / eta, stress)


def unlimited(share: Array, limit: Array, rheology: Rheology) -> tuple[Array, Array]:
    """Base stress at a share of the limiting one [Pa], and its derivative by the stress [-]."""
    if rheology.law is ShearLaw.NEWTONIAN:
        return -limit * np.log1p(-share), 1.0 / (1.0 - share)
    rest = 1.0 - share**LIMIT_POWER
    return share * limit * rest ** (-1.0 / LIMIT_POWER), rest ** (-1.0 / LIMIT_POWER - 1.0)


def _carreau_inverse(s: Array, rheology: Rheology) -> Array:
    """x of x [1 + x^a]^((n - 1)/a) = s, x = eta rate/G and s = tau/G, by Newton's method in ln x
    [-].
    """
    n, a = rheology.carreau_exponent, rheology.yasuda_exponent
    safe = np.where((s > 0.0) & np.isfinite(s), s, 1.0)
    wanted = np.log(safe)
    u = np.maximum(wanted, wanted / n)  # the larger of the two asymptotes
    for _ in range(NEWTON_STEPS):
        knee = np.logaddexp(0.0, a * u)  # ln(1 + x^a)
        step = (u + (n - 1.0) / a * knee - wanted) / (1.0 + (n - 1.0) * np.exp(a * u - knee))
        u = u - step
        if np.max(np.abs(step), initial=0.0) < 1e-14:
            break
    return np.where((s > 0.0) & np.isfinite(s), np.exp(np.minimum(u, LARGEST_ARGUMENT)), s)


def shear_rate_vector(
    stresses: tuple[ArrayLike, ArrayLike],
    viscosity: ArrayLike,
    pressure: ArrayLike,
    rheology: Rheology,
    temperature: ArrayLike | None = None,
) -> tuple[Array, Array]:
    """Rates (rate_x, rate_y) [1/s] at the stresses (tau_x, tau_y) [Pa], the inverse of
    `shear_stress_vector`.
    """
    x, y = (np.asarray(stress, dtype=np.float64) for stress in stresses)
    magnitude = np.hypot(x, y)
    rate = shear_rate(magnitude, viscosity, pressure, rheology, temperature)
    loaded = magnitude > 0.0
    fluidity = np.where(loaded, rate / np.where(loaded, magnitude, 1.0), 1.0 / np.asarray(viscosity, dtype=np.float64))
    return fluidity * x, fluidity * y
