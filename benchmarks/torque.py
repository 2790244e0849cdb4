"""Processor time of a torque point: from ready inputs, and with films of the atlas.

`python benchmarks/torque.py [POINTS]`. Targets: from tables below 60 ms; with films of the atlas 80 ms (40 s for 1000
points on two cores), with temperatures solved 180 ms (90 s).
"""

from __future__ import annotations

import sys
from dataclasses import replace
from time import process_time

import numpy as np

from oilfilm.bearing import Operation, Race, contact_conditions, solve_quasistatic, solve_traction_equilibrium
from oilfilm.bearing.friction.contact_friction import BallTraction
from oilfilm.bearing.friction.coulomb import balanced_friction
from oilfilm.bearing.friction.friction_sources import LawTraction
from oilfilm.bearing.friction.tables import build_race_tables
from oilfilm.bearing.torque.breakdown import friction_torque
from oilfilm.bearing.torque.integrated import law_torque
from oilfilm.cases import Case, load_case, run_case
from oilfilm.cases.format.case import case_of_document
from oilfilm.ehl.traction_table.build import TableOptions
from oilfilm.ehl.traction_table.table import TractionTable
from oilfilm.postprocess import summary

REPEATS = 40
POINTS = 20  # of each kind with films of the atlas
SEED = 20261124
KINDS = (  # bearing, speeds [r/min], axial and radial loads [N], whether it warms itself
    ("7012AC", (2000.0, 12000.0), (1000.0, 3000.0), (0.0, 0.0), False),
    ("7012AC", (2000.0, 12000.0), (1000.0, 3000.0), (0.0, 1000.0), False),
    ("6208", (1000.0, 8000.0), (0.0, 0.0), (1000.0, 3000.0), False),
    ("7012AC", (2000.0, 8000.0), (1000.0, 3000.0), (0.0, 1000.0), True),
    ("6208", (1000.0, 6000.0), (0.0, 0.0), (1000.0, 3000.0), True),
)
HEAT = {"heat_transfer_W_K": 2.8, "ambient_C": 25.0, "cooling_oil_mL_min": 900.0, "cooling_oil_C": 40.0}
TABLE_LOADS = ((0.0, 3000.0), (400.0, 1500.0))
LOADS = ((0.0, 3000.0), (500.0, 0.0), (1000.0, 1000.0))  # axial, radial [N]


def spent(function) -> float:
    """Least of repeated calls after a first one [s]: what other work on the machine changes least."""
    function()
    times = []
    for _ in range(REPEATS):
        start = process_time()
        function()
        times.append(process_time() - start)
    return min(times)


def measure(axial: float, radial: float) -> tuple[float, ...]:
    """Times of equilibrium, all models, balanced lines and Coulomb balance at loads [N], in [s]."""
    case = load_case("6206_combined_1000N")
    operation = replace(case.operation, inner_speed=500.0, force=(axial, radial, 0.0))
    state = solve_quasistatic(case.bearing, operation, case.model)
    contacts = contact_conditions(state, case.lubricant)
    return (
        spent(lambda: solve_quasistatic(case.bearing, operation, case.model)),
        spent(lambda: friction_torque(state, contacts, case.lubricant, case.friction)),
        spent(lambda: balanced_friction(state, contacts, 0.05, lines=True)),
        spent(lambda: balanced_friction(state, contacts, 0.05)),
    )


def tables(case: Case, operation: Operation) -> dict[Race, TractionTable]:
    """Traction tables at loads [N] and speeds [m/s] of the case; coarse, for a lookup takes as long in a fine one."""
    assert case.rheology is not None
    state = solve_quasistatic(case.bearing, operation, case.model)
    options = TableOptions(points=65, tolerance=0.5, check_films=1, check_motions=10, rounds=1, workers=2)
    return build_race_tables(state, case.lubricant, case.rheology, options)


