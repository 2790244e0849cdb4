"""Shear laws for compiled kernels, after those of `rheology.py`: scalars in, scalars out.

The arguments law, stress, exponent, breadth and those of the limit are the fields of
`KernelRheology`.
"""

import numpy as np

from ..compiled import compiled
from ._elementary_kernels import logarithm_of
from ._kernels import law

# codes of the base laws
NEWTONIAN = 0
REE_EYRING = 1
CARREAU_YASUDA = 2
# of exponentials: keeps the rate finite at stresses that only occur while iterating
LARGEST_ARGUMENT = 300.0
LIMIT_POWER = 32  # m of the limiting stress on other laws than Newton's [-]
LIMIT_ROOTS = 5  # square roots in a row that are the m-th root [-]
SMALL_SINE = 2e-3  # below which the series of asinh is exact [-]
FAR_BELOW = 0.25  # of a limit, whose m-th power is negligible [-]
NEWTON_STEPS = 30


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
    """As `shear_stress`, with its derivative by the rate [Pa s]."""
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
    """As `shear_stress_slope` of Ree and Eyring's law."""
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
