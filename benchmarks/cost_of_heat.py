"""How many times the processor time of a film of uniform temperature one with heat takes: eighteen contacts of bearings
at speed and ten at random, 129 points, Newtonian and with Eyring's law.

    python benchmarks/cost_of_heat.py
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from math import cos, pi, radians, sin
from time import process_time

import numpy as np

from oilfilm.ehl import ContactConditions, Lubricant, SolverOptions, ViscosityLaw, solve_contact
from oilfilm.ehl.generalized.solver import solve_generalized
from oilfilm.ehl.oil.rheology import Rheology
from oilfilm.ehl.solid.heat import SolidThermal
from robustness_shear_heat import EYRING, HEAT, random_contact

STEEL = SolidThermal(conductivity=21.0, density=7850.0, specific_heat=460.0)
NITRIDE = SolidThermal(conductivity=30.0, density=3250.0, specific_heat=680.0)
REPEATS = 3  # the fastest counts
OPTIONS = SolverOptions(points=129)
BEARINGS = (  # ball and pitch diameter [mm], angle [deg], r/min, load of a ball [N], oil [Pa s], hybrid
    ("7014C", 12.3, 90.0, 15.0, 20000.0, 120.0, 0.010, True),
    ("7014C in 20 mPa s", 12.3, 90.0, 15.0, 20000.0, 60.0, 0.020, True),
    ("6208", 11.9, 60.0, 0.0, 6000.0, 700.0, 0.03, False),
    ("6310", 19.05, 80.0, 0.0, 5000.0, 3000.0, 0.06, False),
    ("6010", 8.7, 65.0, 0.0, 15000.0, 300.0, 0.015, False),
    ("7008", 7.9, 54.0, 18.0, 28000.0, 80.0, 0.010, True),
    ("7012AC", 11.1, 77.5, 25.0, 12000.0, 200.0, 0.02, False),
    ("6004", 6.35, 31.0, 0.0, 40000.0, 40.0, 0.012, True),
    ("6306", 12.3, 51.0, 0.0, 4000.0, 1500.0, 0.05, False),
)
Contact = tuple[str, ContactConditions, SolidThermal]


def contacts() -> Iterator[Contact]:
    """Both races of each bearing, the outer one loaded more above 10 000 r/min, then random contacts."""
    for name, ball, pitch, angle, speed, load, viscosity, hybrid in BEARINGS:
        diameter, turns, alpha = 1e-3 * ball, speed * pi / 30.0, radians(angle)
        oil = Lubricant(
            viscosity=viscosity,
            pressure_viscosity=1.8e-8,
            viscosity_law=ViscosityLaw.ROELANDS,
            roelands_z=0.6,
            temperature=343.0,
            thermal=HEAT,
        )
        ratio = ball * cos(alpha) / pitch
        for race, side, osculation, spin in (("inner", -1.0, 0.515, 1.2), ("outer", 1.0, 0.525, 0.3)):
            conditions = ContactConditions(
                load=load * (1.3 if side > 0 and speed > 10000.0 else 1.0),
                radius_x=diameter / 2.0 * (1.0 + side * ratio),
                radius_y=1.0 / (2.0 / diameter - 1.0 / (osculation * diameter)),
                reduced_modulus=2.9e11 if hybrid else 2.26e11,
                entrainment_speed=turns * 1e-3 * pitch * (1.0 - ratio * ratio) / 4.0,
                lubricant=oil,
                spin=0.5 * turns * sin(alpha) * spin,
                slide_roll_ratio=0.005 if angle else 0.001,
            )
            yield f"{name}, {race} race", conditions, NITRIDE if hybrid else STEEL
    random = np.random.default_rng(2611)
    for index in range(10):
        yield f"random {index}", random_contact(random), STEEL


def least_time(solve: Callable[[], object]) -> float:
    """Processor time of the fastest of some solves [s]."""
    times = []
    for _ in range(REPEATS):
        began = process_time()
        solve()
        times.append(process_time() - began)
    return min(times)


def main() -> None:
    """Print a line for each contact, and the medians."""
    ratios: dict[str, list[float]] = {"Newtonian": [], "Eyring": [], "Eyring over Newtonian": []}
    for name, conditions, ball in contacts():
        with_heat = partial(solve_generalized, conditions, solids=(ball, STEEL))
        with_heat(EYRING, options=SolverOptions(points=33))  # kernels are made
        plain = least_time(partial(solve_contact, conditions, OPTIONS))
        eyring = least_time(partial(solve_generalized, conditions, EYRING, options=OPTIONS))
        hot, hot_eyring = (least_time(partial(with_heat, law, options=OPTIONS)) for law in (Rheology(), EYRING))
        found = (hot / plain, hot_eyring / eyring, hot_eyring / plain)
        for law, ratio in zip(ratios, found, strict=True):
            ratios[law].append(ratio)
        times = f"{plain:.2f} s, with heat {hot:.2f}; Eyring {eyring:.2f} s, with heat {hot_eyring:.2f}"
        print(f"{name}: Newtonian {times}; ratios {found[0]:.1f}, {found[1]:.1f}, {found[2]:.1f}", flush=True)
    for law, values in ratios.items():
        below = sum(value < 8.0 for value in values)
        print(f"{law}: median {np.median(values):.1f}, {below} of {len(values)} below 8")


if __name__ == "__main__":
    main()
