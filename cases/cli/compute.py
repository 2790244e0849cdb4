"""Commands that compute a case: run, contact, film, slip, stiffness, temperatures, table."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from enum import StrEnum
from functools import partial
from pathlib import Path
from shutil import rmtree
from typing import TYPE_CHECKING, Annotated

import typer

from ..format.rules import CaseError
from ..runs.interrupt import print_message
from ..runs.kernel_cache import compiled_ahead
from . import terminal
from .output import (
    film_seconds,
    load_bearing,
    lock_output_file,
    report,
    report_cost,
    results_directory,
    run_cost,
    save,
    save_with,
    slip_cost,
    table_cost,
    temperatures_cost,
)

if TYPE_CHECKING:
    from oilfilm.ehl.traction_table.build import FilmSampler

TableFile = Annotated[
    Path | None,
    typer.Option("--output", "-o", metavar="FILE", help="The table; default: CASE_table.zip."),
]
Ross = Annotated[bool, typer.Option("--ross", help="Print the lines for the rotor code ROSS.")]


class Method(StrEnum):
    """Discretisation of the contact solver."""

    MULTIGRID = "multigrid"
    FINITE_ELEMENT = "finite-element"


@terminal.command()
def run(
    case: terminal.CaseName,
    output: terminal.Output = None,
    workers: Annotated[
        int | None, typer.Option(min=1, metavar="N", help="Contacts at a time; default: cores.")
    ] = None,
    as_json: terminal.Json = False,
    quiet: terminal.Quiet = False,
    notes: terminal.Notes = False,
) -> int:
    """Run a bearing case: loads, film maps, pictures, VTK."""
    terminal.enter_context(compiled_ahead("bearing"))
    from ..runs.drawing import drawing_processes

    with drawing_processes(ahead=output is not None or not as_json) as drawing:
        loaded = load_bearing(case, f"run it with 'oilfilm contact {case}'", heated=False)
        directory = results_directory(case, output, as_json)
        from oilfilm.ehl.multigrid.threads import cores
        from oilfilm.postprocess import summary
        from oilfilm.postprocess.bearing.write import bearing_table

        from ..runs.bearing import Interrupted, run_case
        from ..runs.measured import with_measured

        report_cost(run_cost(loaded, workers or cores()), quiet=quiet)
        try:
            with terminal.progress_bar(quiet=quiet) as progress:
                results = run_case(
                    loaded, workers, progress, on_films_solved=drawing.films if directory else None
                )
                results = with_measured(results, loaded, progress)
                save(results, directory, drawing, progress)
        except Interrupted as stop:
            if stop.results is not None and directory is not None:
                target = Path(f"{directory}_interrupted") if directory.exists() else directory
                drawing.stop()
                save(stop.results, target, drawing)
                print_message(f"finished films in {target}")
            raise KeyboardInterrupt from None
    return report(
        summary(results), lambda: bearing_table(results), directory, as_json, quiet, notes
    )


@terminal.command()
def contact(
    case: terminal.CaseName,
    output: terminal.Output = None,
    method: Annotated[Method, typer.Option(help="Discretisation.")] = Method.MULTIGRID,
    as_json: terminal.Json = False,
    quiet: terminal.Quiet = False,
    notes: terminal.Notes = False,
) -> int:
    """Solve one lubricated contact from a [contact] table."""
    from ..runs.drawing import drawing_processes

    with drawing_processes(ahead=output is not None or not as_json) as drawing:
        from ..format.case import ContactCase, load_case

        loaded = load_case(case)
        if not isinstance(loaded, ContactCase):
            raise CaseError(f"{case}: is a bearing; run it with 'oilfilm run {case}'")
        directory = results_directory(case, output, as_json)
        from oilfilm.ehl.multigrid.threads import cores
        from oilfilm.postprocess import summary
        from oilfilm.postprocess.contact.write import contact_table

        from ..runs.contact import run_contact

        elements = method is Method.FINITE_ELEMENT
        film = f"one film on at most {loaded.solver.max_points} nodes"
        report_cost((film, film_seconds(loaded.solver)), quiet=quiet)
        with terminal.progress_bar(quiet=quiet) as progress:
            progress(0, 1, "film")
            results = run_contact(loaded, finite_element=elements, workers=cores())
            save(results, directory, drawing, progress)
    return report(
        summary(results), lambda: contact_table(results), directory, as_json, quiet, notes
    )


@terminal.command()
def film(
    case: terminal.CaseName,
    as_json: terminal.Json = False,
    quiet: terminal.Quiet = False,
    notes: terminal.Notes = False,
) -> int:
    """Films of a contact, or of each contact of a bearing, by the film atlas, without a solve."""
    from ..format.case import ContactCase, load_case

    loaded = load_case(case)
    if isinstance(loaded, ContactCase):
        from oilfilm.postprocess.contact.atlas import atlas_contact_summary, atlas_contact_table

        from ..runs.atlas_contact import run_atlas_contact

        own = run_atlas_contact(loaded, case)
        document = atlas_contact_summary(own)
        return report(document, lambda: atlas_contact_table(own), None, as_json, quiet, notes)
    from oilfilm.postprocess.bearing.atlas import atlas_bearing_summary, atlas_bearing_table

    from ..runs.atlas import run_atlas_bearing
    from ..runs.heating import with_temperature

    found = run_atlas_bearing(with_temperature(loaded), case)
    document = atlas_bearing_summary(found)
    return report(document, lambda: atlas_bearing_table(found), None, as_json, quiet, notes)


@terminal.command()
def slip(
    case: terminal.CaseName,
    output: terminal.Output = None,
    workers: Annotated[
        int | None, typer.Option(min=1, metavar="N", help="Processes; default: cores.")
    ] = None,
    as_json: terminal.Json = False,
    quiet: terminal.Quiet = False,
    notes: terminal.Notes = False,
) -> int:
    """Map gross slip of the balls after Hirano, and the minimum preload, from a [slip] table."""
    loaded = load_bearing(case, "slip maps need a bearing")
    directory = results_directory(case, output, as_json)
    from oilfilm.ehl.multigrid.threads import cores

    from ..runs.stiffness_and_slip import run_slip

    report_cost(slip_cost(loaded, workers or cores()), quiet=quiet)
    try:
        with terminal.progress_bar(quiet=quiet) as progress:
            results = run_slip(loaded, case, workers, progress)
    except KeyboardInterrupt:
        print_message("oilfilm: of unfinished slip maps nothing is kept")
        raise
    from oilfilm.postprocess.slip.results import slip_summary
    from oilfilm.postprocess.slip.write import slip_table, write_slip

    save_with(lambda folder: write_slip(results, folder), directory)
    document = slip_summary(results)
    return report(document, lambda: slip_table(results), directory, as_json, quiet, notes)


@terminal.command()
def stiffness(
    case: terminal.CaseName,
    output: terminal.Output = None,
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
        float | None,
        typer.Option(
            min=0.0, metavar="C", help="Damping for the rotor code [N s/m]; default: by the films."
        ),
    ] = None,
    ross: Ross = False,
    as_json: terminal.Json = False,
    quiet: terminal.Quiet = False,
    notes: terminal.Notes = False,
) -> int:
    """Stiffness of a bearing over speed, also as a bearing element for the rotor code ROSS."""
    from oilfilm.ehl.units import RPM

    loaded = load_bearing(case, "a stiffness needs a bearing")
    directory = results_directory(case, output, as_json)
    from ..runs.stiffness_and_slip import run_stiffness

    ends = None if speeds is None else (speeds[0] * RPM, speeds[1] * RPM)
    with terminal.progress_bar(quiet=quiet) as progress:
        results = run_stiffness(loaded, case, ends, points, damping, progress)
    from oilfilm.postprocess.stiffness.results import ross_lines, stiffness_summary
    from oilfilm.postprocess.stiffness.write import stiffness_table, write_stiffness

    save_with(lambda folder: write_stiffness(results, folder), directory)
    document = stiffness_summary(results)
    if ross and not as_json:
        typer.echo(ross_lines(results.study, damping, loaded.title))
    return report(document, lambda: stiffness_table(results), directory, as_json, quiet, notes)


@terminal.command()
def shaft(
    case: terminal.CaseName,
    output: terminal.Output = None,
    ross: Ross = False,
    as_json: terminal.Json = False,
    quiet: terminal.Quiet = False,
    notes: terminal.Notes = False,
) -> int:
    """A shaft on its bearings: loads, deflection, each bearing's results, critical speeds."""
    terminal.enter_context(compiled_ahead("bearing"))
    from ..format.shaft_case import load_shaft

    loaded = load_shaft(case)
    directory = results_directory(case, output, as_json)
    from ..runs.interrupt import interruptible
    from ..runs.shaft import run_shaft

    with terminal.progress_bar(quiet=quiet) as progress:
        results = interruptible(partial(run_shaft, loaded, progress))
    from oilfilm.postprocess.scene.vtk import write_shaft_collection
    from oilfilm.postprocess.shaft.results import shaft_summary
    from oilfilm.postprocess.shaft.write import shaft_table, write_shaft

    save_with(lambda folder: write_shaft(results, folder, write_shaft_collection), directory)
    document = shaft_summary(results)
    if ross and results.vibration is None:
        print_message("oilfilm: --ross: the shaft has no equilibrium about which it vibrates")
    elif ross and not as_json:
        from oilfilm.postprocess.shaft.ross import ross_rotor

        typer.echo(ross_rotor(results))
    return report(document, lambda: shaft_table(results), directory, as_json, quiet, notes)


