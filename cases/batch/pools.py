"""Executors that compute the points: processes of this machine, the workers of a Dask cluster, or
an executor that a function of the user makes.
"""

import importlib
from collections.abc import Callable
from concurrent.futures import BrokenExecutor, Executor, Future
from multiprocessing import active_children
from pathlib import Path
from time import monotonic
from typing import Any

from oilfilm.ehl.foreign_files import read_file
from oilfilm.postprocess.batch.store import DONE

from ..format.rules import CaseError
from ..runs.interrupt import print_message
from ..runs.processes import POINTS, end_workers, start_fork_server, worker_pool
from .compute import compute_block
from .points import PointResult, Task

AHEAD = 2  # blocks that each worker has at a time, so that none waits for the next one
PATIENCE = 10.0  # for a scheduler to answer [s]
PORT = 8786  # of a Dask scheduler, its default
# a block of points that travels to a far worker takes so long: the scheduler's 1 ms for a task
# does not count beside it, and a lost worker costs little
BLOCK_SECONDS = 20.0
MOST_IN_BLOCK = 5000  # points: 50 MB of results
SLOTS = 64  # blocks at a time of an executor that does not say how many workers it has

Results = Future[tuple[PointResult, ...]]


class Pool:
    """Workers behind an executor of `concurrent.futures`; they return the files of their points.

    mpi4py, Parsl and submitit have such executors. The workers must see the files of traction
    tables.

    Parameters
    ----------
    start : callable
        Starts an executor: the first one, and one after each that broke.
    """

    shares_folder = False  # workers write files of their own into the folder of the batch
    retries = True  # points of a lost worker are worth another try

    def __init__(self, start: Callable[[], Executor]) -> None:
        self._start = start
        self._executor = start()
        self._seconds = 0.0  # shortest mean time of a point in a block
        self._points = 0  # computed so far

    def capacity(self) -> int:
        """Blocks to submit at a time [-]."""
        workers = getattr(self._executor, "_max_workers", None)
        return AHEAD * workers if isinstance(workers, int) and workers > 0 else SLOTS

    def block(self) -> int:
        """Points of the next block, from the time of those before [-]; one until one is done."""
        if not self._points:
            return 1
        return max(1, min(MOST_IN_BLOCK, round(BLOCK_SECONDS / max(self._seconds, 1e-9))))

    def submit(self, block: tuple[Task, ...]) -> Results:
        """Submit a block to the workers.

        Parameters
        ----------
        block : tuple of Task
            Points that one worker computes, all with the same traction tables.

        Returns
        -------
        Future
            Results of the points, in their order.
        """
        return self._timed(block)

    def _timed(self, block: tuple[Task, ...], *tables: Any) -> Results:
        """Submit a block and measure its time; a block that waits for a worker takes longer, so
        the shortest time counts.
        """
        start = monotonic()
        future = self._executor.submit(compute_block, block, *tables)

        def done(_future: Results) -> None:
            seconds = (monotonic() - start) / len(block)
            self._seconds = min(self._seconds, seconds) if self._points else seconds
            self._points += len(block)

        future.add_done_callback(done)
        return future

    def lost(self, error: BaseException) -> bool:
        """Tell whether an error means that a worker is gone.

        Parameters
        ----------
        error : BaseException
            Error of a block.

        Returns
        -------
        bool
            True if the worker, not the point, failed.
        """
        return isinstance(error, BrokenExecutor)

    def rebuild(self) -> None:
        """Replace the broken executor, which lost every point it had, by a new one."""
        self._executor.shutdown(wait=False, cancel_futures=True)
        self._executor = self._start()

    def close(self, *, at_once: bool) -> None:
        """End the executor.

        Parameters
        ----------
        at_once : bool
            True: unfinished work is given up; False: it is finished first.
        """
        self._executor.shutdown(wait=not at_once, cancel_futures=True)


class LocalPool(Pool):
    """Processes of this machine.

    As long as the file `compiled` does not exist, points are submitted one at a time, so that
    not every worker compiles the same kernels.

    Parameters
    ----------
    workers : int
        Number of processes [-].
    compiled : Path, optional
        File that exists once the kernels are compiled.
    """

    shares_folder = True

    def __init__(self, workers: int, compiled: Path | None = None) -> None:
        self.workers = workers
        self._compiled = compiled
        self._cold = workers > 1 and compiled is not None and not compiled.exists()
        self._before = set(active_children())
        super().__init__(self._processes)

    def _processes(self) -> Executor:
        start_fork_server(POINTS)
        return worker_pool(self.workers)

    def capacity(self) -> int:
        """Blocks to submit at a time [-]."""
        return 1 if self._cold else super().capacity()

    def block(self) -> int:
        """Points one by one: each is on disk before its worker begins the one after the next."""
        return 1

    def submit(self, block: tuple[Task, ...]) -> Results:
        """Submit a block to the workers.

        Parameters
        ----------
        block : tuple of Task
            Points that one worker computes.

        Returns
        -------
        Future
            Results of the points, in their order.
        """
        future = super().submit(block)
        if self._cold:
            future.add_done_callback(self._mark_compiled)
        return future

    def _mark_compiled(self, future: Results) -> None:
        """After the first point that was computed every worker finds the kernels compiled."""
        if future.cancelled() or future.exception() is not None:
            return
        if future.result()[0].status != DONE:
            return
        self._cold = False
        try:
            if self._compiled is not None:
                self._compiled.parent.mkdir(parents=True, exist_ok=True)
                self._compiled.touch()
        except OSError:  # the next batch begins with one point again
            pass

    def rebuild(self) -> None:
        """Start new processes when all of the broken pool have ended."""
        self._executor.shutdown(wait=True, cancel_futures=True)
        self._executor = self._start()

    def close(self, *, at_once: bool) -> None:
        """End the processes.

        Parameters
        ----------
        at_once : bool
            True: whatever they do; False: when they have finished.
        """
        super().close(at_once=at_once)
        if at_once:
            end_workers(self._before)


