"""Lubricants by name: viscosity, pressure-viscosity, density, thermal properties."""

import warnings
from collections.abc import Callable
from functools import cache
from itertools import pairwise
from math import exp, log, log10
from typing import Any

import numpy as np

from ehl.oil.free_volume import pressure_viscosity_doolittle, relative_volume
from ehl.oil.heat_properties import VolumeHeat, volume_heat
from ehl.oil.lubricant import (
    ROELANDS_LOG_OFFSET,
    ROELANDS_TEMPERATURE,
    DensityLaw,
    Lubricant,
    ThermalProperties,
    ViscosityLaw,
)
from ehl.oil.pressure_laws import (
    log_viscosity_scaled,
    pressure_viscosity_modulus,
    pressure_viscosity_scaled,
)
from ehl.units import UNITS, ZERO_CELSIUS

from .names import library_data, matching_name
from .oil_sets import heat_under_pressure, oil_constants
from .plugins import OILS, PluginError, plugin, plugin_names, plugin_oil

DATA = "lubricants.toml"
PROPERTIES = ("viscosity", "pressure_viscosity", "density", "conductivity", "specific_heat")
STEP = 0.5  # of the differences that give the temperature coefficients [K]
MM2_S = UNITS["mm2_s"].si  # [m^2/s]
MPA_S = UNITS["mPa_s"].si  # [Pa s]
SCALED_VOLUME = "scaled volume"  # law of the viscosity that takes the volume of Tait's
CUTOFF = 0.7  # added to the kinematic viscosity in mm^2/s, ASTM D341


def list_lubricants(name: str | None = None) -> tuple[str, ...]:
    """Names of the shipped lubricants, in the order of the data file, and of those of plug-ins.

    `name`: the only one that is wanted; where it is shipped, plug-ins are not looked for.
    """
    shipped = tuple(library_data(DATA))
    if name is not None and matching_name(name, shipped):
        return shipped
    return tuple(dict.fromkeys((*shipped, *plugin_names(OILS))))


def lubricant_data(name: str) -> dict[str, Any]:
    """What the data file, or a plug-in, says of one of `list_lubricants()`: `range_C` and, per
    property of `PROPERTIES`, `law`, its constants with their units, `source`, and `verified` false
    where the number was not read in a source.
    """
    shipped = library_data(DATA)
    return shipped[name] if name in shipped else _of_plugin(name)


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


def library_lubricant(name: str, temperature: float, **laws: Any) -> Lubricant:
    """Lubricant of the library at a temperature of the oil in the contact inlet [K], with the
    thermal properties -d(ln eta)/dT and expansion of the laws there.

    `name`: one of `list_lubricants()`; case, spaces and hyphens do not matter; `laws`: further
    fields of `ehl.Lubricant` (viscosity_law, density_law, roelands_z [-], roelands_pressure [Pa]).

    Raises ValueError if there is none of this name, or the temperature is not of an oil; warns if
    it lies outside the range of the data.
    """
    names = list_lubricants(name)
    key = matching_name(name, names)
    if key is None:
        raise ValueError(f"lubricant {name!r} is unknown; known: {', '.join(names)}")
    if not 150.0 < temperature < 700.0:
        raise ValueError(f"temperature must lie between 150 and 700 K, got {temperature!r}")
    entry = lubricant_data(key)
    low, high = entry["range_C"]
    if not low <= temperature - ZERO_CELSIUS <= high:
        celsius = f"{temperature - ZERO_CELSIUS:.1f} C"
        warnings.warn(f"lubricant {key!r}: {celsius} is outside {low} to {high} C", stacklevel=2)
    constants = oil_constants(entry, temperature)
    laws = _own_laws(entry) | {name: law for name, law in laws.items() if law is not None}
    alpha = _own_coefficient(entry, laws.get("viscosity_law"), constants, temperature)
    return Lubricant(
        viscosity=dynamic_viscosity(entry, temperature),
        pressure_viscosity=alpha,
        density=oil_density(entry, temperature),
        name=key,
        temperature=temperature,
        thermal=_thermal(entry, temperature),
        **constants,
        **laws,
    )


