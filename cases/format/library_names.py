"""Names of bearings, materials and oils in a case, spelled as the libraries spell them."""

from collections.abc import Iterable
from typing import Any

from bearing.library.lubricants import list_lubricants
from bearing.library.names import matching_name
from bearing.material import list_materials

MATERIAL_KEYS = {
    "bearing": (
        "ring_material",
        "inner_ring_material",
        "outer_ring_material",
        "ball_material",
        "cage_material",
    ),
    "fit": ("shaft_material", "housing_material"),
    "contact": ("material_1", "material_2"),
}
INTERNAL_GEOMETRY = ("ball_diameter_mm", "pitch_diameter_mm", "balls")
OF_THE_GEOMETRY = (  # hold for the catalogue's internal geometry only
    "basic_dynamic_rating_kN",
    "basic_static_rating_kN",
    "inner_shoulder_diameter_mm",
    "outer_shoulder_diameter_mm",
)
ALTERNATIVES = (  # one of a row given in the case replaces the others of the catalogue
    ("diametral_clearance_um", "free_contact_angle_deg"),
    ("ring_material", "inner_ring_material", "outer_ring_material"),
)


def with_library_names(document: dict[str, Any]) -> dict[str, Any]:
    """The document with names in the spelling of the libraries, whatever their case or hyphens."""
    materials = (*_own(document, "materials"), *list_materials())
    for table, keys in MATERIAL_KEYS.items():
        document = _spelled(document, table, keys, materials)
    oil = document.get("lubricant")
    # the library of oils needs NumPy
    if isinstance(oil, dict) and isinstance(oil.get("name"), str):
        document = _spelled(
            document, "lubricant", ("name",), (*_own(document, "lubricants"), *list_lubricants())
        )
    return document


def _own(document: dict[str, Any], table: str) -> Iterable[str]:
    own = document.get(table)
    return own if isinstance(own, dict) else ()


def _spelled(
    document: dict[str, Any], table: str, keys: Iterable[str], names: Iterable[str]
) -> dict[str, Any]:
    found = document.get(table)
    names = tuple(names)
    if not isinstance(found, dict):
        return document
    given = {key: found[key] for key in keys if isinstance(found.get(key), str)}
    spelled = {key: matching_name(value, names) or value for key, value in given.items()}
    return {**document, table: {**found, **spelled}}


def catalogue_values(entry: dict[str, Any], table: dict[str, Any]) -> dict[str, Any]:
    """What of a catalogue entry holds beside the keys that a case gives itself.

    Ratings and shoulders of the catalogue belong to its internal geometry: a case that changes
    that goes without.
    """
    for alternatives in ALTERNATIVES:
        if any(key in table for key in alternatives):
            entry = {key: value for key, value in entry.items() if key not in alternatives}
    if any(key in table and table[key] != entry.get(key) for key in INTERNAL_GEOMETRY):
        entry = {key: value for key, value in entry.items() if key not in OF_THE_GEOMETRY}
    return entry
