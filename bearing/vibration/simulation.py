"""Vibration of a bearing: the equations of motion of `dynamics` with form, seat and films, from an
equilibrium, and the motion of rings and sensor, the loads and the energies that they give.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from math import pi, sqrt

import numpy as np

from oilfilm.ehl.arrays import Array

from ..dynamics import inputs as motion
from ..dynamics.arrays import CONTACT, DAMPING, MOMENT, RING, SEAT
from ..dynamics.assembly import assemble, damping_factor
from ..dynamics.bodies import load_type, ring_body
from ..dynamics.choices import Start
from ..dynamics.friction import RaceFriction
from ..dynamics.initial import StartingPoint, initial_state
from ..dynamics.record import Record
from ..dynamics.simulation import Simulation, from_state, simulation
from ..dynamics.statistics import INPUTS, orbit_speeds, spin_speeds
from ..geometry import Bearing, Race
from ..quasistatic.solution import QuasistaticSolution
from .assembly import Assembled, mean_angle
from .inputs import Direction, VibrationModel

OVERSAMPLED = 4  # rows kept for each sample of the record, against aliasing
GROWTH = 0.5  # part of the settling time over which the form grows
DAMPED = 0.6  # and over which all bodies are damped as their slowest vibration would die away
MOST_SAMPLES = 2.0e7  # rows of a record, a day of ten balls
STILL = 1e6  # no contact counts as an impact: its law damps it [m/s]
GUIDED_TOLERANCE = 1.0e-5  # of a step, where form and springs are all that is solved [-]

# places in the motion of a run, which has displacements, speeds and accelerations of them
INNER = 0  # x, y, z, tilt y, tilt z of the inner ring
OUTER = 5  # x, y, z of the outer ring
SENSOR = 8  # of the oscillator on it
BODIES = 9
PLACES = np.array([*range(RING), *range(SEAT, SEAT + BODIES - RING)])  # in the state of `dynamics`
AXES = {Direction.X: 0, Direction.Y: 1, Direction.Z: 2}


@dataclass(slots=True, kw_only=True)
class VibrationRun:
    """A simulation with form and supports, and the record of what vibrates."""

    solution: QuasistaticSolution
    model: VibrationModel
    assembled: Assembled
    simulation: Simulation
    motion: Array = field(default_factory=lambda: np.zeros((0, 3 * BODIES)))
    loads: Array = field(default_factory=lambda: np.zeros((0, 0)))
    energy: Array = field(default_factory=lambda: np.zeros((0, 3)))  # stored, put in, lost [J]
    # speeds of cage and of a ball against it [rad/s], friction torque on the inner ring [N m]
    turning: Array = field(default_factory=lambda: np.zeros((0, 3)))
    done: int = 0  # rows of the record that are filled [-]

    @property
    def samples(self) -> int:
        """Samples of the record [-]."""
        return round(self.model.options.duration * self.model.options.sample_rate)

    @property
    def energy_balance_error(self) -> float:
        """Largest imbalance of energy and works, over the mean energy and all works [-]."""
        stored, external, lost = self.energy.T
        balance = stored - stored[0] - (external - external[0]) + lost - lost[0]
        size = stored.mean() + np.ptp(external) + np.ptp(lost)
        return float(abs(balance).max() / size) if size > 0.0 else 0.0


def slowest_vibration(solution: QuasistaticSolution, masses: list[float]) -> float:
    """Angular frequency of the rings on the balls in the stiffest direction, which the damping in
    the settling time is measured by.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    masses : list[float]
        of the rings that move [kg]

    Returns
    -------
    float
        angular frequency [rad/s]
    """
    largest = max(float(solution.stiffness[k, k]) for k in range(3))
    return sqrt(max(largest, 0.0) / max(masses)) if masses else 2.0 * pi * 1e3


def guided_model(
    solution: QuasistaticSolution, model: VibrationModel, equations: Assembled
) -> motion.DynamicsModel:
    """A cage that turns as in the equilibrium, less its slip, with the balls in their places and
    without friction; speeds rise over the record in a run-up.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    model : VibrationModel
        form of the surfaces, supports and options
    equations : Assembled
        heights and laws of the contacts

    Returns
    -------
    DynamicsModel
        model of the simulation
    """
    options = model.options
    inner, outer, cage, ball = equations.speeds
    schedule = None
    if options.start_speed_ratio != 1.0:
        first, *others = motion.prescribed_values(solution.operation)
        values = [(share * first, *others) for share in (options.start_speed_ratio, 1.0)]
        places = motion.prescribed_displacements(solution.operation)
        schedule = motion.Schedule(
            time=(0.0, options.duration),
            values=tuple(values),
            places=(places, places),
            rates=((0.0,) * RING,) * 2,
        )
    return motion.DynamicsModel(
        options=motion.DynamicsOptions(
            end_time=options.duration, sample_interval=options.duration, tolerance=GUIDED_TOLERANCE
        ),
        ring=ring_body(solution.bearing),
        friction=RaceFriction(),
        normal=motion.NormalContact(restitution=1.0, impact_floor=STILL),
        schedule=schedule,
        guide=motion.Guide(speed=(cage - outer) / (inner - outer), roll=ball / (inner - outer)),
    )


def with_form(
    base: motion.DynamicsModel,
    solution: QuasistaticSolution,
    model: VibrationModel,
    equations: Assembled,
) -> motion.DynamicsModel:
    """The model of a simulation with form, supports and laws of the contacts; the form grows over
    the settling time before the start, if that is an equilibrium.

    Parameters
    ----------
    base : DynamicsModel
        ring, cage, friction and schedule
    solution : QuasistaticSolution
        equilibrium of the bearing
    model : VibrationModel
        form of the surfaces, supports and options
    equations : Assembled
        heights and laws of the contacts

    Returns
    -------
    DynamicsModel
        model of the simulation
    """
    laws = equations.laws.copy()
    if base.guide is None:  # impacts lose what the restitution says
        laws[:, DAMPING] = damping_factor(base.normal.law, base.normal.restitution)
    result = replace(base, support=model.support, surfaces=equations.surfaces, race_laws=laws)
    time = model.options.settling
    if time == 0.0 or base.options.start is not Start.QUASI_STATIC:
        return result
    masses = [] if model.support.inner_ring_fixed else [base.ring.mass + model.support.shaft_mass]
    settling = motion.Settling(
        time=time,
        growth=GROWTH * time,
        damped=DAMPED * time,
        rate=0.5 * slowest_vibration(solution, masses),
    )
    return replace(result, settling=settling)


def before_settling(bearing: Bearing, model: motion.DynamicsModel, speed: float) -> Bearing:
    """The bearing with its balls where they are before the settling time, so that they are in the
    places of the case at time zero.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    model : DynamicsModel
        model of the simulation
    speed : float
        speed of the cage over that time [rad/s]

    Returns
    -------
    Bearing
        bearing at its start
    """
    if model.settling is None:
        return bearing
    azimuth = bearing.first_ball_azimuth - model.settling.time * speed
    return replace(bearing, first_ball_azimuth=azimuth)


def _sampled(model: motion.DynamicsModel, vibration: VibrationModel) -> motion.DynamicsModel:
    """The model with samples as the record of a vibration needs them."""
    rate = vibration.options.sample_rate
    samples = round(vibration.options.duration * rate)
    options = replace(
        model.options, end_time=samples / rate, sample_interval=1.0 / (OVERSAMPLED * rate)
    )
    return replace(model, options=options)


def vibration_run(
    solution: QuasistaticSolution,
    model: VibrationModel,
    equations: Assembled,
    base: motion.DynamicsModel | None = None,
) -> VibrationRun:
    """A run at its start, before the settling time.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    model : VibrationModel
        form of the surfaces, supports and options
    equations : Assembled
        heights and laws of the contacts
    base : DynamicsModel, optional
        friction, cage and schedule; left out, the cage turns the balls

    Returns
    -------
    VibrationRun
        run at its start

    Raises
    ------
    ValueError
        if its record would be too long
    """
    rows = OVERSAMPLED * model.options.duration * model.options.sample_rate
    if rows > MOST_SAMPLES:
        raise ValueError(f"duration: takes {rows:.2g} rows, more than {MOST_SAMPLES:.2g}")
    operation = solution.operation
    whole = with_form(base or guided_model(solution, model, equations), solution, model, equations)
    whole = _sampled(whole, model)
    cage = equations.speeds[2] * model.options.start_speed_ratio
    bearing = before_settling(solution.bearing, whole, cage)
    if base is not None:
        run = simulation(bearing, operation, whole)
    else:
        angles = mean_angle(solution, Race.INNER), mean_angle(solution, Race.OUTER)
        point = StartingPoint(
            kind=load_type(operation, whole), angles=angles, equilibrium=solution, messages=()
        )
        data = assemble(bearing, operation, whole, point)
        state = initial_state(bearing, data, point, whole.options.start)
        run = from_state(bearing, operation, whole, (point, data, state))
    return VibrationRun(solution=solution, model=model, assembled=equations, simulation=run)


def pieces(run: VibrationRun) -> Iterator[float]:
    """Compute a run piece by piece.

    Parameters
    ----------
    run : VibrationRun
        run, changed

    Yields
    ------
    float
        part done so far [-]
    """
    begin_record(run)
    settling = -run.simulation.state.time
    for record in run.simulation.pieces():
        keep_record(run, record)
        yield (settling + float(record.time[-1])) / (settling + run.model.options.duration)
    end_record(run)


def begin_record(run: VibrationRun) -> None:
    """Room for the record of a run.

    Parameters
    ----------
    run : VibrationRun
        run, changed
    """
    rows = OVERSAMPLED * run.samples
    run.motion = np.zeros((rows, 3 * BODIES))
    run.loads = np.zeros((rows, 2 * run.solution.bearing.balls))
    run.energy = np.zeros((rows, 3))
    run.turning = np.zeros((rows, 3))
    run.done = 0


def end_record(run: VibrationRun) -> None:
    """Bring the speeds of a run to those that were simulated; mark a run that did not get there.

    Parameters
    ----------
    run : VibrationRun
        run, changed
    """
    if run.done < len(run.motion):
        run.motion[run.done :] = np.nan
    elif run.simulation.model.guide is None:
        simulated = run.assembled.speeds.copy()
        simulated[2:] = run.turning[:, :2].mean(axis=0)
        run.assembled = replace(run.assembled, speeds=simulated)


def keep_record(run: VibrationRun, record: Record) -> None:
    """Write samples of the simulation into the record of a run.

    Parameters
    ----------
    run : VibrationRun
        run, changed
    record : Record
        next samples
    """
    done = run.done
    last = min(done + record.time.size, len(run.motion))
    part = slice(0, last - done)
    layout = run.simulation.layout
    columns = [record.state[:, PLACES], record.state[:, layout.positions + PLACES]]
    run.motion[done:last] = np.hstack([*columns, record.acceleration[:, PLACES]])[part]
    run.loads[done:last] = record.races[..., CONTACT.load].reshape(len(record.time), -1)[part]
    work = record.state[:, layout.energy]
    put_in, lost = work[:, :INPUTS].sum(axis=1), work[:, INPUTS:].sum(axis=1)
    stored = record.energy.sum(axis=1)
    orbits = orbit_speeds(record.state, layout)
    turns = record.state[:, layout.ball_turn].reshape(len(orbits), -1, 3)
    means = [orbits.mean(axis=1), spin_speeds(turns, orbits).mean(axis=1)]
    run.turning[done:last] = np.stack([*means, -record.loads[:, MOMENT]], axis=1)[part]
    run.energy[done:last] = np.stack([stored, put_in, lost], axis=1)[part]
    run.done = last


def computed(run: VibrationRun) -> VibrationRun:
    """Compute a whole run without a report of its progress.

    Parameters
    ----------
    run : VibrationRun
        run at its start, changed

    Returns
    -------
    VibrationRun
        the same run at its end
    """
    for _ in pieces(run):
        pass
    return run
