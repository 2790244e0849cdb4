"""Which of many rows of numbers are the same but for rounding: balls on both sides of a load line,
or all balls under a thrust, whose loads an equilibrium leaves apart by some 1e-13.
"""

import numpy as np
from numpy.typing import NDArray

from ..geometry import Array

SAME = 1.0e-12  # within which two numbers count as one, over the scale of their column [-]


def alike(rows: Array) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """First row of each kind, and the kind of each row, of rows (n, m) of numbers over the scale
    of their column [-]; infinite ones are all the same.
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
