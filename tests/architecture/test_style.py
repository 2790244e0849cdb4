"""Air and order: short lines, one statement a line, packages that say what is in them."""

from __future__ import annotations

import ast
import re

import pytest

from .sources import FILES, at, nodes, nothing, text, tree

COLUMNS = 99


def test_lines_are_short():
    offenders = [
        f"{name}:{number} {len(line)} columns"
        for name in FILES
        for number, line in enumerate(text(name).splitlines(), start=1)
        if len(line) > COLUMNS
    ]
    assert nothing(offenders)


def exchanges(targets, values):
    """Whether a value of a parallel assignment needs the old value of another of its targets, as in a, b = b, a."""
    names = [ast.unparse(target) for target in targets]
    for i, value in enumerate(values):
        used = {ast.unparse(node) for node in ast.walk(value) if isinstance(node, ast.expr)}
        if used & {name for j, name in enumerate(names) if j != i}:
            return True
    return False


def form(node):
    """An expression without its names and constants."""
    return type(node).__name__, [form(child) for child in ast.iter_child_nodes(node)]


def alike(values):
    """Whether values are computed and of one form, as the components of a vector are."""
    return not isinstance(values[0], ast.Constant) and all(form(value) == form(values[0]) for value in values)


def may_be_parallel(assignment):
    """Exchanges, and two or three components of one thing."""
    targets = assignment.targets[0].elts
    values = assignment.value.elts
    return exchanges(targets, values) or (len(targets) <= 3 and alike(values))


@pytest.mark.parametrize(
    ("code", "allowed"),
    [
        ("a, b = b, a", True),
        ("a[i], a[j] = a[j], a[i]", True),
        ("old, new = new, f(new)", True),
        ("t_x, t_y = s[0, i], s[1, i]", True),
        ("a, b = 1, 2", False),
        ("self.total, self.done = total, 0", False),
        ("a, b, c, d = e, f, g, h", False),
    ],
)
def test_which_assignments_may_be_parallel(code, allowed):
    (assignment,) = ast.parse(code).body
    assert may_be_parallel(assignment) == allowed


def test_one_assignment_a_statement():
    offenders = [
        f"{at(name, node)} {ast.unparse(node.targets[0])}"
        for name, node in nodes(ast.Assign)
        if isinstance(node.targets[0], ast.Tuple) and isinstance(node.value, ast.Tuple)
        if not may_be_parallel(node)
    ]
    assert nothing(offenders)


def members(package):
    """Modules and subpackages of a package, as its table names them."""
    for path in sorted(package.iterdir()):
        if path.suffix == ".py" and path.name != "__init__.py":
            yield path.stem
        elif path.is_dir() and list(path.glob("*.py")):
            yield path.name


def test_each_package_says_what_its_modules_do():
    """A line for each in the docstring of `__init__`: the name, two spaces, what it is responsible for."""
    offenders = []
    for name, path in FILES.items():
        if path.name == "__init__.py":
            table = ast.get_docstring(tree(name)) or ""
            offenders += [
                f"{name}: {member}"
                for member in members(path.parent)
                if not re.search(rf"^\W*{re.escape(member)}\W*\s(\s|\||-|:)\W*\w", table, re.MULTILINE)
            ]
    assert nothing(offenders)
