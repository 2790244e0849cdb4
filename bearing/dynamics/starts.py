"""Several starts of one simulation: whether it ends in one state or in several."""

from collections.abc import Sequence
from dataclasses import replace
from math import pi

from .choices import Start
from .simulation import Simulation, from_state, simulation
from .statistics import RunningStatistics, SimulationStatistics, simulation_statistics

SLOWER = 0.05  # of the first speeds of balls and cage, that the last start lacks [-]
SAME_SPEED = 1.0e-4  # of a cage speed, within which two ends are one state [-]


def other_start(first: Simulation, fraction: float) -> Simulation:
    """The simulation from another start.

    Balls and pockets are turned by a fraction of a pitch, balls and cage slower by as much of
    `SLOWER`.

    Parameters
    ----------
    first : Simulation
        simulation from the first start
    fraction : float
        fraction of a pitch [-]

    Returns
    -------
    Simulation
        simulation at its start
    """
    bearing = first.bearing
    turn = fraction * 2.0 * pi / bearing.balls
    bearing = replace(bearing, first_ball_azimuth=bearing.first_ball_azimuth + turn)
    run = simulation(bearing, first.operation, first.model)
    if first.model.options.start is Start.REST:
        return run
    y = run.state.y.copy()
    for speeds in (run.layout.cage_speed, run.layout.ball_speed, run.layout.ball_turn):
        y[speeds] *= 1.0 - SLOWER * fraction
    return from_state(bearing, first.operation, first.model, (run.point, run.data, y))


def simulated_statistics(run: Simulation) -> SimulationStatistics | None:
    """Statistics of a simulation, moved to its end.

    Parameters
    ----------
    run : Simulation
        simulation, changed

    Returns
    -------
    SimulationStatistics | None
        statistics; None if it does not get there
    """
    running = RunningStatistics(run.bearing.balls)
    for record in run.pieces():
        running.add(record, run.start_energy)
    return simulation_statistics(run, running) if run.converged else None


def states(ends: Sequence[SimulationStatistics]) -> list[list[SimulationStatistics]]:
    """Ends of several starts by their states, slowest cage first.

    A state begins where a cage speed is farther from the one below than their intervals, and
    `SAME_SPEED`, allow.

    Parameters
    ----------
    ends : Sequence[SimulationStatistics]
        statistics of the simulations

    Returns
    -------
    list[list[SimulationStatistics]]
        one list of ends for each state
    """
    groups: list[list[SimulationStatistics]] = []
    for end in sorted(ends, key=lambda one: one.cage_speed):
        if groups:
            last = groups[-1][-1]
            width = (last.cage_interval or 0.0) + (end.cage_interval or 0.0)
            tolerance = max(width, SAME_SPEED * abs(end.cage_speed))
            if end.cage_speed - last.cage_speed <= tolerance:
                groups[-1].append(end)
                continue
        groups.append([end])
    return groups
