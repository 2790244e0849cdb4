"""What worker processes of all commands do before they work."""

import os
import signal
import threading
from collections.abc import Set
from multiprocessing import active_children, connection, parent_process
from multiprocessing.process import BaseProcess
from typing import Any

PATIENCE = 0.2  # for a process to be gone after its end was asked for [s]
THREADS = (
    "OMP_NUM_THREADS",
    "OPENBLAS_NUM_THREADS",
    "MKL_NUM_THREADS",
    "VECLIB_MAXIMUM_THREADS",
    "NUMBA_NUM_THREADS",
)


def one_thread() -> None:
    """One thread for libraries that are not loaded yet, unless the user gives a number: vectors of
    some thousand numbers are handed between threads more slowly than they are added.
    """
    for name in THREADS:
        os.environ.setdefault(name, "1")


def prepare_worker() -> None:
    """In a new process: one thread each; Ctrl-C is left to the parent; ends with the parent."""
    os.environ.update(dict.fromkeys(THREADS, "1"))
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = parent_process()
    if parent is not None:
        threading.Thread(target=_end_with, args=(parent.sentinel,), daemon=True).start()


def _end_with(sentinel: Any) -> None:
    connection.wait([sentinel])
    os._exit(1)


def end_workers(others: Set[BaseProcess]) -> None:
    """End the workers of this process, but those that others have started, whatever they do."""
    ended = set(active_children()) - others
    for process in ended:
        process.terminate()
    for process in ended:
        process.join(PATIENCE)
