"""Laws of the oil in plain NumPy, written apart from the product's: the reference for `oilfilm.ehl.oil._kernels`."""

from __future__ import annotations

from math import log

import numpy as np

from oilfilm.ehl.oil.free_volume import ExpansivityForm
from oilfilm.ehl.oil.lubricant import DensityLaw, FittedHeat, ViscosityLaw, VolumeHeat


def relative_volume(p, temperature, tait):
    """V/V_R = [1 + a (T - T_R)] {1 - ln[1 + p (1 + K_0')/K_0(T)]/(1 + K_0')} [-], Tait."""
    above = np.asarray(temperature) - tait.reference_temperature
    modulus = tait.bulk_modulus * np.exp(-tait.bulk_modulus_temperature * above)
    k = 1.0 + tait.bulk_modulus_derivative
    return (1.0 + tait.expansion * above) * (1.0 - np.log1p(np.asarray(p) * k / modulus) / k)


def doolittle(p, temperature, oil):
    """B R {O/[V/V_R - R O] - 1/(1 - R)}, O = 1 + e (T - T_R) [-], Doolittle (1951), Bair (2007)."""
    tait, law = oil.tait, oil.doolittle
    r, expansion = law.occupied_share, law.occupied_expansion
    above = 0.0 if expansion is None else np.asarray(temperature) - tait.reference_temperature
    occupied = 1.0 if expansion is None else 1.0 + expansion * above
    free = relative_volume(p, tait.reference_temperature + above, tait) - r * occupied
    with np.errstate(divide="ignore"):
        return law.factor * r * (occupied / np.maximum(free, 0.0) - 1.0 / (1.0 - r))


def yasutomi(p, temperature, oil):
    """-ln(10) C1 D F/(C2 + D F), D = T - T_g(p) [-], Yasutomi, Bair and Winer (1984)."""
    glass, p = oil.yasutomi, np.asarray(p, dtype=np.float64)
    rise = glass.glass_rise * np.log1p(glass.glass_pressure_coefficient * p)
    if glass.form is ExpansivityForm.LOGARITHMIC:
        expansivity = 1.0 - glass.expansivity_1 * np.log1p(glass.expansivity_2 * p)
    else:
        expansivity = (1.0 + glass.expansivity_1 * p) ** glass.expansivity_2
    above = np.asarray(temperature) - (glass.glass_temperature + rise)
    distance = np.maximum(above, 0.0) * np.maximum(expansivity, 0.0)
    return -log(10.0) * glass.slope * distance / (glass.width + distance)


def modulus(p, temperature, oil):
    """p/[a_1 + a_2 T + (b_1 + b_2 T) p] - beta D [-], D of Vogel's law where the oil has one."""
    law, t = oil.modulus, np.asarray(temperature, dtype=np.float64)
    above = t - oil.temperature
    if law.vogel_temperature is not None:
        above = above / np.maximum(1.0 + above / (oil.temperature - law.vogel_temperature), 1e-3)
    beta = 0.0 if oil.thermal is None else oil.thermal.viscosity_temperature
    return p / (law.a1 + law.a2 * t + (law.b1 + law.b2 * t) * p) - beta * above


def scaled(p, temperature, oil):
    """B phi_inf/(phi - phi_inf), phi = (T/T_R) (V/V_R)^g [-], Bair (2019)."""
    t = np.asarray(temperature, dtype=np.float64)
    volume = relative_volume(p, t, oil.tait)
    phi = t / oil.tait.reference_temperature * np.maximum(volume, 0.0) ** oil.scaled.exponent
    with np.errstate(divide="ignore"):
        return oil.scaled.factor * oil.scaled.limit / np.maximum(phi - oil.scaled.limit, 0.0)


def roelands(p, above, oil):
    """s {(1 + p/p_r)^z [(T - 138 K)/(T_0 - 138 K)]^(-S) - 1} [-], Roelands (1966)."""
    s = oil.pressure_viscosity * oil.roelands_pressure / oil.exponent
    rise = (1.0 + p / oil.roelands_pressure) ** oil.exponent
    if np.any(above != 0.0):
        room = oil.temperature - 138.0
        beta = oil.thermal.viscosity_temperature
        rise = rise * np.maximum(1.0 + above / room, 1e-3) ** (-beta * room / s)
    return s * (rise - 1.0)


