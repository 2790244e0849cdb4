"""A case file, read, checked as a whole, and turned into the dataclasses the computation takes."""

import tomllib
import warnings
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cache
from itertools import pairwise
from math import radians
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter, ValidationError

from bearing.fits.clearance import ClearanceBudget
from bearing.friction.law import BallTraction
from bearing.geometry import Bearing
from bearing.library.bearings import list_bearings, load_catalogue_entry, warn_of_estimates
from bearing.library.lubricants import list_lubricants
from bearing.library.names import matching_name
from bearing.material import list_materials
from bearing.operation import Model, Operation, RatingInput
from bearing.rows import Row
from bearing.torque.breakdown import FrictionInput
from ehl import ContactConditions, Lubricant, MoesConditions, SolverOptions
from ehl.oil.rheology import Rheology

from .. import checks
from ..dynamics_plan import DynamicsPlan
from ..schema.bearing import BearingTable, MaterialTable
from ..schema.fields import Table
from ..schema.files import BearingFile, ContactFile
from ..schema.lubricant import OilTable
from ..schema.rows import RowTable
from ..slip_plan import SlipPlan
from .film_model import NEWTONIAN, FilmPhysics
from .heating import HeatingPlan
from .library_names import catalogue_values, with_library_names
from .problems import (
    MISSING,
    CaseError,
    Problem,
    UnfitKey,
    nearest_name,
    resolved,
    schema_problems,
    shown,
)
from .shipped import find_case
from .toml_lines import key_lines

LARGEST_FILE = 1_000_000  # [bytes]
NOT_SUPPORTED = "not supported by this version"
LATER_TABLES = ("load_cases",)
LATER_VALUES = {("model", "ball_kinematics"): ("minimum dissipation",)}
NOT_OFFERED = {
    "minimum dissipation": "not offered, since it jumps between the two race controls and has no balance there; "
    "allowed: 'traction equilibrium', which balances the friction, or one of the race controls (docs/theory/bearing.md)"
}
NAMED_TABLES: dict[str, type[Table]] = {
    "materials": MaterialTable,
    "lubricants": OilTable,
    "rows": RowTable,
}
SWEEP_TABLES = ("sweep", "combinations", "latin_hypercube")


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """A bearing case, SI."""

    title: str
    source: str
    assumed: tuple[str, ...]  # keys of the case file whose values no source gives
    bearing: Bearing
    lubricant: Lubricant
    operation: Operation
    model: Model
    # friction of balls on races, where the case names it or takes traction equilibrium
    traction: BallTraction | None
    solver: SolverOptions
    film_maps: str | tuple[float, ...]  # "all", "loaded", "none", or azimuths of balls [rad]
    document: dict[str, Any]  # the case file as run, defaults and library values filled in
    warnings: tuple[str, ...] = ()  # what the libraries have to say about their values
    slip: SlipPlan | None = None  # maps of `oilfilm slip`
    dynamics: DynamicsPlan | None = None  # the time simulation
    friction: FrictionInput | None = None  # what the friction torque models need
    heating: HeatingPlan | None = None  # the heat balance, where it is asked for
    films: FilmPhysics = NEWTONIAN  # what the films are solved with
    rheology: Rheology | None = None  # how the oil shears
    rating: RatingInput | None = None  # what the rating life needs beyond the loads
    # where fits or temperatures change it; `bearing` has the operating one
    clearance: ClearanceBudget | None = None
    rows: tuple[Row, ...] | None = None  # None: a single one


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactCase:
    """A single-contact case, SI."""

    title: str
    source: str
    assumed: tuple[str, ...]
    conditions: ContactConditions | MoesConditions
    solver: SolverOptions
    document: dict[str, Any]
    films: FilmPhysics = NEWTONIAN  # what the film is solved with
    rheology: Rheology | None = None  # how the oil shears; None with Moes' groups
    temperature: float | None = None  # of the oil [K]
    warnings: tuple[str, ...] = ()


def load_case(name_or_path: str | Path) -> Case | ContactCase:
    """Read a case.

    Parameters
    ----------
    name_or_path : str or Path
        A case file, or the name (stem) of a shipped case.

    Returns
    -------
    Case or ContactCase
        All quantities in SI.

    Raises
    ------
    CaseError
        With one line for every error of the file.
    """
    path = find_case(name_or_path)
    return case_from_text(read_text(path), str(path))


def case_from_text(text: str, name: str) -> Case | ContactCase:
    """The case that the text of a case file describes; `name` stands for the file in messages."""
    return case_of_file(validate_text(text, name), name, text)


