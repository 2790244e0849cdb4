"""How much a rotation of the entrainment moves the films of slim ellipses, solved with and without it.

`python tools/atlas/rotation.py SEED NUMBER` prints A, L, R_x/R_y and the rotation t = |Omega| max(a, b)/u_m of each
contact, the change of its central film over t^2, and k of exp(-k t^2), by which the minimum film is lowered.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from math import exp, log, log1p

import numpy as np

from oilfilm.ehl import ContactConditions, Lubricant, SolverOptions, solve_contact
from oilfilm.ehl.closed_form.hertz import hertz_coefficients
from oilfilm.ehl.scaling import scale_contact

OIL = Lubricant(viscosity=0.03, pressure_viscosity=20e-9, density=870.0)
MODULUS, RADIUS = 2.3e11, 0.005  # E' [Pa], R_x [m]
LARGEST_PRESSURE = 4e9  # [Pa]
POINTS = 257
A, L, RATIO, ROTATION = (9.0, 150.0), (3.0, 25.0), (0.011, 0.1), (0.05, 0.45)


def drawn(rng: np.random.Generator) -> tuple[ContactConditions, tuple[float, ...]]:
    """A contact without rotation, and A, L, R_x/R_y and the rotation wanted."""
    a, ratio, rotation = (exp(rng.uniform(log(low), log(high))) for low, high in (A, RATIO, ROTATION))
    lubricant = rng.uniform(*L)
    moes = (a / hertz_coefficients(ratio)[0] ** 2) ** 1.5
    twice_speed = (lubricant / (OIL.pressure_viscosity * MODULUS)) ** 4  # 2 U
    contact = ContactConditions(
        load=moes * twice_speed**0.75 * MODULUS * RADIUS**2,
        radius_x=RADIUS,
        radius_y=RADIUS / ratio,
        reduced_modulus=MODULUS,
        lubricant=OIL,
        entrainment_speed=0.5 * twice_speed * MODULUS * RADIUS / OIL.viscosity,
    )
    return contact, (a, lubricant, ratio, rotation)


def main(seed: int, number: int) -> None:
    """Draw, solve and print."""
    rng = np.random.default_rng(seed)
    options = SolverOptions(points=POINTS)
    print("A, L, Rx/Ry, t, change of the central film over t^2, k")
    found = 0
    while found < number:
        contact, place = drawn(rng)
        scaled = scale_contact(contact)
        if scaled.hertz_pressure > LARGEST_PRESSURE:
            continue
        found += 1
        end = scaled.semi_axis_x * scaled.semi_axis_ratio
        turning = replace(contact, mean_spin=place[3] * contact.entrainment_speed / end)
        straight, turned = (solve_contact(one, options) for one in (contact, turning))
        row = " ".join(f"{value:.4g}" for value in place)
        if not (straight.resolved and turned.resolved):
            print(row, "not resolved on this mesh")
            continue
        central = turned.film_central / straight.film_central - 1.0
        lowered = log1p(turned.film_minimum / straight.film_minimum - 1.0)
        print(row, f"{central / place[3] ** 2:+.4f} {-lowered / place[3] ** 2:.3f}", flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]))
