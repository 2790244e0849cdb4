"""A case document: read, checked as a whole, with every fault at once."""

import re
import tomllib
from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from types import ModuleType
from typing import Any

from pydantic import TypeAdapter

from oilfilm.ehl.foreign_files import ESCAPED, DamagedFileError, has_control_characters, read_file

from . import (
    bearing,
    contact,
    dynamics,
    fits,
    friction,
    load_cases,
    lubricant,
    operation,
    rows,
    shaft,
    transient,
    vibration,
)
from .bearing import BearingTable, SurfaceTable
from .changes import without_computed
from .contact import ContactEhlTable, ContactTable, EhlTable
from .dynamics import CageTable, DynamicsTable
from .fields import Table, between, described, schema_of, validated
from .fits import FitTable, RingsTable, TemperaturesTable
from .friction import FrictionTable
from .library import MaterialTable, name_faults, with_catalogue, with_library_names
from .load_cases import LoadCaseTable
from .lubricant import LubricantTable, OilTable
from .operation import ModelTable, OperationTable, SlipTable
from .rows import RowTable
from .rules import (
    MISSING,
    CaseError,
    CaseProblem,
    CaseValues,
    faults_error,
    known_keys,
    nearest_name,
    relation_faults,
    shown,
)
from .shaft import (
    HousingTable,
    ShaftLoadTable,
    ShaftOperationTable,
    ShaftSupportTable,
    ShaftTable,
    SpringTable,
)
from .transient import FeatureTable, TransientTable
from .vibration import FormTable, SupportTable, VibrationTable

LARGEST_FILE = 1_000_000  # [bytes]
MOST_PARTS = 16  # of a dotted key: the memory of tomllib grows with their square
MOST_DEPTH = 32  # of brackets
LONGEST_WORD = 200  # characters of a name or a number outside quotes
# texts and comments, closed or not, words, and what joins them, as TOML reads them
TOKEN = re.compile(
    r'''"""(?:\\[\s\S]|[^\\])*?(?:"{3,5}|\Z)|'{3}[\s\S]*?(?:'{3,5}|\Z)'''
    r"""|"(?:\\.|[^"\\\n])*"?|'[^'\n]*'?|\#[^\n]*|[\w+-]+|[.\[\]{}=,\n]"""
)
NOT_OFFERED = "minimum dissipation"
WHY_NOT_OFFERED = (
    "not offered, since it jumps between the two race controls and has no balance there; allowed: "
    "'traction equilibrium', which balances the friction, or one of the race controls "
    "(docs/theory/bearing.md)"
)
NAMED_TABLES: dict[str, type[Table]] = {
    "materials": MaterialTable,
    "lubricants": OilTable,
    "rows": RowTable,
    "load_cases": LoadCaseTable,
    "features": FeatureTable,
    "support": ShaftSupportTable,
    "load": ShaftLoadTable,
    "spring": SpringTable,
    "bearing": BearingTable,
}
SWEEP_TABLES = ("sweep", "combinations", "latin_hypercube")


class CaseFile(Table):
    """Keys of every case file."""

    schema_version: int = between(1, 1, "version of this format", ...)
    title: str = described("one line for tables and plots", "")
    source: str = described("paper, table or page the numbers come from", "")
    assumed: tuple[str, ...] = described("table.key whose value no source gives", (), strict=False)
    lubricant: LubricantTable
    materials: dict[str, MaterialTable] = described("materials by name", {})

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes on keys that do not agree."""
        return ()


class BearingFile(CaseFile):
    """A bearing case: `oilfilm run`."""

    bearing: BearingTable
    operation: OperationTable
    model: ModelTable = ModelTable()
    ehl: EhlTable = EhlTable()
    surface: SurfaceTable | None = None
    fit: FitTable | None = None
    rings: RingsTable | None = None
    temperatures: TemperaturesTable | None = None
    slip: SlipTable | None = None
    friction: FrictionTable = FrictionTable()
    cage: CageTable | None = None
    dynamics: DynamicsTable | None = None
    form: FormTable | None = None
    support: SupportTable | None = None
    vibration: VibrationTable | None = None
    rows: tuple[RowTable, ...] | None = described(
        "rows of balls on the one inner ring", strict=False, min_length=1, max_length=8
    )
    load_cases: tuple[LoadCaseTable, ...] | None = described(
        "states of a duty cycle", strict=False, min_length=1, max_length=1000
    )
    measured: str | None = described(
        "file of measured torque, film or temperature over speed, load or temperature",
        min_length=1,
    )
    load_spectrum: str | None = described(
        "file of loads and speeds by share, duration or time instead of [[load_cases]]",
        min_length=1,
    )
    lubricants: dict[str, OilTable] = described("oils by name", {})

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes on two laws of friction that differ."""
        law = self.friction.traction
        if self.dynamics is None or law in (None, "films", self.dynamics.friction):
            return ()
        note = (
            f'two laws of friction: friction.traction = "{law}" in traction equilibrium, '
            f'dynamics.friction = "{self.dynamics.friction}" in the simulation'
        )
        return (note,)


