"""Run `oilfilm table`: equilibrium of the bearing, then the traction tables of both races."""

import warnings
from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise
from math import inf
from time import perf_counter

from oilfilm.bearing.friction.tables import (
    build_race_tables,
    build_temperature_tables,
    race_progress,
)
from oilfilm.ehl import Lubricant, SolverOptions
from oilfilm.ehl.multigrid.threads import cores
from oilfilm.ehl.oil.rheology import Rheology
from oilfilm.ehl.traction_table.build import FilmSampler, TableOptions, atlas_sampler
from oilfilm.ehl.traction_table.film import film_sample
from oilfilm.ehl.traction_table.full_solves import full_solves
from oilfilm.ehl.traction_table.table import TableRange
from oilfilm.ehl.units import ZERO_CELSIUS
from oilfilm.postprocess.traction.results import TractionResults

from ..format.case import Case, oil_of_file
from ..format.document import BearingFile, read_text, validate_text
from ..format.friction import rheology
from ..format.lubricant import lubricant
from ..format.rules import CaseError
from ..format.shipped import find_case
from .equilibrium import case_equilibrium
from .films import Progress

# nodes to begin with where a tolerance of COARSE or more is asked for: over 1 to 150 N and 2 to
# 9 m/s of a 7008 the worst point of the outer race is off by 3.5 % of kappa_max Q, 95 % by 1.3 %
COARSE = 0.05
COARSE_NODES = (10, 5, 23, 8, 16)


@dataclass(frozen=True, slots=True, kw_only=True)
class TemperatureAxis:
    """Temperatures of the oil [K], and the oil and its rheology at each."""

    temperatures: tuple[float, ...]
    oil_at: Callable[[float], tuple[Lubricant, Rheology]]


def temperature_axis(name: str, text: str) -> TemperatureAxis:
    """The temperatures of `--temperatures`, with the oil at each.

    Parameters
    ----------
    name : str
        File or name of the case.
    text : str
        Temperatures with commas [degrees Celsius].

    Returns
    -------
    TemperatureAxis
        Temperatures [K], and the oil over temperature.

    Raises
    ------
    CaseError
        If they are no rising numbers, or the case's oil is known at one temperature only.
    """
    try:
        celsius = [float(part) for part in text.split(",")]
    except ValueError:
        celsius = []
    if len(celsius) < 2 or any(not b > a for a, b in pairwise(celsius)):
        raise CaseError(
            f"--temperatures: {text!r}; allowed: two or more rising numbers of degrees "
            "Celsius, 40,60,80"
        )
    path = find_case(name)
    file = validate_text(read_text(path), str(path), own_table=False)
    assert isinstance(file, BearingFile)  # checked before

    oil = oil_of_file(file)

    def oil_at(temperature: float) -> tuple[Lubricant, Rheology]:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # the case reported them already
            heated = lubricant(oil, temperature)
            return heated, rheology(oil, heated)

    temperatures = tuple(one + ZERO_CELSIUS for one in celsius)
    try:
        first, last = (oil_at(one)[0] for one in (temperatures[0], temperatures[-1]))
    except ValueError as problem:
        raise CaseError(f"--temperatures: {problem}") from None
    if first.viscosity == last.viscosity:
        raise CaseError(
            f"--temperatures: {name} gives the viscosity at one temperature only; "
            "allowed with an oil of the library"
        )
    return TemperatureAxis(temperatures=temperatures, oil_at=oil_at)


@dataclass(frozen=True, slots=True)
class TableWish:
    """Accuracy and range that a table is asked for."""

    tolerance: float = TableOptions().tolerance  # of the check [-]
    loads: tuple[float, float] | None = None  # None: around those of the case [N]
    speeds: tuple[float, float] | None = None  # of entrainment [m/s]

    def options(self, points: int, workers: int | None, sample: FilmSampler) -> TableOptions:
        """Options of the table; a coarse one begins with fewer nodes.

        Parameters
        ----------
        points : int
            Nodes of each film along x [-].
        workers : int | None
            Films solved at a time [-]; None: as many as there are cores.
        sample : FilmSampler
            Sampler of the films.

        Returns
        -------
        TableOptions
            The options.

        Raises
        ------
        CaseError
            If the tolerance is out of range.
        """
        if not 0.0 < self.tolerance < 1.0:
            raise CaseError(f"--tolerance: {self.tolerance} must lie between 0 and 1")
        nodes = COARSE_NODES if self.tolerance >= COARSE else None
        return TableOptions(
            points=points,
            workers=workers or cores(),
            sample=sample,
            tolerance=self.tolerance,
            nodes=nodes,
        )

    def limits(self, usual: TableRange) -> TableRange:
        """The range around a case, with the loads and speeds that were asked for.

        Parameters
        ----------
        usual : TableRange
            The range of the case.

        Returns
        -------
        TableRange
            Range of loads [N] and speeds [m/s].
        """
        return replace(usual, load=self.loads or usual.load, speed=self.speeds or usual.speed)


