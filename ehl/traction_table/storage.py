"""Traction tables on disk: one npz file with its format, its inputs as text (JSON of the
dataclasses), and SHA-256 digests of inputs and arrays. A file that is no such table, of another
format, damaged, or built for other inputs than requested is refused.
"""

import json
import os
from hashlib import sha256
from pathlib import Path
from typing import IO, Any, get_type_hints

import numpy as np

from ..data_files import arrays_of, as_document, from_document
from ..foreign_files import DAMAGE
from .compression import compressed, decompressed
from .table import TableContact, TableRange, TractionTable

FORMAT = "oilfilm traction table"
# 1 had other coordinates of the motions, 2 neither heat nor full solves beside the films, 3 the
# rolling moment of the solver's box, 4 an Eyring stress without the contact's pressure and a limit
# that no stress came near, 5 values as they stand in memory, 6 few motions near their limits and
# coefficients of splines in place of what they pass through, 7 another packing, 8 moments of spin
# off by up to 15 % in light contacts, whose nodes of low pressure were left out unevenly, 9 names
# of modules for classes
FORMAT_VERSION = 10
ARRAYS = ("axes", "scalars", "values")
PARTS = ("contact", "range", "error", "full_solves")
PLAIN = ("points", "kappa_max", "films", "converged", "message", "spacing")


def inputs_digest(contact: TableContact, limits: TableRange, points: int) -> str:
    """Hash the inputs that a table is built from by SHA-256.

    Parameters
    ----------
    contact : TableContact
        contact of the table
    limits : TableRange
        range of the table
    points : int
        nodes of the films along x [-]

    Returns
    -------
    str
        64 hexadecimal digits
    """
    text = json.dumps([as_document(contact, {}), as_document(limits, {}), points], sort_keys=True)
    return sha256(text.encode()).hexdigest()


def save_table(table: TractionTable, path: Path) -> None:
    """Write a table; the file appears under its name only when it is complete.

    Parameters
    ----------
    table : TractionTable
        table to write
    path : Path
        file to write
    """
    partial = path.with_name(path.name + ".partial")
    with partial.open("wb") as file:
        write_table(table, file)
    os.replace(partial, path)


def write_table(table: TractionTable, file: IO[bytes]) -> None:
    """Write a table to an open file.

    Parameters
    ----------
    table : TractionTable
        table to write
    file : IO[bytes]
        file, open for bytes
    """
    arrays: dict[str, Any] = {name: getattr(table, name) for name in ARRAYS}
    arrays["values"] = compressed(table.values)
    document = {
        "format": FORMAT,
        "format_version": FORMAT_VERSION,
        **{name: as_document(getattr(table, name), {}) for name in PARTS},
        "inputs": inputs_digest(table.contact, table.range, table.points),
        "content": _content(arrays),
        **{name: getattr(table, name) for name in PLAIN},
    }
    document["shape"] = table.values.shape
    np.savez(file, document=np.array(json.dumps(document)), **arrays)


def load_table(path: Path, expected: str | None = None) -> TractionTable:
    """Read a table.

    Parameters
    ----------
    path : Path
        file to read
    expected : str | None, optional
        digest of the inputs that it must be built from; None: any

    Returns
    -------
    TractionTable
        the table

    Raises
    ------
    ValueError
        if the file is no table, of another format, damaged, or built for other inputs
    """
    with path.open("rb") as stream:
        return read_table(stream, str(path), expected)


def read_table(stream: IO[bytes], path: str, expected: str | None = None) -> TractionTable:
    """Read a table from an open file.

    Parameters
    ----------
    stream : IO[bytes]
        file, open for bytes
    path : str
        name of the file in messages
    expected : str | None, optional
        digest of the inputs that it must be built from; None: any

    Returns
    -------
    TractionTable
        the table

    Raises
    ------
    ValueError
        if the file is no table, of another format, damaged, or built for other inputs
    """
    try:
        content = arrays_of(stream, path)
        document = json.loads(str(content["document"]))
        arrays: dict[str, Any] = {name: content[name] for name in ARRAYS}
    except DAMAGE as problem:
        kind = type(problem).__name__
        raise ValueError(f"{path}: no traction table, or a damaged one ({kind})") from problem
    if not isinstance(document, dict) or document.get("format") != FORMAT:
        raise ValueError(f"{path}: no traction table")
    version = document.get("format_version")
    if version != FORMAT_VERSION:
        needed = f"reads {FORMAT_VERSION}; make the table again"
        raise ValueError(f"{path}: format version {version}, this program {needed}")
    try:
        hints = get_type_hints(TractionTable)
        parts = {name: from_document(document[name], hints[name], {}) for name in PARTS}
        values = decompressed(arrays["values"], tuple(document["shape"]))
        plain = {name: document[name] for name in PLAIN}
        spacing = map(float, [*plain["spacing"], 0.0][:3])  # older files have no REST_SHARE
        plain["spacing"] = tuple(spacing)
        table = TractionTable(**parts, **(arrays | {"values": values}), **plain)
    except DAMAGE as problem:
        fault = "damaged, or written by another version of this program"
        raise ValueError(f"{path}: {fault}") from problem
    digest = inputs_digest(table.contact, table.range, table.points)
    if document.get("content") != _content(arrays) or document.get("inputs") != digest:
        raise ValueError(f"{path}: damaged: its content is not what was written")
    if expected is not None and expected != digest:
        fault = "made for another contact, oil, temperature or range; make it again"
        raise ValueError(f"{path}: {fault}")
    return table


def _content(arrays: dict[str, Any]) -> str:
    """Hash the arrays of a file."""
    digest = sha256()
    for name in ARRAYS:
        digest.update(np.ascontiguousarray(arrays[name], dtype="<f8").tobytes())
    return digest.hexdigest()
