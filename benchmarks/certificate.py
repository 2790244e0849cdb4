"""Newton steps from solved contacts, from unsolved ones and from a Hertz pressure:
`python benchmarks/certificate.py [points ...]`.

Per contact and start: what the cycles took and left, what Newton's method took, and what it changed. One deflection
is one FFT forward and back on the finest grid.
"""

from __future__ import annotations

import sys
import time
from math import radians

from ehl import ContactConditions, Lubricant, MoesConditions, SolverOptions
from ehl.multigrid.cycle import relative_residual, start_level, update_film
from ehl.multigrid.full_multigrid import ATTEMPTS
from ehl.multigrid.history import central_film, film_values
from ehl.multigrid.newton import certify
from ehl.solver import solve_attempts

OIL = Lubricant(viscosity=0.04, pressure_viscosity=22e-9, roelands_z=0.68)
SKEWED_OIL = Lubricant(viscosity=0.04, pressure_viscosity=20.35e-9, roelands_z=0.6256)


def moes(load, lubricant, ratio=1.0, angle=0.0, oil=OIL):
    """Conditions by Moes' groups; the angle in degrees."""
    return MoesConditions(
        load_parameter=load,
        lubricant_parameter=lubricant,
        radius_ratio=ratio,
        entrainment_angle=radians(angle),
        lubricant=oil,
    )


CONTACTS = {
    "M 20, L 10": moes(20.0, 10.0),
    "M 200, L 10": moes(200.0, 10.0),
    "M 1000, L 10": moes(1000.0, 10.0),
    "M 50, L 0": moes(50.0, 0.0),
    "M 50, L 0.5": moes(50.0, 0.5),
    "M 500, L 15, Rx/Ry 0.1": moes(500.0, 15.0, 0.1),
    "turning": ContactConditions(
        load=50.0,
        radius_x=0.006,
        radius_y=0.03,
        reduced_modulus=226e9,
        entrainment_speed=5.0,
        lubricant=OIL,
        mean_spin=1500.0,
    ),
    "skewed 72 degrees": moes(1924.0, 1.596, 0.0473, 72.0, SKEWED_OIL),
}
STARTS = {"solved": 20, "one cycle": 1, "Hertz": 1}  # cycles on the finest level


def start_from_hertz(state):
    """Hertz pressure on the finest level, and the approach of the film formula."""
    level = state.levels[-1]
    pressure = state.contact.dry_pressure(level.grid.X[None, :], level.grid.Y[:, None])
    state.approach = state.exterior = 0.0
    start_level(state, len(state.levels) - 1, pressure)
    state.approach = state.contact.film_guess - central_film(level.grid, level.H)
    update_film(state, len(state.levels) - 1)


def line(name, points, start):
    """One contact from one start."""
    began = time.process_time()
    options = SolverOptions(points=points, max_cycles=STARTS[start])
    solution, state = solve_attempts(CONTACTS[name], options, attempts=ATTEMPTS[:1])
    multigrid = time.process_time() - began
    index = len(state.levels) - 1
    if start == "Hertz":
        start_from_hertz(state)
    left = relative_residual(state, index)[0]
    began = time.process_time()
    c = certify(state)
    newton = time.process_time() - began
    films = film_values(state.levels[index].grid, state.levels[index].H)
    outcome = "certified" if c.certified else f"NOT: {c.message}"
    print(
        f"{name:23} {points:4} {start:9} {solution.record.fft_equivalents:5.1f} {left:8.1e} | "
        f"{len(c.residual) - 1:3} {c.deflections:4} {c.factorisations:3} {c.residual[-1]:8.1e} {c.film_change:8.1e} "
        f"{newton / multigrid:6.1f} | {films[0]:.5f} {films[1]:.5f} {outcome}",
        flush=True,
    )


def main(points):
    """Print the table."""
    solve_attempts(CONTACTS["turning"], SolverOptions(points=33))  # compile
    solve_attempts(CONTACTS["M 20, L 10"], SolverOptions(points=33))
    print(
        f"{'':39} multigrid      | Newton: steps, deflections, factors, residual, film change, time/multigrid | films"
    )
    for number in points:
        for name in CONTACTS:
            for start in STARTS:
                line(name, number, start)


if __name__ == "__main__":
    main([int(argument) for argument in sys.argv[1:]] or [129])
