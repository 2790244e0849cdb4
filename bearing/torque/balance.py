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
from ..traction_forces import BallMotion, ball_motion, bearing_kinematics, groove_curvature_radius
from .contact_friction import TINY, Dissipation, Ellipses, coulomb_dissipation, line_dissipation

Law = Callable[[Array, NDArray[np.int64]], Dissipation]  # of the motion (N, 4) of contacts with these numbers
MAX_STEPS = 200
RUNAWAY = 1.0e4  # speeds over those of curvature slip at which a ball counts as not held [-]
CAGE_STEPS = 4  # of push and speed of the cage, which hardly depend on the balance [-]
ROUNDING = 3.0e-3  # of Coulomb's law, over the largest sliding that the curvature of the contact makes [-]
BALANCE_TOLERANCE = 1.0e-6  # residual force over mu Q that is accepted [-]
BALANCE_TARGET = 1.0e-10  # residual at which iterating stops [-]
PLANE = np.array([True, True, True, False])  # orbit, rotation about e_x and e_r: all that the line law knows


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
    converged : bool
    """

    motions: tuple[BallMotion, ...]
    kinematics: Array
    forces: Array
    ball_rolling: Array
    power: Array
    shaft_power: float
    residual: float
    converged: bool

    @property
    def energy_error(self) -> float:
        """Shaft power less friction power, over the latter [-]."""
        total = float(self.power.sum())
        return (self.shaft_power - total) / total if total > 0.0 else 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class _Problem:
    """k = start + map z for all contacts, z scaled to speeds [m/s]."""

    law: Law
    start: Array  # (balls, 2, 4)
    map: Array  # (balls, 2, 4, 4)
    couple: Array  # (balls, 4) gyroscopic one at the start [N]
    turning: Array  # (balls, 4, 4) its change with z [N s/m]
    cage: Array  # (balls,) push of the cage against the orbit of balls that drive it [N]
    free: NDArray[np.bool_]  # (balls, 4)
    reach: Array  # (balls,) largest sliding that the curvature of a ball's contacts makes [m/s]
    strength: Array  # (balls,) friction that the residual is measured against [N]
    ring: Array  # (balls, 2, 4) change of the motion by the rings' speeds [m/s], [rad/s]


def balanced_friction(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    friction: float | Array,
    *,
    lines: bool = False,
    gyroscopic: bool = True,
) -> BalancedFriction:
    """Motion of all balls in balance under Coulomb friction, and what it costs.

    Parameters
    ----------
    solution : QuasistaticSolution
    contacts : sequence of BearingContact
        All of its contacts, inner then outer, ball by ball.
    friction : float or ndarray, shape (contacts,)
        Coulomb's mu [-].
    lines : bool
        Leave out the sliding across the rolling direction, as models by lines of pure rolling do; the gyroscopic
        couple, which such a model cannot carry, is then left out too.
    gyroscopic : bool
        Whether the contacts have to hold the gyroscopic couple.

    Returns
    -------
    BalancedFriction
        In SI; not `converged` where the friction cannot hold a ball.
    """
    found = contact_ellipses(solution, contacts, friction)
    chosen = line_dissipation if lines else coulomb_dissipation
    return balance_balls(
        solution,
        contacts,
        lambda motion, numbers: chosen(motion, found.some(numbers)),
        found.friction * found.load,
        plane=lines,
        gyroscopic=gyroscopic,
    )


def contact_ellipses(
    solution: QuasistaticSolution, contacts: Sequence[BearingContact], friction: float | Array
) -> Ellipses:
    """The ellipses of all contacts under Coulomb's mu [-], lengths in [m]; friction rounded as `ROUNDING` says."""
    hertz = [c.hertz for c in contacts]
    radius = np.array([groove_curvature_radius(solution.bearing, c.race) for c in contacts])
    transverse = np.array([1e-6 if h is None else h.semi_axis_y for h in hertz])
    return Ellipses(
        load=np.array([0.0 if h is None else h.load for h in hertz]),
        semi_axis_x=np.array([1e-6 if h is None else h.semi_axis_x for h in hertz]),
        semi_axis_y=transverse,
        radius=radius,
        friction=np.broadcast_to(np.asarray(friction, dtype=np.float64), radius.shape),
        rounding=ROUNDING * _bow(solution, contacts),
    )


def _bow(solution: QuasistaticSolution, contacts: Sequence[BearingContact]) -> Array:
    """Largest sliding by the curvature of each contact, w a^2/(2 R) [m/s]."""
    found = np.full(len(contacts), TINY)
    for i, contact in enumerate(contacts):
        if contact.hertz is not None:
            k = bearing_kinematics(solution, contact)
            found[i] = max(abs(k.rolling) * contact.hertz.semi_axis_y**2 / (2.0 * k.curvature_radius), TINY)
    return found


def balance_balls(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    law: Law,
    strength: Array,
    *,
    plane: bool = False,
    gyroscopic: bool = True,
) -> BalancedFriction:
    """Motion of all balls in which a law of friction balances itself on each of them.

    Parameters
    ----------
    solution : QuasistaticSolution
    contacts : sequence of BearingContact
        All of its contacts, inner then outer, ball by ball.
    law : callable
        Takes the motions (N, 4) of contacts [m/s], [rad/s] and their numbers, gives a `Dissipation`; one that has no
        potential gives zero power, and only its slope is looked at.
    strength : ndarray, shape (N,)
        Friction of each contact that a residual is measured against [N].
    plane : bool
        The law knows no sliding across the rolling direction: the balls then do not turn about the orbit's tangent, and
        no gyroscopic couple is held.
    gyroscopic : bool
        Whether the contacts have to hold the gyroscopic couple.

    Returns
    -------
    BalancedFriction
    """
    problem = _problem(solution, contacts, law, strength, plane=plane)
    if gyroscopic and not plane:
        problem = replace(problem, couple=_couple(solution))
    z, residual = _minimise(problem, np.zeros(problem.couple.shape))
    turning = _turning(solution) if gyroscopic and not plane else problem.turning
    alone = not (solution.inner_load > 0.0).all()  # balls that go with the cage
    for _ in range(CAGE_STEPS if alone else 1):
        problem = replace(problem, turning=turning, cage=_cage_force(solution, problem, z))
        z, residual = _minimise(problem, _with_the_cage(solution, z))
    return _result(solution, contacts, problem, z, residual)


