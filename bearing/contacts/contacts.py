"""The contacts of a solved bearing as lubricated contacts, placed in the bearing's frame.

At a contact n points from the ball into the race, x along the entrainment and y across, x cross y
= n. The outer contact lies at (sin ao, cos ao e_r) from the ball's centre, the inner one opposite
to (sin ai, cos ai e_r).
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ehl.closed_form.hertz import HertzContact
from ehl.conditions import ContactConditions
from ehl.oil.lubricant import Lubricant

from ..geometry import Array, Race, contact_modulus, reduced_radii
from ..operation import BallKinematics, Curvature
from ..quasistatic.solution import QuasistaticSolution
from ..rows import row_directions
from .hertz import hertz_contacts

RACES = (Race.INNER, Race.OUTER)
# entrainment or rolling over the speed of the rings below which there is none [-]
STANDSTILL = 1.0e-12


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


def contact_conditions(
    solution: QuasistaticSolution, lubricant: Lubricant
) -> tuple[BearingContact, ...]:
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
    balls = range(solution.azimuth.size)
    motions = [_motion(solution, index, race) for index in balls for race in RACES]
    frames = _placements(solution, np.array([motion.speed for motion in motions]).reshape(-1, 2))
    return tuple(
        _contact(solution, (n // 2, RACES[n % 2]), motion, hertz, frame, lubricant)
        for n, (motion, hertz, frame) in enumerate(
            zip(motions, _hertz(solution), frames, strict=True)
        )
    )


def rolling_and_spin(
    solution: QuasistaticSolution, index: int, race: Race
) -> tuple[float, float, float]:
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
        Surface speed of the race at the contact's centre in the frame of the orbit, along +e_t
        [m/s]; under a hypothesis that of the ball as well.
    rolling : float
        Relative angular speed about the transverse direction, magnitude [rad/s].
    spin : float
        Angular speed of the ball relative to the race about the normal into the race [rad/s].
    """
    bearing, operation = solution.bearing, solution.operation
    inner = race is Race.INNER
    angle = float((solution.inner_contact_angle if inner else solution.outer_contact_angle)[index])
    side = -1.0 if inner else 1.0  # the outer contact is farther from the axis than the ball
    relative = (operation.inner_speed if inner else operation.outer_speed) - float(
        solution.orbit_speed[index]
    )
    radius = 0.5 * (bearing.pitch_diameter + side * bearing.ball_diameter * np.cos(angle))
    ball = float(solution.spin_speed[index])
    lag = float(solution.attitude[index]) - angle
    spin = side * (ball * np.sin(lag) - relative * np.sin(angle)) + 0.0  # no negative zero
    rolling = abs(ball * np.cos(lag) + relative * np.cos(angle))
    return float(relative * radius), float(rolling), float(spin)


def sliding(solution: QuasistaticSolution, index: int, race: Race) -> tuple[float, float]:
    """Speed of the ball over the race at a contact's centre along +e_t and along e_t x n [m/s].

    The ball's surface moves by omega x n D/2. Zero under a hypothesis, which lets nothing slide
    there.
    """
    if solution.model.ball_kinematics is not BallKinematics.TRACTION_EQUILIBRIUM:
        return 0.0, 0.0
    inner = race is Race.INNER
    angle = float((solution.inner_contact_angle if inner else solution.outer_contact_angle)[index])
    side = -1.0 if inner else 1.0
    radius = 0.5 * solution.bearing.ball_diameter
    turning = float(solution.spin_speed[index]) * np.cos(float(solution.attitude[index]) - angle)
    along = -side * radius * turning - rolling_and_spin(solution, index, race)[0]
    return float(along), radius * float(solution.pivot_speed[index])


def mean_spin(solution: QuasistaticSolution, index: int, race: Race) -> float:
    """Mean angular speed of ball and race about the normal into the race, in the frame of the
    orbit [rad/s].
    """
    inner = race is Race.INNER
    operation = solution.operation
    angle = float((solution.inner_contact_angle if inner else solution.outer_contact_angle)[index])
    side = -1.0 if inner else 1.0
    relative = (operation.inner_speed if inner else operation.outer_speed) - float(
        solution.orbit_speed[index]
    )
    ball = float(solution.spin_speed[index]) * np.sin(float(solution.attitude[index]) - angle)
    return float(0.5 * side * (ball + relative * np.sin(angle))) + 0.0  # no negative zero


class _Motion(NamedTuple):
    """Of ball against race at a contact."""

    speed: float  # entrainment along e_t [m/s]
    rolling: float  # [rad/s]
    spin: float  # [rad/s]
    mean_spin: float  # [rad/s]
    slide: float  # of the ball over the race along e_t [m/s]
    across: float  # and along y [m/s]


def _motion(solution: QuasistaticSolution, index: int, race: Race) -> _Motion:
    raced, rolling, spin = rolling_and_spin(solution, index, race)
    slide, across = sliding(solution, index, race)
    speed = raced + 0.5 * slide
    return _Motion(
        speed, rolling, spin, mean_spin(solution, index, race), slide, -np.sign(speed) * across
    )


