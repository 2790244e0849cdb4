"""[shaft], [[support]], [[load]], [housing]: a shaft on bearings, `oilfilm shaft`."""

from collections.abc import Iterator
from typing import Annotated, Any, Literal

from oilfilm.bearing.material import list_materials
from oilfilm.bearing.shaft.system import AxialLocation

from .fields import (
    FORCE_MAXIMUM,
    LENGTH_MAXIMUM,
    SPEED_MAXIMUM,
    Force,
    OneOf,
    Table,
    above,
    between,
    described,
    is_number,
    within,
)
from .operation import SELF_HEATED
from .rules import CaseProblem, CaseValues, Relation, nearest_name, shown

RELATIONS: tuple[Relation, ...] = ()
# tables of a bearing case that all bearings of a shaft have in common
SHARED = (
    *("schema_version", "lubricant", "lubricants", "materials"),
    *("surface", "friction", "model", "fit"),
)


class SectionTable(Table):
    """A piece of the shaft, a cylinder, from the end of the one before."""

    to_mm: float = above(0, LENGTH_MAXIMUM, "where it ends, from the left end of the shaft", ...)
    outside_mm: float = above(0, LENGTH_MAXIMUM, "outside diameter", ...)
    inside_mm: float = between(0, LENGTH_MAXIMUM, "inside diameter", 0.0)
    material: str = described("material", "bearing steel")


class ShaftTable(Table):
    """A stepped shaft; x runs along it from its left end."""

    section: tuple[SectionTable, ...] = described(
        "its pieces from left to right", ..., strict=False, min_length=1, max_length=200
    )
    gravity_m_s2: Force = described("acceleration of gravity [x, y, z]", (0.0, -9.81, 0.0))


class ShaftSupportTable(Table):
    """A bearing on the shaft: a designation, or a table [bearing.NAME] of the file."""

    bearing: str = described("designation, or name of a table [bearing.NAME]", ...)
    at_mm: float = between(0, LENGTH_MAXIMUM, "middle of the bearing", ...)
    fixed: Annotated[str, OneOf(AxialLocation)] = described(
        "shoulders that hold its outer ring along the shaft", "both"
    )
    loaded_by: Literal["+x", "-x"] | None = described(
        "push of the shaft that loads it; of angular contact needed"
    )
    preload_N: float | None = between(0, FORCE_MAXIMUM, "axial, at rest, before the shaft bends")
    offset_um: float | None = within(1e4, "or displacement beyond first touch; negative: play")
    temperature_C: float | None = between(-100, 500, "of its oil; else that of [operation]")
    heat_transfer_W_K: float | None = above(
        0, 1e5, "from its shaft and housing to the surroundings; else that of [friction]"
    )


class SpringTable(Table):
    """A bearing that is not computed, as one with rollers: a linear spring to the housing."""

    name: str = described("of the bearing", "", max_length=80)
    at_mm: float = between(0, LENGTH_MAXIMUM, "where it acts", ...)
    radial_stiffness_N_um: float = above(0, 1e6, "along y and z", ...)
    axial_stiffness_N_um: float = between(0, 1e6, "along the shaft", 0.0)
    tilting_stiffness_N_m_mrad: float = between(0, 1e6, "against tilt", 0.0)


class ShaftLoadTable(Table):
    """Load and mass of a gear, pulley, coupling or disc."""

    at_mm: float = between(0, LENGTH_MAXIMUM, "where it acts", ...)
    force_N: Force = described("[fx, fy, fz]", (0.0, 0.0, 0.0))
    moment_N_mm: Force = described("[mx, my, mz]", (0.0, 0.0, 0.0))
    mass_kg: float = between(0, 1e6, "mass", 0.0)
    polar_inertia_kg_m2: float = between(0, 1e6, "moment of inertia about the shaft", 0.0)
    diametral_inertia_kg_m2: float = between(0, 1e6, "about a diameter", 0.0)
    unbalance_g_mm: float = between(0, 1e9, "unbalance", 0.0)
    unbalance_angle_deg: float = within(360, "of the unbalance, from y towards z", 0.0)


