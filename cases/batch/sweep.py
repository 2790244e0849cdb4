"""A sweep file: read, expanded into points, each checked as a case before anything runs."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path as FilePath
from typing import Any

from pydantic import ValidationError

from ..format.case import Case, ContactCase, case_of_document
from ..format.document import parse, read_text
from ..format.problems import CaseError, CaseFault, faults_error, schema_faults
from ..format.shipped import find_case, find_sweep
from ..format.sweep import SensitivityTable, SweepFile
from ..version import version
from .alternatives import replaced_keys, with_values
from .blocks import (
    MOST_POINTS,
    Variation,
    block_settings,
    case_path,
    differences,
    factorial,
    hypercube,
    hypercubes,
    listed,
)
from .faults import located_faults, overridden_names
from .keys import BESIDE_TRACTION_TABLES, DESCRIBING, digest, document_text
from .plotted import plot_problems
from .points import Point, Sweep
from .tables import (
    bodies_and_oil,
    foreign_points,
    needs_tables,
    with_equilibrium,
    with_table_names,
)

FORMAT = 2  # of what a point leaves on disk
MOST_FAULTS = 1000  # from which on no further point is checked


@dataclass(frozen=True, slots=True)
class _Source:
    """Text and name of a sweep file, the folder where its files are sought first."""

    text: str
    name: str
    folder: FilePath

    def error(self, faults: Iterable[CaseFault]) -> CaseError:
        """The faults with their lines."""
        return faults_error(faults, self.name, self.text)


def read_sweep(name_or_path: str | FilePath) -> Sweep:
    """Read a sweep file, or a shipped one by its name, and check each of its points as a case.

    `CaseError` with one line for every error.
    """
    path = find_sweep(name_or_path)
    return sweep_from_text(read_text(path), str(path), path.parent)


def _document(text: str, name: str) -> dict[str, Any]:
    """The tables of a sweep file; `CaseError` if they are those of a case."""
    document = parse(text, name)
    if "case" not in document:
        for table, command in (("bearing", "run"), ("contact", "contact")):
            if table in document:
                raise CaseError(f"{name}:1: a case, not a sweep; run it with 'oilfilm {command}'")
    return document


def sweep_from_text(text: str, name: str, folder: FilePath | None = None) -> Sweep:
    """The sweep that the text of a file describes; its case is sought in `folder` first."""
    source = _Source(text, name, folder or FilePath())
    try:
        file = SweepFile.model_validate(_document(text, name))
    except ValidationError as error:
        schema = SweepFile.model_json_schema()
        raise source.error(schema_faults(error.errors(include_url=False), schema)) from None
    case_file = _case_file(file.case, source)
    fixed = Variation("fixed", tuple(block_settings(file.fixed, ("fixed",))))
    case = parse(read_text(case_file), str(case_file))
    base = with_values(case, fixed)
    variations, notes, problems = _variations(file, base)
    notes += [*replaced_keys(case, [fixed]), *replaced_keys(base, variations)]
    problems += plot_problems(file.plot, "contact" if "contact" in base else file.compute)
    if problems:
        raise source.error(problems)
    keys = tuple(dict.fromkeys(s.key for variation in variations for s in variation.settings))
    points, examples = _points(file, base, variations, fixed, keys, source)
    table = _table_file(file, points, examples, source)
    given = None if table is None else digest(table.read_bytes())
    return Sweep(
        text=text,
        title=file.title or _title(str(base.get("title") or file.case), keys),
        case=file.case,
        compute=file.compute,
        fields=file.fields,
        keys=keys,
        points=with_table_names(points, given, file.table_points),
        messages=tuple(notes),
        assumed=tuple(key for key in base.get("assumed", ()) if isinstance(key, str)),
        table=table,
        table_points=file.table_points,
        plot=file.plot,
    )


def _table_file(
    file: SweepFile, points: list[Point], examples: dict[str, Case], source: _Source
) -> FilePath | None:
    """The traction tables that the sweep file names, which must be those of its points."""
    if file.table is None:
        return None
    path = source.folder / file.table
    try:
        unreadable = None if path.is_file() else f"{file.table}: there is no such file"
    except (OSError, ValueError) as error:
        unreadable = f"{file.table!r}: {error}"
    if not examples:
        law = 'no law in friction.traction, or dynamics.friction = "table"'
        allowed = f'allowed: with compute = "torque" and {law}'
        faults = [CaseFault(("table",), "no point needs traction tables", allowed)]
    elif unreadable is not None:
        allowed = "allowed: a file that `oilfilm table` wrote"
        faults = [CaseFault(("table",), unreadable, allowed)]
    else:
        faults = [_foreign(*wrong) for wrong in foreign_points(path, points, examples).items()]
    if faults:
        raise source.error(faults)
    return path


def _foreign(reason: str, numbers: list[int]) -> CaseFault:
    """Tables of other bodies or another oil than some points have."""
    others = f" and {len(numbers) - 1} others" if len(numbers) > 1 else ""
    allowed = (
        "allowed: tables that `oilfilm table` made of the same bearing and oil, or table left out"
    )
    return CaseFault(("table",), f"{reason}: point {numbers[0]}{others}", allowed)


def _title(case: str, keys: tuple[str, ...]) -> str:
    """The title of the case and what is varied of it."""
    names = [key.rpartition(".")[2] for key in keys]
    return f"{case}; varied: {', '.join(names[:4])}{' ...' if len(names) > 4 else ''}"


def _case_file(case: str, source: _Source) -> FilePath:
    """The case beside the sweep file if there is one, else as every command finds it."""
    try:
        for name in (case, f"{case}.toml"):
            beside = source.folder / name
            if beside.is_file():
                return beside
        return find_case(case)
    except (CaseError, OSError, ValueError) as error:
        raise source.error([CaseFault(("case",), str(error).partition("\n")[0])]) from None


def _variations(
    file: SweepFile, base: dict[str, Any]
) -> tuple[list[Variation], list[str], list[CaseFault]]:
    """The variations of all blocks, in the order of the format's description."""
    combinations, count, problems = factorial(file)
    notes: list[str] = []
    cubes, faults = hypercubes(file)
    problems += faults
    count += sum(options.samples for _, options, _ in cubes) + len(file.combinations)
    if count > MOST_POINTS:
        allowed = f"allowed: at most {MOST_POINTS}"
        problems.append(CaseFault((), f"{count} points", allowed, line=1))
    if problems:
        return [], [], problems
    variations: list[Variation] = [*combinations, *listed(file)]
    for table, options, where in cubes:
        sampled, faults = hypercube(table, options, where)
        variations += sampled
        problems += faults
    if file.sensitivity is not None:
        changed, notes, faults = _sensitivity(file.sensitivity, base)
        variations += changed
        problems += faults
    if not variations and not problems:
        allowed = "needed: [sweep], [[combinations]], [latin_hypercube] or [sensitivity] with keys"
        problems.append(CaseFault((), "no points", allowed, line=1))
    return variations, notes, problems


