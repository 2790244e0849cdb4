"""All checks that take longer than `.ci/run` may: `python tools/nightly.py`, some hours on two cores.

    python tools/nightly.py                          # everything, by today's seed
    python tools/nightly.py --only slow --only pages # some of it
    python tools/nightly.py --seed 20261129          # the same draws again
    python tools/nightly.py --list

Each step is a command; its output is a file in DIR (default build/nightly). Steps run one after the other, also after
one that fails. The last lines say which failed; exit code 1 if any did. Install the product first, with its extras
`test` and `browser`, and Chromium (Debian: `apt-get install chromium`), else tests of the live program are skipped.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from datetime import date
from itertools import zip_longest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
NUMBER = re.compile(r"[-+]?\d+(?:\.(\d+))?(?:e[-+]?\d+)?")
CLOSE = 0.01  # relative difference of two printed numbers that is none
# pages whose numbers take minutes, by their generator; those that take seconds are among the tests, and the costs on
# reduced_equations.md are those of a machine
GENERATORS = {
    "cage_stability": "theory/cage_stability.md",
    "measured_bearings": "validation/measured_bearings.md",
    "starvation": "validation/starvation.md",
    "traction_equilibrium": "theory/traction_equilibrium.md",
    "validation_000": "validation/validation_000.md",
    "validation_001": "validation/validation_001.md",
    "validation_002": "validation/validation_002.md",
    "validation_002_vibration": "validation/validation_002_vibration.md",
}


@dataclass(frozen=True)
class Step:
    """A command by its name; it succeeds with exit code 0."""

    name: str
    words: tuple[str, ...]
    what: str


def steps(seed: int, folder: Path) -> tuple[Step, ...]:
    """All steps; commands of Python without the interpreter in front."""
    number = str(seed)
    return (
        Step("slow", ("-m", "pytest", "-n", "auto", "-m", "slow"), "full grids, random draws, browsers, slow pages"),
        Step("verification", ("tools/verification/run.py", "-o", str(folder / "page")), "page of the contact solver"),
        Step(
            "random",
            ("tools/verification/run.py", "--robustness", "300", "--seed", number, "-o", str(folder / "random")),
            "random contacts",
        ),
        Step("pages", (str(Path(__file__).resolve()), "--pages"), "pages whose numbers take minutes"),
        Step("mutants", ("tools/fuzz/mutants.py", "--seed", number), "wrong signs, factors, terms: tests notice"),
        Step("cases", ("tools/fuzz/case_files.py", "--seed", number), "mutated case files"),
        Step("strangers", ("tools/fuzz/strangers.py", "--seed", number), "bearings drawn at random: no law is broken"),
        Step("damaged", ("tools/fuzz/damaged.py", "--seed", number), "damaged files of results"),
        Step("readers", ("tools/fuzz/readers.py", "--seed", number), "bytes changed in every file that is read"),
        Step("disk", ("tools/fuzz/full_disk.py", "-", "--seed", number, "--rounds", "4"), "full disk"),
        Step("kills", ("tools/fuzz/kills.py", "--seed", number), "commands killed at random moments"),
        Step("shards", ("tools/fuzz/shards.py", "--seed", number), "a batch in shards, killed and damaged"),
        Step("install", ("tools/install_matrix.py", "--quick"), "wheel and sdist, newest and lowest dependencies"),
    )


def run(step: Step, folder: Path) -> bool:
    """Run a step; print its outcome and its time."""
    log = folder / f"{step.name}.txt"
    started = time.monotonic()
    with log.open("w", encoding="utf-8") as output:
        command = [sys.executable, *step.words]
        environment = os.environ | {"PYTHONPATH": str(ROOT), "OPENBLAS_NUM_THREADS": "1"}
        code = subprocess.run(command, cwd=ROOT, env=environment, stdout=output, stderr=output, check=False).returncode
    outcome = "ok" if code == 0 else f"code {code}"
    print(f"{step.name}: {outcome}, {time.monotonic() - started:.0f} s, {log}", flush=True)
    return code == 0


def same_line(ours: str, theirs: str) -> bool:
    """Whether two lines agree, numbers to 1 % or to two of the last digit printed."""
    if NUMBER.sub("0", ours) != NUMBER.sub("0", theirs):
        return False
    for a, b in zip(NUMBER.finditer(ours), NUMBER.finditer(theirs), strict=True):
        allowed = max(CLOSE * abs(float(b[0])), 2.0 * 10.0 ** -len(b[1] or ""))
        if abs(float(a[0]) - float(b[0])) > allowed:
            return False
    return True


def copied_tree(folder: Path) -> Path:
    """A copy of the files that git has or does not ignore."""
    names = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    listed = subprocess.run(names, cwd=ROOT, capture_output=True, check=True).stdout.decode().split("\0")
    for name in filter(None, listed):
        if (ROOT / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, folder / name)
    return folder


def changed_pages(generate: Callable[[Path, str], int]) -> Iterator[str]:
    """Faults of pages that are generated anew in a copy of the tree."""
    with tempfile.TemporaryDirectory(prefix="pages-") as name:
        tree = copied_tree(Path(name))
        for script, page in GENERATORS.items():
            if code := generate(tree, script):
                yield f"{script}: code {code}"
            ours = (ROOT / "docs" / page).read_text(encoding="utf-8").splitlines()
            theirs = (tree / "docs" / page).read_text(encoding="utf-8").splitlines()
            for number, (one, other) in enumerate(zip_longest(ours, theirs, fillvalue=""), start=1):
                if not same_line(one, other):
                    yield f"docs/{page}:{number}: {one!r} has become {other!r}"


def generate(tree: Path, script: str) -> int:
    """Run a generator in a copy of the tree."""
    environment = os.environ | {"PYTHONPATH": str(tree), "OMP_NUM_THREADS": "1"}
    command = [sys.executable, f"tools/docs/{script}.py"]
    return subprocess.run(command, cwd=tree, env=environment, check=False).returncode


def main() -> int:
    """Run the chosen steps."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--only", action="append", metavar="NAME", help="a step; may be repeated")
    parser.add_argument("--seed", type=int, default=int(date.today().strftime("%Y%m%d")))
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "build" / "nightly", metavar="DIR")
    parser.add_argument("--list", action="store_true", help="print the steps")
    parser.add_argument("--pages", action="store_true", help="compare the pages that take minutes, here and now")
    chosen = parser.parse_args()
    if chosen.pages:
        faults = list(changed_pages(generate))
        print("\n".join(faults) or "all pages are up to date")
        return bool(faults)
    every = steps(chosen.seed, chosen.output)
    if unknown := set(chosen.only or ()) - {step.name for step in every}:
        parser.error(f"no step {', '.join(sorted(unknown))}; --list has all")
    if chosen.list:
        print("\n".join(f"{step.name:14}{step.what}" for step in every))
        return 0
    chosen.output.mkdir(parents=True, exist_ok=True)
    print(f"seed {chosen.seed}", flush=True)
    failed = [step.name for step in every if step.name in (chosen.only or [step.name]) and not run(step, chosen.output)]
    print(f"failed: {', '.join(failed)}" if failed else "all steps passed")
    return bool(failed)


if __name__ == "__main__":
    sys.exit(main())
