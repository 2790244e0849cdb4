r"""Balls between the races: loads, motion and forces at given positions of ball and ring.

In the axial plane of a ball (x axial, r radial) let u point from the outer groove's centre of
curvature to the ball's centre and w from there to the inner groove's centre, u + w = V. Then the
approaches are
:math:`\delta_o = |u| - (r_o - D/2)` and :math:`\delta_i = |w| - (r_i - D/2)`, the contact angles
are the directions of u and w from the radial one, and a ball is in equilibrium when (Harris and
Kotzalas, in the signs of docs/theory/bearing.md)::

    Qi sin ai - Qo sin ao + (Mg/D) (li cos ai - lo cos ao)      = 0
    Qi cos ai - Qo cos ao - (Mg/D) (li sin ai - lo sin ao) + Fc = 0

All functions take complex arguments, for a complex step.
"""

from dataclasses import dataclass
from math import cos
from typing import NamedTuple

import numpy as np

from ehl.arrays import Array

from ..geometry import Bearing, Race
from ..operation import BallKinematics, QuasistaticModel
from .contact_stiffness import stiffness_at, stiffness_series
from .kinematics import (
    INNER_PART,
    Direction,
    Motion,
    Numbers,
    PrescribedBalls,
    attitude,
    ball_mass,
    blend,
    centrifugal_force,
    gyroscopic_moment,
    rolling_motion,
)
from .limits import EDGE_COSINE, FRICTION_LIMIT


@dataclass(frozen=True, slots=True, kw_only=True)
class BallProblem:
    """Numbers that all balls of a row have in common: lengths [m], mass [kg], speeds [rad/s],
    Hertz stiffness, hypothesis.
    """

    inner_length: float  # r_i - D/2 [m]
    outer_length: float  # r_o - D/2 [m]
    ball_diameter: float  # [m]
    pitch_diameter: float  # [m]
    inner_groove_radius: float  # [m]
    mass: float  # [kg]
    inner_speed: float  # [rad/s]
    outer_speed: float  # [rad/s]
    kinematics: BallKinematics
    inner_series: Array
    outer_series: Array
    nominal_force: float  # centrifugal force at the free contact angle [N]
    nominal_couple: float  # largest gyroscopic couple, J w_m w_R, at the free contact angle [N m]
    # motion and friction that are known; None: those of the hypothesis
    prescribed: PrescribedBalls | None = None

    @property
    def gamma(self) -> float:
        """D/d_m [-]."""
        return self.ball_diameter / self.pitch_diameter


class BallState(NamedTuple):
    """Everything about the balls at given positions; loads and friction [N], moment [N m], speeds
    [rad/s].
    """

    inner_load: Numbers
    outer_load: Numbers
    inner: Direction
    outer: Direction
    motion: Motion
    centrifugal_force: Numbers
    gyroscopic_moment: Numbers
    inner_friction: Numbers
    outer_friction: Numbers


def ball_problem(
    bearing: Bearing, inner_speed: float, outer_speed: float, model: QuasistaticModel
) -> BallProblem:
    """Collect the numbers that the balls have in common.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    inner_speed, outer_speed : float
        speeds of the rings [rad/s]
    model : QuasistaticModel
        hypothesis on the kinematics and curvature

    Returns
    -------
    BallProblem
        numbers of a ball, SI
    """
    d = bearing.ball_diameter
    dm = bearing.pitch_diameter
    mass = ball_mass(d, bearing.ball_material.density)
    gamma = d / dm * cos(bearing.free_contact_angle)
    nominal_orbit = 0.5 * (inner_speed * (1.0 - gamma) + outer_speed * (1.0 + gamma))
    nominal_spin = 0.5 * (inner_speed - outer_speed) * (1.0 - gamma**2) * dm / d
    return BallProblem(
        inner_length=bearing.inner_groove_radius - 0.5 * d,
        outer_length=bearing.outer_groove_radius - 0.5 * d,
        ball_diameter=d,
        pitch_diameter=dm,
        inner_groove_radius=bearing.inner_groove_radius,
        mass=mass,
        inner_speed=inner_speed,
        outer_speed=outer_speed,
        kinematics=model.ball_kinematics,
        inner_series=stiffness_series(bearing, Race.INNER, model.curvature),
        outer_series=stiffness_series(bearing, Race.OUTER, model.curvature),
        nominal_force=0.5 * mass * dm * nominal_orbit**2,
        nominal_couple=0.1 * mass * d**2 * abs(nominal_orbit * nominal_spin),
    )


