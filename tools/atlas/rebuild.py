"""The whole film atlas by one command: `python tools/atlas/rebuild.py [missing]`, solves, fits, errors.

A run that was stopped goes on. After the word `missing` contacts whose labels the repository has are not solved again.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

SOLVED = (
    *("heavy 400", "oil 130", "held 150", "start 40", "held oil 80", "light 800", "held light 100", "along 400"),
    *("held along 40", "light oil 130", "light along 360", "held light oil 60", "held light along 40", "rigid 360"),
    *("rigid oil 60", "held rigid 60", "held rigid oil 40", "wide oil 60", "light wide oil 40", "rigid wide oil 20"),
    *("step 70", "step along 120", "skew 480", "skew across 102", "skew oil 60", "held skew 200", "held skew oil 40"),
    *("far 16", "far oil 5", "thick 8", "thick oil 6", "light thick 10", "along oil 14", "light along oil 10"),
    *("held far 8", "held farthest 3", "held thick 8", "held light thick 8", "held along oil 10"),
    "held light along oil 10",
    *("held step 40", "held step oil 40", "held step along 40", "held step along oil 40"),
)


def main() -> None:
    """One script after the other."""
    words = [*sys.argv[1:], *" ".join(SOLVED).split()]
    for name, given in (("solves.py", words), ("fit.py", []), ("skewed.py", [])):
        subprocess.run([sys.executable, str(Path(__file__).with_name(name)), *given], check=True)


if __name__ == "__main__":
    main()
