"""A finished point of a batch as it is stored: compressed summary, numbers as columns, digest."""

import json
import zlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from hashlib import blake2b
from types import MappingProxyType
from typing import Any

import numpy as np

from .main_results import main_results
from .numbers import scalar_numbers

DONE = "done"
FAILED = "failed"
LOST = "lost"
LEVEL = 3  # of compression: 64 kB of JSON to 8 kB in 0.9 ms, level 6 takes 1.6 ms for 7 % less
BOOL, INTEGER, FLOAT, NOTHING = b"bif-"  # kinds of a number; nothing: null
NO_FILES: Mapping[str, str] = MappingProxyType({})
NO_VALUES: Mapping[str, Any] = MappingProxyType({})


@dataclass(frozen=True, slots=True, kw_only=True)
class Record:
    """A point as bytes and text, so that a digest covers all of it."""

    key: str
    status: str
    message: str = ""
    values: str = "{}"  # of the keys that the sweep varies, as run, JSON
    layout: str = "[]"  # names of the numbers, JSON: main results, then the others
    numbers: bytes = b""  # kinds, a byte each, then values as float64
    summary: bytes = b""  # compressed JSON
    files: str = "{}"  # digests of other files of the point by suffix, JSON

    @property
    def digest(self) -> bytes:
        """Hash of the whole content."""
        texts = (self.key, self.status, self.message, self.values, self.files)
        return content_digest(texts, self.layout, self.numbers, self.summary)


def content_digest(
    texts: tuple[str, str, str, str, str], layout: str, numbers: bytes, summary: bytes
) -> bytes:
    """Hash of the content of a record.

    Parameters
    ----------
    texts : tuple[str, str, str, str, str]
        Key, status, message, values, files.
    layout : str
        Names of the numbers, JSON.
    numbers : bytes
        Kinds and values.
    summary : bytes
        Compressed JSON.

    Returns
    -------
    bytes
        16 bytes.
    """
    return whole_digest(texts, layout, numbers, b"%d %d" % (len(summary), zlib.crc32(summary)))


def whole_digest(
    texts: tuple[str, str, str, str, str], layout: str, numbers: bytes, summary: bytes
) -> bytes:
    """Hash of every byte, as of whole records before 2026-11-25.

    Parameters
    ----------
    texts : tuple[str, str, str, str, str]
        Key, status, message, values, files.
    layout : str
        Names of the numbers, JSON.
    numbers : bytes
        Kinds and values.
    summary : bytes
        Compressed JSON, or its length and checksum.

    Returns
    -------
    bytes
        16 bytes.
    """
    digest = blake2b("\0".join(texts).encode(), digest_size=16, key=_layout_key(layout))
    digest.update(numbers)
    digest.update(summary)
    return digest.digest()


@lru_cache(maxsize=256)
def _layout_key(layout: str) -> bytes:
    """Hash of the names of numbers, which many points have in common."""
    return blake2b(layout.encode(), digest_size=16).digest()


def record_of(
    key: str,
    summary: dict[str, Any],
    values: Mapping[str, Any] = NO_VALUES,
    files: Mapping[str, str] = NO_FILES,
    text: bytes = b"",
) -> Record:
    """Record of a computed point.

    Parameters
    ----------
    key : str
        Name of the point.
    summary : dict[str, Any]
        Summary of the point, plain JSON.
    values : Mapping[str, Any], default NO_VALUES
        Varied keys as run.
    files : Mapping[str, str], default NO_FILES
        Digests of other files of the point, by suffix.
    text : bytes, default b''
        The summary as JSON where it exists already.

    Returns
    -------
    Record
        The record.

    Raises
    ------
    ValueError
        If the summary is no JSON.
    """
    text = text or json.dumps(summary, ensure_ascii=False, allow_nan=False).encode()
    layout, numbers = packed_numbers(summary)
    return Record(
        key=key,
        status=DONE,
        values=json.dumps(dict(values), ensure_ascii=False),
        layout=layout,
        numbers=numbers,
        summary=zlib.compress(text, LEVEL),
        files=json.dumps(dict(files)),
    )


def summary_of(
    record: Record, read: Callable[[bytes], dict[str, Any]] = json.loads
) -> dict[str, Any] | None:
    """Summary of a stored point.

    Parameters
    ----------
    record : Record
        Record of a point.
    read : Callable[[bytes], dict[str, Any]], default json.loads
        Reads JSON.

    Returns
    -------
    dict[str, Any] | None
        The summary; None of a point without a result.
    """
    return read(zlib.decompress(record.summary)) if record.summary else None


def packed_numbers(summary: dict[str, Any]) -> tuple[str, bytes]:
    """Names of the numbers of a point as JSON, main results first, and their kinds and values.

    Parameters
    ----------
    summary : dict[str, Any]
        Summary of the results in named units.

    Returns
    -------
    value
        Names of the numbers, JSON: main results, then the others.
    value
        Kinds, a byte each, then values as float64.
    """
    main = main_results(summary)
    others = scalar_numbers(summary)
    others = {name: value for name, value in others.items() if name not in main}
    numbers = [*main.values(), *others.values()]
    values = np.array([np.nan if value is None else float(value) for value in numbers])
    layout = json.dumps([list(main), list(others)], ensure_ascii=False)
    return layout, bytes(map(_kind, numbers)) + values.astype("<f8").tobytes()


def _kind(value: Any) -> int:
    if value is None:
        return NOTHING
    if isinstance(value, bool):
        return BOOL
    return INTEGER if isinstance(value, int) else FLOAT


def unpacked_numbers(
    numbers: bytes, count: int
) -> tuple[np.ndarray[Any, np.dtype[np.uint8]], np.ndarray[Any, np.dtype[np.float64]]]:
    """Kinds and values of packed numbers.

    Parameters
    ----------
    numbers : bytes
        Packed numbers.
    count : int
        Numbers [-].

    Returns
    -------
    value
        Kinds, shape (count,).
    value
        Values, shape (count,), NaN for null.
    """
    kinds = np.frombuffer(numbers, dtype=np.uint8, count=count)
    return kinds, np.frombuffer(numbers, dtype="<f8", offset=count, count=count)
