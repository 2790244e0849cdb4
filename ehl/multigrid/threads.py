"""Threads that share the lines of a grid: the compiled kernels release the interpreter's lock."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

# nodes of the smallest grid that is shared: below, handing over costs more than it saves
SHARED_NODES = 2**15


class Team:
    """As many threads as asked for, this one among them; the others end with the team.

    What the threads compute does not depend on their number.
    """

    def __init__(self, threads: int = 1) -> None:
        self.threads = threads
        self._others = ThreadPoolExecutor(threads - 1) if threads > 1 else None

    def threads_for(self, nodes: int) -> int:
        """Threads for a grid of so many nodes [-]."""
        return self.threads if nodes >= SHARED_NODES else 1

    def share(self, kernel: Callable[[int, int], None], lines: range, nodes: int) -> None:
        """Call kernel(first, stop) on equal parts of `lines` of a grid of so many nodes, all at
        the same time.

        A part begins with one of `lines`; its end is the end of a half-open range.
        """
        threads = self.threads_for(nodes)
        cuts = [k * len(lines) // threads for k in range(threads + 1)]
        parts = [
            (lines[a], lines[b - 1] + 1) for a, b in zip(cuts[:-1], cuts[1:], strict=True) if b > a
        ]
        jobs = (
            [self._others.submit(kernel, *part) for part in parts[1:]]
            if self._others is not None
            else []
        )
        for part in parts[: len(parts) - len(jobs)]:
            kernel(*part)
        for job in jobs:
            job.result()
