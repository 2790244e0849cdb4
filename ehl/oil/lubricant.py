"""Lubricant: density and viscosity over pressure, and over temperature with thermal data."""

from dataclasses import dataclass
from enum import Enum
from math import log

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array
from ..ranges import require_not_negative, require_positive
from .free_volume import (
    DoolittleFreeVolume,
    TaitVolume,
    YasutomiGlass,
    log_viscosity_doolittle,
    log_viscosity_yasutomi,
    pressure_viscosity_doolittle,
    pressure_viscosity_yasutomi,
    relative_volume,
)
from .heat_properties import FittedHeat, VolumeHeat, fitted_ratios, volume_heat
from .pressure_laws import (
    PressureModulus,
    ScaledVolume,
    log_viscosity_modulus,
    log_viscosity_scaled,
    pressure_viscosity_modulus,
    pressure_viscosity_scaled,
)

ROELANDS_PRESSURE = 1.96e8  # p_r [Pa], Roelands (1966)
# Layer at flooded inlets [m], assumed: the order of what a ball of a 6208 carries along against
# the centrifugal acceleration, (eta u/(rho g))^(1/2) with u^2/r for g (after Derjaguin, 1943).
# Half and double of it change the rolling torque of 6208_full_ceramic by -8 and +7 %.
FLOODED_LAYER = 1e-4
# ln(eta_0 / eta_inf) = ln(eta_0) + 9.67, eta_0 in Pa s, Roelands (1966)
ROELANDS_LOG_OFFSET = 9.67
ROELANDS_TEMPERATURE = 138.0  # [K], -135 degrees Celsius, Roelands (1966)
DOWSON_HIGGINSON_NUMERATOR = 0.6e-9  # [1/Pa], Dowson and Higginson (1966)
DOWSON_HIGGINSON_DENOMINATOR = 1.7e-9  # [1/Pa], Dowson and Higginson (1966)
# share by which a given coefficient may differ from that of the law's constants
PRESSURE_VISCOSITY_TOLERANCE = 0.01


class ViscosityLaw(Enum):
    """Pressure dependence of the viscosity."""

    ROELANDS = "roelands"
    BARUS = "barus"
    ISOVISCOUS = "isoviscous"
    TAIT_DOOLITTLE = "tait-doolittle"
    YASUTOMI = "yasutomi"
    MODULUS = "modulus"
    SCALED = "scaled-volume"


class DensityLaw(Enum):
    """Pressure dependence of the density."""

    DOWSON_HIGGINSON = "dowson-higginson"
    INCOMPRESSIBLE = "incompressible"
    TAIT = "tait"


@dataclass(frozen=True, slots=True, kw_only=True)
class ThermalProperties:
    """What a solve with heat needs beside the isothermal properties of an oil, SI."""

    conductivity: float  # k [W/(m K)]
    specific_heat: float  # c [J/(kg K)]
    # beta = -d(ln eta)/dT at ambient pressure and the temperature of operation [1/K]; not used by
    # laws with a temperature dependence of their own
    viscosity_temperature: float
    expansion: float = 0.0  # -d(ln rho)/dT [1/K]
    # of both under pressure and over temperature; None: k and c constant
    under_pressure: FittedHeat | VolumeHeat | None = None

    def __post_init__(self) -> None:
        require_positive(self, "conductivity", "specific_heat")
        require_not_negative(self, "viscosity_temperature", "expansion")


