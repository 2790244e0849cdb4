"""Processor time of a torque point from ready inputs: `python benchmarks/torque.py`. Target: below 50 ms."""

from __future__ import annotations

from dataclasses import replace
from time import process_time

from bearing import Operation, Race, contact_conditions, solve_quasistatic, solve_traction_equilibrium
from bearing.friction.coulomb import balanced_friction
from bearing.friction.law import BallTraction
from bearing.friction.race_tables import build_race_tables
from bearing.friction.sources import LawTraction
from bearing.torque.breakdown import torque_breakdown
from bearing.torque.integrated import law_torque
from cases import Case, load_case
from ehl.traction.table.build import TableOptions
from ehl.traction.table.table import TractionTable

REPEATS = 40
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
        spent(lambda: torque_breakdown(state, contacts, case.lubricant, case.friction)),
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


def main() -> None:
    """A line for every load."""
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
