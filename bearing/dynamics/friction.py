"""Friction of balls on races for the compiled equations: none, a coefficient over the ellipse, or
a traction table.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING

import numpy as np

from ehl.traction.laws import CoulombLaw, FourConstantLaw
from ehl.traction.quadrature import ellipse_rings
from ehl.traction.table.table import TractionTable

from ..contacts.shape import contact_shape
from ..geometry import Bearing, Race
from .arrays import COEFFICIENT, FRICTIONLESS, TABLE, Array, FrictionData

if TYPE_CHECKING:
    Law = CoulombLaw | FourConstantLaw

# of the quadrature over the ellipse in the equations of motion
RINGS = 4
RAYS = 12


@dataclass(frozen=True, slots=True, kw_only=True)
class RaceFriction:
    """Friction of both races: laws of a coefficient, or tables, or none.

    Attributes
    ----------
    inner, outer : CoulombLaw, FourConstantLaw, TractionTable or None
        Of `ehl.traction`; None: frictionless.
    at_centre : bool
        A coefficient counts at the contact's centre alone: no spin moment, no slip by curvature.
    """

    inner: CoulombLaw | FourConstantLaw | TractionTable | None = None
    outer: CoulombLaw | FourConstantLaw | TractionTable | None = None
    at_centre: bool = False

    def __post_init__(self) -> None:
        if type(self.inner) is not type(self.outer):
            raise ValueError("friction: inner and outer race need the same kind of law")

    @property
    def kind(self) -> int:
        """Of the friction, as the kernel knows it."""
        if self.inner is None:
            return FRICTIONLESS
        return COEFFICIENT if hasattr(self.inner, "kernel_law") else TABLE

    @property
    def ramp(self) -> float:
        """Sliding speed within which Coulomb friction reverses; infinite for other laws [m/s]."""
        ends = [
            getattr(law, "slide_full", inf) - getattr(law, "slide_none", 0.0)
            for law in (self.inner, self.outer)
        ]
        return float(min(ends))

    def data(self, race: Race) -> FrictionData:
        """Arrays of one race for the kernel [SI]."""
        law = self.inner if race is Race.INNER else self.outer
        empty = np.zeros(1)
        grid = np.zeros((1, 1, 1))
        values = np.zeros((1, 1, 1, 1, 1, 1))
        disc = ellipse_rings(RINGS, RAYS, staggered=True)
        if self.at_centre:
            disc = np.array([[0.0], [0.0], [1.0]])
        if law is None:
            return FrictionData(disc, empty, np.zeros(5), np.zeros((5, 3)), empty, grid, values)
        if self.kind == COEFFICIENT:
            found: Array = law.kernel_law()  # type: ignore[union-attr]
            shape = law.shape.constants  # type: ignore[union-attr]
            return FrictionData(disc, found, shape, np.zeros((5, 3)), empty, grid, values)
        table: TractionTable = law  # type: ignore[assignment]
        return FrictionData(disc, empty, np.zeros(5), *table.kernel_arguments())


def coulomb_friction(
    bearing: Bearing,
    angles: tuple[float, float],
    coefficient: float,
    ramp: tuple[float, float],
    *,
    at_centre: bool = False,
) -> RaceFriction:
    """Coulomb friction with dead band and ramp (Ambrosio 2003) on both races.

    `angles`: contact angles, inner and outer [rad]; `coefficient`: mu [-]; `ramp`: v_0 and v_1:
    none below, all of it above [m/s]; `at_centre`: see `RaceFriction`.
    """
    laws = [
        CoulombLaw(
            contact_shape(bearing, race, angle),
            friction=coefficient,
            slide_none=ramp[0],
            slide_full=ramp[1],
        )
        for race, angle in zip((Race.INNER, Race.OUTER), angles, strict=True)
    ]
    return RaceFriction(inner=laws[0], outer=laws[1], at_centre=at_centre)


def four_constant_friction(
    bearing: Bearing,
    angles: tuple[float, float],
    constants: tuple[float, float, float, float],
    *,
    at_centre: bool = False,
) -> RaceFriction:
    """mu = (A + B s) exp(-C s) + D on both races; contact angles inner and outer [rad], constants
    [-].
    """
    a, b, c, d = constants
    laws = [
        FourConstantLaw(contact_shape(bearing, race, angle), a=a, b=b, c=c, d=d)
        for race, angle in zip((Race.INNER, Race.OUTER), angles, strict=True)
    ]
    return RaceFriction(inner=laws[0], outer=laws[1], at_centre=at_centre)
