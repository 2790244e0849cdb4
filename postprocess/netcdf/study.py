"""Files of a study: pictures, tables, data set and summary."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..files import SUMMARY_FILE, Table, attempt, write_csv, write_json
from .groups import FIELDS_FILE, Variables, root_attributes, write_dataset

SPEED_COLUMN = "speed [r/min]"  # of studies over the speed of the inner ring


@dataclass(frozen=True, slots=True, kw_only=True)
class StudyFiles:
    """Files of a study: its summary, tables by name, and its data set."""

    kind: str
    document: dict[str, Any]
    tables: dict[str, Table]
    variables: Variables
    attributes: dict[str, Any] = field(default_factory=dict)
    number: str = ""  # format of the numbers in tables, in full if it is empty


def write_study(files: StudyFiles, folder: Path, draw: Callable[[], object]) -> tuple[str, ...]:
    """Write pictures, tables, data set, last the summary; pictures that failed are messages.

    Parameters
    ----------
    files : StudyFiles
        Summary, tables and data set.
    folder : Path
        Folder to write into.
    draw : Callable[[], object]
        Writes the pictures.

    Returns
    -------
    tuple[str, ...]
        Messages on pictures that failed.
    """
    folder.mkdir(parents=True, exist_ok=True)
    problems = attempt("plots", draw)
    for name, (header, rows) in files.tables.items():
        write_csv(folder / f"{name}.csv", header, rows, files.number)
    document = files.document | {"messages": [*files.document["messages"], *problems]}
    attributes = root_attributes(document, files.kind) | files.attributes
    write_dataset(files.variables, attributes, folder / FIELDS_FILE)
    write_json(document, folder / SUMMARY_FILE)
    return problems
