from .atlas.arrays import ContactArrays, FilmArrays, atlas_arrays
from .atlas.film_formula import film_formula
from .atlas.films import AtlasFilms, AtlasValue, atlas_films
from .conditions import ContactConditions, MoesConditions
from .oil.lubricant import DensityLaw, InletLayer, Lubricant, ViscosityLaw
from .options import SolverOptions
from .solution import ContactSolution, ConvergenceRecord, FilmValue, OilSupply
from .solver import solve_contact

__all__ = [
    "AtlasFilms",
    "AtlasValue",
    "ContactArrays",
    "ContactConditions",
    "ContactSolution",
    "ConvergenceRecord",
    "DensityLaw",
    "FilmArrays",
    "FilmValue",
    "InletLayer",
    "Lubricant",
    "MoesConditions",
    "OilSupply",
    "SolverOptions",
    "ViscosityLaw",
    "atlas_arrays",
    "atlas_films",
    "film_formula",
    "solve_contact",
]
