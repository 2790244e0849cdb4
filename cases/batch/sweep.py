"""A sweep file: read, expanded into points, checked as cases before anything runs.

Shards are parts of a batch that are computed by programs which do not know of each other.
"""

import random
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from oilfilm.ehl.foreign_files import read_file
from oilfilm.ehl.units import unit_of
from oilfilm.postprocess.batch.results import point_kind, result_names

from ..format.case import Case, ContactCase
from ..format.document import read_text
from ..format.rules import CaseError, CaseProblem, nearest_name, shown
from ..format.shaft_case import ShaftCase, any_case_of_document
from ..format.shipped import find_sweep
from .expansion import (
    Source,
    assumed_keys,
    expanded,
    may_share_tables,
    of_each_kind,
    point_documents,
    sweep_title,
    varied_keys,
    wants_tables,
)
from .keys import WITHOUT_CONTACTS, digest, value_in
from .plan import (
    Document,
    Factorial,
    PointName,
    Sampled,
    Variation,
    differences,
    located_faults,
    overridden_names,
    replaced_keys,
)
from .points import Plan, Point, Sweep
from .shared_tables import bodies_and_oil, foreign_points, needs_tables, with_table_names
from .sweep_file import SensitivityTable, SweepFile

MOST_FAULTS = 1000  # from which on no further point is checked
CHECKED = 1000  # points of a sweep up to which all are checked before anything runs
SAMPLE = 200  # of a larger one that are, beside its ends
SEED = 70_241_903  # of their choice
MOST_PANELS = 3  # of a figure

AnyCase = Case | ContactCase | ShaftCase
Checked = dict[int, tuple[str | None, AnyCase]]
MOST_SHARDS = 100_000
DIGITS = 8  # of a point's name that tell its shard


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
    source = Source(text, name, folder or Path())
    file, case, fixed, base, blocks, designs, problems = expanded(source)
    notes: list[str] = []
    if file.sensitivity is not None and not problems:
        changed, notes, problems = _sensitivity(file.sensitivity, base)
        blocks.append(changed)
    examples = [variation for block in blocks for variation in of_each_kind(block)]
    notes += [*replaced_keys(case, [fixed]), *replaced_keys(base, examples)]
    kind = point_kind(base, file.compute)
    problems += plot_problems(file.plot, kind)
    problems += unknown_numbers(file.outputs, kind, "outputs")
    if problems:
        raise source.error(problems)
    keys = varied_keys(blocks)
    plan = Plan(blocks, point_documents(file, base), PointName(file, base).name_of, keys)
    checked = _checked(plan, file, base, fixed, source)
    sharing = {number: common for number, (common, _) in checked.items() if common is not None}
    points: Sequence[Point] = plan
    table = None
    if sharing or file.table is not None:
        several = [plan[number] for number in sorted(checked)]
        table, points = _with_tables(file, several, checked, source)
    return Sweep(
        text=text,
        title=sweep_title(file, base, keys),
        case=file.case,
        compute=file.compute,
        fields=file.fields,
        keys=keys,
        points=points,
        messages=tuple(notes),
        assumed=assumed_keys(base),
        table=table,
        table_points=file.table_points,
        plot=file.plot,
        outputs=file.outputs,
        designs=tuple(designs),
        film_models=tuple(sorted({_film_model(case) for _, case in checked.values()})),
        share_contacts=_may_share_contacts(blocks, keys),
    )


def _may_share_contacts(blocks: Sequence[Sequence[Variation]], keys: tuple[str, ...]) -> bool:
    """Tell whether contacts may be equal in several points: where values repeat, as those of all
    balls without load at one speed, or keys vary that leave the contacts unchanged.
    """
    repeated = any(len(block) > 1 and not isinstance(block, Sampled) for block in blocks)
    return repeated or any(key.partition(".")[0] in WITHOUT_CONTACTS for key in keys)


def _film_model(case: AnyCase) -> str:
    return str(case.document.get("ehl", {}).get("film_model"))


def _with_tables(
    file: SweepFile, points: list[Point], checked: Checked, source: Source
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
    file: SweepFile, common: dict[int, str], examples: dict[str, Case], source: Source
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
    plan: Plan, file: SweepFile, base: Document, fixed: Variation, source: Source
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
    every = may_share_tables(file, base, plan.keys)
    for index in _checked_indices(plan, every=every):
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
        shares = needs_tables(case, file.compute, asked=wants_tables(file))
        common = bodies_and_oil(case) if shares and isinstance(case, Case) else None
        checked[index] = (common, case)
        problems += _kind(file, case, index + 1)
    if problems:
        raise source.error(problems)
    return checked


def _checked_indices(plan: Plan, *, every: bool) -> Sequence[int]:
    """Places of the points that are checked at once: of a large sweep first of all those where a
    key of a factorial block takes each end of its list, then a sample.
    """
    whole = range(len(plan))
    if len(plan) <= CHECKED or every:
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


def plot_problems(names: tuple[str, ...], kind: str) -> Iterator[CaseProblem]:
    """Problems of the names of numbers to draw.

    Parameters
    ----------
    names : tuple[str, ...]
        Names of columns of batch.csv.
    kind : str
        Quantity that is computed; "contact" for a single contact.

    Yields
    ------
    Iterator[CaseProblem]
        The problems.
    """
    yield from unknown_numbers(names, kind, "plot")
    units = [unit_of(name) for name in names]
    if 1 < len(set(units)) and (len(set(units)) < len(units) or len(units) > MOST_PANELS):
        names_of_units = ", ".join(unit or "no unit" for unit in dict.fromkeys(units))
        finding = f"found {len(units)} numbers in {names_of_units}"
        allowed = f"allowed: all in one unit, or up to {MOST_PANELS} in one unit each"
        yield CaseProblem(("plot",), finding, allowed)


def unknown_numbers(names: tuple[str, ...], kind: str, key: str) -> Iterator[CaseProblem]:
    """Problems of the names of numbers of batch.csv.

    Parameters
    ----------
    names : tuple[str, ...]
        The names.
    kind : str
        Quantity that is computed; "contact" for a single contact.
    key : str
        Key of the sweep file.

    Yields
    ------
    Iterator[CaseProblem]
        The problems.
    """
    known = result_names(kind)
    for k, name in enumerate(names):
        if name not in known:
            allowed = "allowed: main results, torque_N_mm, supply and self_heating of batch.csv"
            longer = (whole for whole in known if whole.endswith(f".{name}"))
            nearest = next(longer, nearest_name(name, known))
            yield CaseProblem((key, k), f"found {shown(name)}", allowed, nearest=nearest)
        elif name in names[:k]:
            yield CaseProblem((key, k), f"found {shown(name)} twice", "allowed: once")
