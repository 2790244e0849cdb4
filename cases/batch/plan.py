"""The variations of a sweep, documents and names of their points.

A block of a sweep file (factorial, listed, sampled, differences) gives variations; a variation
gives the document of a case, in which a value of the point replaces alternatives of the case's.
Faults of a point are faults of the sweep file, at the key that the point varies or fixes.
"""

import hashlib
import json
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import product
from math import prod
from pathlib import Path
from typing import Any, overload

from oilfilm.ehl.foreign_files import read_file

from ..format.bearing import GEOMETRY
from ..format.changes import alternatives, case_path, changed_document
from ..format.fields import is_number
from ..format.rules import CaseProblem, KeyPath, shown
from ..format.shipped import table_path
from .keys import DESCRIBING, NOT_IN_TRACTION_TABLES, digest, document_text, program_digest
from .sweep_file import SensitivityTable, SweepFile

MOST_POINTS = 10_000_000

SENSITIVITY = "sensitivity"  # block whose points stay near the case as it is
HIDING = {
    "bearing": GEOMETRY,
    "lubricant": ("viscosity_mPa_s", "kinematic_viscosity_mm2_s", "pressure_viscosity_1_GPa"),
}
FORMAT = 4  # of what a point leaves on disk
INPUT_FILES = (  # table and key of files that a case reads
    ("friction", "traction_table"),
    ("form", "inner_profile"),
    ("form", "outer_profile"),
    ("form", "ball_profile"),
    ("support", "frequency_response"),
    ("housing", "stiffness"),
    (None, "load_spectrum"),
    (None, "measured"),
)
SIMPLE = frozenset((float, int, str))  # a truth value equals a number
BITS = 256  # of the sum of hashes
Document = dict[str, Any]


@dataclass(frozen=True, slots=True)
class Setting:
    """One key of a block: dotted name, place in the sweep file, value or values given."""

    key: str
    where: KeyPath
    value: Any


@dataclass(frozen=True, slots=True)
class Variation:
    """Values by which one point differs from the case."""

    block: str
    settings: tuple[Setting, ...]


def block_settings(table: dict[str, Any], where: KeyPath) -> list[Setting]:
    """The keys of a block; `"operation.load" = 1` and `operation.load = 1` are the same.

    Parameters
    ----------
    table : dict[str, Any]
        The block as parsed.
    where : KeyPath
        Path of the block in the file.

    Returns
    -------
    list[Setting]
        A setting for each key.
    """
    settings: list[Setting] = []
    for name, value in table.items():
        if isinstance(value, dict):
            inner = block_settings(value, (*where, name))
            settings += [Setting(f"{name}.{s.key}", s.where, s.value) for s in inner]
        else:
            settings.append(Setting(name, (*where, name), value))
    return settings


class LazyVariations(Sequence[Variation]):
    """Variations that are made when they are asked for."""

    @overload
    def __getitem__(self, index: int) -> Variation: ...

    @overload
    def __getitem__(self, index: slice) -> list[Variation]: ...

    def __getitem__(self, index: int | slice) -> Variation | list[Variation]:
        if isinstance(index, slice):
            return [self.variation_at(k) for k in range(*index.indices(len(self)))]
        return self.variation_at(range(len(self))[index])

    def variation_at(self, index: int) -> Variation:
        """Make the variation at an index.

        Parameters
        ----------
        index : int
            Index of the variation, from 0 [-].

        Returns
        -------
        Variation
            The variation.
        """
        raise NotImplementedError


class Factorial(LazyVariations):
    """Combinations of lists of settings, the last one fastest."""

    def __init__(self, choices: Sequence[Sequence[Setting]]) -> None:
        self.choices = choices
        self.size = prod(map(len, choices)) if choices else 0

    def __len__(self) -> int:
        return self.size

    def variation_at(self, index: int) -> Variation:
        """Make the combination at an index, whose digits are the indices in the lists.

        Parameters
        ----------
        index : int
            Index of the combination, from 0 [-].

        Returns
        -------
        Variation
            The variation.
        """
        chosen = []
        for choice in reversed(self.choices):
            index, k = divmod(index, len(choice))
            chosen.append(choice[k])
        return Variation("sweep", tuple(reversed(chosen)))

    def __iter__(self) -> Iterator[Variation]:
        return (Variation("sweep", chosen) for chosen in product(*self.choices) if chosen)

    def edges(self) -> set[int]:
        """Places where a key has the last value of its list, the others their first ones."""
        indices = {0}
        step = self.size
        for choice in self.choices:
            step //= len(choice)
            indices.add((len(choice) - 1) * step)
        return indices


