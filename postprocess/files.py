"""JSON and CSV files of results; each appears under its name only when complete."""

import csv
import json
import sys
from collections.abc import Callable, Iterable
from math import isfinite
from pathlib import Path
from typing import Any

from oilfilm.bearing.files import atomic_path, is_disk_failure, write_bytes
from oilfilm.ehl.foreign_files import read_json

CsvTable = tuple[Iterable[str], Iterable[Iterable[Any]]]  # header and rows
# types whose values are of JSON as they are, as finite floats are; the paths of others are built
PLAIN = frozenset((str, int, bool, type(None)))
LARGEST = sys.float_info.max
SUMMARY_FILE = "summary.json"
FORMULA = frozenset("=+-@\t\r")  # begin a formula in programs that open tables
CONTACTS_FILE = "contacts.csv"


def write_text(path: Path, text: str) -> None:
    """Write a text, which appears when it is complete.

    Parameters
    ----------
    path : Path
        File to write.
    text : str
        Content.

    Raises
    ------
    OSError
        If the disk does not take it.
    """
    write_bytes(path, text.encode("utf-8"))


def write_json(document: dict[str, Any], path: Path) -> None:
    """Write a JSON document.

    Parameters
    ----------
    document : dict[str, Any]
        Plain JSON types.
    path : Path
        File to write.

    Raises
    ------
    ValueError
        If a number is NaN or infinite.
    """
    write_text(path, json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False) + "\n")


def read_summary(directory: Path) -> dict[str, Any]:
    """Read the summary of a result folder.

    Parameters
    ----------
    directory : Path
        Folder of the results.

    Returns
    -------
    dict[str, Any]
        Content of `summary.json`.

    Raises
    ------
    ValueError
        If the folder holds no summary, or one that is damaged or not of oilfilm.
    """
    path = directory / SUMMARY_FILE
    try:
        summary = read_json(path)
    except OSError as error:
        raise ValueError(
            f"{directory} holds no results: {SUMMARY_FILE}: {error.strerror or error}"
        ) from error
    required = {"oilfilm", "case", "converged", "messages"}
    if not isinstance(summary, dict) or not required <= summary.keys():
        raise ValueError(
            f"{path} is not a summary of oilfilm, or one of a version older than this one reads"
        )
    return summary


def plain_document(document: dict[str, Any]) -> dict[str, Any]:
    """A summary in plain JSON types, with a message for each number that is not finite.

    Parameters
    ----------
    document : dict[str, Any]
        Summary with the list `messages`.

    Returns
    -------
    dict[str, Any]
        The summary, null in place of each such number.
    """
    lost: list[str] = []
    values: dict[str, Any] = plain(document, "", lost)
    values["messages"] += [f"{path}: null, the computed value is not finite" for path in lost]
    return values


def plain(value: Any, path: str = "", lost: list[str] | None = None) -> Any:
    """Plain JSON types; a number that is not finite becomes None.

    Parameters
    ----------
    value : Any
        Any value of a summary, arrays of NumPy included.
    path : str, default ''
        Dotted path of the value in the summary.
    lost : list[str] | None, optional
        Takes the paths of numbers that are not finite.

    Returns
    -------
    Any
        The value in dictionaries, lists, text, numbers and None.
    """
    if isinstance(value, dict):
        # a value of JSON, as nearly all are, costs no call and no path
        return {
            key: v
            if (kind := type(v)) in PLAIN or (kind is float and -LARGEST <= v <= LARGEST)
            else plain(v, f"{path}.{key}" if path else key, lost)
            for key, v in value.items()
        }
    if isinstance(value, list | tuple):
        return [
            v
            if (kind := type(v)) in PLAIN or (kind is float and -LARGEST <= v <= LARGEST)
            else plain(v, f"{path}[{i}]", lost)
            for i, v in enumerate(value)
        ]
    if hasattr(value, "tolist"):  # arrays and scalars of NumPy
        return plain(value.tolist(), path, lost)
    if isinstance(value, float) and not isfinite(value):
        if lost is not None:
            lost.append(path)
        return None
    return value


def write_csv(
    path: Path, header: Iterable[str], rows: Iterable[Iterable[Any]], number: str = ""
) -> None:
    """Write a table; a cell of null is empty.

    Parameters
    ----------
    path : Path
        File to write.
    header : Iterable[str]
        Names of the columns.
    rows : Iterable[Iterable[Any]]
        Cells of each line.
    number : str, default ''
        Format of floats, such as ".7g"; in full if it is empty.
    """
    with atomic_path(path) as temporary, temporary.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow([_csv_cell(name, "") for name in header])
        writer.writerows([_csv_cell(value, number) for value in row] for row in rows)


def _csv_cell(value: Any, number: str) -> Any:
    if value is None or (isinstance(value, float) and not isfinite(value)):
        return ""
    if isinstance(value, float):
        return f"{value:{number}}" if number else repr(float(value))
    if isinstance(value, str) and value[:1] in FORMULA and value[1:] and not _is_number(value):
        return f"'{value}"  # a text for them
    return json.dumps(value) if isinstance(value, list | dict) else value


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def attempt(name: str, write: Callable[[], object]) -> tuple[str, ...]:
    """Messages of an extra that failed, or those that it returns.

    Any failure in a drawing library is a lost picture, not a lost run. That of a disk is one.

    Parameters
    ----------
    name : str
        What is written, for the message.
    write : Callable[[], object]
        Writes it.

    Returns
    -------
    tuple[str, ...]
        Why it failed, or the messages that it returns.

    Raises
    ------
    OSError
        If the disk is full or broken.
    """
    try:
        messages = write()
    except Exception as error:
        if is_disk_failure(error):
            raise
        if isinstance(error, InterruptedError):
            return (f"{name} not written: interrupted",)
        return (f"{name} not written: {type(error).__name__}: {error}",)
    return messages if isinstance(messages, tuple) else ()


def contact_name(ball: int, race: str) -> str:
    """Name of a contact in files: `ball01/inner`.

    Parameters
    ----------
    ball : int
        Number of the ball, from 1.
    race : str
        "inner" or "outer".

    Returns
    -------
    str
        Name of the contact.
    """
    return f"ball{ball:02d}/{race}"
