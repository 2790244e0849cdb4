"""[materials.NAME], and names and values of the libraries in a case: bearings, materials, oils."""

from collections.abc import Iterable, Iterator, Mapping
from typing import Annotated, Any

from oilfilm.bearing.library.bearings import catalogue_name, list_bearings, load_catalogue_entry
from oilfilm.bearing.library.lubricants import list_greases, list_lubricants, load_grease
from oilfilm.bearing.library.plugins import matching_name
from oilfilm.bearing.material import (
    ROOM,
    STRENGTH,
    Material,
    MaterialKind,
    list_materials,
    load_material,
)
from oilfilm.ehl.oil.assumed_heat import BaseOil
from oilfilm.ehl.oil.lubricant import DRY

from .bearing import ALTERNATIVES, CLEARANCE, GEOMETRY, BearingTable
from .fields import OneOf, Table, above, between, described, name_in_si, numbers_from_si
from .lubricant import SHEET, VISCOSITIES, named_by_sheet
from .rules import CaseProblem, CaseValues, nearest_name, shown

# keys of a material that its table in the case may leave to the library's
LIBRARY_FIELDS = (
    *("kind", "thermal_expansion", "thermal_conductivity", "specific_heat"),
    *("bending_strength", "weibull_modulus", "fracture_toughness"),
    *("bending_strength_range", "weibull_modulus_range", "fracture_toughness_range"),
    "expansion_points",
)
# tables whose keys with the word "material" name one
MATERIAL_TABLES = ("bearing", "fit", "contact")
INTERNAL_GEOMETRY = ("ball_diameter_mm", "pitch_diameter_mm", "balls")
GEOMETRY_DEPENDENT = (  # hold for the catalogue's internal geometry only
    "basic_dynamic_rating_kN",
    "basic_static_rating_kN",
    "inner_shoulder_diameter_mm",
    "outer_shoulder_diameter_mm",
)
BASE_OIL_NAMES = {  # other names of classes of base oils
    "polyalphaolefin": BaseOil.POLYALPHAOLEFIN.value,
    "polyglycol": BaseOil.POLYGLYCOL.value,
    "polyalkylene glycol": BaseOil.POLYGLYCOL.value,
    "perfluoropolyether": BaseOil.PERFLUOROPOLYETHER.value,
}


class MaterialTable(Table):
    """A material of the case, before those of the library. Thermal data, strength and kind that
    it lacks are those of the library's material of this name.
    """

    youngs_modulus_GPa: float = above(0, 2e3, "Young's modulus", ...)
    poisson_ratio: float = described("Poisson's ratio", ..., ge=0, lt=0.5)
    density_kg_m3: float = above(0, 3e4, "density", ...)
    thermal_expansion_um_m_K: float | None = between(-100, 1e3, "linear thermal expansion")
    thermal_conductivity_W_m_K: float | None = above(0, 1e4, "thermal conductivity")
    specific_heat_J_kg_K: float | None = above(0, 1e5, "specific heat capacity")
    bending_strength_MPa: float | None = above(
        0, 1e5, "of a brittle material, mean of bars in four-point bending"
    )
    weibull_modulus: float | None = above(1, 1e3, "of this strength")
    fracture_toughness_MPa_sqrt_m: float | None = above(0, 1e3, "of a brittle material, K_Ic")
    kind: Annotated[str, OneOf(MaterialKind)] | None = described(
        'for the rating life; else "other"'
    )
    source: str = described("where the numbers come from", "case file")


def materials(
    own: Mapping[str, MaterialTable], names: Iterable[str], temperature: float = ROOM
) -> dict[str, Material]:
    """Materials by name, those of the case before those of the library.

    Parameters
    ----------
    own : Mapping[str, MaterialTable]
        Tables of the case by name.
    names : Iterable[str]
        Names of the materials.
    temperature : float, optional
        Temperature of what the library has over the temperature [K].

    Returns
    -------
    dict[str, Material]
        The materials, SI.
    """
    return {
        name: _material(name, own[name], temperature)
        if name in own
        else load_material(name, temperature)
        for name in names
    }


