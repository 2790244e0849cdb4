"""Integrity of files of results: a digest of each stands beside them."""

import json
from collections.abc import Iterable
from hashlib import sha256
from pathlib import Path

from bearing.files import write_bytes

DIGESTS = ".oilfilm-digests.json"
PIECE = 2**20  # read at a time [bytes]


def write_digests(folder: Path, names: Iterable[str]) -> None:
    """Record the digests of files.

    Parameters
    ----------
    folder : Path
        Folder of the results.
    names : Iterable[str]
        Names of the files in it.
    """
    digests = {name: file_digest(folder / name) for name in sorted(names)}
    write_bytes(folder / DIGESTS, json.dumps(digests, indent=1).encode())


def file_digest(path: Path) -> str:
    """Hash of the content of a file.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    str
        Hexadecimal digits.
    """
    known = sha256()
    with path.open("rb") as file:
        while piece := file.read(PIECE):
            known.update(piece)
    return known.hexdigest()


def damaged_files(folder: Path) -> list[Path]:
    """Files that have changed since they were written, or are missing.

    Parameters
    ----------
    folder : Path
        Folder of the results.

    Returns
    -------
    list[Path]
        The files; none where there are no digests.
    """
    try:
        digests = json.loads((folder / DIGESTS).read_text(encoding="utf-8"))
        recorded = [(folder / name, digest) for name, digest in digests.items()]
    except (OSError, ValueError, AttributeError, TypeError):
        return []
    return [path for path, digest in recorded if not _is_as_written(path, digest)]


def _is_as_written(path: Path, digest: object) -> bool:
    try:
        return file_digest(path) == digest
    except OSError:
        return False