class Sampled(LazyVariations):
    """Rows of a table of values, a column for each key."""

    def __init__(
        self, block: str, keys: Sequence[tuple[str, KeyPath]], rows: Sequence[Sequence[Any]]
    ) -> None:
        self.block = block
        self.keys = keys
        self.rows = rows

    def __len__(self) -> int:
        return len(self.rows)

    def variation_at(self, index: int) -> Variation:
        """Make the variation of a row of the table.

        Parameters
        ----------
        index : int
            Index of the row, from 0 [-].

        Returns
        -------
        Variation
            The variation.
        """
        row = zip(self.keys, self.rows[index], strict=True)
        return Variation(self.block, tuple(Setting(*key, value) for key, value in row))


def factorial(file: SweepFile) -> tuple[Factorial, list[CaseProblem]]:
    """Combinations of the lists in [sweep], last key fastest.

    Parameters
    ----------
    file : SweepFile
        The checked sweep file.

    Returns
    -------
    combinations
        The combinations; none where a list is wrong.
    problems
        Wrong lists.
    """
    settings = block_settings(file.sweep, ("sweep",))
    problems = [
        CaseProblem(s.where, f"found {shown(s.value)}", "allowed: a list of values")
        for s in settings
        if not isinstance(s.value, list) or not s.value
    ]
    if problems:
        return Factorial([]), problems
    return Factorial([[Setting(s.key, s.where, v) for v in s.value] for s in settings]), []


def listed(file: SweepFile) -> list[Variation]:
    """The points of [[combinations]].

    Parameters
    ----------
    file : SweepFile
        The checked sweep file.

    Returns
    -------
    list[Variation]
        A variation for each table.
    """
    tables = enumerate(file.combinations)
    return [
        Variation("combinations", tuple(block_settings(table, ("combinations", k))))
        for k, table in tables
    ]


def differences(
    table: SensitivityTable, keys: tuple[str, ...], values: dict[str, Any]
) -> tuple[list[Variation], list[str], list[CaseProblem]]:
    """The case itself, and each key by itself down and up from its value in the case.

    Parameters
    ----------
    table : SensitivityTable
        Step and keys of [sensitivity].
    keys : tuple[str, ...]
        Dotted names of the keys.
    values : dict[str, Any]
        Value of each key as run.

    Returns
    -------
    variations
        The points.
    notes
        Keys that are left out.
    problems
        Keys that cannot be varied.
    """
    variations = [Variation("sensitivity", ())]
    notes = []
    problems = []
    where = ("sensitivity", "keys")
    for key in keys:
        value = values.get(key)
        if isinstance(value, float) and is_number(value) and value != 0.0:
            changed = (value * (1.0 - table.step), value * (1.0 + table.step))
            variations += [Variation("sensitivity", (Setting(key, where, v),)) for v in changed]
        elif table.keys == "assumed":
            reason = "is not given" if value is None else f"{shown(value)} has no relative change"
            notes.append(f"sensitivity: {key} left out, {reason}")
        else:
            allowed = "allowed: keys of the case with a number that is not 0"
            problems.append(CaseProblem(where, f"{key} = {shown(value)}", allowed))
    if len(variations) == 1 and not problems:
        problems.append(CaseProblem(where, "no key to vary", "needed: a list of keys"))
    return variations, notes, problems


class PointDocuments:
    """The case's document with the values of variations, without their alternatives."""

    def __init__(self, base: dict[str, Any]) -> None:
        self.base = base
        self._gone: dict[tuple[str, ...], tuple[tuple[str, str, str], ...]] = {}

    def document(self, variation: Variation) -> dict[str, Any]:
        """The document of one variation; tables that it leaves unchanged are those of the case.

        Parameters
        ----------
        variation : Variation
            Values by key.

        Returns
        -------
        dict[str, Any]
            Document of the point.
        """
        values = ((setting.key, setting.value) for setting in variation.settings)
        return changed_document(self.base, values, self._alternatives(variation))

    def _alternatives(self, variation: Variation) -> tuple[tuple[str, str, str], ...]:
        """Keys that give way, which depend on the keys of the variation alone."""
        keys = (variation.block, *(setting.key for setting in variation.settings))
        if keys not in self._gone:
            self._gone[keys] = tuple(_alternatives(self.base, variation))
        return self._gone[keys]


