"""A sweep file: read, expanded into points, each checked as a case before anything runs."""

import hashlib
import json
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path as FilePath
from typing import Any

from pydantic import ValidationError

from ..format.case import Case, ContactCase, case_of_file
from ..format.document import check_document, parse, read_text
from ..format.problems import CaseError, CaseFault, schema_faults
from ..format.shipped import find_case, find_sweep
from ..format.sweep import SweepFile
from ..format.toml_lines import Path, key_lines
from ..version import version
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
from .plotted import plot_problems
from .points import Point, Sweep
from .tables import (
    bodies_and_oil,
    file_hash,
    foreign_points,
    needs_tables,
    with_equilibrium,
    with_tables,
)

FORMAT = 1  # of what a point leaves on disk
UNIMPORTANT = ("title", "source", "assumed")  # for what is computed
# likewise, for traction tables
TABLES_IGNORE = ("surface", "slip", "friction", "cage", "dynamics", "ehl")


def read_sweep(name_or_path: str | FilePath) -> Sweep:
    """Read a sweep file and check each of its points as a case.

    Parameters
    ----------
    name_or_path : str or Path
        A sweep file, or the name (stem) of a shipped one.

    Raises
    ------
    CaseError
        With one line for every error.
    """
    path = find_sweep(name_or_path)
    return sweep_from_text(read_text(path), str(path), path.parent)


def sweep_from_text(text: str, name: str, folder: FilePath | None = None) -> Sweep:
    """The sweep that the text of a file describes; its case is sought in `folder` first."""
    document = parse(text, name)
    lines = key_lines(text)
    try:
        file = SweepFile.model_validate(document)
    except ValidationError as error:
        raise _error(
            name, lines, schema_faults(error.errors(include_url=False), _schema())
        ) from None
    case_file = _case_file(file.case, folder, name, lines)
    fixed = Variation("fixed", tuple(block_settings(file.fixed, ("fixed",))))
    base = with_values(parse(read_text(case_file), str(case_file)), fixed)
    variations, notes, problems = _variations(file, base)
    problems += plot_problems(file.plot, "contact" if "contact" in base else file.compute)
    if problems:
        raise _error(name, lines, problems)
    keys = tuple(
        dict.fromkeys(setting.key for variation in variations for setting in variation.settings)
    )
    points, common, examples = _points(file, base, variations, fixed, keys, (name, lines))
    points, table = _with_tables(file, folder, (points, common, examples), (name, lines))
    return Sweep(
        name=name,
        text=text,
        title=file.title or _title(str(base.get("title") or file.case), keys),
        case=file.case,
        compute=file.compute,
        fields=file.fields,
        keys=keys,
        points=points,
        messages=tuple(notes),
        assumed=tuple(key for key in base.get("assumed", ()) if isinstance(key, str)),
        table=table,
        table_points=file.table_points,
        plot=file.plot,
    )


def _with_tables(
    file: SweepFile,
    folder: FilePath | None,
    checked: tuple[tuple[Point, ...], dict[int, str], dict[str, Case]],
    place: tuple[str, dict[Path, int]],
) -> tuple[tuple[Point, ...], FilePath | None]:
    """The points with the names of their traction tables, and the file that the sweep names."""
    points, common, examples = checked
    table = _table_file(file, folder, bool(common), place)
    if table is not None:
        wrong = foreign_points(table, common, examples)
        if wrong:
            raise _error(*place, [_foreign(reason, numbers) for reason, numbers in wrong.items()])
    digest = None if table is None else file_hash(table)
    return with_tables(points, common, digest, file.table_points), table


def _table_file(
    file: SweepFile, folder: FilePath | None, needed: bool, place: tuple[str, dict[Path, int]]
) -> FilePath | None:
    """The traction tables that the sweep file names, if its points need any."""
    if file.table is None:
        return None
    reason = None
    if not needed:
        reason = "no point needs traction tables"
        allowed = (
            'allowed: with compute = "torque" and no law in friction.traction, or '
            'dynamics.friction = "table"'
        )
    path = (folder or FilePath()) / file.table
    try:
        if reason is None and not path.is_file():
            reason = f"{file.table}: there is no such file"
            allowed = "allowed: a file that `oilfilm table` wrote"
    except (OSError, ValueError) as error:
        reason = f"{file.table!r}: {error}"
        allowed = "allowed: a file that `oilfilm table` wrote"
    if reason is not None:
        raise _error(*place, [CaseFault(path=("table",), found=reason, allowed=allowed)])
    return path


def _foreign(reason: str, numbers: Sequence[int]) -> CaseFault:
    """Tables of other bodies or another oil than some points have."""
    others = f" and {len(numbers) - 1} others" if len(numbers) > 1 else ""
    allowed = (
        "allowed: tables that `oilfilm table` made of the same bearing and oil, or table left out"
    )
    return CaseFault(
        path=("table",), found=f"{reason}: point {numbers[0]}{others}", allowed=allowed
    )


def _title(case: str, keys: tuple[str, ...]) -> str:
    """The title of the case and what is varied of it."""
    names = [key.rpartition(".")[2] for key in keys]
    return f"{case}; varied: {', '.join(names[:4])}{' ...' if len(names) > 4 else ''}"


def _schema() -> dict[str, Any]:
    return SweepFile.model_json_schema()


def _error(name: str, lines: dict[Path, int], problems: Iterable[CaseFault]) -> CaseError:
    ordered = sorted(problems, key=lambda problem: problem.line_in(lines))
    return CaseError(dict.fromkeys(problem.text(name, lines) for problem in ordered))


