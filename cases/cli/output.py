"""Common steps of the commands that compute: load, lock, announce, save, report.

Long work is announced before it begins, with its estimated time within a factor of two or so.
"""

from __future__ import annotations

import sys
from pathlib import Path
from textwrap import TextWrapper
from typing import TYPE_CHECKING, Any

from ..format.rules import CaseError
from ..runs.interrupt import finish_first, print_message
from .terminal import NOT_CONVERGED, enter_context, print_json, print_table

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from rich.console import Group

    from oilfilm.ehl import SolverOptions
    from oilfilm.postprocess.bearing.results import BearingResults
    from oilfilm.postprocess.contact.summary import ContactResults

    from ..format.case import Case, ContactCase
    from ..format.dynamics import DynamicsTable
    from ..format.shaft_case import ShaftCase
    from ..runs.drawing import Drawing
    from ..runs.films import Progress


MOST_WARNINGS = 3  # below a table
LONG = 5.0  # work that takes less is not announced [s]
# processor time of a film on 257 nodes, which grows with their square; measured on one core of
# 2.5 GHz, the ball on disc and the contacts of the 6208
FILM_SECONDS = 0.6
FILM_POINTS = 257
EQUILIBRIUM_SECONDS = 0.01  # of a bearing in a slip map, measured likewise on 7000C
# a simulation for each ball and simulated second, measured likewise on 7008_axial, 7008_radial
# and 7008_combined (0.8 to 1.7), and on 6304_planar
DYNAMICS_SECONDS = 1.6
PLANAR_SECONDS = 0.4  # with the equations of a plane
AXIAL_SECONDS = 2.0  # of one ball for all, with ring and cage; not for each ball
# a ball, of films without a solve in balance, with the heat of their friction
STATE_SECONDS = 0.01
# a step in time on 257 nodes along x, y >= 0, measured likewise on waviness_ball_on_disc
STEP_SECONDS = 0.05
# a vibration for each ball and simulated second, and its films; likewise, 6208_waviness
VIBRATION_SECONDS = 3.0
VIBRATION_FILMS = 5.0
TORQUE_SECONDS = 1.0  # of equilibrium, torque by every model and self-heating without films
TABLE_FILMS = 120  # of the tables of both races, without refinement
ATLAS_FILM_SECONDS = 0.25  # of a film of a table by the atlas, its shear [s]


def load_bearing(name: str, needed: str, *, heated: bool = True, own_table: bool = True) -> Case:
    """Load the bearing case of a name.

    Parameters
    ----------
    name : str
        File or name of the case.
    needed : str
        Text for the message about a single contact.
    heated : bool, default True
        True: at the temperature that it warms itself to by formulas; a run finds its own.
    own_table : bool, default True
        True: with the traction tables that it names, which `oilfilm table` makes.

    Returns
    -------
    Case
        The case.

    Raises
    ------
    CaseError
        If the case is a single contact, or something is wrong with it.
    """
    from ..format.case import Case, load_case
    from ..runs.heating import with_temperature

    case = load_case(name, own_table=own_table)
    if not isinstance(case, Case):
        raise CaseError(f"{name}: is a single contact; {needed}")
    return with_temperature(case) if heated else case


def results_directory(case: str, output: Path | None, as_json: bool) -> Path | None:
    """Lock the directory of the results.

    Parameters
    ----------
    case : str
        File or name of the case.
    output : Path | None
        Directory as given.
    as_json : bool
        True: the summary is printed.

    Returns
    -------
    Path | None
        The directory; None with --json alone.

    Raises
    ------
    CaseError
        If the directory cannot be written.
    """
    if output is None and as_json:
        return None
    from ..runs.output_directory import check_replaceable

    directory = lock_output_directory(output or Path(f"{Path(case).stem}_results"))
    check_replaceable(directory)
    return directory


def lock_output_directory(directory: Path, *, shared: bool = False) -> Path:
    """Lock a directory that can be written against other programs until the command ends.

    Parameters
    ----------
    directory : Path
        The directory.
    shared : bool, default False
        True: others may write files of their own into it.

    Returns
    -------
    Path
        The directory.

    Raises
    ------
    CaseError
        If it cannot be written, or another program writes it.
    """
    from ..runs.output_directory import check_output, one_writer

    check_output(directory)
    enter_context(one_writer(directory, shared=shared))
    return directory


