"""Motion of balls over races at many contacts at once, linear in the speeds of orbits, balls and rings.

At a contact with axes x, y, n (`BearingContact`), between a ball that turns with w in the frame of its orbit and a ring
that turns with Omega about e_x in that frame, its track at r from the bearing's axis,

    S_x = D/2 (y . w) - Omega r (x . e_t),      spin    = n . w - Omega (n . e_x),
    S_y = -D/2 (x . w) - Omega r (y . e_t),     rolling = y . w - Omega (y . e_x),

as `bearing.traction_forces.bearing_kinematics` has them for one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..contacts import BearingContact
from ..geometry import Array, Race
from ..quasistatic import QuasistaticSolution


@dataclass(frozen=True, slots=True, kw_only=True)
class MotionMap:
    """Derivatives of the motions k = (S_x, S_y, spin, rolling) of contacts; S in [m/s], the others in [rad/s].

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
        """Motions of all contacts, shape (contacts, 4), from the speeds of the balls as in `ball_speeds` [rad/s]."""
        turned = np.einsum("ckj,cj->ck", self.by_rotation, rotation[self.ball])
        return np.asarray(turned + self.by_ring * (self.ring_speed - orbit[self.ball])[:, None])

    @property
    def ring(self) -> Array:
        """Change of the motions by the speeds of the rings, minus that of the race, shape (contacts, 4)."""
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
        by_ring=-np.stack([track * along[:, 2], track * across[:, 2], normal[:, 0], across[:, 0]], axis=1),
        ring_speed=np.where(inner, operation.inner_speed, operation.outer_speed),
        ball=np.array([contact.ball - 1 for contact in contacts]),
    )


def contact_frames(contacts: Sequence[BearingContact]) -> Array:
    """Rows x, y, n of contacts [-], by their components along e_x, e_r, e_t of their balls, shape (contacts, 3, 3)."""
    azimuth = np.array([contact.azimuth for contact in contacts])
    axes = np.array([(contact.axis_x, contact.axis_y, contact.normal) for contact in contacts])
    c, s = np.cos(azimuth)[:, None], np.sin(azimuth)[:, None]
    radial, tangential = c * axes[..., 1] + s * axes[..., 2], c * axes[..., 2] - s * axes[..., 1]
    return np.stack([axes[..., 0], radial, tangential], axis=-1)


def ball_speeds(solution: QuasistaticSolution) -> tuple[Array, Array]:
    """Orbit speeds (balls,) and rotations (balls, 3) of an equilibrium as `ball_motion` has them [rad/s]."""
    spin, attitude = solution.spin_speed, solution.attitude
    rotation = np.stack([-spin * np.cos(attitude), spin * np.sin(attitude), solution.pivot_speed], axis=1)
    return solution.orbit_speed, rotation