class HousingTable(Table):
    """Seats of the outer rings, alike or by a matrix of the housing; rigid by default."""

    stiffness: str | None = described(
        "file of the stiffness on x, y, z and the rotations about them, of each seat (6 x 6) or "
        "of all seats in the order of [[support]]",
        min_length=1,
    )
    stiffness_units: Literal["N m rad", "N mm rad"] = described("of that file", "N m rad")
    radial_stiffness_N_um: float | None = above(0, 1e6, "along y and z, of a seat")
    axial_stiffness_N_um: float | None = above(0, 1e6, "along the shaft")
    tilting_stiffness_N_m_mrad: float | None = above(0, 1e6, "against tilt")
    thermal_expansion_um_m_K: float = between(0, 100, "of the housing", 12.0)
    temperature_C: float | None = between(-100, 500, "of the housing, for its length")
    conductance_W_K: float | None = between(
        0, 1e5, "heat from a bearing to the next one; default: an estimate by their diameters"
    )


class ShaftOperationTable(Table):
    """Speed of the shaft, temperatures of oil and shaft."""

    inner_speed_rpm: float = within(SPEED_MAXIMUM, "speed of the shaft", 0.0)
    temperature_C: float = between(-100, 500, "of the oil in the contacts", 40.0)
    shaft_temperature_C: float | None = between(-100, 500, "of the shaft, for its length")
    temperature: Literal["given", "self-heated"] = described(
        "given: temperature_C; self-heated: those where friction and cooling agree, the bearings "
        "joined by shaft and housing",
        "given",
    )


def faults(values: CaseValues) -> Iterator[CaseProblem]:
    """Conflicts of the tables of a shaft: places outside it, sections that do not follow each
    other, two preloads.

    Parameters
    ----------
    values : CaseValues
        The valid values of the file.

    Yields
    ------
    Iterator[CaseProblem]
        The problems.
    """
    shaft = values.get("shaft")
    sections = shaft.get("section") if isinstance(shaft, dict) else None
    pieces: list[dict[str, Any]] = [s for s in sections or () if isinstance(s, dict)]
    ends = [end for s in pieces if is_number(end := s.get("to_mm"))]
    if not ends or len(ends) < len(pieces):
        return
    own = values.document.get("materials")
    materials = (*(own if isinstance(own, dict) else ()), *list_materials())
    for index, (before, end) in enumerate(zip([0.0, *ends[:-1]], ends, strict=True)):
        table = pieces[index]
        material = table.get("material")
        if isinstance(material, str) and material not in materials:
            near = nearest_name(material, materials)
            allowed = "" if near else f"allowed: {', '.join(materials)}"
            path = ("shaft", "section", index, "material")
            yield CaseProblem(path, f"unknown name {shown(material)}", allowed, nearest=near)
        if end <= before:
            path = ("shaft", "section", index, "to_mm")
            yield CaseProblem(path, f"found {shown(end)}", f"allowed: more than {before:g} mm")
        inside = table.get("inside_mm", 0.0)
        outside = table.get("outside_mm")
        if is_number(inside) and is_number(outside) and inside >= outside:
            path = ("shaft", "section", index, "inside_mm")
            yield CaseProblem(path, f"found {shown(inside)}", f"allowed: less than {outside:g} mm")
    for name in ("support", "spring", "load"):
        tables = values.get(name)
        for index, table in enumerate(tables if isinstance(tables, list) else ()):
            place = table.get("at_mm") if isinstance(table, dict) else None
            if is_number(place) and place > ends[-1]:
                allowed = f"allowed: on the shaft, up to {ends[-1]:g} mm"
                yield CaseProblem((name, index, "at_mm"), f"found {shown(place)}", allowed)
    for key in ("radial_stiffness_N_um", "axial_stiffness_N_um", "tilting_stiffness_N_m_mrad"):
        if values.get("housing", "stiffness") is not None and values.get("housing", key):
            finding = "found together with stiffness"
            yield CaseProblem(("housing", key), finding, "allowed: one of them")
    yield from _support_faults(values)


