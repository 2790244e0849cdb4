"""The laws of density, viscosity and heat of an oil: one implementation for NumPy and for kernels.

A `law` is an equation that NumPy evaluates over whole arrays, and that kernels compile for one
number: no branch depends on pressure or temperature. oil: the array of `lubricant.oil_numbers`.
"""

import numpy as np
from numba.extending import register_jitable

from ..compiled import compiled

LOG2_E = 1.4426950408889634  # 1/ln 2
# ln 2 in two parts: a whole number of up to 20 digits times the first is exact
LN2_HIGH = float.fromhex("0x1.62e42fee00000p-1")
LN2_LOW = float.fromhex("0x1.a39ef35793c76p-33")
DIGITS = 52  # binary, of the fraction
FRACTION = 2**DIGITS - 1
BIAS = 1023  # of the exponent
# added to a number below 2^51, rounds it and leaves the whole number in its last digits
ROUNDING = 1.5 * 2.0**DIGITS
# the same for whole numbers above -2048, written into the digits of 2^52
WHOLE = 2.0**DIGITS
WHOLE_BITS = (BIAS + DIGITS) << DIGITS
OFFSET = 2048
ROOT_HALF_BITS = 0x3FE6A09E667F3BCD  # of sqrt(1/2)

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

law = register_jitable(error_model="numpy")

# codes of the base laws
NEWTONIAN = 0
REE_EYRING = 1
CARREAU_YASUDA = 2
# largest argument of exponentials: keeps the rate finite at stresses that only occur while
# iterating
LARGEST_ARGUMENT = 300.0
LIMIT_POWER = 32  # m of the limiting stress on other laws than Newton's [-]
LIMIT_ROOTS = 5  # square roots in a row that are the m-th root [-]
SMALL_SINE = 2e-3  # below which the series of asinh is exact [-]
FAR_BELOW = 0.25  # of a limit, whose m-th power is negligible [-]
NEWTON_STEPS = 30


@compiled
def copy(source, target):
    """Numbers of an array (n,), or of a tuple, into an array. Assigned to a slice they would be
    compared in number first, and the text of numba's error takes as long to compile as a hundred
    lines.
    """
    for i in range(target.size):
        target[i] = source[i]


@compiled
def copy_rows(source, target):
    """Numbers of one array (m, n) into another."""
    for j in range(target.shape[0]):
        copy(source[j], target[j])


@compiled
def exponential_of(x):
    """Exp(x), |x| < 700: with k = round(x/ln 2) and r = x - k ln 2, 2^k times Taylor's polynomial
    of r, whose next term is below 5e-18.
    """
    power = x * LOG2_E + ROUNDING
    k = power - ROUNDING
    r = (x - k * LN2_HIGH) - k * LN2_LOW
    total = 1.0 / 6227020800.0
    total = total * r + 1.0 / 479001600.0
    total = total * r + 1.0 / 39916800.0
    total = total * r + 1.0 / 3628800.0
    total = total * r + 1.0 / 362880.0
    total = total * r + 1.0 / 40320.0
    total = total * r + 1.0 / 5040.0
    total = total * r + 1.0 / 720.0
    total = total * r + 1.0 / 120.0
    total = total * r + 1.0 / 24.0
    total = total * r + 1.0 / 6.0
    total = total * r + 0.5
    total = total * r + 1.0
    total = total * r + 1.0
    bits = np.float64(power).view(np.int64)
    return total * np.int64((bits + BIAS) << DIGITS).view(np.float64)


@compiled
def logarithm_of(x):
    """Ln(x) of a normal positive number: x = 2^k m, m from sqrt(1/2) to sqrt(2), ln m = 2 artanh
    s, s = (m - 1)/(m + 1), by its series, whose next term is below 1e-17 of it; what is not a
    finite number gives none.
    """
    above = np.float64(x).view(np.int64) - ROOT_HALF_BITS
    m = np.int64((above & FRACTION) + ROOT_HALF_BITS).view(np.float64)
    k = np.int64(((above >> DIGITS) + OFFSET) | WHOLE_BITS).view(np.float64) - (WHOLE + OFFSET)
    s = (m - 1.0) / (m + 1.0)
    q = s * s
    total = 1.0 / 21.0
    total = total * q + 1.0 / 19.0
    total = total * q + 1.0 / 17.0
    total = total * q + 1.0 / 15.0
    total = total * q + 1.0 / 13.0
    total = total * q + 1.0 / 11.0
    total = total * q + 1.0 / 9.0
    total = total * q + 1.0 / 7.0
    total = total * q + 1.0 / 5.0
    total = total * q + 1.0 / 3.0
    return k * LN2_HIGH + (2.0 * s + (2.0 * s * (q * total) + k * LN2_LOW)) + (x - x)