def ball_state(u: Numbers, w: Numbers, problem: BallProblem) -> BallState:
    """Loads, angles, motion and body forces of balls.

    Parameters
    ----------
    u : Numbers
        axial and radial distance from the outer groove's centre to the ball, shape (2, ...) [m]
    w : Numbers
        likewise from the ball to the inner groove's centre, shape (2, ...) [m]
    problem : BallProblem
        numbers that all balls have in common

    Returns
    -------
    BallState
        state of the balls
    """
    outer_distance = np.sqrt(u[0] * u[0] + u[1] * u[1])
    inner_distance = np.sqrt(w[0] * w[0] + w[1] * w[1])
    outer = Direction(u[0] / outer_distance, u[1] / outer_distance)
    # far from the race there is no angle
    in_reach = (inner_distance.real > 0.5 * problem.inner_length) & (w[1].real > 0.0)
    safe = np.where(in_reach, inner_distance, problem.inner_length)
    inner = Direction(
        np.where(in_reach, w[0] / safe, outer.sin), np.where(in_reach, w[1] / safe, outer.cos)
    )
    stiffness = stiffness_at(problem.outer_series, outer.cos)
    outer_load = stiffness * _power(outer_distance - problem.outer_length)
    outer_load = outer_load * _smooth_step(outer.cos, EDGE_COSINE)
    stiffness = stiffness_at(problem.inner_series, inner.cos)
    reach = np.where(in_reach, inner_distance, 0.0)
    inner_load = stiffness * _power(reach - problem.inner_length)
    inner_load = inner_load * _smooth_step(inner.cos, EDGE_COSINE)
    prescribed = problem.prescribed
    if prescribed is None:
        fraction, motion = _shared_motion(outer, inner, (inner_load, outer_load), problem)
    else:
        motion = prescribed.motion
    force = centrifugal_force(problem.mass, problem.pitch_diameter, motion.orbit_speed)
    moment = gyroscopic_moment(problem.mass, problem.ball_diameter, motion)
    if prescribed is None:
        coefficient = INNER_PART[problem.kinematics] * fraction
        friction = [p * moment / problem.ball_diameter for p in (coefficient, 2.0 - coefficient)]
    else:
        none = 0.0 * inner_load
        friction = [prescribed.inner_friction + none, prescribed.outer_friction + none]
    return BallState(inner_load, outer_load, inner, outer, motion, force, moment, *friction)


def _shared_motion(
    outer: Direction, inner: Direction, loads: tuple[Numbers, Numbers], problem: BallProblem
) -> tuple[Numbers, Motion]:
    """Motion under the hypothesis as far as the races can transmit the friction that it asks for.

    The share [-] of the inner race is 1 where lambda_i Mg/D <= FRICTION_LIMIT Qi, Mg by the
    nominal speeds and the full attitude; it falls smoothly to 0, the ball rolling on the outer
    race alone, as the inner contact unloads. Where even the outer race cannot hold that attitude,
    it falls towards the one without couple, an axis parallel to x.
    """
    inner_load, outer_load = loads
    speeds = (problem.inner_speed, problem.outer_speed)
    outer_control = attitude(outer, inner, problem.gamma, BallKinematics.OUTER_RACE_CONTROL)
    parallel = Direction(0.0 * outer_control.sin, 0.0 * outer_control.sin + 1.0)
    beta = blend(
        parallel, outer_control, _transmissible_fraction(outer_load, 2.0, outer_control, problem)
    )
    if problem.kinematics is BallKinematics.OUTER_RACE_CONTROL:
        return np.ones_like(inner_load), rolling_motion(outer, inner, beta, problem.gamma, *speeds)
    chosen = attitude(outer, inner, problem.gamma, problem.kinematics)
    fraction = _transmissible_fraction(inner_load, INNER_PART[problem.kinematics], chosen, problem)
    return fraction, rolling_motion(
        outer, inner, blend(beta, chosen, fraction), problem.gamma, *speeds
    )


def _transmissible_fraction(
    load: Numbers, coefficient: float, beta: Direction, problem: BallProblem
) -> Numbers:
    """1 where the load [N] transmits the friction `coefficient` Mg/D of an attitude, else less."""
    couple = problem.nominal_couple * beta.sin * np.sign(beta.sin.real)
    return _smooth_step(FRICTION_LIMIT * load, coefficient * couple / problem.ball_diameter)


def _power(approach: Numbers) -> Numbers:
    """max(approach, 0)^1.5 [m^1.5]."""
    pressed = np.where(approach.real > 0.0, approach, 0.0)
    return pressed * np.sqrt(pressed)


def _smooth_step(value: Numbers, full: Numbers | float) -> Numbers:
    """3 t^2 - 2 t^3 of t = value/full, 1 where the value exceeds the full one [-]."""
    full = np.asarray(full)
    below = value.real < full.real
    if not below.any():  # as with nearly all balls
        return np.ones(below.shape)
    t = np.where(below, np.where(value.real > 0.0, value, 0.0) / np.where(below, full, 1.0), 1.0)
    return t * t * (3.0 - 2.0 * t)
