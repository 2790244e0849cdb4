"""Statistics of a simulation: energies, speeds with intervals, contact states, whirl; and of
several starts of one simulation, which end in one state or in several.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from math import pi

import numpy as np
from numpy.typing import NDArray

from oilfilm.ehl.arrays import Array

from ..quasistatic.solution import kinematic_cage_speed
from .arrays import CAGE_ROTATION, CONTACT, GUIDED_BY_BALLS, INNER_SPEED, OUTER_SPEED, WORK, Layout
from .choices import Start
from .record import Record
from .simulation import Simulation, from_state, simulation

BATCHES = 10  # fewest of the ten to thirty of Schmeiser (1982), Operations Research 30, 556
STUDENT = 2.2622  # 97.5 % of Student's distribution with BATCHES - 1 degrees of freedom
SMALLEST_SAMPLE = 2 * BATCHES  # values, below which no interval is given
SMALLEST_ORBIT = 1.0e-12  # of a centre, below which it has no whirl [m]
# a cage whirls where its centre goes round on this share of its play, and one way: net turning
# over all turning [-]
WHIRL_SHARE = 0.5
ONE_WAY = 0.8
FEWEST_PLACES = 3  # of a centre, below which its turning is not told
# fraction of the energy at the start, stored in contacts at standstill, below which work is that
# of nothing moving, and no measure of an error [-]
STILL = 1.0e-3
AVERAGED_SHARE = 1.0 / 3.0  # of the time, over which speeds are averaged [-]
MECHANISMS = WORK._fields
INPUTS = 3  # of them put energy in
LOSSES = slice(INPUTS, -1)  # those that dissipate it; the last, the films, gives or takes

SLOWER = 0.05  # of the first speeds of balls and cage, that the last start lacks [-]
SAME_SPEED = 1.0e-4  # of a cage speed, within which two ends are one state [-]


@dataclass(slots=True)
class RunningStatistics:
    """Sums over the records of a simulation, whose history itself goes to disk."""

    balls: int
    time: list[Array] = field(default_factory=list)
    cage_rotation: list[Array] = field(default_factory=list)  # [rad]
    orbit_speed: list[Array] = field(default_factory=list)  # mean of the balls [rad/s]
    spin_speed: list[Array] = field(default_factory=list)  # about their own axes, likewise [rad/s]
    centres: list[Array] = field(default_factory=list)  # y, z of ring and of cage, (m, 4) [m]
    angle: list[Array] = field(default_factory=list)  # of contact, mean by load [rad]
    load_sum: Array = field(init=False)  # (2, Z) [N]
    load_largest: Array = field(init=False)  # (2, Z) [N]
    pocket_largest: Array = field(init=False)  # (Z,) [N]
    touching: Array = field(init=False)  # samples under a load (2, Z) [-]
    slide_sum: Array = field(init=False)  # sliding at the contacts' centres (2, Z) [m/s]
    slide_largest: Array = field(init=False)  # (2, Z) [m/s]
    friction_sum: Array = field(init=False)  # (2, Z) [N]
    residual: float = 0.0  # largest of the energies [J]
    rows: int = 0

    def __post_init__(self) -> None:
        sums = (
            "load_sum",
            "load_largest",
            "touching",
            "slide_sum",
            "slide_largest",
            "friction_sum",
        )
        for name in sums:
            setattr(self, name, np.zeros((2, self.balls)))
        self.pocket_largest = np.zeros(self.balls)

    def add(self, record: Record, start_energy: float) -> None:
        """Add a record to the sums.

        Parameters
        ----------
        record : Record
            rows of the history
        start_energy : float
            energy at the start [J]
        """
        layout = Layout(self.balls)
        self.time.append(record.time)
        self.cage_rotation.append(record.state[:, layout.cage][:, CAGE_ROTATION].copy())
        orbits = orbit_speeds(record.state, layout)
        self.orbit_speed.append(orbits.mean(axis=1))
        turns = record.state[:, layout.ball_turn].reshape(len(orbits), -1, 3)
        self.spin_speed.append(spin_speeds(turns, orbits).mean(axis=1))
        self.centres.append(
            np.hstack([record.state[:, part][:, 1:3] for part in (layout.ring, layout.cage)])
        )
        loads = record.races[..., CONTACT.load]
        pockets = record.pockets[..., CONTACT.load]
        self.angle.append(angle_by_load(loads, record.races[..., CONTACT.contact_angle]))
        self.load_sum += loads.sum(axis=0)
        self.load_largest = np.maximum(self.load_largest, loads.max(axis=0))
        self.pocket_largest = np.maximum(self.pocket_largest, pockets.max(axis=0))
        self._add_sliding(record.races, loads > 0.0)
        work = record.state[:, layout.energy]
        change = record.energy.sum(axis=1) - start_energy
        error = change - work[:, :INPUTS].sum(axis=1) + work[:, INPUTS:].sum(axis=1)
        self.residual = max(self.residual, float(np.abs(error).max()))
        self.rows += record.time.size

    def _add_sliding(self, races: Array, loaded: NDArray[np.bool_]) -> None:
        """Sliding and friction where a race is loaded."""
        slide = np.hypot(races[..., CONTACT.slide_x], races[..., CONTACT.slide_y]) * loaded
        pull = np.hypot(races[..., CONTACT.friction_x], races[..., CONTACT.friction_y])
        self.touching += loaded.sum(axis=0)
        self.slide_sum += slide.sum(axis=0)
        self.slide_largest = np.maximum(self.slide_largest, slide.max(axis=0))
        self.friction_sum += (pull * loaded).sum(axis=0)


@dataclass(frozen=True, slots=True, kw_only=True)
class SimulationStatistics:
    """Numbers of a simulation."""

    simulated: float  # [s]
    wall: float  # [s]
    cage_speed: float  # mean over the last third [rad/s]
    orbit_speed: float  # of the balls, likewise [rad/s]
    spin_speed: float  # of the balls about their own axes in the frame of the cage [rad/s]
    contact_angle: float  # mean by load, likewise [rad]
    kinematic_speed: float  # without sliding at this angle, likewise [rad/s]
    cage_interval: float | None  # half width of the 95 % confidence interval [rad/s]
    orbit_interval: float | None  # [rad/s]
    ring_whirl: float | None  # of the centre over the last third; None where it stays [rad/s]
    cage_whirl: float | None  # [rad/s]
    cage_orbit: float | None  # root mean square radius about its mean [m]
    cage_play: float | None  # in its pockets or lands, which the radius may reach [m]
    one_way: float | None  # net turning of the cage's centre over all of it [-]
    averaged: int  # samples that means and whirl are of [-]
    work: dict[str, float]  # put in, lost and taken up by films, by mechanism [J]
    stored: float  # change of kinetic, elastic and potential energy [J]
    # largest residual over the total input or, where that is less, over what was lost, or over
    # `STILL` of the energy at the start
    energy_error: float  # [-]
    shares: Array  # of the time separated, in contact, in an impact, shape (2, Z, 3) [-]
    mean_load: Array  # [N], shape (2, Z)
    largest_load: Array  # [N]
    # at the centres of contacts while they are loaded, shape (2, Z); zero where one never is
    mean_sliding: Array  # [m/s]
    largest_sliding: Array  # [m/s]
    mean_friction: Array  # [N]
    largest_pocket_load: Array  # [N], shape (Z,)

    @property
    def cage_speed_ratio(self) -> float | None:
        """Speed of the cage over the kinematic one [-]; None where that is zero."""
        return self.cage_speed / self.kinematic_speed if self.kinematic_speed else None

    @property
    def cage_whirls(self) -> bool | None:
        """True if the cage's centre goes round in a large part of its play; None without a cage or
        of too few samples.
        """
        if self.cage_play is None or self.averaged < FEWEST_PLACES:
            return None
        if self.cage_orbit is None or self.one_way is None:
            return False
        return self.cage_orbit >= WHIRL_SHARE * self.cage_play and self.one_way >= ONE_WAY

    @property
    def cage_slip_ratio(self) -> float | None:
        """Speed that the cage lacks, over the kinematic one [-]."""
        return None if self.cage_speed_ratio is None else 1.0 - self.cage_speed_ratio


def orbit_speeds(states: Array, layout: Layout) -> Array:
    """Angular speeds of the balls' centres about the axis.

    Parameters
    ----------
    states : Array
        state vectors, shape (m, size) [SI]
    layout : Layout
        slices of the state vector

    Returns
    -------
    Array
        speeds, shape (m, Z) [rad/s]
    """
    position = states[:, layout.ball].reshape(len(states), -1, 3)
    speed = states[:, layout.ball_speed].reshape(len(states), -1, 3)
    turn = position[..., 1] * speed[..., 2] - position[..., 2] * speed[..., 1]
    result: Array = turn / (position[..., 1] ** 2 + position[..., 2] ** 2)
    return result


def spin_speeds(turns: Array, orbits: Array) -> Array:
    """Angular speeds of balls about their own axes in the frame that goes round with them.

    Parameters
    ----------
    turns : Array
        angular velocities of the balls, shape (m, Z, 3) [rad/s]
    orbits : Array
        orbit speeds, shape (m, Z) [rad/s]

    Returns
    -------
    Array
        speeds, shape (m, Z) [rad/s]
    """
    result: Array = np.hypot(np.hypot(turns[..., 0] - orbits, turns[..., 1]), turns[..., 2])
    return result


def angle_by_load(loads: Array, angles: Array) -> Array:
    """Mean contact angle, weighed by the loads.

    Parameters
    ----------
    loads : Array
        loads of all contacts, shape (m, 2, Z) [N]
    angles : Array
        contact angles, shape (m, 2, Z) [rad]

    Returns
    -------
    Array
        mean angle, zero without a load, shape (m,) [rad]
    """
    turned = (loads * np.abs(angles)).sum(axis=(1, 2))
    result: Array = turned / np.maximum(loads.sum(axis=(1, 2)), 1e-300)
    return result


def simulation_statistics(
    simulation: Simulation, running: RunningStatistics
) -> SimulationStatistics | None:
    """Statistics of a whole simulation.

    Parameters
    ----------
    simulation : Simulation
        simulation at its end
    running : RunningStatistics
        sums over its records

    Returns
    -------
    SimulationStatistics | None
        statistics; None if not one sample was reached
    """
    if not running.rows:
        return None
    time = np.concatenate(running.time)
    state = simulation.state
    late = time >= (1.0 - AVERAGED_SHARE) * time[-1]
    late[-2:] = True
    cage = np.concatenate(running.cage_rotation)[late]
    orbit = np.concatenate(running.orbit_speed)[late]
    centres = np.concatenate(running.centres)[late]
    angle = float(np.concatenate(running.angle)[late].mean())
    span = float(time[late][-1] - time[late][0])
    has_cage = simulation.data.constants.cage_mass > 0.0 and span > 0.0
    work = state.y[simulation.layout.energy]
    put_in = float(np.sum(work[:INPUTS]))
    dissipated = float(np.sum(work[LOSSES]))
    return SimulationStatistics(
        simulated=state.time,
        wall=simulation.wall,
        cage_speed=float(cage[-1] - cage[0]) / span if has_cage else float(orbit.mean()),
        orbit_speed=float(orbit.mean()),
        spin_speed=float(np.concatenate(running.spin_speed)[late].mean()),
        contact_angle=angle,
        kinematic_speed=speed_without_slip(simulation, time[late], angle),
        cage_interval=batch_interval(np.diff(cage) / np.diff(time[late]) if has_cage else orbit),
        orbit_interval=batch_interval(orbit),
        ring_whirl=whirl_speed(time[late], centres[:, :2]),
        cage_whirl=whirl_speed(time[late], centres[:, 2:]),
        **_cage_orbit(simulation, centres[:, 2:]),
        averaged=int(late.sum()),
        work=dict(zip(MECHANISMS, work.tolist(), strict=True)),
        stored=put_in - dissipated - float(work[-1]),
        energy_error=_energy_error(running.residual, put_in, dissipated, simulation.start_energy),
        shares=state.shares / max(state.time, 1e-300),
        mean_load=running.load_sum / running.rows,
        largest_load=running.load_largest,
        mean_sliding=running.slide_sum / np.maximum(running.touching, 1.0),
        largest_sliding=running.slide_largest,
        mean_friction=running.friction_sum / np.maximum(running.touching, 1.0),
        largest_pocket_load=running.pocket_largest,
    )


def _energy_error(residual: float, put_in: float, dissipated: float, start: float) -> float:
    """A residual over the work or a share of the energy at the start, all in [J]."""
    return residual / max(abs(put_in), abs(dissipated), STILL * abs(start), 1e-300)


def _cage_orbit(simulation: Simulation, position: Array) -> dict[str, float | None]:
    """Radius [m], play [m] and share of one-way turning [-] of the cage's centre."""
    c = simulation.data.constants
    if c.cage_mass <= 0.0:
        return {"cage_orbit": None, "cage_play": None, "one_way": None}
    off = position - position.mean(axis=0)
    play = c.pocket_play if c.guide == GUIDED_BY_BALLS else c.land_clearance
    radius = float(np.sqrt((off**2).sum(axis=1).mean()))
    if radius < SMALLEST_ORBIT:
        return {"cage_orbit": None, "cage_play": play, "one_way": None}
    steps = np.diff(np.unwrap(np.arctan2(off[:, 1], off[:, 0])))
    total = float(np.abs(steps).sum())
    one_way = abs(float(steps.sum())) / total if total > 0.0 else None
    return {"cage_orbit": radius, "cage_play": play, "one_way": one_way}


