"""Where the points are computed: processes of this machine, the workers of a Dask cluster, or
whatever an executor of the user's choice has.
"""

import importlib
from collections.abc import Callable
from concurrent.futures import BrokenExecutor, Executor, Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import active_children
from pathlib import Path
from time import monotonic
from typing import Any, Protocol

from postprocess.batch.records import DONE

from ..format.problems import CaseError
from ..runs.interrupt import say
from ..runs.processes import POINTS, end_workers, prepare_worker, start_fork_server, worker_context
from .points import Receipt, Task
from .worker import compute_block

AHEAD = 2  # blocks in the hands of each worker, so that none waits for the next one
PATIENCE = 10.0  # for a scheduler to answer [s]
PORT = 8786  # of a Dask scheduler, its default
# a block of points that travels to a far worker takes so long: the scheduler's 1 ms for a task
# does not count beside it, and a lost worker costs little
BLOCK_SECONDS = 20.0
MOST_IN_BLOCK = 5000  # points: 50 MB of results
SLOTS = 64  # blocks in the hands of an executor that does not say how many workers it has

Receipts = Future[tuple[Receipt, ...]]


class Pool(Protocol):
    """What computes blocks of points."""

    shares_folder: bool  # workers write files of their own into the folder of the batch
    retries: bool  # points of a lost worker are worth another try

    def capacity(self) -> int:
        """Blocks to hand out at a time [-]."""
        ...

    def block(self) -> int:
        """Points of the next block [-]."""
        ...

    def submit(self, block: tuple[Task, ...]) -> Receipts:
        """Hand out a block."""
        ...

    def lost(self, error: BaseException) -> bool:
        """Whether this error means that a worker is gone."""
        ...

    def rebuild(self) -> None:
        """New workers in place of lost ones."""
        ...

    def close(self, *, at_once: bool) -> None:
        """End the work, at once or when it is done."""
        ...


class LocalPool:
    """Processes of this machine.

    As long as the file `compiled` does not stand, points are handed out one at a time, so that
    not every worker compiles the same kernels.
    """

    shares_folder = True
    retries = True

    def __init__(self, workers: int, compiled: Path | None = None) -> None:
        self.workers = workers
        self._compiled = compiled
        self._cold = workers > 1 and compiled is not None and not compiled.exists()
        self._before = set(active_children())
        self._executor = self._start()

    def _start(self) -> ProcessPoolExecutor:
        start_fork_server(POINTS)
        context = worker_context()
        return ProcessPoolExecutor(self.workers, mp_context=context, initializer=prepare_worker)

    def capacity(self) -> int:
        """Blocks to hand out at a time [-]."""
        return 1 if self._cold else AHEAD * self.workers

    def block(self) -> int:
        """Points one by one: each is on disk before its worker begins the one after the next."""
        return 1

    def submit(self, block: tuple[Task, ...]) -> Receipts:
        """Hand out a block."""
        future = self._executor.submit(compute_block, block)
        if self._cold:
            future.add_done_callback(self._warmed)
        return future

    def _warmed(self, future: Receipts) -> None:
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

    def lost(self, error: BaseException) -> bool:
        """Whether this error means that a worker is gone."""
        return isinstance(error, BrokenProcessPool)

    def rebuild(self) -> None:
        """A new pool in place of the broken one, which lost every point it held."""
        self._executor.shutdown(wait=True, cancel_futures=True)
        self._executor = self._start()

    def close(self, *, at_once: bool) -> None:
        """End the workers, at once or when they have finished."""
        self._executor.shutdown(wait=not at_once, cancel_futures=True)
        if at_once:
            end_workers(self._before)


class _Blocks:
    """Points of a block, from the time that those before took."""

    def __init__(self) -> None:
        self._seconds = 0.0  # mean of a point
        self._points = 0

    def size(self) -> int:
        """Points of the next block [-]; one as long as none is done."""
        if not self._points:
            return 1
        return max(1, min(MOST_IN_BLOCK, round(BLOCK_SECONDS / max(self._seconds, 1e-9))))

    def timed(self, submit: Callable[[], Receipts], points: int) -> Receipts:
        """Hand out a block and look when it is done; one that waits for a worker takes longer, so
        the shortest time counts.
        """
        start = monotonic()
        future = submit()

        def done(_future: Receipts) -> None:
            seconds = (monotonic() - start) / points
            self._seconds = min(self._seconds, seconds) if self._points else seconds
            self._points += points

        future.add_done_callback(done)
        return future


