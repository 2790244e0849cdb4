r"""An elastic ball under two opposite equal loads: its surface against that of a half-space.

Normal pressures p_n P_n(cos gamma) on a sphere of radius R move it by w_n P_n along the radius,
with the two regular solutions of degree n (Love, Mathematical Theory of Elasticity, 1927, article
172; phi = r^n P_n)

.. math:: u = a \nabla\phi + b\,(r^2 \nabla\phi + \alpha_n x \phi), \qquad
          \alpha_n = -2\,\frac{n\lambda + (3n+1)\mu}{(n+3)\lambda + (n+5)\mu}

and no shear on the surface. Unit loads at both poles have p_n = (2 n + 1)/(2 pi R^2) at even n,
and over (1 - nu^2)/(pi E R) their displacements tend to 2 + 2 c/n, c = (1 - 2 nu)^2/[2 (1 - nu)].
These two terms are summed in closed form, with

.. math:: \sum P_n = \frac{1}{2 \sin(\gamma/2)}, \qquad
          \sum_{n \ge 1} \frac{P_n}{n} = -\ln[\sin(\gamma/2) (1 + \sin(\gamma/2))]

and the rest falls like n^-2. The first is the half-space up to O(gamma); the second, singular as a
logarithm, is what the curvature of the surface adds.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.polynomial.legendre import legval
from numpy.typing import NDArray

from ...arrays import Array
from ..compliance import corner_integrals
from .surface_difference import ContactPatch, SurfaceDifference, fitted

DEGREES = 400  # of the rest; twice as many change the difference by less than 1e-5 of it
SMALLEST = 1e-6  # half angle between two cells, where the smooth part is even [rad]


def ball_difference(
    radius: float, youngs_modulus: float, poisson_ratio: float, patch: ContactPatch
) -> SurfaceDifference:
    """Surface of a ball under Hertz pressures on two opposite ellipses, less that of a half-space.

    Pressures and positions are in arc lengths; forces stand along the ball's normals, and
    displacements are those along them over the cosine to the contact's normal, so that a rigid
    motion is a constant.

    Parameters
    ----------
    radius : float
        of the ball [m]
    youngs_modulus : float
        E [Pa]
    poisson_ratio : float
        nu [-]
    patch : ContactPatch
        ellipse of the contact

    Returns
    -------
    SurfaceDifference
        displacement over the ellipse, less that of the half-space
    """
    x, y, loads, cell = patch.cells()
    kernel = ball_kernel(radius, youngs_modulus, poisson_ratio, (x, y), cell)
    return fitted(patch, (x, y), loads, kernel @ loads)


def ball_kernel(
    radius: float,
    youngs_modulus: float,
    poisson_ratio: float,
    points: tuple[Array, Array],
    cell: tuple[float, float],
) -> Array:
    """Displacement at the middles of cells by the load of each, less that of a half-space.

    Parameters
    ----------
    radius : float
        of the ball [m]
    youngs_modulus : float
        E [Pa]
    poisson_ratio : float
        nu [-]
    points : tuple[Array, Array]
        x and y of the middles, shape (n,) each [m]
    cell : tuple[float, float]
        sides of a cell [m]

    Returns
    -------
    Array
        shape (n, n) [m/N]
    """
    x, y = points
    factor = (1.0 - poisson_ratio**2) / (np.pi * youngs_modulus)
    towards = np.stack([np.sin(x / radius), np.sin(y / radius)])
    height = np.sqrt(1.0 - (towards**2).sum(axis=0))
    position = np.concatenate((towards, height[None, :]))
    chord = np.linalg.norm(position[:, :, None] - position[:, None, :], axis=0)
    angle = 2.0 * np.arcsin(np.clip(0.5 * chord, SMALLEST, 1.0))
    smooth = pole_difference(angle, poisson_ratio) + _slope(poisson_ratio) * np.log(angle)
    logarithm = _cell_means(_log_corner, x, y, cell) - np.log(radius)
    flat = _cell_means(_distance_corner, x, y, cell)
    curved = flat + (smooth - _slope(poisson_ratio) * logarithm) / radius
    return np.asarray(factor * (curved / (height[:, None] * height[None, :]) - flat))


def pole_difference(angle: Array, poisson_ratio: float) -> Array:
    """Inward displacement of a ball loaded at two poles, less that of a half-space at the distance
    R gamma.

    Over (1 - nu^2)/(pi E R) of a unit load.

    Parameters
    ----------
    angle : Array
        gamma > 0 from the nearer pole, any shape [rad]
    poisson_ratio : float
        nu [-]

    Returns
    -------
    Array
        difference, shape of `angle` [-]
    """
    nu = poisson_ratio
    slope = _slope(nu)
    degree = np.arange(0, 2 * DEGREES, 2)
    series = np.zeros(2 * DEGREES)
    series[degree] = 2.0 * (_degrees(degree, nu) - 1.0)
    series[degree[1:]] -= 2.0 * slope / degree[1:]
    other = np.pi - angle
    closed = _sum(angle) - 1.0 / angle + _sum(other) + slope * (_log_sum(angle) + _log_sum(other))
    return np.asarray(closed + legval(np.cos(angle), series))


def _degrees(degree: NDArray[Any], nu: float) -> Array:
    """(2 n + 1) w_n/(4 pi) over (1 - nu)/(2 pi mu), 1 for a half-space; mu = 1, n not 1 [-]."""
    n = degree.astype(np.float64)
    lame = 2.0 * nu / (1.0 - 2.0 * nu)
    alpha = -2.0 * (n * lame + 3.0 * n + 1.0) / ((n + 3.0) * lame + n + 5.0)
    gradient = np.where(n == 0.0, 0.0, -(2.0 * n + alpha) / (2.0 * (n - 1.0)))  # a/b, no shear
    moved = gradient * n + n + alpha
    stress = 2.0 * gradient * n * (n - 1.0)
    stress += lame * (2.0 * n + alpha * (n + 3.0)) + 2.0 * (n + alpha) * (n + 1.0)
    return np.asarray((2.0 * n + 1.0) / 2.0 / (1.0 - nu) * moved / stress)


def _sum(angle: Array) -> Array:
    """Sum of P_n(cos gamma) over all n [-]."""
    return np.asarray(0.5 / np.sin(0.5 * angle))


def _log_sum(angle: Array) -> Array:
    """Sum of P_n(cos gamma)/n from n = 1 [-]."""
    s = np.sin(0.5 * angle)
    return np.asarray(-np.log(s * (1.0 + s)))


def _slope(nu: float) -> float:
    """c of the logarithm that the curvature adds [-]."""
    return (1.0 - 2.0 * nu) ** 2 / (2.0 * (1.0 - nu))


def _cell_means(
    corner: Callable[[Array, Array], Array], x: Array, y: Array, cell: tuple[float, float]
) -> Array:
    """Means of a function of the distance over the cells around one set of points as seen from the
    others, shape (n, n); `corner`: its integral over a rectangle from the origin.
    """
    u = x[:, None] - x[None, :]
    v = y[:, None] - y[None, :]
    dx, dy = 0.5 * cell[0], 0.5 * cell[1]
    total = corner(u + dx, v + dy) - corner(u + dx, v - dy)
    total = total - corner(u - dx, v + dy) + corner(u - dx, v - dy)
    return np.asarray(total / (cell[0] * cell[1]))


def _distance_corner(x: Array, y: Array) -> Array:
    """Integral of 1/r, Love (1929) [m]."""
    return corner_integrals(x, y)[0]


def _log_corner(x: Array, y: Array) -> Array:
    """Integral of ln r, up to functions of x or of y alone [m^2]."""
    angles = x * x * np.arctan(y / x) + y * y * np.arctan(x / y)
    return np.asarray(0.5 * (x * y * (np.log(x * x + y * y) - 3.0) + angles))
