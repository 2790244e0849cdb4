"""[lubricant]: the oil at the temperature of operation."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

from ..checks import oil_table
from ..schema import BearingFile, ContactFile
from .units import GPA, MM2_S, MPA, MPA_S, ZERO_CELSIUS, rounded

if TYPE_CHECKING:
    from ehl import Lubricant
    from ehl.lubricant import ThermalProperties

DENSITY = 870.0  # of an oil whose density is not given [kg/m^3]
SAME_TEMPERATURE = 0.5  # difference up to which constants count as those of a temperature [K]
VISCOSITY_UNUSED = 1.0  # stands in where only Moes' groups and a Roelands exponent are given [Pa s]


def lubricant(file: BearingFile | ContactFile) -> Lubricant:
    """The oil at the temperature of operation: viscosity [Pa s], pressure-viscosity [1/Pa], density [kg/m^3]."""
    from ehl import DensityLaw, Lubricant, ViscosityLaw

    oil, library = oil_table(file.model_dump(exclude_none=True))
    given: dict[str, Any] = {"name": oil.get("name", "")}
    units = {
        "pressure_viscosity_1_GPa": 1.0 / GPA,
        "roelands_pressure_MPa": MPA,
        "roelands_z": 1.0,
        "density_kg_m3": 1.0,
    }
    fields = ("pressure_viscosity", "roelands_pressure", "roelands_z", "density")
    given |= {field: oil[key] * units[key] for field, key in zip(fields, units, strict=True) if key in oil}
    if "viscosity_law" in oil:
        given["viscosity_law"] = ViscosityLaw(oil["viscosity_law"])
    if "density_law" in oil:
        given["density_law"] = DensityLaw(oil["density_law"])
    if library:
        from bearing.lubricant_library import library_lubricant

        laws = {key: given[key] for key in ("viscosity_law", "density_law") if key in given}
        base = library_lubricant(given.pop("name"), temperature(file), **laws)
        _tell_free_volume(base)
        given = {field: getattr(base, field) for field in Lubricant.__dataclass_fields__} | given
    given.setdefault("temperature", temperature(file))
    thermal = _thermal(oil)
    if thermal is not None:
        given["thermal"] = thermal
    return Lubricant(**_with_viscosity(given, oil))


def _tell_free_volume(oil: Lubricant) -> None:
    """Warn where constants of Tait and Doolittle are taken at another temperature than they were measured at."""
    from bearing.lubricant_library import lubricant_data
    from ehl import DensityLaw, ViscosityLaw

    data = lubricant_data(oil.name).get("doolittle")
    asked = oil.viscosity_law is ViscosityLaw.TAIT_DOOLITTLE or oil.density_law is DensityLaw.TAIT
    if data is None or not asked or oil.temperature is None:
        return
    if abs(oil.temperature - data["reference_K"]) > SAME_TEMPERATURE:
        warnings.warn(
            f"lubricant {oil.name!r}: constants of Tait and Doolittle of {data['reference_K'] - ZERO_CELSIUS:g} C are "
            f"taken at {oil.temperature - ZERO_CELSIUS:g} C; only viscosity and density at ambient pressure follow it",
            stacklevel=2,
        )


def _thermal(oil: dict[str, Any]) -> ThermalProperties | None:
    """Thermal properties given by the case: conductivity [W/(m K)], heat [J/(kg K)], beta and expansion [1/K]."""
    from ehl.lubricant import ThermalProperties

    if "thermal_conductivity_W_m_K" not in oil:
        return None
    return ThermalProperties(
        conductivity=oil["thermal_conductivity_W_m_K"],
        specific_heat=oil["specific_heat_J_kg_K"],
        viscosity_temperature=oil["viscosity_temperature_1_K"],
        expansion=oil.get("thermal_expansion_1_K", 0.0),
    )


def _with_viscosity(given: dict[str, Any], oil: dict[str, Any]) -> dict[str, Any]:
    """Fill in the dynamic viscosity [Pa s], from the kinematic one and the density where that is given."""
    given.setdefault("density", DENSITY)
    given.setdefault("pressure_viscosity", 0.0)  # checked before: the isoviscous law needs none
    if "viscosity_mPa_s" in oil:
        given["viscosity"] = oil["viscosity_mPa_s"] * MPA_S
    elif "kinematic_viscosity_mm2_s" in oil:
        given["viscosity"] = oil["kinematic_viscosity_mm2_s"] * MM2_S * given["density"]
    given.setdefault("viscosity", VISCOSITY_UNUSED)
    return given


def lubricant_keys(oil: Lubricant, *, moes: bool) -> dict[str, Any]:
    """A lubricant as keys of [lubricant]: viscosity [mPa s], pressure-viscosity [1/GPa], density [kg/m^3]."""
    found: dict[str, Any] = {} if moes else {"viscosity_mPa_s": rounded(oil.viscosity / MPA_S)}
    found |= {
        "pressure_viscosity_1_GPa": rounded(oil.pressure_viscosity * GPA),
        "density_kg_m3": rounded(oil.density),
        "viscosity_law": oil.viscosity_law.value,
        "density_law": oil.density_law.value,
    }
    return found


def temperature(file: BearingFile | ContactFile) -> float:
    """Temperature of the oil [K]."""
    table = file.operation if isinstance(file, BearingFile) else file.contact
    return table.temperature_C + ZERO_CELSIUS
