"""The public interface of the program, by one name: `import oilfilm`.

Every name is loaded when it is first used. The packages stay: `oilfilm.solve_contact`
is `oilfilm.ehl.solve_contact`. What stands here is kept as docs/reference/stability.md says.
"""

from importlib import import_module
from pathlib import Path
from typing import Any

PUBLIC = {
    "Bearing": "oilfilm.bearing",
    "Case": "oilfilm.cases",
    "CaseError": "oilfilm.cases",
    "ContactConditions": "oilfilm.ehl",
    "ContactFilm": "oilfilm.bearing",
    "ContactSolution": "oilfilm.ehl",
    "Lubricant": "oilfilm.ehl",
    "Material": "oilfilm.bearing",
    "MoesConditions": "oilfilm.ehl",
    "Operation": "oilfilm.bearing",
    "QuasistaticModel": "oilfilm.bearing",
    "SolverOptions": "oilfilm.ehl",
    "TorqueBreakdown": "oilfilm.bearing",
    "TractionTable": "oilfilm.ehl",
    "atlas_films": "oilfilm.ehl",
    "bearing_frequencies": "oilfilm.bearing",
    "bearing_life": "oilfilm.bearing",
    "build_traction_table": "oilfilm.ehl",
    "contact_conditions": "oilfilm.bearing",
    "contact_films": "oilfilm.bearing",
    "film_formula": "oilfilm.ehl",
    "friction_torque": "oilfilm.bearing",
    "hertz_contact": "oilfilm.ehl",
    "integrate_traction": "oilfilm.ehl",
    "list_bearings": "oilfilm.bearing",
    "list_lubricants": "oilfilm.bearing",
    "list_materials": "oilfilm.bearing",
    "load_bearing": "oilfilm.bearing",
    "load_case": "oilfilm.cases",
    "load_lubricant": "oilfilm.bearing",
    "load_material": "oilfilm.bearing",
    "open_results": "oilfilm.postprocess",
    "read_sweep": "oilfilm.cases.batch",
    "run": "oilfilm.cases",
    "run_batch": "oilfilm.cases.batch",
    "run_case": "oilfilm.cases",
    "run_contact": "oilfilm.cases",
    "simulate": "oilfilm.bearing",
    "solve_contact": "oilfilm.ehl",
    "solve_contact_finite_element": "oilfilm.ehl",
    "solve_quasistatic": "oilfilm.bearing",
    "solve_transient": "oilfilm.ehl",
    "summary": "oilfilm.postprocess",
    "temperatures": "oilfilm.cases",
    "view": "oilfilm.postprocess",
    "write_results": "oilfilm.postprocess",
}
PARTS = ("ehl", "bearing", "postprocess", "cases")
__all__ = sorted(PUBLIC)

if not (Path(__file__).parent / "ehl").is_dir():  # in a checkout they lie beside this folder
    __path__.append(str(Path(__file__).parents[1]))


def __getattr__(name: str) -> Any:
    """A public name, from the package that it lives in."""
    if name == "__version__":
        return import_module("oilfilm.ehl.version").version()
    if name in PARTS:
        return import_module(f"oilfilm.{name}")
    if name not in PUBLIC:
        raise AttributeError(f"module 'oilfilm' has no attribute {name!r}")
    return getattr(import_module(PUBLIC[name]), name)


def __dir__() -> list[str]:
    """The public names."""
    return [*__all__, "__version__"]
