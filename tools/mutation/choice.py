"""The tests that are most likely to notice a change of a line, within a time."""

from __future__ import annotations

import ast
import json
import re
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path, PurePosixPath

from .lines import SET_UP, files_of_tests, place
from .tree import ROOT, modules

START = 1.0  # of a further file of tests: its import and fixtures [s]
FILES = 8  # of tests for one mutant, at most
NAMING = 5  # files of tests that are run whole, where no test is known to execute a line
COMMON = 40  # places that name something, from which its callers are not followed
KEPT = re.compile(r"test_kept\.py::|::test_every_number_is_kept")  # tests that compare all numbers of a result
DEEP = 6  # calls between a kernel and a function that is no kernel


class Choice:
    """Lines, the tests that execute them, and the places that name a function or a constant."""

    def __init__(self, folder: Path) -> None:
        self.records = [json.loads(path.read_text()) for path in sorted(folder.glob("*.json"))]
        known = {record["file"] for record in self.records}
        blank = {"seconds": [0.0], "total": 0.0, "failed": [], "lines": {}}  # of tests that were not watched
        self.records += [blank | {"file": name, "tests": [name]} for name in files_of_tests(ROOT) if name not in known]
        self.lines: dict[tuple[str, str], dict[int, list[int]]] = defaultdict(dict)
        self.words: dict[str, frozenset[str]] = {}
        for number, record in enumerate(self.records):
            for file, lines in record["lines"].items():
                for where, tests in lines.items():
                    self.lines[file, where][number] = tests
        self.named: dict[str, set[tuple[str, int]]] = defaultdict(set)
        self.names_at: dict[tuple[str, int], list[str]] = defaultdict(list)
        for name in modules():
            self._read(name)

    def _read(self, name: str) -> None:
        """Note where a module names what, and which names its statements outside of functions define."""
        tree = ast.parse((ROOT / name).read_text(encoding="utf-8"))
        for node in ast.walk(tree):
            if isinstance(node, ast.Name | ast.Attribute) and isinstance(node.ctx, ast.Load):
                self.named[node.id if isinstance(node, ast.Name) else node.attr].add((name, node.lineno))
        for statement in tree.body:
            for part in [statement, *(statement.body if isinstance(statement, ast.ClassDef) else [])]:
                for line in range(part.lineno, (part.end_lineno or part.lineno) + 1):
                    self.names_at[name, line][:0] = _defined(part)

    def covering(self, file: str, line: int, depth: int = 0) -> dict[int, list[int]]:
        """Tests by file that execute a line, or else what is made of it."""
        where = place(ROOT / file, line)
        direct = self.lines.get((file, "{}+{}".format(*where)), {}) if where else {}
        if direct or depth > DEEP or (where and not file.endswith("_kernels.py")):
            return direct
        found: dict[int, list[int]] = defaultdict(list)
        for name in [where[0].rpartition(".")[2]] if where else self.names_at[file, line]:
            for other in sorted(self.named[name] - {(file, line)}):
                if place(ROOT / other[0], other[1]) not in (None, where) or other[0] != file:
                    for number, tests in self.covering(*other, depth + 1).items():
                        found[number] = list(dict.fromkeys([*found[number], *tests]))
            if found:
                break
        return found

    def tests(self, file: str, line: int, seconds: float) -> tuple[list[str], float]:
        """Names of tests, first those that compare all numbers, then those that are near the module, short ones first;
        and their time without a mutant [s].
        """
        found = self.covering(file, line) or self._by_words(file, line)
        ranked = sorted((self._far(number, tests, file), self._time(number, tests), number)
                        for number, tests in found.items())  # fmt: skip
        near = [row for row in ranked if row[0] <= 0] or ranked[:1]
        order = [*near, *sorted((row for row in ranked if row not in near), key=lambda row: row[1])]
        chosen: list[str] = []
        total = 0.0
        count = 0
        for _, time, number in order:
            if count and (total + time > seconds or count == FILES):
                continue
            chosen += self._names(number, found[number])
            total += time
            count += 1
        return chosen, total

    def _by_words(self, file: str, line: int) -> dict[int, list[int]]:
        """Files of tests, whole, that name the function of a line, or what calls it; else those that are near."""
        where = place(ROOT / file, line)
        names = [where[0].rpartition(".")[2]] if where else self.names_at[file, line]
        weight = 1.0
        points: dict[int, float] = defaultdict(float)
        known: set[str] = set()
        for _ in range(DEEP):
            for number, record in enumerate(self.records):
                points[number] += weight * sum(name in self._words(record["file"]) for name in names)
            known |= set(names)
            places = {use for name in names if len(self.named[name]) < COMMON for use in self.named[name]}
            callers = {found[0].rpartition(".")[2] for at in places if (found := place(ROOT / at[0], at[1]))}
            names = sorted(callers - known)
            weight /= 4.0
        for number, record in enumerate(self.records):
            points[number] += 1.0 - _far(record["file"], file)
        best = sorted((number for number in points if points[number] > 0.0), key=lambda n: (-points[n], n))
        return {number: [SET_UP] for number in best[:NAMING]}

    def _words(self, name: str) -> frozenset[str]:
        """Names in a file of tests."""
        if name not in self.words:
            path = ROOT / name
            text = path.read_text(encoding="utf-8") if path.exists() else ""
            self.words[name] = frozenset(re.findall(r"\w{4,}", text))
        return self.words[name]

    def _run(self, number: int, tests: list[int]) -> list[int]:
        """Tests of a file that are run: those that compare all numbers, where there are some; else the whole file for
        a line that its fixtures execute.
        """
        names = self.records[number]["tests"]
        kept = [test for test, name in enumerate(names) if KEPT.search(name) and (test in tests or SET_UP in tests)]
        return kept or (list(range(len(names))) if SET_UP in tests else tests)

    def _far(self, number: int, tests: list[int], file: str) -> int:
        record = self.records[number]
        exact = any(KEPT.search(record["tests"][test]) for test in self._run(number, tests))
        return -1 if exact else _far(record["file"], file)

    def _time(self, number: int, tests: list[int]) -> float:
        record = self.records[number]
        run = self._run(number, tests)
        fixture = max(record["seconds"], default=0.0) if SET_UP in tests else 0.0  # in the time of its first test
        return float(min(sum(record["seconds"][test] for test in run) + fixture, record["total"])) + START

    def _names(self, number: int, tests: list[int]) -> list[str]:
        record = self.records[number]
        names = [record["tests"][test] for test in self._run(number, tests)]
        return [name for name in names if name not in record["failed"]]


def _defined(node: ast.stmt) -> Iterator[str]:
    match node:
        case ast.ClassDef(name=name) | ast.AnnAssign(target=ast.Name(id=name)):
            yield name
        case ast.Assign(targets=targets):
            yield from (part.id for target in targets for part in ast.walk(target) if isinstance(part, ast.Name))


def _far(test: str, module: str) -> int:
    """0 for tests that lie where the module lies, else 1."""
    folder = PurePosixPath(module).parent.as_posix()
    stem = PurePosixPath(module).stem.strip("_").removesuffix("_kernels")
    where = test.removeprefix("tests/").removeprefix("reference/")
    return 0 if where.startswith(folder + "/") or f"test_{stem}" in where else 1
