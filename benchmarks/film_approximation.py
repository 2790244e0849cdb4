"""What the films of traction tables leave out: traction on an isothermal Newtonian film against full solves.

python benchmarks/film_approximation.py [points]

The full solve has the shear of the oil and heat in the film (`solve_generalized`), its force that of the stress in the
middle of the film; inner race of the ceramic 6208, Eyring's oil without a limiting stress.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from itertools import product

import numpy as np

from ehl import ContactConditions, Lubricant, SolverOptions, solve_contact
from ehl.generalized_solver import solve_generalized
from ehl.lubricant import ThermalProperties
from ehl.rheology import Rheology, ShearLaw
from ehl.thermal import SolidThermal
from ehl.traction import ContactKinematics, integrate_traction

OIL = Lubricant(
    viscosity=0.0261,
    pressure_viscosity=18e-9,
    temperature=313.15,
    thermal=ThermalProperties(
        conductivity=0.14, specific_heat=2000.0, viscosity_temperature=0.035, expansion=7e-4
    ),  # from memory, unverified
)
CERAMIC = SolidThermal(conductivity=30.0, density=3250.0, specific_heat=740.0)  # as docs/rheology.md
EYRING = Rheology(law=ShearLaw.REE_EYRING, eyring_stress=5.22e6)
CONTACT = ContactConditions(
    load=500.0, radius_x=4.8e-3, radius_y=0.21776, reduced_modulus=3.325e11, entrainment_speed=15.0, lubricant=OIL
)
LOADS, RATIOS = (50.0, 500.0), (0.002, 0.02, 0.1)


def main(points: int) -> None:
    """One line for each load and slide-roll ratio."""
    options = SolverOptions(points=points)
    for load, ratio in product(LOADS, RATIOS):
        contact = replace(CONTACT, load=load, slide_roll_ratio=ratio)
        plain = solve_contact(replace(contact, slide_roll_ratio=0.0), options)
        motion = ContactKinematics(entrainment_speed=15.0, sliding_x=15.0 * ratio, rolling=15.0 / contact.radius_x)
        table = -integrate_traction(plain, motion, EYRING).sliding_force_x / load
        print(
            f"{load:5.0f} N, slide-roll ratio {ratio:5.3f}: isothermal Newtonian film {table:.4f}", end="", flush=True
        )
        for name, solids in (("thinned", None), ("thinned and warm", (CERAMIC, CERAMIC))):
            full = solve_generalized(contact, EYRING, solids=solids, options=options)
            film, stress = full.contact, full.mid_stress
            assert stress is not None and film.x is not None and film.y is not None
            force = abs(np.trapezoid(np.trapezoid(stress[0], film.y, axis=1), film.x)) / load
            told = "" if film.converged else " (not converged)"
            thin = film.film_central_dimensionless.finest / plain.film_central_dimensionless.finest
            print(f" | {name} {force:.4f}, film x {thin:.3f}{told}", end="", flush=True)
        print()


if __name__ == "__main__":
    main(*[int(argument) for argument in sys.argv[1:]] or [129])