def measure_table(case: Case, laws: dict[Race, TractionTable], axial: float, radial: float) -> tuple[float, ...]:
    """Times with ready tables at loads [N], in [s].

    Torque at given loads; the same with the equilibrium of the bearing under its hypothesis; traction equilibrium; that
    and the torque in it, as a case with `traction = "table"` asks for them.
    """
    operation = replace(case.operation, force=(axial, radial, 0.0))
    state = solve_quasistatic(case.bearing, operation, case.model)
    contacts = contact_conditions(state, case.lubricant)
    traction = BallTraction(source=LawTraction(laws=laws), lubricant=case.lubricant)

    def point() -> None:
        solved = solve_quasistatic(case.bearing, operation, case.model)
        ready = contact_conditions(solved, case.lubricant)
        law_torque(solved, ready, traction.source.at(solved, ready))

    def whole() -> None:
        solved = solve_traction_equilibrium(case.bearing, operation, None, traction)
        ready = contact_conditions(solved, case.lubricant)
        law_torque(solved, ready, traction.source.at(solved, ready))

    return (
        spent(lambda: law_torque(state, contacts, traction.source.at(state, contacts))),
        spent(point),
        spent(lambda: solve_traction_equilibrium(case.bearing, operation, None, traction)),
        spent(whole),
    )


def atlas_point(name: str, speed: float, axial: float, radial: float, heated: bool) -> Case:
    """A case of a catalogue bearing in oil, all films of the atlas, at a speed [r/min] and loads [N]."""
    operation = {"inner_speed_rpm": speed, "axial_load_N": axial, "radial_load_N": radial, "temperature_C": 60.0}
    friction = {"lubrication": "oil jet", "oil_fraction": 0.05}
    rough = {"inner_ring_roughness_um": 0.05, "outer_ring_roughness_um": 0.05, "ball_roughness_um": 0.02}
    document = {
        "schema_version": 1,
        "bearing": {"name": name},
        "lubricant": {"name": "iso vg 32"},
        "operation": operation | ({"temperature": "self-heated"} if heated else {}),
        "friction": friction | (HEAT if heated else {}),
        "surface": rough,
        "ehl": {"film_maps": "none"},
    }
    case = case_of_document(document)
    assert isinstance(case, Case)
    return case


def measure_atlas(points: int) -> None:
    """A line for every kind: mean over random points [ms], each computed once, as a batch computes it in a worker."""
    print("films of the atlas:")
    print("bearing  load        temperatures  points  converged  run ms  summary ms")
    random = np.random.default_rng(SEED)
    for name, *ranges, heated in KINDS:
        cases = [atlas_point(name, *(random.uniform(*r) for r in ranges), heated) for _ in range(points)]
        summary(run_case(cases[0], 1))
        start = process_time()
        results = [run_case(case, 1) for case in cases]
        ran = process_time() - start
        documents = [summary(result) for result in results]
        written = process_time() - start - ran
        load = "axial" if ranges[2][1] == 0.0 else "radial" if ranges[1][1] == 0.0 else "combined"
        converged = sum(bool(document["converged"]) for document in documents)
        words = (
            f"{name:7s}",
            f"{load:10s}",
            f"{'solved' if heated else 'given':12s}",
            f"{points:6d}",
            f"{converged:9d}",
        )
        print("  ".join((*words, f"{1e3 * ran / points:6.1f}", f"{1e3 * written / points:10.1f}")), flush=True)


def main() -> None:
    """A line for every load, and for every kind of points with films of the atlas."""
    measure_atlas(int(sys.argv[1]) if len(sys.argv) > 1 else POINTS)
    print("axial N  radial N  equilibrium ms  all models ms  balanced lines ms  Coulomb 2-D ms")
    for axial, radial in LOADS:
        print(f"{axial:7.0f}  {radial:8.0f}  " + "  ".join(f"{1e3 * t:14.1f}" for t in measure(axial, radial)))
    print("from ready tables:")
    print("axial N  radial N  at given loads ms  with equilibrium ms  traction equilibrium ms  with torque ms")
    case = load_case("6208_full_ceramic")
    axial, radial = TABLE_LOADS[-1]
    laws = tables(case, replace(case.operation, force=(axial, radial, 0.0)))
    for axial, radial in TABLE_LOADS:
        times = measure_table(case, laws, axial, radial)
        print(f"{axial:7.0f}  {radial:8.0f}  " + "  ".join(f"{1e3 * t:17.1f}" for t in times))


if __name__ == "__main__":
    main()
