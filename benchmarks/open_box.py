"""What the constants of the open box decide: `python benchmarks/open_box.py`, each halved and doubled.

Central film, extrapolated from 513 points, over that of the box as it is; the error bar of the mesh alone beside it.
"""

from __future__ import annotations

import sys
from pathlib import Path
from unittest.mock import patch

from oilfilm.ehl import MoesConditions, SolverOptions, solve_contact
from oilfilm.ehl.multigrid import full_multigrid

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tools"))  # holds `verification`

from verification.contacts import OIL

CONTACTS = (  # M, L, Rx/Ry, angle of the entrainment
    (5, 0.5, 1, 0),
    (20, 10, 1, 0),
    (500, 10, 1, 0),
    (12, 25, 0.055, 0),
    (100, 8, 0.05, 0.5),
    (300, 15, 2, 0),
)
PARTS = (("INLET", 0), ("INLET", 1), ("OUTLET", 0), ("OUTLET", 1), ("SIDE", 0), ("SIDE", 1), ("SIDE", 2))


def film(contact):
    """Central film and its error bar."""
    m, l, ratio, angle = contact
    conditions = MoesConditions(
        load_parameter=m, lubricant_parameter=l, radius_ratio=ratio, entrainment_angle=angle, lubricant=OIL
    )
    return solve_contact(conditions, SolverOptions(points=513)).film_central_dimensionless


def main():
    """Print one line per constant: halved and doubled for each contact, the box not widened by the load outside."""
    with patch.object(full_multigrid, "EXTERIOR_FRACTION", 1e9):
        base = [film(contact) for contact in CONTACTS]
        print(f"{'':12}" + "".join(f"{contact!s:>26}" for contact in CONTACTS))
        print(f"{'bar':12}" + "".join(f"{value.relative_uncertainty:26.2%}" for value in base))
        for name, place in PARTS:
            cells = []
            for contact, own in zip(CONTACTS, base, strict=True):
                for factor in (0.5, 2.0):
                    numbers = list(getattr(full_multigrid, name))
                    numbers[place] *= factor
                    with patch.object(full_multigrid, name, tuple(numbers)):
                        cells.append(f"{film(contact).value / own.value - 1.0:+13.2%}")
            print(f"{name} {place:<5}" + "".join(cells), flush=True)


if __name__ == "__main__":
    main()
