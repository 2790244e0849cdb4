from oilfilm.bearing import Bearing as Bearing
from oilfilm.bearing import Material as Material
from oilfilm.bearing import Operation as Operation
from oilfilm.bearing import QuasistaticModel as QuasistaticModel
from oilfilm.bearing import bearing_life as bearing_life
from oilfilm.bearing import contact_conditions as contact_conditions
from oilfilm.bearing import library_lubricant as library_lubricant
from oilfilm.bearing import list_bearings as list_bearings
from oilfilm.bearing import list_lubricants as list_lubricants
from oilfilm.bearing import list_materials as list_materials
from oilfilm.bearing import load_catalogue_entry as load_catalogue_entry
from oilfilm.bearing import load_material as load_material
from oilfilm.bearing import solve_quasistatic as solve_quasistatic
from oilfilm.cases import CaseError as CaseError
from oilfilm.cases import load_case as load_case
from oilfilm.cases import run_case as run_case
from oilfilm.cases import run_contact as run_contact
from oilfilm.cases.batch import read_sweep as read_sweep
from oilfilm.cases.batch import run_batch as run_batch
from oilfilm.ehl import ContactConditions as ContactConditions
from oilfilm.ehl import ContactSolution as ContactSolution
from oilfilm.ehl import FilmValue as FilmValue
from oilfilm.ehl import Lubricant as Lubricant
from oilfilm.ehl import MoesConditions as MoesConditions
from oilfilm.ehl import SolverOptions as SolverOptions
from oilfilm.ehl import atlas_films as atlas_films
from oilfilm.ehl import film_formula as film_formula
from oilfilm.ehl import solve_contact as solve_contact
from oilfilm.postprocess import open_results as open_results
from oilfilm.postprocess import summary as summary
from oilfilm.postprocess import write_results as write_results

PUBLIC: dict[str, str]
__version__: str
__all__: list[str]
