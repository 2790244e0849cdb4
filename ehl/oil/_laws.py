"""The laws of density, viscosity and heat of an oil, each an equation that stands once.

NumPy evaluates a law over whole arrays, and kernels compile it for one number: no branch depends
on pressure or temperature. oil: the array of `lubricant.oil_numbers`.
"""

import numpy as np

# codes of the laws
ISOVISCOUS, BARUS, ROELANDS, TAIT_DOOLITTLE, YASUTOMI, MODULUS, SCALED = range(7)
INCOMPRESSIBLE, DOWSON_HIGGINSON, TAIT = range(3)
CONSTANT_HEAT, FITTED_HEAT, VOLUME_HEAT = range(3)
# columns of the array of an oil: codes of its laws, values at ambient pressure and the temperature
# of operation; then where the constants of each law begin
VISCOSITY_LAW, DENSITY_LAW, VISCOSITY, DENSITY, OPERATION, BETA, EXPANSION = range(7)
V = 7  # of the viscosity law
T = 16  # of Tait's equation of state
H = 21  # of the heat under pressure: code of its law, constants
D = 33  # of Dowson and Higginson's density
SIZE = 35
EXPONENT_LIMIT = 600.0  # largest ln(eta/eta_0), keeps exp() finite
SMALLEST_WARMTH = 1e-3  # of (T - T_v)/(T_0 - T_v), iterates may fall below the end of a law [-]
SLOPE_STEP = 1e-3  # [K], of difference quotients by temperature
# codes of the base laws
NEWTONIAN = 0
REE_EYRING = 1
CARREAU_YASUDA = 2
# largest argument of exponentials: keeps the rate finite at stresses that only occur while
# iterating
LARGEST_ARGUMENT = 300.0


def relative_volume(
    pressure, temperature, bulk_modulus, derivative, reference, softening, expansion
):
    """V/V_R = [1 + a (T - T_R)] {1 - ln[1 + p (1 + K_0')/K_0(T)]/(1 + K_0')}, Tait [-]."""
    above = temperature - reference
    modulus = bulk_modulus * np.exp(-softening * above)
    k = 1.0 + derivative
    return (1.0 + expansion * above) * (1.0 - np.log1p(pressure * k / modulus) / k)


def dowson_higginson(pressure, numerator, denominator):
    """rho/rho_0 = 1 + d_1 p/(1 + d_2 p), Dowson and Higginson (1966) [-]."""
    return 1.0 + numerator * pressure / (1.0 + denominator * pressure)


def dowson_higginson_slope(pressure, numerator, denominator):
    """Derivative of `dowson_higginson` by the pressure."""
    return numerator / (1.0 + denominator * pressure) ** 2


def roelands_rise(ratio, exponent):
    """(1 + p/p_r)^z [-], Roelands (1966), at p/p_r."""
    return np.exp(exponent * np.log1p(ratio))


def log_roelands(rise, above, beta, slope, room):
    """ln(eta/eta_0) = s {(1 + p/p_r)^z [(T - 138 K)/(T_0 - 138 K)]^(-S) - 1}, Roelands (1966),
    with T - T_0 `above` and T_0 - 138 K `room` [K].
    """
    warm = np.maximum(1.0 + above / room, SMALLEST_WARMTH)
    return slope * (rise * np.exp(-beta * room / slope * np.log(warm)) - 1.0)


def log_doolittle(volume, occupied, factor, occupied_fraction):
    """ln(eta/eta_R) = B R {O/[V/V_R - R O] - 1/(1 - R)}, Doolittle (1951), Bair (2007) [-];
    infinite where the occupied volume fills the whole.
    """
    free = np.maximum(volume - occupied_fraction * occupied, 0.0)
    ratio = occupied / free - 1.0 / (1.0 - occupied_fraction)
    return factor * occupied_fraction * ratio


def log_yasutomi(
    pressure, temperature, glass_0, rise, coefficient, expansivity_1, expansivity_2, slope, width,
    logarithmic,
):  # fmt: skip
    """ln(eta/eta_g) = -ln(10) C1 D F/(C2 + D F), D = T - T_g(p), Yasutomi, Bair and Winer (1984);
    `slope` is ln(10) C1. Below the glass temperature, where the law ends, that of the glass.
    """
    glass = glass_0 + rise * np.log1p(coefficient * pressure)
    if logarithmic > 0.0:
        expansivity = 1.0 - expansivity_1 * np.log1p(expansivity_2 * pressure)
    else:
        expansivity = (1.0 + expansivity_1 * pressure) ** expansivity_2
    distance = np.maximum(temperature - glass, 0.0) * np.maximum(expansivity, 0.0)
    return -slope * distance / (width + distance)


