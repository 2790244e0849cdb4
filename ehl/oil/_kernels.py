"""Viscosity, density, heat and shear of an oil for compiled kernels; see `_laws`."""

import numpy as np
from numba.extending import register_jitable

from ..compiled import compiled
from ._laws import (
    BARUS,
    BETA,
    CARREAU_YASUDA,
    DENSITY_LAW,
    EXPANSION,
    EXPONENT_LIMIT,
    ISOVISCOUS,
    LARGEST_ARGUMENT,
    LAWS,
    NEWTONIAN,
    OPERATION,
    REE_EYRING,
    ROELANDS,
    SLOPE_STEP,
    SMALLEST_WARMTH,
    TAIT,
    VISCOSITY_LAW,
    V,
    density_ratio,
    density_slope,
    log_viscosity_at,
    log_viscosity_ratio,
    pressure_rise,
)

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


for _law in LAWS:
    register_jitable(error_model="numpy")(_law)

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
