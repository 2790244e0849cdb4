"""A sweep file: read, expanded into points, checked as cases before anything runs.

Shards are parts of a batch that are computed by programs which do not know of each other.
"""

import random
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

from oilfilm.ehl.foreign_files import read_file
from oilfilm.postprocess.batch.results import Design, point_kind

from ..format.case import Case, ContactCase
from ..format.document import parse, read_text
from ..format.fields import validated
from ..format.rules import CaseError, CaseProblem, faults_error
from ..format.shaft_case import ShaftCase, any_case_of_document
from ..format.shipped import find_case, find_sweep
from .keys import WITHOUT_CONTACTS, digest, value_in
from .plan import (
    MOST_POINTS,
    Document,
    Factorial,
    Plan,
    PointDocuments,
    PointName,
    Sampled,
    Variation,
    block_settings,
    differences,
    factorial,
    listed,
    located_faults,
    overridden_names,
    plot_problems,
    replaced_keys,
    with_values,
)
from .points import Point, Sweep
from .samples import sampled_blocks
from .shared_tables import (
    bodies_and_oil,
    foreign_points,
    needs_tables,
    with_equilibrium,
    with_table_names,
)
from .sweep_file import SensitivityTable, SweepFile

MOST_FAULTS = 1000  # from which on no further point is checked
CHECKED = 1000  # points of a sweep up to which all are checked before anything runs
SAMPLE = 200  # of a larger one that are, beside its ends
SEED = 70_241_903  # of their choice
MOST_CHECKED = 100_000  # points of kinds that are checked one by one, 2 ms each
EVERY_POINT = ("torque", "dynamics")  # kinds whose tables depend on all points: all are checked

AnyCase = Case | ContactCase | ShaftCase
Checked = dict[int, tuple[str | None, AnyCase]]
MOST_SHARDS = 100_000
DIGITS = 8  # of a point's name that tell its shard


@dataclass(frozen=True, slots=True)
class _Source:
    """Text and name of a sweep file, the folder where its files are sought first."""

    text: str
    name: str
    folder: Path

    def error(self, faults: Iterable[CaseProblem]) -> CaseError:
        """The faults with their lines."""
        return faults_error(faults, self.name, self.text)


def read_sweep(name_or_path: str | Path) -> Sweep:
    """Read a sweep file, or a shipped one by its name, and check each of its points as a case.

    Parameters
    ----------
    name_or_path : str | Path
        The file or its name.

    Returns
    -------
    Sweep
        The sweep, ready to run.

    Raises
    ------
    CaseError
        If something is wrong, with one line for every error.

    Examples
    --------
    >>> import oilfilm
    >>> sweep = oilfilm.read_sweep("6208_load_and_speed")
    >>> len(sweep.points), sweep.keys
    (16, ('operation.inner_speed_rpm', 'operation.radial_load_N'))
    """
    path = find_sweep(name_or_path)
    return sweep_from_text(read_text(path), str(path), path.parent)


def _sweep_tables(text: str, name: str) -> dict[str, Any]:
    """The tables of a sweep file; `CaseError` if they are those of a case."""
    document = parse(text, name)
    if "case" not in document:
        for table, command in (("bearing", "run"), ("contact", "contact"), ("shaft", "shaft")):
            if table in document:
                raise CaseError(f"{name}:1: a case, not a sweep; run it with 'oilfilm {command}'")
    return document


def sweep_from_text(text: str, name: str, folder: Path | None = None) -> Sweep:
    """The sweep that the text of a file describes.

    Parameters
    ----------
    text : str
        Content of the file.
    name : str
        Name of the file in messages.
    folder : Path | None, optional
        Folder in which the case is looked for first.

    Returns
    -------
    Sweep
        The sweep, ready to run.

    Raises
    ------
    CaseError
        If something is wrong, with one line for every error.
    """
    source = _Source(text, name, folder or Path())
    file = _file(source)
    case_file = _case_file(file.case, source)
    fixed = Variation("fixed", tuple(block_settings(file.fixed, ("fixed",))))
    case = parse(read_text(case_file), str(case_file))
    base = with_values(case, fixed)
    blocks, designs, notes, problems = _blocks(file, base)
    examples = [variation for block in blocks for variation in _of_each_kind(block)]
    notes += [*replaced_keys(case, [fixed]), *replaced_keys(base, examples)]
    problems += plot_problems(file.plot, point_kind(base, file.compute))
    if problems:
        raise source.error(problems)
    keys = tuple(dict.fromkeys(s.key for variation in examples for s in variation.settings))
    document = partial(_document, PointDocuments(base), torque=file.compute == "torque")
    plan = Plan(blocks, document, PointName(file, base).name_of, keys)
    checked = _checked(plan, file, base, fixed, source)
    sharing = {number: common for number, (common, _) in checked.items() if common is not None}
    points: Sequence[Point] = plan
    table = None
    if sharing or file.table is not None:
        several = [plan[number] for number in sorted(checked)]
        table, points = _with_tables(file, several, checked, source)
    return Sweep(
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
        designs=tuple(designs),
        film_models=tuple(sorted({_film_model(case) for _, case in checked.values()})),
        share_contacts=_may_share_contacts(blocks, keys),
    )


