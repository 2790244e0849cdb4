"""Vibration of a bearing over time, from its equilibrium: motion of rings and sensor, loads."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from math import ceil, pi, sqrt

import numpy as np

from oilfilm.ehl.arrays import Array

from ..quasistatic.solution import QuasistaticSolution
from ._kernels import advance
from .assembly import BALLS, INNER, OUTER, SENSOR, STORED, Assembled
from .inputs import VibrationModel

OVERSAMPLED = 4  # rows kept for each sample of the record, against aliasing
# angular frequency of the fastest vibration times step: the phase of Runge and Kutta's method is
# off by (0.35)^5/120 = 4e-5 a step, its stability ends at 2.8
STEP = 0.35
STIFFER = 1.3  # of contacts, by loads beyond those at rest
MOST_STEPS = 4.0e7  # an hour of ten balls
PIECE = 0.005  # of a step of progress, of the whole [-]
GROWTH = 0.5  # part of the settling time over which the form grows
DAMPED = 0.6  # and over which all bodies are damped as their slowest vibration would die away


@dataclass(slots=True, kw_only=True)
class VibrationRun:
    """Equations, step, state and record of a vibration that is being computed."""

    solution: QuasistaticSolution
    model: VibrationModel
    assembled: Assembled
    step: float  # [s]
    per_sample: int  # steps a sample of the record
    state: tuple[Array, Array, Array]  # positions, velocities, works
    motion: Array = field(default_factory=lambda: np.zeros((0, 3 * BALLS)))
    loads: Array = field(default_factory=lambda: np.zeros((0, 0)))
    energy: Array = field(default_factory=lambda: np.zeros((0, STORED + 1)))

    @property
    def samples(self) -> int:
        """Samples of the record [-]."""
        return round(self.model.options.duration * self.model.options.sample_rate)

    @property
    def settling_steps(self) -> int:
        """Steps before the record [-]."""
        return round(self.model.options.settling / self.step)

    @property
    def steps(self) -> int:
        """Steps in all [-]."""
        return self.settling_steps + self.samples * self.per_sample

    @property
    def energy_balance_error(self) -> float:
        """Largest imbalance of energy and works, over the mean energy and all works [-]."""
        external, formed, dissipated = self.energy[:, 1:].T
        energy = self.energy[:, 0]
        balance = energy - energy[0] - external - formed + dissipated
        size = energy.mean() + sum(float(np.ptp(work)) for work in (external, formed, dissipated))
        return float(abs(balance).max() / size) if size > 0.0 else 0.0


def vibration_run(
    solution: QuasistaticSolution, model: VibrationModel, equations: Assembled
) -> VibrationRun:
    """A run that starts at the equilibrium.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    model : VibrationModel
        form of the surfaces, supports and options
    equations : Assembled
        numbers of the equations

    Returns
    -------
    VibrationRun
        run at its start

    Raises
    ------
    ValueError
        if it would take too many steps
    """
    rate = model.options.sample_rate
    fastest = fastest_vibration(equations)
    per_sample = OVERSAMPLED * ceil(max(fastest / STEP, 1.0) / (rate * OVERSAMPLED))
    step = 1.0 / (rate * per_sample)
    bodies = BALLS + 2 * equations.arrays.balls
    q, v = np.zeros(bodies), np.zeros(bodies)
    q[INNER : INNER + 3] = solution.displacement
    q[INNER + 3 : OUTER] = solution.tilt
    q[BALLS::2] = solution.ball_axial
    q[BALLS + 1 :: 2] = solution.ball_radial
    state = (q, v, np.zeros(STORED + 1))
    run = VibrationRun(
        solution=solution,
        model=model,
        assembled=equations,
        step=step,
        per_sample=per_sample,
        state=state,
    )
    if run.steps > MOST_STEPS:
        raise ValueError(
            f"duration: takes {run.steps:.2g} steps of {step:.2g} s, more than {MOST_STEPS:.2g}"
        )
    return run


def fastest_vibration(equations: Assembled) -> float:
    """Largest angular frequency of the linear vibrations, estimated from above.

    Parameters
    ----------
    equations : Assembled
        numbers of the equations

    Returns
    -------
    float
        angular frequency [rad/s]
    """
    arrays = equations.arrays
    stiffness = STIFFER * sum(equations.stiffness.values())
    squares = [stiffness / arrays.ball_mass]
    ring = STIFFER * arrays.balls * max(equations.stiffness.values())
    squares += [
        (ring + arrays.seat_stiffness.max() + arrays.sensor[0]) / arrays.mass[k]
        for k in (INNER + 1, OUTER + 1)
        if arrays.free[k]
    ]
    lever = arrays.inner_centre_radius**2
    squares += [ring * lever / arrays.mass[k] for k in (3, 4) if arrays.free[k]]
    if arrays.free[SENSOR]:
        squares.append(arrays.sensor[0] / arrays.mass[SENSOR])
    return sqrt(sum(squares))


def slowest_vibration(run: VibrationRun) -> float:
    """Angular frequency of the rings on the balls in the stiffest direction.

    The damping in the settling time is measured by it.

    Parameters
    ----------
    run : VibrationRun
        run with its equations

    Returns
    -------
    float
        angular frequency [rad/s]
    """
    arrays = run.assembled.arrays
    largest = max(float(run.solution.stiffness[k, k]) for k in range(3))
    moving = [arrays.mass[k] for k in (INNER, OUTER) if arrays.free[k : k + 3].any()]
    return sqrt(max(largest, 0.0) / max(moving)) if moving else 2.0 * pi * 1e3


def pieces(run: VibrationRun) -> Iterator[int]:
    """Compute a run piece by piece.

    Parameters
    ----------
    run : VibrationRun
        run, changed

    Yields
    ------
    Iterator[int]
        steps done so far [-]
    """
    settle = run.settling_steps
    damping = 0.5 * slowest_vibration(run)
    done = 0
    for first, last, rate in _stages(run, settle, damping):
        share = (min(done / max(GROWTH * settle, 1.0), 1.0), _gain(run, settle), rate)
        nothing = (np.zeros((0, 27)), np.zeros((0, 0)), np.zeros((0, STORED + 1)))
        clock = ((first - settle) * run.step, run.step, last - first, 0)
        advance(run.assembled.arrays, clock, share, run.state, nothing)
        done = last
        yield done
    yield from _recorded(run, settle)


def _gain(run: VibrationRun, settle: int) -> float:
    return 1.0 / (GROWTH * settle * run.step) if settle else 0.0


def _stages(run: VibrationRun, settle: int, damping: float) -> Iterator[tuple[int, int, float]]:
    """Pieces of the settling time: first and last step, damping of all bodies [1/s]."""
    size = max(int(PIECE * run.steps), 1)
    damped = int(DAMPED * settle)
    for first, last, rate in ((0, damped, damping), (damped, settle, 0.0)):
        for begin in range(first, last, size):
            yield begin, min(begin + size, last), rate


def _recorded(run: VibrationRun, settle: int) -> Iterator[int]:
    """The record, in pieces of whole samples."""
    stride = run.per_sample // OVERSAMPLED
    rows = OVERSAMPLED * run.samples
    balls = run.assembled.arrays.balls
    run.motion = np.zeros((rows, 3 * BALLS))
    run.loads = np.zeros((rows, 2 * balls))
    run.energy = np.zeros((rows, STORED + 1))
    run.state[2][:] = 0.0
    size = max(int(PIECE * rows), 1)
    for row in range(0, rows, size):
        last = min(row + size, rows)
        part = slice(row, last)
        record = (run.motion[part], run.loads[part], run.energy[part])
        clock = (row * stride * run.step, run.step, (last - row) * stride, stride)
        advance(run.assembled.arrays, clock, (1.0, 0.0, 0.0), run.state, record)
        yield settle + last * stride


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
