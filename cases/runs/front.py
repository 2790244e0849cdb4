"""One call from a designation, a file or a case to results: `oilfilm.run`."""

import re
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

from oilfilm.bearing.library.bearings import catalogue_name
from oilfilm.ehl.multigrid.threads import cores
from oilfilm.postprocess.run_result import RunResult

from ..format.case import Case, ContactCase, case_from_text, load_case
from ..format.document import BearingFile, ContactFile
from ..format.fields import is_number
from ..format.lubricant import SHEET, VISCOSITIES
from ..format.rules import CaseError, nearest_name
from ..format.shipped import shipped_cases
from ..new_case import FirstOperation, case_of_designation
from .bearing import run_case
from .contact import run_contact

SHORT = {  # words for keys that are asked for most
    "speed_rpm": "operation.inner_speed_rpm",
    "outer_speed_rpm": "operation.outer_speed_rpm",
    "radial_N": "operation.radial_load_N",
    "axial_N": "operation.axial_load_N",
    "oil": "lubricant.name",
}
NUMBERED = re.compile(r"[\w ]*\d{3}[^.\\]*$")  # a designation, known or not
FIRST = ("table", "operation", "lubricant", "bearing", "friction", "contact", "ehl", "surface")


def run(
    what: str | Path | Case | ContactCase, /, *, workers: int | None = None, **values: Any
) -> RunResult:
    """Compute a bearing or a contact: films, torque, temperatures, life.

    Parameters
    ----------
    what : str | Path | Case | ContactCase
        Designation of a bearing, path of a case file, name of a shipped case, or a case.
    workers : int | None, optional
        Contacts solved at a time [-]; None: as many as there are cores.
    **values : Any
        Values of keys of the case, whose names end in their unit: `speed_rpm`, `radial_N`,
        `axial_N`, `outer_speed_rpm`, `oil`, and every key of a case file that stands in one table
        alone, as `temperature_C` or `ambient_C`; others as `{"table.key": value}` by
        `Case.with_values`.

    Returns
    -------
    RunResult
        The results; its main numbers are SI.

    Raises
    ------
    CaseError
        If there is no such bearing or case, or a value is wrong.

    Examples
    --------
    >>> import oilfilm
    >>> r = oilfilm.run("6306-2Z/C3", speed_rpm=3000, radial_N=800)  # doctest: +SKIP
    >>> r.film_minimum, r.torque, r.temperature  # doctest: +SKIP
    >>> oilfilm.run("moes_20_10").converged
    True
    """
    case = _case(what, values)
    if isinstance(case, ContactCase):
        return RunResult(run_contact(case, workers=workers or cores()))
    return RunResult(run_case(case, workers))


def _case(what: str | Path | Case | ContactCase, values: Mapping[str, Any]) -> Case | ContactCase:
    """The case that is meant, with its values."""
    if isinstance(what, Case | ContactCase):
        return _changed(what, values)
    name = str(what)
    is_file = Path(name).is_file() or Path(f"{name}.toml").is_file()
    is_case = is_file or name.removesuffix(".toml") in shipped_cases()
    if is_case or (catalogue_name(name) is None and not NUMBERED.match(name)):
        return _changed(load_case(what), values)
    numbers = (values.get(key) for key in ("speed_rpm", "radial_N", "axial_N"))
    speed, radial, axial = (value if is_number(value) else None for value in numbers)
    first = FirstOperation(speed=speed, radial_load=radial, axial_load=axial)
    try:
        text = case_of_designation(name, first)
    except ValueError as error:
        raise CaseError(str(error)) from error
    return _changed(case_from_text(text, name), values)


def _changed(case: Case | ContactCase, values: Mapping[str, Any]) -> Case | ContactCase:
    """The case with values by keywords."""
    if not values:
        return case
    given = {_dotted(key, case): value for key, value in values.items()}
    viscosities = (*VISCOSITIES, *SHEET)
    oil = {"lubricant.name", *(f"lubricant.{key}" for key in viscosities)} & given.keys()
    if oil and "lubricant" in case.given:  # in place of the one chosen
        others = {"grease", "name", *viscosities} & case.given["lubricant"].keys()
        given = {**{f"lubricant.{key}": None for key in others}, **given}
    return case.with_values(given)


def _dotted(word: str, case: Case | ContactCase) -> str:
    """Dotted name of a key by its last part."""
    if word in SHORT:
        return SHORT[word]
    if "." in word:
        return word
    tables = _tables_of(isinstance(case, Case))
    homes = [table for table in tables if word in tables[table]]
    if len(homes) > 1:
        homes = [table for table in FIRST if table in homes][:1] or homes
    if len(homes) != 1:
        known = [*SHORT, *(key for keys in tables.values() for key in keys)]
        nearest = nearest_name(word, known)
        hint = f"did you mean {nearest!r}?" if nearest else "see docs/reference/cases.md"
        raise CaseError(f"{word}: unknown keyword; {hint}")
    return f"{homes[0]}.{word}"


@cache
def _tables_of(bearing: bool) -> dict[str, tuple[str, ...]]:
    """Keys of the tables of a case file."""
    tables = {}
    for name, field in (BearingFile if bearing else ContactFile).model_fields.items():
        for kind in (field.annotation, *getattr(field.annotation, "__args__", ())):
            if hasattr(kind, "model_fields"):
                tables[name] = tuple(kind.model_fields)
    return tables
