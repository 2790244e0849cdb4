"""Measures of the product that stand in place of caps on lines, arguments and names; each finds a planted fault.

A limit lies at the number measured when it was set, and is lowered with it: it may not lie further than `SLACK` above
the number of today. The aim is where it is to go.
"""

from __future__ import annotations

import ast
from dataclasses import dataclass
from functools import cache

import pytest

from .measures import (
    code_lines,
    documented_functions,
    film_classes,
    fragments,
    import_lines,
    listed_parameters,
    numba_faults,
    only_types,
    parsed,
    without_parameter_list,
)
from .sources import FILES, ROOT, layer, nothing, text, tree

SLACK = 0.02  # of a limit above the measured number


@dataclass(frozen=True)
class Limit:
    """The most that a measure may be today, and the number to reach."""

    most: float
    aim: float

    def allows(self, number):
        """Whether a number is within the limit, and the limit no further above it than the slack or the aim."""
        return number <= self.most <= max(self.aim, (1.0 + SLACK) * number)


CODE_LINES = Limit(most=73_180, aim=45_000)
IMPORT_SHARE = Limit(most=0.0500, aim=0.04)  # of all lines
WITHOUT_PARAMETER_LIST = Limit(most=0, aim=0)  # public functions and methods
FRAGMENTS = Limit(most=0, aim=0)  # docstrings, comments and messages whose first sentence is none
SMALL = 60  # code lines; a module with fewer is part of its reader
FILM_LAYER = "bearing"

# modules below `SMALL` code lines that are neither an `__init__`, nor a `__main__`, nor types alone, by their reason
SMALL_MODULES: dict[str, tuple[str, ...]] = {
    "loaded before anything that takes time": (
        "cases/cli/main.py",
        "ehl/version.py",
        "ehl/kernel_sources.py",
        "ehl/multigrid/threads.py",
    ),
    "apart, so that case files are checked, and the command starts, without solvers": (
        "cases/runs/atlas_contact.py",
        "cases/runs/export.py",
        "bearing/contacts/shape.py",
        "bearing/films/heavy_moment.py",
        "bearing/films/moment.py",
        "bearing/rating/dry_surface.py",
        "ehl/oil/shear_stress.py",
        "ehl/solid/film_conductance.py",
        "ehl/solid/heat.py",
        "ehl/transient/content.py",
    ),
    "the only place of a library": ("bearing/library/media.py", "ehl/compiled.py", "ehl/solid/_kernels.py"),
    "read from everywhere": ("ehl/arrays.py", "bearing/files.py", "postprocess/writer.py"),
    "without what draws": ("postprocess/run_numbers.py",),
    "one block of the results": ("postprocess/bearing/dry.py",),
    "one command": ("cases/cli/verify.py",),
    "formula of a page, written by a tool": ("ehl/atlas/film_formula.py",),
    "mathematics of several tables": ("ehl/traction_table/splines.py",),
}


def named(name, module):
    """The name of a file without its folders."""
    return name.rpartition("/")[2] == module


@cache
def sizes():
    """{file: code lines} of the product."""
    return {name: code_lines(text(name)) for name in FILES}


def test_code_lines():
    """Without docstrings, comments and blank lines."""
    assert CODE_LINES.allows(sum(sizes().values()))


def test_share_of_imports():
    lines = sum(len(text(name).splitlines()) for name in FILES)
    assert IMPORT_SHARE.allows(sum(import_lines(tree(name)) for name in FILES) / lines)


def small_modules():
    """{file: code lines} of the modules that are too small."""
    return {
        name: lines
        for name, lines in sizes().items()
        if lines < SMALL and not named(name, "__init__.py") and not named(name, "__main__.py")
        if not only_types(tree(name))
    }


def test_modules_are_worth_a_file():
    exceptions = {name for names in SMALL_MODULES.values() for name in names}
    offenders = {name: lines for name, lines in small_modules().items() if name not in exceptions}
    assert nothing(offenders)


def test_no_exception_is_stale():
    small = small_modules()
    stale = [name for names in SMALL_MODULES.values() for name in names if name not in small]
    assert nothing(stale)


def test_one_class_for_a_film():
    found = [
        f"{name}:{line} {film}"
        for name in FILES
        if layer(name) == FILM_LAYER
        for line, film in film_classes(tree(name))
    ]
    assert len(found) == 1, found


def public_modules():
    """Modules whose name has no leading underscore; kernels have one."""
    return [name for name in FILES if not name.rpartition("/")[2].startswith("_")]


def test_public_functions_list_their_parameters():
    """Names as in the signature and in its order, by numpydoc."""
    assert any(documented_functions(tree(name)) for name in public_modules())
    offenders = [
        f"{name}:{function.node.lineno} {function.name}: {reason}"
        for name in public_modules()
        for function, reason in without_parameter_list(tree(name))
    ]
    assert WITHOUT_PARAMETER_LIST.allows(len(offenders)) or nothing(offenders)


def test_first_sentences_are_sentences():
    offenders = [f"{name}:{line} {kind}: {first}" for name in FILES for line, kind, first in fragments(text(name))]
    assert FRAGMENTS.allows(len(offenders)) or nothing(offenders)


def test_numba_by_its_documentation():
    """Also where tests compile kernels for all workers."""
    texts = {name: text(name) for name in FILES}
    texts |= {"tests/conftest.py": (ROOT / "tests" / "conftest.py").read_text(encoding="utf-8")}
    offenders = [f"{name}:{line} {used}" for name, code in texts.items() for line, used in numba_faults(parsed(code))]
    assert nothing(offenders)


