"""A time simulation of one case."""

from dataclasses import dataclass
from pathlib import Path

from bearing.dynamics.simulation import Simulation
from bearing.dynamics.statistics import RunningStatistics, SimulationStatistics

from ..results import Results


@dataclass(frozen=True, slots=True, kw_only=True)
class DynamicsResults(Results):
    """A time simulation of one case, at its end."""

    simulation: Simulation
    running: RunningStatistics  # of its records
    history: Path  # file with the records themselves
    # ends of further starts, without a history; None: one did not get there
    others: tuple[SimulationStatistics | None, ...] = ()