def case_of_file(file: BearingFile | ContactFile, name: str, text: str = "") -> Case | ContactCase:
    """The case that a checked file describes; `name` stands for the file in messages, `text` gives
    their lines.
    """
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            case = _bearing_case(file) if isinstance(file, BearingFile) else _contact_case(file)
        except UnfitKey as error:
            raise CaseError(
                [error.problem.text(name, key_lines(text))], [error.problem]
            ) from error
        except ValueError as error:  # a bound of the physics that no table knows
            raise CaseError([f"{name}: {error}"]) from error
    return replace(case, warnings=tuple(str(warning.message) for warning in caught))


def read_text(path: Path) -> str:
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
    file, problems = check_document(document)
    if file is None or problems:
        lines = key_lines(text)
        ordered = sorted(problems, key=lambda problem: problem.line_in(lines))
        raise CaseError(dict.fromkeys(problem.text(name, lines) for problem in ordered))
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
) -> tuple[BearingFile | ContactFile | None, list[Problem]]:
    """The checked file, or None, and every problem of a case document (keys and units as in the
    file).
    """
    if any(key in document for key in SWEEP_TABLES):
        return None, [
            Problem(path=(), line=1, found="a sweep", allowed="run it with 'oilfilm batch'")
        ]
    document, problems = _set_aside(document)
    contact = "contact" in document and "bearing" not in document
    if "contact" in document and "bearing" in document:
        found = "found together with [bearing]"
        problems.append(
            Problem(
                path=("contact",), found=found, allowed="allowed: a bearing, or a single contact"
            )
        )
        document = {key: value for key, value in document.items() if key != "contact"}
    document, more = _with_catalogue(with_library_names(document))
    problems += more
    model: type[BearingFile | ContactFile] = ContactFile if contact else BearingFile
    file, faults = _validate(model, document)
    problems += faults
    values = checks.Values(document, frozenset(problem.path for problem in problems))
    check = checks.contact_problems if contact else checks.bearing_problems
    problems += check(values, _names(values))
    problems += _assumed(values)
    meant = {(*problem.path[:-1], problem.nearest) for problem in problems if problem.nearest}
    if more:  # of an unknown bearing all is missing
        meant |= {problem.path for problem in problems if problem.path[0:1] == ("bearing",)}
    return file, [
        problem for problem in problems if problem.found != MISSING or problem.path not in meant
    ]


def _set_aside(document: dict[str, Any]) -> tuple[dict[str, Any], list[Problem]]:
    """Take out, with a message, what the format knows and this version does not."""
    problems = [
        Problem(path=(key,), found="found", allowed=NOT_SUPPORTED)
        for key in LATER_TABLES
        if key in document
    ]
    document = {
        key: dict(value) if isinstance(value, dict) else value
        for key, value in document.items()
        if key not in LATER_TABLES
    }
    for (table, key), values in LATER_VALUES.items():
        if isinstance(document.get(table), dict) and document[table].get(key) in values:
            value = document[table].pop(key)
            allowed = NOT_OFFERED.get(value, NOT_SUPPORTED)
            problems.append(
                Problem(path=(table, key), found=f"found {shown(value)}", allowed=allowed)
            )
    return document, problems


def _with_catalogue(document: dict[str, Any]) -> tuple[dict[str, Any], list[Problem]]:
    """The document with the catalogue's values where [bearing] names an entry and does not
    override them.
    """
    table = document.get("bearing")
    if not isinstance(table, dict) or not isinstance(table.get("name"), str) or not table["name"]:
        return document, []
    known = tuple(list_bearings())
    name = matching_name(table["name"], known)
    if name is None:
        # complete without the catalogue: a name of the user's own
        if all(key in table for key in checks.GEOMETRY):
            return document, []
        nearest = nearest_name(table["name"], known)
        found = f"unknown bearing {shown(table['name'])}"
        allowed = (
            "" if nearest else "allowed: a name of 'oilfilm list bearings', or a complete geometry"
        )
        return document, [
            Problem(path=("bearing", "name"), found=found, allowed=allowed, nearest=nearest)
        ]
    entry = {
        key: value
        for key, value in load_catalogue_entry(name).items()
        if key in BearingTable.model_fields
    }
    return {**document, "bearing": {**catalogue_values(entry, table), **table, "name": name}}, []


def _validate(
    model: type[BearingFile | ContactFile], document: dict[str, Any]
) -> tuple[BearingFile | ContactFile | None, list[Problem]]:
    if "schema_version" not in document:
        document = {**document, "schema_version": 1}
        missing = [
            Problem(
                path=("schema_version",),
                line=1,
                found=MISSING,
                allowed="needed: schema_version = 1",
            )
        ]
    else:
        missing = []
    try:
        return model.model_validate(document), missing
    except ValidationError as error:
        return None, missing + schema_problems(error.errors(include_url=False), _schema_of(model))


