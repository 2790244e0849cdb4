"""The table of a batch as a Parquet file: read by pandas, polars, DuckDB and Spark."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow
import pyarrow.parquet

from bearing.files import atomic_path

from .columns import STATE, STATE_KINDS, Columns, Kinds, Numbers
from .write import column_unit

TYPES = {
    "bool": pyarrow.bool_(),
    "int": pyarrow.int64(),
    "float": pyarrow.float64(),
    "nothing": pyarrow.float64(),
    "word": pyarrow.string(),
    "text": pyarrow.string(),
}


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
                pyarrow.array([row.number for row in rows], TYPES["int"]),
                pyarrow.array([row.block for row in rows], TYPES["word"]),
                pyarrow.array([row.status for row in rows], TYPES["word"]),
                pyarrow.array([row.converged for row in rows], TYPES["bool"]),
            ]
            for key in keys:
                given = [row.values.get(key) for row in rows]
                arrays.append(_array(given, columns.kinds[key]))
            for k, name in enumerate(columns.names):
                arrays.append(_numbers(values[:, k], kinds[:, k], columns.kinds[name]))
            writer.write_table(pyarrow.Table.from_arrays(arrays, schema=schema))


def _field(name: str, columns: Columns) -> Any:
    kind = columns.kinds.get(name) or STATE_KINDS[name]
    unit = column_unit(name, columns)
    return pyarrow.field(name, TYPES[kind], metadata={"units": unit} if unit else None)


def _array(values: list[Any], kind: str) -> Any:
    """Values of a key."""
    if kind == "text":
        texts = [value if isinstance(value, str) else json.dumps(value) for value in values]
        values = [None if value is None else t for value, t in zip(values, texts, strict=True)]
    elif kind == "float":
        values = [None if value is None else float(value) for value in values]
    elif kind == "word":
        values = [None if value is None else str(value) for value in values]
    return pyarrow.array(values, TYPES[kind])


def _numbers(values: Numbers, kinds: Kinds, kind: str) -> Any:
    """A column of numbers, null where a point has none."""
    gaps = np.isnan(values)
    whole = np.where(gaps, 0.0, values)
    types = {"bool": bool, "int": np.int64}
    return pyarrow.array(whole.astype(types.get(kind, float)), TYPES[kind], mask=gaps)
