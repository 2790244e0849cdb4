"""Lubricants by name: viscosity, pressure-viscosity, density, thermal properties, and the
constants of an oil under pressure (volume, viscosity, heat, shear). Greases by name: their base
oil, and the film with the grease over that of its base oil, by age.
"""

import warnings
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from itertools import pairwise
from math import exp, log
from typing import Any

import numpy as np

from oilfilm.ehl.messages import Caution
from oilfilm.ehl.oil.assumed_heat import BaseOil, assumed_pressure_viscosity, heat_of, line_through
from oilfilm.ehl.oil.free_volume import (
    DoolittleFreeVolume,
    TaitVolume,
    pressure_viscosity_doolittle,
    relative_volume,
)
from oilfilm.ehl.oil.lubricant import (
    DRY,
    ROELANDS_LOG_OFFSET,
    ROELANDS_TEMPERATURE,
    DensityLaw,
    FittedHeat,
    Lubricant,
    PressureModulus,
    ScaledVolume,
    ThermalProperties,
    ViscosityLaw,
    VolumeHeat,
    log_viscosity_scaled,
    pressure_viscosity_modulus,
    pressure_viscosity_scaled,
    volume_heat,
)
from oilfilm.ehl.units import GIGAPASCAL, UNITS, ZERO_CELSIUS

from .media import COOLPROP, medium_property, medium_text
from .plugins import (
    OILS,
    PluginError,
    library_data,
    matching_name,
    plugin,
    plugin_names,
    plugin_oil,
)

HEAT_DATA = "oil_heat.toml"

OIL_DATA = "lubricants.toml"
MEDIA_DATA = "media.toml"
PROPERTIES = ("viscosity", "pressure_viscosity", "density", "conductivity", "specific_heat")
STEP = 0.5  # of the differences that give the temperature coefficients [K]
MM2_S = UNITS["mm2_s"].si  # [m^2/s]
MPA_S = UNITS["mPa_s"].si  # [Pa s]
SCALED_VOLUME = "scaled volume"  # law of the viscosity that takes the volume of Tait's

GREASE_DATA = "greases.toml"
FACTOR = "film factor"  # table of the data file that is no grease


def oil_constants(entry: dict[str, Any], temperature: float) -> dict[str, Any]:
    """Fields of `oilfilm.ehl.Lubricant` with the constants of an oil's data.

    Parameters
    ----------
    entry : dict[str, Any]
        data of the oil
    temperature : float
        temperature of operation, the reference of constants without one [K]

    Returns
    -------
    dict[str, Any]
        fields by name
    """
    constants: dict[str, Any] = {}
    if "tait" in entry:
        constants["tait"] = _tait(entry["tait"])
    if "doolittle" in entry:
        data = entry["doolittle"]
        constants["tait"] = TaitVolume(
            bulk_modulus=data["bulk_modulus_Pa"],
            bulk_modulus_derivative=data["bulk_modulus_derivative"],
            reference_temperature=temperature,
        )
        constants["doolittle"] = DoolittleFreeVolume(
            factor=data["factor"], occupied_share=data["occupied_share"]
        )
    if "modulus" in entry:
        data = entry["modulus"]
        zero = data["zero_K"]  # of the temperature in the law
        constants["modulus"] = PressureModulus(
            a1=data["a1_Pa"] - zero * data["a2_Pa_K"],
            a2=data["a2_Pa_K"],
            b1=data["b1"] - zero * data["b2_1_K"],
            b2=data["b2_1_K"],
            vogel_temperature=data["vogel_K"],
        )
    if "scaled" in entry:
        data = entry["scaled"]
        constants["scaled"] = ScaledVolume(
            factor=data["factor"], limit=data["limit"], exponent=data["exponent"]
        )
    return constants


def _tait(data: dict[str, Any]) -> TaitVolume:
    """K_0 = K_00 exp(-b T), T in [K], at the reference temperature."""
    slope = data["bulk_modulus_slope_1_K"]
    reference = data["reference_K"]
    return TaitVolume(
        bulk_modulus=data["bulk_modulus_0_K_Pa"] * exp(-slope * reference),
        bulk_modulus_derivative=data["bulk_modulus_derivative"],
        reference_temperature=reference,
        bulk_modulus_temperature=slope,
        expansion=data["expansion_1_K"],
    )


