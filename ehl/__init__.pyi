from .conditions import ContactConditions, MoesConditions
from .oil.inlet_layer import InletLayer
from .oil.lubricant import DensityLaw, Lubricant, ViscosityLaw
from .options import SolverOptions
from .solution import ContactSolution, ConvergenceRecord, FilmValue, OilSupply
from .solver import solve_contact

__all__ = [
    "ContactConditions",
    "ContactSolution",
    "ConvergenceRecord",
    "DensityLaw",
    "FilmValue",
    "InletLayer",
    "Lubricant",
    "MoesConditions",
    "OilSupply",
    "SolverOptions",
    "ViscosityLaw",
    "solve_contact",
]
