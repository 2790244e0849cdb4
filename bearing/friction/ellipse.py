r"""Coulomb friction of ball and race as a potential of their relative motion.

With the motion k = (S_x, S_y, Omega, omega) of ball against race
(`ehl.traction.ContactKinematics`) the ball slides at

    s_x = S_x - Omega y - omega y^2/(2 R),      s_y = S_y + Omega x,

which is linear in k. Friction mu p against the sliding is then the gradient of the power
:math:`\phi(k) = \mu \iint p\,|s|\,dA`, a convex function:

    d phi/dk = -(F_x, F_y, M_n, M_y),   forces and moments on the ball about n and y at the
    contact's centre,

so that the motion in which friction balances itself on the ball is the one of least power. Two
laws: the full integral over Hertz's ellipse, and the one of narrow ellipses, which leaves out s_y
(lines of pure rolling; Jones, 1959). Array axes: contacts first.
"""

from dataclasses import dataclass
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..geometry import Array
from . import _kernels

LINE_NODES = 48  # along the transverse axis
CHORD_NODES = 8  # and along each chord in the rolling direction
TINY = 1.0e-300


@dataclass(frozen=True, slots=True, kw_only=True)
class Ellipses:
    """Loaded ellipses of contacts, each of shape (N,).

    Attributes
    ----------
    load : ndarray
        Q [N]; zero where there is no contact.
    semi_axis_x, semi_axis_y : ndarray
        Along and across the rolling direction [m]; positive also where unloaded.
    radius : ndarray
        R of the loaded surface across the rolling direction [m].
    friction : ndarray
        Coulomb's mu [-].
    rounding : ndarray
        e, speed of sliding below which friction is rounded off where it is integrated by
        quadrature [m/s].
    """

    load: Array
    semi_axis_x: Array
    semi_axis_y: Array
    radius: Array
    friction: Array
    rounding: Array

    def some(self, numbers: NDArray[np.int64]) -> "Ellipses":
        """Those with these numbers [-]."""
        return Ellipses(
            load=self.load[numbers],
            semi_axis_x=self.semi_axis_x[numbers],
            semi_axis_y=self.semi_axis_y[numbers],
            radius=self.radius[numbers],
            friction=self.friction[numbers],
            rounding=self.rounding[numbers],
        )


class Dissipation(NamedTuple):
    """Power phi (N,) [W], its gradient (N, 4) and curvature (N, 4, 4) by the motion k in SI."""

    power: Array
    gradient: Array
    curvature: Array


def line_dissipation(motion: Array, ellipses: Ellipses) -> Dissipation:
    """Friction of narrow ellipses: exact integrals between the lines of pure rolling, the roots of
    s_x.

    Parameters
    ----------
    motion : ndarray, shape (N, 4)
        S_x, S_y [m/s], Omega and omega [rad/s]; S_y is not looked at.
    ellipses : Ellipses

    Returns
    -------
    Dissipation
        In [W] and its derivatives.
    """
    a = ellipses.semi_axis_y
    slide = motion[:, 0]
    tilt = motion[:, 2] * a
    bend = motion[:, 3] * a**2 / (2.0 * ellipses.radius)
    roots = _roots(slide, tilt, bend)
    signs = np.where(bend >= 0.0, 1.0, -1.0)
    between = np.clip(roots, -1.0, 1.0)
    moments = [
        signs * (2.0 * (_moment(between[1], n) - _moment(between[0], n)) - _WHOLE[n])
        for n in range(3)
    ]
    scale = ellipses.friction * ellipses.load
    arms = np.stack(
        [np.ones_like(a), np.zeros_like(a), -a, -(a**2) / (2.0 * ellipses.radius)], axis=1
    )
    gradient = (
        scale[:, None] * arms * np.stack([moments[0], 0.0 * a, moments[1], moments[2]], axis=1)
    )
    curvature = np.zeros((a.size, 4, 4))
    for u in roots:
        inside = np.abs(u) < 1.0
        v = np.where(inside, u, 0.0)
        slope = np.maximum(
            np.abs(tilt + 2.0 * bend * v), 1e-9 * (np.abs(tilt) + np.abs(bend)) + TINY
        )
        weight = np.where(inside, scale * 1.5 * (1.0 - v**2) / slope, 0.0)
        arm = arms * np.stack([np.ones_like(v), np.zeros_like(v), v, v**2], axis=1)
        curvature += weight[:, None, None] * arm[:, :, None] * arm[:, None, :]
    return Dissipation(np.einsum("nk,nk->n", gradient, motion), gradient, curvature)


