"""Output: results on disk, pictures, VTK, tables; nothing is computed here."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .reader import open_results
    from .results import BearingResults, ContactResults
    from .summaries import summary
    from .writer import write_results

__all__ = ["BearingResults", "ContactResults", "open_results", "summary", "write_results"]

_HOMES = {
    "BearingResults": "results",
    "ContactResults": "results",
    "summary": "summaries",
    "open_results": "reader",
    "write_results": "writer",
}


def __getattr__(name: str) -> object:
    """Load a submodule, and the libraries it needs, when a name of it is first asked for."""
    if name in _HOMES:
        return getattr(import_module(f".{_HOMES[name]}", __name__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
