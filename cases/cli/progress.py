"""Progress on standard error: a bar on a terminal, now and then a line elsewhere."""

from __future__ import annotations

import logging
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from time import monotonic

from ..runs.interrupt import print_message

FIRST_LINE = 5.0  # after the start of the work [s]; each further one after twice the time
LONGEST_SILENCE = 60.0  # [s]


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
    logger = logging.getLogger("ehl.compiled")
    notice = _CompilationNotice()
    logger.setLevel(logging.INFO)
    logger.addHandler(notice)
    try:
        yield
    finally:
        logger.removeHandler(notice)
