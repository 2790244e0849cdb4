"""Single wrong signs, factors, exponents, arguments, axes, terms and codes, drawn anew: do the tests notice?

    python tools/fuzz/mutants.py                              100 drawn by today's date
    python tools/fuzz/mutants.py --seed 20261129 --count 300  the same again, and more of them
    python tools/fuzz/mutants.py --only "rating/life.py"      of files whose name holds the text
    python tools/fuzz/mutants.py --words                      by the files of tests that name the function; no lines
    python tools/fuzz/mutants.py --lines                      which tests execute which lines, again where tests changed

Each draw is a module of the product, a kind of change that it allows and a place, each with equal chance; see
tools/mutation. It is applied alone in a temporary copy of the tree, kernels that contain it are compiled anew, and the
quick tests that execute its line are run, the nearest and shortest first, for `--time` seconds in all. "killed": one of
them fails, or they do not end ("no end"), and passes without the change. "survived": all pass, or no test executes it.
The last line has the rate with its 95 % interval (Wilson). DIR (default build/mutants) gets the lines in `lines/` and a
report by seed with the survivors. Exit code 1 if 95 % lies above the interval, or the tests fail without a change.
"""

from __future__ import annotations

import argparse
import ast
import json
import multiprocessing
import random
import runpy
import shutil
import sys
import tempfile
import time
from collections import defaultdict
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import date
from functools import cache
from math import sqrt
from multiprocessing.connection import Connection, wait
from pathlib import Path
from types import CodeType, FunctionType
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from mutation.choice import Choice
from mutation.exchange import exchanged, forget_product
from mutation.lines import files_of_tests, import_product, record
from mutation.mutations import Mutant, mutants
from mutation.tree import LOST, ROOT, Fork, copy_tree, load_libraries, modules

LEAST_SHARE = 0.95  # killed of all
QUANTILE = 1.96  # of a 95 % interval
LONGEST = 60.0  # of a processor, for tests with a mutant, beside `SLOWER` times their time without [s]
SLOWER = 8.0  # [-]
COMPILED = 240.0  # more for kernels that are compiled anew [s]
UNCHANGED = 900.0  # tests without a mutant [s]
PASSED, FAILED = 0, 1  # exit codes of pytest


def wilson(successes: int, count: int) -> tuple[float, float]:
    """Ends of the 95 % interval of a share, Wilson (1927)."""
    if count == 0:
        return 0.0, 1.0
    z, share = QUANTILE, successes / count
    centre = share + z * z / (2.0 * count)
    half = z * sqrt(share * (1.0 - share) / count + z * z / (4.0 * count * count))
    scale = 1.0 + z * z / count
    return (centre - half) / scale, (centre + half) / scale


def draw(seed: int, count: int, only: str) -> list[Mutant]:
    """Mutants of a seed; more of the same seed begin with the same."""
    every: dict[str, dict[str, list[Mutant]]] = {}
    for name in modules():
        kinds = defaultdict(list)
        for mutant in mutants(ROOT / name, name) if only in name else ():
            kinds[mutant.kind].append(mutant)
        if kinds:
            every[name] = kinds
    chance = random.Random(seed)
    found: dict[Mutant, None] = {}
    most = sum(len(group) for kinds in every.values() for group in kinds.values())
    while len(found) < min(count, most):
        kinds = every[chance.choice(sorted(every))]
        found[chance.choice(kinds[chance.choice(sorted(kinds))])] = None
    return list(found)


class Failures:
    """A plugin of pytest that notes which test failed."""

    def __init__(self) -> None:
        self.found: list[str] = []

    def pytest_runtest_logreport(self, report: Any) -> None:
        if report.failed:
            self.found.append(report.nodeid)


