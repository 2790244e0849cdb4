"""Where a simulation starts: quasi-static equilibrium, or balls on the outer race."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..geometry import Bearing
from ..operation import Model, Operation
from ..quasistatic.kinematics import centrifugal_force
from ..quasistatic.solution import QuasistaticSolution
from ..quasistatic.solver import solve_quasistatic
from .arrays import (
    EXPONENT,
    GIVEN_FORCE,
    INNER_SPEED,
    OUTER,
    OUTER_SPEED,
    STIFFNESS,
    Array,
    EquationData,
)
from .bodies import free_coordinates, load_type
from .inputs import DynamicsModel, LoadType, Start
from .laws import kinematic_cage_speed
from .layout import BODIES, CAGE_ROTATION, Layout

# share of the speed at which an equilibrium is sought for a start at rest [-]
SMALLEST_SPEED_SHARE = 1.0e-3


@dataclass(frozen=True, slots=True, kw_only=True)
class StartingPoint:
    """What a simulation starts from."""

    kind: LoadType  # equations of motion
    angles: tuple[float, float]  # mean contact angles, inner and outer, by load [rad]
    equilibrium: QuasistaticSolution | None  # where the simulation starts from it
    messages: tuple[str, ...]


def starting_point(bearing: Bearing, operation: Operation, model: DynamicsModel) -> StartingPoint:
    """Equations, contact angles and equilibrium of the schedule's first row.

    Without an equilibrium the free contact angle stands in, and a message says so.
    """
    kind = model.options.equations or load_type(operation, model)
    first = first_operation(operation, model, kind)
    free = bearing.free_contact_angle if first.force[0] else 0.0
    axial = kind not in (LoadType.RADIAL, LoadType.PLANAR) and any(
        abs(row[GIVEN_FORCE]) > 0.0 for row in model.rows(operation)
    )
    nominal = (bearing.free_contact_angle, bearing.free_contact_angle) if axial else (free, free)
    if model.options.start is Start.ROLLING:
        return StartingPoint(kind=kind, angles=nominal, equilibrium=None, messages=())
    solution = _solve(bearing, first)
    if solution is None or not solution.converged:
        reason = "no equilibrium" if solution is None else solution.message
        text = (
            f"dynamics: no quasi-static start ({reason}); started with the balls rolling on the "
            "outer race"
        )
        return StartingPoint(kind=kind, angles=nominal, equilibrium=None, messages=(text,))
    angles = mean_angles(solution, nominal)
    return StartingPoint(kind=kind, angles=angles, equilibrium=solution, messages=())


def _solve(bearing: Bearing, operation: Operation) -> QuasistaticSolution | None:
    try:
        return solve_quasistatic(bearing, operation, Model())
    except (ValueError, ArithmeticError, np.linalg.LinAlgError):
        return None


def first_operation(operation: Operation, model: DynamicsModel, kind: LoadType) -> Operation:
    """The operation at time zero; coordinates that the equations fix are prescribed [SI]."""
    rows = model.rows(operation)
    first = rows[0]
    last = rows[-1]
    inner, outer = (
        a or SMALLEST_SPEED_SHARE * b
        for a, b in zip(first[:GIVEN_FORCE], last[:GIVEN_FORCE], strict=True)
    )
    ring = free_coordinates(kind, operation)[0]
    loads: list[Any] = [
        load if free else None for load, free in zip(first[GIVEN_FORCE:], ring, strict=True)
    ]
    given = [0.0 if value is None else value for value in operation.displacements]
    places: list[Any] = [None if free else value for value, free in zip(given, ring, strict=True)]
    return replace(
        operation,
        inner_speed=inner,
        outer_speed=outer,
        force=tuple(loads[:3]),
        moment=tuple(loads[3:]),
        displacement=tuple(places[:3]),
        tilt=tuple(places[3:]),
    )


def mean_angles(
    solution: QuasistaticSolution, nominal: tuple[float, float]
) -> tuple[float, float]:
    """Load-weighted contact angles of an equilibrium; nominal where nothing is loaded [rad]."""
    pairs = (
        (solution.inner_contact_angle, solution.inner_load, nominal[0]),
        (solution.outer_contact_angle, solution.outer_load, nominal[1]),
    )
    angles = [
        float(np.sum(angle * load) / np.sum(load)) if np.sum(load) > 0.0 else other
        for angle, load, other in pairs
    ]
    return angles[0], angles[1]


def initial_state(
    bearing: Bearing, data: EquationData, point: StartingPoint, start: Start
) -> Array:
    """State vector at time zero, see `layout` [m, rad, m/s, rad/s]."""
    layout = Layout(bearing.balls)
    y = np.zeros(layout.size)
    given = data.schedule[0]
    inner, outer = given[INNER_SPEED], given[OUTER_SPEED]
    cosines, sines = np.cos(data.pocket_angle), np.sin(data.pocket_angle)
    if point.equilibrium is None or start is Start.ROLLING:
        axial, radial, orbit, spin = _rolling(bearing, data, point.angles, (inner, outer))
    else:
        s = point.equilibrium
        y[layout.ring] = np.concatenate([s.displacement, s.tilt])
        axial, radial, orbit = s.ball_axial, s.ball_radial, s.orbit_speed
        spin = np.stack(
            [orbit - s.spin_speed * np.cos(s.attitude), s.spin_speed * np.sin(s.attitude)]
        )
    if start is Start.REST or not (inner or outer):
        orbit, spin = 0.0 * orbit, 0.0 * spin
    y[layout.ball] = np.stack([axial, radial * cosines, radial * sines], axis=1).ravel()
    speed = orbit * radial
    free = data.free[BODIES:]
    y[layout.ball_speed] = (
        np.stack([0.0 * speed, -speed * sines, speed * cosines], axis=1) * free[:3]
    ).ravel()
    turns = np.stack([spin[0], spin[1] * cosines, spin[1] * sines], axis=1)
    y[layout.ball_turn] = (turns * free[3:]).ravel()
    if data.constants.cage_mass > 0.0:
        y[layout.cage.start] = float(np.mean(axial))
        y[layout.cage_speed.start + CAGE_ROTATION] = float(np.mean(orbit))
    return y


def _rolling(
    bearing: Bearing, data: EquationData, angles: tuple[float, float], speeds: tuple[float, float]
) -> Any:
    """Balls on the outer race at the kinematic speed, pressed by their centrifugal force."""
    n = bearing.balls
    orbit = kinematic_cage_speed(bearing, *speeds, angles[1])
    gamma = bearing.ball_diameter / bearing.pitch_diameter * np.cos(angles[1])
    force = centrifugal_force(data.constants.ball_mass, bearing.pitch_diameter, np.asarray(orbit))
    law = data.normal[OUTER]
    approach = (float(force) / law[STIFFNESS]) ** (1.0 / law[EXPONENT])
    reach = bearing.outer_groove_radius - 0.5 * bearing.ball_diameter + approach
    axial = reach * np.sin(angles[1])
    radial = bearing.outer_centre_radius + reach * np.cos(angles[1])
    roll = (orbit - speeds[1]) * (1.0 + gamma) / gamma
    turn = np.array([orbit - roll * np.cos(angles[1]), roll * np.sin(angles[1])])
    return (
        np.full(n, axial),
        np.full(n, radial),
        np.full(n, orbit),
        np.repeat(turn[:, None], n, axis=1),
    )
