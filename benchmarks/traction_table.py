"""Time of a lookup in a traction table of the size of the 6208's, and against the sum over a film's nodes it replaces.

python benchmarks/traction_table.py [lookups]
"""

from __future__ import annotations

import sys
from time import process_time

import numpy as np
from numba import njit
from numpy.typing import NDArray

from oilfilm.ehl import ContactConditions, Lubricant, SolverOptions, solve_contact
from oilfilm.ehl.oil.rheology import Rheology, ShearLaw
from oilfilm.ehl.traction._kernels import table_lookup
from oilfilm.ehl.traction.film_quadrature import film_quadrature, sliding_forces
from oilfilm.ehl.traction_table.build import HEATED_START, START
from oilfilm.ehl.traction_table.compression import VALUE_STEP
from oilfilm.ehl.traction_table.table import load_coordinate

Array = NDArray[np.float64]

REPEATS = 7  # the fastest counts
LOAD, SPEED = (10.8, 2418.0), (7.5, 18.8)  # [N], [m/s]
RADIUS, CURVATURE = 4.8e-3, 0.5 / 6.08e-3  # [m], [1/m]


@njit(nogil=True, error_model="numpy")  # not kept on disk: it holds the code of the lookup
def many(axes, constants, scalars, values, motions, out):
    """Lookups one after the other, as the equations of motion do them."""
    total = 0.0
    for k in range(motions.shape[0]):
        load, speed, slide_x, slide_y, spin = motions[k]
        table_lookup(axes, constants, scalars, values, load, speed, slide_x, slide_y, spin, out)
        total += out[0]
    return total


def random_table(random: np.random.Generator, start: tuple[int, ...]) -> tuple[Array, Array, Array, NDArray[np.int16]]:
    """Arrays of a table of the nodes that the 6208's starts with; its numbers are noise."""
    nodes = np.array(start, dtype=np.float64)
    first = np.array([load_coordinate(LOAD[0]), np.log(SPEED[0]), -1.0, 0.0, -1.0])
    last = np.array([load_coordinate(LOAD[1]), np.log(SPEED[1]), 1.0, 1.0, 1.0])
    axes = np.stack([first, (nodes - 1.0) / (last - first), nodes], axis=1)
    constants = np.array([RADIUS, -125.0, 2.0, 1.0, 0.6, 1.5e-4, CURVATURE, VALUE_STEP, 2e-5, 0.1, 0.15, 0.0])
    scalars = random.random((start[0] + 2, start[1] + 2, 10)) - np.array([8.0, 8.0, 3.0, *[0.0] * 7])
    return (
        axes,
        constants,
        scalars,
        random.integers(-3000, 3000, (*(start[k] + 2 for k in (2, 3, 4)), *start[:2], 4)).astype(np.int16),
    )


def lookup_time(arrays: tuple[Array, Array, Array, NDArray[np.int16]], motions: Array) -> float:
    """Processor time of one lookup [s]."""
    out, best = np.empty(8), np.inf
    many(*arrays, motions[:2], out)
    for _ in range(REPEATS):
        began = process_time()
        many(*arrays, motions, out)
        best = min(best, process_time() - began)
    return float(best / len(motions))


def shear_time(motions: Array) -> float:
    """Processor time of the shear sums over one film of the inner race of the ceramic 6208 [s]."""
    oil = Lubricant(viscosity=0.0261, pressure_viscosity=18e-9)
    contact = ContactConditions(
        load=500.0, radius_x=RADIUS, radius_y=0.2178, reduced_modulus=3.325e11, entrainment_speed=15.0, lubricant=oil
    )
    rheology = Rheology(law=ShearLaw.REE_EYRING, eyring_stress=5.2e6, limiting_coefficient=0.047)
    nodes = film_quadrature(solve_contact(contact, SolverOptions(points=257)), rheology)
    slides, best = tuple(np.ascontiguousarray(part) for part in motions[:, 2:].T), np.inf
    for _ in range(REPEATS):
        began = process_time()
        sliding_forces(nodes, slides, np.full(len(motions), 15.0 / RADIUS), CURVATURE)  # type: ignore[arg-type]
        best = min(best, process_time() - began)
    return float(best / len(motions))


def main(count: int) -> None:
    """Time lookups all over the table and around one place, and the sums."""
    random = np.random.default_rng(70293)
    motions = random.uniform(-1.0, 1.0, (count, 5)) ** 3 * [0.0, 0.0, 20.0, 10.0, 1500.0]
    motions[:, :2] = np.exp(random.uniform(*np.log(np.transpose([LOAD, SPEED])), (count, 2)))
    near = motions[0] * (1.0 + 1e-4 * random.random(motions.shape))
    sums = shear_time(motions[:200])
    print(f"shear sums over a film {1e6 * sums:.1f} us")
    for name, start in (("without", START), ("with", HEATED_START)):
        arrays = random_table(random, start)
        here, anywhere = lookup_time(arrays, near), lookup_time(arrays, motions)
        print(f"table {name} heat, {arrays[3].nbytes / 1e6:.0f} MB, nodes {start}:")
        print(f"lookup around one place {1e6 * here:.2f} us, all over the table {1e6 * anywhere:.2f} us")


if __name__ == "__main__":
    main(*[int(argument) for argument in sys.argv[1:]] or [20000])
