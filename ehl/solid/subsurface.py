"""Stress in a half-space below a pressure, and in its surface under pressure and shear:
superposition of uniformly loaded rectangles by FFT.

Boussinesq's potentials of a unit pressure on a rectangle (Love, 1929), psi = int 1/r and chi = int
ln(r + z), have second derivatives that are sums over its corners. With u, v from the field point
to a corner and r^2 = u^2 + v^2 + z^2, those by y like those by x::

    psi_z  = -S atan(u v/(z r)),   psi_xx = -S u v/(r (u^2 + z^2))
    psi_xy =  S 1/r,               psi_xz =  S z v/(r (u^2 + z^2))
    chi_xy =  S ln(r + z),         chi_xx =  S [atan(v/u) - atan(v z/(u r))]

and the stresses are (Johnson, Contact Mechanics, 1985, section 3.2)::

    2 pi sigma_x = 2 nu psi_z - z psi_xx - (1 - 2 nu) chi_xx,   2 pi sigma_z = psi_z - z psi_zz
    2 pi tau_xy  = -z psi_xy - (1 - 2 nu) chi_xy,               2 pi tau_xz  = -z psi_xz

The pressure is constant on every cell: second order in the mesh size. In the surface, with x and y
from a point force to the field point and r^2 = x^2 + y^2, a shear force Q along x on the body that
fills z > 0 makes in its surface (Cerruti; Johnson, Contact Mechanics, 1985, section 3.6, at z = 0)

    2 pi sigma_x/Q = -6 nu x^3/r^5 - 2 (1 - 2 nu) x/r^3
    2 pi sigma_y/Q = -6 nu x y^2/r^5
    2 pi tau_xy/Q  = -6 nu x^2 y/r^5 - (1 - 2 nu) y/r^3

whose integrals over a rectangle are sums over its corners (u, v) of

    pi sigma_x = ln(v + r) + nu v/r,  pi sigma_y = nu [ln(v + r) - v/r]
    2 pi tau_xy = ln(u + r) - 2 nu u/r

and a shear along y the same with x and y exchanged. The pressure contributes as above
at depth zero. Tension is positive. Second order in the mesh size where the loads are smooth.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.fft import irfft2, next_fast_len, rfft2

from ..arrays import Array

EVEN_TOLERANCE = 1e-9  # relative difference of mesh sizes of an even grid [-]

Kernels = tuple[Array, Array, Array]  # of sigma_x, sigma_y, tau_xy


@dataclass(frozen=True, slots=True, kw_only=True)
class SubsurfaceStress:
    """Stress below a contact, negative in compression."""

    x: Array  # of the contact plane, shape (nx,) [m]
    y: Array  # shape (ny,) [m]
    depth: Array  # into the body, shape (nz,) [m]
    stress: Array  # xx, yy, zz, xy, yz, xz, shape (6, nx, ny, nz) [Pa]

    @property
    def von_mises(self) -> Array:
        """Equivalent stress of von Mises, shape (nx, ny, nz) [Pa]."""
        xx, yy, zz, xy, yz, xz = self.stress
        normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2
        return np.asarray(np.sqrt(0.5 * normal + 3.0 * (xy**2 + yz**2 + xz**2)))

    @property
    def maximum_shear(self) -> Array:
        """Half the difference of the extreme principal stresses, shape (nx, ny, nz) [Pa]."""
        xx, yy, zz, xy, yz, xz = self.stress
        tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        principal = np.linalg.eigvalsh(np.moveaxis(tensor, (0, 1), (-2, -1)))
        return np.asarray(0.5 * (principal[..., 2] - principal[..., 0]))


def subsurface_stress(
    pressure: Array, x: Array, y: Array, depth: Array, poisson_ratio: float
) -> SubsurfaceStress:
    """Stress below a pressure at the middles of the cells of an even grid, Love (1929).

    Parameters
    ----------
    pressure : Array
        zero outside of the grid, shape (nx, ny) [Pa]
    x : Array
        increasing, shape (nx,) [m]
    y : Array
        increasing, shape (ny,) [m]
    depth : Array
        not negative, shape (nz,) [m]
    poisson_ratio : float
        nu of the body [-]

    Returns
    -------
    SubsurfaceStress
        stress at the nodes below the grid

    Raises
    ------
    ValueError
        if the grid is not even, a depth is negative, or the shapes differ
    """
    steps = (_even_step(x, "x"), _even_step(y, "y"))
    depth = np.asarray(depth, dtype=np.float64)
    if depth.size == 0 or not (depth >= 0.0).all():
        raise ValueError(f"depth must not be negative or empty, got {depth!r} m")
    nx, ny = pressure.shape
    grid = (x.size, y.size)
    if (nx, ny) != grid:
        raise ValueError(f"pressure must have the shape of the grid, {grid}, got {pressure.shape}")
    shape = [next_fast_len(3 * n - 2, real=True) for n in (nx, ny)]
    transform = rfft2(pressure, shape)
    stress = np.empty((6, nx, ny, depth.size))
    for k, z in enumerate(depth):
        kernels = rectangle_stress((nx, ny), steps, float(z), poisson_ratio)
        for component, kernel in enumerate(kernels):
            full = irfft2(transform * rfft2(kernel, shape), shape)
            stress[component, :, :, k] = full[nx - 1 : 2 * nx - 1, ny - 1 : 2 * ny - 1]
    return SubsurfaceStress(x=x, y=y, depth=depth, stress=stress)


def rectangle_stress(
    points: tuple[int, int], steps: tuple[float, float], depth: float, poisson_ratio: float
) -> tuple[Array, ...]:
    """Stress at a depth around one cell under unit pressure, Love (1929).

    Parameters
    ----------
    points : tuple[int, int]
        nx and ny
    steps : tuple[float, float]
        sides of the cell [m]
    depth : float
        [m]
    poisson_ratio : float
        nu of the body [-]

    Returns
    -------
    tuple[Array, ...]
        xx, yy, zz, xy, yz, xz, shape (2 nx - 1, 2 ny - 1) each, the cell in the middle [-]
    """
    z = depth
    nu = poisson_ratio
    u, v = ((np.arange(1 - n, n + 1) - 0.5) * step for n, step in zip(points, steps, strict=True))
    u = u[:, None]
    v = v[None, :]
    r = np.sqrt(u * u + v * v + z * z)
    by_u, by_v = r * (u * u + z * z), r * (v * v + z * z)
    psi_xx, psi_yy = corner_sums(-u * v / by_u), corner_sums(-u * v / by_v)
    psi_z = corner_sums(-np.arctan2(u * v, z * r))
    chi_xx = corner_sums(np.arctan(v / u) - np.arctan(v * z / (u * r)))
    chi_yy = corner_sums(np.arctan(u / v) - np.arctan(u * z / (v * r)))
    other = 1.0 - 2.0 * nu
    components = (
        2.0 * nu * psi_z - z * psi_xx - other * chi_xx,
        2.0 * nu * psi_z - z * psi_yy - other * chi_yy,
        psi_z + z * (psi_xx + psi_yy),
        -z * corner_sums(1.0 / r) - other * corner_sums(np.log(r + z)),
        -z * corner_sums(z * u / by_v),
        -z * corner_sums(z * v / by_u),
    )
    # from source minus field to the reverse
    return tuple(component[::-1, ::-1] / (2.0 * np.pi) for component in components)


def corner_sums(values: Array) -> Array:
    """Sum over the four corners of each cell with alternating signs.

    Parameters
    ----------
    values : Array
        at the corners, shape (m, n) [any unit]

    Returns
    -------
    Array
        shape (m - 1, n - 1) [unit of `values`]
    """
    return np.asarray(values[1:, 1:] - values[:-1, 1:] - values[1:, :-1] + values[:-1, :-1])


def _even_step(axis: Array, name: str) -> float:
    steps = np.diff(axis)
    rising = axis.size >= 2 and bool((steps > 0.0).all())
    if not rising or np.ptp(steps) > EVEN_TOLERANCE * float(np.abs(axis).max()):
        raise ValueError(f"{name} must be evenly spaced and increasing")
    return float((axis[-1] - axis[0]) / (axis.size - 1))


@dataclass(frozen=True, slots=True, kw_only=True)
class SurfaceStress:
    """Stress in a surface, tension positive, shape (nx, ny) each."""

    xx: Array  # [Pa]
    yy: Array  # [Pa]
    xy: Array  # [Pa]

    @property
    def tension(self) -> Array:
        """Larger principal stress in the surface, shape (nx, ny) [Pa]."""
        middle = 0.5 * (self.xx + self.yy)
        return np.asarray(middle + np.hypot(0.5 * (self.xx - self.yy), self.xy))


def surface_stress(
    pressure: Array, shear: tuple[Array, Array], steps: tuple[float, float], poisson_ratio: float
) -> SurfaceStress:
    """Stress in the surface under a pressure and shears at the middles of the cells of an even
    grid.

    Parameters
    ----------
    pressure : Array
        zero outside of the grid, shape (nx, ny) [Pa]
    shear : tuple[Array, Array]
        tractions along x and along y, shape (nx, ny) each [Pa]
    steps : tuple[float, float]
        of the grid along x and y [m]
    poisson_ratio : float
        nu of the body [-]

    Returns
    -------
    SurfaceStress
        stress, tension positive
    """
    return surface_stresses(pressure, (shear,), steps, poisson_ratio)[0]


def surface_stresses(
    pressure: Array,
    shears: Sequence[tuple[Array, Array]],
    steps: tuple[float, float],
    poisson_ratio: float,
) -> tuple[SurfaceStress, ...]:
    """Stress in several surfaces under one pressure, as by `surface_stress`.

    Parameters
    ----------
    pressure : Array
        zero outside of the grid, shape (nx, ny) [Pa]
    shears : Sequence[tuple[Array, Array]]
        tractions along x and along y of each surface, shape (nx, ny) each [Pa]
    steps : tuple[float, float]
        of the grid along x and y [m]
    poisson_ratio : float
        nu of the bodies [-]

    Returns
    -------
    tuple[SurfaceStress, ...]
        stress of each surface, tension positive
    """
    nx, ny = points = pressure.shape
    # stress that comes round from the other end of the kernel falls outside of the cells
    shape = [next_fast_len(2 * n - 1, real=True) for n in points]
    dry = rectangle_stress(points, steps, 0.0, poisson_ratio)
    along = shear_kernels(points, steps, poisson_ratio)
    by, bx, bxy = (kernel.T for kernel in shear_kernels(points[::-1], steps[::-1], poisson_ratio))
    kernels = [
        [rfft2(kernel, shape) for kernel in of_load]
        for of_load in ((dry[0], dry[1], dry[3]), along, (bx, by, bxy))
    ]
    middle = (slice(nx - 1, 2 * nx - 1), slice(ny - 1, 2 * ny - 1))
    loads = rfft2(pressure, shape)
    normal = [loads * kernel for kernel in kernels[0]]
    stresses = []
    for shear in shears:
        total = normal
        for load, of_load in zip(shear, kernels[1:], strict=True):
            loads = rfft2(load, shape)
            total = [
                component + loads * kernel
                for component, kernel in zip(total, of_load, strict=True)
            ]
        xx, yy, xy = (irfft2(component, shape)[middle] for component in total)
        stresses.append(SurfaceStress(xx=xx, yy=yy, xy=xy))
    return tuple(stresses)


def shear_kernels(
    points: tuple[int, int], steps: tuple[float, float], poisson_ratio: float
) -> Kernels:
    """Stress around one cell under a unit shear along x.

    Parameters
    ----------
    points : tuple[int, int]
        nx and ny
    steps : tuple[float, float]
        sides of the cell [m]
    poisson_ratio : float
        nu of the body [-]

    Returns
    -------
    Kernels
        sigma_x, sigma_y, tau_xy, shape (2 nx - 1, 2 ny - 1) each, the cell in the middle [-]
    """
    nu = poisson_ratio
    u, v = ((np.arange(1 - n, n + 1) - 0.5) * step for n, step in zip(points, steps, strict=True))
    u = u[:, None]
    v = v[None, :]
    r = np.hypot(u, v)
    log_v = np.log(v + r)
    log_u = np.log(u + r)
    return (
        corner_sums(log_v + nu * v / r) / np.pi,
        nu * corner_sums(log_v - v / r) / np.pi,
        corner_sums(log_u - 2.0 * nu * u / r) / (2.0 * np.pi),
    )