def _contact(
    solution: QuasistaticSolution,
    place: tuple[int, Race],
    motion: _Motion,
    hertz: HertzContact | None,
    axes: tuple[Array, Array],
    lubricant: Lubricant,
) -> BearingContact:
    (index, race), (origin, rows) = place, axes
    inner = race is Race.INNER
    load = float((solution.inner_load if inner else solution.outer_load)[index])
    angle = float((solution.inner_contact_angle if inner else solution.outer_contact_angle)[index])
    conditions, note = _conditions(solution, hertz, motion, lubricant)
    centrifugal = float(solution.centrifugal_force[index])
    rolls = motion.rolling > STANDSTILL * _fastest(solution)
    return BearingContact(
        ball=index + 1,
        azimuth=float(solution.azimuth[index]),
        race=race,
        conditions=conditions,
        hertz=hertz,
        load=load,
        contact_angle=angle,
        spin_roll_ratio=abs(motion.spin) / motion.rolling if rolls else None,
        hirano_ratio=load * abs(float(np.sin(angle))) / centrifugal
        if inner and centrifugal > 0.0
        else None,
        origin=origin,
        axis_x=rows[0],
        axis_y=rows[1],
        normal=rows[2],
        note=note,
        row=index // solution.bearing.balls + 1,
    )


def _hertz(solution: QuasistaticSolution) -> list[HertzContact | None]:
    """The dry contacts, inner then outer, ball by ball, with the curvature the equilibrium was
    solved with.
    """
    bearing = solution.bearing
    free = solution.model.curvature is Curvature.FREE
    load = np.stack([solution.inner_load, solution.outer_load], axis=1).ravel()
    angle = np.stack([solution.inner_contact_angle, solution.outer_contact_angle], axis=1).ravel()
    loaded = np.flatnonzero(load > 0.0)
    found: list[HertzContact | None] = [None] * load.size
    races = [RACES[n % 2] for n in loaded]
    at = [bearing.free_contact_angle if free else float(angle[n]) for n in loaded]
    radii = np.array(
        [reduced_radii(bearing, race, a) for race, a in zip(races, at, strict=True)]
    ).reshape(-1, 2)
    modulus = {race: contact_modulus(bearing, race) for race in RACES}
    contacts = hertz_contacts(
        load[loaded], radii[:, 0], radii[:, 1], np.array([modulus[race] for race in races])
    )
    for n, contact in zip(loaded, contacts, strict=True):
        found[n] = contact
    return found


def _conditions(
    solution: QuasistaticSolution,
    hertz: HertzContact | None,
    motion: _Motion,
    lubricant: Lubricant,
) -> tuple[ContactConditions | None, str]:
    if hertz is None:
        return None, "unloaded"
    speed = abs(motion.speed)
    if speed <= STANDSTILL * _fastest(solution) * solution.bearing.pitch_diameter:
        return None, "no entrainment: ball and race move as one"
    return ContactConditions(
        load=hertz.load,
        radius_x=hertz.radius_x,
        radius_y=hertz.radius_y,
        reduced_modulus=hertz.reduced_modulus,
        entrainment_speed=speed,
        lubricant=lubricant,
        spin=motion.spin,
        mean_spin=motion.mean_spin,
        slide_roll_ratio=motion.slide / motion.speed,
        lateral_slide_ratio=motion.across / speed,
    ), ""


def _fastest(solution: QuasistaticSolution) -> float:
    """Speed of the faster ring [rad/s]."""
    return max(abs(solution.operation.inner_speed), abs(solution.operation.outer_speed))


def _placements(solution: QuasistaticSolution, speed: Array) -> list[tuple[Array, Array]]:
    """Contact points [m], and the rows x, y, n [-], in the bearing's frame, at entrainments
    (balls, 2) [m/s].
    """
    c, s = row_directions(solution.bearing, solution.rows)
    none = np.zeros_like(c)
    along_x = np.array([1.0, 0.0, 0.0])
    side = np.array([-1.0, 1.0])
    radial = np.stack([none, c, s], axis=1)[:, None]
    tangential = np.stack([none, -s, c], axis=1)[:, None]
    angle = np.stack([solution.inner_contact_angle, solution.outer_contact_angle], axis=1)[
        ..., None
    ]
    normal = side[:, None] * (np.sin(angle) * along_x + np.cos(angle) * radial)
    axis_x = np.where(speed != 0.0, np.sign(speed), -side)[..., None] * tangential
    centre = (
        solution.ball_axial[:, None, None] * along_x + solution.ball_radial[:, None, None] * radial
    )
    origins = (centre + 0.5 * solution.bearing.ball_diameter * normal).reshape(-1, 3)
    axes = np.stack([axis_x, np.cross(normal, axis_x), normal], axis=2).reshape(-1, 3, 3)
    return list(zip(origins, axes, strict=True))
