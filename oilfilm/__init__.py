"""The public interface of the program, by one name: `import oilfilm`.

Every name is loaded when it is first used. The packages stay: `oilfilm.solve_contact`
is `oilfilm.ehl.solve_contact`. What stands here is kept as docs/reference/stability.md says.
"""

from importlib import import_module
from pathlib import Path
from typing import Any

PUBLIC = {
    "Bearing": "oilfilm.bearing",
    "CaseError": "oilfilm.cases",
    "ContactConditions": "oilfilm.ehl",
    "ContactSolution": "oilfilm.ehl",
    "FilmValue": "oilfilm.ehl",
    "Lubricant": "oilfilm.ehl",
    "Material": "oilfilm.bearing",
    "MoesConditions": "oilfilm.ehl",
    "Operation": "oilfilm.bearing",
    "QuasistaticModel": "oilfilm.bearing",
    "SolverOptions": "oilfilm.ehl",
    "atlas_films": "oilfilm.ehl",
    "bearing_life": "oilfilm.bearing",
    "contact_conditions": "oilfilm.bearing",
    "film_formula": "oilfilm.ehl",
    "library_lubricant": "oilfilm.bearing",
    "list_bearings": "oilfilm.bearing",
    "list_lubricants": "oilfilm.bearing",
    "list_materials": "oilfilm.bearing",
    "load_case": "oilfilm.cases",
    "load_catalogue_entry": "oilfilm.bearing",
    "load_material": "oilfilm.bearing",
    "open_results": "oilfilm.postprocess",
    "read_sweep": "oilfilm.cases.batch",
    "run_batch": "oilfilm.cases.batch",
    "run_case": "oilfilm.cases",
    "run_contact": "oilfilm.cases",
    "solve_contact": "oilfilm.ehl",
    "solve_quasistatic": "oilfilm.bearing",
    "summary": "oilfilm.postprocess",
    "write_results": "oilfilm.postprocess",
}
PARTS = ("ehl", "bearing", "postprocess", "cases")
__all__ = sorted(PUBLIC)

if not (Path(__file__).parent / "ehl").is_dir():  # in a checkout they lie beside this folder
    __path__.append(str(Path(__file__).parents[1]))


def __getattr__(name: str) -> Any:
    """A public name, from the package that it lives in."""
    if name == "__version__":
        return import_module("oilfilm.cases.version").version()
    if name in PARTS:
        return import_module(f"oilfilm.{name}")
    if name not in PUBLIC:
        raise AttributeError(f"module 'oilfilm' has no attribute {name!r}")
    return getattr(import_module(PUBLIC[name]), name)


def __dir__() -> list[str]:
    """The public names."""
    return [*__all__, "__version__"]