def heat_under_pressure(entry: dict[str, Any]) -> FittedHeat | VolumeHeat | None:
    """Law of conductivity and heat capacity of an oil's data.

    Parameters
    ----------
    entry : dict[str, Any]
        data of the oil

    Returns
    -------
    FittedHeat | VolumeHeat | None
        the law; None if the oil has none
    """
    name = entry.get("heat_under_pressure")
    if name is None:
        return None
    data = library_data(HEAT_DATA)[name]
    if data["law"] == "volume":
        return VolumeHeat(
            conductivity_base=data["conductivity_base_W_m_K"],
            conductivity_scale=data["conductivity_scale_W_m_K"],
            conductivity_exponent=data["conductivity_exponent"],
            scaling_factor=data["scaling_factor"],
            scaling_exponent=data["scaling_exponent"],
            capacity_base=data["capacity_base_J_m3_K"],
            capacity_scale=data["capacity_scale_J_m3_K"],
        )
    return FittedHeat(
        conductivity_1=data["conductivity_1_1_GPa"] / GIGAPASCAL,
        conductivity_2=data["conductivity_2_1_GPa"] / GIGAPASCAL,
        capacity_1=data["capacity_1_1_GPa"] / GIGAPASCAL,
        capacity_2=data["capacity_2_1_GPa"] / GIGAPASCAL,
        temperature_0=data["temperature_0_1_K"],
        temperature_1=data["temperature_1_1_GPa"] / GIGAPASCAL,
        temperature_2=data["temperature_2_1_GPa2"] / GIGAPASCAL**2,
        reference_temperature=data["reference_C"] + ZERO_CELSIUS,
        largest_pressure=data["largest_pressure_GPa"] * GIGAPASCAL,
        largest_temperature=data["largest_temperature_C"] + ZERO_CELSIUS,
    )


def limiting_coefficient(entry: dict[str, Any]) -> dict[str, Any] | None:
    """Limiting stress over the pressure of an oil's data.

    Parameters
    ----------
    entry : dict[str, Any]
        data of the oil

    Returns
    -------
    dict[str, Any] | None
        `value` [-], `source` and, if it was not read in a source, `verified` false; None without
        data
    """
    data: dict[str, Any] | None = entry.get("limiting_stress_coefficient")
    return data


def list_lubricants(name: str | None = None) -> tuple[str, ...]:
    """Names of the shipped oils, in the order of the data file, and of those of plug-ins.

    Parameters
    ----------
    name : str | None, optional
        the only name of interest: media have theirs, too, and if it is shipped, plug-ins are not
        searched

    Returns
    -------
    tuple[str, ...]
        names for `load_lubricant`

    Examples
    --------
    >>> from oilfilm.bearing import list_lubricants
    >>> "iso vg 32" in list_lubricants()
    True
    """
    shipped = tuple(library_data(OIL_DATA))
    if name is not None:
        shipped = (*shipped, *library_data(MEDIA_DATA))
        if matching_name(name, shipped):
            return shipped
    return tuple(dict.fromkeys((*shipped, *plugin_names(OILS))))


def list_media() -> tuple[str, ...]:
    """Names of the shipped media that are no oils: water, liquefied gases, refrigerants, an acid.

    Returns
    -------
    tuple[str, ...]
        names for `load_lubricant`

    Examples
    --------
    >>> from oilfilm.bearing.library.lubricants import list_media
    >>> {"water", "liquid nitrogen"} <= set(list_media())
    True
    """
    return tuple(name for name in library_data(MEDIA_DATA) if name != DRY)


def lubricant_data(name: str) -> dict[str, Any]:
    """Data of a lubricant as the data file or a plug-in gives them.

    Parameters
    ----------
    name : str
        one of `list_lubricants()` or `list_media()`

    Returns
    -------
    dict[str, Any]
        `range_C` and, per property of `PROPERTIES`, `law`, its constants with their units,
        `source`, and `verified` false if the number was not read in a source
    """
    for file in (OIL_DATA, MEDIA_DATA):
        if name in library_data(file):
            return library_data(file)[name]
    return _of_plugin(name)


@cache
def _of_plugin(name: str) -> dict[str, Any]:
    """Data of the oil of a plug-in, all of them there and their laws known."""
    entry = plugin_oil(name)
    owner = plugin(OILS, name)
    if entry is None or owner is None:
        raise KeyError(name)
    missing = [key for key in ("range_C", *PROPERTIES) if key not in entry]
    if missing:
        raise owner.wrong(f"has no {', '.join(missing)}")
    try:
        for temperature in (ZERO_CELSIUS + end for end in entry["range_C"]):
            dynamic_viscosity(entry, temperature)
            pressure_viscosity(entry, temperature)
            _thermal(entry, temperature)
    except PluginError:
        raise
    except Exception as error:
        text = f"{type(error).__name__}: {error}"
        raise owner.wrong(f"its data cannot be used: {text}") from error
    return entry


