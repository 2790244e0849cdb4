"""The frame of a contact: principal directions, parts of its grid, values at other nodes."""

import numpy as np
from scipy.interpolate import PchipInterpolator

from ehl.arrays import Array

ALL = (slice(None), slice(None))  # of the nodes of a grid


def principal_coordinates(x: Array, y: Array, angle: float) -> tuple[Array, Array]:
    """Principal coordinates of nodes along and across the entrainment.

    Parameters
    ----------
    x : Array
        Nodes along the entrainment, shape (nx,) [m].
    y : Array
        Nodes across it, shape (ny,) [m].
    angle : float
        Angle of the entrainment from the principal direction x towards y [rad].

    Returns
    -------
    value
        x, shape (nx, ny) [m].
    value
        y, shape (nx, ny) [m].
    """
    along, across = np.meshgrid(x, y, indexing="ij")
    c, s = np.cos(angle), np.sin(angle)
    return c * along - s * across, s * along + c * across


def within(values: Array, low: float, high: float) -> slice:
    """Index range of the values that lie in [low, high].

    Parameters
    ----------
    values : Array
        Ascending values [any unit].
    low : float
        Lower end, in that unit.
    high : float
        Upper end, in that unit.

    Returns
    -------
    slice
        The range.
    """
    return slice(
        int(np.searchsorted(values, low, "left")), int(np.searchsorted(values, high, "right"))
    )


def resampled(
    x: Array, y: Array, values: Array, new_x: Array, new_y: Array, outside: float | None = None
) -> Array:
    """Values at other nodes, linear in both directions.

    Parameters
    ----------
    x : Array
        Nodes, shape (nx,), which need not be even [any unit].
    y : Array
        Nodes, shape (ny,).
    values : Array
        Field at the nodes, shape (nx, ny).
    new_x : Array
        Other nodes, shape (n,).
    new_y : Array
        Other nodes, shape (m,).
    outside : float | None, optional
        Value beyond the ends; those at the ends if None.

    Returns
    -------
    Array
        Values, shape (n, m).
    """

    def along(new: Array, old: Array, lines: Array) -> Array:
        return np.array([np.interp(new, old, line, outside, outside) for line in lines])

    return along(new_y, y, along(new_x, x, values.T).T)


def refined(x: Array, y: Array, field: Array, least: int) -> tuple[Array, Array, Array]:
    """Positions and values between the nodes of a field, at equal steps.

    Cubic, with a continuous slope and without new extremes (Fritsch and Carlson, SIAM J. Numer.
    Anal. 17, 1980), so that a coarse mesh shows no kinks; linear where values are not finite.

    Parameters
    ----------
    x : Array
        Nodes, shape (nx,) [any unit].
    y : Array
        Nodes, shape (ny,).
    field : Array
        Values, shape (nx, ny).
    least : int
        Nodes each way, at least [-].

    Returns
    -------
    value
        Positions along, shape (n,).
    value
        Positions across, shape (m,).
    value
        Values, shape (n, m).
    """
    fine_x = np.linspace(x[0], x[-1], max(least, len(x)))
    fine_y = np.linspace(y[0], y[-1], max(least, len(y)))
    if min(field.shape) < 2 or not np.isfinite(field).all():
        return fine_x, fine_y, resampled(x, y, field, fine_x, fine_y)
    along = PchipInterpolator(x, field, axis=0)(fine_x)
    return fine_x, fine_y, PchipInterpolator(y, along, axis=1)(fine_y)


def around(values: Array, low: float, high: float) -> slice:
    """Index range of the values that cover [low, high]: one more than `within` at each end.

    Parameters
    ----------
    values : Array
        Ascending values [any unit].
    low : float
        Lower end, in that unit.
    high : float
        Upper end, in that unit.

    Returns
    -------
    slice
        The range.
    """
    inner = within(values, low, high)
    return slice(max(inner.start - 1, 0), min(inner.stop + 1, len(values)))
