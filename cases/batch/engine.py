"""Execution of a sweep: hand out points, keep what is finished, resume an earlier run."""

import atexit
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, CancelledError, Future, wait
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

from ..runs.films import Progress
from .keys import WITHOUT_CONTACTS
from .points import Point, Receipt, Sweep, Task
from .pools import Pool
from .store import (
    FAILED,
    LOST,
    SWEEP_FILE,
    finished_keys,
    open_folder,
    remove_unfinished,
    write_file,
    write_point,
)
from .tables import prepare_tables, table_path
from .worker import failure

TICK = 1.0  # the time left is updated at least as often [s]


@dataclass(frozen=True, slots=True, kw_only=True)
class Batch:
    """What a batch did: points finished before, and the wall time [s]."""

    sweep: Sweep
    directory: Path
    resumed: frozenset[str]
    wall: float


class ProgressEstimate:
    """Rate and time left, from the points computed so far."""

    def __init__(self, total: int, notify: Progress) -> None:
        self.total = total
        self.done = 0
        self.resumed = 0
        self.notify = notify
        self.start = perf_counter()

    def tell(self) -> None:
        """Show how far the batch is."""
        self.notify(self.done + self.resumed, self.total, self.text(perf_counter() - self.start))

    def text(self, elapsed: float) -> str:
        """Rate and time left in words, after `elapsed` seconds [s]."""
        if not self.done or elapsed <= 0.0:
            return "points"
        rate = self.done / elapsed
        left = (self.total - self.done - self.resumed) / rate
        speed = f"{rate:.3g}/s" if rate >= 1.0 else f"{60.0 * rate:.3g}/min"
        return f"points, {speed}, {duration(left)} left"


def duration(seconds: float) -> str:
    """A time span [s] in words."""
    if seconds < 99.5:
        return f"{seconds:.0f} s"
    if seconds < 5970.0:
        return f"{seconds / 60.0:.0f} min"
    return f"{seconds / 3600.0:.1f} h"


def run_batch(
    sweep: Sweep,
    directory: Path,
    pool: Callable[[], Pool],
    *,
    resume: bool = False,
    progress: Progress | None = None,
) -> Batch:
    """Compute every point of a sweep that is not finished yet, into the folder of the batch.

    Parameters
    ----------
    pool : callable
        Starts the workers; called only if there is something to compute.
    resume : bool
        Whether finished points in `directory` are taken over.
    progress : callable, optional
        Called with the points done, the points in all, and a word on rate and time left.

    Raises
    ------
    CaseError
        If the folder cannot be used.
    OSError
        If a finished point cannot be written; all finished before stay.
    """
    start = perf_counter()
    open_folder(directory, resume=resume)
    write_file(directory / SWEEP_FILE, sweep.text.encode("utf-8"))
    points = {point.key: point for point in sweep.points}
    finished = finished_keys(directory, points)
    pace = ProgressEstimate(len(points), progress or (lambda done, total, state: None))
    pace.resumed = len(finished)
    pace.tell()
    waiting = [points[key] for key in points if key not in finished]
    failed = _without_tables(sweep, waiting, directory, pace)
    waiting = [point for point in waiting if point.key not in failed]
    if waiting:
        with _closing(pool(), directory) as workers:
            folder = str(directory.resolve()) if workers.shares_folder else None
            tasks = (_task(sweep, point, directory, folder) for point in waiting)
            _execute(tasks, workers, directory, pace)
    return Batch(
        sweep=sweep, directory=directory, resumed=frozenset(finished), wall=perf_counter() - start
    )


def _task(sweep: Sweep, point: Point, directory: Path, folder: str | None) -> Task:
    path = None if point.tables is None else table_path(directory, point.tables)
    return Task(
        key=point.key,
        document=point.document,
        compute=sweep.compute,
        fields=sweep.fields,
        share=any(key.partition(".")[0] in WITHOUT_CONTACTS for key in sweep.keys),
        folder=folder,
        tables=None if path is None else str(path.resolve()),
        table_points=sweep.table_points,
    )


