"""Where the cage of a 7008 whirls, over speed, pocket play and friction: docs/theory/cage_stability.md."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
from dynamics_runs import changed

from oilfilm.bearing.dynamics.choices import LoadType
from oilfilm.bearing.dynamics.simulation import from_state, simulation
from oilfilm.bearing.dynamics.statistics import RunningStatistics, SimulationStatistics, simulation_statistics
from oilfilm.cases import Case, load_case
from oilfilm.cases.runs.motion_model import build_model

PAGE = Path("docs/theory/cage_stability.md")
TEMPLATE = Path("docs/theory/cage_stability.md.in")
SPEEDS = (5000.0, 10000.0)  # [r/min]
PLAYS = (0.1, 0.2, 0.4)  # diametral [mm]
FRICTIONS = (0.0, 0.05, 0.2)  # of ball and pocket [-]
LOAD = (100.0, 0.0)  # [N]
TURNS = 4.0  # of the inner ring
PUSHED = 0.5  # of the play that the cage is off the axis at first [-]


class Point(NamedTuple):
    """One simulation: speed [r/min], play [mm], friction [-], oil in the pockets or none, what came out."""

    speed: float
    play: float
    friction: float
    oil: bool
    statistics: SimulationStatistics

    def cell(self) -> str:
        """Radius over play, whirl over cage speed, largest pocket force."""
        found = self.statistics
        share = (found.cage_orbit or 0.0) / (found.cage_play or 1.0)
        if not found.cage_whirls:
            return f"{share:.2f}"
        ratio = (found.cage_whirl or 0.0) / found.cage_speed
        return f"**{share:.2f}**, {ratio:.1f}, {found.largest_pocket_load.max():.1f} N"


def simulated(speed: float, play: float, friction: float, *, oil: bool) -> Point:
    """The cage pushed off the axis, all coordinates free."""
    case = load_case("7008_axial")
    assert isinstance(case, Case)
    end = TURNS * 60.0 / speed
    case = changed(case, LOAD, speed, end_time_s=end, output_interval_us=1e6 * end / 600.0, cage_film=oil)
    assert case.file.cage is not None
    cage = case.file.cage.model_copy(update={"pocket_clearance_mm": play, "pocket_friction": friction})
    case = replace(case, file=case.file.model_copy(update={"cage": cage}))
    model = build_model(case, None, lambda done, total, state: None)
    model = replace(model, options=replace(model.options, equations=LoadType.GENERAL))
    made = simulation(case.bearing, case.operation, model)
    y = made.state.y.copy()
    y[made.layout.cage][1] = PUSHED * 0.5e-3 * play
    made = from_state(case.bearing, case.operation, model, (made.point, made.data, y))
    running = RunningStatistics(case.bearing.balls)
    for record in made.pieces():
        running.add(record, made.start_energy)
    statistics = simulation_statistics(made, running)
    assert statistics is not None
    assert made.converged, made.messages
    return Point(speed, play, friction, oil, statistics)


def table(points: list[Point]) -> str:
    """Rows by oil, speed and play, columns by friction."""
    lines = []
    for oil in (True, False):
        for speed in SPEEDS:
            for play in PLAYS:
                chosen = [p for p in points if (p.oil, p.speed, p.play) == (oil, speed, play)]
                cells = " | ".join(point.cell() for point in chosen)
                lines.append(f"| {'oil' if oil else 'dry'} | {speed:.0f} | {play:g} | {cells} |")
    return "\n".join(lines)


def main() -> None:
    """Simulate the map and write the page."""
    points = [
        simulated(speed, play, friction, oil=oil)
        for oil in (True, False)
        for speed in SPEEDS
        for play in PLAYS
        for friction in FRICTIONS
    ]
    whirling = [point for point in points if point.statistics.cage_whirls]
    wet = sum(point.oil for point in whirling)
    rates = [point.statistics.cage_whirl / point.statistics.cage_speed for point in whirling]
    ratios = f"{np.min(np.abs(rates)):.1f} to {np.max(np.abs(rates)):.1f}" if rates else "none"
    text = TEMPLATE.read_text(encoding="utf-8").format(
        rpm=", ".join(f"{speed:.0f}" for speed in SPEEDS),
        turns=f"{TURNS:g}",
        rows=table(points),
        wet=f"{wet} of {len(points) // 2}",
        dry=f"{len(whirling) - wet} of {len(points) // 2}",
        ratios=ratios,
        energy=f"{max(point.statistics.energy_error for point in points):.0e}",
    )
    PAGE.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
