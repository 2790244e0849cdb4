"""The points of a sweep, each made when it is asked for."""

import hashlib
import json
from bisect import bisect_right
from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache
from itertools import accumulate
from pathlib import Path
from typing import Any, overload

from ...format.shipped import table_path
from ..keys import DESCRIBING, NOT_IN_TRACTION_TABLES, digest, document_text
from ..points import Point
from ..program import program_digest
from ..sweep_file import SweepFile
from .blocks import Variation

FORMAT = 4  # of what a point leaves on disk
INPUT_FILES = (("friction", "traction_table"),)  # table and key of files that a case reads

SIMPLE = frozenset((float, int, str))  # a truth value equals a number
BITS = 256  # of the sum of hashes

Document = dict[str, Any]


class Plan(Sequence[Point]):
    """Points of blocks of variations, one block after the other."""

    def __init__(
        self,
        blocks: Sequence[Sequence[Variation]],
        document: Callable[[Variation], Document],
        name: Callable[[Document], str],
        keys: tuple[str, ...],
    ) -> None:
        self.blocks = [block for block in blocks if len(block)]
        self.ends = list(accumulate(map(len, self.blocks)))
        self.document = document
        self.name = name
        self.keys = keys

    def __len__(self) -> int:
        return self.ends[-1] if self.ends else 0

    @overload
    def __getitem__(self, index: int) -> Point: ...

    @overload
    def __getitem__(self, index: slice) -> list[Point]: ...

    def __getitem__(self, index: int | slice) -> Point | list[Point]:
        if isinstance(index, slice):
            return [self[k] for k in range(*index.indices(len(self)))]
        index = range(len(self))[index]
        return self._point(index, self.variation(index))

    def __iter__(self) -> Iterator[Point]:
        index = 0
        for block in self.blocks:
            for variation in block:
                yield self._point(index, variation)
                index += 1

    def variation(self, index: int) -> Variation:
        """The values by which a point differs from the case.

        Parameters
        ----------
        index : int
            Index of the point, from 0 [-].

        Returns
        -------
        Variation
            The variation.
        """
        number = bisect_right(self.ends, index)
        start = self.ends[number - 1] if number else 0
        return self.blocks[number][index - start]

    def _point(self, index: int, variation: Variation) -> Point:
        document = self.document(variation)
        return Point(
            number=index + 1,
            block=variation.block,
            keys=self.keys,
            document=document,
            key=self.name(document),
        )


class PointName:
    """Names of points: hashes of all that their results depend on, the program included.

    A name holds the sum of the hashes of all keys of all tables, so that only those have to be
    read again that a point changes.
    """

    def __init__(self, file: SweepFile, base: Document) -> None:
        whole: Document = {"compute": file.compute, "fields": file.fields, "format": FORMAT}
        if file.compute == "table":
            whole["table_points"] = file.table_points
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
        given = document.get(table)
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
    return digest(Path(name).read_bytes())
