"""The application `oilfilm` and its terminal: shared options, streams, exit codes, progress.

Streams may be closed, full, or of an encoding without some characters. Progress goes to standard
error, as a bar on a terminal and now and then as a line elsewhere.
"""

from __future__ import annotations

import functools
import json
import logging
import os
import signal
import sys
import tempfile
import threading
import traceback
from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager, ExitStack, contextmanager, suppress
from contextvars import ContextVar
from pathlib import Path
from time import monotonic
from types import FrameType
from typing import TYPE_CHECKING, Annotated, ParamSpec, TypeVar

import typer

from oilfilm.bearing.files import is_disk_failure
from oilfilm.bearing.library.plugins import PluginError
from oilfilm.ehl.foreign_files import DamagedFileError, one_line

from ..format.rules import CaseError
from ..runs.interrupt import SIGNALS, interrupt, print_message
from ..runs.kernel_cache import ensure_kernel_cache
from ..runs.output_directory import DIGESTS, damaged_files

if TYPE_CHECKING:
    from rich.console import RenderableType

STREAMS = (0, 1, 2)

NOT_CONVERGED = 1
BAD_INPUT = 2
INTERRUPTED = 3
FAILED = 4
KEPT_LOGS = 20  # of failures, in the temporary directory
MOST_MESSAGES = 20  # lines of errors shown; a file of garbage has hundreds
P = ParamSpec("P")
T = TypeVar("T")
EXIT_STACK: ContextVar[ExitStack] = ContextVar("EXIT_STACK")  # what a command holds until its end
app = typer.Typer(
    name="oilfilm",
    help="Oil films in every contact of a ball bearing.",
    epilog=(
        "Exit codes: 0 converged, 1 not converged, 2 bad input, 3 interrupted, "
        "4 failure of the machine."
    ),
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    no_args_is_help=True,
)
CaseName = Annotated[
    str,
    typer.Argument(
        metavar="CASE", help="A case file, with or without .toml, or the name of a shipped case."
    ),
]
Output = Annotated[
    Path | None,
    typer.Option("--output", "-o", metavar="DIR", help="Where results go; default: CASE_results."),
]
Json = Annotated[
    bool,
    typer.Option("--json", help="Print the summary as JSON; files are then written with -o only."),
]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="No progress, no table.")]
Answer = Annotated[bool, typer.Option("--json", help="Print JSON.")]  # nothing is written for it
Errors = Annotated[bool, typer.Option("--quiet", "-q", help="Nothing but errors.")]
Notes = Annotated[
    bool, typer.Option("--notes", help="Print assumptions and remarks below the table, too.")
]
FIRST_LINE = 5.0  # after the start of the work [s]; each further one after twice the time
LONGEST_SILENCE = 60.0  # [s]
ANEW = "compute the results again"


def prepare_streams() -> None:
    """Never fail on a character that an encoding does not have, nor on a stream that is closed.

    A closed one is opened on nothing: else the first file of results would take its place, and
    the messages of libraries.
    """
    for number in STREAMS:
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # takes the lowest number that is free
    sys.stdout = sys.stdout or open(1, "w", encoding="utf-8", closefd=False)  # noqa: SIM115
    sys.stderr = sys.stderr or open(2, "w", encoding="utf-8", closefd=False)  # noqa: SIM115
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="replace")


def drop_output() -> None:
    """Lose what standard output has not taken, so that Python does not fail on it at its end."""
    with suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def output_is_written() -> bool:
    """Tell whether standard output took everything; a message if its disk is full, none if its
    reader has ended.
    """
    try:
        sys.stdout.flush()
    except BrokenPipeError:
        drop_output()
    except OSError as error:
        print_message(f"oilfilm: failed: standard output: {error.strerror or error}")
        drop_output()
        return False
    return True


def guarded(command: Callable[P, int | None]) -> Callable[P, None]:
    """Turn the result or the error of a command into an exit code and a message without traceback.

    Parameters
    ----------
    command : Callable[P, int | None]
        The command.

    Returns
    -------
    Callable[P, None]
        The command for Typer.
    """

    @functools.wraps(command)
    def run(*args: P.args, **kwargs: P.kwargs) -> None:
        def prepared() -> int | None:
            ensure_kernel_cache()  # before anything imports numba
            with ExitStack() as stack:
                EXIT_STACK.set(stack)
                return command(*args, **kwargs)

        code = exit_code(prepared)
        if code:
            raise typer.Exit(code)

    return run


