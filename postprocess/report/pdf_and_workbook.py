"""A result folder as pages of a PDF, and as a workbook for spreadsheet programs."""

import csv
from collections.abc import Iterable, Iterator, Sequence
from io import BytesIO
from itertools import chain
from pathlib import Path
from textwrap import wrap
from typing import Any, NamedTuple

import matplotlib
import xlsxwriter
from matplotlib.backends.backend_pdf import PdfPages
from matplotlib.figure import Figure
from matplotlib.image import imread

from oilfilm.bearing.files import atomic_path
from oilfilm.ehl.foreign_files import LARGEST_TEXT, read_file
from oilfilm.ehl.units import unit_symbol, value_with_error, without_unit

from ..batch.results import MAIN_QUANTITY, MOST_COMPONENTS, components, main_results
from ..bearing.contact_quantities import CONTACT_QUANTITY, TERMINAL_COLUMNS
from ..bearing.results import balls_text
from ..files import read_summary
from ..plot_style import INK, RC, REFERENCE
from ..quantities import NOTHING, in_figures, is_number, number
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
WIDTH = 112  # characters of a line of text
TYPE_SIZE = 8.5  # [points]
SMALL = 6.5  # of tables [points]
MOST_COLUMNS = 8  # of a table; the workbook has all
MOST_ROWS = 60
LARGEST_PLAIN = 1e9  # number without a power of ten
OTHERS_PLACE = ("Results", "Input", "Messages", "bearings")  # sheets shown elsewhere
TABLE_TITLES = {"campbell": "Natural frequencies over the speed"}
LEADING = 1.45  # height of a line over the size of its type [-]
PICTURES_A_PAGE = 2
BEARINGS_A_LINE = 3
RESULT_BLOCKS = ("ring", "clearance", "strength", "life", "dry_running", "frequencies_Hz")
CONTACT_PLACES = {  # columns of the contacts and where they end [-]
    "load_N": 0.33,
    "hertz_pressure_GPa": 0.44,
    "contact_angle_deg": 0.53,
    "film_central_um": 0.73,
    "film_minimum_um": 0.91,
    "lambda_ratio": 1.0,
}


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
    """A list of tables, with a column for each number and word."""
    flat = [{_heading(*parts): value for parts, value in _leaves(row)} for row in rows]
    keys = list(dict.fromkeys(key for row in flat for key in row))
    return keys, [[row.get(key) for key in keys] for row in flat]


