from bearing import Bearing as Bearing
from bearing import Material as Material
from bearing import Operation as Operation
from bearing import QuasistaticModel as QuasistaticModel
from bearing import bearing_life as bearing_life
from bearing import contact_conditions as contact_conditions
from bearing import library_lubricant as library_lubricant
from bearing import list_bearings as list_bearings
from bearing import list_lubricants as list_lubricants
from bearing import list_materials as list_materials
from bearing import load_catalogue_entry as load_catalogue_entry
from bearing import load_material as load_material
from bearing import solve_quasistatic as solve_quasistatic
from cases import CaseError as CaseError
from cases import load_case as load_case
from cases import run_case as run_case
from cases import run_contact as run_contact
from cases.batch import read_sweep as read_sweep
from cases.batch import run_batch as run_batch
from ehl import ContactConditions as ContactConditions
from ehl import ContactSolution as ContactSolution
from ehl import FilmValue as FilmValue
from ehl import Lubricant as Lubricant
from ehl import MoesConditions as MoesConditions
from ehl import SolverOptions as SolverOptions
from ehl import atlas_films as atlas_films
from ehl import film_formula as film_formula
from ehl import solve_contact as solve_contact
from postprocess import open_results as open_results
from postprocess import summary as summary
from postprocess import write_results as write_results

PUBLIC: dict[str, str]
__version__: str
__all__: list[str]
