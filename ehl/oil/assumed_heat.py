"""Properties that the data sheet of an oil leaves out: the one place that assumes them.

Formula, solver and self-heating take the same values, each with its range; none is zero because it
is not given.

Kinematic viscosity over temperature is Walther's line (ASTM D341), ln ln(nu + 0.7) = A - B ln T
with nu in mm^2/s, through the viscosities that are known. Where one is known, the line is that of
an oil of the viscosity index given, or of the base oil: ASTM D2270 gives the viscosity U at 40
degrees Celsius of an oil of index VI and viscosity Y at 100,

    U = L - VI (L - H)/100 up to 100,    U = H/Y^N,  10^N = 1 + 0.00715 (VI - 100) above,

and Y is the one whose line passes through the viscosity known. Of the dynamic viscosity
beta = B (1 + 0.7/nu) ln(nu + 0.7)/T + e, e the thermal expansion. With their own indices the
library's oils have the slopes of their laws within 4 % from 40 to 100 degrees Celsius.

The coefficient of pressure is s nu^t, the form of Gold et al. (2001), by base oil. Ranges enclose
Gold's lines (second-hand: 9.904 nu^0.139 of mineral oils, 7.382 nu^0.1335 of polyalphaolefins,
6.605 nu^0.136 of esters, 5.489 nu^0.1485 of polyglycols, 1/GPa and mm^2/s) and the oils of
Stachowiak and Batchelor's table 2.3 and of the library; s and t lie between them.

Conductivity, heat capacity and expansion of mineral oil and polyalphaolefin: Larsson and Andersson
(2000), second-hand, within what the library's oils have; of esters the library's MIL-L-23699 and
7808. Ranges of 10 % of conductivity and heat capacity are estimates, those of expansions and
indices enclose the library's oils of the class, but for the highly refined. Densities and the
expansion of polyglycols: oils of the open code GEARpie and of the library. What else stands for
polyglycols, and all for perfluoropolyethers, is unverified: no source was read.
"""

from collections.abc import Sequence
from dataclasses import replace
from enum import Enum
from functools import cache, lru_cache
from math import exp, log, log10
from typing import NamedTuple

import numpy as np

from ..arrays import Array
from .lubricant import (
    MINERAL_EXPANSION,
    HeatRanges,
    Lubricant,
    ThermalProperties,
    ViscosityLaw,
    log_viscosity_ratio,
)

# ASTM D2270, table 1, in part, as the open library chemicals has it: Y, L and H [mm^2/s]
INDEX_TABLE = (
    (2.0, 7.994, 6.394),
    (2.5, 11.45, 9.063),
    (3.0, 15.49, 12.15),
    (4.0, 25.32, 19.56),
    (5.0, 40.23, 28.49),
    (6.0, 57.97, 38.19),
    (8.0, 100.0, 59.6),
    (10.0, 147.7, 82.87),
    (15.0, 296.5, 149.7),
    (20.0, 493.2, 229.5),
    (30.0, 1023.0, 421.7),
    (40.0, 1730.0, 651.8),
    (50.0, 2618.0, 919.6),
    (70.0, 4905.0, 1558.0),
)
LARGEST = 70.0  # Y of the table; above the standard has L and H as polynomials [mm^2/s]
THINNEST = 2.0  # Y below which no index is defined: the slope of the line stays [mm^2/s]
WALTHER = 0.7  # in the line [mm^2/s]
COLD = 313.15  # temperatures of the index [K]
HOT = 373.15
THINNEST_OF_ALL = 0.31  # least viscosity of a line, whose logarithm ends at 0.3 [mm^2/s]
HALVINGS = 50
MM2_S = 1e-6
UNKNOWN_TEMPERATURE = 343.15  # of an oil that names none, in the middle of the law's range [K]


class BaseOil(Enum):
    """Class of an oil, by which its properties are assumed."""

    MINERAL = "mineral"
    POLYALPHAOLEFIN = "PAO"
    ESTER = "ester"
    POLYGLYCOL = "PAG"
    PERFLUOROPOLYETHER = "PFPE"


class PressureLine(NamedTuple):
    """Coefficient of pressure s nu^t, and its ends over it."""

    scale: float  # s, at 1 mm^2/s [1/Pa]
    exponent: float  # t [-]
    low: float  # [-]
    high: float


