"""The two methods: compiled explicit steps, and SciPy's LSODA with the Jacobian of the compiled
equations where friction is too steep for them.
"""

from typing import Any

import numpy as np
from scipy.integrate import LSODA

from ..arrays import Array, EquationData
from ..layout import Layout
from ..record import Record, SimulationState, StepControl, empty_record, first_rows
from . import _kernels
from ._kernels import DONE, EVALUATIONS, SOFT_SEEN, STAGE_ROWS, STEPS, STIFF_SEEN, TOO_SMALL

# over the tolerance of the explicit method: LSODA keeps its error less closely than a method of
# order five [-]
LSODA_TOLERANCE = 0.1
ACCUMULATOR_TOLERANCE = 1.0e-6  # relative, of work and dissipation [-]


def advance_explicit(
    state: SimulationState, data: EquationData, times: Array, control: StepControl, scale: Array
) -> tuple[int, Record]:
    """Move a state on to the given times [s]; the kernel's status, and the rows reached.

    `scale`, shape (mechanical,): errors that count as one [SI].
    """
    record = empty_record(times, data.constants.balls)
    stages = np.zeros((STAGE_ROWS, state.y.size))
    status, rows, state.time, state.step = _kernels.advance_samples(
        state.time, state.y, state.step, data, control, scale,
        stages, np.zeros(state.y.size), state.history, state.counters, record,
    )  # fmt: skip
    return int(status), first_rows(record, rows)


def advance_implicit(
    state: SimulationState, data: EquationData, times: Array, control: StepControl, scale: Array
) -> tuple[int, Record]:
    """`advance_explicit` by LSODA; status DONE or TOO_SMALL, and the rows reached [SI]."""
    record = empty_record(times, data.constants.balls)
    state.counters[[STIFF_SEEN, SOFT_SEEN]] = 0  # the test begins anew when explicit steps do
    for row, time in enumerate(times):
        if not _advance_to(state, data, float(time), control, scale):
            return TOO_SMALL, first_rows(record, row)
        _kernels.sample(state.y, data, state.history, record, row)
    return DONE, record


def _advance_to(
    state: SimulationState, data: EquationData, end: float, control: StepControl, scale: Array
) -> bool:
    """Steps of LSODA up to `end` [s], impacts remembered after each; whether it was reached."""
    rates = np.zeros_like(state.y)
    before = state.y.copy()
    _kernels.derivative(state.time, state.y, data, rates)
    if end <= state.time:  # the explicit steps were given up right at a sample
        return True
    _kernels.mark_films(data)
    solver = _solver(state, data, end, control, scale)
    while solver.status == "running":
        try:
            message = solver.step()
        except ValueError:  # raised by LSODA for a state that is not finite
            return False
        if message or not np.all(np.isfinite(solver.y)):
            return False
        step = solver.t - solver.t_old
        state.y[: solver.n] = solver.y
        _kernels.derivative(solver.t, state.y, data, rates)
        _kernels.turn_balls(before, state.y, step, data.constants.balls, state.attitude)
        _kernels.after_step(data, solver.t, step, state.onset, state.contact_state, state.shares)
        _kernels.add_film_work(data, state.y)
        before[:] = state.y
        state.counters[STEPS] += 1
        state.time = solver.t
        state.step = step
    state.counters[EVALUATIONS] += solver.nfev
    return True


def _solver(
    state: SimulationState, data: EquationData, end: float, control: StepControl, scale: Array
) -> Any:
    """LSODA over all but the last accumulator, the work of the films, which follows each step."""
    size = state.y.size - 1
    mechanical = Layout(data.constants.balls).mechanical
    full, derivative = np.zeros(size + 1), np.zeros(size + 1)

    def rates(t: float, y: Array) -> Array:
        full[:size] = y
        _kernels.derivative(t, full, data, derivative)
        return derivative[:size].copy()

    def slopes(t: float, y: Array) -> Array:
        out = np.zeros((size, size))
        block = np.zeros((mechanical, mechanical))
        full[:size] = y
        _kernels.jacobian(t, full, data, scale, block)
        out[:mechanical, :mechanical] = block
        return out

    energy = np.maximum(np.abs(state.y[mechanical:size]), 1.0) * ACCUMULATOR_TOLERANCE
    return LSODA(
        rates,
        state.time,
        state.y[:size].copy(),
        end,
        first_step=min(state.step, end - state.time),
        max_step=control.longest,
        rtol=1e-12,
        atol=np.concatenate([LSODA_TOLERANCE * scale, energy]),
        jac=slopes,
    )
