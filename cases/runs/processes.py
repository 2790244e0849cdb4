"""How worker processes of all commands begin, what they do before they work, and how they end.

Pictures and VTK of a run, made by processes while the numbers are written.
"""

import gc
import os
import pickle
import signal
import sys
import threading
from collections.abc import Iterator, Sequence, Set
from concurrent.futures import Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from functools import lru_cache, partial
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
from shutil import copytree
from tempfile import TemporaryDirectory
from typing import Any

from oilfilm import postprocess
from oilfilm.ehl.multigrid.starved import cores
from oilfilm.postprocess.files import attempt
from oilfilm.postprocess.quantities import FILMS, OTHERS, PARAVIEW

PATIENCE = 0.2  # for a process to be gone after its end was asked for [s]
THREADS = (
    "OMP_NUM_THREADS",
    "OPENBLAS_NUM_THREADS",
    "MKL_NUM_THREADS",
    "VECLIB_MAXIMUM_THREADS",
    "NUMBA_NUM_THREADS",
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
    resource_tracker.ensure_running()  # else it is begun below, and lets interrupts through again
    wanted = own_packages() | dict.fromkeys(THREADS, "1")
    given = {name: os.environ.get(name) for name in wanted}
    os.environ.update(wanted)
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


# each holds all fields; the dozen pictures of a bearing, of 0.3 s each, gain little by more
MOST_PROCESSES = 4
EXTRAS = "VTK and plots"
LOOK = 0.1  # from one look for an interrupt to the next [s]
TERMINATION = 0.3  # for processes to end that were told to [s]
LOADED = ["oilfilm.cases.runs.processes", "oilfilm.postprocess.writer"]


@dataclass(slots=True)
class _Begun:
    """Parts under way: a place for what the processes receive, the folder that they write to."""

    place: "TemporaryDirectory[str]"
    folder: Path
    jobs: list[Future[tuple[str, ...]]] = field(default_factory=list)
    problems: tuple[str, ...] = ()


class Drawing:
    """Processes that draw; none is started before there is something to draw."""

    def __init__(self, pool: ProcessPoolExecutor) -> None:
        self._pool = pool
        self._before = set(active_children())
        self._stopped = False
        self._ahead: _Begun | None = None  # pictures of the films, before the rest is known

    def stop(self) -> None:
        """Leave out what has not been begun, when the user wants to stop."""
        self._stopped = True

    def films(self, results: Any) -> None:
        """Begin the pictures that need no more than the films; `write` puts them in place.

        Parameters
        ----------
        results : Any
            The run, whose other parts may be missing.
        """
        # a process that was ended may still write to it
        place = TemporaryDirectory(ignore_cleanup_errors=True)
        self._ahead = _Begun(place, Path(place.name) / "made")
        self._begin(results, self._ahead, (FILMS,))

    def write(self, results: Any, folder: Path) -> tuple[str, ...]:
        """Write a run as `oilfilm.postprocess.write_results`, to the same files.

        Parameters
        ----------
        results : Any
            The run.
        folder : Path
            Folder of the results.

        Returns
        -------
        tuple[str, ...]
            Problems.
        """
        rest = _Begun(TemporaryDirectory(dir=folder), folder)
        begun = [rest] if self._ahead is None else [self._ahead, rest]
        try:
            kinds = (FILMS, OTHERS, PARAVIEW) if self._ahead is None else (OTHERS, PARAVIEW)
            self._begin(results, rest, kinds)
            extras = partial(self._extras, begun, folder)
            return postprocess.write_numbers(results, folder, extras)
        finally:
            self._end([job for part in begun for job in part.jobs])
            rest.place.cleanup()
            self._forget()

    def close(self) -> None:
        """End the processes, waiting for none that was given up."""
        self._pool.shutdown(wait=not self._stopped, cancel_futures=True)
        self._forget()

    def _forget(self) -> None:
        """Remove what was made ahead."""
        if self._ahead is not None:
            self._ahead.place.cleanup()
        self._ahead = None

    def _begin(self, results: Any, begun: "_Begun", kinds: Sequence[str]) -> None:
        """Have the parts of these kinds made; that they cannot be begun is a problem of them."""
        begun.problems = attempt(EXTRAS, lambda: self._submit(results, begun, kinds))

    def _submit(self, results: Any, begun: "_Begun", kinds: Sequence[str]) -> None:
        if self._stopped:
            raise InterruptedError("interrupted")
        file = Path(begun.place.name) / "results"
        file.write_bytes(pickle.dumps(results))
        counts = {PARAVIEW: 1, **results.pictures}
        # the longest first: pictures of contacts come last, files for ParaView are one part
        parts = [(kind, number) for kind in kinds for number in range(counts[kind])]
        for part in reversed(parts):
            begun.jobs.append(self._pool.submit(_make, file, begun.folder, part))

    def _extras(self, begun: Sequence["_Begun"], folder: Path) -> tuple[str, ...]:
        """Wait for all parts, or give up those under way once it was stopped."""
        jobs = [job for part in begun for job in part.jobs]
        while not self._stopped and wait(jobs, timeout=LOOK).not_done:
            pass
        problems = tuple(problem for part in begun for problem in part.problems)
        for job in jobs:
            if job.done():
                problems += attempt(EXTRAS, partial(_result, job))
        problems = tuple(dict.fromkeys(problems))
        if not all(job.done() for job in jobs):
            return (*problems, f"{EXTRAS}: some not written, interrupted")
        for part in begun:
            if part.folder != folder and part.folder.exists():
                copytree(part.folder, folder, dirs_exist_ok=True)
        return problems

    def _end(self, jobs: Sequence[Future[tuple[str, ...]]]) -> None:
        """Cancel what has not been begun; wait for what has, or end its processes."""
        for job in jobs:
            job.cancel()
        if self._stopped:
            self._pool.shutdown(wait=False, cancel_futures=True)
            end_workers(self._before)
        wait(jobs, timeout=TERMINATION if self._stopped else None)


@contextmanager
def drawing_processes(*, ahead: bool) -> Iterator[Drawing]:
    """Processes that draw.

    Parameters
    ----------
    ahead : bool
        True: their libraries are loaded while the caller computes.

    Yields
    ------
    Iterator[Drawing]
        The processes.
    """
    if ahead:
        start_fork_server(LOADED)
    workers = min(cores(), MOST_PROCESSES)
    pool = ProcessPoolExecutor(workers, mp_context=worker_context(), initializer=prepare_worker)
    drawing = Drawing(pool)
    try:
        yield drawing
    except KeyboardInterrupt:
        drawing.stop()
        raise
    finally:
        drawing.close()


def _make(file: Path, folder: Path, part: tuple[str, int]) -> tuple[str, ...]:
    """In a process: one part of the pictures and VTK; what could not be written."""
    return postprocess.write_extras(_received(file), folder, part)


def _result(job: Future[tuple[str, ...]]) -> tuple[str, ...]:
    """Problems of a part."""
    try:
        return job.result()
    except BrokenProcessPool:
        return (f"{EXTRAS}: some not written, a process that drew them was ended",)


@lru_cache(maxsize=2)  # of the films alone, and of all
def _received(file: Path) -> Any:
    """The results, read once by each process."""
    return pickle.loads(file.read_bytes())
