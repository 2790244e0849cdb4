"""Commands on results: report, compare, cut, interferogram, diagram, export, view."""

from dataclasses import replace
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from ..format.rules import CaseError
from ..runs.interrupt import print_message
from . import terminal
from .output import lock_output_directory, lock_output_file

Directory = Annotated[Path, typer.Argument(metavar="DIR", help="A directory of results.")]
AsJson = Annotated[bool, typer.Option("--json", help="Print the files written as JSON.")]
Contact = Annotated[
    str | None,
    typer.Option(metavar="NAME", help="For example ball01/inner; default: the first with a film."),
]

# formats of `export` that are no meshes
DOCUMENTS = {"xlsx": "workbook", "pdf": "pages", "fmu": "unit", "rexs": "model"}
FORMATS = ("xdmf", "inp", "msh", "vtu", *DOCUMENTS)


class Axis(StrEnum):
    """Directions of a cut."""

    X = "x"
    Y = "y"


def _tell(files: dict[Path, str], *, as_json: bool, quiet: bool) -> None:
    """Name the files written, each with its kind."""
    if as_json:
        terminal.print_json({"files": [str(file) for file in files]})
    for file, kind in {} if as_json or quiet else files.items():
        print_message(f"{kind} in {file}")


@terminal.command()
def report(directory: Directory, as_json: AsJson = False, quiet: terminal.Errors = False) -> None:
    """Write one self-contained HTML page of results."""
    from oilfilm.postprocess.report.page import write_report

    with terminal.reading(directory):
        path = write_report(lock_output_directory(directory))
    from ..runs.output_directory import add_to_manifest

    add_to_manifest(directory, path.name)
    _tell({path: "report"}, as_json=as_json, quiet=quiet)


@terminal.command()
def compare(
    first: Annotated[
        Path, typer.Argument(metavar="DIR", help="A directory of results; with a table, a case.")
    ],
    second: Annotated[
        Path, typer.Argument(metavar="DIR|FILE", help="Another one, or a measured table.")
    ],
    within: Annotated[
        float | None,
        typer.Option(
            min=0.0, metavar="X", help="Exit code 1 if a result differs by more, relative."
        ),
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", metavar="FILE.png", help="Picture, of a measured table."),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
    quiet: terminal.Errors = False,
) -> int:
    """Compare two results, or results or a case with a measured table."""
    if second.is_file():
        return _compare_measured(first, second, within, output, as_json=as_json, quiet=quiet)
    if not second.exists():
        allowed = "allowed: a measured table, or a directory of results"
        raise CaseError(f"{second}: no such file; {allowed}")
    if output is not None:
        raise CaseError("--output: allowed with a measured table")
    from oilfilm.postprocess.compare import compare as compared

    with terminal.reading(first, second):
        comparison = compared(first, second)
    if as_json:
        terminal.print_json(comparison.document())
    elif not quiet:
        from oilfilm.postprocess.compare import comparison_table

        terminal.print_table(comparison_table(comparison))
    for name, converged in zip(comparison.names, comparison.converged, strict=True):
        if not converged:
            print_message(f"oilfilm: {name}: not converged")
    differs = within is not None and comparison.largest > within
    if differs:
        print_message(
            f"oilfilm: a result differs by more than {within:g}: {comparison.largest:.3g}"
        )
    return terminal.NOT_CONVERGED if differs or not all(comparison.converged) else 0


def _compare_measured(
    source: Path,
    file: Path,
    within: float | None,
    output: Path | None,
    *,
    as_json: bool,
    quiet: bool,
) -> int:
    """Measured beside computed: of a case in the measured states, or of `oilfilm temperatures`."""
    from ..runs.measured import compare_with

    picture = None if output is None else lock_output_file(output)
    with terminal.progress_bar(quiet=quiet) as progress:
        comparison = compare_with(source, file, progress)
    from oilfilm.postprocess.bearing.measured import measured_table
    from oilfilm.postprocess.bearing.plots import draw_measured
    from oilfilm.postprocess.plot_style import write_figure

    if as_json:
        terminal.print_json(comparison.document())
    elif not quiet:
        terminal.print_table(measured_table(comparison))
    for message in () if quiet else comparison.messages:
        print_message(message)
    if picture is not None:
        write_figure(picture, lambda figure: draw_measured(figure, comparison))
        print_message(f"picture in {picture}")
    wide = within is not None and comparison.largest_relative > within
    if wide:
        print_message(
            f"oilfilm: the rms residual is more than {within:g} of what is measured: "
            f"{comparison.largest_relative:.3g}"
        )
    return terminal.NOT_CONVERGED if wide or not comparison.converged else 0


@terminal.command()
def cut(
    directory: Directory,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="FILE.csv", help="Default: cut.csv.")
    ] = None,
    contact: Contact = None,
    axis: Annotated[Axis, typer.Option(help="Direction of the line.")] = Axis.X,
    at: Annotated[
        float,
        typer.Option(metavar="X", help="Where it crosses the other axis, in Hertz semi-axes."),
    ] = 0.0,
    as_json: AsJson = False,
    quiet: terminal.Errors = False,
) -> None:
    """Write film and pressure along a line through a contact as CSV."""
    from oilfilm.postprocess.contact.plots import write_line_cut

    with terminal.reading(directory):
        file = lock_output_file(output or Path("cut.csv"))
        written = write_line_cut(directory, file, contact, axis.value, at)
    _tell({written: "table"}, as_json=as_json, quiet=quiet)


