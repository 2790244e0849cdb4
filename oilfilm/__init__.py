"""The public interface of the program, by one name: `import oilfilm`.

Every name is loaded when it is first used. The packages stay: `oilfilm.solve_contact`
is `ehl.solve_contact`. What stands here is kept as docs/reference/stability.md says.
"""

from importlib import import_module
from typing import Any

PUBLIC = {
    "Bearing": "bearing",
    "CaseError": "cases",
    "ContactConditions": "ehl",
    "ContactSolution": "ehl",
    "FilmValue": "ehl",
    "Lubricant": "ehl",
    "Material": "bearing",
    "MoesConditions": "ehl",
    "Operation": "bearing",
    "QuasistaticModel": "bearing",
    "SolverOptions": "ehl",
    "atlas_films": "ehl",
    "bearing_life": "bearing",
    "contact_conditions": "bearing",
    "film_formula": "ehl",
    "library_lubricant": "bearing",
    "list_bearings": "bearing",
    "list_lubricants": "bearing",
    "list_materials": "bearing",
    "load_case": "cases",
    "load_catalogue_entry": "bearing",
    "load_material": "bearing",
    "open_results": "postprocess",
    "read_sweep": "cases.batch",
    "run_batch": "cases.batch",
    "run_case": "cases",
    "run_contact": "cases",
    "solve_contact": "ehl",
    "solve_quasistatic": "bearing",
    "summary": "postprocess",
    "write_results": "postprocess",
}
__all__ = sorted(PUBLIC)


def __getattr__(name: str) -> Any:
    """A public name, from the package that it lives in."""
    if name == "__version__":
        return import_module("cases.version").version()
    if name not in PUBLIC:
        raise AttributeError(f"module 'oilfilm' has no attribute {name!r}")
    return getattr(import_module(PUBLIC[name]), name)


def __dir__() -> list[str]:
    """The public names."""
    return [*__all__, "__version__"]
