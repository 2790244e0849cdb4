"""Results that points of a batch share: traction tables, contacts, films of tables under way.

tables/NAME.zip     both races; NAME is a hash of the inputs of all points that share them

Each stands in a file of its own, named after all it depends on; `oilfilm.ehl.data_files` reads it.
"""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any, TypeVar

from oilfilm.bearing.friction.friction_sources import FilmTraction
from oilfilm.bearing.friction.tables import (
    LOAD_SPAN,
    Tables,
    race_progress,
    save_race_tables,
    table_contacts,
    table_range,
)
from oilfilm.ehl import ContactConditions, ContactSolution, Lubricant, SolverOptions
from oilfilm.ehl.data_files import object_as_bytes, read_object
from oilfilm.ehl.foreign_files import DamagedFileError, read_file
from oilfilm.ehl.multigrid.threads import cores
from oilfilm.ehl.traction_table.build import TableOptions, build_traction_table
from oilfilm.ehl.traction_table.film import FilmSample, film_sample
from oilfilm.ehl.traction_table.table import TableContact, TableRange

from ..format.case import Case, ContactCase, case_of_document
from ..format.film_model import FilmPhysics
from ..format.shaft_case import ShaftCase
from ..format.traction import require_fitting_tables, tables_of_file
from ..runs.equilibrium import Equilibria, case_equilibrium, without_traction_equilibrium
from ..runs.films import Progress
from ..runs.interrupt import print_message
from ..runs.traction_table import asked_films, films_of_atlas
from .keys import (
    NOT_IN_TRACTION_TABLES,
    TABLES,
    content_key,
    digest,
    document_text,
    program_digest,
)
from .points import Point, Sweep
from .store import write_file

SUFFIX = ".contact"
MOST_BYTES = 4_000_000_000  # the contacts of a batch grow no further
# written by this process between two looks at how large all of them are: the looks of a batch take
# a time that grows with its contacts, not with their square [bytes]
BETWEEN = MOST_BYTES // 40
Solver = Callable[[ContactConditions, SolverOptions, FilmPhysics], ContactSolution]
Place = tuple[float, float]
T = TypeVar("T")


def store_object(path: Path, thing: object) -> int:
    """Write an object to a file, whole or not at all.

    Parameters
    ----------
    path : Path
        The file.
    thing : object
        A dataclass of `ehl`.

    Returns
    -------
    int
        Size of the file [bytes].
    """
    data = object_as_bytes(thing, path.stem)
    write_file(path, data)
    return len(data)


def load_object(path: Path, kind: type[T]) -> T | None:
    """Read an object from a file.

    Parameters
    ----------
    path : Path
        The file.
    kind : type[T]
        Class of the object.

    Returns
    -------
    T | None
        The object; None where there is no file, or it is damaged.
    """
    try:
        return read_object(path, kind)
    except (OSError, DamagedFileError):
        return None


