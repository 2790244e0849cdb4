"""Film values of a grid, and grid-converged values with error bars from several levels."""

from collections.abc import Sequence
from math import log2

import numpy as np
from numpy.typing import NDArray

from ..grid import Grid
from ..solution import FilmValue

Array = NDArray[np.float64]

ORDER = 2.0  # of the discretisation
ORDER_RANGE = (1.0, 2.5)  # of observed orders; others are clipped to it
# the true order may be this much below the observed one; calibrated in docs/theory/contact.md
ORDER_DOUBT = 0.4


def extrapolate(values: Sequence[float], noise: float) -> FilmValue:
    """Richardson extrapolation with the observed order, and its uncertainty.

    With two levels the order is taken as 2 and the whole difference as uncertainty; one level
    allows no estimate, and the uncertainty is the value itself.

    Parameters
    ----------
    values : sequence of float
        One value per level, coarsest first, mesh size halved from one to the next [-].
    noise : float
        Relative change of the value in the last cycle [-].
    """
    values = [float(value) for value in values]
    finest = values[-1]
    if len(values) < 2:
        return FilmValue(value=finest, uncertainty=abs(finest), finest=finest)
    difference = finest - values[-2]
    step = difference / (2.0**ORDER - 1.0)
    second_order = FilmValue(
        value=finest + step, uncertainty=abs(difference) + noise * abs(finest), finest=finest
    )
    if len(values) < 3:
        return second_order
    before = values[-2] - values[-3]
    ratio = before / difference if difference else float("inf")
    if ratio <= 1.0:  # differences that do not fall have no order
        return second_order
    order = min(max(log2(ratio), ORDER_RANGE[0]), ORDER_RANGE[1])
    observed = difference / (2.0**order - 1.0)
    doubtful = difference / (2.0 ** (order - ORDER_DOUBT) - 1.0)
    uncertainty = abs(observed - step) + abs(doubtful - observed) + noise * abs(finest)
    return FilmValue(value=finest + observed, uncertainty=float(uncertainty), finest=finest)


def central_film(grid: Grid, H: Array) -> float:
    """Film at the origin; cubic interpolation along x where the origin is no node [-]."""
    line = H[0] if grid.symmetric else H[grid.ny // 2]
    X = grid.X
    i = int(np.argmin(np.abs(X)))
    if abs(X[i]) < 1e-9 * grid.hx:
        return float(line[i])
    first = min(max(int(np.searchsorted(X, 0.0)) - 2, 0), grid.nx - 4)
    nodes = X[first : first + 4]
    values = line[first : first + 4]
    weights = [
        np.prod([-other / (node - other) for other in nodes if other != node]) for node in nodes
    ]
    return float(np.dot(weights, values))


def film_values(grid: Grid, H: Array) -> tuple[float, float]:
    """Central film, and minimum film by a parabola in each direction [-]."""
    j, i = np.unravel_index(int(np.argmin(H)), H.shape)
    minimum = float(H[j, i])
    if 0 < i < grid.nx - 1:
        minimum -= _dip(H[j, i - 1], H[j, i], H[j, i + 1])
    if grid.symmetric and j == 0:
        return central_film(grid, H), minimum
    if 0 < j < grid.ny - 1:
        minimum -= _dip(H[j - 1, i], H[j, i], H[j + 1, i])
    return central_film(grid, H), minimum


def _dip(before: float, middle: float, after: float) -> float:
    """How far the parabola through three equidistant values dips below the middle one."""
    curvature = before - 2.0 * middle + after
    return (after - before) ** 2 / (8.0 * curvature) if curvature > 0.0 else 0.0
