"""The type of the arrays of numbers, interpolation weights, terms of Gaussian processes and groups
of equal rows.
"""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

SAME = 1.0e-12  # within which two numbers count as one, over the scale of their column [-]


def lagrange_weights(nodes: Array, point: Array | float) -> Array:
    """Lagrange's interpolation weights of the values at k nodes.

    Parameters
    ----------
    nodes : Array
        positions of the values, shape (..., k) [any unit]
    point : Array | float
        position to interpolate at, a number or shape (...) [unit of `nodes`]

    Returns
    -------
    Array
        weights, shape (..., k) [-]
    """
    apart = nodes[..., :, None] - nodes[..., None, :]
    away = np.asarray(point)[..., None, None] - nodes[..., None, :]
    same = apart == 0.0
    return np.asarray(np.prod(np.where(same, 1.0, away) / np.where(same, 1.0, apart), axis=-1))


def trend_terms(x: Array) -> Array:
    """Evaluate 1, x_j and x_j x_k.

    Parameters
    ----------
    x : Array
        positions, shape (m, d) [-]

    Returns
    -------
    Array
        terms, shape (m, 1 + d + d (d + 1)/2) [-]
    """
    first, second = np.triu_indices(x.shape[1])
    return np.concatenate([np.ones((len(x), 1)), x, x[:, first] * x[:, second]], axis=1)


def radial(x: Array, places: Array, scales: Array) -> Array:
    """Evaluate Matern's radial functions of 5/2.

    Parameters
    ----------
    x : Array
        positions, shape (m, d) [-]
    places : Array
        centres of the functions, shape (n, d) [-]
    scales : Array
        scales along the axes, shape (d,) [-]

    Returns
    -------
    Array
        functions, shape (m, n) [-]
    """
    steps = (x[:, None, :] - places[None, :, :]) / scales
    t = np.sqrt(5.0 * np.einsum("ijk,ijk->ij", steps, steps))
    return np.asarray((1.0 + t + t**2 / 3.0) * np.exp(-t))


def unique_rows(rows: Array) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Groups of equal rows of a table, up to round-off.

    Balls on both sides of a load line, or all balls under a thrust, are the same but for rounding:
    an equilibrium leaves their loads apart by some 1e-13.

    Parameters
    ----------
    rows : Array
        numbers over the scale of their column, shape (n, m) [-]; infinite ones count as equal

    Returns
    -------
    first
        number of the first row of each group, shape (groups,)
    group
        number of the group of each row, shape (n,)
    """
    rounded = np.rint(np.where(np.isfinite(rows), rows, 0.0) / SAME)
    groups: dict[bytes, int] = {}
    first: list[int] = []
    group = np.empty(len(rows), dtype=np.int64)
    for number, row in enumerate(rounded + 0.0):
        key = row.tobytes()
        if key not in groups:
            groups[key] = len(first)
            first.append(number)
        group[number] = groups[key]
    return np.array(first, dtype=np.int64), group
