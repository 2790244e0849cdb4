"""All numbers of a result folder as one workbook for spreadsheet programs."""

import csv
from collections.abc import Iterator
from io import BytesIO
from pathlib import Path
from typing import Any

import xlsxwriter

from bearing.files import atomic_path
from ehl.units import unit_symbol, without_unit

from ..batch.numbers import MOST_COMPONENTS, components
from ..files import read_summary
from ..text import is_number, number
from .html import without_noise

MOST_ROWS = 1_048_576  # of a sheet, by the format
LONGEST_NAME = 31  # characters of the name of a sheet, by the format
BATCH_TABLE = "batch"  # of every number of a batch's points
FORBIDDEN = str.maketrans(dict.fromkeys("[]:*?/\\", " "))  # in names of sheets

Sheet = tuple[list[str], list[list[Any]]]  # header and rows


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
    with xlsxwriter.Workbook(content, {"in_memory": True, "nan_inf_to_errors": True}) as book:
        bold = book.add_format({"bold": True, "text_wrap": True, "valign": "top"})
        for name, (header, rows) in sheets(folder).items():
            sheet = book.add_worksheet(name.translate(FORBIDDEN)[:LONGEST_NAME])
            sheet.write_row(0, 0, header, bold)
            for number, row in enumerate(rows[: MOST_ROWS - 1], 1):
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
    results = {key: value for key, value in summary.items() if key not in ("case", "messages")}
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
    with path.open(newline="", encoding="utf-8") as file:
        header, *rows = list(csv.reader(file)) or [[]]
    return header, [list(map(_cell, row)) for row in rows]


def _cell(text: str) -> Any:
    if text in ("True", "False"):
        return text == "True"
    try:
        return float(text) if text else None
    except ValueError:
        return text
