"""Results of a time simulation: summary in named units, files, pictures."""

import shutil
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from bearing.dynamics.laws import kinematic_cage_speed
from bearing.dynamics.simulation import Simulation
from bearing.dynamics.statistics import (
    INPUTS,
    LOSSES,
    MECHANISMS,
    RunningStatistics,
    SimulationStatistics,
    nominal_angle,
    simulation_statistics,
)
from ehl.units import RPM

from ..files import SUMMARY_FILE, write_json
from .history import HISTORY_FILE
from .plots import plot_dynamics

ENERGY_LIMIT = 1.0e-3  # of the work put in: a larger residual is flagged [-]
STATES = ("free", "contact", "impact")
WHIRLS = ("ring_whirl_speed_rpm", "cage_whirl_speed_rpm")


@dataclass(frozen=True, slots=True, kw_only=True)
class DynamicsResults:
    """A time simulation of one case.

    Attributes
    ----------
    version : str
    case : dict
        The case document as run.
    simulation : Simulation
        At its end.
    running : RunningStatistics
        What was kept of its records.
    history : Path
        File with the records themselves.
    messages : tuple of str
    timing : dict of float
        [s].
    """

    version: str
    case: dict[str, Any]
    simulation: Simulation
    running: RunningStatistics
    history: Path
    messages: tuple[str, ...]
    timing: dict[str, float]


def dynamics_summary(results: DynamicsResults) -> dict[str, Any]:
    """The simulation as plain JSON in named units; what does not apply is None with the reason in
    `messages`.

    Parameters
    ----------
    results : DynamicsResults

    Returns
    -------
    dict
        Speeds in [r/min], energies in [J], loads in [N], shares of the time [-].
    """
    made = results.simulation
    found = simulation_statistics(made, results.running)
    messages = list(results.messages)
    if found is None:
        messages.append("dynamics: not converged: no sample was reached; all results are null")
    elif found.energy_error > ENERGY_LIMIT:
        text = f"dynamics: not converged: the energies are off by {found.energy_error:.2g} of the work; lower tolerance"
        messages.append(text)
    if found is not None and found.cage_interval is None:
        messages.append("dynamics: fewer than 60 samples: no confidence interval of the speeds")
    still = (
        []
        if found is None
        else [n for n in ("ring", "cage") if getattr(found, f"{n}_whirl") is None]
    )
    if still:
        messages.append(
            f"dynamics: no whirl: the centre of {' and '.join(still)} stays on the axis or is held"
        )
    counts = made.equations
    counters = made.state.counters
    return {
        "oilfilm": results.version,
        "case": results.case,
        "converged": made.converged and found is not None and found.energy_error <= ENERGY_LIMIT,
        "messages": messages,
        "simulated_s": made.state.time,
        "wall_s": made.wall,
        "steps": int(counters[0]),
        "rejected_steps": int(counters[1]),
        "evaluations": int(counters[4]),
        "stiff": made.state.stiff,
        "load_type": made.point.kind.value,
        "equations": counts["dynamic"],
        "equation_counts": counts,
        **_speeds(found),
        "energy": None if found is None else _energy(found),
        "energy_balance_error": None if found is None else found.energy_error,
        "frequencies_Hz": None if found is None else _frequencies(made, found),
        "balls": [] if found is None else _balls(made, found),
        "timing_s": results.timing,
    }


def _speeds(found: SimulationStatistics | None) -> dict[str, float | None]:
    """Means over the last third [r/min] with half widths of their 95 % intervals, and over the
    kinematic speed [-].
    """
    if found is None:
        names = (
            "cage_speed_rpm",
            "ball_orbit_speed_rpm",
            "kinematic_cage_speed_rpm",
            "cage_speed_ratio",
        )
        intervals = ("cage_speed_interval_rpm", "ball_orbit_speed_interval_rpm")
        return dict.fromkeys((*names, *intervals, "cage_slip_ratio", *WHIRLS))
    ratio = found.cage_speed / found.kinematic_speed if found.kinematic_speed else None
    return {
        "cage_speed_rpm": found.cage_speed / RPM,
        "cage_speed_interval_rpm": _rpm(found.cage_interval),
        "ball_orbit_speed_rpm": found.orbit_speed / RPM,
        "ball_orbit_speed_interval_rpm": _rpm(found.orbit_interval),
        "kinematic_cage_speed_rpm": found.kinematic_speed / RPM,
        "cage_speed_ratio": ratio,
        "cage_slip_ratio": None if ratio is None else 1.0 - ratio,
        **{
            name: _rpm(value)
            for name, value in zip(WHIRLS, (found.ring_whirl, found.cage_whirl), strict=True)
        },
    }


def _rpm(value: float | None) -> float | None:
    return None if value is None else value / RPM


def _energy(found: SimulationStatistics) -> dict[str, Any]:
    """[J]."""
    return {
        "input_J": {name: found.work[name] for name in MECHANISMS[:INPUTS]},
        "dissipated_J": {name: found.work[name] for name in MECHANISMS[LOSSES]},
        "films_J": found.work["films"],
        "stored_J": found.stored,
    }


def _frequencies(made: Simulation, found: SimulationStatistics) -> dict[str, Any]:
    """Defect frequencies, kinematic and with the cage speed that came out [Hz]."""
    rows, n = made.data.schedule, made.bearing.balls
    inner, outer = rows[-1, 1] / (2.0 * np.pi), rows[-1, 2] / (2.0 * np.pi)
    ideal = kinematic_cage_speed(made.bearing, inner, outer, nominal_angle(made))
    pairs = {"kinematic": ideal, "with_slip": found.orbit_speed / (2.0 * np.pi)}
    return {
        name: {
            "cage": abs(cage),
            "ball_pass_outer": n * abs(cage - outer),
            "ball_pass_inner": n * abs(inner - cage),
        }
        for name, cage in pairs.items()
    }


def _balls(made: Simulation, found: SimulationStatistics) -> list[dict[str, Any]]:
    races = ("inner", "outer")
    return [
        {
            "ball": j + 1,
            "start_azimuth_deg": float(np.degrees(made.data.pocket_angle[j]) % 360.0),
            **{
                race: {
                    **{state: float(found.shares[r, j, s]) for s, state in enumerate(STATES)},
                    "mean_load_N": float(found.mean_load[r, j]),
                    "largest_load_N": float(found.largest_load[r, j]),
                }
                for r, race in enumerate(races)
            },
            "largest_pocket_load_N": float(found.largest_pocket_load[j]),
        }
        for j in range(made.bearing.balls)
    ]


def write_dynamics(
    results: DynamicsResults, directory: Path, *, pictures: bool = True
) -> tuple[str, ...]:
    """Write summary, history and pictures into a folder; what went wrong with a picture comes back
    as text.

    Parameters
    ----------
    results : DynamicsResults
    directory : Path
    pictures : bool
        Whether to draw.

    Returns
    -------
    tuple of str
        Problems.
    """
    directory.mkdir(parents=True, exist_ok=True)
    document = dynamics_summary(results)
    write_json(document, directory / SUMMARY_FILE)
    shutil.move(results.history, directory / HISTORY_FILE)
    if not pictures or not results.running.rows:
        return ()
    return plot_dynamics(directory, document)
