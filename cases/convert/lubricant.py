"""[lubricant]: the oil at the temperature of operation."""

from typing import Any

from bearing.library.lubricants import library_lubricant, lubricant_data
from ehl import DensityLaw, Lubricant, ViscosityLaw
from ehl.oil.lubricant import ThermalProperties

from ..checks.lubricant import oil_table
from ..schema.files import BearingFile, ContactFile
from .free_volume import free_volume, tell_temperature, with_coefficient
from .units import GPA, MM2_S, MPA, MPA_S, ZERO_CELSIUS, rounded

DENSITY = 870.0  # of an oil whose density is not given [kg/m^3]
# stands in where only Moes' groups and a Roelands exponent are given [Pa s]
VISCOSITY_UNUSED = 1.0


def lubricant(file: BearingFile | ContactFile) -> Lubricant:
    """The oil at the temperature of operation: viscosity [Pa s], pressure-viscosity [1/Pa],
    density [kg/m^3].
    """
    oil, library = oil_table(file.model_dump(exclude_none=True))
    given: dict[str, Any] = {"name": oil.get("name", "")}
    units = {
        "pressure_viscosity_1_GPa": 1.0 / GPA,
        "roelands_pressure_MPa": MPA,
        "roelands_z": 1.0,
        "density_kg_m3": 1.0,
    }
    fields = ("pressure_viscosity", "roelands_pressure", "roelands_z", "density")
    given |= {
        field: oil[key] * units[key]
        for field, key in zip(fields, units, strict=True)
        if key in oil
    }
    if "viscosity_law" in oil:
        given["viscosity_law"] = ViscosityLaw(oil["viscosity_law"])
    if "density_law" in oil:
        given["density_law"] = DensityLaw(oil["density_law"])
    at = temperature(file)
    constants = free_volume(oil, at)
    reference = oil.get("tait_temperature_C")
    reference = None if reference is None else reference + ZERO_CELSIUS
    if library:
        base, measured = _of_library(given, at, own=bool(constants))
        reference = reference if constants else measured
        given = {field: getattr(base, field) for field in Lubricant.__dataclass_fields__} | given
    given.setdefault("temperature", at)
    thermal = _thermal(oil)
    if thermal is not None:
        given["thermal"] = thermal
    found = Lubricant(**with_coefficient(_with_viscosity(given | constants, oil), oil))
    tell_temperature(found, reference)
    return found


def _of_library(
    given: dict[str, Any], kelvin: float, *, own: bool
) -> tuple[Lubricant, float | None]:
    """The library's oil at a temperature [K], and that at which its constants of free volume were
    measured [K].

    With constants of the case's `own` it comes with the library's own laws.
    """
    laws = (
        {}
        if own
        else {key: given[key] for key in ("viscosity_law", "density_law") if key in given}
    )
    base = library_lubricant(given.pop("name"), kelvin, **laws)
    return base, lubricant_data(base.name).get("doolittle", {}).get("reference_K")


def _thermal(oil: dict[str, Any]) -> ThermalProperties | None:
    """Thermal properties given by the case: conductivity [W/(m K)], heat [J/(kg K)], beta and
    expansion [1/K].
    """
    if "thermal_conductivity_W_m_K" not in oil:
        return None
    return ThermalProperties(
        conductivity=oil["thermal_conductivity_W_m_K"],
        specific_heat=oil["specific_heat_J_kg_K"],
        viscosity_temperature=oil["viscosity_temperature_1_K"],
        expansion=oil.get("thermal_expansion_1_K", 0.0),
    )


def _with_viscosity(given: dict[str, Any], oil: dict[str, Any]) -> dict[str, Any]:
    """Fill in the dynamic viscosity [Pa s], from the kinematic one and the density where that is
    given.
    """
    given.setdefault("density", DENSITY)
    given.setdefault("pressure_viscosity", 0.0)  # checked before: the isoviscous law needs none
    if "viscosity_mPa_s" in oil:
        given["viscosity"] = oil["viscosity_mPa_s"] * MPA_S
    elif "kinematic_viscosity_mm2_s" in oil:
        given["viscosity"] = oil["kinematic_viscosity_mm2_s"] * MM2_S * given["density"]
    given.setdefault("viscosity", VISCOSITY_UNUSED)
    return given


def lubricant_keys(oil: Lubricant, *, moes: bool) -> dict[str, Any]:
    """A lubricant as keys of [lubricant]: viscosity [mPa s], pressure-viscosity [1/GPa], density
    [kg/m^3].
    """
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