@dataclass(frozen=True, slots=True, kw_only=True)
class Lubricant:
    """Oil properties at the temperature of operation, SI."""

    viscosity: float  # eta_0, dynamic, at ambient pressure [Pa s]
    pressure_viscosity: float  # d(ln eta)/dp at ambient pressure [1/Pa]
    density: float = 870.0  # at ambient pressure [kg/m^3]
    viscosity_law: ViscosityLaw = ViscosityLaw.ROELANDS
    density_law: DensityLaw = DensityLaw.DOWSON_HIGGINSON
    roelands_z: float | None = None  # exponent z [-]; None: from Roelands' identity
    roelands_pressure: float = ROELANDS_PRESSURE  # p_r [Pa]
    name: str = ""
    # of operation, at which the values hold [K]; needed by laws that depend on it and with heat
    temperature: float | None = None
    tait: TaitVolume | None = None  # of the density law and of Doolittle's viscosity law
    doolittle: DoolittleFreeVolume | None = None  # of the viscosity law tait-doolittle
    yasutomi: YasutomiGlass | None = None  # of the viscosity law yasutomi
    modulus: PressureModulus | None = None  # of the viscosity law modulus
    scaled: ScaledVolume | None = None  # of the viscosity law scaled-volume
    thermal: ThermalProperties | None = None  # for a solve with heat
    # layer at the inlets of flooded contacts, both surfaces together: the rolling moment counts
    # oil up to where the gap is as wide [m]
    flooded_layer: float = FLOODED_LAYER

    def __post_init__(self) -> None:
        require_positive(self, "viscosity", "density", "roelands_pressure", "flooded_layer")
        require_not_negative(self, "pressure_viscosity")
        if self.viscosity_law is ViscosityLaw.ROELANDS and not 0.0 < self.exponent <= 2.0:
            raise ValueError(f"roelands_z must lie in (0, 2], got {self.exponent!r}")
        if self.temperature is not None:
            require_positive(self, "temperature")
        _require_constants(self)

    @property
    def piezoviscous(self) -> bool:
        """Whether the viscosity rises with the pressure; the coefficient of an isoviscous oil is
        not used.
        """
        return self.viscosity_law is not ViscosityLaw.ISOVISCOUS and self.pressure_viscosity > 0.0

    @property
    def exponent(self) -> float:
        """Roelands' z [-]: as given, or z = alpha p_r / (ln eta_0 + 9.67), Roelands (1966)."""
        if self.roelands_z is not None:
            return self.roelands_z
        rise = log(self.viscosity) + ROELANDS_LOG_OFFSET
        return self.pressure_viscosity * self.roelands_pressure / rise


NEEDED_BY_LAW = {  # fields beside viscosity and coefficient
    ViscosityLaw.TAIT_DOOLITTLE: ("tait", "doolittle", "temperature"),
    ViscosityLaw.YASUTOMI: ("yasutomi", "temperature"),
    ViscosityLaw.MODULUS: ("modulus", "temperature"),
    ViscosityLaw.SCALED: ("tait", "scaled", "temperature"),
}


def _require_constants(lubricant: Lubricant) -> None:
    """Each law has its constants, and they agree with the pressure-viscosity coefficient."""
    needed = NEEDED_BY_LAW.get(lubricant.viscosity_law, ())
    if lubricant.density_law is DensityLaw.TAIT:
        needed = (*needed, "tait", "temperature")
    for field in needed:
        if getattr(lubricant, field) is None:
            laws = f"{lubricant.viscosity_law.value}, {lubricant.density_law.value}"
            raise ValueError(f"{field} is needed by the laws {laws}")
    own = law_pressure_viscosity(lubricant)
    given = lubricant.pressure_viscosity
    if abs(given - own) > PRESSURE_VISCOSITY_TOLERANCE * own:
        wanted = f"that of the law's constants, {own:.4e} 1/Pa"
        raise ValueError(f"pressure_viscosity must be {wanted}, got {given!r}")


def law_pressure_viscosity(lubricant: Lubricant) -> float:
    """d(ln eta)/dp at ambient pressure that the constants of the lubricant's law imply [1/Pa]."""
    oil = lubricant
    law = oil.viscosity_law
    if law is ViscosityLaw.TAIT_DOOLITTLE and oil.tait and oil.doolittle and oil.temperature:
        return pressure_viscosity_doolittle(oil.tait, oil.doolittle, oil.temperature)
    if law is ViscosityLaw.YASUTOMI and oil.yasutomi and oil.temperature:
        return pressure_viscosity_yasutomi(oil.yasutomi, oil.temperature)
    if law is ViscosityLaw.MODULUS and oil.modulus and oil.temperature:
        return pressure_viscosity_modulus(oil.modulus, oil.temperature)
    if law is ViscosityLaw.SCALED and oil.tait and oil.scaled and oil.temperature:
        return pressure_viscosity_scaled(oil.tait, oil.scaled, oil.temperature)
    return oil.pressure_viscosity