def with_values(base: dict[str, Any], variation: Variation) -> dict[str, Any]:
    """The document of a case with the values of a variation, without their alternatives.

    Parameters
    ----------
    base : dict[str, Any]
        Document of the case.
    variation : Variation
        Values by key.

    Returns
    -------
    dict[str, Any]
        The changed document.
    """
    return PointDocuments(base).document(variation)


def replaced_keys(base: dict[str, Any], variations: Sequence[Variation]) -> tuple[str, ...]:
    """Keys of the case that points leave out, in words, each once.

    Parameters
    ----------
    base : dict[str, Any]
        Document of the case.
    variations : Sequence[Variation]
        Variations of the points.

    Returns
    -------
    tuple[str, ...]
        A sentence for each key.
    """
    return tuple(
        dict.fromkeys(
            f"{table}.{key} of the case is left out, the points give {own}"
            for variation in variations
            for table, key, own in _alternatives(base, variation)
        )
    )


def _alternatives(base: dict[str, Any], variation: Variation) -> Iterator[tuple[str, str, str]]:
    """Table and key that give way, and the key that they give way to."""
    keys = [setting.key for setting in variation.settings]
    return alternatives(base, keys, near=variation.block == SENSITIVITY)


def overridden_names(base: dict[str, Any], variations: list[Variation]) -> Iterator[CaseProblem]:
    """Problems of a bearing or an oil varied by name whose values the case itself overrides.

    Parameters
    ----------
    base : dict[str, Any]
        Document of the case.
    variations : list[Variation]
        Variations of the sweep.

    Yields
    ------
    Iterator[CaseProblem]
        A problem for each such key.
    """
    for variation in variations[:1] + variations[-1:]:
        for setting in variation.settings:
            table, *keys = map(str, case_path(setting.key))
            own = base.get(table)
            if keys[-1:] != ["name"] or not isinstance(own, dict):
                continue
            given = [name for name in HIDING.get(table, ()) if name in own]
            if given:
                finding = f"the case itself gives {given[0]}, which overrides the library's"
                allowed = f"allowed with a case that names a {table} only"
                yield CaseProblem(setting.where, finding, allowed)


def located_faults(
    problems: Iterable[CaseProblem], variation: Variation, fixed: Variation, number: int
) -> Iterator[CaseProblem]:
    """Problems of a point at the key of the sweep file that it varies or fixes.

    Parameters
    ----------
    problems : Iterable[CaseProblem]
        Problems of the case of the point.
    variation : Variation
        Values of the point.
    fixed : Variation
        Values of all points.
    number : int
        Number of the point, from 1 [-].

    Yields
    ------
    Iterator[CaseProblem]
        The same problems with paths of the sweep file.
    """
    settings = (*variation.settings, *fixed.settings)
    for problem in problems:
        setting = next((s for s in settings if _meets(case_path(s.key), problem.path)), None)
        place = f"{'.'.join(map(str, problem.path))}: " if problem.path else ""
        if setting is None:
            values = ", ".join(f"{s.key} = {shown(s.value)}" for s in variation.settings)
            where: KeyPath = ("case",)
            place = f"point {number} ({values}): {place}"
        else:
            where = setting.where
            place = "" if tuple(problem.path) == case_path(setting.key) else place
        yield CaseProblem(where, f"{place}{problem.finding}", problem.allowed, problem.nearest)


def _meets(path: KeyPath, problem: KeyPath) -> bool:
    """Tell whether a problem's path is that of a key, lies below it, or is a table around it."""
    shorter = min(len(path), len(problem))
    return shorter > 0 and path[:shorter] == tuple(problem[:shorter])


def asked_parts(outputs: Sequence[str]) -> dict[str, bool]:
    """Parts of a run that the wanted numbers need beside loads, films, total torque and life.

    Parameters
    ----------
    outputs : Sequence[str]
        Names of the wanted numbers; none: all.

    Returns
    -------
    dict[str, bool]
        Arguments of `of_main_numbers`; empty where all numbers are wanted.
    """
    if not outputs:
        return {}
    own = ("torque_N_mm.total", "torque_N_mm.models.integrated")
    bounds = (n for n in outputs if n.startswith(("torque_N_mm.", "supply.", "decay.")))
    heat = any(name.startswith("self_heating.") for name in outputs)
    return {"heat": heat, "bounds": any(not name.startswith(own) for name in bounds)}


