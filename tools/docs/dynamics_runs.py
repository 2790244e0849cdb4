"""What the pages about simulations share: run a shipped case with changes, keep its numbers."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import pi
from pathlib import Path
from typing import Any

import numpy as np

from oilfilm.bearing.dynamics.record import Record, join
from oilfilm.bearing.dynamics.simulation import Simulation, simulation
from oilfilm.bearing.dynamics.statistics import (
    RunningStatistics,
    SimulationStatistics,
    orbit_speeds,
    simulation_statistics,
)
from oilfilm.cases import Case
from oilfilm.cases.runs.motion_model import build_model

RPM = pi / 30.0  # [rad/s]


@dataclass(frozen=True)
class Run:
    """A simulation that was run to its end."""

    simulation: Simulation
    statistics: SimulationStatistics
    running: RunningStatistics
    record: Record  # of its last third

    @property
    def slides(self) -> Any:
        """Sliding speed at the contacts over the last third, (m, 2, Z) [m/s]; NaN where free."""
        races = self.record.races
        return np.where(races[..., 0] > 0.0, np.hypot(races[..., 5], races[..., 6]), np.nan)

    @property
    def surface_slides(self) -> Any:
        """As `slides`, and at a gap that of the nearest points of the surfaces [m/s]."""
        from oilfilm.bearing.dynamics._motion_kernels import place_bodies, schedule_at
        from oilfilm.bearing.dynamics._race_kernels import race_motion
        from oilfilm.bearing.dynamics._state_kernels import ball_motion
        from oilfilm.bearing.dynamics.arrays import INNER_SPEED, OUTER_SPEED

        data = self.simulation.data
        c = data.constants
        grooves = ((c.inner_centre, c.inner_groove), (c.outer_centre, c.outer_groove))
        slides = []
        for time, state in zip(self.record.time, self.record.state, strict=True):
            schedule_at(data.times, data.schedule, float(time), data.prescribed)
            rings = place_bodies(c.balls, state, data.prescribed[INNER_SPEED], data.prescribed[OUTER_SPEED])[:2]
            balls = [ball_motion(state, c.balls, j) for j in range(c.balls)]
            for ring, groove in zip(rings, grooves, strict=True):
                motions = [race_motion(c, ring, *groove, *ball) for ball in balls]
                slides += [np.hypot(motion.slide_x, motion.slide_y) for motion in motions]
        return np.array(slides).reshape(len(self.record.time), 2, c.balls)

    @property
    def azimuths(self) -> Any:
        """Of the balls from the load line, shape (m, Z), from -180 to 180 [deg]."""
        place = self.record.state[:, self.simulation.layout.ball].reshape(len(self.record.state), -1, 3)
        return np.degrees(np.arctan2(place[..., 2], place[..., 1]))

    @property
    def factors(self) -> Any:
        """Friction over load, shape (m, 2, Z) [-]; NaN where free."""
        races = self.record.races
        pull = np.hypot(races[..., 8], races[..., 9])
        return np.divide(pull, races[..., 0], out=np.full(pull.shape, np.nan), where=races[..., 0] > 0.0)

    @property
    def spread(self) -> float:
        """Standard deviation of the balls' orbit speeds over the last third [rad/s]."""
        return float(orbit_speeds(self.record.state, self.simulation.layout).std())


def over_azimuth(result: Run, values: Any, bins: int = 60) -> tuple[Any, Any]:
    """Middles of equal parts of the turn [deg], means of values (m, Z) there; NaN if empty."""
    edges = np.linspace(-180.0, 180.0, bins + 1)
    sound = np.isfinite(values)
    place, weights = result.azimuths[sound], values[sound]
    count, total = np.histogram(place, edges)[0], np.histogram(place, edges, weights=weights)[0]
    return 0.5 * (edges[1:] + edges[:-1]), np.divide(total, count, out=np.full(bins, np.nan), where=count > 0)


def changed(case: Case, load: tuple[float, float] | None = None, speed: float | None = None, **keys: Any) -> Case:
    """A case with another axial and radial load [N], speed [r/min], keys of [dynamics]."""
    assert case.file.dynamics is not None
    operation = case.operation
    if load is not None:
        operation = replace(operation, force=(*load, 0.0))
    if speed is not None:
        operation = replace(operation, inner_speed=speed * RPM)
    table = case.file.dynamics.model_copy(update=keys)
    return replace(case, operation=operation, file=case.file.model_copy(update={"dynamics": table}))


def run(case: Case, tables: Path | None = None) -> Run:
    """Simulate a case, with traction tables of a file; the last third of its history is kept."""
    model = build_model(case, tables, lambda done, total, state: None)
    simulated = simulation(case.bearing, case.operation, model)
    running = RunningStatistics(case.bearing.balls)
    last = None
    for record in simulated.pieces():
        running.add(record, simulated.start_energy)
        if record.time[-1] > 2.0 / 3.0 * model.options.end_time:
            last = record if last is None else join(last, record)
    statistics = simulation_statistics(simulated, running)
    assert statistics is not None
    assert last is not None
    assert simulated.converged, simulated.messages
    return Run(simulated, statistics, running, last)