@terminal.command()
def temperatures(
    case: terminal.CaseName,
    output: terminal.Output = None,
    hours: Annotated[
        float | None,
        typer.Option(
            min=1e-4,
            max=1000.0,
            metavar="H",
            help="Of the course from the start; default: five times the longest time constant.",
        ),
    ] = None,
    as_json: terminal.Json = False,
    quiet: terminal.Quiet = False,
    notes: terminal.Notes = False,
) -> int:
    """Temperatures of a bearing over its speed, up to the limit, and over time from the start."""
    from ..runs.interrupt import interruptible

    loaded = load_bearing(case, "temperatures need a bearing", heated=False)
    directory = results_directory(case, output, as_json)
    from ..runs import temperatures as study

    report_cost(temperatures_cost(loaded), quiet=quiet)
    duration = None if hours is None else 3600.0 * hours
    with terminal.progress_bar(quiet=quiet) as progress:
        results = interruptible(partial(study.temperatures, loaded, case, duration, progress))
    from oilfilm.postprocess.temperatures.results import temperatures_summary
    from oilfilm.postprocess.temperatures.write import temperatures_table, write_temperatures

    save_with(lambda folder: write_temperatures(results, folder), directory)
    document = temperatures_summary(results)
    return report(document, lambda: temperatures_table(document), directory, as_json, quiet, notes)


