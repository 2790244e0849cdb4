"""Friction of a rolling contact as a law: `FrictionLaw`, and coefficients over the Hertz ellipse.

All laws have the same method `forces(load, speed, slide_x, slide_y, spin)` and the arrays with
which compiled code does the same (`_kernels.table_lookup`, `_kernels.hertz_friction`).
"""

from dataclasses import dataclass
from functools import cached_property
from math import e, exp, inf, isfinite
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from . import _kernels
from .quadrature import ellipse_rings

Array = NDArray[np.float64]

RINGS = 16  # of the quadrature over the ellipse: force to 0.5 % of mu Q
RAYS = 32  # see there
# slide over entrainment speed up to which a four-constant law rises from zero [-]: a
# regularisation, far below the slide of the largest coefficient (about 0.03)
DEAD_BAND = 1e-4


class TractionForces(NamedTuple):
    """Traction on body 1, the ball, at a contact's centre; SI."""

    force_x: float  # [N]
    force_y: float  # [N]
    spin_moment: float  # [N m]
    rolling_moment: float  # [N m]
    power_loss: float  # [W]
    film: float  # zero, as what follows, where a law has none [m]
    stiffness: float  # [N/m]
    damping: float  # [N s/m]
    outside: tuple[str, ...]  # what lay outside the range of the law


class FrictionLaw(Protocol):
    """What a bearing model asks of a contact's friction."""

    def forces(
        self, load: float, speed: float, slide_x: float, slide_y: float, spin: float
    ) -> TractionForces:
        """Forces on body 1 at a load [N], entrainment speed, slides [m/s], and spin [rad/s]."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactShape:
    """Ellipse and curvature of a contact: what turns a coefficient into forces and moments."""

    semi_axis_x: float  # along the entrainment, at 1 N; grows with the cube root of the load [m]
    semi_axis_y: float  # across, at 1 N [m]
    radius_x: float  # reduced, along the entrainment [m]
    curvature_radius: float = inf  # of the loaded surface across; infinite: no curvature slip [m]
    curvature_difference: float = 0.0  # 1/R_2x - 1/R_1x [1/m]

    @property
    def constants(self) -> Array:
        """As the kernel takes them, shape (5,) [m], [1/m]."""
        axes = (self.semi_axis_x, self.semi_axis_y)
        curvatures = (0.5 / self.curvature_radius, self.curvature_difference)
        return np.array([*axes, self.radius_x, *curvatures])


@dataclass(frozen=True)
class HertzLaw:
    """A coefficient of friction that depends on the local sliding, over the Hertz ellipse."""

    shape: ContactShape

    @cached_property
    def disc(self) -> Array:
        """Places x/a, y/b and shares of the load of the quadrature [-]."""
        return ellipse_rings(RINGS, RAYS)

    def kernel_law(self) -> Array:
        """Kind and constants as the kernel takes them, [-] and [m/s]."""
        raise NotImplementedError

    def forces(
        self, load: float, speed: float, slide_x: float, slide_y: float, spin: float
    ) -> TractionForces:
        """Forces on body 1 at a load [N], entrainment speed, slides [m/s], and spin [rad/s]."""
        out = np.empty(8)
        law = (self.disc, self.kernel_law(), self.shape.constants)
        _kernels.hertz_friction(*law, load, speed, slide_x, slide_y, spin, out)
        return TractionForces._make((*map(float, out), ()))


@dataclass(frozen=True)
class CoulombLaw(HertzLaw):
    """Coulomb friction with dead band and ramp (Ambrosio): zero to v_0, full from v_1 on."""

    friction: float = 0.1  # mu [-]
    slide_none: float = 0.0  # v_0, sliding speed [m/s]
    slide_full: float = 1e-3  # v_1, sliding speed [m/s]

    def __post_init__(self) -> None:
        if not (isfinite(self.friction) and self.friction >= 0.0):
            raise ValueError(
                f"friction must be zero or positive and finite, got {self.friction!r}"
            )
        if not 0.0 <= self.slide_none < self.slide_full:
            raise ValueError(
                f"slide_full must exceed slide_none {self.slide_none}, got {self.slide_full!r}"
            )

    def kernel_law(self) -> Array:
        """Kind 0, mu, v_0, v_1: [-], [m/s]."""
        return np.array([0.0, self.friction, self.slide_none, self.slide_full])


@dataclass(frozen=True)
class FourConstantLaw(HertzLaw):
    """mu = (A + B s) exp(-C s) + D of bearing dynamics codes, s the local slide over the
    entrainment speed.

    Below `dead_band` the coefficient rises linearly from zero, for friction has no direction where
    nothing slides.
    """

    a: float = 0.0  # A [-]
    b: float = 0.0  # B [-]
    c: float = 1.0  # C [-]
    d: float = 0.0  # D [-]
    dead_band: float = DEAD_BAND  # s up to which the coefficient is ramped [-]

    def __post_init__(self) -> None:
        if not all(isfinite(value) for value in (self.a, self.b, self.c, self.d)):
            raise ValueError(f"a, b, c, d must be finite, got {(self.a, self.b, self.c, self.d)}")
        if not self.dead_band > 0.0:
            raise ValueError(f"dead_band must be positive, got {self.dead_band!r}")

    def kernel_law(self) -> Array:
        """Kind 1, A to D, dead band [-]."""
        return np.array([1.0, self.a, self.b, self.c, self.d, self.dead_band])


def four_constants(
    largest: float, slide: float, limit: float, zero: float = 0.0
) -> tuple[float, float, float, float]:
    """A, B, C, D [-] of mu = (A + B s) exp(-C s) + D from a traction curve: the largest value
    kappa_max at the slide s, the limit kappa_inf at large s, and kappa_0 at s = 0.

    D = kappa_inf, A = kappa_0 - kappa_inf, and with q = C s: B = C A/(1 - q), A exp(-q)/(1 - q) =
    kappa_max - D.
    """
    if not (isfinite(slide) and slide > 0.0):
        raise ValueError(f"slide must be positive and finite, got {slide!r}")
    if not largest > max(limit, zero):
        raise ValueError(f"largest must exceed limit {limit} and zero {zero}, got {largest!r}")
    a, rise = zero - limit, largest - limit
    if a == 0.0:
        return 0.0, e * rise / slide, 1.0 / slide, limit

    def excess(q: float) -> float:
        return a * exp(-q) - rise * (1.0 - q)

    q = brentq(excess, 0.0, 1.0) if a > 0.0 else brentq(excess, 1.0, 2.0 - a / rise)
    c = float(q) / slide
    return a, c * a / (1.0 - float(q)), c, limit
