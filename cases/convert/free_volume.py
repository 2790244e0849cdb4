"""Constants of Tait, Doolittle and Yasutomi of an oil, and the pressure-viscosity coefficient that
follows.
"""

import warnings
from typing import Any

from ehl import DensityLaw, Lubricant, ViscosityLaw
from ehl.oil.free_volume import (
    DoolittleFreeVolume,
    ExpansivityForm,
    TaitVolume,
    YasutomiGlass,
    pressure_viscosity_doolittle,
    pressure_viscosity_yasutomi,
)
from ehl.oil.lubricant import PRESSURE_VISCOSITY_TOLERANCE

from ..format.problems import UnfitKey
from .units import GPA, ZERO_CELSIUS

SAME_TEMPERATURE = 0.5  # difference up to which constants count as those of a temperature [K]


def free_volume(oil: dict[str, Any], temperature: float) -> dict[str, Any]:
    """Constants that the keys of an oil give: fields of `Lubricant`, SI; temperature of operation
    [K].
    """
    found: dict[str, Any] = {}
    if "tait_bulk_modulus_GPa" in oil:
        found["tait"] = _tait(oil, temperature)
    if "doolittle_factor" in oil:
        found["doolittle"] = _doolittle(oil)
    if "yasutomi_slope" in oil:
        found["yasutomi"] = _yasutomi(oil)
    return found


def _tait(oil: dict[str, Any], temperature: float) -> TaitVolume:
    celsius = oil.get("tait_temperature_C")
    return TaitVolume(
        bulk_modulus=oil["tait_bulk_modulus_GPa"] * GPA,
        bulk_modulus_derivative=oil["tait_bulk_modulus_derivative"],
        reference_temperature=temperature if celsius is None else celsius + ZERO_CELSIUS,
        bulk_modulus_temperature=oil.get("tait_bulk_modulus_temperature_1_K", 0.0),
        expansion=oil.get("tait_expansion_1_K", 0.0),
    )


def _doolittle(oil: dict[str, Any]) -> DoolittleFreeVolume:
    return DoolittleFreeVolume(
        factor=oil["doolittle_factor"],
        occupied_share=oil["doolittle_occupied_share"],
        occupied_expansion=oil.get("doolittle_occupied_expansion_1_K"),
    )


def _yasutomi(oil: dict[str, Any]) -> YasutomiGlass:
    """The improved law with an exponent, the first one with a factor."""
    coefficient = oil["yasutomi_expansivity_1_GPa"] / GPA
    power = "yasutomi_expansivity_exponent" in oil
    first, second = (
        (coefficient, oil["yasutomi_expansivity_exponent"])
        if power
        else (oil["yasutomi_expansivity_factor"], coefficient)
    )
    return YasutomiGlass(
        glass_temperature=oil["yasutomi_glass_temperature_C"] + ZERO_CELSIUS,
        glass_rise=oil["yasutomi_glass_rise_K"],
        glass_pressure_coefficient=oil["yasutomi_glass_pressure_1_GPa"] / GPA,
        expansivity_1=first,
        expansivity_2=second,
        slope=oil["yasutomi_slope"],
        width=oil["yasutomi_width_K"],
        form=ExpansivityForm.POWER if power else ExpansivityForm.LOGARITHMIC,
    )


def law_coefficient(given: dict[str, Any]) -> float | None:
    """d(ln eta)/dp at ambient pressure that the constants of the viscosity law give [1/Pa]; None
    for other laws.
    """
    law = given.get("viscosity_law")
    temperature = given["temperature"]
    if law is ViscosityLaw.TAIT_DOOLITTLE:
        return pressure_viscosity_doolittle(given["tait"], given["doolittle"], temperature)
    if law is ViscosityLaw.YASUTOMI:
        return pressure_viscosity_yasutomi(given["yasutomi"], temperature)
    return None


def with_coefficient(given: dict[str, Any], oil: dict[str, Any]) -> dict[str, Any]:
    """Fields of `Lubricant` with the coefficient of the law's constants; one that the case gives
    must agree with it.

    Raises
    ------
    UnfitKey
        If it does not, or the law does not hold at the temperature.
    """
    own = law_coefficient(given)
    key = "pressure_viscosity_1_GPa"
    if own is None:
        return given
    if own <= 0.0:
        raise UnfitKey(
            ("lubricant", "viscosity_law"),
            "its constants give no viscosity that rises with pressure",
        )
    if key in oil and abs(oil[key] / GPA - own) > PRESSURE_VISCOSITY_TOLERANCE * own:
        found = f"found {oil[key]:g}, and the constants of the law give {own * GPA:.4g}"
        raise UnfitKey(("lubricant", key), found, "allowed: left out, or that of the constants")
    return given if key in oil else {**given, "pressure_viscosity": own}


def tell_temperature(oil: Lubricant, reference: float | None) -> None:
    """Warn where constants are taken at another temperature [K] than that they hold at, and do not
    go with it.
    """
    asked = oil.viscosity_law is ViscosityLaw.TAIT_DOOLITTLE or oil.density_law is DensityLaw.TAIT
    if reference is None or not asked or oil.temperature is None or oil.tait is None:
        return
    doolittle = oil.viscosity_law is ViscosityLaw.TAIT_DOOLITTLE and oil.doolittle is not None
    expansion = (
        oil.doolittle.occupied_expansion if doolittle and oil.doolittle is not None else None
    )
    follows = oil.tait.bulk_modulus_temperature > 0.0 or expansion is not None
    if abs(oil.temperature - reference) > SAME_TEMPERATURE and not follows:
        warnings.warn(
            f"lubricant {oil.name!r}: constants of Tait and Doolittle of {reference - ZERO_CELSIUS:g} C are "
            f"taken at {oil.temperature - ZERO_CELSIUS:g} C; only viscosity and density at ambient pressure follow it",
            stacklevel=2,
        )
