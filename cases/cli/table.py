"""Command: table."""

from pathlib import Path
from typing import Annotated

import typer

from ..format.problems import CaseError
from .app import CaseName, Json, Quiet, app
from .output import prepare, report
from .terminal import guarded, progress_bar

TableFile = Annotated[
    Path | None,
    typer.Option("--output", "-o", metavar="FILE", help="The table; default CASE_table.zip."),
]


@app.command()
@guarded
def table(  # noqa: PLR0913
    case: CaseName,
    output: TableFile = None,
    points: Annotated[
        int, typer.Option(metavar="N", help="Nodes of each film along x, 2^k + 1.")
    ] = 257,
    workers: Annotated[
        int | None, typer.Option(min=1, metavar="N", help="Films at a time; default: cores.")
    ] = None,
    temperatures: Annotated[
        str | None,
        typer.Option(
            metavar="C,C,...", help="Temperatures of the oil, rising; default: the case's only."
        ),
    ] = None,
    full_solves: Annotated[
        int,
        typer.Option(
            min=0,
            metavar="N",
            help="Places per race to compare with full solves (shear, heat) that slide.",
        ),
    ] = 0,
    as_json: Json = False,
    quiet: Quiet = False,
) -> int:
    """Tabulate the shear traction of a bearing's contacts over load, speed and sliding; with plots
    beside the file.
    """
    from ..format.case import Case, load_case

    loaded = load_case(case)
    if not isinstance(loaded, Case):
        raise CaseError([f"{case}: is a single contact; a traction table needs a bearing"])
    path = (
        output if output is not None else None if as_json else Path(f"{Path(case).stem}_table.zip")
    )
    if path is not None and (path.is_dir() or not path.parent.is_dir()):
        raise CaseError(
            [f"{path}: cannot be written; allowed with -o: a file in a folder that exists"]
        )
    prepare()
    from ..runs.traction_table import run_table, temperature_axis, with_full_solves

    over = None if temperatures is None else temperature_axis(case, temperatures)
    with progress_bar(quiet=quiet) as progress:
        results = run_table(loaded, points, workers, progress, over)
    from postprocess.traction.results import traction_summary
    from postprocess.traction.table import traction_table
    from postprocess.traction.write import save_tables, write_traction

    if path is not None:
        write_traction(results, path)
    if full_solves:
        with progress_bar(quiet=quiet) as progress:
            results = with_full_solves(results, full_solves, progress)
        if path is not None:
            save_tables(results, path)
    return report(
        traction_summary(results),
        lambda: traction_table(results),
        path,
        as_json=as_json,
        quiet=quiet,
    )
