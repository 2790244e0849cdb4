"""Start of a simulation: quasi-static equilibrium, or balls on the outer race."""

from dataclasses import dataclass, replace
from math import cos, sin
from typing import Any

import numpy as np

from oilfilm.ehl.arrays import Array

from ..geometry import Bearing
from ..operation import Operation
from ..quasistatic.kinematics import centrifugal_force
from ..quasistatic.solution import QuasistaticSolution, kinematic_cage_speed
from ..quasistatic.solver import solve_quasistatic
from ..quasistatic.symmetric import solve_symmetric, unknowns
from .arrays import (
    BODIES,
    CAGE_ROTATION,
    EXPONENT,
    FREE_TURN,
    INNER_SPEED,
    OUTER,
    OUTER_SPEED,
    PRESCRIBED_FORCE,
    STIFFNESS,
    EquationData,
    Layout,
)
from .bodies import free_coordinates, load_type
from .choices import LoadType, Start
from .inputs import DynamicsModel

# share of the speed at which an equilibrium is sought for a start at rest [-]
SMALLEST_SPEED_SHARE = 1.0e-3


@dataclass(frozen=True, slots=True, kw_only=True)
class StartingPoint:
    """Start of a simulation."""

    kind: LoadType  # equations of motion
    angles: tuple[float, float]  # mean contact angles, inner and outer, by load [rad]
    equilibrium: QuasistaticSolution | None  # where the simulation starts from it
    messages: tuple[str, ...]
    # unknowns solved for it in the static and the quasi-static stage; none for another start [-]
    unknowns: tuple[int, int] = (0, 0)


def starting_point(bearing: Bearing, operation: Operation, model: DynamicsModel) -> StartingPoint:
    """Equations, contact angles and equilibrium of the schedule's first row.

    Without an equilibrium the free contact angle stands in, and a message says so.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    operation : Operation
        speeds and loads
    model : DynamicsModel
        schedule and options

    Returns
    -------
    StartingPoint
        start of the simulation
    """
    kind = model.options.equations or load_type(operation, model)
    first = first_operation(operation, model, kind)
    axial = kind not in (LoadType.RADIAL, LoadType.PLANAR) and _pushed_along(operation, model)
    angle = bearing.free_contact_angle if axial or first.force[0] else 0.0
    point = StartingPoint(kind=kind, angles=(angle, angle), equilibrium=None, messages=())
    if model.options.start is Start.ROLLING:
        return point
    solution = solve_symmetric(bearing, first)
    if solution is not None:
        point = replace(point, unknowns=unknowns(bearing, first))
    else:
        solution = solve_quasistatic(bearing, first)
        ring = sum(load is not None for load in first.loads)
        point = replace(point, unknowns=(0, ring + 2 * bearing.balls))
    if not solution.converged:
        text = f"dynamics: no quasi-static start ({solution.message})"
        text += "; started with the balls rolling on the outer race"
        return replace(point, messages=(text,))
    angles = (
        mean_angle(solution.inner_contact_angle, solution.inner_load, angle),
        mean_angle(solution.outer_contact_angle, solution.outer_load, angle),
    )
    return replace(point, angles=angles, equilibrium=solution)


def _pushed_along(operation: Operation, model: DynamicsModel) -> bool:
    """Check the first load or displacement of the ring for a component along the axis."""
    for row, displacement in zip(model.rows(operation), model.places(operation), strict=True):
        if any(row[PRESCRIBED_FORCE:]) or any(displacement):
            return row[PRESCRIBED_FORCE] != 0.0 or displacement[0] != 0.0
    return False


def mean_angle(angles: Array, loads: Array, nominal: float) -> float:
    """Mean contact angle by load.

    Parameters
    ----------
    angles : Array
        contact angles [rad]
    loads : Array
        loads of the contacts [N]
    nominal : float
        angle without a load [rad]

    Returns
    -------
    float
        mean angle [rad]
    """
    total = np.sum(loads)
    return float(np.sum(angles * loads) / total) if total > 0.0 else nominal


