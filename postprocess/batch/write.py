"""Files of a batch: every number of every point, as table, data set and Parquet file."""

import json
from collections.abc import Callable, Iterator, Sequence
from itertools import repeat
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow
import pyarrow.parquet

from oilfilm.bearing.files import atomic_path
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.units import unit_of

from ..files import write_csv
from ..netcdf_write import DatasetParts, Variables, read_variables, write_dataset_in_parts
from .packed_columns import STATE, STATE_KINDS, Columns, Kinds, Numbers, Row
from .results import BatchResults
from .store import BOOL, INTEGER, NOTHING

RACES = ("inner", "outer")
NUMBERS = (bool, int, float, type(None))
TYPES = {"bool": np.int8, "int": np.int64}
PARQUET_TYPES = {
    "bool": pyarrow.bool_(),
    "int": pyarrow.int64(),
    "float": pyarrow.float64(),
    "nothing": pyarrow.float64(),
    "word": pyarrow.string(),
    "text": pyarrow.string(),
}


def write_batch_csv(columns: Columns, path: Path) -> None:
    """Write one line for every point, units in the header, nothing for null.

    Parameters
    ----------
    columns : Columns
        Numbers of all points as columns.
    path : Path
        File to write.
    """
    names = (*STATE, *columns.source.keys, *columns.names)
    units = {name: column_unit(name, columns) for name in names}
    header = [f"{name} [{unit}]" if unit else name for name, unit in units.items()]
    write_csv(path, header, _lines(columns))


def _lines(columns: Columns) -> Iterator[tuple[Any, ...]]:
    """The cells of every point."""
    keys = columns.source.keys
    for rows, values, kinds in columns.chunks():
        cells = [_cells(values[:, k], kinds[:, k]) for k in range(values.shape[1])]
        lines = zip(*cells, strict=True) if cells else repeat(())  # no point has a number
        for row, numbers in zip(rows, lines, strict=bool(cells)):
            state = (row.number, row.block, row.status, row.converged)
            yield (*state, *(row.values.get(key) for key in keys), *numbers)


def _cells(values: Numbers, kinds: Kinds) -> list[Any]:
    """A column of a chunk as Python has it: truth values, whole numbers, None for null."""
    result: list[Any] = values.tolist()
    for kind in np.unique(kinds):
        places = np.flatnonzero(kinds == kind)
        if kind == NOTHING:
            result = _replaced(result, places, lambda value: None)
        elif kind in (BOOL, INTEGER):
            result = _replaced(result, places, bool if kind == BOOL else int)
    return result


def _replaced(values: list[Any], places: Any, convert: Callable[[Any], Any]) -> list[Any]:
    for place in places.tolist():
        values[place] = convert(values[place])
    return values


def column_unit(name: str, columns: Columns) -> str:
    """Unit of a column.

    Parameters
    ----------
    name : str
        Name of the column.
    columns : Columns
        Numbers of all points as columns.

    Returns
    -------
    str
        The unit; empty of words and truth values.
    """
    kind = columns.kinds.get(name) or STATE_KINDS[name]
    return "" if kind in ("bool", "word") else unit_of(name)


def write_batch_netcdf(
    columns: Columns,
    path: Path,
    results: BatchResults,
    *,
    whole: bool = True,
    points: Path | None = None,
) -> None:
    """Write the table's columns over `point`, numbers of balls and contacts over ball and race,
    records of vibrations over their samples.

    Units are attributes, the input of every point is the variable `case`; NaN for no value.

    Parameters
    ----------
    columns : Columns
        Numbers of all points as columns.
    path : Path
        File to write.
    results : BatchResults
        Results of the batch.
    whole : bool, default True
        With the numbers of balls and contacts and the input, of the points in `results`.
    points : Path | None, optional
        Folder of the points' own files, which the records are taken from.
    """
    keys = columns.source.keys
    # netCDF lists them with spaces between
    coordinates = [key for key in keys if " " not in key]
    units = {name: column_unit(name, columns) for name in (*STATE, *keys, *columns.names)}
    attributes = {name: {"units": unit} if unit else {} for name, unit in units.items()}
    kinds = {name: _type(name, columns) for name in units}
    parts = DatasetParts(
        dimension="point",
        size=len(columns.source),
        types=kinds | {"message": object},
        attributes=attributes,
        values=_parts(columns, kinds),
    )
    variables: Variables = {}
    if whole:
        cases = [json.dumps(point.case, ensure_ascii=False) for point in results.points]
        array = np.array(cases, dtype=object)
        variables["case"] = (("point",), array, {"long_name": "input as run, JSON"})
        variables |= _per_ball(results) | _per_contact(results)
        variables |= {} if points is None else _records(results, points)
    document = {
        "title": results.title,
        "oilfilm": results.version,
        "kind": "batch",
        "case": results.case,
        "sweep": results.sweep,
        "keys": json.dumps(results.keys),
        "converged": int(results.converged),
    }
    write_dataset_in_parts(parts, variables, document, path, coordinates)


