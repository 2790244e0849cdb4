"""How long `oilfilm --help` and the imports of the packages take; the least of several processes each."""

from __future__ import annotations

import subprocess
import sys
from time import perf_counter

RUNS = 7
HELP = "import sys; sys.argv = ['oilfilm', '--help']; from oilfilm.cases.cli.start import main; main()"
COMMANDS = {  # code: limit [s]
    "pass": None,
    HELP: 0.15,
    "from oilfilm import ehl": 0.3,
    "from oilfilm import bearing": None,
    "from oilfilm import postprocess, cases": None,
    "from oilfilm.cases import load_case; load_case('6208_full_ceramic')": None,
}


def seconds(code):
    """Shortest wall time of a fresh interpreter that runs a piece of Python [s]."""
    times = []
    for _ in range(RUNS):
        started = perf_counter()
        subprocess.run([sys.executable, "-c", code], check=True, capture_output=True)
        times.append(perf_counter() - started)
    return min(times)


def main():
    """A line for each command; exit code 1 if one takes longer than its limit."""
    slow = False
    for code, limit in COMMANDS.items():
        taken = seconds(code)
        slow |= limit is not None and taken > limit
        print(f"{taken:6.3f} s  limit {limit or '-':>5}  {'oilfilm --help' if code == HELP else code}")
    sys.exit(int(slow))


if __name__ == "__main__":
    main()
