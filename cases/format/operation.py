"""[operation], [model] and [slip]: speeds, loads, assumptions of the bearing model, slip maps."""

from collections.abc import Iterator
from typing import Any, Literal

from pydantic import Field

from bearing.operation import BallKinematics, Curvature, Model, Operation

from .fields import (
    FORCE_MAXIMUM,
    FREE_WORD,
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
    above,
    between,
    described,
)
from .friction import FrictionTable
from .problems import CaseFault, shown
from .rules import CaseValues, Excludes


class OperationTable(Table):
    """Speeds, loads or displacements of the inner ring, temperature."""

    inner_speed_rpm: float = between(
        -SPEED_MAXIMUM, SPEED_MAXIMUM, "speed of the inner ring", default=0.0
    )
    outer_speed_rpm: float = between(
        -SPEED_MAXIMUM, SPEED_MAXIMUM, "speed of the outer ring", default=0.0
    )
    radial_load_N: float | None = between(
        -FORCE_MAXIMUM, FORCE_MAXIMUM, "force on the inner ring along +y, the load line"
    )
    axial_load_N: float | None = between(
        -FORCE_MAXIMUM, FORCE_MAXIMUM, "force on the inner ring along +x"
    )
    force_N: Force | None = described(None, "[fx, fy, fz] instead of radial and axial load")
    moment_N_mm: Moment | None = described(None, "[my, mz]; the ring is then free to tilt")
    displacement_um: Displacement | None = described(
        None, '[x, y, z] of the inner ring instead of a load; "free" where the load decides'
    )
    tilt_mrad: Tilt | None = described(
        None, '[about y, about z] of the inner ring; "free" where the moment decides'
    )
    tilt: Literal["held", "free"] | None = described(
        None, "without tilt_mrad: held at zero, or free"
    )
    temperature_C: float = between(
        -100.0, 500.0, "temperature of the oil in the contacts", default=40.0
    )


class ModelTable(Table):
    """Assumptions of the bearing model."""

    ball_kinematics: Literal[
        "half and half", "outer race control", "inner race control", "traction equilibrium"
    ] = described(
        "half and half",
        "what fixes the balls' axis of rotation; left out with friction.traction, "
        "traction equilibrium",
    )
    curvature: Literal["operating", "free"] = described(
        "operating", "contact angle at which the curvatures of the contacts are taken"
    )


RELATIONS = (
    Excludes("operation.radial_load_N", "operation.force_N"),
    Excludes("operation.axial_load_N", "operation.force_N"),
    Excludes("operation.tilt", "operation.tilt_mrad"),
)


def operation_faults(values: CaseValues) -> Iterator[CaseFault]:
    """A load or a displacement for each direction, a moment or a tilt about each axis, once."""
    force = values.get("operation", "force_N") or (
        values.get("operation", "axial_load_N"),
        values.get("operation", "radial_load_N"),
        None,
    )
    displacement = values.get("operation", "displacement_um") or ()
    for direction, fixed, load in zip("xyz", displacement, force, strict=False):
        if fixed != FREE_WORD and load:
            found = (
                f"found a displacement along {direction} together with a load of "
                f"{shown(load)} N along {direction}"
            )
            yield _given_twice("displacement_um", found, "load")
    moment = values.get("operation", "moment_N_mm") or ()
    if values.get("operation", "tilt") == "held" and any(moment):
        found = 'found "held" together with a moment'
        yield CaseFault(("operation", "tilt"), found, 'allowed: "free", or no moment')
    angles = values.get("operation", "tilt_mrad") or ()
    for axis, angle, load in zip("yz", angles, moment, strict=False):
        if angle != FREE_WORD and load:
            found = (
                f"found a tilt about {axis} together with a moment of {shown(load)} N mm "
                f"about {axis}"
            )
            yield _given_twice("tilt_mrad", found, "moment")


def _given_twice(name: str, found: str, load: str) -> CaseFault:
    allowed = f'allowed: one of them; "{FREE_WORD}" in {name} where the {load} decides'
    return CaseFault(("operation", name), found, allowed)


def operation(table: OperationTable) -> Operation:
    """Speeds [rad/s], temperature [K], a load [N, N m] or a displacement [m, rad] each way."""
    si = table.si()
    free = table.tilt == FREE_WORD or table.moment_N_mm is not None
    displacement = _fixed(si["displacement"] or (FREE_WORD,) * 3)
    tilt = _fixed(si["tilt_mrad"] or ((FREE_WORD,) * 2 if free else (0.0,) * 2))
    force = si["force"] or (si["axial_load"] or 0.0, si["radial_load"] or 0.0, 0.0)
    return Operation(
        inner_speed=si["inner_speed"],
        outer_speed=si["outer_speed"],
        temperature=si["temperature"],
        force=_loads(force, displacement),
        moment=_loads(si["moment"] or (0.0, 0.0), tilt),
        displacement=displacement,
        tilt=tilt,
    )


def _fixed(entries: tuple[Any, ...]) -> Any:
    """Displacements, None where the load decides."""
    return tuple(None if entry == FREE_WORD else entry for entry in entries)


def _loads(loads: tuple[float, ...], fixed: tuple[float | None, ...]) -> Any:
    """Loads, None where the displacement is given."""
    return tuple(load if at is None else None for load, at in zip(loads, fixed, strict=True))


def model(table: ModelTable, friction: FrictionTable) -> Model:
    """Assumptions of the bearing model [-]; traction equilibrium where a traction is given."""
    named = friction.traction is not None and "ball_kinematics" not in table.model_fields_set
    kinematics = BallKinematics(table.ball_kinematics)
    return Model(
        ball_kinematics=BallKinematics.TRACTION_EQUILIBRIUM if named else kinematics,
        curvature=Curvature(table.curvature),
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
