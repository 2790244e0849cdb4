"""The program that computes, as one word: results of different code never mix."""

import hashlib
from collections.abc import Iterator
from functools import cache
from importlib import metadata
from pathlib import Path

from bearing.library.plugins import plugin_sources

PACKAGES = ("ehl", "bearing", "postprocess", "cases")
SUFFIXES = (".py", ".npz", ".csv", ".toml")
# what no result of a point depends on: commands, pictures, reports, shipped cases
LEFT_OUT = ("cases/cli", "postprocess/scene", "postprocess/report", "postprocess/compare")
LIBRARY = "cases/library"
CATALOGUE = f"{LIBRARY}/catalogue"  # of it, what cases read
LIBRARIES = ("numpy", "scipy", "numba", "scikit-fem")  # whose versions show in the last digits


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
    return name.startswith(tuple(f"{folder}/" for folder in folders))


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
