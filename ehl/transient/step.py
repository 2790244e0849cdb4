"""One step in time of the multigrid: source, first guess, cycles, oil that is kept."""

from dataclasses import dataclass, field, replace

import numpy as np

from ..arrays import Array
from ..multigrid.cycle import cycle, flow, load_error, reynolds_operator, update_film
from ..multigrid.far_field import FarField, far_field, transient_far_field
from ..multigrid.full_multigrid import PRESSURE_LIMIT, snapshot
from ..multigrid.levels import Level, Multigrid, TimeStep
from ..scaling import ScaledContact
from .content import advected, weights

HALVINGS = 3  # of the damping in one step before the run is given up
# over the load of the scales, that cycles may leave unbalanced
LOAD_TOLERANCE = 1e-4


@dataclass(slots=True, kw_only=True)
class Past:
    """Fields of the last two steps, arrays of shape (ny, nx), and how bodies moved; all [-]."""

    content: tuple[Array, Array]  # m of the last step and the one before
    pressure: tuple[Array, Array]  # P of the last step and the one before
    approach: tuple[float, float]  # H0
    rate: tuple[float, float]  # dH0/dT
    step: float  # T of the last step; zero before the first
    nodes: float  # by which the film moved in it


@dataclass(frozen=True, slots=True, kw_only=True)
class StepConditions:
    """Conditions of one step; all [-]."""

    step: float  # duration
    nodes: float  # by which the film moves along the lines
    speed: float  # over u_m, at the end of the step
    load: float  # integral of P at the end
    feature_gap: Array  # gap by the features at the end, shape (ny, nx)
    upstream: bool  # the scheme to compare with
    mass: float = 0.0  # mu of the bodies; zero: they follow the load at once


@dataclass(frozen=True, slots=True, kw_only=True)
class StepReport:
    """Errors that a step left; all [-]."""

    cycles: int  # of the multigrid
    # mean of |residual| H_c/(sigma max(H, H_c)) where oil carries: error of the film
    residual: float
    load_error: float  # over the load of the scales
    balance: float  # integral of the residual over sigma: oil not yet in its place


