"""Names on disk: files of a batch; of points, tables and contacts hashes of all they depend on.

The program is among it, as one word: results of different code never mix.
"""

import hashlib
import json
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from enum import Enum
from functools import cache
from importlib import metadata
from pathlib import Path
from typing import Any

from oilfilm.bearing.library.plugins import plugin_sources

from ..format.changes import case_path

POINTS = "points"
CONTACTS = "contacts"
TABLES = "tables"
FOLDERS = (POINTS, CONTACTS, TABLES)
SWEEP_FILE = "sweep.toml"
SUMMARY = "summary.json"
TABLE = "batch.csv"
DATA = "results.nc"
PARQUET = "batch.parquet"
STORES = "*.sqlite"  # finished points

PACKAGES = ("ehl", "bearing", "postprocess", "cases")
SUFFIXES = (".py", ".npz", ".csv", ".toml")
# no result of a point depends on these: commands, pictures, reports, shipped cases
LEFT_OUT = ("cases/cli", "postprocess/scene", "postprocess/report", "postprocess/compare")
LIBRARY = "cases/library"
CATALOGUE = f"{LIBRARY}/catalogue"  # of it, what cases read
LIBRARIES = ("numpy", "scipy", "numba", "scikit-fem")  # whose versions show in the last digits

# tables of a case that leave its contacts as they are
WITHOUT_CONTACTS = ("surface", "slip", "friction", "cage", "dynamics", "load_cases")
DESCRIBING = ("title", "source", "assumed")  # keys of a case without effect on results
NOT_IN_TRACTION_TABLES = (*DESCRIBING, *WITHOUT_CONTACTS, "ehl")  # likewise, on traction tables


def program_sources() -> Iterator[Path]:
    """Files of the product that results depend on, in a fixed order."""
    root = Path(__file__).parents[2]
    for package in PACKAGES:
        for path in sorted((root / package).rglob("*")):
            name = path.relative_to(root).as_posix()
            if path.suffix in SUFFIXES and not _is_left_out(name):
                yield path


def _is_left_out(name: str) -> bool:
    folders = (*LEFT_OUT, *((LIBRARY,) if not name.startswith(CATALOGUE) else ()))
    return name.startswith(tuple(f"{f}{e}" for f in folders for e in ("/", ".py")))


@cache
def program_digest() -> str:
    """Hexadecimal digest of all sources, data, versions of libraries, and plug-ins, 16 digits."""
    root = Path(__file__).parents[2]
    digest = hashlib.sha256()
    for path in program_sources():
        digest.update(path.relative_to(root).as_posix().encode())
        digest.update(hashlib.sha256(path.read_bytes()).digest())
    digest.update(repr([(name, metadata.version(name)) for name in LIBRARIES]).encode())
    digest.update(plugin_sources())
    return digest.hexdigest()[:16]


def value_in(document: dict[str, Any], key: str) -> Any:
    """Value of a dotted key of a document.

    Parameters
    ----------
    document : dict[str, Any]
        Tables of a case.
    key : str
        Dotted name of the key.

    Returns
    -------
    Any
        The value; None where the document does not have it.
    """
    node: Any = document
    for part in case_path(key):
        if isinstance(part, int):
            inside = isinstance(node, list | tuple) and part < len(node)
            node = node[part] if inside else None
        else:
            node = node.get(part) if isinstance(node, dict) else None
    return node


def digest(*texts: str | bytes) -> str:
    """Hash of texts, or of the content of a file.

    Parameters
    ----------
    *texts : str | bytes
        Texts or bytes, in their order.

    Returns
    -------
    str
        20 hexadecimal digits.
    """
    parts = [text if isinstance(text, bytes) else text.encode() for text in texts]
    return hashlib.sha256(b"\n".join(parts)).hexdigest()[:20]


def document_text(document: dict[str, Any], without: tuple[str, ...] = ()) -> str:
    """A document in one line, equal for equal content.

    Parameters
    ----------
    document : dict[str, Any]
        Tables of a case.
    without : tuple[str, ...], default ()
        Tables and keys of the top level to leave out.

    Returns
    -------
    str
        JSON with sorted keys.
    """
    content = {key: value for key, value in document.items() if key not in without}
    return json.dumps(content, sort_keys=True, ensure_ascii=False, default=str)


def content_key(*objects: Any) -> str:
    """Hash of dataclasses and values to the last bit, and of the program.

    Parameters
    ----------
    *objects : Any
        Dataclasses, arrays, numbers, words and sequences of them.

    Returns
    -------
    str
        32 hexadecimal digits.

    Raises
    ------
    TypeError
        If a value has no defined content.
    """
    return hashlib.sha256(repr([program_digest(), *map(_plain, objects)]).encode()).hexdigest()[
        :32
    ]


def _plain(value: Any) -> Any:
    """The content of a value such that equal text means equal content."""
    if is_dataclass(value):
        content = ((f.name, _plain(getattr(value, f.name))) for f in fields(value))
        return [type(value).__name__, *content]
    if isinstance(value, Enum):
        return [type(value).__name__, value.name]
    if isinstance(value, float):
        return value.hex()
    if isinstance(value, tuple | list):
        return [_plain(item) for item in value]
    if hasattr(value, "tobytes"):
        return [str(value.dtype), value.shape, value.tobytes()]
    if value is None or isinstance(value, str | int | bool):
        return value
    raise TypeError(f"no key for {type(value).__name__}")
