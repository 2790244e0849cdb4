"""A run: times of its steps, the steady film that it starts from, the steps, their records, and
the state to go on from.

The film moves from node to node in each step, where it moves fast enough.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from math import inf, pi

import numpy as np
import scipy
from scipy.interpolate import RegularGridInterpolator

from ..arrays import Array
from ..grid import unfolded
from ..multigrid.cycle import (
    cycle,
    flow,
    relative_residual,
    reynolds_operator,
    start_level,
    update_exterior,
    update_film,
)
from ..multigrid.far_field import FarField
from ..multigrid.full_multigrid import Attempt, choose_domain, contact_multigrid
from ..multigrid.levels import Damping, Multigrid
from ..options import SolverOptions
from ..scaling import ScaledContact, scale_contact
from ..solution import ContactSolution
from ..solver import solve_attempts
from .content import steady_content
from .inputs import Feature, Impact, Scheme, TransientConditions, TransientOptions
from .record import QUANTITIES, Frame, MeshError, StepRecord, TransientSolution
from .step import Diverged, Past, StepConditions, Stepper, StepReport, far_fields_by_direction

GROWTH = 1.5  # of a step over the one before; second order backwards is stable below 2.41
LONGEST_STEP = 4.0  # steps as long as this many of those at the speed of the scales
MAX_STEPS = 1_000_000
IMPACT_STEPS = 300.0  # of the time that dry elastic bodies touch each other
FULL_NODE = 1.0 - 1e-9  # of a node, that counts as one

# share of K_00/hx below which nodes are relaxed distributively: with the 0.3 of steady contacts
# the storage, which is of the pressure itself and not of its slope, lets single nodes grow 3 to 5
# times a cycle at (M, L) = (100, 2.5), see docs/theory/transient.md
SWITCH = 1.0
POLISHED = 1e-7  # residual of the steady film
MAX_CYCLES = 40

DIVERGED = "step {step} of {planned}, t = {time:.4g} s, did not converge with any damping"
# error of single steps over the tolerance, and share of all steps that may be above it: what they
# leave is handed on to the next step and no more there
MAX_EXCESS = 10.0
MAX_MISSED_FRACTION = 0.02
FILM_NOT_POSITIVE = (
    "not converged: the film is not positive on this mesh at t = {time:.4g} s; try more points"
)
RESIDUAL_MESSAGE = "the cycles left {share:.1e} of the film or the feature, above {tolerance:g}"

__all__ = ["StartError", "TransientRun", "transient_run"]


def step_times(conditions: TransientConditions, mesh: float, largest: float | None) -> Array:
    """Plan the times of all steps from t = 0.

    Parameters
    ----------
    conditions : TransientConditions
        contact over time
    mesh : float
        distance of the nodes along the entrainment [m]
    largest : float | None
        longest step; None: four times that in which the film moves by a node [s]

    Returns
    -------
    Array
        times, shape (n + 1,) [s]

    Raises
    ------
    ValueError
        if there are more than `MAX_STEPS`
    """
    usual = mesh / conditions.contact.entrainment_speed
    longest = LONGEST_STEP * usual if largest is None else largest
    if largest is None and conditions.impact is not None:
        longest = impact_time(conditions, conditions.impact) / IMPACT_STEPS
    times = [0.0]
    before = longest
    while times[-1] < conditions.end_time * FULL_NODE:
        step = min(_step(conditions, times[-1], mesh, longest), GROWTH * before)
        left = conditions.end_time - times[-1]
        if conditions.impact is not None or conditions.speed is not None:
            step = min(step, left)
        times.append(times[-1] + step)
        before = step
        if len(times) > MAX_STEPS:
            raise ValueError(f"end_time: takes more than {MAX_STEPS} steps")
    return np.array(times)


def _step(conditions: TransientConditions, time: float, mesh: float, longest: float) -> float:
    """In which the film moves by a node, `longest` at most [s]."""
    if conditions.speed is None:
        return min(mesh / conditions.contact.entrainment_speed, longest)
    start = conditions.displacement(time)

    def beyond(step: float) -> float:
        return abs(conditions.displacement(time + step) - start) - mesh

    if beyond(longest) <= 0.0:
        return longest
    return float(scipy.optimize.brentq(beyond, 0.0, longest, xtol=1e-12 * longest, rtol=1e-14))


def nodes_moved(conditions: TransientConditions, times: Array, mesh: float) -> Array:
    """Count the nodes that the film moves by in each step; whole numbers without round-off.

    Parameters
    ----------
    conditions : TransientConditions
        contact over time
    times : Array
        times of the steps, shape (n + 1,) [s]
    mesh : float
        distance of the nodes along the entrainment [m]

    Returns
    -------
    Array
        nodes, of either sign, shape (n,) [-]
    """
    displacement = np.array([conditions.displacement(float(time)) for time in times])
    moved = np.diff(displacement) / mesh
    whole = np.round(moved)
    return np.where((np.abs(moved - whole) < 1e-6) & (whole != 0.0), whole, moved)


def impact_time(conditions: TransientConditions, impact: Impact) -> float:
    """Estimate the time that dry elastic spheres touch each other, Johnson (1985), sec. 11.4.

    2.94 d/V with the largest approach d = (15 m V^2/(16 sqrt(R) E*))^(2/5), R the mean radius of
    the contact.

    Parameters
    ----------
    conditions : TransientConditions
        contact over time
    impact : Impact
        mass and speed of the bodies

    Returns
    -------
    float
        time [s]
    """
    c = conditions.contact
    radius = (c.radius_x * c.radius_y) ** 0.5
    energy = 15.0 * impact.mass * impact.approach_speed**2
    deepest = (energy / (16.0 * radius**0.5 * 0.5 * c.reduced_modulus)) ** 0.4
    return 2.94 * deepest / abs(impact.approach_speed)


class StartError(Exception):
    """No steady film to start from; the message says why."""


@dataclass(frozen=True, slots=True, kw_only=True)
class InitialState:
    """A multigrid at the start of a run, and the oil that its nodes hold; all [-]."""

    state: Multigrid  # levels of the contact
    smooth: Array  # gap without features, shape (ny, nx)
    content: Array  # m, shape (ny, nx)
    fields: dict[bool, FarField]  # of an open box, by the direction of the entrainment
    domain: tuple[float, float, float]  # in Hertz semi-axes
    mesh: MeshError | None = None  # where it is a steady film


def levels_over_time(
    conditions: TransientConditions, options: TransientOptions
) -> tuple[Multigrid, ScaledContact, tuple[float, float, float]]:
    """Allocate the levels of the contact on a grid along the entrainment.

    Parameters
    ----------
    conditions : TransientConditions
        contact over time
    options : TransientOptions
        options of the run

    Returns
    -------
    levels
        levels, coarsest first
    contact
        scaled contact
    box
        x_in, x_out and y_half in Hertz half-extents [-]
    """
    contact = scale_contact(conditions.contact, along_entrainment=True)
    domain = options.domain or _open_box(conditions, contact)
    damping = Damping(switch=SWITCH)
    state = contact_multigrid(
        contact,
        domain,
        SolverOptions(points=options.points, domain=options.domain),
        Attempt(name="over time", damped=False, along_entrainment=True, first_damping=damping),
        full_domain=not conditions.symmetric,
    )
    return state, contact, domain


def _open_box(
    conditions: TransientConditions, contact: ScaledContact
) -> tuple[float, float, float]:
    """Choose the box of a steady contact, with as much behind as ahead where the entrainment stops
    or reverses.
    """
    x_in, x_out, y_half = choose_domain(contact)
    turns = conditions.speed is not None and min(conditions.speed.values) <= 0.0
    return (x_in, -x_in, y_half) if turns else (x_in, x_out, y_half)


def initial_state(
    conditions: TransientConditions, options: TransientOptions, feature_gap: Array
) -> InitialState:
    """Solve the steady film of t = 0, or place the bodies apart.

    Parameters
    ----------
    conditions : TransientConditions
        contact over time
    options : TransientOptions
        options of the run
    feature_gap : Array
        gap by the features at t = 0, shape (ny, nx) [-]

    Returns
    -------
    InitialState
        multigrid and fields to start from

    Raises
    ------
    StartError
        if the steady film does not converge
    """
    state, contact, domain = levels_over_time(conditions, options)
    level = state.levels[-1]
    smooth = level.gap.copy()
    level.gap = smooth + feature_gap
    fields = far_fields_by_direction(contact) if state.far_field is not None else {}
    mesh = None
    if conditions.impact is None:
        mesh = _settle(conditions, options, state)
    else:
        scale = contact.film_scale
        assert scale is not None
        state.approach = conditions.impact.gap / scale
        state.far_field = None
        start_level(state, len(state.levels) - 1, np.zeros_like(level.P))
    content = _content(state, conditions)
    return InitialState(
        state=state, smooth=smooth, content=content, fields=fields, domain=domain, mesh=mesh
    )


def _settle(
    conditions: TransientConditions, options: TransientOptions, state: Multigrid
) -> MeshError:
    """Steady film at the load and speed of t = 0, from a solution of its own scales."""
    speed = conditions.speed_at(0.0)
    load = conditions.load_at(0.0)
    c = conditions.contact
    at_zero = replace(c, load=load, entrainment_speed=abs(speed))
    points = SolverOptions(points=options.points, domain=options.domain)
    solution, levels = solve_attempts(at_zero, points)
    if not solution.converged:
        raise StartError(f"steady film at the start: {solution.message}")
    # 1. onto this grid, backwards where it runs so
    index = len(state.levels) - 1
    start = _interpolated_pressure(levels, solution.frame_angle, state, speed < 0.0)
    contact = state.contact
    state.approach = _scaled_approach(levels, state)
    fractions = (abs(speed) / c.entrainment_speed, load / c.load)
    turn = 1.0 if speed > 0.0 else -1.0
    at_start = replace(
        contact,
        speed=contact.speed * fractions[0],
        load=contact.load * fractions[1],
        velocity_x=turn * contact.velocity_x,
    )
    state.contact = at_start
    field = None if state.far_field is None else far_fields_by_direction(at_start)[True]
    state.far_field = field
    for one in state.levels:
        one.factors = replace(one.factors, couette_x=np.full_like(one.P, turn))
    start_level(state, index, start)
    update_exterior(state, index)
    update_film(state, index)
    residual = _polished(state, index)
    for one in state.levels:
        one.factors = replace(one.factors, couette_x=None)
    state.contact = contact
    if not residual < 1e-3:
        raise StartError(f"steady film at the start: residual of {residual:.1e} after the cycles")
    return _mesh_error(solution)


def _mesh_error(solution: ContactSolution) -> MeshError:
    """Distance of the nodal films from those without mesh, and the bars of these."""
    films = (solution.film_central_dimensionless, solution.film_minimum_dimensionless)
    errors = [(abs(f.value - f.finest) + f.uncertainty) / abs(f.value) for f in films]
    return MeshError(
        central=errors[0], minimum=errors[1], resolved=solution.resolved, message=solution.message
    )


def _polished(state: Multigrid, index: int) -> float:
    """Residual after cycles until the equations hold, or come no nearer to it [-]."""
    before = np.inf
    residual = np.inf
    for _ in range(MAX_CYCLES):
        cycle(state, index)
        residual = relative_residual(state, index)[0]
        if residual < POLISHED or (residual < 1e-5 and residual > 0.9 * before):
            break
        before = residual
    return float(residual)


def _scaled_approach(levels: Multigrid, state: Multigrid) -> float:
    """H0 of a solution in the scales of another grid [-]."""
    scale_before = levels.contact.film_scale
    scale = state.contact.film_scale
    assert scale_before is not None and scale is not None
    return levels.approach * scale_before / scale


def _interpolated_pressure(
    levels: Multigrid, angle: float, state: Multigrid, backwards: bool
) -> Array:
    """Pressure of a solution on another grid, in its scales, shape (ny, nx) [-]."""
    level = levels.levels[-1]
    grid = level.grid
    P = unfolded(level.P) if grid.symmetric else level.P
    Y = unfolded(grid.Y, sign=-1.0) if grid.symmetric else grid.Y
    before = levels.contact
    after = state.contact
    assert before.semi_axis_x is not None and after.semi_axis_x is not None
    length = after.semi_axis_x / before.semi_axis_x
    target = state.levels[-1].grid
    turn = after.frame_angle - angle
    c, s = np.cos(turn), np.sin(turn)
    X, YY = np.meshgrid(target.X, target.Y)
    sign = -1.0 if backwards else 1.0
    positions = np.stack((YY * c + X * s, sign * (X * c - YY * s)), axis=-1) * length
    at = RegularGridInterpolator((Y, grid.X), P, bounds_error=False, fill_value=0.0)
    return np.asarray(at(positions)) * before.hertz_pressure / after.hertz_pressure


def _content(state: Multigrid, conditions: TransientConditions) -> Array:
    """Oil of the nodes in the steady film."""
    level = state.levels[-1]
    state.time_step = None
    flow(state, level)
    full = level.flow_x * level.H
    speed = conditions.speed_at(0.0)
    if speed == 0.0 or conditions.impact is not None:
        return full
    # without film the operator is that of the Poiseuille flow alone
    film = level.H
    level.H = np.zeros_like(film)
    gained = reynolds_operator(level).copy()
    level.H = film
    fraction = abs(speed) / conditions.contact.entrainment_speed
    empty = level.P <= 0.0
    turned = slice(None, None, 1 if speed > 0.0 else -1)
    content = steady_content(
        full[:, turned], gained[:, turned] / fraction, empty[:, turned], level.grid.hx
    )
    return content[:, turned]


@dataclass(frozen=True, slots=True, kw_only=True)
class StepResult:
    """One step done, not yet part of the run."""

    past: Past  # fields that the next step starts from
    exterior: float  # load outside the box [-]
    halvings: int  # of the damping so far [-]
    record: StepRecord  # values of the step
    frame: Frame | None  # fields, where they are recorded


@dataclass(slots=True, kw_only=True)
class TransientRun:
    """One contact over time, as far as it has come."""

    conditions: TransientConditions  # contact over time
    options: TransientOptions  # of the run
    times: Array  # of all steps planned [s]
    nodes: Array  # by which the film moves in each [-]
    stepper: Stepper  # multigrid of the contact
    past: Past  # fields of the last two steps
    starts: tuple[float, ...]  # of the features [m]
    domain: tuple[float, float, float]  # x_in, x_out, y_half in Hertz semi-axes [-]
    mesh: MeshError | None = None  # error of the start by the mesh
    steps: list[StepRecord] = field(default_factory=list)  # records, the start first
    frames: list[Frame] = field(default_factory=list)  # fields at some steps
    message: str = ""  # of a step that failed
    exterior: float = 0.0  # load outside the box [-]

    @property
    def planned(self) -> int:
        """Steps from the start to the end [-]."""
        return len(self.times) - 1

    @property
    def done(self) -> int:
        """Steps made [-]."""
        return len(self.steps) - 1

    @property
    def finished(self) -> bool:
        """True if no step remains, or none can be made."""
        return self.done >= self.planned or bool(self.message)

    def advance(self) -> StepResult | None:
        """Compute the next step and change nothing that is kept; None where it diverges, and the
        run is over.
        """
        number = self.done + 1
        move = self._move(number)
        try:
            past, report = self.stepper.advance(self.past, move)
        except Diverged:
            time = float(self.times[number])
            self.message = DIVERGED.format(step=number, planned=self.planned, time=time)
            return None
        frame = self._frame(number, past) if number in self._frame_steps() else None
        return StepResult(
            past=past,
            exterior=self.stepper.state.exterior,
            halvings=self.stepper.halvings,
            record=self._record(number, move, past, report),
            frame=frame,
        )

    def accept(self, result: StepResult) -> None:
        """Append a step to the run.

        Parameters
        ----------
        result : StepResult
            step that `advance` computed
        """
        self.past = result.past
        self.exterior = result.exterior
        self.steps.append(result.record)
        if result.frame is not None:
            self.frames.append(result.frame)

    def resume_from(
        self, past: Past, state: tuple[float, int], records: tuple[list[StepRecord], list[Frame]]
    ) -> None:
        """Resume an earlier run of the same case.

        Parameters
        ----------
        past : Past
            fields of its last two steps
        state : tuple[float, int]
            load outside the box [-] and halvings of the damping [-]
        records : tuple[list[StepRecord], list[Frame]]
            records of its steps, and its frames
        """
        self.past = past
        self.exterior, self.stepper.halvings = state
        self.stepper.state.exterior = self.exterior
        self.stepper.state.approach = past.approach[0]
        for _ in range(self.stepper.halvings):
            self.stepper.state.damping = self.stepper.state.damping.halved()
        self.steps, self.frames = records

    def complete(self) -> Iterator[int]:
        """Make all steps that are left; the number of each [-]."""
        while not self.finished:
            result = self.advance()
            if result is not None:
                self.accept(result)
                yield self.done

    def record_start(self) -> None:
        """The state at t = 0 as the first record."""
        report = StepReport(cycles=0, residual=0.0, load_error=0.0, balance=0.0)
        self.steps = [self._record(0, self._move(0), self.past, report)]
        self.frames = [self._frame(0, self.past)]

    def solution(self) -> TransientSolution:
        """Collect the results so far."""
        contact = self.stepper.state.contact
        grid = self.stepper.level.grid
        a, _ = _lengths(contact)
        converged, message = self._status()
        return TransientSolution(
            conditions=self.conditions,
            options=self.options,
            x=grid.X * a,
            y=grid.Y * a,
            symmetric=grid.symmetric,
            semi_axes=(contact.half_extent_x * a, contact.half_extent_y * a),
            hertz_pressure=contact.hertz_pressure,
            moes=(contact.moes_load, contact.moes_lubricant),
            domain=self.domain,
            planned=self.planned,
            steps=tuple(self.steps),
            frames=tuple(self.frames),
            converged=converged,
            message=message,
            mesh=self.mesh,
            starts=self.starts,
        )

    def _status(self) -> tuple[bool, str]:
        if self.message:
            return False, self.message
        least = QUANTITIES.index("film_minimum")
        for step in self.steps:
            if not step.values[least] > 0.0:
                return False, FILM_NOT_POSITIVE.format(time=float(step.values[0]))
        error = QUANTITIES.index("error")
        errors = np.array([step.values[error] for step in self.steps])
        tolerance = self.options.tolerance
        worst = float(errors.max())
        missed = float(np.mean(errors > tolerance))
        if worst > MAX_EXCESS * tolerance or missed > MAX_MISSED_FRACTION:
            return (
                False,
                f"not converged: {RESIDUAL_MESSAGE.format(share=worst, tolerance=tolerance)}",
            )
        if self.done < self.planned:
            return False, f"not converged: {self.done} of {self.planned} steps made"
        return True, "converged"

    def _frame_steps(self) -> set[int]:
        count = min(self.options.frames, self.planned + 1)
        return set(np.round(np.linspace(0, self.planned, count)).astype(int).tolist())

    def _move(self, number: int) -> StepConditions:
        contact = self.stepper.state.contact
        c = self.conditions.contact
        a, scale = _lengths(contact)
        unit = a / c.entrainment_speed
        time = float(self.times[number])
        step = (time - float(self.times[number - 1])) / unit if number else unit
        mass = 0.0
        if self.conditions.impact is not None:
            # mu: mass times film scale over the square of the time, over the unit of the load
            force = c.load / contact.load
            mass = self.conditions.impact.mass * scale / unit**2 / force
        return StepConditions(
            step=step,
            nodes=float(self.nodes[number - 1]) if number else 0.0,
            speed=self.conditions.speed_at(time) / c.entrainment_speed,
            load=contact.load * self.conditions.load_at(time) / c.load,
            feature_gap=gap_by_features(self.conditions, self.starts, self.stepper, time),
            upstream=self.options.scheme is Scheme.UPSTREAM,
            mass=mass,
        )

    def _record(
        self, number: int, move: StepConditions, past: Past, report: StepReport
    ) -> StepRecord:
        stepper = self.stepper
        state = stepper.state
        level = stepper.level
        contact = state.contact
        c = self.conditions.contact
        a, scale = _lengths(contact)
        origin = 0 if level.grid.symmetric else level.grid.ny // 2
        middle = int(np.abs(level.grid.X).argmin())
        unit = a / c.entrainment_speed
        force = c.load / contact.load
        carried = level.grid.integral(level.P) + state.exterior
        ellipse = pi * contact.half_extent_x * contact.half_extent_y
        central = float(level.H[origin, middle])
        time = float(self.times[number])
        values = {
            "time": time,
            "speed": self.conditions.speed_at(time),
            "load": self.conditions.load_at(time),
            "film_force": carried * force,
            "approach": past.approach[0] * scale,
            "approach_rate": past.rate[0] * scale / unit,
            "film_central": central * scale,
            "film_minimum": float(level.H.min()) * scale,
            "pressure_central": float(level.P[origin, middle]) * contact.hertz_pressure,
            "pressure_maximum": float(level.P.max()) * contact.hertz_pressure,
            "error": report.residual / stepper.scale,
            "oil_error": report.balance / (ellipse * max(central, 1e-300)),
            "cycles": float(report.cycles),
        }
        return StepRecord(
            values=np.array([values[name] for name in QUANTITIES]),
            film_line=level.H[origin] * scale,
            pressure_line=level.P[origin] * contact.hertz_pressure,
        )

    def _frame(self, number: int, past: Past) -> Frame:
        level = self.stepper.level
        contact = self.stepper.state.contact
        _, scale = _lengths(contact)
        full = past.content[0] if number == 0 else self.stepper.density_and_film()[1]
        fraction = past.content[0] / np.where(full > 0.0, full, 1.0)
        return Frame(
            step=number,
            time=float(self.times[number]),
            pressure=level.P * contact.hertz_pressure,
            film=level.H * scale,
            filled=np.clip(fraction, 0.0, 1.0),
        )


def solve_transient(
    conditions: TransientConditions, options: TransientOptions | None = None
) -> TransientSolution:
    """Solve a contact over time, from the steady film of t = 0 to its end time.

    Parameters
    ----------
    conditions : TransientConditions
        contact over time
    options : TransientOptions | None, optional
        options of the run; None: the defaults

    Returns
    -------
    TransientSolution
        film and pressure over time; `converged` and `message` tell whether all steps were solved

    Raises
    ------
    StartError
        if the steady film does not converge
    ValueError
        if the conditions do not fit each other, or the run takes too many steps

    Examples
    --------
    >>> from oilfilm.ehl import ContactConditions, Lubricant
    >>> oil = Lubricant(viscosity=0.04, pressure_viscosity=18e-9)
    >>> contact = ContactConditions(
    ...     load=60.0,
    ...     radius_x=0.01,
    ...     radius_y=0.01,
    ...     reduced_modulus=226e9,
    ...     entrainment_speed=1.5,
    ...     lubricant=oil,
    ... )
    >>> from oilfilm.ehl.transient.inputs import Course, TransientConditions, TransientOptions
    >>> falling = Course(times=(0.0, 2e-4), values=(60.0, 30.0))
    >>> conditions = TransientConditions(contact=contact, end_time=3e-4, load=falling)
    >>> options = TransientOptions(points=33, domain=(-2.5, 1.5, 2.0), frames=2)
    >>> solution = solve_transient(conditions, options)
    >>> solution.converged
    True
    >>> [f"{film * 1e9:.0f} nm" for film in solution.series("film_central")[[0, -1]]]
    ['190 nm', '211 nm']
    """
    run = transient_run(conditions, options or TransientOptions())
    for _ in run.complete():
        pass
    return run.solution()


def transient_run(conditions: TransientConditions, options: TransientOptions) -> TransientRun:
    """Start a run: the steady film of t = 0 is solved.

    Parameters
    ----------
    conditions : TransientConditions
        contact over time
    options : TransientOptions
        options of the run

    Returns
    -------
    TransientRun
        run at its start

    Raises
    ------
    StartError
        if the steady film does not converge
    ValueError
        if the conditions do not fit each other, or the run takes too many steps
    """
    state, contact, _ = levels_over_time(conditions, options)
    level = state.levels[-1]
    a, scale = _lengths(contact)
    mesh = level.grid.hx * a
    times = step_times(conditions, mesh, options.largest_step)
    starts = tuple(_start(one, conditions, level.grid.x_in * a) for one in conditions.features)
    stepper = Stepper(
        state=state,
        smooth=level.gap,
        film=1.0,
        scale=1.0,
        tolerance=options.tolerance,
        cycles=(options.cycles, options.most_cycles),
    )
    first = initial_state(conditions, options, gap_by_features(conditions, starts, stepper, 0.0))
    stepper.state = first.state
    stepper.smooth = first.smooth
    stepper.fields = first.fields
    sizes = [one.size / scale for one in conditions.features if one.size > 0.0]
    stepper.film = _film(conditions, stepper)
    stepper.scale = min([stepper.film, *sizes])
    run = TransientRun(
        conditions=conditions,
        options=options,
        times=times,
        nodes=nodes_moved(conditions, times, mesh),
        stepper=stepper,
        past=_before_the_start(conditions, first, times),
        starts=starts,
        domain=first.domain,
        mesh=first.mesh,
    )
    run.record_start()
    return run


def _lengths(contact: ScaledContact) -> tuple[float, float]:
    """Semi-axis a and film scale a^2/Rx [m]."""
    assert contact.semi_axis_x is not None and contact.film_scale is not None
    return contact.semi_axis_x, contact.film_scale


def _film(conditions: TransientConditions, stepper: Stepper) -> float:
    """Central film that errors are counted in, of an impact that of the formula [-]."""
    if conditions.impact is not None:
        return stepper.state.contact.film_guess
    level = stepper.level
    origin = 0 if level.grid.symmetric else level.grid.ny // 2
    return float(level.H[origin, int(np.abs(level.grid.X).argmin())])


def _before_the_start(conditions: TransientConditions, first: InitialState, times: Array) -> Past:
    """Give the steady state before the start, or that of bodies in free flight."""
    a, scale = _lengths(first.state.contact)
    unit = a / conditions.contact.entrainment_speed
    rate = 0.0
    if conditions.impact is not None:
        rate = -conditions.impact.approach_speed * unit / scale
    step = float(times[1] - times[0]) / unit
    approach = first.state.approach
    pressure = first.state.levels[-1].P
    return Past(
        content=(first.content, first.content),
        pressure=(pressure.copy(), pressure.copy()),
        approach=(approach, approach - rate * step),
        rate=(rate, rate),
        step=0.0,
        nodes=0.0,
    )


def planned_steps(conditions: TransientConditions, options: TransientOptions) -> int:
    """Count the steps that a run will take.

    Parameters
    ----------
    conditions : TransientConditions
        contact over time
    options : TransientOptions
        options of the run

    Returns
    -------
    int
        number of steps [-]
    """
    state, contact, _ = levels_over_time(conditions, options)
    mesh = state.levels[-1].grid.hx * _lengths(contact)[0]
    return len(step_times(conditions, mesh, options.largest_step)) - 1


def gap_by_features(
    conditions: TransientConditions, starts: tuple[float, ...], stepper: Stepper, time: float
) -> Array:
    """Sum the gap by all features at a time.

    Parameters
    ----------
    conditions : TransientConditions
        contact over time
    starts : tuple[float, ...]
        positions of the features at t = 0 [m]
    stepper : Stepper
        multigrid of the contact
    time : float
        time [s]

    Returns
    -------
    Array
        gap, shape (ny, nx) [-]
    """
    grid = stepper.level.grid
    contact = stepper.state.contact
    a, scale = _lengths(contact)
    gap = np.zeros((grid.ny, grid.nx))
    for one, start in zip(conditions.features, starts, strict=True):
        along, across = conditions.body_displacement(one.body, time)
        begin_at = 0.0 if start == inf else start
        x = grid.X[None, :] * a - along - begin_at
        y = grid.Y[:, None] * a - across
        gap -= one.height(x, y, inf if start == inf else 0.0) / scale
    return gap


def _start(feature: Feature, conditions: TransientConditions, inlet: float) -> float:
    """Place of a feature at t = 0 [m]: as given, else ahead of the box, everywhere at rest."""
    if feature.start is not None:
        return feature.start
    fraction = conditions.body_speed_ratio(feature.body)[0]
    moving = fraction * conditions.speed_at(0.0)
    if abs(moving) < 1e-9 * conditions.contact.entrainment_speed:
        return inf
    if moving < 0.0:
        raise ValueError("start: needed for a feature of a body that moves backwards at t = 0")
    return inlet - feature.reach
