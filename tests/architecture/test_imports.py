"""No circles among modules, none among the members of a package, and none hidden in late imports."""

from __future__ import annotations

import ast

from .import_graph import arrows_in, circles, import_graph, imported_modules, module_files, package_circles
from .sources import FILES, at, nodes, nothing, tree
from .test_layers import is_type_checking

LATE = ("cases/cli/",)  # the command line imports what a command needs when it is called


def may_import_late(name):
    return name.startswith(LATE) or name.endswith("__init__.py")


def test_a_circle_is_found():
    graph = {"a": {"b"}, "b": {"c"}, "c": {"b", "d"}, "d": set()}
    assert circles(graph) == [["b", "c"]]
    inside = {"p": {"p.one"}, "p.one": {"p.q.x"}, "p.q": set(), "p.q.x": set(), "p.q.y": {"p.one"}}
    assert circles(inside) == []
    assert package_circles(inside) == {"p": [["one", "q"]]}
    assert arrows_in(["one", "q"], "p", inside) == ["p.one -> p.q.x", "p.q.y -> p.one"]


def test_no_circles_of_modules():
    assert nothing(circles(import_graph()))


def test_no_circles_of_packages():
    """With each subpackage one node, at every level: no arrow runs up."""
    graph = import_graph()
    offenders = [
        (package, circle, arrows_in(circle, package, graph))
        for package, several in package_circles(graph).items()
        for circle in several
    ]
    assert nothing(offenders)


def test_no_late_imports():
    """Inside functions, from the product itself; the command line and the fronts of packages may."""
    files, offenders = module_files(), []
    for module, path in files.items():
        name = next(key for key, value in FILES.items() if value == path)
        if may_import_late(name):
            continue
        for function in ast.walk(tree(name)):
            if isinstance(function, ast.FunctionDef):
                found = imported_modules(function, module, files)
                offenders += [f"{at(name, node)} {other}" for node, other in found]
    assert nothing(sorted(set(offenders)))


def test_no_imports_for_type_checkers_only():
    """A type that would make a circle stands in the wrong module."""
    blocks = [at(name, node) for name, node in nodes(ast.If) if is_type_checking(node) and not may_import_late(name)]
    assert nothing(blocks)
