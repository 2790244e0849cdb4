"""Lubricated contacts: Hertz, Reynolds, elastic deflection; no bearings here."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .conditions import ContactConditions, MoesConditions
from .lubricant import DensityLaw, Lubricant, ViscosityLaw
from .options import SolverOptions
from .solution import ContactSolution, ConvergenceRecord, FilmValue

if TYPE_CHECKING:
    from .solver import solve_contact

__all__ = [
    "ContactConditions",
    "ContactSolution",
    "ConvergenceRecord",
    "DensityLaw",
    "FilmValue",
    "Lubricant",
    "MoesConditions",
    "SolverOptions",
    "ViscosityLaw",
    "solve_contact",
]


def __getattr__(name: str) -> object:
    """Load the solver, and with it SciPy and numba, when it is first asked for."""
    if name == "solve_contact":
        from .solver import solve_contact

        return solve_contact
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
