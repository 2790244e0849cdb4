"""Command: vibration."""

from __future__ import annotations

from threading import Event

from ...runs.interrupt import print_message
from ...runs.processes import one_thread
from ..app import CaseName, Json, Output, Quiet, app
from ..cost import report_cost, vibration_cost
from ..output import load_bearing, report, results_directory, save_with
from ..progress import progress_bar
from ..terminal import NOT_CONVERGED, guarded


@app.command()
@guarded
def vibration(
    case: CaseName, output: Output = None, as_json: Json = False, quiet: Quiet = False
) -> int:
    """Vibration of a bearing by waviness, defects and passing balls, with its films."""
    return run_and_report(case, output, as_json=as_json, quiet=quiet)


def run_and_report(case: CaseName, output: Output, *, as_json: bool, quiet: bool) -> int:
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

    Returns
    -------
    int
        Exit code.
    """
    one_thread()
    loaded = load_bearing(case, "vibration needs a bearing")
    directory = results_directory(case, output, as_json)
    from ...runs.studies.vibration import NotSolvedError, run_vibration

    report_cost(vibration_cost(loaded), quiet=quiet)
    try:
        with progress_bar(quiet=quiet) as progress:
            results = run_vibration(loaded, case, progress)
    except NotSolvedError as problem:
        print_message(f"oilfilm: {case}: not converged: {problem}; nothing is written")
        return NOT_CONVERGED
    except KeyboardInterrupt:
        print_message("oilfilm: of an unfinished vibration nothing is kept")
        raise
    from postprocess.vibration.summary import vibration_summary
    from postprocess.vibration.write import vibration_table, write_vibration

    hurry = Event()
    save_with(lambda folder: write_vibration(results, folder, hurry.is_set), directory, hurry.set)
    document = vibration_summary(results)
    return report(document, lambda: vibration_table(document), directory, as_json, quiet)
