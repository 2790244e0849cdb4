"""A sweep file expanded: its case, the keys that it varies, and its blocks of points.

Nothing is checked as a case here, and no solver is loaded.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

from oilfilm.bearing.operation import BallKinematics
from oilfilm.postprocess.batch.design import Design

from ..format.document import parse, read_text
from ..format.fields import validated
from ..format.rules import CaseError, CaseProblem, faults_error
from ..format.shipped import find_case
from .keys import value_in
from .plan import (
    MOST_POINTS,
    Document,
    Factorial,
    PointDocuments,
    Sampled,
    Variation,
    block_settings,
    factorial,
    listed,
    with_values,
)
from .samples import sampled_blocks
from .sweep_file import SweepFile

MOST_CHECKED = 100_000  # points of kinds that are checked one by one, 2 ms each
EVERY_POINT = ("torque", "dynamics")  # kinds whose tables may depend on all points
# keys of a case by which its torque points share traction tables
TABLE_KEYS = ("model.ball_kinematics", "friction.table_films")


@dataclass(frozen=True, slots=True)
class Source:
    """Text and name of a sweep file, the folder where its files are sought first."""

    text: str
    name: str
    folder: Path

    def error(self, faults: Iterable[CaseProblem]) -> CaseError:
        """The faults with their lines.

        Parameters
        ----------
        faults : Iterable[CaseProblem]
            Faults of the file.

        Returns
        -------
        CaseError
            An error to raise.
        """
        return faults_error(faults, self.name, self.text)


class Expansion(NamedTuple):
    """A sweep file, its case as given and with the fixed values, its blocks, their faults."""

    file: SweepFile
    case: Document
    fixed: Variation
    base: Document
    blocks: list[Sequence[Variation]]
    designs: list[Design]
    problems: list[CaseProblem]


def expanded(source: Source) -> Expansion:
    """Expand a sweep file into the variations of its blocks; [sensitivity] asks the case first.

    Parameters
    ----------
    source : Source
        The sweep file.

    Returns
    -------
    Expansion
        Its case and its blocks.

    Raises
    ------
    CaseError
        If the file is no sweep, or its case cannot be found.
    """
    file = _file(source)
    case_file = _case_file(file.case, source)
    fixed = Variation("fixed", tuple(block_settings(file.fixed, ("fixed",))))
    case = parse(read_text(case_file), str(case_file))
    return Expansion(file, case, fixed, with_values(case, fixed), *_blocks(file))


def _file(source: Source) -> SweepFile:
    """The content of a sweep file, checked against its format."""
    tables = _sweep_tables(source.text, source.name)
    file, faults = validated(SweepFile, tables)
    if file is None:
        raise source.error(faults)
    return file


def _sweep_tables(text: str, name: str) -> dict[str, Any]:
    """The tables of a sweep file; `CaseError` if they are those of a case."""
    document = parse(text, name)
    if "case" not in document:
        for table, command in (("bearing", "run"), ("contact", "contact"), ("shaft", "shaft")):
            if table in document:
                raise CaseError(f"{name}:1: a case, not a sweep; run it with 'oilfilm {command}'")
    return document


def _case_file(case: str, source: Source) -> Path:
    """The case beside the sweep file if there is one, else as every command finds it."""
    try:
        return find_case(case, source.folder)
    except (CaseError, OSError, ValueError) as error:
        raise source.error([CaseProblem(("case",), str(error).partition("\n")[0])]) from None


def _blocks(file: SweepFile) -> tuple[list[Sequence[Variation]], list[Design], list[CaseProblem]]:
    """Variations of the blocks, in the order of the format's description, designs, faults."""
    combinations, problems = factorial(file)
    sampled, faults = sampled_blocks(file)
    problems += faults
    count = len(combinations) + len(file.combinations) + sum(len(one) for one, _ in sampled)
    most = MOST_CHECKED if file.compute in EVERY_POINT else MOST_POINTS
    if count > most:
        allowed = f"allowed: at most {most}"
        problems.append(CaseProblem((), f"{count} points", allowed, line=1))
    if problems:
        return [], [], problems
    blocks: list[Sequence[Variation]] = [combinations, listed(file)]
    designs = []
    for block, design in sampled:
        designs.append(replace(design, start=sum(map(len, blocks))))
        blocks.append(block)
    if not any(map(len, blocks)) and file.sensitivity is None:
        allowed = "needed: [sweep], [[combinations]], [latin_hypercube] or [sensitivity] with keys"
        problems.append(CaseProblem((), "no points", allowed, line=1))
    return blocks, designs, problems


