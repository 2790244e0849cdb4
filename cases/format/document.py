"""A case document: read, checked as a whole, with every fault at once."""

import tomllib
from collections.abc import Iterable
from dataclasses import replace
from functools import cache
from itertools import pairwise
from pathlib import Path as FilePath
from typing import Any

from pydantic import TypeAdapter, ValidationError

from bearing.library.bearings import list_bearings, load_catalogue_entry
from bearing.library.lubricants import list_lubricants
from bearing.library.names import matching_name
from bearing.material import list_materials

from .bearing import GEOMETRY, BearingTable
from .dynamics import RENAMED
from .fields import Table
from .files import BearingFile, ContactFile, bearing_faults, contact_faults
from .library_names import catalogue_values, with_library_names
from .lubricant import OilTable
from .materials import MaterialTable
from .problems import (
    MISSING,
    CaseError,
    CaseFault,
    dotted,
    faults_error,
    nearest_name,
    resolved,
    schema_faults,
    shown,
)
from .rows import RowTable
from .rules import CaseValues, KnownNames
from .toml_lines import Path

LARGEST_FILE = 1_000_000  # [bytes]
NOT_SUPPORTED = "not supported by this version"
LATER_TABLES = ("load_cases",)
LATER_VALUES = {("model", "ball_kinematics"): ("minimum dissipation",)}
NOT_OFFERED = {
    "minimum dissipation": (
        "not offered, since it jumps between the two race controls and has no balance there; "
        "allowed: 'traction equilibrium', which balances the friction, or one of the race "
        "controls (docs/theory/bearing.md)"
    )
}
NAMED_TABLES: dict[str, type[Table]] = {
    "materials": MaterialTable,
    "lubricants": OilTable,
    "rows": RowTable,
}
SWEEP_TABLES = ("sweep", "combinations", "latin_hypercube")


def read_text(path: FilePath) -> str:
    """Text of a case file; `CaseError` if it cannot be read."""
    try:
        data = path.read_bytes() if path.stat().st_size <= LARGEST_FILE else None
    except OSError as error:
        raise CaseError([f"{path}: cannot be read: {error.strerror or error}"]) from None
    if data is None:
        raise CaseError([f"{path}: larger than {LARGEST_FILE} bytes; allowed: a case file"])
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise CaseError([f"{path}: not a text file in UTF-8; allowed: a case file"]) from None


def validate_text(text: str, name: str) -> BearingFile | ContactFile:
    """Check a case file as a whole.

    Parameters
    ----------
    text : str
        The file.
    name : str
        Its name, for messages.

    Returns
    -------
    BearingFile or ContactFile
        In the units of the file, catalogue values filled in.
    """
    document = parse(text, name)
    file, faults = check_document(document)
    if file is None or faults:
        raise faults_error(faults, name, text)
    return file


def parse(text: str, name: str) -> dict[str, Any]:
    """The tables of a TOML file that is not empty; `CaseError` with its line if it is none."""
    try:
        document = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise CaseError(
            [f"{name}:{_syntax_line(str(error), text)}: not valid TOML: {error}"]
        ) from None
    except RecursionError:
        raise CaseError([f"{name}:1: not usable: brackets are nested too deeply"]) from None
    except ValueError:
        raise CaseError(
            [f"{name}:1: not usable: a whole number has thousands of digits"]
        ) from None
    if not document:
        raise CaseError([f"{name}:1: the file is empty; see 'oilfilm init'"])
    return document


def _syntax_line(message: str, text: str) -> int:
    """The line tomllib names in its message; the last one where it says 'end of document'."""
    words = message.replace(",", " ").split()
    numbers = [word for before, word in pairwise(words) if before == "line" and word.isdigit()]
    return int(numbers[-1]) if numbers else text.count("\n") + 1


def check_document(
    document: dict[str, Any],
) -> tuple[BearingFile | ContactFile | None, list[CaseFault]]:
    """The checked file, or None, and every fault of a document in the units of a file."""
    if any(key in document for key in SWEEP_TABLES):
        allowed = "run it with 'oilfilm batch'"
        return None, [CaseFault((), "a sweep", allowed, line=1)]
    # 1. what this version does not take, or takes under another name
    document, faults = _set_aside(document)
    document, moved, more = _with_new_names(document)
    faults += more
    contact = "contact" in document and "bearing" not in document
    if "contact" in document and "bearing" in document:
        found = "found together with [bearing]"
        allowed = "allowed: a bearing, or a single contact"
        faults.append(CaseFault(("contact",), found, allowed))
        document = {key: value for key, value in document.items() if key != "contact"}
    # 2. values of the libraries
    document, unknown = _with_catalogue(with_library_names(document))
    faults += unknown
    # 3. each value by itself, then the rules between those that are valid
    model: type[BearingFile | ContactFile] = ContactFile if contact else BearingFile
    file, wrong = _validate(model, document, moved)
    faults += wrong
    values = CaseValues(document, frozenset(fault.path for fault in faults))
    rules = contact_faults if contact else bearing_faults
    faults += rules(values, _names(values))
    faults += _assumed(values)
    faults = [replace(fault, path=moved.get(fault.path, fault.path)) for fault in faults]
    return file, _without_consequences(faults, unknown_bearing=bool(unknown))


def _without_consequences(faults: list[CaseFault], *, unknown_bearing: bool) -> list[CaseFault]:
    """The faults without those that follow from a misspelt key or an unknown bearing."""
    meant = {(*fault.path[:-1], fault.nearest) for fault in faults if fault.nearest}
    if unknown_bearing:
        meant |= {fault.path for fault in faults if fault.path[0:1] == ("bearing",)}
    return [fault for fault in faults if fault.found != MISSING or fault.path not in meant]


