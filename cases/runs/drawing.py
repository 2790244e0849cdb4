"""Pictures and VTK of a run, made by processes while the numbers are written."""

import pickle
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor, Future, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import lru_cache, partial
from multiprocessing import active_children
from pathlib import Path
from shutil import copytree
from tempfile import TemporaryDirectory
from typing import Any

from oilfilm import postprocess
from oilfilm.ehl.multigrid.threads import cores
from oilfilm.postprocess.files import attempt
from oilfilm.postprocess.quantities import FILMS, OTHERS, PARAVIEW

from .processes import end_workers, start_fork_server, worker_pool

# each holds all fields; the dozen pictures of a bearing, of 0.3 s each, gain little by more
MOST_PROCESSES = 4
EXTRAS = "VTK and plots"
ENDED = f"{EXTRAS}: some not written, a process that drew them was ended"
LOOK = 0.1  # from one look for an interrupt to the next [s]
TERMINATION = 0.3  # for processes to end that were told to [s]
LOADED = ["oilfilm.cases.runs.drawing", "oilfilm.postprocess.writer"]


@dataclass(slots=True)
class _Begun:
    """Parts under way: a place for what the processes receive, the folder that they write to."""

    place: "TemporaryDirectory[str]"
    folder: Path
    jobs: list[Future[tuple[str, ...]]] = field(default_factory=list)
    problems: tuple[str, ...] = ()


class Drawing:
    """Processes that draw; none is started before there is something to draw."""

    def __init__(self, pool: Executor) -> None:
        self._pool = pool
        self._before = set(active_children())
        self._stopped = False
        self._ahead: _Begun | None = None  # pictures of the films, before the rest is known
        self._outdated: list[_Begun] = []  # such of rounds before

    def stop(self) -> None:
        """Leave out what has not been begun, when the user wants to stop."""
        self._stopped = True

    def films(self, results: Any) -> None:
        """Begin the pictures that need no more than the films, in place of those of other films;
        `write` puts them in place.

        Parameters
        ----------
        results : Any
            The run, whose other parts may be missing.
        """
        if self._ahead is not None:
            self._outdated.append(self._ahead)
            for job in self._ahead.jobs:
                job.cancel()
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
        rest = _Begun(TemporaryDirectory(ignore_cleanup_errors=True), folder)
        begun = [rest] if self._ahead is None else [self._ahead, rest]
        try:
            kinds = (FILMS, OTHERS, PARAVIEW) if self._ahead is None else (OTHERS, PARAVIEW)
            self._begin(results, rest, kinds)
            extras = partial(self._extras, begun, folder)
            return postprocess.write_numbers(results, folder, extras)
        finally:
            self._end([job for part in (*begun, *self._outdated) for job in part.jobs])
            rest.place.cleanup()
            self._forget()

    def close(self) -> None:
        """End the processes, waiting for none that was given up."""
        self._pool.shutdown(wait=not self._stopped, cancel_futures=True)
        self._forget()

    def _forget(self) -> None:
        """Remove what was made ahead."""
        for begun in (*self._outdated, *([self._ahead] if self._ahead else ())):
            begun.place.cleanup()
        self._ahead = None
        self._outdated = []

    def _begin(self, results: Any, begun: "_Begun", kinds: Sequence[str]) -> None:
        """Have the parts of these kinds made; that they cannot be begun is a problem of them."""
        begun.problems = attempt(EXTRAS, lambda: self._submit(results, begun, kinds))

    def _submit(self, results: Any, begun: "_Begun", kinds: Sequence[str]) -> tuple[str, ...]:
        if self._stopped:
            raise InterruptedError("interrupted")
        file = Path(begun.place.name) / "results"
        file.write_bytes(pickle.dumps(results))
        counts = {PARAVIEW: 1, **results.pictures}
        # the longest first: pictures of contacts come last, files for ParaView are one part
        parts = [(kind, number) for kind in kinds for number in range(counts[kind])]
        try:
            for part in reversed(parts):
                begun.jobs.append(self._pool.submit(_make, file, begun.folder, part))
        except BrokenProcessPool:  # it was ended before all parts were handed on
            return (ENDED,)
        return ()

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
    pool = worker_pool(workers)
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
        return (ENDED,)


@lru_cache(maxsize=2)  # of the films alone, and of all
def _received(file: Path) -> Any:
    """The results, read once by each process."""
    return pickle.loads(file.read_bytes())
