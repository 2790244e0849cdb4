"""Lubricants by name: viscosity, pressure-viscosity coefficient and density at a temperature."""

from __future__ import annotations

import tomllib
import warnings
from functools import cache
from importlib import resources
from itertools import pairwise
from math import exp, log
from typing import Any

from ehl.lubricant import Lubricant

from .names import matching_name


def list_lubricants() -> tuple[str, ...]:
    """Names of the shipped lubricants, in the order of the data file."""
    return tuple(_table())


def library_lubricant(name: str, temperature: float, **laws: Any) -> Lubricant:
    """Lubricant of the library at a temperature; the laws of viscosity and density are the caller's.

    Parameters
    ----------
    name : str
        One of `list_lubricants()`; case, spaces and hyphens do not matter.
    temperature : float
        Temperature of the oil in the contact inlet [K].
    **laws
        Further fields of `ehl.Lubricant` (viscosity_law, density_law, roelands_z [-], roelands_pressure [Pa]).

    Returns
    -------
    Lubricant

    Raises
    ------
    ValueError
        If there is none of this name, or the temperature is not positive [K].

    Warns
    -----
    UserWarning
        If the temperature lies outside the range of the data.
    """
    table = _table()
    key = matching_name(name, table)
    if key is None:
        raise ValueError(f"lubricant {name!r} is unknown; known: {', '.join(table)}")
    if not 150.0 < temperature < 700.0:
        raise ValueError(f"temperature must lie between 150 and 700 K, got {temperature!r}")
    entry = table[key]
    low, high = entry["range_C"]
    if not low <= temperature - 273.15 <= high:
        warnings.warn(f"lubricant {key!r}: {temperature - 273.15:.1f} C is outside {low} to {high} C", stacklevel=2)
    density = _interpolate(entry["density"], temperature)
    viscosity = LAWS[entry["viscosity"]["law"]](entry["viscosity"], temperature, density)
    if entry["pressure_viscosity"]["law"] == "exponent":  # alpha = exp(a ln eta + b)/eta, eta in Pa s
        a, b = entry["pressure_viscosity"]["a"], entry["pressure_viscosity"]["b"]
        alpha = exp(a * log(viscosity) + b) / viscosity
    else:
        alpha = _alpha_hyperbola(entry["pressure_viscosity"], temperature)
    return Lubricant(viscosity=viscosity, pressure_viscosity=alpha, density=density, name=key, **laws)


def viscosity_vogel(entry: dict[str, Any], temperature: float, density: float) -> float:
    """Dynamic viscosity [Pa s], rho a exp(b/(t + c)) with a in mm^2/s, t in degrees Celsius, Vogel (1921).

    Parameters
    ----------
    entry : dict
        a [mm^2/s], b [K], c [K].
    temperature : float
        Temperature [K].
    density : float
        Density [kg/m^3].

    Returns
    -------
    float
        Dynamic viscosity [Pa s].
    """
    return float(1e-6 * density * entry["a_mm2_s"] * exp(entry["b_K"] / (temperature - 273.15 + entry["c_K"])))


def viscosity_adore(entry: dict[str, Any], temperature: float, _density: float) -> float:
    """Dynamic viscosity [Pa s], eta_0 exp(a D + b D^2), D = 1/T - 1/T_0; the temperature in [K]."""
    delta = 1.0 / temperature - 1.0 / entry["reference_K"]
    return float(entry["eta_Pa_s"] * exp(entry["a_K"] * delta + entry["b_K2"] * delta**2))


def viscosity_walther(entry: dict[str, Any], temperature: float, _density: float) -> float:
    """Dynamic viscosity [Pa s], c (exp(exp(a - b ln T)) - d), of Walther's form; the temperature in [K]."""
    return float(entry["c_Pa_s"] * (exp(exp(entry["a"] - entry["b"] * log(temperature))) - entry["d"]))


LAWS = {"vogel": viscosity_vogel, "adore": viscosity_adore, "walther": viscosity_walther}


def _alpha_hyperbola(entry: dict[str, Any], temperature: float) -> float:
    """Pressure-viscosity coefficient [1/Pa]: a + b/(T - c), or interpolated in T [K]."""
    if entry["law"] == "hyperbola":
        return float(entry["a_1_Pa"] + entry["b_K_Pa"] / (temperature - entry["c_K"]))
    return _interpolate(entry, temperature)


def _interpolate(entry: dict[str, Any], temperature: float) -> float:
    """Linear in T [K] between the given points, held outside them."""
    points = sorted(zip(entry["temperature_K"], entry["value"], strict=True))
    if temperature <= points[0][0]:
        return float(points[0][1])
    for (t0, v0), (t1, v1) in pairwise(points):
        if temperature <= t1:
            return float(v0 + (v1 - v0) * (temperature - t0) / (t1 - t0))
    return float(points[-1][1])


@cache
def _table() -> dict[str, dict[str, Any]]:
    text = resources.files(__package__).joinpath("data/lubricants.toml").read_text(encoding="utf-8")
    return tomllib.loads(text)
