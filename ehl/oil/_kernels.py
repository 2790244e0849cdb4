"""Viscosity and density for compiled kernels, after the laws of `ehl.oil.lubricant`.

oil: the array of `numbers.oil_numbers`.
"""

import numpy as np

from ..compiled import compiled
from ._elementary_kernels import exponential, logarithm
from .heat_properties import CAPACITY_POWER
from .lubricant import (
    DOWSON_HIGGINSON_DENOMINATOR,
    DOWSON_HIGGINSON_NUMERATOR,
    ROELANDS_TEMPERATURE,
)

# codes of the laws
ISOVISCOUS, BARUS, ROELANDS, TAIT_DOOLITTLE, YASUTOMI, MODULUS, SCALED = range(7)
INCOMPRESSIBLE, DOWSON_HIGGINSON, TAIT = range(3)
# where the constants of the viscosity law begin, and those of Tait
V = 7
T = 16
EXPONENT_LIMIT = 600.0  # largest ln(eta/eta_0), keeps exp() finite
H = 21  # and those of the heat under pressure: kind of its law, constants
CONSTANT_HEAT, FITTED_HEAT, VOLUME_HEAT = range(3)
SLOPE_STEP = 1e-3  # [K], of difference quotients by temperature


@compiled
def relative_volume(pressure, temperature, oil):
    """V/V_R after Tait [-]."""
    above = temperature - oil[T + 2]
    modulus = oil[T] * np.exp(-oil[T + 3] * above)
    k = 1.0 + oil[T + 1]
    return (1.0 + oil[T + 4] * above) * (1.0 - np.log1p(pressure * k / modulus) / k)


@compiled
def _log_doolittle(pressure, temperature, oil):
    above = temperature - oil[4]
    if oil[V + 3] > 0.0:  # the occupied volume expands
        occupied = 1.0 + oil[V + 2] * (temperature - oil[T + 2])
        volume = relative_volume(pressure, temperature, oil)
        extra = 0.0
    else:
        occupied = 1.0
        volume = relative_volume(pressure, oil[T + 2], oil)
        extra = -oil[5] * above
    free = volume - oil[V + 1] * occupied
    if free <= 0.0:
        return EXPONENT_LIMIT
    return oil[V] * oil[V + 1] * (occupied / free - 1.0 / (1.0 - oil[V + 1])) - oil[V + 4] + extra


@compiled
def _log_yasutomi(pressure, temperature, oil):
    glass = oil[V] + oil[V + 1] * np.log1p(oil[V + 2] * pressure)
    if oil[V + 7] > 0.0:
        expansivity = 1.0 - oil[V + 3] * np.log1p(oil[V + 4] * pressure)
    else:
        expansivity = (1.0 + oil[V + 3] * pressure) ** oil[V + 4]
    distance = max(temperature - glass, 0.0) * max(expansivity, 0.0)
    return -oil[V + 5] * distance / (oil[V + 6] + distance) - oil[V + 8]


@compiled
def _log_modulus(pressure, temperature, oil):
    above = temperature - oil[4]
    if oil[V + 4] > 0.0:  # eta_0 after Vogel
        above /= max(1.0 + above / (oil[4] - oil[V + 4]), 1e-3)
    modulus = oil[V] + oil[V + 1] * temperature
    modulus += (oil[V + 2] + oil[V + 3] * temperature) * pressure
    return pressure / modulus - oil[5] * above


@compiled
def _log_scaled(pressure, temperature, oil):
    volume = max(relative_volume(pressure, temperature, oil), 0.0)
    phi = temperature / oil[T + 2] * volume ** oil[V + 2]
    if phi <= oil[V + 1]:
        return EXPONENT_LIMIT
    return oil[V] * oil[V + 1] / (phi - oil[V + 1]) - oil[V + 3]


@compiled
def roelands_rise(ratio, exponent):
    """(1 + p/p_r)^z [-], Roelands (1966), at p/p_r."""
    return np.exp(exponent * np.log1p(ratio))


@compiled
def _log_roelands(rise, above, oil):
    slope = oil[V]
    room = oil[4] - ROELANDS_TEMPERATURE
    if above != 0.0:
        rise *= np.exp(-oil[5] * room / slope * np.log(max(1.0 + above / room, 1e-3)))
    return min(slope * (rise - 1.0), EXPONENT_LIMIT)


@compiled
def _roelands_softening(temperature, log_ratio, oil):
    room = oil[4] - ROELANDS_TEMPERATURE
    warm = 1.0 + (temperature - oil[4]) / room
    if log_ratio >= EXPONENT_LIMIT or warm <= 1e-3:
        return 0.0
    return oil[5] * (1.0 + log_ratio / oil[V]) / warm


