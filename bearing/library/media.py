"""Liquid media other than oils: water, liquefied gases, refrigerants, by the library CoolProp.

Properties are those of the liquid at ambient pressure, above its boiling point at that of its
vapour, and held at the ends of the range of the data. CoolProp takes two seconds to load: it is
imported when a medium is used, not before.
"""

from functools import cache
from math import log
from typing import Any

from oilfilm.ehl.units import GIGAPASCAL, ZERO_CELSIUS

COOLPROP = "coolprop"  # key of an entry with the name of its fluid, and the name of its laws
AMBIENT = 101325.0  # [Pa]
ABOVE_VAPOUR = 1.001  # pressure of a boiling liquid over that of its vapour, safely liquid [-]
PRESSURE_STEP = 1.0e5  # over which the rise of the viscosity with pressure is taken [Pa]
SYMBOLS = {"viscosity": "V", "density": "D", "conductivity": "L", "specific_heat": "C"}
MIXTURE = "INCOMP::"  # beginning of names of solutions, which have no pressure of their vapour


def medium_property(entry: dict[str, Any], name: str, temperature: float) -> float:
    """Property of a liquid medium.

    Parameters
    ----------
    entry : dict[str, Any]
        data of the medium
    name : str
        one of `oilfilm.bearing.library.lubricants.PROPERTIES`
    temperature : float
        temperature, held at the ends of the range [K]

    Returns
    -------
    float
        value in SI units
    """
    at = _held(entry, temperature)
    fluid = entry[COOLPROP]
    pressure = liquid_pressure(fluid, at)
    if name != "pressure_viscosity":
        return _value(fluid, SYMBOLS[name], at, pressure)
    ends = (_value(fluid, "V", at, p) for p in (pressure, pressure + PRESSURE_STEP))
    low_pressure, high_pressure = ends
    return log(high_pressure / low_pressure) / PRESSURE_STEP


def _held(entry: dict[str, Any], temperature: float) -> float:
    """The temperature, or the nearest end of the range of a medium [K]."""
    low, high = (end + ZERO_CELSIUS for end in entry["range_C"])
    return min(max(temperature, low), high)


@cache
def liquid_pressure(fluid: str, temperature: float) -> float:
    """Pressure at which properties of a liquid are taken: ambient, or just above its vapour's.

    Parameters
    ----------
    fluid : str
        name of the fluid in CoolProp
    temperature : float
        temperature [K]

    Returns
    -------
    float
        pressure [Pa]
    """
    from CoolProp.CoolProp import PropsSI

    if fluid.startswith(MIXTURE):
        fluid = "Water"  # whose vapour has a little more pressure
    vapour = PropsSI("P", "T", temperature, "Q", 0, fluid)
    return float(max(AMBIENT, ABOVE_VAPOUR * vapour))


@cache
def _value(fluid: str, symbol: str, temperature: float, pressure: float) -> float:
    from CoolProp.CoolProp import PropsSI

    return float(PropsSI(symbol, "T", temperature, "P", pressure, fluid))


def medium_text(name: str, entry: dict[str, Any], temperature: float) -> str:
    """Tell how a medium is modelled and what of it is not.

    Parameters
    ----------
    name : str
        name of the medium
    entry : dict[str, Any]
        its data
    temperature : float
        temperature [K]

    Returns
    -------
    str
        text for the messages
    """
    slope = GIGAPASCAL * medium_property(entry, "pressure_viscosity", temperature)
    pressure = liquid_pressure(entry[COOLPROP], _held(entry, temperature))
    boils = f", liquid only above {1e-6 * pressure:.3g} MPa" if pressure > AMBIENT else ""
    return (
        f"lubricant {name!r}: an isoviscous liquid{boils}; d(ln eta)/dp, {slope:.2g} 1/GPa at low "
        "pressure, is left out, which makes films thinner where it is positive; freezing and "
        "boiling in the contacts and chemical wear are unknown"
    )
