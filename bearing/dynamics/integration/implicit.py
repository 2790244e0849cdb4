"""The implicit way: SciPy's LSODA with the Jacobian of the compiled equations, where friction is
too steep.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.integrate import LSODA

from ..problem import Array
from ..record import Record, empty_record
from . import _kernels
from .explicit import control_of

if TYPE_CHECKING:
    from ..simulation import Simulation

DONE = 0
TOO_SMALL = 1
TIGHTER = 0.1  # LSODA holds its error less closely than a method of order five its own [-]
ACCUMULATED = 1.0e-6  # tolerance of the accumulators, of themselves [-]


def advance_implicit(simulation: Simulation, times: Array) -> tuple[int, Record]:
    """Move a simulation on to the given times [s]; 0 or 1 (the step became too small), and the
    rows reached.
    """
    record = empty_record(times, simulation.bearing.balls)
    # explicit steps begin anew after it
    simulation.state.counters[[_kernels.STIFF_SEEN, _kernels.SOFT_SEEN]] = 0
    history = _history(simulation)
    status = DONE
    rows = 0
    for rows, time in enumerate(times):
        status = _to(simulation, float(time))
        if status != DONE:
            break
        _kernels.sample(simulation.state.y, simulation.problem, history, tuple(record[1:]), rows)
    else:
        rows = times.size
    parts: list[Any] = [part[:rows] for part in record]
    return status, Record(*parts)


def _history(simulation: Simulation) -> tuple[Array, Any, Array, Array]:
    state = simulation.state
    return state.onset, state.contact_state, state.shares, state.attitude


def _to(simulation: Simulation, end: float) -> int:
    """Steps of LSODA up to `end` [s], the memory of the impacts brought up to date after each."""
    state, problem = simulation.state, simulation.problem
    rates = np.zeros_like(state.y)
    before = state.y.copy()
    _kernels.derivative(state.time, state.y, problem, rates)
    if end <= state.time:  # the explicit steps were given up right at a sample
        return DONE
    _kernels.mark_films(problem)
    solver = _solver(simulation, end)
    while solver.status == "running":
        try:
            message = solver.step()
        except ValueError:  # LSODA's own complaint about a state that is not finite
            return TOO_SMALL
        if message or not np.all(np.isfinite(solver.y)):
            return TOO_SMALL
        step = solver.t - solver.t_old
        state.y[: solver.n] = solver.y
        _kernels.derivative(solver.t, state.y, problem, rates)
        _kernels.turn_balls(before, state.y, step, problem.constants.balls, state.attitude)
        onset, states, shares, _ = _history(simulation)
        _kernels.remember(problem, solver.t, step, onset, states, shares)
        _kernels.add_film_work(problem, state.y)
        before[:] = state.y
        state.counters[_kernels.STEPS] += 1
        state.time, state.step = solver.t, step
    state.counters[_kernels.EVALUATIONS] += solver.nfev
    return DONE


def _solver(simulation: Simulation, end: float) -> LSODA:
    state, problem, scale = simulation.state, simulation.problem, simulation.scale
    # work of the films: after each step
    size = simulation.layout.size - 1
    mechanical = simulation.layout.mechanical
    full, found = np.zeros(size + 1), np.zeros(size + 1)

    def rates(t: float, y: Array) -> Array:
        full[:size] = y
        _kernels.derivative(t, full, problem, found)
        return found[:size].copy()

    def slopes(t: float, y: Array) -> Array:
        out = np.zeros((size, size))
        part = np.zeros((mechanical, mechanical))
        full[:size] = y
        _kernels.jacobian(t, full, problem, scale, part)
        out[:mechanical, :mechanical] = part
        return out

    energy = np.maximum(np.abs(state.y[mechanical:size]), 1.0) * ACCUMULATED
    return LSODA(
        rates,
        state.time,
        state.y[:size].copy(),
        end,
        first_step=min(state.step, end - state.time),
        max_step=control_of(simulation)[1],
        rtol=1e-12,
        atol=np.concatenate([TIGHTER * scale, energy]),
        jac=slopes,
    )
