"""The time simulation: steps to each sample, hands records on in pieces, keeps the energies."""

from collections.abc import Iterator
from copy import deepcopy
from dataclasses import dataclass, field
from time import perf_counter

import numpy as np

from ..geometry import Bearing
from ..operation import Operation
from ._kernels import derivative, energies
from .assembly import assemble, scales
from .bodies import equation_counts
from .initial import StartingPoint, initial_state, starting_point
from .inputs import DynamicsModel
from .laws import vibration_frequency
from .layout import Layout
from .problem import Array, Problem
from .record import Record, SimulationState, empty_record, join

PIECE = 128  # samples handed on at a time
STIFF = 2  # status of the explicit steps where they are given up
REFERENCE_LOAD = 10.0  # least load that sets the scale of errors [N]
HEAVIEST = 5.0  # load of the heaviest ball over the mean one, Stribeck (1901) [-]
MESSAGES = {
    1: "dynamics: not converged: the step became too small at t = {t:.6g} s; try a larger tolerance or friction ramp",
    3: "dynamics: not converged: the state is not finite at t = {t:.6g} s",
}


@dataclass(slots=True, kw_only=True)
class Simulation:
    """A bearing in motion: `pieces` moves it on and hands out records."""

    bearing: Bearing
    operation: Operation
    model: DynamicsModel
    problem: Problem
    point: StartingPoint
    state: SimulationState
    start_energy: float  # [J]
    converged: bool = True
    messages: list[str] = field(default_factory=list)
    wall: float = 0.0  # time spent stepping [s]

    @property
    def layout(self) -> Layout:
        """Where what stands in the state vector."""
        return Layout(self.bearing.balls)

    @property
    def equations(self) -> dict[str, int]:
        """Counts of equations [-]."""
        return equation_counts(self.point.kind, self.bearing.balls, self.operation)

    @property
    def scale(self) -> Array:
        """Errors that count as one, `assembly.scales` [SI]."""
        tolerance = self.model.options.tolerance
        return scales(self.problem, self.reference_load, tolerance, self.model.friction.ramp)

    @property
    def reference_load(self) -> float:
        """Largest load over the number of balls, at least `REFERENCE_LOAD` [N]."""
        rows = self.problem.schedule[:, 3:6]
        return max(REFERENCE_LOAD, float(np.linalg.norm(rows, axis=1).max()) / self.bearing.balls)

    @property
    def frequency(self) -> float:
        """Angular frequency of the heaviest loaded ball between the races [rad/s]."""
        stiffness = float(self.problem.normal[:2, 0].max())
        mass = self.problem.constants.ball_mass
        return vibration_frequency(stiffness, HEAVIEST * self.reference_load, mass)

    def sample_times(self) -> Array:
        """Times of the samples still to come [s]."""
        options = self.model.options
        count = round(options.end_time / options.sample_interval)
        times = np.linspace(0.0, options.end_time, count + 1)[1:]
        return times[times > self.state.time * (1.0 + 1e-12)]

    def pieces(self) -> Iterator[Record]:
        """Move on to the end; a record after each piece. Stops early, `converged` False, where a
        step fails.

        Ctrl-C during a piece leaves the state at its beginning.
        """
        times = self.sample_times()
        for first in range(0, times.size, PIECE):
            began = perf_counter()
            before = deepcopy(self.state)
            try:
                record = self._advance(times[first : first + PIECE], before)
            except KeyboardInterrupt:
                self.state.put_back(before)
                raise
            self.wall += perf_counter() - began
            if record.time.size:
                yield record
            if not self.converged:
                return

    def _advance(self, times: Array, before: SimulationState) -> Record:
        """A piece by explicit steps; where they are given up, its rest by LSODA. The next piece
        tries them anew.

        A trial that fails after LSODA took over is undone, to `before`: LSODA does the whole
        piece.
        """
        from .integration.explicit import advance_explicit

        status, record = advance_explicit(self, times)
        if before.stiff and status not in (0, STIFF):
            self.state.put_back(before)
            status = STIFF
            record = empty_record(times[:0], self.bearing.balls)
        if status == STIFF:
            from .integration.implicit import advance_implicit

            self._tell(f"dynamics: stiff from t = {self.state.time:.6g} s on; LSODA took over")
            self.state.stiff = True
            status, rest = advance_implicit(self, times[record.time.size :])
            record = join(record, rest)
        elif self.state.stiff and status == 0:
            self._tell(
                f"dynamics: explicit steps again from t = {before.time:.6g} s on; LSODA where they are given up"
            )
        if status != 0:
            self.converged = False
            self.messages.append(MESSAGES[status].format(t=self.state.time))
        return record

    def _tell(self, text: str) -> None:
        """Add a message unless one that begins alike was told before."""
        if not any(message.startswith(text.split(" t = ")[0]) for message in self.messages):
            self.messages.append(text)


def simulation(bearing: Bearing, operation: Operation, model: DynamicsModel) -> Simulation:
    """A simulation at its start.

    Parameters
    ----------
    bearing : Bearing
    operation : Operation
        Speeds [rad/s], loads [N, N m] of the inner ring.
    model : DynamicsModel

    Returns
    -------
    Simulation
    """
    point = starting_point(bearing, operation, model)
    problem = assemble(bearing, operation, model, point.angles)
    y = initial_state(bearing, problem, point, model.options.start)
    return from_state(bearing, operation, model, (point, problem, y))


def from_state(
    bearing: Bearing,
    operation: Operation,
    model: DynamicsModel,
    start: tuple[StartingPoint, Problem, Array],
) -> Simulation:
    """A simulation from a state vector [SI]."""
    point, problem, y = start
    n = bearing.balls
    attitude = np.zeros((n, 4))
    attitude[:, 0] = 1.0
    state = SimulationState(
        time=0.0,
        step=1.0e-9,
        y=y,
        memory=problem.memory,
        onset=np.full(3 * n + 2, -np.inf),
        contact_state=np.zeros((2, n), dtype=np.int8),
        shares=np.zeros((2, n, 3)),
        attitude=attitude,
        counters=np.zeros(5, dtype=np.int64),
    )
    out = np.zeros(3)
    derivative(0.0, y, problem, np.zeros_like(y))
    energies(y, problem, out)
    return Simulation(
        bearing=bearing,
        operation=operation,
        model=model,
        problem=problem,
        point=point,
        state=state,
        start_energy=float(out.sum()),
        messages=list(point.messages),
    )
