"""Worker processes of the live program: one request at a time each, and an end at any time."""

import asyncio
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from importlib import import_module
from multiprocessing.connection import Connection
from typing import Any

from oilfilm.ehl.multigrid.threads import cores

from ..runs.processes import PATIENCE, start_fork_server, worker_context

ENGINE = "oilfilm.cases.app.engine"  # loads what computes, which this process does not need
ENDED = "ended"  # problem of a request whose worker was ended

Answer = dict[str, Any]
Task = tuple[Any, ...]  # name of a point, and arguments of `engine.Engine.numbers`


def prepare() -> None:
    """Begin to load what the workers need, where they are copied from one process."""
    start_fork_server((ENGINE,))


def serve(connection: Connection, quiet: bool) -> None:
    """Answer requests; the target of a worker process.

    Parameters
    ----------
    connection : Connection
        To the process that asks.
    quiet : bool
        With less right to the processor.
    """
    import_module(ENGINE).serve(connection, quiet)


class Worker:
    """A process that answers one request after the other.

    Parameters
    ----------
    quiet : bool, default False
        With less right to the processor than the others.
    """

    def __init__(self, quiet: bool = False) -> None:
        self._quiet = quiet
        self._process: Any = None
        self._connection: Any = None
        self._lock = asyncio.Lock()

    async def ask(self, name: str, *arguments: Any) -> Answer:
        """Ask for the answer of a method of `engine.Engine`.

        Parameters
        ----------
        name : str
            Name of the method.
        *arguments : Any
            Its arguments.

        Returns
        -------
        dict[str, Any]
            The answer; "problem" where there is none.
        """
        async with self._lock:
            return await asyncio.to_thread(self._ask, name, arguments)

    def _ask(self, name: str, arguments: tuple[Any, ...]) -> Answer:
        if self._process is None or not self._process.is_alive():
            self._start()
        connection = self._connection
        try:
            connection.send((name, arguments))
            answer: Answer = connection.recv()
        except (EOFError, OSError):
            return {"problem": ENDED}
        return answer

    def _start(self) -> None:
        context = worker_context()
        self._connection, far = context.Pipe()
        start: Any = context
        self._process = start.Process(target=serve, args=(far, self._quiet), daemon=True)
        self._process.start()
        far.close()

    def end(self) -> None:
        """End the process, whatever it does; the next request starts another one."""
        process, self._process = self._process, None
        if process is None:
            return
        process.terminate()
        process.join(PATIENCE)
        with suppress(OSError):
            self._connection.close()


class Field:
    """Workers that compute many points, each shown when it is there.

    Parameters
    ----------
    count : int | None, optional
        Processes [-]; None: one for each core.
    """

    def __init__(self, count: int | None = None) -> None:
        self.workers = [Worker(quiet=True) for _ in range(count or cores())]
        self.job = 0

    async def fill(self, tasks: Iterable[Task], show: Callable[[Any, Answer], None]) -> bool:
        """Compute points in their order; what was under way before is given up.

        Parameters
        ----------
        tasks : Iterable[tuple]
            Name and arguments of each point.
        show : Callable
            Called with the name of a point and its numbers.

        Returns
        -------
        bool
            All points were computed.
        """
        self.job += 1
        job = self.job
        waiting = iter(tasks)

        async def work(worker: Worker) -> None:
            for name, *arguments in waiting:
                answer = await worker.ask("numbers", *arguments)
                if job != self.job:
                    return
                show(name, answer)

        await asyncio.gather(*(work(worker) for worker in self.workers))
        return job == self.job

    def stop(self) -> None:
        """Give up the points that are under way."""
        self.job += 1

    def end(self) -> None:
        """End the processes."""
        self.stop()
        for worker in self.workers:
            worker.end()


def refined_order(columns: int, rows: int) -> list[tuple[int, int, int]]:
    """Points of a grid, coarse ones first, so that the whole is seen early.

    Parameters
    ----------
    columns, rows : int
        Size of the grid [-].

    Returns
    -------
    list[tuple[int, int, int]]
        Column, row, and the points that each stands for each way until finer ones are there.
    """
    found: dict[tuple[int, int], int] = {}
    for stride in (8, 4, 2, 1):
        for j in range(stride // 2, rows, stride):
            for i in range(stride // 2, columns, stride):
                found.setdefault((i, j), stride)
    return [(i, j, stride) for (i, j), stride in found.items()]


def evenly(ends: Sequence[float], count: int) -> list[float]:
    """Evenly spaced values.

    Parameters
    ----------
    ends : Sequence[float]
        First and last.
    count : int
        Number of values [-].

    Returns
    -------
    list[float]
        The values.
    """
    low, high = ends
    return [low + (high - low) * k / max(count - 1, 1) for k in range(count)]