def load_lubricant(name: str, temperature: float, **laws: Any) -> Lubricant:
    """Lubricant of the library at a temperature of the oil in the contact inlet.

    With the thermal properties -d(ln eta)/dT and expansion of the laws there. Warns if the
    temperature lies outside the range of the data.

    Parameters
    ----------
    name : str
        one of `list_lubricants()` or `list_media()`; case, spaces and hyphens do not matter
    temperature : float
        temperature of the oil [K]
    **laws : Any
        further fields of `oilfilm.ehl.Lubricant`: viscosity_law, density_law, roelands_z [-],
        roelands_pressure [Pa]

    Returns
    -------
    Lubricant
        the oil's properties, SI

    Raises
    ------
    ValueError
        if no lubricant has this name, or the temperature is not of an oil

    Examples
    --------
    >>> from oilfilm.bearing import load_lubricant
    >>> oil = load_lubricant("iso vg 32", 313.15)
    >>> f"{1e3 * oil.viscosity:.1f} mPa s"
    '27.6 mPa s'
    """
    names = list_lubricants(name)
    key = matching_name(name, names)
    if key is None:
        raise ValueError(f"lubricant {name!r} is unknown; known: {', '.join(names)}")
    entry = lubricant_data(key)
    if key not in library_data(MEDIA_DATA) and not 150.0 < temperature < 700.0:
        raise ValueError(f"temperature must lie between 150 and 700 K, got {temperature!r}")
    low, high = entry["range_C"]
    if not low <= temperature - ZERO_CELSIUS <= high:
        celsius = f"{temperature - ZERO_CELSIUS:.1f} C"
        text = f"lubricant {key!r}: {celsius} is outside {low} to {high} C"
        warnings.warn(Caution(text), stacklevel=2)
    if COOLPROP in entry:
        warnings.warn(medium_text(key, entry, temperature), stacklevel=2)
    constants = oil_constants(entry, temperature)
    laws = _laws_of_set(entry) | {name: law for name, law in laws.items() if law is not None}
    alpha = _coefficient_of_law(entry, laws.get("viscosity_law"), constants, temperature)
    oil = Lubricant(
        viscosity=dynamic_viscosity(entry, temperature),
        pressure_viscosity=alpha,
        density=oil_density(entry, temperature),
        name=key,
        temperature=temperature,
        thermal=_thermal(entry, temperature),
        **constants,
        **laws,
    )
    return _with_ranges(oil, entry.get("base_oil"))


def _with_ranges(oil: Lubricant, base_oil: str | None) -> Lubricant:
    """An oil that stands for a class, with the ranges of its heat properties and of its
    pressure-viscosity coefficient; else as it is.
    """
    if base_oil is None or oil.thermal is None:
        return oil
    kind = BaseOil(base_oil)
    ranges = heat_of(replace(oil, thermal=None), kind).ranges
    _, *ends = assumed_pressure_viscosity(oil.viscosity / oil.density, kind)
    low, high = (end / oil.pressure_viscosity for end in ends)
    return replace(
        oil,
        thermal=replace(oil.thermal, ranges=ranges),
        pressure_viscosity_ends=(min(low, 1.0), max(high, 1.0)),
    )


def _thermal(entry: dict[str, Any], temperature: float) -> ThermalProperties:
    def fall(law: Callable[[dict[str, Any], float], float]) -> float:
        """-d(ln law)/dT by a central difference [1/K]."""
        warmer = law(entry, temperature + STEP)
        colder = law(entry, temperature - STEP)
        return log(colder / warmer) / (2.0 * STEP)

    if COOLPROP in entry:  # slopes of the end of the range, not of what is held there
        low, high = (end + ZERO_CELSIUS for end in entry["range_C"])
        temperature = min(max(temperature, low + STEP), high - STEP)
    law = heat_under_pressure(entry)
    conductivity, specific_heat = (
        _linear(entry[name], temperature)
        if entry[name]["law"] != COOLPROP
        else medium_property(entry, name, temperature)
        for name in ("conductivity", "specific_heat")
    )
    if isinstance(law, VolumeHeat):  # of its own over temperature
        tait = oil_constants(entry, temperature)["tait"]
        k, capacity = volume_heat(0.0, temperature, tait, law)
        conductivity = float(k)
        specific_heat = float(capacity) / oil_density(entry, temperature)
    return ThermalProperties(
        conductivity=conductivity,
        specific_heat=specific_heat,
        viscosity_temperature=fall(dynamic_viscosity),
        expansion=max(fall(oil_density), 0.0),  # water contracts up to 4 C
        under_pressure=law,
    )


