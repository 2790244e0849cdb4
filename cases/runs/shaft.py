"""Run a shaft case: its equilibrium, a bearing case for each support, and its vibrations."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from math import pi
from time import perf_counter
from warnings import catch_warnings, simplefilter

import numpy as np

from oilfilm.bearing.heating.self_heating import SelfHeatingSolution
from oilfilm.bearing.shaft.equilibrium import ShaftSolution, solve_shaft
from oilfilm.bearing.shaft.heat import ShaftHeat, held_operation, solve_shaft_heat
from oilfilm.bearing.shaft.system import ShaftSystem
from oilfilm.bearing.shaft.vibration import (
    Vibration,
    critical_speeds,
    unbalance_response,
    vibration,
    whirl_frequencies,
)
from oilfilm.bearing.studies.stiffness import ring_damping
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.messages import Caution
from oilfilm.ehl.units import from_si
from oilfilm.postprocess.bearing.results import BearingResults
from oilfilm.postprocess.shaft.results import ShaftResults, ShaftVibration

from ..format.case import Case, case_of_document
from ..format.shaft_case import ShaftCase
from .bearing import WARM_ROUNDS, in_balance, reported_torque, run_case
from .heating import WARM_TOLERANCE, ReportedTorque, heating_problem, with_temperature

Progress = Callable[[int, int, str], None]
CRITICAL = 6  # critical speeds that are reported, the lowest [-]
WHIRLS = 8  # frequencies in Campbell's diagram [-]
SPEEDS = 21  # of the diagram [-]
BEYOND = 1.3  # of operating and first critical speed, where the diagram ends [-]
LEAST_SPEED = 100.0  # likewise for shafts at rest [rad/s]
WRONG_SIDE = 1.0e-6  # of a bearing's load, from which a push the wrong way is told [-]
BENT = 0.1  # deflection over the length, beyond which linear bending is wrong by 1 % [-]
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
    # 2. each bearing where the shaft holds its inner ring, or all of them in balance of heat
    bearings: list[BearingResults | None] = [None] * len(case.cases)
    heat = None
    notes = _doubts(case, solution) if solution.converged else [f"shaft: {solution.message}"]
    try:
        if case.self_heated and solution.converged:
            heat, warmed = _in_balance_of_heat(case, solution, lambda text: notify(1, steps, text))
            solution = heat.shaft
            bearings = list(warmed)
    except ValueError as error:
        notes.append(f"operation.temperature: not self-heated, {error}; temperature_C is taken")
    if heat is not None and not heat.stable:
        notes.append("the balance of heat is not stable: shaft and bearings run away from it")
    for k in range(len(bearings)):
        if heat is None and solution.converged:
            notify(k + 1, steps, f"bearing {k + 1}")
            bearings[k] = run_case(_given_temperature(_held(case, solution, k)), 1)
    timing["bearings"] = perf_counter() - start - timing["shaft"]
    # 3. small vibrations about the equilibrium
    notify(steps - 1, steps, "vibration")
    moving = None
    if solution.converged:
        try:
            moving = _vibration(solution, [one for one in bearings if one is not None])
        except ValueError as error:
            notes.append(f"critical_speeds_rpm: null, {error}")
    timing["total"] = perf_counter() - start
    return ShaftResults(
        case=case.document,
        names=case.names,
        solution=solution,
        bearings=tuple(bearings),
        vibration=moving,
        heat=heat,
        messages=(*notes, *case.warnings),
        timing=timing,
    )


def _doubts(case: ShaftCase, solution: ShaftSolution) -> list[str]:
    """Bearings that the shaft pushes to the side from which they are not loaded, and a shaft that
    bends too far.
    """
    found: list[str] = []
    supports = zip(case.document["support"], solution.bearings, strict=True)
    for number, (table, state) in enumerate(supports, 1):
        push = float(state.ring_force[0])
        side = {"+x": 1.0, "-x": -1.0}.get(table.get("loaded_by"), 0.0)
        if side * push < -WRONG_SIDE * float(np.abs(state.ring_force).max()):
            found.append(
                f"bearing {number} ({table['bearing']}): the shaft pushes it by {push:.3g} N "
                f'along x, against loaded_by = "{table["loaded_by"]}"'
            )
    deflection = float(np.abs(solution.displacement[:, 1:3]).max()) / np.ptp(solution.positions)
    if deflection > BENT:
        found.append(
            f"shaft: it bends by {deflection:.2g} of its length, too far for the linear beam"
        )
    return [Caution(text) for text in found]


def _held(case: ShaftCase, solution: ShaftSolution, index: int) -> Case:
    """Case of one bearing under the radial load of the shaft, its ring held along the axis and
    tilted as the shaft has it.
    """
    document = case.documents[index]
    held = held_operation(solution.bearings[index])
    places = [
        "free" if x is None else float(from_si("displacement_um", x)) for x in held.displacement
    ]
    operation = {
        **document["operation"],
        "force_N": [float(from_si("force_N", x or 0.0)) for x in held.force],
        "displacement_um": places,
        "tilt_mrad": [float(from_si("tilt_mrad", x or 0.0)) for x in held.tilt],
    }
    found = case_of_document({**document, "operation": operation})
    assert isinstance(found, Case)  # a bearing
    return found


def _given_temperature(case: Case) -> Case:
    """The case at its temperature_C."""
    operation = case.file.operation.model_copy(update={"temperature": "given"})
    return replace(case, file=case.file.model_copy(update={"operation": operation}))


def _in_balance_of_heat(
    case: ShaftCase, solution: ShaftSolution, notify: Callable[[str], None]
) -> tuple[ShaftHeat, list[BearingResults]]:
    """The balance of heat of shaft and bearings, and the results of these there: with films
    without a solve first, then with the torque of the results until temperatures repeat.
    """
    notify("balance of heat")
    heat = balance_of_heat(case, solution)
    for _ in range(WARM_ROUNDS):
        if not heat.bearings[0].converged:
            raise ValueError(heat.bearings[0].balance.message if heat.bearings[0].balance else "")
        at = [
            _among_neighbours(with_temperature(_held(case, heat.shaft, k), own), own)
            for k, own in enumerate(heat.bearings)
        ]
        notify("bearings")
        results = [run_case(one, 1) for one in at]
        pairs = list(zip(results, at, strict=True))
        if all(_moved(found, one) <= WARM_TOLERANCE for found, one in pairs):
            break
        reported = [reported_torque(one, found) for found, one in pairs]
        heat = _balance_of_heat(case.system, at, reported, heat)
    return heat, [
        _in_range(in_balance(found, one), ends)
        for (found, one), ends in zip(pairs, heat.node_range.swapaxes(0, 1), strict=True)
    ]


def _in_range(results: BearingResults, ends: Array) -> BearingResults:
    """The results with the ends of the nodes' temperatures in the one network (2, nodes) [K]."""
    heating = results.heating
    if heating is None or heating.stability is None:
        return results
    stability = replace(heating.stability, coldest=ends[0], hottest=ends[1])
    return replace(results, heating=replace(heating, stability=stability))


