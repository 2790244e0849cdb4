"""Balls whose friction balances itself: force along the orbit and moments about the centre, at
given contact loads.

The unknowns of a ball are its orbit speed and the three components of its rotation, all contacts'
sliding is linear in them, and the balance is the minimum of the friction power plus that of the
gyroscopic couple (`coulomb`): one convex problem a ball, solved for all balls together by
Newton's method. The loads and contact angles are those of the quasi-static solution. A ball
without load at the inner race rolls on the outer one with the cage, and what this costs the other
balls push into the cage.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from oilfilm.ehl.arrays import Array, unique_rows

from ..contacts.contact import BearingContact
from ..contacts.motion import BallMotion, MotionMap, ball_speeds, motion_map
from ..contacts.shape import dry_contacts
from ..quasistatic.kinematics import ball_mass
from ..quasistatic.solution import QuasistaticSolution
from .cage import (
    CageBalance,
    balance_cage,
    ball_velocities,
    cage_driven_pocket_power,
    rubbing_speeds,
    with_land,
)
from .contact_friction import TINY, ContactFriction
from .newton import BALANCE_TOLERANCE, MotionProblem, contacts_of, pocket_power
from .resistance import NO_RESISTANCE, Resistance, ResistedPower

# sliding over entrainment from which a ball counts as driven by the cage [-]; of 160 balls of ten
# random bearings whose oil resists rolling the same 7 are with 0.15 and 0.6
SKID_RATIO = 0.3
SKID_ROUNDS = 4
CAGE_TOLERANCE = 1.0e-6


@dataclass(frozen=True, slots=True, kw_only=True)
class BalancedFriction:
    """Friction of all contacts, inner race then outer, ball by ball; arrays of shape (balls, 2)
    unless said.
    """

    motions: tuple[BallMotion, ...]  # of each ball, speeds in [rad/s]
    # (balls, 2, 4) S_x, S_y [m/s], spin and rolling speed [rad/s] of ball against race
    kinematics: Array
    forces: Array  # (balls, 2, 4) F_x, F_y [N], spin moment and curvature moment [N m] on the ball
    ball_rolling: Array  # part of the rolling speed from the ball's own rotation [rad/s]
    power: Array  # friction power [W]
    shaft_power: float  # power that the two rings feed in, moments on them times their speeds [W]
    resisted: ResistedPower  # beside the contacts [W]
    # largest force or moment (over the ball's radius) left on a ball, over the friction mu Q [-]
    residual: float
    # push of the cage that the motion requires less the one applied, over the push [-]
    cage_change: float
    # (balls,) balls that the inner race drives; the others are driven by the cage
    driven: NDArray[np.bool_]
    # (balls, 4) change of the motion, scaled to speeds [m/s], a guess for a similar law
    unknowns: Array
    cage: Array  # (balls,) push of the cage [N]
    converged: bool

    @property
    def energy_error(self) -> float:
        """Shaft power less friction power and what drag and cage take, over these [-]."""
        total = float(self.power.sum()) + self.resisted.of_balls
        return (self.shaft_power - total) / total if total > 0.0 else 0.0


def curvature_slip(
    solution: QuasistaticSolution, contacts: Sequence[BearingContact], motion: Array | None = None
) -> Array:
    """Largest sliding by the curvature of each contact, w a^2/(2 R).

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    contacts : Sequence[BearingContact]
        some of its contacts
    motion : Array | None, optional
        sliding along and across, spin and rolling of the contacts, shape (n, 4) [m/s], [rad/s];
        that of the equilibrium if left out

    Returns
    -------
    Array
        shape (n,) [m/s]
    """
    if motion is None:
        motion = motion_map(solution, contacts).motion(*ball_speeds(solution))
    rolling = np.abs(motion[:, 3])
    dry = dry_contacts(solution.bearing, contacts)
    semi_axis = np.where(dry.load > 0.0, dry.semi_axis_y, 0.0)
    return np.asarray(np.maximum(rolling * semi_axis**2 / (2.0 * dry.radius), TINY))


def balance_driven_balls(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    law: ContactFriction,
    resistance: Resistance = NO_RESISTANCE,
) -> BalancedFriction:
    """Motion of all balls in balance, as `balance_balls`, with balls that would skid driven by the
    cage.

    Where the oil's resistance asks more traction than a light contact has, the ball would slide at
    speeds for which its film was not solved; beyond `SKID_RATIO` of the entrainment the inner race
    counts as not driving it. So it does for balls that are cage-driven in the equilibrium, and for
    those whose inner contact has no film, being of negligible load.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    contacts : Sequence[BearingContact]
        all of its contacts, inner then outer, ball by ball
    law : ContactFriction
        friction of the contacts
    resistance : Resistance, default NO_RESISTANCE
        drag of the oil around the balls and of the cage's guidance

    Returns
    -------
    BalancedFriction
        motions, forces [N] and powers [W] of all contacts
    """
    driven = may_be_driven(solution, contacts)
    balance = balance_balls(solution, contacts, law, driven=driven, resistance=resistance)
    for _ in range(SKID_ROUNDS):
        skidding = driven & (sliding_ratio(balance, contacts) > SKID_RATIO)
        if not skidding.any():
            break
        driven = driven & ~skidding
        balance = balance_balls(solution, contacts, law, driven=driven, resistance=resistance)
    return balance


def may_be_driven(
    solution: QuasistaticSolution, contacts: Sequence[BearingContact]
) -> NDArray[np.bool_]:
    """Balls that the inner race drives unless they skid.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    contacts : Sequence[BearingContact]
        all of its contacts, inner then outer, ball by ball

    Returns
    -------
    NDArray[np.bool_]
        shape (balls,)
    """
    with_film = np.array([c.conditions is not None or c.dry for c in contacts])
    inner = with_film.reshape(-1, 2)[:, 0]
    return np.asarray((solution.inner_load > 0.0) & ~solution.cage_driven & inner)


def sliding_ratio(balance: BalancedFriction, contacts: Sequence[BearingContact]) -> Array:
    """Larger sliding over entrainment of the two contacts of each ball.

    Parameters
    ----------
    balance : BalancedFriction
        motion of the balls
    contacts : Sequence[BearingContact]
        all contacts, inner then outer, ball by ball

    Returns
    -------
    Array
        shape (balls,) [-]
    """
    speed = np.array(
        [np.inf if c.conditions is None else c.conditions.entrainment_speed for c in contacts]
    )
    slide = np.hypot(balance.kinematics[..., 0], balance.kinematics[..., 1]) / speed.reshape(-1, 2)
    return np.asarray(slide.max(axis=1))


def balance_balls(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    law: ContactFriction,
    *,
    gyroscopic: bool = True,
    driven: NDArray[np.bool_] | None = None,
    initial_guess: BalancedFriction | None = None,
    resistance: Resistance = NO_RESISTANCE,
) -> BalancedFriction:
    """Motion of all balls in which a law of friction balances itself on each of them.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing, SI
    contacts : Sequence[BearingContact]
        all of its contacts, inner then outer, ball by ball
    law : ContactFriction
        friction of the contacts
    gyroscopic : bool, default True
        whether the contacts have to hold the gyroscopic couple
    driven : NDArray[np.bool_] | None, optional
        balls that the inner race drives, the others being driven by the cage, shape (balls,);
        those with load there if left out
    initial_guess : BalancedFriction | None, optional
        balance of a similar law with the same balls driven
    resistance : Resistance, default NO_RESISTANCE
        drag of the oil around the balls and of the cage's guidance

    Returns
    -------
    BalancedFriction
        motions, forces [N] and powers [W] of all contacts
    """
    loaded = solution.inner_load > 0.0
    kinematics = motion_map(solution, contacts)
    race_driven = loaded if driven is None else driven & loaded
    problem = _problem(solution, contacts, law, race_driven, kinematics)
    problem = replace(problem, drag=resistance.drag(ball_velocities(solution)))
    if gyroscopic and not law.longitudinal_only:
        couple, matrix = _gyroscopic(solution, race_driven)
        problem = replace(problem, gyroscopic_couple=couple, gyroscopic_matrix=matrix)
    problem = _same_balls(problem, solution.inner_load)
    shape = problem.gyroscopic_couple.shape
    start = np.zeros(shape) if initial_guess is None else initial_guess.unknowns
    balance = balance_cage(solution, problem, start, resistance)
    return _result(solution, kinematics, balance, resistance)


def _problem(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    law: ContactFriction,
    driven: NDArray[np.bool_],
    kinematics: MotionMap,
) -> MotionProblem:
    bearing = solution.bearing
    balls = solution.azimuth.size
    scales = np.array([2.0 / bearing.pitch_diameter, *(3 * (2.0 / bearing.ball_diameter,))])
    start = kinematics.motion(*ball_speeds(solution))
    by_orbit = -kinematics.by_ring[:, :, None]
    slopes = np.concatenate([by_orbit, kinematics.by_rotation], axis=2) * scales
    free = np.ones((balls, 4), dtype=np.bool_)
    if law.longitudinal_only:
        free[:, 3] = False  # no rotation about the tangent of the orbit
    free &= driven[:, None]
    shape = (balls, 2)
    return MotionProblem(
        law=law,
        start=start.reshape(*shape, 4),
        slopes=slopes.reshape(*shape, 4, 4),
        gyroscopic_couple=np.zeros((balls, 4)),
        gyroscopic_matrix=np.zeros((balls, 4, 4)),
        cage_force=np.zeros(balls),
        drag=np.zeros((balls, 4)),
        pocket=np.zeros(balls),
        rubbing=rubbing_speeds(solution),
        free=free,
        reference_slip=curvature_slip(solution, contacts, start).reshape(shape).max(axis=1),
        reference_force=law.reference_force.reshape(shape).max(axis=1),
        driven=driven,
        ring_motion=kinematics.ring.reshape(*shape, 4),
        first=np.arange(balls),
        like=np.arange(balls),
    )


def _same_balls(problem: MotionProblem, load: Array) -> MotionProblem:
    """The problem with balls that are the same told; they push the cage by their loads at the
    inner race [N].
    """
    kinds = problem.law.kinds
    if kinds is None:
        return problem
    surface = np.abs(problem.ring_motion[..., 0]).max()
    turning = np.abs(problem.start[..., 3]).max()
    speeds = np.array([surface, surface, turning, turning]) + TINY
    arrays = (
        problem.start / speeds,
        problem.slopes / np.abs(problem.slopes).max(axis=(0, 1, 3), keepdims=True),
        *(
            values / (np.abs(values).max() + TINY)
            for values in (
                problem.gyroscopic_couple,
                problem.gyroscopic_matrix,
                problem.drag,
                problem.rubbing,
                problem.reference_slip,
                problem.reference_force,
                load,
            )
        ),
        problem.free,
        kinds / (np.abs(kinds).max(axis=0) + TINY),
    )
    rows = np.concatenate([np.reshape(values, (load.size, -1)) for values in arrays], axis=1)
    first, like = unique_rows(rows)
    return replace(problem, first=first, like=like)


def _gyroscopic(solution: QuasistaticSolution, driven: NDArray[np.bool_]) -> tuple[Array, Array]:
    """Gyroscopic couple J w_m e_x x w = J w_m (w_r e_t - w_t e_r) at the start by the scaled
    unknowns, (balls, 4) [N], and its change with them, (balls, 4, 4) [N s/m], which is skew, hence
    without power; none of balls that the inner race does not hold.
    """
    bearing = solution.bearing
    diameter = bearing.ball_diameter
    inertia = 0.1 * ball_mass(diameter, bearing.ball_material.density) * diameter**2
    scale = np.where(driven, inertia * solution.orbit_speed * 2.0 / diameter, 0.0)
    couple = np.zeros((driven.size, 4))
    couple[:, 3] = scale * solution.spin_speed * np.sin(solution.attitude)
    couple[:, 2] = -scale * solution.pivot_speed
    matrix = np.zeros((driven.size, 4, 4))
    matrix[:, 3, 2] = scale * 2.0 / diameter
    matrix[:, 2, 3] = -matrix[:, 3, 2]
    return couple, matrix


def _result(
    solution: QuasistaticSolution,
    kinematics: MotionMap,
    balance: CageBalance,
    resistance: Resistance,
) -> BalancedFriction:
    problem, z, residual, change = balance
    k = problem.start + np.einsum("bckj,bj->bck", problem.slopes, z)
    first = problem.first
    friction = problem.law.evaluate(k[first].reshape(-1, 4), contacts_of(first))
    forces = -friction.gradient.reshape(-1, 2, 4)[problem.like]
    power = -np.einsum("bck,bck->bc", forces, k)
    orbit, rotation = ball_speeds(solution)
    orbit = orbit + z[:, 0] * 2.0 / solution.bearing.pitch_diameter
    rotation = rotation + z[:, 1:] * 2.0 / solution.bearing.ball_diameter
    ball_rolling = np.einsum("cj,cj->c", kinematics.by_rotation[:, 3], rotation[kinematics.ball])
    loaded = problem.reference_force > 0.0
    worst = float(residual[loaded].max(initial=0.0))
    motions = zip(orbit.tolist(), rotation, strict=True)
    return BalancedFriction(
        motions=tuple(BallMotion(orbit_speed=speed, rotation=turn) for speed, turn in motions),
        kinematics=k,
        forces=forces,
        ball_rolling=ball_rolling.reshape(-1, 2),
        power=power,
        shaft_power=-float(np.einsum("bck,bck->", forces, problem.ring_motion)),
        resisted=_resisted(solution, problem, z, resistance),
        residual=worst,
        cage_change=change,
        driven=problem.driven,
        unknowns=z,
        cage=problem.cage_force,
        converged=bool(
            solution.converged
            and problem.driven.any()
            and worst <= BALANCE_TOLERANCE
            and change <= CAGE_TOLERANCE
        ),
    )


def _resisted(
    solution: QuasistaticSolution, problem: MotionProblem, z: Array, resistance: Resistance
) -> ResistedPower:
    """Beside the contacts at the unknowns z [m/s], in [W]."""
    load = np.where(problem.driven, solution.inner_load, 0.0)
    pocket = pocket_power(z, problem).sum()
    pocket += cage_driven_pocket_power(solution, problem, z, resistance).sum()
    drag = float((problem.drag * (ball_velocities(solution) + z)).sum())
    power = ResistedPower(drag=drag, pocket=float(pocket))
    return with_land(power, solution, resistance, z, load) if load.any() else power
