"""A lubricant: density, viscosity, conductivity and heat capacity over pressure and, with thermal
data, over temperature, and the layer of it that both surfaces carry into a contact.

Conductivity and heat capacity count over those at ambient pressure and the temperature of
operation. The constants of the laws by a modulus that grows with pressure, and by thermodynamic
scaling, belong to one oil and come with a source: none has a default.
"""

from collections.abc import Callable, Mapping
from dataclasses import astuple, dataclass, field
from enum import Enum
from functools import lru_cache
from itertools import pairwise
from math import isfinite, log
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array
from ..options import require_finite, require_not_negative, require_positive
from . import _laws
from .free_volume import (
    DoolittleFreeVolume,
    TaitVolume,
    YasutomiGlass,
    pressure_viscosity_doolittle,
    pressure_viscosity_yasutomi,
    relative_volume,
    yasutomi_constants,
)

CAPACITY_POWER = -4.0  # of the volume in rho c, Habchi and Bair [-]

ROELANDS_PRESSURE = 1.96e8  # p_r [Pa], Roelands (1966)
# Layer at flooded inlets [m], assumed: the order of what a ball of a 6208 carries along against
# the centrifugal acceleration, (eta u/(rho g))^(1/2) with u^2/r for g (after Derjaguin, 1943).
# Half and double of it change the rolling torque of 6208_full_ceramic by -8 and +7 %.
DRY = "dry"  # name of the lubricant that is none
FLOODED_LAYER = 1e-4
# ln(eta_0 / eta_inf) = ln(eta_0) + 9.67, eta_0 in Pa s, Roelands (1966)
ROELANDS_LOG_OFFSET = 9.67
ROELANDS_TEMPERATURE = 138.0  # [K], -135 degrees Celsius, Roelands (1966)
# least excess of the temperature of operation over Roelands' lowest in the array of an oil [K];
# colder oils are refused as soon as their temperature is to vary
SMALLEST_ROOM = 1e-3
UNNAMED_TEMPERATURE = 298.15  # of an oil without one, with which nothing varies then [K]
DOWSON_HIGGINSON_NUMERATOR = 0.6e-9  # [1/Pa], Dowson and Higginson (1966)
DOWSON_HIGGINSON_DENOMINATOR = 1.7e-9  # [1/Pa], Dowson and Higginson (1966)
# fraction by which a prescribed coefficient may differ from that of the law's constants
PRESSURE_VISCOSITY_TOLERANCE = 0.01

# laws whose ln(eta) counts from another viscosity: column of its value at ambient pressure
AMBIENT_COLUMNS = {
    _laws.TAIT_DOOLITTLE: _laws.V + 4,
    _laws.YASUTOMI: _laws.V + 8,
    _laws.SCALED: _laws.V + 3,
}


