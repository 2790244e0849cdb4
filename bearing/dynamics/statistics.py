"""Statistics of a simulation: energies, speeds with intervals, contact states, whirl; and of
several starts of one simulation, which end in one state or in several.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from math import pi
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.traction_table.table import TractionTable

from ..friction.tables import SAME_RADIUS
from ..geometry import Bearing, Race
from ..quasistatic.solution import kinematic_cage_speed
from .arrays import (
    CAGE_ROTATION,
    CONTACT,
    GUIDED_BY_BALLS,
    INNER_SPEED,
    MOMENT,
    OUTER_SPEED,
    WORK,
    Layout,
)
from .assembly import entrainment_speeds
from .choices import Start
from .record import Record
from .simulation import Simulation, from_state, simulation

BATCHES = 10  # fewest of the ten to thirty of Schmeiser (1982), Operations Research 30, 556
STUDENT = 2.2622  # 97.5 % of Student's distribution with BATCHES - 1 degrees of freedom
STUDENT_TREND = 2.306  # 97.5 % with BATCHES - 2 degrees of freedom, of a straight line
DRIFT = 1.0e-3  # change over the values, over their mean, below which a trend is none [-]
FASTEST_DECAY = 0.05  # of a trend from mean to mean; a faster one is over in a mean [-]
BLOCKS = 2000  # of rows, over which sums are kept
ROUNDING = 1e-9  # of the ends of a table [-]
SUMS = 5  # load, samples under a load, sliding, friction, samples beyond a table
SLIDES = (0.003, 0.01, 0.03, 0.1, 0.3)  # sliding over rolling at which friction is largest [-]
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
INPUTS = 4  # of them put energy in
LOSSES = slice(INPUTS, -1)  # those that dissipate it; the last, the films, gives or takes

SLOWER = 0.05  # of the first speeds of balls and cage, that the last start lacks [-]
SAME_SPEED = 1.0e-4  # of a cage speed, within which two ends are one state [-]


@dataclass(slots=True)
class RunningStatistics:
    """Sums over the records of a simulation, whose history itself goes to disk."""

    balls: int
    block: int = 1  # rows whose sums are kept together [-]
    # first and last load [N], speed [m/s], cosine of the angle [-] of the races' tables, (2, 3, 2)
    limits: Array | None = None
    time: list[Array] = field(default_factory=list)
    cage_rotation: list[Array] = field(default_factory=list)  # [rad]
    orbit_speed: list[Array] = field(default_factory=list)  # mean of the balls [rad/s]
    spin_speed: list[Array] = field(default_factory=list)  # about their own axes, likewise [rad/s]
    centres: list[Array] = field(default_factory=list)  # y, z of ring and of cage, (m, 4) [m]
    angle: list[Array] = field(default_factory=list)  # of contact, mean by load [rad]
    torque: list[Array] = field(default_factory=list)  # of friction, on the inner ring [N m]
    # turning of the balls about the tangents of their orbits, and its couple over their inertia,
    # means (m, 2) [rad/s], [rad^2/s^2]
    gyroscopic: list[Array] = field(default_factory=list)
    block_time: list[Array] = field(default_factory=list)  # of the last rows of blocks [s]
    sums: list[Array] = field(default_factory=list)  # over blocks, (m, SUMS, 2, Z)
    load_largest: Array = field(init=False)  # (2, Z) [N]
    pocket_largest: Array = field(init=False)  # (Z,) [N]
    slide_largest: Array = field(init=False)  # (2, Z) [m/s]
    fastest: Array = field(init=False)  # entrainment under a load, (2,) [m/s]
    residual: float = 0.0  # largest of the energies [J]
    # works and energy that the balance starts with: at rest, or after the settling time [J]
    work_before: Array | None = None
    start_energy: float = 0.0  # [J]
    settles: bool = False
    rows: int = 0

    def __post_init__(self) -> None:
        for name in ("load_largest", "slide_largest"):
            setattr(self, name, np.zeros((2, self.balls)))
        self.pocket_largest = np.zeros(self.balls)
        self.fastest = np.zeros(2)

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
        self.torque.append(-record.loads[:, MOMENT])
        self.gyroscopic.append(gyroscopic_motion(record.state, layout, orbits))
        self.load_largest = np.maximum(self.load_largest, loads.max(axis=0))
        self.pocket_largest = np.maximum(self.pocket_largest, pockets.max(axis=0))
        self._add_contacts(record, loads)
        work = record.state[:, layout.energy]
        stored = record.energy.sum(axis=1)
        if self.work_before is None:
            self.work_before = work[0].copy() if self.settles else np.zeros(work.shape[1])
            self.start_energy = float(stored[0]) if self.settles else start_energy
        work = work - self.work_before
        change = stored - self.start_energy
        error = change - work[:, :INPUTS].sum(axis=1) + work[:, INPUTS:].sum(axis=1)
        self.residual = max(self.residual, float(np.abs(error).max()))
        self.rows += record.time.size

    def _add_contacts(self, record: Record, loads: Array) -> None:
        """Loads, and sliding and friction where a race is loaded, and whether its table goes on
        there.
        """
        races = record.races
        loaded = loads > 0.0
        slide = np.hypot(races[..., CONTACT.slide_x], races[..., CONTACT.slide_y]) * loaded
        pull = np.hypot(races[..., CONTACT.friction_x], races[..., CONTACT.friction_y]) * loaded
        speed = races[..., CONTACT.entrainment_speed] * loaded
        self.slide_largest = np.maximum(self.slide_largest, slide.max(axis=0))
        self.fastest = np.maximum(self.fastest, speed.max(axis=(0, 2)))
        beyond = np.zeros_like(loaded)
        if self.limits is not None:
            first, last = self.limits[..., None]
            at = np.stack([loads, speed, np.cos(races[..., CONTACT.contact_angle])], axis=1)
            beyond = loaded & ((at < first) | (at > last)).any(axis=1)
        values = np.stack([loads, loaded, slide, pull, beyond], axis=1)
        starts = np.arange(0, len(values), self.block)
        ends = np.minimum(starts + self.block, len(values)) - 1
        self.sums.append(np.add.reduceat(values, starts, axis=0))
        self.block_time.append(record.time[ends])

    def late_sums(self) -> Array:
        """Sums over blocks of samples of the last third of the time.

        Returns
        -------
        Array
            sums of load [N], samples under a load, sliding [m/s], friction [N] and samples beyond
            a table, shape (m, SUMS, 2, Z)
        """
        time = np.concatenate(self.block_time)
        late = time >= (1.0 - AVERAGED_SHARE) * time[-1]
        sums: Array = np.concatenate(self.sums)[late]
        return sums

    def settled(self) -> bool:
        """Check that cage and balls have come to rest at their mean speeds: over the last third
        of the time, and between it and the third before.

        Returns
        -------
        bool
            true if the end is steady
        """
        time = np.concatenate(self.time)
        for speed in (np.concatenate(self.orbit_speed), self.cage_speeds()):
            last = speed[time >= (1.0 - AVERAGED_SHARE) * time[-1]]
            before = speed[time >= (1.0 - 2.0 * AVERAGED_SHARE) * time[-1]][: -last.size]
            ends = [stationarity(part) for part in (last, before)]
            if not all(end is not None and end.steady for end in ends):
                return False
            widths = [batch_interval(part) or 0.0 for part in (last, before)]
            allowed = max(sum(widths), DRIFT * abs(float(last.mean())))
            if abs(float(last.mean() - before.mean())) > allowed:
                return False
        return True

    def cage_speeds(self) -> Array:
        """Speeds of the cage from row to row, of the balls where there is no cage.

        Returns
        -------
        Array
            speeds, shape (rows,) [rad/s]
        """
        rotation, time = np.concatenate(self.cage_rotation), np.concatenate(self.time)
        if time.size < FEWEST_PLACES or not np.any(rotation):
            return np.concatenate(self.orbit_speed)
        speeds: Array = np.diff(rotation) / np.diff(time)
        return np.append(speeds[0], speeds)


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
    steady: bool | None  # nothing drifts over the last third; None of too few samples
    # change of the cage's speed that its relaxation has left, and its time, as far as they show
    left: float | None  # [rad/s]
    relaxation: float | None  # [s]
    friction_torque: float  # on the inner ring, likewise a mean over the last third [N m]
    # samples of contacts beyond their table's loads or speeds, of those under a load; None without
    table_exceeded: float | None  # [-]
    fastest: tuple[float, float]  # entrainment at inner and outer race [m/s]
    # mean over the balls: turning about the tangent of the orbit, and its moment over the most
    # that friction holds
    gyroscopic_speed: float  # [rad/s]
    gyroscopic_load: float | None  # [-]; None without friction
    work: dict[str, float]  # put in, lost and taken up by films, by mechanism [J]
    stored: float  # change of kinetic, elastic and potential energy [J]
    # largest residual over the total input or, where that is less, over what was lost, or over
    # `STILL` of the energy at the start
    energy_error: float  # [-]
    shares: Array  # of the time separated, in contact, in an impact, shape (2, Z, 3) [-]
    mean_load: Array  # over the last third, as all means [N], shape (2, Z)
    # half width of the 95 % interval of the load of a race over it, the larger; None: few samples
    load_interval: float | None  # [-]
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


def running_statistics(run: Simulation, stride: int = 1) -> RunningStatistics:
    """Empty sums for the records of a simulation.

    Parameters
    ----------
    run : Simulation
        simulation at its start
    stride : int, default 1
        samples of which one is added [-]

    Returns
    -------
    RunningStatistics
        sums
    """
    laws = run.model.friction.inner, run.model.friction.outer
    limits = [
        table_limits(law, run.bearing, race)
        for race, law in zip(Race, laws, strict=True)
        if isinstance(law, TractionTable)
    ]
    rows = round(run.model.options.end_time / (stride * run.model.options.sample_interval))
    return RunningStatistics(
        run.bearing.balls,
        block=max(1, rows // BLOCKS),
        limits=np.stack(limits, axis=-1) if limits else None,
        settles=run.model.settling is not None,
    )


def table_limits(table: TractionTable, bearing: Bearing, race: Race) -> Array:
    """Ends within which a traction table counts, by the rolling radius in a contact angle.

    Parameters
    ----------
    table : TractionTable
        table of one race
    bearing : Bearing
        the bearing
    race : Race
        the race

    Returns
    -------
    Array
        rows first and last, columns load [N], speed [m/s], cosine of the angle [-], shape (2, 3)
    """
    radii = table.contact.radius_x * (1.0 + SAME_RADIUS * np.array([-1.0, 1.0]))
    outward = -1.0 if race is Race.INNER else 1.0
    ratio = bearing.ball_diameter / bearing.pitch_diameter
    cosines = outward * (2.0 * radii / bearing.ball_diameter - 1.0) / ratio
    ends = np.array([table.range.load, table.range.speed, sorted(cosines)])
    limits: Array = ends.T * (1.0 + ROUNDING * np.array([[-1.0], [1.0]]))
    return limits


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
    blocks = running.late_sums()
    sums = blocks.sum(axis=0)
    samples = float((time >= (1.0 - AVERAGED_SHARE) * time[-1]).sum())
    tables = running.limits is not None
    has_cage = simulation.data.constants.cage_mass > 0.0 and span > 0.0
    assert running.work_before is not None  # there are rows
    work = state.y[simulation.layout.energy] - running.work_before
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
        **_stationarity(simulation, running, late),
        friction_torque=abs(float(np.concatenate(running.torque)[late].mean())),
        table_exceeded=float(sums[4].sum() / max(sums[1].sum(), 1.0)) if tables else None,
        fastest=(float(running.fastest[0]), float(running.fastest[1])),
        **_gyroscopic(
            simulation, np.concatenate(running.gyroscopic)[late].mean(axis=0), sums, samples
        ),
        work=dict(zip(MECHANISMS, work.tolist(), strict=True)),
        stored=put_in - dissipated - float(work[-1]),
        energy_error=_energy_error(running.residual, put_in, dissipated, running.start_energy),
        shares=state.shares / np.maximum(state.shares.sum(axis=2, keepdims=True), 1e-300),
        mean_load=sums[0] / samples,
        load_interval=load_interval(blocks[:, 0].mean(axis=2)),
        largest_load=running.load_largest,
        mean_sliding=sums[2] / np.maximum(sums[1], 1.0),
        largest_sliding=running.slide_largest,
        mean_friction=sums[3] / np.maximum(sums[1], 1.0),
        largest_pocket_load=running.pocket_largest,
    )


def _stationarity(
    simulation: Simulation, running: RunningStatistics, late: NDArray[np.bool_]
) -> dict[str, Any]:
    """Stationarity of the speeds of cage and balls, and what the cage's relaxation has left; not
    steady while speeds or loads of a schedule still change.
    """
    time = np.concatenate(running.time)[late]
    cage = stationarity(running.cage_speeds()[late])
    balls = stationarity(np.concatenate(running.orbit_speed)[late])
    if cage is None or balls is None:
        return {"steady": None, "left": None, "relaxation": None}
    at = simulation.data.times
    held = at.size == 1 or at[-1] <= time[0] or not np.ptp(simulation.data.schedule, axis=0).any()
    step = None if cage.relaxation is None else cage.relaxation * float(time[-1] - time[0])
    return {"steady": held and cage.steady and balls.steady, "left": cage.left, "relaxation": step}


def _gyroscopic(
    simulation: Simulation, motion: Array, sums: Array, samples: float
) -> dict[str, Any]:
    """Turning of the balls about the tangents of their orbits, and its couple over what friction
    holds at most.
    """
    c = simulation.data.constants
    held = 0.0
    friction = simulation.model.friction
    pitch_radius = 0.5 * (c.inner_centre + c.outer_centre)
    speed = abs(float(entrainment_speeds(simulation.data.schedule[-1:], pitch_radius)[0]))
    for law, loads, touching in zip((friction.inner, friction.outer), *sums[:2], strict=True):
        load = float(loads.sum() / max(touching.sum(), 1.0))
        if law is None or not load * speed > 0.0:
            continue
        across = (law.forces(load, speed, 0.0, s * speed, 0.0).force_y for s in SLIDES)
        share = float(touching.sum()) / samples / touching.size
        held += share * c.ball_radius * max(abs(force) for force in across)
    couple = c.ball_inertia * abs(float(motion[1]))
    return {
        "gyroscopic_speed": float(motion[0]),
        "gyroscopic_load": couple / held if held > 0.0 else None,
    }


def gyroscopic_motion(states: Array, layout: Layout, orbits: Array) -> Array:
    """Means over the balls of the turning about the tangents of their orbits, and of the orbit's
    speed times the turning about the radius, which the gyroscopic couple is in proportion to.

    Parameters
    ----------
    states : Array
        state vectors, shape (m, size) [SI]
    layout : Layout
        slices of the state vector
    orbits : Array
        orbit speeds, shape (m, Z) [rad/s]

    Returns
    -------
    Array
        means, shape (m, 2) [rad/s], [rad^2/s^2]
    """
    place = states[:, layout.ball].reshape(*orbits.shape, 3)
    turn = states[:, layout.ball_turn].reshape(*orbits.shape, 3)
    radius = np.hypot(place[..., 1], place[..., 2])
    about_tangent = (turn[..., 2] * place[..., 1] - turn[..., 1] * place[..., 2]) / radius
    about_radius = (turn[..., 1] * place[..., 1] + turn[..., 2] * place[..., 2]) / radius
    return np.stack([about_tangent.mean(axis=1), (orbits * about_radius).mean(axis=1)], axis=1)


def _energy_error(residual: float, put_in: float, dissipated: float, start: float) -> float:
    """A residual over the work or a share of the energy at the start, all in [J]."""
    return residual / max(abs(put_in), abs(dissipated), STILL * abs(start), 1e-300)


def _cage_orbit(simulation: Simulation, position: Array) -> dict[str, Any]:
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


def load_interval(loads: Array) -> float | None:
    """Uncertainty of the mean loads of the races, by the wider of their 95 % intervals.

    Parameters
    ----------
    loads : Array
        evenly sampled loads of the inner and the outer race, shape (m, 2) [any unit]

    Returns
    -------
    float | None
        half width over the mean [-]; None below `SMALLEST_SAMPLE` samples
    """
    pairs = [(batch_interval(load), max(float(load.mean()), 1e-300)) for load in loads.T]
    return max((width / mean for width, mean in pairs if width is not None), default=None)


class Stationarity(NamedTuple):
    """Test of evenly sampled values for a trend, and what an exponential has left of it."""

    steady: bool
    left: float | None  # to come, in the unit of the values
    relaxation: float | None  # time constant over the span of the values [-]


def stationarity(values: Array) -> Stationarity | None:
    """Trend of the means of batches against their spread about it, by a straight line: steady
    where it is within the spread, or changes the mean by less than `DRIFT` over the values.

    What is left of a relaxation follows from three means one after the other, whose differences
    an exponential shrinks by one ratio.

    Parameters
    ----------
    values : Array
        samples, shape (m,) [any unit]

    Returns
    -------
    Stationarity | None
        result of the test; None below `SMALLEST_SAMPLE` values
    """
    if values.size < SMALLEST_SAMPLE:
        return None
    size = values.size // BATCHES
    means = values[values.size - size * BATCHES :].reshape(BATCHES, size).mean(axis=1)
    at = np.linspace(-0.5, 0.5, BATCHES)
    slope = float(at @ means / (at @ at))
    spread = float(((means - means.mean() - slope * at) ** 2).sum() / (BATCHES - 2) / (at @ at))
    small = DRIFT * float(np.abs(values).mean())
    steady = abs(slope) <= max(STUDENT_TREND * spread**0.5, small)
    early, middle, end = means[1:].reshape(3, -1).mean(axis=1)
    ratio = (end - middle) / (middle - early) if middle != early else 0.0
    if steady or not FASTEST_DECAY < ratio < 1.0:
        return Stationarity(steady, None, None)
    left = (end - middle) * ratio**1.5 / (1.0 - ratio)  # from the end of the last mean
    return Stationarity(steady, float(left), float(-(3.0 / BATCHES) / np.log(ratio)))


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
    running = running_statistics(run)
    for record in run.pieces():
        running.add(record, run.start_energy)
        if run.model.options.until_steady and running.settled():
            break
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
