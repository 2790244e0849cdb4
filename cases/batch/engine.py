"""Execution of a sweep: points are submitted, stored when they are finished, and resumed."""

import atexit
from collections.abc import Callable, Collection, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, CancelledError, Future, wait
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import groupby, islice
from pathlib import Path
from time import perf_counter

from oilfilm.ehl.units import notebook_html
from oilfilm.postprocess.batch.store import (
    FAILED,
    LOST,
    PointStore,
    StoredPoints,
    is_sound,
    store_files,
)

from ..format.rules import CaseError
from ..runs.films import Progress
from ..runs.output_directory import one_writer
from .compute import failure
from .keys import SWEEP_FILE
from .points import NO_LIMITS, Limits, PointResult, Sweep, Task
from .pools import Pool
from .shared_tables import prepare_tables, table_path
from .store import (
    finished_points,
    open_folder,
    open_store,
    remove_unfinished,
    write_file,
    write_files,
    write_summary,
)
from .sweep import SINGLE_WRITER, Shard

TICK = 1.0  # the time left is updated at least as often [s]
Block = tuple[Task, ...]
Running = Future[tuple[PointResult, ...]]


@dataclass(frozen=True, slots=True, kw_only=True)
class PointSelection:
    """Points of a sweep that are computed, and the limits of each."""

    resume: bool = False  # finished points of the folder are taken over
    only_failed: bool = False  # only points that failed before
    shard: Shard = SINGLE_WRITER
    limits: Limits = NO_LIMITS
    keep_json: bool = False  # also the summary of each point as a file


ALL_POINTS = PointSelection()


@dataclass(frozen=True, slots=True, kw_only=True)
class Batch:
    """A batch: its points, its folder, the points finished before, and the wall time [s]."""

    sweep: Sweep
    directory: Path
    resumed: frozenset[str]
    wall: float

    def _repr_html_(self) -> str:
        """Folder and number of points, for a notebook."""
        points = len(self.sweep.points)
        facts = {
            "points": f"{points}, {len(self.resumed)} of them taken over",
            "varied": ", ".join(self.sweep.keys),
            "folder": str(self.directory),
            "wall_s": self.wall,
        }
        return notebook_html(self.sweep.title, facts)


class ProgressEstimate:
    """Rate and time left, from the points computed so far.

    Parameters
    ----------
    total : int
        Points in all [-].
    notify : callable
        Called with the points done, the points in all, and a text on rate and time left.
    """

    def __init__(self, total: int, notify: Progress) -> None:
        self.total = total
        self.done = 0
        self.resumed = 0
        self.notify = notify
        self.start = perf_counter()

    def report(self) -> None:
        """Report the progress of the batch."""
        self.notify(self.done + self.resumed, self.total, self.text(perf_counter() - self.start))

    def text(self, elapsed: float) -> str:
        """Rate and time left in words.

        Parameters
        ----------
        elapsed : float
            Time since the start [s].

        Returns
        -------
        str
            Text for the progress bar.
        """
        if not self.done or elapsed <= 0.0:
            return "points"
        rate = self.done / elapsed
        left = (self.total - self.done - self.resumed) / rate
        speed = f"{rate:.3g}/s" if rate >= 1.0 else f"{60.0 * rate:.3g}/min"
        return f"points, {speed}, {duration(left)} left"


def duration(seconds: float) -> str:
    """A time span in words.

    Parameters
    ----------
    seconds : float
        The time span [s].

    Returns
    -------
    str
        In seconds, minutes or hours.
    """
    if seconds < 99.5:
        return f"{seconds:.0f} s"
    if seconds < 5970.0:
        return f"{seconds / 60.0:.0f} min"
    return f"{seconds / 3600.0:.1f} h"


