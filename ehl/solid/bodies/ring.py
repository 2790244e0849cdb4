r"""Stress in a grooved ring below a contact, and displacement of the whole ring under all its
balls.

The stress is that of a half-space and the difference of the ring. Hertz' pressure on a half-space
has a closed superposition (`subsurface`). The difference of the ring is smooth and comes from
finite elements that need not see the contact: stress of the ring less stress of the flat block
with the same lines and nodal forces, each in the directions along the track, across it and into
the body,

.. math:: \sigma = \sigma_\text{half-space}(x, y, z) + (\sigma_\text{ring} - \sigma_\text{block})

at equal arc lengths x, y and depths z. Gradients of the displacements are differences over the
lines of nodes, of second order; their errors under the load are equal in both bodies.

The displacement of a whole ring is a superposition: the field of one load at the bottom of the
groove, that of one at the contact angle alpha, and the mirror image of this are turned to the
azimuth of each ball and added: a ring is the same all around and on both sides, and its seat
reacts to each load separately. Close to a load, within a cell or two, the displacement is that of
the line of nodes which carries it, not Hertz' indentation.
"""

from dataclasses import dataclass
from math import ceil, pi

import numpy as np
import scipy

from ...arrays import Array
from ..subsurface import SubsurfaceStress, subsurface_stress
from .compliance import RingResponse
from .elasticity import quadratic_line
from .surface_difference import ContactPatch

LARGEST_STEP = pi / 60.0  # between lines around the ring [rad]

# box below the contact: points along, across and into the ring, its half sides in a and b, and its
# depth in a; the largest shear of a line contact lies at 0.79 a
POINTS = (49, 49, 31)
HALF_SIDES = (1.5, 1.2)
DEPTH = 3.0
PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))  # xx, yy, zz, xy, yz, xz


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


@dataclass(frozen=True, slots=True)
class StressDifference:
    """Stress of a ring less that of the flat block at the lines of nodes."""

    # distances along the track, across it from the contact, and depths: lines of nodes [m]
    lines: tuple[Array, Array, Array]
    stress: Array  # xx, yy, zz, xy, yz, xz, shape (6, nx, ny, nz) [Pa]

    def at(self, x: Array, y: Array, depth: Array) -> Array:
        """Values at the points of a grid, linear between nodes, mirrored at x = 0.

        Parameters
        ----------
        x : Array
            along the track, shape (nx,) [m]
        y : Array
            across it from the contact, shape (ny,) [m]
        depth : Array
            shape (nz,) [m]

        Returns
        -------
        Array
            xx, yy, zz, xy, yz, xz, shape (6, nx, ny, nz) [Pa]
        """
        grid = np.stack(np.meshgrid(np.abs(x), y, depth, indexing="ij"), axis=-1)
        values = scipy.interpolate.RegularGridInterpolator(
            self.lines, np.moveaxis(self.stress, 0, -1)
        )(grid)
        values = np.moveaxis(values, -1, 0)
        values[[3, 5]] *= np.sign(x)[:, None, None]  # odd in x
        return np.asarray(values)


@dataclass(frozen=True, slots=True, kw_only=True)
class RingStress:
    """Stress in a box below a contact, of the half-space and of the ring."""

    half_space: SubsurfaceStress
    ring: SubsurfaceStress

    @property
    def von_mises_change(self) -> float:
        """Change of the largest equivalent stress of von Mises over it [-]."""
        return float(self.ring.von_mises.max() / self.half_space.von_mises.max()) - 1.0

    @property
    def orthogonal_shear_change(self) -> float:
        """Change of the amplitude of the shear in rolling over it [-]."""
        ring, flat = (np.abs(body.stress[5]).max() for body in (self.ring, self.half_space))
        return float(ring / flat) - 1.0


def ring_stress(
    difference: StressDifference, patch: ContactPatch, poisson_ratio: float
) -> RingStress:
    """Stress in a box below Hertz' pressure, of the half-space and of the ring.

    Parameters
    ----------
    difference : StressDifference
        stress of the ring less that of the block
    patch : ContactPatch
        ellipse of the contact
    poisson_ratio : float
        nu of the ring [-]

    Returns
    -------
    RingStress
        both stresses
    """
    a, b = patch.semi_axis_x, patch.semi_axis_y
    x, y = (
        half * side * np.linspace(-1.0, 1.0, n)
        for half, side, n in zip(HALF_SIDES, (a, b), POINTS[:2], strict=True)
    )
    depth = DEPTH * a * np.linspace(0.0, 1.0, POINTS[2])
    inside = 1.0 - (x[:, None] / a) ** 2 - (y[None, :] / b) ** 2
    peak = 1.5 * patch.load / (np.pi * a * b)
    pressure = peak * np.sqrt(np.maximum(inside, 0.0))
    flat = subsurface_stress(pressure, x, y, depth, poisson_ratio)
    whole = flat.stress + difference.at(x, y, depth)
    return RingStress(half_space=flat, ring=SubsurfaceStress(x=x, y=y, depth=depth, stress=whole))


def grid_stress(
    parameters: tuple[Array, Array, Array],
    points: Array,
    displacement: Array,
    elastic: tuple[float, float],
) -> Array:
    """Stress at nodes on lines of parameters.

    Parameters
    ----------
    parameters : tuple[Array, Array, Array]
        lines of the three parameters, nx, ny and nz of them
    points : Array
        coordinates of the nodes, shape (3, nx, ny, nz) [m]
    displacement : Array
        of the nodes, shape (3, nx, ny, nz) [m]
    elastic : tuple[float, float]
        Young's modulus [Pa] and nu [-]

    Returns
    -------
    Array
        shape (3, 3, nx, ny, nz) [Pa]
    """
    young, nu = elastic
    by_point, by_field = (
        np.stack(
            [
                np.gradient(field, line, axis=n + 1, edge_order=2)
                for n, line in enumerate(parameters)
            ],
            1,
        )
        for field in (points, displacement)
    )
    # components and parameters last, for the inverses
    jacobian, slope = (np.moveaxis(one, (0, 1), (-2, -1)) for one in (by_point, by_field))
    gradient = slope @ np.linalg.inv(jacobian)
    strain = 0.5 * (gradient + np.swapaxes(gradient, -1, -2))
    shear = young / (2.0 * (1.0 + nu))
    lame = young * nu / ((1.0 + nu) * (1.0 - 2.0 * nu))
    trace = np.trace(strain, axis1=-2, axis2=-1)[..., None, None]
    return np.moveaxis(lame * trace * np.eye(3) + 2.0 * shear * strain, (-2, -1), (0, 1))


def stress_difference(
    lines: tuple[Array, Array, Array], ring: Array, block: Array, frames: Array
) -> StressDifference:
    """Difference of two stresses at nodes, that of the ring in the frames of the block.

    Parameters
    ----------
    lines : tuple[Array, Array, Array]
        distances along the track, across it from the contact, and depths [m]
    ring : Array
        stress of the ring, shape (3, 3, nx, ny, nz) [Pa]
    block : Array
        stress of the block, shape (3, 3, nx, ny, nz) [Pa]
    frames : Array
        unit vectors along, across and into the body, shape (3, 3, nx, ny) [-]

    Returns
    -------
    StressDifference
        the difference
    """
    turned = np.einsum("aixy,ijxyz,bjxy->abxyz", frames, ring, frames)
    change = turned - block
    return StressDifference(lines, np.stack([change[i, j] for i, j in PAIRS]))
