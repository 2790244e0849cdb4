"""Cost per unknown from 65 to 2049 points, cycles, memory, all contacts of the 6208: `python benchmarks/scaling.py`.

`verification/run.py --section cost`; times are also given in deflections of the same run. `--quick`: to 257 points.
"""

from __future__ import annotations

import sys
from pathlib import Path

from oilfilm.cases import load_case, run_case

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tools"))  # holds `verification`

from verification.costs import BEARING, costs
from verification.page import markdown


def main(quick):
    """Print the tables."""
    print(markdown("Cost", "", [costs(quick, lambda: run_case(load_case(BEARING)))]))


if __name__ == "__main__":
    main("--quick" in sys.argv[1:])
