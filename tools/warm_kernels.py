"""Compile the kernels of all kinds of work, in two processes side by side: `python tools/warm_kernels.py`.

Each process runs shipped cases on coarse grids and over short times, one after the other, into a temporary folder;
numba keeps what it compiles beside the package, where workers of tests find it. Kernels are compiled for the types of
a call, hence by calls of the product, not by lists of signatures. One process has contacts and films, the other the
motion of bearings: they take about as long, and few kernels are needed by both. Exit code 1 if a command fails.
"""

from __future__ import annotations

import os
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

COARSE = {"points": "65"}
SHORT = {"end_time_s": "0.002", "output_interval_us": "100.0"}
IMPLICIT = {"end_time_s": '0.002\nintegration = "implicit"', "output_interval_us": "100.0"}
TABLE = ("--points", "65", "--tolerance", "0.2")
# command, case, values to replace (and lines to add), further words
Work = tuple[str, str, dict[str, str], tuple[str, ...]]
FILMS: tuple[Work, ...] = (
    ("contact", "ball_on_disc", COARSE, ()),
    ("contact", "ball_on_disc", COARSE, ("--method", "finite-element")),
    ("contact", "squalane_ball_on_disc", COARSE, ()),
    ("contact", "ball_on_disc_starved", COARSE, ()),
    ("contact", "coated_steel", COARSE, ()),
    ("transient", "waviness_ball_on_disc", COARSE | {"passes": "0.1"}, ()),
    ("transient", "dent_with_slip", COARSE, ()),
    ("run", "6208_with_heat", COARSE | {"film_maps": "[0.0]"}, ()),
    ("run", "6208_starved", COARSE | {"film_maps": "[0.0]"}, ()),
    ("table", "6208_with_heat", COARSE, (*TABLE, "--loads", "100,600", "--speeds", "9,15")),
    ("slip", "hirano_7000C", {"points": "3", "critical_points": "2"}, ()),
    ("dynamics", "7008_combined", IMPLICIT, ()),  # here: the other process has more to do
)
MOTION: tuple[Work, ...] = (
    ("dynamics", "7008_axial", SHORT, ()),
    ("dynamics", "7008_combined", SHORT, ()),
    ("dynamics", "6304_planar", SHORT, ()),
    ("vibration", "6208_waviness", {"duration_s": "0.02"}, ()),
    # last, when the other process has compiled the kernels of films
    ("table", "7008_oil", SHORT, (*TABLE, "--loads", "1,150", "--speeds", "2,9")),
    ("dynamics", "7008_oil", SHORT, ()),  # by the table of the line above
)


def shortened(case: str, changes: dict[str, str]) -> str:
    """A shipped case with some values replaced."""
    from oilfilm.cases.format.shipped import shipped_cases

    lines = shipped_cases()[case].read_text(encoding="utf-8").splitlines()
    for key, value in changes.items():
        lines = [f"{key} = {value}" if line.split("=")[0].strip() == key else line for line in lines]
    return "\n".join(lines) + "\n"


def run(works: tuple[Work, ...], folder: Path) -> list[str]:
    """Run commands one after the other in this process; what failed."""
    from typer.testing import CliRunner

    from oilfilm.cases.cli.main import app

    os.chdir(folder)
    failed = []
    for command, case, changes, words in works:
        name = f"{case}.toml"
        Path(name).write_text(shortened(case, changes), encoding="utf-8")
        started = time.monotonic()
        answer = CliRunner().invoke(app, [command, name, "-q", "--json", *words])
        print(f"{command} {case}: code {answer.exit_code}, {time.monotonic() - started:.1f} s", flush=True)
        if answer.exit_code > 1:
            failed.append(f"{command} {case}: {answer.output[-300:]}")
    return failed


def main() -> int:
    """Both processes, each on one core; exit code 1 if a command failed."""
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    pool = ProcessPoolExecutor(2, mp_context=get_context("spawn"))
    with tempfile.TemporaryDirectory(prefix="warm-") as name, pool:
        folders = [Path(name) / part for part in ("films", "motion")]
        for folder in folders:
            folder.mkdir()
        failed = [fault for faults in pool.map(run, (FILMS, MOTION), folders) for fault in faults]
    print("\n".join(failed) or "kernels are compiled")
    return bool(failed)


if __name__ == "__main__":
    sys.exit(main())