def lock_output_file(file: Path) -> Path:
    """Lock a file that can be written against other programs until the command ends.

    Parameters
    ----------
    file : Path
        The file.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    CaseError
        If it cannot be written, or another program writes it.
    """
    from ..runs.output_directory import check_file, one_writer

    check_file(file)
    enter_context(one_writer(file))
    return file


def save(
    results: BearingResults | ContactResults,
    directory: Path | None,
    drawing: Drawing,
    progress: Progress | None = None,
) -> None:
    """Write the results into a directory; after an interrupt numbers alone.

    Parameters
    ----------
    results : BearingResults | ContactResults
        Results of the run.
    directory : Path | None
        The directory; None: nothing is written.
    drawing : Drawing
        Processes that draw the pictures.
    progress : Progress | None, optional
        Called with steps done, steps in all, and a text.
    """
    if directory is not None and progress is not None:
        progress(0, 1, "pictures and files")
    save_with(lambda folder: drawing.write(results, folder), directory, drawing.stop)


def save_with(
    write: Callable[[Path], tuple[str, ...]],
    directory: Path | None,
    hurry: Callable[[], None] | None = None,
) -> None:
    """Fill the directory of the results by a function.

    Parameters
    ----------
    write : Callable[[Path], tuple[str, ...]]
        Writes all files into a folder, and returns problems.
    directory : Path | None
        The directory; None: nothing is written.
    hurry : Callable[[], None] | None, optional
        Called at an interrupt, to leave out what can be left out.
    """
    if directory is None:
        return
    from ..runs.output_directory import save

    with finish_first(f"results in {directory}", hurry):
        for problem in save(write, directory):
            print_message(f"oilfilm: {problem}")


def report(
    document: dict[str, Any],
    table: Callable[[], Group],
    directory: Path | None,
    as_json: bool,
    quiet: bool,
    notes: bool = False,
    save: Callable[[], None] | None = None,
) -> int:
    """Print a summary or its table, write the files, then tell the parts that did not converge:
    pictures do not hold up the numbers.

    Parameters
    ----------
    document : dict[str, Any]
        The summary.
    table : Callable[[], Group]
        Makes the table.
    directory : Path | None
        Directory of the results, where there is one.
    as_json : bool
        True: the summary instead of the table.
    quiet : bool
        True: neither table nor notes.
    notes : bool, default False
        True: notes as well.
    save : Callable[[], None] | None, optional
        Writes the files, also where nobody reads what is printed.

    Returns
    -------
    int
        Exit code.
    """
    try:
        if as_json:
            print_json(document)
        elif not quiet:
            print_table(table())
            print_warnings(document.get("warnings", ()))
            if notes:
                print_notes(document["messages"])
        sys.stdout.flush()
    finally:
        if save is not None:
            save()
    if directory is not None and not quiet:
        hint = "" if notes or as_json else "; assumptions and remarks: --notes"
        print_message(f"results in {directory}{hint}")
    if document["converged"]:
        return 0
    print_message("oilfilm: not converged; the results are flagged:")
    reasons = [message for message in document["messages"] if _of_failure(message)]
    for message in reasons or document["messages"]:
        print_message(f"  {message}")
    return NOT_CONVERGED


def print_warnings(warnings: Iterable[str]) -> None:
    """Print the first warnings, without what did not converge, each up to its first semicolon.

    Parameters
    ----------
    warnings : Iterable[str]
        Warnings of the results.
    """
    wrapper = TextWrapper(80, "warning: ", "         ", break_long_words=False)
    shown = [message for message in warnings if not _of_failure(message)]
    for message in shown[:MOST_WARNINGS]:
        for line in wrapper.wrap(message.partition("; ")[0]):
            print_message(line)
    if len(shown) > MOST_WARNINGS:
        print_message(f"warning: {len(shown) - MOST_WARNINGS} more in the results (warnings)")


def print_notes(messages: Iterable[str]) -> None:
    """Print estimates, assumptions and values outside their data.

    Reasons of null values are left out, but for a loaded contact without a film.

    Parameters
    ----------
    messages : Iterable[str]
        Messages of the results.
    """
    wrapper = TextWrapper(80, "note: ", "      ", break_long_words=False)
    for message in messages:
        lacks_film = "film null, a light load" in message
        if (lacks_film or "null" not in message) and not _of_failure(message):
            for line in wrapper.wrap(message.replace("film null", "no film")):
                print_message(line)


def _of_failure(message: str) -> bool:
    """Tell whether a message belongs to a part that did not converge."""
    return "not converged" in message or message.startswith(
        ("equilibrium of", "no film was computed")
    )


