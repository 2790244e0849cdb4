"""Friction of balls on races for the compiled equations: the laws of `ehl.traction` as arrays."""

from dataclasses import dataclass
from math import inf

import numpy as np

from ehl.traction.laws import CoulombLaw, FrictionLaw, HertzLaw
from ehl.traction.quadrature import ellipse_rings
from ehl.traction.table.table import TractionTable

from ..friction.sources import RaceTraction
from ..geometry import Bearing, Race
from .arrays import COEFFICIENT, FRICTIONLESS, TABLE, FrictionData

# quadrature over the ellipse: force within 1 % of mu Q of 512 points (tests)
RINGS = 4
RAYS = 12
CENTRE = np.array([[0.0], [0.0], [1.0]])  # one point with all of the load [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class RaceFriction:
    """Friction of both races: laws of a coefficient, or tables, or none; ValueError for others."""

    # None: frictionless
    inner: FrictionLaw | None = None
    outer: FrictionLaw | None = None
    # a coefficient counts at the contact's centre alone: no spin moment, no slip by curvature
    at_centre: bool = False

    def __post_init__(self) -> None:
        if type(self.inner) is not type(self.outer):
            raise ValueError("friction: inner and outer race need the same kind of law")
        if not isinstance(self.inner, HertzLaw | TractionTable | None):
            name = type(self.inner).__name__
            raise ValueError(f"friction: {name} is neither a coefficient nor a traction table")

    @property
    def kind(self) -> int:
        """Of the friction, as the kernel takes it."""
        if self.inner is None:
            return FRICTIONLESS
        return TABLE if isinstance(self.inner, TractionTable) else COEFFICIENT

    @property
    def ramp(self) -> float:
        """Sliding speed within which Coulomb friction reverses; infinite for other laws [m/s]."""
        laws = [law for law in (self.inner, self.outer) if isinstance(law, CoulombLaw)]
        return min((law.slide_full - law.slide_none for law in laws), default=inf)

    def data(self, race: Race) -> FrictionData:
        """Arrays of one race for the kernel [SI]."""
        law = self.inner if race is Race.INNER else self.outer
        disc = CENTRE if self.at_centre else ellipse_rings(RINGS, RAYS, staggered=True)
        if isinstance(law, TractionTable):
            return FrictionData(disc, np.zeros(1), np.zeros(5), *law.kernel_arguments())
        no_table = (np.zeros((5, 3)), np.zeros(1), np.zeros((1, 1, 1)), np.zeros((1,) * 6))
        if not isinstance(law, HertzLaw):
            return FrictionData(disc, np.zeros(1), np.zeros(5), *no_table)
        return FrictionData(disc, law.kernel_law(), law.shape.constants, *no_table)


def race_friction(
    source: RaceTraction, bearing: Bearing, angles: tuple[float, float], *, at_centre: bool = False
) -> RaceFriction:
    """A law of torque and traction equilibrium on both races; contact angles, inner and outer
    [rad]; `at_centre`: see `RaceFriction`.
    """
    inner, outer = (
        source.race_law(bearing, race, angle)
        for race, angle in zip((Race.INNER, Race.OUTER), angles, strict=True)
    )
    return RaceFriction(inner=inner, outer=outer, at_centre=at_centre)
