"""Execution of a sweep: hand out points, keep what is finished, resume an earlier run."""

import atexit
from collections.abc import Callable, Collection, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, CancelledError, Future, wait
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

from ehl.units import notebook_html
from postprocess.batch.records import FAILED, LOST
from postprocess.batch.store import PointStore, StoredPoints, is_sound, store_files

from ..format.problems import CaseError
from ..runs.films import Progress
from ..runs.output_lock import one_writer
from .points import NO_LIMITS, Limits, Receipt, Sweep, Task
from .pools import Pool
from .shards import ALONE, Shard
from .shared.tables import prepare_tables, table_path
from .store import (
    SWEEP_FILE,
    finished_points,
    open_folder,
    open_store,
    remove_unfinished,
    write_file,
    write_files,
    write_summary,
)
from .worker import failure

TICK = 1.0  # the time left is updated at least as often [s]
Block = tuple[Task, ...]
Running = Future[tuple[Receipt, ...]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Choice:
    """Which points of a sweep are computed, and how."""

    resume: bool = False  # whether finished points of the folder are taken over
    only_failed: bool = False  # only points that failed before
    shard: Shard = ALONE
    limits: Limits = NO_LIMITS
    keep_json: bool = False  # also the summary of each point as a file


ALL = Choice()


@dataclass(frozen=True, slots=True, kw_only=True)
class Batch:
    """What a batch did: points finished before, points left out, and the wall time [s]."""

    sweep: Sweep
    directory: Path
    resumed: frozenset[str]
    wall: float

    def _repr_html_(self) -> str:
        """Where the results are, for a notebook."""
        points = len(self.sweep.points)
        facts = {
            "points": f"{points}, {len(self.resumed)} of them taken over",
            "varied": ", ".join(self.sweep.keys),
            "folder": str(self.directory),
            "wall_s": self.wall,
        }
        return notebook_html(self.sweep.title, facts)


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
    choice: Choice = ALL,
    *,
    progress: Progress | None = None,
) -> Batch:
    """Compute every point of a sweep that is not finished yet, into the folder of the batch.

    Parameters
    ----------
    pool : callable
        Starts the workers; called only if there is something to compute.
    choice : Choice, optional
        Which points; all of them, none of an earlier batch, if left out.
    progress : callable, optional
        Called with the points done, the points in all, and a word on rate and time left.

    Raises
    ------
    CaseError
        If the folder cannot be used, or another program writes the same points.
    OSError
        If a finished point cannot be written; all finished before stay.
    """
    start = perf_counter()
    again = choice.resume or choice.only_failed or choice.shard is not ALONE
    open_folder(directory, resume=again, alone=choice.shard is ALONE)
    path = directory / choice.shard.file
    with one_writer(path):
        write_file(directory / SWEEP_FILE, sweep.text.encode("utf-8"))
        finished = _computed(sweep, (directory, path), pool, choice, progress)
    return Batch(
        sweep=sweep, directory=directory, resumed=frozenset(finished), wall=perf_counter() - start
    )


def _computed(
    sweep: Sweep,
    folder: tuple[Path, Path],
    pool: Callable[[], Pool],
    choice: Choice,
    progress: Progress | None,
) -> set[str]:
    """Compute the points that are chosen; those that were finished before.

    `folder`: of the batch, and its file of this writer.
    """
    directory, path = folder
    stored = StoredPoints(store_files(directory))
    keys = dict.fromkeys(point.key for point in sweep.points if choice.shard.has(point.key))
    finished, failed = finished_points(directory, keys, stored)
    broken = path.exists() and (path in stored.damaged or not is_sound(path))
    chosen = failed if choice.only_failed else keys.keys() - finished
    pace = ProgressEstimate(len(keys), progress or (lambda done, total, state: None))
    pace.resumed = len(keys) - len(chosen)
    pace.tell()
    with _kept(open_store(path, broken=broken)) as store:
        work = _Work(directory, store, pace, keep_json=choice.keep_json)
        chosen = chosen - _without_tables(sweep, chosen, work)
        if chosen:
            with _closing(pool(), directory) as workers:
                shared = str(directory.resolve()) if workers.shares_folder else None
                execute(_tasks(sweep, chosen, directory, shared, choice.limits), workers, work)
    return finished


def computed_before(sweep: Sweep, directory: Path) -> Batch:
    """What there is of a batch, of which nothing more is to be computed.

    `CaseError` if the folder holds no points of a batch.
    """
    start = perf_counter()
    if not store_files(directory):
        raise CaseError(f"{directory}: holds no points of a batch; allowed: the -o of its shards")
    open_folder(directory, resume=True)
    write_file(directory / SWEEP_FILE, sweep.text.encode("utf-8"))
    keys = dict.fromkeys(point.key for point in sweep.points)
    finished, _ = finished_points(directory, keys, StoredPoints(store_files(directory)))
    wall = perf_counter() - start
    return Batch(sweep=sweep, directory=directory, resumed=frozenset(finished), wall=wall)


@contextmanager
def _kept(store: PointStore) -> Iterator[PointStore]:
    """A file of points that is closed at the end; what is finished stays, however that comes."""
    try:
        yield store
    except BaseException:
        store.close(keep=False)
        raise
    store.close()


