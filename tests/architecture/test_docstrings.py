"""Docstrings: every public name has one, and quantities carry their unit in brackets."""

from __future__ import annotations

import ast
import re
from functools import cache

from .sources import FILES, at, layer, nothing, text, tree

PHYSICS = ("ehl", "bearing")
UNIT = re.compile(r"\[[^\]\n]*\]")


@cache
def public():
    """(file, node) for every public function and class of the product."""
    return [
        (name, node)
        for name in FILES
        for node in tree(name).body
        if isinstance(node, ast.FunctionDef | ast.ClassDef) and not node.name.startswith("_")
    ]


def docstring(node):
    return (ast.get_docstring(node) or "").strip()


def label(name, node):
    return f"{at(name, node)} {node.name}"


def returns_numbers(node):
    """Whether the signature promises a number or an array."""
    return isinstance(node, ast.FunctionDef) and node.returns is not None and "float" in ast.unparse(node.returns)


def test_public_names_have_docstrings():
    assert nothing([label(name, node) for name, node in public() if not docstring(node)])


def test_quantities_have_units():
    """A function that returns numbers names a unit, [-] if there is none."""
    quantities = [
        (name, node)
        for name, node in public()
        if layer(name) in PHYSICS and returns_numbers(node) and "_kernels" not in name
    ]
    assert quantities
    assert nothing([label(name, node) for name, node in quantities if not UNIT.search(docstring(node))])


def comments(lines, field):
    """The comment beside a field, and those on lines of their own right above it."""
    first = field.lineno - 1
    while lines[first - 1].lstrip().startswith("#"):
        first -= 1
    return [line.partition("#")[2] for line in lines[first : field.end_lineno]]


def fields_without_unit(name, node):
    """Fields of a class that hold numbers, with a unit neither in their comment nor in its docstring."""
    if UNIT.search(docstring(node)):
        return []
    lines = text(name).splitlines()
    fields = [item for item in node.body if isinstance(item, ast.AnnAssign) and "float" in ast.unparse(item.annotation)]
    return [item for item in fields if not any(map(UNIT.search, comments(lines, item)))]


def test_fields_that_are_numbers_have_units():
    """In the comment beside or above the field, or in the docstring for all of them."""
    offenders = [
        f"{at(name, item)} {node.name}.{item.target.id}"
        for name, node in public()
        if layer(name) in PHYSICS and isinstance(node, ast.ClassDef) and node.decorator_list
        for item in fields_without_unit(name, node)
    ]
    assert nothing(offenders)
