"""Displacement of elastic rings on their seats under all balls of an equilibrium."""

from dataclasses import replace
from math import cos, sin

import numpy as np

from ehl.arrays import Array
from ehl.solid.bodies.ring import RingField, ring_field

from ..geometry import Race
from ..rings.compliance import response_of, ring_compliance
from .solution import QuasistaticSolution


def ring_displacements(state: QuasistaticSolution, race: Race) -> tuple[RingField, ...]:
    """Displacement of the ring of each row, the middle of its groove at x = 0.

    Without the movement of the ring as a whole.

    Parameters
    ----------
    state : QuasistaticSolution
        equilibrium of the bearing
    race : Race
        raceway of the ring

    Returns
    -------
    tuple[RingField, ...]
        field of each row [m]; empty if the ring is no elastic body
    """
    rings = state.model.rings
    ring = None if rings is None else getattr(rings, race.value)
    if ring is None:
        return ()
    response = response_of(ring)
    loads = _loads(ball_forces(state, race), race, ring.contact_angle)
    balls = state.bearing.balls
    rows = [slice(first, first + balls) for first in range(0, state.azimuth.size, balls)]
    if not ring.supports:
        return tuple(ring_field(response, state.azimuth[row], loads[:, row]) for row in rows)
    pressed, movements = seat_reactions(state, race)
    outward = pressed if race is Race.INNER else -pressed
    fields = []
    for row, force, move in zip(rows, outward, movements, strict=True):
        turns = np.concatenate([state.azimuth[row], ring.supports])
        both = np.zeros((4, turns.size))
        both[:3, :balls] = loads[:, row]
        both[3, balls:] = force
        field = ring_field(response, turns, both)
        fields.append(replace(field, displacement=field.displacement + np.array([0.0, *move])))
    return tuple(fields)


def seat_reactions(state: QuasistaticSolution, race: Race) -> tuple[Array, Array]:
    """Forces of the supports of a split seat on the ring of each row, and its movement as a whole.

    Parameters
    ----------
    state : QuasistaticSolution
        equilibrium of the bearing
    race : Race
        raceway of the ring

    Returns
    -------
    pressed
        forces, shape (rows, supports); no rows for other seats [N]
    moved
        movement (y, z), shape (rows, 2) [m]
    """
    rings = state.model.rings
    ring = None if rings is None else getattr(rings, race.value)
    if rings is None or ring is None or not ring.supports:
        return np.zeros((0, 0)), np.zeros((0, 2))
    angle = state.inner_contact_angle if race is Race.INNER else state.outer_contact_angle
    directions = np.stack([np.sin(angle), np.cos(angle)])
    groove = getattr(ring_compliance(rings, state.azimuth, state.bearing.balls), race.value)
    pressed, movements = groove.reactions(ball_forces(state, race), directions)
    return pressed.reshape(-1, len(ring.supports)), movements


def ball_forces(state: QuasistaticSolution, race: Race) -> Array:
    """Forces of the balls on a ring.

    Parameters
    ----------
    state : QuasistaticSolution
        equilibrium of the bearing
    race : Race
        raceway of the ring

    Returns
    -------
    Array
        forces (x, r), shape (2, N) [N]
    """
    s, c = np.sin(state.inner_contact_angle), np.cos(state.inner_contact_angle)
    axial = state.inner_load * s + state.inner_friction * c
    radial = state.inner_load * c - state.inner_friction * s
    if race is Race.INNER:
        return -np.stack([axial, radial])
    return np.stack([axial, radial + state.centrifugal_force])


def _loads(force: Array, race: Race, angle: float) -> Array:
    """Loads at the bottom of the groove, at a contact angle and its mirror image that move and
    open the groove as forces do, shape (3, N) [N].
    """
    size = np.hypot(*force)
    axial = force[0] / sin(angle)
    opening = axial**2 / np.where(size > 0.0, size, 1.0)
    inward = -force[1] if race is Race.INNER else force[1]
    bottom = inward - opening * cos(angle)
    return np.stack([bottom, 0.5 * (opening + axial), 0.5 * (opening - axial)])