class ClusterPool:
    """Workers of a running Dask cluster; without a common disk they send their files back."""

    shares_folder = False
    retries = False  # Dask has then tried others already

    def __init__(self, address: str) -> None:
        try:
            from distributed import Client
        except ImportError:
            raise CaseError(
                "--scheduler: needs the package distributed: pip install 'oilfilm[cluster]'"
            ) from None
        try:
            self._client = Client(
                scheduler_address(address), timeout=PATIENCE, set_as_default=False
            )
        except (OSError, TimeoutError, ValueError) as error:
            text = " ".join(str(error).split())[:200]
            raise CaseError(
                f"--scheduler {address}: no Dask scheduler answers there: {text}"
            ) from None
        self._executor: Executor = self._client.get_executor(pure=False)
        self._tables: dict[str, Any] = {}
        self._blocks = _Blocks()
        self._told = False
        self._threads()

    def _threads(self) -> int:
        """Threads of all workers [-]; that there are none is told once."""
        count = sum(self._client.nthreads().values())
        if not count and not self._told:
            self._told = True
            say("oilfilm: the scheduler has no workers yet; points wait until one has come")
        return count

    def capacity(self) -> int:
        """Blocks to hand out at a time [-]: workers may come and go."""
        return AHEAD * max(1, self._threads())

    def block(self) -> int:
        """Points of the next block [-]."""
        return self._blocks.size()

    def submit(self, block: tuple[Task, ...]) -> Receipts:
        """Hand out a block; traction tables go to every worker once, not with every block."""
        tables = block[0].tables
        if tables is None:
            return self._handed(block)
        if any(task.tables != tables for task in block):
            raise ValueError("a block of points of several traction tables")
        if tables not in self._tables:
            content = Path(tables).read_bytes()
            self._tables[tables] = self._client.scatter(content, broadcast=True)
        return self._handed(block, self._tables[tables])

    def _handed(self, block: tuple[Task, ...], *tables: Any) -> Receipts:
        submit = self._executor.submit
        return self._blocks.timed(lambda: submit(compute_block, block, *tables), len(block))

    def lost(self, error: BaseException) -> bool:
        """Whether this error means that a worker is gone."""
        return type(error).__name__ == "KilledWorker"

    def rebuild(self) -> None:
        """Nothing to do: the scheduler replaces workers, and retries points, by itself."""

    def close(self, *, at_once: bool) -> None:
        """Leave the cluster, which goes on by itself."""
        if not at_once:
            self._executor.shutdown(wait=True)
        self._client.close()  # the scheduler drops what nobody waits for


class ExecutorPool:
    """An executor that a function of the user makes, as mpi4py, Parsl and submitit have them.

    Its workers send their files back; they must see the files of traction tables.
    """

    shares_folder = False
    retries = True

    def __init__(self, factory: str) -> None:
        self._make = executor_factory(factory)
        self._executor = self._make()
        self._blocks = _Blocks()

    def capacity(self) -> int:
        """Blocks to hand out at a time [-]."""
        workers = getattr(self._executor, "_max_workers", None)
        return AHEAD * workers if isinstance(workers, int) and workers > 0 else SLOTS

    def block(self) -> int:
        """Points of the next block [-]."""
        return self._blocks.size()

    def submit(self, block: tuple[Task, ...]) -> Receipts:
        """Hand out a block."""
        submit = self._executor.submit
        return self._blocks.timed(lambda: submit(compute_block, block), len(block))

    def lost(self, error: BaseException) -> bool:
        """Whether this error means that a worker is gone."""
        return isinstance(error, BrokenExecutor)

    def rebuild(self) -> None:
        """A new executor in place of the broken one."""
        self._executor.shutdown(wait=False, cancel_futures=True)
        self._executor = self._make()

    def close(self, *, at_once: bool) -> None:
        """End the executor, at once or when it has finished."""
        self._executor.shutdown(wait=not at_once, cancel_futures=True)


def executor_factory(name: str) -> Callable[[], Executor]:
    """The function `module:factory`; `CaseError` if there is none, or it makes no executor."""
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
            found = type(executor).__name__
            raise CaseError(f"--executor {name}: made a {found}, which has no submit; {allowed}")
        return executor

    return make


def scheduler_address(address: str) -> str:
    """A full address: a bare port is one of this machine, a bare host has Dask's own port."""
    if address.isdigit():
        return f"tcp://127.0.0.1:{address}"
    if "://" in address or ":" in address:
        return address
    return f"tcp://{address}:{PORT}"