def _file(source: _Source) -> SweepFile:
    """The content of a sweep file, checked against its format."""
    tables = _sweep_tables(source.text, source.name)
    file, faults = validated(SweepFile, tables)
    if file is None:
        raise source.error(faults)
    return file


def _document(documents: PointDocuments, variation: Variation, *, torque: bool) -> Document:
    """A point as a case; one of torque in traction equilibrium."""
    document = documents.document(variation)
    return with_equilibrium(document) if torque else document


def _may_share_contacts(blocks: Sequence[Sequence[Variation]], keys: tuple[str, ...]) -> bool:
    """Tell whether contacts may be equal in several points: where values repeat, as those of all
    balls without load at one speed, or keys vary that leave the contacts unchanged.
    """
    repeated = any(len(block) > 1 and not isinstance(block, Sampled) for block in blocks)
    return repeated or any(key.partition(".")[0] in WITHOUT_CONTACTS for key in keys)


def _film_model(case: AnyCase) -> str:
    return str(case.document.get("ehl", {}).get("film_model"))


def _of_each_kind(block: Sequence[Variation]) -> Sequence[Variation]:
    """Variations of a block that name all its keys: one where all have the same."""
    return block[:1] if isinstance(block, Factorial | Sampled) else block


def _with_tables(
    file: SweepFile, points: list[Point], checked: Checked, source: _Source
) -> tuple[Path | None, tuple[Point, ...]]:
    """The file of traction tables that is given, and all points with the names of theirs."""
    examples: dict[str, Case] = {}
    for common, case in checked.values():
        if common is not None and isinstance(case, Case):
            examples.setdefault(common, case)
    sharing = [checked[point.number - 1][0] for point in points]
    documents = [checked[point.number - 1][1].document for point in points]
    named = {p.number: name for p, name in zip(points, sharing, strict=True) if name is not None}
    table = _table_file(file, named, examples, source)
    given = None if table is None else digest(read_file(table))
    return table, with_table_names(points, sharing, documents, given, file.table_points)


def _table_file(
    file: SweepFile, common: dict[int, str], examples: dict[str, Case], source: _Source
) -> Path | None:
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
        faults = [CaseProblem(("table",), "no point needs traction tables", allowed)]
    elif unreadable is not None:
        allowed = "allowed: a file that `oilfilm table` wrote"
        faults = [CaseProblem(("table",), unreadable, allowed)]
    else:
        faults = [_foreign(*wrong) for wrong in foreign_points(path, common, examples).items()]
    if faults:
        raise source.error(faults)
    return path


def _foreign(reason: str, numbers: list[int]) -> CaseProblem:
    """Tables of other bodies or another oil than some points have."""
    others = f" and {len(numbers) - 1} others" if len(numbers) > 1 else ""
    allowed = (
        "allowed: tables that `oilfilm table` made of the same bearing and oil, or table left out"
    )
    return CaseProblem(("table",), f"{reason}: point {numbers[0]}{others}", allowed)


def _title(case: str, keys: tuple[str, ...]) -> str:
    """The title of the case and what is varied of it."""
    names = [key.rpartition(".")[2] for key in keys]
    return f"{case}; varied: {', '.join(names[:4])}{' ...' if len(names) > 4 else ''}"


def _case_file(case: str, source: _Source) -> Path:
    """The case beside the sweep file if there is one, else as every command finds it."""
    try:
        return find_case(case, source.folder)
    except (CaseError, OSError, ValueError) as error:
        raise source.error([CaseProblem(("case",), str(error).partition("\n")[0])]) from None


class _Blocks(NamedTuple):
    """The variations of all blocks, those that are designs, notes, faults."""

    variations: list[Sequence[Variation]]
    designs: list[Design]
    notes: list[str]
    problems: list[CaseProblem]


def _blocks(file: SweepFile, base: Document) -> _Blocks:
    """The variations of all blocks, in the order of the format's description."""
    combinations, problems = factorial(file)
    notes: list[str] = []
    sampled, faults = sampled_blocks(file)
    problems += faults
    count = len(combinations) + len(file.combinations) + sum(len(one) for one, _ in sampled)
    most = MOST_CHECKED if file.compute in EVERY_POINT else MOST_POINTS
    if count > most:
        allowed = f"allowed: at most {most}"
        problems.append(CaseProblem((), f"{count} points", allowed, line=1))
    if problems:
        return _Blocks([], [], [], problems)
    blocks: list[Sequence[Variation]] = [combinations, listed(file)]
    designs = []
    for block, design in sampled:
        designs.append(replace(design, start=sum(map(len, blocks))))
        blocks.append(block)
    if file.sensitivity is not None:
        changed, notes, faults = _sensitivity(file.sensitivity, base)
        blocks.append(changed)
        problems += faults
    if not any(map(len, blocks)) and not problems:
        allowed = "needed: [sweep], [[combinations]], [latin_hypercube] or [sensitivity] with keys"
        problems.append(CaseProblem((), "no points", allowed, line=1))
    return _Blocks(blocks, designs, notes, problems)