def _type(name: str, columns: Columns) -> type:
    """Type of a column in netCDF: floats where a point has no value, else as they are."""
    kind = columns.kinds.get(name) or STATE_KINDS[name]
    if kind in TYPES and name not in columns.gaps:
        return TYPES[kind]
    return object if kind in ("word", "text") else float


def _parts(columns: Columns, types: dict[str, type]) -> Iterator[dict[str, Any]]:
    """Arrays of all columns, some thousand points at a time."""
    keys = columns.source.keys
    for rows, values, _ in columns.chunks():
        part: dict[str, Any] = {
            name: values[:, k].astype(types[name]) for k, name in enumerate(columns.names)
        }
        part |= {name: _array([r.values.get(name) for r in rows], types[name]) for name in keys}
        yield part | _state(rows)


def _state(rows: Sequence[Row]) -> dict[str, Any]:
    """State of the points as columns."""
    return {
        "point": _array([row.number for row in rows], np.int64),
        "block": _array([row.block for row in rows], object),
        "status": _array([row.status for row in rows], object),
        "converged": _array([row.converged for row in rows], np.int8),
        "message": _array([row.message for row in rows], object),
    }


def _array(values: list[Any], kind: type) -> np.ndarray[Any, Any]:
    """Values of a type; floats with NaN for None, text as such."""
    if kind is object:
        return np.array([_text(value) for value in values], dtype=object)
    if kind is float:
        return np.array([np.nan if value is None else float(value) for value in values])
    return np.array(values, dtype=kind)


def _text(value: Any) -> str:
    if value is None:
        return ""
    return json.dumps(value) if isinstance(value, list | dict) else str(value)


def _per_ball(results: BatchResults) -> Variables:
    """Numbers of the balls over point and ball."""
    rows = [(point.summary or {}).get("balls") or [] for point in results.points]
    count = max(map(len, rows), default=0)
    values = _filled(rows, (len(rows), count), {"ball"}, lambda ball: (ball["ball"] - 1,))
    balls: Variables = {"ball": (("ball",), np.arange(1, count + 1), {})} if values else {}
    return balls | _named("ball", ("point", "ball"), values)


def _per_contact(results: BatchResults) -> Variables:
    """Numbers of the contacts over point, ball and race."""
    rows = [(point.summary or {}).get("contacts") or [] for point in results.points]
    count = max((contact["ball"] for row in rows for contact in row), default=0)
    values = _filled(
        rows,
        (len(rows), count, 2),
        {"ball", "azimuth_deg"},
        lambda contact: (contact["ball"] - 1, RACES.index(contact["race"])),
    )
    races: Variables = {"race": (("race",), np.array(RACES, dtype=object), {})} if values else {}
    return races | _named("contact", ("point", "ball", "race"), values)


def _records(results: BatchResults, folder: Path) -> Variables:
    """Acceleration of vibrations over point and sample, NaN behind the end of a shorter one, with
    the sample rate and the defects in words, by which a classifier learns.
    """
    records: dict[int, Array] = {}
    rate = np.full(len(results.points), np.nan)
    strongest = [""] * len(results.points)
    for n, point in enumerate(results.points):
        seen = (point.summary or {}).get("vibration") or {}
        strongest[n] = seen.get("strongest_line") or ""
        file = folder / f"{point.key}.nc"
        if seen and file.is_file():
            time, records[n] = read_variables(file, "time", "acceleration")
            rate[n] = (len(time) - 1) / float(time[-1] - time[0])
    if not records:
        return {}
    longest = max(map(len, records.values()))
    whole = np.full((rate.size, longest), np.nan, dtype=np.float32)
    for n, record in records.items():
        whole[n, : len(record)] = record
    defects = [_defects(point.case) for point in results.points]
    return {
        "record.defects": (("point",), np.array(defects, dtype=object), {}),
        "record.strongest_line": (("point",), np.array(strongest, dtype=object), {}),
        "record.sample_rate_Hz": (("point",), rate, {"units": "Hz"}),
        "record.acceleration_m_s2": (("point", "sample"), whole, {"units": "m/s2"}),
    }


