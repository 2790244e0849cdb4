"""Messages on standard error, work that an interrupt gives up at once, and work that it lets
finish.
"""

import _thread
import os
import signal
import socket
import sys
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Future, wait
from contextlib import contextmanager, suppress
from time import sleep
from types import FrameType
from typing import TypeVar

from oilfilm.ehl.foreign_files import one_line

T = TypeVar("T")

SIGNALS = (signal.SIGINT, signal.SIGTERM)
PATIENCE = 1.4  # from a signal to the end of a program that does not answer it [s]
LOOK = 0.05  # from one look to the next [s]


def print_message(text: str) -> None:
    """Print a message on one line of standard error; it is lost where nobody reads it.

    Parameters
    ----------
    text : str
        The message; ends of lines in it, as of a file's name, are written out.
    """
    with suppress(OSError, ValueError):
        print(one_line(text), file=sys.stderr, flush=True)  # noqa: T201


def interrupt(_number: int, _frame: FrameType | None) -> None:
    """Interrupt as Ctrl-C does; a handler of signals.

    Parameters
    ----------
    _number : int
        Number of the signal.
    _frame : FrameType | None
        Interrupted frame.

    Raises
    ------
    KeyboardInterrupt
        Always.
    """
    raise KeyboardInterrupt


class _Postponed:
    """A handler of signals that remembers the first and obeys the second."""

    def __init__(self, what: str, hurry: Callable[[], None] | None) -> None:
        self.what = what
        self.hurry = hurry
        self.signals = 0

    def __call__(self, number: int, frame: FrameType | None) -> None:
        self.signals += 1
        if self.signals > 1:
            raise KeyboardInterrupt
        print_message(f"oilfilm: finishing first: {self.what}")
        if self.hurry is not None:
            self.hurry()


@contextmanager
def finish_first(what: str, hurry: Callable[[], None] | None = None) -> Iterator[None]:
    """Delay an interrupt until the work inside is done; a second one is obeyed at once.

    Parameters
    ----------
    what : str
        Description of the work for the message.
    hurry : Callable[[], None] | None, optional
        Called at the first interrupt, to leave out what can be left out.

    Raises
    ------
    KeyboardInterrupt
        After the work, if there was an interrupt.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    postponed = _Postponed(what, hurry)
    previous = {number: signal.signal(number, postponed) for number in SIGNALS}
    try:
        yield
    finally:
        for number, handler in previous.items():
            signal.signal(number, handler)
    if postponed.signals:
        raise KeyboardInterrupt


def interruptible(work: Callable[[], T], meanwhile: Callable[[], None] | None = None) -> T:
    """Do work in a thread, so that an interrupt is obeyed also while it runs compiled code.

    After an interrupt the thread continues until the program ends.

    Parameters
    ----------
    work : Callable[[], T]
        The work.
    meanwhile : Callable[[], None] | None, optional
        Called now and then.

    Returns
    -------
    T
        Result of the work.

    Raises
    ------
    KeyboardInterrupt
        At an interrupt, at once.
    """
    if threading.current_thread() is not threading.main_thread():
        return work()
    future: Future[T] = Future()

    def run() -> None:
        try:
            future.set_result(work())
        except BaseException as error:  # raised again where the result is wanted
            future.set_exception(error)

    threading.Thread(target=run, daemon=True).start()
    while not wait([future], timeout=LOOK).done:
        if meanwhile is not None:
            meanwhile()
    return future.result()


def end_after_signal(code: int) -> Callable[[], bool]:
    """End the program where it does not end within `PATIENCE` of a signal.

    It then runs compiled code, or waits for a process. Work that is to finish first has its time.

    Parameters
    ----------
    code : int
        Exit code.

    Returns
    -------
    Callable[[], bool]
        Function that tells whether a signal has come, also one of this very moment.
    """
    reader, writer = socket.socketpair()
    writer.setblocking(False)
    signal.set_wakeup_fd(writer.fileno(), warn_on_full_buffer=False)
    came = threading.Event()
    lost = threading.Event()
    _silence_after(came, lost)

    def watch() -> None:
        with writer:  # open as long as this thread
            while reader.recv(1)[0] not in SIGNALS:
                pass
            came.set()
            left = PATIENCE
            while left > 0.0:
                sleep(LOOK)
                left -= 0.0 if _finishing() else LOOK
                if lost.is_set():
                    lost.clear()
                    _thread.interrupt_main()
            print_message("oilfilm: interrupted")
            end_now(code)

    threading.Thread(target=watch, daemon=True).start()
    return lambda: came.wait(LOOK)  # the thread that sees it may not have run yet


def _silence_after(came: threading.Event, lost: threading.Event) -> None:
    """After a signal (`came`) say nothing of finalizers and threads that fail: their objects may
    be half built, their work given up.

    Python drops an interrupt that falls into a finalizer, with a traceback: it is `lost`.
    """
    finalizers, threads = sys.unraisablehook, threading.excepthook

    def of_finalizer(unraisable: "sys.UnraisableHookArgs") -> None:
        if issubclass(unraisable.exc_type, KeyboardInterrupt):
            lost.set()
        elif not came.wait(LOOK):  # the thread that sees it may not have run yet
            finalizers(unraisable)

    def of_thread(failure: threading.ExceptHookArgs) -> None:
        if not came.wait(LOOK):
            threads(failure)

    sys.unraisablehook = of_finalizer
    threading.excepthook = of_thread


def _finishing() -> bool:
    """Tell whether work is under way that an interrupt lets finish."""
    handler = signal.getsignal(signal.SIGINT)
    return isinstance(handler, _Postponed) and handler.signals < 2


def end_now(code: int) -> None:
    """End the program and its worker processes without waiting for unfinished work.

    Functions registered for the end of the program are called.

    Parameters
    ----------
    code : int
        Exit code.
    """
    processes = sys.modules.get("multiprocessing")
    for process in [] if processes is None else processes.active_children():
        process.kill()
    cleaning = threading.Thread(target=_clean_up, daemon=True)
    cleaning.start()
    cleaning.join(10.0 * LOOK)
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError, ValueError):
            stream.flush()
    os._exit(code)


def _clean_up() -> None:
    """Remove temporary folders, as the program would at its end."""
    import atexit

    with suppress(BaseException):
        atexit._run_exitfuncs()
