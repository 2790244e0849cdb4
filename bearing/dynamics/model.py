"""Inputs of a simulation from the loads, drags, materials and oils that are known of a machine."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from ..friction.friction_sources import RaceTraction
from ..geometry import Bearing
from ..material import Material
from ..operation import Operation
from .arrays import (
    INNER_SPEED,
    OIL_VISCOSITY,
    OUTER_SPEED,
    PRESCRIBED_DISPLACEMENT,
    PRESCRIBED_FORCE,
    PRESCRIBED_MOMENT,
    RING_TILT,
)
from .assembly import cage_drag_of_torque, drag_of_force, drag_of_mixture
from .bodies import cage_body
from .choices import Guidance
from .friction import race_friction
from .initial import starting_point
from .inputs import CageBody, DynamicsModel, RotatingLoad, Schedule

CAGE_MATERIAL = "pa66"  # where none is known
# error of a viscosity that is linear between rows of a temperature over time [-]
VISCOSITY_ERROR = 1.0e-3
LARGEST_SPLIT = 1024  # of the time between two rows

Rows = Sequence[Sequence[float]]


def rotating_load(
    operation: Operation, force: float | None, speed: float | None, phase: float
) -> RotatingLoad | None:
    """Rotating load on the inner ring; it turns with the ring where its speed is not given.

    Parameters
    ----------
    operation : Operation
        Speeds of the rings.
    force : float or None
        Load across the axis [N]; None: there is none.
    speed : float or None
        Its speed about the axis [rad/s]; None: that of the inner ring.
    phase : float
        Its angle from +y at time zero [rad].

    Returns
    -------
    RotatingLoad or None
        The load; None without a force.
    """
    if force is None:
        return None
    speed = operation.inner_speed if speed is None else speed
    return RotatingLoad(force=force, speed=speed, phase=phase)


def ball_drag(
    bearing: Bearing,
    operation: Operation,
    force: float | None,
    mixture_density: float | None,
    coefficient: float,
) -> float:
    """Drag of a ball over the square of its speed, by a mixture of oil and air or by a force.

    Parameters
    ----------
    bearing : Bearing
        Geometry of the bearing.
    operation : Operation
        Speeds and loads, for the kinematic speed of the balls.
    force : float or None
        Drag of a ball at its kinematic speed [N]; unused where a density is given.
    mixture_density : float or None
        Density of the mixture of oil and air [kg/m^3].
    coefficient : float
        Drag coefficient of a ball in the mixture [-].

    Returns
    -------
    float
        Drag over speed squared [N s^2/m^2]; zero where neither is given.
    """
    if mixture_density is not None:
        return drag_of_mixture(mixture_density, bearing.ball_diameter, coefficient)
    return drag_of_force(bearing, operation, force) if force else 0.0


def cage_of_dimensions(
    bearing: Bearing,
    operation: Operation,
    material: Material,
    dimensions: Mapping[str, float | tuple[float, ...] | None],
    guidance: Guidance,
) -> CageBody:
    """The cage of known dimensions, with a drag torque at its kinematic speed.

    Parameters
    ----------
    bearing : Bearing
        Geometry of the bearing.
    operation : Operation
        Speeds and loads, for the kinematic speed of the cage.
    material : Material
        Material of the cage.
    dimensions : mapping
        Values for `cage_body` by name, SI; None: estimated; `drag` as a torque [N m].
    guidance : Guidance
        The surfaces that guide the cage.

    Returns
    -------
    CageBody
        The cage; the pockets are frictionless unless `pocket_friction` is given.
    """
    given = {name: value for name, value in dimensions.items() if value is not None}
    drag = given.get("drag")
    if drag and not isinstance(drag, tuple):
        given["drag"] = cage_drag_of_torque(bearing, operation, drag)
    return cage_body(bearing, material, **{"pocket_friction": 0.0, **given}, guidance=guidance)


def prescribed_schedule(
    operation: Operation,
    *,
    inner_speed: Rows | None = None,
    outer_speed: Rows | None = None,
    force: Rows | None = None,
    moment: Rows | None = None,
    displacement: Rows | None = None,
    tilt: Rows | None = None,
    viscosity: Rows | None = None,
) -> Schedule | None:
    """Tables over time as one schedule; the operation holds where no table is given.

    Parameters
    ----------
    operation : Operation
        Speeds, loads and displacements that no table prescribes.
    inner_speed, outer_speed : sequence of rows or None
        Time [s] and speed of the ring [rad/s].
    force, moment : sequence of rows or None
        Time [s] and force along x, y, z [N]; time [s] and moment about y and z [N m].
    displacement, tilt : sequence of rows or None
        Time [s] and displacement along x, y, z [m]; time [s] and tilt about y and z [rad]; zero
        in a direction in which the ring is free.
    viscosity : sequence of rows or None
        Time [s] and viscosity of the oil in pockets and lands over its reference [-].

    Returns
    -------
    Schedule or None
        All tables at common times; None without any.
    """
    return Schedule.from_tables(
        operation,
        {
            INNER_SPEED: inner_speed,
            OUTER_SPEED: outer_speed,
            PRESCRIBED_FORCE: force,
            PRESCRIBED_MOMENT: moment,
            PRESCRIBED_DISPLACEMENT: displacement,
            PRESCRIBED_DISPLACEMENT + RING_TILT: tilt,
            OIL_VISCOSITY: viscosity,
        },
    )


def viscosity_over_time(
    table: Rows, viscosity_at: Callable[[float], float], reference: float
) -> list[tuple[float, float]]:
    """Viscosity over time from a temperature over time, with intermediate rows.

    Between two rows the temperature is linear; as many rows are added as keep a straight line
    of the viscosity within `VISCOSITY_ERROR` of its law.

    Parameters
    ----------
    table : sequence of rows
        Time [s] and temperature [K].
    viscosity_at : callable
        Dynamic viscosity [Pa s] at a temperature [K].
    reference : float
        Viscosity that the result is related to [Pa s].

    Returns
    -------
    list of (float, float)
        Time [s] and viscosity over the reference [-].
    """

    def ratio(temperature: float) -> float:
        return viscosity_at(temperature) / reference

    rows = [(table[0][0], ratio(table[0][1]))]
    for (start, cold), (end, warm) in zip(table, table[1:], strict=False):
        for fraction in np.linspace(0.0, 1.0, _intervals(ratio, cold, warm) + 1)[1:]:
            time = start + fraction * (end - start)
            rows.append((time, ratio(cold + fraction * (warm - cold))))
    return rows


def _intervals(ratio: Callable[[float], float], cold: float, warm: float) -> int:
    """Equal steps of a change of temperature [K] in which the viscosity is nearly straight."""
    count = 1
    while count < LARGEST_SPLIT:
        ends = [ratio(t) for t in np.linspace(cold, warm, count + 1)]
        half = 0.5 * (warm - cold) / count
        middles = [ratio(t) for t in np.linspace(cold + half, warm - half, count)]
        straight = 0.5 * (np.array(ends[:-1]) + np.array(ends[1:]))
        if np.max(np.abs(straight / np.array(middles) - 1.0)) <= VISCOSITY_ERROR:
            break
        count *= 2
    return count


def with_race_friction(
    model: DynamicsModel,
    bearing: Bearing,
    operation: Operation,
    law: RaceTraction,
    *,
    at_centre: bool,
) -> DynamicsModel:
    """The model with a law of friction at the contact angles of its starting point.

    Parameters
    ----------
    model : DynamicsModel
        Model without friction of the balls on the races.
    bearing : Bearing
        Geometry of the bearing.
    operation : Operation
        Speeds and loads at the start.
    law : RaceTraction
        Law of friction of ball on race.
    at_centre : bool
        True: the coefficient counts at the centre of the contact alone.

    Returns
    -------
    DynamicsModel
        The model with the friction of both races.
    """
    angles = starting_point(bearing, operation, model).angles
    return replace(model, friction=race_friction(law, bearing, angles, at_centre=at_centre))