def _heading(*parts: str) -> str:
    unit = unit_symbol(".".join(parts))
    name = " ".join(map(without_unit, parts))
    return f"{name} [{unit}]" if unit else name


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
    """Write main results, contacts, pictures, input and notes as a PDF, made in memory.

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
        rows = chain(
            _headline(summary, folder.name),
            (Row([], picture=imread(BytesIO(read_file(path)))) for path in pictures),
            _further_pages(summary, folder),
        )
        for page, figure in enumerate(_pages(rows), 1):
            style: dict[str, Any] = {"color": REFERENCE, "ha": "right", "fontsize": 7}
            figure.text(1.0 - MARGIN, 0.5 * MARGIN, str(page), **style)
            pages.savefig(figure)
    with atomic_path(path) as temporary:
        temporary.write_bytes(content.getvalue())
    return path


class Row(NamedTuple):
    """Texts side by side: their places, 0 to 1, left or right of it; or a picture."""

    cells: Sequence[tuple[float, str, str]]  # place [-], "left" or "right", text
    size: float = TYPE_SIZE  # [points]
    weight: str = "normal"
    colour: str = INK
    picture: Any = None  # its colours, shape (height, width, 4)

    @property
    def height(self) -> float:
        """Part of the height of a page [-]."""
        if self.picture is None:
            return LEADING * self.size / 72.0 / PAGE[1]
        high, wide, *_ = self.picture.shape
        own = (1.0 - 2.0 * MARGIN) * PAGE[0] / PAGE[1] * high / wide
        return min(own, (1.0 - 2.0 * MARGIN) / PICTURES_A_PAGE)


def _headline(summary: dict[str, Any], name: str) -> Iterator[Row]:
    """Title, state, warnings, main results and contacts."""
    case = summary["case"] if isinstance(summary["case"], dict) else {}
    title = str(case.get("title") or summary.get("title") or name)
    for line in wrap(title, WIDTH // 2):
        yield Row([(0.0, "left", line)], 15.0, "bold")
    state = "converged" if summary["converged"] else "NOT CONVERGED"
    about = f"oilfilm {summary['oilfilm']}, {state}"
    about += f"; source of the input: {case['source']}" if case.get("source") else ""
    yield from _paragraphs([about], REFERENCE)
    yield from _section("Warnings", _paragraphs(summary.get("warnings", ())))
    main = list(_main_facts(summary))
    results = {
        key: value for key, value in summary.items() if key not in ("case", "messages", "warnings")
    }
    yield from _section("Main results", _facts_rows(main or _facts(results)[1]))
    contacts = summary.get("contacts") or ()
    if contacts and "ball" in contacts[0]:
        yield from _section("Contacts", _contact_rows(contacts))
    yield from _section("Bearings", _bearing_rows(summary.get("bearings") or ()))


def _main_facts(summary: dict[str, Any]) -> Iterator[list[Any]]:
    """Quantity, value with its error bar and unit of what is looked at first."""
    found = main_results(summary) if summary.get("kind") != "batch" else {}
    for key, value in found.items():
        quantity = MAIN_QUANTITY.get(key)
        if quantity is None or value is None or "uncertainty" in key:
            continue
        yield ["", quantity.title, _with_error(found, key), unit_symbol(key)]


def _with_error(of: dict[str, Any], key: str, style: str = "") -> str:
    """A value, of a film with its error bar."""
    error = of.get(key.replace("_um", "_uncertainty_um")) if key.endswith("_um") else None
    if error and of.get(key) is not None:
        return value_with_error(of[key], error, most=4)
    return number(of.get(key), style) if style else _shown(of.get(key), 4)


def _contact_rows(contacts: Sequence[dict[str, Any]]) -> Iterator[Row]:
    """Loaded contacts, equal ones in one line."""
    keys = [key for key in CONTACT_PLACES if any(one.get(key) is not None for one in contacts)]
    heads = [f"{CONTACT_QUANTITY[key].symbol} {unit_symbol(key)}".strip() for key in keys]
    equal: dict[tuple[str, ...], list[str]] = {("race", *heads): []}
    for contact in contacts:
        if contact["loaded"]:
            cells = [_with_error(contact, key, TERMINAL_COLUMNS[key]) for key in keys]
            equal.setdefault((contact["race"], *cells), []).append(str(contact["ball"]))
    for (race, *cells), balls in equal.items():
        places = [
            (CONTACT_PLACES[key], "right", cell) for key, cell in zip(keys, cells, strict=True)
        ]
        name = balls_text(balls) if balls else "balls"
        weight = "normal" if balls else "bold"
        yield Row([(0.0, "left", name), (0.16, "left", race), *places], weight=weight)


def _bearing_rows(bearings: Sequence[dict[str, Any] | None]) -> Iterator[Row]:
    """Main results of the bearings of a shaft, side by side."""
    known = [one for one in bearings if one is not None]
    facts = [{(row[1], row[3]): row[2] for row in _main_facts(one)} for one in known]
    lines = {"": [str(one["case"]["title"]) for one in known]}
    for quantity, unit in dict.fromkeys(key for one in facts for key in one):
        lines[f"{quantity} [{unit}]".replace(" []", "")] = [
            one.get((quantity, unit), NOTHING) for one in facts
        ]
    for first in range(0, len(known), BEARINGS_A_LINE):
        for title, texts in lines.items():
            part = texts[first : first + BEARINGS_A_LINE]
            ends = [(0.5 + 0.25 * k, "right", text) for k, text in enumerate(part)]
            yield Row([(0.0, "left", title), *ends], weight="normal" if title else "bold")


def _table_rows(header: Sequence[str], rows: Sequence[Sequence[Any]]) -> Iterator[Row]:
    """The first columns and rows of a table whose values differ, or of its only row."""
    cells = [[_shown(cell, 4) for cell in row] for row in rows]
    columns = zip(header, *cells, strict=False)
    differing = [column for column in columns if len(set(column[1:])) > 1 or len(rows) == 1]
    differing = differing[:MOST_COLUMNS]
    lines = list(zip(*differing, strict=True))
    names = [column[0].rpartition(".")[2] for column in differing]
    heads = [[*wrap(name if "[" in name else _heading(name), 16), "", ""][:2] for name in names]
    for texts in zip(*heads, strict=True):
        yield Row(_across(texts), SMALL, "bold")
    for line in lines[1 : MOST_ROWS + 1]:
        yield Row(_across([text[:16] for text in line]), SMALL)
    if len(rows) > MOST_ROWS or len(header) > len(differing):
        yield from _paragraphs([f"{len(rows)} rows and {len(header)} columns in all"], REFERENCE)


def _across(texts: Sequence[str]) -> list[tuple[float, str, str]]:
    """Texts of a line of a table, at equal distances."""
    return [((k + 1) / MOST_COLUMNS, "right", text) for k, text in enumerate(texts)]


def _further_pages(summary: dict[str, Any], folder: Path) -> Iterator[Row]:
    """Blocks of results, input without the sources of its materials, and all notes."""
    results = {
        key: value
        for key, value in summary.items()
        if (isinstance(value, float) and key != "wall_s")
        or (key in RESULT_BLOCKS and isinstance(value, dict))
    }
    yield from _section("Further results", _facts_rows(_facts(results)[1]))
    for name, sheet in sheets(folder).items():
        if "equilibrium" not in summary and name not in OTHERS_PLACE:
            title = name.replace("_", " ").capitalize()
            yield from _section(TABLE_TITLES.get(name, title), _table_rows(*sheet))
    case = summary["case"] if isinstance(summary["case"], dict) else {}
    blocks = dict.fromkeys(("bearing", "operation", "lubricant", *case))
    ordered = {name: case[name] for name in blocks if name in case}
    facts = [row for row in _facts(ordered)[1] if row[1] not in ("source", "title")]
    yield from _section("Input", _facts_rows(facts))
    yield from _section("Notes", _paragraphs(remarks(summary)))
    text = "Every number is in summary.json and, by oilfilm export --format xlsx, in a workbook."
    yield from _paragraphs([text], REFERENCE)


def _section(title: str, rows: Iterable[Row]) -> Iterator[Row]:
    content = list(rows)
    if content:
        yield Row([])
        yield Row([(0.0, "left", title)], 10.5, "bold")
        yield from content


def _paragraphs(texts: Iterable[str], colour: str = INK) -> Iterator[Row]:
    for text in texts:
        for first, line in enumerate(wrap(text, WIDTH)):
            yield Row([(0.015 * bool(first), "left", line)], colour=colour)


def _facts_rows(facts: Iterable[Sequence[Any]]) -> Iterator[Row]:
    """Block and quantity, value and unit; long values below."""
    for block, quantity, value, unit in facts:
        text = _shown(value, 5)
        if not text:
            continue
        name = (0.0, "left", f"{block} {quantity}".strip())
        if len(text) < WIDTH // 3:
            yield Row([name, (0.66, "right", text), (0.675, "left", unit)])
        else:
            yield from _paragraphs([f"{name[2]}: {text}"])


def _shown(value: Any, figures: int) -> str:
    """A number without a power of ten where it is below a billion; yes or no; words."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float) and 1.0 <= value < LARGEST_PLAIN:
        return in_figures(value, figures)
    return number(value, f".{figures}g")


def _pages(rows: Iterable[Row]) -> Iterator[Figure]:
    """Pages of rows one below the other."""
    figure = None
    place = 0.0
    for row in rows:
        if figure is None or place - row.height < MARGIN:
            if figure is not None:
                yield figure
            figure = Figure(figsize=PAGE)
            place = 1.0 - MARGIN
            figure.set_layout_engine("none")
        place -= row.height
        if row.picture is not None:
            box = (MARGIN, place, 1.0 - 2.0 * MARGIN, 0.95 * row.height)
            axes = figure.add_axes(box)
            axes.imshow(row.picture, interpolation="none")
            axes.set_axis_off()
        for at, side, text in row.cells:
            style: dict[str, Any] = {"ha": side, "fontsize": row.size, "weight": row.weight}
            x = MARGIN + at * (1.0 - 2.0 * MARGIN)
            # a dollar sign would begin a formula
            figure.text(x, place, text.replace("$", r"\$"), color=row.colour, **style)
    if figure is not None:
        yield figure
