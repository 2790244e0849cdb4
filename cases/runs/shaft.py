"""Run a shaft case: its equilibrium, a bearing case for each support, and its vibrations."""

from collections.abc import Callable
from math import pi
from time import perf_counter
from typing import Any

import numpy as np

from oilfilm.bearing.shaft.equilibrium import ShaftSolution, floats, solve_shaft
from oilfilm.bearing.shaft.vibration import (
    Vibration,
    critical_speeds,
    unbalance_response,
    vibration,
    whirl_frequencies,
)
from oilfilm.ehl.units import from_si
from oilfilm.postprocess.bearing.results import BearingResults
from oilfilm.postprocess.shaft.results import ShaftResults, ShaftVibration

from ..format.case import Case, case_of_document
from ..format.shaft_case import ShaftCase
from ..version import version
from .bearing import run_case

Progress = Callable[[int, int, str], None]
CRITICAL = 6  # critical speeds that are reported, the lowest [-]
WHIRLS = 8  # frequencies in Campbell's diagram [-]
SPEEDS = 21  # of the diagram [-]
BEYOND = 1.3  # of operating and first critical speed, where the diagram ends [-]
LEAST_SPEED = 100.0  # likewise for shafts at rest [rad/s]
HIGHEST = 1.0e5  # of the critical speeds [rad/s]


def run_shaft(case: ShaftCase, progress: Progress | None = None) -> ShaftResults:
    """Equilibrium of a shaft, the results of each bearing, critical speeds, unbalance.

    Parameters
    ----------
    case : ShaftCase
        Shaft, bearings, loads.
    progress : callable, optional
        Called with steps done, steps in all, and a text.

    Returns
    -------
    ShaftResults
        Results; bearings are None where the shaft has no equilibrium.
    """
    notify = progress or (lambda done, total, state: None)
    steps = len(case.cases) + 2
    start = perf_counter()
    # 1. shaft and bearings together
    notify(0, steps, "shaft")
    solution = solve_shaft(case.system)
    timing = {"shaft": perf_counter() - start}
    # 2. each bearing where the shaft holds its inner ring
    bearings: list[BearingResults | None] = []
    for k, document in enumerate(case.documents):
        notify(k + 1, steps, f"bearing {k + 1}")
        bearings.append(_bearing(document, solution, k) if solution.converged else None)
    timing["bearings"] = perf_counter() - start - timing["shaft"]
    # 3. small vibrations about the equilibrium
    notify(steps - 1, steps, "vibration")
    moving = None
    note = ""
    if solution.converged:
        try:
            moving = _vibration(solution)
        except ValueError as error:
            note = f"critical_speeds_rpm: null, {error}"
    timing["total"] = perf_counter() - start
    notes = [note] if note else []
    if not solution.converged:
        notes.append(f"shaft: {solution.message}")
    return ShaftResults(
        version=version(),
        case=case.document,
        names=case.names,
        solution=solution,
        bearings=tuple(bearings),
        vibration=moving,
        messages=(*notes, *case.warnings),
        timing=timing,
    )


def _bearing(document: dict[str, Any], solution: ShaftSolution, index: int) -> BearingResults:
    """Results of one bearing under the radial load of the shaft, its ring held along the axis and
    tilted as the shaft has it.
    """
    state = solution.bearings[index]
    axial = "free" if floats(state) else float(from_si("displacement_um", state.displacement[0]))
    operation = {
        **document["operation"],
        "force_N": [0.0, *(float(from_si("force_N", x)) for x in state.ring_force[1:])],
        "displacement_um": [axial, "free", "free"],
        "tilt_mrad": [float(from_si("tilt_mrad", x)) for x in state.tilt],
    }
    case = case_of_document({**document, "operation": operation})
    assert isinstance(case, Case)  # a bearing
    return run_case(case, 1)


def _vibration(solution: ShaftSolution) -> ShaftVibration:
    """Critical speeds, frequencies of whirl over the speed, amplitudes under unbalance."""
    matrices: Vibration = vibration(solution)
    speed = abs(solution.system.speed)
    critical = critical_speeds(matrices, HIGHEST)[:CRITICAL]
    first = float(critical[0]) if critical.size else LEAST_SPEED
    speeds = np.linspace(0.0, BEYOND * max(speed, first), SPEEDS)
    unbalanced = any(load.unbalance for load in solution.system.loads)
    response = unbalance_response(matrices, solution, speed) if unbalanced and speed else None
    return ShaftVibration(
        critical=critical,
        speeds=speeds,
        whirl=whirl_frequencies(matrices, speeds.tolist(), WHIRLS) / (2.0 * pi),
        positions=matrices.beam.positions,
        response=response,
    )
