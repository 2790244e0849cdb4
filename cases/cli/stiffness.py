"""Command: stiffness."""

from typing import Annotated

import typer

from ..format.problems import CaseError
from .app import CaseName, Json, Output, Quiet, app
from .output import prepare, report, results_directory, save_with
from .terminal import guarded


@app.command()
@guarded
def stiffness(
    case: CaseName,
    output: Output = None,
    speeds: Annotated[
        tuple[float, float] | None,
        typer.Option(
            metavar="FIRST LAST",
            help="Speeds of the inner ring [r/min]; default: rest to that of the case.",
        ),
    ] = None,
    points: Annotated[
        int, typer.Option(min=2, max=1001, metavar="N", help="Speeds, evenly spaced.")
    ] = 11,
    damping: Annotated[
        float, typer.Option(min=0.0, metavar="C", help="Damping handed to the rotor code [N s/m].")
    ] = 0.0,
    as_json: Json = False,
    quiet: Quiet = False,
) -> int:
    """Stiffness of a bearing over speed, also as a bearing element for the rotor code ROSS."""
    from ..convert.units import RPM
    from ..format.case import Case, load_case

    loaded = load_case(case)
    if not isinstance(loaded, Case):
        raise CaseError([f"{case}: is a single contact; a stiffness needs a bearing"])
    directory = results_directory(case, output, as_json)
    prepare()
    from ..runs.stiffness import run_stiffness

    ends = None if speeds is None else (speeds[0] * RPM, speeds[1] * RPM)
    results = run_stiffness(loaded, case, ends, points, damping)
    from postprocess.stiffness.results import stiffness_summary
    from postprocess.stiffness.table import stiffness_table
    from postprocess.stiffness.write import write_stiffness

    save_with(lambda folder: write_stiffness(results, folder), directory)
    return report(
        stiffness_summary(results),
        lambda: stiffness_table(results),
        directory,
        as_json=as_json,
        quiet=quiet,
    )
