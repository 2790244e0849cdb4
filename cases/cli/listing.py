"""What `oilfilm list` shows: names, each with a remark."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..format.shipped import shipped_cases, shipped_sweeps, title

if TYPE_CHECKING:
    from bearing.material import Material
    from ehl import Lubricant


def listing(kind: str) -> dict[str, str]:
    """Names and remarks of one kind: cases, bearings, materials or lubricants."""
    if kind == "cases":
        return {name: title(path) for name, path in shipped_cases().items()}
    if kind == "sweeps":
        return {name: title(path) for name, path in shipped_sweeps().items()}
    if kind == "bearings":
        from bearing.library.bearings import list_bearings, load_catalogue_entry

        return {name: _dimensions(load_catalogue_entry(name)) for name in list_bearings()}
    if kind == "materials":
        from bearing.material import list_materials, load_material

        return {name: _properties(load_material(name)) for name in list_materials()}
    from bearing.library.lubricants import library_lubricant, list_lubricants

    return {name: _oil(library_lubricant(name, 313.15)) for name in list_lubricants()}


def _dimensions(entry: dict[str, Any]) -> str:
    sizes = [entry.get(key) for key in ("bore_mm", "outside_diameter_mm", "width_mm")]
    boundary = f"{' x '.join(f'{size:g}' for size in sizes)} mm, " if all(sizes) else ""
    balls = f"{entry.get('balls')} balls of {entry.get('ball_diameter_mm')} mm on {entry.get('pitch_diameter_mm')} mm"
    return f"{boundary}{balls}{', estimated' if 'balls' in entry.get('estimated', ()) else ''}"


def _properties(material: Material) -> str:
    modulus = f"E {material.youngs_modulus / 1e9:.4g} GPa"
    return f"{modulus}, nu {material.poisson_ratio:.3g}, {material.density:.4g} kg/m3"


def _oil(oil: Lubricant) -> str:
    return f"{oil.viscosity * 1e3:.3g} mPa s, {oil.pressure_viscosity * 1e9:.3g} 1/GPa at 40 C"
