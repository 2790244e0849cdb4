"""Displacement of elastic rings on their seats under all balls of an equilibrium."""

from math import cos, sin

import numpy as np

from ehl.solid.bodies.ring_field import RingField, ring_field

from ..geometry import Array, Race
from ..rings.compliance import response_of
from .solution import QuasistaticSolution


def ring_displacements(state: QuasistaticSolution, race: Race) -> tuple[RingField, ...]:
    """Displacement of the ring of each row, the middle of its groove at x = 0; empty, if it is no
    elastic body. Without the movement of the ring as a whole.
    """
    rings = state.model.rings
    ring = None if rings is None else getattr(rings, race.value)
    if ring is None:
        return ()
    response = response_of(ring)
    loads = _loads(ball_forces(state, race), race, ring.contact_angle)
    balls = state.bearing.balls
    rows = [slice(first, first + balls) for first in range(0, state.azimuth.size, balls)]
    return tuple(ring_field(response, state.azimuth[row], loads[:, row]) for row in rows)


def ball_forces(state: QuasistaticSolution, race: Race) -> Array:
    """Forces of the balls on a ring (x, r), shape (2, N) [N]."""
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