@compiled
def exponential(x):
    """`exponential_of` in place of numbers x (n,)."""
    for i in range(x.size):
        x[i] = exponential_of(x[i])


@compiled
def logarithm(x):
    """`logarithm_of` in place of numbers x (n,)."""
    for i in range(x.size):
        x[i] = logarithm_of(x[i])


@law
def relative_volume(
    pressure, temperature, bulk_modulus, derivative, reference, softening, expansion
):
    """V/V_R = [1 + a (T - T_R)] {1 - ln[1 + p (1 + K_0')/K_0(T)]/(1 + K_0')}, Tait [-]."""
    above = temperature - reference
    modulus = bulk_modulus * np.exp(-softening * above)
    k = 1.0 + derivative
    return (1.0 + expansion * above) * (1.0 - np.log1p(pressure * k / modulus) / k)


@law
def dowson_higginson(pressure, numerator, denominator):
    """rho/rho_0 = 1 + d_1 p/(1 + d_2 p), Dowson and Higginson (1966) [-]."""
    return 1.0 + numerator * pressure / (1.0 + denominator * pressure)


@law
def dowson_higginson_slope(pressure, numerator, denominator):
    """Derivative of `dowson_higginson` by the pressure."""
    return numerator / (1.0 + denominator * pressure) ** 2


@law
def roelands_rise(ratio, exponent):
    """(1 + p/p_r)^z [-], Roelands (1966), at p/p_r."""
    return np.exp(exponent * np.log1p(ratio))


@law
def log_roelands(rise, above, beta, slope, room):
    """ln(eta/eta_0) = s {(1 + p/p_r)^z [(T - 138 K)/(T_0 - 138 K)]^(-S) - 1}, Roelands (1966),
    with T - T_0 `above` and T_0 - 138 K `room` [K].
    """
    warm = np.maximum(1.0 + above / room, SMALLEST_WARMTH)
    return slope * (rise * np.exp(-beta * room / slope * np.log(warm)) - 1.0)


@law
def log_doolittle(volume, occupied, factor, occupied_fraction):
    """ln(eta/eta_R) = B R {O/[V/V_R - R O] - 1/(1 - R)}, Doolittle (1951), Bair (2007) [-];
    infinite where the occupied volume fills the whole.
    """
    free = np.maximum(volume - occupied_fraction * occupied, 0.0)
    ratio = occupied / free - 1.0 / (1.0 - occupied_fraction)
    return factor * occupied_fraction * ratio


@law
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


@law
def log_modulus(pressure, temperature, operation, beta, a1, a2, b1, b2, vogel):
    """ln(eta/eta_0) = p/[a_1 + a_2 T + (b_1 + b_2 T) p] - beta D, D = T - T_0 [-].

    D/[1 + D/(T_0 - T_v)] replaces D, Vogel's law, unless T_v is zero.
    """
    above = temperature - operation
    if vogel > 0.0:
        above = above / np.maximum(1.0 + above / (operation - vogel), SMALLEST_WARMTH)
    modulus = a1 + a2 * temperature + (b1 + b2 * temperature) * pressure
    return pressure / modulus - beta * above


@law
def log_scaled(volume, relative_temperature, factor, limit, exponent):
    """ln(eta/eta_inf) = B phi_inf/(phi - phi_inf), phi = (T/T_R) (V/V_R)^g, Bair (2019) [-];
    infinite where phi reaches phi_inf, the glass.
    """
    phi = relative_temperature * np.maximum(volume, 0.0) ** exponent
    return factor * limit / np.maximum(phi - limit, 0.0)


@law
def fitted_conductivity(pressure, c1, c2):
    """k/k_0 = 1 + c_1 p/(1 + c_2 p), Larsson and Andersson (2000) [-]."""
    return 1.0 + c1 * pressure / (1.0 + c2 * pressure)


@law
def fitted_capacity(pressure, temperature, a1, a2, b0, b1, b2, reference):
    """[1 + a_1 p/(1 + a_2 p)] [1 + b (T - T_R)], b = b_0 (1 + b_1 p + b_2 p^2), Larsson and
    Andersson (2000) [-].
    """
    rise = 1.0 + a1 * pressure / (1.0 + a2 * pressure)
    slope = b0 * (1.0 + b1 * pressure + b2 * pressure * pressure)
    return rise * (1.0 + slope * (temperature - reference))