@cache
def _schema_of(model: type[BearingFile | ContactFile]) -> dict[str, Any]:
    return model.model_json_schema()


def _names(values: checks.Values) -> checks.Names:
    def with_own(table: str, library: Iterable[str]) -> tuple[str, ...]:
        own = values.document.get(table)
        return (*(own if isinstance(own, dict) else ()), *library)

    oils: Iterable[str] = ()
    if values.given("lubricant", "name"):  # the library of oils needs NumPy, most cases do not
        oils = list_lubricants()
    return checks.Names(with_own("materials", list_materials()), with_own("lubricants", oils))


def _assumed(values: checks.Values) -> list[Problem]:
    """Names under `assumed` that are no keys of a case file."""
    schema = _schema_of(ContactFile if "contact" in values.document else BearingFile)
    tables = {
        table: resolved(schema, node).get("properties", ())
        for table, node in schema["properties"].items()
    }
    known = {f"{table}.{key}" for table, keys in tables.items() for key in keys}
    problems = []
    for name in values.get("assumed") or ():
        if not isinstance(name, str) or name in known:
            continue
        table, _, rest = name.partition(".")
        if rest.rpartition(".")[2] not in NAMED_TABLES.get(table, Table).model_fields:
            found = f"unknown key {shown(name)}"
            problems.append(
                Problem(path=("assumed",), found=found, nearest=nearest_name(name, known))
            )
    return problems


def _bearing_case(file: BearingFile) -> Case:
    from .. import convert

    assumed = {
        name.removeprefix("bearing.") for name in file.assumed if name.startswith("bearing.")
    }
    warn_of_estimates(file.bearing.name or "", file.bearing.model_dump(), assumed)
    oil = convert.lubricant(file)
    document = _document(file)
    names = (*convert.ring_materials(file.bearing), *convert.seat_materials(file))
    document["materials"] = {
        name: convert.material_table(m) for name, m in convert.materials(file, names).items()
    }
    document["lubricant"] = _lubricant_document(document, convert.lubricant_keys(oil, moes=False))
    maps = file.ehl.film_maps
    operation = convert.operation(file.operation)
    bearing, clearance = convert.operating_bearing(file, operation)
    films = convert.film_physics(file, shear := convert.rheology(file, oil))
    model = convert.model(file)
    document["model"]["ball_kinematics"] = model.ball_kinematics.value
    return Case(
        title=file.title,
        source=file.source,
        assumed=file.assumed,
        bearing=bearing,
        lubricant=oil,
        operation=operation,
        model=model,
        traction=convert.ball_traction(file, bearing, oil, shear, films),
        solver=convert.solver_options(file.ehl),
        film_maps=maps if isinstance(maps, str) else tuple(radians(azimuth) for azimuth in maps),
        document=document,
        slip=None if file.slip is None else convert.slip_plan(file.slip),
        dynamics=None if file.dynamics is None else convert.dynamics_plan(file),
        rating=convert.rating(file),
        friction=convert.friction(file),
        heating=convert.heating(file, oil),
        films=films,
        rheology=shear,
        clearance=clearance,
        rows=convert.rows(file),
    )


def _contact_case(file: ContactFile) -> ContactCase:
    from .. import convert

    oil = convert.lubricant(file)
    document = _document(file)
    moes = file.contact.moes_M is not None
    shear = None if moes else convert.rheology(file, oil)
    document["contact"] = {**convert.contact_defaults(file), **document["contact"]}
    document["lubricant"] = _lubricant_document(document, convert.lubricant_keys(oil, moes=moes))
    return ContactCase(
        title=file.title,
        source=file.source,
        assumed=file.assumed,
        conditions=convert.contact(file, oil),
        solver=convert.solver_options(file.ehl),
        document=document,
        films=convert.film_physics(file, shear),
        rheology=shear,
        temperature=convert.temperature(file),
    )


def _document(file: BearingFile | ContactFile) -> dict[str, Any]:
    document = file.model_dump(mode="json", exclude_none=True)
    return {key: value for key, value in document.items() if value != {}}


def _lubricant_document(document: dict[str, Any], computed: dict[str, Any]) -> dict[str, Any]:
    """The lubricant's keys as given, those of the oil named and the defaults filled in."""
    given, _ = checks.oil_table(document)
    if "kinematic_viscosity_mm2_s" in given:
        computed.pop("viscosity_mPa_s", None)
    little = "inlet_film_um" in given or "supply_mL_min" in document.get("friction", ())
    return {**computed, "supply": "starved" if little else "flooded", **given}


def json_schema() -> dict[str, Any]:
    """JSON Schema of case files, for editors."""
    adapter: TypeAdapter[Any] = TypeAdapter(BearingFile | ContactFile)
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "oilfilm case",
        **adapter.json_schema(),
    }
