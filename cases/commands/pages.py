"""Commands that tell about results: report."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ..output_directory import add_to_manifest
from ..problems import CaseError
from ..terminal import guarded, say
from .app import app


@app.command()
@guarded
def report(
    directory: Annotated[Path, typer.Argument(metavar="DIR", help="A directory of results.")],
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Nothing but errors.")] = False,
) -> None:
    """Write one self-contained HTML page of results."""
    if not directory.is_dir():
        raise CaseError([f"{directory}: no such directory; allowed: a directory of results"])
    from postprocess.report import write_report

    try:
        path = write_report(directory)
    except ValueError as error:
        raise CaseError([str(error)]) from error
    add_to_manifest(directory, path.name)
    if not quiet:
        say(f"report in {path}")
