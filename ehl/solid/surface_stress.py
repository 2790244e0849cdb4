"""Stress in the surface of a half-space under pressure and shear, by superposition of uniformly
loaded rectangles by FFT.

With x and y from a point force to the field point and r^2 = x^2 + y^2, a shear force Q along x on
the body that fills z > 0 makes in its surface (Cerruti; Johnson, Contact Mechanics, 1985, section
3.6, at z = 0)

    2 pi sigma_x/Q = -6 nu x^3/r^5 - 2 (1 - 2 nu) x/r^3
    2 pi sigma_y/Q = -6 nu x y^2/r^5
    2 pi tau_xy/Q  = -6 nu x^2 y/r^5 - (1 - 2 nu) y/r^3

whose integrals over a rectangle are sums over its corners (u, v) of

    pi sigma_x = ln(v + r) + nu v/r,  pi sigma_y = nu [ln(v + r) - v/r]
    2 pi tau_xy = ln(u + r) - 2 nu u/r

and a shear along y the same with x and y exchanged. The pressure contributes as in `subsurface`
at depth zero. Tension is positive. Second order in the mesh size where the loads are smooth.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.fft import irfft2, next_fast_len, rfft2

from ..arrays import Array
from .subsurface import corner_sums, rectangle_stress

Kernels = tuple[Array, Array, Array]  # of sigma_x, sigma_y, tau_xy


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
    # what comes round from the other end of the kernel falls outside of the cells
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
