"""Traction equilibrium: speeds and attitude of every ball from the friction of the races instead
of a hypothesis.

Two balances are solved in turn until neither changes: ring and balls under the loads, the balls'
motion and the friction on them prescribed (`solve_with_prescribed_balls`); and on each ball the
force along the orbit and the three moments, at given contact loads and angles (`balance`). Each
passes the other, ball by ball, the centrifugal force and the friction at both races across and at
the inner race along the orbit; Anderson's mixing (1965) accelerates this. Friction is a few
hundredths of the loads, hence each round changes them by a few hundredths of the round before.

A ball that the inner race does not drive is driven by the cage: it rolls on the outer race about
an axis parallel to the bearing's, without friction across.
"""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace

import numpy as np
from numpy.typing import NDArray

from oilfilm.ehl.arrays import Array

from ..contacts.contact import BearingContact
from ..contacts.contacts import contact_conditions
from ..contacts.motion import contact_frames
from ..geometry import SINGLE, Bearing, Row
from ..operation import HYPOTHESES, BallKinematics, Operation, QuasistaticModel
from ..quasistatic.kinematics import PrescribedBalls, ball_mass
from ..quasistatic.solution import QuasistaticSolution
from ..quasistatic.solver import solve_quasistatic, solve_with_prescribed_balls
from .balance import (
    SKID_RATIO,
    BalancedFriction,
    balance_balls,
    balance_driven_balls,
    sliding_ratio,
)
from .contact_friction import BallTraction, ContactFriction, FrictionSource
from .newton import BALANCE_TOLERANCE

# Half and double of `MAX_ROUNDS` and `MEMORY` change loads and speeds of eight random bearings
# under four constants by 1e-11 at most. A hundredth of `TARGET` takes a round more, an eighth of
# the time of a torque point from tables, and changes loads of ten load cases of the 6208 by 5e-11
# of the largest and speeds by 1.2e-9 at most, most of them by less than 1e-11.
# change of the forces in a round over the largest load at which iterating stops [-]
TARGET = 1.0e-9
TOLERANCE = 1.0e-8  # change that is accepted [-]
MAX_ROUNDS = 60
MEMORY = 4  # rounds that Anderson's mixing looks back
FILM_ROUNDS = 4  # of solving films again at the last loads
FILM_TOLERANCE = 1.0e-3  # change of a load over the largest from which films are solved anew [-]


@dataclass(frozen=True, slots=True)
class _State:
    """An equilibrium under prescribed motion and friction of the balls, and their balance."""

    solution: QuasistaticSolution
    balances: tuple[BalancedFriction, ...]  # row by row
    contacts: tuple[tuple[BearingContact, ...], ...]  # row by row
    cage_driven: NDArray[np.bool_]  # (N,) loaded at the inner race, which cannot drive them
    prescribed: PrescribedBalls
    balanced: PrescribedBalls  # motion and friction that the balance of the balls gives there
    change: float  # of the forces from prescribed to balanced, over the largest load [-]

    @property
    def is_balanced(self) -> bool:
        """Both balances were found."""
        return self.solution.converged and all(balance.converged for balance in self.balances)


def solve_traction_equilibrium(
    bearing: Bearing,
    operation: Operation,
    model: QuasistaticModel | None,
    traction: BallTraction,
    initial_guess: QuasistaticSolution | None = None,
    rows: Sequence[Row] = SINGLE,
) -> QuasistaticSolution:
    """Equilibrium of ring and balls with the friction of the races in balance on every ball.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    operation : Operation
        speeds and loads, SI
    model : QuasistaticModel | None
        assumptions; the ball kinematics is traction equilibrium
    traction : BallTraction
        friction of balls on races, and what holds the balls back
    initial_guess : QuasistaticSolution | None, optional
        equilibrium nearby
    rows : Sequence[Row], default SINGLE
        rows of balls on the inner ring

    Returns
    -------
    QuasistaticSolution
        `converged` is False, with a `message`, where one of the balances was not found
    """
    model = replace(
        model or QuasistaticModel(), ball_kinematics=BallKinematics.TRACTION_EQUILIBRIUM
    )
    start = _hypothesis(bearing, operation, model, initial_guess, rows)
    if not start.converged:
        message = f"traction equilibrium: no equilibrium to start from; {start.message}"
        return replace(start, model=model, message=message)
    if operation.shaft_speed == 0.0:
        message = f"{start.message}; the rings turn as one, no friction to balance"
        return replace(start, model=model, message=message)
    return _solved(replace(start, model=model), traction)