def _laws_of_set(entry: dict[str, Any]) -> dict[str, Any]:
    """Laws of the oil's set, where it has one."""
    kinds = {"viscosity_law": ViscosityLaw, "density_law": DensityLaw}
    return {name: kind(entry[name]) for name, kind in kinds.items() if name in entry}


def _coefficient_of_law(
    entry: dict[str, Any], law: ViscosityLaw | None, constants: dict[str, Any], temperature: float
) -> float:
    """d(ln eta)/dp at ambient pressure [1/Pa], by the constants of the law that is taken [K]."""
    if law is ViscosityLaw.TAIT_DOOLITTLE and "doolittle" in constants:
        free_volume = (constants["tait"], constants["doolittle"])
        return pressure_viscosity_doolittle(*free_volume, temperature)
    return pressure_viscosity(entry, temperature)


def dynamic_viscosity(entry: dict[str, Any], temperature: float) -> float:
    """Dynamic viscosity of an oil's data at ambient pressure.

    Parameters
    ----------
    entry : dict[str, Any]
        data of the oil, `lubricant_data`
    temperature : float
        temperature [K]

    Returns
    -------
    float
        viscosity [Pa s]
    """
    data = entry["viscosity"]
    if callable(data["law"]):  # of a plug-in
        return float(data["law"](temperature))
    if data["law"] == COOLPROP:
        return medium_property(entry, "viscosity", temperature)
    return LAWS[data["law"]](entry | data, temperature, oil_density(entry, temperature))


def viscosity_vogel(entry: dict[str, Any], temperature: float, density: float) -> float:
    """Dynamic viscosity rho a exp(b/(t + c)) with a in mm^2/s, t in degrees Celsius; Vogel (1921).

    Parameters
    ----------
    entry : dict[str, Any]
        constants a_mm2_s, b_K, c_K
    temperature : float
        temperature [K]
    density : float
        rho [kg/m^3]

    Returns
    -------
    float
        viscosity [Pa s]
    """
    exponent = entry["b_K"] / (temperature - ZERO_CELSIUS + entry["c_K"])
    return float(MM2_S * density * entry["a_mm2_s"] * exp(exponent))


def viscosity_vogel_dynamic(entry: dict[str, Any], temperature: float, _density: float) -> float:
    """Dynamic viscosity a exp(b/(t + c)), a in mPa s, t in degrees Celsius; Vogel (1921).

    Parameters
    ----------
    entry : dict[str, Any]
        constants a_mPa_s, b_K, c_K
    temperature : float
        temperature [K]
    _density : float
        plays no part [kg/m^3]

    Returns
    -------
    float
        viscosity [Pa s]
    """
    exponent = entry["b_K"] / (temperature - ZERO_CELSIUS + entry["c_K"])
    return float(MPA_S * entry["a_mPa_s"] * exp(exponent))


def viscosity_roelands(entry: dict[str, Any], temperature: float, _density: float) -> float:
    """Dynamic viscosity over temperature, Roelands (1966).

    ln(eta/eta_p) = ln(eta_r/eta_p) [(T - 138 K)/(T_r - 138 K)]^-S, ln eta_p = -9.67.

    Parameters
    ----------
    entry : dict[str, Any]
        constants value_mPa_s, reference_K, slope
    temperature : float
        T [K]
    _density : float
        plays no part [kg/m^3]

    Returns
    -------
    float
        viscosity [Pa s]
    """
    rise = log(MPA_S * entry["value_mPa_s"]) + ROELANDS_LOG_OFFSET
    room = entry["reference_K"] - ROELANDS_TEMPERATURE
    ratio = (temperature - ROELANDS_TEMPERATURE) / room
    return exp(rise * ratio ** -entry["slope"] - ROELANDS_LOG_OFFSET)


