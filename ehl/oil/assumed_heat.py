"""Heat properties of an oil that leaves some out: the one place that assumes them.

Formula, solver and self-heating take the same values, each with its range; none is zero because it
is not given.

The viscosity falls as that of an oil of the viscosity index of its class: ASTM D2270 gives the
viscosity U at 40 degrees Celsius of an oil of index VI and viscosity Y at 100,

    U = L - VI (L - H)/100 up to 100,    U = H/Y^N,  10^N = 1 + 0.00715 (VI - 100) above,

and Walther's line (ASTM D341), ln ln(nu + 0.7) = A - B ln T with nu in mm^2/s, passes through
both. Y is the one whose line passes through the viscosity at the temperature of operation. Of the
dynamic viscosity beta = B (1 + 0.7/nu) ln(nu + 0.7)/T + e, e the thermal expansion. With their own
indices the library's oils have the slopes of their laws within 4 % from 40 to 100 degrees Celsius.

Conductivity, heat capacity and expansion of mineral oil and polyalphaolefin: Larsson and Andersson
(2000), second-hand, within what the library's oils have; of esters the library's MIL-L-23699 and
7808. Ranges of 10 % of conductivity and heat capacity are estimates, those of expansions and
indices enclose the library's oils of the class, but for the highly refined.
"""

from dataclasses import replace
from enum import Enum
from functools import lru_cache
from math import exp, log, log10
from typing import NamedTuple

import numpy as np

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
HALVINGS = 50
MM2_S = 1e-6
UNKNOWN_TEMPERATURE = 343.15  # of an oil that names none, in the middle of the law's range [K]


class BaseOil(Enum):
    """Class of an oil, by which its heat properties are assumed."""

    MINERAL = "mineral"
    POLYALPHAOLEFIN = "polyalphaolefin"
    ESTER = "ester"


class OilClass(NamedTuple):
    """Heat properties of a class of oils: value, and low and high end."""

    viscosity_index: tuple[float, float, float]  # [-]
    conductivity: float  # [W/(m K)]
    heat_capacity: float  # rho c [J/(m^3 K)]
    expansion: tuple[float, float, float]  # [1/K]


CLASSES = {
    BaseOil.MINERAL: OilClass(
        (95.0, 30.0, 130.0), 0.137, 1.71e6, (MINERAL_EXPANSION, 5.5e-4, 7.8e-4)
    ),
    BaseOil.POLYALPHAOLEFIN: OilClass((140.0, 115.0, 155.0), 0.154, 1.77e6, (6.8e-4, 6e-4, 8e-4)),
    BaseOil.ESTER: OilClass((130.0, 100.0, 150.0), 0.150, 1.82e6, (7.1e-4, 6.3e-4, 7.9e-4)),
}
CONDUCTIVITY_SPREAD = 0.1  # [-], see above
CAPACITY_SPREAD = 0.1  # [-]
# laws that hold over temperature; Doolittle's with an expansion of the occupied volume
OVER_TEMPERATURE = (ViscosityLaw.YASUTOMI, ViscosityLaw.SCALED, ViscosityLaw.TAIT_DOOLITTLE)
STEP = 0.5  # of the differences [K]


def viscosity_fall(viscosity: float, temperature: float, index: float) -> float:
    """-d(ln nu)/dT of an oil of a viscosity index.

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
    float
        fall of the kinematic viscosity [1/K]
    """
    nu = viscosity / MM2_S
    wanted = _walther(nu)
    low = log(1.0 - WALTHER + 1e-6)
    high = log(max(nu, LARGEST)) + 10.0
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        hot = exp(middle)
        here = _walther(hot) + _line(hot, index) * log(HOT / temperature)
        low, high = (low, middle) if here > wanted else (middle, high)
    slope = _line(exp(0.5 * (low + high)), index)
    return slope * (1.0 + WALTHER / nu) * log(nu + WALTHER) / temperature


def _walther(viscosity: float) -> float:
    """ln ln(nu + 0.7), nu in [mm^2/s]."""
    return log(log(viscosity + WALTHER))


def _line(hot: float, index: float) -> float:
    """Slope B of the line of an oil of this viscosity at 100 degrees Celsius [mm^2/s]."""
    hot = max(hot, THINNEST)
    return (_walther(_at_40(hot, index)) - _walther(hot)) / log(HOT / COLD)


def _at_40(hot: float, index: float) -> float:
    """Viscosity U at 40 degrees Celsius by that at 100 and the index, ASTM D2270 [mm^2/s]."""
    if hot > LARGEST:
        least = 0.8353 * hot**2 + 14.67 * hot - 216.0
        hundred = 0.1684 * hot**2 + 11.85 * hot - 97.0
    else:
        y, *columns = np.log(INDEX_TABLE).T
        least, hundred = (float(np.exp(np.interp(log(hot), y, column))) for column in columns)
    if index <= 100.0:
        return least - 0.01 * index * (least - hundred)
    return float(hundred / hot ** log10(1.0 + 0.00715 * (index - 100.0)))


def heat_of(
    oil: Lubricant, base_oil: BaseOil = BaseOil.MINERAL, viscosity_index: float | None = None
) -> ThermalProperties:
    """Heat properties of an oil, those of its class and viscosity where it has none.

    Parameters
    ----------
    oil : Lubricant
        the oil
    base_oil : BaseOil, default BaseOil.MINERAL
        class of an oil without heat properties
    viscosity_index : float or None, optional
        of such an oil, after ASTM D2270 [-]; None: that of its class, with its range

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
    return _assumed(oil.viscosity, oil.density, at, own, base_oil, viscosity_index)


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
    viscosity_index: float | None,
) -> ThermalProperties:
    """Properties of a class; the fall of the viscosity may be known [SI]."""
    kind = CLASSES[base_oil]
    expansion, low, high = kind.expansion
    indices = kind.viscosity_index if viscosity_index is None else (viscosity_index,)
    falls = [
        expansion + viscosity_fall(viscosity / density, temperature, index) for index in indices
    ]
    fall = falls[0] if own_fall is None else own_fall
    spread = max(abs(one / falls[0] - 1.0) for one in falls) if own_fall is None else 0.0
    return ThermalProperties(
        conductivity=kind.conductivity,
        specific_heat=kind.heat_capacity / density,
        viscosity_temperature=fall,
        expansion=expansion,
        ranges=HeatRanges(
            conductivity=CONDUCTIVITY_SPREAD,
            specific_heat=CAPACITY_SPREAD,
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