def log_viscosity_ratio(
    p: ArrayLike, lubricant: Lubricant, temperature: ArrayLike | None = None
) -> Array:
    """ln(eta/eta_0) at a pressure [Pa] after the lubricant's own law, eta_0 at ambient pressure
    and the temperature of operation T_0 [-].

    At another temperature [K], D = T - T_0: Roelands (1966) s {(1 + p/p_r)^z [(T - 138 K)/(T_0 -
    138 K)]^(-S) - 1}, s = alpha p_r/z, S such that -d(ln eta)/dT = beta at T_0 and ambient
    pressure; Yasutomi, the modulus, the scaled volume, and Doolittle with an expansion of the
    occupied volume, as their laws say; the others -beta D on top of the isothermal law, Barus
    (1893) alpha p.
    """
    oil = lubricant
    law = oil.viscosity_law
    p = np.asarray(p, dtype=np.float64)
    start = oil.temperature or 0.0
    above = np.zeros(()) if temperature is None else np.asarray(temperature) - _operation(oil)
    if law is ViscosityLaw.MODULUS and oil.modulus:
        beta = _beta(oil, temperature)
        return log_viscosity_modulus(p, start + above, start, beta, oil.modulus)
    if law is ViscosityLaw.SCALED and oil.tait and oil.scaled:
        reference = log_viscosity_scaled(0.0, start, oil.tait, oil.scaled)
        return log_viscosity_scaled(p, start + above, oil.tait, oil.scaled) - reference
    if law is ViscosityLaw.YASUTOMI and oil.yasutomi:
        reference = log_viscosity_yasutomi(0.0, start, oil.yasutomi)
        return log_viscosity_yasutomi(p, start + above, oil.yasutomi) - reference
    if law is ViscosityLaw.TAIT_DOOLITTLE and oil.tait and oil.doolittle:
        result = log_viscosity_doolittle(p, start + above, oil.tait, oil.doolittle)
        result = result - log_viscosity_doolittle(0.0, start, oil.tait, oil.doolittle)
        own = oil.doolittle.occupied_expansion is not None
        return result if own else result - _beta(oil, temperature) * above
    if law is ViscosityLaw.ROELANDS and oil.pressure_viscosity > 0.0:
        return _log_roelands(p, oil, None if temperature is None else above)
    slope = oil.pressure_viscosity if law is ViscosityLaw.BARUS else 0.0
    return slope * p - _beta(oil, temperature) * above


def roelands_rise(ratio: ArrayLike, exponent: float) -> Array:
    """(1 + p/p_r)^z [-], Roelands (1966), at p/p_r."""
    return np.asarray((1.0 + np.asarray(ratio)) ** exponent)


def _log_roelands(p: Array, oil: Lubricant, above: Array | None) -> Array:
    z = oil.exponent
    p_r = oil.roelands_pressure
    s = oil.pressure_viscosity * p_r / z
    rise = roelands_rise(p / p_r, z)
    if above is not None:
        lowest = ROELANDS_TEMPERATURE
        start = _operation(oil)
        room = start - lowest
        if room <= 0.0:
            raise ValueError(
                f"temperature must exceed {lowest:g} K for Roelands' law, got {start}"
            )
        # the law ends at 138 K, iterates may fall below
        relative = np.maximum(1.0 + above / room, 1e-3)
        rise = rise * relative ** (-_beta(oil, above) * room / s)
    return s * (rise - 1.0)