class Judge:
    """A copy of the tree in which mutants are applied, one after the other; the product is imported before."""

    def __init__(self, folder: Path, choice: Choice, seconds: float) -> None:
        self.tree = copy_tree(folder)
        import_product(self.tree)
        self.choice = choice
        self.seconds = seconds
        self.sound: dict[str, bool] = {}

    def judge(self, mutant: Mutant) -> dict[str, Any]:
        """What became of a mutant in one word, the test that noticed it, and the time that it took [s]."""
        start = time.monotonic()
        tests, expected = self.choice.tests(mutant.file, mutant.line, self.seconds)
        word, by = self._run(mutant, tests, expected) if tests else ("survived", "no test")
        answer = {"fate": word, "by": by, "tests": len(tests), "seconds": round(time.monotonic() - start, 1)}
        return answer | {"mutant": str(mutant), "file": mutant.file, "line": mutant.line, "kind": mutant.kind}

    def _run(self, mutant: Mutant, tests: list[str], expected: float) -> tuple[str, str]:
        readers = kernels_that_read(mutant.file)
        longest = LONGEST + SLOWER * expected + (COMPILED if readers else 0.0)
        with self._applied(mutant, readers) as functions:

            def plugin() -> Failures:
                """Of the fork: with the change."""
                for function, changed in functions:
                    function.__code__ = changed
                if not functions:
                    forget_product()
                return Failures()

            code, failed = Fork(self.tree, ["-x", *tests], plugin, longest).result()
        if code == PASSED:
            return "survived", ""
        by = failed[:1] if failed else tests
        if code not in (PASSED, FAILED, LOST, None):
            by = tests[:1]  # none was read: an import fails
        if not self._pass(by):
            self.sound.update(dict.fromkeys(by, False))
            rest = [test for test in tests if self.sound.get(test, True)]
            return self._run(mutant, rest, expected) if rest and failed else ("fault", f"fails unchanged: {by[0]}")
        if code is None:
            return "no end", ""
        return "killed", by[0] if code == FAILED else f"pytest ends with {'a crash' if code == LOST else code}"

    def _pass(self, tests: list[str]) -> bool:
        """Whether tests pass without a mutant."""
        if not all(self.sound.get(test, False) for test in tests):
            code, _ = Fork(self.tree, ["-x", *tests], Failures, UNCHANGED).result()
            self.sound.update(dict.fromkeys(tests, code == PASSED))
        return all(self.sound[test] for test in tests)

    @contextmanager
    def _applied(self, mutant: Mutant, readers: tuple[str, ...]) -> Iterator[list[tuple[FunctionType, CodeType]]]:
        """The tree with the mutant, and without the compiled code of kernels that read it; functions and the code that
        it gives them, none where the product has to be imported again.
        """
        path = self.tree / mutant.file
        original = path.with_name(f"{path.name}.original")
        with tempfile.TemporaryDirectory(prefix="kernels-") as name:
            kept = Path(name)
            folders = sorted({(self.tree / reader).parent / "__pycache__" for reader in readers})
            for number, folder in enumerate(folders):
                if folder.exists():
                    shutil.copytree(folder, kept / str(number))
            path.rename(original)
            text = original.read_text(encoding="utf-8")
            path.write_text(mutant.applied(text), encoding="utf-8")
            if readers:
                self._forget(readers)
            try:
                yield [] if readers else exchanged(mutant, text)
            finally:
                original.replace(path)
                for number, folder in enumerate(folders):
                    shutil.rmtree(folder, ignore_errors=True)
                    if (kept / str(number)).exists():
                        shutil.copytree(kept / str(number), folder)

    def _forget(self, readers: tuple[str, ...]) -> None:
        """Drop compiled code; that of other kernels stays, under the new digest of the sources."""
        digest = runpy.run_path(str(self.tree / "ehl" / "kernel_sources.py"))["kernel_digest"]()
        for reader in readers:
            path = self.tree / reader
            for old in (path.parent / "__pycache__").glob(f"{path.stem}.*.nbi"):
                old.unlink()
        for folder in {path.parent for layer in ("ehl", "bearing") for path in (self.tree / layer).rglob("*.nbi")}:
            (folder / f".kernels-{digest}").touch()


@cache
def kernels_that_read(file: str) -> tuple[str, ...]:
    """Files of kernels whose compiled code contains something of a file; none if it is no source of kernels."""
    sources = runpy.run_path(str(ROOT / "ehl" / "kernel_sources.py"))["kernel_sources"]()
    if ROOT / file not in sources:
        return ()
    imports = {path: _imported(path) for path in sources}
    found = {ROOT / file}
    while more := {path for path, read in imports.items() if path not in found and read & found}:
        found |= more
    return tuple(sorted(path.relative_to(ROOT).as_posix() for path in found))