def log_modulus(pressure, temperature, operation, beta, a1, a2, b1, b2, vogel):
    """ln(eta/eta_0) = p/[a_1 + a_2 T + (b_1 + b_2 T) p] - beta D, D = T - T_0 [-].

    D/[1 + D/(T_0 - T_v)] replaces D, Vogel's law, unless T_v is zero.
    """
    above = temperature - operation
    if vogel > 0.0:
        above = above / np.maximum(1.0 + above / (operation - vogel), SMALLEST_WARMTH)
    modulus = a1 + a2 * temperature + (b1 + b2 * temperature) * pressure
    return pressure / modulus - beta * above


def log_scaled(volume, relative_temperature, factor, limit, exponent):
    """ln(eta/eta_inf) = B phi_inf/(phi - phi_inf), phi = (T/T_R) (V/V_R)^g, Bair (2019) [-];
    infinite where phi reaches phi_inf, the glass.
    """
    phi = relative_temperature * np.maximum(volume, 0.0) ** exponent
    return factor * limit / np.maximum(phi - limit, 0.0)


def fitted_conductivity(pressure, c1, c2):
    """k/k_0 = 1 + c_1 p/(1 + c_2 p), Larsson and Andersson (2000) [-]."""
    return 1.0 + c1 * pressure / (1.0 + c2 * pressure)


def fitted_capacity(pressure, temperature, a1, a2, b0, b1, b2, reference):
    """[1 + a_1 p/(1 + a_2 p)] [1 + b (T - T_R)], b = b_0 (1 + b_1 p + b_2 p^2), Larsson and
    Andersson (2000) [-].
    """
    rise = 1.0 + a1 * pressure / (1.0 + a2 * pressure)
    slope = b0 * (1.0 + b1 * pressure + b2 * pressure * pressure)
    return rise * (1.0 + slope * (temperature - reference))


def volume_conductivity(volume, relative_temperature, base, scale, exponent, factor, power):
    """k = B + C K^-s, K = (V/V_R) [1 - A (T/T_R) (V/V_R)^q], Habchi and Bair [W/(m K)]."""
    scaling = volume * (1.0 - factor * relative_temperature * volume**power)
    return base + scale * scaling**-exponent


def volume_capacity(volume, relative_temperature, base, scale, power):
    """rho c = C_0 + m (T/T_R) (V/V_R)^-4, Habchi and Bair [J/(m^3 K)]."""
    return base + scale * relative_temperature * volume**power


def oil_volume(pressure, temperature, oil):
    """V/V_R of an oil with Tait's equation of state [-]."""
    return relative_volume(
        pressure, temperature, oil[T], oil[T + 1], oil[T + 2], oil[T + 3], oil[T + 4]
    )


def _oil_doolittle(pressure, temperature, oil):
    """ln(eta/eta_0) after Doolittle [-]; without an expansion of the occupied volume the constants
    hold at the temperature of operation, and beta varies it.
    """
    if oil[V + 3] > 0.0:  # the occupied volume expands
        occupied = 1.0 + oil[V + 2] * (temperature - oil[T + 2])
        volume = oil_volume(pressure, temperature, oil)
        return log_doolittle(volume, occupied, oil[V], oil[V + 1]) - oil[V + 4]
    volume = oil_volume(pressure, oil[T + 2], oil)
    ratio = log_doolittle(volume, 1.0, oil[V], oil[V + 1]) - oil[V + 4]
    return ratio - oil[BETA] * (temperature - oil[OPERATION])


def log_viscosity_ratio(pressure, temperature, oil):
    """ln(eta/eta_0), at most EXPONENT_LIMIT [-]."""
    return log_viscosity_at(pressure, pressure_rise(pressure, oil), temperature, oil)


def pressure_rise(pressure, oil):
    """(1 + p/p_r)^z of Roelands' law [-], once for all temperatures of a column; else not used."""
    if int(oil[VISCOSITY_LAW]) == ROELANDS:
        return roelands_rise(pressure / oil[V + 1], oil[V + 2])
    return 1.0


def log_viscosity_at(pressure, rise, temperature, oil):
    """ln(eta/eta_0), at most EXPONENT_LIMIT [-]; rise: of `pressure_rise`."""
    code = int(oil[VISCOSITY_LAW])
    if code == ROELANDS:
        above = temperature - oil[OPERATION]
        ratio = log_roelands(rise, above, oil[BETA], oil[V], oil[V + 3])
    elif code == MODULUS:
        ratio = log_modulus(
            pressure, temperature, oil[OPERATION], oil[BETA],
            oil[V], oil[V + 1], oil[V + 2], oil[V + 3], oil[V + 4],
        )  # fmt: skip
    elif code == SCALED:
        volume = oil_volume(pressure, temperature, oil)
        ratio = log_scaled(volume, temperature / oil[T + 2], oil[V], oil[V + 1], oil[V + 2])
        ratio = ratio - oil[V + 3]
    elif code == TAIT_DOOLITTLE:
        ratio = _oil_doolittle(pressure, temperature, oil)
    elif code == YASUTOMI:
        ratio = log_yasutomi(
            pressure, temperature, oil[V], oil[V + 1], oil[V + 2], oil[V + 3], oil[V + 4],
            oil[V + 5], oil[V + 6], oil[V + 7],
        )  # fmt: skip
        ratio = ratio - oil[V + 8]
    else:  # Barus; isoviscous with the slope zero
        ratio = oil[V] * pressure - oil[BETA] * (temperature - oil[OPERATION])
    return np.minimum(ratio, EXPONENT_LIMIT)


