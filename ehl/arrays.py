"""The type of the arrays of numbers, and which rows of one are the same."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

SAME = 1.0e-12  # within which two numbers count as one, over the scale of their column [-]


def lagrange_weights(places: Array, place: Array | float) -> Array:
    """Lagrange's weights of values at k places [same unit] at another place [-]; of many at once
    where places have the shape (..., k) and those others the shape (...).
    """
    apart = places[..., :, None] - places[..., None, :]
    away = np.asarray(place)[..., None, None] - places[..., None, :]
    same = apart == 0.0
    return np.asarray(np.prod(np.where(same, 1.0, away) / np.where(same, 1.0, apart), axis=-1))


def alike(rows: Array) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """First row of each kind, and the kind of each row, of rows (n, m) of numbers over the scale
    of their column [-]; infinite ones are all the same.

    Balls on both sides of a load line, or all balls under a thrust, are the same but for rounding:
    an equilibrium leaves their loads apart by some 1e-13.
    """
    kinds = np.rint(np.where(np.isfinite(rows), rows, 0.0) / SAME)
    known: dict[bytes, int] = {}
    first: list[int] = []
    like = np.empty(len(rows), dtype=np.int64)
    for number, kind in enumerate(kinds + 0.0):
        key = kind.tobytes()
        if key not in known:
            known[key] = len(first)
            first.append(number)
        like[number] = known[key]
    return np.array(first, dtype=np.int64), like