class ContactCache:
    """The contacts of a folder: looked up there first, and left there when they are solved."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._free = 0  # bytes that may be written before the next look

    def solve(
        self, conditions: ContactConditions, options: SolverOptions, films: FilmPhysics
    ) -> ContactSolution:
        """The film of a contact by a film model, from disk where it was solved before.

        Parameters
        ----------
        conditions : ContactConditions
            The contact.
        options : SolverOptions
            Grid of the solver.
        films : FilmPhysics
            Film model.

        Returns
        -------
        ContactSolution
            The film [m] and the pressure [Pa].
        """
        try:
            path = self.folder / f"{content_key(conditions, options, films)}{SUFFIX}"
        except TypeError:
            return films.solve(conditions, options)
        known = load_object(path, ContactSolution)
        if known is not None:
            return known
        if path.exists():
            print_message(f"oilfilm: {path}: damaged; the contact is solved anew")
        solution = films.solve(conditions, options)
        if self._free > 0 or self._look():
            self._free -= store_object(path, solution)
        return solution

    def _look(self) -> bool:
        """Tell whether the cache may grow further."""
        used = sum(file.stat().st_size for file in self.folder.glob(f"*{SUFFIX}"))
        self._free = BETWEEN if used < MOST_BYTES else 0
        return self._free > 0


def stored_film_sampler(
    folder: Path,
) -> Callable[[TableContact, TableRange, Place, int, bool], FilmSample]:
    """A film sampler that reads solved films from a folder and stores new ones there.

    A damaged file is solved anew; OSError where the disk is full, and hence no table either.

    Parameters
    ----------
    folder : Path
        Folder of the films.

    Returns
    -------
    Callable[[TableContact, TableRange, Place, int, bool], FilmSample]
        Function with the parameters of `film_sample`.
    """

    def sample(
        contact: TableContact, limits: TableRange, place: Place, points: int, response: bool = True
    ) -> FilmSample:
        path = folder / f"{content_key(contact, limits, place, points, response)}.film"
        found = load_object(path, FilmSample)
        if found is None:
            found = film_sample(contact, limits, place, points, response)
            folder.mkdir(parents=True, exist_ok=True)
            store_object(path, found)
        return found

    return sample


def needs_tables(case: Case | ContactCase | ShaftCase, compute: str, *, asked: bool) -> bool:
    """Tell whether a point uses shared tables: a simulation by tables; torque where the sweep or
    the case asks for them, and in traction equilibrium, unless the case names a law.

    Parameters
    ----------
    case : Case | ContactCase | ShaftCase
        The case of the point.
    compute : str
        Quantity that is computed.
    asked : bool
        True: the sweep asks for tables.

    Returns
    -------
    bool
        True if it does.
    """
    if not isinstance(case, Case):
        return False
    if compute == "torque":
        if case.traction is None:
            return asked or films_of_atlas(case)
        return isinstance(case.traction.source, FilmTraction)
    simulated = case.file.dynamics
    return compute == "dynamics" and simulated is not None and simulated.friction == "table"


def bodies_and_oil(case: Case) -> str:
    """Hash of the inputs that points with common tables must agree in.

    Parameters
    ----------
    case : Case
        The case of a point.

    Returns
    -------
    str
        Hash of bearing, oil, shear law and temperature.
    """
    temperature = case.operation.temperature
    try:
        films = case.file.friction.table_films
        return content_key(
            case.bearing, case.lubricant, case.rheology, temperature, case.films.solids, films
        )
    except TypeError:
        return document_text(case.document)


def with_table_names(
    points: Sequence[Point],
    sharing: Sequence[str | None],
    documents: Sequence[dict[str, Any]],
    given: str | None,
    nodes: int,
) -> tuple[Point, ...]:
    """The points with the names of their tables, which their own names then depend on, too.

    Parameters
    ----------
    points : sequence of Point
        All points of the sweep.
    sharing : sequence of (str or None)
        What the tables of each must have in common; None of those that need none.
    documents : sequence of dict
        Of each, as run.
    given : str or None
        Hash of the tables that the sweep file names.
    nodes : int
        Nodes of the films of tables to be made [-].
    """
    texts: dict[str, set[str]] = {}
    for common, document in zip(sharing, documents, strict=True):
        if common is not None:
            text = document_text(document, NOT_IN_TRACTION_TABLES)
            texts.setdefault(common, set()).add(text)
    names = {
        common: given or digest(common, *sorted(own), str(nodes), program_digest())
        for common, own in texts.items()
    }

    def named(point: Point, common: str | None) -> Point:
        if common is None:
            return point
        name = names[common]
        return replace(point, tables=name, key=digest(point.key, name))

    return tuple(map(named, points, sharing))


def foreign_points(
    path: Path, sharing: Mapping[int, str], examples: Mapping[str, Case]
) -> dict[str, list[int]]:
    """Points whose bearing or oil is not that of the tables of a file.

    Parameters
    ----------
    path : Path
        The file; a damaged one is reported later.
    sharing : Mapping[int, str]
        Hash of the inputs of the tables, by number of the point.
    examples : Mapping[str, Case]
        A case for each of these hashes.

    Returns
    -------
    dict[str, list[int]]
        Numbers of the points by the reason.
    """
    try:
        tables = tables_of_file(path)
    except ValueError:
        return {}
    wrong: dict[str, list[int]] = {}
    for common, case in examples.items():
        assert case.rheology is not None  # of every bearing case
        oil = (case.lubricant, case.rheology)
        try:
            require_fitting_tables(
                tables(case.lubricant), path.name, case.bearing, *oil, case.films.solids
            )
        except ValueError as problem:
            numbers = [number for number, name in sharing.items() if name == common]
            wrong.setdefault(str(problem).replace(str(path), path.name), []).extend(numbers)
    return {reason: sorted(numbers) for reason, numbers in wrong.items()}


def table_path(directory: Path, name: str) -> Path:
    """File of the traction tables of a batch.

    Parameters
    ----------
    directory : Path
        Folder of the batch.
    name : str
        Name of the tables.

    Returns
    -------
    Path
        The path.
    """
    return directory / TABLES / f"{name}.zip"


def prepare_tables(
    sweep: Sweep, keys: Collection[str], directory: Path, progress: Progress
) -> dict[str, str]:
    """Make the traction tables that points still to be computed need, those that are there already
    left as they are.

    Parameters
    ----------
    sweep : Sweep
        The points.
    keys : Collection[str]
        Names of the points.
    directory : Path
        Folder of the batch.
    progress : Progress
        Called with films done, films planned so far, and a text.

    Returns
    -------
    dict of str
        Why tables could not be built, by their name.
    """
    problems = {}
    wanted = (point.tables for point in sweep.points if point.key in keys)
    for name in dict.fromkeys(name for name in wanted if name is not None):
        path = table_path(directory, name)
        try:
            if not _whole(path):
                _put(sweep, name, path, progress)
        except ValueError as error:
            problems[name] = f"no traction tables: {error}"
    return problems


def _whole(path: Path) -> bool:
    """Tell whether tables exist and can be read; damaged ones are reported."""
    if not path.exists():
        return False
    try:
        tables_once(str(path))
    except ValueError:
        print_message(f"oilfilm: {path}: damaged; the traction tables are made anew")
        return False
    return True


def _put(sweep: Sweep, name: str, path: Path, progress: Progress) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    if sweep.table is None:
        save_race_tables(shared_tables(sweep, name, progress), path)
        return
    tables_of_file(sweep.table)  # damaged ones are reported before anything is copied
    write_file(path, read_file(sweep.table))


def shared_tables(sweep: Sweep, name: str, progress: Progress) -> Tables:
    """Build tables over the loads and speeds of all points that share them.

    Rolling radii are those of the heaviest contact of each race among all points.

    Parameters
    ----------
    sweep : Sweep
        The points.
    name : str
        Name of the tables.
    progress : Progress
        Called with films done, films planned so far, and a text.

    Returns
    -------
    Tables
        Tables of both races, over [N] and [m/s].

    Raises
    ------
    ValueError
        If no point has an equilibrium.
    """
    cases = [_bearing_case(point) for point in sweep.points if point.tables == name]
    states = []
    equilibria = Equilibria()
    for k, case in enumerate(cases):
        progress(k, len(cases), "loads of the points, for traction tables")
        states.append(case_equilibrium(_without_films(case), equilibria))
    states = [state for state in states if state.converged]
    if not states:
        raise ValueError("no point that shares them has an equilibrium")
    oil = cases[0].lubricant
    rheology = cases[0].rheology
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
    sample = asked_films(cases[0])
    options = TableOptions(
        points=sweep.table_points, workers=cores(), sample=sample, narrow=films_of_atlas(cases[0])
    )
    contacts = table_contacts(heaviest, oil, rheology, solids=cases[0].films.solids)

    def notify(done: int, total: int, state: str) -> None:
        progress(done, total, f"traction tables, {state}")

    return {
        race: build_traction_table(contact, whole, options, race_progress(notify, race))
        for race, contact in contacts.items()
    }


def _bearing_case(point: Point) -> Case:
    case = case_of_document(point.document)
    assert isinstance(case, Case)  # checked with the sweep
    return case


def _without_films(case: Case) -> Case:
    """The case without films behind its equilibrium; loads hardly depend on them."""
    if case.traction is None or not isinstance(case.traction.source, FilmTraction):
        return case
    return replace(case, model=without_traction_equilibrium(case.model), traction=None)


@lru_cache(maxsize=2)
def tables_once(path: str) -> Callable[[Lubricant], Tables]:
    """Tables of both races of a file, which each worker reads once.

    Parameters
    ----------
    path : str
        The file.

    Returns
    -------
    Callable[[Lubricant], Tables]
        Function of an oil that gives the tables.
    """
    return tables_of_file(Path(path))
