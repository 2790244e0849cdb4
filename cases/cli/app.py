"""The application `oilfilm` and the options its commands share."""

from pathlib import Path
from typing import Annotated

import typer

from .terminal import print_lines

app = typer.Typer(
    name="oilfilm",
    help="Oil films in every contact of a ball bearing.",
    epilog=(
        "Exit codes: 0 converged, 1 not converged, 2 bad input, 3 interrupted, "
        "4 failure of the machine."
    ),
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    no_args_is_help=True,
)
CaseName = Annotated[
    str,
    typer.Argument(
        metavar="CASE", help="A case file, with or without .toml, or the name of a shipped case."
    ),
]
Output = Annotated[
    Path | None,
    typer.Option("--output", "-o", metavar="DIR", help="Where results go; default: CASE_results."),
]
Json = Annotated[
    bool,
    typer.Option("--json", help="Print the summary as JSON; files are then written with -o only."),
]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="No progress, no table.")]


def _print_version(requested: bool) -> None:
    if requested:
        from ..version import version

        print_lines(f"oilfilm {version()}")
        raise typer.Exit


@app.callback()
def oilfilm(
    _version: Annotated[
        bool,
        typer.Option(
            "--version", callback=_print_version, is_eager=True, help="Print the version."
        ),
    ] = False,
) -> None:
    """Oil films in every contact of a ball bearing."""
