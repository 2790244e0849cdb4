"""A sweep, its points, and what a worker is sent and sends back: plain data."""

from bisect import bisect_right
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import accumulate
from pathlib import Path
from typing import Any, overload

from oilfilm.postprocess.batch.design import Design
from oilfilm.postprocess.batch.store import Record

from ..format.shaft_case import any_case_of_document
from .keys import program_digest, value_in
from .plan import Document, Variation


@dataclass(frozen=True, slots=True, kw_only=True)
class Point:
    """One point of a sweep."""

    number: int  # counted from 1, in the order of the file
    block: str  # block of the sweep file it comes from
    keys: tuple[str, ...]  # every key that the sweep varies somewhere
    document: dict[str, Any]  # the case with the values of this point, as to be run
    key: str  # name in the batch's folder: equal for points whose results are equal
    # name of the traction tables it needs; equal for points that share them
    tables: str | None = None

    @property
    def resolved(self) -> dict[str, Any]:
        """The document, checked, with defaults and library values filled in."""
        return any_case_of_document(self.document).document

    @property
    def values(self) -> dict[str, Any]:
        """Value of every varied key as run; None where the case does not have it."""
        resolved = self.resolved
        return {key: value_in(resolved, key) for key in self.keys}

    @property
    def given(self) -> dict[str, Any]:
        """Value of every varied key as given, unchecked; None for a default."""
        return {key: value_in(self.document, key) for key in self.keys}


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


@dataclass(frozen=True, slots=True, kw_only=True)
class Sweep:
    """A sweep ready to run: text of the file, name of the case, file of tables, points.

    `points` may make each point when it is asked for.
    """

    text: str
    title: str
    case: str
    compute: str
    fields: bool
    keys: tuple[str, ...]
    points: Sequence[Point]
    messages: tuple[str, ...] = ()
    assumed: tuple[str, ...] = ()
    table: Path | None = None
    table_points: int = 257
    plot: tuple[str, ...] = ()
    outputs: tuple[str, ...] = ()  # that are wanted; all if it is empty
    designs: tuple[Design, ...] = ()
    film_models: tuple[str, ...] = ()  # of the points that were checked
    share_contacts: bool = False  # whether contacts may be equal in several points


@dataclass(frozen=True, slots=True, kw_only=True)
class Limits:
    """Limits of one point on a worker."""

    seconds: float | None = None  # [s]
    memory: float | None = None  # beside what the program itself takes [GB]


NO_LIMITS = Limits()


@dataclass(frozen=True, slots=True, kw_only=True)
class Task:
    """One point for a worker; `folder` is None where the worker cannot reach the folder of the
    batch.
    """

    key: str
    document: dict[str, Any]
    compute: str
    fields: bool
    share_contacts: bool  # whether contacts may be equal in several points
    folder: str | None
    keys: tuple[str, ...] = ()  # varied, of which the values as run are kept
    tables: str | None = None  # file of traction tables on the machine of the batch
    table_points: int = 257
    outputs: tuple[str, ...] = ()
    limits: Limits = NO_LIMITS
    program: str = field(default_factory=program_digest)


@dataclass(frozen=True, slots=True)
class PointResult:
    """Answer of a worker: record of the point, and files by suffix where it did not write them."""

    record: Record
    files: dict[str, bytes] = field(default_factory=dict)

    @property
    def status(self) -> str:
        """Status of the point: done, failed or lost."""
        return self.record.status