class ContactFile(CaseFile):
    """A single contact: `oilfilm contact`."""

    contact: ContactTable
    ehl: ContactEhlTable = ContactEhlTable()
    transient: TransientTable | None = None
    features: tuple[FeatureTable, ...] = described(
        "of the surfaces, over time", (), strict=False, max_length=20
    )
    lubricants: dict[str, OilTable] = described("oils by name", {})


class ShaftFile(CaseFile):
    """A shaft on bearings: `oilfilm shaft`."""

    shaft: ShaftTable
    support: tuple[ShaftSupportTable, ...] = described(
        "bearings on the shaft", ..., strict=False, min_length=1, max_length=50
    )
    load: tuple[ShaftLoadTable, ...] = described(
        "loads and masses on the shaft", (), strict=False, max_length=200
    )
    spring: tuple[SpringTable, ...] = described(
        "bearings that are not computed", (), strict=False, max_length=50
    )
    housing: HousingTable = HousingTable()
    operation: ShaftOperationTable = ShaftOperationTable()
    ehl: EhlTable | None = None
    bearing: dict[str, BearingTable] = described("bearings by name", {})
    model: ModelTable = ModelTable()
    surface: SurfaceTable | None = None
    fit: FitTable | None = None
    friction: FrictionTable = FrictionTable()
    lubricants: dict[str, OilTable] = described("oils by name", {})


AnyFile = BearingFile | ContactFile | ShaftFile
# modules with relations, and functions for what these do not say, and the tables without which
# there is nothing to check; none: always
ALWAYS = ()
TABLES_OF: dict[type[AnyFile], dict[ModuleType, tuple[str, ...]]] = {
    BearingFile: {
        lubricant: ALWAYS,
        bearing: ALWAYS,
        fits: ("fit", "rings", "temperatures"),
        operation: ALWAYS,
        rows: ("rows", "ehl"),
        friction: ALWAYS,
        dynamics: ("cage", "dynamics"),
        vibration: ("form", "support", "vibration"),
        load_cases: ("load_cases",),
    },
    ContactFile: {lubricant: ALWAYS, contact: ALWAYS, transient: ALWAYS},
    ShaftFile: {shaft: ALWAYS},
}


def _conflicts(values: CaseValues, kind: type[AnyFile]) -> Iterator[CaseProblem]:
    """Every conflict between values that are valid by themselves."""
    modules = TABLES_OF[kind]
    yield from relation_faults([rule for module in modules for rule in module.RELATIONS], values)
    yield from name_faults(values)
    for module, tables in modules.items():
        if not tables or not values.document.keys().isdisjoint(tables):
            yield from module.faults(values)


def _load_case_conflicts(values: CaseValues, known: list[CaseProblem]) -> Iterator[CaseProblem]:
    """Conflicts that only a load case in the place of [operation] brings, at its keys."""
    if load_cases.NAME not in values.document:
        return
    before = {(fault.path, fault.finding) for fault in known}
    for index, own in load_cases.load_case_tables(values):
        for fault in _conflicts(load_cases.with_load_case(values, own), BearingFile):
            if (fault.path, fault.finding) not in before:
                yield load_cases.load_case_problem(fault, index, own)


