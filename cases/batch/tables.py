"""Traction tables that points of a batch share: which points, over which loads and speeds, made
before the points.

tables/NAME.zip     both races; NAME is a hash of the inputs of all points that share them
"""

import hashlib
import json
import os
import shutil
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any

from bearing.friction.race_tables import LOAD_SPAN, Tables, table_contacts, table_range
from bearing.friction.sources import FilmTraction
from bearing.friction.table_files import save_race_tables
from bearing.geometry import Race
from bearing.operation import BallKinematics
from ehl import Lubricant
from ehl.multigrid.threads import cores
from ehl.oil.rheology import Rheology
from ehl.traction.table.build import TableOptions, build_table
from ehl.traction.table.table import TableRange

from ..format.case import Case, ContactCase, case_of_file
from ..format.document import check_document
from ..format.problems import CaseError
from ..format.traction import fitting_tables, tables_of_file
from ..runs.equilibrium import case_equilibrium
from ..version import version
from .contact_cache import content_key
from .points import Point, Sweep
from .store import TABLES

UNAFFECTED = (
    "title",
    "source",
    "assumed",
    "surface",
    "slip",
    "friction",
    "cage",
    "dynamics",
    "ehl",
)
Progress = Callable[[int, int, str], None]


def needs_tables(case: Case | ContactCase, compute: str) -> bool:
    """Whether a point uses shared tables; torque does unless the case names a law."""
    if not isinstance(case, Case):
        return False
    if compute == "torque":
        return case.traction is None or isinstance(case.traction.source, FilmTraction)
    return (
        compute == "dynamics"
        and case.file.dynamics is not None
        and case.file.dynamics.friction == "table"
    )


def with_equilibrium(document: dict[str, Any]) -> dict[str, Any]:
    """The document of a torque point: traction equilibrium, unless the case says otherwise."""
    model = document.get("model", {})
    if "bearing" not in document or not isinstance(model, dict) or "ball_kinematics" in model:
        return document
    return {
        **document,
        "model": {**model, "ball_kinematics": BallKinematics.TRACTION_EQUILIBRIUM.value},
    }


def bodies_and_oil(case: Case) -> str:
    """Hash of what points that share tables must have in common."""
    try:
        return content_key(
            case.bearing,
            case.lubricant,
            case.rheology,
            case.operation.temperature,
            case.films.solids,
        )
    except TypeError:
        return json.dumps(case.document, sort_keys=True, default=str)


def with_tables(
    points: Sequence[Point], common: dict[int, str], given: str | None, nodes: int
) -> tuple[Point, ...]:
    """The points with the names of their tables, which their own names then depend on, too.

    Parameters
    ----------
    common : dict of str
        By the numbers of the points that need tables, what they must have in common.
    given : str or None
        Hash of the tables that the sweep file names.
    nodes : int
        Of the films of tables to be made [-].
    """
    sharing: dict[str, set[str]] = {}
    for point in points:
        if point.number in common:
            content = {
                key: value for key, value in point.resolved.items() if key not in UNAFFECTED
            }
            text = json.dumps(content, sort_keys=True, ensure_ascii=False, default=str)
            sharing.setdefault(common[point.number], set()).add(text)
    names = {
        same: given or _hash(same, *sorted(texts), str(nodes), version())
        for same, texts in sharing.items()
    }

    def named(point: Point) -> Point:
        tables = names.get(common.get(point.number, ""))
        return (
            point
            if tables is None
            else replace(point, tables=tables, key=_hash(point.key, tables))
        )

    return tuple(map(named, points))


def _hash(*texts: str) -> str:
    return hashlib.sha256("\n".join(texts).encode()).hexdigest()[:20]


def foreign_points(
    path: Path, common: Mapping[int, str], examples: Mapping[str, Case]
) -> dict[str, list[int]]:
    """Points that the tables of a file were not made for, by what is wrong; none of damaged ones,
    which are reported later.

    `common` has by the number of a point what it must have in common with others, `examples` a
    case of each kind.
    """
    try:
        tables = tables_of_file(path)
    except ValueError:
        return {}
    wrong: dict[str, list[int]] = {}
    reasons = {}
    for same, case in examples.items():
        assert case.rheology is not None  # of every bearing case
        oil = (case.lubricant, case.rheology)
        try:
            fitting_tables(tables(*oil), path.name, case.bearing, *oil, case.films.solids)
        except ValueError as problem:
            reasons[same] = str(problem).replace(str(path), path.name)
    for number, same in common.items():
        if same in reasons:
            wrong.setdefault(reasons[same], []).append(number)
    return wrong


