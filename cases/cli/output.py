"""Output of the commands that compute: directories, files and messages."""

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
    from postprocess.contact.summary import ContactResults

    from ..format.case import Case
    from ..runs.drawing import Drawing
    from ..runs.films import Progress


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
    from ..runs.output_directory import check_output
    from ..runs.output_lock import one_writer

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
) -> int:
    """Print a summary or its table, and the parts that did not converge.

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

    Returns
    -------
    int
        Exit code.
    """
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
            print_message(wrapper.fill(message.replace("film null", "no film")))


def _of_failure(message: str) -> bool:
    """Tell whether a message belongs to a part that did not converge."""
    return "not converged" in message or message.startswith(
        ("equilibrium of", "no film was computed")
    )
