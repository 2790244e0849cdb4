"""Points of the blocks of a sweep file: factorial, listed, Latin hypercube, differences."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from math import prod
from typing import Any, overload

from ...format.fields import is_number
from ...format.problems import CaseProblem, Path, shown
from ..sweep_file import SensitivityTable, SweepFile

MOST_POINTS = 10_000_000


@dataclass(frozen=True, slots=True)
class Setting:
    """One key of a block: dotted name, place in the sweep file, value or values given."""

    key: str
    where: Path
    value: Any


@dataclass(frozen=True, slots=True)
class Variation:
    """Values by which one point differs from the case."""

    block: str
    settings: tuple[Setting, ...]


def block_settings(table: dict[str, Any], where: Path) -> list[Setting]:
    """The keys of a block; `"operation.load" = 1` and `operation.load = 1` are the same.

    Parameters
    ----------
    table : dict[str, Any]
        The block as parsed.
    where : Path
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
        self, block: str, keys: Sequence[tuple[str, Path]], rows: Sequence[Sequence[Any]]
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
