"""Damage files of results at random and hand them to every command that reads them.

    python tools/fuzz/damaged.py --seed 7193 --count 1000

Results of every kind are computed once on coarse grids. Each round truncates, empties, changes, exchanges or
removes one of their files, or changes a value of a JSON file, and calls a command in a process of its own. Right
are exit codes 0, 1 and 2; wrong are 3 and 4, tracebacks, signals, and more than `PATIENCE` seconds.
"""

from __future__ import annotations

import argparse
import io
import json
import os
import random
import shutil
import signal
import sys
import tempfile
import time
from contextlib import redirect_stderr, redirect_stdout
from importlib import import_module
from pathlib import Path

PATIENCE = 120  # [s]
PREPARATION = 900  # for results that are computed first, and kernels that are compiled for them [s]
CASES = {
    "bearing": ("run 6208_full_ceramic", {"points": "65", "film_maps": "[0.0]"}),
    "contact": ("contact ball_on_disc", {"points": "65"}),
    "slip": ("slip hirano_7000C", {"points": "3", "critical_points": "2"}),
    "stiffness": ("stiffness 6208_full_ceramic --points 3", {}),
    "dynamics": ("dynamics 7008_axial", {"end_time_s": "0.003"}),
}
SWEEP = 'case = "209_radial_8900N"\nfields = true\n[sweep]\n"operation.radial_load_N" = [100.0, 200.0]\n'
VALUES = (None, True, -1, 1e308, "x", "", [], {}, [None], {"a": None}, [[1, 2]], "nan", 0)
READERS = {
    "bearing": ("report D", "compare D W", "compare W D", "cut D -o O.csv", "interferogram D -o O.png", "run"),
    "contact": ("report D", "compare D W", "cut D -o O.csv", "interferogram D -o O.png"),
    "slip": ("report D", "compare D W"),
    "stiffness": ("report D", "compare D W"),
    "dynamics": ("report D", "compare D W"),
    "batch": ("report D", "compare D W", "resume", "resume", "diagram D -o O.png"),
}
EXPORTS = ("vtu", "msh", "inp", "xdmf", "xlsx", "pdf")


def call(words: list[str], patience: int = PATIENCE) -> tuple[int, str]:
    """Exit code and messages of a command in a process of its own; minus the signal that ended it."""
    reader, writer = os.pipe()
    child = os.fork()
    if not child:
        os.close(reader)
        signal.signal(signal.SIGALRM, signal.SIG_DFL)  # of the child, whatever its parent does
        signal.alarm(patience)
        code = run(words, writer)
        os._exit(code)
    os.close(writer)
    with os.fdopen(reader, "rb") as stream:
        errors = stream.read().decode(errors="replace")
    _, status = os.waitpid(child, 0)
    return os.waitstatus_to_exitcode(status), errors


def run(words: list[str], writer: int) -> int:
    """The command, its messages sent to a pipe."""
    os.dup2(writer, 2)
    code, errors = answer(words)
    os.write(writer, errors[-8000:].encode())
    return code


def answer(words: list[str]) -> tuple[int, str]:
    """Exit code and messages of a command in this process."""
    from oilfilm.cases.cli.main import app
    from oilfilm.cases.cli.terminal import exit_code

    errors = io.StringIO()
    with redirect_stderr(errors), redirect_stdout(io.StringIO()):
        try:
            code = exit_code(lambda: app(words))
        except SystemExit as stop:
            code = int(stop.code or 0)
    return code, errors.getvalue()


def changed(value: object, rng: random.Random) -> object:
    """A JSON document with one of its values replaced, renamed or left out."""
    if isinstance(value, dict) and value and rng.random() < 0.85:
        key = rng.choice(list(value))
        if rng.random() < 0.1:
            return {name: item for name, item in value.items() if name != key}
        return value | {key: changed(value[key], rng)}
    if isinstance(value, list) and value and rng.random() < 0.85:
        place = rng.randrange(len(value))
        return [*value[:place], changed(value[place], rng), *value[place + 1 :]]
    return rng.choice(VALUES)


