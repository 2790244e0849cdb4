"""The command `oilfilm`."""

from __future__ import annotations

import json
import sys
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from .problems import CaseError
from .terminal import (
    BAD_INPUT,
    FAILED,
    NOT_CONVERGED,
    exit_code,
    finish_first,
    guarded,
    prepare_streams,
    print_lines,
    progress_bar,
    say,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from rich.console import Group

    from postprocess.results import BearingResults, ContactResults

    from .run import Progress


app = typer.Typer(
    name="oilfilm",
    help="Oil films in every contact of a ball bearing.",
    epilog="Exit codes: 0 converged, 1 not converged, 2 bad input, 3 interrupted, 4 failure of the machine.",
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    no_args_is_help=True,
)

CaseName = Annotated[str, typer.Argument(metavar="CASE", help="A case file, or the name of a shipped case.")]
Output = Annotated[
    Path | None, typer.Option("--output", "-o", metavar="DIR", help="Where results go; default CASE_results.")
]
Json = Annotated[bool, typer.Option("--json", help="Print the summary as JSON; files are then written with -o only.")]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="No progress, no table.")]


class Method(StrEnum):
    """Discretisation of the contact solver."""

    MULTIGRID = "multigrid"
    FINITE_ELEMENT = "finite-element"


class Quantity(StrEnum):
    """What the colours of the view show."""

    FILM = "film"
    PRESSURE = "pressure"


class Listing(StrEnum):
    """What `oilfilm list` shows."""

    CASES = "cases"
    BEARINGS = "bearings"
    MATERIALS = "materials"
    LUBRICANTS = "lubricants"


def _print_version(wanted: bool) -> None:
    if wanted:
        from .version import version

        print_lines(f"oilfilm {version()}")
        raise typer.Exit


@app.callback()
def oilfilm(
    _version: Annotated[
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Print the version.")
    ] = False,
) -> None:
    """Oil films in every contact of a ball bearing."""


@app.command()
@guarded
def run(
    case: CaseName,
    output: Output = None,
    workers: Annotated[int | None, typer.Option(min=1, metavar="N", help="Contacts at a time; default: cores.")] = None,
    as_json: Json = False,
    quiet: Quiet = False,
) -> int:
    """Run a bearing case: loads, film maps, pictures, VTK."""
    from .case import Case, load_case

    loaded = load_case(case)
    if not isinstance(loaded, Case):
        raise CaseError([f"{case}: is a single contact; run it with 'oilfilm contact {case}'"])
    directory = _directory(case, output, as_json)
    _prepare()
    from .run import Interrupted, run_case

    try:
        with progress_bar(quiet=quiet) as progress:
            results = run_case(loaded, workers, progress)
            _save(results, directory, progress)
    except Interrupted as stop:
        if stop.results is not None and directory is not None:
            kept = directory if not directory.exists() else Path(f"{directory}_interrupted")
            _save(stop.results, kept)
            say(f"finished films in {kept}")
        raise KeyboardInterrupt from None
    return _finish(results, directory, as_json=as_json, quiet=quiet)


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
    from .case import ContactCase, load_case

    loaded = load_case(case)
    if not isinstance(loaded, ContactCase):
        raise CaseError([f"{case}: is a bearing; run it with 'oilfilm run {case}'"])
    directory = _directory(case, output, as_json)
    _prepare()
    from .run import run_contact

    with progress_bar(quiet=quiet) as progress:
        progress(0, 1, "film")
        results = run_contact(loaded, finite_element=method is Method.FINITE_ELEMENT)
        _save(results, directory, progress)
    return _finish(results, directory, as_json=as_json, quiet=quiet)


@app.command()
@guarded
def slip(
    case: CaseName,
    output: Output = None,
    workers: Annotated[int | None, typer.Option(min=1, metavar="N", help="Processes; default: cores.")] = None,
    as_json: Json = False,
    quiet: Quiet = False,
) -> int:
    """Map gross slip of the balls after Hirano, and the minimum preload, from a [slip] table."""
    from .case import Case, load_case

    loaded = load_case(case)
    if not isinstance(loaded, Case):
        raise CaseError([f"{case}: is a single contact; slip maps need a bearing"])
    directory = _directory(case, output, as_json)
    from .slip import run_slip

    with progress_bar(quiet=quiet) as progress:
        results = run_slip(loaded, case, workers, progress)
    from postprocess.slip_results import slip_summary, slip_table, write_slip

    _save_with(lambda folder: write_slip(results, folder), directory)
    return _report(slip_summary(results), lambda: slip_table(results), directory, as_json=as_json, quiet=quiet)


@app.command()
@guarded
def view(
    directory: Annotated[Path, typer.Argument(metavar="DIR", help="A directory of results.")],
    screenshot: Annotated[
        Path | None, typer.Option(metavar="FILE.png", help="Write a picture, open no window.")
    ] = None,
    quantity: Annotated[Quantity, typer.Option(help="What the colours show.")] = Quantity.FILM,
    magnification: Annotated[
        float | None, typer.Option(min=1.0, max=1e3, help="Of the patches; default: so that they can be seen.")
    ] = None,
    exaggeration: Annotated[float, typer.Option(min=0.0, max=1e6, help="Film drawn as height, times this.")] = 0.0,
) -> int:
    """Look at results in three dimensions."""
    if not directory.is_dir():
        raise CaseError([f"{directory}: no such directory; allowed: a directory of results of 'oilfilm run'"])
    from postprocess import scene

    factors = None if magnification is None else (magnification, magnification)
    options = scene.SceneOptions(quantity=quantity.value, magnification=factors, film_exaggeration=exaggeration)
    try:
        if screenshot is None:
            scene.show(directory, options)
        else:
            scene.screenshot(directory, screenshot, options)
            say(f"picture in {screenshot}")
    except ValueError as error:
        raise CaseError([str(error)]) from error
    except scene.RenderingError as error:
        say(f"oilfilm: {error}")
        return FAILED
    return 0