def _thermal(entry: dict[str, Any], temperature: float) -> ThermalProperties:
    def fall(law: Callable[[dict[str, Any], float], float]) -> float:
        """-d(ln law)/dT by a central difference [1/K]."""
        warmer = law(entry, temperature + STEP)
        colder = law(entry, temperature - STEP)
        return log(colder / warmer) / (2.0 * STEP)

    law = heat_under_pressure(entry)
    conductivity = _linear(entry["conductivity"], temperature)
    specific_heat = _linear(entry["specific_heat"], temperature)
    if isinstance(law, VolumeHeat):  # of its own over temperature
        tait = oil_constants(entry, temperature)["tait"]
        k, capacity = volume_heat(0.0, temperature, tait, law)
        conductivity = float(k)
        specific_heat = float(capacity) / oil_density(entry, temperature)
    return ThermalProperties(
        conductivity=conductivity,
        specific_heat=specific_heat,
        viscosity_temperature=fall(dynamic_viscosity),
        expansion=fall(oil_density),
        under_pressure=law,
    )


def _own_laws(entry: dict[str, Any]) -> dict[str, Any]:
    """Laws of the oil's set, where it has one."""
    kinds = {"viscosity_law": ViscosityLaw, "density_law": DensityLaw}
    return {name: kind(entry[name]) for name, kind in kinds.items() if name in entry}


def _own_coefficient(
    entry: dict[str, Any], law: ViscosityLaw | None, constants: dict[str, Any], temperature: float
) -> float:
    """d(ln eta)/dp at ambient pressure [1/Pa], by the constants of the law that is taken [K]."""
    if law is ViscosityLaw.TAIT_DOOLITTLE and "doolittle" in constants:
        free_volume = (constants["tait"], constants["doolittle"])
        return pressure_viscosity_doolittle(*free_volume, temperature)
    return pressure_viscosity(entry, temperature)


def dynamic_viscosity(entry: dict[str, Any], temperature: float) -> float:
    """Dynamic viscosity [Pa s] of an oil's data at a temperature [K] and ambient pressure."""
    data = entry["viscosity"]
    if callable(data["law"]):  # of a plug-in
        return float(data["law"](temperature))
    return LAWS[data["law"]](entry | data, temperature, oil_density(entry, temperature))


def viscosity_vogel(entry: dict[str, Any], temperature: float, density: float) -> float:
    """Dynamic viscosity [Pa s], rho a exp(b/(t + c)) with a in mm^2/s, t in degrees Celsius, rho
    in kg/m^3; Vogel (1921).
    """
    exponent = entry["b_K"] / (temperature - ZERO_CELSIUS + entry["c_K"])
    return float(MM2_S * density * entry["a_mm2_s"] * exp(exponent))


def viscosity_vogel_dynamic(entry: dict[str, Any], temperature: float, _density: float) -> float:
    """Dynamic viscosity [Pa s], a exp(b/(t + c)), a in mPa s, t in degrees Celsius; Vogel."""
    exponent = entry["b_K"] / (temperature - ZERO_CELSIUS + entry["c_K"])
    return float(MPA_S * entry["a_mPa_s"] * exp(exponent))


def viscosity_roelands(entry: dict[str, Any], temperature: float, _density: float) -> float:
    """Dynamic viscosity [Pa s], ln(eta/eta_p) = ln(eta_r/eta_p) [(T - 138 K)/(T_r - 138 K)]^-S,
    ln eta_p = -9.67, Roelands (1966); T in [K].
    """
    rise = log(MPA_S * entry["value_mPa_s"]) + ROELANDS_LOG_OFFSET
    room = entry["reference_K"] - ROELANDS_TEMPERATURE
    ratio = (temperature - ROELANDS_TEMPERATURE) / room
    return exp(rise * ratio ** -entry["slope"] - ROELANDS_LOG_OFFSET)


