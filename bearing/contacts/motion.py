"""Motion of balls over their races, rolling, sliding and spin of both surfaces in each contact,
and the traction of the films there.

In the frame that turns with the ball's centre at the orbit speed w_m, the ball has the angular
velocity w = (w_x, w_r, w_t) along e_x, e_r, e_t and the race (Omega - w_m) e_x. At the contact's
centre the ball's surface moves by w x n D/2, the race's by (Omega - w_m) R e_t with the radius R
of the track, R = d_m/2 -+ D/2 cos(angle) (inner, outer). Both bodies' motions are resolved along
the contact's axes x, y, n as k = (velocity x, velocity y, angular speed about n, about y); the
ball's less the race's is (S_x, S_y, spin, rolling) of `oilfilm.ehl.conditions.ContactKinematics`.
`MotionMap` is this linear map, and every other kinematics of ball on race an evaluation of it.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.conditions import ContactKinematics
from oilfilm.ehl.oil.rheology import Rheology
from oilfilm.ehl.solution import ContactSolution
from oilfilm.ehl.traction.rolling_moment import rolling_moment
from oilfilm.ehl.traction.shear import TractionResult, integrate_traction

from ..geometry import Bearing, Race
from ..quasistatic.solution import QuasistaticSolution
from .contact import BearingContact
from .shape import groove_curvature_radius

# along x of the films whose shear is summed, at most, in the balance of the balls and in the
# torque: with the nodes of one and of the other the rings' power misses the heat by what the mesh
# changes of a friction that nearly vanishes, half of the heat of a 6306 with little oil. A 6306 at
# 10 kN, films on 1025 nodes, takes 201.039 N mm so and 201.037 by all nodes, in a quarter of the
# time
TRACTION_POINTS = 513


@dataclass(frozen=True, slots=True, kw_only=True)
class BallMotion:
    """Motion of a ball in the frame that turns with its centre."""

    orbit_speed: float  # w_m of the ball's centre about +x [rad/s]
    # (3,) angular velocity of the ball along e_x, e_r, e_t, in the frame of the orbit [rad/s]
    rotation: Array


@dataclass(frozen=True, slots=True, kw_only=True)
class MotionMap:
    """Motions k of balls and races at contacts as linear functions of their speeds."""

    # (contacts, 4, 3) of the ball, by its angular velocity along e_x, e_r, e_t in the frame of its
    # orbit [m], [-]
    by_rotation: Array
    # (contacts, 4) of the ball against the race, by the speed of the contact's ring; the orbit's
    # has the opposite [m], [-]
    by_ring: Array
    ring_speed: Array  # (contacts,) [rad/s]
    ball: NDArray[np.int64]  # (contacts,) number of each contact's ball, from 0 [-]

    def bodies(self, orbit: Array, rotation: Array) -> tuple[Array, Array]:
        """Motions k of the balls and of the races at the contacts.

        Parameters
        ----------
        orbit : Array
            orbit speeds of the balls, shape (balls,) [rad/s]
        rotation : Array
            rotations of the balls as in `ball_speeds`, shape (balls, 3) [rad/s]

        Returns
        -------
        ball
            motion of the balls, shape (contacts, 4) [m/s], [rad/s]
        race
            motion of the races, shape (contacts, 4) [m/s], [rad/s]
        """
        return self.bodies_at(orbit[self.ball], rotation[self.ball])

    def bodies_at(self, orbit: Array, rotation: Array) -> tuple[Array, Array]:
        """Motions as in `bodies`, from the speeds of the ball of each contact.

        Parameters
        ----------
        orbit : Array
            orbit speed of each contact's ball, shape (contacts,) [rad/s]
        rotation : Array
            its rotation, shape (contacts, 3) [rad/s]

        Returns
        -------
        ball
            motion of the balls, shape (contacts, 4) [m/s], [rad/s]
        race
            motion of the races, shape (contacts, 4) [m/s], [rad/s]
        """
        ball = np.einsum("ckj,cj->ck", self.by_rotation, rotation)
        return ball, -self.by_ring * (self.ring_speed - orbit)[:, None]

    def motion(self, orbit: Array, rotation: Array) -> Array:
        """(S_x, S_y, spin, rolling) of ball against race.

        Parameters
        ----------
        orbit : Array
            orbit speeds of the balls, shape (balls,) [rad/s]
        rotation : Array
            rotations of the balls, shape (balls, 3) [rad/s]

        Returns
        -------
        Array
            relative motion, shape (contacts, 4) [m/s], [rad/s]
        """
        ball, race = self.bodies(orbit, rotation)
        return np.asarray(ball - race)

    @property
    def ring(self) -> Array:
        """Change of the motions by the speeds of the rings, minus that of the race, shape
        (contacts, 4).
        """
        return self.by_ring * self.ring_speed[:, None]


def motion_map(solution: QuasistaticSolution, contacts: Sequence[BearingContact]) -> MotionMap:
    """How contacts of an equilibrium move with balls and rings.

    Parameters
    ----------
    solution : QuasistaticSolution
        Equilibrium, speeds in [rad/s].
    contacts : sequence of BearingContact
        Some of its contacts; `BearingContacts` of this equilibrium have their map computed once.

    Returns
    -------
    MotionMap
        Its arrays are not to be changed.
    """
    operation = solution.operation
    speeds = (operation.inner_speed, operation.outer_speed)
    if isinstance(contacts, BearingContacts) and contacts.moves_as(solution.bearing, speeds):
        return contacts.motion
    return _motion_map(solution.bearing, speeds, contacts)


class BearingContacts(tuple[BearingContact, ...]):
    """All contacts of an equilibrium, and how they move, computed once."""

    bearing: Bearing
    ring_speeds: tuple[float, float]  # of the inner and the outer ring [rad/s]

    @classmethod
    def of(
        cls, solution: QuasistaticSolution, contacts: Iterable[BearingContact]
    ) -> "BearingContacts":
        """Contacts of an equilibrium.

        Parameters
        ----------
        solution : QuasistaticSolution
            equilibrium of the bearing
        contacts : Iterable[BearingContact]
            its contacts

        Returns
        -------
        BearingContacts
            the contacts, with bearing and speeds of its rings
        """
        made = cls(contacts)
        made.bearing = solution.bearing
        made.ring_speeds = (solution.operation.inner_speed, solution.operation.outer_speed)
        return made

    def moves_as(self, bearing: Bearing, ring_speeds: tuple[float, float]) -> bool:
        """Check whether the contacts are those of a bearing with its rings at these speeds.

        Parameters
        ----------
        bearing : Bearing
            the bearing
        ring_speeds : tuple[float, float]
            of the inner and the outer ring [rad/s]

        Returns
        -------
        bool
            true if they are
        """
        return self.bearing is bearing and self.ring_speeds == ring_speeds

    @cached_property
    def motion(self) -> MotionMap:
        """How the contacts move with balls and rings."""
        return _motion_map(self.bearing, self.ring_speeds, self)


def _motion_map(
    bearing: Bearing, ring_speeds: tuple[float, float], contacts: Sequence[BearingContact]
) -> MotionMap:
    """The map of `motion_map`, at speeds of the inner and the outer ring [rad/s]."""
    inner = np.array([contact.race is Race.INNER for contact in contacts], dtype=np.bool_)
    angle = np.array([contact.contact_angle for contact in contacts])
    ball = np.array([contact.ball - 1 for contact in contacts], dtype=np.int64)
    axle = np.broadcast_to([1.0, 0.0, 0.0], (ball.size, 3))
    axes = contact_frames(contacts)
    return _map_of_axes(bearing, ring_speeds, inner, angle, axes, axle, ball)


def motion_map_of_axes(
    solution: QuasistaticSolution,
    inner: NDArray[np.bool_],
    angle: Array,
    axes: Array,
    axle: Array,
    ball: NDArray[np.int64],
) -> MotionMap:
    """The map of contacts by race, contact angle, ball, and axes.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    inner : NDArray[np.bool_]
        true at the inner race, shape (contacts,) [-]
    angle : Array
        contact angles, shape (contacts,) [rad]
    axes : Array
        rows x, y, n in a frame whose third direction is e_t, shape (contacts, 3, 3) [-]
    axle : Array
        axis of the bearing in the same frame, shape (contacts, 3) [-]
    ball : NDArray[np.int64]
        number of each contact's ball, from 0, shape (contacts,) [-]

    Returns
    -------
    MotionMap
        the map, [m] and [-]
    """
    operation = solution.operation
    speeds = (operation.inner_speed, operation.outer_speed)
    return _map_of_axes(solution.bearing, speeds, inner, angle, axes, axle, ball)


def _map_of_axes(
    bearing: Bearing,
    ring_speeds: tuple[float, float],
    inner: NDArray[np.bool_],
    angle: Array,
    axes: Array,
    axle: Array,
    ball: NDArray[np.int64],
) -> MotionMap:
    """The map of `motion_map_of_axes`, at speeds of the inner and the outer ring [rad/s]."""
    radius = 0.5 * bearing.ball_diameter
    side = np.where(inner, -1.0, 1.0)
    track = 0.5 * (bearing.pitch_diameter + side * bearing.ball_diameter * np.cos(angle))
    along, across, normal = axes[:, 0], axes[:, 1], axes[:, 2]
    about_normal = np.einsum("cj,cj->c", normal, axle)
    about_across = np.einsum("cj,cj->c", across, axle)
    ring = [track * along[:, 2], track * across[:, 2], about_normal, about_across]
    return MotionMap(
        by_rotation=np.stack([radius * across, -radius * along, normal, across], axis=1),
        by_ring=-np.stack(ring, axis=1),
        ring_speed=np.where(inner, *ring_speeds),
        ball=ball,
    )


def contact_frames(contacts: Sequence[BearingContact]) -> Array:
    """Rows x, y, n of contacts by their components along e_x, e_r, e_t of their balls.

    Parameters
    ----------
    contacts : Sequence[BearingContact]
        contacts of an equilibrium

    Returns
    -------
    Array
        axes, shape (contacts, 3, 3) [-]
    """
    azimuth = np.array([contact.azimuth for contact in contacts])
    axes = np.array([(contact.axis_x, contact.axis_y, contact.normal) for contact in contacts])
    axes = axes.reshape(-1, 3, 3)
    c, s = np.cos(azimuth)[:, None], np.sin(azimuth)[:, None]
    radial = c * axes[..., 1] + s * axes[..., 2]
    tangential = c * axes[..., 2] - s * axes[..., 1]
    return np.stack([axes[..., 0], radial, tangential], axis=-1)


def ball_speeds(solution: QuasistaticSolution) -> tuple[Array, Array]:
    """Orbit speeds and rotations of the balls of an equilibrium, as in `BallMotion`.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing

    Returns
    -------
    orbit
        shape (balls,) [rad/s]
    rotation
        along e_x, e_r, e_t, shape (balls, 3) [rad/s]
    """
    spin = solution.spin_speed
    attitude = solution.attitude
    rotation = [-spin * np.cos(attitude), spin * np.sin(attitude), solution.pivot_speed]
    return solution.orbit_speed, np.stack(rotation, axis=1)


def bearing_kinematics(
    solution: QuasistaticSolution, contact: BearingContact, motion: BallMotion | None = None
) -> ContactKinematics:
    """Motion of ball and race over each other at a contact, along its axes.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    contact : BearingContact
        one of its contacts
    motion : BallMotion | None, optional
        motion of the ball [rad/s]; None: that of the equilibrium

    Returns
    -------
    ContactKinematics
        entrainment and sliding [m/s], spin and rolling [rad/s]
    """
    orbit, rotation = ball_speeds(solution)
    if motion is not None:
        orbit = np.full_like(orbit, motion.orbit_speed)
        rotation = np.broadcast_to(motion.rotation, rotation.shape)
    balls, races = motion_map(solution, [contact]).bodies(orbit, rotation)
    relative = (balls - races)[0]
    mean = (0.5 * (balls + races))[0]
    hertz = contact.hertz
    ball_curvature = 2.0 / solution.bearing.ball_diameter
    return ContactKinematics(
        entrainment_speed=float(mean[0]),
        entrainment_lateral=float(mean[1]),
        sliding_x=float(relative[0]),
        sliding_y=float(relative[1]),
        spin=float(relative[2]),
        mean_spin=float(mean[2]),
        rolling=float(relative[3]),
        mean_rolling=float(mean[3]),
        curvature_radius=groove_curvature_radius(solution.bearing, contact.race),
        curvature_width=np.inf if hertz is None else hertz.semi_axis_y,
        curvature_difference=0.0 if hertz is None else 1.0 / hertz.radius_x - 2.0 * ball_curvature,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactTraction:
    """Traction of one contact of a bearing, and the motion it belongs to; `result` has body 1 the
    ball.
    """

    contact: BearingContact
    kinematics: ContactKinematics
    result: TractionResult


def contact_traction(
    solution: QuasistaticSolution,
    contact: BearingContact,
    film: ContactSolution,
    rheology: Rheology,
    motion: BallMotion | None = None,
    resistance: float | None = None,
) -> ContactTraction:
    """Forces and moments of one contact, integrated over its film on at most `TRACTION_POINTS`.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    contact : BearingContact
        one of its contacts
    film : ContactSolution
        film of the contact's conditions [m], [Pa]
    rheology : Rheology
        shear law of the oil
    motion : BallMotion | None, optional
        motion of the ball [rad/s]; None: that of the equilibrium
    resistance : float | None, optional
        moment that resists rolling [N m]; None: that of the film's oil up to the meniscus

    Returns
    -------
    ContactTraction
        traction of the contact, body 1 the ball
    """
    kinematics = bearing_kinematics(solution, contact, motion)
    result = integrate_traction(
        film.thinned(TRACTION_POINTS),
        kinematics,
        rheology,
        temperature=solution.operation.temperature,
        rolling_resistance=rolling_moment(film).value if resistance is None else resistance,
    )
    return ContactTraction(contact=contact, kinematics=kinematics, result=result)