def command(name: str | None = None) -> Callable[[Callable[P, int | None]], Callable[P, None]]:
    """Register a function as a command of `oilfilm`, guarded.

    Parameters
    ----------
    name : str | None, optional
        Name of the command; that of the function if left out.

    Returns
    -------
    Callable[[Callable[P, int | None]], Callable[P, None]]
        The decorator.
    """
    return lambda function: app.command(name)(guarded(function))


def enter_context(manager: AbstractContextManager[T]) -> T:
    """Enter a context that ends with the command.

    Parameters
    ----------
    manager : AbstractContextManager[T]
        The context.

    Returns
    -------
    T
        Its value.
    """
    return EXIT_STACK.get().enter_context(manager)


def exit_code(command: Callable[[], int | None]) -> int:
    """Run a command: 0 done, 1 not converged, 2 bad input, 3 interrupted, 4 failure [-].

    Parameters
    ----------
    command : Callable[[], int | None]
        The command.

    Returns
    -------
    int
        Exit code.
    """
    main = threading.current_thread() is threading.main_thread()
    came: list[int] = []  # signals

    def note(number: int, frame: FrameType | None) -> None:
        came.append(number)
        interrupt(number, frame)

    previous = {one: signal.signal(one, note) for one in SIGNALS} if main else {}
    try:
        return command() or 0
    except CaseError as error:
        _print_errors(error.messages)
        return BAD_INPUT
    except (PluginError, DamagedFileError) as error:
        print_message(f"oilfilm: {error}")
        return BAD_INPUT
    except KeyboardInterrupt:
        print_message("oilfilm: interrupted")
        return INTERRUPTED
    except BrokenPipeError:  # the reader of a pipe has seen enough
        drop_output()
        return 0
    except typer.Exit as stop:
        return stop.exit_code
    except Exception as error:
        if came or _is_of_an_interrupt(error):
            print_message("oilfilm: interrupted")
            return INTERRUPTED
        print_message(f"oilfilm: {_machine_failure(error)}; details: {_log(error)}")
        return FAILED
    finally:
        for one, handler in previous.items():
            signal.signal(one, handler)


def _print_errors(messages: Iterable[str]) -> None:
    lines = list(messages)
    for line in lines[:MOST_MESSAGES]:
        print_message(line)
    if len(lines) > MOST_MESSAGES:
        print_message(f"... and {len(lines) - MOST_MESSAGES} more errors")


def _is_of_an_interrupt(error: BaseException | None) -> bool:
    """Tell whether an interrupt led to the error, as where a compiled library takes it for its
    own.
    """
    while error is not None and not isinstance(error, KeyboardInterrupt):
        error = error.__cause__ or error.__context__
    return error is not None


def _machine_failure(error: Exception) -> str:
    if isinstance(error, OSError):
        name = f" {error.filename}:" if error.filename else ""
        return f"failed:{name} {error.strerror or error}"
    if isinstance(error, MemoryError):
        return "failed: out of memory"
    text = " ".join(str(error).split())
    return f"internal error: {type(error).__name__}: {text[:200]}"


def _log(error: Exception) -> str:
    """Write the traceback to a file and name it; the oldest of those before go."""
    try:
        with suppress(OSError):  # another process may sweep, too
            logs = sorted(
                Path(tempfile.gettempdir()).glob("oilfilm-????????.log"),
                key=lambda path: path.lstat().st_mtime,
            )
            for path in logs[: 1 - KEPT_LOGS]:
                path.unlink()
        with tempfile.NamedTemporaryFile(
            "w", prefix="oilfilm-", suffix=".log", delete=False, encoding="utf-8"
        ) as log:
            log.write("".join(traceback.format_exception(error)))
            return log.name
    except OSError:
        return "no log, the temporary directory cannot be written"


def print_lines(*lines: str) -> None:
    """Print plain text to standard output.

    Parameters
    ----------
    *lines : str
        Lines; ends of lines in one, as of a file's name, are written out.
    """
    print("\n".join(map(one_line, lines)), flush=True)  # noqa: T201


