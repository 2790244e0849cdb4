"""JSON, CSV and netCDF files of results; each appears under its name only when complete."""

import csv
import json
import os
import tempfile
from collections.abc import Callable, Collection, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from math import isfinite
from pathlib import Path
from typing import Any

import xarray as xr

# dimensions, values, attributes by name
Variables = dict[str, tuple[tuple[str, ...], Any, dict[str, Any]]]
Table = tuple[Iterable[str], Iterable[Iterable[Any]]]  # header and rows
# of the netCDF file, raised when an older reader would misread it; 1: x along the entrainment
FORMAT = 2
SUMMARY_FILE = "summary.json"
CONTACTS_FILE = "contacts.csv"
COMPRESSION = {"zlib": True, "complevel": 4, "shuffle": True, "dtype": "float32"}  # of fields
FIELDS_FILE = "results.nc"
SPEED_COLUMN = "speed [r/min]"  # of studies over the speed of the inner ring


@contextmanager
def atomic_path(path: Path) -> Iterator[Path]:
    """A temporary name beside `path`; on success it becomes `path`, on failure nothing is left.

    Missing folders are created; the name has the suffix of `path`.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.stem}-", suffix=path.suffix)
    os.close(handle)
    temporary = Path(name)
    try:
        yield temporary
        os.chmod(temporary, 0o666 & ~umask())  # mkstemp gives 0600
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)


def umask() -> int:
    """Permissions that new files of this user do not get."""
    mask = os.umask(0)
    os.umask(mask)
    return mask


def write_text(path: Path, text: str) -> None:
    """Write a text, which appears when it is complete."""
    with atomic_path(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def write_json(document: dict[str, Any], path: Path) -> None:
    """Write a JSON document; NaN and infinity are refused with ValueError."""
    write_text(path, json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False) + "\n")


def plain_document(document: dict[str, Any]) -> dict[str, Any]:
    """A summary in plain JSON types, with a message for each number that is not finite."""
    lost: list[str] = []
    values: dict[str, Any] = plain(document, "", lost)
    values["messages"] += [f"{path}: null, the computed value is not finite" for path in lost]
    return values


def plain(value: Any, path: str = "", lost: list[str] | None = None) -> Any:
    """Plain JSON types; a number that is not finite becomes None, its path is added to `lost`."""
    if isinstance(value, dict):
        return {key: plain(v, f"{path}.{key}".lstrip("."), lost) for key, v in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item, f"{path}[{i}]", lost) for i, item in enumerate(value)]
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
    """Write a table: floats by the format `number`, in full if it is empty; nothing for null."""
    with atomic_path(path) as temporary, temporary.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(header)
        writer.writerows([_csv_cell(value, number) for value in row] for row in rows)


def _csv_cell(value: Any, number: str) -> Any:
    if value is None or (isinstance(value, float) and not isfinite(value)):
        return ""
    if isinstance(value, float):
        return f"{value:{number}}" if number else repr(float(value))
    return json.dumps(value) if isinstance(value, list | dict) else value


def attempt(name: str, write: Callable[[], object]) -> tuple[str, ...]:
    """Messages of an extra that failed, or those that it returns.

    Any failure in a drawing library is a lost picture, not a lost run.
    """
    try:
        messages = write()
    except Exception as error:
        return (f"{name} not written: {type(error).__name__}: {error}",)
    return messages if isinstance(messages, tuple) else ()


def write_dataset(
    variables: Variables, attributes: dict[str, Any], path: Path, coordinates: Collection[str] = ()
) -> None:
    """Write one netCDF-4 data set.

    Coordinates are the variables named as their dimension, and those of `coordinates`.
    """
    dataset = xr.Dataset(variables, attrs=attributes | {"oilfilm_format": FORMAT})
    dataset = dataset.set_coords([name for name in coordinates if name in variables])
    with atomic_path(path) as temporary:
        dataset.to_netcdf(temporary, engine="h5netcdf")
        dataset.close()


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
    """Write pictures, tables, data set, last the summary; pictures that failed are messages."""
    folder.mkdir(parents=True, exist_ok=True)
    problems = attempt("plots", draw)
    for name, (header, rows) in files.tables.items():
        write_csv(folder / f"{name}.csv", header, rows, files.number)
    document = files.document | {"messages": [*files.document["messages"], *problems]}
    attributes = root_attributes(document, files.kind) | files.attributes
    write_dataset(files.variables, attributes, folder / FIELDS_FILE)
    write_json(document, folder / SUMMARY_FILE)
    return problems


def write_tree(groups: dict[str, xr.Dataset], path: Path) -> None:
    """Write the groups of one netCDF-4 file; fields of contacts (`P`, `h`, `T`) as float32."""
    tree = xr.DataTree.from_dict(groups)
    encoding = {
        node.path: {name: COMPRESSION for name in ("P", "h", "T") if name in node.data_vars}
        for node in tree.subtree
    }
    with atomic_path(path) as temporary:
        tree.to_netcdf(temporary, engine="h5netcdf", encoding=encoding)
        tree.close()


def root_attributes(document: dict[str, Any], kind: str) -> dict[str, Any]:
    """Attributes of every file, from a summary: version, format, kind, input, messages."""
    case = document["case"]
    return {
        "title": str(case.get("title", "")),
        "source": str(case.get("source", "")),
        "oilfilm": document["oilfilm"],
        "oilfilm_format": FORMAT,
        "kind": kind,
        "converged": int(document["converged"]),
        "case": json.dumps(case, ensure_ascii=False),
        "messages": json.dumps(document["messages"], ensure_ascii=False),
    }


def contact_name(ball: int, race: str) -> str:
    """Name of a contact in files: `ball01/inner`."""
    return f"ball{ball:02d}/{race}"


def open_tree(path: Path) -> xr.DataTree:
    """The groups of a netCDF-4 file, read when they are used; ValueError if it is damaged."""
    try:
        return xr.open_datatree(path, engine="h5netcdf")
    except (OSError, KeyError, ValueError, TypeError, RuntimeError) as error:
        raise ValueError(f"{path} is damaged or not a netCDF-4 file: {error}") from error
