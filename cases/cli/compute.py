"""Commands that compute a case: run, contact, slip."""

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from ..format.problems import CaseError
from ..runs.interrupt import say
from .app import CaseName, Json, Output, Quiet, app
from .output import finish, prepare, report, results_directory, save, save_with
from .terminal import guarded, progress_bar


class Method(StrEnum):
    """Discretisation of the contact solver."""

    MULTIGRID = "multigrid"
    FINITE_ELEMENT = "finite-element"


@app.command()
@guarded
def run(
    case: CaseName,
    output: Output = None,
    workers: Annotated[
        int | None, typer.Option(min=1, metavar="N", help="Contacts at a time; default: cores.")
    ] = None,
    as_json: Json = False,
    quiet: Quiet = False,
) -> int:
    """Run a bearing case: loads, film maps, pictures, VTK."""
    from ..format.case import Case, load_case

    loaded = load_case(case)
    if not isinstance(loaded, Case):
        raise CaseError([f"{case}: is a single contact; run it with 'oilfilm contact {case}'"])
    directory = results_directory(case, output, as_json)
    prepare()
    from ..runs.bearing import Interrupted, run_case

    try:
        with progress_bar(quiet=quiet) as progress:
            results = run_case(loaded, workers, progress)
            save(results, directory, progress)
    except Interrupted as stop:
        if stop.results is not None and directory is not None:
            target = directory if not directory.exists() else Path(f"{directory}_interrupted")
            save(stop.results, target)
            say(f"finished films in {target}")
        raise KeyboardInterrupt from None
    return finish(results, directory, as_json=as_json, quiet=quiet)


@app.command()
@guarded
def contact(
    case: CaseName,
    output: Output = None,
    method: Annotated[Method, typer.Option(help="Discretisation.")] = Method.MULTIGRID,
    as_json: Json = False,
    quiet: Quiet = False,
) -> int:
    """Solve one lubricated contact from a [contact] table."""
    from ..format.case import ContactCase, load_case

    loaded = load_case(case)
    if not isinstance(loaded, ContactCase):
        raise CaseError([f"{case}: is a bearing; run it with 'oilfilm run {case}'"])
    directory = results_directory(case, output, as_json)
    prepare()
    from ..runs.contact import run_contact
    from ..runs.films import cores

    with progress_bar(quiet=quiet) as progress:
        progress(0, 1, "film")
        results = run_contact(
            loaded, finite_element=method is Method.FINITE_ELEMENT, workers=cores()
        )
        save(results, directory, progress)
    return finish(results, directory, as_json=as_json, quiet=quiet)


@app.command()
@guarded
def slip(
    case: CaseName,
    output: Output = None,
    workers: Annotated[
        int | None, typer.Option(min=1, metavar="N", help="Processes; default: cores.")
    ] = None,
    as_json: Json = False,
    quiet: Quiet = False,
) -> int:
    """Map gross slip of the balls after Hirano, and the minimum preload, from a [slip] table."""
    from ..format.case import Case, load_case

    loaded = load_case(case)
    if not isinstance(loaded, Case):
        raise CaseError([f"{case}: is a single contact; slip maps need a bearing"])
    directory = results_directory(case, output, as_json)
    prepare()
    from ..runs.slip import run_slip

    with progress_bar(quiet=quiet) as progress:
        results = run_slip(loaded, case, workers, progress)
    from postprocess.slip.results import slip_summary, slip_table
    from postprocess.slip.write import write_slip

    save_with(lambda folder: write_slip(results, folder), directory)
    return report(
        slip_summary(results), lambda: slip_table(results), directory, as_json=as_json, quiet=quiet
    )