def read_text(path: Path) -> str:
    """Read the text of a case file.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    str
        Its content.

    Raises
    ------
    CaseError
        If it cannot be read.
    """
    try:
        data = read_file(path, LARGEST_FILE)
    except OSError as error:
        raise CaseError(f"{path}: cannot be read: {error.strerror or error}") from None
    except DamagedFileError as error:
        raise CaseError(f"{error}; allowed: a case file") from None
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise CaseError(f"{path}: not a text file in UTF-8; allowed: a case file") from None


def validate_text(text: str, name: str, *, own_table: bool = True) -> AnyFile:
    """Check the text of a case file.

    Parameters
    ----------
    text : str
        Content of the file.
    name : str
        Name of the file in messages.
    own_table : bool, default True
        False for `oilfilm table`, which makes the file of `friction.traction_table`.

    Returns
    -------
    BearingFile | ContactFile | ShaftFile
        The checked tables in their units, catalogue values filled in.

    Raises
    ------
    CaseError
        If something is wrong, with one line for every error.
    """
    document = parse(text, name)
    if not own_table:
        document = friction.without_own_table(document)
    file, faults = check_document(document)
    if file is None or faults:
        raise faults_error(faults, name, text)
    return file


def parse(text: str, name: str) -> dict[str, Any]:
    """Parse a TOML file that is not empty.

    Parameters
    ----------
    text : str
        Content of the file.
    name : str
        Name of the file in messages.

    Returns
    -------
    dict[str, Any]
        Its tables.

    Raises
    ------
    CaseError
        If it is no TOML, with the line.
    """
    _require_bounded(text, name)
    try:
        document = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        line = _syntax_line(str(error), text)
        raise CaseError(f"{name}:{line}: not valid TOML: {error}") from None
    if not document:
        raise CaseError(f"{name}:1: the file is empty; see 'oilfilm init'")
    if has_control_characters(document):
        place = ESCAPED.search(text)
        line = text.count("\n", 0, place.start() if place else 0) + 1
        raise CaseError(f"{name}:{line}: not usable: control characters in a text")
    return document


def _require_bounded(text: str, name: str) -> None:
    """`CaseError` where a text has longer keys, deeper brackets or longer words than a case."""
    parts = depth = 0
    dotted = False
    for token in TOKEN.finditer(text):
        word = token[0]
        if word == ".":
            dotted = True
            continue
        parts = parts + 1 if dotted else 1
        dotted = False
        depth += (word in "[{") - (word in "]}")
        fault = (
            f"a key of more than {MOST_PARTS} parts"
            if parts > MOST_PARTS
            else "brackets are nested too deeply"
            if depth > MOST_DEPTH
            else f"a name or number of more than {LONGEST_WORD} characters"
            if len(word) > LONGEST_WORD and word[0] not in "\"'#"
            else ""
        )
        if fault:
            line = text.count("\n", 0, token.start()) + 1
            raise CaseError(f"{name}:{line}: not usable: {fault}")


def _syntax_line(message: str, text: str) -> int:
    """The line tomllib names in its message; the last one where it says 'end of document'."""
    words = message.replace(",", " ").split()
    numbers = [word for before, word in pairwise(words) if before == "line" and word.isdigit()]
    return int(numbers[-1]) if numbers else text.count("\n") + 1


