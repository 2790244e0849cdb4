"""Slip maps of a case: results, quantities and summary."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from oilfilm.bearing.quasistatic.solution import QuasistaticSolution
from oilfilm.bearing.studies.slip import HIRANO_CAVEAT, CriticalCurves, SlipSurface, slip_factors
from oilfilm.ehl.arrays import Array

from ..bearing.bearing_quantities import BALL_QUANTITY
from ..files import plain
from ..quantities import Quantity, Results, quantities, rows_of, values_of

SPEED = Quantity("speed_krpm", "speed of the inner ring")  # of the axes of pictures
OPERATION = quantities(
    ("speed_rpm", "", "operation.inner_speed"), *("ring_force_N", "ring_moment_N_mm", "tilt_mrad")
)
BALLS = tuple(  # of the equilibrium at the operation of the case
    BALL_QUANTITY[key]
    for key in (
        *("azimuth_deg", "inner_load_N", "outer_load_N", "inner_contact_angle_deg"),
        "centrifugal_force_N",
    )
)
SLIP_FACTOR = Quantity("slip_factor", "slip factor $Q_i\\,\\sin\\alpha_i/F_c$", symbol="SF")
AXIAL_LOAD, RADIAL_LOAD = quantities(
    ("axial_loads_N", "axial load", "axial_loads"), ("radial_loads_N", "radial load")
)
WORST_FACTOR = Quantity("slip_factor_minimum", "slip factor of the worst ball", "minimum")
SPEEDS = Quantity("speeds_rpm", "speed", "speeds")
SURFACE = (SPEEDS, AXIAL_LOAD, WORST_FACTOR)
CURVE = (Quantity("speed_rpm", "speed", "speed"), RADIAL_LOAD)
NOT_GIVEN = "[slip] {} is not given"
MINIMUM_LOADS = (
    Quantity("hirano_N", "Hirano", "hirano", symbol="Hirano"),
    Quantity(
        *("as_printed_N", "as printed: half the centrifugal force", "as_printed"),
        NOT_GIVEN.format("as_printed"),
        "as printed",
    ),
    Quantity(
        *("skf_axial_N", "SKF minimum axial load", "skf_axial"),
        NOT_GIVEN.format("minimum_axial_load_factor_kN"),
        "SKF axial",
    ),
    Quantity(
        *("skf_radial_N", "SKF minimum radial load", "skf_radial"),
        NOT_GIVEN.format("minimum_radial_load_factor_kN"),
        "radial",
    ),
)


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


def slip_summary(results: SlipResults) -> dict[str, Any]:
    """Summary as plain JSON types, units in the keys, null where a value does not exist.

    Parameters
    ----------
    results : SlipResults
        Slip maps of the case.

    Returns
    -------
    dict[str, Any]
        The document.
    """
    curves = [
        values_of(curve, CURVE)
        | {
            "axial_loads_N": [
                {"ball": ball, "values": row} for ball, row in enumerate(curve.axial_loads.T, 1)
            ]
        }
        for curve in results.curves
    ]
    minimum_preload = values_of(results.minimum, (SPEEDS, *MINIMUM_LOADS))
    document = {
        "limit": results.limit,
        "operation": _operation(results),
        "surface": values_of(results.surface, SURFACE),
        "critical_curves": curves,
        "minimum_preload": minimum_preload,
    }
    absent = [
        f"{load.key} is null: {load.null}"
        for load in MINIMUM_LOADS
        if minimum_preload[load.key] is None
    ]
    messages = (*results.problems, *absent, f"minimum preload: {HIRANO_CAVEAT}")
    head = results.head(not results.problems, messages)
    return head | dict(plain(document)) | {"timing_s": results.timing}


def _operation(results: SlipResults) -> dict[str, Any]:
    minimum = results.minimum
    own = {"minimum_preload_N": minimum.hirano, "minimum_preload_as_printed_N": minimum.as_printed}
    return {
        **values_of(results.state, OPERATION),
        **{
            key: loads[-1] if minimum.own and loads is not None else None
            for key, loads in own.items()
        },
        "balls": ball_values(results),
    }


def ball_values(results: SlipResults) -> list[dict[str, Any]]:
    """The balls at the operation of the case: loads [N], angles [deg], slip factors [-].

    Parameters
    ----------
    results : SlipResults
        Slip maps of the case.

    Returns
    -------
    list[dict[str, Any]]
        Values by key, a dictionary for each ball.
    """
    factors = results.factors
    share = results.printed_force
    columns = values_of(results.state, BALLS) | {
        "slip_factor": factors,
        "slip_factor_as_printed": [None] * len(factors) if share is None else factors / share,
        "slips": factors < results.limit,
    }
    return rows_of({"ball": range(1, len(factors) + 1)} | columns)