@pytest.mark.parametrize(
    ("number", "allowed"), [(100, True), (99, True), (97, False), (101, False)], ids=["at", "near", "stale", "above"]
)
def test_a_limit_follows_the_number(number, allowed):
    assert Limit(most=100, aim=50).allows(number) is allowed


def test_a_limit_at_its_aim_is_not_stale():
    assert Limit(most=50, aim=50).allows(12)


@pytest.mark.parametrize(
    ("code", "lines"),
    [
        ("x = 1\n\n# comment\ny = 2  # beside\n", 2),
        ('"""Module.\n\nText.\n"""\nx = 1\n', 1),
        ('def f():\n    """Text."""\n    return (\n        1\n    )\n', 4),
        ('x = """two\nlines"""\n', 2),
    ],
)
def test_code_lines_are_counted(code, lines):
    assert code_lines(code) == lines


def test_import_lines_are_counted():
    code = "import a\nfrom b import (\n    c,\n    d,\n)\nx = 1\ndef f():\n    import e\n"
    assert import_lines(ast.parse(code)) == 6


@pytest.mark.parametrize(
    ("code", "types"),
    [("class A:\n    x: int\n", True), ("class A:\n    x: int\ndef f(): pass\n", False), ("X = 1\n", False)],
)
def test_modules_of_types_are_known(code, types):
    assert only_types(ast.parse(code)) is types


LISTED = """
Sum.

Parameters
----------
a, b : float
    Terms [m].
*more : float
    Further terms [m].

Returns
-------
float
"""


def function(arguments, docstring, name="f", decorator=""):
    return f"{decorator}def {name}({arguments}):\n    '''{docstring}'''\n"


@pytest.mark.parametrize(
    ("code", "faults"),
    [
        (function("a, b, *more", LISTED.replace("\n", "\n    ")), 0),
        (function("a, c, *more", LISTED.replace("\n", "\n    ")), 1),
        (function("b, a, *more", LISTED.replace("\n", "\n    ")), 1),
        (function("a, b", LISTED.replace("\n", "\n    ")), 1),
        (function("a", "Text."), 1),
        ("def f(a):\n    pass\n", 1),
        (function("", "Text."), 0),
        (function("a", "Text.", name="_f"), 0),
        (function("a", "Text.", decorator="@app.command()\n"), 0),
        ("class A:\n    def f(self):\n        pass\n", 0),
        ("class A:\n    def f(self, a):\n        pass\n", 1),
        ("class A:\n    @staticmethod\n    def f(a):\n        pass\n", 1),
        ("class A:\n    @classmethod\n    def f(cls):\n        pass\n", 0),
        ("class _A:\n    def f(self, a):\n        pass\n", 0),
    ],
)
def test_parameter_lists_are_compared_with_the_signature(code, faults):
    assert len(list(without_parameter_list(ast.parse(code)))) == faults


def test_parameters_are_read_from_their_section():
    assert listed_parameters("Text.") is None
    assert listed_parameters(
        "Sum.\n\nParameters\n----------\na, b : float\n    A [m].\nc\n\nNotes\n-----\nd : e\n"
    ) == ("a", "b", "c")


@pytest.mark.parametrize(
    ("code", "kinds"),
    [
        ('"""What the total is."""\n', ["docstring"]),
        ('def f():\n    """Of the address space."""\n', ["docstring"]),
        ('class A:\n    """As `B`, in SI."""\n', ["docstring"]),
        ("# whether it converged\nx = 1\n", ["comment"]),
        ("# Load of the ball,\n# that of the ring\nx = 1\n", []),
        ("x = 1  # of the ring\n", []),
        ('x = """\n# what stands in a string\n"""\n', []),
        ('raise ValueError("Those that stand here are wrong")\n', ["message"]),
        ('say(f"of unfinished maps {n} are kept")\n', ["message"]),
        ('messages.append("Why this is so, nobody knows")\n', ["message"]),
        ('raise ValueError("points must be 2^k + 1")\n', []),
        ('"""Assemble the matrix; that of the ring too."""\n', []),
        ('"""Whatever follows is a sentence."""\n', []),
    ],
)
def test_fragments_are_found(code, kinds):
    assert [kind for _, kind, _ in fragments(code)] == kinds


@pytest.mark.parametrize(
    ("code", "names"),
    [
        ("from numba import njit, prange\n", []),
        ("from numba.extending import overload\n", []),
        ("from numba.core import cgutils\n", ["numba.core.cgutils"]),
        ("import numba.core.dispatcher\n", ["numba.core.dispatcher"]),
        ("from numba.core.dispatcher import Dispatcher\n", ["numba.core.dispatcher.Dispatcher"]),
        ("from numba.extending import infer_getattr\n", ["numba.extending.infer_getattr"]),
        ("import numba\nk = numba.core.types\n", ["numba.core"]),
        ("njit(_nrt=False)\n", ["_nrt"]),
        ('options = {"no_cfunc_wrapper": True}\n', ["no_cfunc_wrapper"]),
        ("kernel.targetoptions\n", ["targetoptions"]),
    ],
)
def test_what_numba_does_not_document_is_found(code, names):
    assert [name for _, name in numba_faults(ast.parse(code))] == names


def test_film_classes_are_found():
    code = (
        "class ContactFilm:\n    pass\nclass FilmValue:\n    pass\nclass _OwnFilm:\n    pass\nclass Films:\n    pass\n"
    )
    assert [name for _, name in film_classes(ast.parse(code))] == ["ContactFilm"]
