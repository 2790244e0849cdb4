"""Coulomb friction over the Hertz ellipse: sums as compiled, in NumPy; the least power by a scalar search."""

from __future__ import annotations

from math import pi

import numpy as np
from scipy.optimize import minimize_scalar

from oilfilm.bearing.friction.contact_friction import Dissipation
from oilfilm.bearing.friction.coulomb import Ellipses
from oilfilm.bearing.torque.paper_models import SlidingContact
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.traction.shear import EllipseRule, ellipse_nodes

# of the quadrature over the ellipse
RADII = 24
ANGLES = 64


def coulomb_dissipation_twin(motion: Array, ellipses: Ellipses) -> Dissipation:
    """`ellipse_sums` in NumPy; motion in [m/s], [rad/s]."""
    a, b = ellipses.semi_axis_y[:, None], ellipses.semi_axis_x[:, None]
    places_x, places_y, weight = ellipse_nodes(EllipseRule.BALANCE)
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


def coulomb_power(contact: SlidingContact, friction: float) -> float:
    """Friction power of a contact under Coulomb's law, integrated over the ellipse in both
    directions [W].

    The sliding of the centre along the rolling direction is that for which no net force is left.
    The friction force is the derivative of the power by it, so that it is the one of least power;
    mu [-].
    """
    area, x, y = _quadrature(contact)
    curved = contact.rolling * (y * y - 0.25 * contact.semi_axis**2) / (2.0 * contact.radius)
    across = (contact.spin * x) ** 2

    def power(slide: float) -> float:
        along = slide - contact.spin * y - curved
        return float(np.sum(area * np.sqrt(along * along + across)))

    bound = contact.spin * contact.semi_axis + contact.rolling * contact.semi_axis**2 / (2.0 * contact.radius)
    if bound == 0.0:
        return 0.0
    best = minimize_scalar(power, bounds=(-bound, bound), method="bounded", options={"xatol": 1e-9 * bound})
    return friction * contact.load * float(best.fun)


def _quadrature(contact: SlidingContact) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Weights p dA/Q with Hertz's pressure, and places x, y of the nodes [m]."""
    nodes, weights = np.polynomial.legendre.leggauss(RADII)
    t = 0.25 * pi * (nodes + 1.0)  # r = sin t takes the root out of the pressure
    angle = (np.arange(ANGLES) + 0.5) * 2.0 * pi / ANGLES
    r = np.sin(t)[:, None]
    f = angle[None, :]
    weight = 0.25 * pi * weights * 1.5 * np.cos(t) ** 2 * np.sin(t) / pi
    area = np.broadcast_to(weight[:, None] * 2.0 * pi / ANGLES, (RADII, ANGLES))
    return area, contact.semi_axis_rolling * r * np.cos(f), contact.semi_axis * r * np.sin(f)


def coulomb_torque(contacts: tuple[SlidingContact, ...], speed: float, friction: float) -> float:
    """Torque under Coulomb's law, both directions of sliding [N m]; speed [rad/s], mu [-]."""
    return sum(coulomb_power(c, friction) for c in contacts) / speed
