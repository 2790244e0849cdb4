"""Displacement of a whole ring under the loads of all its balls, by superposition.

The field of one load at the bottom of the groove, that of one at the contact angle alpha, and the
mirror image of this are turned to the azimuth of each ball and added: a ring is the same all
around and on both sides, and its seat reacts to each load separately. Close to a load, within a
cell or two, the displacement is that of the line of nodes which carries it, not Hertz'
indentation.
"""

from dataclasses import dataclass
from math import ceil, pi

import numpy as np

from ...arrays import Array
from .compliance import RingResponse
from .hexahedra import quadratic_line

LARGEST_STEP = pi / 60.0  # between lines around the ring [rad]


@dataclass(frozen=True, slots=True, kw_only=True)
class RingField:
    """Displacement of a ring on its seat at nodes around it, across the track and into the depth,
    from 0 on the track to 1 on the seat; the last line around meets the first.
    """

    points: Array  # x along the axis, y, z, shape (n, m, k, 3) [m]
    displacement: Array  # (x, y, z), shape (n, m, k, 3) [m]


def ring_field(response: RingResponse, turns: Array, loads: Array) -> RingField:
    """Displacement of a whole ring under the loads of its balls.

    Parameters
    ----------
    response : RingResponse
        displacements for a unit force
    turns : Array
        azimuths of the loads from y towards z, shape (N,) [rad]
    loads : Array
        along the normal at the bottom, at the contact angle of the response, and at its mirror
        image, shape (3, N) [N]; with seat contacts outward on the seat, too, shape (4, N)

    Returns
    -------
    RingField
        displacement at nodes around the ring
    """
    theta, section, unit_fields = _cylindrical(response)
    around = _lines(np.asarray(turns))
    total = np.zeros((around.size, *section.shape[1:], 3))
    for turn, load in zip(turns, loads.T, strict=True):
        offset = (around - turn + pi) % (2.0 * pi) - pi
        numbers, values = quadratic_line(theta, np.abs(offset))
        field = np.einsum("l,l...->...", load, unit_fields)
        moved = np.einsum("nl,nlmkv->nmkv", values, field[numbers])
        moved[..., 2] *= np.sign(offset)[:, None, None]  # along the tangent: odd
        total += moved
    x, r = np.broadcast_to(section[:, None], (2, around.size, *section.shape[1:]))
    c, s = np.cos(around)[:, None, None], np.sin(around)[:, None, None]
    axial, radial, tangential = np.moveaxis(total, -1, 0)
    turned = (axial, radial * c - tangential * s, radial * s + tangential * c)
    points = np.stack([x, r * c, r * s], axis=-1)
    return RingField(points=points, displacement=np.stack(turned, axis=-1))


def _cylindrical(response: RingResponse) -> tuple[Array, Array, Array]:
    """Lines of theta, shape (n,) [rad]; the ring's section (x, r), shape (2, m, k) [m]; and the
    fields of the unit loads (x, r, tangential), shape (3 or 4, n, m, k, 3) [m/N].
    """
    body = response.mesh.body
    parameters = body.parameters.round(12)
    order = np.lexsort(parameters[::-1])
    shape = tuple(np.unique(row).size for row in parameters)
    theta, _, depth = (row[order].reshape(shape) for row in parameters)
    in_ring = depth[0, 0] <= 1.0
    x, y, z = (row[order].reshape(shape)[:, :, in_ring] for row in body.points)
    section = np.stack([x[0], np.hypot(y, z)[0]])
    field = response.field[order].reshape(*shape, 3, -1)[:, :, in_ring]
    c, s = np.cos(theta), np.sin(theta)
    c, s = (values[:, :, in_ring, None] for values in (c, s))
    axial, along_y, along_z = np.moveaxis(field, 3, 0)
    turned = np.stack([axial, along_y * c + along_z * s, along_z * c - along_y * s], axis=3)
    bottom, here, *seat_contact = np.moveaxis(turned, -1, 0)
    image = here[:, ::-1] * np.array([-1.0, 1.0, 1.0])
    return theta[:, 0, 0], section, np.stack([bottom, here, image, *seat_contact])


def _lines(turns: Array) -> Array:
    """Lines around the ring, one at every load, even between two of them, shape (n,) [rad]."""
    loaded = np.unique(np.round(turns % (2.0 * pi), 9))
    following = np.append(loaded[1:], loaded[0] + 2.0 * pi)
    steps = [
        np.linspace(a, b, ceil((b - a) / LARGEST_STEP - 1e-6), endpoint=False)
        for a, b in zip(loaded, following, strict=True)
    ]
    return np.concatenate(steps)
