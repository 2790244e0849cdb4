"""Random contacts, untuned: `python benchmarks/robustness.py [draws] [seed] [folder]`.

The sweep of `verification/run.py --robustness`, without pictures: finished contacts are kept in FOLDER/robustness.jsonl
(default: the current folder), and the same command goes on with them. Prints what was not plain, and the tables.
"""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tools"))  # holds `verification`

from verification.page import markdown
from verification.robustness import sweep
from verification.robustness_page import robustness_section
from verification.sections import SWEEP


def progress(done, total, state):
    """A line each ten contacts."""
    if done % 10 == 0:
        print(f"{done} of {total} {state}", file=sys.stderr, flush=True)


def main(draws=300, seed=20261, folder="."):
    """Solve, and print the tables."""
    finished = sweep(int(draws), int(seed), Path(folder) / SWEEP, progress)
    print(markdown("Random contacts", "", [robustness_section(finished, int(seed))]))


if __name__ == "__main__":
    main(*sys.argv[1:])