def _defects(case: dict[str, Any]) -> str:
    """Defects of a case in words."""
    defects = (case.get("form") or {}).get("defects") or ()
    return "; ".join(f"{d['kind']}, {d['place']}, {d['width_mm']:g} mm" for d in defects) or "none"


def _filled(
    rows: list[list[dict[str, Any]]],
    shape: tuple[int, ...],
    left_out: set[str],
    place: Callable[[dict[str, Any]], tuple[int, ...]],
) -> dict[str, Any]:
    """An array for each key of numbers, NaN where a point has no value."""
    entries = [entry for row in rows for entry in row]
    places = [(i, *place(entry)) for i, row in enumerate(rows) for entry in row]
    where = tuple(zip(*places, strict=True))
    values: dict[str, Any] = {}
    for name, numbers in _columns(entries):
        if name not in left_out and _are_numbers(name, numbers):
            values[name] = np.full(shape, np.nan)
            values[name][where] = np.array(numbers, dtype=float)  # None is NaN
    return values


def _are_numbers(name: str, values: Sequence[Any]) -> bool:
    """True if a key holds a number or null in every entry."""
    return name != "note" and all(issubclass(kind, NUMBERS) for kind in set(map(type, values)))


def _columns(entries: Sequence[dict[str, Any]]) -> Iterator[tuple[str, Sequence[Any]]]:
    """Every key that stands in any entry, in their order, with its values; None where it stands
    in no entry.
    """
    if len({tuple(entry) for entry in entries}) == 1:  # as nearly always: the quick way
        yield from zip(entries[0], zip(*(e.values() for e in entries), strict=True), strict=True)
        return
    for name in dict.fromkeys(key for entry in entries for key in entry):
        yield name, [entry.get(name) for entry in entries]


def _named(part: str, over: tuple[str, ...], values: dict[str, Any]) -> Variables:
    """Variables of a part of the bearing, with their units."""
    units = {name: {"units": unit_of(name)} if unit_of(name) else {} for name in values}
    return {f"{part}.{name}": (over, value, units[name]) for name, value in values.items()}


def write_batch_parquet(columns: Columns, path: Path) -> None:
    """Write the columns of batch.csv with types, null for no value; units in the metadata of each.

    A row group for some thousand points, compressed by zstd.

    Parameters
    ----------
    columns : Columns
        Numbers of all points as columns.
    path : Path
        File to write.
    """
    keys = columns.source.keys
    schema = pyarrow.schema([_field(name, columns) for name in (*STATE, *keys, *columns.names)])
    with (
        atomic_path(path) as temporary,
        pyarrow.parquet.ParquetWriter(temporary, schema, compression="zstd") as writer,
    ):
        for rows, values, kinds in columns.chunks():
            arrays = [
                pyarrow.array([row.number for row in rows], PARQUET_TYPES["int"]),
                pyarrow.array([row.block for row in rows], PARQUET_TYPES["word"]),
                pyarrow.array([row.status for row in rows], PARQUET_TYPES["word"]),
                pyarrow.array([row.converged for row in rows], PARQUET_TYPES["bool"]),
            ]
            for key in keys:
                given = [row.values.get(key) for row in rows]
                arrays.append(_parquet_array(given, columns.kinds[key]))
            for k, name in enumerate(columns.names):
                arrays.append(_numbers(values[:, k], kinds[:, k], columns.kinds[name]))
            writer.write_table(pyarrow.Table.from_arrays(arrays, schema=schema))


def _field(name: str, columns: Columns) -> Any:
    kind = columns.kinds.get(name) or STATE_KINDS[name]
    unit = column_unit(name, columns)
    return pyarrow.field(name, PARQUET_TYPES[kind], metadata={"units": unit} if unit else None)


def _parquet_array(values: list[Any], kind: str) -> Any:
    """Values of a key."""
    if kind == "text":
        texts = [value if isinstance(value, str) else json.dumps(value) for value in values]
        values = [None if value is None else t for value, t in zip(values, texts, strict=True)]
    elif kind == "float":
        values = [None if value is None else float(value) for value in values]
    elif kind == "word":
        values = [None if value is None else str(value) for value in values]
    return pyarrow.array(values, PARQUET_TYPES[kind])


def _numbers(values: Numbers, kinds: Kinds, kind: str) -> Any:
    """A column of numbers, null where a point has none."""
    gaps = np.isnan(values)
    whole = np.where(gaps, 0.0, values)
    types = {"bool": bool, "int": np.int64}
    return pyarrow.array(whole.astype(types.get(kind, float)), PARQUET_TYPES[kind], mask=gaps)
