"""Processor time of a torque point from ready inputs: `python benchmarks/torque.py`. Target: below 50 ms."""

from __future__ import annotations

from dataclasses import replace
from statistics import median
from time import process_time

from bearing import contact_conditions, solve_quasistatic
from bearing.torque.breakdown import torque_breakdown
from bearing.torque.coulomb import balanced_friction
from cases import load_case

REPEATS = 15
LOADS = ((0.0, 3000.0), (500.0, 0.0), (1000.0, 1000.0))  # axial, radial [N]


def spent(function) -> float:
    """Median of repeated calls after a first one [s]."""
    function()
    times = []
    for _ in range(REPEATS):
        start = process_time()
        function()
        times.append(process_time() - start)
    return median(times)


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


def main() -> None:
    """A line for every load."""
    print("axial N  radial N  equilibrium ms  all models ms  balanced lines ms  Coulomb 2-D ms")
    for axial, radial in LOADS:
        print(f"{axial:7.0f}  {radial:8.0f}  " + "  ".join(f"{1e3 * t:14.1f}" for t in measure(axial, radial)))


if __name__ == "__main__":
    main()