_WHOLE = (1.0, 0.0, 0.2)  # integrals of 3/4 (1 - u^2) u^n over the contact


def _moment(u: Array, power: int) -> Array:
    """Integral of 3/4 (1 - u^2) u^n from 0 [-]."""
    return 0.75 * (u ** (power + 1) / (power + 1) - u ** (power + 3) / (power + 3))


def _roots(slide: Array, tilt: Array, bend: Array) -> Array:
    """Roots of bend u^2 + tilt u - slide, the lower first, shape (2, N) [-]; both at 2 where there
    are none.
    """
    discriminant = tilt**2 + 4.0 * bend * slide
    with np.errstate(divide="ignore", invalid="ignore"):
        q = -0.5 * (
            tilt + np.where(tilt >= 0.0, 1.0, -1.0) * np.sqrt(np.maximum(discriminant, 0.0))
        )
        pair = np.stack([q / bend, -slide / q])
    pair = np.nan_to_num(pair, nan=0.0, posinf=1e30, neginf=-1e30)
    return np.where(discriminant > 0.0, np.sort(pair, axis=0), 2.0)


def coulomb_dissipation(motion: Array, ellipses: Ellipses) -> Dissipation:
    """Friction over the whole ellipse, both directions of sliding, by quadrature; motion as in
    `line_dissipation`.

    |s| is rounded to sqrt(s^2 + e^2) [m/s]. Hertz's pressure is taken into the weights.
    """
    e = ellipses
    n = motion.shape[0]
    shapes = np.stack(
        [e.friction * e.load, e.semi_axis_x, e.semi_axis_y, 0.5 / e.radius, e.rounding], axis=1
    )
    found = Dissipation(np.empty(n), np.empty((n, 4)), np.empty((n, 4, 4)))
    _kernels.coulomb_sums(_nodes(), shapes, motion, *found)
    return found


def coulomb_dissipation_twin(motion: Array, ellipses: Ellipses) -> Dissipation:
    """As `coulomb_dissipation`, in NumPy; motion in [m/s], [rad/s]."""
    a, b = ellipses.semi_axis_y[:, None], ellipses.semi_axis_x[:, None]
    places_x, places_y, weight = _nodes()
    x, y = b * places_x, a * places_y
    bow = -(y**2) / (2.0 * ellipses.radius[:, None])
    k = motion[:, :, None]
    along = k[:, 0] - k[:, 2] * y + k[:, 3] * bow
    across = k[:, 1] + k[:, 2] * x
    speed = np.sqrt(along**2 + across**2 + ellipses.rounding[:, None] ** 2)
    pull = (ellipses.friction * ellipses.load)[:, None] * weight / speed
    ones, zeros = np.ones_like(x), np.zeros_like(x)
    by_along = np.stack([ones, zeros, -y, bow], axis=1)
    by_across = np.stack([zeros, ones, x, zeros], axis=1)
    slope = along[:, None] * by_along + across[:, None] * by_across
    gradient = np.einsum("nq,nkq->nk", pull, slope)
    curvature = np.einsum("nq,nkq,nlq->nkl", pull, by_along, by_along)
    curvature += np.einsum("nq,nkq,nlq->nkl", pull, by_across, by_across)
    curvature -= np.einsum("nq,nkq,nlq->nkl", pull / speed**2, slope, slope)
    return Dissipation(np.sum(pull * speed**2, axis=1), gradient, curvature)


@cache
def _nodes() -> Array:
    """Places x/b and y/a, and weights p dA/Q of the quadrature, shape (3, nodes) [-]."""
    u, along = np.polynomial.legendre.leggauss(LINE_NODES)
    # Gauss-Chebyshev, second kind
    angle = np.pi * (np.arange(CHORD_NODES) + 1.0) / (CHORD_NODES + 1.0)
    t = np.cos(angle)
    across = 2.0 / (CHORD_NODES + 1.0) * np.sin(angle) ** 2
    weight = 0.75 * ((1.0 - u**2) * along)[:, None] * across[None, :]
    chord = np.sqrt(1.0 - u**2)[:, None] * t[None, :]
    return np.stack([chord.ravel(), np.repeat(u, t.size), weight.ravel()])