def of_each_kind(block: Sequence[Variation]) -> Sequence[Variation]:
    """Variations of a block that name all its keys: one where all have the same.

    Parameters
    ----------
    block : Sequence[Variation]
        Variations of the block.

    Returns
    -------
    Sequence[Variation]
        Some of them.
    """
    return block[:1] if isinstance(block, Factorial | Sampled) else block


def varied_keys(blocks: Sequence[Sequence[Variation]]) -> tuple[str, ...]:
    """Dotted names of all keys that vary somewhere, each once.

    Parameters
    ----------
    blocks : Sequence[Sequence[Variation]]
        Blocks of a sweep.

    Returns
    -------
    tuple[str, ...]
        Names of the keys.
    """
    examples = (variation for block in blocks for variation in of_each_kind(block))
    return tuple(dict.fromkeys(s.key for variation in examples for s in variation.settings))


def sweep_title(file: SweepFile, base: Document, keys: tuple[str, ...]) -> str:
    """Title of a batch: that of its file, or of its case with what is varied of it.

    Parameters
    ----------
    file : SweepFile
        The sweep file.
    base : Document
        Document of the case.
    keys : tuple[str, ...]
        Varied keys.

    Returns
    -------
    str
        The title.
    """
    if file.title:
        return file.title
    case = base.get("title") or file.case
    names = [key.rpartition(".")[2] for key in keys]
    return f"{case}; varied: {', '.join(names[:4])}{' ...' if len(names) > 4 else ''}"


def assumed_keys(base: Document) -> tuple[str, ...]:
    """Keys that a case calls assumed.

    Parameters
    ----------
    base : Document
        Document of the case.

    Returns
    -------
    tuple[str, ...]
        Names of the keys.
    """
    return tuple(key for key in base.get("assumed", ()) if isinstance(key, str))


def wants_tables(file: SweepFile) -> bool:
    """Tell whether a sweep file asks for traction tables by itself.

    Parameters
    ----------
    file : SweepFile
        The sweep file.

    Returns
    -------
    bool
        True if it names a file of tables or the nodes of their films.
    """
    return not file.model_fields_set.isdisjoint(("table", "table_points"))


def may_share_tables(file: SweepFile, base: Document, keys: Sequence[str]) -> bool:
    """Tell whether points may share traction tables, which only checked cases can say.

    Parameters
    ----------
    file : SweepFile
        The sweep file.
    base : Document
        Document of the case.
    keys : Sequence[str]
        Varied keys.

    Returns
    -------
    bool
        True if they may.
    """
    if file.compute != "torque":
        return file.compute in EVERY_POINT
    asked = any(key in keys or value_in(base, key) is not None for key in TABLE_KEYS)
    return asked or wants_tables(file)


def point_documents(file: SweepFile, base: Document) -> Callable[[Variation], Document]:
    """Give the documents of the points of a sweep by their variations.

    Parameters
    ----------
    file : SweepFile
        The sweep file.
    base : Document
        Document of the case.

    Returns
    -------
    Callable[[Variation], Document]
        Document of a variation; of a torque point with balls in traction equilibrium where its
        friction is that of tables or of a law, unless the case says otherwise.
    """
    made = PointDocuments(base).document
    if file.compute != "torque":
        return made
    return partial(_torque_document, made, tables=wants_tables(file))


def _torque_document(
    made: Callable[[Variation], Document], variation: Variation, *, tables: bool
) -> Document:
    """The document of a torque point, by what makes those of others."""
    document = made(variation)
    model = document.get("model", {})
    asked = tables or any(
        value_in(document, key) is not None for key in ("friction.traction", TABLE_KEYS[1])
    )
    named = not isinstance(model, dict) or "ball_kinematics" in model
    if "bearing" not in document or named or not asked:
        return document
    balanced = {**model, "ball_kinematics": BallKinematics.TRACTION_EQUILIBRIUM.value}
    return {**document, "model": balanced}
