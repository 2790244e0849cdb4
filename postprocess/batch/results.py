"""Results of a batch, point by point."""

from dataclasses import dataclass, field
from typing import Any

from ehl.units import notebook_html

from ..text import number
from .main_results import BATCH_COLUMNS, main_results

MOST_SHOWN = 20  # points in a notebook; the files have all


@dataclass(frozen=True, slots=True, kw_only=True)
class BatchPoint:
    """One point: its place in the sweep, the values varied, how it ended, and any summary."""

    number: int
    block: str
    values: dict[str, Any]
    case: dict[str, Any]
    key: str
    resumed: bool
    status: str
    message: str
    summary: dict[str, Any] | None

    @property
    def converged(self) -> bool:
        """True if the point was computed and everything in it converged."""
        return self.summary is not None and bool(self.summary.get("converged"))

    @property
    def label(self) -> str:
        """The varied values in words."""
        return ", ".join(f"{key} = {value}" for key, value in self.values.items())


@dataclass(frozen=True, slots=True, kw_only=True)
class Design:
    """A block of points that belong together: its keys, and the samples or trajectories of it.

    `start`: place of its first point among all, counted from 0.
    """

    block: str
    keys: tuple[str, ...]
    samples: int
    start: int = 0
    ranges: tuple[tuple[float, float], ...] = ()  # of the keys, in their units


@dataclass(frozen=True, slots=True, kw_only=True)
class Counts:
    """How the points of a batch ended."""

    points: int
    done: int
    failed: int
    lost: int
    missing: int
    converged: int
    resumed: int
    reasons: tuple[tuple[str, int], ...] = ()  # messages of those without a result, most first


@dataclass(frozen=True, slots=True, kw_only=True)
class BatchResults:
    """A whole batch: `sweep` is the text of its file, `case` the name of the case it varies.

    `plot`: names of the numbers that its file wants to be drawn.
    """

    version: str
    title: str
    case: str
    sweep: str
    keys: tuple[str, ...]
    points: tuple[BatchPoint, ...]
    messages: tuple[str, ...] = ()
    assumed: tuple[str, ...] = ()
    plot: tuple[str, ...] = ()
    timing: dict[str, float] = field(default_factory=dict)
    with_json: bool = False  # whether the summary of each point is a file, too
    designs: tuple[Design, ...] = ()
    counts: Counts | None = None  # of all points, where `points` are only some of them

    @property
    def converged(self) -> bool:
        """True if every point converged."""
        if self.counts is not None:
            return self.counts.converged == self.counts.points
        return all(point.converged for point in self.points)

    def _repr_html_(self) -> str:
        """How the points ended, and main results of the first ones, for a notebook."""
        first = self.points[:MOST_SHOWN]
        main = [main_results(point.summary) for point in first]
        shown = [name for name in BATCH_COLUMNS if any(row.get(name) is not None for row in main)]
        columns = {"point": [str(point.number) for point in first]}
        for names, rows in ((self.keys, [point.values for point in first]), (shown, main)):
            columns |= {name: [number(row.get(name), ".5g") for row in rows] for name in names}
        columns["ended"] = [_ended(point) for point in first]
        count = len(self.points) if self.counts is None else self.counts.points
        facts = {"points": str(count), "converged": str(self.converged)}
        if count > len(first):
            facts["shown"] = f"the first {len(first)}"
        return notebook_html(self.title or "Batch", facts, columns)


def _ended(point: BatchPoint) -> str:
    if point.summary is None:
        return f"{point.status}: {point.message}"
    return "converged" if point.converged else "not converged"
