"""A result folder as pages of a PDF, and as a workbook for spreadsheet programs."""

import csv
from collections.abc import Callable, Iterator, Sequence
from io import BytesIO
from itertools import chain
from pathlib import Path
from textwrap import wrap
from typing import Any

import matplotlib
import xlsxwriter
from matplotlib.backends.backend_pdf import PdfPages
from matplotlib.figure import Figure
from matplotlib.image import imread

from oilfilm.bearing.files import atomic_path
from oilfilm.ehl.foreign_files import LARGEST_TEXT, read_file
from oilfilm.ehl.units import unit_symbol, without_unit

from ..batch.results import MAIN_QUANTITY, MOST_COMPONENTS, components, main_results
from ..files import read_summary
from ..plot_style import INK, RC, REFERENCE
from ..quantities import is_number, number
from .html import without_noise
from .page import remarks

MOST_SHEET_ROWS = 1_048_576  # of a sheet, by the format
LONGEST_NAME = 31  # characters of the name of a sheet, by the format
BATCH_TABLE = "batch"  # of every number of a batch's points
AS_TEXT = ("strings_to_formulas", "strings_to_urls", "strings_to_numbers")  # which they stay
FORBIDDEN = str.maketrans(dict.fromkeys("[]:*?/\\", " "))  # in names of sheets
Sheet = tuple[list[str], list[list[Any]]]  # header and rows
PAGE = (8.27, 11.69)  # A4 [in]
MARGIN = 0.07  # of the page's width and height [-]
LINES = 74  # of a page of text
WIDTH = 98  # characters of a line
TYPE_SIZE = 7.2  # of a fixed width, so that columns stand below each other [points]
MOST_ROWS = 2 * LINES  # of a table; the workbook and the CSV files have all
PICTURES_A_PAGE = 2
NAMES = ("ball", "race", "#")  # columns that name a row, and those before them
FACTS = (26, 38, 22, 10)  # widths of block, quantity, value, unit [characters]


def write_workbook(directory: str | Path, file: str | Path) -> Path:
    """Write a sheet each of results, input, lists, CSV tables and messages, as XLSX.

    Parameters
    ----------
    directory : str | Path
        Folder of the results.
    file : str | Path
        XLSX file.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    ValueError
        Without readable results.
    """
    folder = Path(directory)
    path = Path(file)
    content = BytesIO()
    options = {"in_memory": True, "nan_inf_to_errors": True} | dict.fromkeys(AS_TEXT, False)
    with xlsxwriter.Workbook(content, options) as book:
        bold = book.add_format({"bold": True, "text_wrap": True, "valign": "top"})
        for name, (header, rows) in sheets(folder).items():
            sheet = book.add_worksheet(name.translate(FORBIDDEN)[:LONGEST_NAME])
            sheet.write_row(0, 0, header, bold)
            for number, row in enumerate(rows[: MOST_SHEET_ROWS - 1], 1):
                sheet.write_row(number, 0, row)
            sheet.freeze_panes(1, 0)
            sheet.autofit()
    with atomic_path(path) as temporary:
        temporary.write_bytes(content.getvalue())
    return path


def sheets(folder: Path) -> dict[str, Sheet]:
    """Header and rows of every sheet of a result folder, by its name.

    Parameters
    ----------
    folder : Path
        Folder of the results.

    Returns
    -------
    dict[str, Sheet]
        Header and rows by the name of the sheet.
    """
    summary = read_summary(folder)
    case = summary["case"]
    results = {
        key: value for key, value in summary.items() if key not in ("case", "messages", "warnings")
    }
    result = {"Results": _facts(results)}
    if isinstance(case, dict):
        result["Input"] = _facts(case)
    tables = {path.stem: _csv_sheet(path) for path in sorted(folder.glob("*.csv"))}
    result |= _stiffness_sheet((summary.get("ring") or {}).get("stiffness") or {})
    if BATCH_TABLE not in tables:  # which has the points
        lists = {key: value for key, value in results.items() if _is_table(value)}
        result |= {key: _list_sheet(rows) for key, rows in lists.items() if key not in tables}
    result |= tables
    return result | {"Messages": (["message"], [[str(text)] for text in summary["messages"]])}


