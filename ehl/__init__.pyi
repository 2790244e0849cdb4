from .closed_form.film_formula import film_formula
from .conditions import ContactConditions, MoesConditions
from .oil.inlet_layer import InletLayer
from .oil.lubricant import DensityLaw, Lubricant, ViscosityLaw
from .options import SolverOptions
from .solution import ContactSolution, ConvergenceRecord, FilmValue, OilSupply
from .solver import solve_contact
from .traction.atlas.arrays import ContactArrays, FilmArrays, atlas_arrays
from .traction.atlas.films import AtlasFilms, AtlasValue, atlas_films

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
