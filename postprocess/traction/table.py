"""What `oilfilm table` prints."""

from rich.console import Group
from rich.table import Table

from .results import TractionResults, traction_summary


def traction_table(results: TractionResults) -> Group:
    """What a run prints: range and error of each race's table."""
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
    beside = (
        [_full_solves(results)]
        if any(table.full_solves for table in results.tables.values())
        else []
    )
    return Group(
        found, *beside, *(f"  {message}" for message in traction_summary(results)["messages"])
    )


def _full_solves(results: TractionResults) -> Table:
    """What the films of the tables leave out, place by place."""
    found = Table(title="Sliding on the table's film, and in full solves", title_justify="left")
    for name in (
        "race",
        "load [N]",
        "speed [m/s]",
        "slide/roll",
        "µ, film",
        "µ, full",
        "film ratio",
    ):
        found.add_column(name, justify="left" if name == "race" else "right")
    for race, table in results.tables.items():
        for one in table.full_solves:
            told = (
                f"{one.film_ratio:.3f}"
                if one.converged
                else f"{one.film_ratio:.3f}, not converged"
            )
            numbers = (
                f"{one.load:.4g}",
                f"{one.speed:.3g}",
                f"{one.slide_ratio:.4f}",
                f"{one.by_film:.4f}",
            )
            found.add_row(race.value, *numbers, f"{one.in_full:.4f}", told)
    return found
