from .atlas.arrays import ContactArrays, FilmArrays, atlas_arrays
from .atlas.film_formula import film_formula
from .atlas.films import AtlasFilms, AtlasValue, atlas_films
from .closed_form.hertz import hertz_contact
from .conditions import ContactConditions, MoesConditions
from .finite_element.solver import solve_contact_finite_element
from .oil.lubricant import DensityLaw, InletLayer, Lubricant, ViscosityLaw
from .options import SolverOptions
from .solution import ContactSolution, ConvergenceRecord, FilmValue, OilSupply
from .solver import solve_contact
from .traction.shear import integrate_traction
from .traction_table.build import build_traction_table
from .traction_table.table import TractionTable
from .transient.run import solve_transient

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
    "TractionTable",
    "ViscosityLaw",
    "atlas_arrays",
    "atlas_films",
    "build_traction_table",
    "film_formula",
    "hertz_contact",
    "integrate_traction",
    "solve_contact",
    "solve_contact_finite_element",
    "solve_transient",
]