@terminal.command()
def interferogram(
    directory: Directory,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", metavar="FILE.png", help="Default: interferogram.png."),
    ] = None,
    contact: Contact = None,
    wavelength: Annotated[
        list[float] | None,
        typer.Option(
            "--wavelength-nm", metavar="X", help="In vacuum; three times for red, green, blue."
        ),
    ] = None,
    index: Annotated[
        float, typer.Option("--refractive-index", metavar="X", help="Of the oil.")
    ] = 1.5,
    as_json: AsJson = False,
    quiet: terminal.Errors = False,
) -> None:
    """Draw the film of a contact as an optical interferometer would see it."""
    from oilfilm.ehl.units import NANOMETRE
    from oilfilm.postprocess.contact.plots import SODIUM, Optics, write_interferogram

    with terminal.reading(directory):
        lengths = tuple(value * NANOMETRE for value in wavelength) if wavelength else (SODIUM,)
        optics = Optics(wavelengths=lengths, refractive_index=index)
        file = lock_output_file(output or Path("interferogram.png"))
        written = write_interferogram(directory, file, contact, optics)
    _tell({written: "picture"}, as_json=as_json, quiet=quiet)


@terminal.command()
def diagram(
    directory: Annotated[
        Path, typer.Argument(metavar="DIR", help="A directory of results of 'oilfilm batch'.")
    ],
    output: Annotated[
        Path | None,
        typer.Option(
            "--output", "-o", metavar="FILE", help="PNG, PDF or SVG; default: diagram.png."
        ),
    ] = None,
    over: Annotated[
        list[str] | None,
        typer.Option(
            metavar="KEY", help="A varied key; three times for axis, colours, styles of line."
        ),
    ] = None,
    of: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME", help="A column of batch.csv; default: film, torque, life."),
    ] = None,
    as_json: AsJson = False,
    quiet: terminal.Errors = False,
) -> None:
    """Draw numbers of a batch over its keys: film, torque and life over speed, a line per load."""
    from oilfilm.postprocess.batch.plots import write_diagram
    from oilfilm.postprocess.batch.store import read_batch

    with terminal.reading(directory):
        file = lock_output_file(output or Path("diagram.png"))
        written = write_diagram(read_batch(directory), file, tuple(over or ()), tuple(of or ()))
    _tell({written: "picture"}, as_json=as_json, quiet=quiet)


@terminal.command()
def export(
    directory: Directory,
    file_format: Annotated[
        str,
        typer.Option(
            "--format",
            metavar=f"[{'|'.join(FORMATS)}]",
            help="Meshes; workbook; pages; table of a batch for co-simulation; drive.",
        ),
    ],
    output: Annotated[
        Path | None,
        typer.Option(
            "--output", "-o", metavar="FILE", help="Default: films.FORMAT; DIR.FORMAT for others."
        ),
    ] = None,
    model: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="The drive in REXS; default: that of the case."),
    ] = None,
    fmi: Annotated[int, typer.Option(min=2, max=3, help="Version of FMI, for fmu.")] = 2,
    as_json: AsJson = False,
    quiet: terminal.Errors = False,
) -> None:
    """Write films as meshes, numbers as a workbook or a PDF, a batch as an FMU, or results into
    the drive in REXS that the case came from.
    """
    if file_format not in FORMATS:
        raise CaseError(f"--format {file_format}: unknown; allowed: {', '.join(FORMATS)}")
    stem = f"{directory.resolve().name}" if file_format in DOCUMENTS else "films"
    file = output or Path(f"{stem}.{file_format}")
    if file.suffix.lower() != f".{file_format}":
        raise CaseError(f"--output {file}: allowed: a .{file_format} file, as --format says")
    with terminal.reading(directory):
        lock_output_file(file)
        files = _write_document(
            directory, file, file_format, model=model, fmi=fmi, quiet=quiet or as_json
        ) or _write_meshes(directory, file)
    kinds = ("mesh" if path.suffix == file.suffix else "values" for path in files)
    told = {
        path: DOCUMENTS.get(file_format, kind) for path, kind in zip(files, kinds, strict=True)
    }
    _tell(told, as_json=as_json, quiet=quiet)