def run_batch(
    sweep: Sweep,
    directory: Path,
    pool: Callable[[], Pool],
    selection: PointSelection = ALL_POINTS,
    *,
    progress: Progress | None = None,
) -> Batch:
    """Compute every point of a sweep that is not finished yet, into the folder of the batch.

    Parameters
    ----------
    sweep : Sweep
        The points.
    directory : Path
        Folder of the batch.
    pool : callable
        Starts the workers; called only if there is something to compute.
    selection : PointSelection, optional
        Points to compute; all of them, none of an earlier batch, if left out.
    progress : callable, optional
        Called with the points done, the points in all, and a text on rate and time left.

    Returns
    -------
    Batch
        The finished batch; `oilfilm.cases.batch.results` reads its points.

    Raises
    ------
    CaseError
        If the folder cannot be used, or another program writes the same points.
    OSError
        If a finished point cannot be written; all finished before stay.

    Examples
    --------
    >>> from pathlib import Path
    >>> import oilfilm
    >>> from oilfilm.cases.batch import LocalPool
    >>> sweep = oilfilm.read_sweep("6208_load_and_speed")
    >>> batch = oilfilm.run_batch(sweep, Path("sweep"), lambda: LocalPool(2))  # doctest: +SKIP
    """
    start = perf_counter()
    single = selection.shard is SINGLE_WRITER
    again = selection.resume or selection.only_failed or not single
    open_folder(directory, resume=again, single_writer=single)
    file = directory / selection.shard.file
    with one_writer(file):
        write_file(directory / SWEEP_FILE, sweep.text.encode("utf-8"))
        finished = _compute(sweep, directory, file, pool, selection, progress)
    return _batch(sweep, directory, finished, start)


def computed_before(sweep: Sweep, directory: Path) -> Batch:
    """Open a batch of which nothing more is to be computed.

    Parameters
    ----------
    sweep : Sweep
        Its points.
    directory : Path
        Its folder.

    Returns
    -------
    Batch
        The batch with all points that are finished.

    Raises
    ------
    CaseError
        If the folder holds no points of a batch.
    """
    start = perf_counter()
    if not store_files(directory):
        raise CaseError(f"{directory}: holds no points of a batch; allowed: the -o of its shards")
    open_folder(directory, resume=True)
    write_file(directory / SWEEP_FILE, sweep.text.encode("utf-8"))
    keys = dict.fromkeys(point.key for point in sweep.points)
    finished, _ = finished_points(directory, keys, StoredPoints(store_files(directory)))
    return _batch(sweep, directory, finished, start)


def _batch(sweep: Sweep, directory: Path, finished: set[str], start: float) -> Batch:
    wall = perf_counter() - start
    return Batch(sweep=sweep, directory=directory, resumed=frozenset(finished), wall=wall)


def _compute(
    sweep: Sweep,
    directory: Path,
    file: Path,
    pool: Callable[[], Pool],
    selection: PointSelection,
    progress: Progress | None,
) -> set[str]:
    """Compute the selected points into a file of the folder; names of those finished before."""
    stored = StoredPoints(store_files(directory))
    keys = dict.fromkeys(point.key for point in sweep.points if selection.shard.has(point.key))
    finished, failed = finished_points(directory, keys, stored)
    broken = file.exists() and (file in stored.damaged or not is_sound(file))
    chosen = failed if selection.only_failed else keys.keys() - finished
    estimate = ProgressEstimate(len(keys), progress or (lambda done, total, state: None))
    estimate.resumed = len(keys) - len(chosen)
    estimate.report()
    with _closing_store(open_store(file, broken=broken)) as store:
        recorder = _Recorder(directory, store, estimate, keep_json=selection.keep_json)
        chosen = chosen - _without_tables(sweep, chosen, recorder)
        if chosen:
            with _closing_pool(pool(), directory) as workers:
                shared = str(directory.resolve()) if workers.shares_folder else None
                tasks = _tasks(sweep, chosen, directory, shared, selection.limits)
                _execute(tasks, workers, recorder)
    return finished


@contextmanager
def _closing_store(store: PointStore) -> Iterator[PointStore]:
    """A file of points that is closed at the end; finished points stay, whatever ends the work."""
    try:
        yield store
    except BaseException:
        store.close(keep=False)
        raise
    store.close()


@contextmanager
def _closing_pool(pool: Pool, directory: Path) -> Iterator[Pool]:
    """A pool that ends with the work inside; files that a worker was writing when it was ended
    are removed, also where the program ends before it is back here.
    """
    atexit.register(remove_unfinished, directory)
    try:
        yield pool
        pool.close(at_once=False)
    except BaseException:
        pool.close(at_once=True)
        remove_unfinished(directory)
        raise
    finally:
        atexit.unregister(remove_unfinished)