class PointName:
    """Names of points: hashes of all that their results depend on, the program included.

    A name holds the sum of the hashes of all keys of all tables, so that only those have to be
    read again that a point changes.
    """

    def __init__(self, file: SweepFile, base: Document) -> None:
        whole: Document = {"compute": file.compute, "fields": file.fields, "format": FORMAT}
        if file.compute == "table":
            whole["table_points"] = file.table_points
        whole |= asked_parts(file.outputs)
        text = document_text(whole | {"program": program_digest()})
        self.head = hashlib.sha256(text.encode())
        self.without = frozenset(NOT_IN_TRACTION_TABLES if file.compute == "table" else DESCRIBING)
        self.base = base
        self.hashes = {name: self._hashes(name, value) for name, value in base.items()}
        self.totals = {name: sum(own.values()) for name, own in self.hashes.items()}
        self.total = sum(self.totals.values())

    def name_of(self, document: Document) -> str:
        """The name of a point: a hash of all that its results depend on.

        Parameters
        ----------
        document : Document
            Document of the point.

        Returns
        -------
        str
            20 hexadecimal digits.
        """
        total = self.total
        for name, value in document.items():
            before = self.base.get(name)
            if value is before or name in self.without:
                continue
            if isinstance(value, dict) and isinstance(before, dict):
                total += self._change(name, value, before)
            else:
                total += sum(self._hashes(name, value).values()) - self.totals.get(name, 0)
        if not self.base.keys() <= document.keys():
            total -= sum(self.totals[name] for name in self.base.keys() - document.keys())
        known = self.head.copy()
        known.update((total % 2**BITS).to_bytes(BITS // 8, "big"))
        for content in input_files(document):
            known.update(content.encode())
        return known.hexdigest()[:20]

    def _change(self, name: str, table: Document, before: Document) -> int:
        """Contribution of a table to the sum where it differs from that of the case."""
        known = self.hashes[name]
        change = 0
        for key, value in table.items():
            if key not in before:
                change += _hash(name, key, value)
            elif value is not before[key]:
                change += _hash(name, key, value) - known[key]
        if not before.keys() <= table.keys():
            change -= sum(known[key] for key in before.keys() - table.keys())
        return change

    def _hashes(self, name: str, value: Any) -> dict[str, int]:
        """Numbers of the keys of a table, that it is there among them; empty of what does not
        count.
        """
        if name in self.without:
            return {}
        if not isinstance(value, dict):
            return {"": _hash(name, "", value)}
        return {"": _hash(name, "", None)} | {k: _hash(name, k, v) for k, v in value.items()}


def _hash(name: str, key: str, value: Any) -> int:
    """The value of a key as a number."""
    return _of_scalar(name, key, value) if type(value) in SIMPLE else _of_text(name, key, value)


@lru_cache(maxsize=65_536)  # of factorial points, which repeat theirs
def _of_scalar(name: str, key: str, value: float | str) -> int:
    return _of_text(name, key, value)


def _of_text(name: str, key: str, value: Any) -> int:
    text = f"{name}.{key}={json.dumps(_plain(value), sort_keys=True, default=str)}"
    return int.from_bytes(hashlib.sha256(text.encode()).digest(), "big")


def _plain(value: Any) -> Any:
    """A value with whole numbers as the floats that they are equal to, zero without a sign."""
    if isinstance(value, dict):
        return {k: _plain(v) for k, v in value.items()}
    if isinstance(value, list):
        return [_plain(item) for item in value]
    return float(value) + 0.0 if type(value) in (int, float) else value


def input_files(document: Document) -> Iterator[str]:
    """Digests of the files that a case reads.

    Parameters
    ----------
    document : Document
        Document of a case.

    Yields
    ------
    Iterator[str]
        A digest for each file; its name where the file does not exist.
    """
    for table, key in INPUT_FILES:
        given = document if table is None else document.get(table)
        path = given.get(key) if isinstance(given, dict) else None
        if isinstance(path, str):
            yield _current_digest(path)


def _current_digest(name: str) -> str:
    try:
        path = table_path(name)
        state = path.stat()
        return _file_digest(str(path), state.st_mtime_ns, state.st_size)
    except (OSError, ValueError):
        return name


@lru_cache(maxsize=64)
def _file_digest(name: str, _changed: int, _size: int) -> str:
    return digest(read_file(Path(name)))
