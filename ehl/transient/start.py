"""Steady film that a run starts from."""

from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import RegularGridInterpolator

from ..arrays import Array
from ..grid import unfolded
from ..multigrid.cycle import (
    cycle,
    flow,
    relative_residual,
    reynolds_operator,
    start_level,
    update_exterior,
    update_film,
)
from ..multigrid.far_field import FarField
from ..multigrid.full_multigrid import Attempt, contact_multigrid
from ..multigrid.levels import Damping, Multigrid
from ..multigrid.open_box import choose_domain
from ..options import SolverOptions
from ..scaling import ScaledContact, scale_contact
from ..solution import ContactSolution
from ..solver import solve_attempts
from .content import steady_content
from .inputs import TransientConditions, TransientOptions
from .record import MeshError
from .step import far_fields_by_direction

# share of K_00/hx below which nodes are relaxed distributively: with the 0.3 of steady contacts
# the storage, which is of the pressure itself and not of its slope, lets single nodes grow 3 to 5
# times a cycle at (M, L) = (100, 2.5), see docs/theory/transient.md
SWITCH = 1.0
POLISHED = 1e-7  # residual of the steady film
MAX_CYCLES = 40


class StartError(Exception):
    """No steady film to start from; the message says why."""


@dataclass(frozen=True, slots=True, kw_only=True)
class InitialState:
    """A multigrid at the start of a run, and the oil that its nodes hold; all [-]."""

    state: Multigrid  # levels of the contact
    smooth: Array  # gap without features, shape (ny, nx)
    content: Array  # m, shape (ny, nx)
    fields: dict[bool, FarField]  # of an open box, by the direction of the entrainment
    domain: tuple[float, float, float]  # in Hertz semi-axes
    mesh: MeshError | None = None  # where it is a steady film


def levels_over_time(
    conditions: TransientConditions, options: TransientOptions
) -> tuple[Multigrid, ScaledContact, tuple[float, float, float]]:
    """Allocate the levels of the contact on a grid along the entrainment.

    Parameters
    ----------
    conditions : TransientConditions
        contact over time
    options : TransientOptions
        options of the run

    Returns
    -------
    levels
        levels, coarsest first
    contact
        scaled contact
    box
        x_in, x_out and y_half in Hertz half-extents [-]
    """
    contact = scale_contact(conditions.contact, along_entrainment=True)
    domain = options.domain or _open_box(conditions, contact)
    damping = Damping(switch=SWITCH)
    state = contact_multigrid(
        contact,
        domain,
        SolverOptions(points=options.points, domain=options.domain),
        Attempt(name="over time", damping=damping, along_entrainment=True),
        full_domain=not conditions.symmetric,
    )
    return state, contact, domain


def _open_box(
    conditions: TransientConditions, contact: ScaledContact
) -> tuple[float, float, float]:
    """Choose the box of a steady contact, with as much behind as ahead where the entrainment stops
    or reverses.
    """
    x_in, x_out, y_half = choose_domain(contact)
    turns = conditions.speed is not None and min(conditions.speed.values) <= 0.0
    return (x_in, -x_in, y_half) if turns else (x_in, x_out, y_half)


def initial_state(
    conditions: TransientConditions, options: TransientOptions, feature_gap: Array
) -> InitialState:
    """Solve the steady film of t = 0, or place the bodies apart.

    Parameters
    ----------
    conditions : TransientConditions
        contact over time
    options : TransientOptions
        options of the run
    feature_gap : Array
        gap by the features at t = 0, shape (ny, nx) [-]

    Returns
    -------
    InitialState
        multigrid and fields to start from

    Raises
    ------
    StartError
        if the steady film does not converge
    """
    state, contact, domain = levels_over_time(conditions, options)
    level = state.levels[-1]
    smooth = level.gap.copy()
    level.gap = smooth + feature_gap
    fields = far_fields_by_direction(contact) if state.far_field is not None else {}
    mesh = None
    if conditions.impact is None:
        mesh = _settle(conditions, options, state)
    else:
        scale = contact.film_scale
        assert scale is not None
        state.approach = conditions.impact.gap / scale
        state.far_field = None
        start_level(state, len(state.levels) - 1, np.zeros_like(level.P))
    content = _content(state, conditions)
    return InitialState(
        state=state, smooth=smooth, content=content, fields=fields, domain=domain, mesh=mesh
    )