class ClusterPool(Pool):
    """Workers of a running Dask cluster.

    Parameters
    ----------
    address : str
        Address of the scheduler, as `scheduler_address` takes it.

    Raises
    ------
    CaseError
        If Dask is not installed, or no scheduler answers.
    """

    retries = False  # Dask has then tried others already

    def __init__(self, address: str) -> None:
        try:
            from distributed import Client
        except ImportError:
            needed = "pip install 'oilfilm[cluster]'"
            raise CaseError(f"--scheduler: needs the package distributed: {needed}") from None
        full = scheduler_address(address)
        try:
            self._client = Client(full, timeout=PATIENCE, set_as_default=False)
        except (OSError, TimeoutError, ValueError) as error:
            text = " ".join(str(error).split())[:200]
            raise CaseError(
                f"--scheduler {address}: no Dask scheduler answers there: {text}"
            ) from None
        super().__init__(lambda: self._client.get_executor(pure=False))
        self._tables: dict[str, Any] = {}
        self._reported = False
        self._threads()

    def _threads(self) -> int:
        """Threads of all workers [-]; a message, once, if there are none."""
        count = sum(self._client.nthreads().values())
        if not count and not self._reported:
            self._reported = True
            print_message(
                "oilfilm: the scheduler has no workers yet; points wait until one has come"
            )
        return count

    def capacity(self) -> int:
        """Blocks to submit at a time [-]: workers may come and go."""
        return AHEAD * max(1, self._threads())

    def submit(self, block: tuple[Task, ...]) -> Results:
        """Submit a block; traction tables go to every worker once, not with every block.

        Parameters
        ----------
        block : tuple of Task
            Points that one worker computes.

        Returns
        -------
        Future
            Results of the points, in their order.

        Raises
        ------
        ValueError
            If the points need several traction tables.
        """
        tables = block[0].tables
        if tables is None:
            return self._timed(block)
        if any(task.tables != tables for task in block):
            raise ValueError("a block of points of several traction tables")
        if tables not in self._tables:
            content = read_file(Path(tables))
            self._tables[tables] = self._client.scatter(content, broadcast=True)
        return self._timed(block, self._tables[tables])

    def lost(self, error: BaseException) -> bool:
        """Tell whether an error means that a worker is gone.

        Parameters
        ----------
        error : BaseException
            Error of a block.

        Returns
        -------
        bool
            True if the worker, not the point, failed.
        """
        return type(error).__name__ == "KilledWorker"

    def rebuild(self) -> None:
        """Do nothing: the scheduler replaces workers, and retries points, by itself."""

    def close(self, *, at_once: bool) -> None:
        """Leave the cluster, which continues by itself.

        Parameters
        ----------
        at_once : bool
            True: unfinished points are given up, which the scheduler then drops.
        """
        if not at_once:
            self._executor.shutdown(wait=True)
        self._client.close()


def executor_factory(name: str) -> Callable[[], Executor]:
    """Find the function of the user that makes an executor.

    Parameters
    ----------
    name : str
        MODULE:FUNCTION.

    Returns
    -------
    callable
        Makes an executor; CaseError where the function fails or makes something else.

    Raises
    ------
    CaseError
        If there is no such function.
    """
    module, _, function = name.partition(":")
    allowed = "allowed: MODULE:FUNCTION, a function that makes a concurrent.futures.Executor"
    try:
        factory = getattr(importlib.import_module(module), function)
    except (ImportError, AttributeError, ValueError, SyntaxError) as error:
        raise CaseError(f"--executor {name}: {error}; {allowed}") from None

    def make() -> Executor:
        try:
            executor: Executor = factory()
        except Exception as error:  # of whatever the user's own code stumbles over
            words = f"{type(error).__name__}: {error}"
            raise CaseError(f"--executor {name}: the function failed with {words}") from error
        if not callable(getattr(executor, "submit", None)):
            kind = type(executor).__name__
            raise CaseError(f"--executor {name}: made a {kind}, which has no submit; {allowed}")
        return executor

    return make


def scheduler_address(address: str) -> str:
    """Complete the address of a Dask scheduler.

    Parameters
    ----------
    address : str
        Full address, a bare host, or a bare port of this machine.

    Returns
    -------
    str
        Full address, with Dask's default port where none is given.
    """
    if address.isdigit():
        return f"tcp://127.0.0.1:{address}"
    if "://" in address or ":" in address:
        return address
    return f"tcp://{address}:{PORT}"