def file_hash(path: Path) -> str:
    """Name of given tables, by their content."""
    return hashlib.sha256(path.read_bytes()).hexdigest()[:20]


def table_path(directory: Path, name: str) -> Path:
    """Where the tables of a batch are."""
    return directory / TABLES / f"{name}.zip"


def prepare_tables(
    sweep: Sweep, names: Iterable[str], directory: Path, progress: Progress
) -> dict[str, str]:
    """Make the traction tables that points still to be computed need, those that are there already
    left as they are.

    Parameters
    ----------
    names : iterable of str
        Names of the points.
    directory : Path
        Of the batch.
    progress : callable
        Called with films done, films planned so far, and a word.

    Returns
    -------
    dict of str
        Why tables could not be built, by their name.
    """
    keys = set(names)
    problems = {}
    for name in dict.fromkeys(
        point.tables for point in sweep.points if point.tables and point.key in keys
    ):
        path = table_path(directory, name)
        try:
            if path.exists():
                tables_once(str(path))
            else:
                _put(sweep, name, path, progress)
        except ValueError as error:
            problems[name] = f"no traction tables: {error}"
    return problems


def _put(sweep: Sweep, name: str, path: Path, progress: Progress) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    if sweep.table is None:
        save_race_tables(shared_tables(sweep, name, progress), path)
        return
    tables_of_file(sweep.table)  # damaged ones are reported before anything is copied
    partial = path.with_name(f"{path.name}.partial")
    shutil.copyfile(sweep.table, partial)
    os.replace(partial, path)


def shared_tables(sweep: Sweep, name: str, progress: Progress) -> Tables:
    """Tables over the loads [N] and speeds [m/s] of all points that share them.

    Rolling radii are those of the heaviest contact of each race among all points.
    """
    cases = [case_of_document(point.document) for point in sweep.points if point.tables == name]
    states = []
    for k, case in enumerate(cases):
        progress(k, len(cases), "loads of the points, for traction tables")
        states.append(case_equilibrium(_without_films(case)))
    states = [state for state in states if state.converged]
    if not states:
        raise ValueError("no point that shares them has an equilibrium")
    oil, rheology = cases[0].lubricant, cases[0].rheology
    assert rheology is not None  # of every bearing case
    limits = [table_range(state, oil) for state in states]
    highest = max(limit.load[1] for limit in limits)
    whole = TableRange(
        load=(max(min(limit.load[0] for limit in limits), highest / LOAD_SPAN), highest),
        speed=(min(limit.speed[0] for limit in limits), max(limit.speed[1] for limit in limits)),
    )
    heaviest = max(
        states, key=lambda state: float(max(state.outer_load.max(), state.inner_load.max()))
    )
    options = TableOptions(points=sweep.table_points, workers=cores())
    tables = {}
    for race, contact in table_contacts(
        heaviest, oil, rheology, solids=cases[0].films.solids
    ).items():

        def notify(done: int, total: int, state: str, race: Race = race) -> None:
            progress(done, total, f"traction tables, {race.value} race: {state}")

        tables[race] = build_table(contact, whole, options, notify)
    return tables


def _without_films(case: Case) -> Case:
    """Half and half instead of an equilibrium by films; loads hardly depend on it."""
    if case.traction is None or not isinstance(case.traction.source, FilmTraction):
        return case
    model = case.model
    if model.ball_kinematics is BallKinematics.TRACTION_EQUILIBRIUM:
        model = replace(model, ball_kinematics=BallKinematics.HALF_AND_HALF)
    return replace(case, model=model, traction=None)


def case_of_document(document: dict[str, Any]) -> Case:
    """A point's case, which was checked with the sweep."""
    file, problems = check_document(document)
    if file is None or problems:
        raise CaseError(problem.text("case", {}) for problem in problems)
    case = case_of_file(file, "case")
    assert isinstance(case, Case)  # checked with the sweep
    return case


@lru_cache(maxsize=2)
def tables_once(path: str) -> Callable[[Lubricant, Rheology], Tables]:
    """Tables of both races for an oil and its shear law, the file read once by each worker."""
    return tables_of_file(Path(path))