def _material(name: str, table: MaterialTable, temperature: float) -> Material:
    """A material of the case, SI; what is left out of the library's of the same name."""
    values: dict[str, Any] = {"kind": MaterialKind.OTHER}
    if matching_name(name, list_materials()):
        library = load_material(name, temperature)
        values = {field: getattr(library, field) for field in LIBRARY_FIELDS}
    given = {field: value for field, value in table.si().items() if value is not None}
    for field in STRENGTH:  # a strength of the case's own beyond the library's range has none
        ends = values.get(f"{field}_range")
        if ends and field in given and not ends[0] <= given[field] <= ends[1]:
            values[f"{field}_range"] = None
    if given.get("thermal_expansion", values.get("thermal_expansion")) != values.get(
        "thermal_expansion"
    ):
        values["expansion_points"] = None  # a coefficient of the case's own
    values |= given
    return Material(name=name, **{**values, "kind": MaterialKind(values["kind"])})


def material_table(material: Material) -> dict[str, Any]:
    """A material as a table [materials.NAME].

    Parameters
    ----------
    material : Material
        The material, SI.

    Returns
    -------
    dict[str, Any]
        Values by key, in the units of the keys.
    """
    values = {key: getattr(material, name_in_si(key)) for key in MaterialTable.model_fields}
    own = {"kind": material.kind.value, "source": material.source}
    return {**numbers_from_si(values), **own}


def _names(document: dict[str, Any]) -> Iterator[tuple[str, str, tuple[str, ...]]]:
    """Table and key of every name of a material or an oil, and the names there are."""

    def own(table: str) -> dict[str, Any]:
        value = document.get(table)
        return value if isinstance(value, dict) else {}

    materials = (*own("materials"), *list_materials())
    for table in MATERIAL_TABLES:
        yield from ((table, key, materials) for key in own(table) if "material" in key)
    # a data sheet has a name of its own; the library of oils needs NumPy, most cases do not
    if "name" in own("lubricant") and not named_by_sheet(own("lubricant")):
        given = own("lubricant")["name"]
        library = list_lubricants(given if isinstance(given, str) else None)
        yield "lubricant", "name", (*own("lubricants"), *library)
    if "grease" in own("lubricant"):
        yield "lubricant", "grease", list_greases()


def with_library_names(document: dict[str, Any]) -> dict[str, Any]:
    """The document with names in the spelling of the libraries, whatever their case or hyphens.

    Parameters
    ----------
    document : dict[str, Any]
        Tables of a case.

    Returns
    -------
    dict[str, Any]
        The changed document.
    """
    spelled = dict(document)
    for table, key, names in _names(document):
        given = document[table][key]
        if isinstance(given, str):
            spelled[table] = {**spelled[table], key: matching_name(given, names) or given}
    oils = spelled.get("lubricants")
    if isinstance(oils, dict):
        spelled["lubricants"] = {name: _with_class(oil) for name, oil in oils.items()}
    if "lubricant" in spelled:
        spelled["lubricant"] = _with_class(spelled["lubricant"])
    return _with_base_oil(_with_dry(spelled))


def _with_dry(document: dict[str, Any]) -> dict[str, Any]:
    """The document of a bearing that runs dry with both of its words, where it has one."""
    oil = document.get("lubricant")
    friction = document.get("friction", {})
    if "bearing" not in document or not isinstance(friction, dict):
        return document
    if oil is None and friction.get("lubrication") == DRY:
        return {**document, "lubricant": {"name": DRY}}
    if isinstance(oil, dict) and oil.get("name") == DRY:
        return {**document, "friction": {"lubrication": DRY, **friction}}
    return document


