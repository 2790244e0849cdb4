r"""Response of a ring whose seat touches it at some azimuths only.

A seat contact presses radially on the seat, evenly across the ring and as a parabola over the
angle :math:`\pm w` around it, :math:`p \propto 1 - (\theta/w)^2`; it measures the radial
displacement of the seat with the same weights, which make its resultant one. The rigid part of all
displacements is that of a loose ring under a cosine pressure, which cancels where the seat
contacts balance the balls.
"""

from dataclasses import dataclass

import numpy as np

from ...arrays import Array
from .hexahedra import quadratic_line
from .ring_mesh import RingMesh

GAUSS_POINTS = 32  # of the parabola


@dataclass(frozen=True, slots=True, kw_only=True)
class SeatResponse:
    """Radial displacement of the seat under unit forces at theta = 0, by its contacts' weights."""

    theta: Array  # nodes around half the ring, shape (n,) [rad]
    # under a load at the bottom of the groove, at the contact angle, and a radial force on the
    # seat, shape (3, n) [m/N]
    moved: Array
    angle: float  # contact angle of the second [rad]
    half_width: float  # w [rad]

    def at(self, theta: Array) -> Array:
        """Displacement of the seat at an angle from the load.

        Parameters
        ----------
        theta : Array
            the angle, any shape [rad]

        Returns
        -------
        Array
            per radial force on the groove, per component of it that opens the groove, and per
            force on the seat, shape (3, ...) [m/N]
        """
        offsets, weights = _parabola(self.half_width)
        distance = np.asarray(theta)[..., None] + offsets
        distance = np.abs((distance + np.pi) % (2.0 * np.pi) - np.pi)
        numbers, shapes = quadratic_line(self.theta, distance)
        bottom, across, seat = (
            (row[numbers] * shapes).sum(axis=-1) @ weights for row in self.moved
        )
        return np.stack([bottom, across - np.cos(self.angle) * bottom, seat])


def seat_contact_forces(mesh: RingMesh, half_width: float) -> Array:
    """Nodal forces of half a unit seat contact at theta = 0, outwards.

    The other half stands beyond the plane of symmetry.

    Parameters
    ----------
    mesh : RingMesh
        mesh of the ring
    half_width : float
        w, half the angle of the contact [rad]

    Returns
    -------
    Array
        shape (nodes, 3) [-]
    """
    lines = _lines(mesh)
    angles, weights = _parabola(half_width)
    numbers, shapes = quadratic_line(lines, np.abs(angles))
    around = np.zeros(lines.size)
    np.add.at(around, numbers, 0.5 * weights[:, None] * shapes)
    theta = mesh.body.parameters[0]
    weight = around[np.abs(theta[:, None] - lines).argmin(axis=1)] * _across(mesh)
    return np.asarray(
        weight[:, None] * np.stack([0 * theta, np.cos(theta), np.sin(theta)], axis=1)
    )


def seat_response(mesh: RingMesh, field: Array, angle: float, half_width: float) -> SeatResponse:
    """Radial displacement of the seat under the three unit loads.

    Parameters
    ----------
    mesh : RingMesh
        mesh of the ring
    field : Array
        displacement of all nodes, shape (nodes, 3, 3) [m/N]
    angle : float
        contact angle of the second load [rad]
    half_width : float
        w, half the angle of the seat contacts [rad]

    Returns
    -------
    SeatResponse
        displacement as a seat contact measures it
    """
    theta = mesh.body.parameters[0]
    lines = _lines(mesh)
    line = np.abs(theta[:, None] - lines).argmin(axis=1)
    radial = field[:, 1] * np.cos(theta)[:, None] + field[:, 2] * np.sin(theta)[:, None]
    moved = np.zeros((lines.size, 3))
    np.add.at(moved, line, _across(mesh)[:, None] * radial)
    return SeatResponse(theta=lines, moved=moved.T, angle=angle, half_width=half_width)


def _parabola(half_width: float) -> tuple[Array, Array]:
    """Angles [rad] and weights of a seat contact, whose resultant is one [-], shape (points,)."""
    nodes, gauss = np.polynomial.legendre.leggauss(GAUSS_POINTS)
    weights = gauss * (1.0 - nodes**2)
    return half_width * nodes, weights / (weights @ np.cos(half_width * nodes))


def _lines(mesh: RingMesh) -> Array:
    return np.unique(mesh.body.parameters[0].round(12))


def _across(mesh: RingMesh) -> Array:
    """Weights of the nodes for the mean across the seat, sum 1 on every line around, zero off the
    seat, shape (nodes,) [-].
    """
    s = mesh.body.parameters[1]
    nodes = np.unique(s.round(12))
    weights = np.zeros(nodes.size)
    sizes = nodes[2::2] - nodes[:-2:2]
    for corner, simpson in enumerate((1.0, 4.0, 1.0)):  # Simpson's rule, that of quadratic cells
        weights[corner : nodes.size - 2 + corner : 2] += simpson / 6.0 * sizes
    line_weights = weights[np.abs(s[:, None] - nodes).argmin(axis=1)] / (nodes[-1] - nodes[0])
    return np.where(mesh.seat, line_weights, 0.0)
