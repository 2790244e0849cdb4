"""Random contacts, Newtonian and with shear thinning and heat: how many converge, what the film loses, and how many
times the Newtonian film's processor time each takes.

python benchmarks/robustness_shear_heat.py [count] [seed] [draw ...]

With draws named only these of the `count` are solved. A + stands where a fallback was taken.
"""

from __future__ import annotations

import sys
from time import process_time

import numpy as np

from oilfilm.ehl import ContactConditions, Lubricant, SolverOptions, solve_contact
from oilfilm.ehl.generalized.solver import solve_generalized
from oilfilm.ehl.oil.lubricant import ThermalProperties
from oilfilm.ehl.oil.rheology import Rheology, ShearLaw
from oilfilm.ehl.solid.heat import SolidThermal

STEEL = SolidThermal(conductivity=46.0, density=7850.0, specific_heat=460.0)
HEAT = ThermalProperties(conductivity=0.14, specific_heat=2000.0, viscosity_temperature=0.035, expansion=7e-4)
EYRING = Rheology(law=ShearLaw.REE_EYRING, eyring_stress=5e6)
CARREAU = Rheology(law=ShearLaw.CARREAU_YASUDA, carreau_modulus=2e6, carreau_exponent=0.5)
LIMITED = Rheology(law=ShearLaw.REE_EYRING, eyring_stress=5e6, limiting_coefficient=0.08)
MODELS = {
    "eyring": (EYRING, None),
    "carreau": (CARREAU, None),
    "eyring, limited": (LIMITED, None),
    "newtonian, heat": (Rheology(), (STEEL, STEEL)),
    "eyring, heat": (EYRING, (STEEL, STEEL)),
}


def random_contact(random: np.random.Generator) -> ContactConditions:
    """A rolling contact of a bearing, steel or ceramic, with slip in both directions and spin."""
    radius = 10 ** random.uniform(-3, -1.8)
    oil = Lubricant(
        viscosity=10 ** random.uniform(-2.3, -0.7),
        pressure_viscosity=random.uniform(12e-9, 24e-9),
        roelands_z=random.uniform(0.5, 0.7),
        temperature=333.0,
        thermal=HEAT,
    )
    sliding = random.choice([0.0, 10 ** random.uniform(-3, 0.2)])
    return ContactConditions(
        load=10 ** random.uniform(0.5, 2.5),
        radius_x=radius,
        radius_y=radius * 10 ** random.uniform(0, 1.7),
        reduced_modulus=random.uniform(2e11, 3.4e11),
        entrainment_speed=10 ** random.uniform(-0.5, 1.3),
        lubricant=oil,
        slide_roll_ratio=sliding,
        lateral_slide_ratio=random.choice([0.0, 0.02]),
        spin=random.choice([0.0, 10 ** random.uniform(1, 3)]),
    )


def main(count: int, seed: int, *draws: int) -> None:
    """Solve them all, or the draws named, and print one line each."""
    random = np.random.default_rng(seed)
    solved = dict.fromkeys(MODELS, 0)
    times: dict[str, list[float]] = {name: [] for name in MODELS}
    newtonian = 0
    for index in range(count):
        contact = random_contact(random)
        if draws and index not in draws:
            continue
        options = SolverOptions(points=129)
        plain = solve_contact(contact, options)  # once before it is timed: kernels and transforms are made
        began = process_time()
        plain = solve_contact(contact, options)
        alone = process_time() - began
        newtonian += plain.converged
        print(f"{index:3d} F {contact.load:.0f} D {contact.radius_x / contact.radius_y:.3f}", end=" ")
        print(f"p_h {plain.hertz_pressure / 1e9:.2f} u {contact.entrainment_speed:5.2f}", end=" ")
        print(f"S {contact.slide_roll_ratio:.3f} {'ok' if plain.converged else '--'}", end="", flush=True)
        if not plain.converged:
            print()
            continue
        for name, (rheology, solids) in MODELS.items():
            began = process_time()
            solution = solve_generalized(contact, rheology, solids=solids, options=options).contact
            spent = process_time() - began
            times[name].append(spent / alone)
            solved[name] += solution.converged
            ratio = solution.film_central_dimensionless.finest / plain.film_central_dimensionless.finest
            mark = f"{ratio:.3f}" if solution.converged else f"-- ({solution.message[:40]})"
            mark += "+" if solution.record.fallbacks else ""
            print(f" | {name} {mark} {solution.record.cycles} cycles {spent:.1f} s", end="", flush=True)
        print()
    print(
        f"newtonian {newtonian} of {len(draws) or count}; of these "
        + ", ".join(f"{name} {n}" for name, n in solved.items())
    )
    for name, ratios in times.items():
        low, middle, high = np.quantile(ratios, (0.0, 0.5, 0.9))
        print(f"{name}: {low:.1f} to {high:.1f} times the Newtonian film's time (least, 90 %), median {middle:.1f}")


if __name__ == "__main__":
    arguments = [int(a) for a in sys.argv[1:]]
    main(*(arguments + [12, 40213][len(arguments) :]))
