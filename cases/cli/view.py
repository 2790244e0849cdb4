"""Commands that look at results: view."""

from dataclasses import replace
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from ..format.problems import CaseError
from ..runs.interrupt import print_message
from .app import app
from .output import lock_output_file
from .progress import progress_bar
from .reading import reading
from .terminal import FAILED, guarded


class Quantity(StrEnum):
    """Quantities that the colours of the view show."""

    FILM = "film"
    PRESSURE = "pressure"
    DISPLACEMENT = "displacement"


@app.command()
@guarded
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
) -> int:
    """Look at results in three dimensions."""
    if not directory.is_dir():
        raise CaseError(
            f"{directory}: no such directory; allowed: a directory of results of 'oilfilm run'"
        )
    for file in (screenshot, html, movie):
        if file is not None:
            lock_output_file(file)
    from postprocess.scene import scene

    factors = None if magnification is None else (magnification, magnification)
    options = scene.SceneOptions(
        quantity=quantity.value, magnification=factors, film_exaggeration=exaggeration
    )
    try:
        with reading(directory), progress_bar(quiet=False) as progress:
            if screenshot is not None:
                progress(0, 1, f"drawing {screenshot}")
                print_message(f"picture in {scene.screenshot(directory, screenshot, options)}")
            if html is not None:
                progress(0, 1, f"drawing {html}")
                print_message(f"page in {scene.export_html(directory, html, options)}")
            if movie is not None:
                progress(0, 1, f"drawing {movie}")
                small = replace(options, size=scene.MOVIE_SIZE)
                print_message(f"movie in {scene.movie(directory, movie, small)}")
        if screenshot is None and html is None and movie is None:
            with reading(directory):
                scene.show(directory, options)
    except CaseError:
        raise
    except scene.RenderingError as error:
        print_message(f"oilfilm: {error}")
        return FAILED
    return 0
