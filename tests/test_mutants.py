"""The draw of mutants: what is changed, what is left alone, and which tests are chosen."""

from __future__ import annotations

import ast
import importlib
import json
import runpy
from pathlib import Path
from types import SimpleNamespace

import pytest
from mutation.choice import Choice
from mutation.exchange import exchanged
from mutation.lines import place
from mutation.mutations import KINDS, mutants

ROOT = Path(__file__).parents[1]
TOOL = runpy.run_path(str(ROOT / "tools" / "fuzz" / "mutants.py"))


def changes(tmp_path, code):
    """(kind, whole text) of all mutants of a module."""
    path = tmp_path / "module.py"
    path.write_text(code, encoding="utf-8")
    return [(mutant.kind, mutant.applied(code)) for mutant in mutants(path, "module.py")]


@pytest.mark.parametrize(
    ("code", "kind", "changed"),
    [
        ("y = a + b\n", "sign", "y = (a - b)\n"),
        ("y = a + b\n", "term", "y = b\n"),
        ("y = -a\n", "sign", "y = a\n"),
        ("y += a\n", "sign", "y -= a\n"),
        ("y = a * b\n", "factor", "y = (0.5 * (a * b))\n"),
        ("y = 'π' + 2.0 * a**2\n", "factor", "y = 'π' + 4.0 * a**2\n"),
        ("y = a**2\n", "exponent", "y = (a ** 3)\n"),
        ("y = sqrt(a)\n", "exponent", "y = a\n"),
        ("y = f(a, b)\n", "arguments", "y = f(b, a)\n"),
        ("y = a.sum(axis=0)\n", "axis", "y = a.sum(axis=1)\n"),
        ("y = a[:, 0]\n", "axis", "y = a[:, 1]\n"),
        ("y = a < b\n", "comparison", "y = (a > b)\n"),
        ("y = a if b else c\n", "branch", "y = (c if b else a)\n"),
        ("def f():\n    return 1\n", "code", "def f():\n    return 0\n"),
        ("y = inner_load\nz = outer_load\n", "name", "y = outer_load\nz = outer_load\n"),
    ],
)
def test_kinds(tmp_path, code, kind, changed):
    assert (kind, changed) in changes(tmp_path, code)


@pytest.mark.parametrize(
    "code",
    [
        '"""Text 2.0 + a."""\n',
        "def f(a: int = 3) -> list[int]: ...\n",
        "plot(x, linewidth=2.0)\n",
        "axes.set_xlim(-a, 2.0 * b)\n",
        "y = zip(a, b, strict=True)\n",
        "Option = Annotated[float, f(a, b)]\n",
        "TOLERANCE = 1e-6\n",
        "t = perf_counter() - a\n",
    ],
)
def test_left_alone(tmp_path, code):
    assert changes(tmp_path, code) == []


@pytest.mark.slow
def test_every_mutant_of_a_module_is_a_program():
    path = ROOT / "bearing" / "rating" / "life.py"
    text = path.read_text(encoding="utf-8")
    found = mutants(path, "bearing/rating/life.py")
    assert {mutant.kind for mutant in found} >= set(KINDS) - {"axis", "code"}
    for mutant in found:
        assert ast.dump(ast.parse(mutant.applied(text))) != ast.dump(ast.parse(text))


def test_a_seed_draws_the_same_and_more_of_it():
    draw = TOOL["draw"]
    assert draw(70441, 5, "bearing/rating") == draw(70441, 9, "bearing/rating")[:5]
    assert draw(70441, 5, "bearing/rating") != draw(70442, 5, "bearing/rating")


def test_interval():
    """At its ends the share found lies 1.96 standard deviations off, Wilson (1927); they stay within 0 and 1."""
    for end in TOOL["wilson"](42, 65):
        assert abs(42 / 65 - end) == pytest.approx(1.96 * (end * (1.0 - end) / 65) ** 0.5)
    assert TOOL["wilson"](0, 10)[0] == pytest.approx(0.0) and TOOL["wilson"](10, 10)[1] == pytest.approx(1.0)


def test_kernels_that_contain_a_file():
    """A change of an oil's law reaches the simulation; that of its results reaches no kernel."""
    reading = TOOL["kernels_that_read"]
    assert "bearing/dynamics/_motion_kernels.py" in reading("ehl/oil/_kernels.py")
    assert "ehl/oil/_kernels.py" not in reading("bearing/dynamics/_motion_kernels.py")
    assert reading("bearing/rating/life.py") == ()


def test_tests_are_chosen_by_lines(tmp_path):
    """The near and short ones; a kernel has those of the function that calls it."""
    path = ROOT / "bearing" / "rating" / "life.py"
    text = path.read_text(encoding="utf-8").splitlines()
    line = next(n for n, content in enumerate(text, 1) if "limit / load" in content)
    where = "{}+{}".format(*place(path, line))
    for name, seconds in (("tests/bearing/rating/test_life.py", 3.0), ("tests/cases/test_far.py", 0.1)):
        record = {"file": name, "tests": [f"{name}::test_a", f"{name}::test_b"], "seconds": [seconds, 9.0]}
        record |= {"total": 12.0, "failed": [], "lines": {"bearing/rating/life.py": {where: [0]}}}
        (tmp_path / f"{len(name)}.json").write_text(json.dumps(record))
    tests, total = Choice(tmp_path).tests("bearing/rating/life.py", line, seconds=10.0)
    assert tests == ["tests/bearing/rating/test_life.py::test_a", "tests/cases/test_far.py::test_a"]
    assert total == pytest.approx(3.0 + 0.1 + 2.0)


def test_where_no_test_executes_a_line_those_that_name_its_function_are_chosen(tmp_path):
    """Processes of a command are not watched, and statements of a module are executed once: words tell."""
    choice = Choice(tmp_path)
    assert choice.tests("ehl/units.py", 1, seconds=10.0)[0][0].startswith("tests/ehl/")
    path = ROOT / "bearing" / "rating" / "life.py"
    line = next(
        n for n, content in enumerate(path.read_text(encoding="utf-8").splitlines(), 1) if "limit / load" in content
    )
    assert "tests/bearing/rating/test_life.py" in choice.tests("bearing/rating/life.py", line, seconds=10.0)[0]


def test_a_function_is_exchanged_where_it_stands():
    """A property of a class that is imported; a constant of the module is none."""
    path = ROOT / "ehl" / "solution.py"
    text = path.read_text(encoding="utf-8")
    importlib.import_module("oilfilm.ehl.solution")
    mutant = next(one for one in mutants(path, "ehl/solution.py") if "MEAN_PRESSURE_RATIO *" in one.old)
    ((function, code),) = exchanged(mutant, text)
    own = function.__code__
    try:
        before = function(SimpleNamespace(hertz_pressure=3.0))
        function.__code__ = code
        assert function(SimpleNamespace(hertz_pressure=3.0)) != before
    finally:
        function.__code__ = own
    path = ROOT / "bearing" / "torque" / "breakdown.py"
    constant = next(one for one in mutants(path, "bearing/torque/breakdown.py") if place(path, one.line) is None)
    assert exchanged(constant, path.read_text(encoding="utf-8")) == []