def _case_file(case: str, folder: FilePath | None, name: str, lines: dict[Path, int]) -> FilePath:
    """The case beside the sweep file if there is one, else as every command finds it."""
    beside = None if folder is None else folder / case
    try:
        if beside is not None and beside.is_file():
            return beside
        return find_case(case)
    except (CaseError, OSError, ValueError) as error:
        problem = CaseFault(path=("case",), found=str(error).partition("\n")[0])
        raise _error(name, lines, [problem]) from None


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
        problems.append(
            CaseFault(
                path=(), line=1, found=f"{count} points", allowed=f"allowed: at most {MOST_POINTS}"
            )
        )
    if problems:
        return [], [], problems
    variations: list[Variation] = [*combinations, *listed(file)]
    for table, options, where in cubes:
        sampled, faults = hypercube(table, options, where)
        variations += sampled
        problems += faults
    if file.sensitivity is not None:
        changed, notes, faults = _sensitivity(file, base)
        variations += changed
        problems += faults
    if not variations and not problems:
        allowed = "needed: [sweep], [[combinations]], [latin_hypercube] or [sensitivity] with keys"
        problems.append(CaseFault(path=(), line=1, found="no points", allowed=allowed))
    return variations, notes, problems


def _sensitivity(
    file: SweepFile, base: dict[str, Any]
) -> tuple[list[Variation], list[str], list[CaseFault]]:
    assert file.sensitivity is not None  # checked before
    case, problems = _checked(base, "case")
    if case is None:
        return (
            [],
            [],
            [
                CaseFault(
                    path=("sensitivity",),
                    found="the case itself cannot be run",
                    allowed=problems[0].found,
                )
            ],
        )
    names = file.sensitivity.keys
    keys = case.assumed if names == "assumed" else tuple(names)
    return differences(file.sensitivity, keys, {key: _value(case.document, key) for key in keys})


def _value(document: dict[str, Any], key: str) -> Any:
    node: Any = document
    for part in case_path(key):
        node = node.get(part) if isinstance(node, dict) else None
    return node


def _checked(
    document: dict[str, Any], name: str
) -> tuple[Case | ContactCase | None, list[CaseFault]]:
    """A document as a case, or what is wrong with it."""
    file, problems = check_document(document)
    if file is None or problems:
        return None, problems
    try:
        return case_of_file(file, name), []
    except CaseError as error:
        return None, [*error.problems] or [
            CaseFault(path=(), line=1, found=message) for message in error.messages
        ]


def with_values(base: dict[str, Any], variation: Variation) -> dict[str, Any]:
    """The case's document with the values of a variation."""
    document = {
        key: dict(value) if isinstance(value, dict) else value for key, value in base.items()
    }
    for setting in variation.settings:
        node = document
        *tables, key = case_path(setting.key)
        for table in tables:
            inner = node.get(table)
            node[table] = dict(inner) if isinstance(inner, dict) else {}
            node = node[table]
        node[key] = setting.value
    return document


def _points(
    file: SweepFile,
    base: dict[str, Any],
    variations: list[Variation],
    fixed: Variation,
    keys: tuple[str, ...],
    place: tuple[str, dict[Path, int]],
) -> tuple[tuple[Point, ...], dict[int, str], dict[str, Case]]:
    """Every variation as a checked point, by their numbers what those that need tables must have
    in common, and a case of each kind of these.

    `CaseError` with the problems of all of them, each reported once.
    """
    points = []
    common = dict[int, str]()
    problems = list(overridden_names(base, variations))
    examples: dict[str, Case] = {}
    for number, variation in enumerate(variations, 1):
        document = with_values(base, variation)
        if file.compute == "torque":
            document = with_equilibrium(document)
        case, faults = _checked(document, f"point {number}")
        if case is None:
            problems += located_faults(faults, variation, fixed, number)
        elif not problems:
            points.append(
                Point(
                    number=number,
                    block=variation.block,
                    values={key: _value(case.document, key) for key in keys},
                    document=document,
                    resolved=case.document,
                    key=point_key(case.document, file),
                )
            )
            problems += _kind(file, case, number)
            if isinstance(case, Case) and needs_tables(case, file.compute):
                common[number] = bodies_and_oil(case)
                examples.setdefault(common[number], case)
        if len(problems) > 1000:
            break
    if problems:
        raise _error(*place, problems)
    return tuple(points), common, examples


def _kind(file: SweepFile, case: Case | ContactCase, number: int) -> Iterator[CaseFault]:
    """Whether what is to be computed can be computed of this case."""
    wrong = None
    if file.compute != "run" and not isinstance(case, Case):
        wrong = "the case is a single contact"
    elif isinstance(case, Case) and file.compute in ("slip", "dynamics"):
        wrong = (
            None
            if getattr(case.file, file.compute) is not None
            else f"the case has no table [{file.compute}]"
        )
    elif (
        isinstance(case, Case) and file.compute in ("torque", "table") and len(case.rows or ()) > 1
    ):
        wrong = "the case has several rows of balls"
    if wrong is not None:
        yield CaseFault(
            path=("compute",), found=f"point {number}: {wrong}", allowed='allowed: "run"'
        )


def point_key(resolved: dict[str, Any], file: SweepFile) -> str:
    """Name of a point: a hash of all its results depend on, the program's version included."""
    unimportant = (*UNIMPORTANT, *TABLES_IGNORE) if file.compute == "table" else UNIMPORTANT
    content = {key: value for key, value in resolved.items() if key not in unimportant}
    whole: dict[str, Any] = {"case": content, "compute": file.compute, "fields": file.fields}
    whole |= {"oilfilm": version(), "format": FORMAT}
    if file.compute == "table":
        whole["table_points"] = file.table_points
    text = json.dumps(whole, sort_keys=True, ensure_ascii=False, default=str)
    return hashlib.sha256(text.encode()).hexdigest()[:20]
