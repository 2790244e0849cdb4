"""What the commands that compute share: where results go, how they are written and reported."""

from __future__ import annotations

from pathlib import Path
from textwrap import TextWrapper
from typing import TYPE_CHECKING, Any

from ..format.problems import CaseError
from ..runs.interrupt import finish_first, print_message
from .terminal import NOT_CONVERGED, enter_context, print_json, print_table

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from rich.console import Group

    from postprocess.bearing.results import BearingResults
    from postprocess.contact.results import ContactResults

    from ..format.case import Case
    from ..runs.drawing import Drawing
    from ..runs.films import Progress


def load_bearing(name: str, needed: str, *, heated: bool = True, own_table: bool = True) -> Case:
    """The bearing case of a name; `CaseError` saying what is `needed` for a single contact.

    `heated`: at the temperature that it warms itself to by formulas; a run finds its own;
    `own_table`: with the traction tables that it names, which `oilfilm table` makes.
    """
    from ..format.case import Case, load_case
    from ..runs.heating import at_its_temperature

    case = load_case(name, own_table=own_table)
    if not isinstance(case, Case):
        raise CaseError(f"{name}: is a single contact; {needed}")
    return at_its_temperature(case) if heated else case


def results_directory(case: str, output: Path | None, as_json: bool) -> Path | None:
    """Where the results go; None with --json alone."""
    if output is None and as_json:
        return None
    from ..runs.output_directory import check_replaceable

    directory = lock_output_directory(output or Path(f"{Path(case).stem}_results"))
    check_replaceable(directory)
    return directory


def lock_output_directory(directory: Path, *, shared: bool = False) -> Path:
    """A folder that can be written, held against other programs until the command ends; `shared`
    with those that write parts of it of their own.
    """
    from ..runs.output_directory import check_output
    from ..runs.output_lock import one_writer

    check_output(directory)
    enter_context(one_writer(directory, shared=shared))
    return directory


def lock_output_file(file: Path) -> Path:
    """A file that can be written, held against other programs until the command ends."""
    from ..runs.output_directory import check_file
    from ..runs.output_lock import one_writer

    check_file(file)
    enter_context(one_writer(file))
    return file


def save(
    results: BearingResults | ContactResults,
    directory: Path | None,
    drawing: Drawing,
    progress: Progress | None = None,
) -> None:
    """Write the results into a directory, if there is one; after an interrupt numbers alone."""
    if directory is not None and progress is not None:
        progress(0, 1, "pictures and files")
    save_with(lambda folder: drawing.write(results, folder), directory, drawing.stop)


def save_with(
    write: Callable[[Path], tuple[str, ...]],
    directory: Path | None,
    hurry: Callable[[], None] | None = None,
) -> None:
    """Let `write` fill the directory, if there is one, in a `hurry` after an interrupt."""
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
) -> int:
    """Print a summary or its table, and what did not converge."""
    if directory is not None and not quiet:
        print_message(f"results in {directory}")
    if as_json:
        print_json(document)
    elif not quiet:
        print_notes(document["messages"])
        print_table(table())
    if document["converged"]:
        return 0
    print_message("oilfilm: not converged; the results are flagged:")
    reasons = [message for message in document["messages"] if _of_failure(message)]
    for message in reasons or document["messages"]:
        print_message(f"  {message}")
    return NOT_CONVERGED


def print_notes(messages: Iterable[str]) -> None:
    """Print estimates, assumptions and values outside their data; not why values are null,
    but why a loaded contact has no film.
    """
    wrapper = TextWrapper(80, "note: ", "      ", break_long_words=False)
    for message in messages:
        lacks_film = "film null, a light load" in message
        if (lacks_film or "null" not in message) and not _of_failure(message):
            print_message(wrapper.fill(message.replace("film null", "no film")))


def _of_failure(message: str) -> bool:
    """Whether a message belongs to what did not converge."""
    return "not converged" in message or message.startswith(
        ("equilibrium of", "no film was computed")
    )