def check_document(document: dict[str, Any]) -> tuple[AnyFile | None, list[CaseProblem]]:
    """Check a document in the units of a file.

    Parameters
    ----------
    document : dict[str, Any]
        Tables of a case.

    Returns
    -------
    file
        The checked tables; None where a value is wrong.
    problems
        Every problem.
    """
    if any(key in document for key in SWEEP_TABLES):
        allowed = "run it with 'oilfilm batch'"
        return None, [CaseProblem((), "a sweep", allowed, line=1)]
    # 1. what a run computed, and what this version does not take
    document, faults = _set_aside(without_computed(document))
    kind: type[AnyFile] = BearingFile
    if "shaft" in document:
        kind = ShaftFile
    elif "contact" in document and "bearing" not in document:
        kind = ContactFile
    if "contact" in document and "bearing" in document:
        finding = "found together with [bearing]"
        allowed = "allowed: a bearing, or a single contact"
        faults.append(CaseProblem(("contact",), finding, allowed))
        document = {key: value for key, value in document.items() if key != "contact"}
    # 2. values of the libraries
    document = with_library_names(document)
    if kind is ShaftFile:
        document, unknown = _with_own_bearings(document)
    else:
        document, unknown = with_catalogue(document)
    faults += unknown
    # 3. each value by itself, then the rules between those that are valid
    file, wrong = _validate(kind, document)
    faults += wrong
    values = CaseValues(document, frozenset(fault.path for fault in faults))
    conflicts = list(_conflicts(values, kind))
    faults += conflicts
    faults += _load_case_conflicts(values, conflicts)
    faults += _assumed(values, kind)
    return file, _without_consequences(faults, unknown_bearing=bool(unknown))


def _with_own_bearings(document: dict[str, Any]) -> tuple[dict[str, Any], list[CaseProblem]]:
    """A shaft's document with the values of the catalogue in its tables [bearing.NAME]."""
    tables = document.get("bearing")
    if not isinstance(tables, dict):
        return document, []
    filled = {}
    problems = []
    for name, table in tables.items():
        own, unknown = with_catalogue({"bearing": table})
        filled[name] = own["bearing"]
        problems += [replace(fault, path=("bearing", name, *fault.path[1:])) for fault in unknown]
    return {**document, "bearing": filled}, problems


def _without_consequences(
    faults: list[CaseProblem], *, unknown_bearing: bool
) -> list[CaseProblem]:
    """The faults without those that follow from a misspelt key or an unknown bearing."""
    meant = {(*fault.path[:-1], fault.nearest) for fault in faults if fault.nearest}
    if unknown_bearing:
        meant |= {fault.path for fault in faults if fault.path[0:1] == ("bearing",)}
    return [fault for fault in faults if fault.finding != MISSING or fault.path not in meant]


def _set_aside(document: dict[str, Any]) -> tuple[dict[str, Any], list[CaseProblem]]:
    """Take out, with a fault, what the format knows and this version does not."""
    faults = []
    model = document.get("model")
    if isinstance(model, dict) and model.get("ball_kinematics") == NOT_OFFERED:
        path = ("model", "ball_kinematics")
        faults.append(CaseProblem(path, f"found {shown(NOT_OFFERED)}", WHY_NOT_OFFERED))
        others = {key: value for key, value in model.items() if key != path[1]}
        document = {**document, "model": others}
    return document, faults


def _validate(
    model: type[AnyFile], document: dict[str, Any]
) -> tuple[AnyFile | None, list[CaseProblem]]:
    missing = []
    if "schema_version" not in document:
        document = {**document, "schema_version": 1}
        allowed = "needed: schema_version = 1"
        missing = [CaseProblem(("schema_version",), MISSING, allowed, line=1)]
    file, faults = validated(model, document)
    return file, missing + faults


def _assumed(values: CaseValues, kind: type[AnyFile]) -> Iterator[CaseProblem]:
    """Names under `assumed` that are no keys of a case file."""
    assumed = values.get("assumed")
    if not assumed:
        return
    known = known_keys(schema_of(kind))
    for name in assumed:
        if not isinstance(name, str) or name in known:
            continue
        table, _, rest = name.partition(".")
        if rest.rpartition(".")[2] not in NAMED_TABLES.get(table, Table).model_fields:
            finding = f"unknown key {shown(name)}"
            yield CaseProblem(("assumed",), finding, nearest=nearest_name(name, known))


def json_schema() -> dict[str, Any]:
    """JSON Schema of case files, for editors."""
    adapter: TypeAdapter[Any] = TypeAdapter(AnyFile)
    head = {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": "oilfilm case"}
    return {**head, **adapter.json_schema()}