class OilClass(NamedTuple):
    """Properties of a class of oils: value, and low and high end."""

    viscosity_index: tuple[float, float, float]  # [-]
    pressure: PressureLine
    density: tuple[float, float, float]  # at 15 degrees Celsius [kg/m^3]
    conductivity: float  # [W/(m K)]
    heat_capacity: float  # rho c [J/(m^3 K)]
    expansion: tuple[float, float, float]  # [1/K]
    spread: float = 0.1  # of conductivity and capacity to either side [-], see above
    verified: bool = True


CLASSES = {
    BaseOil.MINERAL: OilClass(
        viscosity_index=(95.0, 30.0, 130.0),
        pressure=PressureLine(11.1e-9, 0.15, 0.8, 1.35),
        density=(884.5, 850.0, 930.0),
        conductivity=0.137,
        heat_capacity=1.71e6,
        expansion=(MINERAL_EXPANSION, 5.5e-4, 7.8e-4),
    ),
    BaseOil.POLYALPHAOLEFIN: OilClass(
        viscosity_index=(140.0, 115.0, 155.0),
        pressure=PressureLine(8.2e-9, 0.14, 0.82, 1.27),
        density=(845.0, 825.0, 870.0),
        conductivity=0.154,
        heat_capacity=1.77e6,
        expansion=(6.8e-4, 5.5e-4, 8e-4),
    ),
    BaseOil.ESTER: OilClass(
        viscosity_index=(130.0, 100.0, 150.0),
        pressure=PressureLine(7.6e-9, 0.17, 0.72, 1.2),
        density=(950.0, 910.0, 1000.0),
        conductivity=0.150,
        heat_capacity=1.82e6,
        expansion=(7.1e-4, 6.3e-4, 8.1e-4),
    ),
    BaseOil.POLYGLYCOL: OilClass(
        viscosity_index=(200.0, 150.0, 260.0),
        pressure=PressureLine(6.6e-9, 0.15, 0.8, 1.3),
        density=(1040.0, 980.0, 1100.0),
        conductivity=0.16,
        heat_capacity=2.05e6,
        expansion=(7.1e-4, 6.3e-4, 8e-4),
        spread=0.2,
        verified=False,
    ),
    BaseOil.PERFLUOROPOLYETHER: OilClass(
        viscosity_index=(130.0, 80.0, 350.0),
        pressure=PressureLine(14e-9, 0.15, 0.45, 1.7),
        density=(1900.0, 1820.0, 1950.0),
        conductivity=0.085,
        heat_capacity=1.9e6,
        expansion=(9.8e-4, 8.5e-4, 11e-4),
        spread=0.2,
        verified=False,
    ),
}
SHEET_TEMPERATURE = 288.15  # of the densities of data sheets [K]
# laws that hold over temperature; Doolittle's with an expansion of the occupied volume
OVER_TEMPERATURE = (ViscosityLaw.YASUTOMI, ViscosityLaw.SCALED, ViscosityLaw.TAIT_DOOLITTLE)
STEP = 0.5  # of the differences [K]


class WaltherLine(NamedTuple):
    """Kinematic viscosity over temperature, ASTM D341."""

    temperature: float  # of one point [K]
    viscosity: float  # there [m^2/s]
    slope: float  # B [-]

    def at(self, temperature: float) -> float:
        """Kinematic viscosity at a temperature.

        Parameters
        ----------
        temperature : float
            T [K]

        Returns
        -------
        float
            viscosity [m^2/s]
        """
        level = _walther(self.viscosity / MM2_S) - self.slope * log(temperature / self.temperature)
        return MM2_S * max(exp(exp(level)) - WALTHER, THINNEST_OF_ALL)

    def fall(self, temperature: float) -> float:
        """Fall -d(ln nu)/dT of the kinematic viscosity at a temperature.

        Parameters
        ----------
        temperature : float
            T [K]

        Returns
        -------
        float
            fall [1/K]
        """
        nu = self.at(temperature) / MM2_S
        return self.slope * (1.0 + WALTHER / nu) * log(nu + WALTHER) / temperature

    @property
    def viscosity_index(self) -> float | None:
        """Viscosity index after ASTM D2270 [-]; None of an oil too thin for one."""
        hot = self.at(HOT) / MM2_S
        if hot < THINNEST:
            return None
        least, hundred = _index_bounds(hot)
        cold = self.at(COLD) / MM2_S
        if cold > hundred:
            return 100.0 * (least - cold) / (least - hundred)
        return 100.0 + ((hundred / cold) ** (1.0 / log(hot, 10.0)) - 1.0) / 0.00715


