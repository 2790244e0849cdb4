"""[materials.NAME]: materials of the case and of the library."""

from collections.abc import Iterable, Mapping
from typing import Annotated, Any

from bearing.library.names import matching_name
from bearing.material import Material, MaterialKind, list_materials, load_material
from ehl.units import from_si

from .fields import OneOf, Table, above, between, described, is_number, name_in_si, rounded

OF_THE_LIBRARY = ("kind", "thermal_expansion", "thermal_conductivity", "specific_heat")


class MaterialTable(Table):
    """A material of the case, before those of the library; what it leaves out of thermal data and
    kind is taken from the library's of this name.
    """

    youngs_modulus_GPa: float = above(0, 2e3, "Young's modulus", ...)
    poisson_ratio: float = described("Poisson's ratio", ..., ge=0, lt=0.5)
    density_kg_m3: float = above(0, 3e4, "density", ...)
    thermal_expansion_um_m_K: float | None = between(-100, 1e3, "linear thermal expansion")
    thermal_conductivity_W_m_K: float | None = above(0, 1e4, "thermal conductivity")
    specific_heat_J_kg_K: float | None = above(0, 1e5, "specific heat capacity")
    kind: Annotated[str, OneOf(MaterialKind)] | None = described(
        'for the rating life; else "other"'
    )
    source: str = described("where the numbers come from", "case file")


def materials(own: Mapping[str, MaterialTable], names: Iterable[str]) -> dict[str, Material]:
    """The named materials, SI, the case's own before those of the library."""
    return {
        name: _material(name, own[name]) if name in own else load_material(name) for name in names
    }


def _material(name: str, table: MaterialTable) -> Material:
    """A material of the case, SI; kind and thermal data of the library's of the same name."""
    values: dict[str, Any] = {"kind": MaterialKind.OTHER}
    if matching_name(name, list_materials()):
        library = load_material(name)
        values = {field: getattr(library, field) for field in OF_THE_LIBRARY}
    values |= {field: value for field, value in table.si().items() if value is not None}
    return Material(name=name, **{**values, "kind": MaterialKind(values["kind"])})


def material_table(material: Material) -> dict[str, Any]:
    """A material as a [materials.NAME] table: youngs_modulus_GPa [GPa], density_kg_m3 [kg/m^3]."""
    values = {key: getattr(material, name_in_si(key)) for key in MaterialTable.model_fields}
    numbers = {key: from_si(key, value) for key, value in values.items() if is_number(value)}
    given = {key: rounded(value) for key, value in numbers.items()}
    return {**given, "kind": material.kind.value, "source": material.source}