def first_operation(operation: Operation, model: DynamicsModel, kind: LoadType) -> Operation:
    """The operation at time zero; coordinates that the equations fix are prescribed.

    Parameters
    ----------
    operation : Operation
        speeds and loads
    model : DynamicsModel
        schedule and rotating load
    kind : LoadType
        equations of motion

    Returns
    -------
    Operation
        operation [SI]
    """
    rows = model.rows(operation)
    inner, outer = (
        a or SMALLEST_SPEED_SHARE * b
        for a, b in zip(rows[0][:PRESCRIBED_FORCE], rows[-1][:PRESCRIBED_FORCE], strict=True)
    )
    ring = free_coordinates(kind, operation)[0]
    prescribed = [*rows[0][PRESCRIBED_FORCE:]]
    if model.rotating is not None:
        prescribed[1] += model.rotating.force * cos(model.rotating.phase)
        prescribed[2] += model.rotating.force * sin(model.rotating.phase)
    loads: list[Any] = []
    displacements: list[Any] = []
    for load, displacement, free in zip(prescribed, model.places(operation)[0], ring, strict=True):
        loads.append(load if free else None)
        displacements.append(None if free else displacement)
    return replace(
        operation,
        inner_speed=inner,
        outer_speed=outer,
        force=tuple(loads[:3]),
        moment=tuple(loads[3:]),
        displacement=tuple(displacements[:3]),
        tilt=tuple(displacements[3:]),
    )


def initial_state(
    bearing: Bearing, data: EquationData, point: StartingPoint, start: Start
) -> Array:
    """State vector at time zero, see `arrays`.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    data : EquationData
        problem in numbers
    point : StartingPoint
        equations, contact angles and equilibrium of the start
    start : Start
        equilibrium, rolling or rest

    Returns
    -------
    Array
        state vector, shape (size,) [m], [rad], [m/s], [rad/s]
    """
    layout = Layout(bearing.balls)
    y = np.zeros(layout.size)
    cosines, sines = data.pocket_direction.T
    speeds = data.schedule[0, :PRESCRIBED_FORCE]
    # 1. balls: place, speed of the orbit, spin about axis and radius
    if point.equilibrium is None:
        axial, radial, orbit, spin = _rolling(bearing, data, point.angles, speeds)
        cage = float(np.mean(orbit))
    else:
        s = point.equilibrium
        y[layout.ring] = np.concatenate([s.displacement, s.tilt])
        axial, radial, orbit = s.ball_axial, s.ball_radial, s.orbit_speed
        cage = s.cage_speed
        spin = np.stack(
            [orbit - s.spin_speed * np.cos(s.attitude), s.spin_speed * np.sin(s.attitude)]
        )
    if start is Start.REST or not np.any(speeds):
        orbit, spin = 0.0 * orbit, 0.0 * spin
        cage = 0.0
    # 2. along the inertial axes, as far as the equations let them move
    speed = orbit * radial
    ball_free = data.free[BODIES:FREE_TURN]
    turn_free = data.free[FREE_TURN:]
    position = np.stack([axial, radial * cosines, radial * sines], axis=1)
    velocity = np.stack([0.0 * speed, -speed * sines, speed * cosines], axis=1) * ball_free
    turn = np.stack([spin[0], spin[1] * cosines, spin[1] * sines], axis=1) * turn_free
    y[layout.ball] = position.ravel()
    y[layout.ball_speed] = velocity.ravel()
    y[layout.ball_turn] = turn.ravel()
    # 3. the cage goes round with the loaded balls
    if data.constants.cage_mass > 0.0:
        y[layout.cage.start] = float(np.mean(axial))
        y[layout.cage_speed.start + CAGE_ROTATION] = cage
    return y


def _rolling(
    bearing: Bearing, data: EquationData, angles: tuple[float, float], speeds: Array
) -> tuple[Array, Array, Array, Array]:
    """Balls on the outer race at the kinematic speed, pressed by their centrifugal force."""
    angle = angles[OUTER]
    orbit = kinematic_cage_speed(bearing, speeds[INNER_SPEED], speeds[OUTER_SPEED], angle)
    gamma = bearing.ball_diameter / bearing.pitch_diameter * np.cos(angle)
    force = centrifugal_force(data.constants.ball_mass, bearing.pitch_diameter, np.asarray(orbit))
    law = data.normal[OUTER]
    approach = (float(force) / law[STIFFNESS]) ** (1.0 / law[EXPONENT])
    reach = bearing.outer_groove_radius - 0.5 * bearing.ball_diameter + approach
    roll = (orbit - speeds[OUTER_SPEED]) * (1.0 + gamma) / gamma
    each = np.ones(bearing.balls)
    return (
        reach * np.sin(angle) * each,
        (bearing.outer_centre_radius + reach * np.cos(angle)) * each,
        orbit * each,
        np.outer([orbit - roll * np.cos(angle), roll * np.sin(angle)], each),
    )
