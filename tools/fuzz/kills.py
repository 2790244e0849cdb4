"""Kill every command at random moments: how long it takes, how it ends, what it leaves behind.

    python tools/fuzz/kills.py --seed 7193 --rounds 20 --only run,slip

Each command is started in a folder of its own and gets SIGINT (alone, or with all its group as from a
terminal), SIGTERM or SIGKILL after a random share of its undisturbed time. A fault is an exit code other than
3 (or 0 and 1, where it was done before), more than `WITHIN` seconds after the signal, a traceback, a process
that goes on, or, but for SIGKILL, a temporary folder that stays.
"""

from __future__ import annotations

import argparse
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

WITHIN = 2.0  # [s] from the signal to the end, on a machine with nothing else to do
HANG = 120.0  # [s]
ROOT = Path(__file__).resolve().parents[2]
PAGE = "tools/verification/run.py"  # a script beside the commands
SWEEP = """case = "6208_full_ceramic"
[fixed]
"ehl.points" = 65
[sweep]
"operation.inner_speed_rpm" = [2500.0, 5000.0, 7500.0, 10000.0]
"operation.radial_load_N" = [900.0, 3000.0]
"""
TORQUE = """case = "6208_full_ceramic"
compute = "torque"
table_points = 65
[sweep]
"operation.radial_load_N" = [900.0, 3000.0]
"""
LARGE = """schema_version = 1
[contact]
load_N = 20.0
radius_x_mm = 12.7
radius_y_mm = 12.7
reduced_modulus_GPa = 220.0
entrainment_speed_m_s = 0.3
[lubricant]
viscosity_mPa_s = 50.0
pressure_viscosity_1_GPa = 18.0
density_kg_m3 = 870.0
[ehl]
points = 1025
"""
COMMANDS = {
    "run": "run 6208_full_ceramic -o out",
    "heat": "run 6208_with_heat -o out",
    "rings": "run 61808_loose_rings -o out",
    "bodies": "run 6208_finite_bodies -o out",
    "contact": "contact large.toml -o out",
    "elements": "contact ball_on_disc --method finite-element -o out",
    "slip": "slip hirano_7000C -o out",
    "dynamics": "dynamics 7008_axial -o out",
    "table": "table 6208_full_ceramic --points 65 -o table.zip",
    "stiffness": "stiffness 6208_full_ceramic --points 1001 -o out",
    "batch": "batch sweep.toml -o out --resume",
    "torque": "batch torque.toml -o out --resume",
    "verify": "verify --quick",
    "page": f"{PAGE} --quick -o out",
    "robustness": f"{PAGE} --robustness 40 --quick --seed 5 -o out",
    "report": "report results",
    "screenshot": "view results --screenshot a.png",
    "movie": "view results --movie a.gif",
    "html": "view results --html a.html",
    "compare": "compare results results",
    "cut": "cut results -o cut.csv",
    "interferogram": "interferogram results -o a.png",
    "export": "export results --format vtu -o a.vtu",
    "list": "list",
    "validate": "validate 6208_full_ceramic",
}
KINDS = ("int", "int group", "term", "kill")


@dataclass(frozen=True)
class Ended:
    """How a command ended after a signal."""

    code: int
    delay: float  # [s] from the signal
    errors: str
    left: tuple[str, ...]
    before: bool  # the signal came too late


def oilfilm(words: str) -> list[str]:
    command, *rest = words.split()
    if command == PAGE:
        return [sys.executable, str(ROOT / PAGE), *rest]
    return [sys.executable, "-m", "oilfilm.cases.cli", command, *rest]


def environment(temporary: Path) -> dict[str, str]:
    return os.environ | {"PYTHONPATH": str(ROOT), "TMPDIR": str(temporary)}


def prepare(folder: Path, results: Path | None) -> None:
    """Input files of all commands, and a temporary folder."""
    (folder / "tmp").mkdir(parents=True)
    for name, text in (("sweep", SWEEP), ("torque", TORQUE), ("large", LARGE)):
        (folder / f"{name}.toml").write_text(text, encoding="utf-8")
    if results is not None:
        shutil.copytree(results, folder / "results")


def alive(group: int) -> list[int]:
    """Processes of a group that still run."""
    found = []
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if int(fields[2]) == group and fields[0] != "Z":
            found.append(int(stat.parent.name))
    return found


def started(words: str, folder: Path, errors: int) -> subprocess.Popen[bytes]:
    """A command in a group of its own; `errors`: where its standard error goes."""
    return subprocess.Popen(
        oilfilm(words),
        cwd=folder,
        env=environment(folder / "tmp"),
        stdout=subprocess.DEVNULL,
        stderr=errors,
        start_new_session=True,
    )


