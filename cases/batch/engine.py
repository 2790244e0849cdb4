"""Execution of a sweep: hand out points, keep what is finished, resume an earlier run."""

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, CancelledError, Future, wait
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter
from typing import Any

from .points import Receipt, Sweep, Task
from .pools import Pool
from .store import SWEEP_FILE, finished_keys, open_folder, write_file, write_point
from .tables import prepare_tables, table_path
from .worker import FAILED, LOST, failure

Notify = Callable[[int, int, str], None]
TICK = 1.0  # the time left is updated at least as often [s]
# tables that leave the contacts as they are
WITHOUT_EFFECT = ("surface", "slip", "friction", "cage", "dynamics")


@dataclass(frozen=True, slots=True, kw_only=True)
class Batch:
    """What a batch did: points finished before, computed, failed, and the wall time [s]."""

    sweep: Sweep
    directory: Path
    resumed: frozenset[str]
    computed: frozenset[str]
    wall: float


class ProgressEstimate:
    """Rate and time left, from the points computed so far."""

    def __init__(self, total: int, notify: Notify) -> None:
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
    progress: Notify | None = None,
) -> Batch:
    """Compute every point of a sweep that is not finished yet.

    Parameters
    ----------
    directory : Path
        Folder of the batch.
    pool : callable
        Starts the workers; called only if there is something to compute.
    resume : bool
        Whether finished points in `directory` are taken over.
    progress : callable, optional
        Called with the points done, the points in all, and a word on rate and time left.

    Returns
    -------
    Batch
        The results themselves are in `directory`.

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
    documents = {point.key: point.document for point in sweep.points}
    finished = finished_keys(directory, documents)
    pace = ProgressEstimate(len(documents), progress or (lambda done, total, state: None))
    pace.resumed = len(finished)
    pace.tell()
    waiting = [key for key in documents if key not in finished]
    tables = _tables(sweep, waiting, directory, pace)
    if waiting and any(key not in tables.failed for key in waiting):
        with _closing(pool()) as workers:
            share = any(key.partition(".")[0] in WITHOUT_EFFECT for key in sweep.keys)
            folder = str(directory.resolve()) if workers.shares_folder else None
            common: dict[str, Any] = {
                "compute": sweep.compute,
                "fields": sweep.fields,
                "share": share,
                "folder": folder,
            }
            common["table_points"] = sweep.table_points
            tasks = (
                Task(key=k, document=documents[k], tables=tables.files.get(k), **common)
                for k in waiting
                if k not in tables.failed
            )
            _execute(tasks, workers, directory, pace)
    return Batch(
        sweep=sweep,
        directory=directory,
        resumed=frozenset(finished),
        computed=frozenset(waiting),
        wall=perf_counter() - start,
    )


@dataclass(frozen=True, slots=True)
class _PointTables:
    """Files of traction tables by point, and points recorded as failed for want of tables."""

    files: dict[str, str]
    failed: frozenset[str]


def _tables(
    sweep: Sweep, waiting: list[str], directory: Path, pace: ProgressEstimate
) -> _PointTables:
    """Build the traction tables that points need; points without them are recorded."""
    unfinished = set(waiting)
    names = {point.key: point.tables for point in sweep.points if point.tables is not None}
    if not any(key in names for key in waiting):
        return _PointTables({}, frozenset())
    problems = prepare_tables(sweep, unfinished, directory, pace.notify)
    failed = {
        key: problems[name]
        for key, name in names.items()
        if key in unfinished and name in problems
    }
    for key, message in failed.items():
        write_point(directory, key, failure(key, FAILED, message))
        pace.done += 1
    files = {key: str(table_path(directory, name).resolve()) for key, name in names.items()}
    pace.start = perf_counter()  # the rate is that of the points
    return _PointTables(files, frozenset(failed))


@contextmanager
def _closing(pool: Pool) -> Iterator[Pool]:
    try:
        yield pool
    except BaseException:
        pool.close(at_once=True)
        raise
    pool.close(at_once=False)


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
            receipt = _given_up(task, f"the worker was lost again and again: {_words(error)}")
        elif isinstance(error, OSError | CancelledError | MemoryError):
            raise
        else:
            receipt = Receipt(
                key=task.key, status=FAILED, files=failure(task.key, FAILED, _words(error))
            )
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
    advice = "killed from outside, or out of memory; fewer points of the mesh, or fewer workers"
    return Receipt(
        key=task.key, status=LOST, files=failure(task.key, LOST, f"{message} ({advice})")
    )


def _words(error: BaseException) -> str:
    text: Any = " ".join(str(error).split())[:300]
    return f"{type(error).__name__}: {text}"
