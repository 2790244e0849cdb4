r"""Stress in a half-space below a pressure: superposition of uniformly loaded rectangles by
FFT.

Boussinesq's potentials of a unit pressure on a rectangle (Love, 1929), psi = int 1/r and chi = int
ln(r + z), have second derivatives that are sums over its corners. With u, v from the field point
to a corner and r^2 = u^2 + v^2 + z^2, those by y like those by x::

    psi_z  = -S atan(u v/(z r)),   psi_xx = -S u v/(r (u^2 + z^2))
    psi_xy =  S 1/r,               psi_xz =  S z v/(r (u^2 + z^2))
    chi_xy =  S ln(r + z),         chi_xx =  S [atan(v/u) - atan(v z/(u r))]

and the stresses are (Johnson, Contact Mechanics, 1985, section 3.2)::

    2 pi sigma_x = 2 nu psi_z - z psi_xx - (1 - 2 nu) chi_xx,   2 pi sigma_z = psi_z - z psi_zz
    2 pi tau_xy  = -z psi_xy - (1 - 2 nu) chi_xy,               2 pi tau_xz  = -z psi_xz

No friction. The pressure is constant on every cell: second order in the mesh size.
"""

from dataclasses import dataclass

import numpy as np
from scipy.fft import irfft2, next_fast_len, rfft2

from ..arrays import Array

EVEN_TOLERANCE = 1e-9  # relative difference of mesh sizes of an even grid [-]


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
