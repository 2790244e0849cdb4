"""The contacts of a solved bearing as lubricated contacts."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.closed_form.film import MAX_FILM_OVER_RADIUS, film_nijenbanning_central
from oilfilm.ehl.closed_form.hertz import HertzContact
from oilfilm.ehl.conditions import ContactConditions
from oilfilm.ehl.oil.lubricant import Lubricant

from ..geometry import Race, contact_modulus, reduced_radii, ring_material, row_directions
from ..operation import BallKinematics, Curvature
from ..quasistatic.solution import QuasistaticSolution
from .contact import DRY_NOTE, RACES, BearingContact, hertz_contacts
from .motion import BearingContacts, motion_map_of_axes

# entrainment or rolling over the speed of the rings below which there is none [-]
STANDSTILL = 1.0e-12
# load over that of the heaviest contact, below which one whose film is outside the model is left
# out: the six of a 6205 at 3800 r/min, just thin enough, have 1.9 % of the rolling moments
NEGLIGIBLE_LOAD = 0.02
SIDES = np.array([-1.0, 1.0])  # of the inner and the outer contact, from the ball's centre [-]


def contact_conditions(
    solution: QuasistaticSolution, lubricant: Lubricant, *, thick: bool = False
) -> tuple[BearingContact, ...]:
    """All contacts of a bearing as lubricated contacts.

    Parameters
    ----------
    solution : QuasistaticSolution
        Equilibrium of the bearing.
    lubricant : Lubricant
        The oil.
    thick : bool
        Whether light contacts on films outside the model keep their conditions.

    Returns
    -------
    tuple of BearingContact
        `BearingContacts`: row by row and ball by ball, inner then outer, 2 Z entries a row.

    Examples
    --------
    >>> import oilfilm
    >>> operation = oilfilm.Operation(inner_speed=300.0, force=(0.0, 3000.0, 0.0))
    >>> state = oilfilm.solve_quasistatic(oilfilm.load_bearing("6208"), operation)
    >>> oil = oilfilm.load_lubricant("iso vg 68", operation.temperature)
    >>> contacts = oilfilm.contact_conditions(state, oil)
    >>> loaded = [contact for contact in contacts if contact.hertz is not None]
    >>> heaviest = max(loaded, key=lambda contact: contact.hertz.load)
    >>> heaviest.race.value, f"{heaviest.hertz.load:.0f} N"
    ('outer', '1572 N')
    """
    motions = _motions(solution)
    heaviest = float(max(solution.inner_load.max(), solution.outer_load.max()))
    light = 0.0 if thick else NEGLIGIBLE_LOAD * heaviest
    frames = _placements(solution, np.array([motion.speed for motion in motions]).reshape(-1, 2))
    parts = zip(motions, _hertz(solution), frames, strict=True)
    return BearingContacts.of(
        solution,
        (
            _contact(solution, (n // 2, RACES[n % 2]), motion, hertz, frame, (lubricant, light))
            for n, (motion, hertz, frame) in enumerate(parts)
        ),
    )


def with_oil(
    solution: QuasistaticSolution, contacts: tuple[BearingContact, ...], lubricant: Lubricant
) -> tuple[BearingContact, ...]:
    """Contacts of a solution as `contact_conditions` computes them, from those with another oil.

    Parameters
    ----------
    solution : QuasistaticSolution
        Equilibrium of the bearing.
    contacts : tuple of BearingContact
        Its contacts with another oil.
    lubricant : Lubricant
        The oil.

    Returns
    -------
    tuple of BearingContact
        Computed anew where the oil decides whether one of them has a film.
    """
    if all(own.conditions is None or own.conditions.lubricant == lubricant for own in contacts):
        return contacts
    light = NEGLIGIBLE_LOAD * max(solution.inner_load.max(), solution.outer_load.max())
    light_films = (contact.hertz is not None and contact.load < light for contact in contacts)
    if any(light_films) or any(contact.gap is not None for contact in contacts):
        return contact_conditions(solution, lubricant)
    return BearingContacts.of(
        solution,
        (
            contact
            if (existing := contact.conditions) is None
            else replace(contact, conditions=replace(existing, lubricant=lubricant))
            for contact in contacts
        ),
    )


class _Motion(NamedTuple):
    """Motion of ball against race at a contact, x along the entrainment."""

    speed: float  # entrainment along e_t [m/s]
    rolling: float  # magnitude [rad/s]
    spin: float  # [rad/s]
    mean_spin: float  # [rad/s]
    slide: float  # of the ball over the race along e_t [m/s]
    across: float  # and along y [m/s]


def _motions(solution: QuasistaticSolution) -> list[_Motion]:
    """Motions of all contacts; under a hypothesis nothing slides at their centres."""
    angle = np.stack([solution.inner_contact_angle, solution.outer_contact_angle], axis=1).ravel()
    side = np.tile(SIDES, solution.azimuth.size)
    zero, one = np.zeros_like(angle), np.ones_like(angle)
    balls = np.repeat(np.arange(solution.azimuth.size), 2)
    # in the frame turned by the contact angle the ball's spin about n is w sin(beta - angle),
    # without the cancellation of two larger terms
    axle = np.stack([np.cos(angle), np.sin(angle), zero], axis=1)
    along = np.stack([zero, zero, one], axis=1)
    normal = np.stack([zero, side, zero], axis=1)
    across = np.stack([side, zero, zero], axis=1)
    axes = np.stack([along, across, normal], axis=1)
    spin = solution.spin_speed[balls]
    lag = solution.attitude[balls] - angle
    rotation = [-spin * np.cos(lag), spin * np.sin(lag), solution.pivot_speed[balls]]
    kinematics = motion_map_of_axes(solution, side < 0.0, angle, axes, axle, balls)
    ball, race = kinematics.bodies_at(solution.orbit_speed[balls], np.stack(rotation, axis=1))
    relative = ball - race
    slide, lateral = relative[:, 0], relative[:, 1]
    if solution.model.ball_kinematics is not BallKinematics.TRACTION_EQUILIBRIUM:
        slide, lateral = zero, zero
    speed = race[:, 0] + 0.5 * slide
    mean_spin = 0.5 * (ball[:, 2] + race[:, 2])
    rolling = np.abs(relative[:, 3])
    spins = (relative[:, 2] + 0.0, mean_spin + 0.0)  # no negative zero
    columns = [speed, rolling, *spins, slide, np.sign(speed) * lateral]
    return [_Motion(*row) for row in np.stack(columns, axis=1).tolist()]


def entrainment_speeds(solution: QuasistaticSolution) -> list[float]:
    """Mean speeds of ball and race at the contacts of an equilibrium.

    Parameters
    ----------
    solution : QuasistaticSolution
        Equilibrium of the bearing.

    Returns
    -------
    list of float
        Of all contacts, ball by ball, inner then outer [m/s].
    """
    return [abs(motion.speed) for motion in _motions(solution)]


def _contact(
    solution: QuasistaticSolution,
    number: tuple[int, Race],
    motion: _Motion,
    hertz: HertzContact | None,
    axes: tuple[Array, Array],
    oil: tuple[Lubricant, float],
) -> BearingContact:
    """One of them; `oil`: with the load under which a thick film is left out [N]."""
    (index, race), (origin, rows) = number, axes
    inner = race is Race.INNER
    load = float((solution.inner_load if inner else solution.outer_load)[index])
    angle = float((solution.inner_contact_angle if inner else solution.outer_contact_angle)[index])
    conditions, note = _conditions(solution, hertz, motion, *oil)
    centrifugal = float(solution.centrifugal_force[index])
    rolls = motion.rolling > STANDSTILL * _fastest(solution)
    pulled = inner and centrifugal > 0.0
    return BearingContact(
        ball=index + 1,
        azimuth=float(solution.azimuth[index]),
        race=race,
        conditions=conditions,
        hertz=hertz,
        load=load,
        contact_angle=angle,
        spin_roll_ratio=abs(motion.spin) / motion.rolling if rolls else None,
        hirano_ratio=load * abs(float(np.sin(angle))) / centrifugal if pulled else None,
        origin=origin,
        axis_x=rows[0],
        axis_y=rows[1],
        normal=rows[2],
        effusivities=(
            solution.bearing.ball_material.effusivity,
            ring_material(solution.bearing, race).effusivity,
        ),
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
    contacts: list[HertzContact | None] = [None] * load.size
    angles = [bearing.free_contact_angle if free else float(angle[n]) for n in loaded]
    pairs = [(RACES[n % 2], a) for n, a in zip(loaded, angles, strict=True)]
    radii = np.array([reduced_radii(bearing, race, a) for race, a in pairs]).reshape(-1, 2)
    modulus = np.array([contact_modulus(bearing, race) for race in RACES])[loaded % 2]
    dry = hertz_contacts(load[loaded], radii[:, 0], radii[:, 1], modulus)
    for n, contact in zip(loaded, dry, strict=True):
        contacts[n] = contact
    return contacts


def _conditions(
    solution: QuasistaticSolution,
    hertz: HertzContact | None,
    motion: _Motion,
    lubricant: Lubricant,
    light: float,
) -> tuple[ContactConditions | None, str]:
    if hertz is None:
        return None, "unloaded"
    if lubricant.dry:
        return None, DRY_NOTE
    speed = abs(motion.speed)
    if speed <= STANDSTILL * _fastest(solution) * solution.bearing.pitch_diameter:
        return None, "no entrainment: ball and race move as one"
    conditions = ContactConditions(
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
        ball_radius=0.5 * solution.bearing.ball_diameter,
    )
    if hertz.load < light and _floats(conditions):
        thick = f"thicker than {MAX_FILM_OVER_RADIUS:.0%} of Rx, outside the model"
        return None, f"a light load on a film {thick}; its friction is left out"
    return conditions, ""


def _floats(conditions: ContactConditions) -> bool:
    """The film is so thick that the gap is no paraboloid, by a formula that gives 1.2
    times the solved film there.
    """
    film = film_nijenbanning_central(conditions)
    return film > MAX_FILM_OVER_RADIUS * conditions.radius_x


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
    radial = np.stack([none, c, s], axis=1)[:, None]
    tangential = np.stack([none, -s, c], axis=1)[:, None]
    angles = [solution.inner_contact_angle, solution.outer_contact_angle]
    angle = np.stack(angles, axis=1)[..., None]
    normal = SIDES[:, None] * (np.sin(angle) * along_x + np.cos(angle) * radial)
    axis_x = np.where(speed != 0.0, np.sign(speed), -SIDES)[..., None] * tangential
    axial = solution.ball_axial[:, None, None] * along_x
    centre = axial + solution.ball_radial[:, None, None] * radial
    origins = (centre + 0.5 * solution.bearing.ball_diameter * normal).reshape(-1, 3)
    axes = np.stack([axis_x, np.cross(normal, axis_x), normal], axis=2).reshape(-1, 3, 3)
    axes.flags.writeable = False  # of contacts that stand for what is computed of them
    return list(zip(origins, axes, strict=True))