def damage(path: Path, others: list[Path], rng: random.Random) -> str:
    """Damage a file in one of several ways, which is returned."""
    data = path.read_bytes()
    kinds = ["truncated", "flipped", "flipped", "emptied", "exchanged", "removed", "folder", "noise"]
    kind = rng.choice(kinds + ["value"] * (8 if path.suffix == ".json" else 0))
    if kind == "value":
        try:
            path.write_text(json.dumps(changed(json.loads(data), rng)), encoding="utf-8")
        except ValueError:
            kind = "truncated"
    if kind == "truncated":
        path.write_bytes(data[: rng.randrange(len(data) + 1)])
    elif kind == "flipped" and data:
        content = bytearray(data)
        for _ in range(rng.choice([1, 3, 30])):
            content[rng.randrange(min(len(content), rng.choice([4096, 10**9])))] ^= 1 << rng.randrange(8)
        path.write_bytes(content)
    elif kind == "emptied":
        path.write_bytes(b"")
    elif kind == "exchanged":
        path.write_bytes(rng.choice(others).read_bytes())
    elif kind == "noise":
        path.write_bytes(rng.randbytes(rng.randrange(5000)))
    elif kind in ("removed", "folder"):
        path.unlink()
        if kind == "folder":
            path.mkdir()
    return kind


def prepare(home: Path) -> None:
    """Results of every kind."""
    from full_disk import shortened

    for name, (words, values) in CASES.items():
        if (home / name).exists():
            continue
        command, case, *rest = words.split()
        (home / f"{case}_{name}.toml").write_text(shortened(case, values), encoding="utf-8")
        code, errors = call(
            [command, str(home / f"{case}_{name}.toml"), *rest, "-q", "-o", str(home / name)], PREPARATION
        )
        if code not in (0, 1):
            sys.exit(f"{words}: {errors}")
    (home / "batch.toml").write_text(SWEEP, encoding="utf-8")
    call(["batch", str(home / "batch.toml"), "-o", str(home / "batch"), "-q", "--workers", "1"], PREPARATION)


def words_of(kind: str, home: Path, folder: Path, rng: random.Random) -> list[str]:
    """A command that reads the damaged folder."""
    words = rng.choice(READERS[kind])
    if words == "resume":
        return ["batch", str(home / "batch.toml"), "-o", str(folder), "--resume", "--workers", "1", "-q"]
    if words == "run":  # into the folder that is there
        return ["run", "209_radial_8900N", "-o", str(folder), "-q"]
    if rng.random() < 0.2:
        suffix = rng.choice(EXPORTS)
        words = f"export D --format {suffix} -o O.{suffix}"
    places = {"D": str(folder), "W": str(home / kind), "O": str(home / "out")}
    return [places.get(word, word.replace("O.", places["O"] + ".")) for word in words.split()]


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--seed", type=int, default=7193)
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--kinds", default=",".join(READERS))
    parser.add_argument("--home", type=Path, help="folder of an earlier call with its results")
    arguments = parser.parse_args()
    rng = random.Random(arguments.seed)
    for name in ("oilfilm.cases.cli.main", "matplotlib.figure", "oilfilm.postprocess.scene.export", "xarray"):
        import_module(name)  # before processes are made
    home = arguments.home or Path(tempfile.mkdtemp(prefix="damaged-"))
    if not (home / "batch").exists():
        home.mkdir(exist_ok=True)
        prepare(home)
    files = [path for kind in READERS for path in (home / kind).rglob("*") if path.is_file()]
    codes: dict[int, int] = {}
    bad = 0
    for number in range(arguments.count):
        kind = rng.choice(arguments.kinds.split(","))
        folder = home / "damaged"
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(home / kind, folder)
        own = [path for path in sorted(folder.rglob("*")) if path.is_file()]
        main_files = [path for path in own if path.suffix in (".json", ".nc", ".zip", ".npz", ".csv")]
        path = rng.choice(main_files if rng.random() < 0.9 else own)
        how = damage(path, files, rng)
        words = words_of(kind, home, folder, rng)
        start = time.monotonic()
        code, errors = call(words)
        codes[code] = codes.get(code, 0) + 1
        if code not in (0, 1, 2) or "Traceback" in errors:
            bad += 1
            log = errors.rpartition("details: ")[2].strip()
            where = Path(log).read_text(encoding="utf-8")[-900:] if Path(log).is_file() else ""
            name = path.relative_to(folder)
            text = (
                f"{number}: {kind}/{name} {how}: {' '.join(words[:3])}: code {code}, {time.monotonic() - start:.0f} s"
            )
            print(f"{text}\n  {errors[-400:].strip()}\n  {where}", flush=True)
    print(f"{arguments.count} damaged files, exit codes {dict(sorted(codes.items()))}, {bad} with faults")
    sys.exit(bad > 0)


if __name__ == "__main__":
    main()
