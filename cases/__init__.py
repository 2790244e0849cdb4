"""Case files, the runs they describe, and the command `oilfilm`."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .case import Case, ContactCase, load_case
    from .problems import CaseError
    from .run import run_case, run_contact

__all__ = ["Case", "CaseError", "ContactCase", "load_case", "run_case", "run_contact"]


def __getattr__(name: str) -> object:
    """Load a part of the package when it is first asked for."""
    if name in ("Case", "ContactCase", "load_case"):
        from . import case

        return getattr(case, name)
    if name in ("run_case", "run_contact"):
        from . import run

        return getattr(run, name)
    if name == "CaseError":
        from .problems import CaseError

        return CaseError
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