@terminal.command()
def table(
    case: terminal.CaseName,
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
    tolerance: Annotated[
        float,
        typer.Option(
            metavar="SHARE", help="Largest error of the force; 0.05: a coarse, quick, small table."
        ),
    ] = 0.01,
    loads: Annotated[
        str | None, typer.Option(metavar="N,N", help="Range of loads; default: the case's.")
    ] = None,
    speeds: Annotated[
        str | None,
        typer.Option(metavar="M/S,M/S", help="Of entrainment speeds; default: the case's."),
    ] = None,
    full_solves: Annotated[
        int,
        typer.Option(
            min=0,
            metavar="N",
            help="Places per race to compare with full solves (shear, heat) that slide.",
        ),
    ] = 0,
    as_json: terminal.Json = False,
    quiet: terminal.Quiet = False,
    notes: terminal.Notes = False,
) -> int:
    """Tabulate shear traction of a bearing's contacts over load, speed and sliding."""
    loaded = load_bearing(case, "a traction table needs a bearing", own_table=False)
    path = output
    if output is None and not as_json:
        path = Path(f"{Path(case).stem}_table.zip")
    if path is not None and (path.is_dir() or not path.parent.is_dir()):
        raise CaseError(
            f"{path}: cannot be written; allowed with -o: a file in a folder that exists"
        )
    if path is not None:
        lock_output_file(path)
    from oilfilm.ehl.multigrid.threads import cores

    from ..runs import traction_table as runs

    over = None if temperatures is None else runs.temperature_axis(case, temperatures)
    wish = runs.TableWish(tolerance, runs.span("--loads", loads), runs.span("--speeds", speeds))
    count = 1 if over is None else len(over.temperatures)
    atlas = loaded.file.friction.table_films == "atlas"
    cost = table_cost(points, count, workers or cores(), atlas=atlas)
    report_cost(cost, quiet=quiet)
    from oilfilm.postprocess.traction.results import traction_summary
    from oilfilm.postprocess.traction.write import save_tables, traction_table, write_traction

    with _film_sampler(path) as sample:
        with terminal.progress_bar(quiet=quiet) as progress:
            results = runs.run_table(loaded, points, workers, progress, over, sample, wish)
        if path is not None:
            write_traction(results, path)
    if full_solves:
        with terminal.progress_bar(quiet=quiet) as progress:
            results = runs.with_full_solves(results, full_solves, progress)
        if path is not None:
            save_tables(results, path)
    document = traction_summary(results)
    return report(document, lambda: traction_table(results), path, as_json, quiet, notes)


@contextmanager
def _film_sampler(path: Path | None) -> Iterator[FilmSampler]:
    """Solves films and keeps them beside the table until that is complete."""
    from oilfilm.ehl.traction_table.film import film_sample

    from ..batch.shared_tables import stored_film_sampler

    if path is None:
        yield film_sample
        return
    folder = path.with_name(f"{path.stem}_films")
    try:
        yield stored_film_sampler(folder)
    except (KeyboardInterrupt, OSError) as stop:
        with suppress(OSError):
            folder.rmdir()  # without a film
        if folder.exists():
            room = "make room, then " * isinstance(stop, OSError)
            print_message(
                f"finished films are kept in {folder}; {room}the same command goes on with them"
            )
        raise
    rmtree(folder, ignore_errors=True)
