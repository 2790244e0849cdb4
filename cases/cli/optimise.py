"""Commands that search: optimise."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..runs.interrupt import finish_first
from .app import Json, Output, Quiet, app
from .batch import Workers
from .output import held_directory, report
from .progress import progress_bar
from .terminal import guarded, hold

if TYPE_CHECKING:
    from ..optimise.search import Found
    from ..optimise.study import Study


@app.command()
@guarded
def optimise(
    file: Annotated[
        str,
        typer.Argument(metavar="FILE", help="An optimisation file, or the name of a shipped one."),
    ],
    output: Output = None,
    workers: Workers = None,
    resume: Annotated[
        bool, typer.Option("--resume", help="Take over the finished points in DIR.")
    ] = False,
    as_json: Json = False,
    quiet: Quiet = False,
) -> int:
    """Search the keys of a case for the best designs within limits."""
    from ..format.shipped import find_optimisation
    from ..optimise.results import optimisation_table, write_optimisation
    from ..optimise.study import read_study

    study = read_study(find_optimisation(file))
    keep = output is not None or resume or not as_json
    directory = (
        held_directory(output or Path(f"{Path(file).stem}_results")) if keep else _scratch()
    )
    found = _found(study, directory, workers, resume=resume, quiet=quiet)
    with finish_first(f"results in {directory}"):
        document = write_optimisation(found, directory)
    table = lambda: optimisation_table(found)  # noqa: E731
    return report(document, table, directory if keep else None, as_json, quiet)


def _scratch() -> Path:
    from ..runs.output_lock import scratch_folder

    return hold(scratch_folder())


def _found(
    study: Study, directory: Path, workers: int | None, *, resume: bool, quiet: bool
) -> Found:
    """Search with workers that stay until the end."""
    from ehl.multigrid.threads import cores

    from ..optimise.search import KeptPool, searched
    from ..runs.kernel_cache import compiled_stamp
    from .batch import kept

    pools: list[KeptPool] = []

    def pool() -> KeptPool:
        if not pools:
            pools.append(KeptPool(workers or cores(), compiled_stamp("run ['None']")))
        return pools[0]

    try:
        with kept(directory), progress_bar(quiet=quiet) as progress:
            return searched(study, directory, pool, resume, progress)
    finally:
        for own in pools:
            own.end()
