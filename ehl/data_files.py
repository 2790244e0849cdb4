"""Arrays and objects in files: npz without pickle, and JSON.

Objects are dataclasses that the reader expects, found by its own type hints and by nothing in the
file. `foreign_files` says what a file may be.
"""

import io
import json
import types
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from enum import Enum
from functools import lru_cache
from math import prod
from pathlib import Path
from typing import IO, Any, TypeVar, Union, get_args, get_origin, get_type_hints

import numpy as np

from .foreign_files import DAMAGE, DamagedFileError, entries_of, open_file

HEADER = 10_000  # of an array, as NumPy itself allows [bytes]
KINDS = "biufUS"  # of numbers and text; objects are none
T = TypeVar("T")


def read_arrays(path: Path) -> dict[str, Any]:
    """Read the arrays of an npz file.

    Parameters
    ----------
    path : Path
        file to read

    Returns
    -------
    dict[str, Any]
        arrays by their names

    Raises
    ------
    DamagedFileError
        if it is no such file; OSError where it cannot be opened
    """
    with open_file(path) as stream:
        return arrays_of(stream, str(path))


def arrays_of(stream: IO[bytes], name: str) -> dict[str, Any]:
    """Read the arrays of an npz file that is open.

    Parameters
    ----------
    stream : IO[bytes]
        file, open for bytes
    name : str
        name of the file in messages

    Returns
    -------
    dict[str, Any]
        arrays by their names
    """
    try:
        parts = entries_of(stream, name)
        return {key.removesuffix(".npy"): _array(content) for key, content in parts.items()}
    except DamagedFileError:
        raise
    except DAMAGE as problem:
        raise DamagedFileError(f"{name}: damaged ({type(problem).__name__})") from problem


def array_of(content: bytes, name: str) -> Any:
    """The array of an npy file.

    Parameters
    ----------
    content : bytes
        content of the file
    name : str
        name of the file in messages

    Returns
    -------
    Any
        array of numbers or text

    Raises
    ------
    DamagedFileError
        if it is no such file
    """
    try:
        return _array(content)
    except DAMAGE as problem:
        raise DamagedFileError(f"{name}: damaged ({type(problem).__name__})") from problem


def _array(content: bytes) -> Any:
    """An array in NumPy's own format, as long as its header says."""
    stream = io.BytesIO(content)
    read = {
        (1, 0): np.lib.format.read_array_header_1_0,
        (2, 0): np.lib.format.read_array_header_2_0,
    }[np.lib.format.read_magic(stream)]
    shape, by_columns, kind = read(stream, max_header_size=HEADER)
    data = content[stream.tell() :]
    if kind.kind not in KINDS or min(shape, default=0) < 0:
        raise ValueError(f"no numbers: {kind}")
    if len(data) != prod(shape) * kind.itemsize:
        raise ValueError("declares more than it holds")
    array = np.frombuffer(bytearray(data), dtype=kind) if data else np.empty(0, kind)
    return array.reshape(shape, order="F" if by_columns else "C")


def arrays_as_bytes(arrays: Mapping[str, Any]) -> bytes:
    """Arrays as the content of an npz file.

    Parameters
    ----------
    arrays : Mapping[str, Any]
        arrays by their names

    Returns
    -------
    bytes
        content of the file
    """
    stream = io.BytesIO()
    np.savez(stream, **arrays)
    return stream.getvalue()


def object_as_bytes(thing: object, name: str) -> bytes:
    """A dataclass with all it holds as the content of an npz file.

    Parameters
    ----------
    thing : object
        dataclass of numbers, text, arrays, enumerations and such dataclasses
    name : str
        name under which it is asked for later

    Returns
    -------
    bytes
        content of the file
    """
    arrays: dict[str, Any] = {}
    document = json.dumps([name, as_document(thing, arrays)])
    return arrays_as_bytes({"document": np.frombuffer(document.encode(), np.uint8), **arrays})


def read_object(path: Path, kind: type[T]) -> T:
    """Read a dataclass that `object_as_bytes` has written under the stem of the file's name.

    Parameters
    ----------
    path : Path
        file to read
    kind : type[T]
        dataclass expected

    Returns
    -------
    T
        object of this class

    Raises
    ------
    DamagedFileError
        if the file holds none; OSError where it cannot be opened
    """
    arrays = read_arrays(path)
    try:
        name, document = json.loads(arrays.pop("document").tobytes())
        if name != path.stem:
            raise ValueError(f"holds {name}")
        thing: T = from_document(document, kind, arrays)
    except DAMAGE as problem:
        raise DamagedFileError(f"{path}: damaged: {problem}") from problem
    return thing


def as_document(value: Any, arrays: dict[str, Any]) -> Any:
    """A value as JSON takes it: dataclasses as tables that name their class.

    Parameters
    ----------
    value : Any
        dataclass, enumeration, sequence, number, text or array
    arrays : dict[str, Any]
        takes the arrays, which the document refers to by their names

    Returns
    -------
    Any
        document
    """
    if isinstance(value, Enum):
        return value.value
    if is_dataclass(value):
        kind: Any = type(value)
        parts = {name: as_document(getattr(value, name), arrays) for name in _hints(kind)}
        return {"class": kind.__name__, **parts}
    if isinstance(value, tuple | list):
        return [as_document(part, arrays) for part in value]
    if isinstance(value, np.ndarray):
        name = f"array_{len(arrays)}"
        arrays[name] = value
        return {"array": name}
    return value.item() if isinstance(value, np.generic) else value


def from_document(document: Any, hint: Any, arrays: Mapping[str, Any]) -> Any:
    """The inverse of `as_document`; the type hint, not the document, says which classes there are.

    Parameters
    ----------
    document : Any
        document
    hint : Any
        type expected
    arrays : Mapping[str, Any]
        arrays by their names

    Returns
    -------
    Any
        value of this type

    Raises
    ------
    ValueError
        if the document holds something else
    """
    for option in _options(hint):
        origin = get_origin(option) or option
        if isinstance(document, dict):
            if origin is np.ndarray and document.keys() == {"array"}:
                return arrays[document["array"]]
            if is_dataclass(option) and document.get("class") == origin.__name__:
                kind_of = _hints(origin)
                parts = {
                    name: from_document(document[name], kind_of[name], arrays) for name in kind_of
                }
                return origin(**parts)
        elif isinstance(document, list):
            if origin is tuple:
                kinds = get_args(option)
                if kinds[1:] == (...,):
                    kinds = kinds[:1] * len(document)
                pairs = zip(document, kinds, strict=True)
                return tuple(from_document(part, kind, arrays) for part, kind in pairs)
        elif isinstance(option, type) and issubclass(option, Enum):
            if any(document == one.value for one in option):
                return option(document)
        elif type(document) is option or (option is float and type(document) is int):
            return document
    raise ValueError(f"{str(document)[:40]!r} is no {hint}")


def _options(hint: Any) -> tuple[Any, ...]:
    """The types that a hint allows, with the dataclasses derived from them."""
    options = get_args(hint) if get_origin(hint) in (Union, types.UnionType) else (hint,)
    derived = (kind for option in options if is_dataclass(option) for kind in _derived(option))
    return (*options, *derived)


def _derived(kind: Any) -> list[Any]:
    return [own for child in kind.__subclasses__() for own in (child, *_derived(child))]


@lru_cache(maxsize=256)
def _hints(kind: Any) -> dict[str, Any]:
    """Types of the fields of a dataclass, but for those that files have no place for."""
    hints = get_type_hints(kind)
    stored = (field.name for field in fields(kind) if field.metadata.get("stored", True))
    return {name: hints[name] for name in stored}