def kill_once(words: str, kind: str, after: float, folder: Path) -> Ended:
    """Start a command, signal it `after` so many seconds, and look how it ends."""
    process = started(words, folder, subprocess.PIPE)
    before = False
    try:
        process.wait(after)
        before = True
    except subprocess.TimeoutExpired:
        number = {"term": signal.SIGTERM, "kill": signal.SIGKILL}.get(kind, signal.SIGINT)
        (os.killpg if kind == "int group" else os.kill)(process.pid, number)
    start = time.monotonic()
    errors = ""
    try:
        process.wait(HANG)
        delay = time.monotonic() - start
        errors = process.communicate(timeout=10.0)[1].decode(errors="replace")
    except subprocess.TimeoutExpired:
        delay = time.monotonic() - start
        errors += " [streams stay open, or it hangs]"
    deadline = time.monotonic() + 5.0
    while (running := alive(process.pid)) and time.monotonic() < deadline:
        time.sleep(0.05)
    left = [f"process {pid}" for pid in running]
    for pid in running:
        os.kill(pid, signal.SIGKILL)
    process.wait()
    if kind != "kill":
        left += [
            f"tmp/{path.name}" for path in (folder / "tmp").iterdir() if not path.name.startswith("oilfilm-kernels")
        ]
        left += [path.name for path in folder.iterdir() if path.name.startswith(".")]
        left += [str(path.relative_to(folder)) for path in folder.rglob("*.part*")]
    return Ended(process.returncode, delay, errors, tuple(left), before)


def faults(ended: Ended, kind: str, within: float) -> list[str]:
    """What is wrong with an end."""
    wrong = []
    wanted = (-signal.SIGKILL,) if kind == "kill" else (3,)
    if ended.code not in (0, 1, *wanted):  # 0 and 1 after SIGKILL: it had ended by itself at that moment
        wrong.append(f"exit code {ended.code}")
    if not ended.before and ended.delay > within:
        wrong.append(f"{ended.delay:.1f} s after the signal")
    if "Traceback" in ended.errors or "Error" in ended.errors or "stay open" in ended.errors:
        wrong.append(f"says {ended.errors[-2000:]!r}")
    if ended.code == 3 and "interrupted" not in ended.errors:
        wrong.append(f"no word of the interrupt: {ended.errors[-300:]!r}")
    return wrong + [f"leaves {name}" for name in ended.left]


def calm(words: str, folder: Path, longest: float | None = None) -> tuple[float, int | None]:
    """Undisturbed time [s] and exit code; None where it takes longer than that [s]."""
    start = time.monotonic()
    process = started(words, folder, subprocess.DEVNULL)
    try:
        code: int | None = process.wait(longest)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        code = None
    return time.monotonic() - start, code


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--seed", type=int, default=7193)
    parser.add_argument("--rounds", type=int, default=8, help="kills of each command")
    parser.add_argument("--only", default=",".join(COMMANDS))
    parser.add_argument("--within", type=float, default=WITHIN)
    parser.add_argument("--results", type=Path, help="a folder of a bearing's results, else computed")
    parser.add_argument("--longest", type=float, default=60.0, help="a command is signalled within so many seconds")
    arguments = parser.parse_args()
    rng = random.Random(arguments.seed)
    with tempfile.TemporaryDirectory(prefix="kills-") as name:
        home = Path(name)
        results = arguments.results
        if results is None:
            prepare(home / "first", None)
            calm("run 6208_full_ceramic -q -o results", home / "first")
            results = home / "first" / "results"
        total = bad = 0
        for command in arguments.only.split(","):
            words = COMMANDS[command]
            prepare(home / command, results)
            whole, code = calm(words, home / command, arguments.longest)
            shutil.rmtree(home / command)
            whole = min(whole, arguments.longest)
            delays = []
            for k in range(arguments.rounds):
                kind = KINDS[k % len(KINDS)]
                folder = home / f"{command}{k}"
                prepare(folder, results)
                after = rng.uniform(0.03, 1.0) * whole
                ended = kill_once(words, kind, after, folder)
                wrong = faults(ended, kind, arguments.within)
                delays += [] if ended.before else [ended.delay]
                total += 1
                bad += bool(wrong)
                for fault in wrong:
                    print(f"{command}: {kind} after {after:.2f} of {whole:.2f} s: {fault}", flush=True)
                shutil.rmtree(folder)
            worst = f"{max(delays):.2f} s" if delays else "too late"
            ends = "goes on" if code is None else f"code {code}"
            print(f"{command}: {ends}, {whole:.1f} s, {arguments.rounds} kills, slowest end {worst}", flush=True)
        print(f"{total} kills, {bad} with faults")
    sys.exit(bad > 0)


if __name__ == "__main__":
    main()
