"""The type of the arrays of numbers."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def lagrange_weights(places: Array, place: float) -> Array:
    """Lagrange's weights of values at places [same unit] at another place [-]."""
    return np.array([np.prod([(place - b) / (a - b) for b in places if b != a]) for a in places])
