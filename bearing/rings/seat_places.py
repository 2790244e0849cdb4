r"""Reactions of a seat that presses a ring at supports only, and lets go where it would pull.

R >= 0 are the forces of the supports, w = g - S R - E z <= 0 how far the ring is pressed into
them, R w = 0, with g the displacement by the balls towards the supports, S the compliance of the
seat, and z the movement of the ring as a whole, for which :math:`E^T R`
balances the balls (Signorini's problem of a discrete seat). A spring, `CENTRING`, holds the ring
across where one support alone presses, as friction there would; it takes a thousandth of the load
at most where two do.

The pressing supports follow from non-negative least squares (Lawson and Hanson, 1974), after which

.. math:: \begin{pmatrix} S & E \\ E^T & -\epsilon \end{pmatrix}
          \begin{pmatrix} R \\ z \end{pmatrix} = D \hat f

is exact, and the groove moves by :math:`-D^T (R, z)` beyond what a loose ring does.
"""

from typing import NamedTuple

import numpy as np
import scipy

from ehl.arrays import Array
from ehl.solid.bodies.compliance import SeatResponse

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
