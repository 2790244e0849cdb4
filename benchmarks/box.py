"""Central film against the size of the box, edge pressure zero and open: `python benchmarks/box.py`.

Mesh size is kept, so that only the box changes; boxes in Hertz semi-axes.
"""

from __future__ import annotations

from ehl import Lubricant, MoesConditions, SolverOptions
from ehl.full_multigrid import ATTEMPTS, Outcome, Progress, contact_multigrid, full_multigrid
from ehl.scaling import scale_contact

OIL = Lubricant(viscosity=0.05, pressure_viscosity=18e-9)
CONTACTS = {"M 20, L 10": (20.0, 10.0, 1.0), "M 5, L 0.5": (5.0, 0.5, 1.0), "M 12, L 25, b/a 6.5": (12.0, 25.0, 0.055)}
BOXES = ((1.0, 65), (2.0, 129), (4.0, 257))  # scale of the box and points that keep the mesh
SMALLEST = {"M 20, L 10": (-3.0, 2.0), "M 5, L 0.5": (-5.0, 3.5), "M 12, L 25, b/a 6.5": (-18.0, 7.0)}


def central_film(name, scale, points, is_open):
    """Central film on the finest grid of a box."""
    m, l, ratio = CONTACTS[name]  # noqa: E741
    conditions = MoesConditions(load_parameter=m, lubricant_parameter=l, radius_ratio=ratio, lubricant=OIL)
    inlet, side = SMALLEST[name]
    box = (scale * inlet, -scale * inlet / 2.0, scale * side)
    options = SolverOptions(points=points, domain=None if is_open else box)
    outcome = Outcome(state=contact_multigrid(scale_contact(conditions), box, options, ATTEMPTS[0]))
    full_multigrid(outcome, options, Progress())
    return outcome.films[-1][0]


def main():
    """Print one line per contact and kind of edge."""
    print("contact               edge   " + "".join(f"   box x {scale:<5g}" for scale, _ in BOXES))
    for name in CONTACTS:
        for is_open in (False, True):
            films = [central_film(name, scale, points, is_open) for scale, points in BOXES]
            print(f"{name:21} {'open' if is_open else 'zero':5} " + "".join(f"{film:14.5f}" for film in films))


if __name__ == "__main__":
    main()
