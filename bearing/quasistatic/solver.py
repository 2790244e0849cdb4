"""Quasi-static equilibrium of a ball bearing in five degrees of freedom, after Jones (1960) and
Harris.

The inner ring, with one row of balls or several, moves by (x, y, z, tilt y, tilt z); every ball is
in equilibrium with it (`balls`), and Newton's method with the condensed tangent brings
the ring to balance. Small rotations: the grooves' centres move linearly with the five unknowns,
the error being half the square of the tilt times their radius.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.closed_form.hertz import hertz_contact

from ..geometry import (
    SINGLE,
    Bearing,
    Race,
    Row,
    contact_modulus,
    per_ball,
    reduced_radii,
    row_azimuths,
    row_directions,
)
from ..operation import DEGREES_OF_FREEDOM, BallKinematics, Operation, QuasistaticModel
from .balls import (
    BallProblem,
    BallsEquilibrium,
    BallState,
    ball_problem,
    ball_state,
    free_balls_at_cage_speed,
    held_fraction,
)
from .kinematics import EDGE_COSINE, FRICTION_LIMIT, PrescribedBalls, stiffness_at
from .ring import RESIDUAL_TOLERANCE, Ring, RingPoint, RingStart, ring_of, solve_ring
from .solution import QuasistaticSolution, _cage_speed

SPEED_STEPS = (0.0, 0.25, 0.5, 0.75, 0.9, 1.0)  # continuation when the direct solve fails [-]
# load over the centrifugal forces of all balls below which these may leave no equilibrium [-]
LIGHT_LOAD_RATIO = 0.1
# smallest over largest stiffness below which a direction counts as undetermined [-]
SINGULAR_RATIO = 1.0e-9
# load of a ball over the heaviest from which friction beyond its limit is named [-]
NAMED_LOAD = 0.01
NONE = "no equilibrium"


def solve_quasistatic(
    bearing: Bearing,
    operation: Operation,
    model: QuasistaticModel | None = None,
    initial_guess: QuasistaticSolution | None = None,
    rows: Sequence[Row] = SINGLE,
) -> QuasistaticSolution:
    """Equilibrium of balls and inner ring, Jones (1960), Harris and Kotzalas; SI.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    operation : Operation
        speeds, loads and displacements
    model : QuasistaticModel | None, optional
        assumptions, with one of the hypotheses on the balls' kinematics
    initial_guess : QuasistaticSolution | None, optional
        a converged solution of the same bearing at similar speeds and loads
    rows : Sequence[Row], default SINGLE
        rows of balls on the one inner ring

    Returns
    -------
    QuasistaticSolution
        equilibrium; with `converged` False and a `message` if there is none or the search failed

    Raises
    ------
    ValueError
        for traction equilibrium, which `friction.equilibrium.solve_traction_equilibrium` solves

    Examples
    --------
    >>> from oilfilm.bearing import Operation, load_bearing, solve_quasistatic
    >>> operation = Operation(inner_speed=300.0, force=(0.0, 1000.0, 0.0))
    >>> solution = solve_quasistatic(load_bearing("6208"), operation)
    >>> solution.converged, f"{solution.inner_load.max():.0f} N"
    (True, '555 N')
    """
    model = model or QuasistaticModel()
    if model.ball_kinematics is BallKinematics.TRACTION_EQUILIBRIUM:
        raise ValueError(
            "ball_kinematics: solve_quasistatic takes a hypothesis; traction equilibrium needs "
            "the friction of ball on race, see solve_traction_equilibrium"
        )
    inputs = (bearing, operation, model, tuple(rows))
    ring = ring_of(bearing, operation, inputs[3], model.rings)
    problem = ball_problem(bearing, operation.inner_speed, operation.outer_speed, model)
    point, iterations = _from_guess(ring, problem, initial_guess)
    if point.residual > max(RESIDUAL_TOLERANCE, point.noise):
        start = None
        for factor in SPEED_STEPS:
            speeds = factor * operation.inner_speed, factor * operation.outer_speed
            slower = ball_problem(bearing, *speeds, model)
            begin = None if start is None else RingStart(start.q, start.balls.u, start.between.V)
            start, more = solve_ring(ring, slower, begin)
            iterations += more
            if start.residual > max(RESIDUAL_TOLERANCE, start.noise):
                break
        else:
            point = start or point
    return _solution(inputs, ring, problem, point, iterations)


def solve_with_prescribed_balls(
    bearing: Bearing,
    operation: Operation,
    model: QuasistaticModel,
    start: QuasistaticSolution,
    prescribed: PrescribedBalls,
) -> QuasistaticSolution:
    """Equilibrium with the speeds of the balls and the friction on them prescribed.

    The search begins at `start`, at whose inner contacts the friction along the orbit acts;
    otherwise as `solve_quasistatic`.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    operation : Operation
        speeds, loads and displacements
    model : QuasistaticModel
        assumptions of the model
    start : QuasistaticSolution
        solution to begin with
    prescribed : PrescribedBalls
        speeds [rad/s] and friction [N] of the balls

    Returns
    -------
    QuasistaticSolution
        equilibrium, or `converged` False with a `message`
    """
    inputs = (bearing, operation, model, start.rows)
    ring = ring_of(bearing, operation, start.rows, model.rings)
    drive = _drive_loads(ring, start, prescribed.inner_drive)
    ring = ring._replace(load=ring.load + drive.sum(axis=0), drive=drive)
    problem = ball_problem(bearing, operation.inner_speed, operation.outer_speed, model)
    problem = replace(problem, prescribed=prescribed)
    point, iterations = _from_guess(ring, problem, start)
    return _solution(inputs, ring, problem, point, iterations)


def _from_guess(
    ring: Ring, problem: BallProblem, guess: QuasistaticSolution | None
) -> tuple[RingPoint, int]:
    """Balance from a similar solution; from the loads where there is none or it fails."""
    if guess is not None:
        point, iterations = solve_ring(ring, problem, _start_at(guess, ring))
        if point.residual <= max(RESIDUAL_TOLERANCE, point.noise):
            return point, iterations
    return solve_ring(ring, problem, None)


def _drive_loads(ring: Ring, at: QuasistaticSolution, drive: Array) -> Array:
    """Load of friction along the orbit on the ring, row by row, shape (rows, 5) [N], moments over
    R_i.

    F e_t at the axial distance x_c makes the moment -F x_c e_r.
    """
    c, s = row_directions(at.bearing, at.rows)
    centre = per_ball(at.bearing, [row.axial_position for row in at.rows])
    height = at.bearing.inner_groove_radius * np.sin(at.inner_contact_angle)
    arm = (centre - height) / ring.scale[3]
    each = drive * np.array([np.zeros_like(c), -s, c, -arm * c, -arm * s])
    return each.reshape(5, -1, at.bearing.balls).sum(axis=2).T


def _start_at(solution: QuasistaticSolution, ring: Ring) -> RingStart:
    """Ring and balls where a solution has them, but for prescribed displacements."""
    q = np.concatenate([solution.displacement, solution.tilt]) * ring.scale
    planes = per_ball(solution.bearing, [row.outer_plane for row in solution.rows])
    radial = solution.ball_radial - solution.bearing.outer_centre_radius
    u = np.stack([solution.ball_axial - planes, radial])
    return RingStart(np.where(ring.free, q, ring.prescribed), u)


def _convergence(
    problem: BallProblem,
    bearing: Bearing,
    ring: Ring,
    point: RingPoint,
    state: BallState,
    iterations: int,
) -> tuple[bool, str]:
    """Convergence of the point, and a message with the fault or the undetermined directions."""
    loaded = state.inner_load > 0.0
    beyond = (loaded & (state.inner.cos < EDGE_COSINE)) | (state.outer.cos < EDGE_COSINE)
    if beyond.any():
        return False, f"{NONE}: a contact angle passes 80 degrees, the balls leave the grooves"
    if point.residual > max(RESIDUAL_TOLERANCE, point.noise):
        worst = float(np.max(point.balls.residual))
        return False, (
            f"{NONE} found in {iterations} iterations: relative residual {point.residual:.1e} "
            f"(balls {worst:.1e}); {_advice(problem, bearing, ring, state)}"
        )
    if _too_wide(bearing, problem, state):
        return False, f"{NONE} within Hertz' theory: a contact ellipse is wider than the ball"
    names = ", ".join(DEGREES_OF_FREEDOM[k] for k in range(5) if ring.free[k])
    if names and not loaded.any():
        return False, f"the inner ring floats: no ball touches it and {names} is not determined"
    message = f"converged in {iterations} iterations"
    undetermined = ", ".join(_undetermined(ring, point))
    if undetermined:
        message += f"; without stiffness, hence arbitrary: {undetermined}"
    return True, message + _beyond_friction(problem, state)


def _beyond_friction(problem: BallProblem, state: BallState) -> str:
    """Loaded balls on which friction does not hold the hypothesis."""
    loaded = state.inner_load > 0.0
    if problem.prescribed is not None:
        return ""
    slipping = loaded & (held_fraction(state, problem) < 1.0)
    if not (slipping & (state.inner_load > NAMED_LOAD * state.inner_load.max())).any():
        return ""
    largest = float(state.inner_load[slipping].max())
    return (
        f"; {problem.kinematics.value} asks more friction than {FRICTION_LIMIT:g} of the load of "
        f"{int(slipping.sum())} of {int(loaded.sum())} loaded balls (up to {largest:.3g} N on the "
        "inner race): these roll on the outer race with the part of it that friction holds"
    )


def _advice(problem: BallProblem, bearing: Bearing, ring: Ring, state: BallState) -> str:
    """Most likely reason why balls and ring have no balance, and what to change."""
    if _too_wide(bearing, problem, state):
        return "contact ellipses came out wider than the ball, take smaller loads or speeds"
    forces = state.inner_load.size * problem.nominal_force
    ratio = float(np.linalg.norm(ring.load[:3])) / max(forces, 1e-300)
    if problem.nominal_force > 0.0 and ratio < LIGHT_LOAD_RATIO and ring.free[0]:
        return (
            f"the loads are {ratio:.2g} of the centrifugal forces of the balls, too light to hold "
            "them in the grooves under this hypothesis: take more thrust or less speed"
        )
    if problem.inner_speed * problem.outer_speed < 0.0:
        return (
            "rings turning against each other make the balls spin fast, and this ball hypothesis "
            "may have no steady state: try another one, or less speed"
        )
    return "check the loads for a direction in which nothing holds the ring"


def _too_wide(bearing: Bearing, problem: BallProblem, state: BallState) -> bool:
    """Check for a contact ellipse that is wider than the ball, where Hertz' theory is void.

    Over the semi-axis b the gap rises by b^2/(2 Ry), which is less than the approach (Q/K)^(2/3):
    most fit by that.
    """
    radius = 0.5 * bearing.ball_diameter
    for race, load, cosine, series in (
        (Race.INNER, state.inner_load, state.inner.cos, problem.inner_series),
        (Race.OUTER, state.outer_load, state.outer.cos, problem.outer_series),
    ):
        worst = int(np.argmax(load))
        if load[worst] <= 0.0:
            continue
        radii = reduced_radii(bearing, race, float(np.arccos(cosine[worst])))
        approach = (load[worst] / stiffness_at(series, cosine[[worst]])[0]) ** (2.0 / 3.0)
        if 2.0 * radii[1] * approach > radius**2:
            contact = hertz_contact(float(load[worst]), *radii, contact_modulus(bearing, race))
            if contact.semi_axis_y > radius:
                return True
    return False


def _undetermined(ring: Ring, point: RingPoint) -> list[str]:
    """Free degrees of freedom that the null space of the tangent leaves open."""
    indices = np.flatnonzero(ring.free)
    if indices.size == 0:
        return []
    tangent = point.stiffness[np.ix_(indices, indices)]
    _, values, vectors = np.linalg.svd(tangent)
    null = vectors[values < SINGULAR_RATIO * values[0]]
    return [
        DEGREES_OF_FREEDOM[k]
        for k, components in zip(indices, np.abs(null).T, strict=True)
        if (components > 0.1).any()
    ]


def _solution(
    inputs: tuple[Bearing, Operation, QuasistaticModel, tuple[Row, ...]],
    ring: Ring,
    problem: BallProblem,
    point: RingPoint,
    iterations: int,
) -> QuasistaticSolution:
    bearing, operation, model, rows = inputs
    balls: BallsEquilibrium = point.balls
    state = ball_state(balls.u, point.between.V - balls.u, problem)
    converged, message = _convergence(problem, bearing, ring, point, state, iterations)
    u, state = free_balls_at_cage_speed(balls.u, point.between.V, state, problem, bearing.balls)
    scale = ring.scale
    movement = point.q / ring.scale
    row_load = -(ring.loads(balls, bearing.balls) + ring.drive) * scale
    prescribed = problem.prescribed
    none = np.zeros(u.shape[1])
    load = -(point.force + ring.drive.sum(axis=0)) * scale
    return QuasistaticSolution(
        bearing=bearing,
        operation=operation,
        model=model,
        displacement=movement[:3],
        tilt=movement[3:],
        ring_force=load[:3],
        ring_moment=load[3:],
        stiffness=point.stiffness * np.outer(scale, scale),
        azimuth=row_azimuths(bearing, rows),
        **_ball_arrays(state),
        **_ring_arrays(ring, point),
        ball_axial=u[0] + per_ball(bearing, [row.outer_plane for row in rows]),
        ball_radial=bearing.outer_centre_radius + u[1],
        pivot_speed=none if prescribed is None else prescribed.pivot_speed,
        inner_drive=none if prescribed is None else prescribed.inner_drive,
        cage_driven=np.zeros(none.size, dtype=np.bool_),
        cage_speed=_cage_speed(state.motion.orbit_speed, state.inner_load),
        residual=point.residual,
        iterations=iterations,
        converged=converged,
        message=message,
        rows=rows,
        row_load=row_load,
    )


def _ring_arrays(ring: Ring, point: RingPoint) -> dict[str, Array]:
    """Movement of the grooves' centres of elastic rings at the balls [m]."""
    values = point.balls.values
    inner = outer = np.zeros_like(point.balls.u)
    if ring.compliance is not None:
        forces = (values[2:4], values[5])
        inner, outer = ring.compliance.deflections(*forces, point.between.V)
    return {
        "inner_ring_axial": inner[0],
        "inner_ring_radial": inner[1],
        "outer_ring_axial": outer[0],
        "outer_ring_radial": outer[1],
    }


def _ball_arrays(state: BallState) -> dict[str, Array]:
    """Loads and friction [N], angles [rad], body forces [N], [N m] and speeds [rad/s] of the
    balls.
    """
    return {
        "inner_load": state.inner_load,
        "outer_load": state.outer_load,
        "inner_contact_angle": np.arctan2(state.inner.sin, state.inner.cos),
        "outer_contact_angle": np.arctan2(state.outer.sin, state.outer.cos),
        "centrifugal_force": state.centrifugal_force,
        "gyroscopic_moment": state.gyroscopic_moment,
        "inner_friction": state.inner_friction,
        "outer_friction": state.outer_friction,
        "orbit_speed": state.motion.orbit_speed,
        "spin_speed": state.motion.spin_speed,
        "attitude": np.arctan2(state.motion.attitude.sin, state.motion.attitude.cos),
    }