def _sensitivity(
    table: SensitivityTable, base: Document
) -> tuple[list[Variation], list[str], list[CaseProblem]]:
    try:
        case = any_case_of_document(base)
    except CaseError as error:
        finding = "the case itself cannot be run"
        return [], [], [CaseProblem(("sensitivity",), finding, _faults(error)[0].finding)]
    keys = case.assumed if table.keys == "assumed" else tuple(table.keys)
    return differences(table, keys, {key: value_in(case.document, key) for key in keys})


def _faults(error: CaseError) -> list[CaseProblem]:
    """Faults of a case; of a bound of the physics only its message is known."""
    return [*error.problems] or [CaseProblem((), message, line=1) for message in error.messages]


def _checked(
    plan: Plan, file: SweepFile, base: Document, fixed: Variation, source: _Source
) -> Checked:
    """Points checked as cases, by their places: with what those that share traction tables must
    have in common.

    All of a sweep of up to `CHECKED` points, or whose points need tables; of a larger one the
    ends and a sample, the others when they are computed. `CaseError` with the problems of all of
    them, each reported once.
    """
    ends = [plan.variation(0), plan.variation(len(plan) - 1)]
    problems = list(overridden_names(base, ends))
    checked: Checked = {}
    for index in _checked_indices(plan, file.compute):
        variation = plan.variation(index)
        try:
            case = any_case_of_document(plan.document(variation), f"point {index + 1}")
        except CaseError as error:
            problems += located_faults(_faults(error), variation, fixed, index + 1)
            if len(problems) > MOST_FAULTS:
                break
            continue
        if problems:
            continue
        shares = isinstance(case, Case) and needs_tables(case, file.compute)
        common = bodies_and_oil(case) if shares and isinstance(case, Case) else None
        checked[index] = (common, case)
        problems += _kind(file, case, index + 1)
    if problems:
        raise source.error(problems)
    return checked


def _checked_indices(plan: Plan, compute: str) -> Sequence[int]:
    """Places of the points that are checked at once: of a large sweep first of all those where a
    key of a factorial block takes each end of its list, then a sample.
    """
    whole = range(len(plan))
    if len(plan) <= CHECKED or compute in EVERY_POINT:
        return whole
    chosen = {0, len(plan) - 1, *random.Random(SEED).sample(whole, min(SAMPLE, CHECKED))}
    start = 0
    for block, end in zip(plan.blocks, plan.ends, strict=True):
        if isinstance(block, Factorial):
            chosen |= {start + index for index in block.edges()}
        elif not isinstance(block, Sampled):
            chosen |= set(range(start, min(end, start + CHECKED)))
        start = end
    return sorted(chosen)


def _kind(file: SweepFile, case: AnyCase, number: int) -> Iterator[CaseProblem]:
    """A problem where the quantity cannot be computed of this case."""
    wrong = None
    if not isinstance(case, Case):
        what = "a shaft" if isinstance(case, ShaftCase) else "a single contact"
        wrong = f"the case is {what}" if file.compute != "run" else None
    elif file.compute in ("slip", "dynamics") and getattr(case.file, file.compute) is None:
        wrong = f"the case has no table [{file.compute}]"
    elif file.compute in ("torque", "table") and len(case.rows or ()) > 1:
        wrong = "the case has several rows of balls"
    if wrong is not None:
        yield CaseProblem(("compute",), f"point {number}: {wrong}", 'allowed: "run"')


@dataclass(frozen=True, slots=True)
class Shard:
    """The share `number` of `count` of the points, by their names; counted from 1."""

    number: int
    count: int

    @property
    def file(self) -> str:
        """File of its finished points."""
        return "points.sqlite" if self.count == 1 else f"points-{self}.sqlite"

    def has(self, key: str) -> bool:
        """Tell whether a point belongs to the shard.

        Parameters
        ----------
        key : str
            Name of the point.

        Returns
        -------
        bool
            True if it does.
        """
        return int(key[:DIGITS], 16) % self.count == self.number - 1

    def __str__(self) -> str:
        return f"{self.number}-of-{self.count}"


SINGLE_WRITER = Shard(1, 1)


def shard_of(text: str) -> Shard:
    """The shard that `I/N` names.

    Parameters
    ----------
    text : str
        The option as given.

    Returns
    -------
    Shard
        The shard.

    Raises
    ------
    CaseError
        If it names none.
    """
    match = re.fullmatch(r"(\d+)/(\d+)", text.strip())
    if match:
        number, count = map(int, match.groups())
        if 1 <= number <= count <= MOST_SHARDS:
            return Shard(number, count)
    allowed = "allowed: I/N with I from 1 to N, as 3/8"
    raise CaseError(f"--shard {text}: names no share of the points; {allowed}")
