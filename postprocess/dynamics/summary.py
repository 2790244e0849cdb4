"""Summary of a time simulation."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from bearing.dynamics.arrays import INNER_SPEED, OUTER_SPEED
from bearing.dynamics.laws import kinematic_cage_speed
from bearing.dynamics.simulation import Simulation
from bearing.dynamics.statistics import (
    INPUTS,
    LOSSES,
    MECHANISMS,
    SimulationStatistics,
    nominal_angle,
    simulation_statistics,
)

from ..quantities import values_of
from .results import DynamicsResults

ENERGY_LIMIT = 1.0e-3  # of the work put in: a larger residual is flagged [-]
STATES = ("free", "contact", "impact")
SPEEDS = {
    "cage_speed_rpm": "cage_speed",
    "cage_speed_interval_rpm": "cage_interval",
    "ball_orbit_speed_rpm": "orbit_speed",
    "ball_orbit_speed_interval_rpm": "orbit_interval",
    "kinematic_cage_speed_rpm": "kinematic_speed",
    "ring_whirl_speed_rpm": "ring_whirl",
    "cage_whirl_speed_rpm": "cage_whirl",
}


def dynamics_summary(results: DynamicsResults) -> dict[str, Any]:
    """The simulation as plain JSON: speeds [r/min], energies [J], loads [N], times [s].

    What does not apply is None with the reason in `messages`.
    """
    simulation = results.simulation
    numbers = simulation_statistics(simulation, results.running)
    state = simulation.state
    balanced = numbers is not None and numbers.energy_error <= ENERGY_LIMIT
    return results.head(simulation.converged and balanced, _messages(numbers)) | {
        "simulated_s": state.time,
        "wall_s": simulation.wall,
        "steps": int(state.counters[0]),
        "rejected_steps": int(state.counters[1]),
        "evaluations": int(state.counters[4]),
        "stiff": state.stiff,
        "load_type": simulation.point.kind.value,
        "equations": simulation.equations["dynamic"],
        "equation_counts": simulation.equations,
        **_speeds(numbers),
        "energy": None if numbers is None else _energy(numbers),
        "energy_balance_error": None if numbers is None else numbers.energy_error,
        "frequencies_Hz": None if numbers is None else _frequencies(simulation, numbers),
        "balls": [] if numbers is None else _balls(simulation, numbers),
        "timing_s": results.timing,
    }


def _messages(numbers: SimulationStatistics | None) -> Iterator[str]:
    if numbers is None:
        yield "dynamics: not converged: no sample was reached; all results are null"
        return
    if numbers.energy_error > ENERGY_LIMIT:
        error = f"{numbers.energy_error:.2g} of the work"
        yield f"dynamics: not converged: the energies are off by {error}; lower tolerance"
    if numbers.cage_interval is None:
        yield "dynamics: fewer than 60 samples: no confidence interval of the speeds"
    still = [name for name in ("ring", "cage") if getattr(numbers, f"{name}_whirl") is None]
    if still:
        yield (
            f"dynamics: no whirl: the centre of {' and '.join(still)} stays on the axis or is held"
        )


def _speeds(numbers: SimulationStatistics | None) -> dict[str, float | None]:
    """Means over the last third [r/min], half widths of their 95 % intervals, and ratios [-]."""
    kinematic = None if numbers is None else numbers.kinematic_speed
    ratio = numbers.cage_speed / kinematic if numbers is not None and kinematic else None
    return {
        **values_of(numbers, SPEEDS),
        "cage_speed_ratio": ratio,
        "cage_slip_ratio": None if ratio is None else 1.0 - ratio,
    }


def _energy(numbers: SimulationStatistics) -> dict[str, Any]:
    """[J]."""
    return {
        "input_J": {name: numbers.work[name] for name in MECHANISMS[:INPUTS]},
        "dissipated_J": {name: numbers.work[name] for name in MECHANISMS[LOSSES]},
        "films_J": numbers.work["films"],
        "stored_J": numbers.stored,
    }


def _frequencies(simulation: Simulation, numbers: SimulationStatistics) -> dict[str, Any]:
    """Defect frequencies, kinematic and with the cage speed of the simulation [Hz]."""
    schedule, balls = simulation.data.schedule, simulation.bearing.balls
    inner = schedule[-1, INNER_SPEED] / (2.0 * np.pi)
    outer = schedule[-1, OUTER_SPEED] / (2.0 * np.pi)
    angle = nominal_angle(simulation)
    speeds = {
        "kinematic": kinematic_cage_speed(simulation.bearing, inner, outer, angle),
        "with_slip": numbers.orbit_speed / (2.0 * np.pi),
    }
    return {
        name: {
            "cage": abs(cage),
            "ball_pass_outer": balls * abs(cage - outer),
            "ball_pass_inner": balls * abs(inner - cage),
        }
        for name, cage in speeds.items()
    }


def _balls(simulation: Simulation, numbers: SimulationStatistics) -> list[dict[str, Any]]:
    angles = np.degrees(simulation.data.pocket_angle) % 360.0
    return [
        {
            "ball": j + 1,
            "start_azimuth_deg": float(angles[j]),
            **{
                race: {
                    **{state: float(numbers.shares[r, j, s]) for s, state in enumerate(STATES)},
                    "mean_load_N": float(numbers.mean_load[r, j]),
                    "largest_load_N": float(numbers.largest_load[r, j]),
                }
                for r, race in enumerate(("inner", "outer"))
            },
            "largest_pocket_load_N": float(numbers.largest_pocket_load[j]),
        }
        for j in range(simulation.bearing.balls)
    ]
