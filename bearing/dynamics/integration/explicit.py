"""The explicit method's way from Python: arrays laid out, kernel called, state brought up to date."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..problem import Array
from ..record import LEAST_STEP, STEP_ANGLE, STIFF_STEP, Record, empty_record
from . import _kernels

if TYPE_CHECKING:
    from ..simulation import Simulation


def control_of(simulation: Simulation) -> Array:
    """Least and longest step, and the step below which a stiff problem is given back [s]."""
    options = simulation.model.options
    frequency = simulation.frequency
    longest = options.longest_step or STEP_ANGLE / frequency
    least = LEAST_STEP * options.end_time
    return np.array(
        [least, min(longest, options.sample_interval), STIFF_STEP * 2.0 * np.pi / frequency]
    )


def advance_explicit(simulation: Simulation, times: Array) -> tuple[int, Record]:
    """Move a simulation on to the given times [s]; the kernel's status, and the rows reached."""
    state = simulation.state
    size = simulation.layout.size
    record = empty_record(times, simulation.bearing.balls)
    history = (state.onset, state.contact_state, state.shares, state.attitude)
    status, rows, state.time, state.step = _kernels.advance_samples(
        state.time,
        state.y,
        times,
        state.step,
        simulation.problem,
        control_of(simulation),
        simulation.scale,
        np.zeros((9, size)),
        np.zeros(size),
        history,
        state.counters,
        tuple(record[1:]),
    )
    parts: list[Any] = [part[:rows] for part in record]
    return int(status), Record(*parts)
