"""A sweep, its points, and what a worker is sent and sends back: plain data."""

from dataclasses import dataclass, field
from pathlib import Path as FilePath
from typing import Any

from ..version import version


@dataclass(frozen=True, slots=True, kw_only=True)
class Point:
    """One point of a sweep, checked."""

    number: int  # counted from 1, in the order of the file
    block: str  # block of the sweep file it comes from
    # every key that the sweep varies somewhere, with its value here; None where the case does not
    # have it
    values: dict[str, Any]
    document: dict[str, Any]  # the case with these values, as to be run
    resolved: dict[str, Any]  # the same, defaults and library values filled in
    key: str  # name in the batch's folder: equal for points whose results are equal
    # name of the traction tables it needs; equal for points that share them
    tables: str | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Sweep:
    """A sweep ready to run: text of the file, name of the case, file of tables, points."""

    text: str
    title: str
    case: str
    compute: str
    fields: bool
    keys: tuple[str, ...]
    points: tuple[Point, ...]
    messages: tuple[str, ...] = ()
    assumed: tuple[str, ...] = ()
    table: FilePath | None = None
    table_points: int = 257
    plot: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Task:
    """What a worker computes; `folder` is None where it cannot reach the folder of the batch."""

    key: str
    document: dict[str, Any]
    compute: str
    fields: bool
    share: bool  # whether contacts may be equal in several points
    folder: str | None
    tables: str | None = None  # file of traction tables on the machine of the batch
    table_points: int = 257
    program: str = field(default_factory=version)


@dataclass(frozen=True, slots=True)
class Receipt:
    """Answer of a worker: status, and files where it did not write them."""

    status: str
    files: dict[str, bytes] = field(default_factory=dict)
