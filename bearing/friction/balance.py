"""Balls whose friction balances itself: force along the orbit and moments about the centre, at
given contact loads.

The unknowns of a ball are its orbit speed and the three components of its rotation, all contacts'
sliding is linear in them, and the balance is the minimum of the friction power plus that of the
gyroscopic couple (`contact_friction`): one convex problem a ball, solved for all balls together by
Newton's method. The loads and contact angles are those of the quasi-static solution. A ball
without load at the inner race rolls on the outer one with the cage, and what this costs the other
balls push into the cage.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..contacts.contacts import BearingContact
from ..contacts.motion import (
    BallMotion,
    MotionMap,
    ball_speeds,
    groove_curvature_radius,
    motion_map,
)
from ..geometry import Array
from ..quasistatic.kinematics import ball_mass
from ..quasistatic.solution import QuasistaticSolution
from .ellipse import TINY
from .newton import BALANCE_TOLERANCE, ContactLaw, MotionProblem, contacts_of, settle
from .resistance import FREE, Resistance

# sliding over entrainment from which a ball is taken along by the cage instead of driven [-]
SKID = 0.3
SKID_ROUNDS = 4  # of taking balls out
CAGE_STEPS = 20  # rounds of its push
CAGE_TARGET = 1.0e-8  # change to stop at
CAGE_TOLERANCE = 1.0e-6  # to accept [-]
# change of the push that is asked for with the push taken up to which secants go [-]
STEEPEST = 0.5
# orbit, rotation about e_x and e_r: all that the line law knows
PLANE = np.array([True, True, True, False])


@dataclass(frozen=True, slots=True, kw_only=True)
class BalancedFriction:
    """Friction of all contacts, inner race then outer, ball by ball; arrays of shape (balls, 2)
    unless said.

    Attributes
    ----------
    motions : tuple of BallMotion
        Of each ball, speeds in [rad/s].
    kinematics : ndarray, shape (balls, 2, 4)
        S_x, S_y [m/s], spin and rolling speed [rad/s] of ball against race.
    forces : ndarray, shape (balls, 2, 4)
        F_x, F_y [N], spin moment and curvature moment [N m] on the ball.
    ball_rolling : ndarray
        Part of the rolling speed from the ball's own rotation [rad/s].
    power : ndarray
        Friction power [W].
    shaft_power : float
        Power that the two rings feed in, moments on them times their speeds [W].
    resisted : float
        Power that the balls give to the oil around them and to the cage's guidance [W].
    residual : float
        Largest force or moment (over the ball's radius) left on a ball, over the friction mu Q
        [-].
    cage_change : float
        Push of the cage at the motion found less the push it was found with, over the push [-].
    driven : ndarray of bool, shape (balls,)
        Balls that the inner race drives; the others go with the cage.
    unknowns, cage : ndarray, shape (balls, 4) and (balls,)
        Change of the motion, scaled to speeds [m/s], from where another search may begin, and push
        of the cage [N].
    converged : bool
    """

    motions: tuple[BallMotion, ...]
    kinematics: Array
    forces: Array
    ball_rolling: Array
    power: Array
    shaft_power: float
    resisted: float
    residual: float
    cage_change: float
    driven: NDArray[np.bool_]
    unknowns: Array
    cage: Array
    converged: bool

    @property
    def energy_error(self) -> float:
        """Shaft power less friction power and what drag and cage take, over these [-]."""
        total = float(self.power.sum()) + self.resisted
        return (self.shaft_power - total) / total if total > 0.0 else 0.0


def curvature_slip(
    solution: QuasistaticSolution, contacts: Sequence[BearingContact], motion: Array | None = None
) -> Array:
    """Largest sliding by the curvature of each contact, w a^2/(2 R) [m/s], at the motion of the
    solution (N, 4).
    """
    if motion is None:
        motion = motion_map(solution, contacts).motion(*ball_speeds(solution))
    rolling = np.abs(motion[:, 3])
    radius = np.array(
        [groove_curvature_radius(solution.bearing, contact.race) for contact in contacts]
    )
    semi_axis = np.array(
        [0.0 if contact.hertz is None else contact.hertz.semi_axis_y for contact in contacts]
    )
    return np.asarray(np.maximum(rolling * semi_axis**2 / (2.0 * radius), TINY))


def balance_driven_balls(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    law: ContactLaw,
    resistance: Resistance = FREE,
) -> BalancedFriction:
    """As `balance_balls`, with balls that would skid given to the cage.

    Where the oil's resistance asks more traction than a light contact has, the ball would slide at
    speeds for which its film was not solved; beyond `SKID` of the entrainment it counts as one
    that the inner race does not drive. So do those that the equilibrium found to be carried. SI.
    """
    driven = (solution.inner_load > 0.0) & ~solution.carried
    found = balance_balls(solution, contacts, law, driven=driven, resistance=resistance)
    for _ in range(SKID_ROUNDS):
        skidding = driven & (sliding_ratio(found, contacts) > SKID)
        if not skidding.any():
            break
        driven = driven & ~skidding
        found = balance_balls(solution, contacts, law, driven=driven, resistance=resistance)
    return found


def sliding_ratio(found: BalancedFriction, contacts: Sequence[BearingContact]) -> Array:
    """Larger sliding over entrainment of the two contacts of each ball, shape (balls,) [-]."""
    speed = np.array(
        [np.inf if c.conditions is None else c.conditions.entrainment_speed for c in contacts]
    )
    slide = np.hypot(found.kinematics[..., 0], found.kinematics[..., 1]) / speed.reshape(-1, 2)
    return np.asarray(slide.max(axis=1))


def balance_balls(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    law: ContactLaw,
    *,
    gyroscopic: bool = True,
    driven: NDArray[np.bool_] | None = None,
    near: BalancedFriction | None = None,
    resistance: Resistance = FREE,
) -> BalancedFriction:
    """Motion of all balls in which a law of friction balances itself on each of them.

    Parameters
    ----------
    solution : QuasistaticSolution
    contacts : sequence of BearingContact
        All of its contacts, inner then outer, ball by ball.
    law : ContactLaw
    gyroscopic : bool
        Whether the contacts have to hold the gyroscopic couple.
    driven : ndarray of bool, shape (balls,), optional
        Balls that the inner race drives, the others going with the cage; None: those with load
        there.
    near : BalancedFriction, optional
        Of a law nearby with the same balls driven, from where the search begins.
    resistance : Resistance, optional
        Drag of the oil around the balls and of the cage's guidance.

    Returns
    -------
    BalancedFriction
        Speeds in [rad/s], forces in [N].
    """
    loaded = solution.inner_load > 0.0
    move = motion_map(solution, contacts)
    problem = _problem(
        solution, contacts, law, (loaded if driven is None else driven & loaded, move)
    )
    problem = replace(problem, drag=resistance.drag(_speeds(solution)))
    turned = gyroscopic and not law.plane
    if turned:
        problem = replace(problem, couple=_couple(solution, problem.driven))
    z = np.zeros(problem.couple.shape) if near is None else near.unknowns
    if turned:
        problem = replace(problem, turning=_turning(solution, problem.driven))
    return _result(solution, move, _with_push(solution, problem, z, resistance), resistance)


def _with_push(
    solution: QuasistaticSolution, problem: MotionProblem, start: Array, resistance: Resistance
) -> tuple[MotionProblem, Array, Array, float]:
    """The problem with the push of the cage, z, the residual of each ball and the change of the
    push, all that it is.

    Balls that the inner race does not drive go with the cage, at a speed that follows from the
    others' balance under the push; the push that they then ask for is compared with the one taken,
    and found by secants.
    """
    z = _with_the_cage(solution, problem.driven, start)
    problem = replace(problem, cage=_cage_force(solution, problem, z, resistance))
    before: tuple[Array, Array] | None = None  # push taken and asked for, of the round before [N]
    for _ in range(CAGE_STEPS):
        z, residual = settle(problem, z)
        z = _with_the_cage(solution, problem.driven, z)
        taken = problem.cage
        asked = _cage_force(solution, problem, z, resistance)
        largest = float(max(np.abs(asked).max(), np.abs(taken).max()))
        change = float(np.abs(asked - taken).max()) / largest if largest > 0.0 else 0.0
        if change <= CAGE_TARGET or (
            before is not None and not residual.max() <= BALANCE_TOLERANCE
        ):
            break
        problem = replace(problem, cage=_next_push(taken, asked, before))
        before = taken, asked
    return replace(problem, cage=taken), z, residual, change


def _next_push(taken: Array, asked: Array, before: tuple[Array, Array] | None) -> Array:
    """The push [N] at which a line through two rounds asks for what is taken; what is asked for
    where it is steep.
    """
    if before is None:
        return asked
    at = int(np.abs(taken).argmax())  # pushes of all rounds are in one proportion, by the loads
    step = float(taken[at] - before[0][at])
    slope = float(asked[at] - before[1][at]) / step if step != 0.0 else np.inf
    return asked + slope / (1.0 - slope) * (asked - taken) if abs(slope) < STEEPEST else asked


def _problem(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    law: ContactLaw,
    moved: tuple[NDArray[np.bool_], MotionMap],
) -> MotionProblem:
    driven, move = moved
    bearing = solution.bearing
    balls = solution.azimuth.size
    scales = np.array([2.0 / bearing.pitch_diameter, *(3 * (2.0 / bearing.ball_diameter,))])
    start = move.motion(*ball_speeds(solution))
    slopes = np.concatenate([-move.by_ring[:, :, None], move.by_rotation], axis=2) * scales
    free = np.tile(PLANE, (balls, 1)) if law.plane else np.ones((balls, 4), dtype=np.bool_)
    free &= driven[:, None]
    shape = (balls, 2)
    return MotionProblem(
        law=law,
        start=start.reshape(*shape, 4),
        map=slopes.reshape(*shape, 4, 4),
        couple=np.zeros((balls, 4)),
        turning=np.zeros((balls, 4, 4)),
        cage=np.zeros(balls),
        drag=np.zeros(balls),
        free=free,
        reach=curvature_slip(solution, contacts, start).reshape(shape).max(axis=1),
        strength=law.strength.reshape(shape).max(axis=1),
        driven=driven,
        ring=move.ring.reshape(*shape, 4),
    )


def _inertia(solution: QuasistaticSolution, driven: NDArray[np.bool_]) -> Array:
    """2 J w_m/D, shape (balls,) [N s]; none of balls that the inner race does not hold."""
    bearing = solution.bearing
    inertia = (
        0.1
        * ball_mass(bearing.ball_diameter, bearing.ball_material.density)
        * bearing.ball_diameter**2
    )
    found = inertia * solution.orbit_speed * 2.0 / bearing.ball_diameter
    return np.where(driven, found, 0.0)


def _couple(solution: QuasistaticSolution, driven: NDArray[np.bool_]) -> Array:
    """Gyroscopic couple J w_m e_x x w = J w_m (w_r e_t - w_t e_r) at the start, by the scaled
    unknowns [N].
    """
    scale = _inertia(solution, driven)
    found = np.zeros((solution.azimuth.size, 4))
    found[:, 3] = scale * solution.spin_speed * np.sin(solution.attitude)
    found[:, 2] = -scale * solution.pivot_speed
    return found


def _turning(solution: QuasistaticSolution, driven: NDArray[np.bool_]) -> Array:
    """Change of the gyroscopic couple with the scaled unknowns [N s/m]; skew, hence without power."""
    scale = _inertia(solution, driven) * 2.0 / solution.bearing.ball_diameter
    found = np.zeros((driven.size, 4, 4))
    found[:, 3, 2], found[:, 2, 3] = scale, -scale
    return found


def _speeds(solution: QuasistaticSolution) -> Array:
    """Of the balls' centres along the orbit [m/s]."""
    return solution.orbit_speed * 0.5 * solution.bearing.pitch_diameter


def resisted_power(solution: QuasistaticSolution, resistance: Resistance) -> float:
    """Power that the balls give to the oil around them and to the cage at the motion of an
    equilibrium [W].
    """
    speed = _speeds(solution)
    load = solution.inner_load
    power = float((resistance.drag(speed) * speed).sum())
    if load.any():
        power += resistance.cage_power(
            solution, _cage_speed(solution, load, np.zeros((load.size, 4)))
        )
    return power


def _cage_force(
    solution: QuasistaticSolution, problem: MotionProblem, z: Array, resistance: Resistance
) -> Array:
    """Push into the cage by the balls that the inner race drives, shared by their load [N].

    What the other balls cost, and the drag of the cage's guidance.
    """
    driving = problem.driven
    load = np.where(driving, solution.inner_load, 0.0)
    speed = _speeds(solution) + z[:, 0]
    pushing = float((load * speed).sum())
    if pushing == 0.0:
        return np.zeros(driving.size)
    wanted = resistance.cage_power(solution, _cage_speed(solution, load, z))
    others = np.flatnonzero(~driving)
    if others.size:
        k = problem.start[others] + np.einsum("bckj,bj->bck", problem.map[others], z[others])
        found = problem.law.dissipation(k.reshape(-1, 4), contacts_of(others))
        # less what a ring pays [W]
        heat = float((found.gradient.reshape(k.shape) * (k - problem.ring[others])).sum())
        wanted += heat + float((problem.drag * speed)[others].sum())
    return load * wanted / max(abs(pushing), TINY) * np.sign(pushing)


def _cage_speed(solution: QuasistaticSolution, load: Array, z: Array) -> float:
    """Mean orbit speed of the balls that drive the cage, by load [rad/s]."""
    return float(
        (load * (solution.orbit_speed + z[:, 0] * 2.0 / solution.bearing.pitch_diameter)).sum()
        / load.sum()
    )


def _with_the_cage(solution: QuasistaticSolution, driving: NDArray[np.bool_], z: Array) -> Array:
    """The unknowns [m/s] with balls that the inner race does not drive at the mean orbit speed of
    those that do.
    """
    load = solution.inner_load
    if driving.all() or not driving.any():
        return z
    bearing = solution.bearing
    outer = solution.operation.outer_speed
    radius = 0.5 * bearing.pitch_diameter
    mean = _cage_speed(solution, np.where(driving, load, 0.0), z)
    moved = z.copy()
    rotation = ball_speeds(solution)[1]
    for i in np.flatnonzero(~driving):
        own = float(solution.orbit_speed[i])
        # rolling goes with the orbit
        faster = (mean - outer) / (own - outer) - 1.0 if own != outer else 0.0
        moved[i, 0] = radius * (mean - own)
        moved[i, 1:] = 0.5 * bearing.ball_diameter * faster * rotation[i]
    return moved


def _shifted(solution: QuasistaticSolution, z: Array) -> tuple[Array, Array]:
    """Speeds of the balls as `ball_speeds` has them [rad/s] at the scaled unknowns [m/s]."""
    (orbit, rotation), bearing = ball_speeds(solution), solution.bearing
    return orbit + z[:, 0] * 2.0 / bearing.pitch_diameter, rotation + z[
        :, 1:
    ] * 2.0 / bearing.ball_diameter


def _result(
    solution: QuasistaticSolution,
    move: MotionMap,
    settled: tuple[MotionProblem, Array, Array, float],
    resistance: Resistance,
) -> BalancedFriction:
    problem, z, residual, change = settled
    shape = problem.start.shape[:2]
    k = problem.start + np.einsum("bckj,bj->bck", problem.map, z)
    found = problem.law.dissipation(k.reshape(-1, 4), contacts_of(np.arange(shape[0])))
    forces = -found.gradient.reshape(*shape, 4)
    power = -np.einsum("bck,bck->bc", forces, k)
    orbit, rotation = _shifted(solution, z)
    ball_rolling = np.einsum("cj,cj->c", move.by_rotation[:, 3], rotation[move.ball])
    loaded = problem.strength > 0.0
    worst = float(residual[loaded].max(initial=0.0))
    load = np.where(problem.driven, solution.inner_load, 0.0)
    resisted = float((problem.drag * (_speeds(solution) + z[:, 0])).sum())
    if load.any():
        resisted += resistance.cage_power(solution, _cage_speed(solution, load, z))
    return BalancedFriction(
        motions=tuple(
            BallMotion(orbit_speed=float(speed), rotation=turn)
            for speed, turn in zip(orbit, rotation, strict=True)
        ),
        kinematics=k,
        forces=forces,
        ball_rolling=ball_rolling.reshape(shape),
        power=power,
        shaft_power=-float(np.einsum("bck,bck->", forces, problem.ring)),
        resisted=resisted,
        residual=worst,
        cage_change=change,
        driven=problem.driven,
        unknowns=z,
        cage=problem.cage,
        converged=bool(
            solution.converged
            and problem.driven.any()
            and worst <= BALANCE_TOLERANCE
            and change <= CAGE_TOLERANCE
        ),
    )


def ring_power(solution: QuasistaticSolution, contact: BearingContact, force: Array) -> float:
    """Power that a contact's ring feeds into it [W], from the forces (4,) on the ball."""
    return -float(np.sum(force * motion_map(solution, [contact]).ring))
