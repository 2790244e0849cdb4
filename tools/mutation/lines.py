"""Lines of the product by the quick tests that execute them: a file of JSON for each file of tests.

Each file of tests runs in a process of its own, so that what many tests share is executed in each. A line is known by
its function and its place in it: changes elsewhere do not move it. Only the process of the test is watched, not those
that it starts. A compiled kernel is executed by the tests of those that call it.
"""

from __future__ import annotations

import ast
import hashlib
import importlib
import json
import sys
import threading
from collections import defaultdict
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from types import CodeType, FrameType
from typing import Any

import pytest

from .tree import Fork, modules

WITHOUT = ("tests/architecture/", "tests/test_", "tests/verification/test_page")  # of texts, not of results
KEPT = 8  # tests of one file that are named for one line, the shortest
SET_UP = -1  # in place of a test: fixtures of the file


@cache
def places(path: Path) -> list[tuple[int, int, str]]:
    """(first line, last line, name) of all functions and methods of a file."""
    found = []
    tree = ast.parse(path.read_text(encoding="utf-8"))
    for node in tree.body:
        for part in node.body if isinstance(node, ast.ClassDef) else [node]:
            if isinstance(part, ast.FunctionDef):
                prefix = f"{node.name}." if isinstance(node, ast.ClassDef) else ""
                found.append((part.lineno, part.end_lineno or part.lineno, prefix + part.name))
    return found


def place(path: Path, line: int) -> tuple[str, int] | None:
    """Name of the function in which a line stands and its number in it; None outside of functions."""
    return next(((name, line - first) for first, last, name in places(path) if first <= line <= last), None)


class Recorder:
    """A plugin of pytest that notes the lines of the product which each test executes."""

    def __init__(self, tree: Path) -> None:
        self.prefixes = tuple(str(tree / name) for name in modules(tree))
        self.files = frozenset(self.prefixes)
        self.root = len(str(tree)) + 1
        self.codes: dict[int, list[Any]] = {}
        self.context = 0
        self.lines: dict[tuple[str, int], set[int]] = {}
        self.tests: dict[str, float] = {}
        self.failed: set[str] = set()
        self.names: list[str] = []
        self.current = SET_UP

    def _watch(self, frame: FrameType, event: str, argument: Any) -> Any:
        code = frame.f_code
        known = self.codes.get(id(code))
        if known is None:
            known = self.codes[id(code)] = [code, code.co_filename in self.files, -1, set()]
        if not known[1]:
            return None
        if known[2] != self.context:
            known[2] = self.context
            known[3] = _lines(code)
        if not known[3]:
            return None
        left, lines, current, name = known[3], self.lines, self.current, code.co_filename

        def line(frame: FrameType, event: str, argument: Any) -> Any:
            if event == "line" and frame.f_lineno in left:
                left.discard(frame.f_lineno)
                lines.setdefault((name, frame.f_lineno), set()).add(current)
                if not left:
                    frame.f_trace_lines = False
            return line

        return line

    def _begin(self, current: int) -> None:
        self.context += 1
        self.current = current
        threading.settrace(self._watch)
        sys.settrace(self._watch)

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtest_setup(self, item: Any) -> None:
        self._begin(SET_UP)

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtest_call(self, item: Any) -> None:
        self.names.append(item.nodeid)
        self._begin(len(self.names) - 1)

    def pytest_runtest_logreport(self, report: Any) -> None:
        sys.settrace(None)
        self.tests[report.nodeid] = self.tests.get(report.nodeid, 0.0) + report.duration
        if not report.passed:
            self.failed.add(report.nodeid)

    @property
    def found(self) -> dict[str, Any]:
        """What is kept of the file of tests."""
        sys.settrace(None)
        seconds = [round(self.tests.get(name, 0.0), 3) for name in self.names]
        lines: dict[str, dict[str, list[int]]] = defaultdict(dict)
        for (path, number), tests in self.lines.items():
            where = place(Path(path), number)
            if where is None:
                continue
            good = [test for test in tests if test == SET_UP or self.names[test] not in self.failed]
            shortest = sorted(good, key=lambda test: seconds[test] if test >= 0 else 0.0)[:KEPT]
            if shortest:
                lines[path[self.root :]]["{}+{}".format(*where)] = shortest
        return {"tests": self.names, "seconds": seconds, "total": round(sum(self.tests.values()), 2), "lines": lines,
                "failed": sorted(self.failed)}  # fmt: skip


def import_name(name: str) -> str:
    """Import name of a file of the product."""
    words = name.removesuffix(".py").removesuffix("/__init__").split("/")
    return ".".join(words if words[0] == "oilfilm" else ["oilfilm", *words])


def import_product(tree: Path) -> None:
    """Import all modules, once for all forks."""
    for name in modules(tree):
        if not name.endswith("__main__.py"):
            importlib.import_module(import_name(name))


@cache
def _all_lines(code: CodeType) -> frozenset[int]:
    return frozenset(number for _, _, number in code.co_lines() if number and number != code.co_firstlineno)


def _lines(code: CodeType) -> set[int]:
    return set(_all_lines(code))


def files_of_tests(root: Path) -> list[str]:
    """Files of tests that look at results, from the root."""
    found = sorted(path.relative_to(root).as_posix() for path in (root / "tests").rglob("test_*.py"))
    return [name for name in found if not name.startswith(WITHOUT)]


def digest(path: Path) -> str:
    """Hexadecimal digest of a file."""
    return hashlib.sha256(path.read_bytes()).hexdigest()[:16]


def record(tree: Path, folder: Path, names: list[str], longest: float) -> Iterator[str]:
    """Run files of tests that are new or have changed; yields a line about each."""
    folder.mkdir(parents=True, exist_ok=True)
    import_product(tree)  # lines of modules are executed by no test of their own
    for name in names:
        target = folder / (name.replace("/", "__") + ".json")
        fresh = digest(tree / name)
        if target.exists() and json.loads(target.read_text())["digest"] == fresh:
            continue
        code, found = Fork(tree, [name], lambda: Recorder(tree), longest).result()
        if not found:
            yield f"{name}: {'no end' if code is None else 'no answer'}"
            continue
        target.write_text(json.dumps({"digest": fresh, "file": name, **found}))
        yield f"{name}: {len(found['tests'])} tests, {found['total']} s, {len(found['failed'])} failed"