def _imported(path: Path) -> set[Path]:
    """Files from which a file imports."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom):
            words = (node.module or "").split(".")
            base = path.parents[node.level - 1] if node.level else ROOT
            words = words[1:] if not node.level and words[0] == "oilfilm" else words
            found.add(base.joinpath(*words).with_suffix(".py"))
            found |= {base.joinpath(*words, alias.name).with_suffix(".py") for alias in node.names}
    return found


def judge_all(chosen: list[Mutant], choice: Choice, jobs: int, seconds: float) -> Iterator[dict[str, Any]]:
    """Answers as they come; each job has a copy of the tree."""
    context = multiprocessing.get_context("fork")
    ends = []
    for job in range(jobs):
        ours, theirs = context.Pipe(duplex=False)
        process = context.Process(target=_work, args=(chosen[job::jobs], choice, seconds, theirs))
        process.start()
        theirs.close()
        ends.append(ours)
    while ends:
        for end in wait(ends):
            assert isinstance(end, Connection)
            try:
                yield end.recv()
            except EOFError:
                ends.remove(end)


def _work(chosen: list[Mutant], choice: Choice, seconds: float, end: Connection) -> None:
    with tempfile.TemporaryDirectory(prefix="mutants-") as folder:
        load_libraries(Path(folder))
        judge = Judge(Path(folder), choice, seconds)
        for mutant in chosen:
            end.send(judge.judge(mutant))
    end.close()


def record_lines(folder: Path) -> None:
    """Bring the lines of all files of tests up to date, in a process of its own."""
    with tempfile.TemporaryDirectory(prefix="lines-") as name:
        tree = copy_tree(Path(name))
        load_libraries(tree)
        for line in record(tree, folder, files_of_tests(tree), UNCHANGED):
            print(line, flush=True)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=int(date.today().strftime("%Y%m%d")))
    parser.add_argument("--count", type=int, default=100, metavar="N")
    parser.add_argument("--skip", type=int, default=0, metavar="N", help="of the first that are drawn")
    parser.add_argument("--only", default="", metavar="TEXT", help="modules whose name holds a text")
    parser.add_argument("--time", type=float, default=40.0, metavar="S", help="of the tests of a mutant, without it")
    parser.add_argument("--jobs", type=int, default=1, metavar="N")
    parser.add_argument("--lines", action="store_true", help="only find which tests execute which lines")
    parser.add_argument("--words", action="store_true", help="find no lines: tests that name the function, whole files")
    parser.add_argument("--list", action="store_true", help="only print the mutants")
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "build" / "mutants", metavar="DIR")
    arguments = parser.parse_args()
    chosen = draw(arguments.seed, arguments.count, arguments.only)[arguments.skip :]
    print(f"seed {arguments.seed}, {len(chosen)} mutants", flush=True)
    if arguments.list:
        print("\n".join(map(str, chosen)))
        return 0
    lines = arguments.output / "lines"
    child = multiprocessing.get_context("fork").Process(target=record_lines, args=(lines,))
    if not arguments.words:
        child.start()
        child.join()
    if arguments.lines or child.exitcode:
        return child.exitcode or 0
    found = []
    for answer in judge_all(chosen, Choice(lines), arguments.jobs, arguments.time):
        found.append(answer)
        print("{fate:9}{seconds:7.1f} s {mutant}  [{by}]".format(**answer), flush=True)
    return report(found, arguments.output / f"{arguments.seed}.json")


def report(found: list[dict[str, Any]], path: Path) -> int:
    """Print the survivors and the rate; keep all answers in a file."""
    path.write_text(json.dumps(found, indent=1), encoding="utf-8")
    fates = [row["fate"] for row in found]
    faults = fates.count("fault")
    killed, count = fates.count("killed") + fates.count("no end"), len(found) - faults
    low, high = wilson(killed, count)
    print("\nsurvivors:", *(row["mutant"] for row in found if row["fate"] == "survived"), sep="\n")
    endless, survived = fates.count("no end"), fates.count("survived")
    print(
        f"{count} mutants: {killed} killed ({endless} without an end), {survived} survived, "
        f"{faults} not judged; rate {killed / max(count, 1):.1%}, 95 % interval {low:.1%} to {high:.1%}"
    )
    return 0 if high >= LEAST_SHARE and not faults else 1


if __name__ == "__main__":
    sys.exit(main())
