"""Several starts of one simulation: whether it ends in one state or in several."""

from collections.abc import Sequence
from dataclasses import replace
from math import pi

from .choices import Start
from .simulation import Simulation, from_state, simulation
from .statistics import RunningStatistics, SimulationStatistics, simulation_statistics

SLOWER = 0.05  # of the first speeds of balls and cage, that the last start lacks [-]
SAME_SPEED = 1.0e-4  # of a cage speed, within which two ends are one state [-]


def other_start(first: Simulation, share: float) -> Simulation:
    """The simulation from another start.

    Balls and pockets are turned by a fraction of a pitch, balls and cage slower by as much of
    `SLOWER`.

    Parameters
    ----------
    first : Simulation
        simulation from the first start
    share : float
        fraction of a pitch [-]

    Returns
    -------
    Simulation
        simulation at its start
    """
    bearing = first.bearing
    turn = share * 2.0 * pi / bearing.balls
    bearing = replace(bearing, first_ball_azimuth=bearing.first_ball_azimuth + turn)
    made = simulation(bearing, first.operation, first.model)
    if first.model.options.start is Start.REST:
        return made
    y = made.state.y.copy()
    for part in (made.layout.cage_speed, made.layout.ball_speed, made.layout.ball_turn):
        y[part] *= 1.0 - SLOWER * share
    return from_state(bearing, first.operation, first.model, (made.point, made.data, y))


def settled(made: Simulation) -> SimulationStatistics | None:
    """Statistics of a simulation, moved to its end.

    Parameters
    ----------
    made : Simulation
        simulation, changed

    Returns
    -------
    SimulationStatistics | None
        statistics; None if it does not get there
    """
    running = RunningStatistics(made.bearing.balls)
    for record in made.pieces():
        running.add(record, made.start_energy)
    return simulation_statistics(made, running) if made.converged else None


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
    found: list[list[SimulationStatistics]] = []
    for end in sorted(ends, key=lambda one: one.cage_speed):
        if found:
            last = found[-1][-1]
            width = (last.cage_interval or 0.0) + (end.cage_interval or 0.0)
            near = max(width, SAME_SPEED * abs(end.cage_speed))
            if end.cage_speed - last.cage_speed <= near:
                found[-1].append(end)
                continue
        found.append([end])
    return found
