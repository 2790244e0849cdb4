"""Films of the atlas, many at once and one by one: `python benchmarks/film_atlas.py`, on one thread."""

from __future__ import annotations

import time

import numpy as np

import ehl

NUMBER = 200_000
SINGLE = 500
REPEATS = 5
GIVEN = {
    "radius_x": 4e-3,
    "radius_y": 4e-2,
    "reduced_modulus": 2.3e11,
    "viscosity": 0.03,
    "pressure_viscosity": 20e-9,
    "roelands_z": 0.66,
}


def main():
    """Print processor times of this thread for one contact [us]."""
    random = np.random.default_rng(3)
    loads, speeds = random.uniform(100.0, 800.0, NUMBER), random.uniform(3.0, 12.0, NUMBER)
    contacts = ehl.ContactArrays(load=loads, entrainment_speed=speeds, **GIVEN)
    began = time.thread_time()
    ehl.atlas_arrays(contacts)
    print(f"first call, with the lattice: {time.thread_time() - began:.2f} s")
    times = []
    for _ in range(REPEATS):
        began = time.thread_time()
        found = ehl.atlas_arrays(contacts)
        times.append(time.thread_time() - began)
    print(f"many at once: {1e6 * min(times) / NUMBER:.3f} us a contact, {found.inside.mean():.0%} inside")
    oil = ehl.Lubricant(**{name: GIVEN[name] for name in ("viscosity", "pressure_viscosity", "roelands_z")})
    bodies = {name: GIVEN[name] for name in ("radius_x", "radius_y", "reduced_modulus")}
    began = time.thread_time()
    for load, speed in zip(loads[:SINGLE], speeds[:SINGLE], strict=True):
        ehl.atlas_films(ehl.ContactConditions(load=load, entrainment_speed=speed, lubricant=oil, **bodies))
    print(f"one by one, with the rolling moment: {1e6 * (time.thread_time() - began) / SINGLE:.0f} us a contact")


if __name__ == "__main__":
    main()
