"""Rolling moment of contacts of the ceramic 6208 by open box and mesh: `python benchmarks/rolling_moment.py`.

The box is the solver's choice; its pilot solve is replaced by boxes of our own, on one mesh and on finer ones.
"""

from __future__ import annotations

from unittest.mock import patch

from ehl import SolverOptions, solve_contact
from ehl.scaling import scale_contact
from ehl.traction.rolling_moment import moment_of_doubling, rolling_moment
from verification.contacts import race_6208

HEAVY = [((-4.0 * f, 1.57 * f, 2.88), int(256 * f) + 1) for f in (1, 2, 4)]  # box in semi-axes, points
LIGHT = [((-33.0 * f, 2.2 * f, 14.0 * f), int(128 * f) + 1) for f in (1, 2, 4)]
MESHES = [((-4.0, 1.57, 2.88), points) for points in (129, 257, 513, 1025)]
CONTACTS = (
    ("inner race, 1596 N, boxes", race_6208(1596.3), HEAVY),
    ("inner race, 1596 N, meshes", race_6208(1596.3), MESHES),
    ("outer race, 1612 N, boxes", race_6208(1611.8, outer=True), HEAVY),
    ("outer race, 15.5 N, boxes", race_6208(15.5, outer=True), LIGHT),
)


def main():
    """Moment of the box, beyond it up to the extent, the box's part farther than that, and within the extent [N mm]."""
    print(
        f"{'contact':28}{'inlet a':>9}{'points':>8}"
        + "".join(f"{head:>12}" for head in ("box", "beyond", "farther", "within"))
    )
    for name, conditions, boxes in CONTACTS:
        for box, points in boxes:
            choice = (box, scale_contact(conditions).film_guess)
            with patch("ehl.solver._pilot", lambda contact, progress, choice=choice: choice):
                film = solve_contact(conditions, SolverOptions(points=points))
            found = rolling_moment(film)
            moments = (found.box, found.beyond_box, found.beyond_extent, found.within_extent)
            print(f"{name:28}{-box[0]:9.0f}{points:8}" + "".join(f"{1e3 * moment:12.3f}" for moment in moments))
        print(f"{name:28}  [N mm]; up to twice the distance {1e3 * moment_of_doubling(film):.3f} more\n")


if __name__ == "__main__":
    main()
