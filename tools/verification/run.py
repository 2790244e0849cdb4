"""Compute the verification page of the contact solver: `python tools/verification/run.py -o docs/validation`.

    python tools/verification/run.py [--section NAME]... [--quick] [-o DIR] [--json] [-q]
    python tools/verification/run.py --robustness DRAWS [--seed N] [--quick] [-o DIR] [--json] [-q]

The page has orders, limits, films and costs: about ten minutes on two cores, in threads; the section on cost runs by
itself.
`--robustness` solves random contacts instead and keeps each in DIR as soon as it is solved: the same command continues
after an interruption. Exit code 1: a statement does not hold. `oilfilm verify` is the short check of an installation.
"""

from __future__ import annotations

import signal
import sys
from datetime import date
from pathlib import Path
from typing import Annotated

import typer
from rich.table import Table

if not __package__:  # run as a script: `verification` is a package of the folder `tools`
    sys.path[0] = str(Path(__file__).resolve().parents[1])

from oilfilm.cases import run_case
from oilfilm.cases.cli.output import load_bearing, lock_output_directory, report_cost
from oilfilm.cases.cli.terminal import (
    INTERRUPTED,
    NOT_CONVERGED,
    Json,
    Quiet,
    guarded,
    print_json,
    print_table,
    progress_bar,
)
from oilfilm.cases.format.rules import CaseError
from oilfilm.cases.runs.interrupt import end_after_signal, end_now, finish_first, interrupt, print_message
from oilfilm.postprocess.bearing.results import BearingResults
from verification import robustness as random_contacts
from verification import sections as page_sections
from verification.costs import BEARING
from verification.names import SectionName
from verification.page import ForeignFileError, Section
from verification.robustness import QUICK_OPTIONS, seed_of
from verification.robustness_page import robustness_section
from verification.sections import PAGE, SWEEP, SWEEP_PAGE, check_page, document, write_page

# on two cores, the mean of the sections: of the page in docs/validation, and with --quick [s]
SECTION_SECONDS = {False: 67.0, True: 6.0}
DIRECTORY = Path("verify_results")

app = typer.Typer(add_completion=False, rich_markup_mode=None, pretty_exceptions_enable=False)
Output = Annotated[
    Path | None, typer.Option("--output", "-o", metavar="DIR", help=f"Where results go; default: {DIRECTORY}.")
]
Sections = Annotated[
    list[SectionName] | None, typer.Option("--section", help="A part of the page; may be repeated. Default: all.")
]
Draws = Annotated[
    int | None, typer.Option("--robustness", min=1, metavar="DRAWS", help="Solve this many random contacts instead.")
]
Seed = Annotated[
    int | None,
    typer.Option(
        min=0, metavar="N", help="Seed of the draws; default: that of an unfinished sweep, else today's date."
    ),
]


@app.command()
@guarded
def verify(
    section: Sections = None,
    output: Output = None,
    quick: Annotated[bool, typer.Option("--quick", help="Coarse grids and few contacts: seconds.")] = False,
    robustness: Draws = None,
    seed: Seed = None,
    as_json: Json = False,
    quiet: Quiet = False,
) -> int:
    """Compute the verification page of the contact solver: orders, limits, films, costs."""
    if robustness is not None and section:
        raise CaseError("--robustness, --section: found together; allowed: one of them")
    if robustness is None and seed is not None:
        raise CaseError("--seed: found without --robustness; it is the seed of the random contacts")
    printed = as_json and output is None and robustness is None
    directory = None if printed else output or DIRECTORY
    if directory is not None:
        lock_output_directory(directory)
    try:
        if robustness is None or directory is None:
            sections = compute_page(list(section or SectionName), directory, quick, quiet)
        else:
            sections = [compute_sweep(robustness, seed, directory, quick, quiet)]
    except ForeignFileError as error:
        raise CaseError(str(error)) from None
    return report(sections, directory, as_json, quiet)


def compute_page(names: list[SectionName], directory: Path | None, quick: bool, quiet: bool) -> list[Section]:
    """Compute sections and write their page; after an interrupt those that are finished."""
    if directory is not None:
        check_page(directory, PAGE)
    report_cost((f"{len(names)} sections of the verification", SECTION_SECONDS[quick] * len(names)), quiet=quiet)
    finished: list[Section] = []
    try:
        with progress_bar(quiet=quiet) as progress:
            for section in page_sections.run_sections(names, progress, run_bearing, quick=quick):
                finished.append(section)
    except KeyboardInterrupt:
        keep_finished(finished, directory)
        raise
    if directory is not None:
        with finish_first(f"results in {directory}"):
            write_page(finished, directory, PAGE)
    return finished


def keep_finished(finished: list[Section], directory: Path | None) -> None:
    """Write the finished sections of an interrupted page; a complete page is not replaced."""
    if directory is None or not finished:
        print_message("oilfilm: no section is finished, nothing is kept")
        return
    target = directory
    if (directory / PAGE).exists():
        target = directory.with_name(f"{directory.name}_interrupted")
    with finish_first(f"finished sections in {target}"):
        write_page(finished, target, PAGE)
    print_message(f"finished sections in {target}")


def run_bearing() -> BearingResults:
    """Run the bearing of the section on cost."""
    return run_case(load_bearing(BEARING, "the cost of a bearing"))


def compute_sweep(count: int, seed: int | None, directory: Path, quick: bool, quiet: bool) -> Section:
    """Solve random contacts; without a seed those of an unfinished sweep, else those of today's date."""
    check_page(directory, SWEEP_PAGE)
    file = directory / SWEEP
    unfinished = seed_of(file) if seed is None else seed
    seed = int(date.today().strftime("%Y%m%d")) if unfinished is None else unfinished
    try:
        with progress_bar(quiet=quiet) as progress:
            finished = random_contacts.sweep(count, seed, file, progress, QUICK_OPTIONS if quick else None)
    except KeyboardInterrupt:
        print_message(f"finished contacts are kept in {file}; the same command continues with them")
        raise
    section = robustness_section(finished, seed)
    with finish_first(f"results in {directory}"):
        write_page([section], directory, SWEEP_PAGE)
    return section


def report(sections: list[Section], directory: Path | None, as_json: bool, quiet: bool) -> int:
    """Print the checks; the exit code is 1 where a statement does not hold."""
    results = document(sections)
    if directory is not None and not quiet:
        print_message(f"results in {directory}")
    if as_json:
        print_json(results)
    elif not quiet:
        print_table(checks_table(sections))
    if results["converged"]:
        return 0
    print_message("oilfilm: these statements do not hold:")
    for message in results["messages"]:
        print_message(f"  {message}")
    return NOT_CONVERGED


def checks_table(sections: list[Section]) -> Table:
    """All checks as a table for the terminal."""
    table = Table("statement", "found", "wanted", "holds")
    for section in sections:
        for check in section.checks:
            table.add_row(*check.cells)
    return table


def main() -> None:
    """Run the command; an interrupt gives up the contacts under way."""
    end_after_signal(INTERRUPTED)
    signal.signal(signal.SIGINT, interrupt)
    signal.signal(signal.SIGTERM, interrupt)
    try:
        app()
    except SystemExit as stop:
        if stop.code == INTERRUPTED:
            end_now(INTERRUPTED)
        raise


if __name__ == "__main__":
    main()