def _solved(start: QuasistaticSolution, traction: BallTraction) -> QuasistaticSolution:
    """Equilibria with the friction prepared at the last one, until the loads stay constant."""
    known = {field.name: getattr(start, field.name) for field in fields(PrescribedBalls)}
    prescribed = PrescribedBalls(**known)
    for films in range(1, FILM_ROUNDS + 1):
        # 1. friction ready near the last equilibrium: films are solved
        ready = [traction.source.refresh(contacts) for contacts in _contacts(start, traction)]
        failed = "; ".join(refreshed.message for refreshed in ready if refreshed.message)
        if failed:
            return replace(start, converged=False, message=f"no traction equilibrium: {failed}")
        laws = [refreshed.law for refreshed in ready]
        # 2. both balances in turn with these laws
        state = _iterate(start, prescribed, traction, laws)
        start = state.solution
        prescribed = state.balanced
        message = _failure_message(state)
        if message:
            break
        # 3. done if the loads are those that the laws were prepared for
        change = max(law.load_change(row) for law, row in zip(laws, state.contacts, strict=True))
        if change <= FILM_TOLERANCE:
            cage_driven = state.cage_driven & (start.inner_load > 0.0)
            return replace(start, message=_success_message(state), cage_driven=cage_driven)
        message = (
            f"films solved {films} times, and a load still changes by {change:.1e} of the largest"
        )
    return replace(start, converged=False, message=f"no traction equilibrium found: {message}")


def _hypothesis(
    bearing: Bearing,
    operation: Operation,
    model: QuasistaticModel,
    initial_guess: QuasistaticSolution | None,
    rows: Sequence[Row],
) -> QuasistaticSolution:
    """Equilibrium under the first hypothesis that has one; the last one tried if none has."""
    # half and half, the last one, first
    for kinematics in (HYPOTHESES[-1], *HYPOTHESES[:-1]):
        assumed = replace(model, ball_kinematics=kinematics)
        solution = solve_quasistatic(bearing, operation, assumed, initial_guess, rows)
        if solution.converged:
            break
    return solution


def _contacts(
    solution: QuasistaticSolution, traction: BallTraction
) -> list[tuple[BearingContact, ...]]:
    """Contacts of each row, counted by themselves."""
    rows = [solution.row(i) for i in range(len(solution.rows))]
    return [contact_conditions(row, traction.lubricant) for row in rows]


def _iterate(
    start: QuasistaticSolution,
    prescribed: PrescribedBalls,
    traction: BallTraction,
    laws: Sequence[FrictionSource],
) -> _State:
    """Rounds of both balances from a motion; the last state."""
    mixing = _Anderson()
    state = None
    weight = _orbit_weight(start)
    for _ in range(MAX_ROUNDS):
        state = _round(start, prescribed, traction, laws, state)
        if not state.is_balanced:
            break
        # friction may turn within slides far smaller: the motion is that of the balance
        if state.change <= TARGET:
            last = solve_with_prescribed_balls(
                start.bearing, start.operation, start.model, state.solution, state.balanced
            )
            return replace(state, solution=last)
        mixed = mixing.next(_vector(state.prescribed, weight), _vector(state.balanced, weight))
        start = state.solution
        prescribed = _with_vector(state.balanced, mixed, weight)
    assert state is not None  # there is a round at least
    return state


