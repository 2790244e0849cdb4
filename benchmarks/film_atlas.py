"""Films of the atlas, many at once and one by one: their times on one thread, and by how much they differ.

python benchmarks/film_atlas.py
"""

from __future__ import annotations

import time

import numpy as np

from oilfilm import ehl
from oilfilm.ehl.atlas.films import RANGE
from oilfilm.ehl.closed_form.hertz import hertz_coefficients

NUMBER = 200_000
SINGLE = 500
REPEATS = 5
WITHIN = 5000  # contacts for the difference, drawn over the whole range of the atlas
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

    difference()


def difference():
    """Print by how much films of many at once differ from those one by one, over the whole range."""
    random = np.random.default_rng(7)
    modulus, along, eta = 2.3e11, 4e-3, 0.03
    heavy, _, ratio, z, alpha = RANGE.values()
    ratios = np.exp(random.uniform(*np.log(ratio), WITHIN))
    coefficients = np.exp(random.uniform(*np.log(alpha), WITHIN))
    speeds = np.exp(random.uniform(np.log(1e-3), np.log(100.0), WITHIN))
    twice = 2.0 * eta * speeds / (modulus * along)
    sizes = np.array([hertz_coefficients(float(own))[0] for own in ratios])
    wanted = np.exp(random.uniform(*np.log(heavy), WITHIN))
    given = {
        "load": modulus * along**2 * (wanted * np.sqrt(twice) / sizes**2) ** 1.5,
        "radius_y": along / ratios,
        "entrainment_speed": speeds,
        "pressure_viscosity": coefficients,
        "roelands_z": random.uniform(*z, WITHIN),
    }
    same = {"radius_x": along, "reduced_modulus": modulus, "viscosity": eta}
    found = ehl.atlas_arrays(ehl.ContactArrays(**given, **same))
    worst = {"central": 0.0, "minimum": 0.0}
    for n in np.flatnonzero(found.inside):
        own = {name: float(values[n]) for name, values in given.items()} | same
        oil = ehl.Lubricant(**{name: own.pop(name) for name in ("viscosity", "pressure_viscosity", "roelands_z")})
        films = ehl.atlas_films(ehl.ContactConditions(**own, lubricant=oil))
        for name in worst:
            away = abs(getattr(found, name)[n] / getattr(films, name).value - 1.0)
            worst[name] = max(worst[name], float(away))
    number = int(found.inside.sum())
    print(f"largest difference of {number} contacts over the range: ", end="")
    print(", ".join(f"{name} film {100 * away:.3f} %" for name, away in worst.items()))


if __name__ == "__main__":
    main()