@dataclass(slots=True, kw_only=True)
class Stepper:
    """The multigrid of a contact over time."""

    state: Multigrid  # levels of the contact
    smooth: Array  # gap without features, shape (ny, nx) [-]
    film: float  # H_c; in a wider gap an error counts over the gap [-]
    scale: float  # that the error of a step is counted in: the film, or a smaller feature [-]
    tolerance: float  # [-]
    cycles: tuple[int, int]  # at least and at most
    predicts: bool = True  # first guess from two steps
    fields: dict[bool, FarField] = field(default_factory=dict)  # forwards and backwards
    halvings: int = 0  # of the damping so far

    @property
    def level(self) -> Level:
        """The finest."""
        return self.state.levels[-1]

    def density_and_film(self) -> tuple[Array, Array]:
        """rho, and what the gap holds when full, shape (ny, nx); of a level whose flow is up to
        date [-].
        """
        assert self.state.time_step is not None
        density = self.level.storage[0] / self.state.time_step.rate
        return density, density * self.level.H

    def advance(self, past: Past, move: StepConditions) -> tuple[Past, StepReport]:
        """Solve one step in time.

        Parameters
        ----------
        past : Past
            fields of the last two steps
        move : StepConditions
            duration, speed, load and features of the step

        Returns
        -------
        past
            fields that the next step starts from
        report
            cycles and errors of the step

        Raises
        ------
        Diverged
            if the step converges with no damping
        """
        index = len(self.state.levels) - 1
        before = snapshot(self.state, index)
        for _ in range(HALVINGS + 1):
            self._begin(past, move)
            with np.errstate(all="ignore"):
                report = self._cycles(move)
            if report is not None:
                return self._ended(past, move), report
            self.level.P = before[0].copy()
            self.state.approach, self.state.exterior = before[1], before[2]
            self.state.damping = self.state.damping.halved()
            self.halvings += 1
        raise Diverged

    def _begin(self, past: Past, move: StepConditions) -> None:
        """Equations of the step, and the first guess of pressure and H0."""
        first = past.step == 0.0
        ratio = 1.0 if first else move.step / past.step
        c0, c1, c2 = weights(ratio)
        nodes = (0.0, 0.0) if move.upstream else (move.nodes, move.nodes)
        back = nodes[1] + (0.0 if move.upstream else move.nodes if first else past.nodes)
        last, before = past.content
        source = c1 * advected(last, nodes[0]) - c2 * advected(before, back)
        # 1. the bodies, by second order backwards twice
        inertia = 0.0
        free = 0.0
        if move.mass > 0.0:
            h1, h2 = past.approach
            v1, v2 = past.rate
            inertia = move.mass * (c0 / move.step) ** 2
            free = (c1 * h1 - c2 * h2) / c0 + (c1 * v1 - c2 * v2) * move.step / c0**2
        self.state.time_step = TimeStep(
            rate=c0 / move.step,
            couette=move.speed if move.upstream else 0.0,
            load=move.load,
            inertia=inertia,
            free=free,
        )
        # 2. gap and source of the step
        level = self.level
        level.gap = self.smooth + move.feature_gap
        level.s = level.gap
        level.f = -source / move.step
        self._open_edge(past, move)
        # 3. first guess from the last two steps
        if self.predicts and not first:
            p1, p2 = past.pressure
            level.P = np.where(p1 > 0.0, np.maximum(p1 + ratio * (p1 - p2), 0.0), 0.0)
            if move.mass > 0.0:
                self.state.approach = past.approach[0] + move.step * past.rate[0]
        level.load = move.load - self.state.exterior
        update_film(self.state, len(self.state.levels) - 1)

    def _open_edge(self, past: Past, move: StepConditions) -> None:
        """Far field of an open box at the speed of the step, with the squeeze of the last one."""
        if not self.fields:
            return
        field = self.fields[move.speed >= 0.0]
        contact = self.state.contact
        self.state.far_field = transient_far_field(field, contact, abs(move.speed), past.rate[0])

    def _cycles(self, move: StepConditions) -> StepReport | None:
        """Cycle until the step is solved; None where the cycles diverge."""
        least, most = self.cycles
        for count in range(1, most + 1):
            cycle(self.state, len(self.state.levels) - 1)
            report = self._report(count)
            highest = self.level.P.max()
            if report is None or not highest <= PRESSURE_LIMIT:
                return None
            done = report.residual < self.tolerance * self.scale
            if count >= least and done and abs(report.load_error) < LOAD_TOLERANCE:
                break
        return report

    def _report(self, count: int) -> StepReport | None:
        state = self.state
        level = self.level
        assert state.time_step is not None
        residual = self._residual()
        wet = level.P > 0.0
        residual = np.where(wet | (residual < 0.0), residual, 0.0)
        fraction = self.film / np.maximum(level.H, self.film)
        size = float((np.abs(residual) * fraction).sum()) / max(int(wet.sum()), 1)
        if not np.isfinite(size):
            return None
        step = state.time_step
        excess = load_error(state, len(state.levels) - 1)
        excess -= step.inertia * (state.approach - step.free) / state.contact.load
        return StepReport(
            cycles=count,
            residual=size / step.rate,
            load_error=excess,
            balance=level.grid.integral(residual) / step.rate,
        )

    def _residual(self) -> Array:
        """f - L(P) of all nodes, zero on the edge, shape (ny, nx) [-]."""
        level = self.level
        flow(self.state, level)
        residual = level.f - reynolds_operator(level)
        residual[:, 0] = residual[:, -1] = residual[-1] = 0.0
        if not level.grid.symmetric:
            residual[0] = 0.0
        return residual

    def _ended(self, past: Past, move: StepConditions) -> Past:
        """The step as the past of the next one."""
        assert self.state.time_step is not None
        level = self.level
        step = self.state.time_step
        residual = self._residual()
        full = self.density_and_film()[1]
        content = full - residual / step.rate
        if move.upstream:
            content = full
        approach = self.state.approach
        c0, c1, c2 = weights(1.0 if past.step == 0.0 else move.step / past.step)
        h1, h2 = past.approach
        rate = (c0 * approach - c1 * h1 + c2 * h2) / move.step
        return Past(
            content=(content, past.content[0]),
            pressure=(level.P.copy(), past.pressure[0]),
            approach=(approach, h1),
            rate=(rate, past.rate[0]),
            step=move.step,
            nodes=move.nodes,
        )


class Diverged(Exception):  # noqa: N818
    """A step that no damping leads through."""


def far_fields_by_direction(contact: ScaledContact) -> dict[bool, FarField]:
    """Solve the far field of an entrainment forwards (True) and backwards (False).

    Parameters
    ----------
    contact : ScaledContact
        scaled contact

    Returns
    -------
    dict[bool, FarField]
        far field by direction [-]
    """
    back = replace(contact, velocity_x=-contact.velocity_x, velocity_y=-contact.velocity_y)
    return {True: far_field(contact), False: far_field(back)}