@compiled
def column_log_viscosity(pressure, temperature, oil, out):
    """`log_viscosity_ratio` at the temperatures of a column, the law chosen once."""
    pressed = pressure_rise(pressure, oil)
    if int(oil[0]) == ROELANDS:
        room = oil[4] - ROELANDS_TEMPERATURE
        for k in range(temperature.size):
            out[k] = max(1.0 + (temperature[k] - oil[4]) / room, 1e-3)
        logarithm(out)
        for k in range(temperature.size):
            power = -oil[5] * room / oil[V] * out[k]
            out[k] = min(max(power, -EXPONENT_LIMIT), EXPONENT_LIMIT)
        exponential(out)
        for k in range(temperature.size):
            out[k] = min(oil[V] * (pressed * out[k] - 1.0), EXPONENT_LIMIT)
    else:
        for k in range(temperature.size):
            out[k] = log_viscosity_at(pressure, pressed, temperature[k], oil)


@compiled
def column_softening(pressure, temperature, log_ratio, oil, out):
    """`softening_at` at the temperatures of a column, the law chosen once."""
    if int(oil[0]) == ROELANDS:
        for k in range(temperature.size):
            out[k] = _roelands_softening(temperature[k], log_ratio[k], oil)
    else:
        for k in range(temperature.size):
            out[k] = softening_at(pressure, temperature[k], log_ratio[k], oil)


@compiled
def column_density(pressure, temperature, oil, out):
    """`density_ratio` at the temperatures of a column, the law chosen once."""
    if int(oil[1]) == TAIT:
        for k in range(temperature.size):
            out[k] = density_ratio(pressure, temperature[k], oil)
    else:
        pressed = density_ratio(pressure, oil[4], oil)
        for k in range(temperature.size):
            out[k] = -oil[6] * (temperature[k] - oil[4])
        exponential(out)
        for k in range(temperature.size):
            out[k] *= pressed


@compiled
def log_viscosity_ratio(pressure, temperature, oil):
    """ln(eta/eta_0), at most EXPONENT_LIMIT [-]."""
    return log_viscosity_at(pressure, pressure_rise(pressure, oil), temperature, oil)


@compiled
def pressure_rise(pressure, oil):
    """(1 + p/p_r)^z of Roelands' law [-], once for all temperatures of a column; else not used."""
    if int(oil[0]) == ROELANDS:
        return roelands_rise(pressure / oil[V + 1], oil[V + 2])
    return 1.0


@compiled
def log_viscosity_at(pressure, rise, temperature, oil):
    """ln(eta/eta_0), at most EXPONENT_LIMIT [-]; rise: of `pressure_rise`."""
    law = int(oil[0])
    above = temperature - oil[4]
    if law == ISOVISCOUS:
        return -oil[5] * above
    if law == BARUS:
        return min(oil[V] * pressure - oil[5] * above, EXPONENT_LIMIT)
    if law == ROELANDS:
        return _log_roelands(rise, above, oil)
    if law == MODULUS:
        return min(_log_modulus(pressure, temperature, oil), EXPONENT_LIMIT)
    if law == SCALED:
        return min(_log_scaled(pressure, temperature, oil), EXPONENT_LIMIT)
    if law == TAIT_DOOLITTLE:
        return min(_log_doolittle(pressure, temperature, oil), EXPONENT_LIMIT)
    return min(_log_yasutomi(pressure, temperature, oil), EXPONENT_LIMIT)


@compiled
def viscosity(pressure, temperature, oil):
    """Dynamic viscosity [Pa s]."""
    return oil[2] * np.exp(log_viscosity_ratio(pressure, temperature, oil))


@compiled
def viscosity_softening(pressure, temperature, oil):
    """-d(ln eta)/dT [1/K], central difference."""
    cold = log_viscosity_ratio(pressure, temperature - SLOPE_STEP, oil)
    return (cold - log_viscosity_ratio(pressure, temperature + SLOPE_STEP, oil)) / (
        2.0 * SLOPE_STEP
    )


@compiled
def softening_at(pressure, temperature, log_ratio, oil):
    """-d(ln eta)/dT [1/K] where ln(eta/eta_0) is known: of Roelands' and Barus' laws in closed
    form, of others by `viscosity_softening`.
    """
    law = int(oil[0])
    if log_ratio >= EXPONENT_LIMIT:
        return 0.0
    if law in (ISOVISCOUS, BARUS):
        return oil[5]
    if law == ROELANDS:
        return _roelands_softening(temperature, log_ratio, oil)
    return viscosity_softening(pressure, temperature, oil)


