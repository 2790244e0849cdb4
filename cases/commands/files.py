"""Commands about case files and libraries: list, validate, init, schema."""

from __future__ import annotations

import json
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from ..problems import CaseError
from ..terminal import BAD_INPUT, guarded, print_lines, say
from .app import app


class Listing(StrEnum):
    """What `oilfilm list` shows."""

    CASES = "cases"
    BEARINGS = "bearings"
    MATERIALS = "materials"
    LUBRICANTS = "lubricants"


@app.command("list")
@guarded
def list_names(
    what: Annotated[Listing | None, typer.Argument(help="What to list; all if left out.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
) -> None:
    """List shipped cases, bearings, materials and lubricants."""
    from ..listing import listing

    names = {kind.value: listing(kind.value) for kind in (Listing if what is None else (what,))}
    if as_json:
        print_lines(json.dumps(names, indent=2, ensure_ascii=False))
        return
    width = max(len(name) for entries in names.values() for name in entries)
    for kind, entries in names.items():
        if what is None:
            print_lines(f"{kind}:")
        indent = "  " if what is None else ""
        for name, remark in entries.items():
            print_lines(f"{indent}{name:{width}}  {remark}".rstrip())


@app.command()
@guarded
def validate(
    cases: Annotated[list[str], typer.Argument(metavar="CASE...", help="Case files or names of shipped cases.")],
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Nothing but errors.")] = False,
) -> int:
    """Check case files without running them."""
    from ..case import read_text, validate_text
    from ..shipped import find_case

    errors: dict[str, list[str]] = {}
    for case in cases:
        try:
            path = find_case(case)
            validate_text(read_text(path), str(path))
            errors[case] = []
        except CaseError as error:
            errors[case] = list(error.messages)
    if as_json:
        report = {case: {"valid": not messages, "errors": messages} for case, messages in errors.items()}
        print_lines(json.dumps(report, indent=2, ensure_ascii=False))
    else:
        for case, messages in errors.items():
            if not messages and not quiet:
                print_lines(f"{case}: valid")
            for message in messages:
                say(message)
    return BAD_INPUT if any(errors.values()) else 0


@app.command()
@guarded
def init(
    name: Annotated[str, typer.Argument(metavar="NAME", help="Name of the new case file.")],
    template: Annotated[
        str, typer.Option("--from", metavar="CASE", help="The case to start from.")
    ] = "6208_full_ceramic",
) -> None:
    """Write a new case file to start from."""
    from ..case import read_text
    from ..shipped import find_case

    path = Path(name if name.endswith(".toml") else f"{name}.toml")
    text = read_text(find_case(template))
    try:
        with path.open("x", encoding="utf-8", newline="\n") as file:
            file.write(text)
    except FileExistsError:
        raise CaseError([f"{path}: exists already; choose another name"]) from None
    except (OSError, ValueError) as error:
        raise CaseError([f"{path}: cannot be written: {getattr(error, 'strerror', None) or error}"]) from None
    print_lines(f"{path} written; change it, then: oilfilm validate {path}")


@app.command()
@guarded
def schema() -> None:
    """Print the JSON Schema of case files, for editors."""
    from ..case import json_schema

    print_lines(json.dumps(json_schema(), indent=2))
