"""Certificate of the thermal reduction factors: `python tools/heat/judge.py FILE`, contacts of `solves.py` drawn anew.

Prints the table of `docs/theory/rheology.md`: error of each film by the law against the solved one.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from solves import Label, label, lines

from oilfilm.ehl.closed_form.thermal_reduction import thermal_reductions
from oilfilm.ehl.oil.lubricant import HeatRanges


def row(name: str, labels: list[Label], film: int) -> str:
    """One line of the table."""
    solved = np.array([one.reductions[film] for one in labels])
    groups = np.array([one.groups for one in labels])
    by_law = [pair[film] for pair in thermal_reductions(groups, [HeatRanges()] * len(labels))]
    error = 100.0 * (np.array([one.value for one in by_law]) / solved - 1.0)
    bars = 100.0 * np.array([one.law / one.value for one in by_law])
    size = np.abs(error)
    numbers = (np.sqrt(np.mean(size**2)), np.quantile(size, 0.95), size.max())
    within = (100.0 * np.mean(size < 2.0), 100.0 * np.mean(size < bars))
    words = " | ".join((*(f"{one:.2f}" for one in numbers), *(f"{one:.0f} %" for one in within)))
    return f"| {name} | {len(labels)} | {words} | {np.median(bars):.2f} |"


def main(file: Path) -> None:
    """Print the table."""
    labels = [found for line in lines(file) if (found := label(line)) is not None]
    print("| film | contacts | rms, % | 95 %, % | largest, % | within 2 % | within bar | median bar, % |")
    print("|---|---|---|---|---|---|---|---|")
    for low, high, words in ((0.0, 3.0, "below 3"), (3.0, np.inf, "above 3")):
        some = [one for one in labels if low <= np.exp(one.groups[0]) < high]
        for film, name in enumerate(("central", "minimum", "moment")):
            if some:
                print(row(f"{name}, L_T {words}", some, film))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
