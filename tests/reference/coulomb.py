"""Coulomb friction over the Hertz ellipse in NumPy, as `bearing.friction.coulomb` compiled."""

from __future__ import annotations

import numpy as np

from bearing.friction.coulomb import Ellipses, _nodes
from bearing.friction.law import Dissipation
from bearing.geometry import Array


def coulomb_dissipation_twin(motion: Array, ellipses: Ellipses) -> Dissipation:
    """As `coulomb_dissipation`, in NumPy; motion in [m/s], [rad/s]."""
    a, b = ellipses.semi_axis_y[:, None], ellipses.semi_axis_x[:, None]
    places_x, places_y, weight = _nodes()
    x, y = b * places_x, a * places_y
    curved = -(y**2) / (2.0 * ellipses.radius[:, None])
    k = motion[:, :, None]
    along = k[:, 0] - k[:, 2] * y + k[:, 3] * curved
    across = k[:, 1] + k[:, 2] * x
    speed = np.sqrt(along**2 + across**2 + ellipses.rounding[:, None] ** 2)
    pull = (ellipses.friction * ellipses.load)[:, None] * weight / speed
    ones, zeros = np.ones_like(x), np.zeros_like(x)
    by_along = np.stack([ones, zeros, -y, curved], axis=1)
    by_across = np.stack([zeros, ones, x, zeros], axis=1)
    slope = along[:, None] * by_along + across[:, None] * by_across
    gradient = np.einsum("nq,nkq->nk", pull, slope)
    curvature = np.einsum("nq,nkq,nlq->nkl", pull, by_along, by_along)
    curvature += np.einsum("nq,nkq,nlq->nkl", pull, by_across, by_across)
    curvature -= np.einsum("nq,nkq,nlq->nkl", pull / speed**2, slope, slope)
    return Dissipation(np.sum(pull * speed**2, axis=1), gradient, curvature)
