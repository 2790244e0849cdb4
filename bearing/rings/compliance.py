r"""Structural compliance of the rings: movement of a groove at one ball by another's force.

A force F_k = (x, r) of ball k on a ring moves the centre of its groove at ball j by C_jk F_k,
beyond what Hertz' theory gives at the ball itself. V, the distance of the grooves' centres, then
is that of rigid rings and

.. math:: e = C_i F_i - C_o F_o, \qquad F_o = -F_i + F_c e_r

with the centrifugal force F_c that a ball adds on its way to the outer ring. A groove also opens
(`ehl.solid.bodies.compliance`), by the part q = F_x^2/(|F| sin^2(alpha)) of a force. The energy of
a ring is then a quadratic form of (F_x, F_r, q), with the matrix G, and

.. math:: e = \frac{\partial}{\partial F}\,\tfrac12 \hat F^T G \hat F, \qquad
          \hat F = (F_x, F_r, q)

G depends on the angle between two balls alone; a row of balls does not feel the others.

A seat presses a ring at supports only, and lets go where it would pull. R >= 0 are the forces of
the supports, w = g - S R - E z <= 0 how far the ring is pressed into them, R w = 0, with g the
displacement by the balls towards the supports, S the compliance of the seat, and z the movement of
the ring as a whole, for which :math:`E^T R` balances the balls (Signorini's problem of a discrete
seat). A spring, `CENTRING`, holds the ring across where one support alone presses, as friction
there would; it takes a thousandth of the load at most where two do.

The pressing supports follow from non-negative least squares (Lawson and Hanson, 1974), after which

.. math:: \begin{pmatrix} S & E \\ E^T & -\epsilon \end{pmatrix}
          \begin{pmatrix} R \\ z \end{pmatrix} = D \hat f

is exact, and the groove moves by :math:`-D^T (R, z)` beyond what a loose ring does.
"""

from functools import lru_cache
from math import sin
from typing import NamedTuple

import numpy as np
import scipy

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.solid import bodies
from oilfilm.ehl.solid.bodies.compliance import SeatResponse

from .elastic_ring import ElasticRing, ElasticRings

CENTRING = 1e-3  # of a force to the compliance of the seat: epsilon S [-]


class SeatSupports(NamedTuple):
    """Supports of the seat of a ring under N balls; P supports and two movements for each row."""

    seat: Array  # S, shape (P, P) [m/N]
    by_force: Array  # g of radial forces and opening parts of the balls, shape (P, 2 N) [m/N]
    directions: Array  # E, shape (P, 2 rows) [-]
    balance: Array  # resultant of the balls, towards the supports, shape (2 rows, 2 N) [-]

    def reactions(self, parts: Array) -> tuple[Array, Array]:
        """Forces R of the supports and movement z of the ring under forces of the balls.

        Parameters
        ----------
        parts : Array
            radial forces and opening parts of the balls, shape (2 N,) [N]

        Returns
        -------
        force
            R, shape (P,) [N]
        movement
            z, shape (2 rows,) [m]
        """
        pressing = self._pressing(parts)
        system, load = self._system(pressing)
        solved = np.linalg.solve(system, load @ parts)
        force = np.zeros(len(self.seat))
        force[pressing] = solved[: pressing.sum()]
        return force, np.asarray(solved[pressing.sum() :], dtype=np.float64)

    def taken(self, parts: Array) -> Array:
        """Reduction of the compliance by the supports.

        Parameters
        ----------
        parts : Array
            radial forces and opening parts of the balls, shape (2 N,) [N]

        Returns
        -------
        Array
            reduction, shape (2 N, 2 N) [m/N]
        """
        system, load = self._system(self._pressing(parts))
        return np.asarray(load.T @ np.linalg.solve(system, load))

    def _pressing(self, parts: Array) -> Array:
        """Supports that press, shape (P,)."""
        scale = np.trace(self.seat) / len(self.seat)
        stiff = scale / CENTRING
        matrix = self.seat + stiff * self.directions @ self.directions.T
        right = self.by_force @ parts
        right += stiff * self.directions @ (self.balance @ parts)
        lower = np.linalg.cholesky(matrix)
        return np.asarray(scipy.optimize.nnls(lower.T, np.linalg.solve(lower, right))[0] > 0.0)

    def _system(self, pressing: Array) -> tuple[Array, Array]:
        """Matrix of (R, z), and that of the forces D."""
        directions = self.directions[pressing]
        spring = CENTRING * len(self.seat) / np.trace(self.seat) * np.eye(directions.shape[1])
        seat = self.seat[np.ix_(pressing, pressing)]
        matrix = np.block([[seat, directions], [directions.T, -spring]])
        return matrix, np.vstack([self.by_force[pressing], self.balance])


