"""[operation], [model] and [slip]."""

from typing import Any

from bearing.operation import BallKinematics, Curvature, Model, Operation

from ..schema.fields import FREE
from ..schema.files import BearingFile
from ..schema.operation import OperationTable, SlipTable
from ..slip_plan import SlipPlan
from .units import KN, MRAD, N_MM, RPM, UM, ZERO_CELSIUS

TRACTION_EQUILIBRIUM = "traction equilibrium"


def operation(table: OperationTable) -> Operation:
    """Speeds [rad/s], temperature [K], and per degree of freedom a load [N, N m] or a displacement
    [m, rad].
    """
    force = table.force_N or (table.axial_load_N or 0.0, table.radial_load_N or 0.0, 0.0)
    displacement = _split(table.displacement_um or (FREE,) * 3, UM)
    free = table.tilt == FREE or table.moment_N_mm is not None
    tilt = _split(table.tilt_mrad or ((FREE,) * 2 if free else (0.0,) * 2), MRAD)
    moment = table.moment_N_mm or (0.0, 0.0)
    loads: Any = tuple(
        load if fixed is None else None for load, fixed in zip(force, displacement, strict=True)
    )
    moments: Any = tuple(
        load * N_MM if fixed is None else None for load, fixed in zip(moment, tilt, strict=True)
    )
    return Operation(
        inner_speed=table.inner_speed_rpm * RPM,
        outer_speed=table.outer_speed_rpm * RPM,
        temperature=table.temperature_C + ZERO_CELSIUS,
        force=loads,
        moment=moments,
        displacement=displacement,
        tilt=tilt,
    )


def _split(entries: tuple[Any, ...], unit: float) -> Any:
    return tuple(None if entry == FREE else entry * unit for entry in entries)


def model(file: BearingFile) -> Model:
    """Assumptions of the bearing model [-]."""
    kinematics = BallKinematics(kinematics_name(file))
    return Model(ball_kinematics=kinematics, curvature=Curvature(file.model.curvature))


def kinematics_name(file: BearingFile) -> str:
    """Ball kinematics as given; left out, traction equilibrium where a traction is named [-]."""
    if file.friction.traction is not None and "ball_kinematics" not in file.model.model_fields_set:
        return TRACTION_EQUILIBRIUM
    return file.model.ball_kinematics


def slip_plan(table: SlipTable) -> SlipPlan:
    """What `oilfilm slip` maps: speeds [rad/s], loads [N], catalogue factors [N]."""
    factors = (table.minimum_axial_load_factor_kN, table.minimum_radial_load_factor_kN)
    axial, radial = (None if factor is None else factor * KN for factor in factors)
    return SlipPlan(
        speeds=(table.speeds_rpm[0] * RPM, table.speeds_rpm[1] * RPM),
        axial_loads=table.axial_loads_N,
        points=table.points,
        critical_speeds=tuple(speed * RPM for speed in table.critical_speeds_rpm),
        critical_radial_loads=table.critical_radial_loads_N,
        critical_points=table.critical_points,
        limit=table.limit,
        as_printed=table.as_printed,
        minimum_axial_load_factor=axial,
        minimum_radial_load_factor=radial,
    )