def line_through(temperatures: Sequence[float], viscosities: Sequence[float]) -> WaltherLine:
    """Walther's line through two viscosities.

    Parameters
    ----------
    temperatures : sequence of float
        two temperatures [K]
    viscosities : sequence of float
        kinematic viscosities there [m^2/s]

    Returns
    -------
    WaltherLine
        the line

    Examples
    --------
    >>> line = line_through((313.15, 373.15), (32e-6, 5.4e-6))
    >>> f"{1e6 * line.at(353.15):.3f} mm2/s, index {line.viscosity_index:.0f}"
    '8.533 mm2/s, index 101'
    """
    cold, hot = (_walther(viscosity / MM2_S) for viscosity in viscosities)
    slope = (cold - hot) / log(temperatures[1] / temperatures[0])
    return WaltherLine(temperatures[0], viscosities[0], slope)


@lru_cache(maxsize=256)  # points of a batch have few oils
def line_of_index(viscosity: float, temperature: float, index: float) -> WaltherLine:
    """Walther's line of an oil of a viscosity index.

    Parameters
    ----------
    viscosity : float
        nu, kinematic, at ambient pressure [m^2/s]
    temperature : float
        T [K]
    index : float
        viscosity index after ASTM D2270 [-]

    Returns
    -------
    WaltherLine
        the line
    """
    nu = viscosity / MM2_S
    wanted = _walther(nu)
    low = log(1.0 - WALTHER + 1e-6)
    high = log(max(nu, LARGEST)) + 10.0
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        hot = exp(middle)
        here = _walther(hot) + _slope(hot, index) * log(HOT / temperature)
        low, high = (low, middle) if here > wanted else (middle, high)
    return WaltherLine(temperature, viscosity, _slope(exp(0.5 * (low + high)), index))


def _walther(viscosity: float) -> float:
    """ln ln(nu + 0.7), nu in [mm^2/s]."""
    return log(log(max(viscosity, THINNEST_OF_ALL) + WALTHER))


def _slope(hot: float, index: float) -> float:
    """Slope B of the line of an oil of this viscosity at 100 degrees Celsius [mm^2/s]."""
    hot = max(hot, THINNEST)
    return (_walther(_at_40(hot, index)) - _walther(hot)) / log(HOT / COLD)


def _at_40(hot: float, index: float) -> float:
    """Viscosity U at 40 degrees Celsius by that at 100 and the index, ASTM D2270 [mm^2/s]."""
    least, hundred = _index_bounds(hot)
    if index <= 100.0:
        return least - 0.01 * index * (least - hundred)
    return float(hundred / hot ** log10(1.0 + 0.00715 * (index - 100.0)))


def _index_bounds(hot: float) -> tuple[float, float]:
    """Viscosities L and H of the indices 0 and 100 by that at 100 degrees Celsius [mm^2/s]."""
    if hot > LARGEST:
        least = 0.8353 * hot**2 + 14.67 * hot - 216.0
        return least, 0.1684 * hot**2 + 11.85 * hot - 97.0
    y, *columns = _log_index_table()
    least, hundred = (exp(np.interp(log(hot), y, column)) for column in columns)
    return least, hundred


@cache
def _log_index_table() -> Array:
    """Logarithms of `INDEX_TABLE`, by its columns."""
    return np.ascontiguousarray(np.log(INDEX_TABLE).T)


def assumed_pressure_viscosity(viscosity: float, base_oil: BaseOil) -> tuple[float, float, float]:
    """Coefficient d(ln eta)/dp of an oil by its base oil, with its low and high end.

    Parameters
    ----------
    viscosity : float
        nu, kinematic, at the temperature of operation [m^2/s]
    base_oil : BaseOil
        class of the oil

    Returns
    -------
    tuple of float
        value, low and high end [1/Pa]

    Examples
    --------
    >>> value, low, high = assumed_pressure_viscosity(32e-6, BaseOil.POLYALPHAOLEFIN)
    >>> f"{1e9 * value:.1f} ({1e9 * low:.1f} to {1e9 * high:.1f}) 1/GPa"
    '13.3 (10.9 to 16.9) 1/GPa'
    """
    line = CLASSES[base_oil].pressure
    value = line.scale * (viscosity / MM2_S) ** line.exponent
    return value, line.low * value, line.high * value


