"""Every command that writes, on a disk with too little room or with a limit on the size of files.

    mount -t tmpfs -o size=8m tmpfs /mnt/small
    python tools/fuzz/full_disk.py /mnt/small --seed 7193 --rounds 4

Of the small file system a random part is left free; without one (`-`) the size of each file is limited instead.
Right are exit code 4 with one line about it, or 0 and 1 where it all had room. Wrong are other codes, tracebacks,
messages of libraries, and files left behind.
"""

from __future__ import annotations

import argparse
import random
import resource
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from kills import COMMANDS, PAGE, calm, environment, oilfilm, prepare

SHORT = {
    "run": "run 6208_full_ceramic -o {}/out",
    "bodies": "run 6208_finite_bodies -o {}/out",
    "contact": "contact ball_on_disc -o {}/out",
    "slip": "slip short_slip.toml -o {}/out",
    "dynamics": "dynamics short.toml -o {}/out",
    "table": "table 6208_full_ceramic --points 65 -o {}/table.zip",
    "stiffness": "stiffness 6208_full_ceramic --points 300 -o {}/out",
    "batch": "batch sweep.toml -o {}/out --plot",
    "page": f"{PAGE} --section hertz --quick -o {{}}/out",
    "robustness": f"{PAGE} --robustness 6 --quick --seed 5 -o {{}}/out",
    "report": "report {}/results",
    "screenshot": "view results --screenshot {}/a.png",
    "movie": "view results --movie {}/a.gif",
    "html": "view results --html {}/a.html",
    "cut": "cut results -o {}/cut.csv",
    "interferogram": "interferogram results -o {}/a.png",
    "vtu": "export results --format vtu -o {}/a.vtu",
    "xdmf": "export results --format xdmf -o {}/a.xdmf",
    "inp": "export results --format inp -o {}/a.inp",
    "msh": "export results --format msh -o {}/a.msh",
    "init": "init {}/new.toml",
}


def shortened(case: str, changes: dict[str, str]) -> str:
    """A shipped case with some values replaced."""
    import oilfilm.cases.format.shipped as shipped

    text = shipped.find_case(case).read_text(encoding="utf-8")
    for key, value in changes.items():
        lines = [f"{key} = {value}" if line.split("=")[0].strip() == key else line for line in text.splitlines()]
        text = "\n".join(lines)
    return text + "\n"


def size_of(folder: Path) -> int:
    return sum(path.stat().st_size for path in folder.rglob("*") if path.is_file())


def attempt(words: str, home: Path, disk: Path | None, free: int) -> list[str]:
    """Run a command with so much room [bytes]; what was wrong."""
    target = disk or home / "target"
    target.mkdir(exist_ok=True)
    for old in target.iterdir():
        shutil.rmtree(old) if old.is_dir() else old.unlink()
    if "{}/results" in words:
        shutil.copytree(home / "results", target / "results")
    before = set(target.rglob("*"))
    if disk is not None:
        room = shutil.disk_usage(disk).free - free
        (disk / "filler").write_bytes(b"0" * max(room, 0))
        before.add(disk / "filler")
    limit = None if disk is not None else lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (free, free))
    done = subprocess.run(
        oilfilm(words.format(target)),
        cwd=home,
        env=environment(home / "tmp"),
        capture_output=True,
        text=True,
        errors="replace",
        timeout=600,
        preexec_fn=limit,
        check=False,
    )
    wrong = []
    if done.returncode not in (0, 1, 4):
        wrong.append(f"exit code {done.returncode}: {done.stderr[-400:]!r}")
    if "Traceback" in done.stderr or "HDF5" in done.stderr or "vtk" in done.stderr.lower():
        wrong.append(f"says {done.stderr[-1500:]!r}")
    if done.returncode == 4 and sum("failed" in line for line in done.stderr.splitlines()) != 1:
        wrong.append(f"not one line: {done.stderr[-600:]!r}")
    if done.returncode in (0, 1) and ("No space" in done.stderr or "too large" in done.stderr):
        wrong.append(f"exit code {done.returncode} though: {done.stderr[-400:]!r}")
    hidden = [
        str(path)
        for path in target.rglob(".*")
        if path not in before and not path.name.endswith(("files.json", "digests.json"))
    ]
    return wrong + [f"leaves {hidden[:3]}"] * bool(hidden)


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("disk", help="a folder on a small file system, all of whose files are removed; or -")
    parser.add_argument("--seed", type=int, default=7193)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--only", default=",".join(SHORT))
    parser.add_argument("--results", type=Path)
    arguments = parser.parse_args()
    disk = None if arguments.disk == "-" else Path(arguments.disk)
    rng = random.Random(arguments.seed)
    total = bad = 0
    with tempfile.TemporaryDirectory(prefix="full-disk-") as name:
        home = Path(name) / "home"
        prepare(home, arguments.results)
        if arguments.results is None:
            calm(COMMANDS["run"].replace("-o out", "-q -o results"), home)
        (home / "short.toml").write_text(shortened("7008_axial", {"end_time_s": "0.005"}), encoding="utf-8")
        few = {"points": "5", "critical_points": "3", "points ": "5"}
        (home / "short_slip.toml").write_text(shortened("hirano_7000C", few), encoding="utf-8")
        for command in arguments.only.split(","):
            most = shutil.disk_usage(disk).total if disk else 2_000_000
            for _ in range(arguments.rounds):
                free = int(most * rng.random() ** 3)
                wrong = attempt(SHORT[command], home, disk, free)
                total += 1
                bad += bool(wrong)
                for fault in wrong:
                    print(f"{command} with {free} bytes: {fault}", flush=True)
            print(f"{command}: done", flush=True)
    print(f"{total} runs, {bad} with faults")
    sys.exit(bad > 0)


if __name__ == "__main__":
    main()