def _success_message(state: _State) -> str:
    text = f"converged in traction equilibrium, forces to {state.change:.0e} of the largest load"
    balls = ", ".join(str(ball + 1) for ball in np.flatnonzero(state.cage_driven))
    if not balls:
        return text
    return f"{text}; balls {balls} are driven by the cage, their inner contacts cannot drive them"


def _failure_message(state: _State) -> str:
    """Reason why a state is no equilibrium; empty if it is one."""
    if not state.solution.converged:
        return state.solution.message
    if not state.is_balanced:
        if not any(balance.driven.any() for balance in state.balances):
            return "the inner race drives no ball"
        worst = max(balance.residual for balance in state.balances)
        pushed = max(balance.cage_change for balance in state.balances)
        if worst <= BALANCE_TOLERANCE:
            left = f"the push of the cage still changes by {pushed:.1e} of it"
            return f"balls and cage find no common speed ({left})"
        left = f"force left {worst:.1e} of the friction that counts as large"
        return f"friction cannot balance a ball ({left})"
    if state.change > TOLERANCE:
        change = f"{state.change:.1e} of the largest load"
        return f"forces still change by {change} after {MAX_ROUNDS} rounds"
    return ""


def _round(
    start: QuasistaticSolution,
    prescribed: PrescribedBalls,
    traction: BallTraction,
    laws: Sequence[FrictionSource],
    before: _State | None,
) -> _State:
    """Ring and balls under prescribed motion and friction, then the balance of friction on the
    balls.
    """
    solution = solve_with_prescribed_balls(
        start.bearing, start.operation, start.model, start, prescribed
    )
    cage_driven = (
        np.zeros(solution.azimuth.size, dtype=np.bool_) if before is None else before.cage_driven
    )
    if not solution.converged:
        return _State(solution, (), (), cage_driven, prescribed, prescribed, np.inf)
    cage_driven = cage_driven.copy()
    lubricated = _contacts(solution, traction)
    balances: list[BalancedFriction] = []
    balanced: list[PrescribedBalls] = []
    for i, contacts in enumerate(lubricated):
        row = solution.row(i)
        part = slice(i * solution.bearing.balls, (i + 1) * solution.bearing.balls)
        known = None if before is None else cage_driven[part]
        balance = _balance(row, contacts, laws[i].at(row, contacts), traction, known)
        undriven = ~balance.driven | (sliding_ratio(balance, contacts) > SKID_RATIO)
        cage_driven[part] |= (row.inner_load > 0.0) & undriven
        balances.append(balance)
        balanced.append(_from_balance(row, contacts, balance))
    names = [field.name for field in fields(PrescribedBalls)]
    joined = PrescribedBalls(
        **{name: np.concatenate([getattr(part, name) for part in balanced]) for name in names}
    )
    weight = _orbit_weight(solution)
    largest = max(solution.inner_load.max(), solution.outer_load.max())
    step = np.abs(_vector(joined, weight) - _vector(prescribed, weight)).max()
    change = float(step / largest)
    parts = tuple(balances), tuple(lubricated)
    return _State(solution, *parts, cage_driven, prescribed, joined, change)


def _balance(
    row: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    law: ContactFriction,
    traction: BallTraction,
    cage_driven: NDArray[np.bool_] | None,
) -> BalancedFriction:
    """Balance of the balls of a row, without those driven by the cage; None: not yet known."""
    if cage_driven is None:
        return balance_driven_balls(row, contacts, law, traction.resistance)
    driven = (row.inner_load > 0.0) & ~cage_driven
    return balance_balls(row, contacts, law, driven=driven, resistance=traction.resistance)


