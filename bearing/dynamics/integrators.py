"""The two methods: compiled explicit steps, and SciPy's LSODA with the Jacobian of the compiled
equations where friction is too steep for them.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.integrate import LSODA
from threadpoolctl import threadpool_limits

from oilfilm.ehl.arrays import Array

from . import _integration_kernels
from ._integration_kernels import (
    DONE,
    EVALUATIONS,
    SOFT_SEEN,
    STAGE_ROWS,
    STEPS,
    STIFF_SEEN,
    TOO_SMALL,
    jacobian,
)
from ._motion_kernels import solved_derivative
from .arrays import EquationData
from .record import ContactHistory, Record, SimulationState, StepControl, empty_record, first_rows
from .reduction import SolvedMotion

# over the tolerance of the explicit method: LSODA keeps its error less closely than a method of
# order five [-]
LSODA_TOLERANCE = 0.1
ACCUMULATOR_TOLERANCE = 1.0e-6  # relative, of work and dissipation [-]
# LSODA is given up where LOOK steps in a row are by their mean shorter than this part of the step
# at which it took over: 50 000 in a period of a loaded ball [-]
CRAWL = 1.0e-3
LOOK = 10000


def advance_explicit(
    state: SimulationState, motion: SolvedMotion, times: Array, control: StepControl, scale: Array
) -> tuple[int, Record]:
    """Move a state on to the given times by compiled explicit steps.

    Parameters
    ----------
    state : SimulationState
        state of the simulation, changed
    motion : SolvedMotion
        equations in use
    times : Array
        times of the samples, rising [s]
    control : StepControl
        limits of the steps
    scale : Array
        errors that count as one, shape (mechanical,) [SI]

    Returns
    -------
    status
        status of the kernel
    record
        the rows reached
    """
    y, history = motion.begin(state)
    record = empty_record(times, motion.solved)
    stages = np.zeros((STAGE_ROWS, y.size))
    status, rows, state.time, state.step = _integration_kernels.advance_samples(
        state.time, y, state.step, motion.data.kernel, control, motion.scale(scale),
        stages, np.zeros(y.size), history, state.counters, record,
    )  # fmt: skip
    motion.finish(state, y, history)
    return int(status), first_rows(motion.full_record(record), rows)


@dataclass(slots=True)
class _Progress:
    """Progress of the steps over time."""

    before: float  # time LOOK steps ago [s]
    shortest: float  # mean of LOOK steps [s]
    steps: int = 0

    def crawls(self, time: float) -> bool:
        """After a step to a time [s]: whether the last LOOK did not lead on."""
        self.steps += 1
        if self.steps % LOOK:
            return False
        step = (time - self.before) / LOOK
        self.before = time
        return step < self.shortest


def advance_implicit(
    state: SimulationState, motion: SolvedMotion, times: Array, control: StepControl, scale: Array
) -> tuple[int, Record]:
    """Move a state on to the given times by LSODA.

    Its systems of a hundred unknowns are solved by one thread: several took twelve times as long.

    Parameters
    ----------
    state : SimulationState
        state of the simulation, changed
    motion : SolvedMotion
        equations in use
    times : Array
        times of the samples, rising [s]
    control : StepControl
        limits of the steps
    scale : Array
        errors that count as one, shape (mechanical,) [SI]

    Returns
    -------
    status
        DONE or TOO_SMALL
    record
        the rows reached
    """
    y, history = motion.begin(state)
    record = empty_record(times, motion.solved)
    state.counters[[STIFF_SEEN, SOFT_SEEN]] = 0  # the test begins anew when explicit steps do
    reached = 0
    progress = _Progress(state.time, CRAWL * control.stiff)
    with threadpool_limits(1, user_api="blas"):
        for row, time in enumerate(times):
            limits = (float(time), control, motion.scale(scale))
            if not _advance_to(state, motion, (y, history), limits, progress):
                break
            _integration_kernels.sample(y, motion.data.kernel, history, record, row)
            reached = row + 1
    motion.finish(state, y, history)
    record = first_rows(motion.full_record(record), reached)
    return (DONE if reached == times.size else TOO_SMALL), record


def _advance_to(
    state: SimulationState,
    motion: SolvedMotion,
    unknowns: tuple[Array, ContactHistory],
    limits: tuple[float, StepControl, Array],
    progress: "_Progress",
) -> bool:
    """Steps of LSODA up to the time of `limits` [s], impacts remembered after each; whether it was
    reached. `unknowns`: what is solved and what its contacts remember, brought up to date.
    """
    y, history = unknowns
    data = motion.data
    rates = np.zeros_like(y)
    data.linear[:] = 0.0  # each evaluation asks the laws of friction and films
    data.pocket_films[:] = 0.0
    solved_derivative(state.time, y, data.kernel, rates)
    _integration_kernels.begin_steps(data.kernel)
    if limits[0] <= state.time:  # the explicit steps were given up right at a sample
        return True
    solver = _solver(state, data, y, limits)
    while solver.status == "running":
        try:
            message = solver.step()
        except ValueError:  # raised by LSODA for a state that is not finite
            return False
        if message or not np.all(np.isfinite(solver.y)):
            return False
        step = solver.t - solver.t_old
        y[: solver.n] = solver.y
        solved_derivative(solver.t, y, data.kernel, rates)
        _integration_kernels.end_step(solver.t, y, step, data.kernel, history)
        state.counters[STEPS] += 1
        state.time = solver.t
        state.step = step
        if progress.crawls(solver.t):
            return False
    state.counters[EVALUATIONS] += solver.nfev
    return True


def _solver(
    state: SimulationState, data: EquationData, y: Array, limits: tuple[float, StepControl, Array]
) -> Any:
    """LSODA over all but the last accumulator, the work of the films, which follows each step."""
    end, control, scale = limits
    size = y.size - 1
    mechanical = data.mechanical
    full, derivative = np.zeros(size + 1), np.zeros(size + 1)

    def rates(t: float, y: Array) -> Array:
        full[:size] = y
        solved_derivative(t, full, data.kernel, derivative)
        return derivative[:size].copy()

    def slopes(t: float, y: Array) -> Array:
        full[:size] = y
        out = np.zeros((size, size))
        jacobian(t, full, data.kernel, scale, out[:mechanical, :mechanical])
        return out

    energy = np.maximum(np.abs(y[mechanical:size]), 1.0) * ACCUMULATOR_TOLERANCE
    return LSODA(
        rates,
        state.time,
        y[:size].copy(),
        end,
        first_step=min(state.step, end - state.time),
        max_step=control.longest,
        rtol=1e-12,
        atol=np.concatenate([LSODA_TOLERANCE * scale, energy]),
        jac=slopes,
    )