@dataclass(frozen=True, slots=True, kw_only=True)
class InletLayer:
    """Thickness of the inlet layer at ambient density over positions across the track.

    Both are in [m], or in the units of the solver [-]; beyond its ends the thickness is constant.

    Raises
    ------
    ValueError
        If positions do not rise, a thickness is not positive, or their numbers differ. A dry track
        has no film.
    """

    thickness: tuple[float, ...]  # one for all positions, or one for each
    y: tuple[float, ...] = (0.0,)  # rising

    def __post_init__(self) -> None:
        if len(self.y) != len(self.thickness) or not self.y:
            raise ValueError("inlet layer: as many positions y as thicknesses, one at least")
        if not all(a < b for a, b in pairwise(self.y)):
            raise ValueError("inlet layer: positions y must rise")
        if not all(isfinite(h) and h > 0.0 for h in self.thickness):
            raise ValueError("inlet layer: every thickness must be positive and finite")

    @property
    def uniform(self) -> bool:
        """The thickness is the same everywhere."""
        return min(self.thickness) == max(self.thickness)

    @property
    def central(self) -> float:
        """Thickness at y = 0."""
        return float(np.interp(0.0, self.y, self.thickness))

    def at(self, y: Array) -> Array:
        """Thickness at positions across the track.

        Parameters
        ----------
        y : Array
            positions, any shape [unit of the layer's y]

        Returns
        -------
        Array
            thickness, shape of `y` [unit of the layer's thickness]
        """
        return np.interp(y, self.y, self.thickness)

    def scaled(self, length: float, height: float) -> "InletLayer":
        """The layer in units of a length along y and of a height.

        Parameters
        ----------
        length : float
            unit of the positions [m]
        height : float
            unit of the thickness [m]

        Returns
        -------
        InletLayer
            the dimensionless layer [-]
        """
        return InletLayer(
            thickness=tuple(h / height for h in self.thickness),
            y=tuple(position / length for position in self.y),
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class FittedHeat:
    """Constants of conductivity and heat capacity after Larsson and Andersson (2000).

    k = k_0 [1 + c_1 p/(1 + c_2 p)], rho c = (rho c)_0 [1 + a_1 p/(1 + a_2 p)] [1 + b (T - T_R)], b
    = b_0 (1 + b_1 p + b_2 p^2). Beyond the largest pressure and temperature of their data the
    values stay.
    """

    conductivity_1: float  # c_1 [1/Pa]
    conductivity_2: float  # c_2 [1/Pa]
    capacity_1: float  # a_1 [1/Pa]
    capacity_2: float  # a_2 [1/Pa]
    temperature_0: float  # b_0 [1/K]
    temperature_1: float  # b_1 [1/Pa]
    temperature_2: float  # b_2 [1/Pa^2]
    reference_temperature: float  # T_R [K]
    largest_pressure: float  # [Pa]
    largest_temperature: float  # [K]

    def __post_init__(self) -> None:
        require_positive(self, "conductivity_1", "conductivity_2", "capacity_1", "capacity_2")
        require_positive(self, "reference_temperature", "largest_pressure", "largest_temperature")
        require_finite(self, "temperature_0", "temperature_1", "temperature_2")


@dataclass(frozen=True, slots=True, kw_only=True)
class VolumeHeat:
    """Constants of conductivity and heat capacity after Habchi and Bair.

    k = B + C K^-s, K = (V/V_R) [1 - A (T/T_R) (V/V_R)^q], and rho c = C_0 + m (T/T_R) (V/V_R)^-4,
    with the volume of the oil's Tait law.
    """

    conductivity_base: float  # B [W/(m K)]
    conductivity_scale: float  # C [W/(m K)]
    conductivity_exponent: float  # s [-]
    scaling_factor: float  # A [-]
    scaling_exponent: float  # q [-]
    capacity_base: float  # C_0 [J/(m^3 K)]
    capacity_scale: float  # m [J/(m^3 K)]

    def __post_init__(self) -> None:
        require_positive(self, "conductivity_base", "conductivity_scale", "capacity_base")


def volume_heat(
    p: ArrayLike, temperature: ArrayLike, tait: TaitVolume, law: VolumeHeat
) -> tuple[Array, Array]:
    """Conductivity and heat capacity rho c of an oil by its volume, Habchi and Bair.

    Parameters
    ----------
    p : ArrayLike
        pressure, any shape [Pa]
    temperature : ArrayLike
        a shape that broadcasts with `p` [K]
    tait : TaitVolume
        constants of the volume
    law : VolumeHeat
        constants of conductivity and capacity

    Returns
    -------
    conductivity
        k, the common shape [W/(m K)]
    capacity
        rho c, the common shape [J/(m^3 K)]
    """
    volume = relative_volume(p, temperature, tait)
    warm = np.asarray(temperature) / tait.reference_temperature
    k = _laws.volume_conductivity(
        volume,
        warm,
        law.conductivity_base,
        law.conductivity_scale,
        law.conductivity_exponent,
        law.scaling_factor,
        law.scaling_exponent,
    )
    base, scale = law.capacity_base, law.capacity_scale
    capacity = _laws.volume_capacity(volume, warm, base, scale, CAPACITY_POWER)
    return np.asarray(k), np.asarray(capacity)


@dataclass(frozen=True, slots=True, kw_only=True)
class PressureModulus:
    """Constants of ln(eta/eta_0) = p/[a_1 + a_2 T + (b_1 + b_2 T) p], the modulus equation of
    German gear research, as Arana et al. (2019) and Wingertszahn (2023) print it; T in [K].
    """

    a1: float  # [Pa]
    a2: float  # [Pa/K]
    b1: float  # [-]
    b2: float  # [1/K]
    # T_v of Vogel's law for eta_0, -d(ln eta_0)/dT ~ (T - T_v)^-2, below the temperature of
    # operation [K]; None: exp[-beta (T - T_0)]
    vogel_temperature: float | None = None

    def __post_init__(self) -> None:
        require_finite(self, "a1", "a2", "b1", "b2")
        if self.vogel_temperature is not None:
            require_positive(self, "vogel_temperature")


@dataclass(frozen=True, slots=True, kw_only=True)
class ScaledVolume:
    """Constants of thermodynamic scaling, eta = eta_inf exp[B phi_inf/(phi - phi_inf)], phi =
    (T/T_R) (V/V_R)^g, Bair (2019), with Tait's volume; Habchi's form.
    """

    factor: float  # B [-]
    limit: float  # phi_inf [-]
    exponent: float  # g [-]

    def __post_init__(self) -> None:
        require_positive(self, "factor", "limit", "exponent")


def log_viscosity_scaled(
    p: ArrayLike, temperature: ArrayLike, tait: TaitVolume, law: ScaledVolume
) -> Array:
    """ln(eta/eta_inf) = B phi_inf/(phi - phi_inf), phi = (T/T_R) (V/V_R)^g, Bair (2019).

    Parameters
    ----------
    p : ArrayLike
        pressure, any shape [Pa]
    temperature : ArrayLike
        T, a shape that broadcasts with `p` [K]
    tait : TaitVolume
        constants of the volume
    law : ScaledVolume
        constants of the viscosity

    Returns
    -------
    Array
        ln(eta/eta_inf), the common shape [-]; infinite where phi reaches phi_inf, the glass
    """
    t = np.asarray(temperature, dtype=np.float64)
    volume = relative_volume(p, t, tait)
    warm = t / tait.reference_temperature
    with np.errstate(divide="ignore"):
        ratio = _laws.log_scaled(volume, warm, law.factor, law.limit, law.exponent)
    return np.asarray(ratio)


def pressure_viscosity_modulus(law: PressureModulus, temperature: float) -> float:
    """d(ln eta)/dp at p = 0, 1/(a_1 + a_2 T).

    Parameters
    ----------
    law : PressureModulus
        constants of the oil
    temperature : float
        T [K]

    Returns
    -------
    float
        pressure-viscosity coefficient [1/Pa]
    """
    return 1.0 / (law.a1 + law.a2 * temperature)


def pressure_viscosity_scaled(tait: TaitVolume, law: ScaledVolume, temperature: float) -> float:
    """d(ln eta)/dp at p = 0, B phi_inf g phi/[(phi - phi_inf)^2 K_0(T)].

    Parameters
    ----------
    tait : TaitVolume
        constants of the volume
    law : ScaledVolume
        constants of the viscosity
    temperature : float
        T [K]

    Returns
    -------
    float
        pressure-viscosity coefficient [1/Pa]
    """
    above = temperature - tait.reference_temperature
    modulus = tait.bulk_modulus * float(np.exp(-tait.bulk_modulus_temperature * above))
    volume = float(relative_volume(0.0, temperature, tait))
    phi = temperature / tait.reference_temperature * volume**law.exponent
    return law.factor * law.limit * law.exponent * phi / ((phi - law.limit) ** 2 * modulus)


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


# expansion of a mineral oil, between those of the library's [1/K]
MINERAL_EXPANSION = 6.5e-4


@dataclass(frozen=True, slots=True, kw_only=True)
class HeatRanges:
    """Relative ranges of heat properties to either side; zero of those that are known [-]."""

    conductivity: float = 0.0
    specific_heat: float = 0.0
    viscosity_temperature: float = 0.0
    expansion: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class ThermalProperties:
    """Thermal properties of an oil for a solve with heat, SI."""

    conductivity: float  # k [W/(m K)]
    specific_heat: float  # c [J/(kg K)]
    # beta = -d(ln eta)/dT at ambient pressure and the temperature of operation [1/K]; not used by
    # laws that depend on temperature themselves
    viscosity_temperature: float
    expansion: float = MINERAL_EXPANSION  # -d(ln rho)/dT [1/K]
    # change of both under pressure and over temperature; None: k and c constant
    under_pressure: FittedHeat | VolumeHeat | None = None
    ranges: HeatRanges = field(default=HeatRanges(), compare=False)  # of assumed values

    def __post_init__(self) -> None:
        require_positive(self, "conductivity", "specific_heat")
        require_not_negative(self, "viscosity_temperature", "expansion")


@dataclass(frozen=True, slots=True, kw_only=True)
class Lubricant:
    """Oil properties at the temperature of operation, SI.

    Examples
    --------
    >>> from oilfilm import Lubricant
    >>> oil = Lubricant(viscosity=0.04, pressure_viscosity=22e-9, temperature=353.15)
    >>> f"{oil.exponent:.3f}"
    '0.668'
    """

    viscosity: float  # eta_0, dynamic, at ambient pressure [Pa s]
    pressure_viscosity: float  # d(ln eta)/dp at ambient pressure [1/Pa]
    density: float = 870.0  # at ambient pressure [kg/m^3]
    viscosity_law: ViscosityLaw = ViscosityLaw.ROELANDS
    density_law: DensityLaw = DensityLaw.DOWSON_HIGGINSON
    roelands_z: float | None = None  # exponent z [-]; None: from Roelands' identity
    roelands_pressure: float = ROELANDS_PRESSURE  # p_r [Pa]
    name: str = ""
    # temperature of operation, at which the values hold [K]; needed by laws that depend on it and
    # with heat
    temperature: float | None = None
    tait: TaitVolume | None = None  # of the density law and of Doolittle's viscosity law
    doolittle: DoolittleFreeVolume | None = None  # of the viscosity law tait-doolittle
    yasutomi: YasutomiGlass | None = None  # of the viscosity law yasutomi
    modulus: PressureModulus | None = None  # of the viscosity law modulus
    scaled: ScaledVolume | None = None  # of the viscosity law scaled-volume
    thermal: ThermalProperties | None = None  # for a solve with heat
    # low and high end of an estimated pressure-viscosity over it [-]
    pressure_viscosity_ends: tuple[float, float] = field(
        default=(1.0, 1.0), compare=False, metadata={"stored": False}
    )
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
    def dry(self) -> bool:
        """Nothing lubricates: contacts have no film."""
        return self.name == DRY

    @property
    def piezoviscous(self) -> bool:
        """The viscosity rises with the pressure.

        The coefficient of an isoviscous oil is not used.
        """
        return self.viscosity_law is not ViscosityLaw.ISOVISCOUS and self.pressure_viscosity > 0.0

    @property
    def exponent(self) -> float:
        """Roelands' z [-]: prescribed, or alpha p_r / (ln eta_0 + 9.67), Roelands (1966)."""
        if self.roelands_z is not None:
            return self.roelands_z
        rise = log(self.viscosity) + ROELANDS_LOG_OFFSET
        return self.pressure_viscosity * self.roelands_pressure / rise


# d(ln eta)/dp at ambient pressure [1/Pa] by the fields that a law needs in addition to viscosity
# and coefficient
COEFFICIENTS: dict[ViscosityLaw, tuple[Callable[..., float], tuple[str, ...]]] = {
    ViscosityLaw.TAIT_DOOLITTLE: (
        pressure_viscosity_doolittle,
        ("tait", "doolittle", "temperature"),
    ),
    ViscosityLaw.YASUTOMI: (pressure_viscosity_yasutomi, ("yasutomi", "temperature")),
    ViscosityLaw.MODULUS: (pressure_viscosity_modulus, ("modulus", "temperature")),
    ViscosityLaw.SCALED: (pressure_viscosity_scaled, ("tait", "scaled", "temperature")),
}


def _require_constants(lubricant: Lubricant) -> None:
    """Each law has its constants, and they agree with the pressure-viscosity coefficient."""
    _, needed = COEFFICIENTS.get(lubricant.viscosity_law, (None, ()))
    if lubricant.density_law is DensityLaw.TAIT:
        needed = (*needed, "tait", "temperature")
    for name in needed:
        if getattr(lubricant, name) is None:
            laws = f"{lubricant.viscosity_law.value}, {lubricant.density_law.value}"
            raise ValueError(f"{name} is needed by the laws {laws}")
    coefficient = lubricant.pressure_viscosity
    constants = {name: getattr(lubricant, name) for name in needed}
    by_law = law_pressure_viscosity(lubricant.viscosity_law, constants)
    if by_law is not None and abs(coefficient - by_law) > PRESSURE_VISCOSITY_TOLERANCE * by_law:
        wanted = f"that of the law's constants, {by_law:.4e} 1/Pa"
        raise ValueError(f"pressure_viscosity must be {wanted}, got {coefficient!r}")


def law_pressure_viscosity(law: ViscosityLaw | None, constants: Mapping[str, Any]) -> float | None:
    """d(ln eta)/dp at ambient pressure that the constants of a law imply.

    Parameters
    ----------
    law : ViscosityLaw | None
        the law
    constants : Mapping[str, Any]
        fields of `Lubricant` that it needs, by name, at least

    Returns
    -------
    float | None
        pressure-viscosity coefficient [1/Pa]; None of a law that needs no constants
    """
    if law not in COEFFICIENTS:
        return None
    coefficient, needed = COEFFICIENTS[law]
    return coefficient(*(constants[name] for name in needed))


def log_viscosity_ratio(
    p: ArrayLike, lubricant: Lubricant, temperature: ArrayLike | None = None
) -> Array:
    """ln(eta/eta_0) after the lubricant's law, eta_0 at ambient pressure and temperature of
    operation.

    At another temperature, D = T - T_0: Roelands (1966) s {(1 + p/p_r)^z [(T - 138 K)/(T_0 -
    138 K)]^(-S) - 1}, s = alpha p_r/z, S such that -d(ln eta)/dT = beta at T_0 and ambient
    pressure; Yasutomi, the modulus, the scaled volume, and Doolittle with an expansion of the
    occupied volume, as their laws say; the others -beta D on top of the isothermal law, Barus
    (1893) alpha p. The result is 600 at most: no oil is as thick.

    Parameters
    ----------
    p : ArrayLike
        pressure, any shape [Pa]
    lubricant : Lubricant
        the oil
    temperature : ArrayLike | None, optional
        a shape that broadcasts with `p` [K]; None: that of operation

    Returns
    -------
    Array
        ln(eta/eta_0), the common shape [-]

    Raises
    ------
    ValueError
        if the lubricant lacks what its law needs at other temperatures
    """
    oil = lubricant
    numbers = oil_numbers(oil)
    if temperature is not None:
        _require_temperature_law(oil)
    now = numbers[_laws.OPERATION] if temperature is None else np.asarray(temperature)
    with np.errstate(divide="ignore", over="ignore"):
        ratio: Array = _laws.log_viscosity_ratio(_pressure(p), now, numbers)
    return ratio


def _pressure(p: ArrayLike) -> Array:
    return np.asarray(p, dtype=np.float64)


def _require_temperature_law(oil: Lubricant) -> None:
    """Raise ValueError unless the viscosity is determined at other temperatures."""
    operation = _operation(oil)
    expands = oil.doolittle is not None and oil.doolittle.occupied_expansion is not None
    law = oil.viscosity_law
    if law in (ViscosityLaw.YASUTOMI, ViscosityLaw.SCALED):
        return
    if law is ViscosityLaw.TAIT_DOOLITTLE and expands:
        return
    if oil.thermal is None:
        raise ValueError("thermal properties of the lubricant are needed to vary its temperature")
    by_roelands = law is ViscosityLaw.ROELANDS and oil.pressure_viscosity > 0.0
    if by_roelands and operation <= ROELANDS_TEMPERATURE:
        lowest = f"{ROELANDS_TEMPERATURE:g} K for Roelands' law"
        raise ValueError(f"temperature must exceed {lowest}, got {operation}")


def _operation(oil: Lubricant) -> float:
    if oil.temperature is None:
        raise ValueError("temperature of the lubricant is needed to vary it")
    return oil.temperature


def viscosity(p: ArrayLike, lubricant: Lubricant, temperature: ArrayLike | None = None) -> Array:
    """Dynamic viscosity after the lubricant's law.

    Parameters
    ----------
    p : ArrayLike
        pressure, any shape [Pa]
    lubricant : Lubricant
        the oil
    temperature : ArrayLike | None, optional
        a shape that broadcasts with `p` [K]; None: that of operation

    Returns
    -------
    Array
        viscosity, the common shape [Pa s]

    Raises
    ------
    ValueError
        if the lubricant lacks what its law needs at other temperatures
    """
    return lubricant.viscosity * np.exp(log_viscosity_ratio(p, lubricant, temperature))


def secant_pressure_viscosity(
    p: Array, lubricant: Lubricant, temperature: float | None = None
) -> Array:
    """Secant pressure-viscosity coefficient alpha(p, T) = ln[eta(p, T)/eta(0, T)]/p.

    Parameters
    ----------
    p : Array
        pressures above zero, shape (n,) [Pa]
    lubricant : Lubricant
        the oil
    temperature : float | None, optional
        T [K]; None: that of operation

    Returns
    -------
    Array
        alpha, shape (n,) [1/Pa]
    """
    pressures = np.concatenate([[0.0], p])
    at = None if temperature is None else np.full_like(pressures, temperature)
    ratio = log_viscosity_ratio(pressures, lubricant, at)
    return np.asarray((ratio[1:] - ratio[0]) / p)


def density(p: ArrayLike, lubricant: Lubricant, temperature: ArrayLike | None = None) -> Array:
    """Density after the lubricant's law.

    rho_0 [1 + 0.6 p/(1 + 1.7 p)], p in GPa, Dowson and Higginson (1966), or rho_0; both times
    exp[-e (T - T_0)] with the oil's thermal expansion e. Tait: rho_0 V(0, T_0)/V(p, T), with that
    factor if the expansion of Tait's equation is zero.

    Parameters
    ----------
    p : ArrayLike
        pressure, any shape [Pa]
    lubricant : Lubricant
        the oil
    temperature : ArrayLike | None, optional
        a shape that broadcasts with `p` [K]; None: that of operation

    Returns
    -------
    Array
        density, the common shape [kg/m^3]

    Raises
    ------
    ValueError
        if a temperature is given and the lubricant has none
    """
    oil = lubricant
    numbers = oil_numbers(oil)
    by_temperature = oil.thermal is not None or oil.density_law is DensityLaw.TAIT
    if temperature is not None and by_temperature:
        _operation(oil)
    now = numbers[_laws.OPERATION] if temperature is None else np.asarray(temperature)
    ratio: Array = _laws.density_ratio(_pressure(p), now, numbers)
    return oil.density * ratio


def heat_properties(
    p: ArrayLike, lubricant: Lubricant, temperature: ArrayLike
) -> tuple[Array, Array]:
    """Conductivity and heat capacity rho c of an oil under pressure and temperature.

    With a law for them these are the values at ambient pressure and the temperature of operation
    times its ratios; else k is constant, and c, so that rho c follows the density.

    Parameters
    ----------
    p : ArrayLike
        pressure, any shape [Pa]
    lubricant : Lubricant
        the oil, with thermal properties
    temperature : ArrayLike
        a shape that broadcasts with `p` [K]

    Returns
    -------
    conductivity
        k, the common shape [W/(m K)]
    capacity
        rho c, the common shape [J/(m^3 K)]

    Raises
    ------
    ValueError
        if the lubricant has no thermal properties or no temperature
    """
    oil = lubricant
    if oil.thermal is None:
        raise ValueError("thermal properties of the lubricant are needed")
    _operation(oil)
    numbers = oil_numbers(oil)
    pressure, t = np.broadcast_arrays(_pressure(p), np.asarray(temperature, dtype=np.float64))
    ratio = _laws.density_ratio(pressure, t, numbers)
    k = oil.thermal.conductivity * _laws.conductivity_ratio(pressure, t, numbers)
    ambient = oil.density * oil.thermal.specific_heat
    capacity = ambient * _laws.capacity_ratio(pressure, t, ratio, numbers)
    return k, capacity


def oil_numbers(lubricant: Lubricant) -> Array:
    """Constants of a lubricant as the array that `oilfilm.ehl.oil._kernels` takes.

    Codes of the two laws; eta_0, rho_0, T_0, beta, thermal expansion; constants of the viscosity
    law, of Tait's equation, of the heat under pressure, of the density. Without a temperature
    298.15 K stands there, with which nothing varies then.

    Parameters
    ----------
    lubricant : Lubricant
        the oil

    Returns
    -------
    Array
        constants by the columns of `oilfilm.ehl.oil._kernels`, shape (35,) [SI]
    """
    return _numbers(lubricant).copy()


@lru_cache(maxsize=256)
def _numbers(oil: Lubricant) -> Array:
    """The constants of `oil_numbers`."""
    temperature = UNNAMED_TEMPERATURE if oil.temperature is None else oil.temperature
    codes = [getattr(_laws, law.name) for law in (oil.viscosity_law, oil.density_law)]
    numbers = np.zeros(_laws.SIZE)
    numbers[:5] = (*codes, oil.viscosity, oil.density, temperature)
    if oil.viscosity_law is ViscosityLaw.ROELANDS and oil.pressure_viscosity == 0.0:
        numbers[_laws.VISCOSITY_LAW] = _laws.ISOVISCOUS
    if oil.thermal is not None:
        numbers[5:7] = oil.thermal.viscosity_temperature, oil.thermal.expansion
    if oil.tait is not None:
        numbers[_laws.T : _laws.H] = astuple(oil.tait)
    if oil.density_law is DensityLaw.DOWSON_HIGGINSON:
        numbers[_laws.D :] = DOWSON_HIGGINSON_NUMERATOR, DOWSON_HIGGINSON_DENOMINATOR
    constants = _viscosity_constants(oil, temperature)
    numbers[_laws.V : _laws.V + len(constants)] = constants
    heat = _heat_constants(oil, temperature)
    numbers[_laws.H : _laws.H + len(heat)] = heat
    _subtract_ambient(numbers)
    return numbers


def _viscosity_constants(oil: Lubricant, temperature: float) -> tuple[float, ...]:
    """Constants of the viscosity law in the order the kernel reads them, but for the value at
    ambient pressure of the laws that count from another one.
    """
    law = oil.viscosity_law
    if law is ViscosityLaw.BARUS:
        return (oil.pressure_viscosity,)
    if law is ViscosityLaw.ROELANDS and oil.pressure_viscosity > 0.0:
        slope = oil.pressure_viscosity * oil.roelands_pressure / oil.exponent
        room = max(temperature - ROELANDS_TEMPERATURE, SMALLEST_ROOM)
        return slope, oil.roelands_pressure, oil.exponent, room
    if law is ViscosityLaw.TAIT_DOOLITTLE and oil.doolittle:
        d = oil.doolittle
        expands = d.occupied_expansion is not None
        return d.factor, d.occupied_share, d.occupied_expansion or 0.0, float(expands)
    if law is ViscosityLaw.YASUTOMI and oil.yasutomi:
        return yasutomi_constants(oil.yasutomi)
    if law is ViscosityLaw.MODULUS and oil.modulus:
        m = oil.modulus
        return m.a1, m.a2, m.b1, m.b2, m.vogel_temperature or 0.0
    if law is ViscosityLaw.SCALED and oil.scaled:
        return astuple(oil.scaled)
    return ()


def _subtract_ambient(numbers: Array) -> None:
    """ln(eta) at ambient pressure and the temperature of operation, for the laws that count from
    another viscosity.
    """
    column = AMBIENT_COLUMNS.get(int(numbers[_laws.VISCOSITY_LAW]))
    if column is not None:
        operation = numbers[_laws.OPERATION]
        numbers[column] = _laws.log_viscosity_ratio(0.0, operation, numbers)


def _heat_constants(oil: Lubricant, temperature: float) -> tuple[float, ...]:
    """Code and constants of the law of the heat under pressure, with its values at ambient
    pressure and the temperature of operation [K], as the kernels read them.
    """
    law = None if oil.thermal is None else oil.thermal.under_pressure
    if isinstance(law, FittedHeat):
        start = min(temperature, law.largest_temperature)
        ambient = 1.0 + law.temperature_0 * (start - law.reference_temperature)
        return (float(_laws.FITTED_HEAT), *astuple(law), ambient)
    if isinstance(law, VolumeHeat) and oil.tait is not None:
        k, capacity = volume_heat(0.0, temperature, oil.tait, law)
        constants = (*astuple(law), CAPACITY_POWER)
        return (float(_laws.VOLUME_HEAT), *constants, float(k), float(capacity))
    return ()