def _set_aside(document: dict[str, Any]) -> tuple[dict[str, Any], list[CaseFault]]:
    """Take out, with a fault, what the format knows and this version does not."""
    faults = [CaseFault((key,), "found", NOT_SUPPORTED) for key in LATER_TABLES if key in document]
    document = {
        key: dict(value) if isinstance(value, dict) else value
        for key, value in document.items()
        if key not in LATER_TABLES
    }
    for (table, key), values in LATER_VALUES.items():
        if isinstance(document.get(table), dict) and document[table].get(key) in values:
            value = document[table].pop(key)
            allowed = NOT_OFFERED.get(value, NOT_SUPPORTED)
            found = f"found {shown(value)}"
            faults.append(CaseFault((table, key), found, allowed))
    return document, faults


def _with_new_names(
    document: dict[str, Any],
) -> tuple[dict[str, Any], dict[Path, Path], list[CaseFault]]:
    """The document with keys of [dynamics] that now belong to [friction], their paths in the file
    by their new ones, and a fault where both are given and differ.
    """
    assumed = document.get("assumed")
    if isinstance(assumed, list | tuple):
        names = {f"dynamics.{key}": f"friction.{new}" for key, new in RENAMED.items()}
        assumed = [names.get(name, name) if isinstance(name, str) else name for name in assumed]
        document = {**document, "assumed": assumed}
    simulation = document.get("dynamics")
    friction = document.get("friction", {})
    if not isinstance(simulation, dict) or not isinstance(friction, dict):
        return document, {}, []
    law = simulation.get("friction")
    simulation, friction = dict(simulation), dict(friction)
    moved: dict[Path, Path] = {}
    faults = []
    for key, new in RENAMED.items():
        if key not in simulation:
            continue
        value = simulation.pop(key)
        if new == "coefficient" and law != "coulomb":
            continue  # without its law it had no effect
        if friction.get(new, value) != value:
            found = f"found together with friction.{new}"
            allowed = f"allowed: friction.{new}, which replaces it"
            faults.append(CaseFault(("dynamics", key), found, allowed))
        else:
            friction[new] = value
            moved["friction", new] = ("dynamics", key)
    if friction:
        document = {**document, "friction": friction}
    return {**document, "dynamics": simulation}, moved, faults


def _with_catalogue(document: dict[str, Any]) -> tuple[dict[str, Any], list[CaseFault]]:
    """The document with the values of the catalogue that [bearing] does not override."""
    table = document.get("bearing")
    if not isinstance(table, dict) or not isinstance(table.get("name"), str) or not table["name"]:
        return document, []
    known = tuple(list_bearings())
    name = matching_name(table["name"], known)
    if name is None:
        # complete without the catalogue: a name of the user's own
        if all(key in table for key in GEOMETRY):
            return document, []
        nearest = nearest_name(table["name"], known)
        found = f"unknown bearing {shown(table['name'])}"
        allowed = (
            "" if nearest else "allowed: a name of 'oilfilm list bearings', or a complete geometry"
        )
        return document, [CaseFault(("bearing", "name"), found, allowed, nearest=nearest)]
    entry = {
        key: value
        for key, value in load_catalogue_entry(name).items()
        if key in BearingTable.model_fields
    }
    return {**document, "bearing": {**catalogue_values(entry, table), **table, "name": name}}, []


def _validate(
    model: type[BearingFile | ContactFile], document: dict[str, Any], moved: dict[Path, Path]
) -> tuple[BearingFile | ContactFile | None, list[CaseFault]]:
    missing = []
    if "schema_version" not in document:
        document = {**document, "schema_version": 1}
        allowed = "needed: schema_version = 1"
        missing = [CaseFault(("schema_version",), MISSING, allowed, line=1)]
    notes = [
        f"{dotted(old)}: is now {dotted(new)}, and will not be read under its old "
        "name by the next version"
        for new, old in moved.items()
    ]
    try:
        return model.model_validate(document, context=notes), missing
    except ValidationError as error:
        return None, missing + schema_faults(error.errors(include_url=False), _schema_of(model))


@cache
def _schema_of(model: type[BearingFile | ContactFile]) -> dict[str, Any]:
    return model.model_json_schema()


def _names(values: CaseValues) -> KnownNames:
    def with_own(table: str, library: Iterable[str]) -> tuple[str, ...]:
        own = values.document.get(table)
        return (*(own if isinstance(own, dict) else ()), *library)

    oils: Iterable[str] = ()
    if values.given("lubricant", "name"):  # the library of oils needs NumPy, most cases do not
        oils = list_lubricants()
    return KnownNames(with_own("materials", list_materials()), with_own("lubricants", oils))


def _assumed(values: CaseValues) -> list[CaseFault]:
    """Names under `assumed` that are no keys of a case file."""
    schema = _schema_of(ContactFile if "contact" in values.document else BearingFile)
    tables = {
        table: resolved(schema, node).get("properties", ())
        for table, node in schema["properties"].items()
    }
    known = {f"{table}.{key}" for table, keys in tables.items() for key in keys}
    faults = []
    for name in values.get("assumed") or ():
        if not isinstance(name, str) or name in known:
            continue
        table, _, rest = name.partition(".")
        if rest.rpartition(".")[2] not in NAMED_TABLES.get(table, Table).model_fields:
            found = f"unknown key {shown(name)}"
            faults.append(CaseFault(("assumed",), found, nearest=nearest_name(name, known)))
    return faults


def json_schema() -> dict[str, Any]:
    """JSON Schema of case files, for editors."""
    adapter: TypeAdapter[Any] = TypeAdapter(BearingFile | ContactFile)
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "oilfilm case",
        **adapter.json_schema(),
    }
