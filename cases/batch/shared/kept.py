"""Things that took long to compute, a file each, named after all that they depend on.

A file holds a digest of its name and content, and arrays and objects of `ehl`, nothing else. It is
read with care: it may come from anywhere, and be damaged.
"""

import pickle
from hashlib import blake2b
from pathlib import Path
from typing import Any

from ..store import write_file

DIGEST = 16  # bytes at the beginning of a file
# what arrays are put together from, beside the classes of `ehl`
ARRAY_CLASSES = frozenset(("_reconstruct", "_frombuffer", "scalar", "ndarray", "dtype"))


class _Reader(pickle.Unpickler):
    """Reads arrays and the classes of `ehl`, nothing else."""

    def find_class(self, module: str, name: str) -> Any:
        found = super().find_class(module, name)
        package = module.partition(".")[0]
        own = package == "ehl" and isinstance(found, type)
        if own or (package == "numpy" and name in ARRAY_CLASSES):
            return found
        raise pickle.UnpicklingError(f"{module}.{name}")


def store_object(path: Path, thing: object) -> int:
    """Write an object to a file, whole or not at all.

    Parameters
    ----------
    path : Path
        The file.
    thing : object
        An object of arrays and of classes of `ehl`.

    Returns
    -------
    int
        Size of the file [bytes].
    """
    data = pickle.dumps(thing)
    write_file(path, _digest(path, data) + data)
    return DIGEST + len(data)


def load_object(path: Path) -> Any:
    """Read an object from a file.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    Any
        The object; None where there is no file, or it is damaged.
    """
    try:
        data = path.read_bytes()
        if _digest(path, data[DIGEST:]) != data[:DIGEST]:
            return None
        with path.open("rb") as stream:
            stream.seek(DIGEST)
            return _Reader(stream).load()
    except Exception:  # of whatever a damaged file makes a reader stumble over
        return None


def _digest(path: Path, data: bytes) -> bytes:
    return blake2b(data, digest_size=DIGEST, key=path.name.encode()[:64]).digest()