def viscosity_scaled(entry: dict[str, Any], temperature: float, _density: float) -> float:
    """Dynamic viscosity of the oil's scaled volume at ambient pressure.

    Parameters
    ----------
    entry : dict[str, Any]
        data of the oil with `tait`, `scaled` and eta_inf_Pa_s
    temperature : float
        temperature [K]
    _density : float
        plays no part [kg/m^3]

    Returns
    -------
    float
        viscosity [Pa s]
    """
    constants = oil_constants(entry, temperature)
    exponent = log_viscosity_scaled(0.0, temperature, constants["tait"], constants["scaled"])
    return float(entry["eta_inf_Pa_s"] * np.exp(exponent))


def viscosity_adore(entry: dict[str, Any], temperature: float, _density: float) -> float:
    """Dynamic viscosity eta_0 exp(a D + b D^2), D = 1/T - 1/T_0.

    Parameters
    ----------
    entry : dict[str, Any]
        constants eta_Pa_s, a_K, b_K2, reference_K
    temperature : float
        T [K]
    _density : float
        plays no part [kg/m^3]

    Returns
    -------
    float
        viscosity [Pa s]
    """
    delta = 1.0 / temperature - 1.0 / entry["reference_K"]
    return float(entry["eta_Pa_s"] * exp(entry["a_K"] * delta + entry["b_K2"] * delta**2))


def viscosity_walther(entry: dict[str, Any], temperature: float, _density: float) -> float:
    """Dynamic viscosity after Walther: c (exp(exp(a - b ln T)) - d).

    Parameters
    ----------
    entry : dict[str, Any]
        constants a, b, c_Pa_s, d
    temperature : float
        T [K]
    _density : float
        plays no part [kg/m^3]

    Returns
    -------
    float
        viscosity [Pa s]
    """
    double = exp(exp(entry["a"] - entry["b"] * log(temperature)))
    return float(entry["c_Pa_s"] * (double - entry["d"]))


def viscosity_astm_d341(entry: dict[str, Any], temperature: float, density: float) -> float:
    """Dynamic viscosity rho nu through two kinematic viscosities, ASTM D341.

    log10 log10(nu + 0.7) = A - B log10 T, nu in mm^2/s.

    Parameters
    ----------
    entry : dict[str, Any]
        temperature_K and value_mm2_s of the two points
    temperature : float
        T [K]
    density : float
        rho [kg/m^3]

    Returns
    -------
    float
        viscosity [Pa s]
    """
    return MM2_S * density * _d341(entry["temperature_K"], entry["value_mm2_s"], temperature)


def viscosity_dynamic_d341(entry: dict[str, Any], temperature: float, _density: float) -> float:
    """Dynamic viscosity by the form of ASTM D341 through two viscosities in mPa s.

    Parameters
    ----------
    entry : dict[str, Any]
        temperature_K and value_mPa_s of the two points
    temperature : float
        T [K]
    _density : float
        plays no part [kg/m^3]

    Returns
    -------
    float
        viscosity [Pa s]
    """
    return MPA_S * _d341(entry["temperature_K"], entry["value_mPa_s"], temperature)


def _d341(temperatures: list[float], values: list[float], temperature: float) -> float:
    """Value of ASTM D341's line through two, as if in mm^2/s."""
    line = line_through(temperatures, [MM2_S * value for value in values])
    return line.at(temperature) / MM2_S


LAWS = {
    "vogel": viscosity_vogel,
    "vogel dynamic": viscosity_vogel_dynamic,
    "roelands": viscosity_roelands,
    SCALED_VOLUME: viscosity_scaled,
    "adore": viscosity_adore,
    "walther": viscosity_walther,
    "astm d341": viscosity_astm_d341,
    "dynamic d341": viscosity_dynamic_d341,
}


