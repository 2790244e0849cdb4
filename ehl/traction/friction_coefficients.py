"""Coefficients of friction by the local sliding, each law whole: name, constants, formula.

To add one: its formula, a branch in `coefficient` under the next kind, and its class, listed in
`COEFFICIENTS` where cases name it. Its constants become keys of [friction]; torque, traction
equilibrium and simulation take it over the Hertz ellipse (`shear.EllipseLaw`). Case files are
checked by the constants, so nothing is compiled here.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import e, exp, inf, isfinite
from typing import ClassVar, Self

import numpy as np
import scipy

from ..arrays import Array

COULOMB, FOUR_CONSTANTS = range(2)  # kinds, the first number of a law
MU, NONE, FULL = range(1, 4)  # behind it, of Coulomb's law
A, B, C, D, BAND, REST = range(1, 7)  # and of that of four constants
# slide over entrainment speed up to which a four-constant law rises from zero [-]: a
# regularisation, far below the slide of the largest coefficient (about 0.03)
DEAD_BAND = 1e-4


def coefficient(law: Array, slide: float, speed: float) -> float:
    """Evaluate the coefficient of friction of a law; `_kernels` compiles it.

    Coulomb: zero up to v_0 [m/s], mu [-] from v_1 on, a ramp between. Four constants:
    (A + B s) exp(-C s) + D at a slide over the entrainment speed s, ramped up to s_0 [-], and
    to no less than a sliding speed [m/s].

    Parameters
    ----------
    law : Array
        kind and constants, `Coefficient.kernel_law`, shape (n,)
    slide : float
        local sliding speed [m/s]
    speed : float
        entrainment speed [m/s]

    Returns
    -------
    float
        coefficient [-]
    """
    if law[0] == COULOMB:
        if slide <= law[NONE]:
            return 0.0
        if slide >= law[FULL]:
            return law[MU]
        return law[MU] * (slide - law[NONE]) / (law[FULL] - law[NONE])
    ratio = slide / max(abs(speed), 1e-300)
    band = max(law[BAND] * abs(speed), law[REST])
    ramp = 1.0 if slide >= band else slide / band
    return ramp * ((law[A] + law[B] * ratio) * np.exp(-law[C] * ratio) + law[D])


@dataclass(frozen=True, slots=True)
class Constant:
    """A constant of a law as case files have it in [friction], at most `largest` [-]."""

    key: str  # of [friction]
    largest: float  # allowed value [-]
    text: str  # description of the key
    simulated: float  # where a simulation leaves it out [-]
    positive: bool = True  # zero is not allowed
    below: str = ""  # key of the constant that it must not reach


class Coefficient(ABC):
    """A coefficient of friction by the local sliding."""

    constants: ClassVar[tuple[Constant, ...]] = ()

    @classmethod
    def of_case(cls, values: Mapping[str, float]) -> Self:
        """Build the law from the constants of a case.

        Parameters
        ----------
        values : Mapping[str, float]
            values of its `constants` by key [-]

        Returns
        -------
        Self
            the law
        """
        return cls(*(values[constant.key] for constant in cls.constants))

    @property
    @abstractmethod
    def description(self) -> str:
        """The law and its numbers, for messages."""

    @property
    @abstractmethod
    def kernel_law(self) -> Array:
        """Kind and constants as `coefficient` takes them, [-] and [m/s]."""

    @property
    def reversal_speed(self) -> float:
        """Sliding speed within which friction reverses; infinite where it follows the entrainment
        [m/s].
        """
        return inf

    def at_rest(self, band: float) -> "Coefficient":
        """Prepare the law for a bearing that comes to rest.

        Where friction follows the entrainment it reverses over a sliding speed at least.

        Parameters
        ----------
        band : float
            that sliding speed [m/s]

        Returns
        -------
        Coefficient
            the law
        """
        del band
        return self


@dataclass(frozen=True, kw_only=True)
class RampedCoulomb(Coefficient):
    """Coulomb friction with dead band and ramp (Ambrosio, 2003): zero to v_0, full from v_1 on."""

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

    @property
    def description(self) -> str:
        """The law and its numbers, for messages."""
        return f"Coulomb's law with a ramp of the sliding speed, mu = {self.friction:g}"

    @property
    def kernel_law(self) -> Array:
        """Kind, mu [-], v_0, v_1 [m/s]."""
        return np.array([COULOMB, self.friction, self.slide_none, self.slide_full])

    @property
    def reversal_speed(self) -> float:
        """Width of the ramp [m/s]."""
        return self.slide_full - self.slide_none


@dataclass(frozen=True)
class FourConstants(Coefficient):
    """mu = (A + B s) exp(-C s) + D of bearing dynamics codes, s the local slide over the
    entrainment speed.

    Below `dead_band` the coefficient rises linearly from zero, for friction has no direction where
    nothing slides.
    """

    constants = (
        Constant("traction_maximum", 1, "largest coefficient", 0.05),
        Constant("traction_maximum_slide", 10, "its slide-roll ratio", 0.03),
        Constant(
            "traction_limit", 1, "coefficient at large slide", 0.03, False, "traction_maximum"
        ),
    )
    a: float = 0.0  # A [-]
    b: float = 0.0  # B [-]
    c: float = 1.0  # C [-]
    d: float = 0.0  # D [-]
    dead_band: float = DEAD_BAND  # s up to which the coefficient is ramped [-]
    rest_band: float = 0.0  # least sliding speed up to which it is [m/s]

    def __post_init__(self) -> None:
        if not all(isfinite(value) for value in (self.a, self.b, self.c, self.d)):
            raise ValueError(f"a, b, c, d must be finite, got {(self.a, self.b, self.c, self.d)}")
        if not self.dead_band > 0.0:
            raise ValueError(f"dead_band must be positive, got {self.dead_band!r}")

    def at_rest(self, band: float) -> "FourConstants":
        """Ramp the law up to a sliding speed at least.

        Parameters
        ----------
        band : float
            that sliding speed [m/s]

        Returns
        -------
        FourConstants
            the law
        """
        return replace(self, rest_band=band)

    @classmethod
    def of_case(cls, values: Mapping[str, float]) -> Self:
        """Build the law from the constants of a case.

        Parameters
        ----------
        values : Mapping[str, float]
            values of its `constants` by key [-]

        Returns
        -------
        Self
            the law
        """
        return cls.of_curve(*(values[constant.key] for constant in cls.constants))

    @classmethod
    def of_curve(cls, largest: float, slide: float, limit: float, zero: float = 0.0) -> Self:
        """Build the law of a traction curve.

        The curve has the largest value kappa_max at the slide s, the limit kappa_inf at large s,
        and kappa_0 at s = 0. D = kappa_inf, A = kappa_0 - kappa_inf, and with q = C s: B = C A/(1
        - q), A exp(-q)/(1 - q) = kappa_max - D.

        Parameters
        ----------
        largest : float
            kappa_max [-]
        slide : float
            slide over the entrainment speed at which it is reached [-]
        limit : float
            kappa_inf [-]
        zero : float, default 0.0
            kappa_0 [-]

        Returns
        -------
        Self
            the law

        Raises
        ------
        ValueError
            if `slide` is not positive, or `largest` does not exceed both others
        """
        if not (isfinite(slide) and slide > 0.0):
            raise ValueError(f"slide must be positive and finite, got {slide!r}")
        if not largest > max(limit, zero):
            raise ValueError(f"largest must exceed limit {limit} and zero {zero}, got {largest!r}")
        a = zero - limit
        rise = largest - limit
        if a == 0.0:
            return cls(0.0, e * rise / slide, 1.0 / slide, limit)

        def excess(q: float) -> float:
            return a * exp(-q) - rise * (1.0 - q)

        ends = (0.0, 1.0) if a > 0.0 else (1.0, 2.0 - a / rise)
        q = scipy.optimize.brentq(excess, *ends)
        c = float(q) / slide
        return cls(a, c * a / (1.0 - float(q)), c, limit)

    @property
    def description(self) -> str:
        """The law and its numbers, for messages."""
        values = ", ".join(f"{constant:.4g}" for constant in (self.a, self.b, self.c, self.d))
        return f"law of four constants, (A + B s) exp(-C s) + D with {values}"

    @property
    def kernel_law(self) -> Array:
        """Kind, A to D, dead band [-], that at rest [m/s]."""
        return np.array(
            [FOUR_CONSTANTS, self.a, self.b, self.c, self.d, self.dead_band, self.rest_band]
        )


# laws that [friction] traction and [dynamics] friction name
COEFFICIENTS: dict[str, type[Coefficient]] = {"four constants": FourConstants}
