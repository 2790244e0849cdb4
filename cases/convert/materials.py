"""Materials, the case's own and those of the library."""

from typing import Any

from bearing.library.names import matching_name
from bearing.material import Material, MaterialKind, list_materials, load_material

from ..schema.bearing import BearingTable, MaterialTable
from ..schema.files import BearingFile, ContactFile
from .units import GPA, UM, rounded

THERMAL = {  # field: key of [materials.NAME] and its unit in SI
    "thermal_expansion": ("thermal_expansion_um_m_K", UM),
    "thermal_conductivity": ("thermal_conductivity_W_m_K", 1.0),
    "specific_heat": ("specific_heat_J_kg_K", 1.0),
}


def materials(file: BearingFile | ContactFile, names: tuple[str, ...]) -> dict[str, Material]:
    """The named materials, the case's own before those of the library; modulus [Pa], density
    [kg/m^3].
    """
    found = {}
    for name in names:
        own = file.materials.get(name)
        found[name] = load_material(name) if own is None else _material(name, own)
    return found


def _material(name: str, table: MaterialTable) -> Material:
    """A material of the case's own; kind and thermal data of the library's where it has the name
    of one [1/K, SI].
    """
    library = load_material(name) if matching_name(name, list_materials()) else None
    kind = (
        MaterialKind(table.kind) if table.kind else library.kind if library else MaterialKind.OTHER
    )
    thermal: dict[str, Any] = {field: library and getattr(library, field) for field in THERMAL}
    given = {field: (getattr(table, key), unit) for field, (key, unit) in THERMAL.items()}
    thermal |= {field: value * unit for field, (value, unit) in given.items() if value is not None}
    return Material(
        name=name,
        youngs_modulus=table.youngs_modulus_GPa * GPA,
        poisson_ratio=table.poisson_ratio,
        density=table.density_kg_m3,
        source=table.source,
        kind=kind,
        **thermal,
    )


def material_table(material: Material) -> dict[str, Any]:
    """A material as a [materials.NAME] table: youngs_modulus_GPa [GPa], density_kg_m3 [kg/m^3]."""
    thermal = {key: (getattr(material, field), unit) for field, (key, unit) in THERMAL.items()}
    return {
        "youngs_modulus_GPa": rounded(material.youngs_modulus / GPA),
        "poisson_ratio": material.poisson_ratio,
        "density_kg_m3": rounded(material.density),
        **{
            key: rounded(value / unit)
            for key, (value, unit) in thermal.items()
            if value is not None
        },
        "kind": material.kind.value,
        "source": material.source,
    }


def ring_materials(table: BearingTable) -> tuple[str, str, str]:
    """Names of the materials of balls, inner ring and outer ring [-]."""
    inner = table.inner_ring_material or table.ring_material
    outer = table.outer_ring_material or table.ring_material
    assert table.ball_material and inner and outer  # checked before
    return table.ball_material, inner, outer


def seat_materials(file: BearingFile) -> tuple[str, ...]:
    """Names of the materials of shaft and housing [-], none without [fit]."""
    return () if file.fit is None else (file.fit.shaft_material, file.fit.housing_material)
