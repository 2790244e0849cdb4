"""Commands that compute over time: dynamics, vibration, transient."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from contextlib import AbstractContextManager
from functools import partial
from pathlib import Path
from threading import Event
from typing import TYPE_CHECKING, Annotated

import typer

from oilfilm.bearing.files import is_disk_failure

from ..format.rules import CaseError
from ..runs.interrupt import finish_first, print_message
from ..runs.kernel_cache import compiled_ahead
from ..runs.output_directory import TEMPORARY, home, scratch_folder
from ..runs.processes import one_thread
from . import terminal
from .output import (
    dynamics_cost,
    load_bearing,
    lock_output_directory,
    report,
    report_cost,
    results_directory,
    save_with,
    transient_cost,
    vibration_cost,
)

if TYPE_CHECKING:
    from oilfilm.bearing.dynamics.simulation import Simulation
    from oilfilm.postprocess.contact.transient_summary import TransientResults
    from oilfilm.postprocess.dynamics.results import DynamicsResults

    from ..format.case import Case

Restart = Annotated[
    Path | None,
    typer.Option(
        "--restart", metavar="FILE", help="Go on from the restart file of an interrupted run."
    ),
]
Tables = Annotated[
    Path | None,
    typer.Option(
        "--table", metavar="FILE", help="Traction tables that 'oilfilm table' built for the case."
    ),
]
Animation = Annotated[
    Path | None, typer.Option("--animate", metavar="FILE", help="The motion as a .gif, too.")
]
Window = Annotated[
    str | None,
    typer.Option(
        "--window",
        metavar="MS,MS",
        help="Times that --animate shows; default: the last half turn of the cage.",
    ),
]


@terminal.command()
def vibration(
    case: terminal.CaseName,
    output: terminal.Output = None,
    as_json: terminal.Json = False,
    quiet: terminal.Quiet = False,
    notes: terminal.Notes = False,
) -> int:
    """Vibration of a bearing by waviness, defects and passing balls, with its films."""
    return run_and_report(case, output, as_json=as_json, quiet=quiet, notes=notes)


def run_and_report(
    case: terminal.CaseName, output: terminal.Output, *, as_json: bool, quiet: bool, notes: bool
) -> int:
    """Compute the vibration of a case, write it and print it.

    Parameters
    ----------
    case : CaseName
        File or name of the case.
    output : Output
        Directory as given.
    as_json : bool
        True: the summary instead of the table.
    quiet : bool
        True: neither table nor notes.
    notes : bool
        True: notes as well.

    Returns
    -------
    int
        Exit code.
    """
    one_thread()
    loaded = load_bearing(case, "vibration needs a bearing")
    directory = results_directory(case, output, as_json)
    from ..runs.vibration import NotSolvedError, run_vibration

    report_cost(vibration_cost(loaded), quiet=quiet)
    try:
        with terminal.progress_bar(quiet=quiet) as progress:
            results = run_vibration(loaded, case, progress)
    except NotSolvedError as problem:
        print_message(f"oilfilm: {case}: not converged: {problem}; nothing is written")
        return terminal.NOT_CONVERGED
    except KeyboardInterrupt:
        print_message("oilfilm: of an unfinished vibration nothing is kept")
        raise
    from oilfilm.postprocess.vibration.summary import vibration_summary
    from oilfilm.postprocess.vibration.write import vibration_table, write_vibration

    hurry = Event()
    document = vibration_summary(results)

    def save() -> None:
        save_with(
            lambda folder: write_vibration(results, folder, hurry.is_set), directory, hurry.set
        )

    table = partial(vibration_table, document)
    return report(document, table, directory, as_json, quiet, notes, save)


@terminal.command()
def dynamics(
    case: terminal.CaseName,
    output: terminal.Output = None,
    restart: Restart = None,
    table: Tables = None,
    animation: Animation = None,
    window: Window = None,
    as_json: terminal.Json = False,
    quiet: terminal.Quiet = False,
    notes: terminal.Notes = False,
) -> int:
    """Simulate a bearing over time: balls, cage and inner ring."""
    terminal.enter_context(compiled_ahead("motion"))
    loaded = load_bearing(case, "a simulation needs a bearing")
    if loaded.only_vibrates:
        if any(option is not None for option in (restart, table, animation)):
            allowed = "with [form] or [support] they need [dynamics], which simulates friction"
            raise CaseError(f"{case}: --restart, --table, --animate: {allowed}")
        return run_and_report(case, output, as_json=as_json, quiet=quiet, notes=notes)
    directory = results_directory(case, output, as_json)
    if animation is not None and (directory is None or animation.suffix.lower() != ".gif"):
        allowed = "allowed: a .gif file, and results that are written (-o)"
        raise CaseError(f"--animate {animation}: {allowed}")
    shown = _window(window, animation, loaded)
    from ..runs.dynamics import Interrupted, run_dynamics
    from ..runs.vibration import NotSolvedError

    report_cost(dynamics_cost(loaded), quiet=quiet)
    with _history_folder(directory) as folder:
        history = Path(folder) / "history.nc"
        try:
            with terminal.progress_bar(quiet=quiet) as progress:
                results = run_dynamics(loaded, case, history, restart, table, progress)
        except NotSolvedError as problem:
            print_message(f"oilfilm: {case}: not converged: {problem}; nothing is written")
            return terminal.NOT_CONVERGED
        except Interrupted as stop:
            _keep(loaded, stop.results, stop.simulation, directory)
            raise KeyboardInterrupt from None
        from oilfilm.postprocess.dynamics.results import dynamics_summary, dynamics_table

        hurry = Event()
        document = dynamics_summary(results)

        def save() -> None:
            save_with(lambda target: _write(results, target, hurry.is_set), directory, hurry.set)
            if animation is not None and directory is not None:
                _animate(directory, animation, shown)

        shape = partial(dynamics_table, document)
        return report(document, shape, directory, as_json, quiet, notes, save)


def _history_folder(directory: Path | None) -> AbstractContextManager[str | Path]:
    """A temporary folder for the history, beside the results: it may be large for /tmp."""
    if directory is None:
        return scratch_folder()

    name = f".{directory.absolute().name}-"
    return tempfile.TemporaryDirectory(TEMPORARY, name, home(directory))


def _write(
    results: DynamicsResults, directory: Path, is_interrupted: Callable[[], bool]
) -> tuple[str, ...]:
    """Write the results and, if there are samples, the motion for ParaView; return problems.

    Pictures and motion are left out when one is `hurried`.
    """
    from oilfilm.postprocess.dynamics.plots import write_dynamics
    from oilfilm.postprocess.scene.vtk_history import write_motion

    problems = write_dynamics(results, directory, is_interrupted)
    try:
        if results.running.rows and not is_interrupted():
            write_motion(directory)
    except (OSError, ValueError) as error:
        if is_disk_failure(error):
            raise
        problems = (*problems, f"motion for ParaView not written: {error}")
    return problems


def _window(text: str | None, animation: Path | None, case: Case) -> tuple[float, float] | None:
    """Times that an animation shows [s]; CaseError unless they rise within the simulation."""
    if text is None:
        return None
    if animation is None:
        raise CaseError("--window: needs --animate")
    table = case.file.dynamics
    end = 0.0 if table is None or table.end_time_s is None else table.end_time_s
    try:
        first, last = (1e-3 * float(part) for part in text.split(","))
    except ValueError:
        first = last = 0.0
    if not 0.0 <= first < last <= end * (1.0 + 1e-9):
        allowed = f"two rising times in ms up to {1e3 * end:g}, 10,25"
        raise CaseError(f"--window: {text!r}; allowed: {allowed}")
    return first, last


def _animate(directory: Path, file: Path, window: tuple[float, float] | None) -> None:
    """Draw the motion; where that fails a message says so, and the results stay."""
    from oilfilm.postprocess.scene.render_process import RenderingError
    from oilfilm.postprocess.scene.scene import AnimationOptions, animate

    try:
        animate(directory, file, AnimationOptions(window=window))
    except (RenderingError, OSError, ValueError) as problem:
        if is_disk_failure(problem):
            raise
        print_message(f"oilfilm: {problem}")


def _keep(
    case: Case, results: DynamicsResults, simulation: Simulation, directory: Path | None
) -> None:
    """Write what an interrupted simulation has so far, and the file to go on from."""
    if directory is None:
        return
    from oilfilm.bearing.dynamics.simulation import save_restart
    from oilfilm.postprocess.dynamics.plots import write_dynamics

    from ..runs.dynamics import case_key

    path = directory.with_name(f"{directory.name}_restart.npz")
    if directory.exists():
        directory = directory.with_name(f"{directory.name}_interrupted")
    with finish_first(f"history so far in {directory}"):
        save_restart(simulation, path, case_key(case))
        save_with(lambda target: write_dynamics(results, target, lambda: True), directory)
    print_message(f"history so far in {directory}; go on with --restart {path}")


@terminal.command()
def transient(
    case: terminal.CaseName,
    output: terminal.Output = None,
    movie: Annotated[bool, typer.Option(help="Draw the film over time as a .gif.")] = True,
    as_json: terminal.Json = False,
    quiet: terminal.Quiet = False,
    notes: terminal.Notes = False,
) -> int:
    """Solve one contact over time: load, speed, waviness, dents, impact.

    Steps are kept in DIR_steps while it runs; the same command goes on with them.
    """
    from oilfilm.ehl.transient.run import StartError

    from ..format.case import ContactCase, load_case
    from ..runs.transient import Interrupted, run_transient

    loaded = load_case(case)
    if not isinstance(loaded, ContactCase):
        raise CaseError(f"{case}: is a bearing; a contact over time needs a [contact] table")
    directory = results_directory(case, output, as_json)
    folder = None if directory is None else _steps_folder(directory)
    report_cost(transient_cost(loaded), quiet=quiet)
    try:
        with terminal.progress_bar(quiet=quiet) as progress:
            results = run_transient(loaded, case, folder, progress)
            if directory is not None:
                progress(0, 1, "pictures and files")
                hurry = Event()
                write = _writer(results, movie, hurry.is_set)
                save_with(write, directory, hurry.set)
    except StartError as problem:
        print_message(f"oilfilm: {case}: not converged: {problem}; nothing is written")
        return terminal.NOT_CONVERGED
    except Interrupted as stop:
        if stop.kept:
            print_message(
                f"finished steps are kept in {folder}; the same command goes on with them"
            )
        raise KeyboardInterrupt from None
    if folder is not None:
        from ..runs.transient import Checkpoints

        Checkpoints(folder, "").forget()
    from oilfilm.postprocess.contact.transient_summary import transient_summary, transient_table

    document = transient_summary(results)
    return report(document, lambda: transient_table(document), directory, as_json, quiet, notes)


def _steps_folder(directory: Path) -> Path:
    """Folder of the checkpoints of a run into a directory."""
    return lock_output_directory(directory.with_name(f"{directory.name}_steps"))


def _writer(
    results: TransientResults, movie: bool, is_interrupted: Callable[[], bool]
) -> Callable[[Path], tuple[str, ...]]:
    """Writes all files of a run into a folder; movie and fields for ParaView unless `hurried`."""

    def write(folder: Path) -> tuple[str, ...]:
        from oilfilm.postprocess.contact.transient_plots import write_transient
        from oilfilm.postprocess.scene.transient import (
            MOVIE_FILE,
            write_movie,
            write_transient_series,
        )

        problems = write_transient(results, folder, is_interrupted)
        try:
            if not is_interrupted():
                write_transient_series(results.solution, folder, is_interrupted)
            if movie and not is_interrupted():
                write_movie(results.solution, folder / MOVIE_FILE, results.title, is_interrupted)
        except (OSError, ValueError, RuntimeError) as error:
            if is_disk_failure(error):
                raise
            problems = (*problems, f"series for ParaView or movie not written: {error}")
        return problems

    return write