@law
def volume_conductivity(volume, relative_temperature, base, scale, exponent, factor, power):
    """k = B + C K^-s, K = (V/V_R) [1 - A (T/T_R) (V/V_R)^q], Habchi and Bair [W/(m K)]."""
    scaling = volume * (1.0 - factor * relative_temperature * volume**power)
    return base + scale * scaling**-exponent


@law
def volume_capacity(volume, relative_temperature, base, scale, power):
    """rho c = C_0 + m (T/T_R) (V/V_R)^-4, Habchi and Bair [J/(m^3 K)]."""
    return base + scale * relative_temperature * volume**power


@law
def oil_volume(pressure, temperature, oil):
    """V/V_R of an oil with Tait's equation of state [-]."""
    return relative_volume(
        pressure, temperature, oil[T], oil[T + 1], oil[T + 2], oil[T + 3], oil[T + 4]
    )


@law
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


@law
def log_viscosity_ratio(pressure, temperature, oil):
    """ln(eta/eta_0), at most EXPONENT_LIMIT [-]."""
    return log_viscosity_at(pressure, pressure_rise(pressure, oil), temperature, oil)


@law
def pressure_rise(pressure, oil):
    """(1 + p/p_r)^z of Roelands' law [-], once for all temperatures of a column; else not used."""
    if int(oil[VISCOSITY_LAW]) == ROELANDS:
        return roelands_rise(pressure / oil[V + 1], oil[V + 2])
    return 1.0


@law
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


@law
def viscosity(pressure, temperature, oil):
    """Dynamic viscosity [Pa s]."""
    return oil[VISCOSITY] * np.exp(log_viscosity_ratio(pressure, temperature, oil))


@law
def density_ratio(pressure, temperature, oil):
    """rho/rho_0 [-]."""
    if int(oil[DENSITY_LAW]) == TAIT:
        ratio = oil_volume(0.0, oil[OPERATION], oil) / oil_volume(pressure, temperature, oil)
        if oil[T + 4] > 0.0:
            return ratio
    else:
        ratio = dowson_higginson(pressure, oil[D], oil[D + 1])
    return ratio * np.exp(-oil[EXPANSION] * (temperature - oil[OPERATION]))


@law
def density_slope(pressure, oil):
    """d(rho/rho_0)/dp at the temperature of operation [1/Pa]."""
    if int(oil[DENSITY_LAW]) == TAIT:
        above = oil[OPERATION] - oil[T + 2]
        modulus = oil[T] * np.exp(-oil[T + 3] * above)
        k = 1.0 + oil[T + 1]
        volume = 1.0 - np.log1p(pressure * k / modulus) / k
        return 1.0 / ((modulus + k * pressure) * volume * volume)
    return dowson_higginson_slope(pressure, oil[D], oil[D + 1])


@law
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


@law
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


@compiled
def _roelands_softening(temperature, log_ratio, oil):
    room = oil[V + 3]
    warm = 1.0 + (temperature - oil[OPERATION]) / room
    if log_ratio >= EXPONENT_LIMIT or warm <= SMALLEST_WARMTH:
        return 0.0
    return oil[BETA] * (1.0 + log_ratio / oil[V]) / warm


@compiled
def column_log_viscosity(pressure, temperature, oil, out):
    """`log_viscosity_ratio` at the temperatures of a column, the law chosen once."""
    pressed = pressure_rise(pressure, oil)
    if int(oil[VISCOSITY_LAW]) == ROELANDS:
        room = oil[V + 3]
        for k in range(temperature.size):
            out[k] = max(1.0 + (temperature[k] - oil[OPERATION]) / room, SMALLEST_WARMTH)
        logarithm(out)
        for k in range(temperature.size):
            power = -oil[BETA] * room / oil[V] * out[k]
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
    if int(oil[VISCOSITY_LAW]) == ROELANDS:
        for k in range(temperature.size):
            out[k] = _roelands_softening(temperature[k], log_ratio[k], oil)
    else:
        for k in range(temperature.size):
            out[k] = softening_at(pressure, temperature[k], log_ratio[k], oil)


@compiled
def column_density(pressure, temperature, oil, out):
    """`density_ratio` at the temperatures of a column, the law chosen once."""
    if int(oil[DENSITY_LAW]) == TAIT:
        for k in range(temperature.size):
            out[k] = density_ratio(pressure, temperature[k], oil)
    else:
        pressed = density_ratio(pressure, oil[OPERATION], oil)
        for k in range(temperature.size):
            out[k] = -oil[EXPANSION] * (temperature[k] - oil[OPERATION])
        exponential(out)
        for k in range(temperature.size):
            out[k] *= pressed


