"""Motion of a ball over its races: rolling, sliding and spin of both surfaces in each contact."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ehl.kinematics import ContactKinematics

from ..geometry import Array, Bearing, Race
from ..quasistatic.solution import QuasistaticSolution
from .contacts import BearingContact


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
    """Radius of the loaded surface across the rolling direction, 2 r D/(2 r + D) [m], Harris and
    Kotzalas.

    The mean of the curvatures of ball and groove, as two equal half spaces under the same pressure
    deform alike.
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
    ball_turn = axes @ motion.rotation
    race_turn = axes @ np.array([ring, 0.0, 0.0])
    side = -1.0 if inner else 1.0
    track = 0.5 * (
        bearing.pitch_diameter + side * bearing.ball_diameter * np.cos(contact.contact_angle)
    )
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
    """Rows x, y, n of a contact [-], by their components along e_x, e_r, e_t of its ball, shape
    (3, 3).
    """
    c, s = np.cos(contact.azimuth), np.sin(contact.azimuth)
    frame = np.array([[1.0, 0.0, 0.0], [0.0, c, s], [0.0, -s, c]])
    return np.stack([contact.axis_x, contact.axis_y, contact.normal]) @ frame.T


@dataclass(frozen=True, slots=True, kw_only=True)
class MotionMap:
    """Derivatives of the motions k = (S_x, S_y, spin, rolling) of contacts; S in [m/s], the others
    in [rad/s].

    Attributes
    ----------
    by_rotation : ndarray, shape (contacts, 4, 3)
        By the angular velocity of the ball along e_x, e_r, e_t in the frame of its orbit [m], [-].
    by_ring : ndarray, shape (contacts, 4)
        By the speed of the contact's ring; the orbit's has the opposite [m], [-].
    ring_speed : ndarray, shape (contacts,)
        [rad/s].
    ball : ndarray of int, shape (contacts,)
        Number of each contact's ball, from 0 [-].
    """

    by_rotation: Array
    by_ring: Array
    ring_speed: Array
    ball: NDArray[np.int64]

    def motion(self, orbit: Array, rotation: Array) -> Array:
        """Motions of all contacts, shape (contacts, 4), from the speeds of the balls as in
        `ball_speeds` [rad/s].
        """
        turned = np.einsum("ckj,cj->ck", self.by_rotation, rotation[self.ball])
        return np.asarray(turned + self.by_ring * (self.ring_speed - orbit[self.ball])[:, None])

    @property
    def ring(self) -> Array:
        """Change of the motions by the speeds of the rings, minus that of the race, shape
        (contacts, 4).
        """
        return self.by_ring * self.ring_speed[:, None]


def motion_map(solution: QuasistaticSolution, contacts: Sequence[BearingContact]) -> MotionMap:
    """How contacts of an equilibrium move with balls and rings, speeds in [rad/s]."""
    bearing, operation = solution.bearing, solution.operation
    inner = np.array([contact.race is Race.INNER for contact in contacts])
    angle = np.array([contact.contact_angle for contact in contacts])
    axes = contact_frames(contacts)
    radius = 0.5 * bearing.ball_diameter
    track = 0.5 * bearing.pitch_diameter + np.where(inner, -radius, radius) * np.cos(angle)
    along, across, normal = axes[:, 0], axes[:, 1], axes[:, 2]
    return MotionMap(
        by_rotation=np.stack([radius * across, -radius * along, normal, across], axis=1),
        by_ring=-np.stack(
            [track * along[:, 2], track * across[:, 2], normal[:, 0], across[:, 0]], axis=1
        ),
        ring_speed=np.where(inner, operation.inner_speed, operation.outer_speed),
        ball=np.array([contact.ball - 1 for contact in contacts]),
    )


def contact_frames(contacts: Sequence[BearingContact]) -> Array:
    """Rows x, y, n of contacts [-], by their components along e_x, e_r, e_t of their balls, shape
    (contacts, 3, 3).
    """
    azimuth = np.array([contact.azimuth for contact in contacts])
    axes = np.array([(contact.axis_x, contact.axis_y, contact.normal) for contact in contacts])
    c, s = np.cos(azimuth)[:, None], np.sin(azimuth)[:, None]
    radial = c * axes[..., 1] + s * axes[..., 2]
    tangential = c * axes[..., 2] - s * axes[..., 1]
    return np.stack([axes[..., 0], radial, tangential], axis=-1)


def ball_speeds(solution: QuasistaticSolution) -> tuple[Array, Array]:
    """Orbit speeds (balls,) and rotations (balls, 3) of an equilibrium as `ball_motion` has them
    [rad/s].
    """
    spin, attitude = solution.spin_speed, solution.attitude
    rotation = np.stack(
        [-spin * np.cos(attitude), spin * np.sin(attitude), solution.pivot_speed], axis=1
    )
    return solution.orbit_speed, rotation
