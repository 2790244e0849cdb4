"""[materials.NAME]: materials of the case and of the library."""

from collections.abc import Iterable, Mapping
from typing import Any, Literal

from bearing.library.names import matching_name
from bearing.material import Material, MaterialKind, list_materials, load_material
from ehl.units import from_si

from .fields import Table, above, between, described, rounded

THERMAL = {  # field: key of [materials.NAME]
    "thermal_expansion": "thermal_expansion_um_m_K",
    "thermal_conductivity": "thermal_conductivity_W_m_K",
    "specific_heat": "specific_heat_J_kg_K",
}


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
    kind: Literal["bearing steel", "silicon nitride", "other"] | None = described(
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
    library = load_material(name) if matching_name(name, list_materials()) else None
    si = table.si()
    thermal = {
        field: getattr(library, field) if library and si[field] is None else si[field]
        for field in THERMAL
    }
    kind = library.kind if library else MaterialKind.OTHER
    return Material(
        name=name,
        youngs_modulus=si["youngs_modulus"],
        poisson_ratio=table.poisson_ratio,
        density=table.density_kg_m3,
        source=table.source,
        kind=MaterialKind(table.kind) if table.kind else kind,
        **thermal,
    )


def material_table(material: Material) -> dict[str, Any]:
    """A material as a [materials.NAME] table: youngs_modulus_GPa [GPa], density_kg_m3 [kg/m^3]."""
    keys = {
        "youngs_modulus": "youngs_modulus_GPa",
        "poisson_ratio": "poisson_ratio",
        "density": "density_kg_m3",
        **THERMAL,
    }
    numbers = {key: from_si(key, getattr(material, field)) for field, key in keys.items()}
    given = {key: rounded(value) for key, value in numbers.items() if value is not None}
    return {**given, "kind": material.kind.value, "source": material.source}
