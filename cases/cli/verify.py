"""The command that verifies an installation: verify."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from ..runs.interrupt import print_message
from .output import report_cost
from .terminal import NOT_CONVERGED, Json, Quiet, command, print_json, print_table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rich.table import Table

    from ..runs.verification import Check

SECONDS = {False: 10.0, True: 2.0}  # on two cores; with --quick


@command()
def verify(
    quick: Annotated[
        bool, typer.Option("--quick", help="Coarse grids and wider bounds: seconds.")
    ] = False,
    as_json: Json = False,
    quiet: Quiet = False,
) -> int:
    """Check the contact solver against closed forms and films by other methods."""
    from ..runs.verification import checks

    report_cost(("films of the verification", SECONDS[quick]), quiet=quiet)
    found = list(checks(quick=quick))
    failed = [_failure(check) for check in found if not check.passed]
    if as_json:
        print_json(_document(found, failed))
    elif not quiet:
        print_table(_table(found))
    if not failed:
        return 0
    print_message("oilfilm: these statements do not hold:")
    for message in failed:
        print_message(f"  {message}")
    return NOT_CONVERGED


def _bounds(check: Check) -> str:
    return f"{check.least:.6g} to {check.most:.6g}"


def _failure(check: Check) -> str:
    return f"{check.name}: {check.value:.6g}, wanted {_bounds(check)}"


def _document(found: Sequence[Check], failed: Sequence[str]) -> dict[str, object]:
    rows = [
        {
            "name": check.name,
            "value": check.value if check.value == check.value else None,
            "least": check.least,
            "most": check.most,
            "passed": check.passed,
        }
        for check in found
    ]
    return {"converged": not failed, "messages": list(failed), "checks": rows}


def _table(found: Sequence[Check]) -> Table:
    from rich.table import Table

    table = Table("statement", "found", "wanted", "holds")
    for check in found:
        holds = "yes" if check.passed else "no"
        table.add_row(check.name, f"{check.value:.6g}", _bounds(check), holds)
    return table