def speed_without_slip(simulation: Simulation, times: Array, angle: float) -> float:
    """Speed of the cage without sliding, at the rings' mean speeds.

    Parameters
    ----------
    simulation : Simulation
        simulation with its schedule
    times : Array
        times over which the speeds are averaged [s]
    angle : float
        contact angle [rad]

    Returns
    -------
    float
        speed [rad/s]
    """
    data = simulation.data
    inner, outer = (
        float(np.interp(times, data.times, data.schedule[:, ring]).mean())
        for ring in (INNER_SPEED, OUTER_SPEED)
    )
    return kinematic_cage_speed(simulation.bearing, inner, outer, angle)


def batch_interval(values: Array) -> float | None:
    """Half width of the 95 % confidence interval of the mean of evenly sampled values.

    By the means of batches: the history is cut into `BATCHES` equal pieces, whose means are taken
    for independent: they are if a piece is longer than the slowest motion, so ten turns of the
    cage are needed for a motion that goes round with it. A trend widens the interval.

    Parameters
    ----------
    values : Array
        samples, shape (m,) [any unit]

    Returns
    -------
    float | None
        half width, in the unit of the values; None below `SMALLEST_SAMPLE` values [any unit]
    """
    if values.size < SMALLEST_SAMPLE:
        return None
    size = values.size // BATCHES
    means = values[values.size - size * BATCHES :].reshape(BATCHES, size).mean(axis=1)
    return STUDENT * float(means.std(ddof=1)) / BATCHES**0.5


def whirl_speed(time: Array, position: Array) -> float | None:
    """Mean angular speed of a centre's path about its own mean, positive as the axis turns.

    Parameters
    ----------
    time : Array
        times, shape (m,) [s]
    position : Array
        y and z of the centre, shape (m, 2) [m]

    Returns
    -------
    float | None
        speed [rad/s]; None if the centre stays within a picometre, or for fewer than three samples
    """
    off = position - position.mean(axis=0)
    if time.size < FEWEST_PLACES or np.abs(off).max() < SMALLEST_ORBIT:
        return None
    angle = np.unwrap(np.arctan2(off[:, 1], off[:, 0]))
    return float(angle[-1] - angle[0]) / float(time[-1] - time[0])


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
