"""Single wrong signs, factors, units and terms in formulas: do the tests notice?

    PYTHONPATH=. python tools/fuzz/mutants.py
    PYTHONPATH=. python tools/fuzz/mutants.py --only 12 --only 13
    python tools/fuzz/mutants.py --check    whether each old text stands once in its file, in a second

`mutants.toml` holds groups of mutants: the tests to run (arguments of pytest), and file, old text and new text of each
mutant. Each is applied alone in a temporary copy of the tree. Right is a test that fails: "killed". Wrong is
"survived". Tests that do not end within ten times their time without a mutant, and 300 s, are "no end": counted as
killed, and apart. A list that does not fit the tree is a fault of the list: an old text that does not stand exactly
once, tests that fail without a mutant, a mutant that cannot be imported. Exit code 1 if there is such a fault or fewer
than 95 % are killed.
"""

from __future__ import annotations

import argparse
import importlib
import multiprocessing
import os
import shlex
import shutil
import sys
import tempfile
import time
import tomllib
from dataclasses import dataclass
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
LIST = Path(__file__).with_suffix(".toml")
COPIED = "bearing cases docs ehl oilfilm postprocess tests tools pyproject.toml README.md CONTRIBUTING.md".split()
LEAST_SHARE = 0.95  # killed of all
LONGEST = 300.0  # of one run of tests, unless these take more than a tenth of it without a mutant [s]
LONGEST_UNCHANGED = 1800.0  # of one without a mutant [s]
SLOWER = 10.0  # longest run with a mutant over that without [-]
PASSED, FAILED = 0, 1  # exit codes of pytest
BROKEN = 99  # of a run that pytest did not end itself
LIBRARIES = (
    "numpy scipy.optimize scipy.special scipy.sparse.linalg numba pydantic rich.table typer".split()
)  # not plugins of pytest


@dataclass(frozen=True)
class Mutant:
    """One wrong line."""

    number: int
    file: str
    old: str
    new: str
    tests: str


def read_mutants() -> list[Mutant]:
    """All mutants, numbered from 1 as they stand in the list."""
    groups = tomllib.loads(LIST.read_text(encoding="utf-8"))["group"]
    rows = [(*row, group["tests"]) for group in groups for row in group["mutants"]]
    return [Mutant(number, *row) for number, row in enumerate(rows, 1)]


def copy_tree(target: Path) -> None:
    """The tree with its compiled kernels, whose source keeps its time."""
    for name in COPIED:
        source = ROOT / name
        (shutil.copytree if source.is_dir() else shutil.copy2)(source, target / name)


def run_tests(tree: Path, tests: str, longest: float) -> int | None:
    """Exit code of pytest in the copy, in a fork that has the libraries already; None after the longest time [s]."""
    child = multiprocessing.get_context("fork").Process(target=_pytest, args=(tree, shlex.split(tests)))
    child.start()
    child.join(longest)
    if child.is_alive():
        child.kill()
        child.join()
        return None
    return child.exitcode


def _pytest(tree: Path, tests: list[str]) -> None:
    """Of the process of one run: silent, with the copy before the installed packages."""
    os.chdir(tree)
    os.environ["PYTHONPATH"] = str(tree)
    sys.path.insert(0, str(tree))
    silent = os.open(os.devnull, os.O_WRONLY)
    os.dup2(silent, 1)
    os.dup2(silent, 2)
    code = BROKEN  # also where pytest itself fails: the code of an uncaught error would be that of a failed test
    try:
        code = int(pytest.main(["-x", "-q", "-n", "0", "-p", "no:cacheprovider", *tests]))
    finally:
        os._exit(code)


def judge(tree: Path, mutant: Mutant, longest: float) -> str:
    """What became of a mutant in one word, or the fault of the list; `longest` is of its tests [s]."""
    original, path = ROOT / mutant.file, tree / mutant.file
    text = original.read_text(encoding="utf-8")
    if text.count(mutant.old) != 1 or mutant.old == mutant.new:
        return f"fault: the old text stands {text.count(mutant.old)} times, not once"
    path.write_text(text.replace(mutant.old, mutant.new), encoding="utf-8")
    try:
        code = run_tests(tree, mutant.tests, longest)
    finally:
        shutil.copy2(original, path)
    known = {PASSED: "survived", FAILED: "killed", None: "no end"}
    return known.get(code, f"fault: pytest ends with {code}")


def list_faults(mutants: list[Mutant]) -> list[str]:
    """Mutants whose file, test or old text is not in the tree."""
    faults = []
    for mutant in mutants:
        paths = [word.partition("::")[0] for word in shlex.split(mutant.tests) if word.startswith("tests/")]
        faults += [f"{mutant.number}: no file {path}" for path in (mutant.file, *paths) if not (ROOT / path).exists()]
        if (ROOT / mutant.file).exists():
            count = (ROOT / mutant.file).read_text(encoding="utf-8").count(mutant.old)
            if count != 1:
                faults.append(f"{mutant.number}: {mutant.file} has {count} times: {mutant.old}")
    return faults


def judge_group(tree: Path, tests: str, mutants: list[Mutant]) -> list[str]:
    """A word for each of the mutants of the same tests, which have to pass without any of them."""
    start = time.monotonic()
    if run_tests(tree, tests, LONGEST_UNCHANGED) != PASSED:
        print(f"fault: without a mutant these tests do not pass: {tests}", flush=True)
        return ["fault"]
    longest = max(LONGEST, SLOWER * (time.monotonic() - start))
    found = []
    for mutant in mutants:
        found.append(judge(tree, mutant, longest))
        change = " ".join(f"{mutant.old} -> {mutant.new}".split())
        print(f"{mutant.number:3d} {found[-1]:8s} {mutant.file}: {change}", flush=True)
    return found


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", type=int, action="append", metavar="N", help="number of a mutant")
    parser.add_argument("--check", action="store_true", help="only compare the list with the tree")
    arguments = parser.parse_args()
    wanted = arguments.only
    if arguments.check:
        faults = list_faults(read_mutants())
        print("\n".join([*faults, f"{len(read_mutants())} mutants, {len(faults)} faults of the list"]))
        return 1 if faults else 0
    groups: dict[str, list[Mutant]] = {}
    for mutant in read_mutants():
        if not wanted or mutant.number in wanted:
            groups.setdefault(mutant.tests, []).append(mutant)
    sys.dont_write_bytecode = True
    sys.path[:] = [place for place in sys.path if Path(place).resolve() != ROOT]
    for name in LIBRARIES:  # once for all forks; none of our own
        importlib.import_module(name)
    found = []
    with tempfile.TemporaryDirectory(prefix="mutants-") as folder:
        copy_tree(Path(folder))
        for tests, mutants in groups.items():
            found += judge_group(Path(folder), tests, mutants)
    count = sum(map(len, groups.values()))
    hung = found.count("no end")
    killed = found.count("killed") + hung
    survived = found.count("survived")
    faults = sum(word.startswith("fault") for word in found)
    print(f"{count} mutants: {killed} killed ({hung} without an end), {survived} survived, {faults} faults of the list")
    return 0 if killed >= LEAST_SHARE * count and not faults else 1


if __name__ == "__main__":
    sys.exit(main())