class _Recorder:
    """Finished points on their way to the disk, and their number."""

    def __init__(
        self, directory: Path, store: PointStore, estimate: ProgressEstimate, *, keep_json: bool
    ) -> None:
        self.directory = directory
        self.points = store
        self.estimate = estimate
        self.keep_json = keep_json

    def store(self, result: PointResult) -> None:
        """Put a finished point on disk: its own files first."""
        record = result.record
        write_files(self.directory, record.key, result.files)
        if self.keep_json:
            write_summary(self.directory, record)
        self.points.put(record)
        self.estimate.done += 1

    def tick(self) -> None:
        """Report the progress, and put on disk what is due."""
        self.points.flush()
        self.estimate.report()


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
                share_contacts=sweep.share_contacts,
                folder=folder,
                keys=sweep.keys,
                tables=None if tables is None else str(tables.resolve()),
                table_points=sweep.table_points,
                outputs=sweep.outputs,
                limits=limits,
            )


def _without_tables(sweep: Sweep, keys: Collection[str], recorder: _Recorder) -> set[str]:
    """Build the traction tables that points need; points for want of them are recorded."""
    if not isinstance(sweep.points, tuple):  # which only points without tables are not
        return set()
    waiting = {point.key: point for point in sweep.points if point.key in keys}
    if all(point.tables is None for point in waiting.values()):
        return set()
    estimate = recorder.estimate
    problems = prepare_tables(sweep, waiting.keys(), recorder.directory, estimate.notify)
    failed = {key: problems[p.tables] for key, p in waiting.items() if p.tables in problems}
    for key, message in failed.items():
        recorder.store(failure(key, FAILED, message))
    estimate.start = perf_counter()  # the rate is that of the points
    return set(failed)


def _blocks(tasks: Iterable[Task], size: Callable[[], int]) -> Iterator[Block]:
    """Tasks in their order, at most `size()` of the same traction tables at a time."""
    for _, alike in groupby(tasks, key=lambda task: task.tables):
        while block := tuple(islice(alike, size())):
            yield block


def _execute(tasks: Iterable[Task], pool: Pool, recorder: _Recorder) -> None:
    """Keep every worker busy; the points of a lost worker are tried again, one at a time."""
    running = dict[Running, Block]()
    blocks = _blocks(tasks, pool.block)
    try:
        block = next(blocks, ())
        while block or running:
            while block and len(running) < pool.capacity():
                running[_submit(pool, block)] = block
                block = next(blocks, ())
            done, _ = wait(running, timeout=TICK, return_when=FIRST_COMPLETED)
            lost = [task for one in done for task in _store(one, running.pop(one), pool, recorder)]
            if lost:
                lost += (task for tried in running.values() for task in tried)
                running.clear()
                pool.rebuild()
                for task in lost:
                    _retry_single(task, pool, recorder)
            recorder.tick()
    except KeyboardInterrupt:
        for future in running:
            if future.done() and not future.cancelled() and future.exception() is None:
                for result in future.result():
                    recorder.store(result)
        raise


def _submit(pool: Pool, block: Block) -> Running:
    """Submit tasks; a pool that broke meanwhile says so through the future."""
    try:
        return pool.submit(block)
    except Exception as error:
        if not pool.lost(error):
            raise
        future: Running = Future()
        future.set_exception(error)
        return future


def _store(future: Running, block: Block, pool: Pool, recorder: _Recorder) -> Block:
    """Put finished points on disk; the tasks to try again, since their worker was lost."""
    try:
        results = future.result()
    except (Exception, CancelledError) as error:
        if pool.lost(error):
            if pool.retries:
                return block
            text = f"the worker was lost repeatedly: {_text(error)}"
            results = tuple(_given_up(task, text) for task in block)
        elif isinstance(error, OSError | CancelledError | MemoryError):
            raise
        else:
            results = tuple(failure(task.key, FAILED, _text(error)) for task in block)
    for result in results:
        recorder.store(result)
    return ()


def _retry_single(task: Task, pool: Pool, recorder: _Recorder) -> None:
    """Compute a point whose worker may have died of it by itself; a second loss is recorded."""
    future = _submit(pool, (task,))
    while not wait([future], timeout=TICK).done:
        recorder.tick()
    if _store(future, (task,), pool, recorder):
        pool.rebuild()
        recorder.store(_given_up(task, "the worker was lost twice"))


def _given_up(task: Task, message: str) -> PointResult:
    limit = "" if task.limits.seconds is None else "; a point beyond its time, too, ends so"
    advice = f"killed from outside, or out of memory; try fewer nodes, or fewer workers{limit}"
    return failure(task.key, LOST, f"{message} ({advice})")


def _text(error: BaseException) -> str:
    return f"{type(error).__name__}: {' '.join(str(error).split())[:300]}"
