"""Counts and costs of the equations by load beside the general ones: docs/theory/reduced_equations.md."""

from __future__ import annotations

from dataclasses import replace
from math import inf
from pathlib import Path
from time import process_time
from typing import NamedTuple

from dynamics_runs import RPM, changed

from oilfilm.bearing.dynamics.choices import LoadType
from oilfilm.bearing.dynamics.simulation import Simulation, simulation
from oilfilm.bearing.dynamics.statistics import RunningStatistics, simulation_statistics
from oilfilm.cases import Case, load_case
from oilfilm.cases.runs.motion_model import build_model

PAGE = Path("docs/theory/reduced_equations.md")
TEMPLATE = Path("docs/theory/reduced_equations.md.in")
DURATION = 0.06  # [s]
REPEATS = 6  # of which the least time counts
LOADS = {"axial": (100.0, 0.0), "radial": (0.0, 200.0), "both": (100.0, 200.0)}  # [N]


class Row(NamedTuple):
    """One bearing under one load: counts, steps, processor time [s], cage speeds [rad/s]."""

    name: str
    load: str
    equations: tuple[int, int]
    steps: tuple[int, int]
    seconds: tuple[float, float]
    speeds: tuple[float, float]

    @property
    def ratio(self) -> float:
        """Processor time by load over that of the general equations [-]."""
        return self.seconds[0] / self.seconds[1]

    @property
    def error(self) -> float:
        """Difference of the cage speeds over the speed [-]."""
        return abs(self.speeds[0] / self.speeds[1] - 1.0)

    def line(self) -> str:
        """Row of the table."""
        cells = [f"{self.name}, {self.load}", *map(str, self.equations + self.steps)]
        speeds = " / ".join(f"{speed / RPM:.2f}" for speed in self.speeds)
        return f"| {' | '.join(cells)} | {self.ratio:.3f} | {speeds} | {self.error:.1e} |"


def cases() -> dict[str, dict[str, Case]]:
    """By bearing and load."""
    planar = load_case("6304_planar")
    assert isinstance(planar, Case)
    small = {
        "start": "quasi-static", "speed_table_rpm": None, "race_stiffness": "hertz", "equations": "by load",
        "cage_film": True, "tolerance": 1e-4, "end_time_s": DURATION, "output_interval_us": 50.0,
    }  # fmt: skip
    ellipse = small | {"friction": "four constants", "friction_on": "ellipse"}
    shipped = {"axial": "7008_axial", "radial": "7008_radial", "both": "7008_combined"}
    large = {"end_time_s": DURATION, "output_interval_us": 50.0}
    return {
        "7008": {load: changed(load_case(name), **large) for load, name in shipped.items()},
        "6304": {load: changed(planar, LOADS[load], **ellipse) for load in LOADS},
        "6304, friction at the centre": {load: changed(planar, LOADS[load], **small) for load in LOADS},
    }


def compared(name: str, load: str, case: Case) -> Row:
    """Both runs in turn."""
    model = build_model(case, None, lambda done, total, state: None)
    options = (model.options, replace(model.options, equations=LoadType.GENERAL))
    for given in options:  # compiled
        short = replace(model, options=replace(given, end_time=2e-4, sample_interval=1e-4))
        list(simulation(case.bearing, case.operation, short).pieces())
    least = [inf, inf]
    for _ in range(REPEATS):
        runs = [simulation(case.bearing, case.operation, replace(model, options=given)) for given in options]
        seconds, running = timed(runs)
        least = [min(pair) for pair in zip(least, seconds, strict=True)]
    numbers = [simulation_statistics(*pair) for pair in zip(runs, running, strict=True)]
    first, second = (each for each in numbers if each is not None)
    return Row(
        name,
        load,
        (runs[0].equations["dynamic"], runs[1].equations["dynamic"]),
        (int(runs[0].state.counters[0]), int(runs[1].state.counters[0])),
        (least[0], least[1]),
        (first.cage_speed, second.cage_speed),
    )


def timed(runs: list[Simulation]) -> tuple[tuple[float, float], list[RunningStatistics]]:
    """Processor time of each run [s], piece by piece in turn, and its statistics."""
    seconds, running = [0.0, 0.0], [RunningStatistics(run.bearing.balls) for run in runs]
    pieces = [run.pieces() for run in runs]
    going = True
    while going:
        going = False
        for k, run in enumerate(runs):
            began = process_time()
            record = next(pieces[k], None)
            seconds[k] += process_time() - began
            if record is not None:
                running[k].add(record, run.start_energy)
                going = True
    return (seconds[0], seconds[1]), running


def main() -> None:
    """Measure and write the page."""
    rows = [compared(name, load, case) for name, each in cases().items() for load, case in each.items()]
    text = TEMPLATE.read_text(encoding="utf-8")
    table = "\n".join(row.line() for row in rows)
    worst = max(row.error for row in rows)
    page = text.format(duration=f"{DURATION:g}", rows=table, worst=f"{worst:.1e}")
    PAGE.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()
