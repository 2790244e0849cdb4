"""Slip maps of a case."""

from dataclasses import dataclass

import numpy as np

from bearing.quasistatic.solution import QuasistaticSolution
from bearing.studies.slip import CriticalCurves, SlipSurface, slip_factors
from ehl.arrays import Array

from ..quantities import Quantity
from ..results import Results
from .quantities import MINIMUM_LOADS


@dataclass(frozen=True, slots=True, kw_only=True)
class MinimumLoads:
    """Loads [N] over speeds [rad/s]; with `own` the last entry is the case's own speed."""

    speeds: Array
    hirano: Array
    as_printed: Array | None
    skf_axial: Array | None
    skf_radial: Array | None
    own: bool

    @property
    def count(self) -> int:
        """Speeds of the grid [-], without the case's own."""
        return len(self.speeds) - self.own

    def given(self) -> list[tuple[Quantity, Array]]:
        """The loads [N] that there are."""
        loads = [(load, load.value(self)) for load in MINIMUM_LOADS]
        return [(load, values) for load, values in loads if values is not None]


@dataclass(frozen=True, slots=True, kw_only=True)
class SlipResults(Results):
    """Slip maps of a case."""

    limit: float  # slip factor below which a ball slips [-]
    state: QuasistaticSolution
    surface: SlipSurface
    curves: tuple[CriticalCurves, ...]
    minimum: MinimumLoads
    printed_force: float | None  # centrifugal force of the source over ours [-]

    @property
    def factors(self) -> Array:
        """Slip factors of the balls at the operation of the case [-]."""
        return slip_factors(self.state)

    @property
    def problems(self) -> tuple[str, ...]:
        """Parts that did not converge, in words."""
        problems: tuple[str, ...] = ()
        if not self.state.converged:
            problems = (f"operation of the case: not converged: {self.state.message}",)
        if self.surface.unsolved:
            points = f"{self.surface.unsolved} of {self.surface.minimum.size}"
            problems += (
                f"map of slip factors: no equilibrium at {points} points (not converged); change "
                "axial_loads_N",
            )
        if np.isnan(self.minimum.hirano).any():
            problems += (
                "minimum preload: not converged at some speeds; lower the radial load, the tilt "
                "or the speed",
            )
        return problems
