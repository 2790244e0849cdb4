"""The time simulation: steps to each sample, hands records on in pieces, keeps the energies, and
goes on from a file of its state.

The methods: compiled explicit steps, implicit ones on request, and SciPy's LSODA with the Jacobian
of the compiled equations where friction is too steep for explicit ones.
"""

import json
from collections.abc import Iterator
from copy import deepcopy
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np
import scipy
from threadpoolctl import threadpool_limits

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.data_files import arrays_as_bytes, read_arrays
from oilfilm.ehl.foreign_files import DAMAGE

from ..files import write_bytes
from ..geometry import Bearing
from ..operation import Operation
from . import _integration_kernels, _sdirk_kernels
from . import arrays as places
from ._integration_kernels import (
    COUNTERS,
    DONE,
    EVALUATIONS,
    NOT_FINITE,
    SOFT_SEEN,
    STAGE_ROWS,
    STEPS,
    STIFF,
    STIFF_SEEN,
    TOO_SMALL,
    jacobian,
)
from ._motion_kernels import energies, solved_derivative
from ._sdirk_kernels import Blocks
from .arrays import EquationData, Layout
from .assembly import assemble, reference_load, scales, vibration_frequency, with_equations
from .bodies import symmetric_until
from .choices import Integration, LoadType
from .initial import StartingPoint, initial_state, starting_point
from .inputs import DynamicsModel
from .record import (
    ContactHistory,
    Record,
    SimulationState,
    StepControl,
    empty_record,
    first_rows,
    join,
)
from .reduction import SYMMETRIC, SolvedMotion, derivative, solved_motion, symmetric_part

# over the tolerance of the explicit method: LSODA keeps its error less closely than a method of
# order five [-]
LSODA_TOLERANCE = 0.1
ACCUMULATOR_TOLERANCE = 1.0e-6  # relative, of work and dissipation [-]
# LSODA is given up where LOOK steps in a row are by their mean shorter than this part of the step
# at which it took over: 50 000 in a period of a loaded ball [-]
CRAWL = 1.0e-3
LOOK = 10000
# errors of a ball's velocity by the slopes of its friction that count as one
FRICTION_ERRORS = 10.0


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


