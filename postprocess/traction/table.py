"""Traction tables in the terminal."""

from rich import box
from rich.console import Group
from rich.table import Table

from ..table import number_table
from .results import TractionResults
from .summary import traction_summary

RANGES = ("race", "load [N]", "speed [m/s]", "films", "largest µ", "error 95 %", "largest")
PLACES = ("race", "load [N]", "speed [m/s]", "slide/roll", "µ, film", "µ, full", "film ratio")


def traction_table(results: TractionResults) -> Group:
    """Range and error of each race's table, full solves beside them, and the messages.

    Parameters
    ----------
    results : TractionResults
        Traction tables of the case.

    Returns
    -------
    Group
        The tables.
    """
    rows = [
        [
            race.value,
            "{:.3g} to {:.4g}".format(*table.range.load),
            "{:.3g} to {:.3g}".format(*table.range.speed),
            str(table.films),
            f"{table.kappa_max:.4f}",
            f"{table.error.quantile:.2%}",
            f"{table.error.largest:.2%}",
        ]
        for race, table in results.tables.items()
    ]
    tables = [_boxed(RANGES, rows, results.title)]
    if any(table.full_solves for table in results.tables.values()):
        tables.append(_full_solves(results))
    messages = traction_summary(results)["messages"]
    return Group(*tables, *(f"  {message}" for message in messages))


def _full_solves(results: TractionResults) -> Table:
    """Effects that the films of the tables leave out, place by place."""
    rows = [
        [
            race.value,
            f"{solve.load:.4g}",
            f"{solve.speed:.3g}",
            f"{solve.slide_ratio:.4f}",
            f"{solve.by_film:.4f}",
            f"{solve.in_full:.4f}",
            f"{solve.film_ratio:.3f}" + ("" if solve.converged else ", not converged"),
        ]
        for race, table in results.tables.items()
        for solve in table.full_solves
    ]
    return _boxed(PLACES, rows, "Sliding on the table's film, and in full solves")


def _boxed(headers: tuple[str, ...], rows: list[list[str]], title: str) -> Table:
    style = {"box": box.HEAVY_HEAD, "pad_edge": True}
    return number_table(headers, rows, ("race",), title=title, **style)
