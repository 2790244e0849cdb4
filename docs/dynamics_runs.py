"""What the pages about simulations share: run a shipped case with changes, keep its numbers."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import pi
from typing import Any

import numpy as np

from bearing.dynamics.outcome import Outcome, Tally, orbit_speeds, outcome
from bearing.dynamics.simulation import Record, Simulation, join, simulation
from cases import Case
from cases.dynamics import build_model

RPM = pi / 30.0  # [rad/s]


@dataclass(frozen=True)
class Run:
    """A simulation that was run to its end."""

    simulation: Simulation
    outcome: Outcome
    record: Record  # of its last third

    @property
    def slides(self) -> Any:
        """Sliding speed at the centres of the contacts over the last third, shape (m, 2, Z) [m/s]; NaN where free."""
        races = self.record.races
        return np.where(races[..., 0] > 0.0, np.hypot(races[..., 5], races[..., 6]), np.nan)

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


def changed(case: Case, load: tuple[float, float] | None = None, speed: float | None = None, **plan: Any) -> Case:
    """A case with another axial and radial load [N], speed [r/min], and fields of its plan [SI]."""
    assert case.dynamics is not None
    operation = case.operation
    if load is not None:
        operation = replace(operation, force=(*load, 0.0))
    if speed is not None:
        operation = replace(operation, inner_speed=speed * RPM)
    return replace(case, operation=operation, dynamics=replace(case.dynamics, **plan))


def run(case: Case) -> Run:
    """Simulate a case; the last third of its history is kept."""
    assert case.dynamics is not None
    model = build_model(case, case.dynamics, None, lambda done, total, state: None)
    made, tally, kept = simulation(case.bearing, case.operation, model), Tally(case.bearing.balls), None
    for record in made.pieces():
        tally.add(record, made.start_energy)
        if record.time[-1] > 2.0 / 3.0 * model.options.end_time:
            kept = record if kept is None else join(kept, record)
    found = outcome(made, tally)
    assert found is not None
    assert kept is not None
    assert made.converged, made.messages
    return Run(made, found, kept)