def pressure_viscosity(entry: dict[str, Any], temperature: float) -> float:
    """Pressure-viscosity coefficient, d(ln eta)/dp at ambient pressure, of an oil's data.

    exponent: exp(a ln eta + b)/eta, eta in Pa s; hyperbola: a + b/(T - c); table: linear in T,
    constant beyond its ends; roelands: alpha_r (ln eta + 9.67)/(ln eta_r + 9.67), the identity of
    Roelands (1966) at constant z; modulus, scaled volume: by the constants of these laws;
    coolprop: of a liquid medium, zero where the viscosity falls with pressure.

    Parameters
    ----------
    entry : dict[str, Any]
        data of the oil, `lubricant_data`
    temperature : float
        T [K]

    Returns
    -------
    float
        coefficient [1/Pa]
    """
    data = entry["pressure_viscosity"]
    if data["law"] == COOLPROP:
        return max(medium_property(entry, "pressure_viscosity", temperature), 0.0)
    if data["law"] == "exponent":
        viscosity = dynamic_viscosity(entry, temperature)
        return float(exp(data["a"] * log(viscosity) + data["b"]) / viscosity)
    if data["law"] == "modulus":
        return pressure_viscosity_modulus(
            oil_constants(entry, temperature)["modulus"], temperature
        )
    if data["law"] == SCALED_VOLUME:
        constants = oil_constants(entry, temperature)
        return pressure_viscosity_scaled(constants["tait"], constants["scaled"], temperature)
    if data["law"] == "hyperbola":
        return float(data["a_1_Pa"] + data["b_K_Pa"] / (temperature - data["c_K"]))
    if data["law"] == "roelands":
        value, reference = (
            log(dynamic_viscosity(entry, t)) for t in (temperature, data["reference_K"])
        )
        return float(
            data["value"] * (value + ROELANDS_LOG_OFFSET) / (reference + ROELANDS_LOG_OFFSET)
        )
    coldest, *_, hottest = sorted(zip(data["temperature_K"], data["value"], strict=True))
    if temperature > hottest[0]:
        return float(hottest[1])
    return _interpolate(data, max(temperature, coldest[0]))


def oil_density(entry: dict[str, Any], temperature: float) -> float:
    """Density of an oil's data at ambient pressure.

    table: linear in T, continued beyond its ends; expansion: rho_r exp[-e (T - T_r)]; tait: by
    the volume of the oil's Tait law; coolprop: of a liquid medium.

    Parameters
    ----------
    entry : dict[str, Any]
        data of the oil, `lubricant_data`
    temperature : float
        T [K]

    Returns
    -------
    float
        density [kg/m^3]
    """
    data = entry["density"]
    if data["law"] == COOLPROP:
        return medium_property(entry, "density", temperature)
    if data["law"] == "tait":
        tait = oil_constants(entry, temperature)["tait"]
        return float(data["value"] / relative_volume(0.0, temperature, tait))
    if data["law"] == "expansion":
        rise = temperature - data["reference_K"]
        return float(data["value"] * exp(-data["expansion_1_K"] * rise))
    return _interpolate(data, temperature)


def _linear(data: dict[str, Any], temperature: float) -> float:
    return float(data["value"] + data["slope"] * (temperature - data["reference_K"]))


def _interpolate(data: dict[str, Any], temperature: float) -> float:
    """Linear in T [K] between the points of a table, continued beyond its ends."""
    points = sorted(zip(data["temperature_K"], data["value"], strict=True))
    pairs = list(pairwise(points))
    (t0, v0), (t1, v1) = next((pair for pair in pairs if temperature <= pair[1][0]), pairs[-1])
    return float(v0 + (v1 - v0) * (temperature - t0) / (t1 - t0))


@dataclass(frozen=True, slots=True, kw_only=True)
class Grease:
    """A grease, by its base oil."""

    name: str
    oil: str  # of `list_lubricants()`
    thickener: str  # and what it is used for
    # film with the grease over the flooded one of its base oil, smallest and largest [-]
    fresh_film: tuple[float, float]  # [-]
    aged_film: tuple[float, float]  # [-]
    source: str  # of these


def list_greases() -> tuple[str, ...]:
    """Names of the shipped greases, in the order of the data file.

    Returns
    -------
    tuple[str, ...]
        names for `load_grease`

    Examples
    --------
    >>> from oilfilm.bearing import list_greases, load_grease
    >>> load_grease(list_greases()[0]).name == list_greases()[0]
    True
    """
    return tuple(name for name in library_data(GREASE_DATA) if name != FACTOR)


def load_grease(name: str) -> Grease:
    """Shipped grease by its name.

    Parameters
    ----------
    name : str
        one of `list_greases()`; case, spaces and hyphens do not matter

    Returns
    -------
    Grease
        base oil and film factors

    Raises
    ------
    ValueError
        if no grease has this name
    """
    key = matching_name(name, list_greases())
    if key is None:
        raise ValueError(f"grease {name!r} is unknown; known: {', '.join(list_greases())}")
    entry = library_data(GREASE_DATA)[key]
    factor = library_data(GREASE_DATA)[FACTOR]
    fresh_low, fresh_high = factor["fresh"]
    aged_low, aged_high = factor["aged"]
    return Grease(
        name=key,
        oil=entry["oil"],
        thickener=entry["thickener"],
        fresh_film=(fresh_low, fresh_high),
        aged_film=(aged_low, aged_high),
        source=f"fresh: {factor['fresh_source']}; aged: {factor['aged_source']}",
    )