def _facts(document: dict[str, Any]) -> Sheet:
    """Block, quantity, value and unit of every number and word of a document."""
    rows = []
    for parts, value in _leaves(document):
        block = " ".join(map(without_unit, parts[:-1]))
        unit = unit_symbol(".".join(parts)) if is_number(value) else ""
        rows.append([block, without_unit(parts[-1]), value, unit])
    return ["block", "quantity", "value", "unit"], rows


def _leaves(document: dict[str, Any], path: tuple[str, ...] = ()) -> Iterator[tuple[Any, Any]]:
    """Keys and value of everything that fits one cell; parts of short lists by their number."""
    for key, value in document.items():
        if isinstance(value, dict):
            yield from _leaves(value, (*path, key))
        elif isinstance(value, list | tuple):
            if 0 < len(value) <= MOST_COMPONENTS and all(map(is_number, value)):
                names = components(key, len(value))
                for name, part in zip(names, without_noise(value), strict=True):
                    yield (*path, key, name), part + 0.0
            elif not any(isinstance(item, list | dict) for item in value):
                yield (*path, key), "; ".join(number(item, ".6g") for item in value)
        elif value is not None:
            yield (*path, key), value


def _is_table(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and all(isinstance(v, dict) for v in value)


def _stiffness_sheet(stiffness: dict[str, Any]) -> dict[str, Sheet]:
    """The matrix of a bearing's stiffness, units beside the rows; nothing without one."""
    if not stiffness.get("matrix"):
        return {}
    rows = [
        [f"{name} [{units[0]}; tilt {units[-1]}]", *without_noise(values)]
        for name, units, values in zip(
            *(stiffness[key] for key in ("order", "units", "matrix")), strict=True
        )
    ]
    return {"stiffness": (["d(load)/d(displacement)", *stiffness["order"]], rows)}


def _list_sheet(rows: list[dict[str, Any]]) -> Sheet:
    """A list of tables, with a column for each key that fits one cell."""
    keys = [
        key
        for key in dict.fromkeys(key for row in rows for key in row)
        if not any(isinstance(row.get(key), dict | list) for row in rows)
    ]
    header = [_heading(key) for key in keys]
    return header, [[row.get(key) for key in keys] for row in rows]


def _heading(key: str) -> str:
    unit = unit_symbol(key)
    return f"{without_unit(key)} [{unit}]" if unit else without_unit(key)


def _csv_sheet(path: Path) -> Sheet:
    """A table of the folder, its numbers as numbers."""
    text = read_file(path, LARGEST_TEXT).decode("utf-8")
    header, *rows = list(csv.reader(text.splitlines(keepends=True))) or [[]]
    return header, [list(map(_cell, row)) for row in rows]


def _cell(text: str) -> Any:
    if text in ("True", "False"):
        return text == "True"
    try:
        return float(text) if text else None
    except ValueError:
        return text.removeprefix("'")


def write_pdf(directory: str | Path, file: str | Path) -> Path:
    """Write main results, input, tables, messages and pictures as a PDF, made in memory.

    Parameters
    ----------
    directory : str | Path
        Folder of the results.
    file : str | Path
        PDF file.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    ValueError
        Without readable results.
    """
    folder = Path(directory)
    path = Path(file)
    summary = read_summary(folder)
    content = BytesIO()
    with matplotlib.rc_context(RC), PdfPages(content) as pages:
        pictures = sorted([*folder.glob("*.png"), *folder.glob("plots/*.png")])
        figures = chain(
            _pages(list(_headline(summary, folder.name)), LINES, _text_page),
            _pages(pictures, PICTURES_A_PAGE, _picture_page),
            _pages(list(_lines(summary, folder)), LINES, _text_page),
        )
        for page, figure in enumerate(figures, 1):
            style: dict[str, Any] = {"color": REFERENCE, "ha": "right", "fontsize": 7}
            figure.text(1.0 - MARGIN, 0.5 * MARGIN, str(page), **style)
            pages.savefig(figure)
    with atomic_path(path) as temporary:
        temporary.write_bytes(content.getvalue())
    return path


def _pages(
    items: Sequence[Any], count: int, draw: Callable[[Sequence[Any]], Figure]
) -> Iterator[Figure]:
    """Pages of at most so many lines or pictures."""
    for start in range(0, len(items), count):
        yield draw(items[start : start + count])


def _headline(summary: dict[str, Any], name: str) -> Iterator[str]:
    """Title, state, warnings and main results, line by line."""
    case = summary["case"] if isinstance(summary["case"], dict) else {}
    yield str(case.get("title") or summary.get("title") or name)
    state = "converged" if summary["converged"] else "NOT CONVERGED"
    yield f"oilfilm {summary['oilfilm']}, {state}"
    yield from wrap(f"source of the input: {case['source']}", WIDTH) if case.get("source") else ()
    yield from _section("Warnings", _paragraphs(summary.get("warnings", ())))
    yield from _section("Main results", _main_lines(summary))


def _lines(summary: dict[str, Any], folder: Path) -> Iterator[str]:
    """All numbers and notes, line by line."""
    for name, sheet in sheets(folder).items():
        is_facts = sheet[0][:2] == ["block", "quantity"]
        if name == "Messages":
            yield from _section("Notes", _paragraphs(remarks(summary)))
        else:
            yield from _section(name, _fact_lines(sheet) if is_facts else _table_lines(sheet))


def _section(title: str, lines: Sequence[str]) -> list[str]:
    return ["", title.replace("_", " ").upper(), *lines] if lines else []


def _paragraphs(texts: Sequence[str]) -> list[str]:
    return [line for text in texts for line in wrap(text, WIDTH, subsequent_indent="  ")]


def _main_lines(summary: dict[str, Any]) -> list[str]:
    """The numbers that are looked at first."""
    rows = []
    for key, value in main_results(summary).items() if summary.get("kind") != "batch" else ():
        quantity = MAIN_QUANTITY.get(key)
        if quantity is not None and value is not None:
            title, _, unit = quantity.label.partition(" [")
            rows.append(
                f"{title:<40} {number(value)} {unit.rstrip(']').replace('-', '')}".rstrip()
            )
    return rows


def _fact_lines(sheet: Sheet) -> list[str]:
    lines = []
    for row in sheet[1]:
        cells = [number(cell, ".6g") for cell in row]
        text = "".join(f"{cell[: w - 1]:<{w}}" for cell, w in zip(cells, FACTS, strict=True))
        long = len(cells[2]) >= FACTS[2]
        lines += wrap(" ".join(cells), WIDTH, subsequent_indent="  ") if long else [text.rstrip()]
    return lines


def _table_lines(sheet: Sheet) -> list[str]:
    """A table in blocks of as many columns as fit a line; columns that name a row in each."""
    header, rows = sheet
    cells = [[number(cell, ".5g") for cell in row] for row in rows[:MOST_ROWS]]
    widths = [max(map(len, column)) + 1 for column in zip(header, *cells, strict=True)]
    names = 1 + max((k for k, name in enumerate(header) if name in NAMES), default=0)
    lines: list[str] = []
    first = names
    while first < len(header) or not lines:
        last = first
        room = WIDTH - sum(widths[:names])
        while last < len(header) and (room := room - widths[last]) >= 0:
            last += 1
        shown = [*range(names), *range(first, max(last, first + 1))]
        first = max(last, first + 1)
        for row in (header, *cells):
            texts = (f"{row[k]:>{widths[k]}}" for k in shown if k < len(row))
            lines.append("".join(texts)[:WIDTH])
        lines.append("")
    left_out = len(rows) - len(cells)
    return [*lines, f"{left_out} more rows are in the folder"] if left_out > 0 else lines


def _text_page(lines: Sequence[str]) -> Figure:
    figure = Figure(figsize=PAGE)
    figure.set_layout_engine("none")
    style: dict[str, Any] = {"family": "DejaVu Sans Mono", "fontsize": TYPE_SIZE, "va": "top"}
    step = (1.0 - 2.0 * MARGIN) / LINES
    for k, line in enumerate(lines):
        weight = "bold" if line.isupper() else "normal"
        # a dollar sign would begin a formula
        text = line.replace("$", r"\$")
        figure.text(MARGIN, 1.0 - MARGIN - k * step, text, color=INK, weight=weight, **style)
    return figure


def _picture_page(paths: Sequence[Path]) -> Figure:
    figure = Figure(figsize=PAGE)
    figure.set_layout_engine("none")
    height = (1.0 - 2.0 * MARGIN) / PICTURES_A_PAGE
    for k, path in enumerate(paths):
        box = (MARGIN, 1.0 - MARGIN - (k + 1) * height, 1.0 - 2.0 * MARGIN, 0.96 * height)
        axes = figure.add_axes(box)
        axes.imshow(imread(BytesIO(read_file(path))), interpolation="none")
        axes.set_axis_off()
    return figure
