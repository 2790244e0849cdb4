"""The frame of a contact: principal directions, parts of its grid, values at other nodes."""

import numpy as np

from ehl.solution import Array

ALL = (slice(None), slice(None))  # of the nodes of a grid


def principal_coordinates(x: Array, y: Array, angle: float) -> tuple[Array, Array]:
    """Principal coordinates [m], shapes (nx, ny), of nodes along and across the entrainment.

    `angle` of the entrainment: from the principal direction x towards y [rad].
    """
    along, across = np.meshgrid(x, y, indexing="ij")
    c, s = np.cos(angle), np.sin(angle)
    return c * along - s * across, s * along + c * across


def within(values: Array, low: float, high: float) -> slice:
    """Index range of the ascending `values` that lie in [low, high], all in one unit."""
    return slice(
        int(np.searchsorted(values, low, "left")), int(np.searchsorted(values, high, "right"))
    )


def resampled(
    x: Array, y: Array, values: Array, new_x: Array, new_y: Array, outside: float | None = None
) -> Array:
    """Values at other nodes, linear in both directions; beyond the ends those there [their unit].

    Or `outside`, in the same unit. The nodes x, y need not be even.
    """

    def along(new: Array, old: Array, lines: Array) -> Array:
        return np.array([np.interp(new, old, line, outside, outside) for line in lines])

    return along(new_y, y, along(new_x, x, values.T).T)