def _settle(
    conditions: TransientConditions, options: TransientOptions, state: Multigrid
) -> MeshError:
    """Steady film at the load and speed of t = 0, from a solution of its own scales."""
    speed = conditions.speed_at(0.0)
    load = conditions.load_at(0.0)
    c = conditions.contact
    at_zero = replace(c, load=load, entrainment_speed=abs(speed))
    points = SolverOptions(points=options.points, domain=options.domain)
    solution, levels = solve_attempts(at_zero, points)
    if not solution.converged:
        raise StartError(f"steady film at the start: {solution.message}")
    # 1. onto this grid, backwards where it runs so
    index = len(state.levels) - 1
    start = _interpolated_pressure(levels, solution.frame_angle, state, speed < 0.0)
    contact = state.contact
    state.approach = _scaled_approach(levels, state)
    fractions = (abs(speed) / c.entrainment_speed, load / c.load)
    turn = 1.0 if speed > 0.0 else -1.0
    at_start = replace(
        contact,
        speed=contact.speed * fractions[0],
        load=contact.load * fractions[1],
        velocity_x=turn * contact.velocity_x,
    )
    state.contact = at_start
    field = None if state.far_field is None else far_fields_by_direction(at_start)[True]
    state.far_field = field
    for one in state.levels:
        one.factors = replace(one.factors, couette_x=np.full_like(one.P, turn))
    start_level(state, index, start)
    update_exterior(state, index)
    update_film(state, index)
    residual = _polished(state, index)
    for one in state.levels:
        one.factors = replace(one.factors, couette_x=None)
    state.contact = contact
    if not residual < 1e-3:
        raise StartError(f"steady film at the start: residual of {residual:.1e} after the cycles")
    return _mesh_error(solution)


def _mesh_error(solution: ContactSolution) -> MeshError:
    """Distance of the nodal films from those without mesh, and the bars of these."""
    films = (solution.film_central_dimensionless, solution.film_minimum_dimensionless)
    errors = [(abs(f.value - f.finest) + f.uncertainty) / abs(f.value) for f in films]
    return MeshError(
        central=errors[0], minimum=errors[1], resolved=solution.resolved, message=solution.message
    )


def _polished(state: Multigrid, index: int) -> float:
    """Residual after cycles until the equations hold, or come no nearer to it [-]."""
    before = np.inf
    residual = np.inf
    for _ in range(MAX_CYCLES):
        cycle(state, index)
        residual = relative_residual(state, index)[0]
        if residual < POLISHED or (residual < 1e-5 and residual > 0.9 * before):
            break
        before = residual
    return float(residual)


def _scaled_approach(levels: Multigrid, state: Multigrid) -> float:
    """H0 of a solution in the scales of another grid [-]."""
    scale_before = levels.contact.film_scale
    scale = state.contact.film_scale
    assert scale_before is not None and scale is not None
    return levels.approach * scale_before / scale


def _interpolated_pressure(
    levels: Multigrid, angle: float, state: Multigrid, backwards: bool
) -> Array:
    """Pressure of a solution on another grid, in its scales, shape (ny, nx) [-]."""
    level = levels.levels[-1]
    grid = level.grid
    P = unfolded(level.P) if grid.symmetric else level.P
    Y = unfolded(grid.Y, sign=-1.0) if grid.symmetric else grid.Y
    before = levels.contact
    after = state.contact
    assert before.semi_axis_x is not None and after.semi_axis_x is not None
    length = after.semi_axis_x / before.semi_axis_x
    target = state.levels[-1].grid
    turn = after.frame_angle - angle
    c, s = np.cos(turn), np.sin(turn)
    X, YY = np.meshgrid(target.X, target.Y)
    sign = -1.0 if backwards else 1.0
    positions = np.stack((YY * c + X * s, sign * (X * c - YY * s)), axis=-1) * length
    at = RegularGridInterpolator((Y, grid.X), P, bounds_error=False, fill_value=0.0)
    return np.asarray(at(positions)) * before.hertz_pressure / after.hertz_pressure


def _content(state: Multigrid, conditions: TransientConditions) -> Array:
    """Oil of the nodes in the steady film."""
    level = state.levels[-1]
    state.time_step = None
    flow(state, level)
    full = level.flow_x * level.H
    speed = conditions.speed_at(0.0)
    if speed == 0.0 or conditions.impact is not None:
        return full
    # without film the operator is that of the Poiseuille flow alone
    film = level.H
    level.H = np.zeros_like(film)
    gained = reynolds_operator(level).copy()
    level.H = film
    fraction = abs(speed) / conditions.contact.entrainment_speed
    empty = level.P <= 0.0
    turned = slice(None, None, 1 if speed > 0.0 else -1)
    content = steady_content(
        full[:, turned], gained[:, turned] / fraction, empty[:, turned], level.grid.hx
    )
    return content[:, turned]