def _support_faults(values: CaseValues) -> Iterator[CaseProblem]:
    """Supports that contradict themselves, and shafts that nothing holds."""
    tables = values.get("support")
    tables = [table for table in tables or () if isinstance(table, dict)]
    for index, table in enumerate(tables):
        if table.get("preload_N") is not None and table.get("offset_um") is not None:
            path = ("support", index, "offset_um")
            yield CaseProblem(path, "found together with preload_N", "allowed: one of them")
        for key in ("preload_N", "offset_um"):
            if table.get(key) is not None and table.get("loaded_by") is None:
                path = ("support", index, "loaded_by")
                yield CaseProblem(path, "missing", f"needed with {key}: which push loads it")
    yield from _heat_faults(values, tables)
    springs = values.get("spring")
    held = [s.get("axial_stiffness_N_um") for s in springs or () if isinstance(s, dict)]
    sides = {table.get("fixed", "both") for table in tables}
    push = sum(_axial_forces(values))
    needed = "right" if push > 0.0 else "left"
    if tables and not any(held) and sides == {"none"}:
        finding = "no support holds the shaft along x"
        yield CaseProblem(("support",), finding, 'needed: fixed = "both" at one of them')
    elif tables and not any(held) and push and not sides.intersection(("both", needed)):
        finding = f"no support holds the shaft against the load of {push:g} N along x"
        yield CaseProblem(("support",), finding, f'needed: fixed = "both" or "{needed}" at one')


def _axial_forces(values: CaseValues) -> Iterator[float]:
    """Forces of the loads along the shaft [N]."""
    for load in values.get("load") or ():
        force = load.get("force_N") if isinstance(load, dict) else None
        if isinstance(force, list | tuple) and force and is_number(force[0]):
            yield float(force[0])


def _heat_faults(values: CaseValues, tables: list[dict[str, Any]]) -> Iterator[CaseProblem]:
    """Temperatures that are wanted and given, and bearings that give off no heat."""
    if values.get("operation", "temperature") != SELF_HEATED:
        return
    for path in (("operation", "shaft_temperature_C"), ("housing", "temperature_C")):
        if values.get(*path) is not None:
            finding = f'found together with operation.temperature = "{SELF_HEATED}"'
            yield CaseProblem(path, finding, "allowed: one of them")
    for index, table in enumerate(tables):
        if values.get("friction", "heat_transfer_W_K") or table.get("heat_transfer_W_K"):
            continue
        needed = f'needed with operation.temperature = "{SELF_HEATED}", here or in [friction]'
        yield CaseProblem(("support", index, "heat_transfer_W_K"), "missing", needed)


def bearing_document(document: dict[str, Any], support: dict[str, Any]) -> dict[str, Any]:
    """Case of one bearing of a shaft, without loads, in the units of a file.

    Parameters
    ----------
    document : dict
        The shaft's file.
    support : dict
        Its table.

    Returns
    -------
    dict
        Tables of a bearing case.
    """
    name = support["bearing"]
    own = document.get("bearing", {}).get(name)
    operation = document.get("operation", {})
    temperature = support.get("temperature_C", operation.get("temperature_C", 40.0))
    case = {key: document[key] for key in SHARED if key in document}
    case["title"] = f"{name} at {support['at_mm']:g} mm"
    case["bearing"] = {"name": name} if own is None else dict(own)
    case["operation"] = {
        "inner_speed_rpm": operation.get("inner_speed_rpm", 0.0),
        "temperature_C": temperature,
        "temperature": operation.get("temperature", "given"),
    }
    if "heat_transfer_W_K" in support:
        own_transfer = {"heat_transfer_W_K": support["heat_transfer_W_K"]}
        case["friction"] = case.get("friction", {}) | own_transfer
    # without [ehl]: of the film atlas and beyond it of formulas; behind layers there are neither
    layers = "inlet_film_um" in case.get("lubricant", {})
    unsolved = {"film_maps": "none"} | ({} if layers else {"films": "atlas"})
    case["ehl"] = document.get("ehl", unsolved)
    if support.get("loaded_by") is not None:
        row = {"axial_position_mm": 0.0, "loaded_by": support["loaded_by"]}
        if support.get("preload_N") is not None:
            row["preload_N"] = support["preload_N"]
        if support.get("offset_um") is not None:
            row["preload_um"] = support["offset_um"]
        case["rows"] = [row]
    return case