def log_viscosity_ratio(p, oil, temperature=None):
    """ln(eta/eta_0) [-] at a pressure [Pa] and temperature [K]."""
    p, start = np.asarray(p, dtype=np.float64), oil.temperature or 0.0
    now = start if temperature is None else np.asarray(temperature)
    beta = 0.0 if oil.thermal is None else oil.thermal.viscosity_temperature
    law, above = oil.viscosity_law, now - start
    if law is ViscosityLaw.MODULUS:
        return modulus(p, now, oil)
    if law is ViscosityLaw.SCALED:
        return scaled(p, now, oil) - scaled(0.0, start, oil)
    if law is ViscosityLaw.YASUTOMI:
        return yasutomi(p, now, oil) - yasutomi(0.0, start, oil)
    if law is ViscosityLaw.TAIT_DOOLITTLE:
        ratio = doolittle(p, now, oil) - doolittle(0.0, start, oil)
        return ratio if oil.doolittle.occupied_expansion is not None else ratio - beta * above
    if law is ViscosityLaw.ROELANDS and oil.pressure_viscosity > 0.0:
        return roelands(p, above, oil)
    return (oil.pressure_viscosity if law is ViscosityLaw.BARUS else 0.0) * p - beta * above


def density_ratio(p, oil, temperature=None):
    """rho/rho_0 [-]: Tait, 1 + 0.6 p/(1 + 1.7 p) of Dowson and Higginson (1966) with p in GPa, or 1."""
    p, start = np.asarray(p, dtype=np.float64), oil.temperature or 0.0
    now = start if temperature is None else np.asarray(temperature)
    ratio = np.ones_like(p)
    if oil.density_law is DensityLaw.TAIT:
        ratio = relative_volume(0.0, start, oil.tait) / relative_volume(p, now, oil.tait)
        if oil.tait.expansion > 0.0:
            return ratio
    elif oil.density_law is DensityLaw.DOWSON_HIGGINSON:
        ratio = 1.0 + 0.6e-9 * p / (1.0 + 1.7e-9 * p)
    return ratio if oil.thermal is None else ratio * np.exp(-oil.thermal.expansion * (now - start))


def heat_ratios(p, oil, temperature):
    """k and rho c over those at ambient pressure and the temperature of operation [-]."""
    law, p, t = oil.thermal.under_pressure, np.asarray(p, dtype=np.float64), np.asarray(temperature, dtype=np.float64)
    if isinstance(law, FittedHeat):
        return over(fitted(p, t, law), fitted(0.0, oil.temperature, law))
    if isinstance(law, VolumeHeat):
        return over(by_volume(p, t, oil.tait, law), by_volume(0.0, oil.temperature, oil.tait, law))
    return np.ones(np.broadcast_shapes(p.shape, t.shape)), density_ratio(p, oil, t)


def over(values, ambient):
    return tuple(value / at for value, at in zip(values, ambient, strict=True))


def fitted(p, t, law):
    """1 + c_1 p/(1 + c_2 p), and [1 + a_1 p/(1 + a_2 p)] [1 + b (T - T_R)] [-], Larsson and Andersson (2000)."""
    p, t = np.clip(p, 0.0, law.largest_pressure), np.minimum(t, law.largest_temperature)
    k = 1.0 + law.conductivity_1 * p / (1.0 + law.conductivity_2 * p)
    rise = 1.0 + law.capacity_1 * p / (1.0 + law.capacity_2 * p)
    slope = law.temperature_0 * (1.0 + law.temperature_1 * p + law.temperature_2 * p * p)
    return k + 0.0 * t, rise * (1.0 + slope * (t - law.reference_temperature))


def by_volume(p, t, tait, law):
    """B + C K^-s [W/(m K)], K = (V/V_R) [1 - A (T/T_R) (V/V_R)^q], and C_0 + m (T/T_R) (V/V_R)^-4 [J/(m^3 K)]."""
    volume, warm = relative_volume(p, t, tait), t / tait.reference_temperature
    scaling = volume * (1.0 - law.scaling_factor * warm * volume**law.scaling_exponent)
    k = law.conductivity_base + law.conductivity_scale * scaling**-law.conductivity_exponent
    return k, law.capacity_base + law.capacity_scale * warm * volume**-4.0