def viscosity_scaled(entry: dict[str, Any], temperature: float, _density: float) -> float:
    """Dynamic viscosity [Pa s] of the oil's scaled volume at ambient pressure, T in [K]."""
    constants = oil_constants(entry, temperature)
    exponent = log_viscosity_scaled(0.0, temperature, constants["tait"], constants["scaled"])
    return float(entry["eta_inf_Pa_s"] * np.exp(exponent))


def viscosity_adore(entry: dict[str, Any], temperature: float, _density: float) -> float:
    """Dynamic viscosity [Pa s], eta_0 exp(a D + b D^2), D = 1/T - 1/T_0, at T [K]."""
    delta = 1.0 / temperature - 1.0 / entry["reference_K"]
    return float(entry["eta_Pa_s"] * exp(entry["a_K"] * delta + entry["b_K2"] * delta**2))


def viscosity_walther(entry: dict[str, Any], temperature: float, _density: float) -> float:
    """Dynamic viscosity [Pa s], Walther: c (exp(exp(a - b ln T)) - d), T in [K]."""
    double = exp(exp(entry["a"] - entry["b"] * log(temperature)))
    return float(entry["c_Pa_s"] * (double - entry["d"]))


def viscosity_astm_d341(entry: dict[str, Any], temperature: float, density: float) -> float:
    """Dynamic viscosity [Pa s], rho nu, log10 log10(nu + 0.7) = A - B log10 T through two
    kinematic viscosities nu in mm^2/s, ASTM D341; T in [K], rho in [kg/m^3].
    """
    return MM2_S * density * _d341(entry["temperature_K"], entry["value_mm2_s"], temperature)


def viscosity_dynamic_d341(entry: dict[str, Any], temperature: float, _density: float) -> float:
    """Dynamic viscosity [Pa s], form of ASTM D341 through two viscosities in mPa s; T in [K]."""
    return MPA_S * _d341(entry["temperature_K"], entry["value_mPa_s"], temperature)


def _d341(temperatures: list[float], values: list[float], temperature: float) -> float:
    x0, x1 = (log10(t) for t in temperatures)
    y0, y1 = (log10(log10(v + CUTOFF)) for v in values)
    y = y0 + (y1 - y0) * (log10(temperature) - x0) / (x1 - x0)
    return float(10.0 ** (10.0**y) - CUTOFF)


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
    """Pressure-viscosity coefficient, d(ln eta)/dp at ambient pressure [1/Pa], of an oil's data at
    a temperature [K].

    exponent: exp(a ln eta + b)/eta, eta in Pa s; hyperbola: a + b/(T - c); table: linear in T,
    constant beyond its ends; roelands: alpha_r (ln eta + 9.67)/(ln eta_r + 9.67), the identity of
    Roelands (1966) at constant z; modulus, scaled volume: by the constants of these laws.
    """
    data = entry["pressure_viscosity"]
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
        here, there = (
            log(dynamic_viscosity(entry, t)) for t in (temperature, data["reference_K"])
        )
        return float(data["value"] * (here + ROELANDS_LOG_OFFSET) / (there + ROELANDS_LOG_OFFSET))
    coldest, *_, hottest = sorted(zip(data["temperature_K"], data["value"], strict=True))
    if temperature > hottest[0]:
        return float(hottest[1])
    return _interpolate(data, max(temperature, coldest[0]))


def oil_density(entry: dict[str, Any], temperature: float) -> float:
    """Density [kg/m^3] of an oil's data at a temperature [K] and ambient pressure.

    table: linear in T, continued beyond its ends; expansion: rho_r exp[-e (T - T_r)]; tait: by
    the volume of the oil's Tait law.
    """
    data = entry["density"]
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