def viscosity(pressure, temperature, oil):
    """Dynamic viscosity [Pa s]."""
    return oil[VISCOSITY] * np.exp(log_viscosity_ratio(pressure, temperature, oil))


def density_ratio(pressure, temperature, oil):
    """rho/rho_0 [-]."""
    if int(oil[DENSITY_LAW]) == TAIT:
        ratio = oil_volume(0.0, oil[OPERATION], oil) / oil_volume(pressure, temperature, oil)
        if oil[T + 4] > 0.0:
            return ratio
    else:
        ratio = dowson_higginson(pressure, oil[D], oil[D + 1])
    return ratio * np.exp(-oil[EXPANSION] * (temperature - oil[OPERATION]))


def density_slope(pressure, oil):
    """d(rho/rho_0)/dp at the temperature of operation [1/Pa]."""
    if int(oil[DENSITY_LAW]) == TAIT:
        above = oil[OPERATION] - oil[T + 2]
        modulus = oil[T] * np.exp(-oil[T + 3] * above)
        k = 1.0 + oil[T + 1]
        volume = 1.0 - np.log1p(pressure * k / modulus) / k
        return 1.0 / ((modulus + k * pressure) * volume * volume)
    return dowson_higginson_slope(pressure, oil[D], oil[D + 1])


def conductivity_ratio(pressure, temperature, oil):
    """k/k_0 [-]."""
    if oil[H] == FITTED_HEAT:
        p = np.minimum(np.maximum(pressure, 0.0), oil[H + 9])
        return fitted_conductivity(p, oil[H + 1], oil[H + 2])
    if oil[H] == VOLUME_HEAT:
        volume = oil_volume(pressure, temperature, oil)
        warm = temperature / oil[T + 2]
        constants = oil[H + 1], oil[H + 2], oil[H + 3], oil[H + 4], oil[H + 5]
        return volume_conductivity(volume, warm, *constants) / oil[H + 9]
    return 1.0 + 0.0 * pressure


def capacity_ratio(pressure, temperature, density, oil):
    """Rho c/(rho c)_0 [-], at rho/rho_0."""
    if oil[H] == FITTED_HEAT:
        p = np.minimum(np.maximum(pressure, 0.0), oil[H + 9])
        t = np.minimum(temperature, oil[H + 10])
        constants = oil[H + 3], oil[H + 4], oil[H + 5], oil[H + 6], oil[H + 7], oil[H + 8]
        return fitted_capacity(p, t, *constants) / oil[H + 11]
    if oil[H] == VOLUME_HEAT:
        volume = oil_volume(pressure, temperature, oil)
        warm = temperature / oil[T + 2]
        return volume_capacity(volume, warm, oil[H + 6], oil[H + 7], oil[H + 8]) / oil[H + 10]
    return density


def limiting_stress(
    pressure, temperature, limit_coefficient, limit_stress, limit_slope, limit_temperature,
    limit_minimum,
):  # fmt: skip
    """tau_L = tau_L0 + Lambda p/[1 + s (T - T_r)], at least its minimum [Pa]; infinite if its
    coefficient is. NumPy evaluates it over arrays, kernels compile it for one number.
    """
    if not np.isfinite(limit_coefficient):
        return np.inf + 0.0 * pressure
    softening = np.maximum(1.0 + limit_slope * (temperature - limit_temperature), 0.0)
    return np.fmax(limit_stress + limit_coefficient * pressure / softening, limit_minimum)


# the laws that kernels compile
LAWS = (
    relative_volume,
    dowson_higginson,
    dowson_higginson_slope,
    roelands_rise,
    log_roelands,
    log_doolittle,
    log_yasutomi,
    log_modulus,
    log_scaled,
    fitted_conductivity,
    fitted_capacity,
    volume_conductivity,
    volume_capacity,
    oil_volume,
    _oil_doolittle,
    log_viscosity_ratio,
    pressure_rise,
    log_viscosity_at,
    viscosity,
    density_ratio,
    density_slope,
    conductivity_ratio,
    capacity_ratio,
    limiting_stress,
)
