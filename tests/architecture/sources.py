"""The product's source files as the tests of this folder read them."""

from __future__ import annotations

import ast
from functools import cache

from .import_graph import LAYERS, ROOT, module_files
from .measures import parsed

FILES = {path.relative_to(ROOT).as_posix(): path for path in module_files().values()}


@cache
def text(name):
    """Contents of a file, named from the root of the repository."""
    return FILES[name].read_text(encoding="utf-8")


@cache
def tree(name):
    """Syntax tree of a file."""
    return parsed(text(name))


def layer(name):
    """Package at the root that a file lies in."""
    return name.partition("/")[0]


def nodes(kind):
    """(file, node) for every node of a kind in the product."""
    return [(name, node) for name in FILES for node in ast.walk(tree(name)) if isinstance(node, kind)]


def at(name, node):
    """Where a node stands, as an editor opens it."""
    return f"{name}:{node.lineno}"


def nothing(offenders):
    """Whether there are no offenders; prints all that there are, which an assertion of a list would cut short."""
    for offender in offenders.items() if isinstance(offenders, dict) else offenders:
        print(offender)
    return not offenders


__all__ = ["FILES", "LAYERS", "ROOT", "at", "layer", "nodes", "nothing", "text", "tree"]
