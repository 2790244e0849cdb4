"""What `oilfilm table` prints."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .traction_results import TractionResults, traction_summary

if TYPE_CHECKING:
    from rich.console import Group


def traction_table(results: TractionResults) -> Group:
    """What a run prints: range and error of each race's table."""
    from rich.console import Group
    from rich.table import Table

    found = Table(title=str(results.case.get("title", "")), title_justify="left")
    for name in ("race", "load [N]", "speed [m/s]", "films", "largest µ", "error 95 %", "largest"):
        found.add_column(name, justify="left" if name == "race" else "right")
    for race, table in results.tables.items():
        low, high = table.range.load
        slow, fast = table.range.speed
        found.add_row(
            race.value,
            f"{low:.3g} to {high:.4g}",
            f"{slow:.3g} to {fast:.3g}",
            str(table.films),
            f"{table.kappa_max:.4f}",
            f"{table.error.quantile:.2%}",
            f"{table.error.largest:.2%}",
        )
    return Group(found, *(f"  {message}" for message in traction_summary(results)["messages"]))
