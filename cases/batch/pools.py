"""Where the points are computed: processes of this machine, or the workers of a Dask cluster."""

from concurrent.futures import Executor, Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import active_children, get_context
from pathlib import Path
from typing import Any

from ..format.problems import CaseError
from ..runs.processes import end_workers, prepare_worker
from .points import Receipt, Task
from .store import DONE
from .worker import compute_point

AHEAD = 2  # points in the hands of each worker, so that none waits for the next one
PATIENCE = 10.0  # for a scheduler to answer [s]
PORT = 8786  # of a Dask scheduler, its default


class LocalPool:
    """Processes of this machine.

    As long as the file `compiled` does not stand, points are handed out one at a time, so that
    not every worker compiles the same kernels.
    """

    shares_folder = True  # workers write into the folder of the batch themselves

    def __init__(self, workers: int, compiled: Path | None = None) -> None:
        self.workers = workers
        self._compiled = compiled
        self._cold = workers > 1 and compiled is not None and not compiled.exists()
        self._before = set(active_children())
        self._executor = self._start()

    def _start(self) -> ProcessPoolExecutor:
        context = get_context("spawn")
        return ProcessPoolExecutor(self.workers, mp_context=context, initializer=prepare_worker)

    def capacity(self) -> int:
        """Points to hand out at a time [-]."""
        return 1 if self._cold else AHEAD * self.workers

    def submit(self, task: Task) -> Future[Receipt]:
        """Hand out a point."""
        future = self._executor.submit(compute_point, task)
        if self._cold:
            future.add_done_callback(self._warmed)
        return future

    def _warmed(self, future: Future[Receipt]) -> None:
        """After the first point that was computed every worker finds the kernels compiled."""
        if future.cancelled() or future.exception() is not None or future.result().status != DONE:
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


class ClusterPool:
    """Workers of a running Dask cluster; without a common disk they send their files back."""

    shares_folder = False

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

    def capacity(self) -> int:
        """Points to hand out at a time [-]: workers may come and go."""
        return AHEAD * max(1, sum(self._client.nthreads().values()))

    def submit(self, task: Task) -> Future[Receipt]:
        """Hand out a point; traction tables go to every worker once, not with every point."""
        if task.tables is None:
            return self._executor.submit(compute_point, task)
        if task.tables not in self._tables:
            content = Path(task.tables).read_bytes()
            self._tables[task.tables] = self._client.scatter(content, broadcast=True)
        return self._executor.submit(compute_point, task, self._tables[task.tables])

    def lost(self, error: BaseException) -> bool:
        """Whether this error means that a worker is gone; Dask has then tried others already."""
        return type(error).__name__ == "KilledWorker"

    def rebuild(self) -> None:
        """Nothing to do: the scheduler replaces workers, and retries points, by itself."""

    def close(self, *, at_once: bool) -> None:
        """Leave the cluster, which goes on by itself."""
        if not at_once:
            self._executor.shutdown(wait=True)
        self._client.close()  # the scheduler drops what nobody waits for


def scheduler_address(address: str) -> str:
    """A full address: a bare port is one of this machine, a bare host has Dask's own port."""
    if address.isdigit():
        return f"tcp://127.0.0.1:{address}"
    if "://" in address or ":" in address:
        return address
    return f"tcp://{address}:{PORT}"


Pool = LocalPool | ClusterPool
