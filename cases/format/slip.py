"""[slip]: maps of gross slip after Hirano."""

from typing import Literal

from pydantic import Field

from .fields import (
    AxialRange,
    CriticalSpeed,
    RadialRange,
    SpeedRange,
    Table,
    above,
    between,
    described,
)


class SlipTable(Table):
    """Maps of gross slip after Hirano: `oilfilm slip`; loads and tilt not varied here are those of
    [operation].
    """

    speeds_rpm: SpeedRange = Field(description="[first, last] speed of the inner ring in the maps")
    axial_loads_N: AxialRange = Field(
        description="[first, last] axial load in the map of slip factors"
    )
    points: int = between(2, 201, "speeds and axial loads of the maps, evenly spaced", default=51)
    critical_speeds_rpm: tuple[CriticalSpeed, ...] = Field(
        (),
        strict=False,
        max_length=6,
        description="speeds at which the critical loads of each ball are computed",
    )
    critical_radial_loads_N: RadialRange = described(
        (0.0, 200.0), "[first, last] radial load of the critical curves"
    )
    critical_points: int = between(
        2, 201, "radial loads of the critical curves, evenly spaced", default=21
    )
    limit: float = above(0.0, 1.0e3, "slip factor below which a ball slips", default=10.0)
    as_printed: Literal["half centrifugal force"] | None = described(
        None, "a slip of a source to be shown beside ours; the maps stay right"
    )
    minimum_axial_load_factor_kN: float | None = above(
        0.0, 1.0e3, "A of the SKF catalogue, F_am = A (n/1000)^2"
    )
    minimum_radial_load_factor_kN: float | None = above(
        0.0, 1.0e3, "k_r of the SKF catalogue, F_rm = k_r (nu n/1000)^(2/3) (d_m/100)^2"
    )