def span(option: str, text: str | None) -> tuple[float, float] | None:
    """The two rising positive numbers of an option.

    Parameters
    ----------
    option : str
        Name of the option.
    text : str | None
        Its value, where it is given.

    Returns
    -------
    tuple[float, float] | None
        The numbers; None without the option.

    Raises
    ------
    CaseError
        If they are something else.
    """
    if text is None:
        return None
    try:
        low, high = (float(part) for part in text.split(","))
    except ValueError:
        low = high = 0.0
    if not 0.0 < low < high < inf:
        raise CaseError(f"{option}: {text!r}; allowed: two rising positive numbers, 1,150")
    return low, high


def asked_films(case: Case, solve: FilmSampler = film_sample) -> FilmSampler:
    """Sampler of the films of a case's tables: solved, or of the film atlas.

    Parameters
    ----------
    case : Case
        The bearing.
    solve : FilmSampler, default film_sample
        Sampler of solved films.

    Returns
    -------
    FilmSampler
        The sampler.
    """
    return atlas_sampler(solve) if films_of_atlas(case) else solve


def films_of_atlas(case: Case) -> bool:
    """Tell whether a case asks for tables of films of the atlas.

    Parameters
    ----------
    case : Case
        The bearing.

    Returns
    -------
    bool
        True if it does.
    """
    return case.file.friction.table_films == "atlas"


def run_table(
    case: Case,
    points: int = 257,
    workers: int | None = None,
    progress: Progress | None = None,
    over: TemperatureAxis | None = None,
    sample: FilmSampler = film_sample,
    wish: TableWish | None = None,
) -> TractionResults:
    """Traction tables of a case.

    With temperatures, summary and plots are of the tables at the case's own, or the nearest.

    Parameters
    ----------
    case : Case
        The bearing.
    points : int, default 257
        Nodes of each film along x [-].
    workers : int | None, optional
        Films solved at a time [-]; None: as many as there are cores.
    progress : Progress | None, optional
        Called with films done, films planned so far, and a text.
    over : TemperatureAxis | None, optional
        Temperatures of the oil; None: that of the case.
    sample : FilmSampler, default film_sample
        Sampler of the films.
    wish : TableWish | None, optional
        Accuracy and range; None: those of the case.

    Returns
    -------
    TractionResults
        Tables of both races; times in [s].

    Raises
    ------
    CaseError
        If there is no equilibrium, or a table cannot be built.
    """
    try:
        SolverOptions(points=points)
    except ValueError as problem:
        raise CaseError(f"--points: {problem}") from None
    assert case.rheology is not None  # of every bearing case
    start = perf_counter()
    state = case_equilibrium(case)
    if not state.converged:
        raise CaseError(f"no table without an equilibrium of the bearing: {state.message}")
    wish = wish or TableWish()
    options = wish.options(points, workers, asked_films(case, sample))
    options = replace(options, narrow=films_of_atlas(case))
    solids = case.films.solids
    try:
        if over is None:
            over_temperature = None
            tables = build_race_tables(
                state, case.lubricant, case.rheology, options, progress, solids, wish.limits
            )
        else:
            over_temperature = build_temperature_tables(
                state, over.oil_at, over.temperatures, options, progress, solids, wish.limits
            )
            own = min(max(case.operation.temperature, over.temperatures[0]), over.temperatures[-1])
            tables = {race: table.at(own) for race, table in over_temperature.items()}
    except ValueError as problem:
        raise CaseError(f"no table: {problem}") from None
    return TractionResults(
        case=case.document,
        tables=tables,
        over_temperature=over_temperature,
        messages=case.warnings,
        timing={"total": perf_counter() - start},
    )


def with_full_solves(
    results: TractionResults, count: int, progress: Progress | None = None
) -> TractionResults:
    """Compare tables with full solves, with heat where the tables have it.

    Parameters
    ----------
    results : TractionResults
        The tables.
    count : int
        States of each race [-].
    progress : Progress | None, optional
        Called with solves done, solves in all, and a text.

    Returns
    -------
    TractionResults
        Tables with the comparison.
    """
    compared = dict(results.tables)
    for race, table in results.tables.items():
        notify = race_progress(progress, race)
        solves = full_solves(table.contact, table.range, count, progress=notify)
        compared[race] = replace(table, full_solves=solves)
    if results.over_temperature is None:
        return replace(results, tables=compared)
    over = {
        race: tables.replaced(compared[race]) for race, tables in results.over_temperature.items()
    }
    return replace(results, tables=compared, over_temperature=over)
