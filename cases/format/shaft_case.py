"""A shaft case: shaft, supports and loads in SI, and a case of each bearing."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from oilfilm.bearing.geometry import SINGLE
from oilfilm.bearing.material import Material
from oilfilm.bearing.shaft.beam import Section
from oilfilm.bearing.shaft.system import (
    REFERENCE_TEMPERATURE,
    AxialLocation,
    PointLoad,
    ShaftSystem,
    Spring,
    Support,
)
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.messages import Caution
from oilfilm.ehl.units import from_si

from .case import Case, ContactCase, case_of_document
from .data_tables import case_table
from .document import ShaftFile, check_document, read_text, validate_text
from .library import materials
from .operation import SELF_HEATED
from .rules import CaseError, CaseProblem, InvalidKeyError, key_lines
from .shaft import HousingTable, SectionTable, bearing_document
from .shipped import find_case

ASYMMETRY = 1.0e-3  # of a matrix from a file, by rounding [-]
MILLIMETRES = {"N m rad": 1.0, "N mm rad": 1.0e-3}  # lengths of a file of stiffness [m]
MISFIT = 0.1  # of the bore, beyond which the diameter of the shaft is told [-]
ANGULAR = 15.0  # free contact angle of bearings that are loaded from one side [deg]
RIGID = 1.0e13  # stiffness of a direction that a housing leaves out [N/m], [N m/rad]


@dataclass(frozen=True, slots=True, kw_only=True)
class ShaftCase:
    """A shaft with its bearings, SI."""

    title: str
    source: str
    assumed: tuple[str, ...]
    system: ShaftSystem
    cases: tuple[Case, ...]  # of the bearings, without loads
    documents: tuple[dict[str, Any], ...]  # of these cases, in the units of a file
    names: tuple[str, ...]  # of the bearings
    document: dict[str, Any]  # the file as run
    warnings: tuple[str, ...] = ()

    @property
    def self_heated(self) -> bool:
        """Temperatures are wanted, and the shaft turns."""
        wanted = self.document["operation"]["temperature"] == SELF_HEATED
        return wanted and self.system.speed != 0.0


def load_shaft(name_or_path: str | Path) -> ShaftCase:
    """Read a shaft case: a case file, or a shipped case by its name.

    Parameters
    ----------
    name_or_path : str or Path
        The file, or the stem of a shipped case.

    Returns
    -------
    ShaftCase
        The case, SI.

    Raises
    ------
    CaseError
        If something is wrong, with one line for every error.
    """
    path = find_case(name_or_path)
    return shaft_from_text(read_text(path), str(path))


def shaft_from_text(text: str, name: str) -> ShaftCase:
    """The shaft case of the text of a file.

    Parameters
    ----------
    text : str
        Content of the file.
    name : str
        Its name in messages.

    Returns
    -------
    ShaftCase
        The case, SI.

    Raises
    ------
    CaseError
        If something is wrong, with one line for every error.
    """
    file = validate_text(text, name)
    if not isinstance(file, ShaftFile):
        raise CaseError(f"{name}: has no table [shaft]; run it with 'oilfilm run'")
    return shaft_case(file, name, text)


def any_case_of_document(
    document: dict[str, Any], name: str = "case"
) -> Case | ContactCase | ShaftCase:
    """The case of a parsed document of any kind.

    Parameters
    ----------
    document : dict
        Tables of a case.
    name : str, default 'case'
        Name of the document in messages.

    Returns
    -------
    Case or ContactCase or ShaftCase
        The case, SI.

    Raises
    ------
    CaseError
        If something is wrong, with its problems.
    """
    if "shaft" not in document:
        return case_of_document(document, name)
    file, faults = check_document(document)
    if faults or not isinstance(file, ShaftFile):
        raise CaseError((fault.text(name, {}) for fault in faults), faults)
    return shaft_case(file, name)


def shaft_case(file: ShaftFile, name: str, text: str = "") -> ShaftCase:
    """The case of a checked file.

    Parameters
    ----------
    file : ShaftFile
        The checked tables.
    name : str
        Name of the file in messages.
    text : str, default ""
        Content of the file, for lines in messages.

    Returns
    -------
    ShaftCase
        The case, SI.

    Raises
    ------
    CaseError
        If a bearing of the shaft is wrong.
    """
    document = file.model_dump(mode="json", exclude_none=True)
    cases = []
    documents = []
    for index, support in enumerate(document["support"]):
        own = bearing_document(document, support)
        try:
            case = case_of_document(own)
        except CaseError as error:
            problems = [
                _at_support(problem, index, support, document) for problem in error.problems
            ]
            lines = key_lines(text)
            raise CaseError([p.text(name, lines) for p in problems], problems) from None
        assert isinstance(case, Case)  # a bearing
        documents.append(own)
        cases.append(case)
    library = materials(file.materials, [table.material for table in file.shaft.section])
    try:
        system = shaft_system(file, tuple(cases), library)
    except InvalidKeyError as error:
        raise CaseError([error.fault.text(name, key_lines(text))], [error.fault]) from None
    return ShaftCase(
        title=file.title,
        source=file.source,
        assumed=file.assumed,
        system=system,
        cases=tuple(cases),
        documents=tuple(documents),
        names=tuple(support["bearing"] for support in document["support"]),
        document={key: value for key, value in document.items() if value != {}},
        # the other bearings press back on rows that are preloaded one way
        warnings=tuple(
            dict.fromkeys(
                note
                for case in cases
                for note in case.warnings
                if not note.startswith("rows.preload")
            )
        )
        + tuple(_doubts(system, tuple(cases))),
    )


def _doubts(system: ShaftSystem, cases: tuple[Case, ...]) -> Iterator[Caution]:
    """Bearings that do not fit their shaft, or whose direction of load is not given."""
    for number, (support, case) in enumerate(zip(system.supports, cases, strict=True), 1):
        table = case.file.bearing
        bore = from_si("outside_mm", case.bearing.bore) if case.bearing.bore else None
        near = [
            from_si("outside_mm", section.outside_diameter)
            for section in system.sections
            if section.start <= support.position <= section.end
        ]
        if bore and all(abs(outside - bore) > MISFIT * bore for outside in near):
            yield Caution(
                f"bearing {number} ({table.name}): its bore is {bore:g} mm, the shaft there "
                f"{near[0]:g} mm"
            )
        angle = table.free_contact_angle_deg or 0.0
        if angle >= ANGULAR and not case.rows:
            yield Caution(
                f"bearing {number} ({table.name}): loaded_by is not given; it is taken to hold "
                "the shaft both ways"
            )


def _at_support(
    problem: CaseProblem, index: int, support: dict[str, Any], document: dict[str, Any]
) -> CaseProblem:
    """A problem of a bearing's case at its place in the shaft's file."""
    name = support["bearing"]
    path = problem.path
    if path[:1] == ("bearing",):
        own = name in document.get("bearing", {})
        path = ("bearing", name, *path[1:]) if own else ("support", index, "bearing")
    elif path[:1] in (("rows",), ("operation",)):
        path = ("support", index)
    return CaseProblem(path, problem.finding, problem.allowed, nearest=problem.nearest)


def sections(
    tables: tuple[SectionTable, ...], library: dict[str, Material]
) -> tuple[Section, ...]:
    """Sections of a shaft.

    Parameters
    ----------
    tables : tuple of SectionTable
        The checked tables.
    library : dict
        Materials by name.

    Returns
    -------
    tuple of Section
        From left to right, SI.
    """
    start = 0.0
    found = []
    for table in tables:
        si = table.si()
        section = Section(
            start=start,
            end=si["to"],
            outside_diameter=si["outside"],
            inside_diameter=si["inside"],
            material=library[table.material],
        )
        found.append(section)
        start = section.end
    return tuple(found)


def housing_stiffness(table: HousingTable, seats: int) -> Array | None:
    """Stiffness of a housing at its seats in the order x, y, z, tilt y, tilt z of each.

    Parameters
    ----------
    table : HousingTable
        The checked table.
    seats : int
        Their number.

    Returns
    -------
    Array or None
        Shape (5 seats, 5 seats) [N/m], [N], [N m]; None where all is rigid.

    Raises
    ------
    InvalidKeyError
        If the file of the key `stiffness` holds no such matrix.
    """
    if table.stiffness is not None:
        return _matrix_of_file(table.stiffness, MILLIMETRES[table.stiffness_units], seats)
    si = table.si()
    values = (si["axial_stiffness"], si["radial_stiffness"], si["tilting_stiffness"])
    if all(value is None for value in values):
        return None
    axial, radial, tilting = (RIGID if value is None else value for value in values)
    spring = np.diag([axial, radial, radial, tilting, tilting])
    return np.asarray(np.kron(np.eye(seats), spring), dtype=np.float64)


def _matrix_of_file(file: str, unit: float, seats: int) -> Array:
    """Matrix of a file [N, `unit` m, rad] without the rotations about the axis, which nothing
    loads.
    """
    key = ("housing", "stiffness")
    needed = f"needed: a symmetric matrix of 6 rows and columns, or {6 * seats} for all seats"
    matrix = np.column_stack([column.values for column in case_table(key, file).columns])
    if matrix.shape not in ((6, 6), (6 * seats, 6 * seats)):
        finding = f"{file}: {matrix.shape[0]} rows of {matrix.shape[1]} numbers"
        raise InvalidKeyError(key, finding, needed)
    if matrix.shape[0] == 6:
        matrix = np.asarray(np.kron(np.eye(seats), matrix), dtype=np.float64)
    lengths = np.tile([1.0 / unit] * 3 + [1.0] * 3, seats)
    matrix = matrix * np.outer(lengths, lengths) * unit
    root = np.sqrt(np.abs(np.diag(matrix)))
    scaled = matrix / np.outer(root, root) if root.all() else np.full_like(matrix, np.nan)
    if not np.abs(scaled - scaled.T).max() <= ASYMMETRY:
        raise InvalidKeyError(key, f"{file}: not symmetric, or a zero diagonal", needed)
    if np.linalg.eigvalsh(scaled)[0] <= 0.0:
        finding = f"{file}: not positive definite: the housing gives way to a load without end"
        raise InvalidKeyError(key, finding, needed)
    flexible = np.linalg.inv(scaled) / np.outer(root, root)
    keep = np.flatnonzero(np.arange(root.size) % 6 != 3)
    found = np.linalg.inv(flexible[np.ix_(keep, keep)])
    return np.asarray(0.5 * (found + found.T))


def shaft_system(
    file: ShaftFile, cases: tuple[Case, ...], library: dict[str, Material]
) -> ShaftSystem:
    """Shaft, supports and loads of a checked file.

    Parameters
    ----------
    file : ShaftFile
        The checked tables.
    cases : tuple of Case
        Of the bearings.
    library : dict
        Materials by name.

    Returns
    -------
    ShaftSystem
        The system, SI.
    """
    pieces = sections(file.shaft.section, library)
    operation, housing = file.operation.si(), file.housing.si()
    supports = tuple(
        Support(
            position=table.si()["at"],
            bearing=case.bearing,
            rows=case.rows or SINGLE,
            temperature=case.operation.temperature,
            model=case.model,
            location=AxialLocation(table.fixed),
        )
        for table, case in zip(file.support, cases, strict=True)
    )
    system = ShaftSystem(
        sections=pieces,
        supports=supports,
        loads=tuple(one.build(PointLoad, position=one.si()["at"]) for one in file.load),
        springs=tuple(
            one.build(Spring, name=one.name or "spring", position=one.si()["at"])
            for one in file.spring
        ),
        speed=operation["inner_speed"],
        gravity=file.shaft.si()["gravity"],
        housing=housing_stiffness(file.housing, len(supports)),
        housing_expansion=housing["thermal_expansion"],
        housing_conductance=housing["conductance"],
    )
    warm, cool = (
        REFERENCE_TEMPERATURE if given is None else given
        for given in (operation["shaft_temperature"], housing["temperature"])
    )
    growth = system.axial_growth(warm, cool).tolist()
    grown = tuple(replace(s, growth=g) for s, g in zip(supports, growth, strict=True))
    return replace(system, supports=grown)