def _with_class(oil: Any) -> Any:
    """Keys of an oil with the class of its base oil as the program spells it."""
    given = oil.get("base_oil") if isinstance(oil, dict) else None
    if not isinstance(given, str):
        return oil
    name = matching_name(given, (*BASE_OIL_NAMES, *(base.value for base in BaseOil)))
    return {**oil, "base_oil": BASE_OIL_NAMES.get(name or given, name or given)}


def _with_base_oil(document: dict[str, Any]) -> dict[str, Any]:
    """The document with the base oil of a grease, and grease as lubrication, unless it says
    otherwise.
    """
    oil = document.get("lubricant")
    friction = document.get("friction", {})
    if not isinstance(oil, dict) or not isinstance(friction, dict):
        return document
    grease = oil.get("grease")
    if grease not in list_greases():
        return document
    own = {"name", *VISCOSITIES, *SHEET} & oil.keys()
    base = {} if own else {"name": load_grease(grease).oil}
    document = {**document, "lubricant": {**base, **oil}}
    if "bearing" in document:
        document["friction"] = {"lubrication": "grease", **friction}
    return document


def name_faults(values: CaseValues) -> Iterator[CaseProblem]:
    """Problems of names of materials and oils that neither the case nor a library has.

    Parameters
    ----------
    values : CaseValues
        The valid values of the file.

    Yields
    ------
    Iterator[CaseProblem]
        The problems.
    """
    cage = values.given("temperatures", "cage_C") or values.given("dynamics")
    for table, key, names in _names(values.document):
        name = values.get(table, key)
        if isinstance(name, str) and name not in names and (key != "cage_material" or cage):
            nearest = nearest_name(name, names)
            allowed = "" if nearest else f"allowed: {', '.join(names)}"
            yield CaseProblem(
                (table, key), f"unknown name {shown(name)}", allowed, nearest=nearest
            )


def with_catalogue(document: dict[str, Any]) -> tuple[dict[str, Any], list[CaseProblem]]:
    """The document with the values of the catalogue that [bearing] does not override.

    Parameters
    ----------
    document : dict[str, Any]
        Tables of a case.

    Returns
    -------
    document
        The changed document.
    problems
        An unknown name of a bearing.
    """
    table = document.get("bearing")
    if not isinstance(table, dict) or not isinstance(table.get("name"), str) or not table["name"]:
        return document, []
    name = catalogue_name(table["name"])
    if name is None:
        # complete without the catalogue: a name of the user's own
        if all(key in table for key in GEOMETRY):
            return document, []
        nearest = nearest_name(table["name"], list_bearings())
        allowed = (
            "allowed: a name of 'oilfilm list bearings', also with suffixes, or a complete "
            "geometry"
        )
        finding = f"unknown bearing {shown(table['name'])}"
        path = ("bearing", "name")
        return document, [CaseProblem(path, finding, "" if nearest else allowed, nearest=nearest)]
    return {**document, "bearing": {**_of_catalogue(name, table), **table, "name": name}}, []


def _of_catalogue(name: str, table: dict[str, Any]) -> dict[str, Any]:
    """Values of a catalogue entry that are valid beside the keys of the case.

    Ratings and shoulders of the catalogue belong to its internal geometry: a case that changes
    that goes without.
    """
    entry = load_catalogue_entry(name)
    unused: set[str] = entry.keys() - BearingTable.model_fields.keys()
    for alternatives in ALTERNATIVES:
        if any(key in table for key in alternatives):
            unused.update(alternatives)
    if any(key in table and table[key] != entry.get(key) for key in INTERNAL_GEOMETRY):
        unused.update(GEOMETRY_DEPENDENT)
    values = {key: value for key, value in entry.items() if key not in unused}
    angle = entry.get(CLEARANCE[1])
    if angle is not None and CLEARANCE[1] not in {*values, *table}:
        values["nominal_contact_angle_deg"] = angle  # no clearance changes it
    return values
