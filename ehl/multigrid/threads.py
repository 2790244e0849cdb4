"""Threads that share the lines of a grid, and threads that solve several films at a time.

The compiled kernels release the interpreter's lock.
"""

import os
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from itertools import pairwise

# nodes of the smallest grid that is shared: below, the hand-over costs more than it saves
SHARED_NODES = 2**15


def cores() -> int:
    """Cores this process may use [-]."""
    affinity = hasattr(os, "sched_getaffinity")
    return len(os.sched_getaffinity(0)) if affinity else os.cpu_count() or 1


class Threads:
    """A number of threads, the calling one included; results do not depend on the number."""

    def __init__(self, number: int = 1) -> None:
        self.number = number
        self._pool = ThreadPoolExecutor(number - 1) if number > 1 else None

    def number_for(self, nodes: int) -> int:
        """Choose the number of threads for a grid.

        Parameters
        ----------
        nodes : int
            nodes of the grid [-]

        Returns
        -------
        int
            number of threads [-]
        """
        return self.number if nodes >= SHARED_NODES else 1

    def run(self, kernel: Callable[[int, int], None], lines: range, nodes: int) -> None:
        """Run a kernel on equal parts of the lines of a grid at the same time.

        Parameters
        ----------
        kernel : Callable[[int, int], None]
            takes the first line of a part and its end, half-open
        lines : range
            numbers of the lines; each part begins with one of them
        nodes : int
            nodes of the grid [-]
        """
        number = self.number_for(nodes)
        if number == 1:
            if lines:
                kernel(lines[0], lines[-1] + 1)
            return
        cuts = [k * len(lines) // number for k in range(number + 1)]
        parts = [(lines[a], lines[b - 1] + 1) for a, b in pairwise(cuts) if b > a]
        assert self._pool is not None  # of more than one thread
        jobs = [self._pool.submit(kernel, *part) for part in parts[1:]]
        for part in parts[: len(parts) - len(jobs)]:
            kernel(*part)
        for job in jobs:
            job.result()


@contextmanager
def film_threads(number: int) -> Iterator[ThreadPoolExecutor]:
    """Open a pool of threads for films; after an interrupt no further film is begun.

    A film under way cannot be stopped: a program that is to end at once ends by `os._exit`.

    Parameters
    ----------
    number : int
        number of threads [-]

    Yields
    ------
    Iterator[ThreadPoolExecutor]
        pool of threads
    """
    pool = ThreadPoolExecutor(max_workers=max(1, number))
    waits = True
    try:
        yield pool
    except KeyboardInterrupt:
        waits = False
        raise
    finally:
        pool.shutdown(wait=waits, cancel_futures=True)