def _sensitivity(
    table: SensitivityTable, base: dict[str, Any]
) -> tuple[list[Variation], list[str], list[CaseFault]]:
    try:
        case = case_of_document(base)
    except CaseError as error:
        finding = "the case itself cannot be run"
        return [], [], [CaseFault(("sensitivity",), finding, _faults(error)[0].finding)]
    keys = case.assumed if table.keys == "assumed" else tuple(table.keys)
    return differences(table, keys, {key: _value(case.document, key) for key in keys})


def _faults(error: CaseError) -> list[CaseFault]:
    """Faults of a case; of a bound of the physics only its message is known."""
    return [*error.problems] or [CaseFault((), message, line=1) for message in error.messages]


def _value(document: dict[str, Any], key: str) -> Any:
    node: Any = document
    for part in case_path(key):
        node = node.get(part) if isinstance(node, dict) else None
    return node


def _points(
    file: SweepFile,
    base: dict[str, Any],
    variations: list[Variation],
    fixed: Variation,
    keys: tuple[str, ...],
    source: _Source,
) -> tuple[list[Point], dict[str, Case]]:
    """Every variation as a checked point, with what those that share traction tables must have in
    common in place of the name of these, and a case for each of that.

    `CaseError` with the problems of all of them, each reported once.
    """
    points: list[Point] = []
    problems = list(overridden_names(base, variations))
    examples: dict[str, Case] = {}
    for number, variation in enumerate(variations, 1):
        document = with_values(base, variation)
        if file.compute == "torque":
            document = with_equilibrium(document)
        try:
            case = case_of_document(document, f"point {number}")
        except CaseError as error:
            problems += located_faults(_faults(error), variation, fixed, number)
            if len(problems) > MOST_FAULTS:
                break
            continue
        if problems:
            continue
        common = None
        if isinstance(case, Case) and needs_tables(case, file.compute):
            common = bodies_and_oil(case)
            examples.setdefault(common, case)
        points.append(
            Point(
                number=number,
                block=variation.block,
                values={key: _value(case.document, key) for key in keys},
                document=document,
                resolved=case.document,
                key=point_key(case.document, file),
                tables=common,
            )
        )
        problems += _kind(file, case, number)
    if problems:
        raise source.error(problems)
    return points, examples


def _kind(file: SweepFile, case: Case | ContactCase, number: int) -> Iterator[CaseFault]:
    """Whether what is to be computed can be computed of this case."""
    wrong = None
    if not isinstance(case, Case):
        wrong = "the case is a single contact" if file.compute != "run" else None
    elif file.compute in ("slip", "dynamics") and getattr(case.file, file.compute) is None:
        wrong = f"the case has no table [{file.compute}]"
    elif file.compute in ("torque", "table") and len(case.rows or ()) > 1:
        wrong = "the case has several rows of balls"
    if wrong is not None:
        yield CaseFault(("compute",), f"point {number}: {wrong}", 'allowed: "run"')


def point_key(resolved: dict[str, Any], file: SweepFile) -> str:
    """Name of a point: a hash of all its results depend on, the program's version included."""
    without = BESIDE_TRACTION_TABLES if file.compute == "table" else DESCRIBING
    content = {key: value for key, value in resolved.items() if key not in without}
    whole: dict[str, Any] = {"case": content, "compute": file.compute, "fields": file.fields}
    whole |= {"oilfilm": version(), "format": FORMAT}
    if file.compute == "table":
        whole["table_points"] = file.table_points
    return digest(document_text(whole))