@app.command("list")
@guarded
def list_names(
    what: Annotated[Listing | None, typer.Argument(help="What to list; all if left out.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
) -> None:
    """List shipped cases, bearings, materials and lubricants."""
    from .listing import listing

    names = {kind.value: listing(kind.value) for kind in (Listing if what is None else (what,))}
    if as_json:
        print_lines(json.dumps(names, indent=2, ensure_ascii=False))
        return
    width = max(len(name) for entries in names.values() for name in entries)
    for kind, entries in names.items():
        if what is None:
            print_lines(f"{kind}:")
        indent = "  " if what is None else ""
        for name, remark in entries.items():
            print_lines(f"{indent}{name:{width}}  {remark}".rstrip())


@app.command()
@guarded
def validate(
    cases: Annotated[list[str], typer.Argument(metavar="CASE...", help="Case files or names of shipped cases.")],
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Nothing but errors.")] = False,
) -> int:
    """Check case files without running them."""
    from .case import read_text, validate_text
    from .shipped import find_case

    errors: dict[str, list[str]] = {}
    for case in cases:
        try:
            path = find_case(case)
            validate_text(read_text(path), str(path))
            errors[case] = []
        except CaseError as error:
            errors[case] = list(error.messages)
    if as_json:
        report = {case: {"valid": not messages, "errors": messages} for case, messages in errors.items()}
        print_lines(json.dumps(report, indent=2, ensure_ascii=False))
    else:
        for case, messages in errors.items():
            if not messages and not quiet:
                print_lines(f"{case}: valid")
            for message in messages:
                say(message)
    return BAD_INPUT if any(errors.values()) else 0


@app.command()
@guarded
def init(
    name: Annotated[str, typer.Argument(metavar="NAME", help="Name of the new case file.")],
    template: Annotated[
        str, typer.Option("--from", metavar="CASE", help="The case to start from.")
    ] = "6208_full_ceramic",
) -> None:
    """Write a new case file to start from."""
    from .case import read_text
    from .shipped import find_case

    path = Path(name if name.endswith(".toml") else f"{name}.toml")
    text = read_text(find_case(template))
    try:
        with path.open("x", encoding="utf-8", newline="\n") as file:
            file.write(text)
    except FileExistsError:
        raise CaseError([f"{path}: exists already; choose another name"]) from None
    except (OSError, ValueError) as error:
        raise CaseError([f"{path}: cannot be written: {getattr(error, 'strerror', None) or error}"]) from None
    print_lines(f"{path} written; change it, then: oilfilm validate {path}")


@app.command()
@guarded
def schema() -> None:
    """Print the JSON Schema of case files, for editors."""
    from .case import json_schema

    print_lines(json.dumps(json_schema(), indent=2))


def _directory(case: str, output: Path | None, as_json: bool) -> Path | None:
    """Where the results go; None with --json alone."""
    from .output_directory import check_output

    if output is None and as_json:
        return None
    directory = output if output is not None else Path(f"{Path(case).stem}_results")
    check_output(directory)
    return directory


def _prepare() -> None:
    """What must be set before numba is imported."""
    from .kernel_cache import ensure_kernel_cache

    ensure_kernel_cache()


def _save(results: BearingResults | ContactResults, directory: Path | None, progress: Progress | None = None) -> None:
    """Write the results, if a directory is asked for."""
    if directory is not None and progress is not None:
        progress(0, 1, "pictures and files")
    from postprocess import write_results

    _save_with(lambda folder: write_results(results, folder), directory)


def _save_with(write: Callable[[Path], tuple[str, ...]], directory: Path | None) -> None:
    """Have `write` fill the directory, if one is asked for."""
    if directory is None:
        return
    from .output_directory import save

    with finish_first(f"results in {directory}"):
        for problem in save(write, directory):
            say(f"oilfilm: {problem}")


def _finish(results: BearingResults | ContactResults, directory: Path | None, *, as_json: bool, quiet: bool) -> int:
    """Print what a run found, and tell what did not converge."""
    from postprocess import summary
    from postprocess.table import result_table

    return _report(summary(results), lambda: result_table(results), directory, as_json=as_json, quiet=quiet)


def _report(
    document: dict[str, Any], table: Callable[[], Group], directory: Path | None, *, as_json: bool, quiet: bool
) -> int:
    """Print a summary or its table, and tell what did not converge."""
    if directory is not None and not quiet:
        say(f"results in {directory}")
    if as_json:
        print_lines(json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False))
    elif not quiet:
        from rich.console import Console

        Console().print(table())
    if document["converged"]:
        return 0
    say("oilfilm: not converged; the results are flagged:")
    for message in document["messages"]:
        if "not converged" in message or message.startswith(("equilibrium of", "no film was computed")):
            say(f"  {message}")
    return NOT_CONVERGED


def main() -> None:
    """Entry point of the command."""
    prepare_streams()
    sys.exit(exit_code(app))


if __name__ == "__main__":
    main()
