"""[operation], [model] and [slip]: speeds, loads, assumptions of the bearing model, slip maps."""

from collections.abc import Iterator
from typing import Annotated, Any, Literal

from oilfilm.bearing.operation import BallKinematics, Curvature, Operation, QuasistaticModel

from .fields import (
    FORCE_MAXIMUM,
    FREE_WORD,
    SPEED_MAXIMUM,
    AxialRange,
    CriticalSpeed,
    Displacement,
    Force,
    Moment,
    OneOf,
    RadialRange,
    SpeedRange,
    Table,
    Tilt,
    above,
    between,
    described,
    within,
)
from .friction import FrictionTable
from .rules import CaseProblem, CaseValues, Excludes, Needs, Where, shown

SELF_HEATED = "self-heated"


class OperationTable(Table):
    """Speeds, loads or displacements of the inner ring, temperature."""

    inner_speed_rpm: float = within(SPEED_MAXIMUM, "speed of the inner ring", 0.0)
    outer_speed_rpm: float = within(SPEED_MAXIMUM, "speed of the outer ring", 0.0)
    radial_load_N: float | None = within(FORCE_MAXIMUM, "inner ring, along +y, the load line")
    axial_load_N: float | None = within(FORCE_MAXIMUM, "inner ring, along +x")
    force_N: Force | None = described("[fx, fy, fz] instead of radial and axial load")
    moment_N_mm: Moment | None = described("[my, mz]; the ring is then free to tilt")
    displacement_um: Displacement | None = described(
        '[x, y, z] of the inner ring instead of a load; "free" where the load decides'
    )
    tilt_mrad: Tilt | None = described('[about y, about z]; "free" where the moment decides')
    tilt: Literal["held", "free"] | None = described("without tilt_mrad: held at zero, or free")
    temperature_C: float = between(
        -270, 1300, "temperature of oil or medium in the contacts", 40.0
    )
    temperature: Literal["given", "self-heated"] = described(
        "given: temperature_C; self-heated: that where friction and cooling agree", "given"
    )


class ModelTable(Table):
    """Assumptions of the bearing model."""

    ball_kinematics: Annotated[str, OneOf(BallKinematics)] = described(
        "axis of rotation of the balls; traction equilibrium by friction.traction", "half and half"
    )
    curvature: Annotated[str, OneOf(Curvature)] = described(
        "contact angle at which the curvatures of the contacts are taken", "operating"
    )


RELATIONS = (
    Needs(
        "friction.heat_transfer_W_K",
        Where("operation.temperature", SELF_HEATED),
        'needed with operation.temperature = "self-heated"',
    ),
    Excludes("operation.radial_load_N", "operation.force_N"),
    Excludes("operation.axial_load_N", "operation.force_N"),
    Excludes("operation.tilt", "operation.tilt_mrad"),
)


def faults(values: CaseValues) -> Iterator[CaseProblem]:
    """Conflicts of [operation]: a load and a displacement in one direction, a moment on a held
    tilt.

    Parameters
    ----------
    values : CaseValues
        The valid values of the file.

    Yields
    ------
    Iterator[CaseProblem]
        The problems.
    """
    components = [values.get("operation", f"{name}_load_N") for name in ("axial", "radial")]
    force = values.get("operation", "force_N") or (*components, None)
    moment = values.get("operation", "moment_N_mm") or ()
    if values.get("operation", "tilt") == "held" and any(moment):
        finding = 'found "held" together with a moment'
        yield CaseProblem(("operation", "tilt"), finding, 'allowed: "free", or no moment')
    for name, loads, axes, motion, kind, unit in (
        ("displacement_um", force, "xyz", "a displacement along", "load", "N along"),
        ("tilt_mrad", moment, "yz", "a tilt about", "moment", "N mm about"),
    ):
        fixed = values.get("operation", name) or ()
        for axis, at, load in zip(axes, fixed, loads, strict=False):
            if at != FREE_WORD and load:
                given = f"a {kind} of {shown(load)} {unit} {axis}"
                finding = f"found {motion} {axis} together with {given}"
                allowed = f'allowed: one of them; "{FREE_WORD}" in {name} where the {kind} decides'
                yield CaseProblem(("operation", name), finding, allowed)


def operation(table: OperationTable) -> Operation:
    """Speeds, temperature, and a load or a displacement in each direction.

    Parameters
    ----------
    table : OperationTable
        The checked table.

    Returns
    -------
    Operation
        Speeds [rad/s], temperature [K], loads [N, N m], displacements [m, rad].
    """
    si = table.si()
    free = table.tilt == FREE_WORD or table.moment_N_mm is not None
    displacement = _fixed(si["displacement"] or (FREE_WORD,) * 3)
    tilt = _fixed(si["tilt_mrad"] or ((FREE_WORD,) * 2 if free else (0.0,) * 2))
    force = si["force"] or (si["axial_load"] or 0.0, si["radial_load"] or 0.0, 0.0)
    return Operation(
        **table.si("inner_speed_rpm", "outer_speed_rpm", "temperature_C"),
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


def model(table: ModelTable, friction: FrictionTable) -> QuasistaticModel:
    """Assumptions of the bearing model; traction equilibrium where a traction is given.

    Parameters
    ----------
    table : ModelTable
        The checked table.
    friction : FrictionTable
        The checked table [friction].

    Returns
    -------
    QuasistaticModel
        The assumptions.
    """
    named = friction.traction is not None and "ball_kinematics" not in table.model_fields_set
    kinematics = BallKinematics(table.ball_kinematics)
    kinematics = BallKinematics.TRACTION_EQUILIBRIUM if named else kinematics
    return table.build(QuasistaticModel, ball_kinematics=kinematics)


class SlipTable(Table):
    """Maps of gross slip after Hirano: `oilfilm slip`; loads and tilt not varied here are those of
    [operation].
    """

    speeds_rpm: SpeedRange = described("[first, last] speed of the inner ring in the maps", ...)
    axial_loads_N: AxialRange = described("[first, last] axial load, map of slip factors", ...)
    points: int = between(2, 201, "speeds and axial loads of the maps, evenly spaced", 51)
    critical_speeds_rpm: tuple[CriticalSpeed, ...] = described(
        "speeds of the critical loads of each ball", (), strict=False, max_length=6
    )
    critical_radial_loads_N: RadialRange = described(
        "[first, last] radial load of the critical curves", (0.0, 200.0)
    )
    critical_points: int = between(2, 201, "radial loads of the critical curves, evenly apart", 21)
    limit: float = above(0, 1e3, "slip factor below which a ball slips", 10.0)
    as_printed: Literal["half centrifugal force"] | None = described(
        "an error of the source, shown in addition to the right maps"
    )
    minimum_axial_load_factor_kN: float | None = above(0, 1e3, "A of SKF: F_am = A (n/1000)^2")
    minimum_radial_load_factor_kN: float | None = above(
        0, 1e3, "k_r of the SKF catalogue, F_rm = k_r (nu n/1000)^(2/3) (d_m/100)^2"
    )
