"""Numbers of the points of a batch as columns, some thousand points at a time."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from .results import BatchResults
from .store import BOOL, FLOAT, INTEGER, NOTHING, layout_names, packed_numbers, unpacked_numbers

CHUNK = 5000  # points at a time: 10 MB with 250 numbers each
STATE = ("point", "block", "status", "converged")  # columns of every batch, before the keys
STATE_KINDS = {"point": "int", "block": "word", "status": "word", "converged": "bool"}
KINDS = {BOOL: "bool", INTEGER: "int", FLOAT: "float", NOTHING: "nothing"}

Numbers = np.ndarray[Any, np.dtype[np.float64]]
Kinds = np.ndarray[Any, np.dtype[np.uint8]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """One point of a batch with its packed numbers, none of one without a result."""

    number: int
    block: str
    status: str
    message: str
    converged: bool
    values: dict[str, Any]
    layout: str = "[]"
    numbers: bytes = b""


class Source(Protocol):
    """The points of a batch in their order; may be gone through several times."""

    keys: tuple[str, ...]

    def __len__(self) -> int: ...

    def chunks(self) -> Iterator[Sequence[Row]]:
        """All rows, at most `CHUNK` at a time."""
        ...


class InMemory:
    """The points of results that are in memory, their numbers packed once."""

    def __init__(self, results: BatchResults) -> None:
        self.keys = results.keys
        self._rows = [
            Row(
                number=point.number,
                block=point.block,
                status=point.status,
                message=point.message,
                converged=point.converged,
                values=point.values,
                **_packed(point.summary),
            )
            for point in results.points
        ]

    def __len__(self) -> int:
        return len(self._rows)

    def chunks(self) -> Iterator[Sequence[Row]]:
        """All rows."""
        for start in range(0, len(self._rows), CHUNK):
            yield self._rows[start : start + CHUNK]


def _packed(summary: dict[str, Any] | None) -> dict[str, Any]:
    if summary is None:
        return {}
    layout, numbers = packed_numbers(summary)
    return {"layout": layout, "numbers": numbers}


class Layouts:
    """Names of packed numbers, and their places in the columns of a whole batch."""

    def __init__(self) -> None:
        self.main: dict[str, None] = {}
        self.others: dict[str, None] = {}
        self._names: dict[str, tuple[list[str], list[str]]] = {}

    def add(self, layout: str) -> None:
        """Add the columns of one more layout, main results first.

        Parameters
        ----------
        layout : str
            Names of the numbers of a point, JSON.
        """
        if layout not in self._names:
            main, others = layout_names(layout)
            self._names[layout] = (main, others)
            self.main |= dict.fromkeys(main)
            self.others |= dict.fromkeys(others)

    def names(self, layout: str) -> list[str]:
        """Names of the numbers of a layout, in their order.

        Parameters
        ----------
        layout : str
            Names of the numbers of a point, JSON.

        Returns
        -------
        list[str]
            Names of the numbers.
        """
        main, others = self._names[layout]
        return [*main, *others]

    def columns(self, without: Sequence[str]) -> list[str]:
        """All names but some.

        Parameters
        ----------
        without : Sequence[str]
            Names to leave out.

        Returns
        -------
        list[str]
            Names of the columns.
        """
        names = dict.fromkeys([*self.main, *self.others])
        return [name for name in names if name not in without]


@dataclass(frozen=True, slots=True, kw_only=True)
class Columns:
    """Columns of a batch: numbers `names`, and of each and of each key the kind of its values.

    `kinds`: "bool", "int", "float", "word", "text" (of anything else), or "nothing" where no point
    has a value; `gaps`: columns in which a point has none.
    """

    source: Source
    layouts: Layouts
    names: tuple[str, ...]
    kinds: dict[str, str]
    gaps: frozenset[str]

    def chunks(self) -> Iterator[tuple[Sequence[Row], Numbers, Kinds]]:
        """Rows, values and kinds of the numbers, shape (rows, numbers); NaN for no value."""
        places = {name: k for k, name in enumerate(self.names)}
        ways: dict[str, tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]] = {}
        for rows in self.source.chunks():
            values = np.full((len(rows), len(self.names)), np.nan)
            kinds = np.full(values.shape, NOTHING, dtype=np.uint8)
            for i, row in enumerate(rows):
                if row.layout not in ways:
                    ways[row.layout] = _way(self.layouts.names(row.layout), places)
                own, there = ways[row.layout]
                kind, value = unpacked_numbers(row.numbers, len(row.numbers) // 9)
                values[i, there] = value[own]
                kinds[i, there] = kind[own]
            yield rows, values, kinds


def _way(names: list[str], places: dict[str, int]) -> tuple[Any, Any]:
    """Places of numbers in a layout, and those in the columns."""
    available = [(k, places[name]) for k, name in enumerate(names) if name in places]
    own = np.array([k for k, _ in available], dtype=np.intp)
    return own, np.array([place for _, place in available], dtype=np.intp)


def columns_of(source: Source) -> Columns:
    """The columns of a batch, in one pass over its points.

    Parameters
    ----------
    source : Source
        Points of the batch.

    Returns
    -------
    Columns
        Columns with the kinds of their values.
    """
    layouts = Layouts()
    seen: dict[str, Any] = {}  # kinds by layout: a truth value for each byte and number
    counts: dict[str, int] = {}
    keys: dict[str, set[str]] = {key: set() for key in source.keys}
    for rows in source.chunks():
        for row in rows:
            layouts.add(row.layout)
            count = len(row.numbers) // 9
            if row.layout not in seen:
                seen[row.layout] = np.zeros((256, count), dtype=bool)
            kind, _ = unpacked_numbers(row.numbers, count)
            seen[row.layout][kind, np.arange(count)] = True
            counts[row.layout] = counts.get(row.layout, 0) + 1
            for key, kinds in keys.items():
                kinds.add(_kind_of(row.values.get(key)))
    names = layouts.columns((*STATE, *source.keys))
    result: dict[str, set[str]] = {name: set() for name in names}
    points = dict.fromkeys(names, 0)
    for layout, table in seen.items():
        for k, name in enumerate(layouts.names(layout)):
            if name in result:
                result[name] |= {KINDS[kind] for kind in np.flatnonzero(table[:, k]).tolist()}
                points[name] += counts[layout]
    gaps = {name for name in names if points[name] < sum(counts.values())}
    result |= keys
    return Columns(
        source=source,
        layouts=layouts,
        names=tuple(names),
        kinds={name: _common(kinds) for name, kinds in result.items()},
        gaps=frozenset(gaps | {name for name, kinds in result.items() if "nothing" in kinds}),
    )


def _kind_of(value: Any) -> str:
    """The kind of a value of a key."""
    if value is None:
        return "nothing"
    kinds = {bool: "bool", int: "int", float: "float", str: "word"}
    return kinds.get(type(value), "text")


def _common(kinds: set[str]) -> str:
    """The kind that holds all values of a column."""
    available = kinds - {"nothing"}
    if len(available) < 2:
        return next(iter(available), "nothing")
    if available <= {"bool", "int", "float"}:
        return "float"
    return "word" if available <= {"bool", "word"} else "text"