def seat_supports(
    response: SeatResponse, azimuths: Array, on_balls: tuple[Array, int], outward: float
) -> SeatSupports:
    """Supports at azimuths on the ring of each row.

    Parameters
    ----------
    response : SeatResponse
        response of the ring to forces at its seat
    azimuths : Array
        azimuths of the supports [rad]
    on_balls : tuple[Array, int]
        azimuths of the balls [rad], and the number of balls a row
    outward : float
        1 for an outer, -1 for an inner ring [-]

    Returns
    -------
    SeatSupports
        supports with their compliance
    """
    ball_azimuths, balls = on_balls
    rows = ball_azimuths.size // balls
    seat_azimuths = np.tile(azimuths, rows)
    support_row = np.repeat(np.arange(rows), azimuths.size)
    ball_row = np.arange(ball_azimuths.size) // balls
    _, _, seat = response.at(seat_azimuths[:, None] - seat_azimuths)
    radial, opened, _ = response.at(seat_azimuths[:, None] - ball_azimuths)
    same_row = support_row[:, None] == ball_row
    direction = np.stack([np.cos(seat_azimuths), np.sin(seat_azimuths)], axis=1)
    to_ball = outward * np.stack([np.cos(ball_azimuths), np.sin(ball_azimuths)], axis=1)
    spread = np.zeros((seat_azimuths.size, rows, 2))
    spread[np.arange(seat_azimuths.size), support_row] = direction
    balance = np.zeros((rows, 2, ball_azimuths.size))
    balance[ball_row, :, np.arange(ball_azimuths.size)] = to_ball
    none = np.zeros((2 * rows, ball_azimuths.size))
    return SeatSupports(
        seat=np.where(support_row[:, None] == support_row, 0.5 * (seat + seat.T), 0.0),
        by_force=np.hstack(
            [np.where(same_row, radial, 0.0), np.where(same_row, outward * opened, 0.0)]
        ),
        directions=spread.reshape(seat_azimuths.size, 2 * rows),
        balance=np.hstack([balance.reshape(2 * rows, -1), none]),
    )


class OpeningForce(NamedTuple):
    """The part of forces F (x, r) that opens a groove, and its derivatives."""

    size: Array  # q, shape (N,) [N]
    slope: Array  # dq/dF, shape (2, N) [-]
    curvature: Array  # d2q/dF2, shape (2, 2, N) [1/N]