def balance_of_heat(case: ShaftCase, solution: ShaftSolution) -> ShaftHeat:
    """Temperatures of shaft and bearings with films without a solve.

    Parameters
    ----------
    case : ShaftCase
        Shaft and bearings that warm themselves.
    solution : ShaftSolution
        Equilibrium at the temperatures of the case.

    Returns
    -------
    ShaftHeat
        Temperatures [K].
    """
    cases = [_held(case, solution, k) for k in range(len(case.cases))]
    return _balance_of_heat(case.system, cases, [None] * len(cases), None)


def _balance_of_heat(
    system: ShaftSystem,
    cases: Sequence[Case],
    reported: Sequence[ReportedTorque | None],
    start: ShaftHeat | None,
) -> ShaftHeat:
    """The balance of heat with films without a solve, scaled to the torque reported."""
    inputs = [(one, one.heating, torque) for one, torque in zip(cases, reported, strict=True)]
    with catch_warnings():
        simplefilter("ignore")  # the search looks beyond the range of the oil's data
        problems = [
            heating_problem(one, given, torque, ends=False)
            for one, given, torque in inputs
            if given is not None
        ]
        models = [given.model for _, given, _ in inputs if given is not None]
        return solve_shaft_heat(system, problems, models, start)


def _among_neighbours(case: Case, heating: SelfHeatingSolution) -> Case:
    """The case with the other bearings on its shaft as neighbours."""
    assert case.heating is not None
    neighbours = heating.around.neighbours
    around = replace(case.heating.around, neighbours=neighbours)
    return replace(case, heating=replace(case.heating, around=around))


def _moved(results: BearingResults, case: Case) -> float:
    """Change of film temperature that the torque of a run asks for [K]."""
    heating = results.heating
    if heating is None or heating.balance is None or not heating.converged:
        return 0.0  # told by the results
    return abs(heating.balance.temperature - case.operation.temperature)


def _vibration(solution: ShaftSolution, bearings: Sequence[BearingResults]) -> ShaftVibration:
    """Critical speeds, frequencies of whirl over the speed, amplitudes under unbalance."""
    films = [ring_damping(one.elastic, one.contacts) for one in bearings]
    matrices: Vibration = vibration(solution, films)
    speed = abs(solution.system.speed)
    critical = critical_speeds(matrices, HIGHEST)[:CRITICAL]
    first = float(critical[0]) if critical.size else LEAST_SPEED
    speeds = np.linspace(0.0, BEYOND * max(speed, first), SPEEDS)
    whirl, ratios = whirl_frequencies(matrices, speeds.tolist(), WHIRLS)
    unbalanced = any(load.unbalance for load in solution.system.loads)
    response = unbalance_response(matrices, solution, speed) if unbalanced and speed else None
    return ShaftVibration(
        critical=critical,
        speeds=speeds,
        whirl=whirl / (2.0 * pi),
        ratios=ratios,
        positions=matrices.beam.positions,
        response=response,
    )
