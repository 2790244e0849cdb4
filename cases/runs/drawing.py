"""Pictures and VTK of a run, made by processes while the numbers are written."""

import gc
import pickle
import signal
from collections.abc import Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor, wait
from contextlib import contextmanager
from functools import lru_cache, partial
from multiprocessing import (
    active_children,
    forkserver,
    get_all_start_methods,
    get_context,
    resource_tracker,
    set_forkserver_preload,
)
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import postprocess
from ehl.multigrid.threads import cores
from postprocess.files import attempt

from .processes import end_workers, prepare_worker

# each holds all fields; the dozen pictures of a bearing, of 0.3 s each, gain little by more
MOST_PROCESSES = 4
LOOK = 0.1  # from one look for an interrupt to the next [s]
TERMINATION = 0.3  # for processes to end that were told to [s]
FORK_SERVER = "forkserver"  # loads the libraries once for all processes, where there is one
LOADED = ["cases.runs.drawing", "postprocess.writer.extras"]


class Drawing:
    """Processes that draw; none is started before there is something to draw."""

    def __init__(self, pool: ProcessPoolExecutor) -> None:
        self._pool = pool
        self._before = set(active_children())
        self._stopped = False

    def stop(self) -> None:
        """Leave out what has not been begun, when the user wants to stop."""
        self._stopped = True

    def write(self, results: Any, folder: Path) -> tuple[str, ...]:
        """Write a run as `postprocess.write_results`, to the same files."""
        jobs: list[Future[tuple[str, ...]]] = []
        with TemporaryDirectory(dir=folder) as parcel:
            problems = attempt("VTK and plots", lambda: self._begin(results, Path(parcel), jobs))
            try:
                extras = partial(self._extras, jobs, problems)
                return postprocess.write_numbers(results, folder, extras)
            finally:
                self._end(jobs)

    def _end(self, jobs: Sequence[Future[tuple[str, ...]]]) -> None:
        """Cancel what has not been begun; wait for what has, or end its processes."""
        for job in jobs:
            job.cancel()
        if self._stopped:
            self._pool.shutdown(wait=False, cancel_futures=True)
            end_workers(self._before)
        wait(jobs, timeout=TERMINATION if self._stopped else None)

    def close(self) -> None:
        """End the processes, waiting for none that was given up."""
        self._pool.shutdown(wait=not self._stopped, cancel_futures=True)

    def _begin(self, results: Any, parcel: Path, jobs: list[Future[tuple[str, ...]]]) -> None:
        if self._stopped:
            raise InterruptedError("interrupted")
        file = parcel / "results"
        file.write_bytes(pickle.dumps(results))
        # the longest first: pictures of contacts come last, files for ParaView first
        for part in reversed(range(1 + results.pictures)):
            jobs.append(self._pool.submit(_make, file, parcel.parent, part))

    def _extras(
        self, jobs: Sequence[Future[tuple[str, ...]]], problems: tuple[str, ...]
    ) -> tuple[str, ...]:
        """Wait for all parts, or give up those under way once it was stopped."""
        while not self._stopped and wait(jobs, timeout=LOOK).not_done:
            pass
        for job in jobs:
            if job.done():
                problems += attempt("VTK and plots", job.result)
        if not all(job.done() for job in jobs):
            problems += ("VTK and plots: some not written, interrupted",)
        return problems


@contextmanager
def drawing_processes(*, ahead: bool) -> Iterator[Drawing]:
    """Processes that draw; with `ahead` their libraries are loaded while the caller computes."""
    forked = FORK_SERVER in get_all_start_methods()
    if forked and ahead:
        _start_fork_server()
    context = get_context(FORK_SERVER if forked else "spawn")
    workers = min(cores(), MOST_PROCESSES)
    drawing = Drawing(ProcessPoolExecutor(workers, mp_context=context, initializer=_prepare))
    try:
        yield drawing
    except KeyboardInterrupt:
        drawing.stop()
        raise
    finally:
        drawing.close()


def _start_fork_server() -> None:
    """Begin to load the libraries; Ctrl-C is left to this process."""
    set_forkserver_preload(LOADED)
    resource_tracker.ensure_running()  # else it is begun below, and lets interrupts through again
    signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        forkserver.ensure_running()
    finally:
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})


def _prepare() -> None:
    """In a new process; what was loaded is no garbage."""
    prepare_worker()
    gc.freeze()


def _make(file: Path, folder: Path, part: int) -> tuple[str, ...]:
    """In a process: one part of the pictures and VTK; what could not be written."""
    return postprocess.write_extras(_received(file), folder, part)


@lru_cache(maxsize=1)
def _received(file: Path) -> Any:
    """The results, read once by each process."""
    return pickle.loads(file.read_bytes())
