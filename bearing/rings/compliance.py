r"""What the forces of the balls move at each other's places: structural compliance of the rings.

A force F_k = (x, r) of ball k on a ring moves the centre of its groove at ball j by C_jk F_k,
beyond what Hertz' theory gives at the ball itself. V, the distance of the grooves' centres, then
is that of rigid rings and

.. math:: e = C_i F_i - C_o F_o, \qquad F_o = -F_i + F_c e_r

with the centrifugal force F_c that a ball adds on its way to the outer ring. C depends on the
angle between two balls alone; a row of balls does not feel the others.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ehl.solid import bodies

from ..geometry import Array
from .elastic_ring import ElasticRing, ElasticRings


class RingCompliance(NamedTuple):
    """Compliance of the rings between all balls, shape (2, N, N), axial and radial [m/N]."""

    inner: Array
    outer: Array

    def shift(self, inner_force: Array, centrifugal: Array) -> Array:
        """What the rings yield, from outer to inner groove centre, shape (2, N) [m]; forces of
        the balls on the inner ring (x, r), shape (2, N), and of their motion, shape (N,) [N].
        """
        inner, outer = self.deflections(inner_force, centrifugal)
        return inner - outer

    def deflections(self, inner_force: Array, centrifugal: Array) -> tuple[Array, Array]:
        """Movement of the groove's centre of the inner and the outer ring, (x, r) each, shape (2,
        N) [m].
        """
        outer_force = -inner_force
        outer_force[1] += centrifugal
        return (
            np.einsum("vjk,vk->vj", self.inner, inner_force),
            np.einsum("vjk,vk->vj", self.outer, outer_force),
        )

    def derivative(self, ring_dV: Array) -> Array:
        """d(shift)/dV of the derivatives of the forces (x, r, couple, centrifugal) by V, shape (4,
        2, N) [N/m]; shape (2, N, 2, N) [-].
        """
        both = np.einsum("vjk,vwk->vjwk", self.inner + self.outer, ring_dV[:2])
        both[1] -= np.einsum("jk,wk->jwk", self.outer[1], ring_dV[3])
        return both


@lru_cache(maxsize=16)
def response_of(ring: ElasticRing) -> bodies.RingResponse:
    """Displacement of a ring under unit forces, computed once a process."""
    return bodies.ring_response(
        ring.profile, ring.elasticity, ring.seat, ring.contact_angle, ring.cells
    )


def ring_compliance(rings: ElasticRings, azimuths: Array, balls: int) -> RingCompliance:
    """Compliance of the rings between balls at azimuths [rad], rows of `balls` each [m/N]."""
    row = np.arange(azimuths.size) // balls
    together = row[:, None] == row[None, :]
    angles = azimuths[:, None] - azimuths[None, :]
    # balls are evenly spaced: differences by their number, equal to the last bit
    steps = np.rint(angles * balls / (2.0 * np.pi)).astype(np.int64) % balls
    steps = np.minimum(steps, balls - steps)
    matrices = []
    for ring in (rings.inner, rings.outer):
        matrix = np.zeros((2, azimuths.size, azimuths.size))
        if ring is not None:
            entries = response_of(ring).at(2.0 * np.pi * np.arange(balls // 2 + 1) / balls)
            matrix = np.where(together, entries[:, steps], 0.0)
        matrices.append(matrix)
    return RingCompliance(*matrices)
