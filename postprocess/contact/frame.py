"""The frame of a contact: its principal directions, and parts of its grid."""

import numpy as np

from ehl.solution import Array


def principal_coordinates(x: Array, y: Array, angle: float) -> tuple[Array, Array]:
    """Coordinates along the principal directions of grid nodes whose x runs along the entrainment.

    Parameters
    ----------
    x, y : ndarray, shapes (nx,), (ny,)
        Node positions along and across the entrainment [m].
    angle : float
        Of the entrainment, from the principal direction x towards y [rad].

    Returns
    -------
    tuple of ndarray, shape (nx, ny)
        [m].
    """
    along, across = np.meshgrid(x, y, indexing="ij")
    c, s = np.cos(angle), np.sin(angle)
    return c * along - s * across, s * along + c * across


def within(values: Array, low: float, high: float) -> slice:
    """Index range of the ascending `values` that lie in [low, high], in the unit of `values`, as
    [-].
    """
    return slice(
        int(np.searchsorted(values, low, "left")), int(np.searchsorted(values, high, "right"))
    )
