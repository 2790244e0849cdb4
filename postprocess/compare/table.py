"""A comparison as tables for a terminal of 80 columns."""

from collections.abc import Iterable
from typing import Any

from rich import box
from rich.console import Group
from rich.table import Table
from rich.text import Text

from .compare import Comparison, Difference

MOST_ROWS = 25  # of the differences of all results, the largest first
NOTHING = "–"


def comparison_table(comparison: Comparison) -> Group:
    """What differs: input, main results, and the largest differences of all results [%]."""
    ordered = sorted(comparison.results, key=lambda d: -1.0 if d.relative is None else -d.relative)
    shown = ordered[:MOST_ROWS]
    parts: list[Any] = [
        Text(f"first: {comparison.names[0]} (oilfilm {comparison.versions[0]})"),
        Text(f"second: {comparison.names[1]} (oilfilm {comparison.versions[1]})"),
    ]
    parts += (
        [_table("input", comparison.inputs)]
        if comparison.inputs
        else [Text("the inputs are equal")]
    )
    parts += (
        [_table("main results", comparison.main)]
        if any(d.first is not None for d in comparison.main)
        else []
    )
    parts += (
        [_table("all results, largest differences first", shown)]
        if shown
        else [Text("the results are equal")]
    )
    if len(ordered) > len(shown):
        parts.append(Text(f"... and {len(ordered) - len(shown)} more differences; --json has all"))
    if any(d.covered for d in (*comparison.main, *shown)):
        parts.append(Text("±: the difference is within the error bars of the two films"))
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
        share = (
            NOTHING
            if d.relative is None
            else f"{100.0 * d.relative:.3g}" + (" ±" if d.covered and d.differs else "")
        )
        table.add_row(Text(d.path), Text(_text(d.first)), Text(_text(d.second)), Text(share))
    return table


def _text(value: Any) -> str:
    if value is None:
        return NOTHING
    if isinstance(value, float):
        return f"{value:.6g}"
    words = str(value)
    return words if len(words) <= 60 else words[:57] + "..."
