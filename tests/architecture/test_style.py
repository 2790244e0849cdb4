"""Order: small folders."""

from __future__ import annotations

from .import_graph import LAYERS, ROOT, names_in
from .sources import nothing

NAMES = 22


def folders():
    """Folders of the product, its data among them."""
    for layer in LAYERS:
        yield ROOT / layer
        yield from (path for path in sorted((ROOT / layer).rglob("*")) if path.is_dir() and path.name != "__pycache__")


def test_folders_are_small():
    sizes = {path.relative_to(ROOT).as_posix(): len(names_in(path)) for path in folders()}
    assert nothing({name: size for name, size in sizes.items() if size > NAMES})