def _problem(
    solution: QuasistaticSolution, contacts: Sequence[BearingContact], law: Law, strength: Array, *, plane: bool
) -> _Problem:
    bearing, balls = solution.bearing, solution.azimuth.size
    scales = np.array([2.0 / bearing.pitch_diameter, *(3 * (2.0 / bearing.ball_diameter,))])
    start, slopes = np.zeros((2 * balls, 4)), np.zeros((2 * balls, 4, 4))
    for i, contact in enumerate(contacts):
        motion = ball_motion(solution, contact.ball - 1)
        start[i] = _motion(solution, contact, motion)
        for j in range(4):
            slopes[i, :, j] = _motion(solution, contact, _moved(motion, j, scales[j])) - start[i]
    free = np.tile(PLANE, (balls, 1)) if plane else np.ones((balls, 4), dtype=np.bool_)
    free &= (solution.inner_load > 0.0)[:, None]
    shape = (balls, 2)
    return _Problem(
        law=law,
        start=start.reshape(*shape, 4),
        map=slopes.reshape(*shape, 4, 4),
        couple=np.zeros((balls, 4)),
        turning=np.zeros((balls, 4, 4)),
        cage=np.zeros(balls),
        free=free,
        reach=_bow(solution, contacts).reshape(shape).max(axis=1),
        strength=strength.reshape(shape).max(axis=1),
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
    found = problem.law(k.reshape(-1, 4), _contacts_of(balls))
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


def _inertia(solution: QuasistaticSolution) -> Array:
    """2 J w_m/D, shape (balls,) [N s]; none of balls that the inner race does not hold."""
    bearing = solution.bearing
    inertia = 0.1 * ball_mass(bearing.ball_diameter, bearing.ball_material.density) * bearing.ball_diameter**2
    found = inertia * solution.orbit_speed * 2.0 / bearing.ball_diameter
    return np.where(solution.inner_load > 0.0, found, 0.0)


def _couple(solution: QuasistaticSolution) -> Array:
    """Gyroscopic couple J w_m e_x x w = J w_m (w_r e_t - w_t e_r) at the start, by the scaled unknowns [N]."""
    scale, found = _inertia(solution), np.zeros((solution.azimuth.size, 4))
    found[:, 3] = scale * solution.spin_speed * np.sin(solution.attitude)
    return found


def _turning(solution: QuasistaticSolution) -> Array:
    """Change of the gyroscopic couple with the scaled unknowns [N s/m]; skew, hence without power."""
    scale, found = _inertia(solution) * 2.0 / solution.bearing.ball_diameter, np.zeros((solution.azimuth.size, 4, 4))
    found[:, 3, 2], found[:, 2, 3] = scale, -scale
    return found


def _cage_force(solution: QuasistaticSolution, problem: _Problem, z: Array) -> Array:
    """Push into the cage by the balls that the inner race drives, shared by their load [N]: what the others cost."""
    driving = solution.inner_load > 0.0
    if driving.all() or not driving.any():
        return np.zeros(driving.size)
    k = problem.start + np.einsum("bckj,bj->bck", problem.map, z)
    force = problem.law(k.reshape(-1, 4), _contacts_of(np.arange(driving.size))).gradient.reshape(k.shape)
    wanted = np.einsum("bck,bck->b", force, k - problem.ring)[~driving].sum()  # heat less what a ring pays [W]
    speed = solution.orbit_speed * 0.5 * solution.bearing.pitch_diameter + z[:, 0]
    load = np.where(driving, solution.inner_load, 0.0)
    return load * wanted / max(abs(float((load * speed).sum())), TINY) * np.sign((load * speed).sum())


def _with_the_cage(solution: QuasistaticSolution, z: Array) -> Array:
    """The unknowns [m/s] with balls that the inner race does not drive at the mean orbit speed of those that do."""
    driving, load = solution.inner_load > 0.0, solution.inner_load
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
    descent = not problem.turning.any()  # there is a potential to go down in
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
    found = problem.law(k.reshape(-1, 4), _contacts_of(np.arange(shape[0])))
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
        converged=bool(solution.converged and worst <= BALANCE_TOLERANCE),
    )


def ring_power(solution: QuasistaticSolution, contact: BearingContact, force: Array) -> float:
    """Power that a contact's ring feeds into it [W], from the forces (4,) on the ball."""
    return -float(np.dot(force, _ring_motion(solution, contact)))


def _ring_motion(solution: QuasistaticSolution, contact: BearingContact) -> Array:
    """Change of a contact's motion by the speed of its ring, (4,) [m/s], [rad/s]: minus that of the race."""
    motion = ball_motion(solution, contact.ball - 1)  # any: all sliding is linear in the speeds
    faster = BallMotion(orbit_speed=motion.orbit_speed - _ring(solution, contact), rotation=motion.rotation)
    return _motion(solution, contact, faster) - _motion(solution, contact, motion)
