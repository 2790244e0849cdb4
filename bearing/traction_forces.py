"""Traction at the contacts of a bearing: how ball and race move over each other, and what the oil does to them.

In the frame that turns with the ball's centre, the ball has the angular velocity w_R (-cos beta e_x + sin beta e_r)
and the race (Omega - w_m) e_x. Both velocities are taken at the contact's centre, and the two bodies' motion there
resolved along the contact's axes x, y, n (`BearingContact`), so that spin and rolling have the signs of
`ehl.traction.ContactKinematics`, body 1 the ball.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehl.rheology import Rheology
from ehl.solution import ContactSolution
from ehl.traction import ContactKinematics, TractionResult, integrate_traction

from .contacts import BearingContact
from .geometry import Array, Bearing, Race
from .quasistatic import QuasistaticSolution


@dataclass(frozen=True, slots=True, kw_only=True)
class BallMotion:
    """Motion of a ball in the frame that turns with its centre.

    Attributes
    ----------
    orbit_speed : float
        w_m of the ball's centre about +x [rad/s].
    rotation : ndarray, shape (3,)
        Angular velocity of the ball along e_x, e_r, e_t, in the frame of the orbit [rad/s].
    """

    orbit_speed: float
    rotation: Array


def ball_motion(solution: QuasistaticSolution, index: int) -> BallMotion:
    """Motion that an equilibrium gives a ball (by number from 0), speeds in [rad/s]."""
    spin, attitude = float(solution.spin_speed[index]), float(solution.attitude[index])
    pivot = float(solution.pivot_speed[index])
    rotation = np.array([-spin * np.cos(attitude), spin * np.sin(attitude), pivot])
    return BallMotion(orbit_speed=float(solution.orbit_speed[index]), rotation=rotation)


def groove_curvature_radius(bearing: Bearing, race: Race) -> float:
    """Radius of the loaded surface across the rolling direction, 2 r D/(2 r + D) [m], Harris and Kotzalas.

    The mean of the curvatures of ball and groove, as two equal half spaces under the same pressure deform alike.
    """
    groove = bearing.inner_groove_radius if race is Race.INNER else bearing.outer_groove_radius
    return 2.0 * groove * bearing.ball_diameter / (2.0 * groove + bearing.ball_diameter)


def bearing_kinematics(
    solution: QuasistaticSolution, contact: BearingContact, motion: BallMotion | None = None
) -> ContactKinematics:
    """How ball and race move over each other at a contact.

    Parameters
    ----------
    solution : QuasistaticSolution
    contact : BearingContact
        One of its contacts, loaded.
    motion : BallMotion, optional
        Of the ball; None: that of the equilibrium, which slides at neither contact centre.

    Returns
    -------
    ContactKinematics
        Speeds in [m/s] and [rad/s] along the contact's axes.
    """
    bearing, operation = solution.bearing, solution.operation
    motion = motion or ball_motion(solution, contact.ball - 1)
    inner = contact.race is Race.INNER
    ring = (operation.inner_speed if inner else operation.outer_speed) - motion.orbit_speed
    axes = contact_axes(contact)
    ball_turn, race_turn = axes @ motion.rotation, axes @ np.array([ring, 0.0, 0.0])
    side = -1.0 if inner else 1.0
    track = 0.5 * (bearing.pitch_diameter + side * bearing.ball_diameter * np.cos(contact.contact_angle))
    ball = 0.5 * bearing.ball_diameter * np.array([ball_turn[1], -ball_turn[0]])  # omega x n D/2
    race = ring * track * axes[:2, 2]  # omega e_x x e_r = e_t
    ball_curvature = 2.0 / bearing.ball_diameter
    along = None if contact.hertz is None else contact.hertz.radius_x
    return ContactKinematics(
        entrainment_speed=float(0.5 * (ball[0] + race[0])),
        entrainment_lateral=float(0.5 * (ball[1] + race[1])),
        sliding_x=float(ball[0] - race[0]),
        sliding_y=float(ball[1] - race[1]),
        spin=float(ball_turn[2] - race_turn[2]),
        mean_spin=float(0.5 * (ball_turn[2] + race_turn[2])),
        rolling=float(ball_turn[1] - race_turn[1]),
        mean_rolling=float(0.5 * (ball_turn[1] + race_turn[1])),
        curvature_radius=groove_curvature_radius(bearing, contact.race),
        curvature_width=np.inf if contact.hertz is None else contact.hertz.semi_axis_y,
        curvature_difference=0.0 if along is None else 1.0 / along - 2.0 * ball_curvature,
    )


def contact_axes(contact: BearingContact) -> Array:
    """Rows x, y, n of a contact [-], by their components along e_x, e_r, e_t of its ball, shape (3, 3)."""
    c, s = np.cos(contact.azimuth), np.sin(contact.azimuth)
    frame = np.array([[1.0, 0.0, 0.0], [0.0, c, s], [0.0, -s, c]])
    return np.stack([contact.axis_x, contact.axis_y, contact.normal]) @ frame.T


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactTraction:
    """Traction of one contact of a bearing, and the motion it belongs to; `result` has body 1 the ball."""

    contact: BearingContact
    kinematics: ContactKinematics
    result: TractionResult


def contact_traction(
    solution: QuasistaticSolution,
    contact: BearingContact,
    film: ContactSolution,
    rheology: Rheology,
    motion: BallMotion | None = None,
) -> ContactTraction:
    """Forces and moments of one contact, integrated over its film.

    Parameters
    ----------
    solution, contact
        As in `bearing_kinematics`.
    film : ContactSolution
        Of the contact's conditions [m], [Pa].
    rheology : Rheology
    motion : BallMotion, optional
        Of the ball; None: that of the equilibrium [rad/s].

    Returns
    -------
    ContactTraction
    """
    kinematics = bearing_kinematics(solution, contact, motion)
    result = integrate_traction(film, kinematics, rheology, temperature=solution.operation.temperature)
    return ContactTraction(contact=contact, kinematics=kinematics, result=result)
