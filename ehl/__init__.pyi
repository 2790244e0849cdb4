from .conditions import ContactConditions, MoesConditions
from .oil.lubricant import DensityLaw, Lubricant, ViscosityLaw
from .options import SolverOptions
from .solution import ContactSolution, ConvergenceRecord, FilmValue
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
