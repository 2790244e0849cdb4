"""What a check looks at: the values of a document that are valid by themselves, and the names it
may use.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from ..format.problems import Problem, nearest_name, shown
from ..format.toml_lines import Path


@dataclass(frozen=True, slots=True)
class Values:
    """The values of a document that are valid by themselves."""

    document: dict[str, Any]
    faulty: frozenset[Path]

    def get(self, *path: str) -> Any:
        """The value at `path`; None if it is left out or faulty."""
        node: Any = self.document
        for depth, key in enumerate(path, 1):
            if path[:depth] in self.faulty or not isinstance(node, dict) or key not in node:
                return None
            node = node[key]
        return node

    def given(self, *path: str) -> bool:
        """Whether the key stands in the document, valid or not."""
        node: Any = self.document
        for key in path:
            if not isinstance(node, dict) or key not in node:
                return False
            node = node[key]
        return True


@dataclass(frozen=True, slots=True)
class Names:
    """The names a case may use."""

    materials: tuple[str, ...]
    lubricants: tuple[str, ...]


def known(path: Path, name: object, names: tuple[str, ...]) -> Iterator[Problem]:
    """Whether a name is one of those known."""
    if isinstance(name, str) and name not in names:
        nearest = nearest_name(name, names)
        listed = "" if nearest else f"allowed: {', '.join(names)}"
        yield Problem(
            path=path, found=f"unknown name {shown(name)}", allowed=listed, nearest=nearest
        )
