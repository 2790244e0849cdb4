"""Worker processes of all commands: how they begin, what they do first, how they end."""

import gc
import logging
import os
import signal
import sys
import threading
from collections.abc import Iterator, Sequence, Set
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import contextmanager, suppress
from multiprocessing import (
    active_children,
    connection,
    forkserver,
    get_all_start_methods,
    get_context,
    parent_process,
    resource_tracker,
    set_forkserver_preload,
)
from multiprocessing.context import BaseContext
from multiprocessing.process import BaseProcess
from pathlib import Path
from typing import Any

PATIENCE = 0.2  # for a process to be gone after its end was asked for [s]
THREADS = tuple(
    (
        "OMP_NUM_THREADS OPENBLAS_NUM_THREADS MKL_NUM_THREADS VECLIB_MAXIMUM_THREADS "
        "NUMBA_NUM_THREADS"
    ).split()
)
# new objects from which the collector looks for cycles: with Python's own 700 it takes a fifth of
# the time in which a bearing case is loaded, with this a tenth, with half and double of it as much
COLLECTED = 50_000
POINTS = ("oilfilm.cases.batch.compute",)  # what computes the points of a batch
FORK_SERVER = "forkserver"  # loads the libraries once for all processes, where there is one


def one_thread() -> None:
    """One thread for libraries that are not loaded yet, unless the user gives a number: vectors of
    some thousand numbers are handed between threads more slowly than they are added.
    """
    for name in THREADS:
        os.environ.setdefault(name, "1")


def has_fork_server() -> bool:
    """Tell whether processes are copied from a prepared one; macOS does not support it."""
    return FORK_SERVER in get_all_start_methods() and sys.platform != "darwin"


def worker_context() -> BaseContext:
    """How worker processes are begun: copied from a prepared one, or anew."""
    return get_context(FORK_SERVER if has_fork_server() else "spawn")


def worker_pool(workers: int) -> Executor:
    """Processes that compute or draw; one thread of this process where the system has no
    semaphores, as containers without `/dev/shm`.

    Parameters
    ----------
    workers : int
        Number of processes [-].

    Returns
    -------
    Executor
        The processes, none of them begun yet.
    """
    try:
        return ProcessPoolExecutor(
            workers, mp_context=worker_context(), initializer=prepare_worker
        )
    except (ImportError, NotImplementedError, OSError) as error:
        text = "no processes beside this one (%s: %s); all is done here, one after the other"
        logging.getLogger(__name__).warning(text, "semaphores, /dev/shm", error)
        return ThreadPoolExecutor(1)


def own_packages() -> dict[str, str]:
    """Environment of processes that are to import the packages of this one, and not those of the
    folder they start in.
    """
    paths = [
        str(Path(sys.modules["oilfilm"].__file__ or "").parents[1]),
        *os.environ.get("PYTHONPATH", "").split(os.pathsep),
    ]
    paths = list(dict.fromkeys(filter(None, paths)))
    return {"PYTHONSAFEPATH": "1", "PYTHONPATH": os.pathsep.join(paths)}


def start_fork_server(modules: Sequence[str]) -> None:
    """Begin to load modules in a process of one thread from which worker processes are copied.

    Ctrl-C is left to this process. Only the first call in a program has an effect.

    Parameters
    ----------
    modules : Sequence[str]
        Names of the modules.
    """
    if not has_fork_server():
        return
    set_forkserver_preload(list(modules))
    wanted = own_packages() | dict.fromkeys(THREADS, "1")
    given = {name: os.environ.get(name) for name in wanted}
    os.environ.update(wanted)
    resource_tracker.ensure_running()  # else it is begun below, and lets interrupts through again
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        forkserver.ensure_running()
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
        for name, value in given.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


@contextmanager
def fork_server(modules: Sequence[str], *, wanted: bool = True) -> Iterator[None]:
    """Start the fork server for the work inside, and end it afterwards.

    Parameters
    ----------
    modules : Sequence[str]
        Names of the modules to load.
    wanted : bool, default True
        False: nothing is started.
    """
    if wanted:
        start_fork_server(modules)
    try:
        yield
    finally:
        if wanted:
            _end_fork_server()


def _end_fork_server() -> None:
    """End the process, whatever it loads, so that nothing outlives the command."""
    server: Any = getattr(forkserver, "_forkserver", None)
    number = getattr(server, "_forkserver_pid", None)
    if number is not None:
        with suppress(ProcessLookupError):
            os.kill(number, signal.SIGTERM)
        server._stop()


def prepare_worker() -> None:
    """In a new process: one thread each; Ctrl-C is left to the parent; ends with the parent. What
    was loaded before is no garbage.
    """
    gc.freeze()
    gc.set_threshold(COLLECTED)
    os.environ.update(dict.fromkeys(THREADS, "1"))
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = parent_process()
    if parent is not None:
        threading.Thread(target=_end_with, args=(parent.sentinel,), daemon=True).start()


def _end_with(sentinel: Any) -> None:
    connection.wait([sentinel])
    os._exit(1)


def end_workers(others: Set[BaseProcess]) -> None:
    """End the worker processes of this process, whatever they do.

    Parameters
    ----------
    others : Set[BaseProcess]
        Processes that somebody else has started.
    """
    ended = set(active_children()) - others
    for process in ended:
        process.terminate()
    for process in ended:
        process.join(PATIENCE)
