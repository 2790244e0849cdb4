"""A run: start, steps, what is recorded, and the state to go on from."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from math import inf, pi

import numpy as np

from ..arrays import Array
from ..scaling import ScaledContact
from .features import Feature
from .inputs import Scheme, TransientConditions, TransientOptions
from .plan import nodes_moved, step_times
from .record import QUANTITIES, Frame, MeshError, StepRecord, TransientSolution
from .start import InitialState, StartError, initial_state, levels_over_time
from .step import Diverged, Past, StepConditions, Stepper, StepReport

DIVERGED = "step {step} of {planned}, t = {time:.4g} s, did not converge with any damping"
# error of single steps over the tolerance, and share of all steps that may be above it: what they
# leave is handed on to the next step and no more there
MAX_EXCESS = 10.0
MAX_MISSED_FRACTION = 0.02
FILM_NOT_POSITIVE = (
    "not converged: the film is not positive on this mesh at t = {time:.4g} s; try more points"
)
RESIDUAL_MESSAGE = "the cycles left {share:.1e} of the film or the feature, above {tolerance:g}"


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
    >>> from ehl import ContactConditions, Lubricant
    >>> oil = Lubricant(viscosity=0.04, pressure_viscosity=18e-9)
    >>> contact = ContactConditions(
    ...     load=60.0,
    ...     radius_x=0.01,
    ...     radius_y=0.01,
    ...     reduced_modulus=226e9,
    ...     entrainment_speed=1.5,
    ...     lubricant=oil,
    ... )
    >>> from ehl.transient.inputs import Course, TransientConditions, TransientOptions
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


__all__ = ["StartError", "TransientRun", "transient_run"]
