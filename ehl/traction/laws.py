"""Friction of a rolling contact as a law: from a table of solved films, or of a coefficient over
the Hertz ellipse.

All laws answer the same call, `forces(load, speed, slide_x, slide_y, spin)`, and carry the arrays
with which compiled code does the same (`_kernels.table_lookup`, `_kernels.hertz_friction`).
"""

from dataclasses import dataclass
from functools import cached_property
from math import e, exp, inf, isfinite
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from . import _kernels

Array = NDArray[np.float64]

# of the quadrature over the ellipse
RINGS = 16
RAYS = 32
# slide over entrainment speed up to which a four-constant law rises from zero [-]; a
# regularisation
DEAD_BAND = 1e-4


class TractionForces(NamedTuple):
    """Traction on body 1, the ball, at a contact's centre; SI.

    force_x, force_y [N], spin_moment, rolling_moment [N m], power_loss [W], film [m], stiffness
    [N/m], damping [N s/m] (zero where a law knows none), and in words what lay outside the law's
    range.
    """

    force_x: float
    force_y: float
    spin_moment: float
    rolling_moment: float
    power_loss: float
    film: float
    stiffness: float
    damping: float
    outside: tuple[str, ...]


def traction_forces(out: Array, outside: tuple[str, ...] = ()) -> TractionForces:
    """The 8 numbers of a kernel [N], [N m], [W], [m], [N/m], [N s/m] as a result."""
    force_x, force_y, spin, rolling, power, film, stiffness, damping = (
        float(value) for value in out
    )
    return TractionForces(
        force_x, force_y, spin, rolling, power, film, stiffness, damping, outside
    )


class FrictionLaw(Protocol):
    """What a bearing model asks of a contact's friction."""

    def forces(
        self, load: float, speed: float, slide_x: float, slide_y: float, spin: float
    ) -> TractionForces:
        """Forces on body 1 at a load [N], entrainment speed, slides [m/s], and spin [rad/s]."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactShape:
    """Ellipse and curvature of a contact: what a coefficient of friction needs to become forces
    and moments.
    """

    semi_axis_x: float  # along the entrainment, at 1 N; grows with the cube root of the load [m]
    semi_axis_y: float  # across, at 1 N [m]
    radius_x: float  # reduced, along the entrainment [m]
    curvature_radius: float = inf  # of the loaded surface across; infinite: no curvature slip [m]
    curvature_difference: float = 0.0  # 1/R_2x - 1/R_1x [1/m]

    @property
    def constants(self) -> Array:
        """As the kernel takes them, shape (5,) [m], [1/m]."""
        curvature = 0.5 / self.curvature_radius
        return np.array(
            [
                self.semi_axis_x,
                self.semi_axis_y,
                self.radius_x,
                curvature,
                self.curvature_difference,
            ]
        )


def hertz_disc() -> Array:
    """x/a, y/b and share of the load of quadrature points over an ellipse with Hertz' pressure,
    shape (3, n) [-].

    Gauss-Legendre in t = (1 - r^2)^(3/2), the share of the load outside the radius r, evenly
    spaced around.
    """
    nodes, weights = np.polynomial.legendre.leggauss(RINGS)
    radius = np.sqrt(1.0 - (0.5 * (nodes + 1.0)) ** (2.0 / 3.0))
    angle = 2.0 * np.pi * (np.arange(RAYS) + 0.5) / RAYS
    x, y = radius[:, None] * np.cos(angle), radius[:, None] * np.sin(angle)
    share = np.broadcast_to(0.5 * weights[:, None] / RAYS, x.shape)
    return np.stack([x.ravel(), y.ravel(), share.ravel()])


@dataclass(frozen=True)
class _HertzLaw:
    """A coefficient of friction that depends on the local sliding, over the Hertz ellipse."""

    shape: ContactShape

    @cached_property
    def disc(self) -> Array:
        """Points of the quadrature, see `hertz_disc` [-]."""
        return hertz_disc()

    def kernel_law(self) -> Array:
        """Kind and constants as the kernel takes them, [-] and [m/s]."""
        raise NotImplementedError

    def coefficient(self, slide: Array, speed: float) -> Array:
        """Coefficient of friction [-] at a local sliding speed and an entrainment speed [m/s]."""
        raise NotImplementedError

    def forces(
        self, load: float, speed: float, slide_x: float, slide_y: float, spin: float
    ) -> TractionForces:
        """Forces on body 1 at a load [N], entrainment speed, slides [m/s], and spin [rad/s]."""
        out = np.empty(8)
        law = self.kernel_law()
        constants = self.shape.constants
        _kernels.hertz_friction(
            self.disc, law, constants, load, speed, slide_x, slide_y, spin, out
        )
        return traction_forces(out)


@dataclass(frozen=True)
class CoulombLaw(_HertzLaw):
    """Coulomb friction with dead band and ramp (Ambrosio): zero to v_0, full from v_1 on.

    Attributes
    ----------
    shape : ContactShape
    friction : float
        Coefficient mu [-].
    slide_none, slide_full : float
        v_0 and v_1, sliding speeds [m/s].
    """

    friction: float = 0.1
    slide_none: float = 0.0
    slide_full: float = 1e-3

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

    def coefficient(self, slide: Array, speed: float) -> Array:
        """mu times the ramp [-] at a sliding speed [m/s]."""
        ramp = (slide - self.slide_none) / (self.slide_full - self.slide_none)
        return self.friction * np.clip(ramp, 0.0, 1.0)


@dataclass(frozen=True)
class FourConstantLaw(_HertzLaw):
    """mu = (A + B s) exp(-C s) + D of bearing dynamics codes, s the local slide over the
    entrainment speed.

    Below `dead_band` the coefficient rises linearly from zero, for friction has no direction where
    nothing slides.

    Attributes
    ----------
    shape : ContactShape
    a, b, c, d : float
        A to D [-].
    dead_band : float
        s up to which the coefficient is ramped [-].
    """

    a: float = 0.0
    b: float = 0.0
    c: float = 1.0
    d: float = 0.0
    dead_band: float = DEAD_BAND

    def __post_init__(self) -> None:
        if not all(isfinite(value) for value in (self.a, self.b, self.c, self.d)):
            raise ValueError(f"a, b, c, d must be finite, got {(self.a, self.b, self.c, self.d)}")
        if not self.dead_band > 0.0:
            raise ValueError(f"dead_band must be positive, got {self.dead_band!r}")

    def kernel_law(self) -> Array:
        """Kind 1, A to D, dead band [-]."""
        return np.array([1.0, self.a, self.b, self.c, self.d, self.dead_band])

    def coefficient(self, slide: Array, speed: float) -> Array:
        """The coefficient [-] at a sliding and an entrainment speed [m/s]."""
        s = slide / max(abs(speed), 1e-300)
        ramp = np.minimum(s / self.dead_band, 1.0)
        return ramp * ((self.a + self.b * s) * np.exp(-self.c * s) + self.d)


def four_constants(
    largest: float, slide: float, limit: float, zero: float = 0.0
) -> tuple[float, float, float, float]:
    """A, B, C, D [-] of mu = (A + B s) exp(-C s) + D from what a traction curve shows.

    Parameters
    ----------
    largest, slide : float
        kappa_max and the s where it is reached [-].
    limit : float
        kappa_inf, at large s [-].
    zero : float
        kappa_0, at s = 0 [-].

    Returns
    -------
    tuple of float
        D = kappa_inf, A = kappa_0 - kappa_inf, and with q = C s: B = C A/(1 - q), A exp(-q)/(1 -
        q) = kappa_max - D.
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
