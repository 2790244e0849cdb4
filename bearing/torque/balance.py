"""Balls whose friction balances itself: force along the orbit and moments about the centre, at given contact loads.

The unknowns of a ball are its orbit speed and the three components of its rotation, all contacts' sliding is linear in
them, and the balance is the minimum of the friction power plus that of the gyroscopic couple (`contact_friction`):
one convex problem a ball, solved for all balls together by Newton's method. The loads and contact angles are those of
the quasi-static solution. A ball without load at the inner race rolls on the outer one with the cage, and what this
costs the other balls push into the cage.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..contacts import BearingContact
from ..geometry import Array, Race
from ..kinematics import ball_mass
from ..quasistatic import QuasistaticSolution
from ..traction_forces import BallMotion, ball_motion, bearing_kinematics
from .contact_friction import TINY, Dissipation

MAX_STEPS = 200
SKID = 0.3  # sliding over entrainment from which a ball is taken along by the cage instead of driven [-]
SKID_ROUNDS = 4  # of taking balls out
RUNAWAY = 1.0e4  # speeds over those of curvature slip at which a ball counts as not held [-]
CAGE_STEPS, CAGE_TOLERANCE = 20, 1.0e-8  # of push and speed of the cage, which hardly depend on the balance [-]
BALANCE_TOLERANCE = 1.0e-6  # residual force over mu Q that is accepted [-]
BALANCE_TARGET = 1.0e-10  # residual at which iterating stops [-]
PLANE = np.array([True, True, True, False])  # orbit, rotation about e_x and e_r: all that the line law knows


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactLaw:
    """Friction of the contacts of a bearing, numbered inner race then outer, ball by ball.

    Attributes
    ----------
    dissipation : callable
        Takes the motions (N, 4) of contacts [m/s], [rad/s] and their numbers (N,), gives a `Dissipation`.
    strength : ndarray, shape (contacts,)
        Friction of each contact that residual forces are measured against [N].
    plane : bool
        It knows no sliding across the rolling direction: balls then do not turn about the orbit's tangent, and no
        gyroscopic couple is held.
    potential : bool
        Whether the power is the potential of the forces; if not, only these are looked at.
    """

    dissipation: Callable[[Array, NDArray[np.int64]], Dissipation]
    strength: Array
    plane: bool = False
    potential: bool = True


@dataclass(frozen=True, slots=True, kw_only=True)
class BalancedFriction:
    """Friction of all contacts, inner race then outer, ball by ball; arrays of shape (balls, 2) unless said.

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
    residual : float
        Largest force or moment (over the ball's radius) left on a ball, over the friction mu Q [-].
    driven : ndarray of bool, shape (balls,)
        Balls that the inner race drives; the others go with the cage.
    unknowns, cage : ndarray, shape (balls, 4) and (balls,)
        Change of the motion, scaled to speeds [m/s], and push of the cage [N], from where another search may begin.
    converged : bool
    """

    motions: tuple[BallMotion, ...]
    kinematics: Array
    forces: Array
    ball_rolling: Array
    power: Array
    shaft_power: float
    residual: float
    driven: NDArray[np.bool_]
    unknowns: Array
    cage: Array
    converged: bool

    @property
    def energy_error(self) -> float:
        """Shaft power less friction power, over the latter [-]."""
        total = float(self.power.sum())
        return (self.shaft_power - total) / total if total > 0.0 else 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class _Problem:
    """k = start + map z for all contacts, z scaled to speeds [m/s]."""

    law: ContactLaw
    start: Array  # (balls, 2, 4)
    map: Array  # (balls, 2, 4, 4)
    couple: Array  # (balls, 4) gyroscopic one at the start [N]
    turning: Array  # (balls, 4, 4) its change with z [N s/m]
    cage: Array  # (balls,) push of the cage against the orbit of balls that drive it [N]
    free: NDArray[np.bool_]  # (balls, 4)
    reach: Array  # (balls,) largest sliding that the curvature of a ball's contacts makes [m/s]
    strength: Array  # (balls,) friction that the residual is measured against [N]
    driven: NDArray[np.bool_]  # (balls,) by the inner race
    ring: Array  # (balls, 2, 4) change of the motion by the rings' speeds [m/s], [rad/s]


def curvature_slip(solution: QuasistaticSolution, contacts: Sequence[BearingContact]) -> Array:
    """Largest sliding by the curvature of each contact, w a^2/(2 R) [m/s]."""
    found = np.full(len(contacts), TINY)
    for i, contact in enumerate(contacts):
        if contact.hertz is not None:
            k = bearing_kinematics(solution, contact)
            found[i] = max(abs(k.rolling) * contact.hertz.semi_axis_y**2 / (2.0 * k.curvature_radius), TINY)
    return found


def balance_driven_balls(
    solution: QuasistaticSolution, contacts: Sequence[BearingContact], law: ContactLaw
) -> BalancedFriction:
    """As `balance_balls`, with balls that would skid given to the cage.

    Where the oil's resistance asks more traction than a light contact has, the ball would slide at speeds for which its
    film was not solved; beyond `SKID` of the entrainment it counts as one that the inner race does not drive. SI.
    """
    speed = np.array([np.inf if c.conditions is None else c.conditions.entrainment_speed for c in contacts])
    driven = solution.inner_load > 0.0
    found = balance_balls(solution, contacts, law, driven=driven)
    for _ in range(SKID_ROUNDS):
        slide = np.hypot(found.kinematics[..., 0], found.kinematics[..., 1]) / speed.reshape(-1, 2)
        skidding = driven & (slide.max(axis=1) > SKID)
        if not skidding.any():
            break
        driven = driven & ~skidding
        found = balance_balls(solution, contacts, law, driven=driven)
    return found


def balance_balls(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    law: ContactLaw,
    *,
    gyroscopic: bool = True,
    driven: NDArray[np.bool_] | None = None,
    near: BalancedFriction | None = None,
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
        Balls that the inner race drives, the others going with the cage; None: those with load there.
    near : BalancedFriction, optional
        Of a law nearby with the same balls driven, from where the search begins.

    Returns
    -------
    BalancedFriction
        Speeds in [rad/s], forces in [N].
    """
    loaded = solution.inner_load > 0.0
    problem = _problem(solution, contacts, law, loaded if driven is None else driven & loaded)
    turned = gyroscopic and not law.plane
    if turned:
        problem = replace(problem, couple=_couple(solution, problem.driven))
    if near is None:
        z, residual = _minimise(problem, np.zeros(problem.couple.shape))
    else:
        z, problem = near.unknowns, replace(problem, cage=near.cage)
    turning = _turning(solution, problem.driven) if turned else problem.turning
    alone = not problem.driven.all()  # balls that go with the cage
    for _ in range(CAGE_STEPS if alone else 1):
        before, push = problem.cage, _cage_force(solution, problem, z)
        problem = replace(problem, turning=turning, cage=push)
        z, residual = _minimise(problem, _with_the_cage(solution, problem.driven, z))
        if np.abs(push - before).max() <= CAGE_TOLERANCE * np.abs(push).max() and push.any():
            break
    return _result(solution, contacts, problem, z, residual)


def _problem(
    solution: QuasistaticSolution, contacts: Sequence[BearingContact], law: ContactLaw, driven: NDArray[np.bool_]
) -> _Problem:
    bearing, balls = solution.bearing, solution.azimuth.size
    scales = np.array([2.0 / bearing.pitch_diameter, *(3 * (2.0 / bearing.ball_diameter,))])
    start, slopes = np.zeros((2 * balls, 4)), np.zeros((2 * balls, 4, 4))
    for i, contact in enumerate(contacts):
        motion = ball_motion(solution, contact.ball - 1)
        start[i] = _motion(solution, contact, motion)
        for j in range(4):
            slopes[i, :, j] = _motion(solution, contact, _moved(motion, j, scales[j])) - start[i]
    free = np.tile(PLANE, (balls, 1)) if law.plane else np.ones((balls, 4), dtype=np.bool_)
    free &= driven[:, None]
    shape = (balls, 2)
    return _Problem(
        law=law,
        start=start.reshape(*shape, 4),
        map=slopes.reshape(*shape, 4, 4),
        couple=np.zeros((balls, 4)),
        turning=np.zeros((balls, 4, 4)),
        cage=np.zeros(balls),
        free=free,
        reach=curvature_slip(solution, contacts).reshape(shape).max(axis=1),
        strength=law.strength.reshape(shape).max(axis=1),
        driven=driven,
        ring=np.array([_ring_motion(solution, contact) for contact in contacts]).reshape(*shape, 4),
    )


def _ring(solution: QuasistaticSolution, contact: BearingContact) -> float:
    """Speed of the contact's ring [rad/s]."""
    return solution.operation.inner_speed if contact.race is Race.INNER else solution.operation.outer_speed


def _moved(motion: BallMotion, index: int, step: float) -> BallMotion:
    """The motion with one of its four speeds changed [rad/s]."""
    if index == 0:
        return BallMotion(orbit_speed=motion.orbit_speed + step, rotation=motion.rotation)
    return BallMotion(orbit_speed=motion.orbit_speed, rotation=motion.rotation + step * np.eye(3)[index - 1])


def _motion(solution: QuasistaticSolution, contact: BearingContact, motion: BallMotion) -> Array:
    k = bearing_kinematics(solution, contact, motion)
    return np.array([k.sliding_x, k.sliding_y, k.spin, k.rolling])


def _evaluate(z: Array, problem: _Problem, balls: NDArray[np.int64]) -> tuple[Array, Array, Array]:
    """Power (n,), force left (n, 4) and its slope (n, 4, 4) by the scaled unknowns of the balls with these numbers."""
    move, free = problem.map[balls], problem.free[balls]
    k = problem.start[balls] + np.einsum("bckj,bj->bck", move, z)
    found = problem.law.dissipation(k.reshape(-1, 4), _contacts_of(balls))
    shape = k.shape[:2]
    fixed = problem.couple[balls] + problem.cage[balls, None] * np.eye(4)[0]
    power = found.power.reshape(shape).sum(axis=1) + np.einsum("bj,bj->b", fixed, z)
    gradient = np.einsum("bckj,bck->bj", move, found.gradient.reshape(*shape, 4)) + fixed
    gradient += np.einsum("bij,bj->bi", problem.turning[balls], z)
    curvature = found.curvature.reshape(*shape, 4, 4)
    slope = np.einsum("bcki,bckl,bclj->bij", move, curvature, move, optimize=True) + problem.turning[balls]
    return power, np.where(free, gradient, 0.0), np.where(free[:, :, None] & free[:, None, :], slope, 0.0)


def _contacts_of(balls: NDArray[np.int64]) -> NDArray[np.int64]:
    """Numbers of the contacts of balls, inner then outer [-]."""
    return (2 * balls[:, None] + np.arange(2)).ravel()


def _inertia(solution: QuasistaticSolution, driven: NDArray[np.bool_]) -> Array:
    """2 J w_m/D, shape (balls,) [N s]; none of balls that the inner race does not hold."""
    bearing = solution.bearing
    inertia = 0.1 * ball_mass(bearing.ball_diameter, bearing.ball_material.density) * bearing.ball_diameter**2
    found = inertia * solution.orbit_speed * 2.0 / bearing.ball_diameter
    return np.where(driven, found, 0.0)


def _couple(solution: QuasistaticSolution, driven: NDArray[np.bool_]) -> Array:
    """Gyroscopic couple J w_m e_x x w = J w_m (w_r e_t - w_t e_r) at the start, by the scaled unknowns [N]."""
    scale, found = _inertia(solution, driven), np.zeros((solution.azimuth.size, 4))
    found[:, 3] = scale * solution.spin_speed * np.sin(solution.attitude)
    return found


def _turning(solution: QuasistaticSolution, driven: NDArray[np.bool_]) -> Array:
    """Change of the gyroscopic couple with the scaled unknowns [N s/m]; skew, hence without power."""
    scale = _inertia(solution, driven) * 2.0 / solution.bearing.ball_diameter
    found = np.zeros((driven.size, 4, 4))
    found[:, 3, 2], found[:, 2, 3] = scale, -scale
    return found


def _cage_force(solution: QuasistaticSolution, problem: _Problem, z: Array) -> Array:
    """Push into the cage by the balls that the inner race drives, shared by their load [N]: what the others cost."""
    driving = problem.driven
    if driving.all() or not driving.any():
        return np.zeros(driving.size)
    k = problem.start + np.einsum("bckj,bj->bck", problem.map, z)
    force = problem.law.dissipation(k.reshape(-1, 4), _contacts_of(np.arange(driving.size))).gradient.reshape(k.shape)
    wanted = np.einsum("bck,bck->b", force, k - problem.ring)[~driving].sum()  # heat less what a ring pays [W]
    speed = solution.orbit_speed * 0.5 * solution.bearing.pitch_diameter + z[:, 0]
    load = np.where(driving, solution.inner_load, 0.0)
    return load * wanted / max(abs(float((load * speed).sum())), TINY) * np.sign((load * speed).sum())


def _with_the_cage(solution: QuasistaticSolution, driving: NDArray[np.bool_], z: Array) -> Array:
    """The unknowns [m/s] with balls that the inner race does not drive at the mean orbit speed of those that do."""
    load = solution.inner_load
    if driving.all() or not driving.any():
        return z
    bearing, outer = solution.bearing, solution.operation.outer_speed
    radius = 0.5 * bearing.pitch_diameter
    mean = float((load * (solution.orbit_speed + z[:, 0] / radius))[driving].sum() / load[driving].sum())
    moved = z.copy()
    for i in np.flatnonzero(~driving):
        own = float(solution.orbit_speed[i])
        faster = (mean - outer) / (own - outer) - 1.0 if own != outer else 0.0  # rolling goes with the orbit
        moved[i, 0] = radius * (mean - own)
        moved[i, 1:] = 0.5 * bearing.ball_diameter * faster * ball_motion(solution, int(i)).rotation
    return moved


def _shifted(solution: QuasistaticSolution, index: int, z: Array) -> BallMotion:
    """Motion of a ball at the scaled unknowns [m/s]."""
    at, bearing = ball_motion(solution, index), solution.bearing
    return BallMotion(
        orbit_speed=at.orbit_speed + float(z[0]) * 2.0 / bearing.pitch_diameter,
        rotation=at.rotation + z[1:] * 2.0 / bearing.ball_diameter,
    )


def _minimise(problem: _Problem, start: Array) -> tuple[Array, Array]:
    """Newton with Levenberg's damping, every ball by itself; returns z and the residual of each ball [-]."""
    balls = np.arange(problem.start.shape[0])
    friction = problem.strength + TINY
    z, damping = start.copy(), np.full(balls.size, 1e-6)
    power, gradient, hessian = _evaluate(z, problem, balls)
    descent = problem.law.potential and not problem.turning.any()  # there is a potential to go down in
    for _ in range(MAX_STEPS):
        residual = np.abs(gradient).max(axis=1) / friction
        going = (residual > BALANCE_TARGET) & (np.abs(z).max(axis=1) < RUNAWAY * problem.reach) & (damping < 1e12)
        at = np.flatnonzero(going)
        if at.size == 0:
            break
        size = np.maximum(np.trace(hessian[at], axis1=1, axis2=2), friction[at] / problem.reach[at])
        damped = hessian[at] + (damping[at] * size)[:, None, None] * np.eye(4)
        trial = z[at] - np.linalg.solve(damped, gradient[at][..., None])[..., 0]
        new = _evaluate(trial, problem, at)
        noise = 1e-13 * np.abs(power[at])
        flatter = np.abs(new[1]).max(axis=1) < residual[at] * friction[at]
        lower = (new[0] < power[at] - noise) | ((new[0] <= power[at] + noise) & flatter)
        better = lower if descent else flatter
        kept = at[better]
        z[kept], power[kept], gradient[kept], hessian[kept] = trial[better], *(part[better] for part in new)
        damping[at] = np.clip(np.where(better, 0.2, 6.0) * damping[at], 1e-14, 1e13)
    return z, np.abs(gradient).max(axis=1) / friction


def _result(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    problem: _Problem,
    z: Array,
    residual: Array,
) -> BalancedFriction:
    shape = problem.start.shape[:2]
    k = problem.start + np.einsum("bckj,bj->bck", problem.map, z)
    found = problem.law.dissipation(k.reshape(-1, 4), _contacts_of(np.arange(shape[0])))
    forces = -found.gradient.reshape(*shape, 4)
    power = -np.einsum("bck,bck->bc", forces, k)
    motions = [_shifted(solution, i, z[i]) for i in range(shape[0])]
    parts = [
        _motion(solution, c, BallMotion(orbit_speed=_ring(solution, c), rotation=motions[c.ball - 1].rotation))[3]
        for c in contacts
    ]
    loaded = problem.strength > 0.0
    worst = float(residual[loaded].max(initial=0.0))
    return BalancedFriction(
        motions=tuple(motions),
        kinematics=k,
        forces=forces,
        ball_rolling=np.array(parts).reshape(shape),
        power=power,
        shaft_power=-float(np.einsum("bck,bck->", forces, problem.ring)),
        residual=worst,
        driven=problem.driven,
        unknowns=z,
        cage=problem.cage,
        converged=bool(solution.converged and problem.driven.any() and worst <= BALANCE_TOLERANCE),
    )


def ring_power(solution: QuasistaticSolution, contact: BearingContact, force: Array) -> float:
    """Power that a contact's ring feeds into it [W], from the forces (4,) on the ball."""
    return -float(np.dot(force, _ring_motion(solution, contact)))


def _ring_motion(solution: QuasistaticSolution, contact: BearingContact) -> Array:
    """Change of a contact's motion by the speed of its ring, (4,) [m/s], [rad/s]: minus that of the race."""
    motion = ball_motion(solution, contact.ball - 1)  # any: all sliding is linear in the speeds
    faster = BallMotion(orbit_speed=motion.orbit_speed - _ring(solution, contact), rotation=motion.rotation)
    return _motion(solution, contact, faster) - _motion(solution, contact, motion)