class _Work:
    """Finished points: where they go, and how many there are."""

    def __init__(
        self, directory: Path, store: PointStore, pace: ProgressEstimate, *, keep_json: bool
    ) -> None:
        self.directory = directory
        self.store = store
        self.pace = pace
        self.keep_json = keep_json

    def keep(self, receipt: Receipt) -> None:
        """Put a finished point on disk: its own files first."""
        record = receipt.record
        write_files(self.directory, record.key, receipt.files)
        if self.keep_json:
            write_summary(self.directory, record)
        self.store.put(record)
        self.pace.done += 1

    def tick(self) -> None:
        """Show how far it is, and put on disk what is due."""
        self.store.flush()
        self.pace.tell()


def _tasks(
    sweep: Sweep, keys: Collection[str], directory: Path, folder: str | None, limits: Limits
) -> Iterator[Task]:
    """The points of some names, each once, in the order of the file."""
    left = set(keys)
    for point in sweep.points:
        if point.key in left:
            left.remove(point.key)
            tables = None if point.tables is None else table_path(directory, point.tables)
            yield Task(
                key=point.key,
                document=point.document,
                compute=sweep.compute,
                fields=sweep.fields,
                share=sweep.share,
                folder=folder,
                keys=sweep.keys,
                tables=None if tables is None else str(tables.resolve()),
                table_points=sweep.table_points,
                limits=limits,
            )


def _without_tables(sweep: Sweep, keys: Collection[str], work: _Work) -> set[str]:
    """Build the traction tables that points need; points for want of them are recorded."""
    if not isinstance(sweep.points, tuple):  # which only points without tables are not
        return set()
    waiting = {point.key: point for point in sweep.points if point.key in keys}
    if all(point.tables is None for point in waiting.values()):
        return set()
    problems = prepare_tables(sweep, waiting.keys(), work.directory, work.pace.notify)
    failed = {key: problems[p.tables] for key, p in waiting.items() if p.tables in problems}
    for key, message in failed.items():
        work.keep(failure(key, FAILED, message))
    work.pace.start = perf_counter()  # the rate is that of the points
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


class _Queue:
    """Tasks in their order, some at a time."""

    def __init__(self, tasks: Iterable[Task]) -> None:
        self._tasks = iter(tasks)
        self._next = next(self._tasks, None)

    def block(self, size: int) -> Block:
        """At most `size` tasks of the same traction tables; empty at the end."""
        block = list[Task]()
        while self._next is not None and len(block) < size:
            if block and self._next.tables != block[0].tables:
                break
            block.append(self._next)
            self._next = next(self._tasks, None)
        return tuple(block)


def execute(tasks: Iterable[Task], pool: Pool, work: _Work) -> None:
    """Keep every worker busy; the points of a lost worker are tried again, one at a time."""
    running = dict[Running, Block]()
    try:
        _execute(_Queue(tasks), running, pool, work)
    except KeyboardInterrupt:
        for future in running:
            if future.done() and not future.cancelled() and future.exception() is None:
                for receipt in future.result():
                    work.keep(receipt)
        raise


def _execute(waiting: _Queue, running: dict[Running, Block], pool: Pool, work: _Work) -> None:
    suspects = list[Task]()
    block = waiting.block(pool.block())
    while block or running or suspects:
        while block and not suspects and len(running) < pool.capacity():
            running[_submit(pool, block)] = block
            block = waiting.block(pool.block())
        done, _ = wait(running, timeout=TICK, return_when=FIRST_COMPLETED)
        for future in done:
            tried = running.pop(future)
            if not _keep(future, tried, pool, work):
                suspects += tried
        if suspects:
            suspects += (task for tried in running.values() for task in tried)
            running.clear()
            pool.rebuild()
            for task in suspects:
                _alone(task, pool, work)
            suspects.clear()
        work.tick()


def _submit(pool: Pool, block: Block) -> Running:
    """Hand out tasks; a pool that broke meanwhile says so through the future."""
    try:
        return pool.submit(block)
    except Exception as error:
        if not pool.lost(error):
            raise
        future: Running = Future()
        future.set_exception(error)
        return future


def _keep(future: Running, block: Block, pool: Pool, work: _Work) -> bool:
    """Put finished points on disk; whether their worker was there to the end."""
    try:
        receipts = future.result()
    except (Exception, CancelledError) as error:
        if pool.lost(error):
            if pool.retries:
                return False
            words = f"the worker was lost repeatedly: {_words(error)}"
            receipts = tuple(_given_up(task, words) for task in block)
        elif isinstance(error, OSError | CancelledError | MemoryError):
            raise
        else:
            receipts = tuple(failure(task.key, FAILED, _words(error)) for task in block)
    for receipt in receipts:
        work.keep(receipt)
    return True


def _alone(task: Task, pool: Pool, work: _Work) -> None:
    """A point whose worker may have died of it, by itself; recorded if it loses a second one."""
    future = _submit(pool, (task,))
    while not wait([future], timeout=TICK).done:
        work.tick()
    if not _keep(future, (task,), pool, work):
        pool.rebuild()
        work.keep(_given_up(task, "the worker was lost twice"))


def _given_up(task: Task, message: str) -> Receipt:
    limit = "" if task.limits.seconds is None else "; a point beyond its time, too, ends so"
    advice = f"killed from outside, or out of memory; try fewer nodes, or fewer workers{limit}"
    return failure(task.key, LOST, f"{message} ({advice})")


def _words(error: BaseException) -> str:
    return f"{type(error).__name__}: {' '.join(str(error).split())[:300]}"
