"""Central film against the size of the box, edge pressure zero and open: `python benchmarks/box.py`.

Mesh size is kept, so that only the box changes; boxes in Hertz semi-axes. As `verification/run.py --section same`.
"""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tools"))  # holds `verification`

from verification.limits import BOX_CONTACTS, BOX_SCALES, box_film


def main():
    """Print one line per contact and kind of edge."""
    print(f"{'contact':40} edge   " + "".join(f"   box x {scale:<5g}" for scale, _ in BOX_SCALES))
    for name in BOX_CONTACTS:
        for is_open in (False, True):
            films = [box_film(name, is_open, scale, points) for scale, points in BOX_SCALES]
            print(f"{name:40} {'open' if is_open else 'zero':5} " + "".join(f"{film:14.5f}" for film in films))


if __name__ == "__main__":
    main()