class GrooveCompliance(NamedTuple):
    """Compliance of a ring between all balls, of its movements and of its opening."""

    entries: Array  # G_xx, G_rr, G_ro, G_oo, shape (4, N, N) [m/N]
    angle: float  # alpha, at which the opening counts as one [rad]
    outward: float  # sign of the radial force that balls press with: 1 outer, -1 inner ring [-]
    supports: SeatSupports | None = None  # of a seat that presses there only

    def opening_force(self, force: Array, V: Array) -> OpeningForce:
        """Opening parts of forces, with their derivatives.

        Parameters
        ----------
        force : Array
            forces (x, r) of the balls, shape (2, N) [N]
        V : Array
            distances of the grooves' centres, the direction of unloaded balls, shape (2, N) [m]

        Returns
        -------
        OpeningForce
            parts that open the groove
        """
        size = np.hypot(*force)
        loaded = size > 0.0
        s, c = np.where(loaded, force, self.outward * V) / np.where(loaded, size, np.hypot(*V))
        scale = sin(self.angle) ** 2
        slope = np.stack([s * (2.0 - s * s), -s * s * c]) / scale
        bend = np.where(loaded, 2.0 - 3.0 * s * s, 0.0) / np.where(loaded, size, 1.0) / scale
        across = np.stack([c, -s])
        return OpeningForce(size * s * s / scale, slope, bend * across[:, None] * across)

    def deflection(self, force: Array, V: Array) -> Array:
        """Movement of the groove's centre at the balls.

        Parameters
        ----------
        force : Array
            forces (x, r) of the balls, shape (2, N) [N]
        V : Array
            distances of the grooves' centres, shape (2, N) [m]

        Returns
        -------
        Array
            movement (x, r), shape (2, N) [m]
        """
        opening_part = self.opening_force(force, V)
        axial, radial, opened, opening = self._matrices(force, opening_part)
        movement = opening_part.slope * (opened.T @ force[1] + opening @ opening_part.size)
        movement[0] += axial @ force[0]
        movement[1] += radial @ force[1] + opened @ opening_part.size
        return np.asarray(movement)

    def derivative(self, force: Array, V: Array) -> Array:
        """Derivative of the deflection by the forces.

        Parameters
        ----------
        force : Array
            forces (x, r) of the balls, shape (2, N) [N]
        V : Array
            distances of the grooves' centres, shape (2, N) [m]

        Returns
        -------
        Array
            d(deflection)/dF, shape (2, N, 2, N) [m/N]
        """
        opening_part = self.opening_force(force, V)
        axial, radial, opened, opening = self._matrices(force, opening_part)
        total = np.einsum("vj,jk,wk->vjwk", opening_part.slope, opening, opening_part.slope)
        total[0, :, 0] += axial
        total[1, :, 1] += radial
        total[1] += np.einsum("jk,wk->jwk", opened, opening_part.slope)
        total[:, :, 1] += np.einsum("vj,kj->vjk", opening_part.slope, opened)
        balls = np.arange(force.shape[1])
        bend = opening_part.curvature * (opened.T @ force[1] + opening @ opening_part.size)
        total[:, balls, :, balls] += bend.transpose(2, 0, 1)
        return np.asarray(total)

    def reactions(self, force: Array, V: Array) -> tuple[Array, Array]:
        """Forces of the supports of the seat, and the movement of the ring as a whole towards
        them.

        Parameters
        ----------
        force : Array
            forces (x, r) of the balls, shape (2, N) [N]
        V : Array
            distances of the grooves' centres, shape (2, N) [m]

        Returns
        -------
        pressed
            forces of the supports, empty without any [N]
        moved
            movement (y, z), shape (rows, 2) [m]
        """
        if self.supports is None:
            return np.zeros(0), np.zeros((0, 2))
        opening_part = self.opening_force(force, V)
        pressed, movement = self.supports.reactions(np.concatenate([force[1], opening_part.size]))
        return pressed, -self.outward * movement.reshape(-1, 2)

    def _matrices(
        self, force: Array, opening_part: OpeningForce
    ) -> tuple[Array, Array, Array, Array]:
        """Compliance of the movements, G_xx, G_rr, G_ro, G_oo, less what the supports of the
        seat take from it.
        """
        axial, radial, opened, opening = self.entries
        opened = self.outward * opened
        count = force.shape[1]
        if self.supports is None:
            return axial, radial, opened, opening
        reduction = self.supports.taken(np.concatenate([force[1], opening_part.size]))
        return (
            axial,
            radial - reduction[:count, :count],
            opened - reduction[:count, count:],
            opening - reduction[count:, count:],
        )