def _without_tables(
    sweep: Sweep, waiting: list[Point], directory: Path, pace: ProgressEstimate
) -> set[str]:
    """Build the traction tables that points need; points for want of them are recorded."""
    if all(point.tables is None for point in waiting):
        return set()
    problems = prepare_tables(sweep, {point.key for point in waiting}, directory, pace.notify)
    failed = {point.key: problems[point.tables] for point in waiting if point.tables in problems}
    for key, message in failed.items():
        write_point(directory, key, failure(key, FAILED, message).files)
        pace.done += 1
    pace.start = perf_counter()  # the rate is that of the points
    return set(failed)


@contextmanager
def _closing(pool: Pool, directory: Path) -> Iterator[Pool]:
    """A pool that ends with the work inside; what a worker was writing when it was ended goes
    with it, also where the program ends before it is back here.
    """
    atexit.register(remove_unfinished, directory)
    try:
        yield pool
        pool.close(at_once=False)
    except BaseException:
        pool.close(at_once=True)
        remove_unfinished(directory)
        atexit.unregister(remove_unfinished)
        raise
    atexit.unregister(remove_unfinished)


def _execute(tasks: Iterable[Task], pool: Pool, directory: Path, pace: ProgressEstimate) -> None:
    """Keep every worker busy; the points of a lost worker are tried again, one at a time."""
    waiting = deque(tasks)
    running = dict[Future[Receipt], Task]()
    suspects = list[Task]()
    while waiting or running or suspects:
        room = pool.capacity() if not suspects else 0
        while waiting and len(running) < room:
            task = waiting.popleft()
            running[_submit(pool, task)] = task
        done, _ = wait(running, timeout=TICK, return_when=FIRST_COMPLETED)
        for future in done:
            task = running.pop(future)
            if not _keep(future, task, pool, directory, pace):
                suspects.append(task)
        if suspects:
            suspects += running.values()
            running.clear()
            pool.rebuild()
            for task in suspects:
                _alone(task, pool, directory, pace)
            suspects.clear()
        pace.tell()


def _submit(pool: Pool, task: Task) -> Future[Receipt]:
    """Hand out a task; a pool that broke meanwhile says so through the future."""
    try:
        return pool.submit(task)
    except Exception as error:
        if not pool.lost(error):
            raise
        future: Future[Receipt] = Future()
        future.set_exception(error)
        return future


def _keep(
    future: Future[Receipt], task: Task, pool: Pool, directory: Path, pace: ProgressEstimate
) -> bool:
    """Put a finished point on disk; whether its worker was there to the end."""
    try:
        receipt = future.result()
    except (Exception, CancelledError) as error:
        if pool.lost(error):
            if pool.shares_folder:
                return False
            receipt = _given_up(task, f"the worker was lost repeatedly: {_words(error)}")
        elif isinstance(error, OSError | CancelledError | MemoryError):
            raise
        else:
            receipt = failure(task.key, FAILED, _words(error))
    if receipt.files:
        write_point(directory, task.key, receipt.files)
    pace.done += 1
    return True


def _alone(task: Task, pool: Pool, directory: Path, pace: ProgressEstimate) -> None:
    """A point whose worker may have died of it, by itself; recorded if it loses a second one."""
    future = _submit(pool, task)
    wait([future])
    if not _keep(future, task, pool, directory, pace):
        pool.rebuild()
        write_point(directory, task.key, _given_up(task, "the worker was lost twice").files)
        pace.done += 1


def _given_up(task: Task, message: str) -> Receipt:
    advice = "killed from outside, or out of memory; try fewer nodes, or fewer workers"
    return failure(task.key, LOST, f"{message} ({advice})")


def _words(error: BaseException) -> str:
    return f"{type(error).__name__}: {' '.join(str(error).split())[:300]}"