def _write_document(
    directory: Path, file: Path, kind: str, *, model: Path | None, fmi: int, quiet: bool
) -> tuple[Path, ...]:
    """Write a workbook, a PDF, an FMU or a drive; nothing for another kind."""
    lines: tuple[str, ...] = ()
    if kind == "xlsx":
        from oilfilm.postprocess.report.pdf_and_workbook import write_workbook

        return (write_workbook(directory, file),)
    if kind == "pdf":
        from oilfilm.postprocess.report.pdf_and_workbook import write_pdf

        return (write_pdf(directory, file),)
    if kind == "fmu":
        from oilfilm.postprocess.batch.store import read_batch
        from oilfilm.postprocess.fmu.export import write_fmu

        lines = write_fmu(read_batch(directory), file, fmi)
    elif kind == "rexs":
        from ..rexs_results import write_results

        count = write_results(directory, file, model)
        lines = (f"results of {count} bearing{'s' if count > 1 else ''} written",)
    if not quiet:
        for line in lines:
            print_message(line)
    return (file,) if lines else ()


def _write_meshes(directory: Path, file: Path) -> tuple[Path, ...]:
    from ..runs.export import export_meshes

    return export_meshes(directory, file)


class Quantity(StrEnum):
    """Quantities that the colours of the view show."""

    FILM = "film"
    PRESSURE = "pressure"
    DISPLACEMENT = "displacement"


@terminal.command()
def view(
    directory: Annotated[Path, typer.Argument(metavar="DIR", help="A directory of results.")],
    screenshot: Annotated[
        Path | None, typer.Option(metavar="FILE.png", help="Write a picture, open no window.")
    ] = None,
    html: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.html", help="Write a page to turn in a browser, open no window."
        ),
    ] = None,
    movie: Annotated[
        Path | None, typer.Option(metavar="FILE.gif", help="Write one turn, open no window.")
    ] = None,
    quantity: Annotated[Quantity, typer.Option(help="What the colours show.")] = Quantity.FILM,
    magnification: Annotated[
        float | None,
        typer.Option(min=1.0, max=1e3, help="Scale of the patches; default: so that they show."),
    ] = None,
    exaggeration: Annotated[
        float, typer.Option(min=0.0, max=1e6, help="Factor of film height or displacement.")
    ] = 0.0,
    as_json: AsJson = False,
    quiet: terminal.Errors = False,
) -> int:
    """Look at results in three dimensions."""
    if not directory.is_dir():
        raise CaseError(
            f"{directory}: no such directory; allowed: a directory of results of 'oilfilm run'"
        )
    for wanted in filter(None, (screenshot, html, movie)):
        lock_output_file(wanted)
    from oilfilm.postprocess.scene import scene

    factors = None if magnification is None else (magnification, magnification)
    options = scene.SceneOptions(
        quantity=quantity.value, magnification=factors, film_exaggeration=exaggeration
    )
    drawings = (
        ("picture", scene.screenshot, screenshot, options),
        ("page", scene.export_html, html, options),
        ("movie", scene.movie, movie, replace(options, size=scene.MOVIE_SIZE)),
    )
    drawn: dict[Path, str] = {}
    try:
        with terminal.reading(directory), terminal.progress_bar(quiet=quiet) as progress:
            for kind, draw, file, choice in drawings:
                if file is not None:
                    progress(0, 1, f"drawing {file}")
                    drawn[draw(directory, file, choice)] = kind
        if not drawn:
            with terminal.reading(directory):
                scene.view(directory, options)
    except CaseError:
        raise
    except scene.RenderingError as error:
        _tell(drawn, as_json=False, quiet=quiet or as_json)  # those before
        print_message(f"oilfilm: {error}")
        return terminal.FAILED
    _tell(drawn, as_json=as_json, quiet=quiet)
    return 0