@compiled
def viscosity_softening(pressure, temperature, oil):
    """-d(ln eta)/dT [1/K], central difference."""
    cold = log_viscosity_ratio(pressure, temperature - SLOPE_STEP, oil)
    return (cold - log_viscosity_ratio(pressure, temperature + SLOPE_STEP, oil)) / (
        2.0 * SLOPE_STEP
    )


@compiled
def softening_at(pressure, temperature, log_ratio, oil):
    """-d(ln eta)/dT [1/K] at ln(eta/eta_0): of Roelands' and Barus' laws in closed
    form, of others by `viscosity_softening`.
    """
    code = int(oil[VISCOSITY_LAW])
    if log_ratio >= EXPONENT_LIMIT:
        return 0.0
    if code in (ISOVISCOUS, BARUS):
        return oil[BETA]
    if code == ROELANDS:
        return _roelands_softening(temperature, log_ratio, oil)
    return viscosity_softening(pressure, temperature, oil)


@compiled
def thermal_expansion(pressure, temperature, oil):
    """-d(ln rho)/dT [1/K]; of Tait's own temperature a central difference."""
    if int(oil[DENSITY_LAW]) != TAIT:
        return oil[EXPANSION]
    cold = density_ratio(pressure, temperature - SLOPE_STEP, oil)
    return np.log(cold / density_ratio(pressure, temperature + SLOPE_STEP, oil)) / (
        2.0 * SLOPE_STEP
    )


@compiled
def flow_properties(
    P, H, hertz_pressure, oil, thinning, at, speed, eps, rho, rho_slope, first, stop
):
    """eps = rho H^3/(eta lambda), rho and d(rho)/dP [-] of the lines from `first` to before
    `stop`, any law, at the temperature of operation. thinning: fraction of the change of
    ln(eta), from that `at` the pressure of the factors, that these take back; empty without any.
    """
    nx = P.shape[1]
    for j in range(first, stop):
        for i in range(nx):
            h = max(H[j, i], 0.0)
            p = max(P[j, i], 0.0) * hertz_pressure
            density = density_ratio(p, oil[OPERATION], oil)
            rho[j, i] = density
            rho_slope[j, i] = density_slope(p, oil) * hertz_pressure
            thinner = -log_viscosity_ratio(p, oil[OPERATION], oil)
            if thinning.size > 0:
                thinner -= thinning[j, i] * (thinner + at[j, i])
            eps[j, i] = density * h * h * h / speed * np.exp(thinner)


@law
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


@compiled
def inverse_sine(x):
    """asinh(x), x >= 0, by a logarithm, faster than the library's; a series near zero."""
    if x < SMALL_SINE:
        return x * (1.0 - x * x * (1.0 / 6.0 - 0.075 * x * x))
    return np.log(x + np.sqrt(x * x + 1.0))


@compiled
def blend(ratio):
    """(1 + ratio^m)^(1/m), m = LIMIT_POWER, of a ratio up to 1 [-]."""
    power = ratio
    for _ in range(LIMIT_ROOTS):
        power *= power
    return root_of(power)


@compiled
def root_of(power):
    """(1 + power)^(1/m), of a power up to 1 [-], without jumps: exp by its series, whose argument
    is ln(2)/m at most.
    """
    t = logarithm_of(1.0 + power) / LIMIT_POWER
    series = 1.0 + t / 4.0 * (1.0 + t / 5.0 * (1.0 + t / 6.0 * (1.0 + t / 7.0)))
    return 1.0 + t * (1.0 + t / 2.0 * (1.0 + t / 3.0 * series))


@compiled
def limited(tau, limit, law):
    """Stress of a base law under a limiting one, both positive [Pa], as `rheology.limited`."""
    if law == NEWTONIAN:
        return -limit * np.expm1(-tau / limit)
    if tau <= limit:
        return tau / blend(tau / limit)
    return limit / blend(limit / tau)


@compiled
def unlimited(share, limit, law):
    """Inverse of `limited`, and its derivative by the stress, at a share < 1 of the limit."""
    if law == NEWTONIAN:
        return -limit * np.log1p(-share), 1.0 / (1.0 - share)
    power = share
    for _ in range(LIMIT_ROOTS):
        power *= power
    rest = 1.0 - power
    slope = rest ** (-1.0 / LIMIT_POWER)
    return share * limit * slope, slope / rest


