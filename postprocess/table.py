"""Tables of results for a terminal of 80 columns."""

from collections.abc import Iterable, Mapping
from typing import Any

from rich import box
from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text


def titled(title: str, *parts: RenderableType) -> Group:
    """Tables and lines of text below a title.

    Parameters
    ----------
    title : str
        Title of the case.
    *parts : RenderableType
        Tables and lines of text.

    Returns
    -------
    Group
        All of it for a terminal.
    """
    return Group(Text(title, style="bold"), *parts)


def facts_table(rows: Mapping[str, str]) -> Table:
    """Names and values side by side, without lines.

    Parameters
    ----------
    rows : Mapping[str, str]
        Value by name.

    Returns
    -------
    Table
        The table.
    """
    table = Table(box=None, show_header=False, pad_edge=False)
    table.add_column(style="dim", no_wrap=True)
    table.add_column()
    for name, value in rows.items():
        table.add_row(name, Text(value))
    return table


def number_table(
    headers: Iterable[str], rows: Iterable[Iterable[str]], left: Iterable[str] = (), **style: Any
) -> Table:
    """Columns aligned right, those named in `left` aligned left, a line below the head.

    Parameters
    ----------
    headers : Iterable[str]
        Titles of the columns.
    rows : Iterable[Iterable[str]]
        Cells of each line.
    left : Iterable[str], default ()
        Titles of columns that hold words.
    **style : Any
        Further options of `rich.table.Table`.

    Returns
    -------
    Table
        The table.
    """
    own: dict[str, Any] = {"box": box.SIMPLE_HEAD, "pad_edge": False, "title_justify": "left"}
    table = Table(**own | style)
    for header in headers:
        table.add_column(header, justify="left" if header in left else "right", no_wrap=True)
    for row in rows:
        table.add_row(*row)
    return table
