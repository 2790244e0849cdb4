"""Compliance of a coated contact: 1/r, and a smooth correction from finite elements."""

from collections.abc import Callable
from functools import lru_cache
from math import ceil

import numpy as np
import scipy

from ..arrays import Array
from .coating import ScaledCoating
from .layered_fem import correction

# cells around the load in which the correction of a thin coating is averaged over the cell
NEIGHBOURS = 6
MAX_POINTS = 12  # of such a cell in each direction


def point_compliance(coating: ScaledCoating, r: Array) -> Array:
    """Correction f c(r/t)/t of a coating to the compliance 1/r of a unit point load.

    Parameters
    ----------
    coating : ScaledCoating
        of one body
    r : Array
        distance, any shape [-]

    Returns
    -------
    Array
        correction, shape of `r` [-]
    """
    spline, reach, far = _table(coating.ratio, coating.poisson)
    s = np.asarray(r, dtype=np.float64) / coating.thickness
    c = np.where(s < reach, spline(np.arcsinh(np.minimum(s, reach))), far / np.maximum(s, reach))
    return np.asarray(coating.fraction / coating.thickness * c)


@lru_cache(maxsize=16)
def _table(
    ratio: float, poisson: tuple[float, float]
) -> tuple[Callable[[Array], Array], float, float]:
    """c over asinh(r/t), the distance up to which it holds, and c r/t beyond."""
    r, c = correction(ratio, poisson)
    inside = r < 0.3 * r[-1]
    far = (1.0 - poisson[1] ** 2) / (1.0 - poisson[0] ** 2) / ratio - 1.0
    spline = scipy.interpolate.CubicSpline(np.arcsinh(r[inside]), c[inside])
    return spline, float(r[inside][-1]), far


def patch_compliance(coating: ScaledCoating, x: Array, y: Array, hx: float, hy: float) -> Array:
    """Integral of the correction over patches around (x, y).

    Midpoint rule, in the cells around the load with as many points as a thin coating needs.

    Parameters
    ----------
    coating : ScaledCoating
        of one body
    x : Array
        middles along x, shape (nx,) [-]
    y : Array
        middles along y, shape (ny,) [-]
    hx : float
        side of the patches along x [-]
    hy : float
        side of the patches along y [-]

    Returns
    -------
    Array
        shape (ny, nx) [-]
    """
    result = hx * hy * point_compliance(coating, np.hypot(x[None, :], y[:, None]))
    points = min(ceil(4.0 * max(hx, hy) / coating.thickness), MAX_POINTS)
    if points > 1:
        near_x, near_y = x[:NEIGHBOURS], y[:NEIGHBOURS]
        offsets = (np.arange(points) + 0.5) / points - 0.5
        u = near_x[None, :, None, None] + hx * offsets[:, None]
        v = near_y[:, None, None, None] + hy * offsets[None, :]
        mean = point_compliance(coating, np.hypot(u, v)).mean(axis=(2, 3))
        result[:NEIGHBOURS, :NEIGHBOURS] = hx * hy * mean
    return result