class RingCompliance(NamedTuple):
    """Compliance of the rings between all balls.

    Forces of the balls on the inner ring (x, r), shape (2, N), and of their motion, shape (N,)
    [N]; V, the distances of the grooves' centres, shape (2, N) [m], has the directions in which
    unloaded balls would touch.
    """

    inner: GrooveCompliance
    outer: GrooveCompliance

    def shift(self, inner_force: Array, centrifugal: Array, V: Array) -> Array:
        """Yield of the rings, from outer to inner groove centre.

        Parameters
        ----------
        inner_force : Array
            forces (x, r) of the balls on the inner ring, shape (2, N) [N]
        centrifugal : Array
            centrifugal forces, shape (N,) [N]
        V : Array
            distances of the grooves' centres, shape (2, N) [m]

        Returns
        -------
        Array
            shift (x, r), shape (2, N) [m]
        """
        inner, outer = self.deflections(inner_force, centrifugal, V)
        return inner - outer

    def deflections(self, inner_force: Array, centrifugal: Array, V: Array) -> tuple[Array, Array]:
        """Movement of the groove's centre of the inner and the outer ring.

        Parameters
        ----------
        inner_force : Array
            forces (x, r) of the balls on the inner ring, shape (2, N) [N]
        centrifugal : Array
            centrifugal forces, shape (N,) [N]
        V : Array
            distances of the grooves' centres, shape (2, N) [m]

        Returns
        -------
        inner
            movement (x, r), shape (2, N) [m]
        outer
            movement (x, r), shape (2, N) [m]
        """
        outer_force = _on_outer_ring(inner_force, centrifugal)
        return self.inner.deflection(inner_force, V), self.outer.deflection(outer_force, V)

    def derivative(
        self, inner_force: Array, centrifugal: Array, V: Array, ring_dV: Array
    ) -> Array:
        """Derivative of the shift by the distances V of the grooves' centres.

        Parameters
        ----------
        inner_force : Array
            forces (x, r) of the balls on the inner ring, shape (2, N) [N]
        centrifugal : Array
            centrifugal forces, shape (N,) [N]
        V : Array
            distances of the grooves' centres, shape (2, N) [m]
        ring_dV : Array
            derivatives of the forces (x, r, couple, centrifugal) by V, shape (4, 2, N) [N/m]

        Returns
        -------
        Array
            d(shift)/dV, shape (2, N, 2, N) [-]
        """
        inner = self.inner.derivative(inner_force, V)
        outer = self.outer.derivative(_on_outer_ring(inner_force, centrifugal), V)
        both = np.einsum("vjuk,uwk->vjwk", inner + outer, ring_dV[:2])
        both -= np.einsum("vjk,wk->vjwk", outer[:, :, 1], ring_dV[3])
        return both


def _on_outer_ring(inner_force: Array, centrifugal: Array) -> Array:
    """Forces of the balls on the outer ring (x, r), shape (2, N) [N]."""
    outer_force = -inner_force
    outer_force[1] += centrifugal
    return outer_force


@lru_cache(maxsize=16)
def response_of(ring: ElasticRing) -> bodies.RingResponse:
    """Displacement of a ring under unit forces, computed once a process.

    Parameters
    ----------
    ring : ElasticRing
        elastic ring on its seat

    Returns
    -------
    bodies.RingResponse
        response over the angle [m/N]
    """
    return bodies.ring_response(
        ring.profile,
        ring.elasticity,
        ring.seat,
        ring.contact_angle,
        ring.cells,
        seat_contact=ring.half_support if ring.supports else None,
    )


def ring_compliance(rings: ElasticRings, azimuths: Array, balls: int) -> RingCompliance:
    """Compliance of the rings between balls.

    Parameters
    ----------
    rings : ElasticRings
        elastic rings; None of a rigid one
    azimuths : Array
        azimuths of the balls, row by row, shape (N,) [rad]
    balls : int
        number of balls a row [-]

    Returns
    -------
    RingCompliance
        compliance of both rings [m/N]
    """
    row = np.arange(azimuths.size) // balls
    together = row[:, None] == row[None, :]
    angles = azimuths[:, None] - azimuths[None, :]
    # balls are evenly spaced: differences by their number, equal to the last bit
    steps = np.rint(angles * balls / (2.0 * np.pi)).astype(np.int64) % balls
    steps = np.minimum(steps, balls - steps)
    grooves = []
    for ring, outward in ((rings.inner, -1.0), (rings.outer, 1.0)):
        entries = np.zeros((4, azimuths.size, azimuths.size))
        angle = 0.5 * np.pi
        supports = None
        if ring is not None:
            between = response_of(ring).at(2.0 * np.pi * np.arange(balls // 2 + 1) / balls)
            entries = np.where(together, between[:, steps], 0.0)
            angle = ring.contact_angle
            supports = _supports(ring, azimuths, balls, outward)
        grooves.append(GrooveCompliance(entries, angle, outward, supports))
    return RingCompliance(*grooves)


def _supports(
    ring: ElasticRing, azimuths: Array, balls: int, outward: float
) -> SeatSupports | None:
    response = response_of(ring).seat_contacts
    if response is None:
        return None
    return seat_supports(response, np.array(ring.supports), (azimuths, balls), outward)
