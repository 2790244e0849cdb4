"""Differences of two results."""

from dataclasses import dataclass
from math import inf
from typing import Any


@dataclass(frozen=True, slots=True, kw_only=True)
class Difference:
    """One value in both results."""

    path: str
    first: Any
    second: Any
    relative: float | None  # second less first over the magnitude [-]
    over_bars: float | None = None  # second less first over both error bars [-]; None without

    @property
    def covered(self) -> bool | None:
        """True if the error bars of both enclose the difference; None without them."""
        return None if self.over_bars is None else abs(self.over_bars) <= 1.0

    @property
    def differs(self) -> bool:
        """True if the two are not the same."""
        return self.first != self.second

    def document(self) -> dict[str, Any]:
        """The difference as plain JSON types."""
        values = {"path": self.path, "first": self.first, "second": self.second}
        values |= {"relative": self.relative, "within_error_bars": self.covered}
        return values | {"over_error_bars": self.over_bars}


@dataclass(frozen=True, slots=True, kw_only=True)
class Comparison:
    """Differences of two result folders; `main` are the main results, equal ones included.

    Nodes, boxes, iterations and error bars are not compared; whether a result converged is.
    """

    names: tuple[str, str]
    versions: tuple[str, str]
    converged: tuple[bool, bool]
    inputs: tuple[Difference, ...]
    main: tuple[Difference, ...]
    results: tuple[Difference, ...]

    @property
    def largest(self) -> float:
        """Largest relative difference of a result [-]; infinite if one of them has it alone."""
        sizes = (inf if d.relative is None else abs(d.relative) for d in self.results)
        return max(sizes, default=0.0)

    def document(self) -> dict[str, Any]:
        """The comparison as plain JSON types."""
        return {
            "names": list(self.names),
            "oilfilm": list(self.versions),
            "converged": list(self.converged),
            "largest_relative_difference": None if self.largest == inf else self.largest,
            "inputs": [difference.document() for difference in self.inputs],
            "main": [difference.document() for difference in self.main],
            "results": [difference.document() for difference in self.results],
        }