def assumed_density(
    temperature: float,
    base_oil: BaseOil,
    at_15: float | None = None,
    expansion: float | None = None,
) -> float:
    """Density of an oil by that at 15 degrees Celsius, rho exp[-e (T - 288.15 K)].

    Parameters
    ----------
    temperature : float
        T [K]
    base_oil : BaseOil
        class of the oil
    at_15 : float or None, optional
        density at 15 degrees Celsius [kg/m^3]; None: that of the class
    expansion : float or None, optional
        e [1/K]; None: that of the class

    Returns
    -------
    float
        density [kg/m^3]
    """
    kind = CLASSES[base_oil]
    start = kind.density[0] if at_15 is None else at_15
    rise = kind.expansion[0] if expansion is None else expansion
    return start * exp(-rise * (temperature - SHEET_TEMPERATURE))


def heat_of(
    oil: Lubricant, base_oil: BaseOil = BaseOil.MINERAL, line: WaltherLine | None = None
) -> ThermalProperties:
    """Heat properties of an oil, those of its class and viscosity where it has none.

    Parameters
    ----------
    oil : Lubricant
        the oil
    base_oil : BaseOil, default BaseOil.MINERAL
        class of an oil without heat properties
    line : WaltherLine or None, optional
        viscosity of such an oil over temperature; None: by the index of its class, with its range

    Returns
    -------
    ThermalProperties
        its own, or assumed ones with their ranges

    Examples
    --------
    >>> from oilfilm import Lubricant
    >>> oil = Lubricant(viscosity=0.0261, pressure_viscosity=18e-9, temperature=313.15)
    >>> heat = heat_of(oil)
    >>> f"{heat.viscosity_temperature:.4f} 1/K +- {heat.ranges.viscosity_temperature:.0%}"
    '0.0432 1/K +- 9%'
    """
    if oil.thermal is not None:
        return oil.thermal
    own = None if oil.viscosity_law not in OVER_TEMPERATURE else _own_fall(oil)
    at = UNKNOWN_TEMPERATURE if oil.temperature is None else oil.temperature
    return _assumed(oil.viscosity, oil.density, at, own, base_oil, line)


def _own_fall(oil: Lubricant) -> float | None:
    """-d(ln eta)/dT at ambient pressure by the oil's own law [1/K]; None where it has none."""
    constants = oil.doolittle
    expands = constants is not None and constants.occupied_expansion is not None
    if oil.viscosity_law is ViscosityLaw.TAIT_DOOLITTLE and not expands:
        return None
    assert oil.temperature is not None  # of these laws
    around = oil.temperature + np.array([-STEP, STEP])
    cold, hot = log_viscosity_ratio(np.zeros(2), oil, around)
    return float(cold - hot) / (2.0 * STEP)


@lru_cache(maxsize=1024)
def _assumed(
    viscosity: float,
    density: float,
    temperature: float,
    own_fall: float | None,
    base_oil: BaseOil,
    line: WaltherLine | None,
) -> ThermalProperties:
    """Properties of a class; the fall of the viscosity may be known [SI]."""
    kind = CLASSES[base_oil]
    expansion, low, high = kind.expansion
    nu = viscosity / density
    lines = [line_of_index(nu, temperature, index) for index in kind.viscosity_index]
    falls = [expansion + one.fall(temperature) for one in (lines if line is None else [line])]
    fall = falls[0] if own_fall is None else own_fall
    spread = max(abs(one / falls[0] - 1.0) for one in falls) if own_fall is None else 0.0
    return ThermalProperties(
        conductivity=kind.conductivity,
        specific_heat=kind.heat_capacity / density,
        viscosity_temperature=fall,
        expansion=expansion,
        ranges=HeatRanges(
            conductivity=kind.spread,
            specific_heat=kind.spread,
            viscosity_temperature=spread,
            expansion=max(high / expansion - 1.0, 1.0 - low / expansion),
        ),
    )


def with_heat(oil: Lubricant) -> Lubricant:
    """An oil with heat properties, assumed where it has none.

    Parameters
    ----------
    oil : Lubricant
        the oil

    Returns
    -------
    Lubricant
        the same object where it has its own
    """
    return oil if oil.thermal is not None else replace(oil, thermal=heat_of(oil))
