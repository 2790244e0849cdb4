"""Uniform cubic B-splines through values on a grid: coefficients, and weights at a place (de Boor,
1978).

With n nodes there are n + 2 coefficients; on the interval i the spline is sum c_(i+k) w_k(t), w =
((1-t)^3, 4 - 6 t^2 + 3 t^3, 4 - 6 (1-t)^2 + 3 (1-t)^3, t^3)/6. The two conditions left are the
continuity of the third derivative at the second and the last but one node.
"""

from math import prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Array

SMALLEST = 4  # nodes that the end conditions need
MIN_INNER = 16  # numbers side by side behind an axis
Numbers = NDArray[Any]  # of single or double precision


def spline_matrix(nodes: int) -> Array:
    """Build the linear map from values at the nodes to coefficients.

    Parameters
    ----------
    nodes : int
        number of nodes [-]

    Returns
    -------
    Array
        matrix, shape (nodes + 2, nodes) [-]
    """
    if nodes < SMALLEST:
        raise ValueError(f"nodes must be at least {SMALLEST}, got {nodes}")
    system = np.zeros((nodes + 2, nodes + 2))
    for k in range(nodes):
        system[k, k : k + 3] = np.array([1.0, 4.0, 1.0]) / 6.0
    fourth = np.array([1.0, -4.0, 6.0, -4.0, 1.0])
    first = min(5, nodes + 2)
    system[nodes, :first] = fourth[:first]
    system[nodes + 1, -5:] = fourth
    return np.asarray(np.linalg.solve(system, np.eye(nodes + 2)[:, :nodes]), dtype=np.float64)


def spline_coefficients(values: Numbers, axes: tuple[int, ...]) -> Numbers:
    """Fit coefficients to values along axes, each of which grows by two.

    Parameters
    ----------
    values : Numbers
        values at the nodes [any unit]
    axes : tuple[int, ...]
        axes of the splines

    Returns
    -------
    Numbers
        coefficients [same unit]
    """
    for axis in axes:
        values = along_axis(spline_matrix(values.shape[axis]), values, axis)
    return np.ascontiguousarray(values)


def along_axis(matrix: Array, values: Numbers, axis: int) -> Numbers:
    """Multiply values by a matrix along an axis, which keeps its position, in their precision.

    Parameters
    ----------
    matrix : Array
        matrix, shape (m, n) [-]
    values : Numbers
        values with n numbers along the axis [any unit]
    axis : int
        number of the axis

    Returns
    -------
    Numbers
        values with m numbers along it [same unit]
    """
    map_matrix: Numbers = matrix.astype(values.dtype, copy=False)
    before = values.shape[:axis]
    after = values.shape[axis + 1 :]
    inner = prod(after)
    if inner < MIN_INNER:  # one product in place of many small ones
        turned = np.kron(map_matrix.T, np.eye(inner, dtype=map_matrix.dtype))
        product = values.reshape(prod(before), -1) @ turned
    else:
        product = map_matrix @ values.reshape(prod(before), values.shape[axis], inner)
    return np.asarray(product.reshape(*before, matrix.shape[0], *after))


def node_values(coefficients: Array, axes: tuple[int, ...]) -> Array:
    """Invert `spline_coefficients`.

    Parameters
    ----------
    coefficients : Array
        coefficients [any unit]
    axes : tuple[int, ...]
        axes of the splines

    Returns
    -------
    Array
        values at the nodes [same unit]
    """
    for axis in axes:
        c = np.moveaxis(coefficients, axis, 0)
        coefficients = np.moveaxis((c[:-2] + 4.0 * c[1:-1] + c[2:]) / 6.0, 0, axis)
    return np.ascontiguousarray(coefficients)


def spline_weights(place: float, nodes: int) -> tuple[int, Array]:
    """Evaluate the weights of the four coefficients around a position.

    Parameters
    ----------
    place : float
        position in units of the node distance [-]
    nodes : int
        number of nodes [-]

    Returns
    -------
    first
        number of the first coefficient [-]
    weights
        weights, shape (4,) [-]
    """
    i = min(max(int(np.floor(place)), 0), nodes - 2)
    t = place - i
    r = 1.0 - t
    inner, outer = 4.0 - 6.0 * t**2 + 3.0 * t**3, 4.0 - 6.0 * r**2 + 3.0 * r**3
    return i, np.array([r**3, inner, outer, t**3]) / 6.0


def leave_one_out_error(values: Numbers, axis: int) -> float:
    """Predict each inner node by cubics through the four nearest other nodes.

    The error is 64/9 times that of a cubic half-way between its inner nodes.

    Parameters
    ----------
    values : Numbers
        values at the nodes [any unit]
    axis : int
        axis of the nodes

    Returns
    -------
    float
        largest error over all [same unit]
    """
    v = np.moveaxis(values, axis, 0)
    n = v.shape[0]
    worst = 0.0
    for k in range(1, n - 1):
        others = sorted((j for j in range(n) if j != k), key=lambda j: (abs(j - k), j))[:4]
        weights = [np.prod([(k - j) / (i - j) for j in others if j != i]) for i in others]
        guess = sum(weight * v[i] for weight, i in zip(weights, others, strict=True))
        worst = max(worst, float(np.abs(guess - v[k]).max()))
    return worst
