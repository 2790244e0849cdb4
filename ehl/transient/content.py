"""Content of oil of a contact over time."""

from math import floor

import numpy as np
from numpy.typing import NDArray

from ..arrays import Array


def weights(ratio: float) -> tuple[float, float, float]:
    """Weight the steps of the second-order backward difference, c_0, c_1 and c_2.

    Parameters
    ----------
    ratio : float
        step over the one before [-]

    Returns
    -------
    c_0
        weight of the new step [-]
    c_1
        weight of the last step [-]
    c_2
        weight of the step before [-]
    """
    return (1.0 + 2.0 * ratio) / (1.0 + ratio), 1.0 + ratio, ratio**2 / (1.0 + ratio)


def advected(content: Array, nodes: float) -> Array:
    """Shift a content along the lines.

    Whole nodes exactly, else by cubics through four of them; beyond the ends the lines continue as
    parabolas, which is exact in the gap of paraboloids.

    Parameters
    ----------
    content : Array
        oil of the nodes, shape (ny, nx) [-]
    nodes : float
        nodes to shift by, of either sign [-]

    Returns
    -------
    Array
        shifted content, shape (ny, nx) [-]
    """
    whole = floor(nodes)
    part = nodes - whole
    n = content.shape[1]
    pad = abs(whole) + 2
    wide = _extended(content, pad)

    def at(steps: int) -> Array:
        first = pad - steps
        return wide[:, first : first + n]

    if part == 0.0:
        return at(whole).copy()
    # places in nodes upstream of the whole one: -1, 0, 1, 2
    positions = (-1.0, 0.0, 1.0, 2.0)
    total = np.zeros_like(content)
    for position in positions:
        others = [other for other in positions if other != position]
        weight = np.prod([(part - other) / (position - other) for other in others])
        total += weight * at(whole + round(position))
    return total


def _extended(content: Array, pad: int) -> Array:
    """Lines with so many more nodes at both ends."""
    k = np.arange(1, pad + 1)
    # weights of a parabola through the last three nodes, k nodes beyond
    nearest = (k + 1.0) * (k + 2.0) / 2.0
    middle = -k * (k + 2.0)
    farthest = k * (k + 1.0) / 2.0
    left = np.outer(content[:, 0], nearest) + np.outer(content[:, 1], middle)
    left += np.outer(content[:, 2], farthest)
    right = np.outer(content[:, -1], nearest) + np.outer(content[:, -2], middle)
    right += np.outer(content[:, -3], farthest)
    return np.concatenate((left[:, ::-1], content, right), axis=1)


def steady_content(full: Array, gained: Array, empty: NDArray[np.bool_], mesh: float) -> Array:
    """Evaluate the oil m of the nodes of a steady film that flows along its lines.

    Where oil does not fill the gap it is marched downstream by the same three-node difference,
    never more than the gap holds.

    Parameters
    ----------
    full : Array
        rho H, shape (ny, nx) [-]
    gained : Array
        Poiseuille term of the pressure, shape (ny, nx) [-]
    empty : NDArray[np.bool_]
        True at nodes without pressure, shape (ny, nx)
    mesh : float
        mesh size along the lines [-]

    Returns
    -------
    Array
        oil of the nodes, shape (ny, nx) [-]
    """
    content = full.copy()
    for i in range(2, full.shape[1]):
        flow = (2.0 * content[:, i - 1] - 0.5 * content[:, i - 2] + mesh * gained[:, i]) / 1.5
        carried = np.clip(flow, 0.0, full[:, i])
        content[:, i] = np.where(empty[:, i], carried, full[:, i])
    return content
