"""Cells between the nodes of a grid in space."""

import numpy as np
from numpy.typing import NDArray


def hexahedra(number: NDArray[np.int64]) -> NDArray[np.int64]:
    """Corners of the cells between the nodes of a grid.

    Parameters
    ----------
    number : NDArray[np.int64]
        Numbers of the nodes, shape (nx, ny, nz).

    Returns
    -------
    NDArray[np.int64]
        Corners, lower face first, shape (cells, 8).
    """
    low = slice(None, -1)
    high = slice(1, None)
    around = ((low, low), (high, low), (high, high), (low, high))
    corners = [number[(*place, depth)].ravel() for depth in (low, high) for place in around]
    return np.stack(corners, axis=1)