def report_cost(cost: tuple[str, float], *, quiet: bool) -> None:
    """Announce long work and its estimated time.

    Parameters
    ----------
    cost : tuple[str, float]
        Description of the work, and its time [s].
    quiet : bool
        True: no message.
    """
    what, seconds = cost
    if not quiet and seconds > LONG:
        print_message(f"oilfilm: {what}: about {_duration(seconds)}")


def film_seconds(options: SolverOptions) -> float:
    """Processor time of one film, at most.

    Parameters
    ----------
    options : SolverOptions
        Grid of the solver.

    Returns
    -------
    float
        Time [s].
    """
    return FILM_SECONDS * (options.max_points / FILM_POINTS) ** 2


def run_cost(case: Case, workers: int) -> tuple[str, float]:
    """Work and time of a run; equal contacts are solved once, and a tolerance is most often met
    on half of the nodes that it may take.

    Parameters
    ----------
    case : Case
        The bearing.
    workers : int
        Contacts solved at a time [-].

    Returns
    -------
    tuple[str, float]
        Description, and time [s].
    """
    films = run_films(case)
    points = case.solver.max_points
    if case.solver.wanted_tolerance is not None:
        points = (points + 1) // 2
    seconds = films * FILM_SECONDS * (points / FILM_POINTS) ** 2 / min(workers, max(films, 1))
    text = f"about {films} films on {points} nodes, {workers} at a time"
    return text if films else "films of the atlas", seconds + TORQUE_SECONDS


