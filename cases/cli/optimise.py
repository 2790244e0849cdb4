"""Commands that search: optimise, calibrate."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..format.rules import CaseError
from ..runs.interrupt import finish_first, print_message
from .batch import Workers
from .output import lock_output_directory, lock_output_file, report, report_cost
from .terminal import (
    NOT_CONVERGED,
    CaseName,
    Json,
    Notes,
    Output,
    Quiet,
    command,
    enter_context,
    print_json,
    print_table,
    progress_bar,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rich.console import Group
    from rich.table import Table

    from ..optimise.study import Design, OptimisationResult, Study
    from ..runs.measured import Calibration

MOST_SHOWN = 4  # designs of a front in the terminal


@command()
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
    notes: Notes = False,
) -> int:
    """Search the keys of a case for the best designs within limits."""
    from ..format.shipped import find_optimisation
    from ..optimise.study import read_study

    study = read_study(find_optimisation(file))
    try:
        import sklearn  # noqa: F401
    except ImportError:
        needed = "pip install 'oilfilm[optimise]'"
        raise CaseError(f"optimise: needs the package scikit-learn: {needed}") from None
    from ..optimise.results import write_optimisation

    keep = output is not None or resume or not as_json
    directory = (
        lock_output_directory(output or Path(f"{Path(file).stem}_results")) if keep else _scratch()
    )
    found = _found(study, directory, workers, resume=resume, quiet=quiet)
    with finish_first(f"results in {directory}"):
        document = write_optimisation(found, directory)
    table = lambda: optimisation_table(found)  # noqa: E731
    return report(document, table, directory if keep else None, as_json, quiet, notes)


@command()
def calibrate(
    case: CaseName,
    measured: Annotated[
        Path, typer.Argument(metavar="MEASURED", help="Table over speed, load, temperature.")
    ],
    keys: Annotated[
        str, typer.Option(metavar="K1,K2", help="Keys to fit; KEY=LOW:HIGH sets an interval.")
    ],
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", metavar="FILE", help="A .toml of the fit, or a picture."),
    ] = None,
    as_json: Json = False,
    quiet: Quiet = False,
) -> int:
    """Fit keys of a case to measured torque, film or temperature, each within its interval."""
    from ..format.shipped import find_case
    from ..runs.measured import calibrate as fitted

    file = None if output is None else lock_output_file(output)
    names = [key.strip() for key in keys.split(",") if key.strip()]
    with progress_bar(quiet=quiet) as progress:
        announce = partial(report_cost, quiet=quiet)
        found = fitted(find_case(case), measured, names, progress, announce)
    with finish_first("the fit"):
        _write_fit(found, file, as_json=as_json, quiet=quiet)
    if found.interrupted:
        raise KeyboardInterrupt
    return 0 if found.converged else NOT_CONVERGED


def _write_fit(found: Calibration, file: Path | None, *, as_json: bool, quiet: bool) -> None:
    """The fit in the terminal and in a file."""
    from oilfilm.postprocess.bearing.plots import draw_measured
    from oilfilm.postprocess.plot_style import write_figure

    from ..runs.measured import calibration_document

    if as_json:
        print_json(calibration_document(found))
    elif not quiet:
        print_table(calibration_table(found))
    if file is not None and file.suffix == ".toml":
        file.write_text(found.text, encoding="utf-8", newline="\n")
        print_message(f"fitted case in {file}")
    elif file is not None:
        write_figure(file, lambda figure: draw_measured(figure, found.after))
        print_message(f"picture in {file}")


def calibration_table(found: Calibration) -> Group:
    """The fitted keys, what is left of the residuals, and what the fit leaves open.

    Parameters
    ----------
    found : Calibration
        The fit.

    Returns
    -------
    Group
        The table.
    """
    from rich.console import Group
    from rich.text import Text

    from oilfilm.postprocess.bearing.measured import residual_lines

    parts: list[Any] = [Text("fit, each key within its interval", style="bold")]
    for one, value, deviation in zip(found.keys, found.values, found.deviations, strict=True):
        error = "" if deviation is None else f" +- {deviation:.2g} (standard deviation)"
        parts.append(Text(f"{one.key}: {one.start:.4g} before, {value:.4g}{error}"))
        parts.append(Text(f"  interval {one.low:.4g} to {one.high:.4g}, {one.origin}"))
    parts.append(
        Text(f"relative rms residual {found.start_error:.2%} before, {found.fit_error:.2%} after")
    )
    parts += [Text(line) for line in residual_lines(found.after.residuals())]
    parts += [Text(line) for line in found.messages]
    return Group(*parts)


def _scratch() -> Path:
    from ..runs.output_directory import scratch_folder

    return enter_context(scratch_folder())


def _found(
    study: Study, directory: Path, workers: int | None, *, resume: bool, quiet: bool
) -> OptimisationResult:
    """Search with workers that stay until the end."""
    from oilfilm.ehl.multigrid.threads import cores

    from ..optimise.search import PersistentPool, search_designs
    from ..runs.kernel_cache import compiled_stamp
    from .batch import report_stored_points

    pools: list[PersistentPool] = []

    def pool() -> PersistentPool:
        if not pools:
            pools.append(PersistentPool(workers or cores(), compiled_stamp("run ['None']")))
        return pools[0]

    try:
        with report_stored_points(directory), progress_bar(quiet=quiet) as progress:
            return search_designs(study, directory, pool, resume, progress)
    finally:
        for own in pools:
            own.end()


def optimisation_table(found: OptimisationResult) -> Group:
    """The front, or the best design, and its confirmation, for a terminal of 80 columns.

    Parameters
    ----------
    found : OptimisationResult
        Result of the optimisation.

    Returns
    -------
    Group
        The table.
    """
    from rich.console import Group
    from rich.text import Text

    from oilfilm.postprocess.quantities import evenly_chosen

    from ..optimise.search import confirmation_messages, improvement

    study = found.study
    names = list(dict.fromkeys([n for n, _ in study.goals] + [one.name for one in study.limits]))
    front = [found.designs[number - 1] for number in found.front]
    chosen = [front[k] for k in evenly_chosen(len(front), MOST_SHOWN)] if front else []
    columns = {f"design {design.number}": design for design in chosen}
    if study.position_of_case() is not None:
        columns = {"case": found.designs[0]} | columns
    parts: list[Any] = [Text(study.title, style="bold"), _columns(columns, study.keys, names)]
    if len(front) > len(chosen):
        parts.append(f"{len(chosen)} of the {len(front)} designs of the front")
    if found.confirmed:
        parts += ["proof:", _columns(dict(found.confirmed), (), names)]
    gain = improvement(found)
    if gain is not None:
        parts.append(_gain(gain))
    parts += confirmation_messages(found)
    return Group(*parts)


def _gain(gain: dict[str, Any]) -> str:
    """The improvement and its error, in words."""
    shown = f"{gain['goal']}: {gain['case']:.4g} to {gain['best']:.4g} by {gain['design']}"
    if gain["error"] is None:
        return shown
    word = "more" if gain["proved"] else "not more"
    return f"{shown}, {word} than the error of the difference ({gain['error']:.2g})"


def _columns(designs: dict[str, Design], keys: Sequence[str], names: Sequence[str]) -> Table:
    """Designs side by side: values of the keys, then goals and constraints."""
    from oilfilm.postprocess.quantities import number, number_table

    own = list(designs.values())
    rows = [[_words(key), *(number(one.values[key], ".5g") for one in own)] for key in keys]
    rows += [[_words(name), *(number(one.numbers[name], ".4g") for one in own)] for name in names]
    return number_table(["", *designs], rows, [""])


def _words(name: str) -> str:
    from oilfilm.ehl.units import unit_symbol, without_unit

    last = name.rpartition(".")[2]
    return f"{without_unit(last)} {unit_symbol(last)}".strip()
