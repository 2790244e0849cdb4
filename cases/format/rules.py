"""Relations between the keys of a case file, as data, and their one checker.

A rule looks only at values that are valid by themselves: all errors are reported at once.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from typing import Any

from .problems import MISSING, CaseProblem, Path, shown


@dataclass(frozen=True, slots=True)
class CaseValues:
    """The values of a document that are valid by themselves."""

    document: dict[str, Any]
    faulty: frozenset[Path] = frozenset()

    def get(self, *path: str) -> Any:
        """The value of a key.

        Parameters
        ----------
        *path : str
            Path of the key.

        Returns
        -------
        Any
            The value; None if it is left out or wrong.
        """
        node: Any = self.document
        for depth, key in enumerate(path, 1):
            if path[:depth] in self.faulty or not isinstance(node, dict) or key not in node:
                return None
            node = node[key]
        return node

    def given(self, *path: str) -> bool:
        """Tell whether the document has a key, valid or not.

        Parameters
        ----------
        *path : str
            Path of the key.

        Returns
        -------
        bool
            True if it has.
        """
        node: Any = self.document
        for key in path:
            if not isinstance(node, dict) or key not in node:
                return False
            node = node[key]
        return True


@dataclass(frozen=True, slots=True)
class Where:
    """A key or table that is given, or has a value, a number with `nonzero` one other than zero;
    where all of `also` hold, too.
    """

    key: str
    value: str | None = None
    nonzero: bool = False
    also: tuple["Where", ...] = ()

    def holds(self, values: CaseValues) -> bool:
        """Tell whether a document meets the condition.

        Parameters
        ----------
        values : CaseValues
            The valid values of the file.

        Returns
        -------
        bool
            True if it does.
        """
        path = _path(self.key)
        if not all(where.holds(values) for where in self.also):
            return False
        if len(path) == 1:
            return values.get(*path) not in (None, [], ())  # no table of several is none, too
        if self.value is not None:
            return bool(values.get(*path) == self.value)
        return bool(values.get(*path)) if self.nonzero else values.given(*path)

    def text(self, table: str = "") -> str:
        """The condition in words.

        Parameters
        ----------
        table : str, default ''
            Name of the table that it is read in, which is left out.

        Returns
        -------
        str
            The text.
        """
        key = self.key.removeprefix(f"{table}.") if "." in self.key else f"[{self.key}]"
        return key if self.value is None else f"{key} = {shown(self.value)}"


@dataclass(frozen=True, slots=True)
class Excludes:
    """Two keys of which a file gives one at most; the fault stands at the first."""

    key: str
    other: str
    allowed: str = "one of them"

    def faults(self, values: CaseValues) -> Iterator[CaseProblem]:
        """A problem at the first key, where both are given.

        Parameters
        ----------
        values : CaseValues
            The valid values of the file.

        Yields
        ------
        Iterator[CaseProblem]
            The problem.
        """
        path = _path(self.key)
        if values.given(*path) and values.given(*_path(self.other)):
            finding = f"found together with {self.other.removeprefix(f'{path[0]}.')}"
            yield CaseProblem(path, finding, f"allowed: {self.allowed}")


@dataclass(frozen=True, slots=True)
class Needs:
    """A key, or a table, that must be given where another one is, `unless` one of these is."""

    key: str
    where: Where
    allowed: str = ""
    unless: tuple[str, ...] = ()

    def faults(self, values: CaseValues) -> Iterator[CaseProblem]:
        """A problem at the key that is left out; at the one that needs it, where its table is left
        out.

        Parameters
        ----------
        values : CaseValues
            The valid values of the file.

        Yields
        ------
        Iterator[CaseProblem]
            The problem.
        """
        path = _path(self.key)
        given = any(values.given(*_path(key)) for key in (self.key, *self.unless))
        if self.where.holds(values) and not given:
            allowed = self.allowed or f"needed with {self.where.text(path[0])}"
            yield CaseProblem(path, MISSING, allowed, asked_by=_path(self.where.key))


@dataclass(frozen=True, slots=True)
class OnlyWith:
    """A key without effect but where one of the others is given; its `default` may stay."""

    key: str
    wheres: tuple[Where, ...]
    default: Any = None

    def faults(self, values: CaseValues) -> Iterator[CaseProblem]:
        """A problem at the key, where it is given without the others.

        Parameters
        ----------
        values : CaseValues
            The valid values of the file.

        Yields
        ------
        Iterator[CaseProblem]
            The problem.
        """
        path = _path(self.key)
        value = values.get(*path)
        if value in (None, self.default) or any(where.holds(values) for where in self.wheres):
            return
        finding = f"found without {' or '.join(where.text(path[0]) for where in self.wheres)}"
        allowed = f"allowed: with {' or '.join(where.text() for where in self.wheres)}"
        yield CaseProblem(path, finding, allowed)


@dataclass(frozen=True, slots=True)
class Below:
    """A number below another one."""

    low: str
    high: str
    low_default: float | None = None
    high_default: float | None = None

    def faults(self, values: CaseValues) -> Iterator[CaseProblem]:
        """A problem at the key without a default, where the first number is not below the second.

        Parameters
        ----------
        values : CaseValues
            The valid values of the file.

        Yields
        ------
        Iterator[CaseProblem]
            The problem.
        """
        low = _number(values, self.low, self.low_default)
        high = _number(values, self.high, self.high_default)
        if low is None or high is None or low < high:
            return
        at_high = self.low_default is not None
        path = _path(self.high if at_high else self.low)
        bound = f"above {self.low} = {low:g}" if at_high else f"below {self.high} = {high:g}"
        if values.get(*path) is not None:
            allowed = f"allowed: {bound.replace(f'{path[0]}.', '')}"
            yield CaseProblem(path, f"found {values.get(*path):g}", allowed)


Relation = Excludes | Needs | OnlyWith | Below


def relation_faults(relations: Iterable[Relation], values: CaseValues) -> Iterator[CaseProblem]:
    """The problems of all relations, the first of each key.

    Parameters
    ----------
    relations : Iterable[Relation]
        The relations.
    values : CaseValues
        The valid values of the file.

    Yields
    ------
    Iterator[CaseProblem]
        The problems.
    """
    seen: set[Path] = set()
    for relation in relations:
        for fault in relation.faults(values):
            if fault.path not in seen:
                yield fault
            seen.add(fault.path)


def bounded(
    values: CaseValues, key: str, fits: Callable[[Any], bool], allowed: str
) -> Iterator[CaseProblem]:
    """A problem where the value of a key is given and does not fit.

    Parameters
    ----------
    values : CaseValues
        The valid values of the file.
    key : str
        Dotted name of the key.
    fits : Callable[[Any], bool]
        Tells whether a value fits.
    allowed : str
        Text for the message.

    Yields
    ------
    Iterator[CaseProblem]
        The problem.
    """
    value = values.get(*_path(key))
    if value is not None and not fits(value):
        yield CaseProblem(_path(key), f"found {shown(value)}", f"allowed: {allowed}")


@cache
def _path(key: str) -> tuple[str, ...]:
    return tuple(key.split("."))


def _number(values: CaseValues, key: str, default: float | None) -> float | None:
    path = _path(key)
    return values.get(*path) if values.given(*path) else default
