"""Exit codes, error messages, and printing of results."""

from __future__ import annotations

import functools
import json
import signal
import tempfile
import threading
import traceback
from collections.abc import Callable, Iterable
from contextlib import AbstractContextManager, ExitStack
from contextvars import ContextVar
from typing import TYPE_CHECKING, ParamSpec, TypeVar

import typer

from bearing.library.plugins import PluginError

from ..format.problems import CaseError
from ..runs.interrupt import interrupt, print_message
from ..runs.kernel_cache import ensure_kernel_cache
from .streams import drop_output

if TYPE_CHECKING:
    from rich.console import RenderableType

NOT_CONVERGED = 1
BAD_INPUT = 2
INTERRUPTED = 3
FAILED = 4
MOST_MESSAGES = 20  # lines of errors shown; a file of garbage has hundreds

P = ParamSpec("P")
T = TypeVar("T")

EXIT_STACK: ContextVar[ExitStack] = ContextVar("HELD")  # what a command holds until its end


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
    previous = signal.signal(signal.SIGTERM, interrupt) if main else None
    try:
        return command() or 0
    except CaseError as error:
        _print_errors(error.messages)
        return BAD_INPUT
    except PluginError as error:
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
        if _is_of_an_interrupt(error):
            print_message("oilfilm: interrupted")
            return INTERRUPTED
        print_message(f"oilfilm: {_machine_failure(error)}; details: {_log(error)}")
        return FAILED
    finally:
        if main:
            signal.signal(signal.SIGTERM, previous)


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
    """Write the traceback to a file and name it."""
    try:
        with tempfile.NamedTemporaryFile(
            "w", prefix="oilfilm-", suffix=".log", delete=False, encoding="utf-8"
        ) as log:
            log.write("".join(traceback.format_exception(error)))
            return log.name
    except OSError:
        return "no log, the temporary directory cannot be written"


def print_lines(text: str) -> None:
    """Print plain text to standard output.

    Parameters
    ----------
    text : str
        The text.
    """
    print(text, flush=True)  # noqa: T201


def print_json(document: object) -> None:
    """Print a document as JSON to standard output.

    Parameters
    ----------
    document : object
        Values of plain types.
    """
    print_lines(json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False))


def print_table(table: RenderableType) -> None:
    """Print a table to standard output.

    Parameters
    ----------
    table : RenderableType
        The table.
    """
    from rich.console import Console

    Console().print(table)