def _from_balance(
    row: QuasistaticSolution, contacts: Sequence[BearingContact], balance: BalancedFriction
) -> PrescribedBalls:
    """Motion [rad/s] and friction [N] of a row by the balance of its balls."""
    axes = contact_frames(contacts).reshape(-1, 2, 3, 3)
    along, across = balance.forces[:, :, 0], balance.forces[:, :, 1]
    inner, outer = row.inner_contact_angle, row.outer_contact_angle
    orbit = np.array([motion.orbit_speed for motion in balance.motions])
    turn = np.array([motion.rotation for motion in balance.motions])
    sign = np.sign(row.operation.inner_speed - row.operation.outer_speed)
    gamma = row.bearing.ball_diameter / row.bearing.pitch_diameter
    speeds = orbit - row.operation.outer_speed
    # on the outer race, parallel to x
    rolling = speeds * (1.0 + gamma * np.cos(outer)) / (gamma * np.cos(outer))
    driven = balance.driven
    towards_inner = axes[:, 0, 1, 0] * np.cos(inner) - axes[:, 0, 1, 1] * np.sin(inner)
    towards_outer = axes[:, 1, 1, 1] * np.sin(outer) - axes[:, 1, 1, 0] * np.cos(outer)
    return PrescribedBalls(
        orbit_speed=orbit,
        spin_speed=np.where(driven, sign * np.hypot(turn[:, 0], turn[:, 1]), rolling),
        pivot_speed=np.where(driven, turn[:, 2], 0.0),
        attitude=np.where(driven, np.arctan2(sign * turn[:, 1], -sign * turn[:, 0]), 0.0),
        inner_friction=np.where(driven, across[:, 0] * towards_inner, 0.0),
        outer_friction=np.where(driven, across[:, 1] * towards_outer, 0.0),
        inner_drive=-along[:, 0] * axes[:, 0, 0, 2],
    )


def _orbit_weight(solution: QuasistaticSolution) -> float:
    """Force that an orbit speed is worth, m d_m/2 times the fastest [N s/rad]."""
    bearing = solution.bearing
    mass = ball_mass(bearing.ball_diameter, bearing.ball_material.density)
    return float(0.5 * mass * bearing.pitch_diameter * np.abs(solution.orbit_speed).max())


def _vector(prescribed: PrescribedBalls, weight: float) -> Array:
    """Numbers that the two balances pass on, as forces, shape (4, N) [N]."""
    p = prescribed
    friction = [p.inner_friction, p.outer_friction, p.inner_drive]
    return np.stack([weight * p.orbit_speed, *friction])


def _with_vector(prescribed: PrescribedBalls, vector: Array, weight: float) -> PrescribedBalls:
    """The same with other forces [N]; orbit speeds follow from theirs."""
    orbit, inner, outer, drive = vector
    orbit = orbit / weight if weight > 0.0 else prescribed.orbit_speed
    friction = {"inner_friction": inner, "outer_friction": outer, "inner_drive": drive}
    return replace(prescribed, orbit_speed=orbit, **friction)


class _Anderson:
    """Anderson's mixing of a fixed point x = g(x), D. G. Anderson (1965): least squares over the
    last rounds.
    """

    def __init__(self) -> None:
        self.rounds: list[tuple[Array, Array]] = []

    def next(self, x: Array, g: Array) -> Array:
        """The next x [N] from one and what it leads to; plain g where a round got worse."""
        last = self.rounds[-1] if self.rounds else None
        if last is not None and np.linalg.norm(g - x) > np.linalg.norm(last[1] - last[0]):
            self.rounds.clear()
        self.rounds = [*self.rounds[-MEMORY:], (x, g)]
        if len(self.rounds) == 1:
            return g
        left = np.stack([(b - a).ravel() for a, b in self.rounds], axis=1)
        ends = np.stack([b.ravel() for _, b in self.rounds], axis=1)
        share = np.linalg.lstsq(np.diff(left, axis=1), left[:, -1], rcond=1e-8)[0]
        return np.asarray(ends[:, -1] - np.diff(ends, axis=1) @ share).reshape(x.shape)