def blocks_of(data: EquationData) -> Blocks:
    """Unknown speeds by the balls and bodies they belong to, with room for slopes.

    Parameters
    ----------
    data : EquationData
        problem in numbers

    Returns
    -------
    Blocks
        places of the speeds, slopes of zero
    """
    c = data.constants
    balls = c.balls
    layout = Layout(balls)
    unknown = data.solved[: data.mechanical]
    speeds = unknown[unknown >= layout.positions]
    from_first = speeds - layout.positions - places.BODIES
    owner = np.where(from_first < 0, -1, from_first // 3 % balls)
    alone = balls if c.symmetric_copies == 1 and c.cage_mass > 0.0 else 0
    members = [np.flatnonzero(owner == j) for j in range(alone)]
    size = members[0].size if alone else 0
    bodies = np.flatnonzero(owner < 0) if alone else np.arange(speeds.size)
    order = {int(place): k for k, place in enumerate(speeds)}
    across = np.full((balls, 2, 2), -1)
    for j in range(balls):
        for k, part in enumerate((layout.ball_speed, layout.ball_turn)):
            pair = [order.get(part.start + 3 * j + i, -1) for i in (1, 2)]
            across[j, k] = pair if min(pair) >= 0 else -1
    return Blocks(
        members=np.array(members, np.int64).reshape(alone, size),
        bodies=bodies,
        across=across,
        orbits=np.zeros(balls),
        own=np.zeros((alone, size, size)),
        onto=np.zeros((alone, bodies.size, size)),
        back=np.zeros((alone, size, bodies.size)),
        border=np.zeros((bodies.size, bodies.size)),
    )


def advance_slowly(
    state: SimulationState, motion: SolvedMotion, times: Array, control: StepControl, scale: Array
) -> tuple[int, Record]:
    """Move a state on to the given times by implicit steps.

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
    blocks = blocks_of(motion.data)
    speeds = blocks.members.size + blocks.bodies.size
    step = state.step if state.counters[0] else control.implicit
    status, rows, state.time, state.step = _sdirk_kernels.advance_slowly(
        state.time, y, step, motion.data.kernel, control.implicit,
        FRICTION_ERRORS * control.speed, motion.scale(scale)[-speeds:].copy(), blocks, history,
        state.counters, record,
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
    return scipy.integrate.LSODA(
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


PIECE = 256  # samples of a record
STRETCH = 32  # samples by LSODA that end a piece, before explicit steps are tried again
HEAVIEST = 5.0  # load of the heaviest ball over the mean one, Stribeck (1901) [-]
FIRST_STEP = 1.0e-9  # [s]
SHORTEST_STEP = 1.0e-12  # over the end time, below which a step has failed [-]
# fraction of the period of contact vibration: a stiff problem with shorter steps goes to LSODA [-]
STIFF_STEP = 0.02
# longest step times the frequency of a loaded ball: at the limit of stability it would ring [-]
STEP_ANGLE = 0.8
# without damping in any contact, energy that steps gain or lose remains: a light ring among
# impacts kept it to 1.5e-3 in 2000 steps of 0.8, to 1.1e-4 in steps of 0.4
UNDAMPED_ANGLE = 0.4
# longest implicit step, and over the time in which a ball takes the place of the next
LONGEST_IMPLICIT = 1.0e-4  # [s]
PITCH_SHARE = 0.05  # [-]
LAND_ADVICE = "; the film of the cage's land stiffens as its gap closes: a wider one, thinner oil"
LINEARISED = ("linear", "pocket_films", "implicit_step")  # of the data of the equations
FAILURES = {
    TOO_SMALL: "steps of {step:.1g} s at t = {t:.6g} s do not lead on; try a larger "
    "tolerance, friction ramp or impact floor, or less load{land}",
    NOT_FINITE: "the state is not finite at t = {t:.6g} s",
}

FORMAT = 4
# field of the state by its key in a restart file
ARRAYS = {
    "y": "y",
    "memory": "impact_speeds",
    "onset": "onset",
    "contact_state": "contact_state",
    "shares": "shares",
    "attitude": "attitude",
    "counters": "counters",
}


@dataclass(slots=True, kw_only=True)
class Simulation:
    """A bearing in motion: `pieces` moves it on and yields records."""

    bearing: Bearing
    operation: Operation
    model: DynamicsModel
    data: EquationData
    point: StartingPoint
    state: SimulationState
    start_energy: float  # [J]
    converged: bool = True
    messages: list[str] = field(default_factory=list)
    wall: float = 0.0  # time spent stepping [s]
    _in_use: tuple[EquationData, SolvedMotion, EquationData] | None = field(
        default=None, init=False, repr=False
    )

    @property
    def layout(self) -> Layout:
        """Slices of the state vector."""
        return Layout(self.bearing.balls)

    @property
    def equations(self) -> dict[str, int]:
        """Unknowns of the static and the quasi-static stage, equations of motion [-]: those that
        were solved.
        """
        static, quasi_static = self.point.unknowns
        ends = (0, places.RING, places.SEAT, places.BODIES, places.FREE_TURN + 3)
        parts = [int(self.data.free[a:b].sum()) for a, b in pairwise(ends)]
        parts[3] *= self.motion.solved
        named = zip(("ring", "cage", "support", "balls"), parts, strict=True)
        motion = {name: count for name, count in named if count or name != "support"}
        motion["dynamic"] = sum(parts)
        return {"static": static, "quasi_static": quasi_static, **motion}

    @property
    def motion(self) -> SolvedMotion:
        """Unknowns of the equations in use."""
        return self._equations_in_use()[1]

    def _equations_in_use(self) -> tuple[EquationData, SolvedMotion, EquationData]:
        """Equations of all balls, of the unknowns, and the general ones by the laws themselves:
        what is linearised is that of the motion in use.
        """
        if self._in_use is None or self._in_use[0] is not self.data:
            general = with_equations(self.data, LoadType.GENERAL, self.operation, self.model)
            for name in LINEARISED:
                getattr(general, name)[:] = 0.0
            motion = solved_motion(self.state.kind, self.data)
            self._in_use = self.data, motion, general
        return self._in_use

    @property
    def scale(self) -> Array:
        """Errors that count as one, `assembly.scales` [SI]."""
        return scales(self.data, self.reference_load, self.model)

    @property
    def reference_load(self) -> float:
        """Load that sets the scale of errors, `assembly.reference_load` [N]."""
        return reference_load(self.data.schedule, self.data.constants, self.bearing.balls)

    @property
    def control(self) -> StepControl:
        """Limits of the steps, by the vibration of the heaviest loaded ball between races [s]."""
        return self._control(self.scale)

    def _control(self, scale: Array) -> StepControl:
        """`control` by the `scale` of the errors [SI]."""
        options = self.model.options
        laws = self.data.normal[: places.OUTER + 1]
        heaviest = HEAVIEST * self.reference_load
        damped = (
            np.any(laws[:, [places.DAMPING, places.FILM_RATE, places.LOSS]])
            or self.data.friction_kind == places.FILM
        )
        angle = STEP_ANGLE if damped else UNDAMPED_ANGLE
        mass = self.data.constants.ball_mass
        frequency = max(
            vibration_frequency(law[places.STIFFNESS], heaviest, mass, law[places.EXPONENT])
            for law in laws
        )
        steepest = max(
            heaviest / (heaviest / law[places.STIFFNESS]) ** (1.0 / law[places.EXPONENT])
            for law in laws
        )
        return StepControl(
            shortest=SHORTEST_STEP * options.end_time,
            steepest=float(steepest),
            longest=min(options.longest_step or angle / frequency, options.sample_interval),
            implicit=min(
                options.longest_step or LONGEST_IMPLICIT, self._pitch_time() * PITCH_SHARE
            ),
            stiff=STIFF_STEP * 2.0 * np.pi / frequency,
            speed=float(scale[self.layout.ball_speed][0]),
        )

    def _pitch_time(self) -> float:
        """Time in which a ball takes the place of the next at the fastest speeds [s]."""
        rings = self.data.schedule[:, [places.INNER_SPEED, places.OUTER_SPEED]]
        fastest = max(float(np.abs(rings).max()), 1e-9)
        return 2.0 * np.pi / (0.5 * fastest * self.bearing.balls)

    def sample_times(self) -> Array:
        """Times of the samples still to come [s]."""
        options = self.model.options
        count = round(options.end_time / options.sample_interval)
        times = np.linspace(0.0, options.end_time, count + 1)
        return times[times > self.state.time + 1e-12 * abs(self.state.time)]

    def pieces(self) -> Iterator[Record]:
        """Move on to the end; a record after each piece, the shorter the harder the samples are.
        Stops early, `converged` False, where a step fails; Ctrl-C during a piece leaves the state
        at its beginning.
        """
        times = self.sample_times()
        scale = self.scale
        method = self._control(scale), scale
        while times.size:
            began = perf_counter()
            saved = deepcopy(self.state)
            try:
                record = self._advance(times[:PIECE], method)
            except KeyboardInterrupt:
                self._restore(saved)
                raise
            self.wall += perf_counter() - began
            times = times[record.time.size :]
            if record.time.size:
                yield record
            if not self.converged:
                return

    def set_equations(self, kind: LoadType) -> None:
        """Go on with the equations of another load type from the present state.

        Parameters
        ----------
        kind : LoadType
            equations of motion
        """
        if kind is not self.state.kind:
            self.data = with_equations(self.data, kind, self.operation, self.model)
            self.state.kind = kind

    def _restore(self, saved: SimulationState) -> None:
        self.set_equations(saved.kind)
        self.state.restore(saved)

    def _symmetric(self, control: StepControl, scale: Array) -> bool:
        """Check that the general equations keep the motion as symmetric as the ones in use.

        No acceleration against the symmetry changes a speed in a step by an error that counts as
        one.
        """
        layout = self.layout
        _, motion, general = self._equations_in_use()
        rates = np.zeros(layout.size)
        derivative(self.state.time, self.state.y, general, rates)
        against = rates - symmetric_part(motion, rates)
        speeds = slice(layout.positions, layout.mechanical)
        change = np.abs(against[speeds]) * control.longest
        return bool(np.all(change <= scale[speeds]))

    def _advance(self, times: Array, method: tuple[StepControl, Array]) -> Record:
        """A piece with the equations that hold, up to where their symmetry ends; the general ones
        from there.
        """
        if self.state.kind not in SYMMETRIC:
            return self._steps(times, method)
        until = symmetric_until(self.state.kind, self.operation, self.model)
        if not self._symmetric(*method):
            until = self.state.time
        symmetric_times = times[times <= until]
        if not symmetric_times.size:
            self._break_symmetry()
        return self._steps(symmetric_times if symmetric_times.size else times, method)

    def _break_symmetry(self) -> None:
        """Go on with the general equations, and say so."""
        text = f"dynamics: the motion lost the symmetry of the {self.state.kind.value} equations"
        self.set_equations(LoadType.GENERAL)
        self._note(f"{text} at t = {self.state.time:.6g} s; the general ones went on from there")

    def _steps(self, times: Array, method: tuple[StepControl, Array]) -> Record:
        """Explicit steps; where they are given up, at most `STRETCH` samples by LSODA. Or implicit
        ones throughout.
        """
        if self.model.options.integration is Integration.IMPLICIT:
            status, record = advance_slowly(self.state, self.motion, times, *method)
            if status != DONE:
                self.converged = False
                self._fail(status)
            return record
        began, stiff = self.state.time, self.state.stiff
        saved = deepcopy(self.state) if stiff else None
        # 1. explicit steps, after LSODA too: a stiff start may be over
        status, record = advance_explicit(self.state, self.motion, times, *method)
        # 2. where they fail after LSODA, undo them: LSODA does their samples too
        if saved is not None and status not in (DONE, STIFF):
            self.state.restore(saved)
            status = STIFF
            record = empty_record(times[:0], self.bearing.balls)
        # 3. LSODA from there on
        if status == STIFF:
            self._note(f"dynamics: stiff from t = {self.state.time:.6g} s on; LSODA took over")
            self.state.stiff = True
            remaining = times[record.time.size :][:STRETCH]
            status, remainder = advance_implicit(self.state, self.motion, remaining, *method)
            record = join(record, remainder)
        elif stiff and status == DONE:
            text = f"explicit steps again from t = {began:.6g} s on; LSODA where"
            self._note(f"dynamics: {text} they are given up")
        if status != DONE:
            self.converged = False
            self._fail(status)
        return record

    def _fail(self, status: int) -> None:
        c = self.data.constants
        film = c.cage_mass > 0.0 and c.guide != places.GUIDED_BY_BALLS and c.film_viscosity > 0.0
        values = {
            "t": self.state.time,
            "step": self.state.step,
            "land": LAND_ADVICE if film else "",
        }
        self.messages.append(f"dynamics: not converged: {FAILURES[status].format(**values)}")

    def _note(self, text: str) -> None:
        """Add a message unless one that begins alike is there."""
        if not any(message.startswith(text.split(" t = ")[0]) for message in self.messages):
            self.messages.append(text)


def simulation(bearing: Bearing, operation: Operation, model: DynamicsModel) -> Simulation:
    """A simulation at its start, under speeds and loads of the inner ring.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    operation : Operation
        speeds [rad/s] and loads [N], [N m]
    model : DynamicsModel
        cage, contact laws, schedule and options

    Returns
    -------
    Simulation
        simulation, to be moved on by `pieces`

    Examples
    --------
    >>> from oilfilm.bearing import Operation, load_bearing
    >>> from oilfilm.bearing.dynamics.bodies import ring_body
    >>> from oilfilm.bearing.dynamics.friction import RaceFriction
    >>> from oilfilm.bearing.dynamics.inputs import DynamicsModel, DynamicsOptions
    >>> from oilfilm.bearing.dynamics.simulation import simulation
    >>> bearing = load_bearing("6208")
    >>> model = DynamicsModel(
    ...     options=DynamicsOptions(end_time=1e-4, sample_interval=1e-5),
    ...     ring=ring_body(bearing),
    ...     friction=RaceFriction(),
    ... )
    >>> operation = Operation(inner_speed=300.0, force=(1000.0, 0.0, 0.0))
    >>> run = simulation(bearing, operation, model)
    >>> sum(record.time.size for record in run.pieces()), run.converged
    (10, True)
    """
    point = starting_point(bearing, operation, model)
    data = assemble(bearing, operation, model, point)
    y = initial_state(bearing, data, point, model.options.start)
    return from_state(bearing, operation, model, (point, data, y))


def simulate(
    bearing: Bearing, operation: Operation, model: DynamicsModel
) -> tuple[Simulation, Record]:
    """Simulate a bearing from its start to the end time of the model.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    operation : Operation
        speeds [rad/s] and loads [N], [N m] of the inner ring
    model : DynamicsModel
        cage, contact laws, schedule and options

    Returns
    -------
    run : Simulation
        the simulation at its end, or where a step failed: see `converged` and `messages`
    record : Record
        motion, forces and powers at the sample times, SI

    Examples
    --------
    >>> import oilfilm
    >>> from oilfilm.bearing.dynamics.bodies import ring_body
    >>> from oilfilm.bearing.dynamics.friction import RaceFriction
    >>> from oilfilm.bearing.dynamics.inputs import DynamicsModel, DynamicsOptions
    >>> bearing = oilfilm.load_bearing("6208")
    >>> model = DynamicsModel(
    ...     options=DynamicsOptions(end_time=1e-4, sample_interval=1e-5),
    ...     ring=ring_body(bearing),
    ...     friction=RaceFriction(),
    ... )
    >>> operation = oilfilm.Operation(inner_speed=300.0, force=(1000.0, 0.0, 0.0))
    >>> run, record = oilfilm.simulate(bearing, operation, model)
    >>> run.converged, record.time.size
    (True, 10)
    """
    run = simulation(bearing, operation, model)
    record = empty_record(np.empty(0), bearing.balls)
    for piece in run.pieces():
        record = join(record, piece)
    return run, record


def from_state(
    bearing: Bearing,
    operation: Operation,
    model: DynamicsModel,
    start: tuple[StartingPoint, EquationData, Array],
) -> Simulation:
    """A simulation from a state vector.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    operation : Operation
        speeds and loads
    model : DynamicsModel
        cage, contact laws, schedule and options
    start : tuple[StartingPoint, EquationData, Array]
        equations of the start, problem in numbers and state vector [SI]

    Returns
    -------
    Simulation
        simulation at time zero
    """
    point, data, y = start
    n = bearing.balls
    time = 0.0 if model.settling is None else -model.settling.time
    layout = Layout(n)
    speeds = data.schedule[0]
    y[layout.ring_angle] = speeds[places.INNER_SPEED] * time
    y[layout.outer_angle] = speeds[places.OUTER_SPEED] * time
    y[layout.roll] = speeds[places.ROLL_SPEED] * time
    state = SimulationState(
        kind=point.kind,
        time=time,
        step=FIRST_STEP,
        y=y,
        impact_speeds=data.impact_speeds,
        onset=np.full(3 * n + 2, -np.inf),
        contact_state=np.zeros((2, n), dtype=np.int8),
        shares=np.zeros((2, n, 3)),
        attitude=np.tile([1.0, 0.0, 0.0, 0.0], (n, 1)),
        counters=np.zeros(COUNTERS, dtype=np.int64),
    )
    energy = np.zeros(3)
    derivative(time, y, data, np.zeros_like(y))
    energies(y, data.kernel, energy)
    return Simulation(
        bearing=bearing,
        operation=operation,
        model=model,
        data=data,
        point=point,
        state=state,
        start_energy=float(energy.sum()),
        messages=list(point.messages),
    )


def save_restart(simulation: Simulation, path: Path, case: str = "") -> None:
    """Write the state of a simulation; the file appears under its name when it is complete.

    Parameters
    ----------
    simulation : Simulation
        simulation to continue later
    path : Path
        name of the file
    case : str, default ''
        text of the case, which is compared when the file is read
    """
    state = simulation.state
    head = {
        "format": FORMAT,
        "case": case,
        "kind": state.kind.value,
        "time": state.time,
        "step": state.step,
        "stiff": state.stiff,
        "start_energy": simulation.start_energy,
    }
    arrays = {key: getattr(state, name) for key, name in ARRAYS.items()}
    write_bytes(path, arrays_as_bytes({"head": np.array(json.dumps(head)), **arrays}))


def load_restart(simulation: Simulation, path: Path, case: str = "") -> None:
    """Set a new simulation of the same case to the state of a file.

    Parameters
    ----------
    simulation : Simulation
        new simulation, changed
    path : Path
        name of the file
    case : str, default ''
        text of the case

    Raises
    ------
    ValueError
        if the file is damaged, of another version of the program, or of another case
    """
    try:
        data = read_arrays(path)
        head = json.loads(str(data["head"]))
        current = head.get("format") == FORMAT
        arrays = {key: data[key] for key in ARRAYS if current}
    except (OSError, *DAMAGE) as error:
        raise ValueError(f"{path}: no restart file, or a damaged one") from error
    if not current:
        raise ValueError(
            f"{path}: was written by another version of the program; start anew, without it"
        )
    if head.get("case") != case:
        raise ValueError(f"{path}: is of another case")
    for key, value in arrays.items():
        getattr(simulation.state, ARRAYS[key])[...] = value
    simulation.set_equations(LoadType(head["kind"]))
    simulation.state.time = head["time"]
    simulation.state.step = head["step"]
    simulation.state.stiff = head["stiff"]
    simulation.start_energy = head["start_energy"]