@compiled
def shear_stress(rate, viscosity, limit, law, stress, exponent, breadth):
    """Stress magnitude [Pa] at the magnitude of a rate [1/s]; limiting stress or inf [Pa]."""
    tau = viscosity * rate
    if law == REE_EYRING:
        tau = stress * inverse_sine(tau / stress)
    elif law == CARREAU_YASUDA:
        tau *= (1.0 + (tau / stress) ** breadth) ** ((exponent - 1.0) / breadth)
    if np.isfinite(limit):
        tau = limited(tau, limit, law)
    return tau


@compiled
def shear_stresses(rate, viscosity, limit, law, stress, exponent, breadth, out):
    """`shear_stress` of n nodes."""
    for i in range(out.size):
        out[i] = shear_stress(rate[i], viscosity[i], limit[i], law, stress, exponent, breadth)


@compiled
def limited_stresses(tau, limit, law, out):
    """`limited` of n nodes, of which some may have no limit."""
    for i in range(out.size):
        out[i] = limited(tau[i], limit[i], law) if np.isfinite(limit[i]) else tau[i]


@compiled
def shear_stress_slope(rate, viscosity, limit, law, stress, exponent, breadth):
    """Stress as `shear_stress`, with its derivative by the rate [Pa s]."""
    if law == REE_EYRING:
        return eyring_stress_slope(rate, viscosity, limit, stress)
    tau = viscosity * rate
    slope = viscosity
    if law == CARREAU_YASUDA:
        power = (tau / stress) ** breadth
        factor = (1.0 + power) ** ((exponent - 1.0) / breadth)
        slope = viscosity * factor * (1.0 + exponent * power) / (1.0 + power)
        tau *= factor
    elif np.isfinite(limit):
        return limited(tau, limit, law), slope * np.exp(-tau / limit)
    return limited_slope(tau, slope, limit)


@compiled
def eyring_stress_slope(rate, viscosity, limit, stress):
    """Stress and slope as `shear_stress_slope` of Ree and Eyring's law."""
    tau, slope = eyring_slope(rate, viscosity, stress)
    return limited_slope(tau, slope, limit)


@compiled
def eyring_slope(rate, viscosity, stress):
    """The same without a limit and without jumps, so that a loop over nodes takes several at a
    time.
    """
    x = viscosity * rate / stress
    root = np.sqrt(x * x + 1.0)
    tau = stress * logarithm_of(x + root)
    if x < SMALL_SINE:
        tau = stress * x * (1.0 - x * x * (1.0 / 6.0 - 0.075 * x * x))
    return tau, viscosity / root


@compiled
def limited_slope(tau, slope, limit):
    """Stress of a base law other than Newton's and its derivative under a limiting stress, which
    may be infinite; without jumps, so that a loop over nodes takes several at a time.
    """
    larger = max(tau, limit)
    ratio = min(tau, limit) / larger
    power = ratio * ratio
    for _ in range(LIMIT_ROOTS - 1):
        power *= power
    over = 1.0 / (root_of(power) * (1.0 + power))
    bent = slope * over
    if tau > limit:
        bent *= power * ratio
    near = ratio * larger * over * (1.0 + power)
    if tau >= FAR_BELOW * limit:
        tau = near
        slope = bent
    return tau, slope


@compiled
def _carreau_inverse(s, exponent, breadth):
    """x of x [1 + x^a]^((n - 1)/a) = s by Newton's method in ln x."""
    if s <= 0.0:
        return s
    target = np.log(s)
    u = max(target, target / exponent)
    for _ in range(NEWTON_STEPS):
        power = breadth * u
        knee = power + np.log1p(np.exp(-power)) if power > 0.0 else np.log1p(np.exp(power))
        step = (u + (exponent - 1.0) / breadth * knee - target) / (
            1.0 + (exponent - 1.0) * np.exp(power - knee)
        )
        u -= step
        if abs(step) < 1e-14:
            break
    return np.exp(min(u, LARGEST_ARGUMENT))


@compiled
def shear_rate(tau, viscosity, limit, law, stress, exponent, breadth):
    """Rate [1/s] at a stress magnitude [Pa], inverse of `shear_stress`; inf from the limit."""
    if np.isfinite(limit):
        if tau >= limit:
            return np.inf
        tau, _ = unlimited(tau / limit, limit, law)
    if law == REE_EYRING:
        return stress * np.sinh(min(tau / stress, LARGEST_ARGUMENT)) / viscosity
    if law == CARREAU_YASUDA:
        return stress * _carreau_inverse(tau / stress, exponent, breadth) / viscosity
    return tau / viscosity
