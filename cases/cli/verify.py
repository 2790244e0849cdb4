"""The command that verifies the contact solver: verify."""

from __future__ import annotations

from datetime import date
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from verification.names import SectionName

from ..format.problems import CaseError
from ..runs.interrupt import finish_first, print_message
from .app import Json, Quiet, app
from .cost import report_cost
from .output import load_bearing, lock_output_directory
from .progress import progress_bar
from .terminal import NOT_CONVERGED, guarded, print_json, print_table

if TYPE_CHECKING:
    from rich.table import Table

    from postprocess.bearing.results import BearingResults
    from verification.page import Section

# on two cores, the mean of the sections: of the page in docs/validation, and with --quick [s]
SECTION_SECONDS = {False: 67.0, True: 6.0}
DIRECTORY = Path("verify_results")

Output = Annotated[
    Path | None,
    typer.Option("--output", "-o", metavar="DIR", help=f"Where results go; default: {DIRECTORY}."),
]
Sections = Annotated[
    list[SectionName] | None,
    typer.Option("--section", help="A part of the page; may be repeated. Default: all."),
]
Draws = Annotated[
    int | None,
    typer.Option(
        "--robustness", min=1, metavar="DRAWS", help="Solve this many random contacts instead."
    ),
]
Seed = Annotated[
    int | None,
    typer.Option(
        min=0,
        metavar="N",
        help="Seed of the draws; default: that of an unfinished sweep, else today's date.",
    ),
]


@app.command()
@guarded
def verify(
    section: Sections = None,
    output: Output = None,
    quick: Annotated[
        bool, typer.Option("--quick", help="Coarse grids and few contacts: seconds.")
    ] = False,
    robustness: Draws = None,
    seed: Seed = None,
    as_json: Json = False,
    quiet: Quiet = False,
) -> int:
    """Compute the verification page of the contact solver: orders, limits, films, costs."""
    from verification.page import ForeignFileError

    if robustness is not None and section:
        raise CaseError("--robustness, --section: found together; allowed: one of them")
    if robustness is None and seed is not None:
        raise CaseError(
            "--seed: found without --robustness; it is the seed of the random contacts"
        )
    printed = as_json and output is None and robustness is None
    directory = None if printed else output or DIRECTORY
    if directory is not None:
        lock_output_directory(directory)
    try:
        if robustness is None or directory is None:
            sections = _page(list(section or SectionName), directory, quick, quiet)
        else:
            sections = [_sweep((robustness, seed), directory, quick, quiet)]
    except ForeignFileError as error:
        raise CaseError(str(error)) from None
    return _report(sections, directory, as_json, quiet)


def _page(
    names: list[SectionName], directory: Path | None, quick: bool, quiet: bool
) -> list[Section]:
    from verification.run import PAGE, check_page, run_sections, write_page

    if directory is not None:
        check_page(directory, PAGE)
    seconds = SECTION_SECONDS[quick] * len(names)
    report_cost((f"{len(names)} sections of the verification", seconds), quiet=quiet)
    finished: list[Section] = []
    try:
        with progress_bar(quiet=quiet) as progress:
            for section in run_sections(names, progress, _run_bearing, quick=quick):
                finished.append(section)
    except KeyboardInterrupt:
        _keep(finished, directory)
        raise
    sections = finished
    if directory is not None:
        with finish_first(f"results in {directory}"):
            write_page(sections, directory, PAGE)
    return sections


def _keep(finished: list[Section], directory: Path | None) -> None:
    """Write the sections that are there of an interrupted page, beside a whole one."""
    from verification.run import PAGE, write_page

    if directory is None or not finished:
        print_message("oilfilm: no section is finished, nothing is kept")
        return
    target = directory
    if (directory / PAGE).exists():
        target = directory.with_name(f"{directory.name}_interrupted")
    with finish_first(f"finished sections in {target}"):
        write_page(finished, target, PAGE)
    print_message(f"finished sections in {target}")


def _run_bearing() -> BearingResults:
    from verification.costs import BEARING

    from ..runs.bearing import run_case

    return run_case(load_bearing(BEARING, "the cost of a bearing"))


def _sweep(draws: tuple[int, int | None], directory: Path, quick: bool, quiet: bool) -> Section:
    """Random contacts, by their number and seed; None: that of the sweep begun, or the date."""
    from verification.robustness import QUICK_OPTIONS, seed_of, sweep
    from verification.robustness_page import robustness_section
    from verification.run import SWEEP, SWEEP_PAGE, check_page, write_page

    check_page(directory, SWEEP_PAGE)
    file = directory / SWEEP
    count, seed = draws
    begun = seed_of(file) if seed is None else seed
    seed = int(date.today().strftime("%Y%m%d")) if begun is None else begun
    try:
        with progress_bar(quiet=quiet) as progress:
            finished = sweep(count, seed, file, progress, QUICK_OPTIONS if quick else None)
    except KeyboardInterrupt:
        print_message(
            f"finished contacts are kept in {file}; the same command continues with them"
        )
        raise
    section = robustness_section(finished, seed)
    with finish_first(f"results in {directory}"):
        write_page([section], directory, SWEEP_PAGE)
    return section


def _report(sections: list[Section], directory: Path | None, as_json: bool, quiet: bool) -> int:
    from verification.run import document

    results = document(sections)
    if directory is not None and not quiet:
        print_message(f"results in {directory}")
    if as_json:
        print_json(results)
    elif not quiet:
        print_table(_table(sections))
    if results["converged"]:
        return 0
    print_message("oilfilm: these statements do not hold:")
    for message in results["messages"]:
        print_message(f"  {message}")
    return NOT_CONVERGED


def _table(sections: list[Section]) -> Table:
    from rich.table import Table

    table = Table("statement", "found", "wanted", "holds")
    for section in sections:
        for check in section.checks:
            table.add_row(*check.cells)
    return table
