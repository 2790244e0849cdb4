"""Docstrings: every public name has one, and quantities carry their unit in brackets."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
LAYERS = ("ehl", "bearing", "postprocess", "cases")
PHYSICS = ("ehl", "bearing")
FUNCTIONS = [
    (path.relative_to(ROOT).as_posix(), node)
    for layer in LAYERS
    for path in sorted((ROOT / layer).rglob("*.py"))
    for node in ast.parse(path.read_text(encoding="utf-8")).body
    if isinstance(node, ast.FunctionDef | ast.ClassDef) and not node.name.startswith("_")
]
UNIT = re.compile(r"\[[^\]\n]*\]")


def returns_numbers(node):
    """Whether the signature promises a number or an array."""
    return isinstance(node, ast.FunctionDef) and node.returns is not None and "float" in ast.unparse(node.returns)


@pytest.mark.parametrize(("path", "node"), FUNCTIONS, ids=lambda x: x if isinstance(x, str) else x.name)
def test_public_names_have_docstrings(path, node):
    assert (ast.get_docstring(node) or "").strip()


QUANTITIES = [
    (path, node)
    for path, node in FUNCTIONS
    if path.startswith(PHYSICS) and returns_numbers(node) and "_kernels" not in path
]


@pytest.mark.parametrize(("path", "node"), QUANTITIES, ids=lambda x: x if isinstance(x, str) else x.name)
def test_quantities_have_units(path, node):
    """A function that returns numbers names a unit, [-] if there is none."""
    assert UNIT.search(ast.get_docstring(node) or "")


DATACLASSES = [
    (path, node)
    for path, node in FUNCTIONS
    if path.startswith(PHYSICS) and isinstance(node, ast.ClassDef) and node.decorator_list
]


@pytest.mark.parametrize(("path", "node"), DATACLASSES, ids=lambda x: x if isinstance(x, str) else x.name)
def test_fields_that_are_numbers_have_units(path, node):
    """In the comment beside the field, or in the docstring for all of them."""
    lines = (ROOT / path).read_text(encoding="utf-8").splitlines()
    fields = [item for item in node.body if isinstance(item, ast.AnnAssign) and "float" in ast.unparse(item.annotation)]
    documented = UNIT.search(ast.get_docstring(node) or "")
    for item in fields:
        beside = UNIT.search(lines[item.lineno - 1].partition("#")[2])
        assert beside or documented, f"{node.name}.{item.target.id} has no unit"