def print_json(document: object) -> None:
    """Print a document as JSON to standard output.

    Parameters
    ----------
    document : object
        Values of plain types.
    """
    text = json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False)
    print_lines(*text.split("\n"))


def print_table(table: RenderableType) -> None:
    """Print a table to standard output.

    Parameters
    ----------
    table : RenderableType
        The table.
    """
    from rich.console import Console

    Console(markup=False).print(table)


def _print_version(requested: bool) -> None:
    if requested:
        from oilfilm.ehl.version import version

        print_lines(f"oilfilm {version()}")
        raise typer.Exit


@app.callback()
def oilfilm(
    _version: Annotated[
        bool,
        typer.Option(
            "--version", callback=_print_version, is_eager=True, help="Print the version."
        ),
    ] = False,
) -> None:
    """Oil films in every contact of a ball bearing."""


@contextmanager
def progress_bar(*, quiet: bool) -> Iterator[Callable[[int, int, str], None]]:
    """A callback that shows progress on standard error.

    Parameters
    ----------
    quiet : bool
        True: nothing is shown.

    Yields
    ------
    Iterator[Callable[[int, int, str], None]]
        Function of steps done, steps in all, and a text.
    """
    if quiet:
        yield lambda done, total, state: None
        return
    with _report_compilation(), _bar() if sys.stderr.isatty() else _lines() as show:
        yield show


@contextmanager
def _bar() -> Iterator[Callable[[int, int, str], None]]:
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TimeElapsedColumn

    columns = ("{task.description}", BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("", total=None)

        def show(done: int, total: int, state: str) -> None:
            bar.update(task, completed=done, total=total, description=state)

        yield show


@contextmanager
def _lines() -> Iterator[Callable[[int, int, str], None]]:
    """Lines from a thread: also while a long step reports nothing."""
    began = monotonic()
    over = threading.Event()
    last = ["starting"]

    def show(done: int, total: int, state: str) -> None:
        last[0] = f"{state}, {done} of {total}" if total > 1 else state

    def speak() -> None:
        pause = FIRST_LINE
        while not over.wait(pause):
            print_message(f"oilfilm: after {monotonic() - began:.0f} s: {last[0]}")
            pause = min(2.0 * pause, LONGEST_SILENCE)

    threading.Thread(target=speak, daemon=True).start()
    try:
        yield show
    finally:
        over.set()


class _CompilationNotice(logging.Handler):
    """Says once that kernels are being compiled."""

    def emit(self, record: logging.LogRecord) -> None:
        """Print the message of the first record and leave the logger."""
        logging.getLogger(record.name).removeHandler(self)
        print_message(f"oilfilm: {record.getMessage()}")


@contextmanager
def _report_compilation() -> Iterator[None]:
    """Tell when kernels are compiled."""
    logger = logging.getLogger("oilfilm.ehl.compiled")
    notice = _CompilationNotice()
    logger.setLevel(logging.INFO)
    logger.addHandler(notice)
    try:
        yield
    finally:
        logger.removeHandler(notice)


@contextmanager
def reading(*directories: Path) -> Iterator[None]:
    """Read folders of results inside; damaged files are reported.

    Parameters
    ----------
    *directories : Path
        The folders.

    Raises
    ------
    CaseError
        If a folder does not exist, or its content is damaged or wrong.
    """
    for directory in directories:
        if not directory.is_dir():
            found = "is a file" if directory.is_file() else "no such directory"
            raise CaseError(f"{directory}: {found}; allowed: a directory of results")
    damaged = [path for directory in directories for path in damaged_files(directory)]
    try:
        yield
    except CaseError:
        raise
    except Exception as error:
        if is_disk_failure(error):
            raise
        if damaged:
            raise CaseError(f"{damaged[0]}: damaged, not as it was written; {ANEW}") from error
        if isinstance(error, ValueError):
            raise CaseError(str(error)) from error
        for directory in directories:
            if not (directory / DIGESTS).is_file():
                raise CaseError(f"{directory}: damaged or not of oilfilm; {ANEW}") from error
        raise
    for path in damaged:
        print_message(f"oilfilm: {path}: changed since it was written; {ANEW}")
