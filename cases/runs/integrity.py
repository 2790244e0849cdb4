"""Whether files of results are as they were written: a digest of each stands beside them."""

import json
from collections.abc import Iterable
from hashlib import sha256
from pathlib import Path

from bearing.files import write_bytes

DIGESTS = ".oilfilm-digests.json"
PIECE = 2**20  # read at a time [bytes]


def write_digests(folder: Path, names: Iterable[str]) -> None:
    """Record the digests of files by their names in the folder."""
    digests = {name: file_digest(folder / name) for name in sorted(names)}
    write_bytes(folder / DIGESTS, json.dumps(digests, indent=1).encode())


def file_digest(path: Path) -> str:
    """Hash of the content of a file."""
    known = sha256()
    with path.open("rb") as file:
        while piece := file.read(PIECE):
            known.update(piece)
    return known.hexdigest()


def damaged_files(folder: Path) -> list[Path]:
    """Files that are not as they were written, or gone; none where there are no digests."""
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