def _operation(oil: Lubricant) -> float:
    if oil.temperature is None:
        raise ValueError("temperature of the lubricant is needed to vary it")
    return oil.temperature


def _beta(oil: Lubricant, temperature: ArrayLike | None) -> float:
    if temperature is None:
        return 0.0
    if oil.thermal is None:
        raise ValueError("thermal properties of the lubricant are needed to vary its temperature")
    return oil.thermal.viscosity_temperature


def viscosity(p: ArrayLike, lubricant: Lubricant, temperature: ArrayLike | None = None) -> Array:
    """Dynamic viscosity [Pa s] at `p` [Pa] and temperature [K] after the lubricant's law."""
    return lubricant.viscosity * np.exp(log_viscosity_ratio(p, lubricant, temperature))


def secant_pressure_viscosity(
    p: Array, lubricant: Lubricant, temperature: float | None = None
) -> Array:
    """alpha(p, T) = ln[eta(p, T)/eta(0, T)]/p [1/Pa], at pressures of shape (n,) [Pa] and a
    temperature [K].
    """
    pressures = np.concatenate([[0.0], p])
    at = None if temperature is None else np.full_like(pressures, temperature)
    found = log_viscosity_ratio(pressures, lubricant, at)
    return np.asarray((found[1:] - found[0]) / p)


def density(p: ArrayLike, lubricant: Lubricant, temperature: ArrayLike | None = None) -> Array:
    """Density [kg/m^3] at pressure `p` [Pa] and temperature [K] after the lubricant's own law.

    rho_0 [1 + 0.6 p/(1 + 1.7 p)], p in GPa, Dowson and Higginson (1966), or rho_0; both times
    exp[-e (T - T_0)] with the oil's thermal expansion e. Tait: rho_0 V(0, T_0)/V(p, T), with that
    factor if Tait's own expansion is zero.
    """
    oil = lubricant
    p = np.asarray(p, dtype=np.float64)
    if oil.density_law is DensityLaw.TAIT and oil.tait:
        start = _operation(oil)
        now = start if temperature is None else temperature
        ratio = relative_volume(0.0, start, oil.tait) / relative_volume(p, now, oil.tait)
        if oil.tait.expansion > 0.0:
            return oil.density * ratio
    elif oil.density_law is DensityLaw.DOWSON_HIGGINSON:
        ratio = 1.0 + DOWSON_HIGGINSON_NUMERATOR * p / (1.0 + DOWSON_HIGGINSON_DENOMINATOR * p)
    else:
        ratio = np.ones_like(p)
    if temperature is not None and oil.thermal is not None:
        above = np.asarray(temperature) - _operation(oil)
        ratio = ratio * np.exp(-oil.thermal.expansion * above)
    return oil.density * ratio


def heat_properties(
    p: ArrayLike, lubricant: Lubricant, temperature: ArrayLike
) -> tuple[Array, Array]:
    """Conductivity [W/(m K)] and heat capacity rho c [J/(m^3 K)] at a pressure [Pa] and
    temperature [K]; ValueError without thermal properties.

    With a law of their own these are those at ambient pressure and the temperature of operation
    times its ratios; else k is constant, and c, so that rho c follows the density.
    """
    oil = lubricant
    if oil.thermal is None:
        raise ValueError("thermal properties of the lubricant are needed")
    k = oil.thermal.conductivity
    capacity = oil.density * oil.thermal.specific_heat
    law = oil.thermal.under_pressure
    start = _operation(oil)
    if isinstance(law, FittedHeat):
        ratios = fitted_ratios(p, temperature, start, law)
        return k * ratios[0], capacity * ratios[1]
    if isinstance(law, VolumeHeat) and oil.tait:
        there = volume_heat(p, temperature, oil.tait, law)
        ambient = volume_heat(0.0, start, oil.tait, law)
        return k * there[0] / ambient[0], capacity * there[1] / ambient[1]
    rho = density(p, oil, temperature)
    return np.full_like(rho, k), rho * oil.thermal.specific_heat
