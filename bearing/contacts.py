"""The contacts of a solved bearing as lubricated contacts, placed in the bearing's frame.

At a contact n points from the ball into the race, x along the entrainment and y across, x cross y = n. The outer
contact lies at (sin ao, cos ao e_r) from the ball's centre, the inner one opposite to (sin ai, cos ai e_r).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehl.conditions import ContactConditions
from ehl.hertz import HertzContact, hertz_contact
from ehl.lubricant import Lubricant

from .geometry import Array, Race, contact_modulus, reduced_radii
from .operation import BallKinematics, Curvature
from .quasistatic import QuasistaticSolution
from .rows import row_directions

STANDSTILL = 1.0e-12  # entrainment or rolling over the speed of the rings below which there is none [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class BearingContact:
    """Contact of one ball with one race.

    Attributes
    ----------
    ball : int
        Number of the ball, from 1, counted through all rows.
    azimuth : float
        [rad].
    race : Race
    conditions : ContactConditions or None
        What the film solver needs; None where the contact is unloaded or nothing entrains oil.
    hertz : HertzContact or None
        The dry contact; None where unloaded.
    load : float
        [N].
    contact_angle : float
        [rad].
    spin_roll_ratio : float or None
        Magnitude of relative spin over relative rolling [-].
    hirano_ratio : float or None
        Qi sin(ai)/Fc [-], at inner races; None at outer ones and without centrifugal force.
    origin : ndarray, shape (3,)
        Contact point in the bearing's frame [m].
    axis_x, axis_y, normal : ndarray, shape (3,)
        Entrainment, transverse direction and normal into the race [-].
    note : str
        Why there are no conditions; empty where there are.
    row : int
        Number of the ball's row, from 1.
    """

    ball: int
    azimuth: float
    race: Race
    conditions: ContactConditions | None
    hertz: HertzContact | None
    load: float
    contact_angle: float
    spin_roll_ratio: float | None
    hirano_ratio: float | None
    origin: Array
    axis_x: Array
    axis_y: Array
    normal: Array
    note: str = ""
    row: int = 1

    @property
    def loaded(self) -> bool:
        """Whether the film of this contact can be solved."""
        return self.conditions is not None


def contact_conditions(solution: QuasistaticSolution, lubricant: Lubricant) -> tuple[BearingContact, ...]:
    """All contacts of a bearing, row by row and ball by ball, inner then outer, 2 Z entries a row.

    Parameters
    ----------
    solution : QuasistaticSolution
        Loads in [N], angles in [rad], speeds in [rad/s].
    lubricant : Lubricant

    Returns
    -------
    tuple of BearingContact
    """
    return tuple(
        _contact(solution, index, race, lubricant)
        for index in range(solution.azimuth.size)
        for race in (Race.INNER, Race.OUTER)
    )


def rolling_and_spin(solution: QuasistaticSolution, index: int, race: Race) -> tuple[float, float, float]:
    """Motion of ball against race at a contact (Harris and Kotzalas, re-derived).

    Parameters
    ----------
    solution : QuasistaticSolution
    index : int
        Of the ball, from 0.
    race : Race

    Returns
    -------
    speed : float
        Surface speed of the race at the contact's centre in the frame of the orbit, along +e_t [m/s]; under a
        hypothesis that of the ball as well.
    rolling : float
        Relative angular speed about the transverse direction, magnitude [rad/s].
    spin : float
        Angular speed of the ball relative to the race about the normal into the race [rad/s].
    """
    bearing, operation = solution.bearing, solution.operation
    inner = race is Race.INNER
    angle = float((solution.inner_contact_angle if inner else solution.outer_contact_angle)[index])
    side = -1.0 if inner else 1.0  # the outer contact is farther from the axis than the ball
    relative = (operation.inner_speed if inner else operation.outer_speed) - float(solution.orbit_speed[index])
    radius = 0.5 * (bearing.pitch_diameter + side * bearing.ball_diameter * np.cos(angle))
    ball = float(solution.spin_speed[index])
    lag = float(solution.attitude[index]) - angle
    spin = side * (ball * np.sin(lag) - relative * np.sin(angle)) + 0.0  # no negative zero
    rolling = abs(ball * np.cos(lag) + relative * np.cos(angle))
    return float(relative * radius), float(rolling), float(spin)


def sliding(solution: QuasistaticSolution, index: int, race: Race) -> tuple[float, float]:
    """Speed of the ball over the race at a contact's centre along +e_t and along e_t x n [m/s].

    The ball's surface moves by omega x n D/2. Zero under a hypothesis, which lets nothing slide there.
    """
    if solution.model.ball_kinematics is not BallKinematics.TRACTION_EQUILIBRIUM:
        return 0.0, 0.0
    inner = race is Race.INNER
    angle = float((solution.inner_contact_angle if inner else solution.outer_contact_angle)[index])
    side, radius = -1.0 if inner else 1.0, 0.5 * solution.bearing.ball_diameter
    turning = float(solution.spin_speed[index]) * np.cos(float(solution.attitude[index]) - angle)
    along = -side * radius * turning - rolling_and_spin(solution, index, race)[0]
    return float(along), radius * float(solution.pivot_speed[index])


def mean_spin(solution: QuasistaticSolution, index: int, race: Race) -> float:
    """Mean angular speed of ball and race about the normal into the race, in the frame of the orbit [rad/s]."""
    inner, operation = race is Race.INNER, solution.operation
    angle = float((solution.inner_contact_angle if inner else solution.outer_contact_angle)[index])
    side = -1.0 if inner else 1.0
    relative = (operation.inner_speed if inner else operation.outer_speed) - float(solution.orbit_speed[index])
    ball = float(solution.spin_speed[index]) * np.sin(float(solution.attitude[index]) - angle)
    return float(0.5 * side * (ball + relative * np.sin(angle))) + 0.0  # no negative zero


def _contact(solution: QuasistaticSolution, index: int, race: Race, lubricant: Lubricant) -> BearingContact:
    inner = race is Race.INNER
    load = float((solution.inner_load if inner else solution.outer_load)[index])
    angle = float((solution.inner_contact_angle if inner else solution.outer_contact_angle)[index])
    raced, rolling, spin = rolling_and_spin(solution, index, race)
    slide, across = sliding(solution, index, race)
    speed = raced + 0.5 * slide
    hertz = _hertz(solution, race, load, angle)
    motion = (speed, spin, mean_spin(solution, index, race), slide, -np.sign(speed) * across)
    conditions, note = _conditions(solution, hertz, motion, lubricant)
    origin, axes = _placement(solution, index, race, speed)
    centrifugal = float(solution.centrifugal_force[index])
    return BearingContact(
        ball=index + 1,
        azimuth=float(solution.azimuth[index]),
        race=race,
        conditions=conditions,
        hertz=hertz,
        load=load,
        contact_angle=angle,
        spin_roll_ratio=abs(spin) / rolling if rolling > STANDSTILL * _fastest(solution) else None,
        hirano_ratio=load * abs(float(np.sin(angle))) / centrifugal if inner and centrifugal > 0.0 else None,
        origin=origin,
        axis_x=axes[0],
        axis_y=axes[1],
        normal=axes[2],
        note=note,
        row=index // solution.bearing.balls + 1,
    )


def _hertz(solution: QuasistaticSolution, race: Race, load: float, angle: float) -> HertzContact | None:
    """The dry contact with the curvature the equilibrium was solved with."""
    if load <= 0.0:
        return None
    bearing = solution.bearing
    at = bearing.free_contact_angle if solution.model.curvature is Curvature.FREE else angle
    return hertz_contact(load, *reduced_radii(bearing, race, at), contact_modulus(bearing, race))


def _conditions(
    solution: QuasistaticSolution, hertz: HertzContact | None, motion: tuple[float, ...], lubricant: Lubricant
) -> tuple[ContactConditions | None, str]:
    if hertz is None:
        return None, "unloaded"
    speed, spin = abs(motion[0]), motion[1]
    if speed <= STANDSTILL * _fastest(solution) * solution.bearing.pitch_diameter:
        return None, "no entrainment: ball and race move as one"
    return ContactConditions(
        load=hertz.load,
        radius_x=hertz.radius_x,
        radius_y=hertz.radius_y,
        reduced_modulus=hertz.reduced_modulus,
        entrainment_speed=speed,
        lubricant=lubricant,
        spin=spin,
        mean_spin=motion[2],
        slide_roll_ratio=motion[3] / motion[0],
        lateral_slide_ratio=motion[4] / speed,
    ), ""


def _fastest(solution: QuasistaticSolution) -> float:
    """Speed of the faster ring [rad/s]."""
    return max(abs(solution.operation.inner_speed), abs(solution.operation.outer_speed))


def _placement(solution: QuasistaticSolution, index: int, race: Race, speed: float) -> tuple[Array, Array]:
    """Contact point [m], and the rows x, y, n [-], in the bearing's frame."""
    c, s = row_directions(solution.bearing, solution.rows)[:, index]
    radial, tangential = np.array([0.0, c, s]), np.array([0.0, -s, c])
    inner = race is Race.INNER
    angle = (solution.inner_contact_angle if inner else solution.outer_contact_angle)[index]
    side = -1.0 if inner else 1.0
    normal = side * (np.sin(angle) * np.array([1.0, 0.0, 0.0]) + np.cos(angle) * radial)
    forward = np.sign(speed) if speed != 0.0 else -side
    axis_x = forward * tangential
    centre = solution.ball_axial[index] * np.array([1.0, 0.0, 0.0]) + solution.ball_radial[index] * radial
    origin = centre + 0.5 * solution.bearing.ball_diameter * normal
    return origin, np.stack([axis_x, np.cross(normal, axis_x), normal])