@compiled
def density_ratio(pressure, temperature, oil):
    """rho/rho_0 [-]."""
    law = int(oil[1])
    above = temperature - oil[4]
    if law == TAIT:
        ratio = relative_volume(0.0, oil[4], oil) / relative_volume(pressure, temperature, oil)
        if oil[T + 4] > 0.0:
            return ratio
    elif law == DOWSON_HIGGINSON:
        ratio = 1.0 + DOWSON_HIGGINSON_NUMERATOR * pressure / (
            1.0 + DOWSON_HIGGINSON_DENOMINATOR * pressure
        )
    else:
        ratio = 1.0
    return ratio * np.exp(-oil[6] * above)


@compiled
def conductivity_ratio(pressure, temperature, oil):
    """k/k_0 [-]."""
    if oil[H] == FITTED_HEAT:
        p = min(pressure, oil[H + 9])
        return 1.0 + oil[H + 1] * p / (1.0 + oil[H + 2] * p)
    if oil[H] == VOLUME_HEAT:
        volume = relative_volume(pressure, temperature, oil)
        warm = temperature / oil[T + 2]
        scaling = volume * (1.0 - oil[H + 4] * warm * volume ** oil[H + 5])
        return (oil[H + 1] + oil[H + 2] * scaling ** -oil[H + 3]) / oil[H + 8]
    return 1.0


@compiled
def capacity_ratio(pressure, temperature, density, oil):
    """Rho c/(rho c)_0 [-], at rho/rho_0."""
    if oil[H] == FITTED_HEAT:
        p = min(pressure, oil[H + 9])
        rise = 1.0 + oil[H + 3] * p / (1.0 + oil[H + 4] * p)
        slope = oil[H + 5] * (1.0 + oil[H + 6] * p + oil[H + 7] * p * p)
        return rise * (1.0 + slope * (min(temperature, oil[H + 10]) - oil[H + 8])) / oil[H + 11]
    if oil[H] == VOLUME_HEAT:
        volume = relative_volume(pressure, temperature, oil)
        warm = temperature / oil[T + 2]
        return (oil[H + 6] + oil[H + 7] * warm * volume**CAPACITY_POWER) / oil[H + 9]
    return density


@compiled
def thermal_expansion(pressure, temperature, oil):
    """-d(ln rho)/dT [1/K]; of Tait's own temperature a central difference."""
    if int(oil[1]) != TAIT:
        return oil[6]
    cold = density_ratio(pressure, temperature - SLOPE_STEP, oil)
    return np.log(cold / density_ratio(pressure, temperature + SLOPE_STEP, oil)) / (
        2.0 * SLOPE_STEP
    )


@compiled
def density_slope(pressure, oil):
    """d(rho/rho_0)/dp at the temperature of operation [1/Pa]."""
    law = int(oil[1])
    if law == TAIT:
        above = oil[4] - oil[T + 2]
        modulus = oil[T] * np.exp(-oil[T + 3] * above)
        k = 1.0 + oil[T + 1]
        volume = 1.0 - np.log1p(pressure * k / modulus) / k
        return 1.0 / ((modulus + k * pressure) * volume * volume)
    if law == DOWSON_HIGGINSON:
        return DOWSON_HIGGINSON_NUMERATOR / (1.0 + DOWSON_HIGGINSON_DENOMINATOR * pressure) ** 2
    return 0.0


@compiled
def flow_properties(
    P, H, hertz_pressure, oil, thinning, at, speed, eps, rho, rho_slope, first, stop
):
    """eps = rho H^3/(eta lambda), rho and d(rho)/dP [-] of the lines from `first` to before
    `stop`, any law, at the temperature of operation. thinning: share of the change of ln(eta),
    from what it is `at` the pressure of the factors, that these take back; empty without any.
    """
    nx = P.shape[1]
    for j in range(first, stop):
        for i in range(nx):
            h = max(H[j, i], 0.0)
            p = max(P[j, i], 0.0) * hertz_pressure
            density = density_ratio(p, oil[4], oil)
            rho[j, i] = density
            rho_slope[j, i] = density_slope(p, oil) * hertz_pressure
            thinner = -log_viscosity_ratio(p, oil[4], oil)
            if thinning.size > 0:
                thinner -= thinning[j, i] * (thinner + at[j, i])
            eps[j, i] = density * h * h * h / speed * np.exp(thinner)
