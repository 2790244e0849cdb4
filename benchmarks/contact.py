"""Cost and accuracy of the contact solve: `python benchmarks/contact.py [points ...]`.

Prints, for a few contacts and grids, film values, uncertainties and work; times are also given as multiples
of one deflection FFT (forward and inverse, padded) of the same grid, measured in the same run. One thread, compiled
before the clock starts.
"""

from __future__ import annotations

import sys
import time

import numpy as np

from ehl import ContactConditions, Lubricant, MoesConditions, SolverOptions, solve_contact
from ehl.deformation import deflect, deflection_kernel
from ehl.grid import Grid

OIL = Lubricant(viscosity=0.05, pressure_viscosity=22e-9, roelands_z=0.68)
CERAMIC_OIL = Lubricant(viscosity=0.0261, pressure_viscosity=18e-9)
BOX = (-4.5, 1.5, 3.0)


def outer_race(load):
    """Outer race of the all-ceramic 6208 at 10 000 rpm."""
    return ContactConditions(
        load=load,
        radius_x=7.2e-3,
        radius_y=1.0 / (1.0 / 6e-3 - 1.0 / 6.29e-3),
        reduced_modulus=310e9 / (1.0 - 0.26**2),
        entrainment_speed=15.08,
        lubricant=CERAMIC_OIL,
    )


CONTACTS = {
    "M 20, L 10, box 4.5": (MoesConditions(load_parameter=20.0, lubricant_parameter=10.0, lubricant=OIL), BOX),
    "M 200, L 10, box 4.5": (MoesConditions(load_parameter=200.0, lubricant_parameter=10.0, lubricant=OIL), BOX),
    "6208 outer, 1612 N": (outer_race(1611.8), None),
    "6208 outer, 15 N": (outer_race(15.48), None),
}


def deflection_time(solution):
    """Time of one deflection on the grid of a solution [s], best of eleven."""
    ny = (solution.Y.size + 1) // 2
    mesh = (solution.X[1] - solution.X[0], solution.Y[1] - solution.Y[0])
    grid = Grid(x_in=solution.X[0], hx=mesh[0], hy=mesh[1], nx=solution.X.size, ny=ny, symmetric=True)
    kernel, pressure, times = deflection_kernel(grid, 1.0), np.random.default_rng(17).random((ny, grid.nx)), []
    for _ in range(11):
        began = time.perf_counter()
        deflect(kernel, pressure)
        times.append(time.perf_counter() - began)
    return min(times)


def main(points):
    """Print one line per contact and grid."""
    solve_contact(CONTACTS["M 20, L 10, box 4.5"][0], SolverOptions(points=65))  # compile
    head = "contact                grid        Hc +- u           Hmin +- u         cycles  FFTs   time s  /FFT"
    print(head)
    for name, (conditions, domain) in CONTACTS.items():
        for n in points:
            runs = [solve_contact(conditions, SolverOptions(points=n, domain=domain)) for _ in range(3)]
            s = min(runs, key=lambda run: run.record.wall_time)
            c, m, r = s.film_central_dimensionless, s.film_minimum_dimensionless, s.record
            print(
                f"{name:21} {s.X.size:5}x{s.Y.size:<5} {c.value:8.5f} +- {c.uncertainty:.5f} {m.value:8.5f} +- "
                f"{m.uncertainty:.5f} {r.cycles:4} {r.fft_equivalents:7.1f} {r.wall_time:8.3f} "
                f"{r.wall_time / deflection_time(s):6.0f}{'' if s.converged else '  NOT CONVERGED'}"
            )


if __name__ == "__main__":
    main([int(argument) for argument in sys.argv[1:]] or [129, 257, 513])
