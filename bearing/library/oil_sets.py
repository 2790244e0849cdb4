"""Constants of an oil of the library under pressure: volume, viscosity, heat, shear."""

from math import exp
from typing import Any

from ehl.oil.free_volume import DoolittleFreeVolume, TaitVolume
from ehl.oil.lubricant import FittedHeat, PressureModulus, ScaledVolume, VolumeHeat
from ehl.units import GIGAPASCAL, ZERO_CELSIUS

from .names import library_data

HEAT_DATA = "oil_heat.toml"


def oil_constants(entry: dict[str, Any], temperature: float) -> dict[str, Any]:
    """Fields of `ehl.Lubricant` with the constants of an oil's data.

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
