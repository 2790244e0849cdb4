"""[operation], [model] and [slip]."""

from typing import Literal

from pydantic import Field

from .fields import (
    FORCE_MAXIMUM,
    SPEED_MAXIMUM,
    AxialRange,
    CriticalSpeed,
    Displacement,
    Force,
    Moment,
    RadialRange,
    SpeedRange,
    Table,
    Tilt,
)


class OperationTable(Table):
    """Speeds, loads or displacements of the inner ring, temperature."""

    inner_speed_rpm: float = Field(
        0.0, ge=-SPEED_MAXIMUM, le=SPEED_MAXIMUM, description="speed of the inner ring"
    )
    outer_speed_rpm: float = Field(
        0.0, ge=-SPEED_MAXIMUM, le=SPEED_MAXIMUM, description="speed of the outer ring"
    )
    radial_load_N: float | None = Field(
        None,
        ge=-FORCE_MAXIMUM,
        le=FORCE_MAXIMUM,
        description="force on the inner ring along +y, the load line",
    )
    axial_load_N: float | None = Field(
        None, ge=-FORCE_MAXIMUM, le=FORCE_MAXIMUM, description="force on the inner ring along +x"
    )
    force_N: Force | None = Field(
        None, description="[fx, fy, fz] instead of radial and axial load"
    )
    moment_N_mm: Moment | None = Field(None, description="[my, mz]; the ring is then free to tilt")
    displacement_um: Displacement | None = Field(
        None,
        description='[x, y, z] of the inner ring instead of a load; "free" where the load decides',
    )
    tilt_mrad: Tilt | None = Field(
        None, description='[about y, about z] of the inner ring; "free" where the moment decides'
    )
    tilt: Literal["held", "free"] | None = Field(
        None, description="without tilt_mrad: held at zero, or free"
    )
    temperature_C: float = Field(
        40.0, ge=-100.0, le=500.0, description="temperature of the oil in the contacts"
    )


class ModelTable(Table):
    """Assumptions of the bearing model."""

    ball_kinematics: Literal[
        "half and half", "outer race control", "inner race control", "traction equilibrium"
    ] = Field(
        "half and half",
        description="what fixes the balls' axis of rotation; left out with friction.traction, traction equilibrium",
    )
    curvature: Literal["operating", "free"] = Field(
        "operating", description="contact angle at which the curvatures of the contacts are taken"
    )


class SlipTable(Table):
    """Maps of gross slip after Hirano: `oilfilm slip`; loads and tilt not varied here are those of
    [operation].
    """

    speeds_rpm: SpeedRange = Field(description="[first, last] speed of the inner ring in the maps")
    axial_loads_N: AxialRange = Field(
        description="[first, last] axial load in the map of slip factors"
    )
    points: int = Field(
        51, ge=2, le=201, description="speeds and axial loads of the maps, evenly spaced"
    )
    critical_speeds_rpm: tuple[CriticalSpeed, ...] = Field(
        (),
        strict=False,
        max_length=6,
        description="speeds at which the critical loads of each ball are computed",
    )
    critical_radial_loads_N: RadialRange = Field(
        (0.0, 200.0), description="[first, last] radial load of the critical curves"
    )
    critical_points: int = Field(
        21, ge=2, le=201, description="radial loads of the critical curves, evenly spaced"
    )
    limit: float = Field(
        10.0, gt=0.0, le=1.0e3, description="slip factor below which a ball slips"
    )
    as_printed: Literal["half centrifugal force"] | None = Field(
        None, description="a slip of a source to be shown beside ours; the maps stay right"
    )
    minimum_axial_load_factor_kN: float | None = Field(
        None, gt=0.0, le=1.0e3, description="A of the SKF catalogue, F_am = A (n/1000)^2"
    )
    minimum_radial_load_factor_kN: float | None = Field(
        None,
        gt=0.0,
        le=1.0e3,
        description="k_r of the SKF catalogue, F_rm = k_r (nu n/1000)^(2/3) (d_m/100)^2",
    )