def run_films(case: Case) -> int:
    """Films that a run solves, about: of balls that loads in one plane press alike one; of films
    that the atlas has the heaviest of each race, or none.

    Parameters
    ----------
    case : Case
        The bearing.

    Returns
    -------
    int
        Number of films [-].
    """
    maps = case.film_maps
    rows = len(case.rows or (None,))
    balls = rows * case.bearing.balls
    if not isinstance(maps, str):
        return 2 * min(balls, len(maps))
    given = case.operation
    directions = (given.force, given.displacement)
    turns = (given.moment, given.tilt)
    if not any(own[-1] for own in directions) and not any(own[0] for own in turns):
        radial = any(own[1] for own in (*directions, *turns))
        balls = rows * (case.bearing.balls // 2 + 1 if radial else 1)
    if maps == "none":
        return 0
    from ..format.contact import FilmModel, FilmSource

    if case.inlet_layer is not None or case.films.model is not FilmModel.NEWTONIAN:
        return 2 * balls
    return {FilmSource.SOLVED: 2 * balls, FilmSource.AUTO: 2, FilmSource.ATLAS: 0}[
        case.film_source
    ]


def table_cost(
    points: int, temperatures: int, workers: int, *, atlas: bool = False
) -> tuple[str, float]:
    """Work and time of the traction tables of both races, without refinement.

    Parameters
    ----------
    points : int
        Nodes of each film along x [-].
    temperatures : int
        Temperatures of the oil [-].
    workers : int
        Films solved at a time [-].
    atlas : bool, default False
        True: films of the film atlas, where it has them.

    Returns
    -------
    tuple[str, float]
        Description, and time [s].
    """
    films = TABLE_FILMS * temperatures
    seconds = films * FILM_SECONDS * (points / FILM_POINTS) ** 2 / workers
    if atlas:
        text = f"{films} films by the film atlas, {workers} at a time (solved: {seconds:.0f} s)"
        return text, films * ATLAS_FILM_SECONDS / workers
    return f"{films} films on {points} nodes or more, {workers} at a time", seconds


def slip_cost(case: Case, workers: int) -> tuple[str, float]:
    """Work and time of slip maps; nothing without [slip], which is an error later.

    Parameters
    ----------
    case : Case
        The bearing.
    workers : int
        Processes [-].

    Returns
    -------
    tuple[str, float]
        Description, and time [s].
    """
    points = 0 if case.file.slip is None else case.file.slip.points
    text = f"slip at {points} speeds and {points} loads, {workers} processes"
    return text, points**2 * EQUILIBRIUM_SECONDS / workers


def temperatures_cost(case: Case) -> tuple[str, float]:
    """Work and time of temperatures over speed and time.

    Parameters
    ----------
    case : Case
        The bearing.

    Returns
    -------
    tuple[str, float]
        Description, and time [s].
    """
    balls = case.bearing.balls * len(case.rows or (None,))
    text = "temperatures over the speed and from the start, some 100 states"
    return text, 100.0 * balls * STATE_SECONDS


def dynamics_cost(case: Case) -> tuple[str, float]:
    """Work and time of a simulation without its traction tables; nothing without [dynamics].

    Parameters
    ----------
    case : Case
        The bearing.

    Returns
    -------
    tuple[str, float]
        Description, and time [s].
    """
    table = case.file.dynamics
    simulated = 0.0 if table is None else (table.end_time_s or 0.0) * (table.starts or 1)
    planar = table is not None and table.equations == "planar"
    each = PLANAR_SECONDS if planar else DYNAMICS_SECONDS
    seconds = simulated * case.bearing.balls * each
    if table is not None and _one_ball(case, table):
        seconds = simulated * AXIAL_SECONDS
    return f"{simulated:g} s of {case.bearing.balls} balls simulated", seconds


def _one_ball(case: Case, table: DynamicsTable) -> bool:
    """Tell whether a simulation most likely solves one ball: thrust alone throughout."""
    across = any(case.operation.force[1:]) or any(table.gravity_m_s2[1:])
    plain = table.load_table_N is None and table.moment_table_N_mm is None
    return (
        table.equations == "by load"
        and plain
        and not across
        and not (table.unbalance_g_mm or table.rotating_load_N)
    )


def transient_cost(case: ContactCase) -> tuple[str, float]:
    """Work and time of a contact over time; nothing without [transient], which is an error later.

    Parameters
    ----------
    case : ContactCase
        The contact.

    Returns
    -------
    tuple[str, float]
        Description, and time [s].
    """
    if case.transient is None:
        return "", 0.0
    from oilfilm.ehl.transient.run import planned_steps

    conditions, options = case.transient
    try:
        steps = planned_steps(conditions, options)
    except ValueError:
        return "", 0.0
    sides = 1.0 if conditions.symmetric else 2.0
    each = STEP_SECONDS * sides * (options.points / FILM_POINTS) ** 2
    return f"{steps} steps in time on {options.points} nodes along the entrainment", steps * each


def vibration_cost(case: Case) -> tuple[str, float]:
    """Work and time of a vibration, films included.

    Parameters
    ----------
    case : Case
        The bearing.

    Returns
    -------
    tuple[str, float]
        Description, and time [s].
    """
    table = case.file.vibration
    given = None if table is None else table.duration_s
    end = None if case.file.dynamics is None else case.file.dynamics.end_time_s
    settling = 0.1 if table is None else table.settling_time_s
    simulated = (given or end or 0.5) + settling
    seconds = VIBRATION_FILMS + simulated * case.bearing.balls * VIBRATION_SECONDS
    return f"vibration over {simulated:g} s of {case.bearing.balls} balls", seconds


def batch_cost(
    first: Case | ContactCase | ShaftCase, points: int, compute: str
) -> tuple[str, float]:
    """Work and time of points like the first one on one core.

    Parameters
    ----------
    first : Case | ContactCase | ShaftCase
        Case of the first point.
    points : int
        Number of points [-].
    compute : str
        Quantity that is computed.

    Returns
    -------
    tuple[str, float]
        Description, and time [s].
    """
    from ..format.case import Case
    from ..format.shaft_case import ShaftCase

    if isinstance(first, ShaftCase):
        each = len(first.cases) * TORQUE_SECONDS * (4.0 if first.self_heated else 1.0)
    elif not isinstance(first, Case):
        each = film_seconds(first.solver)
    elif compute == "run":
        each = max(run_cost(first, 1)[1], TORQUE_SECONDS)
    else:
        costs = {
            "slip": slip_cost(first, 1)[1],
            "dynamics": dynamics_cost(first)[1],
            "vibration": vibration_cost(first)[1],
            "table": table_cost(FILM_POINTS, 1, 1)[1],
        }
        each = costs.get(compute, TORQUE_SECONDS)
    films = 1
    if isinstance(first, Case):
        films = run_films(first) if compute == "run" else 0
    counted = f" with at most {points * films} films" if films else ""
    text = f"{points} points{counted}, at most {_duration(each)} each on one core"
    return text, points * each


def _duration(seconds: float) -> str:
    if seconds < 90.0:
        return f"{seconds:.2g} s"
    return f"{seconds / 60.0:.0f} min" if seconds < 5400.0 else f"{seconds / 3600.0:.1f} h"
