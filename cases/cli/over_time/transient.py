"""Command: transient."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from threading import Event
from typing import TYPE_CHECKING, Annotated

import typer

from bearing.files import is_disk_failure

from ...format.problems import CaseError
from ...runs.interrupt import print_message
from ..app import CaseName, Json, Output, Quiet, app
from ..cost import report_cost, transient_cost
from ..output import lock_output_directory, report, results_directory, save_with
from ..progress import progress_bar
from ..terminal import NOT_CONVERGED, guarded

if TYPE_CHECKING:
    from postprocess.contact.transient_summary import TransientResults


@app.command()
@guarded
def transient(
    case: CaseName,
    output: Output = None,
    movie: Annotated[bool, typer.Option(help="Draw the film over time as a .gif.")] = True,
    as_json: Json = False,
    quiet: Quiet = False,
) -> int:
    """Solve one contact over time: load, speed, waviness, dents, impact.

    Steps are kept in DIR_steps while it runs; the same command goes on with them.
    """
    from ehl.transient.run import StartError

    from ...format.case import ContactCase, load_case
    from ...runs.studies.transient import Interrupted as TransientInterrupted
    from ...runs.studies.transient import run_transient

    loaded = load_case(case)
    if not isinstance(loaded, ContactCase):
        raise CaseError(f"{case}: is a bearing; a contact over time needs a [contact] table")
    directory = results_directory(case, output, as_json)
    folder = None if directory is None else _steps_folder(directory)
    report_cost(transient_cost(loaded), quiet=quiet)
    try:
        with progress_bar(quiet=quiet) as progress:
            results = run_transient(loaded, case, folder, progress)
            if directory is not None:
                progress(0, 1, "pictures and files")
                hurry = Event()
                write = _writer(results, movie, hurry.is_set)
                save_with(write, directory, hurry.set)
    except StartError as problem:
        print_message(f"oilfilm: {case}: not converged: {problem}; nothing is written")
        return NOT_CONVERGED
    except TransientInterrupted as stop:
        if stop.kept:
            print_message(
                f"finished steps are kept in {folder}; the same command goes on with them"
            )
        raise KeyboardInterrupt from None
    if folder is not None:
        from ...runs.studies.kept_steps import Checkpoints

        Checkpoints(folder, "").forget()
    from postprocess.contact.transient_summary import transient_summary, transient_table

    document = transient_summary(results)
    return report(document, lambda: transient_table(document), directory, as_json, quiet)


def _steps_folder(directory: Path) -> Path:
    """Folder of the checkpoints of a run into a directory."""
    return lock_output_directory(directory.with_name(f"{directory.name}_steps"))


def _writer(
    results: TransientResults, movie: bool, is_interrupted: Callable[[], bool]
) -> Callable[[Path], tuple[str, ...]]:
    """Writes all files of a run into a folder; movie and fields for ParaView unless `hurried`."""

    def write(folder: Path) -> tuple[str, ...]:
        from postprocess.contact.transient_plots import write_transient
        from postprocess.scene.transient import MOVIE_FILE, write_movie, write_transient_series

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
