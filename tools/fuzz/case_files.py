"""Mutate case files at random: `validate` answers each, and `run` does what `validate` promised.

    PYTHONPATH=. python tools/fuzz/case_files.py --seed 7193 --count 10000 --runs 400

The mutations are those of `tests/cases/format/test_fuzz.py`. Each file is validated in this process, which takes a
tenth of a second: right are exit codes 0 and 2, wrong all others, tracebacks and more than `PATIENCE` seconds. Of the
files that are valid so many are run on a coarse grid, with one film or none, in a process of their own: right are
exit codes 0 and 1, and 2 only with words about what no check of a file can know (`LATE`). `--apart` validates in a
process of its own, too, for a file that ends this one.
"""

from __future__ import annotations

import argparse
import random
import signal
import sys
import tempfile
import time
from importlib import import_module
from pathlib import Path

from damaged import PATIENCE, answer, call
from tests.cases.format.test_fuzz import mutated

LATE = ("cannot be written",)
COARSE = {"points": "65", "film_maps": "[0.0]"}


def coarse(text: str, rng: random.Random) -> str:
    """A case on a coarse grid, with one film, or with none in two of three."""
    values = COARSE | ({"film_maps": '"none"'} if rng.random() < 2 / 3 else {})
    lines = []
    for line in text.splitlines():
        key = line.split("=")[0].strip()
        lines.append(f"{key} = {values[key]}" if key in values else line)
    return "\n".join(lines) + "\n"


def fault_of(code: int, errors: str, allowed: tuple[int, ...]) -> str | None:
    """What is wrong with an answer, in words."""
    if code not in allowed:
        return f"exit code {code}"
    return "a traceback" if "Traceback" in errors else None


def too_late(_signal: int, _frame: object) -> None:
    """What the alarm of a validation does."""
    raise RuntimeError(f"more than {PATIENCE} s")


def validated(file: Path, *, apart: bool) -> tuple[int, str]:
    """Exit code and messages of `validate`."""
    if apart:
        return call(["validate", str(file)])
    signal.alarm(PATIENCE)
    found = answer(["validate", str(file)])
    signal.alarm(0)
    return found


def report(number: int, what: str, fault: str, errors: str, file: Path, seconds: float) -> None:
    """Print a fault, the last words of the command, and keep its file."""
    kept = file.with_name(f"{number}_{what}.toml")
    kept.write_text(file.read_text(encoding="utf-8"), encoding="utf-8")
    log = Path(errors.rpartition("details: ")[2].strip() or "none")
    where = log.read_text(encoding="utf-8")[-900:] if log.is_file() else ""
    print(f"{number} {what}: {fault}, {seconds:.0f} s, {kept}\n  {errors[-500:].strip()}\n  {where}", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--seed", type=int, default=7193)
    parser.add_argument("--first", type=int, default=0, help="number of the first file, to go on")
    parser.add_argument("--count", type=int, default=10_000)
    parser.add_argument("--runs", type=int, default=400, help="valid files to run")
    parser.add_argument("--apart", action="store_true", help="validate in a process of its own")
    arguments = parser.parse_args()
    for name in (
        "oilfilm.cases.cli.main",
        "oilfilm.cases.batch.sweep",
        "oilfilm.cases.runs.bearing",
        "oilfilm.cases.runs.contact",
    ):
        import_module(name)  # before processes are made
    signal.signal(signal.SIGALRM, too_late)
    home = Path(tempfile.mkdtemp(prefix="case-files-"))
    file = home / "case.toml"
    codes: dict[str, int] = {}
    ran = bad = 0
    for number in range(arguments.first, arguments.first + arguments.count):
        rng = random.Random(f"{arguments.seed} {number}")
        text = mutated(rng)
        file.write_text(text if rng.random() < 0.5 else coarse(text, rng), encoding="utf-8", newline="")
        start = time.monotonic()
        code, errors = validated(file, apart=arguments.apart)
        codes[f"validate {code}"] = codes.get(f"validate {code}", 0) + 1
        if fault := fault_of(code, errors, (0, 2)):
            bad += 1
            report(number, "validate", fault, errors, file, time.monotonic() - start)
        if code or ran >= arguments.runs:
            continue
        ran += 1
        file.write_text(coarse(text, rng), encoding="utf-8", newline="")
        if call(["validate", str(file), "-q"])[0]:
            continue  # the coarse grid does not fit
        start = time.monotonic()
        command = "contact" if "[contact]" in text else "run"
        code, errors = call([command, str(file), "--json", "-q"])
        codes[f"{command} {code}"] = codes.get(f"{command} {code}", 0) + 1
        allowed = (0, 1, 2) if any(words in errors for words in LATE) else (0, 1)
        if fault := fault_of(code, errors, allowed):
            bad += 1
            report(number, command, fault, errors, file, time.monotonic() - start)
    print(f"{arguments.count} files, {ran} run, exit codes {dict(sorted(codes.items()))}, {bad} with faults")
    sys.exit(bad > 0)


if __name__ == "__main__":
    main()
