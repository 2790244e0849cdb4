"""Commands on many points: batch."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from oilfilm.bearing.files import is_disk_failure

from ..format.rules import CaseError
from ..runs.interrupt import finish_first, print_message
from ..runs.output_directory import scratch_folder
from ..runs.processes import POINTS, fork_server
from . import terminal
from .output import batch_cost, lock_output_directory, report, report_cost, table_cost

if TYPE_CHECKING:
    from rich.console import Group

    from oilfilm.postprocess.batch.packed_columns import Columns
    from oilfilm.postprocess.batch.results import BatchResults

    from ..batch.engine import Batch, PointSelection
    from ..batch.points import Sweep
    from ..batch.pools import Pool

MOST_LISTED = 10  # points without a result that are named
Workers = Annotated[
    int | None, typer.Option(min=1, metavar="N", help="Processes; default: cores.")
]
Scheduler = Annotated[
    str | None,
    typer.Option(metavar="ADDRESS", help="Compute on the Dask cluster of this scheduler instead."),
]
ExecutorName = Annotated[
    str | None,
    typer.Option(
        metavar="MODULE:FUNCTION", help="Compute on the executor that this function makes."
    ),
]
ShardName = Annotated[
    str | None,
    typer.Option(metavar="I/N", help="Compute share I of N only, beside the others; no results."),
]
PointSeconds = Annotated[
    float | None, typer.Option(min=0.001, metavar="S", help="Most time of a point [s].")
]
PointMemory = Annotated[
    float | None, typer.Option(min=0.001, metavar="GB", help="Most memory of a point [GB].")
]


@dataclass(frozen=True, slots=True, kw_only=True)
class _Wanted:
    """Further files that are written, and the workers that compute."""

    workers: int | None
    scheduler: str | None
    executor: str | None
    plot: bool
    parquet: bool
    csv: bool


@terminal.command()
def batch(
    sweep: Annotated[
        str, typer.Argument(metavar="SWEEP", help="A sweep file, or the name of a shipped one.")
    ],
    output: terminal.Output = None,
    workers: Workers = None,
    scheduler: Scheduler = None,
    executor: ExecutorName = None,
    resume: Annotated[
        bool, typer.Option("--resume", help="Take over the finished points in DIR.")
    ] = False,
    retry_failed: Annotated[
        bool, typer.Option("--retry-failed", help="Only the points that failed or were lost.")
    ] = False,
    shard: ShardName = None,
    collect: Annotated[
        bool, typer.Option("--collect", help="Compute nothing; results of all points in DIR.")
    ] = False,
    point_seconds: PointSeconds = None,
    point_memory: PointMemory = None,
    plot: Annotated[
        bool, typer.Option("--plot", help="Draw torque and film over the varied keys.")
    ] = False,
    keep_json: Annotated[
        bool, typer.Option("--keep-json", help="Also the summary of each point as a file.")
    ] = False,
    parquet: Annotated[
        bool, typer.Option("--parquet", help="Also the table as batch.parquet.")
    ] = False,
    csv: Annotated[
        bool, typer.Option("--csv", help="batch.csv also of more than 100000 points.")
    ] = False,
    as_json: terminal.Json = False,
    quiet: terminal.Quiet = False,
    notes: terminal.Notes = False,
) -> int:
    """Run many points of one case: factorial, listed, sampled."""
    wanted = _Wanted(
        workers=workers,
        scheduler=scheduler,
        executor=executor,
        plot=plot,
        parquet=parquet,
        csv=csv,
    )
    limited = bool(point_seconds or point_memory)
    _check(wanted, limited=limited, single_writer=shard is None)
    again = resume or retry_failed or collect or shard is not None
    keep = output is not None or again or not as_json
    directory = output or Path(f"{Path(sweep).stem}_results")
    with _folder(directory, keep=keep, shared=shard is not None) as folder:
        named = folder if keep else None
        if resume and shard is None and not plot:
            from ..batch.finished import finished_summary

            finished = finished_summary(sweep, folder, parquet=parquet)
            if finished is not None:
                return _report(finished, named, as_json, quiet, notes)
        # loads while this process plans
        with fork_server(POINTS, wanted=not (scheduler or executor or collect)):
            from ..batch.engine import PointSelection, computed_before
            from ..batch.points import Limits
            from ..batch.results import collect_results
            from ..batch.sweep import SINGLE_WRITER, read_sweep, shard_of

            choice = PointSelection(
                resume=again,
                only_failed=retry_failed,
                shard=SINGLE_WRITER if shard is None else shard_of(shard),
                limits=Limits(seconds=point_seconds, memory=point_memory),
                keep_json=keep_json,
            )
            plan = read_sweep(sweep)
            if collect:
                done = computed_before(plan, folder)
            else:
                done = _compute(plan, folder, wanted, choice, keep=keep, quiet=quiet)
            if shard is not None:
                return _report_shard(done, choice, as_json=as_json, quiet=quiet)
            with report_stored_points(named), collect_results(done) as (results, columns):
                document = _write(results, columns, folder, wanted)
                return _report(document, named, as_json, quiet, notes)


def _check(wanted: _Wanted, *, limited: bool, single_writer: bool) -> None:
    """`CaseError` for options that exclude each other, and for libraries that are not there."""
    names = ("workers", "scheduler", "executor")
    given = [f"--{name}" for name in names if getattr(wanted, name) is not None]
    if len(given) > 1:
        raise CaseError(f"{', '.join(given)}: found together; allowed: one of them")
    if wanted.scheduler is not None and limited:
        allowed = "allowed: the limits of Dask, distributed.worker.memory and --lifetime"
        raise CaseError(f"--point-seconds, --point-memory: found with --scheduler; {allowed}")
    if not single_writer and (wanted.plot or wanted.parquet or wanted.csv):
        allowed = "allowed with --collect, when all shards are done"
        raise CaseError(f"--plot, --parquet, --csv: found with --shard; {allowed}")
    if wanted.parquet:
        try:
            import pyarrow  # noqa: F401
        except ImportError:
            needed = "pip install 'oilfilm[parquet]'"
            raise CaseError(f"--parquet: needs the package pyarrow: {needed}") from None


def _compute(
    plan: Sweep,
    directory: Path,
    wanted: _Wanted,
    choice: PointSelection,
    *,
    keep: bool,
    quiet: bool,
) -> Batch:
    """Compute the points that are selected."""
    from ..batch.engine import run_batch

    _report_cost(plan, wanted.workers, choice.shard.count, quiet=quiet)
    stored = report_stored_points(directory if keep else None)
    with stored, terminal.progress_bar(quiet=quiet) as progress:
        return run_batch(plan, directory, _pool(plan, wanted), choice, progress=progress)


def _write(
    results: BatchResults, columns: Columns, directory: Path, wanted: _Wanted
) -> dict[str, Any]:
    """Write the results of all points; their summary."""
    from ..batch import results as files

    with finish_first(f"results in {directory}"):
        table = wanted.csv or len(columns.source) <= files.MOST_LINES
        document = files.write_batch(results, directory, columns, _others(wanted), table=table)
        if wanted.plot:
            _plot(results, directory)
    return document


def _others(wanted: _Wanted) -> dict[str, Callable[[Columns, Path], None]]:
    """Writers of further files."""
    if not wanted.parquet:
        return {}
    from oilfilm.postprocess.batch.write import write_batch_parquet

    from ..batch.keys import PARQUET

    return {PARQUET: write_batch_parquet}


def _report_cost(plan: Sweep, workers: int | None, shards: int, *, quiet: bool) -> None:
    """Announce the time that the points of one shard will take, estimated from the first point."""
    from oilfilm.ehl.multigrid.threads import cores

    from ..format.shaft_case import any_case_of_document

    if quiet or len(plan.points) < 2:
        return
    first = any_case_of_document(plan.points[0].document)
    points = max(1, len(plan.points) // shards)
    what, seconds = batch_cost(first, points, plan.compute)
    count = workers or cores()
    tables = set()
    if isinstance(plan.points, tuple) and plan.table is None:
        tables = {point.tables for point in plan.points} - {None}
    if tables:
        report_cost(table_cost(plan.table_points, len(tables), count), quiet=quiet)
    report_cost((f"{what}, {count} at a time", seconds / count), quiet=quiet)
    print_message("oilfilm: the time left is shown from the first point on")


@contextmanager
def _folder(directory: Path, *, keep: bool, shared: bool) -> Iterator[Path]:
    """The folder of the batch; one that goes away where only the JSON is wanted."""
    if keep:
        yield lock_output_directory(directory, shared=shared)
        return
    with scratch_folder() as temporary:
        yield temporary


@contextmanager
def report_stored_points(directory: Path | None) -> Iterator[None]:
    """Report the points that are stored when a batch is interrupted, or the machine fails.

    Parameters
    ----------
    directory : Path | None
        Folder of the batch; None: nothing is stored.
    """
    from ..batch.store import has_points

    try:
        yield
    except (KeyboardInterrupt, OSError) as stop:
        if directory is not None and has_points(directory):
            full = is_disk_failure(stop)
            go_on = f"{'make room, then ' if full else ''}continue with --resume"
            print_message(f"finished points are kept in {directory}; {go_on}")
        raise


def _pool(plan: Sweep, wanted: _Wanted) -> Callable[[], Pool]:
    def start() -> Pool:
        from oilfilm.ehl.multigrid.threads import cores

        from ..batch.pools import ClusterPool, LocalPool, Pool, executor_factory
        from ..runs.kernel_cache import compiled_stamp

        if wanted.scheduler is not None:
            return ClusterPool(wanted.scheduler)
        if wanted.executor is not None:
            sys.path.insert(0, os.getcwd())  # where a user's own module is
            return Pool(executor_factory(wanted.executor))
        stamp = compiled_stamp(f"{plan.compute} {list(plan.film_models)}")
        return LocalPool(wanted.workers or cores(), stamp)

    return start


def _plot(results: BatchResults, directory: Path) -> None:
    from oilfilm.postprocess.batch.plots import write_batch_plots

    if results.counts is not None:
        print_message(
            "oilfilm: plots: not drawn of more than 10000 points; batch.parquet has them"
        )
        return
    for problem in write_batch_plots(results, directory):
        print_message(f"oilfilm: {problem}")


def _report_shard(done: Batch, choice: PointSelection, *, as_json: bool, quiet: bool) -> int:
    """Say how the points of a shard ended."""
    from ..batch.results import shard_counts

    counts = shard_counts(done, choice.shard)
    if as_json:
        terminal.print_json({"kind": "shard", "shard": str(choice.shard), **counts})
    failed = counts["failed"] + counts["lost"]
    if not quiet or failed:
        named = (f"{number} {name}" for name, number in counts.items() if number)
        words = ", ".join(named) or "no points"
        print_message(f"oilfilm: shard {choice.shard} in {done.directory}: {words}")
    if counts["lost"]:
        return terminal.FAILED
    return terminal.NOT_CONVERGED if counts["converged"] < counts["points"] else 0


def _report(
    document: dict[str, Any], directory: Path | None, as_json: bool, quiet: bool, notes: bool
) -> int:
    """Print summary or table; exit code, in which a lost worker is a failure of the machine."""

    def table() -> Group:
        from oilfilm.postprocess.batch.summary import batch_table

        return batch_table(document)

    code = report(document, table, directory, as_json, quiet, notes)
    counts = document["counts"]
    if document["failed"]:
        from oilfilm.postprocess.batch.results import values_in_words
        from oilfilm.postprocess.batch.summary import WITHOUT_RESULT

        print_message(
            f"oilfilm: {document['failed']} of {counts['points']} points have no result:"
        )
        if document["points"] is None:
            named = [text for text in document["messages"] if WITHOUT_RESULT in text]
        else:
            points = [point for point in document["points"] if point["status"] != "done"]
            named = [
                f"point {p['point']} ({values_in_words(p['keys'])}): {p['message']}"
                for p in points
            ]
        for text in named[:MOST_LISTED]:
            print_message(f"  {text}")
    return terminal.FAILED if counts["lost"] else code
