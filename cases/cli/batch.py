"""Commands on many points: batch."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from bearing.files import is_disk_failure

from ..format.problems import CaseError
from ..runs.interrupt import finish_first, say
from ..runs.output_lock import scratch_folder
from .app import Json, Output, Quiet, app
from .cost import batch_cost, tell_cost
from .output import held_directory, report
from .progress import progress_bar
from .terminal import FAILED, guarded

if TYPE_CHECKING:
    from postprocess.batch.results import BatchResults

    from ..batch.points import Sweep
    from ..batch.pools import Pool

Workers = Annotated[
    int | None, typer.Option(min=1, metavar="N", help="Processes; default: cores.")
]
Scheduler = Annotated[
    str | None,
    typer.Option(metavar="ADDRESS", help="Compute on the Dask cluster of this scheduler instead."),
]


@app.command()
@guarded
def batch(  # noqa: PLR0913
    sweep: Annotated[
        str, typer.Argument(metavar="SWEEP", help="A sweep file, or the name of a shipped one.")
    ],
    output: Output = None,
    workers: Workers = None,
    scheduler: Scheduler = None,
    resume: Annotated[
        bool, typer.Option("--resume", help="Take over the finished points in DIR.")
    ] = False,
    plot: Annotated[
        bool, typer.Option("--plot", help="Draw torque and film over the varied keys.")
    ] = False,
    as_json: Json = False,
    quiet: Quiet = False,
) -> int:
    """Run many points of one case: factorial, listed, sampled."""
    from ..batch.engine import run_batch
    from ..batch.results import gathered, write_batch
    from ..batch.sweep import read_sweep

    if workers is not None and scheduler is not None:
        raise CaseError("--workers, --scheduler: found together; allowed: one of them")
    plan = read_sweep(sweep)
    keep = output is not None or resume or not as_json
    with _folder(output or Path(f"{Path(sweep).stem}_results"), keep=keep) as directory:
        _tell(plan, workers, quiet=quiet)
        with _kept(directory if keep else None):
            with progress_bar(quiet=quiet) as progress:
                pool = _pool(plan, workers, scheduler)
                done = run_batch(plan, directory, pool, resume=resume, progress=progress)
            results = gathered(done)
            with finish_first(f"results in {directory}"):
                write_batch(results, directory)
                if plot:
                    _plot(results, directory)
        return _report(results, directory if keep else None, as_json, quiet)


def _tell(plan: Sweep, workers: int | None, *, quiet: bool) -> None:
    """Say what the points will take, from the first of them."""
    from ehl.multigrid.threads import cores

    from ..format.case import case_of_document

    if quiet or len(plan.points) < 2:
        return
    first = case_of_document(plan.points[0].document)
    what, seconds = batch_cost(first, len(plan.points), plan.compute)
    count = workers or cores()
    tell_cost((f"{what}, {count} at a time", seconds / count), quiet=quiet)
    say("oilfilm: the time left is shown from the first point on")


@contextmanager
def _folder(directory: Path, *, keep: bool) -> Iterator[Path]:
    """The folder of the batch; one that goes away where only the JSON is wanted."""
    if keep:
        yield held_directory(directory)
        return
    with scratch_folder() as temporary:
        yield temporary


@contextmanager
def _kept(directory: Path | None) -> Iterator[None]:
    """Say what is left of a batch that was stopped, or that the machine failed."""
    from ..batch.store import POINTS

    try:
        yield
    except (KeyboardInterrupt, OSError) as stop:
        if directory is not None and any((directory / POINTS).glob("*.json")):
            full = is_disk_failure(stop)
            go_on = f"{'make room, then ' if full else ''}continue with --resume"
            say(f"finished points are kept in {directory}; {go_on}")
        raise


def _pool(plan: Sweep, workers: int | None, scheduler: str | None) -> Callable[[], Pool]:
    def start() -> Pool:
        from ehl.multigrid.threads import cores

        from ..batch.pools import ClusterPool, LocalPool
        from ..runs.kernel_cache import compiled_stamp

        if scheduler is not None:
            return ClusterPool(scheduler)
        models = {str(point.resolved.get("ehl", {}).get("film_model")) for point in plan.points}
        return LocalPool(workers or cores(), compiled_stamp(f"{plan.compute} {sorted(models)}"))

    return start


def _plot(results: BatchResults, directory: Path) -> None:
    from postprocess.batch.plots import write_batch_plots

    for problem in write_batch_plots(results, directory):
        say(f"oilfilm: {problem}")


def _report(results: BatchResults, directory: Path | None, as_json: bool, quiet: bool) -> int:
    """Print summary or table; exit code, in which a lost worker is a failure of the machine."""
    from postprocess.batch.summary import batch_summary
    from postprocess.batch.table import batch_table

    document = batch_summary(results)
    code = report(document, lambda: batch_table(results), directory, as_json, quiet)
    failed = [point for point in results.points if point.summary is None]
    if failed:
        say(f"oilfilm: {len(failed)} of {len(results.points)} points have no result:")
        for point in failed[:10]:
            say(f"  point {point.number} ({point.label}): {point.message}")
    return FAILED if any(point.status == "lost" for point in failed) else code
