"""A comparison as tables for a terminal of 80 columns."""

from collections.abc import Iterable
from typing import Any

from rich import box
from rich.console import Group
from rich.table import Table
from rich.text import Text

from ..text import number
from .results import Comparison, Difference

MOST_ROWS = 25  # of the differences of all results, the largest first


def comparison_table(comparison: Comparison) -> Group:
    """Differences of input and main results, and the largest of all results, second less first
    [%].

    Parameters
    ----------
    comparison : Comparison
        Differences of two result folders.

    Returns
    -------
    Group
        The tables.
    """
    ordered = sorted(
        comparison.results, key=lambda d: -1.0 if d.relative is None else -abs(d.relative)
    )
    shown = ordered[:MOST_ROWS]
    parts: list[Any] = [
        Text(f"{which}: {name} (oilfilm {version})")
        for which, name, version in zip(
            ("first", "second"), comparison.names, comparison.versions, strict=True
        )
    ]
    inputs = comparison.inputs
    main = comparison.main
    parts.append(_table("input", inputs) if inputs else Text("the inputs are equal"))
    if any(d.first is not None for d in main):
        parts.append(_table("main results", main))
    title = "all results, largest differences first"
    parts.append(_table(title, shown) if shown else Text("the results are equal"))
    if len(ordered) > len(shown):
        parts.append(Text(f"... and {len(ordered) - len(shown)} more differences; --json has all"))
    if any(d.covered for d in (*main, *shown)):
        parts.append(Text("±: the difference is within the error bars of the two"))
    return Group(*parts)


def _table(title: str, differences: Iterable[Difference]) -> Table:
    table = Table(
        box=box.SIMPLE_HEAD,
        pad_edge=False,
        padding=(0, 1, 0, 0),
        title=title,
        title_justify="left",
    )
    table.add_column("", overflow="fold", max_width=38)
    for name in ("first", "second", "%"):
        table.add_column(name, justify="right", overflow="fold", max_width=16)
    for d in differences:
        if d.first is None and d.second is None:
            continue
        percent = number(None if d.relative is None else 100.0 * d.relative, "+.3g")
        percent = "0" if d.relative == 0.0 else percent
        percent += " ±" if d.relative is not None and d.covered and d.differs else ""
        cells = (d.path, _text(d.first), _text(d.second), percent)
        table.add_row(*(Text(cell) for cell in cells))
    return table


def _text(value: Any) -> str:
    text = number(value, ".6g")
    return text if len(text) <= 60 else text[:57] + "..."
